//! Prisms and pyramids over regular polygons, to approximate cylinders and cones.

use super::{Hull, HullError};
use crate::ring;
use crate::tolerance::MAX_HULL_VERTICES;
use core::ops::RangeInclusive;
use glam::{DVec2, Vec3};

impl Hull {
    /// An upright prism over a regular polygon that approximates a cylinder. It is centred on its origin, with its axis
    /// along y like a capsule's. `radius`, in metres, is that of its corners, one of which points towards +x.
    ///
    /// It lies inside a cylinder of that radius, by at most radius (1 - cos(pi / sides)): 2 % for 16 sides, 0.5 % for
    /// 32 sides. More sides cost more: the time of contacts grows with the corners of the faces that meet, memory with
    /// the sides. On ground that is not flat each triangle below is tested separately: many bodies that roll over hills
    /// should have 8 to 12 sides, or be capsules. For a wheel, whose axle is y as well, turn the body.
    ///
    /// ```
    /// use asunder::{Hull, HullError, glam::DVec3};
    /// let drum = Hull::prism(0.5, 1.0, 16)?;
    /// assert_eq!((drum.vertices().len(), drum.topology().face_count()), (32, 18));
    /// assert!(drum.contains(DVec3::new(1.0, 0.5, 0.0)) && !drum.contains(DVec3::new(1.0, 0.5, 1e-9)));
    /// assert_eq!(Hull::prism(0.5, 1.0, 2).unwrap_err(), HullError::Sides { sides: 2, most: 128 });
    /// # Ok::<(), HullError>(())
    /// ```
    ///
    /// # Errors
    /// Fewer than 3 sides, or more than 128; a half height or a radius that is not positive and finite; any error of
    /// [`Hull::from_points`] for the corners.
    pub fn prism(half_height: f32, radius: f32, sides: usize) -> Result<Self, HullError> {
        let base = base(half_height, radius, (sides, 3..=MAX_HULL_VERTICES / 2))?;
        let points: Vec<Vec3> =
            base.flat_map(|corner| [-half_height, half_height].map(|y| at(corner, y))).collect();
        Self::from_points(&points)
    }

    /// An upright pyramid over a regular polygon that approximates a cone. Its base is at y = -`half_height`, its apex
    /// on the y axis at `half_height`; `radius`, in metres, is that of the base's corners, one of which points towards
    /// +x.
    ///
    /// ```
    /// use asunder::{Hull, HullError, glam::DVec3};
    /// let spike = Hull::pyramid(1.0, 0.25, 8)?;
    /// assert_eq!((spike.vertices().len(), spike.topology().face_count()), (9, 9));
    /// assert!(spike.contains(DVec3::Y) && spike.contains(DVec3::new(0.25, -1.0, 0.0)));
    /// assert_eq!(Hull::pyramid(1.0, 0.0, 8).unwrap_err(), HullError::NotPositive { value: 0.0 });
    /// # Ok::<(), HullError>(())
    /// ```
    ///
    /// # Errors
    /// Fewer than 3 sides, or more than 255; otherwise as [`Hull::prism`].
    pub fn pyramid(half_height: f32, radius: f32, sides: usize) -> Result<Self, HullError> {
        let base = base(half_height, radius, (sides, 3..=MAX_HULL_VERTICES - 1))?;
        let mut points: Vec<Vec3> = base.map(|corner| at(corner, -half_height)).collect();
        points.push(Vec3::Y * half_height);
        Self::from_points(&points)
    }
}

/// The corners of a base, if the parameters are valid.
fn base(
    half_height: f32,
    radius: f32,
    (sides, allowed): (usize, RangeInclusive<usize>),
) -> Result<impl Iterator<Item = DVec2>, HullError> {
    if !allowed.contains(&sides) {
        return Err(HullError::Sides { sides, most: *allowed.end() });
    }
    match [half_height, radius].into_iter().find(|value| !(*value > 0.0 && value.is_finite())) {
        Some(value) => Err(HullError::NotPositive { value }),
        None => Ok(ring::corners(sides, radius)),
    }
}

/// Seen from above, from the end of the y axis: x to the right, z down.
fn at(corner: DVec2, y: f32) -> Vec3 {
    Vec3::new(corner.x as f32, y, -corner.y as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape3;

    const SHARES: [f32; 5] = [1e-3, 0.1, 1.0, 10.0, 1e3];

    /// The area of a regular polygon over its squared radius.
    fn area(sides: usize) -> f64 {
        0.5 * sides as f64 * libm::sin(core::f64::consts::TAU / sides as f64)
    }

    /// Makes hulls of radius 1 with these numbers of sides, thin and thick, and checks that no corner or face is lost.
    fn made(
        sides: RangeInclusive<usize>,
        make: fn(f32, f32, usize) -> Result<Hull, HullError>,
        counts: fn(usize) -> (usize, usize),
    ) -> Vec<(usize, f32, Hull)> {
        let all = sides.flat_map(|sides| SHARES.map(|half_height| (sides, half_height)));
        let hulls = all.map(|(sides, half_height)| {
            let hull = make(half_height, 1.0, sides).unwrap();
            let found = (hull.vertices().len(), hull.topology().face_count());
            assert_eq!((found, hull.error()), (counts(sides), 0.0), "{sides} sides, {half_height} m");
            (sides, half_height, hull)
        });
        hulls.collect()
    }

    #[test]
    fn prisms_have_all_their_corners_and_sides() {
        for (sides, half_height, prism) in made(3..=128, Hull::prism, |sides| (2 * sides, sides + 2)) {
            let volume = 2.0 * f64::from(half_height) * area(sides);
            let made = Shape3::from(prism).mass_properties(1.0).unwrap().mass;
            assert!(
                (made / volume - 1.0).abs() < 1e-5,
                "{sides} sides, {half_height} m: {made} for {volume}"
            );
        }
    }

    #[test]
    fn pyramids_have_all_their_corners_and_sides() {
        for (sides, half_height, pyramid) in made(3..=255, Hull::pyramid, |sides| (sides + 1, sides + 1)) {
            let volume = 2.0 / 3.0 * f64::from(half_height) * area(sides);
            let made = Shape3::from(pyramid).mass_properties(1.0).unwrap().mass;
            assert!(
                (made / volume - 1.0).abs() < 1e-5,
                "{sides} sides, {half_height} m: {made} for {volume}"
            );
        }
    }

    #[test]
    fn what_is_no_number_of_sides_and_no_length_is_refused() {
        for (sides, most) in [(0, 128), (2, 128), (129, 128), (usize::MAX, 128)] {
            assert_eq!(Hull::prism(1.0, 1.0, sides).unwrap_err(), HullError::Sides { sides, most });
        }
        assert_eq!(Hull::pyramid(1.0, 1.0, 256).unwrap_err(), HullError::Sides { sides: 256, most: 255 });
        for value in [0.0, -1.0, f32::INFINITY, f32::NEG_INFINITY] {
            for (half_height, radius) in [(value, 1.0), (1.0, value)] {
                let refused = HullError::NotPositive { value };
                assert_eq!(Hull::prism(half_height, radius, 8).unwrap_err(), refused);
                assert_eq!(Hull::pyramid(half_height, radius, 8).unwrap_err(), refused);
            }
        }
        assert!(matches!(Hull::prism(f32::NAN, 1.0, 8), Err(HullError::NotPositive { .. })));
        assert!(matches!(Hull::prism(1.0, f32::MAX, 8), Err(HullError::TooLarge { .. })));
        assert!(matches!(Hull::prism(1e-9, 1e-9, 8), Err(HullError::TooSmall { .. })));
    }
}
