//! Axis-aligned boxes and their overlap test.

use glam::{Vec2, Vec3};

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Aabb2 {}
    impl Sealed for super::Aabb3 {}
}

/// The operations on boxes that a broad phase needs, in either dimension. Sealed: only [`Aabb2`] and [`Aabb3`]
/// implement it.
///
/// ```
/// use asunder::{Aabb3, Bounds, glam::Vec3};
/// let bounds = Aabb3::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0));
/// assert_eq!(bounds.interval(2), (0.0, 3.0));
/// assert_eq!(bounds.corners(), ([0.0; 3], [1.0, 2.0, 3.0]));
/// assert_eq!(Aabb3::AXES, 3);
/// let wide = bounds.widened(0.5);
/// assert_eq!(wide.max, Vec3::new(1.5, 2.5, 3.5));
/// assert!(wide.encloses(&bounds) && bounds.encloses(&bounds) && !bounds.encloses(&wide));
/// ```
pub trait Bounds: Copy + Send + Sync + core::fmt::Debug + PartialEq + sealed::Sealed + 'static {
    /// Number of axes.
    const AXES: usize;
    /// The same boxes as a concrete type, for code that is compiled once for each type, and not again in every caller.
    #[doc(hidden)]
    fn list(boxes: &[Self]) -> BoxList<'_>;
    /// A box that overlaps no box, not even itself.
    const NOTHING: Self;
    /// The least and greatest coordinate on an axis below [`Bounds::AXES`], in metres.
    fn interval(&self, axis: usize) -> (f32, f32);
    /// The minimum and maximum corner in space, in metres; a box in the plane has z = 0.
    fn corners(&self) -> ([f32; 3], [f32; 3]);
    /// Whether the box is a set of points: no NaN, no minimum above its maximum.
    fn is_valid(&self) -> bool;
    /// Whether the two closed boxes share a point, found by elimination. Invalid boxes share none.
    #[inline]
    fn overlaps(&self, other: &Self) -> bool {
        self.is_valid() && other.is_valid() && self.overlaps_valid(other)
    }
    /// Like [`overlaps`](Self::overlaps), but without branches, for two valid boxes; the result for others is
    /// meaningless.
    fn overlaps_valid(&self, other: &Self) -> bool;
    /// Whether the other box lies within this one. The empty [`Bounds::NOTHING`] lies within every box.
    fn encloses(&self, other: &Self) -> bool;
    /// The box with all sides moved outwards by a distance in metres, each rounded once.
    fn widened(&self, metres: f32) -> Self;
}

/// Boxes of either dimension.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum BoxList<'a> {
    /// Boxes in the plane.
    Plane(&'a [Aabb2]),
    /// Boxes in space.
    Space(&'a [Aabb3]),
}

/// A closed axis-aligned box in the plane, in metres.
///
/// A box with a NaN, or with a minimum above its maximum, is the empty set and overlaps nothing.
///
/// ```
/// use asunder::{Aabb2, glam::Vec2};
/// let left = Aabb2::new(Vec2::ZERO, Vec2::ONE);
/// let right = Aabb2::new(Vec2::new(1.0, 0.0), Vec2::new(2.0, 1.0));
/// assert!(left.overlaps(&right), "closed sets: touching counts");
/// assert!(!left.overlaps(&Aabb2::new(Vec2::splat(1.5), Vec2::splat(2.0))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb2 {
    /// Minimum corner.
    pub min: Vec2,
    /// Maximum corner.
    pub max: Vec2,
}

/// A closed axis-aligned box in space, in metres.
///
/// A box with a NaN, or with a minimum above its maximum, is the empty set and overlaps nothing.
///
/// ```
/// use asunder::{Aabb3, glam::Vec3};
/// let low = Aabb3::new(Vec3::ZERO, Vec3::ONE);
/// let high = Aabb3::new(Vec3::new(0.0, 0.0, 1.5), Vec3::splat(2.0));
/// assert!(!low.overlaps(&high), "one axis that parts them is enough");
/// assert_eq!(low.union(&high).max, Vec3::splat(2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb3 {
    /// Minimum corner.
    pub min: Vec3,
    /// Maximum corner.
    pub max: Vec3,
}

impl Aabb2 {
    /// A box from its minimum and maximum corner. Not checked: see the type for the meaning of an inverted one.
    #[inline]
    pub const fn new(min: Vec2, max: Vec2) -> Self {
        Self { min, max }
    }

    /// The least box around points, in metres; [`Bounds::NOTHING`] if there are none. NaN coordinates are left out.
    ///
    /// ```
    /// use asunder::{Aabb2, Bounds, glam::Vec2};
    /// let around = Aabb2::from_points([(1.0, 4.0), (-2.0, 0.5)].map(Vec2::from));
    /// assert_eq!(around, Aabb2::new(Vec2::new(-2.0, 0.5), Vec2::new(1.0, 4.0)));
    /// assert_eq!(Aabb2::from_points([]), Aabb2::NOTHING);
    /// ```
    pub fn from_points(points: impl IntoIterator<Item = Vec2>) -> Self {
        points.into_iter().fold(Self::NOTHING, |Self { min, max }, point| Self {
            // Not by `min` and `max`, whose results for NaN depend on the platform.
            min: Vec2::select(point.cmplt(min), point, min),
            max: Vec2::select(point.cmpgt(max), point, max),
        })
    }

