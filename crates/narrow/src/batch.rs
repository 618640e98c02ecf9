//! The answers and manifolds of `collide2` and `collide3`: lists that a caller keeps from frame to frame.

use crate::answer::{Answer, Manifold2, Manifold3};
use crate::feature::Hint;
use crate::precision::round_down;

/// Answers to a batch of jobs, and the manifolds to which they refer. Keep it between frames to reuse its memory.
#[derive(Debug, PartialEq)]
pub struct Batch<M> {
    /// One answer per job, in order.
    pub answers: Vec<Answer>,
    /// The manifolds that the answers' ranges index.
    pub manifolds: Vec<M>,
}

/// Answers in the plane.
pub type Batch2 = Batch<Manifold2>;

/// Answers in space.
pub type Batch3 = Batch<Manifold3>;

/// Whether two shapes within the margin overlap; or, for others, a lower bound in metres on how far they are beyond it.
pub(crate) type Met = Result<bool, f32>;

/// By how much shapes at least `at_least` apart are beyond the reach of a contact, in metres: a lower bound.
#[inline]
pub(crate) fn beyond(at_least: f64, reach: f64) -> f32 {
    round_down(at_least - reach).max(0.0)
}

asunder_geometry::copied!(Batch<M>, for [M: Clone], { answers, manifolds } but {});

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

    /// Appends an answer; for shapes that met, with the manifolds from `first` on.
    pub(crate) fn push(&mut self, hint: Hint, met: Met, first: u32) {
        self.answers.push(match met {
            Err(beyond) => Answer::Apart { hint, beyond },
            Ok(overlapping) => {
                Answer::Contact { hint, overlapping, manifolds: first..self.manifolds.len() as u32 }
            }
        });
    }
}
