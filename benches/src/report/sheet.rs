//! A sheet to draw on: plotters' SVG backend, in units of which a plot is 440 wide, with a resolution of a quarter
//! unit.

use super::palette::{Mark, PALE};
use plotters::prelude::{DrawingBackend, IntoTextStyle, RGBColor, SVGBackend, ShapeStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle};

/// The width of every plot.
pub const WIDTH: f64 = 440.0;
/// The font size of most labels.
pub const TEXT: f64 = 12.5;
/// The font size of a title.
pub const TITLE: f64 = 15.0;

/// Steps per unit, since the backend draws on whole numbers.
const FINE: f64 = 4.0;
/// The backend divides font sizes by this when it writes them.
const LETTERS: f64 = 1.24;
/// The average width of a letter over its size, in a sans-serif font, and a little more.
const LETTER_WIDTH: f64 = 0.54;

/// How a text is aligned to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hang {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// Draws a plot and returns its SVG, `height` units high. Equal drawings give equal bytes.
///
/// ```
/// use asunder_benches::report::sheet::draw;
/// let svg = draw("A question?", 100.0, |sheet| sheet.title(&["A question?"]));
/// assert!(svg.starts_with("<svg width=\"440\" height=\"100\" viewBox=\"0 0 1760 400\""));
/// assert!(svg.contains("A question?"));
/// ```
pub fn draw(name: &str, height: f64, plot: impl FnOnce(&mut Sheet)) -> String {
    let (width, height) = ((WIDTH * FINE) as u32, (height * FINE) as u32);
    let mut svg = String::new();
    let mut sheet = Sheet { backend: SVGBackend::with_string(&mut svg, (width, height)) };
    sheet.rect((0.0, 0.0), (WIDTH, f64::from(height) / FINE), RGBColor(255, 255, 255));
    plot(&mut sheet);
    drop(sheet);
    let fine = format!("<svg width=\"{width}\" height=\"{height}\"");
    let label = name.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
    let head = format!("<svg width=\"{WIDTH}\" height=\"{}\"", f64::from(height) / FINE);
    let spoken = format!("xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{label}\"");
    svg.replacen(&fine, &head, 1).replacen("xmlns=\"http://www.w3.org/2000/svg\"", &spoken, 1)
}

/// The approximate width of a text in this font size: no font is available.
///
/// ```
/// use asunder_benches::report::sheet::width_of;
/// assert_eq!(width_of("abcd", 10.0), 2.0 * width_of("ab", 10.0));
/// ```
pub fn width_of(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * LETTER_WIDTH
}

/// A sheet. Drawing on it cannot fail, since it is a string.
pub struct Sheet<'a> {
    backend: SVGBackend<'a>,
}

fn fine((x, y): (f64, f64)) -> (i32, i32) {
    (libm::round(x * FINE) as i32, libm::round(y * FINE) as i32)
}

fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle {
        color: color.to_rgba(),
        filled: false,
        stroke_width: libm::round(width * FINE).max(1.0) as u32,
    }
}

impl Sheet<'_> {
    /// A line through places.
    pub fn line(&mut self, places: &[(f64, f64)], color: RGBColor, width: f64) {
        let _ = self.backend.draw_path(places.iter().map(|&place| fine(place)), &stroke(color, width));
    }

    /// A dashed line from place to place.
    pub fn dashes(&mut self, places: &[(f64, f64)], color: RGBColor, width: f64) {
        const DASH: f64 = 5.0;
        for ends in places.windows(2) {
            let [(x0, y0), (x1, y1)] = [ends[0], ends[1]];
            let length = libm::sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0));
            let count = (length / DASH) as usize;
            let at = |i: usize| {
                let part = (i as f64 * DASH / length).min(1.0);
                (x0 + part * (x1 - x0), y0 + part * (y1 - y0))
            };
            (0..=count).step_by(2).for_each(|i| self.line(&[at(i), at(i + 1)], color, width));
        }
    }

    /// A filled rectangle between two corners.
    pub fn rect(&mut self, from: (f64, f64), to: (f64, f64), color: RGBColor) {
        let _ = self.backend.draw_rect(fine(from), fine(to), &color, true);
    }

    /// A point with some mark; hollow where its noise is wide.
    pub fn mark(&mut self, place: (f64, f64), mark: Mark, (color, hollow): (RGBColor, bool)) {
        let (x, y) = place;
        let inner = if hollow { RGBColor(255, 255, 255) } else { color };
        let outline = stroke(color, 1.75);
        match mark {
            Mark::Disc => {
                let _ = self.backend.draw_circle(fine(place), (4.5 * FINE) as u32, &inner, true);
                let _ = self.backend.draw_circle(fine(place), (4.5 * FINE) as u32, &outline, false);
            }
            Mark::Square | Mark::Triangle => {
                let square = [(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0)];
                let triangle = [(0.0, -5.0), (5.0, 4.0), (-5.0, 4.0)];
                let corners = if mark == Mark::Square { &square[..] } else { &triangle[..] };
                let mut path: Vec<(f64, f64)> = corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
                let _ = self.backend.fill_polygon(path.iter().map(|&place| fine(place)), &inner);
                path.push(path[0]);
                self.line(&path, color, 1.75);
            }
        }
    }

    /// A text, vertically centred on its place.
    pub fn text(&mut self, text: &str, place: (f64, f64), hang: Hang, (color, size): (RGBColor, f64)) {
        self.letters(text, place, hang, (color, size), FontStyle::Normal);
    }

    /// The same in bold.
    pub fn bold(&mut self, text: &str, place: (f64, f64), hang: Hang, (color, size): (RGBColor, f64)) {
        self.letters(text, place, hang, (color, size), FontStyle::Bold);
    }

    /// The title: a question in bold, and below it, paler, how to read the plot.
    pub fn title(&mut self, lines: &[&str]) {
        for (i, line) in lines.iter().enumerate() {
            let place = (10.0, 16.0 + 18.0 * i as f64);
            if i == 0 {
                self.bold(line, place, Hang::Start, (super::palette::INK, TITLE));
            } else {
                self.text(line, place, Hang::Start, (PALE, TEXT));
            }
        }
    }

    fn letters(
        &mut self,
        text: &str,
        place: (f64, f64),
        hang: Hang,
        (color, size): (RGBColor, f64),
        style: FontStyle,
    ) {
        let across = match hang {
            Hang::Start => HPos::Left,
            Hang::Middle => HPos::Center,
            Hang::End => HPos::Right,
        };
        let font = ("sans-serif", size * FINE * LETTERS, style);
        let style = font.into_text_style(&(0, 0)).pos(Pos::new(across, VPos::Center)).color(&color);
        let _ = self.backend.draw_text(text, &style, fine(place));
    }
}
