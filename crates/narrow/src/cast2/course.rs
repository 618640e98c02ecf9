//! Two convex parts on their way: the gap between them at a time, and for how long it certainly lasts.

mod again;
mod landing;
mod meeting;
mod parting;
mod steps;
mod wheel;

use landing::Landing;
pub(super) use meeting::meeting;

use super::at_start;
use super::piece::Piece;
use super::stretch::Stretch;
use crate::ground2::Surface;
use crate::pair2::Pair2;
use crate::polygon::distance::{Reached, Until, Witness, distance};
use crate::polygon::outline::{Outline, Turn};
use crate::precision::Precision;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::tolerance::{CAST_GAP2, SAME_NORMAL};
use asunder_geometry::{Chain, Core2, Pose2, Rotation2, Run, Shape2};
use core::cell::Cell;

/// The most that rounding to f32 turns a unit axis by.
const ROUNDED: f64 = f32::EPSILON as f64;

/// Rounding error of a projection, in units of 2^-53 of the reach: that of parts of compounds (16) and of searched
/// supports (4), the root and quotient of a rotation in between (3), and the product and sum for the offset (3);
/// rounded up.
const ROUNDINGS: f64 = 32.0;

/// Two convex parts over a stretch of their bodies' motion.
pub(super) struct Course<'a> {
    stretch: &'a Stretch,
    pieces: [&'a Piece<'a>; 2],
    cores: [Core2<'a>; 2],
    /// Circles around both are apart before the first time, and after the second.
    times: [f64; 2],
    radii: f64,
    precision: Precision,
    /// How far the poses that are reported may be off the smooth path, in metres: only a larger gap is certain.
    slack: f64,
    /// The gap that a step aims at, and the one at which shapes count as met.
    aim: f64,
    enough: f64,
    /// Bounds on a vertex' speed along an axis, as its body turns, and on its second derivative.
    pace: f64,
    bend: f64,
    /// Set by a search that cannot tell whether they touch at time zero.
    doubts_start: Cell<bool>,
}

/// Two parts that touch, or count as touching.
pub(super) struct Touching {
    /// The time within the stretch.
    pub(super) at: f64,
    /// Unit axis from A to B.
    pub(super) axis: DVec2,
    /// An upper bound on how far they are apart, in metres.
    pub(super) apart: f64,
    /// Points of both surfaces, relative to A's position.
    pub(super) points: [DVec2; 2],
}

/// The gap as found at a time.
struct Look {
    /// Unit axis from A to B, and two bounds on the separation: the gap along the axis, and the distance of the points.
    /// The slack is in neither.
    axis: DVec2,
    least: f64,
    most: f64,
    /// Points of both cores, relative to A's position.
    points: [DVec2; 2],
}

impl<'a> Course<'a> {
    /// `None` if circles show that the two do not touch before `end`.
    pub(super) fn new(stretch: &'a Stretch, pieces: [&'a Piece<'a>; 2], end: f64) -> Option<Self> {
        Some(Self::over(stretch, pieces, meeting(stretch, pieces, end)?))
    }

