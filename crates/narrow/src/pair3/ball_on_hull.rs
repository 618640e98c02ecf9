//! A sphere and a hull with faces, neither a part of a compound: answered by a walk over the hull, in its axes.
//!
//! ```text
//! f = the face with the centre furthest in front of it, d = how far
//! d < 0, and over f:    the centre is inside, and d - radius is the separation
//! d < 0, and beside f:  it is beside a hull so thin that its sides were merged away: left to the general path
//! else walk from f to nearer features:
//!     from a face, across the side that the centre is furthest beyond:   to that edge
//!     from an edge, past its end:                                        to that vertex
//!     from an edge, over a face beside it:                               to that face
//!     from a vertex, along an edge that leads towards the centre:        to that edge
//! proof         project all vertices on the direction from the walk's end to the centre: if that shows a gap as wide,
//!               the end is nearest; else left to the general path
//! normal        the face's, inside and over it; else that direction
//! yes or no     by the number beyond twice its error bound, else by integers
//! ```
//! The walk is that of Mirtich, "V-Clip: fast and robust polyhedral collision detection" (1998), for a point, which has
//! one feature. It proposes; the projection proves. The general path searches for closest points of both shapes, and
//! names the features of a patch: a manifold takes 1,640 ns there and 440 here with hulls of 16 (Intel Xeon, Ice Lake,
//! 2 virtual cores, 2026-11-26).

use super::Pair3;
use super::ball_on_faces::{BallOnFaces, Nearest};
use super::balls::{BesideBall, ClosedForm};
use crate::answer::{Tier, Verdict};
use crate::feature::Feature;
use crate::polyhedron::convex::IDENTITY;
use crate::polyhedron::solid::Solid;
use crate::precision::Precision;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Hull, Shape3};

/// The most steps of a walk, after which the general path answers: most longer walks go round in circles.
const MAX_STEPS: usize = 16;

/// A sphere and a hull with faces, and the sphere's centre in the hull's axes.
struct BallOnHull<'p> {
    pair: &'p Pair3<'p>,
    beside: BesideBall<'p>,
    hull: &'p Hull,
    /// The hull's axes in the world.
    basis: Basis3,
    center: DVec3,
    precision: Precision,
}

impl Pair3<'_> {
    /// The answers for a sphere and a hull; `None` if the walk proves nothing, or their bounding spheres are beyond a
    /// limit.
    #[inline]
    pub(super) fn ball_on_hull(&self, limit: f64) -> Option<BallOnFaces<'_>> {
        let ball = self.ball_by_hull(limit)?;
        let nearest = ball.with_walk(|walk| {
            let foremost = walk.foremost()?;
            match walk.place(foremost, &ball) {
                Place::Inside(nearest) => Some(nearest),
                Place::BesideThin => None,
                Place::Outside => walk.proved(walk.from(foremost.0)?, foremost, &ball.precision),
            }
        });
        nearest.map(|nearest| ball.on_faces(nearest))
    }

    /// Whether a sphere and a hull overlap. The nearest feature is proved only where bounds do not suffice.
    #[inline]
    pub(super) fn verdict_on_hull(&self) -> Option<Verdict> {
        let ball = self.ball_by_hull(0.0)?;
        let doubt = 2.0 * ball.precision.projection() + 4.0 * ball.precision.planarity;
        let radii = ball.beside.radius + f64::from(ball.hull.radius());
        let by_bound = |overlapping| Some(Verdict { overlapping, tier: Tier::Bound });
        ball.with_walk(|walk| {
            let from_middle = (ball.center - ball.hull.center().as_dvec3()).length();
            // The inner radius is below zero if the hull's centre is not in the core.
            if from_middle + doubt < radii + walk.solid.inner_radius() {
                return by_bound(true);
            }
            let foremost = walk.foremost()?;
            if foremost.1 - doubt > radii {
                return by_bound(false);
            }
            match walk.place(foremost, &ball) {
                Place::Inside(nearest) => return Some(ball.on_faces(nearest).verdict()),
                Place::BesideThin => return None,
                Place::Outside => {}
            }
            let end = walk.from(foremost.0)?;
            // Any point of the hull is at least as far away as the nearest one.
            if (walk.point - end.0).length() + doubt < radii {
                return by_bound(true);
            }
            let nearest = walk.proved(end, foremost, &ball.precision)?;
            Some(ball.on_faces(nearest).verdict())
        })
    }

    #[inline]
    fn ball_by_hull(&self, limit: f64) -> Option<BallOnHull<'_>> {
        let beside = self.beside_ball()?;
        let Shape3::Hull(hull) = beside.shape else { return None };
        if hull.dimension() < 2 || self.gap_of_spheres() > limit {
            return None;
        }
        let basis = beside.pose.basis();
        let (center, planarity) = (basis.turn_back(beside.center), f64::from(Hull::planarity_error(hull)));
        let precision = Precision { planarity, ..beside.precision() };
        Some(BallOnHull { pair: self, beside, hull, basis, center, precision })
    }
}

