//! From any number of contact points to four that hold a body as well.
//!
//! ```text
//! 1 the deepest: without it the depth would be wrong
//! 2 the furthest from it
//! 3 the one that makes the largest triangle with both
//! 4 the one furthest out beyond any side of that triangle
//! ```
//! Gregorius, "Robust contact creation for physics simulations" (GDC 2015). Ties go to the lowest feature id.

use super::manifold::Point;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// Up to four of the points, in order of their feature ids. Areas are seen along `normal`.
pub(super) fn reduce_to_four(points: &[Point], normal: DVec3) -> ArrayVec<Point, 4> {
    let mut kept: ArrayVec<Point, 4> = ArrayVec::new();
    if points.len() <= 4 {
        kept.extend(points.iter().copied());
    } else {
        let at = |i: usize| points[i].on_a;
        let doubled_area = |i: usize, j: usize, k: usize| (at(j) - at(i)).cross(at(k) - at(i)).dot(normal);
        let first = best(points, |i| -points[i].separation);
        let second = best(points, |i| (at(i) - at(first)).length_squared());
        let third = best(points, |i| doubled_area(first, second, i).abs());
        let sense = doubled_area(first, second, third).signum();
        let triangle = [first, second, third];
        let beyond = |i: usize| {
            let side = |k: usize| -sense * doubled_area(triangle[k], triangle[(k + 1) % 3], i);
            side(0).max(side(1)).max(side(2))
        };
        let fourth = best(points, beyond);
        let mut chosen = [first, second, third, fourth];
        chosen.sort_unstable();
        for (place, &i) in chosen.iter().enumerate() {
            if !chosen[..place].contains(&i) {
                kept.push(points[i]);
            }
        }
    }
    kept.sort_unstable_by_key(|point| point.feature);
    kept
}

/// The index with the greatest score; ties go to the lowest feature id.
fn best(points: &[Point], score: impl Fn(usize) -> f64) -> usize {
    let better = |&i: &usize, &j: &usize| {
        score(i).total_cmp(&score(j)).then_with(|| points[j].feature.cmp(&points[i].feature))
    };
    (0..points.len()).max_by(better).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::{Feature, FeatureId};

    fn points(places: &[(f64, f64, f64)]) -> Vec<Point> {
        let point = |(i, &(x, y, separation)): (usize, &(f64, f64, f64))| Point {
            separation,
            on_a: DVec3::new(x, y, 0.0),
            on_b: DVec3::new(x, y, separation),
            feature: FeatureId::new(Feature::Face(0), Feature::Vertex(i as u32)),
        };
        places.iter().enumerate().map(point).collect()
    }

    #[test]
    fn keeps_the_corners_and_the_deepest() {
        let square_and_more = points(&[
            (0.0, 0.0, -1.0),
            (2.0, 0.1, -1.0),
            (4.0, 0.0, -1.0),
            (4.0, 4.0, -1.0),
            (0.0, 4.0, -1.0),
        ]);
        let kept: Vec<u64> =
            reduce_to_four(&square_and_more, DVec3::Z).iter().map(|p| p.feature.to_bits() & 7).collect();
        assert_eq!(kept, [0, 2, 3, 4]);
        let deep_middle = points(&[
            (0.0, 0.0, -1.0),
            (2.0, 2.0, -3.0),
            (4.0, 0.0, -1.0),
            (4.0, 4.0, -1.0),
            (0.0, 4.0, -1.0),
        ]);
        assert!(reduce_to_four(&deep_middle, DVec3::Z).iter().any(|p| p.separation == -3.0));
    }
}
