//! The sets in the plane: the twin of `volume`.

use super::apart::surely_apart;
use super::shapes::{polygons, vertices2};
use super::{DISTINCT, FRAMES, PairSet, PlaneKind, PosedPair2};
use crate::random::Random;
use asunder_geometry::{Pose2, Rotation2, Shape2};
use core::f64::consts::TAU;
use glam::{DVec2, DVec3};

/// `count` posed pairs of one family in the plane. Cost: as for [`pairs3`](super::pairs3).
///
/// Sets that are sequences are listed frame by frame, and `count` is rounded up to whole sequences of [`FRAMES`].
pub fn pairs2(kind: PlaneKind, set: PairSet, count: usize, seed: u64) -> Vec<PosedPair2> {
    let shapes: Vec<Flat> = polygons(kind, DISTINCT, seed).into_iter().map(Flat::new).collect();
    let mut random = Random::new(seed ^ 0x9a122);
    if set.is_sequence() {
        let tracks: Vec<Track> =
            (0..count.div_ceil(FRAMES)).map(|_| Track::new(set, &shapes, &mut random)).collect();
        return (0..FRAMES).flat_map(|frame| tracks.iter().map(move |track| track.at(frame))).collect();
    }
    (0..count).map(|_| one_pair(set, &shapes, &mut random)).collect()
}

/// A shape with its vertices.
struct Flat {
    shape: Shape2,
    vertices: Vec<DVec2>,
}

impl Flat {
    fn new(shape: Shape2) -> Self {
        Self { vertices: vertices2(&shape), shape }
    }

    /// The vertices turned by an angle, at height 0.
    fn turned(&self, angle: f64) -> Vec<DVec3> {
        self.vertices.iter().map(|&v| turn(v, angle).extend(0.0)).collect()
    }

    /// A random edge: its start, its end, the angle of its outward normal.
    fn edge(&self, random: &mut Random) -> (DVec2, DVec2, f64) {
        let i = random.below(self.vertices.len());
        let (from, to) = (self.vertices[i], self.vertices[(i + 1) % self.vertices.len()]);
        let along = to - from;
        (from, to, libm::atan2(-along.x, along.y))
    }
}

fn turn(v: DVec2, angle: f64) -> DVec2 {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    DVec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

fn direction(angle: f64) -> DVec2 {
    turn(DVec2::X, angle)
}

fn size(a: &Flat, b: &Flat) -> f64 {
    f64::from(a.shape.outer_radius()) + f64::from(b.shape.outer_radius())
}

fn place(random: &mut Random) -> DVec2 {
    DVec2::new(random.range(-5.0, 5.0), random.range(-5.0, 5.0))
}

pub(crate) fn pose(position: DVec2, angle: f64) -> Pose2 {
    let rotation = Rotation2::new(libm::cos(angle) as f32, libm::sin(angle) as f32);
    rotation
        .and_then(|rotation| Pose2::new(position, rotation))
        .expect("a scene's poses are finite and near by construction")
}

fn posed(a: &Flat, angle_a: f64, b: &Flat, angle_b: f64, at: DVec2, offset: DVec2) -> PosedPair2 {
    PosedPair2 {
        shape_a: a.shape.clone(),
        pose_a: pose(at, angle_a),
        shape_b: b.shape.clone(),
        pose_b: pose(at + offset, angle_b),
    }
}

fn one_pair(set: PairSet, shapes: &[Flat], random: &mut Random) -> PosedPair2 {
    let (a, b) = (&shapes[random.below(shapes.len())], &shapes[random.below(shapes.len())]);
    let (angle_a, angle_b, at) = (random.range(0.0, TAU), random.range(0.0, TAU), place(random));
    let way = direction(random.range(0.0, TAU));
    let offset = match set {
        PairSet::Mixed => return mixed(a, b, random),
        PairSet::Rest | PairSet::Slide => {
            let x = random.range(-0.5, 0.5);
            return Stack::new(a, b, random).at(a, b, x);
        }
        PairSet::Touch => return touch(a, b, random),
        PairSet::Far => way * random.range(4.0, 10.0),
        PairSet::Deep | PairSet::Tumble => way * random.range(0.0, 0.1),
        PairSet::Same => return posed(a, angle_a, a, angle_a, at, DVec2::ZERO),
        PairSet::Turned => {
            let center = a.shape.center().as_dvec2();
            return posed(a, angle_a, a, angle_b, at, turn(center, angle_a) - turn(center, angle_b));
        }
    };
    posed(a, angle_a, b, angle_b, at, offset)
}

/// Draws uniformly among all placements whose AABBs overlap, until the pair is apart or not as decided beforehand.
fn mixed(a: &Flat, b: &Flat, random: &mut Random) -> PosedPair2 {
    let wanted_apart = random.unit() < 0.4;
    loop {
        let (angle_a, angle_b) = (random.range(0.0, TAU), random.range(0.0, TAU));
        let (points_a, mut points_b) = (a.turned(angle_a), b.turned(angle_b));
        let (low_a, high_a) = corners(&points_a);
        let (low_b, high_b) = corners(&points_b);
        let offset = random.within(low_a - high_b, high_a - low_b);
        points_b.iter_mut().for_each(|v| *v += offset);
        if surely_apart(&points_a, &points_b) == wanted_apart {
            return posed(a, angle_a, b, angle_b, place(random), offset.truncate());
        }
    }
}

fn corners(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)))
}

