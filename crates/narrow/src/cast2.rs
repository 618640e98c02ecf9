//! When a moved shape first touches another, in the plane.
//!
//! ```text
//! circles swept along the way do not meet: a miss          else the way is cut down to where they do
//! neither turns, and one comes down on the inside of an edge of the other: an impact            (course/landing)
//! neither turns, and an edge separates the two all the way: a miss
//! repeat
//!   find the gap, and the axis that shows it, for the shapes as they now stand       (polygon/distance)
//!   the axis separates them for the rest of the way: a miss, without any tolerance
//!   the gap is next to nothing: an impact                                            (tolerance: CAST_GAP2)
//!   go on for as long as this one axis certainly shows a gap                         (course)
//! where that leaves open whether they touch at the start, and they do, exactly: an impact at 0
//! ```
//! The step is that of van den Bergen, "Ray casting against general convex objects with application to continuous
//! collision detection" (2004), for shapes that only translate: along a fixed axis the gap closes at a constant speed.
//! The distance of convex sets that translate is convex over time, and the step is Newton's for it: two rounds for a
//! face, quadratic for corners and round shapes, and where they graze, each round leaves a quarter of the gap.
//!
//! For shapes that turn as well, conservative advancement (Mirtich, "Impulse-based dynamic simulation of rigid body
//! systems", 1996) bounds the speed of every point by its arm and the angular speed. It converges slowly where a rod
//! spins fast and closes slowly. Instead:
//! 1. Along one axis, each vertex' projection has a second derivative of at most M (arm times angular acceleration and
//!    squared speed). So between two times D apart the gap is at least the lesser of the gaps at both, less M D^2 / 8:
//!    two projections certify a whole stretch. The longest such stretch is found by regula falsi, at two supports a
//!    try.
//! 2. The error of that bound shrinks with the square of the stretch: the last rounds converge as Newton's do, however
//!    fast the spin. Catto's bilateral advancement (GDC 2013) gets as far along an axis, but assumes that the deepest
//!    point at the end is the only one that matters; here no vertex can slip through between two times.
//! 3. Turns are cut in halves of at most a quarter turn (`Motion2`), so that angular speeds and accelerations stay
//!    within a small factor of their mean.
//!
//! Measured in ns (AMD EPYC, Zen 4, 2026-11-21, a busy machine; 2000 seeded pairs of equal shapes of about 2 m on
//! their way past each other, four of five hits; for `half-plane`, with a circle):
//!
//! | | capsule | rectangle | 8 edges | 64 edges | 4096 edges | half-plane |
//! |---|---|---|---|---|---|---|
//! | distance at the start | 370 | 331 | 385 | 624 | 1153 | 166 |
//! | cast | 709 | 754 | 957 | 6073 | 12787 | 331 |
//! | cast, a miss by circles | 27 | 27 | 27 | 27 | 27 | |
//! | impact, turning | 6684 | 11178 | 5461 | 12632 | 18070 | 544 |
//! | ray | 58 | 55 | 75 | 84 | 174 | 33 |
//!
//! The rounding of the poses in between is part of every bound: f64 positions, and rotations rounded to f32, 1.2e-7 of
//! the arm. That is the best `error` that an impact of turning shapes can have.

mod beyond;
mod counts;
mod course;
mod ground;
mod legs;
mod piece;
mod ray;
mod stretch;
#[cfg(test)]
mod tests;

use crate::answer::{Manifold2, Separation2};
use crate::impact2::Impact2;
use crate::pair2::Pair2;
use crate::touch::Touch2;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Motion2, Pose2};
use beyond::with_touched;
use core::cell::Cell;
use counts::Counts;
use course::{Course, Touching, meeting};
use piece::{Piece, for_pieces_met};
pub use ray::cast_ray2;
use stretch::{Stretch, Travel};

