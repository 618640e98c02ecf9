//! Exact facets of a convex hull by quickhull, which adds the furthest point first.
//!
//! ```text
//! 1 start with a tetrahedron of far-apart points; every other point waits at (joins the outside set of) the facet that
//!   it lies furthest outside of
//! 2 of all waiting points take the one that is furthest from the plane of its facet
//! 3 the facets that it lies strictly outside of are connected: find them from this one, neighbour by neighbour
//! 4 their border is the horizon: join each edge of it to the point, and drop the facets seen from the point
//! 5 points that waited at dropped facets now wait at one of the new facets, or are inside for good
//! 6 repeat from 2 until no point waits or none may be added; then join coplanar triangles into facets
//! ```
//! Barber, Dobkin and Huhdanpaa, "The quickhull algorithm for convex hulls" (1996), over exact determinants (Shewchuk
//! 1997). A point in a facet's plane does not count as outside of it. So new triangles at the horizon are never
//! degenerate: a point on the line of a horizon edge would lie in the plane of a facet that it is strictly outside of.
//! Only "furthest" is a rounded number. It decides nothing but the order and, where the search stops early, keeps what
//! is left out small. Cost: about n log n.

use super::HullError;
use super::loops::Loops;
use super::predicate::{Filter, affine_basis, is_collinear, outside, planar_hull};
use crate::counted::count_step;
use crate::tolerance::MAX_HULL_VERTICES;
use core::cmp::Reverse;
use glam::{DVec3, Vec3};
use std::collections::BinaryHeap;

/// Stands for no point or no triangle.
const NONE: u32 = u32::MAX;

/// A triangle of the growing hull.
#[derive(Clone)]
struct Triangle {
    /// Counter-clockwise from outside.
    corners: [u32; 3],
    /// The triangle across the edge from corner `i` to the next.
    neighbours: [u32; 3],
    /// The first corner, and the normal, whose length is twice the area.
    origin: DVec3,
    normal: DVec3,
    /// One over the normal's length, or zero if that is too small.
    per_length: f64,
    /// The rounding error of a height times the normal's length.
    slack: f64,
    /// Head of the list of points that wait here, linked by `waits_after`.
    first_waiting: u32,
    /// Seen by a point that was added. It stays in the list, so that indices stay valid.
    is_dropped: bool,
}

impl Triangle {
    /// Height above the plane times the normal's length, rounded.
    #[inline]
    fn reach(&self, point: Vec3) -> f64 {
        self.normal.dot(point.as_dvec3() - self.origin)
    }
}

/// How "furthest" is measured.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Measure {
    /// Height above the highest plane that a point is outside of: cheap, and all that the exact hull needs.
    Height,
    /// Distance to the nearest of the triangles that it is outside of. This measures what an early stop leaves out even
    /// at the rim of a thin disc, where heights are small.
    Distance,
}

/// A hull that grows by its furthest points.
#[derive(Clone)]
pub(super) struct Growth<'a> {
    points: &'a [Vec3],
    filter: Filter,
    measure: Measure,
    /// How many points it has been made from.
    count: usize,
    triangles: Vec<Triangle>,
    waits_after: Vec<u32>,
    /// The furthest waiting point of each triangle, keyed by the bits of its distance, the point, and the triangle.
    furthest: BinaryHeap<(u64, Reverse<u32>, Reverse<u32>)>,
    /// Scratch: the horizon edge that starts at a point.
    border_from: Vec<u32>,
}

/// Facets as vertex loops, counter-clockwise from outside, with no three corners on a line, in canonical order.
///
/// The points must be finite and no two the same.
pub(super) fn hull_facets(points: &[Vec3]) -> Result<Loops, HullError> {
    let mut growth = Growth::start(points, Measure::Height)?;
    growth.grow_while(|_, _| true);
    Ok(growth.facets())
}

