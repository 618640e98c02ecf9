//! The layout of columns, estimated from a sample of boxes. Only speed depends on it.

use super::codes::{Codes, Quantiser, rank};
use asunder_geometry::Bounds;

/// Columns over two axes, and the third axis, along which each is swept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) quantiser: Quantiser,
    /// The sweep axis: the one along which boxes are smallest relative to their spread.
    pub(crate) sweep: usize,
    /// Number of columns on the next axis and on the one after it.
    pub(crate) columns: [u32; 2],
    /// The sweep axis is cut into 2^`bin_bits` bins.
    pub(crate) bin_bits: u32,
    /// Bins or columns on the axis of each of the six codes.
    across: [u16; 6],
    /// Expected candidates of a box in all its columns.
    pub(crate) expected: f64,
}

/// The bin in which a box begins, and the first and last column that it reaches on both column axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) bin: u32,
    pub(crate) y: (u32, u32),
    pub(crate) z: (u32, u32),
}

/// What columns are laid over; anything outside goes into the outermost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Over {
    /// All boxes but a few.
    All,
    /// The range of the middle half of the boxes, widened to about twice that: the same as `All` if they are spread
    /// evenly; otherwise not much more than where most of them are, however far away a quarter is.
    Bulk,
}

/// Boxes per bin of the sweep axis, roughly.
const BOXES_A_BIN: f64 = 4.0;

/// Most entries per box on average.
const MOST_ENTRIES: usize = 4;

/// Columns are at least this many boxes wide,
const NARROWEST: f64 = 0.75;

/// and at most this many times the narrowest.
const WIDEST: f64 = 400.0;

/// Most columns on one axis.
const MOST_ACROSS: f64 = 1024.0;

/// Nanoseconds, by the stages of `compare -- broad` on one machine; only their ratios count, and the optimum is flat.
const PER_ENTRY: f64 = 16.0;
const PER_SIXTEEN: f64 = 3.0;
const PER_COLUMN: f64 = 20.0;

impl Grid {
    /// Lays columns out for `count` boxes, which `pick` gives by their places.
    pub(crate) fn for_boxes<B: Bounds>(count: usize, over: Over, pick: impl Fn(usize) -> B) -> Self {
        let spread = Spread::of(count, over, pick);
        let sweep = (0..3).min_by(|&a, &b| spread.fill(a).total_cmp(&spread.fill(b))).unwrap_or(0);
        let (y, z) = ((sweep + 1) % 3, (sweep + 2) % 3);
        let mut best = (f64::INFINITY, [1, 1], 0.0);
        // Tries widths of columns, in boxes; none so narrow that there would be more columns than boxes, however sparse
        // these are.
        let narrowest =
            NARROWEST.max((spread.boxes_across(y) * spread.boxes_across(z) / count.max(1) as f64).sqrt());
        let mut width = narrowest;
        while width < narrowest * WIDEST {
            let across = |axis: usize| {
                let most = (spread.boxes_across(axis) / width).min(MOST_ACROSS);
                if most >= 1.0 { most.floor() } else { 1.0 }
            };
            let columns = [across(y), across(z)];
            let (cost, expected) = spread.cost(count as f64, sweep, columns);
            if cost < best.0 && columns[0] * columns[1] <= (count as f64).max(1.0) {
                best = (cost, columns.map(|across| across as u32), expected);
            }
            width *= 1.33;
        }
        let each = count as f64 / f64::from(best.1[0] * best.1[1]);
        let bin_bits = (0..12).take_while(|&bits| f64::from(1 << bits) * BOXES_A_BIN < each).count() as u32;
        let grid = Self {
            quantiser: Quantiser::over(spread.range),
            sweep,
            columns: [1, 1],
            bin_bits,
            across: [0; 6],
            expected: best.2,
        };
        grid.with_columns(best.1)
    }

    /// The cells of a box.
    #[inline(always)]
    pub(crate) fn reach(&self, codes: &Codes) -> Reach {
        // Written out: without link-time optimisation `zip` and `map` are calls, which took half the time of a sweep.
        let step = |side: usize| ((rank(codes[side]) * u32::from(self.across[side])) >> 16) as u16;
        let steps = [step(0), step(1), step(2), step(3), step(4), step(5)];
        let at = |side: usize| u32::from(steps[side]);
        let [y, z] = [(self.sweep + 1) % 3, (self.sweep + 2) % 3];
        Reach { bin: at(self.sweep), y: (at(y), at(y + 3)), z: (at(z), at(z + 3)) }
    }

    /// The number of a bin of a column.
    #[inline(always)]
    pub(crate) const fn cell(&self, y: u32, z: u32, bin: u32) -> u32 {
        ((y * self.columns[1] + z) << self.bin_bits) + bin
    }

