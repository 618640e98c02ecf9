//! A list whose items keep their places while others come and go.

/// A list with free places; the place that was given up last is handed out first.
#[derive(Debug)]
pub(crate) struct Slab<T> {
    items: Vec<T>,
    vacant: Vec<u32>,
}

/// No place.
pub(crate) const NOWHERE: u32 = u32::MAX;

asunder_geometry::copied!(Slab<T>, for [T: Clone], { items, vacant } but {});

impl<T> Slab<T> {
    pub(crate) const fn new() -> Self {
        Self { items: Vec::new(), vacant: Vec::new() }
    }

    /// A slab with items in places 0, 1, 2 and so on.
    #[cfg(feature = "serde")]
    pub(crate) const fn of(items: Vec<T>) -> Self {
        Self { items, vacant: Vec::new() }
    }

    /// The item in a place; `None` for [`NOWHERE`].
    #[inline]
    pub(crate) fn get(&self, place: u32) -> Option<&T> {
        self.items.get(place as usize)
    }

    /// Gives up a place, which must not be [`NOWHERE`]. Its item stays until the place is handed out again.
    pub(crate) fn vacate(&mut self, place: u32) {
        self.vacant.push(place);
    }

    /// Puts an item into its own place, or any free one if it has none, and returns the place. The old item is shown
    /// first: items are large, and returning it would move it twice more.
    #[inline]
    pub(crate) fn put(&mut self, own: u32, item: T, show: impl FnOnce(&mut T)) -> u32 {
        let place = if own == NOWHERE { self.vacant.pop().unwrap_or(NOWHERE) } else { own };
        match self.items.get_mut(place as usize) {
            Some(old) => {
                show(old);
                *old = item;
                place
            }
            None => {
                self.items.push(item);
                self.items.len() as u32 - 1
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_stay_and_are_used_again() {
        let mut slab = Slab::new();
        let put = |slab: &mut Slab<char>, own: u32, item: char| {
            let mut before = None;
            let place = slab.put(own, item, |old| before = Some(*old));
            (place, before)
        };
        assert_eq!([put(&mut slab, NOWHERE, 'a'), put(&mut slab, NOWHERE, 'b')], [(0, None), (1, None)]);
        assert_eq!(
            (put(&mut slab, 0, 'c'), slab.get(0), slab.get(1)),
            ((0, Some('a')), Some(&'c'), Some(&'b'))
        );
        slab.vacate(0);
        assert_eq!((put(&mut slab, NOWHERE, 'd'), slab.get(0)), ((0, Some('c')), Some(&'d')));
        assert_eq!(put(&mut slab, NOWHERE, 'e'), (2, None));
        assert_eq!((slab.get(2), slab.get(NOWHERE)), (Some(&'e'), None));
    }
}
