//! Every kind of shape that parry3d has, against parry3d: overlap, distance and depth.
//!
//! As in [`peer`](crate::peer), nothing is compared within [`BAND`] of the pair's size, and where the answers differ
//! beyond it the oracles decide. For each pair of kinds some of parry's answers may be refuted, and the message lists
//! them. What parry cannot answer at all is listed in [`UNSUPPORTED`]. Its `contact` of a shape with a half-space, in
//! this order, forgets to invert the pose (`contact_support_map_halfspace` in 0.31), so that no depth is compared
//! there.

use asunder_geometry::{Pose3, Shape3};
use asunder_narrow::Separation3;
use asunder_tests::answers::Asked;
use asunder_tests::bodies::Bodies3;
use asunder_tests::cases::{Case3, Random};
use asunder_tests::shapes::{Clay, KINDS3};
use glam::{DVec3, Quat, Vec3};
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::query::{contact, distance, intersection_test};
use parry3d::shape::{
    Ball, Capsule, Compound, ConvexPolyhedron, Cuboid, HalfSpace, RoundShape, Segment, Shape, SharedShape,
    Triangle,
};
use std::collections::BTreeMap;

/// Share of a pair's size within which parry's answers are not compared with ours.
const BAND: f64 = 1e-3;

/// Pairs for which parry supports neither overlap, nor distance, nor contact.
const UNSUPPORTED: [(&str, &str); 1] = [("half-space", "half-space")];

