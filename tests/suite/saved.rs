//! Stored values come back in every bit, and invalid shapes are rejected.

use asunder::{
    Capsule3, Collider2, Collider3, Compound3, Cuboid, DebugOptions, Event3, Filter3, Hull, Layers, Polygon,
    Pose2, Pose3, Ray2, Ray3, Rotation2, Shape3, Sphere, Walk3, World3,
};
use asunder_narrow::{Batch2, Batch3, Feature, FeatureId, Hint, Job2, Job3, collide2, collide3};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};
use glam::{DVec3, Quat, Vec2, Vec3};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Asserts that a value comes back. `Debug` prints every number so that it reads back as the same bits, including signs
/// of zeros.
fn assert_comes_back<T: Serialize + DeserializeOwned + core::fmt::Debug>(value: &T) -> T {
    let text = serde_json::to_string(value).unwrap();
    let back: T = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_eq!(format!("{back:?}"), format!("{value:?}"), "{text}");
    // Through a tree of values, as formats that buffer do.
    let tree: T = serde_json::from_value(serde_json::to_value(value).unwrap()).unwrap();
    assert_eq!(serde_json::to_string(&tree).unwrap(), text);
    back
}

fn refusal<T: DeserializeOwned + core::fmt::Debug>(value: Value) -> String {
    serde_json::from_value::<T>(value).expect_err("this must be refused").to_string()
}

#[test]
fn poses_and_rays_come_back_in_every_bit() {
    let random = &mut Random::new(700);
    for round in 0..2000 {
        let far = random.pick(&[1.0, 1e-300, 1e9, 0.0, -0.0, 1e-5]);
        let at = random.vector() * far;
        let pose = assert_comes_back(&Pose3::new(at, random.quaternion()).unwrap());
        assert!(pose.same_bits(&pose) && pose.position().x.to_bits() == at.x.to_bits());
        let rotation = random.rotation2();
        assert_comes_back(&rotation);
        assert_comes_back(&Pose2::new(at.truncate(), rotation).unwrap());
        assert_comes_back(&Ray3::new(at, random.direction().as_vec3() * 1e-30).unwrap());
        assert_comes_back(&Ray2::new(at.truncate(), random.direction2().as_vec2()).unwrap());
        // Rotations made from any numbers, including tiny ones and axes.
        let (c, s) = (random.signed() as f32, random.pick(&[1e-45_f32, 0.0, -0.0, 1e38, 1e-4]));
        if round % 2 == 0 || c != 0.0 {
            assert_comes_back(&Rotation2::new(c, s).unwrap());
            assert_comes_back(&Rotation2::new(s, c).unwrap());
        }
    }
    assert_comes_back(&Pose3::new(DVec3::ZERO, Quat::from_xyzw(-0.0, 1e-45, f32::MAX, 1.0)).unwrap());
}

#[test]
fn every_kind_of_shape_comes_back_in_every_bit() {
    let random = &mut Random::new(701);
    for round in 0..200 {
        let size = [1.0, 1e-5, 1e5][round % 3];
        for (name, kind) in KINDS3 {
            let shape = kind(&mut Clay::new(random, size));
            let back = assert_comes_back(&shape);
            assert_eq!(back, shape, "{name}");
            let at = Pose3::new(random.vector(), random.quaternion()).unwrap();
            assert_eq!(back.bounds(&at, 0.1), shape.bounds(&at, 0.1), "{name}");
        }
        for (name, kind) in KINDS2 {
            let shape = kind(&mut Clay::new(random, size));
            assert_eq!(assert_comes_back(&shape), shape, "{name}");
        }
    }
}

