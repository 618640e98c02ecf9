//! What an update reports of this frame's motions, against a loop over all pairs.

use asunder::slotmap::Key;
use asunder::{
    Circle, Collider, Collider2, Collider3, Cuboid, HalfSpace, Motion2, Motion3, Plane, Pose2, Pose3,
    Rotation2, Space, Sphere, Volume, World, World2, World3, glam::Quat, glam::Vec3,
};
use asunder_tests::cases::Random;
use asunder_tests::engine::{Engine, slot_of};
use rayon::ThreadPoolBuilder;
use std::collections::BTreeMap;

/// A bullet, what it hits, whether either is a sensor, and the impact.
type Expected<S> = (<S as Space>::Key, <S as Space>::Key, bool, <S as Space>::Impact);

/// Bodies in a room, most of them with a motion, and some of them bullets.
struct Room<S: Engine> {
    world: World<S>,
    motions: BTreeMap<u32, S::Motion>,
}

impl<S: Engine> Room<S> {
    fn new(random: &mut Random, bodies: usize, reach: f64) -> Self {
        let mut room = Self { world: World::new(), motions: BTreeMap::new() };
        for _ in 0..bodies {
            let body = S::random_body(random, reach);
            let body = if random.below(2) == 0 { body.bullet() } else { body };
            let body = if random.below(4) == 0 { body.impacts_only() } else { body };
            S::insert(&mut room.world, body);
        }
        room
    }

    fn set_motions(&mut self, random: &mut Random, reach: f64) {
        self.motions.clear();
        for (key, _) in S::bodies(&self.world) {
            if random.below(4) > 0 {
                let motion = S::random_motion(random, reach);
                assert!(S::set_motion(&mut self.world, key, motion));
                self.motions.insert(slot_of(key), motion);
            }
        }
    }

    /// What bullets run into, by a loop over all pairs.
    fn expected(&self) -> Vec<Expected<S>> {
        let bodies = S::bodies(&self.world);
        let still = S::shift(0.0);
        let motion = |key: S::Key| self.motions.get(&slot_of(key)).unwrap_or(&still);
        let mut all = Vec::new();
        for (bullet, a) in bodies.iter().filter(|(_, body)| body.is_bullet()) {
            let mut of_bullet = Vec::new();
            let mut touches = Vec::new();
            let solid = |b: &Collider<S>| !a.is_sensor() && !b.is_sensor() && may_meet(a, b);
            for (_, b) in bodies.iter().filter(|(other, b)| other != bullet && solid(b)) {
                S::add_touches(a, b, &mut touches);
            }
            for (other, b) in bodies.iter().filter(|(other, _)| other != bullet) {
                let moves = self.motions.contains_key(&slot_of(*bullet))
                    || self.motions.contains_key(&slot_of(*other));
                if !moves || !may_meet(a, b) {
                    continue;
                }
                let (a_moves, b_moves) = ((a, motion(*bullet)), (b, motion(*other)));
                let found = match S::first_touch(a_moves, b_moves) {
                    // For solids, what is touched at the start and what is level with it is passed over. A sensor that
                    // overlaps at the start gives no impact.
                    Some(_) if !a.is_sensor() && !b.is_sensor() => S::next_touch(a_moves, b_moves, &touches),
                    Some((fraction, false, impact)) => Some((fraction, impact)),
                    _ => None,
                };
                let Some((fraction, impact)) = found else { continue };
                of_bullet.push((
                    fraction,
                    slot_of(*other),
                    (*bullet, *other, a.is_sensor() || b.is_sensor(), impact),
                ));
            }
            of_bullet.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            let solid = of_bullet.iter().position(|(.., (_, _, sensor, _))| !sensor);
            of_bullet.truncate(solid.map_or(of_bullet.len(), |solid| solid + 1));
            all.extend(of_bullet.into_iter().map(|(.., hit)| hit));
        }
        all
    }

