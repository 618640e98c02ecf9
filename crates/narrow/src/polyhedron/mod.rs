//! Convex polyhedra: yes or no, separation, distance and contact manifolds.
//!
//! What decides is in f64, or shown by f32 with a bound on its rounding; lanes of f32 leave out what bounds prove to be
//! of no use. [`cuboids`] has faster kernels for two of them, which must agree with what is here.

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

pub(crate) use distance::TELLING;
