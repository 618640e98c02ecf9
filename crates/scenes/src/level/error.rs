//! What can be wrong with a scene file.

use super::MAX_RATE;
use asunder_geometry::{
    CapsuleError, CompoundError, DecomposeError, DirectionError, ExtentError, HullError, PolygonError,
    PoseError, RadiusError, VertexError,
};
use core::fmt;

/// Why a scene file is rejected, and where in it the fault is.
#[derive(Debug)]
pub enum LevelError {
    /// The text is not JSON, or a field is unknown, missing or of the wrong type. The message ends with line and
    /// column.
    Json(serde_json::Error),
    /// The text is well formed, but says something impossible.
    Content {
        /// Where it is, such as `bodies[17].rotation` or `shapes["rock"].points[3]`.
        path: String,
        /// What it is.
        fault: Fault,
    },
}

/// Impossible content of a well-formed scene file.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// The dimension is neither 2 nor 3.
    Dimension {
        /// What the file asks for.
        found: u64,
    },
    /// A vector has the wrong number of components.
    Length {
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A shape has the wrong number of points.
    Points {
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A list of numbers where one number belongs, or the other way round.
    Form {
        /// What should be there.
        expected: &'static str,
    },
    /// A shape of the other dimension.
    ForeignShape {
        /// The kind of shape.
        kind: &'static str,
        /// The only dimension in which it exists.
        dimension: u64,
    },
    /// A number that an f32 cannot hold.
    TooLarge {
        /// The number.
        value: f64,
    },
    /// A length that is zero or negative.
    NotPositive {
        /// The length.
        value: f64,
    },
    /// A gravity or velocity beyond [`MAX_RATE`].
    TooFast {
        /// Its length.
        value: f64,
    },
    /// A number of sides that makes no shape, or too large a one.
    Sides {
        /// The most there may be.
        most: u64,
        /// What the file asks for.
        found: u64,
    },
    /// A body names a shape that the file does not have.
    UnknownShape {
        /// The name.
        name: String,
    },
    /// The number of a layer is above 31.
    UnknownLayer {
        /// The number.
        number: u64,
    },
    /// A fixed body has a velocity.
    FixedMoves,
    /// The shape's half extents are invalid.
    Extent(ExtentError),
    /// The polygon is invalid.
    Polygon(PolygonError),
    /// The hull is invalid.
    Hull(HullError),
    /// The radius is invalid.
    Radius(RadiusError),
    /// The vertices are invalid.
    Vertex(VertexError),
    /// The capsule is invalid.
    Capsule(CapsuleError),
    /// The normal is invalid.
    Direction(DirectionError),
    /// The parts are invalid.
    Compound(CompoundError),
    /// The outline is invalid.
    Decompose(DecomposeError),
    /// The pose is invalid.
    Pose(PoseError),
}

impl fmt::Display for LevelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Json(error) => write!(f, "{error}"),
            Self::Content { path, fault } => write!(f, "{path}: {fault}"),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dimension { found } => write!(f, "there is no dimension {found}: give 2 or 3"),
            Self::Length { expected, found } => {
                write!(f, "{expected} numbers belong here, and there are {found}")
            }
            Self::Points { expected, found } => {
                write!(f, "{expected} points belong here, and there are {found}")
            }
            Self::Form { expected } => write!(f, "{expected} belongs here"),
            Self::ForeignShape { kind, dimension } => {
                write!(f, "a {kind} is a shape of dimension {dimension}, which this scene does not have")
            }
            Self::TooLarge { value } => write!(f, "{value:e} is more than an f32 can hold"),
            Self::NotPositive { value } => write!(f, "{value} is not positive: give a length in metres"),
            Self::TooFast { value } => {
                write!(f, "its length, {value:e}, is more than the {MAX_RATE} that a scene may ask for")
            }
            Self::Sides { most, found } => write!(f, "{found} sides are not possible: give 3 to {most}"),
            Self::UnknownShape { name } => write!(f, "there is no shape {name:?} under \"shapes\""),
            Self::UnknownLayer { number } => write!(f, "there is no layer {number}: give 0 to 31"),
            Self::FixedMoves => write!(f, "a fixed body has no velocity: leave one of the two out"),
            Self::Extent(error) => write!(f, "{error}"),
            Self::Polygon(error) => write!(f, "{error}"),
            Self::Hull(error) => write!(f, "{error}"),
            Self::Radius(error) => write!(f, "{error}"),
            Self::Vertex(error) => write!(f, "{error}"),
            Self::Capsule(error) => write!(f, "{error}"),
            Self::Direction(error) => write!(f, "{error}"),
            Self::Compound(error) => write!(f, "{error}"),
            Self::Decompose(error) => write!(f, "{error}"),
            Self::Pose(error) => write!(f, "{error}"),
        }
    }
}

// No source: the message already contains the fault.
impl core::error::Error for LevelError {}

impl core::error::Error for Fault {}

impl From<ExtentError> for Fault {
    fn from(error: ExtentError) -> Self {
        Self::Extent(error)
    }
}

impl From<PolygonError> for Fault {
    fn from(error: PolygonError) -> Self {
        Self::Polygon(error)
    }
}

impl From<HullError> for Fault {
    fn from(error: HullError) -> Self {
        Self::Hull(error)
    }
}

impl From<PoseError> for Fault {
    fn from(error: PoseError) -> Self {
        Self::Pose(error)
    }
}

impl From<RadiusError> for Fault {
    fn from(error: RadiusError) -> Self {
        Self::Radius(error)
    }
}

impl From<VertexError> for Fault {
    fn from(error: VertexError) -> Self {
        Self::Vertex(error)
    }
}

impl From<CapsuleError> for Fault {
    fn from(error: CapsuleError) -> Self {
        Self::Capsule(error)
    }
}

impl From<DirectionError> for Fault {
    fn from(error: DirectionError) -> Self {
        Self::Direction(error)
    }
}

impl From<CompoundError> for Fault {
    fn from(error: CompoundError) -> Self {
        Self::Compound(error)
    }
}

impl From<DecomposeError> for Fault {
    fn from(error: DecomposeError) -> Self {
        Self::Decompose(error)
    }
}
