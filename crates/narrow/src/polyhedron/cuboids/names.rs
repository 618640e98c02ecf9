//! Corners, edges and faces of a cuboid by index, without its topology.
//!
//! ```text
//! corner c       positive on axis i where bit i of c is set
//! face 2 i + s   faces along axis i, outwards where s is 1; its corners, counter-clockwise from outside:
//!                (-,-) (+,-) (+,+) (-,+)    on the axes i+1, i+2 where s is 1, on i+2, i+1 where it is 0
//! half-edge      4 face + k, from corner k of the face
//! ```
//! A name is a feature in seven bits: two for its kind, five for its index. Names sort like the features they stand
//! for, and two names in one word sort like feature ids.

use crate::feature::FeatureId;

/// Corners of each face in order, as in the cuboid's topology (a test compares them).
const LOOPS: [[u8; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// The lower half-edge of the edge that each half-edge belongs to.
const EDGE_OF: [u8; 24] = edge_of();

/// The edge through each corner along each axis.
const EDGE_ALONG: [[u8; 8]; 3] = edge_along();

const fn edge_of() -> [u8; 24] {
    let mut edges = [0; 24];
    let mut one = 0;
    while one < 24 {
        let mut lowest = one;
        let mut other = 0;
        while other < one {
            if from(one) == to(other) && to(one) == from(other) {
                lowest = other;
            }
            other += 1;
        }
        edges[one] = lowest as u8;
        one += 1;
    }
    edges
}

const fn edge_along() -> [[u8; 8]; 3] {
    let mut edges = [[0; 8]; 3];
    let mut half_edge = 0;
    while half_edge < 24 {
        let axis = (from(half_edge) ^ to(half_edge)).trailing_zeros() as usize;
        edges[axis][from(half_edge) as usize] = EDGE_OF[half_edge];
        edges[axis][to(half_edge) as usize] = EDGE_OF[half_edge];
        half_edge += 1;
    }
    edges
}

const fn from(half_edge: usize) -> u8 {
    LOOPS[half_edge / 4][half_edge % 4]
}

const fn to(half_edge: usize) -> u8 {
    LOOPS[half_edge / 4][(half_edge + 1) % 4]
}

/// Corner `k` of a face, in the face's order.
#[inline]
pub(super) fn corner(face: usize, k: usize) -> usize {
    LOOPS[face % 6][k % 4].into()
}

/// The edge that starts at corner `k` of a face.
#[inline]
pub(super) fn edge(face: usize, k: usize) -> usize {
    EDGE_OF[4 * (face % 6) + k % 4].into()
}

/// The edge that runs through a corner along an axis.
#[inline]
pub(super) fn edge_through(corner: usize, axis: usize) -> usize {
    EDGE_ALONG[axis % 3][corner % 8].into()
}

/// The corner that a half-edge starts from.
#[inline]
pub(super) fn start(half_edge: usize) -> usize {
    from(half_edge % 24).into()
}

/// The axis that an edge runs along.
#[inline]
pub(super) fn axis_of(half_edge: usize) -> usize {
    let half_edge = half_edge % 24;
    (from(half_edge) ^ to(half_edge)).trailing_zeros() as usize % 3
}

/// A feature of one cuboid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Name(u32);

impl Name {
    pub(super) const fn vertex(corner: usize) -> Self {
        Self(corner as u32)
    }

    pub(super) const fn edge(half_edge: usize) -> Self {
        Self(1 << 5 | half_edge as u32)
    }

    pub(super) const fn face(face: usize) -> Self {
        Self(2 << 5 | face as u32)
    }

    /// As `Feature` packs it.
    const fn to_bits(self) -> u64 {
        ((self.0 as u64 >> 5 & 3) << 30) | (self.0 as u64 & 31)
    }
}

/// A feature of A that meets one of B: sorts as its feature id does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Names(pub(super) u32);

impl Names {
    /// Of a feature of the reference cuboid and one of the other.
    #[inline]
    pub(super) const fn new(of_reference: Name, of_incident: Name, reference_is_b: bool) -> Self {
        let (a, b) = if reference_is_b { (of_incident, of_reference) } else { (of_reference, of_incident) };
        Self(a.0 << 7 | b.0)
    }

    #[inline]
    pub(super) const fn id(self) -> FeatureId {
        FeatureId::from_bits(Name(self.0 >> 7 & 127).to_bits() << 32 | Name(self.0 & 127).to_bits())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::Feature;
    use asunder_geometry::Cuboid;

    #[test]
    fn the_tables_are_the_topologys() {
        let topology = Cuboid::topology();
        for face in 0..6 {
            let corners: Vec<usize> = topology.face_vertices(face).collect();
            assert_eq!(corners, (0..4).map(|k| corner(face, k)).collect::<Vec<_>>());
        }
        for half_edge in 0..24 {
            let (from, to) = topology.ends(half_edge);
            assert_eq!(edge(half_edge / 4, half_edge % 4), topology.edge_of(half_edge));
            let axis = axis_of(half_edge);
            assert_eq!(from ^ to, 1 << axis);
            for corner in [from, to] {
                assert_eq!(edge_through(corner, axis), topology.edge_of(half_edge));
            }
        }
    }

    #[test]
    fn names_are_feature_ids_in_little_and_sort_like_them() {
        let features = |f: usize| match f {
            0..8 => (Name::vertex(f), Feature::Vertex(f as u32)),
            8..32 => (Name::edge(f - 8), Feature::Edge(f as u32 - 8)),
            _ => (Name::face(f - 32), Feature::Face(f as u32 - 32)),
        };
        let mut last = None;
        for (name_a, a) in (0..38).map(features) {
            for (name_b, b) in (0..38).map(features) {
                let names = Names::new(name_a, name_b, false);
                assert_eq!(names.id(), FeatureId::new(a, b));
                assert_eq!(Names::new(name_b, name_a, true), names);
                assert!(last < Some(names) && last.is_none_or(|last: Names| last.id() < names.id()));
                last = Some(names);
            }
        }
    }
}
