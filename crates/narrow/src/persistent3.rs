//! Manifolds in space that are moved along: see `persistent` for two solids, `grounded` for a body on ground.

mod flat;
mod grip;
mod grounded;
mod hold;
mod solids;
mod witness;

use crate::answer::{Answer, Manifold3};
use crate::jobs3::Job3;
use crate::persistent::widest_reach_of;
use asunder_geometry::{Ground, Pose3};
use grounded::{Grounded, Memory};
use solids::Solids;

/// Manifolds, and the poses of their two bodies when they were computed: until they drift against each other, they are
/// moved along for a fraction of the cost of new ones.
///
/// Bodies at rest are never quite still. As long as no point of one has moved against the other by more than 2^-15 of
/// the smaller bounding radius (2^-10 where they rest on a broad patch), the manifold is reused: the same points of the
/// same features, with separations and the normal updated. It is certain that the shapes still overlap, or are still
/// within the margin, as before; a pair too close to either limit for that is not kept at all.
///
/// On ground made of triangles this holds for all manifolds of a body of one part, up to 2^-8 of its radius, and no
/// further than the margin; the ground must not have moved at all.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Batch3, Hint, Job3, Persistent3, Spare3, collide3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::at([0.5, 0.25, 1.875])?);
/// let job = Job3 {
///     shape_a: &cube, pose_a: &pose_a, shape_b: &cube, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE,
///     ahead: 0.0, sensor: false,
/// };
/// let mut batch = Batch3::default();
/// collide3(&[job], &mut batch);
/// let persistent = Persistent3::of(&job, &batch.answers[0], &batch.manifolds).expect("a face carries it");
///
/// let mut moved = Vec::new();
/// let sunk = Pose3::at([0.5, 0.25, 1.875 - 4e-6])?;
/// assert!(persistent.carry_on([&pose_a, &sunk], &mut moved) && persistent.overlapping());
/// assert!(persistent.reach() > 1e-3 && persistent.reach() <= Persistent3::most_reach(&job));
/// assert_eq!(Persistent3::lasting(&job, &batch.answers[0], &batch.manifolds, 0.1, &mut Spare3::default()), None, "bodies as fast as that");
/// assert!((moved[0].points[0].separation + 0.125 + 4e-6).abs() < 1e-8);
/// assert!(persistent.manifolds().all(|then| then.points[0].feature == moved[0].points[0].feature));
/// let gone = Pose3::at([0.5, 0.25, 1.875 - 4e-3])?;
/// assert!(!persistent.carry_on([&pose_a, &gone], &mut moved), "too far: it must be made anew");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Persistent3(Kind);

impl Clone for Persistent3 {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }

    fn clone_from(&mut self, source: &Self) {
        match (&mut self.0, &source.0) {
            (Kind::Grounded(own), Kind::Grounded(source)) => own.clone_from(source),
            (own, source) => *own = source.clone(),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Kind {
    Solids(Solids),
    Grounded(Grounded),
}

/// Memory of manifolds that are no longer kept, for reuse by later ones: so a steady frame allocates nothing.
///
/// ```
/// use asunder_geometry::{Cuboid, HeightField, Pose3, Shape3, glam::{Vec2, Vec3}};
/// use asunder_narrow::{Batch3, Hint, Job3, Persistent3, Spare3, collide3};
/// let floor = Shape3::from(HeightField::new(3, 3, vec![0.0; 9], Vec2::ONE)?);
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5))?);
/// let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::at([0.1, 0.499, 0.2])?);
/// let job = Job3 {
///     shape_a: &floor, pose_a: &pose_a, shape_b: &cube, pose_b: &pose_b, margin: 0.02, hint: Hint::NONE,
///     ahead: 0.0, sensor: false,
/// };
/// let (mut batch, mut spare) = (Batch3::default(), Spare3::default());
/// collide3(&[job], &mut batch);
/// let mut kept = Persistent3::lasting(&job, &batch.answers[0], &batch.manifolds, 0.0, &mut spare).expect("it lies still");
/// let slid = Pose3::at([0.102, 0.499, 0.2])?;
/// assert!(kept.carry_on([&pose_a, &slid], &mut batch.manifolds), "by two millimetres");
/// spare.take(&mut kept);
/// assert!(!spare.is_empty());
/// let mut other = Spare3::default();
/// spare.lend(&mut other);
/// assert!(spare.is_empty() && !other.is_empty());
/// assert!([slid, pose_b].iter().all(|pose| !kept.carry_on([&pose_a, pose], &mut batch.manifolds)), "nor where it was");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Spare3(Vec<Memory>);

impl Spare3 {
    /// Takes the memory of manifolds that are no longer kept; these can then not be moved along. Manifolds of solids
    /// have none to take. Cost: constant.
    pub fn take(&mut self, kept: &mut Persistent3) {
        if let Kind::Grounded(kept) = &mut kept.0 {
            self.0.push(kept.take_memory());
        }
    }

