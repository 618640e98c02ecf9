//! Parts that come out of one-sided ground, or through it from behind, and come back. Only a turn brings them back: a
//! part that does not turn touches a segment once.

use super::super::beyond::MOMENTS;
use super::super::piece::Piece;
use super::super::stretch::Stretch;
use super::{Course, Touching};
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Segment2, Shape2};

/// Halvings of the time between two moments until the time at which the middle crosses a line is as sharp as f64 has
/// it.
const HALVINGS: u32 = 48;

/// What becomes of a part that touches a segment, between two times.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fate {
    /// Its middle goes through the segment's front.
    Through,
    /// The two are apart for certain.
    Apart,
    Stays,
}

impl<'a> Course<'a> {
    /// The rest of the course, from the first moment after a touch at which the two are apart; `None` if there is none.
    pub(in super::super) fn once_apart(&self, touching: &Touching) -> Option<Self> {
        if !self.is_turning() {
            return None;
        }
        let from = self.moments(touching.at).find(|&at| self.is_apart(touching.axis, at))?;
        Some(Self::over(self.stretch, self.pieces, [from, self.times[1]]))
    }

    /// Whether a part that touches a segment of ground (one of the two pieces), from its front, has its middle go
    /// through the front of the segment's straight run before the two are apart, perhaps only in the stretch after this
    /// one.
    pub(in super::super) fn falls_through(
        &self,
        (ground, chord): (usize, Segment2),
        touching: &Touching,
        after: Option<&Stretch>,
    ) -> bool {
        if !self.is_turning() {
            return false;
        }
        let shape = Shape2::Segment(chord);
        let whole = Piece::segment(&shape, 0);
        let mut pieces = self.pieces;
        pieces[ground] = &whole;
        let along = |stretch: &Stretch, from: f64| {
            Course::over(stretch, pieces, [from, 1.0]).fate((ground, chord), touching.axis, from)
        };
        match along(self.stretch, touching.at) {
            Fate::Stays => after.is_some_and(|after| along(after, 0.0) == Fate::Through),
            fate => fate == Fate::Through,
        }
    }

    /// Whether the two overlap along an axis where they touch, if either turns: else no part comes out of ground that
    /// has this direction. A crate that lies on a floor and turns has a side that rises and one that sinks, and which of
    /// the two is found to touch is up to rounding.
    pub(in super::super) fn reaches_behind(&self, axis: DVec2, touching: &Touching) -> bool {
        !self.is_turning() || self.gap(axis, touching.at) < -self.nearness()
    }

    fn fate(&self, (ground, chord): (usize, Segment2), axis: DVec2, from: f64) -> Fate {
        let [start, end] = chord.ends().map(|end| end.as_dvec2());
        let (along, slack) = (end - start, self.nearness());
        let right = -along.perp();
        let is_in_front = |at: f64| right.dot(self.middle_from(ground, at) - start) >= 0.0;
        let mut last = from;
        for at in self.moments(from) {
            if is_in_front(last) && !is_in_front(at) {
                let mut between = [last, at];
                for _ in 0..HALVINGS {
                    let half = 0.5 * (between[0] + between[1]);
                    between[usize::from(!is_in_front(half))] = half;
                }
                let across = (self.middle_from(ground, between[0]) - start).dot(along) / along.length();
                if across >= -slack && across <= along.length() + slack {
                    return Fate::Through;
                }
            }
            if self.is_apart(axis, at) {
                return Fate::Apart;
            }
            last = at;
        }
        Fate::Stays
    }

    /// Moments after a time, the last of which is the end.
    fn moments(&self, after: f64) -> impl Iterator<Item = f64> + use<> {
        let end = self.times[1];
        let moments = (1..MOMENTS).map(|i| f64::from(i) / f64::from(MOMENTS));
        moments.take_while(move |&at| at < end).chain([end]).filter(move |&at| at > after)
    }

    /// Whether the two overlap by at most `deep` where they touch, up to what counts as touching.
    pub(in super::super) fn is_no_deeper(&self, touching: &Touching, deep: f64) -> bool {
        self.look(touching.at, touching.axis).is_some_and(|look| look.most >= -deep - self.nearness())
    }

    fn is_apart(&self, axis: DVec2, at: f64) -> bool {
        self.look(at, axis).is_some_and(|look| look.least > self.enough)
    }

    /// Where the other's middle is, in a part's axes and from its origin.
    fn middle_from(&self, which: usize, at: f64) -> DVec2 {
        let (turn, origin) = self.place(which, at);
        turn.turn_back(self.center(1 - which, at) - origin)
    }
}
