//! Steps along a motion, each certified: how long the gap between two parts certainly lasts.
//!
//! A step aims at a little more than the poses that are reported may be off. Two that turn and start nearer may move away,
//! and do not end any nearer: if an axis beside that of the first look shows that they part (`parting`), they go on
//! from where they have; else they take small steps, and are stopped where they started once they have come nearer, or
//! once the steps run out.

use super::{Course, Look, ROUNDED, Touching};
use crate::counted::count_step;

/// Rounds after which a cast gives up and reports an impact with the gap that is left. Shapes that graze take some 25
/// rounds, others 1 to 10.
const MAX_ROUNDS: usize = 96;

/// Rounds after which axes that turn along with a body are tried as well. Beside the face of a body that turns, a fixed
/// axis shows only as much of the gap as the far corner of that face leaves: shapes that part slowly get a twentieth
/// more a round, and 96 rounds are not enough to get away from a gap of 0.1 mm. The face's own normal shows all of the
/// gap.
const PATIENT: usize = 12;

/// Tries for one round's step of shapes that turn.
const MAX_TRIES: usize = 20;

/// Share of their gap that a step leaves at least to two that are nearer than the aim: the less, the sooner those that
/// turn away get away.
const LEFT: f64 = 1.0 / 16.0;

/// Share of the gap that a step may leave unused, for shapes that turn.
const UNUSED: f64 = 0.03;

/// The longest step within `rest` that certainly leaves something, or one that leaves little of the `over` that there
/// is.
///
/// Regula falsi, the Illinois variant: the value at the end that stays counts half.
fn longest_step((over, rest): (f64, f64), left: impl Fn(f64) -> f64) -> f64 {
    let ([mut low, mut high], mut at_low) = ([0.0, rest], over);
    let mut at_high = left(rest);
    if at_high >= 0.0 {
        return rest;
    }
    let mut found = 0.0;
    for _ in 0..MAX_TRIES {
        let try_at = (low + (high - low) * (at_low / (at_low - at_high))).clamp(low, high);
        let sure = left(try_at);
        if sure < 0.0 {
            (high, at_high, at_low) = (try_at, sure, at_low * 0.5);
            continue;
        }
        found = try_at;
        if sure <= UNUSED * over {
            break;
        }
        (low, at_low, at_high) = (try_at, sure, at_high * 0.5);
    }
    found
}

impl Course<'_> {
    /// Where they first touch, by steps.
    pub(super) fn by_steps(&self) -> Option<Touching> {
        let mut now = self.times[0];
        let mut axis = self.towards_b(now);
        // As long as two that turn are as near as counts as met since time zero: how, and how near, they were then.
        let mut start: Option<(Touching, f64)> = None;
        for round in 1..=MAX_ROUNDS {
            count_step();
            let look = self.look(now, axis);
            if now <= 0.0 && look.as_ref().is_none_or(|look| look.least <= self.slack) {
                self.doubts_start.set(true);
            }
            let Some(look) = look else {
                let touching = self.too_close(now, axis);
                let beside = self.sharpest(touching.axis, now).0;
                if now <= 0.0
                    && let Some(away) = self.turns_apart(beside)
                {
                    (now, axis) = (away, beside);
                    start = Some((touching, f64::NEG_INFINITY));
                    continue;
                }
                let is_parting = now <= 0.0 && self.parts(touching.axis, ROUNDED);
                return (!is_parting).then_some(touching);
            };
            let is_near = look.least <= self.aim || look.most <= self.enough;
            let look = if now <= 0.0 && is_near { self.sharpened(look, now) } else { look };
            axis = look.axis;
            let rest = self.times[1] - now;
            let gives_up = round == MAX_ROUNDS;
            if self.is_over(&look, now, rest) || gives_up && self.circles_pass(&look, now) {
                return None;
            }
            if now <= 0.0
                && is_near
                && let Some(away) = self.turns_apart(axis)
            {
                start = Some((self.settled(&look, now), look.least));
                now = away;
                continue;
            }
            start = match start {
                _ if !is_near => None,
                Some((start, level)) if look.least < level - 4.0 * self.precision.projection() => {
                    return Some(start);
                }
                None if now <= 0.0 && self.is_turning() && look.least > 0.0 => {
                    Some((self.settled(&look, now), look.least))
                }
                start => start,
            };
            if is_near && start.is_none() || gives_up {
                return Some(start.map_or_else(|| self.settled(&look, now), |(start, _)| start));
            }
            // Those that start nearer than the aim may come nearer yet for a while, if only they do not stay so.
            let aim = if look.least > self.aim { self.aim } else { look.least * LEFT };
            let step = self.step((&look, aim), now, rest);
            let step =
                if round > PATIENT { self.turned_step((&look, aim), now, rest).max(step) } else { step };
            let next = (now + step).min(self.times[1]);
            if next <= now {
                return Some(start.map_or_else(|| self.settled(&look, now), |(start, _)| start));
            }
            now = next;
        }
        None
    }

    /// Whether a look shows that they do not touch any more.
    fn is_over(&self, look: &Look, now: f64, rest: f64) -> bool {
        // Shapes that count as touching, and move apart, get no nearer than they are.
        let is_parting =
            look.least > -self.slack - 16.0 * self.precision.projection() && self.parts(look.axis, 0.0);
        is_parting || look.least > self.slack && self.keeps_apart(look, now, rest)
    }

    /// Whether the axis of a look shows a gap for all the time that is left.
    fn keeps_apart(&self, look: &Look, now: f64, rest: f64) -> bool {
        if self.bend == 0.0 && self.pace == 0.0 {
            let closing = self.closing(look.axis);
            return closing <= 0.0 || look.least - self.slack > closing * rest;
        }
        self.certain(look, now, rest) > self.slack
    }

    /// The gap that is certain along the axis of a look, from then until some time later.
    fn certain(&self, look: &Look, now: f64, later: f64) -> f64 {
        let then = self.gap(look.axis, (now + later).min(self.times[1]));
        look.least.min(then) - self.bend * later * later * 0.125 * (1.0 + 1e-9)
    }

    /// For how long the axis of a look, which shows more than the gap aimed at, goes on to do so.
    fn step(&self, (look, aim): (&Look, f64), now: f64, rest: f64) -> f64 {
        let over = look.least - aim;
        let closing = self.closing(look.axis);
        if self.bend == 0.0 && self.pace == 0.0 {
            // The gap closes, or they would be apart for good.
            return over / closing;
        }
        let found = longest_step((over, rest), |later| self.certain(look, now, later) - aim);
        // A step that is safe however fast the points turn, and whichever way.
        found.max(over / (closing.max(0.0) + self.pace)).min(rest)
    }

    /// The same for an axis that turns along with either body.
    fn turned_step(&self, (look, aim): (&Look, f64), now: f64, rest: f64) -> f64 {
        let over = look.least - aim;
        let step =
            |which| longest_step((over, rest), |later| self.certain_along(which, look, now, later) - aim);
        self.carriers().map(step).fold(0.0, f64::max)
    }

    /// The gap that is certain from then until some time later, along the axis of a look that turns along with a body.
    fn certain_along(&self, which: usize, look: &Look, now: f64, later: f64) -> f64 {
        let then = (now + later).min(self.times[1]);
        let lost = 2.0 * self.stretch.spins[which].rounding * self.around();
        let gap = look.least.min(self.gap(self.carried(which, look.axis, [now, then]), then));
        gap - self.bend_along(which) * later * later * 0.125 * (1.0 + 1e-9) - lost
    }
}
