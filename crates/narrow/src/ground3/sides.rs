//! Which side of the ground a part is on, and which way the ground faces where it is touched.

use super::near::{OnGround, Viewpoint, box_around};
use arrayvec::ArrayVec;
use asunder_geometry::Ground;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::{ON_TRIANGLE, SAME_NORMAL};
use core::ops::ControlFlow;

/// Most triangles around a touched point that are tested: with more, the ground is a fan for which no normal is
/// promised.
const MOST_AROUND: usize = 32;

/// A point of the ground, in its own axes, and the unit direction from there to the body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touched {
    pub(crate) triangle: u32,
    pub(crate) point: DVec3,
    pub(crate) away: DVec3,
    /// The body's motion there, of any length.
    pub(crate) way: DVec3,
}

/// Which way ground faces where it is touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facing {
    /// The triangle that gave the direction.
    pub(crate) triangle: u32,
    /// The unit direction.
    pub(crate) away: DVec3,
    /// Whether the body moves along it.
    pub(crate) is_left: bool,
}

/// A triangle around a touched point.
struct Around {
    number: u32,
    corners: [DVec3; 3],
    /// The unit normal, towards the body.
    facing: DVec3,
    /// Whether the body is in front of it, or the ground is two-sided.
    is_facing: bool,
}

