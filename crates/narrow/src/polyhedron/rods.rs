//! Edges and segments that lie side by side: two contact points in place of one that jumps from end to end.
//!
//! A capsule that rests along the edge of a box is closest to it at either end, or anywhere between, by a hair. It
//! rests on the whole stretch that both share, so the contact points go to both ends of that stretch.

use super::manifold::{Far, Point};
use super::slender::Slender;
use super::solid::Solid;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::{ALIGNED_FACES, MAX_HULL_VERTICES};

/// Half-edges of a hull with the most vertices: each edge may be listed from both of its ends.
const MAX_HALF_EDGES: usize = 2 * (3 * MAX_HULL_VERTICES - 6);

/// Share of a rod's length by which a place on it may be past its end and still count as the end; a shared stretch that
/// is no longer counts as none.
const SHARE: f64 = 1e-9;

/// An edge of a core, or all of a segment.
pub(super) struct Rod {
    ends: [DVec3; 2],
    radius: f64,
    edge: Feature,
    vertices: [Feature; 2],
}

impl Rod {
    /// A segment; `None` for a point.
    pub(super) fn of_slender(core: &Slender) -> Option<Self> {
        let &Slender { ends, is_point, radius } = core;
        let vertices = [Feature::Vertex(0), Feature::Vertex(1)];
        (!is_point).then_some(Self { ends, radius, edge: Feature::Edge(0), vertices })
    }

    fn of_edge(solid: &Solid, edge: usize) -> Self {
        let (from, to) = solid.topology.ends(edge);
        Self {
            ends: [solid.point(from), solid.point(to)],
            radius: solid.radius,
            edge: Feature::Edge(edge as u32),
            vertices: [from, to].map(|vertex| Feature::Vertex(vertex as u32)),
        }
    }

    fn along(&self) -> DVec3 {
        self.ends[1] - self.ends[0]
    }
}

/// Two contact points of edges that lie side by side across a gap of `distance` between the cores, if some pair does:
/// one of them counts as deepest, and the separation of both is at most `within`.
pub(super) fn side_by_side(
    (a, b): (&Solid, &Solid),
    normal: DVec3,
    distance: f64,
    within: f64,
    preference: f64,
) -> Option<ArrayVec<Point, 4>> {
    let least = distance - a.radius - b.radius + preference;
    let edges_a = edges_across(a, normal, preference);
    if edges_a.is_empty() {
        return None;
    }
    let edges_b = edges_across(b, -normal, preference);
    for &edge_a in &edges_a {
        for &edge_b in &edges_b {
            let (rod_a, rod_b) = (Rod::of_edge(a, edge_a.into()), Rod::of_edge(b, edge_b.into()));
            let mut points: ArrayVec<Point, 4> =
                shared_stretch(&rod_a, &rod_b, normal, distance, preference).into_iter().collect();
            points.retain(|point| point.separation <= within);
            if points.len() == 2 && points.iter().any(|point| point.separation <= least) {
                points.sort_unstable_by_key(|point| point.feature);
                return Some(points);
            }
        }
    }
    None
}

/// The edges, in order, at a core's furthest vertices along a direction that are nearly perpendicular to it. Only the
/// few vertices that are as far are visited.
fn edges_across(solid: &Solid, direction: DVec3, slack: f64) -> ArrayVec<u16, MAX_HALF_EDGES> {
    let local = solid.turned_back(direction);
    let mut edges = ArrayVec::new();
    for vertex in Far::from(solid, direction, slack).vertices() {
        for &half_edge in solid.topology.leaving(vertex) {
            let (from, to) = solid.topology.ends(half_edge.into());
            let along = solid.vertices[to].as_dvec3() - solid.vertices[from].as_dvec3();
            let (lean, most) =
                (local.dot(along), (1.0 - ALIGNED_FACES * ALIGNED_FACES) * along.length_squared());
            if lean * lean <= most {
                let _ = edges.try_push(solid.topology.edge_of(half_edge.into()) as u16);
            }
        }
    }
    // An edge between two vertices that are as far is listed twice.
    edges.sort_unstable();
    let mut last = None;
    edges.retain(|edge| last.replace(*edge) != Some(*edge));
    edges
}

