//! Bodies that lie across ridges: contacts with the slope on the other side.

use asunder::{
    Capsule3, Collider3, Cuboid, Filter3, Hull, Manifold3, Pair3, Pose3, Shape3, TriMesh, Triangle3, World3,
};
use asunder_geometry::glam::{Quat, Vec2, Vec3};
use asunder_geometry::{Ground, HeightField};
use asunder_tests::cases::Random;

/// Symptom: a plank that touches one slope of a roof was reported 0.18 m deep in the other, which is 6 cm away, and
/// `depenetrate` moved it by that. Cause: across the ridge it is behind that slope's plane, and counts as in front of
/// the ground; the depth of its lowest corner below that plane was reported, though the corner is nowhere near the
/// slope.
#[test]
fn a_plank_on_one_slope_of_a_roof_is_not_in_the_other() {
    let [one, other] = [-1.0, 1.0].map(|z| Vec3::new(0.0, 1.0, z));
    let (left, right) = (Vec3::NEG_X, Vec3::X);
    let roof = Shape3::from(TriMesh::new([one, other, left, right], [[0, 2, 1], [0, 1, 3]]).unwrap());
    let plank = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.25, 0.5, 0.75)).unwrap());
    let pose = Pose3::new([0.875, 1.375, 0.0], Quat::from_xyzw(1.0, 1.0, 1.0, 0.0)).unwrap();
    let slope = Shape3::from(Triangle3::new(one, left, other).unwrap());
    let distance = Pair3::new(&plank, &pose, &slope, &Pose3::IDENTITY).distance().unwrap();
    assert!((distance.distance - 0.0559).abs() < 1e-4);
    for margin in [0.0, 0.01, 0.05, 0.1, 1.0] {
        let told = Pair3::new(&plank, &pose, &roof, &Pose3::IDENTITY).manifolds(margin);
        assert!(!told.is_empty());
        for Manifold3 { separation, error, .. } in told {
            assert!(separation.abs() <= error || separation > 0.05, "{margin}: {separation} ± {error}");
        }
    }
    let mut world = World3::new();
    world.insert(Collider3::new(roof).fixed());
    let freed = world.depenetrate((&plank, &pose), &Filter3::new());
    assert!(freed.is_free && freed.moved.length() < 1e-3, "{freed:?}");
}

fn body(random: &mut Random) -> Shape3 {
    let mut half = || random.between(0.1, 0.8) as f32;
    let half = Vec3::new(half(), half(), half());
    match random.below(4) {
        0 => Capsule3::from_half_height(half.x, half.y).unwrap().into(),
        1 => Hull::prism(half.x, half.y, 5).unwrap().into(),
        _ => Cuboid::from_half_extents(half).unwrap().into(),
    }
}

/// Steep hills, one-sided or two-sided.
fn hills(random: &mut Random) -> HeightField {
    let heights: Vec<f32> = (0..25).map(|_| random.between(-0.6, 0.6) as f32).collect();
    let hills = HeightField::new(5, 5, heights, Vec2::ONE).unwrap();
    if random.below(3) == 0 { hills.one_sided() } else { hills }
}

/// The same at any margin, for bodies lowered onto hills and pressed in by up to 5 cm: where a penetration is reported
/// along the normal of a triangle, the body overlaps a triangle with that normal, as the exact test of bare triangles
/// decides.
#[test]
fn nothing_is_deep_in_a_slope_that_it_does_not_touch() {
    let mut random = Random::new(0x21D6E);
    let (mut deep, mut shallow) = (0, 0);
    for case in 0..12_000 {
        let (body, field) = (body(&mut random), hills(&mut random));
        let hills = Shape3::from(field);
        let at = [random.between(0.0, 4.0), 5.0, random.between(0.0, 4.0)];
        let above = Pose3::new(at, random.quaternion()).unwrap();
        let met = Pair3::new(&body, &above, &hills, &Pose3::IDENTITY).cast(Vec3::NEG_Y * 8.0);
        let Some(met) = met else { continue };
        let pressed = [0.001, 0.01, 0.05][case % 3];
        let pose = above.shifted([0.0, -8.0 * met.fraction - pressed, 0.0]).unwrap();
        let ground = Ground::of(&hills).unwrap();
        let triangles: Vec<Triangle3> =
            (0..ground.triangle_count()).filter_map(|number| ground.triangle(number)).collect();
        for margin in [0.0, 0.02, 0.1, 0.4] {
            for told in Pair3::new(&body, &pose, &hills, &Pose3::IDENTITY).manifolds(margin) {
                // With less depth, a part may be level with triangles beside the one that it is in.
                if told.separation > -(1.5 * pressed + 0.02) as f32 {
                    shallow += 1;
                    continue;
                }
                let normal = told.normal.as_dvec3();
                let mut own = triangles.iter().filter(|one| one.normals()[0].dot(normal).abs() > 0.9999);
                let is_in = |one: &Triangle3| {
                    let bare = Shape3::from(*one);
                    Pair3::new(&body, &pose, &bare, &Pose3::IDENTITY).overlaps()
                };
                let is_of_a_face = own.clone().next().is_some();
                assert!(
                    !is_of_a_face || own.any(is_in),
                    "{case}, margin {margin}: {body:?} {pose:?} {told:?}"
                );
                deep += usize::from(is_of_a_face);
            }
        }
    }
    assert!(deep > 0 && shallow > 20_000, "{deep} deep, {shallow} shallow");
}

