//! Saved rows of `compare`, and their text in tables.

use super::names::{count, error};
use super::origin::{commit, today};
use crate::clock::Spread;
use crate::row::Row;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// One row of `compare`, as plain columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptRow {
    /// Which part of `compare`: `narrow`, `shapes`, `broad`, `mesh` ...
    pub part: String,
    /// The case.
    pub row: String,
    /// What the times are for.
    pub per: String,
    /// Our time, in nanoseconds.
    pub ours_ns: Option<f64>,
    /// The peer's time, in nanoseconds.
    pub peer_ns: Option<f64>,
    /// Lower quartile of our time, where there were several rounds.
    #[serde(default)]
    pub ours_low_ns: Option<f64>,
    /// Upper quartile of our time.
    #[serde(default)]
    pub ours_high_ns: Option<f64>,
    /// Lower quartile of the peer's time.
    #[serde(default)]
    pub peer_low_ns: Option<f64>,
    /// Upper quartile of the peer's time.
    #[serde(default)]
    pub peer_high_ns: Option<f64>,
    /// How many answers were compared with the truth.
    pub judged: Option<u64>,
    /// Our largest error, as a share of size.
    pub max_error: Option<f64>,
    /// How many of our answers are off.
    pub off: Option<u64>,
    /// How many contacts we miss.
    pub missed: Option<u64>,
    /// The peer's largest error.
    pub peer_max_error: Option<f64>,
    /// How many of the peer's answers are off.
    pub peer_off: Option<u64>,
    /// How many contacts the peer misses.
    pub peer_missed: Option<u64>,
    /// Remarks for the reader.
    pub note: String,
    /// The commit at which it was measured.
    pub commit: String,
    /// The date.
    pub date: String,
}

/// Queried only once, since another program has to be run.
static COMMIT: OnceLock<String> = OnceLock::new();

impl KeptRow {
    /// A row that has just been measured.
    ///
    /// ```
    /// use asunder_benches::{report::KeptRow, row::Row};
    /// let mut row = Row::new("box/mixed/boolean", "pair", 100);
    /// row.ours_ns = Some(60.0);
    /// let kept = KeptRow::new("narrow", &row);
    /// assert_eq!((kept.part.as_str(), kept.row.as_str(), kept.ours_ns), ("narrow", "box/mixed/boolean", Some(60.0)));
    /// ```
    pub fn new(part: &str, row: &Row) -> Self {
        let accuracy = row.accuracy.as_ref();
        let number = |number: usize| number as u64;
        Self {
            part: part.to_string(),
            row: row.row.clone(),
            per: row.per.to_string(),
            ours_ns: row.ours_ns,
            peer_ns: row.peer_ns,
            ours_low_ns: row.ours_quartiles.map(|[low, _]| low),
            ours_high_ns: row.ours_quartiles.map(|[_, high]| high),
            peer_low_ns: row.peer_quartiles.map(|[low, _]| low),
            peer_high_ns: row.peer_quartiles.map(|[_, high]| high),
            judged: accuracy.map(|found| number(found.judged)),
            max_error: accuracy.map(|found| found.max_error),
            off: accuracy.map(|found| number(found.off)),
            missed: accuracy.map(|found| number(found.missed)),
            peer_max_error: accuracy.and_then(|found| found.peer_max_error),
            peer_off: accuracy.and_then(|found| found.peer_off).map(number),
            peer_missed: accuracy.and_then(|found| found.peer_missed).map(number),
            note: row.note.clone(),
            commit: COMMIT.get_or_init(commit).clone(),
            date: today(),
        }
    }

    /// Our time, with its quartiles where they are known.
    pub(super) fn ours(&self) -> Option<Spread> {
        self.ours_ns.map(|ns| spread(ns, self.ours_low_ns, self.ours_high_ns))
    }

    /// The peer's time, likewise.
    pub(super) fn peer(&self) -> Option<Spread> {
        self.peer_ns.map(|ns| spread(ns, self.peer_low_ns, self.peer_high_ns))
    }

