//! Sweeps the columns of a grid one after the other; columns that are too full are swept in columns of their own.

use super::rows::{HITS, Hit, Progress, Strips};
use super::segments::{Segments, worth};
use super::settle::{NO_PAIRS, Names, Question, outermost};
use super::trial::{Way, way};
use crate::columns::codes::{Entry, may_overlap};
use crate::columns::grid::{Grid, Over};
use crate::columns::{ColumnEntries, Columns, Fill, PLACE, SCATTERED};
use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use core::ops::{ControlFlow, Range};

/// Scratch memory of one thread.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    strips: Strips,
    /// A column of several parts, put together.
    gathered: Columns,
    nested: Option<Box<Nested>>,
    /// For where columns are of no use.
    pub(super) segments: Segments,
}

/// Sweeps a column that is too full in columns of its own.
#[derive(Debug, Default)]
struct Nested {
    columns: Columns,
    members: Vec<u32>,
    scratch: Scratch,
}

/// A column counts as crowded if it holds more than this many boxes,
const MANY: usize = 96;
/// and either this many times the average of all columns,
const CROWDED: usize = 3;
/// or this many in one bin, as the outermost bins do that take all that lies outside of the grid.
const HEAP: usize = 48;
/// A crowded column is worth columns of its own above this many candidates per box, eight rounds of lanes, which take
/// about as long as to put the box into columns again (32 in place of 128: 1.7 times as long for 1000 boxes in eight
/// clumps, 1.2 times for 2000, elsewhere the same; Zen 4, 2026-11-22),
const FULL: usize = 128;
/// if these are expected to reduce the candidates by this factor.
const GAIN: f64 = 2.0;

/// Candidates that are sampled before a walk by segments.
const LOOKS: usize = 128;
/// Cost of a candidate that only the boxes can separate, relative to one that codes separate.
const MISLED: usize = 20;

/// Budget for the nesting of columns, as clumps of clumps of clumps need it. Each level uses up twice the number of
/// entries that its boxes have on average: this allows six levels where few boxes straddle columns, two where all do,
/// and some dozens of entries per box at most. What is still crowded after that is left to segments (24 in place of 12:
/// up to 1.5 times as long where clumps shrink by halves; 8: 0.8 to 1.3 times there, and up to 1.4 where they shrink by
/// thousandths; Zen 4, 2026-11-22).
const DEEPEST: usize = 12;

/// How many boxes make a column crowded, if all columns of the grid hold `all` of them.
pub(crate) fn crowd(all: usize, grid: &Grid) -> usize {
    CROWDED * all / grid.count()
}

/// Candidates per box of a column, if it is so full that columns of its own, or segments, may be worth it.
#[inline(always)]
pub(crate) fn overfull(column: &ColumnEntries<'_>, grid: &Grid, crowd: usize) -> Option<usize> {
    let count = column.entries.len();
    if way() == Way::SegmentsInColumns {
        return Some(count);
    }
    let is_crowd = count > MANY && (count > crowd || column.fullest_bin() > HEAP);
    // However even the columns are, one may be so full that segments pay.
    let least = if is_crowd { FULL } else { worth(count).max(FULL) };
    if count <= least {
        return None;
    }
    Some(column.candidates(grid) / count).filter(|&full| full > least)
}

/// Whether to sweep a column as it is would take longer than a walk by segments.
///
/// Candidates that codes cannot separate cost far more: clumps far smaller than a code take 3 ns per candidate in place
/// of 0.17 (Zen 4, 2026-11-22). So some candidates are sampled.
#[inline(never)]
fn is_hard(
    full: usize,
    column: &ColumnEntries<'_>,
    grid: &Grid,
    overlap: impl Fn(&Entry, &Entry) -> bool,
) -> bool {
    let entries = column.entries;
    let misleads = |number: usize| {
        let row = number * entries.len() / LOOKS;
        let end = column.row_end(&entries[row].codes, grid).min(entries.len());
        let candidates = &entries[(row + 1).min(end)..end];
        let one = &entries[row];
        // Not in step with the rows.
        let other = candidates.get(candidates.len() * (number * 37 % LOOKS) / LOOKS);
        other.is_some_and(|other| may_overlap(&one.codes, &other.codes) && !overlap(one, other))
    };
    let misled = (0..LOOKS).filter(|&number| misleads(number)).count();
    way() == Way::SegmentsInColumns || full * (LOOKS + MISLED * misled) > LOOKS * worth(entries.len())
}

