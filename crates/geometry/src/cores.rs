//! The cores of shapes, without their rounding: points, segments, polygons, polyhedra.

use crate::cuboid::Cuboid;
use crate::hull::Hull;
use crate::octets::{self, EdgeArc, EdgeOctet, FaceOctet, VertexOctet};
use crate::rect::Rect;
use crate::shape::{Shape2, Shape3};
use crate::topology::Topology;
use crate::triangle::Triangle3;
use core::cell::OnceCell;
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::sync::LazyLock;

/// A few values held here, or a slice of values held elsewhere.
#[derive(Clone, Debug)]
enum Held<'a, T, const N: usize> {
    Few([T; N], usize),
    Many(&'a [T]),
}

impl<T: Copy, const N: usize> Held<'_, T, N> {
    #[inline]
    fn as_slice(&self) -> &[T] {
        match self {
            Self::Few(values, count) => &values[..*count],
            Self::Many(values) => values,
        }
    }
}

/// The core of a shape in the plane: the shape is everything within [`Shape2::radius`] of it.
///
/// A point has one vertex and no edges. A segment has two vertices and two edges, one for each side of it; a polygon
/// has as many edges as vertices, edge `i` from vertex `i` to the next. A half-plane, a compound and a chain have no
/// vertices.
///
/// ```
/// use asunder::{Circle, Segment2, Shape2, glam::{DVec2, Vec2}};
/// let segment = Shape2::from(Segment2::new(Vec2::ZERO, Vec2::X)?);
/// assert_eq!(segment.core().normals(), [DVec2::NEG_Y, DVec2::Y]);
/// let point = Shape2::from(Circle::new(1.0)?);
/// assert_eq!((point.core().vertices(), point.core().normals().len()), (&[Vec2::ZERO][..], 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Core2<'a> {
    vertices: Held<'a, Vec2, 4>,
    normals: Held<'a, DVec2, 2>,
}

/// The core of a shape in space: the shape is everything within [`Shape3::radius`] of it.
///
/// A polyhedron has a normal for each face. A triangle or flat hull has two faces, back to back. A segment has one
/// edge and a point none; both have one face loop and no normals. A half-space, a compound and ground have no vertices.
///
/// ```
/// use asunder::{Capsule3, Shape3, Triangle3, glam::{DVec3, Vec3}};
/// let capsule = Shape3::from(Capsule3::from_half_height(1.0, 0.5)?);
/// assert_eq!((capsule.core().vertices(), capsule.core().normals().len()), (&[Vec3::NEG_Y, Vec3::Y][..], 0));
/// assert_eq!(capsule.core().topology().edges().len(), 1);
/// let triangle = Shape3::from(Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Y)?);
/// assert_eq!(triangle.core().normals(), [DVec3::Z, DVec3::NEG_Z]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Core3<'a>(Kept<'a>);

/// Where the data of a core in space are: a hull keeps its own, for other shapes they are made on demand.
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for one pair, and a frame allocates nothing"
)]
#[derive(Clone, Debug)]
enum Kept<'a> {
    ByHull(&'a Hull),
    Here(Few<'a>),
}

/// The core of a shape that is no hull: up to eight vertices.
#[derive(Clone, Debug)]
struct Few<'a> {
    vertices: Held<'a, Vec3, 8>,
    vertex_octets: Held<'a, VertexOctet, 1>,
    normals: Held<'a, DVec3, 2>,
    heights: Held<'a, f64, 6>,
    face_octets: Held<'a, FaceOctet, 1>,
    /// Half extents of a cuboid. Its edges are made only on demand: they are large, and most pairs do not need them.
    cuboid: Option<Vec3>,
    edge_octets: OnceCell<[EdgeOctet; 2]>,
    /// Arcs of a segment or a triangle, made on demand as well.
    arcs: OnceCell<[EdgeArc; 3]>,
    center: Vec3,
    inner_radius: f32,
    extent: f32,
    topology: &'a Topology,
}

