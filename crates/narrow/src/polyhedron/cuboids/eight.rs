//! Eight pairs of cuboids side by side: B's placement relative to A, and the fifteen axes.
//!
//! ```text
//! gather eight pairs, number by number
//! for each lane:   rotations, offset, fifteen axes     (the very functions that a single pair uses)
//!                  the axis that separates the pair, or how far it overlaps on all axes
//! separated pairs are done; the others go on like a single pair, from the values that are here already
//! ```
//! A loop over the lanes, from memory to memory, is what LLVM turns into vector instructions of any width. Since each
//! lane runs the code of a single pair, its results equal a single pair's bit by bit.
//!
//! Gains on pairs that a broad phase hands over, in ns per pair (AMD EPYC, Zen 4, 2026-11-21):
//!
//! | | yes or no | separation | contact points |
//! |---|---|---|---|
//! | one by one | 50 | 81 | 178 |
//! | 1. eight side by side, 128-bit registers | 38 | | 165 to 185 |
//! | 2. the same with AVX2 | 27 | 73 | 152 |
//! | 3. axes graded side by side (`super::graded`) | 39 | 57 | 160 |
//!
//! Used are 1 and 2; 3 where only a separation is asked for; and AVX-512 where available, whose registers hold all
//! eight. On AMD EPYC, Zen 4, which takes two steps for each of those, AVX-512 gains nothing on yes or no and 5 to 13 %
//! on separations. On Zen 5, which takes one, yes or no takes 0.88 of the time of AVX2, separations 0.89, contact
//! points 0.99 (2026-11-25).
//!
//! Tried, and left out: 3 for contact points with AVX-512 (a frame of boxes that fall 1.02 times as long); inscribed
//! spheres before the lanes (no gain on such pairs; a pair by itself gains 10 %). Last frame's axis is not tried first
//! here: all fifteen cost 12 ns.

use super::super::sat::AxisOf;
use super::fifteen::{Fifteen, closed_form};
use super::graded::Graded;
use super::placed::{Placed, Posed, Size};
use super::queries::measured;
use super::settled::{Best, parted_by};
use super::wide;
use crate::answer::Separation3;
use crate::lanes::Lanes;
use crate::precision::{Precision, at_least};
use asunder_geometry::Basis3;
use asunder_geometry::glam::DVec3;

/// How many pairs there are.
pub(crate) const LANES: usize = 8;

type Row<T = f64> = [T; LANES];

/// The input for eight pairs.
#[derive(Clone)]
pub(super) struct Input8 {
    rotations: [[Row<f32>; 4]; 2],
    halves: [[Row<f32>; 3]; 2],
    between: [Row; 3],
    /// Both cores' sizes and both radii, in metres.
    sizes: Row,
    /// Only gaps up to this need be known exactly, in metres.
    limits: Row,
}

/// The input and the results of eight pairs.
#[derive(Clone)]
pub(crate) struct Eight {
    input: Input8,
    results: Results8,
}

#[derive(Clone)]
pub(super) struct Results8 {
    basis: [Row; 9],
    relative: [Row; 9],
    offset: [Row; 3],
    faces_a: [Row; 3],
    faces_b: [Row; 3],
    ahead: [Row; 3],
    edges: [Row; 9],
    squared: [Row; 9],
    parted: Row,
    /// Below zero where the cores overlap for certain.
    deep: Row,
    /// The fields of [`Graded`], in its order.
    graded: [Row; 6],
}

impl Eight {
    /// To be filled in.
    pub(crate) const BLANK: Self = Self {
        input: Input8 {
            rotations: [[[0.0; LANES]; 4]; 2],
            halves: [[[0.0; LANES]; 3]; 2],
            between: [[0.0; LANES]; 3],
            sizes: [0.0; LANES],
            limits: [0.0; LANES],
        },
        results: Results8 {
            basis: [[0.0; LANES]; 9],
            relative: [[0.0; LANES]; 9],
            offset: [[0.0; LANES]; 3],
            faces_a: [[0.0; LANES]; 3],
            faces_b: [[0.0; LANES]; 3],
            ahead: [[0.0; LANES]; 3],
            edges: [[0.0; LANES]; 9],
            squared: [[0.0; LANES]; 9],
            parted: [0.0; LANES],
            deep: [0.0; LANES],
            graded: [[0.0; LANES]; 6],
        },
    };

