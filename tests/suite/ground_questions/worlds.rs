//! Worlds with ground in them: every query sees it.

use super::{beside, level, mesh, sheet, triangles};
use asunder::glam::{DVec3, Quat, Vec3};
use asunder::{
    Aabb3, Collider3, Cuboid, Filter3, Motion3, Pair3, Pose3, Ray3, Separation3, Shape3, Sphere, TriMesh,
    World3, cast_ray3,
};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{Clay, KINDS3};

/// Some ground with a few boxes among it.
fn world(seed: u128) -> (World3, Random) {
    let mut random = Random::new(seed);
    let mut world = World3::new();
    for round in 1..5 {
        let (ground, at) = level(&mut random, round);
        // All near each other, including what `level` places far away.
        let at = Pose3::new(random.vector() * 3.0, at.rotation()).unwrap();
        world.insert(Collider3::new(ground).at(at).fixed());
        let small = Cuboid::from_half_extents(Vec3::splat(0.3)).unwrap();
        let place = beside(&mut random, (world_ground(&world).0, &at), 0.5);
        world.insert(Collider3::new(small).at(Pose3::new(place, random.quaternion()).unwrap()));
    }
    world.update();
    (world, random)
}

fn world_ground(world: &World3) -> (&Shape3, &Pose3) {
    let body = world.iter().map(|(_, body)| body).find(|body| body.shape().is_ground()).unwrap();
    (body.shape(), body.pose())
}

#[test]
fn every_question_sees_ground_as_a_loop_over_bodies_does() {
    let (mut rays, mut casts, mut over, mut near, mut parts) = (0, 0, 0, 0, 0);
    for seed in 0..40 {
        let (world, mut random) = world(seed);
        let all = Filter3::new();
        for _ in 0..12 {
            let body = KINDS3[random.below(10)].1(&mut Clay::thick(&mut random));
            let place = random.vector() * 5.0;
            let pose = Pose3::new(place, random.quaternion()).unwrap();
            let pair_of =
                |other: &asunder::Collider3| Pair3::new(&body, &pose, other.shape(), other.pose()).overlaps();
            let mut expected: Vec<_> =
                world.iter().filter(|(_, other)| pair_of(other)).map(|(key, _)| key).collect();
            let mut found = vec![];
            world.overlapping((&body, &pose), &all, &mut found);
            expected.sort();
            found.sort();
            assert_eq!(found, expected, "{seed}");
            over += found.len();

            let ray = Ray3::new(place, (random.vector() * 4.0 - place).as_vec3()).unwrap();
            let first = world.cast_ray(&ray, f64::INFINITY, &all);
            let least = world
                .iter()
                .filter_map(|(_, other)| cast_ray3(other.shape(), other.pose(), &ray, f64::INFINITY))
                .map(|hit| hit.distance)
                .reduce(f64::min);
            assert_eq!(first.map(|hit| hit.distance), least, "{seed}");
            let mut hits = vec![];
            world.cast_ray_all(&ray, f64::INFINITY, &all, &mut hits);
            assert_eq!(hits.first().map(|hit| hit.distance), least, "{seed}");
            rays += hits.len();

            let moved = (random.vector() * 4.0 - place).as_vec3() * 2.0;
            let first = world.cast_shape((&body, &pose), moved, &all);
            let least = world
                .iter()
                .filter_map(|(_, other)| Pair3::new(&body, &pose, other.shape(), other.pose()).cast(moved))
                .map(|impact| impact.fraction)
                .reduce(f64::min);
            assert_eq!(first.map(|hit| hit.fraction), least, "{seed}");
            casts += usize::from(first.is_some_and(|hit| !hit.overlapping));

            let closest = world.closest_to_shape((&body, &pose), f32::INFINITY, &all).unwrap();
            let least = world
                .iter()
                .map(|(_, other)| {
                    match Pair3::new(&body, &pose, other.shape(), other.pose()).separation(f32::INFINITY) {
                        Separation3::Measured(found) => f64::from(found.separation).max(0.0),
                        Separation3::AtLeast(bound) => bound.into(),
                    }
                })
                .reduce(f64::min)
                .unwrap();
            assert!((closest.distance - least).abs() <= 1e-6 * (1.0 + least), "{seed}: {closest:?} {least}");
            let off = (closest.point - closest.from).length();
            assert!(closest.overlapping || (off - closest.distance).abs() < 1e-5, "{seed}: {closest:?}");
            near += usize::from(!closest.overlapping);
            let nearest = world.get(closest.body).unwrap();
            if let Some(found) = Pair3::new(&body, &pose, nearest.shape(), nearest.pose()).distance() {
                assert_eq!(closest.part, found.part_b, "{seed}: {closest:?}");
                parts += usize::from(found.part_b > 0);
            }

            let to_point = world.closest(place, 100.0, &all).unwrap();
            let point = Pose3::at(place).unwrap();
            let least = world
                .iter()
                .filter_map(|(_, other)| {
                    let pair =
                        Pair3::new(&Shape3::Sphere(Sphere::POINT), &point, other.shape(), other.pose())
                            .distance();
                    pair.map(|closest| f64::from(closest.distance))
                })
                .reduce(f64::min)
                .unwrap();
            assert!(to_point.overlapping || (to_point.distance - least).abs() < 1e-6, "{to_point:?} {least}");
        }
    }
    assert!(rays > 300 && casts > 150 && over > 150, "{rays} {casts} {over}");
    assert!(near > 100 && parts > 50, "{near} {parts}");
}

