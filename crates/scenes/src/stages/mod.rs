//! Scenes for a solver: bodies with masses and velocities, and driven bodies that move through them.
//!
//! Sizes are those of the field's own benchmarks, so that results can be compared. A scene gives shapes, poses,
//! velocities, and the poses of driven bodies at each frame; what moves the others is up to the solver.
//!
//! ```
//! use asunder_scenes::stages::{Scene, Stage};
//! let Scene::Volume(washer) = Stage::Washer.build(100, 1) else { unreachable!() };
//! let stave = &washer.drivers[0];
//! assert!(washer.level.bodies[stave.body as usize].fixed, "no contact moves it");
//! assert_ne!(stave.path.pose_at(0), stave.path.pose_at(60), "and it turns");
//! ```

mod asteroids;
mod falling;
mod heaps;
mod letters;
mod open;
mod path;
mod plane;
mod stacks;
#[cfg(test)]
mod tests;

pub use falling::Falling;
pub use path::{Path2, Path3};

use crate::level::{Level2, Level3, LevelBody, LevelBody2, LevelBody3, LevelOf};
use crate::pairs::{pose2, pose3};
use crate::turn::Turn;
use asunder_geometry::{Shape2, Shape3};
use glam::{DVec2, DVec3};

/// The named scenes.
///
/// ```
/// use asunder_scenes::stages::Stage;
/// assert_eq!(Stage::by_name("card_house"), Some(Stage::CardHouse));
/// assert!(Stage::ALL.iter().all(|&stage| Stage::by_name(stage.name()) == Some(stage)));
/// assert_eq!(Stage::Pyramid.usual_size(), 5050);
/// assert!(Stage::Tumbler.in_plane() && !Stage::Washer.in_plane());
/// assert!(Stage::Stack.about().starts_with("twenty boxes"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// One pyramid of boxes, one box deep.
    Pyramid,
    /// Pyramids of 55 boxes in rows.
    ManyPyramids,
    /// Hulls of 32 points that fall into a pit.
    ConvexPile,
    /// Rocks in a yard, and a wall that pushes them back and forth.
    Junkyard,
    /// Boxes in a turning drum.
    Washer,
    /// A landscape of fixed boxes, and a few bodies that move on it.
    LargeWorld,
    /// Walking characters of 19 parts each, all of them driven.
    Crowd,
    /// A spiral of dominoes, of which the first is tipped.
    Dominoes,
    /// A house of cards.
    CardHouse,
    /// A wall of bricks, and a ball that flies at it: the last body of the scene.
    BrickWall,
    /// Boxes stacked on one another.
    Stack,
    /// One pyramid in the plane.
    Pyramid2d,
    /// Pyramids of 55 boxes side by side in the plane.
    ManyPyramids2d,
    /// Boxes in a turning box, in the plane.
    Tumbler,
    /// Pentagons in a yard, and a wall that pushes them back and forth, in the plane.
    Junkyard2d,
    /// Concave letters that rain into a pit, in the plane.
    Letters,
    /// Rocks that drift and bounce in a closed room without gravity, and bullets among them, in the plane.
    Asteroids,
}

/// A scene of either dimension.
#[derive(Clone, Debug)]
pub enum Scene {
    /// A scene in the plane.
    Plane(Scene2),
    /// A scene in space.
    Volume(Scene3),
}

/// A scene in the plane.
pub type Scene2 = SceneOf<DVec2, LevelBody2, Path2>;

/// A scene in space.
pub type Scene3 = SceneOf<DVec3, LevelBody3, Path3>;

/// A scene of either dimension, used as [`Scene2`] and [`Scene3`].
#[derive(Clone, Debug)]
pub struct SceneOf<Vector, Body, Path> {
    /// Gravity, and the bodies as they are at the start.
    pub level: LevelOf<Vector, Body>,
    /// The driven bodies, ascending. No contact moves them. One that is not also `fixed` has contacts with scenery and
    /// with other driven bodies.
    pub drivers: Vec<Driver<Path>>,
    /// Bodies so fast that they need continuous collision, ascending.
    pub bullets: Vec<u32>,
    /// The bodies that have an owner, ascending, with that owner: two bodies of one owner never collide.
    pub owners: Vec<(u32, u64)>,
    /// How bodies behave where they touch.
    pub feel: Feel,
    /// Two corners of the box that no body's centre should ever leave; infinite where there is none.
    pub room: (Vector, Vector),
}

/// The material of all bodies of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feel {
    /// Coefficient of friction.
    pub friction: f64,
    /// The share of an impact's speed that is given back, 0 to 1.
    pub restitution: f64,
    /// The rate at which a spin decays by air and rolling resistance, per second.
    pub spin_damping: f64,
    /// The substeps into which a solver should divide a step of 1/60 s: bodies that stand on thin edges or bear a
    /// hundred others need more. Its cost grows with their number.
    pub substeps: u32,
}

