//! Manifolds in space that are moved along: see `persistent`.

use crate::answer::{Answer, ContactPoint3, Manifold3};
use crate::feature::{Feature, Hint, OnFace};
use crate::footing::{Footing, Girth};
use crate::jobs3::Job3;
use crate::persistent::{THEIRS, Terms, Way, lost, measured_from, single, slack_of, widest_reach_of};
use crate::precision::signed;
use arrayvec::ArrayVec;
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
/// assert!(persistent.reach() > 1e-3 && persistent.reach() <= Persistent3::most_reach(&job));
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
        let (edges, width) = match face {
            Some(face) if is_normal_of(job, face, manifold) => (None, width_on(job, face, manifold)),
            Some(_) => return None,
            None => {
                let (edges, width) = crossing(job, hint, manifold)?;
                (Some(edges), width)
            }
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
            footing: footing_of(job, manifold, width),
        };
        let poses = [*job.pose_a, *job.pose_b];
        terms.are_sound().then(|| Self { manifold: manifold.clone(), terms, edges, poses })
    }

    /// Up to which drift a manifold of this job can be moved along at most, in metres: where bodies move more than that in
    /// a frame, keeping one is no use.
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
        if !(moved.drift <= f64::from(self.terms.reach())) {
            return false;
        }
        to.push(Manifold3::BLANK);
        let is_told = to.last_mut().is_some_and(|manifold| self.fill(&moved, manifold));
        if !is_told {
            to.pop();
        }
        is_told
    }

    /// Moved, by bodies that did not turn.
    #[inline(always)]
    fn shifted(&self, offset: DVec3) -> Moved {
        let step = offset - between(self.poses.each_ref());
        let normal = self.manifold.normal.as_dvec3();
        let arm = f64::from(self.terms.arms[0].min(self.terms.arms[1]));
        let drift = step.length() + lost(offset.abs().element_sum(), arm);
        Moved { drift, spun: 0.0, offset, normal, rise: normal.dot(step), turn: None }
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
        // A normal made of two edges leans further than the bodies do.
        let spun = if self.edges.is_some() { f64::INFINITY } else { spin * f64::from(arm_a.min(arm_b)) };
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
        Moved { drift, spun, offset, normal, rise: 0.0, turn: Some(turn) }
    }

    /// The manifold as it is now; says no where it has to be made anew.
    #[inline(always)]
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

