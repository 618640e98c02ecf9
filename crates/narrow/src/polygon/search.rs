//! The best axis of two polygons of many edges, by a search over directions.
//!
//! ```text
//! D = the vertices of A less the vertices of B; its outline merges both shapes' edges, in order of their normals
//! h(n) = how far D reaches along n = minus the separation along n
//! take two opposite directions; between them, both ways round, all edges of D are in two arcs
//! take an arc, from corner p at direction n_p to corner q at direction n_q
//!   every direction between has h(n) >= max(n.p, n.q) >= min(h(n_p), the chord's distance from the origin, h(n_q))
//!   if that is above the best so far by more than the band: no edge of the arc matters
//!   few edges: evaluate each
//!   else split the arc at the support point of the chord's normal
//! ```
//! The step is that of the expanding polytope (van den Bergen, "Proximity queries and penetration depth computation on
//! 3D game objects", 2001), without its queue, its iteration limit and its tolerance: whatever is left out is proved to
//! be worse by the corners found, for every direction and not only for edges. A gap shows as h(n) < 0 and ends the
//! search, which then is the search for a separating direction of Chung and Wang (1996).
//!
//! What keeps it cheap:
//! 1. A support is found by halving (`Outline::climb`), within the edges of the arc: 4096 edges take 12 steps at
//!    first, then ever fewer. All splits of a pair of circles about one centre, where nothing can be left out, add
//!    up to a linear number of steps.
//! 2. The direction from A's centre to B's is a good first one, last frame's axis a better one.
//! 3. Bounds are compared as squares; a root is taken only for a new best.
//! 4. The distance iteration starts its searches at its last corner: 2340 ns to 2100 for polygons of 64 vertices in a
//!    gap, 6.25 us to 5.9 for 4096.
//! 5. When an axis is projected, the search starts at the edge's own end, and beside a gap at the vertex that faces it:
//!    2100 ns to 1900, and 5.9 us to 4.55.
//!
//! How it grows, in ns (AMD EPYC, Zen 4, 2026-11-21, a busy machine, the lower of two runs; rows `grown*` of
//! `compare -- narrow`, of pairs that circles do not decide; `apart` and `light` lie within 1e-2 of size of touching,
//! `deep` on one centre, where every edge is as good):
//!
//! | vertices | 8 | 16 | 32 | 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 |
//! |---|---|---|---|---|---|---|---|---|---|---|
//! | apart, boolean | 109 | 183 | 93 | 91 | 98 | 109 | 108 | 106 | 145 | 203 |
//! | light, boolean | 110 | 199 | 281 | 377 | 486 | 673 | 775 | 901 | 1019 | 1144 |
//! | light, manifold | 160 | 304 | 628 | 818 | 1032 | 1252 | 1393 | 1729 | 1980 | 2400 |
//! | apart, distance | 290 | 428 | 1706 | 1947 | 2221 | 2554 | 2890 | 3782 | 4364 | 4754 |
//! | deep, separation | 164 | 293 | 2281 | 4070 | 7476 | 13700 | 26000 | 50400 | 93500 | 151000 |
//!
//! Up to 16 vertices, all edges are tested side by side instead (`few`).
//!
//! Error: an arc that was left out has no axis within the band of the best, except for the rounding of two projections,
//! which is less than the band. An edge's own evaluation is as in `few`, plus a searched support: within two
//! projections' rounding, which include what a search may lose.

use super::outline::Outline;
use super::sat::{Axes, Axis, AxisOf, Named, Outcome, Sides, Wanted, axis, doubt, hint_of_direction};
use crate::counted::count_step;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;

/// An arc of at most this many edges has each of them evaluated.
const LEAF: usize = 3;

/// Capacity for waiting arcs: twice the bits of the greatest edge count. An arc that finds no room is evaluated edge by
/// edge.
const WAITING: usize = 32;

