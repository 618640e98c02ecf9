//! Convex polygons, checked exactly.

use crate::aabb::Aabb2;
use crate::outward::{interval, round_down, round_up};
use crate::pose2::Pose2;
use crate::tolerance::{MAX_POLYGON_VERTICES, MAX_RADIUS, MIN_RADIUS};
use glam::{DVec2, Vec2};
use robust::{Coord, orient2d};
use std::sync::Arc;

/// Why the vertices of a polygon were refused.
///
/// ```
/// use asunder_geometry::{Polygon, PolygonError, glam::Vec2};
/// let dart = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)].map(Vec2::from);
/// assert_eq!(Polygon::new(&dart).unwrap_err(), PolygonError::Concave { vertex: 2 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonError {
    /// Fewer than three points.
    TooFewPoints {
        /// How many were given.
        count: usize,
    },
    /// More vertices than a polygon may have.
    TooManyVertices {
        /// How many there would be.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// A point is further than [`MAX_RADIUS`] from the shape's origin.
    TooLarge {
        /// Index of the point.
        index: usize,
    },
    /// The bounding radius is below [`MIN_RADIUS`].
    TooSmall {
        /// The bounding radius, in metres.
        radius: f32,
    },
    /// Two vertices are the same point.
    Repeated {
        /// Index of the earlier one.
        first: usize,
        /// Index of the later one.
        second: usize,
    },
    /// All points lie on one line.
    Collinear,
    /// The vertices wind clockwise.
    Clockwise,
    /// The outline turns inwards at a vertex.
    Concave {
        /// Index of the vertex.
        vertex: usize,
    },
    /// Every vertex turns left, but the outline runs around more than once, as a star's does.
    WindsRepeatedly,
}

impl core::fmt::Display for PolygonError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooFewPoints { count } => write!(f, "{count} points make no polygon: give at least 3"),
            Self::TooManyVertices { count } => {
                write!(f, "{count} vertices are more than {MAX_POLYGON_VERTICES}: leave some out")
            }
            Self::NotFinite { index } => write!(f, "point {index} is not finite"),
            Self::TooLarge { index } => {
                write!(
                    f,
                    "point {index} is more than {MAX_RADIUS} m from the shape's origin: split the shape"
                )
            }
            Self::TooSmall { radius } => {
                write!(f, "bounding radius {radius} m is below {MIN_RADIUS} m: use larger units")
            }
            Self::Repeated { first, second } => {
                write!(f, "points {first} and {second} are the same: leave one out, or use Polygon::hull_of")
            }
            Self::Collinear => write!(f, "all points lie on one line"),
            Self::Clockwise => write!(f, "the vertices wind clockwise: reverse their order"),
            Self::Concave { vertex } => {
                write!(f, "the outline turns inwards at vertex {vertex}: use Polygon::hull_of, or split it")
            }
            Self::WindsRepeatedly => {
                write!(f, "the outline runs around more than once: use Polygon::hull_of")
            }
        }
    }
}

impl core::error::Error for PolygonError {}

/// A convex polygon of 3 to 4096 vertices in metres, counter-clockwise. Clones share the data.
///
/// Edge `i` runs from vertex `i` to the next. Every check is an exact orientation test (Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997), so that a polygon is convex
/// in fact and not up to some rounding.
///
/// ```
/// use asunder_geometry::{Polygon, glam::Vec2};
/// let triangle = Polygon::new(&[Vec2::ZERO, Vec2::X, Vec2::Y])?;
/// assert_eq!(triangle.vertices().len(), 3);
/// let square = Polygon::hull_of(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (1.0, 1.0), (0.0, 1.0)].map(Vec2::from))?;
/// assert_eq!(square.vertices().len(), 4, "the inner point is no vertex");
/// # Ok::<(), asunder_geometry::PolygonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    data: Arc<PolygonData>,
}

