//! Slots, versions, and the order in which empty slots are filled again: they decide the keys of future bodies.
//!
//! A slot map shows the keys of its bodies, but not its empty slots. To save these, a copy of the map is filled until
//! no slot is empty, and the keys that it hands out are the future ones. To restore them takes slotmap's own serde,
//! which alone can set versions: all slots are read as filled, and those that were empty are emptied in reverse order,
//! since the last to be emptied is the first to be filled.

use super::shapes::Saved;
use crate::collider::Collider;
use crate::world::slot_of;
use serde::Deserialize;
use serde::de::value::{Error, MapAccessDeserializer, MapDeserializer, SeqDeserializer};
use serde::de::{Deserializer, IntoDeserializer, Visitor};
use serde::forward_to_deserialize_any;
use slotmap::{Key, KeyData, SlotMap};

type Bodies<S> = SlotMap<<S as crate::space::Space>::Key, Collider<S>>;

/// The keys that the next bodies get in the empty slots among `slots`, in order.
pub(super) fn keys_to_come<S: Saved>(bodies: &Bodies<S>, slots: usize) -> Vec<S::Key> {
    let empty = slots.saturating_sub(1 + bodies.len());
    // Never fails: the numbers are those of a unit ball or disc.
    let Ok(body) = Collider::<S>::deserialize(Node::body::<S>()) else { return Vec::new() };
    let mut bodies = bodies.clone();
    (0..empty).map(|_| bodies.insert(body.clone())).collect()
}

/// The version in a key: odd.
pub(super) fn version_of<K: Key>(key: K) -> u32 {
    (key.data().as_ffi() >> 32) as u32
}

/// The key of a slot's body with this version, which must be odd.
pub(super) fn key_of<K: Key>(slot: usize, version: u32) -> K {
    KeyData::from_ffi(u64::from(version) << 32 | slot as u64).into()
}

/// A slot map with these bodies in slots 1 and up, each with the version of its key; or, where there is none, with
/// the version of the key to come. `free` names the empty ones as they are to be filled.
pub(super) fn slot_map<S: Saved>(
    slots: Vec<(u32, Option<Collider<S>>)>,
    free: &[u32],
) -> Result<Bodies<S>, Error> {
    let before = |(version, body): &(u32, Option<Collider<S>>)| match body {
        Some(_) => *version,
        // The version before the next key's.
        None => version.wrapping_sub(2),
    };
    let sentinel = Node::Map(vec![("value", Node::None), ("version", Node::Number(0))]);
    let filled = slots
        .iter()
        .map(|slot| Node::Map(vec![("value", Node::body::<S>()), ("version", Node::Number(before(slot)))]));
    let nodes = core::iter::once(sentinel).chain(filled);
    let mut bodies = Bodies::<S>::deserialize(SeqDeserializer::new(nodes))?;
    for &slot in free.iter().rev() {
        if let Some(empty) = slots.get((slot as usize).wrapping_sub(1)) {
            bodies.remove(key_of(slot as usize, before(empty)));
        }
    }
    for (slot, (version, body)) in (1..).zip(slots) {
        if let (Some(body), Some(place)) = (body, bodies.get_mut(key_of(slot, version))) {
            debug_assert_eq!(slot_of(key_of::<S::Key>(slot, version)) as usize, slot);
            *place = body;
        }
    }
    Ok(bodies)
}

/// As much of a self-describing format as a slot needs.
#[derive(Clone)]
enum Node {
    None,
    Number(u32),
    Map(Vec<(&'static str, Node)>),
}

impl Node {
    /// An arbitrary body: a unit ball.
    fn body<S: Saved>() -> Self {
        let unit = Self::Map(vec![("radius", Self::Number(1))]);
        Self::Map(vec![("shape", Self::Map(vec![(S::BALL, unit)]))])
    }
}

impl<'de> Deserializer<'de> for Node {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Self::None => visitor.visit_none(),
            Self::Number(number) => visitor.visit_u32(number),
            Self::Map(fields) => visitor.visit_map(MapDeserializer::new(fields.into_iter())),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Self::None => visitor.visit_none(),
            some => visitor.visit_some(some),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        match self {
            Self::Map(fields) => {
                let map = MapDeserializer::new(fields.into_iter());
                MapAccessDeserializer::new(map).deserialize_enum(name, variants, visitor)
            }
            other => other.deserialize_any(visitor),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

impl<'de> IntoDeserializer<'de, Error> for Node {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}
