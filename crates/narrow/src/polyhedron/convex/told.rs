//! Shapes whose distance has a closed form: half-spaces, and points and segments among themselves.

use super::{Convex, Evidence, Near, Probe};
use crate::answer::{Tier, Verdict};
use crate::exact;
use crate::feature::Hint;
use crate::polyhedron::half_space::Plane;
use crate::polyhedron::slender;
use crate::polyhedron::solid::Solid;
use crate::precision::{at_least, signed};
use asunder_geometry::glam::DVec3;

/// What a kernel in closed form says of two shapes.
pub(super) struct Told {
    pub(super) separation: f64,
    /// A lower bound on it.
    at_least: f64,
    /// Unit axis from A to B.
    normal: DVec3,
    /// Closest points on the surfaces; they mean nothing in overlap.
    closest: [DVec3; 2],
    evidence: Evidence,
}

impl Convex<'_> {
    pub(super) fn told_half_spaces(&self, a: Plane, b: Plane) -> Told {
        let separation = a.separation_from(&b, || exact::are_opposed3([&self.sites[0], &self.sites[1]]));
        Told {
            separation,
            at_least: separation,
            normal: a.axis(),
            closest: a.points_with(&b),
            evidence: Evidence::HalfSpaces(a, b),
        }
    }

    pub(super) fn told_half_space(&self, plane: Plane) -> Told {
        let (vertex, height) = self.with_solids(|a, b| {
            let core = if plane.is_b { a } else { b };
            let (vertex, height) = plane.lowest(core);
            (core.point(vertex), height)
        });
        let separation = height - self.radii;
        let on_shape = vertex - plane.normal * self.radii;
        let on_plane = vertex - plane.normal * height;
        let closest = if plane.is_b { [on_shape, on_plane] } else { [on_plane, on_shape] };
        let evidence = Evidence::HalfSpace(plane);
        Told { separation, at_least: separation, normal: plane.axis(), closest, evidence }
    }

    pub(super) fn told_slender(&self, a: &Solid, b: &Solid) -> Told {
        let nearest = slender::nearest(a, b, self.precision.projection());
        Told {
            separation: nearest.distance - self.radii,
            at_least: nearest.at_least - self.radii,
            normal: nearest.normal,
            closest: self.on_surfaces([nearest.on_a, nearest.on_b], nearest.normal),
            evidence: Evidence::Slender(nearest),
        }
    }

    /// Whether the shapes overlap, where closed-form kernels have told two bounds.
    pub(super) fn told_verdict(&self, told: &Told) -> Verdict {
        let doubt = 2.0 * self.precision.projection();
        if told.at_least > doubt || told.separation < -doubt {
            return Verdict { overlapping: told.separation < 0.0, tier: Tier::Bound };
        }
        self.exactly(&[])
    }

    /// What a kernel without axes to try has told, within the limit.
    pub(super) fn told(&self, told: Told, limit: f64) -> Probe {
        let precision = self.precision;
        if told.at_least > limit + precision.projection() {
            return Probe::Beyond(at_least(told.at_least, &precision), Hint::NONE);
        }
        let verdict = self.told_verdict(&told);
        let Told { separation, at_least: bound, normal, closest, evidence } = told;
        // Half-spaces that overlap without end do so exactly.
        let is_endless = separation == f64::NEG_INFINITY;
        let error = if is_endless { 0.0 } else { precision.of_distance(separation, separation - bound) };
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error,
            normal,
            closest: (!verdict.overlapping).then_some(closest),
            hint: Hint::NONE,
            evidence,
        })
    }
}
