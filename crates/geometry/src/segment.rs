//! Segments, and capsules, which are segments expanded by a radius.

use crate::aabb::{Aabb2, Aabb3};
use crate::outward::{around2, around3, round_up};
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use crate::radius::{RadiusError, check_round, grown};
use crate::vertex::{VertexError, check_size, check_vertices};
use glam::{DVec2, DVec3, Vec2, Vec3};
use robust::{Coord, orient2d};

/// A segment between two points in the plane, in metres. It has no thickness, and edge 0 is all of it.
///
#[doc = include_str!("../doc/segment2.svg")]
///
/// # Costs and limits
/// It overlaps shapes that it crosses; the depth is the way out to one of its two sides, which is zero for two segments
/// that merely cross. Two normals. Length from 2e-6 m, both ends within 1e6 m of the shape's origin.
///
/// ```
/// use asunder::{Segment2, glam::{DVec2, Vec2}};
/// let segment = Segment2::new(Vec2::ZERO, Vec2::X)?;
/// assert!(segment.contains(DVec2::X * 0.5) && !segment.contains(DVec2::Y));
/// # Ok::<(), asunder::VertexError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment2 {
    ends: [Vec2; 2],
    outer_radius: f32,
}

/// A capsule in the plane: everything within `radius` metres of a segment.
///
#[doc = include_str!("../doc/capsule2.svg")]
///
/// # Costs and limits
/// Like a segment, it has two normals. If it lies on an edge it has two contact points. Radius from 1e-6 m; all of it
/// within 1e6 m of the shape's origin.
///
/// ```
/// use asunder::{Capsule2, glam::{DVec2, Vec2}};
/// let upright = Capsule2::from_half_height(0.6, 0.3)?;
/// assert!(upright.contains(DVec2::Y * 0.9) && !upright.contains(DVec2::X * 0.31));
/// assert_eq!(upright, Capsule2::new(Vec2::Y * -0.6, Vec2::Y * 0.6, 0.3)?);
/// # Ok::<(), asunder::CapsuleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule2 {
    segment: Segment2,
    radius: f32,
}

impl Segment2 {
    /// A segment from its ends, in metres.
    ///
    /// # Errors
    /// Ends that are equal, not finite, or out of range.
    pub fn new(from: Vec2, to: Vec2) -> Result<Self, VertexError> {
        check_vertices(&[from.as_dvec2().extend(0.0), to.as_dvec2().extend(0.0)])?;
        let segment = Self::between([from, to]);
        check_size(segment.outer_radius)?;
        Ok(segment)
    }

    /// A segment whose ends were checked.
    pub(crate) fn between(ends: [Vec2; 2]) -> Self {
        let mut segment = Self { ends, outer_radius: 0.0 };
        let center = segment.center().as_dvec2();
        let reach = ends.map(|end| (end.as_dvec2() - center).length());
        segment.outer_radius = round_up(reach[0].max(reach[1]) * (1.0 + 8.0 * f64::EPSILON));
        segment
    }

    /// Both ends.
    #[inline]
    pub const fn ends(&self) -> [Vec2; 2] {
        self.ends
    }

    /// The centre of the bounding radius: the middle, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec2 {
        let [from, to] = self.ends.map(|end| end.as_dvec2());
        ((from + to) * 0.5).as_vec2()
    }

    /// Bounding radius about [`Segment2::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether a local point, in metres, lies on the segment. Exact.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        let (point, [from, to]) = (point.into(), self.ends.map(|end| end.as_dvec2()));
        let between = from.min(to).cmple(point).all() && point.cmple(from.max(to)).all();
        between && point.on_line(from, to)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        around2(self.ends.iter().map(|end| end.as_dvec2()), pose, f64::from(margin))
    }
}

impl Capsule2 {
    /// A capsule from the ends of its segment and its radius, in metres.
    ///
    /// # Errors
    /// Ends that are equal, not finite, or out of range; a radius that is not finite or outside 1e-6 to 1e6 m.
    pub fn new(from: Vec2, to: Vec2, radius: f32) -> Result<Self, CapsuleError> {
        let segment = Segment2::new(from, to)?;
        check_round(radius, segment.ends.map(|end| end.as_dvec2().length()).into_iter().fold(0.0, f64::max))?;
        Ok(Self { segment, radius })
    }

