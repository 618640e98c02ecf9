//! How stable answers are when almost nothing changes.
//!
//! | measure | what is done | what is reported | for |
//! |---|---|---|---|
//! | jitter-1ulp | faces on faces, with an overlap of 1e-4 of size; B's position and rotation moved by one ulp of f32, one number at a time, up and down | change of the depth, divided by the furthest that any point of B moved: above 1 it is due to rounding | each such step |
//! | count-changes | the same | percent of steps that change the number of contact points | each hundred places |
//! | normal-flips | the same | degrees by which the normal turned | each step |
//! | drifting-depth | the same, moved and rotated for 1e4 frames, with rotations as f32 products that are never normalised | the depth minus the true depth at the stored poses, divided by the size | each frame |
//! | standing-stack | ten bodies on one another under gravity for 5 s, with our solver on our contacts | how far a body moved from where it was put | each body |
//!
//! Faces lie within faces; in `aligned` pairs a box lies exactly on an equal box. For `cached` shapes contact points
//! are queried with the hints of the previous frame. The textbook has no contact points, and parry3d no solver here.
//! Where a method gives no answer, there is no sample.

use super::StabilityRow;
use super::methods::bodies3;
use super::textbook::{Forms, Number, World};
use crate::certain::rest3;
use crate::clock::quantiles;
use crate::error::truth::truths;
use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Pair3, Separation3, collide3};
use asunder_scenes::pairs::{PosedPair3, SolidKind, solids};
use asunder_scenes::random::Random;
use asunder_tests::report::peers::{Contact, double, single, unless_panic};
use asunder_tests::solver::{STEP, Settings, Solver};
use glam::{DQuat, DVec3, Quat, Vec3};

/// The overlap of resting faces, as a share of the size.
const SUNK: f64 = 1e-4;

/// How many places one percentage is taken over.
const BATCH: usize = 100;

/// How many bodies a stack has, and for how many seconds it stands.
const STACKED: usize = 10;
const SECONDS: f64 = 5.0;

const IN_RANGE: &str = "a few metres around the origin are in range";

/// Every measure.
pub(super) fn all(quick: bool, progress: &dyn Fn(&str)) -> Vec<StabilityRow> {
    let (places, frames) = if quick { (3 * BATCH, 1000) } else { (30 * BATCH, 10_000) };
    let mut rows = Vec::new();
    let of_kind = |kind: SolidKind| (kind.name(), rest3(kind, SUNK, places, 3));
    for (name, pairs) in
        [of_kind(SolidKind::Box), of_kind(SolidKind::Hull16), ("box, aligned", aligned(places))]
    {
        progress(&format!("stability, one ulp, {name}"));
        rows.extend(of_ulps(name, &pairs));
    }
    for kind in [SolidKind::Box, SolidKind::Hull16] {
        progress(&format!("stability, drifting, {}", kind.name()));
        rows.extend(drifting(kind, frames));
    }
    progress("stability, stacks");
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5)).expect(IN_RANGE));
    // The second of the authored solids is a cylinder.
    let cylinder = solids(SolidKind::Authored, 2, 1).swap_remove(1);
    rows.extend([("box", cube), ("cylinder", cylinder)].map(|(name, shape)| standing(name, &shape)));
    rows
}

/// A row from its samples; `None` without samples.
fn row(measure: &str, shape: &str, method: &str, unit: &str, samples: &[f64]) -> Option<StabilityRow> {
    let [median, p99, max] = quantiles(samples, [0.5, 0.99, 1.0])?;
    Some(StabilityRow {
        measure: measure.to_string(),
        shape: shape.to_string(),
        method: method.to_string(),
        samples: samples.len() as u64,
        median,
        p99,
        max,
        unit: unit.to_string(),
    })
}

/// A pair's depth, and its normal in the world; a pair that is apart has depth 0. `None` where the method gives no
/// answer.
type Depth = fn(&PosedPair3) -> Option<Contact>;

/// The number of contact points after some frames, each queried with the hints of the previous one, or anew.
type Points = fn(&[&PosedPair3]) -> Option<usize>;

/// The methods that give a depth.
const DEPTHS: [(&str, Depth); 5] = [
    ("textbook-f32", textbook::<f32>),
    ("textbook-f64", textbook::<f64>),
    ("certain", |pair| {
        match Pair3::new(&pair.shape_a, &pair.pose_a, &pair.shape_b, &pair.pose_b).separation(0.0) {
            Separation3::Measured(found) => {
                let normal = found.normal.as_dvec3();
                Some(Contact { separation: found.separation.into(), normal, points: 1 })
            }
            Separation3::AtLeast(_) => Some(NO_CONTACT),
        }
    }),
    ("parry-f32", |pair| number(single::Twins::new(pair)?.contact()?)),
    ("parry-f64", |pair| number(double::Twins::new(pair)?.contact()?)),
];

