//! README's one table: similar rows share a line, with the ratios of the others in one of its cells.

use super::data::Data;
use super::kept::KeptRow;
use super::losses::{best, distinct};
use super::names::{count, dimension, duration, error, size, words};
use super::table::Table;
use crate::broad::rows::BroadRow;
use crate::clock::Spread;
use crate::error::{ErrorRow, VertexRow};

/// The text below the table.
pub(super) const READING: &str = "Ratio: parry3d's time over asunder's, in bold where parry3d is ahead. Similar rows: the same \
    ratio for each, or asunder's time where there is no peer. ± marks medians whose quartiles are more than 20 % apart, and \
    ratios of such medians.";

/// Rows that README shows first; the others are folded away. Chosen by what games use most, not by who is ahead.
const HEADLINES: [&str; 17] = [
    "`3D, near touching`",
    "`box/mixed/boolean`",
    "`box/mixed/separation`",
    "`box/mixed/manifold`",
    "`box/rest/manifold`",
    "`box/slide/cached`",
    "`hull16/separation`",
    "`gas/100k`",
    "`pile/100k`",
    "`query/gas/100k/ray first`",
    "`boxes_pile`",
    "`convex_pile/falling`",
    "`crowd`",
    "`mostly_static`",
    "`mesh rest/box/20k`",
    "`mesh roll/box/20k`",
    "`mesh tumble/box/20k`",
];

/// The table as README shows it: its headlines, and the rows that are folded away.
pub(super) fn tables(data: &Data) -> [Table; 2] {
    let mut all = table(data);
    let (headlines, others) = all
        .rows
        .drain(..)
        .partition(|row| row.first().is_some_and(|name| HEADLINES.contains(&name.as_str())));
    [Table { rows: headlines, ..all.clone() }, Table { rows: others, ..all }]
}

/// One measured row.
struct Measured {
    /// Rows with the same group are similar and share a line.
    group: String,
    /// What distinguishes it from the others of its group.
    label: String,
    /// Its name if it represents the group.
    name: String,
    /// Whether it represents its group, instead of the first row.
    is_lead: bool,
    /// Our time; `None` if we were aborted.
    ours: Option<Spread>,
    peer: Option<Spread>,
    /// Other findings.
    found: String,
}

/// One table of both sides' times and findings.
fn table(data: &Data) -> Table {
    let head = ["row", "asunder", "parry3d", "ratio", "similar rows", "error / size; other findings"];
    let mut table = Table::new("", &head);
    let all = [
        error_rows(data),
        vertex_rows(data),
        kept_rows(data, "narrow"),
        kept_rows(data, "shapes"),
        broad_rows(data),
        kept_rows(data, "broad"),
        frame_rows(data),
        kept_rows(data, "mesh"),
    ];
    for rows in all {
        for group in distinct(&rows, |row| row.group.clone()) {
            let alike: Vec<&Measured> = rows.iter().filter(|row| row.group == group).collect();
            table.rows.extend(line(&alike));
        }
    }
    table
}

/// One line for similar rows.
fn line(alike: &[&Measured]) -> Option<Vec<String>> {
    let lead = alike.iter().position(|row| row.is_lead).unwrap_or(0);
    let row = alike.get(lead)?;
    let others = alike.iter().enumerate().filter(|(i, _)| *i != lead);
    let others: Vec<String> =
        others.map(|(_, other)| format!("{} {}", other.label, in_short(other))).collect();
    Some(vec![
        format!("`{}`", row.name),
        row.ours.map_or_else(|| "broken off".to_string(), time),
        row.peer.map_or_else(|| "-".to_string(), time),
        ratio(row).unwrap_or_else(|| "-".to_string()),
        others.join(", "),
        row.found.clone(),
    ])
}

fn time(spread: Spread) -> String {
    let mark = if spread.is_wide() { " ±" } else { "" };
    format!("{}{mark}", duration(spread.median))
}

/// The peer's time divided by ours.
fn ratio(row: &Measured) -> Option<String> {
    let (ours, peer) = row.ours.zip(row.peer)?;
    let times = format!("{:.2}", peer.median / ours.median);
    Some(if peer.median < ours.median { format!("**{times}**") } else { times })
}

/// The short form of a row that another one represents.
fn in_short(row: &Measured) -> String {
    let is_noisy = row.ours.is_some_and(Spread::is_wide) || row.peer.is_some_and(Spread::is_wide);
    let told = match (ratio(row), row.ours) {
        (Some(ratio), _) => format!("{ratio}{}", if is_noisy { " ±" } else { "" }),
        (None, Some(ours)) => time(ours),
        (None, None) => "broken off".to_string(),
    };
    // Faults of a row must remain visible.
    if row.found.contains("DIFFER") { format!("{told} ({})", row.found) } else { told }
}

