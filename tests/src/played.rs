//! Operations on either world besides [`Engine`]'s calls: many bodies at once, tiny moves, a grid, and ground.

use crate::cases::Random;
use crate::engine::Engine;
use asunder::{
    Chain, Collider, Collider2, Collider3, HeightField, Plane, Pose2, Pose3, Rotation2, TriMesh, Volume,
    World,
};
use glam::{DQuat, DVec2, DVec3, Quat, Vec2, Vec3};

/// A dimension's world, by further calls that both dimensions have.
pub trait Played: Engine {
    /// `World::insert_many`.
    fn insert_many(world: &mut World<Self>, bodies: Vec<Collider<Self>>) -> Vec<Self::Key>;
    /// `World::set_poses`; returns whether all keys were fresh.
    fn set_poses(world: &mut World<Self>, poses: Vec<(Self::Key, Self::Pose)>) -> bool;
    /// A pose moved along each axis and rotated about each by at most `by`, in metres and radians.
    fn nudged(pose: &Self::Pose, random: &mut Random, by: f64) -> Self::Pose;
    /// An unrotated pose on a grid of half metres within `reach` of the origin on each axis.
    fn on_grid(random: &mut Random, reach: f64) -> Self::Pose;
    /// Ground of about `reach` each way: of triangles or segments; one-sided or two-sided.
    fn random_ground(random: &mut Random, reach: f64) -> Collider<Self>;
}

/// Half metres within `reach`.
fn halves(random: &mut Random, reach: f64) -> DVec3 {
    (random.vector() * reach * 2.0).round() / 2.0
}

impl Played for Volume {
    fn insert_many(world: &mut World<Self>, bodies: Vec<Collider<Self>>) -> Vec<Self::Key> {
        world.insert_many(bodies)
    }

    fn set_poses(world: &mut World<Self>, poses: Vec<(Self::Key, Self::Pose)>) -> bool {
        world.set_poses(poses).is_ok()
    }

    fn nudged(pose: &Pose3, random: &mut Random, by: f64) -> Pose3 {
        let turn = random.vector() * by * 0.5;
        let turn = DQuat::from_xyzw(turn.x, turn.y, turn.z, 1.0).normalize();
        let turned = turn * DQuat::from_array(pose.rotation().to_array().map(f64::from));
        let turned = Quat::from_array(turned.to_array().map(|c| c as f32));
        let rotation = if random.below(3) == 0 { pose.rotation() } else { turned };
        Pose3::new(pose.position() + random.vector() * by, rotation).unwrap()
    }

    fn on_grid(random: &mut Random, reach: f64) -> Pose3 {
        Pose3::at(halves(random, reach)).unwrap()
    }

    fn random_ground(random: &mut Random, reach: f64) -> Collider3 {
        const SIDE: usize = 4;
        let (cell, middle) = ((reach / 2.0) as f32, -0.5 * (SIDE - 1) as f32);
        // Flat, stepped, or rough.
        let kind = random.below(3);
        let mut height = || match kind {
            0 => 0.0,
            1 => random.below(3) as f32 * 0.5,
            _ => (random.signed() * 0.6) as f32,
        };
        let heights: Vec<f32> = (0..SIDE * SIDE).map(|_| height()).collect();
        let is_one_sided = random.below(3) == 0;
        let collider = if random.below(2) == 0 {
            let place = |i: usize| Vec3::new((i % SIDE) as f32 + middle, 0.0, (i / SIDE) as f32 + middle);
            let vertices = (0..SIDE * SIDE).map(|i| place(i) * cell + Vec3::Y * heights[i]);
            let side = SIDE as u32;
            let corners = (0..side * side).filter(|i| i % side < side - 1 && i / side < side - 1);
            let triangles = corners.flat_map(|i| [[i, i + side, i + 1], [i + 1, i + side, i + side + 1]]);
            let mesh = TriMesh::new(vertices.collect::<Vec<_>>(), triangles.collect::<Vec<_>>()).unwrap();
            Collider3::new(if is_one_sided { mesh.one_sided() } else { mesh })
        } else {
            let field = HeightField::new(SIDE, SIDE, heights, Vec2::splat(cell)).unwrap();
            let field = field.with_hole(random.below(SIDE - 1), random.below(SIDE - 1)).unwrap();
            Collider3::new(if is_one_sided { field.one_sided() } else { field })
        };
        let pose =
            if random.below(2) == 0 { Self::on_grid(random, 1.0) } else { Self::random_pose(random, 1.0) };
        collider.at(pose).user_data(random.below(1 << 20) as u64).margin(random.pick(&[0.0, 0.1])).unwrap()
    }
}

impl Played for Plane {
    fn insert_many(world: &mut World<Self>, bodies: Vec<Collider<Self>>) -> Vec<Self::Key> {
        world.insert_many(bodies)
    }

    fn set_poses(world: &mut World<Self>, poses: Vec<(Self::Key, Self::Pose)>) -> bool {
        world.set_poses(poses).is_ok()
    }

    fn nudged(pose: &Pose2, random: &mut Random, by: f64) -> Pose2 {
        let turn = DVec2::new(1.0, random.signed() * by).normalize();
        let turned = turn.rotate(DVec2::new(pose.rotation().cos().into(), pose.rotation().sin().into()));
        let turned = Rotation2::new(turned.x as f32, turned.y as f32).unwrap();
        let rotation = if random.below(3) == 0 { pose.rotation() } else { turned };
        Pose2::new(pose.position() + random.vector().truncate() * by, rotation).unwrap()
    }

    fn on_grid(random: &mut Random, reach: f64) -> Pose2 {
        Pose2::at(halves(random, reach).truncate()).unwrap()
    }

    fn random_ground(random: &mut Random, reach: f64) -> Collider2 {
        let count = 3 + random.below(7);
        let is_level = random.below(2) == 0;
        let vertices: Vec<Vec2> = (0..count)
            .map(|i| {
                let x = (i as f64 / (count - 1) as f64 * 2.0 - 1.0) * reach;
                let y = if is_level { random.below(2) as f64 * 0.5 } else { random.signed() * 0.8 };
                DVec2::new(x, y).as_vec2()
            })
            .collect();
        let is_closed = random.below(3) == 0;
        let chain = if is_closed { Chain::closed(vertices) } else { Chain::open(vertices) }.unwrap();
        let chain = if random.below(3) == 0 { chain.one_sided() } else { chain };
        let pose =
            if random.below(2) == 0 { Self::on_grid(random, 1.0) } else { Self::random_pose(random, 1.0) };
        let body = Collider2::new(chain).at(pose).user_data(random.below(1 << 20) as u64);
        body.margin(random.pick(&[0.0, 0.1])).unwrap()
    }
}
