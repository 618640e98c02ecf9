//! A walk from one facet of the difference to the nearest one, over the edges between them.
//!
//! The penetration depth of two solids is the distance of the origin from the surface of M = A - B. The facet of last
//! frame's axis is seldom still the nearest, but most often beside it. As long as the foot of the origin lies outside
//! the facet, the facets on that side are nearer:
//!
//! ```text
//! beside    the side of the facet that the foot lies furthest beyond: an edge of one solid with a vertex of the other
//! crossing  follow that edge's arc on the Gauss map to the face beyond it. The first arc that it crosses, of an edge
//!           at the vertex, makes an edge pair with it: the next facet. Where it crosses none, the face gives the next
//! judge     once the foot is inside the facet: is it the nearest of all?                              (facet, cover)
//!           if some direction beats it, go on from the face there whose normal lies most nearly along that direction
//! ```
//! Each axis is evaluated with all vertices, and each step must show more than the one before, so that neither hints
//! nor rounding can lead astray or in circles. Pairs a frame that still need the test of all axes, and the frame's
//! share of its former time (AMD EPYC, Zen 4, 2026-11-24):
//!
//! - hulls that fall on each other: 4 pairs, where it was 670; 0.93 of the time;
//! - hulls at rest: 5 pairs for 370; 0.8;
//! - 10,000 boxes and hulls in the air: 15 pairs for 450; 0.9;
//! - a crowd: 16 pairs for 100; 0.98.
//!
//! Lin and Canny walk in this way over the features of two solids with a gap between them ("A fast algorithm for
//! incremental distance calculation", ICRA 1991); here the walk goes over those of their difference, in overlap.

use super::super::solid::Solid;
use super::grow::Met;
use super::hinted::{Hinted, Judged};
use super::{Axes, Axis, AxisOf};
use crate::precision::Precision;
use asunder_geometry::glam::DVec3;

/// Most facets of one walk. Bodies rotate by little in a frame: one or two.
const MOST_STEPS: usize = 8;

/// Most walks: each starts from the direction that beat the end of the one before.
const MOST_WALKS: usize = 4;

/// How a walk ended.
#[allow(clippy::large_enum_variant, reason = "as Probe")]
pub(crate) enum Ended {
    /// The best axis there is.
    Best(Axes),
    /// An axis that shows no overlap, or less than rounding.
    Apart(Axis),
    /// Nothing is proved; the best axis met shows this separation.
    Open(f64),
}

/// Where the foot of the origin lies, as seen along a facet's axis.
enum Foot {
    Inside,
    Beyond(Side),
    /// Nowhere: the edges that the axis is named after do not lie on its supporting planes, or have no arcs.
    Astray,
}

/// A side of a facet: an edge of A, or of B, with a vertex of the other, and the face that its arc leads to.
struct Side {
    is_of_a: bool,
    edge: usize,
    face: usize,
    vertex: usize,
}

impl Hinted {
    /// Walks to the best axis of solids that seem to overlap, starting from this one. Cost: a few support searches a
    /// step.
    pub(crate) fn walk(&self, (a, b): (&Solid, &Solid), precision: &Precision) -> Ended {
        let (mut at, mut most) = (*self, self.axis.separation);
        let least = -precision.doubt_of_depth();
        for _ in 0..MOST_WALKS {
            if at.axis.separation >= least {
                return Ended::Apart(at.axis);
            }
            match at.judged((a, b), precision) {
                Judged::Best(axes) => return Ended::Best(axes),
                Judged::Beaten(direction) => {
                    let Some(next) = face_towards((a, b), direction, precision) else { break };
                    at = next;
                }
                Judged::Open => {}
            }
            let Some(next) = at.walked((a, b), precision) else { break };
            // Neither the same axis again, nor an earlier one.
            let is_further = next.axis.separation > most;
            if !is_further {
                break;
            }
            (at, most) = (next, next.axis.separation);
        }
        Ended::Open(most)
    }

