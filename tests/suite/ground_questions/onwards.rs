//! What bodies that already touch ground run into next: walls, ramps and steps, and not the seams of their floor.

use super::{mesh, sheet};
use asunder::glam::{DVec3, Quat, Vec2, Vec3};
use asunder::{
    Capsule3, Collider3, Compound3, Cuboid, Filter3, Ground, HeightField, Manifold3, Motion3, Pair3, Pose3,
    Ray3, Shape3, Sphere, World3, cast_ray3,
};
use asunder_tests::cases::Random;

/// Half the length of the floor: the wall's x.
const WALL: f64 = 6.0;

/// A floor cut into triangles, and a wall at its end, in one mesh.
fn yard(random: &mut Random) -> Shape3 {
    let cuts = 1 + random.below(20) as u32;
    let step = 2.0 * WALL as f32 / cuts as f32;
    let (mut vertices, mut triangles) = sheet([cuts, cuts], [step, step], |_, _| 0.0, |_, _| false);
    let (end, first) = (WALL as f32, vertices.len() as u32);
    vertices.extend([[end, 0.0, -end], [end, 0.0, end], [end, 3.0, -end], [end, 3.0, end]].map(Vec3::from));
    triangles.extend([[0, 1, 2], [2, 1, 3]].map(|corners| corners.map(|corner: u32| corner + first)));
    mesh((vertices, triangles))
}

/// Bodies, with how far they reach down and sideways from their position.
fn bodies() -> Vec<(Shape3, f64, f64)> {
    let balls = [Pose3::at([0.3, 0.0, 0.0]), Pose3::at([-0.3, 0.0, 0.0])]
        .map(|pose| (pose.unwrap(), Shape3::from(Sphere::new(0.25).unwrap())));
    vec![
        (Sphere::new(0.5).unwrap().into(), 0.5, 0.5),
        (Cuboid::from_half_extents(Vec3::new(0.4, 0.3, 0.2)).unwrap().into(), 0.3, 0.4),
        (Capsule3::from_half_height(0.3, 0.2).unwrap().into(), 0.5, 0.2),
        (Compound3::new(balls).unwrap().into(), 0.25, 0.55),
    ]
}

#[test]
fn what_touches_its_floor_runs_over_its_seams_and_into_its_wall() {
    let mut met = 0;
    for seed in 0..2000 {
        let mut random = Random::new(seed);
        let (shape, down, ahead) = bodies().swap_remove(random.below(4));
        let yard = yard(&mut random);
        let pressed = random.pick(&[0.0, 1e-9, 1e-6, 1e-3, 0.02]);
        let start = DVec3::new(random.between(-4.0, 4.0), down - pressed, random.between(-2.0, 2.0));
        let falls = random.pick(&[0.0, 1e-6, 2.7e-3, 0.1]);
        let way = DVec3::new(random.between(0.5, 12.0), -falls, random.between(-2.0, 2.0));
        let (pose, at) =
            (Pose3::at(start).unwrap(), Pose3::new(random.vector() * 3.0, random.quaternion()).unwrap());
        let posed = Pose3::new(at.transform(start), at.rotation()).unwrap();
        let motion = |way: DVec3| Motion3::shift(way).unwrap();
        // Unrotated, where positions are good to 1e-6; and rotated with all its ground, where touching is a matter of
        // rounding.
        for (place, ground, motion) in
            [(pose, Pose3::IDENTITY, motion(way)), (posed, at, motion(at.turn(way)))]
        {
            let pair = Pair3::new(&shape, &place, &yard, &ground);
            let told = pair.next_impact(&motion, &Motion3::STILL);
            let swapped = Pair3::new(&yard, &ground, &shape, &place).next_impact(&Motion3::STILL, &motion);
            let are_equal = match (told, swapped) {
                (Some(told), Some(swapped)) => (told.fraction - swapped.fraction).abs() < 1e-9,
                (told, swapped) => told.is_none() && swapped.is_none(),
            };
            assert!(are_equal, "{seed}: {told:?} {swapped:?}");
            if !pair.overlaps() {
                continue;
            }
            let expected = (WALL - ahead - start.x) / way.x;
            let Some(impact) = told else {
                assert!(expected > 1.0 - 1e-5, "{seed}: through the wall at {expected}");
                continue;
            };
            assert!((impact.fraction - expected).abs() < 1e-5, "{seed}: {impact:?}, wall at {expected}");
            let normal = ground.turn_back(impact.normal.as_dvec3());
            assert!((normal - DVec3::X).length() < 1e-6 && !impact.overlapping, "{seed}: {impact:?}");
            met += 1;
        }
    }
    assert!(met > 1000, "{met}");
}

