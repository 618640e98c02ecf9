//! One pair in the plane, and batches of them.

use crate::answer::{Closest2, ContactPoint2, Manifold2, Measured2, Separation2};
use crate::batch::{Batch2, Touch};
use crate::feature::Hint;
use crate::polygon::distance::{Witness, distance};
use crate::polygon::manifold::touch;
use crate::polygon::outline::Outline;
use crate::polygon::sat::{Axes, Axis, Outcome, hint_of, overlaps, separating_axes};
use crate::precision::{Precision, at_least, signed};
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Pose2, Rotation2, Shape2};

/// Two posed shapes in the plane, ready to be asked about each other.
///
/// Positions are subtracted in f64 before anything else, so that nothing degrades far from the origin.
///
/// ```
/// use asunder_geometry::{Pose2, Rect, Shape2, glam::Vec2};
/// use asunder_narrow::Pair2;
/// let square = Shape2::from(Rect::from_half_extents(Vec2::splat(0.5))?);
/// let (left, right) = (Pose2::at([1e9 - 2.0, 0.0])?, Pose2::at([1e9, 0.0])?);
/// let closest = Pair2::new(&square, &left, &square, &right).distance().ok_or("they are apart")?;
/// assert!((closest.distance - 1.0).abs() <= closest.error);
/// assert_eq!((closest.anchor_a.x, closest.anchor_b.x), (0.5, -0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pair2<'a> {
    shape_a: &'a Shape2,
    shape_b: &'a Shape2,
    rotation_a: Rotation2,
    rotation_b: Rotation2,
    /// B's position less A's.
    offset: DVec2,
}

impl<'a> Pair2<'a> {
    /// A pair of posed shapes.
    pub fn new(shape_a: &'a Shape2, pose_a: &Pose2, shape_b: &'a Shape2, pose_b: &Pose2) -> Self {
        let (rotation_a, rotation_b) = (pose_a.rotation(), pose_b.rotation());
        Self { shape_a, shape_b, rotation_a, rotation_b, offset: pose_b.position() - pose_a.position() }
    }

    /// The sum of the two bounding radii, in metres: what tolerances of this pair are relative to.
    pub fn size(&self) -> f32 {
        self.shape_a.outer_radius() + self.shape_b.outer_radius()
    }

    /// Whether the shapes share a point; touching counts. Decided in f64 for now. Cost: as the separation, but the
    /// first separating axis ends it.
    pub fn overlaps(&self) -> bool {
        self.with_outlines(overlaps)
    }

    /// The separation, exact up to its error where it is at most `limit` metres, which may be infinite.
    ///
    /// Beyond the limit it may stop at any axis that shows so much, with [`Separation2::AtLeast`]. A NaN counts as
    /// no limit, and a negative limit as zero. Cost: the product of the vertex counts; in a gap within the limit a few support
    /// searches more, for the Euclidean distance.
    pub fn separation(&self, limit: f32) -> Separation2 {
        let limit = if limit.is_nan() { f64::INFINITY } else { f64::from(limit).max(0.0) };
        self.with_outlines(|a, b| {
            match separating_axes(a, b, limit + self.precision().projection(), Hint::NONE) {
                Outcome::Beyond(axis) => Separation2::AtLeast(at_least(axis.separation, &self.precision())),
                Outcome::Within(axes) => Separation2::Measured(self.measure(a, b, &axes).measured),
            }
        })
    }

    /// The closest points of shapes that do not overlap; nothing where they do. Cost: as the separation without a limit.
    pub fn distance(&self) -> Option<Closest2> {
        self.with_outlines(|a, b| {
            let Outcome::Within(axes) = separating_axes(a, b, f64::INFINITY, Hint::NONE) else { return None };
            let Found { measured, witness, .. } = self.measure(a, b, &axes);
            let witness = witness?;
            Some(Closest2 {
                distance: measured.separation,
                error: measured.error,
                normal: measured.normal,
                anchor_a: self.anchor_a(witness.point_a),
                anchor_b: self.anchor_b(witness.point_b),
            })
        })
    }

