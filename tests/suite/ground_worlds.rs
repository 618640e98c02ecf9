//! Worlds with meshes and height fields in them.

use asunder::glam::{DVec3, Quat, Vec2, Vec3};
use asunder::{
    Capsule3, Collider3, CompoundError, Cuboid, DebugOptions, Event, HeightField, Hull, MassError, Pose3,
    Shape3, Snapshot, Sphere, TriMesh, World3,
};

/// A floor of `cells` by `cells` cells of a metre, centred on the origin, cut along lines that are not straight.
fn floor(cells: u32) -> TriMesh {
    let row = cells + 1;
    let place = |i: u32| f64::from(i) - f64::from(cells) / 2.0;
    let vertex = |column: u32, line: u32| {
        let is_inner = !column.is_multiple_of(cells) && !line.is_multiple_of(cells);
        let aside = if is_inner { 0.3 * f64::from((column * 7 + line * 3) % 5) / 5.0 } else { 0.0 };
        DVec3::new(place(column) + aside, 0.0, place(line) - aside).as_vec3()
    };
    let vertices: Vec<Vec3> =
        (0..row).flat_map(|line| (0..row).map(move |column| vertex(column, line))).collect();
    let of_cell = |column: u32, line: u32| {
        let corner = line * row + column;
        [[corner, corner + row, corner + 1], [corner + 1, corner + row, corner + row + 1]]
    };
    let triangles: Vec<[u32; 3]> =
        (0..cells).flat_map(|line| (0..cells).flat_map(move |column| of_cell(column, line))).collect();
    TriMesh::new(vertices, triangles).unwrap()
}

fn field(cells: usize) -> HeightField {
    HeightField::new(cells + 1, cells + 1, vec![0.0; (cells + 1) * (cells + 1)], Vec2::ONE).unwrap()
}

/// Bodies that stand on a plane, and the heights of their positions above it.
fn bodies() -> Vec<(&'static str, Shape3, f64)> {
    let corners: Vec<Vec3> = (0..8)
        .map(|i| Vec3::new([-0.4, 0.4][i & 1], [-0.25, 0.25][i >> 1 & 1], [-0.3, 0.3][i >> 2]))
        .collect();
    vec![
        ("cuboid", Cuboid::from_half_extents(Vec3::new(0.4, 0.25, 0.3)).unwrap().into(), 0.25),
        ("hull", Hull::from_points(&corners).unwrap().into(), 0.25),
        ("sphere", Sphere::new(0.3).unwrap().into(), 0.3),
        ("capsule", Capsule3::from_half_height(0.4, 0.2).unwrap().into(), 0.6),
    ]
}

#[test]
fn ground_is_fixed_whatever_is_said() {
    let mut world = World3::new();
    let (one, other) = (world.insert(Collider3::new(floor(4))), world.insert(Collider3::new(field(4))));
    assert!(world.get(one).unwrap().is_fixed() && world.get(other).unwrap().is_fixed());
    world.update();
    assert_eq!(world.candidates().len(), 0, "ground never pairs with ground");
    world.set_shape(other, Sphere::new(1.0).unwrap()).unwrap();
    let ball = world.insert(Collider3::new(Sphere::new(1.0).unwrap()));
    assert!(!world.get(ball).unwrap().is_fixed());
    world.update();
    assert!(world.is_touching(one, ball));
    world.set_shape(ball, field(2)).unwrap();
    assert!(world.get(ball).unwrap().is_fixed());
    world.update();
    assert_eq!(world.contacts().len(), 0);
}

#[test]
fn a_crater_ends_what_lay_where_it_is_and_nothing_else() {
    let mut world = World3::new();
    let heights = |crater: f32| (0..81).map(|i| if i == 30 { -crater } else { 0.0 }).collect::<Vec<f32>>();
    let field = |crater: f32| HeightField::new(9, 9, heights(crater), Vec2::ONE).unwrap();
    let ground = world.insert(Collider3::new(field(0.0)).margin(0.01).unwrap());
    let ball = Collider3::new(Sphere::new(0.5).unwrap()).margin(0.01).unwrap();
    let feet = [[3.0, 0.5, 3.0], [6.0, 0.5, 6.0]].map(|place| Pose3::at(place).unwrap());
    let [over, aside] = feet.map(|pose| world.insert(ball.clone().at(pose)));
    world.update();
    assert_eq!(world.events().len(), 2);
    for (key, pose) in [over, aside].into_iter().zip(feet) {
        world.set_pose(key, pose.shifted(DVec3::Y * 0.005).unwrap()).unwrap();
    }
    world.update();
    assert_eq!(world.events(), [], "a margin is a hysteresis");
    world.set_shape(ground, field(2.0)).unwrap();
    world.update();
    let expected = Event::Ended { a: ground, b: over, user_data_a: 0, user_data_b: 0, sensor: false };
    assert_eq!(world.events(), [expected]);
    assert!(world.is_touching(ground, aside) && !world.contact(ground, aside).unwrap().overlapping);
}