/// An edge of B lies on an edge of A.
struct Stack {
    angle_a: f64,
    angle_b: f64,
    at: DVec2,
    centered: DVec2,
    along: DVec2,
}

impl Stack {
    fn new(a: &Flat, b: &Flat, random: &mut Random) -> Self {
        let (from_a, to_a, normal_a) = a.edge(random);
        let (from_b, to_b, normal_b) = b.edge(random);
        let angle_a = random.range(0.0, TAU);
        let up = normal_a + angle_a;
        let angle_b = up + TAU * 0.5 - normal_b;
        let sunk = random.log_range(1e-4, 1e-3) * size(a, b);
        let middle_a = turn((from_a + to_a) * 0.5, angle_a);
        let middle_b = turn((from_b + to_b) * 0.5, angle_b);
        Self {
            angle_a,
            angle_b,
            at: place(random),
            centered: middle_a - middle_b - direction(up) * sunk,
            along: turn((to_a - from_a) * 0.5, angle_a),
        }
    }

    fn at(&self, a: &Flat, b: &Flat, x: f64) -> PosedPair2 {
        posed(a, self.angle_a, b, self.angle_b, self.at, self.centered + self.along * x)
    }
}

/// B's lowest vertex over an edge of A.
fn touch(a: &Flat, b: &Flat, random: &mut Random) -> PosedPair2 {
    let (from, to, normal) = a.edge(random);
    let (angle_a, angle_b) = (random.range(0.0, TAU), random.range(0.0, TAU));
    let up = direction(normal + angle_a);
    let vertices = b.vertices.iter().map(|&v| turn(v, angle_b));
    let lowest = vertices.min_by(|p, q| p.dot(up).total_cmp(&q.dot(up))).unwrap_or_default();
    let gap = random.range(-1e-3, 1e-3) * size(a, b);
    let on_edge = turn(from + (to - from) * random.range(0.1, 0.9), angle_a);
    posed(a, angle_a, b, angle_b, place(random), on_edge + up * gap - lowest)
}

/// One pair over [`FRAMES`] frames.
struct Track<'a> {
    a: &'a Flat,
    b: &'a Flat,
    stack: Stack,
    /// Radians a frame; zero for a pair that slides.
    spin: f64,
}

impl<'a> Track<'a> {
    fn new(set: PairSet, shapes: &'a [Flat], random: &mut Random) -> Self {
        let (a, b) = (&shapes[random.below(shapes.len())], &shapes[random.below(shapes.len())]);
        let mut stack = Stack::new(a, b, random);
        let mut spin = 0.0;
        if set == PairSet::Tumble {
            spin = random.range(1.0, 3.0) * TAU / 360.0;
            stack.centered = direction(random.range(0.0, TAU)) * (size(a, b) * random.range(0.75, 0.9));
        }
        Self { a, b, stack, spin }
    }