    /// How the shapes touch, if they are at most `margin` metres apart; a margin below zero, or NaN, counts as zero.
    ///
    /// A point may lie up to the margin outside. Cost: as the separation, plus clipping two edges.
    pub fn manifold(&self, margin: f32) -> Option<Manifold2> {
        self.contact(margin, Hint::NONE).1?.1
    }

    /// The hint for the next frame, and a manifold where the shapes are within the margin, with the decision.
    fn contact(&self, margin: f32, hint: Hint) -> (Hint, Option<Touch<Manifold2>>) {
        let margin = f64::from(margin).max(0.0);
        self.with_outlines(|a, b| {
            let axes = match separating_axes(a, b, margin + self.precision().projection(), hint) {
                Outcome::Beyond(axis) => return (hint_of(&axis), None),
                Outcome::Within(axes) => axes,
            };
            let hint = hint_of(axes.best());
            let Found { overlapping, measured, witness } = self.measure(a, b, &axes);
            if !overlapping && f64::from(measured.separation) > margin {
                return (hint, None);
            }
            let touch = touch(a, b, &axes, witness.as_ref(), margin, self.preference());
            let points = touch.points.iter().map(|point| ContactPoint2 {
                separation: point.separation as f32,
                anchor_a: self.anchor_a(point.on_a),
                anchor_b: self.anchor_b(point.on_b),
                feature: point.feature,
            });
            let manifold = Manifold2 {
                part_a: 0,
                part_b: 0,
                normal: touch.normal.as_vec2(),
                separation: measured.separation,
                error: measured.error,
                points: points.collect(),
            };
            (hint, Some((overlapping, Some(manifold))))
        })
    }

    /// Whether the shapes are within the margin, for a sensor, which wants no points.
    fn senses(&self, margin: f32, hint: Hint) -> (Hint, Option<Touch<Manifold2>>) {
        let margin = f64::from(margin).max(0.0);
        self.with_outlines(|a, b| match separating_axes(a, b, margin + self.precision().projection(), hint) {
            Outcome::Beyond(axis) => (hint_of(&axis), None),
            Outcome::Within(axes) => {
                let found = self.measure(a, b, &axes);
                let within = found.overlapping || f64::from(found.measured.separation) <= margin;
                (hint_of(axes.best()), within.then_some((found.overlapping, None)))
            }
        })
    }

    /// Turns the best axes into the reported separation: the decision first, then the number that agrees with it.
    fn measure(&self, a: &Outline, b: &Outline, axes: &Axes) -> Found {
        let precision = self.precision();
        let best = axes.best();
        // Within its error of zero a sign is not the number's to tell: `overlaps` decides, so that both always agree.
        let is_clear = best.separation.abs() > f64::from(precision.of_separation(0.0));
        let overlapping = if is_clear { best.separation < 0.0 } else { overlaps(a, b) };
        let in_overlap = Measured2 {
            separation: signed(best.separation, overlapping),
            error: precision.of_separation(best.separation),
            normal: best.normal.as_vec2(),
        };
        if overlapping {
            return Found { overlapping, measured: in_overlap, witness: None };
        }
        let witness = self.witness(a, b, best);
        let measured = Measured2 {
            separation: signed(witness.distance, false),
            error: precision.of_distance(witness.distance, witness.distance - witness.at_least),
            normal: witness.normal.as_vec2(),
        };
        Found { overlapping, measured, witness: Some(witness) }
    }

