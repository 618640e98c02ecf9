//! Loops of vertices in one flat list: the facets and faces while a hull is made.
//!
//! A hull of 16 points has some thirty, which are sorted, renumbered and compared: with a list of lists, a quarter of
//! the instructions of making a hull went into allocation (Intel Xeon, Ice Lake, 2026-11-27).

use core::ops::Range;

/// Loops of vertices, one after the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Loops {
    corners: Vec<u32>,
    /// Where each loop ends.
    ends: Vec<u32>,
}

impl Loops {
    /// No loops, with room for so many triangles.
    pub(super) fn with_room(triangles: usize) -> Self {
        Self { corners: Vec::with_capacity(3 * triangles), ends: Vec::with_capacity(triangles) }
    }

    pub(super) fn push(&mut self, around: impl IntoIterator<Item = u32>) {
        self.corners.extend(around);
        self.ends.push(self.corners.len() as u32);
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The range of a loop's corners among those of all.
    #[inline]
    pub(super) fn places(&self, index: usize) -> Range<usize> {
        let start = if index == 0 { 0 } else { self.ends[index - 1] as usize };
        start..self.ends[index] as usize
    }

    #[inline]
    pub(super) fn get(&self, index: usize) -> &[u32] {
        &self.corners[self.places(index)]
    }

    /// Loop after loop.
    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + Clone {
        (0..self.len()).map(|index| self.get(index))
    }

    /// The corners of all.
    pub(super) fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// The same loops with other vertex numbers.
    pub(super) fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        self.corners.iter_mut().for_each(|corner| *corner = number(*corner));
        self
    }

    /// The loops in canonical order: each starting at its lowest corner, and sorted. `beside` has a value for each
    /// loop, and is returned in the same order.
    pub(super) fn in_order<T: Copy>(mut self, beside: &[T]) -> (Self, Vec<T>) {
        for index in 0..self.len() {
            let places = self.places(index);
            let around = &mut self.corners[places];
            let lowest = (0..around.len()).min_by_key(|&place| around[place]).unwrap_or(0);
            around.rotate_left(lowest);
        }
        // By their first edges: no two loops of a surface use the same edge in the same direction.
        let mut order: Vec<[u32; 3]> = (0..)
            .zip(self.iter())
            .map(|(index, around)| {
                [around.first(), around.get(1), Some(&index)].map(|i| i.copied().unwrap_or(0))
            })
            .collect();
        if order.is_sorted() {
            return (self, beside.to_vec());
        }
        order.sort_unstable();
        let mut sorted = Self::with_room(self.corners.len().div_ceil(3));
        let order = || order.iter().map(|&[.., index]| index as usize);
        order().for_each(|index| sorted.push(self.get(index).iter().copied()));
        (sorted, order().filter_map(|index| beside.get(index).copied()).collect())
    }

    /// As [`in_order`](Self::in_order), without other values.
    pub(super) fn canonical(self) -> Self {
        self.in_order::<()>(&[]).0
    }

    /// Each loop as a fan of triangles from its first corner.
    pub(super) fn fans(&self) -> impl Iterator<Item = [u32; 3]> {
        self.iter().flat_map(|around| {
            let first = around.first().copied().unwrap_or(0);
            around.get(1..).unwrap_or_default().windows(2).map(move |two| [first, two[0], two[1]])
        })
    }
}

impl<Around: IntoIterator<Item = u32>> FromIterator<Around> for Loops {
    fn from_iter<T: IntoIterator<Item = Around>>(loops: T) -> Self {
        let mut all = Self::default();
        loops.into_iter().for_each(|around| all.push(around));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_depends_on_nothing_but_the_loops() {
        let loops: Loops = [vec![7, 3, 5, 4], vec![2, 9, 1], vec![3, 5, 1]].into_iter().collect();
        let (sorted, beside) = loops.clone().in_order(&['a', 'b', 'c']);
        assert_eq!(sorted.iter().collect::<Vec<_>>(), [[1, 2, 9].as_slice(), &[1, 3, 5], &[3, 5, 4, 7]]);
        assert_eq!(beside, ['b', 'c', 'a']);
        assert_eq!(sorted.fans().collect::<Vec<_>>(), [[1, 2, 9], [1, 3, 5], [3, 5, 4], [3, 4, 7]]);
        let turned: Loops = [vec![1, 2, 9], vec![5, 4, 7, 3], vec![5, 1, 3]].into_iter().collect();
        assert_eq!((turned.canonical(), sorted.clone().canonical()), (sorted.clone(), sorted.clone()));
        assert_eq!(sorted.renumbered(|i| i + 1).corners(), [2, 3, 10, 2, 4, 6, 4, 6, 5, 8]);
    }
}
