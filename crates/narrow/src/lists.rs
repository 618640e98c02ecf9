//! Memory for lists that a thread keeps from one question to the next: who asks every frame allocates nothing.

use crate::answer::{Manifold2, Manifold3};
use core::cell::Cell;
use std::thread::LocalKey;

thread_local! {
    /// Lists of manifolds in the plane.
    pub(crate) static MANIFOLDS2: Cell<Vec<Vec<Manifold2>>> = const { Cell::new(Vec::new()) };
    /// The same in space.
    pub(crate) static MANIFOLDS3: Cell<Vec<Vec<Manifold3>>> = const { Cell::new(Vec::new()) };
}

/// Hands out an empty list, and takes it back. A question within a question gets another one.
pub(crate) fn with_list<T, R>(
    lists: &'static LocalKey<Cell<Vec<Vec<T>>>>,
    ask: impl FnOnce(&mut Vec<T>) -> R,
) -> R {
    // A thread that is about to end has no place for them any more.
    let mut all = lists.try_with(Cell::take).unwrap_or_default();
    let mut list = all.pop().unwrap_or_default();
    let _ = lists.try_with(|place| place.set(all));
    list.clear();
    let answer = ask(&mut list);
    let mut all = lists.try_with(Cell::take).unwrap_or_default();
    all.push(list);
    let _ = lists.try_with(|place| place.set(all));
    answer
}
