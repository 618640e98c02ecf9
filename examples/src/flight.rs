//! Bullets: bodies so fast that they would be beyond a wall before anybody asked whether they touch it.
//!
//! Before an update the world is told where a fast body is about to be (`set_motion`). Of a bullet it answers with
//! what is hit, and when. In the step that follows the bullet goes no further than that; it arrives with all its speed
//! and within everybody's margin, so the next update has an ordinary contact, which stops or bounces it. What is left
//! of the step in which it arrives is lost, as in Box2D's continuous collision (Catto, "Continuous Collision", Game
//! Developers Conference 2013).

use crate::game::Body;
use crate::physics::{Linear, Physics};

/// A bullet that is turned aside flies blind for the rest of a step: so far at most, as a share of its reach.
const BLIND: f64 = 0.25;

/// What a bullet is expected to do in the next step.
struct Flight<S: Physics> {
    number: u32,
    moved: S::Vector,
    turned: S::Spin,
    /// How much of it may be done.
    share: f64,
    /// How far what is hit goes on by itself in the rest of the step: the bullet goes along.
    carried: S::Vector,
    /// Whether a contact that is there already bends it.
    is_held: bool,
}

/// The flights of the next step, by the bullets' numbers, ascending.
pub(crate) struct Flights<S: Physics>(Vec<Flight<S>>);

impl<S: Physics> Flights<S> {
    pub(crate) const NONE: Self = Self(Vec::new());

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// A bullet sets off; bullets are told of by their numbers, ascending.
    pub(crate) fn push(&mut self, number: u32, moved: S::Vector, turned: S::Spin) {
        self.0.push(Flight {
            number,
            moved,
            turned,
            share: 1.0,
            carried: S::Vector::default(),
            is_held: false,
        });
    }

    /// A bullet hits something after a share of its flight, which itself moves so far in a step.
    pub(crate) fn note(&mut self, number: u32, (share, along): (f64, S::Vector), is_contact: bool) {
        if let Ok(index) = self.0.binary_search_by_key(&number, |flight| flight.number) {
            let flight = &mut self.0[index];
            if is_contact {
                flight.is_held = true;
            } else if share < flight.share {
                (flight.share, flight.carried) = (share, along * (1.0 - share));
            }
        }
    }

    /// How much of what the response says a body does.
    pub(crate) fn limit(
        &self,
        body: &Body<S>,
        number: u32,
        moved: S::Vector,
        turned: S::Spin,
    ) -> (S::Vector, S::Spin) {
        if !body.is_bullet {
            return (moved, turned);
        }
        let Ok(index) = self.0.binary_search_by_key(&number, |flight| flight.number) else {
            return (moved, turned);
        };
        let flight = &self.0[index];
        let aside = moved - flight.moved;
        let blind = BLIND * body.matter.reach;
        if aside.dot(aside) > blind * blind || flight.is_held {
            let (way, most) = (moved.length(), blind.min(blind * flight.share.max(BLIND)));
            return (if way > most { moved * (most / way) } else { moved }, turned);
        }
        if flight.share < 1.0 {
            return (flight.moved * flight.share + flight.carried, flight.turned * flight.share);
        }
        (moved, turned)
    }
}
