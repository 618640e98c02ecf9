//! Bodies as the engine sees them: shape, pose, and which other bodies they may meet.

use crate::space::{Plane, Space, Volume};
use crate::world::StaleKey;
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};

/// Which groups a body is in, and which groups it meets.
///
/// Two bodies pair only if each is in a group that the other meets. A body without layers of its own is in all groups
/// and meets all groups: so a coin that meets only players also meets every crate for which no layers were set.
///
/// Cost: overlapping boxes are found before layers are checked, and take time. 10,000 bodies in one spot, on a layer
/// that does not meet itself, take a third of a second in the update in which they appear.
///
/// ```
/// use asunder::Layers;
/// let player = Layers { member_of: 0b01, collides_with: 0b11 };
/// let ghost = Layers { member_of: 0b10, collides_with: 0b10 };
/// assert!(!player.meets(ghost), "both sides must agree");
/// assert!(player.meets(Layers::default()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Layers {
    /// One bit for each group that the body is in.
    pub member_of: u32,
    /// One bit for each group that the body meets.
    pub collides_with: u32,
}

impl Layers {
    /// Whether both sides agree to meet.
    #[inline]
    pub const fn meets(self, other: Self) -> bool {
        self.member_of & other.collides_with != 0 && other.member_of & self.collides_with != 0
    }
}

/// Decides whether two bodies may pair at all, wherever they are. Small, and stored apart from everything else, since
/// the broad phase reads it for every pair of overlapping boxes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tag {
    layers: Layers,
    owner: Option<u64>,
    fixed: bool,
}

impl Tag {
    pub(crate) fn of<S: Space>(body: &Collider<S>) -> Self {
        Self { layers: body.layers, owner: body.owner, fixed: body.fixed }
    }

    pub(crate) const fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// Whether both sides agree. Two fixed bodies never meet, nor do two of one owner.
    #[inline]
    pub(crate) fn may_meet(&self, other: &Self) -> bool {
        self.layers.meets(other.layers)
            & !(self.fixed & other.fixed)
            & (self.owner.is_none() || self.owner != other.owner)
    }
}

impl Default for Layers {
    /// A member of every group that meets every group.
    fn default() -> Self {
        Self { member_of: u32::MAX, collides_with: u32::MAX }
    }
}

/// Why a margin was rejected.
///
/// ```
/// use asunder::{Collider2, MarginError, Rect, glam::Vec2};
/// let body = Collider2::new(Rect::from_half_extents(Vec2::ONE)?);
/// assert_eq!(body.margin(-0.5).unwrap_err(), MarginError { value: -0.5 });
/// # Ok::<(), asunder::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarginError {
    /// The rejected margin, in metres.
    pub value: f32,
}

impl core::fmt::Display for MarginError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let most = asunder_geometry::tolerance::MAX_RADIUS;
        write!(
            f,
            "margin {} is not between 0 and {most} m: give the gap at which contacts should appear",
            self.value
        )
    }
}

impl core::error::Error for MarginError {}

/// Why [`World3::set_margin`](crate::World3::set_margin) changed nothing.
///
/// ```
/// use asunder::{Collider3, MarginError, SetMarginError, Sphere, World3};
/// let mut world = World3::new();
/// let ball = world.insert(Collider3::new(Sphere::new(1.0)?));
/// assert_eq!(world.set_margin(ball, -1.0), Err(SetMarginError::Margin(MarginError { value: -1.0 })));
/// world.remove(ball);
/// assert_eq!(world.set_margin(ball, 0.1), Err(SetMarginError::Stale));
/// # Ok::<(), asunder::RadiusError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SetMarginError {
    /// The key's body is gone.
    Stale,
    /// The margin is out of range.
    Margin(MarginError),
}

impl core::fmt::Display for SetMarginError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Stale => StaleKey.fmt(f),
            Self::Margin(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SetMarginError {}

/// Returns a margin, in metres, if it is valid.
pub(crate) fn checked_margin(margin: f32) -> Result<f32, MarginError> {
    let is_margin = (0.0..=asunder_geometry::tolerance::MAX_RADIUS).contains(&margin);
    if is_margin { Ok(margin) } else { Err(MarginError { value: margin }) }
}

/// The description of a body: [`World3::insert`](crate::World3::insert) takes one, and
/// [`World3::get`](crate::World3::get) returns it.
///
/// Shape and pose differ between [`Collider2`] and [`Collider3`]; everything else is common. By default a body is
/// movable, solid, enabled, in every layer, without owner and without margin, and its `user_data` is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Collider<S: Space> {
    pub(crate) shape: S::Shape,
    pub(crate) pose: S::Pose,
    pub(crate) layers: Layers,
    pub(crate) owner: Option<u64>,
    pub(crate) user_data: u64,
    pub(crate) margin: f32,
    pub(crate) fixed: bool,
    pub(crate) sensor: bool,
    pub(crate) disabled: bool,
    pub(crate) asleep: bool,
    pub(crate) bullet: bool,
    pub(crate) impacts_only: bool,
}