/// Points on both ends of the stretch along which two nearly parallel rods lie one above the other as seen along the
/// normal.
pub(super) fn shared_stretch(
    a: &Rod,
    b: &Rod,
    normal: DVec3,
    distance: f64,
    preference: f64,
) -> ArrayVec<Point, 2> {
    let none = ArrayVec::new();
    let (along_a, along_b) = (a.along(), b.along());
    let ([a0, a1], [b0, b1]) = (a.ends, b.ends);
    let cosine_squared = along_a.dot(along_b) * along_a.dot(along_b);
    let lengths_squared = along_a.length_squared() * along_b.length_squared();
    if !(lengths_squared > 0.0 && cosine_squared >= ALIGNED_FACES * ALIGNED_FACES * lengths_squared) {
        return none;
    }
    // Places along the part of A's direction that is perpendicular to the normal; where little of that is left, the
    // rods lie in one line along the normal.
    let side = along_a - normal * normal.dot(along_a);
    if side.length_squared() < 0.5 * along_a.length_squared() {
        return none;
    }
    let at = |point: DVec3| side.dot(point - a0);
    let (end_a, from_b, to_b) = (at(a1), at(b0), at(b1));
    let (low, high) = if from_b <= to_b { ((from_b, 0), (to_b, 1)) } else { ((to_b, 1), (from_b, 0)) };
    let on_b = |end: usize| FeatureId::new(a.edge, b.vertices[end]);
    let on_a = |end: usize| FeatureId::new(a.vertices[end], b.edge);
    let begin = if low.0 >= 0.0 { (low.0, on_b(low.1)) } else { (0.0, on_a(0)) };
    let end = if high.0 <= end_a { (high.0, on_b(high.1)) } else { (end_a, on_a(1)) };
    // End to end they share nothing but rounding.
    if begin.0 + SHARE * end_a >= end.0 {
        return none;
    }
    let places = |place: f64| [place / end_a, (place - from_b) / (to_b - from_b)];
    let over = Over { normal, deep: distance + preference, preference };
    let ends = [begin, end].map(|(place, feature)| over.point(a, b, places(place), feature));
    ends.into_iter().flatten().collect()
}

/// How the ends of a stretch become contact points.
struct Over {
    normal: DVec3,
    deep: f64,
    preference: f64,
}

impl Over {
    /// The contact point of two rods at the given places; `None` where the rods lie beside each other there, not over
    /// each other.
    fn point(&self, a: &Rod, b: &Rod, [s, t]: [f64; 2], feature: FeatureId) -> Option<Point> {
        let normal = self.normal;
        let on_a = a.ends[0] + a.along() * s.clamp(0.0, 1.0);
        let on_b = b.ends[0] + b.along() * t.clamp(0.0, 1.0);
        let separation = normal.dot(on_b - on_a);
        // Rods that cross at a small angle lie beside each other at the ends. Points of round rods may be moved
        // sideways to meet: that takes them off the surfaces only by the square of the distance.
        let aside = on_b - on_a - normal * separation;
        let radii = a.radius + b.radius;
        if aside.length_squared() > (2.0 * radii * self.preference).max(self.preference * self.preference) {
            return None;
        }
        let share = if radii > 0.0 { a.radius / radii } else { 0.5 };
        let (on_a, on_b) = (on_a + aside * share, on_b - aside * (1.0 - share));
        let (rise_a, rise_b) = (self.rise(a, s, separation, normal)?, self.rise(b, t, separation, -normal)?);
        let (on_a, on_b) = (on_a + normal * rise_a, on_b - normal * rise_b);
        Some(Point { separation: separation - rise_a - rise_b, on_a, on_b, feature })
    }

    /// How far a rod's surface lies over a place on it, along `outwards`: r at the end where the rods are closest, r /
    /// cos t over a rod that leans by t. `None` where that is past the rod's end, and so on its cap.
    fn rise(&self, rod: &Rod, place: f64, separation: f64, outwards: DVec3) -> Option<f64> {
        if separation <= self.deep {
            return Some(rod.radius);
        }
        let (lean, squared) = (outwards.dot(rod.along()), rod.along().length_squared());
        let rise = rod.radius / (1.0 - lean * lean / squared).sqrt();
        let foot = place + rise * lean / squared;
        // The end of a stretch is most often the end of a rod that is perpendicular to the normal up to rounding.
        (-SHARE..=1.0 + SHARE).contains(&foot).then_some(rise)
    }
}
