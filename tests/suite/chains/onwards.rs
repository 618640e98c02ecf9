//! What bodies that already touch a chain run into next: its walls, and not its vertices.

use super::cut_line;
use asunder::glam::{DVec2, Vec2};
use asunder::{
    Capsule2, Chain, Circle, Collider2, Compound2, Manifold2, Motion2, Pair2, Pose2, Ray2, Rect, Rotation2,
    Shape2, World2, cast_ray2,
};
use asunder_tests::cases::Random;

/// Bodies, with how far they reach down and sideways.
fn bodies() -> Vec<(Shape2, f64, f64)> {
    let balls = [0.3, -0.3].map(|x| (Pose2::at([x, 0.0]).unwrap(), Shape2::from(Circle::new(0.25).unwrap())));
    vec![
        (Circle::new(0.5).unwrap().into(), 0.5, 0.5),
        (Rect::from_half_extents(Vec2::new(0.4, 0.3)).unwrap().into(), 0.3, 0.4),
        (Capsule2::from_half_height(0.3, 0.2).unwrap().into(), 0.5, 0.2),
        (Compound2::new(balls).unwrap().into(), 0.25, 0.55),
    ]
}

#[test]
fn what_touches_its_floor_runs_over_its_vertices_and_into_its_wall() {
    let mut met = 0;
    for seed in 0..2000 {
        let mut random = Random::new(seed);
        let (shape, down, ahead) = bodies().swap_remove(random.below(4));
        // From right to left, so that the front of a one-sided chain faces up; the wall at the right end comes first.
        let mut line = vec![Vec2::new(6.0, 3.0)];
        line.extend(cut_line(DVec2::new(6.0, 0.0), DVec2::new(-6.0, 0.0), 1 + random.below(60)));
        let yard = Chain::open(line).unwrap();
        let yard = Shape2::from(if seed % 2 == 0 { yard } else { yard.one_sided() });
        let pressed = random.pick(&[0.0, 1e-9, 1e-6, 1e-3, 0.02]);
        let start = DVec2::new(random.between(-4.0, 4.0), down - pressed);
        let way = DVec2::new(random.between(0.5, 12.0), -random.pick(&[0.0, 1e-6, 2.7e-3, 0.1]));
        let at = Pose2::new(random.vector().truncate() * 3.0, random.rotation2()).unwrap();
        let posed = Pose2::new(at.transform(start), at.rotation()).unwrap();
        for (place, ground, way) in
            [(Pose2::at(start).unwrap(), Pose2::IDENTITY, way), (posed, at, at.turn(way))]
        {
            let motion = Motion2::shift(way).unwrap();
            let pair = Pair2::new(&shape, &place, &yard, &ground);
            if !pair.overlaps() {
                continue;
            }
            let told = pair.next_impact(&motion, &Motion2::STILL);
            let swapped = Pair2::new(&yard, &ground, &shape, &place).next_impact(&Motion2::STILL, &motion);
            let are_equal = match (told, swapped) {
                (Some(told), Some(swapped)) => (told.fraction - swapped.fraction).abs() < 1e-7,
                (told, swapped) => told.is_none() && swapped.is_none(),
            };
            assert!(are_equal, "{seed}: {told:?} {swapped:?}");
            let expected = (6.0 - ahead - start.x) / ground.turn_back(way).x;
            let Some(impact) = told else {
                assert!(expected > 1.0 - 1e-5, "{seed}: through the wall at {expected}");
                continue;
            };
            assert!((impact.fraction - expected).abs() < 1e-5, "{seed}: {impact:?}, wall at {expected}");
            let normal = ground.turn_back(impact.normal.as_dvec2());
            assert!((normal - DVec2::X).length() < 1e-6 && !impact.overlapping, "{seed}: {impact:?}");
            met += 1;
        }
    }
    assert!(met > 1000, "{met}");
}

#[test]
fn nothing_that_touches_a_rough_chain_comes_through_it() {
    let (mut stopped, mut free) = (0, 0);
    for seed in 0..20_000 {
        let mut random = Random::new(seed);
        let steep = random.pick(&[0.01, 0.1, 0.5]);
        let line: Vec<Vec2> = (0..25)
            .map(|i| Vec2::new(6.0 - 0.5 * i as f32, (random.between(0.0, 1.0) * steep) as f32))
            .collect();
        let ground = Chain::open(line).unwrap();
        let ground = Shape2::from(if seed % 2 == 0 { ground } else { ground.one_sided() });
        let radius = random.between(0.05, 0.6);
        let ball = Shape2::from(Circle::new(radius as f32).unwrap());
        let high = Pose2::at([random.between(-2.0, 2.0), 2.0]).unwrap();
        let fall = Pair2::new(&ball, &high, &ground, &Pose2::IDENTITY).cast(Vec2::NEG_Y * 4.0).unwrap();
        let pressed = random.pick(&[1e-6, 1e-3, 0.1]) * radius;
        let start = high.position() - DVec2::Y * (4.0 * fall.fraction + f64::from(fall.error) + pressed);
        let here = Pose2::at(start).unwrap();
        let pair = Pair2::new(&ball, &here, &ground, &Pose2::IDENTITY);
        assert!(pair.overlaps(), "{seed}");
        let way = DVec2::new(random.signed(), -0.02 * random.between(0.0, 1.0)) * random.between(0.1, 6.0);
        let spin = if seed % 3 == 0 { Rotation2::new(0.3, 0.8).unwrap() } else { Rotation2::IDENTITY };
        let told = pair.next_impact(&Motion2::new(way, spin).unwrap(), &Motion2::STILL);
        let fraction = told.map_or(1.0, |impact| impact.fraction);
        if let Some(impact) = &told {
            let into = impact.normal.as_dvec2().dot(way);
            assert!(into > 0.0 && !impact.overlapping, "{seed}: {impact:?}");
        }
        // How far it goes into the slope that it touches is left to that contact, and adds to how far it is pressed in.
        let into = |manifold: Manifold2| manifold.normal.as_dvec2().dot(way).max(0.0) * fraction;
        let sunk = pressed + radius / 32.0 + pair.manifolds(0.0).into_iter().map(into).fold(0.0, f64::max);
        if sunk < 0.9 * radius {
            let ray = Ray2::new(start, (way * fraction).as_vec2());
            let hit = ray.ok().and_then(|ray| cast_ray2(&ground, &Pose2::IDENTITY, &ray, 1.0));
            assert!(hit.is_none(), "{seed}: its middle comes through at {hit:?} of {fraction}");
            if told.is_some() { stopped += 1 } else { free += 1 }
        }
    }
    assert!(stopped > 500 && free > 300, "{stopped} {free}");
}