#[test]
fn a_slide_over_hundreds_of_triangles_begins_once_and_ends_once() {
    let grounds: [(Shape3, DVec3); 2] =
        [(floor(24).into(), DVec3::ZERO), (field(24).into(), DVec3::new(-12.0, 0.0, -12.0))];
    for (ground, place) in grounds {
        for (name, shape, foot) in bodies() {
            let mut world = World3::new();
            let ground = world.insert(Collider3::new(ground.clone()).at(Pose3::at(place).unwrap()));
            let body = world.insert(Collider3::new(shape));
            let mut told = Vec::new();
            for step in 0..=300 {
                let way = -11.0 + 0.085 * f64::from(step);
                let place = DVec3::new(way, foot - 1e-3, 0.4 * way);
                let turned = Quat::from_rotation_y(0.3 + 0.01 * step as f32);
                world.set_pose(body, Pose3::new(place, turned).unwrap()).unwrap();
                world.update();
                told.extend(world.events().iter().map(|event| (step, matches!(event, Event::Began { .. }))));
                if let Some(contact) = world.contact(ground, body).filter(|_| step < 260) {
                    assert!(contact.overlapping && contact.manifolds.len() == 1, "{name} {step}");
                    let normal = contact.manifolds[0].normal;
                    assert!(
                        (normal - Vec3::NEG_Y).length() < 1e-6 || (normal - Vec3::Y).length() < 1e-6,
                        "{normal}"
                    );
                }
            }
            let [(0, true), (end, false)] = told[..] else { panic!("{name}: {told:?}") };
            assert!(end > 265, "{name}: {told:?}");
        }
    }
}

#[test]
fn a_snapshot_keeps_ground_once_and_has_the_same_future() {
    let mut world = World3::new();
    let (mesh, field) = (floor(12), field(12));
    let shapes: [Shape3; 5] = [
        mesh.clone().into(),
        mesh.clone().one_sided().into(),
        field.clone().into(),
        mesh.into(),
        field.into(),
    ];
    for (i, shape) in shapes.into_iter().enumerate() {
        world.insert(Collider3::new(shape).at(Pose3::at([0.0, -20.0 * i as f64, 0.0]).unwrap()));
    }
    let mut movers = Vec::new();
    for (i, (_, shape, foot)) in bodies().into_iter().enumerate() {
        let place = Pose3::at([2.0 * i as f64 - 4.0, foot - 1e-3, 0.1]).unwrap();
        movers.push(world.insert(Collider3::new(shape).at(place)));
    }
    world.update();
    let text = serde_json::to_string(&world.snapshot()).unwrap();
    assert_eq!(text.matches("\"triangles\":[[").count(), 2, "of two sides and of one");
    assert_eq!(text.matches("\"heights\":[").count(), 1);
    let snapshot: Snapshot<asunder::Volume> = serde_json::from_str(&text).unwrap();
    let mut restored = World3::restore(&snapshot).unwrap();
    for (key, body) in world.iter() {
        assert_eq!(restored.get(key).unwrap().shape(), body.shape());
        assert_eq!(restored.get(key).unwrap().is_fixed(), body.is_fixed());
    }
    for step in 0..40 {
        for world in [&mut world, &mut restored] {
            for (i, &key) in movers.iter().enumerate() {
                let now = world.get(key).unwrap().pose().position();
                let next = now + DVec3::new(0.11, 0.01 * (i as f64 - 1.5), 0.05);
                world.set_pose(key, Pose3::at(next).unwrap()).unwrap();
            }
            world.update();
        }
        let shown =
            |world: &World3| format!("{:?} {:?}", world.contacts().collect::<Vec<_>>(), world.events());
        assert_eq!(shown(&world), shown(&restored), "{step}");
    }
}

#[test]
fn every_edge_of_ground_is_drawn_once() {
    for (ground, triangles) in [(Shape3::from(floor(6)), 72), (field(6).into(), 72)] {
        let mut world = World3::new();
        world.insert(Collider3::new(ground));
        let mut lines = Vec::new();
        let options = DebugOptions { shapes: true, ..DebugOptions::default() };
        world.debug_lines(&options, &mut |from, to, _| lines.push((from, to)));
        // Three for each triangle; inner ones are shared by two triangles, those of the rim are not.
        assert_eq!(lines.len(), (3 * triangles + 24) / 2);
        assert!(lines.iter().all(|(from, to)| from.y == 0.0 && to.y == 0.0 && (*to - *from).length() < 2.0));
    }
}

#[test]
fn ground_is_no_part_and_has_no_mass() {
    let ground = Shape3::from(floor(2));
    assert_eq!(ground.mass_properties(1.0), Err(MassError::Ground));
    let ball: Shape3 = Sphere::new(1.0).unwrap().into();
    let refused = asunder::Compound3::new([(Pose3::IDENTITY, ball), (Pose3::IDENTITY, ground)]);
    assert_eq!(refused, Err(CompoundError::Ground { index: 1 }));
}
