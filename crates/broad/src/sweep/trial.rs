//! Hooks for tests: force one way of sweeping in place of the one that counts choose, and count the steps it took.

#[cfg(test)]
pub(crate) use counted::{note, steps_of, way};
#[cfg(not(test))]
pub(crate) use plain::{note, way};

/// How boxes are swept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(not(test), allow(dead_code))]
pub(crate) enum Way {
    /// Whichever the counts choose.
    #[default]
    ByCounts,
    /// In columns, however long that takes.
    Columns,
    /// Every column by segments.
    SegmentsInColumns,
    /// All boxes by segments.
    Segments,
}

#[cfg(not(test))]
mod plain {
    use super::Way;

    #[inline(always)]
    pub(crate) const fn way() -> Way {
        Way::ByCounts
    }

    #[inline(always)]
    pub(crate) const fn note(_steps: usize) {}
}

#[cfg(test)]
mod counted {
    use super::Way;
    use core::cell::Cell;

    thread_local! {
        static WAY: Cell<Way> = const { Cell::new(Way::ByCounts) };
        static STEPS: Cell<usize> = const { Cell::new(0) };
    }

    pub(crate) fn way() -> Way {
        WAY.get()
    }

    /// Adds steps of some 2 ns each.
    pub(crate) fn note(steps: usize) {
        STEPS.set(STEPS.get() + steps);
    }

    /// The steps that `work` takes on this thread when swept in this way.
    pub(crate) fn steps_of(way: Way, work: impl FnOnce()) -> usize {
        WAY.set(way);
        STEPS.set(0);
        work();
        WAY.set(Way::ByCounts);
        STEPS.get()
    }
}
