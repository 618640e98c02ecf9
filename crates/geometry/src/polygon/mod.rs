//! Convex polygons, checked exactly.

use crate::aabb::Aabb2;
use crate::outward::{around2, round_down, round_up};
use crate::pose2::Pose2;
use crate::radius::{RadiusError, check_rounding, grown};
use crate::ring;
use crate::tolerance::{MAX_POLYGON_VERTICES, MAX_RADIUS, MIN_RADIUS};
use glam::{DVec2, Vec2};
use predicate::{corners, direction_changes, first_repeated, is_before, order, orientation};
use robust::{Coord, orient2d};
use std::sync::Arc;

mod error;
pub(crate) mod predicate;
mod simplify;
#[cfg(test)]
mod tests;

pub use error::PolygonError;
#[cfg(feature = "serde")]
pub(crate) use error::StoredPolygonError;

/// A convex polygon of 3 to 4096 vertices in metres, counter-clockwise. Clones share the data.
///
#[doc = include_str!("../../doc/polygon.svg")]
///
/// Edge `i` runs from vertex `i` to the next. Every check is an exact orientation test (Shewchuk, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", 1997), so that a polygon is exactly convex, and not
/// up to rounding.
///
/// ```
/// use asunder::{Polygon, glam::Vec2};
/// let triangle = Polygon::new(&[Vec2::ZERO, Vec2::X, Vec2::Y])?;
/// assert_eq!(triangle.vertices().len(), 3);
/// let square = Polygon::hull_of(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (1.0, 1.0), (0.0, 1.0)].map(Vec2::from))?;
/// assert_eq!(square.vertices().len(), 4, "the inner point is no vertex");
/// # Ok::<(), asunder::PolygonError>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct Polygon {
    data: Arc<PolygonData>,
    radius: f32,
}

#[derive(PartialEq)]
struct PolygonData {
    vertices: Box<[Vec2]>,
    normals: Box<[DVec2]>,
    extremes: [u16; 4],
    center: Vec2,
    outer_radius: f32,
    /// Without the rounding; negative if the centre lies outside.
    inner_radius: f32,
    error: f32,
}

impl Polygon {
    /// A polygon from its outline, counter-clockwise.
    ///
    /// A vertex that lies exactly on the line between its neighbours is dropped, as it changes nothing. Cost: n log n
    /// for the search for repeated points.
    ///
    /// # Errors
    /// Every case of [`PolygonError`]: concave, clockwise, repeated, collinear, non-finite, out of range.
    pub fn new(outline: &[Vec2]) -> Result<Self, PolygonError> {
        check_points(outline)?;
        if let Some((first, second)) = first_repeated(outline) {
            return Err(PolygonError::Repeated { first, second });
        }
        let turns: Vec<f64> = corners(outline).map(|[a, b, c]| orientation(a, b, c)).collect();
        if turns.iter().all(|&turn| turn == 0.0) {
            return Err(PolygonError::Collinear);
        }
        if turns.iter().all(|&turn| turn <= 0.0) {
            return Err(PolygonError::Clockwise);
        }
        for (vertex, [a, b, c]) in corners(outline).enumerate() {
            let doubles_back = turns[vertex] == 0.0 && is_before(a, b) != is_before(b, c);
            if turns[vertex] < 0.0 || doubles_back {
                return Err(PolygonError::Concave { vertex });
            }
        }
        if direction_changes(outline) != 2 {
            return Err(PolygonError::WindsRepeatedly);
        }
        let is_corner = |&(_, &turn): &(&Vec2, &f64)| turn > 0.0;
        Self::from_convex(outline.iter().zip(&turns).filter(is_corner).map(|(&v, _)| v).collect(), 0.0)
    }

    /// The convex hull of any points, by Andrew's monotone chain ("Another efficient algorithm for convex hulls in
    /// two dimensions", 1979) over exact orientation tests. Cost: n log n.
    ///
    /// The vertices are a subset of the points, bit for bit.
    ///
    /// # Errors
    /// Fewer than three points, points on one line, non-finite or out of range, too many vertices.
    pub fn hull_of(points: &[Vec2]) -> Result<Self, PolygonError> {
        Self::from_convex(hull_vertices(points)?, 0.0)
    }

