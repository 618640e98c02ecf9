//! The closest points of two cuboids that do not overlap.
//!
//! ```text
//! spheres apart   start from the direction between the centres
//! else            all fifteen axes at once: they overlap, or start from the face with the widest gap
//! from there on   as for any two solids                                                                   (distance)
//! ```
//! No vertices or faces are built for it: the support point along a direction has the direction's signs, and a corner
//! is three signs.

use super::Cuboids;
use super::fifteen::Fifteen;
use super::placed::{Posed, Size};
use crate::answer::Closest3;
use crate::polyhedron::distance::{Polytope, Until, distance};
use crate::polyhedron::gap::{Apart, Gap};
use crate::polyhedron::solid::corner_along;
use crate::precision::Precision;
use asunder_geometry::Basis3;
use asunder_geometry::glam::DVec3;

/// Which side of each of the three axes a corner is on. A table, because testing a corner's bits would be a branch each
/// that nobody can predict, and make a pair 1.6 times as slow (AMD EPYC, Zen 4, 2026-11-26).
const SIDES: [DVec3; 8] = [
    DVec3::new(-1.0, -1.0, -1.0),
    DVec3::new(1.0, -1.0, -1.0),
    DVec3::new(-1.0, 1.0, -1.0),
    DVec3::new(1.0, 1.0, -1.0),
    DVec3::new(-1.0, -1.0, 1.0),
    DVec3::new(1.0, -1.0, 1.0),
    DVec3::new(-1.0, 1.0, 1.0),
    DVec3::new(1.0, 1.0, 1.0),
];

/// A in its own axes, about its centre.
struct Home {
    half: DVec3,
}

/// B as seen from A: its centre, its axes, and the vectors from the centre to three of its faces.
struct Guest {
    center: DVec3,
    axes: Basis3,
    arms: [DVec3; 3],
}

impl Polytope for Home {
    #[inline(always)]
    fn furthest(&self, direction: DVec3) -> usize {
        corner_along(direction)
    }

    #[inline(always)]
    fn point(&self, vertex: usize) -> DVec3 {
        SIDES[vertex & 7] * self.half
    }
}

impl Polytope for Guest {
    #[inline(always)]
    fn furthest(&self, direction: DVec3) -> usize {
        corner_along(self.axes.turn_back(direction))
    }

    #[inline(always)]
    fn point(&self, vertex: usize) -> DVec3 {
        let (sides, [x, y, z]) = (SIDES[vertex & 7], self.arms);
        self.center + (x * sides.x + y * sides.y + z * sides.z)
    }
}

impl Posed<'_> {
    /// The closest points, or `Some(None)` where they overlap; `None` where that takes a closer look.
    pub(crate) fn distance(&self) -> Option<Option<Closest3>> {
        if self.are_near() {
            return Some(None);
        }
        let ([a, b], [pose_a, pose_b]) = (self.cuboids, self.poses);
        let basis = pose_a.basis();
        let offset = basis.turn_back(self.between());
        let Size { cores, radii, .. } = Size::of(self);
        let precision = Size::precision(cores, cores + radii, offset);
        let cuboids = Cuboids {
            half_a: a.half_extents().as_dvec3(),
            half_b: b.half_extents().as_dvec3(),
            basis: pose_b.basis_from(pose_a),
            offset,
        };
        let Apart { separation, error, normal, points } =
            match cuboids.gap([a.radius(), b.radius()], f64::INFINITY, &precision) {
                Gap::Apart(apart) => apart,
                Gap::Overlapping => return Some(None),
                Gap::Beyond(_) | Gap::Unclear => return None,
            };
        Some(Some(Closest3 {
            distance: separation,
            error,
            normal: basis.turn(normal).as_vec3(),
            anchor_a: basis.turn(points[0]).as_vec3(),
            anchor_b: basis.turn(points[1] - offset).as_vec3(),
            part_a: 0,
            part_b: 0,
        }))
    }
}

impl Cuboids {
    /// Whether there is a gap between two cuboids rounded by these radii, and its closest points, if it is no wider
    /// than a limit in metres.
    pub(crate) fn gap(&self, radii: [f32; 2], limit: f64, precision: &Precision) -> Gap {
        let apart = self.offset.length();
        let towards = if apart > precision.size + precision.projection() {
            self.offset / apart
        } else {
            let fifteen = self.fifteen();
            // Of the cores: if the radii close the gap between those, its width follows from the closest points.
            match fifteen.overlap(0.0, precision) {
                Some(true) => return Gap::Overlapping,
                Some(false) => self.best_face(&fifteen),
                None => return Gap::Unclear,
            }
        };
        self.gap_along(towards, radii, limit, precision)
    }

    /// The same for cuboids whose cores are apart, searched from a unit axis.
    pub(super) fn gap_along(
        &self,
        towards: DVec3,
        radii: [f32; 2],
        limit: f64,
        precision: &Precision,
    ) -> Gap {
        let beyond = limit + f64::from(radii[0]) + f64::from(radii[1]) + precision.projection();
        let Self { half_a, half_b, basis: axes, offset: center } = *self;
        let arms = [axes.x * half_b.x, axes.y * half_b.y, axes.z * half_b.z];
        let until = Until { beyond, ..Until::met(precision) };
        let reached = distance(&Home { half: half_a }, &Guest { center, axes, arms }, towards, &until);
        Gap::of(&reached, radii, beyond, precision)
    }