impl<'a> Core2<'a> {
    #[inline]
    pub(crate) fn of(shape: &'a Shape2) -> Self {
        let none = Held::Many(&[]);
        let (vertices, normals) = match shape {
            Shape2::Circle(_) => (Held::Many([Vec2::ZERO].as_slice()), none),
            Shape2::Capsule(capsule) => return Self::of_segment(capsule.segment().ends()),
            Shape2::Segment(segment) => return Self::of_segment(segment.ends()),
            Shape2::Rect(rect) => (Held::Few(rect.vertices(), 4), Held::Many(Rect::NORMALS.as_slice())),
            Shape2::Polygon(polygon) => (Held::Many(polygon.vertices()), Held::Many(polygon.normals())),
            Shape2::HalfPlane(_) | Shape2::Compound(_) | Shape2::Chain(_) => (Held::Many(&[]), none),
        };
        Self { vertices, normals }
    }

    fn of_segment([from, to]: [Vec2; 2]) -> Self {
        let along = to.as_dvec2() - from.as_dvec2();
        let normal = DVec2::new(along.y, -along.x) / along.length();
        Self { vertices: Held::Few([from, to, from, from], 2), normals: Held::Few([normal, -normal], 2) }
    }

    /// The vertices, in metres; those of a polygon counter-clockwise.
    #[inline]
    pub fn vertices(&self) -> &[Vec2] {
        self.vertices.as_slice()
    }

    /// Outward unit normals of the edges, in f64.
    #[inline]
    pub fn normals(&self) -> &[DVec2] {
        self.normals.as_slice()
    }
}

/// Data that all cuboids share.
struct Cube {
    arcs: Box<[EdgeArc]>,
    octets: [EdgeOctet; 2],
}

static CUBE: LazyLock<Cube> = LazyLock::new(|| {
    let corner = |i: usize| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
    let corners: [Vec3; 8] = core::array::from_fn(corner);
    let arcs = EdgeArc::all(&corners, &Cuboid::NORMALS, Cuboid::topology());
    let octets = EdgeOctet::all(&Cuboid::NORMALS, &[1.0; 6], Cuboid::topology());
    Cube { arcs, octets: [octets[0], octets[1]] }
});

impl<'a> Core3<'a> {
    #[inline]
    pub(crate) fn of(shape: &'a Shape3) -> Self {
        match shape {
            Shape3::Hull(hull) => Self(Kept::ByHull(hull)),
            _ => Self(Kept::Here(Few::of(shape))),
        }
    }

