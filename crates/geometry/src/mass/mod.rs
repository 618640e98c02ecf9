//! Mass, centre of mass and inertia of every shape, in closed form, without sampling.
//!
//! ```text
//! a shape is everything within r of a convex core; split it there:
//!
//!      ....-------....      1 the core itself               triangles or tetrahedra from an inner point
//!    .'  |    2    |  '.    2 on each face (2D: edge)       a prism of height r
//!   :  3 |_________| 3  :   3 at each vertex                a sector of a ball (2D: of a circle)
//!   |----|         |----|     and in space on each edge     a sector of a cylinder
//!   |  2 |    1    | 2  |
//! ```
//!
//! Each piece adds its volume, first and second moments about an inner point, so that a shape far from its own origin
//! loses no accuracy; the parallel axis theorem then moves them to the centre of mass. The split is Steiner's; the
//! moment of a sector of a ball, whose directions are a spherical polygon, is a sum over that polygon's arcs: Arvo,
//! "Applications of irradiance tensors to the simulation of non-Lambertian phenomena" (SIGGRAPH 1995).

mod facets;
mod plane;
mod properties;
mod rounded;
mod second;
mod volume;

pub use properties::{MassProperties2, MassProperties3};

use crate::shape::{Shape2, Shape3};

/// Why a shape has no mass properties.
///
/// ```
/// use asunder::{HalfSpace, MassError, Shape3, Sphere, glam::Vec3};
/// let floor = Shape3::from(HalfSpace::new(Vec3::Y)?);
/// assert_eq!(floor.mass_properties(1000.0), Err(MassError::Unbounded));
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// assert_eq!(ball.mass_properties(-1.0), Err(MassError::Density { value: -1.0 }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MassError {
    /// A density that is not finite or not positive.
    Density {
        /// The given value.
        value: f32,
    },
    /// A half-plane or half-space, which is unbounded.
    Unbounded,
    /// A mesh, a height field or a chain, which has no inside and never moves.
    Ground,
}

impl core::fmt::Display for MassError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Density { value } => {
                write!(f, "density {value} is not finite and positive: water has 1000 kg/m^3")
            }
            Self::Unbounded => {
                write!(f, "a shape without an end has no mass: treat its body as one that cannot move")
            }
            Self::Ground => write!(f, "ground has no mass: treat its body as one that cannot move"),
        }
    }
}

impl core::error::Error for MassError {}

impl Shape2 {
    /// Mass, centre of mass and inertia for a density in kg/m^2.
    ///
    /// Exact up to rounding: to about 1e-15 for compact shapes, times length over thickness for thin ones. A segment
    /// has no area, so its mass is zero. A compound is the sum of its parts: *where parts overlap, matter counts
    /// twice.* Cost: linear in the vertices.
    ///
    /// ```
    /// use asunder::{Rect, Shape2, glam::{DVec2, Vec2}};
    /// let plank = Shape2::from(Rect::from_half_extents(Vec2::new(2.0, 0.5))?);
    /// let properties = plank.mass_properties(3.0)?;
    /// assert_eq!((properties.mass, properties.center), (12.0, DVec2::ZERO));
    /// assert_eq!(properties.inertia, 12.0 * (4.0 * 4.0 + 1.0 * 1.0) / 12.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A density that is not finite or not positive; a half-plane, and a chain, which never moves.
    pub fn mass_properties(&self, density: f32) -> Result<MassProperties2, MassError> {
        let density = check_density(density)?;
        match self {
            Self::HalfPlane(_) => Err(MassError::Unbounded),
            Self::Chain(_) => Err(MassError::Ground),
            Self::Rect(rect) => Ok(plane::of_rect(rect, density)),
            Self::Compound(compound) => {
                let parts = compound.parts().iter();
                let parts: Vec<MassProperties2> =
                    parts.map(|part| plane::of_convex(part.shape(), density).posed(part.pose())).collect();
                Ok(MassProperties2::combined(&parts))
            }
            _ => Ok(plane::of_convex(self, density)),
        }
    }
}

impl Shape3 {
    /// Mass, centre of mass and inertia for a density in kg/m^3.
    ///
    /// Exact up to rounding: to about 1e-15 for compact shapes, times length over thickness for thin ones; the prisms
    /// that a rounded hull has on merged faces are exact up to the [planarity error](crate::Hull::planarity_error).
    /// Points, segments and flat shapes without rounding have no volume, so their mass is zero. A compound is the sum
    /// of its parts: *where parts overlap, matter counts twice.* Cost: linear in the vertices and edges, n log n in the
    /// corners of each face; a few allocations.
    ///
    /// ```
    /// use asunder::{Cuboid, Shape3, glam::{DVec3, Vec3}};
    /// let brick = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 2.0, 3.0))?);
    /// let properties = brick.mass_properties(2.0)?;
    /// assert_eq!((properties.mass, properties.center), (96.0, DVec3::ZERO));
    /// assert_eq!(properties.inertia.z_axis, DVec3::Z * 96.0 * (2.0 * 2.0 + 4.0 * 4.0) / 12.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A density that is not finite or not positive; a half-space, and ground.
    pub fn mass_properties(&self, density: f32) -> Result<MassProperties3, MassError> {
        let density = check_density(density)?;
        match self {
            Self::HalfSpace(_) => Err(MassError::Unbounded),
            Self::TriMesh(_) | Self::HeightField(_) => Err(MassError::Ground),
            Self::Compound(compound) => {
                let parts = compound.parts().iter();
                let parts: Vec<MassProperties3> =
                    parts.map(|part| volume::of_convex(part.shape(), density).posed(part.pose())).collect();
                Ok(MassProperties3::combined(&parts))
            }
            _ => Ok(volume::of_convex(self, density)),
        }
    }
}

fn check_density(value: f32) -> Result<f64, MassError> {
    if value.is_finite() && value > 0.0 { Ok(f64::from(value)) } else { Err(MassError::Density { value }) }
}
