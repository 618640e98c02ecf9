//! All queries of a world, and a world in which much happens.

use asunder::glam::{Vec2, Vec3};
use asunder::{
    Aabb2, Aabb3, CastAnswer2, CastAnswer3, Chain, Collider, Collider2, Collider3, DebugOptions, Filter,
    HeightField, NearAnswer2, NearAnswer3, Plane, Pose2, Pose3, Ray2, Ray3, RayAnswer2, RayAnswer3, Shape2,
    Shape3, TriMesh, Volume, Walk2, Walk3, World,
};
use asunder_tests::cases::Random;
use asunder_tests::engine::Engine;
use core::ops::ControlFlow;

/// A dimension whose worlds are queried.
pub(crate) trait Asker: Engine {
    /// The arguments of the queries: a shape, a displacement and a box.
    type Asked: Send + Sync;
    /// The caller's buffers.
    type Lists: Default + Send;
    /// Random arguments within `room` of the origin on each axis.
    fn asked(random: &mut Random, room: f64) -> Self::Asked;
    /// Runs every query with a single answer and every visitor; returns the number of answers.
    fn visit(world: &World<Self>, asked: &Self::Asked) -> usize;
    /// Runs every query that fills a buffer; returns the number of answers.
    fn list(world: &World<Self>, asked: &Self::Asked, into: &mut Self::Lists) -> usize;
    /// Frees a character, and lets it walk; returns whether it hit something.
    fn walk(world: &World<Self>, asked: &Self::Asked) -> bool;
    /// Draws all debug lines; returns their number.
    fn lines(world: &World<Self>) -> usize;
    /// Takes a snapshot, and restores a world from it; returns whether that reports the same.
    fn comes_back(world: &World<Self>) -> bool;
    /// Ground for a room, from -3 to 3 m.
    fn ground() -> Vec<Collider<Self>>;
}

pub(crate) struct Asked3 {
    at: (Shape3, Pose3),
    displacement: Vec3,
    ray: Ray3,
    bounds: Aabb3,
    walk: Walk3,
}

pub(crate) struct Asked2 {
    at: (Shape2, Pose2),
    displacement: Vec2,
    ray: Ray2,
    bounds: Aabb2,
    walk: Walk2,
}

pub(crate) struct Lists<K, N, R, C> {
    keys: Vec<K>,
    near: Vec<N>,
    rays: Vec<R>,
    casts: Vec<C>,
}

// Not derived: keys and answers have no default.
impl<K, N, R, C> Default for Lists<K, N, R, C> {
    fn default() -> Self {
        Self { keys: Vec::new(), near: Vec::new(), rays: Vec::new(), casts: Vec::new() }
    }
}

/// Half a metre more than most bodies are long, so that queries find several.
const WITHIN: f32 = 1.5;

macro_rules! asker {
    ($space:ty, $asked:ty, $near:ty, $ray:ty, $cast:ty, $asked_at:path, $ground:path) => {
        impl Asker for $space {
            type Asked = $asked;
            type Lists = Lists<Self::Key, $near, $ray, $cast>;

            fn asked(random: &mut Random, room: f64) -> Self::Asked {
                $asked_at(random, room)
            }

            fn visit(world: &World<Self>, asked: &Self::Asked) -> usize {
                let Self::Asked { at: (shape, pose), displacement, ray, bounds, .. } = asked;
                let (filter, at, point) = (Filter::new(), (shape, pose), pose.position());
                let firsts = [
                    world.closest(point, WITHIN, &filter).is_some(),
                    world.closest_to_shape(at, WITHIN, &filter).is_some(),
                    world.cast_ray(ray, 1.0, &filter).is_some(),
                    world.cast_shape(at, *displacement, &filter).is_some(),
                ];
                let mut answers = firsts.into_iter().filter(|is_some| *is_some).count();
                let mut count = || {
                    answers += 1;
                    ControlFlow::Continue(())
                };
                let _ = world.visit_boxes_overlapping(bounds, &filter, |_| count());
                let _ = world.visit_overlapping_point(point, &filter, |_| count());
                let _ = world.visit_overlapping(at, &filter, |_| count());
                let _ = world.visit_within(point, WITHIN, &filter, |_| count());
                let _ = world.visit_within_shape(at, WITHIN, &filter, |_| count());
                let _ = world.visit_ray(ray, 1.0, &filter, |_| count());
                let _ = world.visit_cast_shape(at, *displacement, &filter, |_| count());
                answers
            }

            fn list(world: &World<Self>, asked: &Self::Asked, into: &mut Self::Lists) -> usize {
                let Self::Asked { at: (shape, pose), displacement, ray, bounds, .. } = asked;
                let Lists { keys, near, rays, casts } = into;
                let (filter, at, point) = (Filter::new(), (shape, pose), pose.position());
                let mut answers = 0;
                world.boxes_overlapping(bounds, &filter, keys);
                answers += keys.len();
                world.overlapping_point(point, &filter, keys);
                answers += keys.len();
                world.overlapping(at, &filter, keys);
                answers += keys.len();
                world.within(point, WITHIN, &filter, near);
                answers += near.len();
                world.within_shape(at, WITHIN, &filter, near);
                answers += near.len();
                world.cast_ray_all(ray, 1.0, &filter, rays);
                world.cast_shape_all(at, *displacement, &filter, casts);
                answers + rays.len() + casts.len()
            }

            fn walk(world: &World<Self>, asked: &Self::Asked) -> bool {
                let Self::Asked { at: (shape, pose), displacement, walk, .. } = asked;
                let freed = world.depenetrate((shape, pose), &Filter::new());
                let slide = world.move_and_slide((shape, &freed.pose), *displacement, walk, &Filter::new());
                slide.ground.is_some() || !slide.walls.is_empty()
            }

            fn lines(world: &World<Self>) -> usize {
                let options = DebugOptions { boxes: true, columns: true, ..DebugOptions::default() };
                let mut lines = 0;
                world.debug_lines(&options, &mut |_, _, _| lines += 1);
                lines
            }

            fn comes_back(world: &World<Self>) -> bool {
                let snapshot = world.snapshot();
                World::restore(&snapshot).unwrap().snapshot() == snapshot
            }

            fn ground() -> Vec<Collider<Self>> {
                $ground()
            }
        }
    };
}

