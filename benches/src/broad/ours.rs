//! Our side of the broad phase.

use super::figures::Figures;
use super::{Frame, forget, memory, object};
use crate::clock::{Samples, Spread, time};
use crate::row::Row;
use asunder_broad::{CoherentSweep, PairId, Sweep};
use asunder_geometry::Aabb3;
use core::ops::ControlFlow;
use std::time::Instant;

/// A mode of our broad phase.
pub(super) enum Engine {
    /// From scratch each frame.
    Sweep(Box<Sweep>),
    /// Keeps the pairs of resting boxes, and is given the boxes that moved.
    Coherent(Box<CoherentSweep<Aabb3>>),
}

impl Engine {
    /// The modes worth trying.
    pub(super) fn all(few_move: bool) -> Vec<Self> {
        let mut all = vec![Self::Sweep(Box::default())];
        if few_move {
            all.push(Self::Coherent(Box::default()));
        }
        all
    }

    pub(super) const fn name(&self) -> &'static str {
        match self {
            Self::Sweep(_) => "sweep",
            Self::Coherent(_) => "coherent",
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Sweep(sweep) => sweep.bytes(),
            Self::Coherent(sweep) => sweep.bytes(),
        }
    }

    /// Pairs of boxes that the last frame compared; `None` where columns were split further or pairs were kept.
    pub(super) fn compared(&self) -> Option<usize> {
        match self {
            Self::Sweep(sweep) => sweep.columns().map(|column| column.candidates).sum(),
            Self::Coherent(_) => None,
        }
    }

    /// What a user calls: sweep, filter and sort.
    pub(super) fn list(&mut self, frame: &Frame, pairs: &mut Vec<PairId>) {
        let admit = |a, b| frame.filter.admits(a, b);
        // Without a limit on pairs it cannot fail.
        let _ = match self {
            Self::Sweep(sweep) => sweep.pairs(frame.boxes, admit, usize::MAX, pairs),
            Self::Coherent(sweep) => sweep.update(frame.boxes, frame.moved, admit, usize::MAX, pairs),
        };
    }
}

/// One mode, and its result and times.
pub(super) struct Variant {
    pub(super) engine: Engine,
    pub(super) pairs: Vec<PairId>,
    pub(super) samples: Samples,
    pub(super) peak: usize,
}

impl Variant {
    pub(super) fn new(engine: Engine) -> Self {
        Self { engine, pairs: Vec::new(), samples: Samples::default(), peak: 0 }
    }

    fn frame(&mut self, frame: &Frame) {
        let (ns, ()) = time(|| self.engine.list(frame, &mut self.pairs));
        self.samples.push(ns, ns);
        let held = self.engine.bytes() + self.pairs.capacity() * size_of::<PairId>();
        self.peak = self.peak.max(held);
    }
}

pub(super) struct Ours {
    variants: Vec<Variant>,
    /// The sweep from scratch, with unordered pairs.
    unordered: Unordered,
}

struct Unordered {
    sweep: Sweep,
    pairs: Vec<PairId>,
    samples: Samples,
    /// Set if it took longer than a row may.
    cut: Option<Cut>,
}

/// The figures of a sweep that was aborted.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    /// The time it had taken by then, and the extrapolated time of the whole, in nanoseconds.
    pub(super) time: Spread,
    /// All pairs of the frame, if known from a peer; else those found so far.
    pub(super) pairs: usize,
}

impl Ours {
    pub(super) fn new(few_move: bool) -> Self {
        let unordered =
            Unordered { sweep: Sweep::new(), pairs: Vec::new(), samples: Samples::default(), cut: None };
        Self { variants: Engine::all(few_move).into_iter().map(Variant::new).collect(), unordered }
    }

    pub(super) fn is_done(&self, limit: f64) -> bool {
        self.unordered.cut.is_some() || self.variants.iter().all(|variant| variant.samples.spent() >= limit)
    }

    pub(super) fn forget_samples(&mut self, limit: f64) {
        if self.unordered.cut.is_none() {
            forget(&mut self.unordered.samples, limit);
            self.variants.iter_mut().for_each(|variant| forget(&mut variant.samples, limit));
        }
    }

