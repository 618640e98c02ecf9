//! A shape as the kernels see it: its stored vertices, and their placement in the frame of the pair.

use super::distance::Polytope;
use super::octets::{Along, IN_A_WORD, lanes_from};
use crate::counted::count_step;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::ALIGNED_FACES;
use asunder_geometry::{Basis3, Core3, EdgeArc, EdgeOctet, FaceOctet, Topology, VertexOctet};

/// A core in the frame of a pair: A's axes, about A's position. Most often a polyhedron; a triangle or flat hull has
/// two faces back to back, a segment or point none.
///
/// Vertices are not transformed: a direction is rotated into local axes instead, once for each projection. That leaves
/// A's coordinates exact and B's with one rounding step less.
pub(crate) struct Solid<'a> {
    core: &'a Core3<'a>,
    pub(crate) vertices: &'a [Vec3],
    pub(super) vertex_octets: &'a [VertexOctet],
    pub(crate) topology: &'a Topology,
    normals: &'a [DVec3],
    pub(super) basis: Basis3,
    /// Whether the frame of the pair is this solid's own, so that nothing needs to be rotated.
    is_home: bool,
    is_cuboid: bool,
    position: DVec3,
    /// The greatest absolute value of a vertex' coordinate.
    pub(super) extent: f32,
    /// The centre that radii are about, in the shape's own axes.
    center: DVec3,
    /// Radius of a sphere about the centre that lies inside the core, in metres; negative where the centre is outside,
    /// by at least its distance.
    pub(super) inner_radius: f64,
    /// How far the shape reaches beyond this core. Axes and distances leave it out; contact points lie on the shape.
    pub(crate) radius: f64,
}

/// Up to this many vertices are projected one by one.
const FEW: usize = 4;

/// A support vertex, and how far it reaches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    pub(crate) vertex: usize,
    pub(crate) reach: f64,
}

impl<'a> Solid<'a> {
    pub(crate) fn new(core: &'a Core3<'a>, basis: Basis3, position: DVec3, radius: f64) -> Self {
        Self {
            core,
            vertices: core.vertices(),
            vertex_octets: core.vertex_octets(),
            topology: core.topology(),
            normals: core.normals(),
            is_home: position == DVec3::ZERO && basis.x == DVec3::X && basis.y == DVec3::Y,
            is_cuboid: core.half_extents().is_some(),
            basis,
            position,
            extent: core.extent(),
            center: core.center().as_dvec3(),
            inner_radius: f64::from(core.inner_radius()),
            radius,
        }
    }

    /// From the shape's own axes to those of the pair.
    #[inline(always)]
    fn forth(&self, v: DVec3) -> DVec3 {
        if self.is_home { v } else { self.basis.turn(v) }
    }

    /// From the axes of the pair to the shape's own.
    #[inline(always)]
    fn back(&self, v: DVec3) -> DVec3 {
        if self.is_home { v } else { self.basis.turn_back(v) }
    }

