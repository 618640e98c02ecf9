//! Bullets: bodies so fast that they would be beyond a wall before anybody asked whether they touch it.
//!
//! Before an update the world is told where a fast body is about to be (`set_motion`). Of a bullet it answers with
//! what is hit, and when. In the step that follows the bullet goes no further than that; it arrives with all its speed
//! and within everybody's margin, so the next update has an ordinary contact, which stops or bounces it. What is left
//! of the step in which it arrives is lost, as in Box2D's continuous collision (Catto, "Continuous Collision", Game
//! Developers Conference 2013).

use crate::stepper::Body;
use asunder::glam::DVec3;

/// A bullet that is turned aside flies blind for the rest of a step: so far at most, as a share of its reach.
const BLIND: f64 = 0.25;

/// What a bullet is expected to do in the next step.
pub(super) struct Flight {
    pub(super) number: usize,
    moved: DVec3,
    turned: DVec3,
    /// How much of it may be done.
    share: f64,
    /// How far what is hit goes on by itself in the rest of the step: the bullet goes along.
    carried: DVec3,
    /// Whether a contact that is there already bends it.
    is_held: bool,
}

/// The flights of the next step, by the bullets' numbers, ascending.
#[derive(Default)]
pub(super) struct Flights(Vec<Flight>);

impl Flights {
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// A bullet sets off; bullets are told of by their numbers, ascending.
    pub(super) fn push(&mut self, number: usize, moved: DVec3, turned: DVec3) {
        let (share, carried, is_held) = (1.0, DVec3::ZERO, false);
        self.0.push(Flight { number, moved, turned, share, carried, is_held });
    }

    /// A bullet hits something after a share of its flight, which itself moves so far in a step.
    pub(super) fn note(&mut self, number: usize, (share, along): (f64, DVec3), is_contact: bool) {
        if let Ok(index) = self.0.binary_search_by_key(&number, |flight| flight.number) {
            let flight = &mut self.0[index];
            if is_contact {
                flight.is_held = true;
            } else if share < flight.share {
                (flight.share, flight.carried) = (share, along * (1.0 - share));
            }
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Flight> {
        self.0.iter()
    }
}

impl Flight {
    /// How much of what the solver says a bullet does.
    pub(super) fn limited(&self, body: &Body) -> (DVec3, DVec3) {
        let (moved, turned) = (body.moved, body.turned);
        let aside = moved - self.moved;
        let blind = BLIND * body.mass.reach;
        if aside.dot(aside) > blind * blind || self.is_held {
            let (way, most) = (moved.length(), blind.min(blind * self.share.max(BLIND)));
            return (if way > most { moved * (most / way) } else { moved }, turned);
        }
        if self.share < 1.0 {
            return (self.moved * self.share + self.carried, self.turned * self.share);
        }
        (moved, turned)
    }
}
