//! Units of length and the origin, for hard pairs of every kind: with powers of two every bit follows.

mod bodies;

use asunder_geometry::tolerance::{MAX_POSITION, MAX_RADIUS, MIN_RADIUS};
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use asunder_narrow::{Pair2, Pair3, Separation2, Separation3, Verdict};
use asunder_scenes::hard::{FAMILIES2, FAMILIES3};
use asunder_tests::cases::{Case2, Case3, Random};
use bodies::{InUnits, Reach, power_of_two};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// Hard pairs and random ones in space.
fn cases3(each: usize, seed: u64) -> Vec<Case3> {
    let hard = FAMILIES3.iter().flat_map(|family| family.pairs(each, seed));
    let hard =
        hard.map(|p| Case3 { shape_a: p.shape_a, pose_a: p.pose_a, shape_b: p.shape_b, pose_b: p.pose_b });
    let mut random = Random::new(seed.into());
    let random = (0..300).map(|round| super::mixed_case3(&mut random, round)).collect::<Vec<_>>();
    hard.chain(random).collect()
}

/// Hard pairs and random ones in the plane.
fn cases2(each: usize, seed: u64) -> Vec<Case2> {
    let hard = FAMILIES2.iter().flat_map(|family| family.pairs(each, seed));
    let hard =
        hard.map(|p| Case2 { shape_a: p.shape_a, pose_a: p.pose_a, shape_b: p.shape_b, pose_b: p.pose_b });
    let mut random = Random::new(seed.into());
    let random = (0..300).map(|round| super::mixed_case2(&mut random, round)).collect::<Vec<_>>();
    hard.chain(random).collect()
}

/// The same pair in other units, if every number of it keeps all its bits and all shapes keep the order of their
/// vertices.
fn in_units3(case: &Case3, k: i32) -> Option<Case3> {
    Some(Case3 {
        shape_a: case.shape_a.in_units(k)?,
        pose_a: case.pose_a.in_units(k)?,
        shape_b: case.shape_b.in_units(k)?,
        pose_b: case.pose_b.in_units(k)?,
    })
}

fn in_units2(case: &Case2, k: i32) -> Option<Case2> {
    Some(Case2 {
        shape_a: case.shape_a.in_units(k)?,
        pose_a: case.pose_a.in_units(k)?,
        shape_b: case.shape_b.in_units(k)?,
        pose_b: case.pose_b.in_units(k)?,
    })
}

/// `scaled` gives the same shapes as scaling number by number here.
#[test]
fn scaled_shapes_are_those_in_other_units() {
    let mut count = 0;
    let factor = |k: i32| power_of_two(k) as f32;
    for (case, k) in cases3(3, 77).iter().flat_map(|case| [-9, 1, 12].map(|k| (case, k))) {
        for shape in [&case.shape_a, &case.shape_b] {
            let Some(by_number) = shape.in_units(k) else { continue };
            let scaled = shape.scaled(Vec3::splat(factor(k))).unwrap();
            assert_eq!(scaled.core().vertices(), by_number.core().vertices(), "2^{k} {shape:?}");
            let sizes = |shape: &Shape3| (shape.radius(), shape.outer_radius(), shape.center());
            assert_eq!(sizes(&scaled), sizes(&by_number), "2^{k} {shape:?}");
            count += 1;
        }
    }
    for (case, k) in cases2(3, 77).iter().flat_map(|case| [-9, 1, 12].map(|k| (case, k))) {
        for shape in [&case.shape_a, &case.shape_b] {
            let Some(by_number) = shape.in_units(k) else { continue };
            let scaled = shape.scaled(Vec2::splat(factor(k))).unwrap();
            assert_eq!(scaled.core().vertices(), by_number.core().vertices(), "2^{k} {shape:?}");
            let sizes = |shape: &Shape2| (shape.radius(), shape.outer_radius(), shape.center());
            assert_eq!(sizes(&scaled), sizes(&by_number), "2^{k} {shape:?}");
            count += 1;
        }
    }
    assert!(count > 2000, "{count}");
}

/// Everything that is reported for a pair, as numbers.
#[derive(Clone, Debug, PartialEq)]
struct Said {
    verdict: Verdict,
    guess: bool,
    /// In metres.
    lengths: Vec<f32>,
    /// What has no unit: bits of normals, feature ids, parts.
    names: Vec<u64>,
}

