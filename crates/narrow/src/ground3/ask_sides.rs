//! From which side ground is seen, and which way it faces where it is touched.

use super::near::{OnGround, SeenAt, box_around};
use arrayvec::ArrayVec;
use asunder_geometry::Ground;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::{ON_TRIANGLE, SAME_NORMAL};
use core::ops::ControlFlow;

/// Triangles around a touched point that are looked at: beyond, the ground is a fan that no normal is owed to.
const MOST_AROUND: usize = 32;

/// A point of the ground, in its own axes, and the unit direction from there to the body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touched {
    pub(crate) triangle: u32,
    pub(crate) point: DVec3,
    pub(crate) away: DVec3,
    /// How the body moves there, of any length.
    pub(crate) way: DVec3,
}

/// Which way ground faces where it is touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facing {
    /// Whose direction that is.
    pub(crate) triangle: u32,
    /// The unit direction.
    pub(crate) away: DVec3,
    /// Whether the body moves that way.
    pub(crate) is_left: bool,
}

/// A triangle around a touched point.
struct Around {
    number: u32,
    corners: [DVec3; 3],
    /// The unit normal, towards the body.
    facing: DVec3,
    /// Whether it sees the body.
    sees: bool,
}

/// Not of unit length; of a triangle's front.
fn normal_of([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

impl Touched {
    /// Whether the body moves to where a unit direction points, by more than rounding.
    pub(crate) fn is_left(&self, away: DVec3) -> bool {
        away.dot(self.way) > SAME_NORMAL * self.way.length()
    }
}

impl OnGround<'_> {
    /// Whether a triangle sees a part that is there: always, unless the ground is one-sided and that is behind.
    pub(crate) fn sees(&self, corners: [Vec3; 3], seen_at: SeenAt) -> bool {
        if !self.ground.is_one_sided() {
            return true;
        }
        let corners = corners.map(|corner| corner.as_dvec3());
        seen_at.is_in_front(corners[0], normal_of(corners))
    }

    /// The direction in which a touched triangle pushes a part that is there, and whose it is: no ghosts.
    ///
    /// ```text
    /// the triangle's normal:                               its own
    /// else, where nothing around the point rises into it:  it is that of an edge or a vertex that stands out
    /// else the normal of a face around the point:          of one-sided ground one that the body moves into, if there
    ///                                                      is any;
    ///                                                      of those one that nothing rises into, if there is any;
    ///                                                      of those the one nearest to the direction found
    /// ```
    /// A direction belongs to a point of a set if no part of the set near it lies that way (its normal cone; Ericson,
    /// "Real-Time Collision Detection" (2005), 5.1, has the same as Voronoi regions of edges and vertices). Asked of
    /// all triangles that hold the point and not of those across its edges, it also holds where edges do not meet.
    pub(crate) fn facing(&self, touched: &Touched, seen_at: SeenAt) -> Facing {
        let told = |triangle: u32, away: DVec3| Facing { triangle, away, is_left: touched.is_left(away) };
        let corners = self.ground.corners(touched.triangle).map(|corner| corner.as_dvec3());
        let Some(own) = normal_of(corners).try_normalize() else {
            return told(touched.triangle, touched.away);
        };
        let own = if own.dot(touched.away) < 0.0 { -own } else { own };
        if own.cross(touched.away).length() <= SAME_NORMAL {
            return told(touched.triangle, own);
        }
        let around = self.around(touched.point, corners, seen_at);
        if is_free(&around, touched.point, touched.away) {
            return told(touched.triangle, touched.away);
        }
        let mut best: Option<((bool, bool, f64), &Around)> = None;
        for one in around.iter().filter(|one| one.sees) {
            // The triangle itself, where others are no nearer.
            let nearness =
                one.facing.dot(touched.away) + if one.number == touched.triangle { SAME_NORMAL } else { 0.0 };
            // On ground of two sides, through which nobody comes, the nearest tells what is level.
            let is_met = !self.ground.is_one_sided() || !touched.is_left(one.facing);
            let rank = (is_met, is_free(&around, touched.point, one.facing), nearness);
            if best.is_none_or(|(known, _)| rank > known) {
                best = Some((rank, one));
            }
        }
        best.map_or(told(touched.triangle, touched.away), |(_, one)| told(one.number, one.facing))
    }

    /// The triangles that hold a point.
    fn around(&self, point: DVec3, corners: [DVec3; 3], seen_at: SeenAt) -> ArrayVec<Around, MOST_AROUND> {
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
                    (seen_at.is_in_front(corners[0], cross), self.ground.is_one_sided());
                let facing = if is_in_front || is_one_sided { normal } else { -normal };
                around.push(Around { number, corners, facing, sees: is_in_front || !is_one_sided });
            }
            if around.is_full() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        // Whatever the index hands over first.
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
    /// The greatest cosine between a direction and any way that leads from a point of the triangle along it.
    ///
    /// Those ways are all in its plane from inside, half of them from an edge, a wedge from a corner. Corners alone
    /// would not do: of a sliver, those lie along the edge and hardly across.
    fn rise(&self, point: DVec3, away: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        let slack = 4.0 * ON_TRIANGLE * extent(self.corners);
        let flat = away - self.facing * self.facing.dot(away);
        let front = normal_of(self.corners);
        // Edges that hold the point: along, and inwards.
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

/// Where the bounding sphere of ground is, in its own axes, and its radius.
pub(super) fn sphere_of(ground: Ground) -> (DVec3, f64) {
    match ground {
        Ground::Mesh(mesh) => (mesh.center().as_dvec3(), mesh.outer_radius().into()),
        Ground::Field(field) => (field.center().as_dvec3(), field.outer_radius().into()),
    }
}
