//! All queries about one shape, one point and one ray, and how each body of the world relates to them.

use asunder::{
    CastAnswer, Circle, Collider, Filter, Manifold2, Manifold3, Motion2, Motion3, NearAnswer, Pair2, Pair3,
    Plane, Pose2, Pose3, Ray2, Ray3, RayAnswer, Shape2, Shape3, Space, Sphere, Touch2, Touch3, Volume, World,
};
use asunder_broad::Cast;
use asunder_narrow::{cast_ray2, cast_ray3};
use asunder_tests::cases::Random;
use asunder_tests::engine::{Engine, slot_of};
use core::fmt::Debug;
use core::ops::ControlFlow;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The arguments of the queries.
#[derive(Clone, Debug)]
pub(super) struct Asked<S: Questioned> {
    pub(super) shape: S::Shape,
    pub(super) pose: S::Pose,
    pub(super) point: S::Point,
    pub(super) within: f32,
    /// Starts at the point.
    pub(super) ray: S::Ray,
    pub(super) limit: f64,
    pub(super) displacement: S::Vector,
}

/// The result of every list query and every first-hit query.
#[derive(Debug, PartialEq)]
pub(super) struct All<K, N, P, M> {
    pub(super) boxes: Vec<K>,
    pub(super) holding: Vec<K>,
    pub(super) over: Vec<K>,
    pub(super) near_point: Vec<NearAnswer<K, N, P>>,
    pub(super) near_shape: Vec<NearAnswer<K, N, P>>,
    pub(super) closest: [Option<NearAnswer<K, N, P>>; 2],
    /// The shape's manifolds with bodies within the distance.
    pub(super) manifolds: Vec<(K, M)>,
    pub(super) rays: Vec<RayAnswer<K, N, P>>,
    pub(super) first_ray: Option<RayAnswer<K, N, P>>,
    pub(super) casts: Vec<CastAnswer<K, N, P>>,
    pub(super) first_cast: Option<CastAnswer<K, N, P>>,
    /// There is no list of these.
    pub(super) onwards: Option<CastAnswer<K, N, P>>,
}

pub(super) type Answers<S> =
    All<<S as Space>::Key, <S as Questioned>::Vector, <S as Questioned>::Point, <S as Space>::Manifold>;

pub(super) type Near<S> = NearAnswer<<S as Space>::Key, <S as Questioned>::Vector, <S as Questioned>::Point>;

/// How one body relates to the arguments, by the narrow phase alone.
pub(super) struct Judged {
    pub(super) boxes: bool,
    pub(super) holding: bool,
    pub(super) over: bool,
    /// Distances and their errors; `None` in overlap.
    pub(super) to_point: Option<(f32, f32)>,
    pub(super) to_shape: Option<(f32, f32)>,
    /// Distance along the ray, its error, and whether the ray starts inside.
    pub(super) along_ray: Option<(f64, f64, bool)>,
    /// Fraction of the displacement, and whether they overlap at the start.
    pub(super) along: Option<(f64, bool)>,
    /// The same, passing over what is touched at the start.
    pub(super) onwards: Option<f64>,
    /// Whether the body's AABB is beside the ray, or beside the path of the moving shape's AABB: then they meet only by
    /// rounding, if at all.
    pub(super) is_beside: [bool; 2],
}

/// A dimension, by its queries.
pub(super) trait Questioned: Engine {
    type Vector: Copy + Debug + PartialEq + Send + Sync;
    type Point: Copy + Debug + PartialEq + Send + Sync;
    type Ray: Clone + Debug + Send + Sync;

