//! Motions that end on ground made of triangles.
//!
//! ```text
//! for each convex part of the body
//!   for each triangle whose box the part's box meets on its way, nearest first, until the first touch so far
//!     one-sided, and the part's centre starts behind:       passed through
//!     the part starts and ends on one side of its plane, or another axis separates the two all the way:  passed by
//!     it comes down on the inside of the triangle:          there, in closed form             (ground3::bounds::landing)
//!     else, once a few such are found:                      when the two touch, as any two convex shapes
//!     touched at an inner edge or vertex, along a direction that the part moves away in:
//!       one-sided, some of it is behind, and its centre stays in front of the triangle's plane:
//!                                                           it comes out of the ground, and passes
//!       else:                                               an impact along the axis that they touch along
//! report the triangle touched first, with the ground's normal there: inner edges and vertices have none of their own
//! ```
//! The side is that at the start of the motion: what comes from the front is stopped however fast it is. What is behind
//! one triangle and in front of the plane of the next comes up through the former, and meets the latter's edge from
//! below: there is no front that it moves into.

use super::advance::{End, Met};
use super::beyond::MOMENTS;
use super::counts::Counts;
use super::passage::{Course, Passage};
use super::{end_of_apart, impact_of, part_end};
use crate::ground3::{Corners, Facing, OnGround, Touched, Viewpoint};
use crate::impact3::Impact3;
use crate::pair3::{Pair3, Part};
use arrayvec::ArrayVec;
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};
use core::ops::ControlFlow;

/// Triangles that are kept for later, until one is found on whose inside the part comes down: the more, the more of
/// them that one rules out; the fewer, the sooner another ends the search.
const MOST_LATER: usize = 16;

/// The first touch so far.
struct First {
    met: Met,
    part: u32,
    triangle: u32,
    /// The part's radius, in metres.
    radius: f64,
    /// Tells which side the part is on at the start, in the ground's axes.
    viewpoint: Viewpoint,
}

/// The search for the first touch in one motion over one ground.
struct Search<'s> {
    pair: &'s Pair3<'s>,
    on: &'s OnGround<'s>,
    passage: &'s Passage,
    /// How the body moves over the ground, in the ground's axes.
    way: DVec3,
    first: Option<First>,
    /// Whether they touch at the start.
    touches: bool,
    counts: Counts<'s>,
}

impl Pair3<'_> {
    pub(super) fn first_touch_on(&self, on: &OnGround, passage: &Passage, counts: Counts) -> Option<Impact3> {
        if passage.is_still() {
            return self.overlaps_facing(on).then(|| self.touching_at_start());
        }
        let drift = if on.is_b { passage.drift } else { -passage.drift };
        let way = on.basis.turn_back(drift);
        let mut search = Search { pair: self, on, passage, way, first: None, touches: false, counts };
        let reach = if passage.is_straight() { drift.length() } else { f64::INFINITY };
        on.for_body_parts(reach, |part| {
            search.over(part);
            search.touches
        });
        if search.touches {
            return Some(self.touching_at_start());
        }
        search.first.map(|first| impact_and_facing(on, passage, &first).0)
    }
}