/// Answers of a batch are equal in every bit for shapes, and for the same shapes stored and loaded.
#[test]
fn loaded_shapes_give_equal_answers() {
    let random = &mut Random::new(702);
    let stored = |shape: &Shape3| assert_comes_back(shape);
    for _ in 0..300 {
        let [a, b] = [(); 2].map(|()| KINDS3[random.below(KINDS3.len())].1(&mut Clay::thick(random)));
        let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::new(random.vector(), random.quaternion()).unwrap());
        let answers = |a: &Shape3, b: &Shape3| {
            let (mut batch, hint) = (Batch3::default(), Hint::NONE);
            let job = Job3 {
                shape_a: a,
                pose_a: &pose_a,
                shape_b: b,
                pose_b: &pose_b,
                margin: 0.2,
                hint,
                ahead: 0.0,
                sensor: false,
            };
            collide3(&[job], &mut batch);
            format!("{batch:?}")
        };
        assert_eq!(answers(&a, &b), answers(&stored(&a), &stored(&b)));
    }
}

#[test]
fn polygons_of_every_make_come_back() {
    let random = &mut Random::new(703);
    for round in 0..400 {
        let count = 3 + random.below(60);
        let points: Vec<Vec2> = (0..count).map(|_| random.direction2().as_vec2() * 3.0).collect();
        let limit = 3 + round % 9;
        for polygon in [Polygon::hull_of(&points), Polygon::simplify(&points, limit)].into_iter().flatten() {
            let rounded = polygon.rounded(0.25).unwrap();
            let back = assert_comes_back(&rounded);
            assert_eq!((back.error(), back.radius()), (rounded.error(), 0.25));
        }
    }
}

#[test]
fn hints_and_manifolds_come_back_and_hints_made_up_do_no_harm() {
    let random = &mut Random::new(704);
    let mut known = 0;
    for round in 0..3000 {
        let [a, b] = [(); 2].map(|()| KINDS3[random.below(KINDS3.len())].1(&mut Clay::thick(random)));
        let (here, there) = (Pose3::IDENTITY, Pose3::new(random.vector(), random.quaternion()).unwrap());
        let collided = |hint: Hint| {
            let mut batch = Batch3::default();
            let (shape_a, shape_b) = (&a, &b);
            let job = Job3 {
                shape_a,
                pose_a: &here,
                shape_b,
                pose_b: &there,
                margin: 0.2,
                hint,
                ahead: 0.0,
                sensor: false,
            };
            collide3(&[job], &mut batch);
            batch
        };
        let batch = collided(Hint::NONE);
        for manifold in &batch.manifolds {
            assert_comes_back(manifold);
        }
        let hint = hint_of(&batch.answers[0]);
        assert_eq!(assert_comes_back(&hint), hint);
        known += usize::from(hint != Hint::NONE);
        let forged = forge(serde_json::to_value(hint).unwrap(), random);
        let Ok(forged) = Hint::deserialize(forged) else { continue };
        let with_forged = collided(forged);
        let touches = |batch: &Batch3| {
            matches!(batch.answers[0], asunder_narrow::Answer::Contact { overlapping: true, .. })
        };
        assert_eq!(touches(&with_forged), touches(&batch), "round {round}: {forged:?}");
    }
    assert!(known > 1500, "{known}");
    for _ in 0..1000 {
        let [a, b] = [(); 2].map(|()| KINDS2[random.below(KINDS2.len())].1(&mut Clay::thick(random)));
        let there = Pose2::new(random.vector().truncate(), random.rotation2()).unwrap();
        let collided = |hint: Hint| {
            let mut batch = Batch2::default();
            let job = Job2 {
                shape_a: &a,
                pose_a: &Pose2::IDENTITY,
                shape_b: &b,
                pose_b: &there,
                margin: 0.2,
                hint,
                ahead: 0.0,
                sensor: false,
            };
            collide2(&[job], &mut batch);
            batch
        };
        let batch = collided(Hint::NONE);
        for manifold in &batch.manifolds {
            assert_comes_back(manifold);
        }
        let hint = hint_of(&batch.answers[0]);
        if let Ok(forged) = Hint::deserialize(forge(serde_json::to_value(hint).unwrap(), random)) {
            assert_eq!(collided(forged).answers.len(), 1);
        }
    }
    let id = FeatureId::new(Feature::Face(3), Feature::Edge(77));
    assert_eq!(assert_comes_back(&id), id);
}

fn hint_of(answer: &asunder_narrow::Answer) -> Hint {
    match answer {
        asunder_narrow::Answer::Apart { hint, .. } | asunder_narrow::Answer::Contact { hint, .. } => *hint,
    }
}