    /// The body, moved by `shift` along the first axis.
    fn shifted(body: Collider<Self>, shift: f64) -> Collider<Self>;
    /// A pose within `reach` of the place at `shift` on the first axis.
    fn pose_in(random: &mut Random, reach: f64, shift: f64) -> Self::Pose;
    /// Random arguments around that place.
    fn asked(random: &mut Random, reach: f64, shift: f64) -> Asked<Self>;
    /// Runs all queries that return lists.
    fn lists(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>);
    /// Runs the same queries with visitors.
    fn visits(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>);
    /// How a body relates to the arguments.
    fn judge(asked: &Asked<Self>, body: &Collider<Self>, touches: &[Self::Touch]) -> Judged;
    /// The shape's manifolds with a body within the distance, in the narrow phase's order.
    fn manifolds_with(asked: &Asked<Self>, body: &Collider<Self>) -> Vec<Self::Manifold>;
    /// What the shape touches of a body.
    fn touches_of(asked: &Asked<Self>, body: &Collider<Self>, to: &mut Vec<Self::Touch>);
    /// Asserts that the moving shape does not overlap the body before this fraction of the displacement.
    fn check_free(asked: &Asked<Self>, fraction: f64, body: &Collider<Self>);
    /// The distance of two points, and the largest coordinate of both.
    fn apart(one: Self::Point, other: Self::Point) -> (f64, f64);
}

fn no_answers<S: Questioned>() -> Answers<S> {
    All {
        boxes: vec![],
        holding: vec![],
        over: vec![],
        near_point: vec![],
        near_shape: vec![],
        closest: [None, None],
        manifolds: vec![],
        rays: vec![],
        first_ray: None,
        casts: vec![],
        first_cast: None,
        onwards: None,
    }
}

/// The world's answers.
pub(super) fn answers<S: Questioned>(
    world: &World<S>,
    asked: &Asked<S>,
    filter: &Filter<'_, S>,
) -> Answers<S> {
    let mut answers = no_answers::<S>();
    // Leftovers in the caller's list must be removed.
    answers.boxes.extend(S::bodies(world).first().map(|(key, _)| *key));
    S::lists(world, asked, filter, &mut answers);
    answers
}

/// The same answers without those of bodies that are touched at the start.
pub(super) fn not_touched<S: Questioned>(mut found: Answers<S>) -> Answers<S> {
    found.rays.retain(|hit| !hit.inside);
    found.casts.retain(|hit| !hit.overlapping);
    (found.first_ray, found.first_cast) = (found.rays.first().copied(), found.casts.first().copied());
    found
}

/// The visitors' answers, sorted.
pub(super) fn visited<S: Questioned>(
    world: &World<S>,
    asked: &Asked<S>,
    filter: &Filter<'_, S>,
) -> Answers<S> {
    let mut answers = no_answers::<S>();
    S::visits(world, asked, filter, &mut answers);
    let All { boxes, holding, over, near_point, near_shape, closest, manifolds, rays, casts, .. } =
        &mut answers;
    // Those of one body keep their order.
    manifolds.sort_by_key(|(key, _)| slot_of(*key));
    rays.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(slot_of(a.body).cmp(&slot_of(b.body))));
    casts.sort_by(|a, b| a.fraction.total_cmp(&b.fraction).then(slot_of(a.body).cmp(&slot_of(b.body))));
    for keys in [boxes, holding, over] {
        keys.sort_by_key(|key| slot_of(*key));
    }
    for (near, closest) in [near_point, near_shape].into_iter().zip(closest) {
        near.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(slot_of(a.body).cmp(&slot_of(b.body))));
        *closest = near.first().copied();
    }
    (answers.first_ray, answers.first_cast) = (answers.rays.first().copied(), answers.casts.first().copied());
    answers
}

impl Questioned for Volume {
    type Vector = Vec3;
    type Point = DVec3;
    type Ray = Ray3;

    fn shifted(body: Collider<Self>, shift: f64) -> Collider<Self> {
        let pose = *body.pose();
        body.at(Pose3::new(pose.position() + DVec3::X * shift, pose.rotation()).unwrap())
    }

    fn pose_in(random: &mut Random, reach: f64, shift: f64) -> Pose3 {
        let pose = Self::random_pose(random, reach);
        Pose3::new(pose.position() + DVec3::X * shift, pose.rotation()).unwrap()
    }

