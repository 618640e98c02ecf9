//! What a body that already touches some of another meets next, in space: see [`level`](crate::level).

use super::at_start;
use super::passage::{Course, Moment, Passage};
use crate::answer::Manifold3;
use crate::ground3::OnGround;
use crate::impact3::Impact3;
use crate::level::{Contacts, Lies, Passing, half_through, thickness, thinner};
use crate::lists::with_manifolds3;
use crate::pair3::{Pair3, Part, for_parts};
use crate::touch::Touch3;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Motion3, Shape3};

/// Sampled moments in a motion with a turn: 6 degrees apart in a half turn, within which an arm reaches 0.14 % further.
pub(super) const MOMENTS: u32 = 32;

/// What is touched at the start.
pub(super) struct Touched<'t> {
    /// The contacts between the two bodies, if they touch.
    contacts: Option<Contacts<'t, Manifold3>>,
    /// All that A touches, B perhaps among it.
    beside: Contacts<'t, Touch3>,
    /// Which of the two are ground, whose thickness does not count.
    are_ground: [bool; 2],
}

/// Calls `run` with what is touched at the start: the contacts between the two, if they touch, and all that A touches.
pub(super) fn with_touched<R>(
    pair: &Pair3,
    (do_touch, touches): (bool, &[Touch3]),
    run: impl FnOnce(&Touched) -> R,
) -> R {
    let are_ground = [pair.shape_a.is_ground(), pair.shape_b.is_ground()];
    let size = pair.shape_a.outer_radius().min(pair.shape_b.outer_radius());
    let beside = Contacts::new(touches, size);
    if !do_touch {
        return run(&Touched { contacts: None, beside, are_ground });
    }
    with_manifolds3(pair, 0.0, |manifolds| {
        run(&Touched { contacts: Some(Contacts::new(manifolds, size)), beside, are_ground })
    })
}

impl Touched<'_> {
    /// Classifies the meeting of two parts at a fraction, along a unit axis from A to B; at fraction 0, their touch at
    /// the start.
    pub(super) fn lies(&self, passage: &Passage, parts: [Part; 2], (fraction, normal): (f64, DVec3)) -> Lies {
        let (core_a, core_b) = (parts[0].shape.core(), parts[1].shape.core());
        let course = Course::new(passage, parts, [&core_a, &core_b]);
        let (start, end) = (course.at(0.0), course.at(1.0));
        let gap = |moment: &Moment, axis: DVec3| moment.gap_along(axis) - course.radii;
        // A body that turns may be deepest on the way.
        let between = if passage.is_straight() { 0 } else { MOMENTS };
        let on_the_way = (1..between).map(|i| course.at(f64::from(i) / f64::from(MOMENTS)));
        let on_the_way: ArrayVec<Moment, { MOMENTS as usize }> = on_the_way.collect();
        let met_at = if passage.is_straight() { 0.0 } else { fraction };
        let met = course.at(met_at);
        let closing = |axis: DVec3, from: f64| {
            let first = if from > 0.0 { &met } else { &start };
            let after = (1..).zip(&on_the_way).filter(|&(i, _)| f64::from(i) > from * f64::from(MOMENTS));
            let least = after.fold(gap(&end, axis), |least, (_, moment)| least.min(gap(moment, axis)));
            gap(first, axis) - least
        };
        let passing = Passing {
            thickness: self.thickness(&parts),
            is_on_ground: self.are_ground != [false; 2],
            is_endless: parts.iter().any(|it| matches!(it.shape, Shape3::HalfSpace(_))),
            gap: &|axis| gap(&start, axis),
            closing: &closing,
            met_at,
            reach: passage.reach(&parts),
        };
        passing.lies(normal, self.contacts.as_ref(), &self.beside)
    }

    /// The thickness of the thinner of two parts, from its middle, in metres; ground's does not count.
    fn thickness(&self, parts: &[Part; 2]) -> f64 {
        thinner([0, 1].map(|i| {
            let shape = parts[i].shape;
            if self.are_ground[i] || !shape.outer_radius().is_finite() {
                return None;
            }
            let core = shape.core();
            let sum: DVec3 = core.vertices().iter().map(|vertex| vertex.as_dvec3()).sum();
            let middle = sum / core.vertices().len().max(1) as f64;
            let planes = core.normals().iter().zip(core.heights());
            let heights = planes.map(|(normal, height)| height - normal.dot(middle));
            Some(thickness(heights, shape.radius(), shape.outer_radius()))
        }))
    }
}

impl Pair3<'_> {
    /// An impact at the start with ground that is touched without a contact, and moved into: found from the manifolds
    /// after half a thickness of the way, unless something else is met before.
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
        let ahead = half_through(thickness, passage.drift.length() + turned);
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
                    lies = touched.lies(passage, parts, (0.0, manifold.normal.as_dvec3()));
                }
                part.index == of_body
            });
            (lies == Lies::Across).then(|| Impact3 { overlapping: false, ..at_start(manifold) })
        };
        with_manifolds3(&later, 0.0, |manifolds| manifolds.iter().find_map(is_across))
    }
}
