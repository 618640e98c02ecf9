//! What asunder guarantees, by the module that proves it.
//!
//! The judges
//! - [`oracles`]: the slow oracles of `tests/src` agree with each other and with cases known beforehand
//!
//! Geometry
//! - [`refusals`]: what is no convex shape and no pose is refused, by an error that names the place
//! - [`poses`]: poses in the axes of others take points where one after the other does
//! - [`bounds`]: the box around a posed shape holds it, and is no wider than rounding needs
//! - [`hulls`]: parry3d's vertices, and errors that hold
//! - [`polygons`]: hulls of points in the plane, simplified ones, and outlines cut into convex parts, against exact
//!   integers
//! - [`fuzzed`]: the fuzz targets' bodies, on tens of thousands of seeded strings
//! - [`saved`]: what is stored of poses, shapes, rays and hints comes back in every bit, or is refused by what the
//!   constructors say
//! - [`ground_geometry`]: meshes and height fields come back in every bit, and take what they are said to
//! - [`mass`]: mass, centre and inertia of every shape, against exact fractions, textbooks, sampling and
//!   inclusion-exclusion
//!
//! Broad phase
//! - [`broad`]: exactly the pairs of a double loop, each once, in order, for any boxes whatever
//! - [`index`]: exactly the boxes of a loop, near enough, crossed or overlapped, in order of distance
//!
//! Narrow phase
//! - [`separation`]: every separation and distance is right within its own error; closest points lie on the shapes
//! - [`boxes`]: pairs of cuboids, eight at a time and alone, are what exact arithmetic says, and mirror each other
//! - [`exactness`]: yes or no is what exact arithmetic says, far, near, and a rounding from touching
//! - [`agreement`]: separations, distances, points, records and events go with that yes or no, ulp by ulp
//! - [`hard`]: 100,000 hard cases: nothing wrong, no bound broken, no panic, everything within 1e-6 of size
//! - [`steady`]: a unit in the last place of a pose changes no count of points, and no depth by more than it is
//! - [`manifolds`]: points on both shapes, on one normal, as deep as the pair; what they keep of the faces; names
//!   that stay
//! - [`plane`]: polygons of many edges against all edges, mirrored, and what hints may change: names, never a yes or no
//! - [`invariance`]: order, origin, units, quaternion lengths, hints and neighbours in a batch do not matter
//! - [`casts`]: what moves and turns meets nothing before it is said to, and is as near there as told; rays;
//!   parry3d's word
//! - [`casts_plane`]: shapes in the plane that move and turn first touch, and rays go in, where sampling and the
//!   exact yes or no say
//! - [`leaving`]: what a cast has brought to another may leave it, in the plane and in space; walls are met from the
//!   front
//! - [`ground_worlds`]: ground is fixed; slides begin and end once; snapshots hold it once; its edges are drawn
//! - [`ground_questions`]: overlaps, distances, rays and casts over meshes and height fields are the least of all
//!   triangles', one by one; sides; characters on ground
//! - [`chains`]: polylines to stand on: exact, without ghost collisions, at any angle; in casts, worlds and snapshots,
//!   too
//! - [`ground_contacts`]: bodies slide over triangles without noticing; edges and corners give normals of their Voronoi
//!   regions alone; yes or no, points and depths against a loop over all triangles
//! - [`persistent`]: manifolds that are moved along are true at the new poses within their error, or refused
//! - [`persistent_ground`]: the same on triangles, chains apart: within their errors, and what overlaps goes on doing
//!   so
//! - [`creeping`]: worlds whose bodies creep say in every frame what a new world says
//! - [`hints`]: over sixty frames, memory changes no yes or no, and no number by more than its error; nor does
//!   another's
//! - [`shapes`]: every kind of shape against every other: separations, points, compounds, boxes, refusals, worlds
//! - [`many_parts`]: compounds of many parts say what the same parts say in compounds of few
//! - [`shapes_peer`]: parry3d says the same of every kind of shape that it has
//! - [`theory`]: the textbook's own examples
//! - [`peer`]: parry3d says the same on 160,000 pairs
//! - [`solver`]: stacks, pyramids and leaning cards stand on the manifolds, by the names of their points
//!
//! World
//! - [`tiles`]: floors of many bodies have no seams for bullets and casts, and their walls stand
//! - [`world_events`]: what a game sees, step by step: events, keys, margins, sensors, filters, limits
//! - [`still`]: where hardly anything moves, what was not looked at is as it would be
//! - [`world_crowds`]: pairs that come and go by tens of thousands are those of a double loop
//! - [`world_model`]: lists of operations give what a naive model gives, and what a fresh world gives
//! - [`snapshots`]: a world restored from text has the same outputs, keys and future, bit for bit; no damaged file
//!   breaks one; machines that guess inputs and roll back end in the same bits
//! - [`debug_lines`]: lines for a renderer lie on what they show
//! - [`motions`]: what an update says of this frame's motions: contacts to come, and what bullets run into first
//! - [`questions`]: overlaps, casts and what is near, against a loop over all bodies, at any time, from any thread
//! - [`world_threads`]: every output has the same bits at any number of threads
//! - [`characters`]: nobody enters or passes anything; floors, stairs, slopes, corners and closed rooms, as a
//!   player expects
//!
//! Binaries of their own
//! - `tests/golden`: what every named scene and stage, and bodies on ground, say over sixty frames, by hash, on any
//!   number of threads and in any build
//! - `tests/allocation`: a steady scene allocates nothing, a million operations let no memory grow, and what a body
//!   takes
//!
//! Stories
//! - [`regressions`]: what went wrong once
//!
//! Workspace
//! - [`architecture`]: who may know whom, and paths that exist

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
