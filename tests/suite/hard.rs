//! Never wrong: every promise on 100,000 hard cases of all families, against exact arithmetic and double-double.
//!
//! One run serves all tests here. `cargo run --release -p asunder-tests --bin hard` runs ten times as many, and
//! parry3d. A failure names the family, how many of its cases fail, and level and seed of the first, so that
//! `Family3::by_name(NAME).pair(LEVEL, SEED)` is the case.

use asunder_scenes::hard::{FAMILIES2, FAMILIES3};
use asunder_tests::report::{FaultKind, Row, Scope, Tally, Times, header, shares, tally, weight};
use rayon::prelude::*;
use std::sync::OnceLock;

/// Total number of cases.
const CASES: usize = 100_000;

/// Separations are judged on every k-th case of each level, since they take the oracles longest; this is k.
const TRUTH_EVERY: usize = 10;

/// Every family's tally, made on all processors by whichever test comes first: the other tests here wait for it.
fn tallies() -> &'static [Tally] {
    static TALLIES: OnceLock<Vec<Tally>> = OnceLock::new();
    TALLIES.get_or_init(|| {
        let weights = FAMILIES3.iter().map(weight).chain(FAMILIES2.iter().map(weight));
        let shares = shares(&weights.collect::<Vec<f64>>(), CASES);
        let scope = |cases: &usize| Scope { cases: *cases, truth_every: TRUTH_EVERY, seed: 1, peers: false };
        let in_space = FAMILIES3.par_iter().zip(&shares).map(|(family, cases)| tally(family, &scope(cases)));
        let in_plane = FAMILIES2.par_iter().zip(&shares[FAMILIES3.len()..]);
        let in_plane = in_plane.map(|(family, cases)| tally(family, &scope(cases)));
        let tallies: Vec<Tally> = in_space.chain(in_plane).collect();
        eprintln!("{}", header(TRUTH_EVERY));
        for tally in &tallies {
            eprintln!("{}", Row::new(tally, &Times::default()).to_line());
        }
        tallies
    })
}

/// Fails with the list of families that broke a promise.
fn assert_kept(kind: FaultKind) {
    let complaints: Vec<String> = tallies().iter().filter_map(|tally| tally.complaint(kind)).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn a_hundred_thousand_cases_of_all_families_are_judged() {
    let tallies = tallies();
    let sum = |count: fn(&Tally) -> usize| tallies.iter().map(count).sum::<usize>();
    assert!(sum(|tally| tally.cases) >= CASES);
    // The largest hulls are few, and yet occur on every level.
    let levels =
        FAMILIES3.iter().map(|family| family.levels).chain(FAMILIES2.iter().map(|family| family.levels));
    for (tally, levels) in tallies.iter().zip(levels) {
        assert!(tally.cases >= 4 * levels as usize && tally.measured >= levels as usize, "{tally:?}");
    }
    // Both answers, and cases that only touch, must be frequent, or zeros would mean little.
    let overlapping = sum(|tally| tally.overlapping);
    assert!(overlapping > CASES / 5 && overlapping < 4 * CASES / 5, "{overlapping} overlap");
    assert!(sum(|tally| tally.touching) > CASES / 50);
}

#[test]
fn overlaps_is_never_wrong() {
    assert_kept(FaultKind::Wrong);
}

#[test]
fn nothing_panics_and_everything_is_a_number() {
    assert_kept(FaultKind::Panicked);
    assert_kept(FaultKind::NotANumber);
}

#[test]
fn no_error_bound_is_broken() {
    assert_kept(FaultKind::Broken);
}

#[test]
fn the_separation_has_the_sign_that_overlaps_gives() {
    assert_kept(FaultKind::Sign);
}

#[test]
fn there_is_a_distance_exactly_without_an_overlap() {
    assert_kept(FaultKind::Distance);
}

#[test]
fn separations_and_distances_are_within_a_millionth_of_size() {
    assert_kept(FaultKind::Inaccurate);
}

#[test]
fn normals_show_the_separation_to_a_millionth_of_size() {
    assert_kept(FaultKind::Regret);
}

#[test]
fn solids_have_contact_points_exactly_when_they_overlap() {
    assert_kept(FaultKind::Manifold);
}