impl Said {
    fn direction(&mut self, coordinates: &[f32]) {
        self.names.extend(coordinates.iter().map(|c| u64::from(c.to_bits())));
    }

    /// Whether `other` is this in units of 2^-k metres. Lengths below the least normal f32 have no bits to keep.
    fn is_in_units(&self, other: &Self, k: i32) -> bool {
        let follows = |(&one, &other): (&f32, &f32)| {
            let expected = f64::from(one) * power_of_two(k);
            let is_short = expected.abs().min(f64::from(one).abs()) < f64::from(f32::MIN_POSITIVE);
            if is_short && one != 0.0 { f64::from(other).abs() < 1e-37 } else { f64::from(other) == expected }
        };
        (self.verdict, self.guess, &self.names) == (other.verdict, other.guess, &other.names)
            && self.lengths.len() == other.lengths.len()
            && self.lengths.iter().zip(&other.lengths).all(follows)
    }
}

fn said3(case: &Case3, margin: f64) -> Said {
    let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
    let Separation3::Measured(found) = pair.separation(f32::INFINITY) else { panic!("there is no limit") };
    let mut said = Said { verdict: pair.verdict(), guess: pair.guess(), lengths: vec![], names: vec![] };
    said.lengths.extend([found.separation, found.error]);
    said.direction(&found.normal.to_array());
    if let Some(closest) = pair.distance() {
        said.lengths.extend([closest.distance, closest.error]);
        said.lengths.extend([closest.anchor_a.to_array(), closest.anchor_b.to_array()].concat());
        said.direction(&closest.normal.to_array());
    }
    for manifold in pair.manifolds(margin as f32) {
        said.lengths.extend([manifold.separation, manifold.error]);
        said.direction(&manifold.normal.to_array());
        said.names.extend([u64::from(manifold.part_a), u64::from(manifold.part_b)]);
        for point in &manifold.points {
            said.lengths.push(point.separation);
            said.lengths.extend([point.anchor_a.to_array(), point.anchor_b.to_array()].concat());
            said.names.push(point.feature.to_bits());
        }
    }
    said
}

fn said2(case: &Case2, margin: f64) -> Said {
    let pair = Pair2::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
    let Separation2::Measured(found) = pair.separation(f32::INFINITY) else { panic!("there is no limit") };
    let mut said = Said { verdict: pair.verdict(), guess: pair.guess(), lengths: vec![], names: vec![] };
    said.lengths.extend([found.separation, found.error]);
    said.direction(&found.normal.to_array());
    if let Some(closest) = pair.distance() {
        said.lengths.extend([closest.distance, closest.error]);
        said.lengths.extend([closest.anchor_a.to_array(), closest.anchor_b.to_array()].concat());
        said.direction(&closest.normal.to_array());
    }
    for manifold in pair.manifolds(margin as f32) {
        said.lengths.extend([manifold.separation, manifold.error]);
        said.direction(&manifold.normal.to_array());
        said.names.extend([u64::from(manifold.part_a), u64::from(manifold.part_b)]);
        for point in &manifold.points {
            said.lengths.push(point.separation);
            said.lengths.extend([point.anchor_a.to_array(), point.anchor_b.to_array()].concat());
            said.names.push(point.feature.to_bits());
        }
    }
    said
}

/// A twentieth of the finite bounding radii, rounded to a power of two, so that a margin scales like everything else.
fn margin(reach: &Reach) -> f64 {
    power_of_two((0.05 * reach.outer).log2().floor() as i32)
}

/// The exponents to try: the smallest and the largest that leave the shapes in range, and two between.
fn exponents(reach: &Reach) -> Vec<i32> {
    let low = (f64::from(MIN_RADIUS) / reach.least).log2().ceil() as i32;
    let high = (f64::from(MAX_RADIUS) / reach.furthest).log2().floor() as i32;
    let high = high.min((MAX_POSITION / reach.position.max(1e-3)).log2().floor() as i32);
    let mut list = vec![low, low / 2, high / 2, high];
    list.retain(|&k| k != 0 && (low..=high).contains(&k));
    list.dedup();
    list
}

