//! Batches of pairs in space.
//!
//! ```text
//! for each run of jobs:   pairs of cuboids whose bounding spheres meet are put side by side, until there are eight
//!                         all eight are looked at at once
//!                         every job of the run is answered, in order
//! ```

use crate::batch::Batch3;
use crate::feature::Hint;
use crate::pair3::{Pair3, in_place, reach_of};
use crate::polyhedron::cuboids::asked::Contact;
use crate::polyhedron::cuboids::eight::{Eight, LANES};
use crate::polyhedron::cuboids::placed::Posed;
use asunder_geometry::{Pose3, Shape3};

/// One question of a batch: are these within the margin of each other, and how do they touch?
#[derive(Clone, Copy, Debug)]
pub struct Job3<'a> {
    /// Shape of A.
    pub shape_a: &'a Shape3,
    /// Pose of A.
    pub pose_a: &'a Pose3,
    /// Shape of B.
    pub shape_b: &'a Shape3,
    /// Pose of B.
    pub pose_b: &'a Pose3,
    /// Metres of gap within which a contact is wanted.
    pub margin: f32,
    /// What the last answer for this pair left, or [`Hint::NONE`].
    pub hint: Hint,
    /// Whether to leave out manifolds.
    pub sensor: bool,
}

/// Answers a slice of jobs, appending to the batch. Jobs do not influence each other, but cuboids cost less in slices of
/// dozens: eight pairs of them are looked at at a time.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::at(Vec3::new(0.0, 0.0, 1.5))?);
/// let job = Job3 {
///     shape_a: &cube, pose_a: &pose_a, shape_b: &cube, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE, sensor: false,
/// };
/// let mut batch = Batch3::default();
/// collide3(&[job], &mut batch);
/// assert!(matches!(&batch.answers[0], Answer::Contact { overlapping: true, manifolds, .. } if *manifolds == (0..1)));
/// batch.clear();
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn collide3(jobs: &[Job3<'_>], batch: &mut Batch3) {
    if jobs.len() < FEW {
        for job in jobs {
            job.answer(batch);
        }
        return;
    }
    let mut run = Run { eight: Eight::BLANK, ways: [Way::Alone; RUN], count: 0, lanes: 0 };
    let mut rest = jobs;
    while !rest.is_empty() {
        run.gather(rest);
        let (now, later) = rest.split_at(run.count.min(rest.len()));
        run.answer(now, batch);
        rest = later;
    }
}

/// Fewer lanes than this cost less one by one.
const FEW: usize = 3;

/// Most jobs in a run.
const RUN: usize = 32;

/// How a job of a run is answered.
#[derive(Clone, Copy)]
enum Way {
    /// By itself.
    Alone,
    /// Its bounding spheres are too far apart.
    Far,
    /// In a lane.
    Lane(u8),
}

/// Jobs that are answered together.
struct Run {
    eight: Eight,
    ways: [Way; RUN],
    count: usize,
    lanes: usize,
}

impl Run {
    /// Takes jobs until all lanes are full.
    fn gather(&mut self, jobs: &[Job3<'_>]) {
        (self.count, self.lanes) = (0, 0);
        for (job, way) in jobs.iter().zip(&mut self.ways) {
            let reach = reach_of(job.margin);
            *way = match job.cuboids() {
                None => Way::Alone,
                Some(cuboids) if cuboids.are_far(reach) => Way::Far,
                Some(cuboids) => {
                    self.eight.put(self.lanes, &cuboids, reach);
                    self.lanes += 1;
                    Way::Lane(self.lanes as u8 - 1)
                }
            };
            self.count += 1;
            if self.lanes == LANES {
                break;
            }
        }
    }

    /// Answers the jobs that were taken.
    fn answer(&mut self, jobs: &[Job3<'_>], batch: &mut Batch3) {
        let is_wide = self.lanes >= FEW;
        if is_wide {
            self.eight.look();
        }
        for (job, way) in jobs.iter().zip(&self.ways) {
            match way {
                Way::Far => batch.push(job.hint, None, 0),
                Way::Lane(lane) if is_wide => job.answer_from((&self.eight, usize::from(*lane)), batch),
                _ => job.answer(batch),
            }
        }
    }
}

impl<'a> Job3<'a> {
    fn pair(&self) -> Pair3<'a> {
        Pair3::new(self.shape_a, self.pose_a, self.shape_b, self.pose_b)
    }

    /// Both shapes, where they are cuboids.
    #[inline(always)]
    fn cuboids(&self) -> Option<Posed<'a>> {
        let (Shape3::Cuboid(a), Shape3::Cuboid(b)) = (self.shape_a, self.shape_b) else { return None };
        Some(Posed { cuboids: [a, b], poses: [self.pose_a, self.pose_b] })
    }

    /// By itself.
    fn answer(&self, batch: &mut Batch3) {
        let first = batch.manifolds.len() as u32;
        let wanted = (!self.sensor).then_some(&mut batch.manifolds);
        let (hint, overlapping) = self.pair().contact(self.margin, self.hint, wanted);
        batch.push(hint, overlapping, first);
    }

    /// Two cuboids, from one of eight lanes.
    #[inline(always)]
    fn answer_from(&self, lane: (&Eight, usize), batch: &mut Batch3) {
        let Some(cuboids) = self.cuboids() else { return self.answer(batch) };
        let (first, reach) = (batch.manifolds.len() as u32, reach_of(self.margin));
        let contact = match Posed::clear_in(lane, self.hint, self.sensor) {
            Some(contact) => contact,
            None if self.sensor => cuboids.contact_in(lane, reach, self.hint, None),
            None => in_place(&mut batch.manifolds, |manifold| {
                cuboids.contact_in(lane, reach, self.hint, manifold)
            }),
        };
        match contact {
            Contact::Apart(hint) => batch.push(hint, None, first),
            Contact::Touching(hint) => batch.push(hint, Some(true), first),
            Contact::Unclear => self.answer(batch),
        }
    }
}
