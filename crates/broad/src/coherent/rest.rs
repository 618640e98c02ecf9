//! Boxes at rest, in the columns of the sweep that met them first.

use super::Gathered;
use crate::columns::codes::{Codes, gap};
use crate::columns::grid::Grid;
use crate::columns::{Columns, Stretch, begins, owned};
use crate::index::Index;
use crate::pair::PairId;
use crate::sweep::order::Order;
use crate::sweep::rows::Pack;
use crate::sweep::trial::note;
use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use core::ops::ControlFlow;

/// What may be known of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// It is found in the columns.
    Rests,
    /// It rests, and reaches so far along the sweep axis that it is found in an index of its like.
    Reaches,
    /// It has moved.
    Moves,
}

/// Boxes at rest.
#[derive(Debug)]
pub(super) struct Rest<B> {
    states: Vec<State>,
    /// Bins that any box but those that reach far reaches beyond its first.
    longest: u32,
    far: Index<B>,
    /// The entries of all columns.
    packs: Vec<Pack>,
    looks: Vec<Look>,
    /// The cell in which each of them starts, and which it is.
    starts: Vec<PairId>,
    order: Order,
}

asunder_geometry::copied!(Rest<B>, for [B: Bounds], { states, longest, far, packs } but { looks, starts, order });

/// Bins that are counted one by one.
const BINS: usize = 32;

/// One box of so many may be kept out of the columns.
const FAR: usize = 256;

/// Most candidates that movers may have in the columns, for every box: about what a sweep of all takes where columns
/// are of no use.
const MOST_A_BOX: usize = 1024;

/// What a column counts as that a mover reaches, in candidates: so that there are at most four for every box.
const A_STRETCH: usize = 256;

/// Most tests of one mover against another, for every column in which one looks: about what a sweep of the movers takes.
const MOST_A_LOOK: usize = 16;

impl<B: Bounds> Rest<B> {
    pub(super) fn new() -> Self {
        Self {
            states: Vec::new(),
            longest: 0,
            far: Index::new(),
            packs: Vec::new(),
            looks: Vec::new(),
            starts: Vec::new(),
            order: Order::default(),
        }
    }
    pub(super) fn bytes(&self) -> usize {
        self.states.capacity()
            + self.far.bytes()
            + self.packs.capacity() * size_of::<Pack>()
            + self.looks.capacity() * size_of::<Look>()
            + self.starts.capacity() * size_of::<PairId>()
            + self.order.bytes()
    }

    /// All boxes rest, as they were just swept.
    pub(super) fn settle(&mut self, boxes: &[B], grid: &Grid, columns: &Columns) {
        let length = |codes: &Codes| {
            let [first, last] = [grid.sweep, grid.sweep + 3].map(|bound| grid.bin(codes[bound]));
            last.saturating_sub(first)
        };
        let mut counts = [0; BINS];
        let all = || columns.entries().iter().filter_map(|entry| Some((begins(entry.place)?, &entry.codes)));
        for (_, codes) in all() {
            counts[length(codes).min(BINS - 1)] += 1;
        }
        // As few bins as leave only few boxes out.
        let (mut longest, mut left_out) = (BINS - 1, counts[BINS - 1]);
        while longest > 0 && left_out + counts[longest - 1] <= boxes.len() / FAR {
            longest -= 1;
            left_out += counts[longest];
        }
        // What is counted last is anything longer.
        self.longest = longest.saturating_sub(1) as u32;
        self.states.clear();
        self.states.resize(boxes.len(), State::Rests);
        for (place, codes) in all() {
            if length(codes) > self.longest as usize {
                self.states[place as usize] = State::Reaches;
            }
        }
        let states = &self.states;
        Pack::fill(&mut self.packs, columns.entries());
        self.far.build_from(boxes, |place| states[place as usize] == State::Reaches);
    }

    /// Whether the box has not moved.
    #[inline]
    pub(super) fn rests(&self, place: u32) -> bool {
        self.states[place as usize] != State::Moves
    }

    /// Notes that a box moves, or has come; whether that is news.
    pub(super) fn wakes(&mut self, place: u32) -> bool {
        let place = place as usize;
        if place >= self.states.len() {
            // One that was not there when all were swept. Whoever comes between is new as well, and has its turn.
            self.states.resize(place + 1, State::Rests);
        }
        core::mem::replace(&mut self.states[place], State::Moves) != State::Moves
    }

