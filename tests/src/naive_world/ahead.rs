//! What this frame's motions may bring, from the poses at some moments of them.

use super::{BAND, Record, Slots, Tenant, margin_of, record_of};
use crate::engine::slot_of;
use crate::judged::{Judged, Question, Stand, Word, gap_of_boxes};
use asunder::World;
use glam::DVec3;
use std::collections::BTreeMap;

/// Number of pieces into which a motion is cut.
const MOMENTS: u32 = 16;

/// In metres. Interpolated rotations are rounded to f32, which moves a point three metres away by 4e-7; and casts stop
/// within some 1e-6 of their sizes.
const LOOSE: f64 = 1e-5;

/// How much wider than the plain AABB a world's may be, in metres: corners are rounded outwards to f32, in a room of a
/// few metres.
const ROUNDED_OUT: f64 = 1e-5;

/// Moving bodies at every moment, and pairs of which one moves.
pub(super) struct Ahead<S: Judged> {
    paths: BTreeMap<u32, Vec<Stand<S>>>,
    seen: BTreeMap<Slots, Seen>,
}

/// Separations of a pair over time.
struct Seen {
    start: Word,
    /// Separations at the moments after the start, up to what matters; lower bounds beyond that.
    separations: Vec<f64>,
    is_one_sided: bool,
}

impl<S: Judged> Ahead<S> {
    pub(super) fn of(bodies: &BTreeMap<u32, Tenant<S>>) -> Self {
        let going = bodies.iter().filter_map(|(slot, tenant)| Some((slot, tenant, tenant.motion?)));
        let path = |(&slot, tenant, motion): (&u32, &Tenant<S>, S::Motion)| {
            let from = S::pose_of(&tenant.body);
            let pose = |moment| S::pose_in(&motion, &from, f64::from(moment) / f64::from(MOMENTS));
            (slot, (1..=MOMENTS).map(|moment| tenant.stand.at(&pose(moment))).collect())
        };
        Self { paths: going.map(path).collect(), seen: BTreeMap::new() }
    }

    /// Whether the AABBs around two bodies overlap, swept over their motions and grown by their margins; `None` where
    /// the world may decide, which makes its boxes slightly wider.
    pub(super) fn boxes_overlap(&self, slots: Slots, [a, b]: [&Tenant<S>; 2]) -> Option<bool> {
        let margin = margin_of([a, b]);
        let boxes = [self.corners(slots.0, a), self.corners(slots.1, b)];
        let gap = gap_of_boxes(boxes[0], boxes[1]);
        if self.is_still(slots) {
            let said = S::boxes_overlap(&a.body, &b.body);
            assert!(said || gap > margin - ROUNDED_OUT, "a box that does not hold its body");
            return Some(said);
        }
        let wider = |tenant: &Tenant<S>| {
            // The box of a turning body contains all that it may sweep; that of ground may be its local box, rotated.
            let loose =
                if S::parts(S::shape_of(&tenant.body)).len() > 1 { 2.0 * tenant.stand.reach() } else { 0.0 };
            loose + turned_by(tenant) + ROUNDED_OUT
        };
        match gap {
            _ if gap < margin - ROUNDED_OUT => Some(true),
            _ if gap > margin + wider(a) + wider(b) => Some(false),
            _ => None,
        }
    }

    /// Records a pair's separations at every moment, if it moves.
    pub(super) fn look(&mut self, slots: Slots, [a, b]: [&Tenant<S>; 2], start: Word) {
        if self.is_still(slots) {
            return;
        }
        let question = Question { within: margin_of([a, b]) + LOOSE, has_sides: false };
        let moments = 0..MOMENTS as usize;
        let separations = moments
            .map(|moment| self.at(slots.0, a, moment).meet(self.at(slots.1, b, moment), question).separation)
            .collect();
        let is_one_sided = a.stand.is_one_sided() || b.stand.is_one_sided();
        self.seen.insert(slots, Seen { start, separations, is_one_sided });
    }

