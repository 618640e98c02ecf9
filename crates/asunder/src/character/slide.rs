//! Moves a character and turns its way along obstacles.

use super::clip::along;
use super::free::{Freeing, Near, has_entered, is_overlapping, near, push};
use super::gait::Gait;
use super::{Freed, Gap, Linear, Obstacle, Slide, Walk, Walks};
use crate::query::{Asked, Enter, Filter, Meet, bodies_along, bodies_along_ray, parts_along};
use crate::space::Space;
use crate::world::{World, slot_of};
use asunder_geometry::tolerance::{EDGE_HOLD, GRAZING, MAX_POSITION, SKIN_SLACK, STANDSTILL, UPRIGHT};
use asunder_narrow::ArrayVec;
use core::ops::ControlFlow;

/// Most casts in one call, and so the most walls to slide along one after the other.
const SLIDES: usize = 6;

/// Sine of the angle between a ceiling and the ground up to which the ceiling does not count as a wall for a walking
/// character.
const LEAST_ASIDE: f64 = 1.0 / 16.0;

/// The planes met so far, or the walls; an overhang makes one wall for each ground.
type Planes<S> = ArrayVec<<S as Asked>::Point, { SLIDES * SLIDES }>;

/// How far beyond its way a cast looks, in skins, so that it sees whatever the shape would come closer to than its
/// skin.
const OUTLOOK: f64 = 5.0;

pub(crate) type Slid<S> =
    Slide<<S as Space>::Key, <S as Space>::Pose, <S as Asked>::Vector, <S as Asked>::Point>;

type Noted<S> = Obstacle<<S as Space>::Key, <S as Asked>::Vector, <S as Asked>::Point>;

/// An obstacle on the way.
struct Hit<S: Walks> {
    body: S::Key,
    parts: (u32, u32),
    /// Away from the body.
    normal: S::Point,
    point: S::Point,
    /// Metres until they touch.
    at: f64,
    /// Cosine between the way and the normal's opposite: how fast the gap closes.
    approach: f64,
}

impl<S: Walks> Hit<S> {
    /// From the result of a cast along a unit direction, `length` metres long.
    fn of(hit: &Meet<S>, unit: S::Point, length: f64) -> Self {
        let mut normal = -S::wide(hit.normal);
        if -unit.dot(normal) < GRAZING {
            normal = (normal - unit * (unit.dot(normal) + GRAZING)).unit().unwrap_or(-unit);
        }
        let (parts, at) = ((hit.part, hit.part_of_moved), hit.fraction * length);
        Self { body: hit.body, parts, normal, point: hit.point, at, approach: -unit.dot(normal) }
    }

    /// How far the shape can go and keep a gap, as if the body were a plane.
    fn until(&self, gap: f64) -> f64 {
        (self.at - gap / self.approach).max(0.0)
    }

    fn note(&self) -> Noted<S> {
        let Self { body, parts: (part, _), point, .. } = *self;
        Obstacle { body, normal: S::narrow(self.normal), point, part }
    }
}

/// A plane that the way must not go into.
struct Bound<S: Walks> {
    body: S::Key,
    parts: (u32, u32),
    normal: S::Point,
    /// The level part of the normal, if the plane is too steep to walk on, so that the way does not lead up it either.
    wall: Option<S::Point>,
    /// Whether a character can walk on it.
    is_ground: bool,
    /// Whether a character can stand on it: ground, and edges of steps.
    holds: bool,
}

/// A shape as it moves.
struct Mover<'w, S: Walks> {
    world: &'w World<S>,
    shape: &'w S::Shape,
    filter: Filter<'w, S>,
    gait: Gait<S::Point>,
    pose: S::Pose,
}

