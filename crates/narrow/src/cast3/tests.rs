//! Casts whose answers are known beforehand.

use crate::counted::steps_of;
use crate::impact3::Impact3;
use crate::numbers::Numbers;
use crate::pair3::Pair3;
use asunder_geometry::glam::{DVec3, Quat, Vec2, Vec3};
use asunder_geometry::{
    Capsule3, Compound3, Cuboid, HalfSpace, HeightField, Hull, Motion3, Pose3, Segment3, Shape3, Sphere,
    TriMesh,
};

fn cube() -> Shape3 {
    Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap().into()
}

fn at(x: f64, y: f64, z: f64) -> Pose3 {
    Pose3::at([x, y, z]).unwrap()
}

#[test]
fn a_cube_that_falls_on_a_face_lands_flat() {
    let (shape, here) = (cube(), at(0.0, 3.0, 0.0));
    for floor in [cube(), HalfSpace::new(Vec3::Y).unwrap().into()] {
        let top = if matches!(floor, Shape3::HalfSpace(_)) { 0.5 } else { 0.0 };
        let (ground, fall) = (at(0.0, top, 0.0), Vec3::NEG_Y * 8.0);
        let impact = Pair3::new(&shape, &here, &floor, &ground).cast(fall).unwrap();
        // Two metres to go in both cases.
        assert!((impact.fraction - 0.25).abs() < 1e-8, "{impact:?}");
        assert!(impact.error < 1e-8 && impact.normal == Vec3::NEG_Y, "{impact:?}");
        assert!((impact.anchor_a.y + 0.5).abs() < 1e-6, "{impact:?}");
    }
}

#[test]
fn what_moves_away_or_past_never_meets() {
    let (shape, here, there) = (cube(), at(0.0, 0.0, 0.0), at(3.0, 0.0, 0.0));
    let pair = Pair3::new(&shape, &here, &shape, &there);
    for displacement in [Vec3::NEG_X, Vec3::Y * 1e9, Vec3::new(4.0, 2.001, 0.0), Vec3::X * 1.999, Vec3::ZERO]
    {
        assert_eq!(pair.cast(displacement), None, "{displacement}");
    }
    assert!(pair.cast(Vec3::X * 2.000_001).is_some());
}

#[test]
fn displacements_that_are_no_number_or_endless_are_none() {
    let (shape, here, there) = (cube(), at(0.0, 0.0, 0.0), at(3.0, 0.0, 0.0));
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(Pair3::new(&shape, &here, &shape, &there).cast(Vec3::X * bad), None);
        let start = Pair3::new(&shape, &here, &shape, &here).cast(Vec3::X * bad).unwrap();
        assert!(start.overlapping && start.normal.is_normalized());
    }
    let far = Pair3::new(&shape, &here, &shape, &there).cast(Vec3::X * 3e38).unwrap();
    assert!(far.fraction > 0.0 && far.fraction * 3e38 <= 2.0, "{far:?}");
}

#[test]
fn touching_exactly_counts_as_touching_at_the_start() {
    let (shape, here, there) = (cube(), at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0));
    for displacement in [Vec3::X, Vec3::NEG_X, Vec3::ZERO] {
        let impact = Pair3::new(&shape, &here, &shape, &there).cast(displacement).unwrap();
        assert!(impact.overlapping && impact.fraction == 0.0 && impact.error == 0.0);
        assert_eq!((impact.normal, impact.anchor_a.x, impact.anchor_b.x), (Vec3::X, 0.5, -0.5));
    }
}

