//! Benchmarks: our time beside parry3d's, in one process, on the same scenes.
//!
//! Machines are shared, so only ratios within one run count. Therefore the variants of a row take turns, frame by frame
//! or block by block; times are CPU times of the thread; figures are medians. A row stops after about a second per
//! variant and reports how far it came.
//!
//! - [`broad`]: all overlapping pairs of moving boxes, beside parry3d's `Bvh`.
//! - [`narrow`]: one query for many pairs of shapes, beside parry3d's queries; [`flat`] is its twin in the plane, which
//!   has no peer here. A [`judge`] knows the true separations, with which [`accuracy`] compares both sides.
//! - [`certain`]: yes or no that is never wrong, beside the first tier alone.
//! - [`error`]: speed against error, on easy and hard pairs, beside textbook SAT and parry3d in f32 and f64; stability;
//!   time against vertices.
//! - [`shapes`]: every pair of shapes, and queries of a single one.
//! - [`world`]: whole frames, beside the [`lean`] pipeline over parry3d.
//! - [`mesh`]: bodies, queries and casts on triangle meshes, beside parry3d's `TriMesh`.
//!
//! [`report`] makes a page from [`error`], [`broad`] and [`world`]: speed against error.
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
