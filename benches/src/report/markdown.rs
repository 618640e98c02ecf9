//! The same page as Markdown, with SVG files next to it.

use super::page::{INTRODUCTION, losses};
use super::sections::Chapter;

/// The page of all chapters; its pictures are files next to it.
///
/// ```
/// assert!(asunder_benches::report::markdown::to_markdown(&[]).starts_with("# "));
/// ```
pub fn to_markdown(chapters: &[Chapter]) -> String {
    let body: String = chapters.iter().map(chapter).collect();
    format!("# asunder: speed against error\n\n{INTRODUCTION}\n{body}")
}

fn chapter(chapter: &Chapter) -> String {
    let figures: String = chapter
        .figures
        .iter()
        .map(|figure| format!("![{}]({}.svg)\n", figure.question, figure.file))
        .collect();
    let tables: String = chapter
        .tables
        .iter()
        .map(|table| format!("\n### {}\n\n{}", table.name, table.to_markdown()))
        .collect();
    let origin = chapter.origin.as_ref().map_or(String::new(), |origin| {
        format!("\n`{}`: {}; {}; {}\n", origin.command, origin.machine(), origin.versions(), origin.date)
    });
    let findings = list("What the data says", &chapter.findings);
    let losses = list("Where asunder is behind", losses(chapter));
    format!("\n## {}\n\n{}\n{findings}\n{figures}{losses}{tables}{origin}", chapter.heading, chapter.method)
}

fn list(heading: &str, sentences: &[String]) -> String {
    if sentences.is_empty() {
        return String::new();
    }
    let items: String = sentences.iter().map(|text| format!("- {text}\n")).collect();
    format!("\n### {heading}\n\n{items}")
}
