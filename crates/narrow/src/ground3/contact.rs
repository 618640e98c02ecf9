//! Contacts of a body on ground.
//!
//! ```text
//! for each convex part of the body:
//!   a sphere takes a fast path of its own                                                         (round)
//!   its vertices are transformed to the ground's axes                                             (standing)
//!   for each triangle near its box, several read at a time:
//!     all of the part is further from the plane than the reach, on either side: done              (over)
//!     the side that the part is on: for one-sided ground that of the plane, and only the front counts; for other
//!         ground that of the surface around the triangle's point nearest to the part's centre     (facet)
//!     no prominent edge or corner (convex, or on the rim) near the part, or its lowest vertex well inside:
//!         the triangle's normal                                                                   (closer, prism)
//!     a cheap axis separates them by more than the reach: done; any of a cuboid's thirteen        (standing, axes)
//!     the edge or corner that is in reach has a contact through a neighbour already: done         (prominent_near)
//!     an edge or corner lies well inside the part's face: that face's normal, if accepted         (against)
//!     a cuboid overlaps it, and the axis of least depth is rejected: no kernel is called          (axes)
//!     a cuboid is across a gap: closest points in closed form; if rejected, no kernel either      (gap)
//!     else the kernels for part and triangle: their axis, if the feature's neighbours accept it   (meeting)
//!         else the triangle's normal, unless a contact with other triangles frees it              (rejected)
//!   where the part penetrates a flat patch: deeper points over the rest of that                   (whole, rim)
//!   contact points join the group of their normal                                                 (groups)
//!   overlap, yes or no: a segment of the part crosses a triangle, or all of it is above; else exactly
//!   closer points across a gap, along rejected directions                                         (rejected_gaps)
//!   a smaller separation that many low bends (edges too flat for a normal of their own) may hide  (second_search)
//!   for a pair with a motion: planes of triangles that are still ahead                            (ahead)
//!   each group becomes a manifold; its error includes what low bends may hide                     (answer, protrusion)
//! ```
//! **No ghosts.** A direction counts only if it lies in the Voronoi region of the triangle's feature, judged with *all*
//! ground around that feature: an edge's direction must lean towards neither face beside it, a corner's along none of
//! its edges. Directions from flat and concave edges are rejected, and the triangle's normal takes their place.
//!
//! No penetration is reported for a triangle that the part does not meet: a body over one slope of a roof is behind the
//! plane of the other slope, but its distance behind that plane is not a depth. Where the part penetrates connected
//! ground in the triangle's plane, it leaves all of that at once, so its depth is the depth in the whole patch.
//! Penetrating points are the same at any margin: a larger margin adds points across a gap, and nothing else (see
//! `whole`).
//!
//! The triangle's normal may be a bad substitute. Take a box that leans over a cliff, and a triangle of the cliff's top
//! of which only a corner lies in the box: the box leaves it sideways along the cliff, a direction that the triangle's
//! neighbours reject; straight up would throw the box onto the cliff. So triangles whose axis was rejected wait until
//! all others have been processed: they add nothing if moving the part along another normal found, by the depth along
//! that normal, separates it from them too (see `rejected`). Nor does two-sided ground that is seen from behind across
//! a gap, where it lies below what the part stands on (`behind`).
//!
//! **The fast path.** Say that the part's lowest vertex is over the triangle. Across a gap of the cores it is the
//! closest point, and the triangle's normal is the answer. In overlap by h, a direction that leans by the angle a over
//! an edge at a distance r has a depth of at least r sin a + h cos a. So it is no better than the normal with its h as
//! long as r >= h tan(a / 2); for angles up to a right angle, as long as r >= h. Only otherwise the kernels (the
//! general routines for two convex shapes) are called.
//!
//! **What else saves time.** AMD EPYC, Zen 4, 2 virtual cores, 2026-11-22; first a box of a metre on triangles of half
//! a metre, on a busy machine, then whole frames of a thousand bodies that roll over hills of 20,000 triangles, in
//! instructions per body:
//! 1. triangles of one flat patch share plane, heights and incident face: 6.2 us to 4.0 on a plane, with 3;
//! 2. before the kernels, cheap axes: the part's own, across two edges, and from the nearest point to the centre; and a
//!    triangle whose only corner or edge in reach has a contact through a neighbour is skipped: 23 us to 10.5 on bumps;
//! 3. large structures (points by groups, vertices) are filled in place: moving them took a tenth of the time;
//! 4. a fast path for spheres: 8.0 k to 6.5 k;
//! 5. the axis of least depth for a cuboid that overlaps a triangle, where ground rejects it anyway: kernels are called
//!    610 times instead of 1,595, 35.2 k to 31.5 k for cuboids;
//! 6. tests of planes before tests of sides, the least and greatest of eight heights before their indices, a cuboid's
//!    face from the normal: 31.5 k to 27.8 k;
//! 7. sides beyond reach not clipped, no calls of `map`, points reduced in place: 27.8 k to 25.2 k;
//! 8. vertices transformed eight at a time, the box taken from them, and no points made along rejected directions:
//!    40.7 k to 36.3 k for hulls of 32;
//! 9. triangles near a body read together: on a million of them spheres are 10 to 25 % faster where other work uses the
//!    caches, and 7 % slower on an idle machine;
//! 10. triangles read without placeholders to overwrite, no vertices counted where a single one is furthest: 2 to 4 %
//!     fewer instructions;
//! 11. a cuboid's gap in closed form; only closest points asked for where ground rejects the direction; a plane, axes
//!     and groups filled in place, a face's sides made once per triangle, the side of the ground decided without roots
//!     where all normals agree: 62.0 k to 51.6 k for cuboids, about which more is asked by now than at 10, 41.6 k to
//!     39.7 k for hulls (2026-11-23);
//! 12. the mesh stores which triangles have low bends; planes out of reach are found by the box around the part, the
//!     part's side at edges that bend away, what was rejected is kept as it was: 33.0 k to 28.4 k for cuboids, 38.3 k
//!     to 35.3 k for hulls, in the first seven frames (AMD EPYC, Zen 5, 2 virtual cores, 2026-11-24). A ball pays 1 %
//!     for what it does not use;
//! 13. only the gaps of a cuboid's axes are stored, heights of eight vertices computed in a function of their own,
//!     corners out of reach dropped before a call, no closed forms tried first: 50.3 k to 47.9 k for cuboids, 35.7 k to
//!     34.7 k for hulls, in frames 3 to 12, and 6.2 k to 6.0 k for spheres (callgrind, 2026-11-28).
//!
//! The kernels still take some 20 k instructions each time that they make points, and 12 k where ground rejects the
//! closest: for three rolling cuboids in eight, and five hulls in nine. A world calls all this only for bodies whose
//! manifolds cannot be moved along.
//!
//! **Overlap, yes or no,** is exact, as everywhere, over all triangles that face the part. What rounding bounds do not
//! settle is decided last, the likeliest first, up to the first yes.
//!
//! **Half-spaces** have a single normal and no bounds: every triangle is visited, and the corners that reach deepest
//! count. Cost: linear in the ground.

