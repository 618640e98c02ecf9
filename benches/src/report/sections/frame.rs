//! Whole frames: where their time goes, what they hold.

use super::{Draft, Figure, marked};
use crate::report::losses::{distinct, of_frame};
use crate::report::names::{count, duration, number, short};
use crate::report::palette::{STAGES, look};
use crate::report::plots::Title;
use crate::report::plots::bars::{self, Bar, bars};
use crate::report::plots::strips::{Group, Scale, Strip, strips};
use crate::report::table::Table;
use crate::world::rows::FrameRow;

/// The stages, in their order, and the rest of a frame.
const NAMES: [&str; 6] = ["boxes", "pairs", "contacts", "old and new", "events", "poses in, points out"];

pub(super) fn draft(rows: &[FrameRow]) -> Draft {
    let mut figures = if rows.is_empty() { Vec::new() } else { vec![stages(rows)] };
    figures.extend(memory(rows));
    Draft {
        heading: "Frame",
        method: "Poses in, all contact points walked: named scenes beside a lean pipeline straight over parry3d (its \
                 trees, its persistent manifolds, no events). By the clock on the wall, in turns, frame by frame. \
                 Allocations are those of a steady frame, in the third round of the same frames; bytes are held beside \
                 the shapes' own data. False pairs are candidates without a contact point.",
        figures,
        findings: allocations(rows),
        losses: of_frame(rows),
        tables: vec![table(rows)],
    }
}

fn stages(rows: &[FrameRow]) -> Figure {
    let question = "Where does a frame's time go?".to_string();
    let title =
        Title::new(question.clone(), "In units of lean parry3d's frame on one thread: shorter is better.");
    let scenes = distinct(rows, |row| row.scene.clone());
    let groups: Vec<bars::Group> = scenes
        .iter()
        .filter_map(|scene| {
            let here = || rows.iter().filter(|row| row.scene == *scene);
            let unit = here().find(|row| row.method == "parry3d")?.ns;
            Some(bars::Group { name: scene.clone(), bars: here().map(|row| bar(row, unit)).collect() })
        })
        .collect();
    let parts: Vec<(&str, plotters::style::RGBColor)> = NAMES.into_iter().zip(STAGES).collect();
    let caption = "frame time over lean parry3d's, one thread";
    Figure { file: "frame-stages".to_string(), question, svg: bars(&title, caption, &parts, &groups) }
}

/// What the worlds hold, where somebody counted.
fn memory(rows: &[FrameRow]) -> Option<Figure> {
    let counted: Vec<&FrameRow> = rows.iter().filter(|row| row.bytes_per_body >= 0.0).collect();
    let strip = |row: &&FrameRow| {
        let value = row.bytes_per_body;
        Strip { look: look(&row.method), value, inner: (0.0, value), end: value, is_noisy: false }
    };
    let groups: Vec<Group> = distinct(&counted, |row| row.scene.clone())
        .into_iter()
        .map(|scene| {
            let strips = counted.iter().filter(|row| row.scene == scene).map(strip).collect();
            Group { name: scene, strips }
        })
        .collect();
    let question = "What does a body take in memory?".to_string();
    let title = Title::new(question.clone(), "Bodies, pairs, contacts; shapes' own data apart.");
    let svg = strips(&title, "bytes a body", Scale::Linear, &groups);
    (!groups.is_empty()).then(|| Figure { file: "frame-memory".to_string(), question, svg })
}

/// How often a steady frame asks the allocator.
fn allocations(rows: &[FrameRow]) -> Vec<String> {
    let counted: Vec<&FrameRow> = rows.iter().filter(|row| row.allocations >= 0.0).collect();
    let of = |method: String| {
        let here = counted.iter().filter(|row| row.method == method).map(|row| row.allocations);
        let (least, most) = here.fold((f64::INFINITY, 0.0_f64), |(l, m), calls| (l.min(calls), m.max(calls)));
        let name = look(&method).name;
        let (least, most) = (number(least), number(most));
        if least == most {
            format!("{name}: {least} allocations a steady frame, in every scene.")
        } else {
            format!("{name}: {least} to {most} allocations a steady frame.")
        }
    };
    distinct(&counted, |row| row.method.clone()).into_iter().map(of).collect()
}

fn parts(row: &FrameRow) -> [f64; 6] {
    let stages = [row.refit_ns, row.sweep_ns, row.collide_ns, row.merge_ns, row.report_ns];
    let [refit, sweep, collide, merge, report] = stages;
    [refit, sweep, collide, merge, report, (row.ns - stages.iter().sum::<f64>()).max(0.0)]
}

fn bar(row: &FrameRow, unit: f64) -> Bar {
    let mark = if crate::report::spread::is_wide(row.ns, row.ns_low, row.ns_high) { " ±" } else { "" };
    let threads = match (row.method.as_str(), row.threads) {
        ("parry3d", _) => String::new(),
        (_, 1) => ", 1 thread".to_string(),
        (_, more) => format!(", {more} threads"),
    };
    let look = look(&row.method);
    Bar {
        name: format!("{}{threads}", look.name),
        color: look.color,
        parts: parts(row).map(|ns| ns / unit).to_vec(),
        whisker: (row.ns_low / unit, row.ns_high / unit),
        label: format!("{}{mark}", duration(row.ns)),
    }
}

fn table(rows: &[FrameRow]) -> Table {
    let mut head = vec!["scene", "who", "threads", "bodies", "a frame"];
    head.extend(NAMES);
    head.extend(["contacts", "points", "candidates", "false, %", "allocations", "bytes a body"]);
    let mut table = Table::new("Every scene", &head);
    for row in rows {
        let counted =
            |value: f64| if value < 0.0 { "-".to_string() } else { short(value).replace("0.00", "0") };
        let mut cells = vec![
            row.scene.clone(),
            look(&row.method).name,
            row.threads.to_string(),
            count(row.bodies),
            marked(row.ns, row.ns_low, row.ns_high),
        ];
        cells.extend(parts(row).map(duration));
        let false_pairs = 100.0 * (1.0 - row.contacts as f64 / row.candidates.max(1) as f64);
        cells.extend([
            count(row.contacts),
            count(row.points),
            count(row.candidates),
            format!("{:.0}", false_pairs.max(0.0)),
            counted(row.allocations),
            counted(row.bytes_per_body),
        ]);
        table.rows.push(cells);
    }
    table
}