const NO_CONTACT: Contact = Contact { separation: 0.0, normal: DVec3::ZERO, points: 0 };

fn number(found: Option<Contact>) -> Option<Contact> {
    let found = found.unwrap_or(NO_CONTACT);
    (!found.separation.is_nan() && !found.normal.is_nan()).then_some(found)
}

fn textbook<T: Number>(pair: &PosedPair3) -> Option<Contact> {
    let [a, b] = bodies3::<T>(pair, &mut Forms::default());
    Some(World::<T, 3>::default().depth(&a, &b).map_or(NO_CONTACT, |(depth, normal)| Contact {
        separation: -depth.into(),
        normal: normal.map(Into::into).into(),
        points: 1,
    }))
}

/// The methods that give contact points.
const POINTS: [(&str, Points); 3] = [
    ("certain", |frames| {
        let (mut batch, mut hint) = (Batch3::default(), Hint::NONE);
        for PosedPair3 { shape_a, pose_a, shape_b, pose_b } in frames.iter().copied() {
            batch.clear();
            collide3(
                &[Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, ahead: 0.0, sensor: false }],
                &mut batch,
            );
            let (Answer::Apart { hint: next, .. } | Answer::Contact { hint: next, .. }) =
                batch.answers.first()?;
            hint = *next;
        }
        Some(batch.manifolds.iter().map(|manifold| manifold.points.len()).sum())
    }),
    ("parry-f32", |frames| {
        let (mut memory, mut last) = (Vec::new(), None);
        for pair in frames {
            last = single::Twins::new(pair)?.manifold(&mut memory)?;
        }
        Some(last.map_or(0, |contact| contact.points))
    }),
    ("parry-f64", |frames| {
        let (mut memory, mut last) = (Vec::new(), None);
        for pair in frames {
            last = double::Twins::new(pair)?.manifold(&mut memory)?;
        }
        Some(last.map_or(0, |contact| contact.points))
    }),
];

/// A pair at rest, with all its numbers in f32, and its variations by one ulp.
struct Place {
    pair: PosedPair3,
    /// Each variation, with the furthest that any point of B moved, in metres.
    steps: Vec<(PosedPair3, f64)>,
}

impl Place {
    fn new(pair: &PosedPair3) -> Self {
        let rounded = |pose: &Pose3| pose_of(pose.position().as_vec3(), pose.rotation().to_array());
        let pair =
            PosedPair3 { pose_a: rounded(&pair.pose_a), pose_b: rounded(&pair.pose_b), ..pair.clone() };
        let (position, rotation) = (pair.pose_b.position().as_vec3(), pair.pose_b.rotation().to_array());
        let step = |index: usize| {
            let turned =
                |value: f32| if index.is_multiple_of(2) { value.next_up() } else { value.next_down() };
            let (mut position, mut rotation) = (position, rotation);
            match index / 2 {
                axis @ 0..3 => position[axis] = turned(position[axis]),
                axis => rotation[axis - 3] = turned(rotation[axis - 3]),
            }
            let pose_b = pose_of(position, rotation);
            let moved = |vertex: &Vec3| pose_b.transform(*vertex).distance(pair.pose_b.transform(*vertex));
            let furthest = pair.shape_b.core().vertices().iter().map(moved).fold(0.0, f64::max);
            (PosedPair3 { pose_b, ..pair.clone() }, furthest)
        };
        // For a component of zero, the steps are too small to move anything.
        let steps = (0..14).map(step).filter(|(_, moved)| *moved > 1e-12).collect();
        Self { pair, steps }
    }
}

fn pose_of(position: Vec3, rotation: [f32; 4]) -> Pose3 {
    Pose3::new(position, Quat::from_array(rotation)).expect(IN_RANGE)
}

