//! Methods that forward to a world or a body, the same in both dimensions.

/// The methods of an `Engine` that read the same in both dimensions: worlds and bodies have methods of the same names.
macro_rules! as_the_world_says {
    () => {
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
                Change::ImpactsOnly(impacts_only) => world.set_impacts_only(key, impacts_only),
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

        fn events_of(world: &World<Self>, key: Self::Key) -> Vec<Event<Self::Key>> {
            world.events_of(key).copied().collect()
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
    };
}
