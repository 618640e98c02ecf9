//! Two rectangles: four axes, and how far each shape reaches along them in closed form.
//!
//! ```text
//! C = A's x axis . B's x axis,  S = A's x axis . B's y axis,  both of the stored matrices, stretch and all
//! along A's x axis: separation = |offset . axis| - (|axis|^2 A.x + |C| B.x + |S| B.y), and so on
//! ```
//! Gottschalk, Lin and Manocha, "OBBTree" (1996), in the plane. That is the projection of all eight vertices.
//!
//! What is lost to rounding: C and S are sums of exact products, 1 u; a product, 1 u; three sums, 3 u; the offset, its
//! products and their sum, 4 u; the scale to unit length, 3 u: less than 10 u of the reach. An axis is the stored
//! direction itself, so its direction has no error. Parts' matrices and offsets add what they do everywhere.
//!
//! | trick | gain, rectangles of a broad phase, yes or no |
//! |---|---|
//! | closed form in place of eight dot products an axis | 103 ns to 52 |
//! | tested before a pair has been prepared for other kernels | 52 ns to 30 |
//!
//! `rect/mixed/manifold` of `compare` went from 130 ns to 97 (AMD EPYC, Zen 4, 2026-11-21; both beside other work).
//! What was saved are branches that cannot be predicted (which edge, which sign) and stalls: a load of 16 bytes that
//! were stored as two times 8 is not forwarded, and takes 5 ns or more. What bought what, in a bare loop over the same
//! pairs:
//!
//! | trick | gain |
//! |---|---|
//! | an edge's normal and sign are looked up, in constants | 120 ns to 105, and 95 to 92 |
//! | measures of a pair without asking what shapes they are | 105 to 103 |
//! | the offset between both goes to the kernel by value, in registers | 103 to 100; separation 50 to 37 |
//! | a gap is reported before normals are turned | apart: 36 to 27 |
//! | the edge that faces the reference, by two signs and one comparison | 90 to 85 |
//! | two contact points are stored once, in their order, not swapped | resting: 122 to 118 |
//!
//! Did not pay, since all of them copy points or ends through memory: choosing the reference shape by pointers, one
//! path for A and B (8 % slower); ordering the clipped ends before making points of them (15 % slower); points written
//! at computed places without branches (6 % slower); everything inlined into one function (8 % slower).

use super::outline::Turn;
use super::placed::Placed;
use super::sat::{Axes, Axis, AxisOf, Wanted};
use asunder_geometry::Rect;
use asunder_geometry::glam::DVec2;

/// The projections of two rectangles on the local axes of A and of B, x and y.
pub(crate) struct Rects {
    /// B's centre less A's, along each axis.
    offsets: [f64; 4],
    /// How far both reach along each axis, together.
    reaches: [f64; 4],
}

impl Rects {
    /// From the half extents of both, their rotations, and B's position less A's.
    #[inline]
    pub(crate) fn new([a, b]: [DVec2; 2], [turn_a, turn_b]: [&Turn; 2], offset: DVec2) -> Self {
        let ([a_x, a_y], [b_x, b_y]) = (turn_a.axes(), turn_b.axes());
        let (along, across) = (a_x.dot(b_x).abs(), a_x.dot(b_y).abs());
        let (stretch_a, stretch_b) = (a_x.length_squared(), b_x.length_squared());
        Self {
            offsets: [offset.dot(a_x), offset.dot(a_y), offset.dot(b_x), offset.dot(b_y)],
            reaches: [
                stretch_a * a.x + (along * b.x + across * b.y),
                stretch_a * a.y + (across * b.x + along * b.y),
                stretch_b * b.x + (along * a.x + across * a.y),
                stretch_b * b.y + (across * a.x + along * a.y),
            ],
        }
    }

