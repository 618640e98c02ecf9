//! Time of every method against its error, one plot per family of pairs.

use super::{Draft, Figure, marked};
use crate::clock::Spread;
use crate::error::ErrorRow;
use crate::report::losses::{distinct, of_error};
use crate::report::names::{count, dimension, error, short, words};
use crate::report::palette::{look, rank};
use crate::report::plots::Title;
use crate::report::plots::scatter::{Across, Point, scatter};
use crate::report::table::Table;

pub(super) fn draft(rows: &[ErrorRow]) -> Draft {
    let mut figures = Vec::new();
    // Space first: most readers come for it.
    for dim in ["3d", "2d"] {
        let here: Vec<&ErrorRow> = rows.iter().filter(|row| row.dimension == dim).collect();
        for group in distinct(&here, |row| row.group.clone()) {
            let here: Vec<&ErrorRow> = here.iter().copied().filter(|row| row.group == group).collect();
            figures.push(of_group(dim, &group, &here));
        }
        if !here.is_empty() {
            figures.push(of_wrong(dim, &here));
        }
    }
    Draft {
        heading: "Speed against error",
        method: "One question, the separation, about every pair of a family. Across: the 99th percentile of \
                 |answer - truth| over size; the thin line goes on to the greatest. Up: median time of a query; the \
                 upright line spans its quartiles. The grey steps are the Pareto front: below and left of them nobody \
                 was. asunder's fast tier says yes or no only, so that it has an error only where it is wrong; it is \
                 left out of the front. “Wrong” counts pairs strictly apart or strictly overlapping that were answered the other way. \
                 Methods took turns, block by block, in CPU time of one thread.",
        figures,
        findings: findings(rows),
        losses: of_error(rows),
        tables: vec![table(rows)],
    }
}

fn of_group(dim: &str, group: &str, rows: &[&ErrorRow]) -> Figure {
    let question = format!("{}, {}: how fast, how wrong?", dimension(dim), words(group));
    let title = Title::new(question.clone(), "Lower left is better; nobody is beyond the grey steps.");
    let across = Across {
        caption: "error over size, 99th percentile — greatest".to_string(),
        zero: "exact".to_string(),
    };
    let points: Vec<Point> =
        rows.iter().map(|row| point(row, (row.error_p99, row.error_max), with_wrong(row))).collect();
    Figure { file: format!("error-{dim}-{group}"), question, svg: scatter(&title, &across, &points) }
}

fn point(row: &ErrorRow, (across, reach): (f64, f64), label: String) -> Point {
    let ns = Spread::new(row.ns, row.ns_low, row.ns_high);
    Point { look: look(&row.method), label, across, reach, ns, is_ranked: has_depth(&row.method) }
}

/// Whether a method gives a depth, or only yes or no.
fn has_depth(method: &str) -> bool {
    method != "fast"
}

fn with_wrong(row: &ErrorRow) -> String {
    let mut label = look(&row.method).name;
    if !has_depth(&row.method) {
        label.push_str(" (yes or no)");
    }
    if row.wrong_per_100k > 0.0 {
        label.push_str(&format!(", {:.1} % wrong", row.wrong_per_100k * 1e-3).replace(", 0.0 %", ", <0.1 %"));
    }
    if row.refused > 0 {
        label.push_str(&format!(", {} refused", count(row.refused)));
    }
    label
}

/// All families of a dimension together, with equal weights.
fn of_wrong(dim: &str, rows: &[&ErrorRow]) -> Figure {
    let question = format!("{}, all families: how often a wrong yes or no?", dimension(dim));
    let title = Title::new(question.clone(), "Means over families; lower left is better.");
    let across = Across { caption: "wrong answers in 100,000".to_string(), zero: "none".to_string() };
    let points: Vec<Point> = distinct(rows, |row| row.method.clone())
        .into_iter()
        .map(|method| {
            let of: Vec<&&ErrorRow> = rows.iter().filter(|row| row.method == method).collect();
            let mean =
                |pick: fn(&ErrorRow) -> f64| of.iter().map(|row| pick(row)).sum::<f64>() / of.len() as f64;
            let ns = Spread::new(mean(|row| row.ns), mean(|row| row.ns_low), mean(|row| row.ns_high));
            let wrong = mean(|row| row.wrong_per_100k);
            let look = look(&method);
            Point { label: look.name.clone(), look, across: wrong, reach: wrong, ns, is_ranked: true }
        })
        .collect();
    Figure { file: format!("wrong-{dim}"), question, svg: scatter(&title, &across, &points) }
}

fn findings(rows: &[ErrorRow]) -> Vec<String> {
    let mut said = Vec::new();
    for method in distinct(rows, |row| row.method.clone()) {
        let here = || rows.iter().filter(|row| row.method == method);
        let pairs: u64 = here().map(|row| row.pairs).sum();
        let wrong: f64 = here().map(|row| row.wrong_per_100k * 1e-5 * row.answered as f64).sum();
        let refused: u64 = here().map(|row| row.refused).sum();
        let greatest = here().map(|row| row.error_max).fold(0.0, f64::max);
        said.push(format!(
            "{}: {} wrong and {} refused of {} pairs; greatest error {} of size.",
            look(&method).name,
            count(libm::round(wrong) as u64),
            count(refused),
            count(pairs),
            error(greatest),
        ));
    }
    said
}

fn table(rows: &[ErrorRow]) -> Table {
    let head =
        ["family", "method", "pairs", "a query", "error, 99 %", "greatest", "wrong in 100,000", "refused"];
    let mut table = Table::new("Every method, every family", &head);
    let mut rows: Vec<&ErrorRow> = rows.iter().collect();
    let groups = distinct(&rows, |row| row.group.clone());
    let place = |row: &ErrorRow| groups.iter().position(|group| *group == row.group);
    rows.sort_by_key(|row| (row.dimension != "3d", place(row), rank(&row.method)));
    for row in rows {
        table.rows.push(vec![
            format!("{}, {}", dimension(&row.dimension), words(&row.group)),
            look(&row.method).name,
            count(row.pairs),
            marked(row.ns, row.ns_low, row.ns_high),
            error(row.error_p99),
            error(row.error_max),
            short(row.wrong_per_100k).replace("0.00", "0"),
            count(row.refused),
        ]);
    }
    table
}
