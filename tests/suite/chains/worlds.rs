//! Worlds with chains in them.

use super::{at, chain, cut_line, sliders};
use asunder::glam::{DVec2, Vec2, Vec3};
use asunder::{
    Chain, Circle, Collider2, Collider3, Compound2, CompoundError, DebugOptions, Event, Filter2, MassError,
    Motion2, Motion3, Pose2, Pose3, Ray2, Shape2, Snapshot, Sphere, TriMesh, World2, World3,
};

/// Ground of some four hundred segments, facing up.
fn ground() -> Chain {
    Chain::open(cut_line(DVec2::new(30.0, 0.0), DVec2::new(-30.0, 0.0), 400)).unwrap().one_sided()
}

#[test]
fn ground_is_fixed_whatever_is_said() {
    let mut world = World2::new();
    let (one, other) = (world.insert(Collider2::new(ground())), world.insert(Collider2::new(ground())));
    assert!(world.get(one).unwrap().is_fixed());
    world.update();
    assert_eq!(world.candidates().len(), 0, "ground never pairs with ground");
    world.set_shape(other, Circle::new(1.0).unwrap()).unwrap();
    let ball = world.insert(Collider2::new(Circle::new(1.0).unwrap()));
    assert!(!world.get(ball).unwrap().is_fixed());
    world.update();
    assert!(world.is_touching(one, ball));
    world.set_shape(ball, ground()).unwrap();
    assert!(world.get(ball).unwrap().is_fixed());
    world.update();
    assert_eq!(world.contacts().len(), 0);
}

#[test]
fn a_ditch_ends_what_lay_where_it_is_and_nothing_else() {
    let mut world = World2::new();
    let line = |depth: f32| [(8.0, 0.0), (4.0, 0.0), (3.0, -depth), (2.0, 0.0), (-2.0, 0.0)].map(Vec2::from);
    let chain = |depth: f32| Chain::open(line(depth).to_vec()).unwrap().one_sided();
    let ground = world.insert(Collider2::new(chain(0.0)).margin(0.01).unwrap());
    let ball = Collider2::new(Circle::new(0.5).unwrap()).margin(0.01).unwrap();
    let [over, aside] = [3.0, 6.0].map(|x| world.insert(ball.clone().at(at(x, 0.5))));
    world.update();
    assert_eq!(world.events().len(), 2);
    for (key, x) in [(over, 3.0), (aside, 6.0)] {
        world.set_pose(key, at(x, 0.505)).unwrap();
    }
    world.update();
    assert_eq!(world.events(), [], "a margin is a hysteresis");
    world.set_shape(ground, chain(2.0)).unwrap();
    world.update();
    let expected = Event::Ended { a: ground, b: over, user_data_a: 0, user_data_b: 0, sensor: false };
    assert_eq!(world.events(), [expected]);
    assert!(world.is_touching(ground, aside) && !world.contact(ground, aside).unwrap().overlapping);
}

#[test]
fn a_slide_over_hundreds_of_segments_begins_once_and_ends_once() {
    for (name, body, foot) in &sliders() {
        let mut world = World2::new();
        let ground = world.insert(Collider2::new(ground()));
        let body = world.insert(Collider2::new(body.clone()).at(at(-29.0, foot - 1e-3)));
        let mut told = Vec::new();
        for step in 0..=300 {
            world.set_pose(body, at(-29.0 + 0.21 * f64::from(step), foot - 1e-3)).unwrap();
            world.update();
            told.extend(world.events().iter().map(|event| (step, matches!(event, Event::Began { .. }))));
            if let Some(contact) = world.contact(ground, body) {
                assert!(contact.overlapping && contact.manifolds.len() == 1, "{name} {step}");
            }
        }
        let [(0, true), (end, false)] = told[..] else { panic!("{name}: {told:?}") };
        assert!(end > 270, "{name}: {told:?}");
    }
}

#[test]
fn a_snapshot_keeps_ground_once_and_has_the_same_future() {
    let mut world = World2::new();
    let ground = ground();
    let two_sided = Chain::open(ground.vertices().iter().copied()).unwrap();
    for (i, shape) in
        [ground.clone(), ground.clone(), two_sided.clone(), ground.clone()].into_iter().enumerate()
    {
        world.insert(Collider2::new(shape).at(at(0.0, -20.0 * i as f64)));
    }
    let mut bodies = Vec::new();
    for (i, (_, shape, foot)) in sliders().into_iter().enumerate() {
        bodies.push(world.insert(Collider2::new(shape).at(at(3.0 * i as f64 - 6.0, foot - 1e-3))));
    }
    world.update();
    let text = serde_json::to_string(&world.snapshot()).unwrap();
    assert_eq!(text.matches("\"vertices\":[[").count(), 2 + 1, "two chains and a hexagon: {}", &text[..200]);
    let snapshot: Snapshot<asunder::Plane> = serde_json::from_str(&text).unwrap();
    let mut restored = World2::restore(&snapshot).unwrap();
    for (key, body) in world.iter() {
        assert_eq!(restored.get(key).unwrap().shape(), body.shape());
        assert_eq!(restored.get(key).unwrap().is_fixed(), body.is_fixed());
    }
    for step in 0..40 {
        for world in [&mut world, &mut restored] {
            for (i, &key) in bodies.iter().enumerate() {
                let now = world.get(key).unwrap().pose().position();
                world
                    .set_pose(key, Pose2::at(now + DVec2::new(0.17, 0.01 * (i as f64 - 2.0))).unwrap())
                    .unwrap();
            }
            world.update();
        }
        let shown =
            |world: &World2| format!("{:?} {:?}", world.contacts().collect::<Vec<_>>(), world.events());
        assert_eq!(shown(&world), shown(&restored), "{step}");
    }
}