    /// The course between two times.
    pub(super) fn over(stretch: &'a Stretch, pieces: [&'a Piece<'a>; 2], times: [f64; 2]) -> Self {
        let finite = |length: f64| if length < f64::INFINITY { length } else { 0.0 };
        let radius = |piece: &Piece| f64::from(piece.shape.radius());
        let furthest = times.map(|time| stretch.offset_at(time).length()).into_iter().fold(0.0, f64::max);
        let (mut radii, mut size, mut reach) = (0.0, 0.0, furthest);
        let (mut pace, mut bend, mut slack) = (0.0, 0.0, stretch.lost(times[1]));
        for (piece, spin) in pieces.into_iter().zip(&stretch.spins) {
            radii += radius(piece);
            size += finite(piece.outer);
            let part = piece.local.map_or(0.0, |pose| pose.position().length());
            reach += finite(piece.outer) + part + f64::from(piece.shape.center().length());
            pace += spin.speed * piece.arm;
            bend += spin.swerve * piece.arm;
            slack += spin.rounding * piece.arm;
        }
        for (which, spin) in stretch.spins.iter().enumerate().filter(|&(which, _)| pieces[which].is_line()) {
            // Seen from a half-plane that turns, everything turns about it.
            let around = furthest + pieces[0].arm + pieces[1].arm;
            let other = pieces[1 - which].arm * stretch.spins[1 - which].speed;
            bend += spin.swerve * around + 2.0 * spin.speed * (stretch.velocity.length() + pace + other);
            pace += spin.speed * around;
            slack += spin.rounding * around;
        }
        let precision = Precision { size: size - radii, reach, planarity: 0.0, roundings: ROUNDINGS };
        let (gap, rounding) = (CAST_GAP2 * size, precision.projection());
        let (aim, enough) = (slack + 0.5 * gap + 2.0 * rounding, slack + gap + 6.0 * rounding);
        let cores = pieces.map(|piece| piece.shape.core());
        let doubts_start = Cell::new(false);
        Self { stretch, pieces, cores, times, radii, precision, slack, aim, enough, pace, bend, doubts_start }
    }

    /// Where they first touch, before the end.
    pub(super) fn first_touch(&self) -> Option<Touching> {
        if self.pieces[0].is_line() && self.pieces[1].is_line() {
            // Lines that cross do so anywhere, and each shows only where the other's origin is.
            self.doubts_start.set(true);
            if self.stretch.is_turning() {
                return Some(self.lines_that_turn());
            }
        }
        match self.landing() {
            Landing::On(touching) => Some(touching),
            Landing::Never => None,
            Landing::Open => self.by_steps(),
        }
    }

    /// Whether a search has left open if they touch at time zero.
    pub(super) fn doubts_start(&self) -> bool {
        self.doubts_start.get()
    }

    /// Whether the gap along an axis, which may be off by a share, never shrinks from then on, however fast bodies
    /// turn.
    fn parts(&self, axis: DVec2, off: f64) -> bool {
        self.closing(axis) + self.pace + off * self.stretch.velocity.length() <= 0.0
    }

    /// Whether either body turns.
    pub(super) fn is_turning(&self) -> bool {
        self.stretch.is_turning()
    }

    /// Whether A moves away from B along an axis where they touch, judged at the point of one of the two cores. A round
    /// shape that turns about its middle moves as if it did not turn.
    pub(super) fn looks_back(&self, axis: DVec2, touching: &Touching, which: usize) -> bool {
        let radius = f64::from(self.pieces[which].shape.radius());
        let inwards = if which == 0 { -touching.axis } else { touching.axis };
        let point = touching.points[which] + inwards * radius;
        let [spin_a, spin_b] = &self.stretch.spins;
        let turning = spin_a.speed_at(touching.at) * point.perp()
            - spin_b.speed_at(touching.at) * (point - self.stretch.offset_at(touching.at)).perp();
        let velocity = self.stretch.velocity + turning;
        axis.dot(velocity) < -SAME_NORMAL * velocity.length()
    }

    /// An upper bound on the speed at which the gap along an axis closes, without what turning adds.
    fn closing(&self, axis: DVec2) -> f64 {
        let velocity = self.stretch.velocity;
        axis.dot(velocity) + 4.0 * f64::EPSILON * velocity.length()
    }

