//! Brings two shapes into contact, and asks the engine for their contact points.

use crate::kinds::Kind;
use crate::surface::{from_surface2, from_surface3};
use asunder::glam::{DVec2, DVec3, Quat};
use asunder::{Pair2, Pair3, Pose2, Pose3, PoseError, Rotation2, Separation2, Separation3, Shape2, Shape3};
use core::fmt;

/// How deep the bodies overlap once lowered, in metres: enough to see.
const DEPTH: f64 = 0.05;
/// The margin, in metres, for pairs that touch but never overlap, such as two segments in space, which can only cross.
const MARGIN: f32 = 2e-3;
/// The greatest distance of a contact point from a surface, in metres: far above the engine's own error, far below a
/// pixel.
const ON_SURFACE: f64 = 1e-4;

/// One contact point.
pub(crate) struct Mark {
    pub on_a: DVec3,
    pub on_b: DVec3,
    /// From A to B.
    pub normal: DVec3,
}

/// A pair in contact: A below, B above. In the plane z is 0.
pub(crate) struct Touch<'a, S, P> {
    pub a: &'a Kind<S>,
    pub b: &'a Kind<S>,
    pub pose_a: P,
    pub pose_b: P,
    /// In metres, as the engine reports it.
    pub separation: f32,
    pub marks: Vec<Mark>,
    /// The greatest distance of a contact point from the surface it should be on, in metres.
    pub off: f64,
}

pub(crate) type Touch2<'a> = Touch<'a, Shape2, Pose2>;
pub(crate) type Touch3<'a> = Touch<'a, Shape3, Pose3>;

/// How B is turned before it is lowered.
#[derive(Clone, Copy)]
pub(crate) enum Attitude {
    /// As modelled: most shapes lie on a face or side.
    Flat,
    /// As modelled, across A.
    Across,
    /// On an edge; in the plane, on a vertex.
    Edge,
    /// On a vertex.
    Vertex,
    /// Upside down.
    Over,
}

/// What is wrong with a pair of shapes.
#[derive(Debug)]
pub(crate) enum TouchError {
    /// The pose that was found is not valid.
    Pose(PoseError),
    /// B was lowered past A, and they never met.
    NeverMet { a: &'static str, b: &'static str },
    /// They overlap, and the engine gives no contact point.
    NoPoint { a: &'static str, b: &'static str },
    /// A contact point is not on a surface.
    OffSurface { a: &'static str, b: &'static str, distance: f64 },
}

impl fmt::Display for TouchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pose(error) => error.fmt(f),
            Self::NeverMet { a, b } => write!(f, "{b} was lowered on {a} and never met it"),
            Self::NoPoint { a, b } => write!(f, "{b} lies on {a}, and there is no contact point"),
            Self::OffSurface { a, b, distance } => {
                write!(f, "{b} on {a}: a contact point is {distance:e} m off the surface")
            }
        }
    }
}

impl std::error::Error for TouchError {}

impl From<PoseError> for TouchError {
    fn from(error: PoseError) -> Self {
        Self::Pose(error)
    }
}

impl<S, P> Touch<'_, S, P> {
    /// Whether the points are as they should be. Two half-spaces overlap without bounds, and have contact points only
    /// if they face exactly away from each other.
    pub(crate) fn check(&self) -> Result<(), TouchError> {
        let (a, b) = (self.a.name, self.b.name);
        let is_endless = a == b && a.starts_with("half-");
        if self.marks.is_empty() && !is_endless {
            return Err(TouchError::NoPoint { a, b });
        }
        if self.off > ON_SURFACE {
            return Err(TouchError::OffSurface { a, b, distance: self.off });
        }
        Ok(())
    }
}

