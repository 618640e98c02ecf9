//! Clips a face against the sides of another, in the plane: both are projected along a direction.
//!
//! ```text
//! for each side of the reference face:
//!   class each corner of the polygon as beyond the side's line, on it, or within
//!   none beyond: the polygon stays as it is, and nothing is copied
//!   else: keep corners within or on the line, and add one wherever the polygon crosses between within and beyond
//! ```
//! Sutherland and Hodgman, "Reentrant polygon clipping" (1974). Each corner is classed once per side, with a slack: one
//! that lies on the line up to the slack is kept unchanged, name included. So equal boxes in a stack, whose corners are
//! off each other's sides by rounding either way, touch at the same corners in every frame. And no crossing is computed
//! on an edge that runs along the line, where its position would be rounding noise.
//!
//! Sides are the reference face's edges, not planes of neighbouring faces, so that a face which is flat only up to
//! rounding clips like a flat one.

use arrayvec::ArrayVec;

/// Nothing is kept further than this many slacks beyond the extent of the reference face. At a right-angled corner,
/// what is kept lies within a slack of both sides, each slack enlarged by at most a root of two, and so within two
/// slacks of the extent.
const TIP_SLACKS: f64 = 4.0;

/// A polygon being clipped. It is clockwise, since the face is seen from behind.
///
/// Corners are created once and never moved: each side only rewrites a list of their indices. Copying a corner that was
/// just written, with wider loads than its stores, would stall until the stores have reached the cache.
pub(super) struct Polygon<const N: usize> {
    corners: ArrayVec<Corner, N>,
    /// The polygon and the one before it, alternating.
    rings: [ArrayVec<u16, N>; 2],
    turn: usize,
    /// For each corner of the ring, its distance beyond the side that is being cut at, times that side's length.
    beyond: ArrayVec<f64, N>,
    /// Whether a corner was kept that lies beyond a side, by no more than the slack.
    is_loose: bool,
}

/// A corner of the polygon being clipped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) at: [f64; 2],
    pub(super) height: f64,
    pub(super) name: Name,
    /// What the polygon's edge from this corner to the next lies on.
    leaving: Leaving,
}

/// The features that a corner of a patch comes from, by half-edge indices of their own shapes' topologies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Name {
    /// A vertex of the incident face, by the half-edge of that face that starts from it.
    Incident(u16),
    /// A vertex of the reference face, by the half-edge of that face that starts from it.
    Reference(u16),
    /// A half-edge of the reference face that crosses one of the incident face.
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

/// A side of the reference face, which has the face to its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) half_edge: u16,
    /// The half-edge before this one around the face.
    pub(super) before: u16,
    /// The half-edge after this one around the face.
    pub(super) after: u16,
}

impl<const N: usize> Polygon<N> {
    /// An empty polygon, with room for the corners of one face, twice those of the other, and some more.
    pub(super) fn new() -> Self {
        Self {
            corners: ArrayVec::new(),
            rings: [ArrayVec::new(), ArrayVec::new()],
            turn: 0,
            beyond: ArrayVec::new(),
            is_loose: false,
        }
    }

    pub(super) fn clear(&mut self) {
        self.corners.clear();
        self.rings[self.turn].clear();
        self.is_loose = false;
    }

    fn ring(&self) -> &[u16] {
        &self.rings[self.turn]
    }

    fn corner(&self, i: usize) -> &Corner {
        &self.corners[usize::from(self.ring()[i])]
    }

    /// Adds the vertex of the incident face that a half-edge starts from.
    #[inline]
    pub(super) fn add_vertex(&mut self, half_edge: u16, (at, height): ([f64; 2], f64)) {
        let (name, leaving) = (Name::Incident(half_edge), Leaving::Incident(half_edge));
        self.rings[self.turn].push(self.corners.len() as u16);
        self.corners.push(Corner { at, height, name, leaving });
    }

