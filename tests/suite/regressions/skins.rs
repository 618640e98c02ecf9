//! Bodies that stop a hair off what they hit, and go on along it.

use asunder::glam::{DVec3, Quat, Vec3};
use asunder::{
    BodyKey3, Collider3, Cuboid, Filter3, HalfSpace, Motion3, Pair3, Pose3, Shape3, Sphere, TriMesh, World3,
};

/// A bullet that rolls frame by frame as the guide describes (game loops).
struct Roller {
    key: BodyKey3,
    shape: Shape3,
    speed: DVec3,
    /// What of the speed into a wall is taken: 1 to roll on along it, 2 to come back as fast.
    bounce: f64,
    /// How far it is moved back from what it hit.
    skin: f64,
    /// Whether it is moved back even where it is not free, unlike in the guide.
    is_blind: bool,
}

impl Roller {
    fn new(world: &mut World3, at: Pose3, speed: DVec3, bounce: f64) -> Self {
        let shape = Shape3::from(Sphere::new(0.25).unwrap());
        let key = world.insert(Collider3::new(shape.clone()).bullet().at(at));
        Self { key, shape, speed, bounce, skin: 1e-4, is_blind: false }
    }

    fn pose(&self, world: &World3) -> Pose3 {
        *world.pose(self.key).unwrap()
    }

    fn is_free(&self, world: &World3, at: &Pose3) -> bool {
        world.is_free((&self.shape, at), &Filter3::new().without(self.key))
    }

    /// A sixtieth of a second; returns whether it hit something.
    fn roll(&mut self, world: &mut World3, pull: DVec3) -> bool {
        let (here, time, mut near) = (self.pose(world), 1.0 / 60.0, Vec::new());
        self.speed += pull * time;
        world.manifolds((&self.shape, &here), 0.005, &Filter3::new().without(self.key), &mut near);
        for (_, manifold) in &near {
            self.lose(manifold.normal.as_dvec3(), 1.0);
        }
        let motion = Motion3::shift(self.speed * time).unwrap();
        world.set_motion(self.key, motion).unwrap();
        world.update();
        let stop = world.impacts_of(self.key).next().copied();
        let mut there = motion.pose_at(&here, stop.map_or(1.0, |hit| hit.impact.fraction));
        if let Some(hit) = stop {
            let normal = hit.impact.normal.as_dvec3();
            self.lose(normal, self.bounce);
            let back = there.shifted(normal * -self.skin).unwrap();
            if self.is_blind || self.is_free(world, &back) {
                there = back;
            }
        }
        world.set_pose(self.key, there).unwrap();
        stop.is_some()
    }

    /// Takes a multiple of the part of the speed that leads along a normal.
    fn lose(&mut self, normal: DVec3, times: f64) {
        self.speed -= normal * times * self.speed.dot(normal).max(0.0);
    }
}

/// How far a bullet rolls at 5 m/s over a floor, if after each impact it is placed at the distance `skin` from what it
/// hit.
fn rolled(floor: Shape3, top: f64, turn: Quat, (frames, skin): (u32, f64)) -> f64 {
    let base = Pose3::new([3.0, 4.0, 5.0], turn).unwrap();
    let mut world = World3::new();
    world.insert(Collider3::new(floor).fixed().at(base));
    let start = base.compose(&Pose3::at([-450.0, top + 0.3, 0.0]).unwrap()).unwrap();
    let mut ball = Roller { skin, ..Roller::new(&mut world, start, base.turn(DVec3::X * 5.0), 1.0) };
    for _ in 0..frames {
        // Gravity points straight into the floor, so that the bullet rolls on evenly.
        ball.roll(&mut world, base.turn(DVec3::Y * -9.81));
    }
    (ball.pose(&world).position() - start.position()).length()
}

/// Symptom: a ball that rolled as in the guide got stuck for good: on half of all tilted half-spaces at once, on
/// cuboids and meshes after a minute. Cause: an impact ends a hair off the floor, and after removing the component
/// along an f32 normal from a velocity, a ten-millionth of it still leads into the floor; so the next impact came at
/// once, in each frame. The guide mentioned no skin there.
#[test]
fn a_bullet_with_a_skin_rolls_on_over_tilted_floors() {
    let corners =
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, z]| Vec3::new(x, 0.0, z) * 500.0);
    let floors: [(Shape3, f64, u32); 3] = [
        (HalfSpace::new(Vec3::Y).unwrap().into(), 0.0, 600),
        (Cuboid::from_half_extents(Vec3::new(500.0, 0.5, 500.0)).unwrap().into(), 0.5, 3_000),
        (TriMesh::new(corners, [[0, 1, 2], [0, 2, 3]]).unwrap().into(), 0.0, 3_000),
    ];
    for (x, y, z) in [(-0.12, 0.16, 0.13), (0.1, 0.3, -0.05), (0.03, -0.2, 0.14), (-0.07, 0.01, -0.11)] {
        for (floor, top, frames) in &floors {
            let turn = Quat::from_xyzw(x, y, z, 1.0);
            let way = rolled(floor.clone(), *top, turn, (*frames, 1e-4));
            assert!(way > 0.99 * 5.0 / 60.0 * f64::from(*frames), "{way} m in {frames} frames on {floor:?}");
        }
    }
}

