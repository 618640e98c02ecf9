//! The page as one HTML file that needs no others.

use super::sections::Chapter;
use super::table::escaped;

/// Narrow screens get one plot per row, wide ones as many as fit; tables scroll on their own.
const STYLE: &str = "
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 1360px; padding: 0 12px 48px; background: #fff; color: #1a1a1a;
  font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.7em; line-height: 1.2; margin: 24px 0 8px; }
h2 { font-size: 1.35em; margin: 48px 0 8px; padding-top: 12px; border-top: 1px solid #ddd; }
h3 { font-size: 1em; margin: 20px 0 4px; }
p, ul { max-width: 78ch; margin: 8px 0; }
nav a { margin-right: 14px; white-space: nowrap; }
a { color: #005a8e; }
code { font-size: .9em; overflow-wrap: anywhere; }
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 400px), 1fr)); gap: 18px; margin: 16px 0; }
figure { margin: 0; }
figure svg { display: block; width: 100%; height: auto; max-width: 560px; }
.origin { color: #5a5a5a; font-size: .85em; max-width: none; }
.losses { border-left: 4px solid #d55e00; padding: 2px 14px; margin: 16px 0; }
.losses h3, .findings h3 { margin-top: 6px; }
details { margin: 12px 0; }
summary { cursor: pointer; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .82em; font-variant-numeric: tabular-nums; }
th, td { padding: 3px 9px; text-align: right; white-space: nowrap; border-bottom: 1px solid #e6e6e6; }
th:first-child, td:first-child { text-align: left; }
tbody tr:hover { background: #f6f6f6; }
";

/// The page of all chapters.
///
/// ```
/// use asunder_benches::report::page::to_html;
/// assert!(to_html(&[]).starts_with("<!doctype html>"));
/// ```
pub fn to_html(chapters: &[Chapter]) -> String {
    let links: String = chapters
        .iter()
        .map(|one| format!("<a href=\"#{}\">{}</a>\n", one.section.name(), escaped(&one.heading)))
        .collect();
    let body: String = chapters.iter().map(chapter).collect();
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>asunder: speed against error</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <h1>asunder: speed against error</h1>\n<p>{}</p>\n<nav>\n{links}</nav>\n{body}</body>\n</html>\n",
        escaped(INTRODUCTION)
    )
}

/// What applies to all sections.
pub(super) const INTRODUCTION: &str = "Every figure is measured by the command that stands with its section, on the \
    machine named there. Times are medians; whiskers are quartiles. A hollow mark, or ± in a table, means that the \
    quartiles are more than 20 % of the median apart: do not lean on it. Colours mean the same method everywhere.";

fn chapter(chapter: &Chapter) -> String {
    let figures: String =
        chapter.figures.iter().map(|figure| format!("<figure>\n{}</figure>\n", figure.svg)).collect();
    let tables: String = chapter
        .tables
        .iter()
        .map(|table| {
            let name = escaped(&table.name);
            format!(
                "<details>\n<summary>{name}</summary>\n<div class=\"scroll\">\n{}</div>\n</details>\n",
                table.to_html()
            )
        })
        .collect();
    let origin = chapter.origin.as_ref().map_or(String::new(), |origin| {
        let [command, machine, versions] =
            [&origin.command, &origin.machine(), &origin.versions()].map(|text| escaped(text));
        format!("<p class=\"origin\"><code>{command}</code><br>{machine}; {versions}; {}</p>\n", origin.date)
    });
    format!(
        "<section id=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n{}<div class=\"plots\">\n{figures}</div>\n{}{tables}{origin}</section>\n",
        chapter.section.name(),
        escaped(&chapter.heading),
        escaped(&chapter.method),
        list("findings", "What the data says", &chapter.findings),
        list("losses", "Where asunder is behind", losses(chapter)),
    )
}

/// The sentences on losses; there is always at least one.
pub(super) fn losses(chapter: &Chapter) -> &[String] {
    static NOWHERE: std::sync::LazyLock<[String; 1]> =
        std::sync::LazyLock::new(|| ["Nowhere in this data.".to_string()]);
    if chapter.losses.is_empty() { &*NOWHERE } else { &chapter.losses }
}

fn list(class: &str, heading: &str, sentences: &[String]) -> String {
    if sentences.is_empty() {
        return String::new();
    }
    let items: String = sentences.iter().map(|text| format!("<li>{}</li>\n", escaped(text))).collect();
    format!("<div class=\"{class}\">\n<h3>{heading}</h3>\n<ul>\n{items}</ul>\n</div>\n")
}