    /// The projection of the incident face's vertex that was added as number `place`, from 0.
    #[inline]
    pub(super) fn vertex(&self, place: usize) -> [f64; 2] {
        self.corners[place].at
    }

    /// The corners that are left.
    pub(super) fn corners(&self) -> impl ExactSizeIterator<Item = &Corner> {
        self.ring().iter().map(|&i| &self.corners[usize::from(i)])
    }

    /// Keeps the part of the polygon that is beyond a side by no more than `slack`.
    #[inline]
    pub(super) fn cut(&mut self, side: &Side, slack: f64) {
        let [dx, dy] = [side.to[0] - side.from[0], side.to[1] - side.from[1]];
        // The sum of absolute values bounds the length, and needs no root.
        let slack = slack * (dx.abs() + dy.abs());
        let [from_x, from_y] = side.from;
        let mut furthest = f64::NEG_INFINITY;
        self.beyond.clear();
        self.beyond.extend(self.rings[self.turn].iter().map(|&i| {
            let [x, y] = self.corners[usize::from(i)].at;
            let beyond = dy * (x - from_x) - dx * (y - from_y);
            furthest = if beyond > furthest { beyond } else { furthest };
            beyond
        }));
        if furthest > slack {
            self.rings[1 - self.turn].clear();
            if let Some(kept) = self.run_within(furthest, slack) {
                self.keep(kept, side, slack);
            }
            self.turn = 1 - self.turn;
        } else {
            self.is_loose |= furthest > 0.0;
        }
    }

    /// Removes what was kept more than a few slacks beyond a corner of the reference face, where the face's sides meet
    /// at so small an angle that points far past the corner are within the slack of both. `places` are the face's
    /// corners, from half-edge `first`.
    ///
    /// A face narrower than the slack would be an endless needle: far past its tip, its two lines are still no further
    /// apart than the slack. Its extent bounds it. At a corner of a right angle or more, nothing kept lies so far out.
    #[inline]
    pub(super) fn cut_tips(&mut self, places: &[[f64; 2]], first: u16, slack: f64) {
        if !self.is_loose {
            return;
        }
        let slack = TIP_SLACKS * slack;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in places {
            for i in 0..2 {
                low[i] = if place[i] < low[i] { place[i] } else { low[i] };
                high[i] = if place[i] > high[i] { place[i] } else { high[i] };
            }
        }
        let is_off = |corner: &Corner| {
            let off = |i: usize| corner.at[i] > high[i] + slack || corner.at[i] < low[i] - slack;
            off(0) || off(1)
        };
        if self.corners().any(is_off) {
            self.cut_box([low, high], places, first, slack);
        }
    }

    /// Clips against the bounding box of the reference face. Each side is named after a corner that it touches.
    #[cold]
    fn cut_box(&mut self, [low, high]: [[f64; 2]; 2], places: &[[f64; 2]], first: u16, slack: f64) {
        let around =
            [(0, high, [0.0, 1.0]), (1, high, [-1.0, 0.0]), (0, low, [0.0, -1.0]), (1, low, [1.0, 0.0])];
        for (axis, limit, along) in around {
            let touches = places.iter().zip(first..).find(|(place, _)| place[axis] == limit[axis]);
            if let Some((&from, half_edge)) = touches {
                let to = [from[0] + along[0], from[1] + along[1]];
                self.cut(&Side { from, to, half_edge, before: half_edge, after: half_edge }, slack);
            }
        }
    }

