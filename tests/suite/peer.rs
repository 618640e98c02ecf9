//! Against parry3d on 160,000 pairs: overlap, distance, and depth.
//!
//! parry works in f32 and iterates, so near touching it is often wrong: within [`BAND`] of the pair's size nothing is
//! compared. Its depth is that of some axis, not always the least, so it may be greater than ours but not less. Outside
//! the band every disagreement is an error of one side, and the oracles decide of which.

use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use asunder_narrow::{Pair2, Pair3, Separation2, Separation3};
use asunder_tests::cases::{Case2, Case3, Random, prism};
use asunder_tests::placed::stored_vertices2;
use glam::{DVec3, Quat, Vec3};
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::query::{contact, distance, intersection_test};
use parry3d::shape::{ConvexPolyhedron, Cuboid, Shape};

/// Share of a pair's size within which parry's answers are not compared with ours.
const BAND: f64 = 1e-3;

/// A shape and parry's equivalent of it.
struct Twin<S> {
    ours: S,
    theirs: Box<dyn Shape>,
}

fn hull_of(points: &[Vec3]) -> Box<dyn Shape> {
    let points: Vec<Vector> = points.iter().map(|v| Vector::new(v.x, v.y, v.z)).collect();
    Box::new(ConvexPolyhedron::from_convex_hull(&points).unwrap())
}

fn twin3(shape: Shape3) -> Twin<Shape3> {
    let theirs: Box<dyn Shape> = match &shape {
        Shape3::Cuboid(cuboid) => {
            let half = cuboid.half_extents();
            Box::new(Cuboid::new(Vector::new(half.x, half.y, half.z)))
        }
        Shape3::Hull(hull) => hull_of(hull.vertices()),
        other => unreachable!("made of cuboids and hulls, not {other:?}"),
    };
    Twin { ours: shape, theirs }
}

