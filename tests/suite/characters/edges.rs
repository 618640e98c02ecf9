//! What is reported to a character that is stopped: at edges, and in corners between slopes and walls.

use super::stage::{Hero, cosine, cuboid, is_free, sine};
use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Circle, Collider2, Collider3, Compound3, Filter2, Filter3, HalfPlane, HalfSpace,
    Hull, Pose2, Pose3, Rect, Shape2, Shape3, Sphere, TriMesh, Walk2, Walk3, World2, World3,
};

/// A box whose top is at y = 0.5, and whose side is at x = 0.5.
fn block() -> World3 {
    let mut world = World3::new();
    world.insert(Collider3::new(cuboid([1.0, 0.5, 2.0])).at(Pose3::at([1.5, 0.0, 0.0]).unwrap()).fixed());
    world
}

fn thin_person() -> Shape3 {
    Capsule3::from_half_height(0.6, 0.3).unwrap().into()
}

/// Symptom: a character that fell past the edge of a box hung in the air beside it for good, and no ground or wall was
/// reported. Cause: the edge stopped the fall, as one to stand on, and was too far down the motion to be found as
/// ground.
#[test]
fn who_falls_on_an_edge_stands_on_it_or_falls_past() {
    let world = block();
    let mut seen = [0, 0];
    for place in 0..240 {
        let x = 0.19 + 0.0005 * f64::from(place);
        let mut hero = Hero::new(&world, thin_person(), [x, 1.5, 0.0]);
        let (mut fall, mut stood) = (0.0_f32, false);
        for frame in 0..150 {
            fall -= 9.81 / 60.0;
            let slide = hero.step([0.0, fall / 60.0, 0.0]);
            assert!(slide.ground.is_some() || slide.moved.y < 0.0, "{x}, frame {frame}: {slide:?}");
            stood = slide.ground.is_some();
            if stood {
                fall = 0.0;
            }
        }
        seen[usize::from(stood)] += 1;
        assert!(stood || hero.feet().y < -5.0, "{x}: {}", hero.feet());
    }
    assert!(seen.iter().all(|&count| count > 10), "{seen:?}");
}

/// The same in the plane.
#[test]
fn who_falls_on_an_edge_in_the_plane_stands_on_it_or_falls_past() {
    let mut world = World2::new();
    let block = Rect::from_half_extents(Vec2::new(1.0, 0.5)).unwrap();
    world.insert(Collider2::new(block).at(Pose2::at([1.5, 0.0]).unwrap()).fixed());
    let hero = Shape2::from(Capsule2::from_half_height(0.6, 0.3).unwrap());
    let walk = Walk2::new(&hero, Vec2::Y).unwrap();
    for place in 0..240 {
        let x = 0.19 + 0.0005 * f64::from(place);
        let (mut pose, mut fall) = (Pose2::at([x, 2.4]).unwrap(), 0.0_f32);
        for frame in 0..150 {
            fall -= 9.81 / 60.0;
            let slide = world.move_and_slide((&hero, &pose), Vec2::Y * (fall / 60.0), &walk, &Filter2::new());
            assert!(slide.ground.is_some() || slide.moved.y < 0.0, "{x}, frame {frame}: {slide:?}");
            if slide.ground.is_some() {
                fall = 0.0;
            }
            pose = slide.pose;
        }
    }
}

