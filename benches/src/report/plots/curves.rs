//! Curves over sizes, with both axes logarithmic, and each curve's name at its end.

use super::Title;
use super::labels::apart;
use super::scatter::dark;
use crate::clock::Spread;
use crate::report::axis::Axis;
use crate::report::names::{round, size};
use crate::report::palette::{GRID, INK, Look, Mark, PALE};
use crate::report::sheet::{Hang, Sheet, TEXT, WIDTH, draw, width_of};

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its look.
    pub look: Look,
    /// Sizes, and the time at each in nanoseconds; in order of size.
    pub points: Vec<(f64, Spread)>,
    /// Whether it is a bound and not a measurement: dashed, without points.
    pub is_bound: bool,
}

const HEIGHT: f64 = 330.0;
const LEFT: f64 = 58.0;
const TOP: f64 = 54.0;
const BOTTOM: f64 = HEIGHT - 50.0;

/// Draws curves of time over sizes; the given sizes are labelled.
pub fn curves(title: &Title, caption: &str, sizes: &[u64], curves: &[Curve]) -> String {
    let names = curves.iter().map(|curve| width_of(&curve.look.name, TEXT));
    let right = WIDTH - 14.0 - names.fold(0.0, f64::max);
    let all = || curves.iter().flat_map(|curve| &curve.points);
    let across: Vec<f64> = all().map(|point| point.0).collect();
    let up: Vec<f64> = all().flat_map(|point| [point.1.low, point.1.high]).collect();
    let x = Scale::new(&across, (LEFT + 10.0, right - 10.0));
    let y = Axis::new(&up, (BOTTOM, TOP));
    draw(&title.question, HEIGHT, |sheet| {
        sheet.title(&title.lines());
        backdrop(sheet, caption, sizes, (&x, &y, right));
        let ends: Vec<f64> =
            curves.iter().map(|c| c.points.last().map_or(BOTTOM, |p| y.at(p.1.median))).collect();
        let heights = apart(&ends, TEXT + 2.0, (TOP + 4.0, BOTTOM - 4.0));
        for ((curve, height), end) in curves.iter().zip(heights).zip(ends) {
            one(sheet, curve, (&x, &y));
            if let Some((last, _)) = curve.points.last() {
                let from = (x.at(*last) + 6.0, end);
                sheet.line(&[from, (right, height)], GRID, 1.0);
                sheet.text(
                    &curve.look.name,
                    (right + 3.0, height),
                    Hang::Start,
                    (dark(curve.look.color), TEXT),
                );
            }
        }
    })
}

/// A logarithmic scale from the smallest to the largest value.
struct Scale {
    low: f64,
    high: f64,
    places: (f64, f64),
}

impl Scale {
    fn new(values: &[f64], places: (f64, f64)) -> Self {
        let logs = values.iter().map(|&value| libm::log10(value.max(1.0)));
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        Self { low, high, places }
    }

    fn at(&self, value: f64) -> f64 {
        let span = self.high - self.low;
        let part = if span > 0.0 { (libm::log10(value.max(1.0)) - self.low) / span } else { 0.5 };
        self.places.0 + part * (self.places.1 - self.places.0)
    }
}

fn backdrop(sheet: &mut Sheet, caption: &str, sizes: &[u64], (x, y, right): (&Scale, &Axis, f64)) {
    let small = TEXT - 0.5;
    for value in y.lines() {
        for step in 1..10 {
            let width = if step == 1 { 1.0 } else { 0.25 };
            let at = y.at(value * f64::from(step));
            sheet.line(&[(LEFT, at), (right, at)], GRID, width);
        }
        sheet.text(&round(value), (LEFT - 5.0, y.at(value)), Hang::End, (INK, small));
    }
    // From the largest down: both ends should be labelled, and the upper one matters more.
    let mut free = f64::INFINITY;
    for &value in sizes.iter().rev() {
        let (place, name) = (x.at(value as f64), size(value));
        sheet.line(&[(place, BOTTOM), (place, BOTTOM + 4.0)], PALE, 1.0);
        let half = 0.5 * width_of(&name, small);
        if place + half < free {
            sheet.text(&name, (place, BOTTOM + 13.0), Hang::Middle, (INK, small));
            free = place - half - 4.0;
        }
    }
    sheet.text(caption, (0.5 * (LEFT + right), BOTTOM + 33.0), Hang::Middle, (PALE, TEXT));
}

fn one(sheet: &mut Sheet, curve: &Curve, (x, y): (&Scale, &Axis)) {
    let color = curve.look.color;
    let places: Vec<(f64, f64)> =
        curve.points.iter().map(|(size, ns)| (x.at(*size), y.at(ns.median))).collect();
    if curve.is_bound {
        sheet.dashes(&places, color, 1.25);
        return;
    }
    sheet.line(&places, color, 1.75);
    for ((_, ns), place) in curve.points.iter().zip(&places) {
        sheet.line(&[(place.0, y.at(ns.low)), (place.0, y.at(ns.high))], color, 1.25);
        let mark = if curve.points.len() > 12 { Mark::Disc } else { curve.look.mark };
        sheet.mark(*place, mark, (color, ns.is_wide()));
    }
}
