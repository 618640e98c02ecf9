//! What bullets stand on before they go: over what is flush with it they are led.

use crate::space::Space;
use crate::world::{World, slot_of};

/// What each bullet touches that is solid, and what the contacts with it tell: those that this update shows, as a hook
/// left them.
#[derive(Debug)]
pub(crate) struct Touches<S: Space> {
    /// The slot of each touch's bullet, ascending.
    slots: Vec<u32>,
    touches: Vec<S::Touch>,
}

impl<S: Space> Touches<S> {
    pub(crate) const NONE: Self = Self { slots: Vec::new(), touches: Vec::new() };

    /// Those of a bullet.
    pub(super) fn of(&self, slot: u32) -> &[S::Touch] {
        let start = self.slots.partition_point(|&other| other < slot);
        let end = self.slots.partition_point(|&other| other <= slot);
        &self.touches[start..end]
    }

    /// Those of all bullets that are asked about, which are sorted. Cost: linear in their contacts.
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
