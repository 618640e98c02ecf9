//! Whether a hull holds a point: what its faces tell at once is what looking at every triangle tells.

use super::clouds::{Random, nasty};
use crate::hull::Hull;
use glam::DVec3;

#[test]
fn faces_tell_what_all_triangles_tell() {
    let (mut inside, mut outside) = (0, 0);
    for seed in 0..320 {
        let Ok(hull) = Hull::of_any_dimension(&nasty(seed)) else { continue };
        let size = hull.outer_radius();
        let hull = if seed % 2 == 0 { hull } else { hull.clone().rounded(0.1 * size).unwrap_or(hull) };
        let (radius, mut random) = (f64::from(hull.radius()), Random::new(seed));
        for round in 0..150 {
            // On a corner, an edge, a face or between, and beside it.
            let mut corner = || hull.vertices()[random.below(hull.vertices().len())].as_dvec3();
            let on = corner().lerp(corner(), [0.0, 0.25, 0.5][round % 3]);
            let on = on.lerp(corner(), [0.0, 0.0, 0.3, 0.5][round % 4]);
            let away = [0.0, 1e-16, 1e-12, 1e-7, 0.1, 0.5, 2.0][round % 7] * f64::from(size);
            let p = on + random.vector().as_dvec3() * away;
            let expected = match hull.dimension() < 3 && radius == 0.0 {
                true => hull.data.bears(p),
                false => hull.data.distance_outside(p) <= radius,
            };
            assert_eq!(hull.contains(p), expected, "{p} of seed {seed}");
            inside += u32::from(expected);
            outside += u32::from(!expected);
            assert!(!hull.contains(p.with_y(f64::NAN)) && !hull.contains(DVec3::NEG_INFINITY));
        }
    }
    assert!(inside > 10_000 && outside > 10_000, "{inside} inside, {outside} outside");
}
