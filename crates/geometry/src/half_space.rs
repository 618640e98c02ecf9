//! Half-planes and half-spaces: everything on one side of a line or plane through the origin.

use crate::aabb::{Aabb2, Aabb3};
use crate::direction::{DirectionError, check_direction};
use crate::outward::{interval, lost};
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// Everything on one side of a line through its own origin: an infinite floor.
///
#[doc = include_str!("../doc/half_plane.svg")]
///
/// It is the set of all x with n.x <= 0 for the stored outward normal n, whose length has no meaning. The body's pose
/// puts it in place. It has no centre, no size and no mass; tolerances of a pair with it are relative to the other
/// shape. Two of them always overlap, without contact points, unless their normals are exactly opposite.
///
/// # Costs and limits
/// The cheapest floor: one dot product for each vertex of the other shape. Unless its normal is along an axis, its box
/// is infinite, so that every other body is a candidate for a pair with it. Its contact anchors are relative to its
/// position, in f32 like all: 10 km from there they are off by a millimetre, on its side of a contact only.
///
/// ```
/// use asunder::{HalfPlane, Pose2, glam::{DVec2, Vec2}};
/// let floor = HalfPlane::new(Vec2::Y * 2.0)?;
/// assert!(floor.contains(DVec2::X * 1e9) && !floor.contains(DVec2::Y * 1e-300));
/// assert_eq!(floor.unit_normal(), DVec2::Y);
/// let bounds = floor.bounds(&Pose2::IDENTITY, 0.5);
/// assert_eq!((bounds.min.y, bounds.max.x), (f32::NEG_INFINITY, f32::INFINITY));
/// assert!((bounds.max.y - 0.5).abs() < 1e-6, "it ends where its normal is an axis");
/// # Ok::<(), asunder::DirectionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfPlane {
    normal: Vec2,
}

impl HalfPlane {
    /// A half-plane from its outward normal, of any length but zero.
    ///
    /// # Errors
    /// A normal that is not finite, or zero.
    pub fn new(normal: Vec2) -> Result<Self, DirectionError> {
        check_direction(&normal.to_array())?;
        Ok(Self { normal })
    }

    /// The outward normal, bit for bit as given.
    #[inline]
    pub const fn normal(&self) -> Vec2 {
        self.normal
    }

    /// The outward unit normal, in f64.
    #[inline]
    pub fn unit_normal(&self) -> DVec2 {
        self.normal.as_dvec2().normalize()
    }

    /// Whether the closed shape contains a local point, in metres; false for NaN.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        self.normal.as_dvec2().dot(point.into()) <= 0.0
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. It is infinite, except where the
    /// turned normal is along an axis.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let normal = pose.rotation().turn(self.normal.as_dvec2());
        let p = pose.position();
        let side = |axis: usize, position: f64| {
            let lost = lost(p.abs().element_sum(), 0.0, f64::from(margin));
            let (low, high) = interval(position, 0.0, 0.0, f64::from(margin), lost);
            let is_axis = normal[axis] != 0.0 && (0..2).all(|other| other == axis || normal[other] == 0.0);
            match is_axis {
                true if normal[axis] > 0.0 => (f32::NEG_INFINITY, high),
                true => (low, f32::INFINITY),
                false => (f32::NEG_INFINITY, f32::INFINITY),
            }
        };
        let x = side(0, p.x);
        let y = side(1, p.y);
        Aabb2::new(Vec2::new(x.0, y.0), Vec2::new(x.1, y.1))
    }
}

/// Everything on one side of a plane through its own origin: an infinite floor.
///
#[doc = include_str!("../doc/half_space.svg")]
///
/// It is the set of all x with n.x <= 0 for the stored outward normal n, whose length has no meaning. The body's pose
/// puts it in place. It has no centre, no size and no mass; tolerances of a pair with it are relative to the other
/// shape. Two of them always overlap, without contact points, unless their normals are exactly opposite.
///
/// # Costs and limits
/// The cheapest floor: one dot product for each vertex of the other shape. Unless its normal is along an axis, its box
/// is infinite, so that every other body is a candidate for a pair with it. Its contact anchors are relative to its
/// position, in f32 like all: 10 km from there they are off by a millimetre, on its side of a contact only.
///
/// ```
/// use asunder::{HalfSpace, Pose3, glam::{DVec3, Vec3}};
/// let floor = HalfSpace::new(Vec3::Y * 2.0)?;
/// assert!(floor.contains(DVec3::X * 1e9) && !floor.contains(DVec3::Y * 1e-300));
/// assert_eq!(floor.unit_normal(), DVec3::Y);
/// let bounds = floor.bounds(&Pose3::IDENTITY, 0.5);
/// assert_eq!((bounds.min.y, bounds.max.x), (f32::NEG_INFINITY, f32::INFINITY));
/// assert!((bounds.max.y - 0.5).abs() < 1e-6, "it ends where its normal is an axis");
/// # Ok::<(), asunder::DirectionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    normal: Vec3,
}

impl HalfSpace {
    /// A half-space from its outward normal, of any length but zero.
    ///
    /// # Errors
    /// A normal that is not finite, or zero.
    pub fn new(normal: Vec3) -> Result<Self, DirectionError> {
        check_direction(&normal.to_array())?;
        Ok(Self { normal })
    }

    /// The outward normal, bit for bit as given.
    #[inline]
    pub const fn normal(&self) -> Vec3 {
        self.normal
    }

    /// The outward unit normal, in f64.
    #[inline]
    pub fn unit_normal(&self) -> DVec3 {
        self.normal.as_dvec3().normalize()
    }

    /// Whether the closed shape contains a local point, in metres; false for NaN.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        self.normal.as_dvec3().dot(point.into()) <= 0.0
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. It is infinite, except where the
    /// turned normal is along an axis.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let normal = pose.basis().turn(self.normal.as_dvec3());
        let p = pose.position();
        let side = |axis: usize, position: f64| {
            let lost = lost(p.abs().element_sum(), 0.0, f64::from(margin));
            let (low, high) = interval(position, 0.0, 0.0, f64::from(margin), lost);
            let is_axis = normal[axis] != 0.0 && (0..3).all(|other| other == axis || normal[other] == 0.0);
            match is_axis {
                true if normal[axis] > 0.0 => (f32::NEG_INFINITY, high),
                true => (low, f32::INFINITY),
                false => (f32::NEG_INFINITY, f32::INFINITY),
            }
        };
        let x = side(0, p.x);
        let y = side(1, p.y);
        let z = side(2, p.z);
        Aabb3::new(Vec3::new(x.0, y.0, z.0), Vec3::new(x.1, y.1, z.1))
    }
}
