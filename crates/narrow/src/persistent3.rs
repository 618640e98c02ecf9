//! Manifolds in space that are moved along: see `persistent`.

mod hold;

use crate::answer::{Answer, ContactPoint3, Manifold3};
use crate::jobs3::Job3;
use crate::persistent::{Terms, Way, lost, single, slack_of, widest_reach_of};
use crate::precision::signed;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Pose3, Shape3};
use hold::{Hold, footing_of};

/// A manifold, and how its two bodies stood to each other when it was made: until they drift, it is moved along for a
/// fraction of what a new one costs.
///
/// Bodies that rest are never quite still. As long as no point of one has moved against the other by more than 2^-15 of
/// the smaller bounding radius, or by 2^-10 where they stand on each other broadly, the manifold holds: the same points of
/// the same features, with separations and a normal measured anew. Whether the shapes overlap, or are within the margin,
/// is for certain what it was: where that is too close to call, there is nothing to be moved along.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Batch3, Hint, Job3, Persistent3, collide3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (pose_a, pose_b) = (Pose3::IDENTITY, Pose3::at([0.5, 0.25, 1.875])?);
/// let job = Job3 {
///     shape_a: &cube, pose_a: &pose_a, shape_b: &cube, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE, sensor: false,
/// };
/// let mut batch = Batch3::default();
/// collide3(&[job], &mut batch);
/// let persistent = Persistent3::of(&job, &batch.answers[0], &batch.manifolds).expect("a face carries it");
///
/// let mut moved = Vec::new();
/// let sunk = Pose3::at([0.5, 0.25, 1.875 - 4e-6])?;
/// assert!(persistent.carry_on([&pose_a, &sunk], &mut moved) && persistent.overlapping());
/// assert!(persistent.reach() > 1e-3 && persistent.reach() <= Persistent3::most_reach(&job));
/// assert_eq!(Persistent3::lasting(&job, &batch.answers[0], &batch.manifolds, 0.1), None, "bodies as fast as that");
/// assert!((moved[0].points[0].separation + 0.125 + 4e-6).abs() < 1e-8);
/// assert_eq!(moved[0].points[0].feature, persistent.manifold().points[0].feature);
/// let gone = Pose3::at([0.5, 0.25, 1.875 - 4e-3])?;
/// assert!(!persistent.carry_on([&pose_a, &gone], &mut moved), "too far: it must be made anew");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Persistent3 {
    manifold: Manifold3,
    terms: Terms,
    /// Where the bodies were.
    poses: [Pose3; 2],
}

impl Persistent3 {
    /// What can be kept of an answer to a job, of the batch that these manifolds are from.
    ///
    /// Nothing where the bodies are apart, or so close to it or to the margin that rounding may have decided; where they
    /// touch in several parts; and where points are neither on a face, nor where two edges cross, nor, of single solids, across a
    /// gap from each other. Cost: some square roots, and linear in the vertices of a face.
    pub fn of(job: &Job3<'_>, answer: &Answer, manifolds: &[Manifold3]) -> Option<Self> {
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
        let arm = |shape: &Shape3| (shape.center().length() + shape.outer_radius()).next_up();
        let terms = Terms {
            overlapping,
            is_from_b: hold.is_from_b,
            margin: job.margin,
            slack,
            arms: [arm(job.shape_a), arm(job.shape_b)],
            footing: footing_of(job, manifold, hold.width),
        };
        let poses = [*job.pose_a, *job.pose_b];
        terms.are_sound().then(|| Self { manifold: manifold.clone(), terms, poses })
    }

    /// The same, of bodies that went so far in the last frame, in metres: nothing where one that goes on so would be of no
    /// use in the next.
    pub fn lasting(job: &Job3<'_>, answer: &Answer, manifolds: &[Manifold3], step: f64) -> Option<Self> {
        if step > f64::from(Self::most_reach(job)) {
            return None;
        }
        Self::of(job, answer, manifolds).filter(|made| step <= f64::from(made.reach()))
    }

    /// Up to which drift a manifold of this job can be moved along at most, in metres.
    pub fn most_reach(job: &Job3<'_>) -> f32 {
        widest_reach_of([job.shape_a.outer_radius(), job.shape_b.outer_radius()])
    }

    /// Up to which drift this one can be moved along, in metres.
    pub fn reach(&self) -> f32 {
        self.terms.reach()
    }

    /// The manifold as it was made.
    pub const fn manifold(&self) -> &Manifold3 {
        &self.manifold
    }

    /// Whether the shapes overlapped, and do for as long as the manifold is carried on.
    pub const fn overlapping(&self) -> bool {
        self.terms.overlapping
    }

    /// The margin that the manifold was made for, in metres.
    pub const fn margin(&self) -> f32 {
        self.terms.margin
    }

    /// Whether the numbers beside the manifold can be those of one: of what was read from a file.
    pub fn is_sound(&self) -> bool {
        self.terms.are_sound()
    }

