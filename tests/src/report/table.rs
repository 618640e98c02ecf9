//! The report's rows: JSON for programs, a table for people.

use super::judged::FaultKind;
use super::tally::{PeerTally, Tally};
use super::times::Times;
use serde::Serialize;

/// One family's figures; `None` where nothing was measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    /// `hard/NAME` in space, `hard2/NAME` in the plane.
    pub family: String,
    /// Cases, each judged by exact arithmetic.
    pub cases: usize,
    /// Cases whose separation was judged as well.
    pub measured: usize,
    /// Cases in which the shapes share a point.
    pub overlapping: usize,
    /// Cases in which they share a point, but no interior point.
    pub touching: usize,
    /// Wrong answers of `overlaps`.
    pub wrong: usize,
    /// Wrong answers of the first tier alone.
    pub wrong_guess: usize,
    /// Our panics, NaN, and invalid normals.
    pub no_number: usize,
    /// Reported errors that were exceeded.
    pub broken_bounds: usize,
    /// Signs, distances and manifolds that disagree with `overlaps`.
    pub at_odds: usize,
    /// The largest |separation - truth| over size.
    pub error: Option<f64>,
    /// The largest |separation - truth| over the reported error.
    pub error_over_bound: Option<f64>,
    /// The largest loss of separation along the reported normal, over size.
    pub regret: Option<f64>,
    /// Shares settled by the error bound, in f64, exactly.
    pub tiers: [f64; 3],
    /// Median nanoseconds of the first tier alone.
    pub guess_ns: Option<f64>,
    /// Median nanoseconds of `overlaps`.
    pub overlaps_ns: Option<f64>,
    /// parry3d in f32.
    pub parry_f32: Peer,
    /// parry3d in f64.
    pub parry_f64: Peer,
}

/// A peer's figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Peer {
    /// Cases that it has shapes and a query for.
    pub answered: usize,
    /// Wrong answers where shapes are apart or truly overlap; touching ones do not count.
    pub wrong: usize,
    /// Panics and NaN.
    pub no_number: usize,
    /// The largest |separation - truth| over size.
    pub error: Option<f64>,
    /// Median nanoseconds of `intersection_test`.
    pub ns: Option<f64>,
}

impl Peer {
    fn new(tally: &PeerTally, ns: Option<f64>) -> Self {
        let no_number = tally.not_a_number + tally.panics;
        Self { answered: tally.answered, wrong: tally.wrong, no_number, error: tally.error, ns }
    }
}

impl Row {
    /// The figures of a family.
    ///
    /// ```
    /// use asunder_tests::report::{Row, Tally, Times};
    /// let row = Row::new(&Tally { family: "hard/none".into(), cases: 4, tiers: [3, 1, 0], ..Tally::default() }, &Times::default());
    /// assert_eq!(row.tiers, [0.75, 0.25, 0.0]);
    /// assert!(row.to_line().starts_with("| hard/none | 4 |"));
    /// ```
    pub fn new(tally: &Tally, times: &Times) -> Self {
        use FaultKind::{Broken, Distance, Manifold, NotANumber, Panicked, Sign, Wrong};
        let count = |kinds: &[FaultKind]| kinds.iter().map(|&kind| tally.count(kind)).sum::<usize>();
        Self {
            family: tally.family.clone(),
            cases: tally.cases,
            measured: tally.measured,
            overlapping: tally.overlapping,
            touching: tally.touching,
            wrong: count(&[Wrong]),
            wrong_guess: tally.wrong_guesses,
            no_number: count(&[Panicked, NotANumber]),
            broken_bounds: count(&[Broken]),
            at_odds: count(&[Sign, Distance, Manifold]),
            error: tally.error,
            error_over_bound: tally.tightness,
            regret: tally.regret,
            tiers: tally.tiers.map(|count| count as f64 / tally.cases.max(1) as f64),
            guess_ns: times.guess,
            overlaps_ns: times.overlaps,
            parry_f32: Peer::new(&tally.peers[0], times.peers[0]),
            parry_f64: Peer::new(&tally.peers[1], times.peers[1]),
        }
    }

    /// One line of the table under [`header`].
    pub fn to_line(&self) -> String {
        let peers = [&self.parry_f32, &self.parry_f64];
        let of_peer = |count: fn(&Peer) -> usize| {
            peers.map(|peer| match (peer.answered, peer.no_number) {
                (0, 0) => "-".to_string(),
                _ => count(peer).to_string(),
            })
        };
        let [wrong_f32, wrong_f64] = of_peer(|peer| peer.wrong);
        let [no_number_f32, no_number_f64] = of_peer(|peer| peer.no_number);
        let tiers = self.tiers.map(|share| format!("{:.1}", 100.0 * share)).join(" / ");
        let cells = [
            self.family.clone(),
            self.cases.to_string(),
            self.touching.to_string(),
            self.wrong.to_string(),
            self.wrong_guess.to_string(),
            wrong_f32,
            wrong_f64,
            self.no_number.to_string(),
            no_number_f32,
            no_number_f64,
            small(self.error),
            small(self.parry_f32.error),
            small(self.parry_f64.error),
            self.broken_bounds.to_string(),
            small(self.error_over_bound),
            small(self.regret),
            self.at_odds.to_string(),
            tiers,
            whole(self.guess_ns),
            whole(self.overlaps_ns),
            whole(self.parry_f32.ns),
            whole(self.parry_f64.ns),
        ];
        format!("| {} |", cells.join(" | "))
    }
}

