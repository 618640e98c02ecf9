//! From fifteen separations to the best axis, and a bound on how much better the truth may be.
//!
//! ```text
//! S = separation times the length of its axis, in closed form; D = 1.5 P bounds its error    (docs/accuracy.md, 2)
//! the best face is a lower bound b; an edge pair with S + D <= (b + slack) length cannot matter, whatever its angle
//! the others are normalised; the best of them counts if it beats the face
//! ```
//! `slack` is negligible beside the rounding of the answer to f32. Without it, the four edge pairs around two faces
//! that lie flat on each other, whose axes equal the faces', would all be examined. Also, a pair with D / length below
//! it needs no projection beyond its closed form.

use super::super::sat::{Axis, AxisOf};
use super::super::solid::corner_along;
use super::fifteen::closed_form;
use super::names;
use super::placed::Placed;
use crate::batch::beyond;
use crate::precision::at_least;
use asunder_geometry::Basis3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::PARALLEL_EDGES;

/// Share of a separation by which edges may beat it unnoticed: a sixteenth of half an ulp of f32.
pub(super) const SLACK: f64 = f32::EPSILON as f64 / 32.0;

/// What the fifteen axes show about two cores.
pub(super) enum Settled {
    /// This axis separates the shapes by more than the limit.
    Beyond(Axis),
    /// They overlap for certain.
    Overlapping(Best),
    /// A face separates the cores of sharp cuboids for certain, but not by more than the limit; edges were not
    /// examined. Or no face does, but edges do.
    Parted(Best),
    /// Neither is certain.
    Unclear,
}

/// The best axes of two cores; where a face shows a gap, those of faces only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    pub(super) face_a: Face,
    pub(super) face_b: Face,
    /// The best edge pair, if it is better than both faces.
    pub(super) edges: Option<Edges>,
    /// By how much the true separation may be above or below that of the best axis.
    pub(super) short: f64,
}

/// The best face of one cuboid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) separation: f64,
    pub(super) axis: usize,
}

/// One of nine edge pairs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edges {
    pub(super) separation: f64,
    pub(super) pair: usize,
}

impl Face {
    /// Of equals, the first.
    #[inline(always)]
    fn best(x: f64, y: f64, z: f64) -> Self {
        let (one, axis) = if y > x { (y, 1) } else { (x, 0) };
        let (separation, axis) = if z > one { (z, 2) } else { (one, axis) };
        Self { separation, axis }
    }
}

impl Best {
    /// The separation of the best axis. Ties: a face of A, then a face of B, then edges.
    #[inline(always)]
    pub(super) fn separation(&self) -> f64 {
        self.edges.map_or(self.of_faces(), |edges| edges.separation)
    }

    #[inline(always)]
    pub(super) fn of_faces(&self) -> f64 {
        if self.face_b.separation > self.face_a.separation {
            self.face_b.separation
        } else {
            self.face_a.separation
        }
    }

    /// The best axis of all.
    #[inline(always)]
    pub(super) fn axis(&self, placed: &Placed) -> Axis {
        match self.edges {
            Some(edges) => placed.edges(edges.pair),
            None if self.face_b.separation > self.face_a.separation => placed.face_b(self.face_b),
            None => placed.face_a(self.face_a),
        }
    }

    /// The feature of the best axis.
    #[inline(always)]
    pub(super) fn axis_of(&self, placed: &Placed) -> AxisOf {
        match self.edges {
            Some(edges) => placed.of_edges(edges.pair),
            None if self.face_b.separation > self.face_a.separation => placed.of_face_b(self.face_b.axis),
            None => placed.of_face_a(self.face_a.axis),
        }
    }
}

impl Placed {
    /// Error bound of the closed forms, times the axis' length.
    #[inline(always)]
    pub(super) fn closed_form(&self) -> f64 {
        closed_form(&self.precision)
    }

    /// The axis that separates the shapes by more than `limit` metres for certain. Of edge pairs, any edges along the
    /// two axes.
    #[inline(always)]
    pub(super) fn parted(&self, limit: f64) -> Option<AxisOf> {
        let by = self.fifteen.parted(limit + self.radii, &self.precision);
        parted_by(by, |axis| self.offset[axis] >= 0.0, |axis| self.fifteen.ahead.0[axis] >= 0.0)
    }

