//! Boxes at rest, in the columns of the sweep that met them first.

use super::Gathered;
use crate::columns::codes::Codes;
use crate::columns::grid::Grid;
use crate::columns::{Columns, Stretch, begins, owned};
use crate::index::Index;
use crate::pair::PairId;
use crate::sweep::order::Order;
use crate::sweep::rows::Strips;
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
    /// The entries of all columns as strips.
    strips: Strips,
    asked: Vec<(u32, Codes, Stretch)>,
    /// Where each of them starts, and which it is.
    starts: Vec<PairId>,
    order: Order,
}

asunder_geometry::copied!(Rest<B>, for [B: Bounds], { states, longest, far, strips } but { asked, starts, order });

/// Bins that are counted one by one.
const BINS: usize = 32;

/// One box of so many may be kept out of the columns.
const FAR: usize = 256;

/// Most candidates that movers may have in the columns, for every box: about what a sweep of all takes where columns
/// are of no use.
const MOST_A_BOX: usize = 1024;

/// What a column counts as that a mover reaches, in candidates: so that there are at most four for every box.
const A_STRETCH: usize = 256;

impl<B: Bounds> Rest<B> {
    pub(super) fn new() -> Self {
        Self {
            states: Vec::new(),
            longest: 0,
            far: Index::new(),
            strips: Strips::default(),
            asked: Vec::new(),
            starts: Vec::new(),
            order: Order::default(),
        }
    }
    pub(super) fn bytes(&self) -> usize {
        self.states.capacity()
            + self.far.bytes()
            + self.strips.bytes()
            + self.asked.capacity() * size_of::<(u32, Codes, Stretch)>()
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
        self.strips.fill(columns.entries());
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

    /// Hands over each pair of a mover and a box at rest that overlap, until there are too many. Returns false, and has
    /// handed over none, if there is so much to look at that a sweep of all boxes costs less.
    pub(super) fn meet(
        &mut self,
        (grid, columns): (&Grid, &Columns),
        boxes: &[B],
        movers: &[u32],
        found: &mut Gathered,
    ) -> bool {
        let Self { states, longest, far, strips, asked, starts, order } = self;
        let longest = *longest;
        let asking = Asking {
            grid,
            columns,
            strips,
            boxes,
            movers,
            states,
            longest,
            asked,
            starts,
            order,
            found: &mut *found,
        };
        match widest(asking) {
            Looked::AtAll if !far.is_empty() => {}
            Looked::AtAll | Looked::UntilTold => return true,
            Looked::AtNone => return false,
        }
        for &mover in movers {
            let flow = far.visit_overlapping(&boxes[mover as usize], |place| {
                let goes_on = states[place as usize] == State::Moves || found.take(PairId::new(mover, place));
                if goes_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            });
            if flow.is_break() {
                break;
            }
        }
        true
    }
}

/// How far movers were looked up.
enum Looked {
    AtAll,
    UntilTold,
    /// It would have cost too much.
    AtNone,
}

/// Looks movers up in the columns.
///
/// First where to look, for all of them; then there, in the order of the columns: what one mover has brought from
/// far memory, the next one finds at hand.
struct Asking<'a, 'g, B> {
    grid: &'a Grid,
    columns: &'a Columns,
    strips: &'a Strips,
    boxes: &'a [B],
    movers: &'a [u32],
    states: &'a [State],
    longest: u32,
    asked: &'a mut Vec<(u32, Codes, Stretch)>,
    starts: &'a mut Vec<PairId>,
    order: &'a mut Order,
    found: &'a mut Gathered<'g>,
}

impl<B: Bounds> Kernel for Asking<'_, '_, B> {
    type Output = Looked;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> Looked {
        let Self { grid, columns, strips, boxes, movers, states, longest, asked, starts, order, found } =
            self;
        asked.clear();
        let (mut cost, most) = (0, MOST_A_BOX * boxes.len());
        for &mover in movers {
            if cost > most {
                return Looked::AtNone;
            }
            let bounds = &boxes[mover as usize];
            if bounds.is_valid() {
                let (low, high) = bounds.corners();
                let codes = grid.quantiser.codes(low, high);
                columns.stretches(grid, &codes, longest, |stretch| {
                    cost += A_STRETCH + (stretch.end - stretch.start) as usize;
                    asked.push((mover, codes, stretch));
                });
            }
        }
        starts.clear();
        starts.extend((0..).zip(&*asked).map(|(which, (.., stretch))| PairId { a: stretch.start, b: which }));
        let most = columns.entries().len().max(starts.len());
        order.sort_by_first(starts, most + 1);
        let mut goes_on = true;
        for start in &*starts {
            let (mover, codes, stretch) = asked[start.b as usize];
            let entries = columns.entries();
            let range = stretch.start as usize..stretch.end as usize;
            strips.meet(width, &codes, range, |index, is_close| {
                let (place, _, is_ours) = owned(entries[index].place, stretch.home);
                if is_ours && states[place as usize] == State::Rests && goes_on {
                    let overlap = !is_close || boxes[mover as usize].overlaps(&boxes[place as usize]);
                    goes_on = !overlap || found.take(PairId::new(mover, place));
                }
            });
            if !goes_on {
                break;
            }
        }
        if goes_on { Looked::AtAll } else { Looked::UntilTold }
    }
}
