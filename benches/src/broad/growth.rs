//! How the cost of a frame grows for boxes laid out to make a broad phase slow ([`asunder_scenes::hurt`]).
//!
//! There is no peer. A row compares our sorted list of pairs, from scratch, with a budget: the cost of an ordinary
//! scene.

use super::size_name;
use crate::clock::{Effort, Samples, time};
use asunder_broad::{PairId, Sweep};
use asunder_geometry::Aabb3;
use asunder_scenes::hurt::HurtScene;
use serde::Serialize;

/// The budget per box, in nanoseconds.
pub const BUDGET_A_BOX: f64 = 80.0;

/// The budget per pair, in nanoseconds.
pub const BUDGET_A_PAIR: f64 = 20.0;

/// Sizes of every scene; the last one on request only.
const SIZES: [usize; 4] = [30_000, 100_000, 300_000, 1_000_000];

/// One row.
#[derive(Clone, Debug, Serialize)]
pub struct GrowthRow {
    /// Scene and size, as `hurt/needles/100k`.
    pub row: String,
    /// Boxes.
    pub boxes: usize,
    /// Pairs a box.
    pub pairs_per_box: f64,
    /// Median nanoseconds a box.
    pub ns_per_box: f64,
    /// `ns_per_box` divided by the budget: [`BUDGET_A_BOX`], plus [`BUDGET_A_PAIR`] for every pair per box.
    pub budgets: f64,
    /// Memory held by the sweep, in bytes per box.
    pub bytes_per_box: f64,
    /// How many frames were measured.
    pub done: usize,
}

/// The cases: every scene at every size.
///
/// ```
/// use asunder_benches::broad::growth;
/// assert_eq!(growth::name(&growth::cases(false)[1]), "hurt/needles/100k");
/// assert!(growth::cases(true).len() > growth::cases(false).len());
/// ```
pub fn cases(with_million: bool) -> Vec<(HurtScene, usize)> {
    let sizes = &SIZES[..if with_million { 4 } else { 3 }];
    HurtScene::ALL.into_iter().flat_map(|scene| sizes.iter().map(move |&count| (scene, count))).collect()
}

/// The name of a case.
pub fn name(&(scene, count): &(HurtScene, usize)) -> String {
    format!("hurt/{}/{}", scene.name(), size_name(count))
}

/// Measures one case on this thread. Cost: a second, or three frames.
///
/// Must run where the library finds no second thread, as in a pool of one: thread time would miss the other.
///
/// ```
/// use asunder_benches::{broad::growth, clock::Effort};
/// use asunder_scenes::hurt::HurtScene;
/// let row = growth::measure(&(HurtScene::Needles, 2000), &Effort { rounds: 3, ..Effort::quick() });
/// assert!(row.budgets > 0.0 && row.done == 3, "{row:?}");
/// ```
pub fn measure(case: &(HurtScene, usize), effort: &Effort) -> GrowthRow {
    let &(scene, count) = case;
    let boxes: Vec<Aabb3> = scene.boxes(count, 1);
    let (mut sweep, mut pairs, mut samples) = (Sweep::new(), Vec::<PairId>::new(), Samples::default());
    for round in 0..=effort.rounds {
        // Without a limit on pairs it cannot fail.
        let (ns, _) = time(|| sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut pairs));
        // The first one allocates.
        if round > 0 {
            samples.push(ns, ns);
        }
        if samples.len() >= 3 && samples.spent() > effort.nanoseconds() {
            break;
        }
    }
    let pairs_per_box = pairs.len() as f64 / count.max(1) as f64;
    let ns_per_box = samples.median().unwrap_or(f64::NAN) / count.max(1) as f64;
    GrowthRow {
        row: name(case),
        boxes: count,
        pairs_per_box,
        ns_per_box,
        budgets: ns_per_box / (BUDGET_A_BOX + BUDGET_A_PAIR * pairs_per_box),
        bytes_per_box: sweep.bytes() as f64 / count.max(1) as f64,
        done: samples.len(),
    }
}

impl GrowthRow {
    /// The heading of a table.
    pub fn heading() -> String {
        let heads = ["ns/box", "pairs/box", "budgets", "B/box"].map(|head| format!("{head:>10}"));
        format!(
            "{:<28}{}   a budget is {BUDGET_A_BOX} ns a box and {BUDGET_A_PAIR} a pair",
            "row",
            heads.concat()
        )
    }

    /// A line of the table.
    pub fn to_text(&self) -> String {
        let Self { row, ns_per_box, pairs_per_box, budgets, bytes_per_box, .. } = self;
        format!("{row:<28}{ns_per_box:>10.0}{pairs_per_box:>10.2}{budgets:>10.2}{bytes_per_box:>10.0}")
    }

    /// A line of JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).unwrap_or_else(|error| format!("{{\"row\":\"{}: {error}\"}}", self.row))
    }
}