mod against;
mod ahead;
mod answer;
mod axes;
mod ball;
mod behind;
mod closer;
mod facet;
mod gap;
mod groups;
mod meeting;
mod over;
mod plane;
mod prism;
mod prominent_near;
mod protrusion;
mod rejected;
mod rejected_gaps;
mod rim;
mod round;
mod second_search;
mod side;
mod standing;
mod whole;

use super::OnGround;
use crate::counted::count_step;
use crate::pair3::{Pair3, Part, for_parts, reach_of};
use crate::polyhedron::solid::Solid;
use crate::room::Room;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Aabb3, NearTriangle, Pose3, Shape3};
use ball::nearest_to;
use behind::AllBehind;
use core::cell::Cell;
use core::ops::ControlFlow;
use facet::Facet;
pub(crate) use facet::{front_of, widened};
use groups::Groups;
use meeting::Meeting;
use over::Plane;
use prism::{Incident, Prism};
use protrusion::Levels;
use rejected::AllRejected;
use rejected_gaps::RejectedGaps;
use round::Round;
use standing::{Octets, Place, Standing};
pub(super) use standing::{doubt_of, span_of};
use whole::touching;

/// Most triangles whose overlap decision waits until all have been seen.
const MOST_UNCLEAR: usize = 32;

impl Pair3<'_> {
    /// Whether a body and ground overlap, if they are within the margin, of which motions may use up some metres; their
    /// manifolds go where they are wanted. Two grounds have no contacts with each other.
    pub(crate) fn contact_on(
        &self,
        on: &OnGround,
        margin_and_ahead: [f32; 2],
        manifolds: &mut impl Room,
    ) -> Option<bool> {
        contact_by(self, on, margin_and_ahead, manifolds, false)
    }
}

