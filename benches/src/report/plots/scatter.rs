//! Time against error, both logarithmic: one point per method, the Pareto front, and a band for no error at all.

use super::Title;
use super::labels::{Rectangle, place};
use crate::clock::Spread;
use crate::report::axis::Axis;
use crate::report::names::{error, round};
use crate::report::palette::{GRID, INK, Look, PALE};
use crate::report::sheet::{Hang, Sheet, TEXT, WIDTH, draw, width_of};
use crate::report::spread::pareto_front;
use plotters::style::RGBColor;

/// One method.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Its look.
    pub look: Look,
    /// Its label, if it is more than its name.
    pub label: String,
    /// Its value on the horizontal axis.
    pub across: f64,
    /// Where its horizontal whisker ends.
    pub reach: f64,
    /// Its time, in nanoseconds.
    pub ns: Spread,
    /// Whether it answers the same question as the others: only such methods are compared.
    pub is_ranked: bool,
}

/// The horizontal axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Across {
    /// The caption.
    pub caption: String,
    /// The label of zero.
    pub zero: String,
}

const HEIGHT: f64 = 380.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = WIDTH - 14.0;
const TOP: f64 = 52.0;
const BOTTOM: f64 = HEIGHT - 52.0;
const BAND: RGBColor = RGBColor(236, 245, 236);
const FRONT: RGBColor = RGBColor(150, 150, 150);

/// Draws the points. A method without a finite error is at the right edge, and its label says so.
pub fn scatter(title: &Title, across: &Across, points: &[Point]) -> String {
    let ends = |pick: fn(&Point) -> [f64; 2]| -> Vec<f64> { points.iter().flat_map(pick).collect() };
    let x = Axis::new(&ends(|point| [point.across, point.reach]), (LEFT, RIGHT)).with_zero(58.0);
    let y = Axis::new(&ends(|point| [point.ns.low, point.ns.high]), (BOTTOM, TOP));
    draw(&title.question, HEIGHT, |sheet| {
        sheet.title(&title.lines());
        backdrop(sheet, across, (&x, &y));
        let steps = front(points, (&x, &y));
        sheet.line(&steps, FRONT, 2.0);
        let at: Vec<(f64, f64)> = points.iter().map(|p| (x.at(p.across), y.at(p.ns.median))).collect();
        for (point, place) in points.iter().zip(&at) {
            whiskers(sheet, point, (&x, &y));
            sheet.mark(*place, point.look.mark, (point.look.color, point.ns.is_wide()));
        }
        let labels: Vec<(String, (f64, f64))> =
            points.iter().zip(&at).map(|(point, &place)| (point.label.clone(), place)).collect();
        for ((point, corner), from) in points
            .iter()
            .zip(place(&labels, [(LEFT, TOP), (RIGHT, BOTTOM)], &drawn_lines(points, &steps, (&x, &y))))
            .zip(&at)
        {
            let middle = (corner.0, corner.1 + 0.5 * (TEXT + 2.0));
            if (middle.1 - from.1).abs() > 22.0 {
                let end = corner.0 + width_of(&point.label, TEXT);
                let edge = if from.1 > middle.1 { corner.1 + TEXT } else { corner.1 + 1.0 };
                sheet.line(&[*from, (from.0.clamp(corner.0, end), edge)], FRONT, 0.75);
            }
            sheet.text(&point.label, middle, Hang::Start, (dark(point.look.color), TEXT));
        }
    })
}

/// The colour darkened as far as text needs.
pub(super) fn dark(RGBColor(r, g, b): RGBColor) -> RGBColor {
    let light = 0.3 * f64::from(r) + 0.59 * f64::from(g) + 0.11 * f64::from(b);
    let factor = (95.0 / light.max(1.0)).min(1.0);
    let less = |channel: u8| (f64::from(channel) * factor) as u8;
    RGBColor(less(r), less(g), less(b))
}

fn backdrop(sheet: &mut Sheet, across: &Across, (x, y): (&Axis, &Axis)) {
    let small = TEXT - 0.5;
    if let Some((zero, end)) = x.zero() {
        sheet.rect((LEFT, TOP), (end, BOTTOM), BAND);
        sheet.text(&across.zero, (zero, BOTTOM + 12.0), Hang::Middle, (INK, small));
    }
    for value in x.lines() {
        let place = x.at(value);
        sheet.line(&[(place, TOP), (place, BOTTOM)], GRID, 0.5);
    }
    for value in x.ticks(6) {
        let hang = if x.at(value) > RIGHT - 10.0 { Hang::End } else { Hang::Middle };
        sheet.text(&error(value), (x.at(value), BOTTOM + 12.0), hang, (INK, small));
    }
    for value in y.lines() {
        for step in 1..10 {
            let at = y.at(value * f64::from(step));
            let width = if step == 1 { 1.0 } else { 0.25 };
            sheet.line(&[(LEFT, at), (RIGHT, at)], GRID, width);
        }
        sheet.text(&round(value), (LEFT - 5.0, y.at(value)), Hang::End, (INK, small));
    }
    sheet.text(&across.caption, (0.5 * (LEFT + RIGHT), BOTTOM + 32.0), Hang::Middle, (PALE, TEXT));
}

/// The front as steps from one method to the next: nothing was measured below and left of them.
fn front(points: &[Point], (x, y): (&Axis, &Axis)) -> Vec<(f64, f64)> {
    let value = |point: &Point| if point.is_ranked { point.across } else { f64::NAN };
    let values: Vec<(f64, f64)> = points.iter().map(|point| (value(point), point.ns.median)).collect();
    let mut steps: Vec<(f64, f64)> = Vec::new();
    for i in pareto_front(&values) {
        let place = (x.at(values[i].0), y.at(values[i].1));
        let above = steps.last().map_or(TOP, |last| last.1);
        steps.extend([(place.0, above), place]);
    }
    if let Some(&(_, last)) = steps.last() {
        steps.push((RIGHT, last));
    }
    steps
}

/// What labels should avoid: the front, and the whiskers of errors.
fn drawn_lines(points: &[Point], steps: &[(f64, f64)], (x, y): (&Axis, &Axis)) -> Vec<Rectangle> {
    let around = |a: (f64, f64), b: (f64, f64)| {
        [(a.0.min(b.0) - 2.0, a.1.min(b.1) - 2.0), (a.0.max(b.0) + 2.0, a.1.max(b.1) + 2.0)]
    };
    let reach = points.iter().map(|point| {
        let height = y.at(point.ns.median);
        around((x.at(point.across), height), (x.at(point.reach), height))
    });
    let noise = points.iter().map(|point| {
        let place = x.at(point.across);
        around((place, y.at(point.ns.low)), (place, y.at(point.ns.high)))
    });
    steps.windows(2).map(|ends| around(ends[0], ends[1])).chain(reach).chain(noise).collect()
}

/// A vertical whisker for the quartiles of time; a horizontal one as far as the error reaches.
fn whiskers(sheet: &mut Sheet, point: &Point, (x, y): (&Axis, &Axis)) {
    let (place, height) = (x.at(point.across), y.at(point.ns.median));
    let (color, ns) = (point.look.color, point.ns);
    sheet.line(&[(place, y.at(ns.low)), (place, y.at(ns.high))], color, 1.25);
    let end = x.at(point.reach);
    if end > place + 6.0 {
        sheet.line(&[(place, height), (end, height)], color, 1.0);
        sheet.line(&[(end, height - 3.0), (end, height + 3.0)], color, 1.0);
    }
}
