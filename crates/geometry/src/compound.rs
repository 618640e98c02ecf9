//! Several convex parts under one collider.

use crate::aabb::{Aabb2, Aabb3, Bounds};
use crate::outward::{around2, around3, round_up};
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use crate::shape::{Shape2, Shape3};
use crate::tolerance::{MAX_PARTS, MAX_RADIUS};
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::sync::Arc;

/// Several convex parts in the plane, each posed, that move as one. Clones share the data.
///
#[doc = include_str!("../doc/compound2.svg")]
///
/// It is the union of its parts, which may overlap. Each pair of parts of two bodies that touch has a manifold of its
/// own; parts of one body never meet. The separation from another shape is the least of its parts'. Cost of a pair: a
/// bounding circle test for each pair of parts, and the cost of the parts that pass.
///
/// ```
/// use asunder_geometry::{Circle, Compound2, Pose2, Rect, Shape2, glam::{DVec2, Vec2}};
/// let head: Shape2 = Circle::new(0.4)?.into();
/// let body: Shape2 = Rect::from_half_extents(Vec2::new(0.1, 1.0))?.into();
/// let hammer = Compound2::new([(Pose2::at([0.0, 1.0])?, head), (Pose2::IDENTITY, body)])?;
/// assert_eq!(hammer.parts().len(), 2);
/// assert!(hammer.contains(DVec2::new(0.0, 1.4)) && !hammer.contains(DVec2::X));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Compound2 {
    parts: Arc<[Part2]>,
    center: Vec2,
    outer_radius: f32,
}

/// A part of a compound in the plane.
///
/// ```
/// use asunder_geometry::{Compound2, Circle, Pose2, Shape2};
/// let ball: Shape2 = Circle::new(1.0)?.into();
/// let part = &Compound2::new([(Pose2::IDENTITY, ball.clone())])?.parts()[0].clone();
/// assert_eq!((part.pose(), part.shape()), (&Pose2::IDENTITY, &ball));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Part2 {
    pose: Pose2,
    shape: Shape2,
    center: DVec2,
}

impl Part2 {
    fn new(pose: Pose2, shape: Shape2) -> Self {
        let center = pose.transform(shape.center());
        Self { pose, shape, center }
    }

    /// Where the part is in the compound.
    #[inline]
    pub const fn pose(&self) -> &Pose2 {
        &self.pose
    }

    /// What it is: convex and bounded.
    #[inline]
    pub const fn shape(&self) -> &Shape2 {
        &self.shape
    }

    /// Centre of its bounding circle, in the compound's axes.
    #[inline]
    pub const fn center(&self) -> DVec2 {
        self.center
    }
}

impl Compound2 {
    /// A compound from its parts and where they are.
    ///
    /// # Errors
    /// No parts, or more than [`MAX_PARTS`]; a part that is a compound, ground or unbounded, or that reaches beyond
    /// 1e6 m.
    pub fn new(parts: impl IntoIterator<Item = (Pose2, Shape2)>) -> Result<Self, CompoundError> {
        let parts: Arc<[Part2]> = parts.into_iter().map(|(pose, shape)| Part2::new(pose, shape)).collect();
        if parts.is_empty() {
            return Err(CompoundError::NoParts);
        }
        if parts.len() > MAX_PARTS {
            return Err(CompoundError::TooManyParts { count: parts.len() });
        }
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for (index, part) in parts.iter().enumerate() {
            match part.shape {
                Shape2::Compound(_) => return Err(CompoundError::Nested { index }),
                Shape2::HalfPlane(_) => return Err(CompoundError::Unbounded { index }),
                Shape2::Chain(_) => return Err(CompoundError::Ground { index }),
                _ => {}
            }
            let radius = f64::from(part.shape.outer_radius());
            if part.center().length() + radius > f64::from(MAX_RADIUS) {
                return Err(CompoundError::TooLarge { index });
            }
            let bounds = part.shape.bounds(&part.pose, 0.0);
            (low, high) = (low.min(bounds.min.as_dvec2()), high.max(bounds.max.as_dvec2()));
        }
        let center = ((low + high) * 0.5).as_vec2();
        let reach = |part: &Part2| {
            // A stored rotation stretches by its length, which is one up to the rounding of f32.
            let stretched = f64::from(part.shape.outer_radius()) * (1.0 + 2.0 * f64::from(f32::EPSILON));
            (part.center() - center.as_dvec2()).length() + stretched
        };
        let outer = parts.iter().map(reach).fold(0.0, f64::max);
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        Ok(Self { parts, center, outer_radius })
    }

