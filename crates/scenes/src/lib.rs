//! Seeded, named scenes, shared by tests, benches and examples.
//!
//! A scene is a function of its name, its size and its seed alone: random numbers are PCG by `oorandom`, trigonometry
//! is by `libm`, and sums run in a fixed order. Equal arguments give equal bits on every machine.
//!
//! - [`boxes`]: moving boxes for a broad phase.
//! - [`hard`]: families of pairs on which collision tests go wrong.
//! - [`hurt`]: boxes laid out to make a broad phase slow.
//! - [`level`]: scene files.
//! - [`pairs`]: posed pairs of shapes for a narrow phase.
//! - [`stages`]: scenes with masses, velocities and driven bodies, for a solver to step.
//! - [`terrain`]: hills made of triangles.
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
