//! Events: contacts that began or ended between two updates.

use crate::contact::other_of;
use crate::space::{BodyKey2, BodyKey3};

/// A contact that began or ended. Each `Began` is followed, at some later update, by exactly one `Ended`.
///
/// `world.contact(a, b)` returns the contact that belongs to a `Began`.
///
/// ```
/// use asunder::{Collider3, Event3, Sphere, World3};
/// let mut world = World3::new();
/// let ball = Collider3::new(Sphere::new(1.0)?);
/// let [a, b] = [7, 8].map(|number| world.insert(ball.clone().user_data(number)));
/// world.update();
/// let (user_data_a, user_data_b, sensor) = (7, 8, false);
/// assert_eq!(world.events(), [Event3::Began { a, b, user_data_a, user_data_b, sensor }]);
/// world.remove(b);
/// world.update();
/// assert_eq!(world.events(), [Event3::Ended { a, b, user_data_a, user_data_b, sensor }], "of a body that is gone, too");
/// # Ok::<(), asunder::RadiusError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Event<K> {
    /// Two bodies share a point for the first time since they were last apart.
    Began {
        /// The body in the lower slot.
        a: K,
        /// The other body.
        b: K,
        /// The number attached to `a`.
        user_data_a: u64,
        /// The number attached to `b`.
        user_data_b: u64,
        /// Whether either body is a sensor.
        sensor: bool,
    },
    /// A contact that had begun is over. The possible causes:
    /// - the bodies are further apart than the sum of their margins, having moved or got other shapes;
    /// - they may not meet any more;
    /// - one of them was disabled or removed.
    Ended {
        /// The body in the lower slot. Its key may be stale by now.
        a: K,
        /// The other body. Its key may be stale by now.
        b: K,
        /// The number attached to `a` when the contact last existed.
        user_data_a: u64,
        /// The number attached to `b` at that time.
        user_data_b: u64,
        /// Whether either body was a sensor when they last touched.
        sensor: bool,
    },
}

/// An event in the plane.
pub type Event2 = Event<BodyKey2>;

/// An event in space.
pub type Event3 = Event<BodyKey3>;

impl<K: Copy + PartialEq> Event<K> {
    /// The two bodies, the one in the lower slot first.
    ///
    /// ```
    /// use asunder::{Collider2, Rect, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let unit = Rect::from_half_extents(Vec2::ONE)?;
    /// let coin = world.insert(Collider2::new(unit).sensor().user_data(5));
    /// let player = world.insert(Collider2::new(unit));
    /// world.update();
    /// let event = world.events()[0];
    /// assert_eq!(event.bodies(), (coin, player));
    /// assert_eq!((event.other(player), event.other(coin)), (Some(coin), Some(player)));
    /// assert_eq!(event.user_data(), (5, 0));
    /// assert!(event.is_began() && event.is_sensor());
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    pub fn bodies(&self) -> (K, K) {
        match *self {
            Self::Began { a, b, .. } | Self::Ended { a, b, .. } => (a, b),
        }
    }

    /// The other body of the event, which `body` met or left; `None` if the event is not about `body`.
    pub fn other(&self, body: K) -> Option<K> {
        other_of(self.bodies(), body)
    }

    /// The numbers attached to the two bodies, in their order.
    pub fn user_data(&self) -> (u64, u64) {
        match *self {
            Self::Began { user_data_a, user_data_b, .. } | Self::Ended { user_data_a, user_data_b, .. } => {
                (user_data_a, user_data_b)
            }
        }
    }

    /// Whether the event is a `Began`.
    pub fn is_began(&self) -> bool {
        matches!(self, Self::Began { .. })
    }

    /// Whether either body is a sensor, or was when they last touched.
    pub fn is_sensor(&self) -> bool {
        match *self {
            Self::Began { sensor, .. } | Self::Ended { sensor, .. } => sensor,
        }
    }
}
