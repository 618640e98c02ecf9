//! The least of several separations: that of two bodies made of parts.

use crate::precision::round_down;

/// Finds the nearest of the pairs of parts that are tested one after the other, for either dimension.
pub(crate) struct Least<P> {
    /// No larger separation is wanted.
    limit: f64,
    /// Parts further apart than this are skipped: the limit, or the least separation so far.
    reach: f64,
    /// The least bound of parts that were skipped.
    beyond: f32,
    /// The least that any separation may truly be, given its error.
    lowest: f64,
    best: Option<Nearest<P>>,
}

struct Nearest<P> {
    parts: P,
    separation: f32,
    error: f32,
}

impl<P> Least<P> {
    pub(crate) fn within(limit: f64) -> Self {
        Self { limit, reach: limit, beyond: f32::INFINITY, lowest: f64::INFINITY, best: None }
    }

    /// How near parts must be to matter.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Whether parts at least `at_least` apart can be skipped; if so, notes their bound.
    pub(crate) fn passes_over(&mut self, at_least: f64) -> bool {
        self.passes_below(at_least, f64::INFINITY)
    }

    /// The same, where other parts are known to be at most `at_most` apart.
    pub(crate) fn passes_below(&mut self, at_least: f64, at_most: f64) -> bool {
        let is_out_of_reach = at_least > self.reach.min(at_most);
        if is_out_of_reach {
            self.give_up(round_down(at_least));
        }
        is_out_of_reach
    }

    /// Whether parts at least `at_least` apart can be skipped, since they are no nearer than the nearest so far, but
    /// for its error. Not where that one has a hair of a gap and these may overlap: the sign is exact, so they are
    /// tested.
    pub(crate) fn is_no_less(&self, at_least: f64) -> bool {
        self.best.as_ref().is_some_and(|best| {
            at_least >= f64::from(best.separation) - f64::from(best.error)
                && (at_least > 0.0 || best.separation <= 0.0)
        })
    }

    /// Notes parts that turned out to be out of reach: at least `at_least` apart.
    pub(crate) fn give_up(&mut self, at_least: f32) {
        self.beyond = self.beyond.min(at_least);
    }

    /// Notes parts whose separation was measured. Of equals, the first counts.
    pub(crate) fn offer(&mut self, parts: P, separation: f32, error: f32) {
        self.lowest = self.lowest.min(f64::from(separation) - f64::from(error));
        if self.best.as_ref().is_none_or(|known| separation < known.separation) {
            self.reach = self.reach.min(f64::from(separation).max(0.0));
            self.best = Some(Nearest { parts, separation, error });
        }
    }

    /// The nearest parts, and an error that covers all others; or, beyond the limit, a lower bound on how far apart all
    /// are.
    pub(crate) fn finish(self) -> Result<(P, f32), f32> {
        let Nearest { parts, separation, error } = self.best.ok_or(self.beyond)?;
        // Beyond the limit, parts that were skipped may be nearer than the ones that were measured.
        if f64::from(separation) > self.limit && separation > self.beyond {
            return Err(self.beyond);
        }
        // Others may truly be nearer, if their errors are larger.
        let short = f64::from(separation) - self.lowest;
        Ok((parts, if short > f64::from(error) { (short as f32).next_up() } else { error }))
    }
}

impl<C> Least<Option<C>> {
    /// Takes the answer for two parts within reach: their closest points, of which `measured` gives distance and error;
    /// or `None` if they overlap. Returns whether the search can stop, as nothing can be nearer.
    pub(crate) fn offer_closest(
        &mut self,
        found: Result<Option<C>, f32>,
        measured: impl Fn(&C) -> [f32; 2],
    ) -> bool {
        match found {
            Err(at_least) => self.give_up(at_least),
            Ok(Some(closest)) => {
                let [distance, error] = measured(&closest);
                self.offer(Some(closest), distance, error);
            }
            Ok(None) => {
                self.offer(None, 0.0, 0.0);
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_counts_and_its_error_covers_the_others() {
        let mut least = Least::within(f64::INFINITY);
        least.offer("far", 3.0, 0.1);
        least.offer("wide", 2.0, 0.75);
        least.offer("near", 1.5, 0.1);
        assert_eq!(least.reach(), 1.5);
        assert!(least.passes_over(1.6) && !least.passes_over(1.4) && least.passes_below(1.4, 1.3));
        let (parts, error) = least.finish().unwrap();
        // "wide" may be as near as 1.25.
        assert!(parts == "near" && (0.25..0.2501).contains(&error), "{parts} {error}");
    }

    #[test]
    fn beyond_the_limit_a_measured_separation_is_no_better_than_a_bound() {
        let mut least = Least::within(1.0);
        least.offer("measured", 5.0, 0.0);
        least.give_up(1.25);
        assert_eq!(least.finish(), Err(1.25));
        let mut least = Least::within(1.0);
        least.give_up(1.25);
        least.offer("measured", 1.125, 0.0);
        assert_eq!(least.finish(), Ok(("measured", 0.0)));
        assert_eq!(Least::<&str>::within(1.0).finish(), Err(f32::INFINITY));
    }

    #[test]
    fn within_the_error_nothing_is_nearer_unless_it_may_overlap() {
        let mut least = Least::within(f64::INFINITY);
        least.offer("away", 1.0, 0.5);
        assert!(least.is_no_less(0.75) && !least.is_no_less(0.25));
        least.offer("a hair away", 1e-9, 1e-6);
        assert!(least.is_no_less(1e-12) && !least.is_no_less(0.0) && !least.is_no_less(-1e-12));
        least.offer("touching", 0.0, 1e-6);
        assert!(least.is_no_less(0.0) && least.is_no_less(-1e-12));
    }

    #[test]
    fn overlap_hides_nothing_deeper() {
        let mut least = Least::within(0.0);
        least.offer("shallow", -0.5, 0.0);
        assert_eq!(least.reach(), 0.0);
        least.offer("deep", -2.0, 0.0);
        assert_eq!(least.finish(), Ok(("deep", 0.0)));
    }
}
