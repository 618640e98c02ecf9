//! Rectangles.

use crate::aabb::Aabb2;
use crate::extent::{ExtentError, bounding_radius};
use crate::outward::interval;
use crate::pose2::Pose2;
use glam::{DVec2, Vec2};

/// A rectangle about its own origin, given by its half extents in metres.
///
/// Its vertices are numbered counter-clockwise from the least corner; edge `i` runs from vertex `i` to the next.
///
/// ```
/// use asunder_geometry::{Pose2, Rect, glam::Vec2};
/// let rect = Rect::from_half_extents(Vec2::new(2.0, 1.0))?;
/// assert_eq!(rect.vertices()[2], Vec2::new(2.0, 1.0));
/// assert!(rect.bounds(&Pose2::IDENTITY, 0.5).contains(Vec2::new(2.5, -1.5)));
/// # Ok::<(), asunder_geometry::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    half_extents: Vec2,
    outer_radius: f32,
}

impl Rect {
    /// Outward unit normals of the four edges, edge `i` running from vertex `i` to the next.
    pub const NORMALS: [DVec2; 4] = [DVec2::NEG_Y, DVec2::X, DVec2::Y, DVec2::NEG_X];

    /// A rectangle from its half extents, in metres.
    ///
    /// # Errors
    /// A half extent that is not finite or not positive, and a bounding radius outside 1e-6 to 1e6 m.
    pub fn from_half_extents(half_extents: Vec2) -> Result<Self, ExtentError> {
        let outer_radius = bounding_radius(&half_extents.to_array())?;
        Ok(Self { half_extents, outer_radius })
    }

    /// Half of the width and height, in metres.
    #[inline]
    pub const fn half_extents(&self) -> Vec2 {
        self.half_extents
    }

    /// The four corners, counter-clockwise from the least.
    #[inline]
    pub fn vertices(&self) -> [Vec2; 4] {
        let h = self.half_extents;
        [-h, Vec2::new(h.x, -h.y), h, Vec2::new(-h.x, h.y)]
    }

    /// Radius of the bounding circle about the origin, in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Radius of the inscribed circle about the origin, in metres.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        self.half_extents.x.min(self.half_extents.y)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let h = self.half_extents.as_dvec2();
        let (c, s) = (f64::from(pose.rotation().cos()).abs(), f64::from(pose.rotation().sin()).abs());
        let reach = DVec2::new(c * h.x + s * h.y, s * h.x + c * h.y);
        let p = pose.position();
        let x = interval(p.x, -reach.x, reach.x, f64::from(margin));
        let y = interval(p.y, -reach.y, reach.y, f64::from(margin));
        Aabb2::new(Vec2::new(x.0, y.0), Vec2::new(x.1, y.1))
    }
}
