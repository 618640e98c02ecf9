//! What bends that give no normal of their own may hide: how far ground may stand up between the points that are told.
//!
//! ```text
//! a triangle that speaks by its own normal tells of what stands over it, and where ground ends or bends; of a ridge too low
//!     for that, on which a face rests, the points that are told are beside it, and lower
//! triangles with such a bend, and the normal that is told:
//!     ground rises over the plane of that normal by no more than the sine of its slope against it times the way: by no more
//!         than that times the part's diameter
//!     the part is no nearer to a triangle than its lowest vertex is over its plane, nor than the triangle's highest corner is
//!         below a face of the part
//! ```
//! The lesser of both goes into the error. On a plane it is nothing, on one that was turned as a whole, so that its corners are
//! rounded, some 1e-8 of a body, and never more than the tolerance for normals makes of it. What lies further off along the same
//! normal is other ground, as a stair beside the one that a crate stands on. Many low bends in a row, which add up to more than that
//! tolerance under one body, are not seen.

use super::Known;
use super::facet::is_same;
use super::prism::Prism;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::SAME_NORMAL;

/// Most levels of one part that are kept.
const MOST_LEVELS: usize = 16;

/// Triangles of one normal.
pub(super) struct Level {
    normal: DVec3,
    /// A bound on how near any of them can be, in metres.
    least: f64,
    /// No less than the sine of the angle between any of their normals and this one.
    slope: f64,
}

pub(super) type Levels = ArrayVec<Level, MOST_LEVELS>;

/// How much a level may differ from another of the same normal and be of the same ground, in metres.
fn window(radius: f64) -> f64 {
    4.0 * SAME_NORMAL * radius
}

/// No less than the sine of the angle between two unit vectors, without a root.
fn sine(one: DVec3, other: DVec3) -> f64 {
    one.cross(other).abs().element_sum()
}

impl Known {
    /// Takes note of how near a triangle can be, if it has a bend too low to give a normal.
    pub(super) fn note_level(&mut self, prism: &Prism) {
        let standing = prism.standing;
        if !prism.facet.bends_low(prism.ground) {
            return;
        }
        let mut least = prism.extent.low - standing.radius;
        if let Some(incident) = &self.incident
            && let Some(outwards) = incident.outwards
            && !standing.solid.is_slender()
        {
            let [a, b, c] = prism.facet.corners;
            let highest = outwards.dot(a).min(outwards.dot(b)).min(outwards.dot(c));
            let over = standing.solid.face_reach(incident.face, outwards) + standing.radius;
            least = least.max(highest - over - standing.planarity);
        }
        let (normal, window) = (prism.facet.normal, window(standing.outer_radius));
        let is_its =
            |level: &&mut Level| (level.least - least).abs() <= window && is_same(level.normal, normal);
        if let Some(level) = self.levels.iter_mut().find(is_its) {
            level.least = level.least.min(least);
            level.slope = level.slope.max(sine(level.normal, normal));
        } else {
            let _ = self.levels.try_push(Level { normal, least, slope: 0.0 });
        }
    }

    /// By how much a separation that is told along a normal may exceed the truth, of a part of this bounding radius.
    pub(super) fn hidden(&self, normal: DVec3, told: f64, radius: f64) -> f64 {
        let mut most = 0.0;
        for Level { normal: other, least, slope } in &self.levels {
            let hidden = told - least;
            if hidden > most && hidden <= window(radius) && is_same(*other, normal) {
                let slope = slope + sine(*other, normal);
                most = hidden.min(2.0 * slope * radius).max(most);
            }
        }
        most
    }
}
