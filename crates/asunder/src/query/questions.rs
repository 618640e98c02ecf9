//! Queries, each as a set of boxes and a test of a body.

use super::answer::Met;
use super::filter::Filter;
use super::space::{Asked, Enter, Meet, Near, Posed};
use super::walk::{Asks, Question, Reach, with_kept};
use crate::collider::Collider;
use crate::space::RunsInto;
use crate::world::{World, slot_of};
use asunder_geometry::{DirectionError, RayError, tolerance};
use core::cell::Cell;
use core::ops::ControlFlow;

thread_local! {
    /// Slots of bodies that are sorted before the narrow phase.
    static SLOTS: Cell<Vec<u32>> = const { Cell::new(Vec::new()) };
}

/// The limit of a distance: a NaN counts as none, and a negative one as zero.
fn limit_of(limit: f64) -> f64 {
    if limit.is_nan() { f64::INFINITY } else { limit.max(0.0) }
}

/// Which bodies' boxes overlap a box.
pub(crate) fn boxes_over<'q, S: Asked>(
    world: &'q World<S>,
    bounds: &S::Aabb,
    filter: &'q Filter<'q, S>,
) -> Question<'q, S, impl Asks<S, Met<S::Key>>> {
    let ask = |key, _: &_| Some(Met(key));
    // The body's exact box decides, not only one that holds it.
    let bounds_of = |shape: &S::Shape, pose: &S::Pose| S::bounds(shape, pose, 0.0);
    Question { world, filter, reach: Reach::Over(*bounds), bounds_of, limit: 0.0, ask }
}

/// Visits each body whose box overlaps a box, in no promised order, until the visitor breaks off.
pub(crate) fn visit_bodies_in<S: Asked>(
    (world, filter): (&World<S>, &Filter<'_, S>),
    bounds: &S::Aabb,
    mut visitor: impl FnMut(S::Key, &Collider<S>) -> ControlFlow<()>,
) -> ControlFlow<()> {
    boxes_over(world, bounds, filter).visit(|Met(key)| match world.bodies.get(key) {
        Some(body) => visitor(key, body),
        None => ControlFlow::Continue(()),
    })
}

/// Which bodies overlap a shape.
pub(crate) fn bodies_over<'q, S: Asked>(
    world: &'q World<S>,
    at: Posed<'q, S>,
    filter: &'q Filter<'q, S>,
) -> Question<'q, S, impl Asks<S, Met<S::Key>>> {
    let ask = move |key, body: &_| S::overlaps(at, body).then_some(Met(key));
    let reach = Reach::Over(S::bounds(at.0, at.1, 0.0));
    Question { world, filter, reach, bounds_of: S::bounds_at_once, limit: 0.0, ask }
}

/// The box around a shape and a margin; a NaN counts as none.
fn bounds_around<S: Asked>(at: Posed<'_, S>, margin: f32) -> S::Aabb {
    S::bounds(at.0, at.1, margin.max(0.0))
}

/// Visits the manifolds of a shape with each body within a margin, bodies in no promised order, until the visitor
/// breaks off.
pub(crate) fn visit_manifolds<S: Asked>(
    (world, filter): (&World<S>, &Filter<'_, S>),
    at: Posed<'_, S>,
    margin: f32,
    mut visitor: impl FnMut(S::Key, &S::Manifold) -> ControlFlow<()>,
) -> ControlFlow<()> {
    visit_bodies_in((world, filter), &bounds_around::<S>(at, margin), |key, body| {
        let mut flow = ControlFlow::Continue(());
        S::visit_manifolds(at, body, margin, |manifold| {
            if flow.is_continue() {
                flow = visitor(key, manifold);
            }
        });
        flow
    })
}

/// Whether nothing is on a ray up to its end, or, where the ray has no length, at the point `from`.
pub(crate) fn is_clear<S: Asked>(
    (world, filter): (&World<S>, &Filter<'_, S>),
    ray: Result<S::Ray, RayError>,
    from: S::Point,
) -> bool {
    match ray {
        Ok(ray) => bodies_along_ray(world, &ray, 1.0, filter).visit(|_| ControlFlow::Break(())).is_continue(),
        // All that is met is touched at the start.
        Err(RayError::Direction(DirectionError::Zero)) => {
            let point = S::point(from).filter(|_| filter.admits_start(true));
            point.is_none_or(|(shape, pose)| {
                bodies_over(world, (&shape, &pose), filter).visit(|_| ControlFlow::Break(())).is_continue()
            })
        }
        Err(_) => false,
    }
}

/// Replaces `into` by the manifolds of a shape with each body within a margin, by the bodies' slots.
pub(crate) fn manifolds<S: Asked>(
    (world, filter): (&World<S>, &Filter<'_, S>),
    at: Posed<'_, S>,
    margin: f32,
    into: &mut Vec<(S::Key, S::Manifold)>,
) {
    into.clear();
    // Bodies are sorted, not manifolds: those of one body are in order already, and are larger.
    with_kept(&SLOTS, |slots| {
        slots.clear();
        let _ = boxes_over(world, &bounds_around::<S>(at, margin), filter).visit(|Met(key)| {
            slots.push(slot_of(key));
            ControlFlow::Continue(())
        });
        slots.sort_unstable();
        for &slot in &*slots {
            let Some(&key) = world.keys.get(slot as usize) else { continue };
            if let Some(body) = world.bodies.get(key) {
                S::visit_manifolds(at, body, margin, |manifold| into.push((key, manifold.clone())));
            }
        }
    });
}

/// Which bodies are near a shape.
pub(crate) fn bodies_near<'q, S: Asked>(
    world: &'q World<S>,
    at: Posed<'q, S>,
    within: f32,
    filter: &'q Filter<'q, S>,
) -> Question<'q, S, impl Asks<S, Near<S>>> {
    let ask = move |key, body: &_| Some(S::near(at, key, body));
    let reach = Reach::Around(S::bounds(at.0, at.1, 0.0));
    Question { world, filter, reach, bounds_of: S::bounds_at_once, limit: limit_of(within.into()), ask }
}

/// Which bodies a ray meets.
pub(crate) fn bodies_along_ray<'q, S: Asked>(
    world: &'q World<S>,
    ray: &'q S::Ray,
    limit: f64,
    filter: &'q Filter<'q, S>,
) -> Question<'q, S, impl Asks<S, Enter<S>>> {
    let limit = limit_of(limit);
    let ask = move |key, body: &_| {
        S::enter(ray, limit, key, body).filter(|entered| filter.admits_start(entered.inside))
    };
    let reach = Reach::Along(S::along_ray(ray));
    Question { world, filter, reach, bounds_of: S::bounds_at_once, limit, ask }
}