/// A body in the plane.
///
/// ```
/// use asunder::{Collider2, Layers, Pose2, Rect, Rotation2, glam::Vec2};
/// let door = Collider2::new(Rect::from_half_extents(Vec2::new(0.1, 1.0))?)
///     .at(Pose2::new([4.0, 1.0], Rotation2::IDENTITY)?)
///     .layers(Layers { member_of: 0b10, ..Layers::default() })
///     .user_data(77);
/// assert_eq!((door.get_user_data(), door.pose().position().x), (77, 4.0));
/// assert!((door.shape().outer_radius() - 1.005).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Collider2 = Collider<Plane>;

/// A body in space.
///
/// ```
/// use asunder::{Collider3, Cuboid, Pose3, glam::Vec3};
/// let coin = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.1))?)
///     .at(Pose3::at([0.0, 1.0, 0.0])?)
///     .sensor()
///     .fixed()
///     .owner(3)
///     .margin(0.05)?;
/// assert!(coin.is_sensor() && coin.is_fixed());
/// assert_eq!((coin.get_owner(), coin.get_margin()), (Some(3), 0.05));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Collider3 = Collider<Volume>;

impl Collider<Plane> {
    /// A body of this shape at the origin.
    pub fn new(shape: impl Into<Shape2>) -> Self {
        Self::with_shape(shape.into())
    }

    /// Puts the body somewhere.
    #[must_use]
    pub fn at(mut self, pose: Pose2) -> Self {
        self.pose = pose;
        self
    }

    /// The shape.
    pub fn shape(&self) -> &Shape2 {
        &self.shape
    }

    /// The pose.
    pub fn pose(&self) -> &Pose2 {
        &self.pose
    }
}

impl Collider<Volume> {
    /// A body of this shape at the origin.
    pub fn new(shape: impl Into<Shape3>) -> Self {
        Self::with_shape(shape.into())
    }

    /// Puts the body somewhere.
    #[must_use]
    pub fn at(mut self, pose: Pose3) -> Self {
        self.pose = pose;
        self
    }

    /// The shape.
    pub fn shape(&self) -> &Shape3 {
        &self.shape
    }

    /// The pose.
    pub fn pose(&self) -> &Pose3 {
        &self.pose
    }
}

impl<S: Space> Collider<S> {
    fn with_shape(shape: S::Shape) -> Self {
        let fixed = S::is_ground(&shape);
        Self {
            shape,
            pose: S::Pose::default(),
            layers: Layers::default(),
            owner: None,
            user_data: 0,
            margin: 0.0,
            fixed,
            sensor: false,
            disabled: false,
            asleep: false,
            bullet: false,
            impacts_only: false,
        }
    }

    /// Makes the body part of the level: two fixed bodies never pair. `set_pose` may still move it. Ground (a
    /// [`TriMesh`](crate::TriMesh), a [`HeightField`](crate::HeightField) or a [`Chain`](crate::Chain)) is fixed
    /// without this call.
    #[must_use]
    pub fn fixed(mut self) -> Self {
        self.fixed = true;
        self
    }

    /// Makes the body a sensor: it only detects, and its contacts have no manifolds. It meets the same bodies as a
    /// solid one would, and other sensors. A fixed sensor meets no fixed body, so a sensor that has to detect a fixed
    /// lift must not be fixed.
    #[must_use]
    pub fn sensor(mut self) -> Self {
        self.sensor = true;
        self
    }

    /// Makes the body a bullet, which must not pass through things.
    ///
    /// If it has a motion ([`World3::set_motion`](crate::World3::set_motion)), the update reports which bodies it runs
    /// into first ([`World3::impacts`](crate::World3::impacts)); stopping it there is up to the game. Bodies that it
    /// touches at the start are left out; of ground and compounds, only the parts that it touches.
    ///
    /// The motion also brings speculative contacts, which take most of the time. If nobody reads them:
    /// [`impacts_only`](Self::impacts_only).
    #[must_use]
    pub fn bullet(mut self) -> Self {
        self.bullet = true;
        self
    }

