//! README's part: four plots, one table, the losses, and kept rows of `compare`, between two marks, from saved data
//! alone.

use super::data::{Data, Section};
use super::losses::{best, distinct};
use super::names::{dimension, error, size, words};
use super::origin::Origin;
use super::sections::{Chapter, Figure, chapters};
use super::spread::is_wide;
use super::table::Table;

/// The plots, by their files.
const PLOTS: [&str; 4] = ["error-3d-near-touching", "gap-3d-apart", "broad-gas", "frame-stages"];
/// Where they lie, from the root.
pub const FOLDER: &str = "docs/figures";

const BEGIN: &str = "<!-- figures:begin ";
const END: &str = "<!-- figures:end -->";

/// The folder of data that a README names in its first mark.
///
/// ```
/// use asunder_benches::report::readme::data_of;
/// let page = "a\n<!-- figures:begin benches/results/some-cpu -->\nb\n<!-- figures:end -->\n";
/// assert_eq!(data_of(page), Some("benches/results/some-cpu"));
/// assert_eq!(data_of("nothing"), None);
/// ```
pub fn data_of(page: &str) -> Option<&str> {
    page.split_once(BEGIN)?.1.split_once(" -->").map(|(folder, _)| folder)
}

/// A README whose part between the marks is made anew, with the folder that it is made of. Nothing if there are no two
/// marks, in that order, each once.
pub fn spliced(page: &str, folder: &str, part: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    if after.contains(BEGIN) || after.contains(END) || before.contains(END) {
        return None;
    }
    Some(format!("{before}{BEGIN}{folder} -->\n{part}{END}{after}"))
}

/// The plots that README shows, in its order; those that the data has no rows for are left out.
pub fn figures(data: &Data) -> Vec<Figure> {
    let all: Vec<Figure> = chapters(data).into_iter().flat_map(|chapter| chapter.figures).collect();
    PLOTS.iter().filter_map(|file| all.iter().find(|figure| figure.file == *file).cloned()).collect()
}

/// README's part: plots, table, losses, and where they come from.
pub fn part(data: &Data) -> String {
    let plots: String = figures(data)
        .iter()
        .map(|figure| {
            let Figure { file, question, .. } = figure;
            format!("<img src=\"{FOLDER}/{file}.svg\" alt=\"{question}\" width=\"410\">\n")
        })
        .collect();
    let table = table(data).to_markdown();
    format!(
        "<p>\n{plots}</p>\n\n{table}\n± marks medians whose quartiles are more than 20 % apart. {}\n\n{}{}",
        origins(data),
        behind(&chapters(data)),
        super::kept::part(&data.kept)
    )
}

/// One table of both sides' times, and what they found.
fn table(data: &Data) -> Table {
    let mut table =
        Table::new("", &["row", "asunder", "parry3d", "ratio", "error of size, 99 %; or what both found"]);
    table.rows.extend(error_rows(data));
    table.rows.extend(vertex_rows(data));
    table.rows.extend(broad_rows(data));
    table.rows.extend(frame_rows(data));
    table
}

/// A time and its quartiles.
type Time = [f64; 3];

fn line(name: &str, ours: Time, peer: Option<Time>, found: String) -> Vec<String> {
    let text = |[ns, low, high]: Time| {
        let mark = if is_wide(ns, low, high) { " ±" } else { "" };
        format!("{}{mark}", super::names::duration(ns))
    };
    let ratio = peer.map_or("-".to_string(), |peer| format!("{:.2}", peer[0] / ours[0]));
    vec![format!("`{name}`"), text(ours), peer.map_or("-".to_string(), text), ratio, found]
}

fn error_rows(data: &Data) -> Vec<Vec<String>> {
    let groups = distinct(&data.error, |row| (row.dimension.clone(), row.group.clone()));
    let of_group = |(dim, group): &(String, String)| {
        let of = |method: &str| {
            data.error.iter().find(|row| row.dimension == *dim && row.group == *group && row.method == method)
        };
        let (ours, peer) = (of("certain")?, of("parry-f32"));
        let said = |row: &crate::error::ErrorRow| {
            let wrong = match row.wrong_per_100k {
                0.0 => String::new(),
                wrong => format!(", {} wrong in 100,000", super::names::count(libm::ceil(wrong) as u64)),
            };
            let refused = match row.refused {
                0 => String::new(),
                refused => format!(
                    ", {} of {} refused",
                    super::names::count(refused),
                    super::names::count(row.pairs)
                ),
            };
            format!("{}{wrong}{refused}", error(row.error_p99))
        };
        let against = peer.map_or(String::new(), |peer| format!(" against {}", said(peer)));
        let found = format!("{}{against}", said(ours));
        let peer = peer.map(|row| [row.ns, row.ns_low, row.ns_high]);
        let name = format!("{}, {}", dimension(dim), words(group));
        Some(line(&name, [ours.ns, ours.ns_low, ours.ns_high], peer, found))
    };
    groups.iter().filter_map(of_group).collect()
}