    /// Not inlined, as `Posed::placed`: so that LLVM sees rows.
    #[inline(never)]
    fn fifteen(&self) -> Fifteen {
        Fifteen::new(&[self.half_a, self.half_b], &self.basis, self.offset)
    }

    /// From A to B along the normal of the face that separates them the furthest.
    fn best_face(&self, fifteen: &Fifteen) -> DVec3 {
        let (mut best, mut axis) = (f64::NEG_INFINITY, DVec3::X);
        let of_b = &fifteen.faces_b.0[..3];
        for (n, &separation) in fifteen.faces_a.iter().chain(of_b).enumerate() {
            if separation > best {
                best = separation;
                axis = if n < 3 { DVec3::AXES[n] } else { self.axis_b(n - 3) };
            }
        }
        if axis.dot(self.offset) < 0.0 { -axis } else { axis }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polyhedron::distance::{Reached, Witness};
    use crate::polyhedron::sat::tests::{Random, convex};
    use asunder_geometry::glam::Vec3;
    use asunder_geometry::{Cuboid, Pose3, Shape3};

    #[test]
    fn bricks_are_the_solids_that_cuboids_are() {
        let mut random = Random(0xB41C_0E5E_77A1);
        let (mut apart, mut overlapping, mut unclear) = (0, 0, 0);
        for case in 0..20_000_u64 {
            let size = [1e-4, 1.0, 1e4][case as usize % 3];
            let round = if case % 5 == 0 { 0.2 * size } else { 0.0 };
            let shapes = [0, 1].map(|_| {
                let half = (random.vector().abs() + Vec3::splat(0.1)) * size;
                Shape3::from(Cuboid::from_half_extents(half).unwrap().rounded(round).unwrap())
            });
            let pose_a = Pose3::new(random.vector() * 100.0, random.turn(case / 2)).unwrap();
            let away = random.vector().normalize_or(Vec3::X) * size * (4.0 * random.number().abs());
            let turned = if case % 4 == 0 { pose_a.rotation() } else { random.turn(case) };
            let pose_b = Pose3::new(pose_a.shifted(away).unwrap().position(), turned).unwrap();
            let pair = convex(&shapes[0], pose_a, &shapes[1], pose_b);
            // The same by vertices.
            let reached = pair.with_solids(|a, b| {
                let towards = pair.offset.try_normalize().unwrap_or(DVec3::X);
                distance(a, b, towards, &Until::met(&pair.precision))
            });
            match (pair.gap(f64::INFINITY), reached) {
                (Gap::Apart(apart_by), Reached::Between(Witness { distance, at_least, .. })) => {
                    let radii = f64::from(shapes[0].radius()) + f64::from(shapes[1].radius());
                    let (separation, error) = (f64::from(apart_by.separation), f64::from(apart_by.error));
                    assert!(
                        separation + error >= at_least - radii && separation - error <= distance - radii,
                        "case {case}"
                    );
                    let [on_a, on_b] = apart_by.points;
                    assert!(((on_b - on_a).length() - separation).abs() <= error, "case {case}");
                    assert!(((on_b - on_a).normalize() - apart_by.normal).length() < 1e-5, "case {case}");
                    apart += 1;
                }
                (Gap::Overlapping, Reached::Origin(_)) => overlapping += 1,
                (Gap::Overlapping, Reached::Between(witness)) => {
                    assert!(witness.at_least <= f64::from(2.0 * round), "case {case}");
                    overlapping += 1;
                }
                (Gap::Unclear, _) => unclear += 1,
                _ => panic!("case {case}"),
            }
        }
        assert!(apart > 5000 && overlapping > 3000 && unclear < 100, "{apart}, {overlapping}, {unclear}");
    }

    #[test]
    fn a_limit_ends_the_search_with_a_bound() {
        let mut random = Random(0x11A7_0F0F);
        let mut beyond = 0;
        for case in 0..3000_u64 {
            let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap());
            let away = random.vector().normalize_or(Vec3::X) * 3.7;
            let pose_b = Pose3::new(away, random.turn(case)).unwrap();
            let pair = convex(&cube, Pose3::IDENTITY, &cube, pose_b);
            let Gap::Apart(Apart { separation, error, .. }) = pair.gap(f64::INFINITY) else { continue };
            match pair.gap(f64::from(separation) * 0.8) {
                Gap::Beyond(at_least) => {
                    assert!(at_least >= separation * 0.8 * (1.0 - 1e-6), "case {case}");
                    assert!(at_least <= separation + error, "case {case}");
                    beyond += 1;
                }
                _ => panic!("case {case}"),
            }
            assert!(matches!(pair.gap(f64::from(separation) * 1.2), Gap::Apart(_)), "case {case}");
        }
        assert!(beyond > 1000, "{beyond}");
    }
}
