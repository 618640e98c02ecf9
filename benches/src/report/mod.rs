//! One page of speed against error: measured, kept as CSV, drawn.
//!
//! [`measure`] fills [`Data`], [`data`] keeps it as plain rows. All that follows is a function of those rows and of
//! nothing else, byte by byte: [`sections`] says in which plots, tables and sentences a section consists, [`page`] and
//! [`markdown`] lay them out, [`readme`] puts some of them into README, with one table that also has rows of
//! `compare` that were [`kept`]. So a test can draw README's figures again.
//!
//! [`losses`] looks for rows where somebody else is ahead. [`plots`] knows kinds of plots and no data; it draws on a
//! [`sheet`], along [`axis`], in the looks of [`palette`].

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
