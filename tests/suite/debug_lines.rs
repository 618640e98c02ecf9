//! Debug lines lie on what they show.

mod options;
mod outlines;

use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{Collider2, Collider3, DebugLine, DebugOptions, Pair3, Pose2, Pose3, Shape3, World2, World3};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};

const SHAPES: DebugOptions = DebugOptions {
    shapes: true,
    boxes: false,
    columns: false,
    contacts: false,
    normals: false,
    length: 0.2,
    endless: 20.0,
};

/// Every line of an outline starts and ends in its body's AABB, and together they are nearly as wide: arcs are drawn as
/// chords.
#[test]
fn outlines_are_as_wide_as_their_boxes() {
    let mut random = Random::new(900);
    for (name, make) in KINDS3.iter().take(KINDS3.len() - 1) {
        for _ in 0..20 {
            let shape = make(&mut Clay::new(&mut random, 1.0));
            let pose = Pose3::new(random.vector() * 10.0, random.quaternion()).unwrap();
            let radius = match &shape {
                Shape3::Compound(it) => {
                    it.parts().iter().fold(0.0, |most, part| part.shape().radius().max(most))
                }
                _ => shape.radius(),
            };
            let (bounds, radius) = (shape.bounds(&pose, 0.0), f64::from(radius));
            let mut world = World3::new();
            world.insert(Collider3::new(shape).at(pose));
            let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            world.debug_lines(&SHAPES, &mut |from, to, what| {
                assert_eq!(what, DebugLine::Body);
                (low, high) = (low.min(from).min(to), high.max(from).max(to));
            });
            // AABBs are f32, rounded outwards at their position; a flat hull may be a point.
            let slack = 1e-5 * (high - low).length() + 1e-6 * pose.position().length();
            assert!(
                low.cmpge(bounds.min.as_dvec3() - slack).all()
                    && high.cmple(bounds.max.as_dvec3() + slack).all(),
                "{name}"
            );
            // Chords of a thirty-second of a circle; and for a rounded corner only the arcs along its edges are drawn,
            // not the cap.
            let missing = (bounds.max - bounds.min).as_dvec3() - (high - low);
            let caps = if matches!(*name, "sphere" | "capsule") { 0.6 } else { 2.0 } * radius;
            assert!(missing.max_element() <= caps + slack, "{name}: {missing}, radius {radius}");
        }
    }
}

#[test]
fn outlines_in_the_plane_are_as_wide_as_their_boxes() {
    let mut random = Random::new(901);
    for (name, make) in KINDS2.iter().take(KINDS2.len() - 1) {
        for _ in 0..20 {
            let shape = make(&mut Clay::new(&mut random, 1.0));
            let pose = Pose2::new(random.vector().truncate() * 10.0, random.rotation2()).unwrap();
            let bounds = shape.bounds(&pose, 0.0);
            let mut world = World2::new();
            world.insert(Collider2::new(shape).at(pose));
            let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
            world.debug_lines(&SHAPES, &mut |from, to, _| {
                (low, high) = (low.min(from).min(to), high.max(from).max(to));
            });
            let slack = 1e-5 * (high - low).length();
            assert!(
                low.cmpge(bounds.min.as_dvec2() - slack).all()
                    && high.cmple(bounds.max.as_dvec2() + slack).all(),
                "{name}"
            );
            let missing = (bounds.max - bounds.min).as_dvec2() - (high - low);
            assert!(missing.max_element() <= 0.05 * (high - low).max_element() + slack, "{name}: {missing}");
        }
    }
}