    /// The impact that a look shows. If nothing turns, it is moved on to where no gap is left along the look's axis, if
    /// the two are nearer there.
    fn settled(&self, look: &Look, now: f64) -> Touching {
        let [on_a, on_b] = look.points;
        let rounding = self.precision.projection() + self.slack;
        let closing = self.closing(look.axis);
        let mut best = Touching {
            at: now,
            axis: look.axis,
            apart: look.most + self.slack,
            points: self.on_surfaces([on_a, on_b], look.axis),
        };
        if self.bend == 0.0 && self.pace == 0.0 && closing > 0.0 {
            let on = ((look.least - self.slack).max(0.0) / closing).min(self.times[1] - now);
            let moved = self.stretch.velocity * on;
            let points = match [self.pieces[0].is_line(), self.pieces[1].is_line()] {
                [false, false] => [on_a, on_b - moved],
                // The foot on a half-plane's line moves with the other's point.
                [true, _] => [on_b - moved - look.axis * look.axis.dot(on_b - moved - on_a), on_b - moved],
                [false, true] => [on_a, on_a + look.axis * look.axis.dot(on_b - moved - on_a)],
            };
            let apart = (points[1] - points[0]).length() - self.radii + rounding;
            if apart <= best.apart {
                // Round shapes touch along the line between their cores as these stand then.
                let across = points[1] - points[0];
                let is_round =
                    self.radii > 0.0 && self.line().is_none() && across.length() > 1e-6 * self.radii;
                let axis = if is_round { across.normalize() } else { look.axis };
                best = Touching { at: now + on, axis, apart, points: self.on_surfaces(points, axis) };
            }
        }
        best
    }

    /// An impact of cores that, within rounding, no axis separates: along the axis that poses next to these show.
    fn too_close(&self, now: f64, axis: DVec2) -> Touching {
        let beside = |which: usize| {
            let (turn, origin) = self.place(which, now);
            let along = turn.axes()[0].as_vec2();
            Rotation2::new(along.x, along.y)
                .and_then(|rotation| Pose2::new(origin, rotation))
                .unwrap_or_default()
        };
        let poses = [beside(0), beside(1)];
        let pair = Pair2::new(self.pieces[0].shape, &poses[0], self.pieces[1].shape, &poses[1]);
        let margin = (2.0 * self.enough + f64::from(f32::EPSILON) * self.precision.reach) as f32;
        if let Some(impact) = pair.manifold(margin).and_then(|manifold| at_start(&manifold)) {
            let [on_a, on_b] = [impact.anchor_a, impact.anchor_b].map(Vec2::as_dvec2);
            let points = [on_a + poses[0].position(), on_b + poses[1].position()];
            return Touching { at: now, axis: impact.normal.as_dvec2(), apart: self.enough, points };
        }
        let [a, b] = self.outlines(now);
        let points = [a.point(a.support(axis).vertex), b.point(b.support(-axis).vertex)];
        Touching { at: now, axis, apart: self.enough, points: self.on_surfaces(points, axis) }
    }

    /// The straight run of a chain that a segment belongs to (`which` of the two pieces), as seen by the other at a
    /// time; `None` if the other is on a side that it does not face.
    pub(super) fn surface(&self, which: usize, chain: &Chain, run: &Run, now: f64) -> Option<Surface> {
        let (turn, origin) = self.place(which, now);
        let other = 1 - which;
        let center = (!self.pieces[other].is_line()).then(|| self.center(other, now));
        Surface::new(chain, run, (&turn, origin), center)
    }

    /// Up to this far apart, points of shapes that count as touching are one place.
    pub(super) fn nearness(&self) -> f64 {
        2.0 * self.enough
    }

    /// Half-planes that face away from each other meet as soon as one of them turns.
    fn lines_that_turn(&self) -> Touching {
        let now = self.times[0];
        let look = self.look_from_line(0, now);
        let apart = look.most.max(0.0) + self.slack;
        Touching { at: now, axis: look.axis, apart, points: look.points }
    }

    /// The gap at a time, and the axis that shows it; `None` if the cores are too close to tell.
    fn look(&self, now: f64, axis: DVec2) -> Option<Look> {
        if let Some(line) = self.line() {
            return Some(self.look_from_line(line, now));
        }
        let [a, b] = self.outlines(now);
        let rounding = self.precision.projection();
        let bounds = |axis: DVec2, least: f64, most: f64, points: [DVec2; 2]| Look {
            axis,
            least: least - self.radii - rounding,
            most: most - self.radii + rounding,
            points,
        };
        if a.edge_count() + b.edge_count() == 0 {
            let points = [a.point(0), b.point(0)];
            let apart = points[1] - points[0];
            let length = apart.length();
            return (length > 0.0).then(|| bounds(apart / length, length, length, points));
        }
        let Reached::Between(found) = distance(&a, &b, axis, &Until::met(&self.precision)) else {
            return None;
        };
        let Witness { normal, at_least, distance, point_a, point_b, .. } = found;
        // Corners that almost touch leave no axis.
        normal.is_normalized().then(|| bounds(normal, at_least, distance, [point_a, point_b]))
    }