    /// Whether the closed boxes share a point, by elimination (four comparisons): as soon as one axis separates the
    /// pair, it is done.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        Bounds::overlaps(self, other)
    }

    /// Whether the closed box contains the point.
    #[inline]
    pub fn contains(&self, point: Vec2) -> bool {
        self.min.x <= point.x && point.x <= self.max.x && self.min.y <= point.y && point.y <= self.max.y
    }

    /// The least box around both. Both must be valid.
    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The centre, half way between both corners, in metres; 0 along an axis on which the box is infinite on both
    /// sides, like that of a half-space. Does not overflow, however far out the corners are.
    ///
    /// ```
    /// use asunder::{Aabb2, glam::Vec2};
    /// let crate_ = Aabb2::new(Vec2::ONE, Vec2::splat(3.0));
    /// assert_eq!((crate_.center(), crate_.half_extents()), (Vec2::splat(2.0), Vec2::ONE));
    /// ```
    #[inline]
    pub fn center(&self) -> Vec2 {
        let center = self.min * 0.5 + self.max * 0.5;
        // If it is infinite on both sides, the halves add up to NaN.
        Vec2::select(center.is_nan_mask(), Vec2::ZERO, center)
    }

    /// Half of its width along each axis, in metres; negative along an axis on which its corners are swapped.
    #[inline]
    pub fn half_extents(&self) -> Vec2 {
        self.max * 0.5 - self.min * 0.5
    }

    /// The intersection of both; `None` if they share no point.
    ///
    /// ```
    /// use asunder::{Aabb2, glam::Vec2};
    /// let (one, other) = (Aabb2::new(Vec2::ZERO, Vec2::ONE), Aabb2::new(Vec2::splat(0.5), Vec2::splat(2.0)));
    /// assert_eq!(one.intersection(&other), Some(Aabb2::new(Vec2::splat(0.5), Vec2::ONE)));
    /// assert_eq!(one.intersection(&Aabb2::new(Vec2::splat(1.5), Vec2::splat(2.0))), None);
    /// ```
    #[inline]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.overlaps(other).then(|| Self { min: self.min.max(other.min), max: self.max.min(other.max) })
    }
}

impl Aabb3 {
    /// A box from its minimum and maximum corner. Not checked: see the type for the meaning of an inverted one.
    #[inline]
    pub const fn new(min: Vec3, max: Vec3) -> Self {
        Self { min, max }
    }

    /// The least box around points, in metres; [`Bounds::NOTHING`] if there are none. NaN coordinates are left out.
    ///
    /// ```
    /// use asunder::{Aabb3, Bounds, glam::Vec3};
    /// let around = Aabb3::from_points([(1.0, 4.0, 0.0), (-2.0, 0.5, 3.0)].map(Vec3::from));
    /// assert_eq!(around, Aabb3::new(Vec3::new(-2.0, 0.5, 0.0), Vec3::new(1.0, 4.0, 3.0)));
    /// assert_eq!(Aabb3::from_points([]), Aabb3::NOTHING);
    /// ```
    pub fn from_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::NOTHING, |Self { min, max }, point| Self {
            // Not by `min` and `max`, whose results for NaN depend on the platform.
            min: Vec3::select(point.cmplt(min), point, min),
            max: Vec3::select(point.cmpgt(max), point, max),
        })
    }

    /// Whether the closed boxes share a point, by elimination (six comparisons): as soon as one axis separates the
    /// pair, it is done.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        Bounds::overlaps(self, other)
    }

    /// Whether the closed box contains the point.
    #[inline]
    pub fn contains(&self, point: Vec3) -> bool {
        self.min.x <= point.x
            && point.x <= self.max.x
            && self.min.y <= point.y
            && point.y <= self.max.y
            && self.min.z <= point.z
            && point.z <= self.max.z
    }

    /// The least box around both. Both must be valid.
    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The centre, half way between both corners, in metres; 0 along an axis on which the box is infinite on both
    /// sides, like that of a half-space. Does not overflow, however far out the corners are.
    ///
    /// ```
    /// use asunder::{Aabb3, glam::Vec3};
    /// let crate_ = Aabb3::new(Vec3::ONE, Vec3::splat(3.0));
    /// assert_eq!((crate_.center(), crate_.half_extents()), (Vec3::splat(2.0), Vec3::ONE));
    /// ```
    #[inline]
    pub fn center(&self) -> Vec3 {
        let center = self.min * 0.5 + self.max * 0.5;
        // If it is infinite on both sides, the halves add up to NaN.
        Vec3::select(center.is_nan_mask(), Vec3::ZERO, center)
    }

    /// Half of its width along each axis, in metres; negative along an axis on which its corners are swapped.
    #[inline]
    pub fn half_extents(&self) -> Vec3 {
        self.max * 0.5 - self.min * 0.5
    }

    /// The intersection of both; `None` if they share no point.
    ///
    /// ```
    /// use asunder::{Aabb3, glam::Vec3};
    /// let (one, other) = (Aabb3::new(Vec3::ZERO, Vec3::ONE), Aabb3::new(Vec3::splat(0.5), Vec3::splat(2.0)));
    /// assert_eq!(one.intersection(&other), Some(Aabb3::new(Vec3::splat(0.5), Vec3::ONE)));
    /// assert_eq!(one.intersection(&Aabb3::new(Vec3::splat(1.5), Vec3::splat(2.0))), None);
    /// ```
    #[inline]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.overlaps(other).then(|| Self { min: self.min.max(other.min), max: self.max.min(other.max) })
    }
}

