//! Where two polyhedra touch: one normal and up to four points.
//!
//! ```text
//! choose the axis: last frame's, unless another beats it by more than twice the preference; else
//!                  a face of A, unless a face of B or two edges beat it by more than the preference
//! two edges:  the faces beside them, if they nearly face each other; else the nearest points of the edges
//! a face:     the incident face is the other shape's most opposed one, of those at its deepest vertex      (incident)
//!             clip it against planes through the reference face's edges, along the normal                  (clip)
//!             keep the points within the margin of the reference plane                                     (patch)
//! if clipping removed the deepest point: try the best axis; then, in a gap, two faces that nearly face each other
//! across it; then edges that lie side by side; then the witness points                                     (single)
//! if the edges do not lie over each other, or the face not over what touches it: other features as deep     (over)
//! reduce to four                                                                                           (reduce)
//! ```
//! Two hulls of 32 vertices face on face take 370 ns here, about a twelfth of their whole answer without a hint: a
//! third of it is clipping, a fifth the incident face, 7 % the choice of four (AMD EPYC, Zen 4, 2026-11-21). What makes
//! it cheap:
//!
//! 1. the incident face is searched around the deepest vertex only, not among all faces and their loops. In hulls of
//!    many vertices, lanes of f32 discard most of them; the search ends at the first face that holds all of three or
//!    more deepest vertices (335 ns to 300 in all where a hull stands on a wide floor);
//! 2. faces are clipped in the plane across the normal, where a side is a line: each corner is projected once, and
//!    nothing that is cut away is mapped back to space;
//! 3. a side with no corner beyond it copies nothing, and any other copies indices of corners, not corners;
//! 4. the axis already holds how deep the deepest vertex is, so that the reference plane needs no support search;
//! 5. for five to eight corners the best four are found by trying all.
//!
//! Every corner of the clipped polygon carries the features it comes from. Its id is made of those, and of the features
//! near it (near).

mod clip;
mod frame;
mod incident;
pub(super) mod near;
mod over;
mod patch;
mod single;

pub(super) use frame::Frame;
pub(super) use incident::Far;
pub(crate) use incident::opposed_face;
pub(super) use single::{are_side_by_side, nearest_edges};

use super::distance::Witness;
use super::rods::side_by_side;
use super::sat::{Axes, Axis, AxisOf, face_axis_a, face_axis_b};
use super::solid::Solid;
use crate::feature::FeatureId;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::ALIGNED_FACES;
use patch::Faces;
use single::{closest_point, deepest_point, edge_point};

/// A contact point, in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) separation: f64,
    pub(crate) on_a: DVec3,
    pub(crate) on_b: DVec3,
    pub(crate) feature: FeatureId,
}

impl Point {
    /// Closest points of two cores, moved out to the surfaces along the normal.
    pub(super) fn on_surfaces(self, [of_a, of_b]: [f64; 2], normal: DVec3) -> Self {
        Self {
            separation: self.separation - of_a - of_b,
            on_a: self.on_a + normal * of_a,
            on_b: self.on_b - normal * of_b,
            ..self
        }
    }
}

/// At most four contact points, in order of their feature ids.
pub(crate) type Points = ArrayVec<Point, 4>;

/// A contact normal and its points, in the frame of the pair.
pub(crate) struct Touch {
    pub(crate) normal: DVec3,
    pub(crate) points: Points,
    /// The axis that the points were built on, to be tried first in the next frame. `None` where they are the closest
    /// points of a gap, or belong to a shape without faces.
    pub(crate) of: Option<AxisOf>,
}

impl Touch {
    /// An empty result, without points yet. Not a constant: that would be copied, unused slots included.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self { normal: DVec3::ZERO, points: ArrayVec::new_const(), of: None }
    }
}

/// The input from which contact points are built.
#[derive(Clone, Copy)]
pub(crate) struct TouchInput<'a> {
    /// The best axes.
    pub(crate) axes: &'a Axes,
    /// Closest points of the cores, where those do not overlap.
    pub(crate) witness: Option<&'a Witness>,
    /// The widest gap in which a point is wanted, in metres.
    pub(crate) margin: f64,
    /// By how much another axis must beat a face of A to be preferred, in metres.
    pub(crate) preference: f64,
    /// Corners no further than this above the deepest count as equally deep when four of more are chosen, in metres.
    pub(crate) even: f64,
    /// How near a point must be to a vertex or an edge to be named after it, in metres.
    pub(crate) near: f64,
    /// [`Touch::of`] of the last frame. That axis is kept until another beats it by more than two preferences. A stale
    /// one, or one made for other shapes, has no effect.
    pub(crate) last: Option<AxisOf>,
}

