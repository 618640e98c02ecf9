//! Triangle meshes.

mod build;
mod edges;
mod error;

pub use error::{DroppedTriangles, MeshError};

use crate::aabb::Aabb3;
use crate::ground::tree::Tree;
use crate::ground::{Ground, Prominent};
use crate::outward::{around3, round_down, round_up};
use crate::pose3::Pose3;
use crate::triangle::Triangle3;
use build::DROPPED;
use core::ops::ControlFlow;
use edges::NO_TWIN;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// A triangle mesh, for levels, given by vertices in metres. Clones share the data.
///
#[doc = include_str!("../../doc/tri_mesh.svg")]
///
/// It is the union of its triangles, without thickness, and solid from both sides unless it is
/// [`one_sided`](Self::one_sided). Bodies with this shape are always fixed.
///
/// - Vertices at the same position count as one, even if a file repeats them.
/// - Triangles without an area, and duplicates of earlier ones, wound either way, are [dropped](Self::dropped). The
///   others keep their numbers, so that materials can be looked up by them.
/// - Two triangles are neighbours if they wind alike and only they share an edge.
///
/// # Costs and limits
/// - At most [`MAX_TRIANGLES`](crate::tolerance::MAX_TRIANGLES) triangles and
///   [`MAX_MESH_VERTICES`](crate::tolerance::MAX_MESH_VERTICES) vertices, within 1e6 m of the shape's origin.
/// - A triangle takes about 80 bytes, and less than 100 where no vertex is shared.
/// - Triangles are found in a tree that holds their corners, so that a ray needs no other data. With more than two
///   vertices per triangle it holds only boxes, and rays on a large mesh take longer.
///
/// ```
/// use asunder::{TriMesh, glam::Vec3};
/// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z], [[0, 2, 1]])?.one_sided();
/// assert!(mesh.is_one_sided() && mesh.vertices().len() == 3 && mesh.triangles() == [[0, 2, 1]]);
/// assert_eq!(mesh.dropped().degenerate, 0);
/// assert!(mesh.contains(Vec3::new(0.25, 0.0, 0.25)) && !mesh.contains(Vec3::new(0.25, 1e-9, 0.25)));
/// # Ok::<(), asunder::MeshError>(())
/// ```
#[derive(Clone)]
pub struct TriMesh {
    data: Arc<Data>,
    is_one_sided: bool,
}

struct Data {
    vertices: Vec<Vec3>,
    /// Among vertices at the same position, the least number.
    triangles: Vec<[u32; 3]>,
    /// For each half-edge, three per triangle, the one on the other side.
    twins: Vec<u32>,
    /// The patch of each triangle, by its least triangle number.
    patches: Vec<u32>,
    /// [`Prominent`]'s bits, or [`DROPPED`].
    marks: Vec<u16>,
    tree: Tree,
    dropped: DroppedTriangles,
    /// Whether some were dropped because they are the backs of others.
    has_backs: bool,
    low: Vec3,
    high: Vec3,
    center: Vec3,
    outer_radius: f32,
}

impl TriMesh {
    /// A mesh from its vertices, in metres, and its triangles, three vertex numbers each, counter-clockwise as seen
    /// from the front. Cost: half a microsecond to one per triangle.
    ///
    /// # Errors
    /// No triangles that have an area, or too many; vertices that are not finite or out of range; vertex numbers
    /// without a vertex.
    pub fn new(
        vertices: impl Into<Vec<Vec3>>,
        triangles: impl Into<Vec<[u32; 3]>>,
    ) -> Result<Self, MeshError> {
        let data = build::build(vertices.into(), triangles.into(), false)?;
        Ok(Self { data: Arc::new(data), is_one_sided: false })
    }

    /// The same mesh, solid only from the front.
    ///
    /// A triangle that was dropped as another's back (the same three vertices wound the other way) is restored, so that
    /// leaves and fences that are modelled from both sides are solid from both. In that case the mesh is rebuilt, and
    /// its data are not shared; otherwise this costs nothing.
    ///
    /// ```
    /// use asunder::{TriMesh, glam::Vec3};
    /// let leaf = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z], [[0, 2, 1], [0, 1, 2]])?;
    /// assert!(leaf.is_dropped(1) && !leaf.one_sided().is_dropped(1));
    /// # Ok::<(), asunder::MeshError>(())
    /// ```
    #[must_use]
    pub fn one_sided(self) -> Self {
        let data = if self.data.has_backs {
            let Data { vertices, triangles, .. } = &*self.data;
            // Cannot fail: it was a mesh with fewer of these triangles.
            build::build(vertices.clone(), triangles.clone(), true).map_or(self.data, Arc::new)
        } else {
            self.data
        };
        Self { data, is_one_sided: true }
    }

    /// Whether it is solid only from the front.
    #[inline]
    pub const fn is_one_sided(&self) -> bool {
        self.is_one_sided
    }