    /// A regular polygon about its own origin, with a corner towards +x; `radius`, in metres, is that of its corners.
    ///
    /// Corners that in f32 lie on the line between their neighbours are dropped: of some thousands, a few.
    ///
    /// ```
    /// use asunder::{Polygon, PolygonError, glam::Vec2};
    /// let diamond = Polygon::regular(2.0, 4)?;
    /// let corners = [(-2.0, 0.0), (0.0, -2.0), (2.0, 0.0), (0.0, 2.0)].map(Vec2::from);
    /// assert_eq!(diamond.vertices(), corners);
    /// assert_eq!(Polygon::regular(2.0, 2).unwrap_err(), PolygonError::Sides { sides: 2 });
    /// # Ok::<(), PolygonError>(())
    /// ```
    ///
    /// # Errors
    /// Fewer than 3 sides, or more than 4096; a radius that is not positive and finite; any error of
    /// [`Polygon::hull_of`] for the corners.
    pub fn regular(radius: f32, sides: usize) -> Result<Self, PolygonError> {
        if !(3..=MAX_POLYGON_VERTICES).contains(&sides) {
            return Err(PolygonError::Sides { sides });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(PolygonError::NotPositive { value: radius });
        }
        let corners: Vec<Vec2> = ring::corners(sides, radius).map(within_range).collect();
        Self::hull_of(&corners)
    }

    /// The convex hull of any points with at most `max_vertices` vertices, chosen so that points outside are near:
    /// [`Polygon::error`] is a bound on how near. Cost: n log n, and 1e6 points are fine.
    ///
    /// The vertices are a subset of the points, bit for bit; the polygon lies inside the points' hull. If the hull has
    /// no more vertices than that, it is the result, and the error is zero.
    ///
    /// ```
    /// use asunder::{Polygon, glam::Vec2};
    /// let mut corners: Vec<Vec2> = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)].map(Vec2::from).to_vec();
    /// corners.push(Vec2::new(2.0, -0.001));
    /// let rect = Polygon::simplify(&corners, 4)?;
    /// assert_eq!(rect.vertices(), &corners[..4]);
    /// assert!(rect.error() >= 0.001 && rect.error() < 0.001_001);
    /// # Ok::<(), asunder::PolygonError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Polygon::hull_of`], except too many vertices; and a `max_vertices` below 3 or above 4096.
    pub fn simplify(points: &[Vec2], max_vertices: usize) -> Result<Self, PolygonError> {
        if !(3..=MAX_POLYGON_VERTICES).contains(&max_vertices) {
            return Err(PolygonError::LimitOutOfRange { max_vertices });
        }
        let hull = hull_vertices(points)?;
        if hull.len() <= max_vertices {
            return Self::from_convex(hull, 0.0);
        }
        let (vertices, error) = simplify::simplified(&hull, max_vertices);
        Self::from_convex(vertices, error)
    }

    /// Derives normals and radii from vertices known to be strictly convex and counter-clockwise.
    pub(crate) fn from_convex(vertices: Vec<Vec2>, error: f32) -> Result<Self, PolygonError> {
        if vertices.len() > MAX_POLYGON_VERTICES {
            return Err(PolygonError::TooManyVertices { count: vertices.len() });
        }
        let normals: Box<[DVec2]> = corners(&vertices)
            .map(|[_, from, to]| {
                let edge = to.as_dvec2() - from.as_dvec2();
                DVec2::new(edge.y, -edge.x) / edge.length()
            })
            .collect();
        let center = centroid(&vertices).as_vec2();
        let from_center = |v: &Vec2| v.as_dvec2() - center.as_dvec2();
        let outer = vertices.iter().map(|v| from_center(v).length()).fold(0.0, f64::max);
        let inner =
            vertices.iter().zip(&normals).map(|(v, n)| n.dot(from_center(v))).fold(f64::INFINITY, f64::min);
        // The rounded centre of a sliver may lie outside, at its distance from the nearest edge.
        let inner = if inner >= 0.0 { inner } else { -distance_from_edges(center.as_dvec2(), &vertices) };
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        if outer_radius < MIN_RADIUS {
            return Err(PolygonError::TooSmall { radius: outer_radius });
        }
        let inner_radius = round_down(inner - 8.0 * f64::EPSILON * outer);
        let extremes = extremes(&vertices);
        let vertices = vertices.into();
        let data = PolygonData { vertices, normals, extremes, center, outer_radius, inner_radius, error };
        Ok(Self { data: Arc::new(data), radius: 0.0 })
    }

