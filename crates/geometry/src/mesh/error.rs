//! Errors of meshes.

use crate::tolerance::{MAX_MESH_VERTICES, MAX_RADIUS, MAX_TRIANGLES};

/// How many triangles of a mesh were left out. [`TriMesh::is_dropped`](crate::TriMesh::is_dropped) returns which.
///
/// ```
/// use asunder::{DroppedTriangles, TriMesh, glam::Vec3};
/// let triangles = [[0, 2, 1], [0, 1, 1], [2, 0, 1], [1, 0, 2]];
/// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z], triangles)?;
/// assert_eq!(mesh.dropped(), DroppedTriangles { degenerate: 1, duplicate: 2 });
/// # Ok::<(), asunder::MeshError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DroppedTriangles {
    /// Rejected by [`Triangle3::new`](crate::Triangle3::new): without an area, so thin that the normal would be mere
    /// rounding, or too small.
    pub degenerate: usize,
    /// With the same three points as an earlier one, in any order; in a [one-sided](crate::TriMesh::one_sided) mesh,
    /// only if wound the same way.
    pub duplicate: usize,
}

/// Why triangles were rejected as a mesh.
///
/// ```
/// use asunder::{MeshError, TriMesh, glam::Vec3};
/// let corners = [Vec3::ZERO, Vec3::X, Vec3::Z];
/// let refused = TriMesh::new(corners, [[0, 1, 2], [0, 2, 3]]).unwrap_err();
/// assert_eq!(refused, MeshError::NoSuchVertex { triangle: 1, vertex: 3, count: 3 });
/// assert_eq!(TriMesh::new(corners, []).unwrap_err(), MeshError::NoTriangles);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// None were given, or all were dropped.
    NoTriangles,
    /// More than [`MAX_TRIANGLES`].
    TooManyTriangles {
        /// How many were given.
        count: usize,
    },
    /// More than [`MAX_MESH_VERTICES`].
    TooManyVertices {
        /// How many were given.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Number of the vertex.
        vertex: usize,
    },
    /// A vertex is further than [`MAX_RADIUS`] from the mesh's origin.
    TooLarge {
        /// Number of the vertex.
        vertex: usize,
    },
    /// A triangle refers to a vertex that was not given.
    NoSuchVertex {
        /// Number of the triangle.
        triangle: usize,
        /// The vertex number in the triangle.
        vertex: u32,
        /// How many vertices were given.
        count: usize,
    },
}

impl core::fmt::Display for MeshError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoTriangles => write!(f, "a mesh needs a triangle that has an area"),
            Self::TooManyTriangles { count } => {
                write!(f, "{count} triangles are more than {MAX_TRIANGLES}: make several bodies")
            }
            Self::TooManyVertices { count } => {
                write!(
                    f,
                    "{count} vertices are more than {MAX_MESH_VERTICES}: leave out what no triangle names"
                )
            }
            Self::NotFinite { vertex } => write!(f, "vertex {vertex} is not finite"),
            Self::TooLarge { vertex } => {
                write!(
                    f,
                    "vertex {vertex} is more than {MAX_RADIUS} m from the mesh's origin: split the mesh"
                )
            }
            Self::NoSuchVertex { triangle, vertex, count } => {
                write!(f, "triangle {triangle} names vertex {vertex} of {count}: numbers count from 0")
            }
        }
    }
}

impl core::error::Error for MeshError {}