    /// An address that two compounds have in common exactly when they share their parts; only good while both live. It
    /// differs from run to run: look up by it, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        Arc::as_ptr(&self.parts).addr()
    }

    /// The parts, in the order given: a manifold's `part_a` and `part_b` count them.
    #[inline]
    pub fn parts(&self) -> &[Part2] {
        &self.parts
    }

    /// The centre that the bounding radius is about: the middle of its box.
    #[inline]
    pub const fn center(&self) -> Vec2 {
        self.center
    }

    /// Bounding radius about [`Compound2::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether any part holds a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        let point = point.into();
        self.parts.iter().any(|part| part.shape.contains(part.pose.transform_back(point)))
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. Cost: linear in the parts'
    /// vertices.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let box_of = |part: &Part2| {
            let core = part.shape.core();
            let points = core.vertices().iter().map(|&vertex| part.pose.transform(vertex));
            // A part far from the compound's origin may come back near it: what its place lost to rounding shows then.
            let lost =
                64.0 * f64::EPSILON * (part.pose.position().length() + f64::from(part.shape.outer_radius()));
            around2(points, pose, f64::from(margin) + f64::from(part.shape.radius()) + lost)
        };
        self.parts.iter().map(box_of).reduce(|one, other| one.union(&other)).unwrap_or(Aabb2::NOTHING)
    }
}

/// Several convex parts in space, each posed, that move as one. Clones share the data.
///
#[doc = include_str!("../doc/compound3.svg")]
///
/// It is the union of its parts, which may overlap. Each pair of parts of two bodies that touch has a manifold of its
/// own; parts of one body never meet. The separation from another shape is the least of its parts'. Cost of a pair: a
/// bounding sphere test for each pair of parts, and the cost of the parts that pass.
///
/// ```
/// use asunder_geometry::{Compound3, Cuboid, Pose3, Shape3, Sphere, glam::{DVec3, Vec3}};
/// let head: Shape3 = Sphere::new(0.4)?.into();
/// let body: Shape3 = Cuboid::from_half_extents(Vec3::new(0.1, 1.0, 0.1))?.into();
/// let hammer = Compound3::new([(Pose3::at([0.0, 1.0, 0.0])?, head), (Pose3::IDENTITY, body)])?;
/// assert_eq!(hammer.parts().len(), 2);
/// assert!(hammer.contains(DVec3::new(0.0, 1.4, 0.0)) && !hammer.contains(DVec3::X));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Compound3 {
    parts: Arc<[Part3]>,
    center: Vec3,
    outer_radius: f32,
}

/// A part of a compound in space.
///
/// ```
/// use asunder_geometry::{Compound3, Sphere, Pose3, Shape3};
/// let ball: Shape3 = Sphere::new(1.0)?.into();
/// let part = &Compound3::new([(Pose3::IDENTITY, ball.clone())])?.parts()[0].clone();
/// assert_eq!((part.pose(), part.shape()), (&Pose3::IDENTITY, &ball));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Part3 {
    pose: Pose3,
    shape: Shape3,
    center: DVec3,
}

impl Part3 {
    fn new(pose: Pose3, shape: Shape3) -> Self {
        let center = pose.transform(shape.center());
        Self { pose, shape, center }
    }

    /// Where the part is in the compound.
    #[inline]
    pub const fn pose(&self) -> &Pose3 {
        &self.pose
    }

    /// What it is: convex and bounded.
    #[inline]
    pub const fn shape(&self) -> &Shape3 {
        &self.shape
    }

    /// Centre of its bounding sphere, in the compound's axes.
    #[inline]
    pub const fn center(&self) -> DVec3 {
        self.center
    }
}