    /// The greatest separation along any axis; axes are of unit length only up to an f32 rounding.
    #[inline]
    pub(crate) fn top(&self) -> f64 {
        let along = |axis: usize| self.offsets[axis].abs() - self.reaches[axis];
        let greater = |one: f64, other: f64| if other > one { other } else { one };
        greater(greater(along(0), along(1)), greater(along(2), along(3)))
    }

    /// The edge of a shape that faces the other along one of its axes; if two do, the lower one.
    #[inline]
    fn facing(&self, axis: usize) -> usize {
        let offset = self.offsets[axis];
        match axis {
            0 => {
                if offset >= 0.0 {
                    1
                } else {
                    3
                }
            }
            1 => {
                if offset > 0.0 {
                    2
                } else {
                    0
                }
            }
            2 => {
                if offset > 0.0 {
                    3
                } else {
                    1
                }
            }
            _ => {
                if offset >= 0.0 {
                    0
                } else {
                    2
                }
            }
        }
    }

    /// The axis that is normal to an edge, by shape and index. By table, since a branch on the edge cannot be
    /// predicted; and from constants, since vectors just put into an array by halves would stall the load.
    #[inline]
    fn axis(&self, of: AxisOf, turns: [&Turn; 2]) -> Axis {
        let (edge, which, sign) = match of {
            AxisOf::EdgeA(edge) => (edge % 4, 0, 1.0),
            AxisOf::EdgeB(edge) => (edge % 4, 1, -1.0),
        };
        let (turn, axis, outward) = (turns[which], 2 * which + (edge + 1) % 2, Rect::NORMALS[edge] * sign);
        let separation = outward.element_sum() * self.offsets[axis] - self.reaches[axis];
        Axis { separation: separation * turn.unit(), normal: turn.turn(outward * turn.unit()), of }
    }

    /// The best axis of one shape, whose first is number `first`: the edge, and the separation along its stored
    /// direction.
    #[inline]
    fn best(&self, first: usize) -> (usize, f64) {
        let along = |axis: usize| self.offsets[axis].abs() - self.reaches[axis];
        let (x, y) = (along(first), along(first + 1));
        let (edge_x, edge_y) = (self.facing(first), self.facing(first + 1));
        if (x > y) | ((x == y) & (edge_x < edge_y)) { (edge_x, x) } else { (edge_y, y) }
    }

    /// The best axis of each shape, and the hinted one if it is within the band; or an axis that shows more than the
    /// limit, which is reported before any normal is turned.
    #[inline]
    fn axes(&self, turns: [&Turn; 2], kept: Option<AxisOf>, wanted: &Wanted) -> Result<Axes, (f64, AxisOf)> {
        let ((edge_a, in_a), (edge_b, in_b)) = (self.best(0), self.best(2));
        let (of_a, of_b) = (AxisOf::EdgeA(edge_a), AxisOf::EdgeB(edge_b));
        let (in_a, in_b) = (in_a * turns[0].unit(), in_b * turns[1].unit());
        let best = if in_b > in_a { in_b } else { in_a };
        if best > wanted.limit {
            return Err((best, if in_b > in_a { of_b } else { of_a }));
        }
        let normal = |of: AxisOf| self.axis(of, turns).normal;
        let kept = kept.map(|of| self.axis(of, turns)).filter(|kept| kept.separation >= best - wanted.band);
        Ok(Axes {
            edge_a: Axis { separation: in_a, normal: normal(of_a), of: of_a },
            edge_b: Axis { separation: in_b, normal: normal(of_b), of: of_b },
            kept,
            short: wanted.precision.of_face(),
        })
    }
}

/// Finds the best axes of two rectangles, from the half extents of both, their rotations, B's position less A's, the
/// edge that the hint refers to, and what is wanted. An error is an axis that shows more than the limit.
#[inline]
pub(super) fn best_axes(
    halves: [DVec2; 2],
    turns: [&Turn; 2],
    offset: DVec2,
    (kept, wanted): (Option<AxisOf>, &Wanted),
) -> Result<Axes, (f64, AxisOf)> {
    Rects::new(halves, turns, offset).axes(turns, kept, wanted)
}