    /// Steps from a bin to the same bin of the next column, on both axes.
    pub(crate) const fn steps(&self) -> (u32, u32) {
        (self.columns[1] << self.bin_bits, 1 << self.bin_bits)
    }

    /// The bin of a code on the sweep axis.
    #[inline(always)]
    pub(crate) fn bin(&self, code: i16) -> usize {
        (rank(code) >> (16 - self.bin_bits)) as usize
    }

    /// The number of columns.
    pub(crate) const fn count(&self) -> usize {
        (self.columns[0] * self.columns[1]) as usize
    }

    /// Whether cells are about as large as those of another grid, on all axes.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let cells = |grid: &Self, axis: usize| {
            let across = if axis == grid.sweep { 1.0 } else { f64::from(grid.across[axis]) };
            across * grid.quantiser.per_metre(axis)
        };
        let is_close = |axis: usize| (0.8..1.25).contains(&(cells(self, axis) / cells(other, axis)));
        self.sweep == other.sweep && (0..3).all(is_close)
    }

    fn with_columns(self, columns: [u32; 2]) -> Self {
        let mut across = [1 << self.bin_bits; 6];
        for (offset, columns) in columns.into_iter().enumerate() {
            let axis = (self.sweep + 1 + offset) % 3;
            (across[axis], across[axis + 3]) = (columns as u16, columns as u16);
        }
        Self { columns, across, ..self }
    }

    /// Most entries to allow for so many boxes, whatever the sample suggested: with more, columns are too fine.
    pub(crate) const fn most_entries(&self, boxes: usize) -> usize {
        if self.count() > 1 { MOST_ENTRIES * boxes } else { usize::MAX }
    }

    /// The same with a quarter of the columns.
    pub(crate) fn coarser(self) -> Self {
        self.with_columns(self.columns.map(|across| across.div_ceil(2)))
    }
}

/// How a sample of boxes is spread.
struct Spread {
    /// The range of boxes on each axis: without the outermost, then widened.
    range: [(f32, f32); 3],
    /// Mean size on each axis.
    size: [f64; 3],
    /// How many times likelier two boxes are to share a place than if all were spread evenly.
    crowding: f64,
}

/// Boxes in a sample, at most: it lies on the stack, so that a steady scene allocates nothing.
const SAMPLE: usize = 512;

/// 2^32 over the golden ratio: its multiples are spread evenly, and in step with no pattern of the boxes.
const GOLDEN: u32 = 0x9e37_79b9;

/// Sizes are capped at this many times the median: a giant must not coarsen the grid.
const GIANT: f32 = 32.0;

/// Least and greatest corner.
type Corners = ([f32; 3], [f32; 3]);

impl Spread {
    // Not inlined: every level of nested columns would keep its stack frame.
    #[inline(never)]
    fn of<B: Bounds>(count: usize, over: Over, pick: impl Fn(usize) -> B) -> Self {
        let wanted = (count / 16).clamp(32, SAMPLE).min(count) as u32;
        // Not at a stride: if boxes were created alternately here and there, only one of the places would be sampled.
        let place = |number: u32| ((u64::from(number.wrapping_mul(GOLDEN)) * count as u64) >> 32) as usize;
        let is_finite =
            |b: &Corners| (0..3).all(|axis| b.0[axis] <= b.1[axis] && (b.1[axis] - b.0[axis]).is_finite());
        let (mut sample, mut len) = ([([0.0; 3], [0.0; 3]); SAMPLE], 0);
        let drawn = (0..wanted).map(|number| pick(place(number)).corners()).filter(is_finite);
        for (to, corners) in sample.iter_mut().zip(drawn) {
            *to = corners;
            len += 1;
        }
        let sample = &sample[..len];
        let mut scratch = [0.0; SAMPLE];
        let mut quantile = |of: &dyn Fn(&Corners) -> f32, percent: usize| -> f32 {
            if len == 0 {
                return 0.0;
            }
            for (to, corners) in scratch.iter_mut().zip(sample) {
                *to = of(corners);
            }
            let place = (len * percent / 100).min(len - 1);
            *scratch[..len].select_nth_unstable_by(place, f32::total_cmp).1
        };
        let (first, last, widened) = match over {
            Over::All => (1, 98, 0.06),
            Over::Bulk => (25, 74, 0.56),
        };
        let range = [0, 1, 2].map(|axis| {
            let (low, high) = (quantile(&|b| b.0[axis], first), quantile(&|b| b.1[axis], last));
            let (low, high) = (low.min(high), high.max(low));
            let more = (high - low) * widened;
            (low - more, high + more)
        });
        let range = range.map(|(low, high)| (low.max(-1e38), high.min(1e38)));
        let size = [0, 1, 2].map(|axis| {
            let most = quantile(&|b| b.1[axis] - b.0[axis], 50) * GIANT;
            let sum: f64 = sample.iter().map(|b| f64::from((b.1[axis] - b.0[axis]).min(most))).sum();
            sum / sample.len().max(1) as f64
        });
        let crowding = crowding(sample, &range);
        Self { range, size, crowding }
    }

