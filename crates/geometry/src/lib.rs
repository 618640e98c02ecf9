//! Boxes, poses and shapes, validated when they are created.
//!
//! *Positions are f64, shapes are f32.* A pose holds an f64 position and an f32 rotation, a shape holds f32 vertices.
//! The **true shape** is the convex hull of the stored vertices, rotated and moved exactly; faces, normals and radii
//! are derived from it and only guide computations.
//!
//! This crate has no notion of frames, pairs or worlds. Units are SI, axes right-handed, polygons wind
//! counter-clockwise, normals point out of a shape.
#![deny(missing_docs)]

mod aabb;
mod basis3;
mod chain;
mod circle;
mod compound;
mod copied;
mod cores;
mod counted;
mod cuboid;
mod decompose;
mod direction;
mod extent;
mod ground;
mod half_space;
mod height_field;
mod hull;
mod mass;
mod mesh;
mod motion2;
mod motion3;
mod octets;
mod outward;
mod polygon;
mod pose2;
mod pose3;
mod product;
mod radius;
mod ray;
mod rect;
mod relative;
mod ring;
#[cfg(feature = "serde")]
mod saved;
mod scaled;
mod segment;
mod shape;
mod shown;
mod sphere;
pub mod tolerance;
mod topology;
mod triangle;
mod vertex;

#[doc(hidden)]
pub use aabb::BoxList;
pub use aabb::{Aabb2, Aabb3, Bounds};
pub use basis3::Basis3;
pub use chain::{Chain, ChainError, Run};
pub use circle::Circle;
pub use compound::{Compound2, Compound3, CompoundError, Part2, Part3};
pub use cores::{Core2, Core3};
pub use cuboid::Cuboid;
pub use decompose::{DecomposeError, decompose};
pub use direction::DirectionError;
pub use extent::ExtentError;
pub use ground::{Ground, NearTriangle, Prominent};
pub use half_space::{HalfPlane, HalfSpace};
pub use height_field::{HeightField, HeightFieldError};
pub use hull::{Hull, HullError, HullFault};
pub use mass::{MassError, MassProperties2, MassProperties3};
pub use mesh::{DroppedTriangles, MeshError, TriMesh};
pub use motion2::Motion2;
pub use motion3::{Motion3, Turn3};
pub use octets::{EdgeArc, EdgeOctet, FaceOctet, VertexOctet};
pub use outward::round_down;
pub use polygon::{Polygon, PolygonError};
pub use pose2::{Pose2, Rotation2};
pub use pose3::{Pose3, PoseError};
pub use radius::RadiusError;
pub use ray::{Ray2, Ray3, RayError};
pub use rect::Rect;
pub use scaled::ScaleError;
pub use segment::{Capsule2, Capsule3, CapsuleError, Segment2, Segment3};
pub use shape::{Shape2, Shape3};
pub use sphere::Sphere;
pub use topology::{HalfEdge, Topology};
pub use triangle::Triangle3;
pub use vertex::VertexError;

pub use glam;
