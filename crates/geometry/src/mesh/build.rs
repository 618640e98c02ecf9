//! Builds a mesh from vertices and triangles.

use super::edges::{Edges, NO_TWIN};
use super::{Data, DroppedTriangles, MeshError};
use crate::ground::Prominent;
use crate::ground::bend::{RIM, Sight, is_low, patches, sight};
use crate::ground::tree::{Sides, Tree};
use crate::hull::normal::unit;
use crate::outward::round_up;
use crate::tolerance::{MAX_MESH_VERTICES, MAX_RADIUS, MAX_TRIANGLES};
use crate::triangle::Triangle3;
use glam::{DVec3, Vec3};

/// A mesh's data. `keeps_backs` is for one-sided meshes.
pub(super) fn build(
    mut vertices: Vec<Vec3>,
    mut triangles: Vec<[u32; 3]>,
    keeps_backs: bool,
) -> Result<Data, MeshError> {
    check(&vertices, &triangles)?;
    weld(&vertices, &mut triangles);
    let corners = |triangle: u32| triangles[triangle as usize].map(|vertex| vertices[vertex as usize]);
    let count = triangles.len() as u32;
    let is_degenerate = |triangle: u32| {
        let [a, b, c] = corners(triangle);
        Triangle3::new(a, b, c).is_err()
    };
    let mut is_dropped: Vec<bool> = (0..count).map(is_degenerate).collect();
    let degenerate = is_dropped.iter().filter(|&&is_dropped| is_dropped).count();
    let Edges { twins, duplicate, has_backs } =
        Edges::of(&triangles, vertices.len(), &mut is_dropped, keeps_backs);
    let kept = || (0..count).filter(|&triangle| !is_dropped[triangle as usize]);
    let Some((low, high)) = kept().map(|triangle| around(corners(triangle))).reduce(union) else {
        return Err(MeshError::NoTriangles);
    };
    // The minimum of -0 and 0 may be either: adding zero makes them equal.
    let center = (low + high) * 0.5 + Vec3::ZERO;
    let normal = |triangle: u32| {
        let [a, b, c] = corners(triangle).map(|corner| corner.as_dvec3());
        if is_dropped[triangle as usize] { DVec3::ZERO } else { unit((b - a).cross(c - a)) }
    };
    let normals: Vec<DVec3> = (0..count).map(normal).collect();
    let normal = |triangle: u32| normals[triangle as usize];
    let twin = |half_edge: usize| Some(twins[half_edge]).filter(|&twin| twin != NO_TWIN);
    let neighbor = |triangle: u32, edge: usize| twin(3 * triangle as usize + edge).map(|twin| twin / 3);
    let patches = patches(count, |triangle| !is_dropped[triangle as usize], normal, neighbor);
    let sights = Sights { triangles: &triangles, vertices: &vertices, twins: &twins, normals: &normals };
    let mut marks = sights.edges(kept());
    sights.corners(kept(), &mut marks);
    (0..count).filter(|&triangle| is_dropped[triangle as usize]).for_each(|t| marks[t as usize] = DROPPED);
    let tree = if vertices.len() <= MOST_VERTICES * triangles.len() {
        Tree::of_triangles(kept(), corners)
    } else {
        Tree::new(kept(), |triangle| sides(corners(triangle)))
    };
    let reach = |corner: Vec3| (corner.as_dvec3() - center.as_dvec3()).length_squared();
    let outer = kept().flat_map(corners).map(reach).fold(0.0, f64::max).sqrt();
    let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
    let dropped = DroppedTriangles { degenerate, duplicate };
    vertices.shrink_to_fit();
    triangles.shrink_to_fit();
    Ok(Data {
        vertices,
        triangles,
        twins,
        patches,
        marks,
        tree,
        dropped,
        has_backs,
        low,
        high,
        center,
        outer_radius,
    })
}

/// Most vertices per triangle with which the tree also holds corners: that takes 12 bytes more per triangle, and 100 in
/// all are promised.
const MOST_VERTICES: usize = 2;

/// The marks of a dropped triangle, which no [`Prominent`] has.
pub(super) const DROPPED: u16 = 1 << 15;

fn check(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let count = vertices.len();
    if count > MAX_MESH_VERTICES {
        return Err(MeshError::TooManyVertices { count });
    }
    if triangles.len() > MAX_TRIANGLES {
        return Err(MeshError::TooManyTriangles { count: triangles.len() });
    }
    if let Some(vertex) = vertices.iter().position(|vertex| !vertex.is_finite()) {
        return Err(MeshError::NotFinite { vertex });
    }
    let is_far = |vertex: &Vec3| vertex.as_dvec3().length() > f64::from(MAX_RADIUS);
    if let Some(vertex) = vertices.iter().position(is_far) {
        return Err(MeshError::TooLarge { vertex });
    }
    for (triangle, numbers) in triangles.iter().enumerate() {
        if let Some(&vertex) = numbers.iter().find(|&&vertex| vertex as usize >= count) {
            return Err(MeshError::NoSuchVertex { triangle, vertex, count });
        }
    }
    Ok(())
}

