//! The hints of touching parts of compounds: two of them in the space of one.
//!
//! ```text
//! bits of a hint's 96:    48 for each of two pairs of parts:
//!     12, 12              which part of A and of B
//!     2                   0 none, 1 two edges, 2 a face (or edge, in the plane) of A, 3 one of B
//!     11, 11              for two edges: their lower half-edges
//!     1, 12               for an edge in the plane: 1, its index
//!     1, 9, 2, 9          for a face: 0, its index; whether points are on another, of A (1) or of B (2); its index
//! ```
//! A pair of parts keeps its place for as long as it touches, even if others are deeper: else a body that rests on four
//! legs would have other hints each frame. Free places go to the deepest.
//!
//! Hammers of 2, 4 and 8 parts that touch, nanoseconds per pair without and with (AMD EPYC, Zen 4, 2026-11-21): of
//! hulls of 32, 3817, 4057, 5043 to 2713, 3326, 4320, and on a slab 1882, 3030, 5555 to 1291, 2427, 4755. Of boxes,
//! whose fifteen axes cost no more than a proof, 1599, 1952, 3155 to 1707, 2028, 3090: their hint saves no time, and is
//! kept for the face that points lie on.
//!
//! Hints that are directions do not fit and are not kept: those of parts that are apart, and of corners across a gap.

use crate::feature::{Feature, FeatureId, Hint, OnFace};
use asunder_geometry::tolerance::{MAX_HULL_VERTICES, MAX_PARTS, MAX_POLYGON_VERTICES};

const PART_BITS: u32 = 12;
const EDGE_BITS: u32 = 11;
const FACE_BITS: u32 = 9;
const FEATURE_BITS: u32 = 24;

const _: () = assert!(MAX_PARTS <= 1 << PART_BITS && MAX_POLYGON_VERTICES <= 1 << PART_BITS);
const _: () =
    assert!(6 * MAX_HULL_VERTICES - 12 <= 1 << EDGE_BITS && 2 * MAX_HULL_VERTICES - 4 <= 1 << FACE_BITS);

/// The hints of pairs of parts, read and written as the pairs are tested.
pub(crate) struct Kept {
    /// Last frame's hint.
    last: Hint,
    next: [Option<Place>; 2],
}

/// The hint of one pair of parts.
#[derive(Clone, Copy)]
struct Place {
    bits: u64,
    /// Whether it had a place in the last frame.
    is_held: bool,
    separation: f32,
}

impl Place {
    /// Whether it gives up its place to another.
    fn yields_to(&self, other: &Self) -> bool {
        if self.is_held == other.is_held { other.separation < self.separation } else { other.is_held }
    }
}

impl Kept {
    pub(crate) fn new(last: Hint) -> Self {
        Self { last, next: [None; 2] }
    }

    /// Last frame's hint for a pair of parts.
    pub(crate) fn of(&self, parts: [u32; 2]) -> Hint {
        let places = self.last.of_parts().unwrap_or_default();
        places.into_iter().find(|&bits| is_of(bits, parts)).map_or(Hint::NONE, unpacked)
    }

    /// Stores the hint of a pair of parts that touch, if there is a place for it.
    pub(crate) fn offer(&mut self, parts: [u32; 2], hint: Hint, separation: f32) {
        let Some(features) = packed(hint) else { return };
        let place = u64::from(parts[0]) | u64::from(parts[1]) << PART_BITS;
        let bits = features | place << FEATURE_BITS;
        let is_held = self.last.of_parts().unwrap_or_default().iter().any(|&last| is_of(last, parts));
        let mut newcomer = Place { bits, is_held, separation };
        for place in &mut self.next {
            match place {
                None => {
                    *place = Some(newcomer);
                    return;
                }
                Some(known) if known.yields_to(&newcomer) => core::mem::swap(known, &mut newcomer),
                Some(_) => {}
            }
        }
    }

    /// The hint for the next frame.
    pub(crate) fn hint(&self) -> Hint {
        Hint::for_parts(self.next.map(|place| place.map_or(0, |place| place.bits)))
    }
}

/// Whether these bits are the hint of these parts.
fn is_of(bits: u64, parts: [u32; 2]) -> bool {
    let part = |at: u32| (bits >> at) as u32 & ((1 << PART_BITS) - 1);
    kind(bits) != 0 && [part(FEATURE_BITS), part(FEATURE_BITS + PART_BITS)] == parts
}

fn kind(bits: u64) -> u64 {
    bits >> (FEATURE_BITS - 2) & 3
}

/// A hint's features in 24 bits; `None` where they do not fit, or for a direction.
fn packed(hint: Hint) -> Option<u64> {
    let fits = |index: u32, bits: u32| (index >> bits == 0).then_some(u64::from(index));
    let features = hint.features()?;
    let (owner, feature) = match (features.a(), features.b()) {
        (Feature::Edge(a), Feature::Edge(b)) => {
            // The face that points lie on matters more than the axis: a solver stands on it.
            return match hint.points_on() {
                None => Some(1 << 22 | fits(a, EDGE_BITS)? << EDGE_BITS | fits(b, EDGE_BITS)?),
                Some(OnFace::OfA(face)) => Some(2 << 22 | fits(face, FACE_BITS)? << 11),
                Some(OnFace::OfB(face)) => Some(3 << 22 | fits(face, FACE_BITS)? << 11),
            };
        }
        (feature, Feature::Vertex(_)) => (2, feature),
        (Feature::Vertex(_), feature) => (3, feature),
        _ => return None,
    };
    match feature {
        Feature::Vertex(_) => None,
        Feature::Edge(edge) => Some(owner << 22 | 1 << 21 | fits(edge, PART_BITS)?),
        Feature::Face(face) => {
            let points = match hint.points_on() {
                None => 0,
                Some(OnFace::OfA(face)) => 1 << FACE_BITS | fits(face, FACE_BITS)?,
                Some(OnFace::OfB(face)) => 2 << FACE_BITS | fits(face, FACE_BITS)?,
            };
            Some(owner << 22 | fits(face, FACE_BITS)? << 11 | points)
        }
    }
}

