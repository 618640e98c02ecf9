//! The methods: each is asked "apart, or how deep?" about pairs in a form of its own.

use super::textbook::{Body, Forms, Number, World};
use asunder_geometry::{Shape2, Shape3};
use asunder_narrow::{Pair2, Pair3, Separation2, Separation3, separations3};
use asunder_scenes::pairs::{PosedPair2, PosedPair3};
use asunder_tests::report::peers::{Contact, double, single, unless_panic};
use core::cell::RefCell;

/// One query, whose cost is measured alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operation {
    /// Do they overlap?
    Boolean,
    /// Apart, or how deep?
    Separation,
    /// At which points do they touch?
    Manifold,
}

impl Operation {
    pub(super) const ALL: [Self; 3] = [Self::Boolean, Self::Separation, Self::Manifold];

    /// The name in rows.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "boolean",
            Self::Separation => "separation",
            Self::Manifold => "manifold",
        }
    }
}

/// A method's answer about a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Said {
    /// They share no point.
    Apart,
    /// They share a point; the depth is not given.
    Touching,
    /// They share a point, with this separation in metres, which is at most 0.
    Deep(f64),
    /// A NaN, a panic, or no answer.
    Refused,
}

impl Said {
    /// A separation as an answer; above zero it is a gap.
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

/// Pairs in a method's own form. The calls that are timed are those that are judged.
pub(super) trait Prepared {
    /// Appends an answer for each pair, in order.
    fn say(&self, said: &mut Vec<Said>);
}

/// A method.
pub(super) struct Method<P> {
    /// The name in rows.
    pub(super) name: &'static str,
    /// Converts pairs, before they are timed.
    pub(super) prepare: fn(&[P]) -> Box<dyn Prepared + '_>,
}

/// Pairs queried one by one. A panic counts as an answer: nothing that it leaves behind is used again.
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

fn said(overlapping: bool) -> Said {
    if overlapping { Said::Touching } else { Said::Apart }
}

fn of_separation3(found: &Separation3) -> Said {
    match found {
        Separation3::Measured(found) => Said::deep(Some(found.separation.into())),
        Separation3::AtLeast(_) => Said::Apart,
    }
}

fn of_separation2(found: &Separation2) -> Said {
    match found {
        Separation2::Measured(found) => Said::deep(Some(found.separation.into())),
        Separation2::AtLeast(_) => Said::Apart,
    }
}

/// All pairs in one call: cuboids go eight at a time, whatever is between them.
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
    let mut forms = Forms::default();
    let bodies = |pair| bodies3::<T>(pair, &mut forms);
    let world = RefCell::new(World::<T, 3>::default());
    one_by_one(pairs.iter().map(bodies).collect(), move |[a, b]| {
        Said::deep(world.borrow_mut().depth(a, b).map(|(depth, _)| -depth.into()))
    })
}

/// Both shapes of a pair in the textbook's form.
pub(super) fn bodies3<'a, T: Number>(
    pair: &'a PosedPair3,
    forms: &mut Forms<'a, Shape3, T, 3>,
) -> [Body<T, 3>; 2] {
    [(&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b)]
        .map(|(shape, pose)| Body::solid(shape, pose, forms))
}

fn bodies2<'a, T: Number>(pair: &'a PosedPair2, forms: &mut Forms<'a, Shape2, T, 2>) -> [Body<T, 2>; 2] {
    [(&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b)]
        .map(|(shape, pose)| Body::polygon(shape, pose, forms))
}

fn textbook2<T: Number + 'static>(pairs: &[PosedPair2]) -> Box<dyn Prepared + '_> {
    let mut forms = Forms::default();
    let bodies = |pair| bodies2::<T>(pair, &mut forms);
    let world = RefCell::new(World::<T, 2>::default());
    one_by_one(pairs.iter().map(bodies).collect(), move |[a, b]| {
        Said::deep(world.borrow_mut().depth(a, b).map(|(depth, _)| -depth.into()))
    })
}

/// Pairs in the peer's form, and the query for each; pairs that it does not accept are refused.
macro_rules! twins {
    ($peer:ident, $ask:expr) => {
        |pairs| one_by_one($peer::Twins::all(pairs), |twins| twins.as_ref().map_or(Said::Refused, $ask))
    };
}

/// The same for contact points, computed anew for each pair, in memory that is reused.
macro_rules! manifolds {
    ($peer:ident) => {
        |pairs| {
            let memory = RefCell::new(Vec::new());
            one_by_one($peer::Twins::all(pairs), move |twins: &Option<$peer::Twins>| {
                let mut memory = memory.borrow_mut();
                $peer::Twins::forget(&mut memory);
                twins.as_ref().map_or(Said::Refused, |twins| Said::of_peer(twins.manifold(&mut memory)))
            })
        }
    };
}

const TEXTBOOK3: [Method<PosedPair3>; 2] = [
    Method { name: "textbook-f32", prepare: textbook3::<f32> },
    Method { name: "textbook-f64", prepare: textbook3::<f64> },
];

const TEXTBOOK2: [Method<PosedPair2>; 2] = [
    Method { name: "textbook-f32", prepare: textbook2::<f32> },
    Method { name: "textbook-f64", prepare: textbook2::<f64> },
];