/// A box exactly on an equal box, so that their sides lie in common planes: the clipping of faces has to choose.
fn aligned(count: usize) -> Vec<PosedPair3> {
    let mut random = Random::new(7);
    let pair = |_| {
        let half = random.within(DVec3::splat(0.3), DVec3::splat(0.6)).as_vec3();
        let shape = Shape3::from(Cuboid::from_half_extents(half).expect(IN_RANGE));
        let (place, rotation) = (random.within(DVec3::splat(-5.0), DVec3::splat(5.0)), random.rotation());
        let pose_a = Pose3::new(place, rotation).expect(IN_RANGE);
        let height = 2.0 * f64::from(half.y) - SUNK * 2.0 * f64::from(shape.outer_radius());
        let pose_b = Pose3::new(pose_a.transform(DVec3::Y * height), rotation).expect(IN_RANGE);
        PosedPair3 { shape_a: shape.clone(), pose_a, shape_b: shape, pose_b }
    };
    (0..count).map(pair).collect()
}

fn of_ulps(name: &str, pairs: &[PosedPair3]) -> Vec<StabilityRow> {
    let places: Vec<Place> = pairs.iter().map(Place::new).collect();
    let mut rows = Vec::new();
    for (method, depth) in DEPTHS {
        let (mut jitter, mut turned) = (Vec::new(), Vec::new());
        for place in &places {
            let Some(base) = unless_panic(|| depth(&place.pair)) else { continue };
            for (pair, moved) in &place.steps {
                let Some(next) = unless_panic(|| depth(pair)) else { continue };
                jitter.push((next.separation - base.separation).abs() / moved);
                turned.push(angle(base.normal, next.normal));
            }
        }
        rows.extend(row("jitter-1ulp", name, method, "change over motion", &jitter));
        rows.extend(row("normal-flips", name, method, "degrees", &turned));
    }
    for (method, points) in POINTS {
        for is_cached in [false, true] {
            let changes: Vec<f64> =
                places.chunks(BATCH).map(|batch| percent_changed(batch, points, is_cached)).collect();
            let shape = format!("{name}{}", if is_cached { ", cached" } else { "" });
            rows.extend(row("count-changes", &shape, method, "percent", &changes));
        }
    }
    rows
}

/// Percent of the steps of some places after which the number of contact points is different.
fn percent_changed(places: &[Place], points: Points, is_cached: bool) -> f64 {
    let (mut steps, mut changed) = (0, 0);
    for place in places {
        let Some(base) = unless_panic(|| points(&[&place.pair])) else { continue };
        for (pair, _) in &place.steps {
            let frames = [&place.pair, pair];
            let frames = if is_cached { &frames[..] } else { &frames[1..] };
            let Some(next) = unless_panic(|| points(frames)) else { continue };
            steps += 1;
            changed += u32::from(next != base);
        }
    }
    100.0 * f64::from(changed) / f64::from(steps.max(1))
}

/// The angle between two directions, in degrees; 180 where one of them is zero.
#[allow(clippy::disallowed_methods, reason = "a figure for people, and no output of the library")]
fn angle(a: DVec3, b: DVec3) -> f64 {
    let (across, along) = (a.cross(b).length(), a.dot(b));
    if across == 0.0 && along <= 0.0 { 180.0 } else { across.atan2(along).to_degrees() }
}

fn drifting(kind: SolidKind, frames: usize) -> Vec<StabilityRow> {
    let pairs = carried(&rest3(kind, SUNK, 1, 5)[0], frames);
    let truths = truths(&pairs);
    let errors = |depth: Depth| -> Vec<f64> {
        let error = |(pair, truth): (&PosedPair3, &super::truth::Truth)| {
            Some((unless_panic(|| depth(pair))?.separation - truth.separation).abs() / truth.size)
        };
        pairs.iter().zip(&truths).filter_map(error).collect()
    };
    let of_method = |(method, depth): (&str, Depth)| {
        row("drifting-depth", kind.name(), method, "share of size", &errors(depth))
    };
    DEPTHS.into_iter().filter_map(of_method).collect()
}

/// A pair that moves as one: by a tenth of a metre and a hundredth of a radian a frame.
fn carried(pair: &PosedPair3, frames: usize) -> Vec<PosedPair3> {
    let unit = |pose: &Pose3| pose.rotation().as_dquat().normalize();
    let seen_from_a = unit(&pair.pose_a).conjugate();
    let (way, turn) =
        (seen_from_a * (pair.pose_b.position() - pair.pose_a.position()), seen_from_a * unit(&pair.pose_b));
    let spin = DQuat::from_xyzw(0.003, 0.004, 0.0, 1.0).normalize().as_quat();
    let (mut place, mut rotation) = (pair.pose_a.position(), pair.pose_a.rotation());
    let mut frame = || {
        place += DVec3::new(0.08, 0.0, 0.06);
        rotation = product(rotation, spin);
        let length = rotation.as_dquat().length();
        let exact = rotation.as_dquat() * (1.0 / length);
        PosedPair3 {
            pose_a: Pose3::new(place, rotation).expect(IN_RANGE),
            pose_b: Pose3::new(place + exact * way, ((exact * turn) * length).as_quat()).expect(IN_RANGE),
            ..pair.clone()
        }
    };
    (0..frames).map(|_| frame()).collect()
}