    /// One frame of each variant that has time left; which one comes first, and finds cold caches, alternates.
    pub(super) fn frame(&mut self, frame: &Frame, expected: Option<usize>, limit: f64, row: &mut Row) {
        if self.is_done(limit) {
            return;
        }
        let unordered_last = self.unordered.samples.len() % 2 == 1;
        if !unordered_last {
            self.unordered.frame(frame, expected, limit, row);
        }
        if self.unordered.cut.is_some() {
            return;
        }
        let mut known: Option<&[PairId]> = None;
        for variant in self.variants.iter_mut().filter(|variant| variant.samples.spent() < limit) {
            variant.frame(frame);
            let name = variant.engine.name();
            if expected.is_some_and(|expected| expected != variant.pairs.len()) {
                object(row, &format!("PAIRS DIFFER: our {name} has {}", variant.pairs.len()));
            }
            if *known.get_or_insert(&variant.pairs) != variant.pairs {
                object(row, &format!("LISTS DIFFER: that of our {name}"));
            }
        }
        if unordered_last {
            self.unordered.frame(frame, expected, limit, row);
        }
    }

    /// The samples of each mode, unless the sweep was aborted.
    pub(super) fn variants(&self) -> &[Variant] {
        if self.unordered.cut.is_some() { &[] } else { &self.variants }
    }

    /// Where the sweep was aborted, if it was.
    pub(super) fn cut(&self) -> Option<Cut> {
        self.unordered.cut
    }

    pub(super) fn report(&self, row: &mut Row, figures: &mut Figures) {
        if let Some(cut) = self.unordered.cut {
            (row.ours_ns, row.done) = (Some(cut.time.median), 1);
            figures.mode = "sweep";
            figures.sweep_ns = row.ours_ns;
            return;
        }
        let medians = self.variants.iter().filter_map(|one| Some((one.samples.median()?, one)));
        let Some((ns, best)) = medians.min_by(|a, b| a.0.total_cmp(&b.0)) else { return };
        row.tell(&best.samples);
        row.done = best.samples.len();
        figures.mode = best.engine.name();
        if matches!(best.engine, Engine::Sweep(_)) {
            figures.sweep_ns = self.unordered.samples.median();
            figures.order_ns = figures.sweep_ns.map(|sweep| (ns - sweep).max(0.0));
        }
        let pairs = best.pairs.len();
        figures.hold(row.n, pairs, best.peak, ns);
        figures.hold_against(memory::bandwidth(), row.n, pairs, ns);
    }
}

impl Unordered {
    fn frame(&mut self, frame: &Frame, expected: Option<usize>, limit: f64, row: &mut Row) {
        if self.samples.spent() >= limit {
            return;
        }
        let (ns, flow) = self.visit(frame, limit);
        if flow.is_continue() {
            self.samples.push(ns, ns);
            return;
        }
        let done = self.pairs.len();
        let all = expected.unwrap_or(done).max(done).max(1);
        let whole = ns * all as f64 / done.max(1) as f64;
        self.cut = Some(Cut { time: Spread { low: ns, median: whole, high: whole }, pairs: all });
        row.remark(&format!(
            "stopped after {:.1} s at {:.0} % of {all} pairs: our time is extrapolated, without order",
            ns * 1e-9,
            100.0 * done as f64 / all as f64
        ));
    }

    /// The sweep alone, into an unordered list, aborted when its time is up. Returns its nanoseconds.
    fn visit(&mut self, frame: &Frame, limit: f64) -> (f64, ControlFlow<()>) {
        let start = Instant::now();
        let pairs = &mut self.pairs;
        pairs.clear();
        // Twice the time of a variant: if it takes more, a second frame would not fit anyhow.
        let limit = 2e-9 * limit;
        time(|| {
            self.sweep.visit(
                frame.boxes,
                |a, b| frame.filter.admits(a, b),
                |pair| {
                    pairs.push(pair);
                    let is_late = pairs.len().is_multiple_of(1024) && start.elapsed().as_secs_f64() > limit;
                    if is_late { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                },
            )
        })
    }
}