#[test]
fn questions_see_chains() {
    let mut world = World2::new();
    let ground = world.insert(Collider2::new(ground()).at(at(100.0, 7.0)));
    let filter = Filter2::new();
    let down = Ray2::new([104.0, 12.0], Vec2::NEG_Y).unwrap();
    let hit = world.cast_ray(&down, 100.0, &filter).unwrap();
    assert!(hit.body == ground && (hit.distance - 5.0).abs() < 1e-6 && hit.normal == Vec2::Y, "{hit:?}");
    let up = Ray2::new([104.0, 2.0], Vec2::Y).unwrap();
    assert!(world.cast_ray(&up, 100.0, &filter).is_none(), "from behind");
    let near = world.closest([90.0, 9.0], 10.0, &filter).unwrap();
    assert!(near.body == ground && (near.distance - 2.0).abs() < 1e-5, "{near:?}");
    let Shape2::Chain(chain) = world.get(ground).unwrap().shape() else { panic!("it is one") };
    let [from, to] = chain.segment(near.part).unwrap().ends();
    assert!((to.x..=from.x).contains(&-10.0), "it names the segment below: {near:?}");
    let hung = world.closest_to_shape((&Circle::new(0.5).unwrap().into(), &at(90.0, 9.0)), 10.0, &filter);
    assert_eq!(hung.unwrap().part, near.part);
    let ball = Shape2::from(Circle::new(0.5).unwrap());
    let mut found = Vec::new();
    for (y, count) in [(7.4, 1), (7.6, 0), (6.6, 1)] {
        world.overlapping((&ball, &at(95.0, y)), &filter, &mut found);
        assert_eq!(found.len(), count, "{y}");
    }
    let cast = world.cast_shape((&ball, &at(95.0, 10.0)), Vec2::NEG_Y * 5.0, &filter).unwrap();
    assert!(cast.body == ground && (cast.fraction - 0.5).abs() < 1e-6, "{cast:?}");
    let mut lines = 0;
    world.debug_lines(&DebugOptions { shapes: true, ..DebugOptions::default() }, &mut |_, _, _| lines += 1);
    assert!(lines >= 400, "{lines}");
}

#[test]
fn ground_is_no_part_and_has_no_mass() {
    let ground = Shape2::from(chain(&[(1.0, 0.0), (0.0, 0.0)]));
    assert_eq!(ground.mass_properties(1.0), Err(MassError::Ground));
    let ball: Shape2 = Circle::new(1.0).unwrap().into();
    let refused = Compound2::new([(Pose2::IDENTITY, ball), (Pose2::IDENTITY, ground)]);
    assert_eq!(refused, Err(CompoundError::Ground { index: 1 }));
}

/// A bullet that jumps past the tip of a one-sided ledge, from below. A chain determines the side when the two first
/// touch, a mesh at the start of the motion, and speculative contacts at the current poses.
#[test]
fn who_comes_up_beside_the_tip_of_a_ledge_runs_into_a_chain_and_passes_a_mesh() {
    let mut world = World2::new();
    let ledge =
        world.insert(Collider2::new(Chain::open([Vec2::X * 2.0, Vec2::X * 0.5]).unwrap().one_sided()));
    let bullet = Collider2::new(Circle::new(0.5).unwrap()).bullet().at(Pose2::at([-0.75, -1.0]).unwrap());
    let bullet = world.insert(bullet);
    world.set_motion(bullet, Motion2::shift([1.0, 1.4]).unwrap()).unwrap();
    world.update();
    let hit = *world.impacts_of(bullet).next().unwrap();
    assert!(hit.other == ledge && (hit.impact.fraction - 0.753).abs() < 0.001, "{hit:?}");
    assert!(world.contact(ledge, bullet).is_none(), "its middle is below the ledge's line now");

    let corners = [[0.5, 0.0, -5.0], [0.5, 0.0, 5.0], [5.0, 0.0, 5.0], [5.0, 0.0, -5.0]].map(Vec3::from);
    let ledge = TriMesh::new(corners, [[0, 1, 2], [0, 2, 3]]).unwrap().one_sided();
    let mut world = World3::new();
    let ledge = world.insert(Collider3::new(ledge));
    let bullet = Collider3::new(Sphere::new(0.5).unwrap()).bullet();
    let bullet = world.insert(bullet.at(Pose3::at([-0.75, -1.0, 0.0]).unwrap()));
    world.set_motion(bullet, Motion3::shift([1.0, 1.4, 0.0]).unwrap()).unwrap();
    world.update();
    assert!(world.impacts().is_empty() && world.contact(ledge, bullet).is_none());
}
