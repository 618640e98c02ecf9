//! Triangles from a Wavefront OBJ file.

use asunder::glam::Vec3;
use std::path::Path;

/// Triangles without connectivity, as the file has them.
pub(crate) struct Soup {
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Why a file gives no triangles.
#[derive(Debug)]
pub(crate) enum ObjError {
    /// It cannot be read, or is not in the format.
    File(tobj::LoadError),
    /// The format is right, and there is no face in it.
    NoFaces,
}

impl std::fmt::Display for ObjError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(error) => write!(f, "not a Wavefront OBJ file that can be read: {error}"),
            Self::NoFaces => write!(f, "there is no face in it"),
        }
    }
}

impl std::error::Error for ObjError {}

/// Reads all objects of a file. Faces of more than three corners become fans; materials are ignored.
pub(crate) fn read(file: &Path) -> Result<Soup, ObjError> {
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let (models, _) = tobj::load_obj(file, &options).map_err(ObjError::File)?;
    let mut soup = Soup { vertices: Vec::new(), triangles: Vec::new() };
    for model in models {
        let first = soup.vertices.len() as u32;
        let (positions, _) = model.mesh.positions.as_chunks::<3>();
        soup.vertices.extend(positions.iter().map(|&place| Vec3::from_array(place)));
        let (corners, _) = model.mesh.indices.as_chunks::<3>();
        soup.triangles.extend(corners.iter().map(|corners| corners.map(|corner| first + corner)));
    }
    if soup.triangles.is_empty() { Err(ObjError::NoFaces) } else { Ok(soup) }
}
