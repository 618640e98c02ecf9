//! The narrow phase: overlap, separation, contacts and casts of two posed shapes.
//!
//! Two convex sets are disjoint exactly when some axis separates their projections. For polygons the edge normals
//! suffice as candidates, for polyhedra the face normals and the cross products of edge pairs. A narrow phase has no
//! notion of keys or worlds; it processes one pair ([`Pair2`], [`Pair3`]) or a batch of jobs ([`collide2`],
//! [`collide3`]).
//!
//! # Meaning of the answers
//! The **true shape** is the convex hull of the stored f32 vertices v, with everything within the stored f32 radius of
//! it, turned and moved exactly. Faces are derived data on which no proof relies.
//!
//! ```text
//! in space        x = M(q)/|q|^2 v + p         for the stored quaternion q, of any length, and the f64 position p
//! in the plane    x = [c -s; s c] v + p        for the stored cosine and sine
//! half-space      { x : n.x <= 0 }             for the stored f32 normal n, turned and moved alike
//! separation      max over unit n of (min over B of n.x - max over A of n.x)
//! size            the sum of both bounding radii
//! ```
//! Where the shapes are apart, the separation is their Euclidean distance; where they overlap, it is minus the length
//! of the shortest translation that separates them. For compounds and ground it is the least over all pairs of convex
//! parts: the translation that separates that pair may leave others overlapping. Shapes are closed: touching counts as
//! overlapping.
//!
//! - `overlaps` is exact. [`Tier`] reports which level of precision it took.
//! - Every separation, distance and manifold has an `error`: |true - reported| <= error, in metres.
//! - `separation <= 0` exactly when `overlaps`; `distance` returns points exactly when not. If the rounded number
//!   disagrees with the exact answer, it becomes zero, or the least positive f32.
//! - A pair is within a margin when it overlaps or its reported separation is at most the margin.
//! - All tolerances are relative: a scene scaled by a power of two has the same answers, scaled. Positions are
//!   subtracted in f64 first, so that nothing is lost with the distance from the origin.
//!
//! `docs/accuracy.md` derives the bounds.
//!
//! To process the same pairs frame after frame, pass back the [`Hint`] of each answer. For bodies that hardly move, a
//! [`Persistent2`] or [`Persistent3`] moves the last frame's manifold along, for a fraction of the cost of a new one.
//!
//! ```
//! use asunder::{Cuboid, Pair3, Pose3, Separation3, Shape3, glam::Vec3};
//!
//! let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
//! let (here, there) = (Pose3::IDENTITY, Pose3::at(Vec3::new(1.75, 0.0, 0.0))?);
//! let pair = Pair3::new(&cube, &here, &cube, &there);
//! assert!(pair.overlaps());
//! let Separation3::Measured(found) = pair.separation(0.0) else { unreachable!("they overlap") };
//! assert!((found.separation + 0.25).abs() <= found.error);
//! assert_eq!(found.normal, Vec3::X, "from A to B");
//! assert_eq!(pair.manifold(0.0).map(|manifold| manifold.points.len()), Some(4));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![deny(missing_docs)]

mod among;
mod answer;
mod batch;
mod cast2;
mod cast3;
mod counted;
mod exact;
mod feature;
mod footing;
mod ground2;
mod ground3;
mod impact2;
mod impact3;
mod jobs2;
mod jobs3;
mod kept;
mod lanes;
mod least;
mod level;
mod lists;
#[cfg(test)]
mod numbers;
mod pair2;
mod pair3;
mod persistent;
mod persistent2;
mod persistent3;
mod plumb;
mod points;
mod polygon;
mod polyhedron;
mod precision;
mod room;
mod shadow;
mod touch;
mod triangle;
mod whole2;
mod whole3;

pub use answer::{
    Answer, Closest2, Closest3, ContactPoint2, ContactPoint3, Manifold2, Manifold3, Measured2, Measured3,
    Separation2, Separation3, Tier, Verdict,
};
pub use arrayvec::ArrayVec;
pub use batch::{Batch, Batch2, Batch3};
pub use cast2::cast_ray2;
pub use cast3::cast_ray3;
pub use feature::{Feature, FeatureId, Hint};
pub use impact2::{Impact2, RayHit2};
pub use impact3::{Impact3, RayHit3};
pub use jobs2::{Job2, collide2};
pub use jobs3::{Job3, collide3, separations3};
pub use pair2::Pair2;
pub use pair3::Pair3;
pub use persistent2::Persistent2;
pub use persistent3::{Persistent3, Spare3};
pub use points::ContactPoints;
pub use touch::{Touch, Touch2, Touch3};
