//! Every kind of shape against every other, in both orders: every claim about a pair is checked for all of them.

mod compounds;
mod contacts;
mod exact;
mod extents;
mod refusals;
mod shrinking;
mod worlds;

use asunder_tests::answers::{Asked, Manifold, Measured};
use asunder_tests::bodies::{Bodies2, Bodies3};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{KINDS2, KINDS3, PLACES, pair2, pair3};

/// Rounding of the oracles themselves, as a share of the pair's reach: some forty roundings in f64.
const JUDGES: f64 = 3e-14;

/// A normal is reported in f32: its direction is off by up to 1e-7, which shifts points at the pair's reach by that
/// share.
const NORMAL: f64 = 2e-7;

/// A point may be off its shape by this share of the pair's size: faces count as flat within a few 2.5e-7, a face is
/// preferred to another axis within 5e-7, and anchors are f32.
const ON_SHAPE: f64 = 2e-6;

/// One pair with everything it is checked against.
struct Judged<'a, T> {
    asked: &'a T,
    truth: f64,
    /// The sum of the finite bounding radii.
    size: f64,
    /// The size and the distance of the positions: the scale of projections.
    reach: f64,
}

impl<T: Asked> Judged<'_, T> {
    fn check_measured(&self, measured: &Measured, what: &str) {
        let Self { truth, size, reach, asked } = *self;
        let Measured { separation, error, normal_length, gap_along_normal } = *measured;
        assert!(
            (separation - truth).abs() <= error + JUDGES * reach,
            "{what}: reported {separation} +- {error}, true {truth}: {asked:?}"
        );
        assert!((normal_length - 1.0).abs() <= 2e-7, "{what}: a normal of length {normal_length}: {asked:?}");
        assert!(
            gap_along_normal >= separation - error - NORMAL * reach,
            "{what}: the normal shows {gap_along_normal}, reported {separation} +- {error}: {asked:?}"
        );
        // A useless error bound would make every other check here empty.
        let most = 4e-6 * size + 1e-7 * separation.abs() + JUDGES * reach;
        assert!(error <= most, "{what}: error {error} of {size}: {asked:?}");
    }

    fn check_separations(&self) {
        let Self { truth, reach, asked, .. } = *self;
        let overlaps = asked.overlaps();
        if truth.abs() > JUDGES * reach {
            assert_eq!(overlaps, truth < 0.0, "true separation {truth}: {asked:?}");
        }
        let Ok(measured) = asked.separation(f32::INFINITY) else {
            panic!("no limit, yet no measure: {asked:?}")
        };
        self.check_measured(&measured, "separation");
        assert_eq!(measured.separation <= 0.0, overlaps, "the sign is the decision's: {asked:?}");
        for share in [0.0, 1e-3, 0.1, 0.5] {
            let limit = (share * self.size) as f32;
            match asked.separation(limit) {
                Ok(measured) => self.check_measured(&measured, &format!("separation({limit})")),
                Err(bound) => {
                    let most = truth + JUDGES * reach;
                    assert!(f64::from(bound) <= most, "at least {bound}, true {truth}: {asked:?}");
                    assert!(bound >= limit, "at least {bound} says less than the limit {limit}: {asked:?}");
                    assert!(!overlaps, "a bound above zero, yet they overlap: {asked:?}");
                }
            }
        }
        let distance = asked.distance();
        assert_eq!(distance.is_none(), overlaps, "closest points exactly where there is a gap: {asked:?}");
        if let Some(nearest) = distance {
            self.check_measured(&nearest.measured, "distance");
            assert!(nearest.measured.separation > 0.0);
            // Points are rounded to f32 once. Across a tiny gap their direction is noise, so only lengths are checked.
            let (on, error) = (NORMAL * reach, nearest.measured.error);
            let points = nearest.points;
            let on_shapes = points.beyond_a.abs() <= on + error && points.beyond_b.abs() <= on + error;
            assert!(on_shapes, "points on the shapes: {points:?} of {asked:?}");
            let apart = points.along_normal.hypot(points.across_normal);
            assert!(
                (apart - truth).abs() <= error + 2.0 * on,
                "points {apart} apart, true {truth}: {asked:?}"
            );
        }
    }

    /// Checks the manifold within `margin`, and whether there must be one.
    fn check_manifold(&self, margin: f64, most: usize) {
        let Self { truth, size, reach, asked } = *self;
        let manifold = asked.manifold(margin as f32);
        let margin = f64::from(margin as f32);
        if margin == 0.0 {
            assert_eq!(manifold.is_some(), asked.overlaps(), "exactly when they overlap: {asked:?}");
        } else if (truth - margin).abs() > 4e-6 * size + JUDGES * reach {
            assert_eq!(manifold.is_some(), truth < margin, "margin {margin}, true {truth}: {asked:?}");
        }
        if let Some(manifold) = manifold {
            self.check_points(&manifold, margin, most);
        }
    }

    /// Checks a manifold of the pair, or of a pair of its parts.
    fn check_points(&self, manifold: &Manifold, margin: f64, most: usize) {
        let Self { truth, size, reach, asked } = *self;
        let slack = ON_SHAPE * size + NORMAL * reach;
        let measured = manifold.measured;
        let off = (measured.separation - truth).abs();
        assert!(off <= measured.error + JUDGES * reach, "{measured:?}, true {truth}: {asked:?}");
        assert!(
            measured.gap_along_normal >= truth - slack,
            "the normal shows {measured:?}, true {truth}: {asked:?}"
        );
        let contacts = &manifold.contacts;
        assert!((1..=most).contains(&contacts.len()), "{} points: {asked:?}", contacts.len());
        assert!(contacts.is_sorted_by(|a, b| a.feature < b.feature), "{contacts:?} of {asked:?}");
        for contact in contacts {
            let points = contact.points;
            let on_shapes = points.beyond_a <= slack && points.beyond_b <= slack;
            assert!(on_shapes, "points on the shapes: {contact:?}, true {truth}, of {asked:?}");
            assert!((points.along_normal - contact.separation).abs() <= slack, "{contact:?} of {asked:?}");
            assert!(points.across_normal <= slack, "one above the other: {contact:?} of {asked:?}");
            assert!(contact.separation <= margin + slack, "beyond {margin}: {contact:?} of {asked:?}");
        }
        let deepest = contacts.iter().min_by(|a, b| a.separation.total_cmp(&b.separation)).unwrap();
        let off = (deepest.separation - measured.separation).abs();
        assert!(off <= slack, "deepest {deepest:?}, {measured:?}: {asked:?}");
        let points = deepest.points;
        let on_surfaces = points.beyond_a >= -slack && points.beyond_b >= -slack;
        assert!(on_surfaces, "the deepest on both surfaces: {deepest:?}, true {truth}, of {asked:?}");
    }

    /// With A and B swapped: the same decision, the same number, the opposite normal.
    fn check_swapped(&self) {
        let Self { truth, size, reach, asked } = *self;
        let swapped = asked.swapped();
        if truth.abs() > JUDGES * reach {
            assert_eq!(asked.overlaps(), swapped.overlaps(), "{asked:?}");
        }
        let [one, other] = [asked.separation(f32::INFINITY), swapped.separation(f32::INFINITY)]
            .map(|measured| measured.unwrap());
        let slack = one.error + other.error + JUDGES * reach;
        assert!((one.separation - other.separation).abs() <= slack, "{one:?}, {other:?}: {asked:?}");
        // Features swap sides with their shapes, unless several pairs of them are equally good.
        let [one, other] = [asked.manifold(0.0), swapped.manifold(0.0)];
        if let (Some(one), Some(other)) = (one, other)
            && truth < -1e-3 * size
        {
            let off = (one.measured.separation - other.measured.separation).abs();
            assert!(off <= slack, "{one:?}, {other:?}: {asked:?}");
        }
    }
}