#[test]
fn no_body_that_touches_rough_ground_comes_through_it() {
    // Bends of up to 45 degrees; the ball is pressed in by less than its radius, and moves until it is stopped.
    let (mut stopped, mut free) = (0, 0);
    for seed in 0..8_000 {
        let mut random = Random::new(seed);
        let steep = random.pick(&[0.01, 0.1, 0.5]);
        let heights: Vec<f32> = (0..13 * 13).map(|_| (random.between(0.0, 1.0) * steep) as f32).collect();
        let step = random.pick(&[0.5, 1.0]);
        let height = |x: f32, z: f32| {
            let place = |v: f32| ((v / step + 6.0).round() as usize).min(12);
            heights[place(z) * 13 + place(x)]
        };
        let ground: Shape3 = match seed % 2 {
            0 => mesh(sheet([12, 12], [step, step], height, |_, _| false)),
            _ => HeightField::new(13, 13, heights.clone(), Vec2::splat(step)).unwrap().into(),
        };
        // A field's origin is its corner.
        let corner = if seed % 2 == 0 { 0.0 } else { -6.0 * f64::from(step) };
        let lies = Pose3::at([corner, 0.0, corner]).unwrap();
        let radius = random.between(0.05, 0.6);
        let ball = Shape3::from(Sphere::new(radius as f32).unwrap());
        // Down until it touches, and a little further.
        let high = Pose3::at([random.between(-2.0, 2.0), 2.0, random.between(-2.0, 2.0)]).unwrap();
        let fall = Pair3::new(&ball, &high, &ground, &lies).cast(Vec3::NEG_Y * 4.0).unwrap();
        let pressed = random.pick(&[1e-6, 1e-3, 0.1]) * radius;
        let start = high.position() - DVec3::Y * (4.0 * fall.fraction + f64::from(fall.error) + pressed);
        let here = Pose3::at(start).unwrap();
        let pair = Pair3::new(&ball, &here, &ground, &lies);
        let turn = random.direction();
        let way = DVec3::new(turn.x, -0.02 * random.between(0.0, 1.0), turn.z) * random.between(0.1, 6.0);
        let told = pair.next_impact(&Motion3::shift(way).unwrap(), &Motion3::STILL);
        let fraction = told.map_or(1.0, |impact| impact.fraction);
        if let Some(impact) = &told {
            assert!(impact.normal.as_dvec3().dot(way) > 0.0 && !impact.overlapping, "{seed}: {impact:?}");
            let there = Pose3::at(start + way * fraction).unwrap();
            // It may be inside what it already touched, but what it hits is as near as reported. At fraction 0, that is
            // some triangle of a plane.
            let triangle = Ground::of(&ground).unwrap().triangle(impact.part_b);
            let triangle = Shape3::Triangle(triangle.unwrap());
            let met = Pair3::new(&ball, &there, &triangle, &lies).distance();
            assert!(
                met.is_none_or(|met| fraction == 0.0 || met.distance < 1e-4),
                "{seed}: {met:?} {impact:?}"
            );
        }
        // How far it goes into the slope that it touches is left to that contact, and adds to how far it is pressed in.
        let into = |manifold: Manifold3| manifold.normal.as_dvec3().dot(way).max(0.0) * fraction;
        let sunk = pressed + radius / 32.0 + pair.manifolds(0.0).into_iter().map(into).fold(0.0, f64::max);
        if sunk < 0.9 * radius {
            let along = (way * fraction).as_vec3();
            let ray = Ray3::new(start, along);
            let hit = ray.ok().and_then(|ray| cast_ray3(&ground, &lies, &ray, 1.0));
            assert!(hit.is_none(), "{seed}: its middle comes through at {hit:?} of {fraction}");
            if told.is_some() { stopped += 1 } else { free += 1 }
        }
    }
    assert!(stopped > 200 && free > 100, "{stopped} {free}");
}

