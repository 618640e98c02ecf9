//! A world to walk in, and a character that walks.

use asunder::glam::{DVec3, Quat, Vec3};
use asunder::{Capsule3, Collider3, Cuboid, Filter3, Pair3, Pose3, Shape3, Slide3, Walk3, World3};

/// A box with these half extents.
pub(crate) fn cuboid(half: impl Into<Vec3>) -> Shape3 {
    Cuboid::from_half_extents(half.into()).unwrap().into()
}

/// A person of 1.8 m.
pub(crate) fn capsule() -> Shape3 {
    Capsule3::from_half_height(0.5, 0.4).unwrap().into()
}

/// A person of 1.8 m, as a box.
pub(crate) fn crate_of_a_person() -> Shape3 {
    cuboid([0.4, 0.9, 0.4])
}

/// The sine of an angle in radians, of at most half a turn, by its series.
pub(crate) fn sine(radians: f64) -> f64 {
    let mut term = radians;
    let mut sum = term;
    for n in 1..16 {
        term *= -radians * radians / f64::from(2 * n * (2 * n + 1));
        sum += term;
    }
    sum
}

/// The cosine of an angle in radians, of at most half a turn.
pub(crate) fn cosine(radians: f64) -> f64 {
    let half = sine(radians / 2.0);
    1.0 - 2.0 * half * half
}

/// A rotation about z by an angle in degrees.
pub(crate) fn tilt(degrees: f64) -> Quat {
    let half = degrees.to_radians() / 2.0;
    Quat::from_xyzw(0.0, 0.0, sine(half) as f32, cosine(half) as f32)
}

/// Adds a box of the level: half extents, position, degrees about z.
pub(crate) fn put(world: &mut World3, half: [f32; 3], at: impl Into<DVec3>, degrees: f64) {
    let pose = Pose3::new(at, tilt(degrees)).unwrap();
    world.insert(Collider3::new(cuboid(half)).at(pose).fixed());
}

/// A world with a floor, whose top is at y = 0.
pub(crate) fn floor() -> World3 {
    let mut world = World3::new();
    put(&mut world, [60.0, 0.5, 60.0], [0.0, -0.5, 0.0], 0.0);
    world
}

/// A shape that walks through a world.
pub(crate) struct Hero<'w> {
    pub(crate) world: &'w World3,
    pub(crate) shape: Shape3,
    pub(crate) walk: Walk3,
    pub(crate) pose: Pose3,
}

impl<'w> Hero<'w> {
    /// A character whose feet are at this place.
    pub(crate) fn new(world: &'w World3, shape: Shape3, feet: impl Into<DVec3>) -> Self {
        let walk = Walk3::new(&shape, Vec3::Y).unwrap();
        let pose = Pose3::at(feet.into() + DVec3::Y * (0.9 + f64::from(walk.skin))).unwrap();
        Self { world, shape, walk, pose }
    }

    pub(crate) fn feet(&self) -> DVec3 {
        self.pose.position() - DVec3::Y * (0.9 + f64::from(self.walk.skin))
    }

    /// Runs one frame and checks what holds in every frame: from a free start nothing is entered, and the motion is not
    /// too long.
    pub(crate) fn step(&mut self, displacement: impl Into<Vec3>) -> Slide3 {
        let displacement = displacement.into();
        let was_free = is_free(self.world, &self.shape, &self.pose);
        let slide =
            self.world.move_and_slide((&self.shape, &self.pose), displacement, &self.walk, &Filter3::new());
        if was_free {
            assert!(slide.is_free && is_free(self.world, &self.shape, &slide.pose), "{slide:?}");
            check_length(&slide, displacement, &self.walk);
        }
        assert_eq!(slide.moved, slide.pose.position() - self.pose.position());
        self.pose = slide.pose;
        slide
    }
}

/// Asserts that the motion is no longer than the displacement, a step and a snap, and three skins.
pub(crate) fn check_length(slide: &Slide3, displacement: Vec3, walk: &Walk3) {
    let displacement = if displacement.is_finite() { displacement.as_dvec3() } else { DVec3::ZERO };
    let most = displacement.length() + f64::from(walk.step + walk.snap + 3.0 * walk.skin);
    assert!(
        slide.moved.is_finite() && slide.moved.length() <= most * (1.0 + 1e-6),
        "{displacement}: {slide:?}"
    );
}

/// Whether a shape overlaps no solid: exactly, body by body.
pub(crate) fn is_free(world: &World3, shape: &Shape3, pose: &Pose3) -> bool {
    world.iter().all(|(_, body)| {
        body.is_sensor()
            || !body.is_enabled()
            || !Pair3::new(shape, pose, body.shape(), body.pose()).overlaps()
    })
}