    /// The vertices, in metres.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        match &self.0 {
            Kept::ByHull(hull) => hull.vertices(),
            Kept::Here(few) => few.vertices.as_slice(),
        }
    }

    /// The vertices in octets; none if there are no vertices.
    #[inline]
    pub fn vertex_octets(&self) -> &[VertexOctet] {
        match &self.0 {
            Kept::ByHull(hull) => hull.vertex_octets(),
            Kept::Here(few) => few.vertex_octets.as_slice(),
        }
    }

    /// Outward unit normals of the faces, in f64.
    #[inline]
    pub fn normals(&self) -> &[DVec3] {
        match &self.0 {
            Kept::ByHull(hull) => hull.normals(),
            Kept::Here(few) => few.normals.as_slice(),
        }
    }

    /// The support height of the vertices along each face's normal, in metres from the shape's origin.
    ///
    /// ```
    /// use asunder::{Cuboid, Shape3, glam::Vec3};
    /// let block = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 2.0, 3.0))?);
    /// let core = block.core();
    /// assert_eq!(core.extent(), 3.0);
    /// for (normal, &height) in core.normals().iter().zip(core.heights()) {
    ///     let reach = core.vertices().iter().map(|corner| corner.as_dvec3().dot(*normal)).fold(f64::MIN, f64::max);
    ///     assert_eq!(reach, height);
    /// }
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    #[inline]
    pub fn heights(&self) -> &[f64] {
        match &self.0 {
            Kept::ByHull(hull) => hull.heights(),
            Kept::Here(few) => few.heights.as_slice(),
        }
    }

    /// The faces in octets, in f32.
    #[inline]
    pub fn face_octets(&self) -> &[FaceOctet] {
        match &self.0 {
            Kept::ByHull(hull) => hull.face_octets(),
            Kept::Here(few) => few.face_octets.as_slice(),
        }
    }

    /// The edges in octets, by the faces beside them; none for a core without faces, nor for a triangle, whose faces
    /// are back to back.
    #[inline]
    pub fn edge_octets(&self) -> &[EdgeOctet] {
        match &self.0 {
            Kept::ByHull(hull) => hull.edge_octets(),
            Kept::Here(few) => few.edge_octets(),
        }
    }

    /// The arcs of the edges on the Gauss map, in the order of the topology's edges.
    #[inline]
    pub fn arcs(&self) -> &[EdgeArc] {
        match &self.0 {
            Kept::ByHull(hull) => hull.arcs(),
            Kept::Here(few) => few.arcs(),
        }
    }

    /// The shape's centre, as [`Shape3::center`].
    #[inline]
    pub fn center(&self) -> Vec3 {
        match &self.0 {
            Kept::ByHull(hull) => hull.center(),
            Kept::Here(few) => few.center,
        }
    }

    /// Radius in metres of a sphere about the centre that lies inside the core, rounded down. If the centre is not
    /// inside: minus a distance within which there is a point of the core.
    ///
    /// ```
    /// use asunder::{Segment3, Shape3, glam::Vec3};
    /// let segment = Shape3::from(Segment3::new(Vec3::ZERO, Vec3::new(0.1, 0.2, 0.3))?);
    /// assert!(segment.core().inner_radius() < 0.0, "its middle was rounded");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        match &self.0 {
            Kept::ByHull(hull) => hull.core_inner_radius(),
            Kept::Here(few) => few.inner_radius,
        }
    }

    /// The greatest absolute coordinate of any vertex, in metres: rounding errors of products with vertices are
    /// relative to it.
    #[inline]
    pub fn extent(&self) -> f32 {
        match &self.0 {
            Kept::ByHull(hull) => hull.extent(),
            Kept::Here(few) => few.extent,
        }
    }

    /// The half extents, in metres, if it is the core of a cuboid. Vertex `i` is on the upper side of axis `k` if bit
    /// `k` of `i` is set.
    ///
    /// ```
    /// use asunder::{Cuboid, Shape3, glam::Vec3};
    /// let block = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 2.0, 3.0))?);
    /// assert_eq!(block.core().half_extents(), Some(Vec3::new(1.0, 2.0, 3.0)));
    /// assert_eq!(block.core().vertices()[0b101], Vec3::new(1.0, -2.0, 3.0));
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    #[inline]
    pub fn half_extents(&self) -> Option<Vec3> {
        match &self.0 {
            Kept::ByHull(_) => None,
            Kept::Here(few) => few.cuboid,
        }
    }

    /// How vertices, edges and faces are connected.
    #[inline]
    pub fn topology(&self) -> &'a Topology {
        match &self.0 {
            Kept::ByHull(hull) => hull.topology(),
            Kept::Here(few) => few.topology,
        }
    }
}

impl<'a> Few<'a> {
    fn of(shape: &'a Shape3) -> Self {
        match shape {
            Shape3::Sphere(_) => Self::without_faces(&[Vec3::ZERO], Topology::point(), shape),
            Shape3::Capsule(capsule) => {
                Self::without_faces(&capsule.segment().ends(), Topology::segment(), shape)
            }
            Shape3::Segment(segment) => Self::without_faces(&segment.ends(), Topology::segment(), shape),
            Shape3::Triangle(triangle) => Self::of_triangle(triangle, shape),
            Shape3::Cuboid(cuboid) => {
                let (vertices, half) = (cuboid.vertices(), cuboid.half_extents());
                let [x, y, z] = half.as_dvec3().to_array();
                Self {
                    vertex_octets: Held::Few([VertexOctet::of_eight(&vertices)], 1),
                    vertices: Held::Few(vertices, 8),
                    normals: Held::Many(Cuboid::NORMALS.as_slice()),
                    heights: Held::Few([x, x, y, y, z, z], 6),
                    face_octets: Held::Few([FaceOctet::of_cuboid(half)], 1),
                    cuboid: Some(half),
                    edge_octets: OnceCell::new(),
                    arcs: OnceCell::new(),
                    center: Vec3::ZERO,
                    inner_radius: half.min_element(),
                    extent: half.max_element(),
                    topology: Cuboid::topology(),
                }
            }
            Shape3::Hull(_)
            | Shape3::HalfSpace(_)
            | Shape3::Compound(_)
            | Shape3::TriMesh(_)
            | Shape3::HeightField(_) => Self::without_faces(&[], Topology::point(), shape),
        }
    }