#[test]
fn a_bullet_that_rolls_in_a_yard_of_one_mesh_stays_there() {
    // Four walls and a floor in one mesh; at 40 m/s every third frame would lead outside.
    let (half, up) = (5.0_f32, 2.0_f32);
    let (mut vertices, mut triangles) = sheet([9, 9], [10.0 / 9.0; 2], |_, _| 0.0, |_, _| false);
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    for i in 0..4 {
        let first = vertices.len() as u32;
        let [from, to] = [corners[i], corners[(i + 1) % 4]];
        vertices.extend([from, to].iter().flat_map(|&[x, z]| [Vec3::new(x, 0.0, z), Vec3::new(x, up, z)]));
        triangles.extend([[0, 1, 2], [2, 1, 3]].map(|of| of.map(|corner: u32| corner + first)));
    }
    let mut world = World3::new();
    world.insert(Collider3::new(mesh((vertices, triangles))));
    let ball = Collider3::new(Sphere::new(0.25).unwrap()).bullet();
    let ball = world.insert(ball.at(Pose3::at([0.0, 0.2495, 0.0]).unwrap()));
    let mut velocity = DVec3::new(0.5, 0.0, 0.43);
    let mut bounces = 0;
    for frame in 0..400 {
        let start = *world.get(ball).unwrap().pose();
        let motion = Motion3::new(velocity - DVec3::Y * 2.7e-3, Quat::from_xyzw(0.3, 0.1, 0.0, 0.9)).unwrap();
        world.set_motion(ball, motion).unwrap();
        world.update();
        let fraction = world.impacts().first().map_or(1.0, |hit| hit.impact.fraction);
        if let [hit] = world.impacts() {
            let normal = hit.impact.normal.as_dvec3();
            assert!(normal.y.abs() < 1e-3, "{frame}: stopped by its floor: {hit:?}");
            velocity -= 2.0 * velocity.dot(normal).max(0.0) * normal;
            bounces += 1;
        }
        let mut place = start.position() + motion.displacement() * fraction;
        place.y = 0.2495;
        // A hair off the wall that it bounced from, so that it does not touch the wall when it starts.
        let inside = 5.0 - 0.25 - 1e-4;
        assert!(place.abs().max_element() < 5.0 - 0.25 + 1e-4, "{frame}: outside at {place}");
        place = DVec3::new(place.x.clamp(-inside, inside), place.y, place.z.clamp(-inside, inside));
        world.set_pose(ball, Pose3::new(place, start.rotation()).unwrap()).unwrap();
    }
    assert!(bounces > 30, "{bounces}");
}

#[test]
fn steps_down_and_ramps_are_met_and_what_was_touched_is_not() {
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let slab = |half: [f32; 3]| Shape3::from(Cuboid::from_half_extents(Vec3::from(half)).unwrap());
    let at = |place: [f64; 3]| Pose3::at(place).unwrap();
    let next = |level: &Shape3, from: [f64; 3], way: [f64; 3]| {
        let here = at(from);
        let pair = Pair3::new(&ball, &here, level, &Pose3::IDENTITY);
        assert!(pair.overlaps());
        pair.next_impact(&Motion3::shift(way).unwrap(), &Motion3::STILL)
    };
    // A ledge, and a floor two metres below.
    let ledge = Compound3::new([
        (at([-5.0, -0.5, 0.0]), slab([5.0, 0.5, 5.0])),
        (at([0.0, -2.5, 0.0]), slab([50.0, 0.5, 5.0])),
    ]);
    let ledge = Shape3::from(ledge.unwrap());
    let impact = next(&ledge, [-0.5, 0.5, 0.0], [4.0, -4.0, 0.0]).unwrap();
    assert!((impact.fraction - 0.5).abs() < 1e-5 && impact.part_b == 1, "{impact:?}");
    assert!((impact.normal - Vec3::NEG_Y).length() < 1e-5, "{impact:?}");
    // Across a ditch, down into the side of the other bank, which is as high as the near one.
    let banks = Compound3::new([-6.0, 6.0].map(|x| (at([x, -2.0, 0.0]), slab([5.0, 2.0, 5.0]))));
    let impact = next(&Shape3::from(banks.unwrap()), [-1.0, 0.5, 0.0], [4.0, -4.0, 0.0]).unwrap();
    assert!(
        (impact.fraction - 0.375).abs() < 1e-5 && (impact.normal - Vec3::X).length() < 1e-5,
        "{impact:?}"
    );
    // Into what is already touched, however fast: that is a contact.
    assert_eq!(next(&ledge, [-2.0, 0.5, 0.0], [0.0, -0.4, 0.0]), None);
    // A ramp of 30 degrees in one mesh with its floor.
    let slope = |x: f32, _: f32| if x > 0.0 { x * 0.57735 } else { 0.0 };
    let ramp = mesh(sheet([16, 4], [1.0, 1.0], slope, |_, _| false));
    let impact = next(&ramp, [-4.0, 0.4999, 0.1], [6.0, -0.01, 0.0]).unwrap();
    // Hit where the centre is half a metre in front of the ramp's plane.
    let (sine, cosine) = (0.5, 0.75_f64.sqrt());
    let expected = (4.0 * sine + 0.4999 * cosine - 0.5) / (6.0 * sine + 0.01 * cosine);
    assert!((impact.fraction - expected).abs() < 1e-5, "{impact:?} {expected}");
    assert!((impact.normal - Vec3::new(0.5, -0.866_025_4, 0.0)).length() < 1e-4, "{impact:?}");
    assert_eq!(next(&ramp, [-4.0, 0.4999, 0.1], [3.5, -0.01, 0.0]), None);
    // Two bodies of one part each.
    let floor = slab([9.0, 1.0, 9.0]);
    assert_eq!(next(&floor, [0.0, 1.5, 0.0], [3.0, -0.1, 0.0]), None);
}

