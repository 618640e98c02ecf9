//! Queries step by step: what a game gets, and when.

use asunder::{
    Aabb3, Circle, Collider2, Collider3, Cuboid, Filter2, Filter3, HalfPlane, Pose2, Pose3, Shape3, Sphere,
    TriMesh, World2, World3,
    glam::{DVec2, DVec3, Vec2, Vec3},
};
use core::ops::ControlFlow;

fn cube() -> Shape3 {
    Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap().into()
}

fn at(x: f64) -> Pose3 {
    Pose3::at([x, 0.0, 0.0]).unwrap()
}

fn bodies_at(world: &World3, x: f64) -> Vec<asunder::BodyKey3> {
    let mut found = vec![];
    world.overlapping_point([x, 0.0, 0.0], &Filter3::new(), &mut found);
    found
}

#[test]
fn an_empty_world_finds_nothing() {
    let world = World3::new();
    let (mut keys, mut near) = (bodies_at(&world, 0.0), vec![]);
    assert!(keys.is_empty());
    let filter = Filter3::new();
    world.boxes_overlapping(&Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY), &filter, &mut keys);
    world.within(DVec3::ZERO, f32::INFINITY, &filter, &mut near);
    assert!(keys.is_empty() && near.is_empty());
    assert_eq!(world.closest(DVec3::ZERO, f32::INFINITY, &filter), None);
    assert_eq!(World2::new().closest(Vec2::ZERO, 1.0, &Filter2::new()), None);
}

#[test]
fn questions_see_bodies_before_the_next_update() {
    let mut world = World3::new();
    let a = world.insert(Collider3::new(cube()));
    assert_eq!(bodies_at(&world, 0.0), [a], "never updated");
    world.update();
    assert_eq!(bodies_at(&world, 0.0), [a]);
    world.set_pose(a, at(5.0)).unwrap();
    assert_eq!(bodies_at(&world, 0.0), [], "where it was");
    assert_eq!(bodies_at(&world, 5.0), [a], "where it is");
    let b = world.insert(Collider3::new(cube()).at(at(5.0)));
    assert_eq!(bodies_at(&world, 5.0), [a, b]);
    world.remove(a).unwrap();
    assert_eq!(bodies_at(&world, 5.0), [b], "gone at once");
    let again = world.insert(Collider3::new(cube()).at(at(5.0)));
    assert_eq!(bodies_at(&world, 5.0), [again, b], "a new body in the old slot");
    world.clear();
    assert_eq!(bodies_at(&world, 5.0), []);
}

/// A body that leaves its place and another that takes it, hundreds of times between two updates.
#[test]
fn one_body_may_move_any_number_of_times_between_questions() {
    let mut world = World3::new();
    let keys: Vec<_> =
        (0..300).map(|i| world.insert(Collider3::new(cube()).at(at(2.0 * f64::from(i))))).collect();
    for step in 0..3000_usize {
        let (body, from) = (keys[step * 7 % 300], 2.0 * (step * 7 % 300) as f64);
        assert_eq!(bodies_at(&world, from), [body], "step {step}");
        world.set_pose(body, at(-10.0)).unwrap();
        assert_eq!(bodies_at(&world, from), [], "step {step}");
        assert_eq!(bodies_at(&world, -10.0), [body], "step {step}");
        world.set_pose(body, at(from)).unwrap();
        if step % 1000 == 999 {
            world.update();
        }
    }
}

#[test]
fn equals_go_by_slot() {
    let mut world = World3::new();
    let keys: Vec<_> = [3.0, -3.0, 3.0].map(|x| world.insert(Collider3::new(cube()).at(at(x)))).to_vec();
    let filter = Filter3::new();
    let mut near = vec![];
    world.within(DVec3::ZERO, 9.0, &filter, &mut near);
    assert_eq!(near.iter().map(|near| near.body).collect::<Vec<_>>(), keys);
    // Bodies that moved last are tested first.
    world.set_pose(keys[2], at(-3.0)).unwrap();
    assert_eq!(world.closest(DVec3::ZERO, 9.0, &filter).unwrap().body, keys[0]);
    assert_eq!(world.closest(DVec3::ZERO, 9.0, &filter.without(keys[0])).unwrap().body, keys[1]);
}

