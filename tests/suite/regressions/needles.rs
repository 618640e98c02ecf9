//! Needles and knife edges: shapes where a normal is the small difference of large numbers.

use asunder_geometry::{Cuboid, Hull, Pose3, Shape3, TriMesh, Triangle3};
use asunder_narrow::{Pair3, Separation3};
use asunder_tests::cases::Random;
use asunder_tests::exact_overlap::exact_overlap3;
use asunder_tests::precise::separation3;
use glam::{DVec3, Quat, Vec3};

fn vector(bits: [u32; 3]) -> Vec3 {
    Vec3::from_array(bits.map(f32::from_bits))
}

fn pose(place: [u64; 3], turn: [u32; 4]) -> Pose3 {
    Pose3::new(place.map(f64::from_bits), Quat::from_array(turn.map(f32::from_bits))).unwrap()
}

/// Asserts that the overlap decision is exact, every answer agrees with it, and the separation is within its error.
fn holds(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) {
    let pair = Pair3::new(a.0, a.1, b.0, b.1);
    let overlaps = exact_overlap3(a, b);
    assert_eq!(pair.overlaps(), overlaps);
    assert_eq!(pair.distance().is_none(), overlaps);
    assert_eq!(pair.manifold(0.0).is_some(), overlaps);
    let Separation3::Measured(found) = pair.separation(f32::INFINITY) else { panic!("there is no limit") };
    assert_eq!(found.separation <= 0.0, overlaps, "{found:?}");
    let truth = separation3(a, b);
    let miss = (f64::from(found.separation) - truth.separation).abs();
    assert!(miss <= f64::from(found.error) + truth.bound, "{found:?}, true {}", truth.separation);
}

/// Symptom: `overlaps` returned false, while `distance` and `manifold` reported an overlap. Cause: the normal of a
/// triangle 1e-7 times as wide as long was a plain cross product, off by a million roundings, and the depth along it
/// was trusted.
#[test]
fn a_needle_of_a_triangle_has_one_answer() {
    let a: Shape3 = Triangle3::new(
        vector([0xbde7_ae99, 0x3d8a_5de7, 0x3dc5_09d5]),
        vector([0xbd38_2cb7, 0x3cdc_098a, 0x3d1c_7e4b]),
        vector([0x372d_c394, 0x3690_a4f9, 0xb889_9b24]),
    )
    .unwrap()
    .into();
    let b: Shape3 =
        Cuboid::from_half_extents(vector([0x3aa4_f763, 0x3a59_226f, 0x3b11_3b29])).unwrap().into();
    let there = pose(
        [0xbfaf_fbe4_eef8_48ad, 0x3fa2_59d3_31a7_9798, 0x3fab_c67e_7562_7c37],
        [0x3f2a_2253, 0x3f15_413e, 0xbcf4_6f00, 0x3eee_c9f6],
    );
    holds((&a, &Pose3::IDENTITY), (&b, &there));
    holds((&b, &there), (&a, &Pose3::IDENTITY));
}

/// Symptom: a needle in a triangle was reported 1.5 mm deep, +- 0.2 um, and only touched. Cause: the middle of the arc
/// between two faces almost back to back was taken from the sum of their normals, which was rounding noise, and the
/// edge pair that mattered was culled.
#[test]
fn a_knife_edge_keeps_its_edge_pairs() {
    let needle = Hull::of_any_dimension(&[
        vector([0xbe7d_281e, 0x3eaa_c694, 0x3e63_c249]),
        vector([0x3e01_46e5, 0xbdee_5745, 0xbda8_f852]),
        vector([0x3f19_64e1, 0xbf33_c04f, 0xbef4_abb2]),
        vector([0x3f29_59c8, 0xbf4b_bb27, 0xbf0a_1a73]),
        vector([0xbec5_fa70, 0x3eeb_000a, 0x3e9f_9f63]),
    ]);
    let needle: Shape3 = needle.unwrap().into();
    let triangle: Shape3 = Triangle3::new(
        vector([0xbfad_8fd2, 0xbe6f_5477, 0]),
        vector([0xbe80_7306, 0xbfb3_e26b, 0]),
        vector([0x3e9f_8642, 0x3fbe_53ff, 0]),
    )
    .unwrap()
    .into();
    let here = pose([0; 3], [0x1f98_e9d7, 0, 0, 0x3f80_0000]);
    let there = pose(
        [0x3fe9_e759_46ee_f5d8, 0xbfed_da29_c3af_8dc8, 0xbfd7_3df4_a8ca_cb3e],
        [0xbea9_46c3, 0x3f59_3be2, 0xbe26_5e39, 0x3ec2_7118],
    );
    holds((&needle, &here), (&triangle, &there));
    holds((&triangle, &there), (&needle, &here));
}

