//! Queries frame after frame, each with the hints of the last.

use super::BLOCK;
use super::both::{Both, Manifolds, of_answer, of_manifolds, of_peer};
use crate::accuracy::Said;
use crate::clock::{Effort, time};
use crate::race::Race;
use crate::row::Row;
use asunder_geometry::{Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Manifold3, Persistent3, Spare3, collide3};
use core::borrow::Borrow;

/// Frames in which a pair at rest is queried with the hints of the last one; the first is not timed.
const REST_FRAMES: usize = 6;

fn steps(frames: usize) -> usize {
    if frames == 1 { REST_FRAMES } else { frames }
}

/// Times all frames, by both sides in turns on blocks of pairs; the first frame of a block is not timed.
pub(super) fn time_frames(frames: &[Vec<Both>], effort: &Effort, row: &mut Row) -> Race {
    let mut race = Race::default();
    let tracks = frames.first().map_or(0, Vec::len);
    let steps = steps(frames.len());
    let rounds = effort.rounds.div_ceil(steps);
    'rounds: for _ in 0..rounds {
        for first in (0..tracks).step_by(BLOCK) {
            let last = (first + BLOCK).min(tracks);
            let mut memory = Memory::new(last - first);
            for step in 0..steps {
                let block = &frames[step % frames.len()][first..last];
                let (ours_ns, _) = time(|| memory.ask_ours(block));
                let (peer_ns, _) = time(|| memory.ask_peer(block));
                if step > 0 {
                    race.ours.push(ours_ns / block.len() as f64, ours_ns);
                    race.peer.push(peer_ns / block.len() as f64, peer_ns);
                }
                row.done += block.len();
                if race.is_spent(effort) {
                    break 'rounds;
                }
            }
        }
    }
    race
}

/// Both sides' answers in every frame, frame by frame, to be judged; for a pair at rest, the last.
pub(super) fn said(frames: &[Vec<&Both>]) -> (Vec<Said>, Vec<Said>) {
    let (mut ours, mut peer) = (Vec::new(), Vec::new());
    let mut memory = Memory::new(frames.first().map_or(0, Vec::len));
    for step in 0..steps(frames.len()) {
        let block = &frames[step % frames.len()];
        memory.ask_ours(block);
        memory.ask_peer(block);
        if step + frames.len() >= steps(frames.len()) {
            ours.extend(memory.said());
            peer.extend(memory.manifolds.iter().map(of_peer));
        }
    }
    (ours, peer)
}

/// What either side remembers of a block of pairs. On our side it is what a world remembers: hints, manifolds that can
/// be moved along with the bodies, and the last poses, which tell whether keeping one pays.
struct Memory {
    kept: Vec<Kept>,
    batch: Batch3,
    /// Manifolds that were kept and moved along.
    moved: Vec<Manifold3>,
    manifolds: Vec<Manifolds>,
}

/// What we remember of a pair.
#[derive(Clone, Default)]
struct Kept {
    hint: Hint,
    persistent: Option<Persistent3>,
    poses: Option<[Pose3; 2]>,
    found: Found,
}

/// Where a pair's answer is.
#[derive(Clone, Copy, Default)]
enum Found {
    #[default]
    Nowhere,
    Moved(usize),
    Answered(usize),
}

/// How far both bodies moved since the last frame. A world computes that once per body, not once per pair.
fn went(last: Option<[Pose3; 2]>, job: &Job3<'_>) -> f64 {
    let Some([a, b]) = last else { return f64::INFINITY };
    let arm = |shape: &Shape3| f64::from(shape.center().length() + shape.outer_radius());
    a.travel(job.pose_a, arm(job.shape_a)) + b.travel(job.pose_b, arm(job.shape_b))
}

impl Memory {
    fn new(count: usize) -> Self {
        let manifolds = (0..count).map(|_| Vec::new()).collect();
        Self { kept: vec![Kept::default(); count], batch: Batch3::default(), moved: Vec::new(), manifolds }
    }

    fn ask_ours<B: Borrow<Both>>(&mut self, block: &[B]) -> f32 {
        let Self { kept, batch, moved, .. } = self;
        batch.clear();
        moved.clear();
        let mut jobs: Vec<Job3<'_>> = Vec::with_capacity(block.len());
        for (both, kept) in block.iter().zip(&mut *kept) {
            let job = both.borrow().job(kept.hint, false);
            let persistent = kept.persistent.as_ref();
            if persistent.is_some_and(|persistent| persistent.carry_on([job.pose_a, job.pose_b], moved)) {
                kept.found = Found::Moved(moved.len() - 1);
            } else {
                kept.found = Found::Answered(jobs.len());
                jobs.push(job);
            }
        }
        collide3(&jobs, batch);
        for (both, kept) in block.iter().zip(kept) {
            let last = kept.poses.replace(both.borrow().poses());
            let Found::Answered(index) = kept.found else { continue };
            let (job, answer) = (&jobs[index], &batch.answers[index]);
            let (Answer::Apart { hint, .. } | Answer::Contact { hint, .. }) = answer;
            kept.hint = *hint;
            let is_contact = matches!(answer, Answer::Contact { .. });
            kept.persistent = if is_contact {
                Persistent3::lasting(job, answer, &batch.manifolds, went(last, job), &mut Spare3::default())
            } else {
                None
            };
        }
        let found = batch.manifolds.iter().chain(&*moved);
        found.flat_map(|manifold| &manifold.points).map(|point| point.separation).sum()
    }

    /// Our last answers, pair by pair.
    fn said(&self) -> impl Iterator<Item = Said> + '_ {
        self.kept.iter().map(|kept| match kept.found {
            Found::Nowhere => Said { touching: false, separation: None },
            Found::Moved(index) => of_manifolds(&self.moved[index..=index]),
            Found::Answered(index) => of_answer(&self.batch.answers[index], false, &self.batch.manifolds),
        })
    }

    fn ask_peer<B: Borrow<Both>>(&mut self, block: &[B]) -> f32 {
        let pairs = block.iter().zip(&mut self.manifolds);
        pairs.map(|(both, manifolds)| both.borrow().peer_manifolds(manifolds)).sum()
    }
}
