//! Shapes and poses of a scene in the plane.

use super::{
    At, Dimension, at, check_sides, circle, exactly, exactly_points, made, narrow, narrow_all, positive,
    read_points,
};
use crate::level::error::Fault;
use crate::level::raw::{self, Turn};
use asunder_geometry::tolerance::MAX_POLYGON_VERTICES;
use asunder_geometry::{
    Capsule2, Circle, Compound2, HalfPlane, Polygon, Pose2, Rect, Rotation2, Segment2, Shape2, decompose,
};
use glam::{DVec2, Vec2};

/// The plane.
pub(in crate::level) struct Plane;

impl Dimension for Plane {
    type Shape = Shape2;
    type Pose = Pose2;
    type Vector = DVec2;
    type Spin = f64;

    fn vector(numbers: &[f64]) -> Result<DVec2, Fault> {
        exactly(numbers).map(DVec2::from_array)
    }

    fn length(vector: DVec2) -> f64 {
        vector.length()
    }

    fn spin(turn: &Turn) -> Result<f64, Fault> {
        match turn {
            Turn::Number(number) => Ok(*number),
            Turn::List(_) => Err(Fault::Form { expected: "one number" }),
        }
    }

    fn spin_rate(spin: &f64) -> f64 {
        spin.abs()
    }

    fn shape(shape: &raw::Shape) -> Result<Shape2, At> {
        let foreign = |kind| Err((format!(".{kind}"), Fault::ForeignShape { kind, dimension: 3 }));
        match shape {
            raw::Shape::Rect { half_extents, radius } => {
                let half_extents = narrow_all(half_extents).map_err(at(".rect.half_extents"))?;
                let rect = Rect::from_half_extents(Vec2::from_array(half_extents));
                let rect = made(".rect.half_extents", rect)?;
                Ok(made(".rect.radius", rect.rounded(narrow(*radius).map_err(at(".rect.radius"))?))?.into())
            }
            raw::Shape::Polygon { points, radius } => {
                let outline: Vec<Vec2> = read_points(points, "polygon")?;
                let polygon = made(".polygon", Polygon::new(&outline))?;
                let radius = narrow(*radius).map_err(at(".polygon.radius"))?;
                Ok(made(".polygon.radius", polygon.rounded(radius))?.into())
            }
            raw::Shape::Regular { sides, radius } => {
                check_sides(*sides, MAX_POLYGON_VERTICES).map_err(at(".regular.sides"))?;
                let radius = positive(*radius).map_err(at(".regular.radius"))?;
                let corners: Vec<Vec2> = circle(*sides).map(|c| (c * radius).as_vec2()).collect();
                // A hull, because rounding may make a large circle's outline concave.
                Ok(made(".regular", Polygon::hull_of(&corners))?.into())
            }
            raw::Shape::Circle { radius } => {
                Ok(made(".circle", Circle::new(narrow(*radius).map_err(at(".circle"))?))?.into())
            }
            raw::Shape::Capsule { half_height, radius } => {
                let [half_height, radius] = narrow_all(&[*half_height, *radius]).map_err(at(".capsule"))?;
                Ok(made(".capsule", Capsule2::from_half_height(half_height, radius))?.into())
            }
            raw::Shape::Segment { points } => {
                let ends = read_points(points, "segment")?;
                let [from, to] = exactly_points(&ends).map_err(at(".segment.points"))?;
                Ok(made(".segment", Segment2::new(from, to))?.into())
            }
            raw::Shape::HalfPlane { normal } => {
                let normal = narrow_all(normal).map_err(at(".half_plane.normal"))?;
                Ok(made(".half_plane.normal", HalfPlane::new(Vec2::from_array(normal)))?.into())
            }
            raw::Shape::Outline { points } => {
                let outline: Vec<Vec2> = read_points(points, "outline")?;
                Ok(made(".outline", decompose(&outline))?.into())
            }
            raw::Shape::Compound { parts } => {
                Ok(made(".compound", Compound2::new(super::parts::<Self>(parts)?))?.into())
            }
            raw::Shape::Sphere { .. } => foreign("sphere"),
            raw::Shape::Cuboid { .. } => foreign("cuboid"),
            raw::Shape::Hull { .. } => foreign("hull"),
            raw::Shape::Prism { .. } => foreign("prism"),
            raw::Shape::Triangle { .. } => foreign("triangle"),
            raw::Shape::HalfSpace { .. } => foreign("half_space"),
        }
    }

    fn pose(position: &[f64], rotation: Option<&Turn>) -> Result<Pose2, At> {
        let position = Self::vector(position).map_err(at(".position"))?;
        let rotation = match rotation {
            None => Rotation2::IDENTITY,
            Some(turn) => {
                let place = at(".rotation");
                let angle = Self::spin(turn).and_then(narrow).map_err(&place)?;
                Rotation2::from_angle(angle).map_err(|error| place(error.into()))?
            }
        };
        Pose2::new(position, rotation).map_err(|error| at(".position")(error.into()))
    }
}
