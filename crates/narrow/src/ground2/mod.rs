//! Chains against convex shapes: which boxes of segments are near, and which normals a surface gives.

mod surface;
mod zone;

pub(crate) use surface::{Region, Surface};
pub(crate) use zone::Zone;
