//! Polylines to stand on: the ground of a game seen from the side.

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
/// the next. Overlap with it, its separation from other shapes (the least of its segments' own) and the nearest points
/// are about that set and know no sides.
///
/// # Contacts without ghosts
/// A body that slides over a chain meets a surface, and not a row of segments: where segments meet in a straight line
/// or a hollow, no contact, no cast and no ray has a normal that no segment there has. The edge of a convex corner, or
/// a loose end, is met as the corner that it is.
///
/// Vertices that lie on one line up to the rounding of their coordinates make one straight [`Run`]: contact points name
/// it by its first segment (`Feature::Edge`), and corners by their vertex (`Feature::Vertex`), so that names stay as a
/// body slides.
///
/// # Sides
/// A chain has two sides, and pushes what touches it to the side that the centre of its bounding circle is on.
/// [`one_sided`](Self::one_sided) leaves one, on the *right* of the way from vertex to vertex:
///
/// - Contacts, casts and rays see a segment only from there, and motions pass through from behind.
/// - What comes through has contacts, and is pushed out to the front, as soon as its centre is there. A cast or an
///   impact with that straight run comes only once the two have been apart.
/// - So a closed chain that winds counter-clockwise is solid, as a polygon is; and ground drawn from right to left
///   looks up.
/// - A chain that leads straight back along itself is there a wall of no width, with a tip.
///
/// # Costs and limits
/// - A pair with a body costs what the segments near it cost, and the logarithm of their number.
/// - A collider with this shape is fixed, whatever is said.
/// - 16 to 17 bytes per vertex.
/// - Thin ground lets fast bodies through unless they are bullets or cast: where something has an inside, a
///   [`HalfPlane`](crate::HalfPlane) or compound stops them better.
///
/// ```
/// use asunder_geometry::{Chain, glam::{DVec2, Vec2}};
/// let hill = [(9.0, 0.0), (4.0, 0.0), (2.0, 1.5), (-3.0, 1.5), (-3.0, 1.5)].map(|(x, y)| Vec2::new(x, y));
/// let ground = Chain::open(hill)?.one_sided();
/// assert_eq!((ground.segment_count(), ground.dropped()), (3, 1));
/// assert!(ground.contains(DVec2::new(7.0, 0.0)) && !ground.contains(DVec2::new(7.0, -1.0)));
/// let island = Chain::closed([Vec2::ZERO, Vec2::X, Vec2::Y])?;
/// assert_eq!(island.segment(2).map(|segment| segment.ends()), Some([Vec2::Y, Vec2::ZERO]));
/// # Ok::<(), asunder_geometry::ChainError>(())
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
    /// A vertex less than 2e-6 m from the one before it is left out, and counted: see [`dropped`](Self::dropped).
    /// Segments, and so the `part` of what is met, are numbered by the vertices that are left.
    ///
    /// # Errors
    /// A vertex that is not finite or more than 1e6 m from the origin; fewer than two, or more than
    /// [`MAX_CHAIN_VERTICES`].
    pub fn open(vertices: impl IntoIterator<Item = Vec2>) -> Result<Self, ChainError> {
        Self::new(&mut vertices.into_iter(), false)
    }

    /// A polyline that leads from its last vertex back to its first, in metres.
    ///
    /// The first vertex need not be repeated: a last one that is the same is left out, and counted.
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

    /// The same chain, seen only from its front: the right of the way from vertex to vertex. Shares the data.
    #[must_use]
    pub fn one_sided(mut self) -> Self {
        self.is_one_sided = true;
        self
    }

    /// Whether contacts, casts and rays see its front alone.
    #[inline]
    pub const fn is_one_sided(&self) -> bool {
        self.is_one_sided
    }

    /// Whether the last vertex leads back to the first.
    #[inline]
    pub fn is_closed(&self) -> bool {
        self.data.is_closed
    }

    /// The vertices, in metres, those left out not among them.
    #[inline]
    pub fn vertices(&self) -> &[Vec2] {
        &self.data.vertices
    }

    /// How many of the vertices given were left out, since they all but repeated the one before them.
    #[inline]
    pub fn dropped(&self) -> usize {
        self.data.dropped
    }

    /// Number of segments.
    #[inline]
    pub fn segment_count(&self) -> usize {
        segment_count(self.data.vertices.len(), self.data.is_closed)
    }

    /// A segment by its number: it leads from the vertex of that number to the next. Nothing beyond the last.
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

    /// The centre that the bounding radius is about: the middle of its box.
    #[inline]
    pub fn center(&self) -> Vec2 {
        self.data.center
    }

    /// Bounding radius about [`Chain::center`], in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        self.data.outer_radius
    }

    /// Whether a local point, in metres, lies on a segment. Exact. Cost: the segments whose boxes hold it.
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

    /// The box around the posed chain, grown by `margin` metres and rounded outwards. Cost: about four times the
    /// logarithm of the number of vertices.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let furthest = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y]
            .map(|axis| self.furthest(pose.turn_back(axis)).unwrap_or(self.data.center.as_dvec2()));
        around2(furthest.into_iter(), pose, f64::from(margin))
    }

    /// The vertex furthest along a direction. Nothing for a direction that is not finite.
    pub(crate) fn furthest(&self, direction: DVec2) -> Option<DVec2> {
        let mut best: Option<(f64, DVec2)> = None;
        let reach = |bounds: &Aabb2| {
            let corner = Vec2::select(direction.cmpge(DVec2::ZERO), bounds.max, bounds.min);
            -direction.dot(corner.as_dvec2())
        };
        self.visit_nearest(f64::INFINITY, reach, |segment| {
            for end in self.ends(segment).into_iter().flatten().map(Vec2::as_dvec2) {
                let along = direction.dot(end);
                if best.is_none_or(|(known, _)| along > known) {
                    best = Some((along, end));
                }
            }
            best.map_or(f64::INFINITY, |(along, _)| -along)
        });
        best.map(|(_, vertex)| vertex)
    }

    /// Visits the segments whose boxes meet a box in the chain's own axes, in ascending order, until the visitor breaks
    /// off. Cost: those segments, and the logarithm of all.
    ///
    /// ```
    /// use asunder_geometry::{Aabb2, Chain, glam::Vec2};
    /// use core::ops::ControlFlow;
    /// let ground = Chain::open((0..1000).map(|x| Vec2::new(x as f32, 0.0)))?;
    /// let mut near = Vec::new();
    /// let at = Aabb2::new(Vec2::new(500.25, -1.0), Vec2::new(501.5, 1.0));
    /// assert!(ground.visit_near(&at, |segment| { near.push(segment); ControlFlow::Continue(()) }).is_continue());
    /// assert_eq!(near, [500, 501]);
    /// # Ok::<(), asunder_geometry::ChainError>(())
    /// ```
    pub fn visit_near(&self, bounds: &Aabb2, visit: impl FnMut(u32) -> ControlFlow<()>) -> ControlFlow<()> {
        self.visit_where(|other| bounds.overlaps(other), visit)
    }

    /// The same for any question about boxes: where the answer is no, nothing in the box is visited. If it is yes for a
    /// box, it must be yes for every box around that.
    pub fn visit_where(
        &self,
        meets: impl FnMut(&Aabb2) -> bool,
        visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.data.tree.visit_where(&|segment| self.ends(segment), meets, visit)
    }

    /// Visits segments where a bound on what a box holds is at most a limit, boxes of lesser bounds first. The visitor
    /// returns the limit for the rest. Cost: for a nearest point about the logarithm of the number of segments.
    ///
    /// The bound of a box must hold for all that is in it: no greater than what the visitor would find there. Where it
    /// is NaN, the box is visited.
    ///
    /// ```
    /// use asunder_geometry::{Chain, glam::Vec2};
    /// let ground = Chain::open((0..1000).map(|x| Vec2::new(x as f32, 0.0)))?;
    /// let (mut lowest, mut visited) = (f64::INFINITY, 0);
    /// let to_the_left_of = |bounds: &asunder_geometry::Aabb2| f64::from(bounds.min.x);
    /// ground.visit_nearest(f64::INFINITY, to_the_left_of, |segment| {
    ///     (lowest, visited) = (lowest.min(f64::from(segment)), visited + 1);
    ///     lowest
    /// });
    /// assert_eq!((lowest, visited), (0.0, 1));
    /// # Ok::<(), asunder_geometry::ChainError>(())
    /// ```
    pub fn visit_nearest(&self, limit: f64, bound: impl FnMut(&Aabb2) -> f64, visit: impl FnMut(u32) -> f64) {
        self.data.tree.visit_nearest(&|segment| self.ends(segment), limit, bound, visit);
    }

    /// An address that two chains have in common exactly when they share their data and have as many sides; only good
    /// while both live. It differs from run to run: look up by it, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        // Data is aligned to more than one byte.
        Arc::as_ptr(&self.data).addr() + usize::from(self.is_one_sided)
    }
}

impl PartialEq for Chain {
    /// Whether both have the same vertices and sides: what was left out does not count.
    fn eq(&self, other: &Self) -> bool {
        let alike = |a: &Data, b: &Data| (a.is_closed, &a.vertices) == (b.is_closed, &b.vertices);
        self.is_one_sided == other.is_one_sided
            && (Arc::ptr_eq(&self.data, &other.data) || alike(&self.data, &other.data))
    }
}

fn segment_count(vertices: usize, is_closed: bool) -> usize {
    if is_closed { vertices } else { vertices.saturating_sub(1) }
}

/// The vertices that are vertices, and how many others there were.
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