/// The same tree with other numbers: any 32 bits, or small ones.
fn forge(mut value: Value, random: &mut Random) -> Value {
    fn walk(value: &mut Value, random: &mut Random) {
        match value {
            Value::Number(_) => {
                let bits = random.below(1 << 32) as u32;
                *value =
                    json!(random.pick(&[bits, bits % 40, bits & 0x4000_00FF, bits | 0x8000_0000, u32::MAX]));
            }
            Value::Array(list) => list.iter_mut().for_each(|value| walk(value, random)),
            Value::Object(map) => map.values_mut().for_each(|value| walk(value, random)),
            _ => {}
        }
    }
    walk(&mut value, random);
    value
}

#[test]
fn what_constructors_refuse_is_refused_with_what_they_say() {
    for (value, says) in [
        (json!({"position": [0.0, null, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]}), "null"),
        (json!({"position": [0.0, 2e9, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]}), "on axis 1 is beyond"),
        (json!({"position": [0.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 0.0]}), "the rotation is zero"),
        (json!({"position": [0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]}), "length 2"),
        (json!({"position": [0.0, 0.0, 0.0]}), "missing field `rotation`"),
        (
            json!({"position": [0.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1e39]}),
            "rotation component 3 is inf",
        ),
    ] {
        let said = refusal::<Pose3>(value);
        assert!(said.contains(says), "{said}");
    }
    let said = refusal::<Rotation2>(json!({"cos": 2.0, "sin": 0.0}));
    assert!(said.contains("not of length 1"), "{said}");
    let ball = json!({"Sphere": {"radius": 0.5}});
    let place = json!({"position": [0.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]});
    let nested = json!({"Compound": {"parts": [{"pose": place, "shape": ball}]}});
    for (value, says) in [
        (json!({"Sphere": {"radius": -1.0}}), "negative"),
        (json!({"Sphere": {"radius": 1.0, "diameter": 2.0}}), "unknown field"),
        (json!({"Ball": {"radius": 1.0}}), "unknown variant"),
        (json!({"Cuboid": {"half_extents": [1.0, 0.0, 1.0]}}), "on axis 1 is not positive"),
        (json!({"Cuboid": {"half_extents": [1.0, 1.0, 1.0], "radius": 1e7}}), "beyond"),
        (json!({"Capsule": {"ends": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], "radius": 1.0}}), "same point"),
        (json!({"Triangle": {"vertices": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]}}), "one line"),
        (json!({"HalfSpace": {"normal": [0.0, 0.0, 0.0]}}), "direction is zero"),
        (json!({"Hull": {"vertices": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], "faces": [[0, 9]]}}), "stored hull"),
        (json!({"Compound": {"parts": []}}), "needs a part"),
        (json!({"Compound": {"parts": [{"pose": place, "shape": nested}]}}), "unknown variant `Compound`"),
        (
            json!({"Compound": {"parts": [{"pose": place, "shape": {"HalfSpace": {"normal": [0.0, 1.0, 0.0]}}}]}}),
            "unknown",
        ),
    ] {
        let said = refusal::<Shape3>(value);
        assert!(said.contains(says), "{said}");
    }
    for (vertices, says) in [
        (json!([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]), "line between its neighbours"),
        (json!([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]), "clockwise"),
    ] {
        let said = refusal::<Polygon>(json!({ "vertices": vertices }));
        assert!(said.contains(says), "{said}");
    }
}