/// Hamilton's product in f32, as in a game's integrator.
fn product(a: Quat, b: Quat) -> Quat {
    Quat::from_xyzw(
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    )
}

/// Bodies on one another, each placed so that it just touches the one below.
fn standing(name: &str, shape: &Shape3) -> StabilityRow {
    let mut solver = Solver::new(Settings::default());
    let floor = Cuboid::from_half_extents(Vec3::new(20.0, 1.0, 20.0)).expect(IN_RANGE);
    let at = |height: f64| Pose3::at(DVec3::Y * height).expect(IN_RANGE);
    solver.add(floor, at(-1.0), true);
    let half = shape.core().vertices().iter().map(|vertex| f64::from(vertex.y)).fold(0.0, f64::max);
    for index in 0..STACKED {
        solver.add(shape.clone(), at(half * (2.0 * index as f64 + 1.0)), false);
    }
    let start: Vec<DVec3> = solver.bodies.iter().map(|body| body.center).collect();
    for _ in 0..(SECONDS / STEP) as usize {
        solver.step();
    }
    let moved = start.iter().zip(&solver.bodies).skip(1);
    let moved: Vec<f64> = moved.map(|(from, body)| 1e3 * body.center.distance(*from)).collect();
    row("standing-stack", name, "certain", "mm", &moved).expect("a stack has bodies")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_ulps_and_move_what_they_move() {
        let place = Place::new(&rest3(SolidKind::Box, SUNK, 1, 3)[0]);
        assert!(place.steps.len() >= 12);
        for (pair, moved) in &place.steps {
            assert!((1e-9..1e-5).contains(moved), "{moved}");
            assert_ne!(pair.pose_b, place.pair.pose_b);
        }
    }

    #[test]
    fn what_shakes_is_seen_to_shake() {
        let places: Vec<Place> = rest3(SolidKind::Box, SUNK, 4, 3).iter().map(Place::new).collect();
        let by_bits: Points = |frames| Some(frames.last()?.pose_b.rotation().x.to_bits() as usize % 2);
        let steady: Points = |_| Some(4);
        assert!(percent_changed(&places, by_bits, false) > 5.0);
        assert_eq!(percent_changed(&places, steady, true), 0.0);
        assert!((angle(DVec3::X, DVec3::Y) - 90.0).abs() < 1e-12);
        assert_eq!(angle(DVec3::X, DVec3::X), 0.0);
        assert_eq!(angle(DVec3::X, DVec3::ZERO), 180.0);
    }

    #[test]
    fn carried_pairs_stay_as_deep_as_they_are() {
        let pairs = carried(&rest3(SolidKind::Box, SUNK, 1, 5)[0], 300);
        for (pair, truth) in pairs.iter().zip(truths(&pairs)) {
            assert!((truth.separation / truth.size + SUNK).abs() < 1e-6, "{truth:?}");
            assert!(pair.pose_a.position().length() < 50.0);
        }
        let length = |pair: &PosedPair3| pair.pose_a.rotation().as_dquat().length();
        assert_ne!(length(&pairs[0]), length(&pairs[299]));
    }

    #[test]
    fn every_measure_gives_a_row_and_ours_is_steady() {
        let mut rows = of_ulps("box", &rest3(SolidKind::Box, SUNK, 40, 3));
        rows.extend(of_ulps("box, aligned", &aligned(40)));
        rows.extend(drifting(SolidKind::Box, 50));
        rows.push(standing("box", &Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap().into()));
        assert_eq!(rows.len(), 2 * (2 * 5 + 2 * 3) + 5 + 1);
        for row in rows.iter().filter(|row| row.method == "certain") {
            assert!(row.samples > 0 && row.median <= row.p99 && row.p99 <= row.max, "{row:?}");
            let most = match row.measure.as_str() {
                "jitter-1ulp" => 30.0,
                "count-changes" => 5.0,
                "normal-flips" => 1.0,
                "drifting-depth" => 1e-6,
                _ => 100.0,
            };
            assert!(row.max <= most, "{row:?}");
        }
    }
}
