//! Shapes on ground that is made of triangles.

mod near;

pub(crate) use near::OnGround;