/// The first two lines of the table; `truth_every` says on which cases separations were judged.
///
/// ```
/// assert_eq!(asunder_tests::report::header(8).lines().count(), 2);
/// ```
pub fn header(truth_every: usize) -> String {
    let errors = format!("error / size, every {truth_every}.");
    let names = [
        "family",
        "cases",
        "touching",
        "wrong `overlaps`",
        "wrong `guess`",
        "wrong parry f32",
        "wrong parry f64",
        "NaN, panics",
        "parry f32",
        "parry f64",
        &errors,
        "parry f32",
        "parry f64",
        "bounds broken",
        "error / bound",
        "normal's regret",
        "at odds",
        "% bound / f64 / exact",
        "`guess` ns",
        "`overlaps` ns",
        "parry f32 ns",
        "parry f64 ns",
    ];
    let rule = names.map(|name| if name == "family" { ":--" } else { "--:" });
    format!("| {} |\n| {} |", names.join(" | "), rule.join(" | "))
}

/// The whole report in Markdown: a summary, how it was made, what its columns mean, the rows and their sum.
///
/// ```
/// use asunder_tests::report::{Row, markdown};
/// let page = markdown(&[Row::default()], 8, &["Made by a test.".to_string()]);
/// assert!(page.contains("Made by a test.") && page.contains("asunder 0, parry3d 0 of 0") && page.contains("| **all** |"));
/// ```
pub fn markdown(rows: &[Row], truth_every: usize, made: &[String]) -> String {
    let all = sum(rows);
    let mut page = format!("# Hard cases\n\n{}", summary(&all));
    for line in made {
        page.push_str(&format!("- {line}\n"));
    }
    page.push('\n');
    page.push_str(MEANING);
    page.push_str(&header(truth_every));
    page.push('\n');
    for row in rows.iter().chain([&all]) {
        page.push_str(&row.to_line());
        page.push('\n');
    }
    page
}

const MEANING: &str = "\
## The columns

- A family is `hard/NAME` in space, `hard2/NAME` in the plane. Yes or no is judged on every case by exact arithmetic; for parry3d
  only where shapes are strictly apart or strictly overlap.
- `overlaps` is the certain answer, `guess` its first tier of precision alone.
- Errors are the largest |separation - truth|, over the sum of the bounding radii or, in a gap wider than that, over the gap.
- Error / bound is the same over the error that we report: a bound is broken above 1.
- Normal's regret is what the separation along our normal lacks of the best.
- At odds: a sign, a distance or a manifold that does not go with `overlaps`.
- % bound / f64 / exact: which tier settled our yes or no (`docs/accuracy.md`).
- Times are medians of thread CPU time for a yes or no, in turns. A dash: not asked, or no such shape.

";

/// A summary of all rows, in one paragraph.
fn summary(all: &Row) -> String {
    let Row { cases, wrong, broken_bounds, at_odds, parry_f32, parry_f64, .. } = all;
    let asked = |peer: &Peer| format!("{} of {}", peer.wrong, peer.answered);
    format!(
        "Of {cases} cases, wrong answers to \"do they touch?\": asunder {wrong}, parry3d {}, parry3d in f64 {}. Error bounds of asunder \
         that were broken: {broken_bounds}; numbers, distances and manifolds at odds with its yes or no: {at_odds}.\n\n",
        asked(parry_f32),
        asked(parry_f64),
    )
}

/// All rows added up, without times; shares are of all cases.
fn sum(rows: &[Row]) -> Row {
    let total = |count: fn(&Row) -> usize| rows.iter().map(count).sum::<usize>();
    let worst = |figure: fn(&Row) -> Option<f64>| rows.iter().filter_map(figure).max_by(f64::total_cmp);
    let peer = |which: fn(&Row) -> &Peer| Peer {
        answered: rows.iter().map(|row| which(row).answered).sum(),
        wrong: rows.iter().map(|row| which(row).wrong).sum(),
        no_number: rows.iter().map(|row| which(row).no_number).sum(),
        error: rows.iter().filter_map(|row| which(row).error).max_by(f64::total_cmp),
        ns: None,
    };
    let cases = total(|row| row.cases);
    let share = |tier: usize| {
        let settled = rows.iter().map(|row| row.tiers[tier] * row.cases as f64).sum::<f64>();
        settled / cases.max(1) as f64
    };
    Row {
        family: "**all**".to_string(),
        cases,
        measured: total(|row| row.measured),
        overlapping: total(|row| row.overlapping),
        touching: total(|row| row.touching),
        wrong: total(|row| row.wrong),
        wrong_guess: total(|row| row.wrong_guess),
        no_number: total(|row| row.no_number),
        broken_bounds: total(|row| row.broken_bounds),
        at_odds: total(|row| row.at_odds),
        error: worst(|row| row.error),
        error_over_bound: worst(|row| row.error_over_bound),
        regret: worst(|row| row.regret),
        tiers: [share(0), share(1), share(2)],
        guess_ns: None,
        overlaps_ns: None,
        parry_f32: peer(|row| &row.parry_f32),
        parry_f64: peer(|row| &row.parry_f64),
    }
}

fn small(figure: Option<f64>) -> String {
    figure.map_or(
        "-".to_string(),
        |figure| if figure == 0.0 { "0".to_string() } else { format!("{figure:.1e}") },
    )
}

fn whole(figure: Option<f64>) -> String {
    figure.map_or("-".to_string(), |figure| format!("{figure:.0}"))
}