/// Which bodies a moved shape meets.
pub(crate) fn bodies_along<'q, S: Asked>(
    world: &'q World<S>,
    at: Posed<'q, S>,
    displacement: S::Vector,
    filter: &'q Filter<'q, S>,
) -> Question<'q, S, impl Asks<S, Meet<S>>> {
    moved((world, filter), at, displacement, move |key, body| {
        let (fraction, impact) = S::meet(at, displacement, body)?;
        let met = S::met(fraction, &impact, key, body);
        filter.admits_start(met.overlapping).then_some(met)
    })
}

/// Where a moved shape first meets, of each body, a part that counts.
pub(crate) fn parts_along<'q, S: Asked>(
    world: &'q World<S>,
    at: Posed<'q, S>,
    displacement: S::Vector,
    filter: &'q Filter<'q, S>,
    counts: &'q dyn Fn(&Meet<S>) -> bool,
) -> Question<'q, S, impl Asks<S, Meet<S>>> {
    moved((world, filter), at, displacement, move |key, body| {
        S::meet_if(at, displacement, (key, body), counts)
    })
}

/// The first part that a moved shape runs into, except those that it touches at the start and those flush with them.
pub(crate) fn first_ahead<S: Asked>(
    world: &World<S>,
    at: Posed<'_, S>,
    displacement: S::Vector,
    filter: &Filter<'_, S>,
) -> Option<Meet<S>> {
    // If nothing is met, the touches do not matter.
    let first = bodies_ahead((world, filter), at, displacement, &[]).first()?;
    with_kept(S::kept_touches(), |touches| {
        touches.clear();
        let _ = visit_bodies_in((world, filter), &S::bounds(at.0, at.1, 0.0), |_, body| {
            if !body.sensor {
                S::add_touches(at, body, touches);
            }
            ControlFlow::Continue(())
        });
        if touches.is_empty() {
            return Some(first);
        }
        bodies_ahead((world, filter), at, displacement, touches).first()
    })
}

/// Which bodies a moved shape runs into, except for parts that it touches at the start and those flush with them.
fn bodies_ahead<'q, S: Asked>(
    (world, filter): (&'q World<S>, &'q Filter<'q, S>),
    at: Posed<'q, S>,
    displacement: S::Vector,
    touches: &'q [S::Touch],
) -> Question<'q, S, impl Asks<S, Meet<S>>> {
    // A displacement from one end of the world to the other is longer than a motion may be: then each moves half of it
    // towards the other.
    let share = (2.0 * tolerance::MAX_POSITION / S::longest(displacement)).min(1.0);
    let is_far = share * S::longest(displacement) > tolerance::MAX_POSITION;
    moved((world, filter), at, displacement, move |key, body| {
        let motions = if is_far {
            [Some(S::shift(displacement, 0.5 * share)?), Some(S::shift(displacement, -0.5 * share)?)]
        } else {
            [Some(S::shift(displacement, share)?), None]
        };
        let runs_into = if body.sensor { RunsInto::Sensor } else { RunsInto::Solid(touches) };
        let (fraction, impact) = S::impact([at, (&body.shape, &body.pose)], runs_into, motions)?;
        Some(S::met(fraction * share, &impact, key, body))
    })
}

/// Which bodies a moved shape meets, by a narrow-phase call.
fn moved<'q, S: Asked>(
    (world, filter): (&'q World<S>, &'q Filter<'q, S>),
    at: Posed<'q, S>,
    displacement: S::Vector,
    ask: impl Fn(S::Key, &Collider<S>) -> Option<Meet<S>>,
) -> Question<'q, S, impl Asks<S, Meet<S>>> {
    let reach = Reach::Along(S::along(&S::bounds(at.0, at.1, 0.0), displacement));
    Question { world, filter, reach, bounds_of: S::bounds_at_once, limit: 1.0, ask }
}
