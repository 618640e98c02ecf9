//! The closed sets of shapes that a body can have, one for each dimension.
//!
//! Every bounded convex shape is a *core* (point, segment, polygon, polyhedron) expanded by a *radius*. The narrow
//! phase knows no other kinds.

use crate::aabb::{Aabb2, Aabb3};
use crate::chain::Chain;
use crate::circle::Circle;
use crate::compound::{Compound2, Compound3, Part2, Part3};
use crate::cores::{Core2, Core3};
use crate::cuboid::Cuboid;
use crate::ground::Ground;
use crate::half_space::{HalfPlane, HalfSpace};
use crate::height_field::HeightField;
use crate::hull::Hull;
use crate::mesh::TriMesh;
use crate::polygon::Polygon;
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use crate::rect::Rect;
use crate::segment::{Capsule2, Capsule3, Segment2, Segment3};
use crate::sphere::Sphere;
use crate::triangle::Triangle3;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A shape in the plane. Cloning is cheap: large data is shared.
///
/// ```
/// use asunder::{Pose2, Rect, Shape2, glam::{DVec2, Vec2}};
/// let shape = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
/// assert!(shape.outer_radius() >= 2_f32.sqrt());
/// assert!(shape.bounds(&Pose2::IDENTITY, 0.0).contains(Vec2::ONE) && shape.contains(Vec2::ONE));
/// assert_eq!(shape.support(DVec2::ONE), Some(DVec2::ONE));
/// assert_eq!((shape.radius(), shape.core().vertices().len()), (0.0, 4));
/// # Ok::<(), asunder::ExtentError>(())
/// ```
///
/// ```
/// // Every kind comes from a type of its own.
/// use asunder::{Capsule2, Chain, Circle, Compound2, HalfPlane, Polygon, Pose2, Rect, Segment2, Shape2, glam::Vec2};
/// let corners = [Vec2::ZERO, Vec2::X, Vec2::Y];
/// let ball = Shape2::from(Circle::new(1.0)?);
/// assert!(matches!(ball, Shape2::Circle(_)));
/// assert!(matches!(Capsule2::new(Vec2::ZERO, Vec2::X, 1.0)?.into(), Shape2::Capsule(_)));
/// assert!(matches!(Rect::from_half_extents(Vec2::ONE)?.into(), Shape2::Rect(_)));
/// assert!(matches!(Polygon::new(&corners)?.into(), Shape2::Polygon(_)));
/// assert!(matches!(HalfPlane::new(Vec2::Y)?.into(), Shape2::HalfPlane(_)));
/// assert!(matches!(Segment2::new(Vec2::ZERO, Vec2::X)?.into(), Shape2::Segment(_)));
/// assert!(matches!(Compound2::new([(Pose2::IDENTITY, ball)])?.into(), Shape2::Compound(_)));
/// assert!(matches!(Chain::open(corners)?.into(), Shape2::Chain(_)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape2 {
    /// A disc.
    Circle(Circle),
    /// Everything within a radius of a segment.
    Capsule(Capsule2),
    /// A rectangle, with or without round corners.
    Rect(Rect),
    /// A convex polygon, with or without round corners.
    Polygon(Polygon),
    /// Everything on one side of a line.
    HalfPlane(HalfPlane),
    /// A segment, without thickness.
    Segment(Segment2),
    /// Several convex parts.
    Compound(Compound2),
    /// A polyline: ground. Bodies of this shape are fixed.
    Chain(Chain),
}

