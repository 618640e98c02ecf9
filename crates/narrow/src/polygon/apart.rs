//! Closest points, where nothing else is asked about a pair.

use super::convex::Convex;
use super::distance::{Reached, Until, Witness, distance};
use super::tiers::unit;
use crate::precision::{at_least, signed};
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// A gap between two shapes that is certain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Apart {
    /// In metres; never zero.
    pub(crate) separation: f32,
    pub(crate) error: f32,
    /// Unit axis from A to B along which the gap is.
    pub(crate) normal: DVec2,
    /// Closest points of the shapes, in the frame of the pair.
    pub(crate) points: [DVec2; 2],
}

impl Convex<'_> {
    /// The closest points that [`Convex::probe`] would give, in the shortest way, without axes and edges; or, for
    /// shapes further apart than a limit, a lower bound on their distance. `None` where it takes the general way: for
    /// shapes that overlap or almost touch, for half-planes, and for two points.
    pub(crate) fn apart(&self, limit: f64) -> Option<Result<Apart, f32>> {
        if self.has_line() {
            return None;
        }
        let (precision, radii) = (&self.measure.precision, self.measure.radii);
        let beyond = limit + radii + precision.projection();
        self.with_outlines(|a, b| {
            if a.edge_count() + b.edge_count() == 0 {
                return None;
            }
            let until = Until { beyond, ..Until::met(precision) };
            let Reached::Between(witness) = distance(a, b, unit(self.towards_b()), &until) else {
                return None;
            };
            let Witness { distance, at_least: bound, normal, across, point_a, point_b, .. } = witness;
            if bound > beyond {
                return Some(Err(at_least(bound - radii, precision)));
            }
            let is_met = distance - bound <= 2.0 * DISTANCE_GAP * precision.size;
            let is_plain =
                is_met && !witness.is_close(precision.size) && bound - radii > precision.projection();
            if !is_plain {
                return None;
            }
            let (separation, gap) = precision.of_gap(distance, bound, radii);
            Some(Ok(Apart {
                separation: signed(separation, false),
                error: precision.of_distance(separation, gap),
                normal,
                points: self.measure.on_surfaces([point_a, point_b], across),
            }))
        })
    }
}
