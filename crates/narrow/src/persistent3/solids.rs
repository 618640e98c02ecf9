//! The one manifold of two solids, moved along: see `persistent`.

use super::hold::{Hold, arm_of, footing_of};
use crate::answer::{Answer, ContactPoint3, Manifold3};
use crate::feature::FeatureId;
use crate::jobs3::Job3;
use crate::persistent::{Terms, Way, lost, single, slack_of};
use crate::plumb::ends;
use crate::points::{Blank, ContactPoints, NOTHING};
use crate::precision::signed;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Pose3};

/// A manifold of two solids, and their poses when it was computed.
///
/// A frame of bodies at rest reads every one of these, and waits for memory: 64 bytes more made heaps of boxes 11 %
/// slower, and pyramids 7 % (AMD EPYC, Zen 4, 2026-11-23). So only one end of each point is kept: the other is its foot
/// along the normal (`plumb`).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Solids {
    /// The bodies' poses then.
    poses: [Pose3; 2],
    points: ContactPoints<Held, 4>,
    parts: [u32; 2],
    normal: Vec3,
    separation: f32,
    error: f32,
    /// Whether the kept ends are those on A.
    is_by_a: bool,
    terms: Terms,
}

/// A contact point by one of its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Held {
    separation: f32,
    anchor: Vec3,
    feature: FeatureId,
}

impl Blank for Held {
    const BLANK: Self = Self { separation: 0.0, anchor: Vec3::ZERO, feature: NOTHING };
}

impl Held {
    /// With both ends.
    #[inline(always)]
    fn between(&self, [on_a, on_b]: [DVec3; 2]) -> ContactPoint3 {
        let Self { separation, feature, .. } = *self;
        ContactPoint3 { separation, anchor_a: on_a.as_vec3(), anchor_b: on_b.as_vec3(), feature }
    }
}

impl Solids {
    /// What can be kept of an answer to a job; `manifolds` are those of the answer's batch.
    ///
    /// `None` where the bodies are beyond the margin, or so close to it or to touching that rounding may have decided;
    /// where they touch in several parts; and where points are neither on a face, nor where two edges cross, nor,
    /// between single solids, across a gap from each other. Cost: some square roots, and linear in the vertices of a
    /// face.
    pub(super) fn of(job: &Job3<'_>, answer: &Answer, manifolds: &[Manifold3]) -> Option<Self> {
        let (hint, index, overlapping) = single(answer)?;
        let manifold = manifolds.get(index)?;
        let hold = Hold::of(job, hint, manifold, overlapping)?;
        let found = [manifold.separation, manifold.error];
        let slack = slack_of(
            found,
            overlapping,
            job.margin,
            [job.shape_a.outer_radius(), job.shape_b.outer_radius()],
        )?;
        let slack = if hold.is_gap { slack.min(LEAN * manifold.separation) } else { slack };
        let terms = Terms {
            overlapping,
            is_from_b: hold.is_from_b,
            margin: job.margin,
            slack,
            arms: [arm_of(job.shape_a), arm_of(job.shape_b)],
            footing: footing_of(job, manifold, hold.width),
        };
        if !terms.are_sound(found) {
            return None;
        }
        let poses = [job.pose_a, job.pose_b];
        let is_by_a = [hold.is_from_b, !hold.is_from_b]
            .into_iter()
            .find(|&is_by_a| manifold.is_plumb(is_by_a, between(poses)))?;
        Some(Self::new(manifold, is_by_a, terms, poses))
    }

    fn new(manifold: &Manifold3, is_by_a: bool, terms: Terms, poses: [&Pose3; 2]) -> Self {
        let held = |point: &ContactPoint3| Held {
            separation: point.separation,
            anchor: if is_by_a { point.anchor_a } else { point.anchor_b },
            feature: point.feature,
        };
        Self {
            poses: poses.map(|pose| *pose),
            points: manifold.points.iter().map(held).collect(),
            parts: [manifold.part_a, manifold.part_b],
            normal: manifold.normal,
            separation: manifold.separation,
            error: manifold.error,
            is_by_a,
            terms,
        }
    }