/// The same, with the fast paths, or by the general path alone.
#[inline]
fn contact_by(
    pair: &Pair3,
    on: &OnGround,
    [margin, ahead]: [f32; 2],
    manifolds: &mut impl Room,
    is_plain: bool,
) -> Option<bool> {
    if on.body.is_ground() {
        return None;
    }
    let poses = if on.is_b { [&pair.pose_a, &pair.pose_b] } else { [&pair.pose_b, &pair.pose_a] };
    let query = GroundQuery {
        on,
        poses,
        margin: margin.max(0.0),
        reach: reach_of(margin),
        ahead: ahead.min(margin).into(),
        is_plain,
    };
    let mut found: Option<bool> = None;
    for_parts(on.body, &on.body_basis, |part| {
        if let Some(overlapping) = query.contact_of(part, found == Some(true), manifolds) {
            found = Some(found.unwrap_or(false) || overlapping);
        }
        found == Some(true) && !manifolds.is_wanted()
    });
    found
}

/// A query: contacts of a body on ground within a margin.
struct GroundQuery<'a> {
    on: &'a OnGround<'a>,
    /// The body's and the ground's.
    poses: [&'a Pose3; 2],
    margin: f32,
    /// The widest gap in which a point is wanted, in metres.
    reach: f64,
    /// By how much of that motions may bring the body nearer, in metres.
    ahead: f64,
    /// By the general path alone, which tests compare the fast paths with.
    is_plain: bool,
}

/// What has been found for a part so far.
struct Known {
    groups: Groups,
    /// Overlap has been proved, beyond rounding error.
    overlapping: bool,
    /// The first triangle for which it was.
    shown_by: Option<u32>,
    /// Triangles for which f64 could not decide.
    unclear: ArrayVec<Unclear, MOST_UNCLEAR>,
    /// Triangles that are seen from behind, across a gap, and wait.
    behind: AllBehind,
    /// Triangles whose axis was rejected, and which wait.
    rejected: AllRejected,
    /// Closest points across a gap whose direction was rejected.
    rejected_gaps: RejectedGaps,
    incident: Option<Incident>,
    /// Lower bounds on the separation of triangles that have low bends.
    levels: Levels,
}

/// A triangle for which f64 cannot decide whether the part shares a point with it.
#[derive(Clone, Copy)]
struct Unclear {
    /// Whether it gave any contact point.
    has_points: bool,
    separation: f64,
    number: u32,
}

/// A part that is being tested against triangles.
struct PartTest<'s> {
    query: &'s GroundQuery<'s>,
    standing: &'s Standing<'s>,
    meeting: Meeting<'s>,
    /// The part's box, grown by the reach.
    bounds: Aabb3,
    is_ball: bool,
}