/// Symptom: a box over the rim of a floor was reported 0.17 m deep in it, but moving straight up it came clear after
/// 0.55. Cause: the box's lowest vertex lies under the next triangle of the floor, which the box does not touch: its
/// lower end is below and beside the whole floor.
#[test]
fn a_box_over_the_rim_of_a_floor_is_told_how_deep_it_is_in_all_of_it() {
    let cell = Vec2::new(1.656_013_5, 1.067_561);
    let floor = Shape3::from(HeightField::new(8, 8, [0.0; 64], cell).unwrap());
    let half = Vec3::new(0.759_268_94, 0.182_277_43, 0.991_009_7);
    let body = Shape3::from(Cuboid::from_half_extents(half).unwrap());
    let turned = Quat::from_xyzw(-0.247_512_07, -0.421_208_14, -0.047_975_574, -0.473_221_3);
    let pose = Pose3::new([0.166_218_44, 0.407_981_41, 1.160_412_9], turned).unwrap();
    for margin in [0.0, 0.01, 0.3, 3.0] {
        let told = Pair3::new(&body, &pose, &floor, &Pose3::IDENTITY).manifolds(margin);
        let upwards = told.iter().find(|told| told.normal.y < -0.999).expect("it stands on the floor");
        let clear = |depth: f64| {
            let moved = pose.shifted([0.0, depth, 0.0]).unwrap();
            !Pair3::new(&body, &moved, &floor, &Pose3::IDENTITY).overlaps()
        };
        let depth = -f64::from(upwards.separation);
        assert!(clear(depth + 1e-6) && !clear(depth - 1e-6), "{margin}: {upwards:?}");
    }
}

/// Symptom: of 25,000 bodies stuck in hills, 768 were reported deeper, or less deep, by up to a metre with a margin of
/// 3 m than without one. Causes:
/// - an edge beyond the body that came within the margin sent a triangle down another path
/// - points within the margin explained triangles that the body overlaps, or freed them
/// - for a triangle that the body does not touch, but which is within the margin, the depth behind its plane was
///   reported
#[test]
fn what_is_deep_does_not_depend_on_the_margin() {
    let mut random = Random::new(0x3A261);
    let mut deep = 0;
    for case in 0..4_000 {
        let (body, hills) = (body(&mut random), Shape3::from(hills(&mut random)));
        let at = [random.between(0.0, 4.0), random.between(-0.7, 0.7), random.between(0.0, 4.0)];
        let pose = Pose3::new(at, random.quaternion()).unwrap();
        let pair = Pair3::new(&body, &pose, &hills, &Pose3::IDENTITY);
        let deepest = |margin: f32| {
            let told = pair.manifolds(margin);
            let deepest = told.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
            deepest.map(|told| (told.separation, told.error))
        };
        let Some((least, error)) = deepest(0.0) else { continue };
        deep += 1;
        for margin in [0.01, 0.3, 3.0] {
            let (same, its) = deepest(margin).expect("more is within it");
            let off = (same - least).abs();
            assert!(off <= error + its + 1e-6, "{case}, {margin}: {same}, not {least}; {body:?} {pose:?}");
        }
    }
    assert!(deep > 2_000, "{deep}");
}

/// Symptom: for a crate in the end of a wall, penetrating along the normal of the wall's side, margins of 0.3 m and
/// more gave a second penetrating normal, that of the end; with 3 m, for 25 of 25,118 random bodies. Cause: a contact
/// with the side explains the end at their common corner, so that only the part of the end within the margin is left,
/// which waits until all triangles have been processed; the rim vertices of the end inside the crate were then added,
/// deep or not.
#[test]
fn a_larger_margin_tells_no_other_normals_as_deep() {
    let body = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.47, 0.15, 0.78)).unwrap());
    let pose = Pose3::new([0.5, 0.52, 0.17], Quat::from_xyzw(0.14, 0.63, -0.37, -0.66)).unwrap();
    let corner = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let side = [corner(0.0, -1.27, 0.0), corner(0.0, 1.27, 0.0), corner(3.0, 1.27, 0.0)];
    let end = [corner(0.0, -1.27, -0.45), corner(0.0, 1.27, -0.45)];
    let wall = Shape3::from(
        TriMesh::new([side.as_slice(), &end].concat(), [[0, 2, 1], [3, 0, 1], [3, 1, 4]]).unwrap(),
    );
    for margin in [0.0, 0.01, 0.3, 3.0] {
        let told = Pair3::new(&body, &pose, &wall, &Pose3::IDENTITY).manifolds(margin);
        let deep: Vec<Vec3> =
            told.iter().filter(|told| told.separation < 0.0).map(|told| told.normal).collect();
        assert_eq!(deep, [Vec3::NEG_Z], "{margin}");
    }
}
