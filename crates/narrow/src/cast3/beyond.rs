//! What a body meets next that touches some of the other already: a ball on a level's floor, and the level's wall.
//!
//! ```text
//! touched at the start: no answer, it is a contact already
//! every other part, where it is met first, by the normal n that it is met with:
//!   gap       along n at the start, no more than a 64th of the body's thickness, and
//!   closing   along n from the start to the deepest, less what goes into the touched anyway, no more than that too:
//!             it is level with what is touched, and passed over (the next triangle of a floor, a bend of half a degree)
//!   of compounds: a part that is flush with a touched one along the normal m of that contact is level too, unless the body sinks
//!             along m by half its thickness: ground has normals of its own for inner edges, where the side of the next slab
//!             of a floor looks like a wall
//!   else:     an impact
//! nothing until half a thickness of the way: what ground is in the manifolds there, and moved into, is an impact at the start
//! ```
//! The last is for ground that is touched but not told, since its neighbour tells of it: a ball in a hollow touches two faces where
//! they meet, stands on one, and runs into the other.
//!
//! What goes into the touched is what a game's solver takes out of the motion: (d.m) (m.n) for a contact's normal m. So a body
//! that is pressed to a floor runs over its seams and over bends that fall, and into ramps and walls. A body that passes over
//! ends no deeper in it than that 64th beyond what it does in the touched. What a motion sinks into the touched by all its
//! thickness, as a coin that falls for a frame while it lies, passes under what stands there.

use super::passage::{Course, Moment, Passage};
use crate::answer::Manifold3;
use crate::feature::Hint;
use crate::ground3::OnGround;
use crate::impact3::Impact3;
use crate::pair3::{Pair3, Part, for_parts};
use crate::polyhedron::closest::Placed;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::{NEXT_LEVEL, NEXT_THICKNESS};
use asunder_geometry::{Motion3, Shape3};
use core::cell::Cell;

/// Moments of a motion with a turn that are looked at: 6 degrees of a half turn apart, by which an arm comes 0.14 % further.
const MOMENTS: u32 = 32;

thread_local! {
    /// Memory for manifolds: who asks every frame allocates nothing.
    static LISTS: Cell<Vec<Vec<Manifold3>>> = const { Cell::new(Vec::new()) };
}

/// How two bodies touch at the start.
pub(super) struct Touched<'t> {
    manifolds: &'t [Manifold3],
    /// Which of the two are ground, and so have no thickness that counts.
    are_ground: [bool; 2],
}

/// Asks with what two bodies touch at the start.
pub(super) fn with_touched<R>(pair: &Pair3, ask: impl FnOnce(&Touched) -> R) -> R {
    let are_ground = [pair.shape_a.is_ground(), pair.shape_b.is_ground()];
    with_manifolds(pair, |manifolds| ask(&Touched { manifolds, are_ground }))
}

/// How what two parts meet with lies to what is touched.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lies {
    /// Further on.
    Ahead,
    /// Beside it, and gone into no further.
    Level,
    /// Beside it, and gone into.
    Across,
}

impl Touched<'_> {
    /// How it lies what two parts meet with along a unit axis from A to B.
    pub(super) fn lies(&self, passage: &Passage, parts: [Part; 2], normal: DVec3) -> Lies {
        let (core_a, core_b) = (parts[0].shape.core(), parts[1].shape.core());
        let thickness = self.thickness(&parts);
        let slack = NEXT_LEVEL * thickness;
        let course = Course::new(passage, parts, [&core_a, &core_b]);
        let (start, end) = (course.at(0.0), course.at(1.0));
        let gap = |moment: &Moment, axis: DVec3| gap_along(moment, axis) - course.radii;
        // Who turns may be in deepest on the way.
        let between = if passage.is_straight() { 0 } else { MOMENTS };
        let on_the_way = (1..between).map(|i| course.at(f64::from(i) / f64::from(MOMENTS)));
        let on_the_way: ArrayVec<Moment, { MOMENTS as usize }> = on_the_way.collect();
        let closing = |axis: DVec3| {
            let least = on_the_way.iter().fold(gap(&end, axis), |least, moment| least.min(gap(moment, axis)));
            gap(&start, axis) - least
        };
        let is_flush = |manifold: &Manifold3| {
            let touched = manifold.normal.as_dvec3();
            let above = gap(&start, touched);
            let lowest = f64::from(manifold.separation) - slack;
            above <= slack && above >= lowest && closing(touched) <= 0.5 * thickness
        };
        // Of ground that is known already: it has normals of its own for its inner edges.
        if self.are_ground == [false; 2] && self.manifolds.iter().any(is_flush) {
            return Lies::Level;
        }
        if gap(&start, normal) > slack {
            return Lies::Ahead;
        }
        let into = closing(normal);
        let anyway = |manifold: &Manifold3| {
            let touched = manifold.normal.as_dvec3();
            closing(touched).max(0.0) * touched.dot(normal).max(0.0)
        };
        let is_level = into <= slack || self.manifolds.iter().any(|it| into - anyway(it) <= slack);
        if is_level { Lies::Level } else { Lies::Across }
    }

    /// That of the thinner of two parts, from the middle, in metres; ground has none that counts.
    fn thickness(&self, parts: &[Part; 2]) -> f64 {
        let of = |i: usize| {
            let shape = parts[i].shape;
            let size = f64::from(shape.outer_radius());
            if self.are_ground[i] || !size.is_finite() {
                return f64::INFINITY;
            }
            let core = shape.core();
            let sum: DVec3 = core.vertices().iter().map(|vertex| vertex.as_dvec3()).sum();
            let middle = sum / core.vertices().len().max(1) as f64;
            let heights = core.normals().iter().zip(core.heights());
            let inner =
                heights.map(|(normal, height)| height - normal.dot(middle)).fold(f64::INFINITY, f64::min);
            let inner = if inner.is_finite() { inner.max(0.0) } else { 0.0 };
            let thickness = inner + f64::from(shape.radius());
            thickness.max(NEXT_THICKNESS * size)
        };
        let least = of(0).min(of(1));
        if least.is_finite() { least } else { 0.0 }
    }
}

