//! Convex hulls of points in space.

mod build;
mod check;
mod cloud;
mod distance;
mod error;
mod flat;
mod loops;
mod merge;
pub(crate) mod normal;
mod predicate;
mod prism;
mod quick;
#[cfg(feature = "serde")]
mod restore;
mod simplify;
#[cfg(test)]
mod wrap;

pub use check::HullFault;
pub use error::HullError;

use crate::aabb::Aabb3;
use crate::octets::{EdgeArc, EdgeOctet, FaceOctet, Octets, VertexOctet};
use crate::outward::{around_octets, round_down, round_up};
use crate::pose3::Pose3;
use crate::radius::{RadiusError, check_rounding, grown};
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// The convex hull of points in space: up to 256 vertices in metres. Clones share the data.
///
/// The vertices are a subset of the points, bit for bit. Which points are vertices, and which facets bound them, is
/// decided exactly. Facets that differ from one plane by rounding only are then merged into one face;
/// [`Hull::planarity_error`] is how far such faces are from flat.
///
/// ```
/// use asunder::{Hull, glam::Vec3};
/// let mut points: Vec<Vec3> = (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
/// points.push(Vec3::splat(0.5));
/// let cube = Hull::from_points(&points)?;
/// assert_eq!((cube.vertices().len(), cube.topology().edges().len(), cube.topology().face_count()), (8, 12, 6));
/// assert_eq!(cube.error(), 0.0);
/// # Ok::<(), asunder::HullError>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct Hull {
    data: Arc<HullData>,
    radius: f32,
}

#[derive(PartialEq)]
struct HullData {
    dimension: u8,
    vertices: Box<[Vec3]>,
    topology: Topology,
    normals: Box<[DVec3]>,
    /// The exact surface in triangles: those of the facets before merging. `u8` is enough for 256 vertices.
    facets: Box<[[u8; 3]]>,
    octets: Octets,
    center: Vec3,
    outer_radius: f32,
    /// If rounding put the centre beside a hull without volume: minus its distance from the hull.
    inner_radius: f32,
    planarity_error: f32,
    error: f32,
}

impl Hull {
    /// The dimension of the points' span: 3 for space, 2 for a plane, 1 for a line, 0 for a point. Below 3 only from
    /// [`Hull::of_any_dimension`].
    ///
    /// A flat hull has two faces back to back, one half-edge loop each; a segment and a point have one face loop and no
    /// normals, as their [`Core3`](crate::Core3).
    #[inline]
    pub fn dimension(&self) -> u8 {
        self.data.dimension
    }

    /// The vertices, in the order of the given points; of a flat hull, in order around.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        &self.data.vertices
    }

    /// How faces, edges and vertices are connected.
    #[inline]
    pub fn topology(&self) -> &Topology {
        &self.data.topology
    }

    /// Outward unit normals of the faces, computed in f64. A segment and a point have none.
    #[inline]
    pub fn normals(&self) -> &[DVec3] {
        &self.data.normals
    }

    /// The support height of the core along each normal, in metres from its origin.
    #[inline]
    pub(crate) fn heights(&self) -> &[f64] {
        &self.data.octets.heights
    }

    /// The core's vertices, eight by eight.
    #[inline]
    pub(crate) fn vertex_octets(&self) -> &[VertexOctet] {
        &self.data.octets.vertices
    }

    /// The core's faces, eight by eight.
    #[inline]
    pub(crate) fn face_octets(&self) -> &[FaceOctet] {
        &self.data.octets.faces
    }

    /// The core's edges, eight by eight.
    #[inline]
    pub(crate) fn edge_octets(&self) -> &[EdgeOctet] {
        &self.data.octets.edges
    }

    /// The core's edges on the Gauss map.
    #[inline]
    pub(crate) fn arcs(&self) -> &[EdgeArc] {
        &self.data.octets.arcs
    }

    /// The greatest absolute value of any coordinate of the core.
    #[inline]
    pub(crate) fn extent(&self) -> f32 {
        self.data.octets.extent
    }

    /// Radius of a sphere about the centre that lies inside the core; minus the distance if the centre lies outside.
    #[inline]
    pub(crate) fn core_inner_radius(&self) -> f32 {
        self.data.inner_radius
    }

    /// The centre of both radii: the centre of volume, area or length, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec3 {
        self.data.center
    }

    /// The same hull, expanded by `radius` metres on every side, with round edges and corners. Zero removes the
    /// rounding.
    ///
    /// ```
    /// use asunder::{Hull, glam::{DVec3, Vec3}};
    /// let rounded = Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z])?.rounded(0.5)?;
    /// assert!(rounded.contains(DVec3::new(0.2, 0.2, -0.5)) && !rounded.contains(DVec3::new(-0.4, -0.4, 0.2)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A radius that is negative or not finite, or with which the shape would reach further than 1e6 m.
    pub fn rounded(mut self, radius: f32) -> Result<Self, RadiusError> {
        let reach = self.vertices().iter().map(|v| v.as_dvec3().length()).fold(0.0, f64::max);
        check_rounding(radius, reach)?;
        self.radius = radius;
        Ok(self)
    }

    /// An address that two hulls have in common exactly when they share their data, whatever their rounding; valid only
    /// while both live. It differs from run to run: use it for look-ups, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        std::sync::Arc::as_ptr(&self.data).addr()
    }

    /// Radius of the rounding, in metres; zero for sharp edges.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Radius of a sphere about [`Hull::center`] that contains the shape, in metres, rounded up. At least 1e-6 m, even
    /// for a point.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.data.outer_radius, self.radius)
    }

    /// Radius of a sphere about [`Hull::center`] that lies inside the shape, in metres, rounded down. Zero if there is
    /// none: the centre is rounded, and may lie beside a shape without volume.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        round_down(f64::from(self.data.inner_radius) + f64::from(self.radius)).max(0.0)
    }

    /// How far any vertex lies beyond the lowest vertex of any face, along that face's normal, in metres: the cost of
    /// merging nearly coplanar facets. At most 2e-6 of the size.
    #[inline]
    pub fn planarity_error(&self) -> f32 {
        self.data.planarity_error
    }

    /// A bound on how far outside the hull any of the given points lies, in metres. Zero unless a face that is flat
    /// up to rounding had points inside it, or [`Hull::simplify`] left points out.
    #[inline]
    pub fn error(&self) -> f32 {
        self.data.error
    }

    /// Adds to the error for points that lie up to so far, in metres, outside of those it was made from. Only for a
    /// hull whose data are not shared.
    pub(crate) fn left_out(mut self, error: f64) -> Self {
        if let Some(data) = Arc::get_mut(&mut self.data)
            && error > 0.0
        {
            data.error = round_up(f64::from(data.error) + error);
        }
        self
    }

    /// The AABB of the posed shape, grown by `margin` metres and rounded outwards: too wide by less than a millionth of
    /// the vertices' distance from the hull's own origin. Cost: linear in the vertices, eight at a time.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let grow = f64::from(margin) + f64::from(self.radius);
        around_octets(self.vertex_octets(), self.extent(), pose, grow)
    }
}

impl HullData {
    /// Adds the data that kernels load, once vertices and faces have their final order.
    fn finished(mut self) -> Self {
        self.octets = Octets::new(&self.vertices, &self.normals, &self.topology);
        self
    }
}

#[cfg(test)]
mod tests;
