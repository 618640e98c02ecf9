//! Triangles as seen along a ray.
//!
//! All is projected along the ray into the coordinate plane that the ray is steepest to, where the ray's line is zero.
//! The line crosses a triangle if the projection contains zero, which then is on the same side of all three edges
//! (Woop, Benthin and Wald, "Watertight ray/triangle intersection", 2013). In f64, from corners in f32, with a slack
//! far above rounding: what is within the slack is [`Side::Unclear`].

use asunder_geometry::glam::{DVec3, Vec3};

/// The slack of an edge function, in squares of the reach.
///
/// A place in the plane is right to 8 roundings of the reach R, so the span of two, each within 4 R of zero, to 64 of
/// R^2. A triangle by itself takes what passes within 128 roundings of R, and its box what passes within 512: an edge
/// is no longer than 2 R, and along a ray at most the root of 3 steeper, so these are 1800. The rest is to spare: on a
/// mesh a kilometre wide the slack is 2e-6 m^2.
const SLACK: f64 = 8192.0 * f64::EPSILON;

/// On which side of a triangle's edges a ray's line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Certainly outside of one.
    Beside,
    /// Certainly inside of all.
    Inside,
    Unclear,
}

/// A coordinate plane, into which points are projected along a ray: the ray is a point there, at zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    /// What each coordinate contributes to the two coordinates in the plane.
    along: [[f64; 2]; 3],
    /// The projection of the ray's origin.
    origin: [f64; 2],
    /// Twice an area: more than the rounding of the one between zero and an edge, and than the one that an edge within
    /// rounding of the ray spans.
    slack: f64,
}

impl Projection {
    /// `reach` is at least the distance of the ray's origin from any point, and half of that between any two points.
    #[inline(always)]
    pub(super) fn new(origin: DVec3, way: DVec3, reach: f64) -> Self {
        let size = way.abs();
        // Any two coordinates of a right-handed three may stay as they are: only whether signs agree counts.
        let along = if size.x >= size.y && size.x >= size.z {
            [[-way.y / way.x, -way.z / way.x], [1.0, 0.0], [0.0, 1.0]]
        } else if size.y >= size.z {
            [[0.0, 1.0], [-way.z / way.y, -way.x / way.y], [1.0, 0.0]]
        } else {
            [[1.0, 0.0], [0.0, 1.0], [-way.x / way.z, -way.y / way.z]]
        };
        let mut projection = Self { along, origin: [0.0; 2], slack: SLACK * reach * reach };
        projection.origin = projection.place(origin);
        projection
    }

    #[inline(always)]
    fn place(&self, point: DVec3) -> [f64; 2] {
        let [[ax, ay], [bx, by], [cx, cy]] = self.along;
        [
            point.x * ax + point.y * bx + point.z * cx - self.origin[0],
            point.x * ay + point.y * by + point.z * cy - self.origin[1],
        ]
    }