fn pose_of(position: Vec3, rotation: Quat) -> Pose {
    let q = rotation.normalize();
    Pose::from_parts(Vector::new(position.x, position.y, position.z), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// The answers of both sides.
struct Said {
    size: f64,
    separation: f64,
    their_overlap: bool,
    their_distance: f64,
    /// Depth as a negative number, where parry finds an overlap.
    their_depth: Option<f64>,
}

/// Compares outside the band; `judge` returns the true separation, and what to print.
///
/// Different overlap decisions are a failure. Where parry's iteration stopped short of a distance or a depth, the
/// oracles decide: it is a failure of ours unless they refute parry and confirm us to a thousandth of the band. Returns
/// whether they had to.
fn compare(said: &Said, judge: impl FnOnce() -> (f64, String)) -> bool {
    let &Said { size, separation, their_overlap, their_distance, their_depth } = said;
    let band = BAND * size;
    let agrees = if separation.abs() <= band {
        true
    } else if separation > 0.0 {
        !their_overlap && (separation - their_distance).abs() <= band
    } else {
        their_overlap && their_distance == 0.0 && their_depth.is_none_or(|depth| depth <= separation + band)
    };
    if agrees {
        return false;
    }
    let (truth, case) = judge();
    assert_eq!(their_overlap, separation <= 0.0, "ours {separation}, true {truth}: {case}");
    assert!((separation - truth).abs() <= 1e-3 * band, "ours {separation}, true {truth}: {case}");
    true
}

/// Checks how many of `rounds` pairs were apart, in overlap, and refuted for parry, with a limit per 1,000 on the last.
fn check_tally(rounds: usize, [apart, overlapping, refuted]: [usize; 3], per_thousand: f64) {
    assert!(apart > rounds / 4 && overlapping > rounds / 4, "{apart} apart, {overlapping} in overlap");
    // More than its usual share would mean that the comparison is worthless.
    assert!(
        refuted as f64 <= per_thousand * rounds as f64 / 1000.0,
        "parry refuted in {refuted} of {rounds}"
    );
}

fn ask_parry(pose_a: &Pose, a: &dyn Shape, pose_b: &Pose, b: &dyn Shape) -> (bool, f64, Option<f64>) {
    let deepest = contact(pose_a, a, pose_b, b, 0.0).unwrap().map(|contact| f64::from(contact.dist));
    (
        intersection_test(pose_a, a, pose_b, b).unwrap().intersecting,
        distance(pose_a, a, pose_b, b).unwrap().distance.into(),
        deepest.filter(|&depth| depth < 0.0),
    )
}

/// Compares `rounds` random pairs from a pool of solids; both signs must occur often.
fn compare_solids(seed: u128, rounds: usize, mut make: impl FnMut(&mut Random) -> Shape3) {
    // Seen: about 1 in 10,000.
    let per_thousand = 0.3;
    let mut random = Random::new(seed);
    let pool: Vec<Twin<Shape3>> = (0..200).map(|_| twin3(make(&mut random))).collect();
    let mut tally = [0; 3];
    for _ in 0..rounds {
        let (a, b) = (&pool[random.below(pool.len())], &pool[random.below(pool.len())]);
        let reach = f64::from(a.ours.outer_radius() + b.ours.outer_radius());
        // Both sides get the same f32 positions, in the coordinates of a small level.
        let at = (random.vector() * 5.0).as_vec3();
        let away = (random.direction() * reach * random.between(0.0, 1.3)).as_vec3();
        let [(at_a, turn_a), (at_b, turn_b)] = [(at, random.quaternion()), (at + away, random.quaternion())];
        let (pose_a, pose_b) = (Pose3::new(at_a, turn_a).unwrap(), Pose3::new(at_b, turn_b).unwrap());
        let Separation3::Measured(ours) =
            Pair3::new(&a.ours, &pose_a, &b.ours, &pose_b).separation(f32::INFINITY)
        else {
            panic!("no limit, yet no measure")
        };
        let (theirs_a, theirs_b) = (pose_of(at_a, turn_a), pose_of(at_b, turn_b));
        let (their_overlap, their_distance, their_depth) =
            ask_parry(&theirs_a, &*a.theirs, &theirs_b, &*b.theirs);
        let separation = f64::from(ours.separation);
        tally[usize::from(separation <= 0.0)] += 1;
        let refuted =
            compare(&Said { size: reach, separation, their_overlap, their_distance, their_depth }, || {
                let case = Case3 { shape_a: a.ours.clone(), pose_a, shape_b: b.ours.clone(), pose_b };
                let theirs = format!("parry {their_overlap} {their_distance} {their_depth:?}");
                (case.truth().separation, format!("{theirs}: {case:?}"))
            });
        tally[2] += usize::from(refuted);
    }
    check_tally(rounds, tally, per_thousand);
}

#[test]
fn cuboids() {
    compare_solids(400, 50_000, Random::cuboid);
}

#[test]
fn hulls_of_4_to_32_points() {
    compare_solids(401, 40_000, |random| {
        let vertices = 4 + random.below(29);
        random.hull(vertices)
    });
}

#[test]
fn cuboids_prisms_and_hulls() {
    compare_solids(402, 30_000, Random::shape3);
}

/// For parry, polygons are prisms, so thick along z that the least translation is never along z, and at one height, so
/// that the answer in space is that in the plane.
#[test]
fn polygons_as_thick_prisms() {
    let mut random = Random::new(403);
    let pool: Vec<Twin<Shape2>> = (0..200)
        .map(|_| {
            let shape = random.shape2();
            let Shape3::Hull(hull) = prism(&stored_vertices2(&shape), 1.6) else { unreachable!("a hull") };
            Twin { ours: shape, theirs: hull_of(hull.vertices()) }
        })
        .collect();
    let rounds = 40_000;
    let mut tally = [0; 3];
    for _ in 0..rounds {
        let (a, b) = (&pool[random.below(pool.len())], &pool[random.below(pool.len())]);
        let reach = f64::from(a.ours.outer_radius() + b.ours.outer_radius());
        let at = (random.vector() * 5.0).truncate().as_vec2();
        let away = (random.direction2() * reach * random.between(0.0, 1.3)).as_vec2();
        let pose = |position: glam::Vec2, random: &mut Random| {
            let rotation = random.rotation2();
            let pose = Pose2::new(position, rotation).unwrap();
            // The half angle from the cosine and sine, by roots alone.
            let (c, s) = (f64::from(rotation.cos()), f64::from(rotation.sin()));
            let half = DVec3::new(((1.0 + c) / 2.0).max(0.0).sqrt(), ((1.0 - c) / 2.0).max(0.0).sqrt(), s);
            let turn = Quat::from_xyzw(0.0, 0.0, half.y.copysign(half.z) as f32, half.x as f32);
            (pose, pose_of(position.extend(0.0), turn))
        };
        let (pose_a, theirs_a) = pose(at, &mut random);
        let (pose_b, theirs_b) = pose(at + away, &mut random);
        let Separation2::Measured(ours) =
            Pair2::new(&a.ours, &pose_a, &b.ours, &pose_b).separation(f32::INFINITY)
        else {
            panic!("no limit, yet no measure")
        };
        let (their_overlap, their_distance, their_depth) =
            ask_parry(&theirs_a, &*a.theirs, &theirs_b, &*b.theirs);
        let separation = f64::from(ours.separation);
        tally[usize::from(separation <= 0.0)] += 1;
        let refuted =
            compare(&Said { size: reach, separation, their_overlap, their_distance, their_depth }, || {
                let case = Case2 { shape_a: a.ours.clone(), pose_a, shape_b: b.ours.clone(), pose_b };
                let theirs = format!("parry {their_overlap} {their_distance} {their_depth:?}");
                (case.truth().separation, format!("{theirs}: {case:?}"))
            });
        tally[2] += usize::from(refuted);
    }
    // Long thin side faces: parry's iteration stops short of the closest points in about 2 of 1,000.
    check_tally(rounds, tally, 4.0);
}
