//! How accurate answers are: the largest error, answers that are off, and contacts that are missed, on both sides.

use serde::Serialize;

/// The share of a pair's size above which an error counts as off, and beyond which no deeper contact may be missed.
pub const OFF: f64 = 1e-5;

/// One side's answer about a pair.
///
/// A yes without a number claims that the separation is not above zero, and a no that it is not below: the error is how
/// far the truth contradicts that. A correct yes or no has no error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Said {
    /// Whether it says that they touch: by a yes, a depth, or a contact point.
    pub touching: bool,
    /// The separation in metres, where it gives one.
    pub separation: Option<f64>,
}

/// The result for the pairs of a row that were judged.
///
/// ```
/// use asunder_benches::accuracy::{Accuracy, Said};
/// let mut found = Accuracy::default();
/// let (yes, no) = (Said { touching: true, separation: Some(-0.5) }, Said { touching: false, separation: None });
/// found.judge(-0.25, 2.0, yes, no);
/// assert_eq!((found.judged, found.max_error, found.off, found.missed), (1, 0.125, 1, 0));
/// assert_eq!((found.peer_max_error, found.peer_off, found.peer_missed), (Some(0.125), Some(1), Some(1)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Accuracy {
    /// How many pairs were judged.
    pub judged: usize,
    /// Our largest error, as a share of the pair's size; NaN is left out.
    pub max_error: f64,
    /// How many of our answers are off by more than [`OFF`] of size, or NaN.
    pub off: usize,
    /// How many pairs overlap by more than [`OFF`] of size without a contact from us.
    pub missed: usize,
    /// The peer's largest error; `None` where no peer was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peer_max_error: Option<f64>,
    /// How many of the peer's answers are off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peer_off: Option<usize>,
    /// How many contacts the peer misses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peer_missed: Option<usize>,
}

/// One answer compared with the truth: the error as a share of size, whether it is off, whether it misses a contact.
fn held(truth: f64, size: f64, said: Said) -> (f64, bool, bool) {
    let error = match (said.separation, said.touching) {
        (Some(separation), _) => (separation - truth).abs(),
        (None, true) => truth.max(0.0),
        (None, false) => (-truth).max(0.0),
    } / size;
    (error, error > OFF || error.is_nan(), truth < -OFF * size && !said.touching)
}

impl Accuracy {
    /// Adds both sides' answers about a pair, whose separation and size are given in metres.
    pub fn judge(&mut self, truth: f64, size: f64, ours: Said, peer: Said) {
        self.judge_ours(truth, size, ours);
        let (error, is_off, is_missed) = held(truth, size, peer);
        // `f64::max` ignores a NaN.
        self.peer_max_error = Some(self.peer_max_error.unwrap_or(0.0).max(error));
        self.peer_off = Some(self.peer_off.unwrap_or(0) + usize::from(is_off));
        self.peer_missed = Some(self.peer_missed.unwrap_or(0) + usize::from(is_missed));
    }

    /// Adds our answer about a pair that has no peer.
    pub fn judge_ours(&mut self, truth: f64, size: f64, ours: Said) {
        let (error, is_off, is_missed) = held(truth, size, ours);
        self.judged += 1;
        self.max_error = self.max_error.max(error);
        self.off += usize::from(is_off);
        self.missed += usize::from(is_missed);
    }

    /// The columns of a table, under [`Accuracy::heading`].
    pub fn to_text(&self) -> String {
        let count = |count: Option<usize>| count.map_or("-".to_string(), |count| count.to_string());
        let peer = self.peer_max_error.map_or("-".to_string(), |error| format!("{error:.1e}"));
        format!(
            "{:>6} {:>8} {:>5} {:>5} {peer:>8} {:>5} {:>5}",
            self.judged,
            format!("{:.1e}", self.max_error),
            self.off,
            self.missed,
            count(self.peer_off),
            count(self.peer_missed),
        )
    }

    /// The headings of those columns.
    ///
    /// ```
    /// use asunder_benches::accuracy::Accuracy;
    /// assert_eq!(Accuracy::heading().len(), Accuracy::default().to_text().len());
    /// ```
    pub fn heading() -> String {
        format!(
            "{:>6} {:>8} {:>5} {:>5} {:>8} {:>5} {:>5}",
            "judged", "error", "off", "miss", "peer's", "off", "miss"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(truth: f64, said: Said) -> (usize, usize, f64) {
        let mut found = Accuracy::default();
        found.judge(truth, 2.0, said, said);
        let peer = (found.peer_off, found.peer_missed, found.peer_max_error);
        assert_eq!((Some(found.off), Some(found.missed), Some(found.max_error)), peer);
        (found.off, found.missed, found.max_error)
    }

    #[test]
    fn a_word_without_a_number_is_off_by_what_contradicts_it() {
        let (yes, no) =
            (Said { touching: true, separation: None }, Said { touching: false, separation: None });
        assert_eq!(of(-0.5, yes), (0, 0, 0.0));
        assert_eq!(of(0.5, no), (0, 0, 0.0));
        assert_eq!(of(0.5, yes), (1, 0, 0.25));
        assert_eq!(of(-0.5, no), (1, 1, 0.25));
        assert_eq!(of(-1e-5, no), (0, 0, 5e-6));
    }

    #[test]
    fn a_number_is_off_by_what_it_differs() {
        let said = |separation| Said { touching: true, separation: Some(separation) };
        assert_eq!(of(-0.5, said(-0.5)), (0, 0, 0.0));
        assert_eq!(of(-0.5, said(-0.75)), (1, 0, 0.125));
        assert_eq!(of(0.25, said(-0.25)), (1, 0, 0.25));
        assert_eq!(of(-0.5, said(f64::NAN)), (1, 0, 0.0));
    }
}
