//! Two bodies in the plane, in world axes about A's position.
//!
//! The stored matrix [c -s; s c] is exact as it stands, so a common power of two is all it takes to make it integers:
//! no denominator, and coordinates of some 80 bits. A part's matrix is multiplied by its body's. The third coordinate
//! is zero.

use super::int::Int;
use super::question::{Body, Question, Turn, Vertices, common_unit, in_units};
use asunder_geometry::{Core2, Pose2, Shape2};

/// A convex shape in its place in the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site2<'a> {
    pub(crate) shape: &'a Shape2,
    pub(crate) body: Pose2,
    /// Its pose in its compound, if it is part of one.
    pub(crate) part: Option<&'a Pose2>,
}

/// Cosine and sine.
type Rotation = [Int; 2];

/// The question whether two shapes overlap. `cores` are theirs.
pub(super) fn question<'a>(sites: [&'a Site2<'a>; 2], cores: [&'a Core2<'a>; 2]) -> Question<'a> {
    question_of(sites, cores, sites.map(|site| site.shape.radius()))
}

/// The same with other radii than the shapes' own, but multiples of the same unit: such as theirs, and zero.
pub(super) fn question_of<'a>(
    sites: [&'a Site2<'a>; 2],
    cores: [&'a Core2<'a>; 2],
    radii: [f32; 2],
) -> Question<'a> {
    let [site_a, site_b] = sites;
    let vertices = cores.map(|core| Vertices::Plane(core.vertices()));
    let unit = common_unit(sites.iter().zip(&vertices).flat_map(|(site, vertices)| lengths(site, vertices)));
    let poses = || sites.into_iter().flat_map(|site| [Some(&site.body), site.part]).flatten();
    let entries = |pose: &Pose2| [pose.rotation().cos(), pose.rotation().sin()].map(f64::from);
    // With 1 among the values, since positions are multiplied by the matrices' common factor.
    let turn_unit = common_unit(poses().flat_map(entries).chain([1.0]));
    let rotation = |pose: &Pose2| entries(pose).map(|entry| in_units(entry, turn_unit));
    let one = in_units(1.0, turn_unit);
    let has_parts = sites.iter().any(|site| site.part.is_some());
    // If either shape is a part, everything is multiplied twice.
    let weight = if has_parts { one.square() } else { one.clone() };
    let turn = |site: &Site2| {
        let body = rotation(&site.body);
        match site.part {
            Some(part) => product(&body, &rotation(part)),
            None if has_parts => body.map(|entry| &entry * &one),
            None => body,
        }
    };
    let place = |pose: &Pose2| pose.position().to_array().map(|value| in_units(value, unit));
    let origin = |site: &Site2| {
        let at = place(&site.body).map(|value| &value * &weight);
        match site.part {
            Some(part) => {
                let shift = turned(&rotation(&site.body), &place(part)).map(|value| &value * &one);
                [&at[0] + &shift[0], &at[1] + &shift[1]]
            }
            None => at,
        }
    };
    let (origin_a, origin_b) = (origin(site_a), origin(site_b));
    let body = |site: &Site2, vertices: Vertices<'a>| {
        let turn = turn(site);
        match site.shape {
            Shape2::HalfPlane(half_plane) => {
                let unit = common_unit(half_plane.normal().to_array().into_iter().map(f64::from));
                let normal = half_plane.normal().to_array().map(|value| in_units(f64::from(value), unit));
                let [x, y] = turned(&turn, &normal);
                Body::HalfSpace([x, y, Int::ZERO])
            }
            _ => Body::Core(vertices, Turn::Matrix(rows(&turn))),
        }
    };
    let [vertices_a, vertices_b] = vertices;
    let [radius_a, radius_b] = radii.map(|radius| in_units(f64::from(radius), unit));
    Question {
        a: body(site_a, vertices_a),
        b: body(site_b, vertices_b),
        offset: [&origin_b[0] - &origin_a[0], &origin_b[1] - &origin_a[1], Int::ZERO],
        radii: &weight * &(&radius_a + &radius_b),
        unit,
    }
}

/// All lengths that enter.
fn lengths<'a>(site: &'a Site2, vertices: &'a Vertices) -> impl Iterator<Item = f64> + 'a {
    let position = site.body.position().to_array().into_iter();
    let place = site.part.into_iter().flat_map(|part| part.position().to_array());
    let coordinates = vertices.coordinates().map(f64::from);
    position.chain(place).chain([f64::from(site.shape.radius())]).chain(coordinates)
}

fn product([c, s]: &Rotation, [d, t]: &Rotation) -> Rotation {
    [&(c * d) - &(s * t), &(s * d) + &(c * t)]
}

fn turned([c, s]: &Rotation, [x, y]: &[Int; 2]) -> [Int; 2] {
    [&(c * x) - &(s * y), &(s * x) + &(c * y)]
}

fn rows([c, s]: &Rotation) -> [[Int; 3]; 3] {
    [[c.clone(), -s.clone(), Int::ZERO], [s.clone(), c.clone(), Int::ZERO], [Int::ZERO, Int::ZERO, Int::ZERO]]
}
