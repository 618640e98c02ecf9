//! Convex polygons: the separating axis test, the distance and the manifold, in plain f64.
//!
//! This is the definition. It is meant to be read, and to be what faster kernels are measured against.

pub(crate) mod convex;
mod distance;
mod few;
mod half_plane;
pub(crate) mod manifold;
pub(crate) mod measure;
pub(crate) mod outline;
mod placed;
pub(crate) mod quick;
mod rects;
mod sat;
mod search;
#[cfg(test)]
mod tests;
mod tiers;
