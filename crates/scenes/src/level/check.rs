//! Converts a parsed scene file into a level: every number is checked, and every fault has its path.

use super::error::{Fault, LevelError};
use super::raw::{self, Turn};
use super::{LevelBody, LevelLayers, LevelOf, MAX_RATE};
use core::f64::consts::TAU;
use glam::DVec2;
use std::collections::BTreeMap;

mod plane;
mod volume;

pub(super) use plane::Plane;
pub(super) use volume::Volume;

/// The end of a path, below the body or shape, and what is wrong there.
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

/// The points as an array, if there are exactly `N`.
fn exactly_points<P: Copy, const N: usize>(points: &[P]) -> Result<[P; N], Fault> {
    points.try_into().map_err(|_| Fault::Points { expected: N, found: points.len() })
}

fn positive(value: f64) -> Result<f64, Fault> {
    let narrowed = narrow(value)?;
    if narrowed > 0.0 { Ok(value) } else { Err(Fault::NotPositive { value }) }
}

fn check_sides(found: u64, most: usize) -> Result<(), Fault> {
    let most = most as u64;
    if (3..=most).contains(&found) { Ok(()) } else { Err(Fault::Sides { most, found }) }
}

/// Corners of a regular polygon of radius 1. By `libm`, so that they are the same on every platform.
fn circle(sides: u64) -> impl Iterator<Item = DVec2> {
    (0..sides).map(move |i| {
        let angle = TAU * i as f64 / sides as f64;
        DVec2::new(libm::cos(angle), libm::sin(angle))
    })
}

/// The result of a shape's constructor, its error with the place of the shape.
fn made<T, E: Into<Fault>>(step: &str, result: Result<T, E>) -> Result<T, At> {
    result.map_err(|error| at(step)(error.into()))
}

/// A shape and its pose.
type Posed<D> = (<D as Dimension>::Pose, <D as Dimension>::Shape);

/// The parts of a compound.
fn parts<D: Dimension>(raw: &[raw::Part]) -> Result<Vec<Posed<D>>, At> {
    let part = |(i, part): (usize, &raw::Part)| {
        let within = |(step, fault): At| (format!(".compound.parts[{i}]{step}"), fault);
        let pose = D::pose(&part.position, part.rotation.as_ref()).map_err(within)?;
        Ok((pose, D::shape(&part.shape).map_err(|(step, fault)| within((format!(".shape{step}"), fault)))?))
    };
    raw.iter().enumerate().map(part).collect()
}
