//! Rows of `compare` that were kept, and what README shows of them.

use super::names::{count, duration, error};
use super::origin::{commit, today};
use super::table::Table;
use crate::row::Row;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// One row of `compare`, as plain columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptRow {
    /// Which part of `compare`: `narrow`, `broad`, `mesh` ...
    pub part: String,
    /// The case.
    pub row: String,
    /// What the times are for.
    pub per: String,
    /// Our time, in nanoseconds.
    pub ours_ns: Option<f64>,
    /// The peer's time, in nanoseconds.
    pub peer_ns: Option<f64>,
    /// Answers that were held against the truth.
    pub judged: Option<u64>,
    /// Our largest error, as a share of size.
    pub max_error: Option<f64>,
    /// Our answers that are off.
    pub off: Option<u64>,
    /// Contacts that we miss.
    pub missed: Option<u64>,
    /// The peer's largest error.
    pub peer_max_error: Option<f64>,
    /// The peer's answers that are off.
    pub peer_off: Option<u64>,
    /// Contacts that the peer misses.
    pub peer_missed: Option<u64>,
    /// What a reader should know.
    pub note: String,
    /// The commit it was measured at.
    pub commit: String,
    /// The day.
    pub date: String,
}

/// Asked for once: it is another program that knows.
static COMMIT: OnceLock<String> = OnceLock::new();

impl KeptRow {
    /// A row that was measured now.
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

    /// What both sides' answers were worth, or what the row says of itself.
    fn found(&self) -> String {
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

/// Puts rows in place of those of the same part and name, or behind all others.
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

/// Rows of the narrow phase that README shows, of more than two hundred; of the other parts it shows those whose names
/// begin so.
const SHOWN: [&str; 28] = [
    "box/mixed/boolean",
    "box/mixed/separation",
    "box/mixed/manifold",
    "box8/mixed/boolean",
    "box/rest/manifold",
    "box/rest/cached",
    "box/slide/cached",
    "authored/mixed/separation",
    "authored/mixed/manifold",
    "hull8/mixed/manifold",
    "hull16/mixed/manifold",
    "hull32/mixed/boolean",
    "hull32/mixed/manifold",
    "hull32/mixed/distance",
    "hull32/deep/separation",
    "hull32/far/boolean",
    "hull32/rest/cached",
    "hull32/slide/cached",
    "hull32/tumble/cached",
    "hull128/mixed/manifold",
    "rect/mixed/boolean",
    "rect/mixed/manifold",
    "poly8/mixed/manifold",
    "poly64/mixed/boolean",
    "grown4096/apart/boolean",
    "grown4096/light/boolean",
    "query/gas/100k",
    "query/city/100k",
];

fn is_shown(row: &KeptRow) -> bool {
    match row.part.as_str() {
        "narrow" => SHOWN.contains(&row.row.as_str()),
        "broad" => SHOWN.iter().any(|shown| row.row.starts_with(shown)),
        part => part == "mesh",
    }
}

/// README's table of them, and what all rows of the narrow phase say together. Nothing where none is kept.
pub fn part(rows: &[KeptRow]) -> String {
    let shown: Vec<&KeptRow> = rows.iter().filter(|row| is_shown(row)).collect();
    if shown.is_empty() {
        return String::new();
    }
    let mut table =
        Table::new("", &["row", "asunder", "parry3d", "ratio", "largest error of size; or what was found"]);
    for row in &shown {
        let time = |ns: Option<f64>| ns.map_or("-".to_string(), duration);
        let ratio = row
            .ours_ns
            .zip(row.peer_ns)
            .map_or("-".to_string(), |(ours, peer)| format!("{:.2}", peer / ours));
        let part = if row.part == "mesh" { "mesh " } else { "" };
        let name = format!("`{part}{}`", row.row);
        table.rows.push(vec![name, time(row.ours_ns), time(row.peer_ns), ratio, row.found()]);
    }
    format!("\n### Rows of `compare`\n\n{}\n{}\n", table.to_markdown(), together(rows))
}

/// What the judge found in all rows of the narrow phase, and where the rows come from.
fn together(rows: &[KeptRow]) -> String {
    let judged: Vec<&KeptRow> = rows.iter().filter(|row| row.judged.is_some()).collect();
    let sum = |of: fn(&KeptRow) -> Option<u64>| count(judged.iter().filter_map(|row| of(row)).sum());
    let largest = judged.iter().filter_map(|row| row.max_error).fold(0.0, f64::max);
    let mut origins: Vec<String> = rows.iter().map(|row| format!("{} at {}", row.date, row.commit)).collect();
    origins.sort();
    origins.dedup();
    format!(
        "In all {} rows of the narrow phase, {} answers: {} of ours are off by more than 1e-5 of size (the largest error is \
         {}) and {} contacts are missed; of parry3d's {} are off and {} missed. Time of one thread, medians, both sides in \
         turns; `mesh` rows are of 1,000 bodies a frame, a ray, a cast, a triangle. `cargo run --release -p asunder-benches \
         --bin compare -- narrow --save`, `-- mesh --save`, `-- broad --only query --save`; {}.",
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
        let mut other = Row::new("query/gas/100k/ray first", "query", 10);
        (other.ours_ns, other.note) = (Some(300.0), "same answers".to_string());
        let hidden = Row::new("gas/10k", "frame", 10_000);
        let rows =
            [KeptRow::new("narrow", &row), KeptRow::new("broad", &other), KeptRow::new("broad", &hidden)];
        let text = part(&rows);
        assert!(text.contains(
            "| `box/mixed/manifold` | 200 ns | 500 ns | 2.50 | 3e-8 against 2e-3; parry3d 7 of 4,000 off"
        ));
        assert!(text.contains("| `query/gas/100k/ray first` | 300 ns | - | - | same answers |"));
        assert!(!text.contains("`gas/10k`"));
        assert!(text.contains("In all 1 rows of the narrow phase, 4,000 answers: 0 of ours are off"));
        assert!(text.contains("of parry3d's 7 are off and 2 missed"));
        assert_eq!(part(&[]), "");
    }
}
