//! Two bodies in space, in exact coordinates relative to A.
//!
//! ```text
//! Q    = body's quaternion times the part's own           (a shape that is no part: the body's)
//! r    = conjugate(Q_a) Q_b, or 1 where its vector part vanishes: the bodies are turned alike
//! s    = (position of B's origin less that of A's) x m, where m clears the denominators of the parts' positions
//! relative to A:  b -> M(r)/|r|^2 b + M(Q_a)^T/|Q_a|^2 s/m
//! times W = |r|^2 m where that clears |Q_a|^2 too, else |Q_a|^2 m:  all integers
//! ```

use super::int::{Int, dot3};
use super::question::{Body, Question, Turn, Vertices, common_unit, in_units};
use super::rotation::{Turns, matrix, product, quaternion, squared};
use asunder_geometry::{Core3, Pose3, Shape3};

/// A convex shape in its place in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site3<'a> {
    pub(crate) shape: &'a Shape3,
    pub(crate) body: Pose3,
    /// Its pose in its compound, if it is part of one.
    pub(crate) part: Option<&'a Pose3>,
}

/// The question whether two shapes overlap. `cores` are theirs.
pub(super) fn question<'a>(sites: [&'a Site3<'a>; 2], cores: [&'a Core3<'a>; 2]) -> Question<'a> {
    let [site_a, site_b] = sites;
    let vertices = cores.map(|core| Vertices::Space(core.vertices()));
    let unit = common_unit(sites.iter().zip(&vertices).flat_map(|(site, vertices)| lengths(site, vertices)));
    let turns = turns(sites);
    let (between, cleared) = between(sites, unit);
    let back = turned(&turns.to_a, &between);
    // If r was replaced by 1, its length clears nothing of A's; else it contains A's and B's.
    let (outer, inner) =
        if turns.are_alike { (&turns.squared_a * &cleared, Int::ONE) } else { (cleared, turns.squared_b) };
    let weight = if turns.are_alike { outer.clone() } else { &outer * &(&turns.squared_a * &inner) };
    let turn_b = match turns.are_alike {
        true => Turn::Weight(weight.clone()),
        false if outer == Int::ONE => Turn::Matrix(turns.relative),
        false => Turn::Matrix(turns.relative.map(|row| row.map(|entry| &entry * &outer))),
    };
    let turn_a = Turn::Weight(weight.clone());
    let body = |site: &Site3, vertices: Vertices<'a>, turn: Turn| match site.shape {
        Shape3::HalfSpace(half_space) => {
            let unit = common_unit(half_space.normal().to_array().into_iter().map(f64::from));
            let normal = half_space.normal().to_array().map(|value| in_units(f64::from(value), unit));
            Body::HalfSpace(turn.turn(&normal))
        }
        _ => Body::Core(vertices, turn),
    };
    let [vertices_a, vertices_b] = vertices;
    let radius = |site: &Site3| in_units(f64::from(site.shape.radius()), unit);
    Question {
        a: body(site_a, vertices_a, turn_a),
        b: body(site_b, vertices_b, turn_b),
        offset: back.map(|c| &c * &inner),
        radii: &weight * &(&radius(site_a) + &radius(site_b)),
        unit,
    }
}

/// All lengths that enter.
fn lengths<'a>(site: &'a Site3, vertices: &'a Vertices) -> impl Iterator<Item = f64> + 'a {
    let position = site.body.position().to_array().into_iter();
    let place = site.part.into_iter().flat_map(|part| part.position().to_array());
    let coordinates = vertices.coordinates().map(f64::from);
    position.chain(place).chain([f64::from(site.shape.radius())]).chain(coordinates)
}

/// How the two shapes are turned.
fn turns(sites: [&Site3; 2]) -> Turns {
    if sites.iter().all(|site| site.part.is_none()) {
        return Turns::of(sites.map(|site| &site.body));
    }
    let [a, b] = sites.map(|site| match site.part {
        Some(part) => product(&quaternion(&site.body), &quaternion(part)),
        None => quaternion(&site.body),
    });
    Turns::between(&a, &b)
}

/// B's origin less A's in world axes, and the factor that it was multiplied by to be an integer.
fn between(sites: [&Site3; 2], unit: i32) -> ([Int; 3], Int) {
    let place = |pose: &Pose3| pose.position().to_array().map(|value| in_units(value, unit));
    let (at_a, at_b) = (place(&sites[0].body), place(&sites[1].body));
    let bodies = [0, 1, 2].map(|i| &at_b[i] - &at_a[i]);
    if sites.iter().all(|site| site.part.is_none()) {
        return (bodies, Int::ONE);
    }
    let whole = sites.map(|site| quaternion(&site.body));
    let squares = [squared(&whole[0]), squared(&whole[1])];
    // A part's position has only its own body's square for a denominator.
    let shift = |i: usize| match sites[i].part {
        Some(part) => turned(&matrix(&whole[i]), &place(part)).map(|c| &c * &squares[1 - i]),
        None => [Int::ZERO, Int::ZERO, Int::ZERO],
    };
    let (shift_a, shift_b) = (shift(0), shift(1));
    let cleared = &squares[0] * &squares[1];
    let total = [0, 1, 2].map(|i| &(&(&bodies[i] * &cleared) + &shift_b[i]) - &shift_a[i]);
    (total, cleared)
}

fn turned(rows: &[[Int; 3]; 3], v: &[Int; 3]) -> [Int; 3] {
    [dot3(&rows[0], v), dot3(&rows[1], v), dot3(&rows[2], v)]
}