#[test]
fn half_spaces_meet_only_where_they_look_at_each_other() {
    let floor = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    let ceiling = Shape3::from(HalfSpace::new(Vec3::NEG_Y).unwrap());
    let (low, high) = (at(0.0, 0.0, 0.0), at(1e6, 2.0, 0.0));
    let pair = Pair3::new(&floor, &low, &ceiling, &high);
    let impact = pair.cast(Vec3::Y * 4.0).unwrap();
    assert!((impact.fraction - 0.5).abs() < 1e-6 && !impact.overlapping, "{impact:?}");
    assert_eq!(pair.cast(Vec3::Y), None);
    let endless = Pair3::new(&floor, &low, &floor, &high).cast(Vec3::Y).unwrap();
    assert!(endless.overlapping && endless.anchor_a == Vec3::ZERO && endless.normal.is_normalized());
    // A half-space that turns is no longer parallel: they meet far out at once.
    let tilt = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.1, 0.0, 0.0, 1.0)).unwrap();
    let met = pair.impact(&tilt, &Motion3::shift(Vec3::ZERO).unwrap()).unwrap();
    assert!(met.fraction == 0.0 && met.error >= 2.0, "{met:?}");
}

#[test]
fn a_rod_that_turns_meets_a_post_where_the_angle_says() {
    let rod = Shape3::from(Segment3::new(Vec3::NEG_X * 2.0, Vec3::X * 2.0).unwrap());
    let post = Shape3::from(Sphere::new(0.125).unwrap());
    for turn in [
        Quat::from_xyzw(0.0, 0.0, 1.0, 0.0),
        Quat::from_xyzw(0.0, 0.0, 1e-3, 0.0),
        Quat::from_xyzw(0.0, 0.0, 1.0, 1e-6),
    ] {
        let (motion, still) = (Motion3::new(Vec3::ZERO, turn).unwrap(), Motion3::shift(Vec3::ZERO).unwrap());
        for distance in [0.25, 1.0, 1.75] {
            let (here, there) = (at(0.0, 0.0, 0.0), at(0.0, distance, 0.0));
            let impact = Pair3::new(&rod, &here, &post, &there).impact(&motion, &still).unwrap();
            let reached = motion.turn(&here).basis_at(impact.fraction).x;
            // The distance of the ball's centre from the rod's line, less the radius.
            let gap = (reached.cross(DVec3::Y * distance)).length() - 0.125;
            assert!(gap >= 0.0 && gap <= f64::from(impact.error), "{gap} {impact:?}");
            assert!(impact.error < 1e-5 && impact.error > 0.0, "{impact:?}");
        }
    }
}

#[test]
fn what_turns_in_place_and_reaches_nothing_misses() {
    let rod = Shape3::from(Segment3::new(Vec3::NEG_X, Vec3::X).unwrap());
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let half = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 0.0)).unwrap();
    let still = Motion3::shift(Vec3::ZERO).unwrap();
    let (here, there) = (at(0.0, 0.0, 0.0), at(0.0, 1.501, 0.0));
    assert_eq!(Pair3::new(&rod, &here, &ball, &there).impact(&half, &still), None);
    assert_eq!(Pair3::new(&ball, &here, &ball, &there).impact(&half, &half), None);
    // A wheel on a road that it all but touches.
    let wheel = Shape3::from(Hull::from_points(&wheel(64)).unwrap());
    let road = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    let (axle, ground) = (at(0.0, 1.001, 0.0), at(0.0, 0.0, 0.0));
    assert_eq!(Pair3::new(&wheel, &axle, &road, &ground).impact(&half, &still), None);
}

fn wheel(count: usize) -> Vec<Vec3> {
    let spoke = |i: usize| {
        let (sine, cosine) = glam_free(i as f64 / count as f64);
        [Vec3::new(cosine, sine, -0.25), Vec3::new(cosine, sine, 0.25)]
    };
    (0..count).flat_map(spoke).collect()
}

/// A point of the unit circle by a share of a turn, without trigonometry.
fn glam_free(share: f64) -> (f32, f32) {
    let half = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 0.0)).unwrap();
    let (way, sign) = if share < 0.5 { (share * 2.0, 1.0) } else { (share * 2.0 - 1.0, -1.0) };
    let x = half.turn(&Pose3::IDENTITY).basis_at(way).x * sign;
    (x.y as f32, x.x as f32)
}