/// Gives vertices at the same position one number, the least.
///
/// Files repeat vertices that have several normals or texture coordinates; without welding, the ground would end at
/// each of their edges.
fn weld(vertices: &[Vec3], triangles: &mut [[u32; 3]]) {
    let key = |(number, vertex): (u128, &Vec3)| {
        // Adding zero turns -0 into 0.
        let [x, y, z] = (*vertex + Vec3::ZERO).to_array().map(|part| u128::from(part.to_bits()));
        x << 96 | y << 64 | z << 32 | number
    };
    let mut keys: Vec<u128> = (0..).zip(vertices).map(key).collect();
    keys.sort_unstable();
    let is_same = |one: u128, other: u128| one >> 32 == other >> 32;
    if !keys.windows(2).any(|two| is_same(two[0], two[1])) {
        return;
    }
    let mut least: Vec<u32> = (0..vertices.len() as u32).collect();
    for same in keys.chunk_by(|&one, &other| is_same(one, other)) {
        same.iter().for_each(|&key| least[key as u32 as usize] = same[0] as u32);
    }
    for vertex in triangles.as_flattened_mut() {
        *vertex = least[*vertex as usize];
    }
}

fn around([a, b, c]: [Vec3; 3]) -> (Vec3, Vec3) {
    (a.min(b).min(c), a.max(b).max(c))
}

fn union(one: (Vec3, Vec3), other: (Vec3, Vec3)) -> (Vec3, Vec3) {
    (one.0.min(other.0), one.1.max(other.1))
}

fn sides(corners: [Vec3; 3]) -> Sides {
    let (low, high) = around(corners);
    [low.x, low.y, low.z, high.x, high.y, high.z]
}

/// The data needed to see where a mesh bends.
struct Sights<'a> {
    triangles: &'a [[u32; 3]],
    vertices: &'a [Vec3],
    twins: &'a [u32],
    normals: &'a [DVec3],
}

impl Sights<'_> {
    /// Marks the edges at which the mesh bends away or ends.
    fn edges(&self, kept: impl Iterator<Item = u32>) -> Vec<u16> {
        let mut marks = vec![Prominent::NONE; self.triangles.len()];
        for triangle in kept.map(|triangle| triangle as usize) {
            for edge in 0..3 {
                let (here, twin) = (3 * triangle + edge, self.twins[3 * triangle + edge]);
                if twin == NO_TWIN {
                    marks[triangle] = with_edge(marks[triangle], edge, RIM);
                } else if here < twin as usize {
                    let (other, other_edge) = (twin as usize / 3, twin as usize % 3);
                    let sight = self.sight(triangle, edge, other);
                    marks[triangle] = with_edge(marks[triangle], edge, sight);
                    marks[other] = with_edge(marks[other], other_edge, sight);
                    if is_low([self.normals[triangle], self.normals[other]]) {
                        marks[triangle] = marks[triangle].with_low_bend();
                        marks[other] = marks[other].with_low_bend();
                    }
                }
            }
        }
        marks.into_iter().map(Prominent::bits).collect()
    }

    fn sight(&self, triangle: usize, edge: usize, other: usize) -> Sight {
        let numbers = self.triangles[triangle];
        let [from, to] =
            [edge, (edge + 1) % 3].map(|corner| self.vertices[numbers[corner] as usize].as_dvec3());
        sight([self.normals[triangle], self.normals[other]], (to - from).normalize())
    }

    /// Marks the corners at which an edge of any triangle is marked.
    fn corners(&self, kept: impl Iterator<Item = u32> + Clone, marks: &mut [u16]) {
        let mut seen = vec![[false; 2]; self.vertices.len()];
        let ends = |triangle: u32, edge: usize| {
            let numbers = self.triangles[triangle as usize];
            [numbers[edge], numbers[(edge + 1) % 3]]
        };
        for triangle in kept.clone() {
            let prominent = Prominent::from_bits(marks[triangle as usize]);
            for edge in 0..3 {
                let [front, back] = [true, false].map(|is_front| prominent.edge(edge, is_front));
                for end in ends(triangle, edge) {
                    let seen = &mut seen[end as usize];
                    *seen = [seen[0] | front, seen[1] | back];
                }
            }
        }
        for triangle in kept {
            let mut prominent = Prominent::from_bits(marks[triangle as usize]);
            for corner in 0..3 {
                let seen = seen[self.triangles[triangle as usize][corner] as usize];
                prominent = with_corner(prominent, corner, seen);
            }
            marks[triangle as usize] = prominent.bits();
        }
    }
}

fn with_edge(prominent: Prominent, edge: usize, [front, back]: Sight) -> Prominent {
    let prominent = if front { prominent.with_edge(edge, true) } else { prominent };
    if back { prominent.with_edge(edge, false) } else { prominent }
}

fn with_corner(prominent: Prominent, corner: usize, [front, back]: Sight) -> Prominent {
    let prominent = if front { prominent.with_corner(corner, true) } else { prominent };
    if back { prominent.with_corner(corner, false) } else { prominent }
}
