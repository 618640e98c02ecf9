//! Blades and ridges: two faces almost back to back, edges almost parallel.

use asunder_geometry::{Hull, Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Pair3, Separation3, collide3};
use asunder_tests::exact_overlap::exact_overlap3;
use asunder_tests::precise::separation3;
use glam::{DVec3, Quat, Vec3};

type Posed<'a> = (&'a Shape3, &'a Pose3);

fn hull(points: &[[f32; 3]]) -> Shape3 {
    let points: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
    Hull::from_points(&points).unwrap().into()
}

/// Returns the hint for the next frame, and whether the two overlap.
fn collide((shape_a, pose_a): Posed, (shape_b, pose_b): Posed, hint: Hint) -> (Hint, bool) {
    let mut batch = Batch3::default();
    collide3(
        &[Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, ahead: 0.0, sensor: false }],
        &mut batch,
    );
    match batch.answers[0] {
        Answer::Apart { hint, .. } => (hint, false),
        Answer::Contact { hint, overlapping, .. } => (hint, overlapping),
    }
}

/// Symptom: a blade in a box was reported 0.14 m deep, +- 8 nm, and was 0.09 m deep. Cause: 1 + cos of the angle
/// between the faces beside its edge was half as large as its rounding to f32, and the edge was discarded before any
/// axis was tested.
#[test]
fn the_edge_of_a_blade_is_not_left_out() {
    let blade = hull(&[
        [0.0, 0.0, -1.718_958_6],
        [0.0, 0.0, 1.718_958_6],
        [-1.737_175_6, 0.000_232_052_55, -1.781_094_9],
        [-1.737_175_6, 0.000_232_052_55, 1.718_958_6],
        [-1.737_175_6, -0.000_232_052_55, -1.718_958_6],
        [-1.737_175_6, -0.000_232_052_55, 1.781_094_9],
    ]);
    let corner = |i: usize| {
        let side = |bit: usize, half: f32| if i >> bit & 1 == 1 { half } else { -half };
        [side(0, 1.0), side(1, 0.926_903), side(2, 0.952_670_63)]
    };
    let block = hull(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner));
    let turn = Quat::from_array([0xbf66_ae71, 0x3cf0_1510, 0x3c94_5400, 0x3edd_4edc].map(f32::from_bits));
    let here = Pose3::new(DVec3::ZERO, turn).unwrap();
    let turn = Quat::from_array([0xbf33_02ca, 0x3f29_5e44, 0x3e18_454c, 0x3e67_bc7c].map(f32::from_bits));
    let place = [0x3fed_36b4_5d80_973c, 0xbf9c_aec6_870f_8838, 0xbfad_a06a_8162_f5b4].map(f64::from_bits);
    let there = Pose3::new(place, turn).unwrap();
    for [a, b] in [[(&blade, &here), (&block, &there)], [(&block, &there), (&blade, &here)]] {
        let Separation3::Measured(found) = Pair3::new(a.0, a.1, b.0, b.1).separation(f32::INFINITY) else {
            panic!("there is no limit")
        };
        let truth = separation3(a, b);
        let miss = (f64::from(found.separation) - truth.separation).abs();
        assert!(miss <= f64::from(found.error) + truth.bound, "{found:?}, true {}", truth.separation);
    }
}