/// Runs every ordered pair of `kinds` rows through all relative poses and counts both signs of each.
fn tour<T: Asked>(
    names: &[&str],
    rounds: usize,
    make: impl Fn(usize, usize, usize) -> (T, f64, f64),
    most: usize,
) {
    let kinds = names.len();
    // Two sheets or needles rarely meet unless they are moved together.
    let is_sheet = |kind: usize| ["flat hull", "triangle", "segment"].contains(&names[kind]);
    for a in 0..kinds {
        // The last row is the half-space or half-plane: two of them are tested separately (`contacts`).
        for b in 0..kinds - usize::from(a + 1 == kinds) {
            let (mut apart, mut overlapping) = (0, 0);
            for round in 0..rounds {
                let (asked, truth, reach) = make(a, b, round);
                let size = asked.size();
                let judged = Judged { asked: &asked, truth, size, reach };
                judged.check_separations();
                judged.check_manifold(0.0, most);
                judged.check_manifold([1e-3, 0.02, 0.2][round % 3] * size, most);
                judged.check_swapped();
                *if truth > 0.0 { &mut apart } else { &mut overlapping } += 1;
            }
            let least = if is_sheet(a) && is_sheet(b) { 1 } else { rounds / 20 };
            let what = format!("{apart} apart, {overlapping} in overlap: {}, {}", names[a], names[b]);
            assert!(apart >= least && overlapping >= least, "{what}");
        }
    }
}

#[test]
fn every_kind_in_space_against_every_other() {
    tour(
        &KINDS3.map(|kind| kind.0),
        6 * PLACES,
        |a, b, round| {
            let seed = ((a * KINDS3.len() + b) * 1_000_000 + round) as u128;
            let bodies: Bodies3 = pair3(&mut Random::new(seed), &KINDS3[a], &KINDS3[b], round);
            let (truth, reach) = (bodies.true_separation(), bodies.reach());
            (bodies, truth, reach)
        },
        4,
    );
}

#[test]
fn every_kind_in_the_plane_against_every_other() {
    tour(
        &KINDS2.map(|kind| kind.0),
        12 * PLACES,
        |a, b, round| {
            let seed = ((a * KINDS2.len() + b) * 1_000_000 + round) as u128;
            let bodies: Bodies2 = pair2(&mut Random::new(seed), &KINDS2[a], &KINDS2[b], round);
            let (truth, reach) = (bodies.true_separation(), bodies.reach());
            (bodies, truth, reach)
        },
        2,
    );
}