/// Symptom: a needle was reported 3.8 um deep in a cube, +- 8 nm, and only touched. Cause: as above.
#[test]
fn a_needle_beside_a_cube_keeps_its_edge_pairs() {
    let needle = Hull::of_any_dimension(&[
        vector([0xb8cc_2e35, 0x3af7_46e5, 0xbb97_03e6]),
        vector([0x39d7_2708, 0xbbc9_61bc, 0x3c7a_57ba]),
        vector([0xb87e_1603, 0x3a3f_1ec1, 0xbaf2_0bf7]),
        vector([0x3860_b72d, 0xb9f0_c896, 0x3a9e_40ad]),
        vector([0xb9e7_7a70, 0x3bdf_ed00, 0xbc8a_d63c]),
        vector([0x391b_1ec2, 0xbb01_64d5, 0x3ba2_5c9e]),
        vector([0x39e8_d782, 0xbbe4_0865, 0x3c8d_412a]),
        vector([0xb92c_f8f1, 0x3b22_1db8, 0xbbc9_829e]),
    ]);
    let needle: Shape3 = needle.unwrap().into();
    let cuboid: Shape3 =
        Cuboid::from_half_extents(vector([0x3c5b_9941, 0x3b57_1106, 0x3c9a_8b6a])).unwrap().into();
    let here = pose([0; 3], [0x3335_a1a0, 0x39bf_f217, 0, 0x3f80_0000]);
    let there = pose(
        [0x3f8c_5433_aff8_3945, 0xbf68_eabc_eb98_b278, 0x3f6d_8edd_d9c9_ab7d],
        [0x249a_3e2f, 0, 0, 0x3f80_0000],
    );
    holds((&needle, &here), (&cuboid, &there));
    holds((&cuboid, &there), (&needle, &here));
}

/// Symptom: for two plates, one rounded by 1e-10 m, with 9e-14 m between their cores, the depth was off by 2.6 times
/// its error. Cause: shapes that overlap were taken to have cores that overlap, and the gap between the cores was
/// clamped to 0.
#[test]
fn rounded_shapes_may_overlap_where_their_cores_do_not() {
    let [y, z] = [0x34b8_0cca, 0x3642_9cf0].map(f32::from_bits);
    let plate = Cuboid::from_half_extents(Vec3::new(1.0, y, z)).unwrap();
    let a: Shape3 = plate.rounded(f32::from_bits(0x2edb_e6ff)).unwrap().into();
    let [y, z] = [0x3768_260f, 0x39bd_dae2].map(f32::from_bits);
    let b: Shape3 = Cuboid::from_half_extents(Vec3::new(1.0, y, z)).unwrap().into();
    let here = pose([0; 3], [0xaf27_5b2a, 0x3610_c221, 0xad1b_80d2, 0x3e1c_08f7]);
    let there = pose(
        [0x3ff2_b31a_a4b6_5ab8, 0x3fb3_d8a8_6540_b239, 0xbfc9_4c2f_be37_f540],
        [0xbefb_e073, 0xbf04_c1e7, 0x3d52_f916, 0xbf75_a7cc],
    );
    holds((&a, &here), (&b, &there));
    holds((&b, &there), (&a, &here));
}

