//! One page of speed against error: measured, stored as CSV, and drawn.
//!
//! [`measure`] fills [`Data`], which [`data`] stores as plain rows. All that follows is a function of those rows alone,
//! byte for byte: [`sections`] makes plots, tables and sentences of each section, [`page`] and [`markdown`] lay them
//! out, and [`readme`] puts some of them into README, with one table that also has saved rows of `compare` ([`kept`]).
//! So a test can draw README's figures again.
//!
//! [`losses`] finds rows in which another method is ahead. [`plots`] has the kinds of plots, without any data; it draws
//! on a [`sheet`], along an [`axis`], in the styles of [`palette`].

pub mod axis;
pub mod cpu;
pub mod data;
pub mod kept;
pub mod losses;
pub mod markdown;
pub mod measure;
pub mod names;
pub mod origin;
pub mod page;
pub mod palette;
pub mod plots;
pub mod readme;
pub mod sections;
pub mod sheet;
pub mod spread;
mod summary;
pub mod table;

pub use data::{Data, Section};
pub use kept::KeptRow;
