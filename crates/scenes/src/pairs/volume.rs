//! The sets in space.

use super::apart::surely_apart;
use super::shapes::{solids, vertices3};
use super::{DISTINCT, FRAMES, PairSet, PosedPair3, SolidKind};
use crate::random::Random;
use crate::turn::{Turn, unit};
use asunder_geometry::{Pose3, Shape3, Topology};
use core::f64::consts::TAU;
use glam::DVec3;

/// `count` posed pairs of one family. Cost: some microseconds per pair, tens with many vertices.
///
/// Sets that are sequences are listed frame by frame, and `count` is rounded up to whole sequences: see [`frames3`].
pub fn pairs3(kind: SolidKind, set: PairSet, count: usize, seed: u64) -> Vec<PosedPair3> {
    let shapes: Vec<Solid> = solids(kind, DISTINCT, seed).into_iter().map(Solid::new).collect();
    let mut random = Random::new(seed ^ 0x9a125);
    if set.is_sequence() {
        let tracks: Vec<Track> =
            (0..count.div_ceil(FRAMES)).map(|_| Track::new(set, &shapes, &mut random)).collect();
        return (0..FRAMES).flat_map(|frame| tracks.iter().map(move |track| track.at(frame))).collect();
    }
    (0..count).map(|_| one_pair(set, &shapes, &mut random)).collect()
}

/// The same pairs as [`pairs3`], by frame: pair `i` of a frame continues as pair `i` of the next. A set that is no
/// sequence is one frame.
pub fn frames3(kind: SolidKind, set: PairSet, count: usize, seed: u64) -> Vec<Vec<PosedPair3>> {
    let pairs = pairs3(kind, set, count, seed);
    let length = if set.is_sequence() { pairs.len() / FRAMES } else { pairs.len() };
    pairs.chunks(length.max(1)).map(<[PosedPair3]>::to_vec).collect()
}

/// A shape, and what is needed to place it.
struct Solid {
    shape: Shape3,
    vertices: Vec<DVec3>,
    /// The larger half of its faces, the largest first: bodies do not come to rest on slivers.
    faces: Vec<Face>,
}

#[derive(Clone, Copy)]
struct Face {
    normal: DVec3,
    center: DVec3,
    /// Distance of the centre from the nearest edge.
    radius: f64,
}

impl Solid {
    fn new(shape: Shape3) -> Self {
        let vertices = vertices3(&shape);
        let core = shape.core();
        let mut faces: Vec<Face> =
            core.normals().iter().zip(0..).map(|(&n, i)| face(core.topology(), i, n, &vertices)).collect();
        faces.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        faces.truncate(faces.len().div_ceil(2));
        Self { shape, vertices, faces }
    }

    fn turned(&self, turn: Turn) -> Vec<DVec3> {
        self.vertices.iter().map(|&v| turn.apply(v)).collect()
    }
}

fn face(topology: &Topology, index: usize, normal: DVec3, vertices: &[DVec3]) -> Face {
    let corners: Vec<DVec3> = topology.face_vertices(index).map(|i| vertices[i]).collect();
    let center = corners.iter().fold(DVec3::ZERO, |sum, &v| sum + v) / corners.len() as f64;
    let to_edge = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        let across = unit(to - from).cross(center - from);
        across.dot(across).sqrt()
    };
    let radius = (0..corners.len()).map(to_edge).fold(f64::INFINITY, f64::min);
    Face { normal, center, radius }
}

fn pick<'a>(shapes: &'a [Solid], random: &mut Random) -> &'a Solid {
    &shapes[random.below(shapes.len())]
}

/// `offset` is from A's position to B's.
fn posed(a: &Solid, turn_a: Turn, b: &Solid, turn_b: Turn, at: DVec3, offset: DVec3) -> PosedPair3 {
    PosedPair3 {
        shape_a: a.shape.clone(),
        pose_a: pose(at, turn_a),
        shape_b: b.shape.clone(),
        pose_b: pose(at + offset, turn_b),
    }
}

