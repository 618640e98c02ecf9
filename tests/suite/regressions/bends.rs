//! Ground that bends by less than rounding at its size.

use asunder::{Collider2, World2};
use asunder_geometry::{Capsule2, Chain, HalfSpace, Hull, Pose2, Pose3, Shape2, Shape3, TriMesh};
use asunder_narrow::{Pair2, Pair3, Separation3};
use asunder_tests::cases::Random;
use glam::{DVec3, Quat, Vec2, Vec3};

fn mesh(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Shape3 {
    TriMesh::new(vertices, triangles).unwrap().into()
}

/// Symptom: for a prism standing on a floor whose vertices are off by 1e-30 to 1e-15 m, the separation was positive and
/// the distance not `None`, though the two overlapped. Cause: triangles that were no nearer, within the error, than the
/// nearest so far were skipped, even where that one was a hair away and the skipped ones were touched.
#[test]
fn what_touches_one_triangle_and_is_a_hair_off_the_next_is_not_apart() {
    let mut random = Random::new(5);
    let prism = Shape3::from(Hull::prism(1.0, 0.5, 6).unwrap());
    let hairs = [0.0, 0.0, 1e-30, -1e-30, 1e-20, -1e-20, 1e-15, -1e-15];
    let corners = [[-1, -1], [0, -1], [-1, 0], [0, 0], [1, 0], [1, -1]];
    let (mut touched, mut apart) = (0, 0);
    for _ in 0..4000 {
        let vertex = |[x, z]: [i32; 2]| Vec3::new(x as f32, random.pick(&hairs), z as f32);
        let floor = mesh(corners.map(vertex).into(), vec![[0, 2, 1], [1, 2, 3], [1, 3, 4], [1, 4, 5]]);
        let mut along = || random.between(-1.2, 1.2);
        let at = Pose3::at(DVec3::new(along(), 1.0, along() - 0.5)).unwrap();
        let pair = Pair3::new(&floor, &Pose3::IDENTITY, &prism, &at);
        let do_overlap = pair.overlaps();
        let Separation3::Measured(measured) = pair.separation(f32::INFINITY) else {
            panic!("there is no limit")
        };
        assert_eq!(do_overlap, measured.separation <= 0.0, "{measured:?} at {at:?} of {floor:?}");
        assert_eq!(do_overlap, pair.distance().is_none(), "at {at:?} of {floor:?}");
        if do_overlap { touched += 1 } else { apart += 1 }
    }
    assert!(touched > 1000 && apart > 100, "{touched} {apart}");
}

/// Symptom: the contact of a half-space and a mesh of two long triangles panicked. Cause: by rounding, a point was on
/// both sides of the line through two others, and so occurred twice in the outline of the patch.
#[test]
fn a_corner_on_both_sides_of_a_line_is_one_corner() {
    let corners = [[0.0, 0.0, 0.0], [0.0, 1e6, 1e-7], [1e6, 1e-7, 0.0], [1.0, 0.0, 0.0]].map(Vec3::from);
    let ground = mesh(corners.into(), vec![[0, 1, 2], [0, 1, 3]]);
    let below = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    let turned = Pose3::new(DVec3::new(0.5, 0.3, 0.1), Quat::from_xyzw(0.1, 0.2, 0.3, 1.0)).unwrap();
    let manifolds = Pair3::new(&ground, &Pose3::IDENTITY, &below, &turned).manifolds(0.0);
    assert!(!manifolds.is_empty());
    for manifold in manifolds {
        let names: Vec<_> = manifold.points.iter().map(|point| point.feature).collect();
        let is_told_once = |place: usize| !names[..place].contains(&names[place]);
        assert!((0..names.len()).all(is_told_once), "{manifold:?}");
    }
}

/// Symptom: a capsule without a margin that was lifted off a chain by a hair never got its end event. Cause: by
/// rounding its points were within the margin of zero, and so it still had a contact.
#[test]
fn a_hair_above_a_chain_is_off_it() {
    let mut random = Random::new(7);
    let hairs = [0.0, 0.0, 1e-24, -1e-24, 1e-20, -1e-20, 1e-16, -1e-16, 1e-12, -1e-12];
    let pill = Shape2::from(Capsule2::from_half_height(0.25, 0.25).unwrap());
    let mut left = 0;
    for _ in 0..2000 {
        let points = [2.0, 1.0, 0.0, -1.0, -2.0].map(|x| Vec2::new(x, random.pick(&hairs)));
        let floor = Shape2::from(Chain::open(points).unwrap());
        let [x, hair] = [random.between(-2.2, 2.2), f64::from(random.pick(&hairs))];
        let [pressed, lifted] = [0.4, 0.5 + hair].map(|y| Pose2::at([x, y]).unwrap());
        let pair = Pair2::new(&floor, &Pose2::IDENTITY, &pill, &lifted);
        let do_overlap = pair.overlaps();
        assert_eq!(do_overlap, !pair.manifolds(0.0).is_empty(), "{floor:?} {lifted:?}");
        assert_eq!(do_overlap, pair.manifold(0.0).is_some(), "{floor:?} {lifted:?}");
        let mut world = World2::new();
        world.insert(Collider2::new(floor));
        let body = world.insert(Collider2::new(pill.clone()).at(pressed));
        world.update();
        let did_touch = !world.events().is_empty();
        world.set_pose(body, lifted).unwrap();
        world.update();
        assert_eq!(world.events().len(), usize::from(did_touch && !do_overlap), "{lifted:?}");
        left += world.events().len();
    }
    assert!(left > 100, "{left}");
}
