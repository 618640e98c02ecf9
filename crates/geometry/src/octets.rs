//! A shape's data in groups of eight, in the layout that SIMD kernels load.

use crate::topology::Topology;
use glam::{DVec3, Vec3};

/// Eight vertices side by side, in metres, in order. Places past the last vertex repeat the first, so that kernels need
/// no count.
///
/// ```
/// use asunder::{Shape3, Triangle3, glam::Vec3};
/// let triangle = Shape3::from(Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Y)?);
/// let core = triangle.core();
/// assert_eq!(core.vertex_octets()[0].x, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// # Ok::<(), asunder::VertexError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct VertexOctet {
    /// Coordinates on the x axis.
    pub x: [f32; 8],
    /// Coordinates on the y axis.
    pub y: [f32; 8],
    /// Coordinates on the z axis.
    pub z: [f32; 8],
}

/// Eight faces side by side, in order, rounded to f32: good for proposing candidates, and for discarding them with an
/// error bound, but never a proof. Places past the last face have infinite height, so that nothing is beyond them.
///
/// ```
/// use asunder::{Cuboid, Shape3, glam::Vec3};
/// let cuboid = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 2.0, 3.0))?);
/// let core = cuboid.core();
/// let faces = &core.face_octets()[0];
/// assert_eq!((faces.z[5], faces.height[5], faces.height[6]), (1.0, 3.0, f32::INFINITY));
/// # Ok::<(), asunder::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct FaceOctet {
    /// Outward unit normals, on the x axis.
    pub x: [f32; 8],
    /// Outward unit normals, on the y axis.
    pub y: [f32; 8],
    /// Outward unit normals, on the z axis.
    pub z: [f32; 8],
    /// Support height of the shape along the normal, in metres from its origin.
    pub height: [f32; 8],
}

/// Eight edges side by side, by the faces beside them: in order or, for shapes with many edges, grouped by the
/// direction they face ([`EdgeOctet::SORTED_FROM`]). Places past the last edge have faces of infinite height.
///
/// ```
/// use asunder::{Hull, Shape3, glam::Vec3};
/// let tetrahedron = Shape3::from(Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z])?);
/// let core = tetrahedron.core();
/// let edges = &core.edge_octets()[0];
/// assert_eq!((edges.sides[0].height[5].is_finite(), edges.sides[0].height[6]), (true, f32::INFINITY));
/// assert_eq!(edges.numbers[..6], [0, 1, 2, 3, 4, 5]);
/// # Ok::<(), asunder::HullError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeOctet {
    /// The face of the lower half-edge, and the one beyond.
    pub sides: [FaceOctet; 2],
    /// Cosine of the angle between both normals.
    pub cosine: [f32; 8],
    /// The edges' places in [`Topology::edges`]; zero past the last edge.
    pub numbers: [u16; 8],
}

/// The arc of an edge on the Gauss map, in f32: good for proposing candidates, as [`FaceOctet`].
///
/// ```
/// use asunder::{Cuboid, Shape3, glam::Vec3};
/// let cuboid = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let core = cuboid.core();
/// assert_eq!(core.topology().ends(core.topology().edges()[0] as usize), (0, 4));
/// assert_eq!(core.arcs()[0].along, Vec3::Z);
/// # Ok::<(), asunder::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeArc {
    /// Unit direction of the lower half-edge.
    pub along: Vec3,
    /// Unit normals of both faces, between which the arc runs; that of the lower half-edge's face first. Zero for a
    /// segment, whose arc is a whole great circle.
    pub ends: [Vec3; 2],
    /// A unit direction in the middle of the arc; zero for a segment.
    pub middle: Vec3,
}

impl EdgeArc {
    /// Stands for no edge.
    pub(crate) const NONE: Self = Self { along: Vec3::ZERO, ends: [Vec3::ZERO; 2], middle: Vec3::ZERO };

