//! What the stepper does with bodies: it lets them bounce, carries them, sends them to sleep, wakes and replays them.
#![allow(clippy::unwrap_used, reason = "helpers of tests stop the test, as tests do")]

use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{Collider2, Collider3, Cuboid, Plane, Pose2, Pose3, Rect, Rotation2, Shape3, Sphere, Volume};
use asunder_examples::game::Game;
use asunder_examples::opened::{AnyGame, scene};
use asunder_examples::recording::{Head, read_head};
use asunder_examples::replay::{Recorder, replay};
use asunder_examples::report::STEP;
use asunder_examples::stepper::{Dimension, MARGIN, State, Stepper};

fn cuboid(half: Vec3) -> Shape3 {
    Cuboid::from_half_extents(half).unwrap().into()
}

/// A floor with its top at zero.
fn floored() -> Game<Volume> {
    let mut game = Game::new(DVec3::NEG_Y * 9.81);
    add(&mut game, &cuboid(Vec3::new(50.0, 1.0, 50.0)), DVec3::NEG_Y, true);
    game
}

fn add(game: &mut Game<Volume>, shape: &Shape3, place: DVec3, fixed: bool) -> usize {
    let pose = Pose3::at(place).unwrap();
    let collider = Collider3::new(shape.clone()).at(pose).margin(MARGIN).unwrap();
    let collider = if fixed { collider.fixed() } else { collider };
    game.add(collider, DVec3::ZERO, DVec3::ZERO).unwrap()
}

fn steps(game: &mut Game<Volume>, count: u32) {
    (0..count).for_each(|_| game.step(STEP));
}

#[test]
fn a_ball_rises_as_high_as_its_restitution_says() {
    for restitution in [0.0, 0.5, 0.8] {
        let mut game = floored();
        game.stepper.feel.restitution = restitution;
        let ball = add(&mut game, &Sphere::new(0.25).unwrap().into(), DVec3::Y * 2.25, false);
        game.update();
        // The fall takes 0.64 s; the top of the first bounce is sought in the second after that.
        steps(&mut game, 39);
        let mut top: f64 = 0.0;
        for _ in 0..60 {
            game.step(STEP);
            top = top.max(game.center(ball).unwrap().y - 0.25);
        }
        // The rebound has a share e of the speed, and e squared of the height. Steps of 1/60 s at 6 m/s are 10 cm long.
        let expected = 2.0 * restitution * restitution;
        assert!((top - expected).abs() < 0.1, "{restitution}: {top} m, not {expected}");
    }
}

#[test]
fn a_driven_floor_carries_what_stands_on_it() {
    let mut game = floored();
    let belt = add(&mut game, &cuboid(Vec3::new(5.0, 0.5, 5.0)), DVec3::Y * 0.5, true);
    let speed = 0.6;
    let at = move |frame: u32| Pose3::at([speed * f64::from(frame) * STEP, 0.5, 0.0]).unwrap();
    game.drive(belt, at);
    let cube = add(&mut game, &cuboid(Vec3::splat(0.5)), DVec3::Y * 1.5, false);
    game.update();
    steps(&mut game, 120);
    let moved = game.center(cube).unwrap();
    // Except while friction of 0.8 brings it up to speed: for 0.6 / (0.8 * 9.81) s, at half the speed on average.
    assert!((moved.x - 2.0 * speed).abs() < 0.05 * speed, "{moved}");
    assert!((moved.y - 1.5).abs() < 0.005, "{moved}");
    assert_eq!(game.awake_and_asleep(), (1, 0), "what is carried does not sleep");
}

#[test]
fn what_rests_sleeps_and_moves_nothing_until_it_is_hit() {
    let mut game = floored();
    let cube = cuboid(Vec3::splat(0.5));
    for i in 0..3 {
        add(&mut game, &cube, DVec3::Y * (f64::from(i) + 0.5), false);
    }
    let far = add(&mut game, &cube, DVec3::new(20.0, 0.5, 0.0), false);
    game.update();
    steps(&mut game, 180);
    assert_eq!(game.awake_and_asleep(), (0, 4));
    let digest = game.digest();
    steps(&mut game, 10);
    assert_eq!(
        (game.digest(), game.stepper.world.stats().moved),
        (digest, 0),
        "the engine carries all of it on"
    );

    let ball = add(&mut game, &Sphere::new(0.4).unwrap().into(), DVec3::new(0.0, 5.0, 0.2), false);
    game.update();
    assert_eq!(game.awake_and_asleep(), (1, 4), "it is still in the air");
    steps(&mut game, 45);
    assert_eq!(game.awake_and_asleep(), (4, 1), "the stack wakes as a whole, and nobody else");
    game.set_velocity(far, DVec3::X * 3.0);
    assert_eq!(game.awake_and_asleep(), (5, 0));
    steps(&mut game, 30);
    assert!(game.center(far).unwrap().x > 20.3 && game.center(ball).is_some());
}