    /// The run of corners around the polygon that are not beyond a side: its start and its length; `None` if all are
    /// beyond.
    ///
    /// A convex polygon goes beyond a line once. A dented one, from rounding or from slivers merged into its face, may
    /// do so twice; then only the stretch around the furthest corner is cut, and other corners beyond are left out.
    fn run_within(&self, furthest: f64, slack: f64) -> Option<(usize, usize)> {
        let (beyond, count) = (self.beyond.as_slice(), self.beyond.len());
        if count <= 64 {
            // A bit for each corner: no loop whose end is hard to predict.
            let is_beyond = |i: usize| u64::from(beyond[i] > slack) << i;
            let bits = (0..count).map(is_beyond).fold(0, |bits, bit| bits | bit);
            let full = u64::MAX >> (64 - count);
            let before = (bits << 1 | bits >> (count - 1)) & full;
            let (goes_out, comes_in) = (bits & !before, before & !bits);
            if bits == full {
                return None;
            }
            if goes_out & (goes_out - 1) == 0 {
                return Some((comes_in.trailing_zeros() as usize, count - bits.count_ones() as usize));
            }
        }
        let top = beyond.iter().position(|&beyond| beyond == furthest)?;
        let (mut begin, mut removed) = (after(top, count), 1);
        while beyond[begin] > slack {
            if begin == top {
                return None;
            }
            (begin, removed) = (after(begin, count), removed + 1);
        }
        let mut last = before(top, count);
        while beyond[last] > slack {
            (last, removed) = (before(last, count), removed + 1);
        }
        Some((begin, count - removed))
    }

    /// Copies the run of `kept` corners from `begin`, and adds a corner where the polygon comes back across the side
    /// and one where it goes out.
    fn keep(&mut self, (begin, kept): (usize, usize), side: &Side, slack: f64) {
        let count = self.ring().len();
        let around = |i: usize| if i >= count { i - count } else { i };
        let (outside, last, end) = (before(begin, count), around(begin + kept - 1), around(begin + kept));
        self.is_loose |= self.beyond[begin] > 0.0 || self.beyond[last] > 0.0;
        // Coming in, the polygon follows its old edge; going out, it follows the side from there.
        if self.beyond[begin] < -slack {
            let leaving = self.corner(outside).leaving;
            self.add_crossing((begin, outside), side.crossing(leaving), leaving);
        }
        let [one, other] = self.rings.each_mut();
        let (ring, spare) = if self.turn == 0 { (one, other) } else { (other, one) };
        for i in begin..begin + kept {
            // If a dented polygon goes beyond the line twice, the run may still hold corners beyond it.
            if self.beyond[around(i)] <= slack {
                spare.push(ring[around(i)]);
            }
        }
        let leaving = self.corner(last).leaving;
        let along_side = Leaving::Side(side.half_edge);
        if self.beyond[last] < -slack {
            self.add_crossing((last, end), side.crossing(leaving), along_side);
        } else {
            let last = usize::from(self.ring()[last]);
            self.corners[last].leaving = along_side;
        }
    }

    /// Adds the corner where the edge from a corner within to one beyond meets the side.
    #[inline]
    fn add_crossing(&mut self, (within, beyond): (usize, usize), name: Name, leaving: Leaving) {
        let share = self.beyond[within] / (self.beyond[within] - self.beyond[beyond]);
        let (from, to) = (*self.corner(within), *self.corner(beyond));
        let mix = |from: f64, to: f64| from + (to - from) * share;
        let at = [mix(from.at[0], to.at[0]), mix(from.at[1], to.at[1])];
        let corner = Corner { at, height: mix(from.height, to.height), name, leaving };
        if self.corners.try_push(corner).is_ok() {
            self.rings[1 - self.turn].push(self.corners.len() as u16 - 1);
        }
    }
}

fn after(i: usize, count: usize) -> usize {
    if i + 1 == count { 0 } else { i + 1 }
}

fn before(i: usize, count: usize) -> usize {
    if i == 0 { count - 1 } else { i - 1 }
}

impl Side {
    /// The name of the corner where an edge of the polygon meets this side.
    fn crossing(&self, leaving: Leaving) -> Name {
        match leaving {
            Leaving::Incident(edge) => Name::Crossing(self.half_edge, edge),
            // Two sides meet over the vertex of the reference face that they share.
            Leaving::Side(other) if other == self.after && other != self.before => {
                Name::Reference(self.after)
            }
            Leaving::Side(_) => Name::Reference(self.half_edge),
        }
    }
}