    /// The arc of an edge, by its lower half-edge.
    pub(crate) fn of(vertices: &[Vec3], normals: &[DVec3], topology: &Topology, half_edge: usize) -> Self {
        let (from, to) = topology.ends(half_edge);
        let along = (vertices[to].as_dvec3() - vertices[from].as_dvec3()).normalize_or_zero();
        let edges = topology.half_edges();
        let normal = |half_edge: usize| normals.get(edges[half_edge].face as usize);
        let twin = edges[half_edge].twin as usize;
        let (Some(&left), Some(&right)) = (normal(half_edge), normal(twin)) else {
            return Self { along: along.as_vec3(), ..Self::NONE };
        };
        // If the faces are nearly back to back, the sum is mere rounding, and the difference gives the middle.
        let middle = if left.dot(right) < 0.0 { along.cross(left - right) } else { left + right };
        Self {
            along: along.as_vec3(),
            ends: [left.as_vec3(), right.as_vec3()],
            middle: middle.normalize_or_zero().as_vec3(),
        }
    }

    /// The arcs of all edges, in their order.
    pub(crate) fn all(vertices: &[Vec3], normals: &[DVec3], topology: &Topology) -> Box<[Self]> {
        let edges = topology.edges().iter();
        edges.map(|&edge| Self::of(vertices, normals, topology, edge as usize)).collect()
    }
}

impl VertexOctet {
    /// Eight vertices, as they are.
    #[inline]
    pub(crate) fn of_eight(vertices: &[Vec3; 8]) -> Self {
        // Not by `map`, which is a call: every cuboid that is used as a polyhedron makes one.
        let mut octet = Self { x: [0.0; 8], y: [0.0; 8], z: [0.0; 8] };
        for (i, vertex) in vertices.iter().enumerate() {
            (octet.x[i], octet.y[i], octet.z[i]) = (vertex.x, vertex.y, vertex.z);
        }
        octet
    }

    /// Any number of vertices, the last octet filled up with the first one.
    pub(crate) fn all(vertices: &[Vec3]) -> Box<[Self]> {
        let first = vertices.first().copied().unwrap_or(Vec3::ZERO);
        let eight = |chunk: &[Vec3]| {
            let at: [Vec3; 8] = core::array::from_fn(|i| chunk.get(i).copied().unwrap_or(first));
            Self::of_eight(&at)
        };
        vertices.chunks(8).map(eight).collect()
    }
}

impl FaceOctet {
    const NONE: Self = Self { x: [0.0; 8], y: [0.0; 8], z: [0.0; 8], height: [f32::INFINITY; 8] };

    fn set(&mut self, i: usize, normal: DVec3, height: f64) {
        let normal = normal.as_vec3();
        (self.x[i], self.y[i], self.z[i], self.height[i]) = (normal.x, normal.y, normal.z, height as f32);
    }

    /// The faces of a polyhedron, by their normals and heights.
    pub(crate) fn all(normals: &[DVec3], heights: &[f64]) -> Box<[Self]> {
        let octet = |(normals, heights): (&[DVec3], &[f64])| {
            let mut octet = Self::NONE;
            for (i, (&normal, &height)) in normals.iter().zip(heights).enumerate() {
                octet.set(i, normal, height);
            }
            octet
        };
        normals.chunks(8).zip(heights.chunks(8)).map(octet).collect()
    }

