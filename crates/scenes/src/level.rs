//! Scene files: whole game levels in JSON, in the plane or in space.
//!
//! ```
//! use asunder_scenes::level::Level;
//! let json = r#"{
//!     "name": "one crate above a floor",
//!     "dimension": 3,
//!     "gravity": [0, -9.81, 0],
//!     "shapes": {
//!         "floor": { "cuboid": { "half_extents": [20, 0.5, 20] } },
//!         "crate": { "cuboid": { "half_extents": [0.5, 0.5, 0.5] } }
//!     },
//!     "bodies": [
//!         { "shape": "floor", "position": [0, -0.5, 0], "fixed": true },
//!         { "shape": "crate", "position": [0, 3, 0], "rotation": [0, 0.38, 0, 0.92], "user_data": 7 }
//!     ]
//! }"#;
//! let Level::Volume(level) = Level::from_json(json)? else { panic!("dimension is 3") };
//! assert_eq!((level.bodies.len(), level.bodies[1].user_data), (2, 7));
//!
//! let fault = Level::from_json(&json.replace("[0, 0.38, 0, 0.92]", "[0, 0, 0, 0]")).unwrap_err();
//! assert_eq!(
//!     fault.to_string(),
//!     "bodies[1].rotation: the rotation is zero: use the identity for no rotation"
//! );
//! # Ok::<(), asunder_scenes::level::LevelError>(())
//! ```
//!
//! # The format
//!
//! Units are SI, axes right-handed, and a vector has as many numbers as the scene has dimensions. A field that is not
//! named here is rejected, and so is one that occurs twice.
//!
//! | field of the file | value |
//! |---|---|
//! | `name` | text, optional |
//! | `dimension` | `2` or `3` |
//! | `gravity` | vector, m/s², at most [`MAX_RATE`] long |
//! | `shapes` | an object: a name for each shape |
//! | `bodies` | a list |
//!
//! | shape | dimension | value |
//! |---|---|---|
//! | `rect`, `cuboid` | 2, 3 | `half_extents`: vector; `radius` of rounding, optional |
//! | `polygon` | 2 | `points`: the outline, convex and counter-clockwise; `radius` of rounding, optional |
//! | `regular` | 2 | `sides`: 3 to 4096, `radius`: of the circle through the corners |
//! | `outline` | 2 | `points`: any outline that does not cross itself; it is cut into convex parts |
//! | `hull` | 3 | `points`: any, the shape is their convex hull; `radius` of rounding, optional |
//! | `prism` | 3 | `sides`: 3 to 128, `radius`, `half_height`: along y |
//! | `circle`, `sphere` | 2, 3 | `radius` |
//! | `capsule` | 2, 3 | `half_height` of its segment, along y; `radius` |
//! | `segment` | 2, 3 | `points`: its two ends |
//! | `triangle` | 3 | `points`: its three vertices |
//! | `half_plane`, `half_space` | 2, 3 | `normal`: out of it, of any length |
//! | `compound` | 2, 3 | `parts`: a list of `shape` (as here, but one convex piece: no `outline`, no `compound`), `position`, and `rotation`, which is optional |
//!
//! | field of a body | value | where it is left out |
//! |---|---|---|
//! | `shape` | name of a shape | an error |
//! | `position` | vector, m | an error |
//! | `rotation` | 2D: angle in radians, counter-clockwise; 3D: quaternion x, y, z, w of any length but zero | none |
//! | `linear_velocity` | vector, m/s, at most [`MAX_RATE`] long | zero |
//! | `angular_velocity` | 2D: number; 3D: vector; rad/s, at most [`MAX_RATE`] | zero |
//! | `fixed` | `true` for scenery, which no contact moves and which has no velocity | `false` |
//! | `sensor` | `true` for a body that reports touching and pushes nothing | `false` |
//! | `layers` | `member_of` and `collides_with`: lists of layer numbers, 0 to 31 | all |
//! | `user_data` | whole number, 0 to 2^64 - 1 | 0 |

mod check;
mod error;
mod raw;
#[cfg(test)]
mod tests;

pub use error::{Fault, LevelError};

use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use glam::{DVec2, DVec3};

/// The greatest length of a gravity or velocity in a scene file, in SI units.
///
/// At 1000 m/s a body crosses sixteen metres in a sixtieth of a second: more is taken for a mistake.
pub const MAX_RATE: f64 = 1000.0;

/// A level of either dimension.
#[derive(Clone, Debug, PartialEq)]
pub enum Level {
    /// A level in the plane.
    Plane(Level2),
    /// A level in space.
    Volume(Level3),
}

/// A level in the plane.
pub type Level2 = LevelOf<DVec2, LevelBody2>;

/// A level in space.
pub type Level3 = LevelOf<DVec3, LevelBody3>;

/// A body of a level in the plane; its angular velocity is in rad/s, counter-clockwise.
pub type LevelBody2 = LevelBody<Shape2, Pose2, DVec2, f64>;

/// A body of a level in space; its angular velocity is about the world's axes.
pub type LevelBody3 = LevelBody<Shape3, Pose3, DVec3, DVec3>;

/// A level of either dimension, used as [`Level2`] and [`Level3`].
#[derive(Clone, Debug, PartialEq)]
pub struct LevelOf<Vector, Body> {
    /// The name in the file; empty where there is none.
    pub name: String,
    /// In m/s².
    pub gravity: Vector,
    /// In the order of the file.
    pub bodies: Vec<Body>,
}

/// A body of a level, used as [`LevelBody2`] and [`LevelBody3`].
#[derive(Clone, Debug, PartialEq)]
pub struct LevelBody<Shape, Pose, Vector, Spin> {
    /// Bodies that name the same shape share its data.
    pub shape: Shape,
    /// Where it starts.
    pub pose: Pose,
    /// In m/s.
    pub linear_velocity: Vector,
    /// In rad/s.
    pub angular_velocity: Spin,
    /// Scenery: no contact moves it.
    pub fixed: bool,
    /// Reports touching and pushes nothing.
    pub sensor: bool,
    /// `None` where the file does not give them.
    pub layers: Option<LevelLayers>,
    /// A number for the game's own use.
    pub user_data: u64,
}

/// The layers of a body, as two sets of bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelLayers {
    /// The layers it is in.
    pub member_of: u32,
    /// The layers it touches.
    pub collides_with: u32,
}

impl Level {
    /// Reads a scene file. The format is described at the head of [this module](self).
    ///
    /// # Errors
    /// Text that is not JSON, or a field that is unknown, missing or of the wrong type, with its line and column; or
    /// content that makes no sense, with its path in the file. Only the first fault is reported.
    pub fn from_json(json: impl AsRef<[u8]>) -> Result<Self, LevelError> {
        let file: raw::File = serde_json::from_slice(json.as_ref()).map_err(LevelError::Json)?;
        match file.dimension {
            2 => check::level::<check::Plane>(&file).map(Self::Plane),
            3 => check::level::<check::Volume>(&file).map(Self::Volume),
            found => {
                Err(LevelError::Content { path: "dimension".to_owned(), fault: Fault::Dimension { found } })
            }
        }
    }
}
