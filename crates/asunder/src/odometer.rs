//! How far bodies have moved, so that pairs far enough apart can be skipped without reading either body.
//!
//! ```text
//! two bodies are further apart than their margins, by at least `beyond`, when the sum of their paths is s
//! since then they have come nearer by no more than the sum of their paths has grown
//! while that sum is less than s + beyond, they are still apart, whatever their paths
//! ```
//! So bodies that rest a few millimetres from each other, and tremble, go through the narrow phase once in thousands of
//! frames; a body that passes by at a distance, as seldom as the distance allows. It takes one number a body and one a
//! pair, and no pose is read.

/// How far a body has moved since it last changed otherwise, in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Odometer {
    /// Infinite from a change until the next update, so that all its pairs go through the narrow phase.
    travel: f64,
    /// The part of it since the last update.
    step: f64,
}

impl Odometer {
    /// Of a body that is new, or has changed.
    pub(crate) const CHANGED: Self = Self { travel: f64::INFINITY, step: f64::INFINITY };

    /// One that continues from saved numbers; `None` if no odometer can show them.
    #[cfg(feature = "serde")]
    pub(crate) fn restored(travel: f64, step: f64) -> Option<Self> {
        let is_sound = travel.is_finite() && travel >= 0.0 && (0.0..=travel).contains(&step);
        is_sound.then_some(Self { travel, step })
    }

    /// Both numbers, to be saved; `None` while it counts as changed.
    #[cfg(feature = "serde")]
    pub(crate) fn saved(self) -> Option<(f64, f64)> {
        self.travel.is_finite().then_some((self.travel, self.step))
    }

    /// Whether the body has changed since the last update other than by moving.
    #[inline]
    pub(crate) fn has_changed(self) -> bool {
        !self.travel.is_finite()
    }

    /// Adds a movement.
    #[inline]
    pub(crate) fn go(&mut self, metres: f64) {
        // Rounded up, so that many small steps never add up to too little.
        self.travel = (self.travel + metres).next_up();
        self.step = (self.step + metres).next_up().min(self.travel);
    }

    /// Ends an update, in which all its pairs were processed.
    #[inline]
    pub(crate) fn close(&mut self) {
        *self = Self { travel: self.counted(), step: 0.0 };
    }

    /// How far it has moved since the last update.
    #[inline]
    pub(crate) fn step(self) -> f64 {
        self.step
    }

    /// What it will count from when this update is over.
    #[inline]
    fn counted(self) -> f64 {
        if self.travel.is_finite() { self.travel } else { 0.0 }
    }

    /// The sum of both bodies' paths up to which they stay apart, if they are now `beyond` metres further apart than
    /// their margins.
    #[inline]
    pub(crate) fn until([a, b]: [Self; 2], beyond: f32) -> f64 {
        (a.counted() + b.counted() + f64::from(beyond)).next_down().next_down()
    }

    /// Whether the sum of their paths is still below that.
    #[inline]
    pub(crate) fn are_before([a, b]: [Self; 2], until: f64) -> bool {
        // The next number up from one that is not negative; after infinity comes NaN, which compares as false.
        // `next_up` checks more, and this runs for each candidate.
        let ways = a.travel + b.travel;
        f64::from_bits(ways.to_bits().wrapping_add(1)) < until
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_that_changed_are_asked_about_and_count_anew() {
        let mut odometers = [Odometer::CHANGED; 2];
        assert!(!Odometer::are_before(odometers, 1e300));
        let until = Odometer::until(odometers, 0.5);
        odometers.iter_mut().for_each(Odometer::close);
        assert!(Odometer::are_before(odometers, until));
        odometers[0].go(0.25);
        assert!(Odometer::are_before(odometers, until) && odometers[0].step() > 0.25);
        odometers[1].go(0.25);
        assert!(!Odometer::are_before(odometers, until), "what touches is not before");
        odometers[1] = Odometer::CHANGED;
        assert!(
            !Odometer::are_before(odometers, f64::MAX) && !Odometer::are_before(odometers, f64::INFINITY)
        );
    }

    #[test]
    fn many_small_steps_count_no_less_than_one_of_their_sum() {
        let mut odometer = Odometer::CHANGED;
        odometer.close();
        odometer.go(1e6);
        let before = Odometer::until([odometer; 2], 0.0);
        // Each is less than half of what the sum could hold.
        (0..1000).for_each(|_| odometer.go(1e-11));
        assert!(!Odometer::are_before([odometer; 2], before + 2e-8));
    }
}
