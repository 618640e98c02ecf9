//! Snapshots that were truncated, changed or made up give an error that says what is wrong, or a world that works.

use super::{ROOM, Stored, act, assert_equal_texts, shown};
use asunder::glam::Vec3;
use asunder::{
    BodyKey3, Collider3, Cuboid, Motion3, Pose3, Snapshot3, SnapshotError, Sphere, TriMesh, Volume, World3,
};
use asunder_tests::cases::Random;
use asunder_tests::engine::Engine;
use serde_json::{Value, json};

/// A world with something of everything: stale keys, margins, sensors, edits by hooks, empty slots.
fn eventful() -> Value {
    let mut random = Random::new(1002);
    let (mut worlds, mut keys) = (vec![World3::new()], Vec::new());
    loop {
        act(&mut worlds, &mut keys, &mut random);
        let world = &worlds[0];
        if world.events().len() > 3 && world.contacts().len() > 4 && world.candidates().len() > 5 {
            let snapshot = serde_json::to_value(world.snapshot()).unwrap();
            if snapshot["content"]["free"].as_array().unwrap().len() > 1 {
                return snapshot;
            }
        }
    }
}

/// Restores a changed snapshot after correcting its checksum, so that only the other checks can reject it.
fn judged(mut changed: Value) -> Result<World3, String> {
    for _ in 0..2 {
        let snapshot: Snapshot3 = match serde_json::from_value(changed.clone()) {
            Ok(snapshot) => snapshot,
            Err(error) => return Err(error.to_string()),
        };
        match World3::restore(&snapshot) {
            Err(SnapshotError::Checksum { found, .. }) => changed["checksum"] = json!(found),
            other => return other.map_err(|error| error.to_string()),
        }
    }
    panic!("a checksum that its own finding does not mend")
}

/// Asserts that a world works: updates, moves, and answers queries.
fn exercise(mut world: World3) {
    let random = &mut Random::new(1003);
    world.set_max_pairs(1 << 20);
    for _ in 0..4 {
        world.update();
        let keys: Vec<_> = world.iter().map(|(key, _)| key).collect();
        for key in keys {
            assert_eq!(
                world.contacts_of(key).count(),
                world.contacts_of(key).filter(|c| c.a == key || c.b == key).count()
            );
            let _ = world.set_pose(key, Volume::random_pose(random, ROOM));
        }
        let key = world.insert(Volume::random_body(random, ROOM));
        assert!(world.contains(key));
        let _ = world.remove(key);
        let again = Volume::restored(&Volume::text(&world)).expect("a world that works can be saved");
        assert!(shown(&again) == shown(&world));
    }
}

