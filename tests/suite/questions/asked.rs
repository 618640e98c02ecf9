//! All questions about one shape, one point and one ray, and what each body of the world has to do with them.

use super::sieve::{Allowed, Sieve};
use asunder::{
    CastAnswer, Circle, Collider, Filter, Motion2, Motion3, NearAnswer, Pair2, Pair3, Plane, Pose2, Pose3,
    Ray2, Ray3, RayAnswer, Shape2, Shape3, Space, Sphere, Touch2, Touch3, Volume, World,
};
use asunder_broad::Cast;
use asunder_narrow::{cast_ray2, cast_ray3};
use asunder_tests::cases::Random;
use asunder_tests::engine::{Engine, slot_of};
use core::fmt::Debug;
use core::ops::ControlFlow;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// What is asked.
#[derive(Clone, Debug)]
pub(super) struct Asked<S: Questioned> {
    pub(super) shape: S::Shape,
    pub(super) pose: S::Pose,
    pub(super) point: S::Point,
    pub(super) within: f32,
    /// From the point.
    pub(super) ray: S::Ray,
    pub(super) limit: f64,
    pub(super) displacement: S::Vector,
}

/// Every list and every first answer.
#[derive(Debug, PartialEq)]
pub(super) struct All<K, N, P> {
    pub(super) boxes: Vec<K>,
    pub(super) holding: Vec<K>,
    pub(super) over: Vec<K>,
    pub(super) near_point: Vec<NearAnswer<K, N, P>>,
    pub(super) near_shape: Vec<NearAnswer<K, N, P>>,
    pub(super) closest: [Option<NearAnswer<K, N, P>>; 2],
    pub(super) rays: Vec<RayAnswer<K, N, P>>,
    pub(super) first_ray: Option<RayAnswer<K, N, P>>,
    pub(super) casts: Vec<CastAnswer<K, N, P>>,
    pub(super) first_cast: Option<CastAnswer<K, N, P>>,
    /// There is no list of these.
    pub(super) onwards: Option<CastAnswer<K, N, P>>,
}

pub(super) type Answers<S> = All<<S as Space>::Key, <S as Questioned>::Vector, <S as Questioned>::Point>;

type Near<S> = NearAnswer<<S as Space>::Key, <S as Questioned>::Vector, <S as Questioned>::Point>;

/// What one body has to do with what is asked, from the narrow phase alone.
pub(super) struct Judged {
    boxes: bool,
    holding: bool,
    over: bool,
    /// Distances and their errors; overlapping bodies have none.
    to_point: Option<(f32, f32)>,
    to_shape: Option<(f32, f32)>,
    /// Distance along the ray, what it may be off by, and whether it starts inside.
    along_ray: Option<(f64, f64, bool)>,
    /// Fraction of the displacement, and whether they overlap already.
    along: Option<(f64, bool)>,
    /// The same, but for what they touch already.
    onwards: Option<f64>,
    /// Whether the body's box is beside the ray, or the way of the moved shape's box: then they meet by rounding at
    /// most.
    is_beside: [bool; 2],
}

/// A dimension, by its questions.
pub(super) trait Questioned: Engine {
    type Vector: Copy + Debug + PartialEq + Send + Sync;
    type Point: Copy + Debug + PartialEq + Send + Sync;
    type Ray: Clone + Debug + Send + Sync;

    /// The body, that far along the first axis.
    fn shifted(body: Collider<Self>, shift: f64) -> Collider<Self>;
    /// A pose within `reach` of a place that far along the first axis.
    fn pose_in(random: &mut Random, reach: f64, shift: f64) -> Self::Pose;
    /// Something to ask there.
    fn asked(random: &mut Random, reach: f64, shift: f64) -> Asked<Self>;
    /// The shape of a body and a point of it, or near it.
    fn lists(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>);
    /// The same by visitors.
    fn visits(world: &World<Self>, asked: &Asked<Self>, filter: &Filter<'_, Self>, into: &mut Answers<Self>);
    /// What a body has to do with it.
    fn judge(asked: &Asked<Self>, body: &Collider<Self>, touches: &[Self::Touch]) -> Judged;
    /// What the shape touches of a body.
    fn touches_of(asked: &Asked<Self>, body: &Collider<Self>, to: &mut Vec<Self::Touch>);
    /// Fails if the moved shape overlaps the body before this share of the displacement.
    fn check_free(asked: &Asked<Self>, fraction: f64, body: &Collider<Self>);
    /// How far two points are apart, and the largest coordinate of both.
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
        rays: vec![],
        first_ray: None,
        casts: vec![],
        first_cast: None,
        onwards: None,
    }
}

