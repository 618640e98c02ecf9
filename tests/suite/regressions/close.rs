//! Shapes that almost touch: the answer was right, and its error bound was too wide to say anything.

use asunder_geometry::{Cuboid, Hull, Pose3, Shape3};
use asunder_narrow::{Pair3, Separation3};
use asunder_tests::cases::Random;
use glam::{DVec3, Vec3};

/// The errors of everything that is reported for a pair, in metres.
fn errors(pair: &Pair3) -> [f32; 4] {
    let of_manifold = |margin| pair.manifold(margin).map_or(0.0, |manifold| manifold.error);
    let Separation3::Measured(measured) = pair.separation(f32::INFINITY) else {
        panic!("there is no limit");
    };
    let of_distance = pair.distance().map_or(0.0, |closest| closest.error);
    [measured.error, of_distance, of_manifold(0.0), of_manifold(0.01)]
}

/// Symptom: boxes of a metre with a gap below 1e-12 m were reported with errors of up to half a metre. Cause: where
/// four support points enclosed the origin up to rounding, the error was set to the previous step's distance from it.
#[test]
fn boxes_that_all_but_touch_are_told_as_well_as_any() {
    let mut random = Random::new(350);
    let (mut touching, mut apart) = (0, 0);
    for round in 0..12_000 {
        let mut half = || Vec3::from_array([0; 3].map(|_| random.between(0.1, 1.1) as f32));
        let halves = [half(), half()];
        let turns = [random.quaternion(), random.quaternion()];
        let [a, b] = turns.map(|turn| Pose3::new(DVec3::ZERO, turn).unwrap());
        // A face normal, or the cross product of two edges.
        let (of_a, of_b) = (a.basis(), b.basis());
        let across = of_a.z.cross(of_b.z).normalize_or(of_a.x);
        let axis = if round % 2 == 0 { of_a.x } else { across };
        let reach = |pose: &Pose3, half: Vec3| pose.basis().turn_back(axis).abs().dot(half.as_dvec3());
        let gap = 1e-16 * random.signed() * [1.0, 10.0, 1e3, 1e4][round % 4];
        let there = Pose3::new(axis * (reach(&a, halves[0]) + reach(&b, halves[1]) + gap), turns[1]).unwrap();
        let cuboids = halves.map(|half| Cuboid::from_half_extents(half).unwrap());
        let shapes = cuboids.map(|cuboid| {
            if round % 3 == 0 {
                Hull::from_points(&cuboid.vertices()).unwrap().into()
            } else {
                Shape3::from(cuboid)
            }
        });
        let pair = Pair3::new(&shapes[0], &a, &shapes[1], &there);
        if pair.overlaps() {
            touching += 1
        } else {
            apart += 1
        }
        for (asked, error) in
            ["separation", "distance", "manifold", "with a margin"].iter().zip(errors(&pair))
        {
            assert!(
                error < 1e-6 * pair.size(),
                "round {round}: {asked} off by up to {error} m: {shapes:?} {there:?}"
            );
        }
    }
    assert!(touching > 2000 && apart > 2000, "{touching} touch, {apart} do not");
}

/// Symptom: for rounded hulls whose vertices are far from their own origin, contact points had a separation that was
/// off by up to a centimetre, with an error of 1e-10 m; the separation alone was right. Cause: cores whose gap only the
/// radii close were taken for overlapping if no face normal showed the gap, as where two edges are nearest.
#[test]
fn a_gap_that_only_radii_close_is_no_overlap_of_the_cores() {
    let mut random = Random::new(28);
    let mut crossing = 0;
    for round in 0..1500 {
        let middle = random.direction() * [1e3, 1e4][round % 2];
        let mut hull = |middle: DVec3| {
            let corners = (0..8).map(|_| (middle + random.vector()).as_vec3());
            Hull::from_points(&corners.collect::<Vec<_>>()).unwrap()
        };
        let (a, b) = (hull(middle), hull(DVec3::ZERO));
        let (turn, way) = (random.quaternion(), random.direction());
        let at = |out: f64| Pose3::new(middle + way * out, turn).unwrap();
        let sharp = [Shape3::from(a.clone()), Shape3::from(b)];
        let gap = |out: f64| Pair3::new(&sharp[0], &Pose3::IDENTITY, &sharp[1], &at(out)).distance();
        if gap(0.0).is_some() {
            continue;
        }
        let (mut near, mut far) = (0.0, 8.0);
        for _ in 0..50 {
            let between = 0.5 * (near + far);
            let is_apart = gap(between).is_some_and(|found| found.distance > 1e-4);
            (near, far) = if is_apart { (near, between) } else { (between, far) };
        }
        let rounded = Shape3::from(a.rounded(2e-4).unwrap());
        let there = at(far);
        let pair = Pair3::new(&rounded, &Pose3::IDENTITY, &sharp[1], &there);
        let Separation3::Measured(told) = pair.separation(f32::INFINITY) else { panic!("there is no limit") };
        let manifold = pair.manifold(1.0).unwrap();
        let off = (manifold.separation - told.separation).abs();
        assert!(off <= manifold.error + told.error + 1e-9, "{round}: {told:?}, {manifold:?}");
        assert!((told.separation + 1e-4).abs() < 1e-6, "{round}: {told:?}");
        crossing += usize::from(manifold.points.len() == 1);
    }
    assert!(crossing > 500, "{crossing}");
}
