//! A half-space that lies on ground: its one normal, and the corners of ground that reach furthest into it.

use super::facet::Facet;
use super::groups::{Base, Pin};
use super::{Known, Seen};
use crate::feature::Feature;
use asunder_geometry::glam::DVec3;
use core::ops::ControlFlow;

impl Seen<'_> {
    /// Looks at all triangles, for a half-space whose unit normal this is in the ground's axes.
    pub(super) fn look_at_all(&self, normal: DVec3, known: &mut Known) {
        let (ground, standing) = (self.asking.on.ground, self.standing);
        let _ = ground.visit_near(&self.bounds, |number| {
            let Some(facet) = Facet::seen(ground, number, standing.center) else {
                return ControlFlow::Continue(());
            };
            let numbers = ground.vertex_numbers(number);
            for (corner, vertex) in facet.corners.into_iter().zip(numbers) {
                let height = normal.dot(corner - standing.center);
                let doubt = standing.doubt(corner);
                if height > self.asking.reach + doubt {
                    continue;
                }
                // From the ground to the body.
                let base = Base { normal: -normal, patch: ground.patch(number), weight: 0.0 };
                let pin = Pin {
                    on_body: corner - normal * height,
                    on_ground: corner,
                    separation: height,
                    doubt,
                    of_body: Feature::Face(0),
                    of_ground: Feature::Vertex(vertex),
                };
                if height <= self.asking.reach {
                    known.groups.add(&base, pin);
                }
                if height < -doubt {
                    known.settle(number);
                } else if height <= doubt && !known.overlapping {
                    self.doubt_of(number, (false, height), known);
                }
            }
            ControlFlow::Continue(())
        });
    }
}
