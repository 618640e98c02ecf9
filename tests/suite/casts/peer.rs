//! Casts and rays against parry3d, outside a band.

use crate::shapes_peer::{pose_of, twin, vector};
use asunder_geometry::glam::Vec3;
use asunder_geometry::{Pose3, Ray3};
use asunder_narrow::{Pair3, Separation3, cast_ray3};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{Clay, KINDS3};
use parry3d::query::{Ray, ShapeCastOptions, cast_shapes};

/// Share of a pair's size within which parry's answers are not compared with ours.
const BAND: f64 = 1e-3;

#[test]
fn shapes_meet_where_parry_says() {
    let (mut compared, mut refuted) = (0, 0);
    for seed in 0..6000 {
        let mut random = Random::new(seed);
        // Kinds that parry's cast supports, and that are bounded; no compounds, which it handles on its own.
        let kinds = [0, 1, 2, 4, 8, 9];
        let (a, b) = (kinds[random.below(6)], kinds[random.below(6)]);
        let (shape_a, shape_b) =
            (KINDS3[a].1(&mut Clay::thick(&mut random)), KINDS3[b].1(&mut Clay::thick(&mut random)));
        let reach = f64::from(shape_a.outer_radius() + shape_b.outer_radius());
        let away = (random.direction() * reach * random.between(1.2, 3.0)).as_vec3();
        let pose_a = Pose3::new(Vec3::ZERO, random.quaternion()).unwrap();
        let pose_b = Pose3::new(away, random.quaternion()).unwrap();
        let moved = (away.as_dvec3() * 2.0 + random.direction() * reach * random.between(0.0, 1.2)).as_vec3();
        let ours = Pair3::new(&shape_a, &pose_a, &shape_b, &pose_b).cast(moved);
        let (Some(twin_a), Some(twin_b)) = (twin(&shape_a), twin(&shape_b)) else { continue };
        let at = |pose: &Pose3| pose_of(pose.position(), pose.rotation());
        let theirs = cast_shapes(
            &at(&pose_a),
            vector(moved),
            &*twin_a.0,
            &at(&pose_b),
            vector(Vec3::ZERO),
            &*twin_b.0,
            ShapeCastOptions::with_max_time_of_impact(1.0),
        );
        let Ok(theirs) = theirs else { continue };
        compared += 1;
        let band = BAND * reach;
        // A pass that grazes may be a hit or a miss.
        let apart_at = |fraction: f64| {
            let pose = Pose3::new(moved.as_dvec3() * fraction, pose_a.rotation()).unwrap();
            match Pair3::new(&shape_a, &pose, &shape_b, &pose_b).separation(f32::INFINITY) {
                Separation3::Measured(found) => f64::from(found.separation),
                Separation3::AtLeast(_) => f64::INFINITY,
            }
        };
        let agrees = match (&ours, &theirs) {
            (None, None) => true,
            (Some(ours), Some(theirs)) => {
                let theirs = f64::from(theirs.time_of_impact);
                (ours.fraction - theirs).abs() * f64::from(moved.length()) <= band
                    || apart_at(theirs).abs() <= band
            }
            (Some(ours), None) => {
                // Then our pose must be an impact, by the oracle.
                apart_at(ours.fraction).abs() <= f64::from(ours.error) + 1e-6 * reach
            }
            (None, Some(theirs)) => apart_at(theirs.time_of_impact.into()).abs() <= band,
        };
        if !agrees {
            // Whichever is right: at our fraction the shapes touch, at theirs they do not.
            let ours = ours.unwrap();
            assert!(
                apart_at(ours.fraction).abs() <= f64::from(ours.error) + 1e-6 * reach,
                "{seed}: {ours:?}"
            );
            refuted += 1;
        }
    }
    assert!(compared > 5000 && refuted * 50 < compared, "parry was refuted {refuted} times of {compared}");
}

#[test]
fn rays_meet_where_parry_says() {
    let (mut compared, mut refuted) = (0, 0);
    for seed in 0..6000 {
        let mut random = Random::new(seed);
        let kinds = [0, 1, 2, 4, 8];
        let shape = KINDS3[kinds[random.below(5)]].1(&mut Clay::thick(&mut random));
        let reach = f64::from(shape.outer_radius());
        let pose = Pose3::new(random.vector().as_vec3(), random.quaternion()).unwrap();
        let from = (random.direction() * reach * 5.0).as_vec3();
        let aim = pose.transform(shape.center()) + random.direction() * reach * random.between(0.0, 1.1);
        let ray = Ray3::new(from, (aim - from.as_dvec3()).as_vec3()).unwrap();
        let Some(theirs) = twin(&shape) else { continue };
        let at = pose_of(pose.position(), pose.rotation());
        let theirs = theirs.cast_ray(&at, &Ray::new(vector(from), vector(ray.direction())), 10.0, true);
        let ours = cast_ray3(&shape, &pose, &ray, 10.0);
        compared += 1;
        let pace = f64::from(ray.direction().length());
        let agrees = match (ours, theirs) {
            (None, None) => true,
            (Some(ours), Some(theirs)) => (ours.distance - f64::from(theirs)).abs() * pace <= BAND * reach,
            _ => false,
        };
        refuted += usize::from(!agrees);
    }
    // Rays that graze: the sampled oracle of the test beside this one decides about ours.
    assert!(compared > 5000 && refuted * 100 < compared, "{refuted} of {compared} differ");
}
