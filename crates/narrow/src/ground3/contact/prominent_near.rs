//! Which triangles have a prominent edge or corner near the part that has no contact yet.

use super::axes::Axes;
use super::facet::{Facet, edge_number};
use super::prism::Prism;
use super::whole::touching;
use super::{Known, PartTest};
use crate::feature::Feature;
use asunder_geometry::Prominent;
use asunder_geometry::glam::DVec3;

/// How the contacts of a triangle are found.
pub(super) enum Needs {
    /// Along its normal.
    Normal,
    /// Penetrating points along its normal, points across a gap by the kernels.
    KernelsBeside,
    Kernels,
}

/// How much of a triangle is covered by contacts found through its neighbours.
pub(super) enum Covered {
    /// All of it; a lower bound on its separation.
    Wholly(f64),
    /// Penetrating points only.
    WhereDeep,
}

impl PartTest<'_> {
    /// How the contacts of a triangle are found: by the kernels where a prominent edge or corner is so near that the
    /// triangle's normal may not be the answer. Where it is that near only because of the margin, the normal still is
    /// the answer for penetrating points.
    #[inline(never)]
    pub(super) fn needs(&self, prism: &Prism, prominent: Prominent) -> Needs {
        let Prism { ground, standing, facet, extent, .. } = *prism;
        let is_front = facet.is_front;
        // Where the part penetrates two-sided ground, edges that bend the other way may be where the ground ends for
        // it.
        let is_in = extent.low - standing.radius < -standing.slack && !ground.is_one_sided();
        if !(prominent.any(is_front) || is_in && prominent.any(!is_front)) {
            return Needs::Normal;
        }
        let mut is_corner = [0, 1, 2].map(|corner| prominent.corner(corner, is_front));
        if is_in {
            for (corner, stands_out) in is_corner.iter_mut().enumerate() {
                *stands_out = *stands_out
                    || prominent.corner(corner, !is_front)
                        && facet.sees_otherwise(ground, corner, standing.center);
            }
        }
        let square = |edge: usize| {
            let stands_out = prominent.edge(edge, is_front) || is_corner[edge] || is_corner[(edge + 1) % 3];
            if stands_out { facet.square_to_side(standing.center, edge) } else { f64::INFINITY }
        };
        let squares = [square(0), square(1), square(2)];
        let counts = are_within(squares, standing.outer_radius + self.query.reach + prism.doubt);
        if counts == [false; 3] || prism.is_short(counts) {
            return Needs::Normal;
        }
        if self.is_behind(prism) && self.is_for_margin_alone(prism, (squares, counts)) {
            return Needs::KernelsBeside;
        }
        Needs::Kernels
    }

    /// Whether without a margin, when fewer sides count, the triangle's normal would be the answer for penetrating
    /// points.
    #[inline]
    fn is_for_margin_alone(&self, prism: &Prism, (squares, counts): ([f64; 3], [bool; 3])) -> bool {
        let without = are_within(squares, self.standing.outer_radius + touching() + prism.doubt);
        without != counts && (without == [false; 3] || prism.is_short(without)) && self.is_in_ball(prism)
    }

    /// How much of a triangle is covered by a contact that a neighbour gave at a shared corner or edge: along the
    /// normal of that contact, nothing else of this triangle is within reach. Where the part may be deep in the
    /// triangle, only contacts that touch count, as they would without a margin.
    pub(super) fn covered(&self, (prism, axes): (&Prism, Option<&Axes>), known: &Known) -> Option<Covered> {
        let Prism { ground, standing, facet, doubt, .. } = *prism;
        let numbers = ground.vertex_numbers(facet.number);
        // Looked up once, and only where a point is on an edge.
        let mut edges = None;
        let (is_behind, mut is_where_deep) = (self.is_behind(prism), false);
        let is_apart = || standing.is_apart((facet, axes), touching() + 2.0 * doubt);
        let wholly = known.groups.find_on(|base, pin| {
            // One corner, or both ends of an edge.
            let (first, count) = match pin.of_ground {
                Feature::Vertex(vertex) => (numbers.iter().position(|&number| number == vertex), 1),
                Feature::Edge(edge) => {
                    let edges = edges
                        .get_or_insert_with(|| [0, 1, 2].map(|own| edge_number(ground, facet.number, own)));
                    (edges.iter().position(|&own| own == edge), 2)
                }
                Feature::Face(_) => return None,
            };
            let first = first?;
            let at = facet.corners[first];
            let low = standing.low(base.normal, at) - standing.radius;
            let height = |next: usize| base.normal.dot(facet.corners[(first + next) % 3] - at);
            let is_rest_beyond =
                |reach: f64| (count..3).all(|next| height(next) < 0.0 && low - height(next) > reach);
            // An edge need not be level to the last bit along the normal that it gave.
            let least = low - height(count - 1).max(0.0);
            let may_be_deep = is_behind && least <= doubt;
            if may_be_deep && pin.separation > touching() && !is_apart() {
                return None;
            }
            let is_wholly = is_rest_beyond(self.query.reach);
            is_where_deep |= may_be_deep && !is_wholly && is_rest_beyond(touching());
            is_wholly.then_some(Covered::Wholly(least))
        });
        wholly.or(is_where_deep.then_some(Covered::WhereDeep))
    }
}

/// Which sides of a triangle are no further than a radius, by the squares of their distances.
#[inline(always)]
fn are_within(squares: [f64; 3], radius: f64) -> [bool; 3] {
    let is_within = |side: usize| squares[side] <= radius * radius;
    [is_within(0), is_within(1), is_within(2)]
}

impl Facet {
    /// The square of how far a side is from a point.
    #[inline(always)]
    fn square_to_side(&self, point: DVec3, side: usize) -> f64 {
        let (from, along) = self.edge(side);
        let place = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (point - from - along * place).length_squared()
    }
}

impl Prism<'_> {
    /// Whether the triangle's normal is the answer by the fast path: the part's lowest vertex is well inside the edges
    /// that count.
    #[inline(always)]
    fn is_short(&self, counts: [bool; 3]) -> bool {
        let Self { standing, facet, extent, .. } = *self;
        let depth = -extent.low;
        let lowest = standing.point(extent.lowest);
        facet.is_over(lowest, standing.slack)
            && (depth <= 0.0 || facet.inside(lowest, |edge| counts[edge]) >= depth)
    }
}
