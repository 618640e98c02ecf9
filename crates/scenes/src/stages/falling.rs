//! Heaps that fall into a pit: those of [`worlds`](crate::worlds), before they rest.

use super::{Feel, Scene3};
use crate::pairs::{SolidKind, cuboid, solids};
use crate::random::Random;
use crate::turn::Turn;
use crate::worlds::WorldScene;
use crate::worlds::piles::{BOXES, DISTINCT, HULLS, PIT, pit, side};
use glam::{DVec3, Vec3};

/// The height of the lowest bodies, in metres.
const LOWEST: f64 = 1.0;

/// Bodies in random rotations, in loose layers above the pit of a heap, for a solver to let fall.
///
/// What is measured is the 60 frames from [`Self::first_frame`] on. What an engine finds in them, with contacts up to 2
/// cm apart, for the usual counts and seed 1:
///
/// | | bodies | candidates | touching | contacts | points |
/// |---|---|---|---|---|---|
/// | boxes, on average | 8,005 | 43,752 | 10,226 | 17,925 | 32,776 |
/// | at the start | | 49,115 | 5,215 | 15,865 | 22,779 |
/// | at the end | | 44,685 | 16,867 | 21,768 | 45,455 |
/// | hulls, on average | 5,125 | 20,911 | 5,895 | 9,631 | 21,429 |
/// | at the start | | 12,669 | 781 | 5,149 | 9,584 |
/// | at the end | | 25,272 | 9,905 | 12,767 | 29,696 |
///
/// ```
/// use asunder_scenes::stages::Falling;
/// let scene = Falling::Boxes.above_pit(505, 1);
/// let lowest = scene.level.bodies.iter().filter(|body| !body.fixed).map(|body| body.pose.position().y);
/// assert!(lowest.fold(f64::INFINITY, f64::min) > 0.9);
/// assert_eq!(Falling::Hulls.name(), "convex_pile/falling");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Falling {
    /// Boxes of 1 m, into the pit of [`WorldScene::BoxesPile`].
    Boxes,
    /// Hulls of 32 points, into the pit of [`WorldScene::ConvexPile`].
    Hulls,
}

impl Falling {
    /// All of them, in the order in which results are listed.
    pub const ALL: [Self; 2] = [Self::Boxes, Self::Hulls];

    /// The same heap at rest.
    pub const fn at_rest(self) -> WorldScene {
        match self {
            Self::Boxes => WorldScene::BoxesPile,
            Self::Hulls => WorldScene::ConvexPile,
        }
    }

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Boxes => "boxes_pile/falling",
            Self::Hulls => "convex_pile/falling",
        }
    }

    /// Steps of 1/60 s until the first measured frame: for the usual count, a quarter of the bodies have reached the
    /// heap by then, and nearly all do in the 60 frames that follow.
    pub const fn first_frame(self) -> u32 {
        match self {
            Self::Boxes => 25,
            Self::Hulls => 23,
        }
    }

    /// `count` bodies as they are released: first the pit's five, which are included in the count.
    ///
    /// The pit is as wide as that of the heap at rest, and high enough for all to start in. Bodies have random
    /// rotations and less space than they need; a solver pushes them apart before the first measured frame.
    pub fn above_pit(self, count: usize, seed: u64) -> Scene3 {
        let mut random = Random::new(seed ^ 0xfa11);
        let (spacing, loose, shapes) = match self {
            Self::Boxes => (BOXES, DVec3::new(1.2, 1.3, 1.2), vec![cuboid(Vec3::splat(0.5))]),
            Self::Hulls => (HULLS, DVec3::new(0.98, 1.1, 0.98), solids(SolidKind::Hull32, DISTINCT, seed)),
        };
        let bodies = count.saturating_sub(PIT);
        let across = spacing.x * side(bodies) as f64;
        let wide = ((across / loose.x) as usize).max(1);
        let high = LOWEST + loose.y * (bodies / (wide * wide) + 1) as f64;
        let mut scene = Scene3::empty();
        self.name().clone_into(&mut scene.level.name);
        for (half, middle) in pit(DVec3::new(across, high, across), spacing) {
            scene.fixed(cuboid(half), middle, Turn::IDENTITY);
        }
        for i in 0..bodies {
            let cell = DVec3::new((i % wide) as f64, (i / (wide * wide)) as f64, (i / wide % wide) as f64);
            let middle = DVec3::new(1.0, 0.0, 1.0) * (0.5 * (wide as f64 - 1.0));
            let stray = random.within(DVec3::splat(-0.04), DVec3::splat(0.04));
            let place = (cell - middle) * loose + DVec3::Y * LOWEST + stray;
            let body = scene.free(shapes[i % shapes.len()].clone(), place, random.turn());
            body.linear_velocity = random.direction() * 0.3;
            body.angular_velocity = random.direction();
        }
        // A heap that is to stand for long needs more substeps; one that falls does not.
        scene.feel = Feel { substeps: 4, ..scene.feel };
        let half = 0.5 * across + 0.02 * spacing.x;
        scene.room = (DVec3::new(-half, 0.0, -half), DVec3::new(half, high + 2.0, half));
        scene
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worlds::Replay3;

    #[test]
    fn heaps_fall_into_the_pit_in_which_they_rest() {
        for falling in Falling::ALL {
            let count = falling.at_rest().usual_count();
            let scene = falling.above_pit(count, 1);
            let rest = Replay3::new(falling.at_rest(), count, 1);
            assert_eq!((scene.level.bodies.len(), rest.bodies.len()), (count, count));
            let sideways = |position: DVec3| [position.x, position.z];
            for (fixed, known) in scene.level.bodies.iter().zip(&rest.bodies).take(PIT) {
                assert!(fixed.fixed && known.fixed);
                assert_eq!(sideways(fixed.pose.position()), sideways(known.pose.position()));
            }
            let (low, high) = scene.room;
            for body in &scene.level.bodies[PIT..] {
                let place = body.pose.position();
                assert!(!body.fixed && place.cmpgt(low).all() && place.cmplt(high).all(), "{place}");
            }
        }
    }

    #[test]
    fn few_bodies_or_none_are_a_scene_too() {
        for count in [0, 5, 6, 14] {
            for falling in Falling::ALL {
                assert_eq!(falling.above_pit(count, 1).level.bodies.len(), count.max(PIT));
            }
        }
    }
}