    /// Puts a pair into a lane.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, posed: &Posed, margin: f64) {
        let k = lane % LANES;
        let input = &mut self.input;
        for side in 0..2 {
            let rotation = posed.poses[side].rotation().to_array();
            let half = posed.cuboids[side].half_extents().to_array();
            write(&mut input.rotations[side], rotation, k);
            write(&mut input.halves[side], half, k);
        }
        write(&mut input.between, posed.between().to_array(), k);
        let size = Size::of(posed);
        input.sizes[k] = size.cores + size.radii;
        input.limits[k] = margin + size.radii;
    }

    /// Computes all lanes, and grades the axes if `GRADED`. Grading takes half as long again, and pays where only a
    /// number is asked for. Lanes that hold no pair have no meaning.
    #[inline]
    pub(crate) fn look<const GRADED: bool>(&mut self) {
        wide::look::<GRADED>(&self.input, &mut self.results);
    }

    /// The axis that separates a pair for certain: as [`Placed::parted`].
    #[inline(always)]
    pub(crate) fn parted(&self, lane: usize) -> Option<AxisOf> {
        let (k, results) = (lane % LANES, &self.results);
        parted_by(
            results.parted[k],
            |axis| results.offset[axis][k] >= 0.0,
            |axis| results.ahead[axis][k] >= 0.0,
        )
    }

    /// A lower bound on the separation from the best face, where a face separates the pair: as in [`Placed::settle`].
    #[inline(always)]
    pub(super) fn parted_by_face(&self, lane: usize, posed: &Posed) -> Option<f32> {
        let (k, results) = (lane % LANES, &self.results);
        let separation = match results.parted[k] as i32 {
            n @ 0..3 => results.faces_a[n as usize][k],
            n @ 3..6 => results.faces_b[n as usize - 3][k],
            _ => return None,
        };
        let (radii, precision) = self.precision(k, posed);
        Some(at_least(separation - radii, &precision))
    }

    /// The separation of a pair whose best axes are known.
    #[inline(always)]
    pub(super) fn measured(&self, lane: usize, posed: &Posed, best: &Best) -> Separation3 {
        let (k, results) = (lane % LANES, &self.results);
        let [x, y, z] = &results.offset;
        let relative = |c: usize| results.relative[c % 9][k];
        let axis_b = |j: usize| DVec3::new(relative(3 * j), relative(3 * j + 1), relative(3 * j + 2));
        let ahead = |j: usize| results.ahead[j % 3][k];
        let normal = best.normal(&basis(&results.basis, k), axis_b, DVec3::new(x[k], y[k], z[k]), ahead);
        let (radii, precision) = self.precision(k, posed);
        measured(best, normal, radii, &precision)
    }

    /// Both radii and the precision.
    #[inline(always)]
    fn precision(&self, k: usize, posed: &Posed) -> (f64, Precision) {
        let Size { cores, radii, .. } = Size::of(posed);
        let [x, y, z] = &self.results.offset;
        (radii, Size::precision(cores, cores + radii, DVec3::new(x[k], y[k], z[k])))
    }

    /// Whether a pair's cores overlap for certain.
    #[inline(always)]
    pub(crate) fn is_deep(&self, lane: usize) -> bool {
        self.results.deep[lane % LANES] < 0.0
    }

    /// The best axes of a pair that no axis separates, if they were graded and that settled them.
    #[inline(always)]
    pub(super) fn best(&self, lane: usize) -> Option<Best> {
        let (k, results) = (lane % LANES, &self.results);
        let [is_settled, face_a, face_b, pair, edges, short] = results.graded.map(|row| row[k]);
        let faces = [results.faces_a[face_a as usize % 3][k], results.faces_b[face_b as usize % 3][k]];
        Graded { is_settled, face_a, face_b, pair, edges, short }.best(faces)
    }

    /// A pair, as [`Posed::placed`] would return it.
    #[inline(always)]
    pub(super) fn placed(&self, lane: usize, posed: &Posed) -> Placed {
        let k = lane % LANES;
        let results = &self.results;
        let vector = |rows: &[Row; 3]| DVec3::new(rows[0][k], rows[1][k], rows[2][k]);
        let row = |rows: &[Row]| Lanes([rows[0][k], rows[1][k], rows[2][k], 0.0]);
        let rows = |rows: &[Row; 9]| [row(&rows[..3]), row(&rows[3..6]), row(&rows[6..])];
        let fifteen = Fifteen {
            faces_a: [results.faces_a[0][k], results.faces_a[1][k], results.faces_a[2][k]],
            faces_b: row(&results.faces_b),
            ahead: row(&results.ahead),
            edges: rows(&results.edges),
            squared: rows(&results.squared),
        };
        let place = (basis(&results.relative, k), vector(&results.offset));
        Placed::new(posed, basis(&results.basis, k), place, fifteen)
    }
}

