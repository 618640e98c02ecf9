//! What the last update found in the plane: candidates, contacts, events and impacts.

use crate::contact::Contact2;
use crate::event::Event2;
use crate::motion::Hit2;
use crate::space::{BodyKey2, Plane};
use crate::world::World;

impl World<Plane> {
    /// Pairs whose boxes overlapped and whose filters agreed at the last update, in pair order: those that were passed
    /// to the narrow phase.
    pub fn candidates(&self) -> impl ExactSizeIterator<Item = (BodyKey2, BodyKey2)> + Clone {
        self.candidates.iter().map(|(_, candidate)| candidate.keys)
    }

    /// The candidate pairs of one body: those whose boxes overlapped and whose filters agreed.
    ///
    /// They are in order of the other body's slot; empty for a stale key. Pairs with bodies that were removed since are
    /// left out. They show which bodies this one may meet next; [`contacts_of`](Self::contacts_of) has only those
    /// within their margins.
    ///
    /// Cost: linear in the candidates of lower slots, some 1 ns each, since updates build no index for it. For many
    /// bodies, iterate over [`candidates`](Self::candidates) once instead.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Pose2, World2};
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let mut world = World2::new();
    /// let a = world.insert(ball.clone());
    /// let b = world.insert(ball.clone().at(Pose2::at([1.5, 1.5])?));
    /// let c = world.insert(ball.at(Pose2::at([9.0, 0.0])?));
    /// world.update();
    /// assert_eq!(world.candidates_of(b).collect::<Vec<_>>(), [(a, b)]);
    /// assert_eq!(world.contacts_of(b).count(), 0, "corner to corner, boxes overlap where balls do not");
    /// assert_eq!(world.candidates_of(c).count(), 0);
    /// world.remove(b);
    /// assert_eq!(world.candidates_of(a).count() + world.candidates_of(b).count(), 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn candidates_of(&self, key: BodyKey2) -> impl Iterator<Item = (BodyKey2, BodyKey2)> + Clone {
        self.pairs_of(key)
    }

    /// Pairs within their margins of each other at the last update, and speculative ones, in pair order. Pairs with a
    /// body that was removed since are still listed.
    pub fn contacts(&self) -> impl ExactSizeIterator<Item = Contact2<'_>> + Clone {
        self.show_contacts()
    }

    /// Contacts of one body, in order of the other body's slot; empty for a stale key. Contacts with bodies that were
    /// removed since are left out. Cost: a binary search.
    pub fn contacts_of(&self, key: BodyKey2) -> impl Iterator<Item = Contact2<'_>> + Clone {
        self.records_of(key).map(|index| self.show(index))
    }

    /// The contact of two bodies, given in either order, if they have one. Cost: a binary search.
    pub fn contact(&self, one: BodyKey2, other: BodyKey2) -> Option<Contact2<'_>> {
        self.record_of(one, other).map(|index| self.show(index))
    }

    /// Whether the two bodies touch: `Began` was reported and `Ended` was not. Cost: a binary search.
    pub fn is_touching(&self, one: BodyKey2, other: BodyKey2) -> bool {
        self.has_begun(one, other)
    }

    /// The bodies that touch this one, sensors included, in order of their slots. Bodies that were removed since are
    /// left out. Cost: a binary search.
    pub fn touching(&self, key: BodyKey2) -> impl Iterator<Item = BodyKey2> + Clone {
        self.touched_by(key)
    }

    /// The contacts that began and ended at the last update, in pair order; where a slot was reused, `Ended` comes
    /// first.
    pub fn events(&self) -> &[Event2] {
        &self.events
    }

    /// The events of one body, in order of the other body's slot.
    ///
    /// - For a body that was removed since, these are the ends of its contacts.
    /// - It is empty for a key of which there is nothing to report.
    ///
    /// Cost: linear in the number of all events, since updates build no index for it. For many bodies, iterate over
    /// [`events`](Self::events) once instead.
    ///
    /// ```
    /// use asunder::{Collider2, Circle, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let coins = world.insert_many([ball.clone().sensor(), ball.clone().sensor()]);
    /// let hero = world.insert(ball);
    /// world.update();
    /// let found = world.events_of(hero).filter(|event| event.is_began()).filter_map(|event| event.other(hero));
    /// assert!(found.eq(coins.iter().copied()));
    /// assert_eq!(world.events_of(coins[0]).count(), 2, "sensors meet each other, too");
    /// world.remove(hero);
    /// world.update();
    /// assert!(world.events_of(hero).all(|event| !event.is_began()) && world.events_of(hero).count() == 2);
    /// # Ok::<(), asunder::RadiusError>(())
    /// ```
    pub fn events_of(&self, key: BodyKey2) -> impl Iterator<Item = &Event2> + Clone {
        self.events.iter().filter(move |event| event.other(key).is_some())
    }

    /// The impacts of bullets at the last update, by bullet and then by time: every sensor that a bullet crosses on its
    /// way, and the first body that is not a sensor.
    ///
    /// - A body that the bullet overlaps at the start is a contact and not listed here. If it has several parts (a
    ///   level in one piece), the parts that the bullet does not touch, such as the walls, still count: see
    ///   [`Pair2::next_impact`](crate::Pair2::next_impact).
    /// - Bodies that are flush with one that the bullet touches, like the next tile of a floor, are passed over: see
    ///   [`next_impact_beside`](crate::Pair2::next_impact_beside).
    /// - The motions of both bodies count. A ray cast sees bodies at their current poses, so it may report another
    ///   place.
    /// - A body that was removed since is still listed.
    pub fn impacts(&self) -> &[Hit2] {
        &self.impacts
    }

    /// The impacts of one bullet at the last update, by time.
    ///
    /// - Impacts with bodies that were removed since are left out.
    /// - It is empty for a stale key and for a body that is not a bullet.
    /// - For a bullet without a motion of its own, these are the moving bodies that ran into it.
    ///
    /// Cost: the logarithm of the number of all impacts.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Motion2, Pose2, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(0.5)?);
    /// let gate = world.insert(ball.clone().sensor().at(Pose2::at([3.0, 0.0])?));
    /// let wall = world.insert(ball.clone().at(Pose2::at([6.0, 0.0])?));
    /// let shot = world.insert(ball.bullet());
    /// world.set_motion(shot, Motion2::shift([9.0, 0.0])?)?;
    /// world.update();
    /// assert!(world.impacts_of(shot).map(|hit| hit.other).eq([gate, wall]));
    /// assert!(world.impacts_of(wall).next().is_none(), "it is no bullet");
    ///
    /// world.set_motion(wall, Motion2::shift([-9.0, 0.0])?)?;
    /// world.update();
    /// assert!(world.impacts_of(shot).map(|hit| hit.other).eq([wall]), "the shot stood");
    /// world.remove(wall);
    /// assert_eq!((world.impacts_of(shot).count(), world.impacts().len()), (0, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn impacts_of(&self, bullet: BodyKey2) -> impl Iterator<Item = &Hit2> + Clone {
        self.hits_of(bullet)
    }
}
