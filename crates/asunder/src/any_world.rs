//! The calls of a frame for programs that are written once for both dimensions.

use crate::collider::Collider;
use crate::contact::Contact;
use crate::event::Event;
use crate::motion::Hit;
use crate::space::Space;
use crate::world::{StaleKey, World};

/// The calls of a game loop, for code in which the dimension is a type parameter.
///
/// [`World2`](crate::World2) and [`World3`](crate::World3) have these calls, and all others, in plain types, and theirs
/// take precedence where the dimension is known: import this trait only for code that is generic over a [`Space`].
/// Meanings, errors and costs are those of the calls of the same names there.
///
/// ```
/// use asunder::{AnyWorld, Circle, Collider, Collider2, Collider3, Space, Sphere, StaleKey, World};
///
/// fn begun_by<S: Space>(colliders: [Collider<S>; 2]) -> Result<usize, StaleKey> {
///     let mut world = World::<S>::new();
///     let [a, b] = colliders.map(|collider| world.insert(collider));
///     world.update();
///     assert_eq!((world.contacts().len(), world.candidates().len(), world.impacts().len()), (1, 1, 0));
///     assert!(world.contact(b, a).is_some_and(|contact| (contact.a, contact.b) == (a, b)));
///     assert!(world.is_touching(a, b) && world.touching(a).eq([b]) && world.candidates_of(b).eq([(a, b)]));
///     assert_eq!(world.impacts_of(a).count(), 0);
///     assert_eq!(world.contacts_of(a).next(), world.contact(a, b));
///     world.sleep(b)?;
///     assert!(world.get(b).is_some_and(Collider::is_asleep));
///     world.wake(b)?;
///     assert!(world.iter().count() == 2 && world.remove(a).is_some() && !world.contains(a));
///     assert_eq!(world.set_pose(a, S::Pose::default()), Err(StaleKey));
///     Ok(world.events().len())
/// }
/// assert_eq!(begun_by([Collider2::new(Circle::new(1.0)?), Collider2::new(Circle::new(2.0)?)]), Ok(1));
/// assert_eq!(begun_by([Collider3::new(Sphere::new(1.0)?), Collider3::new(Sphere::new(2.0)?)]), Ok(1));
/// # Ok::<(), asunder::RadiusError>(())
/// ```
pub trait AnyWorld<S: Space> {
    /// Adds a body: [`World3::insert`](crate::World3::insert).
    fn insert(&mut self, collider: Collider<S>) -> S::Key;

    /// Removes a body and returns it: [`World3::remove`](crate::World3::remove).
    fn remove(&mut self, key: S::Key) -> Option<Collider<S>>;

    /// The body of a key: [`World3::get`](crate::World3::get).
    fn get(&self, key: S::Key) -> Option<&Collider<S>>;

    /// Whether the key's body is in the world: [`World3::contains`](crate::World3::contains).
    fn contains(&self, key: S::Key) -> bool;

    /// All bodies, in order of their slots: [`World3::iter`](crate::World3::iter).
    fn iter(&self) -> impl ExactSizeIterator<Item = (S::Key, &Collider<S>)>;

    /// Moves a body: [`World3::set_pose`](crate::World3::set_pose).
    ///
    /// # Errors
    /// A stale key.
    fn set_pose(&mut self, key: S::Key, pose: S::Pose) -> Result<(), StaleKey>;

    /// Announces to the next update how a body will move in this frame:
    /// [`World3::set_motion`](crate::World3::set_motion).
    ///
    /// # Errors
    /// A stale key.
    fn set_motion(&mut self, key: S::Key, motion: S::Motion) -> Result<(), StaleKey>;

    /// Marks a body as at rest: [`World3::sleep`](crate::World3::sleep).
    ///
    /// # Errors
    /// A stale key.
    fn sleep(&mut self, key: S::Key) -> Result<(), StaleKey>;

    /// Marks a body as no longer at rest: [`World3::wake`](crate::World3::wake).
    ///
    /// # Errors
    /// A stale key.
    fn wake(&mut self, key: S::Key) -> Result<(), StaleKey>;

    /// Pairs whose boxes overlapped: [`World3::candidates`](crate::World3::candidates).
    fn candidates(&self) -> impl ExactSizeIterator<Item = (S::Key, S::Key)> + Clone;

    /// Candidates of one body: [`World3::candidates_of`](crate::World3::candidates_of).
    fn candidates_of(&self, key: S::Key) -> impl Iterator<Item = (S::Key, S::Key)> + Clone;

