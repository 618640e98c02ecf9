//! A straight run of a chain as a surface: which normals it gives, and which of those found by a kernel are its own.
//!
//! ```text
//! d = unit direction from the ground to the body
//! d along the run's normal:                    its face is touched
//! d leans past an end without a neighbour:     a loose end is touched
//! d leans past an end with a neighbour,
//!     and not towards that:                    the corner is touched, on its outer side               (Voronoi region)
//!     and towards that:                        the neighbour is touched, not this run
//!         a sharp corner, or the body is in front of one run and behind the other:
//!                                              this run adds nothing
//!         a blunt or a concave corner:         the run's normal takes the place of d
//! ```
//! So inner vertices of a straight line, and concave corners, never give a sideways normal. It matters that a sharp
//! corner's contact is the neighbour's alone: what lies below one face of a step lies deep behind the other, and a body
//! that stands on the step, tilted by next to nothing, would be pushed off. Where faces meet bluntly, neither is deep
//! where the other is shallow, and segments that are tiny compared with the depth need a normal other than their end's.

use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::{ALONG_GROUND, BEHIND_END, SHARP_CORNER};
use asunder_geometry::{Chain, Run};

use crate::polygon::outline::Turn;

/// A straight run in the frame of a pair, seen from the side that a body is on.
#[derive(Clone, Copy)]
pub(crate) struct Surface {
    run: Run,
    /// Its ends, and the unit vector from the first to the last.
    ends: [DVec2; 2],
    along: DVec2,
    /// Unit normal, on the body's side.
    pub(crate) normal: DVec2,
    /// Directions along the runs before and after it, where there are any, and whether the body is in front of those.
    neighbours: [Option<(DVec2, bool)>; 2],
    is_front: bool,
    is_one_sided: bool,
}

/// What a direction from the ground to a body is for the run that it was found on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Region {
    /// It is the run's normal.
    Face,
    /// It is that of a corner, or a loose end.
    Corner,
    /// It is neither: the run's normal is to take its place.
    Inner,
    /// It is neither, beyond a sharp corner: the contact is the neighbour's, with this normal.
    Beyond(DVec2),
}

impl Surface {
    /// A run of a turned chain with its origin at `origin`, seen by a body whose centre is given in the same frame.
    /// `None` where a one-sided chain faces away from it. A body without a centre counts as in front.
    pub(crate) fn new(
        chain: &Chain,
        run: &Run,
        (turn, origin): (&Turn, DVec2),
        center: Option<DVec2>,
    ) -> Option<Self> {
        let vertex = |index: u32| chain.vertices().get(index as usize).map(|vertex| vertex.as_dvec2());
        let straight = |run: &Run| {
            let [from, to] = run.vertices();
            turn.turn(vertex(to)? - vertex(from)?).try_normalize()
        };
        let [from, to] = run.vertices();
        let ends = [origin + turn.turn(vertex(from)?), origin + turn.turn(vertex(to)?)];
        let along = straight(run)?;
        let front = right_of(along);
        let is_before =
            |along: DVec2, end: DVec2| center.is_none_or(|center| right_of(along).dot(center - end) >= 0.0);
        let is_front = is_before(along, ends[0]);
        if chain.is_one_sided() && !is_front {
            return None;
        }
        let neighbour = |run: Option<Run>, end: DVec2| {
            let along = straight(&run?)?;
            Some((along, is_before(along, end)))
        };
        Some(Self {
            run: *run,
            ends,
            along,
            normal: if is_front { front } else { -front },
            neighbours: [neighbour(chain.run_before(run), ends[0]), neighbour(chain.run_after(run), ends[1])],
            is_front,
            is_one_sided: chain.is_one_sided(),
        })
    }

    /// Which edge of the segment from its first vertex to its last faces along the normal.
    pub(crate) fn edge(&self) -> usize {
        usize::from(!self.is_front)
    }

    /// At which ends the next run rises on the body's side: concave corners.
    pub(crate) fn concave_ends(&self) -> [bool; 2] {
        let rises = |end: usize| {
            let Some((next, is_front)) = self.neighbours[end] else { return false };
            let leaving = if end == 1 { next } else { -next };
            // A body over the lid of a two-sided crate is behind the lid as its walls are seen from there.
            is_front == self.is_front && leaving.dot(self.normal) > ALONG_GROUND
        };
        [rises(0), rises(1)]
    }

    /// The ends that a point's foot lies beyond.
    pub(crate) fn is_beyond(&self, point: DVec2) -> [bool; 2] {
        [(point - self.ends[0]).dot(self.along) < 0.0, (point - self.ends[1]).dot(self.along) > 0.0]
    }

    /// What a unit direction from the ground to the body is.
    pub(crate) fn region_of(&self, direction: DVec2) -> Region {
        let (lean, height) = (direction.dot(self.along), direction.dot(self.normal));
        if lean.abs() <= ALONG_GROUND {
            return if height > 0.0 { Region::Face } else { Region::Inner };
        }
        let end = usize::from(lean > 0.0);
        let Some((next, is_in_front)) = self.neighbours[end] else {
            let is_seen = !self.is_one_sided || height >= -BEHIND_END;
            return if is_seen { Region::Corner } else { Region::Beyond(self.normal) };
        };
        // Away from the corner.
        let leaving = if end == 1 { next } else { -next };
        // Only a body behind the face meets a concave corner in such a direction. A convex corner of less than a right
        // angle is different: its normals may point away from the face. A chain that turns straight back is a wall
        // without width, with a tip.
        let rise = leaving.dot(self.normal);
        let leads_back = rise.abs() <= ALONG_GROUND && leaving.dot(self.along) * lean < 0.0;
        let is_convex = rise < 0.0 || leads_back;
        let is_seen = !self.is_one_sided || is_convex || height >= -ALONG_GROUND;
        if direction.dot(leaving) <= ALONG_GROUND && is_seen {
            return Region::Corner;
        }
        let normal = if is_in_front { right_of(next) } else { -right_of(next) };
        // A body in front of one run and behind the other sees the corner over the one that it is beyond.
        let is_across = is_in_front != self.is_front && !self.is_one_sided;
        let is_sharp = rise < 0.0 && normal.dot(self.normal) < SHARP_CORNER;
        if is_across || (is_sharp && is_in_front == self.is_front) {
            Region::Beyond(normal)
        } else {
            Region::Inner
        }
    }

    /// The same for a point where the ground is touched: inner vertices that the run may have are no corners. `near` is
    /// how far from an end counts as the end.
    pub(crate) fn region_at(&self, direction: DVec2, point: DVec2, near: f64) -> Region {
        let region = self.region_of(direction);
        let end = self.ends[usize::from(direction.dot(self.along) > 0.0)];
        let is_inner = (point - end).dot(self.along).abs() > near + self.run.unevenness();
        if is_inner && region != Region::Face { Region::Inner } else { region }
    }
}

/// The direction to the right of another.
fn right_of(along: DVec2) -> DVec2 {
    -along.perp()
}
