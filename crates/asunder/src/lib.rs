//! A collision engine for games: it reports which bodies touch, how deep they overlap, and how accurate each answer is.
//!
//! A world holds bodies. Each body has a pose and a shape: a convex shape, a compound of convex parts, or ground. Move
//! the bodies as your game requires and call `update` once per frame: a broad phase sorts and sweeps their boxes, a
//! narrow phase tests the candidate pairs, and the world reports what touches ([`World3::contacts`]) and what changed
//! ([`World3::events`]). The world never moves a body itself.
//!
//! ```
//! use asunder::{Collider3, Cuboid, Event3, Pose3, World3, glam::Vec3};
//!
//! let mut world = World3::new();
//! let floor = world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::new(50.0, 0.5, 50.0))?).fixed());
//! let crate_ = world.insert(
//!     Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5))?).at(Pose3::at(Vec3::new(0.0, 2.0, 0.0))?),
//! );
//! world.update();
//! assert!(!world.is_touching(floor, crate_));
//!
//! world.set_pose(crate_, Pose3::at([0.0, 0.99, 0.0])?)?;
//! world.update();
//! assert!(matches!(world.events(), [Event3::Began { a, b, .. }] if (*a, *b) == (floor, crate_)));
//! let contact = world.contact(floor, crate_).ok_or("they touch")?;
//! let manifold = &contact.manifolds[0];
//! assert_eq!((manifold.normal, manifold.points.len()), (Vec3::Y, 4));
//! assert!((f64::from(manifold.separation) + 0.01).abs() <= f64::from(manifold.error));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where to begin
//! - Bodies: [`Collider3`] of any [`Shape3`], at a [`Pose3`]; [`Layers`], owners and sensors decide which bodies meet.
//! - A frame: [`World3::set_pose`], [`World3::update`], [`World3::events`], [`World3::contacts_of`].
//! - Fast bodies: [`World3::set_motion`], [`Collider3::bullet`], [`World3::impacts`].
//! - Queries (ray casts, shape casts, overlap tests, nearest bodies): [`World3::cast_ray`], [`World3::cast_shape`],
//!   [`World3::overlapping`], [`World3::closest`], with a [`Filter3`].
//! - Characters: [`World3::move_and_slide`], with a [`Walk3`].
//! - Two shapes without a world: [`Pair3`].
//! - The [`guide`] has pages on most of these, with complete examples.
//!
//! Everything exists in the plane as well, with a 2 in place of the 3. To write a world of your own, see the jobs,
//! batches and hints in `asunder_narrow`, one of the crates on which this one is built.
//!
//! # Words
//! - A **candidate** is a pair of bodies that may meet and whose boxes, margins included, overlap.
//! - A **contact** is a candidate whose separation is at most the sum of both margins, or whose bodies this frame's
//!   motions may bring that close (then it is *speculative*).
//! - Two bodies **overlap** while they share at least one point.
//! - They are **touching** ([`World3::is_touching`]) from their first overlap until they are further apart than the sum
//!   of their margins: from `Began` to `Ended`.
//!
//! The page on [`events`](guide::events) has this as a table.
//!
//! # Debug builds
//! A debug build of a game leaves its dependencies unoptimised, which makes this crate tens of times slower than
//! necessary. Put `[profile.dev.package."*"]` with `opt-level = 3` into the game's Cargo.toml. That covers updates and
//! queries, which are compiled with this crate, but not the `visit_*` calls, which are compiled with your closure.
//!
//! # How accurate the answers are
//! `overlaps`, touching and events are exact, and touching counts as overlapping: a brick that shares a face with
//! another touches it, and one that is a rounding error away does not. Every separation carries an `error`, in metres:
//! the true separation differs by at most that much.
//!
//! Both refer to the **true shape**: the convex hull of the stored f32 vertices, grown by the stored radius, turned by
//! the matrix of the stored rotation (in space M(q)/|q|^2, whatever the length of q) and moved by the f64 position, all
//! without rounding.
//!
//! The separation is the maximum over unit n of (min over B of n.x - max over A of n.x). For shapes that are apart it
//! is their distance; for shapes that overlap it is minus the length of the shortest translation that separates them.
//! It is at most zero exactly when they overlap.
//!
//! # Feature flags
//! - `parallel` (default): refit, sweep, collide and impacts run on rayon's threads. Every output is bit-equal with and
//!   without it. For a few hundred bodies leave it out: threads gain nothing there, and may cost a little. For many
//!   bodies, make the game's main thread a member of the pool: see [`game_loops`](guide::game_loops).
//! - `serde`: snapshots of a whole world for save games and the network (`World::snapshot`, `World::restore`), and
//!   serde's traits for bodies, shapes, poses, rays, keys, events, manifolds, answers to queries, walks and debug
//!   options. Everything that is loaded passes the same checks as in the constructors.
#![deny(missing_docs)]

