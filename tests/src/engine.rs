//! One face for both worlds, so that the model and the operation lists are written once.

use crate::cases::Random;
use crate::shapes::{Clay, KINDS2, KINDS3};
use asunder::slotmap::Key;
use asunder::{
    Collider, Contact, Cuboid, Event, Hit, Hull, Layers, Motion2, Motion3, Pair2, Pair3, Plane, Polygon,
    Pose2, Pose3, Rect, Shape2, Shape3, Space, Touch2, Touch3, Volume, World,
};
use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
use glam::{Vec2, Vec3};

/// What may be changed of a body that is there.
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
    /// `World::set_margin`.
    Margin(f32),
    /// `World::replace`.
    Replace(Collider<S>),
}

impl<S: Engine> Change<S> {
    /// Any of them.
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
            18..20 => Self::Margin(body.get_margin()),
            _ => {
                // A body is given back as it was; the model knows none that sleep or are disabled.
                body = body.user_data(random.below(1 << 20) as u64);
                Self::Replace(body)
            }
        }
    }
}

/// A dimension's world, by the calls that both have.
pub trait Engine: Space + Clone + core::fmt::Debug {
    /// `World::insert`.
    fn insert(world: &mut World<Self>, body: Collider<Self>) -> Self::Key;
    /// `World::remove`.
    fn remove(world: &mut World<Self>, key: Self::Key) -> Option<Collider<Self>>;
    /// `World::get`.
    fn get(world: &World<Self>, key: Self::Key) -> Option<&Collider<Self>>;
    /// `World::set_pose`: whether the key was fresh.
    fn set_pose(world: &mut World<Self>, key: Self::Key, pose: Self::Pose) -> bool;
    /// Whether the key was fresh, and so the change was made.
    fn change(world: &mut World<Self>, key: Self::Key, change: &Change<Self>) -> bool;
    /// `World::set_motion`: whether the key was fresh.
    fn set_motion(world: &mut World<Self>, key: Self::Key, motion: Self::Motion) -> bool;
    /// `World::impacts`.
    fn impacts(world: &World<Self>) -> &[Hit<Self::Key, Self::Impact>];
    /// `Pair::impact`: the share of the motion, whether they overlap at the start, and all of it.
    fn first_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
    ) -> Option<(f64, bool, Self::Impact)>;
    /// `Pair::next_impact_beside`, and the share of the motion.
    fn next_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
        touches: &[Self::Touch],
    ) -> Option<(f64, Self::Impact)>;
    /// `Pair::add_touches`.
    fn add_touches(a: &Collider<Self>, b: &Collider<Self>, to: &mut Vec<Self::Touch>);
    /// A motion by up to `reach` on each axis that turns, or does not.
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
    /// What the narrow phase says of two bodies that overlap or are within the margin: which of both, and their
    /// manifolds. Half-spaces that overlap without end have none.
    /// Contact points keep to what they were made on in the last frame, which the hint says; the next one comes back.
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

/// What of a body a builder only ever turns on.
#[derive(Clone, Copy, Debug)]
pub struct Traits {
    /// `Collider::fixed`.
    pub fixed: bool,
    /// `Collider::sensor`.
    pub sensor: bool,
    /// `Collider::bullet`.
    pub bullet: bool,
    /// `Collider::owner`.
    pub owner: Option<u64>,
}

impl Traits {
    /// Those of a body.
    pub fn of<S: Space>(body: &Collider<S>) -> Self {
        let (fixed, sensor, bullet) = (body.is_fixed(), body.is_sensor(), body.is_bullet());
        Self { fixed, sensor, bullet, owner: body.get_owner() }
    }
}

/// A body of one's shape and pose, with what else another is, and these traits.
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
    traits.owner.into_iter().fold(body, Collider::owner)
}

/// Gives a body some of the traits that decide whom it meets.
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

impl Engine for Volume {
    fn insert(world: &mut World<Self>, body: Collider<Self>) -> Self::Key {
        world.insert(body)
    }

    fn remove(world: &mut World<Self>, key: Self::Key) -> Option<Collider<Self>> {
        world.remove(key)
    }

    fn get(world: &World<Self>, key: Self::Key) -> Option<&Collider<Self>> {
        assert_eq!(world.contains(key), world.get(key).is_some());
        world.get(key)
    }

    fn set_pose(world: &mut World<Self>, key: Self::Key, pose: Self::Pose) -> bool {
        world.set_pose(key, pose).is_ok()
    }

