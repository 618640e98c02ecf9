//! Turning bodies that start nearer to another than the rounding of their rotations, and went through it.

use asunder::glam::{Quat, Vec3};
use asunder::{Cuboid, HalfSpace, Hull, Motion3, Pair3, Pose3, Shape3, Triangle3};

fn pose(position: [f64; 3], rotation: [f32; 4]) -> Pose3 {
    Pose3::new(position, Quat::from_array(rotation)).unwrap()
}

fn motion(displacement: [f64; 3], rotation: [f32; 4]) -> Motion3 {
    Motion3::new(displacement, Quat::from_array(rotation)).unwrap()
}

/// Asserts that no pose before the impact, or of all where there is none, overlaps deeper than so many metres.
fn stops_before(shapes: [&Shape3; 2], from: [&Pose3; 2], motions: [&Motion3; 2], most: f32) {
    let at = |fraction: f64| {
        let [a, b] = [0, 1].map(|i: usize| motions[i].pose_at(from[i], fraction));
        Pair3::new(shapes[0], &a, shapes[1], &b)
    };
    assert!(!at(0.0).overlaps());
    let found = at(0.0).impact(motions[0], motions[1]);
    let end = found.map_or(1.0, |found| found.fraction);
    for i in 0..=1000 {
        let fraction = end * f64::from(i) / 1000.0;
        let depth = -at(fraction).separation(10.0).measured().unwrap().separation;
        assert!(depth <= most, "{depth} m deep at {fraction}: {found:?}");
    }
}

/// Symptom: a plate swept through a triangle or a point, 2 to 3 mm deep. Cause: in steps that leave ever less of a gap
/// below all rounding, the root of a quadratic was a quotient whose divisor cancelled to zero, so that one step led to
/// the end of the motion.
#[test]
fn a_plate_does_not_sweep_through_what_it_all_but_touches() {
    let rounded = |half: [f32; 3], radius: f32| {
        Shape3::from(Cuboid::from_half_extents(Vec3::from(half)).unwrap().rounded(radius).unwrap())
    };
    let corners = [
        [5.616491e-6, -3.0014193e-5, -9.612092e-6],
        [2.8943132e-5, -1.274239e-5, 4.9714863e-6],
        [-7.3658157e-7, 1.3016564e-5, -3.4507568e-6],
    ];
    let [a, b, c] = corners.map(Vec3::from);
    stops_before(
        [&rounded([0.0024658155, 0.18989296, 1.0], 0.000118498545), &Triangle3::new(a, b, c).unwrap().into()],
        [
            &pose(
                [0.3889941267823427, -0.09843310902035274, -0.006522976179291593],
                [0.0, 0.70710677, 0.0, 0.70710677],
            ),
            &pose(
                [0.3901587035382087, -0.10356041518412798, -0.009108026822026305],
                [0.0, 0.70710677, 0.0, 0.70710677],
            ),
        ],
        [
            &motion(
                [-0.008915124961550277, -0.0029670912521622007, 0.0018662517817998165],
                [0.22329405, -0.67092454, 0.22329405, 0.67092454],
            ),
            &motion(
                [-1.2299198826202752e-6, 2.4022559634694574e-7, 4.746818078407254e-7],
                [0.7012076, 0.09114798, -0.7012076, 0.09114798],
            ),
        ],
        1e-6,
    );
    let point = Hull::of_any_dimension(&[Vec3::new(0.009350627, -0.013573101, 0.0037733205)]).unwrap();
    stops_before(
        [&rounded([1.0, 0.001306065, 1.0], 0.0021428345), &point.into()],
        [
            &pose(
                [0.009350626729505896, -0.010972879895837465, 0.006373541360936684],
                [0.23549312, 0.1237882, 0.15747957, 0.9510098],
            ),
            &Pose3::IDENTITY,
        ],
        [
            &motion(
                [0.0018569532320558604, -0.005566487094719699, -0.0037295013254155006],
                [0.8044585, -0.031152176, 0.55808306, -0.20104568],
            ),
            &motion(
                [-0.0031813044854561183, -0.019163449378076642, -0.006104843648034768],
                [-0.22362891, -0.13902076, 0.5528727, 0.7905663],
            ),
        ],
        1e-6,
    );
}

/// Symptom: a floor that turned a little went into a body that lay on it, twice as deep as rounding. Cause: its normal
/// was that of the step before, where that showed a larger gap.
#[test]
fn a_floor_that_turns_up_into_a_body_is_stopped() {
    let corners = [
        [0.74743307, 0.2789936, -0.60291487],
        [0.07191155, -0.94978034, 0.30454227],
        [0.49712065, 0.2729351, -0.8236367],
        [-0.9268607, -0.2987691, -0.2273023],
        [0.32432145, 0.22917594, 0.91776574],
        [-0.10235238, 0.6263498, 0.7727936],
        [0.9636212, 0.085078694, -0.2533689],
        [-0.6524768, -0.5086119, -0.56177217],
    ];
    let stone = Hull::from_points(&corners.map(Vec3::from)).unwrap().rounded(0.18128414).unwrap();
    stops_before(
        [&stone.into(), &HalfSpace::new(Vec3::Y).unwrap().into()],
        [
            &pose(
                [1.1537753500060202, 0.5028634416047101, -0.1437231576917987],
                [0.0, 0.9819204, 0.0, -0.1892942],
            ),
            &pose(
                [0.8685810115582056, -0.6282010478791749, -0.04115072097421341],
                [0.0, 1.0, 0.0, 6.123234e-17],
            ),
        ],
        [
            &Motion3::STILL,
            &motion(
                [1.738496737124784e-7, -0.0001374985778020993, 2.467240811654392e-8],
                [-0.001265196, 0.99999917, -0.00017955416, 6.123229e-17],
            ),
        ],
        1e-8,
    );
}
