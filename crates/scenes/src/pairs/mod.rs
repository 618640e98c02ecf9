//! Posed pairs of shapes: sets to measure a narrow phase on.
//!
//! ```
//! use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, SolidKind, frames3, pairs2, pairs3};
//! let pairs = pairs3(SolidKind::Hull16, PairSet::Mixed, 100, 1);
//! assert_eq!(pairs.len(), 100);
//! assert!(pairs.iter().all(|p| p.shape_a.bounds(&p.pose_a, 0.0).overlaps(&p.shape_b.bounds(&p.pose_b, 0.0))));
//! assert_eq!(pairs2(PlaneKind::Poly8, PairSet::Rest, 10, 1).len(), 10);
//! // Frame by frame, for a kernel that remembers.
//! let slide = frames3(SolidKind::Box, PairSet::Slide, 120, 1);
//! assert_eq!((slide.len(), slide[0].len()), (FRAMES, 2));
//! ```

mod apart;
mod plane;
mod shapes;
mod volume;

pub use plane::pairs2;
pub use shapes::{polygons, solids};
pub use volume::{frames3, pairs3};

pub(crate) use plane::pose as pose2;
pub(crate) use shapes::{cuboid, prism, rect};
pub(crate) use volume::pose as pose3;

use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};

/// Length of the sequences of [`PairSet::Slide`] and [`PairSet::Tumble`], in frames of 1/60 s.
pub const FRAMES: usize = 60;

/// How many different shapes a set draws from: few, as in a game. The clones share their data.
const DISTINCT: usize = 16;

/// Two posed shapes in space.
///
/// ```
/// use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind, pairs3};
/// let pair: PosedPair3 = pairs3(SolidKind::Box, PairSet::Far, 1, 1).remove(0);
/// assert!((pair.pose_a.position() - pair.pose_b.position()).length() > 2.0);
/// ```
#[derive(Clone, Debug)]
pub struct PosedPair3 {
    /// The first shape.
    pub shape_a: Shape3,
    /// Where the first shape is.
    pub pose_a: Pose3,
    /// The second shape.
    pub shape_b: Shape3,
    /// Where the second shape is.
    pub pose_b: Pose3,
}

/// Two posed shapes in the plane.
///
/// ```
/// use asunder_scenes::pairs::{PairSet, PlaneKind, PosedPair2, pairs2};
/// let pair: PosedPair2 = pairs2(PlaneKind::Rect, PairSet::Deep, 1, 1).remove(0);
/// assert!((pair.pose_a.position() - pair.pose_b.position()).length() < 0.5);
/// ```
#[derive(Clone, Debug)]
pub struct PosedPair2 {
    /// The first shape.
    pub shape_a: Shape2,
    /// Where the first shape is.
    pub pose_a: Pose2,
    /// The second shape.
    pub shape_b: Shape2,
    /// Where the second shape is.
    pub pose_b: Pose2,
}

/// Families of solids, all about 1 m wide.
///
/// ```
/// use asunder_scenes::pairs::SolidKind;
/// assert_eq!(SolidKind::by_name("hull32"), Some(SolidKind::Hull32));
/// let mut all = SolidKind::ALL.iter().chain(&SolidKind::GROWTH);
/// assert!(all.all(|&kind| SolidKind::by_name(kind.name()) == Some(kind)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SolidKind {
    /// Cuboids.
    Box,
    /// As level designers model them: wedges and cylinders of twelve sides, as hulls.
    Authored,
    /// Hulls of 8 random points on an ellipsoid.
    Hull8,
    /// Hulls of 16 random points on an ellipsoid.
    Hull16,
    /// Hulls of 32 random points on an ellipsoid.
    Hull32,
    /// Hulls of 128 random points on an ellipsoid.
    Hull128,
    /// Hulls of 64 random points on an ellipsoid.
    Hull64,
    /// Hulls of 256 random points on an ellipsoid, the most that a hull may have.
    Hull256,
    /// Cylinders of 128 sides, as hulls: two faces of 128 corners, and all other edges in bundles of parallel ones.
    Prism256,
    /// Globes of 16 circles of latitude with 16 corners each: every edge has parallel edges, and every corner an
    /// opposite corner.
    Globe256,
}

