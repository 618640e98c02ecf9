//! Bugs with rays.

use asunder::glam::{DVec3, Quat, Vec2, Vec3};
use asunder::{
    Compound2, Compound3, Cuboid, Hull, Pose2, Pose3, Ray2, Ray3, Rect, Shape2, Shape3, cast_ray2, cast_ray3,
};

/// Symptom: a ray that starts inside one part of a compound, a rounding before the face of another, was reported to
/// start outside. Cause: both hits were at distance 0, and of equal hits the first part won.
#[test]
fn a_ray_that_starts_in_any_part_starts_inside() {
    let bar = |half: f32| Shape3::from(Cuboid::from_half_extents(Vec3::new(half, 1.0, 1.0)).unwrap());
    let parts =
        [(Pose3::at([2.0, 0.0, 0.0]).unwrap(), bar(1.0)), (Pose3::at([0.5, 0.0, 0.0]).unwrap(), bar(1.5))];
    let both = Shape3::from(Compound3::new(parts).unwrap());
    let flat = |half: f32| Shape2::from(Rect::from_half_extents(Vec2::new(half, 1.0)).unwrap());
    let parts = [(Pose2::at([2.0, 0.0]).unwrap(), flat(1.0)), (Pose2::at([0.5, 0.0]).unwrap(), flat(1.5))];
    let both_flat = Shape2::from(Compound2::new(parts).unwrap());
    for (x, part) in [(1.0, 0), (1.0_f64.next_down(), 1), (1.0 - 1e-15, 1), (1.0 - 1e-13, 1), (-0.5, 1)] {
        let ray = Ray3::new([x, 0.0, 0.0], Vec3::X).unwrap();
        let hit = cast_ray3(&both, &Pose3::IDENTITY, &ray, 9.0).unwrap();
        assert_eq!((hit.inside, hit.distance, hit.part), (true, 0.0, part), "{x}: {hit:?}");
        let ray = Ray2::new([x, 0.0], Vec2::X).unwrap();
        let hit = cast_ray2(&both_flat, &Pose2::IDENTITY, &ray, 9.0).unwrap();
        assert_eq!((hit.inside, hit.distance, hit.part), (true, 0.0, part), "{x}: {hit:?}");
    }
}

/// Symptom: ray casts against rounded hulls did not scale with the unit of length: for a body of two micrometres the
/// error was, relative to its size, a fifth larger than for one of a metre. Cause: the ray's origin, as a shape, was a
/// hull of one vertex, whose radius counts as a micrometre, and that was added to the size of every pair.
#[test]
fn a_rays_origin_has_no_size() {
    let corners = [
        [0.0, -0.5, 0.625],
        [0.0, 0.5, -0.125],
        [-0.375, -0.375, -0.5],
        [-0.25, -0.125, 0.5],
        [-0.375, 0.375, 0.125],
    ];
    let turned = Quat::from_array([0.375, 0.125, 0.875, -0.125]);
    let cast = |unit: f32| {
        let points: Vec<Vec3> = corners.iter().map(|&corner| Vec3::from(corner) * unit).collect();
        let rounded = Shape3::from(Hull::from_points(&points).unwrap().rounded(0.125 * unit).unwrap());
        let at = |place: [f64; 3]| DVec3::from(place) * f64::from(unit);
        let pose = Pose3::new(at([-1.25, 0.6875, -1.125]), turned).unwrap();
        let ray = Ray3::between(at([2.5, -1.0, 1.0]), at([-2.0, 1.25, -2.0])).unwrap();
        let hit = cast_ray3(&rounded, &pose, &ray, 1.0).unwrap();
        (hit.distance, hit.error / unit, hit.normal, hit.inside)
    };
    // 2^-19, 2^-3, 2^10 and 2^19 metres.
    for unit in [1.0 / 524_288.0, 0.125, 1024.0, 524_288.0] {
        assert_eq!(cast(unit), cast(1.0), "{unit}");
    }
}
