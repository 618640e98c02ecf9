//! Wrong answers by the size of the gap, one field per dimension and side.

use super::{Draft, Figure};
use crate::error::GapRow;
use crate::report::losses::{distinct, of_gap};
use crate::report::names::{count, dimension};
use crate::report::palette::{look, rank};
use crate::report::plots::Title;
use crate::report::plots::heat::{Row, heat};
use crate::report::table::Table;

/// The decade of exact touching.
const TOUCH: i32 = -99;
/// The decades that a field shows one by one; narrower gaps share a column.
const NARROWEST: i32 = -13;
const WIDEST: i32 = -1;

pub(super) fn draft(rows: &[GapRow]) -> Draft {
    let mut figures = Vec::new();
    for dim in ["3d", "2d"] {
        for (apart, side) in [(true, "apart"), (false, "overlapping")] {
            let chosen = |row: &&GapRow| row.dimension == dim && (row.apart == apart) && row.decade != TOUCH;
            let here: Vec<&GapRow> = rows.iter().filter(chosen).collect();
            if !here.is_empty() {
                figures.push(field(dim, side, &here));
            }
        }
    }
    Draft {
        heading: "Wrong answers by gap",
        method: "All families but the random one together. A column holds pairs whose gap, or overlap, is so small a part of their size. \
                 A pair counts as wrong where the sign of the answer is not that of exact arithmetic. Pairs that touch \
                 exactly are in the table.",
        figures,
        findings: Vec::new(),
        losses: of_gap(rows),
        tables: vec![table(rows)],
    }
}

fn column(decade: i32) -> i32 {
    decade.clamp(NARROWEST, WIDEST)
}

fn field(dim: &str, side: &str, rows: &[&GapRow]) -> Figure {
    let question = format!("{}, {side}: how wide a gap is told right?", dimension(dim));
    let question = if side == "apart" { question } else { question.replace("wide a gap", "deep an overlap") };
    let title = Title::new(question.clone(), "Per cent wrong; green: none of them. From wide to narrow.");
    let widest = rows.iter().map(|row| column(row.decade)).max().unwrap_or(WIDEST);
    let columns: Vec<i32> = (NARROWEST..=widest).rev().collect();
    let names: Vec<String> = columns
        .iter()
        .map(|&decade| match decade {
            NARROWEST => format!("≤{decade}"),
            _ => decade.to_string(),
        })
        .collect();
    let mut methods = distinct(rows, |row| row.method.clone());
    methods.sort_by_key(|method| rank(method));
    let fields: Vec<Row> = methods
        .iter()
        .map(|method| {
            let share = |&decade: &i32| {
                let of = rows.iter().filter(|row| row.method == *method && column(row.decade) == decade);
                let (pairs, wrong) = of.fold((0, 0), |sum, row| (sum.0 + row.pairs, sum.1 + row.wrong));
                (pairs > 0).then(|| wrong as f64 / pairs as f64)
            };
            Row { look: look(method), shares: columns.iter().map(share).collect() }
        })
        .collect();
    let caption = "power of ten of |gap| over size";
    Figure { file: format!("gap-{dim}-{side}"), question, svg: heat(&title, caption, &names, &fields) }
}

fn table(rows: &[GapRow]) -> Table {
    let mut methods = distinct(rows, |row| row.method.clone());
    methods.sort_by_key(|method| rank(method));
    let mut table = Table::new("Wrong of all, by gap", &["where"]);
    table.head.extend(methods.iter().map(|method| look(method).name));
    let mut places = distinct(rows, |row| (row.dimension.clone(), row.apart, row.decade));
    places.sort_by(|a, b| b.cmp(a));
    for (dim, apart, decade) in places {
        let side = if apart { "apart" } else { "overlapping" };
        let place = if decade == TOUCH { "touching".to_string() } else { format!("{side} 1e{decade}") };
        let mut cells = vec![format!("{}, {place}", dimension(&dim))];
        cells.extend(methods.iter().map(|method| {
            let is_here = |row: &&GapRow| {
                row.method == *method && row.dimension == dim && (row.apart, row.decade) == (apart, decade)
            };
            let of = rows.iter().filter(is_here);
            let (wrong, pairs) = of.fold((0, 0), |sum, row| (sum.0 + row.wrong, sum.1 + row.pairs));
            if pairs > 0 { format!("{} of {}", count(wrong), count(pairs)) } else { "-".to_string() }
        }));
        table.rows.push(cells);
    }
    table
}
