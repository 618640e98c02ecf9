//! Moving boxes: scenes to measure a broad phase on.
//!
//! ```
//! use asunder_scenes::boxes::{BoxScene, MovingBoxes};
//! let mut gas = MovingBoxes::new(BoxScene::Gas, 1000, 1);
//! let before = gas.boxes[17];
//! gas.step();
//! assert_eq!((gas.boxes.len(), gas.moved().len()), (1000, 1000));
//! assert_ne!(gas.boxes[17], before);
//! assert_eq!(BoxScene::by_name("city"), Some(BoxScene::City));
//! assert!(BoxScene::ALL.iter().all(|&scene| BoxScene::by_name(scene.name()) == Some(scene)));
//! ```

use crate::random::Random;
use asunder_geometry::Aabb3;
use glam::DVec3;

/// How far a box moves in a frame, as a share of its size.
const STRIDE: f64 = 0.05;

/// The number of boxes that move in an otherwise still scene.
const STILL_MOVERS: usize = 100;

/// The named scenes of moving boxes. Cost of making one: some tens of nanoseconds per box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BoxScene {
    /// A cube with one overlap for two boxes; all boxes move by 5 % of their size a frame.
    Gas,
    /// As gas, but only 5 % of the boxes move, always the same ones.
    Static5,
    /// As gas, but only 1 % of the boxes move, always the same ones.
    Static1,
    /// As gas, in a flat slab 5 m high.
    City,
    /// As gas, but with four overlaps a box.
    Pile,
    /// As gas, with cubes whose sides are log-uniform from 0.02 to 20 m.
    Sizes,
    /// A wall one box thick, four times as high as it is wide: all boxes overlap on one axis.
    Tower,
    /// As gas, but in each frame a tenth of the boxes jump to random places, and the others rest.
    Teleport,
    /// Eight clouds of gas in a world fifty times as wide as a cloud.
    Islands,
    /// Gas above one resting box that is larger than everything else together.
    Plane,
    /// As gas, but only a hundred boxes move, always the same ones, however many rest.
    Still,
}

impl BoxScene {
    /// Every scene, in the order in which results are listed.
    pub const ALL: [Self; 11] = [
        Self::Gas,
        Self::Static5,
        Self::Static1,
        Self::City,
        Self::Pile,
        Self::Sizes,
        Self::Tower,
        Self::Teleport,
        Self::Islands,
        Self::Plane,
        Self::Still,
    ];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gas => "gas",
            Self::Static5 => "static5",
            Self::Static1 => "static1",
            Self::City => "city",
            Self::Pile => "pile",
            Self::Sizes => "sizes",
            Self::Tower => "tower",
            Self::Teleport => "teleport",
            Self::Islands => "islands",
            Self::Plane => "plane",
            Self::Still => "still",
        }
    }

    /// The scene of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scene| scene.name() == name)
    }

    /// The overlaps per box that the scene is laid out for.
    const fn pairs_per_box(self) -> f64 {
        if matches!(self, Self::Pile) { 4.0 } else { 0.5 }
    }
}

/// One scene of moving boxes, at one frame. Made and stepped in time linear in the number of boxes.
#[derive(Clone, Debug)]
pub struct MovingBoxes {
    /// The boxes of this frame, in metres.
    pub boxes: Vec<Aabb3>,
    scene: BoxScene,
    particles: Vec<Particle>,
    movers: Vec<u32>,
    rooms: Vec<Room>,
    random: Random,
}

/// A box by its centre, which bounces inside a room.
#[derive(Clone, Copy, Debug)]
struct Particle {
    center: DVec3,
    half: DVec3,
    velocity: DVec3,
    room: u32,
}

/// The region for centres of boxes.
#[derive(Clone, Copy, Debug)]
struct Room {
    low: DVec3,
    high: DVec3,
}

impl MovingBoxes {
    /// The scene's first frame, with `count` boxes.
    pub fn new(scene: BoxScene, count: usize, seed: u64) -> Self {
        let mut random = Random::new(seed ^ 0xb0c5);
        let rooms = rooms(scene, count.max(1), &mut random);
        let mut particles: Vec<Particle> =
            (0..count).map(|i| particle(scene, i % rooms.len(), &rooms, &mut random)).collect();
        if let (BoxScene::Plane, Some(first)) = (scene, particles.first_mut()) {
            *first = floor_under(&rooms[0]);
        }
        let movers = movers(scene, count, &mut random);
        let boxes = particles.iter().map(Particle::bounds).collect();
        Self { boxes, scene, particles, movers, rooms, random }
    }