fn error_rows(data: &Data) -> Vec<Measured> {
    let spread = |row: &ErrorRow| Spread::new(row.ns, row.ns_low, row.ns_high);
    let of_group = |(dim, group): &(String, String)| {
        let of = |method: &str| {
            data.error.iter().find(|row| row.dimension == *dim && row.group == *group && row.method == method)
        };
        let (ours, peer) = (of("certain")?, of("parry-f32"));
        let against = peer.map_or(String::new(), |peer| format!(" against {}", said(peer)));
        let name = format!("{}, {}", dimension(dim), words(group));
        Some(Measured {
            // Rows without a peer are grouped by dimension.
            group: if peer.is_some() { name.clone() } else { dim.clone() },
            label: words(group),
            name,
            is_lead: false,
            ours: Some(spread(ours)),
            peer: peer.map(spread),
            found: format!("{}{against}", said(ours)),
        })
    };
    let groups = distinct(&data.error, |row| (row.dimension.clone(), row.group.clone()));
    groups.iter().filter_map(of_group).collect()
}

/// The 99th percentile of a method's errors, its wrong answers, and its refusals.
fn said(row: &ErrorRow) -> String {
    let wrong = match row.wrong_per_100k {
        0.0 => String::new(),
        wrong => format!(", {} wrong in 100,000", count(libm::ceil(wrong) as u64)),
    };
    let refused = match row.refused {
        0 => String::new(),
        refused => format!(", {} of {} refused", count(refused), count(row.pairs)),
    };
    format!("{}{wrong}{refused}", error(row.error_p99))
}

fn vertex_rows(data: &Data) -> Vec<Measured> {
    let is_shown = |vertices: u32| [4, 16, 64, 256].contains(&vertices);
    let spread = |row: &VertexRow| Spread::new(row.ns, row.ns_low, row.ns_high);
    let mut kinds =
        distinct(&data.vertices, |row| (row.dimension.clone(), row.operation.clone(), row.vertices));
    kinds.retain(|(dim, _, vertices)| dim == "3d" && is_shown(*vertices));
    let of_kind = |(dim, operation, vertices): &(String, String, u32)| {
        let of = |method: &str| {
            let mut rows = data.vertices.iter();
            rows.find(|row| {
                row.method == method
                    && row.dimension == *dim
                    && row.operation == *operation
                    && row.vertices == *vertices
            })
        };
        let ours = of("certain").or_else(|| of("fast"))?;
        Some(Measured {
            group: operation.clone(),
            label: format!("hull{vertices}"),
            name: format!("hull{vertices}/{operation}"),
            is_lead: *vertices == 16,
            ours: Some(spread(ours)),
            peer: of("parry-f32").map(spread),
            found: String::new(),
        })
    };
    kinds.iter().filter_map(of_kind).collect()
}

fn broad_rows(data: &Data) -> Vec<Measured> {
    let spread = |row: &BroadRow| Spread::new(row.ns, row.ns_low, row.ns_high);
    let of_case = |(scene, boxes): &(String, u64)| {
        let of = |method| best(&data.broad, (scene, *boxes, method), "thread", 1);
        let ours = of("asunder")?;
        Some(Measured {
            group: scene.clone(),
            label: size(*boxes),
            name: format!("{scene}/{}", size(*boxes)),
            is_lead: *boxes == 100_000,
            ours: (!ours.is_cut).then(|| spread(ours)),
            peer: of("parry3d").map(spread),
            found: ours.note.clone(),
        })
    };
    distinct(&data.broad, |row| (row.scene.clone(), row.boxes)).iter().filter_map(of_case).collect()
}

fn frame_rows(data: &Data) -> Vec<Measured> {
    let of_scene = |scene: &String| {
        let of = |method: &str| {
            data.frame.iter().find(|row| row.scene == *scene && row.method == method && row.threads == 1)
        };
        let (ours, peer) = (of("asunder")?, of("parry3d"));
        let mut found = match peer {
            Some(peer) if peer.contacts != ours.contacts => {
                format!("{} contacts, parry3d {}", count(ours.contacts), count(peer.contacts))
            }
            _ => format!("{} contacts", count(ours.contacts)),
        };
        if !ours.note.is_empty() {
            found = format!("{found}; {}", ours.note);
        }
        let spread = |row: &crate::world::rows::FrameRow| Spread::new(row.ns, row.ns_low, row.ns_high);
        Some(Measured {
            group: scene.clone(),
            label: scene.clone(),
            name: scene.clone(),
            is_lead: true,
            ours: Some(spread(ours)),
            peer: peer.map(spread),
            found,
        })
    };
    distinct(&data.frame, |row| row.scene.clone()).iter().filter_map(of_scene).collect()
}

