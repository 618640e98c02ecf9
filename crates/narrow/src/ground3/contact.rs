//! Contacts of a body on ground.
//!
//! ```text
//! for each convex part of the body:
//!   a sphere has a short way of its own                                                                 (round)
//!   its vertices in the ground's axes                                                                (standing)
//!   for each triangle near its box, several read at a time:
//!     all of the part is further from the plane than wanted, on whichever side: done
//!     the side it is on: of one-sided ground the plane's, and its front alone counts; of other ground that of the
//!         surface around the point nearest to the part's centre                           (Facet::has_in_front)
//!     no edge or corner stands out near the part, or the part's lowest vertex is well inside:
//!         the triangle's own normal                                                           (closer, prism)
//!     an axis that costs little parts them: done; of a cuboid, any of thirteen                   (standing, axes)
//!     its corner or edge has spoken through a neighbour: done                                   (outstanding)
//!     a corner or edge of it stands well inside the part's face: that face's normal, if it is let through   (against)
//!     of a cuboid that overlaps it, the least deep axis is refused: no need to ask the kernels           (axes)
//!     of one that a gap parts from it, the nearest points are, in closed form: as little                  (gap)
//!     else the kernels of part and triangle: their axis, if the feature's neighbours let it through   (meeting)
//!         else the triangle's own normal, unless a contact with others frees the part from it, too
//!   where the part is deep in a flat patch, what is deeper over the rest of it                           (whole, rim)
//!   points go to the group of their normal                                                            (groups)
//!   yes or no: a segment of the part that crosses the triangle inside, or all of it above; else exactly
//!   what is nearer, in a gap along what ground refused                                              (unsaid)
//!   what many low bends hide of the least of all                                                 (overlooked)
//!   groups are told as manifolds, their errors with what low bends may hide                 (answer, protrusion)
//! ```
//! **No ghosts.** A direction counts only if it lies in the Voronoi region of the triangle's feature among *all* ground
//! around it: an edge gives a direction that leans towards neither face, a corner one that leans along none of its
//! edges. What flat and concave edges would give is refused, and the triangle's own normal stands in.
//!
//! It tells nothing deep of a triangle that the part does not meet: what lies over a ridge, on one slope of a roof, is
//! behind the other's plane, and by how much is no depth. Where the part is deep in ground that lies in the triangle's
//! plane and hangs together with it, it leaves all of that at once, and its depth is that of the whole. What is deep is
//! so at any margin: a larger one adds what a gap parts from the part, and nothing else (see `whole`).
//!
//! That normal may be a bad one: of a box that leans over a cliff, a triangle of the cliff's top whose corner alone
//! lies in the box is left by the box sideways along the cliff, which its neighbours refuse; straight up would throw
//! the box onto the cliff. So triangles whose axis was refused wait until all others have been heard: where a move
//! along one of their normals by its depth leaves such a triangle too, it has nothing to add (see `refused`). Nor has
//! two-sided ground that is seen from behind across a gap, where it lies below what the part stands on (`behind`).
//!
//! **The short way.** Where the lowest vertex of the part is over the triangle, in a gap of the cores it is the closest
//! point, and the normal is the answer. In overlap by h, a direction that leans by the angle a over an edge r away is
//! at least r sin a + h cos a deep, and so no better than the normal's h as long as r >= h tan(a / 2); up to a right
//! angle, as long as r >= h. Only beyond that the kernels are asked.
//!
//! **What else saves time.** AMD EPYC, Zen 4, 2 virtual cores, 2026-11-22; first a box of a metre on triangles of half
//! a metre, on a busy machine, then whole frames of a thousand bodies that roll over hills of 20,000 triangles, in
//! instructions per body:
//! 1. triangles of one flat patch share plane, heights and incident face: 6.2 us to 4.0 on a plane, with 3;
//! 2. before the kernels, axes that cost little: the part's own, across two edges, and from the nearest point to the
//!    centre; and a triangle whose only corner or edge in reach has spoken through a neighbour is passed over: 23 us to
//!    10.5 on bumps;
//! 3. what is large (points by groups, vertices) is filled where it stays: moved, it was a tenth of the time;
//! 4. a short way for spheres: 8.0 k to 6.5 k;
//! 5. the least deep axis of a cuboid that overlaps a triangle, where ground refuses it anyway: kernels are asked 610
//!    times in place of 1,595, 35.2 k to 31.5 k for cuboids;
//! 6. planes before sides, the least and greatest of eight heights before the place they have, a cuboid's face by its
//!    normal: 31.5 k to 27.8 k;
//! 7. no cuts on sides beyond reach, no calls of `map`, points reduced where they are: 27.8 k to 25.2 k;
//! 8. vertices turned eight by eight, the box taken from them, and no points made along what ground refuses: 40.7 k to
//!    36.3 k for hulls of 32;
//! 9. triangles near a body read together: on a million of them spheres are 10 to 25 % faster where other work uses the
//!    caches, and 7 % slower on an idle machine;
//! 10. triangles read without blanks, nothing counted around a furthest vertex that is alone: 2 to 4 % fewer
//!     instructions;
//! 11. a cuboid's gap in closed form; what ground refuses asked for closest points alone; a plane, axes and groups that
//!     stay where they are, a face's sides made once a triangle, sides of ground told without roots where all agree:
//!     62.0 k to 51.6 k for cuboids, which are asked more by now than at 10, 41.6 k to 39.7 k for hulls (2026-11-23);
//! 12. with the mesh it is known which triangles bend low; planes out of reach by the box around the part, sides told
//!     by edges that bend away, what was refused kept as it was: 33.0 k to 28.4 k for cuboids, 38.3 k to 35.3 k for
//!     hulls, in the first seven frames (AMD EPYC, Zen 5, 2 virtual cores, 2026-11-24). A ball pays 1 % for what it
//!     does not use;
//! 13. of a cuboid's axes gaps alone, heights of eight vertices in a call of their own, corners out of reach dropped
//!     before a call, no closed forms asked for first: 50.3 k to 47.9 k for cuboids, 35.7 k to 34.7 k for hulls, in
//!     frames 3 to 12, and 6.2 k to 6.0 k for spheres (callgrind, 2026-11-28).
//!
//! The kernels take some 20 k instructions still each time that they make points, 12 k where ground refuses the
//! closest: for three rolling cuboids in eight, and five hulls in nine. A world asks only about bodies that cannot be
//! moved along.
//!
//! **Yes or no** is exact, as everywhere: of all triangles that see the part. What is not settled by rounding bounds is
//! asked last, the likeliest first, and no further than the first yes.
//!
//! **Half-spaces** have one normal and no end: every triangle is looked at, and the lowest corners count. Cost: linear
//! in the ground.

