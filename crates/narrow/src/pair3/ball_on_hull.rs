//! A sphere and a hull with faces that are parts of nothing: answered at once, in the hull's axes.
//!
//! ```text
//! f = the face that has the centre furthest in front of it, d = how far: below zero, the centre is inside, and d - radius the separation
//! from f, to what is nearer: over the side of a face that the centre is beyond the most, to that edge
//!                            past the end of an edge, to that corner; over a face beside it, to that face
//!                            along an edge that leads from a corner towards the centre, to that edge
//! what it ends on is nearest where a projection on the way from there to the centre shows as much of all corners; else others are asked
//! normal        that of the face, inside and over it; else along that way
//! yes or no     the number's beyond twice the bound, else by integers
//! ```
//! The walk is that of Mirtich, "V-Clip: fast and robust polyhedral collision detection" (1998), of a point, which has one feature. It
//! proposes; the projection proves. The general path searches for closest points of both, and names the features of a patch: a manifold
//! takes 2,100 ns there and XXX here with hulls of 16 (Intel Xeon, Ice Lake, 2 virtual cores, 2026-11-26).

use super::Pair3;
use super::ball_on_faces::{BallOnFaces, Nearest};
use super::balls::Told;
use crate::answer::{Tier, Verdict};
use crate::feature::Feature;
use crate::polyhedron::convex::IDENTITY;
use crate::polyhedron::solid::Solid;
use crate::precision::{Precision, length_at_most};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Hull, Shape3};

/// Steps after which others are asked.
const MAX_STEPS: usize = 32;

/// A sphere and a hull with faces, and the centre as the hull sees it.
struct Seen<'p> {
    shape: &'p Shape3,
    hull: &'p Hull,
    /// The hull's axes in the world.
    basis: Basis3,
    center: DVec3,
    /// Of the sphere, in metres.
    radius: f64,
    is_b: bool,
    precision: Precision,
}

impl Pair3<'_> {
    /// What is told of a sphere and a hull whose bounding spheres are within a limit.
    #[inline]
    pub(super) fn ball_on_hull(&self, limit: f64) -> Option<BallOnFaces<'_>> {
        let seen = self.ball_by_hull(limit)?;
        let nearest = seen.with_walk(|walk| walk.nearest(seen.hull.dimension() == 3, &seen.precision))?;
        let Seen { shape, basis, radius, is_b, precision, .. } = seen;
        Some(BallOnFaces { pair: self, shape, basis, nearest, radius, is_b, precision })
    }

    /// Whether a sphere and a hull overlap, if that can be told without proof of what is nearest, or with it.
    #[inline]
    pub(super) fn verdict_on_hull(&self) -> Option<Verdict> {
        let seen = self.ball_by_hull(0.0)?;
        let told = |overlapping| Some(Verdict { overlapping, tier: Tier::Bound });
        let doubt = 2.0 * seen.precision.projection() + 4.0 * seen.precision.planarity;
        let radii = seen.radius + f64::from(seen.hull.radius());
        let from_middle = (seen.center - seen.hull.center().as_dvec3()).length();
        if from_middle + doubt < seen.radius + f64::from(seen.hull.inner_radius()) {
            return told(true);
        }
        let known = seen.with_walk(|walk| {
            let (face, beyond) = walk.foremost()?;
            if beyond - doubt > radii {
                return Some(false);
            }
            if seen.hull.dimension() == 3 && beyond + doubt < radii.min(0.0) {
                return Some(true);
            }
            // What is somewhere on the hull is no nearer than what is nearest.
            (walk.from(face).is_some_and(|(foot, _)| (walk.point - foot).length() + doubt < radii))
                .then_some(true)
        });
        match known {
            Some(overlapping) => told(overlapping),
            None => self.ball_on_hull(0.0).map(|ball| ball.verdict()),
        }
    }

    #[inline]
    fn ball_by_hull(&self, limit: f64) -> Option<Seen<'_>> {
        let (sphere, shape, pose, is_b) = match (self.shape_a, self.shape_b) {
            (Shape3::Sphere(sphere), shape) => (sphere, shape, &self.pose_b, true),
            (shape, Shape3::Sphere(sphere)) => (sphere, shape, &self.pose_a, false),
            _ => return None,
        };
        let Shape3::Hull(hull) = shape else { return None };
        if self.gap_of_spheres() > limit {
            return None;
        }
        let (basis, radius) = (pose.basis(), f64::from(sphere.radius()));
        let center = basis.turn_back(if is_b { -self.between } else { self.between });
        let reach = radius
            + f64::from(hull.outer_radius())
            + length_at_most(hull.center().as_dvec3())
            + length_at_most(center);
        let planarity = f64::from(Hull::planarity_error(hull));
        let precision = Precision { planarity, ..Precision::of_closed_form(reach) };
        Some(Seen { shape, hull, basis, center, radius, is_b, precision })
    }
}

