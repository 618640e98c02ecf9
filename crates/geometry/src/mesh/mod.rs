//! Triangle meshes.

mod error;

pub use error::{DroppedTriangles, MeshError};

use crate::aabb::Aabb3;
use crate::ground::Prominent;
use crate::outward::{around3, round_up};
use crate::pose3::Pose3;
use crate::triangle::Triangle3;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// Triangles that make up a level, given by vertices in metres. Clones share the data.
///
/// It is the union of its triangles, without thickness. Bodies that carry it are always fixed. It is solid from both
/// sides unless it is [`one_sided`](Self::one_sided).
///
/// ```
/// use asunder_geometry::{TriMesh, glam::Vec3};
/// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z], [[0, 2, 1]])?.one_sided();
/// assert!(mesh.is_one_sided() && mesh.vertices().len() == 3 && mesh.triangles() == [[0, 2, 1]]);
/// assert_eq!(mesh.dropped().degenerate, 0);
/// # Ok::<(), asunder_geometry::MeshError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    data: Arc<Data>,
    is_one_sided: bool,
}

#[derive(Debug, PartialEq)]
struct Data {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    dropped: DroppedTriangles,
    center: Vec3,
    outer_radius: f32,
}

impl TriMesh {
    /// A mesh from its vertices, in metres, and its triangles, three vertex numbers each, counter-clockwise as seen
    /// from the front.
    ///
    /// # Errors
    /// No triangles, or too many; vertices that are not finite or out of range; numbers of no vertex.
    pub fn new(
        vertices: impl Into<Vec<Vec3>>,
        triangles: impl Into<Vec<[u32; 3]>>,
    ) -> Result<Self, MeshError> {
        let (vertices, triangles) = (vertices.into(), triangles.into());
        let (low, high) =
            vertices.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &vertex| {
                (low.min(vertex), high.max(vertex))
            });
        let center = (low + high) * 0.5;
        let reach = (high.as_dvec3() - center.as_dvec3()).length();
        let outer_radius = round_up(reach * (1.0 + 8.0 * f64::EPSILON));
        let dropped = DroppedTriangles::default();
        Ok(Self {
            data: Arc::new(Data { vertices, triangles, dropped, center, outer_radius }),
            is_one_sided: false,
        })
    }

    /// The same, solid only from the front.
    #[must_use]
    pub fn one_sided(self) -> Self {
        Self { is_one_sided: true, ..self }
    }

    /// Whether it is solid only from the front.
    #[inline]
    pub const fn is_one_sided(&self) -> bool {
        self.is_one_sided
    }

    /// The vertices, in metres, bit for bit as given.
    pub fn vertices(&self) -> &[Vec3] {
        &self.data.vertices
    }

    /// The triangles, by their vertices' numbers.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.data.triangles
    }

    /// Memory that is held, in bytes.
    pub fn bytes(&self) -> usize {
        0
    }

    /// What was left out.
    pub fn dropped(&self) -> DroppedTriangles {
        self.data.dropped
    }

    /// The centre that the bounding radius is about: the middle of its box.
    pub fn center(&self) -> Vec3 {
        self.data.center
    }

    /// Bounding radius about [`TriMesh::center`], in metres, rounded up.
    pub fn outer_radius(&self) -> f32 {
        self.data.outer_radius
    }

    /// Whether any triangle holds a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        (0..self.triangle_count())
            .any(|number| self.triangle(number).is_some_and(|triangle| triangle.contains(point)))
    }

    /// The box around the posed mesh, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        around3(self.data.vertices.iter().map(|vertex| vertex.as_dvec3()), pose, f64::from(margin))
    }

    pub(crate) fn triangle_count(&self) -> u32 {
        self.data.triangles.len() as u32
    }

    pub(crate) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.vertex_numbers(triangle).map(|vertex| self.data.vertices[vertex as usize])
    }

    pub(crate) fn triangle(&self, triangle: u32) -> Option<Triangle3> {
        let [a, b, c] = self.corners(triangle);
        Triangle3::new(a, b, c).ok()
    }

    pub(crate) fn vertex_numbers(&self, triangle: u32) -> [u32; 3] {
        self.data.triangles[triangle as usize]
    }

    pub(crate) fn neighbor(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        let ends = |numbers: [u32; 3], edge: usize| [numbers[edge % 3], numbers[(edge + 1) % 3]];
        let [from, to] = ends(self.vertex_numbers(triangle), edge);
        let mut found = None;
        for other in (0..self.triangle_count()).filter(|&other| other != triangle) {
            for twin in 0..3 {
                if ends(self.vertex_numbers(other), twin) == [to, from] {
                    found = Some((other, twin));
                }
            }
        }
        found
    }

    pub(crate) fn prominent(&self, _triangle: u32) -> Prominent {
        Prominent::ALL
    }

    pub(crate) fn patch(&self, triangle: u32) -> u32 {
        triangle
    }

    pub(crate) fn visit_near(
        &self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for triangle in 0..self.triangle_count() {
            let [a, b, c] = self.corners(triangle);
            if Aabb3::new(a.min(b).min(c), a.max(b).max(c)).overlaps(bounds) {
                visitor(triangle)?;
            }
        }
        ControlFlow::Continue(())
    }
}
