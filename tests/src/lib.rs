//! The oracles for asunder's answers: slow, plain, and made without its algorithms.
//!
//! - [`answers`]: what the narrow phase reports for a case, measured by full projections of our own
//! - [`bare_triangles`]: how far a body is from ground, triangle by triangle
//! - [`brute_pairs`]: every overlapping pair of AABBs, by a double loop
//! - [`solid`]: facets and edges of a hull, from its vertices alone, decided exactly
//! - [`placed`]: posed shapes in f64
//! - [`exhaustive_sat`]: the separation along every candidate axis, without early outs
//! - [`exhaustive_distance`]: the distance over every pair of features
//! - [`exact_overlap`]: whether two shapes share a point, proved over integers ([`exact`] holds its parts)
//! - [`precise`]: the separation of two shapes in double-double, with its own error
//! - [`cores`]: the separation of bodies of any kind, piece by piece: rounded cores, half-spaces, compounds
//! - [`bodies`]: pairs of such bodies, queried as in [`answers`]
//! - [`shapes`]: seeded shapes of every kind, and pairs of them in every kind of relative pose
//! - [`cases`]: seeded shapes, poses and pairs, far apart, deep, and touching
//! - [`exact_plane`]: areas, crossings and containment in the plane, over integers
//! - [`outlines`]: seeded outlines, simple and not: stars, combs, spirals, lattices, slivers
//! - [`fuzzed`]: hulls, polygons and outlines from raw bytes, and the checks on them; `fuzz/` runs the same
//! - [`report`]: hard cases, family by family: what we and parry3d get wrong, and at what cost
//! - [`solver`]: a small rigid-body solver, for bodies that have to stand on our manifolds
//! - [`counting`]: an allocator that counts
//! - [`recorded`]: the named worlds, played frame by frame, and a hash of what they report
//! - [`rolling`]: bodies that roll, fall, hop and creep over ground, played in the same way
//! - [`engine`], [`played`]: one trait for both worlds, and for the operations on them
//! - [`judged`], [`naive_world`]: which bodies touch, by [`cores`] and [`exact_overlap`] alone, and a naive model of a
//!   world based on that
//!
//! Every oracle works from stored vertices and poses alone. Where two of them can answer one question they are first
//! compared with each other (`tests/suite/oracles.rs`).
#![deny(missing_docs)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a judge that cannot judge must stop the test")]

pub mod answers;
pub mod bare_triangles;
pub mod bodies;
pub mod brute_pairs;
pub mod cases;
pub mod cores;
pub mod counting;
pub mod engine;
pub mod exact;
pub mod exact_overlap;
pub mod exact_plane;
pub mod exhaustive_distance;
pub mod exhaustive_sat;
pub mod fuzzed;
pub mod integers;
pub mod judged;
pub mod naive_world;
pub mod outlines;
pub mod placed;
pub mod played;
pub mod precise;
pub mod recorded;
pub mod report;
pub mod rolling;
pub mod shapes;
pub mod solid;
pub mod solver;

/// The guide's pages: their examples must run.
#[cfg(doctest)]
mod guide {
    #[doc = include_str!("../../crates/asunder/guide/game-loops.md")]
    struct GameLoops;
    #[doc = include_str!("../../crates/asunder/guide/events.md")]
    struct Events;
    #[doc = include_str!("../../crates/asunder/guide/determinism.md")]
    struct Determinism;
    #[doc = include_str!("../../crates/asunder/guide/margins.md")]
    struct Margins;
    #[doc = include_str!("../../crates/asunder/guide/queries.md")]
    struct Queries;
    #[doc = include_str!("../../crates/asunder/guide/characters.md")]
    struct Characters;
    #[doc = include_str!("../../crates/asunder/guide/levels.md")]
    struct Levels;
    #[doc = include_str!("../../crates/asunder/guide/solvers.md")]
    struct Solvers;
    #[doc = include_str!("../../crates/asunder/guide/solvers-3d.md")]
    struct Solvers3d;
    #[doc = include_str!("../../crates/asunder/guide/units.md")]
    struct Units;
}
