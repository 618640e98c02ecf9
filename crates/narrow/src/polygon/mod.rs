//! Convex polygons: the separating axis test, the distance and the manifold, in plain f64.
//!
//! ```text
//! circles around and inside, rectangles at once                    quick, rects
//! few edges: all of them, side by side                             few
//! many edges: a search over directions                             search
//! in a gap that no edge's normal measures: GJK                     distance
//! closest points alone: the same, without edges                    apart
//! yes or no, where f64 cannot decide: integers                     tiers
//! number, error, sign and contact points of an answer              measure, manifold
//! ```
//! What each trick buys stands above its kernel; the definition of the best axis is `sat::plain`.

pub(crate) mod apart;
pub(crate) mod convex;
pub(crate) mod distance;
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
