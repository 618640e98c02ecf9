//! Order does not matter: neither of the two shapes, nor of the jobs in a batch.

use super::scenes::{BODIES, Random, body, grid, mesh};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, FeatureId, Hint, Job3, Manifold3, Pair3, collide3};

/// The manifold with A and B swapped.
fn mirrored(manifold: &Manifold3) -> Manifold3 {
    let mut mirrored = *manifold;
    core::mem::swap(&mut mirrored.part_a, &mut mirrored.part_b);
    mirrored.normal = -manifold.normal;
    for point in &mut mirrored.points {
        core::mem::swap(&mut point.anchor_a, &mut point.anchor_b);
        point.feature = FeatureId::new(point.feature.b(), point.feature.a());
    }
    mirrored.points.sort_unstable_by_key(|point| point.feature);
    mirrored
}

struct Placed {
    shape: Shape3,
    pose: Pose3,
}

fn scenes() -> (Shape3, Pose3, Vec<Placed>) {
    let mut random = Random::new(23);
    let heights: Vec<f32> = (0..81).map(|_| random.signed() as f32 * 0.3).collect();
    let ground = mesh(grid([8; 2], 0.5, |x, z| Vec3::Y * heights[z * 9 + x])).into();
    let ground_pose = Pose3::new(random.vector() * 1e3, random.rotation()).unwrap();
    let bodies = (0..400)
        .map(|round| {
            let place = DVec3::new(random.signed() * 1.5, random.between(0.0, 0.7), random.signed() * 1.5);
            let pose = Pose3::new(ground_pose.transform(place), random.rotation()).unwrap();
            Placed { shape: body(round % BODIES), pose }
        })
        .collect();
    (ground, ground_pose, bodies)
}

#[test]
fn swapped_the_answer_is_mirrored() {
    let (ground, ground_pose, bodies) = scenes();
    let mut seen = 0;
    for Placed { shape, pose } in &bodies {
        let one = Pair3::new(shape, pose, &ground, &ground_pose).manifolds(0.05);
        let other = Pair3::new(&ground, &ground_pose, shape, pose).manifolds(0.05);
        let mirrored: Vec<_> = other.iter().map(mirrored).collect();
        assert_eq!(one, mirrored);
        seen += one.len();
    }
    assert!(seen > 300, "{seen}");
}

#[test]
fn in_a_batch_a_pair_says_what_it_says_alone() {
    let (ground, ground_pose, bodies) = scenes();
    let jobs: Vec<Job3> = bodies
        .iter()
        .map(|placed| Job3 {
            shape_a: &placed.shape,
            pose_a: &placed.pose,
            shape_b: &ground,
            pose_b: &ground_pose,
            margin: 0.05,
            hint: Hint::NONE,
            ahead: 0.0,
            sensor: false,
        })
        .collect();
    let mut batch = Batch3::default();
    collide3(&jobs, &mut batch);
    let mut seen = 0;
    for (answer, Placed { shape, pose }) in batch.answers.iter().zip(&bodies) {
        let alone = Pair3::new(shape, pose, &ground, &ground_pose).manifolds(0.05);
        match answer {
            Answer::Apart { .. } => assert!(alone.is_empty()),
            Answer::Contact { manifolds, .. } => {
                let told = &batch.manifolds[manifolds.start as usize..manifolds.end as usize];
                assert_eq!(told, alone);
                let deepest = Pair3::new(shape, pose, &ground, &ground_pose).manifold(0.05).unwrap();
                let least = alone.iter().map(|m| m.separation).fold(f32::INFINITY, f32::min);
                assert_eq!(deepest.separation, least);
                seen += 1;
            }
        }
    }
    assert!(seen > 150, "{seen}");
}
