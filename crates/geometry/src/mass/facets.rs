//! The triangles of the true surface.
//!
//! A face may be several merged facets, flat only up to rounding. In a thin hull that rounding may be most of the
//! volume, so the facets are restored from the corners, as in their convex hull:
//!
//! ```text
//! facets(chain of corners, from edge first-last):
//!     apex = the corner whose triangle with the edge has no other above it (exact; of equals, that nearest the middle)
//!     visit (first, apex, last); then facets(first ..= apex) and facets(apex ..= last)
//! ```

use crate::cores::Core3;
use glam::Vec3;
use robust::{Coord3D, orient3d};

/// Visits vertex numbers, counter-clockwise seen from outside. Cost: n log n for the corners of a flat face, n^2 at
/// worst.
pub(super) fn each_facet(core: &Core3<'_>, mut visit: impl FnMut([usize; 3])) {
    for face in 0..core.normals().len() {
        let around: Vec<usize> = core.topology().face_vertices(face).collect();
        let mut chains = vec![around.as_slice()];
        while let Some(chain) = chains.pop() {
            let [first, inner @ .., last] = chain else { continue };
            let Some(place) = apex(core.vertices(), *first, inner, *last) else { continue };
            visit([*first, inner[place], *last]);
            chains.extend([&chain[..place + 2], &chain[place + 1..]]);
        }
    }
}

/// The inner corner that makes the outermost triangle with the ends.
fn apex(vertices: &[Vec3], first: usize, inner: &[usize], last: usize) -> Option<usize> {
    let coord = |i: usize| {
        let v = vertices[i].as_dvec3();
        Coord3D { x: v.x, y: v.y, z: v.z }
    };
    let off_middle = |place: usize| (2 * place).abs_diff(inner.len() - 1);
    (0..inner.len()).reduce(|best, place| {
        // In `robust` the positive side is the one from which the three run clockwise.
        let outside = -orient3d(coord(first), coord(inner[best]), coord(last), coord(inner[place]));
        let is_better = outside > 0.0 || (outside == 0.0 && off_middle(place) < off_middle(best));
        if is_better { place } else { best }
    })
}