/// The normal of a triangle's front, not of unit length.
fn normal_of([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

impl Touched {
    /// Whether the body moves along a unit direction, by more than rounding.
    pub(crate) fn is_left(&self, away: DVec3) -> bool {
        away.dot(self.way) > SAME_NORMAL * self.way.length()
    }
}

impl OnGround<'_> {
    /// Whether a triangle faces a part at this position: always, unless the ground is one-sided and the part behind it.
    pub(crate) fn is_facing(&self, corners: [Vec3; 3], viewpoint: Viewpoint) -> bool {
        if !self.ground.is_one_sided() {
            return true;
        }
        let corners = corners.map(|corner| corner.as_dvec3());
        viewpoint.is_in_front(corners[0], normal_of(corners))
    }

    /// The direction in which a touched triangle pushes a part at this position, and the triangle that gives it: no
    /// ghosts.
    ///
    /// ```text
    /// the direction found is the triangle's normal:       that
    /// no triangle around the point rises into it:         the direction itself, of a prominent edge or vertex
    /// else the normal of a triangle around the point:     of one-sided ground one that the body moves into, if there
    ///                                                     is any; of those one that nothing rises into, if there is
    ///                                                     any; of those the one nearest to the direction found
    /// ```
    /// A direction belongs to a point of a set if no part of the set near the point extends that way (its normal cone;
    /// Ericson, "Real-Time Collision Detection" (2005), 5.1, has the same as Voronoi regions of edges and vertices). As
    /// all triangles that contain the point are tested, not only those across its edges, this also holds where edges do
    /// not meet.
    pub(crate) fn facing(&self, touched: &Touched, viewpoint: Viewpoint) -> Facing {
        let facing_along =
            |triangle: u32, away: DVec3| Facing { triangle, away, is_left: touched.is_left(away) };
        let corners = self.ground.corners(touched.triangle).map(|corner| corner.as_dvec3());
        let Some(own) = normal_of(corners).try_normalize() else {
            return facing_along(touched.triangle, touched.away);
        };
        let own = if own.dot(touched.away) < 0.0 { -own } else { own };
        if own.cross(touched.away).length() <= SAME_NORMAL {
            return facing_along(touched.triangle, own);
        }
        let around = self.around(touched.point, corners, viewpoint);
        if is_free(&around, touched.point, touched.away) {
            return facing_along(touched.triangle, touched.away);
        }
        let mut best: Option<((bool, bool, f64), &Around)> = None;
        for one in around.iter().filter(|one| one.is_facing) {
            // Prefers the triangle itself, where others are no nearer.
            let nearness =
                one.facing.dot(touched.away) + if one.number == touched.triangle { SAME_NORMAL } else { 0.0 };
            // On two-sided ground, which nothing passes through, the motion does not count: the nearest tells what is
            // level.
            let is_met = !self.ground.is_one_sided() || !touched.is_left(one.facing);
            let rank = (is_met, is_free(&around, touched.point, one.facing), nearness);
            if best.is_none_or(|(known, _)| rank > known) {
                best = Some((rank, one));
            }
        }
        best.map_or(facing_along(touched.triangle, touched.away), |(_, one)| {
            facing_along(one.number, one.facing)
        })
    }

    /// The triangles that contain a point.
    fn around(
        &self,
        point: DVec3,
        corners: [DVec3; 3],
        viewpoint: Viewpoint,
    ) -> ArrayVec<Around, MOST_AROUND> {
        let mut around = ArrayVec::new();
        let slack = ON_TRIANGLE * extent(corners);
        let bounds = box_around([point - DVec3::splat(slack), point + DVec3::splat(slack)]);
        let _ = self.ground.visit_near(&bounds, |number| {
            let corners = self.ground.corners(number).map(|corner| corner.as_dvec3());
            let slack = ON_TRIANGLE * extent(corners) + slack;
            let cross = normal_of(corners);
            if let Some(normal) = cross.try_normalize()
                && holds(corners, normal, point, slack)
            {
                let (is_in_front, is_one_sided) =
                    (viewpoint.is_in_front(corners[0], cross), self.ground.is_one_sided());
                let facing = if is_in_front || is_one_sided { normal } else { -normal };
                around.push(Around { number, corners, facing, is_facing: is_in_front || !is_one_sided });
            }
            if around.is_full() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        // Independent of the order in which the tree visits them.
        around.sort_unstable_by_key(|one| one.number);
        around
    }
}

fn extent([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).abs().max_element().max((c - a).abs().max_element())
}

fn holds(corners: [DVec3; 3], normal: DVec3, point: DVec3, slack: f64) -> bool {
    let [a, b, c] = corners;
    let beside = |from: DVec3, to: DVec3| {
        let inwards = normal.cross(to - from);
        inwards.dot(point - from) < -slack * inwards.length()
    };
    normal.dot(point - a).abs() <= slack && !beside(a, b) && !beside(b, c) && !beside(c, a)
}

/// Whether no triangle around a point rises into a direction.
fn is_free(around: &[Around], point: DVec3, away: DVec3) -> bool {
    around.iter().all(|one| one.rise(point, away) <= SAME_NORMAL)
}

impl Around {
    /// The greatest cosine between a direction and any vector that leads from a point of the triangle along the
    /// triangle.
    ///
    /// From inside those are all vectors in its plane, from an edge half of them, from a corner a wedge. Vectors to the
    /// corners alone would not do: in a sliver they lie along the edge, and hardly across it.
    fn rise(&self, point: DVec3, away: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        let slack = 4.0 * ON_TRIANGLE * extent(self.corners);
        let flat = away - self.facing * self.facing.dot(away);
        let front = normal_of(self.corners);
        // Edges that contain the point: unit vectors along them and inwards.
        let mut held = ArrayVec::<(DVec3, DVec3), 3>::new();
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (along, inwards) = (to - from, front.cross(to - from));
            if let (Some(along), Some(inwards)) = (along.try_normalize(), inwards.try_normalize())
                && inwards.dot(point - from) <= slack
            {
                held.push((along, inwards));
            }
        }
        let is_inside = |way: DVec3| held.iter().all(|(_, inwards)| way.dot(*inwards) >= -SAME_NORMAL);
        if held.iter().all(|(_, inwards)| flat.dot(*inwards) >= 0.0) {
            return flat.length();
        }
        let ends = held.iter().flat_map(|&(along, _)| [along, -along]);
        ends.filter(|&way| is_inside(way)).map(|way| way.dot(away)).fold(0.0, f64::max)
    }
}

/// The centre of the bounding sphere of ground, in its own axes, and its radius.
pub(super) fn sphere_of(ground: Ground) -> (DVec3, f64) {
    match ground {
        Ground::Mesh(mesh) => (mesh.center().as_dvec3(), mesh.outer_radius().into()),
        Ground::Field(field) => (field.center().as_dvec3(), field.outer_radius().into()),
    }
}
