//! Eight pairs with registers as wide as the processor has.
//!
//! The one place of this crate where a function is compiled for more than the target promises. It is the same
//! function, of plain arithmetic without fused operations, so that its bits are the same; what it buys is in
//! `super::eight`.
#![allow(unsafe_code, reason = "the compiler cannot know what a processor was asked at run time")]

use super::eight::{Asked8, Seen8};

/// Looks at eight pairs. With the feature `portable`, by the twin, whatever the processor has.
#[inline]
pub(super) fn look<const GRADED: bool>(asked: &Asked8, seen: &mut Seen8) {
    #[cfg(target_arch = "x86_64")]
    if !cfg!(feature = "portable") && std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has been asked, and has AVX2. There is no other condition.
        return unsafe { look_with_avx2::<GRADED>(asked, seen) };
    }
    look_anywhere::<GRADED>(asked, seen);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn look_with_avx2<const GRADED: bool>(asked: &Asked8, seen: &mut Seen8) {
    asked.look::<GRADED>(seen);
}

/// The portable twin.
#[inline(never)]
pub(super) fn look_anywhere<const GRADED: bool>(asked: &Asked8, seen: &mut Seen8) {
    asked.look::<GRADED>(seen);
}