    /// The polygon, without rounding, of which these were stored.
    #[cfg(feature = "serde")]
    pub(crate) fn restored(vertices: &[Vec2], error: f32) -> Result<Self, StoredPolygonError> {
        let checked = Self::new(vertices).map_err(StoredPolygonError::Outline)?;
        if checked.vertices().len() != vertices.len() {
            return Err(StoredPolygonError::NoCorner);
        }
        if !(0.0..=2.0 * MAX_RADIUS).contains(&error) {
            return Err(StoredPolygonError::BadError { value: error });
        }
        Self::from_convex(vertices.to_vec(), error).map_err(StoredPolygonError::Outline)
    }

    /// The vertices, counter-clockwise, bit for bit as given.
    #[inline]
    pub fn vertices(&self) -> &[Vec2] {
        &self.data.vertices
    }

    /// Outward unit normals in f64; number `i` belongs to the edge from vertex `i` to the next.
    #[inline]
    pub fn normals(&self) -> &[DVec2] {
        &self.data.normals
    }

    /// The vertices furthest along +x, +y, -x and -y; of two that are as far, the first, counter-clockwise.
    ///
    /// From one to the next, edges face into one quadrant: these bound the search for a support vertex.
    ///
    /// ```
    /// use asunder::{Polygon, glam::Vec2};
    /// let square = Polygon::new(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(Vec2::from))?;
    /// assert_eq!(square.extremes(), [1, 2, 3, 0]);
    /// # Ok::<(), asunder::PolygonError>(())
    /// ```
    #[inline]
    pub fn extremes(&self) -> [usize; 4] {
        self.data.extremes.map(usize::from)
    }

    /// The centre of both radii: the centroid, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec2 {
        self.data.center
    }

    /// The same polygon expanded by `radius` metres on every side, with round corners. Zero removes the rounding.
    ///
    /// ```
    /// use asunder::{Polygon, glam::{DVec2, Vec2}};
    /// let rounded = Polygon::new(&[Vec2::ZERO, Vec2::X, Vec2::Y])?.rounded(0.5)?;
    /// assert!(rounded.contains(DVec2::new(0.5, -0.5)) && !rounded.contains(DVec2::new(-0.4, -0.4)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A radius that is negative or not finite, or with which the shape would reach further than 1e6 m.
    pub fn rounded(mut self, radius: f32) -> Result<Self, RadiusError> {
        let reach = self.vertices().iter().map(|v| v.as_dvec2().length()).fold(0.0, f64::max);
        check_rounding(radius, reach)?;
        self.radius = radius;
        Ok(self)
    }

    /// An address that two polygons have in common exactly when they share their data, whatever their rounding; valid
    /// only while both live. It differs from run to run: use it for look-ups, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        std::sync::Arc::as_ptr(&self.data).addr()
    }

    /// Radius of the rounding, in metres; zero for sharp corners.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Radius of a circle about [`Polygon::center`] that contains the shape, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.data.outer_radius, self.radius)
    }

    /// Radius of a circle about [`Polygon::center`] that lies inside the shape, in metres, rounded down. Zero if there
    /// is none: the centre is rounded, and may lie beside a sliver.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        round_down(f64::from(self.data.inner_radius) + f64::from(self.radius)).max(0.0)
    }

    /// A bound on how far outside the polygon any of the given points lies, in metres, rounded up: zero unless
    /// [`Polygon::simplify`] left vertices out.
    #[inline]
    pub fn error(&self) -> f32 {
        self.data.error
    }

    /// Raises the error to at least this, in metres, for points that were left out before. Only for a polygon whose
    /// data are not shared.
    pub(crate) fn left_out(mut self, error: f64) -> Self {
        if let Some(data) = Arc::get_mut(&mut self.data) {
            data.error = data.error.max(round_up(error));
        }
        self
    }

    /// Whether the closed shape contains a local point, in metres. Exact where there is no rounding. Cost: linear in
    /// the vertices.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        self.contains_within(point.into(), self.radius.into())
    }

    /// The same with another radius, in metres, about the same core.
    pub(crate) fn contains_within(&self, point: DVec2, radius: f64) -> bool {
        if !point.is_finite() {
            return false;
        }
        let coord = |v: DVec2| Coord { x: v.x, y: v.y };
        let edges = || corners(self.vertices()).map(|[_, from, to]| (from.as_dvec2(), to.as_dvec2()));
        if edges().all(|(from, to)| orient2d(coord(from), coord(to), coord(point)) >= 0.0) {
            return true;
        }
        radius > 0.0
            && edges().any(|(from, to)| {
                let along = to - from;
                let place = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (point - from - along * place).length_squared() <= radius * radius
            })
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. Cost: linear in the vertices.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let vertices = self.vertices().iter().map(|vertex| vertex.as_dvec2());
        around2(vertices, pose, f64::from(margin) + f64::from(self.radius))
    }
}

