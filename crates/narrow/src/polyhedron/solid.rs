//! A shape as the kernels see it: stored vertices, and how they stand in the frame of the pair.

use crate::counted::count_step;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::ALIGNED_FACES;
use asunder_geometry::{Basis3, Core3, EdgeArc, EdgeOctet, FaceOctet, Topology, VertexOctet};
use wide::f32x8;

/// A core in the frame of a pair: A's axes, about A's position. Most often a polyhedron; a triangle or flat hull has
/// two faces back to back, a segment or point none.
///
/// Vertices are not transformed: a direction is turned into local axes instead, once a projection. That leaves A's
/// coordinates exact and B's with one rounding step less.
pub(crate) struct Solid<'a> {
    core: &'a Core3<'a>,
    pub(crate) vertices: &'a [Vec3],
    pub(super) vertex_octets: &'a [VertexOctet],
    pub(crate) topology: &'a Topology,
    normals: &'a [DVec3],
    heights: &'a [f64],
    pub(super) face_octets: &'a [FaceOctet],
    /// In the shape's own axes, in the order of the topology's edges.
    pub(super) arcs: &'a [EdgeArc],
    pub(super) basis: Basis3,
    /// Whether the frame of the pair is this solid's own, so that nothing needs turning.
    is_home: bool,
    position: DVec3,
    /// The greatest absolute value of a vertex' coordinate.
    pub(super) extent: f32,
    /// The centre that radii are about, in the shape's own axes.
    center: DVec3,
    /// Radius of a sphere about the centre that lies inside the core, in metres; below zero where the centre does not,
    /// by no less than its distance.
    pub(super) inner_radius: f64,
    /// Half of a segment about the centre on which a ball of nearly that radius stays inside, in the shape's own axes.
    inner_arm: Vec3,
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
        Self {
            core,
            vertices: core.vertices(),
            vertex_octets: core.vertex_octets(),
            topology: core.topology(),
            normals: core.normals(),
            heights: core.heights(),
            face_octets: core.face_octets(),
            arcs: core.arcs(),
            is_home: position == DVec3::ZERO && basis.x == DVec3::X && basis.y == DVec3::Y,
            basis,
            position,
            extent: core.extent(),
            center: core.center().as_dvec3(),
            inner_radius: f64::from(core.inner_radius()),
            inner_arm: core.inner_arm(),
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
        self.forth(self.vertices[to].as_dvec3() - self.vertices[from].as_dvec3())
    }

    /// A direction, of any length, that lies between the normals beside an edge, in the frame of the pair: outwards
    /// as seen from there. Zero for a segment, which looks everywhere.
    #[inline]
    pub(crate) fn out_of_edge(&self, half_edge: usize) -> DVec3 {
        let edges = self.topology.half_edges();
        let normal = |half_edge: usize| self.normals.get(edges[half_edge].face as usize);
        let twin = edges[half_edge].twin as usize;
        let (Some(&left), Some(&right)) = (normal(half_edge), normal(twin)) else { return DVec3::ZERO };
        if left.dot(right) < 0.0 {
            // Of faces that are all but back to back the sum is what rounding left of it, and the difference tells.
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
    /// f32 lanes leave out what is lower by more than they can be off; f64 chooses among the rest, so that the
    /// answer is that of `support_one_by_one` to the last bit. 32 vertices: 35 ns one by one, 19 here (AMD EPYC, Zen 4,
    /// 2026-11-21).
    #[inline]
    pub(crate) fn support(&self, direction: DVec3) -> Support {
        let mut best = self.local_support(self.back(direction));
        best.reach += direction.dot(self.position);
        best
    }

    /// [`Solid::support`] in the shape's own axes, from its own origin.
    #[inline]
    pub(super) fn local_support(&self, direction: DVec3) -> Support {
        let lanes = direction.as_vec3();
        let least = self.least_lane(lanes);
        let mut best = Support { vertex: 0, reach: f64::NEG_INFINITY };
        self.for_vertices_from(lanes, least, |vertex, point| {
            let reach = direction.dot(point.as_dvec3());
            if reach > best.reach {
                best = Support { vertex, reach };
            }
        });
        best
    }

    /// Visits the vertices whose lanes come to `least`, ascending.
    #[inline(always)]
    pub(super) fn for_vertices_from(&self, lanes: Vec3, least: f32, mut visit: impl FnMut(usize, Vec3)) {
        for (chunk, octets) in self.vertex_octets.chunks(4).enumerate() {
            let mut near = 0;
            for (place, octet) in octets.iter().enumerate() {
                near |= lanes_from(project(octet, lanes), least) << (8 * place);
            }
            // Most often one. Which it is nobody can guess: no branch asks.
            while near != 0 {
                let vertex = 32 * chunk + near.trailing_zeros() as usize;
                near &= near - 1;
                // Places past the last vertex are not vertices.
                let Some(&point) = self.vertices.get(vertex) else { break };
                visit(vertex, point);
            }
        }
    }

    /// A vertex that is the furthest along a direction of any length up to a rounding of f32; a bound on how far
    /// any of them reaches, and by how much that may exceed the truth. Half the cost of [`Solid::support`], and
    /// less where many are equally far.
    #[inline]
    pub(crate) fn rough_support(&self, direction: DVec3) -> (Support, f64) {
        let lanes = self.back(direction).as_vec3();
        let (best, vertex) = furthest(self.vertex_octets, lanes);
        let doubt = lane_doubt(self.extent, lanes);
        let reach = f64::from(best + doubt) + direction.dot(self.position);
        // What fills up the last eight is the first vertex.
        let vertex = if vertex < self.vertices.len() { vertex } else { 0 };
        (Support { vertex, reach }, 2.0 * f64::from(doubt))
    }

    /// What a vertex' lane comes to at least if the vertex may be the furthest, in the shape's own axes.
    #[inline(always)]
    pub(super) fn least_lane(&self, direction: Vec3) -> f32 {
        highest(self.vertex_octets, direction) - lane_doubt(self.extent, direction)
    }

    /// Whether a face may look along a unit direction up to [`ALIGNED_FACES`]; where none does, this mostly says so. Cost:
    /// linear in the faces, eight at a time.
    #[inline]
    pub(super) fn may_look_along(&self, direction: DVec3) -> bool {
        // Less by more than lanes may be off by, and normals.
        const LEAST: f32 = ALIGNED_FACES as f32 - 1e-6;
        let lanes = self.back(direction).as_vec3();
        let along = |faces: &FaceOctet| dot8([&faces.x, &faces.y, &faces.z], lanes);
        self.face_octets.iter().any(|faces| lanes_from(along(faces), LEAST) != 0)
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
    pub(super) fn center(&self) -> DVec3 {
        self.position + self.forth(self.center)
    }

    /// Half of a segment about the centre on which a ball of [`ARM_SHARE`](asunder_geometry::tolerance::ARM_SHARE) of the inner
    /// radius stays inside, in the frame of the pair.
    #[inline]
    pub(super) fn inner_arm(&self) -> DVec3 {
        self.forth(self.inner_arm.as_dvec3())
    }

    /// A point of the frame in the shape's own axes.
    #[inline]
    pub(super) fn to_local(&self, point: DVec3) -> DVec3 {
        self.back(point - self.position)
    }

    /// How far the shape reaches along the outward normal of one of its faces, in the frame of the pair.
    #[inline]
    pub(crate) fn face_reach(&self, face: usize, normal: DVec3) -> f64 {
        self.heights[face] + normal.dot(self.position)
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

/// How far the lanes of two vertices may be off together, of which no coordinate is greater than `extent`.
#[inline(always)]
fn lane_doubt(extent: f32, direction: Vec3) -> f32 {
    // Conversion, product and two sums: below 4.1 units of 2^-24 of the terms' sum, on both sides; and one each
    // where the doubt, and perhaps a slack, is taken off.
    10.5 * (f32::EPSILON / 2.0) * extent * direction.abs().element_sum()
}

/// No less than how far vertices reach along a direction of any length, all in their own axes: as
/// [`Solid::rough_support`], without the vertex. No coordinate is greater than `extent`.
#[inline]
pub(super) fn bound_of_reach(octets: &[VertexOctet], extent: f32, direction: DVec3) -> f64 {
    let lanes = direction.as_vec3();
    f64::from(highest(octets, lanes) + lane_doubt(extent, lanes))
}

/// Projections of eight vertices.
#[inline(always)]
fn project(octet: &VertexOctet, direction: Vec3) -> [f32; 8] {
    count_step();
    dot8([&octet.x, &octet.y, &octet.z], direction)
}

/// Eight dot products.
#[inline(always)]
fn dot8([x, y, z]: [&[f32; 8]; 3], direction: Vec3) -> [f32; 8] {
    let mut dots = [0.0; 8];
    for (i, dot) in dots.iter_mut().enumerate() {
        *dot = direction.x * x[i] + direction.y * y[i] + direction.z * z[i];
    }
    dots
}

/// The greatest projection, and the vertex that it is of, or a place behind the last; of equals that of the lowest lane.
#[inline(always)]
fn furthest(octets: &[VertexOctet], direction: Vec3) -> (f32, usize) {
    let best = highest(octets, direction);
    let (mut lane, mut place) = (8, 0);
    for (octet, first) in octets.iter().zip((0..).step_by(8)) {
        // Seen once already, and counted.
        let reach = dot8([&octet.x, &octet.y, &octet.z], direction);
        let lowest = lanes_from(reach, best).trailing_zeros() as usize;
        let is_lower = lowest < lane;
        lane = if is_lower { lowest } else { lane };
        place = if is_lower { first } else { place };
    }
    (best, place + lane)
}

/// The greatest projection.
#[inline(always)]
fn highest(octets: &[VertexOctet], direction: Vec3) -> f32 {
    let mut top = [f32::NEG_INFINITY; 8];
    for octet in octets {
        let reach = project(octet, direction);
        for i in 0..8 {
            top[i] = if reach[i] > top[i] { reach[i] } else { top[i] };
        }
    }
    greatest(top)
}

#[inline(always)]
fn greatest(lanes: [f32; 8]) -> f32 {
    let greater = |a: f32, b: f32| if a > b { a } else { b };
    let four: [f32; 4] = core::array::from_fn(|i| greater(lanes[i], lanes[i + 4]));
    greater(greater(four[0], four[2]), greater(four[1], four[3]))
}

/// Which of eight lanes come to `least`: a bit each, the first the lowest.
///
/// Processors have an instruction for it that plain loops do not come to: they make eight shifts, or turn four octets into
/// columns first. [`Solid::support`] takes two thirds of the time with it, a frame of falling hulls 0.91.
#[inline(always)]
fn lanes_from(lanes: [f32; 8], least: f32) -> u32 {
    f32x8::new(lanes).simd_ge(f32x8::splat(least)).to_bitmask()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_lane_has_its_bit() {
        for bits in 0..256 {
            let lanes =
                core::array::from_fn(|i| if bits >> i & 1 == 1 { 2.0 } else { [1.0, f32::NAN][i % 2] });
            assert_eq!(lanes_from(lanes, 2.0), bits);
        }
    }

    #[test]
    fn the_furthest_is_that_of_the_lowest_lane() {
        let mut state = 7_u32;
        // Coarse, so that many are equally far.
        let mut number = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 29) as f32 - 3.5
        };
        let (mut places, mut ties) = ([0; 32], 0);
        for case in 0..4000 {
            let mut eight = || core::array::from_fn(|_| number());
            let octets: Vec<_> =
                (0..=case % 32).map(|_| VertexOctet { x: eight(), y: eight(), z: eight() }).collect();
            let direction = Vec3::new(number(), number(), number());
            let reaches: Vec<f32> = octets.iter().flat_map(|octet| project(octet, direction)).collect();
            let greatest = reaches.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let mut furthest_ones = (0..reaches.len()).filter(|&vertex| reaches[vertex] == greatest);
            ties += usize::from(furthest_ones.clone().count() > 1);
            let lowest = furthest_ones.by_ref().min_by_key(|vertex| (vertex % 8, *vertex)).unwrap();
            assert_eq!(furthest(&octets, direction), (greatest, lowest));
            places[lowest / 8] += 1;
        }
        assert!(ties > 500 && places[..16].iter().all(|&count| count > 10), "{ties}, {places:?}");
    }
}
