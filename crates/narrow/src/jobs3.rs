//! Batches of pairs in space.
//!
//! ```text
//! for each run of jobs:   collect pairs of cuboids whose bounding spheres meet, until there are eight
//!                         test all eight at once, one in each lane
//!                         answer every job of the run, in order
//! ```
//! Tried for hulls, whose code does not fit into the processor's nearest memory: sixteen pairs at a time in three
//! stages, all separations, then all points, then all manifolds. It halves how often code is fetched anew (callgrind),
//! and takes 2 % longer: the data handed from stage to stage costs as much (AMD EPYC, Zen 4, 2026-11-23).

use crate::answer::Separation3;
use crate::batch::{Batch3, Proximity};
use crate::feature::Hint;
use crate::ground3::OnGround;
use crate::pair3::{Pair3, limit_of, reach_of};
use crate::polyhedron::cuboids::eight::{Eight, LANES};
use crate::polyhedron::cuboids::placed::Posed;
use crate::polyhedron::cuboids::queries::Contact;
use crate::room::in_place;
use asunder_geometry::{Pose3, Shape3};

/// One pair of a batch: whether the shapes are within the margin of each other, and how they touch.
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
    /// The hint of the last answer for this pair, or [`Hint::NONE`].
    pub hint: Hint,
    /// By how many metres of the margin motions may bring the two nearer: then ground that is within this distance, but
    /// only further along beyond a bend, has manifolds as well. Zero where nothing moves.
    pub ahead: f32,
    /// Whether to leave out manifolds.
    pub sensor: bool,
}

/// Answers a slice of jobs, appending to the batch. Jobs do not influence each other, but cuboids cost less in slices
/// of dozens: eight pairs of them are tested at a time.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::at(Vec3::new(0.0, 0.0, 1.5))?);
/// let job = Job3 {
///     shape_a: &cube, pose_a: &pose_a, shape_b: &cube, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE,
///     ahead: 0.0, sensor: false,
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
    let (mut run, mut rest) = (Run::BLANK, jobs);
    while !rest.is_empty() {
        run.gather::<false>(rest.iter().map(|job| (job.cuboids(), reach_of(job.margin))));
        let (now, later) = rest.split_at(run.count.min(rest.len()));
        for (job, way) in now.iter().zip(&run.ways) {
            match run.lane(*way) {
                Some(lane) => job.answer_from(lane, batch),
                None if let Way::Far(beyond) = *way => batch.push(job.hint, Proximity::Beyond(beyond), 0),
                None => job.answer(batch),
            }
        }
        rest = later;
    }
}

/// The separations of many pairs, each as [`Pair3::separation`] has it, appended in order. Cuboids cost less in
/// slices of dozens, as in [`collide3`].
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Pair3, separations3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let poses = [1.5, 2.5, 3.5].map(|x| Pose3::at([x, 0.0, 0.0]).unwrap());
/// let pairs = [0, 1, 2].map(|i| Pair3::new(&cube, &Pose3::IDENTITY, &cube, &poses[i]));
/// let mut found = Vec::new();
/// separations3(&pairs, 0.0, &mut found);
/// assert_eq!(found, [0, 1, 2].map(|i| pairs[i].separation(0.0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn separations3(pairs: &[Pair3<'_>], limit: f32, found: &mut Vec<Separation3>) {
    if pairs.len() < FEW {
        found.extend(pairs.iter().map(|pair| pair.separation(limit)));
        return;
    }
    let reach = limit_of(limit);
    let (mut run, mut rest) = (Run::BLANK, pairs);
    while !rest.is_empty() {
        run.gather::<true>(rest.iter().map(|pair| (pair.cuboids(), reach)));
        let (now, later) = rest.split_at(run.count.min(rest.len()));
        for (pair, way) in now.iter().zip(&run.ways) {
            let in_lane = run.lane(*way).zip(pair.cuboids());
            let in_lane = in_lane.and_then(|(lane, cuboids)| cuboids.separation_in(lane, reach));
            found.push(in_lane.unwrap_or_else(|| pair.separation(limit)));
        }
        rest = later;
    }
}

/// With fewer lanes in use, pairs cost less one by one.
const FEW: usize = 3;

/// Most jobs in a run.
const RUN: usize = 32;

/// How a job of a run is answered.
#[derive(Clone, Copy)]
enum Way {
    /// By itself.
    Alone,
    /// Apart by its bounding spheres, by this many metres more than the reach.
    Far(f32),
    /// From a lane.
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
    const BLANK: Self = Self { eight: Eight::BLANK, ways: [Way::Alone; RUN], count: 0, lanes: 0 };

    /// Takes pairs, each with the gap beyond which it is apart, until all lanes are full, and tests them: see
    /// [`Eight::look`].
    #[inline(always)]
    fn gather<'a, const GRADED: bool>(&mut self, pairs: impl Iterator<Item = (Option<Posed<'a>>, f64)>) {
        (self.count, self.lanes) = (0, 0);
        for ((cuboids, reach), way) in pairs.zip(&mut self.ways) {
            *way = match cuboids {
                None => Way::Alone,
                Some(cuboids) if cuboids.are_far(reach) => Way::Far(cuboids.beyond(reach)),
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
        if self.lanes >= FEW {
            self.eight.look::<GRADED>();
        }
    }

    /// The lane that answers a job, if the lanes were tested.
    #[inline(always)]
    fn lane(&self, way: Way) -> Option<(&Eight, usize)> {
        match way {
            Way::Lane(lane) if self.lanes >= FEW => Some((&self.eight, lane.into())),
            _ => None,
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
        let mut wanted = (!self.sensor).then_some(&mut batch.manifolds);
        let pair = self.pair();
        // Only on ground does it matter what the margin is for.
        if self.ahead > 0.0
            && let Some(on) = OnGround::of(&pair)
        {
            let found = pair.contact_on(&on, [self.margin, self.ahead], &mut wanted);
            return batch.push(Hint::NONE, Proximity::of(found), first);
        }
        let (hint, proximity) = pair.contact(self.margin, self.hint, wanted);
        batch.push(hint, proximity, first);
    }

    /// Two cuboids, answered from one of eight lanes.
    #[inline(always)]
    fn answer_from(&self, lane: (&Eight, usize), batch: &mut Batch3) {
        let Some(cuboids) = self.cuboids() else { return self.answer(batch) };
        let (first, reach) = (batch.manifolds.len() as u32, reach_of(self.margin));
        let contact = match cuboids.clear_in(lane, reach, self.hint, self.sensor) {
            Some(contact) => contact,
            None if self.sensor => cuboids.contact_in(lane, reach, self.hint, None),
            None => in_place(&mut batch.manifolds, |manifold| {
                cuboids.contact_in(lane, reach, self.hint, manifold)
            }),
        };
        match contact {
            Contact::Apart(hint, beyond) => batch.push(hint, Proximity::Beyond(beyond), first),
            Contact::Touching(hint) => batch.push(hint, Proximity::Within { overlapping: true }, first),
            Contact::Near(hint) => batch.push(hint, Proximity::Within { overlapping: false }, first),
            Contact::Unclear(hint) => {
                let mut wanted = (!self.sensor).then_some(&mut batch.manifolds);
                let (hint, proximity) = self.pair().general_contact(self.margin, hint, &mut wanted);
                batch.push(hint, proximity, first);
            }
        }
    }
}
