//! Manifolds in the plane that are moved along: see `persistent`.

use crate::answer::{Answer, ContactPoint2, Manifold2};
use crate::feature::OnFace;
use crate::footing::{Footing, Girth};
use crate::jobs2::Job2;
use crate::persistent::{THEIRS, Terms, Way, lost, measured_from, single, slack_of, widest_reach_of};
use crate::points::ContactPoints;
use crate::precision::signed;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Pose2, Shape2};

/// A manifold, and the poses of its two bodies when it was computed: until they drift against each other, it is moved
/// along for a fraction of the cost of a new one.
///
/// Bodies at rest are never quite still. As long as no point of one has moved against the other by more than 2^-15 of
/// the smaller bounding radius (2^-10 where they rest on a broad patch), the manifold is reused: the same points of the
/// same features, with separations and the normal updated. It is certain that the shapes still overlap, or are still
/// within the margin, as before; a pair too close to either limit for that is not kept at all.
///
/// ```
/// use asunder_geometry::{Pose2, Rect, Shape2, glam::Vec2};
/// use asunder_narrow::{Batch2, Hint, Job2, Persistent2, collide2};
/// let square = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
/// let (pose_a, pose_b) = (Pose2::IDENTITY, Pose2::at([0.5, 1.875])?);
/// let job = Job2 {
///     shape_a: &square, pose_a: &pose_a, shape_b: &square, pose_b: &pose_b, margin: 0.0, hint: Hint::NONE,
///     ahead: 0.0, sensor: false,
/// };
/// let mut batch = Batch2::default();
/// collide2(&[job], &mut batch);
/// let persistent = Persistent2::of(&job, &batch.answers[0], &batch.manifolds).expect("an edge carries it");
///
/// let mut moved = Vec::new();
/// let sunk = Pose2::at([0.5, 1.875 - 4e-6])?;
/// assert!(persistent.carry_on([&pose_a, &sunk], &mut moved) && persistent.overlapping());
/// assert!(persistent.reach() > 1e-3 && persistent.reach() <= Persistent2::most_reach(&job));
/// assert_eq!(Persistent2::lasting(&job, &batch.answers[0], &batch.manifolds, 0.1), None, "bodies as fast as that");
/// assert!((moved[0].points[0].separation + 0.125 + 4e-6).abs() < 1e-8);
/// let gone = Pose2::at([0.5, 1.875 - 4e-3])?;
/// assert!(!persistent.carry_on([&pose_a, &gone], &mut moved), "too far: it must be made anew");
/// assert_eq!((persistent.manifold().points.len(), persistent.margin()), (2, 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Persistent2 {
    manifold: Manifold2,
    terms: Terms,
    /// The bodies' poses then.
    poses: [Pose2; 2],
}

impl Persistent2 {
    /// The persistent manifold of an answer to a job; `manifolds` are those of the answer's batch.
    ///
    /// `None` where the bodies are beyond the margin, or so close to it or to touching that rounding may have decided;
    /// where they touch in several parts; and where a point is on no edge, as between corners across a gap. Cost: a
    /// square root.
    pub fn of(job: &Job2<'_>, answer: &Answer, manifolds: &[Manifold2]) -> Option<Self> {
        let (hint, index, overlapping) = single(answer)?;
        let edge = measured_from(hint)?;
        let manifold = manifolds.get(index).filter(|manifold| is_normal_of(job, edge, manifold))?;
        let found = [manifold.separation, manifold.error];
        let slack = slack_of(
            found,
            overlapping,
            job.margin,
            [job.shape_a.outer_radius(), job.shape_b.outer_radius()],
        )?;
        let arm = |shape: &Shape2| (shape.center().length() + shape.outer_radius()).next_up();
        let terms = Terms {
            overlapping,
            is_from_b: matches!(edge, OnFace::OfB(_)),
            margin: job.margin,
            slack,
            arms: [arm(job.shape_a), arm(job.shape_b)],
            footing: footing_of(job, edge, manifold),
        };
        let poses = [*job.pose_a, *job.pose_b];
        terms.are_sound(found).then_some(Self { manifold: *manifold, terms, poses })
    }

    /// The same, for bodies that moved by `step` metres in the last frame: `None` if bodies that continue at that speed
    /// would have drifted too far by the next.
    pub fn lasting(job: &Job2<'_>, answer: &Answer, manifolds: &[Manifold2], step: f64) -> Option<Self> {
        if step > f64::from(Self::most_reach(job)) {
            return None;
        }
        Self::of(job, answer, manifolds).filter(|made| step <= f64::from(made.reach()))
    }

    /// The largest drift up to which a manifold of this job can be moved along, in metres.
    pub fn most_reach(job: &Job2<'_>) -> f32 {
        widest_reach_of([job.shape_a.outer_radius(), job.shape_b.outer_radius()])
    }

