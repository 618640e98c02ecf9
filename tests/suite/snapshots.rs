//! A world restored from text has the same outputs, keys and future, bit for bit. No file, however damaged, breaks one.

mod damaged;
mod rollback;

use crate::stored::Stored;
use asunder::slotmap::Key;
use asunder::{
    Collider, Collider3, Compound3, Hooks, Hull, Meeting, Plane, Pose3, Shape3, Side, Space, Volume, World,
    World3,
};
use asunder_tests::cases::Random;
use asunder_tests::engine::{Change, Engine};
use glam::Vec3;
use serde_json::json;

/// Half of the side of the room, in metres: bodies of a metre meet often in it.
const ROOM: f64 = 1.6;

/// Everything that a world shows, in every bit.
fn shown<S: Stored>(world: &World<S>) -> String {
    let mut shown = format!("{:?}", S::bodies(world));
    shown += &format!("{:?}{:?}{:?}", S::candidates(world), S::contacts(world), S::events(world));
    shown += &format!("{:?}", S::impacts(world));
    for (key, _) in S::bodies(world) {
        shown += &format!("{:?}{:?}", S::contacts_of(world, key), S::touching(world, key));
    }
    let counts = *world.stats();
    let counts = (
        counts.bodies,
        counts.moved,
        counts.candidates,
        counts.contacts,
        counts.overlapping,
        counts.overflow,
    );
    shown + &format!("{counts:?}{}", world.stats().manifolds)
}

/// Does the same to several worlds; keys of removed bodies are tried, too.
fn act<S: Stored>(worlds: &mut [World<S>], keys: &mut Vec<S::Key>, random: &mut Random) {
    let key = if keys.is_empty() { S::Key::null() } else { keys[random.below(keys.len())] };
    match random.below(19) {
        0..4 => {
            let shared = (!keys.is_empty() && random.below(3) == 0)
                .then(|| S::get(&worlds[0], key).cloned())
                .flatten();
            let body = shared.map(|body| S::moved(body, S::random_pose(random, ROOM)));
            let mut body = body.unwrap_or_else(|| S::random_body(random, ROOM));
            if random.below(3) == 0 {
                body = body.bullet();
            }
            let came: Vec<S::Key> = worlds.iter_mut().map(|world| S::insert(world, body.clone())).collect();
            assert!(came.iter().all(|&other| other == came[0]), "equal worlds give equal keys: {came:?}");
            keys.push(came[0]);
        }
        4..9 => {
            let pose = S::random_pose(random, ROOM);
            worlds.iter_mut().for_each(|world| _ = S::set_pose(world, key, pose));
        }
        9..11 => worlds.iter_mut().for_each(|world| drop(S::remove(world, key))),
        16..19 => {
            let motion = S::random_motion(random, 2.0);
            worlds.iter_mut().for_each(|world| _ = S::set_motion(world, key, motion));
        }
        11..13 => {
            let change = Change::random(random);
            worlds.iter_mut().for_each(|world| _ = S::change(world, key, &change));
        }
        13 if random.below(12) == 0 => worlds.iter_mut().for_each(World::clear),
        13 if random.below(6) == 0 => {
            let most = random.pick(&[0, 3, 1 << 24]);
            worlds.iter_mut().for_each(|world| world.set_max_pairs(most));
        }
        _ => {
            let dice = random.below(1 << 20) as u64;
            let with_hooks = dice.is_multiple_of(4);
            worlds
                .iter_mut()
                .for_each(|world| if with_hooks { update_with(world, dice) } else { world.update() });
        }
    }
}

/// Updates with hooks that reject a third of the pairs, and remove some manifolds of each contact.
fn update_with<S: Space>(world: &mut World<S>, dice: u64) {
    let thrown = |a: &Collider<S>, b: &Collider<S>| (a.get_user_data() + 31 * b.get_user_data() + dice) % 3;
    let pair = |a: Side<'_, S>, b: Side<'_, S>| thrown(a.body, b.body) != 0;
    let contact = |meeting: Meeting<'_, S>| {
        let keep = thrown(meeting.a.body, meeting.b.body) - 1;
        meeting.manifolds.truncate(keep as usize);
    };
    world.update_with(&Hooks::new().pair(&pair).contact(&contact));
}

/// At a random moment, the world itself, a clone, and two worlds restored from its text have the same future.
fn futures<S: Stored>(seed: u128) {
    let mut random = Random::new(seed);
    let (mut worlds, mut keys) = (vec![World::<S>::new()], Vec::new());
    for _ in 0..random.below(160) {
        act(&mut worlds, &mut keys, &mut random);
    }
    let world = worlds.remove(0);
    let text = S::text(&world);
    let [one, other] =
        [(); 2].map(|()| S::restored(&text).unwrap_or_else(|error| panic!("{error}: seed {seed}")));
    assert_eq!(shown(&one), shown(&world), "seed {seed}");
    assert_equal_texts(&S::text(&one), &text, seed);
    assert!(S::snapshot(&one) == S::snapshot(&world), "seed {seed}");
    let mut all = [world.clone(), one, other, world];
    for step in 0..120 {
        act(&mut all, &mut keys, &mut random);
        let known = shown(&all[3]);
        for (index, world) in all.iter().enumerate() {
            assert!(shown(world) == known, "world {index} differs {step} steps on, seed {seed}");
        }
        for world in all.iter_mut().filter(|_| step % 3 == 0) {
            world.update();
        }
    }
    // State that is not visible yet is equal, too.
    let texts = all.map(|world| S::text(&world));
    texts.iter().for_each(|text| assert_equal_texts(text, &texts[3], seed));
}