    #[inline(always)]
    pub(super) fn side(&self, corners: [Vec3; 3]) -> Side {
        let [a, b, c] = [
            self.place(corners[0].as_dvec3()),
            self.place(corners[1].as_dvec3()),
            self.place(corners[2].as_dvec3()),
        ];
        let span = |one: [f64; 2], other: [f64; 2]| one[0] * other[1] - one[1] * other[0];
        let (ab, bc, ca) = (span(a, b), span(b, c), span(c, a));
        let (least, most) = (ab.min(bc).min(ca), ab.max(bc).max(ca));
        if least < -self.slack && most > self.slack {
            Side::Beside
        } else if least > self.slack || most < -self.slack {
            Side::Inside
        } else {
            Side::Unclear
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use oorandom::Rand64;

    /// A triple product, exactly.
    fn triple(a: [i128; 3], b: [i128; 3], c: [i128; 3]) -> i128 {
        let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
        a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1)
    }

    fn length(v: [i128; 3]) -> f64 {
        v.iter().map(|&part| (part as f64) * (part as f64)).sum::<f64>().sqrt()
    }

    /// Against integers: rays through edges and vertices and past them by as little as a rounding, triangles down to
    /// needles, seen at a slant down to edge on, near and far, of any size.
    #[test]
    fn what_is_clear_is_so_by_integers() {
        let mut random = Rand64::new(4711);
        let mut int = |most: i128| i128::from(random.rand_range(0..2 * most as u64 + 1)) - most;
        let (mut beside, mut inside, mut unclear) = (0, 0, 0);
        for round in 0..60_000_u32 {
            // In steps of 2^-22 of the corners' unit.
            let step = 1_i128 << 22;
            let far = if round % 7 == 0 { [int(1 << 22) & !7, int(1 << 22) & !7, 0] } else { [0; 3] };
            let size = [1 << 22, 1 << 16, 1 << 10][round as usize % 3];
            let mut corner = || [0, 1, 2].map(|axis| (far[axis] + int(size)) & !7);
            let (a, b, mut c) = (corner(), corner(), corner());
            let share = int(4) + 4;
            let on_edge = [0, 1, 2].map(|axis| a[axis] + (b[axis] - a[axis]) / 8 * share);
            if round % 2 == 0 {
                // A needle: its third corner beside the others' edge.
                c = on_edge.map(|part| part + int(size / 1000 + 1));
            }
            let target = if round % 5 == 0 { c } else { on_edge };
            let mut way = [0; 3].map(|_: i128| int(1 << 20));
            if round % 4 == 0 {
                // Nearly along the edge, and so nearly in the plane.
                way = [0, 1, 2].map(|axis| (b[axis] - a[axis]) / 8 + int(2));
            }
            if way == [0; 3] {
                continue;
            }
            let (back, off) = (int(1 << 20), 1_i128 << (round % 31));
            let origin = [0, 1, 2].map(|axis| target[axis] * step - way[axis] * back + int(off));
            let [pa, pb, pc] = [a, b, c].map(|p| [0, 1, 2].map(|axis| p[axis] * step - origin[axis]));
            let edge = |one: [i128; 3], other: [i128; 3]| [0, 1, 2].map(|axis| other[axis] - one[axis]);
            let spans = [(pa, pb), (pb, pc), (pc, pa)]
                .map(|(one, other)| (triple(way, one, other), edge(one, other)));
            let scale = f64::from(((round % 120) as f32 - 60.0).exp2());
            let real = |v: [i128; 3], by: f64| DVec3::new(v[0] as f64, v[1] as f64, v[2] as f64) * by;
            let corners = [a, b, c].map(|p| real(p, scale).as_vec3());
            let reach = corners.iter().map(|p| p.as_dvec3().length()).fold(0.0, f64::max)
                + real(origin, scale / step as f64).length();
            let projection = Projection::new(real(origin, scale / step as f64), real(way, 1.0), reach);
            match projection.side(corners) {
                Side::Beside => {
                    beside += 1;
                    let [least, most] = [spans.iter().map(|s| s.0).min(), spans.iter().map(|s| s.0).max()];
                    assert!(least < Some(0) && most > Some(0), "{round}: it is inside");
                    // So far from the line of any edge that it may be outside of.
                    let away =
                        |&(span, edge): &(i128, [i128; 3])| span.abs() as f64 / (length(way) * length(edge));
                    let outside =
                        |sign: i128| spans.iter().filter(|s| s.0 * sign > 0).map(away).fold(0.0, f64::max);
                    let least = outside(1).min(outside(-1)) * scale / step as f64;
                    assert!(
                        least > 512.0 * f64::EPSILON * reach,
                        "{round}: only {least} beside it, of {reach}"
                    );
                }
                Side::Inside => {
                    inside += 1;
                    let is_inside = spans.iter().all(|s| s.0 > 0) || spans.iter().all(|s| s.0 < 0);
                    assert!(is_inside, "{round}: it is beside");
                }
                Side::Unclear => unclear += 1,
            }
        }
        assert!(beside > 5_000 && inside > 500 && unclear > 5_000, "{beside} {inside} {unclear}");
    }

    #[test]
    fn what_is_no_number_is_unclear() {
        for far in [f64::NAN, f64::INFINITY, 1e300] {
            let projection = Projection::new(DVec3::splat(far), DVec3::Y, far);
            assert_eq!(projection.side([Vec3::ZERO, Vec3::X, Vec3::Z]), Side::Unclear, "{far}");
        }
    }
}
