//! Contact points of two cuboids, computed side by side, against those of the general clipper, computed one by one.

use super::super::sat::tests::Random;
use super::super::sat::{AxisOf, hint_to};
use super::queries::Contact;
use crate::pair3::reach_of;
use crate::{ContactPoint3, Feature, FeatureId, Hint, Manifold3, Pair3};
use asunder_geometry::glam::{Quat, Vec3};
use asunder_geometry::{Cuboid, Pose3, Shape3};

fn ids(manifold: &Manifold3) -> Vec<FeatureId> {
    manifold.points.iter().map(|point| point.feature).collect()
}

/// Twice the area that points span as projected along a normal, in any order.
fn area(points: &[ContactPoint3], normal: Vec3) -> f32 {
    let at = |i: usize| points[i].anchor_a;
    let across =
        |i: usize, j: usize, k: usize, l: usize| (at(j) - at(i)).cross(at(l) - at(k)).dot(normal).abs();
    match points.len() {
        // The pairing with the largest area is that of the diagonals.
        4 => across(0, 1, 2, 3).max(across(0, 2, 1, 3)).max(across(0, 3, 1, 2)),
        3 => across(0, 1, 0, 2),
        _ => 0.0,
    }
}

/// Two cuboids, face near face, rotated a little, much or not at all against each other.
fn pair(random: &mut Random, round: usize) -> ([Shape3; 2], [Pose3; 2], f32) {
    let halves = [0, 1].map(|_| random.vector().abs() * 0.6 + 0.2);
    let shapes = halves.map(|half| Shape3::from(Cuboid::from_half_extents(half).unwrap()));
    let tilt = [0.0, 1e-4, 0.02, 1.0][round % 4];
    let (x, y) = (tilt * random.number(), tilt * random.number());
    let spin = Quat::from_xyzw(x, y, [random.number(), 0.0][round / 4 % 3 / 2], 1.0).normalize();
    let aside = Vec3::new(random.number(), random.number(), 0.0) * 0.7;
    // Every third round has a gap, mostly narrower than the margin.
    let lift = if round % 3 == 1 { 0.04 } else { -0.05 } * random.number().abs();
    // And every fifth round has a corner of one within some slacks of a side of the other.
    let beside = (halves[0].x - halves[1].x) + random.number() * 8e-6;
    let aside = if round % 5 == 2 { Vec3::new(beside, aside.y, 0.0) } else { aside };
    let above = aside + Vec3::Z * (halves[0].z + halves[1].z + lift);
    let turn = random.turn(0).normalize();
    let at = random.vector();
    let poses = [Pose3::new(at, turn), Pose3::new(at + turn * above, turn * spin)].map(Result::unwrap);
    (shapes, poses, if round.is_multiple_of(2) { 0.0 } else { 0.03 })
}

/// Two cuboids, rotated a little or much against each other, with two edges that cross over a gap, mostly narrower than
/// the margin.
fn crossed(random: &mut Random, round: usize) -> ([Shape3; 2], [Pose3; 2], f32) {
    let halves = [0, 1].map(|_| random.vector().abs() * 0.6 + 0.2);
    let tilt = [0.03, 0.09, 0.3, 1.0][round % 4];
    let spin = Quat::from_vec4((random.vector() * tilt).extend(1.0)).normalize();
    let turn = random.turn(0).normalize();
    let (turns, axes) = ([turn, turn * spin], [round / 4 % 3, round / 12 % 3]);
    let along = [0, 1].map(|i| turns[i] * Vec3::AXES[axes[i]]);
    let normal = along[0].cross(along[1]).normalize();
    let edges = [0, 1].map(|i| (axes[i], 0.95 * random.number() * halves[i][axes[i]]));
    let gap = [0.0, 0.001, 0.02, 0.035][round / 36 % 4] * random.number().abs();
    let (shapes, poses) = over_each_other(halves, turns, edges, (normal, gap));
    (shapes, poses, 0.03)
}

/// Two cuboids by their rotations. One edge of each crosses the other, `gap` metres apart along a normal; `edges` are
/// the edges' axes and where along those they cross.
fn over_each_other(
    halves: [Vec3; 2],
    turns: [Quat; 2],
    edges: [(usize, f32); 2],
    (normal, gap): (Vec3, f32),
) -> ([Shape3; 2], [Pose3; 2]) {
    let [on_a, on_b] = [0, 1].map(|i| {
        let towards = if i == 0 { normal } else { -normal };
        let mut corner = halves[i].copysign(turns[i].inverse() * towards);
        corner[edges[i].0] = edges[i].1;
        turns[i] * corner
    });
    let poses = [(Vec3::ZERO, turns[0]), (on_a + normal * gap - on_b, turns[1])];
    let shapes = halves.map(|half| Shape3::from(Cuboid::from_half_extents(half).unwrap()));
    (shapes, poses.map(|(at, turn)| Pose3::new(at, turn.normalize()).unwrap()))
}

