//! Stacked bars, in groups, against a line that stands for the peer.

use super::Title;
use super::groups::{Group, height, rows, widest};
use super::scatter::dark;
use crate::report::palette::{GRID, INK, PALE};
use crate::report::sheet::{Hang, Sheet, TEXT, WIDTH, draw, width_of};
use plotters::style::RGBColor;

/// One bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its name, on the left.
    pub name: String,
    /// The colour of its name.
    pub color: RGBColor,
    /// The lengths of its parts, in the same order for every bar.
    pub parts: Vec<f64>,
    /// The quartiles of the whole.
    pub whisker: (f64, f64),
    /// The text at its end.
    pub label: String,
}

const TOP: f64 = 88.0;
const ROW: f64 = 17.0;
/// Longer bars are cut off here; the label has the value.
const LONGEST: f64 = 4.0;

/// Draws the groups. All lengths are relative to the line at 1, which the caption names. Parts have names and colours.
pub fn bars(title: &Title, caption: &str, parts: &[(&str, RGBColor)], groups: &[Group<Bar>]) -> String {
    let left = 20.0 + widest(groups, |bar| &bar.name);
    let label = 8.0 + widest(groups, |bar| &bar.label);
    let all = || groups.iter().flat_map(|group| &group.rows);
    let right = WIDTH - 18.0 - label;
    let longest = all().map(|bar| bar.parts.iter().sum::<f64>()).fold(1.0, f64::max).min(LONGEST);
    let at = |length: f64| left + (right - left) * (length / longest).min(1.0);
    let bottom = TOP + height(groups, ROW) + 4.0;
    draw(&title.question, bottom + 44.0, |sheet| {
        sheet.title(&title.lines());
        legend(sheet, parts);
        for quarter in 0..=(longest * 2.0) as usize {
            let place = at(0.5 * quarter as f64);
            let color = if quarter == 2 { PALE } else { GRID };
            sheet.line(&[(place, TOP), (place, bottom)], color, 1.0);
            if quarter % 2 == 0 {
                sheet.text(
                    &format!("{}", quarter / 2),
                    (place, bottom + 11.0),
                    Hang::Middle,
                    (INK, TEXT - 0.5),
                );
            }
        }
        rows(sheet, groups, (TOP, ROW), |sheet, bar, y| one(sheet, bar, parts, (y, left, &at)));
        sheet.text(caption, (0.5 * WIDTH, bottom + 30.0), Hang::Middle, (PALE, TEXT));
    })
}

fn one(
    sheet: &mut Sheet,
    bar: &Bar,
    parts: &[(&str, RGBColor)],
    (y, left, at): (f64, f64, &impl Fn(f64) -> f64),
) {
    let middle = y + 0.5 * ROW;
    sheet.text(&bar.name, (left - 6.0, middle), Hang::End, (dark(bar.color), TEXT));
    let mut sum = 0.0;
    for (length, (_, color)) in bar.parts.iter().zip(parts) {
        sheet.rect((at(sum), y + 2.0), (at(sum + length), y + ROW - 2.0), *color);
        sum += length;
    }
    let (low, high) = bar.whisker;
    sheet.line(&[(at(low), middle), (at(high), middle)], INK, 1.0);
    let cut = if sum > LONGEST { "» " } else { "" };
    sheet.text(
        &format!("{cut}{}", bar.label),
        (at(sum.max(high)) + 6.0, middle),
        Hang::Start,
        (INK, TEXT - 0.5),
    );
}

/// Two lines of names, each after a patch of its colour.
fn legend(sheet: &mut Sheet, parts: &[(&str, RGBColor)]) {
    let (mut x, mut y) = (10.0, 54.0);
    for (name, color) in parts {
        let width = 17.0 + width_of(name, TEXT) + 12.0;
        if x + width > WIDTH {
            (x, y) = (10.0, y + 17.0);
        }
        sheet.rect((x, y - 5.5), (x + 12.0, y + 5.5), *color);
        sheet.text(name, (x + 17.0, y), Hang::Start, (INK, TEXT));
        x += width;
    }
}
