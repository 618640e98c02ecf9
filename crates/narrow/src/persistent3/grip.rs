//! What holds a contact point on ground, and how it rises as the body moves.

use super::flat::NearPoints;
use super::hold::{Edge, face_normal, inside};
use crate::answer::{ContactPoint3, Manifold3};
use crate::feature::Feature;
use crate::ground3::OnGround;
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::SAME_NORMAL;

/// How a point rises by how the body's matter there moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Grip {
    /// In world axes.
    gradient: Vec3,
    /// By how much that differs from the normal.
    lean: f32,
    /// Whether the point stays where it is on ground.
    is_of_ground: bool,
}

/// Cosine of the angle between a normal and what a point is measured from, above which it is.
const LEAST_COSINE: f64 = 0.125;

impl Grip {
    pub(super) const NONE: Self = Self { gradient: Vec3::ZERO, lean: 0.0, is_of_ground: false };

    /// What holds a point, and by how much what it slides on may rise beside it, as a share of the way, once it leaves its
    /// features within the reach; nothing where nobody knows what holds it.
    pub(super) fn of(
        on: &OnGround,
        manifold: &Manifold3,
        point: &ContactPoint3,
        (near, reach): (&NearPoints, f32),
    ) -> Option<(Self, f64)> {
        let (normal, reach) = (on.towards(manifold), f64::from(reach));
        let [of_body, of_ground] = on.in_body_order([point.feature.a(), point.feature.b()]);
        let [on_body, foot] = on.ends(manifold, point);
        let (local, foot) = (on.body_basis.turn_back(on_body), on.basis.turn_back(foot));
        let normal_there = on.basis.turn_back(normal);
        match (of_body, of_ground) {
            (Feature::Vertex(_), Feature::Face(patch)) => {
                // Kernels may tell of it along another normal than the triangle's own.
                let [a, b, c] = near.under(foot, normal_there, Some(patch))?;
                let own = (b - a).cross(c - a).try_normalize()?;
                let bend = near.bend_around(foot, (own, patch), reach);
                Some((Self::along(on.basis.turn(own), normal, false)?, bend))
            }
            (Feature::Vertex(_), _) if matches!(on.body, Shape3::Sphere(_)) => {
                Some((Self::along(normal, normal, true)?, 0.0))
            }
            (Feature::Face(face), Feature::Vertex(_)) => {
                let out = on.body_basis.turn(face_normal(on.body, face as usize)?);
                let is_over = inside(on.body, face as usize, local) >= reach;
                Some((Self::along(out, normal, true)?, if is_over { 0.0 } else { 1.0 }))
            }
            (Feature::Edge(own), Feature::Edge(theirs)) => {
                let own = Edge::of(on.body, own)?;
                let [from, stop] = near.edge(theirs)?;
                let along = on.basis.turn((stop - from).try_normalize()?);
                let across = on.body_basis.turn(own.along).cross(along);
                let place = own.along.dot(local - own.from);
                // How far either end is at least: it slides along by no more than the drift over the sine.
                let ends =
                    place.min(own.length - place).min((foot - from).length()).min((foot - stop).length());
                let bend = match on.body {
                    _ if ends * across.length() >= 2.0 * reach => 0.0,
                    // From one side of its lowest face to the next.
                    Shape3::Cuboid(_) => {
                        near.bend_at(theirs, normal_there) + tilt_of(on.body_basis.turn_back(normal))
                    }
                    _ => 1.0,
                };
                Some((Self::along(across, normal, false)?, bend))
            }
            _ => None,
        }
    }

    /// Of what is measured along a normal from what this direction is square to.
    fn along(direction: DVec3, normal: DVec3, is_of_ground: bool) -> Option<Self> {
        let cosine = direction.dot(normal);
        let gradient = direction / Some(cosine).filter(|cosine| cosine.abs() >= LEAST_COSINE)?;
        // Triangles of one patch are in one plane up to their rounding.
        let lean = (gradient - normal).length();
        let lean = if lean <= SAME_NORMAL { 0.0 } else { (lean as f32).next_up() };
        Some(Self { gradient: gradient.as_vec3(), lean, is_of_ground })
    }

    #[inline(always)]
    pub(super) fn rise(&self, way: DVec3) -> f64 {
        self.gradient.as_dvec3().dot(way)
    }

    pub(super) const fn is_of_ground(&self) -> bool {
        self.is_of_ground
    }

    pub(super) const fn lean(&self) -> f32 {
        self.lean
    }

    /// A bound on the length of the gradient.
    pub(super) const fn steep(&self) -> f32 {
        1.0 + self.lean
    }

    /// Whether it can be one: of what was read from a file.
    pub(super) fn is_sound(&self) -> bool {
        let most = 2.0 / LEAST_COSINE as f32;
        self.gradient.is_finite() && self.gradient.length() <= most && (0.0..=most).contains(&self.lean)
    }
}

/// The sine of the angle between a unit direction and the axis of a cuboid that is nearest to it, in its axes.
fn tilt_of(direction: DVec3) -> f64 {
    let cosine = direction.abs().max_element();
    (1.0 - cosine * cosine).max(0.0).sqrt()
}
