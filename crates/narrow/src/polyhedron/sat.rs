//! The separating axis test for two convex polyhedra.
//!
//! ```text
//! for the most promising face of A and of B:   axis = its normal
//! walk from the better one's facet of A - B to the nearest; if that is proved to be it: done      (walk, facet, cover)
//! for each other face that spheres inside the other solid do not rule out:   axis = its normal                  (cull)
//! for prisms and their like: an expanding polytope in A - B; if it finds the nearest facet: done                (grow)
//! for each pair of edges that the spheres do not rule out and whose arcs on the Gauss map may cross:      (arcs, caps)
//!                                              axis = the cross product, unless the edges are nearly parallel,
//!                                              or already show less by themselves than the best axis so far
//! the separation along an axis = min over B - max over A, projecting *every* vertex
//! the greatest separation wins
//! ```
//! An edge pair bounds the Minkowski difference exactly when the arc between the normals at A's edge crosses the arc
//! between the (negated) normals at B's (Gregorius, "The separating axis test between convex polyhedra", GDC 2013). The
//! arc test here only saves time, and errs towards keeping a pair. Every axis that is kept is verified by full
//! projection, so noise in a cross product can make an axis useless but never wrong. A cross product is oriented by the
//! arc of A's edge and not by the centres, which may coincide.
//!
//! An axis that is slightly off shows slightly less separation than the true one, never more. The possible shortfall is
//! kept beside the best separation ([`Axes::short`]): edges at a small angle widen their own pair's error only.
//!
//! Words for separations, and for differences between them, in metres:
//!
//! ```text
//! known       one that the caller is certain of; `floor`: the greatest one that is certain so far
//! stake       that of the best axis so far, or the floor where that alone left all axes out
//! unproved    that of the axis from which a walk failed before: nothing below is walked from again
//! keep        an axis that falls short of the floor by no more is evaluated, since a contact may be built on it
//! even        an edge pair that beats the best face by no more counts as even with it, and is left out
//! ceiling     no axis truly shows more: each axis raises it by what it shows and its error, and so do even pairs
//! slack       how far two edges may lie off the supporting planes of their axis; `aside`: how far they do
//! ```
//!
//! What makes it cheap, and what each measure saved on two hulls of 32 vertices (AMD EPYC, Zen 4, 2026-11-21; the plain
//! test took 52 us on mixed pairs and 85 on deeply overlapping ones, and now takes 1.6 and 6.5):
//!
//! 1. *arcs eight at a time*, in f32, over data precomputed with the hull: deep 85 -> 19 us;
//! 2. *spheres*: faces and edges that cannot win, judged by a sphere inside the other solid or by its vertices, are
//!    skipped: deep 19 -> 7.8 us;
//! 3. *support in lanes*: f32 discards, f64 chooses among what is left, 35 -> 19 ns for 32 vertices; where a bound
//!    suffices, f32 alone: mixed 1.75 -> 1.62 us, and face on face 3.5 -> 3.1;
//! 4. *the edges themselves, and vertices seen so far*, bound an edge pair's axis before it is projected, without a
//!    division: prisms, whose edges are parallel, deep 4.9 -> 4.0 us; the edges first, and alone where they suffice:
//!    3.3 -> 3.1;
//! 5. *a proof by one facet*: where last frame's axis is still the best, no other is evaluated. Face on face 6.2 -> 1.0
//!    us with its manifold, sliding 4.2 -> 1.0, tumbling 3.2 -> 1.7. The same in a gap (`across`). Where the proof
//!    fails, last frame's axis is the bound to beat from the start: a frame of a pile of hulls 5 % less (2026-11-22);
//! 6. *a walk to the best facet* from last frame's axis, or from the better of two promising faces, over the facets
//!    between (`walk`), with single vertices as proof where no ball suffices (`cover`): of hulls that fall on each
//!    other, 4 pairs a frame need the rest of this test, where it was 670. Frames 7 to 20 % less (2026-11-24). For
//!    pairs that meet for the first time, a walk before the search for a direction: face on face 2.2 -> 1.6
//!    (2026-11-26).
//!
//! And on two hulls of 256 vertices too symmetric for any culling, such as equal double cones in one place (1.9 ms):
//!
//! 7. *caps around eight arcs*, of edges sorted by the direction they face: 1.9 -> 0.9 ms, prisms 1.4 -> 1.1;
//! 8. *the edges themselves* (4): prisms 1.1 -> 0.8, flat ones 0.8 -> 0.6;
//! 9. *no closer look* where it rules nothing out: cones 0.9 -> 0.7.
//!
//! And on prisms, whose rim edges have arcs that fan out from a cap's normal to every side's:
//!
//! 10. *an expanding polytope* in place of edge pairs: 128 sides, deep, 200 us -> 18; 24 sides, 24 -> 8 (2026-11-26).
//!
//! Tried, and dropped:
//! - AVX2 for the whole test behind run-time detection: 0 to 15 % slower, since calls across that border are not
//!   inlined (the whole program compiled for it is 8 to 15 % faster); AVX2 for the support search alone: no gain;
//! - one lane in place of eight for faces and edges: 4 times slower; no culling below 24 edges: twice as slow for 8
//!   vertices; masks in place of eight numbers: slower in portable Rust;
//! - the furthest vertex as a branch-free sum of indices: 20 % slower: branches are predicted, sums are waited for;
//! - leaving an octet of arcs between the test of the two great circles and that of the meeting point: cones 15 %
//!   faster, all else 3 to 6 % slower;
//! - keeping the projections of a support search for its second pass: a fifth fewer instructions, no time; taking f32's
//!   winner where no other is near: none either;
//! - the best direction of the preceding search as a first bound: no gain; the corners of last frame's axis shown to
//!   each solid first, where that axis was not proved: crowds 2 % slower, else nothing.
//!
//! Cost: linear in faces, edges and vertices; for what the spheres leave, faces times vertices and edges times edges.