/// Symptom: for two plates, 2e-6 m thick and 4e-17 m apart, edge to edge, `distance` was 1.35e-6 m with an error as
/// large, a millionth of their size. Cause: the simplex of the distance iteration was one pair of corners and the next
/// support point was far away; the step towards it was smaller than the rounding of that corner's position.
#[test]
fn a_small_step_towards_a_far_corner_is_one() {
    let plate = |x: f32, z: f32| Shape3::from(Cuboid::from_half_extents(Vec3::new(x, 1e-6, z)).unwrap());
    let (a, b) = (plate(0.408_759_8, 0.308_964_8), plate(0.461_421_6, 0.703_943_85));
    let turn = Quat::from_array([-0.127_667_55, -0.291_934_37, 0.858_011_5, 0.402_854_32]);
    let place = [0xc000_58ab_4bc5_637c, 0x4010_c092_d8a1_1122, 0x3fd5_62bd_16bf_7bb4].map(f64::from_bits);
    let here = Pose3::new(place, turn).unwrap();
    let place = [0xc005_0454_f5b1_02d2, 0x4012_7f16_265b_c7de, 0xbfe3_806e_d123_c720].map(f64::from_bits);
    let there = Pose3::at(place).unwrap();
    for (one, other) in [((&a, &here), (&b, &there)), ((&b, &there), (&a, &here))] {
        holds(one, other);
        let found = Pair3::new(one.0, one.1, other.0, other.1).distance().expect("they are apart");
        assert!(found.distance + found.error < 1e-9, "{found:?}");
    }
}

/// Symptom: no manifold within a margin that was exactly the reported separation. Cause: that number had been rounded
/// down to f32, and the margin was compared with the unrounded one.
#[test]
fn what_is_reported_within_the_margin_has_a_manifold() {
    let cube: Shape3 = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap().into();
    let mut rounded_down = 0;
    for step in 1..200 {
        let there = Pose3::at([1.0 + 0.001 * f64::from(step), 0.0, 0.0]).unwrap();
        let pair = Pair3::new(&cube, &Pose3::IDENTITY, &cube, &there);
        let Separation3::Measured(found) = pair.separation(f32::INFINITY) else {
            panic!("there is no limit")
        };
        assert!(pair.manifold(found.separation).is_some(), "{found:?}");
        assert!(pair.manifold(found.separation.next_down()).is_none(), "{found:?}");
        rounded_down += usize::from(f64::from(found.separation) < there.position().x - 1.0);
    }
    assert!(rounded_down > 50, "{rounded_down}");
}

/// Symptom: boxes beside the rim of one-sided ground, within the margin, got no contact if the triangle there is longer
/// than some thousand times its width. Cause: the direction from the rim to the box was perpendicular, within
/// tolerance, to both long sides, and so accepted for neither; two-sided ground keeps such directions, one-sided ground
/// did so only where they lead up.
#[test]
fn the_rim_of_a_needle_with_one_side_is_there() {
    let mut random = Random::new(0x4EED);
    let body = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.25)).unwrap());
    for case in 0..400 {
        let far = [1e2, 1e3, 1e4, 1e5][case % 4] * random.between(1.0, 2.0);
        let tip = Vec3::new(-far as f32, 0.0, (far * random.between(0.5, 2.0)) as f32);
        let needle =
            TriMesh::new(vec![Vec3::ZERO, tip, Vec3::new(-0.25, 0.0, -0.25)], vec![[0, 2, 1]]).unwrap();
        let floor = Shape3::from(needle.one_sided());
        let along = tip.as_dvec3().normalize();
        let out = DVec3::new(along.z, 0.0, -along.x);
        let gap = [1e-7, 1e-5, 1e-3, 1e-2][case / 4 % 4] * random.between(1.0, 4.0);
        // The box's upright edge is beside the rim.
        let corner = along * random.between(0.1, 0.3) + out * gap - DVec3::Y * random.between(0.01, 0.2);
        let pose = Pose3::at(corner + 0.25).unwrap();
        let told = Pair3::new(&body, &pose, &floor, &Pose3::IDENTITY).manifolds(0.05);
        let [manifold] = &told[..] else { panic!("{case}, {gap} beside: {told:?}") };
        assert!(
            (f64::from(manifold.separation) - gap).abs() <= f64::from(manifold.error),
            "{case}: {told:?}"
        );
        assert!(
            (manifold.normal.as_dvec3() + out).length() < 1e-6 && manifold.error < 1e-6,
            "{case}: {told:?}"
        );
    }
}