/// Finds the best axes. `hint` is what the hint refers to.
pub(super) fn separating_axes(a: &Outline, b: &Outline, hint: Option<Named>, wanted: &Wanted) -> Outcome {
    let doubt = doubt(wanted.precision);
    let mut search = Search::new(a, b, wanted.limit, doubt);
    search.band = wanted.band;
    let stop = match hint {
        Some(Named::Edge(of)) => {
            let axis = axis(a, b, of, None);
            if axis.separation > wanted.limit {
                return Outcome::Beyond(axis.separation, wanted.hint);
            }
            search.run(axis.normal)
        }
        Some(Named::Direction(direction)) => search.run(direction),
        None => search.run(wanted.towards_b.try_normalize().unwrap_or(DVec2::X)),
    };
    match stop {
        Some((separation, direction)) if separation > wanted.limit => {
            // A hinted direction that still separates them is kept as it is, and not rounded once more.
            let is_kept = |hint: Named| match hint {
                Named::Direction(hinted) => {
                    (hinted - direction).length_squared() < f64::EPSILON * f64::EPSILON * 64.0
                }
                Named::Edge(_) => false,
            };
            let hint = if hint.is_some_and(is_kept) { wanted.hint } else { hint_of_direction(direction) };
            Outcome::Beyond(separation, hint)
        }
        Some((separation, direction)) => Outcome::Gap(separation, direction),
        None => Outcome::Within(search.axes(hint.and_then(Named::edge), doubt)),
    }
}

/// Whether the axes show the two shapes apart, or overlapping, by more than `doubt`.
pub(super) fn sides(a: &Outline, b: &Outline, towards_b: DVec2, doubt: f64) -> Sides {
    let mut search = Search::new(a, b, doubt, doubt);
    search.is_sign = true;
    (search.best, search.cut) = (doubt, doubt);
    match search.run(towards_b.try_normalize().unwrap_or(DVec2::X)) {
        Some(_) => Sides::Apart,
        None if search.is_close => Sides::Unclear,
        None => Sides::Overlapping,
    }
}

/// For shapes with a gap, the best axes of edges among those that show at least `least`; `normal` is the direction of
/// the nearest points.
///
/// The directions that show a gap of at least `least` are one arc about `normal`, and so are their edges.
pub(super) fn beside(a: &Outline, b: &Outline, normal: DVec2, least: f64) -> Axes {
    let mut axes = Axes::NONE;
    let mut keep = |axis: Axis| {
        let best = if matches!(axis.of, AxisOf::EdgeA(_)) { &mut axes.edge_a } else { &mut axes.edge_b };
        if axis.separation > best.separation {
            *best = axis;
        }
        axis.separation >= least
    };
    let (from_a, from_b) = (a.support(normal).vertex, b.support(-normal).vertex);
    for (outline, from, of, near) in [
        (a, from_a, (|edge| AxisOf::EdgeA(edge)) as fn(usize) -> AxisOf, from_b),
        (b, from_b, |edge| AxisOf::EdgeB(edge), from_a),
    ] {
        let mut edge = from;
        for _ in 0..outline.edge_count() {
            if !keep(axis(a, b, of(edge), Some(near))) {
                break;
            }
            edge = outline.after(edge);
        }
        let mut edge = outline.before(from);
        for _ in 0..outline.edge_count() {
            if !keep(axis(a, b, of(edge), Some(near))) {
                break;
            }
            edge = outline.before(edge);
        }
    }
    axes
}

/// Edges of D between two of its corners.
#[derive(Clone, Copy)]
struct Arc {
    /// The first corner's vertex of A, and how many edges of A follow.
    a: usize,
    edges_a: usize,
    b: usize,
    edges_b: usize,
    from: DVec2,
    to: DVec2,
    /// The squares of the depths along both ends' directions; zero for a direction that shows a gap.
    ends: [f64; 2],
}

struct Search<'s, 'a> {
    a: &'s Outline<'a>,
    b: &'s Outline<'a>,
    /// A separation above this ends the search.
    enough: f64,
    band: f64,
    /// Whether only the sign of the depth is wanted.
    is_sign: bool,
    /// Whether a depth was found that is too small to decide the sign.
    is_close: bool,
    /// The least depth found along any direction.
    best: f64,
    /// Depths above this do not matter.
    cut: f64,
    edge_a: (f64, usize),
    edge_b: (f64, usize),
}

/// A separation that ends the search, and the unit direction that shows it.
type Stop = (f64, DVec2);

