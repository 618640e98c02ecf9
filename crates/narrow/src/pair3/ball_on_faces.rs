//! A sphere over a face, an edge or a corner of a triangle or a hull, neither a part of a compound: the answers in
//! closed form, in the axes of the shape with faces.

use super::Pair3;
use super::balls::ClosedForm;
use crate::feature::{Feature, FeatureId};
use crate::precision::Precision;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::SAME_PLACE;
use asunder_geometry::{Basis3, Shape3};

/// A sphere and a triangle or a hull, with their poses.
pub(super) struct BallOnFaces<'p> {
    pub(super) pair: &'p Pair3<'p>,
    /// The shape with faces.
    pub(super) shape: &'p Shape3,
    /// Its axes in the world.
    pub(super) basis: Basis3,
    pub(super) nearest: Nearest,
    /// The sphere's radius, in metres.
    pub(super) radius: f64,
    /// Whether the shape with faces is B.
    pub(super) is_b: bool,
    pub(super) precision: Precision,
}

/// The place of a core that is nearest to a point, in the core's axes.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    pub(super) foot: DVec3,
    /// Unit direction out of the core; towards the point, if that is outside.
    pub(super) outwards: DVec3,
    pub(super) feature: Feature,
    /// From the foot to the point, in metres; below zero inside the core.
    pub(super) distance: f64,
    /// By how much the distance may be off because a face is not quite flat.
    pub(super) slack: f64,
}

impl BallOnFaces<'_> {
    /// The nearest feature. A place inside a face is named after a corner or an edge near it, as in a patch of two
    /// faces.
    fn named(&self) -> Feature {
        let Feature::Face(face) = self.nearest.feature else { return self.nearest.feature };
        let smaller = self.radius.min(self.shape.outer_radius().into());
        let near = self.precision.share(SAME_PLACE, smaller);
        let core = self.shape.core();
        let (topology, corners) = (core.topology(), core.vertices());
        let (mut vertex, mut edge) = ((near, None), (near, None));
        for half_edge in topology.face_half_edges(face as usize) {
            let (from, to) = topology.ends(half_edge);
            let (start, end) = (corners[from].as_dvec3(), corners[to].as_dvec3());
            let (away, along) = (self.nearest.foot - start, end - start);
            let from_line = away.cross(along).length() / along.length();
            if away.length() < vertex.0 {
                vertex = (away.length(), Some(Feature::Vertex(from as u32)));
            }
            if from_line < edge.0 {
                edge = (from_line, Some(Feature::Edge(topology.edge_of(half_edge) as u32)));
            }
        }
        vertex.1.or(edge.1).unwrap_or(self.nearest.feature)
    }
}

impl ClosedForm for BallOnFaces<'_> {
    #[inline]
    fn pair(&self) -> &Pair3<'_> {
        self.pair
    }

    #[inline]
    fn separation(&self) -> f64 {
        self.nearest.distance - (self.radius + f64::from(self.shape.radius()))
    }

    #[inline]
    fn slack(&self) -> f64 {
        self.nearest.slack
    }

    #[inline]
    fn precision(&self) -> &Precision {
        &self.precision
    }

    #[inline]
    fn normal(&self) -> Vec3 {
        let outwards = self.basis.turn(self.nearest.outwards);
        (if self.is_b { -outwards } else { outwards }).as_vec3()
    }

    #[inline]
    fn anchors(&self) -> [Vec3; 2] {
        let Nearest { foot, outwards, .. } = self.nearest;
        let on_sphere = self.basis.turn(outwards * -self.radius).as_vec3();
        let on_shape = self.basis.turn(foot + outwards * f64::from(self.shape.radius())).as_vec3();
        if self.is_b { [on_sphere, on_shape] } else { [on_shape, on_sphere] }
    }

    fn feature(&self) -> FeatureId {
        let (of_shape, of_sphere) = (self.named(), Feature::Vertex(0));
        if self.is_b { FeatureId::new(of_sphere, of_shape) } else { FeatureId::new(of_shape, of_sphere) }
    }

    #[inline]
    fn is_from_b(&self) -> bool {
        self.is_b
    }
}
