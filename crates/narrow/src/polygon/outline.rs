//! A shape as the kernels see it: stored vertices, and how they stand in the frame of the pair.

use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Core2, Rotation2};

/// A rotation by its matrix [c -s; s c], in f64: the stored one of a body, or its product with a part's.
///
/// The stored pair is of unit length only up to rounding, and so the matrix scales by as much: that is part of the true
/// shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    cos: f64,
    sin: f64,
}

impl Turn {
    pub(crate) fn of(rotation: Rotation2) -> Self {
        Self { cos: f64::from(rotation.cos()), sin: f64::from(rotation.sin()) }
    }

    /// A vector turned.
    #[inline]
    pub(crate) fn turn(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// A direction turned by the transposed matrix: back to local axes, scaled as the matrix scales.
    #[inline]
    pub(crate) fn turn_back(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }

    /// The matrix of a part that is turned by `local` inside a body that is turned by this.
    pub(crate) fn of_part(&self, local: Rotation2) -> Self {
        let turned = self.turn(DVec2::new(f64::from(local.cos()), f64::from(local.sin())));
        Self { cos: turned.x, sin: turned.y }
    }
}

/// A core in the frame of a pair: the world's axes, about A's position. Most often a polygon; a segment has two edges
/// back to back, a point none.
///
/// The stored rotation is within rounding of one and not exactly one, so turned normals are normalised again and
/// both shapes are turned, where in space a relative rotation would do.
pub(crate) struct Outline<'a> {
    pub(crate) vertices: &'a [Vec2],
    normals: &'a [DVec2],
    turn: Turn,
    position: DVec2,
    /// How far the shape reaches beyond this core. Axes and distances leave it out; contact points lie on the shape.
    pub(crate) radius: f64,
}

/// Where a projection is greatest, and how great.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    pub(crate) vertex: usize,
    pub(crate) reach: f64,
}

impl<'a> Outline<'a> {
    pub(crate) fn new(core: &'a Core2<'a>, turn: Turn, position: DVec2, radius: f64) -> Self {
        Self { vertices: core.vertices(), normals: core.normals(), turn, position, radius }
    }

    /// Whether it has no inside: a point or a segment.
    #[inline]
    pub(crate) fn is_flat(&self) -> bool {
        self.vertices.len() <= 2
    }

    /// A vertex in the frame of the pair.
    #[inline]
    pub(crate) fn point(&self, vertex: usize) -> DVec2 {
        self.position + self.turn.turn(self.vertices[vertex].as_dvec2())
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
        self.turn.turn(self.normals[edge]).normalize()
    }

    /// Outward normal of an edge, of any length: enough for a yes or no, and rounded less.
    #[inline]
    pub(crate) fn outward(&self, edge: usize) -> DVec2 {
        let along = self.vertices[self.after(edge)].as_dvec2() - self.vertices[edge].as_dvec2();
        self.turn.turn(DVec2::new(along.y, -along.x))
    }

    /// Number of edges: none of a point, two of a segment.
    #[inline]
    pub(crate) fn edge_count(&self) -> usize {
        self.normals.len()
    }

    /// The vertex furthest along a direction; ties go to the lowest index. Cost: linear in the vertices.
    #[inline]
    pub(crate) fn support(&self, direction: DVec2) -> Support {
        let local = self.turn.turn_back(direction);
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
