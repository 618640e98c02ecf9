//! Triangles.

use crate::aabb::Aabb3;
use crate::hull::normal::{area_vector, unit};
use crate::outward::{around3, round_up};
use crate::pose3::Pose3;
use crate::topology::Topology;
use crate::vertex::{VertexError, check_size, check_vertices};
use glam::{DVec3, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};
use std::sync::LazyLock;

/// A triangle in space, given by its vertices in metres. It is solid from both sides and has no thickness.
///
#[doc = include_str!("../doc/triangle3.svg")]
///
/// Face 0 is the side from which the vertices wind counter-clockwise, face 1 the other.
///
/// # Costs and limits
/// Two faces and three edges. It has no inside: a body that intersects it is pushed out on the nearer side. Height over
/// the longest side at least 1e-7 of that side; bounding radius from 1e-6 m; vertices within 1e6 m of the shape's
/// origin.
///
/// ```
/// use asunder::{Triangle3, glam::{DVec3, Vec3}};
/// let triangle = Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Y)?;
/// assert!(triangle.contains(DVec3::new(0.25, 0.25, 0.0)) && !triangle.contains(DVec3::new(0.25, 0.25, 1e-9)));
/// assert_eq!(triangle.normals()[0], DVec3::Z);
/// # Ok::<(), asunder::VertexError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle3 {
    vertices: [Vec3; 3],
    outer_radius: f32,
}

static TOPOLOGY: LazyLock<Topology> = LazyLock::new(|| {
    let loops: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 1]];
    Topology::from_loops(loops.iter().map(|vertices| vertices.as_slice()))
});

/// Height of a triangle over its longest side, as a share of that side, below which it counts as a segment, as its
/// normal would be mere rounding.
const LEAST_HEIGHT: f64 = 1e-7;

impl Triangle3 {
    /// A triangle from its vertices, in metres.
    ///
    /// # Errors
    /// Vertices that are equal, on one line, not finite, or out of range.
    pub fn new(a: Vec3, b: Vec3, c: Vec3) -> Result<Self, VertexError> {
        let corners = [a, b, c].map(|vertex| vertex.as_dvec3());
        check_vertices(&corners)?;
        let sides = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
        let longest = sides.iter().map(|side| side.length_squared()).fold(0.0, f64::max);
        if sides[0].cross(sides[1]).length() <= LEAST_HEIGHT * longest {
            return Err(VertexError::Collinear);
        }
        let triangle = Self::known([a, b, c]);
        check_size(triangle.outer_radius)?;
        Ok(triangle)
    }

    /// A triangle that [`Triangle3::new`] would accept.
    #[inline]
    #[doc(hidden)]
    pub fn known(vertices: [Vec3; 3]) -> Self {
        let mut triangle = Self { vertices, outer_radius: 0.0 };
        let center = triangle.center().as_dvec3();
        let squared = |corner: Vec3| (corner.as_dvec3() - center).length_squared();
        let [a, b, c] = vertices;
        let reach = squared(a).max(squared(b)).max(squared(c)).sqrt();
        triangle.outer_radius = round_up(reach * (1.0 + 8.0 * f64::EPSILON));
        triangle
    }

    /// The three vertices, bit for bit as given.
    #[inline]
    pub const fn vertices(&self) -> [Vec3; 3] {
        self.vertices
    }

    /// The half-edges that every triangle shares: two faces, back to back.
    #[inline]
    pub fn topology() -> &'static Topology {
        &TOPOLOGY
    }

    /// Unit normals of both faces, in f64.
    #[inline]
    pub fn normals(&self) -> [DVec3; 2] {
        let normal = unit(area_vector(3, |corner| self.vertices[corner]));
        [normal, -normal]
    }

    /// The centre of the bounding radius: the centroid, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec3 {
        let [a, b, c] = self.vertices;
        let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
        ((a + b + c) / 3.0).as_vec3()
    }

    /// Bounding radius about [`Triangle3::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether a local point, in metres, lies on the triangle, edges and corners included, so that there is no gap
    /// between two triangles that share an edge. Exact, as long as no product of three coordinates underflows, as it
    /// may with a coordinate below 1e-200 m.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        let [a, b, c] = self.vertices.map(|vertex| vertex.as_dvec3());
        let coord = |v: DVec3| Coord3D { x: v.x, y: v.y, z: v.z };
        if !point.is_finite() || orient3d(coord(a), coord(b), coord(c), coord(point)) != 0.0 {
            return false;
        }
        // Within the plane, the edges are tested in the projection along the axis nearest to the normal.
        let axis = (b - a).cross(c - a).abs().max_position();
        let shadow = |v: DVec3| Coord { x: v[(axis + 1) % 3], y: v[(axis + 2) % 3] };
        let [a, b, c, point] = [a, b, c, point].map(shadow);
        let sense = orient2d(a, b, c).signum();
        let is_inside = |from, to| orient2d(from, to, point) * sense >= 0.0;
        is_inside(a, b) && is_inside(b, c) && is_inside(c, a)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        around3(self.vertices.iter().map(|vertex| vertex.as_dvec3()), pose, f64::from(margin))
    }
}

#[cfg(test)]
mod tests {
    use crate::height_field::HeightField;
    use crate::hull::Hull;
    use crate::mesh::TriMesh;
    use glam::{DVec3, Vec2, Vec3};

    #[test]
    fn no_point_falls_between_two_triangles() {
        let corners = [
            (-0.063_123_725, 0.0, -0.095_814_8),
            (0.918_852_3, 0.0, -0.194_287_99),
            (1.179_292_8, 0.0, 1.146_063_7),
            (0.019_179_275, 0.0, 1.194_755_8),
        ]
        .map(Vec3::from);
        let mesh = TriMesh::new(corners, [[0, 2, 1], [0, 3, 2]]).unwrap();
        let at = DVec3::new(0.017_980_337_384_295_608, 0.0, -0.014_745_861_633_999_255);
        assert!(mesh.contains(at) && Hull::of_any_dimension(&corners).unwrap().contains(at));
        let (mut random, mut out) = (oorandom::Rand64::new(7), 0);
        for cell in [Vec2::ONE, Vec2::new(0.3, 0.7), Vec2::new(13.1, 0.1)] {
            let field = HeightField::new(9, 9, [0.0; 81], cell).unwrap();
            for _ in 0..5000 {
                // Along the inner edge of a cell, up to rounding.
                let [column, row] = [0; 2].map(|_| random.rand_range(0..8) as f64);
                let share = random.rand_float();
                let x = (column + share) * f64::from(cell.x);
                out += u32::from(!field.contains([x, 0.0, (row + 1.0 - share) * f64::from(cell.y)]));
            }
        }
        assert_eq!(out, 0);
    }
}