    /// The shared arcs of a cuboid; otherwise up to three, made on demand.
    fn arcs(&self) -> &[EdgeArc] {
        if self.cuboid.is_some() {
            return &CUBE.arcs;
        }
        let (edges, normals) = (self.topology.edges().len(), self.normals.as_slice());
        let arc = |edge: usize| match edge < edges {
            true => EdgeArc::of(self.vertices.as_slice(), normals, self.topology, edge),
            false => EdgeArc::NONE,
        };
        let arcs = self.arcs.get_or_init(|| [arc(0), arc(1), arc(2)]);
        arcs.get(..edges).unwrap_or(arcs)
    }

    /// The octets of a cuboid; for cores with fewer edges there are none, as kernels test each edge.
    fn edge_octets(&self) -> &[EdgeOctet] {
        let Some(half) = self.cuboid else { return &[] };
        self.edge_octets.get_or_init(|| EdgeOctet::of_cuboid(&CUBE.octets, half))
    }

    /// A point or a segment; an empty core if there are no vertices.
    fn without_faces(vertices: &[Vec3], topology: &'a Topology, shape: &Shape3) -> Self {
        let first = vertices.first().copied().unwrap_or(Vec3::ZERO);
        let eight = core::array::from_fn(|i| vertices.get(i).copied().unwrap_or(first));
        let octets = usize::from(!vertices.is_empty());
        Self {
            vertices: Held::Few(eight, vertices.len()),
            vertex_octets: Held::Few([VertexOctet::of_eight(&eight)], octets),
            normals: Held::Many(&[]),
            heights: Held::Many(&[]),
            face_octets: Held::Many(&[]),
            cuboid: None,
            edge_octets: OnceCell::new(),
            arcs: OnceCell::new(),
            center: shape.center(),
            inner_radius: beside_center(shape),
            extent: octets::extent(vertices),
            topology,
        }
    }

    fn of_triangle(triangle: &Triangle3, shape: &Shape3) -> Self {
        let topology = Triangle3::topology();
        let [a, b, c] = triangle.vertices();
        let (vertices, normals) = ([a, b, c, a, a, a, a, a], triangle.normals());
        let reach = |normal: DVec3| {
            let height = |vertex: Vec3| normal.dot(vertex.as_dvec3());
            height(a).max(height(b)).max(height(c))
        };
        let heights = [reach(normals[0]), reach(normals[1])];
        let faces = FaceOctet::of_flat(normals[0], heights);
        Self {
            vertex_octets: Held::Few([VertexOctet::of_eight(&vertices)], 1),
            vertices: Held::Few(vertices, 3),
            normals: Held::Few(normals, 2),
            heights: Held::Few([heights[0], heights[1], 0.0, 0.0, 0.0, 0.0], 2),
            face_octets: Held::Few([faces], 1),
            cuboid: None,
            edge_octets: OnceCell::new(),
            arcs: OnceCell::new(),
            center: shape.center(),
            inner_radius: beside_center(shape),
            extent: octets::extent(&vertices[..3]),
            topology,
        }
    }
}

/// Minus the distance that the centre of a shape without volume may lie off it: an f32 rounding of each coordinate.
fn beside_center(shape: &Shape3) -> f32 {
    let center = shape.center().abs().element_sum();
    if center == 0.0 { 0.0 } else { -2.0 * f32::EPSILON * center }
}