#[test]
fn visitors_break_off() {
    let mut world = World3::new();
    for x in 0..10 {
        world.insert(Collider3::new(cube()).at(at(0.01 * f64::from(x))));
    }
    let filter = Filter3::new();
    let (mut keys, mut near) = (0, 0);
    let flow = world.visit_overlapping_point(DVec3::ZERO, &filter, |_| {
        keys += 1;
        if keys == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((flow, keys), (ControlFlow::Break(()), 3));
    let flow = world.visit_within(DVec3::ZERO, 1.0, &filter, |_| {
        near += 1;
        if near == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((flow, near), (ControlFlow::Break(()), 4));
    let all = world.visit_overlapping((&cube(), &at(0.0)), &filter, |_| ControlFlow::Continue(()));
    assert_eq!(all, ControlFlow::Continue(()));
}

#[test]
fn a_question_may_ask_in_turn() {
    let mut world = World3::new();
    let keys: Vec<_> =
        (0..5).map(|x| world.insert(Collider3::new(cube()).at(at(3.0 * f64::from(x))))).collect();
    let near = |world: &World3| {
        let is_lonely = is_lonely_in(world);
        world.closest([13.0, 0.0, 0.0], 100.0, &Filter3::new().only(&is_lonely)).map(|near| near.body)
    };
    assert_eq!(near(&world), None, "each has a neighbour");
    world.remove(keys[1]).unwrap();
    assert_eq!(near(&world), Some(keys[0]));
}

fn is_lonely_in(world: &World3) -> impl Fn(asunder::BodyKey3, &Collider3) -> bool + Sync {
    |key, body| {
        let others = Filter3::new().without(key);
        world.closest_to_shape((body.shape(), body.pose()), 2.5, &others).is_none()
    }
}

#[test]
fn nonsense_finds_nothing_and_stops_nobody() {
    let mut world = World3::new();
    let ball = Shape3::from(Sphere::new(1.0).unwrap());
    let body = world.insert(Collider3::new(ball.clone()));
    let filter = Filter3::new();
    let mut keys = vec![body];
    for point in [DVec3::NAN, DVec3::INFINITY, DVec3::splat(2e9)] {
        world.overlapping_point(point, &filter, &mut keys);
        assert!(keys.is_empty());
        assert_eq!(world.closest(point, f32::INFINITY, &filter), None);
    }
    world.boxes_overlapping(&Aabb3::new(Vec3::ONE, Vec3::NEG_ONE), &filter, &mut keys);
    assert!(keys.is_empty());
    assert!(world.closest([3.0, 0.0, 0.0], f32::NAN, &filter).is_some(), "no limit");
    assert!(world.closest([3.0, 0.0, 0.0], -1.0, &filter).is_none());
    assert!(world.closest([0.5, 0.0, 0.0], -1.0, &filter).is_some(), "0 m away");
    let (beside, far) = (Pose3::at([1.5, 0.0, 0.0]).unwrap(), Pose3::at([9.0, 0.0, 0.0]).unwrap());
    let mut found = vec![];
    for (margin, is_found) in
        [(f32::NAN, [true, false]), (-1.0, [true, false]), (f32::INFINITY, [true, true])]
    {
        for (pose, is_found) in [beside, far].into_iter().zip(is_found) {
            world.manifolds((&ball, &pose), margin, &filter, &mut found);
            assert_eq!(found.len(), usize::from(is_found), "{margin} m around {pose:?}");
        }
    }
}

#[test]
fn a_view_is_clear_where_nothing_is_in_between() {
    let mut world = World3::new();
    let cube = world.insert(Collider3::new(cube()));
    let corners = [[2.0, -1.0, -1.0], [2.0, 1.0, -1.0], [2.0, 0.0, 1.0]].map(Vec3::from);
    // Its front looks to +x.
    let fence = world.insert(Collider3::new(TriMesh::new(corners, [[0, 1, 2]]).unwrap().one_sided()));
    let all = Filter3::new();
    let sees = |from: DVec3, to: DVec3| world.is_clear_between(from, to, &all);
    let (left, middle, right) = (DVec3::NEG_X, DVec3::X, DVec3::X * 3.0);
    assert!(!sees(left, middle) && !sees(middle, left), "through the cube");
    assert!(!sees(DVec3::ZERO, middle) && !sees(middle, DVec3::ZERO), "out of the cube, and into it");
    assert!(sees(middle, right) && !sees(right, middle), "one-sided ground hides what is behind it");
    assert!(sees(left, DVec3::NEG_X * 0.75), "up to the point, and no further");
    assert!(world.is_clear_between(left, middle, &all.without(cube)));
    assert!(world.is_clear_between(right, left, &all.without_all(&[cube, fence])));
    assert!(sees(left, left) && !sees(DVec3::ZERO, DVec3::ZERO), "a point alone");
    // Symptom: the eye's own body counted for two equal points alone, whatever the filter left out.
    for to in [DVec3::ZERO, DVec3::X * 1e-60, DVec3::X * 0.25, DVec3::X] {
        assert!(
            world.is_clear_between(DVec3::ZERO, to, &all.without_touched()),
            "out of one's own body, to {to}"
        );
    }
    assert!(!sees(DVec3::Y * 0.5, DVec3::Y * 0.5), "touching counts");
    let tiny = DVec3::X * 1e-60;
    assert!(!sees(DVec3::ZERO, tiny) && sees(DVec3::NEG_X + tiny, left), "nearer than f32 can tell");
    for nonsense in [DVec3::NAN, DVec3::INFINITY, DVec3::splat(f64::MAX)] {
        assert!(!sees(nonsense, left) && !sees(left, nonsense) && !sees(nonsense, nonsense), "{nonsense}");
    }
    assert!(!sees(DVec3::Y * 2e9, left), "further out than a body may be");

    let mut world = World2::new();
    world.insert(Collider2::new(Circle::new(0.5).unwrap()).at(Pose2::at([0.0, 3.0]).unwrap()));
    world.insert(Collider2::new(HalfPlane::new(Vec2::Y).unwrap()));
    let sees = |from: DVec2, to: DVec2| world.is_clear_between(from, to, &Filter2::new());
    let [left, right] = [-1.0, 1.0].map(|x| DVec2::new(x, 3.0));
    assert!(!sees(left, right) && sees(left, DVec2::new(1.0, 1.0)) && !sees(left, DVec2::new(-1.0, -1.0)));
    assert!(sees(left, left) && !sees(DVec2::Y * 3.0, DVec2::Y * 3.0) && !sees(DVec2::NAN, left));
    let inside = DVec2::Y * 3.0;
    assert!(world.is_clear_between(inside, inside, &Filter2::new().without_touched()));
}