    /// Witness points of a gap, with the better of the two lower bounds: the iteration's, and the best axis'.
    fn witness(&self, a: &Outline, b: &Outline, best: &Axis) -> Witness {
        let size = f64::from(self.size());
        let mut witness = distance(a, b, best.normal, size).unwrap_or_else(|| {
            // Too close to tell apart by points: the support vertices along the axis are as good as any.
            let (in_a, in_b) = (a.support(best.normal).vertex, b.support(-best.normal).vertex);
            let on_a = a.point(in_a);
            Witness {
                distance: best.separation.max(0.0),
                at_least: best.separation,
                normal: best.normal,
                point_a: on_a,
                point_b: on_a + best.normal * best.separation.max(0.0),
                corners: core::iter::once([in_a, in_b]).collect(),
            }
        });
        if best.separation >= witness.at_least {
            (witness.at_least, witness.normal) = (best.separation, best.normal);
        }
        witness
    }

    fn with_outlines<R>(&self, ask: impl FnOnce(&Outline, &Outline) -> R) -> R {
        let (mut corners_a, mut corners_b) = ([Vec2::ZERO; 4], [Vec2::ZERO; 4]);
        let a = Outline::new(self.shape_a, &mut corners_a, self.rotation_a, DVec2::ZERO);
        let b = Outline::new(self.shape_b, &mut corners_b, self.rotation_b, self.offset);
        ask(&a, &b)
    }

    /// How much another axis must beat a face of A by, in metres. Relative to the smaller shape: what is nothing to a
    /// floor may be all of a pebble. Never below rounding.
    fn preference(&self) -> f64 {
        let smaller = f64::from(self.shape_a.outer_radius().min(self.shape_b.outer_radius()));
        (FACE_PREFERENCE * 2.0 * smaller).max(self.precision().projection())
    }

    fn precision(&self) -> Precision {
        let size = f64::from(self.size());
        let off_center =
            self.shape_a.center().as_dvec2().length() + self.shape_b.center().as_dvec2().length();
        Precision { size, reach: size + off_center + self.offset.length(), planarity: 0.0 }
    }

    fn anchor_a(&self, point: DVec2) -> Vec2 {
        point.as_vec2()
    }

    fn anchor_b(&self, point: DVec2) -> Vec2 {
        (point - self.offset).as_vec2()
    }
}

struct Found {
    overlapping: bool,
    measured: Measured2,
    /// Of shapes that do not overlap.
    witness: Option<Witness>,
}

/// One question of a batch: are these within the margin of each other, and how do they touch?
#[derive(Clone, Copy, Debug)]
pub struct Job2<'a> {
    /// Shape of A.
    pub shape_a: &'a Shape2,
    /// Pose of A.
    pub pose_a: &'a Pose2,
    /// Shape of B.
    pub shape_b: &'a Shape2,
    /// Pose of B.
    pub pose_b: &'a Pose2,
    /// Metres of gap within which a contact is wanted.
    pub margin: f32,
    /// What the last answer for this pair left, or [`Hint::NONE`].
    pub hint: Hint,
    /// Whether to leave out manifolds.
    pub sensor: bool,
}

/// Answers a slice of jobs, appending to the batch. Jobs do not influence each other.
///
/// ```
/// use asunder_geometry::{Rect, Pose2, Shape2, glam::Vec2};
/// use asunder_narrow::{Answer, Batch2, Hint, Job2, collide2};
/// let square = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
/// let (pose_a, pose_b) = (Pose2::IDENTITY, Pose2::at(Vec2::new(0.0, 1.5))?);
/// let job = Job2 {
///     shape_a: &square, pose_a: &pose_a, shape_b: &square, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE, sensor: false,
/// };
/// let mut batch = Batch2::default();
/// collide2(&[job], &mut batch);
/// assert!(matches!(&batch.answers[0], Answer::Contact { overlapping: true, manifolds, .. } if *manifolds == (0..1)));
/// batch.clear();
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn collide2(jobs: &[Job2<'_>], batch: &mut Batch2) {
    for job in jobs {
        let pair = Pair2::new(job.shape_a, job.pose_a, job.shape_b, job.pose_b);
        let (hint, touch) =
            if job.sensor { pair.senses(job.margin, job.hint) } else { pair.contact(job.margin, job.hint) };
        batch.push(hint, touch);
    }
}
