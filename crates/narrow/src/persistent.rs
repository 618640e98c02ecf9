//! How far two bodies may drift against each other until their manifold has to be made anew.
//!
//! ```text
//! drift = by how much any point of one body moved, seen from the other, since the manifold was made
//! every projection of either body, so the separation along any axis, changes by no more than the drift
//!     so the true separation does
//!     so whether they overlap, and are within the margin, is as it was while drift < how far off either is
//! the points stay where they are on one body, above the face of the other that they are measured from:
//!     their own separations are measured anew, and the normal turns with the body that sees the lesser drift
//!     what the faces share moves sideways under them by no more than the drift
//! ```
//! That alone costs up to twice the drift in error. Where what carries the bodies is wide the axis can be shown to stay
//! the best, and they may slide 32 times as far for a smaller error: see `footing`.
//!
//! Bullet and PhysX keep manifolds too ("persistent contact manifold"), until points slip by centimetres; parry3d until
//! one slips by a millimetre. Here the limit is a share of the bodies, what it costs goes into the error that is
//! reported, and it counts from where the manifold was made, not from frame to frame, so that it does not pile up.
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

/// What a footing may cost, as a share of how far it reaches: as much as a drift without one.
const DRIFT_OF_SLIDE: f32 = DRIFT / SLIDE;

/// What holds a manifold that is moved along to its bodies, in either dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Terms {
    pub(crate) overlapping: bool,
    /// Whether the points are measured from a face of B (an edge, in the plane); all that is from no face counts as if
    /// it were from A.
    pub(crate) is_from_b: bool,
    pub(crate) margin: f32,
    /// Up to which drift the answer holds, in metres.
    pub(crate) slack: f32,
    /// How far the bodies reach from their positions, in metres.
    pub(crate) arms: [f32; 2],
    pub(crate) footing: Option<Footing>,
}

/// How bodies moved since a manifold was made.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    /// No point moved further than that, in metres.
    pub(crate) drift: f64,
    /// By how much they turned against each other, in radians, times the arm of the one that is seen to move.
    pub(crate) spun: f64,
    /// By how much the deepest point rose, in metres.
    pub(crate) rise: f64,
}

/// Whether these can be the lengths of a manifold that is kept, in metres: so far from what f32 holds that nothing that
/// is made of them is infinite.
pub(crate) fn are_lengths(lengths: &[f32]) -> bool {
    lengths.iter().all(|length| length.abs() <= MAX_POSITION as f32)
}

impl Terms {
    /// Whether they can be those of a manifold with this separation, and this error.
    pub(crate) fn are_sound(&self, found: [f32; 2]) -> bool {
        let most = slack_of(found, self.overlapping, self.margin, self.arms).unwrap_or(-1.0);
        are_lengths(&[found[0], found[1], self.margin, self.arms[0], self.arms[1]])
            && self.arms.iter().all(|arm| *arm >= 0.0)
            && (0.0..=most).contains(&self.slack)
            && self.footing.is_none_or(|footing| footing.is_sound(self.arms))
    }

    /// Up to which drift it is worth looking, in metres.
    #[inline(always)]
    pub(crate) fn reach(&self) -> f32 {
        self.footing.map_or(self.slack, |footing| footing.reach.max(self.slack))
    }

    /// The error of a separation, which had this error, after such a way; nothing where it has to be asked about anew.
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
        // The truth may have gone the other way.
        let is_close = drift <= f64::from(self.slack);
        is_close.then(|| ((known + drift + rise.abs() + rounding) as f32).next_up())
    }
}

/// Up to which drift bodies of these bounding radii are told by what they were, in metres.
pub(crate) fn reach_of(radii: [f32; 2]) -> f32 {
    DRIFT * radii[0].min(radii[1])
}

/// The same where they have the widest footing that there can be.
pub(crate) fn widest_reach_of(radii: [f32; 2]) -> f32 {
    SLIDE * radii[0].min(radii[1])
}

/// Up to which drift an answer of this separation, and this error, stays what it is, in metres; nothing where it is too
/// close to call.
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

/// The face (edge, in the plane) that points may be measured from, by the hint that was left with them. Nothing where
/// they are from none: two edges that cross, a direction. Corners across a gap may have one too: ask their normal.
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

/// What rounding may cost in the difference of two offsets, by the sum of one's coordinates, and of unit vectors times
/// an arm, in metres.
#[inline(always)]
pub(crate) fn lost(summed: f64, arm: f64) -> f64 {
    64.0 * f64::EPSILON * (summed + arm)
}
