//! Kinds of plots. They do not depend on where their figures come from.

pub mod bars;
pub mod curves;
pub mod groups;
pub mod heat;
pub mod labels;
pub mod scatter;
pub mod strips;

/// The title above a plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Title {
    /// The question that the plot answers.
    pub question: String,
    /// How to read it.
    pub reading: String,
}

impl Title {
    /// A question, and how to read the answer.
    pub fn new(question: impl Into<String>, reading: impl Into<String>) -> Self {
        Self { question: question.into(), reading: reading.into() }
    }

    /// The lines, which fit the width.
    fn lines(&self) -> [&str; 2] {
        [&self.question, &self.reading]
    }
}
