//! Who is pressed against ground.

use asunder::{
    Capsule3, Chain, Circle, Collider2, Collider3, Cuboid, Filter2, Filter3, Pose2, Pose3, Ray3, Shape2,
    Shape3, Sphere, TriMesh, Walk2, Walk3, World2, World3, cast_ray3,
};
use glam::{Vec2, Vec3};

/// Symptom: who was pressed against a wall of one-sided ground was put behind it, and said to be free. Cause: of poses
/// on the way out, one behind the ground's front counted as free of it.
#[test]
fn nobody_is_pressed_through_a_one_sided_wall() {
    let hero: Shape2 = Circle::new(0.3).unwrap().into();
    let at = Pose2::at([-0.32, 0.0]).unwrap();
    for foe in [-0.55, -0.65, -0.8] {
        let mut world = World2::new();
        let wall = Chain::open([Vec2::new(0.0, 5.0), Vec2::new(0.0, -5.0)]).unwrap().one_sided();
        world.insert(Collider2::new(wall));
        world.insert(Collider2::new(Circle::new(0.5).unwrap()).at(Pose2::at([foe, 0.0]).unwrap()));
        let freed = world.depenetrate((&hero, &at), &Filter2::new());
        assert!(freed.pose.position().x < 0.0 && !freed.is_free, "{foe}: {freed:?}");
        let walk = Walk2::new(&hero, Vec2::Y).unwrap();
        let slide = world.move_and_slide((&hero, &at), Vec2::ZERO, &walk, &Filter2::new());
        assert!(slide.pose.position().x < 0.0 && !slide.is_free, "{foe}: {slide:?}");
    }
}

/// The same in space; and where there is a way out, it is found.
#[test]
fn who_is_pressed_from_the_side_comes_out_on_top() {
    let hero: Shape3 = Sphere::new(0.3).unwrap().into();
    let at = Pose3::at([-0.32, 0.0, 0.0]).unwrap();
    let corners = [[0.0, -5.0, -5.0], [0.0, 5.0, -5.0], [0.0, 5.0, 5.0], [0.0, -5.0, 5.0]].map(Vec3::from);
    let two = TriMesh::new(corners, [[0, 1, 2], [0, 2, 3]]).unwrap();
    let wall = TriMesh::new(corners, [[0, 2, 1], [0, 3, 2]]).unwrap().one_sided();
    assert!(
        cast_ray_of(&wall, [-1.0, 0.5, 0.0], Vec3::X) && !cast_ray_of(&wall, [1.0, 0.5, 0.0], Vec3::NEG_X)
    );
    for (low, is_free, wall) in
        [(0.0, false, &wall), (0.3, true, &wall), (0.0, false, &two), (0.3, true, &two)]
    {
        let mut world = World3::new();
        world.insert(Collider3::new(wall.clone()));
        world.insert(Collider3::new(Sphere::new(0.5).unwrap()).at(Pose3::at([-0.55, -low, 0.0]).unwrap()));
        let freed = world.depenetrate((&hero, &at), &Filter3::new());
        assert_eq!(freed.is_free, is_free, "{low}: {freed:?}");
        assert!(freed.pose.position().x < 0.0, "{low}: {freed:?}");
        assert!(!is_free || freed.pose.position().y > 0.0, "{low}: {freed:?}");
    }
}

/// A press comes down on who stands on a level of one side: as long as it comes, nobody leaves the level.
#[test]
fn nobody_is_pressed_through_the_floor() {
    let hero: Shape3 = Capsule3::from_half_height(0.15, 0.25).unwrap().into();
    let corners = [[-5.0, 0.0, -5.0], [5.0, 0.0, -5.0], [5.0, 0.0, 5.0], [-5.0, 0.0, 5.0]].map(Vec3::from);
    for is_one_sided in [false, true] {
        let floor = TriMesh::new(corners, [[0, 2, 1], [0, 3, 2]]).unwrap();
        let floor = if is_one_sided { floor.one_sided() } else { floor };
        let walk = Walk3::new(&hero, Vec3::Y).unwrap();
        let mut pose = Pose3::at([0.0, 0.41, 0.0]).unwrap();
        let mut wedged = 0;
        for frame in 0..100 {
            let mut world = World3::new();
            world.insert(Collider3::new(floor.clone()));
            let press = 1.2 - 0.012 * f64::from(frame);
            let above = Pose3::at([0.0, press + 0.2, 0.0]).unwrap();
            world.insert(
                Collider3::new(Cuboid::from_half_extents(Vec3::new(2.0, 0.2, 2.0)).unwrap()).at(above),
            );
            let down = Vec3::NEG_Y * 0.05;
            let slide = world.move_and_slide((&hero, &pose), down, &walk, &Filter3::new());
            pose = slide.pose;
            assert!(pose.position().y > 0.0, "frame {frame}, under a press at {press}: {slide:?}");
            assert_eq!(slide.is_free, press > 0.8, "frame {frame}, under a press at {press}: {slide:?}");
            wedged += usize::from(!slide.is_free);
        }
        assert!(wedged > 50, "{wedged}");
    }
}

/// Whether a ray meets a mesh, as it does from the front.
fn cast_ray_of(mesh: &TriMesh, origin: [f64; 3], direction: Vec3) -> bool {
    let ray = Ray3::new(origin, direction * 2.0).unwrap();
    cast_ray3(&mesh.clone().into(), &Pose3::IDENTITY, &ray, 1.0).is_some()
}
