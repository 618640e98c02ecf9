//! Hard families of posed pairs: cases in which collision tests go wrong, each with levels of difficulty.
//!
//! Most pairs are built near touching: along a chosen direction, B's support point is put a chosen gap beyond A's
//! support point, so that the true separation is that gap up to the rounding of positions. The exact answer is left to
//! an oracle; nothing here claims to know it.
//!
//! A pair is a function of its family, level and seed alone, bit for bit. No generator fails: where a constructor
//! rejects a shape (it should reject none), a plain shape takes its place.
//!
//! ```
//! use asunder_scenes::hard::{FAMILIES2, FAMILIES3, Family3};
//! let family = Family3::by_name("crossed-edges").unwrap();
//! let hardest = family.pair(family.levels - 1, 1);
//! let size = hardest.shape_a.outer_radius() + hardest.shape_b.outer_radius();
//! assert!((hardest.pose_a.position() - hardest.pose_b.position()).length() <= f64::from(size));
//! // A table of everything, level by level.
//! let count: usize = FAMILIES3.iter().map(|family| family.pairs(4, 1).len()).sum();
//! assert_eq!(count, 4 * FAMILIES3.len());
//! assert!(FAMILIES2.iter().all(|family| family.levels >= 1 && !family.about.is_empty()));
//! ```

mod gap;
mod plane;
mod space;
#[cfg(test)]
mod tests;

pub use plane::FAMILIES2;
pub use space::FAMILIES3;

use crate::pairs::{PosedPair2, PosedPair3};
use crate::random::Random;
use core::fmt;
use plane::Draft2;
use space::Draft3;

/// A family of hard pairs in space.
///
/// ```
/// use asunder_scenes::hard::Family3;
/// let family = Family3::by_name("face-ulps").unwrap();
/// let (one, other) = (family.pair(3, 7), family.pair(3, 7));
/// assert_eq!((one.pose_a, one.pose_b, one.shape_b), (other.pose_a, other.pose_b, other.shape_b));
/// assert!(family.levels > 3 && family.knob.len() > 3);
/// ```
#[derive(Clone, Copy)]
pub struct Family3 {
    /// The name used in result rows.
    pub name: &'static str,
    /// What the family is, in a sentence.
    pub about: &'static str,
    /// What a higher level means, in a sentence.
    pub knob: &'static str,
    /// How many levels of difficulty there are, from 0, the easiest. At least 1.
    pub levels: u32,
    make: fn(u32, &mut Random) -> Draft3,
}

/// A family of hard pairs in the plane.
///
/// ```
/// use asunder_scenes::hard::{FAMILIES2, Family2};
/// let family = Family2::by_name("edge-ulps").unwrap();
/// assert_ne!(family.pair(1, 7).pose_a, family.pair(1, 8).pose_a);
/// assert_eq!(FAMILIES2.iter().filter(|other| other.name == family.name).count(), 1);
/// ```
#[derive(Clone, Copy)]
pub struct Family2 {
    /// The name used in result rows.
    pub name: &'static str,
    /// What the family is, in a sentence.
    pub about: &'static str,
    /// What a higher level means, in a sentence.
    pub knob: &'static str,
    /// How many levels of difficulty there are, from 0, the easiest. At least 1.
    pub levels: u32,
    make: fn(u32, &mut Random) -> Draft2,
}

impl Family3 {
    /// The family of that name, if there is one.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        FAMILIES3.iter().find(|family| family.name == name)
    }

    /// The pair of a level and a seed. A level beyond the last counts as the last. Cost: that of building two shapes.
    pub fn pair(&self, level: u32, seed: u64) -> PosedPair3 {
        self.draft(level, seed).pair
    }

    /// `count` pairs, cycling through the levels, each with a seed of its own.
    pub fn pairs(&self, count: usize, seed: u64) -> Vec<PosedPair3> {
        (0..count).map(|i| self.pair(level_of(i, self.levels), mixed(seed, i as u64))).collect()
    }

    fn draft(&self, level: u32, seed: u64) -> Draft3 {
        let level = level.min(self.levels.saturating_sub(1));
        let mut random = Random::new(seed_of(self.name, level, seed));
        let draft = (self.make)(level, &mut random);
        if random.unit() < 0.5 { draft.swapped() } else { draft }
    }
}

impl Family2 {
    /// The family of that name, if there is one.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        FAMILIES2.iter().find(|family| family.name == name)
    }

    /// The pair of a level and a seed. A level beyond the last counts as the last. Cost: that of building two shapes.
    pub fn pair(&self, level: u32, seed: u64) -> PosedPair2 {
        self.draft(level, seed).pair
    }

    /// `count` pairs, cycling through the levels, each with a seed of its own.
    pub fn pairs(&self, count: usize, seed: u64) -> Vec<PosedPair2> {
        (0..count).map(|i| self.pair(level_of(i, self.levels), mixed(seed, i as u64))).collect()
    }

    fn draft(&self, level: u32, seed: u64) -> Draft2 {
        let level = level.min(self.levels.saturating_sub(1));
        let mut random = Random::new(seed_of(self.name, level, seed));
        let draft = (self.make)(level, &mut random);
        if random.unit() < 0.5 { draft.swapped() } else { draft }
    }
}

impl fmt::Debug for Family3 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Family3({}, {} levels)", self.name, self.levels)
    }
}

impl fmt::Debug for Family2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Family2({}, {} levels)", self.name, self.levels)
    }
}

fn level_of(index: usize, levels: u32) -> u32 {
    (index % levels.max(1) as usize) as u32
}

/// A seed such that families and levels with the same seed draw from unrelated streams.
fn seed_of(name: &str, level: u32, seed: u64) -> u64 {
    let of_name = name.bytes().fold(0, |known, byte| mixed(known, u64::from(byte)));
    mixed(mixed(of_name, u64::from(level)), seed)
}

/// The finaliser of SplitMix (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
fn mixed(one: u64, other: u64) -> u64 {
    let mut bits =
        one.wrapping_mul(0xd134_2543_de82_ef95).wrapping_add(other).wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
