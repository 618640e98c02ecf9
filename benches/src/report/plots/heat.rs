//! A field of cells, one row per method: the darker, the more.

use super::Title;
use super::scatter::dark;
use crate::report::names::short;
use crate::report::palette::{INK, Look, PALE};
use crate::report::sheet::{Hang, TEXT, WIDTH, draw, width_of};
use plotters::style::RGBColor;

/// One row: for every column a share from 0 to 1, if there is one.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The look of its method.
    pub look: Look,
    /// Shares; `None` where there were no cases.
    pub shares: Vec<Option<f64>>,
}

const TOP: f64 = 58.0;
const ROW: f64 = 27.0;

/// Draws the field, with column names above and a caption of the columns below.
pub fn heat(title: &Title, caption: &str, columns: &[String], rows: &[Row]) -> String {
    let left = 14.0 + rows.iter().map(|row| width_of(&row.look.name, TEXT)).fold(0.0, f64::max);
    let bottom = TOP + ROW * rows.len() as f64;
    let cell = (WIDTH - 8.0 - left) / columns.len().max(1) as f64;
    let small = (cell * 0.58).min(TEXT - 1.0);
    draw(&title.question, bottom + 46.0, |sheet| {
        sheet.title(&title.lines());
        for (i, row) in rows.iter().enumerate() {
            let (top, middle) = (TOP + ROW * i as f64, TOP + ROW * (i as f64 + 0.5));
            sheet.text(&row.look.name, (left - 5.0, middle), Hang::End, (dark(row.look.color), TEXT));
            for (k, share) in row.shares.iter().enumerate() {
                let from = left + cell * k as f64;
                let Some(share) = *share else { continue };
                sheet.rect((from + 0.5, top + 0.5), (from + cell - 0.5, top + ROW - 0.5), shade(share));
                let color = if share > 0.09 { RGBColor(255, 255, 255) } else { INK };
                sheet.text(&percent(share), (from + 0.5 * cell, middle), Hang::Middle, (color, small));
            }
        }
        for (k, name) in columns.iter().enumerate() {
            let middle = left + cell * (k as f64 + 0.5);
            sheet.text(name, (middle, bottom + 11.0), Hang::Middle, (INK, small));
        }
        sheet.text(caption, (0.5 * (left + WIDTH), bottom + 31.0), Hang::Middle, (PALE, TEXT));
    })
}

/// A percentage in as few characters as possible: only an exact zero is shown as 0.
fn percent(share: f64) -> String {
    match share * 100.0 {
        0.0 => "0".to_string(),
        less if less < 0.1 => "<.1".to_string(),
        less if less < 0.95 => format!("{less:.1}").trim_start_matches('0').to_string(),
        more if more < 9.95 => short(more).trim_end_matches(".0").to_string(),
        more => format!("{more:.0}"),
    }
}

/// Greenish white for zero; above it, from pale to dark by the logarithm of the share.
fn shade(share: f64) -> RGBColor {
    if share == 0.0 {
        return RGBColor(230, 242, 230);
    }
    let part = (1.0 + libm::log10(share.clamp(1e-4, 1.0)) / 4.0).clamp(0.0, 1.0);
    // Squared, so that most of the range is left for the shares that matter, and text stays legible on the others.
    let part = part * part;
    let [pale, deep] = [[254.0, 228.0, 190.0], [140.0, 20.0, 0.0]];
    let mix = |i: usize| (pale[i] + part * (deep[i] - pale[i])) as u8;
    RGBColor(mix(0), mix(1), mix(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_wrong_in_a_million_is_neither_none_nor_looks_like_it() {
        assert_eq!(
            [0.0, 1e-6, 0.005, 0.031, 0.02, 0.5, 1.0].map(percent),
            ["0", "<.1", ".5", "3.1", "2", "50", "100"]
        );
        assert_ne!(shade(1e-6), shade(0.0));
    }
}
