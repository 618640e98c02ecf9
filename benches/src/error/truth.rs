//! The truth about pairs: computed once, and compared with every method.
//!
//! The separation is that of the tests' oracle in double-double (`asunder_tests::precise`), accurate to a unit or two
//! in the last place of an f64. Yes or no is its sign where it is further from zero than 1e-9 of the size, which is a
//! million times its error; nearer, exact integer arithmetic (`asunder_tests::exact_overlap`) decides.

use crate::judge::Judge;
use asunder_scenes::pairs::{PosedPair2, PosedPair3};
use asunder_tests::exact_overlap::Relation;
use asunder_tests::report::Posed;
use rayon::prelude::*;

/// Within this share of the size from touching, integers decide.
const NEAR: f64 = 1e-9;

/// Pairs per judge, which stores all hulls it has seen and searches them linearly.
const CHUNK: usize = 200;

/// The truth about a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Truth {
    /// How the two lie, exactly.
    pub(super) relation: Relation,
    /// The distance of a gap, or minus the depth of an overlap, in metres.
    pub(super) separation: f64,
    /// The size to which errors are relative, in metres.
    pub(super) size: f64,
}

/// Pairs whose separations can be computed many at a time.
pub(super) trait Judged: Posed {
    /// The separations of some pairs, in metres.
    fn separations(pairs: &[Self]) -> Vec<f64>
    where
        Self: Sized;
}

impl Judged for PosedPair3 {
    fn separations(pairs: &[Self]) -> Vec<f64> {
        let mut judge = Judge::default();
        pairs.iter().map(|pair| judge.separation(pair)).collect()
    }
}

impl Judged for PosedPair2 {
    fn separations(pairs: &[Self]) -> Vec<f64> {
        pairs.iter().map(|pair| pair.truth().separation).collect()
    }
}

/// The truth about each pair, in order; computed on all threads.
pub(super) fn truths<P: Judged>(pairs: &[P]) -> Vec<Truth> {
    let of_chunk = |chunk: &[P]| -> Vec<Truth> {
        let separations = P::separations(chunk);
        chunk.iter().zip(separations).map(|(pair, separation)| truth(pair, separation)).collect()
    };
    pairs.par_chunks(CHUNK).flat_map_iter(of_chunk).collect()
}

fn truth<P: Judged>(pair: &P, separation: f64) -> Truth {
    let size = pair.size();
    let relation = if separation.abs() <= NEAR * size {
        pair.relation()
    } else if separation > 0.0 {
        Relation::Apart
    } else {
        Relation::Overlapping
    };
    Truth { relation, separation, size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::groups::{GROUPS, Grouped};

    #[test]
    fn the_sign_is_that_of_exact_arithmetic() {
        for name in GROUPS {
            let pairs = PosedPair3::group(name, 40, 2);
            for (pair, truth) in pairs.iter().zip(truths(&pairs)) {
                assert_eq!(truth.relation, pair.relation(), "{name}");
                let other = pair.truth();
                assert!((truth.separation - other.separation).abs() <= 2.0 * other.bound, "{name}");
            }
            let pairs = PosedPair2::group(name, 40, 2);
            for (pair, truth) in pairs.iter().zip(truths(&pairs)) {
                assert_eq!(truth.relation, pair.relation(), "{name}");
            }
        }
    }
}
