//! Finds whether any of many contacts has to do with a meeting, without a test of each contact for each meeting: a tree
//! of contacts, split by axis or separation.
//!
//! ```text
//! build    the median comes first, by the coordinate (of the axes, or the separation) that spreads furthest;
//!          then all that are below, then all that are above, each laid out likewise
//! query    test a contact itself; then, from how far at most the axes laid out behind it are from its own, and the
//!          range of their separations, whether one of them may qualify: where none may, all are skipped
//! ```
//! How far a body reaches along an axis changes by no more than the axis does, times the distance of its furthest point
//! from the origin: so what one axis shows is a bound for all that are near it.
//!
//! So a part that has nothing to do with what is touched costs the logarithm of the contacts, where few axes separate
//! the two bodies, and some hundred tests of thousands, where each contact has an axis of its own. What was found last
//! is tried first: the next part is beside this one.
//!
//! What two slabs of 64 x 64 cubes that lie on each other meet next, or two rows of 4,096 squares; milliseconds with a
//! test of each contact, and with the tree (Intel Xeon, 2.8 GHz, 2026-11-27, a busy machine; processor time):
//!
//! | | 64 x 64, squarely | 64 x 64, each tilted | 4,096, each tilted |
//! |---|---|---|---|
//! | contacts | 16,129 | 12,600 | 5,232 |
//! | pressed together, by more than half their thickness | 92 to 92 | 4,350 to 90 | 2,340 to 20 |
//! | and turned | 2,120 to 227 | 35,800 to 168 | 33,200 to 108 |
//! | slid along, a thousandth deeper | 92 to 88 | 76 to 81 | 12 to 12 |

use crate::answer::{Manifold2, Manifold3};
use crate::counted::count_step;
use crate::lists::{give_back, take_list};
use crate::touch::{Touch2, Touch3};
use asunder_geometry::glam::{DVec2, DVec3};
use core::cell::{Cell, OnceCell};

/// Up to this many contacts are always tested one by one.
const FEW: usize = 8;

/// This many queries test contacts one by one, however many there are: for fewer, the tree costs more to lay out than
/// it saves.
const SELDOM: u32 = 8;

thread_local! {
    /// Lists of contacts that are laid out as trees.
    static BUNDLES: Cell<Vec<Vec<Bundle>>> = const { Cell::new(Vec::new()) };
}

/// An axis of the plane or of space.
pub(crate) trait Axis: Copy {
    fn of(coordinates: [f64; 3]) -> Self;
    fn dot(self, other: Self) -> f64;
}

impl Axis for DVec2 {
    fn of([x, y, _]: [f64; 3]) -> Self {
        Self::new(x, y)
    }

    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
}

impl Axis for DVec3 {
    fn of(coordinates: [f64; 3]) -> Self {
        coordinates.into()
    }

    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
}

/// Anything with a unit axis from A to B, and a separation along it in metres.
pub(crate) trait AlongAxis {
    /// Axis and separation; `None` if they are not valid.
    fn along(&self) -> Option<([f64; 3], f64)>;
}

impl AlongAxis for Manifold2 {
    fn along(&self) -> Option<([f64; 3], f64)> {
        Some((self.normal.as_dvec2().extend(0.0).to_array(), self.separation.into()))
    }
}

impl AlongAxis for Manifold3 {
    fn along(&self) -> Option<([f64; 3], f64)> {
        Some((self.normal.as_dvec3().to_array(), self.separation.into()))
    }
}

impl AlongAxis for Touch2 {
    fn along(&self) -> Option<([f64; 3], f64)> {
        self.axis().map(|(axis, separation)| (axis.extend(0.0).to_array(), separation))
    }
}

impl AlongAxis for Touch3 {
    fn along(&self) -> Option<([f64; 3], f64)> {
        self.axis().map(|(axis, separation)| (axis.to_array(), separation))
    }
}

/// A contact, and bounds on those that are laid out behind it, its subtree, and skipped with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bundle {
    pub(crate) axis: [f64; 3],
    pub(crate) separation: f64,
    /// The furthest that another's axis is from its own.
    pub(crate) spread: f64,
    /// The least and the greatest separation of all.
    pub(crate) separations: [f64; 2],
    /// How many they are, the contact itself included.
    count: usize,
}

/// Whether a bundle holds a contact that is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Its own contact is one.
    Yes,
    /// Certainly none.
    No,
    /// Its own contact is none; one behind it may be.
    Perhaps,
}

/// Contacts that are queried again and again.
pub(crate) struct Contacts<'c, T> {
    all: &'c [T],
    /// A size of the bodies in metres: it makes differences of axes comparable to those of separations.
    size: f64,
    queries: Cell<u32>,
    /// The contact found last, which is often the one looked for next.
    found: Cell<Option<Bundle>>,
    /// The tree, built once that is worth it, in memory that the thread keeps.
    laid_out: OnceCell<Vec<Bundle>>,
}

