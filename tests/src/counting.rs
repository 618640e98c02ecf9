//! An allocator that counts the calls made by chosen threads. A program that counts makes it its global allocator:
//!
//! ```standalone_crate
//! use asunder_tests::counting::{Counting, allocations, counted};
//! #[global_allocator]
//! static COUNTING: Counting = Counting;
//! let made = counted(1, || {
//!     let before = allocations();
//!     drop(vec![1_u8; 100]);
//!     allocations() - before
//! });
//! assert_eq!(made, 1);
//! ```

#![allow(unsafe_code, reason = "`GlobalAlloc` is an unsafe trait; all that is not counting is the system's")]

use rayon::ThreadPoolBuilder;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering::Relaxed};
use std::sync::{Barrier, PoisonError, RwLock};

/// The system's allocator, with counters.
pub struct Counting;

/// What some threads allocated.
struct Tally {
    calls: AtomicU64,
    live: AtomicI64,
}

thread_local! {
    // Without a destructor, so that it exists as long as its thread does, and makes no allocation itself.
    static TALLY: Cell<Option<&'static Tally>> = const { Cell::new(None) };
}

/// Allocating calls so far by the threads that are counted with this one; 0 where it is not counted.
pub fn allocations() -> u64 {
    TALLY.get().map_or(0, |tally| tally.calls.load(Relaxed))
}

/// Bytes allocated and not freed by the threads that are counted with this one; 0 where it is not counted.
pub fn live_bytes() -> i64 {
    TALLY.get().map_or(0, |tally| tally.live.load(Relaxed))
}

/// Threads that are counted singly may run at the same time. What several threads allocate depends on which of them
/// takes which work, and varies more the busier the processors are: so they run with no other.
static ALONE: RwLock<()> = RwLock::new(());

/// A few bytes leaked per counted run: a thread of a pool may outlive it.
fn new_tally() -> &'static Tally {
    Box::leak(Box::new(Tally { calls: AtomicU64::new(0), live: AtomicI64::new(0) }))
}

/// Runs the work on this thread, which is in no pool; no other thread counts.
pub fn counted_here<T>(work: impl FnOnce() -> T) -> T {
    let _alone = ALONE.write().unwrap_or_else(PoisonError::into_inner);
    TALLY.set(Some(new_tally()));
    let done = work();
    TALLY.set(None);
    done
}

/// Runs the work in a pool of this many threads, which alone are counted.
pub fn counted<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let (_beside, _alone) = if threads == 1 {
        (Some(ALONE.read().unwrap_or_else(PoisonError::into_inner)), None)
    } else {
        (None, Some(ALONE.write().unwrap_or_else(PoisonError::into_inner)))
    };
    let tally = new_tally();
    let pool = ThreadPoolBuilder::new().num_threads(threads);
    let pool = pool.start_handler(move |_| TALLY.set(Some(tally))).build().unwrap();
    // The first time that a thread steals work it registers itself, with 2304 bytes: at any time, unless it is made to
    // now.
    let all = Barrier::new(threads);
    pool.scope(|scope| (0..threads).for_each(|_| scope.spawn(|_| _ = all.wait())));
    let done = pool.install(work);
    // Threads end after their pool does, and what they free then is not counted.
    pool.broadcast(|_| TALLY.set(None));
    done
}

fn count(calls: u64, bytes: i64) {
    if let Some(tally) = TALLY.get() {
        tally.calls.fetch_add(calls, Relaxed);
        tally.live.fetch_add(bytes, Relaxed);
    }
}

// SAFETY: every call is passed on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(1, layout.size() as i64);
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(1, layout.size() as i64);
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        count(0, -(layout.size() as i64));
        // SAFETY: the caller's promises are passed on.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(1, size as i64 - layout.size() as i64);
        // SAFETY: the caller's promises are passed on.
        unsafe { System.realloc(memory, layout, size) }
    }
}
