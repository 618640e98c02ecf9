//! The world in space: the engine's public interface, in plain types.

use crate::collider::{Collider3, Layers, SetMarginError, checked_margin};
use crate::space::{BodyKey3, Volume};
use crate::world::{StaleKey, World};
use asunder_geometry::{Motion3, Pose3, Shape3};
use asunder_narrow::{Impact3, Pair3};

/// A world of bodies in space.
///
/// Insert bodies, move them, call [`update`](World::update) once per frame, and read what touches. Contacts, candidates
/// and events are those of the last update; calls about one body, such as `contacts_of`, leave out bodies that were
/// removed since.
///
/// ```
/// use asunder::{Collider3, Cuboid, Pose3, World3, glam::Vec3};
/// let mut world = World3::new();
/// // Insert bodies, and keep their keys.
/// let unit = Cuboid::from_half_extents(Vec3::ONE)?;
/// let a = world.insert(Collider3::new(unit));
/// let b = world.insert(Collider3::new(unit).at(Pose3::at([8.0, 0.0, 0.0])?));
/// world.update();
/// assert_eq!(world.contacts().len(), 0);
///
/// // Each frame: move what moves, update, and read what touches and what changed.
/// world.set_pose(b, Pose3::IDENTITY)?;
/// world.update();
/// assert!(world.is_touching(a, b));
/// assert_eq!(world.candidates().collect::<Vec<_>>(), [(a, b)]);
/// assert_eq!(world.touching(b).collect::<Vec<_>>(), [a]);
/// assert_eq!(world.contact(b, a), world.contacts_of(a).next());
/// assert_eq!(world.events().len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Every property of a body may be changed while it is in the world:
///
/// ```
/// use asunder::{Collider3, Cuboid, Layers, Pose3, Sphere, World3, glam::Vec3};
/// let mut world = World3::new();
/// let unit = Cuboid::from_half_extents(Vec3::ONE)?;
/// let [a, b] = [(); 2].map(|()| world.insert(Collider3::new(unit)));
/// world.update();
///
/// world.disable(b)?;
/// world.update();
/// assert!(!world.is_touching(a, b) && !world.events()[0].is_began());
/// world.enable(b)?;
/// world.set_poses([(a, Pose3::IDENTITY), (b, Pose3::at([8.0, 0.0, 0.0])?)])?;
/// world.set_shape(b, Sphere::new(3.0)?)?;
/// world.set_user_data(b, 12)?;
/// world.update();
/// assert_eq!(world.events().len(), 0, "a radius of 3 m ends at 5 m");
/// world.set_shape(a, Sphere::new(6.0)?)?;
/// world.update();
/// assert_eq!(world.events()[0].user_data(), (0, 12));
/// world.set_layers(b, Layers { member_of: 0, ..Layers::default() })?;
/// world.update();
/// assert!(!world.is_touching(a, b), "a member of nothing meets nobody");
///
/// world.sleep(b)?;
/// assert!(world.get(b).is_some_and(Collider3::is_asleep));
/// world.wake(b)?;
/// let ghost = world.replace(b, Collider3::new(unit).sensor().disabled())?;
/// assert_eq!(ghost.get_user_data(), 12);
/// assert_eq!(world.insert_many([ghost.clone(), ghost]).len(), 2);
///
/// assert!(world.contains(b) && world.get(b).is_some() && world.iter().count() == 4);
/// assert!(world.remove(b).is_some());
/// assert!(!world.contains(b));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type World3 = World<Volume>;

impl World<Volume> {
    /// Adds a body, which takes part from the next update on. Cost: constant.
    pub fn insert(&mut self, collider: Collider3) -> BodyKey3 {
        self.insert_body(collider)
    }

    /// Adds many bodies, in this order, and returns their keys.
    pub fn insert_many(&mut self, colliders: impl IntoIterator<Item = Collider3>) -> Vec<BodyKey3> {
        colliders.into_iter().map(|collider| self.insert(collider)).collect()
    }

    /// Removes a body and returns it; `None` for a stale key. Those of its contacts that had begun end at the next
    /// update.
    pub fn remove(&mut self, key: BodyKey3) -> Option<Collider3> {
        self.remove_body(key)
    }

    /// The body of a key; `None` for a stale one.
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

    /// Moves a body. Setting the same pose again, bit for bit, does not count as a move. Cost: constant.
    ///
    /// # Errors
    /// A stale key.
    pub fn set_pose(&mut self, key: BodyKey3, pose: Pose3) -> Result<(), StaleKey> {
        self.move_body(key, pose)
    }

    /// Moves many bodies, in this order.
    ///
    /// Cost: some 5 to 11 ns per body that is in the cache, 50 ns for one that must be fetched. The next update makes
    /// their boxes, at 25 ns each, in parallel.
    ///
    /// # Errors
    /// A stale key among them; all the other bodies are moved.
    pub fn set_poses(&mut self, poses: impl IntoIterator<Item = (BodyKey3, Pose3)>) -> Result<(), StaleKey> {
        let mut outcome = Ok(());
        for (key, pose) in poses {
            outcome = self.set_pose(key, pose).and(outcome);
        }
        outcome
    }

