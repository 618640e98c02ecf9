//! One of each shape, about a metre across, and its name.

use asunder::glam::{Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Circle, Compound2, Compound3, Cuboid, HalfPlane, HalfSpace, HeightField, Hull,
    Polygon, Pose2, Pose3, Rect, Segment2, Segment3, Shape2, Shape3, Sphere, TriMesh, Triangle3,
};
use std::error::Error;

/// A shape, and its name in pictures and tables.
pub(crate) struct Kind<S> {
    pub name: &'static str,
    pub shape: S,
}

type Kinds<S> = Result<Vec<Kind<S>>, Box<dyn Error>>;

/// Shapes in space: those that are good to lie on come first.
pub(crate) fn solids() -> Kinds<Shape3> {
    Ok(vec![
        kind("half-space", HalfSpace::new(Vec3::Y)?),
        kind("compound", arch3()?),
        kind("cuboid", Cuboid::from_half_extents(Vec3::new(0.42, 0.24, 0.34))?),
        kind("rounded cuboid", Cuboid::from_half_extents(Vec3::new(0.31, 0.14, 0.23))?.rounded(0.11)?),
        kind("hull", gem(1.0)?),
        kind("rounded hull", gem(0.74)?.rounded(0.11)?),
        kind("capsule", Capsule3::new(Vec3::X * -0.30, Vec3::X * 0.30, 0.20)?),
        kind("sphere", Sphere::new(0.36)?),
        kind("triangle", triangle()?),
        kind("segment", Segment3::new(Vec3::X * -0.5, Vec3::X * 0.5)?),
    ])
}

/// Shapes in the plane, in the same order.
pub(crate) fn flats() -> Kinds<Shape2> {
    Ok(vec![
        kind("half-plane", HalfPlane::new(Vec2::Y)?),
        kind("compound", arch2()?),
        kind("rect", Rect::from_half_extents(Vec2::new(0.46, 0.28))?),
        kind("rounded rect", Rect::from_half_extents(Vec2::new(0.34, 0.16))?.rounded(0.13)?),
        kind("polygon", pentagon(1.0)?),
        kind("rounded polygon", pentagon(0.70)?.rounded(0.13)?),
        kind("capsule", Capsule2::new(Vec2::X * -0.32, Vec2::X * 0.32, 0.21)?),
        kind("circle", Circle::new(0.38)?),
        kind("segment", Segment2::new(Vec2::X * -0.5, Vec2::X * 0.5)?),
    ])
}

fn kind<S>(name: &'static str, shape: impl Into<S>) -> Kind<S> {
    Kind { name, shape: shape.into() }
}

/// A frustum over a hexagon: it has flat faces to lie on, and edges along z to stand on.
pub(crate) fn gem(size: f32) -> Result<Hull, Box<dyn Error>> {
    let hexagon = |radius: f32, height: f32| {
        let (far, near) = (0.866_025_4 * radius, 0.5 * radius);
        [(far, near), (0.0, radius), (-far, near), (-far, -near), (0.0, -radius), (far, -near)]
            .map(|(x, z)| Vec3::new(x, height, z) * size)
    };
    Ok(Hull::from_points(&[hexagon(0.52, -0.24), hexagon(0.32, 0.28)].concat())?)
}

/// A triangle that lies flat, with one edge along z.
pub(crate) fn triangle() -> Result<Triangle3, Box<dyn Error>> {
    Ok(Triangle3::new(Vec3::new(0.42, 0.0, 0.46), Vec3::new(0.42, 0.0, -0.46), Vec3::new(-0.52, 0.0, 0.0))?)
}

/// A landing, three steps and a floor.
pub(crate) fn stairs() -> Result<TriMesh, Box<dyn Error>> {
    let profile = [
        (-0.65, 0.15),
        (-0.2, 0.15),
        (-0.2, 0.0),
        (0.0, 0.0),
        (0.0, -0.15),
        (0.2, -0.15),
        (0.2, -0.3),
        (0.65, -0.3),
    ];
    let across = [-0.4, -0.2, 0.0, 0.2, 0.4];
    let vertices: Vec<Vec3> = profile.iter().flat_map(|&(x, y)| across.map(|z| Vec3::new(x, y, z))).collect();
    let square = |first: u32| [[0, 1, 5], [5, 1, 6]].map(|corners| corners.map(|vertex| vertex + first));
    let squares = (0..7).flat_map(|step| (0..4).map(move |place| 5 * step + place));
    Ok(TriMesh::new(vertices, squares.flat_map(square).collect::<Vec<_>>())?)
}

/// Two hills, and a hole between them.
pub(crate) fn hills() -> Result<HeightField, Box<dyn Error>> {
    let height = |place: usize| {
        let (x, z) = ((place % 8) as f64, (place / 8) as f64);
        let hill = |at: [f64; 2]| libm::exp(-0.4 * ((x - at[0]) * (x - at[0]) + (z - at[1]) * (z - at[1])));
        (0.32 * hill([2.0, 2.0]) + 0.16 * hill([5.0, 4.0])) as f32
    };
    let heights: Vec<f32> = (0..56).map(height).collect();
    Ok(HeightField::new(8, 7, heights, Vec2::new(0.17, 0.15))?.with_holes([(5, 1)])?)
}

/// Two posts on a beam: not convex, so it may touch in several places with several normals.
pub(crate) fn arch3() -> Result<Compound3, Box<dyn Error>> {
    let beam = Cuboid::from_half_extents(Vec3::new(0.58, 0.10, 0.24))?;
    let post = Cuboid::from_half_extents(Vec3::new(0.11, 0.155, 0.24))?;
    let round = Capsule3::new(Vec3::Z * -0.12, Vec3::Z * 0.12, 0.14)?;
    Ok(Compound3::new([
        (Pose3::at([0.0, -0.20, 0.0])?, beam.into()),
        (Pose3::at([-0.47, 0.03, 0.0])?, post.into()),
        (Pose3::at([0.44, 0.045, 0.0])?, round.into()),
    ])?)
}

/// The same in the plane.
pub(crate) fn arch2() -> Result<Compound2, Box<dyn Error>> {
    let beam = Rect::from_half_extents(Vec2::new(0.58, 0.10))?;
    let post = Rect::from_half_extents(Vec2::new(0.11, 0.16))?;
    Ok(Compound2::new([
        (Pose2::at([0.0, -0.20])?, beam.into()),
        (Pose2::at([-0.47, 0.03])?, post.into()),
        (Pose2::at([0.43, 0.04])?, Circle::new(0.15)?.into()),
    ])?)
}

pub(crate) fn pentagon(size: f32) -> Result<Polygon, Box<dyn Error>> {
    let outline = [(-0.34, -0.32), (0.34, -0.32), (0.50, 0.08), (0.06, 0.40), (-0.46, 0.16)];
    Ok(Polygon::new(&outline.map(|(x, y)| Vec2::new(x, y) * size))?)
}
