//! One pair in space, and batches of them.

use crate::answer::{Closest3, ContactPoint3, Manifold3, Measured3, Separation3};
use crate::batch::{Batch3, Touch};
use crate::feature::Hint;
use crate::polyhedron::cuboids::Cuboids;
use crate::polyhedron::distance::{Witness, distance};
use crate::polyhedron::manifold::touch;
use crate::polyhedron::sat::{Axes, Axis, Outcome, hint_of, overlaps, separating_axes};
use crate::polyhedron::solid::Solid;
use crate::precision::{Precision, at_least, signed};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::{FACE_PREFERENCE, THIN};
use asunder_geometry::{Basis3, Hull, Pose3, Shape3};

/// Two posed shapes in space, ready to be asked about each other.
///
/// The relative pose is computed once, in f64: positions are subtracted before anything is turned, so that nothing
/// degrades far from the origin.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::Pair3;
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5))?);
/// let (left, right) = (Pose3::at([1e9 - 2.0, 0.0, 0.0])?, Pose3::at([1e9, 0.0, 0.0])?);
/// let closest = Pair3::new(&cube, &left, &cube, &right).distance().ok_or("they are apart")?;
/// assert!((closest.distance - 1.0).abs() <= closest.error);
/// assert_eq!((closest.anchor_a.x, closest.anchor_b.x), (0.5, -0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pair3<'a> {
    shape_a: &'a Shape3,
    shape_b: &'a Shape3,
    /// A's axes in the world.
    basis_a: Basis3,
    /// B's axes seen from A.
    relative: Basis3,
    /// B's position seen from A.
    offset: DVec3,
}

