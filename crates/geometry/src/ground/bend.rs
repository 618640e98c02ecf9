//! Where ground bends, and where it is flat.

use crate::tolerance::{FLAT, SAME_NORMAL};
use glam::DVec3;

/// Seen from the front, then from the back: whether an edge between two triangles may give a contact a normal of its
/// own.
pub(crate) type Sight = [bool; 2];

/// An edge where the ground ends, or where it is not a surface.
pub(crate) const RIM: Sight = [true, true];

/// Whether the ground bends away along an edge. `along` is the half-edge of the triangle with the first normal; all
/// are unit vectors.
///
/// No exact sign is needed: normals of the thinnest triangles that are kept are right to 1e-9, and what decides is
/// [`FLAT`]. The answer does not depend on which of the two triangles comes first.
pub(crate) fn sight(normals: [DVec3; 2], along: DVec3) -> Sight {
    let [one, other] = normals;
    let bend = one.cross(other).dot(along);
    if one.dot(other) > 0.0 {
        return [bend > FLAT, -bend > FLAT];
    }
    // Folded back by nearly half a turn: to which side, rounding may say.
    [bend > -FLAT, -bend > -FLAT]
}

/// Sine below which a bend is the rounding of the normals beside it.
const LEAST_BEND: f64 = 1e-14;

/// Whether ground bends between two unit normals, to whichever side, so low that all directions between them count as
/// one of them.
pub(crate) fn is_low([one, other]: [DVec3; 2]) -> bool {
    let square = one.cross(other).length_squared();
    one.dot(other) > 0.0 && square > LEAST_BEND * LEAST_BEND && square <= 4.0 * SAME_NORMAL * SAME_NORMAL
}

/// For each triangle, the least number of those that lie in one plane and hang together with it: within [`FLAT`] of
/// the first one's plane, so that a surface that bends little by little does not come together as one.
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
