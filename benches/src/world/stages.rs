//! Times of a frame's stages.

use crate::clock::Samples;
use crate::row::{self, duration};
use asunder::Stats;
use serde::Serialize;
use std::time::Duration;

/// Figures of whole frames. Stages are medians of wall-clock times; the rest of a frame is setting poses and visiting
/// contacts.
///
/// ```
/// use asunder_benches::world::Figures;
/// let figures = Figures { sweep_ns: 1500.0, ..Figures::default() };
/// assert!(figures.to_text().contains("1500 ns"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Poses to boxes, in nanoseconds.
    pub refit_ns: f64,
    /// Boxes to pairs.
    pub sweep_ns: f64,
    /// Pairs to contacts.
    pub collide_ns: f64,
    /// Matching this update's contacts with the last one's.
    pub merge_ns: f64,
    /// Events, and the index by body.
    pub report_ns: f64,
    /// Candidate pairs per body.
    pub pairs_per_body: f64,
    /// Threads with which the row's time was taken, if it is wall-clock time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Wall-clock time on one thread, in nanoseconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one_thread_ns: Option<f64>,
    /// One thread's wall-clock time divided by that of all threads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speedup: Option<f64>,
}

impl Figures {
    /// The columns of a table, under [`heading`].
    pub fn to_text(&self) -> String {
        let speedup = self.threads.zip(self.speedup).map(|(threads, times)| {
            format!(" {times:.2}x on {threads} threads, one takes {}", duration(self.one_thread_ns))
        });
        let stages = [self.refit_ns, self.sweep_ns, self.collide_ns, self.merge_ns, self.report_ns];
        let stages: String = stages.iter().map(|&ns| format!("{:>9} ", duration(Some(ns)))).collect();
        format!("{stages}{:>9.2}{}", self.pairs_per_body, speedup.unwrap_or_default())
    }
}

/// The heading of a table of frames.
///
/// ```
/// assert!(asunder_benches::world::heading().contains("collide"));
/// ```
pub fn heading() -> String {
    let plain = row::heading();
    let [refit, sweep, collide, merge, report] = ["refit", "sweep", "collide", "merge", "report"];
    format!(
        "{}{refit:>9} {sweep:>9} {collide:>9} {merge:>9} {report:>9} {:>9}  note",
        plain.trim_end_matches("note"),
        "pairs/body"
    )
}

/// Times of the stages, frame by frame.
#[derive(Default)]
pub(super) struct Stages([Samples; 5]);

impl Stages {
    pub(super) fn push(&mut self, stats: &Stats) {
        let Stats { refit, sweep, collide, merge, report, .. } = *stats;
        self.push_times([refit, sweep, collide, merge, report]);
    }

    pub(super) fn push_times(&mut self, times: [Duration; 5]) {
        for (samples, time) in self.0.iter_mut().zip(times) {
            let ns = time.as_nanos() as f64;
            samples.push(ns, ns);
        }
    }

    /// Their medians, in nanoseconds.
    pub(super) fn medians(&self) -> [f64; 5] {
        [0, 1, 2, 3, 4].map(|stage: usize| self.0[stage].median().unwrap_or(0.0))
    }

    pub(super) fn figures(&self, candidates: usize, bodies: usize) -> Figures {
        let [refit_ns, sweep_ns, collide_ns, merge_ns, report_ns] = self.medians();
        let pairs_per_body = candidates as f64 / bodies.max(1) as f64;
        Figures { refit_ns, sweep_ns, collide_ns, merge_ns, report_ns, pairs_per_body, ..Figures::default() }
    }
}