    /// Advances the boxes by one frame.
    pub fn step(&mut self) {
        if self.scene == BoxScene::Teleport {
            let count = self.particles.len();
            self.movers = (0..count as u32).filter(|_| self.random.unit() < 0.1).collect();
        }
        for &i in &self.movers {
            let particle = &mut self.particles[i as usize];
            let room = &self.rooms[particle.room as usize];
            if self.scene == BoxScene::Teleport {
                particle.center = self.random.within(room.low, room.high);
            } else {
                particle.bounce(room);
            }
            self.boxes[i as usize] = particle.bounds();
        }
    }

    /// Which boxes the last step moved, ascending. Before the first step: those that will move.
    pub fn moved(&self) -> &[u32] {
        &self.movers
    }
}

impl Particle {
    fn bounds(&self) -> Aabb3 {
        let (low, high) = (self.center - self.half, self.center + self.half);
        Aabb3::new(low.as_vec3(), high.as_vec3())
    }

    fn bounce(&mut self, room: &Room) {
        self.center += self.velocity;
        for axis in 0..3 {
            if self.center[axis] < room.low[axis] || self.center[axis] > room.high[axis] {
                self.velocity[axis] = -self.velocity[axis];
                self.center[axis] = self.center[axis].clamp(room.low[axis], room.high[axis]);
            }
        }
    }
}

fn particle(scene: BoxScene, room: usize, rooms: &[Room], random: &mut Random) -> Particle {
    let side = match scene {
        BoxScene::Sizes => DVec3::splat(random.log_range(0.02, 20.0)),
        _ => random.within(DVec3::splat(0.5), DVec3::splat(1.5)),
    };
    let center = random.within(rooms[room].low, rooms[room].high);
    let size = (side.x + side.y + side.z) / 3.0;
    let velocity = random.direction() * (STRIDE * size);
    Particle { center, half: side * 0.5, velocity, room: room as u32 }
}

fn floor_under(room: &Room) -> Particle {
    let width = (room.high - room.low) * 2.0;
    let center = (room.low + room.high) * 0.5;
    Particle {
        center: DVec3::new(center.x, room.low.y - 1.0, center.z),
        half: DVec3::new(width.x, 1.0, width.z),
        velocity: DVec3::ZERO,
        room: 0,
    }
}

fn movers(scene: BoxScene, count: usize, random: &mut Random) -> Vec<u32> {
    let share = match scene {
        BoxScene::Static5 => 0.05,
        BoxScene::Static1 => 0.01,
        BoxScene::Teleport => 0.1,
        _ => 1.0,
    };
    if scene == BoxScene::Still {
        let moving = count.min(STILL_MOVERS);
        return (0..moving).map(|i| (i * count / moving) as u32).collect();
    }
    let first = u32::from(scene == BoxScene::Plane);
    (first..count as u32).filter(|_| share == 1.0 || random.unit() < share).collect()
}

/// Rooms of a size that gives the scene its number of overlaps.
///
/// Two sides add up to 2 m on average, so two centres drawn from an interval of length d are near enough with
/// probability q = 2/d - 1/d^2, and n boxes have n/2 (n q_x q_y q_z) overlaps.
fn rooms(scene: BoxScene, count: usize, random: &mut Random) -> Vec<Room> {
    let clouds = if scene == BoxScene::Islands { 8 } else { 1 };
    let chance = (2.0 * scene.pairs_per_box() * clouds as f64 / count as f64).min(0.9);
    let cube = DVec3::splat(length_of(libm::cbrt(chance)));
    let size = match scene {
        BoxScene::City => {
            let width = length_of((chance / chance_in(5.0)).min(0.9).sqrt());
            DVec3::new(width, 5.0, width)
        }
        BoxScene::Tower => {
            // Nothing is thinner than 0.5 m, so that centres within 0.4 m always overlap on the third axis.
            let area = 4.0 / chance;
            DVec3::new(area.sqrt() * 0.5, area.sqrt() * 2.0, 0.4)
        }
        BoxScene::Sizes => DVec3::splat(length_for_sizes(chance)),
        _ => cube,
    };
    let world = size * 50.0;
    let corner = |random: &mut Random| match scene {
        BoxScene::Islands => random.within(DVec3::ZERO, world - size),
        _ => size * -0.5,
    };
    (0..clouds).map(|_| corner(random)).map(|low| Room { low, high: low + size }).collect()
}

