//! What bullets stand on before they go: over what is flush with it they are led.

use crate::contact::Candidate;
use crate::space::Space;
use crate::world::{World, slot_of};

/// What each bullet touches that is solid, and what the contacts with it tell: those that this update shows, as a hook left them.
#[derive(Debug)]
pub(crate) struct Touches<S: Space> {
    /// The slot of each touch's bullet, ascending.
    slots: Vec<u32>,
    touches: Vec<S::Touch>,
    /// Both, as they are found.
    found: Vec<(u32, S::Touch)>,
}

impl<S: Space> Touches<S> {
    pub(crate) const NONE: Self = Self { slots: Vec::new(), touches: Vec::new(), found: Vec::new() };

    /// Those of a bullet.
    pub(super) fn of(&self, slot: u32) -> &[S::Touch] {
        let start = self.slots.partition_point(|&other| other < slot);
        let end = self.slots.partition_point(|&other| other <= slot);
        &self.touches[start..end]
    }

    /// Those of all bullets. Cost: linear in the candidates.
    pub(super) fn gather(world: &mut World<S>) {
        let Self { mut slots, mut touches, mut found } =
            core::mem::replace(&mut world.scratch.touches, Self::NONE);
        found.clear();
        for candidate in &world.candidates {
            let (a, b) = candidate.keys;
            for (bullet, is_a) in [(a, true), (b, false)] {
                if world.bodies.get(bullet).is_some_and(|body| body.bullet) {
                    found.extend(shown(world, candidate, is_a).map(|touch| (slot_of(bullet), touch)));
                }
            }
        }
        // Which of a bullet's comes first is of no matter: a stable sort would allocate.
        found.sort_unstable_by_key(|&(slot, _)| slot);
        slots.clear();
        slots.extend(found.iter().map(|&(slot, _)| slot));
        touches.clear();
        touches.extend(found.iter().map(|&(_, touch)| touch));
        world.scratch.touches = Self { slots, touches, found };
    }
}

/// What the contact of a candidate is to the one of its two.
fn shown<'w, S: Space>(
    world: &'w World<S>,
    candidate: &Candidate<S::Key>,
    is_a: bool,
) -> impl Iterator<Item = S::Touch> + use<'w, S> {
    let contact = candidate.contact.number().map(|number| world.show(number));
    let manifolds =
        contact.filter(|contact| contact.overlapping).map_or(&[][..], |contact| contact.manifolds);
    manifolds.iter().map(move |manifold| S::touch(manifold, is_a))
}
