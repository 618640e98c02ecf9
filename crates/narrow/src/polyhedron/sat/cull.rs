//! Which faces and edges of a solid may give the best axis at all, decided by spheres inside the other solid.
//!
//! ```text
//! c, r   centre and radius of a sphere inside B;    n, h   a normal of A and how far A reaches along it
//! separation along n  =  min over B of n.x - max over A of n.x  <=  n.c - h - r
//! ```
//! That is one dot product a face. Along the arc of an edge, n.c - h is the projection of c, taken from a point of the
//! edge, on a rotating unit vector: a cosine. If its maximum lies inside the arc, it is at most 1 / cos(t / 2) times
//! the greater of both ends, for an arc of angle t. Whatever cannot come up to the best axis found so far is left out.
//!
//! 1. *The sphere* ("Inscribed spheres", box2d.org, September 2026) leaves 11 of 90 edges of a hull of 32 vertices,
//!    and 39 where they overlap deeply.
//! 2. *Points*: any vertex of B is a sphere of radius zero. The support vertex against some edge's normal mostly shows
//!    that this edge and its neighbours are deeper than the best axis, where the sphere, which lies in the middle,
//!    cannot. The edges that are left are examined one by one, and each contributes such a point.
//! 3. *Lanes*: eight faces or edges a step. One by one, with the same tests, took four times as long.
//! 4. *Neighbours in one octet*, for hulls with many edges: one point mostly decides all eight. 256 vertices, deep and
//!    rotated: 12 % less.
//!
//! The lanes are f32 with a bound on their rounding: nothing is left out wrongly.

use super::super::solid::Solid;
use super::MAX_EDGES;
use crate::counted::count_step;
use arrayvec::ArrayVec;
use asunder_geometry::glam::Vec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;
use asunder_geometry::{EdgeOctet, FaceOctet};

/// Octets of faces of a hull with the most vertices: it has at most twice as many faces as vertices.
const MAX_OCTETS: usize = MAX_HULL_VERTICES / 4;

/// Vertices of the other solid that are kept.
const POINTS: usize = 8;

/// Up to this many edges are passed on without a closer look: one look costs as much as testing the edge's arc against
/// some thirty others.
const FEW: usize = 32;

/// How far a sphere's centre lies over each face of a solid, eight by eight.
pub(super) type Heights = ArrayVec<[f32; 8], MAX_OCTETS>;

/// The spheres of the other solid by which a solid's faces and edges are culled.
pub(super) struct Sight<'a, 'b> {
    pub(super) solid: &'a Solid<'b>,
    pub(super) other: &'a Solid<'b>,
    sphere: Ball,
    /// How far the sphere's centre lies over each face. Borrowed: moved with the rest, its full capacity would be
    /// copied.
    over: &'a mut Heights,
    /// The one that was last added or last ruled something out comes first.
    points: ArrayVec<Ball, POINTS>,
    /// The slot that was overwritten last.
    turn: usize,
}

/// A sphere inside the other solid, in the solid's own axes.
#[derive(Clone, Copy)]
struct Ball {
    center: Vec3,
    radius: f64,
    /// A bound on the rounding of how far the centre lies over a face: conversions, products, sums and the height are
    /// together off by less than 6 units of 2^-24 of the terms' sum.
    doubt: f32,
}

/// The state of eight candidates: 1 for those that may show enough, else 0. Numbers, so that loops stay vectorised.
type Open = [u32; 8];

const NONE_OPEN: Open = [0; 8];

impl<'a, 'b> Sight<'a, 'b> {
    pub(super) fn new(solid: &'a Solid<'b>, other: &'a Solid<'b>, over: &'a mut Heights) -> Self {
        let sphere = Ball::new(solid, solid.to_local(other.center()).as_vec3(), other.inner_radius);
        Self { solid, other, sphere, over, points: ArrayVec::new_const(), turn: 0 }
    }