    /// An address that two meshes have in common exactly when they share their data; valid only while both live. It
    /// differs from run to run: use it for look-ups, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        Arc::as_ptr(&self.data).addr()
    }

    /// The vertices, in metres, bit for bit as given.
    pub fn vertices(&self) -> &[Vec3] {
        &self.data.vertices
    }

    /// The triangles in the order given, dropped ones included, as vertex numbers: among vertices at the same position,
    /// the least.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.data.triangles
    }

    /// How many triangles were left out.
    pub fn dropped(&self) -> DroppedTriangles {
        self.data.dropped
    }

    /// Whether a triangle was left out; true as well for numbers that were never given.
    ///
    /// ```
    /// use asunder::{TriMesh, glam::Vec3};
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z], [[0, 1, 0], [0, 2, 1], [0, 1, 2]])?;
    /// assert_eq!([0, 1, 2, 3].map(|triangle| mesh.is_dropped(triangle)), [true, false, true, true]);
    /// # Ok::<(), asunder::MeshError>(())
    /// ```
    #[inline]
    pub fn is_dropped(&self, triangle: u32) -> bool {
        self.data.marks.get(triangle as usize).is_none_or(|&marks| marks == DROPPED)
    }

    /// Memory that is held, in bytes; clones share it.
    ///
    /// ```
    /// use asunder::{TriMesh, glam::Vec3};
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z], [[0, 2, 1]])?;
    /// assert!(mesh.bytes() > 48);
    /// # Ok::<(), asunder::MeshError>(())
    /// ```
    pub fn bytes(&self) -> usize {
        let data = &*self.data;
        size_of::<Data>()
            + data.vertices.capacity() * size_of::<Vec3>()
            + data.triangles.capacity() * size_of::<[u32; 3]>()
            + (data.twins.capacity() + data.patches.capacity()) * size_of::<u32>()
            + data.marks.capacity() * size_of::<u16>()
            + data.tree.bytes()
    }

    /// The centre of the bounding radius: the middle of its box.
    #[inline]
    pub fn center(&self) -> Vec3 {
        self.data.center
    }

    /// Bounding radius about [`TriMesh::center`], in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        self.data.outer_radius
    }

    /// Whether any triangle contains a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        Ground::Mesh(self).holds(point.into())
    }

    /// A box around the posed mesh, grown by `margin` metres and rounded outwards. It is the box of the mesh's own box,
    /// posed; the cost is that of eight corners.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        bounds_of([self.data.low, self.data.high], pose, margin)
    }

    #[inline]
    pub(crate) fn triangle_count(&self) -> u32 {
        self.data.triangles.len() as u32
    }

    #[inline]
    pub(crate) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        let at = |vertex: u32| self.data.vertices.get(vertex as usize).copied().unwrap_or_default();
        let [a, b, c] = self.vertex_numbers(triangle);
        [at(a), at(b), at(c)]
    }

    #[inline]
    pub(crate) fn triangle(&self, triangle: u32) -> Option<Triangle3> {
        (!self.is_dropped(triangle)).then(|| Triangle3::known(self.corners(triangle)))
    }

    #[inline]
    pub(crate) fn vertex_numbers(&self, triangle: u32) -> [u32; 3] {
        self.data.triangles.get(triangle as usize).copied().unwrap_or_default()
    }

    #[inline]
    pub(crate) fn neighbor(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        let twin = *self.data.twins.get((triangle as usize).checked_mul(3)?.checked_add(edge % 3)?)?;
        (twin != NO_TWIN).then_some((twin / 3, twin as usize % 3))
    }

    #[inline]
    pub(crate) fn prominent(&self, triangle: u32) -> Prominent {
        let marks = self.data.marks.get(triangle as usize).copied().unwrap_or(DROPPED);
        if marks == DROPPED { Prominent::NONE } else { Prominent::from_bits(marks) }
    }

    #[inline]
    pub(crate) fn patch(&self, triangle: u32) -> u32 {
        self.data.patches.get(triangle as usize).copied().unwrap_or(triangle)
    }

    #[inline]
    pub(crate) fn visit_near(
        &self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.data.tree.visit_overlapping(bounds, |number, _| visitor(number))
    }

    pub(crate) fn tree(&self) -> &Tree {
        &self.data.tree
    }
}

/// Equal triangles of equal vertices, solid from the same sides.
impl PartialEq for TriMesh {
    fn eq(&self, other: &Self) -> bool {
        let (one, two) = (&*self.data, &*other.data);
        let is_same = || one.vertices == two.vertices && one.triangles == two.triangles;
        self.is_one_sided == other.is_one_sided && (Arc::ptr_eq(&self.data, &other.data) || is_same())
    }
}

impl Ground<'_> {
    /// Whether any triangle contains a local point.
    pub(crate) fn holds(self, point: DVec3) -> bool {
        let holds = |number: u32| match self.triangle(number) {
            Some(triangle) if triangle.contains(point) => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        self.visit_near(&box_of(point), holds).is_break()
    }
}

/// The smallest f32 box that holds a point; an invalid one if the point is not finite.
fn box_of(point: DVec3) -> Aabb3 {
    let [low, high] = [point.to_array().map(round_down), point.to_array().map(round_up)];
    Aabb3::new(Vec3::from_array(low), Vec3::from_array(high))
}

/// The box around a posed box.
pub(crate) fn bounds_of(corners: [Vec3; 2], pose: &Pose3, margin: f32) -> Aabb3 {
    let corner = |number: usize| {
        let [x, y, z] = [number & 1, number >> 1 & 1, number >> 2].map(|side| corners[side]);
        DVec3::new(f64::from(x.x), f64::from(y.y), f64::from(z.z))
    };
    around3((0..8).map(corner), pose, f64::from(margin))
}