/// The nearest f32 position or, if that is out of range, the next one towards the origin.
fn within_range(place: DVec2) -> Vec2 {
    let nearest = place.as_vec2();
    if nearest.as_dvec2().length() <= f64::from(MAX_RADIUS) {
        return nearest;
    }
    let inwards = |part: f64| round_down(part.abs()).copysign(part as f32);
    Vec2::new(inwards(place.x), inwards(place.y))
}

fn check_points(points: &[Vec2]) -> Result<(), PolygonError> {
    if points.len() < 3 {
        return Err(PolygonError::TooFewPoints { count: points.len() });
    }
    for (index, point) in points.iter().enumerate() {
        if !point.is_finite() {
            return Err(PolygonError::NotFinite { index });
        }
        if point.as_dvec2().length() > f64::from(MAX_RADIUS) {
            return Err(PolygonError::TooLarge { index });
        }
    }
    Ok(())
}

/// The strictly convex vertices of the points' hull, counter-clockwise from the least in x, then y.
fn hull_vertices(points: &[Vec2]) -> Result<Vec<Vec2>, PolygonError> {
    check_points(points)?;
    let mut sorted: Vec<Vec2> = points.to_vec();
    sorted.sort_by(|a, b| order(*a, *b));
    sorted.dedup();
    let mut hull: Vec<Vec2> = Vec::new();
    for pass in 0..2 {
        let floor = hull.len();
        let mut extend = |point: Vec2| {
            while hull.len() >= floor + 2
                && orientation(hull[hull.len() - 2], hull[hull.len() - 1], point) <= 0.0
            {
                hull.pop();
            }
            hull.push(point);
        };
        if pass == 0 {
            sorted.iter().for_each(|&p| extend(p))
        } else {
            sorted.iter().rev().for_each(|&p| extend(p))
        }
        // The last point of one chain is the first of the other.
        hull.pop();
    }
    if hull.len() < 3 { Err(PolygonError::Collinear) } else { Ok(hull) }
}

/// The vertices furthest along +x, +y, -x and -y; of two that are as far, the first, counter-clockwise.
fn extremes(vertices: &[Vec2]) -> [u16; 4] {
    // If an edge is perpendicular to the direction, the first is its vertex further clockwise.
    let keys: [fn(Vec2) -> [f32; 2]; 4] =
        [|v| [v.x, -v.y], |v| [v.y, v.x], |v| [-v.x, v.y], |v| [-v.y, -v.x]];
    keys.map(|key| {
        let mut best = 0;
        for (index, &vertex) in vertices.iter().enumerate() {
            if key(vertex) > key(vertices[best]) {
                best = index;
            }
        }
        // No polygon has more than 4096 vertices.
        best as u16
    })
}

/// Distance of a point from the nearest edge, in metres; never below the true one by more than the rounding of a
/// length.
fn distance_from_edges(point: DVec2, vertices: &[Vec2]) -> f64 {
    let from_edge = |[_, from, to]: [Vec2; 3]| {
        let (from, along) = (from.as_dvec2(), to.as_dvec2() - from.as_dvec2());
        let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (point - from - along * share).length()
    };
    corners(vertices).map(from_edge).fold(f64::INFINITY, f64::min)
}

/// The centre of area; the middle of the box if rounding puts a sliver's centre outside of that.
fn centroid(vertices: &[Vec2]) -> DVec2 {
    let origin = vertices[0].as_dvec2();
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for two in vertices[1..].windows(2) {
        let (a, b) = (two[0].as_dvec2() - origin, two[1].as_dvec2() - origin);
        let doubled = a.perp_dot(b);
        area += doubled;
        moment += (a + b) * doubled;
    }
    let center = origin + moment / (3.0 * area);
    let (low, high) = vertices.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), v| {
        (low.min(v.as_dvec2()), high.max(v.as_dvec2()))
    });
    // An area of zero makes the quotient NaN or infinite, and fails here too.
    if center.cmpge(low).all() && center.cmple(high).all() { center } else { (low + high) * 0.5 }
}
