//! Cuboids.

use crate::aabb::Aabb3;
use crate::extent::{ExtentError, bounding_radius};
use crate::outward::interval;
use crate::pose3::Pose3;
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::sync::LazyLock;

/// A rectangular box about its own origin, given by its half extents in metres.
///
/// Vertex `i` lies on the positive side of x, y, z where bits 0, 1, 2 of `i` are set. Faces are numbered
/// -x, +x, -y, +y, -z, +z.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, glam::Vec3};
/// let cuboid = Cuboid::from_half_extents(Vec3::new(1.0, 2.0, 3.0))?;
/// assert_eq!(cuboid.vertices()[0b101], Vec3::new(1.0, -2.0, 3.0));
/// assert!(cuboid.bounds(&Pose3::IDENTITY, 0.0).contains(Vec3::new(1.0, 2.0, 3.0)));
/// # Ok::<(), asunder_geometry::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    half_extents: Vec3,
    outer_radius: f32,
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
        let outer_radius = bounding_radius(&half_extents.to_array())?;
        Ok(Self { half_extents, outer_radius })
    }

    /// Half of the size on each axis, in metres.
    #[inline]
    pub const fn half_extents(&self) -> Vec3 {
        self.half_extents
    }

    /// The eight corners.
    #[inline]
    pub fn vertices(&self) -> [Vec3; 8] {
        let h = self.half_extents;
        core::array::from_fn(|i| {
            let side = |bit: usize, extent: f32| if i >> bit & 1 == 1 { extent } else { -extent };
            Vec3::new(side(0, h.x), side(1, h.y), side(2, h.z))
        })
    }

    /// The half-edges that every cuboid shares.
    #[inline]
    pub fn topology() -> &'static Topology {
        &TOPOLOGY
    }

    /// Radius of the bounding sphere about the origin, in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Radius of the inscribed sphere about the origin, in metres.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        self.half_extents.min_element()
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let h = self.half_extents.as_dvec3();
        let basis = pose.basis();
        let reach = basis.x.abs() * h.x + basis.y.abs() * h.y + basis.z.abs() * h.z;
        let p = pose.position();
        let x = interval(p.x, -reach.x, reach.x, f64::from(margin));
        let y = interval(p.y, -reach.y, reach.y, f64::from(margin));
        let z = interval(p.z, -reach.z, reach.z, f64::from(margin));
        Aabb3::new(Vec3::new(x.0, y.0, z.0), Vec3::new(x.1, y.1, z.1))
    }
}
