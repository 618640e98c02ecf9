//! The nearest facet of the difference by an expanding polytope inside it, for solids with so many edges that testing
//! their pairs takes longer.
//!
//! ```text
//! start    four points of M = A - B around the origin                                                         (portal)
//! repeat:  take the facet of the polytope nearest to the origin, with normal m, and the vertex of M furthest along m
//!          if the facet is as far out as the known depth, or no vertex lies beyond it, up to a slack: done
//!          remove every facet that the vertex is beyond, and connect the rim of the hole to the vertex
//! ```
//! van den Bergen, "Proximity queries and penetration depth computation on 3D game objects" (GDC 2001). There the
//! facets' planes are trusted. Here nothing is trusted that rounding could spoil:
//!
//! ```text
//! bound    for corners p, q, r and *any* unit vector m, every point of the triangle is at least min(m.p, m.q, m.r)
//!          away: m may be the normal of a sliver, and be off by any angle
//! around   the surface goes on winding around the origin: the facets that are added have the same rim as those they
//!          replace, and each tetrahedron between, of an old facet and the new vertex, lies on one side of a plane and
//!          the origin on the other
//! so       each direction meets a triangle, no nearer than its bound, and M reaches at least as far there
//! ```
//! Neither requires the polytope to be convex, or free of folds.
//!
//! Prisms take 22 to 34 vertices, however many sides they have: two of 24 sides, deep in each other, 24 us to 8, two of
//! 128 sides 200 to 18 (AMD EPYC, Zen 4, 2026-11-26). Tried:
//!
//! - hulls of random vertices, of whose edges the spheres leave one in seven to one in seventy: 32 vertices 8.4 us to
//!   16, 256 vertices 36 to 72;
//! - cells and footballs, which have as many edges for their number of faces but no large face, and half of which run
//!   out of vertices: 1.2 to 3.4 times as long;
//! - globes of 256 vertices, all of whose directions are nearly as good: 31 us to 135;
//! - in place of a rule for shapes, one for how many edges the spheres leave, evaluated on the way: prisms of 128 sides
//!   28 us, since it is those spheres that take long; cones a little less than by all pairs.

use super::super::portal;
use super::super::solid::Solid;
use crate::counted::count_steps;
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// Most vertices. A surface without folds has twice as many facets.
const MOST_VERTICES: usize = 64;

const MOST_FACETS: usize = 2 * MOST_VERTICES;

/// Most edges on the rim of the facets that a vertex is beyond.
const MOST_EDGES: usize = 64;

/// What the polytope has shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    /// No direction shows a smaller depth, apart from the rounding of a projection, in metres.
    pub(super) at_least: f64,
    /// A facet that shows hardly more depth; `None` where the known depth is hardly more.
    pub(super) met: Option<Met>,
}

/// A facet of the polytope that is one of the difference, or a piece of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    /// A unit vector from A to B.
    pub(super) direction: DVec3,
    /// The vertices of A and of B whose differences are its corners, where known.
    pub(super) corners: Option<[[u16; 2]; 3]>,
}

/// A closed surface around the origin, inside the difference. What loops run over is in lists of its own.
struct Surface {
    points: ArrayVec<DVec3, MOST_VERTICES>,
    /// The vertices of A and of B whose difference each point is; `None` for the points that the surface began with.
    vertices: ArrayVec<Option<[u16; 2]>, MOST_VERTICES>,
    /// The corners of each facet, counter-clockwise as seen from outside.
    corners: ArrayVec<[u8; 3], MOST_FACETS>,
    /// The unit normal of each facet.
    normals: ArrayVec<DVec3, MOST_FACETS>,
    /// The least projection of each facet's corners on its normal.
    least: ArrayVec<f64, MOST_FACETS>,
    /// What `least` must exceed for every facet, so that the origin is on no plane, in metres.
    doubt: f64,
}

/// How deep solids overlap, up to a slack, given that some direction shows `known_depth` (infinite where none is
/// known); `None` where rounding is in the way, or too many vertices would be needed.
///
/// The slack is finite, and more than the rounding of a projection, so that each vertex removes a facet.
#[inline(never)]
pub(super) fn grow(
    (a, b): (&Solid, &Solid),
    (known_depth, slack): (f64, f64),
    precision: &Precision,
) -> Option<Bound> {
    let corners = portal::around(a, b, precision)?;
    let mut surface = Surface::new(precision.projection());
    surface.begin(corners)?;
    let point = |[of_a, of_b]: [usize; 2]| a.point(of_a) - b.point(of_b);
    // Once the last vertex is taken, the surface is not examined any more.
    while !surface.points.is_full() {
        let place = surface.nearest_facet()?;
        let (direction, at_least) = (surface.normals[place], surface.least[place]);
        if at_least >= known_depth - slack {
            return Some(Bound { at_least, met: None });
        }
        let mut vertices = [a.rough_support(direction).0.vertex, b.rough_support(-direction).0.vertex];
        let mut furthest = point(vertices);
        if direction.dot(furthest) <= at_least + slack {
            let (in_a, in_b) = (a.support(direction), b.support(-direction));
            if in_a.reach + in_b.reach <= at_least + slack {
                let corners = surface.vertices_of(place);
                return Some(Bound { at_least, met: Some(Met { direction, corners }) });
            }
            vertices = [in_a.vertex, in_b.vertex];
            furthest = point(vertices);
        }
        surface.take(furthest, vertices.map(|vertex| vertex as u16))?;
    }
    None
}

