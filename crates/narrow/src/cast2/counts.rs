//! Which touches of a cast count, in the plane.

use super::at_start;
use super::beyond::Touched;
use super::piece::Piece;
use super::stretch::{Stretch, Travel};
use crate::impact2::Impact2;
use crate::lists::with_manifolds2;
use crate::pair2::Pair2;
use asunder_geometry::glam::{DVec2, Vec2};
use core::cell::Cell;

/// Which touches count.
#[derive(Clone, Copy)]
pub(super) enum Counts<'c> {
    /// All. The flag is set unless it is certain that the bodies do not touch at the start.
    All { doubts_start: &'c Cell<bool> },
    /// Touches with parts that are neither touched at the start nor level with those that are.
    Beyond(&'c Touched<'c>),
    /// Touches with parts that are not touched at the start, if the function says so.
    If(&'c Pair2<'c>, &'c dyn Fn(&Impact2) -> bool),
}

impl Counts<'_> {
    /// Notes that two parts may touch at the start.
    pub(super) fn doubt_start(self) {
        if let Self::All { doubts_start } = self {
            doubts_start.set(true);
        }
    }

    /// Whether a touch of two pieces, at a time of a stretch and along a unit axis from A to B, counts.
    pub(super) fn admits(
        self,
        pieces: [&Piece; 2],
        (stretch, at): (&Stretch, f64),
        axis: DVec2,
        impact: &Impact2,
    ) -> bool {
        match self {
            Self::All { .. } => true,
            Self::Beyond(touched) => !touched.passes_over(pieces, (stretch, at), axis),
            Self::If(pair, counts) => {
                let is_touched =
                    || at <= 0.0 && pair.do_pieces_overlap(pieces.map(|it| (it.shape, it.local)));
                !is_touched() && counts(impact)
            }
        }
    }
}

impl Pair2<'_> {
    /// The first touch of a [`cast`](Self::cast) for which `counts` is true, among the first touches with each part of
    /// a compound, or segment of a chain: the touch with one part may be of no use, and hide what is met a little later
    /// with another. Parts that touch at the start are judged by their contacts. Cost: as the cast, and where its
    /// answer does not count, another search.
    ///
    /// ```
    /// use asunder::{Chain, Circle, Pair2, Pose2, Shape2, glam::Vec2};
    /// let ball = Shape2::from(Circle::new(0.5)?);
    /// let chain = Chain::open([[-1.0, 0.0], [0.3, 0.0], [1.3, 5.0]].map(Vec2::from))?.into();
    /// let pose = Pose2::at([0.0, 2.0])?;
    /// let pair = Pair2::new(&ball, &pose, &chain, &Pose2::IDENTITY);
    /// let down = Vec2::NEG_Y * 2.0;
    /// assert!(pair.cast(down).is_some_and(|met| met.part_b == 1), "the slope");
    /// assert!(pair.cast_if(down, |met| met.normal.y < -0.99).is_some_and(|met| met.part_b == 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_if(&self, displacement: Vec2, counts: impl Fn(&Impact2) -> bool) -> Option<Impact2> {
        let first = self.cast(displacement)?;
        if counts(&first) {
            return Some(first);
        }
        if !self.has_ground() && !self.is_compound() {
            return None;
        }
        if first.overlapping {
            let touched =
                with_manifolds2(self, 0.0, |manifolds| manifolds.iter().filter_map(at_start).find(&counts));
            if touched.is_some() {
                return touched;
            }
        }
        if !displacement.is_finite() {
            return None;
        }
        let travel = Travel::shift([&self.pose_a, &self.pose_b], displacement.as_dvec2());
        if travel.is_still() { None } else { self.first_touch_along(&travel, Counts::If(self, &counts)) }
    }
}
