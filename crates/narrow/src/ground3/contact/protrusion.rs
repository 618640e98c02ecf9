//! What low bends, which give no normal of their own, may hide: how far ground may rise between the reported points.
//!
//! ```text
//! points along a triangle's normal cover what is over it, and where the ground ends or bends; but where a face rests
//!     on a ridge too low for that, the reported points are beside the ridge, and lower
//! for triangles with such a bend, and a reported normal:
//!     ground rises over the plane of that normal by no more than the sine of its slope times the distance (with bends
//!         so low the tangent is the sine, up to rounding), and so by no more than that sine times the part's diameter
//!     the separation is no less than the height of the part's lowest vertex over the triangle's plane, nor than the
//!         distance of the triangle's highest corner below a face of the part
//! ```
//! The lesser of the two goes into the error. It is zero on a plane, some 1e-8 of a body on a plane that was rotated as
//! a whole, so that its corners are rounded, and never more than what the tolerance for normals amounts to. Ground
//! further off along the same normal is other ground, like a stair beside the one that a crate stands on.
//!
//! Many low bends in a row may add up to more than that tolerance under one body. So the least separation of all is
//! compared with these bounds whatever their normals. Where they leave open as much as the slack, or where there were
//! more levels than are kept, the ground is searched again, and what was overlooked is reported (see `second_search`).

use super::Known;
use super::facet::is_same;
use super::groups::Group;
use super::prism::{Incident, Prism};
use arrayvec::ArrayVec;
use asunder_geometry::Prominent;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::SAME_NORMAL;

/// Most levels that are kept for a part.
const MOST_LEVELS: usize = 16;

/// Triangles of one normal, about as near as each other.
pub(super) struct Level {
    normal: DVec3,
    /// The least and the greatest lower bound on their separations, in metres.
    least: f64,
    most: f64,
    /// An upper bound on the sine of the angle between any of their normals and this one.
    slope: f64,
}

/// Lower bounds on the separations of triangles that have a bend too low to give a normal.
pub(super) struct Levels {
    levels: ArrayVec<Level, MOST_LEVELS>,
    /// There were more than are kept.
    pub(super) is_crowded: bool,
    /// A lower bound on all ground that matters for the least separation reported.
    pub(super) lowest: f64,
}

/// By how much bounds along the same normal may differ and count as the same ground, in metres.
pub(super) fn window(radius: f64) -> f64 {
    4.0 * SAME_NORMAL * radius
}

/// An upper bound on the sine of the angle between two unit vectors, without a root.
pub(super) fn sine(one: DVec3, other: DVec3) -> f64 {
    one.cross(other).abs().element_sum()
}

impl Level {
    fn add(&mut self, normal: DVec3, least: f64) {
        (self.least, self.most) = (self.least.min(least), self.most.max(least));
        self.slope = self.slope.max(sine(self.normal, normal));
    }
}

impl Levels {
    /// Not a constant: that would be copied as a whole.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { levels: ArrayVec::new_const(), is_crowded: false, lowest: f64::INFINITY }
    }

    /// The least bound above `floor`, if it is no less than `enough`. `None` where the ground must be searched again.
    pub(super) fn least_above(&self, floor: f64, enough: f64) -> Option<f64> {
        let mut least = f64::INFINITY;
        for level in self.levels.iter().filter(|level| level.most >= floor) {
            if level.least < enough {
                return None;
            }
            least = least.min(level.least);
        }
        (!self.is_crowded).then_some(least)
    }

    fn add(&mut self, normal: DVec3, least: f64, window: f64) {
        let is_its =
            |level: &&mut Level| (level.least - least).abs() <= window && is_same(level.normal, normal);
        if let Some(level) = self.levels.iter_mut().find(is_its) {
            return level.add(normal, least);
        }
        let level = Level { normal, least, most: least, slope: 0.0 };
        self.is_crowded |= self.levels.try_push(level).is_err();
    }
}

impl Known {
    /// Notes how near a triangle can be, if it has a bend too low to give a normal of its own.
    #[inline]
    pub(super) fn note_level(&mut self, prism: &Prism, prominent: Prominent) {
        if prominent.bends_low() {
            let least = prism.least_of_low(self.incident.as_ref());
            self.levels.add(prism.facet.normal, least, window(prism.standing.outer_radius));
        }
    }

    /// By how much the reported separation of a group may exceed the truth, for a part of this bounding radius. If it
    /// is the least of all (`least`), only the bound on that counts.
    pub(super) fn hidden(&self, (group, least): (&Group, f64), radius: f64) -> f64 {
        let (normal, reported) = (group.base.normal, group.recorded[0]);
        if reported as f32 <= least as f32 {
            return (reported - self.levels.lowest).max(0.0);
        }
        let most = |most: f64, level: &Level| {
            if reported - level.most > window(radius) || !is_same(level.normal, normal) {
                return most;
            }
            let slope = level.slope + sine(level.normal, normal);
            most.max(hidden_by(slope, (reported - level.least).min(window(radius)), radius))
        };
        self.levels.levels.iter().fold(group.hidden, most)
    }
}

/// By how much a reported separation may exceed the truth, given a bound that is less by `lower`, and a normal at an
/// angle of this sine to the reported one; zero where the bound belongs to other ground.
pub(super) fn hidden_by(sine: f64, lower: f64, radius: f64) -> f64 {
    if lower > window(radius) { 0.0 } else { lower.min(2.0 * sine * radius).max(0.0) }
}

impl Prism<'_> {
    /// A lower bound on the separation of part and triangle, by the triangle's plane and by the part's incident face.
    pub(super) fn least_of_low(&self, incident: Option<&Incident>) -> f64 {
        let standing = self.standing;
        let least = self.extent.low - standing.radius;
        if let Some(incident) = incident
            && let Some(outwards) = incident.outwards
            && !standing.solid.is_slender()
        {
            let [a, b, c] = self.facet.corners;
            let highest = outwards.dot(a).min(outwards.dot(b)).min(outwards.dot(c));
            let over = standing.solid.face_reach(incident.face, outwards) + standing.radius;
            return least.max(highest - over - standing.planarity) - self.doubt;
        }
        least - self.doubt
    }
}
