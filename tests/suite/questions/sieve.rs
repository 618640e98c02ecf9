//! Filters, and an oracle for what they let through.

use asunder::{Collider, Filter, Layers, Space};
use asunder_tests::cases::Random;
use asunder_tests::engine::slot_of;

/// A filter, and an independent predicate for what it lets through.
pub(super) struct Sieve<S: Space> {
    pub(super) filter: Filter<'static, S>,
    pub(super) allowed: Allowed<S>,
}

pub(super) type Allowed<S> = Box<dyn Fn(<S as Space>::Key, &Collider<S>) -> bool>;

impl<S: Space> Sieve<S> {
    /// One of a few kinds; a key to leave out may be stale.
    pub(super) fn new(random: &mut Random, keys: &[S::Key]) -> Self {
        let filter = Filter::new();
        let meets = |body: &Collider<S>, member_of: u32, collides_with: u32| {
            let layers = body.get_layers();
            layers.member_of & collides_with != 0 && layers.collides_with & member_of != 0
        };
        let (filter, allowed): (_, Allowed<S>) = match random.below(8) {
            0 => (filter.solid(), Box::new(|_, body| !body.is_sensor())),
            1 if !keys.is_empty() => {
                let without = random.pick(keys);
                (filter.without(without), Box::new(move |key, _| key != without))
            }
            2 => (filter.without_owner(1), Box::new(|_, body| body.get_owner() != Some(1))),
            3 => {
                let layers = Layers { member_of: 0b01, collides_with: 0b10 };
                (filter.layers(layers), Box::new(move |_, body| meets(body, 0b01, 0b10)))
            }
            4 => (filter.only(&is_odd::<S>), Box::new(is_odd::<S>)),
            5 => {
                let layers = Layers { member_of: 0b11, collides_with: 0b01 };
                let allowed = move |_, body: &Collider<S>| {
                    meets(body, 0b11, 0b01) && !body.is_sensor() && body.get_owner() != Some(0)
                };
                (filter.solid().without_owner(0).layers(layers), Box::new(allowed))
            }
            6 => (filter.of_layers(0b10), Box::new(|_, body| body.get_layers().member_of & 0b10 != 0)),
            _ => (filter, Box::new(|_, _| true)),
        };
        Self { filter, allowed }
    }

    /// Without any condition.
    pub(super) fn all() -> Self {
        Self { filter: Filter::new(), allowed: Box::new(|_, _| true) }
    }
}

fn is_odd<S: Space>(key: S::Key, body: &Collider<S>) -> bool {
    slot_of(key) % 3 != 0 && body.get_user_data() % 2 == 1
}
