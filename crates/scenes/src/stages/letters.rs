//! A rain of letters: concave outlines, cut into convex parts.

use super::Scene2;
use super::plane::{grid, pit};
use crate::random::Random;
use asunder_geometry::{Shape2, decompose};
use glam::{DVec2, Vec2};

/// Metres from letter to letter.
const CELL: DVec2 = DVec2::new(1.9, 2.1);

/// Outlines 1 m wide and 1.4 m high, counter-clockwise, in tenths of a metre.
const LETTERS: [&[(i8, i8)]; 6] = [
    // A, without its hole.
    &[(-5, -7), (-2, -7), (-1, -4), (1, -4), (2, -7), (5, -7), (2, 7), (-2, 7)],
    // E
    &[
        (-5, -7),
        (5, -7),
        (5, -4),
        (-2, -4),
        (-2, -1),
        (3, -1),
        (3, 1),
        (-2, 1),
        (-2, 4),
        (5, 4),
        (5, 7),
        (-5, 7),
    ],
    // H
    &[
        (-5, -7),
        (-2, -7),
        (-2, -1),
        (2, -1),
        (2, -7),
        (5, -7),
        (5, 7),
        (2, 7),
        (2, 2),
        (-2, 2),
        (-2, 7),
        (-5, 7),
    ],
    // L
    &[(-5, -7), (5, -7), (5, -4), (-2, -4), (-2, 7), (-5, 7)],
    // T
    &[(-1, -7), (2, -7), (2, 4), (5, 4), (5, 7), (-5, 7), (-5, 4), (-1, 4)],
    // U
    &[(-3, -7), (3, -7), (5, -5), (5, 7), (2, 7), (2, -4), (-2, -4), (-2, 7), (-5, 7), (-5, -5)],
];

pub(super) fn rain(size: usize, seed: u64) -> Scene2 {
    let mut random = Random::new(seed ^ 0x1e77e);
    let letters: Vec<Shape2> = LETTERS.iter().map(|outline| letter(outline)).collect();
    let wide = ((size as f64 / 1.5).sqrt().ceil() as usize).max(4);
    let rows = size.div_ceil(wide) as f64;
    let mut scene = pit(DVec2::new(0.5 * CELL.x * wide as f64 + 0.5, 0.5 * CELL.y * rows + 2.0));
    grid(size, wide, |cell| {
        let stray = DVec2::new(random.range(-0.1, 0.1), random.range(-0.1, 0.1));
        let shape = letters[random.below(letters.len())].clone();
        scene.free(shape, cell * CELL + stray + DVec2::Y * 2.0, random.range(-0.4, 0.4));
    });
    scene
}

fn letter(outline: &[(i8, i8)]) -> Shape2 {
    let points: Vec<Vec2> =
        outline.iter().map(|&(x, y)| Vec2::new(f32::from(x), f32::from(y)) * 0.1).collect();
    decompose(&points).expect("outlines that do not cross themselves").into()
}