pub(crate) fn vector(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(crate) fn pose_of(position: DVec3, rotation: Quat) -> Pose {
    let (p, q) = (position.as_vec3(), rotation.normalize());
    Pose::from_parts(vector(p), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// Parry's equivalent of a shape; `None` where it has none.
pub(crate) fn twin(shape: &Shape3) -> Option<SharedShape> {
    let round = |radius: f32| radius > 0.0;
    Some(match shape {
        Shape3::Sphere(sphere) => SharedShape(std::sync::Arc::new(Ball::new(sphere.radius()))),
        Shape3::Capsule(capsule) => {
            let [from, to] = capsule.segment().ends().map(vector);
            SharedShape(std::sync::Arc::new(Capsule::new(from, to, capsule.radius())))
        }
        Shape3::Cuboid(cuboid) => {
            let inner_shape = Cuboid::new(vector(cuboid.half_extents()));
            match cuboid.radius() {
                radius if round(radius) => {
                    SharedShape(std::sync::Arc::new(RoundShape { inner_shape, border_radius: radius }))
                }
                _ => SharedShape(std::sync::Arc::new(inner_shape)),
            }
        }
        Shape3::Hull(hull) => {
            let points: Vec<Vector> = hull.vertices().iter().copied().map(vector).collect();
            let inner_shape = ConvexPolyhedron::from_convex_hull(&points)?;
            match hull.radius() {
                radius if round(radius) => {
                    SharedShape(std::sync::Arc::new(RoundShape { inner_shape, border_radius: radius }))
                }
                _ => SharedShape(std::sync::Arc::new(inner_shape)),
            }
        }
        Shape3::HalfSpace(half_space) => {
            let normal = vector(half_space.unit_normal().as_vec3());
            SharedShape(std::sync::Arc::new(HalfSpace::new(normal)))
        }
        Shape3::Triangle(triangle) => {
            let [a, b, c] = triangle.vertices().map(vector);
            SharedShape(std::sync::Arc::new(Triangle::new(a, b, c)))
        }
        Shape3::Segment(segment) => {
            let [from, to] = segment.ends().map(vector);
            SharedShape(std::sync::Arc::new(Segment::new(from, to)))
        }
        Shape3::Compound(compound) => {
            let parts = compound.parts().iter();
            let twins = parts.map(|part| {
                let pose = pose_of(part.pose().position(), part.pose().rotation());
                Some((pose, twin(part.shape())?))
            });
            SharedShape(std::sync::Arc::new(Compound::new(twins.collect::<Option<Vec<_>>>()?)))
        }
        Shape3::TriMesh(_) | Shape3::HeightField(_) => return None,
    })
}

/// Parry's answers: overlap, distance, and the depth as a negative number where it has one.
fn ask_parry(a: (&Pose, &dyn Shape), b: (&Pose, &dyn Shape)) -> Option<(bool, f64, Option<f64>)> {
    let overlap = intersection_test(a.0, a.1, b.0, b.1).ok()?.intersecting;
    let distance = distance(a.0, a.1, b.0, b.1).ok()?.distance;
    let deepest = contact(a.0, a.1, b.0, b.1, 0.0).ok()?.map(|contact| f64::from(contact.dist));
    // A half-space against a compound becomes part against half-space.
    let is_spoilt =
        b.1.as_halfspace().is_some() || a.1.as_halfspace().is_some() && b.1.as_compound().is_some();
    let deepest = deepest.filter(|_| !is_spoilt);
    Some((overlap, distance.into(), deepest.filter(|&depth| depth < 0.0)))
}

/// A pair of bodies at f32 positions, so that both sides get the same.
fn pair(random: &mut Random, kinds: [usize; 2]) -> Case3 {
    let mut make = |kind: usize| KINDS3[kind].1(&mut Clay::thick(random));
    let (shape_a, shape_b) = (make(kinds[0]), make(kinds[1]));
    let finite = |radius: f32| if radius.is_finite() { f64::from(radius) } else { 0.0 };
    let reach = finite(shape_a.outer_radius()) + finite(shape_b.outer_radius());
    let at = (random.vector() * 5.0).as_vec3();
    let away = (random.direction() * reach * random.between(0.0, 1.3)).as_vec3();
    let mut pose = |at: Vec3| Pose3::new(at.as_dvec3(), random.quaternion()).unwrap();
    let (pose_a, pose_b) = (pose(at), pose(at + away));
    Case3 { shape_a, pose_a, shape_b, pose_b }
}

/// Whether parry agrees: outside the band about overlap and distance, and with a depth that is not less.
fn agrees(separation: f64, band: f64, (overlap, distance, depth): (bool, f64, Option<f64>)) -> bool {
    if separation.abs() <= band {
        true
    } else if separation > 0.0 {
        !overlap && (separation - distance).abs() <= band
    } else {
        overlap && distance <= band && depth.is_none_or(|depth| depth <= separation + band)
    }
}

#[test]
fn every_kind_that_parry_has_against_every_other() {
    let rounds = 300;
    // By pair of kinds: compared, in overlap, refuted, and whether parry had no answer.
    let mut tally: BTreeMap<(&str, &str), [usize; 4]> = BTreeMap::new();
    for (a, (name_a, _)) in KINDS3.iter().enumerate() {
        for (b, (name_b, _)) in KINDS3.iter().enumerate() {
            let names = (*name_a, *name_b);
            if [names.0, names.1].iter().any(|name| name.contains("flat hull")) {
                continue;
            }
            let counts = tally.entry(names).or_default();
            for round in 0..rounds {
                let mut random = Random::new(((a * 100 + b) * 10_000 + round) as u128);
                let case = pair(&mut random, [a, b]);
                let (Some(twin_a), Some(twin_b)) = (twin(&case.shape_a), twin(&case.shape_b)) else {
                    continue;
                };
                let pose = |pose: &Pose3| pose_of(pose.position(), pose.rotation());
                let (at_a, at_b) = (pose(&case.pose_a), pose(&case.pose_b));
                let Some(theirs) = ask_parry((&at_a, &*twin_a.0), (&at_b, &*twin_b.0)) else {
                    counts[3] += 1;
                    continue;
                };
                let bodies = Bodies3::new(case);
                let Separation3::Measured(ours) = bodies.pair().separation(f32::INFINITY) else {
                    panic!("no limit, yet no measure")
                };
                let (separation, band) = (f64::from(ours.separation), BAND * bodies.size());
                counts[0] += 1;
                counts[1] += usize::from(separation <= 0.0);
                if !agrees(separation, band, theirs) {
                    let truth = bodies.true_separation();
                    assert!(
                        (separation - truth).abs() <= 1e-3 * band,
                        "{names:?}: ours {separation}, parry's {theirs:?}, true {truth}: {bodies:?}"
                    );
                    counts[2] += 1;
                }
            }
        }
    }
    check_tally(&tally, rounds);
}

/// Checks which pairs parry rejects, and that refuted answers are few: more would mean that the comparison is
/// worthless.
fn check_tally(tally: &BTreeMap<(&str, &str), [usize; 4]>, rounds: usize) {
    let unsupported: Vec<_> =
        tally.iter().filter(|(_, counts)| counts[3] > 0).map(|(names, _)| *names).collect();
    assert_eq!(unsupported, UNSUPPORTED, "pairs that parry has no answer for");
    let refuted: Vec<String> = tally
        .iter()
        .filter(|(_, counts)| counts[2] > 0)
        .map(|((a, b), counts)| format!("{a}, {b}: {} of {}", counts[2], counts[0]))
        .collect();
    let message = refuted.join("\n");
    for (names, [compared, overlapping, refuted, _]) in
        tally.iter().filter(|(names, _)| !UNSUPPORTED.contains(names))
    {
        let most = rounds / 20;
        assert!(*refuted <= most, "{names:?}: parry refuted {refuted} times of {compared}. All:\n{message}");
        assert!(compared * 2 > rounds, "{names:?}: {compared} compared");
        let apart = compared - overlapping;
        assert!(apart > 0, "{names:?}: {apart} apart");
    }
}