/// Lowers B on A in space, in the given attitude.
pub(crate) fn touch3<'a>(
    a: &'a Kind<Shape3>,
    b: &'a Kind<Shape3>,
    attitude: Attitude,
) -> Result<Touch3<'a>, TouchError> {
    let (turn_a, turn_b) = (turned([-0.30, 0.0, 0.0]), turned(angles(attitude)));
    let pose_a = Pose3::new(DVec3::ZERO, turn_a)?;
    let below = Pose3::new(DVec3::ZERO, turn_b)?;
    let start = end3(&a.shape, &pose_a, DVec3::Y) - end3(&b.shape, &below, DVec3::NEG_Y);
    let pose_at = |place: DVec3| Pose3::new(place, turn_b);
    let place = lowered(start, matches!(a.shape, Shape3::Compound(_)), |place| {
        let pose_b = pose_at(place).ok()?;
        match Pair3::new(&a.shape, &pose_a, &b.shape, &pose_b).separation(f32::INFINITY) {
            Separation3::Measured(m) => Some((f64::from(m.separation), m.normal.as_dvec3())),
            Separation3::AtLeast(_) => None,
        }
    });
    let pose_b = pose_at(place.ok_or(TouchError::NeverMet { a: a.name, b: b.name })?)?;
    let manifolds = Pair3::new(&a.shape, &pose_a, &b.shape, &pose_b).manifolds(MARGIN);
    let mut touch = Touch3 { a, b, pose_a, pose_b, separation: f32::INFINITY, marks: Vec::new(), off: 0.0 };
    for manifold in &manifolds {
        touch.separation = touch.separation.min(manifold.separation);
        for point in &manifold.points {
            let on_a = pose_a.position() + point.anchor_a.as_dvec3();
            let on_b = pose_b.position() + point.anchor_b.as_dvec3();
            let off_a = from_surface3(&a.shape, manifold.part_a, pose_a.transform_back(on_a));
            let off_b = from_surface3(&b.shape, manifold.part_b, pose_b.transform_back(on_b));
            touch.off = touch.off.max(off_a).max(off_b);
            touch.marks.push(Mark { on_a, on_b, normal: manifold.normal.as_dvec3() });
        }
    }
    Ok(touch)
}

/// Lowers B on A in the plane, in the given attitude.
pub(crate) fn touch2<'a>(
    a: &'a Kind<Shape2>,
    b: &'a Kind<Shape2>,
    attitude: Attitude,
) -> Result<Touch2<'a>, TouchError> {
    let turn_b = match attitude {
        Attitude::Flat | Attitude::Across => Rotation2::IDENTITY,
        Attitude::Edge => Rotation2::from_angle(0.35)?,
        Attitude::Vertex => Rotation2::from_angle(0.8)?,
        Attitude::Over => Rotation2::new(-1.0, 0.0)?,
    };
    let pose_a = Pose2::IDENTITY;
    let below = Pose2::new(DVec2::ZERO, turn_b)?;
    let start = end2(&a.shape, &pose_a, DVec2::Y) - end2(&b.shape, &below, DVec2::NEG_Y);
    let pose_at = |place: DVec3| Pose2::new(place.truncate(), turn_b);
    let place = lowered(start.extend(0.0), matches!(a.shape, Shape2::Compound(_)), |place| {
        let pose_b = pose_at(place).ok()?;
        match Pair2::new(&a.shape, &pose_a, &b.shape, &pose_b).separation(f32::INFINITY) {
            Separation2::Measured(m) => Some((f64::from(m.separation), m.normal.as_dvec2().extend(0.0))),
            Separation2::AtLeast(_) => None,
        }
    });
    let pose_b = pose_at(place.ok_or(TouchError::NeverMet { a: a.name, b: b.name })?)?;
    let manifolds = Pair2::new(&a.shape, &pose_a, &b.shape, &pose_b).manifolds(MARGIN);
    let mut touch = Touch2 { a, b, pose_a, pose_b, separation: f32::INFINITY, marks: Vec::new(), off: 0.0 };
    for manifold in &manifolds {
        touch.separation = touch.separation.min(manifold.separation);
        for point in &manifold.points {
            let on_a = pose_a.position() + point.anchor_a.as_dvec2();
            let on_b = pose_b.position() + point.anchor_b.as_dvec2();
            let off_a = from_surface2(&a.shape, manifold.part_a, pose_a.transform_back(on_a));
            let off_b = from_surface2(&b.shape, manifold.part_b, pose_b.transform_back(on_b));
            touch.off = touch.off.max(off_a).max(off_b);
            let normal = manifold.normal.as_dvec2().extend(0.0);
            touch.marks.push(Mark { on_a: on_a.extend(0.0), on_b: on_b.extend(0.0), normal });
        }
    }
    Ok(touch)
}

