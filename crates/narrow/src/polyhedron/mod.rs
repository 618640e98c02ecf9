//! Convex polyhedra: the separating axis test, the distance and the manifold, in plain f64.
//!
//! This is the definition. It is meant to be read, and to be what faster kernels are measured against.

pub(crate) mod cuboids;
pub(crate) mod distance;
pub(crate) mod manifold;
mod reduce;
pub(crate) mod sat;
mod simplex;
pub(crate) mod solid;
