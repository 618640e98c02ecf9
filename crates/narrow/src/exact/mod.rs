//! The last tier: whether two shapes share a point, in exact arithmetic.
//!
//! ```text
//! C = the vertices of B less the vertices of A, as integers: two hulls share a point exactly where the hull of C
//!     contains the origin
//! S = the corners that f64 stopped at (any corner of C will do)
//! repeat
//!   v = the point of the hull of S nearest to the origin, and S = the corners that carry it    (nearest)
//!   v = 0:                              they share a point;  S is the proof
//!   w = the corner of C least along v                                                          (question)
//!   v.w > 0:                            they are apart;      v is the proof
//!   S = S and w: v gets shorter
//! radii R: within R as soon as |v| <= R;  apart as soon as v.w > R |v|;  both compared as squares
//! ```
//! Wolfe, "Finding the nearest point in a polytope" (1976), in the form of Gilbert, Johnson and Keerthi (1988). In
//! exact arithmetic it needs no tolerance and cannot cycle: every step shortens v, no set of corners occurs twice, and
//! there are finitely many. Faces, edges and normals are derived data and are not used.
//!
//! What keeps it cheap:
//! 1. f64 hands over its last corners, so that one to three steps remain instead of a search from scratch.
//! 2. One common unit, a power of two, makes all lengths integers, as short as the scene allows: bodies on a grid need
//!    30 bits, bodies with any rotation some 155.
//! 3. All coordinates are relative to A: one rotation in place of two, and none where both bodies are turned alike.
//! 4. Only the vertices that f64 cannot tell from the furthest are compared exactly.
//! 5. A corner's weight follows from products of corners (the Gram matrix), each computed once.
//! 6. Boxes turned by right angles need no integers: the signs of six sums decide ([`aligned`]).
//!
//! Coordinates of P bits give signs of at most 4 P bits; radii, of 8 P. Cost: linear in the vertices, in f64, plus a
//! few hundred products of integers of a few words.

mod aligned;
mod frame2;
mod frame3;
mod int;
mod nearest;
mod question;
mod rotation;

pub(crate) use aligned::boxes_overlap3;
pub(crate) use frame2::Site2;
pub(crate) use frame3::Site3;

/// A vertex of A's core and one of B's: where to begin.
pub(crate) type Corner = [usize; 2];

/// Whether two shapes in space share a point; touching counts. `start` is where f64 stopped, and may be empty.
pub(crate) fn overlaps3(sites: [&Site3; 2], start: &[Corner]) -> bool {
    if let Some(overlapping) = boxes_overlap3(sites) {
        return overlapping;
    }
    let cores = sites.map(|site| site.shape.core());
    frame3::question(sites, [&cores[0], &cores[1]]).answer(start)
}

/// Whether two half-spaces have exactly opposite normals, so that a finite translation separates them.
pub(crate) fn are_opposed3(sites: [&Site3; 2]) -> bool {
    let cores = sites.map(|site| site.shape.core());
    frame3::question(sites, [&cores[0], &cores[1]]).are_opposed()
}

/// As [`overlaps3`], in the plane.
pub(crate) fn overlaps2(sites: [&Site2; 2], start: &[Corner]) -> bool {
    if let Some(overlapping) = aligned::boxes_overlap2(sites) {
        return overlapping;
    }
    let cores = sites.map(|site| site.shape.core());
    frame2::question(sites, [&cores[0], &cores[1]]).answer(start)
}

/// Whether a shape contains the position of a body, which is given by a circle there.
pub(crate) fn holds2(site: &Site2, point: &Site2) -> bool {
    let cores = [site, point].map(|site| site.shape.core());
    frame2::question_of([site, point], [&cores[0], &cores[1]], [site.shape.radius(), 0.0]).answer(&[])
}

/// As [`are_opposed3`], in the plane.
pub(crate) fn are_opposed2(sites: [&Site2; 2]) -> bool {
    let cores = sites.map(|site| site.shape.core());
    frame2::question(sites, [&cores[0], &cores[1]]).are_opposed()
}