    /// Pairs within their margins of each other: [`World3::contacts`](crate::World3::contacts).
    fn contacts(&self) -> impl ExactSizeIterator<Item = Contact<'_, S::Key, S::Manifold>> + Clone;

    /// Contacts of one body: [`World3::contacts_of`](crate::World3::contacts_of).
    fn contacts_of(&self, key: S::Key) -> impl Iterator<Item = Contact<'_, S::Key, S::Manifold>> + Clone;

    /// The contact of two bodies: [`World3::contact`](crate::World3::contact).
    fn contact(&self, one: S::Key, other: S::Key) -> Option<Contact<'_, S::Key, S::Manifold>>;

    /// Whether the two bodies touch: [`World3::is_touching`](crate::World3::is_touching).
    fn is_touching(&self, one: S::Key, other: S::Key) -> bool;

    /// The bodies that touch this one: [`World3::touching`](crate::World3::touching).
    fn touching(&self, key: S::Key) -> impl Iterator<Item = S::Key> + Clone;

    /// The contacts that began and ended: [`World3::events`](crate::World3::events).
    fn events(&self) -> &[Event<S::Key>];

    /// The impacts of bullets: [`World3::impacts`](crate::World3::impacts).
    fn impacts(&self) -> &[Hit<S::Key, S::Impact>];

    /// The impacts of one bullet: [`World3::impacts_of`](crate::World3::impacts_of).
    fn impacts_of(&self, bullet: S::Key) -> impl Iterator<Item = &Hit<S::Key, S::Impact>> + Clone;
}

impl<S: Space> AnyWorld<S> for World<S> {
    fn insert(&mut self, collider: Collider<S>) -> S::Key {
        self.insert_body(collider)
    }

    fn remove(&mut self, key: S::Key) -> Option<Collider<S>> {
        self.remove_body(key)
    }

    fn get(&self, key: S::Key) -> Option<&Collider<S>> {
        self.bodies.get(key)
    }

    fn contains(&self, key: S::Key) -> bool {
        self.bodies.contains_key(key)
    }

    fn iter(&self) -> impl ExactSizeIterator<Item = (S::Key, &Collider<S>)> {
        self.bodies.iter()
    }

    fn set_pose(&mut self, key: S::Key, pose: S::Pose) -> Result<(), StaleKey> {
        self.move_body(key, pose)
    }

    fn set_motion(&mut self, key: S::Key, motion: S::Motion) -> Result<(), StaleKey> {
        self.set_motion_of(key, motion)
    }

    fn sleep(&mut self, key: S::Key) -> Result<(), StaleKey> {
        self.set_asleep(key, true)
    }

    fn wake(&mut self, key: S::Key) -> Result<(), StaleKey> {
        self.set_asleep(key, false)
    }

    fn candidates(&self) -> impl ExactSizeIterator<Item = (S::Key, S::Key)> + Clone {
        self.candidates.iter().map(|(_, candidate)| candidate.keys)
    }

    fn candidates_of(&self, key: S::Key) -> impl Iterator<Item = (S::Key, S::Key)> + Clone {
        self.pairs_of(key)
    }

    fn contacts(&self) -> impl ExactSizeIterator<Item = Contact<'_, S::Key, S::Manifold>> + Clone {
        self.show_contacts()
    }

    fn contacts_of(&self, key: S::Key) -> impl Iterator<Item = Contact<'_, S::Key, S::Manifold>> + Clone {
        self.records_of(key).map(|index| self.show(index))
    }

    fn contact(&self, one: S::Key, other: S::Key) -> Option<Contact<'_, S::Key, S::Manifold>> {
        self.record_of(one, other).map(|index| self.show(index))
    }

    fn is_touching(&self, one: S::Key, other: S::Key) -> bool {
        self.has_begun(one, other)
    }

    fn touching(&self, key: S::Key) -> impl Iterator<Item = S::Key> + Clone {
        self.touched_by(key)
    }

    fn events(&self) -> &[Event<S::Key>] {
        &self.events
    }

    fn impacts(&self) -> &[Hit<S::Key, S::Impact>] {
        &self.impacts
    }

    fn impacts_of(&self, bullet: S::Key) -> impl Iterator<Item = &Hit<S::Key, S::Impact>> + Clone {
        self.hits_of(bullet)
    }
}
