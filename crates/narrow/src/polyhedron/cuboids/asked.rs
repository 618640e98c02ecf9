//! The questions of a pair, as two cuboids answer them by themselves; what they cannot settle is left to the general
//! path.

use super::super::sat::{hint_of, hint_to};
use super::contact::Touching;
use super::placed::Posed;
use super::settled::Settled;
use crate::answer::{Manifold3, Measured3, Separation3};
use crate::feature::Hint;
use crate::precision::{at_least, rounded_down, signed};

/// What two cuboids say of their contact.
#[derive(Clone, Copy)]
pub(crate) enum Contact {
    /// Further apart than the margin.
    Apart(Hint),
    /// Overlapping.
    Touching(Hint),
    /// That takes more than the axes.
    Unclear,
}

impl Posed<'_> {
    /// Whether they overlap; nothing where rounding might have told.
    #[inline]
    pub(crate) fn overlaps(&self) -> Option<bool> {
        if self.are_far(0.0) {
            return Some(false);
        }
        let placed = self.placed();
        let (top, doubt) = (placed.fifteen.top(), placed.closed_form());
        if top - placed.radii > doubt {
            return Some(false);
        }
        (top < -doubt).then_some(true)
    }

    /// The separation within a limit; nothing where it takes more than the axes.
    #[inline]
    pub(crate) fn separation(&self, limit: f64) -> Option<Separation3> {
        if self.are_far(limit) {
            return Some(Separation3::AtLeast(rounded_down(self.gap_of_spheres().max(limit))));
        }
        let placed = self.placed();
        match placed.settle(limit) {
            Settled::Unclear => None,
            Settled::Beyond(axis) => {
                Some(Separation3::AtLeast(at_least(axis.separation - placed.radii, &placed.precision)))
            }
            Settled::Overlapping(best) => {
                let depth = best.separation() - placed.radii;
                Some(Separation3::Measured(Measured3 {
                    separation: signed(depth, true),
                    error: placed.precision.of_separation(depth, best.short),
                    normal: placed.basis.turn(best.axis(&placed).normal).as_vec3(),
                }))
            }
        }
    }

    /// How they touch within a margin, or what keeps them apart. The manifold, where one is wanted, is filled in where they
    /// touch.
    #[inline]
    pub(crate) fn contact(&self, margin: f64, hint: Hint, manifold: Option<&mut Manifold3>) -> Contact {
        if self.are_far(margin) {
            return Contact::Apart(hint);
        }
        let placed = self.placed();
        match placed.settle(margin) {
            Settled::Unclear => Contact::Unclear,
            Settled::Beyond(axis) => Contact::Apart(hint_of(&axis)),
            Settled::Overlapping(best) => {
                if let Some(manifold) = manifold {
                    let touching = Touching { posed: self, placed: &placed, best: &best, margin };
                    if touching.fill(manifold).is_none() {
                        return Contact::Unclear;
                    }
                }
                Contact::Touching(hint_to(best.axis_of(&placed)))
            }
        }
    }
}
