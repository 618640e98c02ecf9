//! Shapes in space; where a constructor rejects one, a plain shape takes its place.

use crate::pairs;
use crate::random::Random;
use asunder_geometry::{Capsule3, Cuboid, Hull, Segment3, Shape3, Sphere, Triangle3};
use core::f64::consts::TAU;
use glam::{DVec3, Vec3};

/// The shape that replaces a rejected one.
pub(super) fn plain() -> Shape3 {
    pairs::cuboid(Vec3::splat(0.5))
}

pub(super) fn cuboid(half_extents: DVec3) -> Shape3 {
    Cuboid::from_half_extents(half_extents.as_vec3()).map_or_else(|_| plain(), Shape3::from)
}

pub(super) fn hull(points: &[Vec3]) -> Shape3 {
    Hull::from_points(points).map_or_else(|_| plain(), Shape3::from)
}

/// The hull of points, which may lie in a plane.
pub(super) fn any_hull(points: &[Vec3]) -> Shape3 {
    Hull::of_any_dimension(points).map_or_else(|_| plain(), Shape3::from)
}

pub(super) fn sphere(radius: f64) -> Shape3 {
    Sphere::new(radius as f32).map_or_else(|_| plain(), Shape3::from)
}

pub(super) fn capsule(from: DVec3, to: DVec3, radius: f64) -> Shape3 {
    Capsule3::new(from.as_vec3(), to.as_vec3(), radius as f32).map_or_else(|_| plain(), Shape3::from)
}

pub(super) fn segment(from: DVec3, to: DVec3) -> Shape3 {
    Segment3::new(from.as_vec3(), to.as_vec3()).map_or_else(|_| plain(), Shape3::from)
}

pub(super) fn triangle(corners: [DVec3; 3]) -> Shape3 {
    let [a, b, c] = corners.map(|corner| corner.as_vec3());
    Triangle3::new(a, b, c).map_or_else(|_| plain(), Shape3::from)
}

/// The same shape, rounded: grown by a radius. A shape that cannot be rounded stays as it is.
pub(super) fn rounded(shape: Shape3, radius: f64) -> Shape3 {
    let grown = match &shape {
        Shape3::Cuboid(cuboid) => cuboid.rounded(radius as f32).ok().map(Shape3::from),
        Shape3::Hull(hull) => hull.clone().rounded(radius as f32).ok().map(Shape3::from),
        _ => None,
    };
    grown.unwrap_or(shape)
}

/// A brick about `width` metres wide.
pub(super) fn brick(width: f64, random: &mut Random) -> Shape3 {
    cuboid(random.within(DVec3::splat(0.3), DVec3::splat(0.6)) * width)
}

/// An upright prism over a regular polygon.
pub(super) fn prism(sides: usize, radius: f64, half_height: f64) -> Shape3 {
    let corner = |i: usize| {
        let angle = TAU * i as f64 / sides as f64;
        [-half_height, half_height]
            .map(|y| DVec3::new(radius * libm::cos(angle), y, radius * libm::sin(angle)).as_vec3())
    };
    let points: Vec<Vec3> = (0..sides).flat_map(corner).collect();
    hull(&points)
}

/// The hull of so many random points on an ellipsoid about `width` metres wide.
pub(super) fn pebble(count: usize, width: f64, random: &mut Random) -> Shape3 {
    let radii = random.within(DVec3::splat(0.4), DVec3::splat(0.6)) * width;
    let points: Vec<Vec3> = (0..count.max(4)).map(|_| (random.direction() * radii).as_vec3()).collect();
    hull(&points)
}

/// A polyhedron about `width` metres wide: box, prism, wedge or hull.
pub(super) fn solid(width: f64, random: &mut Random) -> Shape3 {
    match random.below(5) {
        0 => brick(width, random),
        1 => prism(3 + random.below(10), random.range(0.3, 0.6) * width, random.range(0.3, 0.6) * width),
        2 => wedge(width, random),
        _ => {
            let count = [4, 6, 8, 16, 32][random.below(5)];
            pebble(count, width, random)
        }
    }
}

/// A right prism over a right triangle.
fn wedge(width: f64, random: &mut Random) -> Shape3 {
    let half = random.within(DVec3::splat(0.3), DVec3::splat(0.6)) * width;
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)];
    let ends = |(x, y): (f64, f64)| [-1.0, 1.0].map(|z| (half * DVec3::new(x, y, z)).as_vec3());
    let points: Vec<Vec3> = corners.into_iter().flat_map(ends).collect();
    hull(&points)
}

/// Any bounded convex shape about `width` metres wide, round ones and flat ones included.
pub(super) fn anything(width: f64, random: &mut Random) -> Shape3 {
    let mut point = || random.within(DVec3::splat(-0.5), DVec3::splat(0.5)) * width;
    let corners = [point(), point(), point()];
    match random.below(10) {
        0 => sphere(random.range(0.2, 0.6) * width),
        1 => capsule(corners[0], corners[1], random.range(0.1, 0.4) * width),
        2 => segment(corners[0], corners[1]),
        3 => triangle(corners),
        4 => {
            let solid = solid(width, random);
            rounded(solid, random.range(0.01, 0.3) * width)
        }
        _ => solid(width, random),
    }
}