impl Search<'_> {
    fn until(&self) -> f64 {
        self.first.as_ref().map_or(1.0, |first| first.met.fraction)
    }

    /// Tests the triangles on the way of a part.
    fn over(&mut self, part: &Part) {
        let placed = Corners::of(self.on, part);
        let on = self.on;
        let bounds = placed.bounds(0.0, part);
        let (mut low, mut high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let [of_body, of_ground] = on.in_order([0, 1]);
        if self.passage.turns[of_ground].is_some() || !low.is_finite() {
            // Seen from ground that turns, a body flies in curves.
            let _ = on.ground.visit_near(
                &asunder_geometry::Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY),
                |number| {
                    if self.look(part, &placed, number) < 0.0 {
                        ControlFlow::Break(())
                    } else {
                        ControlFlow::Continue(())
                    }
                },
            );
            return;
        }
        if self.passage.turns[of_body].is_some() {
            let arm = part.center.length() + f64::from(part.shape.outer_radius());
            let middle = on.basis.turn_back(on.to_body);
            let arm = DVec3::splat(arm * (1.0 + 64.0 * f64::EPSILON) + 64.0 * f64::EPSILON * middle.length());
            (low, high) = (middle - arm, middle + arm);
        }
        let rounding = DVec3::splat(self.passage.rounding);
        let half = (((high - low) * 0.5 + rounding) * (1.0 + 2.0 * f64::from(f32::EPSILON))).as_vec3();
        let mut later = ArrayVec::<u32, MOST_LATER>::new();
        let is_straight = self.passage.is_straight();
        on.ground.read_along((low + high) * 0.5, self.way, half, self.until(), |number, corners| {
            if !is_straight {
                return self.look(part, &placed, number);
            }
            if self.may_meet(&placed, corners) && !self.lands((part, &placed), (number, corners)) {
                later.push(number);
                if later.is_full() {
                    self.look_at_all(part, &placed, &mut later);
                }
            }
            if self.touches { -1.0 } else { self.until() }
        });
        self.look_at_all(part, &placed, &mut later);
    }

    fn look_at_all(&mut self, part: &Part, placed: &Corners, later: &mut ArrayVec<u32, MOST_LATER>) {
        for number in later.drain(..) {
            if !self.touches {
                self.look(part, placed, number);
            }
        }
    }

    /// Whether a part may touch a triangle before the first touch so far.
    fn may_meet(&self, placed: &Corners, corners: [Vec3; 3]) -> bool {
        let is_beside = || {
            self.passage.is_straight()
                && placed.passes(corners, self.way * self.until(), self.passage.rounding)
        };
        self.on.is_facing(corners, placed.viewpoint) && !is_beside()
    }

    /// Whether a part that does not turn comes down on the inside of a triangle: then that is the first touch, unless it
    /// does not count or another is known that comes before.
    fn lands(&mut self, (part, placed): (&Part, &Corners), (number, corners): (u32, [Vec3; 3])) -> bool {
        let (on, passage) = (self.on, self.passage);
        let Some(landing) = placed.landing(part, corners, (self.way, self.until(), passage.rounding)) else {
            return false;
        };
        let Some(triangle) = on.ground.triangle(number).map(Shape3::Triangle) else { return false };
        let of_ground = Part::whole(&triangle, &on.basis);
        let [up, foot] = [landing.up, landing.foot].map(|v| on.basis.turn(v));
        let on_ground = foot + on.basis.turn(self.way * landing.fraction) - up * landing.gap;
        let rounding = if landing.fraction > 0.0 { passage.rounding } else { 0.0 };
        let met = Met {
            fraction: landing.fraction,
            gap: landing.gap + rounding,
            normal: if on.is_b { -up } else { up },
            anchors: on.in_order([foot - on.to_body, on_ground]),
        };
        self.offer((part, placed), (number, &of_ground), met);
        true
    }

    /// Tests when a part touches a triangle; returns until when other triangles matter.
    fn look(&mut self, part: &Part, placed: &Corners, number: u32) -> f64 {
        let on = self.on;
        let until = self.until();
        if !self.may_meet(placed, on.ground.corners(number)) {
            return until;
        }
        let Some(triangle) = on.ground.triangle(number).map(Shape3::Triangle) else { return until };
        let of_ground = Part::whole(&triangle, &on.basis);
        let parts = on.in_order([*part, of_ground]);
        let Some(stretch) = self.passage.stretch([&parts[0], &parts[1]], until) else { return until };
        let met = match part_end(self.passage, parts, &stretch, until) {
            End::Apart => return until,
            End::Met(met) => met,
            End::Unclear(met, is_parting) => {
                let both = self.pair.parts(&self.passage.bases, parts[0], parts[1]);
                if both.convex.verdict().overlapping {
                    self.touches = self.counts.is_all();
                    return if self.touches { -1.0 } else { until };
                }
                let met = end_of_apart(self.passage, parts, (met, is_parting), until);
                let Some(met) = met else { return until };
                met
            }
        };
        self.offer((part, placed), (number, &of_ground), met);
        self.until()
    }

    /// Takes a touch of a part with a triangle, if it counts, and none is known that comes before.
    fn offer(&mut self, (part, placed): (&Part, &Corners), (number, of_ground): (u32, &Part), met: Met) {
        let rank = (met.fraction, part.index, number);
        if self.first.as_ref().is_none_or(|known| rank < (known.met.fraction, known.part, known.triangle)) {
            let radius = f64::from(part.shape.radius());
            let first =
                First { met, part: part.index, triangle: number, radius, viewpoint: placed.viewpoint };
            if !self.is_passed(&first, self.on.in_order([*part, *of_ground])) {
                self.first = Some(first);
            }
        }
    }

    /// Whether a touch does not count, such as with one-sided ground that the part comes out of.
    fn is_passed(&self, first: &First, parts: [Part; 2]) -> bool {
        let is_one_sided = self.on.ground.is_one_sided();
        if !is_one_sided && self.counts.is_all() {
            return false;
        }
        let (impact, facing) = impact_and_facing(self.on, self.passage, first);
        if is_one_sided
            && facing.is_left
            && self.reaches_behind(first, facing.away, parts)
            && self.stays_in_front(first, parts)
        {
            return true;
        }
        let normal = if self.on.is_b { -facing.away } else { facing.away };
        !self.counts.admits((self.passage, parts), (first.met.fraction, normal), || impact)
    }

    /// Whether some of a part is behind a touched point, along the ground's direction there: else it does not come out
    /// of the ground. A crate that lies on a floor and turns has a side that rises and one that sinks, and which of the
    /// two is found to touch is up to rounding.
    fn reaches_behind(&self, first: &First, away: DVec3, parts: [Part; 2]) -> bool {
        let (on, passage, met) = (self.on, self.passage, &first.met);
        if passage.is_straight() {
            return true;
        }
        let [body, ground] = on.in_order([0, 1]);
        let (core_a, core_b) = (parts[0].shape.core(), parts[1].shape.core());
        let course = Course::new(passage, parts, [&core_a, &core_b]);
        let moment = course.at(met.fraction);
        let point = met.anchors[ground] + if on.is_b { moment.between } else { DVec3::ZERO };
        let height = -moment.reach_of(body, -away) - first.radius - away.dot(point);
        height < -(course.slack + course.fineness.gap(moment.precision.projection()))
    }

    /// Whether a part's centre stays in front of the plane of a triangle that it leaves: a part that turns may come
    /// back, and go through.
    fn stays_in_front(&self, first: &First, parts: [Part; 2]) -> bool {
        let (on, passage) = (self.on, self.passage);
        if passage.is_straight() {
            return true;
        }
        let [body, ground] = on.in_order([0, 1]);
        let [a, b, c] = on.ground.corners(first.triangle).map(|corner| corner.as_dvec3());
        let normal = (b - a).cross(c - a);
        let local = passage.bases[body].turn_back(parts[body].center);
        let after = (1..=MOMENTS).map(|i| f64::from(i) / f64::from(MOMENTS));
        after.filter(|&at| at > first.met.fraction).all(|at| {
            let basis = |i: usize| passage.turns[i].map_or(passage.bases[i], |turn| turn.basis_at(at));
            let between = passage.between_at(at);
            let to_body = if on.is_b { -between } else { between };
            let center = basis(ground).turn_back(to_body + basis(body).turn(local));
            Viewpoint::Place(center).is_in_front(a, normal)
        })
    }
}