mod any_world;
mod ask2;
mod ask3;
mod bodies;
mod character;
mod clock;
mod collider;
mod contact;
mod copy;
mod debug;
mod event;
mod frame;
#[cfg(all(doc, not(doctest)))]
pub mod guide;
mod hooks;
mod motion;
mod odometer;
mod query;
mod records;
mod results2;
mod results3;
mod slab;
#[cfg(feature = "serde")]
mod snapshot;
mod space;
mod stats;
mod world;
mod world2;
mod world3;

pub use any_world::AnyWorld;
pub use asunder_geometry::{
    Aabb2, Aabb3, Basis3, Bounds, Capsule2, Capsule3, CapsuleError, Chain, ChainError, Circle, Compound2,
    Compound3, CompoundError, Core2, Core3, Cuboid, DecomposeError, DirectionError, DroppedTriangles,
    EdgeArc, EdgeOctet, ExtentError, FaceOctet, Ground, HalfEdge, HalfPlane, HalfSpace, HeightField,
    HeightFieldError, Hull, HullError, HullFault, MassError, MassProperties2, MassProperties3, MeshError,
    Motion2, Motion3, NearTriangle, Part2, Part3, Polygon, PolygonError, Pose2, Pose3, PoseError, Prominent,
    RadiusError, Ray2, Ray3, RayError, Rect, Rotation2, Run, ScaleError, Segment2, Segment3, Shape2, Shape3,
    Sphere, Topology, TriMesh, Triangle3, Turn3, VertexError, VertexOctet, decompose, glam, tolerance,
};
pub use asunder_narrow::{
    ArrayVec, Closest2, Closest3, ContactPoint2, ContactPoint3, ContactPoints, Feature, FeatureId, Impact2,
    Impact3, Manifold2, Manifold3, Measured2, Measured3, Pair2, Pair3, RayHit2, RayHit3, Separation2,
    Separation3, Tier, Touch, Touch2, Touch3, Verdict, cast_ray2, cast_ray3,
};
pub use character::{
    Footing, Footing2, Footing3, Freed, Freed2, Freed3, Obstacle, Obstacle2, Obstacle3, Slide, Slide2,
    Slide3, Walk, Walk2, Walk3,
};
pub use collider::{Collider, Collider2, Collider3, Layers, MarginError, SetMarginError};
pub use contact::{Contact, Contact2, Contact3};
pub use debug::{DebugLine, DebugOptions};
pub use event::{Event, Event2, Event3};
pub use hooks::{Hooks, Hooks2, Hooks3, Meeting, Meeting2, Meeting3, Side, Side2, Side3};
pub use motion::{Hit, Hit2, Hit3};
pub use query::{
    CastAnswer, CastAnswer2, CastAnswer3, Filter, Filter2, Filter3, NearAnswer, NearAnswer2, NearAnswer3,
    RayAnswer, RayAnswer2, RayAnswer3,
};
pub use slotmap;
#[cfg(feature = "serde")]
pub use snapshot::{Snapshot, Snapshot2, Snapshot3, SnapshotError};
pub use space::{BodyKey2, BodyKey3, Plane, Space, Volume};
pub use stats::Stats;
pub use world::{StaleKey, World};
pub use world2::World2;
pub use world3::World3;