pub(crate) fn pose(position: DVec3, turn: Turn) -> Pose3 {
    Pose3::new(position, turn.to_quat()).expect("a scene's poses are finite and near by construction")
}

fn place(random: &mut Random) -> DVec3 {
    random.within(DVec3::splat(-5.0), DVec3::splat(5.0))
}

fn size(a: &Solid, b: &Solid) -> f64 {
    f64::from(a.shape.outer_radius()) + f64::from(b.shape.outer_radius())
}

fn one_pair(set: PairSet, shapes: &[Solid], random: &mut Random) -> PosedPair3 {
    let (a, b) = (pick(shapes, random), pick(shapes, random));
    let (turn_a, turn_b, at) = (random.turn(), random.turn(), place(random));
    let offset = match set {
        PairSet::Mixed => return mixed(a, b, random),
        PairSet::Rest | PairSet::Slide => {
            let stack = Stack::new(a, b, random);
            let (x, y) = (random.range(-0.5, 0.5), random.range(-0.5, 0.5));
            return stack.at(a, b, x, y);
        }
        PairSet::Touch => return touch(a, b, random),
        PairSet::Far => random.direction() * random.range(4.0, 10.0),
        PairSet::Deep | PairSet::Tumble => random.direction() * random.range(0.0, 0.1),
        PairSet::Same => return posed(a, turn_a, a, turn_a, at, DVec3::ZERO),
        PairSet::Turned => {
            // About the shape's centre, which is not its origin where points are random.
            let center = a.shape.center().as_dvec3();
            return posed(a, turn_a, a, turn_b, at, turn_a.apply(center) - turn_b.apply(center));
        }
    };
    posed(a, turn_a, b, turn_b, at, offset)
}

/// Draws uniformly among all placements whose AABBs overlap, until the pair is apart or not as decided beforehand.
fn mixed(a: &Solid, b: &Solid, random: &mut Random) -> PosedPair3 {
    let wanted_apart = random.unit() < 0.4;
    loop {
        let (turn_a, turn_b) = (random.turn(), random.turn());
        let (points_a, mut points_b) = (a.turned(turn_a), b.turned(turn_b));
        let (low_a, high_a) = corners(&points_a);
        let (low_b, high_b) = corners(&points_b);
        let offset = random.within(low_a - high_b, high_a - low_b);
        points_b.iter_mut().for_each(|v| *v += offset);
        if surely_apart(&points_a, &points_b) == wanted_apart {
            return posed(a, turn_a, b, turn_b, place(random), offset);
        }
    }
}

fn corners(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)))
}

/// A face of B lies on a face of A.
struct Stack {
    turn_a: Turn,
    turn_b: Turn,
    at: DVec3,
    /// From A's position to B's when the faces' centres meet.
    centered: DVec3,
    /// Two directions in the common plane, as long as A's face is wide.
    along: [DVec3; 2],
}

impl Stack {
    fn new(a: &Solid, b: &Solid, random: &mut Random) -> Self {
        let face_a = a.faces[random.below(a.faces.len())];
        let face_b = b.faces[random.below(b.faces.len())];
        let turn_a = random.turn();
        let up = turn_a.apply(face_a.normal);
        let spin = Turn::about(up, random.range(0.0, TAU));
        let turn_b = spin.after(Turn::between(face_b.normal, -up));
        let sunk = random.log_range(1e-4, 1e-3) * size(a, b);
        let centered = turn_a.apply(face_a.center) - turn_b.apply(face_b.center) - up * sunk;
        let x = unit(up.cross(random.direction()));
        let along = [x * face_a.radius, up.cross(x) * face_a.radius];
        Self { turn_a, turn_b, at: place(random), centered, along }
    }

    fn at(&self, a: &Solid, b: &Solid, x: f64, y: f64) -> PosedPair3 {
        let offset = self.centered + self.along[0] * x + self.along[1] * y;
        posed(a, self.turn_a, b, self.turn_b, self.at, offset)
    }
}