/// Each number of a stored hull in turn is changed: it is rejected, or gives a hull that works.
#[test]
fn a_hull_with_a_number_changed_is_refused_or_sound() {
    let random = &mut Random::new(705);
    let (mut refused, mut taken) = (0, 0);
    for round in 0..60 {
        let points: Vec<Vec3> = (0..6 + round % 20).map(|_| random.vector().as_vec3()).collect();
        let hull = Hull::from_points(&points).unwrap();
        let tree = serde_json::to_value(&hull).unwrap();
        for _ in 0..60 {
            let mut changed = tree.clone();
            let (key, other) =
                random.pick(&[("vertices", 1e-7), ("vertices", 0.5), ("faces", 1.0), ("error", 1.0)]);
            let number = match key {
                "error" => &mut changed[key],
                _ => {
                    let list = changed[key].as_array_mut().unwrap();
                    let place = random.below(list.len());
                    let inner = list[place].as_array_mut().unwrap();
                    let place = random.below(inner.len());
                    &mut inner[place]
                }
            };
            *number = match key {
                "faces" => json!((number.as_u64().unwrap() + 1 + random.below(4) as u64) % 300),
                _ => json!(number.as_f64().unwrap() + other * random.signed()),
            };
            match serde_json::from_value::<Hull>(changed) {
                Err(_) => refused += 1,
                Ok(hull) => {
                    taken += 1;
                    assert!(hull.contains(hull.center().as_dvec3()) || hull.planarity_error() > 0.0);
                    assert!(hull.planarity_error() <= 1e-5 * hull.outer_radius());
                }
            }
        }
    }
    assert!(refused > 1000 && taken > 300, "{refused} refused, {taken} taken");
}

#[test]
fn bodies_come_back_and_may_leave_out_what_is_as_usual() {
    let body: Collider3 = serde_json::from_value(json!({"shape": {"Sphere": {"radius": 0.5}}})).unwrap();
    assert_eq!(body, Collider3::new(Sphere::new(0.5).unwrap()));
    let ledge: Collider2 = serde_json::from_value(json!({
        "shape": {"Rect": {"half_extents": [4.0, 0.5]}}, "fixed": true, "margin": 0.1, "user_data": u64::MAX
    }))
    .unwrap();
    assert!(ledge.is_fixed() && ledge.get_margin() == 0.1 && ledge.get_user_data() == u64::MAX);
    assert_comes_back(&ledge.owner(9).layers(Layers { member_of: 2, collides_with: 3 }));
    let said = refusal::<Collider3>(json!({"shape": {"Sphere": {"radius": 0.5}}, "margin": -1.0}));
    assert!(said.contains("margin -1"), "{said}");
}

#[test]
fn keys_and_events_come_back() {
    let mut world = World3::new();
    let capsule = Capsule3::from_half_height(0.5, 0.5).unwrap();
    let compound = Compound3::new([(Pose3::IDENTITY, capsule.into())]).unwrap();
    let a = world.insert(Collider3::new(compound).user_data(4));
    let b = world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE).unwrap()));
    world.update();
    assert_eq!((assert_comes_back(&a), assert_comes_back(&b)), (a, b));
    let events: Vec<Event3> = assert_comes_back(&world.events().to_vec());
    assert_eq!(events, world.events());
}

#[test]
fn answers_and_walks_come_back() {
    let mut world = World3::new();
    let unit = Cuboid::from_half_extents(Vec3::ONE).unwrap();
    world.insert(Collider3::new(unit).fixed());
    let (ball, above) = (Shape3::from(Sphere::new(0.1).unwrap()), Pose3::at([0.3, 1.7, 0.0]).unwrap());
    let (at, filter, down) = ((&ball, &above), Filter3::new(), Vec3::NEG_Y * 3.0);
    let ray = Ray3::new(above.position(), down).unwrap();
    assert_comes_back(&world.cast_ray(&ray, 1.0, &filter).unwrap());
    assert_comes_back(&world.cast_shape(at, down, &filter).unwrap());
    assert_comes_back(&world.closest_to_shape(at, 1.0, &filter).unwrap());
    let walk = assert_comes_back(&Walk3 { step: 0.1, ..Walk3::new(&ball, Vec3::Y).unwrap() });
    let slide = world.move_and_slide(at, down, &walk, &filter);
    assert_comes_back(&slide.ground.unwrap());
    assert_comes_back(&world.footing(&slide, &walk).unwrap());
    assert_comes_back(&world.depenetrate((&ball, &Pose3::at([0.3, 0.9, 0.0]).unwrap()), &filter));
    assert_comes_back(&DebugOptions { columns: true, ..DebugOptions::default() });
}
