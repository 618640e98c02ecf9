//! How stable answers are, one plot per measure.

use super::{Draft, Figure};
use crate::error::StabilityRow;
use crate::report::losses::{distinct, of_stability};
use crate::report::names::{count, error, words};
use crate::report::palette::{look, rank};
use crate::report::plots::Title;
use crate::report::plots::groups::Group;
use crate::report::plots::strips::{Scale, Strip, strips};
use crate::report::table::Table;

pub(super) fn draft(rows: &[StabilityRow]) -> Draft {
    let figures =
        distinct(rows, |row| row.measure.clone()).iter().map(|measure| of_measure(measure, rows)).collect();
    Draft {
        heading: "Stability",
        method: "Faces on faces, sunk by 1e-4 of size; one number of a pose is moved by one ulp of f32, or the pair is \
                 carried along for 10,000 frames (a quick run: 1,000) with rotations that nobody normalises. A jump of 1 is what the motion \
                 itself explains. The mark is the median, the thick line reaches the 99th percentile and the thin one \
                 the greatest. Stacks stand on our contacts alone.",
        figures,
        findings: Vec::new(),
        losses: of_stability(rows),
        tables: vec![table(rows)],
    }
}

/// The question of a measure.
fn question(measure: &str) -> String {
    match measure {
        "jitter-1ulp" => "How far does depth jump, by 1 ulp of a pose?".to_string(),
        "count-changes" => "How often does 1 ulp change the points?".to_string(),
        "normal-flips" => "How far does 1 ulp turn the normal?".to_string(),
        "drifting-depth" => "How far does depth drift as frames go by?".to_string(),
        "standing-stack" => "How far do bodies of a stack creep in 5 s?".to_string(),
        other => format!("{}?", words(other)),
    }
}

fn of_measure(measure: &str, rows: &[StabilityRow]) -> Figure {
    let here: Vec<&StabilityRow> = rows.iter().filter(|row| row.measure == measure).collect();
    let groups: Vec<Group<Strip>> = distinct(&here, |row| row.shape.clone())
        .into_iter()
        .map(|shape| {
            let mut of: Vec<&&StabilityRow> = here.iter().filter(|row| row.shape == shape).collect();
            of.sort_by_key(|row| rank(&row.method));
            let strip = |row: &&&StabilityRow| Strip {
                look: look(&row.method),
                value: row.median,
                inner: (row.median, row.p99),
                end: row.max,
                is_noisy: false,
            };
            Group { name: words(&shape), rows: of.iter().map(strip).collect() }
        })
        .collect();
    let unit = here.first().map_or("", |row| row.unit.as_str());
    let title = Title::new(question(measure), "Further left is steadier. Figures: median … greatest.");
    let svg =
        strips(&title, &format!("{unit}: median, 99th percentile, greatest"), Scale::Logarithmic, &groups);
    Figure { file: format!("stability-{measure}"), question: question(measure), svg }
}

fn table(rows: &[StabilityRow]) -> Table {
    let head = ["measure", "shape", "method", "samples", "median", "99 %", "greatest", "unit"];
    let mut table = Table::new("Every measure", &head);
    table.rows.extend(rows.iter().map(|row| {
        vec![
            words(&row.measure),
            words(&row.shape),
            look(&row.method).name,
            count(row.samples),
            error(row.median),
            error(row.p99),
            error(row.max),
            row.unit.clone(),
        ]
    }));
    table
}
