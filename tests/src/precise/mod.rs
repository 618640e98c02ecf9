//! The separation of two shapes of any kind in double-double, with a bound on its own error.
//!
//! ```text
//! place    stored vertices, rotated and moved in double-double, relative to A's position         (place)
//! apart    the distance of the cores, between two bounds that prove each other                   (nearest)
//! else     the best of all axes that can decide the depth, each by full projection               (facets, depth)
//! rounded  less both radii           half-space: the least height of a point           bodies: the least of all parts
//! ```
//! The separation of two sets is the maximum over unit axes n of (min over B of n.x - max over A of n.x). Rounding is
//! about 1e-30 of the largest coordinate relative to A's position. The stated bound is the sum of that, the gap between
//! both bounds of a distance, and half an ulp of the returned f64; for depths, also what may be lost along an axis that
//! double-double knows badly: slivers of facets, edges almost parallel (argued in `depth`).

pub mod dd;
pub mod depth;
pub mod exactly;
pub mod facets;
pub mod nearest;
pub mod place;

use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use dd::{Dd, Dd3};
use depth::{Body, Deepest, Hull, deepest2, deepest3};
use facets::{Polyhedron, outline_without};
use glam::{DVec2, DVec3, Vec2, Vec3};
use nearest::{NOISE, gap_along, nearest};
use place::{Piece, pieces2, pieces3};

/// A separation, and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precise<V> {
    /// The separation, in metres: minus infinity between half-spaces that no translation separates.
    pub separation: f64,
    /// At least the error of `separation`, in metres.
    pub bound: f64,
    /// The unit axis from A to B that shows it; `None` where several do.
    pub normal: Option<V>,
}

/// As [`Precise`], before rounding to f64.
#[derive(Clone, Copy, Debug)]
struct Found {
    separation: Dd,
    bound: f64,
    axis: Option<Dd3>,
}

/// The separation of two posed shapes. Cost: 0.1 to 0.5 ms for boxes, 5 ms for hulls of 32 vertices.
pub fn separation3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> Precise<DVec3> {
    least(&all_pairs3(a, b)).cut()
}

/// The separation of two posed shapes in the plane.
pub fn separation2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> Precise<DVec2> {
    let Precise { separation, bound, normal } = least(&all_pairs2(a, b)).cut();
    Precise { separation, bound, normal: normal.map(DVec3::truncate) }
}

/// The separation of every pair of parts, those of A's first part first; shapes of one part give one.
pub fn separations3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> Vec<Precise<DVec3>> {
    all_pairs3(a, b).iter().map(|(found, _)| found.cut()).collect()
}

/// The separation of every pair of parts, those of A's first part first; shapes of one part give one.
pub fn separations2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> Vec<Precise<DVec2>> {
    let cut = |(found, _): &(Found, f64)| found.cut();
    let to_plane = |p: Precise<DVec3>| Precise {
        separation: p.separation,
        bound: p.bound,
        normal: p.normal.map(DVec3::truncate),
    };
    all_pairs2(a, b).iter().map(cut).map(to_plane).collect()
}

/// The separation along an axis of any length, from A to B. For bodies with parts, that of the nearest parts: the best
/// of the pairs that are within 1e-6 of the size as near as the nearest. For half-spaces, their separation where the
/// axis is within 2e-7 of the normal, an error that f32 can make; minus infinity elsewhere, and for the zero axis.
pub fn along3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3), axis: Vec3) -> f64 {
    let origin = a.1.position();
    along(&pieces3(a, origin), &pieces3(b, origin), Dd3::from(axis.as_dvec3()), || all_pairs3(a, b))
}

/// As [`along3`], in the plane.
pub fn along2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2), axis: Vec2) -> f64 {
    let origin = a.1.position();
    along(&pieces2(a, origin), &pieces2(b, origin), Dd3::from(axis.as_dvec2().extend(0.0)), || {
        all_pairs2(a, b)
    })
}

fn all_pairs3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> Vec<(Found, f64)> {
    all_pairs(&pieces3(a, a.1.position()), &pieces3(b, a.1.position()), deepest_in_space)
}

fn all_pairs2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> Vec<(Found, f64)> {
    all_pairs(&pieces2(a, a.1.position()), &pieces2(b, a.1.position()), deepest_in_plane)
}

fn deepest_in_space(a: Hull, b: Hull) -> Deepest {
    let forms = [a, b].map(|hull| Polyhedron::of(hull.stored));
    deepest3(Body { hull: a, form: &forms[0] }, Body { hull: b, form: &forms[1] })
}

fn deepest_in_plane(a: Hull, b: Hull) -> Deepest {
    let outline =
        |hull: Hull| outline_without(hull.stored, &(0..hull.stored.len()).collect::<Vec<usize>>(), 2);
    deepest2((a, &outline(a)), (b, &outline(b)))
}

/// The separation of every pair of pieces, with the reach of both.
fn all_pairs(a: &[Piece], b: &[Piece], deepest: impl Fn(Hull, Hull) -> Deepest) -> Vec<(Found, f64)> {
    let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| (of_pieces(a, b, &deepest), reach(a) + reach(b))).collect()
}

fn reach(piece: &Piece) -> f64 {
    match piece {
        Piece::Round { cloud, radius, .. } => cloud.reach() + radius.to_f64(),
        Piece::Half { .. } => 0.0,
    }
}