#[derive(Debug, PartialEq)]
struct PolygonData {
    vertices: Box<[Vec2]>,
    normals: Box<[DVec2]>,
    center: Vec2,
    outer_radius: f32,
    inner_radius: f32,
}

impl Polygon {
    /// A polygon from its outline, counter-clockwise.
    ///
    /// A vertex that lies exactly on the line between its neighbours is left out: it changes nothing. Cost:
    /// n log n for the search for repeated points.
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
        Self::from_convex(
            outline.iter().zip(&turns).filter(|&(_, &turn)| turn > 0.0).map(|(&v, _)| v).collect(),
        )
    }

    /// The convex hull of any points, by Andrew's monotone chain ("Another efficient algorithm for convex hulls in
    /// two dimensions", 1979) over exact orientation tests. Cost: n log n.
    ///
    /// The vertices are a subset of the points, bit for bit.
    ///
    /// # Errors
    /// Fewer than three points, points on one line, non-finite or out of range, too many vertices.
    pub fn hull_of(points: &[Vec2]) -> Result<Self, PolygonError> {
        check_points(points)?;
        let mut sorted: Vec<Vec2> = points.to_vec();
        sorted.sort_by(|a, b| order(*a, *b));
        sorted.dedup();
        let mut hull: Vec<Vec2> = Vec::with_capacity(sorted.len() + 1);
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
        if hull.len() < 3 {
            return Err(PolygonError::Collinear);
        }
        Self::from_convex(hull)
    }

    /// Derives normals and radii from vertices that are known to be strictly convex and counter-clockwise.
    fn from_convex(vertices: Vec<Vec2>) -> Result<Self, PolygonError> {
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
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        if outer_radius < MIN_RADIUS {
            return Err(PolygonError::TooSmall { radius: outer_radius });
        }
        let inner_radius = round_down((inner - 8.0 * f64::EPSILON * outer).max(0.0));
        let data = PolygonData { vertices: vertices.into(), normals, center, outer_radius, inner_radius };
        Ok(Self { data: Arc::new(data) })
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

    /// The centre that both radii are about: the centroid, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec2 {
        self.data.center
    }

    /// Radius of a circle about [`Polygon::center`] that holds the shape, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        self.data.outer_radius
    }

    /// Radius of a circle about [`Polygon::center`] that lies inside the shape, in metres, rounded down.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        self.data.inner_radius
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. Cost: linear in the vertices.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for vertex in self.vertices() {
            let turned = pose.rotation().turn(vertex.as_dvec2());
            (low, high) = (low.min(turned), high.max(turned));
        }
        let p = pose.position();
        let x = interval(p.x, low.x, high.x, f64::from(margin));
        let y = interval(p.y, low.y, high.y, f64::from(margin));
        Aabb2::new(Vec2::new(x.0, y.0), Vec2::new(x.1, y.1))
    }
}

/// Sign of the turn a -> b -> c: positive to the left. Exact for all f32 that are finite.
fn orientation(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let coord = |v: Vec2| Coord { x: f64::from(v.x), y: f64::from(v.y) };
    orient2d(coord(a), coord(b), coord(c))
}

fn order(a: Vec2, b: Vec2) -> core::cmp::Ordering {
    // `+ 0.0` makes -0 and +0 one: they are one point.
    (a.x + 0.0).total_cmp(&(b.x + 0.0)).then((a.y + 0.0).total_cmp(&(b.y + 0.0)))
}

fn is_before(a: Vec2, b: Vec2) -> bool {
    order(a, b).is_lt()
}

/// Each vertex with its neighbours: (previous, this, next). Number `i` is vertex `i`.
fn corners(outline: &[Vec2]) -> impl Iterator<Item = [Vec2; 3]> + '_ {
    let n = outline.len();
    (0..n).map(move |i| [outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]])
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

fn first_repeated(points: &[Vec2]) -> Option<(usize, usize)> {
    let mut by_place: Vec<usize> = (0..points.len()).collect();
    by_place.sort_by(|&a, &b| order(points[a], points[b]).then(a.cmp(&b)));
    by_place.windows(2).find(|two| points[two[0]] == points[two[1]]).map(|two| (two[0], two[1]))
}