    /// The drift up to which this one can be moved along, in metres.
    pub fn reach(&self) -> f32 {
        self.terms.reach()
    }

    /// The manifold as it was computed.
    pub const fn manifold(&self) -> &Manifold2 {
        &self.manifold
    }

    /// Whether the shapes overlapped, as they do for as long as the manifold is moved along.
    pub const fn overlapping(&self) -> bool {
        self.terms.overlapping
    }

    /// The margin that the manifold was made for, in metres.
    pub const fn margin(&self) -> f32 {
        self.terms.margin
    }

    /// Whether the numbers stored with the manifold are possible: for data that was read from a file.
    pub fn is_sound(&self) -> bool {
        self.terms.are_sound([self.manifold.separation, self.manifold.error])
    }

    /// Appends the manifold, moved along to the poses of A and B; returns false if it must be recomputed. Shapes and
    /// margin must be those of the job. Its error includes the effect of the drift. Cost: constant, least where no body
    /// turned.
    pub fn carry_on(&self, poses: [&Pose2; 2], to: &mut Vec<Manifold2>) -> bool {
        if (0..2).all(|i| poses[i].same_bits(&self.poses[i])) {
            to.push(self.manifold);
            return true;
        }
        let moved = if (0..2).all(|i| poses[i].same_rotation(&self.poses[i])) {
            self.shifted(between(poses))
        } else {
            self.turned(poses)
        };
        // NaN is not close.
        let is_close = moved.drift <= f64::from(self.terms.reach());
        let filled = if is_close { self.filled(&moved) } else { None };
        let is_filled = filled.is_some();
        to.extend(filled);
        is_filled
    }

    /// The motion, where neither body turned.
    #[inline(always)]
    fn shifted(&self, offset: DVec2) -> Moved {
        let step = offset - between(self.poses.each_ref());
        let normal = self.manifold.normal.as_dvec2();
        let arm = f64::from(self.terms.arms[0].min(self.terms.arms[1]));
        let drift = step.length() + lost(offset.abs().element_sum(), arm);
        Moved { drift, spun: 0.0, offset, normal, rise: normal.dot(step), turn: None }
    }

    /// The motion, where a body turned.
    #[inline(never)]
    fn turned(&self, poses: [&Pose2; 2]) -> Moved {
        let (offset, offset_then) = (between(poses), between(self.poses.each_ref()));
        let normal_then = self.manifold.normal.as_dvec2();
        let of_a = Turned::since(&self.poses[0], poses[0]);
        let of_b = Turned::since(&self.poses[1], poses[1]);
        let spin = (of_b.x - of_a.x).length();
        // Seen from either body as if it did not turn: both give a true bound on the drift.
        let drift_from = |seen_from: &Turned, arm: f32| {
            let step = (offset - seen_from.turn(offset_then)).length();
            step + spin * f64::from(arm) + lost(offset.abs().element_sum(), arm.into())
        };
        // Stored rotations are of unit length up to rounding, and scale their bodies by the difference.
        let scale = |body: usize| {
            let is_same = poses[body].same_rotation(&self.poses[body]);
            if is_same { 0.0 } else { 2.0 * f64::from(f32::EPSILON * self.terms.arms[body]) }
        };
        let [arm_a, arm_b] = self.terms.arms;
        let [from_a, from_b] = [drift_from(&of_a, arm_b), drift_from(&of_b, arm_a)];
        // The normal turns with the body that sees the lesser drift of the other: along it, the separation holds for
        // both bodies as wholes.
        let (drift, arm, seen_from) =
            if from_a <= from_b { (from_a, arm_b, &of_a) } else { (from_b, arm_a, &of_b) };
        // This scaling moves points as turning does.
        let scaled = scale(0) + scale(1);
        let (drift, spun) = (drift + scaled, spin * f64::from(arm) + scaled);
        let normal = seen_from.turn(normal_then);
        let turn = Turn { of_a, of_b, offset_then, normal_then };
        Moved { drift, spun, offset, normal, rise: 0.0, turn: Some(turn) }
    }

    /// The manifold as it is now; `None` where it must be recomputed.
    fn filled(&self, moved: &Moved) -> Option<Manifold2> {
        let of = &self.manifold;
        let mut to = Manifold2 { normal: moved.normal.as_vec2(), points: ContactPoints::new(), ..*of };
        let (mut deepest, mut deepest_then) = (f64::INFINITY, f64::INFINITY);
        for point in &of.points {
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
            to.points.push(ContactPoint2 {
                separation: height as f32,
                anchor_a: on_a.as_vec2(),
                anchor_b: on_b.as_vec2(),
                feature: point.feature,
            });
        }
        let rise = deepest - deepest_then;
        to.separation = signed(f64::from(of.separation) + rise, self.terms.overlapping);
        let way = Way { drift: moved.drift, spun: moved.spun, rise };
        to.error = self.terms.error_after([of.separation, of.error], &way)?;
        Some(to)
    }
}

