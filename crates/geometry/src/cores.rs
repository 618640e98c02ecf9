//! What is left of a shape without its rounding: points, segments, polygons, polyhedra.

use crate::cuboid::Cuboid;
use crate::rect::Rect;
use crate::shape::{Shape2, Shape3};
use crate::topology::Topology;
use crate::triangle::Triangle3;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A few values here, or many elsewhere.
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
/// has as many edges as vertices, edge `i` from vertex `i` to the next. A half-plane and a compound have no vertices.
///
/// ```
/// use asunder_geometry::{Circle, Segment2, Shape2, glam::{DVec2, Vec2}};
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
/// edge and a point none; both have one face loop and no normals. A half-space and a compound have no vertices.
///
/// ```
/// use asunder_geometry::{Capsule3, Shape3, Triangle3, glam::{DVec3, Vec3}};
/// let capsule = Shape3::from(Capsule3::from_half_height(1.0, 0.5)?);
/// assert_eq!((capsule.core().vertices(), capsule.core().normals().len()), (&[Vec3::NEG_Y, Vec3::Y][..], 0));
/// assert_eq!(capsule.core().topology().edges().len(), 1);
/// let triangle = Shape3::from(Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Y)?);
/// assert_eq!(triangle.core().normals(), [DVec3::Z, DVec3::NEG_Z]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Core3<'a> {
    vertices: Held<'a, Vec3, 8>,
    normals: Held<'a, DVec3, 2>,
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
            Shape2::HalfPlane(_) | Shape2::Compound(_) => (Held::Many(&[]), none),
        };
        Self { vertices, normals }
    }

    fn of_segment([from, to]: [Vec2; 2]) -> Self {
        let along = to.as_dvec2() - from.as_dvec2();
        let normal = DVec2::new(along.y, -along.x) / along.length();
        Self { vertices: Held::Few([from, to, from, from], 2), normals: Held::Few([normal, -normal], 2) }
    }

    /// The vertices, in metres: of a polygon, counter-clockwise.
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

impl<'a> Core3<'a> {
    pub(crate) fn of(shape: &'a Shape3) -> Self {
        let none = Held::Many(&[]);
        match shape {
            Shape3::Sphere(_) => Self {
                vertices: Held::Many([Vec3::ZERO].as_slice()),
                normals: none,
                topology: Topology::point(),
            },
            Shape3::Capsule(capsule) => Self::of_segment(capsule.segment().ends()),
            Shape3::Segment(segment) => Self::of_segment(segment.ends()),
            Shape3::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices();
                Self {
                    vertices: Held::Few([a, b, c, a, a, a, a, a], 3),
                    normals: Held::Few(triangle.normals(), 2),
                    topology: Triangle3::topology(),
                }
            }
            Shape3::Cuboid(cuboid) => Self {
                vertices: Held::Few(cuboid.vertices(), 8),
                normals: Held::Many(Cuboid::NORMALS.as_slice()),
                topology: Cuboid::topology(),
            },
            Shape3::Hull(hull) => Self {
                vertices: Held::Many(hull.vertices()),
                normals: Held::Many(hull.normals()),
                topology: hull.topology(),
            },
            Shape3::HalfSpace(_) | Shape3::Compound(_) => {
                Self { vertices: Held::Many(&[]), normals: none, topology: Topology::point() }
            }
        }
    }

    fn of_segment([from, to]: [Vec3; 2]) -> Self {
        Self {
            vertices: Held::Few([from, to, from, from, from, from, from, from], 2),
            normals: Held::Many(&[]),
            topology: Topology::segment(),
        }
    }

    /// The vertices, in metres.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        self.vertices.as_slice()
    }

    /// Outward unit normals of the faces, in f64.
    #[inline]
    pub fn normals(&self) -> &[DVec3] {
        self.normals.as_slice()
    }

    /// How vertices, edges and faces meet.
    #[inline]
    pub fn topology(&self) -> &'a Topology {
        self.topology
    }
}
