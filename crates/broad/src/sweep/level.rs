//! The columns of a grid, one after the other; those that are too full, in columns of their own.

use super::rows::{HITS, Hit, Progress, Strips};
use super::settle::{NO_PAIRS, Names, Question};
use crate::columns::codes::Entry;
use crate::columns::grid::{Grid, Over};
use crate::columns::{ColumnEntries, Columns, Fill, PLACE};
use crate::pair::PairId;
use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use core::ops::{ControlFlow, Range};

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    strips: Strips,
    /// A column of several parts, put together.
    gathered: Columns,
    nested: Option<Box<Nested>>,
}

/// What a column that is too full is swept with.
#[derive(Clone, Debug, Default)]
struct Nested {
    columns: Columns,
    members: Vec<u32>,
    scratch: Scratch,
}

/// A column is swept in columns of its own only if it has so many boxes,
const MANY: usize = 96;
/// so many times as many as columns have on average,
const CROWDED: usize = 3;
/// or so many in one bin, as all that lies outside of the grid has,
const HEAP: usize = 48;
/// so many candidates a box, eight rounds of lanes, which take about as long as to put the box into columns again (32
/// in place of 128: 1.7 times as long for 1000 boxes in eight clumps, 1.2 times for 2000, elsewhere the same; Zen 4,
/// 2026-11-22),
const FULL: usize = 128;
/// and is expected to have so many times fewer then.
const GAIN: f64 = 2.0;

/// Columns within columns at most, for clumps of clumps of clumps: each costs twice as much of this as boxes get
/// entries in it on average, so that there are twelve where few straddle, four where all do, and never more than
/// 256 entries a box.
const DEEPEST: usize = 24;

/// Boxes that make a column crowded, where so many are in all columns of a grid.
pub(crate) fn crowd(all: usize, grid: &Grid) -> usize {
    CROWDED * all / grid.count()
}

/// Candidates a box of a column that is so full that it may be worth columns of its own.
#[inline(always)]
pub(crate) fn overfull(column: &ColumnEntries<'_>, grid: &Grid, crowd: usize) -> Option<usize> {
    let count = column.entries.len();
    if count <= MANY || (count <= crowd && column.fullest_bin() <= HEAP) {
        return None;
    }
    Some(column.candidates(grid) / count).filter(|&full| full > FULL)
}

impl Scratch {
    pub(super) fn bytes(&self) -> usize {
        let nested = self.nested.as_ref().map_or(0, |nested| {
            nested.columns.bytes() + nested.members.capacity() * 4 + nested.scratch.bytes()
        });
        self.strips.bytes() + self.gathered.bytes() + nested
    }
}

/// Some columns of boxes that were sorted in one or more parts.
pub(super) struct Level<'a, 'q, B, A, S, const NESTED: bool> {
    pub(super) parts: &'a [Columns],
    pub(super) grid: &'a Grid,
    pub(super) range: Range<usize>,
    pub(super) question: &'a mut Question<'q, B, A, S>,
    pub(super) scratch: &'a mut Scratch,
    /// If these are columns of a column: what its boxes are called outside, and how deep it is.
    pub(super) around: (Option<&'a Names<'a>>, usize),
}

impl<B, A, S, const NESTED: bool> Kernel for Level<'_, '_, B, A, S, NESTED>
where
    B: Bounds,
    A: Fn(u32, u32) -> bool,
    S: FnMut(&[PairId]) -> ControlFlow<()>,
{
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> ControlFlow<()> {
        let Level { parts, grid, range, question, scratch, around: (names, depth) } = self;
        let Scratch { strips, gathered, nested } = scratch;
        let all = parts.iter().map(Columns::len).sum::<usize>();
        let crowd = crowd(all, grid);
        let mut hits = [Hit::default(); HITS];
        let mut pairs = NO_PAIRS;
        for index in range {
            let column = match parts {
                [one] => one.column(grid, index),
                several => gathered.gather(several, grid, index),
            };
            if column.entries.len() < 2 {
                continue;
            }
            if depth < DEEPEST
                && let Some(full) = overfull(&column, grid, crowd)
            {
                let nested = nested.get_or_insert_default();
                // Columns that leave most boxes in one were misled by what lies far outside.
                let over = if 2 * column.entries.len() > all { Over::Bulk } else { Over::All };
                if let Some(flow) = nested.sweep((&column, grid), (full, over), question, (names, depth)) {
                    flow?;
                    continue;
                }
            }
            strips.fill(column.entries);
            let mut progress = Progress::default();
            loop {
                let count = strips.sweep(width, (&column, grid), &mut progress, &mut hits);
                if count == 0 {
                    break;
                }
                question.answer::<NESTED>(&mut hits[..count], column.entries, names, &mut pairs)?;
            }
        }
        ControlFlow::Continue(())
    }
}

impl Nested {
    /// Sweeps a column in columns, by fresh statistics; not if they promise too little.
    fn sweep<B, A, S>(
        &mut self,
        (column, around): (&ColumnEntries<'_>, &Grid),
        (full, over): (usize, Over),
        question: &mut Question<'_, B, A, S>,
        (outer, depth): (Option<&Names<'_>>, usize),
    ) -> Option<ControlFlow<()>>
    where
        B: Bounds,
        A: Fn(u32, u32) -> bool,
        S: FnMut(&[PairId]) -> ControlFlow<()>,
    {
        let Self { columns, members, scratch } = self;
        let boxes = question.boxes;
        let pick = |entry: &Entry| boxes[outermost(entry.place & PLACE, outer) as usize];
        let grid = Grid::for_boxes(column.entries.len(), over, |place| pick(&column.entries[place]));
        let is_gain = grid.count() > 1 || grid.expected * GAIN <= full as f64;
        // Of boxes all around one spot, say: it would be the same again.
        if !is_gain || grid.is_like(around) {
            return None;
        }
        let pick = |place: usize| pick(&column.entries[place]);
        let grid = widest(Fill { columns, grid, count: column.entries.len(), pick });
        let (before, after) = (column.entries.len(), columns.len());
        let candidates =
            || (0..grid.count()).map(|index| columns.column(&grid, index).candidates(&grid)).sum::<usize>();
        // Unless nearly all straddle, what is a heap still is told apart further down.
        if after > 3 * before && candidates() as f64 * GAIN > (full * before) as f64 {
            return None;
        }
        let depth = depth + 2 * after / before.max(1);
        members.clear();
        members.extend(column.entries.iter().map(|entry| entry.place));
        let names = Names { members, outer };
        let level = Level::<_, _, _, true> {
            parts: core::slice::from_ref(columns),
            grid: &grid,
            range: 0..grid.count(),
            question,
            scratch,
            around: (Some(&names), depth),
        };
        Some(widest(level))
    }
}

/// The place of a box in what is swept, by its place in a column of columns.
fn outermost(place: u32, names: Option<&Names<'_>>) -> u32 {
    let mut place = place;
    let mut around = names;
    while let Some(&Names { members, outer }) = around {
        place = members[place as usize] & PLACE;
        around = outer;
    }
    place
}
