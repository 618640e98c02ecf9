//! Contact points beside the shapes: depth and normal were right, and the position was not.

use asunder_geometry::{Hull, Pose3, Shape3};
use asunder_narrow::Pair3;
use asunder_tests::cases::Random;
use glam::{DVec3, Quat, Vec3};

type Posed<'a> = (&'a Shape3, &'a Pose3);

fn hull(points: &[DVec3]) -> Shape3 {
    let points: Vec<Vec3> = points.iter().map(|point| point.as_vec3()).collect();
    Hull::from_points(&points).unwrap().into()
}

/// How far outside the shape a point lies; it is relative to the shape's position, in metres.
fn beyond((shape, pose): Posed, anchor: Vec3) -> f64 {
    let (core, place) = (shape.core(), pose.turn_back(anchor.as_dvec3()));
    let over = |face: usize| {
        let corner = core.vertices()[core.topology().face_vertices(face).next().unwrap()].as_dvec3();
        core.normals()[face].dot(place - corner)
    };
    (0..core.normals().len()).map(over).fold(f64::NEG_INFINITY, f64::max)
}

/// Asserts that both ends of each contact point lie on their shapes, and in line along the normal. Faces count as flat,
/// and axes and features as equally deep, up to a few 5e-7 of the size; anchors are f32.
fn points_are_on_both(a: Posed, b: Posed, story: &str) -> usize {
    let pair = Pair3::new(a.0, a.1, b.0, b.1);
    let manifold = pair.manifold(0.0).unwrap();
    let slack = 4e-6 * f64::from(pair.size());
    for point in &manifold.points {
        let between = b.1.position() - a.1.position() + point.anchor_b.as_dvec3() - point.anchor_a.as_dvec3();
        let normal = manifold.normal.as_dvec3();
        let aside = (between - normal * between.dot(normal)).length();
        assert!(aside <= slack, "{story}: {aside} m beside each other: {manifold:?}");
        assert!(beyond(a, point.anchor_a) <= slack, "{story}: beyond A: {manifold:?}");
        assert!(beyond(b, point.anchor_b) <= slack, "{story}: beyond B: {manifold:?}");
        assert!(f64::from(point.separation - manifold.separation) >= -slack, "{story}: deeper: {manifold:?}");
    }
    manifold.points.len()
}

/// Symptom: two edges touched in two places 0.4 m apart. Cause: in the hull of a lattice, rotated and rounded, an edge
/// may have a corner in its middle, or a neighbour coplanar with it. Several edges supported the axis, and rounding
/// picked one that the other shape's edge did not cross.
#[test]
fn edges_with_a_corner_in_the_middle_touch_where_they_cross() {
    let mut random = Random::new(11);
    let mut met = 0;
    for round in 0..6000 {
        let mut lattice = || {
            let turn = random.quaternion().as_dquat().normalize();
            let mut point = || DVec3::from_array([0; 3].map(|_| random.below(4) as f64 / 1.5 - 1.0));
            let points: Vec<Vec3> = (0..12).map(|_| (turn * point()).as_vec3()).collect();
            Hull::from_points(&points).ok().map(Shape3::from)
        };
        let (Some(one), Some(other)) = (lattice(), lattice()) else { continue };
        let there = Pose3::new(random.direction() * random.between(0.3, 2.0), random.quaternion()).unwrap();
        if Pair3::new(&one, &Pose3::IDENTITY, &other, &there).overlaps() {
            met += points_are_on_both((&one, &Pose3::IDENTITY), (&other, &there), &format!("round {round}"));
        }
    }
    assert!(met > 2000, "only {met} points");
}

/// Symptom: two boxes of 20 km, offset by 12 km, touched at a corner that was not above the lower one. Cause: their
/// lids were triangles tilted by 3e-7, a hair too much to be merged into one face; one triangle was clipped against one
/// of the other's, and those two did not overlap at all.
#[test]
fn boxes_with_uneven_lids_touch_where_both_are() {
    let mut random = Random::new(5);
    let mut met = 0;
    for round in 0..4000 {
        let uneven = random.pick(&[1e-7, 3e-7, 1e-6, 3e-6]) * random.between(0.7, 1.5);
        let mut lid = |up: f64| {
            let corner = |i: usize, noise: f64| {
                let side = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
                DVec3::new(side(0), side(1), side(2) + noise)
            };
            let mut points: Vec<DVec3> = (0..8).map(|i| corner(i, uneven * random.signed())).collect();
            points.push(DVec3::new(0.1, 0.2, up * (1.0 + uneven)));
            hull(&points.iter().map(|point| *point * 1e4).collect::<Vec<_>>())
        };
        let (below, above) = (lid(1.0), lid(-1.0));
        let shift = random.direction() * DVec3::new(1.0, 1.0, 0.0) * 1.2;
        let lift = 2.0 - uneven * random.between(0.0, 2.0);
        let there = Pose3::at((shift + DVec3::Z * lift) * 1e4).unwrap();
        let pair = Pair3::new(&below, &Pose3::IDENTITY, &above, &there);
        if pair.overlaps() {
            met +=
                points_are_on_both((&below, &Pose3::IDENTITY), (&above, &there), &format!("round {round}"));
        }
    }
    assert!(met > 3000, "only {met} points");
}

/// Symptom: a contact point lay 100 m beyond the tip of a needle of 14 km, and was 5 cm nearer than the shapes are.
/// Cause: even far beyond the tip, where the lines of the needle's sides have crossed, a point is within the clipper's
/// tolerance of both, so that the other shape's corner there was kept.
#[test]
fn a_needle_has_no_contact_beyond_its_tip() {
    let corners = [
        [-3885.6953, -0.301_280_65, 6866.1694],
        [6759.993, 0.087_561_73, 6866.1694],
        [-6959.7163, -0.907_229_24, 6866.1694],
    ];
    let radius = 2723.358;
    let needle = Hull::of_any_dimension(&corners.map(Vec3::from)).unwrap();
    let needle: Shape3 = needle.rounded(radius).unwrap().into();
    let turn = Quat::from_xyzw(-1.4440138, -0.201_976_27, 1.0733515, 1.7239333);
    let here = Pose3::new(DVec3::ZERO, turn).unwrap();
    let place = DVec3::new(3_845.349_278_339_416, -3_663.589_381_238_517, -2_078.177_651_321_491_3);
    let turn = Quat::from_xyzw(-1.4435467, -0.202_402_32, 1.0735185, 1.7241706);
    let there = Pose3::new(place, turn).unwrap();
    let manifold = Pair3::new(&needle, &here, &needle, &there).manifold(542.25793).unwrap();
    for point in &manifold.points {
        let inwards = manifold.normal.as_dvec3() * f64::from(radius);
        let cores = [
            here.turn_back(point.anchor_a.as_dvec3() - inwards),
            there.turn_back(point.anchor_b.as_dvec3() + inwards),
        ];
        for core in cores {
            // A few metres because the surface is not square to the normal; the needle is 13.7 km long.
            assert!((-6965.0..6765.0).contains(&core.x), "{core} in {manifold:?}");
        }
    }
}
