//! Time for `stats()`, where the platform has a clock.

use core::time::Duration;

/// A moment, to measure a stage from. On wasm, where std's clock panics, every duration is zero.
pub(crate) struct Moment {
    #[cfg(not(target_family = "wasm"))]
    start: std::time::Instant,
}

impl Moment {
    pub(crate) fn now() -> Self {
        Self {
            #[cfg(not(target_family = "wasm"))]
            start: std::time::Instant::now(),
        }
    }

    pub(crate) fn elapsed(&self) -> Duration {
        #[cfg(not(target_family = "wasm"))]
        return self.start.elapsed();
        #[cfg(target_family = "wasm")]
        Duration::ZERO
    }
}
