//! How deep two convex hulls overlap: the best of all axes that can decide it, each by full projection.
//!
//! ```text
//! Two hulls overlap where the set D of all differences of their points contains the origin, and the separation is
//! minus the distance from the origin to the nearest facet of D. A facet of a Minkowski sum is a facet of A and a
//! vertex of B, or vice versa, or an edge of each (or facets of both, or a facet and an edge, whose normal is that
//! facet's). So: every facet normal of A and, negated, of B; every cross product of edges, both ways.
//!   f64     the gap along each; a pair of edges only if the vertices beside them allow both edges to support the axis
//!   dd      all that come within 1e-11 of the best, again
//! ```
//! Any axis gives a true lower bound, so that extra ones do no harm. None is missing: facets are exact, and what f64
//! leaves out is certain to lose. The axis of two edges at an angle t is known to about 1e-30 / t, and without it only
//! a sliver of a facet would be missed whose width is t of the edges: no more than 1e-15 can be lost, at t = 1e-15, and
//! next to nothing where edges are exactly parallel. Where neither hull has an interior D may be flat, and axes across
//! it are added, along which the gap is 0.

use super::dd::{Dd, Dd3};
use super::exactly::exact_cross;
use super::facets::Polyhedron;
use super::nearest::{Cloud, gap_along};
use glam::DVec3;

/// A posed hull. Directions are taken from stored points, whose differences are exact: a facet of 1e-45 m would vanish
/// next to larger coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Hull<'a> {
    /// The points.
    pub cloud: &'a Cloud,
    /// The same points as stored.
    pub stored: &'a [DVec3],
    /// The images of the coordinate axes.
    pub turn: &'a [Dd3; 3],
}

/// A hull in space with its facets and edges.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// The hull.
    pub hull: Hull<'a>,
    /// Its facets and edges.
    pub form: &'a Polyhedron,
}

/// The best axis found.
#[derive(Clone, Copy, Debug)]
pub struct Deepest {
    /// The gap along it: the separation, unless it is positive.
    pub gap: Dd,
    /// The unit axis, from A to B.
    pub axis: Dd3,
    /// Whether no other axis is as good, within 1e-13 of the size.
    pub is_unique: bool,
    /// What may be lost by the rounding of the worst axis, as a share of the size.
    pub regret: f64,
}

/// An axis and the gap along it in f64.
type Rough = (f64, Dd3);

/// A generous bound on the error of a gap in f64, as a share of the size.
const ROUGH: f64 = 1e-11;

/// The error of a vector between two points in double-double, relative to the largest coordinates.
const ROUNDING: f64 = 1e-30;

impl Hull<'_> {
    /// From one point to another, not yet rotated.
    fn arm(&self, from: usize, to: usize) -> Dd3 {
        Dd3::difference(self.stored[to], self.stored[from])
    }

    /// A stored direction, rotated and normalised.
    fn turned(&self, v: Dd3) -> Option<Dd3> {
        let v = v.try_normalize()?;
        (self.turn[0] * v.x + self.turn[1] * v.y + self.turn[2] * v.z).try_normalize()
    }
}

/// The best axis for two hulls that overlap or touch.
pub fn deepest3(a: Body, b: Body) -> Deepest {
    let mut axes = facet_axes(a);
    axes.extend(facet_axes(b).into_iter().map(|axis| -axis));
    if !a.form.is_solid && !b.form.is_solid {
        axes.extend(flat_axes(a, b));
    }
    let mut rough: Vec<Rough> = axes.into_iter().map(|axis| (rough_gap(a, b, axis.to_f64()), axis)).collect();
    let regret = edge_axes(a, b, &mut rough);
    best_of(a.hull.cloud, b.hull.cloud, &rough, regret)
}