/// The purpose of the skin cannot be had by ignoring such impacts: a body that goes on from a hair off the floor by no
/// more than rounding is in it a frame later, and a body inside something is not stopped by it. So a ball that is
/// pressed into the floor by a ten-millionth of its way is held for any number of frames, and a motion that then leads
/// right in still finds it outside.
#[test]
fn a_bullet_that_presses_by_a_rounding_never_gets_in() {
    let ball = Shape3::from(Sphere::new(0.25).unwrap());
    let floors: [(Shape3, f64); 2] = [
        (HalfSpace::new(Vec3::Y).unwrap().into(), 0.0),
        (Cuboid::from_half_extents(Vec3::new(500.0, 0.5, 500.0)).unwrap().into(), 0.5),
    ];
    for (floor, top) in &floors {
        let base = Pose3::new([3.0, 4.0, 5.0], Quat::from_xyzw(-0.12, 0.16, 0.13, 1.0)).unwrap();
        let mut at = base.compose(&Pose3::at([-450.0, top + 0.2500001, 0.0]).unwrap()).unwrap();
        let creep = Motion3::shift(base.turn(DVec3::new(0.08, -1e-8, 0.0))).unwrap();
        for frame in 0..10_000 {
            let pair = Pair3::new(&ball, &at, floor, &base);
            assert!(!pair.overlaps(), "in frame {frame}, {floor:?}");
            let stop = pair.next_impact(&creep, &Motion3::STILL).map_or(1.0, |met| met.fraction);
            at = creep.pose_at(&at, stop);
        }
        let dive = Motion3::shift(base.turn(DVec3::new(0.08, -2.0, 0.0))).unwrap();
        let met = Pair3::new(&ball, &at, floor, &base).next_impact(&dive, &Motion3::STILL);
        assert!(met.is_some_and(|met| met.fraction < 1e-5), "{met:?} {floor:?}");
    }
}

/// Whether a bullet that is thrown into a groove of a mesh ever overlaps it, and how high it lies after ten seconds.
fn grooved(half_width: f32, (speed, bounce): (DVec3, f64), is_blind: bool) -> (bool, f64) {
    let corners = [-half_width, 0.0, half_width]
        .map(|x| [-20.0, 20.0].map(|z| Vec3::new(x, if x == 0.0 { 0.0 } else { 5.0 }, z)));
    let groove = TriMesh::new(corners.concat(), [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]]).unwrap();
    let mut world = World3::new();
    world.insert(Collider3::new(groove));
    let start = Pose3::at([0.0, 3.0, 0.0]).unwrap();
    let mut ball = Roller { is_blind, ..Roller::new(&mut world, start, speed, bounce) };
    let mut overlapped = false;
    for _ in 0..600 {
        ball.roll(&mut world, DVec3::Y * -9.81);
        overlapped |= !ball.is_free(&world, &ball.pose(&world));
    }
    (overlapped, ball.pose(&world).position().y)
}

/// Symptom: balls that rolled as in the guide fell through the bottom of a notch, within a second or two. Cause: the
/// way back from one wall, by the skin, leads into the other; and a body that overlaps something at the start is not
/// stopped by it. The guide did not say to look first.
#[test]
fn a_bullet_keeps_its_skin_only_where_it_is_free() {
    let mut fallen = 0;
    for half_width in [5.0, 2.5, 1.5, 1.0] {
        for bounce in [1.0, 1.5, 1.8] {
            for x in [-4.0, -1.5, 0.37, 2.0] {
                let thrown = (DVec3::new(x, -1.0, 0.5), bounce);
                let (overlapped, height) = grooved(half_width, thrown, false);
                assert!(!overlapped && height > 0.25, "{height} in {half_width} {thrown:?}");
                fallen += u32::from(grooved(half_width, thrown, true).1 < 0.0);
            }
        }
    }
    assert!(fallen > 0, "without looking, some fall through");
}

/// Symptom: a ball that rolled as in the guide, between two walls that were closer to each other than its way in a
/// frame, stood still after two bounces. Cause: the guide removed the parts of its velocity that led into the contacts
/// of the last update. Those are of the place from which it had been moved since: of the wall from which it came, and
/// to which the opposite one had just sent it back.
#[test]
fn a_bullet_bounces_between_walls_within_one_frame() {
    let wall = Cuboid::from_half_extents(Vec3::new(0.5, 9.0, 9.0)).unwrap();
    for gap in [0.1, 0.2, 0.3, 0.4, 0.7] {
        let mut world = World3::new();
        for side in [-1.0, 1.0] {
            let at = Pose3::at([side * (0.75 + gap / 2.0), 0.0, 0.0]).unwrap();
            world.insert(Collider3::new(wall).fixed().at(at));
        }
        let mut ball = Roller::new(&mut world, Pose3::IDENTITY, DVec3::X * 20.0, 2.0);
        let bounces = (0..60).filter(|_| ball.roll(&mut world, DVec3::ZERO)).count() as f64;
        // A second at 20 m/s is sixty ways of a third of a metre; a frame ends with its bounce.
        let frames = (gap * 60.0 / 20.0).ceil();
        assert!((ball.speed.length() - 20.0).abs() < 1e-3, "{} in a gap of {gap}", ball.speed);
        assert!(bounces >= (60.0 / frames).floor() - 1.0, "{bounces} in a gap of {gap}");
    }
}
