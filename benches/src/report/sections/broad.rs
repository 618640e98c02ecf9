//! All pairs of boxes: time over sizes, one plot per scene; threads; crossovers.

use super::{Draft, Figure, marked, remarks};
use crate::broad::rows::BroadRow;
use crate::clock::Spread;
use crate::report::losses::{best, crossover, distinct, of_broad};
use crate::report::names::{count, duration, short, size};
use crate::report::palette::look;
use crate::report::plots::Title;
use crate::report::plots::curves::{Curve, curves};
use crate::report::plots::groups::Group;
use crate::report::plots::strips::{Scale, Strip, strips};
use crate::report::table::Table;
use crate::world::rows::FrameRow;

pub(super) fn draft(rows: &[BroadRow], frames: &[FrameRow]) -> Draft {
    let scenes = distinct(rows, |row| row.scene.clone());
    let mut figures: Vec<Figure> = scenes.iter().map(|scene| over_sizes(scene, rows)).collect();
    if !figures.is_empty() {
        // The plots with the most rows last, next to each other.
        figures.extend(false_pairs(frames));
        figures.extend(threads(&scenes, rows));
        figures.extend(compared(&scenes, rows));
    }
    Draft {
        heading: "Broad phase",
        method: "All overlapping pairs of a frame of moving boxes, filtered; asunder's sorted, by the better of its two \
                 ways, parry3d's in no order, by the best of up to nine ways to bring its tree up to date. The dashed \
                 line is the time in which one thread's memory could read every box and write every pair. Ways took \
                 turns, frame by frame, in CPU time of one thread, and on two threads in blocks of frames, by the \
                 clock on the wall; every frame all had to find equally many pairs. A \
                 sweep that is broken off as too slow has a row that says so, and no point. A false pair is one that \
                 is handed over though its shapes do not touch; boxes alone have none, since those of a listed pair \
                 overlap, and there the ratio is how many pairs of boxes the sweep from scratch compares for each that \
                 it hands over; where it cuts columns that are too full, nobody counts.",
        figures,
        findings: findings(&scenes, rows),
        losses: of_broad(rows),
        tables: vec![table(&scenes, rows)],
    }
}

/// The gain from a second thread, where it was measured.
fn threads(scenes: &[String], rows: &[BroadRow]) -> Option<Figure> {
    let question = "Do two threads pay in the broad phase?".to_string();
    let title = Title::new(question.clone(), "One thread's time over two's, by the clock on the wall.");
    let groups: Vec<Group<Strip>> = scenes.iter().filter_map(|scene| speedups(scene, rows)).collect();
    let svg = strips(&title, "times as fast on two threads as on one", Scale::Linear, &groups);
    (!groups.is_empty()).then(|| Figure { file: "broad-threads".to_string(), question, svg })
}

/// How many pairs of boxes the sweep compares for each pair that it reports, where that was counted.
fn compared(scenes: &[String], rows: &[BroadRow]) -> Option<Figure> {
    let group = |scene: &String| {
        let strip = |boxes| {
            let mut look = look("asunder");
            look.name = size(boxes);
            let value = compared_a_pair(scene, boxes, rows)?;
            Some(Strip { look, value, inner: (value, value), end: value, is_noisy: false })
        };
        let strips: Vec<Strip> = sizes_of(scene, rows).into_iter().filter_map(strip).collect();
        (!strips.is_empty()).then(|| Group { name: scene.clone(), rows: strips })
    };
    let groups: Vec<Group<Strip>> = scenes.iter().filter_map(group).collect();
    let question = "How many boxes are compared for a pair?".to_string();
    let title = Title::new(question.clone(), "Pairs of boxes that the sweep compares; 1 is the least.");
    let svg = strips(&title, "pairs of boxes compared, over pairs handed over", Scale::Logarithmic, &groups);
    (!groups.is_empty()).then(|| Figure { file: "broad-compared".to_string(), question, svg })
}

