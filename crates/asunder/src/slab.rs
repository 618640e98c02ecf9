//! Things that keep their place while others come and go.

/// A list with free places; places are handed out from the last that was given up.
#[derive(Clone, Debug)]
pub(crate) struct Slab<T> {
    items: Vec<T>,
    vacant: Vec<u32>,
}

/// The place of nothing.
pub(crate) const NOWHERE: u32 = u32::MAX;

impl<T> Slab<T> {
    pub(crate) const fn new() -> Self {
        Self { items: Vec::new(), vacant: Vec::new() }
    }

    /// Of things in places 0, 1, 2 and so on.
    #[cfg(feature = "serde")]
    pub(crate) const fn of(items: Vec<T>) -> Self {
        Self { items, vacant: Vec::new() }
    }

    /// What is in a place; nothing of [`NOWHERE`].
    #[inline]
    pub(crate) fn get(&self, place: u32) -> Option<&T> {
        self.items.get(place as usize)
    }

    /// Gives a place up, which may be [`NOWHERE`]. What is in it stays until the place is handed out again.
    pub(crate) fn vacate(&mut self, place: u32) {
        if place != NOWHERE {
            self.vacant.push(place);
        }
    }
}

impl<T> Slab<T> {
    /// Puts something in the place it had, or where there is one if it had none. Says where it is now, and what was there.
    pub(crate) fn put(&mut self, own: u32, item: T) -> (u32, Option<T>) {
        let place = if own == NOWHERE { self.vacant.pop().unwrap_or(NOWHERE) } else { own };
        match self.items.get_mut(place as usize) {
            Some(old) => (place, Some(core::mem::replace(old, item))),
            None => {
                self.items.push(item);
                (self.items.len() as u32 - 1, None)
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
        assert_eq!([slab.put(NOWHERE, 'a'), slab.put(NOWHERE, 'b')], [(0, None), (1, None)]);
        assert_eq!((slab.put(0, 'c'), slab.get(0), slab.get(1)), ((0, Some('a')), Some(&'c'), Some(&'b')));
        slab.vacate(0);
        slab.vacate(NOWHERE);
        assert_eq!((slab.put(NOWHERE, 'd'), slab.get(0)), ((0, Some('c')), Some(&'d')));
        assert_eq!(slab.put(NOWHERE, 'e'), (2, None));
        assert_eq!((slab.get(2), slab.get(NOWHERE)), (Some(&'e'), None));
    }
}
