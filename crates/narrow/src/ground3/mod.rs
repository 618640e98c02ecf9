//! Shapes on ground that is made of triangles.

mod bounds;
mod contact;
mod near;
mod queries;
mod sides;
mod sphere;

pub(crate) use bounds::Corners;
pub(crate) use contact::{front_of, widened};
pub(crate) use near::{OnGround, Viewpoint, box_around};
pub(crate) use sides::{Facing, Touched};
