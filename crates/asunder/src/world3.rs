//! The world in space: the engine's face, in plain types.

use crate::collider::Collider3;
use crate::contact::Contact3;
use crate::event::Event3;
use crate::space::{BodyKey3, Volume};
use crate::world::{StaleKey, World};
use asunder_geometry::Pose3;

/// A world of bodies in space.
///
/// Insert bodies, move them, [`update`](World::update) once a frame, and read what touches. What is read between
/// two updates is as of the last one; what is asked about a body leaves out bodies removed since.
///
/// ```
/// use asunder::{Collider3, Cuboid, Pose3, World3, glam::Vec3};
/// let mut world = World3::new();
/// let unit = Cuboid::from_half_extents(Vec3::ONE)?;
/// let a = world.insert(Collider3::new(unit));
/// let b = world.insert(Collider3::new(unit).at(Pose3::at([8.0, 0.0, 0.0])?));
/// world.update();
/// assert_eq!(world.contacts().len(), 0);
///
/// world.set_pose(b, Pose3::IDENTITY)?;
/// world.update();
/// assert!(world.is_touching(a, b));
/// assert_eq!(world.candidates().collect::<Vec<_>>(), [(a, b)]);
/// assert_eq!(world.touching(b).collect::<Vec<_>>(), [a]);
/// assert_eq!(world.contact(b, a), world.contacts_of(a).next());
/// assert_eq!(world.events().len(), 1);
///
/// assert!(world.contains(b) && world.get(b).is_some() && world.iter().count() == 2);
/// assert!(world.remove(b).is_some());
/// assert!(!world.contains(b));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type World3 = World<Volume>;

impl World<Volume> {
    /// Adds a body. It takes part from the next update on. Cost: constant.
    pub fn insert(&mut self, collider: Collider3) -> BodyKey3 {
        self.insert_body(collider)
    }

    /// Takes a body out and returns it; nothing for a stale key. Contacts of it that had begun end at the next update.
    pub fn remove(&mut self, key: BodyKey3) -> Option<Collider3> {
        self.remove_body(key)
    }

    /// The body of a key; nothing for a stale one.
    pub fn get(&self, key: BodyKey3) -> Option<&Collider3> {
        self.bodies.get(key)
    }

    /// Whether the key's body is in the world.
    pub fn contains(&self, key: BodyKey3) -> bool {
        self.bodies.contains_key(key)
    }

    /// All bodies, in order of their slots.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (BodyKey3, &Collider3)> {
        self.bodies.iter()
    }

    /// Moves a body. The same pose again, bit for bit, is no move. Cost: constant.
    ///
    /// # Errors
    /// A stale key.
    pub fn set_pose(&mut self, key: BodyKey3, pose: Pose3) -> Result<(), StaleKey> {
        self.move_body(key, pose)
    }

    /// Pairs whose boxes overlapped and whose filters agreed, in pair order: what the narrow phase was asked.
    pub fn candidates(&self) -> impl ExactSizeIterator<Item = (BodyKey3, BodyKey3)> + Clone {
        self.candidates.iter().map(|candidate| candidate.keys)
    }

    /// Pairs within their margins of each other at the last update, in pair order. A body removed since is still
    /// among them.
    pub fn contacts(&self) -> impl ExactSizeIterator<Item = Contact3<'_>> + Clone {
        self.show_contacts()
    }

    /// Contacts of one body with bodies that are still there, in order of the other's slot; none for a stale key.
    /// Cost: a binary search.
    pub fn contacts_of(&self, key: BodyKey3) -> impl Iterator<Item = Contact3<'_>> + Clone {
        self.records_of(key).map(|record| record.show::<Volume>(&self.manifolds))
    }

    /// The contact of two bodies, in either order, if they have one. Cost: a binary search.
    pub fn contact(&self, one: BodyKey3, other: BodyKey3) -> Option<Contact3<'_>> {
        self.record_of(one, other).map(|record| record.show::<Volume>(&self.manifolds))
    }

    /// Whether the two bodies touch: `Began` was reported and `Ended` was not. Cost: a binary search.
    pub fn is_touching(&self, one: BodyKey3, other: BodyKey3) -> bool {
        self.record_of(one, other).is_some_and(|record| record.begun)
    }

    /// The bodies that touch this one and are still there, sensors among them, in order of their slots. Cost: a binary
    /// search.
    pub fn touching(&self, key: BodyKey3) -> impl Iterator<Item = BodyKey3> + Clone {
        let begun = self.records_of(key).filter(|record| record.begun);
        begun.map(move |record| if record.keys.0 == key { record.keys.1 } else { record.keys.0 })
    }

    /// What began and what ended at the last update, in pair order; where a slot was reused, what ended comes first.
    pub fn events(&self) -> &[Event3] {
        &self.events
    }
}