    /// The contact that the motions of two bodies beyond their margins may bring, unless only impacts of one are wanted.
    pub(super) fn to_come(
        &self,
        world: &World<S>,
        slots: Slots,
        [a, b]: [&Tenant<S>; 2],
        word: Word,
    ) -> Option<Record<S>> {
        let record = Record { speculative: true, ..record_of([a, b], word) };
        let is_left_out = record.sensor || a.body.is_impacts_only() || b.body.is_impacts_only();
        let seen = self.seen.get(&slots).filter(|_| !is_left_out)?;
        let (margin, is_told) = (margin_of([a, b]), S::contact(world, a.key, b.key).is_some());
        let comes = seen.separations.iter().any(|&separation| separation <= margin - LOOSE);
        let travel = |tenant: &Tenant<S>| tenant.motion.as_ref().map_or(DVec3::ZERO, S::displacement);
        let most = (travel(a) - travel(b)).length() + turned_by(a) + turned_by(b);
        let may_come = word.separation <= margin + most + BAND;
        // One-sided ground has no contact with what is behind it at the start, though a body may come round.
        let must_come = comes && !seen.is_one_sided && !word.is_doubtful;
        // Further away than the oracle has been asked about so far.
        let exactly = || a.stand.meet(&b.stand, Question { within: f64::INFINITY, has_sides: true });
        (must_come || may_come && is_told).then(|| Record { word: exactly(), ..record })
    }

    /// Asserts that impacts are those that the moments show, for pairs that may meet; returns their number.
    pub(super) fn check_impacts(&self, world: &World<S>, bodies: &BTreeMap<u32, Tenant<S>>) -> usize {
        let hits: Vec<_> = S::impacts(world)
            .iter()
            .map(|hit| {
                let (fraction, error) = S::fraction_and_error(&hit.impact);
                (slot_of(hit.bullet), fraction, slot_of(hit.other), hit.sensor, error)
            })
            .collect();
        for pair in hits.windows(2) {
            let order = (pair[0].0.cmp(&pair[1].0)).then(pair[0].1.total_cmp(&pair[1].1));
            assert!(order.then(pair[0].2.cmp(&pair[1].2)).is_lt(), "by bullet, time and slot: {hits:?}");
            assert!(pair[0].0 != pair[1].0 || pair[0].3, "nothing after what is solid: {hits:?}");
        }
        for &(bullet, fraction, other, sensor, error) in &hits {
            let seen = &self.seen[&(bullet.min(other), bullet.max(other))];
            let [a, b] = [bullet, other].map(|slot| &bodies[&slot]);
            // A body of several parts may still hit others than those it touches.
            let is_apart = !seen.start.overlapping || seen.start.is_doubtful;
            let has_more = [a, b].iter().any(|tenant| S::parts(S::shape_of(&tenant.body)).len() > 1);
            assert!(a.body.is_bullet() && (is_apart || has_more));
            assert_eq!(sensor, a.body.is_sensor() || b.body.is_sensor());
            let [one, two] = [a, b].map(|tenant| {
                let pose = S::pose_of(&tenant.body);
                tenant.stand.at(&tenant.motion.map_or(pose, |motion| S::pose_in(&motion, &pose, fraction)))
            });
            let off = one.meet(&two, Question { within: 1.0, has_sides: false }).separation;
            assert!(off <= error + LOOSE, "{off} m apart at an impact of {:?} and {:?}", a.body, b.body);
            let before = seen.separations.iter().zip(1..).filter(|(_, k)| moment(*k) < fraction);
            let is_clear = off >= -LOOSE && before.clone().all(|(&separation, _)| separation >= -LOOSE);
            assert!(
                seen.is_one_sided || !is_apart || is_clear || self.is_led_over(bodies, bullet, other),
                "passed through before {:?} and {:?}",
                a.body,
                b.body
            );
        }
        for (&(a, b), seen) in self.seen.iter().filter(|(_, seen)| !seen.start.is_doubtful) {
            for (bullet, other) in
                [(a, b), (b, a)].into_iter().filter(|(slot, _)| bodies[slot].body.is_bullet())
            {
                let Some(time) = seen.first_touch([&bodies[&bullet], &bodies[&other]]) else { continue };
                if self.is_led_over(bodies, bullet, other) {
                    continue;
                }
                let is_told = |hit: &&(u32, f64, u32, bool, f64)| {
                    hit.0 == bullet && hit.1 <= time && (hit.2 == other || !hit.3)
                };
                assert!(hits.iter().any(|hit| is_told(&hit)), "{bullet} passes {other} at {time}: {hits:?}");
            }
        }
        hits.len()
    }

