//! The two features that hold a contact point on ground, and how it rises as the body moves.

use super::flat::NearPoints;
use super::hold::{Edge, face_normal, inside};
use crate::answer::{ContactPoint3, Manifold3};
use crate::feature::Feature;
use crate::ground3::OnGround;
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};

/// How a point rises with the motion of the body's matter there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Grip {
    /// The gradient of the rise, in world axes.
    gradient: Vec3,
    /// By how much the gradient differs from the normal.
    lean: f32,
    /// What the point stays on.
    place: Place,
}

/// What a point stays on while the body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Place {
    /// The same place on the body.
    Body,
    /// The same place on ground.
    Ground,
    /// An edge of each: it slides along both ([`Slide`]).
    Edges,
}

/// How a point slides along an edge of the body where that crosses an edge of ground.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Slide {
    /// The direction of the body's edge, in world axes.
    along: Vec3,
    /// How far back along it a motion leads the point, as a gradient.
    back: Vec3,
    /// How far the body's edge reaches from the point, back and on, in metres.
    ends: [f32; 2],
}

/// Where a point may leave the features that hold it: how far the body may move before, in metres, and the error
/// charged beyond that, as a share of the whole motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seam {
    pub(super) free: f64,
    pub(super) cost: f64,
}

impl Seam {
    /// Nowhere.
    pub(super) const NONE: Self = Self { free: f64::INFINITY, cost: 0.0 };

    /// How far the body may move if the error may grow by `most` metres.
    pub(super) fn reach(&self, most: f64) -> f64 {
        self.free.max(most / self.cost)
    }
}

/// The cost where the next feature is unknown: the true separation may have changed by the whole motion one way, and
/// the reported one by as much the other way.
pub(super) const UNKNOWN: f64 = 2.0;

/// Least cosine of the angle between the manifold's normal and the normal of what a point is measured from, for a point
/// that is kept.
const LEAST_COSINE: f64 = 0.125;

/// What rounding a unit vector to f32 may turn it by.
const ROUNDED: f64 = f32::EPSILON as f64;

impl Grip {
    pub(super) const NONE: Self = Self { gradient: Vec3::ZERO, lean: 0.0, place: Place::Body };

    /// The grip of a point, and where it may leave it; `None` where it is not known what holds the point.
    pub(super) fn of(
        on: &OnGround,
        manifold: &Manifold3,
        point: &ContactPoint3,
        (near, reach): (&NearPoints, f32),
    ) -> Option<(Self, Seam, Option<Slide>)> {
        let (normal, reach) = (on.towards(manifold), f64::from(reach));
        if matches!(on.body, Shape3::Sphere(_)) {
            // Whatever ground is under it next, the normal turns by no more than the motion over the distance from the
            // centre to that ground: the ball's curvature, which `Grounded::loss` charges for.
            return Some((Self::along(normal, normal, Place::Body)?, Seam::NONE, None));
        }
        let [of_body, of_ground] = on.in_order([point.feature.a(), point.feature.b()]);
        let [on_body, foot] = on.ends(manifold, point);
        let (local, foot) = (on.body_basis.turn_back(on_body), on.basis.turn_back(foot));
        let normal_there = on.basis.turn_back(normal);
        let mut slide = None;
        let (grip, seam) = match (of_body, of_ground) {
            (Feature::Vertex(_), Feature::Face(patch)) => {
                // Kernels may report it along a normal other than the triangle's.
                let [a, b, c] = near.under(foot, normal_there, Some(patch))?;
                let own = (b - a).cross(c - a).try_normalize()?;
                let seam = near.seam_around(foot, (own, patch), reach);
                (Self::along(on.basis.turn(own), normal, Place::Body)?, seam)
            }
            (Feature::Face(face), Feature::Vertex(_)) => {
                let out = on.body_basis.turn(face_normal(on.body, face as usize)?);
                let free = inside(on.body, face as usize, local);
                (Self::along(out, normal, Place::Ground)?, Seam { free, cost: UNKNOWN })
            }
            (Feature::Edge(own), Feature::Edge(theirs)) => {
                let own = Edge::of(on.body, own)?;
                let [from, stop] = near.edge(theirs)?;
                let (along, theirs_along) =
                    (on.body_basis.turn(own.along), on.basis.turn((stop - from).try_normalize()?));
                let across = along.cross(theirs_along);
                let (sine, from_start) = (across.length(), own.along.dot(local - own.from));
                // A lower bound on the distance to any end: the crossing slides by no more than the drift over the
                // sine.
                let ends = from_start
                    .min(own.length - from_start)
                    .min((foot - from).length())
                    .min((foot - stop).length());
                let around = match on.body {
                    Shape3::Cuboid(_) => around_corner(on.body_basis.turn_back(normal), sine)
                        .zip(near.bend_at(theirs, normal_there)),
                    _ => None,
                };
                let cost = around.map_or(UNKNOWN, |(corner, bend)| corner + bend);
                slide = Slide::of([along, theirs_along], normal, [from_start, own.length - from_start]);
                let place = if slide.is_some() { Place::Edges } else { Place::Body };
                (Self::along(across, normal, place)?, Seam { free: 0.5 * ends * sine, cost })
            }
            _ => return None,
        };
        // Along a normal that leans, a point moves further than the body does.
        let free = seam.free / f64::from(grip.steep());
        let seam = if free >= reach { Seam::NONE } else { Seam { free: free.max(0.0), ..seam } };
        Some((grip, seam, slide))
    }