/// Moves a character by casts, and turns what is left of its way along whatever it meets.
///
/// ```text
/// free the shape, or move it back to its skin's distance
/// if it stands, begin along what it stands on                   (Mover::bound_below)
/// repeat                                                        at most SLIDES times
///   turn the rest of the way along all planes met               (Mover::way)
///   cast; move until the skin is reached                        (Mover::go)
///   a wall, met from the ground: try to climb it as a step      (Mover::climb)
/// look for ground below, and move down to it if the character walked on ground before;
///   where a steep body is met first, look for ground beside it  (Mover::land)
/// ```
pub(crate) fn move_and_slide<S: Walks>(
    world: &World<S>,
    (shape, start): (&S::Shape, &S::Pose),
    displacement: S::Vector,
    walk: &Walk<S::Vector>,
    filter: &Filter<'_, S>,
) -> Slid<S> {
    let gait = Gait::of::<S>(walk, shape, start);
    let mut mover = Mover { world, shape, filter: filter.solid().with_touched(), gait, pose: *start };
    let mut slid = Slide {
        pose: *start,
        moved: S::Point::ZERO,
        ground: None,
        walls: ArrayVec::new(),
        blocked: false,
        is_free: true,
    };
    if S::size(shape).is_finite() {
        let displacement = within_reach(S::wide(displacement));
        let free = mover.keep_away(displacement, &mut slid);
        if slid.is_free {
            mover.slide(displacement, &mut slid);
            // The cast proves its path free, but the pose is rounded: a shape that passes an edge by less than that may
            // touch it.
            if has_entered(world, (shape, &mover.pose), &mover.filter) {
                mover.pose = free;
                slid.blocked = true;
                slid.ground = slid.ground.and_then(|_| mover.land(0.0)).map(|hit| hit.note());
            }
        }
    } else {
        slid.is_free = !is_overlapping(world, (shape, start), &mover.filter);
        slid.blocked = true;
    }
    slid.pose = mover.pose;
    slid.moved = S::position(&mover.pose) - S::position(start);
    slid
}

/// A displacement shortened to what f32 can hold with room to spare; zero if it is not finite.
fn within_reach<P: Linear>(displacement: P) -> P {
    let (length, most) = (displacement.length(), 4.0 * MAX_POSITION);
    if !length.is_finite() {
        P::ZERO
    } else if length > most {
        displacement * (most / length)
    } else {
        displacement
    }
}