/// The impact, with the ground's direction at the touch for its normal; and that direction, in world axes. If the body
/// moves away along it, but into what it touches, the impact has the axis that they touch along.
///
/// A body that turns may lean over an inner edge from the far side, and what is level is still decided by the ground's
/// direction: a box that slides over a hill, pressed into it, meets the far corners from inside.
fn impact_and_facing(on: &OnGround, passage: &Passage, first: &First) -> (Impact3, Facing) {
    let met = &first.met;
    let [_, of_ground] = on.in_order([0, 1]);
    let basis = passage.turns[of_ground].map_or(on.basis, |turn| turn.basis_at(met.fraction));
    let towards_body = if on.is_b { -met.normal } else { met.normal };
    let touched = Touched {
        triangle: first.triangle,
        point: basis.turn_back(met.anchors[of_ground]),
        away: basis.turn_back(towards_body),
        way: basis.turn_back(way_of_body(on, passage, first)),
    };
    let facing = on.facing(&touched, first.viewpoint);
    let facing = Facing { away: basis.turn(facing.away), ..facing };
    let away = if facing.is_left && !touched.is_left(touched.away) { towards_body } else { facing.away };
    let normal = if on.is_b { -away } else { away };
    (impact_of(&Met { normal, ..*met }, on.in_order([first.part, facing.triangle])), facing)
}

/// The velocity of the touching point of the body's core at that moment, as seen from the ground: for a ball, of its
/// centre, however it turns about that.
fn way_of_body(on: &OnGround, passage: &Passage, first: &First) -> DVec3 {
    let Met { fraction, normal, anchors, .. } = first.met;
    let between = passage.between_at(fraction);
    let spun = |i: usize, arm: DVec3| {
        passage.turns[i].map_or(DVec3::ZERO, |turn| (turn.axis() * turn.speed_at(fraction)).cross(arm))
    };
    // From A's position.
    let point = if on.is_b {
        anchors[0] - normal * first.radius
    } else {
        between + anchors[1] + normal * first.radius
    };
    let way = passage.drift + spun(0, point) - spun(1, point - between);
    if on.is_b { way } else { -way }
}