/// B's lowest vertex over a face of A.
fn touch(a: &Solid, b: &Solid, random: &mut Random) -> PosedPair3 {
    let face = a.faces[random.below(a.faces.len())];
    let (turn_a, turn_b) = (random.turn(), random.turn());
    let up = turn_a.apply(face.normal);
    let lowest = b.turned(turn_b).into_iter().min_by(|p, q| p.dot(up).total_cmp(&q.dot(up)));
    let gap = random.range(-1e-3, 1e-3) * size(a, b);
    let across = unit(up.cross(random.direction())) * (face.radius * random.range(0.0, 0.8));
    let offset = turn_a.apply(face.center) + across + up * gap - lowest.unwrap_or_default();
    posed(a, turn_a, b, turn_b, place(random), offset)
}

/// One pair over [`FRAMES`] frames.
enum Track<'a> {
    Slide { a: &'a Solid, b: &'a Solid, stack: Stack, y: f64 },
    Tumble { a: &'a Solid, b: &'a Solid, start: Stack, axis: DVec3, angle: f64 },
}

impl<'a> Track<'a> {
    fn new(set: PairSet, shapes: &'a [Solid], random: &mut Random) -> Self {
        let (a, b) = (pick(shapes, random), pick(shapes, random));
        let mut start = Stack::new(a, b, random);
        if set == PairSet::Slide {
            return Self::Slide { a, b, stack: start, y: random.range(-0.3, 0.3) };
        }
        start.turn_b = random.turn();
        // At this share of the sum of the radii, the angle decides whether two solids touch.
        start.centered = random.direction() * (size(a, b) * random.range(0.75, 0.9));
        let angle = random.range(1.0, 3.0) * TAU / 360.0;
        Self::Tumble { a, b, start, axis: random.direction(), angle }
    }

