//! Shapes as triangles, made once for each shape.

use asunder::glam::{DVec2, DVec3, Vec3};

/// Tiles along each side of the board that stands for an unbounded plane.
const TILES: i32 = 24;

/// A shape's faces, in its own axes.
#[derive(Default)]
pub(crate) struct Form {
    /// The corners of all faces, one face after the other.
    pub(crate) corners: Vec<Vec3>,
    pub(crate) faces: Vec<Facet>,
}

/// A convex face.
pub(crate) struct Facet {
    pub(crate) normal: Vec3,
    /// The number of its corners, which follow those of the faces before.
    pub(crate) count: u32,
    /// A factor for the brightness of its colour.
    pub(crate) tone: f32,
}

impl Form {
    /// Adds a face; ignores one with fewer than three corners.
    pub(crate) fn add(&mut self, normal: DVec3, corners: impl IntoIterator<Item = DVec3>, tone: f32) {
        let first = self.corners.len();
        self.corners.extend(corners.into_iter().map(|corner| corner.as_vec3()));
        let count = self.corners.len() - first;
        if count < 3 {
            return self.corners.truncate(first);
        }
        self.faces.push(Facet { normal: normal.as_vec3(), count: count as u32, tone });
    }

    /// Adds a face in the plane.
    pub(crate) fn add_flat(&mut self, outline: &[DVec2]) {
        self.add(DVec3::Z, outline.iter().map(|point| point.extend(0.0)), 1.0);
    }

    /// A board of tiles as large as the scene, for the boundary of a half-space.
    pub(crate) fn board(normal: DVec3, half: f64) -> Self {
        let mut form = Self::default();
        let across = if normal.y.abs() > 0.9 { DVec3::X } else { DVec3::Y };
        let along = normal.cross(across).normalize_or(DVec3::Z);
        let (across, tile) = (along.cross(normal), half / f64::from(TILES) * 2.0);
        for (row, column) in (0..TILES).flat_map(|row| (0..TILES).map(move |column| (row, column))) {
            let [x, y] = [row, column].map(|n| f64::from(n - TILES / 2) * tile);
            let corner = |i: f64, j: f64| along * (x + i * tile) + across * (y + j * tile);
            let corners = [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0), corner(1.0, 0.0)];
            form.add(normal, corners, if (row + column) % 2 == 0 { 1.0 } else { 0.94 });
        }
        form
    }
}
