//! Box kernels compiled for registers as wide as the processor has.
//!
//! The only place in this crate where functions are compiled for more than the target guarantees. They are the same
//! functions, of plain arithmetic without fused operations, so that their results are the same bit by bit. The gains
//! for eight pairs are listed in `super::eight`. The patch of two faces, and the contact points made from it, make a
//! frame of boxes that fall 1.04 times as fast (AMD EPYC, Zen 5, 2026-11-24).
#![allow(unsafe_code, reason = "the compiler cannot know what a processor was asked at run time")]

use super::contact::Touching;
use super::eight::{Input8, Results8};
use super::patch::{Faces, Patch, Wanted};
use crate::answer::Manifold3;
use asunder_geometry::glam::DVec3;

/// Work that is worth compiling more than once.
trait Kernel {
    type Output;
    /// Does the work. Must always be inlined, or it is compiled only once.
    fn run(self) -> Self::Output;
}

/// Runs a kernel with the widest registers the processor has; with the feature `portable`, by the portable twin.
#[inline(always)]
fn widest<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if !cfg!(feature = "portable") && std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has been asked, and has AVX2. There is no other condition.
        return unsafe { with_avx2(kernel) };
    }
    anywhere(kernel)
}

/// The same for a kernel whose rows fill the widest registers that exist: other kernels gain nothing from those, and
/// contact points lose 3 %.
#[inline(always)]
fn widest_of_rows<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if !cfg!(feature = "portable") && std::arch::is_x86_feature_detected!("avx512f") {
        // SAFETY: the processor has been asked, and has AVX-512. There is no other condition.
        return unsafe { with_avx512(kernel) };
    }
    widest(kernel)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline(never)]
fn with_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
#[inline(never)]
fn with_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

/// The portable twin.
#[inline(never)]
fn anywhere<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

struct Look<'a, const GRADED: bool>(&'a Input8, &'a mut Results8);

impl<const GRADED: bool> Kernel for Look<'_, GRADED> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.0.look::<GRADED>(self.1);
    }
}

/// Looks at eight pairs.
#[inline]
pub(super) fn look<const GRADED: bool>(input: &Input8, results: &mut Results8) {
    widest_of_rows(Look::<GRADED>(input, results));
}

/// [`look`] with registers that the processor may have wider, and by the portable twin.
#[cfg(test)]
pub(super) fn look_narrower<const GRADED: bool>(input: &Input8, results: [&mut Results8; 2]) {
    let [one, other] = results;
    widest(Look::<GRADED>(input, one));
    anywhere(Look::<GRADED>(input, other));
}

struct Cut<'a>(&'a Faces, &'a Wanted);

impl Kernel for Cut<'_> {
    type Output = Patch;

    #[inline(always)]
    fn run(self) -> Patch {
        self.0.patch(self.1)
    }
}

/// The common patch of two faces: see [`Faces::patch`].
#[inline(always)]
pub(super) fn patch(faces: &Faces, wanted: &Wanted) -> Patch {
    widest(Cut(faces, wanted))
}

struct Fill<'a, 't>(&'a Touching<'t>, &'a Patch, Option<DVec3>, &'a mut Manifold3);

impl Kernel for Fill<'_, '_> {
    type Output = Option<()>;

    #[inline(always)]
    fn run(self) -> Option<()> {
        self.0.fill_along(self.1, self.2, self.3)
    }
}

/// Contact points of a patch, along a leaning axis or the face's normal: see [`Touching::fill_along`].
#[inline(always)]
pub(super) fn fill(
    touching: &Touching,
    patch: &Patch,
    leaning: Option<DVec3>,
    manifold: &mut Manifold3,
) -> Option<()> {
    widest(Fill(touching, patch, leaning, manifold))
}

#[cfg(test)]
mod tests {
    use super::super::placed::Posed;
    use super::super::settled::Settled;
    use super::*;
    use asunder_geometry::glam::{DVec3, Quat, Vec3};
    use asunder_geometry::{Cuboid, Pose3};

    fn bits(patch: &Patch) -> Vec<u64> {
        let numbers = [patch.u, patch.v, patch.height].concat();
        let names = (0..12).map(|slot| patch.names(slot).0.into());
        let rest = [patch.held.into(), patch.is_clear.into()];
        numbers.into_iter().map(f64::to_bits).chain(names).chain(rest).collect()
    }

    #[test]
    fn patches_and_their_contacts_are_bit_for_bit_the_same_however_wide_the_registers() {
        let mut random = oorandom::Rand32::new(7);
        let mut number = |span: f32| (2.0 * random.rand_float() - 1.0) * span;
        let (mut patches, mut filled) = (0, 0);
        for _ in 0..3000 {
            let mut half = || Vec3::new(number(1.0).exp2(), number(1.0).exp2(), number(1.0).exp2());
            let cuboids = [half(), half()].map(|half| Cuboid::from_half_extents(half).unwrap());
            // Some of them all but level.
            let lean = [1.0, 1e-4][usize::from(number(1.0) > 0.0)];
            let turn = Quat::from_xyzw(number(lean), number(lean), number(1.0), 1.0);
            let at = DVec3::new(number(1.0).into(), number(1.0).into(), 1.0 + f64::from(number(1.0)));
            let poses = [Pose3::IDENTITY, Pose3::new(at, turn).unwrap()];
            let posed = Posed { cuboids: [&cuboids[0], &cuboids[1]], poses: [&poses[0], &poses[1]] };
            let (placed, margin) = (posed.placed(), 0.1);
            let (Settled::Overlapping(best) | Settled::Parted(best)) = placed.settle(margin) else {
                continue;
            };
            let touching = Touching { posed: &posed, placed: &placed, best: &best, margin, last: None };
            for (is_b, face) in
                [false, true].into_iter().flat_map(|is_b| (0..6).map(move |face| (is_b, face)))
            {
                let slack = placed.preference;
                let Some((reference, faces)) = placed.faces(is_b, face, slack) else { continue };
                let wanted = Wanted { reference, within: margin, slack, near: placed.near };
                let found = patch(&faces, &wanted);
                assert_eq!(bits(&found), bits(&anywhere(Cut(&faces, &wanted))));
                patches += 1;
                for leaning in [None, Some(DVec3::new(0.6, 0.0, 0.8))] {
                    let mut manifolds = [Manifold3::BLANK; 2];
                    let is_filled = fill(&touching, &found, leaning, &mut manifolds[0]).is_some();
                    let is_too = anywhere(Fill(&touching, &found, leaning, &mut manifolds[1])).is_some();
                    // Debug output of a float is different where its bits are.
                    let [one, other] = manifolds.map(|manifold| format!("{manifold:?}"));
                    assert_eq!((is_filled, one), (is_too, other));
                    filled += usize::from(is_filled);
                }
            }
        }
        assert!(patches > 10_000 && filled > 1000, "{patches} patches, {filled} filled");
    }
}
