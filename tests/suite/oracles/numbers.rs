//! Double-double against big integers, and exact facets against the slow way to find them.

use asunder_geometry::Hull;
use asunder_tests::cases::Random;
use asunder_tests::integers::{in_unit, last_exponent};
use asunder_tests::precise::dd::Dd;
use asunder_tests::precise::facets::Polyhedron;
use asunder_tests::solid::Solid;
use glam::{DVec3, Vec3};
use num_bigint::BigInt;
use std::collections::BTreeSet;

/// Everything here is a multiple of 2^`UNIT`.
const UNIT: i32 = -400;

fn exactly(value: Dd) -> BigInt {
    value.parts().iter().map(|&part| in_unit(part, UNIT)).sum()
}

/// A random double-double: 106 bits, either sign, magnitude within 2^-40 to 2^40.
fn any(random: &mut Random) -> Dd {
    let scale = f64::from_bits(((1023 + random.below(81) as u64) - 40) << 52);
    let high = random.signed() * scale;
    let low = random.pick(&[0.0, 1.0, -1.0, 0.3]) * random.signed() * high * f64::EPSILON * 0.5;
    Dd::sum(high, low)
}

/// Whether `found` is within a relative 2^-102 of `truth`; both may be scaled by one positive factor.
fn is_close(found: &BigInt, truth: &BigInt) -> bool {
    let magnitude = BigInt::from(truth.magnitude().clone());
    let error = BigInt::from((found - truth).magnitude().clone());
    error << 102_usize <= magnitude
}

#[test]
fn double_double_is_right_to_2_to_the_minus_102() {
    let mut random = Random::new(910);
    for round in 0..20_000 {
        let (p, mut q) = (any(&mut random), any(&mut random));
        if round % 4 == 0 {
            // Sums with nearly full cancellation.
            q = Dd::from(-p.to_f64()) + q * Dd::from(1e-20);
        }
        let (x, y) = (exactly(p), exactly(q));
        assert!(is_close(&exactly(p + q), &(&x + &y)), "{p:?} + {q:?}");
        assert!(is_close(&exactly(p - q), &(&x - &y)), "{p:?} - {q:?}");
        assert!(is_close(&(exactly(p * q) << UNIT.unsigned_abs() as usize), &(&x * &y)), "{p:?} * {q:?}");
        if q != Dd::ZERO {
            // p / q times q, in units of UNIT squared.
            let back = exactly(p / q) * &y;
            assert!(is_close(&back, &(&x << UNIT.unsigned_abs() as usize)), "{p:?} / {q:?}");
        }
        let root = exactly(p.abs().sqrt());
        let square = BigInt::from(x.magnitude().clone()) << UNIT.unsigned_abs() as usize;
        // Squaring doubles the relative error.
        assert!(is_close(&(&root * &root / 2), &(square / 2)) || p == Dd::ZERO, "sqrt {p:?}");
        assert_eq!(p < q, x < y, "{p:?} < {q:?}");
    }
    assert_eq!(last_exponent(0.0), None);
}

#[test]
fn differences_of_f64_are_kept_whole() {
    let mut random = Random::new(911);
    for _ in 0..1000 {
        let (p, q) = (any(&mut random).to_f64(), any(&mut random).to_f64());
        assert_eq!(exactly(Dd::difference(p, q)), in_unit(p, UNIT) - in_unit(q, UNIT), "{p} - {q}");
    }
}

/// Checks everything that two hulls of the same points, found in two ways, must have in common.
fn same_facets_and_edges(points: &[Vec3]) {
    let solid = Solid::of_vertices(points);
    let form = Polyhedron::of(&points.iter().map(|p| p.as_dvec3()).collect::<Vec<DVec3>>());
    let sets = |facets: &[Vec<usize>]| -> BTreeSet<BTreeSet<usize>> {
        facets.iter().map(|facet| facet.iter().copied().collect()).collect()
    };
    let slowly: Vec<Vec<usize>> = solid.facets.iter().map(|facet| facet.corners.clone()).collect();
    assert_eq!(sets(&form.facets), sets(&slowly), "{points:?}");
    let edges: BTreeSet<[usize; 2]> = form.edges.iter().map(|edge| edge.ends).collect();
    let slow_edges: BTreeSet<[usize; 2]> = solid.edges.iter().copied().collect();
    assert_eq!(edges, slow_edges, "{points:?}");
    assert!(form.is_solid && form.edges.iter().all(|edge| edge.beside.len() == 2));
    for facet in &form.facets {
        let [p, q, r] = [0, 1, 2].map(|i| points[facet[i]].as_dvec3());
        let normal = (q - p).cross(r - p);
        let middle = points.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / points.len() as f64;
        assert!(normal.dot(middle - p) < 0.0, "counter-clockwise from outside: {facet:?} of {points:?}");
    }
}

#[test]
fn facets_found_by_wrapping_are_those_of_all_triples() {
    let mut random = Random::new(912);
    for _ in 0..200 {
        same_facets_and_edges(random.shape3().core().vertices());
    }
    let mut lattices = 0;
    while lattices < 300 {
        let points: Vec<Vec3> =
            (0..8).map(|_| Vec3::from_array([0; 3].map(|_| random.below(4) as f32))).collect();
        // The library keeps only the corners, so both are given those.
        if let Ok(hull) = Hull::from_points(&points) {
            same_facets_and_edges(hull.vertices());
            lattices += 1;
        }
    }
}

#[test]
fn what_is_flat_has_one_facet_seen_from_both_sides() {
    let square = [DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::X + DVec3::Z, DVec3::X * 0.5];
    let form = Polyhedron::of(&square);
    assert_eq!((form.facets.len(), form.edges.len(), form.is_solid), (2, 4, false));
    let form = Polyhedron::of(&[DVec3::ONE, DVec3::ZERO, DVec3::splat(0.25)]);
    assert_eq!((form.facets.len(), form.edges.len(), form.edges[0].ends), (0, 1, [1, 0]));
    let form = Polyhedron::of(&[DVec3::ONE]);
    assert_eq!((form.facets.len(), form.edges.len()), (0, 0));
}