/// How bodies moved since.
struct Moved {
    drift: f64,
    /// Their spin against each other times the lesser arm.
    spun: f64,
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
/// normal of a manifold is theirs; and by how much they reach out to every side of where they cross.
fn crossing(job: &Job3<'_>, hint: Hint, manifold: &Manifold3) -> Option<([Vec3; 2], f64)> {
    let features = hint.features()?;
    let (Feature::Edge(a), Feature::Edge(b)) = (features.a(), features.b()) else { return None };
    let point = manifold.points.first()?;
    let along = |(shape, pose): (&Shape3, &Pose3), edge: u32, anchor: Vec3| {
        let core = shape.core();
        core.topology().half_edges().get(edge as usize)?;
        let (from, to) = core.topology().ends(edge as usize);
        let (from, to) = (core.vertices().get(from)?.as_dvec3(), core.vertices().get(to)?.as_dvec3());
        let along = (to - from).try_normalize()?;
        let place = along.dot(pose.basis().turn_back(anchor.as_dvec3()) - from);
        Some((pose.turn(along), place.min((to - from).length() - place)))
    };
    let (a, reach_a) = along((job.shape_a, job.pose_a), a, point.anchor_a)?;
    let (b, reach_b) = along((job.shape_b, job.pose_b), b, point.anchor_b)?;
    let is_theirs = |edge: DVec3| edge.dot(manifold.normal.as_dvec3()).abs() <= THEIRS;
    let sine = a.cross(b).length();
    let do_cross = sine > LEAST_SINE;
    (is_theirs(a) && is_theirs(b) && do_cross)
        .then(|| ([a.as_vec3(), b.as_vec3()], sine * reach_a.min(reach_b)))
}

/// By how much the bodies stand on each other to every side: the least width of three or four points, else how far the
/// middle of the points is inside the face.
fn width_on(job: &Job3<'_>, face: OnFace, manifold: &Manifold3) -> f64 {
    let on_face = |point: &ContactPoint3| match face {
        OnFace::OfA(_) => point.anchor_a.as_dvec3(),
        OnFace::OfB(_) => point.anchor_b.as_dvec3(),
    };
    let points: ArrayVec<DVec3, 4> = manifold.points.iter().map(on_face).collect();
    if points.len() > 2 {
        return least_width(&points, manifold.normal.as_dvec3());
    }
    let middle = points.iter().fold(DVec3::ZERO, |sum, point| sum + *point) / points.len().max(1) as f64;
    match face {
        OnFace::OfA(face) => inside(job.shape_a, face as usize, job.pose_a.basis().turn_back(middle)),
        OnFace::OfB(face) => inside(job.shape_b, face as usize, job.pose_b.basis().turn_back(middle)),
    }
}

/// The least distance of two parallel lines with all points between them: one runs through two of them.
fn least_width(points: &[DVec3], normal: DVec3) -> f64 {
    let mut least = f64::INFINITY;
    for (i, &one) in points.iter().enumerate() {
        for &other in &points[i + 1..] {
            let Some(across) = normal.cross(other - one).try_normalize() else { return 0.0 };
            let beside = |point: &DVec3| across.dot(*point - one);
            let (low, high) = points
                .iter()
                .map(beside)
                .fold((0.0_f64, 0.0_f64), |(low, high), place| (low.min(place), high.max(place)));
            least = least.min(high - low);
        }
    }
    least
}

/// How far inside a face a point above it is, in the axes of the shape; negative outside. Cost: linear in the face's
/// vertices.
fn inside(shape: &Shape3, face: usize, point: DVec3) -> f64 {
    if let Shape3::Cuboid(cuboid) = shape {
        let within = cuboid.half_extents().as_dvec3() - point.abs();
        let [u, v] = [(face / 2 + 1) % 3, (face / 2 + 2) % 3];
        return within.to_array()[u].min(within.to_array()[v]);
    }
    let core = shape.core();
    let (topology, vertices) = (core.topology(), core.vertices());
    let Some(&normal) = core.normals().get(face) else { return 0.0 };
    let mut least = f64::INFINITY;
    for edge in topology.face_half_edges(face) {
        let (from, to) = topology.ends(edge);
        let (from, to) = (vertices[from].as_dvec3(), vertices[to].as_dvec3());
        let Some(inward) = normal.cross(to - from).try_normalize() else { continue };
        least = least.min(inward.dot(point - from));
    }
    if least.is_finite() { least } else { 0.0 }
}

fn footing_of(job: &Job3<'_>, manifold: &Manifold3, width: f64) -> Option<Footing> {
    let (mut low, mut high) = (manifold.separation, manifold.separation);
    for point in &manifold.points {
        (low, high) = (low.min(point.separation), high.max(point.separation));
    }
    let girth = |shape: &Shape3| {
        // A core of cuboids is made when it is asked for.
        let inner = match shape {
            Shape3::Cuboid(cuboid) => cuboid.inner_radius(),
            _ => shape.core().inner_radius() + shape.radius(),
        };
        Girth { inner, outer: shape.outer_radius() }
    };
    Footing::new(width, [low, high], manifold.error, [girth(job.shape_a), girth(job.shape_b)])
}

/// The least sine between edges whose normal is made anew: directions in f32 are off by 1e-7, a normal by 1e-5.
const LEAST_SINE: f64 = 0.01;

/// From A's position to B's.
#[inline(always)]
fn between([a, b]: [&Pose3; 2]) -> DVec3 {
    b.position() - a.position()
}