    /// The end of one walk: where the foot of the origin is inside, or the solids do not overlap; `None` where it leads
    /// nowhere.
    fn walked(mut self, (a, b): (&Solid, &Solid), precision: &Precision) -> Option<Self> {
        for step in 0..MOST_STEPS {
            let next = match self.foot((a, b), precision) {
                Foot::Inside => return Some(self),
                Foot::Astray if step == 0 => {
                    self = face_towards((a, b), self.axis.normal, precision)?;
                    continue;
                }
                Foot::Astray => return None,
                Foot::Beyond(side) => Self::at((a, b), side.next_of((a, b), self.axis.normal), precision)?,
            };
            let is_better = next.axis.separation > self.axis.separation;
            if !is_better {
                return None;
            }
            self = next;
            if self.axis.separation >= -precision.doubt_of_depth() {
                return Some(self);
            }
        }
        None
    }

    fn foot(&self, (a, b): (&Solid, &Solid), precision: &Precision) -> Foot {
        let normal = self.axis.normal;
        match self.axis.of {
            AxisOf::FaceA(face) => foot_on_face((a, face), normal, (b, self.deepest), true),
            AxisOf::FaceB(face) => foot_on_face((b, face), -normal, (a, self.deepest), false),
            AxisOf::Edges(edge_a, edge_b) => {
                foot_on_edges((a, edge_a), (b, edge_b), &self.axis, precision.projection())
            }
        }
    }
}

/// The facet of the difference that a piece of it belongs to, recognised by what it shows: the two edges of the piece's
/// corners, or what a walk comes to from the face that faces most nearly the same way.
pub(super) fn facet_of(
    solids: (&Solid, &Solid),
    piece: &Met,
    precision: &Precision,
    is_it: impl Fn(&Hinted) -> bool,
) -> Option<Hinted> {
    if let Some(edges) = piece.corners.and_then(|corners| edges_of(solids, corners))
        && let Some(hinted) = Hinted::at(solids, edges, precision).filter(&is_it)
    {
        return Some(hinted);
    }
    let first = face_towards(solids, piece.direction, precision)?;
    first.walked(solids, precision).filter(&is_it).or_else(|| Some(first).filter(&is_it))
}

/// The two edges whose difference has the three corners, if there are two.
fn edges_of((a, b): (&Solid, &Solid), corners: [[u16; 2]; 3]) -> Option<AxisOf> {
    let ends = |which: usize| {
        let [p, q, r] = corners.map(|corner| corner[which]);
        let other = if q == p { r } else { q };
        let is_two = other != p && [p, other].contains(&r);
        is_two.then_some((usize::from(p), usize::from(other)))
    };
    let ((from_a, to_a), (from_b, to_b)) = (ends(0)?, ends(1)?);
    Some(AxisOf::Edges(a.edge_between(from_a, to_a)?, b.edge_between(from_b, to_b)?))
}

/// The face whose normal lies most nearly along a direction, of those at both support vertices.
fn face_towards((a, b): (&Solid, &Solid), direction: DVec3, precision: &Precision) -> Option<Hinted> {
    let (mut most, mut best) = (f64::NEG_INFINITY, None);
    for (is_of_a, solid, outward) in [(true, a, direction), (false, b, -direction)] {
        let vertex = solid.rough_support(outward).0.vertex;
        for &half_edge in solid.topology.leaving(vertex) {
            let face = usize::from(solid.topology.half_edges()[usize::from(half_edge)].face);
            if face >= solid.face_count() {
                continue;
            }
            let along = solid.normal(face).dot(outward);
            if along > most {
                (most, best) = (along, Some(if is_of_a { AxisOf::FaceA(face) } else { AxisOf::FaceB(face) }));
            }
        }
    }
    Hinted::at((a, b), best?, precision)
}

/// Where the other solid's deepest vertex lies against a face, as seen along the face's outward normal.
fn foot_on_face(
    (solid, face): (&Solid, usize),
    outward: DVec3,
    (other, vertex): (&Solid, usize),
    is_of_a: bool,
) -> Foot {
    let (point, halves) = (other.point(vertex), solid.topology.half_edges());
    let (mut least, mut beyond) = (0.0, None);
    for half_edge in solid.topology.face_half_edges(face) {
        let (from, to) = solid.edge(half_edge);
        let inwards = outward.cross(to - from);
        let inside = inwards.dot(point - from);
        // Squared, with its sign: no root.
        let share = inside * inside.abs() / inwards.length_squared();
        if share < least {
            (least, beyond) = (share, Some(half_edge));
        }
    }
    let Some(half_edge) = beyond else { return Foot::Inside };
    let face = usize::from(halves[usize::from(halves[half_edge].twin)].face);
    Foot::Beyond(Side { is_of_a, edge: solid.topology.edge_of(half_edge), face, vertex })
}