impl<S: Walks> Mover<'_, S> {
    /// Frees the shape from solids that it overlaps, or moves it away from those closer than its skin. Returns the
    /// first pose at which it was free.
    ///
    /// A character that stands a skin from a wall and moves towards it by less than that meets nothing on the way: it is
    /// only moved away again here, at the next call. So such a wall is noted among the walls here.
    fn keep_away(&mut self, displacement: S::Point, slid: &mut Slid<S>) -> S::Pose {
        let skin = self.gait.skin;
        let mut near = near(self.world, (self.shape, &self.pose), skin, &self.filter);
        let least = near.iter().fold(f64::INFINITY, |least, near| least.min(near.plane.gap));
        if least <= 0.0 {
            let (world, shape, start, filter) = (self.world, self.shape, &self.pose, &self.filter);
            let Freed { pose, is_free, .. } =
                Freeing { world, shape, start, target: skin, filter }.by_pushes();
            self.pose = pose;
            slid.is_free = is_free;
            slid.blocked = !is_free;
            return pose;
        }
        let start = self.pose;
        let is_close = |near: &&Near<S>| near.plane.gap < skin * (1.0 - SKIN_SLACK);
        if near.iter().any(|near| is_close(&near)) {
            // Sorted by geometry, so that the result does not depend on slots; the furthest last, since `push` is exact
            // for the last plane: a way that leads, by however little, into something a skin away would be blocked at
            // once.
            near.sort_unstable_by(Near::rank);
            self.go(push::<S>(&near, skin));
        }
        for Near { body, plane, .. } in near.iter().filter(is_close) {
            let Gap { away, point, part, .. } = *plane;
            let is_upright = (-UPRIGHT..EDGE_HOLD).contains(&away.dot(self.gait.up));
            if is_upright && displacement.dot(away) < -STANDSTILL * displacement.length() {
                note::<S>(slid, Obstacle { body: *body, normal: S::narrow(away), point, part });
            }
        }
        start
    }

    fn slide(&mut self, displacement: S::Point, slid: &mut Slid<S>) {
        let length = displacement.length();
        let is_rising = displacement.dot(self.gait.up) > STANDSTILL * length;
        let ground = if is_rising { None } else { self.land(0.0) };
        let was_on_ground = ground.is_some();
        let mut may_climb = was_on_ground && self.gait.step > 0.0;
        let mut left = displacement;
        // A standing character goes along the ground from the start: a way that leads down a little would meet the
        // ground too late to keep the skin.
        let mut bounds: ArrayVec<Bound<S>, SLIDES> = ground.iter().map(|hit| self.bound_below(hit)).collect();
        for _ in 0..SLIDES {
            let way = self.way(left, &bounds);
            if left.length() <= STANDSTILL * length || way.length() <= STANDSTILL * length {
                break;
            }
            let (share, hit) = self.go(way);
            left = left * (1.0 - share);
            let Some(hit) = hit else {
                left = S::Point::ZERO;
                break;
            };
            let mut bound = self.bound(&hit);
            // An edge does not hold a character that rises, or would fall beside it.
            bound.holds &= bound.is_ground || (!is_rising && self.land(0.0).is_some());
            let climb = bound.wall.is_some() && may_climb;
            if climb && let Some(share) = self.climb(self.gait.level(way * (1.0 - share))) {
                left = left * (1.0 - share);
                may_climb = false;
                bounds.clear();
                continue;
            }
            // Round feet may be held by an edge that they cannot climb.
            if climb || !bound.holds {
                note::<S>(slid, hit.note());
            }
            let same = |old: &Bound<S>| (old.body, old.parts) == (bound.body, bound.parts);
            bounds.retain(|old| !same(old));
            // There are no more bounds than casts.
            let _ = bounds.try_push(bound);
        }
        slid.blocked = !slid.walls.is_empty() && left.length() > STANDSTILL * length;
        let reach = if was_on_ground { self.gait.snap } else { 0.0 };
        slid.ground = if is_rising { None } else { self.land(reach).map(|hit| hit.note()) };
    }

    /// The rest of the displacement, turned along the planes met so far.
    ///
    /// - A bound that holds cancels the downward part: nothing slides off ground that can be walked on.
    /// - A plane that is too steep is a wall when walked into, and a slope when falling.
    /// - On ground the speed is the same uphill, downhill and on the level.
    /// - An overhang is a wall for a character that does not rise. If the way were turned along other walls first, and
    ///   only then along the overhang and what is below, it could lead back to where it came from, or up where a slope
    ///   and the overhang meet.
    /// - No way leads back: where only such ways are left, as in acute corners, the move ends. This is Quake's rule,
    ///   without which characters tremble there.
    fn way(&self, left: S::Point, bounds: &[Bound<S>]) -> S::Point {
        let Gait { up, .. } = self.gait;
        let mut rise = left.dot(up);
        let holds = bounds.iter().any(|bound| bound.holds);
        if holds {
            rise = rise.max(0.0);
        }
        let mut walls: Planes<S> = bounds.iter().filter_map(|bound| bound.wall).collect();
        // A level way may rise by rounding, which does not count.
        let is_rising = rise > STANDSTILL * left.length();
        if !is_rising {
            self.add_walls_over(bounds, &mut walls);
        }
        let level = along(self.gait.level(left), &walls, S::crease);
        let mut way = level + up * rise;
        let ground = bounds.iter().rev().find(|bound| bound.is_ground);
        if let (Some(ground), true) = (ground, !is_rising) {
            let on_ground = level - up * (level.dot(ground.normal) / up.dot(ground.normal));
            if let Some(unit) = on_ground.unit() {
                way = unit * level.length();
            }
        }
        let planes: Planes<S> = bounds.iter().map(|bound| bound.normal).collect();
        let way = along(way, &planes, S::crease);
        // A bound that holds has cancelled the fall. A falling character may slide back down a slope that it runs at.
        let wish = if holds && !is_rising { self.gait.level(left) } else { left };
        let does_lead_on = way.dot(wish) > 0.0 || way.dot(up) * rise.min(0.0) > 0.0;
        if does_lead_on { way } else { S::Point::ZERO }
    }

    /// Adds overhangs as walls for a walking character: for each ground that was met, or the level if there is none,
    /// the direction along the ground that leads away from the overhang. A ceiling almost parallel to the ground is
    /// left out, since that direction would be noise.
    fn add_walls_over(&self, bounds: &[Bound<S>], walls: &mut Planes<S>) {
        let up = self.gait.up;
        let is_over = |bound: &&Bound<S>| bound.normal.dot(up) <= -UPRIGHT;
        let grounds = || bounds.iter().filter(|bound| bound.is_ground).map(|bound| bound.normal);
        for over in bounds.iter().filter(is_over) {
            let level = grounds().next().is_none().then_some(up);
            for floor in grounds().chain(level) {
                let aside = over.normal - floor * (over.normal.dot(up) / floor.dot(up));
                if let (Some(wall), true) = (aside.unit(), aside.length() > LEAST_ASIDE) {
                    // There is at most one for each two planes.
                    let _ = walls.try_push(wall);
                }
            }
        }
    }

    /// Moves until something is in the way. Returns which share of the way was covered, and the obstacle if that was
    /// not all.
    fn go(&mut self, way: S::Point) -> (f64, Option<Hit<S>>) {
        let length = way.length();
        let Some((unit, hit)) = self.look(way, length) else { return (1.0, None) };
        let free = hit.as_ref().map_or(length, |hit| hit.until(self.gait.skin).min(length));
        if let Some(pose) = S::moved(&self.pose, unit * free) {
            self.pose = pose;
        }
        if free < length { (free / length, hit) } else { (1.0, None) }
    }

    /// The first obstacle within some metres along a direction, or a little more. The direction is rounded to f32, and
    /// returned, too.
    fn look(&self, direction: S::Point, metres: f64) -> Option<(S::Point, Option<Hit<S>>)> {
        self.look_on(direction, metres + OUTLOOK * self.gait.skin)
    }

    /// The first obstacle within some metres below, or a little more.
    ///
    /// A surface that holds may be as steep as the edge of a step, and is met that far ahead when it is a skin away.
    fn look_down(&self, metres: f64) -> Option<(S::Point, Option<Hit<S>>)> {
        self.look_on(-self.gait.up, metres + self.outlook_down())
    }

    fn outlook_down(&self) -> f64 {
        self.gait.skin / self.gait.steepest.min(EDGE_HOLD)
    }

    /// The first obstacle within some metres.
    fn look_on(&self, direction: S::Point, metres: f64) -> Option<(S::Point, Option<Hit<S>>)> {
        let cast = S::narrow(direction.unit()? * metres);
        let length = S::wide(cast).length();
        let unit = S::wide(cast).unit()?;
        let hit = bodies_along(self.world, (self.shape, &self.pose), cast, &self.filter).first();
        Some((unit, hit.map(|hit| Hit::of(&hit, unit, length))))
    }

    fn bound(&self, hit: &Hit<S>) -> Bound<S> {
        let rise = hit.normal.dot(self.gait.up);
        let is_ground = rise >= self.gait.steepest;
        let is_wall = !is_ground && rise > -UPRIGHT;
        let wall = if is_wall { self.gait.level(hit.normal).unit() } else { None };
        Bound {
            body: hit.body,
            parts: hit.parts,
            normal: hit.normal,
            wall,
            is_ground,
            holds: self.holds(hit),
        }
    }

    /// The bound that carries a standing character: the plane of a face, along which it moves up and down; on an edge,
    /// a level plane, so that it goes no further down.
    fn bound_below(&self, hit: &Hit<S>) -> Bound<S> {
        let Gait { up, skin, .. } = self.gait;
        let bound = self.bound(hit);
        let body = self.world.bodies.get(hit.body).filter(|_| bound.is_ground);
        let enter = |body| S::enter(&S::ray(hit.point + up * skin, -up * (2.0 * skin))?, 1.0, hit.body, body);
        let is_face = body
            .and_then(enter)
            .is_some_and(|found| !found.inside && S::wide(found.normal).dot(hit.normal) >= 1.0 - STANDSTILL);
        if is_face { bound } else { Bound { normal: up, is_ground: false, wall: None, holds: true, ..bound } }
    }

    /// Whether a character can stand on an obstacle that it met: on ground, and on an edge no higher than a step,
    /// behind which there is ground.
    ///
    /// The normal at an edge depends on where round feet happen to touch it. So there, the surface just behind the edge
    /// decides, of whichever body.
    fn holds(&self, hit: &Hit<S>) -> bool {
        let Gait { up, skin, steepest, step, .. } = self.gait;
        let rise = hit.normal.dot(up);
        if rise >= steepest {
            return true;
        }
        let Some(inwards) = self.gait.level(-hit.normal).unit() else { return false };
        let Some(depth) = S::reach((self.shape, &self.pose), -up) else { return false };
        let height = (hit.point - S::position(&self.pose)).dot(up) + depth;
        // Two skins: one by which it stands above the ground, and one by which it would stand above the step.
        if step <= 0.0 || rise < EDGE_HOLD || height > step + 2.0 * skin {
            return false;
        }
        let above = hit.point + (inwards + up * 2.0) * skin;
        let found = S::ray(above, -up * (4.0 * skin)).and_then(|ray| self.first_entered(&ray));
        found.is_some_and(|found| !found.inside && S::wide(found.normal).dot(up) >= steepest)
    }

    /// The first body that a ray enters, within its own length. By a visitor, so that it works within a query without
    /// memory of its own.
    fn first_entered(&self, ray: &S::Ray) -> Option<Enter<S>> {
        let mut first: Option<Enter<S>> = None;
        let rank = |entered: &Enter<S>| (!entered.inside, entered.distance, slot_of(entered.body));
        let _ = bodies_along_ray(self.world, ray, 1.0, &self.filter).visit(|entered| {
            if first.as_ref().is_none_or(|known| rank(&entered) < rank(known)) {
                first = Some(entered);
            }
            ControlFlow::Continue(())
        });
        first
    }

    /// Climbs a step: up, forward, and down to where it can stand. Returns which share of the way was covered; if
    /// climbing fails, nothing has moved.
    fn climb(&mut self, way: S::Point) -> Option<f64> {
        let before = self.pose;
        let climbed = self.try_climb(way);
        if climbed.is_none() {
            self.pose = before;
        }
        climbed
    }

    fn try_climb(&mut self, way: S::Point) -> Option<f64> {
        let Gait { up, skin, step, .. } = self.gait;
        let (unit, length) = (way.unit()?, way.length());
        let from = S::position(&self.pose);
        let foot = from.dot(up) - S::reach((self.shape, &self.pose), -up)?;
        self.go(up * step);
        let rise = (S::position(&self.pose) - from).dot(up);
        // The step is a skin away: after a shorter move the shape is still in front of it.
        self.go(unit * length.max(2.0 * skin));
        let advance = (S::position(&self.pose) - from).dot(unit);
        if advance <= skin {
            return None;
        }
        let (down, hit) = self.look_down(rise)?;
        let hit = hit.filter(|hit| self.holds_below(hit, down, rise))?;
        // Round feet would climb more than they are lifted; and feet are a skin above the ground.
        if hit.point.dot(up) - foot > step - skin * 0.5 {
            return None;
        }
        self.pose = S::moved(&self.pose, down * hit.until(skin).min(rise))?;
        Some((advance / length).min(1.0))
    }

    /// Whether the character could stand on an obstacle below, once it is down there.
    fn holds_below(&self, hit: &Hit<S>, down: S::Point, reach: f64) -> bool {
        let fall = hit.until(self.gait.skin);
        let Some(pose) = S::moved(&self.pose, down * fall) else { return false };
        let there = Mover { pose, gait: Gait { ..self.gait }, ..*self };
        fall <= reach.max(self.gait.skin) && there.holds(hit)
    }

    /// Finds the ground within reach below, and moves down to it. Ground up to a skin further down counts as stood on,
    /// too.
    fn land(&mut self, reach: f64) -> Option<Hit<S>> {
        let (down, hit) = self.look_down(reach)?;
        let hit = hit?;
        if !self.holds_below(&hit, down, reach) {
            return self.ground_beside();
        }
        self.pose = S::moved(&self.pose, down * hit.until(self.gait.skin).min(reach))?;
        Some(hit)
    }

    /// The ground that the character stands on, where a cast down meets something steep beside it first, of the same
    /// body or another.
    fn ground_beside(&self) -> Option<Hit<S>> {
        let cast = S::narrow(-self.gait.up * self.outlook_down());
        let (length, unit) = (S::wide(cast).length(), S::wide(cast).unit()?);
        let hit_of = |met: &Meet<S>| Hit::of(met, unit, length);
        let counts = |met: &Meet<S>| self.holds_below(&hit_of(met), unit, 0.0);
        let met = parts_along(self.world, (self.shape, &self.pose), cast, &self.filter, &counts).first();
        met.as_ref().map(hit_of)
    }
}

/// Notes a wall, once.
fn note<S: Walks>(slid: &mut Slid<S>, wall: Noted<S>) {
    let normal = S::wide(wall.normal);
    let is_same =
        |known: &Noted<S>| known.body == wall.body && S::wide(known.normal).dot(normal) >= 1.0 - STANDSTILL;
    if !slid.walls.iter().any(is_same) {
        // More than eight are not reported.
        let _ = slid.walls.try_push(wall);
    }
}
