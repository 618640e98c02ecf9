//! What the projection on one direction tells of two bodies of many parts.
//!
//! ```text
//! project a ball around each part of A and of B on the direction
//! stop if those separate the wholes by more than asked for, and by more than rounding
//! project each part that may reach furthest, and stop if that separates the wholes
//! else: pairs of parts that the direction separates are done with
//!       next frame: the direction reflected by the plane across b - a, a and b being the furthest points
//! ```
//! K. Chung and W. Wang, "Quick collision detection of polytopes in virtual environments", 1996: where a plane
//! separates two convex bodies, the reflected direction is nearer to one that does. The hulls of two compounds are such
//! bodies, and are never built: the furthest point of a hull is a part's. A direction is trusted only by its
//! projections, so a hint, even a stale or foreign one, is only a place to start. Each frame takes one step: a search
//! that fails goes on in the next, for a few frames.
//!
//! Two hammers that drift, each of 2, 4 and 8 parts, `cargo run --release -p asunder-benches --bin compounds`
//! (nanoseconds per pair without a hint and with, AMD EPYC, Zen 4, 2026-11-21):
//!
//! | apart, and | boxes | hulls of 32 |
//! |---|---|---|
//! | a plane separates them | 759, 577, 672 to 463, 436, 451 | 699, 651, 998 to 530, 643, 691 |
//! | none does | 1017, 1268 to 1059, 1265 (2 and 4 parts) | 1451, 1134 to 1456, 1136 |
//!
//! With many parts, projecting on the direction from middle to middle pays even without a hint: 8 parts each, apart,
//! 1386 to 860. Tried, and slower: four steps in the frame that a pair appears in, and two in every other (hooked
//! hammers of 4 hulls by half); a step in every frame, for ever (by 8 to 40 %).

use arrayvec::ArrayVec;
use core::ops::Add;

/// This many parts have a reach of their own; further ones count as reaching as far as any.
const PARTS: usize = 16;

/// Whether bodies have so many pairs of parts that a direction is worth its projections even if it does not separate
/// them as wholes.
pub(crate) fn is_many([parts_a, parts_b]: [usize; 2]) -> bool {
    parts_a * parts_b >= MANY
}

/// Between 16, with a loss of a seventh, and 64, with a gain of a tenth, both for hammers of boxes that touch.
const MANY: usize = 32;

/// How far a body and its parts reach along a direction, measured from its position.
pub(crate) struct Reaches<V> {
    each: ArrayVec<f64, PARTS>,
    most: f64,
    /// The furthest point, in the caller's axes.
    pub(crate) point: V,
    /// The greatest sum of lengths that enter the projection of a part: rounding is a share of it.
    summed: f64,
}

/// A part's bounding ball, projected on a direction.
pub(crate) struct Ball {
    /// How far the ball reaches.
    pub(crate) reach: f64,
    /// The sum of lengths that enter its projection.
    pub(crate) summed: f64,
}

impl<V: Copy + Add<Output = V>> Reaches<V> {
    /// From balls around the parts.
    pub(crate) fn of_balls(balls: impl Iterator<Item = Ball>, origin: V) -> Self {
        let mut reaches = Self { each: ArrayVec::new(), most: f64::NEG_INFINITY, point: origin, summed: 0.0 };
        for ball in balls {
            let _ = reaches.each.try_push(ball.reach);
            reaches.most = reaches.most.max(ball.reach);
            reaches.summed = reaches.summed.max(ball.summed);
        }
        reaches
    }

    /// Replaces balls by the parts themselves where those may reach furthest: `project` gives a part's reach and
    /// furthest point.
    pub(crate) fn refine(&mut self, parts: usize, mut project: impl FnMut(usize) -> (f64, V)) {
        self.most = f64::NEG_INFINITY;
        for part in 0..parts {
            let own = self.each.get_mut(part);
            if own.as_ref().is_some_and(|own| **own <= self.most) {
                continue;
            }
            let (reach, point) = project(part);
            if let Some(own) = own {
                *own = reach;
            }
            if reach > self.most {
                (self.most, self.point) = (reach, point);
            }
        }
    }

    fn of(&self, part: u32) -> f64 {
        self.each.get(part as usize).copied().unwrap_or(self.most)
    }
}

/// The projections of two bodies on a direction of unit length.
pub(crate) struct Shadow<V> {
    pub(crate) a: Reaches<V>,
    /// Along the opposite direction.
    pub(crate) b: Reaches<V>,
    /// From A's position to B's, along the direction.
    pub(crate) between: f64,
    /// The gap in metres that counts as separating two shapes.
    pub(crate) needed: f64,
}

impl<V: Copy + Add<Output = V>> Shadow<V> {
    /// The sum of lengths that enter a projection, without the offset between the positions.
    pub(crate) fn summed(&self) -> f64 {
        self.a.summed + self.b.summed
    }

    pub(crate) fn parts_wholes(&self) -> bool {
        self.between - self.a.most - self.b.most > self.needed
    }

    /// Whether it separates a part of A from all of B.
    pub(crate) fn parts_from_whole(&self, part_a: u32) -> bool {
        self.between - self.a.of(part_a) - self.b.most > self.needed
    }

    /// Whether it separates a part of A from one of B.
    pub(crate) fn parts(&self, part_a: u32, part_b: u32) -> bool {
        self.between - self.a.of(part_a) - self.b.of(part_b) > self.needed
    }
}
