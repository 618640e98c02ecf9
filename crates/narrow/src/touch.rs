//! Touches: what a body stands on, leans against or is stuck in. [`next_impact_beside`](Pair3::next_impact_beside) takes
//! them, and passes over what is flush with them.

use crate::answer::{Manifold2, Manifold3};
use crate::lists::{with_manifolds2, with_manifolds3};
use crate::pair2::Pair2;
use crate::pair3::Pair3;
use asunder_geometry::glam::{DVec2, DVec3, Vec2, Vec3};

/// A contact of a body with a third body, outside of a pair: for example the tile on which it stands, in a query about
/// the next tile.
///
/// ```
/// use asunder::{Cuboid, Motion3, Pair3, Pose3, Shape3, Touch3, glam::Vec3};
/// let tile = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 0.5, 1.0))?);
/// let crate_ = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.4))?);
/// // It is a millimetre in the tile that it stands on, and so in the way of the next one's side.
/// let (sunk, here, next) = (Pose3::at([0.0, 0.899, 0.0])?, Pose3::IDENTITY, Pose3::at([2.0, 0.0, 0.0])?);
/// let (push, still) = (Motion3::shift([1.5, 0.0, 0.0])?, Motion3::STILL);
/// let on_tile = Pair3::new(&crate_, &sunk, &tile, &here).manifold(0.0).ok_or("it stands there")?;
/// let stands = Touch3::of(&on_tile, true);
/// assert!(stands.normal == Vec3::NEG_Y && (stands.separation + 0.001).abs() < 1e-6);
/// let pair = Pair3::new(&crate_, &sunk, &tile, &next);
/// assert!(pair.next_impact(&push, &still).is_some());
/// assert_eq!(pair.next_impact_beside(&[stands], &push, &still), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch<V> {
    /// Unit axis in world axes, from the body to the touched one.
    pub normal: V,
    /// The separation of the two along it, in metres: negative if they overlap.
    pub separation: f32,
}

/// A contact of a body in the plane with a third body: see [`Touch`].
///
/// ```
/// use asunder::{Circle, Pair2, Pose2, Shape2, Touch2, glam::Vec2};
/// let ball = Shape2::from(Circle::new(0.5)?);
/// let beside = Pose2::at([0.75, 0.0])?;
/// let touch = Pair2::new(&ball, &Pose2::IDENTITY, &ball, &beside).manifold(0.0).ok_or("they touch")?;
/// let [of_a, of_b]: [Touch2; 2] = [true, false].map(|is_a| Touch2::of(&touch, is_a));
/// assert_eq!((of_a.normal, of_b.normal), (Vec2::X, Vec2::NEG_X));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Touch2 = Touch<Vec2>;

/// A contact of a body in space with a third body: see [`Touch`].
pub type Touch3 = Touch<Vec3>;

impl Touch<Vec2> {
    /// The touch of a manifold, from the point of view of its A or its B.
    pub fn of(manifold: &Manifold2, is_a: bool) -> Self {
        let normal = if is_a { manifold.normal } else { -manifold.normal };
        Self { normal, separation: manifold.separation }
    }

    /// Axis and separation; `None` unless the axis is of unit length and the separation finite.
    pub(crate) fn axis(&self) -> Option<(DVec2, f64)> {
        let is_sound = self.normal.is_normalized() && self.separation.is_finite();
        is_sound.then(|| (self.normal.as_dvec2(), self.separation.into()))
    }
}

impl Touch<Vec3> {
    /// The touch of a manifold, from the point of view of its A or its B.
    pub fn of(manifold: &Manifold3, is_a: bool) -> Self {
        let normal = if is_a { manifold.normal } else { -manifold.normal };
        Self { normal, separation: manifold.separation }
    }

    /// Axis and separation; `None` unless the axis is of unit length and the separation finite.
    pub(crate) fn axis(&self) -> Option<(DVec3, f64)> {
        let is_sound = self.normal.is_normalized() && self.separation.is_finite();
        is_sound.then(|| (self.normal.as_dvec3(), self.separation.into()))
    }
}

impl Pair2<'_> {
    /// Appends A's contacts with B, one per manifold, if the two overlap. Cost: that of the overlap test, and of the
    /// manifolds.
    ///
    /// ```
    /// use asunder::{Circle, Pair2, Pose2, Shape2, Touch2, glam::Vec2};
    /// let ball = Shape2::from(Circle::new(1.0)?);
    /// let (here, there) = (Pose2::IDENTITY, Pose2::at([1.5, 0.0])?);
    /// let mut touches = vec![];
    /// Pair2::new(&ball, &here, &ball, &there).add_touches(&mut touches);
    /// assert_eq!(touches, [Touch2 { normal: Vec2::X, separation: -0.5 }]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_touches(&self, to: &mut Vec<Touch2>) {
        if self.overlaps() {
            with_manifolds2(self, 0.0, |manifolds| {
                to.extend(manifolds.iter().map(|it| Touch2::of(it, true)))
            });
        }
    }
}

impl Pair3<'_> {
    /// Appends A's contacts with B, one per manifold, if the two overlap. Cost: that of the overlap test, and of the
    /// manifolds.
    ///
    /// ```
    /// use asunder::{Pair3, Pose3, Shape3, Sphere, Touch3, glam::Vec3};
    /// let ball = Shape3::from(Sphere::new(1.0)?);
    /// let (here, there) = (Pose3::IDENTITY, Pose3::at([1.5, 0.0, 0.0])?);
    /// let mut touches = vec![];
    /// Pair3::new(&ball, &here, &ball, &there).add_touches(&mut touches);
    /// assert_eq!(touches, [Touch3 { normal: Vec3::X, separation: -0.5 }]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_touches(&self, to: &mut Vec<Touch3>) {
        if self.overlaps() {
            with_manifolds3(self, 0.0, |manifolds| {
                to.extend(manifolds.iter().map(|it| Touch3::of(it, true)))
            });
        }
    }
}