/// What the world says.
pub(super) fn answers<S: Questioned>(
    world: &World<S>,
    asked: &Asked<S>,
    filter: &Filter<'_, S>,
) -> Answers<S> {
    let mut answers = no_answers::<S>();
    // Leftovers in a caller's list must go.
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

/// What visitors are told, put in order.
pub(super) fn visited<S: Questioned>(
    world: &World<S>,
    asked: &Asked<S>,
    filter: &Filter<'_, S>,
) -> Answers<S> {
    let mut answers = no_answers::<S>();
    S::visits(world, asked, filter, &mut answers);
    let All { boxes, holding, over, near_point, near_shape, closest, rays, casts, .. } = &mut answers;
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

/// Bodies that pass a filter, in order of their slots.
fn passing<S: Questioned>(world: &World<S>, allowed: &Allowed<S>) -> Vec<(S::Key, Collider<S>)> {
    S::bodies(world).into_iter().filter(|(key, body)| allowed(*key, body)).collect()
}

/// Fails unless the world says of every body what the narrow phase says of it.
pub(super) fn check<S: Questioned>(world: &World<S>, asked: &Asked<S>, sieve: &Sieve<S>, found: &Answers<S>) {
    let bodies = passing(world, &sieve.allowed);
    let mut touches = Vec::new();
    for (_, body) in bodies.iter().filter(|(_, body)| !body.is_sensor()) {
        S::touches_of(asked, body, &mut touches);
    }
    let judge = |(key, body): (S::Key, Collider<S>)| {
        let judged = S::judge(asked, &body, &touches);
        (key, body, judged)
    };
    let passing: Vec<(S::Key, Collider<S>, Judged)> = bodies.into_iter().map(judge).collect();
    check_casts(asked, &passing, found);
    check_onwards(asked, &passing, found);
    let keys = |is_wanted: fn(&Judged) -> bool| -> Vec<S::Key> {
        passing.iter().filter(|(_, _, judged)| is_wanted(judged)).map(|(key, _, _)| *key).collect()
    };
    assert_eq!(found.boxes, keys(|judged| judged.boxes), "boxes that overlap {asked:?}");
    assert_eq!(found.holding, keys(|judged| judged.holding), "bodies that hold the point of {asked:?}");
    assert_eq!(found.over, keys(|judged| judged.over), "bodies that overlap {asked:?}");
    let to_point: Vec<_> = passing.iter().map(|(key, _, judged)| (*key, judged.to_point)).collect();
    let to_shape: Vec<_> = passing.iter().map(|(key, _, judged)| (*key, judged.to_shape)).collect();
    check_near::<S>(asked, &to_point, &found.near_point);
    check_near::<S>(asked, &to_shape, &found.near_shape);
    let firsts = [found.near_point.first(), found.near_shape.first()];
    assert_eq!(found.closest.each_ref().map(Option::as_ref), firsts, "the closest is the first of all");
    for (near, point) in found.near_point.iter().map(|near| (near, asked.point)) {
        assert_eq!(near.from, point);
        assert!(!near.overlapping || near.point == point, "a point in a body is the closest of it");
    }
}

/// Fails unless rays and moved shapes meet who the narrow phase says they do.
fn check_casts<S: Questioned>(
    asked: &Asked<S>,
    judged: &[(S::Key, Collider<S>, Judged)],
    found: &Answers<S>,
) -> usize {
    let ranks: Vec<_> = found.rays.iter().map(|hit| (hit.distance, slot_of(hit.body))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "by distance, then by slot: {ranks:?}");
    let ranks: Vec<_> = found.casts.iter().map(|hit| (hit.fraction, slot_of(hit.body))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "by fraction, then by slot: {ranks:?}");
    assert_eq!(
        (found.first_ray, found.first_cast),
        (found.rays.first().copied(), found.casts.first().copied())
    );
    let (mut grazes, mut known) = (0, 0);
    for (key, body, judged) in judged {
        match (found.rays.iter().find(|hit| hit.body == *key), judged.along_ray) {
            (None, None) => {}
            (None, Some((distance, error, inside))) => {
                grazes += usize::from(judged.is_beside[0]);
                let is_late = distance + error > asked.limit;
                assert!(!inside && (judged.is_beside[0] || is_late), "lost {key:?} at {distance}: {asked:?}");
            }
            (Some(hit), None) => panic!("{hit:?}, of which the narrow phase knows nothing: {asked:?}"),
            (Some(hit), Some((distance, error, inside))) => {
                known += 1;
                assert_eq!((hit.inside, hit.inside && hit.distance > 0.0), (inside, false));
                let is_near = hit.distance >= distance && hit.distance <= distance + error;
                assert!(
                    is_near && hit.distance <= asked.limit,
                    "{hit:?} for {distance} +- {error}: {asked:?}"
                );
            }
        }
        match (found.casts.iter().find(|hit| hit.body == *key), judged.along) {
            (None, None) => {}
            (None, Some((fraction, overlapping))) => {
                grazes += 1;
                assert!(!overlapping && judged.is_beside[1], "lost {key:?} at {fraction}: {asked:?}");
            }
            (Some(hit), None) => panic!("{hit:?}, of which the narrow phase knows nothing: {asked:?}"),
            (Some(hit), Some((fraction, overlapping))) => {
                known += 1;
                assert_eq!((hit.overlapping, hit.overlapping && hit.fraction > 0.0), (overlapping, false));
                assert!(hit.fraction >= fraction && hit.fraction <= 1.0, "{hit:?} for {fraction}: {asked:?}");
                if hit.fraction > fraction {
                    S::check_free(asked, hit.fraction, body);
                }
            }
        }
    }
    assert!(grazes == 0 || grazes * 100 < known, "{grazes} grazes of {known}: too many to be rounding");
    known
}

/// Fails unless a moved shape runs into the first that the narrow phase says it does, but for what it touches.
fn check_onwards<S: Questioned>(
    asked: &Asked<S>,
    judged: &[(S::Key, Collider<S>, Judged)],
    found: &Answers<S>,
) {
    // A box may say that a body is met later than a cast does, by no more than that errs.
    let is_same = |told: f64, truth: f64| told >= truth && told <= truth + 1e-5;
    let first = found.onwards.map_or(f64::INFINITY, |hit| hit.fraction);
    for (key, _, judged) in judged.iter().filter(|(.., judged)| !judged.is_beside[1]) {
        let is_first = judged.onwards.is_none_or(|fraction| first <= fraction || is_same(first, fraction));
        assert!(is_first, "{key:?} is met at {:?}: {:?} {asked:?}", judged.onwards, found.onwards);
    }
    if let Some(hit) = found.onwards {
        let truth = judged.iter().find(|(key, ..)| *key == hit.body).and_then(|(.., judged)| judged.onwards);
        assert!(truth.is_some_and(|truth| is_same(hit.fraction, truth)), "{hit:?} for {truth:?}: {asked:?}");
    }
}

/// A body, and its distance with the judge's error, if it is apart.
type Truth<S> = (<S as asunder::Space>::Key, Option<(f32, f32)>);

fn check_near<S: Questioned>(asked: &Asked<S>, judged: &[Truth<S>], found: &[Near<S>]) {
    let ranks: Vec<_> = found.iter().map(|near| (near.distance, slot_of(near.body))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "by distance, then by slot: {ranks:?}");
    let limit = f64::from(asked.within.max(0.0));
    for &(key, truth) in judged {
        let near = found.iter().find(|near| near.body == key);
        let (distance, error) =
            truth.map_or((0.0, 0.0), |(distance, error)| (distance.into(), f64::from(error)));
        let Some(near) = near else {
            assert!(distance + error > limit, "lost {key:?}, {distance} +- {error} m away, of {asked:?}");
            continue;
        };
        assert_eq!(near.overlapping, truth.is_none(), "{near:?} of {asked:?}");
        assert_eq!(f64::from(near.error), error);
        assert!(
            near.distance <= limit && near.distance >= distance && near.distance <= distance + error,
            "{near:?}"
        );
        let (apart, most) = S::apart(near.from, near.point);
        // Anchors are f32, and some metres long, those of half-spaces tens of metres; points lose what f64 has not.
        let lost = 1e-6 * (near.distance + 20.0) + 4.0 * f64::EPSILON * most;
        assert!(
            near.overlapping || (apart - near.distance).abs() <= error + lost,
            "{apart}: {near:?} of {asked:?}"
        );
    }
    assert!(
        found.iter().all(|near| judged.iter().any(|(key, _)| *key == near.body)),
        "somebody who may not be found"
    );
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
        // Some along an axis, where boxes touch all the way.
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
        let _ = world.visit_ray(ray, *limit, filter, push(&mut into.rays));
        let _ = world.visit_cast_shape(at, *displacement, filter, push(&mut into.casts));
        into.onwards = world.cast_shape_onwards(at, *displacement, filter);
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
                // As bullets meet: what is in a sensor runs into no other part of it.
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
        // A hair before, so that a rounding of the position is no overlap.
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
        // Some along an axis, where boxes touch all the way.
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
        let _ = world.visit_ray(ray, *limit, filter, push(&mut into.rays));
        let _ = world.visit_cast_shape(at, *displacement, filter, push(&mut into.casts));
        into.onwards = world.cast_shape_onwards(at, *displacement, filter);
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
                // As bullets meet: what is in a sensor runs into no other part of it.
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
        // A hair before, so that a rounding of the position is no overlap.
        let moved = asked.displacement.as_dvec2() * fraction * (1.0 - 1e-6);
        let pose = Pose2::new(asked.pose.position() + moved, asked.pose.rotation()).unwrap();
        let pair = Pair2::new(&asked.shape, &pose, body.shape(), body.pose());
        assert!(!pair.overlaps(), "{fraction} is too late: {asked:?} meets {body:?}");
    }

    fn apart(one: DVec2, other: DVec2) -> (f64, f64) {
        (one.distance(other), one.abs().max_element().max(other.abs().max_element()))
    }
}

/// A visitor that keeps all that it is told.
fn push<T>(into: &mut Vec<T>) -> impl FnMut(T) -> ControlFlow<()> {
    into.clear();
    |answer| {
        into.push(answer);
        ControlFlow::Continue(())
    }
}
