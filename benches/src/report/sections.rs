//! The sections of the page: from rows to plots, tables and sentences.

mod broad;
mod error;
mod frame;
mod gap;
mod stability;
mod vertices;

use super::data::{Data, Section};
use super::origin::Origin;
use super::table::Table;

/// A plot of a section.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its file name, without extension.
    pub file: String,
    /// The question it answers.
    pub question: String,
    /// The SVG.
    pub svg: String,
}

/// One section, ready to be laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct Chapter {
    /// The section.
    pub section: Section,
    /// Its heading.
    pub heading: String,
    /// How its figures are to be read, and how they were measured.
    pub method: String,
    /// Its plots.
    pub figures: Vec<Figure>,
    /// Findings from the data, other than losses.
    pub findings: Vec<String>,
    /// Where other methods are ahead.
    pub losses: Vec<String>,
    /// Its tables.
    pub tables: Vec<Table>,
    /// The origin of its data.
    pub origin: Option<Origin>,
}

/// A chapter without the fields that are known from its section.
#[derive(Default)]
struct Draft {
    heading: &'static str,
    method: &'static str,
    figures: Vec<Figure>,
    findings: Vec<String>,
    losses: Vec<String>,
    tables: Vec<Table>,
}

/// All sections that have rows, in the order of the page.
pub fn chapters(data: &Data) -> Vec<Chapter> {
    let drafts = Section::ALL.into_iter().map(|section| {
        let draft = match section {
            Section::Error => error::draft(&data.error),
            Section::Gap => gap::draft(&data.gap),
            Section::Stability => stability::draft(&data.stability),
            Section::Broad => broad::draft(&data.broad, &data.frame),
            Section::Frame => frame::draft(&data.frame),
            Section::Vertices => vertices::draft(&data.vertices),
        };
        (section, draft)
    });
    let drawn = drafts.filter(|(_, draft)| !draft.figures.is_empty());
    drawn
        .map(|(section, draft)| {
            let Draft { heading, method, figures, findings, losses, tables } = draft;
            let origin = data.origin(section).cloned();
            let (heading, method) = (heading.to_string(), method.to_string());
            Chapter { section, heading, method, figures, findings, losses, tables, origin }
        })
        .collect()
}

/// A time in a table: the median, with a mark where the noise is wide.
fn marked(median: f64, low: f64, high: f64) -> String {
    let time = super::names::duration(median);
    if super::spread::is_wide(median, low, high) { format!("{time} ±") } else { time }
}

/// The rows' notes, each once, after the name of what they are about.
fn remarks<'a>(notes: impl Iterator<Item = (String, &'a str)>) -> Vec<String> {
    let said: Vec<String> =
        notes.filter(|(_, note)| !note.is_empty()).map(|(of, note)| format!("{of}: {note}.")).collect();
    super::losses::distinct(&said, String::clone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_rows_make_no_chapters() {
        assert!(chapters(&Data::default()).is_empty());
    }

    #[test]
    fn what_rows_say_of_themselves_is_told_once() {
        let said = [("a", "DIFFER"), ("a", "DIFFER"), ("b", ""), ("c", "DIFFER")];
        let said = remarks(said.into_iter().map(|(of, note)| (of.to_string(), note)));
        assert_eq!(said, ["a: DIFFER.", "c: DIFFER."]);
    }

    #[test]
    fn contacts_that_differ_are_told_on_the_page() {
        let frame = |threads, note: &str| crate::world::rows::FrameRow {
            scene: "pile".to_string(),
            method: "asunder".to_string(),
            threads,
            ns: 1.0,
            note: note.to_string(),
            ..Default::default()
        };
        let frames = vec![frame(1, "CONTACTS DIFFER in frame 3"), frame(2, "CONTACTS DIFFER in frame 3")];
        let page = |frame| crate::report::page::to_html(&chapters(&Data { frame, ..Data::default() }));
        assert!(page(frames).contains("<li>pile: CONTACTS DIFFER in frame 3.</li>"));
        assert!(!page(vec![frame(1, "")]).contains("DIFFER"));
    }

    #[test]
    fn a_noisy_time_is_marked() {
        assert_eq!(marked(100.0, 90.0, 109.0), "100 ns");
        assert_eq!(marked(100.0, 90.0, 111.0), "100 ns ±");
    }
}