    /// The drift up to which this one can be moved along, in metres.
    pub(super) fn reach(&self) -> f32 {
        self.terms.reach()
    }

    /// The manifold as it was computed.
    pub(super) fn manifold(&self) -> Manifold3 {
        let (offset, normal) = (between(self.poses.each_ref()), self.normal.as_dvec3());
        let point = |point: &Held| point.between(self.ends_then(point, offset, normal));
        Manifold3 {
            part_a: self.parts[0],
            part_b: self.parts[1],
            normal: self.normal,
            separation: self.separation,
            error: self.error,
            points: self.points.iter().map(point).collect(),
        }
    }

    /// Whether the shapes overlapped, and do for as long as the manifold is carried on.
    pub(super) const fn overlapping(&self) -> bool {
        self.terms.overlapping
    }

    /// The margin that the manifold was made for, in metres.
    pub(super) const fn margin(&self) -> f32 {
        self.terms.margin
    }

    /// Whether the numbers beside the manifold are possible ones: for data that was read from a file.
    pub(super) fn is_sound(&self) -> bool {
        self.terms.are_sound([self.separation, self.error])
    }

    /// Appends the manifold as it is for the poses of A and B; returns false where it must be recomputed. Shapes and
    /// margin must be those of its job. Its error includes what the drift may cost. Cost: constant, least where no body
    /// turned.
    pub(super) fn carry_on(&self, poses: [&Pose3; 2], to: &mut Vec<Manifold3>) -> bool {
        if poses[0].same_rotation(&self.poses[0]) & poses[1].same_rotation(&self.poses[1]) {
            if (0..2).all(|i| poses[i].same_bits(&self.poses[i])) {
                to.push(self.manifold());
                return true;
            }
            return self.shift(between(poses), to);
        }
        let moved = self.turned(poses);
        // NaN is not close.
        let is_close = moved.drift <= f64::from(self.terms.reach());
        if is_close {
            to.push(Manifold3::BLANK);
            if to.last_mut().is_some_and(|manifold| self.fill(&moved, manifold)) {
                return true;
            }
            to.pop();
        }
        false
    }

    /// The same where neither body turned: all points rise alike, and stay where they are on one body. So the error is
    /// known before anything is written: a quarter fewer instructions than by the general path, which moves each point
    /// by itself.
    ///
    /// Tried: a point in four lanes, with its separation beside its anchor as they lie in memory: a twelfth more
    /// instructions (2026-11-24).
    #[inline(always)]
    fn shift(&self, offset: DVec3, to: &mut Vec<Manifold3>) -> bool {
        let step = offset - between(self.poses.each_ref());
        let arm = f64::from(self.terms.arms[0].min(self.terms.arms[1]));
        let drift = step.length() + lost(offset.abs().element_sum(), arm);
        let rise = self.normal.as_dvec3().dot(step);
        let way = Way { drift, spun: 0.0, rise };
        let Some(error) = self.terms.error_after([self.separation, self.error], &way) else { return false };
        to.push(Manifold3::BLANK);
        let Some(to) = to.last_mut() else { return false };
        ([to.part_a, to.part_b], to.normal) = (self.parts, self.normal);
        to.separation = signed(f64::from(self.separation) + rise, self.terms.overlapping);
        to.error = error;
        let (normal, is_from_b) = (self.normal.as_dvec3(), self.terms.is_from_b);
        to.points.fill(&self.points, |point| {
            let held = if self.is_by_a == is_from_b {
                point.anchor.as_dvec3()
            } else {
                self.ends_then(point, offset - step, normal)[usize::from(!is_from_b)]
            };
            let height = f64::from(point.separation) + rise;
            let now = Held { separation: height as f32, ..*point };
            now.between(ends(held, is_from_b, offset, normal * height))
        });
        true
    }

    /// Where a point's ends were, given the vector from A's position to B's then, and the normal.
    #[inline(always)]
    fn ends_then(&self, point: &Held, offset: DVec3, normal: DVec3) -> [DVec3; 2] {
        ends(point.anchor.as_dvec3(), self.is_by_a, offset, normal * f64::from(point.separation))
    }

