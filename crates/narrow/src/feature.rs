//! Ids of vertices, edges and faces that stay the same from frame to frame.

use asunder_geometry::glam::{DVec3, Vec3};

/// A feature of one shape, by the index that its topology gives it.
///
/// - Vertices count as in `vertices()`.
/// - Edges of a polyhedron count by their lower half-edge ([`Topology::edge_of`](asunder_geometry::Topology::edge_of)),
///   edges of a polygon by the vertex they start from.
/// - The edges of a chain are its straight runs, by their first segments ([`Run`](asunder_geometry::Run)).
/// - A face of a mesh or height field is a plane, by its lowest triangle; an edge counts by the lower of its
///   half-edges, of which triangle `t` has `3 t` to `3 t + 2`.
///
/// ```
/// use asunder::{Feature, Pair2, Pose2, Rect, Shape2, glam::Vec2};
/// let block = Shape2::from(Rect::from_half_extents(Vec2::new(1.0, 0.5))?);
/// let small = Shape2::from(Rect::from_half_extents(Vec2::new(0.5, 0.5))?);
/// let (here, above) = (Pose2::IDENTITY, Pose2::at([0.0, 0.875])?);
/// let manifold = Pair2::new(&block, &here, &small, &above).manifold(0.0).ok_or("they overlap")?;
/// let names: Vec<_> = manifold.points.iter().map(|point| (point.feature.a(), point.feature.b())).collect();
/// assert_eq!(names.len(), 2);
/// assert!(names.iter().all(|name| matches!(name, (Feature::Edge(2), Feature::Vertex(0 | 1)))), "{names:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Feature {
    /// A vertex.
    Vertex(u32),
    /// An edge.
    Edge(u32),
    /// A face; in the plane there is none.
    Face(u32),
}

const INDEX_BITS: u32 = 30;
const INDEX_MASK: u32 = (1 << INDEX_BITS) - 1;

impl Feature {
    const fn to_bits(self) -> u32 {
        match self {
            Self::Vertex(i) => i & INDEX_MASK,
            Self::Edge(i) => 1 << INDEX_BITS | i & INDEX_MASK,
            Self::Face(i) => 2 << INDEX_BITS | i & INDEX_MASK,
        }
    }

    const fn from_bits(bits: u32) -> Self {
        match bits >> INDEX_BITS {
            0 => Self::Vertex(bits & INDEX_MASK),
            1 => Self::Edge(bits & INDEX_MASK),
            _ => Self::Face(bits & INDEX_MASK),
        }
    }
}

/// Which feature of A meets which feature of B, in 64 bits: together with both bodies and both parts, the key by which
/// a solver finds last frame's impulse.
///
/// Equal features have equal ids, whichever kernel found them and whichever shape was the reference.
///
/// ```
/// use asunder::{Feature, FeatureId};
/// let id = FeatureId::new(Feature::Face(3), Feature::Vertex(7));
/// assert_eq!((id.a(), id.b()), (Feature::Face(3), Feature::Vertex(7)));
/// assert_eq!(FeatureId::from_bits(id.to_bits()), id);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "u64", into = "u64")
)]
// Not a u64, which would make each contact point 4 bytes longer: a frame of bodies at rest reads and writes little
// else.
pub struct FeatureId([u32; 2]);

impl FeatureId {
    /// The id of a feature of A that meets a feature of B.
    pub const fn new(a: Feature, b: Feature) -> Self {
        Self([a.to_bits(), b.to_bits()])
    }

    /// The feature of A.
    pub const fn a(self) -> Feature {
        Feature::from_bits(self.0[0])
    }

    /// The feature of B.
    pub const fn b(self) -> Feature {
        Feature::from_bits(self.0[1])
    }

    /// Both features, the lower first: the same for the other order of the shapes.
    pub(crate) const fn in_any_order(self) -> [u32; 2] {
        let [a, b] = self.0;
        if a < b { [a, b] } else { [b, a] }
    }

    /// All 64 bits, for storage.
    pub const fn to_bits(self) -> u64 {
        (self.0[0] as u64) << 32 | self.0[1] as u64
    }

