//! Scaled shapes, for scene nodes with a scale and assets in other units.
//!
//! A scaled shape is a new one, made from the old one's vertices times the factors, each rounded once to f32; powers of
//! two are exact. Derived data (faces, normals, radii, which triangles share a plane) are computed anew.

mod plane;
mod space;

use crate::chain::ChainError;
use crate::compound::CompoundError;
use crate::direction::DirectionError;
use crate::extent::ExtentError;
use crate::height_field::HeightFieldError;
use crate::hull::HullError;
use crate::mesh::MeshError;
use crate::polygon::PolygonError;
use crate::pose3::PoseError;
use crate::radius::RadiusError;
use crate::segment::CapsuleError;
use crate::vertex::VertexError;
use core::array;

/// Why a shape cannot be scaled by some factors.
///
/// ```
/// use asunder::{Cuboid, ScaleError, Shape3, Sphere, glam::Vec3};
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// assert_eq!(ball.scaled(Vec3::new(2.0, 1.0, 2.0)), Err(ScaleError::Round));
/// assert_eq!(ball.scaled(Vec3::new(1.0, 0.0, 1.0)), Err(ScaleError::Factor { axis: 1, value: 0.0 }));
/// let house = Shape3::from(Cuboid::from_half_extents(Vec3::new(5.0, 3.0, 4.0))?);
/// let refused = house.scaled(Vec3::splat(1e6)).unwrap_err();
/// assert!(matches!(refused, ScaleError::Extent(_)) && refused.to_string().contains("above 1000000 m"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ScaleError {
    /// A factor is zero, NaN or infinite.
    Factor {
        /// Which axis, 0 for x.
        axis: usize,
        /// The given value.
        value: f32,
    },
    /// A round shape, or a rounding, would not stay round, as the factors differ in magnitude.
    Round,
    /// A height field would be turned upside down, or its columns and rows mirrored.
    Mirrored,
    /// The scaled rectangle or cuboid would be invalid.
    Extent(ExtentError),
    /// The scaled radius would be invalid.
    Radius(RadiusError),
    /// The scaled capsule would be invalid.
    Capsule(CapsuleError),
    /// The scaled segment or triangle would be invalid.
    Vertex(VertexError),
    /// The scaled half-plane or half-space would be invalid.
    Direction(DirectionError),
    /// The scaled polygon would be invalid.
    Polygon(PolygonError),
    /// The scaled hull would be invalid.
    Hull(HullError),
    /// The scaled chain would be invalid.
    Chain(ChainError),
    /// The scaled compound would be invalid.
    Compound(CompoundError),
    /// The scaled pose of a part of a compound would be invalid.
    Pose(PoseError),
    /// A part of a compound cannot be scaled by itself. (One that would be too far away is a [`ScaleError::Compound`].)
    Part {
        /// Its index in the compound.
        part: usize,
        /// The error of that part.
        error: Box<ScaleError>,
    },
    /// The scaled triangle mesh would be invalid.
    Mesh(MeshError),
    /// The scaled height field would be invalid.
    HeightField(HeightFieldError),
}

impl core::fmt::Display for ScaleError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match (self, self.inner()) {
            (Self::Part { part, error }, _) => write!(f, "part {part} of the compound: {error}"),
            (_, Some(error)) => write!(f, "the scaled shape is refused: {error}"),
            (Self::Factor { axis, value }, _) => {
                write!(
                    f,
                    "factor {value} on axis {axis} makes no shape: give a finite number that is not zero"
                )
            }
            (Self::Mirrored, _) => {
                write!(
                    f,
                    "a height field cannot be mirrored: give positive factors, and turn the body for a half turn"
                )
            }
            _ => write!(
                f,
                "a round shape stays round only with one factor for all axes: give that, or make a hull of it"
            ),
        }
    }
}

// No source: the text includes it already, and printing a chain of errors would repeat it.
impl core::error::Error for ScaleError {}

/// For each error type of a constructor: how it becomes a [`ScaleError`], and how it is printed.
macro_rules! refused_by {
    ($($variant:ident($error:ty)),+ $(,)?) => {
        impl ScaleError {
            fn inner(&self) -> Option<&dyn core::fmt::Display> {
                match self {
                    $(Self::$variant(error) => Some(error),)+
                    Self::Part { error, .. } => Some(error),
                    Self::Factor { .. } | Self::Round | Self::Mirrored => None,
                }
            }
        }
        $(
            impl From<$error> for ScaleError {
                fn from(error: $error) -> Self {
                    Self::$variant(error)
                }
            }
        )+
    };
}

refused_by!(
    Extent(ExtentError),
    Radius(RadiusError),
    Capsule(CapsuleError),
    Vertex(VertexError),
    Direction(DirectionError),
    Polygon(PolygonError),
    Hull(HullError),
    Chain(ChainError),
    Compound(CompoundError),
    Pose(PoseError),
    Mesh(MeshError),
    HeightField(HeightFieldError),
);

/// Scales all parts of a compound, or returns the error of the first that cannot be scaled.
fn all_scaled<P, S>(parts: &[P], scaled: impl Fn(&P) -> Result<S, ScaleError>) -> Result<Vec<S>, ScaleError> {
    let of_part = |(part, of): (usize, &P)| {
        scaled(of).map_err(|error| ScaleError::Part { part, error: Box::new(error) })
    };
    parts.iter().enumerate().map(of_part).collect()
}

/// Rejects invalid factors.
fn check(factors: &[f32]) -> Result<(), ScaleError> {
    match factors.iter().position(|factor| !factor.is_finite() || *factor == 0.0) {
        Some(axis) => Err(ScaleError::Factor { axis, value: factors[axis] }),
        None => Ok(()),
    }
}

/// A radius times the magnitude that all factors share; zero stays zero under any factors.
fn scaled_radius(radius: f32, factors: &[f32]) -> Result<f32, ScaleError> {
    match radius {
        0.0 => Ok(0.0),
        _ if are_of_one_size(factors) => Ok(radius * factors[0].abs()),
        _ => Err(ScaleError::Round),
    }
}

fn are_of_one_size(factors: &[f32]) -> bool {
    factors.iter().all(|factor| factor.abs() == factors[0].abs())
}

/// The normal of a plane through the origin whose points are scaled by some factors. The same bits, up to signs, if the
/// factors have one magnitude; otherwise rounded once, since only a power of two is divided out to fit f32.
fn scaled_normal<const N: usize>(normal: [f32; N], factors: [f32; N]) -> [f32; N] {
    if are_of_one_size(&factors) {
        return array::from_fn(|axis| normal[axis] * factors[axis].signum());
    }
    let normal: [f64; N] = array::from_fn(|axis| f64::from(normal[axis]) / f64::from(factors[axis]));
    let largest = normal.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
    let power_of_two = f64::from_bits(largest.to_bits() & f64::INFINITY.to_bits());
    normal.map(|component| (component / power_of_two) as f32)
}

#[cfg(test)]
mod tests;
