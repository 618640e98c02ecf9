//! What a body is set to, read and changed one by one; alike in both dimensions.

use crate::space::Space;
use crate::world::{StaleKey, World};

impl<S: Space> World<S> {
    /// Where a body is; nothing for a stale key. Cost: constant.
    ///
    /// ```
    /// use asunder::{Collider3, Pose3, Sphere, World3, glam::DVec3};
    /// let mut world = World3::new();
    /// let ball = world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at([0.0, 2.0, 0.0])?));
    /// let fallen = world.pose(ball).ok_or("it is there")?.shifted(DVec3::NEG_Y)?;
    /// world.set_pose(ball, fallen)?;
    /// assert_eq!(world.pose(ball).map(|pose| pose.position()), Some(DVec3::Y));
    /// world.remove(ball);
    /// assert_eq!(world.pose(ball), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pose(&self, key: S::Key) -> Option<&S::Pose> {
        self.bodies.get(key).map(|body| &body.pose)
    }

    /// Makes a body one that notices and is not touched, or one that is solid. A contact that goes on goes on as the other kind:
    /// without a new `Began`, and its `Ended` says what it was last.
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let (player, ghost) = (world.insert(ball.clone()), world.insert(ball.sensor()));
    /// world.update();
    /// assert!(world.contact(player, ghost).is_some_and(|contact| contact.sensor && contact.manifolds.is_empty()));
    /// world.set_sensor(ghost, false)?;
    /// world.update();
    /// assert!(world.contact(player, ghost).is_some_and(|contact| !contact.sensor && contact.manifolds.len() == 1));
    /// assert!(world.events().is_empty() && world.is_touching(player, ghost));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_sensor(&mut self, key: S::Key, sensor: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.sensor = sensor)
    }

    /// Makes a body one of the level, or one that moves. Ground is of the level, whatever is said here. Contacts of bodies that are both
    /// fixed by then end at the next update.
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, World2};
    /// let mut world = World2::new();
    /// let rock = Collider2::new(Circle::new(1.0)?).fixed();
    /// let [a, b] = [(); 2].map(|()| world.insert(rock.clone()));
    /// world.update();
    /// assert!(!world.is_touching(a, b));
    /// world.set_fixed(b, false)?; // it comes loose
    /// world.update();
    /// assert!(world.is_touching(a, b));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_fixed(&mut self, key: S::Key, fixed: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.fixed = fixed || S::is_ground(&body.shape))
    }

    /// Gives a body to an owner, or to nobody. Contacts with other bodies of its owner end at the next update.
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?).owner(7);
    /// let [hand, sword] = [(); 2].map(|()| world.insert(ball.clone()));
    /// world.update();
    /// assert!(!world.is_touching(hand, sword));
    /// world.set_owner(sword, None)?; // it is dropped
    /// world.update();
    /// assert!(world.is_touching(hand, sword));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_owner(&mut self, key: S::Key, owner: Option<u64>) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.owner = owner)
    }

    /// Says whether the next updates tell what a body runs into in its motions: [`Collider::bullet`](crate::Collider::bullet).
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Motion2, Pose2, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let (shot, wall) = (world.insert(ball.clone()), world.insert(ball.at(Pose2::at([9.0, 0.0])?)));
    /// for is_bullet in [false, true] {
    ///     world.set_bullet(shot, is_bullet)?;
    ///     world.set_motion(shot, Motion2::shift([20.0, 0.0])?)?;
    ///     world.update();
    ///     assert_eq!(world.impacts_of(shot).iter().any(|hit| hit.other == wall), is_bullet);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_bullet(&mut self, key: S::Key, bullet: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.bullet = bullet)
    }
}