#[test]
fn what_contradicts_itself_is_refused_by_name() {
    let whole = eventful();
    judged(whole.clone()).unwrap();
    let refused = |change: &dyn Fn(&mut Value), says: &str| {
        let mut changed = whole.clone();
        change(&mut changed["content"]);
        assert_ne!(changed, whole, "{says}");
        let said = judged(changed).err().unwrap_or_else(|| panic!("taken, though: {says}"));
        assert!(said.contains(says), "{said}, not: {says}");
    };
    let last = |list: &Value| list.as_array().unwrap().len() - 1;
    refused(&|c| c["format"] = json!(1), "format 1");
    refused(&|c| c["extra"] = json!(2), "unknown field");
    refused(&|c| c["free"] = json!([]), "empty slots");
    refused(&|c| c["free"][0] = json!(0), "empty slots");
    refused(&|c| c["free"][0] = c["free"][1].clone(), "empty slots");
    refused(&|c| c["slots"][0]["version"] = json!(4), "slot 1 has a version");
    refused(&|c| c["slots"][0]["version"] = json!(u32::MAX), "slot 1 has a version");
    refused(
        &|c| c["odometers"] = json!([[1, 1.0, 2.0]]),
        "slot 1 has a version that is even or too great, or its body went",
    );
    refused(&|c| c["moved"] = json!([9999]), "moved bodies is out of order");
    refused(&|c| c["dirty"] = json!([2, 2]), "changed bodies is out of order");
    refused(&|c| c["reshaped"] = json!([0]), "reshaped bodies is out of order");
    refused(&|c| c["candidates"][0]["keys"][0]["idx"] = json!(77_777), "candidates has a key");
    refused(&|c| c["candidates"][0]["keys"][1]["version"] = json!(4001), "candidates has a key");
    refused(
        &|c| c["events"][0] = json!({"Began": {"a": {"idx": 0, "version": 1}, "b": {"idx": 1, "version": 1}, "user_data_a": 0, "user_data_b": 0, "sensor": false}}),
        "events has a key",
    );
    refused(
        &|c| {
            let count = last(&c["candidates"]);
            let list = c["candidates"].as_array_mut().unwrap();
            list.swap(0, count);
        },
        "candidates is out of order",
    );
    refused(
        &|c| {
            let first = c["candidates"][0].clone();
            c["candidates"].as_array_mut().unwrap().insert(0, first);
        },
        "number 1 of the candidates is out of order",
    );
    refused(&|c| c["contacts"].as_array_mut().unwrap().reverse(), "contradicts");
    refused(&|c| c["candidates"] = json!([]), "contact 0 contradicts");
    refused(
        &|c| (c["contacts"][0]["begun"], c["contacts"][0]["overlapping"]) = (json!(false), json!(true)),
        "contact 0 contradicts",
    );
    refused(&|c| c["edited"] = json!([[]]), "contradicts");
    let solid = whole["content"]["contacts"]
        .as_array()
        .unwrap()
        .iter()
        .position(|c| c["manifolds"].as_array().is_some_and(|list| !list.is_empty()))
        .unwrap();
    refused(&|c| c["contacts"][solid]["sensor"] = json!(true), "contradicts");
    refused(&|c| c["contacts"][solid]["manifolds"][0]["separation"] = json!(null), "null");
    refused(&|c| c["contacts"][solid]["manifolds"][0]["error"] = json!(-1.0), "manifold that is none");
    refused(
        &|c| c["contacts"][solid]["manifolds"][0]["normal"] = json!([0.0, 0.0, 0.0]),
        "manifold that is none",
    );
    refused(&|c| c["contacts"][solid]["manifolds"][0]["separation"] = json!(1e300), "manifold that is none");
    refused(&|c| c["contacts"][solid]["manifolds"][0]["points"] = json!([]), "manifold that is none");
    let body = whole["content"]["slots"]
        .as_array()
        .unwrap()
        .iter()
        .position(|slot| !slot["body"].is_null())
        .unwrap();
    refused(&|c| c["slots"][body]["body"] = json!(null), "empty slots");
    refused(&|c| c["slots"][body]["body"]["margin"] = json!(-1.0), "margin -1");
    refused(
        &|c| c["slots"][body]["body"]["shape"] = json!({"Polytope": {"index": 99, "radius": 0.0}}),
        "there is no shape 99",
    );
    refused(&|c| c["slots"][body]["body"]["pose"]["position"][0] = json!(1e300), "beyond");
}

/// Every leaf of the text is changed, one at a time, and the checksum corrected: it is rejected, or the world works.
#[test]
fn a_snapshot_with_anything_changed_is_refused_or_works() {
    let whole = eventful();
    let mut leaves = Vec::new();
    collect(&whole["content"], &mut String::from("/content"), &mut leaves);
    let random = &mut Random::new(1004);
    let (mut refused, mut taken) = (0, 0);
    for _ in 0..2500 {
        let mut changed = whole.clone();
        for _ in 0..1 + random.below(2) {
            let place = changed.pointer_mut(&leaves[random.below(leaves.len())]);
            if let Some(place) = place {
                *place = other(place, random);
            }
        }
        match judged(changed) {
            Err(_) => refused += 1,
            Ok(world) => {
                taken += 1;
                if taken % 4 == 0 {
                    exercise(world);
                }
            }
        }
    }
    assert!(refused > 300 && taken > 300, "{refused} refused, {taken} taken");
}