/// Numbers from -1 to 1, the same in every run.
fn numbers() -> impl FnMut() -> f32 {
    let mut state = 11_u32;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}

#[test]
fn boxes_by_their_axes_and_balls_by_their_own_meet_where_their_hulls_do() {
    let mut number = numbers();
    let (mut hits, mut misses) = (0, 0);
    for case in 0..4000 {
        let mut vector = || Vec3::new(number(), number(), number());
        let halves = [vector(), vector()].map(|half| half.abs() + 0.05);
        // Every fourth pair has equal rotations, so that faces and edges lie on each other.
        let turn = vector();
        let other = if case % 4 == 0 { turn } else { vector() };
        let [here, there] = [(Vec3::ZERO, turn), (vector() * 6.0, other)]
            .map(|(at, q)| Pose3::new(at, Quat::from_xyzw(q.x, q.y, q.z, 0.7)).unwrap());
        let way = (there.position().as_vec3() + vector() * 1.5) * 1.5;
        let quick = halves.map(|half| match case % 3 {
            0 => Shape3::from(Sphere::new(half.x).unwrap()),
            _ => Cuboid::from_half_extents(half).unwrap().into(),
        });
        let slow = halves.map(|half| match case % 3 {
            0 => Shape3::from(Hull::of_any_dimension(&[Vec3::ZERO]).unwrap().rounded(half.x).unwrap()),
            _ => Hull::from_points(&Cuboid::from_half_extents(half).unwrap().vertices()).unwrap().into(),
        });
        match same_cast([&quick, &slow], [&here, &there], way) {
            Some(hit) => {
                hits += usize::from(!hit.overlapping);
                assert!(hit.error < 1e-8, "{case}: {hit:?}");
            }
            None => misses += 1,
        }
    }
    assert!(hits > 1000 && misses > 300, "{hits} {misses}");
}

/// The cast of one pair of shapes, which must be that of another up to their errors.
fn same_cast([one, other]: [&[Shape3; 2]; 2], at: [&Pose3; 2], way: Vec3) -> Option<Impact3> {
    let [hit, same] = [one, other].map(|[a, b]| Pair3::new(a, at[0], b, at[1]).cast(way));
    let context = format!("{hit:?} {same:?} {one:?} {at:?} {way}");
    match (&hit, &same) {
        (Some(hit), Some(same)) => {
            assert_eq!(hit.overlapping, same.overlapping, "{context}");
            // Each is before the true fraction by no more than its gap over the speed at which that closes.
            let closing = f64::from(same.normal.dot(way).min(hit.normal.dot(way)));
            let room = f64::from(hit.error + same.error) / closing.max(1e-3);
            assert!((hit.fraction - same.fraction).abs() <= 2.0 * room, "{context}");
        }
        (None, None) => {}
        _ => panic!("{context}"),
    }
    hit
}