/// Symptom: two ridges 1e-14 m apart, which cross at 6e-6 rad, overlapped if last frame's hint named their edges.
/// Cause: the cross product of edges at so small an angle is inaccurate. Along it one corner of the parallelogram that
/// the edges span showed an overlap, and the other corners, which did not, were not tested.
#[test]
fn a_hint_of_nearly_parallel_edges_proves_no_overlap() {
    let below = hull(&[
        [-0.544_975_7, -0.021_487_406, -0.302_224_58],
        [0.544_975_7, 0.021_487_406, 0.302_224_58],
        [-0.364_980_97, -0.158_241_9, 0.669_389_6],
        [0.118_264_62, 0.722_712_5, -0.264_639_53],
    ]);
    let above = hull(&[
        [-0.945_648_85, -0.037_281_197, -0.524_429_56],
        [0.945_648_85, 0.037_281_197, 0.524_429_56],
        [0.131_790_55, -1.107_739, -0.158_895_98],
        [0.524_021_15, -0.392_714_7, -0.916_994_7],
    ]);
    let turn = Quat::from_xyzw(0.900_950_85, 0.017_129_246, 0.334_057_1, -0.276_405_6);
    let here = Pose3::new(DVec3::ZERO, turn).unwrap();
    let up = DVec3::new(-2.305_764_802_605_98e-15, 3.170_827_769_200_217e-15, 9.199_437_313_125_645e-15);
    let there = |height: f64| {
        let turn = Quat::from_xyzw(0.900_951_9, 0.017_131_293, 0.334_054, -0.276_405_66);
        Pose3::new(up.normalize() * height, turn).unwrap()
    };
    let (hint, overlap) = collide((&below, &here), (&above, &there(-1e-8)), Hint::NONE);
    assert!(overlap && hint != Hint::NONE);
    let mut apart = 0;
    for height in [up.length(), -1e-12, -1e-13, -1e-14, 0.0, 1e-14, 2e-14, 1e-13, 1e-12, 1e-11, 1e-10] {
        let (a, b) = ((&below, &here), (&above, &there(height)));
        let truth = exact_overlap3(a, b);
        assert_eq!(collide(a, b, hint).1, truth, "with the hint, at {height:e}");
        assert_eq!(collide(a, b, Hint::NONE).1, truth, "without, at {height:e}");
        apart += usize::from(!truth);
    }
    assert!((1..11).contains(&apart), "on both sides: {apart} apart");
}

/// Symptom: one of four contact points was 0.1 m beside the shape, and deeper than the shapes penetrate. Cause: slivers
/// of a plate, a millionth as thick as it is wide, were merged into a face that is not convex. Its outline crossed one
/// side of the other face twice, and one corner beyond that side was kept.
#[test]
fn a_dented_face_leaves_no_point_beside_the_other() {
    let rock = hull(&[
        [-0.093_166_485, 1.192_013, 0.054_958_39],
        [-0.137_929_4, 0.876_238_1, 0.125_218_42],
        [0.100_994_59, 1.119_731_2, -0.064_901_82],
        [-0.183_904_19, 0.833_236_46, -0.182_986_83],
        [0.955_661_65, 0.618_526_8, 0.069_462_314],
        [0.808_155_8, -0.410_484_52, 0.031_121_612],
        [0.865_668_54, -0.481_471_33, -0.199_868_02],
        [0.903_991_8, -0.509_082_4, -0.012_418_54],
        [0.031_838_73, -0.973_705_5, -0.108_664_125],
        [0.131_417_16, -0.941_402_3, 0.163_427_1],
    ]);
    let plate = hull(&[
        [0.051_197_235, -0.210_978_84, 1.699_610_7e-7],
        [-0.730_472_3, 0.800_518_7, 4.487_930_7e-8],
        [-0.790_950_54, -0.161_388_53, -9.930_65e-7],
        [-0.131_973_15, -0.148_703_8, -7.880_971e-7],
        [0.166_346_6, -0.403_840_33, 8.189_401_5e-8],
        [0.609_948_3, -0.917_723_83, 1.029_432_5e-8],
        [-0.662_628_53, 0.683_598_34, -7.969_563_3e-7],
    ]);
    let turn = Quat::from_xyzw(-0.325_220_3, -0.796_850_74, -0.493_518_98, 0.125_298_47);
    let here =
        Pose3::new(DVec3::new(53_430.878_260_024_125, -16_070.983_428_769_781, 99_162.812_977_672_42), turn);
    let turn = Quat::from_xyzw(0.493_518_98, 0.125_298_47, -0.325_220_3, 0.796_850_74);
    let there =
        Pose3::new(DVec3::new(53_431.408_993_994_555, -16_070.759_623_111_926, 99_163.389_693_121_79), turn);
    let pair_poses = (here.unwrap(), there.unwrap());
    let pair = Pair3::new(&rock, &pair_poses.0, &plate, &pair_poses.1);
    let manifold = pair.manifold(0.0).unwrap();
    // Faces count as flat, and axes as equally deep, up to a few 2.5e-7 of the size.
    let slack = 2e-6 * pair.size();
    for point in &manifold.points {
        assert!(point.separation >= manifold.separation - slack, "{point:?} of {manifold:?}");
        let place = pair_poses.0.turn_back(point.anchor_a.as_dvec3());
        let is_on = |face: usize| {
            let core = rock.core();
            let corner = core.vertices()[core.topology().face_vertices(face).next().unwrap()].as_dvec3();
            core.normals()[face].dot(place - corner) <= f64::from(slack)
        };
        assert!((0..rock.core().normals().len()).all(is_on), "{point:?} of {manifold:?}");
    }
}
