//! Chains: polylines as ground, for games seen from the side.

mod error;
mod runs;
#[cfg(test)]
mod tests;
mod tree;

pub use error::ChainError;
pub use runs::Run;

use crate::aabb::Aabb2;
use crate::outward::{around2, round_up};
use crate::pose2::Pose2;
use crate::segment::Segment2;
use crate::tolerance::{MAX_CHAIN_VERTICES, MAX_RADIUS, MIN_RADIUS};
use core::ops::ControlFlow;
use glam::{DVec2, Vec2};
use runs::runs;
use std::sync::Arc;
use tree::Tree;

/// A polyline, open or closed: ground in the plane, of up to 2 million vertices. Clones share the data.
///
#[doc = include_str!("../../doc/chain.svg")]
///
/// It is the set of its segments' points, without thickness and without an inside. Segment `i` leads from vertex `i` to
/// the next. Overlap with it, its separation from other shapes (the least of its segments') and nearest points refer to
/// that set, without sides.
///
/// # Contacts without ghosts
/// A body that slides over a chain meets a surface, and not a row of segments: where segments meet in a straight line
/// or a hollow, every contact, cast and ray has the normal of a segment there. A convex corner or a loose end acts as a
/// corner.
///
/// Vertices that lie on one line up to the rounding of their coordinates make one straight [`Run`]. Contact points
/// identify it by its first segment (`Feature::Edge`), and corners by their vertex (`Feature::Vertex`), so that ids
/// stay the same as a body slides.
///
/// # Sides
/// A chain has two sides, and pushes a touching body to the side on which the centre of the body's bounding circle
/// lies. [`one_sided`](Self::one_sided) leaves one side solid, on the *right* of the direction from vertex to vertex:
///
/// - Contacts, casts and rays meet a segment only from there; motions pass through from behind.
/// - A body that comes through has contacts, and is pushed out to the front, as soon as its centre is there. Casts and
///   impacts hit that straight run only once the two have been apart.
/// - So a closed chain that winds counter-clockwise is solid from outside, like a polygon, and ground drawn from right
///   to left faces up.
/// - Where a chain leads straight back along itself, it is a wall without thickness that ends in a tip.
///
/// # Costs and limits
/// - The cost of a pair with a body is that of the segments near it, plus the logarithm of the number of all.
/// - A collider with this shape is always fixed.
/// - 16 to 17 bytes per vertex.
/// - Fast bodies pass through thin ground unless they are bullets or cast: for ground with an inside, a
///   [`HalfPlane`](crate::HalfPlane) or a compound stops them better.
///
/// ```
/// use asunder::{Chain, glam::{DVec2, Vec2}};
/// let hill = [(9.0, 0.0), (4.0, 0.0), (2.0, 1.5), (-3.0, 1.5), (-3.0, 1.5)].map(|(x, y)| Vec2::new(x, y));
/// let ground = Chain::open(hill)?.one_sided();
/// assert_eq!((ground.segment_count(), ground.dropped()), (3, 1));
/// assert!(ground.contains(DVec2::new(7.0, 0.0)) && !ground.contains(DVec2::new(7.0, -1.0)));
/// let island = Chain::closed([Vec2::ZERO, Vec2::X, Vec2::Y])?;
/// assert_eq!(island.segment(2).map(|segment| segment.ends()), Some([Vec2::Y, Vec2::ZERO]));
/// # Ok::<(), asunder::ChainError>(())
/// ```
#[derive(Clone)]
pub struct Chain {
    data: Arc<Data>,
    is_one_sided: bool,
}

struct Data {
    vertices: Box<[Vec2]>,
    is_closed: bool,
    dropped: usize,
    center: Vec2,
    outer_radius: f32,
    tree: Tree,
    /// First segments of the straight runs, ascending.
    runs: Box<[u32]>,
}

impl Chain {
    /// A polyline from its first vertex to its last, in metres.
    ///
    /// A vertex less than 2e-6 m from the one before it is dropped, and counted: see [`dropped`](Self::dropped).
    /// Segments, and so the `part` in contacts and hits, are numbered by the vertices that are kept.
    ///
    /// # Errors
    /// A vertex that is not finite or more than 1e6 m from the origin; fewer than two, or more than
    /// [`MAX_CHAIN_VERTICES`].
    pub fn open(vertices: impl IntoIterator<Item = Vec2>) -> Result<Self, ChainError> {
        Self::new(&mut vertices.into_iter(), false)
    }

    /// A polyline that leads from its last vertex back to its first, in metres.
    ///
    /// The first vertex need not be repeated: a last one that equals it, or nearly, is dropped, and counted.
    ///
    /// # Errors
    /// As [`Chain::open`], and fewer than three vertices.
    pub fn closed(vertices: impl IntoIterator<Item = Vec2>) -> Result<Self, ChainError> {
        Self::new(&mut vertices.into_iter(), true)
    }

