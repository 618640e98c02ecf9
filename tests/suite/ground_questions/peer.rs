//! Against parry3d on its own meshes: overlaps, distances and rays, outside a band around touching.

use super::{beside, level};
use crate::shapes_peer::{pose_of, twin, vector};
use asunder_geometry::glam::Vec3;
use asunder_geometry::{Pose3, Ray3, Shape3};
use asunder_narrow::{Pair3, Separation3, cast_ray3};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{Clay, KINDS3};
use parry3d::query::{Ray, RayCast, distance, intersection_test};
use parry3d::shape::TriMesh;

/// Share of the body's size, and of a metre of ground, within which parry's answers are not compared with ours.
const BAND: f64 = 1e-3;

fn mesh_of(ground: &Shape3) -> TriMesh {
    let Shape3::TriMesh(mesh) = ground else { unreachable!() };
    TriMesh::new(mesh.vertices().iter().copied().map(vector).collect(), mesh.triangles().to_vec()).unwrap()
}

#[test]
fn parry_says_the_same_of_bodies_on_ground() {
    let (mut compared, mut refuted, mut yes) = (0, 0, 0);
    for seed in 0..1500 {
        let mut random = Random::new(seed as u128);
        // Bumps and shells, near the origin: parry's f32 cannot cope with shards and far places.
        let (ground, at) = level(&mut random, [0, 2][seed % 2]);
        let at = Pose3::new(Vec3::ZERO, at.rotation()).unwrap();
        let kind = [0, 1, 2, 4][random.below(4)];
        let body = KINDS3[kind].1(&mut Clay::thick(&mut random));
        let away = f64::from(body.outer_radius()) * random.between(0.0, 2.5);
        let place = beside(&mut random, (&ground, &at), away).as_vec3();
        let pose = Pose3::new(place, random.quaternion()).unwrap();
        let Separation3::Measured(ours) = Pair3::new(&body, &pose, &ground, &at).separation(f32::INFINITY)
        else {
            panic!("no limit");
        };
        let ours = f64::from(ours.separation);
        let (twin, theirs) = (twin(&body).unwrap(), mesh_of(&ground));
        let [pose, at] = [&pose, &at].map(|pose| pose_of(pose.position(), pose.rotation()));
        let overlap = intersection_test(&pose, &*twin.0, &at, &theirs).unwrap().intersecting;
        let gap = f64::from(distance(&pose, &*twin.0, &at, &theirs).unwrap().distance);
        let band = BAND * (1.0 + f64::from(body.outer_radius()));
        if ours.abs() <= band {
            continue;
        }
        compared += 1;
        yes += usize::from(overlap);
        let agrees = overlap == (ours <= 0.0) && (gap - ours.max(0.0)).abs() <= band;
        refuted += usize::from(!agrees);
    }
    assert!(
        compared > 1000 && yes > 200 && refuted * 100 < compared,
        "{refuted} of {compared}, {yes} overlap"
    );
}

#[test]
fn parry_says_the_same_of_rays() {
    let (mut compared, mut refuted) = (0, 0);
    for seed in 0..3000 {
        let mut random = Random::new(seed as u128);
        let (ground, at) = level(&mut random, [0, 2][seed % 2]);
        let at = Pose3::new(Vec3::ZERO, at.rotation()).unwrap();
        let from = (random.direction() * random.between(0.5, 6.0)).as_vec3();
        let aim = beside(&mut random, (&ground, &at), 0.2);
        let ray = Ray3::new(from, (aim - from.as_dvec3()).as_vec3()).unwrap();
        let theirs = mesh_of(&ground).cast_ray(
            &pose_of(at.position(), at.rotation()),
            &Ray::new(vector(from), vector(ray.direction())),
            10.0,
            true,
        );
        let ours = cast_ray3(&ground, &at, &ray, 10.0);
        compared += 1;
        let pace = f64::from(ray.direction().length());
        let agrees = match (ours, theirs) {
            (None, None) => true,
            (Some(ours), Some(theirs)) => (ours.distance - f64::from(theirs)).abs() * pace <= BAND,
            _ => false,
        };
        refuted += usize::from(!agrees);
    }
    // Rays that graze a rim, or slip through an edge in parry.
    assert!(refuted * 100 < compared, "{refuted} of {compared} differ");
}