    /// Asserts that the world, just updated, reports what the loop over all pairs does; returns the numbers of impacts
    /// and speculative contacts.
    fn check(&self) -> (usize, usize) {
        let expected = self.expected();
        let found: Vec<_> = S::impacts(&self.world)
            .iter()
            .map(|hit| (hit.bullet, hit.other, hit.sensor, hit.impact))
            .collect();
        assert_eq!(found, expected);
        // Pairs that meet during these motions have a contact now, except sensors, and bodies without contacts ahead.
        let is_left_out = |of: [&Collider<S>; 2]| of.iter().any(|body| body.is_impacts_only());
        for &(bullet, other, sensor, _) in &expected {
            let contact = S::contact(&self.world, bullet, other);
            let [a, b] = [bullet, other].map(|key| S::get(&self.world, key).unwrap());
            let still = S::shift(0.0);
            let is_apart = S::first_touch((a, &still), (b, &still)).is_none();
            let is_told = contact.is_some_and(|contact| contact.overlapping != is_apart);
            assert!(sensor || is_told || is_apart && is_left_out([a, b]));
        }
        let contacts = S::contacts(&self.world);
        for contact in contacts.iter().filter(|contact| contact.speculative) {
            assert!(!contact.overlapping && !contact.is_new && !contact.manifolds.is_empty());
            assert!(!S::is_touching(&self.world, contact.a, contact.b));
            assert!(!is_left_out([contact.a, contact.b].map(|key| S::get(&self.world, key).unwrap())));
        }
        (expected.len(), contacts.iter().filter(|contact| contact.speculative).count())
    }
}

fn may_meet<S: Engine>(a: &Collider<S>, b: &Collider<S>) -> bool {
    let one_owner = a.get_owner().is_some() && a.get_owner() == b.get_owner();
    a.get_layers().meets(b.get_layers()) && !one_owner && !(a.is_fixed() && b.is_fixed())
}

fn rooms<S: Engine>(seed: u128) {
    let mut random = Random::new(seed);
    let (mut impacts, mut speculative) = (0, 0);
    for _ in 0..12 {
        let mut room = Room::<S>::new(&mut random, 24, 6.0);
        for reach in [0.0, 1.0, 5.0, 40.0] {
            room.set_motions(&mut random, reach);
            room.world.update();
            let (hit, to_come) = room.check();
            (impacts, speculative) = (impacts + hit, speculative + to_come);
        }
        // Motions hold for one frame only.
        room.world.update();
        assert!(S::impacts(&room.world).is_empty());
        assert!(S::contacts(&room.world).iter().all(|contact| !contact.speculative));
        let boxes: Vec<_> = S::candidates(&room.world);
        let mut fresh = World::<S>::new();
        for (_, body) in S::bodies(&room.world) {
            S::insert(&mut fresh, body);
        }
        fresh.update();
        assert_eq!(boxes, S::candidates(&fresh), "boxes are as tight as before");
    }
    assert!(impacts > 30 && speculative > 500, "{impacts} impacts, {speculative} contacts to come");
}

#[test]
fn rooms_in_space() {
    rooms::<Volume>(910);
}

#[test]
fn rooms_in_the_plane() {
    rooms::<Plane>(911);
}

