//! How far bodies went, so that pairs far enough apart need no look at either.
//!
//! ```text
//! two bodies are apart by more than their margins, and by `beyond` at least, when both have gone s together
//! no point of either has come nearer to the other than they have gone since
//! while they have gone less than s + beyond together, they are apart, whatever their ways
//! ```
//! Bodies that rest a few millimetres from each other, and tremble, are asked about once in thousands of frames; so is
//! who passes by at a distance, as long as the distance allows. One number a body and one a pair, and no pose is read.

/// What a body went since it last changed otherwise, in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Odometer {
    /// Infinite from when it changed until the next update: all its pairs are asked about.
    travel: f64,
    /// Of that, since the last update.
    step: f64,
}

impl Odometer {
    /// Of a body that is new, or not what it was.
    pub(crate) const CHANGED: Self = Self { travel: f64::INFINITY, step: f64::INFINITY };

    /// One that counts from what was saved; nothing of what none says.
    #[cfg(feature = "serde")]
    pub(crate) fn restored(travel: f64, step: f64) -> Option<Self> {
        let is_sound = travel.is_finite() && travel >= 0.0 && (0.0..=travel).contains(&step);
        is_sound.then_some(Self { travel, step })
    }

    /// What both count, to be saved; nothing while it has changed.
    #[cfg(feature = "serde")]
    pub(crate) fn saved(self) -> Option<(f64, f64)> {
        self.travel.is_finite().then_some((self.travel, self.step))
    }

    /// Whether it changed since the last update, and not by moving alone.
    #[inline]
    pub(crate) fn has_changed(self) -> bool {
        !self.travel.is_finite()
    }

    /// It went so far.
    #[inline]
    pub(crate) fn go(&mut self, metres: f64) {
        // Rounded up: what is lost in adding may not be lost in sum.
        self.travel = (self.travel + metres).next_up();
        self.step = (self.step + metres).next_up().min(self.travel);
    }

    /// All its pairs have been asked about.
    #[inline]
    pub(crate) fn close(&mut self) {
        *self = Self { travel: self.counted(), step: 0.0 };
    }

    /// Since the last update.
    #[inline]
    pub(crate) fn step(self) -> f64 {
        self.step
    }

    /// What it will count from when this update is over.
    #[inline]
    fn counted(self) -> f64 {
        if self.travel.is_finite() { self.travel } else { 0.0 }
    }

    /// The sum of both bodies' ways up to which they stay apart that are now `beyond` metres further apart than they
    /// need to be.
    #[inline]
    pub(crate) fn until([a, b]: [Self; 2], beyond: f32) -> f64 {
        (a.counted() + b.counted() + f64::from(beyond)).next_down().next_down()
    }

    /// Whether they have not gone as far together.
    #[inline]
    pub(crate) fn are_before([a, b]: [Self; 2], until: f64) -> bool {
        // The next number up, of one that is not negative: past infinity there is none, which is before nothing.
        // `next_up` asks for more, and this is asked of each candidate.
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
