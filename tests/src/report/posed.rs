//! One trait for pairs in space and in the plane. Directions in the plane get z = 0.

use crate::exact_overlap::{Relation, exact_relation2, exact_relation3};
use crate::precise::{along2, along3, separation2, separation3};
use asunder_geometry::{Shape2, Shape3};
use asunder_narrow::{Pair2, Pair3, Separation2, Separation3, Verdict};
use asunder_scenes::pairs::{PosedPair2, PosedPair3};
use glam::DVec3;

/// A separation or distance as the library reports it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reported {
    /// Metres.
    pub value: f64,
    /// Metres: the promised bound of |true - value|.
    pub error: f64,
    /// From A to B.
    pub normal: DVec3,
}

/// The oracles' separation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Metres.
    pub separation: f64,
    /// Its error bound, in metres.
    pub bound: f64,
}

/// All that the library reports for a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ours {
    /// The first tier alone.
    pub guess: bool,
    /// The certain answer, and which tier gave it.
    pub verdict: Verdict,
    /// The certain answer again, from `overlaps`.
    pub overlaps: bool,
    /// `separation` without a limit; `None` if it returned only a bound.
    pub separation: Option<Reported>,
    /// `distance`.
    pub distance: Option<Reported>,
    /// The number of points of `manifold(0)`; `None` without a manifold.
    pub points: Option<usize>,
}

/// A pair that can be queried, and judged.
pub trait Posed: core::fmt::Debug + Send + Sync {
    /// Runs all of the library's queries. They must not panic; the report finds out.
    fn ours(&self) -> Ours;
    /// The first tier alone, from two posed shapes to the answer: this is timed.
    fn guess(&self) -> bool;
    /// The certain answer, from two posed shapes to the answer: this is timed.
    fn overlaps(&self) -> bool;
    /// The certain answer, and which tier gave it.
    fn verdict(&self) -> Verdict;
    /// The relation by exact arithmetic.
    fn relation(&self) -> Relation;
    /// The true separation in metres, and its error bound.
    fn truth(&self) -> Truth;
    /// The sum of the finite bounding radii, in metres. A pair of points, or a point and a half-space, has none: then
    /// the distance of their positions, which their separation is computed from.
    fn size(&self) -> f64;
    /// The separation along a reported normal, in metres: -inf where it is not that of a half-space. For compounds,
    /// that of the nearest parts.
    fn gap_along(&self, normal: DVec3) -> f64;
    /// Vertices of both bodies, which determine the time for judging.
    fn vertices(&self) -> usize;
    /// Whether both bodies are bounded and have an interior, so that they overlap exactly when they have contact
    /// points.
    fn is_solid(&self) -> bool;
    /// The pair itself if it is in space, where there is a peer.
    fn in_space(&self) -> Option<&PosedPair3>;
}

/// The sum of the finite radii; for points, the distance of their positions.
fn size(radii: [f32; 2], between: f64) -> f64 {
    let sum = radii.into_iter().filter(|radius| radius.is_finite()).map(f64::from).sum();
    if sum > 0.0 { sum } else { between }
}

fn pair3(posed: &PosedPair3) -> Pair3<'_> {
    Pair3::new(&posed.shape_a, &posed.pose_a, &posed.shape_b, &posed.pose_b)
}

fn pair2(posed: &PosedPair2) -> Pair2<'_> {
    Pair2::new(&posed.shape_a, &posed.pose_a, &posed.shape_b, &posed.pose_b)
}

fn vertices3(shape: &Shape3) -> usize {
    match shape {
        Shape3::Compound(compound) => compound.parts().iter().map(|part| vertices3(part.shape())).sum(),
        _ => shape.core().vertices().len(),
    }
}

fn vertices2(shape: &Shape2) -> usize {
    match shape {
        Shape2::Compound(compound) => compound.parts().iter().map(|part| vertices2(part.shape())).sum(),
        _ => shape.core().vertices().len(),
    }
}

fn is_solid3(shape: &Shape3) -> bool {
    match shape {
        Shape3::HalfSpace(_) | Shape3::Triangle(_) | Shape3::Segment(_) => false,
        Shape3::TriMesh(_) | Shape3::HeightField(_) => false,
        Shape3::Hull(hull) => hull.dimension() == 3 || hull.radius() > 0.0,
        Shape3::Compound(compound) => compound.parts().iter().all(|part| is_solid3(part.shape())),
        Shape3::Sphere(_) | Shape3::Capsule(_) | Shape3::Cuboid(_) => shape.outer_radius() > 0.0,
    }
}

