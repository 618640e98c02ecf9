//! Tables, for HTML and for Markdown.

/// A table; the first column is text, the others are figures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What it lists.
    pub name: String,
    /// The headings of its columns.
    pub head: Vec<String>,
    /// Its rows.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new(name: &str, head: &[&str]) -> Self {
        Self {
            name: name.to_string(),
            head: head.iter().map(|text| (*text).to_string()).collect(),
            rows: Vec::new(),
        }
    }

    /// As Markdown.
    ///
    /// ```
    /// use asunder_benches::report::table::Table;
    /// let mut table = Table::new("times", &["row", "ns"]);
    /// table.rows.push(vec!["a|b".to_string(), "1".to_string()]);
    /// assert_eq!(table.to_markdown(), "| row | ns |\n|---|---|\n| a\\|b | 1 |\n");
    /// ```
    pub fn to_markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = format!("|{}\n", "---|".repeat(self.head.len()));
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        format!("{}{rule}{rows}", line(&self.head))
    }

    /// As HTML.
    ///
    /// ```
    /// use asunder_benches::report::table::Table;
    /// let mut table = Table::new("times", &["row"]);
    /// table.rows.push(vec!["a < b".to_string()]);
    /// assert!(table.to_html().contains("<td>a &lt; b</td>"));
    /// ```
    pub fn to_html(&self) -> String {
        let line = |tag: &str, cells: &[String]| {
            let cells: String =
                cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
            format!("<tr>{cells}</tr>\n")
        };
        let rows: String = self.rows.iter().map(|row| line("td", row)).collect();
        format!("<table>\n<thead>{}</thead>\n<tbody>\n{rows}</tbody>\n</table>\n", line("th", &self.head))
    }
}

/// Text escaped for HTML.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
