//! Contacts: what the world keeps of a pair, and what it shows.

use crate::space::{BodyKey2, BodyKey3};
use asunder_broad::PairId;
use asunder_narrow::{Hint, Manifold2, Manifold3};
use core::ops::Range;

/// Two bodies within their margins of each other, as of the last update.
#[derive(Debug, PartialEq)]
pub struct Contact<'a, K, M> {
    /// The body in the lower slot.
    pub a: K,
    /// The other body.
    pub b: K,
    /// Whether either is a sensor: then there are no manifolds.
    pub sensor: bool,
    /// Whether they share a point now; touching counts.
    pub overlapping: bool,
    /// Whether their `Began` is among this update's events.
    pub is_new: bool,
    /// Whether they are further apart than their margins, and here for what their motions may bring: a solver that
    /// lets no point come nearer than its separation allows lets nothing through. Touches nobody until they overlap.
    pub speculative: bool,
    /// One manifold for each pair of convex parts that touch. Normals point from `a` to `b`. None for a sensor, nor
    /// for two half-spaces that overlap without end: fix all but one of those, as a level's are, and they never pair.
    pub manifolds: &'a [M],
}

// Not derived: a contact only looks at its manifolds, which are no copies themselves.
impl<K: Copy, M> Clone for Contact<'_, K, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: Copy, M> Copy for Contact<'_, K, M> {}

/// A contact in the plane.
pub type Contact2<'a> = Contact<'a, BodyKey2, Manifold2>;

/// A contact in space.
pub type Contact3<'a> = Contact<'a, BodyKey3, Manifold3>;

/// A pair of boxes that overlapped at the last update, and what was learnt about it.
#[derive(Clone, Debug)]
pub(crate) struct Candidate<K> {
    pub(crate) pair: PairId,
    pub(crate) keys: (K, K),
    pub(crate) hint: Hint,
    /// The place of the pair's persistent manifold.
    pub(crate) persistent: u32,
    /// Of bodies that are apart, until when they stay so: see `odometer`.
    pub(crate) until: f64,
}

/// Where the manifolds of a contact stand: in the list of the batch that made them, or of what was carried on.
///
/// Nobody moves them from there: see `frame::collide` for what that bought.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) batch: u32,
    pub(crate) range: Range<u32>,
}

impl Place {
    /// In place of a batch: among those that were carried on.
    pub(crate) const CARRIED: u32 = u32::MAX;

    /// No manifold.
    pub(crate) const NOWHERE: Self = Self { batch: Self::CARRIED, range: 0..0 };

    /// The last of a list, from `start` on, of what was carried on.
    pub(crate) fn carried<M>(start: usize, carried: &[M]) -> Self {
        Self { batch: Self::CARRIED, range: start as u32..carried.len() as u32 }
    }
}

/// A contact as the world keeps it. Records are sorted by pair.
#[derive(Clone, Debug)]
pub(crate) struct Record<K> {
    pub(crate) pair: PairId,
    pub(crate) keys: (K, K),
    pub(crate) user_data: (u64, u64),
    pub(crate) manifolds: Place,
    pub(crate) sensor: bool,
    pub(crate) overlapping: bool,
    /// Whether it has begun and not ended: its bodies overlapped at some update since the record appeared.
    pub(crate) begun: bool,
    pub(crate) is_new: bool,
    /// Beyond the margins, and within what motions may bring.
    pub(crate) speculative: bool,
}
