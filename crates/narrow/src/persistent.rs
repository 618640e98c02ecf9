//! How far two bodies may drift against each other until their manifold must be recomputed.
//!
//! ```text
//! drift = the furthest that any point of one body has moved, seen from the other, since the manifold was computed
//! every projection of either body, and so the separation along any axis, changes by no more than the drift
//!     and so does the true separation
//!     so overlap, and being within the margin, are as they were while drift < the distance to either limit
//! the points stay where they are on one body, above the face of the other that they are measured from:
//!     their own separations are measured again, and the normal turns with the body that sees the lesser drift
//!     what the faces share moves sideways under them by no more than the drift
//! ```
//! That alone adds up to twice the drift to the error. Where the contact is wide, the axis can be shown to stay the
//! best, and bodies may slide 32 times as far for a smaller error: see `footing`.
//!
//! Bullet and PhysX keep manifolds too ("persistent contact manifold"), until points slip by centimetres; parry3d until
//! one slips by a millimetre. Here the limit is a share of the bodies' size, the loss goes into the reported error, and
//! the drift counts from where the manifold was computed, not from frame to frame, so that it does not add up.
//!
//! parry3d's time over ours for heaps of boxes and hulls, and pyramids (AMD EPYC, Zen 4, 2026-11-22): nothing kept
//! 0.67, 0.79, 0.79; 2^-17 of the radius 0.74, 1.04, 0.75; 2^-15 0.9, 2.5, 1.1.

use crate::answer::Answer;
use crate::feature::{Feature, Hint, OnFace};
use crate::footing::{Footing, SLIDE};
use asunder_geometry::tolerance::MAX_POSITION;

/// Share of the smaller bounding radius by which two bodies may drift without a footing, 2^-15: of cubes of a metre, 26
/// micrometres. The reported error is up to twice that.
const DRIFT: f32 = 1.0 / 32_768.0;

/// Most error that a footing may add, as a share of its reach: as much as a drift without one.
const DRIFT_OF_SLIDE: f32 = DRIFT / SLIDE;

/// The conditions under which a manifold is moved along, in either dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Terms {
    pub(crate) overlapping: bool,
    /// Whether the points are measured from a face of B (an edge, in the plane); points that are measured from no face
    /// count as measured from A.
    pub(crate) is_from_b: bool,
    pub(crate) margin: f32,
    /// The drift up to which the answer holds, in metres.
    pub(crate) slack: f32,
    /// How far the bodies reach from their positions, in metres.
    pub(crate) arms: [f32; 2],
    pub(crate) footing: Option<Footing>,
}

/// How bodies moved since a manifold was computed.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    /// No point moved further than that, in metres.
    pub(crate) drift: f64,
    /// By how much they turned against each other, in radians, times the arm of the one that is taken to move.
    pub(crate) spun: f64,
    /// By how much the deepest point rose, in metres.
    pub(crate) rise: f64,
}

/// Whether these can be the lengths of a manifold that is kept, in metres: so far from the limits of f32 that nothing
/// computed from them is infinite.
pub(crate) fn are_lengths(lengths: &[f32]) -> bool {
    lengths.iter().all(|length| length.abs() <= MAX_POSITION as f32)
}

impl Terms {
    /// Whether they are possible for a manifold with this separation and error.
    pub(crate) fn are_sound(&self, found: [f32; 2]) -> bool {
        let most = slack_of(found, self.overlapping, self.margin, self.arms).unwrap_or(-1.0);
        are_lengths(&[found[0], found[1], self.margin, self.arms[0], self.arms[1]])
            && self.arms.iter().all(|arm| *arm >= 0.0)
            && (0.0..=most).contains(&self.slack)
            && self.footing.is_none_or(|footing| footing.is_sound(self.arms))
    }

    /// The drift beyond which they certainly do not hold, in metres.
    #[inline(always)]
    pub(crate) fn reach(&self) -> f32 {
        self.footing.map_or(self.slack, |footing| footing.reach.max(self.slack))
    }

    /// The error of a separation after a motion, given its error before; `None` where it must be recomputed.
    #[inline(always)]
    pub(crate) fn error_after(&self, [separation, error]: [f32; 2], way: &Way) -> Option<f32> {
        let Way { drift, spun, rise } = *way;
        let (then, known) = (f64::from(separation), f64::from(error));
        let rounding = f64::from(f32::EPSILON) * (then.abs() + drift);
        if let Some(footing) = self.footing.filter(|footing| drift <= f64::from(footing.reach)) {
            let loss = footing.loss(drift, spun);
            let (now, error) = (then + rise, known + loss + rounding);
            let is_certain = if self.overlapping {
                now + error < 0.0
            } else {
                now - error > 0.0 && now + error <= f64::from(self.margin)
            };
            if is_certain && loss <= f64::from(footing.reach * DRIFT_OF_SLIDE) {
                return Some((error as f32).next_up());
            }
        }
        // The true separation may have changed the other way.
        let is_close = drift <= f64::from(self.slack);
        is_close.then(|| ((known + drift + rise.abs() + rounding) as f32).next_up())
    }
}

/// The drift up to which bodies of these bounding radii may keep an answer, in metres.
pub(crate) fn reach_of(radii: [f32; 2]) -> f32 {
    DRIFT * radii[0].min(radii[1])
}

/// The same with the widest footing possible.
pub(crate) fn widest_reach_of(radii: [f32; 2]) -> f32 {
    SLIDE * radii[0].min(radii[1])
}

/// The drift up to which an answer with this separation and error stays as it is, in metres; `None` where it is too
/// close to call.
pub(crate) fn slack_of(
    [separation, error]: [f32; 2],
    overlapping: bool,
    margin: f32,
    radii: [f32; 2],
) -> Option<f32> {
    // In overlap the margin does not matter.
    let to_margin = if overlapping { f32::INFINITY } else { margin - separation };
    let sure = (separation.abs().min(to_margin) - error).next_down();
    let slack = reach_of(radii).min(sure);
    (slack > 0.0).then_some(slack)
}

/// The face (edge, in the plane) that points may be measured from, by the hint that was left with them. `None` where
/// there is none: two edges that cross, a direction. Vertices across a gap may have one too: compare its normal.
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

/// By how much a normal may differ from that of its face: the rounding of both.
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

/// Rounding error of the difference of two offsets, by the sum of one's coordinates, and of unit vectors times an arm,
/// in metres.
#[inline(always)]
pub(crate) fn lost(summed: f64, arm: f64) -> f64 {
    64.0 * f64::EPSILON * (summed + arm)
}
