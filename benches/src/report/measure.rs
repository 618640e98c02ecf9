//! Fills the data: each section is measured by its own module.

use super::Section;
use super::cpu::Processor;
use super::data::Data;
use super::origin::Origin;
use crate::broad::{self, rows as broad_rows};
use crate::clock::Effort;
use crate::error;
use crate::world::{self, rows as world_rows};
use std::error::Error;

/// The number of threads in rows with more than one.
const THREADS: usize = 2;

/// Reports what is being measured, and the share of its section that is done, from 0 to 1, or `None` if unknown.
pub type Progress<'a> = &'a (dyn Fn(&str, Option<f64>) + Sync);

/// Measures one section, in place of its earlier data. Cost: one to five minutes; a tenth to a third of that if
/// `quick`.
///
/// # Errors
/// The system cannot start the threads, or the library rejects the margin.
pub fn measure(
    data: &mut Data,
    section: Section,
    (quick, processor): (bool, &Processor),
    progress: Progress,
) -> Result<(), Box<dyn Error>> {
    let say = |text: &str| progress(text, None);
    match section {
        Section::Error => data.error = error::speed_against_error(quick, &say),
        Section::Gap => data.gap = error::wrong_by_gap(quick, &say),
        Section::Stability => data.stability = error::stability(quick, &say),
        Section::Vertices => data.vertices = error::vertices(quick, &say),
        Section::Broad => data.broad = broad_phase(quick, progress)?,
        Section::Frame => data.frame = frames(quick, progress)?,
    }
    data.set_origin(Origin::now(section, processor, quick));
    Ok(())
}

fn broad_phase(quick: bool, progress: Progress) -> Result<Vec<broad_rows::BroadRow>, Box<dyn Error>> {
    // One thread, so that its CPU time is all the time spent.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let effort = if quick {
        Effort { seconds: 0.05, ..Effort::quick() }
    } else {
        Effort { seconds: 0.4, ..Effort::full() }
    };
    let cases = broad::cases(&effort, !quick);
    let mut rows = Vec::new();
    for (i, case) in cases.iter().enumerate() {
        progress(&broad::name(case), Some(i as f64 / cases.len() as f64));
        rows.extend(alone.install(|| broad_rows::one_thread(case, &effort)));
        rows.extend(broad_rows::several_threads(case, THREADS, &effort)?);
    }
    Ok(rows)
}

fn frames(quick: bool, progress: Progress) -> Result<Vec<world_rows::FrameRow>, Box<dyn Error>> {
    let effort = if quick { Effort { seconds: 0.25, ..Effort::quick() } } else { Effort::full() };
    let cases = world::cases();
    let mut rows = Vec::new();
    for (i, case) in cases.iter().enumerate() {
        progress(&world::name(case), Some(i as f64 / cases.len() as f64));
        rows.extend(world_rows::frames(case, case.usual_count(), THREADS, &effort)?);
    }
    Ok(rows)
}