    /// Hands over each pair of a mover and another box that overlap, or fewer, as it tells; until there are too many.
    pub(super) fn meet(
        &mut self,
        (grid, columns): (&Grid, &Columns),
        boxes: &[B],
        movers: &[u32],
        found: &mut Gathered,
    ) -> Met {
        let Self { states, longest, far, packs, looks, starts, order } = self;
        let longest = *longest;
        let looking = Looking { grid, columns, boxes, movers, longest, looks };
        if !widest(looking) {
            return Met::Nobody;
        }
        starts.clear();
        starts.extend((0..).zip(&*looks).map(|(which, look)| PairId { a: look.stretch.cells[0], b: which }));
        let cells = grid.count() << grid.bin_bits;
        let numbers = cells.max(starts.len()) + 1;
        order.sort_by_first(starts, numbers);
        let has_met_movers = each_other(looks, starts, boxes, found);
        let goes_on = widest(Asking { packs, boxes, states, looks, starts, found });
        if goes_on && !far.is_empty() {
            for &mover in movers {
                let flow = far.visit_overlapping(&boxes[mover as usize], |place| {
                    let goes_on =
                        states[place as usize] == State::Moves || found.take(PairId::new(mover, place));
                    if goes_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
                });
                if flow.is_break() {
                    break;
                }
            }
        }
        if has_met_movers { Met::Everybody } else { Met::Resting }
    }
}

/// Whom movers have met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Met {
    Everybody,
    /// Boxes at rest only: among themselves they are so crowded that a sweep of them costs less.
    Resting,
    /// There is so much to look at that a sweep of all boxes costs less.
    Nobody,
}

/// A column that a mover reaches.
#[derive(Clone, Copy, Debug)]
struct Look {
    mover: u32,
    codes: Codes,
    stretch: Stretch,
}

/// Says where to look; false where that is too much.
struct Looking<'a, B> {
    grid: &'a Grid,
    columns: &'a Columns,
    boxes: &'a [B],
    movers: &'a [u32],
    longest: u32,
    looks: &'a mut Vec<Look>,
}

impl<B: Bounds> Kernel for Looking<'_, B> {
    type Output = bool;

    #[inline(always)]
    fn run<W: Width>(self, _: W) -> bool {
        let Self { grid, columns, boxes, movers, longest, looks } = self;
        looks.clear();
        let (mut cost, most) = (0, MOST_A_BOX * boxes.len());
        for &mover in movers {
            if cost > most {
                return false;
            }
            let bounds = &boxes[mover as usize];
            if bounds.is_valid() {
                let (low, high) = bounds.corners();
                let codes = grid.quantiser.codes(low, high);
                columns.stretches(grid, &codes, longest, |stretch| {
                    cost += A_STRETCH + (stretch.end - stretch.start) as usize;
                    looks.push(Look { mover, codes, stretch });
                });
            }
        }
        true
    }
}

/// Looks for boxes at rest, in the order of the columns: what one mover has brought from far memory, the next one finds
/// at hand. False if it was told to stop.
struct Asking<'a, 'g, B> {
    packs: &'a [Pack],
    boxes: &'a [B],
    states: &'a [State],
    looks: &'a [Look],
    starts: &'a [PairId],
    found: &'a mut Gathered<'g>,
}

impl<B: Bounds> Kernel for Asking<'_, '_, B> {
    type Output = bool;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> bool {
        let Self { packs, boxes, states, looks, starts, found } = self;
        let mut goes_on = true;
        for start in starts {
            let Look { mover, codes, stretch } = looks[start.b as usize];
            let range = stretch.start as usize..stretch.end as usize;
            Pack::meet(packs, width, &codes, range, |place, is_close| {
                let (place, _, is_ours) = owned(place, stretch.home);
                if is_ours && states[place as usize] == State::Rests && goes_on {
                    let overlap = !is_close || boxes[mover as usize].overlaps(&boxes[place as usize]);
                    goes_on = !overlap || found.take(PairId::new(mover, place));
                }
            });
            if !goes_on {
                break;
            }
        }
        goes_on
    }
}

/// Hands over the pairs of movers, which meet in the columns in which both look for others: those that look from one
/// cell on are side by side. False, and none handed over, where that is so much that a sweep of the movers costs less.
fn each_other<B: Bounds>(looks: &[Look], starts: &[PairId], boxes: &[B], found: &mut Gathered) -> bool {
    let (mut tests, most) = (0, MOST_A_LOOK * looks.len());
    let first = found.pairs.len();
    for (after, start) in (1..).zip(starts) {
        let one = &looks[start.b as usize];
        for start in starts[after..].iter().take_while(|start| start.a <= one.stretch.cells[1]) {
            let other = &looks[start.b as usize];
            let gap = widest_gap(&one.codes, &other.codes);
            if gap <= 0 && owned(one.stretch.home, other.stretch.home).2 {
                let [a, b] = [one.mover, other.mover];
                if gap < 0 || boxes[a as usize].overlaps(&boxes[b as usize]) {
                    found.pairs.push(PairId::new(a, b));
                }
            }
            tests += 1;
            if tests > most {
                found.pairs.truncate(first);
                note(tests);
                return false;
            }
        }
    }
    note(tests);
    true
}

/// The widest gap between two boxes, as far as codes can tell.
#[inline(always)]
fn widest_gap(one: &Codes, other: &Codes) -> i16 {
    let on = |axis: usize| gap([one[axis], one[axis + 3]], [other[axis], other[axis + 3]]);
    on(0).max(on(1)).max(on(2))
}