    fn asked(random: &mut Random, reach: f64, shift: f64) -> Asked<Self> {
        let asker = Self::random_body(random, reach);
        let point = Self::pose_in(random, reach, shift).position();
        let within = random.pick(&[0.0, 0.2, 1.0, 3.0, f32::INFINITY]);
        let along = random.vector().as_vec3() * random.pick(&[0.1, 1.0, 10.0]);
        // Some along an axis, where boxes may touch all the way.
        let along = if random.below(4) == 0 { Vec3::X * along.x } else { along };
        let ray = Ray3::new(point, along).unwrap();
        let limit = random.pick(&[0.0, 0.5, 3.0, f64::INFINITY]);
        let displacement = along * random.pick(&[0.0, 0.3, 1.0, 3.0]);
        let (shape, pose) = (asker.shape().clone(), *Self::shifted(asker, shift).pose());
        Asked { shape, pose, point, within, ray, limit, displacement }
    }

    fn lists(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>) {
        let Asked { shape, pose, point, within, ray, limit, displacement } = asked;
        let at = (shape, pose);
        world.boxes_overlapping(&shape.bounds(pose, 0.0), filter, &mut into.boxes);
        world.overlapping_point(*point, filter, &mut into.holding);
        world.overlapping(at, filter, &mut into.over);
        world.within(*point, *within, filter, &mut into.near_point);
        world.within_shape(at, *within, filter, &mut into.near_shape);
        world.manifolds(at, *within, filter, &mut into.manifolds);
        world.cast_ray_all(ray, *limit, filter, &mut into.rays);
        into.first_ray = world.cast_ray(ray, *limit, filter);
        world.cast_shape_all(at, *displacement, filter, &mut into.casts);
        into.first_cast = world.cast_shape(at, *displacement, filter);
        into.onwards = world.cast_shape_onwards(at, *displacement, filter);
        into.closest = [world.closest(*point, *within, filter), world.closest_to_shape(at, *within, filter)];
    }

    fn visits(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>) {
        let Asked { shape, pose, point, within, ray, limit, displacement } = asked;
        let at = (shape, pose);
        let _ = world.visit_boxes_overlapping(&shape.bounds(pose, 0.0), filter, push(&mut into.boxes));
        let _ = world.visit_overlapping_point(*point, filter, push(&mut into.holding));
        let _ = world.visit_overlapping(at, filter, push(&mut into.over));
        let _ = world.visit_within(*point, *within, filter, push(&mut into.near_point));
        let _ = world.visit_within_shape(at, *within, filter, push(&mut into.near_shape));
        let _ = world.visit_manifolds(at, *within, filter, |key, manifold| {
            into.manifolds.push((key, *manifold));
            ControlFlow::Continue(())
        });
        let _ = world.visit_ray(ray, *limit, filter, push(&mut into.rays));
        let _ = world.visit_cast_shape(at, *displacement, filter, push(&mut into.casts));
        into.onwards = world.cast_shape_onwards(at, *displacement, filter);
    }

    fn manifolds_with(asked: &Asked<Self>, body: &Collider<Self>) -> Vec<Manifold3> {
        Pair3::new(&asked.shape, &asked.pose, body.shape(), body.pose()).manifolds(asked.within)
    }

    fn touches_of(asked: &Asked<Self>, body: &Collider<Self>, to: &mut Vec<Touch3>) {
        Pair3::new(&asked.shape, &asked.pose, body.shape(), body.pose()).add_touches(to);
    }

    fn judge(asked: &Asked<Self>, body: &Collider<Self>, touches: &[Touch3]) -> Judged {
        let pair = Pair3::new(&asked.shape, &asked.pose, body.shape(), body.pose());
        let (dot, at) = (Shape3::from(Sphere::POINT), Pose3::at(asked.point).unwrap());
        let of_point = Pair3::new(&dot, &at, body.shape(), body.pose());
        let bounds = body.shape().bounds(body.pose(), 0.0);
        Judged {
            boxes: bounds.overlaps(&asked.shape.bounds(&asked.pose, 0.0)),
            holding: of_point.overlaps(),
            over: pair.overlaps(),
            to_point: of_point.distance().map(|closest| (closest.distance, closest.error)),
            to_shape: pair.distance().map(|closest| (closest.distance, closest.error)),
            along_ray: cast_ray3(body.shape(), body.pose(), &asked.ray, asked.limit).map(|hit| {
                let length = asked.ray.direction().as_dvec3().length();
                (hit.distance, f64::from(hit.error) / length, hit.inside)
            }),
            along: pair.cast(asked.displacement).map(|impact| (impact.fraction, impact.overlapping)),
            onwards: {
                let (way, still) = (Motion3::shift(asked.displacement).unwrap(), Motion3::STILL);
                // As for bullets: inside a sensor, the shape hits no other part of it.
                let met = pair.impact(&way, &still).filter(|impact| !impact.overlapping);
                if body.is_sensor() { met } else { pair.next_impact_beside(touches, &way, &still) }
            }
            .map(|impact| impact.fraction),
            is_beside: [
                Cast::from(asked.ray).meets(&bounds, f64::INFINITY).is_none(),
                Cast::of_box3(&asked.shape.bounds(&asked.pose, 0.0), asked.displacement)
                    .meets(&bounds, 1.0)
                    .is_none(),
            ],
        }
    }