impl SolidKind {
    /// The families that every benchmark uses, in the order in which results are listed.
    pub const ALL: [Self; 6] =
        [Self::Box, Self::Authored, Self::Hull8, Self::Hull16, Self::Hull32, Self::Hull128];

    /// The families that show how cost grows with the number of vertices, in the same order.
    pub const GROWTH: [Self; 5] =
        [Self::Hull64, Self::Hull128, Self::Hull256, Self::Prism256, Self::Globe256];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Authored => "authored",
            Self::Hull8 => "hull8",
            Self::Hull16 => "hull16",
            Self::Hull32 => "hull32",
            Self::Hull128 => "hull128",
            Self::Hull64 => "hull64",
            Self::Hull256 => "hull256",
            Self::Prism256 => "prism256",
            Self::Globe256 => "globe256",
        }
    }

    /// The family of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().chain(Self::GROWTH).find(|kind| kind.name() == name)
    }
}

/// Families of shapes in the plane, all about 1 m wide.
///
/// ```
/// use asunder_scenes::pairs::PlaneKind;
/// assert_eq!(PlaneKind::by_name("poly64"), Some(PlaneKind::Poly64));
/// assert!(PlaneKind::ALL.iter().all(|&kind| PlaneKind::by_name(kind.name()) == Some(kind)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlaneKind {
    /// Rectangles.
    Rect,
    /// Polygons of 8 random points on an ellipse.
    Poly8,
    /// Polygons of 64 random points on an ellipse.
    Poly64,
    /// Polygons of 4096 points around an ellipse, without those that rounding puts inside.
    Poly4096,
}

impl PlaneKind {
    /// Every family, in the order in which results are listed.
    pub const ALL: [Self; 4] = [Self::Rect, Self::Poly8, Self::Poly64, Self::Poly4096];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rect => "rect",
            Self::Poly8 => "poly8",
            Self::Poly64 => "poly64",
            Self::Poly4096 => "poly4096",
        }
    }

    /// The family of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// How the two shapes of a pair are placed. "Size" is the sum of the two bounding radii.
///
/// ```
/// use asunder_scenes::pairs::PairSet;
/// assert_eq!(PairSet::by_name("rest"), Some(PairSet::Rest));
/// assert!(PairSet::ALL.iter().all(|&set| PairSet::by_name(set.name()) == Some(set)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PairSet {
    /// As a broad phase finds them: the AABBs overlap, and two pairs of five are apart.
    Mixed,
    /// Face on face, with an overlap of 1e-4 to 1e-3 of size.
    Rest,
    /// As rest, and B slides across A's face in [`FRAMES`] frames.
    Slide,
    /// B rotates by one to three degrees a frame, at a distance at which it just may touch A.
    Tumble,
    /// Four to ten metres between the centres.
    Far,
    /// A vertex of B within 1e-3 of size of a face of A, inside or outside.
    Touch,
    /// The centres nearly coincide.
    Deep,
    /// The same shape twice in the same pose: every axis is as good as its opposite.
    Same,
    /// The same shape twice about the same centre, in different rotations.
    Turned,
}

impl PairSet {
    /// Every set, in the order in which results are listed.
    pub const ALL: [Self; 9] = [
        Self::Mixed,
        Self::Rest,
        Self::Slide,
        Self::Tumble,
        Self::Far,
        Self::Touch,
        Self::Deep,
        Self::Same,
        Self::Turned,
    ];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mixed => "mixed",
            Self::Rest => "rest",
            Self::Slide => "slide",
            Self::Tumble => "tumble",
            Self::Far => "far",
            Self::Touch => "touch",
            Self::Deep => "deep",
            Self::Same => "same",
            Self::Turned => "turned",
        }
    }

    /// The set of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|set| set.name() == name)
    }

    /// Whether the set consists of sequences of frames.
    pub const fn is_sequence(self) -> bool {
        matches!(self, Self::Slide | Self::Tumble)
    }
}