#[test]
fn crosses_and_normals_stand_where_bodies_touch() {
    let mut random = Random::new(902);
    let (mut crosses, mut normals) = (0, 0);
    for _ in 0..50 {
        let make = |random: &mut Random| {
            let kind = random.below(KINDS3.len() - 1);
            let pose = Pose3::new(random.vector(), random.quaternion()).unwrap();
            Collider3::new(KINDS3[kind].1(&mut Clay::new(random, 1.0))).at(pose)
        };
        let bodies = [make(&mut random), make(&mut random)];
        let mut world = World3::new();
        world.insert_many(bodies.iter().cloned());
        world.update();
        let distance = |point: DVec3| {
            let dot = asunder::Sphere::new(1e-6).unwrap().into();
            let at = Pose3::at(point).unwrap();
            bodies.each_ref().map(|body| {
                Pair3::new(&dot, &at, body.shape(), body.pose())
                    .distance()
                    .map_or(0.0, |found| found.distance)
            })
        };
        let deepest =
            world.contacts().flat_map(|contact| contact.manifolds).fold(0.0, |most: f32, manifold| {
                manifold.points.iter().fold(most, |most, point| most.max(point.separation.abs()))
            });
        let options = DebugOptions { shapes: false, ..DebugOptions::default() };
        world.debug_lines(&options, &mut |from, to, what| match what {
            DebugLine::Contact => {
                crosses += 1;
                assert!(((to - from).length() - 0.05).abs() < 1e-6);
                let [a, b] = distance((from + to) / 2.0);
                assert!(a.max(b) <= deepest + 1e-4, "{a} {b}, {deepest} deep");
            }
            DebugLine::Normal => {
                normals += 1;
                assert!(((to - from).length() - 0.2).abs() < 1e-6);
            }
            other => panic!("{other:?} was not asked for"),
        });
    }
    assert!(crosses > 50 && crosses == 2 * normals, "{crosses} arms, {normals} normals");
}

/// Every box inside a column's drawn bounds is counted in it, and nothing further than a rounding away.
#[test]
fn columns_are_drawn_where_their_boxes_are() {
    let mut random = Random::new(902);
    let (mut world, mut flat) = (World3::new(), World2::new());
    for _ in 0..600 {
        let place = random.vector() * 50.0;
        let ball = asunder::Sphere::new(0.5).unwrap();
        world.insert(Collider3::new(ball).at(Pose3::at(place).unwrap()));
        let disc = asunder::Circle::new(0.5).unwrap();
        flat.insert(Collider2::new(disc).at(Pose2::at(place.truncate()).unwrap()));
    }
    world.update();
    flat.update();
    let options = DebugOptions { shapes: false, boxes: true, columns: true, ..DebugOptions::default() };
    let (mut boxes, mut columns) = (0, vec![]);
    world.debug_lines(&options, &mut |from, to, what| match what {
        DebugLine::Box => boxes += 1,
        DebugLine::Column => columns.push((from, to)),
        _ => {}
    });
    assert!(boxes == 12 * 600 && columns.len() > 12 && columns.len().is_multiple_of(12), "{}", columns.len());
    // One axis is swept: all columns extend along it from end to end, and so far that nearly all boxes are inside.
    let all = columns.iter().flat_map(|&(from, to)| [from, to]);
    let (low, high) =
        all.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), end| (low.min(end), high.max(end)));
    assert!((high - low).min_element() > 90.0 && (high - low).max_element() < 130.0, "{low} {high}");
    let mut strips = 0;
    flat.debug_lines(&options, &mut |_, _, what| strips += usize::from(what == DebugLine::Column));
    assert!(strips > 4 && strips.is_multiple_of(4), "{strips}");
}

#[test]
fn what_is_disabled_is_not_drawn_and_half_spaces_are_finite() {
    let mut world = World3::new();
    world.insert(Collider3::new(asunder::Sphere::new(1.0).unwrap()).disabled());
    let ground = Collider3::new(asunder::HalfSpace::new(Vec3::Y).unwrap()).fixed();
    world.insert(ground);
    let mut flat = World2::new();
    flat.insert(Collider2::new(asunder::HalfPlane::new(Vec2::Y).unwrap()).sensor());
    world.update();
    flat.update();
    let options = DebugOptions { boxes: true, ..DebugOptions::default() };
    let (mut solid, mut plane) = (vec![], vec![]);
    world.debug_lines(&options, &mut |from, to, what| solid.extend([(from, what), (to, what)]));
    flat.debug_lines(&options, &mut |from, to, what| plane.extend([(from, what), (to, what)]));
    assert_eq!((solid.len(), plane.len()), (14, 4));
    assert!(solid.iter().all(|(end, what)| end.abs().max_element() <= 20.0 && *what == DebugLine::Fixed));
    assert!(plane.iter().all(|(end, what)| end.abs().max_element() <= 20.0 && *what == DebugLine::Sensor));
}