fn assert_equal_texts(one: &str, other: &str, seed: u128) {
    if let Some(place) = one.bytes().zip(other.bytes()).position(|(a, b)| a != b) {
        let around = |text: &str| text[place.saturating_sub(200)..text.len().min(place + 100)].to_owned();
        panic!("seed {seed}: {} is not {}", around(one), around(other));
    }
    assert_eq!(one.len(), other.len(), "seed {seed}");
}

#[test]
fn restored_worlds_have_the_originals_future_in_space() {
    (0..20).for_each(|seed| futures::<Volume>(800 + seed));
}

#[test]
fn restored_worlds_have_the_originals_future_in_the_plane() {
    (0..20).for_each(|seed| futures::<Plane>(900 + seed));
}

/// A crowd mostly at rest: the restored world sweeps all bodies where the original kept the resting ones.
#[test]
fn a_large_world_at_rest_comes_back() {
    let mut random = Random::new(1000);
    let mut world = World3::new();
    let keys: Vec<_> = (0..1500).map(|_| world.insert(Volume::random_body(&mut random, 9.0))).collect();
    for _ in 0..3 {
        world.update();
    }
    let mut restored = Volume::restored(&Volume::text(&world)).unwrap();
    for _ in 0..8 {
        for _ in 0..5 {
            let (key, pose) = (random.pick(&keys), Volume::random_pose(&mut random, 9.0));
            world.set_pose(key, pose).unwrap();
            restored.set_pose(key, pose).unwrap();
        }
        world.update();
        restored.update();
        assert!(shown(&world) == shown(&restored));
    }
    assert!(world.contacts().len() > 1000, "{}", world.contacts().len());
}

#[test]
fn a_shared_shape_is_stored_once_and_shared_again() {
    let random = &mut Random::new(1001);
    let points: Vec<Vec3> = (0..40).map(|_| random.direction().as_vec3()).collect();
    let hull = Hull::from_points(&points).unwrap();
    let rounded = hull.clone().rounded(0.1).unwrap();
    let parts = [
        (Pose3::IDENTITY, Shape3::from(hull.clone())),
        (Pose3::at([3.0, 0.0, 0.0]).unwrap(), rounded.clone().into()),
    ];
    let compound = Compound3::new(parts).unwrap();
    let mut world = World3::new();
    for i in 0..300 {
        let shape: Shape3 = match i % 3 {
            0 => hull.clone().into(),
            1 => rounded.clone().into(),
            _ => compound.clone().into(),
        };
        world.insert(Collider3::new(shape).at(Pose3::at([f64::from(i) * 10.0, 0.0, 0.0]).unwrap()));
    }
    let mut snapshot = serde_json::to_value(world.snapshot()).unwrap();
    let shapes = &snapshot["content"]["shapes"];
    assert_eq!(
        shapes["polytopes"].as_array().unwrap().len(),
        1,
        "one hull, sharp and rounded, alone and as parts"
    );
    assert_eq!(shapes["compounds"].as_array().unwrap().len(), 1);
    assert_eq!(snapshot.to_string().matches("\"vertices\"").count(), 1);
    let restored = Volume::restored(&snapshot.to_string()).unwrap();
    let address = |body: &Collider3| match body.shape() {
        Shape3::Hull(hull) => hull.shared_address(),
        Shape3::Compound(compound) => compound.shared_address(),
        _ => 0,
    };
    let addresses: Vec<usize> = restored.iter().map(|(_, body)| address(body)).collect();
    assert!(addresses.iter().skip(3).zip(&addresses).all(|(later, earlier)| later == earlier));
    assert!(addresses[0] == addresses[1] && addresses[0] != addresses[2]);
    // A part that shares its hull with bodies shares it again.
    let Some(Shape3::Compound(compound)) = restored.iter().nth(2).map(|(_, body)| body.shape()) else {
        panic!("the third is the compound")
    };
    let Shape3::Hull(part) = compound.parts()[1].shape() else { panic!("its parts are hulls") };
    assert_eq!(part.shared_address(), addresses[0]);
    snapshot["content"]["shapes"]["compounds"][0][0]["shape"] = json!({"Compound": {"index": 0}});
    assert!(Volume::restored(&snapshot.to_string()).unwrap_err().contains("there is no shape 0"));
}

#[test]
fn a_number_that_lost_a_bit_is_noticed() {
    let mut world = World3::new();
    world.insert(Collider3::new(asunder::Sphere::new(0.5).unwrap()).at(Pose3::at([0.1, 0.2, 0.3]).unwrap()));
    let text = Volume::text(&world);
    let said = Volume::restored(
        &text.replace("0.3,", "0.30000000000000004,").replace("0.3]", "0.30000000000000004]"),
    )
    .unwrap_err();
    assert!(said.contains("float_roundtrip"), "{said}");
    assert!(world.snapshot().checksum() != World3::new().snapshot().checksum());
}

/// A slot that was reused many times is restored by its version, not by as many removals.
#[test]
fn old_slots_keep_their_versions() {
    let mut world = World3::new();
    let body = Volume::unit_at(0.0);
    let mut last = world.insert(body.clone());
    for _ in 0..1000 {
        world.remove(last);
        last = world.insert(body.clone());
    }
    let others: Vec<_> = (0..20).map(|_| world.insert(body.clone())).collect();
    for place in [3, 17, 4, 0, 9] {
        world.remove(others[place]);
    }
    let mut restored = Volume::restored(&Volume::text(&world)).unwrap();
    assert!(restored.contains(last) && !restored.contains(others[3]));
    for _ in 0..7 {
        assert_eq!(world.insert(body.clone()), restored.insert(body.clone()));
    }
    world.clear();
    let mut empty = Volume::restored(&Volume::text(&world)).unwrap();
    assert_eq!(world.insert(body.clone()), empty.insert(body.clone()), "also when no body was left");
}
