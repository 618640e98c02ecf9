//! The axis that the proof by a facet calls the best is the best of all, whatever a hint named.

use super::*;
use crate::polyhedron::sat::hinted::Judged;
use crate::{Pair3, Separation3};

/// Hulls of 32 vertices on a sphere, boxes as hulls, and what [`Random::hull`] makes.
fn hull(random: &mut Random, kind: u64) -> Shape3 {
    let points: Vec<Vec3> = match kind % 3 {
        0 => return random.round_hull(32),
        1 => {
            let half = random.vector().abs() * 0.5 + 0.5;
            (0..8).map(|i| half * Vec3::new(sign(i), sign(i / 2), sign(i / 4))).collect()
        }
        _ => return random.hull(kind / 3),
    };
    Hull::from_points(&points).unwrap().into()
}

fn sign(bit: i32) -> f32 {
    if bit % 2 == 0 { 1.0 } else { -1.0 }
}

/// The best axis by projecting every vertex on every normal and on every cross product.
pub(super) fn exhaustive(a: &Solid, b: &Solid) -> f64 {
    let projected = |normal: DVec3| b.project(normal).0 - a.project(normal).1;
    let of_a = (0..a.face_count()).map(|face| projected(a.normal(face)));
    let of_b = (0..b.face_count()).map(|face| projected(-b.normal(face)));
    of_a.chain(of_b).fold(all_edge_pairs(a, b), f64::max)
}

/// Every axis that a hint can name: all faces, and every `stride`-th pair of edges.
fn every_axis(a: &Solid, b: &Solid, stride: usize) -> Vec<AxisOf> {
    let faces_a = (0..a.face_count()).map(AxisOf::FaceA);
    let faces_b = (0..b.face_count()).map(AxisOf::FaceB);
    let edges = |solid: &Solid| solid.topology.edges().to_vec();
    let pairs = edges(a).into_iter().flat_map(|edge_a| {
        edges(b).into_iter().map(move |edge_b| AxisOf::Edges(edge_a.into(), edge_b.into()))
    });
    faces_a.chain(faces_b).chain(pairs.step_by(stride)).collect()
}

/// How deep pairs overlap, as a share of their size.
const DEPTHS: [f64; 4] = [1e-6, 1e-3, 0.01, 0.02];

/// A pair that overlaps by one of [`DEPTHS`], with B in some direction from A; every fifth lies anywhere near.
pub(super) fn placed(random: &mut Random, shapes: [&Shape3; 2], case: u64) -> [Pose3; 2] {
    let turns = [random.turn(case / 2), random.turn(case / 3)];
    let posed =
        |at: DVec3| [(DVec3::ZERO, turns[0]), (at, turns[1])].map(|(at, turn)| Pose3::new(at, turn).unwrap());
    let towards = random.vector().normalize_or(Vec3::X).as_dvec3();
    if case.is_multiple_of(5) {
        return posed(towards * 0.5);
    }
    let deep = DEPTHS[case as usize % 4];
    let place = sunk(shapes, deep, |at| posed(towards * at));
    posed(towards * place)
}

/// How far out B must be to overlap A by this share of their size.
fn sunk(shapes: [&Shape3; 2], deep: f64, posed: impl Fn(f64) -> [Pose3; 2]) -> f64 {
    // In a convex difference only one place along the ray has this depth, beyond the deepest.
    let (mut near, mut far) = (0.0, 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        let poses = posed(middle);
        let pair = Pair3::new(shapes[0], &poses[0], shapes[1], &poses[1]);
        let is_deeper = match pair.separation(0.0) {
            Separation3::Measured(found) => f64::from(found.separation) < -deep * f64::from(pair.size()),
            Separation3::AtLeast(_) => false,
        };
        if is_deeper { near = middle } else { far = middle }
    }
    near
}

/// What came of the axes, each judged and walked from.
#[derive(Debug, Default)]
struct Tally {
    proved: usize,
    edges_proved: usize,
    /// Pairs that overlap by more than rounding, and those of them whose best axis was proved to be the best.
    deep: usize,
    deep_proved: usize,
    /// Those of them that overlap by a fiftieth of their size at most.
    shallow: usize,
    shallow_proved: usize,
    /// Axes that are worse than the best by more than rounding, and those of them for which a better direction was
    /// found.
    stale: usize,
    beaten: usize,
    /// Those from which a walk led to the best.
    led: usize,
    /// Axes of separated pairs from which a walk led to one that shows it.
    parted: usize,
}

