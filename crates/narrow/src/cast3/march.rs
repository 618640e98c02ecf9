//! Two convex cores that move without turning: one simplex all the way.
//!
//! ```text
//! s = where the bounding spheres meet, n = from centre to centre, no corners
//! repeat
//!   w = the vertices of both that are furthest along n, and the gap that they show along it at s
//!   the gap does not close before the end: n separates them for good, no impact
//!   s = s + gap / how fast it closes: nothing touches before
//!   v = the point nearest to the origin of the hull of the corners and w, moved to s; keep the corners that carry it
//!   |v| within tolerance: an impact at s
//!   n = v/|v|
//! ```
//! G. van den Bergen, "Ray casting against general convex objects with application to continuous collision detection"
//! (2004): the point that moves against A - B. Every step is certified by its own projection, so nothing before s, and
//! no miss, depends on the simplex; that only proposes axes, and gives the points that say how near the two are. Where
//! it stalls, or they touch at the start, it gives no answer, and `advance` takes over, which refines each distance
//! before it moves on.
//!
//! What makes it fast:
//!
//! 1. one search for the whole way: no distance is found but the last;
//! 2. it starts where the bounding spheres meet: a step saved, and the way there no longer costs digits;
//! 3. supports in f32 lanes, with their error bound, until the gap is near that bound: half the cost of each;
//! 4. shapes stand still, and the origin moves: nothing is placed twice.

use super::advance::{End, Met};
use super::passage::{Course, Stretch, length, outlasts_rounded};
use crate::polyhedron::closest::Placed;
use crate::polyhedron::simplex::{Corners, nearest_of_all, nearest_to_origin};
use crate::polyhedron::solid::Solid;
use crate::precision::{IN_SPACE, closed_after, off_closing};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// Steps after which `advance` takes over.
const MAX_STEPS: usize = 64;

/// A rough support is good enough while the gap is this many times its error.
const ROUGH: f64 = 8.0;

/// Vertices of A and of B, and the way from one to the other at the start of the stretch.
type Corner = ([usize; 2], DVec3);

/// Corners of the Minkowski difference that carry its point nearest to the origin, with their weights.
struct Simplex {
    corners: ArrayVec<Corner, 4>,
    weights: [f64; 3],
    nearest: DVec3,
}

/// Both cores, and the error bound of their projections.
struct March<'a> {
    a: &'a Solid<'a>,
    b: &'a Solid<'a>,
    drift: DVec3,
    /// Subtracted from any projection on the way: its error, that of poses, and both radii.
    taken: f64,
}

/// What the projection on an axis shows.
struct Shown {
    corner: Corner,
    /// A lower bound on the gap.
    gap: f64,
    /// An upper bound on how fast it closes.
    closing: f64,
}

/// Moves two cores along a stretch until they touch; `None` where it cannot tell.
pub(super) fn march(course: &Course, stretch: &Stretch) -> Option<End> {
    let moment = course.at(stretch.from);
    let (Placed::Core(a), Placed::Core(b)) = (&moment.a, &moment.b) else { return None };
    let (drift, span) = (course.passage.drift, stretch.to - stretch.from);
    let doubt =
        moment.precision.projection() + IN_SPACE.of_parts * (f64::EPSILON / 2.0) * length(drift) * span;
    let rest = course.fineness.rest(doubt);
    let march = March { a, b, drift, taken: course.radii + course.slack + doubt };
    let enough = if course.radii > 0.0 { course.fineness.gap(doubt) } else { 4.0 * rest };
    let mut axis = (stretch.apart - drift * stretch.from).try_normalize()?;
    let (mut done, mut kept, mut is_rough, mut is_near) = (0.0, None, true, false);
    let mut simplex = Simplex { corners: ArrayVec::new(), weights: [0.0; 3], nearest: DVec3::ZERO };
    // Whether they certainly do not touch at the start.
    let mut is_parted = stretch.from > 0.0;
    let mut distance = f64::INFINITY;
    for _ in 0..MAX_STEPS {
        let Shown { corner, gap, closing } = march.shown(axis, done, is_rough);
        if gap > 0.0 && outlasts_rounded((gap, course.slack), closing, (drift, span - done)) {
            return Some(End::Apart);
        }
        is_parted |= gap > 0.0;
        if is_near && is_parted && gap > -enough {
            return course.reached(stretch, (done, axis, doubt), simplex.points(a, b));
        }
        let step = if gap > rest { closed_after(gap - rest, closing) } else { 0.0 };
        let is_known = simplex.corners.iter().any(|known| known.0 == corner.0);
        if step > 0.0 {
            (done, kept) = (done + step, Some(axis));
        } else if is_known {
            if !is_rough {
                break;
            }
            is_rough = false;
            continue;
        }
        let before = distance;
        // Once the origin has moved, the nearest point may be further than before.
        let nearer_than = if step > 0.0 { f64::INFINITY } else { distance };
        distance = simplex.grow((!is_known).then_some(corner), drift * done, nearer_than)?;
        let is_within = distance - course.radii - course.slack <= enough;
        match kept {
            Some(axis) if is_within && course.radii == 0.0 => {
                return course.reached(stretch, (done, axis, doubt), simplex.points(a, b));
            }
            _ if step > 0.0 || distance < before => {}
            _ if is_rough => is_rough = false,
            _ => break,
        }
        // Round shapes take the axis from one point to the other, after one more projection on it.
        is_near = is_within && course.radii > 0.0;
        axis = simplex.nearest / distance;
    }
    None
}