    fn change(world: &mut World<Self>, key: Self::Key, change: &Change<Self>) -> bool {
        let done = match change.clone() {
            Change::Shape(shape) => world.set_shape(key, shape),
            Change::Layers(layers) => world.set_layers(key, layers),
            Change::UserData(number) => world.set_user_data(key, number),
            Change::Enable => world.enable(key),
            Change::Disable => world.disable(key),
            Change::Sleep => world.sleep(key),
            Change::Wake => world.wake(key),
            Change::Sensor(sensor) => world.set_sensor(key, sensor),
            Change::Fixed(fixed) => world.set_fixed(key, fixed),
            Change::Owner(owner) => world.set_owner(key, owner),
            Change::Bullet(bullet) => world.set_bullet(key, bullet),
            Change::Margin(margin) => return world.set_margin(key, margin).is_ok(),
            Change::Replace(body) => world.replace(key, body).map(|_| ()),
        };
        done.is_ok()
    }

    fn set_motion(world: &mut World<Self>, key: Self::Key, motion: Self::Motion) -> bool {
        world.set_motion(key, motion).is_ok()
    }

    fn impacts(world: &World<Self>) -> &[Hit<Self::Key, Self::Impact>] {
        world.impacts()
    }

    fn first_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
    ) -> Option<(f64, bool, Self::Impact)> {
        let pair = Pair3::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.impact(a.1, b.1).map(|impact| (impact.fraction, impact.overlapping, impact))
    }

    fn next_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
        touches: &[Touch3],
    ) -> Option<(f64, Self::Impact)> {
        let pair = Pair3::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.next_impact_beside(touches, a.1, b.1).map(|impact| (impact.fraction, impact))
    }

    fn add_touches(a: &Collider<Self>, b: &Collider<Self>, to: &mut Vec<Touch3>) {
        Pair3::new(a.shape(), a.pose(), b.shape(), b.pose()).add_touches(to);
    }

    fn random_motion(random: &mut Random, reach: f64) -> Self::Motion {
        let displacement = random.vector() * reach;
        if random.below(2) == 0 {
            return Motion3::shift(displacement).unwrap();
        }
        Motion3::new(displacement, random.quaternion()).unwrap()
    }

    fn shift(x: f64) -> Self::Motion {
        Motion3::shift([x, 0.0, 0.0]).unwrap()
    }

    fn shape_of(body: &Collider<Self>) -> &Self::Shape {
        body.shape()
    }

    fn shaped(body: &Collider<Self>, shape: Self::Shape) -> Collider<Self> {
        with_traits(Collider::<Self>::new(shape).at(*body.pose()), body, Traits::of(body))
    }

    fn with_traits(body: &Collider<Self>, traits: Traits) -> Collider<Self> {
        with_traits(Collider::<Self>::new(body.shape().clone()).at(*body.pose()), body, traits)
    }

    fn bodies(world: &World<Self>) -> Vec<(Self::Key, Collider<Self>)> {
        world.iter().map(|(key, body)| (key, body.clone())).collect()
    }

    fn candidates(world: &World<Self>) -> Vec<(Self::Key, Self::Key)> {
        world.candidates().collect()
    }

    fn candidates_of(world: &World<Self>, key: Self::Key) -> Vec<(Self::Key, Self::Key)> {
        world.candidates_of(key).collect()
    }

    fn contacts(world: &World<Self>) -> Vec<Contact<'_, Self::Key, Self::Manifold>> {
        world.contacts().collect()
    }

    fn contacts_of(world: &World<Self>, key: Self::Key) -> Vec<Contact<'_, Self::Key, Self::Manifold>> {
        world.contacts_of(key).collect()
    }

    fn contact(
        world: &World<Self>,
        one: Self::Key,
        other: Self::Key,
    ) -> Option<Contact<'_, Self::Key, Self::Manifold>> {
        world.contact(one, other)
    }

    fn is_touching(world: &World<Self>, one: Self::Key, other: Self::Key) -> bool {
        world.is_touching(one, other)
    }

    fn touching(world: &World<Self>, key: Self::Key) -> Vec<Self::Key> {
        world.touching(key).collect()
    }

    fn events(world: &World<Self>) -> &[Event<Self::Key>] {
        world.events()
    }

    fn moved(body: Collider<Self>, pose: Self::Pose) -> Collider<Self> {
        body.at(pose)
    }

    fn pose_of(body: &Collider<Self>) -> Self::Pose {
        *body.pose()
    }

    fn boxes_overlap(a: &Collider<Self>, b: &Collider<Self>) -> bool {
        let bounds = |body: &Collider<Self>| body.shape().bounds(body.pose(), body.get_margin());
        bounds(a).overlaps(&bounds(b))
    }

    fn meet(a: &Collider<Self>, b: &Collider<Self>, hint: Hint) -> (Hint, Met<Self>) {
        let mut batch = Batch3::default();
        let margin = a.get_margin() + b.get_margin();
        let (shape_a, pose_a, shape_b, pose_b) = (a.shape(), a.pose(), b.shape(), b.pose());
        let sensor = a.is_sensor() || b.is_sensor();
        collide3(&[Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint, sensor }], &mut batch);
        let overlaps = Pair3::new(shape_a, pose_a, shape_b, pose_b).overlaps();
        match batch.answers[0] {
            Answer::Apart { hint, .. } => {
                assert!(!overlaps);
                (hint, None)
            }
            Answer::Contact { hint, overlapping, .. } => {
                assert_eq!(overlapping, overlaps);
                (hint, Some((overlapping, batch.manifolds)))
            }
        }
    }

    fn unit_at(x: f64) -> Collider<Self> {
        let unit = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap();
        Collider::<Self>::new(unit).at(Self::pose_at(x))
    }

    fn pose_at(x: f64) -> Self::Pose {
        Pose3::at([x, 0.0, 0.0]).unwrap()
    }

    fn random_pose(random: &mut Random, reach: f64) -> Self::Pose {
        Pose3::new(random.vector() * reach, random.quaternion()).unwrap()
    }

    fn random_body(random: &mut Random, reach: f64) -> Collider<Self> {
        let wedge =
            [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.6, 0.7, 0.2), Vec3::new(0.4, 0.1, -0.3)];
        let shape: Shape3 = match random.below(40) {
            // The last row is the half-space, which touches half of all others: too many in a large room.
            0 if reach < 2.0 || random.below(40) == 0 => {
                KINDS3[KINDS3.len() - 1].1(&mut Clay::new(random, 0.7))
            }
            0..30 => KINDS3[random.below(KINDS3.len() - 1)].1(&mut Clay::new(random, 0.7)),
            30..34 => Hull::from_points(&wedge).unwrap().into(),
            34..37 => Cuboid::from_half_extents(Vec3::new(0.6, 0.3, 0.2)).unwrap().into(),
            _ => Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap().into(),
        };
        let pose = Self::random_pose(random, reach);
        with_random_traits(Collider::<Self>::new(shape).at(pose), random)
    }
}