    /// Announces to the next update how a body will move in this frame.
    ///
    /// The update looks ahead along the motion and then forgets it; the pose stays as it is. A sleeping body is woken.
    ///
    /// - [`contacts`](Self::contacts) also lists the contacts that the motion may bring, as speculative ones: all pairs
    ///   whose separation is at most the sum of their margins plus an upper bound (at most 1e6 m) on how much nearer
    ///   their motions can bring them. A pair with a sensor has no speculative contact.
    /// - For a [`bullet`](Collider3::bullet) there are [`impacts`](Self::impacts) as well; these do include sensors.
    /// - On ground, they include slopes that begin further along the same floor, within the length of the motion.
    /// - A one-sided triangle of ground has neither a speculative contact nor an impact with a part that is clear of it
    ///   and whose centre is behind its front before the motions. So a body that rises beside the edge of a ledge
    ///   passes it.
    /// - Every part of a compound within that distance has a manifold: insert thousands of parts as separate bodies
    ///   with one owner instead.
    ///
    /// # Errors
    /// A stale key.
    pub fn set_motion(&mut self, key: BodyKey3, motion: Motion3) -> Result<(), StaleKey> {
        self.set_motion_of(key, motion)
    }

    /// When two bodies first touch while both move and turn; `None` if they do not. The answer is conservative: it is
    /// never too late, and carries its error. For a body that stands still, pass a motion of zero.
    ///
    /// ```
    /// use asunder::{Sphere, Collider3, Motion3, Pose3, StaleKey, World3, glam::DVec3};
    /// let mut world = World3::new();
    /// let one = world.insert(Collider3::new(Sphere::new(1.0)?));
    /// let other = world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at(DVec3::X * 6.0)?));
    /// let (right, left) = (Motion3::shift(DVec3::X * 4.0)?, Motion3::shift(DVec3::X * -4.0)?);
    /// let impact = world.impact(one, other, &right, &left)?.ok_or("they meet")?;
    /// assert!(impact.fraction <= 0.5 && impact.fraction > 0.499_99);
    /// world.remove(other);
    /// assert_eq!(world.impact(one, other, &right, &left), Err(StaleKey));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A stale key.
    pub fn impact(
        &self,
        a: BodyKey3,
        b: BodyKey3,
        motion_a: &Motion3,
        motion_b: &Motion3,
    ) -> Result<Option<Impact3>, StaleKey> {
        let (a, b) = (self.bodies.get(a).ok_or(StaleKey)?, self.bodies.get(b).ok_or(StaleKey)?);
        Ok(Pair3::new(&a.shape, &a.pose, &b.shape, &b.pose).impact(motion_a, motion_b))
    }

    /// Gives a body another shape.
    ///
    /// - A contact continues as long as the bodies are within their margins, as it does when they move. So when a level
    ///   is changed, the contacts of bodies elsewhere on it do not begin anew.
    /// - A body that becomes ground becomes fixed, and stays fixed when it later gets another shape: call
    ///   [`set_fixed`](Self::set_fixed) to make it movable again.
    ///
    /// # Errors
    /// A stale key.
    pub fn set_shape(&mut self, key: BodyKey3, shape: impl Into<Shape3>) -> Result<(), StaleKey> {
        self.reshape_body(key, shape.into())
    }

