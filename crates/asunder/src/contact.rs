//! Contacts: the data that the world keeps of a pair, and the view that it hands out.

use crate::space::{BodyKey2, BodyKey3};
use asunder_broad::PairId;
use asunder_narrow::{Hint, Manifold2, Manifold3};

/// Two bodies within the sum of their margins of each other, as of the last update.
///
/// ```
/// use asunder::{Collider3, Contact3, Cuboid, Pose3, World3, glam::Vec3};
/// let mut world = World3::new();
/// let unit = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5))?);
/// let below = world.insert(unit.clone().fixed().user_data(7));
/// let above = world.insert(unit.at(Pose3::at([0.0, 0.75, 0.0])?).user_data(8));
/// world.update();
/// let contact: Contact3 = world.contact(above, below).ok_or("they touch")?;
/// assert_eq!((contact.a, contact.b), (below, above), "by their slots, whichever was asked about first");
/// assert_eq!(contact.user_data, (7, 8));
/// assert!(contact.overlapping && contact.is_new && !contact.sensor && !contact.speculative);
/// assert_eq!((contact.manifolds.len(), contact.manifolds[0].normal), (1, Vec3::Y));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, PartialEq)]
pub struct Contact<'a, K, M> {
    /// The body in the lower slot.
    pub a: K,
    /// The other body.
    pub b: K,
    /// The numbers that the game attached to `a` and `b`, as of the last update: see
    /// [`Collider::user_data`](crate::Collider::user_data).
    pub user_data: (u64, u64),
    /// Whether either body is a sensor: then there are no manifolds.
    pub sensor: bool,
    /// Whether the bodies share a point now; touching counts.
    pub overlapping: bool,
    /// Whether their `Began` is among this update's events.
    pub is_new: bool,
    /// Whether the bodies are further apart than their margins, and listed only because their motions may bring them
    /// together. Such a pair does not count as touching, and has no `Began`, until it overlaps.
    ///
    /// A solver that lets no point close by more than its separation prevents tunnelling of bodies that do not turn;
    /// through ground of triangles a few motions in ten thousand lead nevertheless (guide: levels).
    pub speculative: bool,
    /// The manifolds: one for each pair of convex parts within the margins; on ground, one for each normal of each
    /// part. Normals point from `a` to `b`.
    ///
    /// - If the bodies have motions, there are also manifolds of parts that these may bring together, even if other
    ///   parts touch. A solver that does not handle speculative points should skip those whose separation is more than
    ///   the sum of both margins. On ground, slopes that begin further along have one each, whose points lie on the
    ///   slope's plane, and may lie below the floor before it.
    /// - The separation of a manifold is that of its own two parts; on ground, the one along its own normal. The least
    ///   separation of all manifolds is at most zero exactly when the bodies overlap.
    /// - For overlapping bodies, moving by that least separation does not free the whole body: a body in a corner, or
    ///   over a bend of a chain, is free only once it has left every manifold along the manifold's normal.
    /// - The list is empty for a sensor, and for two half-spaces whose overlap is unbounded: if all half-spaces are
    ///   fixed, as those of a level are, they never pair.
    pub manifolds: &'a [M],
}

impl<K: Copy + PartialEq, M> Contact<'_, K, M> {
    /// The other body of the contact, as seen from `body`; `None` if `body` is neither of the two.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let [a, b, c] = [(); 3].map(|()| world.insert(ball.clone()));
    /// world.remove(c);
    /// world.update();
    /// let contact = world.contacts_of(b).next().ok_or("they touch")?;
    /// assert_eq!((contact.other(b), contact.other(a), contact.other(c)), (Some(a), Some(b), None));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn other(&self, body: K) -> Option<K> {
        other_of((self.a, self.b), body)
    }

    /// The direction of normals as seen from `body`: 1 for `a`, from which they point to the other body, -1 for `b`,
    /// and 0 for any other body.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Pose2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let [left, right] = [0.0, 1.5].map(|x| Pose2::at([x, 0.0]).map(|pose| world.insert(ball.clone().at(pose))));
    /// let (left, right) = (left?, right?);
    /// world.update();
    /// for (body, towards) in [(left, Vec2::X), (right, Vec2::NEG_X)] {
    ///     let contact = world.contacts_of(body).next().ok_or("they touch")?;
    ///     assert_eq!(contact.manifolds[0].normal * contact.sign(body), towards, "from the body to the other");
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sign(&self, body: K) -> f32 {
        if body == self.a {
            1.0
        } else if body == self.b {
            -1.0
        } else {
            0.0
        }
    }
}

