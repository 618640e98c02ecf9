//! Contact points stored in place: a short list that is copied like a number.

use crate::answer::{ContactPoint2, ContactPoint3};
use crate::feature::{Feature, FeatureId};
use asunder_geometry::glam::{Vec2, Vec3};
use core::fmt;
use core::ops::{Deref, DerefMut};

/// Up to `N` contact points, stored in place; reads as a slice.
///
/// Its own type because it is [`Copy`]: `arrayvec`'s list has drop glue, so dropping last frame's manifolds read each
/// of them once more, a twenty-fifth of a frame of boxes or pyramids (AMD EPYC, Zen 4, 2026-11-23).
///
/// ```
/// use asunder::{ContactPoint3, ContactPoints, Cuboid, Pair3, Pose3, Shape3, glam::Vec3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (here, above) = (Pose3::IDENTITY, Pose3::at([0.0, 1.5, 0.0])?);
/// let manifold = Pair3::new(&cube, &here, &cube, &above).manifold(0.0).ok_or("they touch")?;
/// let mut points: ContactPoints<ContactPoint3, 4> = manifold.points;
/// assert_eq!((points.len(), points[0].separation), (4, -0.5));
/// points.retain(|point| point.anchor_a.x > 0.0);
/// assert_eq!((points.len(), manifold.points.len()), (2, 4), "a copy is another list");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct ContactPoints<P, const N: usize> {
    /// Entries past `count` mean nothing.
    list: [P; N],
    count: u32,
}

/// A point with a blank value.
pub(crate) trait Blank: Copy {
    const BLANK: Self;
}

pub(crate) const NOTHING: FeatureId = FeatureId::new(Feature::Vertex(0), Feature::Vertex(0));

impl Blank for ContactPoint2 {
    const BLANK: Self =
        Self { separation: 0.0, anchor_a: Vec2::ZERO, anchor_b: Vec2::ZERO, feature: NOTHING };
}

impl Blank for ContactPoint3 {
    const BLANK: Self =
        Self { separation: 0.0, anchor_a: Vec3::ZERO, anchor_b: Vec3::ZERO, feature: NOTHING };
}

#[allow(private_bounds, reason = "points of the plane and of space are all there are")]
impl<P: Blank, const N: usize> ContactPoints<P, N> {
    /// An empty list.
    ///
    /// ```
    /// use asunder::{ContactPoint3, ContactPoints};
    /// assert!(ContactPoints::<ContactPoint3, 4>::new().is_empty());
    /// ```
    pub const fn new() -> Self {
        Self { list: [P::BLANK; N], count: 0 }
    }
}

impl<P: Copy, const N: usize> ContactPoints<P, N> {
    /// Adds a point at the end if there is room, and returns whether there was.
    ///
    /// ```
    /// use asunder::{ContactPoint2, ContactPoints, Feature, FeatureId, glam::Vec2};
    /// let feature = FeatureId::new(Feature::Vertex(0), Feature::Edge(1));
    /// let point = ContactPoint2 { separation: 0.0, anchor_a: Vec2::X, anchor_b: Vec2::X, feature };
    /// let mut points = ContactPoints::<ContactPoint2, 2>::new();
    /// assert_eq!([0; 3].map(|_| points.push(point)), [true, true, false]);
    /// ```
    #[inline]
    pub fn push(&mut self, point: P) -> bool {
        let place = self.list.get_mut(self.count as usize);
        let has_room = place.is_some();
        if let Some(place) = place {
            *place = point;
            self.count += 1;
        }
        has_room
    }

    /// Replaces the list by what `make` makes of each point of another: same capacity, so no check for room.
    #[inline(always)]
    pub(crate) fn fill<Q>(&mut self, from: &ContactPoints<Q, N>, make: impl Fn(&Q) -> P) {
        for (place, point) in self.list.iter_mut().zip(&**from) {
            *place = make(point);
        }
        self.count = from.count;
    }

    /// Removes all points.
    #[inline]
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Keeps the first `count` points, if there are more.
    pub fn truncate(&mut self, count: usize) {
        self.count = self.count.min(u32::try_from(count).unwrap_or(u32::MAX));
    }

    /// Removes and returns a point, if it is there; those after it move up.
    pub fn remove(&mut self, index: usize) -> Option<P> {
        let point = *self.get(index)?;
        self.list.copy_within(index + 1..self.count as usize, index);
        self.count -= 1;
        Some(point)
    }

    /// Keeps the points for which `keep` is true, in their order.
    pub fn retain(&mut self, mut keep: impl FnMut(&P) -> bool) {
        let all = *self;
        self.clear();
        self.extend(all.into_iter().filter(|point| keep(point)));
    }

    /// Whether there is no room for another point.
    pub const fn is_full(&self) -> bool {
        self.count as usize == N
    }
}

impl<P, const N: usize> Deref for ContactPoints<P, N> {
    type Target = [P];

    #[inline]
    fn deref(&self) -> &[P] {
        self.list.get(..self.count as usize).unwrap_or_default()
    }
}