fn one_pair<S: Engine>() {
    let mut world = World::<S>::new();
    let a = S::insert(&mut world, S::unit_at(0.0));
    let b = S::insert(&mut world, S::unit_at(2.0).bullet());
    // A gap of a metre; the two approach each other by 0.9 m, then by 1.5 m.
    for (shift, is_near, is_hit) in [(0.9, false, false), (1.5, true, true), (0.0, false, false)] {
        assert!(S::set_motion(&mut world, a, S::shift(shift / 3.0)));
        assert!(S::set_motion(&mut world, b, S::shift(-shift * 2.0 / 3.0)));
        world.update();
        let contact = S::contact(&world, a, b);
        assert_eq!(contact.is_some_and(|contact| contact.speculative && !contact.overlapping), is_near);
        assert_eq!(S::impacts(&world).len(), usize::from(is_hit));
        assert!(S::events(&world).is_empty());
        if let [hit] = S::impacts(&world) {
            assert_eq!((hit.bullet, hit.other, hit.sensor), (b, a, false));
        }
    }
    // They touch, and separate; a motion that brings them back does not delay the end event.
    assert!(S::set_pose(&mut world, b, S::pose_at(1.0)));
    world.update();
    assert!(S::events(&world)[0].is_began());
    assert!(S::set_pose(&mut world, b, S::pose_at(1.5)));
    assert!(S::set_motion(&mut world, b, S::shift(-1.0)));
    world.update();
    assert!(matches!(S::events(&world), [event] if !event.is_began()));
    assert!(S::contact(&world, a, b).is_some_and(|contact| contact.speculative));
    assert!(!S::is_touching(&world, a, b));
    // An overlap at the start is a contact, not an impact.
    assert!(S::set_pose(&mut world, b, S::pose_at(0.5)));
    assert!(S::set_motion(&mut world, b, S::shift(-1.0)));
    world.update();
    assert!(S::impacts(&world).is_empty() && S::is_touching(&world, a, b));
    // A removed body takes its motion along, and a new one in its slot has none.
    assert!(S::set_motion(&mut world, b, S::shift(-9.0)));
    S::remove(&mut world, b);
    assert!(!S::set_motion(&mut world, b, S::shift(1.0)), "a stale key moves nobody");
    let c = S::insert(&mut world, S::unit_at(5.0).bullet());
    assert_eq!(slot_of(c), slot_of(b));
    world.update();
    assert!(S::impacts(&world).is_empty());
    assert!(!S::set_motion(&mut world, S::Key::null(), S::shift(1.0)));
}

#[test]
fn one_pair_in_space() {
    one_pair::<Volume>();
}

#[test]
fn one_pair_in_the_plane() {
    one_pair::<Plane>();
}

#[test]
fn too_many_pairs_are_no_impacts() {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(0.5).unwrap()).bullet();
    let bullet = world.insert(ball.clone());
    world.insert(ball.at(Pose3::at([3.0, 0.0, 0.0]).unwrap()));
    world.set_max_pairs(0);
    world.set_motion(bullet, Motion3::shift([9.0, 0.0, 0.0]).unwrap()).unwrap();
    world.update();
    assert!(world.stats().overflow && world.impacts().is_empty());
    world.set_max_pairs(9);
    world.update();
    assert!(!world.stats().overflow && world.impacts().is_empty() && world.contacts().len() == 0);
}

#[test]
fn nothing_tunnels() {
    // 500 m/s at 60 steps a second, at a wall of a centimetre; and a rod that makes half a turn past a post.
    let mut world = World3::new();
    let wall = Cuboid::from_half_extents(Vec3::new(0.005, 5.0, 5.0)).unwrap();
    let wall = world.insert(Collider3::new(wall).fixed());
    let ball = Collider3::new(Sphere::new(0.05).unwrap()).bullet();
    let ball = world.insert(ball.at(Pose3::at([-4.0, 1.0, 0.0]).unwrap()));
    world.set_motion(ball, Motion3::shift([500.0 / 60.0, 0.0, 0.0]).unwrap()).unwrap();
    world.update();
    let [hit] = world.impacts() else { panic!("{:?}", world.impacts()) };
    assert_eq!((hit.bullet, hit.other), (ball, wall));
    let expected = (4.0 - 0.005 - 0.05) / (500.0 / 60.0);
    assert!(hit.impact.fraction <= expected && hit.impact.fraction > expected - 1e-5);
    assert!((hit.impact.normal - Vec3::X).length() < 1e-5);

    let mut flat = World2::new();
    let rod = asunder::Capsule2::new([-2.0, 0.0].into(), [2.0, 0.0].into(), 0.05).unwrap();
    let rod = flat.insert(Collider2::new(rod).bullet());
    let post = Circle::new(0.1).unwrap();
    let post = flat.insert(Collider2::new(post).at(Pose2::at([0.0, 1.5]).unwrap()));
    let half_turn = Motion2::new([0.0, 0.0], Rotation2::new(-1.0, 0.0).unwrap()).unwrap();
    flat.set_motion(rod, half_turn).unwrap();
    flat.update();
    assert!(matches!(flat.impacts(), [hit] if (hit.bullet, hit.other) == (rod, post)));
    assert!(flat.contact(rod, post).is_some_and(|contact| contact.speculative));
}

