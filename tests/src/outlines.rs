//! Seeded outlines in the plane: simple ones of many kinds, and the points to make them of.

use crate::cases::Random;
use crate::exact_plane::{ExactPlane, Meeting};
use glam::{DVec2, Vec2};

/// After this many passes over all pairs of edges, points that are still tangled are mostly collinear.
const PASSES: usize = 12;

/// The points in an order whose edges mostly do not cross, each place once: two edges that meet are exchanged for the
/// other pair with the same ends, until none are left, or up to a limit. The points must be finite.
pub fn untangled(points: Vec<Vec2>) -> Vec<Vec2> {
    let mut outline: Vec<Vec2> = Vec::new();
    for point in points {
        if !outline.contains(&point) {
            outline.push(point);
        }
    }
    let count = outline.len();
    let exact = ExactPlane::new(outline.iter().map(|p| p.as_dvec2()));
    let mut order: Vec<usize> = (0..count).collect();
    let meet = |order: &[usize], a: usize, b: usize| {
        let [e, f] = [a, b].map(|edge| [order[edge], order[(edge + 1) % count]]);
        exact.segments(e, f) != Meeting::Apart
    };
    for _ in 0..PASSES {
        let mut is_simple = true;
        for (a, b) in (0..count).flat_map(|b| (0..b).map(move |a| (a, b))) {
            if meet(&order, a, b) {
                order[a + 1..=b].reverse();
                is_simple = false;
            }
        }
        if is_simple {
            break;
        }
    }
    order.into_iter().map(|i| outline[i]).collect()
}

/// Points of one of the kinds that break geometry code: on a small lattice, random, on a circle, one rounding apart, in
/// a strip 1e-7 wide, or of any size down to subnormal.
pub fn nasty_points(random: &mut Random, count: usize) -> Vec<Vec2> {
    let kind = random.below(7);
    let size = random.pick(&[1.0, 1e-5, 1e3, 4e5]);
    (0..count)
        .map(|_| match kind {
            0 => DVec2::new(random.below(6) as f64, random.below(6) as f64) * size,
            1 => DVec2::new(random.signed(), random.signed()) * size,
            // Pythagorean directions: exactly cocircular.
            2 => {
                let (x, y) = random.pick(&[(3.0, 4.0), (4.0, 3.0), (5.0, 0.0), (0.0, 5.0)]);
                DVec2::new(random.pick(&[x, -x]), random.pick(&[y, -y]))
            }
            3 => DVec2::splat(1.0) + DVec2::new(random.below(9) as f64, random.below(9) as f64) * 1.2e-7,
            4 => DVec2::new(random.signed(), 1e-7 * random.signed()),
            5 => DVec2::new(random.signed(), random.pick(&[0.0, 1e-45, 1e-40, -1e-38, 1e-20, 1e-3])),
            _ => random.direction2() * size,
        })
        .map(DVec2::as_vec2)
        .collect()
}

/// A comb: a bar with this many teeth standing on it.
pub fn comb(teeth: usize) -> Vec<Vec2> {
    let foot = |i: usize| 2.0 * i as f32;
    let mut outline = vec![Vec2::new(foot(teeth) - 1.0, -1.0)];
    for i in (0..teeth).rev() {
        outline.extend(
            [(foot(i) + 1.0, 0.0), (foot(i) + 1.0, 5.0), (foot(i), 5.0), (foot(i), 0.0)].map(Vec2::from),
        );
    }
    // The outermost feet lie on the bar's own sides.
    outline.retain(|p| p.y != 0.0 || p.x != foot(0) && p.x != foot(teeth) - 1.0);
    outline.push(Vec2::new(0.0, -1.0));
    outline.reverse();
    outline
}

/// A star: tips at a distance of 1, and between them dents at random fractions of it.
pub fn star(random: &mut Random, tips: usize) -> Vec<Vec2> {
    let turn = core::f64::consts::PI / tips as f64;
    let (sin, cos) = sin_cos(turn);
    let mut direction = DVec2::X;
    (0..2 * tips)
        .map(|i| {
            let radius = if i % 2 == 0 { 1.0 } else { random.between(0.2, 0.7) };
            let at = direction * radius;
            direction =
                DVec2::new(cos * direction.x - sin * direction.y, sin * direction.x + cos * direction.y);
            at.as_vec2()
        })
        .collect()
}

/// A spiral strip: out along one side, back along the other.
pub fn spiral(steps: usize) -> Vec<Vec2> {
    let (sin, cos) = sin_cos(0.2);
    let mut direction = DVec2::X;
    let (mut outer, mut inner) = (Vec::new(), Vec::new());
    for i in 0..steps {
        let radius = 1.0 + 0.02 * i as f64;
        outer.push((direction * (radius + 0.2)).as_vec2());
        inner.push((direction * radius).as_vec2());
        direction = DVec2::new(cos * direction.x - sin * direction.y, sin * direction.x + cos * direction.y);
    }
    inner.reverse();
    outer.extend(inner);
    outer
}

/// Sine and cosine of a small angle by their series: the standard library's differ between platforms.
fn sin_cos(angle: f64) -> (f64, f64) {
    let (mut sin, mut cos, mut term) = (0.0, 0.0, 1.0);
    for power in 0..30 {
        let sign = if power / 2 % 2 == 0 { 1.0 } else { -1.0 };
        *if power % 2 == 0 { &mut cos } else { &mut sin } += sign * term;
        term *= angle / f64::from(power + 1);
    }
    (sin, cos)
}