impl<P, const N: usize> DerefMut for ContactPoints<P, N> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [P] {
        self.list.get_mut(..self.count as usize).unwrap_or_default()
    }
}

impl<P: Blank, const N: usize> Default for ContactPoints<P, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: PartialEq, const N: usize> PartialEq for ContactPoints<P, N> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<P: fmt::Debug, const N: usize> fmt::Debug for ContactPoints<P, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&**self).finish()
    }
}

/// Adds points for as long as there is room.
impl<P: Copy, const N: usize> Extend<P> for ContactPoints<P, N> {
    #[inline]
    fn extend<I: IntoIterator<Item = P>>(&mut self, points: I) {
        for point in points {
            if !self.push(point) {
                return;
            }
        }
    }
}

/// The first points, for as long as there is room.
impl<P: Blank, const N: usize> FromIterator<P> for ContactPoints<P, N> {
    fn from_iter<I: IntoIterator<Item = P>>(points: I) -> Self {
        let mut list = Self::new();
        list.extend(points);
        list
    }
}

impl<P, const N: usize> IntoIterator for ContactPoints<P, N> {
    type Item = P;
    type IntoIter = core::iter::Take<core::array::IntoIter<P, N>>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter().take(self.count as usize)
    }
}

impl<'a, P, const N: usize> IntoIterator for &'a ContactPoints<P, N> {
    type Item = &'a P;
    type IntoIter = core::slice::Iter<'a, P>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a, P, const N: usize> IntoIterator for &'a mut ContactPoints<P, N> {
    type Item = &'a mut P;
    type IntoIter = core::slice::IterMut<'a, P>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

#[cfg(feature = "serde")]
mod saved {
    use super::{Blank, ContactPoints};
    use core::fmt;
    use core::marker::PhantomData;
    use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
    use serde::ser::{Serialize, Serializer};

    /// As a sequence.
    impl<P: Serialize, const N: usize> Serialize for ContactPoints<P, N> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_seq(self)
        }
    }

    struct Few<P, const N: usize>(PhantomData<P>);

    impl<'de, P: Blank + Deserialize<'de>, const N: usize> Visitor<'de> for Few<P, N> {
        type Value = ContactPoints<P, N>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "no more than {N} contact points")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
            let mut points = ContactPoints::new();
            while let Some(point) = sequence.next_element()? {
                if !points.push(point) {
                    return Err(A::Error::invalid_length(N + 1, &self));
                }
            }
            Ok(points)
        }
    }

    impl<'de, P: Blank + Deserialize<'de>, const N: usize> Deserialize<'de> for ContactPoints<P, N> {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_seq(Few(PhantomData))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(number: u8) -> ContactPoint3 {
        ContactPoint3 { separation: number.into(), ..ContactPoint3::BLANK }
    }

    fn numbers(points: &ContactPoints<ContactPoint3, 4>) -> Vec<f32> {
        points.iter().map(|point| point.separation).collect()
    }

    #[test]
    fn points_do_as_a_list_does() {
        // Every list of up to four of what stays (even) and what goes, beside the same done to a plain list.
        for count in 0_u8..=4 {
            for mask in 0..1_u8 << count {
                let all = || (0..count).map(|i| point(2 * i + (mask >> i & 1)));
                let mut points: ContactPoints<_, 4> = all().collect();
                let mut plain: Vec<_> = all().collect();
                assert_eq!((points.len(), points.is_full()), (plain.len(), count == 4));
                assert!(points.into_iter().eq(plain.iter().copied()) && (&points).into_iter().eq(&plain));
                assert_eq!(format!("{points:?}"), format!("{plain:?}"));
                for index in 0..6 {
                    let (mut fewer, mut cut) = (points, points);
                    let expected = (index < plain.len()).then(|| plain[index]);
                    assert_eq!(fewer.remove(index), expected);
                    cut.truncate(index);
                    assert_eq!(&*cut, &plain[..index.min(plain.len())]);
                    if expected.is_some() {
                        let mut left = plain.clone();
                        left.remove(index);
                        assert_eq!(&*fewer, &*left);
                    }
                }
                points.retain(|point| point.separation % 2.0 == 0.0);
                plain.retain(|point| point.separation % 2.0 == 0.0);
                assert_eq!(&*points, &*plain);
                for point in &mut points {
                    point.separation += 1.0;
                }
                assert!(numbers(&points).iter().zip(&plain).all(|(n, old)| *n == old.separation + 1.0));
                points.clear();
                assert_eq!(points, ContactPoints::default());
            }
        }
    }

    #[test]
    fn what_lies_past_the_end_is_no_part_of_it() {
        let mut points: ContactPoints<_, 4> = (0..9).map(point).collect();
        assert_eq!(numbers(&points), [0.0, 1.0, 2.0, 3.0], "the first for which there is room");
        assert!(!points.push(point(7)));
        points.truncate(1);
        let mut other = ContactPoints::new();
        assert!(other.push(point(0)) && points == other);
        assert!(points.push(point(5)) && points != other);
        assert_eq!(numbers(&points), [0.0, 5.0]);
    }
}
