//! Two whole bodies in the plane, projected on a direction: see `shadow`.

use crate::polygon::outline::{OF_SEARCH, Outline, Turn};
use crate::precision::{IN_PLANE, Precision};
use crate::shadow::{Ball, Reaches, Shadow};
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Pose2, Shape2};

/// Two bodies with all their parts: shapes, rotations, and B's position less A's.
pub(crate) struct Wholes2<'s> {
    pub(crate) shapes: [&'s Shape2; 2],
    pub(crate) turns: [&'s Turn; 2],
    pub(crate) between: DVec2,
}

impl Wholes2<'_> {
    /// The unit direction from A's middle to B's.
    pub(crate) fn towards_b(&self) -> DVec2 {
        let [a, b] = [0, 1].map(|i| self.turns[i].turn(self.shapes[i].center().as_dvec2()));
        (self.between + (b - a)).try_normalize().unwrap_or(DVec2::X)
    }

    /// The projections on a unit direction, in world axes, and the direction to try next where it does not separate the
    /// bodies. `None` for half-planes, which are unbounded except along their normal.
    pub(crate) fn shadow(&self, direction: DVec2, limit: f64) -> Option<(Shadow<DVec2>, DVec2)> {
        if self.shapes.iter().any(|shape| matches!(shape, Shape2::HalfPlane(_))) {
            return None;
        }
        let along = [direction, -direction];
        let [a, b] =
            [0, 1].map(|i| Reaches::of_balls(balls(self.shapes[i], self.turns[i], along[i]), DVec2::ZERO));
        let mut shadow = Shadow { a, b, between: direction.dot(self.between), needed: 0.0 };
        let reach = self.between.length() + shadow.summed();
        let roundings = IN_PLANE.of_parts + OF_SEARCH;
        let precision = Precision { size: 0.0, reach, planarity: 0.0, roundings };
        shadow.needed = limit + precision.projection();
        if shadow.parts_wholes() {
            return Some((shadow, direction));
        }
        let project = |i: usize| move |part| project(self.shapes[i], part, self.turns[i], along[i]);
        shadow.a.refine(part_count(self.shapes[0]), project(0));
        shadow.b.refine(part_count(self.shapes[1]), project(1));
        let Some(way) = (self.between + (shadow.b.point - shadow.a.point)).try_normalize() else {
            return Some((shadow, direction));
        };
        let along = direction.dot(way);
        // Where they are apart by less than asked for, the vector between the furthest points is the better direction.
        let next = if along > 0.0 { way } else { direction - way * (2.0 * along) };
        Some((shadow, next.try_normalize().unwrap_or(way)))
    }
}

pub(crate) fn part_count(shape: &Shape2) -> usize {
    if let Shape2::Compound(compound) = shape { compound.parts().len() } else { 1 }
}

/// A part, and where it is in its compound.
fn part_of(shape: &Shape2, part: usize) -> (&Shape2, Option<&Pose2>) {
    let Shape2::Compound(compound) = shape else { return (shape, None) };
    compound.parts().get(part).map_or((shape, None), |part| (part.shape(), Some(part.pose())))
}

/// Circles around the parts along a direction of unit length, in world axes.
fn balls(shape: &Shape2, turn: &Turn, direction: DVec2) -> impl Iterator<Item = Ball> {
    let ball = move |shape: &Shape2, place: DVec2, center: DVec2| {
        // A stored rotation stretches by its length, which is one up to the rounding of f32; a part has two.
        let radius = f64::from(shape.outer_radius()) * (1.0 + 4.0 * f64::from(f32::EPSILON));
        // Sums of coordinates bound lengths, and need no root.
        let summed = place.abs().element_sum() + f64::from(shape.center().abs().element_sum()) + radius;
        Ball { reach: direction.dot(turn.turn(center)) + radius, summed }
    };
    let (parts, whole) = match shape {
        Shape2::Compound(compound) => (compound.parts(), None),
        _ => ([].as_slice(), Some(ball(shape, DVec2::ZERO, shape.center().as_dvec2()))),
    };
    parts.iter().map(move |part| ball(part.shape(), part.pose().position(), part.center())).chain(whole)
}

/// How far a part reaches along a direction of unit length, and its furthest point, in world axes.
fn project(shape: &Shape2, part: usize, turn: &Turn, direction: DVec2) -> (f64, DVec2) {
    let (part, pose) = part_of(shape, part);
    let (turn, place) = match pose {
        None => (*turn, DVec2::ZERO),
        Some(pose) => (turn.of_part(pose.rotation()), turn.turn(pose.position())),
    };
    let core = part.core();
    let outline = Outline::new(part, &core, turn, place);
    let support = outline.support(direction);
    (support.reach + outline.radius, outline.point(support.vertex) + direction * outline.radius)
}