asker!(Volume, Asked3, NearAnswer3, RayAnswer3, CastAnswer3, asked3, ground3);
asker!(Plane, Asked2, NearAnswer2, RayAnswer2, CastAnswer2, asked2, ground2);

fn asked3(random: &mut Random, room: f64) -> Asked3 {
    let body = Volume::random_body(random, room);
    // A character cannot be ground, and a half-space cannot move.
    let shape = if body.shape().outer_radius().is_finite() { body.shape().clone() } else { random.cuboid() };
    let (pose, displacement) = (*body.pose(), random.vector().as_vec3() * 3.0);
    let (walk, middle) = (Walk3::new(&shape, Vec3::Y).unwrap(), pose.position().as_vec3());
    Asked3 {
        at: (shape, pose),
        displacement,
        ray: Ray3::new(pose.position(), displacement).unwrap(),
        bounds: Aabb3::new(middle - 1.0, middle + 1.0),
        walk,
    }
}

fn asked2(random: &mut Random, room: f64) -> Asked2 {
    let body = Plane::random_body(random, room);
    let (shape, unit) = (body.shape().clone(), Plane::unit_at(0.0));
    let shape = if shape.outer_radius().is_finite() { shape } else { unit.shape().clone() };
    let (pose, displacement) = (*body.pose(), random.direction2().as_vec2() * 3.0);
    let (walk, middle) = (Walk2::new(&shape, Vec2::Y).unwrap(), pose.position().as_vec2());
    Asked2 {
        at: (shape, pose),
        displacement,
        ray: Ray2::new(pose.position(), displacement).unwrap(),
        bounds: Aabb2::new(middle - 1.0, middle + 1.0),
        walk,
    }
}

fn ground3() -> Vec<Collider3> {
    let heights: Vec<f32> = (0..49).map(|number| [0.0, 0.3, -0.2, 0.1, 0.5][number * number % 5]).collect();
    let field = HeightField::new(7, 7, heights, Vec2::ONE).unwrap();
    let row = |z: f32| (0..7).map(move |x| Vec3::new(x as f32 - 3.0, 0.2 * (x % 3) as f32, z));
    let strip: Vec<[u32; 3]> = (0..6).flat_map(|x| [[x, x + 7, x + 1], [x + 1, x + 7, x + 8]]).collect();
    let mesh = TriMesh::new(row(-2.0).chain(row(2.0)).collect::<Vec<_>>(), strip).unwrap();
    vec![Collider3::new(field).at(Pose3::at([-3.0, -2.0, -3.0]).unwrap()), Collider3::new(mesh)]
}

fn ground2() -> Vec<Collider2> {
    let vertices = (0..13).map(|x| Vec2::new(0.5 * x as f32 - 3.0, [0.0, 0.4, -0.1, -0.1][x % 4]));
    vec![Collider2::new(Chain::open(vertices).unwrap())]
}