impl Bounds for Aabb2 {
    fn list(boxes: &[Self]) -> BoxList<'_> {
        BoxList::Plane(boxes)
    }

    const AXES: usize = 2;
    const NOTHING: Self = Self { min: Vec2::INFINITY, max: Vec2::NEG_INFINITY };

    #[inline]
    fn interval(&self, axis: usize) -> (f32, f32) {
        (self.min[axis], self.max[axis])
    }

    #[inline]
    fn corners(&self) -> ([f32; 3], [f32; 3]) {
        ([self.min.x, self.min.y, 0.0], [self.max.x, self.max.y, 0.0])
    }

    #[inline]
    fn is_valid(&self) -> bool {
        self.min.x <= self.max.x && self.min.y <= self.max.y
    }

    #[inline]
    fn overlaps_valid(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() & other.min.cmple(self.max).all()
    }

    #[inline]
    fn encloses(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() & self.max.cmpge(other.max).all()
    }

    #[inline]
    fn widened(&self, metres: f32) -> Self {
        Self { min: self.min - metres, max: self.max + metres }
    }
}

impl Bounds for Aabb3 {
    fn list(boxes: &[Self]) -> BoxList<'_> {
        BoxList::Space(boxes)
    }

    const AXES: usize = 3;
    const NOTHING: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    #[inline]
    fn interval(&self, axis: usize) -> (f32, f32) {
        (self.min[axis], self.max[axis])
    }

    #[inline]
    fn corners(&self) -> ([f32; 3], [f32; 3]) {
        (self.min.to_array(), self.max.to_array())
    }

    #[inline]
    fn is_valid(&self) -> bool {
        self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z
    }

    #[inline]
    fn overlaps_valid(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() & other.min.cmple(self.max).all()
    }

    #[inline]
    fn encloses(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() & self.max.cmpge(other.max).all()
    }

    #[inline]
    fn widened(&self, metres: f32) -> Self {
        Self { min: self.min - metres, max: self.max + metres }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_overlaps_nothing() {
        let everything = Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY);
        assert!(everything.overlaps(&everything));
        assert!(!everything.overlaps(&Aabb3::NOTHING));
        assert!(!Aabb3::NOTHING.overlaps(&Aabb3::NOTHING));
        assert!(!Aabb2::NOTHING.overlaps(&Aabb2::NOTHING));
    }

    #[test]
    fn a_box_around_points_leaves_out_what_is_no_number() {
        let points = [Vec3::new(1.0, f32::NAN, f32::NAN), Vec3::new(f32::NAN, -2.0, f32::NAN), Vec3::X];
        let around = Aabb3::from_points(points);
        assert_eq!(around, Aabb3::new(Vec3::new(1.0, -2.0, 0.0), Vec3::X));
        assert!(around.is_valid() && !Aabb3::from_points(points[..2].iter().copied()).is_valid());
        assert!(points[2..].iter().all(|&point| around.contains(point)));
        assert_eq!(Aabb2::from_points([Vec2::NAN]), Aabb2::NOTHING);
    }

    #[test]
    fn boxes_without_an_end_have_a_middle() {
        let below = Aabb3::new(Vec3::NEG_INFINITY, Vec3::new(f32::INFINITY, 1.0, f32::INFINITY));
        assert_eq!(below.center(), Vec3::new(0.0, f32::NEG_INFINITY, 0.0));
        let all = Aabb2::new(Vec2::NEG_INFINITY, Vec2::INFINITY);
        assert_eq!((all.center(), all.half_extents()), (Vec2::ZERO, Vec2::INFINITY));
    }

    #[test]
    fn nan_and_inverted_boxes_overlap_nothing() {
        let unit = Aabb3::new(Vec3::ZERO, Vec3::ONE);
        let mut broken = unit;
        broken.max.y = f32::NAN;
        assert!(!unit.overlaps(&broken) && !broken.overlaps(&broken));
        // Inverted, yet every one of the six comparisons holds: only the explicit check rejects it.
        let inverted = Aabb3::new(Vec3::splat(0.6), Vec3::splat(0.4));
        assert!(!unit.overlaps(&inverted) && !inverted.overlaps(&unit));
    }
}
