//! What the larger examples share: a rigid-body stepper around the engine's worlds, a game on top of it, and pictures.
//!
//! Nothing here is part of the engine, and all of it uses only the engine's public interface.
//!
//! ```
//! use asunder::glam::{DVec3, Vec3};
//! use asunder::{Collider3, Cuboid, HalfSpace, Pose3, Volume};
//! use asunder_examples::game::Game;
//! use asunder_examples::stepper::MARGIN;
//! let mut game = Game::<Volume>::new(DVec3::NEG_Y * 9.81);
//! game.add(Collider3::new(HalfSpace::new(Vec3::Y)?).fixed(), DVec3::ZERO, DVec3::ZERO)?;
//! let cube = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5))?);
//! game.add(cube.at(Pose3::at([0.0, 0.6, 0.0])?).margin(MARGIN)?, DVec3::ZERO, DVec3::ZERO)?;
//! game.update();
//! (0..60).for_each(|_| game.step(1.0 / 60.0));
//! assert!(game.fastest_now() < 0.01 && game.counts.deepest < 0.01, "it lies still");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod falling;
pub mod game;
pub mod opened;
pub mod output;
pub mod picture;
pub mod playable;
pub mod recording;
pub mod replay;
pub mod report;
pub mod stepper;
pub mod things;
pub mod trials;
