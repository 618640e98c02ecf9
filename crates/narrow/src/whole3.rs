//! Two whole bodies in space, projected on a direction: see `shadow`.

use crate::polyhedron::solid::Solid;
use crate::precision::{IN_SPACE, Precision};
use crate::shadow::{Ball, Reaches, Shadow};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Pose3, Shape3};

const IDENTITY: Basis3 = Basis3 { x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

/// Two bodies with all their parts: shapes, rotations, and B's position less A's.
pub(crate) struct Wholes3<'s> {
    pub(crate) shapes: [&'s Shape3; 2],
    pub(crate) bases: [&'s Basis3; 2],
    pub(crate) between: DVec3,
}

impl Wholes3<'_> {
    /// The unit direction from A's middle to B's.
    pub(crate) fn towards_b(&self) -> DVec3 {
        let [a, b] = [0, 1].map(|i| self.bases[i].turn(self.shapes[i].center().as_dvec3()));
        (self.between + (b - a)).try_normalize().unwrap_or(DVec3::X)
    }

    /// The projections on a unit direction, in world axes, and the direction to try next where it does not separate the
    /// bodies. `None` for half-spaces, which are unbounded except along their normal.
    pub(crate) fn shadow(&self, direction: DVec3, limit: f64) -> Option<(Shadow<DVec3>, DVec3)> {
        if self.shapes.iter().any(|shape| matches!(shape, Shape3::HalfSpace(_))) {
            return None;
        }
        let local = [self.bases[0].turn_back(direction), self.bases[1].turn_back(-direction)];
        let [a, b] = [0, 1].map(|i| Reaches::of_balls(balls(self.shapes[i], local[i]), DVec3::ZERO));
        let mut shadow = Shadow { a, b, between: direction.dot(self.between), needed: 0.0 };
        let reach = self.between.length() + shadow.summed();
        let precision = Precision { size: 0.0, reach, planarity: 0.0, roundings: IN_SPACE.of_parts };
        shadow.needed = limit + precision.projection();
        if shadow.parts_wholes() {
            return Some((shadow, direction));
        }
        shadow.a.refine(part_count(self.shapes[0]), |part| project(self.shapes[0], part, local[0]));
        shadow.b.refine(part_count(self.shapes[1]), |part| project(self.shapes[1], part, local[1]));
        let (on_a, on_b) = (self.bases[0].turn(shadow.a.point), self.bases[1].turn(shadow.b.point));
        let Some(way) = (self.between + (on_b - on_a)).try_normalize() else {
            return Some((shadow, direction));
        };
        let along = direction.dot(way);
        // Where they are apart by less than asked for, the vector between the furthest points is the better direction.
        let next = if along > 0.0 { way } else { direction - way * (2.0 * along) };
        Some((shadow, next.try_normalize().unwrap_or(way)))
    }
}

pub(crate) fn part_count(shape: &Shape3) -> usize {
    if let Shape3::Compound(compound) = shape { compound.parts().len() } else { 1 }
}

/// A part, and where it is in its compound.
fn part_of(shape: &Shape3, part: usize) -> (&Shape3, Option<&Pose3>) {
    let Shape3::Compound(compound) = shape else { return (shape, None) };
    compound.parts().get(part).map_or((shape, None), |part| (part.shape(), Some(part.pose())))
}

/// Balls around the parts along a direction of unit length, in the body's own axes.
fn balls(shape: &Shape3, direction: DVec3) -> impl Iterator<Item = Ball> {
    let ball = move |shape: &Shape3, place: DVec3, center: DVec3| {
        let radius = f64::from(shape.outer_radius());
        // Sums of coordinates bound lengths, and need no root.
        let summed = place.abs().element_sum() + f64::from(shape.center().abs().element_sum()) + radius;
        Ball { reach: direction.dot(center) + radius, summed }
    };
    let (parts, whole) = match shape {
        Shape3::Compound(compound) => (compound.parts(), None),
        _ => ([].as_slice(), Some(ball(shape, DVec3::ZERO, shape.center().as_dvec3()))),
    };
    parts.iter().map(move |part| ball(part.shape(), part.pose().position(), part.center())).chain(whole)
}

/// How far a part reaches along a direction of unit length, and its furthest point, in the body's own axes.
fn project(shape: &Shape3, part: usize, direction: DVec3) -> (f64, DVec3) {
    let (part, pose) = part_of(shape, part);
    let Some(pose) = pose else {
        let point = furthest_of(part, direction);
        return (direction.dot(point), point);
    };
    let basis = pose.basis();
    let local = basis.turn_back(direction);
    let point = furthest_of(part, local);
    (local.dot(point) + direction.dot(pose.position()), pose.position() + basis.turn(point))
}

/// The point of a convex and bounded shape that is furthest along a direction of unit length.
fn furthest_of(shape: &Shape3, direction: DVec3) -> DVec3 {
    let radius = f64::from(shape.radius());
    let corner = match shape {
        Shape3::Cuboid(cuboid) => {
            let half = cuboid.half_extents().as_dvec3();
            let side = |half: f64, along: f64| if along < 0.0 { -half } else { half };
            DVec3::new(side(half.x, direction.x), side(half.y, direction.y), side(half.z, direction.z))
        }
        Shape3::Sphere(_) => DVec3::ZERO,
        _ => {
            let core = shape.core();
            let solid = Solid::new(&core, IDENTITY, DVec3::ZERO, radius);
            solid.point(solid.support(direction).vertex)
        }
    };
    corner + direction * radius
}