/// How often the outline changes between running rightwards and leftwards: twice for a simple convex one.
fn direction_changes(outline: &[Vec2]) -> usize {
    corners(outline).filter(|&[a, b, c]| is_before(a, b) != is_before(b, c)).count()
}

fn centroid(vertices: &[Vec2]) -> DVec2 {
    let origin = vertices[0].as_dvec2();
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for two in vertices[1..].windows(2) {
        let (a, b) = (two[0].as_dvec2() - origin, two[1].as_dvec2() - origin);
        let doubled = a.perp_dot(b);
        area += doubled;
        moment += (a + b) * doubled;
    }
    // A sliver's area may vanish in f64; any point of it will do then.
    if area > 0.0 { origin + moment / (3.0 * area) } else { origin }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f32, f32)]) -> Vec<Vec2> {
        list.iter().copied().map(Vec2::from).collect()
    }

    #[test]
    fn refuses_each_kind_of_bad_outline() {
        let refused = |list: &[(f32, f32)]| Polygon::new(&points(list)).unwrap_err();
        assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0)]), PolygonError::TooFewPoints { count: 2 });
        assert_eq!(refused(&[(0.0, 0.0), (1.0, f32::NAN), (0.0, 1.0)]), PolygonError::NotFinite { index: 1 });
        assert_eq!(refused(&[(0.0, 0.0), (2e6, 0.0), (0.0, 1.0)]), PolygonError::TooLarge { index: 1 });
        assert_eq!(
            refused(&[(0.0, 0.0), (1e-9, 0.0), (0.0, 1e-9)]),
            PolygonError::TooSmall { radius: 7.45356e-10 }
        );
        assert_eq!(
            refused(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-0.0, 0.0)]),
            PolygonError::Repeated { first: 0, second: 3 }
        );
        assert_eq!(refused(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0), (2.0, 2.0)]), PolygonError::Collinear);
        assert_eq!(refused(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)]), PolygonError::Clockwise);
        assert_eq!(
            refused(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0)]),
            PolygonError::Concave { vertex: 1 },
            "a spike that doubles back on itself"
        );
        let star = [(0.0, 1.0), (-0.6, -0.8), (0.95, 0.3), (-0.95, 0.3), (0.6, -0.8)];
        assert_eq!(refused(&star), PolygonError::WindsRepeatedly);
    }

    #[test]
    fn one_ulp_decides_between_convex_and_concave() {
        // The middle vertex lies on the chord, one ulp outside it, one ulp inside it.
        let outline = |y: f32| points(&[(0.0, 0.0), (1.0, y), (2.0, 2.0), (0.0, 2.0)]);
        assert_eq!(Polygon::new(&outline(1.0)).unwrap().vertices().len(), 3, "on the line: left out");
        assert_eq!(Polygon::new(&outline(1.0_f32.next_down())).unwrap().vertices().len(), 4);
        assert_eq!(Polygon::new(&outline(1.0_f32.next_up())), Err(PolygonError::Concave { vertex: 1 }));
    }

    #[test]
    fn hull_keeps_bits_and_ignores_order() {
        let cloud = points(&[(0.1, 0.7), (0.3, 0.2), (0.3, 0.2), (0.9, 0.4), (0.5, 0.45), (0.6, 0.95)]);
        let hull = Polygon::hull_of(&cloud).unwrap();
        assert!(hull.vertices().iter().all(|v| cloud.contains(v)));
        assert_eq!(hull.vertices().len(), 4);
        let reversed: Vec<Vec2> = cloud.iter().rev().copied().collect();
        assert_eq!(Polygon::hull_of(&reversed).unwrap().vertices(), hull.vertices());
        assert_eq!(
            Polygon::hull_of(&points(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)])),
            Err(PolygonError::Collinear)
        );
    }
}
