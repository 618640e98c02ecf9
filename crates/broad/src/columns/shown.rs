//! Columns as boxes, for debug views.

use super::Columns;
use super::grid::Grid;
use crate::sweep::level::{crowd, overfull};
use asunder_geometry::Aabb3;
use asunder_geometry::glam::Vec3;

/// A column that a sweep has sorted boxes into, for debug views to draw.
///
/// Columns affect how fast a sweep is, never which pairs it finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Where it lies, in metres; without height in the plane. The outermost columns also take everything outside of the
    /// grid; they are shown as far as nearly all boxes go.
    pub bounds: Aabb3,
    /// Boxes that reach into it.
    pub boxes: usize,
    /// Pairs of them that a sweep compares, as they are near each other along its axis. `None` for a column so full
    /// that it may be swept in columns of its own.
    pub candidates: Option<usize>,
}

impl Column {
    /// All columns of a grid that hold a box, each merged from all parts.
    pub(crate) fn all<'a>(grid: &'a Grid, parts: &'a [Columns]) -> impl Iterator<Item = Self> + 'a {
        let of_y = grid.columns[1] as usize;
        let (mut gathered, crowd) = (Columns::default(), crowd(parts.iter().map(Columns::len).sum(), grid));
        (0..grid.count()).filter_map(move |index| {
            let column = match parts {
                [one] => one.column(grid, index),
                several => gathered.gather(several, grid, index),
            };
            let boxes = column.entries.len();
            let is_told = overfull(&column, grid, crowd).is_none();
            let candidates = is_told.then(|| column.candidates(grid));
            let bounds = || grid.column_bounds(index / of_y, index % of_y);
            (boxes > 0).then(|| Self { bounds: bounds(), boxes, candidates })
        })
    }
}

impl Grid {
    fn column_bounds(&self, on_y: usize, on_z: usize) -> Aabb3 {
        let (mut low, mut high) = (Vec3::ZERO, Vec3::ZERO);
        for (offset, (place, columns)) in
            [(0, 1), (on_y, self.columns[0]), (on_z, self.columns[1])].into_iter().enumerate()
        {
            let axis = (self.sweep + offset) % 3;
            // The least rank of the codes in a column: the inverse of `reach`.
            let first = |place: usize| ((place << 16).div_ceil(columns as usize)) as u32;
            low[axis] = self.quantiser.least(axis, first(place));
            high[axis] = self.quantiser.least(axis, first(place + 1));
        }
        Aabb3::new(low, high)
    }
}

#[cfg(test)]
mod tests {
    use crate::Sweep;
    use asunder_geometry::{Aabb3, glam::Vec3};

    #[test]
    fn a_column_counts_the_boxes_that_reach_into_where_it_is_shown() {
        // Multiples of three irrational numbers: spread evenly, over 100 m by 60 m by 40 m.
        let part = |i: u32, by: f64| (f64::from(i) * by).fract() as f32;
        let place = |i| Vec3::new(part(i, 0.819_172_5), part(i, 0.671_043_6), part(i, 0.549_700_4));
        let boxes: Vec<Aabb3> = (0..3000)
            .map(|i| place(i) * Vec3::new(100.0, 60.0, 40.0))
            .map(|low| Aabb3::new(low, low + Vec3::splat(1.5)))
            .collect();
        let mut sweep = Sweep::new();
        assert_eq!(sweep.columns().count(), 0);
        sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut Vec::new()).unwrap();
        let columns: Vec<_> = sweep.columns().collect();
        assert!(columns.len() > 3, "{}", columns.len());
        let whole = columns.iter().map(|column| column.bounds).reduce(|all, one| all.union(&one)).unwrap();
        for column in &columns {
            // The outermost columns take everything beyond. Codes are a 65,536th of the whole.
            let count = |more: f32| {
                let mut grown = Aabb3::new(column.bounds.min - more, column.bounds.max + more);
                for axis in 0..3 {
                    if column.bounds.min[axis] == whole.min[axis] {
                        grown.min[axis] = f32::MIN;
                    }
                    if column.bounds.max[axis] == whole.max[axis] {
                        grown.max[axis] = f32::MAX;
                    }
                }
                boxes.iter().filter(|one| one.overlaps(&grown)).count()
            };
            assert!((count(-0.01)..=count(0.01)).contains(&column.boxes), "{column:?}");
        }
        assert!(columns.iter().map(|column| column.boxes).sum::<usize>() >= boxes.len());
        let mut pairs = 0;
        let _ = sweep.visit(
            &boxes,
            |_, _| true,
            |_| {
                pairs += 1;
                core::ops::ControlFlow::Continue(())
            },
        );
        let compared = sweep.columns().map(|column| column.candidates.unwrap()).sum::<usize>();
        // Every overlapping pair is compared, most other pairs are not, and no pair more than once per column.
        assert!(
            (pairs..boxes.len() * boxes.len() / 20).contains(&compared),
            "{pairs} pairs, {compared} compared"
        );
        assert!(
            columns.iter().all(|column| column.candidates.unwrap() <= column.boxes * (column.boxes - 1) / 2)
        );
    }

    #[test]
    fn a_column_that_is_cut_further_does_not_tell_what_it_compares() {
        // Two clumps far apart: columns over both leave each clump in one column.
        let part = |i: u32, by: f64| (f64::from(i) * by).fract() as f32;
        let place = |i| Vec3::new(part(i, 0.819_172_5), part(i, 0.671_043_6), part(i, 0.549_700_4));
        let aside = |i: u32| Vec3::splat(if i.is_multiple_of(2) { 0.0 } else { 1e5 });
        let boxes: Vec<Aabb3> = (0..4000)
            .map(|i| place(i) * 60.0 + aside(i))
            .map(|low| Aabb3::new(low, low + Vec3::splat(1.5)))
            .collect();
        let mut sweep = Sweep::new();
        sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut Vec::new()).unwrap();
        let full = sweep.columns().filter(|column| column.candidates.is_none()).map(|column| column.boxes);
        assert!(full.sum::<usize>() > 2000, "{:?}", sweep.columns().collect::<Vec<_>>());
    }

    #[cfg(feature = "parallel")]
    #[test]
    fn columns_sorted_in_parts_are_shown_as_one() {
        let low = |i: u32| Vec3::new((i % 40) as f32, (i / 40 % 40) as f32, (i / 1600) as f32) * 1.3;
        let boxes: Vec<Aabb3> = (0..40_000).map(|i| Aabb3::new(low(i), low(i) + Vec3::splat(1.1))).collect();
        let shown = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut sweep = Sweep::new();
            pool.install(|| sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut Vec::new())).unwrap();
            sweep.columns().collect::<Vec<_>>()
        };
        assert_eq!(shown(1), shown(3));
    }
}
