//! Convex parts of bodies in the plane.

use crate::among::{MANY, Region2, in_order};
use crate::exact::Site2;
use crate::polygon::outline::Turn;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Compound2, Part2, Pose2, Shape2};
use core::ops::ControlFlow;

/// A convex part of a body, as the body stands.
#[derive(Clone, Copy)]
pub(super) struct Part<'a> {
    pub(super) index: u32,
    pub(super) shape: &'a Shape2,
    /// Where it is in its compound; a shape that is none is its own only part.
    pub(super) local: Option<&'a Pose2>,
    /// Its bounding circle's centre less the body's position, in world axes.
    pub(super) center: DVec2,
}

impl<'a> Part<'a> {
    /// A shape as a part of nothing: a compound by its bounding circle alone.
    pub(super) fn whole(shape: &'a Shape2, turn: &Turn) -> Self {
        let center = turn.turn(shape.center().as_dvec2());
        Self { index: 0, shape, local: None, center }
    }

    /// Shape and poses as they were given, for exact questions.
    pub(super) fn site(&self, body: &Pose2) -> Site2<'a> {
        Site2 { shape: self.shape, body: *body, part: self.local }
    }

    /// Its rotation in the world, and its origin less the body's position.
    pub(super) fn placed(&self, body: &Turn) -> (Turn, DVec2) {
        let Some(pose) = self.local else { return (*body, DVec2::ZERO) };
        (body.of_part(pose.rotation()), body.turn(pose.position()))
    }

    /// The part of a shape whose box is nearest to a point, in metres and world axes from the body's position.
    pub(super) fn nearest(shape: &'a Shape2, turn: &Turn, point: DVec2) -> Self {
        let whole = Self::whole(shape, turn);
        let Shape2::Compound(compound) = shape else { return whole };
        let point = turn.turn_back(point).as_vec2();
        let mut nearest = 0;
        compound.visit_nearest(&Aabb2::new(point, point), f64::INFINITY, |part| {
            nearest = part;
            // That is enough.
            -1.0
        });
        compound.parts().get(nearest as usize).map_or(whole, |part| Self::of(part, nearest, turn))
    }

    fn of(part: &'a Part2, index: u32, turn: &Turn) -> Self {
        let center = turn.turn(part.center());
        Self { index, shape: part.shape(), local: Some(part.pose()), center }
    }
}

/// Visits the convex parts of a shape until the visitor says to stop; returns whether it did.
pub(super) fn for_parts<'a>(shape: &'a Shape2, turn: &Turn, mut visit: impl FnMut(Part<'a>) -> bool) -> bool {
    let Shape2::Compound(compound) = shape else {
        return visit(Part::whole(shape, turn));
    };
    compound.parts().iter().zip(0..).any(|(part, index)| visit(Part::of(part, index, turn)))
}

/// A compound of so many parts that its tree is asked.
pub(super) fn of_many(shape: &Shape2) -> Option<&Compound2> {
    match shape {
        Shape2::Compound(compound) if compound.parts().len() >= MANY => Some(compound),
        _ => None,
    }
}

/// Visits parts roughly in the order of their distance from a region, as the body's position sees it in world axes, up to a limit in
/// metres that the visitor may lower: it returns the new one.
pub(super) fn for_nearest_parts<'a>(
    compound: &'a Compound2,
    turn: &Turn,
    Region2 { from, radius, .. }: Region2,
    limit: f64,
    mut visit: impl FnMut(Part<'a>) -> f64,
) {
    let local = Region2::ball(turn.turn_back(from), radius);
    // A stored rotation stretches distances, too.
    let wide = |limit: f64| limit * (1.0 + 4.0 * f64::from(f32::EPSILON));
    compound.visit_nearest(&local.bounds(compound), wide(limit), |index| {
        let part = compound.parts().get(index as usize);
        part.map_or(limit, |part| wide(visit(Part::of(part, index, turn))))
    });
}

/// As [`for_parts_in`], of a region that does not move, and in any order: the first that is found may be enough.
pub(super) fn for_parts_near<'a>(
    shape: &'a Shape2,
    turn: &Turn,
    region: impl FnOnce() -> Region2,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    let Some(compound) = of_many(shape) else { return for_parts(shape, turn, visit) };
    let Region2 { from, radius, .. } = region();
    let local = Region2::ball(turn.turn_back(from), radius);
    let visit = |index: u32| match compound.parts().get(index as usize) {
        Some(part) if visit(Part::of(part, index, turn)) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    compound.visit_near(&local.bounds(compound), visit).is_break()
}

/// As [`for_parts`], in the same order, but for parts of a compound of many that are certainly not in a region, as the body's
/// position sees it in world axes.
pub(super) fn for_parts_in<'a>(
    shape: &'a Shape2,
    turn: &Turn,
    region: impl FnOnce() -> Region2,
    mut visit: impl FnMut(Part<'a>) -> bool,
) -> bool {
    if let Some(compound) = of_many(shape) {
        let Region2 { from, way, radius } = region();
        let local = Region2 { from: turn.turn_back(from), way: turn.turn_back(way), radius };
        if local.is_bounded() {
            let part = |index: u32| Some(Part::of(compound.parts().get(index as usize)?, index, turn));
            return in_order(|find| local.walk(compound, find), |index| part(index).is_some_and(&mut visit));
        }
    }
    for_parts(shape, turn, visit)
}
