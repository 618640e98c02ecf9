//! Which bodies a query is about.

use crate::collider::{Collider, Layers};
use crate::space::{Plane, Space, Volume};
use core::fmt;

/// Which bodies a query may find; use it as [`Filter2`] or [`Filter3`].
///
/// Every condition must hold. Without any, all bodies are found, sensors among them.
///
/// ```
/// use asunder::{Collider3, Cuboid, Filter3, Layers, World3, glam::Vec3};
/// let mut world = World3::new();
/// let unit = Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?);
/// let player = world.insert(unit.clone().owner(1));
/// let coin = world.insert(unit.clone().sensor());
/// let wall = world.insert(unit.layers(Layers { member_of: 0b10, ..Layers::default() }));
///
/// let mut found = vec![];
/// world.overlapping_point(Vec3::ZERO, &Filter3::new(), &mut found);
/// assert_eq!(found, [player, coin, wall]);
/// world.overlapping_point(Vec3::ZERO, &Filter3::new().without(player), &mut found);
/// assert_eq!(found, [coin, wall]);
/// world.overlapping_point(Vec3::ZERO, &Filter3::new().without_owner(1).solid(), &mut found);
/// assert_eq!(found, [wall]);
/// let shot = Layers { member_of: u32::MAX, collides_with: 0b01 };
/// world.overlapping_point(Vec3::ZERO, &Filter3::new().layers(shot), &mut found);
/// assert_eq!(found, [player, coin]);
/// let is_odd = |_, body: &Collider3| body.get_user_data() % 2 == 1;
/// world.overlapping_point(Vec3::ZERO, &Filter3::new().only(&is_odd), &mut found);
/// assert_eq!(found, []);
/// # Ok::<(), asunder::ExtentError>(())
/// ```
pub struct Filter<'a, S: Space> {
    layers: Option<Layers>,
    of_layers: Option<u32>,
    without: Option<S::Key>,
    without_all: &'a [S::Key],
    without_owner: Option<u64>,
    is_solid: bool,
    is_apart: bool,
    only: Option<Only<'a, S>>,
}

type Only<'a, S> = &'a (dyn Fn(<S as Space>::Key, &Collider<S>) -> bool + Sync);

/// Which bodies of a [`World2`](crate::World2) a query may find.
///
/// ```
/// use asunder::{Circle, Collider2, Filter2, World2};
/// let mut world = World2::new();
/// let coin = world.insert(Collider2::new(Circle::new(0.1)?).sensor());
/// assert!(world.closest([1.0, 0.0], 5.0, &Filter2::new()).is_some_and(|near| near.body == coin));
/// assert!(world.closest([1.0, 0.0], 5.0, &Filter2::new().solid()).is_none());
/// # Ok::<(), asunder::RadiusError>(())
/// ```
pub type Filter2<'a> = Filter<'a, Plane>;

/// Which bodies of a [`World3`](crate::World3) a query may find. See [`Filter`].
pub type Filter3<'a> = Filter<'a, Volume>;

impl<'a, S: Space> Filter<'a, S> {
    /// Lets all bodies pass.
    pub const fn new() -> Self {
        Self {
            layers: None,
            of_layers: None,
            without: None,
            without_all: &[],
            without_owner: None,
            is_solid: false,
            is_apart: false,
            only: None,
        }
    }

