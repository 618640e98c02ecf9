//! A face cut by the sides of another, as seen along a direction: in the plane.
//!
//! ```text
//! for each side of the reference face:
//!   each corner of the polygon is beyond the side's line, or on it, or within
//!   none beyond: the polygon stays as it is, and nothing is copied
//!   else: keep what is within or on the line, and add a corner wherever the polygon goes from within to beyond or back
//! ```
//! Sutherland and Hodgman, "Reentrant polygon clipping" (1974). Each corner is classed once a side, with a slack: what
//! lies on the line up to that is kept as it is, name and all. So equal boxes in a stack, whose corners are off each
//! other's sides by rounding either way, touch at the same corners in every frame; and a crossing is never cut from an
//! edge that runs along the line, where its place would be rounding.
//!
//! Sides are made of the reference face's own edges and not of neighbouring faces, so that a face which is flat only up
//! to rounding clips like one that is flat.

use arrayvec::ArrayVec;

/// A polygon being clipped, of at most `N` corners: clockwise, since it is a face seen from behind.
pub(super) type Ring<const N: usize> = ArrayVec<Corner, N>;

/// A corner of the polygon being clipped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) at: [f64; 2],
    pub(super) height: f64,
    pub(super) name: Name,
    /// What the polygon's edge from this corner to the next lies on.
    pub(super) leaving: Leaving,
    /// How far it lies beyond the side that is being cut at, times that side's length.
    beyond: f64,
}

/// What a corner of a patch is made of, by the indices of the two faces' own topologies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Name {
    /// A vertex of the incident face.
    Incident(u16),
    /// A vertex of the reference face.
    Reference(u16),
    /// A half-edge of the reference face and one of the incident face, over each other.
    Crossing(u16, u16),
}

/// What an edge of the polygon lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Leaving {
    /// A half-edge of the incident face.
    Incident(u16),
    /// A side of the reference face, by its half-edge.
    Side(u16),
}

impl Corner {
    /// The start of an edge of the incident face.
    pub(super) fn of_incident(vertex: usize, half_edge: usize, at: [f64; 2], height: f64) -> Self {
        let leaving = Leaving::Incident(half_edge as u16);
        Self { at, height, name: Name::Incident(vertex as u16), leaving, beyond: 0.0 }
    }

    /// The corner where an edge from one within to one beyond meets the side.
    fn between(within: &Self, beyond: &Self, name: Name, leaving: Leaving) -> Self {
        let share = within.beyond / (within.beyond - beyond.beyond);
        let mix = |from: f64, to: f64| from + (to - from) * share;
        let at = [mix(within.at[0], beyond.at[0]), mix(within.at[1], beyond.at[1])];
        Self { at, height: mix(within.height, beyond.height), name, leaving, beyond: 0.0 }
    }
}

/// A side of the reference face, which lies to its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) from: [f64; 2],
    pub(super) along: [f64; 2],
    pub(super) half_edge: u16,
    /// The vertex that the side starts from, and the side that leads there.
    pub(super) start: (u16, u16),
    /// The vertex that it leads to, and the side that goes on from there.
    pub(super) end: (u16, u16),
}

impl Side {
    /// Keeps the part of the polygon that is not beyond this side; what is beyond by no more than `slack` stays. What is
    /// kept is put together in `spare`, which then is the polygon.
    pub(super) fn cut<'r, const N: usize>(
        &self,
        polygon: &mut &'r mut Ring<N>,
        spare: &mut &'r mut Ring<N>,
        slack: f64,
    ) {
        let [dx, dy] = self.along;
        let slack = slack * (dx * dx + dy * dy).sqrt();
        let mut furthest = f64::NEG_INFINITY;
        for corner in polygon.iter_mut() {
            corner.beyond = dy * (corner.at[0] - self.from[0]) - dx * (corner.at[1] - self.from[1]);
            furthest = furthest.max(corner.beyond);
        }
        if furthest > slack {
            spare.clear();
            if let Some(kept) = run_within(polygon, furthest, slack) {
                self.keep(kept, polygon, spare, slack);
            }
            core::mem::swap(polygon, spare);
        }
    }

    /// Takes the corners of a run, which ends before `end` and may go around, and what stands where the polygon comes
    /// back from beyond this side and where it goes out.
    fn keep<const N: usize>(
        &self,
        (begin, end): (usize, usize),
        polygon: &Ring<N>,
        clipped: &mut Ring<N>,
        slack: f64,
    ) {
        let before = |i: usize| if i == 0 { polygon.len() - 1 } else { i - 1 };
        let is_within = |corner: &Corner| corner.beyond < -slack;
        let mut push = |corner: Corner| {
            let _ = clipped.try_push(corner);
        };
        let (beyond, first) = (&polygon[before(begin)], &polygon[begin]);
        // Coming in, the polygon follows its old edge; going out, it follows the side from there.
        if is_within(first) {
            push(Corner::between(first, beyond, self.crossing(beyond.leaving), beyond.leaving));
        }
        let last = before(end);
        let (low, high) = if begin <= last { (begin..last, 0..0) } else { (begin..polygon.len(), 0..last) };
        polygon[low].iter().for_each(|corner| push(*corner));
        polygon[high].iter().for_each(|corner| push(*corner));
        let (beyond, last, leaving) = (&polygon[end], &polygon[last], Leaving::Side(self.half_edge));
        if is_within(last) {
            push(*last);
            push(Corner::between(last, beyond, self.crossing(last.leaving), leaving));
        } else {
            push(Corner { leaving, ..*last });
        }
    }

    /// What stands where an edge of the polygon meets this side.
    fn crossing(&self, leaving: Leaving) -> Name {
        match leaving {
            Leaving::Incident(edge) => Name::Crossing(self.half_edge, edge),
            // Two sides meet over a vertex of the reference face: the one that both have.
            Leaving::Side(other) if other == self.end.1 && other != self.start.1 => {
                Name::Reference(self.end.0)
            }
            Leaving::Side(_) => Name::Reference(self.start.0),
        }
    }
}

/// Where the corners begin that are not beyond a side, and before which they end, around the polygon; none if all are
/// beyond.
///
/// A convex polygon goes beyond a line once. One that rounding has dented may do so twice; then only what is around the
/// furthest corner counts.
fn run_within<const N: usize>(polygon: &Ring<N>, furthest: f64, slack: f64) -> Option<(usize, usize)> {
    let count = polygon.len();
    let top = polygon.iter().position(|corner| corner.beyond == furthest)?;
    let after = |i: usize| if i + 1 == count { 0 } else { i + 1 };
    let before = |i: usize| if i == 0 { count - 1 } else { i - 1 };
    let (mut begin, mut end) = (after(top), top);
    while polygon[begin].beyond > slack {
        if begin == top {
            return None;
        }
        begin = after(begin);
    }
    while polygon[before(end)].beyond > slack {
        end = before(end);
    }
    Some((begin, end))
}
