//! Hulls with a limited number of vertices.

use super::cloud::Cloud;
use super::{Hull, HullError};
use crate::tolerance::MAX_HULL_VERTICES;
use glam::Vec3;

impl Hull {
    /// A hull of up to 65,535 points with at most `max_vertices` (4 to 256), chosen greedily by always taking the
    /// furthest point next. Cost: about n log n.
    ///
    /// Its vertices are given points, bit for bit, so it lies inside the true hull; [`Hull::error`] bounds how far
    /// outside any of the points is. If [`Hull::from_points`] needs no more vertices than that, this is the same hull.
    ///
    /// ```
    /// use asunder::{Hull, glam::Vec3};
    /// // A ball of 512 points, as a hull of 32.
    /// let place = |i: u16| Vec3::new(f32::from(i % 8), f32::from(i / 8 % 8), f32::from(i / 64)) - Vec3::splat(3.5);
    /// let points: Vec<Vec3> = (0..512).map(|i| place(i).normalize()).collect();
    /// let hull = Hull::simplify(&points, 32)?;
    /// assert!(hull.vertices().len() <= 32 && hull.error() < 0.25);
    /// # Ok::<(), asunder::HullError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Hull::from_points`], except too many vertices; and a `max_vertices` that is not 4 to 256.
    pub fn simplify(points: &[Vec3], max_vertices: usize) -> Result<Self, HullError> {
        if !(4..=MAX_HULL_VERTICES).contains(&max_vertices) {
            return Err(HullError::VertexLimit { max_vertices });
        }
        Self::limited(&Cloud::new(points, 4)?, max_vertices)
    }
}