mod against;
mod answer;
mod axes;
mod ball;
mod behind;
mod closer;
mod facet;
mod gap;
mod groups;
mod meeting;
mod outstanding;
mod over;
mod overlooked;
mod plane;
mod prism;
mod protrusion;
mod refused;
mod rim;
mod round;
mod side;
mod standing;
mod unsaid;
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
use refused::AllRefused;
use round::Round;
use standing::{Octets, Place, Standing};
pub(super) use standing::{doubt_of, span_of};
use unsaid::AllUnsaid;
use whole::touching;

/// Triangles whose yes or no waits until all have been seen.
const MOST_UNCLEAR: usize = 32;

/// Whether a body and ground overlap if they are within the margin; their manifolds go where they are wanted. Nothing
/// where neither is ground; grounds have no contacts with each other.
pub(crate) fn contact_on_ground(
    pair: &Pair3,
    margin: f32,
    manifolds: &mut impl Room,
) -> Option<Option<bool>> {
    contact_by(pair, margin, manifolds, false)
}

/// The same, by the short ways or without them.
#[inline]
fn contact_by(pair: &Pair3, margin: f32, manifolds: &mut impl Room, is_plain: bool) -> Option<Option<bool>> {
    let on = OnGround::of(pair)?;
    if on.body.is_ground() {
        return Some(None);
    }
    let poses = if on.is_b { [&pair.pose_a, &pair.pose_b] } else { [&pair.pose_b, &pair.pose_a] };
    let asking = Asking { on: &on, poses, margin: margin.max(0.0), reach: reach_of(margin), is_plain };
    let mut found: Option<bool> = None;
    for_parts(on.body, &on.body_basis, |part| {
        if let Some(overlapping) = asking.contact_of(part, found == Some(true), manifolds) {
            found = Some(found.unwrap_or(false) || overlapping);
        }
        found == Some(true) && !manifolds.is_wanted()
    });
    Some(found)
}

/// What is asked of a body on ground.
struct Asking<'a> {
    on: &'a OnGround<'a>,
    /// The body's and the ground's.
    poses: [&'a Pose3; 2],
    margin: f32,
    /// The widest gap in which a point is wanted, in metres.
    reach: f64,
    /// By the general way alone: what the short ways are held against.
    is_plain: bool,
}

/// What is known of a part so far.
struct Known {
    groups: Groups,
    /// Settled beyond rounding.
    overlapping: bool,
    /// The triangle that showed it first.
    shown_by: Option<u32>,
    /// Triangles that f64 could not tell of.
    unclear: ArrayVec<Unclear, MOST_UNCLEAR>,
    /// Triangles that are seen from behind, across a gap.
    behind: AllBehind,
    /// Triangles whose axis was refused.
    refused: AllRefused,
    /// Triangles in a gap whose axis was refused.
    unsaid: AllUnsaid,
    incident: Option<Incident>,
    /// Bounds on how near triangles can be that spoke by their own normals.
    levels: Levels,
}

/// A triangle of which f64 cannot tell whether the part shares a point with it.
#[derive(Clone, Copy)]
struct Unclear {
    /// Whether any point was made of it.
    has_points: bool,
    separation: f64,
    number: u32,
}

/// A part among the triangles.
struct Seen<'s> {
    asking: &'s Asking<'s>,
    standing: &'s Standing<'s>,
    meeting: Meeting<'s>,
    /// The part's box, grown by the reach.
    bounds: Aabb3,
    is_ball: bool,
}