#[test]
fn a_bullet_that_slides_along_its_chain_is_told_of_the_wall() {
    let mut world = World2::new();
    let line = [[6.0, 3.0], [6.0, 0.0], [2.0, 0.0], [-6.0, 0.0]].map(Vec2::from);
    let yard = world.insert(Collider2::new(Chain::open(line).unwrap()));
    let ball = Collider2::new(Circle::new(0.5).unwrap()).bullet();
    let ball = world.insert(ball.at(Pose2::at([0.0, 0.499]).unwrap()));
    world.set_motion(ball, Motion2::shift([4.0, -0.003]).unwrap()).unwrap();
    world.update();
    assert!(world.is_touching(yard, ball) && world.impacts().is_empty(), "{:?}", world.impacts());
    world.set_motion(ball, Motion2::shift([40.0, -0.003]).unwrap()).unwrap();
    world.update();
    let [hit] = world.impacts() else { panic!("{:?}", world.impacts()) };
    assert!((hit.impact.fraction - 5.5 / 40.0).abs() < 1e-6 && hit.other == yard, "{hit:?}");
    assert!((hit.impact.normal - Vec2::X).length() < 1e-6, "{hit:?}");
}

#[test]
fn a_floor_of_tiles_in_a_compound_stops_nobody_and_its_wall_does() {
    let tile = |half: [f32; 2]| Shape2::from(Rect::from_half_extents(Vec2::from(half)).unwrap());
    let mut parts: Vec<_> =
        (0..6).map(|i| (Pose2::at([2.0 * f64::from(i) - 5.0, -0.5]).unwrap(), tile([1.0, 0.5]))).collect();
    parts.push((Pose2::at([7.0, 0.0]).unwrap(), tile([1.0, 3.0])));
    let yard = Shape2::from(Compound2::new(parts).unwrap());
    for seed in 0..4000 {
        let mut random = Random::new(seed);
        let (shape, down, ahead) = bodies().swap_remove(random.below(4));
        let start = DVec2::new(random.between(-4.0, 4.0), down - random.pick(&[0.0, 1e-6, 1e-3]));
        let way = DVec2::new(random.between(0.5, 12.0), -random.pick(&[0.0, 1e-6, 2.7e-3]));
        let here = Pose2::at(start).unwrap();
        let pair = Pair2::new(&shape, &here, &yard, &Pose2::IDENTITY);
        if !pair.overlaps() {
            continue;
        }
        let expected = (6.0 - ahead - start.x) / way.x;
        match pair.next_impact(&Motion2::shift(way).unwrap(), &Motion2::STILL) {
            Some(impact) => {
                assert!((impact.fraction - expected).abs() < 1e-5, "{seed}: {impact:?} {expected}")
            }
            None => assert!(expected > 1.0 - 1e-5, "{seed}: through the wall at {expected}"),
        }
    }
}

/// Runs a query when its thread ends, after the thread's query buffers are gone.
struct LastWish(std::sync::mpsc::Sender<bool>);

impl LastWish {
    fn ask() -> bool {
        let line = [[6.0, 3.0], [6.0, 0.0], [-6.0, 0.0]].map(Vec2::from);
        let yard = Shape2::from(Chain::open(line).unwrap());
        let (ball, here) = (Circle::new(0.5).unwrap().into(), Pose2::at([0.0, 0.499]).unwrap());
        let motion = Motion2::shift([40.0, 0.0]).unwrap();
        Pair2::new(&ball, &here, &yard, &Pose2::IDENTITY).next_impact(&motion, &Motion2::STILL).is_some()
    }
}

impl Drop for LastWish {
    fn drop(&mut self) {
        self.0.send(Self::ask()).unwrap();
    }
}

#[test]
fn a_thread_that_is_about_to_end_may_ask() {
    thread_local!(static WISH: std::cell::RefCell<Option<LastWish>> = const { std::cell::RefCell::new(None) });
    let (sender, answers) = std::sync::mpsc::channel();
    let thread = std::thread::spawn(move || {
        // Thread-locals that are created last are dropped first: the query buffers.
        WISH.with(|wish| *wish.borrow_mut() = Some(LastWish(sender)));
        LastWish::ask()
    });
    assert!(thread.join().unwrap());
    assert_eq!(answers.recv(), Ok(true));
}