#[test]
fn what_comes_down_on_a_cuboid_meets_it_where_it_meets_its_hull() {
    let mut number = numbers();
    let (mut flat, mut in_closed_form, mut misses, mut at_edges) = (0, 0, 0, 0);
    for case in 0..6000 {
        let mut vector = || Vec3::new(number(), number(), number());
        let half = vector().abs() * 1.5 + 0.05;
        let [here, there] = [(Vec3::ZERO, vector()), (vector() * 6.0, vector())]
            .map(|(at, q)| Pose3::new(at, Quat::from_xyzw(q.x, q.y, q.z, 0.7)).unwrap());
        let way = (there.position().as_vec3() + vector()) * 1.5;
        let points = [(); 6].map(|()| vector());
        let body: Shape3 = match case % 4 {
            0 => Sphere::new(half.x).unwrap().into(),
            1 => Capsule3::new(points[0], points[1], half.y).unwrap().into(),
            2 => Hull::from_points(&points).unwrap().into(),
            _ => Hull::from_points(&points).unwrap().rounded(0.1).unwrap().into(),
        };
        let cuboid = Cuboid::from_half_extents(half).unwrap();
        let corners = Hull::from_points(&cuboid.vertices()).unwrap();
        let radius = if case % 3 == 0 { 0.2 } else { 0.0 };
        let [cuboid, corners]: [Shape3; 2] =
            [cuboid.rounded(radius).unwrap().into(), corners.rounded(radius).unwrap().into()];
        let turned = |a: Shape3, b: Shape3| if case % 5 < 2 { [b, a] } else { [a, b] };
        let [quick, slow] = [cuboid, corners].map(|block| turned(body.clone(), block));
        match same_cast([&quick, &slow], [&here, &there], way) {
            Some(hit) if !hit.overlapping => {
                let block = if case % 5 < 2 { &here } else { &there };
                let basis = block.basis();
                let normal = hit.normal.as_dvec3();
                let is_flat =
                    [basis.x, basis.y, basis.z].iter().any(|axis| axis.dot(normal).abs() > 0.999_999);
                flat += usize::from(is_flat);
                at_edges += usize::from(!is_flat);
                if is_flat {
                    // Steps leave a millionth of the size between round shapes, closed forms less.
                    in_closed_form += usize::from(hit.error < 1e-7);
                    let [on_a, on_b] = [hit.anchor_a, hit.anchor_b].map(|anchor| anchor.as_dvec3());
                    let between = there.position() - (here.position() + way.as_dvec3() * hit.fraction);
                    let apart = (between + on_b - on_a).length();
                    assert!(apart < 1e-6, "{case}: the anchors are {apart} apart, {hit:?}");
                }
            }
            Some(_) => {}
            None => misses += 1,
        }
    }
    assert!(flat > 1000 && misses > 300 && at_edges > 800, "{flat} {misses} {at_edges}");
    // Edges may be met along all but a face's normal.
    assert!(in_closed_form * 50 >= flat * 49, "{in_closed_form} of {flat}");
}

#[test]
fn a_ball_that_turns_about_its_middle_rolls_into_what_one_that_does_not_turn_rolls_into() {
    let mut number = numbers();
    // Pits two metres apart, of uneven depth; the ball is near the bottom, in one face or in more.
    let is_deep = |i: usize| (i / 9).is_multiple_of(2) && (i % 9).is_multiple_of(2);
    let heights: Vec<f32> =
        (0..81).map(|i| 0.1 * (1.0 + number()) * if is_deep(i) { -1.0 } else { 0.2 }).collect();
    let hills = Shape3::from(HeightField::new(9, 9, heights, Vec2::ONE).unwrap());
    let middle = hills.center().as_dvec3();
    let (ball, still) = (Shape3::from(Sphere::new(0.5).unwrap()), Motion3::STILL);
    let (mut at_start, mut later, mut passed) = (0, 0, 0);
    for i in 0..1000 {
        let pit = DVec3::new((i % 3) as f64 - 1.0, 0.0, (i / 3 % 3) as f64 - 1.0) * 2.0;
        let above = middle + pit + DVec3::new(0.02 * f64::from(number()), 3.0, 0.02 * f64::from(number()));
        let above = Pose3::at(above).unwrap();
        let down = Pair3::new(&ball, &above, &hills, &Pose3::IDENTITY).cast(Vec3::NEG_Y * 4.0).unwrap();
        let deep = [1e-5, 1e-3, 1e-2][i % 3];
        let from = above.shifted(DVec3::NEG_Y * (4.0 * down.fraction + deep)).unwrap();
        let way = Vec3::new(number(), 0.1 * number(), number()) * [0.3, 2.0][i % 2];
        let plain = Motion3::shift(way).unwrap();
        let pair = Pair3::new(&ball, &from, &hills, &Pose3::IDENTITY);
        let back = Pair3::new(&hills, &Pose3::IDENTITY, &ball, &from);
        let (ours, theirs) = (pair.next_impact(&plain, &still), back.next_impact(&still, &plain));
        match &ours {
            Some(met) if met.fraction == 0.0 => at_start += 1,
            Some(_) => later += 1,
            None => passed += 1,
        }
        for angle in [1e-6, 0.3, -2.5] {
            let turn = Quat::from_xyzw(number(), number(), number(), 1.0 / angle);
            let turning = Motion3::new(way, turn).unwrap();
            assert_eq!(pair.next_impact(&turning, &still), ours, "{i} {way} {angle}");
            assert_eq!(back.next_impact(&still, &turning), theirs, "{i} {way} {angle}");
        }
    }
    assert!(at_start > 20 && later > 100 && passed > 100, "{at_start} {later} {passed}");
}

