//! Queries to a world: which bodies overlap a place, which are in the way, which are near.
//!
//! ```text
//! index       the boxes that a query meets, nearest first, from two trees and a list
//! walk        for each box: filter, narrow phase, the body's current box; the best answer, all, or one by one
//! questions   each query as a set of boxes and a test of a body
//! space       the narrow phase's part, in the plane and in space
//! answer      the answers' types
//! ```
//! The methods themselves are in `ask2.rs` and `ask3.rs`, and casts in modules of these, in plain types.
//!
//! # Why answers depend on the bodies alone
//! Trees are built by the first query, on any thread, and boxes of the last update may be larger than necessary. So a
//! box from a tree only selects bodies to test. The result depends on the box around the shape at its current pose,
//! computed on the spot: a body is found only if that box is met, and is reported no nearer than that box. Then a body
//! that is skipped because its box in the tree is further away than the best answer would have been reported as
//! further away, too; and the order in which bodies are tested does not matter, since ties are broken by slot.

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
    bodies_along, bodies_along_ray, bodies_near, bodies_over, boxes_over, first_ahead, is_clear, manifolds,
    parts_along, visit_bodies_in, visit_manifolds,
};
pub(crate) use space::{Asked, Enter, Meet};
