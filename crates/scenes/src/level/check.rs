//! From what JSON sees to what a world takes: every number checked, every fault with its path.

use super::error::{Fault, LevelError};
use super::raw::{self, Turn};
use super::{LevelBody, LevelLayers, LevelOf, MAX_RATE};
use asunder_geometry::tolerance::{MAX_HULL_VERTICES, MAX_POLYGON_VERTICES};
use asunder_geometry::{Cuboid, Hull, Polygon, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3};
use core::f64::consts::TAU;
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use std::collections::BTreeMap;

/// The last steps of a path below the body or shape, and what is wrong there.
type At = (String, Fault);

/// What differs between a scene in the plane and one in space.
pub(super) trait Dimension {
    type Shape: Clone;
    type Pose;
    type Vector: Copy + Default;
    type Spin: Default;

    fn vector(numbers: &[f64]) -> Result<Self::Vector, Fault>;
    fn length(vector: Self::Vector) -> f64;
    fn spin(turn: &Turn) -> Result<Self::Spin, Fault>;
    fn spin_rate(spin: &Self::Spin) -> f64;
    fn shape(shape: &raw::Shape) -> Result<Self::Shape, At>;
    fn pose(position: &[f64], rotation: Option<&Turn>) -> Result<Self::Pose, At>;
}

type Body<D> = LevelBody<
    <D as Dimension>::Shape,
    <D as Dimension>::Pose,
    <D as Dimension>::Vector,
    <D as Dimension>::Spin,
>;

pub(super) fn level<D: Dimension>(file: &raw::File) -> Result<LevelOf<D::Vector, Body<D>>, LevelError> {
    let gravity = rate::<D>(&file.gravity)
        .map_err(|fault| LevelError::Content { path: "gravity".to_owned(), fault })?;
    let mut shapes = BTreeMap::new();
    for (name, shape) in &file.shapes {
        let shape = D::shape(shape).map_err(|(step, fault)| LevelError::Content {
            path: format!("shapes[{name:?}]{step}"),
            fault,
        })?;
        shapes.insert(name.as_str(), shape);
    }
    let mut bodies = Vec::with_capacity(file.bodies.len());
    for (number, raw) in file.bodies.iter().enumerate() {
        let body = body::<D>(raw, &shapes).map_err(|(step, fault)| LevelError::Content {
            path: format!("bodies[{number}]{step}"),
            fault,
        })?;
        bodies.push(body);
    }
    Ok(LevelOf { name: file.name.clone(), gravity, bodies })
}

fn body<D: Dimension>(raw: &raw::Body, shapes: &BTreeMap<&str, D::Shape>) -> Result<Body<D>, At> {
    let Some(shape) = shapes.get(raw.shape.as_str()).cloned() else {
        return Err((".shape".to_owned(), Fault::UnknownShape { name: raw.shape.clone() }));
    };
    let pose = D::pose(&raw.position, raw.rotation.as_ref())?;
    let linear = match &raw.linear_velocity {
        Some(numbers) => rate::<D>(numbers).map_err(at(".linear_velocity"))?,
        None => D::Vector::default(),
    };
    let angular = match &raw.angular_velocity {
        Some(turn) => D::spin(turn).map_err(at(".angular_velocity"))?,
        None => D::Spin::default(),
    };
    let spin_rate = D::spin_rate(&angular);
    if spin_rate > MAX_RATE {
        return Err((".angular_velocity".to_owned(), Fault::TooFast { value: spin_rate }));
    }
    if raw.fixed && (D::length(linear) > 0.0 || spin_rate > 0.0) {
        return Err((".fixed".to_owned(), Fault::FixedMoves));
    }
    Ok(LevelBody {
        shape,
        pose,
        linear_velocity: linear,
        angular_velocity: angular,
        fixed: raw.fixed,
        sensor: raw.sensor,
        layers: raw.layers.as_ref().map(layers).transpose()?,
        user_data: raw.user_data,
    })
}

fn at(step: &str) -> impl Fn(Fault) -> At {
    move |fault| (step.to_owned(), fault)
}

fn rate<D: Dimension>(numbers: &[f64]) -> Result<D::Vector, Fault> {
    let vector = D::vector(numbers)?;
    let value = D::length(vector);
    if value > MAX_RATE { Err(Fault::TooFast { value }) } else { Ok(vector) }
}