#[test]
fn a_recording_plays_again_with_the_same_contacts_and_tells_of_others() {
    let open = || match AnyGame::of(&scene("junkyard", Some(60)).unwrap()).unwrap() {
        AnyGame::Volume(game) => game,
        AnyGame::Plane(_) => unreachable!(),
    };
    let mut game = open();
    let head = Head { dimension: 3, size: 60, bodies: game.len() as u32, name: "junkyard".to_owned() };
    let mut file = Vec::new();
    let mut recorder = Recorder::new(&mut file, &head, &game).unwrap();
    game.update();
    for _ in 0..90 {
        game.step(STEP);
        recorder.record(&game).unwrap();
    }
    recorder.finish().unwrap();
    assert!(game.stepper.world.stats().overlapping > 20, "it says something");

    let play = |mut bytes: &[u8]| {
        let mut game = open();
        let head = read_head(&mut bytes).unwrap();
        replay(&mut game, &mut bytes, &head, u32::MAX).map(|times| (times.steps, game.digest()))
    };
    let (played, digest) = play(&file).unwrap();
    assert_eq!((played, digest), (90, game.digest()));

    // The last numbers of the file are the contacts of the last step.
    let last = file.len() - 1;
    file[last] ^= 1;
    assert!(play(&file).is_err_and(|error| error.to_string().starts_with("step 90: ")));
}

#[test]
fn the_plane_keeps_a_pose_and_turns_by_its_angle() {
    for i in -32..=32 {
        // All the way round, with both ends.
        let angle = f64::from(i) * core::f64::consts::PI / 32.0;
        let (sin, cos) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        let pose = Pose2::new(DVec2::new(3.0, -4.0), Rotation2::new(cos, sin).unwrap()).unwrap();
        let (place, turn) = Plane::place(&pose);
        let back = Plane::pose(place, turn).unwrap();
        assert_eq!(back.position(), pose.position());
        let error = (back.rotation().cos() - cos).abs().max((back.rotation().sin() - sin).abs());
        assert!(error < 2e-7, "{angle}: {error}");
        let x_axis = turn * DVec3::X;
        assert!(
            (x_axis - DVec3::new(f64::from(cos), f64::from(sin), 0.0)).length() < 1e-6,
            "{angle}: {x_axis}"
        );
    }
}

#[test]
fn the_plane_is_stepped_as_space_is_and_stays_flat() {
    let mut stepper = Stepper::<Plane>::new(DVec3::NEG_Y * 9.81);
    let rect = |half: Vec2| Collider2::new(Rect::from_half_extents(half).unwrap()).margin(MARGIN).unwrap();
    let floor = rect(Vec2::new(20.0, 1.0)).at(Pose2::at([0.0, -1.0]).unwrap()).fixed();
    stepper.add(floor, DVec3::ZERO, DVec3::ZERO).unwrap();
    let low = rect(Vec2::splat(0.5)).at(Pose2::at([0.0, 0.5]).unwrap());
    let high = rect(Vec2::splat(0.5)).at(Pose2::at([0.3, 1.6]).unwrap());
    let low = stepper.add(low, DVec3::ZERO, DVec3::ZERO).unwrap();
    let high = stepper.add(high, DVec3::ZERO, DVec3::Z * 0.2).unwrap();
    stepper.update();
    (0..180).for_each(|_| stepper.step(STEP));
    let [low, high] = [low, high].map(|number| &stepper.bodies()[number]);
    assert!((low.center.y - 0.5).abs() < 0.005 && (high.center.y - 1.5).abs() < 0.005, "{low:?} {high:?}");
    for body in [low, high] {
        assert_eq!((body.center.z, body.turn.x, body.turn.y, body.state), (0.0, 0.0, 0.0, State::Asleep));
    }
}

#[test]
fn a_driven_body_goes_with_its_speed_and_a_removed_one_wakes_what_stood_on_it() {
    let mut stepper = Stepper::<Volume>::new(DVec3::NEG_Y * 9.81);
    let mut add = |half: Vec3, y: f64| {
        let collider = Collider3::new(cuboid(half)).at(Pose3::at([0.0, y, 0.0]).unwrap());
        stepper.add(collider.margin(MARGIN).unwrap(), DVec3::ZERO, DVec3::ZERO).unwrap()
    };
    let (table, cube) = (add(Vec3::new(5.0, 0.5, 5.0), 0.5), add(Vec3::splat(0.5), 1.5));
    stepper.drive(table);
    stepper.update();
    stepper.bodies_mut()[table].velocity = DVec3::X;
    (0..60).for_each(|_| stepper.step(STEP));
    let went = stepper.bodies()[table].center;
    assert!((went - DVec3::new(1.0, 0.5, 0.0)).length() < 1e-9, "{went}: no push moves it");
    assert!((stepper.bodies()[cube].center.x - went.x).abs() < 0.1, "and it carries");

    stepper.bodies_mut()[table].velocity = DVec3::ZERO;
    (0..90).for_each(|_| stepper.step(STEP));
    assert_eq!(stepper.asleep(), [cube]);
    stepper.remove(table);
    assert_eq!((stepper.bodies()[table].state, stepper.awake()), (State::Removed, &[cube][..]));
    (0..30).for_each(|_| stepper.step(STEP));
    assert!(stepper.bodies()[cube].center.y < 1.0, "nothing bears it");
    // Numbers of bodies that were removed or never added are ignored.
    stepper.remove(table);
    stepper.remove(99);
    stepper.drive(99);
    stepper.wake(&[table, 99]);
    stepper.place(99, Pose3::IDENTITY);
}
