//! What a manifold of two solids is measured from, and how wide that is: a face, two edges, or the closest features
//! across a gap.
//!
//! The last occurs between bricks of a wall and those beside the bricks below: two edges side by side, some millimetres
//! apart, which only the general path finds, in 11 k instructions. Kept, they cost 400: 17 % of a frame of a heap of
//! 8,000 boxes (AMD EPYC, Zen 4, 2026-11-22, by instructions).
//!
//! Tried and dropped: a normal computed again from the points across the gap, or from the edges that cross. It leans by
//! drift / gap, or drift / sine, and the far ends of the bodies then overlap along it by that share of their size.

use crate::answer::{ContactPoint3, Manifold3};
use crate::feature::{Feature, Hint, OnFace};
use crate::footing::{Footing, Girth};
use crate::jobs3::Job3;
use crate::persistent::{THEIRS, measured_from};
use crate::polyhedron::sat::in_polygon;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Shape3};

/// What a manifold is measured from.
pub(super) struct Hold {
    /// Whether points are measured from a face of B.
    pub(super) is_from_b: bool,
    /// How far the bodies reach to every side of it, in metres: zero where unknown.
    pub(super) width: f64,
    /// Whether the normal leads from vertex or edge to vertex or edge across a gap: as bodies drift, it would have to
    /// lean.
    pub(super) is_gap: bool,
}

impl Hold {
    /// For a manifold: `None` where it is not kept.
    pub(super) fn of(job: &Job3<'_>, hint: Hint, manifold: &Manifold3, overlapping: bool) -> Option<Self> {
        if let Some(face) = measured_from(hint).filter(|face| is_normal_of(job, *face, manifold)) {
            let is_from_b = matches!(face, OnFace::OfB(_));
            return Some(Self { is_from_b, width: width_on(job, face, manifold), is_gap: false });
        }
        let point = manifold.points.first()?;
        let by_hint = hint.features().map(|of| [of.a(), of.b()]);
        for features in [by_hint, Some([point.feature.a(), point.feature.b()])] {
            if let Some([Feature::Edge(a), Feature::Edge(b)]) = features
                && let Some(width) = crossing(job, [a, b], manifold)
            {
                return Some(Self { is_from_b: false, width, is_gap: false });
            }
        }
        let is_corner = |feature| matches!(feature, Feature::Edge(_) | Feature::Vertex(_));
        let is_gap = !overlapping
            && (manifold.points.len() == 2 || is_corner(point.feature.a()) && is_corner(point.feature.b()))
            && is_one(job.shape_a)
            && is_one(job.shape_b);
        is_gap.then_some(Self { is_from_b: false, width: 0.0, is_gap })
    }
}

/// Whether a shape is a single solid. Of several, another may come within the margin while the nearest is moved along.
const fn is_one(shape: &Shape3) -> bool {
    !matches!(shape, Shape3::Compound(_) | Shape3::TriMesh(_) | Shape3::HeightField(_))
}

/// Whether a manifold's normal is that of a face. Corners across a gap may have a hint of the face that nearly
/// separates them, and a normal of their own.
fn is_normal_of(job: &Job3<'_>, face: OnFace, manifold: &Manifold3) -> bool {
    let (shape, pose, face, out) = match face {
        OnFace::OfA(face) => (job.shape_a, job.pose_a, face as usize, 1.0),
        OnFace::OfB(face) => (job.shape_b, job.pose_b, face as usize, -1.0),
    };
    let off = |normal: DVec3| pose.turn(normal * out) - manifold.normal.as_dvec3();
    face_normal(shape, face).is_some_and(|normal| off(normal).length_squared() <= THEIRS * THEIRS)
}

/// The unit normal out of a face, in the axes of the shape.
pub(super) fn face_normal(shape: &Shape3, face: usize) -> Option<DVec3> {
    match shape {
        // A cuboid's core is built on demand.
        Shape3::Cuboid(_) if face < 6 => Some(DVec3::AXES[face / 2] * if face % 2 == 1 { 1.0 } else { -1.0 }),
        _ => shape.core().normals().get(face).copied(),
    }
}

