//! One trait for both worlds, so that the model and the operation lists are written once.

#[macro_use]
mod forwarded;
mod plane;
mod volume;

use crate::cases::Random;
use asunder::slotmap::Key;
use asunder::{Collider, Contact, Event, Hit, Layers, Space, World};
use asunder_narrow::Hint;

/// A change to an existing body.
#[derive(Clone, Debug)]
pub enum Change<S: Space> {
    /// `World::set_shape`.
    Shape(S::Shape),
    /// `World::set_layers`.
    Layers(Layers),
    /// `World::set_user_data`.
    UserData(u64),
    /// `World::enable`.
    Enable,
    /// `World::disable`.
    Disable,
    /// `World::sleep`.
    Sleep,
    /// `World::wake`.
    Wake,
    /// `World::set_sensor`.
    Sensor(bool),
    /// `World::set_fixed`.
    Fixed(bool),
    /// `World::set_owner`.
    Owner(Option<u64>),
    /// `World::set_bullet`.
    Bullet(bool),
    /// `World::set_impacts_only`.
    ImpactsOnly(bool),
    /// `World::set_margin`.
    Margin(f32),
    /// `World::replace`.
    Replace(Collider<S>),
}

impl<S: Engine> Change<S> {
    /// A random change.
    pub fn random(random: &mut Random) -> Self {
        let groups = [0b01, 0b10, 0b11, u32::MAX];
        let mut body = S::random_body(random, 1.6);
        match random.below(22) {
            0..4 => Self::Shape(S::shape_of(&body).clone()),
            4..6 => {
                Self::Layers(Layers { member_of: random.pick(&groups), collides_with: random.pick(&groups) })
            }
            6 => Self::UserData(random.below(1 << 20) as u64),
            7..10 => Self::Enable,
            10..12 => Self::Disable,
            12 => Self::Sleep,
            13 => Self::Wake,
            14 => Self::Sensor(random.below(2) == 0),
            15 => Self::Fixed(random.below(2) == 0),
            16 => Self::Owner(Some(random.below(4) as u64).filter(|&owner| owner < 3)),
            17 => Self::Bullet(random.below(2) == 0),
            // Draws no number of its own, so that the lists of other changes stay what they were.
            18 => Self::ImpactsOnly(body.get_user_data() % 2 == 0),
            19 => Self::Margin(body.get_margin()),
            _ => {
                // A body must be returned as it was; the model knows no sleeping or disabled ones.
                body = body.user_data(random.below(1 << 20) as u64);
                Self::Replace(body)
            }
        }
    }
}

/// A dimension's world, by the calls that both dimensions have.
pub trait Engine: Space + Clone + core::fmt::Debug {
    /// `World::insert`.
    fn insert(world: &mut World<Self>, body: Collider<Self>) -> Self::Key;
    /// `World::remove`.
    fn remove(world: &mut World<Self>, key: Self::Key) -> Option<Collider<Self>>;
    /// `World::get`.
    fn get(world: &World<Self>, key: Self::Key) -> Option<&Collider<Self>>;
    /// `World::set_pose`: whether the key was fresh.
    fn set_pose(world: &mut World<Self>, key: Self::Key, pose: Self::Pose) -> bool;
    /// Makes a change; returns whether the key was fresh.
    fn change(world: &mut World<Self>, key: Self::Key, change: &Change<Self>) -> bool;
    /// `World::set_motion`: whether the key was fresh.
    fn set_motion(world: &mut World<Self>, key: Self::Key, motion: Self::Motion) -> bool;
    /// `World::impacts`.
    fn impacts(world: &World<Self>) -> &[Hit<Self::Key, Self::Impact>];
    /// `Pair::impact`: the fraction of the motion, whether they overlap at the start, and the impact.
    fn first_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
    ) -> Option<(f64, bool, Self::Impact)>;
    /// `Pair::next_impact_beside`, and the fraction of the motion.
    fn next_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
        touches: &[Self::Touch],
    ) -> Option<(f64, Self::Impact)>;
    /// `Pair::add_touches`.
    fn add_touches(a: &Collider<Self>, b: &Collider<Self>, to: &mut Vec<Self::Touch>);
    /// A motion by up to `reach` on each axis, turning or not.
    fn random_motion(random: &mut Random, reach: f64) -> Self::Motion;
    /// A motion along the first axis.
    fn shift(x: f64) -> Self::Motion;
    /// `Collider::shape`.
    fn shape_of(body: &Collider<Self>) -> &Self::Shape;
    /// The same body with another shape.
    fn shaped(body: &Collider<Self>, shape: Self::Shape) -> Collider<Self>;
    /// The same body with other traits.
    fn with_traits(body: &Collider<Self>, traits: Traits) -> Collider<Self>;
    /// `World::iter`.
    fn bodies(world: &World<Self>) -> Vec<(Self::Key, Collider<Self>)>;
    /// `World::candidates`.
    fn candidates(world: &World<Self>) -> Vec<(Self::Key, Self::Key)>;
    /// `World::candidates_of`.
    fn candidates_of(world: &World<Self>, key: Self::Key) -> Vec<(Self::Key, Self::Key)>;
    /// `World::events_of`.
    fn events_of(world: &World<Self>, key: Self::Key) -> Vec<Event<Self::Key>>;
    /// `World::contacts`.
    fn contacts(world: &World<Self>) -> Vec<Contact<'_, Self::Key, Self::Manifold>>;
    /// `World::contacts_of`.
    fn contacts_of(world: &World<Self>, key: Self::Key) -> Vec<Contact<'_, Self::Key, Self::Manifold>>;
    /// `World::contact`.
    fn contact(
        world: &World<Self>,
        one: Self::Key,
        other: Self::Key,
    ) -> Option<Contact<'_, Self::Key, Self::Manifold>>;
    /// `World::is_touching`.
    fn is_touching(world: &World<Self>, one: Self::Key, other: Self::Key) -> bool;
    /// `World::touching`.
    fn touching(world: &World<Self>, key: Self::Key) -> Vec<Self::Key>;
    /// `World::events`.
    fn events(world: &World<Self>) -> &[Event<Self::Key>];
    /// `Collider::at`.
    fn moved(body: Collider<Self>, pose: Self::Pose) -> Collider<Self>;
    /// `Collider::pose`.
    fn pose_of(body: &Collider<Self>) -> Self::Pose;
    /// Whether the boxes of two bodies, grown by their margins, share a point.
    fn boxes_overlap(a: &Collider<Self>, b: &Collider<Self>) -> bool;
    /// What the narrow phase reports for two bodies that overlap or are within the margin: which of the two, and their
    /// manifolds. Half-spaces that overlap without bound have none. Contact points keep what they were built on in the
    /// last frame, as given by the hint; returns the next hint.
    fn meet(a: &Collider<Self>, b: &Collider<Self>, hint: Hint) -> (Hint, Met<Self>);
    /// A unit cube or square, of side 1, at `x` on the first axis.
    fn unit_at(x: f64) -> Collider<Self>;
    /// The pose of [`Engine::unit_at`].
    fn pose_at(x: f64) -> Self::Pose;
    /// A pose within `reach` of the origin on each axis.
    fn random_pose(random: &mut Random, reach: f64) -> Self::Pose;
    /// A body of about a metre, of any kind, within `reach` of the origin on each axis.
    fn random_body(random: &mut Random, reach: f64) -> Collider<Self>;
}

