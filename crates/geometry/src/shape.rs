//! The closed sets of shapes a body can have, one a dimension.

use crate::aabb::{Aabb2, Aabb3};
use crate::cuboid::Cuboid;
use crate::hull::Hull;
use crate::polygon::Polygon;
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use crate::rect::Rect;
use glam::{Vec2, Vec3};

/// A convex shape in the plane. Cloning is cheap: large data is shared.
///
/// ```
/// use asunder_geometry::{Pose2, Rect, Shape2, glam::Vec2};
/// let shape = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
/// assert!(shape.outer_radius() >= 2_f32.sqrt());
/// assert!(shape.bounds(&Pose2::IDENTITY, 0.0).contains(Vec2::ONE));
/// # Ok::<(), asunder_geometry::ExtentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Shape2 {
    /// A rectangle.
    Rect(Rect),
    /// A convex polygon.
    Polygon(Polygon),
}

/// A convex shape in space. Cloning is cheap: large data is shared.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// let shape = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// assert!(shape.outer_radius() >= 3_f32.sqrt());
/// assert!(shape.bounds(&Pose3::IDENTITY, 0.0).contains(Vec3::ONE));
/// # Ok::<(), asunder_geometry::ExtentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Shape3 {
    /// A rectangular box.
    Cuboid(Cuboid),
    /// The convex hull of points.
    Hull(Hull),
}

impl Shape2 {
    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        match self {
            Self::Rect(rect) => rect.bounds(pose, margin),
            Self::Polygon(polygon) => polygon.bounds(pose, margin),
        }
    }

    /// Local centre of the bounding circle.
    pub fn center(&self) -> Vec2 {
        match self {
            Self::Rect(_) => Vec2::ZERO,
            Self::Polygon(polygon) => polygon.center(),
        }
    }

    /// Bounding radius about [`Shape2::center`], in metres, rounded up. Tolerances of a pair are relative to the sum of two.
    pub fn outer_radius(&self) -> f32 {
        match self {
            Self::Rect(rect) => rect.outer_radius(),
            Self::Polygon(polygon) => polygon.outer_radius(),
        }
    }
}

impl Shape3 {
    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        match self {
            Self::Cuboid(cuboid) => cuboid.bounds(pose, margin),
            Self::Hull(hull) => hull.bounds(pose, margin),
        }
    }

    /// Local centre of the bounding sphere.
    pub fn center(&self) -> Vec3 {
        match self {
            Self::Cuboid(_) => Vec3::ZERO,
            Self::Hull(hull) => hull.center(),
        }
    }

    /// Bounding radius about [`Shape3::center`], in metres, rounded up. Tolerances of a pair are relative to the sum of two.
    pub fn outer_radius(&self) -> f32 {
        match self {
            Self::Cuboid(cuboid) => cuboid.outer_radius(),
            Self::Hull(hull) => hull.outer_radius(),
        }
    }
}

impl From<Rect> for Shape2 {
    fn from(rect: Rect) -> Self {
        Self::Rect(rect)
    }
}

impl From<Polygon> for Shape2 {
    fn from(polygon: Polygon) -> Self {
        Self::Polygon(polygon)
    }
}

impl From<Cuboid> for Shape3 {
    fn from(cuboid: Cuboid) -> Self {
        Self::Cuboid(cuboid)
    }
}

impl From<Hull> for Shape3 {
    fn from(hull: Hull) -> Self {
        Self::Hull(hull)
    }
}
