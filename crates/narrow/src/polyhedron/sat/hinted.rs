//! What last frame's hint holds: the axis that was the best, which is tried first, and the features that contact points
//! were made on.

use super::super::solid::Solid;
use super::facet::{Near, judge};
use super::{Axes, Axis, AxisOf, Cross};
use crate::feature::{Feature, FeatureId, Hint, OnFace};
use crate::precision::Precision;
use asunder_geometry::glam::DVec3;

/// An evaluated axis: one that a hint names, or that a walk came to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hinted {
    pub(crate) axis: Axis,
    /// The other solid's deepest vertex against the face.
    pub(super) deepest: usize,
    /// By how much the axis may show too little.
    pub(super) doubt: f64,
}

/// What is known of an evaluated axis.
#[allow(clippy::large_enum_variant, reason = "as Probe")]
pub(crate) enum Judged {
    /// It is the best; these axes hold it alone.
    Best(Axes),
    /// It is not, or hardly: along this unit direction the solids overlap less deeply, or too close to call.
    Beaten(DVec3),
    Open,
}

impl Hinted {
    /// Evaluates the axis that a hint names; `None` where this pair has no such axis.
    pub(crate) fn new((a, b): (&Solid, &Solid), hint: Hint, precision: &Precision) -> Option<Self> {
        let of = match axis_in(hint)? {
            // A hint from other shapes may name a half-edge that does not stand for its edge here.
            AxisOf::Edges(edge_a, edge_b) if a.has_edge(edge_a as u32) && b.has_edge(edge_b as u32) => {
                AxisOf::Edges(a.topology.edge_of(edge_a), b.topology.edge_of(edge_b))
            }
            of => of,
        };
        Self::at((a, b), of, precision)
    }

    /// Evaluates the axis of these features; `None` where this pair has no such axis.
    pub(super) fn at((a, b): (&Solid, &Solid), of: AxisOf, precision: &Precision) -> Option<Self> {
        let (normal, doubt) = match of {
            AxisOf::FaceA(face) if a.has_face(face as u32) => (a.normal(face), precision.of_face()),
            AxisOf::FaceB(face) if b.has_face(face as u32) => (-b.normal(face), precision.of_face()),
            AxisOf::Edges(edge_a, edge_b) if a.has_edge(edge_a as u32) && b.has_edge(edge_b as u32) => {
                let at_a = (a.edge_direction(edge_a), a.out_of_edge(edge_a));
                let cross = Cross::outwards(at_a, b.edge_direction(edge_b), || b.out_of_edge(edge_b));
                if cross.is_noise() {
                    return None;
                }
                (cross.axis / cross.axis.length(), precision.of_edges(cross.squared_sine()))
            }
            _ => return None,
        };
        let (reach, deepest) = match of {
            AxisOf::FaceA(face) => (a.face_reach(face, normal), b.support(-normal)),
            AxisOf::FaceB(face) => (b.face_reach(face, -normal), a.support(normal)),
            AxisOf::Edges(..) => (a.support(normal).reach, b.support(-normal)),
        };
        let axis = Axis { separation: -deepest.reach - reach, normal, of };
        Some(Self { axis, deepest: deepest.vertex, doubt })
    }

    /// Whether it is the best axis of solids that overlap along it. If so, they do overlap.
    pub(crate) fn judged(&self, (a, b): (&Solid, &Solid), precision: &Precision) -> Judged {
        match judge((a, b), &self.axis, self.deepest, precision) {
            Near::Nearest(uneven) => {
                let mut axes = Axes::NONE;
                axes.offer(self.axis);
                axes.raise(self.axis.separation, self.doubt + uneven);
                Judged::Best(axes)
            }
            Near::Beaten(direction) => Judged::Beaten(direction),
            Near::Open => Judged::Open,
        }
    }
}

/// The hint that names an axis.
pub(crate) fn hint_of(axis: &Axis) -> Hint {
    hint_to(axis.of)
}

/// The hint that names the features of an axis.
#[inline]
pub(crate) fn hint_to(of: AxisOf) -> Hint {
    Hint::axis(match of {
        AxisOf::FaceA(face) => FeatureId::new(Feature::Face(face as u32), Feature::Vertex(0)),
        AxisOf::FaceB(face) => FeatureId::new(Feature::Vertex(0), Feature::Face(face as u32)),
        AxisOf::Edges(a, b) => FeatureId::new(Feature::Edge(a as u32), Feature::Edge(b as u32)),
    })
}

/// The features that a hint names as those of last frame's axis; the hint may come from other shapes.
#[inline]
fn axis_in(hint: Hint) -> Option<AxisOf> {
    let features = hint.features()?;
    match (features.a(), features.b()) {
        (Feature::Face(face), _) => Some(AxisOf::FaceA(face as usize)),
        (_, Feature::Face(face)) => Some(AxisOf::FaceB(face as usize)),
        (Feature::Edge(a), Feature::Edge(b)) => Some(AxisOf::Edges(a as usize, b as usize)),
        _ => None,
    }
}

/// The features that a hint says last frame's contact points were made on; the hint may come from other shapes.
#[inline]
pub(crate) fn last_of(hint: Hint) -> Option<AxisOf> {
    match hint.points_on() {
        Some(OnFace::OfA(face)) => Some(AxisOf::FaceA(face as usize)),
        Some(OnFace::OfB(face)) => Some(AxisOf::FaceB(face as usize)),
        None => axis_in(hint),
    }
}

/// A hint that also names the features that contact points were made on, where those are not its axis' own.
pub(crate) fn hint_with(hint: Hint, points_on: AxisOf) -> Hint {
    if axis_in(hint) == Some(points_on) {
        return hint;
    }
    match points_on {
        AxisOf::FaceA(face) => hint.with_points_on(Some(OnFace::OfA(face as u32))),
        AxisOf::FaceB(face) => hint.with_points_on(Some(OnFace::OfB(face as u32))),
        AxisOf::Edges(..) => hint_to(points_on),
    }
}