mod across;
mod arcs;
mod axes;
mod caps;
mod cover;
mod cross;
mod cull;
mod facet;
mod grow;
mod hinted;
mod level;
mod search;
mod walk;

use super::solid::Solid;
use crate::counted::count_steps;
pub(crate) use across::across_edges;
use arcs::{for_edge_pairs, for_many_edge_pairs};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;
pub(crate) use axes::{Axes, Axis, AxisOf};
use cross::{Cross, EdgeAt};
use cull::{Heights, Sight};
pub(crate) use facet::in_polygon;
use grow::{Bound, grow};
pub(crate) use hinted::{Hinted, hint_of, hint_to, hint_with, last_of};
pub(crate) use search::Search;
pub(crate) use walk::Ended;

/// Edges of a hull with the most vertices, by Euler's formula.
const MAX_EDGES: usize = 3 * MAX_HULL_VERTICES - 6;

/// With more edges of B left than this, all of them are transformed beforehand.
const MANY: usize = 64;

/// From this many pairs of edges on, an expanding polytope may be faster.
const MANY_PAIRS: usize = 1600;

/// Vertices kept of each solid to show that an axis is not the best.
const MOST_SUPPORTS: usize = 6;

/// The best axis of each kind.
pub(crate) fn separating_axes(a: &Solid, b: &Solid, search: &Search) -> Axes {
    with_first_faces((a, b), search, |mut found, sights, first| {
        // A face that shows no more than the axis from which a walk did not succeed is no better a start.
        if found.axes.best().separation > search.unproved
            && let Some(first) = found.first_hinted(&first, search)
        {
            match first.walk((a, b), search.precision) {
                Ended::Best(axes) => return axes,
                Ended::Apart(_) => {}
                Ended::Open(shown) => {
                    found.floor = found.floor.max(shown - search.precision.doubt_of_depth());
                }
            }
        }
        found.by_faces(sights, &first, search);
        found.by_edges(sights, search);
        found.axes
    })
}