/// A body that is driven.
#[derive(Clone, Debug)]
pub struct Driver<Path> {
    /// Its number among the level's bodies.
    pub body: u32,
    /// Its pose, frame by frame.
    pub path: Path,
}

impl Default for Feel {
    /// Dry wood: much friction, no bounce.
    fn default() -> Self {
        Self { friction: 0.8, restitution: 0.0, spin_damping: 1.5, substeps: 8 }
    }
}

impl Stage {
    /// Every stage, in the order in which they are listed: those in space, then those in the plane.
    pub const ALL: [Self; 17] = [
        Self::Pyramid,
        Self::ManyPyramids,
        Self::ConvexPile,
        Self::Junkyard,
        Self::Washer,
        Self::LargeWorld,
        Self::Crowd,
        Self::Dominoes,
        Self::CardHouse,
        Self::BrickWall,
        Self::Stack,
        Self::Pyramid2d,
        Self::ManyPyramids2d,
        Self::Tumbler,
        Self::Junkyard2d,
        Self::Letters,
        Self::Asteroids,
    ];

    /// The name to select it by.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pyramid => "pyramid",
            Self::ManyPyramids => "many_pyramids",
            Self::ConvexPile => "convex_pile",
            Self::Junkyard => "junkyard",
            Self::Washer => "washer",
            Self::LargeWorld => "large_world",
            Self::Crowd => "crowd",
            Self::Dominoes => "dominoes",
            Self::CardHouse => "card_house",
            Self::BrickWall => "brick_wall",
            Self::Stack => "stack",
            Self::Pyramid2d => "pyramid_2d",
            Self::ManyPyramids2d => "many_pyramids_2d",
            Self::Tumbler => "tumbler",
            Self::Junkyard2d => "junkyard_2d",
            Self::Letters => "letters",
            Self::Asteroids => "asteroids",
        }
    }

    /// The stage of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }

    /// What it shows, in a few words.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Pyramid => "boxes, a hundred in the lowest row",
            Self::ManyPyramids => "196 pyramids of 55 boxes",
            Self::ConvexPile => "hulls of 32 points fall into a pit",
            Self::Junkyard => "rocks in a yard, and a wall that pushes them",
            Self::Washer => "boxes in a turning drum",
            Self::LargeWorld => "a million fixed boxes, a hundred bodies that move",
            Self::Crowd => "200 characters of 19 parts walk about; all are driven",
            Self::Dominoes => "a spiral of dominoes, the first is tipped",
            Self::CardHouse => "a house of cards, five storeys high",
            Self::BrickWall => "a wall of bricks, and a ball that flies at it",
            Self::Stack => "twenty boxes on one another",
            Self::Pyramid2d => "the pyramid in the plane",
            Self::ManyPyramids2d => "the pyramids in the plane",
            Self::Tumbler => "boxes in a turning box",
            Self::Junkyard2d => "pentagons in a yard, and a wall that pushes them",
            Self::Letters => "concave letters rain into a pit",
            Self::Asteroids => "rocks drift and bounce, bullets fly among them",
        }
    }

    /// The size usually given to [`build`](Self::build).
    pub const fn usual_size(self) -> usize {
        match self {
            Self::Pyramid | Self::Pyramid2d => 5050,
            Self::ManyPyramids | Self::ManyPyramids2d => 10_780,
            Self::ConvexPile => 5120,
            Self::Junkyard => 10_584,
            Self::Washer => 8000,
            Self::LargeWorld => 1_000_000,
            Self::Crowd => 3800,
            Self::Dominoes | Self::BrickWall => 200,
            Self::CardHouse => 40,
            Self::Stack => 20,
            Self::Tumbler => 2025,
            Self::Junkyard2d => 3000,
            Self::Letters => 400,
            Self::Asteroids => 1000,
        }
    }

    /// Whether it is a scene in the plane.
    pub const fn in_plane(self) -> bool {
        matches!(
            self,
            Self::Pyramid2d
                | Self::ManyPyramids2d
                | Self::Tumbler
                | Self::Junkyard2d
                | Self::Letters
                | Self::Asteroids
        )
    }

    /// The scene with `size` bodies besides its scenery, or a few less so that pyramids, storeys and characters are
    /// whole, but at least one of those. For [`Stage::LargeWorld`] the size is that of the landscape, and one body
    /// moves for every ten thousand of its boxes.
    ///
    /// Cost: linear in the size, plus that of making up to 64 hulls.
    pub fn build(self, size: usize, seed: u64) -> Scene {
        let mut scene = match self {
            Self::Pyramid => Scene::Volume(stacks::pyramid(size)),
            Self::ManyPyramids => Scene::Volume(stacks::many_pyramids(size)),
            Self::ConvexPile => Scene::Volume(heaps::convex_pile(size, seed)),
            Self::Junkyard => Scene::Volume(heaps::junkyard(size, seed)),
            Self::Washer => Scene::Volume(heaps::washer(size, seed)),
            Self::LargeWorld => Scene::Volume(open::large_world(size, seed)),
            Self::Crowd => Scene::Volume(open::crowd(size, seed)),
            Self::Dominoes => Scene::Volume(stacks::dominoes(size)),
            Self::CardHouse => Scene::Volume(stacks::card_house(size)),
            Self::BrickWall => Scene::Volume(stacks::brick_wall(size)),
            Self::Stack => Scene::Volume(stacks::stack(size)),
            Self::Pyramid2d => Scene::Plane(plane::pyramid(size)),
            Self::ManyPyramids2d => Scene::Plane(plane::many_pyramids(size)),
            Self::Tumbler => Scene::Plane(plane::tumbler(size, seed)),
            Self::Junkyard2d => Scene::Plane(plane::junkyard(size, seed)),
            Self::Letters => Scene::Plane(letters::rain(size, seed)),
            Self::Asteroids => Scene::Plane(asteroids::field(size, seed)),
        };
        let name = match &mut scene {
            Scene::Plane(scene) => &mut scene.level.name,
            Scene::Volume(scene) => &mut scene.level.name,
        };
        self.name().clone_into(name);
        scene
    }
}

