//! A shape as the kernels see it: stored vertices, and how they stand in the frame of the pair.

use super::sat::Arc;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::ALIGNED_FACES;
use asunder_geometry::{Basis3, Core3, Topology};

/// A core in the frame of a pair: A's axes, about A's position. Most often a polyhedron; a triangle or flat hull has
/// two faces back to back, a segment or point none.
///
/// Vertices are not transformed: a direction is turned into local axes instead, once a projection. That leaves A's
/// coordinates exact and B's with one rounding step less.
pub(crate) struct Solid<'a> {
    pub(crate) vertices: &'a [Vec3],
    pub(crate) topology: &'a Topology,
    normals: &'a [DVec3],
    basis: Basis3,
    position: DVec3,
    /// How far the shape reaches beyond this core. Axes and distances leave it out; contact points lie on the shape.
    pub(crate) radius: f64,
}

/// Where a projection is greatest, and how great.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    pub(crate) vertex: usize,
    pub(crate) reach: f64,
}

impl<'a> Solid<'a> {
    pub(crate) fn new(core: &'a Core3<'a>, basis: Basis3, position: DVec3, radius: f64) -> Self {
        let (vertices, topology, normals) = (core.vertices(), core.topology(), core.normals());
        Self { vertices, topology, normals, basis, position, radius }
    }

    /// Number of faces that have a normal.
    #[inline]
    pub(crate) fn face_count(&self) -> usize {
        self.normals.len()
    }

    /// Whether it is a point or a segment.
    #[inline]
    pub(crate) fn is_slender(&self) -> bool {
        self.normals.is_empty()
    }

    /// A vertex in the frame of the pair.
    #[inline]
    pub(crate) fn point(&self, vertex: usize) -> DVec3 {
        self.position + self.basis.turn(self.vertices[vertex].as_dvec3())
    }

    /// Outward unit normal of a face, in the frame of the pair.
    #[inline]
    pub(crate) fn normal(&self, face: usize) -> DVec3 {
        self.basis.turn(self.normals[face])
    }

    /// The direction in which the shape's surface lies beyond a face of its core; beyond a segment, the one across it
    /// that is nearest to `towards`, which is of unit length. Nothing for a segment that all but points there, nor
    /// for a point: nothing of them but the end looks that way.
    pub(crate) fn outwards(&self, face: usize, towards: DVec3) -> Option<DVec3> {
        if !self.is_slender() {
            return Some(self.normal(face));
        }
        let along = (self.point(self.vertices.len() - 1) - self.point(0)).try_normalize()?;
        let across = towards - along * along.dot(towards);
        (across.length_squared() > 1.0 - ALIGNED_FACES * ALIGNED_FACES).then(|| across.normalize())
    }

    /// Where an edge starts and where it leads, from its lower half-edge.
    #[inline]
    pub(crate) fn edge(&self, half_edge: usize) -> (DVec3, DVec3) {
        let (from, to) = self.topology.ends(half_edge);
        (self.point(from), self.point(to))
    }

    /// An edge's direction, not normalised. Turning the difference loses less than subtracting the turned.
    #[inline]
    pub(crate) fn edge_direction(&self, half_edge: usize) -> DVec3 {
        let (from, to) = self.topology.ends(half_edge);
        self.basis.turn(self.vertices[to].as_dvec3() - self.vertices[from].as_dvec3())
    }

    /// An edge's arc on the Gauss map, in the shape's own axes.
    #[inline]
    pub(crate) fn local_arc(&self, half_edge: usize) -> Arc {
        let edge = self.topology.half_edges()[half_edge];
        let twin = self.topology.half_edges()[edge.twin as usize];
        let (from, to) = (self.vertices[edge.origin as usize], self.vertices[twin.origin as usize]);
        let along = to.as_dvec3() - from.as_dvec3();
        if self.is_slender() {
            return Arc { along, ends: [DVec3::ZERO; 2], middle: DVec3::ZERO };
        }
        let ends = [self.normals[edge.face as usize], self.normals[twin.face as usize]];
        // Of faces that are all but back to back the sum is what rounding left of it, and the difference tells.
        let middle = if ends[0].dot(ends[1]) < 0.0 {
            along.cross(ends[0] - ends[1]).normalize()
        } else {
            ends[0] + ends[1]
        };
        Arc { along, ends, middle }
    }

    /// An edge's arc on the Gauss map, in the frame of the pair.
    #[inline]
    pub(crate) fn arc(&self, half_edge: usize) -> Arc {
        self.local_arc(half_edge).map(|v| self.basis.turn(v))
    }

    /// An arc of the other shape, turned into this one's own axes.
    #[inline]
    pub(crate) fn arc_from_frame(&self, arc: Arc) -> Arc {
        arc.map(|v| self.basis.turn_back(v))
    }

    /// The vertex furthest along a direction; ties go to the lowest index. Cost: linear in the vertices.
    #[inline]
    pub(crate) fn support(&self, direction: DVec3) -> Support {
        let local = self.basis.turn_back(direction);
        let mut best = Support { vertex: 0, reach: f64::NEG_INFINITY };
        for (vertex, point) in self.vertices.iter().enumerate() {
            let reach = local.dot(point.as_dvec3());
            if reach > best.reach {
                best = Support { vertex, reach };
            }
        }
        best.reach += direction.dot(self.position);
        best
    }

    /// Least and greatest projection on an axis. Cost: linear in the vertices.
    #[cfg(test)]
    pub(crate) fn project(&self, axis: DVec3) -> (f64, f64) {
        let local = self.basis.turn_back(axis);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for point in self.vertices {
            let reach = local.dot(point.as_dvec3());
            (low, high) = (low.min(reach), high.max(reach));
        }
        let offset = axis.dot(self.position);
        (low + offset, high + offset)
    }

    /// Whether a face index means anything here: hints may be stale.
    pub(crate) fn has_face(&self, face: u32) -> bool {
        (face as usize) < self.normals.len()
    }

    /// Whether an edge index means anything here: hints may be stale.
    pub(crate) fn has_edge(&self, half_edge: u32) -> bool {
        (half_edge as usize) < self.topology.half_edges().len()
    }

    /// The edge between two vertices, by its lower half-edge.
    pub(crate) fn edge_between(&self, one: usize, other: usize) -> Option<usize> {
        let ends = [(one, other), (other, one)];
        self.topology.edges().iter().map(|&e| e as usize).find(|&e| ends.contains(&self.topology.ends(e)))
    }
}