/// The axis of the most promising face of both solids: where to start when nothing is known about them.
pub(crate) fn first_axis(a: &Solid, b: &Solid, search: &Search) -> Option<Hinted> {
    with_first_faces((a, b), search, |found, _, first| found.first_hinted(&first, search))
}

/// [`separating_axes`] by faces alone, for solids separated by a gap.
pub(crate) fn face_axes(a: &Solid, b: &Solid, search: &Search) -> Axes {
    with_first_faces((a, b), search, |mut found, sights, first| {
        found.by_faces(sights, &first, search);
        found.axes
    })
}

/// The most promising face of A and of B, each with the other solid's deepest vertex against it.
type First = [Option<[usize; 2]>; 2];

/// Evaluates the most promising faces, and passes the state of the test on to `go_on`. It is not returned, since the
/// sights borrow what is on the stack here: heights over all faces, too many to be copied.
#[inline(always)]
fn with_first_faces<R>(
    (a, b): (&Solid, &Solid),
    search: &Search,
    go_on: impl FnOnce(Found, &mut [Sight; 2], First) -> R,
) -> R {
    let (mut over_a, mut over_b) = (Heights::new_const(), Heights::new_const());
    let mut sights = [Sight::new(a, b, &mut over_a), Sight::new(b, a, &mut over_b)];
    let mut found = Found::new(search);
    let first = found.by_first_faces(&mut sights, search);
    go_on(found, &mut sights, first)
}

/// The state of the test.
struct Found {
    axes: Axes,
    /// How far the best pair of edges lies off the supporting planes of its axis.
    aside: f64,
    /// A separation that is certain.
    floor: f64,
    /// Support vertices of A and of B along earlier axes. Along any axis, the true separation is no more than they
    /// show.
    supports: [ArrayVec<(usize, DVec3), MOST_SUPPORTS>; 2],
}

impl Found {
    fn new(search: &Search) -> Self {
        let supports = [ArrayVec::new(), ArrayVec::new()];
        Self { axes: Axes::NONE, aside: f64::INFINITY, floor: search.known, supports }
    }

    /// Evaluates the most promising face of each solid first: the better the best axis, the more it culls. Returns
    /// those faces, each with the other solid's deepest vertex against it.
    fn by_first_faces(&mut self, sights: &mut [Sight; 2], search: &Search) -> First {
        let mut first = [None; 2];
        for (which, sight) in sights.iter_mut().enumerate() {
            if let Some(face) = sight.highest() {
                let vertex = self.by_face([sight.solid, sight.other], which, face, search);
                sight.add(vertex);
                first[which] = Some([face, vertex]);
            }
        }
        self.axes.raise(self.axes.best().separation, search.precision.of_face());
        first
    }

    /// The better of the first faces, to start a walk from.
    fn first_hinted(&self, first: &First, search: &Search) -> Option<Hinted> {
        let axis = *self.axes.best();
        let [of_a, of_b] = *first;
        let [_, deepest] = if matches!(axis.of, AxisOf::FaceA(_)) { of_a } else { of_b }?;
        Some(Hinted { axis, deepest, doubt: search.precision.of_face() })
    }

    /// Evaluates all other faces that may be as good.
    fn by_faces(&mut self, sights: &mut [Sight; 2], first: &First, search: &Search) {
        for (which, sight) in sights.iter_mut().enumerate() {
            let pair = [sight.solid, sight.other];
            let evaluated = first[which].map(|[face, _]| face);
            sight.for_faces(self.floor - search.keep(), |face| {
                // Any vertex may be culled by, and the deepest one is a point already. None would do as well, but then
                // other pairs would be culled, and error bounds be others.
                let vertex =
                    if Some(face) == evaluated { 0 } else { self.by_face(pair, which, face, search) };
                (vertex, self.floor - search.keep())
            });
        }
        self.axes.raise(self.axes.best().separation, search.precision.of_face());
    }

