//! What proves that a body and ground still overlap.

use super::flat::NearPoints;
use super::grounded::Moved;
use crate::answer::Manifold3;
use crate::feature::Feature;
use crate::ground3::OnGround;
use crate::persistent::lost;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Shape3};
use core::ops::Range;

/// A proof that a body and ground share a point.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Witness {
    /// A segment of the body, in world axes from its position, that crosses a triangle, in world axes from the
    /// ground's; counter-clockwise as seen from the segment's end.
    Crossing { from: DVec3, to: DVec3, corners: [DVec3; 3] },
    /// A point of ground, in world axes from its position, in a cuboid with these half extents.
    InCuboid { point: DVec3, half: DVec3 },
    /// The same in a ball about the body's position.
    InBall { point: DVec3, radius: f64 },
}

/// Weights of points in an average that is on a seam of the ground only by chance.
const SHARES: [f64; 4] = [0.53, 0.27, 0.13, 0.07];

impl Witness {
    /// One that holds for the poses of these manifolds, if there is any.
    pub(super) fn of(on: &OnGround, found: &[Manifold3], near: &NearPoints, arm: f32) -> Option<Self> {
        let deepest = found
            .iter()
            .reduce(|least, next| if next.separation < least.separation { next } else { least })?;
        let still = Moved::none(on.to_body);
        let holds = |witness: &Self| witness.holds(&still, on.body_basis, arm.into());
        // A point of a triangle in the body proves nothing once the body's centre is behind the triangle's front.
        let is_any_side = !on.ground.is_one_sided();
        if let Shape3::Sphere(sphere) = on.body
            && is_any_side
        {
            return Self::in_ball(on, deepest, sphere.radius().into()).filter(holds);
        }
        let all = 0..deepest.points.len();
        let some = all.clone().map(|i| i..i + 1);
        let mut crossings =
            core::iter::once(all).chain(some).filter_map(|points| Self::crossing(on, deepest, points, near));
        crossings
            .find(holds)
            .or_else(|| Self::inside(on, deepest).filter(|inside| is_any_side && holds(inside)))
    }

    /// The segment from an average of some points to the body's centre.
    fn crossing(on: &OnGround, of: &Manifold3, points: Range<usize>, near: &NearPoints) -> Option<Self> {
        let (mut from, mut foot, mut all) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for (point, share) in of.points.get(points)?.iter().zip(SHARES) {
            let [on_body, on_ground] = on.ends(of, point);
            (from, foot, all) = (from + on_body * share, foot + on_ground * share, all + share);
        }
        (from, foot) = (from / all, foot / all);
        let to = on.body_basis.turn(on.body.center().as_dvec3());
        let [a, b, c] = near.under(on.basis.turn_back(foot), on.basis.turn_back(on.towards(of)), None)?;
        Some(Self::Crossing { from, to, corners: [on.basis.turn(a), on.basis.turn(b), on.basis.turn(c)] })
    }

    /// The point of ground that is deepest in a ball.
    fn in_ball(on: &OnGround, deepest: &Manifold3, radius: f64) -> Option<Self> {
        let [_, point] = on.ends(deepest, deepest.points.first()?);
        Some(Self::InBall { point, radius })
    }

    /// A corner of ground, a point on an edge of it, or the middle of two such points, in a cuboid.
    fn inside(on: &OnGround, deepest: &Manifold3) -> Option<Self> {
        let Shape3::Cuboid(cuboid) = on.body else { return None };
        let point_of = |i: usize| {
            let point = &deepest.points[i];
            let [_, on_ground] = on.ends(deepest, point);
            let [_, feature] = on.in_order([point.feature.a(), point.feature.b()]);
            (on_ground, feature)
        };
        let mut best: Option<(f64, DVec3)> = None;
        for i in 0..deepest.points.len() {
            for j in i..deepest.points.len() {
                let ((one, of_one), (other, of_other)) = (point_of(i), point_of(j));
                let is_on_ground = match (of_one, of_other) {
                    (Feature::Edge(edge), Feature::Edge(same)) => edge == same,
                    (Feature::Vertex(_), _) => i == j,
                    _ => false,
                };
                let point = (one + other) * 0.5;
                let depth = depth_in(on, point, cuboid.half_extents().as_dvec3());
                if is_on_ground && best.is_none_or(|(most, _)| depth > most) {
                    best = Some((depth, point));
                }
            }
        }
        best.map(|(_, point)| Self::InCuboid { point, half: cuboid.half_extents().as_dvec3() })
    }

    /// Whether it proves that they overlap.
    pub(super) fn holds(&self, moved: &Moved, basis: Basis3, arm: f64) -> bool {
        let offset = moved.offset;
        // Anchors are rounded to f32.
        let doubt = |point: DVec3| {
            let lengths = offset.abs().element_sum() + point.abs().element_sum();
            4.0 * f64::from(f32::EPSILON) * arm + lost(lengths, arm)
        };
        match *self {
            Self::Crossing { from, to, corners } => {
                let ends = [offset + moved.turn.turn(from), offset + moved.turn.turn(to)];
                do_cross(ends, corners, doubt(corners[0]))
            }
            Self::InCuboid { point, half } => {
                let local = basis.turn_back(point - offset);
                (half - local.abs()).min_element() > doubt(point)
            }
            Self::InBall { point, radius } => (point - offset).length() < radius - doubt(point),
        }
    }

    /// Whether it is a possible one: for data that was read from a file.
    pub(super) fn is_sound(&self) -> bool {
        match self {
            Self::Crossing { from, to, corners } => {
                from.is_finite() && to.is_finite() && corners.iter().all(|corner| corner.is_finite())
            }
            Self::InCuboid { point, half } => point.is_finite() && half.is_finite(),
            Self::InBall { point, radius } => point.is_finite() && radius.is_finite(),
        }
    }
}

fn depth_in(on: &OnGround, point: DVec3, half: DVec3) -> f64 {
    (half - on.body_basis.turn_back(point - on.to_body).abs()).min_element()
}

/// Whether a segment whose ends may be off by `doubt` crosses a triangle from behind for certain.
fn do_cross([from, to]: [DVec3; 2], [a, b, c]: [DVec3; 3], doubt: f64) -> bool {
    let cross = (b - a).cross(c - a);
    let area = cross.length();
    let (low, high) = (cross.dot(from - a) / area, cross.dot(to - a) / area);
    // NaN does not.
    if !(low < -doubt && high > doubt) {
        return false;
    }
    let along = to - from;
    let at = from + along * (low / (low - high));
    let off = 2.0 * doubt * (1.0 + along.length() / (high - low));
    let is_inside = |from: DVec3, to: DVec3| {
        let side = to - from;
        cross.cross(side).dot(at - from) > off * area * side.abs().element_sum()
    };
    is_inside(a, b) && is_inside(b, c) && is_inside(c, a)
}