/// A rectangle in the frame of the pair.
pub(super) struct Corners {
    center: DVec2,
    /// Local axes of unit length, up to some roundings.
    axes: [DVec2; 2],
    /// Local axes scaled by the half extents, as the matrix turns and scales them.
    halves: [DVec2; 2],
    radius: f64,
}

impl Corners {
    #[inline]
    pub(super) fn new(half: DVec2, turn: &Turn, center: DVec2, radius: f64) -> Self {
        let ([x, y], unit) = (turn.axes(), turn.unit());
        Self { center, axes: [x * unit, y * unit], halves: [x * half.x, y * half.y], radius }
    }
}

impl Placed for Corners {
    #[inline]
    fn radius(&self) -> f64 {
        self.radius
    }

    #[inline]
    fn is_flat(&self) -> bool {
        false
    }

    #[inline]
    fn edge_count(&self) -> usize {
        4
    }

    #[inline]
    fn after(&self, vertex: usize) -> usize {
        (vertex + 1) % 4
    }

    #[inline]
    fn before(&self, vertex: usize) -> usize {
        (vertex + 3) % 4
    }

    #[inline]
    fn point(&self, vertex: usize) -> DVec2 {
        // Counter-clockwise from the lower left. By table, since a branch on the vertex cannot be predicted.
        const SIGNS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let [x, y] = SIGNS[vertex % 4];
        self.center + (self.halves[0] * x + self.halves[1] * y)
    }

    #[inline]
    fn outward(&self, edge: usize) -> DVec2 {
        // Edges face along -y, x, y and -x.
        const SIGNS: [f64; 4] = [-1.0, 1.0, 1.0, -1.0];
        self.axes[usize::from(edge.is_multiple_of(2))] * SIGNS[edge % 4]
    }

    #[inline]
    fn facing_edge(&self, normal: DVec2) -> usize {
        // Of the four edges two face the normal: across x and across y. If both do equally, the one that ends at the
        // deepest vertex.
        let (x, y) = (-normal.dot(self.axes[0]), -normal.dot(self.axes[1]));
        let (across_x, across_y) = (if x > 0.0 { 1 } else { 3 }, if y > 0.0 { 2 } else { 0 });
        let (steep, flat) = (x.abs(), y.abs());
        let is_even = (x >= 0.0) == (y > 0.0);
        if (steep > flat) | ((steep == flat) & is_even) { across_x } else { across_y }
    }

    #[inline]
    fn furthest(&self, direction: DVec2) -> usize {
        // Ties go to the lowest vertex.
        let (x, y) = (direction.dot(self.axes[0]), direction.dot(self.axes[1]));
        let below = usize::from(x > 0.0);
        let above = if x >= 0.0 { 2 } else { 3 };
        if y > 0.0 { above } else { below }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_geometry::Rotation2;

    #[test]
    fn the_facing_edge_is_the_one_found_vertex_by_vertex() {
        // All multiples of an eighth of a turn, and of a little more: ties and none.
        let directions = (-8_i32..=8).flat_map(|x| (-8_i32..=8).map(move |y| [x, y].map(f64::from)));
        let directions: Vec<DVec2> =
            directions.map(DVec2::from).filter_map(|direction| direction.try_normalize()).collect();
        let turns = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.6, 0.8], [1.0, 1.0]]
            .map(|[x, y]| Turn::of(Rotation2::new(x, y).unwrap()));
        let mut found = [0; 4];
        for turn in &turns {
            let corners = Corners::new(DVec2::new(0.5, 0.25), turn, DVec2::new(3.0, -2.0), 0.0);
            for &normal in &directions {
                let edge = corners.facing_edge(normal);
                assert_eq!(edge, corners.facing(corners.furthest(-normal), normal), "{normal}");
                found[edge] += 1;
            }
        }
        assert!(found.iter().all(|&count| count > 100), "{found:?}");
    }
}
