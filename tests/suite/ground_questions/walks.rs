//! Characters on ground made of triangles.

use super::{Soup, mesh, sheet};
use crate::characters::stage::{Hero, capsule, crate_of_a_person};
use asunder::glam::{DVec3, Quat, Vec3};
use asunder::{Collider3, Filter3, Pose3, Shape3, Sphere, TriMesh, Walk3, World3};

/// A ball as tall as a person.
fn ball() -> Shape3 {
    Sphere::new(0.9).unwrap().into()
}

const SHAPES: [fn() -> Shape3; 3] = [capsule, crate_of_a_person, ball];

/// Horizontal directions of unit length.
const WAYS: [DVec3; 4] =
    [DVec3::X, DVec3::new(0.96, 0.0, 0.28), DVec3::new(-0.352, 0.0, 0.936), DVec3::new(-0.6, 0.0, -0.8)];

fn world_of(soup: Soup) -> World3 {
    let mut world = World3::new();
    world.insert(Collider3::new(mesh(soup)).fixed());
    world
}

/// Both soups joined.
fn joined((mut vertices, mut triangles): Soup, (more, others): Soup) -> Soup {
    let first = vertices.len() as u32;
    vertices.extend(more);
    triangles.extend(others.into_iter().map(|numbers| numbers.map(|number| number + first)));
    (vertices, triangles)
}

#[test]
fn no_inner_edge_of_a_floor_trips_who_walks_on_it() {
    for (count, step) in
        [([40, 40], [0.5, 0.5]), ([1, 200], [20.0, 0.1]), ([60, 1], [0.35, 20.0]), ([2, 2], [10.0, 10.0])]
    {
        let world = world_of(sheet(count, step, |_, _| 0.0, |_, _| false));
        for shape in SHAPES {
            for (gravity, way) in [0.0, -0.1, -0.02, -0.5].into_iter().zip(WAYS) {
                let mut hero = Hero::new(&world, shape(), way * -6.0);
                let start = hero.feet();
                for frame in 0..100 {
                    let slide = hero.step((way * 0.12).as_vec3() + Vec3::Y * gravity);
                    assert!(slide.walls.is_empty() && slide.ground.is_some(), "{step:?} {frame}: {slide:?}");
                    let up = slide.ground.unwrap().normal;
                    assert!((up - Vec3::Y).length() < 1e-6, "{step:?} {frame}: {slide:?}");
                    assert!(hero.feet().y.abs() < 1e-3, "{step:?} {frame}: {}", hero.feet());
                }
                let gone = (hero.feet() - start).with_y(0.0).length();
                assert!((gone / 12.0 - 1.0).abs() < 1e-4, "{step:?} {way}: {gone}");
            }
        }
    }
}

#[test]
fn a_bumpy_field_is_walked_over_without_a_stop() {
    // Parabolic waves, with slopes of up to 20 degrees.
    let wave = |x: f32| {
        let x = x - (x / 2.0).round() * 2.0;
        4.0 * x * (1.0 - x.abs())
    };
    let height = |x: f32, z: f32| 0.25 * wave(0.35 * x) * wave(0.3 * z + 0.5);
    let world = world_of(sheet([60, 60], [0.4, 0.4], height, |_, _| false));
    for shape in SHAPES {
        for turn in WAYS {
            let mut hero = Hero::new(&world, shape(), turn * -8.0 + DVec3::Y * 0.6);
            for _ in 0..20 {
                hero.step([0.0, -0.1, 0.0]);
            }
            let start = hero.feet();
            for frame in 0..130 {
                let before = hero.feet();
                let slide = hero.step((turn * 0.12 - DVec3::Y * 0.05).as_vec3());
                assert!(slide.ground.is_some() && slide.is_free, "{turn} {frame}: {slide:?}");
                let gone = (hero.feet() - before).with_y(0.0).length();
                assert!(gone > 0.08, "{turn} {frame}: {gone} {slide:?}");
                assert!((hero.feet().y).abs() < 0.6, "{turn} {frame}: {}", hero.feet());
            }
            let gone = (hero.feet() - start).with_y(0.0).length();
            assert!(gone > 13.5, "{turn}: {gone}");
        }
    }
}

