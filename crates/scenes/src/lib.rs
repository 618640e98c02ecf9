//! Seeded, named scenes, shared by tests, benches and examples.
//!
//! A scene is a function of its name, its size and its seed, and of nothing else: the generator is PCG by `oorandom`,
//! trigonometry is by `libm`, sums run in a fixed order. Equal arguments give equal bits on every machine.
//!
//! - [`boxes`]: moving boxes for a broad phase.
//! - [`hard`]: pairs on which collision tests go wrong, family by family.
//! - [`hurt`]: boxes laid out to make a broad phase slow.
//! - [`level`]: scene files.
//! - [`pairs`]: posed pairs of shapes for a narrow phase.
//! - [`stages`]: scenes with masses, speeds and things that are driven, for a solver to play.
//! - [`terrain`]: hills of triangles.
//! - [`worlds`]: bodies with simple motion, or with recorded poses, for a whole frame.
#![deny(missing_docs)]

pub mod boxes;
pub mod hard;
pub mod hurt;
pub mod level;
pub mod pairs;
pub mod random;
pub mod stages;
pub mod terrain;
mod turn;
pub mod worlds;
