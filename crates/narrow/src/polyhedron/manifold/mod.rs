//! Where two polyhedra touch: up to four points on one normal.
//!
//! ```text
//! choose what touches: last frame's axis unless another beats it by twice a preference; else
//!                      a face of A unless a face of B, or two edges, beat it by more than the preference
//! two edges:  the faces beside them, if they nearly look at each other; else the nearest points of their lines
//! a face:     the other shape's incident face is the one most opposed, of those at its deepest vertex   (incident)
//!             clip it against planes through the reference face's edges, along the normal               (clip)
//!             keep the points within the margin of the reference plane                                  (patch)
//! if the deepest point was clipped away, ask the axis that is best of all; then, in a gap, the faces that nearly look at
//! each other across it; then edges that lie side by side; then the witness points                       (single)
//! where edges turn out to lie beside each other, or a face beside what touches: any features as deep    (over)
//! reduce to four                                                                                        (reduce)
//! ```
//! Two hulls of 32 vertices face on face take 370 ns here, about a twelfth of their whole answer without a hint: a
//! third of it is clipping, a fifth the incident face, 7 % the choice of four (AMD EPYC, Zen 4, 2026-11-21). What
//! makes it cheap:
//!
//! 1. the incident face is looked for around the deepest vertex only, and not among all faces and their loops; where
//!    vertices are many, lanes of f32 leave out most; it is the first that has all of three vertices or more (335 ns to
//!    300 in all where a hull stands on a wide floor);
//! 2. faces are clipped in the plane across the normal, where a side is a line: no corner is turned twice, and none of
//!    what is cut away comes back to space;
//! 3. a side that no corner is beyond copies nothing, and where it does, places of corners and not corners;
//! 4. the axis has told how deep the deepest vertex is, so that the reference plane needs no support search;
//! 5. of five to eight corners the best four are found by trying all.
//!
//! Every corner of the clipped polygon carries the features it comes from. Its id is made of those, and of what is near
//! (near)

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

/// A contact point in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) separation: f64,
    pub(crate) on_a: DVec3,
    pub(crate) on_b: DVec3,
    pub(crate) feature: FeatureId,
}

impl Point {
    /// A point where two cores are closest, moved out to the surfaces along the normal.
    pub(super) fn on_surfaces(self, [of_a, of_b]: [f64; 2], normal: DVec3) -> Self {
        Self {
            separation: self.separation - of_a - of_b,
            on_a: self.on_a + normal * of_a,
            on_b: self.on_b - normal * of_b,
            ..self
        }
    }
}

/// At most four, in order of their feature ids.
pub(crate) type Points = ArrayVec<Point, 4>;

/// A normal and its points, in the frame of the pair.
pub(crate) struct Touch {
    pub(crate) normal: DVec3,
    pub(crate) points: Points,
    /// The axis that the points were made on, for the next frame to keep; none where they are the closest points of a
    /// gap, or belong to a shape without faces.
    pub(crate) of: Option<AxisOf>,
}

impl Touch {
    /// Not yet a manifold: it has no points. Not a constant: that would be copied, blanks and all.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self { normal: DVec3::ZERO, points: ArrayVec::new_const(), of: None }
    }
}

/// What contact points are made of.
#[derive(Clone, Copy)]
pub(crate) struct Ask<'a> {
    /// The best axes.
    pub(crate) axes: &'a Axes,
    /// Closest points of the cores, where those do not overlap.
    pub(crate) witness: Option<&'a Witness>,
    /// The widest gap in which a point is wanted, in metres.
    pub(crate) margin: f64,
    /// How much another axis must beat a face of A by, in metres.
    pub(crate) preference: f64,
    /// Corners no further above the deepest are as deep as any where four of more are chosen, in metres.
    pub(crate) even: f64,
    /// How near a point must be to a vertex or an edge to be named after it, in metres.
    pub(crate) near: f64,
    /// What [`Touch::of`] was in the last frame. It keeps its role until another axis beats it by more than two
    /// preferences; one that is stale, or not of these shapes, changes nothing.
    pub(crate) last: Option<AxisOf>,
}

/// The manifold of shapes that overlap, or that a gap of at most the margin parts.
///
/// An axis that only nearly is the best may have its deepest point clipped away, because what touches lies just beside
/// its face. Then the best axis is asked in its place; in a gap, faces that nearly look at each other across it, and at
/// last the witness points.
pub(crate) fn touch(a: &Solid, b: &Solid, ask: &Ask) -> Touch {
    let mut touch = Touch::none();
    touch_into(a, b, ask, &mut touch);
    touch
}

/// The same in place: a manifold is large, and is not moved for nothing.
pub(crate) fn touch_into(a: &Solid, b: &Solid, ask: &Ask, touch: &mut Touch) {
    if !ask.along_axes(a, b, touch) {
        ask.at_last(a, b, touch);
    }
}

impl Ask<'_> {
    fn depths(&self, a: &Solid, b: &Solid) -> Depths {
        let deep = self.at_stake() + self.preference;
        let least = deep - a.radius - b.radius;
        // Everything as deep as the deepest vertex up to rounding belongs to the manifold, also where that is no
        // deeper than zero: a body that rests exactly on a face rests on all of its corners.
        let (slack, even, near) = (self.preference, self.even, self.near);
        Depths { deep, least, within: self.margin.max(least), slack, even, near }
    }

    /// The separation of the cores.
    fn at_stake(&self) -> f64 {
        self.witness.map_or(self.axes.best().separation, |witness| witness.distance)
    }

    /// Points on the first axis that has one as deep as any, of last frame's, the preferred and the best; whether
    /// there is one.
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

    /// Points on an axis; whether one is as deep as any.
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

    /// What is left where no axis has a point that is deep enough.
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

    /// The axis of a feature: of faces that are not among the best, by projection. Edges that are not the best are not
    /// asked for again.
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

/// Which corners of a patch become points, in metres.
#[derive(Clone, Copy)]
struct Depths {
    /// Corners of the cores no further apart than this are as deep as any.
    deep: f64,
    /// Points of the shapes no further apart than this are as deep as any.
    least: f64,
    /// Points of the shapes no further apart than this are wanted.
    within: f64,
    /// Places and heights that differ by no more are the same.
    slack: f64,
    /// Points of the shapes no further above the deepest are as deep as any where four of more are chosen.
    even: f64,
    /// How near a point must be to a vertex or an edge to be named after it.
    near: f64,
}

/// Adds contact points of a face that an axis is normal to, and the other shape; whether there is one as deep as any.
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
    // The axis has told how far the deepest vertex is from the plane.
    let origin = incident.point(opposed.deepest) - along * axis.separation;
    let faces = Faces { reference, incident: (incident, opposed.face), is_b };
    faces.add_points(&Frame::level(along, origin), depths, points)
}

/// Adds contact points of two faces that look at each other along an axis that is neither's own, if they nearly do and
/// one of the points is as deep as any; whether it did.
///
/// A box that rests on a box, tilted by a hair, touches it where two edges cross: one point, which jumps to another
/// corner with the next hair, and on which nothing can stand. The crossing is also a corner of the patch that both
/// faces share as seen along the axis. The patch holds, and keeps the axis and the depth exact.
fn add_aligned_faces<'a>(
    (a, b): (&'a Solid<'a>, &'a Solid<'a>),
    normal: DVec3,
    depths: &Depths,
    points: &mut Points,
) -> bool {
    // Of hulls most do not, and then no vertex need be looked for: frames of falling hulls take 0.97 of the time.
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
    // A face that was merged of several reaches as far as the highest of its corners.
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
