//! The sweep of one column, sixteen boxes at a time.

use super::trial::note;
use crate::columns::ColumnEntries;
use crate::columns::codes::{Codes, Entry, gap};
use crate::columns::grid::Grid;
use crate::width::Width;
use core::ops::Range;

/// Boxes tested side by side.
pub(crate) const LANES: usize = 16;

/// The boxes of one column as a structure of arrays: a strip for each of the six codes, ordered along the sweep axis.
#[derive(Debug, Default)]
pub(crate) struct Strips {
    strips: [Vec<i16>; 6],
}

asunder_geometry::copied!(Strips, { strips } but {});

/// A box, and which of the sixteen boxes from `first` on it may overlap.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hit {
    pub(crate) row: u32,
    pub(crate) first: u32,
    /// The bits, as [`overlapping`] returns them.
    lanes: u32,
}

impl Hit {
    /// The next box that may overlap the row's, whether codes leave it undecided, and the hit without that box.
    #[inline(always)]
    pub(crate) const fn next(self) -> (u32, bool, Self) {
        let bit = (self.lanes & MAY).trailing_zeros();
        let index = self.first + bit - (bit >> 4) * 8;
        let is_close = (self.lanes >> 8) >> bit & 1 != 0;
        // The bits of the upper bytes stay: they count only where the lower bytes have theirs.
        (index, is_close, Self { lanes: self.lanes & !(1 << bit), ..self })
    }

    /// Whether no box is left.
    #[inline(always)]
    pub(crate) const fn is_done(self) -> bool {
        self.lanes & MAY == 0
    }
}

/// Hits that are gathered before they are processed.
pub(crate) const HITS: usize = 128;

/// How far a sweep of a column has come.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Progress {
    row: usize,
    /// The next box that the row is tested against; 0 at its start.
    next: usize,
}

impl Strips {
    pub(crate) fn bytes(&self) -> usize {
        self.strips.iter().map(|strip| strip.capacity() * 2).sum()
    }

    /// Turns entries into strips.
    #[inline(always)]
    pub(crate) fn fill(&mut self, entries: &[Entry]) {
        let count = entries.len();
        for (number, strip) in self.strips.iter_mut().enumerate() {
            // Pads with boxes that overlap nothing: lower bounds above all codes, upper bounds below.
            let never = if number < 3 { i16::MAX } else { i16::MIN };
            strip.resize(count + LANES, never);
            strip[count..].fill(never);
        }
        let [a, b, c, d, e, f] = &mut self.strips;
        let (a, b, c, d, e, f) = (
            &mut a[..count],
            &mut b[..count],
            &mut c[..count],
            &mut d[..count],
            &mut e[..count],
            &mut f[..count],
        );
        for (to, entry) in entries.iter().enumerate() {
            let codes = &entry.codes;
            (a[to], b[to], c[to], d[to], e[to], f[to]) =
                (codes[0], codes[1], codes[2], codes[3], codes[4], codes[5]);
        }
    }

    /// Continues until all rows are swept or `hits` is full; returns the number of hits, 0 when done.
    #[inline(always)]
    pub(crate) fn sweep<W: Width>(
        &self,
        width: W,
        (column, grid): (&ColumnEntries, &Grid),
        progress: &mut Progress,
        hits: &mut [Hit; HITS],
    ) -> usize {
        let length = column.entries.len() + LANES;
        let [a, b, c, d, e, f] = &self.strips;
        let strips = [&a[..length], &b[..length], &c[..length], &d[..length], &e[..length], &f[..length]];
        let mut found = 0;
        while progress.row < column.entries.len() {
            let row = progress.row;
            let codes = column.entries[row].codes;
            let end = column.row_end(&codes, grid);
            let mut next = progress.next.max(row + 1);
            while next < end {
                if found == HITS {
                    progress.next = next;
                    return found;
                }
                let Some(strips) = lanes(strips, next) else { break };
                let lanes = overlapping(width, &codes, strips);
                hits[found] = Hit { row: row as u32, first: next as u32, lanes };
                found += usize::from(lanes & MAY != 0);
                next += LANES;
            }
            note(1 + end.saturating_sub(row + 1).div_ceil(LANES));
            *progress = Progress { row: row + 1, next: 0 };
        }
        found
    }
}

/// Codes and places of sixteen entries that follow each other in their column. The random access of movers then touches
/// four adjacent cache lines, where strips and entries have some fourteen.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct Pack {
    codes: [[i16; LANES]; 6],
    /// As in [`Entry`].
    places: [u32; LANES],
}

impl Pack {
    /// Replaces `packs` by all entries, sixteen each.
    pub(crate) fn fill(packs: &mut Vec<Self>, entries: &[Entry]) {
        packs.clear();
        packs.extend(entries.chunks(LANES).map(|entries| {
            // Pads with boxes that overlap nothing.
            let mut pack = Self { codes: [[i16::MIN; LANES]; 6], places: [0; LANES] };
            pack.codes[..3].fill([i16::MAX; LANES]);
            for (lane, entry) in entries.iter().enumerate() {
                pack.places[lane] = entry.place;
                for (strip, code) in pack.codes.iter_mut().zip(entry.codes) {
                    strip[lane] = code;
                }
            }
            pack
        }));
    }

