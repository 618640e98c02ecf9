//! Recording a game, and replaying it: poses are set as they were recorded, and nothing is solved.

use crate::game::Game;
use crate::playable::Playable;
use crate::recording::{Head, Numbers, RecordError, Step, read_step, write_head, write_step};
use crate::report::{Times, bar};
use asunder::{AnyWorld, World};
use std::error::Error;
use std::io::{Read, Write};

/// Records a game, step by step.
pub struct Recorder<S: Playable, W: Write> {
    to: W,
    /// The pose of each body as of the last step; `None` for one that has left.
    last: Vec<Option<S::Pose>>,
}

impl<S: Playable, W: Write> Recorder<S, W> {
    /// Begins a recording with the game's bodies as they are.
    ///
    /// # Errors
    /// As [`write_head`].
    pub fn new(mut to: W, head: &Head, game: &Game<S>) -> Result<Self, RecordError> {
        write_head(&mut to, head)?;
        Ok(Self { to, last: (0..game.len()).map(|number| pose(game, number)).collect() })
    }

    /// Writes the step that the game has just done.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn record(&mut self, game: &Game<S>) -> Result<(), RecordError> {
        let (mut moved, mut left) = (Vec::new(), Vec::new());
        for (number, last) in self.last.iter_mut().enumerate() {
            let now = pose(game, number);
            match (&*last, now) {
                (Some(before), Some(now))
                    if !before.numbers().map(f64::to_bits).eq(now.numbers().map(f64::to_bits)) =>
                {
                    moved.push((number as u32, now));
                }
                (Some(_), None) => left.push(number as u32),
                _ => {}
            }
            *last = now;
        }
        let (contacts, overlapping) = count_contacts(&game.stepper.world);
        write_step(&mut self.to, &Step::<S> { moved, left, contacts, overlapping })
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn finish(mut self) -> Result<(), RecordError> {
        Ok(self.to.flush()?)
    }
}

fn pose<S: Playable>(game: &Game<S>, number: usize) -> Option<S::Pose> {
    game.key(number).and_then(|key| game.stepper.world.get(key)).map(|body| *S::pose_of(body))
}

/// How many contacts there are at the bodies' poses, and how many of those overlap.
fn count_contacts<S: Playable>(world: &World<S>) -> (u32, u32) {
    let near = world.contacts().filter(|contact| !contact.speculative);
    near.fold((0, 0), |(near, overlapping), contact| (near + 1, overlapping + u32::from(contact.overlapping)))
}

/// Plays at most `steps` steps of a recording, and returns what they cost. The game must be that of the recording's
/// scene; only its world is used. Reading is not timed.
///
/// # Errors
/// What is wrong with the recording; a number of bodies or contacts other than recorded, which means that the scene,
/// the engine or the file has changed.
pub fn replay<S: Playable>(
    game: &mut Game<S>,
    from: &mut impl Read,
    head: &Head,
    steps: u32,
) -> Result<Times, Box<dyn Error>> {
    if game.len() != head.bodies as usize {
        let (here, there) = (game.len(), head.bodies);
        return Err(format!("the scene has {here} bodies, and the recording is of one with {there}").into());
    }
    let mut times = Times::default();
    let shown = bar(u64::from(steps));
    game.stepper.world.update();
    let mut number = 0;
    while number < steps {
        let Some(step) = read_step::<S>(from, head)? else { break };
        number += 1;
        let set = |game: &mut Game<S>| {
            for &(body, pose) in &step.moved {
                // A stale key is a body that has left the level: there is nothing to move.
                let _ = game.key(body as usize).map(|key| game.stepper.world.set_pose(key, pose));
            }
            for &body in &step.left {
                if let Some(key) = game.key(body as usize) {
                    game.stepper.world.remove(key);
                }
            }
            game.stepper.world.update();
        };
        times.measure(game, |game| game.stepper.world.stats(), set);
        let found = count_contacts(&game.stepper.world);
        if found != (step.contacts, step.overlapping) {
            return Err(format!(
                "step {number}: {} contacts, {} overlapping; the recording has {} and {}",
                found.0, found.1, step.contacts, step.overlapping
            )
            .into());
        }
        shown.inc(1);
    }
    shown.finish_and_clear();
    Ok(times)
}