/// The narrow phase's sets and queries that are shown, for all families of shapes.
const SHOWN: [&str; 11] = [
    "mixed/boolean",
    "mixed/separation",
    "mixed/distance",
    "mixed/manifold",
    "rest/manifold",
    "rest/cached",
    "slide/cached",
    "tumble/cached",
    "far/boolean",
    "far/distance",
    "deep/separation",
];
/// The same for shapes in the plane.
const SHOWN_IN_PLANE: [&str; 2] = ["mixed/boolean", "mixed/manifold"];

/// Rows of a part of `compare`. The group is the first shape or both for pairs of shapes, the kind of measurement for
/// meshes, and the scene for queries to boxes.
fn kept_rows(data: &Data, part: &str) -> Vec<Measured> {
    let of_row = |row: &KeptRow| {
        let (first, rest) = row.row.split_once('/')?;
        let (group, label) = match part {
            "narrow" => {
                let in_plane = row.peer_ns.is_none();
                let shown: &[&str] = if in_plane { &SHOWN_IN_PLANE } else { &SHOWN };
                let group = shown.contains(&rest).then(|| format!("{rest}, {in_plane}"))?;
                (group, first.to_string())
            }
            "broad" => {
                let (scene, question) = rest.rsplit_once('/').filter(|_| first == "query")?;
                (question.to_string(), scene.to_string())
            }
            "shapes" => (rest.to_string(), first.to_string()),
            _ => (first.to_string(), rest.to_string()),
        };
        let prefix = match part {
            "mesh" => "mesh ",
            "shapes" => "shapes ",
            _ => "",
        };
        Some(Measured {
            group,
            label,
            name: format!("{prefix}{}", row.row),
            is_lead: false,
            ours: row.ours(),
            peer: row.peer(),
            found: row.found(),
        })
    };
    data.kept.iter().filter(|row| row.part == part).filter_map(of_row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::rows::FrameRow;

    fn kept(part: &str, row: &str, ours: f64, peer: f64) -> KeptRow {
        let (part, row) = (part.to_string(), row.to_string());
        KeptRow { part, row, ours_ns: Some(ours), peer_ns: Some(peer), ..KeptRow::default() }
    }

    #[test]
    fn rows_that_are_alike_share_a_line_and_no_ratio_is_lost() {
        let noisy = KeptRow {
            ours_low_ns: Some(1.0),
            ours_high_ns: Some(99.0),
            ..kept("narrow", "hull8/mixed/manifold", 50.0, 25.0)
        };
        let rows = vec![
            kept("narrow", "box/mixed/manifold", 200.0, 500.0),
            noisy,
            kept("narrow", "box/turned/separation", 1.0, 1.0),
            kept("shapes", "ball+ball/cast", 2.0, 4.0),
            kept("shapes", "ball+box/cast", 2.0, 1.0),
            kept("broad", "query/gas/100k/ray first", 2.0, 1.0),
            kept("broad", "gas/100k", 1.0, 2.0),
        ];
        let table = table(&Data { kept: rows, ..Data::default() });
        let text: Vec<String> = table.rows.iter().map(|row| row.join(" | ")).collect();
        assert_eq!(
            text,
            [
                "`box/mixed/manifold` | 200 ns | 500 ns | 2.50 | hull8 **0.50** ± | ",
                "`shapes ball+ball/cast` | 2.0 ns | 4.0 ns | 2.00 | ball+box **0.50** | ",
                "`query/gas/100k/ray first` | 2.0 ns | 1.0 ns | **0.50** |  | ",
            ]
        );
    }

    #[test]
    fn a_sweep_that_was_broken_off_has_no_ratio() {
        let row = |boxes, method: &str, is_cut| BroadRow {
            scene: "gas".to_string(),
            boxes,
            method: method.to_string(),
            threads: 1,
            clock: "thread".to_string(),
            ns: 100.0,
            is_cut,
            ..BroadRow::default()
        };
        let broad = vec![
            row(1000, "asunder", true),
            row(1000, "parry3d", false),
            row(100_000, "asunder", false),
            row(100_000, "parry3d", false),
        ];
        let table = table(&Data { broad, ..Data::default() });
        let line = table.rows[0].join(" | ");
        assert!(line.starts_with("`gas/100k` |") && line.ends_with("| 1k broken off | "), "{line}");
    }

    #[test]
    fn contacts_that_differ_are_told() {
        let frame = vec![FrameRow {
            scene: "pile".to_string(),
            method: "asunder".to_string(),
            threads: 1,
            note: "CONTACTS DIFFER in frame 3".to_string(),
            ..FrameRow::default()
        }];
        let table = table(&Data { frame, ..Data::default() });
        assert_eq!(table.rows[0][5], "0 contacts; CONTACTS DIFFER in frame 3");
    }
}
