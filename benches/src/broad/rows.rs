//! The same measurements as plain rows, a variant a row, for the report.

use super::memory::{bandwidth, least_traffic};
use super::{Case, run, threads};
use crate::clock::{Effort, Samples, Spread};
use crate::row::Row;
use rayon::ThreadPoolBuildError;
use serde::{Deserialize, Serialize};

/// One way to a frame's pairs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BroadRow {
    /// The scene's name.
    pub scene: String,
    /// How many boxes it has.
    pub boxes: u64,
    /// `asunder`, `parry3d`, or `memory`, which only reads boxes and writes pairs.
    pub method: String,
    /// Which of the method's ways.
    pub variant: String,
    /// Threads that worked.
    pub threads: u64,
    /// `thread`: CPU time of the one thread; `wall`: by the clock on the wall.
    pub clock: String,
    /// Frames that were measured.
    pub frames: u64,
    /// Pairs of the last frame.
    pub pairs: u64,
    /// Median time of a frame, in nanoseconds.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
    /// Most memory held at the end of a frame, in bytes a box, the list of pairs included; 0 where nobody counted.
    pub bytes_per_box: f64,
    /// Whether variants found different pairs, or one was broken off.
    pub note: String,
}

impl BroadRow {
    fn new(&(scene, count): &Case, (method, variant): (&str, &str), samples: &Samples) -> Option<Self> {
        let Spread { low: ns_low, median: ns, high: ns_high } = samples.spread()?;
        Some(Self {
            scene: scene.name().to_string(),
            boxes: count as u64,
            method: method.to_string(),
            variant: variant.to_string(),
            threads: 1,
            clock: "thread".to_string(),
            frames: samples.len() as u64,
            ns,
            ns_low,
            ns_high,
            ..Self::default()
        })
    }
}

/// Measures one case on one thread, as [`super::measure`] does: ours, the peer's, and what memory would take.
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
        rows.extend(row.map(|row| BroadRow { bytes_per_box, ..row }));
    }
    for peer in &peers {
        rows.extend(BroadRow::new(case, ("parry3d", peer.name()), &peer.samples));
    }
    let pairs = ours.variants().first().map_or(0, |variant| variant.pairs.len());
    let mut bound = Samples::default();
    bound.push(least_traffic(case.1, pairs) / bandwidth(), 0.0);
    rows.extend(BroadRow::new(case, ("memory", "reads boxes, writes pairs"), &bound));
    for row in &mut rows {
        row.pairs = pairs as u64;
        row.note.clone_from(&said.note);
    }
    rows
}

/// Measures our best mode on one thread and on several, by the clock on the wall, as [`threads::measure`] does.
///
/// # Errors
/// The system gives no threads.
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
