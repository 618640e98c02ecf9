//! What changed between two updates.

use crate::space::{BodyKey2, BodyKey3};

/// A contact that began or ended. Each `Began` is followed, at some later update, by exactly one `Ended`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event<K> {
    /// Two bodies share a point for the first time since they were last apart.
    Began {
        /// The body in the lower slot.
        a: K,
        /// The other body.
        b: K,
        /// What was attached to `a`.
        user_data_a: u64,
        /// What was attached to `b`.
        user_data_b: u64,
    },
    /// A contact that had begun is gone: the bodies are further apart than their margins, or one was removed.
    Ended {
        /// The body in the lower slot. Its key may be stale by now.
        a: K,
        /// The other body. Its key may be stale by now.
        b: K,
        /// What was attached to `a`.
        user_data_a: u64,
        /// What was attached to `b`.
        user_data_b: u64,
    },
}

/// An event in the plane.
pub type Event2 = Event<BodyKey2>;

/// An event in space.
pub type Event3 = Event<BodyKey3>;

impl<K: Copy> Event<K> {
    /// The two bodies, the one in the lower slot first.
    ///
    /// ```
    /// use asunder::{Collider2, Rect, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let a = world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?));
    /// let b = world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?));
    /// world.update();
    /// assert_eq!(world.events()[0].bodies(), (a, b));
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    pub fn bodies(&self) -> (K, K) {
        match *self {
            Self::Began { a, b, .. } | Self::Ended { a, b, .. } => (a, b),
        }
    }
}
