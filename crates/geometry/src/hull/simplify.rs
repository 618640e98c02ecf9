//! Hulls with as few vertices as asked for.

use super::cloud::Cloud;
use super::{Hull, HullError};
use crate::tolerance::MAX_HULL_VERTICES;
use glam::Vec3;

impl Hull {
    /// A hull of at most `max_vertices` of up to 65,535 points, 4 to 256, that leaves as little outside as taking
    /// the furthest point next can do. Cost: about n log n.
    ///
    /// Its vertices are points of the cloud, bit for bit, so it lies inside the true hull; [`Hull::error`] bounds how far
    /// outside any of the points is. Where [`Hull::from_points`] needs no more vertices than that, this is
    /// the same hull.
    ///
    /// ```
    /// use asunder_geometry::{Hull, glam::Vec3};
    /// // A ball of 400 points, as a hull of 32.
    /// let points: Vec<Vec3> = (0..400_u16)
    ///     .map(|i| {
    ///         let z = (f32::from(i) + 0.5) / 200.0 - 1.0;
    ///         let (sin, cos) = asunder_geometry::glam::Vec2::from_angle(2.4 * f32::from(i)).into();
    ///         Vec3::new(sin, cos, 0.0) * (1.0 - z * z).sqrt() + Vec3::Z * z
    ///     })
    ///     .collect();
    /// let hull = Hull::simplify(&points, 32)?;
    /// assert!(hull.vertices().len() <= 32 && hull.error() < 0.25);
    /// # Ok::<(), asunder_geometry::HullError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Hull::from_points`], and a number of vertices that is not 4 to 256; never too many vertices.
    pub fn simplify(points: &[Vec3], max_vertices: usize) -> Result<Self, HullError> {
        if !(4..=MAX_HULL_VERTICES).contains(&max_vertices) {
            return Err(HullError::VertexLimit { max_vertices });
        }
        let cloud = Cloud::new(points, 4)?;
        match Self::solid(&cloud) {
            Ok(hull) if hull.vertices().len() <= max_vertices => Ok(hull),
            Ok(_) | Err(HullError::TooManyVertices { .. }) => Self::budgeted(&cloud, max_vertices),
            Err(error) => Err(error),
        }
    }
}