    /// The face that the other solid's centre is furthest above; on ties, the first.
    pub(super) fn highest(&mut self) -> Option<usize> {
        let mut top = [f32::NEG_INFINITY; 8];
        for faces in self.solid.face_octets().iter().take(MAX_OCTETS) {
            let over = self.sphere.over(faces);
            for (i, top) in top.iter_mut().enumerate() {
                *top = if over[i] > *top { over[i] } else { *top };
            }
            self.over.push(over);
        }
        let top = top.into_iter().fold(f32::NEG_INFINITY, f32::max);
        let place = self.over.iter().position(|over| over.contains(&top))?;
        let i = self.over[place].iter().position(|&over| over == top)?;
        Some(8 * place + i)
    }

    /// Adds a vertex of the other solid as a point to cull by.
    pub(super) fn add(&mut self, vertex: usize) {
        let point = self.solid.to_local(self.other.point(vertex)).as_vec3();
        let new = Ball::new(self.solid, point, 0.0);
        match self.points.first_mut() {
            Some(first) => {
                let old = core::mem::replace(first, new);
                self.keep(old);
            }
            None => self.points.push(new),
        }
    }

    /// Stores a point behind the first one, overwriting the slots in turn.
    fn keep(&mut self, old: Ball) {
        if let Err(full) = self.points.try_push(old) {
            self.turn = self.turn % (POINTS - 1) + 1;
            self.points[self.turn] = full.element();
        }
    }

    /// Visits faces whose axis may show `separation`, in ascending order. The visitor returns the other solid's deepest
    /// vertex against the face, and the separation that the next face must show.
    pub(super) fn for_faces(&mut self, mut separation: f64, mut visit: impl FnMut(usize) -> (usize, f64)) {
        for place in 0..self.over.len() {
            let mut open = above(&self.over[place], self.sphere.least(separation));
            if open == NONE_OPEN {
                continue;
            }
            let faces = &self.solid.face_octets()[place];
            open = self.closed_by_points(open, |ball| above(&ball.over(faces), ball.least(separation)));
            while let Some(i) = open.iter().position(|&lane| lane != 0) {
                let (vertex, next) = visit(8 * place + i);
                separation = next;
                self.add(vertex);
                let ball = self.points[0];
                open[i] = 0;
                open = both(open, above(&ball.over(faces), ball.least(separation)));
            }
        }
    }

    /// Collects the numbers of edges with a normal along which the separation may come to `separation`, in the order of
    /// their octets.
    ///
    /// The ends of a half circle say nothing about its middle: flat solids keep all of their edges.
    pub(super) fn edges(&mut self, separation: f64, into: &mut ArrayVec<u16, MAX_EDGES>) {
        if self.solid.face_count() <= 2 {
            into.extend((0..self.solid.arcs().len() as u16).take(MAX_EDGES));
            return;
        }
        // Lane indices, until it is known which are left.
        for (place, edges) in self.solid.edge_octets().iter().enumerate() {
            let mut open = self.sphere.rises(edges, separation);
            if open == NONE_OPEN {
                continue;
            }
            open = self.closed_by_points(open, |ball| ball.rises(edges, separation));
            into.extend((8 * place as u16..).zip(open).filter(|&(_, lane)| lane != 0).map(|(edge, _)| edge));
        }
        if into.len() > FEW {
            self.look_closer(separation, into);
        }
        // With fewer edges, lane indices are edge numbers.
        if self.solid.arcs().len() >= EdgeOctet::SORTED_FROM {
            for edge in into {
                let lane = *edge as usize;
                *edge = self.solid.edge_octets()[lane / 8].numbers[lane % 8];
            }
        }
    }

