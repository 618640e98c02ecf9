//! Shapes on ground that is made of triangles.

mod ask;
mod ask_box;
mod ask_round;
mod ask_sides;
mod contact;
mod near;

pub(crate) use ask_box::Corners;
pub(crate) use ask_sides::{Facing, Touched};
pub(crate) use contact::{contact_on_ground, front_of, widened};
pub(crate) use near::{OnGround, SeenAt, box_around};
