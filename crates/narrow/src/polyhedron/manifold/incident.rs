//! The face with which a shape looks against a normal.
//!
//! ```text
//! the deepest vertex, and from it along edges to all that are as deep up to a slack
//! of the faces around those vertices: the one with the most of them, of equals the most opposed
//! ```
//! What is as deep as the deepest vertex hangs together along edges, since heights on a convex surface have no second
//! valley. So only the neighbourhood of what touches is looked at, however large the hull.

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
    let deepest = solid.support(-normal).vertex;
    if solid.is_slender() {
        return Opposed { face: 0, deepest };
    }
    let far = Far::from(solid, normal, deepest, slack);
    let mut best = Best { far: 0, facing: f64::INFINITY, face: 0 };
    // A face that has them all is one of the deepest vertex' own. Else it may be any that has one of them.
    best.offer_around(solid, deepest, &far, far.count, normal);
    if best.far == 0 {
        for vertex in (0..solid.vertices.len()).filter(|&vertex| far.members.has(vertex)) {
            best.offer_around(solid, vertex, &far, 1, normal);
        }
    }
    Opposed { face: best.face, deepest }
}

/// A face, how many far vertices it has, and the dot product of its normal, once it has a rival.
struct Best {
    far: usize,
    facing: f64,
    face: usize,
}

impl Best {
    /// Takes a better one of the faces around a vertex that have at least so many far ones.
    fn offer_around(&mut self, solid: &Solid, vertex: usize, far: &Far, least: usize, normal: DVec3) {
        let topology = solid.topology;
        for &half_edge in topology.leaving(vertex) {
            let face = usize::from(topology.half_edges()[usize::from(half_edge)].face);
            let count = far.count_on(solid, face);
            if count < least.max(self.far) || (count == self.far && face == self.face) {
                continue;
            }
            if count > self.far {
                *self = Self { far: count, facing: f64::NAN, face };
                continue;
            }
            if self.facing.is_nan() {
                self.facing = solid.normal(self.face).dot(normal);
            }
            let facing = solid.normal(face).dot(normal);
            if facing.total_cmp(&self.facing).then(face.cmp(&self.face)).is_lt() {
                *self = Self { far: count, facing, face };
            }
        }
    }
}

/// Hulls of no more vertices are looked through faster than walked on.
const FEW_VERTICES: usize = 64;

/// The vertices that are as far against a normal as the furthest.
struct Far {
    members: Members,
    count: usize,
}

impl Far {
    fn from(solid: &Solid, normal: DVec3, deepest: usize, slack: f64) -> Self {
        let normal = in_own_axes(solid, normal);
        let lowest = normal.dot(solid.vertices[deepest].as_dvec3());
        let is_far = |vertex: usize| normal.dot(solid.vertices[vertex].as_dvec3()) - lowest <= slack;
        let members = if solid.vertices.len() <= FEW_VERTICES {
            Members::all(solid.vertices.len(), is_far)
        } else {
            Members::together(solid, deepest, is_far)
        };
        Self { members, count: members.count() }
    }

    fn count_on(&self, solid: &Solid, face: usize) -> usize {
        solid.topology.face_vertices(face).map(|vertex| usize::from(self.members.has(vertex))).sum()
    }
}

/// A direction of the pair's frame turned into a shape's own axes.
fn in_own_axes(solid: &Solid, direction: DVec3) -> DVec3 {
    solid.basis.turn_back(direction)
}

/// A set of vertices.
#[derive(Clone, Copy, Default)]
struct Members([u64; MAX_HULL_VERTICES / 64]);

impl Members {
    /// Those of the first few vertices that belong to it.
    fn all(few: usize, belongs: impl Fn(usize) -> bool) -> Self {
        let bits =
            (0..few).map(|vertex| u64::from(belongs(vertex)) << vertex).fold(0, |bits, bit| bits | bit);
        Self([bits, 0, 0, 0])
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
