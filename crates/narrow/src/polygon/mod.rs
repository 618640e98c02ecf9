//! Convex polygons: the separating axis test, the distance and the manifold, in plain f64.
//!
//! This is the definition. It is meant to be read, and to be what faster kernels are measured against.

pub(crate) mod convex;
mod distance;
mod half_plane;
mod manifold;
pub(crate) mod outline;
mod sat;
