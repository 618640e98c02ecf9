//! Whether two bodies of a world share a point, and how far apart they are, without asking the narrow phase.
//!
//! ```text
//! body      = convex parts: itself, a compound's parts, a mesh's or field's triangles, a chain's segments
//! two parts : the separation by all axes and all pairs of features, in f64                     (cores)
//!             where that is within 1e-7 m of zero, yes or no over integers                     (exact_overlap)
//! one-sided : a triangle or segment counts for the parts whose centres are in front of it
//! bodies    = the least of all parts
//! ```
//! Parts are left out only where their plain boxes are further apart than what was found already, or than anybody asks
//! for.

mod plane;
mod volume;

use crate::engine::Engine;
use glam::DVec3;
use std::sync::Arc;

/// Numbers further from zero than this, in metres, say yes or no: f64 is off by some 1e-15 of a few metres, or, where
/// edges are nearly parallel, by as much as their axis leans, which is far less as well.
const SURE: f64 = 1e-7;

/// Centres nearer than this to a one-sided plane, in metres, may be on either side of it.
const EDGEWISE: f64 = 1e-6;

/// What the judge must know of a dimension. Points of the plane have no height.
pub trait Judged: Engine {
    /// A convex part where it is.
    type Piece: Clone + core::fmt::Debug;
    /// The convex parts of a shape.
    fn parts(shape: &Self::Shape) -> Vec<Part<Self>>;
    /// A part, posed as its body is.
    fn placed(part: &Part<Self>, pose: &Self::Pose) -> Place<Self>;
    /// The separation of two convex parts.
    fn separation(a: &Self::Piece, b: &Self::Piece) -> f64;
    /// Whether two posed convex shapes share a point, exactly.
    fn share_a_point(a: (&Self::Shape, &Self::Pose), b: (&Self::Shape, &Self::Pose)) -> bool;
    /// Where a motion leads in a share of it.
    fn pose_in(motion: &Self::Motion, from: &Self::Pose, fraction: f64) -> Self::Pose;
    /// A motion's displacement, in metres.
    fn displacement(motion: &Self::Motion) -> DVec3;
    /// How far a motion's turn brings a point that is a metre from its axis, as the crow flies.
    fn chord(motion: &Self::Motion, from: &Self::Pose) -> f64;
    /// The share of the motion that is done at an impact, and how far apart the bodies are then at most.
    fn fraction_and_error(impact: &Self::Impact) -> (f64, f64);
    /// What a manifold tells of the separation, and how far that may be off.
    fn told(manifold: &Self::Manifold) -> [f64; 2];
}

/// A convex part of a body, in the body's axes.
#[derive(Clone, Debug)]
pub struct Part<S: Judged> {
    /// The part alone, to be posed as the body is.
    pub shape: S::Shape,
    /// The same, where it is in the body.
    pub piece: S::Piece,
    /// The centre by which one-sided ground tells whether it sees the part; half-spaces have none.
    pub center: Option<DVec3>,
    /// Of one-sided ground: the normal of the front, and a point of it.
    pub front: Option<[DVec3; 2]>,
    /// How far its points are from the body's position.
    pub reach: f64,
}

/// A part where it is in the world.
#[derive(Clone, Debug)]
pub struct Place<S: Judged> {
    /// All of it.
    pub piece: S::Piece,
    /// The least corner of its box.
    pub low: DVec3,
    /// The greatest corner of its box.
    pub high: DVec3,
    /// As of the part.
    pub center: Option<DVec3>,
    /// As of the part.
    pub front: Option<[DVec3; 2]>,
}

/// A body where it is.
#[derive(Clone, Debug)]
pub struct Stand<S: Judged> {
    parts: Arc<Vec<Part<S>>>,
    pose: S::Pose,
    places: Vec<Place<S>>,
}

/// The judge's word on two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// Whether they share a point.
    pub overlapping: bool,
    /// The separation, in metres; of bodies that are further apart than was asked for, a lower bound.
    pub separation: f64,
    /// Whether rounding says which side of one-sided ground a part is on: then all of this may be otherwise.
    pub is_doubtful: bool,
}

/// What is asked of the judge.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Up to which separation it is to be told, in metres.
    pub within: f64,
    /// Whether one-sided ground is seen from its front only.
    pub has_sides: bool,
}

impl<S: Judged> Stand<S> {
    /// A shape at a pose.
    pub fn new(shape: &S::Shape, pose: &S::Pose) -> Self {
        Self::of_parts(Arc::new(S::parts(shape)), pose)
    }

    /// The same body elsewhere.
    pub fn at(&self, pose: &S::Pose) -> Self {
        Self::of_parts(Arc::clone(&self.parts), pose)
    }

    fn of_parts(parts: Arc<Vec<Part<S>>>, pose: &S::Pose) -> Self {
        let places = parts.iter().map(|part| S::placed(part, pose)).collect();
        Self { parts, pose: *pose, places }
    }

    /// How far its points are from its position.
    pub fn reach(&self) -> f64 {
        self.parts.iter().map(|part| part.reach).fold(0.0, f64::max)
    }

    /// The corners of the box around all of it.
    pub fn corners(&self) -> [DVec3; 2] {
        let low = self.places.iter().map(|place| place.low).reduce(DVec3::min);
        let high = self.places.iter().map(|place| place.high).reduce(DVec3::max);
        [low.unwrap(), high.unwrap()]
    }

    /// Whether it has a front, and nothing behind.
    pub fn is_one_sided(&self) -> bool {
        self.parts.iter().any(|part| part.front.is_some())
    }

    /// The judge's word on this body and another.
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

/// Whether the side that one of two parts is seen from is the one that the other is on; nothing where rounding would
/// tell.
fn is_seen<S: Judged>(a: &Place<S>, b: &Place<S>) -> Option<bool> {
    let [normal, at, center] = match (a.front, b.front) {
        (Some([normal, at]), _) => [normal, at, b.center?],
        (_, Some([normal, at])) => [normal, at, a.center?],
        _ => return Some(true),
    };
    let height = normal.dot(center - at);
    (height.abs() > EDGEWISE).then_some(height > 0.0)
}

/// How far apart two boxes are along the axis that parts them best; less than zero where they overlap.
pub fn gap_of_boxes([low, high]: [DVec3; 2], [other_low, other_high]: [DVec3; 2]) -> f64 {
    (other_low - high).max(low - other_high).max_element()
}