/// Where two edges cross, as seen along their axis.
fn foot_on_edges(
    (a, edge_a): (&Solid, usize),
    (b, edge_b): (&Solid, usize),
    axis: &Axis,
    slack: f64,
) -> Foot {
    let ([from_a, to_a], [from_b, to_b]) = (<[_; 2]>::from(a.edge(edge_a)), <[_; 2]>::from(b.edge(edge_b)));
    let (along_a, along_b, between) = (to_a - from_a, to_b - from_b, from_b - from_a);
    if axis.normal.dot(between) > axis.separation + 4.0 * slack {
        return Foot::Astray;
    }
    let area = axis.normal.dot(along_a.cross(along_b));
    // The end of an edge that the crossing is beyond, and how far, squared with its sign.
    let out = |other: DVec3, along: DVec3, (from, to): (usize, usize)| {
        let share = axis.normal.dot(between.cross(other)) / area;
        let (out, end, past) = if share < 0.5 { (-share, from, to) } else { (share - 1.0, to, from) };
        (out * out.abs() * along.length_squared(), end, past)
    };
    let (out_a, end_a, past_a) = out(along_b, along_a, a.topology.ends(edge_a));
    let (out_b, end_b, past_b) = out(along_a, along_b, b.topology.ends(edge_b));
    let side = if out_a > 0.0 && out_a >= out_b {
        Side::along_arc((b, edge_b), (a, end_a, past_a), false)
    } else if out_b > 0.0 {
        Side::along_arc((a, edge_a), (b, end_b, past_b), true)
    } else {
        return Foot::Inside;
    };
    side.map_or(Foot::Astray, Foot::Beyond)
}

impl Side {
    /// The side made of an edge and the end (`vertex`) of the other solid's edge, whose other end is `past`: its arc
    /// leads to the face against which `vertex` is the deeper one.
    fn along_arc(
        (solid, edge): (&Solid, usize),
        (other, vertex, past): (&Solid, usize, usize),
        is_of_a: bool,
    ) -> Option<Self> {
        let halves = solid.topology.half_edges();
        let faces =
            [edge, usize::from(halves[edge].twin)].map(|half_edge| usize::from(halves[half_edge].face));
        if faces.iter().any(|&face| face >= solid.face_count()) {
            return None;
        }
        let way = other.point(vertex) - other.point(past);
        let [one, twin] = faces.map(|face| solid.normal(face).dot(way));
        let face = if one < twin { faces[0] } else { faces[1] };
        Some(Self { is_of_a, edge, face, vertex })
    }

    /// The facet beyond this side: that of the first pair of edges whose arcs cross, else the face's.
    fn next_of(&self, (a, b): (&Solid, &Solid), normal: DVec3) -> AxisOf {
        if self.is_of_a {
            match self.crossing((a, b), normal) {
                Some(edge) => AxisOf::Edges(self.edge, edge),
                None => AxisOf::FaceA(self.face),
            }
        } else {
            match self.crossing((b, a), -normal) {
                Some(edge) => AxisOf::Edges(edge, self.edge),
                None => AxisOf::FaceB(self.face),
            }
        }
    }

    /// The edge at the vertex whose arc is crossed first on the way from an outward direction to the face's normal.
    fn crossing(&self, (solid, other): (&Solid, &Solid), outward: DVec3) -> Option<usize> {
        let (here, there) = (other.turned_back(outward), other.turned_back(solid.normal(self.face)));
        let from = other.vertices[self.vertex].as_dvec3();
        let (mut first, mut crossed) = (1.0, None);
        for &half_edge in other.topology.leaving(self.vertex) {
            let (_, to) = other.topology.ends(half_edge.into());
            let along = other.vertices[to].as_dvec3() - from;
            let (now, then) = (here.dot(along).max(0.0), there.dot(along));
            if then < 0.0 && now < first * (now - then) {
                (first, crossed) = (now / (now - then), Some(other.topology.edge_of(half_edge.into())));
            }
        }
        crossed
    }
}
