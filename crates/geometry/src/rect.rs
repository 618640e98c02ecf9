//! Rectangles.

use crate::aabb::Aabb2;
use crate::extent::{ExtentError, bounding_radius};
use crate::outward::{interval, lost, round_down};
use crate::pose2::Pose2;
use crate::radius::{RadiusError, check_rounding, grown};
use glam::{DVec2, Vec2};

/// A rectangle about its own origin, given by its half extents in metres.
///
#[doc = include_str!("../doc/rect.svg")]
///
/// Its vertices are numbered counter-clockwise from the least corner; edge `i` runs from vertex `i` to the next.
///
/// # Costs and limits
/// Four normals; two contact points at most. Half extents above zero, bounding radius 1e-6 to 1e6 m.
///
/// ```
/// use asunder::{Pose2, Rect, glam::Vec2};
/// let rect = Rect::from_half_extents(Vec2::new(2.0, 1.0))?;
/// assert_eq!(rect.vertices()[2], Vec2::new(2.0, 1.0));
/// assert!(rect.bounds(&Pose2::IDENTITY, 0.5).contains(Vec2::new(2.5, -1.5)));
/// # Ok::<(), asunder::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    half_extents: Vec2,
    core_radius: f32,
    radius: f32,
}

impl Rect {
    /// Outward unit normals of the four edges, edge `i` running from vertex `i` to the next.
    pub const NORMALS: [DVec2; 4] = [DVec2::NEG_Y, DVec2::X, DVec2::Y, DVec2::NEG_X];

    /// A rectangle from its half extents, in metres.
    ///
    /// # Errors
    /// A half extent that is not finite or not positive, and a bounding radius outside 1e-6 to 1e6 m.
    pub fn from_half_extents(half_extents: Vec2) -> Result<Self, ExtentError> {
        let core_radius = bounding_radius(&half_extents.to_array())?;
        Ok(Self { half_extents, core_radius, radius: 0.0 })
    }

    /// The same rectangle expanded by `radius` metres on every side, with round corners. Zero removes the rounding.
    ///
    /// ```
    /// use asunder::{Rect, glam::{DVec2, Vec2}};
    /// let rounded = Rect::from_half_extents(Vec2::ONE)?.rounded(0.5)?;
    /// assert!(rounded.contains(DVec2::new(1.5, 0.0)) && !rounded.contains(DVec2::new(1.4, 1.4)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A radius that is negative or not finite, or with which the shape would reach further than 1e6 m.
    pub fn rounded(self, radius: f32) -> Result<Self, RadiusError> {
        check_rounding(radius, f64::from(self.core_radius))?;
        Ok(Self { radius, ..self })
    }

    /// Radius of the rounding, in metres; zero for sharp corners.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Half of the width and height, in metres, without the rounding.
    ///
    /// ```
    /// use asunder::{Rect, glam::Vec2};
    /// let half = Vec2::new(1.0, 2.0);
    /// assert_eq!(Rect::from_half_extents(half)?.rounded(0.5)?.half_extents(), half);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub const fn half_extents(&self) -> Vec2 {
        self.half_extents
    }

    /// The four corners, counter-clockwise from the least; of a rounded rectangle, those of its core.
    #[inline]
    pub fn vertices(&self) -> [Vec2; 4] {
        let h = self.half_extents;
        [-h, Vec2::new(h.x, -h.y), h, Vec2::new(-h.x, h.y)]
    }

    /// Radius of the bounding circle about the origin, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.core_radius, self.radius)
    }

    /// Radius of the inscribed circle about the origin, in metres, rounded down.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        round_down(f64::from(self.half_extents.x.min(self.half_extents.y)) + f64::from(self.radius))
    }

    /// Whether the closed shape contains a local point, in metres. Exact where there is no rounding.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        self.contains_within(point.into(), self.radius.into())
    }

    /// The same with another radius, in metres, about the same core.
    pub(crate) fn contains_within(&self, point: DVec2, radius: f64) -> bool {
        // `max` of NaN and zero is zero.
        let beyond = (point.abs() - self.half_extents.as_dvec2()).max(DVec2::ZERO);
        !point.is_nan() && beyond.length_squared() <= radius * radius
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let h = self.half_extents.as_dvec2();
        let (c, s) = (f64::from(pose.rotation().cos()).abs(), f64::from(pose.rotation().sin()).abs());
        let reach = DVec2::new(c * h.x + s * h.y, s * h.x + c * h.y);
        let p = pose.position();
        let grow = f64::from(margin) + f64::from(self.radius);
        let lost = lost(p.abs().element_sum(), reach.element_sum(), grow);
        let x = interval(p.x, -reach.x, reach.x, grow, lost);
        let y = interval(p.y, -reach.y, reach.y, grow, lost);
        Aabb2::new(Vec2::new(x.0, y.0), Vec2::new(x.1, y.1))
    }
}
