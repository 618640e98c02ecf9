//! Chains, as convex shapes see them: which boxes of segments are near, and which normals a surface has.

mod surface;
mod zone;

pub(crate) use surface::{Surface, Told};
pub(crate) use zone::Zone;
