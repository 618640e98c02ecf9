//! Two bodies in space, seen exactly from A.
//!
//! ```text
//! a quaternion q means the rotation M(q)/|q|^2, whatever its length; M(p q) = M(p) M(q), |p q| = |p||q|
//! Q    = body's quaternion times the part's own           (a shape that is no part: the body's)
//! r    = conjugate(Q_a) Q_b, or 1 where its vector part vanishes: the bodies are turned alike
//! s    = (position of B's origin less that of A's) x m, where m clears what the parts' places are divided by
//! seen from A:  b -> M(r)/|r|^2 b + M(Q_a)^T/|Q_a|^2 s/m
//! times W = |r|^2 m where that clears |Q_a|^2 too, else |Q_a|^2 m:  all integers
//! ```

use super::int::{Int, dot3};
use super::question::{Body, Question, Turn, Vertices, common_unit, in_units};
use asunder_geometry::{Core3, Pose3, Shape3};

/// A convex shape in its place in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site3<'a> {
    pub(crate) shape: &'a Shape3,
    pub(crate) body: Pose3,
    /// Where it is in its compound, if it is part of one.
    pub(crate) part: Option<&'a Pose3>,
}

/// x, y, z, w.
type Quaternion = [Int; 4];

/// The question whether two shapes meet. `cores` are theirs.
pub(super) fn question<'a>(sites: [&'a Site3<'a>; 2], cores: [&'a Core3<'a>; 2]) -> Question<'a> {
    let [site_a, site_b] = sites;
    let vertices = cores.map(|core| Vertices::Space(core.vertices()));
    let unit = common_unit(sites.iter().zip(&vertices).flat_map(|(site, vertices)| lengths(site, vertices)));
    let whole = sites.map(|site| rotation(&site.body));
    let turns = [0, 1].map(|i| match sites[i].part {
        Some(part) => product(&whole[i], &rotation(part)),
        None => whole[i].clone(),
    });
    let relative = aligned(product(&conjugate(&turns[0]), &turns[1]));
    let (squared_a, squared_b) = (squared(&turns[0]), squared(&turns[1]));
    let (between, cleared) = between(sites, &whole, unit);
    let back = turned_back(&turns[0], &between);
    // Where r was made 1, its length clears nothing of A's; else it has A's and B's in it.
    let is_alike = relative[..3].iter().all(Int::is_zero);
    let (outer, inner) =
        if is_alike { (&squared_a * &cleared, Int::from(1_i64)) } else { (cleared, squared_b) };
    let weight = if is_alike { outer.clone() } else { &outer * &(&squared_a * &inner) };
    let rows = matrix(&relative).map(|row| row.map(|entry| &entry * &outer));
    let turn_a = Turn::Weight(weight.clone());
    let turn_b = if is_alike { Turn::Weight(weight.clone()) } else { Turn::Matrix(rows) };
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

/// Everything that is measured in metres.
fn lengths<'a>(site: &'a Site3, vertices: &'a Vertices) -> impl Iterator<Item = f64> + 'a {
    let position = site.body.position().to_array().into_iter();
    let place = site.part.into_iter().flat_map(|part| part.position().to_array());
    let coordinates = vertices.coordinates().map(f64::from);
    position.chain(place).chain([f64::from(site.shape.radius())]).chain(coordinates)
}

/// B's origin less A's in world axes, and the factor that it was multiplied by.
fn between(sites: [&Site3; 2], whole: &[Quaternion; 2], unit: i32) -> ([Int; 3], Int) {
    let place = |pose: &Pose3| pose.position().to_array().map(|value| in_units(value, unit));
    let (at_a, at_b) = (place(&sites[0].body), place(&sites[1].body));
    let bodies = [0, 1, 2].map(|i| &at_b[i] - &at_a[i]);
    if sites.iter().all(|site| site.part.is_none()) {
        return (bodies, Int::from(1_i64));
    }
    let squares = [squared(&whole[0]), squared(&whole[1])];
    // A part's place is divided by its own body's square alone.
    let shift = |i: usize| match sites[i].part {
        Some(part) => turned(&whole[i], &place(part)).map(|c| &c * &squares[1 - i]),
        None => [Int::ZERO, Int::ZERO, Int::ZERO],
    };
    let (shift_a, shift_b) = (shift(0), shift(1));
    let cleared = &squares[0] * &squares[1];
    let total = [0, 1, 2].map(|i| &(&(&bodies[i] * &cleared) + &shift_b[i]) - &shift_a[i]);
    (total, cleared)
}

/// A pose's quaternion as integers; a common factor means nothing.
fn rotation(pose: &Pose3) -> Quaternion {
    let components = pose.rotation().to_array().map(f64::from);
    let unit = common_unit(components.into_iter());
    components.map(|value| in_units(value, unit))
}

/// 1 for a rotation that turns nothing.
fn aligned(quaternion: Quaternion) -> Quaternion {
    if quaternion[..3].iter().all(Int::is_zero) {
        [Int::ZERO, Int::ZERO, Int::ZERO, Int::from(1_i64)]
    } else {
        quaternion
    }
}

fn conjugate([x, y, z, w]: &Quaternion) -> Quaternion {
    [-x.clone(), -y.clone(), -z.clone(), w.clone()]
}

fn squared(q: &Quaternion) -> Int {
    &(&q[0].square() + &q[1].square()) + &(&q[2].square() + &q[3].square())
}

fn product(p: &Quaternion, q: &Quaternion) -> Quaternion {
    let sum = |terms: [(usize, usize); 4], is_negative: [bool; 4]| {
        let mut sum = Int::ZERO;
        for ((i, j), is_negative) in terms.into_iter().zip(is_negative) {
            if is_negative { sum.sub_product(&p[i], &q[j]) } else { sum.add_product(&p[i], &q[j]) }
        }
        sum
    };
    [
        sum([(3, 0), (0, 3), (1, 2), (2, 1)], [false, false, false, true]),
        sum([(3, 1), (1, 3), (2, 0), (0, 2)], [false, false, false, true]),
        sum([(3, 2), (2, 3), (0, 1), (1, 0)], [false, false, false, true]),
        sum([(3, 3), (0, 0), (1, 1), (2, 2)], [false, true, true, true]),
    ]
}

/// The rows of M(q): |q|^2 times a rotation.
fn matrix(q: &Quaternion) -> [[Int; 3]; 3] {
    let [x, y, z, w] = q;
    let (xx, yy, zz, ww) = (x.square(), y.square(), z.square(), w.square());
    let twice = |one: [&Int; 2], other: [&Int; 2], is_sum: bool| {
        let mut entry = one[0] * one[1];
        if is_sum {
            entry.add_product(other[0], other[1])
        } else {
            entry.sub_product(other[0], other[1])
        }
        entry.doubled()
    };
    [
        [&(&ww + &xx) - &(&yy + &zz), twice([x, y], [z, w], false), twice([x, z], [y, w], true)],
        [twice([x, y], [z, w], true), &(&ww + &yy) - &(&xx + &zz), twice([y, z], [x, w], false)],
        [twice([x, z], [y, w], false), twice([y, z], [x, w], true), &(&ww + &zz) - &(&xx + &yy)],
    ]
}

fn turned(q: &Quaternion, v: &[Int; 3]) -> [Int; 3] {
    let rows = matrix(q);
    [dot3(&rows[0], v), dot3(&rows[1], v), dot3(&rows[2], v)]
}

fn turned_back(q: &Quaternion, v: &[Int; 3]) -> [Int; 3] {
    turned(&conjugate(q), v)
}