    /// For a point measured along a normal, from a plane that `direction` is square to.
    fn along(direction: DVec3, normal: DVec3, place: Place) -> Option<Self> {
        let cosine = direction.dot(normal);
        let gradient = direction / Some(cosine).filter(|cosine| cosine.abs() >= LEAST_COSINE)?;
        // The manifold's normal is rounded to f32.
        let lean = (gradient - normal).length();
        let lean = if lean <= ROUNDED { 0.0 } else { (lean as f32).next_up() };
        Some(Self { gradient: gradient.as_vec3(), lean, place })
    }

    #[inline(always)]
    pub(super) fn rise(&self, way: DVec3) -> f64 {
        self.gradient.as_dvec3().dot(way)
    }

    pub(super) const fn place(&self) -> Place {
        self.place
    }

    pub(super) const fn lean(&self) -> f32 {
        self.lean
    }

    /// A bound on the length of the gradient.
    pub(super) const fn steep(&self) -> f32 {
        1.0 + self.lean
    }

    /// Whether it is a possible one: for data that was read from a file.
    pub(super) fn is_sound(&self) -> bool {
        let most = 2.0 / LEAST_COSINE as f32;
        self.gradient.is_finite() && self.gradient.length() <= most && (0.0..=most).contains(&self.lean)
    }
}

impl Slide {
    /// Along the body's edge e, which reaches this far back and on. With the edge v of ground, a motion u leads the
    /// crossing back by e (u . w) / (e . w), where w = v x n is square to v and to the normal. Only the body's edge is
    /// bounded: at an end of the ground's, its line most often goes on. `None` where the edges do not cross.
    fn of([edge, other]: [DVec3; 2], normal: DVec3, ends: [f64; 2]) -> Option<Self> {
        let across = other.cross(normal);
        let back = (across / edge.dot(across)).as_vec3();
        let ends = ends.map(|end| end.max(0.0) as f32);
        back.is_finite().then_some(Self { along: edge.as_vec3(), back, ends })
    }

    /// How far the point slides along the body for a motion of the matter there: no further than to an end.
    pub(super) fn by(&self, way: DVec3) -> DVec3 {
        let [back, on] = self.ends.map(f64::from);
        // Not `clamp`, which may panic.
        self.along.as_dvec3() * (-self.back.as_dvec3().dot(way)).max(-back).min(on)
    }

    /// Whether it is a possible one for a body that reaches this far: for data that was read from a file.
    pub(super) fn is_sound(&self, arm: f32) -> bool {
        let is_end = |end: &f32| (0.0..=4.0 * arm).contains(end);
        self.along.is_finite()
            && self.along.length() <= 2.0
            && self.back.is_finite()
            && self.ends.iter().all(is_end)
    }
}

/// The cost, as a share of the motion, where an edge of ground stops crossing one side of a cuboid's face, at an angle
/// of this sine, and crosses the next: both crossings are on the face, the motion over the sine and over the cosine
/// from its corner. How steep the face is follows from the normal in the cuboid's axes. `None` where the edge is nearly
/// along either side.
fn around_corner(normal: DVec3, sine: f64) -> Option<f64> {
    let cosine = (1.0 - sine * sine).max(0.0).sqrt();
    let level = normal.abs().max_element();
    let steep = (1.0 - level * level).max(0.0).sqrt() / level;
    (sine.min(cosine) >= LEAST_COSINE).then(|| steep * (1.0 / sine + 1.0 / cosine))
}