    /// The id with these bits.
    pub const fn from_bits(bits: u64) -> Self {
        Self([(bits >> 32) as u32, bits as u32])
    }
}

#[cfg(feature = "serde")]
impl From<u64> for FeatureId {
    fn from(bits: u64) -> Self {
        Self::from_bits(bits)
    }
}

#[cfg(feature = "serde")]
impl From<FeatureId> for u64 {
    fn from(id: FeatureId) -> Self {
        id.to_bits()
    }
}

/// The last frame's knowledge about a pair: opaque, cheap to keep, and safe to lose.
///
/// It holds the axis to try first, by its features or as the direction that separated the shapes; and the face on which
/// contact points were made, if that is another.
/// - A stale hint, even one made for other shapes, costs a projection or two. It can never change whether shapes
///   overlap, nor break an error bound: an axis is trusted only after both shapes were projected on it.
/// - Among features that are equally good up to rounding, contact points are made on those of the hint, so that they do
///   not flicker under a solver.
///
/// ```
/// use asunder_narrow::Hint;
/// assert_eq!(Hint::default(), Hint::NONE);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hint(Known);

/// A face of either shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OnFace {
    OfA(u32),
    OfB(u32),
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Known {
    #[default]
    Nothing,
    /// Bits of a [`FeatureId`]; then, if contact points were made on another face, that face: the top bit set, its
    /// index, and whose it is. Else zero.
    Features([u32; 3]),
    /// Bits of a vector: in A's axes in space, in the world's in the plane. For compounds, one that separated them as
    /// wholes.
    Direction([u32; 3]),
    /// For compounds that are apart: for how many frames none has separated them as wholes, and the direction to try
    /// next.
    Sought(u8, [u32; 3]),
    /// For compounds that touch: what two pairs of parts left; see `kept`.
    Parts([u32; 3]),
}

/// For this many frames on end, a direction is sought that separates two compounds as wholes; from then on, in one
/// frame of every `PAUSE`. Hammers hooked into each other, which no plane separates: 8 to 40 % slower with a try in
/// every frame.
const TRIES: u8 = 4;
const PAUSE: u8 = 16;

impl Hint {
    /// Nothing is known.
    pub const NONE: Self = Self(Known::Nothing);

    /// The axis that belongs to a feature of either shape: a face (or edge, in the plane) of one against a vertex of
    /// the other, or two edges.
    pub(crate) const fn axis(features: FeatureId) -> Self {
        let bits = features.to_bits();
        Self(Known::Features([(bits >> 32) as u32, bits as u32, 0]))
    }

    /// The same, with the face of either shape that contact points were made on; `None` if it is the axis' own.
    pub(crate) fn with_points_on(self, face: Option<OnFace>) -> Self {
        let bits = match face {
            None => 0,
            Some(OnFace::OfA(face)) => face << 1 | 1 << 31,
            Some(OnFace::OfB(face)) => face << 1 | 1 << 31 | 1,
        };
        match self.0 {
            Known::Features([a, b, _]) => Self(Known::Features([a, b, bits])),
            _ => self,
        }
    }

    /// The face that contact points were made on, if it is not the axis' own.
    pub(crate) const fn points_on(self) -> Option<OnFace> {
        match self.0 {
            Known::Features([_, _, bits]) if bits >> 31 == 1 => {
                let face = (bits & !(1 << 31)) >> 1;
                Some(if bits & 1 == 0 { OnFace::OfA(face) } else { OnFace::OfB(face) })
            }
            _ => None,
        }
    }

    /// A direction that separates the shapes: in A's axes in space, in the world's in the plane.
    pub(crate) fn towards(direction: DVec3) -> Self {
        Self(Known::Direction(bits_of(direction)))
    }

    /// For compounds that are apart: the direction to try next, after one more frame in which none separated them as
    /// wholes.
    pub(crate) fn seeking(self, direction: DVec3) -> Self {
        let frames = if let Known::Sought(frames, _) = self.0 { frames.wrapping_add(1) } else { 0 };
        Self(Known::Sought(frames, bits_of(direction)))
    }

