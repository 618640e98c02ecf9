//! Trials of the contacts' quality: things that must stand, a bullet that must not pass, and runs that must be equal.
//!
//! Each trial plays a scene and returns a figure with its limit. The example `targets` prints them, and short versions
//! run in `cargo test`.

use crate::game::Game;
use crate::opened::{SEED, volume};
use crate::playable::Playable;
use crate::report::STEP;
use crate::stepper::MARGIN;
use asunder::glam::{DVec3, Vec3};
use asunder::{Collider3, Cuboid, Plane, Pose3, Shape3, Sphere, Volume};
use asunder_scenes::stages::{Scene, Stage};
use std::error::Error;

/// Seconds that a scene is given to settle: load travels down a pile of a hundred boxes at a finite speed.
const SETTLE: f64 = 8.0;

/// A figure that must stay within a limit.
///
/// ```
/// use asunder_examples::trials::Figure;
/// let figure = Figure { what: "bodies lost", is: 0.0, most: 0.0 };
/// assert!(figure.is_met() && !Figure { is: f64::NAN, ..figure }.is_met());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// What was measured.
    pub what: &'static str,
    /// What it is.
    pub is: f64,
    /// What it may be at most.
    pub most: f64,
}

impl Figure {
    /// Whether the limit is kept; NaN does not keep it.
    pub fn is_met(&self) -> bool {
        self.is <= self.most
    }
}

/// How far any body strays once a scene has settled, and the deepest overlap from then on, as shares of a body's size.
/// Sleep is off, so that creep shows. The ball of the brick wall is left out.
///
/// What a pyramid of base 100 needs: it is a wall 100 m high and 1 m thick, and springs as contacts make an elastic
/// column of it, which buckles under its own weight (Greenhill, 1881: where q L^3 > 7.84 EI). With I the second moment
/// of area of a box's base and springs of f hertz, a column of 20 boxes needs f = 45, and one of 100 needs 500, or
/// nearly seventy substeps a step. A pyramid, lighter towards its top, needs less, and its scene has 48. How far it
/// then leans depends on what pushes it off its middle while its weight first comes down. With friction solved after
/// non-penetration, one of base 60 with 12 substeps leaned by 12 mm up to the 10th second; with friction first, by 4
/// mm.
///
/// Tried on that pyramid, with friction last (AMD EPYC, Zen 4, 2026-11-22):
/// - the points of a manifold in reverse order in every other substep, or in the pass without springs: leans as far
///   (over 4 seconds; over 3, no difference showed);
/// - all points in reverse order in every other substep: boxes rattle at 0.3 m/s;
/// - two passes without springs: leans half as far again;
/// - springs twice as stiff with a damping ratio of 1, 2, 5 or 20, or springs that respond only to the change since the
///   last step: the lowest rows rattle at 0.05 to 1 m/s;
/// - springs that respond half to the load of the point and half to the mean of its manifold, and so are stiffer
///   against tilting: a quarter of the lean; but a pyramid of base 100 with 48 substeps sways by 5 mm, against 1 mm
///   with friction first alone;
/// - one friction constraint per manifold, at the middle of its points, and one against twisting: less than half the
///   time a step, but it rattles at 0.04 m/s where friction at each point leaves 0.003. In the same time, with 26
///   substeps and friction first, it stands as still as friction at each point with 12, and is four times as stiff;
/// - no friction in the pass with springs: rattles at 1.5 m/s.
///
/// # Errors
/// A stage in the plane.
pub fn stand((stage, size): (Stage, usize), seconds: f64) -> Result<[Figure; 2], Box<dyn Error>> {
    let Scene::Volume(mut scene) = stage.build(size, SEED) else { return Err("a stage in the plane".into()) };
    for ball in core::mem::take(&mut scene.bullets) {
        scene.level.bodies.remove(ball as usize);
    }
    let mut game = volume(&scene)?;
    game.sleeps = false;
    game.update();
    let settle = SETTLE.min(0.5 * seconds);
    play(&mut game, settle, |_| ());
    let places = game.places();
    let (mut strayed, mut deepest) = (0.0_f64, 0.0_f64);
    play(&mut game, seconds - settle, |game| {
        strayed = strayed.max(game.strayed(&places));
        deepest = deepest.max(game.deepest_share());
    });
    Ok([
        Figure { what: "furthest from where it settled, of size", is: strayed, most: 0.01 },
        Figure { what: "deepest overlap, of size", is: deepest, most: 0.01 },
    ])
}