impl Surface {
    /// A surface without facets.
    #[inline(always)]
    fn new(doubt: f64) -> Self {
        Self {
            points: ArrayVec::new_const(),
            vertices: ArrayVec::new_const(),
            corners: ArrayVec::new_const(),
            normals: ArrayVec::new_const(),
            least: ArrayVec::new_const(),
            doubt,
        }
    }

    /// The vertices of A and of B whose differences are a facet's corners, if all are known.
    fn vertices_of(&self, facet: usize) -> Option<[[u16; 2]; 3]> {
        let [p, q, r] = self.corners[facet].map(|corner| self.vertices[usize::from(corner)]);
        Some([p?, q?, r?])
    }

    /// Starts with a tetrahedron around the origin.
    fn begin(&mut self, corners: [DVec3; 4]) -> Option<()> {
        self.points.extend(corners);
        self.vertices.extend([None; 4]);
        let [a, b, c, d] = corners;
        let is_turned = (b - a).cross(c - a).dot(d - a) > 0.0;
        for [i, j, k] in [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] {
            self.add(if is_turned { [i, k, j] } else { [i, j, k] })?;
        }
        Some(())
    }

    fn nearest_facet(&self) -> Option<usize> {
        let lesser = |one: f64, other: &f64| if *other < one { *other } else { one };
        let least = self.least.iter().fold(f64::INFINITY, lesser);
        self.least.iter().position(|&of| of == least)
    }

    /// Adds a facet; `None` where it is no further from the origin than rounding.
    fn add(&mut self, corners: [u8; 3]) -> Option<()> {
        let [p, q, r] = corners.map(|corner| self.points[usize::from(corner)]);
        let normal = (q - p).cross(r - p).try_normalize()?;
        let least = normal.dot(p).min(normal.dot(q)).min(normal.dot(r));
        // NaN is not beyond.
        let is_beyond = least > self.doubt;
        if !is_beyond {
            return None;
        }
        self.corners.try_push(corners).ok()?;
        self.normals.push(normal);
        self.least.push(least);
        Some(())
    }

    /// Adds a point, in place of all facets that it is beyond.
    fn take(&mut self, point: DVec3, vertices: [u16; 2]) -> Option<()> {
        count_steps(self.corners.len() / 4);
        let mut beyond = ArrayVec::<u16, MOST_FACETS>::new_const();
        for (i, (normal, least)) in self.normals.iter().zip(&self.least).enumerate() {
            if normal.dot(point) > least + self.doubt {
                beyond.push(i as u16);
            }
        }
        let mut around = ArrayVec::<[u8; 2], MOST_EDGES>::new_const();
        // From the last on, so that the facet that is swapped into the gap is never one still to be removed.
        for &i in beyond.iter().rev() {
            let [p, q, r] = self.remove(i.into());
            for [from, to] in [[p, q], [q, r], [r, p]] {
                // An edge that two of them share is inside the hole.
                match around.iter().position(|&edge| edge == [to, from]) {
                    Some(place) => drop(around.swap_remove(place)),
                    None => around.try_push([from, to]).ok()?,
                }
            }
        }
        let new = self.points.len() as u8;
        self.points.try_push(point).ok()?;
        self.vertices.push(Some(vertices));
        around.iter().try_for_each(|&[from, to]| self.add([from, to, new]))
    }

    fn remove(&mut self, facet: usize) -> [u8; 3] {
        self.normals.swap_remove(facet);
        self.least.swap_remove(facet);
        self.corners.swap_remove(facet)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Random;
    use super::*;

    /// Includes needles, whose normals are rounding; triangles with the origin behind them are rejected.
    #[test]
    fn no_point_of_a_facet_is_nearer_than_its_bound() {
        let mut random = Random(0x9E6C_63D0_676A_9A99);
        let (mut taken, mut rejected, mut needles) = (0, 0, 0);
        for case in 0..20_000 {
            let [p, q, aside] = [0; 3].map(|_| random.vector().as_dvec3());
            // Nearly on the line through the other two.
            let thin = [1.0, 1e-6, 1e-13, 1e-16][case % 4];
            let r = p.lerp(q, 2.0 * f64::from(random.number())) + aside * thin;
            let mut surface = Surface::new(1e-15);
            surface.points.extend([p, q, r]);
            if surface.add([0, 1, 2]).is_none() {
                rejected += 1;
                continue;
            }
            let least = surface.least[0];
            assert!(least > 0.0, "case {case}: {least}");
            (taken, needles) = (taken + 1, needles + usize::from(thin < 1e-12));
            for (i, j) in (0..=8).flat_map(|i| (0..=8 - i).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|share| f64::from(share) / 8.0);
                let point = p + (q - p) * u + (r - p) * v;
                assert!(point.length() >= least - 1e-14, "case {case}: {point} and {least}");
            }
        }
        assert!(taken > 5000 && rejected > 5000 && needles > 1000, "{taken}, {rejected}, {needles}");
    }
}
