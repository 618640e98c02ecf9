//! Mass properties, as a solver needs them.

use super::second::Second;
use crate::basis3::Basis3;
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use glam::{DMat3, DVec2, DVec3};

/// Mass, centre of mass and inertia of a shape in the plane, from
/// [`Shape2::mass_properties`](crate::Shape2::mass_properties).
///
/// ```
/// use asunder::{Circle, MassProperties2, Pose2, Shape2, glam::DVec2};
/// let disc = Shape2::from(Circle::new(1.0)?).mass_properties(2.0)?;
/// assert!((disc.inertia - disc.mass / 2.0).abs() < 1e-15);
/// // Two discs on a rod without mass, as one body.
/// let pair = [DVec2::X * 3.0, DVec2::X * -3.0].map(|at| Pose2::at(at).map(|pose| disc.posed(&pose)));
/// let pair = MassProperties2::combined(&[pair[0]?, pair[1]?]);
/// assert_eq!((pair.mass, pair.center), (2.0 * disc.mass, DVec2::ZERO));
/// assert!((pair.inertia - 2.0 * disc.inertia_about(DVec2::X * 3.0)).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassProperties2 {
    /// Mass, in kg: never negative.
    pub mass: f64,
    /// Centre of mass, in the shape's axes, in metres. The centroid, for a shape without area.
    pub center: DVec2,
    /// Moment of inertia about the centre of mass, in kg m^2: never negative.
    pub inertia: f64,
}

/// Mass, centre of mass and inertia of a shape in space, from
/// [`Shape3::mass_properties`](crate::Shape3::mass_properties).
///
/// The tensor is the full symmetric one, as a plain `DMat3`: the inertia in world axes is R I R^T, as
/// [`MassProperties3::posed`] gives it, and its inverse is one call. It is not given as principal axes, which would
/// flip between equal ones from one shape to the next.
///
/// ```
/// use asunder::{Cuboid, MassProperties3, Pose3, Shape3, Sphere, glam::{DVec3, Quat, Vec3}};
/// let handle = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.02, 0.3, 0.02))?).mass_properties(700.0)?;
/// let head = Shape3::from(Sphere::new(0.06)?).mass_properties(7800.0)?;
/// let hammer = MassProperties3::combined(&[handle, head.posed(&Pose3::at([0.0, 0.3, 0.0])?)]);
/// assert!((hammer.mass - handle.mass - head.mass).abs() < 1e-12);
/// assert!(hammer.center.y > 0.27 && hammer.center.x == 0.0);
///
/// // Lying on its side, it is as hard to turn about x as it was about y.
/// let lying = hammer.posed(&Pose3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 1.0))?);
/// assert!((lying.inertia.x_axis.x - hammer.inertia.y_axis.y).abs() < 1e-15);
/// // About the grip it is harder still.
/// assert!(hammer.inertia_about(DVec3::ZERO).x_axis.x > hammer.inertia.x_axis.x);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties3 {
    /// Mass, in kg: never negative.
    pub mass: f64,
    /// Centre of mass, in the shape's axes, in metres. The centroid, for a shape without volume.
    pub center: DVec3,
    /// Inertia tensor about the centre of mass, in the shape's axes, in kg m^2: symmetric; up to rounding no
    /// principal moment is negative, or larger than the sum of the other two.
    pub inertia: DMat3,
}

impl MassProperties2 {
    /// The same mass, posed, for example as a part of a compound.
    ///
    /// A stored rotation means its matrix, which scales by the length of the stored pair: that is one up to the
    /// rounding of f32, and is taken into account as everywhere.
    pub fn posed(&self, pose: &Pose2) -> Self {
        let (c, s) = (f64::from(pose.rotation().cos()), f64::from(pose.rotation().sin()));
        let stretch = c * c + s * s;
        Self {
            mass: self.mass * stretch,
            center: pose.transform(self.center),
            inertia: self.inertia * (stretch * stretch),
        }
    }

