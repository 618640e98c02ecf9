//! Queries to a world: what is here, what is in the way, what is near.
//!
//! ```text
//! index       which boxes a query is about, nearest first, from two trees and a list
//! walk        for each box: filter, narrow phase, the box around the body as it stands; the best answer, all, or each
//! questions   each query as a set of boxes and what it asks of a body
//! space       the narrow phase's part, in the plane and in space
//! answer      the answers' types
//! ```
//! The methods themselves are in `ask2.rs` and `ask3.rs`, those along a path in an `along.rs` each, in plain types.
//!
//! # Why answers depend on the bodies alone
//! Trees are built by the first query that needs them, on any thread, and boxes of the last update may be larger than
//! necessary. So a box from a tree only selects a body for the test. What decides is the box around the shape as it
//! stands, made on the spot: a body is an answer only if that box is, and is reported no nearer than that box. So a
//! body that is skipped, as its box in the tree is further than what was found, would have been reported further, too;
//! and the order in which bodies are tested does not matter, since equal distances go by slot.

mod answer;
mod filter;
mod index;
mod questions;
mod space;
mod walk;

pub(crate) use answer::Met;
pub use answer::{
    CastAnswer, CastAnswer2, CastAnswer3, NearAnswer, NearAnswer2, NearAnswer3, RayAnswer, RayAnswer2,
    RayAnswer3,
};
pub use filter::{Filter, Filter2, Filter3};
pub(crate) use index::Boxes;
pub(crate) use questions::{
    bodies_along, bodies_along_ray, bodies_near, bodies_over, boxes_over, first_ahead, manifolds,
    parts_along, visit_bodies_in, visit_manifolds,
};
pub(crate) use space::{Asked, Enter, Meet};