#[test]
fn a_point_of_ground_is_held_by_it() {
    let mut world = World3::new();
    let (vertices, numbers) = sheet([4, 4], [1.0, 1.0], |_, _| 0.0, |_, _| false);
    let ground = world.insert(Collider3::new(mesh((vertices, numbers))).fixed());
    let all = Filter3::new();
    let mut found = vec![];
    world.overlapping_point([0.25, 0.0, 0.375], &all, &mut found);
    assert_eq!(found, [ground]);
    world.overlapping_point([0.25, 1e-12, 0.375], &all, &mut found);
    assert!(found.is_empty());
    world.boxes_overlapping(&Aabb3::new(Vec3::splat(-0.1), Vec3::splat(0.1)), &all, &mut found);
    assert_eq!(found, [ground]);
    let near = world.closest([0.25, 1.5, 0.375], 2.0, &all).unwrap();
    assert_eq!((near.body, near.distance, near.point), (ground, 1.5, DVec3::new(0.25, 0.0, 0.375)));
    assert!(world.closest([0.25, 1.5, 0.375], 1.0, &all).is_none());
}

#[test]
fn two_bodies_are_asked_when_they_touch() {
    let mut world = World3::new();
    let ground =
        world.insert(Collider3::new(mesh(sheet([4, 4], [1.0, 1.0], |_, _| 0.0, |_, _| false))).fixed());
    let start = Pose3::at([0.3, 3.0, 0.2]).unwrap();
    let ball = world.insert(Collider3::new(Sphere::new(0.5).unwrap()).at(start));
    let fall = Motion3::shift([0.0, -5.0, 0.0]).unwrap();
    for (a, b, first, second) in
        [(ball, ground, &fall, &Motion3::STILL), (ground, ball, &Motion3::STILL, &fall)]
    {
        let impact = world.impact(a, b, first, second).unwrap().unwrap();
        assert!((impact.fraction - 0.5).abs() < 1e-6 && impact.normal.y.abs() > 1.0 - 1e-6, "{impact:?}");
    }
}

