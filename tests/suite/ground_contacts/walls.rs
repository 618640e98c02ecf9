//! Floors that end at a wall: the manifold of a body over the floor has all its corners there, however near the wall
//! is, and none that the floor alone would not give. First seen as a hammer that fell beside a house and got a contact
//! at one corner of its head only.

use super::scenes::{Random, mesh};
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_narrow::{Manifold3, Pair3};

/// Two triangles of floor, and two of a wall at x = 1, if there is one.
fn corner(has_wall: bool) -> Shape3 {
    let (low, high) = ([[-2.0, 0.0, -2.0], [-2.0, 0.0, 2.0]], [[1.0, 1.5, -2.0], [1.0, 1.5, 2.0]]);
    let vertices: Vec<Vec3> =
        [low[0], low[1], [1.0, 0.0, 2.0], [1.0, 0.0, -2.0], high[0], high[1]].map(Vec3::from).to_vec();
    let triangles = [[0, 1, 2], [0, 2, 3], [3, 2, 5], [3, 5, 4]];
    let count = if has_wall { 4 } else { 2 };
    mesh((vertices, triangles[..count].to_vec())).into()
}

/// The manifold along the floor's normal.
fn on_floor(body: &Shape3, pose: &Pose3, ground: &Shape3, margin: f32) -> Option<Manifold3> {
    let told = Pair3::new(ground, &Pose3::IDENTITY, body, pose).manifolds(margin);
    told.into_iter().find(|manifold| manifold.normal.y > 1.0 - 1e-6)
}

fn points_on(body: &Shape3, pose: &Pose3, grounds: &[Shape3; 2], margin: f32) -> [usize; 2] {
    let count = |ground| on_floor(body, pose, ground, margin).map_or(0, |manifold| manifold.points.len());
    [count(&grounds[0]), count(&grounds[1])]
}

#[test]
fn a_crate_that_comes_down_beside_a_wall_is_told_by_all_its_corners() {
    let grounds = [corner(true), corner(false)];
    let crate_ = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.25, 0.2, 0.15)).unwrap());
    let turn = Quat::from_xyzw(-0.006_352_128_5, -0.007_711_402_6, -0.004_618_504, 0.999_939_44);
    let at = [0.730_920_577_173_649_1, 0.211_010_226_999_530_93, 1.916_380_015_940_273_3];
    let pose = Pose3::new(at, turn).unwrap();
    assert_eq!(points_on(&crate_, &pose, &grounds, 0.02), [4, 4]);
}

#[test]
fn a_wall_hides_no_corner_of_what_hangs_over_the_floor() {
    let grounds = [corner(true), corner(false)];
    let mut random = Random::new(2611);
    let (mut over, mut of_many) = (0, 0);
    for round in 0..12_000 {
        let half = DVec3::new(random.between(0.1, 0.4), random.between(0.1, 0.3), random.between(0.1, 0.4));
        let crate_ = Shape3::from(Cuboid::from_half_extents(half.as_vec3()).unwrap());
        let lean = [1e-4, 0.01, 0.3][round % 3];
        let [x, y, z] = (random.vector() * lean).to_array().map(|turn| turn as f32);
        let turn = Quat::from_xyzw(x, y, z, 1.0);
        let margin = [0.02, 0.1, 0.3][round / 3 % 3];
        let [x, z] = [0.9, 1.2].map(|most| random.between(0.0, most));
        let at = |height: f64| Pose3::new([x, height, z], turn).unwrap();
        let low = f64::from(crate_.bounds(&at(0.0), 0.0).min.y);
        let pose = at(random.between(0.0, f64::from(margin)) - low);
        if Pair3::new(&crate_, &pose, &grounds[0], &Pose3::IDENTITY).overlaps() {
            continue;
        }
        let [with_wall, alone] = points_on(&crate_, &pose, &grounds, margin);
        assert_eq!(with_wall, alone, "{pose:?} of {crate_:?}, within {margin}");
        over += usize::from(alone > 0);
        of_many += usize::from(alone > 2);
    }
    assert!(over > 6_000 && of_many > 3_000, "{over}, {of_many}");
}