    /// Appends the manifold as it is for the poses of A and B; says no where it has to be made anew. Shapes and margin
    /// must be those of its job. Its error holds what the drift may cost. Cost: constant, least where no body turned.
    pub fn carry_on(&self, poses: [&Pose3; 2], to: &mut Vec<Manifold3>) -> bool {
        if (0..2).all(|i| poses[i].same_bits(&self.poses[i])) {
            to.push(self.manifold.clone());
            return true;
        }
        if (0..2).all(|i| poses[i].same_rotation(&self.poses[i])) {
            return self.shift(between(poses), to);
        }
        let moved = self.turned(poses);
        // What is not a number is not close.
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

    /// The same where neither body turned: all points rise alike, and stay where they are on one body. That is known before
    /// anything is written: a quarter fewer instructions than by the general way, which moves each point by itself.
    #[inline(always)]
    fn shift(&self, offset: DVec3, to: &mut Vec<Manifold3>) -> bool {
        let of = &self.manifold;
        let step = offset - between(self.poses.each_ref());
        let normal = of.normal.as_dvec3();
        let arm = f64::from(self.terms.arms[0].min(self.terms.arms[1]));
        let drift = step.length() + lost(offset.abs().element_sum(), arm);
        let rise = normal.dot(step);
        let way = Way { drift, spun: 0.0, rise };
        let Some(error) = self.terms.error_after([of.separation, of.error], &way) else { return false };
        to.push(Manifold3::BLANK);
        let Some(to) = to.last_mut() else { return false };
        (to.part_a, to.part_b, to.normal) = (of.part_a, of.part_b, of.normal);
        to.separation = signed(f64::from(of.separation) + rise, self.terms.overlapping);
        to.error = error;
        let _ = to.points.try_extend_from_slice(&of.points);
        if self.terms.is_from_b {
            for point in &mut to.points {
                let height = f64::from(point.separation) + rise;
                point.separation = height as f32;
                point.anchor_b = (point.anchor_a.as_dvec3() - offset + normal * height).as_vec3();
            }
        } else {
            for point in &mut to.points {
                let height = f64::from(point.separation) + rise;
                point.separation = height as f32;
                point.anchor_a = (point.anchor_b.as_dvec3() + offset - normal * height).as_vec3();
            }
        }
        true
    }

    /// How bodies moved, of which one turned.
    #[inline(never)]
    fn turned(&self, poses: [&Pose3; 2]) -> Moved {
        let (offset, offset_then) = (between(poses), between(self.poses.each_ref()));
        let normal_then = self.manifold.normal.as_dvec3();
        let of_a = poses[0].turn_since(&self.poses[0]);
        let of_b = poses[1].turn_since(&self.poses[1]);
        let spin = of_b.spin_from(&of_a);
        // As seen from a body that does not turn: what either says of the drift is true.
        let drift_from = |seen_from: &Basis3, arm: f32| {
            let step = (offset - seen_from.turn(offset_then)).length();
            step + spin * f64::from(arm) + lost(offset.abs().element_sum(), arm.into())
        };
        let [arm_a, arm_b] = self.terms.arms;
        let [from_a, from_b] = [drift_from(&of_a, arm_b), drift_from(&of_b, arm_a)];
        // The normal turns with the body that sees the other drift less: along it, what is told is true of both as wholes.
        let (drift, arm, seen_from) =
            if from_a <= from_b { (from_a, arm_b, of_a) } else { (from_b, arm_a, of_b) };
        let (spun, normal) = (spin * f64::from(arm), seen_from.turn(normal_then));
        Moved { drift, spun, offset, normal, of_a, of_b, offset_then, normal_then }
    }

    /// The manifold as it is now, of bodies of which one turned; says no where it has to be made anew.
    #[inline(never)]
    fn fill(&self, moved: &Moved, to: &mut Manifold3) -> bool {
        let of = &self.manifold;
        (to.part_a, to.part_b, to.normal) = (of.part_a, of.part_b, moved.normal.as_vec3());
        let (mut deepest, mut deepest_then) = (f64::INFINITY, f64::INFINITY);
        to.points.extend(of.points.iter().map(|point| {
            let then = f64::from(point.separation);
            let (held, rise) = moved.held([point.anchor_a, point.anchor_b], self.terms.is_from_b);
            let height = then + rise;
            let out = moved.normal * height;
            // Its foot on the face, from the other position.
            let (on_a, on_b) = if self.terms.is_from_b {
                (held, held - moved.offset + out)
            } else {
                (held + moved.offset - out, held)
            };
            (deepest, deepest_then) = (deepest.min(height), deepest_then.min(then));
            ContactPoint3 {
                separation: height as f32,
                anchor_a: on_a.as_vec3(),
                anchor_b: on_b.as_vec3(),
                feature: point.feature,
            }
        }));
        let rise = deepest - deepest_then;
        to.separation = signed(f64::from(of.separation) + rise, self.terms.overlapping);
        let way = Way { drift: moved.drift, spun: moved.spun, rise };
        let error = self.terms.error_after([of.separation, of.error], &way);
        to.error = error.unwrap_or_default();
        error.is_some()
    }
}

/// How bodies moved since, of which one turned; in world axes.
struct Moved {
    drift: f64,
    /// Their spin against each other times the arm of the one that is seen to move.
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
    /// Where the point is now that is held by the body whose face it is not, and by how much it rose over the other's.
    ///
    /// What rose is the way from A's point to B's, along the normal: short vectors, whose rounding is nothing beside the
    /// drift.
    #[inline(always)]
    fn held(&self, [on_a, on_b]: [Vec3; 2], is_from_b: bool) -> (DVec3, f64) {
        let (on_a, on_b) = (on_a.as_dvec3(), on_b.as_dvec3());
        let (a, b) = (self.of_a.turn(on_a), self.of_b.turn(on_b));
        let rise =
            self.normal.dot(self.offset + b - a) - self.normal_then.dot(self.offset_then + on_b - on_a);
        (if is_from_b { a } else { b }, rise)
    }
}

/// Most that a normal may lean that leads across a gap between corners and edges, by drift over gap.
const LEAN: f32 = 1.0 / 16.0;

/// From A's position to B's.
#[inline(always)]
fn between([a, b]: [&Pose3; 2]) -> DVec3 {
    b.position() - a.position()
}