impl<'a> Growth<'a> {
    /// Makes the first tetrahedron. The points must be finite and no two the same.
    pub(super) fn start(points: &'a [Vec3], measure: Measure) -> Result<Self, HullError> {
        let basis = match far_apart(points) {
            Some(basis) => basis,
            None => affine_basis(points).map_err(|dimension| HullError::Flat { dimension })?,
        };
        let mut growth = Self {
            points,
            filter: Filter::of(points),
            measure,
            count: 4,
            // A vertex has some six triangles on average.
            triangles: Vec::with_capacity(6 * points.len().min(MAX_HULL_VERTICES)),
            waits_after: vec![NONE; points.len()],
            furthest: BinaryHeap::new(),
            border_from: vec![NONE; points.len()],
        };
        let [a, b, c, d] = basis;
        // Orients the base so that the fourth point lies inside of its plane.
        let (b, c) = if outside(points, [a, b, c], d) < 0.0 { (b, c) } else { (c, b) };
        for (corners, neighbours) in
            [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])]
        {
            growth.push(corners, neighbours);
        }
        let waiting: Vec<u32> = (0..points.len() as u32).filter(|i| !basis.contains(i)).collect();
        growth.distribute(&waiting, 0);
        Ok(growth)
    }

    /// Adds the furthest waiting point as long as `go_on` agrees, which is given the number of points so far and how
    /// far outside the next one lies. Returns whether no point waits any more.
    pub(super) fn grow_while(&mut self, mut go_on: impl FnMut(usize, f64) -> bool) -> bool {
        let mut orphans: Vec<u32> = Vec::new();
        while let Some(&(distance, Reverse(apex), Reverse(first))) = self.furthest.peek() {
            if self.triangles[first as usize].is_dropped {
                self.furthest.pop();
                continue;
            }
            if !go_on(self.count, f64::from_bits(distance)) {
                return false;
            }
            self.furthest.pop();
            self.count += 1;
            let seen = self.seen_from(first, apex);
            let horizon = self.horizon(&seen);
            orphans.clear();
            for &index in &seen {
                let mut next = self.triangles[index as usize].first_waiting;
                while next != NONE {
                    if next != apex {
                        orphans.push(next);
                    }
                    next = self.waits_after[next as usize];
                }
            }
            let new = self.triangles.len();
            self.join(&horizon, apex);
            self.distribute(&orphans, new);
        }
        true
    }

    /// How far the fourth point of the first tetrahedron was from the plane of the others, in metres.
    pub(super) fn first_height(&self) -> f64 {
        let (base, apex) = (&self.triangles[0], self.triangles[1].corners[2]);
        base.reach(self.points[apex as usize]).abs() * base.per_length
    }

    fn push(&mut self, corners: [u32; 3], neighbours: [u32; 3]) {
        let [a, b, c] = corners.map(|i| self.points[i as usize].as_dvec3());
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let per_length = normal.length().recip();
        self.triangles.push(Triangle {
            corners,
            neighbours,
            origin: a,
            normal,
            per_length: if per_length.is_finite() { per_length } else { 0.0 },
            slack: self.filter.slack(u, v),
            first_waiting: NONE,
            is_dropped: false,
        });
    }

    /// Whether a point lies strictly outside of a triangle's plane: exact.
    #[inline]
    fn is_outside(&self, triangle: &Triangle, point: u32) -> bool {
        let reach = triangle.reach(self.points[point as usize]);
        if reach > triangle.slack {
            true
        } else if reach < -triangle.slack || self.filter.is_exact() {
            false
        } else {
            outside(self.points, triangle.corners, point) > 0.0
        }
    }

    /// Assigns each point to one of the newest triangles that it is strictly outside of; the others are inside for
    /// good.
    ///
    /// For the exact hull any such triangle would do. The choice affects the order, and so what an early stop leaves
    /// out.
    fn distribute(&mut self, waiting: &[u32], first_new: usize) {
        let mut furthest = vec![(f64::NEG_INFINITY, NONE); self.triangles.len() - first_new];
        for &point in waiting {
            let Some((distance, index)) = self.place_to_wait(point, first_new) else { continue };
            let triangle = &mut self.triangles[index];
            self.waits_after[point as usize] = triangle.first_waiting;
            triangle.first_waiting = point;
            let best = &mut furthest[index - first_new];
            if distance > best.0 || (distance == best.0 && point < best.1) {
                *best = (distance, point);
            }
        }
        for (index, (distance, point)) in (first_new as u32..).zip(furthest) {
            if point != NONE {
                // The bits of non-negative numbers have their order.
                self.furthest.push((distance.max(0.0).to_bits(), Reverse(point), Reverse(index)));
            }
        }
    }

    /// Which of the newest triangles a point waits at, and how far outside it counts as.
    #[inline]
    fn place_to_wait(&self, point: u32, first_new: usize) -> Option<(f64, usize)> {
        let place = self.points[point as usize];
        let mut found: Option<(f64, usize)> = None;
        for (index, triangle) in self.triangles.iter().enumerate().skip(first_new) {
            count_step();
            if self.measure == Measure::Height {
                let height = triangle.reach(place) * triangle.per_length;
                let is_better = found.is_none_or(|best| height > best.0);
                if is_better && self.is_outside(triangle, point) {
                    found = Some((height, index));
                }
            } else if self.is_outside(triangle, point) {
                let distance = self.distance_to(index, place);
                if found.is_none_or(|best| distance < best.0) {
                    found = Some((distance, index));
                }
            }
        }
        found
    }

    fn distance_to(&self, triangle: usize, place: Vec3) -> f64 {
        let corners = self.triangles[triangle].corners.map(|i| self.points[i as usize].as_dvec3());
        super::distance::to_triangle(place.as_dvec3(), corners)
    }

    /// Finds the triangles that `apex` lies strictly outside of, starting from one of them, and marks them as dropped.
    fn seen_from(&mut self, first: u32, apex: u32) -> Vec<u32> {
        self.triangles[first as usize].is_dropped = true;
        let mut seen = vec![first];
        let mut next = 0;
        while next < seen.len() {
            for neighbour in self.triangles[seen[next] as usize].neighbours {
                count_step();
                let triangle = &self.triangles[neighbour as usize];
                if !triangle.is_dropped && self.is_outside(triangle, apex) {
                    self.triangles[neighbour as usize].is_dropped = true;
                    seen.push(neighbour);
                }
            }
            next += 1;
        }
        seen
    }

    /// The horizon, the edges between triangles that are seen and others, in order around: start, end, triangle beyond.
    fn horizon(&mut self, seen: &[u32]) -> Vec<(u32, u32, u32)> {
        let mut edges = Vec::new();
        for &index in seen {
            let Triangle { corners, neighbours, .. } = &self.triangles[index as usize];
            for i in 0..3 {
                if !self.triangles[neighbours[i] as usize].is_dropped {
                    self.border_from[corners[i] as usize] = edges.len() as u32;
                    edges.push((corners[i], corners[(i + 1) % 3], neighbours[i]));
                }
            }
        }
        let mut around = Vec::with_capacity(edges.len());
        let mut at = 0;
        while around.len() < edges.len() {
            around.push(edges[at]);
            at = self.border_from[edges[at].1 as usize] as usize;
        }
        around
    }

    /// Joins each edge of the horizon to the apex, and links the new triangles to each other and to those beyond.
    fn join(&mut self, horizon: &[(u32, u32, u32)], apex: u32) {
        let (first, count) = (self.triangles.len() as u32, horizon.len() as u32);
        for (i, &(from, to, beyond)) in (0..).zip(horizon) {
            let (before, after) = ((i + count - 1) % count, (i + 1) % count);
            self.push([from, to, apex], [beyond, first + after, first + before]);
            let outer = &mut self.triangles[beyond as usize];
            if let Some(side) = outer.corners.iter().position(|&corner| corner == to) {
                outer.neighbours[side] = first + i;
            }
        }
    }

    /// Joins exactly coplanar triangles, and puts the facets in canonical order.
    pub(super) fn facets(&self) -> Loops {
        let mut is_taken: Vec<bool> = self.triangles.iter().map(|triangle| triangle.is_dropped).collect();
        let mut facets = Loops::with_room(is_taken.iter().filter(|is_taken| !**is_taken).count());
        let mut region: Vec<u32> = Vec::new();
        for seed in 0..self.triangles.len() {
            if core::mem::replace(&mut is_taken[seed], true) {
                continue;
            }
            region.clear();
            region.push(seed as u32);
            let mut next = 0;
            while next < region.len() {
                for across in self.triangles[region[next] as usize].neighbours {
                    count_step();
                    if !is_taken[across as usize] && self.is_coplanar(seed, across) {
                        is_taken[across as usize] = true;
                        region.push(across);
                    }
                }
                next += 1;
            }
            let triangle = self.triangles[seed].corners;
            if region.len() == 1 {
                facets.push(triangle);
                continue;
            }
            let mut corners: Vec<u32> =
                region.iter().flat_map(|&index| self.triangles[index as usize].corners).collect();
            corners.sort_unstable();
            corners.dedup();
            facets.push(planar_hull(self.points, &corners, triangle));
        }
        facets.canonical()
    }

    /// Whether all corners of one triangle lie in the plane of another: exact.
    fn is_coplanar(&self, plane: usize, triangle: u32) -> bool {
        let plane = &self.triangles[plane];
        self.triangles[triangle as usize].corners.iter().filter(|corner| !plane.corners.contains(corner)).all(
            |&corner| {
                let reach = plane.reach(self.points[corner as usize]).abs();
                let is_clear = reach > plane.slack || self.filter.is_exact();
                if is_clear { reach == 0.0 } else { outside(self.points, plane.corners, corner) == 0.0 }
            },
        )
    }

    /// An upper bound on how far outside the current hull any of the points lies, in metres.
    ///
    /// Every point outside waits at a triangle. From there a walk goes on to neighbours as long as they are nearer; the
    /// distance to any triangle is a bound.
    pub(super) fn outlying(&self) -> f64 {
        let mut most = 0.0_f64;
        for (index, triangle) in
            self.triangles.iter().enumerate().filter(|(_, triangle)| !triangle.is_dropped)
        {
            let mut point = triangle.first_waiting;
            while point != NONE {
                most = most.max(self.distance_from(point, index, most));
                point = self.waits_after[point as usize];
            }
        }
        most
    }

    /// Distance from a point to the nearest triangle that a walk to ever nearer neighbours reaches, or any distance up
    /// to `enough`.
    fn distance_from(&self, point: u32, start: usize, enough: f64) -> f64 {
        let to = |triangle| self.distance_to(triangle, self.points[point as usize]);
        let (mut at, mut least) = (start, to(start));
        while least > enough {
            count_step();
            let neighbours = self.triangles[at].neighbours.map(|neighbour| neighbour as usize);
            let nearer = neighbours
                .map(|neighbour| (to(neighbour), neighbour))
                .into_iter()
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .filter(|&(distance, _)| distance < least);
            let Some((distance, neighbour)) = nearer else { break };
            (least, at) = (distance, neighbour);
        }
        least
    }
}

