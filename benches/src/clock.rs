//! Thread CPU time, and medians of it.

use cpu_time::ThreadTime;

/// The CPU time of this thread that a call takes, in nanoseconds, and what the call returned.
///
/// ```
/// let (ns, sum) = asunder_benches::clock::time(|| (0..1000_u64).sum::<u64>());
/// assert!(ns >= 0.0 && sum == 499_500);
/// ```
pub fn time<T>(call: impl FnOnce() -> T) -> (f64, T) {
    let start = ThreadTime::now();
    let result = core::hint::black_box(call());
    (start.elapsed().as_nanos() as f64, result)
}

/// Samples of one variant, in nanoseconds.
///
/// ```
/// use asunder_benches::clock::Samples;
/// let mut samples = Samples::default();
/// for ns in [3.0, 1.0, 2.0] {
///     samples.push(ns, 6.0);
/// }
/// assert_eq!(samples.median(), Some(2.0));
/// assert_eq!((samples.spent(), samples.len()), (18.0, 3));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Samples {
    ns: Vec<f64>,
    spent: f64,
}

impl Samples {
    /// Adds one sample, and the time that it took to get it.
    pub fn push(&mut self, ns: f64, spent: f64) {
        self.ns.push(ns);
        self.spent += spent;
    }

    /// The median; of two middle samples, the lower. `None` without samples. Cost: a sort.
    pub fn median(&self) -> Option<f64> {
        quantiles(&self.ns, [0.5]).map(|[median]| median)
    }

    /// The median and the quartiles. `None` without samples. Cost: a sort.
    ///
    /// ```
    /// use asunder_benches::clock::{Samples, Spread};
    /// let mut samples = Samples::default();
    /// for ns in [5.0, 1.0, 4.0, 2.0, 3.0] {
    ///     samples.push(ns, ns);
    /// }
    /// assert_eq!(samples.spread(), Some(Spread { low: 2.0, median: 3.0, high: 4.0 }));
    /// ```
    pub fn spread(&self) -> Option<Spread> {
        quantiles(&self.ns, [0.25, 0.5, 0.75]).map(|[low, median, high]| Spread { low, median, high })
    }

    /// The time that all samples took, in nanoseconds.
    pub fn spent(&self) -> f64 {
        self.spent
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.ns.len()
    }

    /// Whether there is no sample yet.
    pub fn is_empty(&self) -> bool {
        self.ns.is_empty()
    }
}

/// The median and the quartiles of some samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// A quarter of the samples are below.
    pub low: f64,
    /// Half of the samples are below.
    pub median: f64,
    /// Three quarters of the samples are below.
    pub high: f64,
}

/// The quantiles of some samples: for each share, the sample at that place between the first and the last. Places are
/// rounded away from the middle, so that few samples never look steadier than they are; the median is the lower of two.
/// `None` without samples; NaN counts as the greatest. Cost: a sort.
///
/// ```
/// use asunder_benches::clock::quantiles;
/// assert_eq!(quantiles(&[4.0, 1.0, 3.0, 2.0], [0.0, 0.5, 0.99, 1.0]), Some([1.0, 2.0, 4.0, 4.0]));
/// assert_eq!(quantiles(&[], [0.5]), None);
/// ```
pub fn quantiles<const N: usize>(samples: &[f64], shares: [f64; N]) -> Option<[f64; N]> {
    let mut sorted = samples.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let place = |share: f64| {
        let place = last as f64 * share;
        (if share > 0.5 { place.ceil() } else { place }) as usize
    };
    Some(shares.map(|share| sorted[place(share).min(last)]))
}

/// The effort spent on a row.
///
/// ```
/// use asunder_benches::clock::Effort;
/// assert!(Effort::quick().seconds < Effort::full().seconds);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// CPU seconds per variant of a row.
    pub seconds: f64,
    /// The most frames or rounds, even where the time allows more.
    pub rounds: usize,
    /// Pairs in a set of the narrow phase.
    pub pairs: usize,
    /// Whether to leave out the largest sizes.
    pub is_quick: bool,
}

impl Effort {
    /// For figures to be published: about a second per variant.
    pub const fn full() -> Self {
        Self { seconds: 1.0, rounds: 60, pairs: 10_000, is_quick: false }
    }

    /// For a quick look: some tenths of a second per variant, and smaller sets.
    pub const fn quick() -> Self {
        Self { seconds: 0.15, rounds: 12, pairs: 2000, is_quick: true }
    }

    /// The same time in nanoseconds.
    pub fn nanoseconds(&self) -> f64 {
        self.seconds * 1e9
    }
}