    /// The edges on the Gauss map, in the shape's own axes and in the order of the topology's edges.
    #[inline]
    pub(super) fn arcs(&self) -> &'a [EdgeArc] {
        self.core.arcs()
    }

    /// The faces eight by eight.
    #[inline]
    pub(super) fn face_octets(&self) -> &'a [FaceOctet] {
        self.core.face_octets()
    }

    /// The edges eight by eight, by the faces beside them.
    #[inline]
    pub(super) fn edge_octets(&self) -> &'a [EdgeOctet] {
        self.core.edge_octets()
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
        self.position + self.forth(self.vertices[vertex].as_dvec3())
    }

    /// Outward unit normal of a face, in the frame of the pair.
    #[inline]
    pub(crate) fn normal(&self, face: usize) -> DVec3 {
        self.forth(self.normals[face])
    }

    /// The direction in which the shape's surface lies beyond a face of its core; for a segment, the perpendicular
    /// direction nearest to `towards`, which is of unit length. `None` for a segment that nearly points along
    /// `towards`, and for a point: of those only an end faces that way.
    pub(crate) fn outwards(&self, face: usize, towards: DVec3) -> Option<DVec3> {
        if !self.is_slender() {
            return Some(self.normal(face));
        }
        across_segment(self.point(self.vertices.len() - 1) - self.point(0), towards)
    }

    /// The start and the end of an edge, from its lower half-edge.
    #[inline]
    pub(crate) fn edge(&self, half_edge: usize) -> (DVec3, DVec3) {
        let (from, to) = self.topology.ends(half_edge);
        (self.point(from), self.point(to))
    }

    /// An edge's direction, not normalised. Rotating the difference loses less than subtracting rotated points.
    #[inline]
    pub(crate) fn edge_direction(&self, half_edge: usize) -> DVec3 {
        let (from, to) = self.topology.ends(half_edge);
        self.forth(self.vertices[to].as_dvec3() - self.vertices[from].as_dvec3())
    }

    /// A direction, of any length, that lies between the normals beside an edge, in the frame of the pair: outwards as
    /// seen from there. Zero for a segment, whose arc is its whole great circle.
    #[inline]
    pub(crate) fn out_of_edge(&self, half_edge: usize) -> DVec3 {
        let edges = self.topology.half_edges();
        let normal = |half_edge: usize| self.normals.get(edges[half_edge].face as usize);
        let twin = edges[half_edge].twin as usize;
        let (Some(&left), Some(&right)) = (normal(half_edge), normal(twin)) else { return DVec3::ZERO };
        if left.dot(right) < 0.0 {
            // For faces that are nearly back to back the sum is mostly rounding; the difference is not.
            return self.edge_direction(half_edge).cross(self.forth(left - right));
        }
        self.forth(left + right)
    }

    /// The other shape's axes as this one sees them.
    #[inline]
    pub(super) fn axes_of(&self, other: &Self) -> [DVec3; 3] {
        [self.back(other.basis.x), self.back(other.basis.y), self.back(other.basis.z)]
    }

    /// The vertex furthest along a direction of unit length; ties go to the lowest index. Cost: linear in the vertices.
    ///
    /// f32 lanes discard what is lower by more than their error; f64 chooses among the rest, so that the answer is that
    /// of `support_one_by_one` to the last bit. 32 vertices: 35 ns one by one, 19 here (AMD EPYC, Zen 4, 2026-11-21).
    #[inline]
    pub(crate) fn support(&self, direction: DVec3) -> Support {
        let mut best = self.local_support(self.back(direction));
        best.reach += direction.dot(self.position);
        best
    }

    /// [`Solid::support`] in the shape's own axes, from its own origin.
    #[inline]
    pub(super) fn local_support(&self, direction: DVec3) -> Support {
        if self.vertices.len() <= FEW || self.is_cuboid {
            return self.support_of_few(direction);
        }
        let along = Along::new(direction);
        let least = self.least_lane(&along);
        let mut best = Support { vertex: 0, reach: f64::NEG_INFINITY };
        self.for_vertices_from(&along, least, |vertex, point| {
            let reach = direction.dot(point.as_dvec3());
            if reach > best.reach {
                best = Support { vertex, reach };
            }
        });
        best
    }

    /// [`Solid::local_support`] of a cuboid, by the signs of the direction; of a few vertices, one by one.
    #[inline]
    fn support_of_few(&self, direction: DVec3) -> Support {
        if self.is_cuboid {
            count_step();
            let vertex = corner_along(direction);
            return Support { vertex, reach: direction.dot(self.vertices[vertex].as_dvec3()) };
        }
        let mut best = Support { vertex: 0, reach: f64::NEG_INFINITY };
        for (vertex, point) in self.vertices.iter().enumerate() {
            let reach = direction.dot(point.as_dvec3());
            if reach > best.reach {
                best = Support { vertex, reach };
            }
        }
        best
    }

    /// The vertex of [`Solid::local_support`] without its reach: where no other is as far in f32, no f64 is needed.
    #[inline]
    fn local_furthest(&self, direction: DVec3) -> usize {
        if self.is_cuboid {
            count_step();
            return corner_along(direction);
        }
        match self.vertex_octets {
            [octet] => {
                let only = Along::new(direction).only_of(octet, self.extent);
                only.unwrap_or_else(|| self.local_support(direction).vertex)
            }
            _ => self.furthest_of_many(direction),
        }
    }

    /// [`Solid::local_furthest`] of more than eight vertices. Not inlined: with it, solids of eight took 1.15 times as
    /// long.
    #[inline(never)]
    fn furthest_of_many(&self, direction: DVec3) -> usize {
        let only = Along::new(direction).only(self.vertex_octets, self.extent);
        only.unwrap_or_else(|| self.local_support(direction).vertex)
    }

    /// Visits the vertices whose lanes come to `least`, in ascending order.
    #[inline(always)]
    pub(super) fn for_vertices_from(&self, along: &Along, least: f32, mut visit: impl FnMut(usize, Vec3)) {
        for (chunk, octets) in self.vertex_octets.chunks(IN_A_WORD).enumerate() {
            let mut near = along.those_from(octets, least);
            // Most often one bit. Which one is unpredictable, so no branch depends on it.
            while near != 0 {
                let vertex = 8 * IN_A_WORD * chunk + near.trailing_zeros() as usize;
                near &= near - 1;
                // Lanes past the last vertex are padding.
                let Some(&point) = self.vertices.get(vertex) else { break };
                visit(vertex, point);
            }
        }
    }

    /// A support vertex along a direction of any length, up to the rounding of f32; with an upper bound on how far any
    /// vertex reaches, and by how much that may exceed the truth. Half the cost of [`Solid::support`], and less where
    /// many are equally far.
    #[inline]
    pub(crate) fn rough_support(&self, direction: DVec3) -> (Support, f64) {
        let local = self.back(direction);
        if self.vertices.len() <= FEW || self.is_cuboid {
            let mut best = self.support_of_few(local);
            best.reach += direction.dot(self.position);
            return (best, 0.0);
        }
        let along = Along::new(local);
        let (best, vertex) = along.furthest(self.vertex_octets);
        let doubt = along.doubt(self.extent);
        let reach = f64::from(best + doubt) + direction.dot(self.position);
        // The last octet is padded with the first vertex.
        let vertex = if vertex < self.vertices.len() { vertex } else { 0 };
        (Support { vertex, reach }, 2.0 * f64::from(doubt))
    }

    /// What a vertex' lane must at least come to if the vertex may be the furthest. The direction is in the shape's own
    /// axes.
    #[inline(always)]
    pub(super) fn least_lane(&self, along: &Along) -> f32 {
        along.highest(self.vertex_octets) - along.doubt(self.extent)
    }

    /// Whether a face's normal may lie along a unit direction, up to [`ALIGNED_FACES`]; errs towards yes, never towards
    /// no. Cost: linear in the faces, eight at a time.
    #[inline]
    pub(super) fn may_look_along(&self, direction: DVec3) -> bool {
        // Less by more than the errors of lanes and normals.
        const LEAST: f32 = ALIGNED_FACES as f32 - 1e-6;
        let along = Along::new(self.back(direction));
        let looks = |faces: &FaceOctet| lanes_from(along.dot([&faces.x, &faces.y, &faces.z]), LEAST) != 0;
        self.face_octets().iter().any(looks)
    }

    /// [`Solid::support`] by its definition.
    #[cfg(test)]
    pub(crate) fn support_one_by_one(&self, direction: DVec3) -> Support {
        let local = self.back(direction);
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

    /// A direction of the shape's own axes in the frame of the pair.
    #[inline]
    pub(super) fn turned(&self, direction: DVec3) -> DVec3 {
        self.forth(direction)
    }

    /// A direction of the frame of the pair in the shape's own axes.
    #[inline]
    pub(super) fn turned_back(&self, direction: DVec3) -> DVec3 {
        self.back(direction)
    }

    /// The centre in the frame of the pair.
    #[inline]
    pub(crate) fn center(&self) -> DVec3 {
        self.position + self.forth(self.center)
    }

    /// Radius of a sphere about the centre that lies inside the core, in metres; negative where the centre is outside.
    #[inline]
    pub(crate) const fn inner_radius(&self) -> f64 {
        self.inner_radius
    }

    /// A point of the frame in the shape's own axes.
    #[inline]
    pub(crate) fn to_local(&self, point: DVec3) -> DVec3 {
        self.back(point - self.position)
    }

    /// How far the shape reaches along the outward normal of one of its faces, in the frame of the pair.
    #[inline]
    pub(crate) fn face_reach(&self, face: usize, normal: DVec3) -> f64 {
        self.core.heights()[face] + normal.dot(self.position)
    }

    /// Least and greatest projection on an axis. Cost: linear in the vertices.
    #[cfg(test)]
    pub(crate) fn project(&self, axis: DVec3) -> (f64, f64) {
        let local = self.back(axis);
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

/// [`Solid::outwards`] of a segment, given the vector from one end to the other; `None` for a point.
#[inline]
pub(super) fn across_segment(way: DVec3, towards: DVec3) -> Option<DVec3> {
    let along = way.try_normalize()?;
    let across = towards - along * along.dot(towards);
    (across.length_squared() > 1.0 - ALIGNED_FACES * ALIGNED_FACES).then(|| across.normalize())
}

/// The corner of a cuboid that is furthest along a direction in its own axes; of equals, the lowest.
#[inline(always)]
pub(super) fn corner_along(direction: DVec3) -> usize {
    let is_upper = |along: f64, bit: usize| usize::from(along > 0.0) << bit;
    is_upper(direction.x, 0) | is_upper(direction.y, 1) | is_upper(direction.z, 2)
}

impl Polytope for Solid<'_> {
    #[inline]
    fn furthest(&self, direction: DVec3) -> usize {
        self.local_furthest(self.back(direction))
    }

    #[inline]
    fn point(&self, vertex: usize) -> DVec3 {
        Self::point(self, vertex)
    }
}