/// A shape in space. Cloning is cheap: large data is shared.
///
/// ```
/// use asunder::{Cuboid, Pose3, Shape3, glam::{DVec3, Vec3}};
/// let shape = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// assert!(shape.outer_radius() >= 3_f32.sqrt());
/// assert!(shape.bounds(&Pose3::IDENTITY, 0.0).contains(Vec3::ONE) && shape.contains(Vec3::ONE));
/// assert_eq!(shape.support(DVec3::ONE), Some(DVec3::ONE));
/// assert_eq!((shape.radius(), shape.core().vertices().len(), shape.is_ground()), (0.0, 8, false));
/// # Ok::<(), asunder::ExtentError>(())
/// ```
///
/// ```
/// // Every kind comes from a type of its own.
/// use asunder::{
///     Capsule3, Compound3, Cuboid, HalfSpace, HeightField, Hull, Pose3, Segment3, Shape3, Sphere, TriMesh, Triangle3,
///     glam::{Vec2, Vec3},
/// };
/// let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
/// let ball = Shape3::from(Sphere::new(1.0)?);
/// assert!(matches!(ball, Shape3::Sphere(_)));
/// assert!(matches!(Capsule3::from_half_height(1.0, 1.0)?.into(), Shape3::Capsule(_)));
/// assert!(matches!(Cuboid::from_half_extents(Vec3::ONE)?.into(), Shape3::Cuboid(_)));
/// assert!(matches!(Hull::from_points(&corners)?.into(), Shape3::Hull(_)));
/// assert!(matches!(HalfSpace::new(Vec3::Y)?.into(), Shape3::HalfSpace(_)));
/// assert!(matches!(Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Y)?.into(), Shape3::Triangle(_)));
/// assert!(matches!(Segment3::new(Vec3::ZERO, Vec3::X)?.into(), Shape3::Segment(_)));
/// assert!(matches!(Compound3::new([(Pose3::IDENTITY, ball)])?.into(), Shape3::Compound(_)));
/// assert!(matches!(TriMesh::new(corners, [[0, 2, 1]])?.into(), Shape3::TriMesh(_)));
/// assert!(matches!(HeightField::new(2, 2, [0.0; 4], Vec2::ONE)?.into(), Shape3::HeightField(_)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape3 {
    /// A ball.
    Sphere(Sphere),
    /// Everything within a radius of a segment.
    Capsule(Capsule3),
    /// A rectangular box, with or without round edges.
    Cuboid(Cuboid),
    /// The convex hull of points, with or without round edges.
    Hull(Hull),
    /// Everything on one side of a plane.
    HalfSpace(HalfSpace),
    /// A triangle, without thickness.
    Triangle(Triangle3),
    /// A segment, without thickness.
    Segment(Segment3),
    /// Several convex parts.
    Compound(Compound3),
    /// A triangle mesh, for levels.
    TriMesh(TriMesh),
    /// Ground with one height above each point of a grid.
    HeightField(HeightField),
}

