//! The shapes that sets and worlds draw from.

use super::{PlaneKind, SolidKind};
use crate::random::Random;
use asunder_geometry::{Cuboid, Hull, Polygon, Rect, Shape2, Shape3};
use core::f64::consts::TAU;
use glam::{DVec3, Vec2, Vec3};

const IN_RANGE: &str = "a scene's shapes are in range by construction";

/// Different solids of one family, about 1 m wide, around their origins. Cost: that of building hulls.
///
/// ```
/// use asunder_geometry::Shape3;
/// use asunder_scenes::pairs::{SolidKind, solids};
/// let Shape3::Hull(hull) = &solids(SolidKind::Hull32, 2, 1)[1] else { unreachable!() };
/// assert_eq!(hull.vertices().len(), 32);
/// ```
pub fn solids(kind: SolidKind, count: usize, seed: u64) -> Vec<Shape3> {
    let mut random = Random::new(seed ^ 0x5011d);
    let mut one = |i: usize| match kind {
        SolidKind::Box => cuboid(random.within(DVec3::splat(0.3), DVec3::splat(0.6)).as_vec3()),
        SolidKind::Authored if i.is_multiple_of(2) => wedge(&mut random),
        SolidKind::Authored => cylinder(&mut random),
        SolidKind::Hull8 => ellipsoid(8, &mut random),
        SolidKind::Hull16 => ellipsoid(16, &mut random),
        SolidKind::Hull32 => ellipsoid(32, &mut random),
        SolidKind::Hull128 => ellipsoid(128, &mut random),
        SolidKind::Hull64 => ellipsoid(64, &mut random),
        SolidKind::Hull256 => ellipsoid(256, &mut random),
        SolidKind::Prism256 => prism(128, random.range(0.3, 0.6), random.range(0.3, 0.6)),
        SolidKind::Globe256 => globe(16, 16, random.range(0.4, 0.6)),
    };
    (0..count).map(&mut one).collect()
}

/// Different shapes of one family in the plane, about 1 m wide, around their origins.
///
/// ```
/// use asunder_geometry::Shape2;
/// use asunder_scenes::pairs::{PlaneKind, polygons};
/// let Shape2::Polygon(polygon) = &polygons(PlaneKind::Poly64, 1, 1)[0] else { unreachable!() };
/// assert_eq!(polygon.vertices().len(), 64);
/// ```
pub fn polygons(kind: PlaneKind, count: usize, seed: u64) -> Vec<Shape2> {
    let mut random = Random::new(seed ^ 0x9017);
    let mut one = |_| match kind {
        PlaneKind::Rect => {
            let half = Vec2::new(random.range(0.3, 0.6) as f32, random.range(0.3, 0.6) as f32);
            rect(half)
        }
        PlaneKind::Poly8 => ellipse(8, 0.8, &mut random),
        PlaneKind::Poly64 => ellipse(64, 0.8, &mut random),
        PlaneKind::Poly4096 => ellipse(4096, 0.0, &mut random),
    };
    (0..count).map(&mut one).collect()
}

pub(crate) fn cuboid(half_extents: Vec3) -> Shape3 {
    Cuboid::from_half_extents(half_extents).expect(IN_RANGE).into()
}

pub(crate) fn rect(half_extents: Vec2) -> Shape2 {
    Rect::from_half_extents(half_extents).expect(IN_RANGE).into()
}

/// A right prism over a right triangle, around the middle of its bounding box.
fn wedge(random: &mut Random) -> Shape3 {
    let half = random.within(DVec3::splat(0.3), DVec3::splat(0.6)).as_vec3();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)];
    let points: Vec<Vec3> =
        corners.into_iter().flat_map(|(x, y)| [-1.0, 1.0].map(|z| half * Vec3::new(x, y, z))).collect();
    Hull::from_points(&points).expect(IN_RANGE).into()
}

/// A cylinder of twelve sides, upright.
fn cylinder(random: &mut Random) -> Shape3 {
    let (radius, half_height) = (random.range(0.3, 0.6), random.range(0.3, 0.6));
    prism(12, radius, half_height)
}

/// An upright prism over a regular polygon.
pub(crate) fn prism(sides: usize, radius: f64, half_height: f64) -> Shape3 {
    let corner = |i: usize| {
        let angle = TAU * i as f64 / sides as f64;
        [-half_height, half_height]
            .map(|y| DVec3::new(radius * libm::cos(angle), y, radius * libm::sin(angle)).as_vec3())
    };
    let points: Vec<Vec3> = (0..sides).flat_map(corner).collect();
    Hull::from_points(&points).expect(IN_RANGE).into()
}

/// A globe as modellers draw it, of circles of latitude, without its poles.
fn globe(circles: usize, corners: usize, radius: f64) -> Shape3 {
    let corner = |i: usize, j: usize| {
        let latitude = TAU * 0.5 * ((i as f64 + 0.5) / circles as f64 - 0.5);
        let longitude = TAU * j as f64 / corners as f64;
        let (across, up) = (radius * libm::cos(latitude), radius * libm::sin(latitude));
        DVec3::new(across * libm::cos(longitude), up, across * libm::sin(longitude)).as_vec3()
    };
    let points: Vec<Vec3> = (0..circles).flat_map(|i| (0..corners).map(move |j| corner(i, j))).collect();
    Hull::from_points(&points).expect(IN_RANGE).into()
}

/// The hull of random points on an ellipsoid, so that all are vertices. Points too near others are drawn again: no tool
/// exports slivers.
pub(crate) fn ellipsoid(count: usize, random: &mut Random) -> Shape3 {
    let radii = random.within(DVec3::splat(0.4), DVec3::splat(0.6));
    let nearest_allowed = 1.6 / (count as f64).sqrt();
    let mut directions: Vec<DVec3> = Vec::with_capacity(count);
    let mut slack = 1.0;
    while directions.len() < count {
        let direction = random.direction();
        let crowded = |other: &DVec3| (direction - *other).length() < nearest_allowed * slack;
        if directions.iter().any(crowded) {
            slack *= 0.99;
        } else {
            directions.push(direction);
        }
    }
    let points: Vec<Vec3> = directions.iter().map(|direction| (*direction * radii).as_vec3()).collect();
    Hull::from_points(&points).expect(IN_RANGE).into()
}

/// Points around an ellipse, at equal angles up to `jitter`, a share of their spacing.
fn ellipse(count: usize, jitter: f64, random: &mut Random) -> Shape2 {
    let (wide, high) = (random.range(0.4, 0.6), random.range(0.4, 0.6));
    let mut point = |i: usize| {
        let angle = TAU * (i as f64 + jitter * random.range(-0.5, 0.5)) / count as f64;
        Vec2::new((wide * libm::cos(angle)) as f32, (high * libm::sin(angle)) as f32)
    };
    let points: Vec<Vec2> = (0..count).map(&mut point).collect();
    Polygon::hull_of(&points).expect(IN_RANGE).into()
}

/// Every vertex of a solid, in its own axes.
pub(crate) fn vertices3(shape: &Shape3) -> Vec<DVec3> {
    shape.core().vertices().iter().map(|v| v.as_dvec3()).collect()
}

/// Every vertex of a shape in the plane, counter-clockwise, in its own axes.
pub(crate) fn vertices2(shape: &Shape2) -> Vec<glam::DVec2> {
    shape.core().vertices().iter().map(|v| v.as_dvec2()).collect()
}
