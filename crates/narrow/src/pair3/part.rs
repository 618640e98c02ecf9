//! Convex parts of bodies.

use crate::among::{MANY, Region3, in_order};
use crate::exact::Site3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Aabb3, Basis3, Compound3, Part3, Pose3, Shape3};
use core::ops::ControlFlow;

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

    /// The part of a shape whose box is nearest to a point, in metres and world axes from the body's position.
    pub(super) fn nearest(shape: &'a Shape3, basis: &Basis3, point: DVec3) -> Self {
        let whole = Self::whole(shape, basis);
        let Shape3::Compound(compound) = shape else { return whole };
        let point = basis.turn_back(point).as_vec3();
        let mut nearest = 0;
        compound.visit_nearest(&Aabb3::new(point, point), f64::INFINITY, |part| {
            nearest = part;
            // That is enough.
            -1.0
        });
        compound.parts().get(nearest as usize).map_or(whole, |part| Self::of(part, nearest, basis))
    }

    pub(crate) fn of(part: &'a Part3, index: u32, basis: &Basis3) -> Self {
        let center = basis.turn(part.center());
        Self { index, shape: part.shape(), local: Some(part.pose()), center }
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
    compound.parts().iter().zip(0..).any(|(part, index)| visit(Part::of(part, index, basis)))
}

/// A compound of so many parts that its tree is asked.
pub(super) fn of_many(shape: &Shape3) -> Option<&Compound3> {
    match shape {
        Shape3::Compound(compound) if compound.parts().len() >= MANY => Some(compound),
        _ => None,
    }
}

/// Visits parts roughly in the order of their distance from a region, as the body's position sees it in world axes, up to a limit in
/// metres that the visitor may lower: it returns the new one.
pub(super) fn for_nearest_parts<'a>(
    compound: &'a Compound3,
    basis: &Basis3,
    Region3 { from, radius, .. }: Region3,
    limit: f64,
    mut visit: impl FnMut(Part<'a>) -> f64,
) {
    let local = Region3::ball(basis.turn_back(from), radius);
    compound.visit_nearest(&local.bounds(compound), limit, |index| {
        let part = compound.parts().get(index as usize);
        part.map_or(limit, |part| visit(Part::of(part, index, basis)))
    });
}

/// As [`for_parts_in`], of a region that does not move, and in any order: the first that is found may be enough.
pub(super) fn for_parts_near<'a>(
    shape: &'a Shape3,
    basis: &Basis3,
    region: impl FnOnce() -> Region3,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Some(compound) = of_many(shape) else { return for_parts(shape, basis, visit) };
    let Region3 { from, radius, .. } = region();
    let local = Region3::ball(basis.turn_back(from), radius);
    let visit = |index: u32| match compound.parts().get(index as usize) {
        Some(part) if visit(Part::of(part, index, basis)) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    compound.visit_near(&local.bounds(compound), visit).is_break()
}

/// As [`for_parts`], in the same order, but for parts of a compound of many that are certainly not in a region, as the body's
/// position sees it in world axes.
pub(crate) fn for_parts_in<'a>(
    shape: &'a Shape3,
    basis: &Basis3,
    region: impl FnOnce() -> Region3,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    if let Some(compound) = of_many(shape) {
        let Region3 { from, way, radius } = region();
        let local = Region3 { from: basis.turn_back(from), way: basis.turn_back(way), radius };
        if local.is_bounded() {
            let part = |index: u32| Some(Part::of(compound.parts().get(index as usize)?, index, basis));
            return in_order(|find| local.walk(compound, find), |index| part(index).is_some_and(&mut visit));
        }
    }
    for_parts(shape, basis, visit)
}
