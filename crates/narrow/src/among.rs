//! Which parts of a compound a question is about: if there are few, all; if many, those that the compound's tree finds.
//!
//! ```text
//! yes or no             in the tree's order, until a pair overlaps
//! how far               nearest parts first; of two of many parts, pairs no further apart than two known to be near
//! contacts              found by the tree, then in the order of the numbers: the same bits as by a loop over all parts
//! moved bodies          found along the way (in straight legs, if one turns), then as contacts
//! rays                  in the order in which boxes are met; of equals, the lowest number
//! ```
//! Every pair that is found is still tested for nearness, as in a loop: the tree only leaves out what no test would
//! take.
//!
//! Cubes of so many boxes and balls, a hair from touching; microseconds per question with loops and with trees, `cargo
//! run --release -p asunder-benches --bin parts` (AMD EPYC, Zen 4, 2026-11-25):
//!
//! | parts | 27 | 125 | 1,000 | 3,375 |
//! |---|---|---|---|---|
//! | a crate beside them, yes or no | 0.55 to 0.66 | 1.5 to 0.80 | 11 to 0.65 | 39 to 0.52 |
//! | and how far | 3.5 to 2.3 | 7.1 to 2.4 | 29 to 2.6 | 77 to 2.5 |
//! | two of them, yes or no | 2.5 to 1.2 | 24 to 2.2 | 840 to 11 | 7,200 to 17 |
//! | and how far | 15 to 5.5 | 133 to 8.9 | 5,200 to 29 | 48,000 to 47 |
//! | what a ray meets | 1.0 to 0.37 | 4.4 to 0.31 | 34 to 0.27 | 115 to 0.29 |

use crate::lists::with_list;
use asunder_geometry::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder_geometry::{Aabb2, Aabb3, Compound2, Compound3, Shape2, Shape3, round_down};
use core::cell::Cell;

/// From this many parts on, the compound's tree is used.
const MANY: usize = 16;

thread_local! {
    /// Lists of parts.
    static NUMBERS: Cell<Vec<Vec<u32>>> = const { Cell::new(Vec::new()) };
}

/// A compound in the plane with so many parts that its tree is used.
pub(crate) fn many2(shape: &Shape2) -> Option<&Compound2> {
    match shape {
        Shape2::Compound(compound) if compound.parts().len() >= MANY => Some(compound),
        _ => None,
    }
}

/// The same in space.
pub(crate) fn many3(shape: &Shape3) -> Option<&Compound3> {
    match shape {
        Shape3::Compound(compound) if compound.parts().len() >= MANY => Some(compound),
        _ => None,
    }
}

/// Visits what a walk finds in the order of the numbers, each once, until the visitor says to stop; returns whether it
/// did.
pub(crate) fn in_order(walk: impl FnOnce(&mut Vec<u32>), mut visit: impl FnMut(u32) -> bool) -> bool {
    with_list(&NUMBERS, |numbers| {
        walk(numbers);
        numbers.sort_unstable();
        numbers.dedup();
        numbers.iter().any(|&number| visit(number))
    })
}

/// Where the parts are that a question is about: within a radius of a point, in metres, relative to the body's
/// position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region<V> {
    pub(crate) center: V,
    /// Infinite for half-spaces, which are everywhere.
    pub(crate) radius: f64,
}

pub(crate) type Region2 = Region<DVec2>;
pub(crate) type Region3 = Region<DVec3>;

impl Region2 {
    /// Its radius, grown by more than rotations and all sums may have lost while it moves by `way`: a stored rotation
    /// stretches by its length, which is one up to the rounding of f32, and a part has two.
    pub(crate) fn grown(&self, way: DVec2, compound: &Compound2) -> f32 {
        let size = f64::from(compound.outer_radius()) + compound.center().as_dvec2().length();
        let lengths = self.center.length() + way.length() + self.radius + size;
        up(self.radius + 16.0 * f64::from(f32::EPSILON) * lengths)
    }

    /// The box around a region that is given in the compound's axes.
    pub(crate) fn bounds(&self, compound: &Compound2) -> Aabb2 {
        let grown = self.grown(DVec2::ZERO, compound);
        let [x, y] = self.center.to_array().map(|center| around(center, grown));
        Aabb2::new(Vec2::new(x[0], y[0]), Vec2::new(x[1], y[1]))
    }
}

impl Region3 {
    /// Its radius, grown by more than rotations and all sums may have lost while it moves by `way`.
    pub(crate) fn grown(&self, way: DVec3, compound: &Compound3) -> f32 {
        let size = f64::from(compound.outer_radius()) + compound.center().as_dvec3().length();
        let lengths = self.center.length() + way.length() + self.radius + size;
        up(self.radius + 256.0 * f64::EPSILON * lengths)
    }

    /// The box around a region that is given in the compound's axes.
    pub(crate) fn bounds(&self, compound: &Compound3) -> Aabb3 {
        let grown = self.grown(DVec3::ZERO, compound);
        let [x, y, z] = self.center.to_array().map(|center| around(center, grown));
        Aabb3::new(Vec3::new(x[0], y[0], z[0]), Vec3::new(x[1], y[1], z[1]))
    }
}

/// The smallest f32 that is not below `value`.
fn up(value: f64) -> f32 {
    -round_down(-value)
}

/// The interval around a centre on one axis.
fn around(center: f64, reach: f32) -> [f32; 2] {
    [round_down(center - f64::from(reach)), up(center + f64::from(reach))]
}