    /// Leaves out the speculative contacts that the body's motions bring: of a bullet, impacts alone are left. Its pairs
    /// have contacts within their margins, as if neither body moved.
    ///
    /// For shots in games that do not solve contacts. It saves most of the time of their frames: speculative contacts
    /// are with all that is as near as the motion is long, in any direction, which may be hundreds of triangles of bumpy
    /// ground.
    ///
    /// ```
    /// use asunder::{Collider3, Cuboid, Motion3, Pose3, Sphere, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// let wall = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5))?).fixed();
    /// let wall = world.insert(wall.at(Pose3::at([3.0, 0.0, 0.0])?));
    /// let shot = world.insert(Collider3::new(Sphere::new(0.1)?).bullet().impacts_only());
    /// for has_contacts in [false, true] {
    ///     world.set_impacts_only(shot, !has_contacts)?;
    ///     world.set_motion(shot, Motion3::shift([5.0, 0.0, 0.0])?)?;
    ///     world.update();
    ///     assert!(world.impacts_of(shot).any(|hit| hit.other == wall));
    ///     assert_eq!(world.contact(shot, wall).is_some(), has_contacts);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn impacts_only(mut self) -> Self {
        self.impacts_only = true;
        self
    }

    /// Keeps the body out of the game until it is enabled: it pairs with no body, and no query finds it.
    #[must_use]
    pub fn disabled(mut self) -> Self {
        self.disabled = true;
        self
    }

    /// Sets which groups the body is in and which it meets.
    #[must_use]
    pub fn layers(mut self, layers: Layers) -> Self {
        self.layers = layers;
        self
    }

    /// Sets an owner: bodies of one owner, such as the parts of one character, never pair.
    #[must_use]
    pub fn owner(mut self, owner: u64) -> Self {
        self.owner = Some(owner);
        self
    }

    /// Attaches a number of your own; events and contacts carry it, and [`get_user_data`](Self::get_user_data) reads
    /// it.
    #[must_use]
    pub fn user_data(mut self, user_data: u64) -> Self {
        self.user_data = user_data;
        self
    }

    /// Sets the gap, in metres, at which contacts appear: a pair has a contact while its separation is at most the sum
    /// of both margins. It is also the hysteresis between `Began` and `Ended`.
    ///
    /// (A [`Pair3`](crate::Pair3) treats a margin below zero as zero; a body rejects it.)
    ///
    /// # Errors
    /// A margin that is not finite, below zero, or above 1e6.
    pub fn margin(mut self, margin: f32) -> Result<Self, MarginError> {
        self.margin = checked_margin(margin)?;
        Ok(self)
    }

    /// Whether the body is fixed, that is, part of the level.
    pub fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// Whether the body is a sensor.
    pub fn is_sensor(&self) -> bool {
        self.sensor
    }

    /// Whether the body is a bullet, so that updates report what it runs into.
    ///
    /// ```
    /// use asunder::{Collider2, Layers, Rect, glam::Vec2};
    /// let unit = Collider2::new(Rect::from_half_extents(Vec2::ONE)?);
    /// assert!(!unit.is_bullet() && unit.is_enabled() && !unit.clone().disabled().is_enabled());
    /// let layers = Layers { member_of: 0b10, ..Layers::default() };
    /// assert_eq!(unit.clone().layers(layers).get_layers(), layers);
    /// assert!(unit.bullet().is_bullet());
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    pub fn is_bullet(&self) -> bool {
        self.bullet
    }

    /// Whether the body's motions bring no speculative contacts.
    ///
    /// ```
    /// use asunder::{Circle, Collider2};
    /// let shot = Collider2::new(Circle::new(0.1)?).bullet();
    /// assert!(!shot.is_impacts_only() && shot.impacts_only().is_impacts_only());
    /// # Ok::<(), asunder::RadiusError>(())
    /// ```
    pub fn is_impacts_only(&self) -> bool {
        self.impacts_only
    }

    /// Whether the body is enabled and takes part.
    pub fn is_enabled(&self) -> bool {
        !self.disabled
    }

    /// Whether the body sleeps: see [`World3::sleep`](crate::World3::sleep).
    pub fn is_asleep(&self) -> bool {
        self.asleep
    }

    /// The layers.
    pub fn get_layers(&self) -> Layers {
        self.layers
    }

    /// The owner, if any.
    pub fn get_owner(&self) -> Option<u64> {
        self.owner
    }

    /// The number attached by [`user_data`](Self::user_data).
    pub fn get_user_data(&self) -> u64 {
        self.user_data
    }

    /// The margin, in metres.
    pub fn get_margin(&self) -> f32 {
        self.margin
    }
}