impl Pair2<'_> {
    /// The first touch of A, moved by a displacement in metres, with B, which stands still; `None` if there is none.
    ///
    /// - Touching at the start, exactly, is an impact at fraction 0, even if A moves away. Its anchors are those of the
    ///   deepest contact point; for two half-planes whose overlap is unbounded both are zero, the bodies' positions.
    /// - Shapes that are apart by less than positions round to (some 1e-14 of the size near the origin; further out
    ///   some 8 units of f64's spacing there, and 32 where both move: 7e-7 m at 1e8 m) are an impact at 0 too, unless A
    ///   moves away; `overlapping` is then false, and `error` bounds how far apart they are. So a shape that a cast has
    ///   brought up to another may leave it, with rare exceptions if the other is some thousand times as large.
    /// - A miss is certain. A pair that passes within 1e-8 of its size may be reported as an impact, whose `error`
    ///   bounds how far apart they pass.
    /// - A compound is met at the pair of parts that touches first; of equals, the first.
    /// - A one-sided chain is met only from its front. A shape that is behind a straight [run](asunder_geometry::Run)
    ///   of the chain when it first touches that run passes through all of it, even if its centre crosses it on the
    ///   way; contacts begin then. A shape that turns may come to touch the run again, from its front, once the two
    ///   have been apart for a 32nd of the motion; after a shorter time apart, that touch may be missed.
    /// - A part that reaches behind the line of a one-sided chain passes the end of the chain while the point that
    ///   touches it moves away from the front.
    /// - At inner vertices of straight lines and hollows, the normal is that of the run they are on. The part of a
    ///   chain is the first segment of the straight run that is met.
    /// - A shape that starts nearer to one part than positions round to, and moves along it, may overlap that part, by
    ///   rounding, on its way and where another part stops it.
    /// - A displacement that is not finite counts as none: shapes that touch are reported, unlike by a world's
    ///   `cast_shape`.
    ///
    /// Cost: a few dozen ns if bounding circles swept along the way miss; a height for each edge where one of few edges
    /// is come down on; else one distance per round: one to three rounds for most pairs, some twenty where curves graze.
    /// So it grows as [`distance`](Self::distance) does: as the logarithm of a polygon's vertices. An exact overlap test
    /// for shapes that nearly touch at the start.
    ///
    /// ```
    /// use asunder::{Pair2, Pose2, Rect, Shape2, glam::Vec2};
    /// let square = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
    /// let (here, there) = (Pose2::IDENTITY, Pose2::at([10.0, 0.5])?);
    /// let pair = Pair2::new(&square, &here, &square, &there);
    /// let impact = pair.cast(Vec2::X * 16.0).ok_or("they meet")?;
    /// assert!(impact.fraction <= 0.5 && impact.fraction > 0.5 - 1e-9);
    /// assert_eq!(impact.normal, Vec2::X);
    /// assert_eq!(pair.cast(Vec2::X * 7.9), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast(&self, displacement: Vec2) -> Option<Impact2> {
        let displacement = if displacement.is_finite() { displacement } else { Vec2::ZERO };
        self.first_touch(&Travel::shift([&self.pose_a, &self.pose_b], displacement.as_dvec2()))
    }

    /// The first touch of two bodies that both move and may turn; `None` if there is none. The rules of
    /// [`cast`](Self::cast) hold here too.
    ///
    /// - The answer refers to the poses that [`Motion2::pose_at`] returns: at no fraction before the impact's do they
    ///   touch, and there they are at most `error` apart. If a body turns, and is not a circle about its position,
    ///   `error` is no less than 1.2e-7 of its arm.
    /// - Shapes that are nearer than that at the start may move apart or along each other, and poses on the way may then
    ///   overlap by rounding. If they move towards each other, the fraction is 0.
    /// - If many rounds bring the shapes no nearer, as when they graze each other while they turn, the fraction is that
    ///   of the last round, and `error` the gap that is left there.
    /// - Two half-planes of which one turns touch at once.
    ///
    /// Cost: as a cast where nothing turns; else 5 to 20 us, most of it distances, and two supports for every time
    /// tried.
    ///
    /// ```
    /// use asunder::{Circle, Motion2, Pair2, Pose2, Rect, Rotation2, Shape2, glam::Vec2};
    /// let rod = Shape2::from(Rect::from_half_extents(Vec2::new(2.0, 0.01))?);
    /// let post = Shape2::from(Circle::new(0.1)?);
    /// let at = Pose2::at([0.0, 1.5])?;
    /// let half_turn = Motion2::new([0.0, 0.0], Rotation2::new(-1.0, 0.0)?)?;
    /// let pair = Pair2::new(&rod, &Pose2::IDENTITY, &post, &at);
    /// let impact = pair.impact(&half_turn, &Motion2::shift([0.0, 0.0])?).ok_or("the rod meets the post")?;
    /// assert!(impact.fraction > 0.45 && impact.fraction < 0.5, "just before the quarter turn");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn impact(&self, motion_a: &Motion2, motion_b: &Motion2) -> Option<Impact2> {
        self.first_touch(&Travel::of(self, [motion_a, motion_b]))
    }

    /// The next impact of bodies that may already touch: like [`impact`](Self::impact), but parts that they touch at
    /// the start are passed over.
    ///
    /// Parts of chains and of compounds that touch at the start are left out, and so are parts that are level with
    /// them. So a ball that its weight presses on a level's floor crosses the floor's vertices and still runs into the
    /// level's walls, steps and ramps.
    ///
    /// - A part is level if, along the normal of the impact with it, it is at most a 64th of the body's thickness away
    ///   at the start and the motion leads at most that far into it, not counting the depth to which the motion leads
    ///   into the touched parts anyway. The thickness is the radius of a ball inside the body, about its centre.
    /// - If a body turns, the two may overlap along that normal at the start, deeper than the contacts account for,
    ///   since another axis separates them. Then the motion into the part counts from where they meet.
    /// - A part of a compound is level, too, if it is flush with a touched one, as long as the body never sinks deeper
    ///   below that than half its thickness.
    /// - A motion that sinks a body into its floor by its whole thickness leads it under the obstacles that stand
    ///   there.
    /// - Where ground is touched at two places, and only one of them has a contact, going into the other is an impact
    ///   at the start: a ball in a hollow has a contact with one side, and rolls into the other. Its anchors may be off
    ///   by up to half the thickness.
    /// - `None` for bodies of one part each that touch. Never `overlapping`.
    ///
    /// Cost: as the impact, which is tested first; for bodies that touch, their manifolds too, and another search.
    ///
    /// ```
    /// use asunder::{Chain, Circle, Motion2, Pair2, Pose2, Shape2, glam::Vec2};
    /// let points = [[-9.0, 0.0], [0.0, 0.0], [5.0, 0.0], [5.0, 4.0]].map(Vec2::from);
    /// let yard = Shape2::from(Chain::open(points)?);
    /// let (ball, on_floor) = (Shape2::from(Circle::new(0.5)?), Pose2::at([-2.0, 0.5])?);
    /// let (kick, still) = (Motion2::shift([20.0, -0.1])?, Motion2::STILL);
    /// let pair = Pair2::new(&ball, &on_floor, &yard, &Pose2::IDENTITY);
    /// assert!(pair.impact(&kick, &still).is_some_and(|impact| impact.overlapping), "with the floor");
    /// let wall = pair.next_impact(&kick, &still).ok_or("the wall is in the way")?;
    /// assert!(wall.normal == Vec2::X && (wall.fraction * 20.0 - 6.5).abs() < 1e-6);
    /// assert_eq!(pair.next_impact(&Motion2::shift([6.0, -0.1])?, &still), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn next_impact(&self, motion_a: &Motion2, motion_b: &Motion2) -> Option<Impact2> {
        self.next_impact_beside(&[], motion_a, motion_b)
    }

    /// [`next_impact`](Self::next_impact) of a body A that also touches other bodies: parts that are flush with those
    /// are passed over as well, such as the next of the tiles of a floor. Parts of ground that A touches too are not
    /// passed over: ground has no such seams.
    ///
    /// - Flush means: rising above the touched body by no more than a 64th of the thickness of the thinner part, while
    ///   A never sinks below it by more than half that thickness. A body that is stuck deeper is stopped as usual.
    /// - This is judged by the poses of the two at the start, and later motion of B counts as sinking: a body that was
    ///   flush and swings or rises into A, by less than that half, has no impact, but a contact once it is there.
    /// - Half-planes are never flush.
    /// - A touch whose axis is not of length 1 is ignored.
    ///
    /// Cost: as the next impact; where there is one, another search.
    ///
    /// ```
    /// use asunder::{Motion2, Pair2, Pose2, Rect, Shape2, Touch2, glam::Vec2};
    /// let (crate_, tile) = (Rect::from_half_extents(Vec2::splat(0.5))?, Rect::from_half_extents(Vec2::ONE)?);
    /// let (crate_, tile) = (Shape2::from(crate_), Shape2::from(tile));
    /// // A millimetre in a tile whose top is at height 0, and 0.5 m before the next.
    /// let (from, way) = (Pose2::at([0.0, 0.499])?, Motion2::shift([2.0, 0.0])?);
    /// let stands = Touch2 { normal: Vec2::NEG_Y, separation: -0.001 };
    /// let meets = |height: f64| {
    ///     let next = Pose2::at([2.0, height - 1.0])?;
    ///     let pair = Pair2::new(&crate_, &from, &tile, &next);
    ///     Ok::<_, asunder::PoseError>(pair.next_impact_beside(&[stands], &way, &Motion2::STILL).is_some())
    /// };
    /// // As high as the one that it stands on, a little higher, and too high.
    /// assert_eq!([meets(0.0)?, meets(0.005)?, meets(0.02)?], [false, false, true]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn next_impact_beside(
        &self,
        touches: &[Touch2],
        motion_a: &Motion2,
        motion_b: &Motion2,
    ) -> Option<Impact2> {
        let travel = Travel::of(self, [motion_a, motion_b]);
        let first = self.first_touch(&travel)?;
        let do_touch = first.overlapping;
        if !do_touch && touches.is_empty() {
            return Some(first);
        }
        if do_touch && (travel.is_still() || !self.has_ground() && !self.is_compound()) {
            return None;
        }
        with_touched((self, &travel), (do_touch, touches), |touched| {
            let first = self.first_touch_along(&travel, Counts::Beyond(touched));
            if do_touch { touched.across([motion_a, motion_b], first.as_ref()).or(first) } else { first }
        })
    }

    fn first_touch(&self, travel: &Travel) -> Option<Impact2> {
        let wholes = [Piece::whole(self.shape_a), Piece::whole(self.shape_b)];
        let may_touch = |stretch: &Stretch| meeting(stretch, [&wholes[0], &wholes[1]], 1.0).is_some();
        if !travel.stretches().iter().any(may_touch) {
            return None;
        }
        let touching_at_start = || {
            if self.has_ground() {
                self.touching_ground_at_start()
            } else {
                self.overlaps().then(|| self.touching_at_start())
            }
        };
        if travel.is_still() {
            return touching_at_start();
        }
        // Mostly the search shows that they are apart at the start, and they need not be tested there: a capsule that
        // walks on a rectangle takes 0.84 of the instructions (2026-11-30).
        let doubts_start = Cell::new(false);
        let first = self.first_touch_along(travel, Counts::All { doubts_start: &doubts_start });
        let at_start = if doubts_start.get() { touching_at_start() } else { None };
        at_start.or(first)
    }

    /// The first pair of parts that touch on the way, and whose touch counts.
    fn first_touch_along(&self, travel: &Travel, counts: Counts) -> Option<Impact2> {
        let stretches = travel.stretches();
        stretches.iter().enumerate().find_map(|(i, stretch)| {
            let before = i.checked_sub(1).and_then(|i| stretches.get(i));
            if self.has_ground() {
                return self.first_touch_of_ground([before, stretches.get(i + 1)], stretch, counts);
            }
            self.first_touch_of_parts((before, stretch), counts)
        })
    }

    /// The same within a stretch, for two bodies that are not ground.
    fn first_touch_of_parts(
        &self,
        (before, stretch): (Option<&Stretch>, &Stretch),
        counts: Counts,
    ) -> Option<Impact2> {
        let whole_b = Piece::whole(self.shape_b);
        let mut first: Option<Impact2> = None;
        let mut end = 1.0;
        for_pieces_met((self.shape_a, 0), stretch, (&whole_b, 1.0), |a, from| {
            if from > end || meeting(stretch, [a, &whole_b], end).is_none() {
                return;
            }
            for_pieces_met((self.shape_b, 1), stretch, (a, end), |b, from| {
                if from > end {
                    return;
                }
                let Some(course) = Course::new(stretch, [a, b], end) else { return };
                let touching = course.first_touch();
                if before.is_none() && course.doubts_start() {
                    counts.doubt_start();
                }
                // Of equals, the first pair counts.
                let Some(touching) = touching.filter(|touching| first.is_none() || touching.at < end) else {
                    return;
                };
                if touching.at <= 0.0 && is_passed(before, [a, b]) {
                    return;
                }
                let impact = impact(stretch, &touching, [a, b]);
                if counts.admits([a, b], (stretch, touching.at), touching.axis, &impact) {
                    end = touching.at;
                    first = Some(impact);
                }
            });
        });
        first
    }

    fn touching_at_start(&self) -> Impact2 {
        let deepest = self.manifold(0.0).and_then(|manifold| at_start(&manifold));
        deepest.unwrap_or_else(|| {
            let normal = match self.separation(0.0) {
                Separation2::Measured(measured) => measured.normal,
                Separation2::AtLeast(_) => Vec2::Y,
            };
            let (anchor_a, anchor_b) = (Vec2::ZERO, Vec2::ZERO);
            let (fraction, error, part_a, part_b) = (0.0, 0.0, 0, 0);
            Impact2 { fraction, error, overlapping: true, normal, anchor_a, anchor_b, part_a, part_b }
        })
    }
}

