//! The guide: one page for each task of a game.
//!
//! | page | about |
//! |---|---|
//! | [`game_loops`] | the calls of a frame, threads, fast bodies and bullets, debug builds |
//! | [`events`] | which contacts began and ended, which bodies meet, hooks |
//! | [`queries`] | ray casts, shape casts, overlap tests, nearest bodies, filters |
//! | [`characters`] | walking along walls, up steps and down slopes |
//! | [`levels`] | triangle meshes, height fields and chains; ghost collisions; hulls against meshes |
//! | [`margins`] | how large a margin should be |
//! | [`solvers`] | a complete small solver, and what a solver needs from contacts |
//! | [`solvers_3d`] | the same solver for space |
//! | [`determinism`] | equal bits everywhere, rollback, save games |
//! | [`units`] | units, ranges, shapes in other sizes |

#[doc = include_str!("../guide/game-loops.md")]
pub mod game_loops {}

#[doc = include_str!("../guide/events.md")]
pub mod events {}

#[doc = include_str!("../guide/queries.md")]
pub mod queries {}

#[doc = include_str!("../guide/characters.md")]
pub mod characters {}

#[doc = include_str!("../guide/levels.md")]
pub mod levels {}

#[doc = include_str!("../guide/margins.md")]
pub mod margins {}

#[doc = include_str!("../guide/solvers.md")]
pub mod solvers {}

#[doc = include_str!("../guide/solvers-3d.md")]
pub mod solvers_3d {}

#[doc = include_str!("../guide/determinism.md")]
pub mod determinism {}

#[doc = include_str!("../guide/units.md")]
pub mod units {}
