//! Counts steps of the hull builder, as tests can count but not time it: like `counted` of the narrow phase, which this
//! crate cannot use.
//!
//! A step is one point tested against one triangle, or one corner of a facet sorted. There is no counter outside of
//! tests.

/// Counts one step, in tests.
#[cfg(not(test))]
#[inline(always)]
pub(crate) fn count_step() {}

#[cfg(test)]
pub(crate) use on_this_thread::{count_step, steps_of};

#[cfg(test)]
mod on_this_thread {
    use core::cell::Cell;

    thread_local!(static STEPS: Cell<u64> = const { Cell::new(0) });

    pub(crate) fn count_step() {
        STEPS.with(|steps| steps.set(steps.get() + 1));
    }

    /// The steps that something takes.
    pub(crate) fn steps_of<R>(run: impl FnOnce() -> R) -> (R, u64) {
        let before = STEPS.with(Cell::get);
        let result = run();
        (result, STEPS.with(Cell::get) - before)
    }
}