/// The place where B, lowered from `start`, overlaps A by [`DEPTH`] or, if it cannot, touches it; `answer` gives the
/// separation and normal for a place of B.
///
/// While there is a gap, B can safely be lowered by all of it. After the first touch the steps are small, since deep
/// down the shortest way out may point elsewhere. If B may slide, it follows the normal sideways until that points up
/// or back.
fn lowered(start: DVec3, may_slide: bool, answer: impl Fn(DVec3) -> Option<(f64, DVec3)>) -> Option<DVec3> {
    let mut touching = first_touch(start, &answer)?;
    let (mut stride, mut last) = (0.10, DVec3::ZERO);
    for _ in 0..if may_slide { 60 } else { 0 } {
        let aside = answer(touching)?.1 * DVec3::new(1.0, 0.0, 1.0);
        if aside.length() < 0.05 {
            break;
        }
        if aside.dot(last) < 0.0 {
            stride *= 0.5;
        }
        (touching, last) = (first_touch(touching.with_y(start.y) + aside * stride, &answer)?, aside);
    }
    let is_deep =
        |place: DVec3, depth: f64| answer(place).is_some_and(|(separation, _)| separation <= -depth);
    let step = DEPTH / 8.0;
    let down = (1..64).map(|i| touching - DVec3::Y * (f64::from(i) * step));
    let Some(mut low) = down.take_while(|&place| is_deep(place, 0.0)).find(|&place| is_deep(place, DEPTH))
    else {
        return Some(touching);
    };
    let mut high = low + DVec3::Y * step;
    for _ in 0..40 {
        let middle = (low + high) * 0.5;
        if is_deep(middle, DEPTH) { low = middle } else { high = middle }
    }
    Some(low)
}

fn first_touch(start: DVec3, answer: &impl Fn(DVec3) -> Option<(f64, DVec3)>) -> Option<DVec3> {
    const NEAR: f64 = 1e-5;
    let mut place = start.with_y(start.y + 2.0);
    while place.y > start.y - 2.0 {
        let (gap, _) = answer(place)?;
        if gap <= NEAR {
            return Some(place);
        }
        place.y -= gap;
    }
    None
}

/// The middle of the supporting feature in a direction of the world: a vertex, or the middle of an edge or face.
fn end3(shape: &Shape3, pose: &Pose3, along: DVec3) -> DVec3 {
    let aside = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
    let diagonal = aside.map(|side| side + DVec3::new(-side.z, 0.0, side.x));
    let ends = aside.into_iter().chain(diagonal).filter_map(|side| {
        let end = shape.support(pose.turn_back(along + side * 0.02))?;
        Some(pose.transform(end))
    });
    let ends: Vec<DVec3> = ends.collect();
    ends.iter().sum::<DVec3>() / ends.len().max(1) as f64
}

fn end2(shape: &Shape2, pose: &Pose2, along: DVec2) -> DVec2 {
    let ends = [DVec2::X, DVec2::NEG_X].into_iter().filter_map(|side| {
        let end = shape.support(pose.turn_back(along + side * 0.02))?;
        Some(pose.transform(end))
    });
    let ends: Vec<DVec2> = ends.collect();
    ends.iter().sum::<DVec2>() / ends.len().max(1) as f64
}

/// Yaw about y, after pitch about x, after roll about z; in radians.
fn angles(attitude: Attitude) -> [f64; 3] {
    match attitude {
        Attitude::Flat => [0.30, 0.0, 0.0],
        Attitude::Across => [1.10, 0.0, 0.0],
        Attitude::Edge => [0.35, 0.0, 0.55],
        Attitude::Vertex => [0.30, 0.50, 0.60],
        Attitude::Over => [1.27, core::f64::consts::PI, 0.0],
    }
}

fn turned([yaw, pitch, roll]: [f64; 3]) -> Quat {
    let half = |angle: f64| libm::sincos(angle * 0.5);
    let ((sy, cy), (sx, cx), (sz, cz)) = (half(yaw), half(pitch), half(roll));
    let (x, y, z, w) = (
        cy * sx * cz + sy * cx * sz,
        sy * cx * cz - cy * sx * sz,
        cy * cx * sz - sy * sx * cz,
        cy * cx * cz + sy * sx * sz,
    );
    // Half turns must be exact: two half-spaces then face exactly away from each other.
    let [x, y, z, w] = [x, y, z, w].map(|c| if c.abs() < 1e-12 { 0.0 } else { c as f32 });
    Quat::from_xyzw(x, y, z, w)
}
