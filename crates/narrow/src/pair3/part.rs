//! Convex parts of bodies.

use crate::among::{Region3, in_order, many3};
use crate::exact::Site3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Aabb3, Basis3, Compound3, Pose3, Shape3};
use core::ops::ControlFlow;

/// A convex part of a body, in the body's current pose.
#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) index: u32,
    pub(crate) shape: &'a Shape3,
    /// Its pose in its compound; `None` for a whole shape, which is its own only part.
    local: Option<&'a Pose3>,
    /// Its bounding sphere's centre less the body's position, in world axes.
    pub(crate) center: DVec3,
}

impl<'a> Part<'a> {
    /// A whole shape as its own only part; of a compound, only the bounding sphere is of use.
    pub(crate) fn whole(shape: &'a Shape3, basis: &Basis3) -> Self {
        let center = basis.turn(shape.center().as_dvec3());
        Self { index: 0, shape, local: None, center }
    }

    /// The part of a shape whose box is nearest to a point, which is in metres and world axes from the body's position.
    pub(super) fn nearest(shape: &'a Shape3, basis: &Basis3, point: DVec3) -> Self {
        let Shape3::Compound(compound) = shape else { return Self::whole(shape, basis) };
        let point = basis.turn_back(point).as_vec3();
        let mut nearest = 0;
        compound.visit_nearest(&Aabb3::new(point, point), f64::INFINITY, |part| {
            nearest = part;
            // A negative limit ends the search.
            -1.0
        });
        Self::of(compound, nearest, basis)
    }

    /// A part of a compound, by its index.
    pub(crate) fn of(compound: &'a Compound3, index: u32, basis: &Basis3) -> Self {
        let part = &compound.parts()[index as usize];
        Self { index, shape: part.shape(), local: Some(part.pose()), center: basis.turn(part.center()) }
    }

    /// Whether its axes differ from its body's.
    pub(super) fn is_turned(&self) -> bool {
        self.local.is_some_and(|pose| pose.rotation().to_array()[..3] != [0.0; 3])
    }

    /// Shape and poses as they were given, for exact tests.
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
    (0..compound.parts().len() as u32).any(|index| visit(Part::of(compound, index, basis)))
}

/// Like [`for_parts`], in the same order, but of a compound of many parts leaves out those that are certainly outside a
/// region. The region is in world axes, relative to the body's position.
pub(super) fn for_parts_in<'a>(
    shape: &'a Shape3,
    basis: &Basis3,
    region: impl FnOnce() -> Region3,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Some(compound) = many3(shape) else { return for_parts(shape, basis, visit) };
    let bounds = region().turned_back(basis).bounds(compound);
    let walk = |numbers: &mut Vec<u32>| {
        let _ = compound.visit_near(&bounds, |index| {
            numbers.push(index);
            ControlFlow::Continue(())
        });
    };
    in_order(walk, |index| visit(Part::of(compound, index, basis)))
}

/// The same in any order, for searches where the first that is found may be enough.
pub(super) fn for_parts_near<'a>(
    shape: &'a Shape3,
    basis: &Basis3,
    region: impl FnOnce() -> Region3,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Some(compound) = many3(shape) else { return for_parts(shape, basis, visit) };
    let bounds = region().turned_back(basis).bounds(compound);
    let is_enough = |index: u32| match visit(Part::of(compound, index, basis)) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    compound.visit_near(&bounds, is_enough).is_break()
}

/// Visits the parts of a compound in the order of their indices, without those that are certainly outside a region
/// swept along `way`, up to the fraction `until` of it. Both are in world axes, relative to the body's position.
pub(crate) fn for_parts_along<'a>(
    compound: &'a Compound3,
    basis: &Basis3,
    (region, way): (Region3, DVec3),
    until: f64,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let (local, way) = (region.turned_back(basis), basis.turn_back(way));
    let walk = |numbers: &mut Vec<u32>| {
        compound.visit_along(local.center, way, local.grown(way, compound), until, |index| {
            numbers.push(index);
            until
        });
    };
    in_order(walk, |index| visit(Part::of(compound, index, basis)))
}

/// Visits parts roughly in the order of their distance from a region, up to a limit in metres, which the visitor may
/// lower: it returns the new one. The region is in world axes, relative to the body's position.
pub(super) fn for_nearest_parts<'a>(
    compound: &'a Compound3,
    basis: &Basis3,
    region: Region3,
    limit: f64,
    mut visit: impl FnMut(Part<'a>) -> f64,
) {
    let bounds = region.turned_back(basis).bounds(compound);
    compound.visit_nearest(&bounds, limit, |index| visit(Part::of(compound, index, basis)));
}

impl Region3 {
    /// The same region in the body's axes.
    fn turned_back(self, basis: &Basis3) -> Self {
        Self { center: basis.turn_back(self.center), ..self }
    }
}