    fn new(given: &mut dyn Iterator<Item = Vec2>, is_closed: bool) -> Result<Self, ChainError> {
        let (vertices, dropped) = kept(given, is_closed)?;
        let (low, high) = (
            vertices.iter().fold(Vec2::INFINITY, |low, &vertex| low.min(vertex)).as_dvec2(),
            vertices.iter().fold(Vec2::NEG_INFINITY, |high, &vertex| high.max(vertex)).as_dvec2(),
        );
        let center = ((low + high) * 0.5).as_vec2();
        let reach = |vertex: &Vec2| (vertex.as_dvec2() - center.as_dvec2()).length();
        let outer = vertices.iter().map(reach).fold(0.0, f64::max);
        let data = Data {
            tree: Tree::new(&vertices, is_closed),
            runs: runs(&vertices, is_closed).into(),
            vertices: vertices.into(),
            is_closed,
            dropped,
            center,
            outer_radius: round_up(outer * (1.0 + 8.0 * f64::EPSILON)),
        };
        Ok(Self { data: Arc::new(data), is_one_sided: false })
    }

    /// The same chain, solid only from its front: the right of the direction from vertex to vertex. Shares the data.
    #[must_use]
    pub fn one_sided(mut self) -> Self {
        self.is_one_sided = true;
        self
    }

    /// Whether contacts, casts and rays meet only its front.
    #[inline]
    pub const fn is_one_sided(&self) -> bool {
        self.is_one_sided
    }

    /// Whether a last segment leads back to the first vertex.
    #[inline]
    pub fn is_closed(&self) -> bool {
        self.data.is_closed
    }

    /// The vertices, in metres, without dropped ones.
    #[inline]
    pub fn vertices(&self) -> &[Vec2] {
        &self.data.vertices
    }

    /// How many of the given vertices were dropped because they nearly repeated the one before.
    #[inline]
    pub fn dropped(&self) -> usize {
        self.data.dropped
    }

    /// Number of segments.
    #[inline]
    pub fn segment_count(&self) -> usize {
        segment_count(self.data.vertices.len(), self.data.is_closed)
    }

    /// A segment by its number, from the vertex of that number to the next; `None` beyond the last.
    #[inline]
    pub fn segment(&self, segment: u32) -> Option<Segment2> {
        self.ends(segment).map(Segment2::between)
    }

    fn ends(&self, segment: u32) -> Option<[Vec2; 2]> {
        let vertices = &self.data.vertices;
        let first = *vertices.get(segment as usize)?;
        let next =
            vertices.get(segment as usize + 1).or(if self.data.is_closed { vertices.first() } else { None });
        Some([first, *next?])
    }

    /// The centre of the bounding radius: the middle of its box.
    #[inline]
    pub fn center(&self) -> Vec2 {
        self.data.center
    }

