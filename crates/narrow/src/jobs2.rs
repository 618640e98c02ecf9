//! Batches of pairs in the plane.

use crate::batch::{Batch2, Proximity};
use crate::feature::Hint;
use crate::pair2::Pair2;
use asunder_geometry::{Pose2, Shape2};

/// One pair of a batch: whether the shapes are within the margin of each other, and how they touch.
#[derive(Clone, Copy, Debug)]
pub struct Job2<'a> {
    /// Shape of A.
    pub shape_a: &'a Shape2,
    /// Pose of A.
    pub pose_a: &'a Pose2,
    /// Shape of B.
    pub shape_b: &'a Shape2,
    /// Pose of B.
    pub pose_b: &'a Pose2,
    /// Metres of gap within which a contact is wanted.
    pub margin: f32,
    /// The hint of the last answer for this pair, or [`Hint::NONE`].
    pub hint: Hint,
    /// By how many metres of the margin motions may bring the two nearer: then ground that is within this distance, but
    /// only further along beyond a bend, has manifolds as well. Zero where nothing moves.
    pub ahead: f32,
    /// Whether to leave out manifolds.
    pub sensor: bool,
}

/// Answers a slice of jobs, appending to the batch. Jobs do not influence each other.
///
/// ```
/// use asunder_geometry::{Rect, Pose2, Shape2, glam::Vec2};
/// use asunder_narrow::{Answer, Batch2, Hint, Job2, collide2};
/// let square = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
/// let (pose_a, pose_b) = (Pose2::IDENTITY, Pose2::at(Vec2::new(0.0, 1.5))?);
/// let job = Job2 {
///     shape_a: &square, pose_a: &pose_a, shape_b: &square, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE,
///     ahead: 0.0, sensor: false,
/// };
/// let mut batch = Batch2::default();
/// collide2(&[job], &mut batch);
/// assert!(matches!(&batch.answers[0], Answer::Contact { overlapping: true, manifolds, .. } if *manifolds == (0..1)));
/// batch.clear();
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn collide2(jobs: &[Job2<'_>], batch: &mut Batch2) {
    for job in jobs {
        let pair = Pair2::new(job.shape_a, job.pose_a, job.shape_b, job.pose_b);
        let first = batch.manifolds.len() as u32;
        let manifolds = &mut batch.manifolds;
        let (hint, proximity) = if pair.has_ground() {
            let overlapping = pair.contact_on_ground([job.margin, job.ahead], manifolds);
            if job.sensor {
                manifolds.truncate(first as usize);
            }
            (Hint::NONE, Proximity::of(overlapping))
        } else {
            pair.contact(job.margin, job.hint, !job.sensor, |manifold| manifolds.push(manifold))
        };
        batch.push(hint, proximity, first);
    }
}