impl Compound3 {
    /// A compound from its parts and where they are.
    ///
    /// # Errors
    /// No parts, or more than [`MAX_PARTS`]; a part that is a compound or unbounded, or that reaches beyond 1e6 m.
    pub fn new(parts: impl IntoIterator<Item = (Pose3, Shape3)>) -> Result<Self, CompoundError> {
        let parts: Arc<[Part3]> = parts.into_iter().map(|(pose, shape)| Part3::new(pose, shape)).collect();
        if parts.is_empty() {
            return Err(CompoundError::NoParts);
        }
        if parts.len() > MAX_PARTS {
            return Err(CompoundError::TooManyParts { count: parts.len() });
        }
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (index, part) in parts.iter().enumerate() {
            match part.shape {
                Shape3::Compound(_) => return Err(CompoundError::Nested { index }),
                Shape3::HalfSpace(_) => return Err(CompoundError::Unbounded { index }),
                Shape3::TriMesh(_) | Shape3::HeightField(_) => return Err(CompoundError::Ground { index }),
                _ => {}
            }
            let radius = f64::from(part.shape.outer_radius());
            if part.center().length() + radius > f64::from(MAX_RADIUS) {
                return Err(CompoundError::TooLarge { index });
            }
            let bounds = part.shape.bounds(&part.pose, 0.0);
            (low, high) = (low.min(bounds.min.as_dvec3()), high.max(bounds.max.as_dvec3()));
        }
        let center = ((low + high) * 0.5).as_vec3();
        let reach = |part: &Part3| {
            (part.center() - center.as_dvec3()).length() + f64::from(part.shape.outer_radius())
        };
        let outer = parts.iter().map(reach).fold(0.0, f64::max);
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        Ok(Self { parts, center, outer_radius })
    }

    /// An address that two compounds have in common exactly when they share their parts; only good while both live. It
    /// differs from run to run: look up by it, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        Arc::as_ptr(&self.parts).addr()
    }

    /// The parts, in the order given: a manifold's `part_a` and `part_b` count them.
    #[inline]
    pub fn parts(&self) -> &[Part3] {
        &self.parts
    }

    /// The centre that the bounding radius is about: the middle of its box.
    #[inline]
    pub const fn center(&self) -> Vec3 {
        self.center
    }

    /// Bounding radius about [`Compound3::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether any part holds a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        self.parts.iter().any(|part| part.shape.contains(part.pose.transform_back(point)))
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. Cost: linear in the parts'
    /// vertices.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let box_of = |part: &Part3| {
            let core = part.shape.core();
            let points = core.vertices().iter().map(|&vertex| part.pose.transform(vertex));
            // A part far from the compound's origin may come back near it: what its place lost to rounding shows then.
            let lost =
                64.0 * f64::EPSILON * (part.pose.position().length() + f64::from(part.shape.outer_radius()));
            around3(points, pose, f64::from(margin) + f64::from(part.shape.radius()) + lost)
        };
        self.parts.iter().map(box_of).reduce(|one, other| one.union(&other)).unwrap_or(Aabb3::NOTHING)
    }
}

/// Why parts make no compound.
///
/// ```
/// use asunder_geometry::{Compound3, CompoundError};
/// assert_eq!(Compound3::new([]), Err(CompoundError::NoParts));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CompoundError {
    /// None were given.
    NoParts,
    /// More than [`MAX_PARTS`].
    TooManyParts {
        /// How many were given.
        count: usize,
    },
    /// A part is itself a compound.
    Nested {
        /// Index of the part.
        index: usize,
    },
    /// A part has no end.
    Unbounded {
        /// Index of the part.
        index: usize,
    },
    /// A part is ground, which is no convex shape and never moves.
    Ground {
        /// Index of the part.
        index: usize,
    },
    /// A part reaches further than [`MAX_RADIUS`] from the compound's origin.
    TooLarge {
        /// Index of the part.
        index: usize,
    },
}

impl core::fmt::Display for CompoundError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoParts => write!(f, "a compound needs a part"),
            Self::TooManyParts { count } => {
                write!(f, "{count} parts are more than {MAX_PARTS}: make several bodies of one owner")
            }
            Self::Nested { index } => {
                write!(f, "part {index} is made of several parts itself: give those instead")
            }
            Self::Unbounded { index } => {
                write!(f, "part {index} has no end: make it a body of its own")
            }
            Self::Ground { index } => {
                write!(f, "part {index} is ground: make it a body of its own")
            }
            Self::TooLarge { index } => {
                write!(f, "part {index} reaches beyond {MAX_RADIUS} m from the compound's origin: split it")
            }
        }
    }
}

impl core::error::Error for CompoundError {}