/// The hint that was packed.
fn unpacked(bits: u64) -> Hint {
    let index = |at: u32, count: u32| (bits >> at) as u32 & ((1 << count) - 1);
    let owner = kind(bits);
    if owner == 1 {
        let edges = [index(EDGE_BITS, EDGE_BITS), index(0, EDGE_BITS)].map(Feature::Edge);
        return Hint::axis(FeatureId::new(edges[0], edges[1]));
    }
    let is_edge = index(21, 1) == 1;
    let feature =
        if is_edge { Feature::Edge(index(0, PART_BITS)) } else { Feature::Face(index(11, FACE_BITS)) };
    let axis = Hint::axis(match owner {
        2 => FeatureId::new(feature, Feature::Vertex(0)),
        _ => FeatureId::new(Feature::Vertex(0), feature),
    });
    axis.with_points_on(match index(FACE_BITS, 2) {
        1 if !is_edge => Some(OnFace::OfA(index(0, FACE_BITS))),
        2 if !is_edge => Some(OnFace::OfB(index(0, FACE_BITS))),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(face: u32) -> FeatureId {
        FeatureId::new(Feature::Face(face), Feature::Vertex(0))
    }

    #[test]
    fn every_hint_of_features_comes_back() {
        let most_edges = 6 * MAX_HULL_VERTICES as u32 - 13;
        let most_faces = 2 * MAX_HULL_VERTICES as u32 - 5;
        let plane = MAX_POLYGON_VERTICES as u32 - 1;
        let hints = [
            Hint::axis(FeatureId::new(Feature::Edge(0), Feature::Edge(most_edges))),
            Hint::axis(FeatureId::new(Feature::Edge(most_edges), Feature::Edge(3))),
            Hint::axis(FeatureId::new(Feature::Edge(plane), Feature::Vertex(0))),
            Hint::axis(FeatureId::new(Feature::Vertex(0), Feature::Edge(plane))),
            Hint::axis(FeatureId::new(Feature::Vertex(0), Feature::Face(0))),
            Hint::axis(face(most_faces)).with_points_on(Some(OnFace::OfB(most_faces))),
            Hint::axis(face(0)).with_points_on(Some(OnFace::OfA(7))),
        ];
        let last = MAX_PARTS as u32 - 1;
        for (i, &one) in hints.iter().enumerate() {
            let other = hints[(i + 3) % hints.len()];
            let mut kept = Kept::new(Hint::NONE);
            kept.offer([0, last], one, -1.0);
            kept.offer([last, 17], other, -2.0);
            let next = Kept::new(kept.hint());
            assert_eq!((next.of([0, last]), next.of([last, 17])), (one, other));
            assert_eq!(next.of([0, 17]), Hint::NONE);
        }
    }

    #[test]
    fn points_on_a_face_outlive_the_edges_that_were_the_axis() {
        let edges = Hint::axis(FeatureId::new(Feature::Edge(4), Feature::Edge(9)));
        let mut kept = Kept::new(Hint::NONE);
        kept.offer([1, 2], edges.with_points_on(Some(OnFace::OfA(5))), -1.0);
        assert_eq!(Kept::new(kept.hint()).of([1, 2]), Hint::axis(face(5)));
    }

    #[test]
    fn who_has_a_place_keeps_it_and_free_ones_go_to_the_deepest() {
        let names = |kept: &Kept| [0, 1, 2].map(|part| Kept::new(kept.hint()).of([part, 0]) != Hint::NONE);
        let mut first = Kept::new(Hint::NONE);
        for (part, depth) in [(0, 1.0), (1, 2.0), (2, 3.0)] {
            first.offer([part, 0], Hint::axis(face(part)), -depth);
        }
        assert_eq!(names(&first), [false, true, true]);
        let mut second = Kept::new(first.hint());
        for (part, depth) in [(0, 9.0), (1, 1.0), (2, 2.0)] {
            second.offer([part, 0], Hint::axis(face(part)), -depth);
        }
        assert_eq!(names(&second), [false, true, true]);
        let mut third = Kept::new(second.hint());
        for (part, depth) in [(0, 0.1), (1, 1.0)] {
            third.offer([part, 0], Hint::axis(face(part)), -depth);
        }
        assert_eq!(names(&third), [true, true, false]);
    }

    #[test]
    fn directions_and_nothing_find_no_room() {
        let mut kept = Kept::new(Hint::NONE);
        kept.offer([0, 0], Hint::NONE, -1.0);
        kept.offer([0, 0], Hint::towards(asunder_geometry::glam::DVec3::X), -1.0);
        assert_eq!(kept.hint(), Hint::for_parts([0, 0]));
        assert_eq!(Kept::new(kept.hint()).of([0, 0]), Hint::NONE);
    }
}