impl<'s, 'a> Search<'s, 'a> {
    fn new(a: &'s Outline<'a>, b: &'s Outline<'a>, limit: f64, doubt: f64) -> Self {
        Self {
            a,
            b,
            enough: limit.min(doubt),
            band: 0.0,
            is_sign: false,
            is_close: false,
            best: f64::INFINITY,
            cut: f64::INFINITY,
            edge_a: (f64::INFINITY, 0),
            edge_b: (f64::INFINITY, 0),
        }
    }

    /// The corner of D furthest along a direction.
    fn corner(&self, direction: DVec2) -> (usize, usize, DVec2) {
        let (in_a, in_b) = (self.a.support(direction).vertex, self.b.support(-direction).vertex);
        (in_a, in_b, self.a.point(in_a) - self.b.point(in_b))
    }

    /// Takes the depth along a direction of any length into account, and returns its square.
    fn meet(&mut self, direction: DVec2, corner: DVec2) -> Result<f64, Stop> {
        let (along, length) = (direction.dot(corner), direction.length_squared());
        if along < 0.0 {
            let length = length.sqrt();
            if -along > self.enough * length {
                return Err((-along / length, direction / length));
            }
            self.offer(along / length);
            return Ok(0.0);
        }
        let squared = along * along / length;
        if squared < self.best * self.best {
            self.offer(squared.sqrt());
        }
        Ok(squared)
    }

    fn offer(&mut self, depth: f64) {
        if self.is_sign {
            self.is_close |= depth <= self.best;
        } else if depth < self.best {
            self.best = depth;
            self.cut = depth.max(0.0) + self.band;
        }
    }

    /// Searches all directions, starting from `first` and its opposite.
    fn run(&mut self, first: DVec2) -> Option<Stop> {
        self.look(first).err()
    }

    fn look(&mut self, first: DVec2) -> Result<(), Stop> {
        let (a, b, from) = self.corner(first);
        let at_first = self.meet(first, from)?;
        let (mut last_a, last_b, to) = self.corner(-first);
        let at_last = self.meet(-first, to)?;
        // A segment across the direction ties with itself.
        if self.a.edge_count() == 2 && last_a == a {
            last_a = 1 - a;
        }
        let last_b = if self.b.edge_count() == 2 && last_b == b { 1 - b } else { last_b };
        let to = if (last_a, last_b) == (a, b) { to } else { self.a.point(last_a) - self.b.point(last_b) };
        let one = Arc {
            a,
            edges_a: self.a.edges_between(a, last_a),
            b,
            edges_b: self.b.edges_between(b, last_b),
            from,
            to,
            ends: [at_first, at_last],
        };
        let other = Arc {
            a: last_a,
            edges_a: self.a.edges_between(last_a, a),
            b: last_b,
            edges_b: self.b.edges_between(last_b, b),
            from: to,
            to: from,
            ends: [at_last, at_first],
        };
        let is_whole = one.edges_a + other.edges_a == self.a.edge_count()
            && one.edges_b + other.edges_b == self.b.edge_count();
        if !is_whole {
            // The shape is so thin that opposite directions have the same support point.
            return self.exhaust();
        }
        let mut waiting: ArrayVec<Arc, WAITING> = ArrayVec::new();
        waiting.push(one);
        waiting.push(other);
        while let Some(arc) = waiting.pop() {
            self.split(&arc, &mut waiting)?;
        }
        Ok(())
    }

