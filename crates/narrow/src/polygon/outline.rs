//! A shape as the kernels see it: stored vertices, and how they stand in the frame of the pair.

use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Rect, Rotation2, Shape2};

/// A polygon in the frame of a pair: the world's axes, about A's position.
///
/// The stored rotation is within rounding of one and not exactly one, so turned normals are normalised again and
/// both shapes are turned, where in space a relative rotation would do.
pub(crate) struct Outline<'a> {
    pub(crate) vertices: &'a [Vec2],
    normals: &'a [DVec2],
    rotation: Rotation2,
    position: DVec2,
}

/// Where a projection is greatest, and how great.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    pub(crate) vertex: usize,
    pub(crate) reach: f64,
}

impl<'a> Outline<'a> {
    /// `corners` is room for the corners of a rectangle, which stores none.
    pub(crate) fn new(
        shape: &'a Shape2,
        corners: &'a mut [Vec2; 4],
        rotation: Rotation2,
        position: DVec2,
    ) -> Self {
        let (vertices, normals) = match shape {
            Shape2::Rect(rect) => {
                *corners = rect.vertices();
                (corners.as_slice(), Rect::NORMALS.as_slice())
            }
            Shape2::Polygon(polygon) => (polygon.vertices(), polygon.normals()),
        };
        Self { vertices, normals, rotation, position }
    }

    /// A vertex in the frame of the pair.
    #[inline]
    pub(crate) fn point(&self, vertex: usize) -> DVec2 {
        self.position + self.rotation.turn(self.vertices[vertex].as_dvec2())
    }

    /// The vertex after this one, counter-clockwise.
    #[inline]
    pub(crate) fn after(&self, vertex: usize) -> usize {
        if vertex + 1 == self.vertices.len() { 0 } else { vertex + 1 }
    }

    /// The vertex before this one.
    #[inline]
    pub(crate) fn before(&self, vertex: usize) -> usize {
        if vertex == 0 { self.vertices.len() - 1 } else { vertex - 1 }
    }

    /// Outward unit normal of an edge, in the frame of the pair.
    #[inline]
    pub(crate) fn normal(&self, edge: usize) -> DVec2 {
        self.rotation.turn(self.normals[edge]).normalize()
    }

    /// Outward normal of an edge, of any length: enough for a yes or no, and rounded less.
    #[inline]
    pub(crate) fn outward(&self, edge: usize) -> DVec2 {
        let along = self.vertices[self.after(edge)].as_dvec2() - self.vertices[edge].as_dvec2();
        self.rotation.turn(DVec2::new(along.y, -along.x))
    }

    /// Number of edges.
    #[inline]
    pub(crate) fn edge_count(&self) -> usize {
        self.vertices.len()
    }

    /// The vertex furthest along a direction; ties go to the lowest index. Cost: linear in the vertices.
    #[inline]
    pub(crate) fn support(&self, direction: DVec2) -> Support {
        let (c, s) = (f64::from(self.rotation.cos()), f64::from(self.rotation.sin()));
        // The transposed matrix takes the direction to local axes, and scales as the matrix does.
        let local = DVec2::new(c * direction.x + s * direction.y, c * direction.y - s * direction.x);
        let mut best = Support { vertex: 0, reach: f64::NEG_INFINITY };
        for (vertex, point) in self.vertices.iter().enumerate() {
            let reach = local.dot(point.as_dvec2());
            if reach > best.reach {
                best = Support { vertex, reach };
            }
        }
        best.reach += direction.dot(self.position);
        best
    }
}
