//! Whether two bodies of a world share a point, and how far apart they are, without using the narrow phase.
//!
//! ```text
//! body      = convex parts: itself, a compound's parts, a mesh's or field's triangles, a chain's segments
//! two parts : the separation by all axes and all pairs of features, in f64                     (cores)
//!             where that is within 1e-7 m of zero, the overlap decision over integers          (exact_overlap)
//! one-sided : a triangle or segment counts for the parts whose centres are in front of it
//! bodies    = the least of all parts
//! ```
//! Parts are skipped only where their plain AABBs are further apart than the least separation so far, or than the
//! question asks for.

mod plane;
mod volume;

use crate::engine::Engine;
use glam::DVec3;
use std::sync::Arc;

/// Separations further from zero than this, in metres, decide overlap: f64 is off by some 1e-15 of a few metres, or,
/// where edges are nearly parallel, by the tilt of their axis, which is far less than this as well.
const SURE: f64 = 1e-7;

/// A centre nearer than this to a one-sided plane, in metres, may be on either side of it.
const EDGEWISE: f64 = 1e-6;

/// What the oracle needs of a dimension. Points of the plane have z = 0.
pub trait Judged: Engine {
    /// A posed convex part.
    type Piece: Clone + core::fmt::Debug;
    /// The convex parts of a shape.
    fn parts(shape: &Self::Shape) -> Vec<Part<Self>>;
    /// A part, posed as its body is.
    fn placed(part: &Part<Self>, pose: &Self::Pose) -> Place<Self>;
    /// The separation of two convex parts.
    fn separation(a: &Self::Piece, b: &Self::Piece) -> f64;
    /// Whether two posed convex shapes share a point, exactly.
    fn share_a_point(a: (&Self::Shape, &Self::Pose), b: (&Self::Shape, &Self::Pose)) -> bool;
    /// The pose after a fraction of a motion.
    fn pose_in(motion: &Self::Motion, from: &Self::Pose, fraction: f64) -> Self::Pose;
    /// A motion's displacement, in metres.
    fn displacement(motion: &Self::Motion) -> DVec3;
    /// How far a motion's rotation moves a point a metre from its axis, in a straight line.
    fn chord(motion: &Self::Motion, from: &Self::Pose) -> f64;
    /// The fraction of the motion at an impact, and an upper bound of the distance between the bodies then.
    fn fraction_and_error(impact: &Self::Impact) -> (f64, f64);
    /// The separation that a manifold reports, and its error.
    fn told(manifold: &Self::Manifold) -> [f64; 2];
}

/// A convex part of a body, in the body's axes.
#[derive(Clone, Debug)]
pub struct Part<S: Judged> {
    /// The part alone, to be posed as the body is.
    pub shape: S::Shape,
    /// The same, posed within the body.
    pub piece: S::Piece,
    /// The centre by which one-sided ground decides whether it faces the part; half-spaces have none.
    pub center: Option<DVec3>,
    /// For one-sided ground: the normal of the front, and a point of it.
    pub front: Option<[DVec3; 2]>,
    /// The distance of its furthest point from the body's position.
    pub reach: f64,
}

/// A posed part.
#[derive(Clone, Debug)]
pub struct Place<S: Judged> {
    /// The part's geometry.
    pub piece: S::Piece,
    /// The least corner of its AABB.
    pub low: DVec3,
    /// The greatest corner of its AABB.
    pub high: DVec3,
    /// As in [`Part`].
    pub center: Option<DVec3>,
    /// As in [`Part`].
    pub front: Option<[DVec3; 2]>,
}

/// A posed body.
#[derive(Clone, Debug)]
pub struct Stand<S: Judged> {
    parts: Arc<Vec<Part<S>>>,
    pose: S::Pose,
    places: Vec<Place<S>>,
}

/// The oracle's answer for two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// Whether they share a point.
    pub overlapping: bool,
    /// The separation, in metres; for bodies further apart than the question asks for, a lower bound.
    pub separation: f64,
    /// Whether rounding decides which side of one-sided ground a part is on: then none of this is certain.
    pub is_doubtful: bool,
}

/// What the oracle is asked.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// The separation up to which it is to be measured, in metres.
    pub within: f64,
    /// Whether one-sided ground is met from its front only.
    pub has_sides: bool,
}

impl<S: Judged> Stand<S> {
    /// A shape at a pose.
    pub fn new(shape: &S::Shape, pose: &S::Pose) -> Self {
        Self::of_parts(Arc::new(S::parts(shape)), pose)
    }

    /// The same body at another pose.
    pub fn at(&self, pose: &S::Pose) -> Self {
        Self::of_parts(Arc::clone(&self.parts), pose)
    }

    fn of_parts(parts: Arc<Vec<Part<S>>>, pose: &S::Pose) -> Self {
        let places = parts.iter().map(|part| S::placed(part, pose)).collect();
        Self { parts, pose: *pose, places }
    }

    /// The distance of its furthest point from its position.
    pub fn reach(&self) -> f64 {
        self.parts.iter().map(|part| part.reach).fold(0.0, f64::max)
    }

    /// The corners of the AABB around all of it.
    pub fn corners(&self) -> [DVec3; 2] {
        let low = self.places.iter().map(|place| place.low).reduce(DVec3::min);
        let high = self.places.iter().map(|place| place.high).reduce(DVec3::max);
        [low.unwrap(), high.unwrap()]
    }

    /// Whether it has a front only.
    pub fn is_one_sided(&self) -> bool {
        self.parts.iter().any(|part| part.front.is_some())
    }

    /// The oracle's answer for this body and another.
    pub fn meet(&self, other: &Self, question: Question) -> Word {
        let mut word = Word { overlapping: false, separation: f64::INFINITY, is_doubtful: false };
        for (a, part) in self.places.iter().zip(self.parts.iter()) {
            for (b, other_part) in other.places.iter().zip(other.parts.iter()) {
                let gap = gap_of_boxes([a.low, a.high], [b.low, b.high]);
                if gap > question.within {
                    word.separation = word.separation.min(gap);
                    continue;
                }
                if gap > word.separation.max(1e-6) {
                    continue;
                }
                match is_seen(a, b) {
                    _ if !question.has_sides => {}
                    None => word.is_doubtful = true,
                    Some(false) => continue,
                    Some(true) => {}
                }
                let separation = S::separation(&a.piece, &b.piece);
                word.separation = word.separation.min(separation);
                if !word.overlapping && separation < SURE {
                    let [a, b] = [(&part.shape, &self.pose), (&other_part.shape, &other.pose)];
                    word.overlapping = separation < -SURE || S::share_a_point(a, b);
                }
            }
        }
        word
    }
}

/// Whether the centre of one part is in front of the other, if that is one-sided; `None` where rounding would decide.
fn is_seen<S: Judged>(a: &Place<S>, b: &Place<S>) -> Option<bool> {
    let [normal, at, center] = match (a.front, b.front) {
        (Some([normal, at]), _) => [normal, at, b.center?],
        (_, Some([normal, at])) => [normal, at, a.center?],
        _ => return Some(true),
    };
    let height = normal.dot(center - at);
    (height.abs() > EDGEWISE).then_some(height > 0.0)
}

/// How far apart two AABBs are along their best separating axis; negative where they overlap.
pub fn gap_of_boxes([low, high]: [DVec3; 2], [other_low, other_high]: [DVec3; 2]) -> f64 {
    (other_low - high).max(low - other_high).max_element()
}