fn vertex_rows(data: &Data) -> Vec<Vec<String>> {
    let is_shown = |vertices: u32| [4, 16, 64, 256].contains(&vertices);
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
        let (ours, peer) = (of("certain").or_else(|| of("fast"))?, of("parry-f32"));
        let peer = peer.map(|row| [row.ns, row.ns_low, row.ns_high]);
        Some(line(
            &format!("hull{vertices}/{operation}"),
            [ours.ns, ours.ns_low, ours.ns_high],
            peer,
            String::new(),
        ))
    };
    kinds.iter().filter_map(of_kind).collect()
}

fn broad_rows(data: &Data) -> Vec<Vec<String>> {
    let cases = distinct(&data.broad, |row| (row.scene.clone(), row.boxes));
    let of_case = |(scene, boxes): &(String, u64)| {
        let of = |method| best(&data.broad, (scene, *boxes, method), "thread", 1);
        let (ours, peer) = (of("asunder")?, of("parry3d"));
        let found = if ours.note.is_empty() { "same pairs".to_string() } else { ours.note.clone() };
        let peer = peer.map(|row| [row.ns, row.ns_low, row.ns_high]);
        Some(line(&format!("{scene}/{}", size(*boxes)), [ours.ns, ours.ns_low, ours.ns_high], peer, found))
    };
    cases.iter().filter_map(of_case).collect()
}

fn frame_rows(data: &Data) -> Vec<Vec<String>> {
    let scenes = distinct(&data.frame, |row| row.scene.clone());
    let of_scene = |scene: &String| {
        let of = |method: &str| {
            data.frame.iter().find(|row| row.scene == *scene && row.method == method && row.threads == 1)
        };
        let (ours, peer) = (of("asunder")?, of("parry3d"));
        let count = super::names::count;
        let mut found = match peer {
            Some(peer) if peer.contacts != ours.contacts => {
                format!("{} contacts, parry3d {}", count(ours.contacts), count(peer.contacts))
            }
            _ => format!("{} contacts", count(ours.contacts)),
        };
        // Contacts that differ between numbers of threads must not go unseen.
        if ours.note.contains("DIFFER") {
            found = format!("{found}; {}", ours.note);
        }
        let peer = peer.map(|row| [row.ns, row.ns_low, row.ns_high]);
        Some(line(scene, [ours.ns, ours.ns_low, ours.ns_high], peer, found))
    };
    scenes.iter().filter_map(of_scene).collect()
}

/// Machines, versions and days: once, where all sections have the same.
fn origins(data: &Data) -> String {
    let said = |origin: &Origin| {
        let quick = if origin.command.contains("--quick") { "; a quick run" } else { "" };
        format!("{}; {}; {}{quick}", origin.machine(), origin.versions(), origin.date)
    };
    let mut all: Vec<(String, Vec<&str>)> = Vec::new();
    for origin in &data.origins {
        match all.iter_mut().find(|(text, _)| *text == said(origin)) {
            Some((_, sections)) => sections.push(&origin.section),
            None => all.push((said(origin), vec![&origin.section])),
        }
    }
    let one = all.len() == 1;
    let parts: Vec<String> = all
        .into_iter()
        .map(|(text, sections)| if one { text } else { format!("{}: {text}", sections.join(", ")) })
        .collect();
    format!("{}.", parts.join(". "))
}

/// All losses, folded away section by section under how many there are.
fn behind(chapters: &[Chapter]) -> String {
    let total: usize = chapters.iter().map(|chapter| chapter.losses.len()).sum();
    let mut text = format!("**Where asunder is behind**, found in the same data, in {total} sentences.\n");
    for chapter in chapters.iter().filter(|chapter| !chapter.losses.is_empty()) {
        let items: String = chapter.losses.iter().map(|loss| format!("- {loss}\n")).collect();
        text.push_str(&format!(
            "\n<details><summary>{}: {}</summary>\n\n{items}\n</details>\n",
            chapter.heading,
            chapter.losses.len()
        ));
    }
    let without: Vec<&str> = Section::ALL
        .into_iter()
        .filter_map(|section| chapters.iter().find(|chapter| chapter.section == section))
        .filter(|chapter| chapter.losses.is_empty())
        .map(|chapter| chapter.heading.as_str())
        .collect();
    if !without.is_empty() {
        text.push_str(&format!("\nNowhere in: {}.\n", without.join(", ").to_lowercase()));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "head\n<!-- figures:begin old/folder -->\nold\nthings\n<!-- figures:end -->\ntail\n";

    #[test]
    fn only_what_lies_between_the_marks_is_replaced() {
        let new = spliced(PAGE, "new/folder", "new\n").unwrap();
        assert_eq!(new, "head\n<!-- figures:begin new/folder -->\nnew\n<!-- figures:end -->\ntail\n");
        assert_eq!(spliced(&new, "new/folder", "new\n"), Some(new.clone()), "again changes nothing");
        assert_eq!(data_of(&new), Some("new/folder"));
    }

    #[test]
    fn a_page_without_two_marks_in_order_is_left_alone() {
        let begin = "<!-- figures:begin x -->";
        for page in
            ["", "no marks", begin, END, &format!("{END}\n{begin}\n{END}"), &format!("{begin}{END}{END}")]
        {
            assert_eq!(spliced(page, "x", "new"), None, "{page:?}");
        }
    }
}