/// Whether two parts came to touch in the stretch before, without an impact: from then on they pass each other.
fn is_passed(before: Option<&Stretch>, pieces: [&Piece; 2]) -> bool {
    let course = before.and_then(|before| Course::new(before, pieces, 1.0));
    course.is_some_and(|course| course.first_touch().is_some())
}

/// A manifold as an impact, with its deepest point.
fn at_start(manifold: &Manifold2) -> Option<Impact2> {
    let deepest = manifold.points.iter().min_by(|one, other| one.separation.total_cmp(&other.separation))?;
    Some(Impact2 {
        fraction: 0.0,
        error: 0.0,
        overlapping: true,
        normal: manifold.normal,
        anchor_a: deepest.anchor_a,
        anchor_b: deepest.anchor_b,
        part_a: manifold.part_a,
        part_b: manifold.part_b,
    })
}

fn impact(stretch: &Stretch, touching: &Touching, pieces: [&Piece; 2]) -> Impact2 {
    let [on_a, on_b] = touching.points;
    Impact2 {
        fraction: (stretch.start + touching.at * stretch.share).clamp(0.0, 1.0),
        error: (touching.apart.max(0.0) as f32).next_up(),
        overlapping: false,
        normal: touching.axis.as_vec2(),
        anchor_a: on_a.as_vec2(),
        anchor_b: (on_b - stretch.offset_at(touching.at)).as_vec2(),
        part_a: pieces[0].index,
        part_b: pieces[1].index,
    }
}

/// The sum of a position's coordinates by magnitude: all that a bound on its rounding needs.
fn sum(v: DVec2) -> f64 {
    v.abs().element_sum()
}

/// The rounding error of a moving body's own position.
fn position_of(pose: &Pose2) -> f64 {
    sum(pose.position())
}
