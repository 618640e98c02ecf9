//! Boxes with registers as wide as the processor has.
//!
//! The one place of this crate where functions are compiled for more than the target promises. They are the same
//! functions, of plain arithmetic without fused operations, so that their bits are the same. What it buys eight pairs stands in
//! `super::eight`; the patch of two faces takes a fifth fewer samples, and what is made of one a fifth to a third: a frame of boxes
//! that fall is XX times as fast (AMD EPYC, Zen 5, 2026-11-24).
#![allow(unsafe_code, reason = "the compiler cannot know what a processor was asked at run time")]

use super::contact::Touching;
use super::eight::{Asked8, Seen8};
use super::patch::{Faces, Patch, Wanted};
use crate::answer::Manifold3;
use asunder_geometry::glam::DVec3;

/// Whether there is AVX2. With the feature `portable` there never is: the twins do it all.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn has_avx2() -> bool {
    !cfg!(feature = "portable") && std::arch::is_x86_feature_detected!("avx2")
}

/// Looks at eight pairs.
#[inline]
pub(super) fn look<const GRADED: bool>(asked: &Asked8, seen: &mut Seen8) {
    #[cfg(target_arch = "x86_64")]
    if has_avx2() {
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

/// What two faces share: see [`Faces::patch`].
#[inline(always)]
pub(super) fn patch(faces: &Faces, wanted: &Wanted) -> Patch {
    #[cfg(target_arch = "x86_64")]
    if has_avx2() {
        // SAFETY: as above.
        return unsafe { patch_with_avx2(faces, wanted) };
    }
    patch_anywhere(faces, wanted)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline(never)]
fn patch_with_avx2(faces: &Faces, wanted: &Wanted) -> Patch {
    faces.patch(wanted)
}

/// The portable twin.
#[inline(never)]
fn patch_anywhere(faces: &Faces, wanted: &Wanted) -> Patch {
    faces.patch(wanted)
}

/// Contacts of a patch, along an axis that leans or along the face's own: see [`Touching::fill_along`].
#[inline(always)]
pub(super) fn fill(
    touching: &Touching,
    patch: &Patch,
    leaning: Option<DVec3>,
    manifold: &mut Manifold3,
) -> Option<()> {
    #[cfg(target_arch = "x86_64")]
    if has_avx2() {
        // SAFETY: as above.
        return unsafe { fill_with_avx2(touching, patch, leaning, manifold) };
    }
    fill_anywhere(touching, patch, leaning, manifold)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline(never)]
fn fill_with_avx2(
    touching: &Touching,
    patch: &Patch,
    leaning: Option<DVec3>,
    manifold: &mut Manifold3,
) -> Option<()> {
    touching.fill_along(patch, leaning, manifold)
}

/// The portable twin.
#[inline(never)]
fn fill_anywhere(
    touching: &Touching,
    patch: &Patch,
    leaning: Option<DVec3>,
    manifold: &mut Manifold3,
) -> Option<()> {
    touching.fill_along(patch, leaning, manifold)
}
