//! What asunder guarantees, and the module that tests it.
//!
//! The oracles
//! - [`oracles`]: the slow oracles of `tests/src` agree with each other and with cases whose answer is known beforehand
//!
//! Geometry
//! - [`refusals`]: whatever is not a convex shape or a pose is rejected, with an error that names the place
//! - [`poses`]: a pose relative to another transforms points as the two do one after the other
//! - [`bounds`]: the AABB of a posed shape contains it, and is no wider than rounding requires
//! - [`hulls`]: hulls have parry3d's vertices, and their stated errors hold
//! - [`polygons`]: planar hulls, simplified hulls, and outlines split into convex parts, against exact integers
//! - [`fuzzed`]: the bodies of the fuzz targets, run on tens of thousands of seeded byte strings
//! - [`saved`]: stored poses, shapes, rays and hints come back bit for bit, or are rejected by the rules of the
//!   constructors
//! - [`ground_geometry`]: meshes and height fields come back bit for bit, and take no more memory than documented
//! - [`mass`]: mass, centre and inertia of every shape, against exact fractions, textbooks, sampling and
//!   inclusion-exclusion
//!
//! Broad phase
//! - [`broad`]: exactly the pairs of a double loop, each once, in order, for any boxes at all
//! - [`index`]: exactly the boxes that a plain loop finds to be near, crossed or overlapped, in order of distance
//!
//! Narrow phase
//! - [`separation`]: every separation and distance is within its stated error; closest points lie on the shapes
//! - [`boxes`]: pairs of cuboids agree with exact arithmetic, eight at a time and singly, and swapping A and B mirrors
//!   them
//! - [`exactness`]: overlap decisions agree with exact arithmetic: far apart, near, and within one rounding of touching
//! - [`agreement`]: separations, distances, points, records and events agree with that decision, ulp by ulp
//! - [`hard`]: 100,000 hard cases: no wrong answer, no bound broken, no panic, every error within 1e-6 of the size
//! - [`steady`]: one ulp of a pose changes neither the number of contact points, nor a depth by more than it moves the
//!   shapes
//! - [`manifolds`]: points lie on both shapes, share one normal, and are as deep as the pair; how much of the faces
//!   they keep; feature ids that persist
//! - [`plane`]: polygons of many edges against all edges, with A and B swapped; hints may change feature ids, never an
//!   overlap decision
//! - [`invariance`]: order, origin, units, quaternion length, hints and the rest of the batch do not matter
//! - [`casts`]: moving and turning shapes meet nothing before the reported impact, and are as near there as reported;
//!   rays; against parry3d
//! - [`casts_plane`]: moving and turning shapes in the plane first touch, and rays enter, where sampling and the exact
//!   overlap test say
//! - [`leaving`]: a shape that a cast brought into contact may leave again, in the plane and in space; walls are met
//!   from the front
//! - [`ground_worlds`]: ground is fixed; slides begin and end once; snapshots store it once; its edges are drawn
//! - [`ground_questions`]: overlaps, distances, rays and casts against meshes and height fields are the least over all
//!   triangles, tested one by one; sides; characters on ground
//! - [`chains`]: polylines to stand on: exact, without ghost collisions, at any angle; also in casts, worlds and
//!   snapshots
//! - [`ground_contacts`]: bodies slide over triangles without ghost collisions; edges and corners give only normals in
//!   their Voronoi regions; overlap, points and depths against a loop over all triangles
//! - [`persistent`]: manifolds that are moved along hold at the new poses within their error, or are rejected
//! - [`persistent_ground`]: the same on triangles, apart from chains: within their errors, and what overlaps stays
//!   overlapping
//! - [`creeping`]: worlds whose bodies creep report in every frame what a new world reports
//! - [`hints`]: over sixty frames, hints change no overlap decision, and no number by more than its error; nor do hints
//!   of another pair
//! - [`shapes`]: every kind of shape against every other: separations, points, compounds, AABBs, rejections, worlds
//! - [`many_parts`]: compounds of many parts give the same answers as the same parts in compounds of few
//! - [`shapes_peer`]: parry3d agrees for every kind of shape that it has
//! - [`theory`]: textbook examples
//! - [`peer`]: parry3d agrees on 160,000 pairs
//! - [`solver`]: stacks, pyramids and leaning cards stand on the manifolds, warm-started by feature ids
//!
//! World
//! - [`tiles`]: floors made of many bodies have no seams for bullets and casts, and walls on them stop both
//! - [`world_events`]: what a game sees, step by step: events, keys, margins, sensors, filters, limits
//! - [`still`]: where hardly anything moves, pairs that were skipped are as if they had been processed
//! - [`world_crowds`]: pairs that come and go by tens of thousands are those of a double loop
//! - [`world_model`]: lists of operations give what a naive model and a fresh world give
//! - [`snapshots`]: a world restored from text has the same outputs, keys and future, bit for bit; no damaged file
//!   breaks one; machines that predict inputs and roll back end in the same bits
//! - [`debug_lines`]: lines for a renderer lie on what they show
//! - [`heeded`]: bodies that let no contact point come closer than its separation pass no ground within a frame
//! - [`motions`]: what an update reports of this frame's motions: coming contacts, and what bullets run into first
//! - [`questions`]: overlaps, casts and nearest bodies, against a loop over all bodies, at any time, from any thread
//! - [`world_threads`]: every output has the same bits at any number of threads
//! - [`characters`]: characters enter and pass through nothing; floors, stairs, slopes, corners and closed rooms behave
//!   as a player expects
//!
//! Binaries of their own
//! - `tests/golden`: hashes of the output of every named scene and stage, and of bodies on ground, over sixty frames,
//!   on any number of threads and in any build
//! - `tests/allocation`: a steady scene allocates nothing, memory does not grow over a million operations, and how much
//!   a body takes
//!
//! Regressions
//! - [`regressions`]: past bugs
//!
//! Workspace
//! - [`architecture`]: which crate may depend on which, and that documented paths exist

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

mod agreement;
mod architecture;
mod bounds;
mod boxes;
mod broad;
mod casts;
mod casts_plane;
mod chains;
mod characters;
mod creeping;
mod debug_lines;
mod exactness;
mod fuzzed;
mod ground_contacts;
mod ground_geometry;
mod ground_questions;
mod ground_worlds;
mod hard;
mod heeded;
mod hints;
mod hulls;
mod index;
mod invariance;
mod leaving;
mod manifolds;
mod many_parts;
mod mass;
mod motions;
mod oracles;
mod peer;
mod persistent;
mod persistent_ground;
mod plane;
mod plumb;
mod polygons;
mod poses;
mod questions;
mod refusals;
mod regressions;
mod saved;
mod separation;
mod shapes;
mod shapes_peer;
mod snapshots;
mod solver;
mod steady;
mod still;
mod stored;
mod theory;
mod tiles;
mod world_crowds;
mod world_events;
mod world_model;
mod world_threads;