/// The best of some axes with known f64 gaps.
pub fn best_of(a: &Cloud, b: &Cloud, rough: &[Rough], regret: f64) -> Deepest {
    let size = a.reach() + b.reach();
    let most = rough.iter().map(|axis| axis.0).fold(f64::NEG_INFINITY, f64::max);
    let near = rough.iter().filter(|axis| axis.0 >= most - ROUGH * size);
    let exact: Vec<(Dd, Dd3)> = near.map(|&(_, axis)| (gap_along(a, b, axis), axis)).collect();
    let later_if_greater = |best: (Dd, Dd3), next: &(Dd, Dd3)| if next.0 > best.0 { *next } else { best };
    let start = (Dd::from(f64::NEG_INFINITY), Dd3::new(1.0, 0.0, 0.0));
    let (gap, axis) = exact.iter().fold(start, later_if_greater);
    let is_other = |other: &(Dd, Dd3)| {
        (gap - other.0).to_f64() <= 1e-13 * size && (other.1 - axis).to_f64().length() > 1e-6
    };
    Deepest { gap, axis, is_unique: !exact.iter().any(is_other), regret }
}

/// The unit normals of all facets, each from the largest triangle at its first corner.
fn facet_axes(body: Body) -> Vec<Dd3> {
    let hull = &body.hull;
    let normal = |facet: &Vec<usize>| {
        let arm = |i: usize| hull.arm(facet[0], facet[i]);
        let rough = |i: usize| arm(i).to_f64();
        let far = (1..facet.len()).max_by(|&i, &j| rough(i).length().total_cmp(&rough(j).length()))?;
        let wide = |i: usize| rough(far).cross(rough(i)).length();
        let off = (1..facet.len()).filter(|&i| i != far).max_by(|&i, &j| wide(i).total_cmp(&wide(j)))?;
        let (second, third) = (far.min(off), far.max(off));
        let cross = arm(second).cross(arm(third));
        // The normal of a sliver would keep too few digits; that of a box 1e-45 m thick, none.
        let is_short = cross.to_f64().length() < 1e-4 * rough(far).length() * rough(off).length();
        hull.turned(if is_short {
            exact_cross(hull.stored, [facet[0], facet[second], facet[third]])
        } else {
            cross
        })
    };
    body.form.facets.iter().filter_map(normal).collect()
}

/// Axes across flat bodies: with them, a set of differences without an interior has the gap 0.
fn flat_axes(a: Body, b: Body) -> Vec<Dd3> {
    let units = DVec3::AXES.map(Dd3::from);
    let mut axes = units.to_vec();
    for body in [a, b] {
        for edge in &body.form.edges {
            let along = body.hull.turned(body.hull.arm(edge.ends[0], edge.ends[1]));
            axes.extend(units.iter().filter_map(|&unit| along?.cross(unit).try_normalize()));
        }
    }
    axes.into_iter().flat_map(|axis| [axis, -axis]).collect()
}

/// Adds the axis of every pair of edges that can support both hulls; returns the most that their errors can cost.
fn edge_axes(a: Body, b: Body, rough: &mut Vec<Rough>) -> f64 {
    let along = |body: Body| -> Vec<Dd3> {
        let ends = body.form.edges.iter().map(|edge| edge.ends);
        ends.map(|[from, to]| body.hull.turned(body.hull.arm(from, to)).expect("ends differ")).collect()
    };
    let (of_a, of_b) = (along(a), along(b));
    let [rough_a, rough_b] = [&of_a, &of_b].map(|of| of.iter().map(|d| d.to_f64()).collect::<Vec<DVec3>>());
    let mut regret: f64 = 0.0;
    for i in 0..of_a.len() {
        for j in 0..of_b.len() {
            let mut cross = rough_a[i].cross(rough_b[j]);
            // A short cross product of f64 directions has no reliable direction: it is recomputed in double-double.
            if cross.length_squared() < 1e-6 {
                let exact = of_a[i].cross(of_b[j]);
                let length = exact.to_f64().length();
                regret = regret.max(4.0 * length.min(ROUNDING / length));
                if length < 1e-24 {
                    continue;
                }
                cross = exact.to_f64() / length;
            }
            let axis = cross.normalize();
            for axis in [axis, -axis] {
                if supports(a, i, axis) && supports(b, j, -axis) {
                    let exact = of_a[i].cross(of_b[j]).try_normalize();
                    let turned =
                        exact.map(|exact| if exact.to_f64().dot(axis) < 0.0 { -exact } else { exact });
                    rough.extend(turned.map(|turned| (rough_gap(a, b, axis), turned)));
                }
            }
        }
    }
    regret
}

