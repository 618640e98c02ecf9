//! Manifolds of one convex part on ground: no two of them have the same normal.

use super::scenes::{BODIES, Random, baked, body, flat, grid, mesh, stick};
use asunder_geometry::glam::{Quat, Vec3};
use asunder_geometry::tolerance::SAME_NORMAL;
use asunder_geometry::{Pose3, Shape3, TriMesh};
use asunder_narrow::{ContactPoint3, Manifold3, Pair3};

/// The sine between two normals may lose this much when they are rounded to f32.
const ROUNDED: f64 = 4.0 * f32::EPSILON as f64;

/// Number of kinds of ground.
const GROUNDS: usize = 8;

/// Rough ground, steps, a plane whose vertices are rounded, bends far below the tolerance, and bends close to it: in a
/// row of normals, each may count as the same as the next but not as the last, and which are merged depends on the
/// order.
fn ground(random: &mut Random, kind: usize) -> TriMesh {
    let bumps = |random: &mut Random, rough: f64| {
        let heights: Vec<f32> = (0..81).map(|_| (random.signed() * rough) as f32).collect();
        mesh(grid([8; 2], 0.5, |x, z| Vec3::Y * heights[z * 9 + x]))
    };
    let made = match kind {
        0..3 => bumps(random, [0.6, 0.1, 0.02][kind]),
        3 => mesh(grid([8; 2], 0.5, |x, z| Vec3::Y * (((x * 5 + z * 3) % 7) as f32 * 0.25))),
        4 => baked(&flat(random.below(3)), random.rotation().normalize(), Vec3::ZERO),
        _ => bumps(random, [5e-6, 5e-5, 2e-4][kind - 5]),
    };
    if random.below(2) == 0 { made.one_sided() } else { made }
}

/// Asserts that two normals of a part differ by more than what counts as one, and that the points of a manifold have
/// distinct feature ids.
fn check(manifolds: &[Manifold3], what: &str) {
    for (place, one) in manifolds.iter().enumerate() {
        for other in manifolds[..place].iter().filter(|other| other.part_a == one.part_a) {
            let [n, m] = [one, other].map(|manifold| manifold.normal.as_dvec3());
            let is_same = n.dot(m) > 0.0 && n.cross(m).length() <= SAME_NORMAL - ROUNDED;
            assert!(!is_same, "{what}: {one:?} {other:?}");
        }
        for (place, point) in one.points.iter().enumerate() {
            let is_other = |known: &ContactPoint3| known.feature != point.feature;
            assert!(one.points[..place].iter().all(is_other), "{what}: {one:?}");
        }
    }
}

#[test]
fn no_two_manifolds_of_a_part_have_the_same_normal_and_no_two_points_the_same_name() {
    let mut random = Random::new(61);
    let (mut several, mut full) = ([0; GROUNDS], [0; GROUNDS]);
    for round in 0..1000 * GROUNDS {
        let kind = round % GROUNDS;
        let ground = ground(&mut random, kind);
        let body_kind = random.below(BODIES + 1);
        let shape = if body_kind == BODIES { stick() } else { body(body_kind) };
        let corner = ground.vertices()[random.below(ground.vertices().len())].as_dvec3();
        let place = corner + random.vector() * 0.5;
        // Faces on faces now and then: all of many triangles give contacts.
        let turn = match random.below(3) {
            0 => Quat::from_xyzw(0.0, random.signed() as f32, 0.0, 1.0),
            _ => random.rotation(),
        };
        let pose = Pose3::new(place, turn).unwrap();
        let ground: Shape3 = ground.into();
        let manifolds = Pair3::new(&shape, &pose, &ground, &Pose3::IDENTITY).manifolds(0.02);
        check(&manifolds, &format!("round {round}, ground {kind}, body {body_kind}"));
        several[kind] += usize::from(manifolds.iter().filter(|manifold| manifold.part_a == 0).count() > 1);
        full[kind] += usize::from(manifolds.iter().any(|manifold| manifold.points.len() == 4));
    }
    assert!(several[..4].iter().all(|&count| count > 200), "with several manifolds: {several:?}");
    assert!(full.iter().all(|&count| count > 20), "with a full one: {full:?}");
}
