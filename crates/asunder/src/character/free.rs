//! Moves a shape out of the solids that it overlaps.

use super::{Freed, Gap, Linear, Walks};
use crate::collider::Collider;
use crate::query::{Enter, Filter, Met, bodies_along_ray, bodies_over, visit_bodies_in};
use crate::space::Space;
use crate::world::{World, slot_of};
use asunder_narrow::ArrayVec;
use core::cmp::Ordering;
use core::ops::ControlFlow;

/// How often the shape is pushed before it counts as wedged.
const ROUNDS: usize = 16;

/// How often one round goes through its planes.
const SWEEPS: usize = 32;

/// From how many times the way out of the deepest plane alone a way out counts as long, and a shorter one is searched
/// for. Out of a floor and a wall at once it is at most the square root of two.
const LONG: f64 = 1.5;

/// How many places are tried along one direction. The first is as far away as any way out must lead, and each is
/// further than the one before by [`GROWTH`]: up to four times as far, so that no shape is taken through thicker walls.
const TRIES: usize = 7;
const GROWTH: f64 = 1.25;

/// How often the interval between the last two places is halved.
const HALVINGS: usize = 4;

/// How many places between the two sides of a press are tried, each in the middle of what is left.
const EASINGS: usize = 6;

/// Most manifolds in one round: the nearest, or deepest.
const MOST_NEAR: usize = 16;

/// A manifold with a body nearby, as a plane: the shape may go no further towards it than its gap.
pub(super) struct Near<S: Walks> {
    pub(super) body: S::Key,
    /// The manifold's number among the body's.
    order: usize,
    pub(super) plane: Gap<S::Point>,
}

impl<S: Walks> Near<S> {
    /// Orders planes: the nearer or deeper first, then by the normal. Only equal planes go by slots, and for them the
    /// order does not change the way out.
    pub(super) fn rank(&self, other: &Self) -> Ordering {
        let of_body = |near: &Self| (slot_of(near.body), near.order);
        let by_gap = self.plane.gap.total_cmp(&other.plane.gap);
        by_gap
            .then_with(|| self.plane.away.rank(other.plane.away))
            .then_with(|| of_body(self).cmp(&of_body(other)))
    }

    /// Whether the same body has a plane already that leads much the same way, less than 45 degrees off.
    fn is_among(&self, near: &[Self]) -> bool {
        let leads_so =
            |known: &Self| known.plane.away.dot(self.plane.away) > core::f64::consts::FRAC_1_SQRT_2;
        near.iter().any(|known| known.body == self.body && leads_so(known))
    }
}

/// A shape and where it is.
pub(super) type At<'a, S> = (&'a <S as Space>::Shape, &'a <S as Space>::Pose);

/// A request to free a shape: the world, the shape, its pose, the gap to reach in metres, and which bodies count.
pub(super) struct Freeing<'a, S: Walks> {
    pub(super) world: &'a World<S>,
    pub(super) shape: &'a S::Shape,
    pub(super) start: &'a S::Pose,
    pub(super) target: f64,
    pub(super) filter: &'a Filter<'a, S>,
}