impl Tally {
    /// Judges axes of a pair, and walks from each.
    fn look(&mut self, (a, b): (&Solid, &Solid), pair: &Convex, axes: Vec<AxisOf>, case: u64) {
        let best = exhaustive(a, b);
        let mut is_best_proved = false;
        for of in axes {
            let Some(hinted) = Hinted::new((a, b), hint_to(of), &pair.precision) else { continue };
            let shown = hinted.axis.separation;
            let error = f64::from(pair.precision.of_separation(shown, hinted.doubt));
            let is_stale = best < -1e-6 && best - shown > error;
            self.stale += usize::from(is_stale);
            match hinted.judged((a, b), &pair.precision) {
                Judged::Best(axes) => {
                    let error = f64::from(pair.precision.of_separation(shown, axes.short()));
                    assert!(
                        best < 0.0 && best - shown <= error,
                        "case {case}: {of:?} shows {shown}, the best is {best}"
                    );
                    (self.proved, is_best_proved) = (self.proved + 1, true);
                    self.edges_proved += usize::from(matches!(of, AxisOf::Edges(..)));
                }
                Judged::Beaten(direction) => {
                    let overlap = a.project(direction).1 - b.project(direction).0;
                    let doubt = 2.0 * pair.precision.doubt_of_depth() + 1e-6 * pair.precision.reach;
                    assert!(
                        (direction.length() - 1.0).abs() < 1e-9 && overlap <= doubt - shown,
                        "case {case}: {of:?} shows {shown}, and {direction} overlaps by {overlap}"
                    );
                    self.beaten += usize::from(is_stale);
                }
                Judged::Open => {}
            }
            match hinted.walk((a, b), &pair.precision) {
                Ended::Best(axes) => {
                    let shown = axes.best().separation;
                    let error = f64::from(pair.precision.of_separation(shown, axes.short()));
                    assert!(
                        best < 0.0 && (best - shown).abs() <= error,
                        "case {case}: from {of:?} to {shown}, the best is {best}"
                    );
                    self.led += usize::from(is_stale);
                }
                Ended::Apart(axis) => {
                    let truth = b.project(axis.normal).0 - a.project(axis.normal).1;
                    let doubt = pair.precision.doubt_of_depth();
                    assert!(
                        (truth - axis.separation).abs() <= doubt,
                        "case {case}: {of:?}, {axis:?}, {truth}"
                    );
                    assert!(best >= -2.0 * doubt, "case {case}: {of:?}, {axis:?}, the best is {best}");
                    self.parted += usize::from(shown < -doubt);
                }
                Ended::Open(separation) => {
                    let rounding = pair.precision.projection() * 2.0;
                    assert!(
                        (shown..=best + rounding).contains(&separation),
                        "case {case}: {of:?}, {separation}"
                    );
                }
            }
        }
        // Flat hulls have no inside, and what overlaps by less than rounding has no direction.
        let is_solid = a.inner_radius > 0.05 && b.inner_radius > 0.05;
        if is_solid && best < -1e-9 {
            self.deep += 1;
            self.deep_proved += usize::from(is_best_proved);
            let is_shallow = best > -0.02 * pair.precision.size;
            self.shallow += usize::from(is_shallow);
            self.shallow_proved += usize::from(is_shallow && is_best_proved);
        }
    }
}

#[test]
fn only_the_best_axis_is_proved_and_walks_lead_to_it() {
    let mut random = Random(0xA076_1D64_78BD_642F);
    let mut tally = Tally::default();
    for case in 0..400_u64 {
        let (shape_a, shape_b) = (hull(&mut random, case), hull(&mut random, case / 3));
        let [pose_a, pose_b] = placed(&mut random, [&shape_a, &shape_b], case);
        let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
        pair.with_solids(|a, b| {
            let stride = 1 + 7 * (case as usize % 3);
            let axes = every_axis(a, b, stride).into_iter().chain([own_best(&pair, a, b)]).collect();
            tally.look((a, b), &pair, axes, case);
        });
    }
    assert!(tally.stale > 50_000 && tally.proved > 200 && tally.edges_proved > 10, "{tally:?}");
    assert!(tally.shallow > 100 && tally.shallow_proved * 100 > tally.shallow * 98, "{tally:?}");
    assert!(tally.deep > 300 && tally.deep_proved * 5 > tally.deep * 4, "{tally:?}");
    assert!(tally.beaten > 500 && tally.led > 100_000, "{tally:?}");
}

/// Whole edges are furthest most of the time, and the ball in the middle covers little.
#[test]
fn what_stands_upright_side_by_side_is_proved_by_whole_edges() {
    let mut random = Random(0x94D0_49BB_1331_11EB);
    let mut tally = Tally::default();
    for case in 0..600_u64 {
        let ([shape_a, shape_b], turns, at) = upright(&mut random, case);
        let posed = |out: f64| {
            [(DVec3::ZERO, turns[0]), (at(out), turns[1])].map(|(at, turn)| Pose3::new(at, turn).unwrap())
        };
        let out = sunk([&shape_a, &shape_b], [1e-4, 0.005, 0.01, 0.03][case as usize % 4], posed);
        // Further in, where the way out past A's end may be shorter than to the side.
        let [pose_a, pose_b] = posed(out * [1.0, 0.95, 0.9][case as usize % 3]);
        let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
        pair.with_solids(|a, b| tally.look((a, b), &pair, every_axis(a, b, 5), case));
    }
    assert!(
        tally.stale > 30_000 && tally.proved > 400 && tally.beaten > 1000 && tally.led > 3000,
        "{tally:?}"
    );
    assert!(tally.deep > 400 && tally.deep_proved * 100 > tally.deep * 98, "{tally:?}");
}

/// The axis that the full test finds best.
fn own_best(pair: &Convex, a: &Solid, b: &Solid) -> AxisOf {
    pair.all_axes(a, b, f64::NEG_INFINITY).best().of
}

#[test]
fn a_hint_of_features_that_are_not_there_names_no_axis() {
    let mut random = Random(0xE703_7ED1_A0B4_28DB);
    let (shape_a, shape_b) = (hull(&mut random, 0), hull(&mut random, 1));
    let pair = convex(&shape_a, Pose3::IDENTITY, &shape_b, Pose3::IDENTITY);
    pair.with_solids(|a, b| {
        let none = |of: AxisOf| Hinted::new((a, b), hint_to(of), &pair.precision).is_none();
        let (faces, edges) =
            ([a.face_count(), b.face_count()], [a, b].map(|solid| solid.topology.half_edges().len()));
        assert!(!none(AxisOf::FaceA(faces[0] - 1)) && none(AxisOf::FaceA(faces[0])));
        assert!(!none(AxisOf::FaceB(faces[1] - 1)) && none(AxisOf::FaceB(faces[1])));
        assert!(none(AxisOf::Edges(edges[0], 0)) && none(AxisOf::Edges(0, edges[1])));
    });
}
