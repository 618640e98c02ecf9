//! The order in which the bodies of a scene were inserted, which must not matter to a character.

use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{
    Circle, Collider2, Collider3, Filter2, Filter3, HalfPlane, HalfSpace, Pose2, Pose3, Shape2, Shape3,
    Sphere, Walk2, Walk3, World2, World3,
};

/// Gaps to what is below and above, in skins, as for a character that was stopped a skin from one while it moved along
/// the other.
const GAPS: [(f64, f64); 3] = [(1.0, 0.85), (0.9, 0.77), (0.75, 0.75)];

/// Slopes of the floor and the ceiling of an acute corner, the ceiling down to the right. In so acute a corner the way
/// out is long, and each push moves only a little along it.
const CORNERS: [(f32, f32); 4] = [(0.0, -0.1), (0.05, -0.1), (0.15, -0.05), (0.3, -0.3)];

/// Symptom: the end position of a character closer than its skin to the floor and the ceiling of an acute corner
/// depended, by up to four millimetres, on which of the two had been inserted first. Cause: it is pushed out of one
/// after the other repeatedly, but too few times for the first one not to matter, and the first was the one in the
/// lowest slot.
#[test]
fn of_an_acute_corner_of_the_plane_either_side_may_come_first() {
    let radius = 0.4;
    let ball: Shape2 = Circle::new(radius as f32).unwrap().into();
    let walk = Walk2::new(&ball, Vec2::Y).unwrap();
    for (below, above) in CORNERS {
        for gaps in GAPS {
            let side = |normal: Vec2, gap: f64| {
                let away = normal.as_dvec2().normalize() * (radius + gap * f64::from(walk.skin));
                Collider2::new(HalfPlane::new(normal).unwrap()).at(Pose2::at(-away).unwrap()).fixed()
            };
            let sides = [side(Vec2::new(-below, 1.0), gaps.0), side(Vec2::new(above, -1.0), gaps.1)];
            let slide = |order: [usize; 2], by: Vec2| {
                let mut world = World2::new();
                for number in order {
                    world.insert(sides[number].clone());
                }
                let slide = world.move_and_slide((&ball, &Pose2::IDENTITY), by, &walk, &Filter2::new());
                (slide.pose, slide.moved, slide.blocked, slide.is_free)
            };
            for by in [Vec2::ZERO, Vec2::new(0.05, -0.003), Vec2::new(-0.05, -0.003)] {
                let (one, other) = (slide([0, 1], by), slide([1, 0], by));
                assert_eq!(one, other, "{below} {above} {gaps:?} by {by}");
                assert!(
                    by != Vec2::ZERO || one.1 != DVec2::ZERO,
                    "it is moved off: {below} {above} {gaps:?}"
                );
            }
        }
    }
}

/// The same in space, with a wall along the corner.
#[test]
fn of_an_acute_corner_of_space_either_side_may_come_first() {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let radius = 0.4;
    let ball: Shape3 = Sphere::new(radius as f32).unwrap().into();
    let walk = Walk3::new(&ball, Vec3::Y).unwrap();
    for (below, above) in CORNERS {
        for gaps in GAPS {
            let side = |normal: Vec3, gap: f64| {
                let away = normal.as_dvec3().normalize() * (radius + gap * f64::from(walk.skin));
                Collider3::new(HalfSpace::new(normal).unwrap()).at(Pose3::at(-away).unwrap()).fixed()
            };
            let sides = [
                side(Vec3::new(-below, 1.0, 0.1), gaps.0),
                side(Vec3::new(above, -1.0, 0.1), gaps.1),
                side(Vec3::new(0.0, 0.2, -1.0), gaps.1),
            ];
            let slide = |order: [usize; 3], by: Vec3| {
                let mut world = World3::new();
                for number in order {
                    world.insert(sides[number].clone());
                }
                let slide = world.move_and_slide((&ball, &Pose3::IDENTITY), by, &walk, &Filter3::new());
                (slide.pose, slide.moved, slide.blocked, slide.is_free)
            };
            for by in [Vec3::ZERO, Vec3::new(0.05, -0.003, 0.02), Vec3::new(-0.05, -0.003, 0.0)] {
                let first = slide(ORDERS[0], by);
                for order in ORDERS {
                    assert_eq!(first, slide(order, by), "{below} {above} {gaps:?} by {by}, {order:?}");
                }
                assert!(by != Vec3::ZERO || first.1 != DVec3::ZERO, "it is moved off: {below} {above}");
            }
        }
    }
}
