//! Faces on faces, with an overlap of a chosen share of the size.

use asunder_geometry::{Pose2, Pose3, Rotation2, Shape2, Shape3};
use asunder_scenes::pairs::{PlaneKind, PosedPair2, PosedPair3, SolidKind, polygons, solids};
use asunder_scenes::random::Random;
use glam::{DQuat, DVec2, DVec3, Quat};

/// How many different shapes a set draws from.
const DISTINCT: usize = 16;

const IN_RANGE: &str = "finite and near by construction";

/// `count` pairs of solids, a face of B on a face of A, with an overlap of `sunk` times the pair's size.
///
/// ```
/// use asunder_benches::certain::rest3;
/// use asunder_scenes::pairs::SolidKind;
/// let pairs = rest3(SolidKind::Box, 1e-4, 10, 1);
/// assert!(pairs.len() == 10 && pairs[0].pose_a != pairs[1].pose_a);
/// ```
pub fn rest3(kind: SolidKind, sunk: f64, count: usize, seed: u64) -> Vec<PosedPair3> {
    let shapes: Vec<Solid> = solids(kind, DISTINCT, seed).into_iter().map(Solid::new).collect();
    let mut random = Random::new(seed ^ 0x4e57);
    let pick = |random: &mut Random| random.below(shapes.len());
    (0..count)
        .map(|_| {
            let (a, b) = (pick(&mut random), pick(&mut random));
            stacked3(&shapes[a], &shapes[b], sunk, &mut random)
        })
        .collect()
}

/// A solid, with the larger half of its faces: bodies do not come to rest on slivers.
struct Solid {
    shape: Shape3,
    faces: Vec<Face>,
}

#[derive(Clone, Copy)]
struct Face {
    normal: DVec3,
    center: DVec3,
    /// Distance of the centre from the nearest corner.
    radius: f64,
}

impl Solid {
    fn new(shape: Shape3) -> Self {
        let core = shape.core();
        let face = |(index, normal): (usize, &DVec3)| {
            let corners: Vec<DVec3> =
                core.topology().face_vertices(index).map(|v| core.vertices()[v].as_dvec3()).collect();
            let center = corners.iter().sum::<DVec3>() / corners.len() as f64;
            let radius = corners.iter().map(|v| v.distance(center)).fold(f64::INFINITY, f64::min);
            Face { normal: *normal, center, radius }
        };
        let mut faces: Vec<Face> = core.normals().iter().enumerate().map(face).collect();
        faces.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        faces.truncate(faces.len().div_ceil(2));
        Self { shape, faces }
    }

    /// The greatest height of the shape's points along an axis, relative to its position.
    fn reach(&self, pose: &Pose3, axis: DVec3) -> f64 {
        let (core, basis) = (self.shape.core(), pose.basis());
        let heights = core.vertices().iter().map(|v| basis.turn(v.as_dvec3()).dot(axis));
        heights.fold(f64::NEG_INFINITY, f64::max)
    }
}

fn stacked3(a: &Solid, b: &Solid, sunk: f64, random: &mut Random) -> PosedPair3 {
    let at = random.within(DVec3::splat(-5.0), DVec3::splat(5.0));
    let pose_a = Pose3::new(at, random.rotation()).expect(IN_RANGE);
    let (face_a, face_b) = (a.faces[random.below(a.faces.len())], b.faces[random.below(b.faces.len())]);
    let up = pose_a.basis().turn(face_a.normal).normalize();
    // A random rotation, then the smallest one that turns B's face down: so its spin is random.
    let spin = random.rotation().as_dquat().normalize();
    let turn = DQuat::from_rotation_arc((spin * face_b.normal).normalize(), -up) * spin;
    let rotation: Quat = turn.as_quat();
    // B's height follows from the shapes under the rotations as stored.
    let turned_b = Pose3::new(DVec3::ZERO, rotation).expect(IN_RANGE);
    let size = f64::from(a.shape.outer_radius()) + f64::from(b.shape.outer_radius());
    let height = a.reach(&pose_a, up) + b.reach(&turned_b, -up) - sunk * size;
    let across = up.cross(random.direction()) * (0.5 * face_a.radius * random.unit());
    let beside = pose_a.basis().turn(face_a.center) - turned_b.basis().turn(face_b.center) + across;
    let offset = beside + up * (height - beside.dot(up));
    PosedPair3 {
        shape_a: a.shape.clone(),
        pose_a,
        shape_b: b.shape.clone(),
        pose_b: Pose3::new(at + offset, rotation).expect(IN_RANGE),
    }
}

