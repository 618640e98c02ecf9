//! Cuboids.

use crate::aabb::Aabb3;
use crate::extent::{ExtentError, bounding_radius};
use crate::outward::{interval, lost, round_down};
use crate::pose3::Pose3;
use crate::radius::{RadiusError, check_rounding, grown};
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::sync::LazyLock;

/// A rectangular box about its own origin, given by its half extents in metres.
///
#[doc = include_str!("../doc/cuboid.svg")]
///
/// Vertex `i` lies on the positive side of x, y, z where bits 0, 1, 2 of `i` are set. Faces are numbered
/// -x, +x, -y, +y, -z, +z.
///
/// # Costs and limits
/// Two cuboids take fifteen axes in closed form; a contact has up to four points. Half extents above zero, however
/// thin, and a bounding radius of 1e-6 to 1e6 m.
///
/// ```
/// use asunder::{Cuboid, Pose3, glam::Vec3};
/// let cuboid = Cuboid::from_half_extents(Vec3::new(1.0, 2.0, 3.0))?;
/// assert_eq!(cuboid.vertices()[0b101], Vec3::new(1.0, -2.0, 3.0));
/// assert!(cuboid.bounds(&Pose3::IDENTITY, 0.0).contains(Vec3::new(1.0, 2.0, 3.0)));
/// # Ok::<(), asunder::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    half_extents: Vec3,
    core_radius: f32,
    radius: f32,
}

static TOPOLOGY: LazyLock<Topology> = LazyLock::new(|| {
    let loops: [[u16; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    Topology::from_loops(loops.iter().map(|vertices| vertices.as_slice()))
});

impl Cuboid {
    /// Outward unit normals of the six faces.
    pub const NORMALS: [DVec3; 6] = [DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y, DVec3::NEG_Z, DVec3::Z];

    /// A cuboid from its half extents, in metres.
    ///
    /// # Errors
    /// A half extent that is not finite or not positive, and a bounding radius outside 1e-6 to 1e6 m.
    pub fn from_half_extents(half_extents: Vec3) -> Result<Self, ExtentError> {
        let core_radius = bounding_radius(&half_extents.to_array())?;
        Ok(Self { half_extents, core_radius, radius: 0.0 })
    }

    /// The same cuboid expanded by `radius` metres on every side, with round edges and corners. Zero removes the
    /// rounding.
    ///
    /// ```
    /// use asunder::{Cuboid, glam::{DVec3, Vec3}};
    /// let rounded = Cuboid::from_half_extents(Vec3::ONE)?.rounded(0.5)?;
    /// assert!(rounded.contains(DVec3::new(1.5, 0.0, 0.0)) && !rounded.contains(DVec3::new(1.4, 1.4, 0.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A radius that is negative or not finite, or with which the shape would reach further than 1e6 m.
    pub fn rounded(self, radius: f32) -> Result<Self, RadiusError> {
        check_rounding(radius, f64::from(self.core_radius))?;
        Ok(Self { radius, ..self })
    }

    /// Radius of the rounding, in metres; zero for sharp edges.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Half of the size on each axis, in metres, without the rounding.
    ///
    /// ```
    /// use asunder::{Cuboid, glam::Vec3};
    /// let half = Vec3::new(1.0, 2.0, 3.0);
    /// assert_eq!(Cuboid::from_half_extents(half)?.rounded(0.5)?.half_extents(), half);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub const fn half_extents(&self) -> Vec3 {
        self.half_extents
    }

    /// The eight corners; of a rounded cuboid, those of its core.
    #[inline]
    pub fn vertices(&self) -> [Vec3; 8] {
        // Written out, as kernels need them for every pair, and `from_fn` is a call.
        let Vec3 { x, y, z } = self.half_extents;
        [
            Vec3::new(-x, -y, -z),
            Vec3::new(x, -y, -z),
            Vec3::new(-x, y, -z),
            Vec3::new(x, y, -z),
            Vec3::new(-x, -y, z),
            Vec3::new(x, -y, z),
            Vec3::new(-x, y, z),
            Vec3::new(x, y, z),
        ]
    }

    /// The half-edges that every cuboid shares.
    #[inline]
    pub fn topology() -> &'static Topology {
        &TOPOLOGY
    }

    /// Radius of the bounding sphere about the origin, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.core_radius, self.radius)
    }

    /// Radius of the inscribed sphere about the origin, in metres, rounded down.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        round_down(f64::from(self.half_extents.min_element()) + f64::from(self.radius))
    }

    /// Whether the closed shape contains a local point, in metres. Exact where there is no rounding.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        // `max` of NaN and zero is zero.
        let beyond = (point.abs() - self.half_extents.as_dvec3()).max(DVec3::ZERO);
        !point.is_nan() && beyond.length_squared() <= f64::from(self.radius) * f64::from(self.radius)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let h = self.half_extents.as_dvec3();
        let basis = pose.basis();
        let reach = basis.x.abs() * h.x + basis.y.abs() * h.y + basis.z.abs() * h.z;
        let p = pose.position();
        let grow = f64::from(margin) + f64::from(self.radius);
        let lost = lost(p.abs().element_sum(), reach.element_sum(), grow);
        let x = interval(p.x, -reach.x, reach.x, grow, lost);
        let y = interval(p.y, -reach.y, reach.y, grow, lost);
        let z = interval(p.z, -reach.z, reach.z, grow, lost);
        Aabb3::new(Vec3::new(x.0, y.0, z.0), Vec3::new(x.1, y.1, z.1))
    }
}