    /// Hands over the places of the entries in `range` that a box may overlap by its codes, and whether codes leave it
    /// undecided.
    #[inline(always)]
    pub(crate) fn meet<W: Width>(
        packs: &[Self],
        width: W,
        codes: &Codes,
        range: Range<usize>,
        mut visit: impl FnMut(u32, bool),
    ) {
        let first = range.start / LANES;
        let Some(packs) = packs.get(first..range.end.div_ceil(LANES)) else { return };
        note(packs.len());
        for (pack, number) in packs.iter().zip(first..) {
            let first = number * LANES;
            let mut hit = Hit { row: 0, first: 0, lanes: overlapping(width, codes, pack.codes.each_ref()) };
            while !hit.is_done() {
                let (lane, is_close, rest) = hit.next();
                if range.contains(&(first + lane as usize)) {
                    visit(pack.places[lane as usize & (LANES - 1)], is_close);
                }
                hit = rest;
            }
        }
    }
}

#[inline(always)]
fn lanes(strips: [&[i16]; 6], from: usize) -> Option<[&[i16; LANES]; 6]> {
    let [a, b, c, d, e, f] = strips;
    Some([
        a.get(from..)?.first_chunk()?,
        b.get(from..)?.first_chunk()?,
        c.get(from..)?.first_chunk()?,
        d.get(from..)?.first_chunk()?,
        e.get(from..)?.first_chunk()?,
        f.get(from..)?.first_chunk()?,
    ])
}

/// Bits of the lanes that may overlap.
pub(super) const MAY: u32 = 0x00ff_00ff;

const BITS: [i16; LANES] = {
    let mut bits = [0; LANES];
    let mut lane = 0;
    while lane < LANES {
        bits[lane] = (1_u16 << lane) as i16;
        lane += 1;
    }
    bits
};

/// Which of sixteen boxes one overlaps, as far as codes can tell: in every 16 bits the lower byte has the lanes that
/// may overlap, the upper byte those of them that codes leave undecided.
#[inline(always)]
fn overlapping<W: Width>(width: W, one: &Codes, others: [&[i16; LANES]; 6]) -> u32 {
    let mut gaps = [0; LANES];
    for lane in 0..LANES {
        let on = |axis: usize| gap([one[axis], one[axis + 3]], [others[axis][lane], others[axis + 3][lane]]);
        gaps[lane] = on(0).max(on(1)).max(on(2));
    }
    width.mask(&gaps)
}

/// The mask of a hit from the gaps between codes: below zero the boxes overlap, above zero they do not, and at zero
/// codes leave it undecided.
#[inline(always)]
pub(super) fn gaps_to_mask(gaps: &[i16; LANES]) -> u32 {
    let [mut may, mut close] = [0; 2];
    for lane in 0..LANES {
        let is_no_gap = gaps[lane].saturating_sub(1) >> 15;
        may |= is_no_gap & BITS[lane];
        close |= is_no_gap & !(gaps[lane] >> 15) & BITS[lane];
    }
    let spread = |bits: i16| u32::from(bits as u16 & 0xff) | u32::from(bits as u16 & 0xff00) << 8;
    spread(may) | spread(close) << 8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::width::Portable;

    /// Sixteen boxes with few and extreme codes, so that all cases of overlap come up.
    fn boxes(seed: &mut u32) -> ([Codes; LANES], [[i16; LANES]; 6]) {
        const CODES: [i16; 8] = [i16::MIN, -32_767, -32_766, -1, 0, 1, 32_766, 32_767];
        let mut code = || {
            *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            CODES[(*seed >> 24) as usize % CODES.len()]
        };
        let mut boxes = [[0; 6]; LANES];
        let mut strips = [[0; LANES]; 6];
        for (lane, codes) in boxes.iter_mut().enumerate() {
            for axis in 0..3 {
                let (a, b) = (code(), code());
                (codes[axis], codes[axis + 3]) = (a.min(b), a.max(b));
            }
            for (strip, code) in strips.iter_mut().zip(codes) {
                strip[lane] = *code;
            }
        }
        (boxes, strips)
    }

    /// The expected result of the lanes, from the definition, box by box.
    fn expected(one: &Codes, others: &[Codes; LANES]) -> Vec<(u32, bool)> {
        let verdict = |other: &Codes| {
            let gap = |axis: usize| {
                let before = i32::from(one[axis]) - i32::from(other[axis + 3]);
                before.max(i32::from(other[axis]) - i32::from(one[axis + 3]))
            };
            gap(0).max(gap(1)).max(gap(2))
        };
        let all = others.iter().map(verdict).zip(0..);
        all.filter(|&(gap, _)| gap <= 0).map(|(gap, lane)| (lane, gap == 0)).collect()
    }

    fn told(lanes: u32) -> Vec<(u32, bool)> {
        let mut hit = Hit { row: 0, first: 0, lanes };
        let mut told = Vec::new();
        while !hit.is_done() {
            let (index, is_close, rest) = hit.next();
            told.push((index, is_close));
            hit = rest;
        }
        told
    }

    #[test]
    fn lanes_tell_what_codes_say() {
        let mut seed = 7;
        let (mut may, mut close) = (0, 0);
        for _ in 0..3000 {
            let (all, strips) = boxes(&mut seed);
            let one = all[3];
            let (others, strips) = (all, strips.each_ref());
            let wanted = expected(&one, &others);
            may += wanted.len();
            close += wanted.iter().filter(|&&(_, is_close)| is_close).count();
            assert_eq!(told(overlapping(Portable, &one, strips)), wanted);
        }
        assert!(may > 10_000 && close > 1000, "{may} meetings, {close} of them close");
    }
}