impl<'a> Asking<'a> {
    /// Whether a part overlaps, if it is within the margin. Once it is known that another part does, its own yes or no
    /// is of no interest.
    fn contact_of(&self, part: Part<'a>, is_overlap_known: bool, manifolds: &mut impl Room) -> Option<bool> {
        if let (Shape3::Sphere(sphere), false) = (part.shape, self.is_plain) {
            let round = Round::new(self.on, &part, sphere.radius().into(), self.reach);
            if let Some(found) = round.contact(self, part, is_overlap_known, manifolds) {
                return found;
            }
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
        let seen = Seen { asking: self, standing: &standing, meeting, bounds, is_ball };
        let mut known = Known::new([standing.slack, standing.even]);
        let is_yes_enough = !manifolds.is_wanted();
        if let Shape3::HalfSpace(half_space) = part.shape {
            seen.look_at_all(place.axes.turn(half_space.unit_normal()), is_yes_enough, &mut known);
        } else {
            let mut plane = None;
            let _ = self.on.ground.read_near(&bounds, |near| {
                seen.look_at(near, &mut plane, &mut known);
                if known.overlapping && is_yes_enough {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            });
        }
        seen.look_at_behind(&mut known);
        seen.add_refused(&mut known);
        if manifolds.is_wanted() {
            seen.add_whole(&mut known);
        }
        seen.conclude(&mut known, is_overlap_known);
        seen.bound_least(&mut known, manifolds.is_wanted());
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
            refused: ArrayVec::new_const(),
            unsaid: ArrayVec::new_const(),
            incident: None,
            levels: Levels::new(),
        }
    }
}

impl Seen<'_> {
    /// Looks at one triangle; `plane` is that of the one before.
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

    /// The face that the part turns to a normal.
    #[inline(always)]
    fn incident_to(&self, normal: DVec3, known: &mut Known) -> Incident {
        match known.incident {
            Some(incident) if incident.is_for(normal) => incident,
            _ => *known.incident.insert(Incident::of(self.standing, normal)),
        }
    }

    /// Adds points by a triangle's own normal. Where it is seen from behind, or from in front by what is behind its
    /// plane, deep ones only if part and triangle meet: what lies over a bend may be behind the plane of a triangle,
    /// and nowhere near the triangle itself.
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

    /// Keeps a triangle that f64 cannot tell of for later, or asks at once where there is no room.
    fn leave_unclear(&self, number: u32, (has_points, separation): (bool, f64), known: &mut Known) {
        if known.overlapping {
            return;
        }
        if let Err(full) = known.unclear.try_push(Unclear { has_points, separation, number }) {
            let Unclear { number, .. } = full.element();
            if self.meeting.overlaps(self.asking.on.ground, number) {
                known.settle(number);
            }
        }
    }

    /// Settles what was left open, and that overlap and points go together.
    fn conclude(&self, known: &mut Known, is_overlap_known: bool) {
        let slack = self.standing.slack;
        if !(known.overlapping || is_overlap_known && known.groups.least() >= -slack) {
            // What made points first, of that the deepest.
            known.unclear.sort_unstable_by(|a, b| {
                let by_depth = a.separation.total_cmp(&b.separation);
                b.has_points.cmp(&a.has_points).then(by_depth).then(a.number.cmp(&b.number))
            });
            let mut numbers = known.unclear.iter().map(|unclear| unclear.number);
            match numbers.find(|&number| self.meeting.overlaps(self.asking.on.ground, number)) {
                Some(number) => known.settle(number),
                None => known.groups.keep_within(-slack),
            }
        }
        if known.groups.least() > slack
            && let Some(number) = known.shown_by
        {
            self.add_last(number, known);
        }
        self.say(known);
    }

    /// What is deepest over a triangle that the part overlaps, where every point was cut away: over its sides, where the
    /// part's lowest point is beside it. Where rounding leaves none of those, that point.
    #[cold]
    #[inline(never)]
    fn add_last(&self, number: u32, known: &mut Known) {
        let (ground, standing, reach) = (self.asking.on.ground, self.standing, self.asking.reach);
        if let Shape3::HalfSpace(half_space) = standing.part.shape {
            return self.add_lowest_corner(number, standing.place.axes.turn(half_space.unit_normal()), known);
        }
        let Some(facet) = Facet::seen(ground, number, standing.center) else { return };
        let extent = standing.extent(facet.normal, facet.origin());
        let doubt = self.doubt_over(&facet);
        let prism = Prism { ground, standing, facet: &facet, extent: &extent, reach, doubt, gate: None };
        let base = prism.base();
        if !prism.is_lowest_over() {
            let prism = Prism { reach: touching(), ..prism };
            (0..3).for_each(|edge| prism.add_deepest_over(edge, &base, &mut known.groups));
        }
        if known.groups.least() <= standing.slack {
            return self.add_whole(known);
        }
        let mut pin = prism.lowest();
        pin.on_ground = nearest_to(&facet, pin.on_ground).1;
        known.groups.add(&base, pin);
    }

    /// What a height over a triangle may be off by, in metres.
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