/// Whether two bodies overlap, and their manifolds, if they are within the margin.
pub type Met<S> = Option<(bool, Vec<<S as Space>::Manifold>)>;

/// The slot of a key, by which pairs are ordered: the low half of a slotmap key's bits.
pub fn slot_of(key: impl Key) -> u32 {
    key.data().as_ffi() as u32
}

/// The traits of a body that its builder can only turn on.
#[derive(Clone, Copy, Debug)]
pub struct Traits {
    /// `Collider::fixed`.
    pub fixed: bool,
    /// `Collider::sensor`.
    pub sensor: bool,
    /// `Collider::bullet`.
    pub bullet: bool,
    /// `Collider::impacts_only`.
    pub impacts_only: bool,
    /// `Collider::owner`.
    pub owner: Option<u64>,
}

impl Traits {
    /// The traits of a body.
    pub fn of<S: Space>(body: &Collider<S>) -> Self {
        let (fixed, sensor) = (body.is_fixed(), body.is_sensor());
        let (bullet, impacts_only) = (body.is_bullet(), body.is_impacts_only());
        Self { fixed, sensor, bullet, impacts_only, owner: body.get_owner() }
    }
}

/// `body` with `traits`, and everything else but shape and pose taken from `other`.
fn with_traits<S: Space>(mut body: Collider<S>, other: &Collider<S>, traits: Traits) -> Collider<S> {
    body =
        body.layers(other.get_layers()).user_data(other.get_user_data()).margin(other.get_margin()).unwrap();
    if traits.fixed {
        body = body.fixed();
    }
    if traits.sensor {
        body = body.sensor();
    }
    if traits.bullet {
        body = body.bullet();
    }
    if traits.impacts_only {
        body = body.impacts_only();
    }
    traits.owner.into_iter().fold(body, Collider::owner)
}

/// Gives a body some of the traits that decide what it meets.
fn with_random_traits<S: Space>(mut body: Collider<S>, random: &mut Random) -> Collider<S> {
    if random.below(6) == 0 {
        body = body.fixed();
    }
    if random.below(6) == 0 {
        body = body.sensor();
    }
    if random.below(4) == 0 {
        let groups = [0b01, 0b10, 0b11, 0];
        body = body.layers(Layers { member_of: random.pick(&groups), collides_with: random.pick(&groups) });
    }
    if random.below(4) == 0 {
        body = body.owner(random.below(3) as u64);
    }
    if random.below(3) == 0 {
        body = body.margin(random.pick(&[0.01, 0.1, 0.5])).unwrap();
    }
    body.user_data(random.below(1 << 20) as u64)
}