    /// The accuracy of both sides' answers, or the row's own note.
    pub(super) fn found(&self) -> String {
        let Some(max_error) = self.max_error else { return self.note.clone() };
        if self.row.ends_with("/boolean") && max_error == 0.0 {
            return match self.peer_off {
                None => "exact".to_string(),
                Some(0) => "exact; no disagreement".to_string(),
                Some(off) => format!("exact; parry3d wrong by more than 1e-5 in {}", count(off)),
            };
        }
        let peer = self.peer_max_error.map_or(String::new(), |peer| format!(" against {}", error(peer)));
        let off = match (self.peer_off, self.judged) {
            (Some(off @ 1..), Some(judged)) => {
                format!("; parry3d {} of {} off by more than 1e-5", count(off), count(judged))
            }
            _ => String::new(),
        };
        format!("{}{peer}{off}", error(max_error))
    }
}

/// Replaces rows of the same part and name, and appends the others.
///
/// ```
/// use asunder_benches::report::{KeptRow, kept::put};
/// let row = |row: &str, ns| KeptRow { row: row.into(), ours_ns: Some(ns), ..KeptRow::default() };
/// let mut rows = vec![row("a", 1.0), row("b", 2.0)];
/// put(&mut rows, vec![row("a", 3.0), row("c", 4.0)]);
/// assert_eq!(rows, [row("a", 3.0), row("b", 2.0), row("c", 4.0)]);
/// ```
pub fn put(rows: &mut Vec<KeptRow>, new: Vec<KeptRow>) {
    for row in new {
        match rows.iter_mut().find(|known| (&known.part, &known.row) == (&row.part, &row.row)) {
            Some(known) => *known = row,
            None => rows.push(row),
        }
    }
}

fn spread(ns: f64, low: Option<f64>, high: Option<f64>) -> Spread {
    Spread::new(ns, low.unwrap_or(ns), high.unwrap_or(ns))
}

/// The accuracy over all rows of the narrow phase, and the origin of the rows; empty if there are none.
pub(super) fn together(rows: &[KeptRow]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let judged: Vec<&KeptRow> = rows.iter().filter(|row| row.judged.is_some()).collect();
    let sum = |of: fn(&KeptRow) -> Option<u64>| count(judged.iter().filter_map(|row| of(row)).sum());
    let largest = judged.iter().filter_map(|row| row.max_error).fold(0.0, f64::max);
    let mut origins: Vec<String> = rows.iter().map(|row| format!("{} at {}", row.date, row.commit)).collect();
    origins.sort();
    origins.dedup();
    format!(
        "\n\nIn all {} rows of `compare`'s narrow phase, {} answers were checked: {} of ours are off by more than 1e-5 of the \
         size (the largest error is {}) and {} contacts are missed; of parry3d's, {} are off and {} missed. Times are medians \
         on one thread, with both engines taking turns; a `mesh` row is the time of a frame of 1,000 bodies, of one query, or \
         per triangle built. `cargo run --release -p asunder-benches --bin compare -- narrow --save`, `-- mesh --save`, \
         `-- broad --only query --save`; {}.",
        judged.len(),
        sum(|row| row.judged),
        sum(|row| row.off),
        error(largest),
        sum(|row| row.missed),
        sum(|row| row.peer_off),
        sum(|row| row.peer_missed),
        origins.join(", "),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::Accuracy;

    #[test]
    fn what_was_judged_is_told_and_summed() {
        let mut row = Row::new("box/mixed/manifold", "pair", 10);
        (row.ours_ns, row.peer_ns) = (Some(200.0), Some(500.0));
        row.accuracy = Some(Accuracy {
            judged: 4000,
            max_error: 3e-8,
            peer_max_error: Some(2e-3),
            peer_off: Some(7),
            peer_missed: Some(2),
            ..Accuracy::default()
        });
        (row.ours_quartiles, row.peer_quartiles) = (Some([190.0, 260.0]), Some([480.0, 505.0]));
        let kept = KeptRow::new("narrow", &row);
        assert!(kept.ours().is_some_and(Spread::is_wide) && !kept.peer().is_some_and(Spread::is_wide));
        assert_eq!(kept.found(), "3e-8 against 2e-3; parry3d 7 of 4,000 off by more than 1e-5");
        let text = together(&[kept, KeptRow::default()]);
        assert!(text.contains(
            "In all 1 rows of `compare`'s narrow phase, 4,000 answers were checked: 0 of ours are off"
        ));
        assert!(text.contains("of parry3d's, 7 are off and 2 missed"));
        assert_eq!(together(&[]), "");
    }
}