fn collect(value: &Value, path: &mut String, leaves: &mut Vec<String>) {
    leaves.push(path.clone());
    let step = |name: &str, value: &Value, path: &mut String, leaves: &mut Vec<String>| {
        let length = path.len();
        *path += "/";
        *path += name;
        collect(value, path, leaves);
        path.truncate(length);
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(name, value)| step(name, value, path, leaves)),
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, value)| step(&i.to_string(), value, path, leaves))
        }
        _ => {}
    }
}

fn other(value: &Value, random: &mut Random) -> Value {
    match value {
        Value::Bool(is) => json!(!is),
        Value::Number(number) if number.is_f64() => {
            let number = number.as_f64().unwrap_or(0.0);
            random
                .pick(&[
                    json_of(number * 1.5),
                    json_of(-number),
                    json_of(1e300),
                    json_of(0.0),
                    json_of(number + 0.01),
                ])
                .value()
        }
        Value::Number(number) => {
            let number = number.as_u64().unwrap_or(0);
            json!(random.pick(&[
                number.wrapping_add(1),
                number.wrapping_sub(1),
                0,
                number.wrapping_add(2),
                u64::from(u32::MAX),
                u64::MAX,
                1 << 40
            ]))
        }
        Value::Array(list) => {
            let mut list = list.clone();
            match random.below(3) {
                0 => list.reverse(),
                1 => drop(list.pop()),
                _ => list.extend(list.first().cloned()),
            }
            Value::Array(list)
        }
        _ => Value::Null,
    }
}

/// A float that can be picked.
#[derive(Clone, Copy)]
struct Float(f64);

fn json_of(number: f64) -> Float {
    Float(number)
}

impl Float {
    fn value(self) -> Value {
        json!(self.0)
    }
}

/// Truncated anywhere, or with bytes changed: an error, never a panic.
#[test]
fn damaged_text_is_refused() {
    let text = Volume::text(&judged(eventful()).unwrap());
    let random = &mut Random::new(1005);
    for _ in 0..400 {
        let cut = random.below(text.len());
        assert!(Volume::restored(&text[..cut]).is_err(), "cut at {cut}");
        let mut bytes = text.clone().into_bytes();
        for _ in 0..1 + random.below(3) {
            let place = random.below(bytes.len());
            bytes[place] = random.pick(b"0123456789,.-[]{}\":nulltruefalse ");
        }
        let Ok(damaged) = String::from_utf8(bytes) else { continue };
        if let Ok(world) = Volume::restored(&damaged) {
            assert_equal_texts(&Volume::text(&world), &text, 0);
        }
    }
}

/// A crate on another, and one on a level of two triangles, all at rest.
fn resting() -> Value {
    let mut world = World3::new();
    let cube = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap();
    let corners = [[-2.0, 0.0, -2.0], [-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0]].map(Vec3::from);
    let level = TriMesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    world.insert(Collider3::new(level).fixed().margin(0.01).unwrap());
    let at = |height: f64| Pose3::at([0.1, height, 0.2]).unwrap();
    let crates = [0.499, 1.498].map(|height| {
        let body = Collider3::new(cube).at(at(height)).margin(0.01).unwrap();
        (world.insert(body), height)
    });
    world.update();
    // A body that has just been inserted is not known to rest.
    for (key, height) in crates {
        world.set_pose(key, at(height - 1e-7)).unwrap();
    }
    world.update();
    serde_json::to_value(world.snapshot()).unwrap()
}