impl<'p> BallOnHull<'p> {
    #[inline]
    fn with_walk<R>(&self, run: impl FnOnce(&Walk) -> R) -> R {
        let core = self.beside.shape.core();
        let solid = Solid::new(&core, IDENTITY, DVec3::ZERO, 0.0);
        let (normals, heights) = (core.normals(), core.heights());
        run(&Walk { solid: &solid, normals, heights, point: self.center })
    }

    fn on_faces(&self, nearest: Nearest) -> BallOnFaces<'p> {
        let BesideBall { shape, is_b, radius, .. } = self.beside;
        let (pair, basis, precision) = (self.pair, self.basis, self.precision);
        BallOnFaces { pair, shape, basis, nearest, radius, is_b, precision }
    }
}

/// Where a point is before the walk.
enum Place {
    /// Behind all faces of a hull with volume, and over the foremost: that is the nearest place.
    Inside(Nearest),
    /// Behind all faces, and beside the foremost: beside a hull so thin that its sides were merged away. Left to the
    /// general path.
    BesideThin,
    /// In front of some face, or the hull has no volume.
    Outside,
}

/// Where the walk is: the index of a face, a half-edge or a vertex.
#[derive(Clone, Copy)]
enum At {
    Face(usize),
    Edge(usize),
    Vertex(usize),
}

/// One step of the walk.
enum Step {
    To(At),
    /// No neighbouring feature is nearer. The point's foot on the feature where the walk ends.
    End(DVec3),
}

/// A core in its own axes, and a point.
struct Walk<'s> {
    solid: &'s Solid<'s>,
    /// Of the core's faces.
    normals: &'s [DVec3],
    heights: &'s [f64],
    point: DVec3,
}

