//! Shapes on ground that is made of triangles.

mod contact;
mod near;

pub(crate) use contact::contact_on_ground;
pub(crate) use near::OnGround;
