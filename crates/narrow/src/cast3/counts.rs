//! Which touches of a cast count, in space.

use super::beyond::Touched;
use super::passage::Passage;
use super::{OnGround, at_start};
use crate::impact3::Impact3;
use crate::level::Lies;
use crate::lists::with_manifolds3;
use crate::pair3::{Pair3, Part};
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};

/// Which touches count.
#[derive(Clone, Copy)]
pub(super) enum Counts<'c> {
    All,
    /// Touches with parts that are neither touched at the start nor level with those that are.
    Beyond(&'c Touched<'c>),
    /// Touches with parts that are not touched at the start, if the function says so.
    If(&'c dyn Fn(&Impact3) -> bool),
}

impl Counts<'_> {
    pub(super) fn is_all(self) -> bool {
        matches!(self, Self::All)
    }

    /// Whether a touch of two parts, at a fraction and along a unit axis from A to B, counts.
    pub(super) fn admits(
        self,
        (passage, parts): (&Passage, [Part; 2]),
        meeting: (f64, DVec3),
        impact: impl FnOnce() -> Impact3,
    ) -> bool {
        match self {
            Self::All => true,
            Self::Beyond(touched) => touched.lies(passage, parts, meeting) != Lies::Level,
            Self::If(counts) => counts(&impact()),
        }
    }
}

impl Pair3<'_> {
    /// The first touch of a [`cast`](Self::cast) for which `counts` is true, among the first touches with each part of
    /// a compound, or triangle of ground: the touch with one part may be of no use, and hide what is met a little later
    /// with another. Parts that touch at the start are judged by their contacts. Cost: as the cast, and where its
    /// answer does not count, another search.
    ///
    /// ```
    /// use asunder::{Compound3, Cuboid, Pair3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let (ball, cube) = (Shape3::from(Sphere::new(0.5)?), Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?));
    /// let (low, high) = (Pose3::at([0.0, -1.0, 0.0])?, Pose3::at([1.4, 0.0, 0.0])?);
    /// let stairs = Compound3::new([(low, cube.clone()), (high, cube)])?.into();
    /// let above = Pose3::at([0.0, 1.5, 0.0])?;
    /// let pair = Pair3::new(&ball, &above, &stairs, &Pose3::IDENTITY);
    /// let down = Vec3::NEG_Y * 2.0;
    /// assert!(pair.cast(down).is_some_and(|met| met.part_b == 1), "the edge of the step");
    /// assert!(pair.cast_if(down, |met| met.normal.y < -0.99).is_some_and(|met| met.part_b == 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_if(&self, displacement: Vec3, counts: impl Fn(&Impact3) -> bool) -> Option<Impact3> {
        let first = self.cast(displacement)?;
        if counts(&first) {
            return Some(first);
        }
        let has_parts = |shape: &Shape3| shape.is_ground() || matches!(shape, Shape3::Compound(_));
        if !has_parts(self.shape_a) && !has_parts(self.shape_b) {
            return None;
        }
        if first.overlapping {
            let touched =
                with_manifolds3(self, 0.0, |manifolds| manifolds.iter().map(at_start).find(&counts));
            if touched.is_some() {
                return touched;
            }
        }
        let passage = Passage::straight(self, displacement.as_dvec3());
        if !displacement.is_finite() || passage.is_still() {
            return None;
        }
        match OnGround::of(self) {
            Some(on) => self.first_touch_on(&on, &passage, Counts::If(&counts)),
            None => self.first_touch_of_parts(&passage, Counts::If(&counts)),
        }
    }
}