/// The least of some separations; with its axis only if no other one comes near along another axis.
fn least(pairs: &[(Found, f64)]) -> Found {
    let by_separation = |p: &&(Found, f64), q: &&(Found, f64)| {
        p.0.separation.partial_cmp(&q.0.separation).expect("no separation is NaN")
    };
    let (mut found, size) = *pairs.iter().min_by(by_separation).expect("a body has a piece");
    let differs = |other: Option<Dd3>| match (found.axis, other) {
        (Some(axis), Some(other)) => (axis - other).to_f64().length() > 1e-6,
        _ => true,
    };
    let is_tied = |(other, _): &&(Found, f64)| {
        (other.separation - found.separation).to_f64() <= 1e-13 * size && differs(other.axis)
    };
    if pairs.iter().any(|pair| is_tied(&pair)) {
        found.axis = None;
    }
    // A part that is not the least may still be, within its own bound.
    found.bound =
        pairs.iter().map(|pair| pair.0.bound).filter(|bound| bound.is_finite()).fold(found.bound, f64::max);
    found
}

impl Found {
    fn cut(&self) -> Precise<DVec3> {
        let separation = self.separation.to_f64();
        let last_place = if separation.is_finite() { separation.abs() * f64::EPSILON / 2.0 } else { 0.0 };
        Precise {
            separation,
            bound: self.bound + last_place,
            normal: self.axis.map(|axis| axis.to_f64().normalize()),
        }
    }
}

fn of_pieces(a: &Piece, b: &Piece, deepest: &impl Fn(Hull, Hull) -> Deepest) -> Found {
    match (a, b) {
        (
            Piece::Round { cloud, stored, turn, radius },
            Piece::Round { cloud: other, stored: others, turn: turned, radius: more },
        ) => {
            let of_b = Hull { cloud: other, stored: others, turn: turned };
            let cores = of_cores(Hull { cloud, stored, turn }, of_b, deepest);
            let separation = cores.separation - *radius - *more;
            Found { separation, bound: cores.bound + NOISE * (radius.to_f64() + more.to_f64()), ..cores }
        }
        (Piece::Half { normal, at, .. }, Piece::Round { cloud, radius, .. }) => {
            let height = -cloud.support(-*normal).1 - normal.dot(*at);
            let bound = NOISE * (cloud.reach() + at.to_f64().length() + radius.to_f64());
            Found { separation: height - *radius, bound, axis: Some(*normal) }
        }
        (Piece::Round { .. }, Piece::Half { .. }) => {
            let found = of_pieces(b, a, deepest);
            Found { axis: found.axis.map(|axis| -axis), ..found }
        }
        (Piece::Half { normal, at, .. }, Piece::Half { normal: facing, at: there, .. }) => {
            // Double-double cannot say "exactly"; normals that count as opposite and are not are of no interest here.
            let is_opposite = (*normal + *facing).to_f64().length() <= NOISE;
            let height = normal.dot(*there - *at);
            let separation = if is_opposite { height } else { Dd::from(f64::NEG_INFINITY) };
            let bound = NOISE * (at.to_f64().length() + there.to_f64().length());
            Found { separation, bound, axis: is_opposite.then_some(*normal) }
        }
    }
}

fn of_cores(a: Hull, b: Hull, deepest: &impl Fn(Hull, Hull) -> Deepest) -> Found {
    let size = a.cloud.reach() + b.cloud.reach();
    let noise = NOISE * size;
    let found = nearest(a.cloud, b.cloud);
    if found.lower.to_f64() > noise {
        let bound = (found.upper - found.lower).to_f64().max(0.0) + noise;
        // Good to 1e-10; with fewer digits the direction of the line between the points means nothing.
        let is_clear = found.upper.to_f64() > 1e10 * noise;
        return Found {
            separation: found.upper,
            bound,
            axis: found.vector.try_normalize().filter(|_| is_clear),
        };
    }
    let best = deepest(a, b);
    let axis = best.is_unique.then_some(best.axis);
    let regret = (best.regret + 1e-24) * size;
    if best.gap.to_f64() > noise {
        // A tiny gap that the distance alone could not show.
        let (separation, below) = (found.upper.max(best.gap), best.gap.max(found.lower));
        return Found { separation, bound: (separation - below).to_f64() + noise, axis };
    }
    Found { separation: best.gap, bound: regret + noise, axis }
}

fn along(a: &[Piece], b: &[Piece], axis: Dd3, all: impl Fn() -> Vec<(Found, f64)>) -> f64 {
    let Some(axis) = axis.try_normalize() else { return f64::NEG_INFINITY };
    let gaps = a.iter().flat_map(|a| b.iter().map(move |b| gap_of_pieces(a, b, axis)));
    if a.len() * b.len() == 1 {
        return gaps.fold(f64::NEG_INFINITY, f64::max);
    }
    let all = all();
    let found = least(&all);
    let is_near = |&(other, size): &(Found, f64)| {
        (other.separation - found.separation).to_f64() <= 1e-6 * size || other.separation == found.separation
    };
    gaps.zip(&all).filter(|(_, pair)| is_near(pair)).map(|(gap, _)| gap).fold(f64::NEG_INFINITY, f64::max)
}

fn gap_of_pieces(a: &Piece, b: &Piece, axis: Dd3) -> f64 {
    let is_near = |normal: Dd3| (axis - normal).to_f64().length() < 2e-7;
    let unused = |_: Hull, _: Hull| unreachable!("half-spaces have no cores");
    match (a, b) {
        (Piece::Round { cloud, radius, .. }, Piece::Round { cloud: other, radius: more, .. }) => {
            (gap_along(cloud, other, axis) - *radius - *more).to_f64()
        }
        (Piece::Half { normal, .. }, _) if is_near(*normal) => of_pieces(a, b, &unused).separation.to_f64(),
        (_, Piece::Half { normal, .. }) if is_near(-*normal) => of_pieces(a, b, &unused).separation.to_f64(),
        _ => f64::NEG_INFINITY,
    }
}