/// Symptom: an error of the greatest f32 was restored with a manifold kept to be moved along, and reported as infinite.
#[test]
fn what_is_kept_has_lengths_that_can_be() {
    let whole = resting();
    judged(whole.clone()).unwrap();
    let kept = |of: &str| {
        let candidates = whole["content"]["candidates"].as_array().unwrap();
        let is_of = |candidate: &Value| !candidate["persistent"][of].is_null();
        candidates.iter().position(is_of).unwrap_or_else(|| panic!("{candidates:?}"))
    };
    let (solids, grounded) = (kept("Solids"), kept("Grounded"));
    let refused = |number: usize, of: &str, path: &[&str], to: Value| {
        let mut changed = whole.clone();
        let mut at = &mut changed["content"]["candidates"][number]["persistent"][of];
        for step in path {
            at = match step.parse::<usize>() {
                Ok(index) => &mut at[index],
                Err(_) => &mut at[step],
            };
        }
        assert!(at.is_number(), "{path:?}");
        *at = to;
        let said = judged(changed).err().unwrap_or_else(|| panic!("taken, though: {of} {path:?}"));
        assert!(said.contains(&format!("candidate {number} keeps")), "{said}");
    };
    let (much, more) = (json!(f64::from(f32::MAX)), json!(0.5));
    refused(solids, "Solids", &["error"], much.clone());
    refused(solids, "Solids", &["error"], more.clone());
    refused(solids, "Solids", &["separation"], json!(-f64::from(f32::MAX)));
    refused(solids, "Solids", &["terms", "slack"], more);
    refused(solids, "Solids", &["terms", "arms", "1"], much.clone());
    refused(grounded, "Grounded", &["memory", "manifolds", "0", "error"], much.clone());
    refused(grounded, "Grounded", &["memory", "manifolds", "0", "separation"], much.clone());
    refused(grounded, "Grounded", &["arm"], much);
}

/// Two bullets, each of which meets a sensor and a ball, and their keys.
fn met() -> (World3, [BodyKey3; 2]) {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(0.5).unwrap());
    let at = |x: f64, y: f64| Pose3::at([x, y, 0.0]).unwrap();
    let bullets = [0.0, 9.0].map(|y| world.insert(ball.clone().bullet().at(at(0.0, y))));
    for y in [0.0, 9.0] {
        world.insert(ball.clone().sensor().at(at(3.0, y)));
        world.insert(ball.clone().at(at(5.0, y)));
    }
    for bullet in bullets {
        world.set_motion(bullet, Motion3::shift([8.0, 0.0, 0.0]).unwrap()).unwrap();
    }
    world.update();
    (world, bullets)
}

/// Symptom: a made-up list of impacts in another order was restored, and `impacts_of` found nothing in it.
#[test]
fn impacts_are_in_order() {
    let (world, bullets) = met();
    let whole = serde_json::to_value(world.snapshot()).unwrap();
    let restored = judged(whole.clone()).unwrap();
    assert!(bullets.iter().all(|&bullet| restored.impacts_of(bullet).count() == 2));
    for (one, other) in [(0, 1), (2, 3), (0, 2), (1, 3), (0, 3)] {
        let mut changed = whole.clone();
        changed["content"]["impacts"].as_array_mut().unwrap().swap(one, other);
        let said = judged(changed).err().unwrap_or_else(|| panic!("taken: {one} and {other} swapped"));
        assert!(said.contains("impacts is out of order"), "{said}");
    }
    let mut changed = whole;
    changed["content"]["impacts"][0]["bullet"] = json!({"idx": 77_777, "version": 1});
    assert!(judged(changed).is_err_and(|said| said.contains("impacts has a key")));
}

/// Symptom: a made-up impact was restored and told, whatever its numbers: at 1e300 times the motion, with an endless
/// normal. Cause: of impacts only the keys and the order were checked.
#[test]
fn impacts_have_numbers_that_can_be() {
    let whole = serde_json::to_value(met().0.snapshot()).unwrap();
    let places = ["/fraction", "/error", "/normal/0", "/normal/1", "/anchor_a/2", "/anchor_b/0"];
    for place in places {
        for number in [1e300, -1e300] {
            let mut changed = whole.clone();
            *changed["content"]["impacts"][3]["impact"].pointer_mut(place).unwrap() = json!(number);
            let said = judged(changed).err().unwrap_or_else(|| panic!("taken, though: {place} {number}"));
            assert!(said.contains("impact 3 has numbers that no impact has"), "{said}");
        }
    }
}
