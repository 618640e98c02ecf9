//! Vertices eight by eight, in f32 lanes.
//!
//! Lanes are computed where they are used, in explicit vectors: where the greatest of eight is wanted next, LLVM made
//! plain loops into vectors of two, four for each eight vertices in place of two.

use crate::counted::count_step;
use asunder_geometry::VertexOctet;
use asunder_geometry::glam::{DVec3, Vec3};
use wide::f32x8;

/// Octets whose lanes have a bit each in a 32-bit word. Up to this many, projections are kept and not computed twice.
pub(super) const IN_A_WORD: usize = 4;

/// A direction of any length in f32, broadcast to all lanes.
#[derive(Clone, Copy)]
pub(super) struct Along {
    lanes: [f32x8; 3],
    direction: Vec3,
}

impl Along {
    #[inline(always)]
    pub(super) fn new(direction: DVec3) -> Self {
        let direction = direction.as_vec3();
        Self { lanes: direction.to_array().map(f32x8::splat), direction }
    }

    /// A bound on the error of two vertices' lanes together, where no coordinate is greater than `extent`.
    #[inline(always)]
    pub(super) fn doubt(&self, extent: f32) -> f32 {
        // Conversion, product and two sums: below 4.1 units of 2^-24 of the terms' sum, on both sides; and one each
        // where the doubt, and perhaps a slack, is subtracted.
        10.5 * (f32::EPSILON / 2.0) * extent * self.direction.abs().element_sum()
    }

    /// Eight dot products.
    #[inline(always)]
    pub(super) fn dot(&self, [x, y, z]: [&[f32; 8]; 3]) -> f32x8 {
        let [along_x, along_y, along_z] = self.lanes;
        along_x * f32x8::new(*x) + along_y * f32x8::new(*y) + along_z * f32x8::new(*z)
    }

    /// Projections of eight vertices.
    #[inline(always)]
    fn project(&self, octet: &VertexOctet) -> f32x8 {
        count_step();
        self.dot([&octet.x, &octet.y, &octet.z])
    }

    /// The greatest projection.
    #[inline(always)]
    pub(super) fn highest(&self, octets: &[VertexOctet]) -> f32 {
        let mut top = f32x8::splat(f32::NEG_INFINITY);
        for octet in octets {
            top = self.project(octet).fast_max(top);
        }
        greatest(top)
    }

    /// The greatest projection and its vertex, which may be padding behind the last; on ties, the lowest lane.
    #[inline(always)]
    pub(super) fn furthest(&self, octets: &[VertexOctet]) -> (f32, usize) {
        if let [octet] = octets {
            let reach = self.project(octet);
            let best = greatest(reach);
            return (best, lanes_from(reach, best).trailing_zeros() as usize);
        }
        let best = self.highest(octets);
        let (mut lane, mut place) = (8, 0);
        for (octet, first) in octets.iter().zip((0..).step_by(8)) {
            // Already counted once, in `highest`.
            let reach = self.dot([&octet.x, &octet.y, &octet.z]);
            let lowest = lanes_from(reach, best).trailing_zeros() as usize;
            let is_lower = lowest < lane;
            lane = if is_lower { lowest } else { lane };
            place = if is_lower { first } else { place };
        }
        (best, place + lane)
    }

    /// The only vertex whose projection is the greatest up to both projections' errors; `None` where there are several,
    /// or more than 32 vertices in all.
    #[inline(always)]
    pub(super) fn only(&self, octets: &[VertexOctet], extent: f32) -> Option<usize> {
        if octets.len() > IN_A_WORD {
            return None;
        }
        let mut kept = [f32x8::splat(f32::NEG_INFINITY); IN_A_WORD];
        let mut top = kept[0];
        for (reach, octet) in kept.iter_mut().zip(octets) {
            *reach = self.project(octet);
            top = reach.fast_max(top);
        }
        let least = greatest(top) - self.doubt(extent);
        let mut near = 0_u32;
        for (place, &reach) in kept.iter().take(octets.len()).enumerate() {
            near |= lanes_from(reach, least) << (8 * place);
        }
        near.is_power_of_two().then(|| near.trailing_zeros() as usize)
    }