impl<'a> GroundQuery<'a> {
    /// Whether a part overlaps, if it is within the margin. Once another part is known to overlap, this part's own
    /// decision does not matter.
    fn contact_of(&self, part: Part<'a>, is_overlap_known: bool, manifolds: &mut impl Room) -> Option<bool> {
        if !self.is_plain
            && let Some(round) = Round::of(self, &part)
            && let Some(found) = round.contact(self, part, is_overlap_known, manifolds)
        {
            return found;
        }
        self.contact_in_general(part, is_overlap_known, manifolds)
    }

    #[inline(never)]
    fn contact_in_general(
        &self,
        part: Part<'a>,
        is_overlap_known: bool,
        manifolds: &mut impl Room,
    ) -> Option<bool> {
        let place = Place::of(self.on, &part, self.poses);
        let core = part.shape.core();
        let solid = Solid::new(&core, place.axes, place.origin, f64::from(part.shape.radius()));
        let mut octets = Octets::new_const();
        let standing = Standing::new(part, place, (&core, &solid), &mut octets);
        let bounds = self.on.bounds_around(&part, standing.turned, self.reach);
        let meeting = Meeting::new(self.on, part, self.poses);
        let is_ball = matches!(part.shape, Shape3::Sphere(_));
        let test = PartTest { query: self, standing: &standing, meeting, bounds, is_ball };
        let mut known = Known::new([standing.slack, standing.even]);
        let is_yes_enough = !manifolds.is_wanted();
        if let Shape3::HalfSpace(half_space) = part.shape {
            test.look_at_all(place.axes.turn(half_space.unit_normal()), is_yes_enough, &mut known);
        } else {
            let mut plane = None;
            let _ = self.on.ground.read_near(&bounds, |near| {
                test.look_at(near, &mut plane, &mut known);
                if known.overlapping && is_yes_enough {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            });
        }
        test.look_at_behind(&mut known);
        test.add_rejected(&mut known);
        if manifolds.is_wanted() {
            test.add_whole(&mut known);
        }
        test.conclude(&mut known, is_overlap_known);
        test.bound_least(&mut known, manifolds.is_wanted());
        if self.ahead > 0.0 && manifolds.is_wanted() {
            match Round::of(self, &part) {
                Some(round) => round.look_ahead(self, &mut known),
                None => test.look_ahead(&mut known),
            }
        }
        self.answer(part, &mut known, is_overlap_known, manifolds)
    }
}

impl Known {
    #[inline(always)]
    fn new([slack, even]: [f64; 2]) -> Self {
        Self {
            groups: Groups::new(slack, even),
            overlapping: false,
            shown_by: None,
            unclear: ArrayVec::new(),
            behind: ArrayVec::new_const(),
            rejected: ArrayVec::new_const(),
            rejected_gaps: ArrayVec::new_const(),
            incident: None,
            levels: Levels::new(),
        }
    }
}

impl PartTest<'_> {
    /// Processes one triangle; `plane` is that of the one before.
    fn look_at(&self, near: &NearTriangle, plane: &mut Option<Plane>, known: &mut Known) {
        count_step();
        if self.is_ball {
            return self.look_at_from_ball(near.number, known);
        }
        if !self.is_within(near, plane) {
            return;
        }
        let Some(plane) = plane else { return };
        let prism = self.prism_over(plane);
        if !self.leaves_behind(near, &prism, known) {
            self.look_on(near, &prism, known);
        }
    }

    /// The part's incident face for a normal; the last one is cached.
    #[inline(always)]
    fn incident_to(&self, normal: DVec3, known: &mut Known) -> Incident {
        match known.incident {
            Some(incident) if incident.is_for(normal) => incident,
            _ => *known.incident.insert(Incident::of(self.standing, normal)),
        }
    }