/// Whether the vertices beside an edge allow it to be the furthest feature along an axis perpendicular to it.
fn supports(body: Body, edge: usize, axis: DVec3) -> bool {
    let points = body.hull.cloud.rough();
    let edge = &body.form.edges[edge];
    let level = points[edge.ends[0]].dot(axis) + 1e-11 * body.hull.cloud.reach();
    edge.beside.iter().all(|&vertex| points[vertex].dot(axis) <= level)
}

fn rough_gap(a: Body, b: Body, axis: DVec3) -> f64 {
    let reach = |body: Body, axis: DVec3| {
        body.hull.cloud.rough().iter().map(|p| p.dot(axis)).fold(f64::NEG_INFINITY, f64::max)
    };
    -reach(b, -axis) - reach(a, axis)
}

/// The best axis for two outlines in the plane that overlap or touch: the normals of all edges, both ways for a
/// segment.
pub fn deepest2(a: (Hull, &[usize]), b: (Hull, &[usize])) -> Deepest {
    let normals = |(hull, outline): (Hull, &[usize])| -> Vec<Dd3> {
        let ends = (0..outline.len()).map(|i| (outline[i], outline[(i + 1) % outline.len()]));
        let along = ends.filter_map(|(from, to)| hull.turned(hull.arm(from, to)));
        along.map(|along| Dd3 { x: along.y, y: -along.x, z: Dd::ZERO }).collect()
    };
    let mut axes = normals(a);
    axes.extend(normals(b).into_iter().map(|axis| -axis));
    if axes.is_empty() {
        axes = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y].map(Dd3::from).to_vec();
    }
    let blocks = [a, b].map(|(hull, outline)| Blocks::new(hull.cloud, outline));
    let gap = |axis: DVec3| -blocks[1].reach(-axis) - blocks[0].reach(axis);
    let rough: Vec<Rough> = axes.into_iter().map(|axis| (gap(axis.to_f64()), axis)).collect();
    best_of(a.0.cloud, b.0.cloud, &rough, 0.0)
}

/// Points in runs with a bounding ball for each, to find the furthest along an axis without testing all of them. Any
/// order is correct; a good one makes it fast.
struct Blocks {
    points: Vec<DVec3>,
    /// Centre and radius.
    balls: Vec<(DVec3, f64)>,
    length: usize,
}

impl Blocks {
    fn new(cloud: &Cloud, outline: &[usize]) -> Self {
        let points: Vec<DVec3> = outline.iter().map(|&i| cloud.rough()[i]).collect();
        let length = points.len().isqrt().max(8);
        let ball = |run: &[DVec3]| {
            let center = run.iter().sum::<DVec3>() / run.len() as f64;
            (center, run.iter().map(|p| p.distance(center)).fold(0.0, f64::max))
        };
        Self { balls: points.chunks(length).map(ball).collect(), points, length }
    }

    /// The greatest projection on a unit axis, within rounding.
    fn reach(&self, axis: DVec3) -> f64 {
        let centers: Vec<f64> = self.balls.iter().map(|ball| ball.0.dot(axis)).collect();
        let mut most = centers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        for (run, (center, ball)) in self.points.chunks(self.length).zip(centers.iter().zip(&self.balls)) {
            if center + ball.1 > most {
                most = run.iter().map(|p| p.dot(axis)).fold(most, f64::max);
            }
        }
        most
    }
}
