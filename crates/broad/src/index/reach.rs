//! Queries by distance: which boxes a cast crosses, and which are near.

use super::cast::Cast;
use super::node::{Far, Node, Sides};
use super::queue::{Next, Queue};
use super::{Index, STACK, sides};
use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use core::ops::ControlFlow;

/// A box that a query found, and its distance.
///
/// Down to 1e-38 m the distance is a lower bound: what is in the box is that far away or further. It falls short by at
/// most 1e-6 of itself, within the range of f32.
///
/// ```
/// use asunder_broad::Found;
/// assert!(Found { distance: 1.0, number: 7 } < Found { distance: 2.0, number: 3 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Found {
    /// How far away, in metres, or in lengths of a cast's direction.
    pub distance: f64,
    /// The number of the box.
    pub number: u32,
}

/// A query by distance. Nodes and boxes take the same test, which is monotone, so that no box is nearer than the node
/// around it.
pub(super) trait Ask: Copy {
    fn ask<W: Width>(&self, width: W, node: &Node, limit: f32) -> Far;
    fn told(&self, within: f32) -> f64;
    fn within(&self, limit: f64) -> f32;
}

impl Ask for &Cast {
    #[inline(always)]
    fn ask<W: Width>(&self, width: W, node: &Node, limit: f32) -> Far {
        width.crossed(node, self, limit)
    }

    #[inline(always)]
    fn told(&self, within: f32) -> f64 {
        Cast::told(self, within)
    }

    #[inline(always)]
    fn within(&self, limit: f64) -> f32 {
        Cast::within(self, limit)
    }
}

/// The query for boxes near a box. Internal distances are squared.
#[derive(Clone, Copy, Debug)]
pub(super) struct To(pub(super) Sides);

/// Relative rounding error allowed for between corners and a distance: in its square, five roundings to f32 of at most
/// 2^-24 each.
const LOST: f64 = 1.0 / 4_194_304.0;

impl Ask for To {
    #[inline(always)]
    fn ask<W: Width>(&self, width: W, node: &Node, limit: f32) -> Far {
        width.near(node, &self.0, limit)
    }

    #[inline(always)]
    fn told(&self, within: f32) -> f64 {
        f64::from(within).sqrt() * (1.0 - LOST)
    }

    #[inline(always)]
    fn within(&self, limit: f64) -> f32 {
        let limit = limit * (1.0 + 2.0 * LOST);
        // Squares below that of 1e-19 m count as 0.
        if limit >= 0.0 { ((limit * limit) as f32).clamp(f32::MIN_POSITIVE, f32::MAX) } else { -1.0 }
    }
}

impl<B: Bounds> Index<B> {
    /// Replaces `into` by the boxes that are crossed at `limit` or earlier, in order of distance, then of number.
    ///
    /// No box that is crossed within 1e38 lengths is left out; one that is missed by no more than rounding (1e-6 of the
    /// distance) may be included.
    pub fn crossed(&self, cast: &Cast, limit: f64, into: &mut Vec<Found>) {
        into.clear();
        let _ = self.visit_crossed(cast, limit, |found| {
            into.push(found);
            ControlFlow::Continue(())
        });
        into.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance).then(a.number.cmp(&b.number)));
    }

    /// Hands every box that is crossed at `limit` or earlier to `visitor`, each once, in unspecified order, until it
    /// breaks off.
    pub fn visit_crossed(
        &self,
        cast: &Cast,
        limit: f64,
        visitor: impl FnMut(Found) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let limit = cast.within(limit);
        if self.nodes.is_empty() || limit < 0.0 {
            return ControlFlow::Continue(());
        }
        widest(Visit { nodes: &self.nodes, asked: cast, limit, visitor })
    }

    /// Hands boxes that are crossed to `visitor` in order of distance, then of number. It returns the limit from then
    /// on: the same, or the distance of what it found in the box; a negative number ends the query.
    ///
    /// ```
    /// use asunder_broad::{Index, Queue};
    /// use asunder_geometry::{Aabb3, Ray3, glam::Vec3};
    /// let mut index = Index::new();
    /// index.build(&[8.0, 2.0, 4.0].map(|x| Aabb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0))));
    /// let ray = Ray3::new([0.0, 0.5, 0.5], Vec3::X)?;
    /// let mut seen = vec![];
    /// // The shape in box 1 is missed; that in box 2 is hit at 4.5, which is before box 0.
    /// index.crossed_in_order(&ray.into(), 100.0, &mut Queue::new(), |found| {
    ///     seen.push(found.number);
    ///     if found.number == 2 { 4.5 } else { 100.0 }
    /// });
    /// assert_eq!(seen, [1, 2]);
    /// # Ok::<(), asunder_geometry::RayError>(())
    /// ```
    pub fn crossed_in_order(
        &self,
        cast: &Cast,
        limit: f64,
        queue: &mut Queue,
        visitor: impl FnMut(Found) -> f64,
    ) {
        let nodes = &self.nodes;
        widest(InOrder { nodes, asked: cast, limit: (limit, false), queue, visitor });
    }

    /// Replaces `into` by the boxes nearest to a box, at most `count`, in order of distance, then of number. A
    /// point is a flat box.
    ///
    /// Distances below 1e-19 m count as 0, and none beyond 1.8e19 m is reported.
    ///
    /// ```
    /// use asunder_broad::{Index, Queue};
    /// use asunder_geometry::{Aabb2, glam::Vec2};
    /// let boxes = [3.0, 1.0, 2.0].map(|x| Aabb2::new(Vec2::new(x, 0.0), Vec2::new(x + 0.5, 1.0)));
    /// let mut index = Index::new();
    /// index.build(&boxes);
    /// let mut nearest = vec![];
    /// index.nearest(&Aabb2::new(Vec2::ZERO, Vec2::ZERO), 2, &mut Queue::new(), &mut nearest);
    /// assert_eq!([nearest[0].number, nearest[1].number], [1, 2]);
    /// ```
    pub fn nearest(&self, to: &B, count: usize, queue: &mut Queue, into: &mut Vec<Found>) {
        into.clear();
        if count == 0 {
            return;
        }
        self.nearest_of(to, (f64::INFINITY, count == 1), queue, |found| {
            into.push(found);
            if into.len() < count { f64::INFINITY } else { -1.0 }
        });
    }

    /// Hands boxes no further from a box than `limit` to `visitor` in order of distance, then of number. It returns the
    /// limit from then on; a negative number ends the query.
    ///
    /// ```
    /// use asunder_broad::{Index, Queue};
    /// use asunder_geometry::{Aabb2, glam::Vec2};
    /// let boxes = [3.0, 1.0, 2.0].map(|x| Aabb2::new(Vec2::new(x, 0.0), Vec2::new(x + 0.5, 1.0)));
    /// let mut index = Index::new();
    /// index.build(&boxes);
    /// let (origin, mut seen) = (Aabb2::new(Vec2::ZERO, Vec2::ZERO), vec![]);
    /// // The shape in the first box turns out to be 2.5 m away.
    /// index.nearest_in_order(&origin, 100.0, &mut Queue::new(), |found| {
    ///     seen.push(found.number);
    ///     2.5
    /// });
    /// assert_eq!(seen, [1, 2]);
    /// ```
    pub fn nearest_in_order(&self, to: &B, limit: f64, queue: &mut Queue, visitor: impl FnMut(Found) -> f64) {
        self.nearest_of(to, (limit, false), queue, visitor);
    }

    #[inline]
    fn nearest_of(&self, to: &B, limit: (f64, bool), queue: &mut Queue, visitor: impl FnMut(Found) -> f64) {
        if !to.is_valid() {
            return;
        }
        widest(InOrder { nodes: &self.nodes, asked: To(sides(to)), limit, queue, visitor });
    }
}

