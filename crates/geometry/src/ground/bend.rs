//! Classifies edges of ground by how it bends there, and finds coplanar patches.

use crate::tolerance::{FLAT, SAME_NORMAL};
use glam::DVec3;

/// Whether an edge between two triangles may give a contact a normal other than the triangles', seen from the front,
/// then from the back.
pub(crate) type Sight = [bool; 2];

/// The edge is a rim: the ground ends there, or is not a manifold.
pub(crate) const RIM: Sight = [true, true];

/// From which sides the ground bends away at an edge. `along` is the half-edge of the triangle with the first normal;
/// all are unit vectors.
///
/// No exact sign is needed: even the normals of the thinnest triangles that are kept are right to 1e-9, far below
/// [`FLAT`]. The result does not depend on which of the two triangles comes first.
pub(crate) fn sight(normals: [DVec3; 2], along: DVec3) -> Sight {
    let [one, other] = normals;
    let bend = one.cross(other).dot(along);
    if one.dot(other) > 0.0 {
        return [bend > FLAT, -bend > FLAT];
    }
    // Folded back by nearly half a turn: rounding may decide to which side, so it may count for both.
    [bend > -FLAT, -bend > -FLAT]
}

/// Sine below which a bend is mere rounding of the normals beside it.
const LEAST_BEND: f64 = 1e-14;

/// Whether the bend between two unit normals, to either side, is so low that all directions between them count as one
/// normal.
pub(crate) fn is_low([one, other]: [DVec3; 2]) -> bool {
    let square = one.cross(other).length_squared();
    one.dot(other) > 0.0 && square > LEAST_BEND * LEAST_BEND && square <= 4.0 * SAME_NORMAL * SAME_NORMAL
}

/// The patch of each triangle: the least number of the connected triangles that lie in one plane with it. They must be
/// within [`FLAT`] of the first one's plane, so that a gently curved surface does not become a single patch.
pub(crate) fn patches(
    count: u32,
    exists: impl Fn(u32) -> bool,
    normal: impl Fn(u32) -> DVec3,
    neighbor: impl Fn(u32, usize) -> Option<u32>,
) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut patches = vec![NONE; count as usize];
    let mut open = Vec::new();
    for first in 0..count {
        if patches[first as usize] != NONE {
            continue;
        }
        patches[first as usize] = first;
        if !exists(first) {
            continue;
        }
        let plane = normal(first);
        open.push(first);
        while let Some(triangle) = open.pop() {
            for edge in 0..3 {
                let Some(next) = neighbor(triangle, edge) else { continue };
                if patches[next as usize] == NONE && is_flat(plane, normal(next)) {
                    patches[next as usize] = first;
                    open.push(next);
                }
            }
        }
    }
    patches
}

fn is_flat(one: DVec3, other: DVec3) -> bool {
    one.dot(other) > 0.0 && one.cross(other).length_squared() <= FLAT * FLAT
}
