//! README's part, between two marks, from saved data alone: four plots, one table of headlines with the rest folded
//! away, and the losses.

use super::data::{Data, Section};
use super::losses::of_kept;
use super::origin::Origin;
use super::sections::{Figure, chapters};
use super::summary;

/// The plots, by file name.
const PLOTS: [&str; 4] = ["error-3d-near-touching", "gap-3d-apart", "broad-gas", "frame-stages"];
/// Their folder, relative to the root.
pub const FOLDER: &str = "docs/figures";

/// The names of methods in the plots and in the losses.
const METHODS: &str = "In the plots and below, *asunder* is `Pair3::separation` and its like, *asunder 8 boxes* the same for eight pairs of boxes at \
    once (`separations3`), and *asunder guess* what the first tier of precision alone would say (`guess`), to show what the others are \
    for: no world uses it. *Textbook* is a plain separating axis test, *lean parry3d* a small world over parry3d's tree and \
    manifolds; both stand in `benches`.";

const BEGIN: &str = "<!-- figures:begin ";
const END: &str = "<!-- figures:end -->";

/// The folder of data that README names in its first mark.
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

/// README with the part between the marks replaced, and the folder of its data in the first mark. `None` unless there
/// are both marks, in order, each once.
pub fn spliced(page: &str, folder: &str, part: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    if after.contains(BEGIN) || after.contains(END) || before.contains(END) {
        return None;
    }
    Some(format!("{before}{BEGIN}{folder} -->\n{part}{END}{after}"))
}

/// The plots that README shows, in its order; plots without rows are left out.
pub fn figures(data: &Data) -> Vec<Figure> {
    let all: Vec<Figure> = chapters(data).into_iter().flat_map(|chapter| chapter.figures).collect();
    PLOTS.iter().filter_map(|file| all.iter().find(|figure| figure.file == *file).cloned()).collect()
}

/// README's part: plots, table, losses, and their origins.
pub fn part(data: &Data) -> String {
    let plots: String = figures(data)
        .iter()
        .map(|figure| {
            let Figure { file, question, .. } = figure;
            format!("<img src=\"{FOLDER}/{file}.svg\" alt=\"{question}\" width=\"410\">\n")
        })
        .collect();
    let [headlines, others] = summary::tables(data).map(|table| table.to_markdown());
    let folded = format!("<details><summary>All other rows</summary>\n\n{others}\n</details>\n");
    format!(
        "<p>\n{plots}</p>\n\n{headlines}\n{folded}\n{} {}{}\n\n{METHODS}\n\n{}",
        summary::READING,
        origins(data),
        super::kept::together(&data.kept),
        behind(data)
    )
}

/// Machines, versions and dates; only once if they are the same for all sections.
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

/// All losses, folded away by section.
fn behind(data: &Data) -> String {
    let chapters = chapters(data);
    let mut text = "**Where asunder is behind**, found in the same data:\n".to_string();
    let of_kept = [("Rows of compare", &of_kept(&data.kept)[..])];
    let all = chapters.iter().map(|chapter| (chapter.heading.as_str(), &chapter.losses[..])).chain(of_kept);
    for (heading, losses) in all.filter(|(_, losses)| !losses.is_empty()) {
        let items: String = losses.iter().map(|loss| format!("- {loss}\n")).collect();
        text.push_str(&format!("\n<details><summary>{heading}</summary>\n\n{items}\n</details>\n"));
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