impl Shape2 {
    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        match self {
            Self::Circle(circle) => circle.bounds(pose, margin),
            Self::Capsule(capsule) => capsule.bounds(pose, margin),
            Self::Rect(rect) => rect.bounds(pose, margin),
            Self::Polygon(polygon) => polygon.bounds(pose, margin),
            Self::HalfPlane(half_plane) => half_plane.bounds(pose, margin),
            Self::Segment(segment) => segment.bounds(pose, margin),
            Self::Compound(compound) => compound.bounds(pose, margin),
            Self::Chain(chain) => chain.bounds(pose, margin),
        }
    }

    /// Local centre of the bounding circle.
    #[inline]
    pub fn center(&self) -> Vec2 {
        match self {
            Self::Capsule(capsule) => capsule.segment().center(),
            Self::Polygon(polygon) => polygon.center(),
            Self::Segment(segment) => segment.center(),
            Self::Compound(compound) => compound.center(),
            Self::Chain(chain) => chain.center(),
            Self::Circle(_) | Self::Rect(_) | Self::HalfPlane(_) => Vec2::ZERO,
        }
    }

    /// Bounding radius about [`Shape2::center`], in metres, rounded up. Tolerances of a pair are relative to the sum
    /// of two. Infinite for a half-plane.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        match self {
            Self::Circle(circle) => circle.radius(),
            Self::Capsule(capsule) => capsule.outer_radius(),
            Self::Rect(rect) => rect.outer_radius(),
            Self::Polygon(polygon) => polygon.outer_radius(),
            Self::HalfPlane(_) => f32::INFINITY,
            Self::Segment(segment) => segment.outer_radius(),
            Self::Compound(compound) => compound.outer_radius(),
            Self::Chain(chain) => chain.outer_radius(),
        }
    }

    /// Radius of the rounding, in metres: how far the shape reaches beyond its core.
    #[inline]
    pub fn radius(&self) -> f32 {
        match self {
            Self::Circle(circle) => circle.radius(),
            Self::Capsule(capsule) => capsule.radius(),
            Self::Rect(rect) => rect.radius(),
            Self::Polygon(polygon) => polygon.radius(),
            Self::HalfPlane(_) | Self::Segment(_) | Self::Compound(_) | Self::Chain(_) => 0.0,
        }
    }

    /// Whether it is ground, on which bodies stand and which is always fixed: a chain. Two of them have no contacts.
    ///
    /// ```
    /// use asunder::{Chain, Circle, Shape2, glam::Vec2};
    /// let ground = Shape2::from(Chain::open([Vec2::X, Vec2::ZERO])?);
    /// assert!(ground.is_ground() && !Shape2::from(Circle::new(1.0)?).is_ground());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub const fn is_ground(&self) -> bool {
        matches!(self, Self::Chain(_))
    }

    /// The shape without its rounding. A half-plane, a compound and a chain have no core: theirs has no vertices.
    #[inline]
    pub fn core(&self) -> Core2<'_> {
        Core2::of(self)
    }

    /// Whether the closed shape contains a local point, in metres (`Vec2`, `DVec2`); false for NaN. Cost: linear in the
    /// vertices; for a chain, in those near the point.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        self.holds(point.into())
    }

    fn holds(&self, point: DVec2) -> bool {
        match self {
            Self::Circle(circle) => circle.contains(point),
            Self::Capsule(capsule) => capsule.contains(point),
            Self::Rect(rect) => rect.contains(point),
            Self::Polygon(polygon) => polygon.contains(point),
            Self::HalfPlane(half_plane) => half_plane.contains(point),
            Self::Segment(segment) => segment.contains(point),
            Self::Compound(compound) => compound.contains(point),
            Self::Chain(chain) => chain.contains(point),
        }
    }

    /// The support point: the local point furthest along a direction of any length, in metres; among equals, the first
    /// vertex. `None` for a half-plane, or a direction that is zero or not finite. Cost: linear in the vertices.
    pub fn support(&self, direction: impl Into<DVec2>) -> Option<DVec2> {
        self.furthest_along(direction.into())
    }

    fn furthest_along(&self, direction: DVec2) -> Option<DVec2> {
        // Divided by the largest component first, since squares of very long or very short vectors leave the range of
        // f64.
        let along = (direction / direction.abs().max_element()).try_normalize()?;
        if let Self::Chain(chain) = self {
            return chain.furthest(along);
        }
        if let Self::Compound(compound) = self {
            let of_part = |part: &Part2| {
                let core = part.shape().core();
                let vertices = core.vertices().iter().map(|&vertex| part.pose().transform(vertex));
                let vertex = furthest(vertices, |vertex| vertex.dot(along))?;
                Some(vertex + along * f64::from(part.shape().radius()))
            };
            return furthest(compound.parts().iter().filter_map(of_part), |point| point.dot(along));
        }
        let core = self.core();
        let vertex = furthest(core.vertices().iter().map(|vertex| vertex.as_dvec2()), |v| v.dot(along))?;
        Some(vertex + along * f64::from(self.radius()))
    }
}

