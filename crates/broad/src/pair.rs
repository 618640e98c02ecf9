//! `PairId`, the numbers of two boxes that overlap: the element of every sweep's list.

/// The numbers of two boxes that overlap, the smaller first. Ordered by `a`, then by `b`.
///
/// ```
/// use asunder_broad::PairId;
/// assert_eq!(PairId::new(7, 3), PairId { a: 3, b: 7 });
/// assert!(PairId::new(1, 9) < PairId::new(2, 3));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PairId {
    /// The smaller number.
    pub a: u32,
    /// The larger number.
    pub b: u32,
}

impl PairId {
    /// The pair of two different numbers, in either order.
    #[inline]
    pub const fn new(one: u32, other: u32) -> Self {
        if one < other { Self { a: one, b: other } } else { Self { a: other, b: one } }
    }
}

/// The pair list would have been longer than the caller allowed. No list was made.
///
/// ```
/// use asunder_broad::{Sweep, TooManyPairs};
/// use asunder_geometry::{Aabb3, glam::Vec3};
/// let boxes = [Aabb3::new(Vec3::ZERO, Vec3::ONE); 100];
/// let mut pairs = Vec::new();
/// assert_eq!(Sweep::new().pairs(&boxes, |_, _| true, 1000, &mut pairs), Err(TooManyPairs { limit: 1000 }));
/// assert!(pairs.is_empty());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyPairs {
    /// What the caller allowed.
    pub limit: usize,
}

impl core::fmt::Display for TooManyPairs {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "more than {} pairs of boxes overlap: raise the limit, or use the visitor form", self.limit)
    }
}

impl core::error::Error for TooManyPairs {}