    /// Changes which groups a body is in and which it meets. Contacts with bodies that it no longer meets end at the
    /// next update.
    ///
    /// # Errors
    /// A stale key.
    pub fn set_layers(&mut self, key: BodyKey3, layers: Layers) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.layers = layers)
    }

    /// Attaches another number to a body. Events and contacts of later updates carry it, but an `Ended` carries the
    /// number that was attached at the last update in which the contact existed.
    ///
    /// # Errors
    /// A stale key.
    pub fn set_user_data(&mut self, key: BodyKey3, user_data: u64) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.user_data = user_data)
    }

    /// The pose of a body; `None` for a stale key. Cost: constant.
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
    pub fn pose(&self, key: BodyKey3) -> Option<&Pose3> {
        self.bodies.get(key).map(|body| &body.pose)
    }

    /// Makes a body a sensor, or solid again. An existing contact continues as one of the other kind: there is no new
    /// `Began`, and its `Ended` reports which kind it was last.
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Collider3, Sphere, World3};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let (player, ghost) = (world.insert(ball.clone()), world.insert(ball.sensor()));
    /// world.update();
    /// assert!(world.contact(player, ghost).is_some_and(|contact| contact.sensor && contact.manifolds.is_empty()));
    /// world.set_sensor(ghost, false)?;
    /// world.update();
    /// assert!(world.contact(player, ghost).is_some_and(|contact| !contact.sensor && contact.manifolds.len() == 1));
    /// assert!(world.events().is_empty() && world.is_touching(player, ghost));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_sensor(&mut self, key: BodyKey3, sensor: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.sensor = sensor)
    }

    /// Makes a body fixed (part of the level) or movable. Ground stays fixed whatever is passed here. Contacts between
    /// two bodies that are now both fixed end at the next update.
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Collider3, Sphere, World3};
    /// let mut world = World3::new();
    /// let rock = Collider3::new(Sphere::new(1.0)?).fixed();
    /// let [a, b] = [(); 2].map(|()| world.insert(rock.clone()));
    /// world.update();
    /// assert!(!world.is_touching(a, b));
    /// world.set_fixed(b, false)?; // it comes loose
    /// world.update();
    /// assert!(world.is_touching(a, b));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_fixed(&mut self, key: BodyKey3, fixed: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.fixed = fixed || body.shape.is_ground())
    }

    /// Sets the owner of a body, or removes it with `None`. Contacts with other bodies of its owner end at the next
    /// update.
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Collider3, Sphere, World3};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?).owner(7);
    /// let [hand, sword] = [(); 2].map(|()| world.insert(ball.clone()));
    /// world.update();
    /// assert!(!world.is_touching(hand, sword));
    /// world.set_owner(sword, None)?; // it is dropped
    /// world.update();
    /// assert!(world.is_touching(hand, sword));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_owner(&mut self, key: BodyKey3, owner: Option<u64>) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.owner = owner)
    }

    /// Gives a body another margin, in metres: see [`Collider::margin`](crate::Collider::margin).
    ///
    /// # Errors
    /// A stale key, or a margin out of range.
    ///
    /// ```
    /// use asunder::{Collider3, Pose3, Sphere, World3};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let (a, b) = (world.insert(ball.clone()), world.insert(ball.at(Pose3::at([2.05, 0.0, 0.0])?)));
    /// world.update();
    /// assert!(world.contact(a, b).is_none());
    /// world.set_margin(a, 0.1)?;
    /// world.update();
    /// assert!(world.contact(a, b).is_some_and(|contact| !contact.overlapping));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_margin(&mut self, key: BodyKey3, margin: f32) -> Result<(), SetMarginError> {
        let margin = checked_margin(margin).map_err(SetMarginError::Margin)?;
        self.change_body(key, |body| body.margin = margin).map_err(|StaleKey| SetMarginError::Stale)
    }

    /// Sets whether updates from now on report what a body runs into during its motions: see
    /// [`Collider::bullet`](crate::Collider::bullet).
    ///
    /// # Errors
    /// A stale key.
    ///
    /// ```
    /// use asunder::{Collider3, Motion3, Pose3, Sphere, World3};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let (shot, wall) = (world.insert(ball.clone()), world.insert(ball.at(Pose3::at([9.0, 0.0, 0.0])?)));
    /// for is_bullet in [false, true] {
    ///     world.set_bullet(shot, is_bullet)?;
    ///     world.set_motion(shot, Motion3::shift([20.0, 0.0, 0.0])?)?;
    ///     world.update();
    ///     assert_eq!(world.impacts_of(shot).any(|hit| hit.other == wall), is_bullet);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_bullet(&mut self, key: BodyKey3, bullet: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.bullet = bullet)
    }

    /// Sets whether a body's motions from now on bring no speculative contacts: see
    /// [`Collider::impacts_only`](crate::Collider::impacts_only).
    ///
    /// # Errors
    /// A stale key.
    pub fn set_impacts_only(&mut self, key: BodyKey3, impacts_only: bool) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.impacts_only = impacts_only)
    }

    /// Lets a disabled body take part again.
    ///
    /// # Errors
    /// A stale key.
    pub fn enable(&mut self, key: BodyKey3) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.disabled = false)
    }

    /// Takes a body out of the game without removing it: its contacts end at the next update, it pairs with no body,
    /// and no query finds it.
    ///
    /// # Errors
    /// A stale key.
    pub fn disable(&mut self, key: BodyKey3) -> Result<(), StaleKey> {
        self.change_body(key, |body| body.disabled = true)
    }

    /// Marks a body as at rest. Another pose or a motion wakes it.
    ///
    /// This is only a flag for the game and its solver, which [`Filter3`](crate::Filter3) and hooks can read. The world
    /// itself does not rely on it: it detects which bodies did not move, and keeps their contacts without recomputing
    /// them.
    ///
    /// # Errors
    /// A stale key.
    pub fn sleep(&mut self, key: BodyKey3) -> Result<(), StaleKey> {
        self.set_asleep(key, true)
    }

    /// Marks a body as no longer at rest.
    ///
    /// # Errors
    /// A stale key.
    pub fn wake(&mut self, key: BodyKey3) -> Result<(), StaleKey> {
        self.set_asleep(key, false)
    }

    /// Replaces the whole body under the same key and returns the old one: for changes that have no call of their own.
    /// A motion that was set for this frame is forgotten.
    ///
    /// # Errors
    /// A stale key.
    pub fn replace(&mut self, key: BodyKey3, collider: Collider3) -> Result<Collider3, StaleKey> {
        self.replace_body(key, collider)
    }
}
