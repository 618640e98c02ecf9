//! The answer for two solids of which only closest points are wanted.
//!
//! It is small, without axes, faces or edges: what else the kernels know of a pair is a kilobyte, and to write that
//! took a third of the time that the points took.

use super::distance::{Close, Reached, Witness};
use crate::precision::{Precision, at_least, signed};
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// Whether two solids have a gap between them.
pub(crate) enum Gap {
    /// A gap of at least this many metres, which is beyond the limit.
    Beyond(f32),
    Apart(Apart),
    Overlapping,
    /// It takes a closer look to decide.
    Unclear,
}

/// A gap between two solids, for certain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Apart {
    /// In metres; never zero.
    pub(crate) separation: f32,
    pub(crate) error: f32,
    /// Unit axis from A to B that shows the separation.
    pub(crate) normal: DVec3,
    /// Closest points of the shapes, in the frame of the pair.
    pub(crate) points: [DVec3; 2],
}

impl Gap {
    /// What the distance iteration has proved of two cores, given their radii.
    pub(super) fn of(reached: &Reached, radii: [f32; 2], beyond: f64, precision: &Precision) -> Self {
        let witness = match reached {
            Reached::Origin(Close { is_proved: true, .. }) => return Self::Overlapping,
            Reached::Origin(_) => return Self::Unclear,
            Reached::Between(witness) => witness,
        };
        let round = radii.map(f64::from);
        let radii = round[0] + round[1];
        let Witness { distance, at_least: bound, normal, across, point_a, point_b, .. } = *witness;
        if bound > beyond {
            return Self::Beyond(at_least(bound - radii, precision));
        }
        if radii > 0.0 && distance - radii < -2.0 * precision.projection() {
            return Self::Overlapping;
        }
        if !witness.is_plain(precision) || bound - radii <= precision.projection() {
            return Self::Unclear;
        }
        let (separation, gap) = precision.of_gap(distance, bound, radii);
        Self::Apart(Apart {
            separation: signed(separation, false),
            error: precision.of_distance(separation, gap),
            normal,
            points: [point_a + across * round[0], point_b - across * round[1]],
        })
    }
}

impl Witness {
    /// Whether the points suffice: both bounds meet, and the axis from one point to the other is not rounding.
    pub(super) fn is_plain(&self, precision: &Precision) -> bool {
        let size = precision.size;
        !self.is_close(size) && self.distance - self.at_least <= 2.0 * DISTANCE_GAP * size
    }
}