/// The other body of a pair; `None` if `body` is neither.
pub(crate) fn other_of<K: PartialEq>((a, b): (K, K), body: K) -> Option<K> {
    match (a, b) {
        (a, b) if a == body => Some(b),
        (a, b) if b == body => Some(a),
        _ => None,
    }
}

// Not derived: that would require manifolds that are `Copy`, but a contact only borrows them.
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

/// A pair whose boxes overlapped at the last update, and the data that is kept about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<K> {
    pub(crate) pair: PairId,
    pub(crate) keys: (K, K),
    pub(crate) hint: Hint,
    /// The place of the pair's persistent manifold.
    pub(crate) persistent: u32,
    /// Its contact, if it has one.
    pub(crate) contact: ContactNumber,
    /// For bodies that are apart, the sum of their paths up to which they stay so: see `odometer`.
    pub(crate) until: f64,
}

/// The number of a candidate's contact among the records, if it has one, and whether that has begun. For most contacts
/// that go on, nothing else of last update's is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ContactNumber(u32);

impl ContactNumber {
    /// No contact.
    pub(crate) const NONE: Self = Self(u32::MAX);

    /// The highest bit, free since no memory holds as many records.
    const BEGUN: u32 = 1 << 31;

    pub(crate) const fn new(number: usize, begun: bool) -> Self {
        Self(number as u32 | if begun { Self::BEGUN } else { 0 })
    }

    #[inline]
    pub(crate) const fn number(self) -> Option<usize> {
        if self.0 == Self::NONE.0 { None } else { Some((self.0 & !Self::BEGUN) as usize) }
    }

    /// Its number, if it has begun.
    #[inline]
    pub(crate) fn begun(self) -> Option<u32> {
        (self != Self::NONE && self.0 & Self::BEGUN != 0).then_some(self.0 & !Self::BEGUN)
    }
}

/// Where the manifolds of a contact are: a range in the list of the chunk that the pair was in.
///
/// They are never moved from there: see `frame::collide` for what that bought.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) chunk: u32,
    pub(crate) start: u32,
    pub(crate) end: u32,
}

impl Place {
    /// How many there are.
    pub(crate) const fn count(&self) -> usize {
        (self.end - self.start) as usize
    }
}

/// A contact as the world keeps it. Records are sorted by pair.
#[derive(Clone, Copy, Debug)]
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
    /// Whether the bodies are beyond their margins, but a motion may bring them together.
    pub(crate) speculative: bool,
}

#[cfg(test)]
impl<K: slotmap::Key> Record<K> {
    /// A contact of null keys.
    pub(crate) fn of_nobody(pair: PairId) -> Self {
        Self {
            pair,
            keys: (K::null(), K::null()),
            user_data: (0, 0),
            manifolds: Place { chunk: 0, start: 0, end: 0 },
            sensor: false,
            overlapping: true,
            begun: true,
            is_new: false,
            speculative: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_keeps_whether_its_contact_has_begun() {
        for number in [0, 1, 1023, 1024, (1 << 31) - 2] {
            let (begun, near) = (ContactNumber::new(number, true), ContactNumber::new(number, false));
            assert_eq!((begun.number(), near.number()), (Some(number), Some(number)));
            assert_eq!((begun.begun(), near.begun()), (Some(number as u32), None));
        }
        assert_eq!((ContactNumber::NONE.number(), ContactNumber::NONE.begun()), (None, None));
    }
}
