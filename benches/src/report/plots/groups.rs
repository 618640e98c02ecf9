//! Rows under headings, one below the other.

use crate::report::palette::INK;
use crate::report::sheet::{Hang, Sheet, TEXT, width_of};

/// Rows under one heading.
#[derive(Clone, Debug, PartialEq)]
pub struct Group<R> {
    /// The heading.
    pub name: String,
    /// Its rows.
    pub rows: Vec<R>,
}

/// The height of a heading.
const HEADING: f64 = 19.0;

/// The width of the widest text, one text per row.
pub(super) fn widest<'a, R, T: AsRef<str>>(groups: &'a [Group<R>], text: impl Fn(&'a R) -> T) -> f64 {
    let rows = groups.iter().flat_map(|group| &group.rows);
    rows.map(|row| width_of(text(row).as_ref(), TEXT)).fold(0.0, f64::max)
}

/// The height of all groups, with rows of the given height.
pub(super) fn height<R>(groups: &[Group<R>], row: f64) -> f64 {
    groups.iter().map(|group| HEADING + row * group.rows.len() as f64).sum()
}

/// Draws headings from a height down, and calls `draw` for every row with its upper edge.
pub(super) fn rows<R>(
    sheet: &mut Sheet,
    groups: &[Group<R>],
    (top, height): (f64, f64),
    mut draw: impl FnMut(&mut Sheet, &R, f64),
) {
    let mut y = top;
    for group in groups {
        sheet.bold(&group.name, (10.0, y + 0.5 * HEADING + 1.0), Hang::Start, (INK, TEXT));
        y += HEADING;
        for row in &group.rows {
            draw(sheet, row, y);
            y += height;
        }
    }
}
