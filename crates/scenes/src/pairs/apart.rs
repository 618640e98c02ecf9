//! Whether two convex hulls are apart: a rough test, used only to sort samples.

use glam::DVec3;

/// After this many steps two hulls are taken to overlap.
const STEPS: usize = 200;

/// True only if some axis separates the hulls of the two lists of points. May be false for a tiny gap.
///
/// Frank and Wolfe's method with pairwise steps (Lacoste-Julien and Jaggi, "On the global linear convergence of
/// Frank-Wolfe optimization variants", 2015) on the Minkowski difference: move weight from the worst corner in use to
/// the support point towards the origin, until a support plane has the origin beyond it.
pub(super) fn surely_apart(a: &[DVec3], b: &[DVec3]) -> bool {
    let mut nearest = b[0] - a[0];
    let mut corners = vec![(nearest, 1.0_f64)];
    for _ in 0..STEPS {
        let support = lowest(b, nearest) - lowest(a, -nearest);
        if nearest.dot(support) > 0.0 {
            return true;
        }
        let mut worst = 0;
        for (i, corner) in corners.iter().enumerate() {
            if corner.0.dot(nearest) > corners[worst].0.dot(nearest) {
                worst = i;
            }
        }
        let (corner, weight) = corners[worst];
        let way = support - corner;
        let square = way.dot(way);
        if square == 0.0 {
            return false;
        }
        let step = (-nearest.dot(way) / square).clamp(0.0, weight);
        nearest += way * step;
        corners[worst].1 -= step;
        if step == weight {
            corners.swap_remove(worst);
        }
        match corners.iter_mut().find(|(point, _)| *point == support) {
            Some(found) => found.1 += step,
            None => corners.push((support, step)),
        }
    }
    false
}

fn lowest(points: &[DVec3], axis: DVec3) -> DVec3 {
    let mut best = points[0];
    for &point in &points[1..] {
        if point.dot(axis) < best.dot(axis) {
            best = point;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubes_are_judged_rightly_up_to_a_small_gap() {
        let cube = |at: DVec3| -> Vec<DVec3> {
            let bit = |i: u32, k: u32| f64::from(i >> k & 1);
            (0..8).map(|i| at + DVec3::new(bit(i, 0), bit(i, 1), bit(i, 2))).collect()
        };
        let origin = cube(DVec3::ZERO);
        for gap in [1e-6, 1e-3, 0.02, 0.5] {
            assert!(surely_apart(&origin, &cube(DVec3::new(1.0 + gap, 0.3, -0.4))), "{gap}");
            assert!(!surely_apart(&origin, &cube(DVec3::new(1.0 - gap, 0.3, -0.4))), "{gap}");
        }
        assert!(!surely_apart(&origin, &origin));
    }
}