    /// Evaluates one face of A (0) or of B (1). Returns the other solid's deepest vertex against it.
    fn by_face(&mut self, [solid, other]: [&Solid; 2], which: usize, face: usize, search: &Search) -> usize {
        let outward = solid.normal(face);
        let (rough, excess) = other.rough_support(-outward);
        if excess - rough.reach - solid.face_reach(face, outward) < self.floor - search.keep() {
            return rough.vertex;
        }
        let support = other.support(-outward);
        let separation = -support.reach - solid.face_reach(face, outward);
        let (normal, of) = match which {
            0 => (outward, AxisOf::FaceA(face)),
            _ => (-outward, AxisOf::FaceB(face)),
        };
        if separation > self.floor {
            self.keep_support(1 - which, other, support.vertex);
        }
        self.offer(Axis { separation, normal, of });
        support.vertex
    }

    /// Evaluates the pairs of edges that the spheres do not rule out and whose arcs may cross.
    fn by_edges(&mut self, sights: &mut [Sight; 2], search: &Search) {
        let [in_a, in_b] = sights;
        let (a, b) = (in_a.solid, in_b.solid);
        if are_rimmed(a, b) && self.by_growing((a, b), search).is_some() {
            return;
        }
        // Not an array of two: that would be cleared first.
        let mut edges_a = ArrayVec::<u16, MAX_EDGES>::new();
        let mut edges_b = ArrayVec::<u16, MAX_EDGES>::new();
        let least = self.floor - search.keep();
        in_a.edges(least, &mut edges_a);
        if edges_a.is_empty() {
            return;
        }
        in_b.edges(least, &mut edges_b);
        if edges_b.is_empty() {
            return;
        }
        if edges_b.len() > MANY {
            return self.by_many_edges((a, &edges_a), (b, &edges_b), search);
        }
        // All pairs of one edge of A come in a row.
        let (mut at_a, mut out_of_a) = (EdgeAt::NONE, DVec3::ZERO);
        for_edge_pairs((a, &edges_a), (b, &edges_b), |[edge_a, edge_b], _| {
            if edge_a != at_a.half_edge {
                (at_a, out_of_a) = (EdgeAt::new(a, edge_a), a.out_of_edge(edge_a));
            }
            let at_b = EdgeAt::new(b, edge_b);
            let cross = Cross::outwards((at_a.along, out_of_a), at_b.along, || b.out_of_edge(edge_b));
            if !self.rule_out_by_edges([&at_a, &at_b], &cross, search) {
                self.by_edge_pair((a, b), [&at_a, &at_b], &cross, search);
            }
        });
    }

    /// The separation of the best axis so far, or the known bound where that alone left all axes out.
    fn stake(&self) -> f64 {
        let best = self.axes.best().separation;
        if best == f64::NEG_INFINITY { self.floor } else { best }
    }

    /// The best axis of all by an expanding polytope, without testing edge pairs; `None` where that does not find it.
    #[inline(never)]
    fn by_growing(&mut self, solids: (&Solid, &Solid), search: &Search) -> Option<()> {
        let precision = search.precision;
        let even = search.even(self.stake());
        // Infinite while no axis was evaluated: then there is nothing to prove, and the depth has to be found.
        let known_depth = -self.axes.best().separation;
        let Bound { at_least, met } = grow(solids, (known_depth, even), precision)?;
        if let Some(facet) = met {
            let least = -at_least - 2.0 * even - precision.planarity;
            let is_it = |hinted: &Hinted| hinted.axis.separation >= least;
            let hinted = walk::facet_of(solids, &facet, precision, is_it)?;
            self.offer(hinted.axis);
        }
        self.axes.raise(-at_least, precision.projection());
        Some(())
    }