impl Walk<'_> {
    /// Where the point is, given its foremost face.
    fn place(&self, (face, beyond): (usize, f64), ball: &BallOnHull) -> Place {
        if ball.hull.dimension() < 3 || beyond > 0.0 {
            return Place::Outside;
        }
        match self.side_beyond(face) {
            None => Place::Inside(self.over(face, beyond, 4.0 * ball.precision.planarity)),
            Some(_) => Place::BesideThin,
        }
    }

    /// The nearest place, from the point and feature where a walk ended; `None` if that is not proved.
    fn proved(
        &self,
        (foot, at): (DVec3, At),
        (foremost, beyond): (usize, f64),
        precision: &Precision,
    ) -> Option<Nearest> {
        let feature = match at {
            At::Face(face) => {
                // A point behind the face is over another face: the walk went astray.
                let height = self.height(face);
                return (height >= -precision.projection())
                    .then(|| self.over(face, height, self.bulge(face)));
            }
            At::Edge(edge) => Feature::Edge(self.solid.topology.edge_of(edge) as u32),
            At::Vertex(vertex) => Feature::Vertex(vertex as u32),
        };
        let between = self.point - foot;
        let distance = between.length();
        if distance <= precision.projection() {
            return Some(self.over(foremost, beyond, 4.0 * precision.planarity));
        }
        let outwards = between / distance;
        let at_least = outwards.dot(self.point) - self.solid.support(outwards).reach;
        let nearest = Nearest { foot, outwards, feature, distance, slack: 0.0 };
        precision.is_proved(distance, at_least).then_some(nearest)
    }

    fn over(&self, face: usize, distance: f64, slack: f64) -> Nearest {
        let (outwards, feature) = (self.normals[face], Feature::Face(face as u32));
        Nearest { foot: self.point - outwards * distance, outwards, feature, distance, slack }
    }

    /// How far the corners of a face may lie below the hull's furthest extent along the face's normal.
    fn bulge(&self, face: usize) -> f64 {
        let corners =
            self.solid.topology.face_vertices(face).map(|vertex| self.solid.vertices[vertex].as_dvec3());
        let lowest = corners.map(|corner| self.normals[face].dot(corner)).fold(f64::INFINITY, f64::min);
        (self.heights[face] - lowest).max(0.0)
    }

    /// Walks from a face to what should be the nearest feature; returns the nearest point on it, and the feature.
    fn from(&self, face: usize) -> Option<(DVec3, At)> {
        let mut at = At::Face(face);
        for _ in 0..MAX_STEPS {
            let step = match at {
                At::Face(face) => match self.side_beyond(face) {
                    Some(side) => Step::To(At::Edge(side)),
                    None => Step::End(self.point - self.normals[face] * self.height(face)),
                },
                At::Edge(edge) => self.beside_edge(edge),
                At::Vertex(vertex) => match self.edge_towards(vertex) {
                    Some(edge) => Step::To(At::Edge(edge)),
                    None => Step::End(self.solid.vertices[vertex].as_dvec3()),
                },
            };
            match step {
                Step::To(next) => at = next,
                Step::End(foot) => return Some((foot, at)),
            }
        }
        None
    }

    #[inline(always)]
    fn height(&self, face: usize) -> f64 {
        self.normals[face].dot(self.point) - self.heights[face]
    }

    /// The face that has the point furthest in front of it, and the distance; of equals, the first.
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

    /// The start of a half-edge, and the vector to its end.
    #[inline(always)]
    fn edge(&self, half_edge: usize) -> (DVec3, DVec3) {
        let (from, to) = self.solid.topology.ends(half_edge);
        let [from, to] = [from, to].map(|vertex| self.solid.vertices[vertex].as_dvec3());
        (from, to - from)
    }

    /// The half-edge around a face that the point is furthest beyond, if it is beyond any.
    fn side_beyond(&self, face: usize) -> Option<usize> {
        let (normal, mut most, mut side) = (self.normals[face], 0.0, None);
        for half_edge in self.solid.topology.face_half_edges(face) {
            let (from, along) = self.edge(half_edge);
            // The signed square of the distance: it gives the same order, without a root.
            let out = along.cross(normal).dot(self.point - from);
            let beyond = out * out.abs() / along.length_squared();
            if beyond > most {
                (most, side) = (beyond, Some(half_edge));
            }
        }
        side
    }

    /// To the neighbouring feature of an edge that is nearer, if one is.
    fn beside_edge(&self, half_edge: usize) -> Step {
        let topology = self.solid.topology;
        let (from, along) = self.edge(half_edge);
        let (start, end) = topology.ends(half_edge);
        let away = self.point - from;
        let place = away.dot(along) / along.length_squared();
        if place <= 0.0 {
            return Step::To(At::Vertex(start));
        }
        if place >= 1.0 {
            return Step::To(At::Vertex(end));
        }
        let foot = from + along * place;
        let edges = topology.half_edges();
        let (face, other) = (edges[half_edge].face, edges[usize::from(edges[half_edge].twin)].face);
        for (face, along) in [(face, along), (other, -along)] {
            let face = usize::from(face);
            if self.normals[face].cross(along).dot(self.point - foot) > 0.0 {
                return Step::To(At::Face(face));
            }
        }
        Step::End(foot)
    }

    /// The edge from a vertex that leads the most towards the point, if any does.
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
    use super::super::balls::tests::{Counts, agrees_with_a_part, any_ball, pose_and_place, touch_exactly};
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
        // A place, and a vector of length 5 out from there.
        for (place, way) in [
            (DVec3::new(3.0, 3.0, 0.0), DVec3::Z * 5.0),
            (DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, -3.0, 4.0)),
            (DVec3::ZERO, DVec3::new(-4.0, -3.0, 0.0)),
        ] {
            touch_exactly([&shape, &ball], place, way);
        }
    }

    /// The general path, which parts of compounds take, gives the same answers: for hulls of few corners and of many,
    /// thin ones, flat ones, rounded ones, and prisms, whose faces are flat up to rounding.
    #[test]
    fn a_part_of_a_compound_has_the_same_answers() {
        let mut numbers = Numbers::new(80);
        let mut counts = Counts::default();
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
            let ball = any_ball(&mut numbers);
            let (here, there) = pose_and_place(&mut numbers, i, 0.5);
            let there = Pose3::at(there).unwrap();
            agrees_with_a_part((&ball, &there), (&shape, &here), &mut counts);
        }
        assert!(counts.near > 2000 && counts.apart > 2000, "{counts:?}");
    }

    /// Beside a hull so thin that its sides are merged away, a point may be behind all faces and yet outside; and the
    /// centre of the hull's radii, rounded to f32, may lie beside a hull without volume.
    #[test]
    fn what_is_behind_all_faces_of_a_thin_hull_may_be_beside_it() {
        let hull = |points: &[[f32; 3]]| {
            let points: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
            Shape3::from(Hull::of_any_dimension(&points).unwrap())
        };
        let ball = |radius: f32| Shape3::from(Sphere::new(radius).unwrap());
        let e = 1e-8;
        let cross = hull(&[[-1.0, e, 0.0], [1.0, e, 0.0], [0.0, -e, -1.0], [0.0, -e, 1.0]]);
        let six_faces = hull(&[
            [-7449.387, -7096.1323, 11696.645],
            [-5284.3438, -5914.3613, 11214.693],
            [-5742.778, -6236.143, 11349.146],
            [-4909.933, -5500.951, 11036.677],
            [-5053.992, -5745.2344, 11143.765],
            [-5678.9146, -6136.014, 11305.371],
            [-6504.3364, -6534.7817, 11465.663],
            [-6784.167, -6860.5083, 11606.296],
            [-5449.4507, -6058.8135, 11276.052],
        ]);
        let turned = Quat::from_xyzw(0.107_864_596, 0.135_721_3, -0.635_359_47, -0.418_397_67);
        let flat = hull(&[
            [-0.046_520_84, 0.324_774_4, 0.780_285_95],
            [0.050_571_907, -0.267_837_02, -0.115_287_63],
            [-0.217_449_92, -0.913_212_6, 0.002_503_808_6],
        ]);
        let folded = hull(&[
            [0.636_223_2, -0.401_455_97, 0.323_334_25],
            [-0.592_211_5, 0.396_612_35, -0.331_585_9],
            [-0.191_687_97, -0.253_255_1, 0.402_321_1],
            [0.426_305_68, -0.460_020_93, 0.471_753_45],
        ]);
        // Whether they overlap, by the exact arithmetic of the tests' oracle.
        for (shape, turn, radius, center, overlapping) in [
            (&cross, Quat::IDENTITY, 0.125, [3.0, 0.0, 0.0], false),
            (
                &six_faces,
                turned,
                538.586_24,
                [2_038.702_180_924_999_3, -4_012.656_671_819_974_7, 12_667.537_021_260_865],
                true,
            ),
            (
                &flat,
                Quat::IDENTITY,
                0.5,
                [0.377_619_214_756_021_17, -0.443_784_813_352_560_5, 0.375_940_226_832_435_3],
                false,
            ),
            (
                &folded,
                Quat::IDENTITY,
                0.5,
                [0.120_286_030_666_858_36, 0.360_716_175_536_520_2, 0.363_932_664_004_622_65],
                false,
            ),
        ] {
            let (here, there) = (Pose3::new(Vec3::ZERO, turn).unwrap(), Pose3::at(center).unwrap());
            assert_eq!(Pair3::new(shape, &here, &ball(radius), &there).overlaps(), overlapping, "{center:?}");
            agrees_with_a_part((&ball(radius), &there), (shape, &here), &mut Counts::default());
        }
    }
}