    /// Bounding radius about [`Chain::center`], in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        self.data.outer_radius
    }

    /// Whether a local point, in metres, lies on a segment. Exact. Cost: linear in the segments whose boxes contain it.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        let point = point.into();
        let holds = |bounds: &Aabb2| {
            bounds.min.as_dvec2().cmple(point).all() && point.cmple(bounds.max.as_dvec2()).all()
        };
        let visit = |segment| {
            let found = self.segment(segment).is_some_and(|segment| segment.contains(point));
            if found { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        self.visit_where(holds, visit).is_break()
    }

    /// The box around the posed chain, grown by `margin` metres and rounded outwards. Cost: constant for a chain that
    /// is not turned, or turned by right angles, as most levels are; else about four times the logarithm of the number
    /// of vertices.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let is_square = pose.rotation().cos() * pose.rotation().sin() == 0.0;
        if let (Some(whole), true) = (self.data.tree.whole(), is_square) {
            // Every coordinate of a turned vertex is one of the vertex, up to its sign.
            let corners = [whole.min, whole.max].map(|corner| corner.as_dvec2());
            return around2(corners.into_iter(), pose, f64::from(margin));
        }
        let furthest = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y]
            .map(|axis| self.furthest(pose.turn_back(axis)).unwrap_or(self.data.center.as_dvec2()));
        around2(furthest.into_iter(), pose, f64::from(margin))
    }

    /// The vertex furthest along a direction; `None` for a direction that is not finite.
    pub(crate) fn furthest(&self, direction: DVec2) -> Option<DVec2> {
        self.furthest_after(direction).0
    }

    /// The same, and how many segments were looked at.
    fn furthest_after(&self, direction: DVec2) -> (Option<DVec2>, usize) {
        let mut best: Option<(f64, DVec2)> = None;
        let mut count = 0;
        let reach = |bounds: &Aabb2| {
            let corner = Vec2::select(direction.cmpge(DVec2::ZERO), bounds.max, bounds.min);
            -direction.dot(corner.as_dvec2())
        };
        self.visit_nearest(f64::INFINITY, reach, |segment| {
            count += 1;
            for end in self.ends(segment).into_iter().flatten().map(Vec2::as_dvec2) {
                let along = direction.dot(end);
                if best.is_none_or(|(known, _)| along > known) {
                    best = Some((along, end));
                }
            }
            // Others that are as far do not matter: of a level floor, that would be all of them.
            best.map_or(f64::INFINITY, |(along, _)| (-along).next_down())
        });
        (best.map(|(_, vertex)| vertex), count)
    }

    /// Visits the segments whose boxes overlap a box in the chain's own axes, in ascending order, until the visitor
    /// breaks off. Cost: linear in those segments, logarithmic in all.
    ///
    /// ```
    /// use asunder::{Aabb2, Chain, glam::Vec2};
    /// use core::ops::ControlFlow;
    /// let ground = Chain::open((0..1000).map(|x| Vec2::new(x as f32, 0.0)))?;
    /// let mut near = Vec::new();
    /// let at = Aabb2::new(Vec2::new(500.25, -1.0), Vec2::new(501.5, 1.0));
    /// assert!(ground.visit_near(&at, |segment| { near.push(segment); ControlFlow::Continue(()) }).is_continue());
    /// assert_eq!(near, [500, 501]);
    /// # Ok::<(), asunder::ChainError>(())
    /// ```
    pub fn visit_near(&self, bounds: &Aabb2, visit: impl FnMut(u32) -> ControlFlow<()>) -> ControlFlow<()> {
        self.visit_where(|other| bounds.overlaps(other), visit)
    }

    /// The same with any predicate on boxes: if it is false for a box, nothing in it is visited. If it is true for a
    /// box, it must be true for every box around that.
    pub fn visit_where(
        &self,
        meets: impl FnMut(&Aabb2) -> bool,
        visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.data.tree.visit_where(&|segment| self.ends(segment), meets, visit)
    }

    /// Branch and bound: visits segments in boxes whose lower bound is at most a limit, those with lesser bounds first.
    /// The visitor returns the limit for the rest. Cost: for a nearest point about the logarithm of the number of
    /// segments.
    ///
    /// The bound of a box must not exceed any value that the visitor finds in it. If it is NaN, the box is visited.
    ///
    /// ```
    /// use asunder::{Chain, glam::Vec2};
    /// let ground = Chain::open((0..1000).map(|x| Vec2::new(x as f32, 0.0)))?;
    /// let (mut lowest, mut visited) = (f64::INFINITY, 0);
    /// let to_the_left_of = |bounds: &asunder::Aabb2| f64::from(bounds.min.x);
    /// ground.visit_nearest(f64::INFINITY, to_the_left_of, |segment| {
    ///     (lowest, visited) = (lowest.min(f64::from(segment)), visited + 1);
    ///     lowest
    /// });
    /// assert_eq!((lowest, visited), (0.0, 1));
    /// # Ok::<(), asunder::ChainError>(())
    /// ```
    pub fn visit_nearest(&self, limit: f64, bound: impl FnMut(&Aabb2) -> f64, visit: impl FnMut(u32) -> f64) {
        self.data.tree.visit_nearest(&|segment| self.ends(segment), limit, bound, visit);
    }

    /// An address that two chains have in common exactly when they share their data and both are one-sided or both
    /// two-sided; valid only while both live. It differs from run to run: use it for look-ups, and let no output depend
    /// on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        // The address is even, since data are aligned to more than one byte.
        Arc::as_ptr(&self.data).addr() + usize::from(self.is_one_sided)
    }
}

impl PartialEq for Chain {
    /// Equal vertices and sides; dropped vertices do not count.
    fn eq(&self, other: &Self) -> bool {
        let alike = |a: &Data, b: &Data| (a.is_closed, &a.vertices) == (b.is_closed, &b.vertices);
        self.is_one_sided == other.is_one_sided
            && (Arc::ptr_eq(&self.data, &other.data) || alike(&self.data, &other.data))
    }
}

fn segment_count(vertices: usize, is_closed: bool) -> usize {
    if is_closed { vertices } else { vertices.saturating_sub(1) }
}

/// The vertices without near repetitions, and how many were dropped.
fn kept(given: &mut dyn Iterator<Item = Vec2>, is_closed: bool) -> Result<(Vec<Vec2>, usize), ChainError> {
    let mut vertices: Vec<Vec2> = Vec::with_capacity(given.size_hint().0.min(MAX_CHAIN_VERTICES));
    let mut dropped = 0;
    let repeats = |one: Vec2, other: Vec2| Segment2::between([one, other]).outer_radius() < MIN_RADIUS;
    for (index, vertex) in given.enumerate() {
        if !vertex.is_finite() {
            return Err(ChainError::NotFinite { index });
        }
        if vertex.as_dvec2().length() > f64::from(MAX_RADIUS) {
            return Err(ChainError::TooLarge { index });
        }
        if vertices.last().is_some_and(|&last| repeats(last, vertex)) {
            dropped += 1;
            continue;
        }
        if vertices.len() == MAX_CHAIN_VERTICES {
            return Err(ChainError::TooMany { at_least: MAX_CHAIN_VERTICES + 1 });
        }
        vertices.push(vertex);
    }
    while let (true, [first, _, .., last]) = (is_closed, vertices.as_slice())
        && repeats(*first, *last)
    {
        vertices.pop();
        dropped += 1;
    }
    let needed = if is_closed { 3 } else { 2 };
    if vertices.len() < needed {
        return Err(ChainError::TooFew { count: vertices.len(), needed });
    }
    Ok((vertices, dropped))
}