    /// [`Found::by_edges`] with each edge of B transformed once: a third less where each is paired with many of A. A
    /// function of its own for the stack that it takes.
    #[inline(never)]
    fn by_many_edges(
        &mut self,
        (a, edges_a): (&Solid, &[u16]),
        (b, edges_b): (&Solid, &[u16]),
        search: &Search,
    ) {
        let mut all_b = ArrayVec::<EdgeAt, MAX_EDGES>::new_const();
        all_b.extend(edges_b.iter().map(|&edge| EdgeAt::new(b, b.topology.edges()[edge as usize].into())));
        let (mut at_a, mut out_of_a) = (EdgeAt::NONE, DVec3::ZERO);
        for_many_edge_pairs((a, edges_a), (b, edges_b), |[edge_a, edge_b], place_b| {
            if edge_a != at_a.half_edge {
                (at_a, out_of_a) = (EdgeAt::new(a, edge_a), a.out_of_edge(edge_a));
            }
            let at_b = &all_b[place_b];
            let cross = Cross::outwards((at_a.along, out_of_a), at_b.along, || b.out_of_edge(edge_b));
            if !self.rule_out_by_edges([&at_a, at_b], &cross, search) {
                self.by_edge_pair((a, b), [&at_a, at_b], &cross, search);
            }
        });
    }

    /// [`Found::rule_out_by_bound`] by the two edges themselves: they never show less than the true separation. No
    /// division: everything stays scaled by the length of the cross product.
    #[inline(always)]
    fn rule_out_by_edges(&mut self, edges: [&EdgeAt; 2], cross: &Cross, search: &Search) -> bool {
        // Counted as two steps: it takes 6 ns.
        count_steps(2);
        if cross.is_noise() {
            return false;
        }
        let length = cross.axis.length();
        let shown = cross.axis.dot(edges[1].from - edges[0].from);
        self.rule_out_by_bound(shown, (cross, length), search)
    }

    /// Rules out the axis of two edges if the separation `shown` along it is no more than that of the best axis so far,
    /// or than counts as even with the best face: then the ceiling is raised by what is left out. Returns whether it
    /// is ruled out. `shown` is scaled by the length of the cross product.
    #[inline(always)]
    fn rule_out_by_bound(&mut self, shown: f64, (cross, length): (&Cross, f64), search: &Search) -> bool {
        // Twice the error of an edge pair's axis, which is that of a projection over the sine of their angle. Scaled by
        // the length of the cross product, that is a projection's error times both edges' lengths, whose product is at
        // most half the sum of their squares.
        let most = shown + search.precision.projection() * (2.0 * cross.lengths() + length);
        if most <= self.axes.best().separation * length {
            return true;
        }
        let of_faces = self.axes.face_a.separation.max(self.axes.face_b.separation);
        let even = of_faces + search.even(of_faces);
        let is_even = most <= even * length;
        if is_even {
            self.axes.raise(even, 0.0);
        }
        is_even
    }

    /// Evaluates one pair of edges, unless the vertices seen so far show that its axis is not the best.
    fn by_edge_pair(
        &mut self,
        (a, b): (&Solid, &Solid),
        edges: [&EdgeAt; 2],
        cross: &Cross,
        search: &Search,
    ) {
        // Counted as five steps: it takes 20 ns.
        count_steps(5);
        let precision = search.precision;
        if cross.is_noise() && self.rule_out_parallel(cross, search) {
            return;
        }
        let length = cross.axis.length();
        if self.rule_out_by_supports((cross, length), search) {
            return;
        }
        let normal = cross.axis / length;
        let (in_a, in_b) = (a.support(normal), b.support(-normal));
        self.keep_support(0, a, in_a.vertex);
        self.keep_support(1, b, in_b.vertex);
        let of = AxisOf::Edges(edges[0].half_edge, edges[1].half_edge);
        let axis = Axis { separation: -in_b.reach - in_a.reach, normal, of };
        if cross.is_noise() {
            self.axes.leave_out(axis.separation, cross.squared_sine(), precision);
            return;
        }
        self.axes.raise(axis.separation, precision.of_edges(cross.squared_sine()));
        let aside = aside(a, b, &axis);
        if aside <= search.slack && self.is_better(&axis, aside, precision.projection()) {
            (self.axes.edges, self.aside) = (axis, aside);
            self.floor = self.floor.max(axis.separation);
        }
    }