    /// The same, where one is a half-plane: its own normal is the only axis.
    fn look_from_line(&self, line: usize, now: f64) -> Look {
        let (normal, point, height) = self.height(line, now);
        let foot = point - normal * height;
        let rounding = self.precision.projection();
        let (axis, points) = if line == 0 { (normal, [foot, point]) } else { (-normal, [point, foot]) };
        let height = height - self.radii;
        Look { axis, least: height - rounding, most: height + rounding, points }
    }

    /// A lower bound on the gap along an axis at a time; if one is a half-plane, along its normal.
    pub(super) fn gap(&self, axis: DVec2, now: f64) -> f64 {
        let between = match self.line() {
            Some(line) => self.height(line, now).2,
            None => {
                let [a, b] = self.outlines(now);
                -a.support(axis).reach - b.support(-axis).reach
            }
        };
        between - self.radii - self.precision.projection()
    }

    /// A half-plane's unit normal at a time, the other's lowest vertex, and its height.
    fn height(&self, line: usize, now: f64) -> (DVec2, DVec2, f64) {
        let (turn, origin) = self.place(line, now);
        let normal = match self.pieces[line].shape {
            Shape2::HalfPlane(half_plane) => turn.turn(half_plane.unit_normal()).normalize(),
            _ => DVec2::Y,
        };
        let other = 1 - line;
        let point = if self.pieces[other].is_line() {
            self.place(other, now).1
        } else {
            let outline = self.outline(other, now);
            outline.point(outline.support(-normal).vertex)
        };
        (normal, point, normal.dot(point - origin))
    }

    /// Whether one of the two is a half-plane.
    pub(super) fn is_with_line(&self, which: usize) -> bool {
        self.pieces[which].is_line()
    }

    fn line(&self) -> Option<usize> {
        self.pieces.iter().position(|piece| piece.is_line())
    }

    /// A part's rotation at a time, and its origin relative to A's position.
    fn place(&self, which: usize, now: f64) -> (Turn, DVec2) {
        let turn = self.stretch.spins[which].turn_at(now);
        let body = if which == 0 { DVec2::ZERO } else { self.stretch.offset_at(now) };
        match self.pieces[which].local {
            Some(local) => (turn.of_part(local.rotation()), body + turn.turn(local.position())),
            None => (turn, body),
        }
    }

    fn outline(&self, which: usize, now: f64) -> Outline<'_> {
        let (turn, origin) = self.place(which, now);
        Outline::new(self.pieces[which].shape, &self.cores[which], turn, origin)
    }

    fn outlines(&self, now: f64) -> [Outline<'_>; 2] {
        [self.outline(0, now), self.outline(1, now)]
    }

    /// The centre of a part's bounding circle at a time, relative to A's position.
    fn center(&self, which: usize, now: f64) -> DVec2 {
        let (turn, origin) = self.place(which, now);
        origin + turn.turn(self.pieces[which].shape.center().as_dvec2())
    }

    /// From one part's centre to the other's: an axis to begin with.
    fn towards_b(&self, now: f64) -> DVec2 {
        (self.center(1, now) - self.center(0, now)).try_normalize().unwrap_or(DVec2::Y)
    }

    /// Points of the cores moved out to the surfaces.
    fn on_surfaces(&self, [on_a, on_b]: [DVec2; 2], axis: DVec2) -> [DVec2; 2] {
        let [radius_a, radius_b] = self.pieces.map(|piece| f64::from(piece.shape.radius()));
        [on_a + axis * radius_a, on_b - axis * radius_b]
    }
}