#[test]
fn no_bullet_passes_a_wall_of_one_layer() {
    // 500 m/s at sixty frames a second: eight metres a frame, through a wall without thickness.
    let (vertices, numbers) = sheet([10, 10], [0.6, 0.6], |_, _| 0.0, |_, _| false);
    let two_sided = TriMesh::new(vertices, numbers).unwrap();
    let shapes: [Shape3; 3] = [
        Sphere::new(0.02).unwrap().into(),
        Cuboid::from_half_extents(Vec3::new(0.02, 0.05, 0.01)).unwrap().into(),
        asunder::Capsule3::from_half_height(0.03, 0.01).unwrap().into(),
    ];
    let mut stopped = 0;
    for seed in 0..240 {
        let mut random = Random::new(seed);
        let mut world = World3::new();
        let wall = if seed % 2 == 0 { two_sided.clone() } else { two_sided.clone().one_sided() };
        let turned = Pose3::new(random.vector() * 50.0, random.quaternion()).unwrap();
        let wall = world.insert(Collider3::new(wall).at(turned).fixed());
        let front = turned.turn(DVec3::Y);
        // Aimed at the inner edges and vertices, too.
        let aim = match seed % 3 {
            0 => DVec3::new(random.below(4) as f64 * 0.6, 0.0, random.below(4) as f64 * 0.6),
            _ => DVec3::new(random.between(-2.8, 2.8), 0.0, random.between(-2.8, 2.8)),
        };
        let aim = turned.transform(aim);
        let way = (-front + random.direction() * 0.5).normalize() * (500.0 / 60.0);
        let from = aim - way * random.between(0.05, 0.95);
        let pose = Pose3::new(from, random.quaternion()).unwrap();
        let bullet = Collider3::new(shapes[seed as usize % 3].clone()).at(pose).bullet();
        let bullet = world.insert(bullet);
        let motion = match seed % 4 {
            0 => Motion3::new(way, random.quaternion()).unwrap(),
            _ => Motion3::shift(way).unwrap(),
        };
        world.set_motion(bullet, motion).unwrap();
        world.update();
        let hits = world.impacts();
        assert!(hits.iter().any(|hit| (hit.bullet, hit.other) == (bullet, wall)), "{seed}: {hits:?}");
        let impact = hits[0].impact;
        let reached = from + way * impact.fraction;
        let height = (reached - aim).dot(front);
        assert!((-1e-3..0.1).contains(&height), "{seed}: {height} {impact:?}");
        assert!(impact.normal.as_dvec3().dot(front) < -1.0 + 1e-6, "{seed}: {impact:?}");
        stopped += 1;
        // A one-sided wall stops nobody from behind.
        let mut back = World3::new();
        let wall = world.get(wall).unwrap().clone();
        let is_one_sided = seed % 2 == 1;
        back.insert(wall);
        let behind = Pose3::new(aim + way * 0.5, pose.rotation()).unwrap();
        let bullet = back.insert(Collider3::new(shapes[seed as usize % 3].clone()).at(behind).bullet());
        back.set_motion(bullet, Motion3::shift(-way).unwrap()).unwrap();
        back.update();
        assert_eq!(back.impacts().is_empty(), is_one_sided, "{seed}");
    }
    assert_eq!(stopped, 240);
}

#[test]
fn ground_far_away_is_asked_as_at_home() {
    // A metre of ground nine hundred thousand kilometres from the origin.
    let ground = mesh(sheet([4, 4], [0.5, 0.5], |x, z| 0.2 * x * z, |_, _| false));
    let ball = Shape3::from(Sphere::new(0.25).unwrap());
    let home = Pose3::new(DVec3::ZERO, Quat::from_xyzw(0.1, 0.2, 0.3, 0.9)).unwrap();
    // A shift that f64 can add here without rounding.
    let shift = DVec3::new(-9e8, 5e8, 1e8);
    let away = Pose3::new(shift, home.rotation()).unwrap();
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let place = (random.vector() * 64.0).round() / 32.0;
        let (here, there) = (Pose3::at(place).unwrap(), Pose3::at(place + shift).unwrap());
        let (one, other) =
            (Pair3::new(&ball, &here, &ground, &home), Pair3::new(&ball, &there, &ground, &away));
        assert_eq!(one.separation(f32::INFINITY), other.separation(f32::INFINITY));
        assert_eq!(one.distance(), other.distance());
        let moved = (random.vector() * 4.0).as_vec3();
        let [near, far] = [one.cast(moved), other.cast(moved)];
        assert_eq!(near.is_some(), far.is_some());
        if let (Some(near), Some(far)) = (near, far) {
            // What rounding takes from a gap out there is left.
            let pace = far.normal.as_dvec3().dot(moved.as_dvec3());
            let sooner = (near.fraction - far.fraction) * pace;
            assert!(sooner >= 0.0 && sooner <= f64::from(far.error), "{sooner} of {}", far.error);
        }
        let ray = |from: &Pose3| Ray3::new(from.position(), moved).unwrap();
        let (near, far) =
            (cast_ray3(&ground, &home, &ray(&here), 9.0), cast_ray3(&ground, &away, &ray(&there), 9.0));
        assert_eq!(near, far);
    }
    assert_eq!(triangles(&ground).len(), 32);
}
