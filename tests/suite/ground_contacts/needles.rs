//! Bodies beside the rim of a triangle so thin that its long sides count as parallel.

use asunder_geometry::{Capsule3, Cuboid, Pose3, Shape3, TriMesh};
use asunder_narrow::Pair3;
use asunder_scenes::random::Random;
use glam::{DVec3, Vec3};

/// A triangle whose long side is along x through the origin, and whose apex is at z = `apex`.
fn triangle(apex: f32, is_one_sided: bool) -> Shape3 {
    let corners = [Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.0, 0.0, apex), Vec3::new(0.5, 0.0, 0.0)];
    let mesh = TriMesh::new(corners, [[0, 1, 2]]).unwrap();
    (if is_one_sided { mesh.one_sided() } else { mesh }).into()
}

/// Symptom: a body that reached some micrometres over the rim of a needle, and centimetres below it, was reported to be
/// centimetres deep, and to leave upwards. Cause: all of a needle is level, within tolerance, to the direction across
/// it, and so no side of it gave that direction.
#[test]
fn the_rim_of_a_needle_gives_what_that_of_a_stocky_triangle_does() {
    let mut random = Random::new(5);
    let bodies: [Shape3; 2] = [
        Cuboid::from_half_extents(Vec3::new(0.1, 0.08, 0.06)).unwrap().into(),
        Capsule3::from_half_height(0.08, 0.05).unwrap().into(),
    ];
    let mut checked = 0;
    for case in 0..400 {
        let is_one_sided = case % 2 == 0;
        let width = random.log_range(1e-6, 1e-3);
        let (needle, stocky) = (triangle(width as f32, is_one_sided), triangle(1.0, is_one_sided));
        let body = &bodies[case / 2 % 2];
        let over = width * random.range(0.02, 0.4);
        let furthest = body.support(DVec3::Z).unwrap().z;
        let low = -body.support(DVec3::NEG_Y).unwrap().y;
        let height = low * random.range(0.1, 0.55);
        let pose = Pose3::at(DVec3::new(random.range(-0.05, 0.05), height, over - furthest)).unwrap();
        let deepest = |ground: &Shape3| {
            let pair = Pair3::new(ground, &Pose3::IDENTITY, body, &pose);
            let mut all = Vec::new();
            pair.visit_manifolds(0.0, |manifold| all.push(*manifold));
            assert!(pair.overlaps(), "case {case}");
            all.into_iter()
                .min_by(|one, other| one.separation.total_cmp(&other.separation))
                .expect("it overlaps")
        };
        let [thin, wide] = [deepest(&needle), deepest(&stocky)];
        checked += usize::from((wide.normal - Vec3::NEG_Z).length() < 1e-3);
        assert!((thin.normal - wide.normal).length() < 1e-3, "case {case}, {width} m: {thin:?}, {wide:?}");
        let may = thin.error + wide.error;
        assert!((thin.separation - wide.separation).abs() <= may, "case {case}: {thin:?}, {wide:?}");
    }
    assert!(checked > 300, "{checked}");
}
