//! A cuboid and a triangle across a gap: their closest points in closed form, where ground rejects the direction from
//! one to the other.
//!
//! ```text
//! in the cuboid's axes, for each edge of the triangle: the point nearest to the cuboid                    (nearest_on)
//! the cuboid's vertex that is lowest over the triangle's plane, if its foot is in the triangle
//! the nearest of these four is checked: all vertices projected on the axis between its two points must show no less
//!     than their distance up to rounding; else the kernels are called
//! ground rejects that axis: no contact, and the closest points are all there is to keep; else the kernels make points
//! ```
//! A triangle is nearest to a cuboid on its rim, or under the cuboid's lowest feature. If that feature is an edge or a
//! face, either the foot of the vertex that is chosen here is in the triangle, or the feature reaches across the rim as
//! seen from above, and the rim is as near. On hills of triangles 24 of 39 kernel calls end here, for a cuboid that
//! rolls.

use super::axes::Axes;
use super::prism::Prism;
use super::rejected_gaps::ClosestPoints;
use crate::polyhedron::CLEAR_GAP;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::DISTANCE_GAP;

impl Prism<'_> {
    /// The closest points of a cuboid and the triangle across a gap, if ground rejects their direction and the two
    /// certainly share no point. `None` where the kernels must be called.
    pub(super) fn rejected_gap(&self, axes: &Axes) -> Option<ClosestPoints> {
        let (standing, facet) = (self.standing, self.facet);
        let Shape3::Cuboid(cuboid) = standing.part.shape else { return None };
        let half = cuboid.half_extents().as_dvec3();
        let normal = standing.place.axes.turn_back(facet.normal);
        let [on_cuboid, on_triangle] = nearest(&axes.corners, normal, half)?;
        let between = on_cuboid - on_triangle;
        let distance = between.length();
        let size = 2.0 * standing.outer_radius;
        if distance - standing.radius <= (CLEAR_GAP * size).max(self.doubt) {
            return None;
        }
        let towards = between / distance;
        let top = |corner: usize| towards.dot(axes.corners[corner]);
        let at_least = -half.dot(towards.abs()) - top(0).max(top(1)).max(top(2));
        let short = distance - at_least;
        if short.is_nan() || short > (DISTANCE_GAP * size).max(self.doubt) {
            return None;
        }
        let place = &standing.place;
        let direction = place.axes.turn(towards);
        if facet.lets_through(self.ground, direction) {
            return None;
        }
        let ends = [place.point(on_cuboid - towards * standing.radius), place.point(on_triangle)];
        Some(ClosestPoints::along(
            (self.ground, facet),
            direction,
            [distance - standing.radius, self.doubt + short.abs()],
            ends,
        ))
    }
}

/// The closest points of a cuboid with these half extents and of a triangle beside it, whose unit normal points towards
/// the cuboid, all in the cuboid's axes. `None` where the triangle reaches the cuboid.
fn nearest(corners: &[DVec3; 3], normal: DVec3, half: DVec3) -> Option<[DVec3; 2]> {
    let mut best = (f64::INFINITY, [DVec3::ZERO; 2]);
    let mut offer = |on_triangle: DVec3, on_cuboid: DVec3| {
        let square = (on_cuboid - on_triangle).length_squared();
        if square < best.0 {
            best = (square, [on_cuboid, on_triangle]);
        }
    };
    for edge in 0..3 {
        let (from, along) = (corners[edge], corners[(edge + 1) % 3] - corners[edge]);
        let at = from + along * nearest_on(from, along, half);
        offer(at, at.clamp(-half, half));
    }
    let lowest = half * DVec3::new(-normal.x.signum(), -normal.y.signum(), -normal.z.signum());
    let foot = lowest - normal * normal.dot(lowest - corners[0]);
    let is_inside = (0..3).all(|edge| {
        let (from, along) = (corners[edge], corners[(edge + 1) % 3] - corners[edge]);
        let third = corners[(edge + 2) % 3] - from;
        let inwards = normal.cross(along);
        // For either winding of the corners.
        inwards.dot(foot - from) * inwards.dot(third) >= 0.0
    });
    if is_inside {
        offer(foot, lowest);
    }
    (best.0 > 0.0 && best.0 < f64::INFINITY).then_some(best.1)
}

/// The fraction of a segment at which it is nearest to a cuboid with these half extents.
///
/// The squared distance is convex, and its slope is piecewise linear, with breaks where the segment crosses the planes
/// of the cuboid's faces: between the two breaks around the minimum it is a line.
fn nearest_on(from: DVec3, along: DVec3, half: DVec3) -> f64 {
    let slope = |share: f64| {
        let at = from + along * share;
        along.dot(at - at.clamp(-half, half))
    };
    let (mut low, mut high) = ((0.0, slope(0.0)), (1.0, slope(1.0)));
    if low.1 >= 0.0 {
        return 0.0;
    }
    if high.1 <= 0.0 {
        return 1.0;
    }
    let places = [(half - from) / along, (-half - from) / along];
    for share in places.into_iter().flat_map(|places| places.to_array()) {
        // NaN is not between.
        if share > low.0 && share < high.0 {
            let at = (share, slope(share));
            if at.1 < 0.0 { low = at } else { high = at }
        }
    }
    low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Numbers;

    #[test]
    fn the_nearest_points_are_as_near_as_any_of_a_fine_grid() {
        let mut numbers = Numbers::new(77);
        let (mut parted, mut by_foot) = (0, 0);
        for round in 0..3000 {
            // Coarse, so that edges lie along faces and planes.
            let mut vector = |scale: f64| {
                let any = numbers.vector() * scale;
                if round % 2 == 0 { (any * 2.0).round() * 0.5 } else { any }
            };
            let half = vector(1.0).abs() + 0.25;
            let shift = vector(2.0);
            let corners = [vector(1.5) + shift, vector(1.5) + shift, vector(1.5) + shift];
            let Some(normal) = (corners[1] - corners[0]).cross(corners[2] - corners[0]).try_normalize()
            else {
                continue;
            };
            let normal = if normal.dot(corners[0]) > 0.0 { -normal } else { normal };
            let mut grid = f64::INFINITY;
            for i in 0..=40 {
                for j in 0..=(40 - i) {
                    let (s, t) = (f64::from(i) / 40.0, f64::from(j) / 40.0);
                    let at = corners[0] + (corners[1] - corners[0]) * s + (corners[2] - corners[0]) * t;
                    grid = grid.min((at - at.clamp(-half, half)).length());
                }
            }
            // Where the plane passes through the cuboid, its lowest vertex is not the nearest point, nor claimed to be.
            let low = normal.dot(corners[0]) + half.dot(normal.abs());
            if grid < 0.2 || low > 0.0 && round % 3 == 0 {
                continue;
            }
            let Some([on_cuboid, on_triangle]) = nearest(&corners, normal, half) else { continue };
            let distance = (on_cuboid - on_triangle).length();
            parted += 1;
            assert!(distance <= grid + 1e-12, "{round}: {distance} where a point of the grid is at {grid}");
            assert!(grid - distance < 0.15, "{round}: {distance}, on the grid {grid}");
            by_foot += usize::from((on_cuboid - on_triangle).normalize().dot(normal) > 1.0 - 1e-9);
            assert!((on_cuboid - on_cuboid.clamp(-half, half)).length() < 1e-12, "{round}: on the cuboid");
            assert!(normal.dot(on_triangle - corners[0]).abs() < 1e-12, "{round}: on the triangle");
        }
        assert!(parted > 800 && by_foot > 20, "{parted}, {by_foot}");
    }
}