    /// Adds points along the triangle's normal. Where the triangle is seen from behind, or from in front by a part
    /// whose centre is behind its plane, penetrating points are added only if part and triangle meet: a part beyond a
    /// bend may be behind the plane of a triangle, and nowhere near the triangle itself.
    fn add_where_met(&self, prism: &Prism, separation: f64, known: &mut Known) -> bool {
        let (least, may_meet) = (self.deep_below(prism), || self.may_meet(prism));
        let is_clear = || prism.facet.is_front && prism.facet.height(self.standing.center) >= 0.0;
        if separation >= least || is_clear() && may_meet() {
            return self.add_by_normal(prism, known);
        }
        let is_left_out = Cell::new(false);
        let has_points = self.add_by_normal(&Prism { gate: Some((least, &is_left_out)), ..*prism }, known);
        if is_left_out.get() && may_meet() && self.meets(prism) {
            return self.add_by_normal(prism, known);
        }
        has_points
    }

    fn add_by_normal(&self, prism: &Prism, known: &mut Known) -> bool {
        let incident = self.incident_to(prism.facet.normal, known);
        prism.add_points(&incident, &mut known.groups)
    }

    /// Keeps a triangle that f64 cannot decide for later, or decides it exactly at once where there is no room.
    fn leave_unclear(&self, number: u32, (has_points, separation): (bool, f64), known: &mut Known) {
        if known.overlapping {
            return;
        }
        if let Err(full) = known.unclear.try_push(Unclear { has_points, separation, number }) {
            let Unclear { number, .. } = full.element();
            if self.meeting.overlaps(self.query.on.ground, number) {
                known.settle(number);
            }
        }
    }

    /// Decides what was left open, and makes overlap and contact points agree.
    fn conclude(&self, known: &mut Known, is_overlap_known: bool) {
        let slack = self.standing.slack;
        if !(known.overlapping || is_overlap_known && known.groups.least() >= -slack) {
            // Triangles that gave points first, the deepest of those before others.
            known.unclear.sort_unstable_by(|a, b| {
                let by_depth = a.separation.total_cmp(&b.separation);
                b.has_points.cmp(&a.has_points).then(by_depth).then(a.number.cmp(&b.number))
            });
            let mut numbers = known.unclear.iter().map(|unclear| unclear.number);
            match numbers.find(|&number| self.meeting.overlaps(self.query.on.ground, number)) {
                Some(number) => known.settle(number),
                None => known.groups.keep_within(-slack),
            }
        }
        if known.groups.least() > slack
            && let Some(number) = known.shown_by
        {
            self.add_last(number, known);
        }
        self.report_rejected_gaps(known);
    }

    /// Adds the deepest point over a triangle that the part overlaps, where every point was clipped away: where the
    /// part's lowest point is beside the triangle, over its sides. Where rounding leaves none of those, the lowest
    /// point itself.
    #[cold]
    #[inline(never)]
    fn add_last(&self, number: u32, known: &mut Known) {
        let standing = self.standing;
        if let Shape3::HalfSpace(half_space) = standing.part.shape {
            return self.add_lowest_corner(number, standing.place.axes.turn(half_space.unit_normal()), known);
        }
        let Some(plane) = self.plane_of(number) else { return };
        let prism = self.prism_over(&plane);
        let base = prism.base();
        if !prism.is_lowest_over() {
            let prism = Prism { reach: touching(), ..prism };
            (0..3).for_each(|edge| prism.add_deepest_over(edge, &base, &mut known.groups));
        }
        if known.groups.least() <= standing.slack {
            return self.add_whole(known);
        }
        let mut pin = prism.lowest();
        pin.on_ground = nearest_to(&plane.facet, pin.on_ground).1;
        known.groups.add(&base, pin);
    }

    /// Error bound of a height over a triangle, in metres.
    fn doubt_over(&self, facet: &Facet) -> f64 {
        let Standing { center, outer_radius, lengths, .. } = *self.standing;
        facet.doubt((center, outer_radius), lengths)
    }
}

impl Known {
    fn settle(&mut self, number: u32) {
        self.overlapping = true;
        self.shown_by.get_or_insert(number);
    }
}

#[cfg(test)]
mod tests;