    fn at(&self, frame: usize) -> PosedPair3 {
        match self {
            Self::Slide { a, b, stack, y } => {
                stack.at(a, b, -0.8 + 1.6 * frame as f64 / (FRAMES - 1) as f64, *y)
            }
            Self::Tumble { a, b, start, axis, angle } => {
                let turn_b = Turn::about(*axis, angle * frame as f64).after(start.turn_b);
                posed(a, start.turn_a, b, turn_b, start.at, start.centered)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The separation along one world axis from A to B, negative for overlap.
    fn gap(pair: &PosedPair3, axis: DVec3) -> f64 {
        let reach = |shape: &Shape3, pose: &Pose3, axis: DVec3| {
            vertices3(shape)
                .iter()
                .map(|v| (pose.basis().turn(*v) + pose.position()).dot(axis))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        -reach(&pair.shape_b, &pair.pose_b, -axis) - reach(&pair.shape_a, &pair.pose_a, axis)
    }

    /// The greatest separation along a face normal of A, as a share of the size.
    fn best_gap(pair: &PosedPair3) -> f64 {
        let normals = pair.shape_a.core().normals().to_vec();
        let turn = pair.pose_a.basis();
        let best = normals.iter().map(|n| gap(pair, turn.turn(*n))).fold(f64::NEG_INFINITY, f64::max);
        best / f64::from(pair.shape_a.outer_radius() + pair.shape_b.outer_radius())
    }

    fn world_points(shape: &Shape3, pose: &Pose3) -> Vec<DVec3> {
        vertices3(shape).into_iter().map(|v| pose.position() + pose.basis().turn(v)).collect()
    }

    fn is_apart(p: &PosedPair3) -> bool {
        surely_apart(&world_points(&p.shape_a, &p.pose_a), &world_points(&p.shape_b, &p.pose_b))
    }

    #[test]
    fn mixed_pairs_have_overlapping_boxes_and_two_of_five_are_apart() {
        for kind in SolidKind::ALL {
            let pairs = pairs3(kind, PairSet::Mixed, 1000, 1);
            let apart = pairs.iter().filter(|p| is_apart(p)).count();
            assert!((350..450).contains(&apart), "{}: {apart} of 1000 apart", kind.name());
            let bounds =
                |p: &PosedPair3| (p.shape_a.bounds(&p.pose_a, 0.0), p.shape_b.bounds(&p.pose_b, 0.0));
            assert!(pairs.iter().map(bounds).all(|(a, b)| a.overlaps(&b)));
        }
    }

    #[test]
    fn resting_pairs_are_sunk_by_a_thousandth_at_most() {
        for kind in SolidKind::ALL {
            for pair in pairs3(kind, PairSet::Rest, 200, 1) {
                // The common normal is a face normal of A: the one with the least overlap.
                let normals = pair.shape_a.core().normals().to_vec();
                let turn = pair.pose_a.basis();
                let best =
                    normals.iter().map(|n| gap(&pair, turn.turn(*n))).fold(f64::NEG_INFINITY, f64::max);
                let size = f64::from(pair.shape_a.outer_radius() + pair.shape_b.outer_radius());
                assert!((-1.1e-3..-0.9e-4).contains(&(best / size)), "{}: {best}", kind.name());
            }
        }
    }

    #[test]
    fn far_is_apart_and_deep_is_not() {
        for kind in SolidKind::ALL {
            assert!(pairs3(kind, PairSet::Far, 100, 1).iter().all(is_apart));
            assert!(!pairs3(kind, PairSet::Deep, 100, 1).iter().any(is_apart));
            let gaps: Vec<f64> = pairs3(kind, PairSet::Touch, 400, 1).iter().map(best_gap).collect();
            let apart = gaps.iter().filter(|&&gap| gap > 0.0).count();
            assert!((150..250).contains(&apart), "{}: {apart} of 400 apart", kind.name());
            assert!(gaps.iter().all(|gap| gap.abs() < 1.1e-3), "{}", kind.name());
        }
    }

    #[test]
    fn concentric_pairs_are_one_shape_about_one_centre() {
        for kind in SolidKind::GROWTH {
            for (set, is_turned) in [(PairSet::Same, false), (PairSet::Turned, true)] {
                for pair in pairs3(kind, set, 20, 1) {
                    assert_eq!(pair.shape_a, pair.shape_b);
                    let center = pair.shape_a.center();
                    let apart = pair.pose_a.transform(center) - pair.pose_b.transform(center);
                    assert!(apart.length() < 1e-6, "{}: {apart}", kind.name());
                    assert_eq!(pair.pose_a != pair.pose_b, is_turned);
                }
            }
        }
    }

    #[test]
    fn growing_hulls_have_the_vertices_that_they_are_named_after() {
        let counts = SolidKind::GROWTH.map(|kind| vertices3(&solids(kind, 1, 1)[0]).len());
        assert_eq!(counts, [64, 128, 256, 256, 256]);
    }

    #[test]
    fn sequences_are_coherent() {
        for set in [PairSet::Slide, PairSet::Tumble] {
            let frames = frames3(SolidKind::Hull32, set, 600, 1);
            assert_eq!(frames.len(), FRAMES);
            for (now, next) in frames.iter().zip(&frames[1..]) {
                for (p, q) in now.iter().zip(next) {
                    assert_eq!(p.shape_b, q.shape_b);
                    let moved = (p.pose_b.position() - q.pose_b.position()).length();
                    let turned = (p.pose_b.basis().x - q.pose_b.basis().x).length();
                    assert!(moved < 0.03 && turned < 0.06 && moved + turned > 1e-4);
                }
            }
        }
    }

    #[test]
    fn equal_seeds_give_equal_bits() {
        for set in PairSet::ALL {
            let poses = |seed| -> Vec<[Pose3; 2]> {
                pairs3(SolidKind::Hull8, set, 60, seed).iter().map(|p| [p.pose_a, p.pose_b]).collect()
            };
            assert_eq!(poses(5), poses(5));
            assert_ne!(poses(5), poses(6));
        }
    }
}