/// How far two edges reach to every side of their crossing: `None` unless they cross at more than half a degree, and
/// the manifold's normal is square to both.
fn crossing(job: &Job3<'_>, edges: [u32; 2], manifold: &Manifold3) -> Option<f64> {
    let point = manifold.points.first()?;
    let along = |(shape, pose): (&Shape3, &Pose3), edge: u32, anchor: Vec3| {
        let Edge { from, along, length } = Edge::of(shape, edge)?;
        let place = along.dot(pose.basis().turn_back(anchor.as_dvec3()) - from);
        Some((pose.turn(along), place.min(length - place)))
    };
    let (a, reach_a) = along((job.shape_a, job.pose_a), edges[0], point.anchor_a)?;
    let (b, reach_b) = along((job.shape_b, job.pose_b), edges[1], point.anchor_b)?;
    let is_theirs = |edge: DVec3| edge.dot(manifold.normal.as_dvec3()).abs() <= THEIRS;
    let sine = a.cross(b).length();
    let do_cross = sine > LEAST_SINE;
    (is_theirs(a) && is_theirs(b) && do_cross).then(|| sine * reach_a.min(reach_b))
}

/// An edge of a shape, in its axes.
pub(super) struct Edge {
    pub(super) from: DVec3,
    pub(super) along: DVec3,
    pub(super) length: f64,
}

impl Edge {
    /// `None` for an edge that does not exist, or has no length.
    pub(super) fn of(shape: &Shape3, edge: u32) -> Option<Self> {
        let core = shape.core();
        core.topology().half_edges().get(edge as usize)?;
        let (from, to) = core.topology().ends(edge as usize);
        let (from, to) = (core.vertices().get(from)?.as_dvec3(), core.vertices().get(to)?.as_dvec3());
        Some(Self { from, along: (to - from).try_normalize()?, length: (to - from).length() })
    }
}

/// How far a shape reaches from its position, in metres.
pub(super) fn arm_of(shape: &Shape3) -> f32 {
    (shape.center().length() + shape.outer_radius()).next_up()
}

/// How wide the bodies stand on each other, to every side: the least width of three or four points, else how far the
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

/// The least distance between two parallel lines with all points between them: one of them runs through two points.
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
pub(super) fn inside(shape: &Shape3, face: usize, point: DVec3) -> f64 {
    if let Shape3::Cuboid(cuboid) = shape {
        let within = cuboid.half_extents().as_dvec3() - point.abs();
        let [u, v] = [(face / 2 + 1) % 3, (face / 2 + 2) % 3];
        return within.to_array()[u].min(within.to_array()[v]);
    }
    let core = shape.core();
    let (topology, vertices) = (core.topology(), core.vertices());
    let Some(&normal) = core.normals().get(face) else { return 0.0 };
    in_polygon(topology.face_vertices(face).map(|vertex| vertices[vertex].as_dvec3()), normal, point)
}

/// The footing of the bodies on each other, if it is broad enough.
pub(super) fn footing_of(job: &Job3<'_>, manifold: &Manifold3, width: f64) -> Option<Footing> {
    let (mut low, mut high) = (manifold.separation, manifold.separation);
    for point in &manifold.points {
        (low, high) = (low.min(point.separation), high.max(point.separation));
    }
    let girth = |shape: &Shape3| {
        // A cuboid's core is built on demand.
        let inner = match shape {
            Shape3::Cuboid(cuboid) => cuboid.inner_radius(),
            _ => shape.core().inner_radius() + shape.radius(),
        };
        Girth { inner, outer: shape.outer_radius() }
    };
    Footing::new(width, [low, high], manifold.error, [girth(job.shape_a), girth(job.shape_b)])
}

/// Least sine of the angle between edges that count as crossing.
const LEAST_SINE: f64 = 0.01;
