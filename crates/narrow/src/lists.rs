//! Lists that a thread keeps from one question to the next, so that asking every frame allocates nothing.

use crate::answer::{Manifold2, Manifold3};
use crate::feature::Hint;
use crate::pair2::Pair2;
use crate::pair3::Pair3;
use core::cell::Cell;
use std::thread::LocalKey;

thread_local! {
    /// Lists of manifolds in the plane.
    pub(crate) static MANIFOLDS2: Cell<Vec<Vec<Manifold2>>> = const { Cell::new(Vec::new()) };
    /// The same in space.
    static MANIFOLDS3: Cell<Vec<Vec<Manifold3>>> = const { Cell::new(Vec::new()) };
}

/// A thread's lists that are not in use.
pub(crate) type Lists<T> = LocalKey<Cell<Vec<Vec<T>>>>;

/// Lends an empty list to `run`, and takes it back. A question within a question gets another list.
pub(crate) fn with_list<T, R>(lists: &'static Lists<T>, run: impl FnOnce(&mut Vec<T>) -> R) -> R {
    let mut list = take_list(lists);
    let answer = run(&mut list);
    give_back(lists, list);
    answer
}

/// An empty list, for a caller who gives it back.
pub(crate) fn take_list<T>(lists: &'static Lists<T>) -> Vec<T> {
    // A thread that is ending has no place for lists any more.
    let mut all = lists.try_with(Cell::take).unwrap_or_default();
    let mut list = all.pop().unwrap_or_default();
    let _ = lists.try_with(|place| place.set(all));
    list.clear();
    list
}

/// Keeps a list for the next question.
pub(crate) fn give_back<T>(lists: &'static Lists<T>, list: Vec<T>) {
    let mut all = lists.try_with(Cell::take).unwrap_or_default();
    all.push(list);
    let _ = lists.try_with(|place| place.set(all));
}

/// Lends the manifolds of a pair in the plane within a margin.
pub(crate) fn with_manifolds2<R>(pair: &Pair2, margin: f32, run: impl FnOnce(&[Manifold2]) -> R) -> R {
    with_list(&MANIFOLDS2, |manifolds| {
        pair.add_manifolds(margin, manifolds);
        run(manifolds)
    })
}

/// The same in space.
pub(crate) fn with_manifolds3<R>(pair: &Pair3, margin: f32, run: impl FnOnce(&[Manifold3]) -> R) -> R {
    with_list(&MANIFOLDS3, |manifolds| {
        let _ = pair.contact(margin, Hint::NONE, Some(manifolds));
        run(manifolds)
    })
}