    /// The six faces of a cuboid.
    #[inline]
    pub(crate) fn of_cuboid(half: Vec3) -> Self {
        let none = f32::INFINITY;
        Self {
            x: [-1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            y: [0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            z: [0.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0],
            height: [half.x, half.x, half.y, half.y, half.z, half.z, none, none],
        }
    }

    /// Two faces back to back.
    #[inline]
    pub(crate) fn of_flat(normal: DVec3, heights: [f64; 2]) -> Self {
        let mut octet = Self::NONE;
        octet.set(0, normal, heights[0]);
        octet.set(1, -normal, heights[1]);
        octet
    }
}

impl EdgeOctet {
    /// From this many edges on, those of a shape are sorted by the direction they face; fewer are in the order of their
    /// numbers.
    ///
    /// A test that discards one edge then mostly discards its neighbours in the octet, too: hulls of 256 vertices, deep
    /// and turned, take 12 % less time.
    pub const SORTED_FROM: usize = 64;

    const NONE: Self = Self { sides: [FaceOctet::NONE; 2], cosine: [1.0; 8], numbers: [0; 8] };

    /// The edges of a polyhedron; none if there are no faces.
    pub(crate) fn all(normals: &[DVec3], heights: &[f64], topology: &Topology) -> Box<[Self]> {
        let half_edges = topology.half_edges();
        let beside = |edge: u16| {
            [edge, half_edges[edge as usize].twin].map(|edge| half_edges[edge as usize].face as usize)
        };
        let normal = |face: usize| normals.get(face).copied().unwrap_or(DVec3::ZERO);
        // Each edge with its place on a curve through all directions.
        let mut order: Vec<(u16, u16)> = (0..).zip(topology.edges()).map(|(number, _)| (0, number)).collect();
        if order.len() >= Self::SORTED_FROM {
            for ((place, _), &edge) in order.iter_mut().zip(topology.edges()) {
                let [left, right] = beside(edge).map(normal);
                *place = place_on_curve((left + right).normalize_or_zero().as_vec3());
            }
            order.sort_unstable();
        }
        let octet = |edges: &[(u16, u16)]| {
            let mut octet = Self::NONE;
            for (i, &(_, number)) in edges.iter().enumerate() {
                octet.numbers[i] = number;
                let faces = beside(topology.edges()[number as usize]);
                let normals = faces.map(normal);
                for (side, (face, normal)) in octet.sides.iter_mut().zip(faces.into_iter().zip(normals)) {
                    side.set(i, normal, heights.get(face).copied().unwrap_or(f64::INFINITY));
                }
                octet.cosine[i] = normals[0].dot(normals[1]) as f32;
            }
            octet
        };
        order.chunks(8).map(octet).collect()
    }

    /// The edges of a cuboid, from those of a unit cube.
    #[inline]
    pub(crate) fn of_cuboid(unit: &[Self; 2], half: Vec3) -> [Self; 2] {
        let mut edges = *unit;
        for side in edges.iter_mut().flat_map(|octet| &mut octet.sides) {
            for i in 0..8 {
                let reach = side.x[i].abs() * half.x + side.y[i].abs() * half.y + side.z[i].abs() * half.z;
                // Places past the last edge stay infinitely high.
                side.height[i] = if side.height[i] < f32::INFINITY { reach } else { side.height[i] };
            }
        }
        edges
    }
}

/// The Z-order code of a direction, its coordinates' bits interleaved, which mostly keeps near directions near (Morton,
/// "A computer oriented geodetic data base", IBM, 1966).
fn place_on_curve(direction: Vec3) -> u16 {
    let cells = direction.to_array().map(|along| ((along + 1.0) * 15.99) as u16);
    let mut place = 0;
    for bit in (0..5).rev() {
        for cell in cells {
            place = place << 1 | (cell >> bit & 1);
        }
    }
    place
}

/// The greatest absolute value of any coordinate.
pub(crate) fn extent(vertices: &[Vec3]) -> f32 {
    vertices.iter().map(|v| v.abs().max_element()).fold(0.0, f32::max)
}

/// The support height of vertices along each normal.
fn heights(vertices: &[Vec3], normals: &[DVec3]) -> Box<[f64]> {
    let reach =
        |normal: &DVec3| vertices.iter().map(|v| normal.dot(v.as_dvec3())).fold(f64::NEG_INFINITY, f64::max);
    normals.iter().map(reach).collect()
}

/// The data of a hull that SIMD kernels load, made once with it.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Octets {
    /// How far the vertices reach along each normal.
    pub(crate) heights: Box<[f64]>,
    pub(crate) vertices: Box<[VertexOctet]>,
    pub(crate) faces: Box<[FaceOctet]>,
    pub(crate) edges: Box<[EdgeOctet]>,
    pub(crate) arcs: Box<[EdgeArc]>,
    /// The greatest absolute value of any coordinate.
    pub(crate) extent: f32,
}

impl Octets {
    pub(crate) fn new(vertices: &[Vec3], normals: &[DVec3], topology: &Topology) -> Self {
        let heights = heights(vertices, normals);
        Self {
            vertices: VertexOctet::all(vertices),
            faces: FaceOctet::all(normals, &heights),
            edges: EdgeOctet::all(normals, &heights, topology),
            arcs: EdgeArc::all(vertices, normals, topology),
            extent: extent(vertices),
            heights,
        }
    }
}