    fn at(&self, frame: usize) -> PosedPair2 {
        let (a, b, stack) = (self.a, self.b, &self.stack);
        if self.spin == 0.0 {
            return stack.at(a, b, -0.8 + 1.6 * frame as f64 / (FRAMES - 1) as f64);
        }
        let angle_b = stack.angle_b + self.spin * frame as f64;
        posed(a, stack.angle_a, b, angle_b, stack.at, stack.centered)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_apart(pair: &PosedPair2) -> bool {
        let points = |shape: &Shape2, pose: &Pose2| -> Vec<DVec3> {
            let local = vertices2(shape);
            local.iter().map(|v| (pose.position() + pose.rotation().turn(*v)).extend(0.0)).collect()
        };
        surely_apart(&points(&pair.shape_a, &pair.pose_a), &points(&pair.shape_b, &pair.pose_b))
    }

    /// The separation along one world axis from A to B, negative for overlap.
    fn gap(pair: &PosedPair2, axis: DVec2) -> f64 {
        let reach = |shape: &Shape2, pose: &Pose2, axis: DVec2| {
            let local = vertices2(shape);
            let heights = local.iter().map(|v| (pose.position() + pose.rotation().turn(*v)).dot(axis));
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        -reach(&pair.shape_b, &pair.pose_b, -axis) - reach(&pair.shape_a, &pair.pose_a, axis)
    }

    #[test]
    fn two_of_five_mixed_pairs_are_apart() {
        for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
            let apart = pairs2(kind, PairSet::Mixed, 1000, 1).iter().filter(|p| is_apart(p)).count();
            assert!((350..450).contains(&apart), "{}: {apart} of 1000 apart", kind.name());
        }
    }

    #[test]
    fn resting_pairs_are_sunk_by_a_thousandth_at_most() {
        for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
            for pair in pairs2(kind, PairSet::Rest, 200, 1) {
                let normals = pair.shape_a.core().normals().to_vec();
                let turn = pair.pose_a.rotation();
                let best =
                    normals.iter().map(|n| gap(&pair, turn.turn(*n))).fold(f64::NEG_INFINITY, f64::max);
                let size = f64::from(pair.shape_a.outer_radius() + pair.shape_b.outer_radius());
                assert!((-1.1e-3..-0.9e-4).contains(&(best / size)), "{}: {best}", kind.name());
            }
        }
    }

    #[test]
    fn touching_pairs_are_within_a_thousandth_on_either_side() {
        for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
            let share = |pair: &PosedPair2| {
                let (normals, turn) = (pair.shape_a.core().normals().to_vec(), pair.pose_a.rotation());
                let best = normals.iter().map(|n| gap(pair, turn.turn(*n))).fold(f64::NEG_INFINITY, f64::max);
                best / f64::from(pair.shape_a.outer_radius() + pair.shape_b.outer_radius())
            };
            let shares: Vec<f64> = pairs2(kind, PairSet::Touch, 400, 1).iter().map(share).collect();
            let apart = shares.iter().filter(|&&share| share > 0.0).count();
            assert!((150..250).contains(&apart), "{}: {apart} of 400 apart", kind.name());
            // A rotation in f32 tilts an edge by 1e-7.
            assert!(shares.iter().all(|share| share.abs() < 1e-3 + 1e-6), "{}", kind.name());
        }
    }

    #[test]
    fn the_other_sets_are_what_they_say() {
        for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly4096] {
            assert!(pairs2(kind, PairSet::Far, 20, 1).iter().all(is_apart));
            assert!(!pairs2(kind, PairSet::Deep, 20, 1).iter().any(is_apart));
            assert_eq!(pairs2(kind, PairSet::Tumble, 61, 1).len(), 2 * FRAMES);
        }
        for set in PairSet::ALL {
            let poses = |seed| -> Vec<[Pose2; 2]> {
                pairs2(PlaneKind::Poly8, set, 60, seed).iter().map(|p| [p.pose_a, p.pose_b]).collect()
            };
            assert_eq!(poses(5), poses(5));
            assert_ne!(poses(5), poses(6));
        }
    }
}