/// Builds the manifold of shapes that overlap, or are at most the margin apart.
///
/// An axis that is only nearly the best may have its deepest point clipped away, because what touches lies just beside
/// its face. Then the best axis is tried in its place; in a gap, faces that nearly face each other across it; and last
/// the witness points.
pub(crate) fn touch(a: &Solid, b: &Solid, input: &TouchInput) -> Touch {
    let mut touch = Touch::none();
    touch_into(a, b, input, &mut touch);
    touch
}

/// [`touch`] in place: a manifold is large, and this avoids moving it.
pub(crate) fn touch_into(a: &Solid, b: &Solid, input: &TouchInput, touch: &mut Touch) {
    if !input.along_axes(a, b, touch) {
        input.at_last(a, b, touch);
    }
}

impl TouchInput<'_> {
    fn depths(&self, a: &Solid, b: &Solid) -> Depths {
        let deep = self.at_stake() + self.preference;
        let least = deep - a.radius - b.radius;
        // Everything as deep as the deepest vertex up to rounding belongs to the manifold, even where it is no deeper
        // than zero: a body that rests exactly on a face rests on all of its corners.
        let (slack, even, near) = (self.preference, self.even, self.near);
        Depths { deep, least, within: self.margin.max(least), slack, even, near }
    }

    /// The separation of the cores.
    fn at_stake(&self) -> f64 {
        self.witness.map_or(self.axes.best().separation, |witness| witness.distance)
    }

    /// Builds points on the first axis with a point that counts as deepest: last frame's, the preferred, or the best.
    /// Returns whether there is one.
    fn along_axes(&self, a: &Solid, b: &Solid, touch: &mut Touch) -> bool {
        let (depths, at_stake) = (self.depths(a, b), self.at_stake());
        let kept = self.last.and_then(|last| self.axis_of(a, b, last));
        if let Some(kept) = &kept
            && kept.separation >= at_stake - 2.0 * self.preference
            && self.along_axis(a, b, kept, &depths, touch)
        {
            return true;
        }
        let (preferred, best) = (self.preferred(), self.axes.best());
        let is_new = |axis: &Axis| kept.is_none_or(|kept| kept.of != axis.of);
        let does_touch = |axis: &Axis, touch: &mut Touch| {
            axis.separation >= at_stake - self.preference
                && is_new(axis)
                && self.along_axis(a, b, axis, &depths, touch)
        };
        does_touch(preferred, touch) || (best.of != preferred.of && does_touch(best, touch))
    }

    /// Builds points on an axis; returns whether one of them counts as deepest.
    fn along_axis(&self, a: &Solid, b: &Solid, axis: &Axis, depths: &Depths, touch: &mut Touch) -> bool {
        let is_deep = match axis.of {
            AxisOf::FaceA(face) => add_face_points((a, face), b, axis, depths, &mut touch.points),
            AxisOf::FaceB(face) => add_face_points((b, face), a, axis, depths, &mut touch.points),
            AxisOf::Edges(..) if self.witness.is_some() => false,
            AxisOf::Edges(edge_a, edge_b) => {
                add_aligned_faces((a, b), axis.normal, depths, &mut touch.points) || {
                    let point = edge_point(a, b, (edge_a, edge_b), axis, self.preference);
                    touch.points.push(point);
                    point.separation <= depths.least
                }
            }
        };
        if is_deep {
            (touch.normal, touch.of) = (axis.normal, Some(axis.of));
            return true;
        }
        touch.points.clear();
        false
    }

    /// The fallback where no axis has a point that is deep enough.
    fn at_last(&self, a: &Solid, b: &Solid, touch: &mut Touch) {
        let Some(witness) = self.witness else {
            let best = self.axes.best();
            (touch.normal, touch.of) = (best.normal, Some(best.of));
            touch.points.push(deepest_point(a, b, best, self.preference));
            return;
        };
        let depths = self.depths(a, b);
        touch.normal = witness.across;
        if !add_aligned_faces((a, b), witness.across, &depths, &mut touch.points) {
            match side_by_side((a, b), witness.across, witness.distance, depths.within, self.preference) {
                Some(points) => touch.points = points,
                None => touch.points.push(closest_point(a, b, witness)),
            }
        }
    }

    fn preferred(&self) -> &Axis {
        let Axes { face_a, face_b, edges, .. } = self.axes;
        let face = if face_b.separation > face_a.separation + self.preference { face_b } else { face_a };
        let do_edges = self.witness.is_none() && edges.separation > face.separation + self.preference;
        if do_edges { edges } else { face }
    }

    /// The axis of a feature. For a face that is not among the best axes, it is computed by projection; an edge pair
    /// that is not the best is not computed again.
    fn axis_of(&self, a: &Solid, b: &Solid, of: AxisOf) -> Option<Axis> {
        let known = [&self.axes.face_a, &self.axes.face_b, &self.axes.edges];
        let is_known = |axis: &&Axis| axis.of == of && axis.separation > f64::NEG_INFINITY;
        if let Some(axis) = known.into_iter().find(is_known) {
            return Some(*axis);
        }
        match of {
            AxisOf::FaceA(face) if a.has_face(face as u32) => Some(face_axis_a(a, b, face)),
            AxisOf::FaceB(face) if b.has_face(face as u32) => Some(face_axis_b(a, b, face)),
            _ => None,
        }
    }
}

