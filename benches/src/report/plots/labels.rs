//! Labels next to points: each at the first free place around its point.

use crate::report::sheet::{TEXT, width_of};

/// A rectangle on the sheet: its lower and upper corner.
pub type Rectangle = [(f64, f64); 2];

/// Places for labels at points, within a frame: the lower corner of each label. As long as there is room nearby, no
/// label lies on another one, on a point or outside the frame; and, where possible, none on a line.
///
/// ```
/// use asunder_benches::report::plots::labels::place;
/// let labels = [("one".to_string(), (50.0, 50.0)), ("two".to_string(), (52.0, 50.0))];
/// let places = place(&labels, [(0.0, 0.0), (200.0, 100.0)], &[]);
/// assert!((places[0].1 - places[1].1).abs() > 10.0 || (places[0].0 - places[1].0).abs() > 15.0);
/// ```
pub fn place(labels: &[(String, (f64, f64))], frame: Rectangle, lines: &[Rectangle]) -> Vec<(f64, f64)> {
    let points: Vec<Rectangle> =
        labels.iter().map(|(_, (x, y))| [(x - 6.0, y - 6.0), (x + 6.0, y + 6.0)]).collect();
    let mut taken: Vec<Rectangle> = Vec::new();
    for (text, at) in labels {
        let size = size_of(text);
        let (mut best, mut least) = ([*at, *at], f64::INFINITY);
        for (i, corner) in around(*at, size).into_iter().enumerate() {
            let label = [corner, (corner.0 + size.0, corner.1 + size.1)];
            let hidden: f64 = taken.iter().chain(&points).map(|other| shared(&label, other)).sum();
            let crossed: f64 = lines.iter().map(|line| shared(&label, line)).sum();
            let outside = size.0 * size.1 - shared(&label, &frame);
            // Nearer places come first, and win among equals.
            let cost = 10.0 * hidden + 40.0 * outside + 0.06 * crossed + i as f64;
            if cost < least {
                (best, least) = (label, cost);
            }
        }
        taken.push(best);
    }
    taken.iter().map(|label| label[0]).collect()
}

/// Width and height of a label.
fn size_of(text: &str) -> (f64, f64) {
    (width_of(text, TEXT), TEXT + 2.0)
}

/// Candidate places of a label, the best first: right, left, above, below, and the same further out.
fn around((x, y): (f64, f64), (width, height): (f64, f64)) -> Vec<(f64, f64)> {
    let mut places = Vec::new();
    for ring in 0..7 {
        let out = f64::from(ring) * 9.0;
        let (right, left, middle) = (x + 9.0, x - 9.0 - width, x - 0.5 * width);
        let (above, level, below) = (y - 8.0 - height - out, y - 0.5 * height, y + 8.0 + out);
        if ring == 0 {
            places.extend([(right, level), (left, level)]);
        }
        places.extend([
            (right, above),
            (right, below),
            (left, above),
            (left, below),
            (middle, above),
            (middle, below),
        ]);
    }
    places
}

/// The area shared by two rectangles.
fn shared(a: &Rectangle, b: &Rectangle) -> f64 {
    let width = a[1].0.min(b[1].0) - a[0].0.max(b[0].0);
    let height = a[1].1.min(b[1].1) - a[0].1.max(b[0].1);
    width.max(0.0) * height.max(0.0)
}

/// Moves heights apart until no two are nearer than `least`; keeps their order, and stays within two ends.
///
/// ```
/// use asunder_benches::report::plots::labels::apart;
/// assert_eq!(apart(&[50.0, 10.0, 51.0], 12.0, (0.0, 100.0)), [50.0, 10.0, 62.0]);
/// assert_eq!(apart(&[99.0, 98.0], 10.0, (0.0, 100.0)), [100.0, 90.0]);
/// ```
pub fn apart(heights: &[f64], least: f64, (low, high): (f64, f64)) -> Vec<f64> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by(|&i, &j| heights[i].total_cmp(&heights[j]).then(i.cmp(&j)));
    let mut moved = heights.to_vec();
    let mut floor = low;
    for &i in &order {
        moved[i] = moved[i].max(floor);
        floor = moved[i] + least;
    }
    let mut ceiling = high;
    for &i in order.iter().rev() {
        moved[i] = moved[i].min(ceiling);
        ceiling = moved[i] - least;
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seven_labels_at_one_place_do_not_hide_each_other() {
        let labels: Vec<(String, (f64, f64))> =
            (0..7).map(|i| (format!("textbook f{i}"), (200.0, 150.0 + f64::from(i)))).collect();
        let places = place(&labels, [(0.0, 0.0), (400.0, 300.0)], &[]);
        for (i, one) in places.iter().enumerate() {
            for other in &places[..i] {
                let (width, height) = size_of("textbook f0");
                assert!((one.0 - other.0).abs() >= width || (one.1 - other.1).abs() >= height, "{places:?}");
            }
        }
    }
}