    /// Adds the other solid's support vertex against the middle of each edge's arc. It mostly rules out that edge and
    /// some of its neighbours.
    fn look_closer(&mut self, separation: f64, lanes: &mut ArrayVec<u16, MAX_EDGES>) {
        let (mut kept, mut at) = (0, 0);
        let (mut tested, mut in_vain) = (0, 0);
        while let Some(&first) = lanes.get(at) {
            let place = first / 8;
            let mut open = NONE_OPEN;
            while let Some(&lane) = lanes.get(at).filter(|&&lane| lane / 8 == place) {
                open[lane as usize % 8] = 1;
                at += 1;
            }
            let octet = &self.solid.edge_octets()[place as usize];
            open = self.closed_by_points(open, |ball| ball.rises(octet, separation));
            while let Some(i) = open.iter().position(|&lane| lane != 0) {
                // Given up where too few are ruled out: on shapes so symmetric that all edges are as good, none is.
                if tested < FEW || 8 * in_vain < 7 * tested {
                    let middle = self.solid.arcs()[octet.numbers[i] as usize].middle;
                    let middle = self.solid.turned(middle.as_dvec3().normalize_or_zero());
                    self.add(self.other.rough_support(-middle).0.vertex);
                    open = both(open, self.points[0].rises(octet, separation));
                    tested += 1;
                    in_vain += open[i] as usize;
                }
                if open[i] != 0 {
                    lanes[kept] = 8 * place + i as u16;
                    kept += 1;
                }
                open[i] = 0;
            }
        }
        lanes.truncate(kept);
    }

    /// The candidates that the points leave open. The point that closes the last of them comes first the next time.
    fn closed_by_points(&mut self, mut open: Open, open_by: impl Fn(&Ball) -> Open) -> Open {
        for place in 0..self.points.len() {
            open = both(open, open_by(&self.points[place]));
            if open == NONE_OPEN {
                self.points.swap(0, place);
                break;
            }
        }
        open
    }
}

impl Ball {
    fn new(solid: &Solid, center: Vec3, radius: f64) -> Self {
        let doubt = 4.0 * f32::EPSILON * (center.abs().element_sum() + 2.0 * solid.extent);
        Self { center, radius, doubt }
    }

    /// How far over a plane the ball's centre must be for the axis to show `separation`.
    fn least(&self, separation: f64) -> f32 {
        ((separation + self.radius) as f32).next_down()
    }

    /// How far the centre lies over eight faces, rounded up.
    #[inline]
    fn over(&self, faces: &FaceOctet) -> [f32; 8] {
        count_step();
        let c = self.center;
        let mut over = [0.0; 8];
        for (i, over) in over.iter_mut().enumerate() {
            *over = c.x * faces.x[i] + c.y * faces.y[i] + c.z * faces.z[i] - faces.height[i] + self.doubt;
        }
        over
    }

    /// Which of eight edges' arcs may show `separation`.
    #[inline]
    fn rises(&self, edges: &EdgeOctet, separation: f64) -> Open {
        let least = self.least(separation);
        let [left, right] = &edges.sides;
        let (over, other) = (self.over(left), self.over(right));
        let mut open = NONE_OPEN;
        // At or below zero an arc comes to `least` only where one of its ends does.
        if least <= 0.0 {
            for (i, open) in open.iter_mut().enumerate() {
                *open = u32::from((over[i] > least) | (other[i] > least));
            }
            return open;
        }
        let (square, slack) = (least * least, 4.0 * self.doubt);
        for (i, open) in open.iter_mut().enumerate() {
            let (over, other, cosine) = (over[i], other[i], edges.cosine[i]);
            let higher = if over > other { over } else { other };
            // Greatest inside the arc only where it rises from both ends.
            let is_inside =
                (other + slack > cosine * over) & (over + slack > cosine * other) & (higher > 0.0);
            // 1 / cos(t / 2) squared is 2 / (1 + cos t). For blades, whose faces are nearly back to back, the sum is
            // largely the cosine's rounding, half a unit. With that subtracted it is too small if anything, and nothing
            // is left out wrongly.
            let opening = 1.0 + cosine - f32::EPSILON / 2.0;
            let does_rise = is_inside & (2.001 * higher * higher > square * opening);
            *open = u32::from((higher > least) | does_rise);
        }
        open
    }
}

#[inline]
fn above(over: &[f32; 8], least: f32) -> Open {
    let mut open = NONE_OPEN;
    for (i, open) in open.iter_mut().enumerate() {
        *open = u32::from(over[i] > least);
    }
    open
}

#[inline]
fn both(one: Open, other: Open) -> Open {
    let mut both = NONE_OPEN;
    for (i, both) in both.iter_mut().enumerate() {
        *both = one[i] & other[i];
    }
    both
}

#[cfg(test)]
mod tests;