/// Which corners of a patch become contact points, in metres.
#[derive(Clone, Copy)]
struct Depths {
    /// Corners of the cores no further apart than this count as deepest.
    deep: f64,
    /// Points no further apart than this, on the shapes' surfaces, count as deepest.
    least: f64,
    /// Points no further apart than this, on the shapes' surfaces, are wanted.
    within: f64,
    /// Places and heights that differ by no more than this count as the same.
    slack: f64,
    /// Points no further than this above the deepest count as equally deep when four of more are chosen.
    even: f64,
    /// How near a point must be to a vertex or an edge to be named after it.
    near: f64,
}

/// Adds contact points between the face whose normal an axis is and the other shape; returns whether one of them counts
/// as deepest.
fn add_face_points<'a>(
    reference: (&'a Solid<'a>, usize),
    incident: &'a Solid<'a>,
    axis: &Axis,
    depths: &Depths,
    points: &mut Points,
) -> bool {
    let is_b = matches!(axis.of, AxisOf::FaceB(_));
    let along = if is_b { -axis.normal } else { axis.normal };
    let opposed = opposed_face(incident, along, depths.slack);
    // The axis already holds how far the deepest vertex is from the plane.
    let origin = incident.point(opposed.deepest) - along * axis.separation;
    let faces = Faces { reference, incident: (incident, opposed.face), is_b };
    faces.add_points(&Frame::level(along, origin), depths, points)
}

/// Adds contact points of two faces that nearly face each other along an axis that is the normal of neither. Returns
/// whether it did: the faces must be nearly aligned, and one of the points must count as deepest.
///
/// A box that rests on a box, tilted by a hair, touches it where two edges cross: a single point, which jumps to
/// another corner with the next tiny tilt, and on which nothing can stand. The crossing is also a corner of the two
/// faces' common patch as projected along the axis. The patch stays, and axis and depth remain exact.
fn add_aligned_faces<'a>(
    (a, b): (&'a Solid<'a>, &'a Solid<'a>),
    normal: DVec3,
    depths: &Depths,
    points: &mut Points,
) -> bool {
    // Most hulls have no such face, which is found here without a vertex search: frames of falling hulls take 0.97 of
    // the time.
    if a.is_slender() || b.is_slender() || !a.may_look_along(normal) || !b.may_look_along(-normal) {
        return false;
    }
    let face_a = opposed_face(a, -normal, depths.slack).face;
    let facing_a = a.normal(face_a);
    if facing_a.dot(normal) < ALIGNED_FACES {
        return false;
    }
    let face_b = opposed_face(b, normal, depths.slack).face;
    if b.normal(face_b).dot(normal) > -ALIGNED_FACES {
        return false;
    }
    // A face merged of several is not exactly flat: its plane goes through the highest of its corners.
    let corners = a.topology.face_vertices(face_a).map(|vertex| a.point(vertex));
    let higher = |one: DVec3, other: DVec3| if facing_a.dot(other) > facing_a.dot(one) { other } else { one };
    let Some(origin) = corners.reduce(higher) else { return false };
    let faces = Faces { reference: (a, face_a), incident: (b, face_b), is_b: false };
    let are_deep = faces.add_points(&Frame::leaning(normal, facing_a, origin), depths, points);
    if !are_deep {
        points.clear();
    }
    are_deep
}