impl Input8 {
    #[inline(always)]
    pub(super) fn look<const GRADED: bool>(&self, results: &mut Results8) {
        for k in 0..LANES {
            let rotation = |side: usize| {
                let [x, y, z, w] = &self.rotations[side];
                [x[k].into(), y[k].into(), z[k].into(), w[k].into()]
            };
            let half = |side: usize| {
                let [x, y, z] = &self.halves[side];
                DVec3::new(x[k].into(), y[k].into(), z[k].into())
            };
            let [x, y, z] = &self.between;
            let basis = Basis3::of_quaternion(rotation(0));
            let relative = Basis3::between(rotation(0), rotation(1));
            let offset = basis.turn_back(DVec3::new(x[k], y[k], z[k]));
            let fifteen = Fifteen::new(&[half(0), half(1)], &relative, offset);
            let precision = Size::precision(0.0, self.sizes[k], offset);
            results.parted[k] = fifteen.parted(self.limits[k], &precision);
            results.deep[k] = fifteen.top() + closed_form(&precision);
            if GRADED {
                let Graded { is_settled, face_a, face_b, pair, edges, short } = fifteen.graded(&precision);
                write(&mut results.graded, [is_settled, face_a, face_b, pair, edges, short], k);
            }
            write_basis(&mut results.basis, &basis, k);
            write_basis(&mut results.relative, &relative, k);
            for c in 0..3 {
                results.offset[c][k] = offset[c];
                results.faces_a[c][k] = fifteen.faces_a[c];
                results.faces_b[c][k] = fifteen.faces_b.0[c];
                results.ahead[c][k] = fifteen.ahead.0[c];
                for j in 0..3 {
                    results.edges[3 * c + j][k] = fifteen.edges[c].0[j];
                    results.squared[3 * c + j][k] = fifteen.squared[c].0[j];
                }
            }
        }
    }
}

#[inline(always)]
fn basis(rows: &[Row; 9], k: usize) -> Basis3 {
    Basis3 {
        x: DVec3::new(rows[0][k], rows[1][k], rows[2][k]),
        y: DVec3::new(rows[3][k], rows[4][k], rows[5][k]),
        z: DVec3::new(rows[6][k], rows[7][k], rows[8][k]),
    }
}

#[inline(always)]
fn write<T, const N: usize>(rows: &mut [Row<T>; N], values: [T; N], k: usize) {
    for (row, value) in rows.iter_mut().zip(values) {
        row[k] = value;
    }
}

#[inline(always)]
fn write_basis(rows: &mut [Row; 9], Basis3 { x, y, z }: &Basis3, k: usize) {
    write(rows, [x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z], k);
}

#[cfg(test)]
mod tests {
    use super::super::settled::Settled;
    use super::*;
    use asunder_geometry::glam::{Quat, Vec3};
    use asunder_geometry::{Cuboid, Pose3};

