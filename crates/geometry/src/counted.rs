//! Steps of the hull builder, so that tests can count what they cannot time: as `counted` of the narrow phase, of which
//! this crate knows nothing.
//!
//! A step is one point asked about one triangle, or one corner of a facet put in order. In what is shipped there is no
//! counter.

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
