//! One line of results, as text or as JSON.

use crate::accuracy::Accuracy;
use crate::broad::figures::Figures;
use crate::clock::Samples;
use crate::world;
use serde::Serialize;

/// The result of one case.
///
/// ```
/// use asunder_benches::row::Row;
/// let mut row = Row::new("gas/1k", "frame", 1000);
/// (row.ours_ns, row.peer, row.peer_ns) = (Some(50.0), Some("parry3d Bvh, incremental"), Some(200.0));
/// row.finish();
/// assert_eq!(row.ratio, Some(4.0));
/// assert!(row.to_json().starts_with(r#"{"row":"gas/1k""#));
/// assert!(row.to_text().contains("4.00"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    /// The case: scene and size, or shape, set and operation.
    pub row: String,
    /// Our time, in nanoseconds per [`Row::per`].
    pub ours_ns: Option<f64>,
    /// The peer; `None` where there is none.
    pub peer: Option<&'static str>,
    /// The peer's time, in nanoseconds per [`Row::per`].
    pub peer_ns: Option<f64>,
    /// Quartiles of our time, where it is a median of several rounds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ours_quartiles: Option<[f64; 2]>,
    /// Quartiles of the peer's time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peer_quartiles: Option<[f64; 2]>,
    /// The peer's time divided by ours: above 1 we are faster.
    pub ratio: Option<f64>,
    /// What the times are for: a `frame` or a `pair`.
    pub per: &'static str,
    /// Boxes, pairs or bodies in the case.
    pub n: usize,
    /// Frames or pairs that were measured before the time was up.
    pub done: usize,
    /// Narrow phase: our slowest single pair, in nanoseconds, in rows of growing shapes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_ns: Option<f64>,
    /// The peer's slowest single pair, in nanoseconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peer_worst_ns: Option<f64>,
    /// Narrow phase: both sides' answers compared with the truth.
    #[serde(flatten)]
    pub accuracy: Option<Accuracy>,
    /// Broad phase: its stages, and its cost per box, per pair, and relative to memory speed.
    #[serde(flatten)]
    pub broad: Option<Figures>,
    /// Whole frames: times of their stages.
    #[serde(flatten)]
    pub world: Option<world::Figures>,
    /// Remarks for the reader: how far a row came, what was found.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl Row {
    /// A row without figures yet.
    pub fn new(row: impl Into<String>, per: &'static str, n: usize) -> Self {
        Self { row: row.into(), per, n, ..Self::default() }
    }

    /// Sets our time and its quartiles.
    pub fn tell(&mut self, ours: &Samples) {
        (self.ours_ns, self.ours_quartiles) = (ours.median(), quartiles(ours));
    }

    /// Sets the peer's name, its time and its quartiles.
    pub fn tell_peer(&mut self, name: &'static str, peer: &Samples) {
        (self.peer, self.peer_ns, self.peer_quartiles) = (Some(name), peer.median(), quartiles(peer));
    }

    /// Computes what follows from the figures.
    pub fn finish(&mut self) {
        self.ratio = match (self.ours_ns, self.peer_ns) {
            (Some(ours), Some(peer)) if ours > 0.0 => Some(peer / ours),
            _ => None,
        };
    }

    /// Appends a remark to the note.
    pub fn remark(&mut self, text: &str) {
        if !self.note.is_empty() {
            self.note.push_str("; ");
        }
        self.note.push_str(text);
    }

    /// One line of JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).unwrap_or_else(|error| format!("{{\"row\":\"{}: {error}\"}}", self.row))
    }

    /// One line of a table, under [`heading`].
    pub fn to_text(&self) -> String {
        let ratio = self.ratio.map_or(String::new(), |ratio| format!("{ratio:.2}"));
        let mut note = self.note.clone();
        if let (Some(worst), Some(peer)) = (self.worst_ns, self.peer_worst_ns) {
            note = format!("slowest {}, peer's {}; {note}", duration(Some(worst)), duration(Some(peer)));
        }
        if let Some(accuracy) = &self.accuracy {
            note = format!("{}  {note}", accuracy.to_text());
        }
        if let Some(figures) = &self.broad {
            note = format!("{}  {note}", figures.to_text());
        }
        if let Some(figures) = &self.world {
            note = format!("{}  {note}", figures.to_text());
        }
        let line = format!(
            "{:<28} {:>10} {:>10} {:>8}  {:>7} {:<26} {note}",
            self.row,
            duration(self.ours_ns),
            duration(self.peer_ns),
            ratio,
            self.done,
            self.peer.unwrap_or("-"),
        );
        line.trim_end().trim_end_matches(';').to_string()
    }
}

/// The quartiles, if there is more than one sample.
fn quartiles(samples: &Samples) -> Option<[f64; 2]> {
    samples.spread().filter(|_| samples.len() > 1).map(|spread| [spread.low, spread.high])
}

/// The heading of a table.
///
/// ```
/// assert!(asunder_benches::row::heading().contains("ratio"));
/// ```
pub fn heading() -> String {
    format!(
        "{:<28} {:>10} {:>10} {:>8}  {:>7} {:<26} note",
        "row", "ours", "peer", "ratio", "done", "peer is"
    )
}

/// The heading of a table whose rows are judged.
///
/// ```
/// assert!(asunder_benches::row::heading_with_accuracy().contains("miss"));
/// ```
pub fn heading_with_accuracy() -> String {
    let plain = heading();
    format!("{}{}  note", plain.trim_end_matches("note"), Accuracy::heading())
}

/// The heading of a table of the broad phase.
///
/// ```
/// assert!(asunder_benches::row::heading_with_figures().contains("ns/pair"));
/// ```
pub fn heading_with_figures() -> String {
    let plain = heading();
    format!("{}{}  note", plain.trim_end_matches("note"), Figures::heading())
}

/// A time in at most ten characters, or a dash.
pub(crate) fn duration(ns: Option<f64>) -> String {
    match ns {
        None => "-".to_string(),
        Some(ns) if ns < 1e4 => format!("{ns:.0} ns"),
        Some(ns) if ns < 1e7 => format!("{:.1} us", ns * 1e-3),
        Some(ns) => format!("{:.1} ms", ns * 1e-6),
    }
}