/// Symptom: a character that jumped against a ledge was held by it, and nothing was reported.
#[test]
fn what_is_not_gone_is_explained() {
    let world = block();
    let mut seen = [0, 0];
    for height in 0..100 {
        for rise in [-0.05, -0.01, 0.01, 0.05] {
            for run in [0.02, 0.08] {
                let mut hero = Hero::new(&world, thin_person(), [0.19, 0.01 * f64::from(height) - 0.2, 0.0]);
                let asked = Vec3::new(run, rise, 0.0);
                let slide = hero.step(asked);
                let lost = (slide.moved - asked.as_dvec3()).length();
                let is_told = slide.ground.is_some() || !slide.walls.is_empty();
                assert!(lost < 1e-6 || is_told, "{height} {asked}: {slide:?}");
                seen[usize::from(lost > 1e-3)] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}

/// Symptom: a character that pressed against a wall by less than its skin per frame was held, and no wall was reported.
#[test]
fn a_wall_that_is_pressed_slowly_is_told() {
    let mut world = World3::new();
    let wall = world.insert(Collider3::new(HalfSpace::new(Vec3::NEG_X).unwrap()).fixed());
    let mut hero = Hero::new(&world, thin_person(), DVec3::ZERO);
    hero.pose = Pose3::at([-0.3 - f64::from(hero.walk.skin), 5.0, 0.0]).unwrap();
    for frame in 0..20 {
        let slide = hero.step([0.001, -0.05, 0.0]);
        let told = slide.walls.iter().any(|met| met.body == wall && met.normal == Vec3::NEG_X);
        assert!(told || frame == 0, "frame {frame}: {slide:?}");
        assert!(hero.step([0.0, -0.05, 0.0]).walls.is_empty(), "along it");
        hero.step([0.001, -0.05, 0.0]);
    }
}

/// Symptom: in the corner between a slope that is too steep and a wall that leaned over it by a degree, a run became a
/// climb.
#[test]
fn nobody_climbs_between_a_slope_and_what_leans_over_it() {
    let (sin, cos) = (|angle: f64| sine(angle.to_radians()), |angle: f64| cosine(angle.to_radians()));
    for (steep, lean) in [(60.0, 1.0), (60.0, 0.0), (70.0, 5.0), (80.0, 1.0), (82.0, 0.5)] {
        for opening in [20.0, 45.0, 60.0] {
            let aside = |way: f64| DVec3::new(way * cos(opening / 2.0), 0.0, -sin(opening / 2.0));
            let slope = aside(1.0) * sin(steep) + DVec3::Y * cos(steep);
            let wall = aside(-1.0) * cos(lean) - DVec3::Y * sin(lean);
            let mut world = World3::new();
            for normal in [slope, wall] {
                world.insert(Collider3::new(HalfSpace::new(normal.as_vec3()).unwrap()).fixed());
            }
            let mut hero =
                Hero::new(&world, Capsule3::from_half_height(0.5, 0.3).unwrap().into(), [0.0, 3.0, -3.0]);
            let mut highest = hero.feet().y;
            for frame in 0..300 {
                hero.step([0.0, -0.02, 0.25]);
                assert!(hero.feet().y <= highest + 0.01, "{steep} {lean} {opening}, frame {frame}");
                highest = highest.min(hero.feet().y);
            }
        }
    }
}

/// Symptom: a jump into an acute corner moved back and forth in it, frame by frame.
#[test]
fn no_jump_leads_back() {
    let mut world = World2::new();
    for (normal, height) in [((0.9285, 0.3713), -1.0541), ((0.7571, -0.6533), -0.5587)] {
        let normal = DVec2::from(normal);
        let pose = Pose2::at(normal * height).unwrap();
        world.insert(Collider2::new(HalfPlane::new(normal.as_vec2()).unwrap()).at(pose).fixed());
    }
    let hero = Shape2::from(Circle::new(0.3).unwrap());
    let walk = Walk2::new(&hero, Vec2::Y).unwrap();
    let start = world.depenetrate((&hero, &Pose2::IDENTITY), &Filter2::new());
    let (mut pose, way) = (start.pose, Vec2::new(-0.1665, 0.1107));
    assert!(start.is_free);
    for frame in 0..100 {
        let slide = world.move_and_slide((&hero, &pose), way, &walk, &Filter2::new());
        assert!(slide.moved.dot(way.as_dvec2()) > -1e-9, "frame {frame}: {slide:?}");
        pose = slide.pose;
    }
}

/// Symptom: a character in a groove whose walls are one body was not freed, while it was where they are two bodies.
/// Cause: only the deepest manifold of each body was kept.
#[test]
fn grooves_of_one_body_are_left_as_those_of_two() {
    let hero = Shape3::from(Sphere::new(0.5).unwrap());
    for half in [10.0_f64, 20.0, 45.0, 80.0] {
        let (sin, cos) = (sine(half.to_radians()), cosine(half.to_radians()));
        // Two walls up from the origin, each tilted outwards by the half angle.
        let corner = |side: f64, up: f64, out: f64, z: f64| {
            DVec3::new(side * (up * sin + out * cos), up * cos - out * sin, z)
        };
        let wall = |side: f64| -> Shape3 {
            let points = [0.0, 8.0]
                .map(|up| [0.0, 2.0].map(|out| [-4.0, 4.0].map(|z| corner(side, up, out, z).as_vec3())));
            Hull::from_points(points.as_flattened().as_flattened()).unwrap().into()
        };
        let rims = [-1.0, 1.0].map(|side| [-4.0, 4.0].map(|z| corner(side, 8.0, 0.0, z).as_vec3()));
        let vertices = [Vec3::NEG_Z * 4.0, Vec3::Z * 4.0, rims[0][0], rims[0][1], rims[1][0], rims[1][1]];
        let mesh = TriMesh::new(vertices, [[0, 2, 1], [2, 3, 1], [0, 1, 4], [4, 1, 5]]).unwrap();
        let one = Compound3::new([-1.0, 1.0].map(|side| (Pose3::IDENTITY, wall(side)))).unwrap();
        let worlds: [Vec<Shape3>; 3] = [vec![wall(-1.0), wall(1.0)], vec![one.into()], vec![mesh.into()]];
        // The height at which the ball just fits, and how far below it starts.
        let fits = 0.5 / sin;
        for (kind, shapes) in worlds.iter().enumerate() {
            let mut world = World3::new();
            for shape in shapes {
                world.insert(Collider3::new(shape.clone()).fixed());
            }
            let at = Pose3::at([0.02, 0.9 * fits, 0.0]).unwrap();
            let freed = world.depenetrate((&hero, &at), &Filter3::new());
            assert!(freed.is_free && is_free(&world, &hero, &freed.pose), "{half} {kind}: {freed:?}");
            assert!(freed.moved.length() < 0.1 * fits + 0.03, "{half} {kind}: {freed:?}, {fits}");
            let walk = Walk3::new(&hero, Vec3::Y).unwrap();
            let slide = world.move_and_slide((&hero, &at), Vec3::Y * 0.01, &walk, &Filter3::new());
            assert!(slide.is_free, "{half} {kind}: {slide:?}");
        }
    }
}

/// Even without steps, a character with round feet walks over low edges: up to the height at which the feet touch them
/// no steeper than ground.
#[test]
fn round_feet_walk_over_low_edges_whatever_the_step() {
    for (height, is_low) in [(0.08, true), (0.1, false)] {
        let (mut space, mut plane) = (World3::new(), World2::new());
        space.insert(Collider3::new(HalfSpace::new(Vec3::Y).unwrap()));
        plane.insert(Collider2::new(HalfPlane::new(Vec2::Y).unwrap()));
        let kerb = Collider3::new(cuboid([1.0, height, 2.0])).at(Pose3::at([2.0, 0.0, 0.0]).unwrap());
        space.insert(kerb.fixed());
        let kerb = Rect::from_half_extents(Vec2::new(1.0, height)).unwrap();
        plane.insert(Collider2::new(kerb).at(Pose2::at([2.0, 0.0]).unwrap()).fixed());

        let mut round = Hero::new(&space, thin_person(), [0.0; 3]);
        let mut sharp = Hero::new(&space, cuboid([0.3, 0.9, 0.3]), [0.0; 3]);
        for hero in [&mut round, &mut sharp] {
            hero.walk.step = 0.0;
            for _ in 0..100 {
                hero.step([0.02, -0.02, 0.0]);
            }
        }
        assert_eq!(round.feet().x > 1.5, is_low, "{height}: {}", round.feet());
        assert!(sharp.feet().x < 0.7, "{height}: {}", sharp.feet());

        let flat = Shape2::from(Capsule2::from_half_height(0.6, 0.3).unwrap());
        let walk = Walk2 { step: 0.0, ..Walk2::new(&flat, Vec2::Y).unwrap() };
        let mut pose = Pose2::at([0.0, 0.91]).unwrap();
        for _ in 0..100 {
            pose = plane.move_and_slide((&flat, &pose), Vec2::new(0.02, -0.02), &walk, &Filter2::new()).pose;
        }
        assert_eq!(pose.position().x > 1.5, is_low, "{height}: {}", pose.position());
    }
}
