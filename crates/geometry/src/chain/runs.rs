//! Straight runs: segments that lie on one line up to rounding.
//!
//! ```text
//! from the first vertex of a run, the lines that pass a later vertex within its rounding form a wedge
//! intersect the wedges of all vertices between
//! continue the run while the next vertex lies in that wedge, and further on than the last
//! ```
//! Zhao and Saalfeld, "Linear-time sleeve-fitting polyline simplification algorithms" (1997). If a line is cut into
//! segments, its vertices are off the line by the f32 rounding of their coordinates. That turns the normal of a segment
//! a thousandth of its coordinates long by 0.005 degrees, and of shorter ones by more, which contacts must ignore. A
//! limit on angles cannot tell such bends from real ones; the size of the rounding can.

use super::Chain;
use super::segment_count;
use crate::segment::Segment2;
use crate::tolerance::STRAIGHT;
use glam::{DVec2, Vec2};

/// Segments of a chain that lie on one line up to the rounding of their vertices, and act as one segment in contacts.
///
/// ```
/// use asunder::{Chain, glam::Vec2};
/// let step = [(3.0, 0.0), (2.0, 0.0), (0.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
/// let chain = Chain::open(step)?;
/// let run = chain.run_of(1).ok_or("there are three segments")?;
/// assert_eq!((run.first(), run.vertices(), run.unevenness()), (0, [0, 2], 0.0));
/// assert_eq!(chain.chord(&run).map(|chord| chord.ends()), Some([Vec2::new(3.0, 0.0), Vec2::ZERO]));
/// assert_eq!(chain.run_after(&run).map(|next| next.first()), Some(2));
/// assert_eq!(chain.run_before(&run), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Its place among the runs.
    place: usize,
    first: u32,
    vertices: [u32; 2],
    unevenness: f64,
}

impl Run {
    /// Its first segment along the chain, which identifies the run.
    #[inline]
    pub const fn first(&self) -> u32 {
        self.first
    }

    /// Its first and its last vertex.
    #[inline]
    pub const fn vertices(&self) -> [u32; 2] {
        self.vertices
    }

    /// The furthest that any of its vertices may lie off the line from its first to its last, in metres. Zero for a
    /// single segment.
    #[inline]
    pub const fn unevenness(&self) -> f64 {
        self.unevenness
    }
}

impl Chain {
    /// The straight run that a segment belongs to; `None` beyond the last segment. Cost: logarithmic in the number of
    /// runs.
    pub fn run_of(&self, segment: u32) -> Option<Run> {
        if segment as usize >= self.segment_count() {
            return None;
        }
        let runs = &self.data.runs;
        let after = runs.partition_point(|&first| first <= segment);
        // In a closed chain, the last run may continue at the beginning.
        self.run_at(if after == 0 { runs.len() - 1 } else { after - 1 })
    }

    /// The run before it, if the chain does not begin with it.
    pub fn run_before(&self, run: &Run) -> Option<Run> {
        match run.place.checked_sub(1) {
            Some(place) => self.run_at(place),
            None if self.data.is_closed => self.run_at(self.data.runs.len() - 1),
            None => None,
        }
    }

    /// The run after it, if the chain does not end with it.
    pub fn run_after(&self, run: &Run) -> Option<Run> {
        let next = self.run_at(run.place + 1);
        if self.data.is_closed { next.or_else(|| self.run_at(0)) } else { next }
    }

    /// The segment from a run's first vertex to its last.
    pub fn chord(&self, run: &Run) -> Option<Segment2> {
        let [from, to] = run.vertices.map(|vertex| self.data.vertices.get(vertex as usize).copied());
        Some(Segment2::between([from?, to?]))
    }

    fn run_at(&self, place: usize) -> Option<Run> {
        let (runs, vertices) = (&self.data.runs, &self.data.vertices);
        let first = *runs.get(place)?;
        let end = match runs.get(place + 1) {
            Some(&next) => next,
            None if self.data.is_closed => *runs.first()?,
            None => vertices.len() as u32 - 1,
        };
        let is_one = first + 1 == end || (end == 0 && first as usize + 1 == vertices.len());
        let unevenness = match (vertices.get(first as usize), vertices.get(end as usize)) {
            (Some(from), Some(to)) if !is_one => corridor([*from, *to], (*to - *from).as_dvec2()),
            _ => 0.0,
        };
        Some(Run { place, first, vertices: [first, end], unevenness })
    }
}

/// First segments of all runs, ascending.
pub(super) fn runs(vertices: &[Vec2], is_closed: bool) -> Vec<u32> {
    let segments = segment_count(vertices.len(), is_closed);
    // In a closed chain, a run may continue past the beginning, so start where the first one ends.
    let start = if is_closed { run_from(vertices, 0, segments) % segments.max(1) } else { 0 };
    let mut runs = Vec::new();
    let (mut first, end) = (start, start + segments);
    while first < end {
        runs.push((first % segments) as u32);
        first += run_from(vertices, first, end - first);
    }
    runs.sort_unstable();
    runs
}

/// The number of segments in the run that begins at a vertex, limited to `most`.
fn run_from(vertices: &[Vec2], start: usize, most: usize) -> usize {
    let vertex = |i: usize| vertices.get((start + i) % vertices.len()).copied().unwrap_or_default();
    let from = vertex(0);
    let mut wedge: Option<[DVec2; 2]> = None;
    for count in 1..most {
        let [inner, next] = [vertex(count), vertex(count + 1)];
        let (along, ahead) = (inner.as_dvec2() - from.as_dvec2(), next.as_dvec2() - from.as_dvec2());
        if let Some([rightmost, leftmost]) = seen_around(along, rounding([from, inner])) {
            wedge = Some(match wedge {
                None => [rightmost, leftmost],
                Some([right, left]) => [
                    if right.perp_dot(rightmost) > 0.0 { rightmost } else { right },
                    if left.perp_dot(leftmost) < 0.0 { leftmost } else { left },
                ],
            });
        }
        let is_within =
            |[right, left]: [DVec2; 2]| right.perp_dot(ahead) >= 0.0 && left.perp_dot(ahead) <= 0.0;
        let goes_on = (ahead - along).dot(ahead) > 0.0 && (ahead - along).dot(along) > 0.0;
        if !goes_on || !wedge.is_none_or(is_within) {
            return count;
        }
    }
    most
}

/// How far a vertex between two points may lie off their line, given the rounding of all coordinates.
fn corridor(ends: [Vec2; 2], along: DVec2) -> f64 {
    let normal = along.perp().abs() / along.length().max(f64::MIN_POSITIVE);
    normal.dot(rounding(ends))
}

/// The rounding of a vertex between two others on each axis.
fn rounding([one, other]: [Vec2; 2]) -> DVec2 {
    one.abs().max(other.abs()).as_dvec2() * STRAIGHT
}

/// The rightmost and the leftmost direction from the origin to a box, given by its middle and half extents; `None` from
/// inside. A line passes the middle within its corridor, whatever its direction, exactly if it meets the box.
fn seen_around(middle: DVec2, half: DVec2) -> Option<[DVec2; 2]> {
    if middle.abs().cmple(half).all() {
        return None;
    }
    let corners =
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| middle + half * DVec2::new(x, y));
    let furthest = |is_further: fn(f64) -> bool| {
        corners.into_iter().reduce(|best, next| if is_further(best.perp_dot(next)) { next } else { best })
    };
    Some([furthest(|turn| turn < 0.0)?, furthest(|turn| turn > 0.0)?])
}