impl Engine for Plane {
    fn insert(world: &mut World<Self>, body: Collider<Self>) -> Self::Key {
        world.insert(body)
    }

    fn remove(world: &mut World<Self>, key: Self::Key) -> Option<Collider<Self>> {
        world.remove(key)
    }

    fn get(world: &World<Self>, key: Self::Key) -> Option<&Collider<Self>> {
        assert_eq!(world.contains(key), world.get(key).is_some());
        world.get(key)
    }

    fn set_pose(world: &mut World<Self>, key: Self::Key, pose: Self::Pose) -> bool {
        world.set_pose(key, pose).is_ok()
    }

    fn change(world: &mut World<Self>, key: Self::Key, change: &Change<Self>) -> bool {
        let done = match change.clone() {
            Change::Shape(shape) => world.set_shape(key, shape),
            Change::Layers(layers) => world.set_layers(key, layers),
            Change::UserData(number) => world.set_user_data(key, number),
            Change::Enable => world.enable(key),
            Change::Disable => world.disable(key),
            Change::Sleep => world.sleep(key),
            Change::Wake => world.wake(key),
            Change::Sensor(sensor) => world.set_sensor(key, sensor),
            Change::Fixed(fixed) => world.set_fixed(key, fixed),
            Change::Owner(owner) => world.set_owner(key, owner),
            Change::Bullet(bullet) => world.set_bullet(key, bullet),
            Change::Margin(margin) => return world.set_margin(key, margin).is_ok(),
            Change::Replace(body) => world.replace(key, body).map(|_| ()),
        };
        done.is_ok()
    }

    fn set_motion(world: &mut World<Self>, key: Self::Key, motion: Self::Motion) -> bool {
        world.set_motion(key, motion).is_ok()
    }

    fn impacts(world: &World<Self>) -> &[Hit<Self::Key, Self::Impact>] {
        world.impacts()
    }