    /// By how much more than `limit` metres a face separates the shapes; 0 for edges.
    #[inline(always)]
    pub(super) fn beyond(&self, of: AxisOf, limit: f64) -> f32 {
        let separation = match of {
            AxisOf::FaceA(face) => self.fifteen.faces_a[face / 2],
            AxisOf::FaceB(face) => self.fifteen.faces_b.0[face / 2],
            AxisOf::Edges(..) => return 0.0,
        };
        beyond(at_least(separation - self.radii, &self.precision).into(), limit)
    }

    /// Whether the cores overlap for certain.
    #[inline(always)]
    pub(super) fn are_deep(&self) -> bool {
        self.fifteen.top() + self.closed_form() < 0.0
    }

    /// Whether an axis separates the shapes by more than `limit` metres, else the best axes.
    #[inline(always)]
    pub(super) fn settle(&self, limit: f64) -> Settled {
        let rounding = self.precision.projection();
        let limit = limit + self.radii + rounding;
        let ([ax, ay, az], [bx, by, bz, _]) = (self.fifteen.faces_a, self.fifteen.faces_b.0);
        let (face_a, face_b) = (Face::best(ax, ay, az), Face::best(bx, by, bz));
        let mut best = Best { face_a, face_b, edges: None, short: rounding };
        let separation = best.of_faces();
        if separation > limit {
            return Settled::Beyond(best.axis(self));
        }
        if separation > 2.0 * rounding && self.radii == 0.0 {
            return Settled::Parted(best);
        }
        let slack = separation.abs() * SLACK;
        best.short = if slack > rounding { slack } else { rounding };
        let matter = self.edges_that_matter(separation + slack);
        if matter != 0 {
            self.look_at_edges(matter, slack, &mut best);
            if let Some(edges) = best.edges.filter(|edges| edges.separation > limit) {
                let axis = self.edges(edges.pair);
                return if axis.separation > limit { Settled::Beyond(axis) } else { Settled::Unclear };
            }
            if best.edges.is_some_and(|edges| edges.separation > 2.0 * rounding) && self.radii == 0.0 {
                return Settled::Parted(best);
            }
        }
        if best.separation() + best.short < -2.0 * rounding {
            return Settled::Overlapping(best);
        }
        Settled::Unclear
    }

    /// The edge pairs whose separation may exceed `bound`, one bit each.
    #[inline(always)]
    fn edges_that_matter(&self, bound: f64) -> u32 {
        // For a gap, comparing squares proves nothing.
        if bound > 0.0 {
            return 0x1ff;
        }
        let (doubt, squared_bound) = (self.closed_form(), bound * bound);
        let mut matter = 0;
        for i in 0..3 {
            for j in 0..3 {
                let most = self.fifteen.edges[i].0[j] + doubt;
                let least_squared = squared_bound * self.fifteen.squared[i].0[j];
                let is_less = (most <= 0.0) & (most * most >= least_squared);
                matter |= u32::from(!is_less) << (3 * i + j);
            }
        }
        matter
    }

    /// Takes the best of some edge pairs if it beats the best face. Raises `short` to what the pairs leave open.
    #[inline(never)]
    fn look_at_edges(&self, matter: u32, slack: f64, best: &mut Best) {
        let (doubt, face) = (self.closed_form(), best.of_faces());
        let (mut separation, mut pair, mut lost) = (f64::NEG_INFINITY, 0, 0.0);
        let (mut ceiling, mut left_out, mut rest) = (f64::NEG_INFINITY, 0.0_f64, matter);
        while rest != 0 {
            let next = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let (scaled, squared) = self.fifteen.edge_pair(next);
            let inverse = 1.0 / squared.sqrt();
            if squared <= PARALLEL_EDGES * PARALLEL_EDGES {
                // As in `Axes::leave_out`. If the axis has no length at all, `by_axis` is NaN or infinite, and the
                // other one counts.
                let by_axis = (scaled + 2.0 * doubt) * inverse - face;
                left_out = left_out.max(self.precision.of_parallel_edges(squared).min(by_axis));
                continue;
            }
            let (found, may_lose) = (scaled * inverse, doubt * inverse);
            ceiling = if found + may_lose > ceiling { found + may_lose } else { ceiling };
            if found > separation {
                (separation, pair, lost) = (found, next, may_lose);
            }
        }
        // By more than rounding: where the faces lie flat on each other, their edges show the same up to that.
        let mut found = face;
        if separation > face + doubt {
            if lost > slack {
                separation = self.along(self.edge_normal(pair));
            }
            if separation > face {
                best.edges = Some(Edges { separation, pair });
                found = separation;
            }
        }
        best.short = best.short.max(ceiling - found).max(left_out);
    }

