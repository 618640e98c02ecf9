//! How far a body is from ground, triangle by triangle: what contacts with the whole ground must agree with.

use asunder_geometry::glam::Vec3;
use asunder_geometry::{Aabb3, Pose3, Shape3, Triangle3};
use asunder_narrow::{Manifold3, Pair3, Separation3};
use core::fmt::Display;

/// The least separation of a posed body from triangles in the world's axes, with its error, in metres; `None` beyond
/// the limit.
///
/// ```
/// use asunder_geometry::{Pose3, Shape3, Sphere, glam::Vec3};
/// use asunder_tests::bare_triangles::nearest;
/// let ball: Shape3 = Sphere::new(0.5)?.into();
/// let triangle = [[-1.0, -0.75, -1.0], [1.0, -0.75, -1.0], [0.0, -0.75, 1.0]].map(Vec3::from);
/// let (separation, error) = nearest(&ball, &Pose3::IDENTITY, &[triangle], 1.0).ok_or("further than a metre")?;
/// assert!((separation - 0.25).abs() <= error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn nearest(body: &Shape3, at: &Pose3, triangles: &[[Vec3; 3]], limit: f32) -> Option<(f64, f64)> {
    let mut least: Option<(f32, f32)> = None;
    let mut reach = body.bounds(at, limit);
    for &[a, b, c] in triangles {
        // Most triangles of large ground are further away than the nearest so far.
        if !reach.overlaps(&Aabb3::from_points([a, b, c])) {
            continue;
        }
        let triangle = Shape3::from(Triangle3::new(a, b, c).unwrap());
        let within = least.map_or(limit, |(separation, error)| (separation + error).max(0.0).min(limit));
        let Separation3::Measured(found) =
            Pair3::new(body, at, &triangle, &Pose3::IDENTITY).separation(within)
        else {
            continue;
        };
        if least.is_none_or(|least| found.separation < least.0) {
            least = Some((found.separation, found.error));
            reach = body.bounds(at, (found.separation + found.error).clamp(0.0, limit));
        }
    }
    least.map(|(separation, error)| (f64::from(separation), f64::from(error)))
}

/// The manifold with the least separation, which must agree with the given one within both errors.
///
/// ```should_panic
/// asunder_tests::bare_triangles::told_within(&[], (0.25, 1e-7), "a ball that nobody saw");
/// ```
pub fn told_within(
    manifolds: &[Manifold3],
    (separation, error): (f64, f64),
    story: impl Display,
) -> &Manifold3 {
    let least = manifolds.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
    let Some(least) = least else { panic!("{story}: {separation} +- {error}, and nothing told") };
    let off = (f64::from(least.separation) - separation).abs();
    let may = error + f64::from(least.error);
    assert!(off <= may, "{story}: {separation} +- {error}, off {off}, told {least:?}");
    least
}
