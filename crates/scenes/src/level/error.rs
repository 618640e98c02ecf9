//! What can be wrong with a scene file.

use super::MAX_RATE;
use asunder_geometry::{
    CapsuleError, CompoundError, DecomposeError, DirectionError, ExtentError, HullError, PolygonError,
    PoseError, RadiusError, VertexError,
};
use core::fmt;

/// Why a scene file was refused, and where in it the fault is.
#[derive(Debug)]
pub enum LevelError {
    /// The text is no JSON, or a field is unknown, missing or of the wrong type. The message ends with line and column.
    Json(serde_json::Error),
    /// The text is well formed, but says something impossible.
    Content {
        /// Where, such as `bodies[17].rotation` or `shapes["rock"].points[3]`.
        path: String,
        /// What.
        fault: Fault,
    },
}

/// Something impossible that a well-formed scene file says.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// A scene is in the plane or in space.
    Dimension {
        /// What the file asks for.
        found: u64,
    },
    /// A vector has the wrong count of numbers.
    Length {
        /// As many as there should be.
        expected: usize,
        /// As many as there are.
        found: usize,
    },
    /// A shape has another count of points.
    Points {
        /// As many as there should be.
        expected: usize,
        /// As many as there are.
        found: usize,
    },
    /// A list of numbers where one number belongs, or the other way round.
    Form {
        /// What belongs there.
        expected: &'static str,
    },
    /// A shape of the other dimension.
    ForeignShape {
        /// The kind of shape.
        kind: &'static str,
        /// The only dimension that it has.
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
    /// A count of sides that makes no shape, or too large a one.
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
    /// A layer's number beyond 31.
    UnknownLayer {
        /// The number.
        number: u64,
    },
    /// A fixed body has a velocity.
    FixedMoves,
    /// The shape's half extents are refused.
    Extent(ExtentError),
    /// The polygon is refused.
    Polygon(PolygonError),
    /// The hull is refused.
    Hull(HullError),
    /// The radius is refused.
    Radius(RadiusError),
    /// The vertices are refused.
    Vertex(VertexError),
    /// The capsule is refused.
    Capsule(CapsuleError),
    /// The normal is refused.
    Direction(DirectionError),
    /// The parts are refused.
    Compound(CompoundError),
    /// The outline is refused.
    Decompose(DecomposeError),
    /// The pose is refused.
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

// No source: the fault stands in the text already.
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