#[test]
fn units_of_length_for_hard_solids() {
    let (mut compared, mut widest) = (0, [0; 2]);
    let cases = cases3(40, 510);
    for case in &cases {
        // As rebuilt from its own vertices.
        let Some(base) = in_units3(case, 0) else { continue };
        let reach = Reach::of3(&base);
        let margin = margin(&reach);
        let here = said3(&base, margin);
        for k in exponents(&reach) {
            let Some(other) = in_units3(&base, k) else { continue };
            let there = said3(&other, margin * power_of_two(k));
            assert!(here.is_in_units(&there, k), "2^{k}:\n{here:?}\n{there:?}\n{base:?}");
            compared += 1;
            widest = [widest[0].min(k), widest[1].max(k)];
        }
    }
    eprintln!("{compared} scaled pairs from {} cases, 2^{} to 2^{}", cases.len(), widest[0], widest[1]);
    assert!(compared > 2 * cases.len() && widest[0] <= -18 && widest[1] >= 18, "{compared}, {widest:?}");
}

#[test]
fn units_of_length_for_hard_pairs_in_the_plane() {
    let (mut compared, mut widest) = (0, [0; 2]);
    let cases = cases2(40, 511);
    for case in &cases {
        let Some(base) = in_units2(case, 0) else { continue };
        let reach = Reach::of2(&base);
        let margin = margin(&reach);
        let here = said2(&base, margin);
        for k in exponents(&reach) {
            let Some(other) = in_units2(&base, k) else { continue };
            let there = said2(&other, margin * power_of_two(k));
            assert!(here.is_in_units(&there, k), "2^{k}:\n{here:?}\n{there:?}\n{base:?}");
            compared += 1;
            widest = [widest[0].min(k), widest[1].max(k)];
        }
    }
    eprintln!("{compared} scaled pairs from {} cases, 2^{} to 2^{}", cases.len(), widest[0], widest[1]);
    assert!(compared > 2 * cases.len() && widest[0] <= -18 && widest[1] >= 18, "{compared}, {widest:?}");
}

/// Rounded to a multiple of a power of two.
fn on_grid(v: f64, grid: f64) -> f64 {
    (v / grid).round() * grid
}

/// Where both bodies are moved to, and a grid for positions such that no bit of any is lost there.
const SHIFTS: [([f64; 3], f64); 3] = [
    ([1024.0, -512.0, 96.0], 1.0 / 1_099_511_627_776.0),
    ([1e6, 3e6, -2e6], 1.0 / 268_435_456.0),
    ([9.8e8, -9.8e8, 5e8], 1.0 / 8_388_608.0),
];

#[test]
fn where_the_origin_is_for_hard_solids() {
    for case in cases3(40, 512) {
        let margin = margin(&Reach::of3(&case));
        for (shift, grid) in SHIFTS {
            // From close to the origin, wherever the case was built; B keeps its place relative to A.
            let between = case.pose_b.position() - case.pose_a.position();
            let at = |place: DVec3| DVec3::from_array(place.to_array().map(|x| on_grid(x, grid)));
            let (a, b) = (at(between * -0.25), at(between * 0.75));
            let placed = |shift: DVec3| Case3 {
                pose_a: Pose3::new(a + shift, case.pose_a.rotation()).unwrap(),
                pose_b: Pose3::new(b + shift, case.pose_b.rotation()).unwrap(),
                ..case.clone()
            };
            let shift = DVec3::from_array(shift);
            assert!((a + shift) - shift == a && (b + shift) - shift == b, "no bit is lost");
            let (here, there) = (said3(&placed(DVec3::ZERO), margin), said3(&placed(shift), margin));
            assert_eq!(here, there, "moved by {shift}: {case:?}");
        }
    }
}

#[test]
fn where_the_origin_is_for_hard_pairs_in_the_plane() {
    for case in cases2(40, 513) {
        let margin = margin(&Reach::of2(&case));
        for (shift, grid) in SHIFTS {
            let between = case.pose_b.position() - case.pose_a.position();
            let at = |place: DVec2| DVec2::from_array(place.to_array().map(|x| on_grid(x, grid)));
            let (a, b) = (at(between * -0.25), at(between * 0.75));
            let placed = |shift: DVec2| Case2 {
                pose_a: Pose2::new(a + shift, case.pose_a.rotation()).unwrap(),
                pose_b: Pose2::new(b + shift, case.pose_b.rotation()).unwrap(),
                ..case.clone()
            };
            let shift = DVec3::from_array(shift).truncate();
            assert!((a + shift) - shift == a && (b + shift) - shift == b, "no bit is lost");
            let (here, there) = (said2(&placed(DVec2::ZERO), margin), said2(&placed(shift), margin));
            assert_eq!(here, there, "moved by {shift}: {case:?}");
        }
    }
}
