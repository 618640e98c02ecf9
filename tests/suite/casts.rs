//! Casts in space, against fine sampling with the exact overlap test, parry3d, and the laws they obey.
//!
//! The oracles are [`Pair3::overlaps`] and [`Pair3::separation`] at poses on the way, which are tested against exact
//! arithmetic elsewhere ([`exactness`](crate::exactness), [`separation`](crate::separation)).

mod hard;
mod moving;
mod peer;
mod rays;
mod stopped;
mod turning;

use asunder_geometry::glam::DVec3;
use asunder_geometry::{Motion3, Pose3, Shape3};
use asunder_narrow::{Impact3, Pair3, Separation3};
use asunder_tests::cases::Case3;

/// Poses on the way at which the oracles are evaluated, besides those next to the impact.
const SAMPLES: usize = 48;

/// A radius for a pair's size; an infinite shape adds nothing.
pub(crate) fn finite(radius: f32) -> f64 {
    if radius.is_finite() { radius.into() } else { 0.0 }
}

/// A case and the motions of both bodies.
pub(crate) struct Course<'a> {
    pub(crate) case: &'a Case3,
    pub(crate) motions: [Motion3; 2],
}

impl Course<'_> {
    /// The pair's size, in metres.
    pub(crate) fn size(&self) -> f64 {
        finite(self.case.shape_a.outer_radius()) + finite(self.case.shape_b.outer_radius())
    }

    pub(crate) fn poses(&self, fraction: f64) -> [Pose3; 2] {
        [(&self.motions[0], &self.case.pose_a), (&self.motions[1], &self.case.pose_b)]
            .map(|(motion, pose)| motion.pose_at(pose, fraction))
    }

    /// The separation at a fraction, at rounded poses, and its error.
    pub(crate) fn separation(&self, fraction: f64) -> (f64, f64) {
        let [a, b] = self.poses(fraction);
        match Pair3::new(&self.case.shape_a, &a, &self.case.shape_b, &b).separation(f32::INFINITY) {
            Separation3::Measured(found) => (found.separation.into(), found.error.into()),
            Separation3::AtLeast(bound) => panic!("no limit, yet no measure: {bound}"),
        }
    }

    /// How far off poses on the way may be: positions are rounded to f64, rotations to f32.
    pub(crate) fn rounding(&self) -> f64 {
        let Case3 { shape_a, pose_a, shape_b, pose_b } = self.case;
        let [a, b] = [(pose_a, &self.motions[0]), (pose_b, &self.motions[1])].map(|(pose, motion)| {
            2.0 * f64::EPSILON * (pose.position().abs() + motion.displacement().abs()).element_sum()
        });
        let arm = |shape: &Shape3| finite(shape.outer_radius()) + f64::from(shape.center().length());
        let apart = (pose_b.position() - pose_a.position()).length()
            + self.motions[0].displacement().length()
            + self.motions[1].displacement().length();
        let is_plane = |shape: &Shape3| matches!(shape, Shape3::HalfSpace(_));
        let lever = if is_plane(shape_a) || is_plane(shape_b) { apart } else { 0.0 };
        let turned = self.motions.iter().any(|motion| motion.rotation().is_some());
        let turn =
            if turned { 1.2e-7 * (2.0 * arm(shape_a) + 2.0 * arm(shape_b) + 2.0 * lever) } else { 0.0 };
        a + b + turn
    }

    /// Asserts that up to a fraction of the way nothing overlaps; of two that start nearer than rounding, and may move
    /// along each other, not deeper than that.
    pub(crate) fn check_free(&self, until: f64, message: &str) {
        let near = [1e-9, 1e-6, 1e-3].map(|share| until * (1.0 - share));
        for fraction in (0..=SAMPLES).map(|i| until * i as f64 / SAMPLES as f64).chain(near) {
            let [a, b] = self.poses(fraction);
            if Pair3::new(&self.case.shape_a, &a, &self.case.shape_b, &b).overlaps() {
                let [(first, doubt), (separation, error)] = [0.0, fraction].map(|at| self.separation(at));
                assert!(
                    first - doubt <= self.rounding() && separation + error >= -self.rounding(),
                    "{message}: {separation} at {fraction}, {first} at the start: {:?} {:?}",
                    self.case,
                    self.motions
                );
            }
        }
    }

    /// Checks an impact, or that there is none.
    pub(crate) fn check(&self, impact: Option<Impact3>, message: &str) {
        let start = Pair3::new(&self.case.shape_a, &self.case.pose_a, &self.case.shape_b, &self.case.pose_b);
        let Some(impact) = impact else {
            assert!(!start.overlaps(), "{message}: they overlap at the start: {:?}", self.case);
            return self.check_free(1.0, message);
        };
        let told = format!("{message}: {impact:?}, {:?} {:?}", self.case, self.motions);
        assert_eq!(impact.overlapping, start.overlaps(), "{told}");
        assert!((impact.normal.length() - 1.0).abs() < 1e-6, "{told}");
        assert!((0.0..=1.0).contains(&impact.fraction) && impact.error >= 0.0, "{told}");
        assert!(impact.anchor_a.is_finite() && impact.anchor_b.is_finite(), "{told}");
        if impact.overlapping {
            return assert!(impact.fraction == 0.0 && impact.error == 0.0, "{told}");
        }
        let (separation, error) = self.separation(impact.fraction);
        assert!(separation - error <= f64::from(impact.error), "{separation} {told}");
        self.check_free(impact.fraction, message);
        self.check_place(&impact, &told);
    }

    /// Asserts that the anchors are where the shapes meet, and that the normal separates them there.
    fn check_place(&self, impact: &Impact3, told: &str) {
        let [a, b] = self.poses(impact.fraction);
        let [on_a, on_b] = [impact.anchor_a, impact.anchor_b].map(|anchor| anchor.as_dvec3());
        let between = b.position() - a.position();
        // Anchors are f32, relative to each body's position.
        let reach = self.size() + on_a.length() + on_b.length() + between.length();
        let slack = f64::from(impact.error) + 4e-7 * reach + self.rounding();
        assert!((on_b + between - on_a).length() <= slack, "anchors {told}");
        let normal = impact.normal.as_dvec3().normalize();
        let highest = |shape: &Shape3, pose: &Pose3, along: DVec3| {
            let furthest = shape.support(pose.turn_back(along))?;
            Some(along.dot(pose.transform(furthest) - pose.position()))
        };
        let (top, bottom) =
            (highest(&self.case.shape_a, &a, normal), highest(&self.case.shape_b, &b, -normal));
        let is_whole = |shape: &Shape3| !matches!(shape, Shape3::Compound(_));
        if let (Some(top), Some(bottom), true, true) =
            (top, bottom, is_whole(&self.case.shape_a), is_whole(&self.case.shape_b))
        {
            let gap = normal.dot(between) - top - bottom;
            assert!(gap >= -slack, "the normal does not part them: {gap} {told}");
            assert!(normal.dot(on_a) >= top - slack && -normal.dot(on_b) >= bottom - slack, "{told}");
        }
    }
}
