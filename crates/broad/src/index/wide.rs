//! The tests of a node in AVX2: one instruction where [`super::node`] has a loop over eight lanes, with the same
//! results.
//!
//! The compiler does not find them by itself: it unrolls the loops first, and then forms four lanes and four scalars.
//! All queries take 1.2 to 1.4 times as long that way (AMD EPYC Zen 4, 2026-11-21).

use super::cast::Cast;
use super::node::{Far, Node, Sides};
use crate::width::Portable;

/// The tests of the eight boxes of a node. [`Node`]'s own methods are the definition.
pub(crate) trait EightBoxes {
    /// [`Node::overlapping`].
    fn overlapping(self, node: &Node, one: &Sides) -> u32;
    /// [`Node::crossed`].
    fn crossed(self, node: &Node, cast: &Cast, limit: f32) -> Far;
    /// [`Node::near`].
    fn near(self, node: &Node, one: &Sides, limit: f32) -> Far;
}

impl EightBoxes for Portable {
    #[inline(always)]
    fn overlapping(self, node: &Node, one: &Sides) -> u32 {
        node.overlapping(one)
    }

    #[inline(always)]
    fn crossed(self, node: &Node, cast: &Cast, limit: f32) -> Far {
        node.crossed(cast, limit)
    }

    #[inline(always)]
    fn near(self, node: &Node, one: &Sides, limit: f32) -> Far {
        node.near(one, limit)
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx2 {
    use super::super::node::WIDTH;
    use super::{Cast, EightBoxes, Far, Node, Sides};
    use crate::width::Avx2;
    use core::arch::x86_64::*;

    // SAFETY of all three: this value proves that the processor has AVX2.
    impl EightBoxes for Avx2 {
        #[inline(always)]
        fn overlapping(self, node: &Node, one: &Sides) -> u32 {
            unsafe { overlapping(node, one) }
        }

        #[inline(always)]
        fn crossed(self, node: &Node, cast: &Cast, limit: f32) -> Far {
            unsafe { crossed(node, cast, limit) }
        }

        #[inline(always)]
        fn near(self, node: &Node, one: &Sides, limit: f32) -> Far {
            unsafe { near(node, one, limit) }
        }
    }

    #[target_feature(enable = "avx2")]
    #[inline]
    fn row(row: &[f32; WIDTH]) -> __m256 {
        // SAFETY: the row has eight numbers.
        unsafe { _mm256_loadu_ps(row.as_ptr()) }
    }

    #[target_feature(enable = "avx2")]
    #[inline]
    fn far(mask: i32, node: &Node, distances: __m256) -> Far {
        let mut far = Far { mask: mask as u32 & node.present(), distances: [0.0; WIDTH] };
        // SAFETY: there are eight distances.
        unsafe { _mm256_storeu_ps(far.distances.as_mut_ptr(), distances) };
        far
    }

    /// [`Node::overlapping`].
    #[target_feature(enable = "avx2")]
    #[inline]
    fn overlapping(node: &Node, one: &Sides) -> u32 {
        let meets = |axis: usize| {
            let begins = _mm256_cmp_ps::<_CMP_LE_OQ>(row(&node.sides[axis]), _mm256_set1_ps(one[axis + 3]));
            let ends = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_set1_ps(one[axis]), row(&node.sides[axis + 3]));
            _mm256_and_ps(begins, ends)
        };
        _mm256_movemask_ps(_mm256_and_ps(_mm256_and_ps(meets(0), meets(1)), meets(2))) as u32
    }

    /// [`Node::crossed`].
    #[target_feature(enable = "avx2")]
    #[inline]
    fn crossed(node: &Node, cast: &Cast, limit: f32) -> Far {
        let (mut enter, mut leave) = (_mm256_setzero_ps(), _mm256_set1_ps(limit));
        for axis in 0..3 {
            let along = |side: usize, from: f32, per: f32| {
                let gap = _mm256_sub_ps(row(&node.sides[side]), _mm256_set1_ps(from));
                _mm256_mul_ps(gap, _mm256_set1_ps(per))
            };
            // If the first operand is NaN, these return the second.
            enter = _mm256_max_ps(along(cast.near[axis], cast.from_near[axis], cast.per_near[axis]), enter);
            leave = _mm256_min_ps(along(cast.far[axis], cast.from_far[axis], cast.per_far[axis]), leave);
        }
        far(_mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave)), node, enter)
    }

    /// [`Node::near`].
    #[target_feature(enable = "avx2")]
    #[inline]
    fn near(node: &Node, one: &Sides, limit: f32) -> Far {
        let mut squares = _mm256_setzero_ps();
        for axis in 0..3 {
            let above = _mm256_sub_ps(row(&node.sides[axis]), _mm256_set1_ps(one[axis + 3]));
            let below = _mm256_sub_ps(_mm256_set1_ps(one[axis]), row(&node.sides[axis + 3]));
            let gap = _mm256_max_ps(below, _mm256_max_ps(above, _mm256_setzero_ps()));
            squares = _mm256_add_ps(squares, _mm256_mul_ps(gap, gap));
        }
        let is_normal = _mm256_cmp_ps::<_CMP_GE_OQ>(squares, _mm256_set1_ps(f32::MIN_POSITIVE));
        let squares = _mm256_min_ps(_mm256_and_ps(squares, is_normal), _mm256_set1_ps(f32::MAX));
        far(_mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(squares, _mm256_set1_ps(limit))), node, squares)
    }

    #[cfg(test)]
    mod tests {
        use super::*;
        use asunder_geometry::{Aabb3, Ray3, glam::Vec3};

        const SIDES: [f32; 12] = [
            f32::NEG_INFINITY,
            f32::MIN,
            -7.5,
            -1.0,
            -1e-40,
            -0.0,
            0.0,
            1e-30,
            1.0,
            1.000_000_1,
            f32::MAX,
            f32::INFINITY,
        ];

        /// Boxes from a simple generator, some inverted, some empty slots.
        fn nodes() -> Vec<Node> {
            let mut state = 1_u64;
            let mut next = move || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                SIDES[(state >> 33) as usize % SIDES.len()]
            };
            let node = |count: usize| {
                let mut node = Node::EMPTY;
                for slot in 0..count as u32 {
                    let sides = [next(), next(), next(), next(), next(), next()];
                    node.push(&sides, slot, false);
                }
                node
            };
            (0..=WIDTH).cycle().take(900).map(node).collect()
        }

        #[test]
        fn lanes_say_what_the_loops_say() {
            let Some(wide) = Avx2::detect() else { return };
            let same = |one: &Far, other: &Far| {
                assert_eq!(one.mask, other.mask);
                assert_eq!(one.distances.map(f32::to_bits), other.distances.map(f32::to_bits));
            };
            let directions =
                [Vec3::X, -Vec3::Y, Vec3::ZERO, Vec3::new(1.0, -1e-30, 3.0), Vec3::new(-1e-38, 0.0, 1e-40)];
            let mut met = [0; 3];
            for (index, node) in nodes().iter().enumerate() {
                let pick = |by: usize| SIDES[(index / by) % SIDES.len()];
                let sides = [
                    pick(1),
                    pick(2),
                    pick(3),
                    pick(1).max(pick(5)),
                    pick(2).max(pick(7)),
                    pick(3).max(pick(11)),
                ];
                let direction = directions[index % directions.len()];
                let bounds = Aabb3::new(Vec3::from_slice(&sides[..3]), Vec3::from_slice(&sides[3..]));
                let ray = Ray3::new([f64::from(pick(1)).clamp(-9.0, 9.0), 0.1, 0.0], Vec3::ONE - direction);
                let mut casts = vec![Cast::of_box3(&bounds, direction)];
                casts.extend(ray.map(Cast::from));
                for limit in [0.0, 1.0, f32::MAX] {
                    assert_eq!(node.overlapping(&sides), wide.overlapping(node, &sides));
                    same(&node.near(&sides, limit), &wide.near(node, &sides, limit));
                    for cast in &casts {
                        same(&node.crossed(cast, limit), &wide.crossed(node, cast, limit));
                        met[1] += node.crossed(cast, limit).mask.count_ones();
                    }
                    met[0] += node.overlapping(&sides).count_ones();
                    met[2] += node.near(&sides, limit).mask.count_ones();
                }
            }
            assert!(met.iter().all(|&met| met > 200), "{met:?}");
        }
    }
}