    fn first_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
    ) -> Option<(f64, bool, Self::Impact)> {
        let pair = Pair2::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.impact(a.1, b.1).map(|impact| (impact.fraction, impact.overlapping, impact))
    }

    fn next_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
        touches: &[Touch2],
    ) -> Option<(f64, Self::Impact)> {
        let pair = Pair2::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.next_impact_beside(touches, a.1, b.1).map(|impact| (impact.fraction, impact))
    }

    fn add_touches(a: &Collider<Self>, b: &Collider<Self>, to: &mut Vec<Touch2>) {
        Pair2::new(a.shape(), a.pose(), b.shape(), b.pose()).add_touches(to);
    }

    fn random_motion(random: &mut Random, reach: f64) -> Self::Motion {
        let displacement = random.vector().truncate() * reach;
        if random.below(2) == 0 {
            return Motion2::shift(displacement).unwrap();
        }
        Motion2::new(displacement, random.rotation2()).unwrap()
    }

    fn shift(x: f64) -> Self::Motion {
        Motion2::shift([x, 0.0]).unwrap()
    }

    fn shape_of(body: &Collider<Self>) -> &Self::Shape {
        body.shape()
    }

    fn shaped(body: &Collider<Self>, shape: Self::Shape) -> Collider<Self> {
        with_traits(Collider::<Self>::new(shape).at(*body.pose()), body, Traits::of(body))
    }

    fn with_traits(body: &Collider<Self>, traits: Traits) -> Collider<Self> {
        with_traits(Collider::<Self>::new(body.shape().clone()).at(*body.pose()), body, traits)
    }

    fn bodies(world: &World<Self>) -> Vec<(Self::Key, Collider<Self>)> {
        world.iter().map(|(key, body)| (key, body.clone())).collect()
    }

    fn candidates(world: &World<Self>) -> Vec<(Self::Key, Self::Key)> {
        world.candidates().collect()
    }

    fn candidates_of(world: &World<Self>, key: Self::Key) -> Vec<(Self::Key, Self::Key)> {
        world.candidates_of(key).collect()
    }

    fn contacts(world: &World<Self>) -> Vec<Contact<'_, Self::Key, Self::Manifold>> {
        world.contacts().collect()
    }

    fn contacts_of(world: &World<Self>, key: Self::Key) -> Vec<Contact<'_, Self::Key, Self::Manifold>> {
        world.contacts_of(key).collect()
    }

    fn contact(
        world: &World<Self>,
        one: Self::Key,
        other: Self::Key,
    ) -> Option<Contact<'_, Self::Key, Self::Manifold>> {
        world.contact(one, other)
    }

    fn is_touching(world: &World<Self>, one: Self::Key, other: Self::Key) -> bool {
        world.is_touching(one, other)
    }

    fn touching(world: &World<Self>, key: Self::Key) -> Vec<Self::Key> {
        world.touching(key).collect()
    }

    fn events(world: &World<Self>) -> &[Event<Self::Key>] {
        world.events()
    }

    fn moved(body: Collider<Self>, pose: Self::Pose) -> Collider<Self> {
        body.at(pose)
    }

    fn pose_of(body: &Collider<Self>) -> Self::Pose {
        *body.pose()
    }

    fn boxes_overlap(a: &Collider<Self>, b: &Collider<Self>) -> bool {
        let bounds = |body: &Collider<Self>| body.shape().bounds(body.pose(), body.get_margin());
        bounds(a).overlaps(&bounds(b))
    }

    fn meet(a: &Collider<Self>, b: &Collider<Self>, _: Hint) -> (Hint, Met<Self>) {
        let pair = Pair2::new(a.shape(), a.pose(), b.shape(), b.pose());
        let (overlapping, manifolds) = (pair.overlaps(), pair.manifolds(a.get_margin() + b.get_margin()));
        (Hint::NONE, (overlapping || !manifolds.is_empty()).then_some((overlapping, manifolds)))
    }

    fn unit_at(x: f64) -> Collider<Self> {
        let unit = Rect::from_half_extents(Vec2::splat(0.5)).unwrap();
        Collider::<Self>::new(unit).at(Self::pose_at(x))
    }

    fn pose_at(x: f64) -> Self::Pose {
        Pose2::at([x, 0.0]).unwrap()
    }

    fn random_pose(random: &mut Random, reach: f64) -> Self::Pose {
        Pose2::new(random.vector().truncate() * reach, random.rotation2()).unwrap()
    }

    fn random_body(random: &mut Random, reach: f64) -> Collider<Self> {
        let kite = [Vec2::ZERO, Vec2::X, Vec2::new(0.8, 0.7), Vec2::new(-0.2, 0.4)];
        let shape: Shape2 = match random.below(40) {
            // The last row is the half-plane, which touches half of all others: too many in a large room.
            0 if reach < 2.0 || random.below(40) == 0 => {
                KINDS2[KINDS2.len() - 1].1(&mut Clay::new(random, 0.7))
            }
            0..30 => KINDS2[random.below(KINDS2.len() - 1)].1(&mut Clay::new(random, 0.7)),
            30..34 => Polygon::new(&kite).unwrap().into(),
            34..37 => Rect::from_half_extents(Vec2::new(0.6, 0.2)).unwrap().into(),
            _ => Rect::from_half_extents(Vec2::splat(0.4)).unwrap().into(),
        };
        let pose = Self::random_pose(random, reach);
        with_random_traits(Collider::<Self>::new(shape).at(pose), random)
    }
}
