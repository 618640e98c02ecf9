//! Convex polyhedra: the separating axis test, the distance and the manifold, in plain f64.
//!
//! This is the definition. It is meant to be read, and to be what faster kernels are measured against.

pub(crate) mod closest;
pub(crate) mod convex;
pub(crate) mod cuboids;
mod distance;
pub(crate) mod gap;
pub(crate) mod half_space;
pub(crate) mod manifold;
mod octets;
mod portal;
pub(crate) mod reduce;
mod rods;
pub(crate) mod sat;
pub(crate) mod simplex;
mod slender;
pub(crate) mod solid;

pub(crate) use distance::TELLING;