impl<T> Drop for Contacts<'_, T> {
    fn drop(&mut self) {
        if let Some(list) = self.laid_out.take() {
            give_back(&BUNDLES, list);
        }
    }
}

impl<'c, T: AlongAxis> Contacts<'c, T> {
    /// For bodies of a size in metres.
    pub(crate) fn new(all: &'c [T], size: f32) -> Self {
        // Where both are endless, axes alone decide.
        let size = f64::from(size.min(f32::MAX));
        Self { all, size, queries: Cell::new(0), found: Cell::new(None), laid_out: OnceCell::new() }
    }

    /// Whether any contact is one that is looked for. Which of them is found first is unspecified: it depends on
    /// earlier queries.
    pub(crate) fn any(&self, holds: impl Fn(&Bundle) -> Holds) -> bool {
        let holds = |bundle: &Bundle| {
            count_step();
            holds(bundle)
        };
        if self.found.get().is_some_and(|found| holds(&found) == Holds::Yes) {
            return true;
        }
        let found = match self.all.len() <= FEW || self.queries.get() < SELDOM {
            true => bundles(self.all).find(|it| holds(it) == Holds::Yes),
            false => self.find(holds),
        };
        self.queries.set(self.queries.get().saturating_add(1));
        self.found.set(found.map(|found| found.alone()).or(self.found.get()));
        found.is_some()
    }

    /// The first match in the tree's order.
    fn find(&self, holds: impl Fn(&Bundle) -> Holds) -> Option<Bundle> {
        let mut left = self.laid_out.get_or_init(|| self.lay_out()).as_slice();
        while let Some(first) = left.first() {
            let passed = match holds(first) {
                Holds::Yes => return Some(*first),
                Holds::Perhaps if !first.is_one() => 1,
                Holds::Perhaps | Holds::No => first.count,
            };
            left = &left[passed..];
        }
        None
    }

    fn lay_out(&self) -> Vec<Bundle> {
        let mut list = take_list(&BUNDLES);
        list.extend(bundles(self.all));
        lay_out(&mut list, self.size);
        list
    }
}

fn bundles<T: AlongAxis>(all: &[T]) -> impl Iterator<Item = Bundle> {
    all.iter().filter_map(AlongAxis::along).map(|(axis, separation)| Bundle::of(axis, separation))
}

/// Lays contacts out as a tree, in place. Recurses as deep as the logarithm of their number.
fn lay_out(bundles: &mut [Bundle], size: f64) {
    let (count, middle) = (bundles.len(), bundles.len() / 2);
    if count < 2 {
        return;
    }
    let extents = [0, 1, 2, 3].map(|i| {
        let [least, most] = range(bundles, |bundle| bundle.coordinate(i));
        (most - least) * if i < 3 { size } else { 1.0 }
    });
    let widest = (1..4).fold(0, |widest, i| if extents[i] > extents[widest] { i } else { widest });
    bundles.select_nth_unstable_by(middle, |one, other| {
        one.coordinate(widest).total_cmp(&other.coordinate(widest))
    });
    bundles.swap(0, middle);
    let axis = DVec3::from(bundles[0].axis);
    let away = |bundle: &Bundle| DVec3::from(bundle.axis).distance_squared(axis);
    let spread = bundles.iter().map(away).fold(0.0, f64::max).sqrt() * (1.0 + 8.0 * f64::EPSILON);
    let separations = range(bundles, |bundle| bundle.separation);
    bundles[0] = Bundle { spread, separations, count, ..bundles[0] };
    // Equal contacts need no subtrees: one stands for all.
    if !bundles[0].is_one() {
        // The swap put the first contact at `middle`: it is no higher than the median.
        let (below, above) = bundles[1..].split_at_mut(middle);
        lay_out(below, size);
        lay_out(above, size);
    }
}

fn range(bundles: &[Bundle], of: impl Fn(&Bundle) -> f64) -> [f64; 2] {
    bundles.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
        [if value < least { value } else { least }, if value > most { value } else { most }]
    })
}

impl Bundle {
    /// A contact with none behind it.
    fn of(axis: [f64; 3], separation: f64) -> Self {
        Self { axis, separation, spread: 0.0, separations: [separation; 2], count: 1 }
    }

    fn alone(&self) -> Self {
        Self::of(self.axis, self.separation)
    }

    /// Whether all its contacts are equal.
    fn is_one(&self) -> bool {
        self.spread == 0.0 && self.separations[0] == self.separations[1]
    }

    /// A coordinate of the axis (0 to 2), or the separation.
    fn coordinate(&self, i: usize) -> f64 {
        self.axis.get(i).copied().unwrap_or(self.separation)
    }
}
