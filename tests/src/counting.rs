//! An allocator that counts what the threads of one pool ask of it. A program that counts makes it its own:
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
use std::sync::{Barrier, Mutex, PoisonError};

/// The system's allocator, and two sums.
pub struct Counting;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);
static LIVE: AtomicI64 = AtomicI64::new(0);

thread_local! {
    // Without a destructor, so that it is there for as long as its thread, and costs no allocation itself.
    static IS_COUNTED: Cell<bool> = const { Cell::new(false) };
}

/// Calls that asked for memory so far, by counted threads.
pub fn allocations() -> u64 {
    ALLOCATIONS.load(Relaxed)
}

/// Bytes that counted threads asked for and have not given back.
pub fn live_bytes() -> i64 {
    LIVE.load(Relaxed)
}

static ALONE: Mutex<()> = Mutex::new(());

/// Runs the work on this thread, which is in no pool; no other counts.
pub fn counted_here<T>(work: impl FnOnce() -> T) -> T {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    IS_COUNTED.set(true);
    let done = work();
    IS_COUNTED.set(false);
    done
}

/// Runs the work in a pool of so many threads, which are the only ones that count while it runs.
pub fn counted<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let pool = ThreadPoolBuilder::new().num_threads(threads);
    let pool = pool.start_handler(|_| IS_COUNTED.set(true)).build().unwrap();
    // The first time that a thread takes work from another it registers itself, with 2304 bytes: some time, unless now.
    let all = Barrier::new(threads);
    pool.scope(|scope| (0..threads).for_each(|_| scope.spawn(|_| _ = all.wait())));
    let done = pool.install(work);
    // Threads end after their pool does, and what they give back then is nobody's.
    pool.broadcast(|_| IS_COUNTED.set(false));
    done
}

fn count(calls: u64, bytes: i64) {
    if IS_COUNTED.get() {
        ALLOCATIONS.fetch_add(calls, Relaxed);
        LIVE.fetch_add(bytes, Relaxed);
    }
}

// SAFETY: every call goes on to the system's allocator as it came.
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
