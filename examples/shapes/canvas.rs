//! An SVG being drawn.

use crate::tint::{Color, INK, LIGHT, PAPER, REACH, Tint, WHITE, hex};
use asunder::glam::DVec2;
use core::fmt::Write;
use std::collections::BTreeMap;

/// How an area or a line is painted.
#[derive(Clone)]
pub(crate) struct Paint {
    fill: String,
    fill_opacity: f64,
    stroke: Option<(String, f64)>,
    more: &'static str,
}

/// Which part of a text is at its point.
#[derive(Clone, Copy)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// An SVG being drawn. Points are in pixels, y down.
pub(crate) struct Canvas {
    /// The prefix of every id, since one page may hold several pictures.
    name: &'static str,
    size: DVec2,
    gradients: BTreeMap<String, String>,
    elements: String,
}

impl Paint {
    pub(crate) fn fill(color: Color) -> Self {
        Self::of(hex(color))
    }

    /// An area in one colour, with a thin line of the same colour around it, so that no paper shows between neighbours.
    pub(crate) fn solid(color: Color) -> Self {
        Self::of(hex(color)).edged(color, 0.6)
    }

    /// An area painted with a gradient, as is the line around it.
    pub(crate) fn gradient(id: &str) -> Self {
        let fill = format!("url(#{id})");
        Self { stroke: Some((fill.clone(), 0.6)), ..Self::of(fill) }
    }

    pub(crate) fn line(color: Color, width: f64) -> Self {
        Self::of("none".to_owned()).edged(color, width)
    }

    pub(crate) fn edged(self, color: Color, width: f64) -> Self {
        Self { stroke: Some((hex(color), width)), ..self }
    }

    pub(crate) fn unedged(self) -> Self {
        Self { stroke: None, ..self }
    }

    pub(crate) fn clear(self, fill_opacity: f64) -> Self {
        Self { fill_opacity, ..self }
    }

    pub(crate) fn dashed(self) -> Self {
        Self { more: " stroke-dasharray=\"3 2.5\"", ..self }
    }

    pub(crate) fn faint(self) -> Self {
        Self { more: " stroke-opacity=\".45\"", ..self }
    }

    fn of(fill: String) -> Self {
        Self { fill, fill_opacity: 1.0, stroke: None, more: "" }
    }

    fn attributes(&self) -> String {
        let mut text = String::new();
        if self.fill != "none" {
            let _ = write!(text, " fill=\"{}\"", self.fill);
        }
        if self.fill_opacity < 1.0 {
            let _ = write!(text, " fill-opacity=\"{}\"", short(self.fill_opacity, 2));
        }
        if let Some((stroke, width)) = &self.stroke {
            let _ = write!(text, " stroke=\"{stroke}\" stroke-width=\"{}\"", short(*width, 1));
        }
        text.push_str(self.more);
        text
    }
}

// Writing to a string cannot fail: the result of `write!` can be ignored.
impl Canvas {
    pub(crate) fn new(name: &'static str, size: DVec2) -> Self {
        Self { name, size, gradients: BTreeMap::new(), elements: String::new() }
    }

    pub(crate) fn path(&mut self, data: &str, paint: &Paint) {
        let _ = writeln!(self.elements, "<path d=\"{data}\"{}/>", paint.attributes());
    }

    pub(crate) fn polygon(&mut self, points: &[DVec2], paint: &Paint) {
        self.path(&(outline(points) + "Z"), paint);
    }

    pub(crate) fn line(&mut self, from: DVec2, to: DVec2, paint: &Paint) {
        self.path(&outline(&[from, to]), paint);
    }

    pub(crate) fn dot(&mut self, center: DVec2, radius: f64, paint: &Paint) {
        let (x, y, r) = (short(center.x, 1), short(center.y, 1), short(radius, 1));
        let _ = writeln!(self.elements, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{}/>", paint.attributes());
    }

    /// A card with round corners.
    pub(crate) fn card(&mut self, low: DVec2, size: DVec2, radius: f64, paint: &Paint) {
        let [x, y, w, h] = [low.x, low.y, size.x, size.y].map(|v| short(v, 1));
        let _ = writeln!(
            self.elements,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" rx=\"{radius}\"{}/>",
            paint.attributes()
        );
    }

    pub(crate) fn text(&mut self, at: DVec2, text: &str, style: (f64, Color, Anchor)) {
        let (size, color, anchor) = style;
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y) = (short(at.x, 1), short(at.y, 1));
        let _ = writeln!(
            self.elements,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" stroke=\"none\" fill=\"{}\">{text}</text>",
            hex(color)
        );
    }

    /// Everything drawn until [`Canvas::end`] is one group with this opacity.
    pub(crate) fn begin(&mut self, opacity: f64) {
        let _ = writeln!(self.elements, "<g opacity=\"{}\">", short(opacity, 2));
    }

