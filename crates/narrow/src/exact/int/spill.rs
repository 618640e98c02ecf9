//! Limbs of a number too long to be held in place, in memory that is reused.
//!
//! A heap of crates that touch exactly asks long questions each frame: with memory of its own for each number, every
//! such question called the allocator some dozen times. Each thread keeps the memory that its numbers free.

use core::cell::RefCell;
use core::ops::{Deref, DerefMut};

/// The most rows that a thread keeps: more numbers than one question has at once.
const MOST_KEPT: usize = 64;

thread_local! {
    static KEPT: RefCell<Vec<Vec<u64>>> = const { RefCell::new(Vec::new()) };
}

/// A row of limbs.
#[derive(Debug)]
pub(super) struct Spill(Vec<u64>);

impl Spill {
    /// This many zeros.
    pub(super) fn zeros(len: usize) -> Self {
        // Fails where the thread is about to end.
        let kept = KEPT.try_with(|kept| kept.try_borrow_mut().ok()?.pop());
        let mut limbs = kept.ok().flatten().unwrap_or_default();
        limbs.clear();
        limbs.resize(len, 0);
        Self(limbs)
    }

    /// These limbs, and `more` zeros above them.
    pub(super) fn copied(limbs: &[u64], more: usize) -> Self {
        let mut copy = Self::zeros(limbs.len() + more);
        if let Some(low) = copy.0.get_mut(..limbs.len()) {
            low.copy_from_slice(limbs);
        }
        copy
    }

    pub(super) fn truncate(&mut self, len: usize) {
        self.0.truncate(len);
    }
}

impl Deref for Spill {
    type Target = [u64];

    fn deref(&self) -> &[u64] {
        &self.0
    }
}

impl DerefMut for Spill {
    fn deref_mut(&mut self) -> &mut [u64] {
        &mut self.0
    }
}

impl Clone for Spill {
    fn clone(&self) -> Self {
        Self::copied(self, 0)
    }
}

impl Drop for Spill {
    fn drop(&mut self) {
        let limbs = core::mem::take(&mut self.0);
        let _ = KEPT.try_with(|kept| {
            if let Ok(mut kept) = kept.try_borrow_mut()
                && kept.len() < MOST_KEPT
            {
                kept.push(limbs);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_used_again_and_holds_nothing_of_what_it_held() {
        let first = Spill::copied(&[7; 20], 3);
        assert_eq!((&first[..20], &first[20..]), (&[7; 20][..], &[0; 3][..]));
        let (place, clone) = (first.as_ptr(), first.clone());
        assert_ne!(clone.as_ptr(), place);
        drop(first);
        let second = Spill::zeros(23);
        assert_eq!((second.as_ptr(), &*second, &clone[..20]), (place, &[0; 23][..], &[7; 20][..]));
    }
}
