//! Settings for benches in daily use: seconds in all.

use core::time::Duration;
use criterion::Criterion;

/// Few samples, some tenths of a second a row.
pub(crate) fn brief() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(300))
}
