//! The face with which a shape looks against a normal.
//!
//! ```text
//! the deepest vertex, and from it along edges to all that are as deep up to a slack
//! of the faces around those vertices: the one with the most of them, of equals the most opposed
//! ```
//! What is as deep as the deepest vertex hangs together along edges, since heights on a convex surface have no second
//! valley. So only the neighbourhood of what touches is looked at, however large the hull.

use super::super::sat::Arc;
use super::super::solid::Solid;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;

/// How a shape looks against a normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::polyhedron) struct Opposed {
    /// The face, or the one loop of a point or segment.
    pub(in crate::polyhedron) face: usize,
    /// The vertex that reaches furthest against the normal.
    pub(in crate::polyhedron) deepest: usize,
}

/// The face with which a shape looks against `normal`: of those that have the most of its furthest vertices, the most
/// opposed. Vertices within `slack` of the furthest are as far. A point or segment has one loop, which is it.
///
/// Of two vertices that are equally far, one may have a third face that is more opposed than both of their edge's
/// own; what touches may be at the other.
pub(in crate::polyhedron) fn opposed_face(solid: &Solid, normal: DVec3, slack: f64) -> Opposed {
    if solid.is_slender() {
        return Opposed { face: 0, deepest: solid.support(-normal).vertex };
    }
    let far = Far::from(solid, -normal, slack);
    // A face that has them all is one of the deepest vertex' own. Else it may be any that has one of them.
    let mut best = Best { far: far.count, facing: f64::NAN, face: None };
    best.offer_around(solid, far.deepest, &far, normal);
    if best.face.is_none() {
        best.far = 1;
        for vertex in (0..solid.vertices.len()).filter(|&vertex| far.members.has(vertex)) {
            best.offer_around(solid, vertex, &far, normal);
        }
    }
    Opposed { face: best.face.unwrap_or(0), deepest: far.deepest }
}

/// A face, how many far vertices it must have at least, and the dot product of its normal once it had a rival.
struct Best {
    far: usize,
    facing: f64,
    face: Option<usize>,
}

impl Best {
    /// Takes a better one of the faces around a vertex.
    fn offer_around(&mut self, solid: &Solid, vertex: usize, far: &Far, normal: DVec3) {
        let topology = solid.topology;
        for &half_edge in topology.leaving(vertex) {
            let face = usize::from(topology.half_edges()[usize::from(half_edge)].face);
            let Some(count) = far.count_on(solid, face, self.far) else { continue };
            let known = self.face.filter(|_| count == self.far);
            (self.far, self.face) = match known {
                Some(known) => (count, Some(self.more_opposed(solid, [known, face], normal))),
                None => (count, Some(face)),
            };
            if known.is_none() {
                self.facing = f64::NAN;
            }
        }
    }

    fn more_opposed(&mut self, solid: &Solid, [known, face]: [usize; 2], normal: DVec3) -> usize {
        if self.facing.is_nan() {
            self.facing = solid.normal(known).dot(normal);
        }
        let facing = solid.normal(face).dot(normal);
        if facing.total_cmp(&self.facing).then(face.cmp(&known)).is_lt() {
            self.facing = facing;
            return face;
        }
        known
    }
}

/// Hulls of no more vertices are looked through faster than walked on.
const FEW_VERTICES: usize = 64;

/// The vertices that are as far in a direction as the furthest.
struct Far {
    /// The furthest; of equals the lowest.
    deepest: usize,
    members: Members,
    count: usize,
}

impl Far {
    fn from(solid: &Solid, direction: DVec3, slack: f64) -> Self {
        let own = in_own_axes(solid, direction);
        let reach = |vertex: usize| own.dot(solid.vertices[vertex].as_dvec3());
        let (deepest, members) = if solid.vertices.len() <= FEW_VERTICES {
            Members::furthest_of_few(solid.vertices.len(), reach, slack)
        } else {
            let deepest = solid.support(direction).vertex;
            let least = reach(deepest) - slack;
            (deepest, Members::together(solid, deepest, |vertex| reach(vertex) >= least))
        };
        Self { deepest, members, count: members.count() }
    }

    /// How many of them a face has, if those are no fewer than `least`.
    fn count_on(&self, solid: &Solid, face: usize, least: usize) -> Option<usize> {
        let vertices = solid.topology.face_vertices(face);
        if vertices.len() < least {
            return None;
        }
        let count = vertices.map(|vertex| usize::from(self.members.has(vertex))).sum();
        (count >= least).then_some(count)
    }
}

/// A direction of the pair's frame turned into a shape's own axes.
fn in_own_axes(solid: &Solid, direction: DVec3) -> DVec3 {
    solid.arc_from_frame(Arc { along: direction, ends: [DVec3::ZERO; 2], middle: DVec3::ZERO }).along
}

/// A set of vertices.
#[derive(Clone, Copy, Default)]
struct Members([u64; MAX_HULL_VERTICES / 64]);

impl Members {
    /// The furthest of a few vertices, and all that are as far.
    fn furthest_of_few(few: usize, reach: impl Fn(usize) -> f64, slack: f64) -> (usize, Self) {
        let reaches: ArrayVec<f64, FEW_VERTICES> = (0..few).map(reach).collect();
        let furthest =
            reaches.iter().fold(f64::NEG_INFINITY, |most, &reach| if reach > most { reach } else { most });
        let bits = |least: f64| {
            let bit = |(i, &reach): (usize, &f64)| u64::from(reach >= least) << i;
            reaches.iter().enumerate().map(bit).fold(0, |bits, bit| bits | bit)
        };
        let members = bits(furthest - slack);
        let is_furthest = |i: &usize| reaches[*i] == furthest;
        let deepest = (members.trailing_zeros() as usize..few).find(is_furthest).unwrap_or(0);
        (deepest, Self([members, 0, 0, 0]))
    }

    /// Those that belong to it and hang together along edges with one that does.
    fn together(solid: &Solid, with: usize, belongs: impl Fn(usize) -> bool) -> Self {
        let (mut members, mut seen) = (Self::default(), Self::default());
        let mut ahead: ArrayVec<u16, MAX_HULL_VERTICES> = ArrayVec::new();
        members.insert(with);
        seen.insert(with);
        let mut next = Some(with as u16);
        while let Some(vertex) = next {
            for &half_edge in solid.topology.leaving(vertex.into()) {
                let neighbour = solid.topology.ends(half_edge.into()).1;
                if seen.insert(neighbour) && belongs(neighbour) {
                    members.insert(neighbour);
                    let _ = ahead.try_push(neighbour as u16);
                }
            }
            next = ahead.pop();
        }
        members
    }

    fn count(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    fn has(&self, vertex: usize) -> bool {
        self.0.get(vertex / 64).is_some_and(|word| word >> (vertex % 64) & 1 == 1)
    }

    /// Whether it was not in yet.
    fn insert(&mut self, vertex: usize) -> bool {
        let is_new = !self.has(vertex);
        if let Some(word) = self.0.get_mut(vertex / 64) {
            *word |= 1 << (vertex % 64);
        }
        is_new
    }
}
