//! Whether last frame's direction parts two shapes still, before anything is made of them.
//!
//! Of the pairs of hulls in the air that a broad phase hands over, every third is apart along the direction that it was apart along in
//! the frame before. To find that out takes two furthest vertices. Axes, faces and edges of both shapes, put together for the kernels,
//! took three times as long as those. Here f32 lanes bound what they reach; which vertex it is nobody asks.

use super::{Asked, Convex, Probe};
use crate::polyhedron::solid::bound_of_reach;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;

impl Convex<'_> {
    /// What [`Convex::probe`] says of hulls and cuboids that the hinted direction parts by more than the limit; nothing of
    /// others. Cost: linear in the vertices.
    #[inline]
    pub(super) fn parted_as_before(&self, asked: Asked) -> Option<Probe> {
        let direction = asked.hint.direction()?;
        let of_a = most_of(self.shape_a, direction)?;
        let of_b = most_of(self.shape_b, self.relative.turn_back(-direction))?;
        let separation = direction.dot(self.offset) - of_b - of_a;
        let beyond = asked.limit + self.radii + self.precision.projection();
        (separation > beyond).then(|| self.beyond(separation, asked.hint))
    }
}

/// No less than how far the core of a hull or cuboid reaches along a direction in its own axes, rounding of f64 apart.
#[inline]
fn most_of(shape: &Shape3, direction: DVec3) -> Option<f64> {
    match shape {
        Shape3::Hull(_) => {
            let core = shape.core();
            Some(bound_of_reach(core.vertex_octets(), core.extent(), direction))
        }
        Shape3::Cuboid(cuboid) => Some(direction.abs().dot(cuboid.half_extents().as_dvec3())),
        _ => None,
    }
}
