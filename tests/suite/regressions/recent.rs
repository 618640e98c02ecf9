//! Queries about bodies inserted since the last query, which are in a list, and about others, which are in a tree.

use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Circle, Collider2, Collider3, Compound2, Compound3, Cuboid, Filter2, Filter3, Hull,
    Pair2, Pair3, Polygon, Pose2, Pose3, Shape2, Shape3, Sphere, World2, World3,
};

/// How far above the compound the moved shape passes, in metres. A cast may report a hit that near.
const GAPS: [f64; 5] = [1e-9, 1e-8, 1e-7, 3e-7, 1e-6];

/// Symptom: a cast that grazes a compound hit it or not, depending on whether the body was inserted before the last
/// query or after it. So a restored world, whose queries build their trees anew, could go on differently. Cause: a body
/// counts as met only where its box is met, so that no box in a tree is skipped wrongly; but for compounds that was the
/// box around their bounding sphere, which is larger than the one in the tree.
#[test]
fn a_compound_that_is_grazed_is_met_in_trees_and_lists_alike() {
    let bar = Capsule3::new(Vec3::new(0.0, 0.0, -0.5), Vec3::new(0.0, 0.0, 0.5), 1.0).unwrap();
    let parts = [3.0, -3.0].map(|z| (Pose3::at([0.0, 0.0, z]).unwrap(), Shape3::from(bar)));
    let below = Collider3::new(Compound3::new(parts).unwrap()).at(Pose3::at([0.0, -1.0, 0.0]).unwrap());
    let far = Collider3::new(Sphere::new(1.0).unwrap()).at(Pose3::at([0.0, 1e6, 0.0]).unwrap());
    // A hull: a cuboid's own face would show that it passes.
    let corners = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap().vertices();
    let shape = Shape3::from(Hull::from_points(&corners).unwrap().rounded(0.5).unwrap());
    let (way, filter, mut beside) = (Vec3::X * 30.0, Filter3::new(), 0);
    for gap in GAPS {
        let from = Pose3::at([-10.0, 1.0 + gap, 3.0]).unwrap();
        let (mut listed, mut both) = (World3::new(), World3::new());
        listed.insert(far.clone());
        assert!(listed.closest(DVec3::ZERO, 1.0, &filter).is_none(), "makes the tree");
        listed.insert(below.clone());
        both.insert(far.clone());
        both.insert(below.clone());
        let [one, other] = [&listed, &both].map(|world| world.cast_shape((&shape, &from), way, &filter));
        assert_eq!(one, other, "{gap}");
        let pair = Pair3::new(&shape, &from, below.shape(), below.pose());
        // Hits that only a box larger than the compound's own would let pass.
        beside += usize::from(one.is_none() && pair.cast(way).is_some());
    }
    assert!(beside > 0, "a test of nothing");
}

/// The same in the plane.
#[test]
fn a_flat_compound_that_is_grazed_is_met_in_trees_and_lists_alike() {
    let bar = Capsule2::new(Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5), 1.0).unwrap();
    let parts = [3.0, -3.0].map(|x| (Pose2::at([x, 0.0]).unwrap(), Shape2::from(bar)));
    let below = Collider2::new(Compound2::new(parts).unwrap()).at(Pose2::at([0.0, -1.5]).unwrap());
    let far = Collider2::new(Circle::new(1.0).unwrap()).at(Pose2::at([0.0, 1e6]).unwrap());
    // Of more edges than are tried one by one: a rectangle's own edge would show that it passes.
    let shape = Shape2::from(Polygon::regular(0.5, 8).unwrap().rounded(0.5).unwrap());
    let (way, filter, mut beside) = (Vec2::X * 30.0, Filter2::new(), 0);
    for gap in GAPS {
        let from = Pose2::at([-10.0, 1.0 + gap]).unwrap();
        let (mut listed, mut both) = (World2::new(), World2::new());
        listed.insert(far.clone());
        assert!(listed.closest(DVec2::ZERO, 1.0, &filter).is_none(), "makes the tree");
        listed.insert(below.clone());
        both.insert(far.clone());
        both.insert(below.clone());
        let [one, other] = [&listed, &both].map(|world| world.cast_shape((&shape, &from), way, &filter));
        assert_eq!(one, other, "{gap}");
        let pair = Pair2::new(&shape, &from, below.shape(), below.pose());
        // Hits that only a box larger than the compound's own would let pass.
        beside += usize::from(one.is_none() && pair.cast(way).is_some());
    }
    assert!(beside > 0, "a test of nothing");
}
