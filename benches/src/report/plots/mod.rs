//! Kinds of plots. None of them knows where its figures come from.

pub mod bars;
pub mod curves;
pub mod heat;
pub mod labels;
pub mod scatter;
pub mod strips;

/// What stands above every plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Title {
    /// What the plot answers.
    pub question: String,
    /// How to read it.
    pub reading: String,
}

impl Title {
    /// A question, and how to read the answer.
    pub fn new(question: impl Into<String>, reading: impl Into<String>) -> Self {
        Self { question: question.into(), reading: reading.into() }
    }

    /// The lines that fit the width.
    fn lines(&self) -> [&str; 2] {
        [&self.question, &self.reading]
    }
}

/// A median with what it varies over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// The middle sample.
    pub median: f64,
    /// The lower quartile.
    pub low: f64,
    /// The upper quartile.
    pub high: f64,
}

impl Spread {
    /// A value and its quartiles.
    pub const fn new(median: f64, low: f64, high: f64) -> Self {
        Self { median, low, high }
    }

    /// A value without noise.
    pub const fn exactly(value: f64) -> Self {
        Self { median: value, low: value, high: value }
    }

    /// The same in other units.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { median: self.median * factor, low: self.low * factor, high: self.high * factor }
    }

    /// Whether it is marked.
    pub fn is_wide(self) -> bool {
        super::spread::is_wide(self.median, self.low, self.high)
    }
}