    /// Rules out the axis of edges so nearly parallel that the most it could add to the best one is negligible, and
    /// records that as left out. Returns whether it is ruled out.
    fn rule_out_parallel(&mut self, cross: &Cross, search: &Search) -> bool {
        let by_angle = search.precision.of_parallel_edges(cross.squared_sine());
        let is_nothing = by_angle <= search.even(self.stake());
        if is_nothing {
            self.axes.left_out = self.axes.left_out.max(by_angle);
        }
        is_nothing
    }

    /// Whether an edge pair's axis beats the best one so far: by its separation or, where that is equal up to rounding,
    /// as it is for all edges of the same directions, because its edges are those that touch.
    fn is_better(&self, axis: &Axis, aside: f64, rounding: f64) -> bool {
        let more = axis.separation - self.axes.edges.separation;
        more > rounding || more >= -rounding && aside < self.aside - rounding
    }

    /// [`Found::rule_out_by_bound`] by the vertices seen so far: they never show less than the true separation.
    fn rule_out_by_supports(&mut self, (cross, length): (&Cross, f64), search: &Search) -> bool {
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (_, point) in &self.supports[1] {
            lowest = lowest.min(cross.axis.dot(*point));
        }
        for (_, point) in &self.supports[0] {
            highest = highest.max(cross.axis.dot(*point));
        }
        self.rule_out_by_bound(lowest - highest, (cross, length), search)
    }

    fn offer(&mut self, axis: Axis) {
        self.axes.offer(axis);
        self.floor = self.floor.max(axis.separation);
    }

    /// Remembers a vertex of A (0) or of B (1), in place of the oldest one once the list is full.
    fn keep_support(&mut self, which: usize, solid: &Solid, vertex: usize) {
        let supports = &mut self.supports[which];
        if supports.iter().all(|&(known, _)| known != vertex) {
            if supports.is_full() {
                supports.remove(0);
            }
            supports.push((vertex, solid.point(vertex)));
        }
    }
}

/// Whether the solids have many pairs of edges and either is a prism or much like one: at least a quarter of its edges
/// are the rim of one face. Spheres rule out few edges of those.
fn are_rimmed(a: &Solid, b: &Solid) -> bool {
    let is_rimmed = |solid: &Solid| {
        let (edges, faces) = (solid.arcs().len(), solid.face_count());
        let corners = |face: usize| solid.topology.face_half_edges(face).len();
        2 * edges >= 5 * faces && (0..faces).any(|face| 4 * corners(face) >= edges)
    };
    a.arcs().len() * b.arcs().len() >= MANY_PAIRS && (is_rimmed(a) || is_rimmed(b))
}

/// The axis of a face of A.
pub(super) fn face_axis_a(a: &Solid, b: &Solid, face: usize) -> Axis {
    let normal = a.normal(face);
    let separation = -b.support(-normal).reach - a.face_reach(face, normal);
    Axis { separation, normal, of: AxisOf::FaceA(face) }
}

/// The axis of a face of B.
pub(super) fn face_axis_b(a: &Solid, b: &Solid, face: usize) -> Axis {
    let outward = b.normal(face);
    let separation = -b.face_reach(face, outward) - a.support(-outward).reach;
    Axis { separation, normal: -outward, of: AxisOf::FaceB(face) }
}

/// How far an axis' edges lie off the supporting planes of both shapes, in metres along the axis.
///
/// Arcs that were kept as a close call need not cross: then the axis is a valid one, but not that of a facet made by
/// these edges, and some other pair of the same directions is the one that touches.
fn aside(a: &Solid, b: &Solid, axis: &Axis) -> f64 {
    let AxisOf::Edges(edge_a, edge_b) = axis.of else { return 0.0 };
    let between = b.edge(edge_b).0 - a.edge(edge_a).0;
    axis.normal.dot(between) - axis.separation
}

#[cfg(test)]
pub(crate) mod tests;