impl Seen<'_> {
    #[inline]
    fn with_walk<R>(&self, ask: impl FnOnce(&Walk) -> R) -> R {
        let core = self.shape.core();
        let solid = Solid::new(&core, IDENTITY, DVec3::ZERO, 0.0);
        let (normals, heights) = (core.normals(), core.heights());
        ask(&Walk { solid: &solid, normals, heights, point: self.center })
    }
}

/// Where the walk is: a face, a half-edge or a vertex, by its number.
#[derive(Clone, Copy)]
enum At {
    Face(usize),
    Edge(usize),
    Vertex(usize),
}

/// A core in its own axes, and a point.
struct Walk<'s> {
    solid: &'s Solid<'s>,
    /// Of its faces.
    normals: &'s [DVec3],
    heights: &'s [f64],
    point: DVec3,
}

impl Walk<'_> {
    /// What is nearest; nothing where that is not proved.
    fn nearest(&self, has_inside: bool, precision: &Precision) -> Option<Nearest> {
        let (face, beyond) = self.foremost()?;
        let slack = 4.0 * precision.planarity;
        let over = |face: usize, distance: f64| {
            let outwards = self.normals[face];
            let feature = Feature::Face(face as u32);
            Nearest { foot: self.point - outwards * distance, outwards, feature, distance, slack }
        };
        if has_inside && beyond <= 0.0 {
            return Some(over(face, beyond));
        }
        let (foot, feature) = match self.from(face)? {
            (_, At::Face(face)) => {
                // What is behind the face is over another: the walk went astray.
                let height = self.height(face);
                return (height >= -precision.projection()).then(|| over(face, height));
            }
            (foot, At::Edge(edge)) => (foot, Feature::Edge(self.solid.topology.edge_of(edge) as u32)),
            (foot, At::Vertex(vertex)) => (foot, Feature::Vertex(vertex as u32)),
        };
        let (between, doubt) = (self.point - foot, precision.projection());
        let distance = between.length();
        if distance <= doubt {
            return Some(over(face, beyond));
        }
        let outwards = between / distance;
        let at_least = outwards.dot(self.point) - self.solid.support(outwards).reach;
        let nearest = Nearest { foot, outwards, feature, distance, slack: 0.0 };
        precision.is_proved(distance, at_least).then_some(nearest)
    }

    /// The walk from a face to what should be nearest, and the place on that.
    fn from(&self, face: usize) -> Option<(DVec3, At)> {
        let mut at = At::Face(face);
        for _ in 0..MAX_STEPS {
            let next = match at {
                At::Face(face) => self
                    .side_beyond(face)
                    .map(At::Edge)
                    .ok_or_else(|| self.point - self.normals[face] * self.height(face)),
                At::Edge(edge) => self.beside_edge(edge),
                At::Vertex(vertex) => self
                    .edge_towards(vertex)
                    .map(At::Edge)
                    .ok_or_else(|| self.solid.vertices[vertex].as_dvec3()),
            };
            match next {
                Ok(next) => at = next,
                Err(foot) => return Some((foot, at)),
            }
        }
        None
    }

    #[inline(always)]
    fn height(&self, face: usize) -> f64 {
        self.normals[face].dot(self.point) - self.heights[face]
    }

    /// The face that has the point furthest in front of it, and how far; of equals, the first.
    #[inline]
    fn foremost(&self) -> Option<(usize, f64)> {
        let (mut face, mut most) = (usize::MAX, f64::NEG_INFINITY);
        for (number, (normal, height)) in self.normals.iter().zip(self.heights).enumerate() {
            let beyond = normal.dot(self.point) - height;
            let is_more = beyond > most;
            face = if is_more { number } else { face };
            most = if is_more { beyond } else { most };
        }
        (face != usize::MAX).then_some((face, most))
    }

    /// Where a half-edge starts, and the way from there.
    #[inline(always)]
    fn edge(&self, half_edge: usize) -> (DVec3, DVec3) {
        let (from, to) = self.solid.topology.ends(half_edge);
        let [from, to] = [from, to].map(|vertex| self.solid.vertices[vertex].as_dvec3());
        (from, to - from)
    }

    /// The half-edge around a face that the point is beyond the most, if it is beyond any.
    fn side_beyond(&self, face: usize) -> Option<usize> {
        let (normal, mut most, mut side) = (self.normals[face], 0.0, None);
        for half_edge in self.solid.topology.face_half_edges(face) {
            let (from, along) = self.edge(half_edge);
            // Not by lengths: their squares keep the order.
            let out = along.cross(normal).dot(self.point - from);
            let beyond = out * out.abs() / along.length_squared();
            if beyond > most {
                (most, side) = (beyond, Some(half_edge));
            }
        }
        side
    }

    /// What is nearer than an edge, or the point's foot on that.
    fn beside_edge(&self, half_edge: usize) -> Result<At, DVec3> {
        let topology = self.solid.topology;
        let (from, along) = self.edge(half_edge);
        let (start, end) = topology.ends(half_edge);
        let away = self.point - from;
        let place = away.dot(along) / along.length_squared();
        if place <= 0.0 {
            return Ok(At::Vertex(start));
        }
        if place >= 1.0 {
            return Ok(At::Vertex(end));
        }
        let foot = from + along * place;
        let edges = topology.half_edges();
        let (face, other) = (edges[half_edge].face, edges[usize::from(edges[half_edge].twin)].face);
        for (face, along) in [(face, along), (other, -along)] {
            let face = usize::from(face);
            if self.normals[face].cross(along).dot(self.point - foot) > 0.0 {
                return Ok(At::Face(face));
            }
        }
        Err(foot)
    }

    /// The edge from a corner that leads the most towards the point, if any does.
    fn edge_towards(&self, vertex: usize) -> Option<usize> {
        let away = self.point - self.solid.vertices[vertex].as_dvec3();
        let (mut most, mut edge) = (0.0, None);
        for &half_edge in self.solid.topology.leaving(vertex) {
            let (_, along) = self.edge(half_edge.into());
            let towards = away.dot(along);
            let share = towards * towards.abs() / along.length_squared();
            if share > most {
                (most, edge) = (share, Some(usize::from(half_edge)));
            }
        }
        edge
    }
}

