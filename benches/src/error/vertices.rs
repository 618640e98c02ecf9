//! Time against vertices: hulls of 4 to 256 vertices, polygons of 3 to 4096.
//!
//! Two of five pairs are apart, the others overlap, none of them by so little that exact arithmetic is needed. A set
//! draws from few different shapes, as a game does.

use super::VertexRow;
use super::groups::Grouped;
use super::methods::{Asked, Method, Operation};
use super::speed::in_turns;
use crate::clock::Samples;
use crate::flat::{Lie, grown};
use asunder_geometry::{Hull, Pose3, Shape3};
use asunder_narrow::Pair3;
use asunder_scenes::pairs::{PosedPair2, PosedPair3, SolidKind, solids};
use asunder_scenes::random::Random;
use glam::{DVec3, Vec3};

const SOLIDS: [usize; 7] = [4, 8, 16, 32, 64, 128, 256];
const POLYGONS: [usize; 12] = [3, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];

/// Pairs per set, and the number of different shapes in it.
const PAIRS: usize = 240;
const DISTINCT: usize = 16;

const IN_RANGE: &str = "half a metre around the origin is in range";

/// Everything of both dimensions.
pub(super) fn all(quick: bool, progress: &dyn Fn(&str)) -> Vec<VertexRow> {
    let seconds = if quick { 0.1 } else { 1.0 };
    let mut rows = Vec::new();
    for vertices in SOLIDS {
        progress(&format!("vertices, hulls of {vertices}"));
        rows.extend(of_pairs(vertices, &of_solids(vertices), 3.0 * seconds));
    }
    for vertices in POLYGONS {
        progress(&format!("vertices, polygons of {vertices}"));
        rows.extend(of_pairs(vertices, &of_polygons(vertices), 1.5 * seconds));
    }
    rows
}

/// All queries take turns with each other: a query that runs alone, again and again, has its pairs memorised by the
/// processor. So measured, manifolds of polygons of 32 vertices took half the time of their separations, although they
/// cost as much (AMD EPYC, Zen 4, 2026-11-22).
fn of_pairs<P: Grouped + Asked>(vertices: usize, pairs: &[P], seconds: f64) -> Vec<VertexRow> {
    let asked =
        |operation: Operation| P::methods_for(operation, vertices).into_iter().map(move |m| (operation, m));
    let (operations, methods): (Vec<Operation>, Vec<Method<P>>) =
        Operation::ALL.into_iter().flat_map(asked).unzip();
    let samples = in_turns(&methods, pairs, seconds);
    let row = |((operation, method), samples): ((&Operation, &Method<P>), Samples)| {
        let spread = samples.spread()?;
        Some(VertexRow {
            dimension: P::DIMENSION.to_string(),
            operation: operation.name().to_string(),
            method: method.name.to_string(),
            vertices: vertices as u32,
            ns: spread.median,
            ns_low: spread.low,
            ns_high: spread.high,
        })
    };
    operations.iter().zip(&methods).zip(samples).filter_map(row).collect()
}

fn kind(vertices: usize) -> Option<SolidKind> {
    Some(match vertices {
        8 => SolidKind::Hull8,
        16 => SolidKind::Hull16,
        32 => SolidKind::Hull32,
        64 => SolidKind::Hull64,
        128 => SolidKind::Hull128,
        256 => SolidKind::Hull256,
        _ => return None,
    })
}

/// Four points in the directions of a regular tetrahedron's corners.
fn tetrahedron(random: &mut Random) -> Shape3 {
    let corners = [(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)];
    let points = corners.map(|corner| (DVec3::from(corner) * random.range(0.25, 0.35)).as_vec3());
    Hull::from_points(points.as_slice() as &[Vec3]).expect(IN_RANGE).into()
}

/// Pairs of hulls with so many vertices, placed so that their bounding spheres overlap.
fn of_solids(vertices: usize) -> Vec<PosedPair3> {
    let mut random = Random::new(vertices as u64);
    let shapes: Vec<Shape3> = match kind(vertices) {
        Some(kind) => solids(kind, DISTINCT, 1),
        None => (0..DISTINCT).map(|_| tetrahedron(&mut random)).collect(),
    };
    let mut pairs = Vec::with_capacity(PAIRS);
    while pairs.len() < PAIRS {
        let wanted = pairs.len() % 5 >= 2;
        let [shape_a, shape_b] = [0, 1].map(|_| shapes[random.below(DISTINCT)].clone());
        let size = f64::from(shape_a.outer_radius()) + f64::from(shape_b.outer_radius());
        let offset = random.direction() * (size * random.unit());
        let [pose_a, pose_b] =
            [DVec3::ZERO, offset].map(|place| Pose3::new(place, random.rotation()).expect(IN_RANGE));
        if Pair3::new(&shape_a, &pose_a, &shape_b, &pose_b).overlaps() == wanted {
            pairs.push(PosedPair3 { shape_a, pose_a, shape_b, pose_b });
        }
    }
    pairs
}

/// Pairs of ellipses with so many vertices that circles cannot decide: two of five apart, two with a small overlap, one
/// deep.
fn of_polygons(vertices: usize) -> Vec<PosedPair2> {
    let fifth = PAIRS / 5;
    let counts = [(Lie::Apart, 2 * fifth), (Lie::Light, 2 * fifth), (Lie::Deep, fifth)];
    counts.into_iter().flat_map(|(lie, count)| grown::pairs(vertices, lie, count)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_tests::report::Posed;

    #[test]
    fn two_of_five_are_apart_and_all_have_their_vertices() {
        for vertices in [4, 8, 64] {
            let pairs = of_solids(vertices);
            assert_eq!(pairs.iter().filter(|pair| !pair.overlaps()).count(), 2 * PAIRS / 5);
            assert!(pairs.iter().all(|pair| pair.vertices() == 2 * vertices));
        }
        for vertices in [3, 4, 256] {
            let pairs = of_polygons(vertices);
            assert_eq!(pairs.iter().filter(|pair| !pair.overlaps()).count(), 2 * PAIRS / 5);
            assert!(pairs.iter().all(|pair| pair.vertices() == 2 * vertices));
        }
    }

    #[test]
    fn every_method_is_timed_where_it_is_asked() {
        let rows = of_pairs(4, &of_solids(4)[..10], 0.0);
        let of = |operation: &str| rows.iter().filter(|row| row.operation == operation).count();
        assert_eq!((of("boolean"), of("separation"), of("manifold")), (6, 5, 3));
        assert!(rows.iter().all(|row| row.ns > 0.0 && row.ns_low <= row.ns && row.ns <= row.ns_high));
    }
}