    /// Moment of inertia about any point of the plane, in kg m^2, by the parallel axis theorem.
    pub fn inertia_about(&self, point: impl Into<DVec2>) -> f64 {
        self.inertia + self.mass * (self.center - point.into()).length_squared()
    }

    /// Combines several parts to one rigid body. They must be given in the same axes: see [`MassProperties2::posed`].
    /// Without parts the mass is zero; if no part has mass, the centre is the mean of theirs.
    pub fn combined(parts: &[Self]) -> Self {
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        let Some(first) = parts.first() else { return Self::default() };
        // Relative to the first centre: a mean of positions far from the origin would lose their differences.
        let offset = |part: &Self| (part.center - first.center) * share(part.mass, mass, parts.len());
        let center = first.center + parts.iter().map(offset).fold(DVec2::ZERO, |sum, each| sum + each);
        let inertia = parts.iter().map(|part| part.inertia_about(center)).sum();
        Self { mass, center, inertia }
    }
}

impl MassProperties3 {
    /// The same mass, posed: in the world, or as a part of a compound. Exact up to rounding for any quaternion.
    pub fn posed(&self, pose: &Pose3) -> Self {
        let inertia = turned(&self.inertia, &pose.basis());
        Self { mass: self.mass, center: pose.transform(self.center), inertia }
    }

    /// Inertia tensor about any point, in kg m^2, by the parallel axis theorem.
    pub fn inertia_about(&self, point: impl Into<DVec3>) -> DMat3 {
        let shift = (Second::of(self.center - point.into()) * self.mass).inertia();
        sum(&self.inertia, &shift)
    }

    /// Combines several parts to one rigid body. They must be given in the same axes: see [`MassProperties3::posed`].
    /// Without parts the mass is zero; if no part has mass, the centre is the mean of theirs.
    pub fn combined(parts: &[Self]) -> Self {
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        let Some(first) = parts.first() else { return Self::default() };
        let offset = |part: &Self| (part.center - first.center) * share(part.mass, mass, parts.len());
        let center = first.center + parts.iter().map(offset).fold(DVec3::ZERO, |sum, each| sum + each);
        let inertia = parts.iter().fold(DMat3::ZERO, |known, part| sum(&known, &part.inertia_about(center)));
        Self { mass, center, inertia }
    }
}

impl Default for MassProperties3 {
    /// No mass. (A derived default would have the unit tensor.)
    fn default() -> Self {
        Self { mass: 0.0, center: DVec3::ZERO, inertia: DMat3::ZERO }
    }
}

/// A part's weight in the common centre.
fn share(mass: f64, total: f64, count: usize) -> f64 {
    if total > 0.0 { mass / total } else { 1.0 / count as f64 }
}

/// R I R^T, symmetric in every bit. Products are written out, for the reason given at [`Basis3`].
fn turned(inertia: &DMat3, basis: &Basis3) -> DMat3 {
    // Column k of R I, then the sum over k of (that column) times (column k of R)^T.
    let half = [inertia.x_axis, inertia.y_axis, inertia.z_axis].map(|column| basis.turn(column));
    let axes = [basis.x, basis.y, basis.z];
    let entry = |row: usize, column: usize| {
        half[0][row] * axes[0][column] + half[1][row] * axes[1][column] + half[2][row] * axes[2][column]
    };
    let (yz, zx, xy) = (entry(1, 2), entry(2, 0), entry(0, 1));
    DMat3::from_cols(
        DVec3::new(entry(0, 0), xy, zx),
        DVec3::new(xy, entry(1, 1), yz),
        DVec3::new(zx, yz, entry(2, 2)),
    )
}

fn sum(a: &DMat3, b: &DMat3) -> DMat3 {
    DMat3::from_cols(a.x_axis + b.x_axis, a.y_axis + b.y_axis, a.z_axis + b.z_axis)
}