fn compared_a_pair(scene: &str, boxes: u64, rows: &[BroadRow]) -> Option<f64> {
    let mut here = rows.iter().filter(|row| row.scene == scene && row.boxes == boxes && row.compared > 0);
    here.next().map(|row| row.compared as f64 / row.pairs.max(1) as f64)
}

/// The share of candidate pairs without contact, in scenes of shapes.
fn false_pairs(frames: &[FrameRow]) -> Option<Figure> {
    let one_thread: Vec<&FrameRow> = frames.iter().filter(|row| row.threads == 1).collect();
    let strip = |row: &&FrameRow| {
        let value = 100.0 * row.false_pairs();
        Strip { look: look(&row.method), value, inner: (0.0, value), end: value, is_noisy: false }
    };
    let groups: Vec<Group<Strip>> = distinct(&one_thread, |row| row.scene.clone())
        .into_iter()
        .map(|scene| {
            let rows = one_thread.iter().filter(|row| row.scene == scene).map(strip).collect();
            Group { name: scene, rows }
        })
        .collect();
    let question = "How many pairs are handed over for nothing?".to_string();
    let title = Title::new(question.clone(), "Boxes overlap, shapes do not touch: the scenes of the frames.");
    let svg = strips(&title, "% of all pairs that are handed over", Scale::Linear, &groups);
    (!groups.is_empty()).then(|| Figure { file: "broad-false-pairs".to_string(), question, svg })
}

fn sizes_of(scene: &str, rows: &[BroadRow]) -> Vec<u64> {
    let here: Vec<&BroadRow> = rows.iter().filter(|row| row.scene == scene).collect();
    let mut sizes = distinct(&here, |row| row.boxes);
    sizes.sort_unstable();
    sizes
}

/// Time per box of a method's best variant, at every size.
fn curve(scene: &str, method: &str, rows: &[BroadRow]) -> Vec<(f64, Spread)> {
    let at = |boxes: u64| {
        let row = best(rows, (scene, boxes, method), "thread", 1).filter(|row| !row.is_cut)?;
        let spread = Spread::new(row.ns, row.ns_low, row.ns_high).scaled(1.0 / boxes.max(1) as f64);
        Some((boxes as f64, spread))
    };
    sizes_of(scene, rows).into_iter().filter_map(at).collect()
}

fn over_sizes(scene: &str, rows: &[BroadRow]) -> Figure {
    let question = format!("{scene}: what does a box cost among many?");
    let title = Title::new(question.clone(), "Time a box, one thread; lower is better.");
    let drawn: Vec<Curve> = ["asunder", "parry3d", "memory"]
        .map(|method| Curve {
            look: look(method),
            points: curve(scene, method, rows),
            is_bound: method == "memory",
        })
        .into_iter()
        .filter(|curve| !curve.points.is_empty())
        .collect();
    let svg = curves(&title, "boxes", &sizes_of(scene, rows), &drawn);
    Figure { file: format!("broad-{scene}"), question, svg }
}

fn speedups(scene: &str, rows: &[BroadRow]) -> Option<Group<Strip>> {
    let strips: Vec<Strip> = sizes_of(scene, rows)
        .into_iter()
        .filter_map(|boxes| {
            let on = |threads| best(rows, (scene, boxes, "asunder"), "wall", threads);
            let (one, two) = (on(1)?, on(2)?);
            let mut look = look("asunder");
            look.name = size(boxes);
            let is_noisy =
                [one, two].iter().any(|row| Spread::new(row.ns, row.ns_low, row.ns_high).is_wide());
            let (value, inner) = (one.ns / two.ns, (one.ns_low / two.ns_high, one.ns_high / two.ns_low));
            Some(Strip { look, value, inner, end: value, is_noisy })
        })
        .collect();
    (!strips.is_empty()).then(|| Group { name: scene.to_string(), rows: strips })
}

