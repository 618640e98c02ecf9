//! Casts against chains: segment by segment, in the order in which circles around them are met.
//!
//! Each segment is a shape like any other, so a miss is as certain as for those. Ground adds which sides can be met,
//! and which normals there are: see `ground2`.

use super::counts::Counts;
use super::course::{Course, Touching, meeting};
use super::piece::{Piece, for_pieces};
use super::stretch::Stretch;
use super::{at_start, impact, is_passed};
use crate::counted::count_step;
use crate::ground2::{Region, Surface};
use crate::impact2::Impact2;
use crate::pair2::Pair2;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Chain, Run, Segment2, Shape2};

impl Pair2<'_> {
    /// The contact at the start with ground that faces the other body, if there is one.
    pub(super) fn touching_ground_at_start(&self) -> Option<Impact2> {
        if self.shape_a.is_ground() && self.shape_b.is_ground() {
            return self.overlaps().then(|| self.touching_at_start());
        }
        let (touch, deepest) = self.deepest_on_ground(0.0);
        if touch != Some(true) {
            return None;
        }
        Some(deepest.as_ref().and_then(at_start).unwrap_or_else(|| self.touching_at_start()))
    }

    /// The first segment and part that touch within a stretch; there may be a stretch before and one after it.
    pub(super) fn first_touch_of_ground(
        &self,
        [before, after]: [Option<&Stretch>; 2],
        stretch: &Stretch,
        counts: Counts,
    ) -> Option<Impact2> {
        let mut first = First { before, stretch, after, end: 1.0, impact: None, counts };
        match (self.shape_a, self.shape_b) {
            (Shape2::Chain(a), Shape2::Chain(b)) => {
                let whole_b = Piece::whole(self.shape_b);
                first.of_segments(a, &whole_b, 0, |first, segment| first.with_chain(b, segment, 1));
            }
            (Shape2::Chain(a), other) => for_pieces(other, |piece| first.with_chain(a, piece, 0)),
            (other, Shape2::Chain(b)) => for_pieces(other, |piece| first.with_chain(b, piece, 1)),
            _ => {}
        }
        first.impact
    }
}

/// The first impact so far.
struct First<'s> {
    /// The stretch before this one, if any.
    before: Option<&'s Stretch>,
    stretch: &'s Stretch,
    after: Option<&'s Stretch>,
    /// The time of that impact.
    end: f64,
    impact: Option<Impact2>,
    counts: Counts<'s>,
}

impl First<'_> {
    /// Visits the segments of a chain that may meet a piece before the end.
    fn of_segments(
        &mut self,
        chain: &Chain,
        other: &Piece,
        side: usize,
        mut visit: impl FnMut(&mut Self, &Piece),
    ) {
        let (stretch, shape) = (self.stretch, Shape2::Chain(chain.clone()));
        let first_meeting = |bounds: &Aabb2| {
            let bounds = Piece::boxed(&shape, bounds);
            let pieces = if side == 0 { [&bounds, other] } else { [other, &bounds] };
            meeting(stretch, pieces, 1.0).map_or(f64::INFINITY, |[first, _]| first)
        };
        chain.visit_nearest(self.end, first_meeting, |segment| {
            count_step();
            if let Some(shape) = chain.segment(segment).map(Shape2::Segment) {
                visit(self, &Piece::segment(&shape, segment));
            }
            self.end
        });
    }

    /// The first segment of a chain that a piece meets.
    fn with_chain(&mut self, chain: &Chain, other: &Piece, side: usize) {
        self.of_segments(chain, other, side, |first, segment| {
            let pieces = if side == 0 { [segment, other] } else { [other, segment] };
            let Some((met, touching)) = first.met_first(chain, pieces, side) else { return };
            // Of equals, the first counts.
            if first.impact.is_some() && touching.at >= first.end {
                return;
            }
            let mut impact = impact(first.stretch, &touching, pieces);
            impact.normal = met.axis.as_vec2();
            *(if side == 0 { &mut impact.part_a } else { &mut impact.part_b }) = met.run.first();
            if first.counts.admits(pieces, (first.stretch, touching.at), met.level, &impact) {
                first.end = touching.at;
                first.impact = Some(impact);
            }
        });
    }

    /// Where a segment of a chain is met first. One-sided ground that is passed may be met later, from its front, once
    /// the two are apart (from a straight run: from all of it).
    fn met_first(&self, chain: &Chain, pieces: [&Piece; 2], side: usize) -> Option<(Met, Touching)> {
        let mut course = Course::new(self.stretch, pieces, self.end)?;
        loop {
            let touching = course.first_touch();
            if self.before.is_none() && course.doubts_start() {
                self.counts.doubt_start();
            }
            let touching = touching?;
            let met = surface_met((chain, pieces[side].index), (&course, self.after), &touching, side);
            let is_passed = || match self.before {
                Some(before) if chain.is_one_sided() => is_passed_still(before, pieces),
                before => is_passed(before, pieces),
            };
            let met = met.filter(|_| touching.at > 0.0 || !is_passed());
            let met = met.filter(|met| !self.has_passed((chain, &met.run), pieces, &touching, side));
            if let Some(met) = met {
                return Some((met, touching));
            }
            if !chain.is_one_sided() {
                return None;
            }
            course = course.once_apart(&touching)?;
        }
    }

    /// Whether a part that comes to touch a segment has touched other segments of its straight run before, without an
    /// impact, and has not been apart from the run since: then it passes through the whole run. A part that does not
    /// turn, and has come through from behind, moves away from the front of every segment.
    fn has_passed(
        &self,
        (chain, run): (&Chain, &Run),
        pieces: [&Piece; 2],
        touching: &Touching,
        side: usize,
    ) -> bool {
        let segment = pieces[side];
        if !chain.is_one_sided() || !self.stretch.is_turning() || pieces[1 - side].is_line() {
            return false;
        }
        let Some(chord) = chain.chord(run).filter(|&chord| Some(chord) != chain.segment(segment.index))
        else {
            return false;
        };
        let shape = Shape2::Segment(chord);
        let whole = Piece::segment(&shape, segment.index);
        let pieces = if side == 0 { [&whole, pieces[1]] } else { [pieces[0], &whole] };
        let is_now_alone =
            Course::over(self.stretch, pieces, [0.0, touching.at]).is_no_deeper(touching, run.unevenness());
        if is_now_alone {
            return false;
        }
        let is_passing = |stretch: &Stretch, after: Option<&Stretch>, first: &Touching| {
            let course = Course::over(stretch, pieces, [0.0, 1.0]);
            surface_met((chain, segment.index), (&course, after), first, side).is_none()
        };
        match (last_touch(self.stretch, pieces, touching.at), self.before) {
            (Some(first), Some(before)) if first.at <= 0.0 => last_touch(before, pieces, 1.0)
                .is_some_and(|first| is_passing(before, Some(self.stretch), &first)),
            (Some(first), _) => is_passing(self.stretch, self.after, &first),
            (None, _) => false,
        }
    }
}

