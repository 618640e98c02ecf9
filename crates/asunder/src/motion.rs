//! This frame's motions: what a body is about to do, so that an update can say what it will run into.

use crate::space::{BodyKey2, BodyKey3, Space};
use crate::world::{StaleKey, World, slot_of};
use asunder_narrow::{Impact2, Impact3};

/// What a bullet runs into during its motion: see [`Collider::bullet`](crate::Collider::bullet).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit<K, I> {
    /// The bullet: A of the impact.
    pub bullet: K,
    /// What it meets, which may be a bullet too: B of the impact.
    pub other: K,
    /// Whether either is a sensor, which stops nobody.
    pub sensor: bool,
    /// When, where, and how sure. The normal points from the bullet to the other. The point in the world is
    /// `anchor_a` from the bullet's position at that share of its motion; of another that has no motion, `anchor_b`
    /// from where it stands.
    pub impact: I,
}

/// What a bullet runs into in the plane.
pub type Hit2 = Hit<BodyKey2, Impact2>;

/// What a bullet runs into in space.
pub type Hit3 = Hit<BodyKey3, Impact3>;

/// The motions that the next update will see.
#[derive(Clone, Debug)]
pub(crate) struct Motions<S: Space> {
    /// By slot; shorter than the slots where the last ones have none.
    of_slot: Vec<Option<S::Motion>>,
    /// Slots that have one, or had one and lost it with their body.
    slots: Vec<u32>,
}

impl<S: Space> Motions<S> {
    pub(crate) const NONE: Self = Self { of_slot: Vec::new(), slots: Vec::new() };

    /// The motion of the body in a slot.
    #[inline]
    pub(crate) fn of(&self, slot: u32) -> Option<S::Motion> {
        self.of_slot.get(slot as usize).copied().flatten()
    }

    /// Whether nobody has one.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Slots that have one or had one, ascending, each with its motion.
    #[cfg(feature = "serde")]
    pub(crate) fn list(&self) -> Vec<(u32, Option<S::Motion>)> {
        let mut slots = self.slots.clone();
        slots.sort_unstable();
        slots.dedup();
        slots.into_iter().map(|slot| (slot, self.of(slot))).collect()
    }

    /// What a list says, whose slots have been checked.
    #[cfg(feature = "serde")]
    pub(crate) fn of_list(list: &[(u32, Option<S::Motion>)]) -> Self {
        let mut motions = Self::NONE;
        for &(slot, motion) in list {
            match motion {
                Some(motion) => motions.set(slot, motion),
                None => motions.slots.push(slot),
            }
        }
        motions
    }

    pub(crate) fn forget(&mut self, slot: u32) {
        if let Some(motion) = self.of_slot.get_mut(slot as usize) {
            *motion = None;
        }
    }

    fn set(&mut self, slot: u32, motion: S::Motion) {
        let index = slot as usize;
        if index >= self.of_slot.len() {
            self.of_slot.resize(index + 1, None);
        }
        if self.of_slot[index].replace(motion).is_none() {
            self.slots.push(slot);
        }
    }
}

impl<S: Space> World<S> {
    pub(crate) fn set_motion_of(&mut self, key: S::Key, motion: S::Motion) -> Result<(), StaleKey> {
        self.bodies.get_mut(key).ok_or(StaleKey)?.asleep = false;
        self.motions.set(slot_of(key), motion);
        self.mark_dirty(slot_of(key));
        Ok(())
    }

    /// After an update the motions are history, and the boxes around them too wide.
    pub(crate) fn forget_motions(&mut self) {
        while let Some(slot) = self.motions.slots.pop() {
            self.motions.forget(slot);
            self.mark_dirty(slot);
        }
    }
}
