//! Contact points on ground that are moved along.

use asunder::{BodyKey3, Collider3, ContactPoint3, World3};
use asunder_geometry::{Capsule3, Cuboid, Pose3, Shape3, TriMesh};
use asunder_narrow::Feature;
use glam::{DVec3, Quat, Vec3};

/// A floor y = 0 for x < 0, whose rim is the z axis.
fn floor() -> TriMesh {
    let corners = [[-5.0, 0.0, -5.0], [-5.0, 0.0, 5.0], [0.0, 0.0, 5.0], [0.0, 0.0, -5.0]];
    TriMesh::new(corners.map(Vec3::from), [[0, 1, 2], [0, 2, 3]]).unwrap()
}

/// The only contact point, and its ends on the floor and on the body, in the world.
fn ends(world: &World3, floor: BodyKey3, body: BodyKey3) -> (ContactPoint3, DVec3, DVec3) {
    let contact = world.contact(floor, body).unwrap();
    assert_eq!((contact.a, contact.manifolds.len()), (floor, 1));
    let point = contact.manifolds[0].points[0];
    let at = |key: BodyKey3, anchor: Vec3| world.get(key).unwrap().pose().position() + anchor.as_dvec3();
    (point, at(floor, point.anchor_a), at(body, point.anchor_b))
}

/// Symptom: a point where an edge of a body crosses an edge of ground was moved along with the body's matter. Its
/// separation was right, but its end on ground floated some millimetres above the ground, up to 3 % of the body's radius.
/// Cause: where two edges cross moves along both of them.
#[test]
fn a_point_where_edges_cross_stays_on_both() {
    // Along the rim but for a quarter, and rising.
    let along = Vec3::new(0.25, 0.6, 1.0);
    let radius = 0.1;
    let rod = Capsule3::new(along * -0.5, along * 0.5, radius).unwrap();
    let furthest = f64::from(Shape3::from(rod).outer_radius()) / 256.0;
    let (start, turn) = (DVec3::new(-0.02, 0.5, 0.0), Quat::from_xyzw(0.0, 0.0, 1e-4, 1.0));
    for (way, turn) in
        [(DVec3::X, Quat::IDENTITY), (DVec3::new(0.5, 0.2, -0.3), Quat::IDENTITY), (DVec3::X, turn)]
    {
        let mut world = World3::new();
        let floor = world.insert(Collider3::new(floor()));
        let body = world.insert(Collider3::new(rod).margin(0.5).unwrap().at(Pose3::at(start).unwrap()));
        world.update();
        let (first, ..) = ends(&world, floor, body);
        assert!(matches!([first.feature.a(), first.feature.b()], [Feature::Edge(_), Feature::Edge(_)]));
        for step in 1..8 {
            let position = start + way * (f64::from(step) / 8.0 * furthest);
            world.set_pose(body, Pose3::new(position, turn).unwrap()).unwrap();
            world.update();
            let (point, on_floor, on_body) = ends(&world, floor, body);
            // On the rim, which is the z axis.
            assert!(DVec3::new(on_floor.x, on_floor.y, 0.0).length() < 2e-6, "step {step}: {on_floor}");
            // A radius off the rod's axis.
            let axis = world.get(body).unwrap().pose().turn(along.as_dvec3().normalize());
            let beside = (on_body - position).reject_from_normalized(axis).length();
            assert!((beside - f64::from(radius)).abs() < 2e-6, "step {step}: {beside}");
            // As far apart as it says.
            let apart = (on_body - on_floor).length();
            assert!((apart - f64::from(point.separation)).abs() < 2e-6, "step {step}: {apart}");
        }
    }
}

/// Symptom: a crossing beside a corner of ground stayed on the body again. Cause: how far it may slide along the body's
/// edge was bounded by how near the ends of the ground's edge are.
#[test]
fn a_crossing_beside_a_corner_of_ground_slides_too() {
    // A low roof, whose ridge is the z axis; it has a corner at the origin.
    let row = |x: f32| [-4.0, 0.0, 4.0].map(|z| Vec3::new(x, -0.01 * x.abs(), z));
    let corners = [row(-4.0), row(0.0), row(4.0)].concat();
    let cell = |at: u32| [[at, at + 1, at + 3], [at + 3, at + 1, at + 4]];
    let roof = TriMesh::new(corners, [cell(0), cell(1), cell(3), cell(4)].concat()).unwrap();
    // The cosine and the sine of 20 degrees: the cube is turned by twice as much about y.
    let turn = Quat::from_xyzw(0.0, 0.342_020_14, 0.0, 0.939_692_6);
    for gap in [0.1, 1e-3, 1e-4, 1e-6] {
        let mut world = World3::new();
        let ground = world.insert(Collider3::new(roof.clone()));
        let cube = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap()).margin(0.02).unwrap();
        // An edge of its lower face crosses the ridge that far beyond the corner.
        let start = DVec3::new(0.0, 0.4999, 0.5 / 0.766_044_443_118_978 + gap);
        let body = world.insert(cube.at(Pose3::new(start, turn).unwrap()));
        // What is kept is made in the second update.
        for way in [0.0, 1e-6, 0.003] {
            world.set_pose(body, Pose3::new(start + DVec3::X * way, turn).unwrap()).unwrap();
            world.update();
        }
        let contact = world.contact(ground, body).unwrap();
        let points = contact.manifolds.iter().flat_map(|manifold| &manifold.points);
        let crossings = points.filter(|point| matches!(point.feature.a(), Feature::Edge(_)));
        let off = crossings.map(|point| Vec3::new(point.anchor_a.x, point.anchor_a.y, 0.0).length());
        assert!(off.fold(0.0, f32::max) < 2e-6, "{gap}: {contact:?}");
        assert!(
            contact
                .manifolds
                .iter()
                .flat_map(|of| &of.points)
                .any(|at| matches!(at.feature.a(), Feature::Edge(_)))
        );
    }
}
