//! `Debug` output of shapes with many numbers.
//!
//! Prints the data from which shapes were made if that is a few lines, and only its amount where there may be millions;
//! never the derived tables. Ground of any size takes one line in a log.

use crate::{Chain, Compound2, Compound3, HeightField, Hull, Polygon, TriMesh};
use core::fmt::{Debug, Formatter, Result};

/// The vertices, as [`Hull::from_points`] takes them, and how many faces they have.
impl Debug for Hull {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("Hull")
            .field("vertices", &self.vertices())
            .field("faces", &self.topology().face_count())
            .field("radius", &self.radius())
            .finish_non_exhaustive()
    }
}

/// The vertices, as [`Polygon::new`] takes them.
impl Debug for Polygon {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("Polygon")
            .field("vertices", &self.vertices())
            .field("radius", &self.radius())
            .finish_non_exhaustive()
    }
}

/// The number of vertices and triangles, and how far they reach around the center.
impl Debug for TriMesh {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("TriMesh")
            .field("vertices", &self.vertices().len())
            .field("triangles", &self.triangles().len())
            .field("is_one_sided", &self.is_one_sided())
            .field("center", &self.center())
            .field("outer_radius", &self.outer_radius())
            .finish_non_exhaustive()
    }
}

/// The number of columns and rows, and the size of a cell.
impl Debug for HeightField {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("HeightField")
            .field("columns", &self.columns())
            .field("rows", &self.rows())
            .field("cell", &self.cell())
            .field("is_one_sided", &self.is_one_sided())
            .field("center", &self.center())
            .field("outer_radius", &self.outer_radius())
            .finish_non_exhaustive()
    }
}

/// The number of vertices, and how far they reach around the center.
impl Debug for Chain {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("Chain")
            .field("vertices", &self.vertices().len())
            .field("is_closed", &self.is_closed())
            .field("is_one_sided", &self.is_one_sided())
            .field("center", &self.center())
            .field("outer_radius", &self.outer_radius())
            .finish_non_exhaustive()
    }
}

/// The parts.
impl Debug for Compound2 {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("Compound2").field("parts", &self.parts()).finish_non_exhaustive()
    }
}

/// The parts.
impl Debug for Compound3 {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("Compound3").field("parts", &self.parts()).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cuboid, Part3, Pose3, Shape2, Shape3};
    use glam::{Vec2, Vec3};

    /// One line of a log has room for this.
    const LINE: usize = 400;

    #[test]
    fn ground_of_many_triangles_prints_on_a_line() {
        let corner = |i: u32| Vec3::new((i % 100) as f32, 0.0, (i / 100) as f32);
        let triangles = (0..9_900).filter(|i| i % 100 < 99).map(|i| [i, i + 100, i + 1]).collect::<Vec<_>>();
        let mesh = TriMesh::new((0..10_000).map(corner).collect::<Vec<_>>(), triangles).unwrap();
        let shown = format!("{:?}", Shape3::from(mesh));
        assert!(shown.len() < LINE && shown.contains("vertices: 10000, triangles: 9801,"), "{shown}");
        let field = HeightField::new(100, 50, vec![0.5; 5_000], Vec2::ONE).unwrap();
        let shown = format!("{:?}", Shape3::from(field));
        assert!(shown.len() < LINE && shown.contains("columns: 100, rows: 50,"), "{shown}");
        let chain = Chain::open((0..10_000).map(|i| Vec2::new(i as f32, 0.0))).unwrap();
        let shown = format!("{:?}", Shape2::from(chain));
        assert!(shown.len() < LINE && shown.contains("vertices: 10000, is_closed: false,"), "{shown}");
    }

    #[test]
    fn solids_print_what_they_are_made_of() {
        let points = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let hull = Hull::from_points(&points).unwrap().rounded(0.25).unwrap();
        let shown = format!("{hull:?}");
        assert_eq!(
            shown,
            format!("Hull {{ vertices: {:?}, faces: 4, radius: 0.25, .. }}", hull.vertices()),
            "and none of its tables"
        );
        let outline = [Vec2::ZERO, Vec2::X, Vec2::Y];
        let polygon = Polygon::new(&outline).unwrap();
        let shown = format!("{polygon:?}");
        assert_eq!(shown, format!("Polygon {{ vertices: {:?}, radius: 0.0, .. }}", polygon.vertices()));
        let cube: Shape3 = Cuboid::from_half_extents(Vec3::ONE).unwrap().into();
        let pair = Compound3::new([(Pose3::IDENTITY, cube.clone()), (Pose3::IDENTITY, cube)]).unwrap();
        let parts: &[Part3] = pair.parts();
        assert_eq!(format!("{pair:?}"), format!("Compound3 {{ parts: {parts:?}, .. }}"));
    }
}