    /// Whether a bullet may pass over another body that is level with what it touches, as over the next tile of a
    /// floor: it touches a third, solid body, and goes into the other by no more than half of its thickness.
    fn is_led_over(&self, bodies: &BTreeMap<u32, Tenant<S>>, bullet: u32, other: u32) -> bool {
        let is_solid = |slot: &u32| !bodies[slot].body.is_sensor();
        let stands_on = |(&(a, b), seen): (&Slots, &Seen)| {
            let third = if a == bullet { b } else { a };
            let touches = seen.start.overlapping || seen.start.is_doubtful;
            (a == bullet || b == bullet) && third != other && touches && is_solid(&third)
        };
        let seen = &self.seen[&(bullet.min(other), bullet.max(other))];
        let most = 0.5 * bodies[&bullet].stand.reach() + LOOSE;
        is_solid(&bullet)
            && is_solid(&other)
            // Pairs of which neither moves were not recorded.
            && (bodies[&bullet].motion.is_none() || self.seen.iter().any(stands_on))
            && seen.separations.iter().all(|&separation| separation >= -most)
    }

    fn is_still(&self, (a, b): Slots) -> bool {
        !self.paths.contains_key(&a) && !self.paths.contains_key(&b)
    }

    fn at<'a>(&'a self, slot: u32, tenant: &'a Tenant<S>, moment: usize) -> &'a Stand<S> {
        self.paths.get(&slot).map_or(&tenant.stand, |path| &path[moment])
    }

    fn corners(&self, slot: u32, tenant: &Tenant<S>) -> [DVec3; 2] {
        let path = self.paths.get(&slot).into_iter().flatten();
        path.map(Stand::corners)
            .fold(tenant.stand.corners(), |all, one| [all[0].min(one[0]), all[1].max(one[1])])
    }
}

impl Seen {
    /// The latest time by which two bodies that were apart at the start must have met; the first is a bullet.
    fn first_touch<S: Judged>(&self, [bullet, other]: [&Tenant<S>; 2]) -> Option<f64> {
        if self.start.overlapping {
            return None;
        }
        if self.is_one_sided {
            // The side from which it is passed counts, whichever the moments happen to show: the pair's own query
            // decides.
            let still = S::shift(0.0);
            let motions = [bullet, other].map(|tenant| tenant.motion.as_ref().unwrap_or(&still));
            let touch = S::first_touch((&bullet.body, motions[0]), (&other.body, motions[1]));
            return touch.filter(|(_, overlapping, _)| !overlapping).map(|(fraction, ..)| fraction);
        }
        let first = self.separations.iter().zip(1..).find(|(separation, _)| **separation < -LOOSE);
        first.map(|(_, number)| moment(number))
    }
}

/// The fraction of a motion at a moment.
fn moment(number: u32) -> f64 {
    f64::from(number) / f64::from(MOMENTS)
}

/// An upper bound of how far a rotation may move any point of a body in a world's estimate. A world knows only the top
/// speed of a rotation, which is four thirds of the angle or, in the plane, up to half more; the angle is at most pi /
/// 2 of the chord; and no point moves further than the diameter.
fn turned_by<S: Judged>(tenant: &Tenant<S>) -> f64 {
    let chord = tenant.motion.map_or(0.0, |motion| S::chord(&motion, &S::pose_of(&tenant.body)));
    // Instead of the reach it knows the centre's distance and the radius around the centre.
    if chord > 0.0 { (2.4 * chord).min(2.0) * 3.0 * tenant.stand.reach() } else { 0.0 }
}
