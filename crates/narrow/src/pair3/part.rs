//! Convex parts of bodies.

use crate::exact::Site3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Pose3, Shape3};

/// A convex part of a body, as the body stands.
#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) index: u32,
    pub(crate) shape: &'a Shape3,
    /// Where it is in its compound; a shape that is none is its own only part.
    local: Option<&'a Pose3>,
    /// Its bounding sphere's centre less the body's position, in world axes.
    pub(crate) center: DVec3,
}

impl<'a> Part<'a> {
    /// A shape as a part of nothing: a compound by its bounding sphere alone.
    pub(crate) fn whole(shape: &'a Shape3, basis: &Basis3) -> Self {
        let center = basis.turn(shape.center().as_dvec3());
        Self { index: 0, shape, local: None, center }
    }

    /// Whether its axes are not its body's.
    pub(super) fn is_turned(&self) -> bool {
        self.local.is_some_and(|pose| pose.rotation().to_array()[..3] != [0.0; 3])
    }

    /// Shape and poses as they were given, for exact questions.
    pub(crate) fn site(&self, body: &Pose3) -> Site3<'a> {
        Site3 { shape: self.shape, body: *body, part: self.local }
    }

    /// Its axes in the world, and its origin less the body's position.
    pub(crate) fn placed(&self, body: &Basis3) -> (Basis3, DVec3) {
        let Some(pose) = self.local else { return (*body, DVec3::ZERO) };
        let local = pose.basis();
        let basis = Basis3 { x: body.turn(local.x), y: body.turn(local.y), z: body.turn(local.z) };
        (basis, body.turn(pose.position()))
    }
}

/// Visits the convex parts of a shape until the visitor says to stop; returns whether it did.
pub(crate) fn for_parts<'a>(
    shape: &'a Shape3,
    basis: &Basis3,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Shape3::Compound(compound) = shape else {
        return visit(Part::whole(shape, basis));
    };
    compound.parts().iter().zip(0..).any(|(part, index)| {
        let center = basis.turn(part.center());
        visit(Part { index, shape: part.shape(), local: Some(part.pose()), center })
    })
}
