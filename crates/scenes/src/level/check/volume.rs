//! Shapes and poses of a scene in space.

use super::{
    At, Dimension, at, check_sides, circle, exactly, exactly_points, list, made, narrow, narrow_all,
    positive, read_points,
};
use crate::level::error::Fault;
use crate::level::raw::{self, Turn};
use asunder_geometry::tolerance::MAX_HULL_VERTICES;
use asunder_geometry::{
    Capsule3, Compound3, Cuboid, HalfSpace, Hull, Pose3, Segment3, Shape3, Sphere, Triangle3,
};
use glam::{DVec3, Quat, Vec3};

/// Space.
pub(in crate::level) struct Volume;

impl Dimension for Volume {
    type Shape = Shape3;
    type Pose = Pose3;
    type Vector = DVec3;
    type Spin = DVec3;

    fn vector(numbers: &[f64]) -> Result<DVec3, Fault> {
        exactly(numbers).map(DVec3::from_array)
    }

    fn length(vector: DVec3) -> f64 {
        vector.length()
    }

    fn spin(turn: &Turn) -> Result<DVec3, Fault> {
        Self::vector(list(turn, "a list of 3 numbers")?)
    }

    fn spin_rate(spin: &DVec3) -> f64 {
        spin.length()
    }

    fn shape(shape: &raw::Shape) -> Result<Shape3, At> {
        let foreign = |kind| Err((format!(".{kind}"), Fault::ForeignShape { kind, dimension: 2 }));
        match shape {
            raw::Shape::Cuboid { half_extents, radius } => {
                let half_extents = narrow_all(half_extents).map_err(at(".cuboid.half_extents"))?;
                let cuboid = Cuboid::from_half_extents(Vec3::from_array(half_extents));
                let cuboid = made(".cuboid.half_extents", cuboid)?;
                let radius = narrow(*radius).map_err(at(".cuboid.radius"))?;
                Ok(made(".cuboid.radius", cuboid.rounded(radius))?.into())
            }
            raw::Shape::Hull { points, radius } => {
                let points: Vec<Vec3> = read_points(points, "hull")?;
                let hull = made(".hull", Hull::from_points(&points))?;
                let radius = narrow(*radius).map_err(at(".hull.radius"))?;
                Ok(made(".hull.radius", hull.rounded(radius))?.into())
            }
            raw::Shape::Prism { sides, radius, half_height } => {
                check_sides(*sides, MAX_HULL_VERTICES / 2).map_err(at(".prism.sides"))?;
                let radius = positive(*radius).map_err(at(".prism.radius"))?;
                let height = positive(*half_height).map_err(at(".prism.half_height"))?;
                let corners: Vec<Vec3> = circle(*sides)
                    .flat_map(|c| {
                        [-height, height].map(|y| DVec3::new(c.x * radius, y, c.y * radius).as_vec3())
                    })
                    .collect();
                Ok(Hull::from_points(&corners).map_err(|error| at(".prism")(error.into()))?.into())
            }
            raw::Shape::Sphere { radius } => {
                Ok(made(".sphere", Sphere::new(narrow(*radius).map_err(at(".sphere"))?))?.into())
            }
            raw::Shape::Capsule { half_height, radius } => {
                let [half_height, radius] = narrow_all(&[*half_height, *radius]).map_err(at(".capsule"))?;
                Ok(made(".capsule", Capsule3::from_half_height(half_height, radius))?.into())
            }
            raw::Shape::Segment { points } => {
                let ends = read_points(points, "segment")?;
                let [from, to] = exactly_points(&ends).map_err(at(".segment.points"))?;
                Ok(made(".segment", Segment3::new(from, to))?.into())
            }
            raw::Shape::Triangle { points } => {
                let vertices = read_points(points, "triangle")?;
                let [a, b, c] = exactly_points(&vertices).map_err(at(".triangle.points"))?;
                Ok(made(".triangle", Triangle3::new(a, b, c))?.into())
            }
            raw::Shape::HalfSpace { normal } => {
                let normal = narrow_all(normal).map_err(at(".half_space.normal"))?;
                Ok(made(".half_space.normal", HalfSpace::new(Vec3::from_array(normal)))?.into())
            }
            raw::Shape::Compound { parts } => {
                Ok(made(".compound", Compound3::new(super::parts::<Self>(parts)?))?.into())
            }
            raw::Shape::Rect { .. } => foreign("rect"),
            raw::Shape::Polygon { .. } => foreign("polygon"),
            raw::Shape::Regular { .. } => foreign("regular"),
            raw::Shape::Circle { .. } => foreign("circle"),
            raw::Shape::HalfPlane { .. } => foreign("half_plane"),
            raw::Shape::Outline { .. } => foreign("outline"),
        }
    }

    fn pose(position: &[f64], rotation: Option<&Turn>) -> Result<Pose3, At> {
        let position = Self::vector(position).map_err(at(".position"))?;
        let rotation = match rotation {
            None => Quat::IDENTITY,
            Some(turn) => {
                let place = at(".rotation");
                let numbers = list(turn, "a list of 4 numbers: x, y, z, w").map_err(&place)?;
                let rotation = Quat::from_array(narrow_all(numbers).map_err(&place)?);
                // Checked on its own first, so that the path names the right field.
                Pose3::new(DVec3::ZERO, rotation).map_err(|error| place(error.into()))?;
                rotation
            }
        };
        Pose3::new(position, rotation).map_err(|error| at(".position")(error.into()))
    }
}