    /// Cuboids of all sizes near each other, some of them with the same rotation.
    fn pairs() -> Vec<([Cuboid; 2], [Pose3; 2])> {
        let mut random = oorandom::Rand32::new(42);
        let mut number = |span: f32| (2.0 * random.rand_float() - 1.0) * span;
        (0..4000)
            .map(|round| {
                let mut half = || Vec3::new(number(4.0).exp2(), number(4.0).exp2(), number(4.0).exp2());
                let cuboids = [half(), half()].map(|half| Cuboid::from_half_extents(half).unwrap());
                let mut turn = || Quat::from_xyzw(number(1.0), number(1.0), number(1.0), number(1.0));
                let turns = [if round % 8 == 5 { Quat::IDENTITY } else { turn() }, turn()];
                // Some have the same rotation, or nearly so: then edges are parallel, or lose much to rounding. The
                // small rotation is about the normal of the faces that touch below: then those edges' axes equal the
                // faces'.
                let nearly = turns[0] * Quat::from_xyzw(0.0, 0.0, number(30.0).exp2().min(0.05), 1.0);
                let turns = [turns[0], [turns[0], nearly, nearly, turns[1]][round % 4]];
                // Half of them overlap by a hair, face on face, where rounding weighs most.
                let beside = Vec3::new(number(4.0), number(4.0), number(4.0)).as_dvec3();
                let [a, b] = cuboids.each_ref().map(Cuboid::half_extents);
                let above = DVec3::new(beside.x * 0.1, beside.y * 0.1, f64::from(a.z + b.z) * (1.0 - 1e-7));
                let above = Pose3::new(DVec3::ZERO, turns[0]).unwrap().transform(above);
                let away = if round % 8 < 4 { beside } else { above };
                let poses = [Pose3::new(away * 1e5, turns[0]), Pose3::new(away * 1e5 + away, turns[1])];
                (cuboids, poses.map(Result::unwrap))
            })
            .collect()
    }

    fn bits<const N: usize>(rows: &[Row; N]) -> Vec<u64> {
        rows.iter().flatten().map(|number| number.to_bits()).collect()
    }

    fn all_bits(results: &Results8) -> Vec<u64> {
        let nines = [&results.basis, &results.relative, &results.edges, &results.squared].map(bits);
        let threes = [&results.offset, &results.faces_a, &results.faces_b, &results.ahead].map(bits);
        let ones = [bits(&[results.parted]), bits(&[results.deep]), bits(&results.graded)];
        [nines.concat(), threes.concat(), ones.concat()].concat()
    }

    #[test]
    fn eight_pairs_are_bit_for_bit_what_each_is_alone_however_wide_the_registers() {
        let pairs = pairs();
        let mut eight = Eight::BLANK;
        let (mut parted, mut deep, mut settled, mut by_edges) = (0, 0, 0, 0);
        for eight_pairs in pairs.chunks_exact(LANES) {
            let posed = |k: usize| {
                let (cuboids, poses) = &eight_pairs[k];
                Posed { cuboids: [&cuboids[0], &cuboids[1]], poses: [&poses[0], &poses[1]] }
            };
            let margin = 0.125;
            (0..LANES).for_each(|k| eight.put(k, &posed(k), margin));
            eight.look::<true>();
            let mut narrower = [Eight::BLANK, Eight::BLANK];
            let [one, other] = &mut narrower;
            wide::look_narrower::<true>(&eight.input, [&mut one.results, &mut other.results]);
            for portable in &narrower {
                assert_eq!(all_bits(&eight.results), all_bits(&portable.results));
            }
            for k in 0..LANES {
                let (mut alone, placed) = (posed(k).placed(), eight.placed(k, &posed(k)));
                let Fifteen { faces_b, ahead, edges: [x, y, z], squared: [i, j, last], .. } =
                    &mut alone.fifteen;
                for row in [faces_b, ahead, x, y, z, i, j, last] {
                    row.0[3] = 0.0;
                }
                // Debug output of a float is different where its bits are.
                assert_eq!(format!("{alone:?}"), format!("{placed:?}"));
                assert_eq!(alone.parted(margin), eight.parted(k));
                assert_eq!(alone.are_deep(), eight.is_deep(k));
                if let (None, Some(best)) = (eight.parted(k), eight.best(k)) {
                    let Settled::Overlapping(own) = alone.settle(margin) else { panic!("they overlap") };
                    assert_eq!(format!("{own:?}"), format!("{best:?}"));
                    settled += 1;
                    by_edges += usize::from(best.edges.is_some());
                }
                parted += usize::from(eight.parted(k).is_some());
                deep += usize::from(eight.is_deep(k));
            }
        }
        assert!(parted > 100 && deep > 100, "{parted} parted, {deep} deep");
        assert!(settled * 10 >= deep * 9 && by_edges > 10, "{settled} settled, {by_edges} by edges");
    }
}