    /// A capsule that stands upright along y, about its own origin. Its segment has twice the `half_height`.
    ///
    /// # Errors
    /// As [`Capsule2::new`], and a negative half height.
    pub fn from_half_height(half_height: f32, radius: f32) -> Result<Self, CapsuleError> {
        if half_height < 0.0 {
            return Err(CapsuleError::HalfHeight { value: half_height });
        }
        Self::new(Vec2::Y * -half_height, Vec2::Y * half_height, radius)
    }

    /// The segment inside.
    #[inline]
    pub const fn segment(&self) -> &Segment2 {
        &self.segment
    }

    /// The radius, in metres.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Bounding radius about the segment's centre, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.segment.outer_radius, self.radius)
    }

    /// Whether the closed shape contains a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        self.contains_within(point.into(), self.radius.into())
    }

    /// The same with another radius, in metres, about the same core.
    pub(crate) fn contains_within(&self, point: DVec2, radius: f64) -> bool {
        let [from, to] = self.segment.ends.map(|end| end.as_dvec2());
        let along = to - from;
        let place = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (point - from - along * place).length_squared() <= radius * radius
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let ends = self.segment.ends.iter().map(|end| end.as_dvec2());
        around2(ends, pose, f64::from(margin) + f64::from(self.radius))
    }
}

/// A segment between two points in space, in metres. It has no thickness, and edge 0 is all of it.
///
#[doc = include_str!("../doc/segment3.svg")]
///
/// # Costs and limits
/// Two segments, or a segment and a capsule, are a closed form; against faces, a segment is one more edge in the test.
/// Two segments that cross have depth zero. Length from 2e-6 m, both ends within 1e6 m of the shape's origin.
///
/// ```
/// use asunder::{Segment3, glam::{DVec3, Vec3}};
/// let segment = Segment3::new(Vec3::ZERO, Vec3::X)?;
/// assert!(segment.contains(DVec3::X * 0.5) && !segment.contains(DVec3::Y));
/// # Ok::<(), asunder::VertexError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment3 {
    ends: [Vec3; 2],
    outer_radius: f32,
}

/// A capsule in space: everything within `radius` metres of a segment.
///
#[doc = include_str!("../doc/capsule3.svg")]
///
/// # Costs and limits
/// Two capsules are a closed form; a capsule against a hull of n edges takes n arc tests. Lying on a face, or along
/// another capsule, it has two contact points. Radius from 1e-6 m; all of it within 1e6 m of the shape's origin.
///
/// ```
/// use asunder::{Capsule3, glam::{DVec3, Vec3}};
/// let upright = Capsule3::from_half_height(0.6, 0.3)?;
/// assert!(upright.contains(DVec3::Y * 0.9) && !upright.contains(DVec3::X * 0.31));
/// assert_eq!(upright, Capsule3::new(Vec3::Y * -0.6, Vec3::Y * 0.6, 0.3)?);
/// # Ok::<(), asunder::CapsuleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule3 {
    segment: Segment3,
    radius: f32,
}

impl Segment3 {
    /// A segment from its ends, in metres.
    ///
    /// # Errors
    /// Ends that are equal, not finite, or out of range.
    pub fn new(from: Vec3, to: Vec3) -> Result<Self, VertexError> {
        check_vertices(&[from.as_dvec3(), to.as_dvec3()])?;
        let mut segment = Self { ends: [from, to], outer_radius: 0.0 };
        let center = segment.center().as_dvec3();
        let reach = segment.ends.map(|end| (end.as_dvec3() - center).length());
        segment.outer_radius = round_up(reach[0].max(reach[1]) * (1.0 + 8.0 * f64::EPSILON));
        check_size(segment.outer_radius)?;
        Ok(segment)
    }

    /// Both ends.
    #[inline]
    pub const fn ends(&self) -> [Vec3; 2] {
        self.ends
    }

    /// The centre of the bounding radius: the middle, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec3 {
        let [from, to] = self.ends.map(|end| end.as_dvec3());
        ((from + to) * 0.5).as_vec3()
    }

    /// Bounding radius about [`Segment3::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether a local point, in metres, lies on the segment. Exact.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let (point, [from, to]) = (point.into(), self.ends.map(|end| end.as_dvec3()));
        let between = from.min(to).cmple(point).all() && point.cmple(from.max(to)).all();
        between && point.on_line(from, to)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        around3(self.ends.iter().map(|end| end.as_dvec3()), pose, f64::from(margin))
    }
}

