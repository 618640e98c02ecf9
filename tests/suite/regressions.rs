//! Past bugs, each as the smallest scene that shows it: symptom, cause, scene.

mod bends;
mod blades;
mod close;
mod cuts;
mod floors;
mod grids;
mod hooks;
mod kept;
mod leaves;
mod middles;
mod needles;
mod parting;
mod peers;
mod planes;
mod points;
mod rays;
mod recent;
mod ridges;
mod rims;
mod shapes;
mod skins;
mod slopes;
mod stale;
mod tipping;
mod turned;
mod wheels;

use asunder::{BodyKey3, Collider3, World3};
use asunder_geometry::tolerance::EVEN_DEPTH;
use asunder_geometry::{Cuboid, Hull, Pose3, Shape3};
use asunder_narrow::{Pair3, Separation3};
use glam::{DVec3, Quat, Vec3};

fn hull(points: &[[f32; 3]]) -> Shape3 {
    let points: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
    Hull::from_points(&points).unwrap().into()
}

fn separation(pair: &Pair3) -> f32 {
    match pair.separation(f32::INFINITY) {
        Separation3::Measured(measured) => measured.separation,
        Separation3::AtLeast(_) => panic!("there is no limit"),
    }
}

/// Symptom: two flat quads side by side, metres apart, were reported as overlapping. Cause: the four corners of a
/// rotated quad are coplanar only up to rounding; their hull has two antipodal faces, and no normal that shows a gap
/// within the plane.
#[test]
fn flat_quads_side_by_side_are_apart() {
    let corners = [
        [19.962526, 12.806735, 3.323101],
        [-5.968866, 13.98994, -9.552985],
        [-13.7152405, 13.523953, 6.0047646],
        [12.216152, 12.340749, 18.880852],
    ];
    let quad = hull(&corners);
    let along = Vec3::from(corners[1]).as_dvec3() - Vec3::from(corners[0]).as_dvec3();
    let there = Pose3::at(along * 1.1).unwrap();
    let pair = Pair3::new(&quad, &Pose3::IDENTITY, &quad, &there);
    assert!(!pair.overlaps());
    // A tenth of the side; the quad is a rectangle up to rounding.
    assert!((f64::from(separation(&pair)) - 0.1 * along.length()).abs() < 1e-3);
    let mut world = World3::new();
    world.insert(Collider3::new(quad.clone()));
    world.insert(Collider3::new(quad).at(there));
    world.update();
    assert!(world.events().is_empty());
}

/// Symptom: `overlaps` was false and `separation` negative. Cause: each had its own rule for which edge pairs give an
/// axis.
#[test]
fn ridges_a_hair_apart_have_one_answer() {
    let wedge = |up: f32| {
        let foot = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]].map(|[x, y]| [x, y, -up]);
        hull(&[[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]].as_slice(), &foot].concat())
    };
    let (below, above) = (wedge(1.0), wedge(-1.0));
    for angle in [0.0, 1e-9, 4.5e-9, 1e-8, 1e-6] {
        for gap in [-5e-9, 0.0, 5e-9, 1e-7] {
            let pose = Pose3::new(DVec3::new(0.0, 0.0, gap), Quat::from_xyzw(0.0, 0.0, angle, 1.0)).unwrap();
            let pair = Pair3::new(&below, &Pose3::IDENTITY, &above, &pose);
            assert_eq!(pair.overlaps(), separation(&pair) <= 0.0, "angle {angle}, gap {gap}");
            assert_eq!(pair.overlaps(), pair.distance().is_none(), "angle {angle}, gap {gap}");
        }
    }
}

/// Symptom: crates in a stack sank into each other by centimetres. Cause: boxes tilted by a hair touch where two edges
/// cross, in a single point; it jumped from corner to corner, and nothing can stand on that.
#[test]
fn a_slightly_tilted_box_stands_on_a_patch() {
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap());
    let mut on_edges = 0;
    for step in 1..40 {
        let (x, y, z) = (1e-4 * step as f32, 0.3, 7e-5 * (step * 7 % 11) as f32);
        let above = Pose3::new(DVec3::new(0.2, 0.998, -0.1), Quat::from_xyzw(x, y, z, 1.0)).unwrap();
        let manifold = Pair3::new(&cube, &Pose3::IDENTITY, &cube, &above).manifold(0.02).unwrap();
        assert!(manifold.points.len() >= 3, "step {step}: {} points", manifold.points.len());
        let area: Vec<Vec3> = manifold.points.iter().map(|point| point.anchor_a).collect();
        let doubled = (area[1] - area[0]).cross(area[2] - area[0]).length();
        assert!(doubled > 0.05, "step {step}: the points are all but in line");
        let deepest = manifold.points.iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
        // Of a patch with more than four corners, one that counts as deepest within the tolerance is kept.
        let even =
            if manifold.points.len() == 4 { 2.0 * EVEN_DEPTH as f32 * cube.outer_radius() } else { 0.0 };
        let (beyond, error) = (deepest - manifold.separation, manifold.error + 1e-6);
        assert!((-error..=error + even).contains(&beyond), "step {step}: {beyond}");
        // Neither box has a face with this normal: an edge pair decided the depth.
        let is_face = manifold.normal == Vec3::Y
            || above.basis().turn(DVec3::Y).dot(manifold.normal.as_dvec3()) > 1.0 - 1e-13;
        on_edges += usize::from(!is_face);
    }
    assert!(on_edges > 10, "only {on_edges} poses were decided by edges");
}

/// Symptom: `touching` named a body for which `is_touching` was false. Cause: only one of them checked that the body
/// still existed.
#[test]
fn a_removed_body_is_touched_by_nobody() {
    let mut world = World3::new();
    let cube = Cuboid::from_half_extents(Vec3::ONE).unwrap();
    let keys: Vec<BodyKey3> = (0..3).map(|_| world.insert(Collider3::new(cube))).collect();
    world.update();
    world.remove(keys[1]);
    assert_eq!(world.touching(keys[0]).collect::<Vec<_>>(), [keys[2]]);
    assert_eq!(world.contacts_of(keys[2]).count(), 1);
    assert!(!world.is_touching(keys[0], keys[1]) && world.contact(keys[0], keys[1]).is_none());
    assert_eq!(world.contacts().len(), 3, "the record of the last update stands until the next");
}