    fn check_free(asked: &Asked<Self>, fraction: f64, body: &Collider<Self>) {
        // Slightly before, so that the rounding of the position causes no overlap.
        let moved = asked.displacement.as_dvec3() * fraction * (1.0 - 1e-6);
        let pose = Pose3::new(asked.pose.position() + moved, asked.pose.rotation()).unwrap();
        let pair = Pair3::new(&asked.shape, &pose, body.shape(), body.pose());
        assert!(!pair.overlaps(), "{fraction} is too late: {asked:?} meets {body:?}");
    }

    fn apart(one: DVec3, other: DVec3) -> (f64, f64) {
        (one.distance(other), one.abs().max_element().max(other.abs().max_element()))
    }
}

impl Questioned for Plane {
    type Vector = Vec2;
    type Point = DVec2;
    type Ray = Ray2;

    fn shifted(body: Collider<Self>, shift: f64) -> Collider<Self> {
        let pose = *body.pose();
        body.at(Pose2::new(pose.position() + DVec2::X * shift, pose.rotation()).unwrap())
    }

    fn pose_in(random: &mut Random, reach: f64, shift: f64) -> Pose2 {
        let pose = Self::random_pose(random, reach);
        Pose2::new(pose.position() + DVec2::X * shift, pose.rotation()).unwrap()
    }

    fn asked(random: &mut Random, reach: f64, shift: f64) -> Asked<Self> {
        let asker = Self::random_body(random, reach);
        let point = Self::pose_in(random, reach, shift).position();
        let within = random.pick(&[0.0, 0.2, 1.0, 3.0, f32::INFINITY]);
        let along = random.vector().truncate().as_vec2() * random.pick(&[0.1, 1.0, 10.0]);
        // Some along an axis, where boxes may touch all the way.
        let along = if random.below(4) == 0 { Vec2::X * along.x } else { along };
        let ray = Ray2::new(point, along).unwrap();
        let limit = random.pick(&[0.0, 0.5, 3.0, f64::INFINITY]);
        let displacement = along * random.pick(&[0.0, 0.3, 1.0, 3.0]);
        let (shape, pose) = (asker.shape().clone(), *Self::shifted(asker, shift).pose());
        Asked { shape, pose, point, within, ray, limit, displacement }
    }

    fn lists(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>) {
        let Asked { shape, pose, point, within, ray, limit, displacement } = asked;
        let at = (shape, pose);
        world.boxes_overlapping(&shape.bounds(pose, 0.0), filter, &mut into.boxes);
        world.overlapping_point(*point, filter, &mut into.holding);
        world.overlapping(at, filter, &mut into.over);
        world.within(*point, *within, filter, &mut into.near_point);
        world.within_shape(at, *within, filter, &mut into.near_shape);
        world.manifolds(at, *within, filter, &mut into.manifolds);
        world.cast_ray_all(ray, *limit, filter, &mut into.rays);
        into.first_ray = world.cast_ray(ray, *limit, filter);
        world.cast_shape_all(at, *displacement, filter, &mut into.casts);
        into.first_cast = world.cast_shape(at, *displacement, filter);
        into.onwards = world.cast_shape_onwards(at, *displacement, filter);
        into.closest = [world.closest(*point, *within, filter), world.closest_to_shape(at, *within, filter)];
    }