    #[inline(always)]
    pub(super) fn of_face_a(&self, axis: usize) -> AxisOf {
        face_of_a(axis, self.offset[axis] >= 0.0)
    }

    /// The face of B that faces A along an axis.
    #[inline(always)]
    pub(super) fn of_face_b(&self, axis: usize) -> AxisOf {
        face_of_b(axis, self.fifteen.ahead.0[axis] >= 0.0)
    }

    #[inline]
    pub(super) fn face_a(&self, Face { separation, axis }: Face) -> Axis {
        let normal = if self.offset[axis] >= 0.0 { DVec3::AXES[axis] } else { -DVec3::AXES[axis] };
        Axis { separation, normal, of: self.of_face_a(axis) }
    }

    #[inline]
    pub(super) fn face_b(&self, Face { separation, axis }: Face) -> Axis {
        let along = self.axis_b(axis);
        let normal = if self.fifteen.ahead.0[axis] < 0.0 { -along } else { along };
        Axis { separation, normal, of: self.of_face_b(axis) }
    }

    /// The axis of an edge pair, by full projection.
    pub(super) fn edges(&self, pair: usize) -> Axis {
        let normal = self.edge_normal(pair);
        Axis { separation: self.along(normal), normal, of: self.of_edges_along(pair, normal) }
    }

    pub(super) fn of_edges(&self, pair: usize) -> AxisOf {
        self.of_edges_along(pair, self.edge_normal(pair))
    }

    /// The edges that support an axis.
    pub(super) fn of_edges_along(&self, pair: usize, normal: DVec3) -> AxisOf {
        let edge_a = names::edge_through(corner_along(normal), pair / 3);
        let edge_b = names::edge_through(corner_along(self.relative.turn_back(-normal)), pair % 3);
        AxisOf::Edges(edge_a, edge_b)
    }

    /// The unit axis of an edge pair, from A to B. At equal centres either sense is right.
    #[inline]
    pub(super) fn edge_normal(&self, pair: usize) -> DVec3 {
        edge_normal(pair, self.axis_b(pair % 3), self.offset)
    }
}

#[inline(always)]
fn edge_normal(pair: usize, axis_b: DVec3, offset: DVec3) -> DVec3 {
    let normal = DVec3::AXES[pair / 3 % 3].cross(axis_b).normalize();
    if normal.dot(offset) < 0.0 { -normal } else { normal }
}

impl Best {
    /// The best axis in the world. Given are A's axes in the world, one of B's axes and B's centre as seen from A, and
    /// B's centre along B's axes.
    #[inline(always)]
    pub(super) fn normal(
        &self,
        basis: &Basis3,
        axis_b: impl FnOnce(usize) -> DVec3,
        offset: DVec3,
        ahead: impl FnOnce(usize) -> f64,
    ) -> DVec3 {
        let turned = |axis: DVec3, along: f64| if along >= 0.0 { axis } else { -axis };
        if let Some(Edges { pair, .. }) = self.edges {
            return basis.turn(edge_normal(pair, axis_b(pair % 3), offset));
        }
        if self.face_b.separation > self.face_a.separation {
            let j = self.face_b.axis;
            return basis.turn(turned(axis_b(j), ahead(j)));
        }
        let i = self.face_a.axis % 3;
        turned([basis.x, basis.y, basis.z][i], offset[i])
    }
}

#[inline(always)]
fn face_of_a(axis: usize, is_ahead: bool) -> AxisOf {
    AxisOf::FaceA(2 * axis + usize::from(is_ahead))
}

#[inline(always)]
fn face_of_b(axis: usize, is_ahead: bool) -> AxisOf {
    AxisOf::FaceB(2 * axis + usize::from(!is_ahead))
}

/// The axis that [`Fifteen::parted`](super::fifteen::Fifteen::parted) numbered, by whether B lies ahead on an axis of A
/// or of B.
#[inline(always)]
pub(super) fn parted_by(
    by: f64,
    of_a: impl FnOnce(usize) -> bool,
    of_b: impl FnOnce(usize) -> bool,
) -> Option<AxisOf> {
    let by = by as i32;
    match by as usize {
        _ if by < 0 => None,
        axis @ 0..3 => Some(face_of_a(axis, of_a(axis))),
        axis @ 3..6 => Some(face_of_b(axis - 3, of_b(axis - 3))),
        edges => {
            let pair = edges - 6;
            Some(AxisOf::Edges(names::edge_through(0, pair / 3), names::edge_through(0, pair % 3)))
        }
    }
}