#[test]
fn what_has_no_end_may_turn() {
    let mut world = World3::new();
    let ground = world.insert(Collider3::new(HalfSpace::new(Vec3::Y).unwrap()));
    let ball = Collider3::new(Sphere::new(0.5).unwrap()).bullet();
    let ball = world.insert(ball.at(Pose3::at([100.0, 3.0, 0.0]).unwrap()));
    let tilt = Motion3::new([0.0; 3], Quat::from_xyzw(0.0, 0.0, 0.1, 1.0)).unwrap();
    world.set_motion(ground, tilt).unwrap();
    world.update();
    assert!(world.contact(ground, ball).is_some());
    assert!(matches!(world.impacts(), [hit] if hit.other == ground && hit.impact.fraction < 0.5));
    let away = Motion3::new([1e9, 0.0, 0.0], Quat::from_xyzw(1.0, 0.0, 0.0, 0.0)).unwrap();
    world.set_motion(ball, away).unwrap();
    world.set_motion(ground, Motion3::shift([0.0, -1e9, 0.0]).unwrap()).unwrap();
    world.update();
    assert!(world.impacts().is_empty());
}

/// A rod of a thousand kilometres that makes half a turn about its end, past a post far from its boxes at start and
/// end.
#[test]
fn the_largest_bodies_sweep_no_less() {
    let mut world = World3::new();
    let rod = asunder::Segment3::new(Vec3::ZERO, Vec3::X * 1e6).unwrap();
    let rod = world.insert(Collider3::new(rod).bullet());
    let post = Collider3::new(Sphere::new(1e3).unwrap());
    let post = world.insert(post.at(Pose3::at([0.0, 9.5e5, 0.0]).unwrap()));
    let half_turn = Motion3::new([0.0; 3], Quat::from_xyzw(0.0, 0.0, 1.0, 0.0)).unwrap();
    world.set_motion(rod, half_turn).unwrap();
    world.update();
    assert!(matches!(world.impacts(), [hit] if (hit.bullet, hit.other) == (rod, post)));
}

/// Enough bullets for several threads.
#[test]
fn every_number_of_threads_says_the_same() {
    let run = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut random = Random::new(912);
            let mut room = Room::<Volume>::new(&mut random, 200, 5.0);
            room.set_motions(&mut random, 6.0);
            room.world.update();
            assert!(room.world.impacts().len() > 10);
            format!("{:?} {:?}", room.world.impacts(), Volume::contacts(&room.world))
        })
    };
    let alone = run(1);
    assert!([2, 8].into_iter().all(|threads| run(threads) == alone));
}

/// A replaced body is another body, which was given no motion.
#[test]
fn a_body_that_is_replaced_forgets_its_motion() {
    let ball = || Collider3::new(Sphere::new(0.5).unwrap());
    let mut world = World3::new();
    let bullet = world.insert(ball().bullet());
    let wall = world.insert(ball().at(Pose3::at([3.0, 0.0, 0.0]).unwrap()).fixed());
    for is_replaced in [false, true] {
        world.set_motion(bullet, Motion3::shift([4.0, 0.0, 0.0]).unwrap()).unwrap();
        if is_replaced {
            world.replace(bullet, ball().bullet()).unwrap();
        }
        world.update();
        assert_eq!(world.contact(bullet, wall).is_none(), is_replaced, "what the motion would bring");
        assert_eq!(world.impacts().is_empty(), is_replaced, "what the bullet would run into");
    }
}
