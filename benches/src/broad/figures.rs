//! Figures of a broad-phase row besides its times.

use super::memory::least_traffic;
use crate::row::duration;
use serde::Serialize;

/// The median frame time of one of the peer's ways.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PeerTime {
    /// How its tree is updated.
    pub mode: &'static str,
    /// Nanoseconds a frame.
    pub ns: f64,
}

/// Figures of one scene, for our best mode.
///
/// ```
/// use asunder_benches::broad::figures::Figures;
/// let mut figures = Figures { mode: "sweep", ..Figures::default() };
/// figures.hold(1000, 500, 48_000, 20_000.0);
/// assert_eq!((figures.ns_per_box, figures.ns_per_pair), (Some(20.0), Some(40.0)));
/// assert_eq!(figures.bytes_per_box, Some(48.0));
/// figures.hold_against(14.0, 1000, 500, 20_000.0);
/// assert_eq!(figures.bound_share, Some(0.1));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// The best of our modes: `sweep` starts from scratch, `coherent` keeps the pairs of resting boxes.
    pub mode: &'static str,
    /// Pairs of the last frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pairs: Option<usize>,
    /// Our sweep alone, with unordered pairs, in nanoseconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep_ns: Option<f64>,
    /// Sorting the pairs: the whole time minus the sweep, in nanoseconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order_ns: Option<f64>,
    /// Our nanoseconds a box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ns_per_box: Option<f64>,
    /// Our nanoseconds a pair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ns_per_pair: Option<f64>,
    /// The time in which memory could read each box and write each pair, divided by our time: 1 is the bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound_share: Option<f64>,
    /// Bytes per nanosecond that a large copy moves in this run, on which the bound is built.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copy_bytes_per_ns: Option<f64>,
    /// The most memory held at the end of a frame, the pair list included, in bytes per box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bytes_per_box: Option<f64>,
    /// Threads with which the row's time was taken, if it is wall-clock time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Wall-clock time on one thread, in nanoseconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one_thread_ns: Option<f64>,
    /// One thread's wall-clock time divided by that of all threads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speedup: Option<f64>,
    /// All of the peer's ways, fastest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub peers: Vec<PeerTime>,
}

impl Figures {
    /// Sets the figures for a frame of `ns` nanoseconds that found so many pairs and held at most `bytes` of memory.
    pub fn hold(&mut self, boxes: usize, pairs: usize, bytes: usize, ns: f64) {
        self.pairs = Some(pairs);
        self.ns_per_box = Some(ns / boxes.max(1) as f64);
        self.ns_per_pair = (pairs > 0).then(|| ns / pairs as f64);
        self.bytes_per_box = Some(bytes as f64 / boxes.max(1) as f64);
    }

    /// Compares a frame of `ns` nanoseconds with memory that moves so many bytes per nanosecond.
    pub fn hold_against(&mut self, bytes_per_ns: f64, boxes: usize, pairs: usize, ns: f64) {
        self.copy_bytes_per_ns = Some(bytes_per_ns);
        self.bound_share = Some(least_traffic(boxes, pairs) / bytes_per_ns / ns);
    }

    /// The columns of a table, under [`Figures::heading`].
    pub fn to_text(&self) -> String {
        let number = |value: Option<f64>, digits: usize| {
            value.map_or_else(|| "-".to_string(), |value| format!("{value:.digits$}"))
        };
        let speedup = self.threads.zip(self.speedup).map(|(threads, times)| {
            format!(" {times:.2}x on {threads} threads, one takes {}", duration(self.one_thread_ns))
        });
        format!(
            "{:<8} {:>10} {:>10} {:>8} {:>7} {:>7} {:>6} {:>6}{}",
            self.mode,
            duration(self.sweep_ns),
            duration(self.order_ns),
            self.pairs.map_or_else(|| "-".to_string(), |pairs| pairs.to_string()),
            number(self.ns_per_box, 1),
            number(self.ns_per_pair, 1),
            number(self.bound_share.map(|share| share * 100.0), 1),
            number(self.bytes_per_box, 0),
            speedup.unwrap_or_default(),
        )
    }

    /// The headings of those columns.
    ///
    /// ```
    /// use asunder_benches::broad::figures::Figures;
    /// assert_eq!(Figures::heading().len(), Figures::default().to_text().len());
    /// ```
    pub fn heading() -> String {
        format!(
            "{:<8} {:>10} {:>10} {:>8} {:>7} {:>7} {:>6} {:>6}",
            "mode", "sweep", "order", "pairs", "ns/box", "ns/pair", "% mem", "B/box"
        )
    }
}
