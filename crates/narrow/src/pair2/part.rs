//! Convex parts of bodies in the plane.

use crate::among::{Region2, in_order, many2};
use crate::exact::Site2;
use crate::polygon::outline::Turn;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Compound2, Pose2, Shape2};
use core::ops::ControlFlow;

/// A convex part of a body, in the body's current pose.
#[derive(Clone, Copy)]
pub(super) struct Part<'a> {
    pub(super) index: u32,
    pub(super) shape: &'a Shape2,
    /// Its pose in its compound; `None` for a whole shape, which is its own only part.
    pub(super) local: Option<&'a Pose2>,
    /// Its bounding circle's centre less the body's position, in world axes.
    pub(super) center: DVec2,
}

impl<'a> Part<'a> {
    /// A whole shape as its own only part; of a compound, only the bounding circle is of use.
    pub(super) fn whole(shape: &'a Shape2, turn: &Turn) -> Self {
        let center = turn.turn(shape.center().as_dvec2());
        Self { index: 0, shape, local: None, center }
    }

    /// Shape and poses as they were given, for exact tests.
    pub(super) fn site(&self, body: &Pose2) -> Site2<'a> {
        Site2 { shape: self.shape, body: *body, part: self.local }
    }

    /// Its rotation in the world, and its origin less the body's position.
    pub(super) fn placed(&self, body: &Turn) -> (Turn, DVec2) {
        let Some(pose) = self.local else { return (*body, DVec2::ZERO) };
        (body.of_part(pose.rotation()), body.turn(pose.position()))
    }

    /// The part of a shape whose box is nearest to a point, which is in metres and world axes from the body's position.
    pub(super) fn nearest(shape: &'a Shape2, turn: &Turn, point: DVec2) -> Self {
        let Shape2::Compound(compound) = shape else { return Self::whole(shape, turn) };
        let point = turn.turn_back(point).as_vec2();
        let mut nearest = 0;
        compound.visit_nearest(&Aabb2::new(point, point), f64::INFINITY, |part| {
            nearest = part;
            // A negative limit ends the search.
            -1.0
        });
        Self::of(compound, nearest, turn)
    }

    /// A part of a compound, by its index.
    fn of(compound: &'a Compound2, index: u32, turn: &Turn) -> Self {
        let part = &compound.parts()[index as usize];
        Self { index, shape: part.shape(), local: Some(part.pose()), center: turn.turn(part.center()) }
    }
}

/// Visits the convex parts of a shape until the visitor says to stop; returns whether it did.
pub(super) fn for_parts<'a>(shape: &'a Shape2, turn: &Turn, mut visit: impl FnMut(Part<'a>) -> bool) -> bool {
    let Shape2::Compound(compound) = shape else {
        return visit(Part::whole(shape, turn));
    };
    (0..compound.parts().len() as u32).any(|index| visit(Part::of(compound, index, turn)))
}

/// Like [`for_parts`], in the same order, but of a compound of many parts leaves out those that are certainly outside a
/// region. The region is in world axes, relative to the body's position.
pub(super) fn for_parts_in<'a>(
    shape: &'a Shape2,
    turn: &Turn,
    region: impl FnOnce() -> Region2,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Some(compound) = many2(shape) else { return for_parts(shape, turn, visit) };
    let bounds = region().turned_back(turn).bounds(compound);
    let walk = |numbers: &mut Vec<u32>| {
        let _ = compound.visit_near(&bounds, |index| {
            numbers.push(index);
            ControlFlow::Continue(())
        });
    };
    in_order(walk, |index| visit(Part::of(compound, index, turn)))
}

/// The same in any order, for searches where the first that is found may be enough.
pub(super) fn for_parts_near<'a>(
    shape: &'a Shape2,
    turn: &Turn,
    region: impl FnOnce() -> Region2,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Some(compound) = many2(shape) else { return for_parts(shape, turn, visit) };
    let bounds = region().turned_back(turn).bounds(compound);
    let is_enough = |index: u32| match visit(Part::of(compound, index, turn)) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    compound.visit_near(&bounds, is_enough).is_break()
}

/// Visits parts roughly in the order of their distance from a region, up to a limit in metres, which the visitor may
/// lower: it returns the new one. The region is in world axes, relative to the body's position.
pub(super) fn for_nearest_parts<'a>(
    compound: &'a Compound2,
    turn: &Turn,
    region: Region2,
    limit: f64,
    mut visit: impl FnMut(Part<'a>) -> f64,
) {
    let bounds = region.turned_back(turn).bounds(compound);
    // A stored rotation stretches distances, too, by its length.
    let wide = |limit: f64| limit * (1.0 + 4.0 * f64::from(f32::EPSILON));
    compound.visit_nearest(&bounds, wide(limit), |index| wide(visit(Part::of(compound, index, turn))));
}

impl Region2 {
    /// The same region in the body's axes.
    fn turned_back(self, turn: &Turn) -> Self {
        Self { center: turn.turn_back(self.center), ..self }
    }
}
