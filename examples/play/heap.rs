//! The default scene: a tower of mixed bodies that falls into a heap.

use asunder::glam::DVec3;
use asunder::{Cuboid, Pose3, Shape3};
use asunder_examples::things;
use asunder_scenes::level::{Level3, LevelBody3};
use asunder_scenes::random::Random;
use std::error::Error;

/// Metres between neighbours in the tower, so that no two bodies touch at first.
const SPACING: f64 = 1.05;
/// Half of the kerb's height and width, in metres.
const KERB: f64 = 0.2;
/// The number of different shapes, the same of each of the six kinds; bodies share them.
const VARIANTS: usize = 96;

/// A floor with a kerb, and bodies in a tower about four times as tall as it is wide.
pub(crate) fn heap(count: usize, seed: u64) -> Result<Level3, Box<dyn Error>> {
    let mut random = Random::new(seed);
    let shapes: Vec<Shape3> =
        (0..VARIANTS).map(|number| things::shape(number, &mut random)).collect::<Result<_, _>>()?;
    let width = libm::ceil(libm::cbrt(count as f64 / 1.4)).max(1.0) as usize;
    let mut bodies = tray(0.5 * SPACING * (2 * width + 3) as f64)?;
    for number in 0..count {
        let cell = [number % width, number / (width * width), number / width % width].map(|i| i as f64);
        let middle = (width as f64 - 1.0) / 2.0;
        let jitter = random.within(DVec3::splat(-0.03), DVec3::splat(0.03));
        let position = DVec3::new(cell[0] - middle, cell[1] + 1.0, cell[2] - middle) * SPACING + jitter;
        let pose = Pose3::new(position, random.rotation())?;
        bodies.push(body(shapes[random.below(VARIANTS)].clone(), pose, false));
    }
    Ok(Level3 { name: "heap".to_owned(), gravity: DVec3::new(0.0, -9.81, 0.0), bodies })
}

/// A floor with its top at zero, and a kerb around it that keeps bodies from rolling off.
fn tray(reach: f64) -> Result<Vec<LevelBody3>, Box<dyn Error>> {
    let slab = |x: f64, y: f64, z: f64| Cuboid::from_half_extents(DVec3::new(x, y, z).as_vec3());
    let floor = slab(reach + 2.0 * KERB, 1.0, reach + 2.0 * KERB)?;
    let mut bodies = vec![body(floor.into(), Pose3::at([0.0, -1.0, 0.0])?, true)];
    let (long, short) = (slab(reach + 2.0 * KERB, KERB, KERB)?, slab(KERB, KERB, reach)?);
    for side in [-1.0, 1.0] {
        bodies.push(body(long.into(), Pose3::at([0.0, KERB, side * (reach + KERB)])?, true));
        bodies.push(body(short.into(), Pose3::at([side * (reach + KERB), KERB, 0.0])?, true));
    }
    Ok(bodies)
}

fn body(shape: Shape3, pose: Pose3, fixed: bool) -> LevelBody3 {
    LevelBody3 {
        shape,
        pose,
        linear_velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        fixed,
        sensor: false,
        layers: None,
        user_data: 0,
    }
}