/// Which kernels answered, and how that compared with the general path.
#[derive(Debug, Default)]
struct Compared {
    /// Manifolds by their number of points.
    points: [usize; 5],
    reduced: usize,
    same_four: usize,
    /// Answered across a gap by a face, and by edges: with one point, or with more.
    across_faces: usize,
    across_edges: [usize; 2],
    leaning: usize,
}

impl Compared {
    /// Compares 8000 pairs.
    fn of(seed: u64, pair: impl Fn(&mut Random, usize) -> ([Shape3; 2], [Pose3; 2], f32)) -> Self {
        let (mut random, mut compared) = (Random(seed), Self::default());
        for round in 0..8000 {
            compared.compare(round, pair(&mut random, round));
        }
        compared
    }

    /// Compares the cuboid kernels with the general path.
    fn compare(&mut self, round: usize, (shapes, poses, margin): ([Shape3; 2], [Pose3; 2], f32)) {
        let pair = Pair3::new(&shapes[0], &poses[0], &shapes[1], &poses[1]);
        let mut plain = Vec::new();
        let _ = pair.general_contact(margin, Hint::NONE, &mut Some(&mut plain));
        let (found, plain) = (pair.manifold(margin), plain.pop());
        let (Some(found), Some(plain)) = (&found, &plain) else {
            assert_eq!(found.is_some(), plain.is_some(), "round {round}");
            return;
        };
        let size = f64::from(pair.size());
        let apart = f64::from(found.separation) - f64::from(plain.separation);
        let errors = f64::from(found.error) + f64::from(plain.error);
        assert!(apart.abs() <= errors, "round {round}: {found:?}, {plain:?}");
        let mut room = Manifold3::BLANK;
        let contact = pair.cuboids().unwrap().contact(reach_of(margin), Hint::NONE, Some(&mut room));
        let of_edges = |hint: Hint| {
            hint.features().is_some_and(|of| matches!((of.a(), of.b()), (Feature::Edge(_), Feature::Edge(_))))
        };
        match contact {
            Contact::Near(hint) if of_edges(hint) => {
                self.across_edges[usize::from(room.points.len() > 1)] += 1;
            }
            Contact::Near(_) => self.across_faces += 1,
            Contact::Touching(hint) if of_edges(hint) && room.points.len() > 2 => self.leaning += 1,
            _ => {}
        }
        // Of faces and edges that are equal up to rounding, either may be chosen.
        if found.normal.dot(plain.normal) < 0.999_999 {
            let even = f64::from(found.separation - plain.separation).abs();
            assert!(even <= f64::from(found.error + plain.error), "round {round}: {found:?}, {plain:?}");
            return;
        }
        assert_eq!(found.points.len(), plain.points.len(), "round {round}: {found:?}, {plain:?}");
        self.points[found.points.len()] += 1;
        if ids(found) == ids(plain) {
            for (one, other) in found.points.iter().zip(&plain.points) {
                // Both are rounded to f32 at the end; the numbers before that agree to some 1e-13.
                let near = |p: Vec3, q: Vec3| f64::from((p - q).length()) <= 2e-7 * size;
                let is_near = near(one.anchor_a, other.anchor_a) && near(one.anchor_b, other.anchor_b);
                assert!(is_near, "round {round}: {one:?}, {other:?}");
                assert!(f64::from(one.separation - other.separation).abs() <= 1e-7 * size, "round {round}");
            }
            self.same_four += usize::from(found.points.len() == 4);
        } else {
            // Of more than four corners any four that are worth as much may be kept, up to two parts in a thousand.
            let areas = [found, plain].map(|manifold| area(&manifold.points, manifold.normal));
            let is_reduced = found.points.len() == 4 && areas[0] >= 0.997 * areas[1];
            assert!(is_reduced, "round {round}: {areas:?}, {found:?}, {plain:?}");
            self.reduced += 1;
        }
    }
}

#[test]
fn side_by_side_or_one_by_one_the_points_are_the_same() {
    let compared = Compared::of(0x9E6D_62D0_6F6A_3B1F, pair);
    assert!(compared.points[1..].iter().all(|&count| count > 200), "{compared:?}");
    assert!(compared.across_faces > 200 && compared.leaning > 200, "{compared:?}");
    let Compared { same_four, reduced, .. } = compared;
    assert!(same_four > 3500 && reduced * 50 < same_four, "{reduced} kept others, {same_four} the same");
}

#[test]
fn edges_that_cross_over_a_gap_have_the_points_of_the_general_path() {
    let compared = Compared::of(0x51C4_0A3B_90D1_77E2, crossed);
    let [alone, more] = compared.across_edges;
    assert!(alone > 1500 && more > 200, "{compared:?}");
}

fn about(axis: Vec3, angle: f32) -> Quat {
    let (sin, cos) = libm::sincosf(0.5 * angle);
    Quat::from_vec4((axis * sin).extend(cos))
}

/// The rotation of a cuboid that puts its edges along one of its axes along x, then rolls it about x.
fn lying(axis: usize, roll: f32) -> Quat {
    about(Vec3::X, roll) * Quat::from_rotation_arc(Vec3::AXES[axis], Vec3::X)
}

