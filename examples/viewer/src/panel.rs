//! Text on the screen.

use crate::toggles::{Layer, Toggles};
use macroquad::color::Color;
use macroquad::shapes::draw_rectangle;
use macroquad::text::{TextDimensions, draw_text, measure_text};
use macroquad::window::{screen_height, screen_width};

const SIZE: f32 = 19.0;
const LINE: f32 = 18.0;
const EDGE: f32 = 8.0;
const INK: Color = Color::new(0.13, 0.12, 0.14, 1.0);
const FAINT: Color = Color::new(0.13, 0.12, 0.14, 0.42);
const PAPER: Color = Color::new(1.0, 1.0, 1.0, 0.72);

const KEYS: [&str; 5] = [
    "space pause   . step   R restart",
    "N next scene   B scene before",
    "left drag: throw a body, or look around",
    "right drag: move aside   wheel: zoom",
    "F whole scene   Esc leave",
];

/// Draws figures at the upper left and keys at the lower left; layers that are on have full ink.
pub(crate) fn draw(title: &str, report: &[String], toggles: &Toggles) {
    let lines = || std::iter::once(title).chain(report.iter().map(String::as_str));
    paper(EDGE, lines());
    for (i, line) in lines().enumerate() {
        draw_text(line, 2.0 * EDGE, 2.0 * EDGE + LINE * (i as f32 + 0.6), SIZE, INK);
    }
    let layers = Layer::ALL.map(|(layer, _, name)| (name, toggles.shows(layer)));
    let count = KEYS.len() + layers.len().div_ceil(3);
    let top = screen_height() - EDGE * 3.0 - LINE * count as f32;
    paper(top, KEYS.into_iter().chain(std::iter::repeat_n("", count - KEYS.len())));
    let at = |row: usize| top + EDGE + LINE * (row as f32 + 0.6);
    for (row, line) in KEYS.iter().enumerate() {
        draw_text(line, 2.0 * EDGE, at(row), SIZE, INK);
    }
    for (i, (name, is_on)) in layers.into_iter().enumerate() {
        let column = 2.0 * EDGE + 112.0 * (i % 3) as f32;
        draw_text(name, column, at(KEYS.len() + i / 3), SIZE, if is_on { INK } else { FAINT });
    }
}

/// Draws one line in the middle of the upper edge.
pub(crate) fn note(text: &str) {
    let width = measure_text(text, None, SIZE as u16, 1.0).width;
    let left = 0.5 * (screen_width() - width);
    draw_rectangle(left - EDGE, EDGE, width + 2.0 * EDGE, LINE + 1.5 * EDGE, PAPER);
    draw_text(text, left, 2.0 * EDGE + 0.6 * LINE, SIZE, INK);
}

/// Draws a sheet behind lines of text.
fn paper<'a>(top: f32, lines: impl Iterator<Item = &'a str>) {
    let (mut widest, mut count) = (300.0_f32, 0);
    for line in lines {
        let TextDimensions { width, .. } = measure_text(line, None, SIZE as u16, 1.0);
        (widest, count) = (widest.max(width), count + 1);
    }
    draw_rectangle(EDGE, top, widest + 2.0 * EDGE, LINE * count as f32 + 1.5 * EDGE, PAPER);
}