    /// The direction that separated compounds as wholes, or the one to try next; and whether to try it in this frame:
    /// the first few frames do, and from then on one of many.
    pub(crate) fn sought(self) -> Option<(DVec3, bool)> {
        let (bits, is_due) = match self.0 {
            Known::Direction(bits) => (bits, true),
            Known::Sought(frames, bits) => (bits, frames < TRIES || frames.is_multiple_of(PAUSE)),
            _ => return None,
        };
        direction_of(bits).try_normalize().map(|sought| (sought, is_due))
    }

    /// For two pairs of parts, what was kept of each, in 48 bits.
    pub(crate) fn for_parts([one, other]: [u64; 2]) -> Self {
        Self(Known::Parts([one as u32, (one >> 32 | other << 16) as u32, (other >> 16) as u32]))
    }

    /// What [`for_parts`](Self::for_parts) stored; `None` unless the shapes were compounds that touched.
    pub(crate) fn of_parts(self) -> Option<[u64; 2]> {
        match self.0 {
            Known::Parts(bits) => {
                let [low, middle, high] = bits.map(u64::from);
                Some([low | (middle & 0xFFFF) << 32, middle >> 16 | high << 16])
            }
            _ => None,
        }
    }

    pub(crate) const fn features(self) -> Option<FeatureId> {
        match self.0 {
            Known::Features([a, b, _]) => Some(FeatureId::from_bits((a as u64) << 32 | b as u64)),
            _ => None,
        }
    }

    /// The direction, of unit length, in the axes that it was given in.
    pub(crate) fn direction(self) -> Option<DVec3> {
        match self.0 {
            Known::Direction(bits) => direction_of(bits).try_normalize(),
            _ => None,
        }
    }
}

/// A direction as a hint stores it.
#[inline]
fn bits_of(direction: DVec3) -> [u32; 3] {
    let Vec3 { x, y, z } = direction.as_vec3();
    [x.to_bits(), y.to_bits(), z.to_bits()]
}

/// The direction that [`bits_of`] stored.
#[inline]
fn direction_of([x, y, z]: [u32; 3]) -> DVec3 {
    Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z)).as_dvec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hint_names_any_axis() {
        assert_eq!(Hint::NONE.features(), None);
        for id in [
            FeatureId::new(Feature::Vertex(0), Feature::Vertex(0)),
            FeatureId::new(Feature::Edge(1523), Feature::Edge(7)),
            FeatureId::new(Feature::Vertex(0), Feature::Face(507)),
            FeatureId::new(Feature::Face(3), Feature::Vertex(0)),
        ] {
            assert_eq!(Hint::axis(id).features(), Some(id));
            for face in [None, Some(OnFace::OfA(0)), Some(OnFace::OfB(0)), Some(OnFace::OfA(509))] {
                let hint = Hint::axis(id).with_points_on(face);
                assert_eq!((hint.features(), hint.points_on()), (Some(id), face));
            }
        }
    }

    #[test]
    fn a_direction_is_sought_for_some_frames_and_then_now_and_again() {
        let mut hint = Hint::towards(DVec3::X);
        let mut is_due = Vec::new();
        for _ in 0..300 {
            hint = hint.seeking(DVec3::Y);
            let (direction, due) = hint.sought().unwrap();
            assert_eq!((direction, hint.direction()), (DVec3::Y, None));
            is_due.push(due);
        }
        assert!(is_due[..4].iter().all(|&due| due) && is_due[4..16].iter().all(|&due| !due) && is_due[16]);
        assert_eq!(core::mem::size_of::<Hint>(), 16);
    }

    #[test]
    fn a_hint_keeps_a_direction_up_to_its_rounding() {
        let direction = DVec3::new(0.36, -0.48, 0.8);
        let kept = Hint::towards(direction).direction().unwrap();
        assert!((kept - direction).length() < 1e-7 && (kept.length() - 1.0).abs() < 1e-15);
        assert_eq!(Hint::towards(DVec3::ZERO).direction(), None);
        assert_eq!(Hint::towards(direction).features(), None);
    }
}