    /// The motion, where a body turned.
    #[inline(never)]
    fn turned(&self, poses: [&Pose3; 2]) -> Moved {
        let (offset, offset_then) = (between(poses), between(self.poses.each_ref()));
        let normal_then = self.normal.as_dvec3();
        let of_a = poses[0].turn_since(&self.poses[0]);
        let of_b = poses[1].turn_since(&self.poses[1]);
        let spin = of_b.spin_from(&of_a);
        // Seen from either body as if it did not turn: both give a true bound on the drift.
        let drift_from = |seen_from: &Basis3, arm: f32| {
            let step = (offset - seen_from.turn(offset_then)).length();
            step + spin * f64::from(arm) + lost(offset.abs().element_sum(), arm.into())
        };
        let [arm_a, arm_b] = self.terms.arms;
        let [from_a, from_b] = [drift_from(&of_a, arm_b), drift_from(&of_b, arm_a)];
        // The normal turns with the body that sees the lesser drift of the other: along it, the separation holds for
        // both bodies as wholes.
        let (drift, arm, seen_from) =
            if from_a <= from_b { (from_a, arm_b, of_a) } else { (from_b, arm_a, of_b) };
        let (spun, normal) = (spin * f64::from(arm), seen_from.turn(normal_then));
        Moved { drift, spun, offset, normal, of_a, of_b, offset_then, normal_then }
    }

    /// The manifold as it is now, where a body turned; returns false where it must be recomputed.
    #[inline(never)]
    fn fill(&self, moved: &Moved, to: &mut Manifold3) -> bool {
        ([to.part_a, to.part_b], to.normal) = (self.parts, moved.normal.as_vec3());
        let (mut deepest, mut deepest_then) = (f64::INFINITY, f64::INFINITY);
        to.points.extend(self.points.iter().map(|point| {
            let then = f64::from(point.separation);
            let (is_from_b, ends_then) =
                (self.terms.is_from_b, self.ends_then(point, moved.offset_then, moved.normal_then));
            let (held, rise) = moved.held(ends_then, is_from_b);
            let height = then + rise;
            (deepest, deepest_then) = (deepest.min(height), deepest_then.min(then));
            // The other end is its foot on the face.
            let now = Held { separation: height as f32, ..*point };
            now.between(ends(held, is_from_b, moved.offset, moved.normal * height))
        }));
        let rise = deepest - deepest_then;
        to.separation = signed(f64::from(self.separation) + rise, self.terms.overlapping);
        let way = Way { drift: moved.drift, spun: moved.spun, rise };
        let error = self.terms.error_after([self.separation, self.error], &way);
        to.error = error.unwrap_or_default();
        error.is_some()
    }
}

/// How bodies moved since the manifold was computed, where one turned; in world axes.
struct Moved {
    drift: f64,
    /// Their rotation against each other times the arm of the one that is taken to move.
    spun: f64,
    /// From A's position to B's, now.
    offset: DVec3,
    /// From A to B, now.
    normal: DVec3,
    of_a: Basis3,
    of_b: Basis3,
    offset_then: DVec3,
    normal_then: DVec3,
}

impl Moved {
    /// The present position of a point, which stays on the body whose face it is not measured from, and by how much it
    /// rose over the other's face.
    ///
    /// The rise is the change, along the normal, of the vector from A's point to B's: short vectors, whose rounding is
    /// nothing beside the drift.
    #[inline(always)]
    fn held(&self, [on_a, on_b]: [DVec3; 2], is_from_b: bool) -> (DVec3, f64) {
        let (a, b) = (self.of_a.turn(on_a), self.of_b.turn(on_b));
        let rise =
            self.normal.dot(self.offset + b - a) - self.normal_then.dot(self.offset_then + on_b - on_a);
        (if is_from_b { a } else { b }, rise)
    }
}

/// Most that a normal across a gap between vertices and edges may lean: drift over gap.
const LEAN: f32 = 1.0 / 16.0;

/// From A's position to B's.
#[inline(always)]
fn between([a, b]: [&Pose3; 2]) -> DVec3 {
    b.position() - a.position()
}
