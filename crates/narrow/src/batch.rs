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

/// What a pair within its margin has to say: whether it overlaps, and how it touches unless a sensor asked.
pub(crate) type Touch<M> = (bool, Option<M>);

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

    pub(crate) fn push(&mut self, hint: Hint, touch: Option<Touch<M>>) {
        let first = self.manifolds.len() as u32;
        self.answers.push(match touch {
            None => Answer::Apart { hint },
            Some((overlapping, manifold)) => {
                self.manifolds.extend(manifold);
                Answer::Contact { hint, overlapping, manifolds: first..self.manifolds.len() as u32 }
            }
        });
    }
}
