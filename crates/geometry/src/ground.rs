//! Ground made of triangles: the common interface of meshes and height fields.

pub(crate) mod bend;
mod read;
pub(crate) mod slab;
#[cfg(test)]
mod tests;
pub(crate) mod tree;

pub use read::NearTriangle;

use crate::aabb::Aabb3;
use crate::height_field::HeightField;
use crate::mesh::TriMesh;
use crate::shape::Shape3;
use crate::triangle::Triangle3;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};
use slab::Slab;
use tree::{Line, Near};

/// Ground made of numbered triangles: a mesh or a height field.
///
/// Half-edge `i` of a triangle goes from its corner `i` to the next. Vertices are numbered, too; equal points of a mesh
/// share one number.
///
/// ```
/// use asunder::{Aabb3, Ground, Shape3, TriMesh, glam::Vec3};
/// use core::ops::ControlFlow;
/// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
/// let shape = Shape3::from(mesh);
/// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
/// assert_eq!((ground.triangle_count(), ground.is_one_sided()), (2, false));
/// assert_eq!(ground.corners(1), [Vec3::X, Vec3::Z, Vec3::ONE]);
/// assert_eq!(ground.triangle(1).map(|triangle| triangle.vertices()), Some(ground.corners(1)));
/// assert_eq!((ground.vertex_numbers(1), ground.neighbor(0, 1)), ([1, 2, 3], Some((1, 0))));
/// let mut seen = vec![];
/// let _ = ground.visit_near(&Aabb3::new(Vec3::splat(0.9), Vec3::splat(2.0)), |triangle| {
///     seen.push((triangle, ground.patch(triangle), ground.prominent(triangle).any_edge(true)));
///     ControlFlow::Continue(())
/// });
/// assert_eq!(seen, [(1, 1, true)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Ground<'a> {
    /// A triangle mesh.
    Mesh(&'a TriMesh),
    /// A height field.
    Field(&'a HeightField),
}

/// Which edges and corners of a triangle may give a contact a normal other than the triangle's: those at which the
/// ground bends away from the body, or ends. It also shows whether some edge has so low a bend that all normals along
/// it count as the triangle's. Conservative: a bit may be set needlessly.
///
/// ```
/// use asunder::Prominent;
/// let all = Prominent::ALL;
/// assert!(all.edge(0, true) && all.corner(2, false) && all.any(true) && all.any_edge(false));
/// let none = Prominent::NONE.with_edge(1, true);
/// assert!(none.edge(1, true) && !none.edge(1, false) && !none.corner(1, true) && !none.any(false));
/// assert!(none.with_corner(1, false).corner(1, false));
/// assert!(none.with_low_bend().bends_low() && !all.bends_low() && !Prominent::NONE.with_low_bend().any(true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Prominent(u16);

impl Prominent {
    /// No edge and no corner.
    pub const NONE: Self = Self(0);
    /// Every edge and corner, seen from either side, none with a low bend.
    pub const ALL: Self = Self(0xFFF);

    const LOW_BEND: u16 = 1 << 12;

    pub(crate) const fn bits(self) -> u16 {
        self.0
    }

    pub(crate) const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    const fn edge_bit(edge: usize, is_front: bool) -> u16 {
        1 << (edge % 3 + if is_front { 0 } else { 6 })
    }

    const fn corner_bit(corner: usize, is_front: bool) -> u16 {
        1 << (corner % 3 + if is_front { 3 } else { 9 })
    }

    /// Adds one edge, seen from the front or the back.
    #[must_use]
    pub const fn with_edge(self, edge: usize, is_front: bool) -> Self {
        Self(self.0 | Self::edge_bit(edge, is_front))
    }

    /// Adds one corner, seen from the front or the back.
    #[must_use]
    pub const fn with_corner(self, corner: usize, is_front: bool) -> Self {
        Self(self.0 | Self::corner_bit(corner, is_front))
    }

    /// Adds the note that an edge has a low bend.
    #[must_use]
    pub const fn with_low_bend(self) -> Self {
        Self(self.0 | Self::LOW_BEND)
    }

    /// Whether an edge bends by more than rounding, but by so little that all normals between those of its triangles
    /// count as equal.
    #[inline]
    pub const fn bends_low(self) -> bool {
        self.0 & Self::LOW_BEND != 0
    }

    /// Whether an edge may matter to a body in front, or behind.
    #[inline]
    pub const fn edge(self, edge: usize, is_front: bool) -> bool {
        self.0 & Self::edge_bit(edge, is_front) != 0
    }

    /// Whether a corner may matter to a body in front, or behind.
    #[inline]
    pub const fn corner(self, corner: usize, is_front: bool) -> bool {
        self.0 & Self::corner_bit(corner, is_front) != 0
    }

    /// Whether any edge may matter.
    #[inline]
    pub const fn any_edge(self, is_front: bool) -> bool {
        self.0 & (if is_front { 0o7 } else { 0o700 }) != 0
    }

    /// Whether any edge or corner may matter.
    #[inline]
    pub const fn any(self, is_front: bool) -> bool {
        self.0 & (if is_front { 0o77 } else { 0o7700 }) != 0
    }
}

impl<'a> Ground<'a> {
    /// The shape as ground, if it is a mesh or a height field.
    #[inline]
    pub fn of(shape: &'a Shape3) -> Option<Self> {
        match shape {
            Shape3::TriMesh(mesh) => Some(Self::Mesh(mesh)),
            Shape3::HeightField(field) => Some(Self::Field(field)),
            _ => None,
        }
    }

    /// Whether it is solid only from the front, from which the vertices of a triangle wind counter-clockwise.
    #[inline]
    pub fn is_one_sided(self) -> bool {
        match self {
            Self::Mesh(mesh) => mesh.is_one_sided(),
            Self::Field(field) => field.is_one_sided(),
        }
    }

    /// A bound that all triangle numbers are below. Some numbers below it may have no triangle: holes, and dropped
    /// triangles.
    #[inline]
    pub fn triangle_count(self) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangle_count(),
            Self::Field(field) => field.triangle_count(),
        }
    }

    /// The corners of a triangle, in metres and local axes; arbitrary for a number without a triangle.
    #[inline]
    pub fn corners(self, triangle: u32) -> [glam::Vec3; 3] {
        match self {
            Self::Mesh(mesh) => mesh.corners(triangle),
            Self::Field(field) => field.corners(triangle),
        }
    }

    /// A triangle by its number; `None` if the number has none.
    #[inline]
    pub fn triangle(self, triangle: u32) -> Option<Triangle3> {
        match self {
            Self::Mesh(mesh) => mesh.triangle(triangle),
            Self::Field(field) => field.triangle(triangle),
        }
    }

    /// The numbers of a triangle's vertices, in the order of its corners.
    #[inline]
    pub fn vertex_numbers(self, triangle: u32) -> [u32; 3] {
        match self {
            Self::Mesh(mesh) => mesh.vertex_numbers(triangle),
            Self::Field(field) => field.vertex_numbers(triangle),
        }
    }

    /// The triangle on the other side of a half-edge, and which of its half-edges is the twin. `None` where the ground
    /// ends, where more than two triangles meet, or where two meet that wind differently.
    #[inline]
    pub fn neighbor(self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        match self {
            Self::Mesh(mesh) => mesh.neighbor(triangle, edge),
            Self::Field(field) => field.neighbor(triangle, edge),
        }
    }

    /// Which edges and corners may give normals other than the triangle's.
    #[inline]
    pub fn prominent(self, triangle: u32) -> Prominent {
        match self {
            Self::Mesh(mesh) => mesh.prominent(triangle),
            Self::Field(field) => field.prominent(triangle),
        }
    }

    /// The patch of a triangle: the least number of the connected triangles that lie in one plane with it.
    #[inline]
    pub fn patch(self, triangle: u32) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.patch(triangle),
            Self::Field(field) => field.patch(triangle),
        }
    }

    /// Passes every triangle whose box overlaps `bounds`, in local axes, to `visitor`, each once, until it breaks off.
    /// The order depends only on the ground and the box. Cost: logarithmic in the triangles, and linear in those that
    /// are passed.
    #[inline]
    pub fn visit_near(self, bounds: &Aabb3, visitor: impl FnMut(u32) -> ControlFlow<()>) -> ControlFlow<()> {
        match self {
            Self::Mesh(mesh) => mesh.visit_near(bounds, visitor),
            Self::Field(field) => field.visit_near(bounds, visitor),
        }
    }

    /// Passes every triangle whose box a moving box meets to `visitor`, each once and roughly in the order of meeting,
    /// up to a limit that `visitor` may lower: it returns the new one.
    ///
    /// The moving box has its centre at `from` and half extents `grown`, in metres and local axes; zero for a ray. It
    /// moves along `direction`, of any length, by `limit` lengths of it. Boxes are widened by more than rounding, so
    /// that none is missed. The order depends only on the ground and the query. If any number is not finite, nothing is
    /// met.
    ///
    /// ```
    /// use asunder::{Ground, Shape3, TriMesh, glam::{DVec3, Vec3}};
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
    /// let shape = Shape3::from(mesh);
    /// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
    /// let mut met = vec![];
    /// ground.visit_along(DVec3::new(0.1, 2.0, 0.1), DVec3::NEG_Y, Vec3::ZERO, 10.0, |triangle| {
    ///     met.push(triangle);
    ///     1.5
    /// });
    /// assert_eq!(met, [1], "its box is met first, and the other's is beyond the limit");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_along(
        self,
        from: DVec3,
        direction: DVec3,
        grown: Vec3,
        limit: f64,
        mut visitor: impl FnMut(u32) -> f64,
    ) {
        self.meet_along([from, direction], grown, limit, |number, _| visitor(number));
    }

    /// Like [`visit_along`](Self::visit_along), but also hands over each triangle's [`corners`](Self::corners), at the
    /// same cost with fewer cache misses.
    ///
    /// ```
    /// use asunder::{Ground, Shape3, TriMesh, glam::{DVec3, Vec3}};
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
    /// let shape = Shape3::from(mesh);
    /// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
    /// ground.read_along(DVec3::new(0.1, 2.0, 0.1), DVec3::NEG_Y, Vec3::ZERO, 10.0, |triangle, corners| {
    ///     assert_eq!(corners, ground.corners(triangle));
    ///     10.0
    /// });
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn read_along(
        self,
        from: DVec3,
        direction: DVec3,
        grown: Vec3,
        limit: f64,
        mut visitor: impl FnMut(u32, [Vec3; 3]) -> f64,
    ) {
        self.meet_along([from, direction], grown, limit, |number, corners| {
            visitor(number, self.known_or_read(number, corners))
        });
    }

    /// The corners of a triangle: those that came with its box, or else read.
    #[inline]
    fn known_or_read(self, number: u32, corners: Option<[Vec3; 3]>) -> [Vec3; 3] {
        match corners {
            Some(corners) => corners,
            None => self.corners(number),
        }
    }

    #[inline]
    fn meet_along(
        self,
        [from, direction]: [DVec3; 2],
        grown: Vec3,
        limit: f64,
        mut visitor: impl FnMut(u32, Option<[Vec3; 3]>) -> f64,
    ) {
        let Some(line) = Line::new(from, direction, grown) else { return };
        match self {
            Self::Mesh(mesh) => mesh.tree().visit_in_order(&line, limit, visitor),
            Self::Field(field) => {
                let Some(slab) = Slab::new(from, direction, grown) else { return };
                let visitor = |number| visitor(number, None);
                field.visit_along(&line, &slab, limit, visitor);
            }
        }
    }

    /// Hands every triangle whose box is within `limit` metres of this one, in local axes, to `visitor`, each once and
    /// roughly the nearest first, up to a limit that `visitor` may lower: it returns the new one. The order depends
    /// only on the ground and the query.
    ///
    /// ```
    /// use asunder::{Aabb3, Ground, Shape3, TriMesh, glam::Vec3};
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
    /// let shape = Shape3::from(mesh);
    /// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
    /// let mut near = vec![];
    /// ground.visit_nearest(&Aabb3::new(Vec3::splat(-2.0), Vec3::splat(-1.0)), f64::INFINITY, |triangle| {
    ///     near.push(triangle);
    ///     f64::INFINITY
    /// });
    /// assert_eq!(near, [0, 1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_nearest(self, bounds: &Aabb3, limit: f64, mut visitor: impl FnMut(u32) -> f64) {
        self.meet_nearest(bounds, limit, |number, _| visitor(number));
    }

    /// Like [`visit_nearest`](Self::visit_nearest), but also hands over each triangle's [`corners`](Self::corners), at
    /// the same cost with fewer cache misses.
    ///
    /// ```
    /// use asunder::{Aabb3, Ground, Shape3, TriMesh, glam::Vec3};
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
    /// let shape = Shape3::from(mesh);
    /// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
    /// ground.read_nearest(&Aabb3::new(Vec3::splat(-2.0), Vec3::splat(-1.0)), 10.0, |triangle, corners| {
    ///     assert_eq!(corners, ground.corners(triangle));
    ///     10.0
    /// });
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn read_nearest(self, bounds: &Aabb3, limit: f64, mut visitor: impl FnMut(u32, [Vec3; 3]) -> f64) {
        self.meet_nearest(bounds, limit, |number, corners| {
            visitor(number, self.known_or_read(number, corners))
        });
    }

    #[inline]
    fn meet_nearest(
        self,
        bounds: &Aabb3,
        limit: f64,
        mut visitor: impl FnMut(u32, Option<[Vec3; 3]>) -> f64,
    ) {
        let Some(near) = Near::new(bounds) else { return };
        match self {
            Self::Mesh(mesh) => mesh.tree().visit_in_order(&near, limit, visitor),
            Self::Field(field) => {
                let visitor = |number| visitor(number, None);
                field.visit_nearest((&near, bounds), limit, visitor);
            }
        }
    }
}