/// How bodies moved since the manifold was computed.
struct Moved {
    drift: f64,
    /// Their rotation against each other times the arm of the one that is taken to move.
    spun: f64,
    /// From A's position to B's, now.
    offset: DVec2,
    /// From A to B, now.
    normal: DVec2,
    /// By how much the bodies went apart along the normal, where none turned.
    rise: f64,
    turn: Option<Turn>,
}

/// How bodies turned since, in world axes, and the offset and normal before that.
struct Turn {
    of_a: Turned,
    of_b: Turned,
    offset_then: DVec2,
    normal_then: DVec2,
}

impl Moved {
    /// The present position of a point, which stays on the body whose edge it is not measured from, and by how much it
    /// rose over the other's edge.
    #[inline(always)]
    fn held(&self, [on_a, on_b]: [Vec2; 2], is_from_b: bool) -> (DVec2, f64) {
        let (on_a, on_b) = (on_a.as_dvec2(), on_b.as_dvec2());
        let Some(Turn { of_a, of_b, offset_then, normal_then }) = &self.turn else {
            return (if is_from_b { on_a } else { on_b }, self.rise);
        };
        let (a, b) = (of_a.turn(on_a), of_b.turn(on_b));
        let rise = self.normal.dot(self.offset + b - a) - normal_then.dot(*offset_then + on_b - on_a);
        (if is_from_b { a } else { b }, rise)
    }
}

/// From A's position to B's.
#[inline(always)]
fn between([a, b]: [&Pose2; 2]) -> DVec2 {
    b.position() - a.position()
}

/// Whether a manifold's normal is that of an edge. Corners across a gap may have a hint of the edge that nearly
/// separates them, and a normal of their own.
fn is_normal_of(job: &Job2<'_>, edge: OnFace, manifold: &Manifold2) -> bool {
    let (shape, pose, edge, out) = match edge {
        OnFace::OfA(edge) => (job.shape_a, job.pose_a, edge as usize, 1.0),
        OnFace::OfB(edge) => (job.shape_b, job.pose_b, edge as usize, -1.0),
    };
    let normal = shape.core().normals().get(edge).copied();
    let off = |normal: DVec2| pose.turn(normal * out) - manifold.normal.as_dvec2();
    normal.is_some_and(|normal| off(normal).length_squared() <= THEIRS * THEIRS)
}

/// How wide the bodies stand on each other, to both sides: the distance of two points, else that of the point to the
/// nearer end of the edge.
fn footing_of(job: &Job2<'_>, edge: OnFace, manifold: &Manifold2) -> Option<Footing> {
    let (mut low, mut high) = (manifold.separation, manifold.separation);
    for point in &manifold.points {
        (low, high) = (low.min(point.separation), high.max(point.separation));
    }
    let width = match &*manifold.points {
        [one, other] => (other.anchor_a - one.anchor_a).as_dvec2().length(),
        [one] => {
            let (shape, pose, edge, anchor) = match edge {
                OnFace::OfA(edge) => (job.shape_a, job.pose_a, edge as usize, one.anchor_a),
                OnFace::OfB(edge) => (job.shape_b, job.pose_b, edge as usize, one.anchor_b),
            };
            let core = shape.core();
            let vertices = core.vertices();
            let (from, to) =
                (vertices.get(edge)?.as_dvec2(), vertices[(edge + 1) % vertices.len()].as_dvec2());
            let along = (to - from).try_normalize()?;
            let place = along.dot(pose.turn_back(anchor.as_dvec2()) - from);
            place.min((to - from).length() - place)
        }
        _ => return None,
    };
    let girth = |shape: &Shape2| {
        let inner = match shape {
            Shape2::Rect(rect) => rect.inner_radius(),
            Shape2::Polygon(polygon) => polygon.inner_radius(),
            _ => shape.radius(),
        };
        Girth { inner, outer: shape.outer_radius() }
    };
    Footing::new(width, [low, high], manifold.error, [girth(job.shape_a), girth(job.shape_b)])
}

/// A rotation: the image of the x axis, of unit length.
#[derive(Clone, Copy)]
struct Turned {
    x: DVec2,
}

impl Turned {
    /// The rotation from one pose to another: exactly none where both have the same.
    fn since(then: &Pose2, now: &Pose2) -> Self {
        let axis = |pose: &Pose2| DVec2::new(pose.rotation().cos().into(), pose.rotation().sin().into());
        let (then, now) = (axis(then), axis(now));
        let turn = DVec2::new(then.dot(now), then.perp_dot(now));
        Self { x: turn / turn.length() }
    }

    #[inline]
    fn turn(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.x.x * v.x - self.x.y * v.y, self.x.y * v.x + self.x.x * v.y)
    }
}