#[cfg(test)]
mod tests {
    use super::super::balls::tests::is_said_as_of_a_part;
    use super::*;
    use crate::numbers::Numbers;
    use asunder_geometry::glam::{Quat, Vec3};
    use asunder_geometry::{Pose3, Sphere};

    #[test]
    fn touching_is_exact_over_a_face_at_an_edge_and_at_a_corner() {
        let wedge = [[0, 0, 0], [12, 0, 0], [0, 12, 0], [0, 0, -12]]
            .map(|[x, y, z]| Vec3::new(x as f32, y as f32, z as f32));
        let shape: Shape3 = Hull::from_points(&wedge).unwrap().into();
        let ball: Shape3 = Sphere::new(5.0).unwrap().into();
        // A place, and a way of length 5 out from there.
        for (place, way) in [
            (DVec3::new(3.0, 3.0, 0.0), DVec3::Z * 5.0),
            (DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, -3.0, 4.0)),
            (DVec3::ZERO, DVec3::new(-4.0, -3.0, 0.0)),
        ] {
            let verdict = |longer: f64| {
                let there = Pose3::at(place + way * longer).unwrap();
                let told = Pair3::new(&shape, &Pose3::IDENTITY, &ball, &there).verdict();
                assert_eq!(told, Pair3::new(&ball, &there, &shape, &Pose3::IDENTITY).verdict());
                told
            };
            assert_eq!(verdict(1.0), Verdict { overlapping: true, tier: Tier::Exact }, "{place}");
            assert_eq!(
                verdict(1.0 + f64::EPSILON),
                Verdict { overlapping: false, tier: Tier::Exact },
                "{place}"
            );
            assert_eq!(verdict(1.1), Verdict { overlapping: false, tier: Tier::Bound });
            assert_eq!(verdict(0.9), Verdict { overlapping: true, tier: Tier::Bound });
        }
    }

    /// The general path, which parts of compounds take, says the same: of hulls of few corners and of many, thin ones, flat ones, rounded
    /// ones, and prisms, whose faces are flat up to rounding.
    #[test]
    fn a_part_of_a_compound_says_the_same() {
        let mut numbers = Numbers::new(80);
        let (mut near, mut apart) = (0, 0);
        for i in 0..4000_u32 {
            let count = [4, 5, 8, 16, 40, 100][i as usize % 6];
            let thin = if i % 7 == 0 { 1e-4 } else { 1.0 };
            let mut points: Vec<Vec3> =
                (0..count).map(|_| (numbers.vector() * DVec3::new(1.0, thin, 1.0)).as_vec3()).collect();
            if i % 5 == 0 {
                points.truncate(7);
                points.extend(points.clone().iter().map(|&point| point + Vec3::new(0.3, 1.1, 0.2)));
            }
            if i % 11 == 0 {
                points.iter_mut().for_each(|point| point.y = 0.25);
            }
            let Ok(hull) = Hull::of_any_dimension(&points) else { continue };
            let hull = if i % 3 == 0 { hull.rounded(0.1).unwrap() } else { hull };
            let shape = Shape3::from(hull);
            let q = [numbers.vector(), numbers.vector()];
            let turn = Quat::from_xyzw(q[0].x as f32, q[0].y as f32, q[0].z as f32, q[1].x as f32);
            let ball = Shape3::from(Sphere::new((0.1 + 0.5 * q[1].y.abs()) as f32).unwrap());
            let far = if i % 13 == 0 { 1e7 } else { 0.0 };
            let here = Pose3::new(numbers.vector() + DVec3::X * far, turn).unwrap();
            let there = here.position() + numbers.vector() * if i % 2 == 0 { 0.5 } else { 3.0 };
            let there = Pose3::at(there).unwrap();
            for is_near in is_said_as_of_a_part((&ball, &there), (&shape, &here)) {
                near += u32::from(is_near);
                apart += u32::from(!is_near);
            }
        }
        assert!(near > 2000 && apart > 2000, "{near} near, {apart} apart");
    }
}
