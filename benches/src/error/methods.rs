//! The methods: each is asked "apart, or how deep?" about some pairs that it has in its own form.

use super::textbook::{Body, Number, World};
use asunder_narrow::{Pair2, Pair3, Separation2, Separation3, separations3};
use asunder_scenes::pairs::{PosedPair2, PosedPair3};
use asunder_tests::report::peers::{Contact, double, single, unless_panic};
use core::cell::RefCell;

/// What a method says of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Said {
    /// They share no point.
    Apart,
    /// They share a point; it does not say how deep.
    Touching,
    /// They share a point, and their separation is this, in metres: no more than 0.
    Deep(f64),
    /// A NaN, a panic, or no answer.
    Refused,
}

impl Said {
    /// A separation, where there is one; above zero it is a gap.
    fn deep(separation: Option<f64>) -> Self {
        match separation {
            Some(separation) if separation.is_nan() => Self::Refused,
            Some(separation) if separation <= 0.0 => Self::Deep(separation),
            _ => Self::Apart,
        }
    }

    fn of_peer(said: Option<Option<Contact>>) -> Self {
        match said {
            None => Self::Refused,
            Some(Some(contact)) if contact.normal.is_nan() => Self::Refused,
            Some(contact) => Self::deep(contact.map(|contact| contact.separation)),
        }
    }
}

/// Some pairs in a method's own form. What is timed is what is judged.
pub(super) trait Prepared {
    /// Appends an answer for each pair, in order.
    fn say(&self, said: &mut Vec<Said>);
}

/// A method.
pub(super) struct Method<P> {
    /// The name in rows.
    pub(super) name: &'static str,
    /// Takes over some pairs, beforehand.
    pub(super) prepare: fn(&[P]) -> Box<dyn Prepared + '_>,
}

/// One by one, by what is asked of each. A panic is an answer: nothing that it leaves behind is looked at again.
struct OneByOne<Q, F>(Vec<Q>, F);

impl<Q, F: Fn(&Q) -> Said> Prepared for OneByOne<Q, F> {
    fn say(&self, said: &mut Vec<Said>) {
        let ask = |pair: &Q| unless_panic(|| Some(self.1(pair))).unwrap_or(Said::Refused);
        said.extend(self.0.iter().map(ask));
    }
}

fn one_by_one<'a, Q: 'a>(pairs: Vec<Q>, ask: impl Fn(&Q) -> Said + 'a) -> Box<dyn Prepared + 'a> {
    Box::new(OneByOne(pairs, ask))
}

fn pair3(posed: &PosedPair3) -> Pair3<'_> {
    Pair3::new(&posed.shape_a, &posed.pose_a, &posed.shape_b, &posed.pose_b)
}

fn pair2(posed: &PosedPair2) -> Pair2<'_> {
    Pair2::new(&posed.shape_a, &posed.pose_a, &posed.shape_b, &posed.pose_b)
}

fn guessed(overlapping: bool) -> Said {
    if overlapping { Said::Touching } else { Said::Apart }
}

fn of_separation3(found: &Separation3) -> Said {
    match found {
        Separation3::Measured(found) => Said::deep(Some(found.separation.into())),
        Separation3::AtLeast(_) => Said::Apart,
    }
}

/// Cuboids go eight at a time, whatever stands between them.
struct AtOnce<'a>(&'a [PosedPair3], RefCell<Vec<Separation3>>);

impl Prepared for AtOnce<'_> {
    fn say(&self, said: &mut Vec<Said>) {
        let mut found = self.1.borrow_mut();
        found.clear();
        let ask = || {
            let pairs: Vec<Pair3<'_>> = self.0.iter().map(pair3).collect();
            separations3(&pairs, 0.0, &mut found);
            Some(())
        };
        match unless_panic(ask) {
            Some(()) => said.extend(found.iter().map(of_separation3)),
            None => said.extend(self.0.iter().map(|_| Said::Refused)),
        }
    }
}

fn textbook3<T: Number + 'static>(pairs: &[PosedPair3]) -> Box<dyn Prepared + '_> {
    let bodies = |pair: &PosedPair3| {
        (Body::<T, 3>::solid(&pair.shape_a, &pair.pose_a), Body::<T, 3>::solid(&pair.shape_b, &pair.pose_b))
    };
    let world = RefCell::new(World::<T, 3>::default());
    one_by_one(pairs.iter().map(bodies).collect(), move |(a, b)| {
        Said::deep(world.borrow_mut().depth(a, b).map(|(depth, _)| -depth.into()))
    })
}

fn textbook2<T: Number + 'static>(pairs: &[PosedPair2]) -> Box<dyn Prepared + '_> {
    let bodies = |pair: &PosedPair2| {
        let a = Body::<T, 2>::polygon(&pair.shape_a, &pair.pose_a);
        (a, Body::<T, 2>::polygon(&pair.shape_b, &pair.pose_b))
    };
    let world = RefCell::new(World::<T, 2>::default());
    one_by_one(pairs.iter().map(bodies).collect(), move |(a, b)| {
        Said::deep(world.borrow_mut().depth(a, b).map(|(depth, _)| -depth.into()))
    })
}

/// Pairs that can be asked about, by all methods of their dimension.
pub(super) trait Asked: Sized {
    /// Every method, in the order in which results are listed.
    fn methods() -> Vec<Method<Self>>;
}

impl Asked for PosedPair3 {
    fn methods() -> Vec<Method<Self>> {
        vec![
            Method { name: "textbook-f32", prepare: textbook3::<f32> },
            Method { name: "textbook-f64", prepare: textbook3::<f64> },
            Method {
                name: "fast",
                prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| guessed(pair3(pair).guess())),
            },
            Method {
                name: "certain",
                prepare: |pairs| {
                    one_by_one(pairs.iter().collect(), |pair| of_separation3(&pair3(pair).separation(0.0)))
                },
            },
            Method {
                name: "batched-boxes",
                prepare: |pairs| Box::new(AtOnce(pairs, RefCell::new(Vec::new()))),
            },
            Method {
                name: "parry-f32",
                prepare: |pairs| {
                    let twins = pairs.iter().map(|pair| unless_panic(|| single::Twins::new(pair)));
                    one_by_one(twins.collect(), |twins| {
                        Said::of_peer(twins.as_ref().and_then(|t| t.contact()))
                    })
                },
            },
            Method {
                name: "parry-f64",
                prepare: |pairs| {
                    let twins = pairs.iter().map(|pair| unless_panic(|| double::Twins::new(pair)));
                    one_by_one(twins.collect(), |twins| {
                        Said::of_peer(twins.as_ref().and_then(|t| t.contact()))
                    })
                },
            },
        ]
    }
}

impl Asked for PosedPair2 {
    fn methods() -> Vec<Method<Self>> {
        vec![
            Method { name: "textbook-f32", prepare: textbook2::<f32> },
            Method { name: "textbook-f64", prepare: textbook2::<f64> },
            Method {
                name: "fast",
                prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| guessed(pair2(pair).guess())),
            },
            Method {
                name: "certain",
                prepare: |pairs| {
                    one_by_one(pairs.iter().collect(), |pair| match pair2(pair).separation(0.0) {
                        Separation2::Measured(found) => Said::deep(Some(found.separation.into())),
                        Separation2::AtLeast(_) => Said::Apart,
                    })
                },
            },
        ]
    }
}