    fn split(&mut self, arc: &Arc, waiting: &mut ArrayVec<Arc, WAITING>) -> Result<(), Stop> {
        let edges = arc.edges_a + arc.edges_b;
        if edges == 0 {
            return Ok(());
        }
        let chord = arc.to - arc.from;
        let outward = DVec2::new(chord.y, -chord.x);
        let (along, cut) = (arc.from.perp_dot(arc.to), self.cut * self.cut);
        if arc.ends[0] > cut
            && arc.ends[1] > cut
            && along > 0.0
            && along * along > cut * outward.length_squared()
        {
            return Ok(());
        }
        if edges <= LEAF || waiting.remaining_capacity() < 2 {
            return self.evaluate(arc);
        }
        let a = self.a.climb(arc.a, arc.edges_a, outward);
        let b = self.b.climb(arc.b, arc.edges_b, -outward);
        let (done_a, done_b) = (self.a.edges_between(arc.a, a), self.b.edges_between(arc.b, b));
        let done = done_a + done_b;
        if done == 0 || done == edges {
            return self.evaluate(arc);
        }
        let middle = self.a.point(a) - self.b.point(b);
        let depth = self.meet(outward, middle)?;
        let one = Arc { edges_a: done_a, edges_b: done_b, to: middle, ends: [arc.ends[0], depth], ..*arc };
        let (edges_a, edges_b) = (arc.edges_a - done_a, arc.edges_b - done_b);
        let other = Arc { a, edges_a, b, edges_b, from: middle, to: arc.to, ends: [depth, arc.ends[1]] };
        // The chord nearer to the origin first: what it finds may rule out the other.
        let bound = |arc: &Arc| arc.from.perp_dot(arc.to) / (arc.to - arc.from).length_squared().sqrt();
        if bound(&one) < bound(&other) {
            waiting.extend([other, one]);
        } else {
            waiting.extend([one, other]);
        }
        Ok(())
    }

    /// Evaluates every edge of an arc.
    fn evaluate(&mut self, arc: &Arc) -> Result<(), Stop> {
        let mut edge = arc.a;
        for _ in 0..arc.edges_a {
            count_step();
            let normal = self.a.outward(edge);
            let other = self.b.climb(arc.b, arc.edges_b, -normal);
            self.edge_a(edge, normal, self.a.point(edge) - self.b.point(other))?;
            edge = self.a.after(edge);
        }
        let mut edge = arc.b;
        for _ in 0..arc.edges_b {
            count_step();
            let normal = -self.b.outward(edge);
            let other = self.a.climb(arc.a, arc.edges_a, normal);
            self.edge_b(edge, normal, self.a.point(other) - self.b.point(edge))?;
            edge = self.b.after(edge);
        }
        Ok(())
    }

    /// Evaluates every edge there is.
    fn exhaust(&mut self) -> Result<(), Stop> {
        for edge in 0..self.a.edge_count() {
            let normal = self.a.outward(edge);
            let other = self.b.support(-normal).vertex;
            self.edge_a(edge, normal, self.a.point(edge) - self.b.point(other))?;
        }
        for edge in 0..self.b.edge_count() {
            let normal = -self.b.outward(edge);
            let other = self.a.support(normal).vertex;
            self.edge_b(edge, normal, self.a.point(other) - self.b.point(edge))?;
        }
        Ok(())
    }

    fn edge_a(&mut self, edge: usize, normal: DVec2, corner: DVec2) -> Result<(), Stop> {
        self.meet(normal, corner)?;
        let depth = normal.dot(corner);
        // Of equals, the lowest index, in whatever order they come.
        if depth < self.edge_a.0 || depth == self.edge_a.0 && edge < self.edge_a.1 {
            self.edge_a = (depth, edge);
        }
        Ok(())
    }

    fn edge_b(&mut self, edge: usize, normal: DVec2, corner: DVec2) -> Result<(), Stop> {
        self.meet(normal, corner)?;
        let depth = normal.dot(corner);
        if depth < self.edge_b.0 || depth == self.edge_b.0 && edge < self.edge_b.1 {
            self.edge_b = (depth, edge);
        }
        Ok(())
    }

    /// The best edges that were found, each projected.
    fn axes(&self, kept: Option<AxisOf>, doubt: f64) -> Axes {
        let mut axes = Axes::NONE;
        let least = self.edge_a.0.min(self.edge_b.0);
        if self.edge_a.0 <= least + self.band && self.a.edge_count() > 0 {
            axes.edge_a = axis(self.a, self.b, AxisOf::EdgeA(self.edge_a.1), None);
        }
        if self.edge_b.0 <= least + self.band && self.b.edge_count() > 0 {
            axes.edge_b = axis(self.a, self.b, AxisOf::EdgeB(self.edge_b.1), None);
        }
        let best = axes.best().separation;
        axes.short = doubt + (-least - best).max(0.0);
        axes.kept =
            kept.map(|of| axis(self.a, self.b, of, None)).filter(|axis| axis.separation >= best - self.band);
        axes
    }
}
