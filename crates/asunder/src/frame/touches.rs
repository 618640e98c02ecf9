//! The bodies that bullets touch before they move: bullets pass over parts that are flush with these.

use crate::space::Space;
use crate::world::{World, slot_of};

/// The solid things that each bullet touches, by the contacts that this update shows, as a hook left them.
#[derive(Debug)]
pub(crate) struct Touches<S: Space> {
    /// The slot of each touch's bullet, ascending.
    slots: Vec<u32>,
    touches: Vec<S::Touch>,
}

impl<S: Space> Touches<S> {
    pub(crate) const NONE: Self = Self { slots: Vec::new(), touches: Vec::new() };

    /// The touches of the bullet in a slot.
    pub(super) fn of(&self, slot: u32) -> &[S::Touch] {
        let start = self.slots.partition_point(|&other| other < slot);
        let end = self.slots.partition_point(|&other| other <= slot);
        &self.touches[start..end]
    }

    /// Gathers those of all bullets in `of_bullets`, which is sorted. Cost: linear in their contacts.
    pub(super) fn gather(world: &mut World<S>) {
        let Self { mut slots, mut touches } = core::mem::replace(&mut world.scratch.touches, Self::NONE);
        slots.clear();
        touches.clear();
        for pairs in world.scratch.of_bullets.chunk_by(|one, other| one.0 == other.0) {
            let bullet = pairs[0].0;
            for contact in world.records_of(bullet).map(|number| world.show(number)) {
                if contact.overlapping {
                    touches.extend(contact.manifolds.iter().map(|one| S::touch(one, contact.a == bullet)));
                }
            }
            slots.resize(touches.len(), slot_of(bullet));
        }
        world.scratch.touches = Self { slots, touches };
    }
}