/// Checks that the cuboid kernels' contact across a gap, if they find one, has the normal and the points of the general
/// path. Returns whether they do, and how many points there are.
fn contacts_agree(
    name: &str,
    (shapes, poses): &([Shape3; 2], [Pose3; 2]),
    hint: Hint,
) -> Option<(bool, usize)> {
    const MARGIN: f32 = 0.03;
    let pair = Pair3::new(&shapes[0], &poses[0], &shapes[1], &poses[1]);
    let (mut room, mut plain) = (Manifold3::BLANK, Vec::new());
    let contact = pair.cuboids().unwrap().contact(reach_of(MARGIN), hint, Some(&mut room));
    let _ = pair.general_contact(MARGIN, hint, &mut Some(&mut plain));
    let plain = plain.pop().filter(|plain| plain.separation > 0.0)?;
    let is_found = matches!(contact, Contact::Near(_));
    if is_found {
        assert!(room.normal.dot(plain.normal) > 0.999_999, "{name}: {room:?}, {plain:?}");
        assert_eq!(ids(&room), ids(&plain), "{name}: {room:?}, {plain:?}");
    }
    Some((is_found, plain.points.len()))
}

/// Edges that nearly run along each other, or overlap only with their ends, touch at both ends of the stretch that they
/// share. The point where they cross would be a single one, anywhere between those.
#[test]
fn edges_that_cross_but_lie_side_by_side_are_left_to_the_general_path() {
    let mut random = Random(0x2B1D_7C45_E09A_6F33);
    let (mut crossing, mut beside) = (0, 0);
    for round in 0..4000 {
        let halves = [0, 1].map(|_| random.vector().abs() * 0.6 + 0.2);
        let turn = random.turn(0).normalize();
        // From parallel up to rounding to a third of a radian. The shared stretch is so long that its ends are about a
        // preference beside each other.
        let angle = libm::powf(10.0, -3.5 + 3.0 * random.number());
        let shared = (3e-6 / angle).min(0.2);
        let edges = [round % 3, round / 3 % 3];
        // Not at the very end: there the general path may name the corner, which is as near up to rounding.
        let mut end = |i: usize| halves[i][edges[i]] - shared * (0.1 + 0.9 * random.number().abs());
        let places = [end(0), -end(1)];
        let rolls = [0, 1].map(|_| 0.8 + 0.5 * random.number());
        let turns =
            [turn * lying(edges[0], rolls[0]), turn * about(Vec3::Z, angle) * lying(edges[1], rolls[1])];
        let gap = (turn * Vec3::Z, 0.001 + 0.02 * random.number().abs());
        let pair = over_each_other(halves, turns, [(edges[0], places[0]), (edges[1], places[1])], gap);
        match contacts_agree(&format!("round {round}"), &pair, Hint::NONE) {
            Some((true, _)) => crossing += 1,
            Some((false, 2)) => beside += 1,
            _ => {}
        }
    }
    assert!(crossing > 300 && beside > 500, "{crossing} cross, {beside} lie side by side");
}

/// A face whose separation is less than that of two edges, but by no more than the preference, is what the cuboids
/// touch on; by twice as much, if they did so in the last frame.
#[test]
fn edges_that_cross_hardly_nearer_than_a_face_parts_are_left_to_the_general_path() {
    let mut random = Random(0x7D20_98F1_3C5B_A64E);
    let (mut of_edges, mut left) = (0, [0; 2]);
    for round in 0..4000 {
        let halves = [0, 1].map(|_| random.vector().abs() * 0.6 + 0.2);
        let turn = random.turn(0).normalize();
        // How far the normal at the crossing leans from that of A's upper face, over its side ahead.
        let lean = libm::powf(10.0, -3.0 + 2.5 * random.number());
        let (across, edge) = (0.3 + 1.2 * random.number().abs(), round % 3);
        // The part of B's edge beyond the side is lower over the face than the crossing.
        let beyond = (4e-6 / lean).min(0.1) * random.number().abs();
        let turns =
            [turn * lying(0, lean), turn * about(Vec3::Z, across) * lying(edge, 0.8 + 0.5 * random.number())];
        let places = [0.9 * halves[0].x * random.number(), halves[1][edge] - beyond];
        let gap = (turn * Vec3::Z, (4e-6 / (lean * lean)).min(0.02) * random.number().abs());
        let pair = over_each_other(halves, turns, [(0, places[0]), (edge, places[1])], gap);
        for (kept, hint) in [Hint::NONE, hint_to(AxisOf::FaceA(5))].into_iter().enumerate() {
            match contacts_agree(&format!("round {round}"), &pair, hint) {
                Some((true, _)) => of_edges += 1,
                Some((false, _)) => left[kept] += 1,
                None => {}
            }
        }
    }
    assert!(
        of_edges > 500 && left.iter().all(|&count| count > 500),
        "{of_edges} in closed form, {left:?} left"
    );
}
