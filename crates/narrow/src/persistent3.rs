//! Manifolds in space that are moved along: see `persistent`.

use crate::answer::{Answer, ContactPoint3, Manifold3};
use crate::feature::{Feature, Hint, OnFace};
use crate::jobs3::Job3;
use crate::persistent::{THEIRS, Terms, error_after, lost, measured_from, reach_of, single, slack_of};
use crate::precision::signed;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Pose3, Shape3};

/// A manifold, and how its two bodies stood to each other when it was made: until they drift, it is moved along for a
/// fraction of what a new one costs.
///
/// Bodies that rest are never quite still. As long as no point of one has moved against the other by more than 2^-15 of
/// the smaller bounding radius, the manifold holds: the same points of the same features, with separations and a normal
/// measured anew. Whether the shapes overlap, or are within the margin, is for certain what it was: where that is
/// closer to call than the drift, there is nothing to be moved along.
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
/// assert!(Persistent3::reach(&job) > 4e-5 && Persistent3::reach(&job) < 4e-4);
/// assert!((moved[0].points[0].separation + 0.125 + 4e-6).abs() < 1e-8);
/// assert_eq!(moved[0].points[0].feature, persistent.manifold().points[0].feature);
/// let gone = Pose3::at([0.5, 0.25, 1.875 - 4e-4])?;
/// assert!(!persistent.carry_on([&pose_a, &gone], &mut moved), "too far: it must be made anew");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Persistent3 {
    manifold: Manifold3,
    terms: Terms,
    /// The directions that two edges which cross had, in world axes.
    edges: Option<[Vec3; 2]>,
    /// Where the bodies were.
    poses: [Pose3; 2],
}

impl Persistent3 {
    /// What can be kept of an answer to a job, of the batch that these manifolds are from.
    ///
    /// Nothing where the bodies are apart, or so close to it or to the margin that rounding may have decided; where they
    /// touch in several parts; and where points are neither on a face nor where two edges cross. Cost: some square roots.
    pub fn of(job: &Job3<'_>, answer: &Answer, manifolds: &[Manifold3]) -> Option<Self> {
        let (hint, index, overlapping) = single(answer)?;
        let manifold = manifolds.get(index)?;
        let face = measured_from(hint);
        let edges = match face {
            Some(face) => is_normal_of(job, face, manifold).then_some(None)?,
            None => Some(crossing(job, hint, manifold)?),
        };
        let found = [manifold.separation, manifold.error];
        let slack = slack_of(
            found,
            overlapping,
            job.margin,
            [job.shape_a.outer_radius(), job.shape_b.outer_radius()],
        )?;
        let arm = |shape: &Shape3| (shape.center().length() + shape.outer_radius()).next_up();
        let terms = Terms {
            overlapping,
            is_from_b: matches!(face, Some(OnFace::OfB(_))),
            margin: job.margin,
            slack,
            arms: [arm(job.shape_a), arm(job.shape_b)],
        };
        let poses = [*job.pose_a, *job.pose_b];
        terms.are_sound().then(|| Self { manifold: manifold.clone(), terms, edges, poses })
    }

    /// Up to which drift a manifold of this job can be moved along at most, in metres: where bodies move more than that in
    /// a frame, keeping one is no use.
    pub fn reach(job: &Job3<'_>) -> f32 {
        reach_of([job.shape_a.outer_radius(), job.shape_b.outer_radius()])
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
    /// must be those of its job. Its error holds the drift. Cost: constant, least where no body turned.
    pub fn carry_on(&self, poses: [&Pose3; 2], to: &mut Vec<Manifold3>) -> bool {
        if (0..2).all(|i| poses[i].same_bits(&self.poses[i])) {
            to.push(self.manifold.clone());
            return true;
        }
        let moved = if (0..2).all(|i| poses[i].same_rotation(&self.poses[i])) {
            self.shifted(between(poses))
        } else {
            self.turned(poses)
        };
        // What is not a number is not close.
        let is_close = moved.drift <= f64::from(self.terms.slack);
        if is_close {
            to.push(Manifold3::BLANK);
            if let Some(manifold) = to.last_mut() {
                self.fill(&moved, manifold);
            }
        }
        is_close
    }

    /// Moved, by bodies that did not turn.
    #[inline(always)]
    fn shifted(&self, offset: DVec3) -> Moved {
        let step = offset - between(self.poses.each_ref());
        let normal = self.manifold.normal.as_dvec3();
        let arm = f64::from(self.terms.arms[0].min(self.terms.arms[1]));
        let drift = step.length() + lost(offset.abs().element_sum(), arm);
        Moved { drift, offset, normal, rise: normal.dot(step), turn: None }
    }

    /// Moved, by bodies of which one turned.
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
        let drift = drift_from(&of_a, arm_b).min(drift_from(&of_b, arm_a));
        let normal = match self.edges {
            None if self.terms.is_from_b => of_b.turn(normal_then),
            None => of_a.turn(normal_then),
            Some([a, b]) => {
                let cross = of_a.turn(a.as_dvec3()).cross(of_b.turn(b.as_dvec3()));
                // Bodies may have turned a long way together.
                let carried = of_a.turn(normal_then);
                let normal = cross.normalize_or(carried);
                if normal.dot(carried) < 0.0 { -normal } else { normal }
            }
        };
        let turn = Turn { of_a, of_b, offset_then, normal_then };
        Moved { drift, offset, normal, rise: 0.0, turn: Some(turn) }
    }