/// A slab of `count` by `count` cuboids, each tilted in a way of its own.
fn slab(numbers: &mut Numbers, count: u32) -> Shape3 {
    let mut tilt = || numbers.number() as f32 * 0.01;
    let half = f64::from(count) / 2.0;
    let parts = (0..count * count).map(|i| {
        let at = DVec3::new(f64::from(i % count) - half, 0.0, f64::from(i / count) - half);
        (Pose3::new(at, Quat::from_xyzw(tilt(), 0.0, tilt(), 1.0)).unwrap(), cube())
    });
    Compound3::new(parts).unwrap().into()
}

/// Two slabs that lie on each other, pressed together: once, each pair of parts that meets was compared with each
/// contact.
#[test]
fn what_is_met_next_takes_as_much_longer_as_there_are_more_contacts() {
    let mut numbers = Numbers::new(5730);
    let motion = Motion3::new([0.7, -0.6, 0.4], Quat::from_xyzw(0.0, 0.002, 0.0, 1.0)).unwrap();
    let [few, many] = [8, 24].map(|count| {
        let (one, two) = (slab(&mut numbers, count), slab(&mut numbers, count));
        let (here, above) = (at(0.0, 0.0, 0.0), at(0.3, 1.0, 0.2));
        let pair = Pair3::new(&one, &above, &two, &here);
        let contacts = pair.manifolds(0.0).len();
        let (impact, steps) = steps_of(|| pair.next_impact(&motion, &Motion3::STILL));
        assert!(contacts > 2 * (count * count) as usize && impact.is_some(), "{contacts} {impact:?}");
        steps / contacts
    });
    assert!(many < 3 * few, "steps a contact: {few}, and {many} of nine times as many");
}

/// A floor that faces up where x is below zero, and from its end a slope upwards.
fn valley() -> TriMesh {
    let row = |x: f32, y: f32| [Vec3::new(x, y, -8.0), Vec3::new(x, y, 8.0)];
    let vertices = [row(-8.0, 0.0), row(0.0, 0.0), row(8.0, 8.0)].concat();
    TriMesh::new(vertices, [[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]]).unwrap()
}

