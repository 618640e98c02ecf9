//! The corners of regular polygons.

use core::cmp::Ordering;
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use glam::DVec2;

/// The corners of a regular polygon about the origin, counter-clockwise from the x axis.
///
/// Sine and cosine are computed for the first eighth of a turn only, and mirrored from there: a corner on an axis is
/// exactly on it, and symmetric corners have the same bits.
pub(crate) fn corners(sides: usize, radius: f32) -> impl Iterator<Item = DVec2> {
    (0..sides).map(move |corner| {
        let (quarter, rest) = (4 * corner / sides, 4 * corner % sides);
        let part = |share: usize| FRAC_PI_2 * (share as f64 / sides as f64);
        let (cos, sin) = match (2 * rest).cmp(&sides) {
            Ordering::Less => (libm::cos(part(rest)), libm::sin(part(rest))),
            Ordering::Equal => (FRAC_1_SQRT_2, FRAC_1_SQRT_2),
            Ordering::Greater => (libm::sin(part(sides - rest)), libm::cos(part(sides - rest))),
        };
        let unit = match quarter {
            0 => DVec2::new(cos, sin),
            1 => DVec2::new(-sin, cos),
            2 => DVec2::new(-cos, -sin),
            _ => DVec2::new(sin, -cos),
        };
        unit * f64::from(radius)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_on_the_circle_and_mirrored_to_the_bit() {
        for sides in 3..300 {
            let ring: Vec<DVec2> = corners(sides, 3.0).collect();
            assert_eq!((ring.len(), ring[0]), (sides, DVec2::X * 3.0));
            for (i, &corner) in ring.iter().enumerate() {
                assert!((corner.length() - 3.0).abs() < 1e-14, "{sides} sides");
                let next = ring[(i + 1) % sides];
                let angle = core::f64::consts::TAU / sides as f64;
                assert!((corner.perp_dot(next) - 9.0 * libm::sin(angle)).abs() < 1e-13, "{sides} sides");
                let mirrored = ring[(sides - i) % sides];
                assert_eq!([corner.x, corner.y + 0.0], [mirrored.x, -mirrored.y + 0.0], "{sides} sides");
            }
            if sides % 4 == 0 {
                assert_eq!(ring[sides / 4] + 0.0, DVec2::Y * 3.0);
            }
        }
    }
}
