//! What must hold for shapes made from any bytes: the bodies of the fuzz targets in `fuzz/`, and of their seeded run in
//! `tests/suite/fuzzed.rs`.
//!
//! The first byte chooses how the rest becomes points: raw bits of f32, with NaN, infinities and subnormals; a lattice
//! of whole numbers, full of repeated, collinear and cocircular points; or a fine lattice far from the origin, where
//! one step is one rounding. The second byte is a number that the target may use.

use crate::exact_plane::{ExactPlane, Meeting};
use crate::outlines::untangled;
use asunder_geometry::tolerance::{MAX_RADIUS, MIN_RADIUS};
use asunder_geometry::{
    Compound2, DecomposeError, Hull, HullError, Polygon, PolygonError, Shape2, decompose as decomposed,
};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The most points that a target makes of its bytes: the oracles compare all pairs.
const MAX_POINTS: usize = 40;

/// Hulls in space: made from points, of any dimension, and simplified.
pub fn hull(data: &[u8]) {
    let (number, values) = values(data);
    let points: Vec<Vec3> = values.chunks_exact(3).take(MAX_POINTS).map(Vec3::from_slice).collect();
    let whole = Hull::from_points(&points);
    match &whole {
        Ok(hull) => check_hull(hull, &points),
        Err(HullError::NotFinite { index }) => assert!(!points[*index].is_finite()),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    let any = Hull::of_any_dimension(&points);
    if let Ok(hull) = &any {
        check_hull(hull, &points);
    }
    assert!(any.is_ok() || whole.is_err(), "a solid hull is one of any dimension too: {any:?}");
    let limit = usize::from(number);
    if let Ok(simple) = Hull::simplify(&points, limit) {
        assert!(simple.vertices().len() <= limit, "{} of {limit}", simple.vertices().len());
        check_hull(&simple, &points);
    }
}

fn check_hull(hull: &Hull, points: &[Vec3]) {
    assert_eq!(hull.check(points), Ok(()), "{points:?}");
    let same_bits = |v: &Vec3, p: &Vec3| v.to_array().map(f32::to_bits) == p.to_array().map(f32::to_bits);
    assert!(hull.vertices().iter().all(|v| points.iter().any(|p| same_bits(v, p))), "{points:?}");
    assert!(hull.normals().iter().all(|normal| (normal.length() - 1.0).abs() < 1e-9), "{points:?}");
    assert!(hull.center().is_finite() && hull.error() >= 0.0 && hull.error().is_finite(), "{points:?}");
    assert!(hull.outer_radius() >= MIN_RADIUS && hull.inner_radius() >= 0.0, "{points:?}");
    for vertex in hull.vertices() {
        let distance = (vertex.as_dvec3() - hull.center().as_dvec3()).length();
        assert!(distance <= f64::from(hull.outer_radius()), "{points:?}");
    }
    assert!(hull.contains(DVec3::NAN) == hull.contains(DVec3::INFINITY), "nothing is nowhere");
}

/// Polygons: taken as they are, as hulls, and simplified.
pub fn polygon(data: &[u8]) {
    let (number, values) = values(data);
    let points: Vec<Vec2> = values.chunks_exact(2).take(MAX_POINTS).map(Vec2::from_slice).collect();
    check_polygons(&points, usize::from(number));
}

/// Checks the polygons made of any points.
pub fn check_polygons(points: &[Vec2], limit: usize) {
    let (taken, hull) = (Polygon::new(points), Polygon::hull_of(points));
    let simple = Polygon::simplify(points, limit);
    if let Some(bad) = points.iter().position(|p| !p.is_finite()) {
        assert!(taken.is_err() && hull.is_err() && simple.is_err(), "point {bad} of {points:?} is accepted");
        return;
    }
    // The error bound joins the points as an x coordinate, so that all are in one unit.
    let error = simple.as_ref().map_or(0.0, Polygon::error);
    let bound = DVec2::new(f64::from(error), 0.0);
    let exact = ExactPlane::new(points.iter().map(|p| p.as_dvec2()).chain([bound]));
    let all: Vec<usize> = (0..points.len()).collect();
    let wrapped = exact.hull(&all);
    match &hull {
        Ok(hull) => {
            let found = numbers(hull, points);
            assert!(cycles_agree(&exact, &found, &wrapped), "{found:?}, not {wrapped:?}: {points:?}");
            check_polygon(hull, 0.0);
        }
        Err(PolygonError::Collinear) => assert!(wrapped.is_empty(), "{wrapped:?} of {points:?}"),
        Err(error) => check_refusal(*error, points),
    }
    match &taken {
        Ok(polygon) => {
            let found = numbers(polygon, points);
            assert!(cycles_agree(&exact, &found, &wrapped), "{found:?} is not convex: {points:?}");
            assert_eq!(exact.doubled_area(&found), exact.doubled_area(&all), "{points:?}");
            check_polygon(polygon, 0.0);
        }
        // A convex outline consists of exactly its hull's corners in order: if it has no other points, it must be
        // accepted.
        Err(error) => assert!(
            hull.is_err() || !cycles_agree(&exact, &all, &wrapped),
            "{error}, but the outline is its hull: {points:?}"
        ),
    }
    check_simplified(&simple, &hull, &exact, &wrapped, (points, limit));
}

fn check_simplified(
    simple: &Result<Polygon, PolygonError>,
    hull: &Result<Polygon, PolygonError>,
    exact: &ExactPlane,
    wrapped: &[usize],
    (points, limit): (&[Vec2], usize),
) {
    match simple {
        Ok(simple) => {
            let found = numbers(simple, points);
            assert_eq!(found.len(), limit.min(wrapped.len()), "{points:?}");
            assert!(exact.is_strictly_convex(&found), "{found:?} of {points:?}");
            check_polygon(simple, simple.error());
            for &vertex in wrapped {
                assert!(exact.is_within(vertex, &found, points.len()), "{vertex} of {points:?}: {simple:?}");
            }
        }
        Err(PolygonError::LimitOutOfRange { max_vertices }) => assert!(*max_vertices == limit && limit < 3),
        Err(PolygonError::TooSmall { radius }) => assert!(*radius < MIN_RADIUS),
        Err(error) => assert_eq!(hull.as_ref().err(), Some(error), "{points:?}"),
    }
}

fn check_polygon(polygon: &Polygon, error: f32) {
    assert_eq!(polygon.error(), error);
    assert!(error >= 0.0 && error.is_finite(), "{polygon:?}");
    let (inner, outer) = (polygon.inner_radius(), polygon.outer_radius());
    assert!(0.0 <= inner && inner <= outer && outer >= MIN_RADIUS && outer.is_finite(), "{polygon:?}");
    assert!(polygon.normals().iter().all(|normal| (normal.length() - 1.0).abs() < 1e-12), "{polygon:?}");
    let center = polygon.center();
    assert!(center.is_finite(), "{polygon:?}");
    for vertex in polygon.vertices() {
        let distance = (vertex.as_dvec2() - center.as_dvec2()).length();
        assert!(distance <= f64::from(outer), "{polygon:?}");
        assert!(polygon.contains(*vertex), "{polygon:?}");
    }
    for (normal, vertex) in polygon.normals().iter().zip(polygon.vertices()) {
        let height = normal.dot(vertex.as_dvec2() - center.as_dvec2());
        assert!(inner == 0.0 || height >= f64::from(inner) * (1.0 - 1e-12), "{polygon:?}");
    }
}

fn check_refusal(error: PolygonError, points: &[Vec2]) {
    match error {
        PolygonError::TooFewPoints { count } => assert!(count == points.len() && count < 3),
        PolygonError::TooLarge { index } => {
            assert!(points[index].as_dvec2().length() > f64::from(MAX_RADIUS))
        }
        PolygonError::TooSmall { radius } => assert!(radius < MIN_RADIUS),
        other => panic!("{other} is no reason to refuse a hull of {points:?}"),
    }
}

/// Concave outlines: rejected for a true reason, or split without gaps and overlaps.
pub fn decompose(data: &[u8]) {
    let (number, values) = values(data);
    let mut outline: Vec<Vec2> = values.chunks_exact(2).take(MAX_POINTS).map(Vec2::from_slice).collect();
    // Few outlines are simple as they come: three in four are untangled first.
    if number % 4 != 0 && outline.iter().all(|p| p.is_finite()) {
        outline = untangled(outline);
    }
    let _ = check_decomposition(&outline);
}

/// Checks the decomposition of any outline. Returns whether it was split, and into how many parts.
pub fn check_decomposition(outline: &[Vec2]) -> Result<usize, DecomposeError> {
    let found = decomposed(outline);
    let count = outline.len();
    if let Err(error) = &found {
        assert!(!error.to_string().is_empty());
        match *error {
            DecomposeError::TooFewVertices { count: told } => assert!(told == count && count < 3),
            DecomposeError::TooManyVertices { count: told } => assert!(told == count && count > 4096),
            DecomposeError::NotFinite { vertex } => assert!(!outline[vertex].is_finite()),
            // A circle about a part's centre reaches less than twice as far as the part's furthest vertex.
            DecomposeError::TooLarge { vertex } => {
                let reach = outline.iter().map(|p| p.as_dvec2().length()).fold(0.0, f64::max);
                assert!(vertex < count && reach > 0.5 * f64::from(MAX_RADIUS), "{outline:?}");
            }
            _ => check_exact_refusal(*error, outline),
        }
        return Err(*error);
    }
    let parts = found?;
    let mut exact = ExactPlane::new(outline.iter().map(|p| p.as_dvec2()));
    assert!(exact.is_simple(count), "accepted: {outline:?}");
    check_parts(&parts, &mut exact, outline);
    Ok(parts.parts().len())
}

fn check_exact_refusal(error: DecomposeError, outline: &[Vec2]) {
    let count = outline.len();
    let exact = ExactPlane::new(outline.iter().map(|p| p.as_dvec2()));
    let ends = |edge: usize| [edge, (edge + 1) % count];
    let told = |first, second, how| first < second && exact.meeting(count, first, second) == how;
    let is_true = match error {
        DecomposeError::Repeated { first, second } => first < second && exact.same(first, second),
        DecomposeError::Crossing { first, second } => told(first, second, Meeting::Crossing),
        DecomposeError::Overlapping { first, second } => told(first, second, Meeting::Overlapping),
        DecomposeError::Touching { vertex, edge } => {
            exact.on_segment(vertex, ends(edge)) && !ends(edge).contains(&vertex)
        }
        DecomposeError::TooSmall { radius } => radius < MIN_RADIUS && exact.is_simple(count),
        DecomposeError::TooFine { vertex } => vertex < count && has_close_vertices(outline),
        _ => false,
    };
    assert!(is_true, "{error}: {outline:?}");
}

/// Whether two vertices are so close that they could belong to a part that is too small.
fn has_close_vertices(outline: &[Vec2]) -> bool {
    let apart = |a: &Vec2, b: &Vec2| (a.as_dvec2() - b.as_dvec2()).length();
    (0..outline.len()).any(|b| (0..b).any(|a| apart(&outline[a], &outline[b]) <= 2.0 * f64::from(MIN_RADIUS)))
}

fn check_parts(parts: &Compound2, exact: &mut ExactPlane, outline: &[Vec2]) {
    let count = outline.len();
    let mut whole: Vec<usize> = (0..count).collect();
    if exact.doubled_area(&whole) < 0.into() {
        whole.reverse();
    }
    let loops: Vec<Vec<usize>> = parts
        .parts()
        .iter()
        .map(|part| match part.shape() {
            Shape2::Polygon(polygon) => numbers(polygon, outline),
            other => panic!("{other:?} is no polygon"),
        })
        .collect();
    let (mut area, reflex) = (exact.doubled_area(&whole), reflex_vertices(exact, &whole));
    assert!(loops.len() <= 2 * reflex + 1, "{} parts for {reflex} reflex vertices", loops.len());
    for (number, part) in loops.iter().enumerate() {
        assert!(exact.is_strictly_convex(part), "{part:?} of {outline:?}");
        area -= exact.doubled_area(part);
        for other in &loops[..number] {
            assert!(exact.are_disjoint_inside(part, other), "{part:?} and {other:?} of {outline:?}");
        }
        // No vertex of the outline is inside, no side crosses it, and one point inside is in the outline: so the whole
        // part is.
        assert!(
            whole.iter().all(|&p| part.contains(&p) || exact.place(p, part).is_le()),
            "{part:?} of {outline:?}"
        );
        let middle = exact.add_middle([part[0], part[1], part[2]]);
        assert!(exact.place(middle, &whole).is_gt(), "{part:?} of {outline:?}");
    }
    // Nothing is left out except parts too small for a shape.
    let is_complete = area == 0.into();
    assert!(is_complete || area > 0.into() && has_close_vertices(outline), "{area} left of {outline:?}");
    if is_complete {
        check_samples(parts, &whole, outline);
    }
}

/// How many vertices of a counter-clockwise outline turn inwards.
fn reflex_vertices(exact: &ExactPlane, whole: &[usize]) -> usize {
    let n = whole.len();
    (0..n).filter(|&i| exact.turn(whole[i], whole[(i + 1) % n], whole[(i + 2) % n]).is_lt()).count()
}

/// Midpoints between vertices, which are often on an edge or a diagonal, are contained if they are inside the outline.
fn check_samples(parts: &Compound2, whole: &[usize], outline: &[Vec2]) {
    let n = outline.len();
    let middle = |a: Vec2, b: Vec2| ((a.as_dvec2() + b.as_dvec2()) * 0.5).as_vec2();
    let samples: Vec<Vec2> =
        (0..n).flat_map(|i| [middle(outline[i], outline[(i + 2) % n]), outline[i]]).collect();
    let exact = ExactPlane::new(outline.iter().chain(&samples).map(|p| p.as_dvec2()));
    for (number, sample) in samples.iter().enumerate() {
        let is_inside = exact.place(n + number, whole).is_ge();
        assert_eq!(parts.contains(*sample), is_inside, "{sample} in {outline:?}");
    }
}

/// The indices of a polygon's vertices among the points, bit for bit.
fn numbers(polygon: &Polygon, points: &[Vec2]) -> Vec<usize> {
    let bits = |v: Vec2| v.to_array().map(f32::to_bits);
    let number = |v: &Vec2| points.iter().position(|p| bits(*p) == bits(*v));
    polygon
        .vertices()
        .iter()
        .map(|v| number(v).unwrap_or_else(|| panic!("{v} is none of {points:?}")))
        .collect()
}

/// Whether two loops visit the same places in the same order, wherever they start.
fn cycles_agree(exact: &ExactPlane, one: &[usize], other: &[usize]) -> bool {
    let n = one.len();
    n == other.len() && (0..n).any(|shift| (0..n).all(|i| exact.same(one[i], other[(i + shift) % n])))
}

/// The number and the coordinates that the bytes encode.
fn values(data: &[u8]) -> (u8, Vec<f32>) {
    let [mode, number, rest @ ..] = data else { return (0, Vec::new()) };
    let raw = |four: &[u8]| f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
    let signed = |byte: &u8| f32::from(i8::from_le_bytes([*byte]));
    let values = match mode % 4 {
        0 => rest.chunks_exact(4).map(raw).collect(),
        1 => rest.iter().map(|byte| f32::from(byte % 8)).collect(),
        2 => rest.iter().map(signed).collect(),
        _ => rest.iter().map(|byte| 1.0 + signed(byte) * f32::EPSILON).collect(),
    };
    (*number, values)
}