/// Stairs along x from the origin: `count` steps of this depth and height, with floors before and behind.
fn stairs(count: u32, depth: f32, height: f32) -> Soup {
    let (mut profile, mut x) = (vec![Vec3::new(-6.0, 0.0, 0.0), Vec3::ZERO], 0.0);
    for i in 1..=count {
        let y = i as f32 * height;
        profile.push(Vec3::new(x, y, 0.0));
        x += if i == count { 6.0 } else { depth };
        profile.push(Vec3::new(x, y, 0.0));
    }
    let vertices = profile.iter().flat_map(|&point| [point - Vec3::Z * 3.0, point + Vec3::Z * 3.0]).collect();
    let triangles = (0..profile.len() as u32 - 1)
        .flat_map(|i| [[2 * i, 2 * i + 1, 2 * i + 2], [2 * i + 2, 2 * i + 1, 2 * i + 3]])
        .collect();
    (vertices, triangles)
}

#[test]
fn stairs_are_climbed_and_walked_down() {
    for shape in SHAPES {
        let world = world_of(stairs(8, 0.5, 0.2));
        let mut hero = Hero::new(&world, shape(), [-2.0, 0.0, 0.1]);
        hero.walk.step = 0.3;
        hero.walk.snap = 0.3;
        for _ in 0..110 {
            hero.step([0.1, -0.1, 0.01]);
        }
        assert!((hero.feet().y - 1.6).abs() < 0.01 && hero.feet().x > 5.0, "{}", hero.feet());
        for _ in 0..110 {
            let slide = hero.step([-0.1, -0.1, 0.0]);
            assert!(slide.ground.is_some(), "{}", hero.feet());
        }
        assert!(hero.feet().y.abs() < 0.01 && hero.feet().x < -1.0, "{}", hero.feet());
    }
    // Steps that are too high act as a wall.
    let world = world_of(stairs(2, 0.5, 0.5));
    let mut hero = Hero::new(&world, capsule(), [-2.0, 0.0, 0.1]);
    hero.walk.step = 0.3;
    for _ in 0..60 {
        hero.step([0.1, -0.1, 0.0]);
    }
    assert!(hero.feet().y.abs() < 0.01 && hero.feet().x < -0.3, "{}", hero.feet());
}

#[test]
fn slopes_of_triangles_are_climbed_up_to_the_limit() {
    for shape in SHAPES {
        // 25, 40 and 50 degrees.
        for (slope, climbs) in [(0.466_f32, true), (0.839, true), (1.192, false)] {
            let height = move |x: f32, _: f32| if x > 0.0 { x * slope } else { 0.0 };
            let world = world_of(sheet([60, 20], [0.5, 0.5], height, |_, _| false));
            let mut hero = Hero::new(&world, shape(), [-3.0, 0.0, 0.2]);
            for _ in 0..100 {
                hero.step([0.08, -0.1, 0.01]);
            }
            if climbs {
                assert!(hero.feet().y > 2.0, "{slope}: {}", hero.feet());
            } else {
                assert!(hero.feet().y < 0.1, "{slope}: {}", hero.feet());
            }
        }
    }
}

/// A room without a roof, of squares of half a metre; walls and floor in one mesh.
fn room() -> Soup {
    let wall = |place: fn(f32, f32) -> Vec3| {
        let (vertices, triangles) = sheet([12, 6], [0.5, 0.5], |_, _| 0.0, |_, _| false);
        (vertices.iter().map(|v| place(v.x, v.z + 1.5)).collect(), triangles)
    };
    let walls: [fn(f32, f32) -> Vec3; 4] = [
        |u, v| Vec3::new(u, v, -3.0),
        |u, v| Vec3::new(u, v, 3.0),
        |u, v| Vec3::new(-3.0, v, u),
        |u, v| Vec3::new(3.0, v, u),
    ];
    let floor = sheet([12, 12], [0.5, 0.5], |_, _| 0.0, |_, _| false);
    walls.into_iter().fold(floor, |soup, place| joined(soup, wall(place)))
}