impl Scratch {
    /// A column of several parts, put together.
    #[cfg(feature = "parallel")]
    pub(super) fn gather(&mut self, parts: &[Columns], grid: &Grid, index: usize) -> ColumnEntries<'_> {
        self.gathered.gather(parts, grid, index)
    }

    /// Memory of segments, that of nested columns included.
    #[cfg(test)]
    pub(super) fn bytes_of_segments(&self) -> usize {
        self.segments.bytes() + self.nested.as_ref().map_or(0, |nested| nested.scratch.bytes_of_segments())
    }

    pub(super) fn bytes(&self) -> usize {
        let nested = self.nested.as_ref().map_or(0, |nested| {
            nested.columns.bytes() + nested.members.capacity() * 4 + nested.scratch.bytes()
        });
        self.strips.bytes() + self.gathered.bytes() + self.segments.bytes() + nested
    }
}

/// A range of columns to sweep, of boxes that were sorted in one or more parts.
pub(super) struct Level<'a, 'q, B, const NESTED: bool> {
    pub(super) parts: &'a [Columns],
    pub(super) grid: &'a Grid,
    pub(super) range: Range<usize>,
    pub(super) question: &'a mut Question<'q, B>,
    pub(super) scratch: &'a mut Scratch,
    /// If these are nested columns: the places of their boxes in the column around, and how much of [`DEEPEST`] is used
    /// up.
    pub(super) around: (Option<&'a Names<'a>>, usize),
}

impl<B: Bounds, const NESTED: bool> Kernel for Level<'_, '_, B, NESTED> {
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> ControlFlow<()> {
        let Level { parts, grid, range, question, scratch, around: (names, depth) } = self;
        let Scratch { strips, gathered, nested, segments } = scratch;
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
            if let Some(full) = overfull(&column, grid, crowd) {
                if depth < DEEPEST && way() != Way::SegmentsInColumns {
                    let nested = nested.get_or_insert_default();
                    // If most boxes are in one column, outliers far away have stretched the grid.
                    let over = if 2 * column.entries.len() > all { Over::Bulk } else { Over::All };
                    if let Some(flow) = nested.sweep((&column, grid), (full, over), question, (names, depth))
                    {
                        flow?;
                        continue;
                    }
                }
                let overlap = |one: &Entry, other: &Entry| question.overlap(one, other, names);
                if is_hard(full, &column, grid, overlap) {
                    question.ask_column(segments, (column.entries, grid.sweep), names, &mut pairs)?;
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
    /// Sweeps a column in columns of its own, by fresh statistics. `None`, and nothing swept, if they promise too
    /// little.
    fn sweep<B: Bounds>(
        &mut self,
        (column, around): (&ColumnEntries<'_>, &Grid),
        (full, over): (usize, Over),
        question: &mut Question<'_, B>,
        (outer, depth): (Option<&Names<'_>>, usize),
    ) -> Option<ControlFlow<()>> {
        let Self { columns, members, scratch } = self;
        let boxes = question.boxes;
        let pick = |entry: &Entry| boxes[outermost(entry.place & PLACE, outer) as usize];
        let grid = Grid::for_boxes(column.entries.len(), over, |place| pick(&column.entries[place]));
        let is_gain = grid.count() > 1 || grid.expected * GAIN <= full as f64;
        // A grid like the one around (of boxes that all share one spot, say) would bring the same again.
        if !is_gain || grid.is_like(around) {
            return None;
        }
        let pick = |place: usize| pick(&column.entries[place]);
        let grid = widest(Fill::<_, SCATTERED> { columns, grid, count: column.entries.len(), pick });
        let (before, after) = (column.entries.len(), columns.len());
        // Where many boxes straddle, the columns as filled must show the gain; otherwise the next level cuts what is
        // still crowded.
        let straddle = after > before + before / 2;
        if straddle && columns.candidates(&grid) as f64 * GAIN > (full * before) as f64 {
            return None;
        }
        let depth = depth + 2 * after / before.max(1);
        members.clear();
        members.extend(column.entries.iter().map(|entry| entry.place));
        let names = Names { members, outer };
        let level = Level::<_, true> {
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
