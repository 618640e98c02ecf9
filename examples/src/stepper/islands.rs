//! Sleeping: bodies that touch one another fall asleep together and wake together.
//!
//! An island is a set of bodies that pushes can move, connected by contacts; scenery connects nothing (Catto,
//! "Simulation islands", box2d.org, 2023). This is the plain form: a union-find over each step's contacts (Tarjan,
//! 1975), with the least number as root, so that nothing depends on the order of visits.

use core::mem::take;

/// A body may sleep when no point of it moves faster than this, in m/s.
const CALM: f64 = 0.05;
/// An island sleeps when all of it has been calm for this many seconds.
const CALM_FOR: f64 = 0.5;

/// The islands of all bodies, by their numbers.
#[derive(Default)]
pub(super) struct Islands {
    /// Those that pushes can move, ascending.
    pub(super) awake: Vec<usize>,
    /// Ascending.
    pub(super) asleep: Vec<usize>,
    /// For each body a body of its island with a lower number, or itself; for a sleeping body, the root.
    parents: Vec<usize>,
    /// For how many seconds each body has been calm; for a root, while islands are joined, the least of its island.
    calm: Vec<f64>,
}

impl Islands {
    /// Adds a body, which is awake if pushes can move it.
    pub(super) fn add(&mut self, is_free: bool) {
        let number = self.parents.len();
        self.parents.push(number);
        self.calm.push(0.0);
        self.awake.extend(is_free.then_some(number));
    }

    /// Notes how fast an awake body is; [`Self::disturb`] and [`Self::join`] come after.
    pub(super) fn note(&mut self, body: usize, speed_squared: f64, seconds: f64) {
        self.calm[body] = if speed_squared < CALM * CALM { self.calm[body] + seconds } else { 0.0 };
        self.parents[body] = body;
    }

    /// The body touches something that never rests.
    pub(super) fn disturb(&mut self, body: usize) {
        self.calm[body] = 0.0;
    }

    /// Two awake bodies touch.
    pub(super) fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        let (low, high) = (one.min(other), one.max(other));
        self.parents[high] = low;
        self.calm[low] = self.calm[low].min(self.calm[high]);
    }

    /// Sends calm islands to sleep, and returns their bodies.
    pub(super) fn settle(&mut self) -> Vec<usize> {
        let (calm, restless): (Vec<usize>, _) = take(&mut self.awake).into_iter().partition(|&body| {
            // Flattened: `wake` takes the root of a sleeping body from here.
            self.parents[body] = self.root(body);
            self.calm[self.parents[body]] >= CALM_FOR
        });
        self.awake = restless;
        self.asleep.extend(&calm);
        self.asleep.sort_unstable();
        calm
    }

    /// Wakes the islands of the given sleeping bodies, and returns all bodies of those islands.
    pub(super) fn wake(&mut self, bodies: &[usize]) -> Vec<usize> {
        let mut roots: Vec<usize> = bodies.iter().map(|&body| self.parents[body]).collect();
        roots.sort_unstable();
        let (woken, asleep): (Vec<usize>, _) = take(&mut self.asleep)
            .into_iter()
            .partition(|&body| roots.binary_search(&self.parents[body]).is_ok());
        woken.iter().for_each(|&body| self.calm[body] = 0.0);
        self.asleep = asleep;
        self.awake.extend(&woken);
        self.awake.sort_unstable();
        woken
    }

    fn root(&mut self, body: usize) -> usize {
        let mut at = body;
        while self.parents[at] != at {
            self.parents[at] = self.parents[self.parents[at]];
            at = self.parents[at];
        }
        at
    }
}

#[cfg(test)]
mod tests;
