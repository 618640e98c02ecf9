//! Boxes turned by right angles, such as the bricks of a grid: the signs of a few sums decide.
//!
//! Where every axis of both boxes lies along an axis of the world, they are apart exactly where they are apart along one
//! of these, that is, where the distance of their centres exceeds both half extents. Each distance is a sum of at most
//! six f64, and its sign is found without rounding.

use super::rotation::matrix;
use super::{Site2, Site3};
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use core::cmp::Ordering;

/// A rotation by right angles: rows with a single entry of 1 or -1, and zeros.
type Turn<const N: usize> = [[f64; N]; N];

/// A box along the world's axes.
struct Aligned<const N: usize> {
    half_extents: [f64; N],
    /// The centre, as the sum of the body's position and the turned position of the part.
    center: [[f64; 2]; N],
}

/// Whether two cuboids without radius share a point, if both are turned by right angles; `None` for all other shapes.
/// Cost: next to nothing.
pub(crate) fn boxes_overlap3([a, b]: [&Site3; 2]) -> Option<bool> {
    Some(aligned3(a)?.overlaps(&aligned3(b)?))
}

/// As [`boxes_overlap3`], for rectangles.
pub(super) fn boxes_overlap2([a, b]: [&Site2; 2]) -> Option<bool> {
    Some(aligned2(a)?.overlaps(&aligned2(b)?))
}

impl<const N: usize> Aligned<N> {
    /// From the positions and rotations of the body, and of the part in its body. Products with 1, -1 and 0 are exact,
    /// and so are sums of which one term at most is not zero.
    fn new(half_extents: [f64; N], [body, part]: [([f64; N], Turn<N>); 2]) -> Self {
        let ((position, turn), (shift, turn_of_part)) = (body, part);
        let shift = turned(&turn, shift);
        Self {
            half_extents: turned(&turn, turned(&turn_of_part, half_extents)).map(f64::abs),
            center: core::array::from_fn(|axis| [position[axis], shift[axis]]),
        }
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..N).all(|axis| {
            let ([p, q], [r, s]) = (self.center[axis], other.center[axis]);
            let reach = [self.half_extents[axis], other.half_extents[axis]];
            let is_within = |ahead: [f64; 4]| {
                let [d, e, f, g] = ahead;
                sign_of_sum([d, e, f, g, -reach[0], -reach[1]]) != Ordering::Greater
            };
            is_within([p, q, -r, -s]) && is_within([r, s, -p, -q])
        })
    }
}

fn aligned3(site: &Site3) -> Option<Aligned<3>> {
    let Shape3::Cuboid(cuboid) = site.shape else { return None };
    let place = |pose: &Pose3| Some((pose.position().to_array(), right_angles3(pose)?));
    let places = [place(&site.body)?, place(site.part.unwrap_or(&Pose3::IDENTITY))?];
    let half_extents = cuboid.half_extents().as_dvec3().to_array();
    (cuboid.radius() == 0.0).then(|| Aligned::new(half_extents, places))
}

fn aligned2(site: &Site2) -> Option<Aligned<2>> {
    let Shape2::Rect(rect) = site.shape else { return None };
    let place = |pose: &Pose2| Some((pose.position().to_array(), right_angles2(pose)?));
    let places = [place(&site.body)?, place(site.part.unwrap_or(&Pose2::IDENTITY))?];
    let half_extents = rect.half_extents().as_dvec2().to_array();
    (rect.radius() == 0.0).then(|| Aligned::new(half_extents, places))
}

/// The rotation of a pose, if it is by right angles: where the components of its quaternion that are not zero are one,
/// two or four, and all of one size.
fn right_angles3(pose: &Pose3) -> Option<Turn<3>> {
    let components = pose.rotation().to_array();
    let size = components.iter().fold(0.0_f32, |size, value| size.max(value.abs()));
    if !components.iter().all(|value| *value == 0.0 || value.abs() == size) {
        return None;
    }
    let units = components.map(|value| i128::from(value > 0.0) - i128::from(value < 0.0));
    let count = units.iter().filter(|unit| **unit != 0).count();
    let is_right = matches!(count, 1 | 2 | 4);
    // The entries are their number, its negative, and zero.
    is_right.then(|| matrix(&units).map(|row| row.map(|entry| f64::from(entry.signum() as i8))))
}

fn right_angles2(pose: &Pose2) -> Option<Turn<2>> {
    let [cos, sin] = [pose.rotation().cos(), pose.rotation().sin()].map(f64::from);
    let is_right = [cos.abs(), sin.abs()] == [1.0, 0.0] || [cos.abs(), sin.abs()] == [0.0, 1.0];
    is_right.then_some([[cos, -sin], [sin, cos]])
}

fn turned<const N: usize>(turn: &Turn<N>, v: [f64; N]) -> [f64; N] {
    turn.map(|row| row.iter().zip(v).map(|(entry, value)| entry * value).sum())
}

/// The sign of a sum, without rounding. Where the rounded sum is close to zero: that of the greatest of numbers that do
/// not overlap and have the same sum.
///
/// Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates" (1997),
/// grow-expansion.
fn sign_of_sum<const N: usize>(terms: [f64; N]) -> Ordering {
    let (sum, size) = terms.iter().fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
    // Each of fewer than N roundings loses at most half of an epsilon of all that there is; so does each in `size`.
    if f64::abs(sum) > N as f64 * f64::EPSILON * size {
        return if sum > 0.0 { Ordering::Greater } else { Ordering::Less };
    }
    let mut parts = [0.0; N];
    for (known, term) in terms.into_iter().enumerate() {
        let mut carried = term;
        for part in &mut parts[..known] {
            (carried, *part) = two_sum(carried, *part);
        }
        parts[known] = carried;
    }
    let greatest = parts.into_iter().rev().find(|part| *part != 0.0);
    greatest.map_or(Ordering::Equal, |part| if part > 0.0 { Ordering::Greater } else { Ordering::Less })
}

