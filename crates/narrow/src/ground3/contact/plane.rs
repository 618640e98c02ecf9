//! A half-space on ground: its single normal, and the corners of ground that reach furthest into it.

use super::facet::Facet;
use super::groups::{Base, Pin};
use super::{Known, PartTest};
use crate::feature::Feature;
use crate::ground3::Viewpoint;
use asunder_geometry::glam::DVec3;
use core::ops::ControlFlow;

impl PartTest<'_> {
    /// Processes all triangles, for a half-space with this unit normal in the ground's axes; only up to the first that
    /// it overlaps, if only yes or no is wanted.
    pub(super) fn look_at_all(&self, normal: DVec3, is_yes_enough: bool, known: &mut Known) {
        let ground = self.query.on.ground;
        let viewpoint = Viewpoint::Far(-normal);
        let _ = ground.visit_near(&self.bounds, |number| {
            if let Some(facet) = Facet::front_of(number, ground.corners(number))
                && (!ground.is_one_sided() || viewpoint.is_in_front(facet.corners[0], facet.normal))
            {
                self.add_corners(&facet, normal, known);
            }
            if known.overlapping && is_yes_enough {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
    }

    /// Adds the corners of a triangle that are within reach of a half-space.
    fn add_corners(&self, facet: &Facet, normal: DVec3, known: &mut Known) {
        let (ground, standing, number) = (self.query.on.ground, self.standing, facet.number);
        let (mut lowest, mut is_unclear) = (f64::INFINITY, false);
        for (corner, vertex) in facet.corners.into_iter().zip(ground.vertex_numbers(number)) {
            let height = normal.dot(corner - standing.center);
            let doubt = standing.doubt(corner);
            if height <= self.query.reach {
                self.add_corner(facet, (corner, vertex), normal, known);
            }
            if height < -doubt {
                known.settle(number);
            }
            lowest = lowest.min(height);
            is_unclear |= height <= doubt;
        }
        if is_unclear {
            self.leave_unclear(number, (false, lowest), known);
        }
    }

    /// Adds the corner of a triangle that reaches furthest into a half-space, where exact arithmetic says that they
    /// share a point, but rounding put all corners outside. A half-space has no lowest vertex to take instead.
    pub(super) fn add_lowest_corner(&self, number: u32, normal: DVec3, known: &mut Known) {
        let ground = self.query.on.ground;
        let Some(facet) = Facet::front_of(number, ground.corners(number)) else { return };
        let height = |(corner, _): &(DVec3, u32)| normal.dot(*corner - self.standing.center);
        let corners = facet.corners.into_iter().zip(ground.vertex_numbers(number));
        if let Some(lowest) = corners.min_by(|one, other| height(one).total_cmp(&height(other))) {
            self.add_corner(&facet, lowest, normal, known);
        }
    }

    fn add_corner(&self, facet: &Facet, (corner, vertex): (DVec3, u32), normal: DVec3, known: &mut Known) {
        let height = normal.dot(corner - self.standing.center);
        // From the ground to the body.
        let base = Base::along(-normal, self.query.on.ground.patch(facet.number));
        let pin = Pin {
            on_body: corner - normal * height,
            on_ground: corner,
            separation: height,
            doubt: self.standing.doubt(corner),
            of_body: Feature::Face(0),
            of_ground: Feature::Vertex(vertex),
        };
        known.groups.add(&base, pin);
    }
}