/// Shoots a ball of 10 cm radius at a wall of 1 cm, from many distances and angles, and counts how many pass it.
///
/// # Errors
/// None, for the shapes used here.
pub fn shoot(speed: f64, shots: usize) -> Result<Figure, Box<dyn Error>> {
    let wall = Shape3::from(Cuboid::from_half_extents(Vec3::new(5.0, 5.0, 0.005))?);
    let ball = Shape3::from(Sphere::new(0.1)?);
    let mut passed = 0.0;
    for shot in 0..shots {
        let mut game = Game::<Volume>::new(DVec3::NEG_Y * 9.81);
        game.add(Collider3::new(wall.clone()).fixed(), DVec3::ZERO, DVec3::ZERO)?;
        let share = shot as f64 / shots as f64;
        let start = DVec3::new(0.0, 0.0, 1.0 + 10.0 * share);
        let pose = Pose3::at(start)?;
        let collider = Collider3::new(ball.clone()).at(pose).bullet().margin(MARGIN)?;
        // Up to 40 degrees off the perpendicular, always towards the wall.
        let aim = DVec3::new(0.8 * (share * 7.0 - (share * 7.0).floor() - 0.5), 0.0, -1.0).normalize();
        let number = game.add(collider, aim * speed, DVec3::ZERO)?;
        game.update();
        play(&mut game, 0.25, |_| ());
        let is_through = game.center(number).is_none_or(|center| center.z < 0.0);
        passed += f64::from(u8::from(is_through));
    }
    Ok(Figure { what: "balls that passed", is: passed, most: 0.0 })
}

/// Plays a stage for some seconds, and counts the bodies that are lost.
///
/// # Errors
/// None, for the stages there are.
pub fn keep(stage: Stage, size: usize, seconds: f64) -> Result<Figure, Box<dyn Error>> {
    let lost = match stage.build(size, SEED) {
        Scene::Plane(scene) => {
            let mut game = crate::opened::plane(&scene)?;
            game.update();
            play(&mut game, seconds, |_| ());
            game.outside(scene.room)
        }
        Scene::Volume(scene) => {
            let mut game = volume(&scene)?;
            game.update();
            play(&mut game, seconds, |_| ());
            game.outside(scene.room)
        }
    };
    Ok(Figure { what: "bodies lost", is: lost as f64, most: 0.0 })
}

/// The digest of all poses after some steps.
///
/// # Errors
/// None, for the stages there are.
pub fn digest(stage: Stage, size: usize, steps: u32) -> Result<u64, Box<dyn Error>> {
    let seconds = f64::from(steps) * STEP;
    Ok(match stage.build(size, SEED) {
        Scene::Plane(scene) => {
            let mut game: Game<Plane> = crate::opened::plane(&scene)?;
            game.update();
            play(&mut game, seconds, |_| ());
            game.digest()
        }
        Scene::Volume(scene) => {
            let mut game = volume(&scene)?;
            game.update();
            play(&mut game, seconds, |_| ());
            game.digest()
        }
    })
}

fn play<S: Playable>(game: &mut Game<S>, seconds: f64, mut tell: impl FnMut(&Game<S>)) {
    for _ in 0..(seconds / STEP).round() as u32 {
        game.step(STEP);
        tell(game);
    }
}