#[test]
fn what_comes_up_through_one_sided_ground_passes_the_edge_of_what_is_beside() {
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let capsule = Shape3::from(Capsule3::from_half_height(0.5, 0.5).unwrap());
    let (one_sided, both_sides) = (Shape3::from(valley().one_sided()), Shape3::from(valley()));
    let tilt = Quat::from_xyzw(1e-4, 0.0, 1e-4, 1.0);
    let still = Motion3::STILL;
    // In the hill behind the slope, and above the plane of the floor, whose end is in the way of the lowest ball.
    for (body, turn, height) in [(&ball, Quat::IDENTITY, 0.25), (&ball, tilt, 0.25), (&capsule, tilt, 0.75)] {
        let here = at(2.0, height, 0.1);
        let from = |way: Vec3, ground: &Shape3| {
            let motion = Motion3::new(way, turn).unwrap();
            let ours = Pair3::new(body, &here, ground, &Pose3::IDENTITY).next_impact(&motion, &still);
            [ours, Pair3::new(ground, &Pose3::IDENTITY, body, &here).impact(&still, &motion)]
        };
        assert_eq!(from(Vec3::new(-3.0, 0.2, 0.0), &one_sided), [None; 2], "it rises from the floor");
        let [ours, theirs] = from(Vec3::new(-3.0, -0.1, 0.0), &one_sided).map(Option::unwrap);
        assert!(ours.normal == Vec3::NEG_Y && theirs.normal == Vec3::Y, "{ours:?} {theirs:?}");
    }
    // From above, and by two-sided ground, it is stopped all the same.
    let above = Pair3::new(&ball, &at(-1.0, 1.0, 0.0), &one_sided, &Pose3::IDENTITY);
    assert_eq!(above.cast(Vec3::NEG_Y).unwrap().normal, Vec3::NEG_Y);
    let behind = Pair3::new(&ball, &at(2.0, 0.25, 0.1), &both_sides, &Pose3::IDENTITY);
    assert!(behind.cast(Vec3::new(-3.0, 0.2, 0.0)).is_some_and(|met| met.normal.x < -0.5));
}

#[test]
fn what_swings_up_past_an_edge_and_down_into_its_front_is_stopped() {
    // On an arm of 20 m: over the end of the floor at a height of 0.35 m, and 4 m on through it.
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let arm = Shape3::from(Compound3::new([(at(2.0, 19.9, 0.0), ball)]).unwrap());
    let (ground, here) = (Shape3::from(valley().one_sided()), at(0.0, -19.65, 0.1));
    let swung = |turn: f32| {
        let motion = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, turn, 1.0)).unwrap();
        Pair3::new(&arm, &here, &ground, &Pose3::IDENTITY).impact(&motion, &Motion3::STILL)
    };
    assert_eq!(swung(0.1), None, "it ends above the floor");
    assert!(swung(0.15).is_some_and(|met| met.normal.x < -0.5 && met.normal.y < 0.0));
}

#[test]
fn no_ground_is_met_by_a_normal_that_one_moves_along() {
    let mut number = numbers();
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let bodies = [ball, cube(), Capsule3::from_half_height(0.4, 0.2).unwrap().into()];
    let mut met = [0; 2];
    for i in 0..12_000 {
        let height = [0.05, 0.5, 2.0][i % 3];
        let heights: Vec<f32> = (0..16).map(|_| height * number()).collect();
        let field = HeightField::new(4, 4, heights, Vec2::ONE).unwrap();
        let is_one_sided = i % 4 > 0;
        let hills = Shape3::from(if is_one_sided { field.one_sided() } else { field });
        let mut vector = || DVec3::new(f64::from(number()), f64::from(number()), f64::from(number()));
        let from = hills.center().as_dvec3() + vector() * DVec3::new(2.5, 1.0, 2.5);
        let (way, turn) = (vector().as_vec3() * 2.0, vector().as_vec3());
        let from = Pose3::new(from, Quat::from_xyzw(turn.x, turn.y, turn.z, 0.5)).unwrap();
        let pair = Pair3::new(&bodies[i / 3 % 3], &from, &hills, &Pose3::IDENTITY);
        let motion = Motion3::shift(way).unwrap();
        let (first, next) = (pair.cast(way), pair.next_impact(&motion, &Motion3::STILL));
        for impact in [first, next].iter().flatten().filter(|it| !it.overlapping && it.fraction > 0.0) {
            assert!(impact.normal.dot(way) > -2e-4 * way.length(), "{i}: {way} {impact:?}");
            met[usize::from(is_one_sided)] += 1;
        }
    }
    assert!(met[0] > 300 && met[1] > 300, "{met:?}");
}