/// The rounded sum of two numbers, and what rounding lost. Knuth's, for any order of sizes.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    let lost = (a - (sum - of_b)) + (b - of_b);
    (sum, lost)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{frame2, frame3};
    use asunder_geometry::glam::{DVec2, DVec3, Quat, Vec2, Vec3};
    use asunder_geometry::{Cuboid, Rect, Rotation2};
    use oorandom::Rand64;

    fn below(random: &mut Rand64, end: u64) -> usize {
        random.rand_range(0..end) as usize
    }

    /// Coordinates in steps that sums of f64 hold, in steps that they do not, and hairs beside both.
    fn coordinate(random: &mut Rand64) -> f64 {
        let step = [1.0, 0.1_f32.into(), 0.1, 4e8, 1e-17][below(random, 5)];
        let hair = [0.0, 0.0, 1e-16, -1e-17, 1e-30][below(random, 5)];
        step * (below(random, 5) as f64 - 2.0) + hair
    }

    /// One of the 24 rotations by right angles, of a quaternion of any length; now and then one that is none.
    fn rotation(random: &mut Rand64) -> Quat {
        let count = [1, 2, 4, 4, 3][below(random, 5)];
        let start = below(random, 4);
        let size = [1.0, 0.5, 0.707_106_77, 0.999_999_9][below(random, 4)];
        let mut components = [0.0_f32; 4];
        for at in 0..count {
            components[(start + at * (1 + below(random, 2))) % 4] =
                if below(random, 2) == 0 { size } else { -size };
        }
        Quat::from_array(components)
    }

    #[test]
    fn boxes_at_right_angles_are_as_integers_have_them() {
        let mut random = Rand64::new(77);
        let (mut yes, mut no, mut aside) = (0, 0, 0);
        for _ in 0..20_000 {
            let mut half = || [1.0, 0.1, 0.5, 0.3][below(&mut random, 4)] as f32;
            let shapes: [Shape3; 2] = [(); 2]
                .map(|()| Cuboid::from_half_extents(Vec3::new(half(), half(), half())).unwrap().into());
            let mut pose = || {
                let at =
                    DVec3::new(coordinate(&mut random), coordinate(&mut random), coordinate(&mut random));
                Pose3::new(at, rotation(&mut random)).ok()
            };
            let (Some(body_a), Some(body_b), Some(part)) = (pose(), pose(), pose()) else { continue };
            let part = (below(&mut random, 2) == 0).then_some(&part);
            let a = Site3 { shape: &shapes[0], body: body_a, part: None };
            let b = Site3 { shape: &shapes[1], body: body_b, part };
            let Some(found) = boxes_overlap3([&a, &b]) else {
                aside += 1;
                continue;
            };
            let cores = [a.shape.core(), b.shape.core()];
            assert_eq!(found, frame3::question([&a, &b], [&cores[0], &cores[1]]).answer(&[]), "{a:?} {b:?}");
            (yes, no) = (yes + usize::from(found), no + usize::from(!found));
        }
        assert!(yes > 500 && no > 500 && aside > 500, "{yes} {no} {aside}");
    }

    #[test]
    fn rectangles_at_right_angles_are_as_integers_have_them() {
        let mut random = Rand64::new(78);
        let (mut yes, mut no) = (0, 0);
        for _ in 0..20_000 {
            let mut half = || [1.0, 0.1, 0.5, 0.3][below(&mut random, 4)] as f32;
            let shapes: [Shape2; 2] =
                [(); 2].map(|()| Rect::from_half_extents(Vec2::new(half(), half())).unwrap().into());
            let mut pose = || {
                let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][below(&mut random, 4)];
                let turn = Rotation2::restored(cos, sin).unwrap();
                Pose2::new(DVec2::new(coordinate(&mut random), coordinate(&mut random)), turn).unwrap()
            };
            let (body_a, body_b, part) = (pose(), pose(), pose());
            let part = (below(&mut random, 2) == 0).then_some(&part);
            let a = Site2 { shape: &shapes[0], body: body_a, part: None };
            let b = Site2 { shape: &shapes[1], body: body_b, part };
            let cores = [a.shape.core(), b.shape.core()];
            let found = boxes_overlap2([&a, &b]).unwrap();
            assert_eq!(found, frame2::question([&a, &b], [&cores[0], &cores[1]]).answer(&[]), "{a:?} {b:?}");
            (yes, no) = (yes + usize::from(found), no + usize::from(!found));
        }
        assert!(yes > 500 && no > 500, "{yes} {no}");
    }

    #[test]
    fn only_sharp_boxes_at_right_angles_are_decided() {
        let cube = Cuboid::from_half_extents(Vec3::ONE).unwrap();
        let decided = |shape: Shape3, rotation: Quat| {
            let body = Pose3::new(DVec3::ZERO, rotation).unwrap();
            boxes_overlap3([&Site3 { shape: &shape, body, part: None }; 2])
        };
        assert_eq!(decided(cube.into(), Quat::IDENTITY), Some(true));
        assert_eq!(decided(cube.into(), Quat::from_array([0.0, 0.6, 0.0, 0.8])), None);
        assert_eq!(decided(cube.into(), Quat::from_array([0.1, 0.0, 0.0, 1.0])), None);
        assert_eq!(decided(cube.rounded(0.1).unwrap().into(), Quat::IDENTITY), None);
    }
}
