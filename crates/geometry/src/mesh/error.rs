//! What can be wrong with a mesh.

/// How many triangles of a mesh were left out.
///
/// ```
/// use asunder_geometry::DroppedTriangles;
/// assert_eq!(DroppedTriangles::default().degenerate, 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DroppedTriangles {
    /// Without an area, or so thin that their normal would be rounding.
    pub degenerate: usize,
    /// The same three points as an earlier one, in any order.
    pub duplicate: usize,
}

/// Why triangles make no mesh.
///
/// ```
/// use asunder_geometry::MeshError;
/// assert_eq!(MeshError::NoTriangles.to_string(), "a mesh needs a triangle");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshError {
    /// None were given, or all were dropped.
    NoTriangles,
}

impl core::fmt::Display for MeshError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoTriangles => write!(f, "a mesh needs a triangle"),
        }
    }
}

impl core::error::Error for MeshError {}
