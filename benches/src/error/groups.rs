//! Groups of pairs for the comparison of methods.
//!
//! | group | space | plane |
//! |---|---|---|
//! | random-mixed | pairs as from a broad phase, 40 % apart: cuboids, wedges and cylinders, hulls of 8 and of 16 vertices, a quarter each | rectangles, polygons of 8 |
//! | resting | face on face, with an overlap of 1e-3 to 1e-7 of size | edge on edge, the same |
//! | near-touching | faces, edges and vertices, gap or overlap of 1e-3 of size to zero | edges and vertices, the same |
//! | parallel-edges | an edge along an edge, at 1e-2 rad to none | the same |
//! | slivers | needles, plates, faces nearly in one plane, near touching | needles |
//! | far | near touching, 100 m to 1e9 m from the origin | the same |
//! | tiny-and-huge | near touching, 1e-6 m to 1e6 m, and one beside the other | the same |
//!
//! All but the first come from the hard families of `asunder_scenes`, from which only sharp convex shapes with an
//! interior and at most 24 vertices are taken: those that all methods accept.

use asunder_geometry::{Shape2, Shape3};
use asunder_scenes::hard::{Family2, Family3};
use asunder_scenes::pairs::{PairSet, PlaneKind, PosedPair2, PosedPair3, SolidKind, pairs2, pairs3};

/// The groups, in the order in which results are listed.
pub(super) const GROUPS: [&str; 7] =
    ["random-mixed", "resting", "near-touching", "parallel-edges", "slivers", "far", "tiny-and-huge"];

/// The most vertices of a shape: with more, the textbook would take a millisecond.
const VERTICES: usize = 24;

/// The most hard cases that are generated for each one that is taken.
const TRIES: usize = 20;

/// Whether a shape is sharp, convex, and has an interior.
pub(super) fn is_sharp3(shape: &Shape3) -> bool {
    let is_solid = match shape {
        Shape3::Cuboid(_) => true,
        Shape3::Hull(hull) => hull.dimension() == 3,
        _ => false,
    };
    is_solid && shape.radius() == 0.0 && shape.outer_radius() > 0.0
}

/// Whether a shape in the plane is sharp, convex, and has an interior.
pub(super) fn is_sharp2(shape: &Shape2) -> bool {
    matches!(shape, Shape2::Rect(_) | Shape2::Polygon(_))
        && shape.radius() == 0.0
        && shape.outer_radius() > 0.0
}

/// Pairs of one dimension, in groups.
pub(super) trait Grouped: Sized + Clone {
    /// The name of the dimension in rows.
    const DIMENSION: &'static str;
    /// About `count` pairs of a group.
    fn group(name: &str, count: usize, seed: u64) -> Vec<Self>;
}

/// Interleaves sets, with equally many pairs of each.
fn in_turns<P: Clone>(sets: &[Vec<P>]) -> Vec<P> {
    let length = sets.iter().map(Vec::len).min().unwrap_or(0);
    (0..length).flat_map(|i| sets.iter().map(move |set| set[i].clone())).collect()
}

/// The first `count` pairs of a family that pass the test.
fn taken<P>(count: usize, family: impl Fn(usize) -> Vec<P>, is_taken: impl Fn(&P) -> bool) -> Vec<P> {
    let mut tries = 2;
    loop {
        let mut pairs = family(count * tries);
        pairs.retain(&is_taken);
        if pairs.len() >= count || tries >= TRIES {
            pairs.truncate(count);
            return pairs;
        }
        tries *= 2;
    }
}

impl Grouped for PosedPair3 {
    const DIMENSION: &'static str = "3d";

    fn group(name: &str, count: usize, seed: u64) -> Vec<Self> {
        let families: &[&str] = match name {
            "resting" => &["resting"],
            "near-touching" => {
                &["face-rotated", "crossed-edges", "vertex-face", "vertex-edge", "vertex-vertex"]
            }
            "parallel-edges" => &["parallel-edges"],
            "slivers" => &["slivers", "needles", "plates"],
            "far" => &["far"],
            "tiny-and-huge" => &["tiny", "huge", "size-ratio"],
            _ => {
                let kinds = [SolidKind::Box, SolidKind::Authored, SolidKind::Hull8, SolidKind::Hull16];
                let of_kind = |kind| pairs3(kind, PairSet::Mixed, count.div_ceil(kinds.len()), seed);
                return in_turns(&kinds.map(of_kind));
            }
        };
        let is_taken = |pair: &Self| {
            let is_small = |shape: &Shape3| is_sharp3(shape) && shape.core().vertices().len() <= VERTICES;
            is_small(&pair.shape_a) && is_small(&pair.shape_b)
        };
        let each = count.div_ceil(families.len());
        let of_family = |family: &Family3| taken(each, |count| family.pairs(count, seed), is_taken);
        let sets: Vec<Vec<Self>> =
            families.iter().filter_map(|name| Family3::by_name(name)).map(of_family).collect();
        in_turns(&sets)
    }
}

impl Grouped for PosedPair2 {
    const DIMENSION: &'static str = "2d";

    fn group(name: &str, count: usize, seed: u64) -> Vec<Self> {
        let families: &[&str] = match name {
            "resting" => &["resting"],
            "near-touching" => &["edge-rotated", "vertex-edge", "vertex-vertex"],
            "parallel-edges" => &["parallel-edges"],
            "slivers" => &["needles"],
            "far" => &["far"],
            "tiny-and-huge" => &["tiny", "huge", "size-ratio"],
            _ => {
                let kinds = [PlaneKind::Rect, PlaneKind::Poly8];
                let of_kind = |kind| pairs2(kind, PairSet::Mixed, count.div_ceil(kinds.len()), seed);
                return in_turns(&kinds.map(of_kind));
            }
        };
        let is_taken = |pair: &Self| {
            let is_small = |shape: &Shape2| is_sharp2(shape) && shape.core().vertices().len() <= VERTICES;
            is_small(&pair.shape_a) && is_small(&pair.shape_b)
        };
        let each = count.div_ceil(families.len());
        let of_family = |family: &Family2| taken(each, |count| family.pairs(count, seed), is_taken);
        let sets: Vec<Vec<Self>> =
            families.iter().filter_map(|name| Family2::by_name(name)).map(of_family).collect();
        in_turns(&sets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_group_has_pairs_and_no_two_are_alike() {
        for name in GROUPS {
            let space = PosedPair3::group(name, 60, 1);
            assert!(space.len() >= 60, "{name}: {}", space.len());
            assert!(space.iter().all(|pair| is_sharp3(&pair.shape_a) && is_sharp3(&pair.shape_b)), "{name}");
            let plane = PosedPair2::group(name, 60, 1);
            assert!(plane.len() >= 60, "{name}: {}", plane.len());
            assert!(plane.iter().all(|pair| is_sharp2(&pair.shape_a) && is_sharp2(&pair.shape_b)), "{name}");
            let place = |pair: &PosedPair3| (pair.pose_a, pair.pose_b);
            assert_ne!(place(&space[0]), place(&space[1]), "{name}");
        }
    }
}