const IDENTITY: Basis3 = Basis3 { x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

impl<'a> Pair3<'a> {
    /// A pair of posed shapes. Cost: two rotations to matrices and their product.
    pub fn new(shape_a: &'a Shape3, pose_a: &Pose3, shape_b: &'a Shape3, pose_b: &Pose3) -> Self {
        let (basis_a, basis_b) = (pose_a.basis(), pose_b.basis());
        let offset = basis_a.turn_back(pose_b.position() - pose_a.position());
        Self { shape_a, shape_b, basis_a, relative: basis_b.relative_to(&basis_a), offset }
    }

    /// The sum of the two bounding radii, in metres: what tolerances of this pair are relative to.
    pub fn size(&self) -> f32 {
        self.shape_a.outer_radius() + self.shape_b.outer_radius()
    }

    /// Whether the shapes share a point; touching counts. Decided in f64 for now. Cost: as the separation, but the
    /// first separating axis ends it.
    pub fn overlaps(&self) -> bool {
        self.with_solids(|a, b| self.decide(a, b))
    }

    /// The separation, exact up to its error where it is at most `limit` metres, which may be infinite.
    ///
    /// Beyond the limit it may stop at any axis that shows so much, with [`Separation3::AtLeast`]. A NaN counts as
    /// no limit, and a negative limit as zero. Cost for two hulls: faces times vertices, plus edge pairs; fifteen axes
    /// for cuboids; in a gap within the limit a few support searches more, for the Euclidean distance.
    pub fn separation(&self, limit: f32) -> Separation3 {
        let limit = if limit.is_nan() { f64::INFINITY } else { f64::from(limit).max(0.0) };
        self.with_solids(|a, b| match self.axes(a, b, limit + self.precision().projection(), Hint::NONE) {
            Outcome::Beyond(axis) => Separation3::AtLeast(at_least(axis.separation, &self.precision())),
            Outcome::Within(axes) => Separation3::Measured(self.measure(a, b, &axes).measured),
        })
    }

    /// The closest points of shapes that do not overlap; nothing where they do. Cost: as the separation without a limit.
    pub fn distance(&self) -> Option<Closest3> {
        self.with_solids(|a, b| {
            let Outcome::Within(axes) = self.axes(a, b, f64::INFINITY, Hint::NONE) else { return None };
            let Found { measured, witness, .. } = self.measure(a, b, &axes);
            let witness = witness?;
            Some(Closest3 {
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
    /// A point may lie up to the margin outside. Cost: as the separation, plus clipping two faces.
    pub fn manifold(&self, margin: f32) -> Option<Manifold3> {
        self.contact(margin, Hint::NONE).1?.1
    }

    /// The hint for the next frame, and a manifold where the shapes are within the margin, with the decision.
    fn contact(&self, margin: f32, hint: Hint) -> (Hint, Option<Touch<Manifold3>>) {
        let margin = f64::from(margin).max(0.0);
        self.with_solids(|a, b| {
            let axes = match self.axes(a, b, margin + self.precision().projection(), hint) {
                Outcome::Beyond(axis) => return (hint_of(&axis), None),
                Outcome::Within(axes) => axes,
            };
            let hint = hint_of(axes.best());
            let Found { overlapping, measured, witness } = self.measure(a, b, &axes);
            if !overlapping && f64::from(measured.separation) > margin {
                return (hint, None);
            }
            let touch = touch(a, b, &axes, witness.as_ref(), margin, self.preference());
            let points = touch.points.iter().map(|point| ContactPoint3 {
                separation: point.separation as f32,
                anchor_a: self.anchor_a(point.on_a),
                anchor_b: self.anchor_b(point.on_b),
                feature: point.feature,
            });
            let manifold = Manifold3 {
                part_a: 0,
                part_b: 0,
                normal: self.basis_a.turn(touch.normal).as_vec3(),
                separation: measured.separation,
                error: measured.error,
                points: points.collect(),
            };
            (hint, Some((overlapping, Some(manifold))))
        })
    }

    /// Whether the shapes are within the margin, for a sensor, which wants no points.
    fn senses(&self, margin: f32, hint: Hint) -> (Hint, Option<Touch<Manifold3>>) {
        let margin = f64::from(margin).max(0.0);
        self.with_solids(|a, b| match self.axes(a, b, margin + self.precision().projection(), hint) {
            Outcome::Beyond(axis) => (hint_of(&axis), None),
            Outcome::Within(axes) => {
                let found = self.measure(a, b, &axes);
                let within = found.overlapping || f64::from(found.measured.separation) <= margin;
                (hint_of(axes.best()), within.then_some((found.overlapping, None)))
            }
        })
    }

    /// Turns the best axes into the reported separation: the decision first, then the number that agrees with it.
    fn measure(&self, a: &Solid, b: &Solid, axes: &Axes) -> Found {
        let precision = self.precision();
        let best = axes.best();
        // Within its error of zero a sign is not the number's to tell: `overlaps` decides, so that both always agree.
        let is_clear = best.separation.abs() > f64::from(precision.of_separation(0.0)) && !self.is_thin();
        let overlapping = if is_clear { best.separation < 0.0 } else { self.decide(a, b) };
        let in_overlap = Measured3 {
            separation: signed(best.separation, overlapping),
            error: precision.of_separation(best.separation),
            normal: self.basis_a.turn(best.normal).as_vec3(),
        };
        if overlapping {
            return Found { overlapping, measured: in_overlap, witness: None };
        }
        let witness = self.witness(a, b, best);
        let measured = Measured3 {
            separation: signed(witness.distance, false),
            error: precision.of_distance(witness.distance, witness.distance - witness.at_least),
            normal: self.basis_a.turn(witness.normal).as_vec3(),
        };
        Found { overlapping, measured, witness: Some(witness) }
    }

    /// Witness points of a gap, with the better of the two lower bounds: the iteration's, and the best axis'.
    fn witness(&self, a: &Solid, b: &Solid, best: &Axis) -> Witness {
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

    pub(crate) fn axes(&self, a: &Solid, b: &Solid, limit: f64, hint: Hint) -> Outcome {
        match self.cuboids() {
            Some(cuboids) => cuboids.separating_axes(a, b, limit, hint),
            None => {
                let slack = self.preference() + 4.0 * self.precision().planarity;
                separating_axes(a, b, limit, hint, slack)
            }
        }
    }

    fn decide(&self, a: &Solid, b: &Solid) -> bool {
        match self.cuboids() {
            Some(cuboids) => cuboids.overlaps(),
            None => overlaps(a, b) && !(self.is_thin() && self.is_parted(a, b)),
        }
    }

    /// Whether a shape is so thin that its faces are all but antipodal. The directions along a plate or across a needle
    /// are then no normals of its own, and face and edge axes show a gap in them only scaled by the thickness: too
    /// little to tell from rounding.
    fn is_thin(&self) -> bool {
        let thin = |shape: &Shape3| match shape {
            // A cuboid has the normals of its sides, however thin it is.
            Shape3::Cuboid(_) => false,
            Shape3::Hull(hull) => hull.inner_radius() < THIN * hull.outer_radius(),
        };
        thin(self.shape_a) || thin(self.shape_b)
    }

    /// Whether the distance iteration finds an axis that parts the shapes. It needs no normals, and its axis is
    /// believed only after full projection.
    fn is_parted(&self, a: &Solid, b: &Solid) -> bool {
        let precision = self.precision();
        let witness = distance(a, b, DVec3::X, precision.size);
        witness.is_some_and(|witness| witness.at_least > precision.projection())
    }

    fn cuboids(&self) -> Option<Cuboids> {
        let (Shape3::Cuboid(a), Shape3::Cuboid(b)) = (self.shape_a, self.shape_b) else { return None };
        let (half_a, half_b) = (a.half_extents().as_dvec3(), b.half_extents().as_dvec3());
        Some(Cuboids { half_a, half_b, basis: self.relative, offset: self.offset })
    }

    pub(crate) fn with_solids<R>(&self, ask: impl FnOnce(&Solid, &Solid) -> R) -> R {
        let (mut corners_a, mut corners_b) = ([Vec3::ZERO; 8], [Vec3::ZERO; 8]);
        let a = Solid::new(self.shape_a, &mut corners_a, IDENTITY, DVec3::ZERO);
        let b = Solid::new(self.shape_b, &mut corners_b, self.relative, self.offset);
        ask(&a, &b)
    }

    /// How much another axis must beat a face of A by, in metres. Relative to the smaller shape: what is nothing to a
    /// floor may be all of a pebble. Never below rounding.
    fn preference(&self) -> f64 {
        let smaller = f64::from(self.shape_a.outer_radius().min(self.shape_b.outer_radius()));
        (FACE_PREFERENCE * 2.0 * smaller).max(self.precision().projection())
    }

    pub(crate) fn precision(&self) -> Precision {
        let planarity = |shape: &Shape3| match shape {
            Shape3::Cuboid(_) => 0.0,
            Shape3::Hull(hull) => f64::from(Hull::planarity_error(hull)),
        };
        let size = f64::from(self.size());
        let off_center =
            self.shape_a.center().as_dvec3().length() + self.shape_b.center().as_dvec3().length();
        Precision {
            size,
            reach: size + off_center + self.offset.length(),
            planarity: planarity(self.shape_a) + planarity(self.shape_b),
        }
    }

    fn anchor_a(&self, point: DVec3) -> Vec3 {
        self.basis_a.turn(point).as_vec3()
    }

    fn anchor_b(&self, point: DVec3) -> Vec3 {
        self.basis_a.turn(point - self.offset).as_vec3()
    }
}

struct Found {
    overlapping: bool,
    measured: Measured3,
    /// Of shapes that do not overlap.
    witness: Option<Witness>,
}

/// One question of a batch: are these within the margin of each other, and how do they touch?
#[derive(Clone, Copy, Debug)]
pub struct Job3<'a> {
    /// Shape of A.
    pub shape_a: &'a Shape3,
    /// Pose of A.
    pub pose_a: &'a Pose3,
    /// Shape of B.
    pub shape_b: &'a Shape3,
    /// Pose of B.
    pub pose_b: &'a Pose3,
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
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::at(Vec3::new(0.0, 0.0, 1.5))?);
/// let job = Job3 {
///     shape_a: &cube, pose_a: &pose_a, shape_b: &cube, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE, sensor: false,
/// };
/// let mut batch = Batch3::default();
/// collide3(&[job], &mut batch);
/// assert!(matches!(&batch.answers[0], Answer::Contact { overlapping: true, manifolds, .. } if *manifolds == (0..1)));
/// batch.clear();
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn collide3(jobs: &[Job3<'_>], batch: &mut Batch3) {
    for job in jobs {
        let pair = Pair3::new(job.shape_a, job.pose_a, job.shape_b, job.pose_b);
        let (hint, touch) =
            if job.sensor { pair.senses(job.margin, job.hint) } else { pair.contact(job.margin, job.hint) };
        batch.push(hint, touch);
    }
}