#[test]
fn a_floor_of_slabs_in_a_compound_stops_nobody_and_its_wall_does() {
    let slab = |half: [f32; 3]| Shape3::from(Cuboid::from_half_extents(Vec3::from(half)).unwrap());
    let mut parts: Vec<_> = (0..6)
        .map(|i| (Pose3::at([2.0 * f64::from(i) - 5.0, -0.5, 0.0]).unwrap(), slab([1.0, 0.5, 4.0])))
        .collect();
    parts.push((Pose3::at([7.0, 0.0, 0.0]).unwrap(), slab([1.0, 3.0, 4.0])));
    let yard = Shape3::from(Compound3::new(parts).unwrap());
    for seed in 0..2000 {
        let mut random = Random::new(seed);
        let (shape, down, ahead) = bodies().swap_remove(random.below(4));
        let pressed = random.pick(&[0.0, 1e-6, 1e-3]);
        let start = DVec3::new(random.between(-4.0, 4.0), down - pressed, random.between(-1.0, 1.0));
        let way = DVec3::new(random.between(0.5, 12.0), -random.pick(&[0.0, 1e-6, 2.7e-3]), random.signed());
        let here = Pose3::at(start).unwrap();
        let pair = Pair3::new(&shape, &here, &yard, &Pose3::IDENTITY);
        if !pair.overlaps() {
            continue;
        }
        let told = pair.next_impact(&Motion3::shift(way).unwrap(), &Motion3::STILL);
        let expected = (WALL - ahead - start.x) / way.x;
        match told {
            Some(impact) => {
                assert!((impact.fraction - expected).abs() < 1e-5, "{seed}: {impact:?} {expected}")
            }
            None => assert!(expected > 1.0 - 1e-5, "{seed}: through the wall at {expected}"),
        }
    }
}

#[test]
fn what_turns_or_is_thin_is_stopped_by_the_wall_beside_it() {
    let mut random = Random::new(1);
    let yard = yard(&mut random);
    let next = |shape: &Shape3, pose: Pose3, motion: Motion3| {
        let pair = Pair3::new(shape, &pose, &yard, &Pose3::IDENTITY);
        assert!(pair.overlaps());
        pair.next_impact(&motion, &Motion3::STILL)
    };
    // A rod on the floor, a millimetre from the wall, makes half a turn: on the way both ends are in the wall, and
    // neither at the end.
    let rod = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.1, 0.1, 1.0)).unwrap());
    for turn in [Quat::from_xyzw(0.0, 1.0, 0.0, 0.0), Quat::from_xyzw(0.0, 0.99, 0.0, 0.01)] {
        let motion = Motion3::new(DVec3::ZERO, turn).unwrap();
        let impact = next(&rod, Pose3::at([WALL - 0.101, 0.0999, 0.0]).unwrap(), motion).unwrap();
        assert!(impact.fraction < 0.01 && (impact.normal - Vec3::X).length() < 1e-5, "{impact:?}");
    }
    // The thickness of a needle oblique to its own axes is its true one.
    let askew = Vec3::splat(1.0).normalize();
    let needle = Shape3::from(Capsule3::new(-askew, askew, 0.001).unwrap());
    let along_wall =
        Pose3::new([WALL - 0.0015, 0.00099, 0.0], Quat::from_rotation_arc(askew, Vec3::Z)).unwrap();
    let impact = next(&needle, along_wall, Motion3::shift([0.0042, 0.0, 0.0]).unwrap()).unwrap();
    assert!((impact.fraction * 0.0042 - 0.0005).abs() < 1e-5, "{impact:?}");
}

