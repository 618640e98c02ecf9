//! Answers to many jobs, in memory that is kept between frames.

use crate::answer::{Answer, Manifold2, Manifold3};
use crate::feature::Hint;

/// Answers to a batch of jobs, and the manifolds they refer to. Keep one between frames: it is scratch memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch<M> {
    /// One answer a job, in order.
    pub answers: Vec<Answer>,
    /// What the answers' ranges point into.
    pub manifolds: Vec<M>,
}

/// Answers in the plane.
pub type Batch2 = Batch<Manifold2>;

/// Answers in space.
pub type Batch3 = Batch<Manifold3>;

impl<M> Default for Batch<M> {
    fn default() -> Self {
        Self { answers: Vec::new(), manifolds: Vec::new() }
    }
}

impl<M> Batch<M> {
    /// Empties both lists and keeps their memory.
    pub fn clear(&mut self) {
        self.answers.clear();
        self.manifolds.clear();
    }

    /// Appends an answer: whether the shapes overlap, if they are within the margin, and the manifolds from `first` on.
    pub(crate) fn push(&mut self, hint: Hint, overlapping: Option<bool>, first: u32) {
        self.answers.push(match overlapping {
            None => Answer::Apart { hint },
            Some(overlapping) => {
                Answer::Contact { hint, overlapping, manifolds: first..self.manifolds.len() as u32 }
            }
        });
    }
}