const FAST3: Method<PosedPair3> = Method {
    name: "fast",
    prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| said(pair3(pair).guess())),
};

const FAST2: Method<PosedPair2> = Method {
    name: "fast",
    prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| said(pair2(pair).guess())),
};

const CERTAIN3: Method<PosedPair3> = Method {
    name: "certain",
    prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| of_separation3(&pair3(pair).separation(0.0))),
};

const CERTAIN2: Method<PosedPair2> = Method {
    name: "certain",
    prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| of_separation2(&pair2(pair).separation(0.0))),
};

const PARRY: [Method<PosedPair3>; 2] = [
    Method { name: "parry-f32", prepare: twins!(single, |twins| Said::of_peer(twins.contact())) },
    Method { name: "parry-f64", prepare: twins!(double, |twins| Said::of_peer(twins.contact())) },
];

/// Pairs that can be queried by all methods of their dimension.
pub(super) trait Asked: Sized + 'static {
    /// Every method, in the order in which results are listed, asked "apart, or how deep?".
    fn methods() -> Vec<Method<Self>>;
    /// The methods for one query alone, on shapes of so many vertices; the textbook is left out where it would take
    /// long.
    fn methods_for(operation: Operation, vertices: usize) -> Vec<Method<Self>>;
}

impl Asked for PosedPair3 {
    fn methods() -> Vec<Method<Self>> {
        let batched = Method {
            name: "batched-boxes",
            prepare: |pairs| Box::new(AtOnce(pairs, RefCell::new(Vec::new()))),
        };
        TEXTBOOK3.into_iter().chain([FAST3, CERTAIN3, batched]).chain(PARRY).collect()
    }

    fn methods_for(operation: Operation, vertices: usize) -> Vec<Method<Self>> {
        let mut methods: Vec<Method<Self>> = Vec::new();
        if operation != Operation::Manifold && vertices <= 32 {
            methods.extend(TEXTBOOK3);
        }
        match operation {
            Operation::Boolean => methods.extend([
                FAST3,
                Method {
                    name: "certain",
                    prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| said(pair3(pair).overlaps())),
                },
                Method {
                    name: "parry-f32",
                    prepare: twins!(single, |twins| twins.overlaps().map_or(Said::Refused, said)),
                },
                Method {
                    name: "parry-f64",
                    prepare: twins!(double, |twins| twins.overlaps().map_or(Said::Refused, said)),
                },
            ]),
            Operation::Manifold => methods.extend([
                Method {
                    name: "certain",
                    prepare: |pairs| {
                        one_by_one(pairs.iter().collect(), |pair| {
                            let found = pair3(pair).manifold(0.0);
                            Said::deep(found.map(|manifold| manifold.separation.into()))
                        })
                    },
                },
                Method { name: "parry-f32", prepare: manifolds!(single) },
                Method { name: "parry-f64", prepare: manifolds!(double) },
            ]),
            Operation::Separation => {
                methods.push(CERTAIN3);
                methods.extend(PARRY);
            }
        }
        methods
    }
}

impl Asked for PosedPair2 {
    fn methods() -> Vec<Method<Self>> {
        TEXTBOOK2.into_iter().chain([FAST2, CERTAIN2]).collect()
    }

    fn methods_for(operation: Operation, vertices: usize) -> Vec<Method<Self>> {
        let mut methods: Vec<Method<Self>> = Vec::new();
        if operation != Operation::Manifold && vertices <= 512 {
            methods.extend(TEXTBOOK2);
        }
        match operation {
            Operation::Boolean => methods.extend([
                FAST2,
                Method {
                    name: "certain",
                    prepare: |pairs| one_by_one(pairs.iter().collect(), |pair| said(pair2(pair).overlaps())),
                },
            ]),
            Operation::Separation => methods.push(CERTAIN2),
            Operation::Manifold => methods.push(Method {
                name: "certain",
                prepare: |pairs| {
                    one_by_one(pairs.iter().collect(), |pair| {
                        let found = pair2(pair).manifold(0.0);
                        Said::deep(found.map(|manifold| manifold.separation.into()))
                    })
                },
            }),
        }
        methods
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_nan_and_a_panic_are_refusals_and_a_gap_is_no_depth() {
        let answers = [-0.5, f64::NAN, 0.25, 0.0, f64::INFINITY];
        let ask = |answer: &f64| {
            assert!(*answer < 1.0 || answer.is_nan(), "as a peer may");
            Said::deep(Some(*answer))
        };
        let mut said = Vec::new();
        one_by_one(answers.to_vec(), ask).say(&mut said);
        assert_eq!(said, [Said::Deep(-0.5), Said::Refused, Said::Apart, Said::Deep(0.0), Said::Refused]);
        assert_eq!(Said::of_peer(None), Said::Refused);
        assert_eq!(Said::of_peer(Some(None)), Said::Apart);
        let contact = Contact { separation: -0.5, normal: DVec3::X, points: 1 };
        assert_eq!(Said::of_peer(Some(Some(contact))), Said::Deep(-0.5));
        let without_normal = Contact { normal: DVec3::NAN, ..contact };
        assert_eq!(Said::of_peer(Some(Some(without_normal))), Said::Refused);
    }
}
