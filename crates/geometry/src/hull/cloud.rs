//! A checked cloud of points without duplicates, in an order that depends on positions alone.

use super::HullError;
use crate::tolerance::{MAX_HULL_POINTS, MAX_RADIUS};
use glam::{DVec3, Vec3};

/// Finite points within range, no two the same, sorted by x, then y, then z.
///
/// Sorted, so that code which breaks ties by index gives the same result however the points were shuffled.
pub(super) struct Cloud {
    pub(super) points: Vec<Vec3>,
    /// The first index of each in the user's list.
    pub(super) source: Vec<u32>,
    /// Half the diagonal of the box around them, in metres: the size that [`COPLANAR`] is a share of.
    ///
    /// [`COPLANAR`]: crate::tolerance::COPLANAR
    pub(super) scale: f64,
}

impl Cloud {
    pub(super) fn new(points: &[Vec3], least: usize) -> Result<Self, HullError> {
        check_points(points, least)?;
        let mut keys: Vec<(u64, u64)> = (0_u64..)
            .zip(points)
            .map(|(i, v)| {
                let [x, y, z] = rank(*v).map(u64::from);
                (x << 32 | y, z << 32 | i)
            })
            .collect();
        keys.sort_unstable();
        // Equal points are adjacent, the first of the list in front.
        keys.dedup_by_key(|&mut (xy, zi)| (xy, zi >> 32));
        let source: Vec<u32> = keys.iter().map(|&(_, zi)| zi as u32).collect();
        let points: Vec<Vec3> = source.iter().map(|&i| points[i as usize]).collect();
        let scale = half_diagonal(&points);
        Ok(Self { points, source, scale })
    }
}

/// Half the diagonal of the box around points, in metres.
pub(super) fn half_diagonal(points: &[Vec3]) -> f64 {
    let (low, high) = points
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), v| (l.min(v.as_dvec3()), h.max(v.as_dvec3())));
    if points.is_empty() { 0.0 } else { (high - low).length() * 0.5 }
}

fn check_points(points: &[Vec3], least: usize) -> Result<(), HullError> {
    if points.len() < least {
        return Err(HullError::TooFewPoints { count: points.len() });
    }
    if points.len() > MAX_HULL_POINTS {
        return Err(HullError::TooManyPoints { count: points.len() });
    }
    for (index, point) in points.iter().enumerate() {
        if !point.is_finite() {
            return Err(HullError::NotFinite { index });
        }
        if point.as_dvec3().length() > f64::from(MAX_RADIUS) {
            return Err(HullError::TooLarge { index });
        }
    }
    Ok(())
}

/// The sort key of a cloud's points.
pub(super) fn rank(point: Vec3) -> [u32; 3] {
    point.to_array().map(ascending)
}

/// An integer with the order of finite numbers, in which -0 and +0 are the same.
fn ascending(coordinate: f32) -> u32 {
    let bits = (coordinate + 0.0).to_bits();
    if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_sorted_and_named_once_by_the_earliest() {
        let points = [(0.0, 1.0), (-0.0, 1.0), (-2.0, 0.0), (0.0, -1.0), (-2.0, -0.0), (1e-45, 1.0)];
        let cloud = Cloud::new(&points.map(|(x, y)| Vec3::new(x, y, 3.0)), 1).unwrap();
        assert_eq!(cloud.source, [2, 3, 0, 5]);
    }
}