/// The length d with 2/d - 1/d^2 = q.
fn length_of(q: f64) -> f64 {
    (1.0 + (1.0 - q).max(0.0).sqrt()) / q
}

/// The length of a cube in which two log-uniform cubes overlap with the given probability: the mean over their sides
/// of (h/d)^3 (2 - h/d)^3, h half the sum, by the midpoint rule.
fn length_for_sizes(chance: f64) -> f64 {
    const STEPS: usize = 64;
    let side = |i: usize| 0.02 * libm::pow(1000.0, (i as f64 + 0.5) / STEPS as f64);
    let chance_at = |length: f64| {
        let pairs = (0..STEPS * STEPS).map(|i| (side(i % STEPS) + side(i / STEPS)) * 0.5);
        let near = pairs.map(|h| (h / length).min(1.0)).map(|x| x * (2.0 - x));
        near.map(|q| q * q * q).sum::<f64>() / (STEPS * STEPS) as f64
    };
    let (mut low, mut high) = (1.0, 1e6);
    for _ in 0..60 {
        let middle = (low + high) * 0.5;
        if chance_at(middle) > chance { low = middle } else { high = middle }
    }
    high
}

fn chance_in(length: f64) -> f64 {
    2.0 / length - 1.0 / (length * length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn overlaps_per_box(boxes: &[Aabb3]) -> f64 {
        let count = |i: usize| boxes[i + 1..].iter().filter(|other| boxes[i].overlaps(other)).count();
        (0..boxes.len()).map(count).sum::<usize>() as f64 / boxes.len() as f64
    }

    #[test]
    fn each_scene_has_the_overlaps_it_says() {
        for scene in BoxScene::ALL {
            for count in [1000, 4000] {
                let mut moving = MovingBoxes::new(scene, count, 1);
                for _ in 0..20 {
                    moving.step();
                }
                let (found, wanted) = (overlaps_per_box(&moving.boxes), scene.pairs_per_box());
                let ratio = found / wanted;
                assert!((0.75..1.3).contains(&ratio), "{}/{count}: {found} overlaps a box", scene.name());
            }
        }
    }

    #[test]
    fn equal_seeds_give_equal_scenes_and_others_do_not() {
        for scene in BoxScene::ALL {
            let run = |seed| {
                let mut moving = MovingBoxes::new(scene, 300, seed);
                for _ in 0..5 {
                    moving.step();
                }
                moving.boxes
            };
            assert_eq!(run(3), run(3));
            assert_ne!(run(3), run(4));
        }
    }

    #[test]
    fn only_the_boxes_named_have_moved() {
        for (scene, share) in
            [(BoxScene::Static5, 0.05), (BoxScene::Static1, 0.01), (BoxScene::Teleport, 0.1)]
        {
            let mut moving = MovingBoxes::new(scene, 5000, 2);
            let before = moving.boxes.clone();
            moving.step();
            let changed: Vec<u32> =
                (0..5000).filter(|&i| moving.boxes[i as usize] != before[i as usize]).collect();
            assert_eq!(changed, moving.moved());
            assert!((changed.len() as f64 / 5000.0 / share - 1.0).abs() < 0.3);
        }
    }

    #[test]
    fn a_hundred_boxes_move_in_a_still_world_however_large() {
        for (count, moving) in [(0, 0), (7, 7), (150, 100), (5000, 100)] {
            let mut still = MovingBoxes::new(BoxScene::Still, count, 1);
            let before = still.boxes.clone();
            still.step();
            let changed: Vec<u32> =
                (0..count as u32).filter(|&i| still.boxes[i as usize] != before[i as usize]).collect();
            assert_eq!((changed.len(), changed.as_slice()), (moving, still.moved()));
        }
    }

    #[test]
    fn a_tower_overlaps_on_one_axis_and_a_plane_is_wider_than_the_rest() {
        let tower = MovingBoxes::new(BoxScene::Tower, 500, 1).boxes;
        let highest_low = tower.iter().map(|b| b.min.z).fold(f32::MIN, f32::max);
        let lowest_high = tower.iter().map(|b| b.max.z).fold(f32::MAX, f32::min);
        assert!(highest_low <= lowest_high);
        let plane = MovingBoxes::new(BoxScene::Plane, 500, 1).boxes;
        let rest = plane[1..].iter().fold(plane[1], |all, b| all.union(b));
        assert!(Vec3::cmplt(plane[0].min, rest.min).x && Vec3::cmpgt(plane[0].max, rest.max).z);
    }
}
