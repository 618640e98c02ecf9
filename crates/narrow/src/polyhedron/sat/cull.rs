//! Which faces and edges of a solid may bear the best axis at all, told by spheres inside the other solid.
//!
//! ```text
//! c, r   centre and radius of a sphere inside B;    n, h   a normal of A and how far A reaches along it
//! separation along n  =  min over B of n.x - max over A of n.x  <=  n.c - h - r
//! ```
//! That is one dot product a face. Along the arc of an edge, n.c - h is the projection of c, seen from a point of
//! the edge, on a unit vector that turns: a cosine. If it is greatest inside the arc, it is greater there than at
//! both ends by at most 1 / cos(t / 2) for an arc of t. What cannot come up to the best axis found so far is left out.
//!
//! 1. *The sphere* ("Inscribed spheres", box2d.org, September 2026) leaves 11 of 90 edges of a hull of 32 vertices,
//!    and 39 where they overlap deeply.
//! 2. *Points*: any vertex of B is a sphere of no radius. One that is furthest against some edge's normal mostly
//!    shows that edge, and its neighbours, to be deeper than the best, where the sphere, which lies in the middle,
//!    cannot. What is left is looked at one by one, and brings such a point each time.
//! 3. *Lanes*: eight faces or edges a step. One by one, with the same tests, took four times as long.
//! 4. *Neighbours in one octet*, of hulls with many edges: one point tells all eight. 256 vertices deep and turned,
//!    12 % less.
//!
//! f32 lanes with a bound on their rounding: nothing is left out wrongly.

use super::super::solid::Solid;
use super::MAX_EDGES;
use crate::counted::count_step;
use arrayvec::ArrayVec;
use asunder_geometry::glam::Vec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;
use asunder_geometry::{EdgeOctet, FaceOctet};

/// Eights of faces of a hull with the most vertices: no more than twice as many faces as vertices.
const MAX_OCTETS: usize = MAX_HULL_VERTICES / 4;

/// Vertices of the other solid that are kept.
const POINTS: usize = 8;

/// So many edges are handed on as they are: looking at one costs as much as its arc against some thirty others.
const FEW: usize = 32;

/// How far a sphere lies over each face of a solid, eight by eight.
pub(super) type Heights = ArrayVec<[f32; 8], MAX_OCTETS>;

/// What a solid's faces and edges see of the other solid.
pub(super) struct Sight<'a, 'b> {
    pub(super) solid: &'a Solid<'b>,
    pub(super) other: &'a Solid<'b>,
    sphere: Ball,
    /// How far the sphere lies over each face. It stays where it is: moved with the rest, all its room would be copied.
    over: &'a mut Heights,
    /// The one that told last comes first.
    points: ArrayVec<Ball, POINTS>,
    /// The place that was last given away.
    turn: usize,
}

/// A sphere inside the other solid, in the solid's own axes.
#[derive(Clone, Copy)]
struct Ball {
    center: Vec3,
    radius: f64,
    /// The most that can be lost to rounding of how far the centre lies over a face: conversions, products, sums
    /// and the height are below 6 units of 2^-24 of the terms' sum.
    doubt: f32,
}

/// What eight candidates may come to: 1 for those that may show enough, else 0. Numbers, so that lanes stay lanes.
type Open = [u32; 8];

const NONE_OPEN: Open = [0; 8];

impl<'a, 'b> Sight<'a, 'b> {
    pub(super) fn new(solid: &'a Solid<'b>, other: &'a Solid<'b>, over: &'a mut Heights) -> Self {
        let sphere = Ball::new(solid, solid.to_local(other.center()).as_vec3(), other.inner_radius);
        Self { solid, other, sphere, over, points: ArrayVec::new_const(), turn: 0 }
    }

    /// The face that the other's centre is furthest over; of equals the first.
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

    /// Takes a vertex of the other solid to tell by.
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

    /// Finds a place behind the first, in turns.
    fn keep(&mut self, old: Ball) {
        if let Err(full) = self.points.try_push(old) {
            self.turn = self.turn % (POINTS - 1) + 1;
            self.points[self.turn] = full.element();
        }
    }

    /// Visits faces whose axis may show `separation`, ascending. The visitor returns the vertex of the other solid
    /// that is furthest against the face, and what the next one must show.
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

    /// Edges with a normal along which the separation may come to `separation`, by their numbers, in the order of their
    /// octets.
    ///
    /// The middle of a half circle is told by none of its ends: flat solids keep all of their edges.
    pub(super) fn edges(&mut self, separation: f64, into: &mut ArrayVec<u16, MAX_EDGES>) {
        if self.solid.face_count() <= 2 {
            into.extend((0..self.solid.arcs().len() as u16).take(MAX_EDGES));
            return;
        }
        // Lanes, until it is known which are left.
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
        // Of fewer, lanes are numbers.
        if self.solid.arcs().len() >= EdgeOctet::SORTED_FROM {
            for edge in into {
                let lane = *edge as usize;
                *edge = self.solid.edge_octets()[lane / 8].numbers[lane % 8];
            }
        }
    }

    /// Asks for the vertex that is furthest against the middle of each edge's arc. It mostly settles that edge and
    /// some of its neighbours.
    fn look_closer(&mut self, separation: f64, lanes: &mut ArrayVec<u16, MAX_EDGES>) {
        let (mut kept, mut at) = (0, 0);
        let (mut asked, mut in_vain) = (0, 0);
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
                // Of shapes so symmetric that all are as good, none is settled.
                if asked < FEW || 8 * in_vain < 7 * asked {
                    let middle = self.solid.arcs()[octet.numbers[i] as usize].middle;
                    let middle = self.solid.turned(middle.as_dvec3().normalize_or_zero());
                    self.add(self.other.rough_support(-middle).0.vertex);
                    open = both(open, self.points[0].rises(octet, separation));
                    asked += 1;
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

    /// What the points leave open. The one that closes the last comes first the next time.
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

    /// What the ball must come to over a plane for the axis to show `separation`.
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

    /// Which of eight edges' arcs may come to show `separation`.
    #[inline]
    fn rises(&self, edges: &EdgeOctet, separation: f64) -> Open {
        let least = self.least(separation);
        let [left, right] = &edges.sides;
        let (over, other) = (self.over(left), self.over(right));
        let mut open = NONE_OPEN;
        // Below zero an arc comes to no more than its ends.
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
            // 1 / cos(t / 2) squared is 2 / (1 + cos t). Of blades, whose faces are all but back to back, the sum
            // is largely the cosine's rounding, half a unit: without that, what is left is too small and nothing is
            // left out wrongly.
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
