//! Which triangles have an edge or a corner that stands out near the part, and has not been heard of yet.

use super::facet::{Facet, edge_number};
use super::prism::Prism;
use super::{Known, Seen};
use crate::feature::Feature;
use asunder_geometry::Prominent;

impl Seen<'_> {
    /// Whether an edge or corner that stands out is so near that the triangle's own normal may not be the answer.
    pub(super) fn needs_kernels(&self, prism: &Prism, prominent: Prominent) -> bool {
        let Prism { ground, standing, facet, extent, .. } = *prism;
        let is_front = facet.is_front;
        // Two-sided ground that the part is in may bend the other way, and end there all the same.
        let is_in = extent.low - standing.radius < -standing.slack && !ground.is_one_sided();
        if !(prominent.any(is_front) || is_in && prominent.any(!is_front)) {
            return false;
        }
        let radius = standing.outer_radius + self.asking.reach + prism.doubt;
        let is_near = |edge: usize| {
            let (from, along) = facet.edge(edge);
            let place = ((standing.center - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (standing.center - from - along * place).length_squared() <= radius * radius
        };
        let is_corner = |corner: usize| {
            prominent.corner(corner, is_front)
                || (is_in
                    && prominent.corner(corner, !is_front)
                    && facet.sees_otherwise(ground, corner, standing.center))
        };
        let is_corner = [is_corner(0), is_corner(1), is_corner(2)];
        let stands_out =
            |edge: usize| prominent.edge(edge, is_front) || is_corner[edge] || is_corner[(edge + 1) % 3];
        let counts = |edge: usize| stands_out(edge) && is_near(edge);
        let counts = [counts(0), counts(1), counts(2)];
        if counts == [false; 3] {
            return false;
        }
        // The short way.
        let depth = -extent.low;
        let lowest = standing.point(extent.lowest);
        let is_inside = facet.is_over(lowest, standing.slack);
        !(is_inside && (depth <= 0.0 || facet.inside(lowest, |edge| counts[edge]) >= depth))
    }

    /// How near a triangle is at least, if all that it has to say was said by another around the same corner, or beside
    /// the same edge: along the normal that it gave, nothing else of this one is within reach.
    pub(super) fn explained(&self, facet: &Facet, known: &Known) -> Option<f64> {
        let (ground, standing) = (self.asking.on.ground, self.standing);
        let numbers = ground.vertex_numbers(facet.number);
        known.groups.find_on(|base, feature| {
            // One corner, or both ends of an edge.
            let (first, count) = match feature {
                Feature::Vertex(vertex) => (numbers.iter().position(|&number| number == vertex), 1),
                Feature::Edge(edge) => {
                    ((0..3).find(|&own| edge_number(ground, facet.number, own) == edge), 2)
                }
                Feature::Face(_) => return None,
            };
            let first = first?;
            let at = facet.corners[first];
            let low = standing.extent(base.normal, at).low - standing.radius;
            let height = |next: usize| base.normal.dot(facet.corners[(first + next) % 3] - at);
            let is_rest_beyond =
                (count..3).all(|next| height(next) < 0.0 && low - height(next) > self.asking.reach);
            // An edge need not be level to the last bit along the normal that it gave.
            is_rest_beyond.then(|| low - height(count - 1).max(0.0))
        })
    }
}
