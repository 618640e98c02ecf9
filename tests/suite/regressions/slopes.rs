//! Slopes that begin further along the same floor.

use asunder::{
    Chain, Circle, Collider2, Collider3, Motion2, Motion3, Polygon, Pose2, Pose3, Sphere, TriMesh, World2,
    World3,
};
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::f64::consts::SQRT_2;

const RADIUS: f64 = 0.125;

/// The ball's middle above the floor: it hovers a quarter of its radius over it.
const HEIGHT: f64 = 0.15625;

/// How far before the foot of the slope the ball is, how far it moves, and how far it gets until it touches a slope of
/// 45 degrees: its middle is then its radius from the slope, and so sqrt(2) times that above the slope's line.
fn runs() -> impl Iterator<Item = (f64, f64, f64)> {
    let starts = [0.1875, 0.25, 0.5, 1.0];
    starts.into_iter().flat_map(|before| {
        let way = before + HEIGHT - RADIUS * SQRT_2;
        // So far that the middle is behind the slope in the end.
        [0.375, 1.0, 3.0].map(|beyond| (before, before + HEIGHT + beyond, way))
    })
}

/// Symptom: the documentation promised that nothing passes a solver that lets no contact point close by more than its
/// separation. A ball on a chain or a mesh did, through a slope ahead. Cause: a contact on ground is with what the body
/// is opposite now, and at the foot of a slope the nearest point is a bend, which gives no normal. Bullets always
/// stopped at the slope; for others it has a contact now (below).
#[test]
fn bullets_stop_at_slopes_further_along_the_floor() {
    let floor = [[8.0, 8.0], [0.0, 0.0], [-8.0, 0.0]].map(Vec2::from);
    let corners = [[-8.0, 0.0], [0.0, 0.0], [8.0, 8.0]];
    let corners = corners.map(|[x, y]| [Vec3::new(x, y, -4.0), Vec3::new(x, y, 4.0)]);
    let mesh = TriMesh::new(corners.concat(), [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]]).unwrap();
    let chain = Chain::open(floor).unwrap();
    for (before, long, way) in runs() {
        for chain in [chain.clone(), chain.clone().one_sided()] {
            let mut world = World2::new();
            world.insert(Collider2::new(chain));
            let ball = Collider2::new(Circle::new(RADIUS as f32).unwrap()).bullet();
            let ball = world.insert(ball.at(Pose2::at(DVec2::new(-before, HEIGHT)).unwrap()));
            world.set_motion(ball, Motion2::shift(DVec2::X * long).unwrap()).unwrap();
            world.update();
            let [hit] = world.impacts() else { panic!("{before} {long}: {:?}", world.impacts()) };
            stops_in_time(hit.impact.fraction * long, way, hit.impact.error);
        }
        for mesh in [mesh.clone(), mesh.clone().one_sided()] {
            let mut world = World3::new();
            world.insert(Collider3::new(mesh));
            let ball = Collider3::new(Sphere::new(RADIUS as f32).unwrap()).bullet();
            let ball = world.insert(ball.at(Pose3::at(DVec3::new(-before, HEIGHT, 0.25)).unwrap()));
            world.set_motion(ball, Motion3::shift(DVec3::X * long).unwrap()).unwrap();
            world.update();
            let [hit] = world.impacts() else { panic!("{before} {long}: {:?}", world.impacts()) };
            stops_in_time(hit.impact.fraction * long, way, hit.impact.error);
        }
    }
}

/// The ball stops before it touches, no further from the slope than the error says.
fn stops_in_time(went: f64, way: f64, error: f32) {
    assert!(went <= way && (way - went) / SQRT_2 <= f64::from(error), "{went} of {way}, error {error}");
}

