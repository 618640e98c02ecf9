//! Counts the steps of kernels, so that tests can check cost without timing.
//!
//! A step is one halving of a search, one edge of a polygon, or one pass over eight vertices, faces or edges: 3 to 5 ns
//! (AMD EPYC, Zen 4, 2026-11-21). What takes longer counts as several. Outside of tests there is no counter.

/// Counts one step, in tests.
#[inline(always)]
pub(crate) fn count_step() {
    count_steps(1);
}

/// Counts this many steps, in tests.
#[cfg(not(test))]
#[inline(always)]
pub(crate) fn count_steps(_: usize) {}

#[cfg(test)]
pub(crate) use on_this_thread::{count_steps, steps_of};

#[cfg(test)]
mod on_this_thread {
    use core::cell::Cell;

    thread_local!(static STEPS: Cell<usize> = const { Cell::new(0) });

    pub(crate) fn count_steps(count: usize) {
        STEPS.with(|steps| steps.set(steps.get() + count));
    }

    /// The steps that something takes.
    pub(crate) fn steps_of<R>(run: impl FnOnce() -> R) -> (R, usize) {
        let before = STEPS.with(Cell::get);
        let result = run();
        (result, STEPS.with(Cell::get) - before)
    }
}
