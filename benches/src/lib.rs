//! The judge: our time beside parry3d's, in one process, on the same scenes.
//!
//! Machines are shared, and only ratios inside one run count. Therefore variants of a row take turns, frame by frame or
//! block by block; time is that of the thread's CPU; figures are medians. A row stops after about a second a variant
//! and says how far it came.
//!
//! - [`broad`]: all overlapping pairs of moving boxes, beside parry3d's `Bvh`.
//! - [`narrow`]: one question about many pairs of shapes, beside parry3d's queries; [`flat`] is its twin in the plane,
//!   which has no peer here. A [`judge`] knows the true separations, and [`accuracy`] holds both sides against them.
//! - [`certain`]: yes or no that is never wrong, beside the first tier alone.
//! - [`error`]: speed against error, on easy pairs and hard ones, beside textbook SAT and parry3d in f32 and f64;
//!   steadiness; time against vertices.
//! - [`shapes`]: every pair of shapes, and what is asked of one alone.
//! - [`world`]: whole frames, beside the [`lean`] pipeline over parry3d.
//! - [`mesh`]: bodies, questions and casts on triangle meshes, beside parry3d's `TriMesh`.
//!
//! [`report`] makes a page of [`error`], [`broad`] and [`world`]: speed against error.
#![deny(missing_docs)]

pub mod accuracy;
pub mod blocks;
pub mod broad;
pub mod certain;
pub mod clock;
pub mod error;
pub mod flat;
pub mod judge;
pub mod lean;
pub mod mesh;
pub mod narrow;
pub mod parry;
pub mod race;
pub mod report;
pub mod row;
pub mod shapes;
pub mod world;