impl Capsule3 {
    /// A capsule from the ends of its segment and its radius, in metres.
    ///
    /// # Errors
    /// Ends that are equal, not finite, or out of range; a radius that is not finite or outside 1e-6 to 1e6 m.
    pub fn new(from: Vec3, to: Vec3, radius: f32) -> Result<Self, CapsuleError> {
        let segment = Segment3::new(from, to)?;
        check_round(radius, segment.ends.map(|end| end.as_dvec3().length()).into_iter().fold(0.0, f64::max))?;
        Ok(Self { segment, radius })
    }

    /// A capsule that stands upright along y, about its own origin. Its segment has twice the `half_height`.
    ///
    /// # Errors
    /// As [`Capsule3::new`], and a negative half height.
    pub fn from_half_height(half_height: f32, radius: f32) -> Result<Self, CapsuleError> {
        if half_height < 0.0 {
            return Err(CapsuleError::HalfHeight { value: half_height });
        }
        Self::new(Vec3::Y * -half_height, Vec3::Y * half_height, radius)
    }

    /// The segment inside.
    #[inline]
    pub const fn segment(&self) -> &Segment3 {
        &self.segment
    }

    /// The radius, in metres.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Bounding radius about the segment's centre, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.segment.outer_radius, self.radius)
    }

    /// Whether the closed shape contains a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let (point, [from, to]) = (point.into(), self.segment.ends.map(|end| end.as_dvec3()));
        let along = to - from;
        let place = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (point - from - along * place).length_squared() <= f64::from(self.radius) * f64::from(self.radius)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let ends = self.segment.ends.iter().map(|end| end.as_dvec3());
        around3(ends, pose, f64::from(margin) + f64::from(self.radius))
    }
}

/// Why a capsule was rejected.
///
/// ```
/// use asunder::{Capsule3, CapsuleError, RadiusError, VertexError};
/// assert_eq!(Capsule3::from_half_height(0.5, -1.0), Err(CapsuleError::Radius(RadiusError::Negative { value: -1.0 })));
/// let point = Capsule3::from_half_height(0.0, 1.0);
/// assert_eq!(point, Err(CapsuleError::Ends(VertexError::Repeated { first: 0, second: 1 })));
/// assert!(point.unwrap_err().to_string().contains("circle or sphere"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CapsuleError {
    /// A half height below zero.
    HalfHeight {
        /// The given value, in metres.
        value: f32,
    },
    /// Its segment is invalid.
    Ends(VertexError),
    /// Its radius is invalid.
    Radius(RadiusError),
}

impl core::fmt::Display for CapsuleError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::HalfHeight { value } => {
                write!(f, "half height {value} m is negative: give half of the segment's length")
            }
            Self::Ends(VertexError::Repeated { .. }) => {
                write!(f, "both ends are the same point: use a circle or sphere")
            }
            Self::Ends(error) => error.fmt(f),
            Self::Radius(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for CapsuleError {}

impl From<VertexError> for CapsuleError {
    fn from(error: VertexError) -> Self {
        Self::Ends(error)
    }
}

impl From<RadiusError> for CapsuleError {
    fn from(error: RadiusError) -> Self {
        Self::Radius(error)
    }
}

/// Whether a point lies on the line through two others, exactly: in every projection.
trait OnLine {
    fn on_line(self, from: Self, to: Self) -> bool;
}

impl OnLine for DVec2 {
    fn on_line(self, from: Self, to: Self) -> bool {
        let coord = |v: DVec2| Coord { x: v.x, y: v.y };
        orient2d(coord(from), coord(to), coord(self)) == 0.0
    }
}

impl OnLine for DVec3 {
    fn on_line(self, from: Self, to: Self) -> bool {
        let flat = |drop: fn(DVec3) -> DVec2| drop(self).on_line(drop(from), drop(to));
        flat(|v| DVec2::new(v.x, v.y)) && flat(|v| DVec2::new(v.y, v.z)) && flat(|v| DVec2::new(v.z, v.x))
    }
}