    /// [`Along::only`] of eight.
    #[inline(always)]
    pub(super) fn only_of(&self, octet: &VertexOctet, extent: f32) -> Option<usize> {
        let reach = self.project(octet);
        let near = lanes_from(reach, greatest(reach) - self.doubt(extent));
        near.is_power_of_two().then(|| near.trailing_zeros() as usize)
    }

    /// A mask of which of up to 32 vertices come to `least`: a bit each, the first the lowest.
    #[inline(always)]
    pub(super) fn those_from(&self, octets: &[VertexOctet], least: f32) -> u32 {
        debug_assert!(octets.len() <= IN_A_WORD, "each lane has a bit");
        let mut near = 0;
        for (place, octet) in octets.iter().take(IN_A_WORD).enumerate() {
            near |= lanes_from(self.project(octet), least) << (8 * place);
        }
        near
    }
}

/// An upper bound on how far vertices reach along a direction of any length, all in their own axes: as
/// [`Solid::rough_support`](super::solid::Solid::rough_support), without the vertex. No coordinate is greater than
/// `extent`.
#[inline]
pub(super) fn bound_of_reach(octets: &[VertexOctet], extent: f32, direction: DVec3) -> f64 {
    let along = Along::new(direction);
    f64::from(along.highest(octets) + along.doubt(extent))
}

#[inline(always)]
fn greatest(lanes: f32x8) -> f32 {
    let lanes = lanes.to_array();
    let greater = |a: f32, b: f32| if a > b { a } else { b };
    let four: [f32; 4] = core::array::from_fn(|i| greater(lanes[i], lanes[i + 4]));
    greater(greater(four[0], four[2]), greater(four[1], four[3]))
}

/// A mask of which of eight lanes come to `least`: a bit each, the first the lowest.
///
/// Processors have an instruction for this that plain loops do not compile to: those make eight shifts, or transpose
/// four octets first. [`Solid::support`](super::solid::Solid::support) takes two thirds of the time with it, a frame of
/// falling hulls 0.91.
#[inline(always)]
pub(super) fn lanes_from(lanes: f32x8, least: f32) -> u32 {
    lanes.simd_ge(f32x8::splat(least)).to_bitmask()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_lane_has_its_bit() {
        for bits in 0..256 {
            let lanes =
                core::array::from_fn(|i| if bits >> i & 1 == 1 { 2.0 } else { [1.0, f32::NAN][i % 2] });
            assert_eq!(lanes_from(f32x8::new(lanes), 2.0), bits);
        }
    }

    #[test]
    fn the_furthest_is_that_of_the_lowest_lane() {
        let mut state = 7_u32;
        // Coarse, so that many vertices are equally far.
        let mut number = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 29) as f32 - 3.5
        };
        let (mut places, mut ties) = ([0; 32], 0);
        for case in 0..4000 {
            let mut eight = || core::array::from_fn(|_| number());
            let octets: Vec<_> =
                (0..=case % 32).map(|_| VertexOctet { x: eight(), y: eight(), z: eight() }).collect();
            let direction = DVec3::new(number().into(), number().into(), number().into());
            let along = Along::new(direction);
            let reaches: Vec<f32> = octets.iter().flat_map(|octet| along.project(octet).to_array()).collect();
            let greatest = reaches.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let mut furthest_ones = (0..reaches.len()).filter(|&vertex| reaches[vertex] == greatest);
            ties += usize::from(furthest_ones.clone().count() > 1);
            let lowest = furthest_ones.by_ref().min_by_key(|vertex| (vertex % 8, *vertex)).unwrap();
            assert_eq!(along.furthest(&octets), (greatest, lowest));
            places[lowest / 8] += 1;
        }
        assert!(ties > 500 && places[..16].iter().all(|&count| count > 10), "{ties}, {places:?}");
    }
}