impl March<'_> {
    /// What an axis shows once `done` of the stretch is done. By rough supports, unless those are not wanted or the gap
    /// is near their error; for a gap far below zero only the corner matters.
    fn shown(&self, axis: DVec3, done: f64, is_rough: bool) -> Shown {
        let closing = axis.dot(self.drift) + off_closing(self.drift);
        let taken = self.taken + closing * done;
        let corner = |a: usize, b: usize| ([a, b], self.b.point(b) - self.a.point(a));
        if is_rough {
            let ((in_a, off_a), (in_b, off_b)) = (self.a.rough_support(axis), self.b.rough_support(-axis));
            let gap = -in_b.reach - in_a.reach - taken;
            if gap.abs() > ROUGH * (off_a + off_b) {
                return Shown { corner: corner(in_a.vertex, in_b.vertex), gap, closing };
            }
        }
        let (in_a, in_b) = (self.a.support(axis), self.b.support(-axis));
        Shown { corner: corner(in_a.vertex, in_b.vertex), gap: -in_b.reach - in_a.reach - taken, closing }
    }
}

impl Simplex {
    /// Adds a corner, and drops those that do not carry the point nearest to `origin`, which is where the origin has
    /// moved to. Returns that point's distance; `None` if the origin is contained. Compares all faces if the first that
    /// fits is not nearer than `nearer_than`, or if no corner was added: then the last need not be part of the nearest
    /// face.
    fn grow(&mut self, corner: Option<Corner>, origin: DVec3, nearer_than: f64) -> Option<f64> {
        if let Some(corner) = corner {
            self.corners.try_push(corner).ok()?;
        }
        let mut seen = Corners { places: [DVec3::ZERO; 4], count: self.corners.len() };
        for (place, &(_, corner)) in seen.places.iter_mut().zip(&self.corners) {
            *place = corner - origin;
        }
        let mut nearest = nearest_to_origin(&seen)?;
        let is_nearer = nearest.point.length() < nearer_than;
        if corner.is_none() || !is_nearer {
            nearest = nearest_of_all(&seen);
        }
        // In place: picks ascend.
        for (to, &from) in nearest.picks[..nearest.count].iter().enumerate() {
            self.corners[to] = self.corners[from];
        }
        self.corners.truncate(nearest.count);
        self.weights = nearest.weights;
        self.nearest = nearest.point;
        let distance = nearest.point.length();
        (distance > 0.0).then_some(distance)
    }

    /// The points of A and B at which the simplex' nearest point is.
    fn points(&self, a: &Solid, b: &Solid) -> [DVec3; 2] {
        [(a, 0), (b, 1)].map(|(solid, which)| {
            let mut corners = self
                .corners
                .iter()
                .zip(self.weights)
                .map(|((corner, _), weight)| (solid.point(corner[which]), weight));
            let first = corners.next().map_or(DVec3::ZERO, |(point, _)| point);
            corners.fold(first, |sum, (point, weight)| sum + (point - first) * weight)
        })
    }
}

impl Course<'_> {
    /// The impact at the nearest points of both cores, which are given as at the start of the stretch and moved to the
    /// impact.
    fn reached(
        &self,
        stretch: &Stretch,
        (done, normal, doubt): (f64, DVec3, f64),
        [on_a, on_b]: [DVec3; 2],
    ) -> Option<End> {
        // Never too far, whatever the sum's rounding.
        let fraction =
            if done > 0.0 { (stretch.from + done).next_down().min(stretch.to) } else { stretch.from };
        let [start, between] = [stretch.from, fraction].map(|at| self.passage.between_at(at));
        let distance = (on_b - start + between - on_a).length();
        let gap = distance - self.radii + doubt + self.rounding(fraction, between);
        let radius = |i: usize| f64::from(self.parts[i].shape.radius());
        let anchors = [on_a + normal * radius(0), on_b - start - normal * radius(1)];
        Some(End::Met(Met { fraction, gap: gap.max(0.0), normal, anchors }))
    }
}
