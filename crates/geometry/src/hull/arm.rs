//! How far the inscribed ball of a hull can be moved inside it.

use super::HullData;
use crate::tolerance::ARM_SHARE;
use glam::{DVec3, Vec3};

/// How many edges are tried, the longest first.
const TRIED: usize = 16;

impl HullData {
    /// Half of the longest segment about the centre, along an edge, on which a ball of [`ARM_SHARE`] of the inner
    /// radius stays inside the hull; zero if there is no such ball. A long and thin hull contains many balls nearly as
    /// large as the one in its middle.
    ///
    /// Cost: linear in the faces, and a sort of the edges.
    pub(super) fn longest_arm(&self) -> Vec3 {
        if self.inner_radius <= 0.0 || self.dimension < 3 {
            return Vec3::ZERO;
        }
        let at = |vertex: usize| self.vertices[vertex].as_dvec3();
        let along = |edge: &u16| {
            let (from, to) = self.topology.ends(usize::from(*edge));
            at(to) - at(from)
        };
        let mut edges: Vec<DVec3> = self.topology.edges().iter().map(along).collect();
        // Stable: edges of equal length stay in their order.
        edges.sort_by(|one, other| other.length_squared().total_cmp(&one.length_squared()));
        let mut best = (0.0, DVec3::ZERO);
        for edge in edges.into_iter().take(TRIED) {
            let Some(along) = edge.try_normalize() else { continue };
            let length = self.room_along(along);
            if length > best.0 {
                best = (length, along);
            }
        }
        let arm = (best.1 * best.0).as_vec3();
        if self.has_room_on(arm.as_dvec3()) { arm } else { Vec3::ZERO }
    }

    /// Whether the ball stays inside on the arm as rounded to f32. A needle leaves no room for rounding: an arm along a
    /// coordinate axis may be exactly parallel to its sides, any other is so only up to rounding.
    fn has_room_on(&self, arm: DVec3) -> bool {
        let center = self.center.as_dvec3();
        let lost = ARM_SHARE * f64::from(self.inner_radius) + f64::from(self.planarity_error);
        let mut faces = self.normals.iter().zip(&self.octets.heights);
        faces.all(|(normal, height)| normal.dot(arm).abs() <= height - normal.dot(center) - lost)
    }

    /// How far the ball can be moved from the centre along a direction, either way, in metres.
    fn room_along(&self, along: DVec3) -> f64 {
        let center = self.center.as_dvec3();
        // Faces are flat up to the planarity error, and the arm is rounded to f32.
        let lost = ARM_SHARE * f64::from(self.inner_radius)
            + f64::from(self.planarity_error)
            + 4.0 * f64::from(f32::EPSILON) * f64::from(self.outer_radius);
        let mut least = f64::from(self.outer_radius);
        for (normal, height) in self.normals.iter().zip(&self.octets.heights) {
            let spare = (height - normal.dot(center) - lost).max(0.0);
            let slope = normal.dot(along).abs();
            if slope * least > spare {
                least = spare / slope;
            }
        }
        least
    }
}