/// The manifolds of a pair, in memory that is kept.
fn with_manifolds<R>(pair: &Pair3, ask: impl FnOnce(&[Manifold3]) -> R) -> R {
    let mut lists = LISTS.take();
    let mut manifolds = lists.pop().unwrap_or_default();
    LISTS.set(lists);
    manifolds.clear();
    let _ = pair.contact(0.0, Hint::NONE, Some(&mut manifolds));
    let answer = ask(&manifolds);
    let mut lists = LISTS.take();
    lists.push(manifolds);
    LISTS.set(lists);
    answer
}

impl Pair3<'_> {
    /// What ground is touched, not told, and gone into: seen from where half a thickness of the way is done, unless something
    /// else is met before.
    pub(super) fn across(
        &self,
        (on, passage): (&OnGround, &Passage),
        motions: [&Motion3; 2],
        touched: &Touched,
        first: Option<&Impact3>,
    ) -> Option<Impact3> {
        let mut thickness = f64::INFINITY;
        for_parts(on.body, &on.body_basis, |part| {
            thickness = thickness.min(touched.thickness(&on.in_order([part, part])));
            false
        });
        let arm = on.body.center().length() + on.body.outer_radius();
        let turned = if passage.is_straight() { 0.0 } else { 2.0 * f64::from(arm) };
        let ahead = (0.5 * thickness / (passage.drift.length() + turned)).min(1.0);
        if first.is_some_and(|first| first.fraction <= ahead) || !ahead.is_finite() {
            return None;
        }
        let [pose_a, pose_b] =
            [motions[0].pose_at(&self.pose_a, ahead), motions[1].pose_at(&self.pose_b, ahead)];
        let later = Pair3::new(self.shape_a, &pose_a, self.shape_b, &pose_b);
        let is_across = |manifold: &Manifold3| {
            let [of_body, of_ground] = on.in_order([manifold.part_a, manifold.part_b]);
            let triangle = on.ground.triangle(of_ground).map(Shape3::Triangle)?;
            let mut lies = Lies::Level;
            for_parts(on.body, &on.body_basis, |part| {
                let parts = on.in_order([part, Part::whole(&triangle, &on.basis)]);
                if part.index == of_body {
                    lies = touched.lies(passage, parts, manifold.normal.as_dvec3());
                }
                part.index == of_body
            });
            (lies == Lies::Across).then(|| at_start(manifold))
        };
        with_manifolds(&later, |manifolds| manifolds.iter().find_map(is_across))
    }
}

/// What is met by a manifold, which has points.
fn at_start(manifold: &Manifold3) -> Impact3 {
    let point = manifold.points.first();
    let [anchor_a, anchor_b] = point.map_or([Vec3::ZERO; 2], |point| [point.anchor_a, point.anchor_b]);
    let Manifold3 { normal, part_a, part_b, .. } = *manifold;
    Impact3 { fraction: 0.0, error: 0.0, overlapping: false, normal, anchor_a, anchor_b, part_a, part_b }
}

/// The gap between two cores along an axis.
fn gap_along(moment: &Moment, axis: DVec3) -> f64 {
    let reach = |placed: &Placed, axis: DVec3, origin: DVec3| match placed {
        Placed::Core(solid) => solid.support(axis).reach,
        Placed::HalfSpace(_) => axis.dot(origin),
    };
    -reach(&moment.a, axis, DVec3::ZERO) - reach(&moment.b, -axis, moment.between)
}
