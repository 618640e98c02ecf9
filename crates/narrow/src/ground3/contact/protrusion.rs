//! What bends that give no normal of their own may hide: how far ground may stand up between the points that are told.
//!
//! ```text
//! a triangle that speaks by its own normal tells of what stands over it, and where ground ends or bends; of a ridge too low
//!     for that, on which a face rests, the points that are told are beside it, and lower
//! triangles with such a bend, and the normal that is told:
//!     ground rises over the plane of that normal by no more than the sine of its slope against it times the way, which is the
//!         tangent up to rounding where bends are as low as that: by no more than that times the part's diameter
//!     the part is no nearer to a triangle than its lowest vertex is over its plane, nor than the triangle's highest corner is
//!         below a face of the part
//! ```
//! The lesser of both goes into the error. On a plane it is nothing, on one that was turned as a whole, so that its
//! corners are rounded, some 1e-8 of a body, and never more than the tolerance for normals makes of it. What lies
//! further off along the same normal is other ground, as a stair beside the one that a crate stands on.
//!
//! Many low bends in a row may add up to more than that tolerance under one body. So what is told as the least of all
//! is held against these bounds whatever their normals; where they leave open as much as the slack, ground is gone
//! through once more, and what was overlooked is told (see `overlooked`). So it is, too, where there are more levels
//! than are kept.

use super::Known;
use super::facet::is_same;
use super::groups::Group;
use super::prism::{Incident, Prism};
use arrayvec::ArrayVec;
use asunder_geometry::Prominent;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::SAME_NORMAL;

/// Most levels of one part that are kept.
const MOST_LEVELS: usize = 16;

/// Triangles of one normal.
pub(super) struct Level {
    normal: DVec3,
    /// Bounds on how near the nearest of them can be, and the furthest, in metres.
    least: f64,
    most: f64,
    /// No less than the sine of the angle between any of their normals and this one.
    slope: f64,
}

/// Bounds on how near triangles can be that have a bend too low to give a normal.
pub(super) struct Levels {
    levels: ArrayVec<Level, MOST_LEVELS>,
    /// There were more than are kept.
    pub(super) is_crowded: bool,
    /// A bound on all ground that counts for what is told as the least of all.
    pub(super) lowest: f64,
}

/// How much a level may differ from another of the same normal and be of the same ground, in metres.
pub(super) fn window(radius: f64) -> f64 {
    4.0 * SAME_NORMAL * radius
}

/// No less than the sine of the angle between two unit vectors, without a root.
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
    /// Not a constant: that would be copied, blanks and all.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { levels: ArrayVec::new_const(), is_crowded: false, lowest: f64::INFINITY }
    }

    /// The least bound above `floor`, where that is no less than is enough. Nothing where more must be known.
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
    /// Takes note of how near a triangle can be, if it has a bend too low to give a normal that is not its own.
    #[inline]
    pub(super) fn note_level(&mut self, prism: &Prism, prominent: Prominent) {
        if prominent.bends_low() {
            let least = prism.least_of_low(self.incident.as_ref());
            self.levels.add(prism.facet.normal, least, window(prism.standing.outer_radius));
        }
    }

    /// By how much a separation that is told of a group may exceed the truth, of a part of this bounding radius. What
    /// is as near as the least of all, which is given, exceeds nothing but the bound on that.
    pub(super) fn hidden(&self, (group, least): (&Group, f64), radius: f64) -> f64 {
        let (normal, told) = (group.base.normal, group.told[0]);
        if told as f32 <= least as f32 {
            return (told - self.levels.lowest).max(0.0);
        }
        let most = |most: f64, level: &Level| {
            if told - level.most > window(radius) || !is_same(level.normal, normal) {
                return most;
            }
            let slope = level.slope + sine(level.normal, normal);
            most.max(hidden_by(slope, (told - level.least).min(window(radius)), radius))
        };
        self.levels.levels.iter().fold(group.hidden, most)
    }
}

/// By how much what is told may exceed the truth, by a bound that is so much lower, and a normal that leans against the
/// one that was told by an angle of that sine; nothing where it is of other ground.
pub(super) fn hidden_by(sine: f64, lower: f64, radius: f64) -> f64 {
    if lower > window(radius) { 0.0 } else { lower.min(2.0 * sine * radius).max(0.0) }
}

impl Prism<'_> {
    /// A bound on how near the part can be to the triangle, by the triangle's plane and by the face that the part turns
    /// to it.
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
