//! The queries of a pair, answered by kernels for two cuboids. What they cannot settle is left to the general path.

use super::super::gap::{Apart, Gap};
use super::super::sat::{hint_of, hint_to, last_of};
use super::Cuboids;
use super::contact::Touching;
use super::eight::Eight;
use super::placed::{Placed, Posed};
use super::settled::{Best, Settled};
use crate::answer::{Manifold3, Measured3, Separation3};
use crate::batch::beyond;
use crate::feature::Hint;
use crate::precision::{Precision, at_least, round_down, signed};
use asunder_geometry::glam::DVec3;

/// The answer to a contact query of two cuboids.
#[derive(Clone, Copy)]
pub(crate) enum Contact {
    /// Further apart than the margin, by so many metres at least.
    Apart(Hint, f32),
    /// Overlapping.
    Touching(Hint),
    /// Not overlapping, and no further apart than the margin.
    Near(Hint),
    /// It takes more than the axes: the general path must answer, starting from this hint.
    Unclear(Hint),
}

impl Posed<'_> {
    /// Whether they overlap; `None` where rounding could change the answer.
    #[inline]
    pub(crate) fn overlaps(&self) -> Option<bool> {
        if self.are_far(0.0) {
            return Some(false);
        }
        if self.are_near() {
            return Some(true);
        }
        let placed = self.placed();
        placed.fifteen.overlap(placed.radii, &placed.precision)
    }

    /// The separation within a limit; `None` where it takes more than the axes.
    #[inline]
    pub(crate) fn separation(&self, limit: f64) -> Option<Separation3> {
        if self.are_far(limit) {
            return Some(Separation3::AtLeast(round_down(self.gap_of_spheres().max(limit))));
        }
        separation_of(&self.placed(), limit)
    }

    /// The same for one of eight pairs, with the limit that was given to [`Eight::put`].
    #[inline(always)]
    pub(crate) fn separation_in(&self, (eight, lane): (&Eight, usize), limit: f64) -> Option<Separation3> {
        if let Some(bound) = eight.parted_by_face(lane, self) {
            return Some(Separation3::AtLeast(bound));
        }
        match eight.best(lane) {
            Some(best) => Some(eight.measured(lane, self, &best)),
            None => separation_of(&eight.placed(lane, self), limit),
        }
    }

    /// How they touch within a margin, or what separates them. Where they touch, fills in the manifold, if one is
    /// wanted.
    #[inline]
    pub(crate) fn contact(&self, margin: f64, hint: Hint, manifold: Option<&mut Manifold3>) -> Contact {
        if self.are_far(margin) {
            return Contact::Apart(hint, self.beyond(margin));
        }
        let placed = self.placed();
        if let Some(of) = placed.parted(margin) {
            return Contact::Apart(hint_to(of), placed.beyond(of, margin));
        }
        if manifold.is_none() && placed.are_deep() {
            return Contact::Touching(hint);
        }
        self.contact_of(&placed, margin, hint, manifold)
    }

    /// The answer for one of eight pairs, if it is clear at once, with the hint of its last frame. For a sensor, a
    /// certain overlap is enough.
    #[inline(always)]
    pub(crate) fn clear_in(
        &self,
        (eight, lane): (&Eight, usize),
        margin: f64,
        hint: Hint,
        sensor: bool,
    ) -> Option<Contact> {
        match eight.parted(lane) {
            Some(of) => {
                let by_face = eight.parted_by_face(lane, self);
                Some(Contact::Apart(hint_to(of), by_face.map_or(0.0, |gap| beyond(gap.into(), margin))))
            }
            None => (sensor && eight.is_deep(lane)).then_some(Contact::Touching(hint)),
        }
    }

    /// The rest of [`Posed::contact`] for one of eight pairs, where nothing was clear at once.
    #[inline]
    pub(crate) fn contact_in(
        &self,
        (eight, lane): (&Eight, usize),
        margin: f64,
        hint: Hint,
        manifold: Option<&mut Manifold3>,
    ) -> Contact {
        self.contact_of(&eight.placed(lane, self), margin, hint, manifold)
    }

    /// The same for a pair that no axis separates for certain.
    #[inline]
    fn contact_of(
        &self,
        placed: &Placed,
        margin: f64,
        hint: Hint,
        manifold: Option<&mut Manifold3>,
    ) -> Contact {
        match placed.settle(margin) {
            Settled::Unclear => Contact::Unclear(hint),
            Settled::Beyond(axis) => Contact::Apart(hint_of(&axis), 0.0),
            Settled::Parted(best) => {
                Touching { posed: self, placed, best: &best, margin, last: last_of(hint) }
                    .across(hint, manifold)
            }
            Settled::Overlapping(best) => {
                let Some(manifold) = manifold else {
                    return Contact::Touching(hint_to(best.axis_of(placed)));
                };
                let touching = Touching { posed: self, placed, best: &best, margin, last: last_of(hint) };
                let of = touching.measured_from();
                match touching.fill(of, manifold) {
                    Some(()) => Contact::Touching(hint_to(of)),
                    None => Contact::Unclear(hint),
                }
            }
        }
    }
}

/// The separation of the shapes within a limit; `None` where it takes more than the axes.
#[inline(always)]
fn separation_of(placed: &Placed, limit: f64) -> Option<Separation3> {
    match placed.settle(limit) {
        Settled::Unclear => None,
        Settled::Parted(best) => placed.gap(best.axis(placed).normal, limit),
        Settled::Beyond(axis) => {
            Some(Separation3::AtLeast(at_least(axis.separation - placed.radii, &placed.precision)))
        }
        Settled::Overlapping(best) => {
            let (axis_b, ahead) = (|j| placed.axis_b(j), |j: usize| placed.fifteen.ahead.0[j]);
            let normal = best.normal(&placed.basis, axis_b, placed.offset, ahead);
            Some(measured(&best, normal, placed.radii, &placed.precision))
        }
    }
}

impl Placed {
    /// The separation of sharp cuboids that are apart, searched from an axis that separates them.
    #[inline(never)]
    fn gap(&self, towards: DVec3, limit: f64) -> Option<Separation3> {
        let Self { half: [half_a, half_b], relative: basis, offset, precision, .. } = *self;
        let cuboids = Cuboids { half_a, half_b, basis, offset };
        match cuboids.gap_along(towards, [0.0; 2], limit, &precision) {
            Gap::Apart(Apart { separation, error, normal, .. }) => {
                let normal = self.basis.turn(normal).as_vec3();
                Some(Separation3::Measured(Measured3 { separation, error, normal }))
            }
            Gap::Beyond(at_least) => Some(Separation3::AtLeast(at_least)),
            Gap::Overlapping | Gap::Unclear => None,
        }
    }
}

/// The separation of shapes whose cores overlap.
#[inline(always)]
pub(super) fn measured(best: &Best, normal: DVec3, radii: f64, precision: &Precision) -> Separation3 {
    let depth = best.separation() - radii;
    Separation3::Measured(Measured3 {
        separation: signed(depth, true),
        error: precision.of_separation(depth, best.short),
        normal: normal.as_vec3(),
    })
}
