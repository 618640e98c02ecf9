//! The queries of an index for a single box, for boxes that are in no index.

use super::cast::Cast;
use super::node::Node;
use super::reach::{Ask, To};
use super::sides;
use crate::width::Portable;
use asunder_geometry::Bounds;

impl Cast {
    /// The distance at which a box is met, if at `limit` or earlier: the same as an [`Index`](crate::Index) of this box
    /// would give.
    ///
    /// A box that holds another is met no later than that one.
    ///
    /// ```
    /// use asunder_broad::Cast;
    /// use asunder_geometry::{Aabb3, Ray3, glam::Vec3};
    /// let cast = Cast::from(Ray3::new([-2.0, 0.5, 0.5], Vec3::X)?);
    /// let unit = Aabb3::new(Vec3::ZERO, Vec3::ONE);
    /// assert!(cast.meets(&unit, 3.0).is_some_and(|distance| distance <= 2.0 && distance > 1.99999));
    /// assert_eq!(cast.meets(&unit, 1.0), None);
    /// # Ok::<(), asunder_geometry::RayError>(())
    /// ```
    #[inline]
    pub fn meets<B: Bounds>(&self, bounds: &B, limit: f64) -> Option<f64> {
        ask(&self, bounds, limit)
    }
}

/// A lower bound of the distance between two boxes in metres, `None` if one is empty: the same as an
/// [`Index`](crate::Index) of one would give for the other.
///
/// A box that holds another is no further from a third than that one.
///
/// ```
/// use asunder_broad::least_distance;
/// use asunder_geometry::{Aabb2, Bounds, glam::Vec2};
/// let unit = Aabb2::new(Vec2::ZERO, Vec2::ONE);
/// let far = Aabb2::new(Vec2::new(4.0, 5.0), Vec2::new(6.0, 6.0));
/// assert!(least_distance(&unit, &far).is_some_and(|distance| distance <= 5.0 && distance > 4.99999));
/// assert_eq!(least_distance(&unit, &Aabb2::NOTHING), None);
/// ```
#[inline]
pub fn least_distance<B: Bounds>(one: &B, other: &B) -> Option<f64> {
    if one.is_valid() { ask(&To(sides(one)), other, f64::INFINITY) } else { None }
}

#[inline]
fn ask<B: Bounds>(asked: &impl Ask, bounds: &B, limit: f64) -> Option<f64> {
    let limit = asked.within(limit);
    if !bounds.is_valid() || limit < 0.0 {
        return None;
    }
    let mut node = Node::EMPTY;
    node.push(&sides(bounds), 0, false);
    let far = asked.ask(Portable, &node, limit);
    (far.mask == 1).then(|| asked.told(far.distances[0]))
}
