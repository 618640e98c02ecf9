//! The convex parts of a body, as a cast sees them: where they are in the body, and how far they reach.

use super::legs::Legs;
use super::stretch::Stretch;
use crate::among::{Region2, in_order, many2};
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::CAST_GAP2;
use asunder_geometry::{Aabb2, Compound2, Part2, Pose2, Shape2};

/// A stored rotation stretches by its length, which is one up to the rounding of f32; a part has two.
const STRETCH: f64 = 1.0 + 4.0 * f32::EPSILON as f64;

/// A convex part of a body, or all of it.
pub(super) struct Piece<'a> {
    pub(super) index: u32,
    pub(super) shape: &'a Shape2,
    /// Its pose in its compound; a shape that is not a compound is its own only part.
    pub(super) local: Option<&'a Pose2>,
    /// Its bounding circle's centre, in the body's axes.
    pub(super) center: DVec2,
    /// That circle's radius, for any rotation of the body; infinite for a half-plane.
    pub(super) outer: f64,
    /// The furthest that a vertex of the core, or the origin of a half-plane, is from the body's position.
    pub(super) arm: f64,
}

impl<'a> Piece<'a> {
    /// A shape as a whole: a compound by its bounding circle alone.
    pub(super) fn whole(shape: &'a Shape2) -> Self {
        Self::new(shape, shape.center().as_dvec2(), None, 0)
    }

    /// A segment of a chain.
    pub(super) fn segment(shape: &'a Shape2, index: u32) -> Self {
        Self::new(shape, shape.center().as_dvec2(), None, index)
    }

    /// What is in a box in a chain's axes, as a circle around the box. It stands for the chain, and has no core.
    pub(super) fn boxed(chain: &'a Shape2, bounds: &Aabb2) -> Self {
        let (min, max) = (bounds.min.as_dvec2(), bounds.max.as_dvec2());
        let (center, outer) = ((min + max) * 0.5, (max - min).length() * 0.5 * STRETCH);
        Self { index: 0, shape: chain, local: None, center, outer, arm: 0.0 }
    }

    fn of(part: &'a Part2, index: u32) -> Self {
        Self::new(part.shape(), part.center(), Some(part.pose()), index)
    }

    fn new(shape: &'a Shape2, center: DVec2, local: Option<&'a Pose2>, index: u32) -> Self {
        let radius = f64::from(shape.outer_radius());
        let core = if radius < f64::INFINITY { radius - f64::from(shape.radius()) } else { 0.0 };
        let (outer, arm) = (radius * STRETCH, (center.length() + core) * STRETCH);
        Self { index, shape, local, center, outer, arm }
    }

    pub(super) fn is_line(&self) -> bool {
        matches!(self.shape, Shape2::HalfPlane(_))
    }
}

/// Visits the convex parts of a shape, in order.
pub(super) fn for_pieces<'a>(shape: &'a Shape2, mut visit: impl FnMut(&Piece<'a>)) {
    let Shape2::Compound(compound) = shape else {
        return visit(&Piece::whole(shape));
    };
    for (part, index) in compound.parts().iter().zip(0..) {
        visit(&Piece::of(part, index));
    }
}

/// As [`for_pieces`], in the same order, but without those of a compound of many parts that certainly do not meet a
/// piece of the other body until a time of the stretch. For A's pieces (0), or B's (1); each with a time before which
/// it certainly does not.
pub(super) fn for_pieces_met<'a>(
    (shape, which): (&'a Shape2, usize),
    stretch: &Stretch,
    (other, until): (&Piece, f64),
    mut visit: impl FnMut(&Piece<'a>, f64),
) {
    // An endless shape is everywhere.
    let many = many2(shape).filter(|_| other.outer.is_finite());
    let Some(compound) = many else { return for_pieces(shape, |piece| visit(piece, 0.0)) };
    if !stretch.is_turning() {
        return for_pieces_along((compound, which), stretch, (other, until), |piece| visit(piece, 0.0));
    }
    let legs = Legs::new(stretch, (compound, which), (other, until));
    let visit_met = |index: u32| {
        let piece = Piece::of(&compound.parts()[index as usize], index);
        if let Some(from) = legs.first_meeting(piece.center, piece.outer) {
            visit(&piece, from);
        }
        false
    };
    in_order(|numbers| legs.walk(compound, numbers), visit_met);
}

/// The same for a compound where neither body turns. May visit other pieces too.
fn for_pieces_along<'a>(
    (compound, which): (&'a Compound2, usize),
    stretch: &Stretch,
    (other, until): (&Piece, f64),
    mut visit: impl FnMut(&Piece<'a>),
) {
    let (region, way) = region(stretch, (compound, which), other);
    let walk = |numbers: &mut Vec<u32>| {
        compound.visit_along(region.center, way, region.grown(way, compound), until, |index| {
            numbers.push(index);
            until
        });
    };
    in_order(walk, |index| {
        visit(&Piece::of(&compound.parts()[index as usize], index));
        false
    });
}

/// Where the pieces of a compound are that may meet a piece of the other body, if neither body turns: a region in the
/// compound's axes when a stretch begins, and how that region moves.
fn region(stretch: &Stretch, (compound, which): (&Compound2, usize), other: &Piece) -> (Region2, DVec2) {
    let [own, others] = [which, 1 - which].map(|i| stretch.spins[i].turn_at(0.0));
    let center = others.turn(other.center);
    let (from, way) = match which {
        0 => (stretch.offset + center, -stretch.velocity),
        _ => (center - stretch.offset, stretch.velocity),
    };
    let met = CAST_GAP2 * (other.outer + f64::from(compound.outer_radius()));
    let radius = other.outer + met + 2.0 * stretch.lost(1.0);
    (Region2 { center: own.turn_back(from), radius }, own.turn_back(way))
}