/// Whether two parts came to touch in the stretch before, without an impact, and have not been apart since.
fn is_passed_still(before: &Stretch, pieces: [&Piece; 2]) -> bool {
    last_touch(before, pieces, 1.0).is_some()
}

/// Where two parts that touch at a time of a stretch came to touch, not having been apart since.
fn last_touch(stretch: &Stretch, pieces: [&Piece; 2], end: f64) -> Option<Touching> {
    let mut rest = Course::new(stretch, pieces, end);
    while let Some((course, touching)) = rest.and_then(|course| course.first_touch().map(|it| (course, it))) {
        rest = course.once_apart(&touching);
        if rest.is_none() {
            return Some(touching);
        }
    }
    None
}

/// How ground is met.
struct Met {
    /// The normal that is reported, from A to B.
    axis: DVec2,
    /// The axis that decides whether it is passed over as level with what is touched already.
    level: DVec2,
    run: Run,
}

/// How ground is met by a touch; `None` if it does not face the other.
///
/// Where a corner is met, the other may move away along the ground's own normal. Coming out of one-sided ground that
/// way, from behind it, it passes, unless it turns and its middle goes through the segment's front after all. In that
/// case, and on two-sided ground, the normal is the axis that the two touch along. But for a body that turns, the
/// ground's own normal decides what is level: a box that slides over a hill, pressed into it, meets the far corners from
/// inside as it leans.
fn surface_met(
    (chain, segment): (&Chain, u32),
    (course, after): (&Course, Option<&Stretch>),
    touching: &Touching,
    side: usize,
) -> Option<Met> {
    let run = chain.run_of(segment)?;
    let along = |axis: DVec2, run: Run| Some(Met { axis, level: axis, run });
    if course.is_with_line(1 - side) {
        return along(touching.axis, run);
    }
    let surface: Surface = course.surface(side, chain, &run, touching.at)?;
    let away = if side == 0 { touching.axis } else { -touching.axis };
    let normal = match surface.region_at(away, touching.points[side], course.nearness()) {
        Region::Corner => away,
        Region::Face | Region::Inner => surface.normal,
        Region::Beyond(normal) => normal,
    };
    let axis = if side == 0 { normal } else { -normal };
    let looks_back = |axis: DVec2| course.looks_back(axis, touching, 1 - side);
    if !looks_back(axis) || looks_back(touching.axis) && !chain.is_one_sided() {
        return along(axis, run);
    }
    let level = if course.is_turning() { axis } else { touching.axis };
    let falls_through = |chord: Segment2| course.falls_through((side, chord), touching, after);
    let passes = chain.is_one_sided()
        && course.reaches_behind(axis, touching)
        && !chain.chord(&run).is_some_and(falls_through);
    (!passes).then_some(Met { axis: touching.axis, level, run })
}
