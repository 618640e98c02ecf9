//! Rows in groups, each with a value and its range on one common axis, and with its name.

use super::Title;
use super::groups::{Group, height, rows, widest};
use super::scatter::dark;
use crate::report::axis::Axis;
use crate::report::names::number;
use crate::report::palette::{GRID, INK, Look, PALE};
use crate::report::sheet::{Hang, TEXT, WIDTH, draw};
use plotters::style::RGBColor;

/// How values are mapped to the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// By their logarithms, with zero in a band of its own.
    Logarithmic,
    /// From zero up.
    Linear,
}

/// One row of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// The look of its method.
    pub look: Look,
    /// The position of the mark.
    pub value: f64,
    /// The range of the thick line.
    pub inner: (f64, f64),
    /// The end of the thin line.
    pub end: f64,
    /// Whether the mark is hollow.
    pub is_noisy: bool,
}

const TOP: f64 = 50.0;
const ROW: f64 = 16.0;

/// Draws the groups, one below the other; next to a row are its value, and its end if that differs.
pub fn strips(title: &Title, caption: &str, scale: Scale, groups: &[Group<Strip>]) -> String {
    let all = || groups.iter().flat_map(|group| &group.rows);
    let left = 22.0 + widest(groups, |strip| &strip.look.name);
    let right = WIDTH - 22.0 - widest(groups, figures);
    let values: Vec<f64> = all().flat_map(|s| [s.value, s.inner.0, s.inner.1, s.end]).collect();
    let axis = match scale {
        Scale::Linear => Axis::linear(&values, (left, right)),
        Scale::Logarithmic if values.contains(&0.0) => Axis::new(&values, (left, right)).with_zero(40.0),
        Scale::Logarithmic => Axis::new(&values, (left, right)),
    };
    let bottom = TOP + height(groups, ROW) + 4.0;
    draw(&title.question, bottom + 48.0, |sheet| {
        sheet.title(&title.lines());
        if let Some((place, end)) = axis.zero() {
            sheet.rect((left, TOP), (end, bottom), RGBColor(236, 245, 236));
            sheet.text("0", (place, bottom + 12.0), Hang::Middle, (INK, TEXT - 0.5));
        }
        for value in axis.lines() {
            let place = axis.at(value);
            sheet.line(&[(place, TOP), (place, bottom)], GRID, 0.75);
        }
        for value in axis.ticks(5) {
            sheet.text(
                &number(value).replace(".0", "").replace("0.50", "0.5"),
                (axis.at(value), bottom + 12.0),
                Hang::Middle,
                (INK, TEXT - 0.5),
            );
        }
        rows(sheet, groups, (TOP, ROW), |sheet, strip, y| {
            let middle = y + 0.5 * ROW;
            let color = strip.look.color;
            sheet.text(&strip.look.name, (left - 6.0, middle), Hang::End, (dark(color), TEXT));
            sheet.line(&[(axis.at(strip.value), middle), (axis.at(strip.end), middle)], color, 0.75);
            sheet.line(&[(axis.at(strip.inner.0), middle), (axis.at(strip.inner.1), middle)], color, 2.5);
            sheet.mark((axis.at(strip.value), middle), strip.look.mark, (color, strip.is_noisy));
            sheet.text(&figures(strip), (right + 14.0, middle), Hang::Start, (INK, TEXT - 0.5));
        });
        sheet.text(caption, (0.5 * WIDTH, bottom + 33.0), Hang::Middle, (PALE, TEXT));
    })
}

fn figures(strip: &Strip) -> String {
    let (value, end) = (number(strip.value), number(strip.end));
    if value == end { value } else { format!("{value} … {end}") }
}