    /// Moves the memory of this store to another one that has none. Cost: constant.
    ///
    /// ```
    /// use asunder_narrow::Spare3;
    /// let (mut all, mut own) = (Spare3::default(), Spare3::default());
    /// all.lend(&mut own);
    /// assert!(own.is_empty(), "there was none");
    /// ```
    pub fn lend(&mut self, to: &mut Self) {
        if to.is_empty() {
            to.0.extend(self.0.pop());
        }
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Persistent3 {
    /// The persistent manifolds of an answer to a job; `manifolds` are those of the answer's batch.
    ///
    /// `None` where the bodies are beyond the margin, or so close to it or to touching that rounding may have decided;
    /// where solids touch in several parts; where points are neither on a face, nor where two edges cross, nor, between
    /// single solids, across a gap from each other. On ground, also for compounds and half-spaces, and where a point is
    /// between corners, or a corner and an edge. Cost: some square roots, and linear in the vertices of a face; on
    /// ground that of finding the triangles near the points.
    pub fn of(job: &Job3<'_>, answer: &Answer, manifolds: &[Manifold3]) -> Option<Self> {
        Self::made((job, answer, manifolds), &mut Spare3::default())
    }

    /// The same, for bodies that moved by `step` metres in the last frame: `None` if bodies that continue at that speed
    /// would have drifted too far by the next.
    pub fn lasting(
        job: &Job3<'_>,
        answer: &Answer,
        manifolds: &[Manifold3],
        step: f64,
        spare: &mut Spare3,
    ) -> Option<Self> {
        if step > f64::from(Self::most_reach(job)) {
            return None;
        }
        let mut made = Self::made((job, answer, manifolds), spare)?;
        if step > f64::from(made.reach()) {
            spare.take(&mut made);
            return None;
        }
        Some(made)
    }

    fn made(found: (&Job3<'_>, &Answer, &[Manifold3]), spare: &mut Spare3) -> Option<Self> {
        let (job, answer, manifolds) = found;
        if Ground::of(job.shape_a).is_none() && Ground::of(job.shape_b).is_none() {
            return Solids::of(job, answer, manifolds).map(|kept| Self(Kind::Solids(kept)));
        }
        // Bodies in motion do not stay.
        if job.ahead > 0.0 {
            return None;
        }
        let mut memory = spare.0.pop().unwrap_or_default();
        let kept = Grounded::of(job, answer, manifolds, &mut memory);
        if kept.is_none() {
            spare.0.push(memory);
        }
        kept.map(|kept| Self(Kind::Grounded(kept)))
    }

    /// The largest drift up to which manifolds of this job can be moved along, in metres.
    pub fn most_reach(job: &Job3<'_>) -> f32 {
        let radii = [job.shape_a.outer_radius(), job.shape_b.outer_radius()];
        grounded::most_reach(job).unwrap_or_else(|| widest_reach_of(radii))
    }

    /// The drift up to which these can be moved along, in metres.
    pub fn reach(&self) -> f32 {
        match &self.0 {
            Kind::Solids(kept) => kept.reach(),
            Kind::Grounded(kept) => kept.reach(),
        }
    }

    /// The manifolds as they were computed, bit by bit: one, or on ground one or more.
    pub fn manifolds(&self) -> impl Iterator<Item = Manifold3> {
        let (one, more) = match &self.0 {
            Kind::Solids(kept) => (Some(kept.manifold()), [].as_slice()),
            Kind::Grounded(kept) => (None, kept.manifolds()),
        };
        one.into_iter().chain(more.iter().copied())
    }

    /// Whether the shapes overlapped, as they do for as long as the manifolds are moved along.
    pub fn overlapping(&self) -> bool {
        match &self.0 {
            Kind::Solids(kept) => kept.overlapping(),
            Kind::Grounded(kept) => kept.overlapping(),
        }
    }

    /// The margin that the manifolds were made for, in metres.
    pub fn margin(&self) -> f32 {
        match &self.0 {
            Kind::Solids(kept) => kept.margin(),
            Kind::Grounded(kept) => kept.margin(),
        }
    }

    /// Whether the numbers stored with the manifolds are possible: for data that was read from a file.
    pub fn is_sound(&self) -> bool {
        match &self.0 {
            Kind::Solids(kept) => kept.is_sound(),
            Kind::Grounded(kept) => kept.is_sound(),
        }
    }

    /// Appends the manifolds, moved along to the poses of A and B; returns false if they must be recomputed. Shapes and
    /// margin must be those of the job. Their errors include the effect of the drift. Cost: linear in the points, least
    /// where no body turned.
    pub fn carry_on(&self, poses: [&Pose3; 2], to: &mut Vec<Manifold3>) -> bool {
        match &self.0 {
            Kind::Solids(kept) => kept.carry_on(poses, to),
            Kind::Grounded(kept) => kept.carry_on(poses, to),
        }
    }
}

#[cfg(all(test, target_pointer_width = "64"))]
mod tests {
    use super::*;

    /// A frame of bodies at rest reads each of them, and waits for memory: see `Solids`.
    #[test]
    fn what_is_kept_takes_four_lines_of_memory() {
        assert!(size_of::<Persistent3>() <= 256, "{}", size_of::<Persistent3>());
    }
}
