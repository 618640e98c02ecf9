//! Convex polyhedra: overlap test, separation, distance and contact manifolds.
//!
//! Decisions are made in f64, or in f32 with a bound on its rounding; lanes of f32 discard what bounds prove to be
//! irrelevant. [`cuboids`] has faster kernels for two cuboids, which must agree with those here.

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
pub(crate) mod slender;
pub(crate) mod solid;

pub(crate) use distance::CLEAR_GAP;
