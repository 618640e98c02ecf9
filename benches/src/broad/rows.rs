//! The same measurements as plain rows, one per variant, for the report.

use super::memory::{bandwidth, least_traffic};
use super::{Case, run, threads};
use crate::clock::{Effort, Samples, Spread};
use crate::row::Row;
use rayon::ThreadPoolBuildError;
use serde::{Deserialize, Serialize};

/// One way to find a frame's pairs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BroadRow {
    /// The scene's name.
    pub scene: String,
    /// How many boxes it has.
    pub boxes: u64,
    /// `asunder`, `parry3d`, or `memory`, which only reads boxes and writes pairs.
    pub method: String,
    /// The variant of the method.
    pub variant: String,
    /// How many threads worked.
    pub threads: u64,
    /// `thread`: CPU time of the one thread; `wall`: wall-clock time.
    pub clock: String,
    /// How many frames were measured.
    pub frames: u64,
    /// How many pairs the last frame has.
    pub pairs: u64,
    /// Median time of a frame, in nanoseconds.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
    /// The most memory held at the end of a frame, in bytes per box, the list of pairs included; 0 if not counted.
    pub bytes_per_box: f64,
    /// How many pairs of boxes a frame compared to find its pairs; 0 if not counted.
    #[serde(default)]
    pub compared: u64,
    /// Whether the way took too long and was aborted in its first frame: its lower quartile is then the time until that
    /// point, and its median and upper quartile are extrapolated.
    #[serde(default)]
    pub is_cut: bool,
    /// Notes that variants found different pairs, or that one was aborted.
    pub note: String,
}

impl BroadRow {
    fn new(case: &Case, way: (&str, &str), samples: &Samples) -> Option<Self> {
        Some(Self { frames: samples.len() as u64, ..Self::of(case, way, samples.spread()?) })
    }

    fn of(&(scene, count): &Case, (method, variant): (&str, &str), time: Spread) -> Self {
        let Spread { low: ns_low, median: ns, high: ns_high } = time;
        Self {
            scene: scene.name().to_string(),
            boxes: count as u64,
            method: method.to_string(),
            variant: variant.to_string(),
            threads: 1,
            clock: "thread".to_string(),
            ns,
            ns_low,
            ns_high,
            ..Self::default()
        }
    }
}

/// Measures one case on one thread, as [`super::measure`] does: our variants, the peer's, and what memory would take.
///
/// ```
/// use asunder_benches::{broad::rows, clock::Effort};
/// use asunder_scenes::boxes::BoxScene;
/// let rows = rows::one_thread(&(BoxScene::City, 500), &Effort { rounds: 3, ..Effort::quick() });
/// let methods: Vec<&str> = rows.iter().map(|row| row.method.as_str()).collect();
/// assert!(methods.contains(&"asunder") && methods.contains(&"parry3d") && methods.contains(&"memory"));
/// assert!(rows.iter().all(|row| row.pairs == rows[0].pairs && row.note.is_empty()), "{rows:?}");
/// ```
pub fn one_thread(case: &Case, effort: &Effort) -> Vec<BroadRow> {
    let (said, ours, peers) = run(case, effort);
    let mut rows = Vec::new();
    for variant in ours.variants() {
        let row = BroadRow::new(case, ("asunder", variant.engine.name()), &variant.samples);
        let bytes_per_box = variant.peak as f64 / case.1.max(1) as f64;
        let compared = variant.engine.compared().unwrap_or(0) as u64;
        rows.extend(row.map(|row| BroadRow { bytes_per_box, compared, ..row }));
    }
    let cut = ours.cut();
    rows.extend(
        cut.map(|cut| BroadRow { is_cut: true, ..BroadRow::of(case, ("asunder", "sweep"), cut.time) }),
    );
    for peer in &peers {
        rows.extend(BroadRow::new(case, ("parry3d", peer.name()), &peer.samples));
    }
    let found = ours.variants().first().map(|variant| variant.pairs.len());
    let pairs = found.or(cut.map(|cut| cut.pairs)).unwrap_or(0);
    let mut bound = Samples::default();
    bound.push(least_traffic(case.1, pairs) / bandwidth(), 0.0);
    rows.extend(BroadRow::new(case, ("memory", "reads boxes, writes pairs"), &bound));
    for row in &mut rows {
        row.pairs = pairs as u64;
        row.note.clone_from(&said.note);
    }
    rows
}

/// Measures our best mode on one thread and on several, in wall-clock time, as [`threads::measure`] does.
///
/// # Errors
/// The system cannot start the threads.
///
/// ```
/// use asunder_benches::{broad::rows, clock::Effort};
/// use asunder_scenes::boxes::BoxScene;
/// let rows = rows::several_threads(&(BoxScene::City, 500), 2, &Effort { rounds: 1, ..Effort::quick() })?;
/// assert_eq!(rows.iter().map(|row| row.threads).collect::<Vec<_>>(), [1, 2]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn several_threads(
    case: &Case,
    count: usize,
    effort: &Effort,
) -> Result<Vec<BroadRow>, ThreadPoolBuildError> {
    let mut said = Row::default();
    let sides = threads::run(case, count, effort, &mut said)?;
    let rows = sides.iter().zip([1, count as u64]).filter_map(|(side, threads)| {
        let (_, best) = side.best()?;
        let row = BroadRow::new(case, ("asunder", best.engine.name()), &best.samples)?;
        let (clock, pairs, note) = ("wall".to_string(), best.pairs.len() as u64, said.note.clone());
        Some(BroadRow { threads, clock, pairs, note, ..row })
    });
    Ok(rows.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_scenes::boxes::BoxScene;

    #[test]
    fn a_sweep_that_is_broken_off_leaves_a_row_that_says_so() {
        let effort = Effort { rounds: 1, seconds: 1e-9, ..Effort::quick() };
        let rows = one_thread(&(BoxScene::Pile, 5000), &effort);
        let ours: Vec<&BroadRow> = rows.iter().filter(|row| row.method == "asunder").collect();
        assert!(ours.len() == 1 && ours[0].is_cut && ours[0].frames == 0, "{ours:?}");
        assert!(0.0 < ours[0].ns_low && ours[0].ns_low < ours[0].ns, "{ours:?}");
        assert!(ours[0].note.contains("extrapolated"), "{ours:?}");
        assert!(rows.iter().all(|row| row.pairs > 5000), "the peer told how many there are: {rows:?}");
    }

    #[test]
    fn a_sweep_compares_more_than_it_hands_over() {
        let effort = Effort { rounds: 1, ..Effort::quick() };
        for scene in BoxScene::ALL {
            let rows = one_thread(&(scene, 3000), &effort);
            let ours = rows.iter().find(|row| row.variant == "sweep").unwrap();
            // Clusters are swept in columns of their own, which are not counted.
            let is_told = scene != BoxScene::Islands;
            assert!(ours.compared >= ours.pairs || !is_told, "{ours:?}");
            assert!(ours.pairs > 0 && !ours.is_cut, "{ours:?}");
            assert!(rows.iter().all(|row| row.variant == "sweep" || row.compared == 0), "{rows:?}");
        }
    }
}
