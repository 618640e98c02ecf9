//! Frame after frame, each with what the last one left.

use super::BLOCK;
use super::both::{Both, Manifolds, of_answer, of_peer};
use crate::accuracy::Said;
use crate::clock::{Effort, time};
use crate::race::Race;
use crate::row::Row;
use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
use core::borrow::Borrow;

/// Frames that a pair at rest is asked about with what the last one left; the first is not timed.
const REST_FRAMES: usize = 6;

fn steps(frames: usize) -> usize {
    if frames == 1 { REST_FRAMES } else { frames }
}

/// Times all frames, blocks of pairs in turns; the first frame of a block is not timed.
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

/// Both sides' answers in every frame, frame by frame, to be judged; of a pair at rest, the last.
pub(super) fn said(frames: &[Vec<&Both>]) -> (Vec<Said>, Vec<Said>) {
    let (mut ours, mut peer) = (Vec::new(), Vec::new());
    let mut memory = Memory::new(frames.first().map_or(0, Vec::len));
    for step in 0..steps(frames.len()) {
        let block = &frames[step % frames.len()];
        memory.ask_ours(block);
        memory.ask_peer(block);
        if step + frames.len() >= steps(frames.len()) {
            let batch = &memory.batch;
            ours.extend(batch.answers.iter().map(|answer| of_answer(answer, false, &batch.manifolds)));
            peer.extend(memory.manifolds.iter().map(of_peer));
        }
    }
    (ours, peer)
}

/// What either side remembers of a block of pairs.
struct Memory {
    hints: Vec<Hint>,
    batch: Batch3,
    manifolds: Vec<Manifolds>,
}

impl Memory {
    fn new(count: usize) -> Self {
        let manifolds = (0..count).map(|_| Vec::new()).collect();
        Self { hints: vec![Hint::NONE; count], batch: Batch3::default(), manifolds }
    }

    fn ask_ours<B: Borrow<Both>>(&mut self, block: &[B]) -> f32 {
        let jobs: Vec<Job3<'_>> =
            block.iter().zip(&self.hints).map(|(both, &hint)| both.borrow().job(hint, false)).collect();
        self.batch.clear();
        collide3(&jobs, &mut self.batch);
        for (kept, answer) in self.hints.iter_mut().zip(&self.batch.answers) {
            let (Answer::Apart { hint } | Answer::Contact { hint, .. }) = answer;
            *kept = *hint;
        }
        self.batch.manifolds.iter().flat_map(|manifold| &manifold.points).map(|point| point.separation).sum()
    }

    fn ask_peer<B: Borrow<Both>>(&mut self, block: &[B]) -> f32 {
        let pairs = block.iter().zip(&mut self.manifolds);
        pairs.map(|(both, manifolds)| both.borrow().peer_manifolds(manifolds)).sum()
    }
}