/// Four points that span space, far from each other; `None` if there are none, or rounding hides them.
///
/// The ends of the longest side of the box around all points, the point furthest from their line, and the one furthest
/// from that plane.
fn far_apart(points: &[Vec3]) -> Option<[u32; 4]> {
    let at = |i: u32| points[i as usize].as_dvec3();
    let all = 0..points.len() as u32;
    let ends = |axis: usize| {
        let key = |&i: &u32| points[i as usize][axis] + 0.0;
        let low = all.clone().min_by(|a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
        let high = all.clone().max_by(|a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
        low.zip(high)
    };
    let length = |&(low, high): &(u32, u32)| at(high) - at(low);
    let (a, b) = (0..3)
        .filter_map(|axis| ends(axis).map(|two| (length(&two)[axis], two)))
        .max_by(|one, other| one.0.total_cmp(&other.0))?
        .1;
    let furthest = |height: &dyn Fn(DVec3) -> f64| {
        let mut best = (0.0, None);
        for i in all.clone() {
            let height = height(at(i) - at(a));
            if height > best.0 {
                best = (height, Some(i));
            }
        }
        best.1
    };
    let along = at(b) - at(a);
    let c = furthest(&|arm| along.cross(arm).length_squared())?;
    if is_collinear(points, [a, b, c]) {
        return None;
    }
    let normal = along.cross(at(c) - at(a));
    let d = furthest(&|arm| normal.dot(arm).abs())?;
    (outside(points, [a, b, c], d) != 0.0).then_some([a, b, c, d])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_of_triangles_is_joined_into_six_facets() {
        let cube: Vec<Vec3> =
            (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
        let facets = hull_facets(&cube);
        assert_eq!(facets.map(|facets| facets.iter().map(<[u32]>::len).collect::<Vec<_>>()), Ok(vec![4; 6]));
    }

    #[test]
    fn points_on_a_line_span_one_dimension() {
        let line: Vec<Vec3> = (0..5).map(|i| Vec3::new(i as f32, 2.0 * i as f32, 0.0)).collect();
        assert_eq!(hull_facets(&line), Err(HullError::Flat { dimension: 1 }));
    }
}
