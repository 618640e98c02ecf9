//! What things are: boxes, poses and convex shapes, validated where they are made.
//!
//! *Where things are is f64; what things are is f32.* A pose holds an f64 position and an f32 rotation, a shape
//! holds f32 vertices. The **true shape** is the convex hull of the stored vertices, turned and moved exactly;
//! faces, normals and radii are derived from it and only ever guide a computation.
//!
//! This crate knows no frame, no pair and no world. Units are SI, axes right-handed, polygons wind
//! counter-clockwise, normals point out of a shape.
#![deny(missing_docs)]

mod aabb;
mod cuboid;
mod extent;
mod hull;
mod outward;
mod polygon;
mod pose2;
mod pose3;
mod rect;
mod shape;
pub mod tolerance;
mod topology;

pub use aabb::{Aabb2, Aabb3, Bounds};
pub use cuboid::Cuboid;
pub use extent::ExtentError;
pub use hull::{Hull, HullError};
pub use polygon::{Polygon, PolygonError};
pub use pose2::{Pose2, Rotation2};
pub use pose3::{Basis3, Pose3};
pub use rect::Rect;
pub use shape::{Shape2, Shape3};
pub use topology::{HalfEdge, Topology};

pub use pose3::PoseError;

pub use glam;