/// The contact that was missing: along the slope's normal, as far away as the ball is from the slope's plane.
#[test]
fn slopes_of_ground_further_along_the_floor_have_contacts() {
    let corners = [[-8.0, 0.0], [0.0, 0.0], [8.0, 8.0]];
    let corners = corners.map(|[x, y]| [Vec3::new(x, y, -4.0), Vec3::new(x, y, 4.0)]);
    let mesh = TriMesh::new(corners.concat(), [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]]).unwrap();
    let chain = Chain::open([[8.0, 8.0], [0.0, 0.0], [-8.0, 0.0]].map(Vec2::from)).unwrap();
    let is_slope = |normal: DVec3| (normal - DVec3::new(-1.0, 1.0, 0.0) / SQRT_2).length() < 1e-7;
    for (before, long, way) in runs() {
        let gap = way / SQRT_2;
        for chain in [chain.clone(), chain.clone().one_sided()] {
            let mut world = World2::new();
            let floor = world.insert(Collider2::new(chain));
            let ball = Collider2::new(Circle::new(RADIUS as f32).unwrap());
            let ball = world.insert(ball.at(Pose2::at(DVec2::new(-before, HEIGHT)).unwrap()));
            world.set_motion(ball, Motion2::shift(DVec2::X * long).unwrap()).unwrap();
            world.update();
            let contact = world.contact(floor, ball).unwrap();
            let slope =
                contact.manifolds.iter().find(|it| is_slope(it.normal.as_dvec2().extend(0.0))).unwrap();
            assert!((f64::from(slope.separation) - gap).abs() <= f64::from(slope.error), "{gap}: {slope:?}");
            // Without the motion only the floor is there.
            world.set_margin(ball, 4.0).unwrap();
            world.update();
            assert_eq!(world.contact(floor, ball).unwrap().manifolds.len(), 1);
        }
        for mesh in [mesh.clone(), mesh.clone().one_sided()] {
            let mut world = World3::new();
            let floor = world.insert(Collider3::new(mesh));
            let ball = Collider3::new(Sphere::new(RADIUS as f32).unwrap());
            let ball = world.insert(ball.at(Pose3::at(DVec3::new(-before, HEIGHT, 0.25)).unwrap()));
            world.set_motion(ball, Motion3::shift(DVec3::X * long).unwrap()).unwrap();
            world.update();
            let contact = world.contact(floor, ball).unwrap();
            let slope = contact.manifolds.iter().find(|it| is_slope(it.normal.as_dvec3())).unwrap();
            assert!((f64::from(slope.separation) - gap).abs() <= f64::from(slope.error), "{gap}: {slope:?}");
            world.set_margin(ball, 4.0).unwrap();
            world.update();
            assert_eq!(world.contact(floor, ball).unwrap().manifolds.len(), 1);
        }
    }
}

/// A slope that is a convex shape does have its speculative contact, whose normal is the way from the slope's foot to
/// the ball: a solver that heeds it cannot let the ball through.
#[test]
fn convex_slopes_further_along_the_floor_have_contacts() {
    for (before, long, _) in runs() {
        let mut world = World2::new();
        let slope = Polygon::new(&[[0.0, 0.0], [8.0, 0.0], [8.0, 8.0]].map(Vec2::from)).unwrap();
        let slope = world.insert(Collider2::new(slope).fixed());
        let start = DVec2::new(-before, HEIGHT);
        let ball = Collider2::new(Circle::new(RADIUS as f32).unwrap()).at(Pose2::at(start).unwrap());
        let ball = world.insert(ball);
        world.set_motion(ball, Motion2::shift(DVec2::X * long).unwrap()).unwrap();
        world.update();
        let contact = world.contact(slope, ball).unwrap();
        assert!(contact.speculative && contact.manifolds.len() == 1, "{contact:?}");
        let manifold = &contact.manifolds[0];
        let gap = start.length() - RADIUS;
        assert!((f64::from(manifold.separation) - gap).abs() <= f64::from(manifold.error), "{manifold:?}");
        let off = manifold.normal.as_dvec2() - start.normalize();
        assert!(off.length() <= f64::from(f32::EPSILON), "{manifold:?}");
    }
}