    fn visits(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>) {
        let Asked { shape, pose, point, within, ray, limit, displacement } = asked;
        let at = (shape, pose);
        let _ = world.visit_boxes_overlapping(&shape.bounds(pose, 0.0), filter, push(&mut into.boxes));
        let _ = world.visit_overlapping_point(*point, filter, push(&mut into.holding));
        let _ = world.visit_overlapping(at, filter, push(&mut into.over));
        let _ = world.visit_within(*point, *within, filter, push(&mut into.near_point));
        let _ = world.visit_within_shape(at, *within, filter, push(&mut into.near_shape));
        let _ = world.visit_manifolds(at, *within, filter, |key, manifold| {
            into.manifolds.push((key, *manifold));
            ControlFlow::Continue(())
        });
        let _ = world.visit_ray(ray, *limit, filter, push(&mut into.rays));
        let _ = world.visit_cast_shape(at, *displacement, filter, push(&mut into.casts));
        into.onwards = world.cast_shape_onwards(at, *displacement, filter);
    }

    fn manifolds_with(asked: &Asked<Self>, body: &Collider<Self>) -> Vec<Manifold2> {
        Pair2::new(&asked.shape, &asked.pose, body.shape(), body.pose()).manifolds(asked.within)
    }

    fn touches_of(asked: &Asked<Self>, body: &Collider<Self>, to: &mut Vec<Touch2>) {
        Pair2::new(&asked.shape, &asked.pose, body.shape(), body.pose()).add_touches(to);
    }

    fn judge(asked: &Asked<Self>, body: &Collider<Self>, touches: &[Touch2]) -> Judged {
        let pair = Pair2::new(&asked.shape, &asked.pose, body.shape(), body.pose());
        let (dot, at) = (Shape2::from(Circle::POINT), Pose2::at(asked.point).unwrap());
        let of_point = Pair2::new(&dot, &at, body.shape(), body.pose());
        let bounds = body.shape().bounds(body.pose(), 0.0);
        Judged {
            boxes: bounds.overlaps(&asked.shape.bounds(&asked.pose, 0.0)),
            holding: of_point.overlaps(),
            over: pair.overlaps(),
            to_point: of_point.distance().map(|closest| (closest.distance, closest.error)),
            to_shape: pair.distance().map(|closest| (closest.distance, closest.error)),
            along_ray: cast_ray2(body.shape(), body.pose(), &asked.ray, asked.limit).map(|hit| {
                let length = asked.ray.direction().as_dvec2().length();
                (hit.distance, f64::from(hit.error) / length, hit.inside)
            }),
            along: pair.cast(asked.displacement).map(|impact| (impact.fraction, impact.overlapping)),
            onwards: {
                let (way, still) = (Motion2::shift(asked.displacement).unwrap(), Motion2::STILL);
                // As for bullets: inside a sensor, the shape hits no other part of it.
                let met = pair.impact(&way, &still).filter(|impact| !impact.overlapping);
                if body.is_sensor() { met } else { pair.next_impact_beside(touches, &way, &still) }
            }
            .map(|impact| impact.fraction),
            is_beside: [
                Cast::from(asked.ray).meets(&bounds, f64::INFINITY).is_none(),
                Cast::of_box2(&asked.shape.bounds(&asked.pose, 0.0), asked.displacement)
                    .meets(&bounds, 1.0)
                    .is_none(),
            ],
        }
    }

    fn check_free(asked: &Asked<Self>, fraction: f64, body: &Collider<Self>) {
        // Slightly before, so that the rounding of the position causes no overlap.
        let moved = asked.displacement.as_dvec2() * fraction * (1.0 - 1e-6);
        let pose = Pose2::new(asked.pose.position() + moved, asked.pose.rotation()).unwrap();
        let pair = Pair2::new(&asked.shape, &pose, body.shape(), body.pose());
        assert!(!pair.overlaps(), "{fraction} is too late: {asked:?} meets {body:?}");
    }

    fn apart(one: DVec2, other: DVec2) -> (f64, f64) {
        (one.distance(other), one.abs().max_element().max(other.abs().max_element()))
    }
}

/// A visitor that keeps everything.
fn push<T>(into: &mut Vec<T>) -> impl FnMut(T) -> ControlFlow<()> {
    into.clear();
    |answer| {
        into.push(answer);
        ControlFlow::Continue(())
    }
}