fn is_solid2(shape: &Shape2) -> bool {
    match shape {
        Shape2::HalfPlane(_) | Shape2::Segment(_) | Shape2::Chain(_) => false,
        Shape2::Compound(compound) => compound.parts().iter().all(|part| is_solid2(part.shape())),
        Shape2::Circle(_) | Shape2::Capsule(_) | Shape2::Rect(_) | Shape2::Polygon(_) => {
            shape.outer_radius() > 0.0
        }
    }
}

impl Posed for PosedPair3 {
    fn ours(&self) -> Ours {
        let pair = pair3(self);
        let report = |value: f32, error: f32, normal: glam::Vec3| Reported {
            value: value.into(),
            error: error.into(),
            normal: normal.as_dvec3(),
        };
        Ours {
            guess: pair.guess(),
            verdict: pair.verdict(),
            overlaps: pair.overlaps(),
            separation: match pair.separation(f32::INFINITY) {
                Separation3::Measured(found) => Some(report(found.separation, found.error, found.normal)),
                Separation3::AtLeast(_) => None,
            },
            distance: pair.distance().map(|found| report(found.distance, found.error, found.normal)),
            points: pair.manifold(0.0).map(|manifold| manifold.points.len()),
        }
    }

    fn guess(&self) -> bool {
        pair3(self).guess()
    }

    fn overlaps(&self) -> bool {
        pair3(self).overlaps()
    }

    fn verdict(&self) -> Verdict {
        pair3(self).verdict()
    }

    fn relation(&self) -> Relation {
        exact_relation3((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b))
    }

    fn truth(&self) -> Truth {
        let found = separation3((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b));
        Truth { separation: found.separation, bound: found.bound }
    }

    fn size(&self) -> f64 {
        let radii = [self.shape_a.outer_radius(), self.shape_b.outer_radius()];
        size(radii, (self.pose_b.position() - self.pose_a.position()).length())
    }

    fn gap_along(&self, normal: DVec3) -> f64 {
        along3((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b), normal.as_vec3())
    }

    fn vertices(&self) -> usize {
        vertices3(&self.shape_a) + vertices3(&self.shape_b)
    }

    fn is_solid(&self) -> bool {
        is_solid3(&self.shape_a) && is_solid3(&self.shape_b)
    }

    fn in_space(&self) -> Option<&PosedPair3> {
        Some(self)
    }
}

impl Posed for PosedPair2 {
    fn ours(&self) -> Ours {
        let pair = pair2(self);
        let report = |value: f32, error: f32, normal: glam::Vec2| Reported {
            value: value.into(),
            error: error.into(),
            normal: normal.as_dvec2().extend(0.0),
        };
        Ours {
            guess: pair.guess(),
            verdict: pair.verdict(),
            overlaps: pair.overlaps(),
            separation: match pair.separation(f32::INFINITY) {
                Separation2::Measured(found) => Some(report(found.separation, found.error, found.normal)),
                Separation2::AtLeast(_) => None,
            },
            distance: pair.distance().map(|found| report(found.distance, found.error, found.normal)),
            points: pair.manifold(0.0).map(|manifold| manifold.points.len()),
        }
    }

    fn guess(&self) -> bool {
        pair2(self).guess()
    }

    fn overlaps(&self) -> bool {
        pair2(self).overlaps()
    }

    fn verdict(&self) -> Verdict {
        pair2(self).verdict()
    }

    fn relation(&self) -> Relation {
        exact_relation2((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b))
    }

    fn truth(&self) -> Truth {
        let found = separation2((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b));
        Truth { separation: found.separation, bound: found.bound }
    }

    fn size(&self) -> f64 {
        let radii = [self.shape_a.outer_radius(), self.shape_b.outer_radius()];
        size(radii, (self.pose_b.position() - self.pose_a.position()).length())
    }

    fn gap_along(&self, normal: DVec3) -> f64 {
        along2((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b), normal.truncate().as_vec2())
    }

    fn vertices(&self) -> usize {
        vertices2(&self.shape_a) + vertices2(&self.shape_b)
    }

    fn is_solid(&self) -> bool {
        is_solid2(&self.shape_a) && is_solid2(&self.shape_b)
    }

    fn in_space(&self) -> Option<&PosedPair3> {
        None
    }
}