    pub(crate) fn end(&mut self) {
        self.elements.push_str("</g>\n");
    }

    /// A patch of a ball about `center`, with an outline relative to that.
    pub(crate) fn ball(&mut self, center: DVec2, radius: f64, patch: Option<&[DVec2]>, tint: &Tint) {
        let key = format!("{}{}", tint.name, short(radius, 2).replace('.', "-"));
        let id = format!("{}-{key}", self.name);
        let (cx, cy) = (short(LIGHT.x * radius, 2), short(-LIGHT.y * radius, 2));
        self.gradients.entry(key).or_insert_with(|| {
            let stops = Tint::STOPS.into_iter().zip(tint.ramp);
            format!(
                "<radialGradient id=\"{id}\" gradientUnits=\"userSpaceOnUse\" cx=\"{cx}\" cy=\"{cy}\" r=\"{}\">{}</radialGradient>",
                short(REACH * radius, 2),
                stops.map(|(at, color)| stop(at, color, 1.0)).collect::<String>()
            )
        });
        let (x, y) = (short(center.x, 1), short(center.y, 1));
        let place = format!("transform=\"translate({x} {y})\"");
        let _ = match patch {
            None => {
                writeln!(self.elements, "<circle {place} r=\"{}\" fill=\"url(#{id})\"/>", short(radius, 1))
            }
            Some(patch) => writeln!(
                self.elements,
                "<path {place} d=\"{}Z\"{}/>",
                outline(patch),
                Paint::gradient(&id).attributes()
            ),
        };
    }

    /// A linear gradient between two points: (position from 0 to 1, colour, opacity) each. Returns its id.
    pub(crate) fn fade(&mut self, from: DVec2, to: DVec2, stops: &[(f64, Color, f64)]) -> String {
        let id = format!("{}-{}", self.name, self.gradients.len());
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(|v| short(v, 1));
        let stops: String = stops.iter().map(|&(at, color, opacity)| stop(at, color, opacity)).collect();
        let text = format!(
            "<linearGradient id=\"{id}\" gradientUnits=\"userSpaceOnUse\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\">{stops}</linearGradient>"
        );
        self.gradients.insert(id.clone(), text);
        id
    }

    /// The text of the file: without empty lines and with its first tag on a line of its own, so that Markdown leaves
    /// it alone.
    pub(crate) fn finish(self, label: &str) -> String {
        let gradients: String = self.gradients.into_values().map(|gradient| gradient + "\n").collect();
        let DVec2 { x, y } = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{x:.0}\" height=\"{y:.0}\" viewBox=\"0 0 {x:.0} {y:.0}\" role=\"img\" aria-label=\"{label}\">\n\
             <defs>\n{gradients}</defs>\n\
             <rect width=\"{x:.0}\" height=\"{y:.0}\" rx=\"12\" fill=\"{}\"/>\n\
             <g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" font-family=\"Helvetica, Arial, sans-serif\">\n{}</g>\n\
             </svg>\n",
            hex(PAPER),
            self.elements,
        )
    }

    /// An arrow from one point to another, with a light border so that it stands out against what lies below it.
    pub(crate) fn arrow(&mut self, from: DVec2, to: DVec2, color: Color) {
        let Some(along) = (to - from).try_normalize() else { return };
        let (neck, side) = (to - along * 6.5, along.perp() * 3.2);
        self.line(from, to - along * 4.0, &Paint::line(WHITE, 3.6));
        self.polygon(&[to, neck + side, neck - side], &Paint::fill(WHITE).edged(WHITE, 2.0));
        self.line(from, neck, &Paint::line(color, 1.8));
        self.polygon(&[to, neck + side, neck - side], &Paint::fill(color));
    }

    /// A mark for a contact point or vertex.
    pub(crate) fn point(&mut self, at: DVec2, radius: f64, color: Color) {
        self.dot(at, radius, &Paint::fill(color).edged(WHITE, 1.0));
    }

    /// A text in the usual ink, centred.
    pub(crate) fn caption(&mut self, at: DVec2, text: &str, size: f64) {
        self.text(at, text, (size, INK, Anchor::Middle));
    }
}

fn stop(at: f64, color: Color, opacity: f64) -> String {
    let clear =
        if opacity < 1.0 { format!(" stop-opacity=\"{}\"", short(opacity, 2)) } else { String::new() };
    format!("<stop offset=\"{}\" stop-color=\"{}\"{clear}/>", short(at, 3), hex(color))
}

/// The data of an open path through points.
fn outline(points: &[DVec2]) -> String {
    let mut data = String::new();
    for (i, point) in points.iter().enumerate() {
        let _ =
            write!(data, "{}{} {}", ["L", "M"][usize::from(i == 0)], short(point.x, 1), short(point.y, 1));
    }
    data
}

/// A number with at most so many digits after the point, without trailing zeros.
pub(crate) fn short(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