/// `count` pairs in the plane, an edge of B on an edge of A, with an overlap of `sunk` times the pair's size.
///
/// ```
/// use asunder_benches::certain::rest2;
/// use asunder_scenes::pairs::PlaneKind;
/// assert_eq!(rest2(PlaneKind::Poly8, 1e-4, 10, 1).len(), 10);
/// ```
pub fn rest2(kind: PlaneKind, sunk: f64, count: usize, seed: u64) -> Vec<PosedPair2> {
    let shapes = polygons(kind, DISTINCT, seed);
    let mut random = Random::new(seed ^ 0x4e57);
    let pick = |random: &mut Random| random.below(shapes.len());
    (0..count)
        .map(|_| {
            let (a, b) = (pick(&mut random), pick(&mut random));
            stacked2(&shapes[a], &shapes[b], sunk, &mut random)
        })
        .collect()
}

/// A random edge: its midpoint, half of it as a vector, and its outward unit normal.
fn edge(shape: &Shape2, random: &mut Random) -> (DVec2, DVec2, DVec2) {
    let core = shape.core();
    let vertices = core.vertices();
    let index = random.below(vertices.len());
    let (from, to) = (vertices[index].as_dvec2(), vertices[(index + 1) % vertices.len()].as_dvec2());
    let half = (to - from) * 0.5;
    ((from + to) * 0.5, half, -half.perp().normalize())
}

fn rotation(direction: DVec2) -> Rotation2 {
    let unit = direction.normalize().as_vec2();
    Rotation2::new(unit.x, unit.y).expect(IN_RANGE)
}

fn stacked2(a: &Shape2, b: &Shape2, sunk: f64, random: &mut Random) -> PosedPair2 {
    let at = random.within(DVec3::splat(-5.0), DVec3::splat(5.0)).truncate();
    let (middle_a, half_a, normal_a) = edge(a, random);
    let (middle_b, _, normal_b) = edge(b, random);
    let turn_a = rotation(random.direction().truncate());
    let up = turn_a.turn(normal_a).normalize();
    // The complex number that turns B's normal down.
    let turn_b = rotation(DVec2::new(normal_b.x, -normal_b.y).rotate(-up));
    let reach = |shape: &Shape2, turn: &Rotation2, axis: DVec2| {
        let core = shape.core();
        let heights = core.vertices().iter().map(|v| turn.turn(v.as_dvec2()).dot(axis));
        heights.fold(f64::NEG_INFINITY, f64::max)
    };
    let size = f64::from(a.outer_radius()) + f64::from(b.outer_radius());
    let height = reach(a, &turn_a, up) + reach(b, &turn_b, -up) - sunk * size;
    let beside = turn_a.turn(middle_a + half_a * random.range(-0.5, 0.5)) - turn_b.turn(middle_b);
    let offset = beside + up * (height - beside.dot(up));
    PosedPair2 {
        shape_a: a.clone(),
        pose_a: Pose2::new(at, turn_a).expect(IN_RANGE),
        shape_b: b.clone(),
        pose_b: Pose2::new(at + offset, turn_b).expect(IN_RANGE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_tests::report::Posed;

    #[test]
    fn faces_lie_as_deep_as_was_asked() {
        for sunk in [1e-3, 1e-4, 1e-5] {
            for kind in [SolidKind::Box, SolidKind::Hull32] {
                for pair in rest3(kind, sunk, 20, 1) {
                    let share = -pair.truth().separation / pair.size();
                    // A rotation in f32 tilts a face by 1e-7.
                    assert!((share - sunk).abs() < 1e-6, "{}: {share} for {sunk}", kind.name());
                }
            }
            for pair in rest2(PlaneKind::Poly8, sunk, 20, 1) {
                let share = -pair.truth().separation / pair.size();
                assert!((share - sunk).abs() < 1e-6, "poly8: {share} for {sunk}");
            }
        }
    }
}