impl<S: Walks> Freeing<'_, S> {
    /// Moves the shape until it keeps the target gap to all that it overlapped.
    ///
    /// ```text
    /// repeat
    ///   find the planes of all manifolds nearby
    ///   nothing overlaps: done
    ///   push out of the deepest plane alone; if that frees the shape: done, by the shortest way out of that plane
    ///   push out of all planes at once
    ///   where ground holds that, since a centre would go through, and none of its planes leads the way of its side:
    ///     push out of the ground's own plane there, alone if that frees the shape: done; else with all others   (Hold)
    /// after sixteen rounds: the best place so far, halfway between what presses the shape there   (eased)
    /// ```
    /// The deepest plane comes first, since among tiles of a floor it is the only one that matters: the sides of
    /// neighbouring tiles, which the shape overlaps a little, would push it sideways. No push takes a part's centre
    /// through ground, or from outside of all bodies into a fixed one.
    pub(super) fn by_pushes(&self) -> Freed<S::Pose, S::Point> {
        self.by_rounds().0
    }

    /// The same; and where pushes do not free the shape, or by a long way, the shortest straight way out along the
    /// planes' normals and in directions all around. Not for characters: one that is crushed between a floor and
    /// something that comes down on it would be thrown out sideways.
    pub(super) fn all_around(&self) -> Freed<S::Pose, S::Point> {
        let (freed, least) = self.by_rounds();
        let most = if freed.is_free { freed.moved.length() } else { f64::INFINITY };
        if most <= least * LONG {
            return freed;
        }
        self.straight(least, most).unwrap_or(freed)
    }

    fn found(&self, pose: S::Pose, is_free: bool) -> Freed<S::Pose, S::Point> {
        let moved = S::position(&pose) - S::position(self.start);
        Freed { pose, moved, is_free }
    }

    fn overlaps(&self, pose: &S::Pose) -> bool {
        is_overlapping(self.world, (self.shape, pose), self.filter)
    }

    fn near(&self, pose: &S::Pose) -> ArrayVec<Near<S>, MOST_NEAR> {
        near(self.world, (self.shape, pose), self.target, self.filter)
    }

    /// Frees by pushes; and a lower bound on the length of any way out.
    fn by_rounds(&self) -> (Freed<S::Pose, S::Point>, f64) {
        let mut pose = *self.start;
        let (mut best, mut least) = ((f64::NEG_INFINITY, pose), 0.0);
        for round in 0..=ROUNDS {
            let mut near = self.near(&pose);
            let Some(deepest) = deepest::<S>(&near).filter(|deepest| deepest.gap <= 0.0) else {
                return (self.found(pose, !self.overlaps(&pose)), least);
            };
            if deepest.gap > best.0 {
                best = (deepest.gap, pose);
            }
            if round == 0 {
                least = self.target - deepest.gap;
            }
            if round == ROUNDS {
                break;
            }
            // In a gap too narrow for the target on both sides, a smaller gap has to do.
            let target = if round < ROUNDS / 2 { self.target } else { self.target / 16.0 };
            let way = deepest.away * (target - deepest.gap);
            let alone = S::moved(&pose, way).filter(|moved| !self.overlaps(moved));
            if let Some(moved) = alone.filter(|_| self.share_before_solids(&pose, way, target) >= 1.0) {
                return (self.found(moved, true), least);
            }
            let mut way = push::<S>(&near, target);
            let mut hold = self.hold(&pose, way, target);
            if let Some(plane) = self.plane_of(&hold, &pose).filter(|plane| !plane.is_among(&near)) {
                let out = plane.plane.away * (target - plane.plane.gap);
                let alone = S::moved(&pose, out).filter(|moved| !self.overlaps(moved));
                if let Some(moved) = alone.filter(|_| self.share_before_solids(&pose, out, target) >= 1.0) {
                    return (self.found(moved, true), least);
                }
                if near.try_push(plane).is_ok() {
                    way = push::<S>(&near, target);
                    hold = self.hold(&pose, way, target);
                }
            }
            match S::moved(&pose, way * hold.share) {
                Some(pushed) => pose = pushed,
                None => break,
            }
        }
        let eased = self.eased(best);
        (self.found(eased, !self.overlaps(&eased)), least)
    }

    /// Of a wedged shape: from the best place so far on, out of the plane in which it is deepest there, up to where it
    /// is as deep in what that leads it into. Pushes alone go from one side of a press to the other and back, so that
    /// the best of their places is all in one: a lift rose through a character that a ceiling held, up to its centre,
    /// and past it in the next frame.
    fn eased(&self, (gap, from): (f64, S::Pose)) -> S::Pose {
        let near = self.near(&from);
        let Some(out) = deepest::<S>(&near) else { return from };
        let (mut best, mut less, mut more) = ((gap, from), 0.0, -gap);
        for _ in 0..EASINGS {
            let middle = 0.5 * (less + more);
            let way = out.away * middle;
            let way = way * self.share_before_solids(&from, way, self.target);
            let Some(pose) = S::moved(&from, way) else { break };
            let near = self.near(&pose);
            let Some(next) = deepest::<S>(&near) else { return pose };
            if next.gap > best.0 {
                best = (next.gap, pose);
            }
            if next.away.dot(out.away) > 0.0 {
                less = middle;
            } else {
                more = middle;
            }
        }
        best.1
    }

    /// The shortest straight way out that is found, between `least` and `most` metres long.
    fn straight(&self, least: f64, most: f64) -> Option<Freed<S::Pose, S::Point>> {
        let (mut best, mut most) = (None, most);
        let mut look = |away: S::Point| {
            if let Some((way, pose)) = self.first_free(away, least, most) {
                (best, most) = (Some(self.found(pose, true)), way);
            }
        };
        let near = self.near(self.start);
        near.iter().filter(|near| near.plane.gap <= 0.0).for_each(|near| look(near.plane.away));
        S::all_around(look);
        best
    }

    /// Nearly the shortest way along a direction that frees the shape, between `least` and `most` metres long.
    fn first_free(&self, away: S::Point, least: f64, most: f64) -> Option<(f64, S::Pose)> {
        let place = |way: f64| S::moved(self.start, away * way).filter(|pose| !self.overlaps(pose));
        let (mut blocked, mut way) = (least, least);
        for _ in 0..TRIES {
            if way >= most {
                break;
            }
            if let Some(pose) = place(way) {
                let mut free = (way, pose);
                for _ in 0..if way > least { HALVINGS } else { 0 } {
                    let middle = 0.5 * (blocked + free.0);
                    match place(middle) {
                        Some(pose) => free = (middle, pose),
                        None => blocked = middle,
                    }
                }
                // With the target gap, if there is room.
                let clear = free.0 + self.target;
                free = place(clear).map_or(free, |pose| (clear, pose));
                let is_open = self.share_before_solids(self.start, away * free.0, self.target) >= 1.0;
                return is_open.then_some(free);
            }
            (blocked, way) = (way, way * GROWTH);
        }
        None
    }

    /// Which share of a way is allowed: see [`Freeing::hold`].
    fn share_before_solids(&self, from: &S::Pose, way: S::Point, before: f64) -> f64 {
        self.hold(from, way, before).share
    }

    /// What holds the shape on a way: nothing, unless the centre of one of the shape's convex parts would go
    /// 1. through ground, from a side that is solid. Beyond it the part would not count as overlapping that ground, and
    ///    a shape pressed against it would count as free there;
    /// 2. from outside of all bodies into a fixed one. A press would push a character out below a thin floor otherwise.
    ///    A centre that starts inside a body may go anywhere: it may have to leave a wall made of many blocks. One that
    ///    was outside before the first push may not, even if a push has taken it into a press since.
    ///
    /// Centres stop `before` metres short of where they would enter. Until 2026-11-27 they went a share of the
    /// remaining way: after sixteen rounds nothing was left between centre and ground, and the next push started behind
    /// it.
    fn hold(&self, from: &S::Pose, way: S::Point, before: f64) -> Hold<S> {
        let Self { world, shape, filter, .. } = *self;
        let before = before / way.length();
        let mut hold = Hold { share: 1.0, ground: None };
        S::middles((shape, from), |middle| {
            let Some(ray) = S::ray(middle, way) else { return };
            let (mut first, mut surface) = (f64::INFINITY, None);
            let (mut fixed, mut is_outside) = (f64::INFINITY, true);
            // What is just beyond the end of the way counts, too, so that the gap is kept there.
            let _ = bodies_along_ray(world, &ray, 1.0 + before, filter).visit(|hit| {
                let Some(body) = world.bodies.get(hit.body) else { return ControlFlow::Continue(()) };
                if S::is_ground(&body.shape) {
                    let through = if hit.inside {
                        S::first_through(&ray, 1.0 + before, body)
                    } else {
                        Some(hit.distance)
                    };
                    let is_first = |at: &f64| match at.total_cmp(&first) {
                        Ordering::Equal => surface.is_some_and(|known| Self::is_ranked_before(&hit, &known)),
                        order => order.is_lt(),
                    };
                    if let Some(at) = through.filter(is_first) {
                        (first, surface) = (at, (!hit.inside).then_some(hit));
                    }
                } else if hit.inside {
                    is_outside = false;
                } else if body.fixed {
                    fixed = fixed.min(hit.distance);
                }
                ControlFlow::Continue(())
            });
            let began_at = middle - (S::position(from) - S::position(self.start));
            let counts = fixed < first && (is_outside || self.is_outside(began_at));
            let (at, ground) = if counts { (fixed, None) } else { (first, surface) };
            let share = (at - before).max(0.0);
            if share < hold.share {
                hold = Hold { share, ground };
            }
        });
        hold
    }

    /// Whether of two grounds that a ray meets at the same place this one counts: bodies come in no promised order.
    fn is_ranked_before(hit: &Enter<S>, known: &Enter<S>) -> bool {
        S::wide(hit.normal).rank(S::wide(known.normal)).is_lt()
    }

    /// The plane of the ground that holds the shape, at the side on which the part's centre is: out of that, it may
    /// always be pushed. Ground often ends near the shape then, and its rim gives the direction of the manifold.
    fn plane_of(&self, hold: &Hold<S>, from: &S::Pose) -> Option<Near<S>> {
        let hit = hold.ground?;
        let away = S::wide(hit.normal).unit()?;
        let height = away.dot(S::position(from) - hit.point);
        let gap = height - S::reach((self.shape, from), -away)?;
        let (body, order) = (hit.body, usize::MAX);
        gap.is_finite().then_some(Near {
            body,
            order,
            plane: Gap { away, gap, point: hit.point, part: hit.part },
        })
    }

    /// Whether a point is outside of all bodies but ground.
    fn is_outside(&self, point: S::Point) -> bool {
        let Some((shape, pose)) = S::point(point) else { return true };
        let found = bodies_over(self.world, (&shape, &pose), self.filter).visit(|Met(key)| {
            let is_solid = self.world.bodies.get(key).is_some_and(|body| !S::is_ground(&body.shape));
            if is_solid { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        found.is_continue()
    }
}

/// How far a shape may go, and what holds it there.
struct Hold<S: Walks> {
    /// The share of the way that is allowed.
    share: f64,
    /// The ground that the centre of a part would go through then.
    ground: Option<Enter<S>>,
}

/// The plane in which the shape is deepest, or to which it is nearest.
fn deepest<S: Walks>(near: &[Near<S>]) -> Option<&Gap<S::Point>> {
    let planes = near.iter().map(|near| &near.plane);
    planes.reduce(|best, next| if next.gap < best.gap { next } else { best })
}

/// Nearly the shortest way to a gap of `target` metres to all planes; a compromise where there is none.
///
/// In acute corners the sweeps end before they converge: then the gap is right for the last plane, and smaller for the
/// others.
pub(super) fn push<S: Walks>(near: &[Near<S>], target: f64) -> S::Point {
    let (mut way, mut pushes) = (S::Point::ZERO, [0.0; MOST_NEAR]);
    for _ in 0..SWEEPS {
        let mut most = 0.0_f64;
        for (Near { plane, .. }, pushed) in near.iter().zip(&mut pushes) {
            let lacks = target - plane.gap - plane.away.dot(way);
            // A push may be taken back when other planes have made it unnecessary: this makes the way the shortest.
            let change = lacks.max(-*pushed);
            *pushed += change;
            way = way + plane.away * change;
            most = most.max(change.abs());
        }
        if most <= target * 1e-3 {
            break;
        }
    }
    way
}

/// All manifolds within a margin, or the nearest of them, sorted by their bodies' slots.
pub(super) fn near<S: Walks>(
    world: &World<S>,
    at: At<'_, S>,
    margin: f64,
    filter: &Filter<'_, S>,
) -> ArrayVec<Near<S>, MOST_NEAR> {
    let margin = margin as f32;
    let mut found = ArrayVec::<Near<S>, MOST_NEAR>::new();
    let _ = visit_bodies_in((world, filter), &S::bounds(at.0, at.1, margin), |key, body| {
        let mut order = 0;
        S::gaps(at, body, margin, |plane| {
            let next = Near { body: key, order, plane };
            order += 1;
            if found.is_full() {
                // Bodies come in no promised order: which of them stay must not depend on it.
                let furthest = found.iter_mut().max_by(|a, b| a.rank(b));
                if let Some(furthest) = furthest.filter(|furthest| next.rank(furthest).is_lt()) {
                    *furthest = next;
                }
            } else {
                found.push(next);
            }
        });
        ControlFlow::Continue(())
    });
    found.sort_unstable_by_key(|near| (slot_of(near.body), near.order));
    found
}

/// Whether the shape overlaps anything that counts; one-sided ground counts from its front alone. Exact.
pub(super) fn is_overlapping<S: Walks>(world: &World<S>, at: At<'_, S>, filter: &Filter<'_, S>) -> bool {
    is_any(world, at, filter, |body| S::overlaps_front(at, body))
}

/// The same at the end of a way made of casts. One-sided bodies are left out: the shape may have passed them from
/// behind, and is in front of them only now.
pub(super) fn has_entered<S: Walks>(world: &World<S>, at: At<'_, S>, filter: &Filter<'_, S>) -> bool {
    is_any(world, at, filter, |body| !S::has_one_side(body) && S::overlaps(at, body))
}

fn is_any<S: Walks>(
    world: &World<S>,
    at: At<'_, S>,
    filter: &Filter<'_, S>,
    ask: impl Fn(&Collider<S>) -> bool,
) -> bool {
    let look =
        |_, body: &Collider<S>| if ask(body) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    visit_bodies_in((world, filter), &S::bounds(at.0, at.1, 0.0), look).is_break()
}
