//! Boxes at rest, found in the columns of the last sweep of all.

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

/// What is known of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// It rests, and is found in the columns.
    Rests,
    /// It rests, but is so long on the sweep axis that it is found in an index of such boxes instead.
    Reaches,
    /// It has moved.
    Moves,
}

/// Boxes at rest.
#[derive(Debug)]
pub(super) struct Rest<B> {
    states: Vec<State>,
    /// Most bins that a box which [`Rests`](State::Rests) reaches beyond its first.
    longest: u32,
    far: Index<B>,
    /// The entries of all columns, in order.
    packs: Vec<Pack>,
    looks: Vec<Look>,
    /// The first cell of each look, and its place in `looks`.
    starts: Vec<PairId>,
    order: Order,
}

asunder_geometry::copied!(Rest<B>, for [B: Bounds], { states, longest, far, packs } but { looks, starts, order });

/// Lengths in bins that are counted one by one.
const BINS: usize = 32;

/// Up to one box in this many goes into the index, besides those too long to be counted by their length.
const FAR: usize = 256;

/// Most candidates of movers in the columns, per box: about what a sweep of all takes where columns are of no use.
const MOST_A_BOX: usize = 1024;

/// Cost of a column that a mover reaches, in candidates: it limits these to four for every box.
const A_STRETCH: usize = 256;

/// Most tests between movers, per column in which one looks: about what a sweep of the movers takes.
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

    /// Notes that all boxes rest where the sweep has just found them.
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
        // The least length that leaves out only a few boxes.
        let (mut longest, mut left_out) = (BINS - 1, counts[BINS - 1]);
        while longest > 0 && left_out + counts[longest - 1] <= boxes.len() / FAR {
            longest -= 1;
            left_out += counts[longest];
        }
        // The last counter counts all longer ones.
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

    /// Notes that a box moves or is new; returns whether it was not a mover yet.
    pub(super) fn wakes(&mut self, place: u32) -> bool {
        let place = place as usize;
        if place >= self.states.len() {
            // It was not there at the last sweep of all. Boxes in between are new as well, and are noted in turn.
            self.states.resize(place + 1, State::Rests);
        }
        core::mem::replace(&mut self.states[place], State::Moves) != State::Moves
    }

    /// Hands over the overlapping pairs of movers with other boxes: all or some, as the result says. Stops if there are
    /// too many.
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

/// Which pairs of movers were handed over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Met {
    Everybody,
    /// Those with boxes at rest only: movers are so crowded that a sweep of them costs less than testing them here.
    Resting,
    /// None: there are so many candidates that a sweep of all boxes costs less.
    Nobody,
}

/// The lookup of one mover in one column that it reaches.
#[derive(Clone, Copy, Debug)]
struct Look {
    mover: u32,
    codes: Codes,
    stretch: Stretch,
}

/// Lists the lookups of all movers; false if they would cost too much.
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

/// Looks up boxes at rest, in the order of the columns, so that a mover finds in cache what the one before has loaded.
/// False if it was told to stop.
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

/// Hands over the pairs of movers, by a sweep over their lookups in order of first cells. False, and none handed over,
/// if that takes so many tests that a sweep of the movers costs less.
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

/// The widest gap between two boxes on any axis, in codes.
#[inline(always)]
fn widest_gap(one: &Codes, other: &Codes) -> i16 {
    let on = |axis: usize| gap([one[axis], one[axis + 3]], [other[axis], other[axis + 3]]);
    on(0).max(on(1)).max(on(2))
}