    /// Queries as a body of these layers: finds only bodies whose layers and these agree to meet. To name the layers that
    /// are to be found, use [`of_layers`](Self::of_layers).
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Layers, Ray3, Sphere, World3, glam::Vec3};
    /// const WALL: u32 = 1;
    /// const FRIEND: u32 = 2;
    /// let mut world = World3::new();
    /// let friend = Layers { member_of: FRIEND, collides_with: u32::MAX };
    /// world.insert(Collider3::new(Sphere::new(0.5)?).layers(friend));
    /// // What is found is what it collides with.
    /// let shot = Layers { member_of: u32::MAX, collides_with: WALL };
    /// let ray = Ray3::new([-5.0, 0.0, 0.0], Vec3::X)?;
    /// assert!(world.cast_ray(&ray, 99.0, &Filter3::new().layers(shot)).is_none(), "friends are passed");
    /// assert!(world.cast_ray(&ray, 99.0, &Filter3::new()).is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn layers(mut self, layers: Layers) -> Self {
        self.layers = Some(layers);
        self
    }

    /// Finds only members of one of these layers, one bit each, whatever they collide with: for a line of sight that only
    /// walls block. Another call replaces the one before.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Layers, Sphere, World3, glam::Vec3};
    /// const WALL: u32 = 1;
    /// const GLASS: u32 = 2;
    /// const PEOPLE: u32 = 4;
    /// let mut world = World3::new();
    /// let [wall, glass, _somebody] = [WALL, GLASS, PEOPLE].map(|layer| {
    ///     let layers = Layers { member_of: layer, collides_with: PEOPLE };
    ///     world.insert(Collider3::new(Sphere::new(1.0).unwrap()).layers(layers))
    /// });
    /// let mut found = vec![];
    /// world.overlapping_point(Vec3::ZERO, &Filter3::new().of_layers(WALL), &mut found);
    /// assert_eq!(found, [wall]);
    /// world.overlapping_point(Vec3::ZERO, &Filter3::new().of_layers(WALL | GLASS), &mut found);
    /// assert_eq!(found, [wall, glass]);
    /// world.overlapping_point(Vec3::ZERO, &Filter3::new().of_layers(0), &mut found);
    /// assert_eq!(found, []);
    /// ```
    #[must_use]
    pub const fn of_layers(mut self, member_of: u32) -> Self {
        self.of_layers = Some(member_of);
        self
    }

    /// Leaves out one body, such as the one that makes the query. A stale key leaves out no body. Another call replaces
    /// the one before: to leave out several bodies, use [`without_all`](Self::without_all), or their owner.
    #[must_use]
    pub const fn without(mut self, body: S::Key) -> Self {
        self.without = Some(body);
        self
    }

    /// Leaves out several bodies, such as the one that makes the query and those that it carries. Another call replaces
    /// the one before. Cost: for each body that is met, linear in the number of bodies left out.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Sphere, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// let [hero, sword, foe] = [(); 3].map(|()| world.insert(Collider3::new(Sphere::new(1.0).unwrap())));
    /// let mut found = vec![];
    /// world.overlapping_point(Vec3::ZERO, &Filter3::new().without_all(&[hero, sword]), &mut found);
    /// assert_eq!(found, [foe]);
    /// ```
    #[must_use]
    pub const fn without_all(mut self, bodies: &'a [S::Key]) -> Self {
        self.without_all = bodies;
        self
    }

    /// Leaves out all bodies of an owner, such as the parts of the character that makes the query. Another call
    /// replaces the one before.
    #[must_use]
    pub const fn without_owner(mut self, owner: u64) -> Self {
        self.without_owner = Some(owner);
        self
    }

    /// Leaves out sensors.
    #[must_use]
    pub const fn solid(mut self) -> Self {
        self.is_solid = true;
        self
    }

    /// Leaves out every body in which a ray starts or which a moved shape touches at the start: for shots out of a
    /// vehicle, and for cameras that start in a character's head.
    ///
    /// - Bodies are left out as a whole, ground that the query starts on as well: so start a little off it.
    /// - It has no effect on queries that are no casts, on `cast_shape_onwards`, which passes over single parts, and on
    ///   characters.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Pose3, Ray3, Sphere, World3, glam::{DVec3, Vec3}};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let tank = world.insert(ball.clone());
    /// let foe = world.insert(ball.at(Pose3::at([9.0, 0.0, 0.0])?));
    /// let ray = Ray3::new(DVec3::ZERO, Vec3::X)?;
    /// let hit = |filter: Filter3| world.cast_ray(&ray, 99.0, &filter).map(|hit| (hit.body, hit.inside));
    /// assert_eq!(hit(Filter3::new()), Some((tank, true)));
    /// assert_eq!(hit(Filter3::new().without_touched()), Some((foe, false)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn without_touched(mut self) -> Self {
        self.is_apart = true;
        self
    }

    /// Finds only bodies for which the closure returns true. It is called last, for bodies whose boxes may be met, in
    /// no promised order, and may itself query the world. Another call replaces the one before.
    #[must_use]
    pub const fn only(mut self, only: &'a (dyn Fn(S::Key, &Collider<S>) -> bool + Sync)) -> Self {
        self.only = Some(only);
        self
    }

    /// Also finds bodies that are touched at the start: for a character, which stands on one.
    pub(crate) const fn with_touched(mut self) -> Self {
        self.is_apart = false;
        self
    }

    /// Whether it admits a body, as far as can be said without calling the game's closure.
    #[inline]
    pub(super) fn admits(&self, key: S::Key, body: &Collider<S>) -> bool {
        let is_left_out = self.without == Some(key) || self.without_all.contains(&key);
        !(body.disabled || is_left_out || self.is_solid && body.sensor)
            && (self.without_owner.is_none() || self.without_owner != body.owner)
            && self.layers.is_none_or(|layers| layers.meets(body.layers))
            && self.of_layers.is_none_or(|mask| mask & body.layers.member_of != 0)
    }

    /// Whether it admits an answer, by whether it is touched at the start.
    #[inline]
    pub(super) fn admits_start(&self, is_touched: bool) -> bool {
        !(self.is_apart && is_touched)
    }

    #[inline]
    pub(super) fn agrees(&self, key: S::Key, body: &Collider<S>) -> bool {
        self.only.is_none_or(|only| only(key, body))
    }
}

impl<S: Space> Default for Filter<'_, S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Space> Clone for Filter<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Space> Copy for Filter<'_, S> {}

impl<S: Space> fmt::Debug for Filter<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Filter")
            .field("layers", &self.layers)
            .field("of_layers", &self.of_layers)
            .field("without", &self.without)
            .field("without_all", &self.without_all)
            .field("without_owner", &self.without_owner)
            .field("is_solid", &self.is_solid)
            .field("is_apart", &self.is_apart)
            .field("has_only", &self.only.is_some())
            .finish()
    }
}
