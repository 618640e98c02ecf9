//! A game that is being watched: its steps, the body in the user's hand, and the text of the panel.

use crate::sight::Sight;
use crate::stand::Stand;
use crate::toggles::Toggles;
use crate::view::View;
use asunder::glam::DVec3;
use asunder::{AnyWorld, Plane, Volume};
use asunder_examples::game::Game;
use asunder_examples::opened::{plane, volume};
use asunder_examples::playable::InSpace;
use asunder_examples::report::{STEP, Times, stages};
use asunder_scenes::stages::Scene;
use core::time::Duration;
use std::error::Error;
use std::time::Instant;

/// How fast a held body goes to the hand: the share of the distance per second.
const PULL: f64 = 10.0;
/// The greatest speed of a held body, in m/s.
const FASTEST: f64 = 60.0;

/// A game of either dimension, as seen by the window.
pub(crate) trait Show {
    /// Does one step of 1/60 s; a held body goes towards the hand.
    fn step(&mut self, hand: Option<DVec3>);
    /// Draws a frame.
    fn draw(&mut self, view: &View, toggles: &Toggles);
    /// The lines of the panel.
    fn report(&self) -> Vec<String>;
    /// Takes hold of the body first seen along a ray, if it can be moved, and returns the point.
    fn hold(&mut self, ray: (DVec3, DVec3)) -> Option<DVec3>;
    /// Lets go of the held body.
    fn release(&mut self);
    /// Where the held point of the body is now.
    fn held(&self) -> Option<DVec3>;
    /// The box that the picture should show.
    fn bounds(&self) -> (DVec3, DVec3);
    /// Whether this is a game in the plane.
    fn is_flat(&self) -> bool;
}

/// Opens a scene.
///
/// # Errors
/// A body that moves and has no mass.
pub(crate) fn show(scene: &Scene) -> Result<Box<dyn Show>, Box<dyn Error>> {
    Ok(match scene {
        Scene::Plane(scene) => {
            let driven = scene.drivers.iter().map(|driver| driver.body as usize).collect();
            Box::new(Player::<Plane>::new(plane(scene)?, driven, scene.room))
        }
        Scene::Volume(scene) => {
            let driven = scene.drivers.iter().map(|driver| driver.body as usize).collect();
            Box::new(Player::<Volume>::new(volume(scene)?, driven, scene.room))
        }
    })
}

struct Player<S: Sight> {
    game: Game<S>,
    stand: Stand<S>,
    times: Times,
    held: Option<Held>,
    /// The time it took to draw the last frame.
    drawing: Duration,
}

struct Held {
    number: usize,
    /// From the centre of mass to the point at which it is held.
    offset: DVec3,
}

impl<S: Sight> Player<S> {
    fn new(mut game: Game<S>, driven: Vec<usize>, (low, high): (impl InSpace, impl InSpace)) -> Self {
        game.update();
        let stand = Stand::new(&game, driven, (low.in_space(), high.in_space()));
        Self { game, stand, times: Times::default(), held: None, drawing: Duration::ZERO }
    }
}

impl<S: Sight> Show for Player<S> {
    fn step(&mut self, hand: Option<DVec3>) {
        if let (Some(held), Some(hand), Some(place)) = (&self.held, hand, self.held()) {
            let velocity = ((hand - place) * PULL).clamp_length_max(FASTEST);
            self.game.set_velocity(held.number, S::within(velocity));
        }
        // The panel shows the last step alone.
        self.times = Times::default();
        self.times.measure(&mut self.game, |game| game.stepper.world.stats(), |game| game.step(STEP));
    }

    fn draw(&mut self, view: &View, toggles: &Toggles) {
        let start = Instant::now();
        self.stand.draw(&self.game, view, toggles);
        self.drawing = start.elapsed();
    }

    fn report(&self) -> Vec<String> {
        let (stats, (awake, asleep)) = (self.game.stepper.world.stats(), self.game.awake_and_asleep());
        let ms = |time| self.times.mean(time);
        let mut lines = vec![
            format!("step {}", self.game.steps()),
            format!("{} bodies: {awake} awake, {asleep} asleep", stats.bodies),
            format!("{} pairs, {} contacts, {} overlap", stats.candidates, stats.contacts, stats.overlapping),
            format!("whole step {:7.2} ms", ms(self.times.all)),
            format!("  solver   {:7.2} ms", ms(self.times.all.saturating_sub(self.times.updates()))),
        ];
        lines.extend(stages(stats).iter().map(|(name, time)| format!("  {name:<8} {:7.2} ms", ms(*time))));
        lines.push(format!("drawing    {:7.2} ms", self.drawing.as_secs_f64() * 1e3));
        if let Some(note) = self.stand.note() {
            lines.push(note);
        }
        lines
    }

    fn hold(&mut self, (from, direction): (DVec3, DVec3)) -> Option<DVec3> {
        let (key, place) = S::pick(&self.game.stepper.world, from, direction, self.stand.hidden())?;
        let number = self.game.stepper.number(key)?;
        if self.stand.is_driven(number) || self.game.stepper.world.get(key)?.is_fixed() {
            return None;
        }
        self.held = Some(Held { number, offset: place - self.game.center(number)? });
        Some(place)
    }

    fn release(&mut self) {
        self.held = None;
    }

    fn held(&self) -> Option<DVec3> {
        let held = self.held.as_ref()?;
        Some(self.game.center(held.number)? + held.offset)
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        self.stand.bounds()
    }

    fn is_flat(&self) -> bool {
        S::FLAT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_scenes::stages::Stage;

    #[test]
    fn a_body_is_pulled_to_the_hand_and_keeps_its_speed_when_let_go() {
        for stage in [Stage::Stack, Stage::Letters] {
            let Ok(mut player) = show(&stage.build(5, 1)) else { panic!("it opens") };
            let (low, high) = player.bounds();
            let mut found = None;
            // Casts a ray from the front through each point of a lattice over the scene.
            for i in 0..400 {
                let share = DVec3::new(f64::from(i % 20) / 20.0, f64::from(i / 20) / 20.0, 0.5);
                let through = low + (high - low) * share;
                found = found.or_else(|| player.hold((through + DVec3::Z * 50.0, DVec3::NEG_Z)));
            }
            let Some(place) = found else { panic!("{stage:?}: something is hit") };
            let hand = place + DVec3::new(1.0, 3.0, 0.0);
            (0..120).for_each(|_| player.step(Some(hand)));
            let near = player.held().map_or(f64::INFINITY, |held| held.distance(hand));
            assert!(near < 0.2, "{stage:?}: {near} m away");
            player.release();
            assert!(player.held().is_none());
        }
    }
}
