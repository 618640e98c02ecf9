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

/// How two shapes of a job are to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Proximity {
    /// Within the margin.
    Within { overlapping: bool },
    /// Beyond it, by at least that many metres.
    Beyond(f32),
}

impl Proximity {
    /// Whether they overlap, of shapes within the margin; nothing is known of others.
    pub(crate) fn of(found: Option<bool>) -> Self {
        found.map_or(Self::Beyond(0.0), |overlapping| Self::Within { overlapping })
    }
}

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

    /// Appends an answer; for shapes within the margin, with the manifolds from `first` on.
    pub(crate) fn push(&mut self, hint: Hint, proximity: Proximity, first: u32) {
        self.answers.push(match proximity {
            Proximity::Beyond(beyond) => Answer::Apart { hint, beyond },
            Proximity::Within { overlapping } => {
                Answer::Contact { hint, overlapping, manifolds: first..self.manifolds.len() as u32 }
            }
        });
    }
}