impl Shape3 {
    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        match self {
            Self::Sphere(sphere) => sphere.bounds(pose, margin),
            Self::Capsule(capsule) => capsule.bounds(pose, margin),
            Self::Cuboid(cuboid) => cuboid.bounds(pose, margin),
            Self::Hull(hull) => hull.bounds(pose, margin),
            Self::HalfSpace(half_space) => half_space.bounds(pose, margin),
            Self::Triangle(triangle) => triangle.bounds(pose, margin),
            Self::Segment(segment) => segment.bounds(pose, margin),
            Self::Compound(compound) => compound.bounds(pose, margin),
            Self::TriMesh(mesh) => mesh.bounds(pose, margin),
            Self::HeightField(field) => field.bounds(pose, margin),
        }
    }

    /// Local centre of the bounding sphere.
    pub fn center(&self) -> Vec3 {
        match self {
            Self::Capsule(capsule) => capsule.segment().center(),
            Self::Hull(hull) => hull.center(),
            Self::Triangle(triangle) => triangle.center(),
            Self::Segment(segment) => segment.center(),
            Self::Compound(compound) => compound.center(),
            Self::TriMesh(mesh) => mesh.center(),
            Self::HeightField(field) => field.center(),
            Self::Sphere(_) | Self::Cuboid(_) | Self::HalfSpace(_) => Vec3::ZERO,
        }
    }

    /// Bounding radius about [`Shape3::center`], in metres, rounded up. Tolerances of a pair are relative to the sum
    /// of two. Infinite for a half-space.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        match self {
            Self::Sphere(sphere) => sphere.radius(),
            Self::Capsule(capsule) => capsule.outer_radius(),
            Self::Cuboid(cuboid) => cuboid.outer_radius(),
            Self::Hull(hull) => hull.outer_radius(),
            Self::HalfSpace(_) => f32::INFINITY,
            Self::Triangle(triangle) => triangle.outer_radius(),
            Self::Segment(segment) => segment.outer_radius(),
            Self::Compound(compound) => compound.outer_radius(),
            Self::TriMesh(mesh) => mesh.outer_radius(),
            Self::HeightField(field) => field.outer_radius(),
        }
    }

    /// Radius of the rounding, in metres: how far the shape reaches beyond its core.
    #[inline]
    pub fn radius(&self) -> f32 {
        match self {
            Self::Sphere(sphere) => sphere.radius(),
            Self::Capsule(capsule) => capsule.radius(),
            Self::Cuboid(cuboid) => cuboid.radius(),
            Self::Hull(hull) => hull.radius(),
            Self::HalfSpace(_) | Self::Triangle(_) | Self::Segment(_) | Self::Compound(_) => 0.0,
            Self::TriMesh(_) | Self::HeightField(_) => 0.0,
        }
    }

    /// Whether it is ground, a triangle mesh or a height field. Bodies with such a shape are always fixed.
    #[inline]
    pub const fn is_ground(&self) -> bool {
        matches!(self, Self::TriMesh(_) | Self::HeightField(_))
    }

    /// The shape without its rounding. A half-space, a compound and ground have no core: theirs has no vertices.
    #[inline]
    pub fn core(&self) -> Core3<'_> {
        Core3::of(self)
    }

    /// Whether the closed shape contains a local point, in metres (`Vec3`, `DVec3`); false for NaN. Cost: linear in the
    /// vertices.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        self.holds(point.into())
    }

    fn holds(&self, point: DVec3) -> bool {
        match self {
            Self::Sphere(sphere) => sphere.contains(point),
            Self::Capsule(capsule) => capsule.contains(point),
            Self::Cuboid(cuboid) => cuboid.contains(point),
            Self::Hull(hull) => hull.contains(point),
            Self::HalfSpace(half_space) => half_space.contains(point),
            Self::Triangle(triangle) => triangle.contains(point),
            Self::Segment(segment) => segment.contains(point),
            Self::Compound(compound) => compound.contains(point),
            Self::TriMesh(mesh) => mesh.contains(point),
            Self::HeightField(field) => field.contains(point),
        }
    }

    /// The support point: the local point furthest along a direction of any length, in metres; among equals, the first
    /// vertex. `None` for a half-space, or a direction that is zero or not finite. Cost: linear in the vertices.
    pub fn support(&self, direction: impl Into<DVec3>) -> Option<DVec3> {
        self.furthest_along(direction.into())
    }

    fn furthest_along(&self, direction: DVec3) -> Option<DVec3> {
        // Divided by the largest component first, since squares of very long or very short vectors leave the range of
        // f64.
        let along = (direction / direction.abs().max_element()).try_normalize()?;
        if let Self::Compound(compound) = self {
            let of_part = |part: &Part3| {
                let core = part.shape().core();
                let vertices = core.vertices().iter().map(|&vertex| part.pose().transform(vertex));
                let vertex = furthest(vertices, |vertex| vertex.dot(along))?;
                Some(vertex + along * f64::from(part.shape().radius()))
            };
            return furthest(compound.parts().iter().filter_map(of_part), |point| point.dot(along));
        }
        if let Some(ground) = Ground::of(self) {
            let of_triangle = |triangle| {
                let vertices = ground.triangle(triangle)?.vertices().map(|vertex| vertex.as_dvec3());
                furthest(vertices.into_iter(), |vertex| vertex.dot(along))
            };
            return furthest((0..ground.triangle_count()).filter_map(of_triangle), |point| point.dot(along));
        }
        let core = self.core();
        let vertex = furthest(core.vertices().iter().map(|vertex| vertex.as_dvec3()), |v| v.dot(along))?;
        Some(vertex + along * f64::from(self.radius()))
    }
}