/// A query that visits boxes in no order.
struct Visit<'a, A, F> {
    nodes: &'a [Node],
    asked: A,
    limit: f32,
    visitor: F,
}

impl<A: Ask, F: FnMut(Found) -> ControlFlow<()>> Kernel for Visit<'_, A, F> {
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> ControlFlow<()> {
        let Self { nodes, asked, limit, mut visitor } = self;
        let mut stack = [0_u32; STACK];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let node = &nodes[stack[waiting] as usize];
            let Far { mask, distances } = asked.ask(width, node, limit);
            let (inner, boxes) = node.parts(mask);
            for (lane, number) in boxes {
                visitor(Found { distance: asked.told(distances[lane]), number })?;
            }
            for (_, child) in inner {
                stack[waiting] = child;
                waiting += 1;
            }
        }
        ControlFlow::Continue(())
    }
}

/// A best-first query: whatever is nearest is next, be it a node to visit or a box to hand over (Hjaltason and Samet,
/// "Distance browsing in spatial databases", 1999). At equal distances nodes come first, as they may hold a box with a
/// lesser number.
///
/// Two shortcuts: the nearest child of a node bypasses the queue if nothing there is nearer; and if a single box is
/// wanted, nothing is queued that is further than a box already seen.
struct InOrder<'a, A, F> {
    nodes: &'a [Node],
    asked: A,
    /// How far to look, and whether a single box is wanted.
    limit: (f64, bool),
    queue: &'a mut Queue,
    visitor: F,
}

impl<A: Ask, F: FnMut(Found) -> f64> Kernel for InOrder<'_, A, F> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, width: W) {
        let Self { nodes, asked, limit: (limit, is_one_wanted), queue, mut visitor } = self;
        let mut limit = asked.within(limit);
        queue.clear();
        let mut next = if nodes.is_empty() { None } else { Some(Next::node(0.0, 0)) };
        while let Some(one) = next.filter(|next| next.distance() <= limit) {
            if let Some(number) = one.boxed() {
                // The limit never grows: what is beyond it has been dropped already.
                let found = Found { distance: asked.told(one.distance()), number };
                let wanted = asked.within(visitor(found));
                limit = if wanted < limit { wanted } else { limit };
                next = queue.pop();
                continue;
            }
            let node = &nodes[one.number() as usize];
            let Far { mask, distances } = asked.ask(width, node, limit);
            let (inner, boxes) = node.parts(mask);
            let mut nearest = None;
            let mut see = |seen: Next| match &mut nearest {
                None => nearest = Some(seen),
                Some(nearest) => {
                    queue.push(seen.max(*nearest));
                    *nearest = seen.min(*nearest);
                }
            };
            for (lane, number) in boxes {
                see(Next::boxed_at(distances[lane], number));
                if is_one_wanted && distances[lane] < limit {
                    limit = distances[lane];
                }
            }
            for (lane, child) in inner {
                if distances[lane] <= limit {
                    see(Next::node(distances[lane], child));
                }
            }
            next = match (nearest, queue.peek()) {
                (Some(nearest), Some(waiting)) if waiting < nearest => {
                    queue.push(nearest);
                    queue.pop()
                }
                (None, _) => queue.pop(),
                (nearest, _) => nearest,
            };
        }
    }
}