fn findings(scenes: &[String], rows: &[BroadRow]) -> Vec<String> {
    let mut said = Vec::new();
    let cases = distinct(rows, |row| (row.scene.clone(), row.boxes));
    let ratios: Vec<(f64, &String, u64)> = cases
        .iter()
        .filter_map(|(scene, boxes)| {
            let of = |method| best(rows, (scene, *boxes, method), "thread", 1).filter(|row| !row.is_cut);
            Some((of("parry3d")?.ns / of("asunder")?.ns, scene, *boxes))
        })
        .collect();
    let least = ratios.iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let most = ratios.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    if let (Some(least), Some(most)) = (least, most) {
        said.push(format!(
            "parry3d's time over asunder's, over all scenes and sizes: from {} ({}, {}) to {} ({}, {}).",
            short(least.0),
            least.1,
            size(least.2),
            short(most.0),
            most.1,
            size(most.2),
        ));
    }
    for scene in scenes {
        let medians = |method: &str| -> Vec<(f64, f64)> {
            curve(scene, method, rows).into_iter().map(|(n, spread)| (n, spread.median)).collect()
        };
        if let Some(at) = crossover(&medians("asunder"), &medians("parry3d")) {
            said.push(format!(
                "{scene}: asunder and parry3d cross at about {} boxes.",
                count(libm::round(at) as u64)
            ));
        }
    }
    said.extend(pays_from(scenes, rows));
    let named = |row: &BroadRow| format!("{}, {} boxes", row.scene, size(row.boxes));
    said.extend(remarks(rows.iter().map(|row| (named(row), row.note.as_str()))));
    said
}

/// For each scene, the smallest size from which on a second thread saves time beyond the noise.
fn pays_from(scenes: &[String], rows: &[BroadRow]) -> Option<String> {
    let mut said = Vec::new();
    for scene in scenes {
        let pays = |boxes: &u64| {
            let on = |threads| best(rows, (scene, *boxes, "asunder"), "wall", threads);
            on(1).zip(on(2)).is_some_and(|(one, two)| two.ns_high < one.ns_low)
        };
        let sizes = sizes_of(scene, rows);
        if let Some(least) = sizes.iter().rev().take_while(|boxes| pays(boxes)).last() {
            said.push(format!("{scene} from {}", size(*least)));
        }
    }
    let all = said.join(", ");
    (!all.is_empty())
        .then(|| format!("A second thread saves time beyond the noise, of the sizes measured: {all}."))
}

fn table(scenes: &[String], rows: &[BroadRow]) -> Table {
    let head = [
        "scene",
        "pairs",
        "asunder",
        "its way",
        "parry3d",
        "its way",
        "ratio",
        "% of bound",
        "bytes a box",
        "compared a pair",
    ];
    let mut table = Table::new("Every scene and size, one thread", &head);
    let text = |text: Option<String>| text.unwrap_or_else(|| "-".to_string());
    for scene in scenes {
        for boxes in sizes_of(scene, rows) {
            let of = |method| best(rows, (scene, boxes, method), "thread", 1);
            let Some(ours) = of("asunder") else { continue };
            let peer = of("parry3d");
            let bound = of("memory").map_or(0.0, |row| row.ns);
            let whole = Some(ours).filter(|row| !row.is_cut);
            table.rows.push(vec![
                format!("{scene}/{}", size(boxes)),
                count(ours.pairs),
                time(ours),
                ours.variant.clone(),
                text(peer.map(time)),
                text(peer.map(|row| row.variant.replace("parry3d ", ""))),
                text(peer.zip(whole).map(|(row, ours)| short(row.ns / ours.ns))),
                text(whole.map(|ours| short(100.0 * bound / ours.ns))),
                text(whole.map(|ours| short(ours.bytes_per_box))),
                text(compared_a_pair(scene, boxes, rows).map(short)),
            ]);
        }
    }
    table
}

/// A time, or the time after which it was aborted.
fn time(row: &BroadRow) -> String {
    if row.is_cut {
        return format!("broken off after {}", duration(row.ns_low));
    }
    marked(row.ns, row.ns_low, row.ns_high)
}