    #[inline(always)]
    fn fill(&self, moved: &Moved, to: &mut Manifold3) {
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
        to.error = error_after([of.separation, of.error], moved.drift, rise);
    }
}

/// How bodies moved since.
struct Moved {
    drift: f64,
    /// From A's position to B's, now.
    offset: DVec3,
    /// From A to B, now.
    normal: DVec3,
    /// By how much the bodies went apart along the normal, where none turned.
    rise: f64,
    turn: Option<Turn>,
}

/// How bodies turned since, in world axes, and what was then.
struct Turn {
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
        let Some(Turn { of_a, of_b, offset_then, normal_then }) = &self.turn else {
            return (if is_from_b { on_a } else { on_b }, self.rise);
        };
        let (a, b) = (of_a.turn(on_a), of_b.turn(on_b));
        let rise = self.normal.dot(self.offset + b - a) - normal_then.dot(*offset_then + on_b - on_a);
        (if is_from_b { a } else { b }, rise)
    }
}

/// Whether a manifold's normal is that of a face. Corners across a gap are hinted to by the face that all but parts them, and
/// have a normal of their own.
fn is_normal_of(job: &Job3<'_>, face: OnFace, manifold: &Manifold3) -> bool {
    let (shape, pose, face, out) = match face {
        OnFace::OfA(face) => (job.shape_a, job.pose_a, face as usize, 1.0),
        OnFace::OfB(face) => (job.shape_b, job.pose_b, face as usize, -1.0),
    };
    let normal = match shape {
        // A core of cuboids is made when it is asked for.
        Shape3::Cuboid(_) if face < 6 => Some(DVec3::AXES[face / 2] * if face % 2 == 1 { 1.0 } else { -1.0 }),
        _ => shape.core().normals().get(face).copied(),
    };
    let off = |normal: DVec3| pose.turn(normal * out) - manifold.normal.as_dvec3();
    normal.is_some_and(|normal| off(normal).length_squared() <= THEIRS * THEIRS)
}

/// The directions of the edges that a hint names, in world axes, where they cross at more than half a degree and the
/// normal of a manifold is theirs.
fn crossing(job: &Job3<'_>, hint: Hint, manifold: &Manifold3) -> Option<[Vec3; 2]> {
    let features = hint.features()?;
    let (Feature::Edge(a), Feature::Edge(b)) = (features.a(), features.b()) else { return None };
    let along = |(shape, pose): (&Shape3, &Pose3), edge: u32| {
        let core = shape.core();
        core.topology().half_edges().get(edge as usize)?;
        let (from, to) = core.topology().ends(edge as usize);
        let along =
            (core.vertices().get(to)?.as_dvec3() - core.vertices().get(from)?.as_dvec3()).try_normalize()?;
        Some(pose.turn(along))
    };
    let (a, b) = (along((job.shape_a, job.pose_a), a)?, along((job.shape_b, job.pose_b), b)?);
    let is_theirs = |edge: DVec3| edge.dot(manifold.normal.as_dvec3()).abs() <= THEIRS;
    let do_cross = a.cross(b).length() > LEAST_SINE;
    (is_theirs(a) && is_theirs(b) && do_cross).then(|| [a.as_vec3(), b.as_vec3()])
}

/// The least sine between edges whose normal is made anew: directions in f32 are off by 1e-7, a normal by 1e-5.
const LEAST_SINE: f64 = 0.01;

/// From A's position to B's.
#[inline(always)]
fn between([a, b]: [&Pose3; 2]) -> DVec3 {
    b.position() - a.position()
}
