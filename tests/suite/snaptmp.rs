#![allow(clippy::unwrap_used, clippy::panic)]
//! tmp
mod saved;
mod snapshots;