#[test]
fn walls_of_a_room_are_slid_along_and_never_left() {
    for rotation in [Quat::IDENTITY, Quat::from_xyzw(0.0, 0.3, 0.0, 1.0)] {
        let mut world = World3::new();
        let turned = Pose3::new(Vec3::ZERO, rotation).unwrap();
        world.insert(Collider3::new(mesh(room())).at(turned).fixed());
        for shape in SHAPES {
            let mut hero = Hero::new(&world, shape(), [0.0, 0.0, 0.0]);
            // Into a wall at an angle: slides along it, at the speed that is left.
            let local = |v: DVec3| turned.turn(v).as_vec3();
            for _ in 0..30 {
                hero.step(local(DVec3::new(0.1, -0.05, 0.0)));
            }
            let before = turned.transform_back(hero.feet());
            assert!(before.x > 1.9 && before.x < 2.7, "{before}");
            for frame in 0..20 {
                let slide = hero.step(local(DVec3::new(0.1, -0.05, 0.06)));
                assert!(slide.ground.is_some() && !slide.walls.is_empty(), "{frame}: {slide:?}");
                let facing = turned.turn_back(slide.walls[0].normal.as_dvec3());
                assert!((facing - DVec3::NEG_X).length() < 1e-3, "{frame}: {slide:?}");
            }
            let after = turned.transform_back(hero.feet());
            assert!((after.z - before.z - 1.2).abs() < 0.02 && after.y.abs() < 0.01, "{before} {after}");
            // In random directions, for a long time.
            let mut random = asunder_tests::cases::Random::new(5);
            let mut way = DVec3::X;
            for frame in 0..600 {
                if frame % 15 == 0 {
                    way = random.direction().with_y(0.0) * 0.2;
                }
                hero.step(local(way + DVec3::NEG_Y * 0.1));
                let feet = turned.transform_back(hero.feet());
                assert!(feet.x.abs() < 2.7 && feet.z.abs() < 2.7 && feet.y.abs() < 0.05, "{frame}: {feet}");
            }
        }
    }
}

#[test]
fn one_sided_floors_are_jumped_through_from_below_and_carry_from_above() {
    let (vertices, numbers) = sheet([12, 12], [0.5, 0.5], |_, _| 0.0, |_, _| false);
    let both = TriMesh::new(vertices, numbers).unwrap();
    let one = both.clone().one_sided();
    for (floor, passes) in [(both, false), (one, true)] {
        let mut world = World3::new();
        world.insert(Collider3::new(floor).fixed());
        for shape in SHAPES {
            let walk = Walk3::new(&shape(), Vec3::Y).unwrap();
            let mut pose = Pose3::at([0.1, -2.0, 0.2]).unwrap();
            let mut step = |way: Vec3| {
                let slide = world.move_and_slide((&shape(), &pose), way, &walk, &Filter3::new());
                pose = slide.pose;
                slide
            };
            for _ in 0..25 {
                step(Vec3::new(0.01, 0.15, 0.0));
            }
            for _ in 0..40 {
                step(Vec3::new(0.01, -0.1, 0.0));
            }
            let stands = step(Vec3::NEG_Y * 0.1);
            assert_eq!(stands.ground.is_some(), passes, "{stands:?}");
            let height = pose.position().y;
            if passes {
                assert!((height - 0.9 - f64::from(walk.skin)).abs() < 1e-3, "{height}");
            } else {
                assert!(height < -2.0, "{height}");
            }
        }
    }
}