fn layers(raw: &raw::Layers) -> Result<LevelLayers, At> {
    let bits = |numbers: &[u64], field: &str| {
        let mut set = 0_u32;
        for (i, &number) in numbers.iter().enumerate() {
            if number > 31 {
                return Err((format!(".layers.{field}[{i}]"), Fault::UnknownLayer { number }));
            }
            set |= 1 << number;
        }
        Ok(set)
    };
    Ok(LevelLayers {
        member_of: bits(&raw.member_of, "member_of")?,
        collides_with: bits(&raw.collides_with, "collides_with")?,
    })
}

/// The plane.
pub(super) struct Plane;

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
            raw::Shape::Rect { half_extents } => {
                let place = at(".rect.half_extents");
                let half_extents = narrow_all(half_extents).map_err(&place)?;
                Ok(Rect::from_half_extents(Vec2::from_array(half_extents))
                    .map_err(|error| place(error.into()))?
                    .into())
            }
            raw::Shape::Polygon { points } => {
                let outline: Vec<Vec2> = read_points(points, "polygon")?;
                Ok(Polygon::new(&outline).map_err(|error| at(".polygon")(error.into()))?.into())
            }
            raw::Shape::Regular { sides, radius } => {
                let place = at(".regular");
                check_sides(*sides, MAX_POLYGON_VERTICES).map_err(at(".regular.sides"))?;
                let radius = positive(*radius).map_err(at(".regular.radius"))?;
                let corners: Vec<Vec2> = circle(*sides).map(|c| (c * radius).as_vec2()).collect();
                // A hull, because rounding may bend a large circle's outline inwards.
                Ok(Polygon::hull_of(&corners).map_err(|error| place(error.into()))?.into())
            }
            raw::Shape::Cuboid { .. } => foreign("cuboid"),
            raw::Shape::Hull { .. } => foreign("hull"),
            raw::Shape::Prism { .. } => foreign("prism"),
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

/// Space.
pub(super) struct Volume;

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
            raw::Shape::Cuboid { half_extents } => {
                let place = at(".cuboid.half_extents");
                let half_extents = narrow_all(half_extents).map_err(&place)?;
                Ok(Cuboid::from_half_extents(Vec3::from_array(half_extents))
                    .map_err(|error| place(error.into()))?
                    .into())
            }
            raw::Shape::Hull { points } => {
                let points: Vec<Vec3> = read_points(points, "hull")?;
                Ok(Hull::from_points(&points).map_err(|error| at(".hull")(error.into()))?.into())
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
            raw::Shape::Rect { .. } => foreign("rect"),
            raw::Shape::Polygon { .. } => foreign("polygon"),
            raw::Shape::Regular { .. } => foreign("regular"),
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

fn list<'a>(turn: &'a Turn, expected: &'static str) -> Result<&'a [f64], Fault> {
    match turn {
        Turn::List(numbers) => Ok(numbers),
        Turn::Number(_) => Err(Fault::Form { expected }),
    }
}

fn exactly<const N: usize>(numbers: &[f64]) -> Result<[f64; N], Fault> {
    numbers.try_into().map_err(|_| Fault::Length { expected: N, found: numbers.len() })
}

fn narrow(value: f64) -> Result<f32, Fault> {
    let narrowed = value as f32;
    if narrowed.is_finite() { Ok(narrowed) } else { Err(Fault::TooLarge { value }) }
}

fn narrow_all<const N: usize>(numbers: &[f64]) -> Result<[f32; N], Fault> {
    let numbers: [f64; N] = exactly(numbers)?;
    let mut narrowed = [0.0; N];
    for (slot, value) in narrowed.iter_mut().zip(numbers) {
        *slot = narrow(value)?;
    }
    Ok(narrowed)
}

fn read_points<P: From<[f32; N]>, const N: usize>(points: &[Vec<f64>], kind: &str) -> Result<Vec<P>, At> {
    let read = |(i, point): (usize, &Vec<f64>)| {
        narrow_all(point).map(P::from).map_err(|fault| (format!(".{kind}.points[{i}]"), fault))
    };
    points.iter().enumerate().map(read).collect()
}

fn positive(value: f64) -> Result<f64, Fault> {
    let narrowed = narrow(value)?;
    if narrowed > 0.0 { Ok(value) } else { Err(Fault::NotPositive { value }) }
}

fn check_sides(found: u64, most: usize) -> Result<(), Fault> {
    let most = most as u64;
    if (3..=most).contains(&found) { Ok(()) } else { Err(Fault::Sides { most, found }) }
}

/// Corners of a regular polygon of radius 1, by `libm`: the same on every platform.
fn circle(sides: u64) -> impl Iterator<Item = DVec2> {
    (0..sides).map(move |i| {
        let angle = TAU * i as f64 / sides as f64;
        DVec2::new(libm::cos(angle), libm::sin(angle))
    })
}
