//! The closest points of two cuboids that do not overlap.
//!
//! ```text
//! spheres apart   towards each other's centre
//! else            all fifteen axes at once: none parts them, or towards each other along the face that parts them the furthest
//! from there on   as any two solids                                                                     (distance)
//! ```
//! No vertices and no faces are put together for it: what is furthest along a direction has its signs, and a corner is three signs.

use super::Cuboids;
use super::fifteen::{Fifteen, closed_form};
use super::placed::{Posed, Size};
use crate::answer::Closest3;
use crate::polyhedron::distance::{Polytope, Until, distance};
use crate::polyhedron::gap::{Apart, Gap};
use crate::polyhedron::solid::corner_along;
use crate::precision::Precision;
use asunder_geometry::Basis3;
use asunder_geometry::glam::DVec3;

/// Which sides of the three axes a corner is on. Looked up: asked of a corner's bits, each would be a branch that nobody can guess,
/// and a pair 1.6 times as slow (AMD EPYC, Zen 4, 2026-11-26).
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

/// B as A sees it: its centre, its axes, and the ways from there to three of its faces.
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
    /// The closest points, or that there are none since they overlap; nothing where that takes a closer look.
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
    /// Whether they have a gap between them, and where it is the narrowest, if that is no more than a limit in metres. They are rounded
    /// by such radii.
    pub(crate) fn gap(&self, radii: [f32; 2], limit: f64, precision: &Precision) -> Gap {
        let apart = self.offset.length();
        let towards = if apart > precision.size + precision.projection() {
            self.offset / apart
        } else {
            let fifteen = self.fifteen();
            let (top, doubt) = (fifteen.top(), closed_form(precision));
            if top < -doubt {
                return Gap::Overlapping;
            }
            if top <= doubt {
                return Gap::Unclear;
            }
            self.best_face(&fifteen)
        };
        self.gap_along(towards, radii, limit, precision)
    }

    /// The same of cuboids whose cores are apart, sought from a unit axis on.
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

    /// As in `Posed::placed`: out of line, for LLVM to see rows.
    #[inline(never)]
    fn fifteen(&self) -> Fifteen {
        Fifteen::new(&[self.half_a, self.half_b], &self.basis, self.offset)
    }

    /// From A to B along the face that parts them the furthest.
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