impl From<Level2> for Scene2 {
    fn from(level: Level2) -> Self {
        let room = (DVec2::NEG_INFINITY, DVec2::INFINITY);
        let (drivers, bullets, owners) = (Vec::new(), Vec::new(), Vec::new());
        Self { level, drivers, bullets, owners, feel: Feel::default(), room }
    }
}

impl From<Level3> for Scene3 {
    fn from(level: Level3) -> Self {
        let room = (DVec3::NEG_INFINITY, DVec3::INFINITY);
        let (drivers, bullets, owners) = (Vec::new(), Vec::new(), Vec::new());
        Self { level, drivers, bullets, owners, feel: Feel::default(), room }
    }
}

impl Scene2 {
    fn empty() -> Self {
        Self::from(LevelOf { name: String::new(), gravity: DVec2::new(0.0, -9.81), bodies: Vec::new() })
    }

    fn fixed(&mut self, shape: Shape2, position: DVec2, angle: f64) {
        let body = body(shape, pose2(position, angle), true);
        self.level.bodies.push(body);
    }

    fn free(&mut self, shape: Shape2, position: DVec2, angle: f64) -> &mut LevelBody2 {
        push(&mut self.level.bodies, body(shape, pose2(position, angle), false))
    }

    fn driven(&mut self, shape: Shape2, path: Path2) {
        self.drivers.push(Driver { body: self.level.bodies.len() as u32, path: path.clone() });
        self.level.bodies.push(body(shape, path.pose_at(0), true));
    }
}

impl Scene3 {
    fn empty() -> Self {
        Self::from(LevelOf { name: String::new(), gravity: DVec3::new(0.0, -9.81, 0.0), bodies: Vec::new() })
    }

    fn fixed(&mut self, shape: Shape3, position: DVec3, turn: Turn) {
        let body = body(shape, pose3(position, turn), true);
        self.level.bodies.push(body);
    }

    fn free(&mut self, shape: Shape3, position: DVec3, turn: Turn) -> &mut LevelBody3 {
        push(&mut self.level.bodies, body(shape, pose3(position, turn), false))
    }

    fn driven(&mut self, shape: Shape3, path: Path3) {
        self.drivers.push(Driver { body: self.level.bodies.len() as u32, path: path.clone() });
        self.level.bodies.push(body(shape, path.pose_at(0), true));
    }
}

fn body<Shape, Pose, Vector: Default, Spin: Default>(
    shape: Shape,
    pose: Pose,
    fixed: bool,
) -> LevelBody<Shape, Pose, Vector, Spin> {
    LevelBody {
        shape,
        pose,
        linear_velocity: Vector::default(),
        angular_velocity: Spin::default(),
        fixed,
        sensor: false,
        layers: None,
        user_data: 0,
    }
}

/// Appends an item, and returns a reference to it.
fn push<T>(list: &mut Vec<T>, item: T) -> &mut T {
    let last = list.len();
    list.push(item);
    &mut list[last]
}
