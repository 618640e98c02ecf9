//! Things to throw: crates, rocks, balls, capsules, hammers and prisms.

use asunder::glam::{DVec3, Vec3};
use asunder::{Capsule3, Compound3, Cuboid, Hull, Pose3, Shape3, Sphere};
use asunder_scenes::random::Random;
use core::f64::consts::TAU;
use std::error::Error;

/// A thing of random size and of one of six kinds, by `number % 6`. No vertex of it is further than half a metre from
/// its origin.
///
/// ```
/// use asunder::Shape3;
/// use asunder_examples::things;
/// use asunder_scenes::random::Random;
/// let mut random = Random::new(1);
/// assert!(matches!(things::shape(2, &mut random), Ok(Shape3::Sphere(_))));
/// assert!((0..60).all(|number| things::shape(number, &mut random).is_ok()));
/// ```
///
/// # Errors
/// None, for the sizes drawn here.
pub fn shape(number: usize, random: &mut Random) -> Result<Shape3, Box<dyn Error>> {
    Ok(match number % 6 {
        0 => {
            let edge = random.range(0.18, 0.28);
            let stretch = random.within(DVec3::splat(0.8), DVec3::splat(1.0));
            Cuboid::from_half_extents((stretch * edge).as_vec3())?.into()
        }
        1 => {
            let (size, stretch) =
                (random.range(0.3, 0.46), random.within(DVec3::splat(0.7), DVec3::splat(1.0)));
            let points: Vec<Vec3> =
                (0..16).map(|_| (random.direction() * stretch * size).as_vec3()).collect();
            Hull::from_points(&points)?.into()
        }
        2 => Sphere::new(random.range(0.2, 0.34) as f32)?.into(),
        3 => {
            let (half_height, radius) = (random.range(0.12, 0.26), random.range(0.12, 0.22));
            Capsule3::from_half_height(half_height as f32, radius as f32)?.into()
        }
        4 => {
            let head = Cuboid::from_half_extents(Vec3::new(0.22, 0.1, 0.1))?.rounded(0.03)?;
            let handle = Capsule3::from_half_height(0.26, 0.09)?;
            let parts = [(Pose3::at([0.0, 0.3, 0.0])?, head.into()), (Pose3::IDENTITY, handle.into())];
            Compound3::new(parts)?.into()
        }
        _ => {
            let sides = 5 + random.below(8);
            let (radius, half_height) = (random.range(0.2, 0.32), random.range(0.2, 0.36));
            let corners: Vec<Vec3> = (0..2 * sides)
                .map(|i| {
                    let angle = TAU * (i / 2) as f64 / sides as f64;
                    let y = if i % 2 == 0 { -half_height } else { half_height };
                    DVec3::new(libm::cos(angle) * radius, y, libm::sin(angle) * radius).as_vec3()
                })
                .collect();
            Hull::from_points(&corners)?.into()
        }
    })
}
