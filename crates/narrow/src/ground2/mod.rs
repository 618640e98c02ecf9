//! Chains against convex shapes: which boxes of segments are near, and which normals a surface gives.

mod surface;
mod zone;

pub(crate) use surface::{Surface, Told};
pub(crate) use zone::Zone;
