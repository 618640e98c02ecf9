//! Whole frames: where their time goes, and what memory they hold.

use super::{Draft, Figure, marked, remarks};
use crate::report::losses::{distinct, of_frame};
use crate::report::names::{count, duration, number, short};
use crate::report::palette::{STAGES, look};
use crate::report::plots::Title;
use crate::report::plots::bars::{Bar, bars};
use crate::report::plots::groups::Group;
use crate::report::plots::strips::{Scale, Strip, strips};
use crate::report::table::Table;
use crate::world::rows::FrameRow;

/// The stages, in order, and the rest of a frame.
const NAMES: [&str; 6] = ["boxes", "pairs", "contacts", "old and new", "events", "poses in, points out"];

pub(super) fn draft(rows: &[FrameRow]) -> Draft {
    let figures = [stages(rows), in_plane(rows), memory(rows)].into_iter().flatten().collect();
    Draft {
        heading: "Frame",
        method: "Poses in, all contact points walked: named scenes beside a lean pipeline straight over parry3d (its \
                 trees, its persistent manifolds, no events); those of the plane stand alone. By the clock on the wall, in turns, in blocks of \
                 frames whose first two do not count; contacts, points and candidates are means. \
                 Allocations are those of a steady frame, in the third round of the same frames; bytes are held beside \
                 the shapes' own data. False pairs are candidates without a contact point.",
        figures,
        findings: allocations(rows)
            .into_iter()
            .chain(remarks(rows.iter().map(|row| (row.scene.clone(), row.note.as_str()))))
            .collect(),
        losses: of_frame(rows),
        tables: vec![table(rows)],
    }
}

/// Scenes that the peer can play.
fn stages(rows: &[FrameRow]) -> Option<Figure> {
    let question = "Where does a frame's time go?".to_string();
    let title =
        Title::new(question.clone(), "In units of lean parry3d's frame on one thread: shorter is better.");
    let groups = groups(rows, |here| here.iter().find(|row| row.method == "parry3d").map(|row| row.ns));
    let svg = bars(&title, "frame time over lean parry3d's, one thread", &parts_drawn(), &groups);
    (!groups.is_empty()).then(|| Figure { file: "frame-stages".to_string(), question, svg })
}

/// Scenes that it cannot play: those in the plane.
fn in_plane(rows: &[FrameRow]) -> Option<Figure> {
    let question = "In the plane: where does a frame's time go?".to_string();
    let title = Title::new(question.clone(), "In units of asunder's own frame on one thread.");
    let rows: Vec<FrameRow> = rows.iter().filter(|row| row.scene.starts_with("plane/")).cloned().collect();
    let groups = groups(&rows, |here| here.iter().find(|row| row.threads == 1).map(|row| row.ns));
    let svg = bars(&title, "frame time over that on one thread", &parts_drawn(), &groups);
    (!groups.is_empty()).then(|| Figure { file: "frame-stages-plane".to_string(), question, svg })
}

fn parts_drawn() -> Vec<(&'static str, plotters::style::RGBColor)> {
    NAMES.into_iter().zip(STAGES).collect()
}

/// The bars of every scene that has a unit.
fn groups(rows: &[FrameRow], unit: impl Fn(&[&FrameRow]) -> Option<f64>) -> Vec<Group<Bar>> {
    let group = |scene: &String| {
        let here: Vec<&FrameRow> = rows.iter().filter(|row| row.scene == *scene).collect();
        let unit = unit(&here)?;
        Some(Group { name: scene.clone(), rows: here.iter().map(|row| bar(row, unit)).collect() })
    };
    distinct(rows, |row| row.scene.clone()).iter().filter_map(group).collect()
}

/// The memory that worlds hold, where it was counted.
fn memory(rows: &[FrameRow]) -> Option<Figure> {
    let counted: Vec<&FrameRow> = rows.iter().filter(|row| row.bytes_per_body >= 0.0).collect();
    let strip = |row: &&FrameRow| {
        let value = row.bytes_per_body;
        Strip { look: look(&row.method), value, inner: (0.0, value), end: value, is_noisy: false }
    };
    let groups: Vec<Group<Strip>> = distinct(&counted, |row| row.scene.clone())
        .into_iter()
        .map(|scene| {
            let rows = counted.iter().filter(|row| row.scene == scene).map(strip).collect();
            Group { name: scene, rows }
        })
        .collect();
    let question = "What does a body take in memory?".to_string();
    let title = Title::new(question.clone(), "Bodies, pairs, contacts; shapes' own data apart.");
    let svg = strips(&title, "bytes a body", Scale::Linear, &groups);
    (!groups.is_empty()).then(|| Figure { file: "frame-memory".to_string(), question, svg })
}

/// How often a steady frame allocates.
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
    head.extend(["contacts", "points", "candidates", "false, %", "allocations", "bytes a body", "note"]);
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
        cells.extend([
            count(row.contacts),
            count(row.points),
            count(row.candidates),
            format!("{:.0}", 100.0 * row.false_pairs()),
            counted(row.allocations),
            counted(row.bytes_per_body),
            row.note.clone(),
        ]);
        table.rows.push(cells);
    }
    table
}
