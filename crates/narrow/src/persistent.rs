//! How far two bodies may drift against each other until their manifold has to be made anew.
//!
//! ```text
//! drift = by how much any point of one body moved, seen from the other, since the manifold was made
//! every projection of either body, so the separation along any axis, changes by no more than the drift
//!     so the true separation does
//!     so whether they overlap, and are within the margin, is as it was while drift < how far off either is
//! the points stay where they are on one body, above the face of the other that they are measured from:
//!     their own separations are measured anew, and the normal turns with the face
//!     what the faces share moves sideways under them by no more than the drift
//! ```
//! Bullet and PhysX keep manifolds too ("persistent contact manifold"), until points slip by centimetres; parry3d until one
//! slips by a millimetre. Here the limit is a share of the bodies, the drift goes into the error that is reported, and it
//! counts from where the manifold was made, not from frame to frame, so that it does not pile up.
//!
//! The error could be twice the drift where another axis is nearly as deep, and was found to be 9e-6 of the size at most in a
//! heap of 8,000 boxes that sway. parry3d's time over ours for heaps of boxes and hulls, and pyramids (AMD EPYC, Zen 4,
//! 2026-11-22): nothing kept 0.67, 0.79, 0.79; 2^-17 of the radius 0.74, 1.04, 0.75; 2^-15 0.9, 2.5, 1.1.

use crate::answer::Answer;
use crate::feature::{Feature, Hint, OnFace};

/// Share of the smaller bounding radius by which two bodies may drift, 2^-15: of cubes of a metre, 26 micrometres. The
/// reported error is up to twice that.
const DRIFT: f32 = 1.0 / 32_768.0;

/// What holds a manifold that is moved along to its bodies, in either dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Terms {
    pub(crate) overlapping: bool,
    /// Whether the points are measured from a face of B (an edge, in the plane); two edges that cross count as if they were
    /// from A.
    pub(crate) is_from_b: bool,
    pub(crate) margin: f32,
    /// Up to which drift the answer holds, in metres.
    pub(crate) slack: f32,
    /// How far the bodies reach from their positions, in metres.
    pub(crate) arms: [f32; 2],
}

impl Terms {
    /// Whether they can be those of a manifold.
    pub(crate) fn are_sound(&self) -> bool {
        let most = reach_of(self.arms);
        self.margin.is_finite()
            && self.arms.iter().all(|arm| arm.is_finite() && *arm >= 0.0)
            && (0.0..=most).contains(&self.slack)
    }
}

/// Up to which drift bodies of these bounding radii are told by what they were, in metres.
pub(crate) fn reach_of(radii: [f32; 2]) -> f32 {
    DRIFT * radii[0].min(radii[1])
}

/// Up to which drift an answer of this separation, and this error, stays what it is, in metres; nothing where it is too close to call.
pub(crate) fn slack_of(
    [separation, error]: [f32; 2],
    overlapping: bool,
    margin: f32,
    radii: [f32; 2],
) -> Option<f32> {
    // Of what overlaps the margin does not matter.
    let to_margin = if overlapping { f32::INFINITY } else { margin - separation };
    let sure = (separation.abs().min(to_margin) - error).next_down();
    let slack = reach_of(radii).min(sure);
    (slack > 0.0).then_some(slack)
}

/// The face (edge, in the plane) that points may be measured from, by the hint that was left with them. Nothing where they
/// are from none: two edges that cross, a direction. Corners across a gap may have one too: ask their normal.
pub(crate) fn measured_from(hint: Hint) -> Option<OnFace> {
    let features = hint.features()?;
    match (hint.points_on(), features.a(), features.b()) {
        (Some(on), ..) => Some(on),
        (None, Feature::Face(face), _) | (None, Feature::Edge(face), Feature::Vertex(_)) => {
            Some(OnFace::OfA(face))
        }
        (None, _, Feature::Face(face)) | (None, Feature::Vertex(_), Feature::Edge(face)) => {
            Some(OnFace::OfB(face))
        }
        _ => None,
    }
}

/// What a normal may be off that of its face, up to the rounding of both.
pub(crate) const THEIRS: f64 = 1e-6;

/// The hint of a contact with one manifold, which manifold it is, and whether the shapes overlap.
pub(crate) fn single(answer: &Answer) -> Option<(Hint, usize, bool)> {
    match answer {
        Answer::Contact { hint, overlapping, manifolds } if manifolds.len() == 1 => {
            Some((*hint, manifolds.start as usize, *overlapping))
        }
        _ => None,
    }
}

/// What rounding may cost in the difference of two offsets, by the sum of one's coordinates, and of unit vectors times an
/// arm, in metres.
#[inline(always)]
pub(crate) fn lost(summed: f64, arm: f64) -> f64 {
    64.0 * f64::EPSILON * (summed + arm)
}

/// The error of a separation, which had this error, after a drift in which the deepest point rose by so much: the truth
/// may have gone the other way. And what rounding costs it.
#[inline(always)]
pub(crate) fn error_after([separation, error]: [f32; 2], drift: f64, rise: f64) -> f32 {
    let rounding = f64::from(f32::EPSILON) * (f64::from(separation).abs() + drift);
    ((f64::from(error) + drift + rise.abs() + rounding) as f32).next_up()
}