#[test]
fn a_moved_shape_is_cast_on_from_the_floor_that_it_touches() {
    let (mut walls, mut crates, mut free) = (0, 0, 0);
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let (shape, down, ahead) = bodies().swap_remove(random.below(4));
        let mut world = World3::new();
        let yard = world.insert(Collider3::new(yard(&mut random)));
        // A post that stands on the yard's floor, in the way, and is disabled half of the time; and a sensor around the
        // start.
        let crate_at = random.between(2.0, 8.0);
        let post = Cuboid::from_half_extents(Vec3::new(0.5, 1.0, 9.0)).unwrap();
        let post = Collider3::new(post).fixed().at(Pose3::at([crate_at + 0.5, 1.0, 0.0]).unwrap());
        let post = world.insert(if random.below(2) == 0 { post.disabled() } else { post });
        let door = Collider3::new(Sphere::new(1.0).unwrap()).sensor();
        let start = DVec3::new(random.between(-4.0, 1.0), down - 1e-6, random.between(-2.0, 2.0));
        world.insert(door.at(Pose3::at(start).unwrap()));
        let (from, filter) = ((&shape, &Pose3::at(start).unwrap()), Filter3::new());
        let way = Vec3::new(random.between(0.5, 12.0) as f32, -2.7e-3, random.between(-2.0, 2.0) as f32);
        let is_post = world.get(post).is_some_and(Collider3::is_enabled) && crate_at < WALL;
        let expected = (if is_post { crate_at } else { WALL } - ahead - start.x) / f64::from(way.x);
        if random.below(2) == 0 {
            world.update();
        }
        assert!(world.cast_shape(from, way, &filter).is_some_and(|hit| hit.overlapping), "{seed}: its floor");
        let Some(hit) = world.cast_shape_onwards(from, way, &filter) else {
            assert!(expected > 1.0 - 1e-5, "{seed}: through what stands at {expected}");
            free += 1;
            continue;
        };
        assert!(
            (hit.fraction - expected).abs() < 1e-5 && !hit.overlapping,
            "{seed}: {hit:?}, not {expected}"
        );
        assert!((hit.normal - Vec3::X).length() < 1e-6, "{seed}: {hit:?}");
        assert_eq!(hit.body, if is_post { post } else { yard }, "{seed}: {hit:?}");
        if is_post { crates += 1 } else { walls += 1 }
    }
    assert!(walls > 50 && crates > 50 && free > 50, "{walls} {crates} {free}");
}

#[test]
fn a_shape_is_cast_on_however_far() {
    let mut world = World3::new();
    let yard = world.insert(Collider3::new(yard(&mut Random::new(1))));
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    for (y, touches) in [(0.5 - 1e-6, true), (0.75, false)] {
        let here = Pose3::at([0.0, y, 0.0]).unwrap();
        for far in [1e3, 1e9, 1e12, 1e30, f32::MAX] {
            let hit = world.cast_shape_onwards((&ball, &here), Vec3::X * far, &Filter3::new());
            let hit = hit.unwrap_or_else(|| panic!("nothing in the way of {far} m, {touches}"));
            let off = (hit.fraction * f64::from(far) - 5.5).abs();
            assert!(hit.body == yard && off < 1e-3, "{far}: {hit:?}");
        }
    }
    // From one end of the world to the other: further than a motion may lead.
    let target = world.insert(Collider3::new(ball.clone()).at(Pose3::at([8e8, 0.0, 9e8]).unwrap()));
    let far_off = Pose3::at([-9e8, 0.0, 9e8]).unwrap();
    for far in [1.8e9, 4e9, 1e20] {
        let hit = world.cast_shape_onwards((&ball, &far_off), Vec3::X * far, &Filter3::new()).unwrap();
        let off = (hit.fraction * f64::from(far) - (1.7e9 - 1.0)).abs();
        // There f64 resolves 2e-7 m, and the fraction as much of the whole way.
        assert!(off <= f64::from(hit.error) + 1e-6 && hit.error < 1e-4, "{far}: {hit:?}, {off} m off");
        assert!(hit.body == target && hit.normal == Vec3::X, "{far}: {hit:?}");
        assert!((hit.point - DVec3::new(8e8 - 0.5, 0.0, 9e8)).length() < 1e-5, "{far}: {hit:?}");
    }
    let here = Pose3::at([0.0, 2.0, 0.0]).unwrap();
    for way in [Vec3::NAN, Vec3::INFINITY, Vec3::ZERO] {
        assert_eq!(world.cast_shape_onwards((&ball, &here), way, &Filter3::new()), None, "{way}");
    }
}