    fn extent(&self, axis: usize) -> f64 {
        f64::from(self.range[axis].1) - f64::from(self.range[axis].0)
    }

    /// How many boxes fit on an axis side by side; very many if they have no size.
    fn boxes_across(&self, axis: usize) -> f64 {
        let across = self.extent(axis) / self.size[axis];
        // NaN where there is neither extent nor size, and negative where all is beyond the range.
        if across >= 1.0 { across.min(1e15) } else { 1.0 }
    }

    /// The fraction of an axis that one box fills.
    fn fill(&self, axis: usize) -> f64 {
        let fill = self.size[axis] / self.extent(axis);
        if fill < 1.0 { fill } else { 1.0 }
    }

    /// Expected cost of a sweep with so many columns, and candidates per box.
    fn cost(&self, count: f64, sweep: usize, columns: [f64; 2]) -> (f64, f64) {
        let (y, z) = ((sweep + 1) % 3, (sweep + 2) % 3);
        let entries = count * (1.0 + self.fill(y) * columns[0]) * (1.0 + self.fill(z) * columns[1]);
        let all = columns[0] * columns[1];
        let expected = entries / all * self.crowding * self.fill(sweep);
        (
            entries * (PER_ENTRY + PER_SIXTEEN * (expected / 16.0 + 0.6)) + all * PER_COLUMN,
            expected * entries / count,
        )
    }
}

/// Estimates `Spread::crowding` from a histogram of the sample in 8 x 8 x 8 cells.
fn crowding(sample: &[Corners], range: &[(f32, f32); 3]) -> f64 {
    let cells = Quantiser::over(*range);
    let mut counts = [0_u16; 512];
    let mut met = 0_u32;
    for (low, _) in sample {
        let codes = cells.codes(*low, *low);
        let cell = (0..3).fold(0, |cell, axis| cell * 8 + (rank(codes[axis]) >> 13));
        let count = &mut counts[(cell & 511) as usize];
        met += u32::from(*count);
        *count += 1;
    }
    let pairs = sample.len() * sample.len().saturating_sub(1) / 2;
    (512.0 * f64::from(met) / pairs.max(1) as f64).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_geometry::{Aabb3, glam::Vec3};

    fn spread(count: u32, at: impl Fn(Vec3) -> Vec3) -> Vec<Aabb3> {
        // Multiples of three irrational numbers: spread evenly.
        let part = |i: u32, by: f64| (f64::from(i) * by).fract() as f32;
        let center = |i: u32| at(Vec3::new(part(i, 0.819_172_5), part(i, 0.671_043_6), part(i, 0.549_700_4)));
        (0..count).map(center).map(|center| Aabb3::new(center, center + Vec3::splat(1e-3))).collect()
    }

    #[test]
    fn however_far_some_boxes_are_there_are_columns_and_not_more_than_boxes() {
        for count in [10_000, 50_000] {
            for far in [1.0, 1e3, 1e5] {
                let mut boxes = spread(count, |center| center);
                for one in boxes.iter_mut().step_by(25) {
                    *one = Aabb3::new(one.min * far, one.min * far + Vec3::splat(1e-3));
                }
                let grid = Grid::for_boxes(boxes.len(), Over::All, |place| boxes[place]);
                assert!(grid.count() > 1 && grid.count() <= boxes.len(), "{count} {far}: {:?}", grid.columns);
            }
        }
    }

    #[test]
    fn a_fifth_of_boxes_far_away_does_not_decide_where_the_bulk_is() {
        let even = spread(4000, |center| center);
        let mut odd = even.clone();
        for one in odd.iter_mut().step_by(5) {
            *one = Aabb3::new(one.min * 1e6, one.max * 1e6);
        }
        let lay = |boxes: &[Aabb3], over| Grid::for_boxes(boxes.len(), over, |place| boxes[place]);
        let (all, bulk) = (lay(&odd, Over::All), lay(&odd, Over::Bulk));
        assert!((0..3).all(|axis| bulk.quantiser.per_metre(axis) > 1e4 * all.quantiser.per_metre(axis)));
        let (all, bulk) = (lay(&even, Over::All), lay(&even, Over::Bulk));
        for axis in 0..3 {
            let ratio = bulk.quantiser.per_metre(axis) / all.quantiser.per_metre(axis);
            assert!((0.8..1.25).contains(&ratio), "evenly spread, the same: {ratio}");
        }
        assert!(all.is_like(&all) && !all.is_like(&lay(&odd, Over::All)));
    }
}
