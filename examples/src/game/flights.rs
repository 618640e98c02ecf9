//! Bullets: bodies so fast that they would be past a wall before any update sees them touch it.
//!
//! Before an update the game tells the world where a fast body is about to be (`set_motion`). For a bullet, the world
//! answers with what it will hit, and when. In the next step the bullet goes no further than that. It arrives at full
//! speed and within both margins, so the following update has an ordinary contact, which stops or bounces it. The rest
//! of the step in which it arrives is lost, as in Box2D's continuous collision (Catto, "Continuous Collision", Game
//! Developers Conference 2013).

use crate::stepper::Body;
use asunder::glam::DVec3;

/// The most that a bullet may move in a step once the solver has deflected it from the predicted path, for which alone
/// impacts are known; as a share of its reach.
const BLIND: f64 = 0.25;

/// The predicted motion of a bullet in the next step.
pub(super) struct Flight {
    pub(super) number: usize,
    moved: DVec3,
    turned: DVec3,
    /// The share of the motion that it may make.
    share: f64,
    /// How far the body that it hits moves in the rest of the step: the bullet is carried along.
    carried: DVec3,
    /// Whether it already has a contact, which will deflect it.
    is_held: bool,
}

/// The flights of the next step, by the bullets' numbers, ascending.
#[derive(Default)]
pub(super) struct Flights(Vec<Flight>);

impl Flights {
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds a bullet; they must be added by ascending number.
    pub(super) fn push(&mut self, number: usize, moved: DVec3, turned: DVec3) {
        let (share, carried, is_held) = (1.0, DVec3::ZERO, false);
        self.0.push(Flight { number, moved, turned, share, carried, is_held });
    }

    /// Notes a hit: after which share of the bullet's motion, and how far the body that is hit moves in a whole step.
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
    /// The part of the solver's motion that the bullet may make.
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
