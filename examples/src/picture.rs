//! Pictures of a world, as SVG.

pub mod mesh;
mod order;
pub mod plane;
pub mod volume;

use crate::output;
use asunder::glam::{DVec2, DVec3};
use core::fmt::Write;
use std::error::Error;
use std::path::Path;

/// Writes a picture and prints its path; makes the folder it goes to.
///
/// # Errors
/// Those of the file system, with the path.
pub fn save(file: &Path, picture: &str) -> Result<(), Box<dyn Error>> {
    output::write(file, picture)?;
    println!("picture        {}", file.display());
    Ok(())
}

/// Width of every picture in pixels.
const WIDTH: f64 = 1400.0;

/// Red, green, blue, each 0 to 1.
type Color = DVec3;

const SCENERY: Color = DVec3::new(0.72, 0.71, 0.68);
const WOOD: Color = DVec3::new(0.80, 0.60, 0.36);
const STONE: Color = DVec3::new(0.56, 0.60, 0.64);
const METAL: Color = DVec3::new(0.30, 0.52, 0.66);
const BALL: Color = DVec3::new(0.82, 0.36, 0.30);
const RUBBER: Color = DVec3::new(0.42, 0.62, 0.40);
const GOLD: Color = DVec3::new(0.98, 0.80, 0.25);
const INK: Color = DVec3::new(0.13, 0.12, 0.14);
const MARK: Color = DVec3::new(0.90, 0.13, 0.18);

/// How a line or an area is drawn.
#[derive(Clone, Copy)]
struct Pen {
    fill: Option<Color>,
    opacity: f64,
    stroke: Option<Color>,
    /// In pixels.
    width: f64,
}

impl Pen {
    fn fill(color: Color) -> Self {
        Self { fill: Some(color), opacity: 1.0, stroke: None, width: 0.0 }
    }

    fn line(color: Color, width: f64) -> Self {
        Self { fill: None, opacity: 1.0, stroke: Some(color), width }
    }

    fn edged(self, color: Color, width: f64) -> Self {
        Self { stroke: Some(color), width, ..self }
    }

    fn faint(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

/// An SVG being drawn. Points are in metres, y up; the picture shows the given rectangle of them.
struct Canvas {
    elements: String,
    low: DVec2,
    high: DVec2,
    pixels: f64,
    /// A factor for the widths of lines and the sizes of marks.
    fine: f64,
}

impl Canvas {
    /// A canvas around the given points, with a small border.
    fn around(points: impl Iterator<Item = DVec2>) -> Self {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        points.for_each(|point| (low, high) = (low.min(point), high.max(point)));
        if !low.cmple(high).all() {
            (low, high) = (DVec2::NEG_ONE, DVec2::ONE);
        }
        let air = (high - low).max_element().max(0.1) * 0.02;
        (low, high) = (low - air, high + air);
        // A scene that is taller than wide gets a picture as tall as others are wide.
        let pixels = WIDTH / (high - low).max_element();
        Self { elements: String::new(), low, high, pixels, fine: 1.0 }
    }

    /// Shows only the middle of a scene that is wider than `times` its height, as large as the picture allows.
    fn at_most_wide(mut self, times: f64) -> Self {
        let size = self.high - self.low;
        let cut = 0.5 * (size.x - times * size.y);
        if cut > 0.0 {
            (self.low.x, self.high.x) = (self.low.x + cut, self.high.x - cut);
            self.pixels = WIDTH / (self.high - self.low).max_element();
        }
        self
    }

    /// Thinner lines and smaller marks if bodies of the given size in metres are smaller than 30 pixels.
    fn fine_for(mut self, size: f64) -> Self {
        self.fine = (size * self.pixels / 30.0).clamp(0.1, 1.0);
        self
    }

    fn at(&self, point: DVec2) -> DVec2 {
        DVec2::new(point.x - self.low.x, self.high.y - point.y) * self.pixels
    }

    fn polygon(&mut self, points: &[DVec2], pen: Pen) {
        self.path(points, "Z", pen);
    }

    fn line(&mut self, from: DVec2, to: DVec2, pen: Pen) {
        self.path(&[from, to], "", pen);
    }

    fn path(&mut self, points: &[DVec2], end: &str, pen: Pen) {
        if (0..2).any(|axis| {
            points.iter().all(|point| point[axis] < self.low[axis])
                || points.iter().all(|point| point[axis] > self.high[axis])
        }) {
            return;
        }
        let pen = Pen { width: pen.width * self.fine, ..pen };
        self.elements.push_str("<path d=\"");
        for (i, &point) in points.iter().enumerate() {
            let DVec2 { x, y } = self.at(point);
            // Writing to a string cannot fail.
            let _ = write!(self.elements, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
        }
        let _ = writeln!(self.elements, "{end}\"{}/>", attributes(pen));
    }

    /// A round mark, its radius in pixels.
    fn dot(&mut self, center: DVec2, radius: f64, pen: Pen) {
        let DVec2 { x, y } = self.at(center);
        let radius = radius * self.fine;
        let _ = writeln!(
            self.elements,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"{}/>",
            attributes(pen)
        );
    }

    /// The text of the file, on a background that fades from one colour at the top to another at the bottom.
    fn finish(self, top: Color, bottom: Color) -> String {
        let size = (self.high - self.low) * self.pixels;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0}\" height=\"{1:.0}\" viewBox=\"0 0 {0:.0} {1:.0}\">\n\
             <defs><linearGradient id=\"back\" x2=\"0\" y2=\"1\"><stop stop-color=\"{2}\"/>\
             <stop offset=\"1\" stop-color=\"{3}\"/></linearGradient></defs>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"url(#back)\"/>\n\
             <g stroke-linejoin=\"round\" stroke-linecap=\"round\">\n{4}</g>\n</svg>\n",
            size.x,
            size.y,
            hex(top),
            hex(bottom),
            self.elements,
        )
    }
}

fn attributes(pen: Pen) -> String {
    let mut text = format!(" fill=\"{}\"", pen.fill.map_or("none".to_owned(), hex));
    if let Some(stroke) = pen.stroke {
        let _ = write!(text, " stroke=\"{}\" stroke-width=\"{:.1}\"", hex(stroke), pen.width);
    }
    if pen.opacity < 1.0 {
        let _ = write!(text, " opacity=\"{:.2}\"", pen.opacity);
    }
    text
}

fn hex(color: Color) -> String {
    let [r, g, b] = (color * 255.0).to_array().map(|c| c.clamp(0.0, 255.0) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The colour made a little lighter or darker by body number, so that neighbours stand apart.
fn varied(color: Color, number: usize) -> Color {
    let scrambled = (number as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
    let tone = scrambled as f64 / (1 << 24) as f64;
    color * (0.82 + 0.32 * tone) + DVec3::new(0.04, 0.0, -0.04) * (tone - 0.5)
}

fn middle(points: &[DVec2]) -> DVec2 {
    points.iter().sum::<DVec2>() / points.len().max(1) as f64
}