/// The first of the points with the greatest reach.
fn furthest<V: Copy>(points: impl Iterator<Item = V>, reach: impl Fn(V) -> f64) -> Option<V> {
    let mut best: Option<(f64, V)> = None;
    for point in points {
        let found = reach(point);
        if best.is_none_or(|(known, _)| found > known) {
            best = Some((found, point));
        }
    }
    best.map(|(_, point)| point)
}

impl From<Circle> for Shape2 {
    fn from(circle: Circle) -> Self {
        Self::Circle(circle)
    }
}

impl From<Capsule2> for Shape2 {
    fn from(capsule: Capsule2) -> Self {
        Self::Capsule(capsule)
    }
}

impl From<Rect> for Shape2 {
    fn from(rect: Rect) -> Self {
        Self::Rect(rect)
    }
}

impl From<Polygon> for Shape2 {
    fn from(polygon: Polygon) -> Self {
        Self::Polygon(polygon)
    }
}

impl From<HalfPlane> for Shape2 {
    fn from(half_plane: HalfPlane) -> Self {
        Self::HalfPlane(half_plane)
    }
}

impl From<Segment2> for Shape2 {
    fn from(segment: Segment2) -> Self {
        Self::Segment(segment)
    }
}

impl From<Compound2> for Shape2 {
    fn from(compound: Compound2) -> Self {
        Self::Compound(compound)
    }
}

impl From<Chain> for Shape2 {
    fn from(chain: Chain) -> Self {
        Self::Chain(chain)
    }
}

impl From<Sphere> for Shape3 {
    fn from(sphere: Sphere) -> Self {
        Self::Sphere(sphere)
    }
}

impl From<Capsule3> for Shape3 {
    fn from(capsule: Capsule3) -> Self {
        Self::Capsule(capsule)
    }
}

impl From<Cuboid> for Shape3 {
    fn from(cuboid: Cuboid) -> Self {
        Self::Cuboid(cuboid)
    }
}

impl From<Hull> for Shape3 {
    fn from(hull: Hull) -> Self {
        Self::Hull(hull)
    }
}

impl From<HalfSpace> for Shape3 {
    fn from(half_space: HalfSpace) -> Self {
        Self::HalfSpace(half_space)
    }
}

impl From<Triangle3> for Shape3 {
    fn from(triangle: Triangle3) -> Self {
        Self::Triangle(triangle)
    }
}

impl From<Segment3> for Shape3 {
    fn from(segment: Segment3) -> Self {
        Self::Segment(segment)
    }
}

impl From<TriMesh> for Shape3 {
    fn from(mesh: TriMesh) -> Self {
        Self::TriMesh(mesh)
    }
}

impl From<HeightField> for Shape3 {
    fn from(field: HeightField) -> Self {
        Self::HeightField(field)
    }
}

impl From<Compound3> for Shape3 {
    fn from(compound: Compound3) -> Self {
        Self::Compound(compound)
    }
}
