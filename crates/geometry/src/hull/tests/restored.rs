//! Tests that hulls are restored bit for bit from what is stored of them.

use super::clouds::{KINDS, nasty, thinner_than_rounding};
use crate::hull::Hull;
use crate::hull::restore::StoredHullError;
use glam::Vec3;

/// Compares `Debug` output as well, which prints numbers so that they read back as the same bits.
fn assert_comes_back(hull: &Hull, what: &str) {
    let restored = Hull::restored(hull.vertices(), hull.loops(), hull.error());
    let restored = restored.unwrap_or_else(|error| panic!("{error}: {what}: {:?}", hull.vertices()));
    assert!(
        restored == *hull && format!("{restored:?}") == format!("{hull:?}"),
        "{what}: {:?}",
        hull.vertices()
    );
}

#[test]
fn every_hull_comes_back_bit_for_bit() {
    let mut dimensions = [0; 4];
    let mut inexact = 0;
    for seed in 0..100 * KINDS {
        let points = nasty(seed);
        let limit = 4 + seed as usize % 12;
        let made =
            [Hull::from_points(&points), Hull::of_any_dimension(&points), Hull::simplify(&points, limit)];
        for hull in made.into_iter().flatten() {
            assert_comes_back(&hull, &format!("seed {seed}"));
            dimensions[usize::from(hull.dimension())] += 1;
            inexact += usize::from(hull.error() > 0.0);
        }
    }
    assert!(dimensions[3] > 3000 && dimensions[2] > 100 && inexact > 1000, "{dimensions:?}, {inexact}");
}

#[test]
fn a_thousand_round_hulls_and_low_ones_come_back() {
    for seed in 0..1000_u64 {
        let random = &mut super::clouds::Random::new(seed);
        let points: Vec<Vec3> = (0..4 + random.below(250)).map(|_| random.sphere()).collect();
        assert_comes_back(&Hull::of_any_dimension(&points).unwrap(), "sphere");
        let turn = random.turn();
        let low: Vec<Vec3> = points.iter().map(|p| turn * Vec3::new(p.x, 0.0, 0.0)).collect();
        for count in [1, 2, 3] {
            assert_comes_back(&Hull::of_any_dimension(&low[..count]).unwrap(), "line");
        }
        let mut flat: Vec<Vec3> = points.iter().map(|p| Vec3::new(p.y.round(), p.x, p.x)).collect();
        random.shuffle(&mut flat);
        assert_comes_back(&Hull::of_any_dimension(&flat).unwrap(), "plane");
    }
}

/// Symptom: `scaled` by one turned flat hulls around and renumbered their vertices, since inner points had oriented them.
#[test]
fn what_lies_within_a_flat_hull_does_not_orient_it() {
    let mut with_inner_points = 0;
    for seed in 0..1000_u64 {
        let random = &mut super::clouds::Random::new(seed);
        let points: Vec<Vec3> = (0..4 + random.below(40))
            .map(|_| random.sphere())
            .map(|p| Vec3::new((4.0 * p.x).round(), 3.0 * p.y, 3.0 * p.y))
            .collect();
        let hull = Hull::of_any_dimension(&points).unwrap();
        let corners_alone = Hull::of_any_dimension(hull.vertices()).unwrap();
        assert_eq!(format!("{hull:?}"), format!("{corners_alone:?}"), "seed {seed}");
        with_inner_points += usize::from(hull.vertices().len() < points.len());
    }
    assert!(with_inner_points > 900, "{with_inner_points}");
}

#[test]
fn what_is_thinner_than_rounding_comes_back() {
    for seed in 0..5000 {
        if let Ok(hull) = Hull::of_any_dimension(&thinner_than_rounding(seed)) {
            assert_comes_back(&hull, &format!("seed {seed}"));
        }
    }
}

/// Symptom: on a plate 3e-14 thick, merged faces were further from flat than stored ones may be.
#[test]
fn faces_that_grow_out_of_their_plane_are_facets() {
    let points = [
        (1.3254032e-7, -3.5830903e-14, 0.0),
        (5.819945e-20, -2.3813492e-25, -0.6132314),
        (0.903376, -5.540068e-25, -0.30114028),
        (0.0007407181, -4.772981e-13, -0.06359551),
        (-0.6171715, -5.3434194e-25, -0.83721524),
        (0.0, 0.0, 3.3123969e-25),
        (2.5109666e-11, 0.0, 0.0),
        (0.0, -1.4299785e-20, 0.0),
    ];
    let points = points.map(Vec3::from);
    let hull = Hull::from_points(&points).unwrap();
    assert_eq!(hull.check(&points), Ok(()));
    assert_comes_back(&hull, "a plate");
}

/// Measures the planarity error of hulls built here relative to their size, from which the bound for stored ones is
/// derived.
#[test]
fn no_hull_comes_near_the_bound_on_what_merging_leaves() {
    let mut most = 0.0_f64;
    for seed in 0..100 * KINDS {
        let points = nasty(seed);
        for hull in [Hull::of_any_dimension(&points), Hull::simplify(&points, 8)].into_iter().flatten() {
            let share =
                f64::from(hull.planarity_error()) / super::super::cloud::half_diagonal(hull.vertices());
            if hull.dimension() == 3 {
                most = most.max(share);
            }
        }
    }
    let bound = crate::tolerance::MERGED_PLANARITY;
    println!("{} of the bound", most / bound);
    assert!(most < 0.5 * bound && most > 0.05 * bound, "{most} of {bound}");
}

#[test]
fn what_is_no_hull_is_refused() {
    let cube: Vec<Vec3> =
        (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
    let hull = Hull::from_points(&cube).unwrap();
    let loops = hull.loops();
    let refused = |vertices: &[Vec3], faces: Vec<Vec<u16>>, error: f32| {
        Hull::restored(vertices, faces, error).expect_err("this is no hull")
    };
    let swapped = |i: usize, vertex: Vec3| {
        let mut vertices = cube.clone();
        vertices[i] = vertex;
        refused(&vertices, loops.clone(), 0.0)
    };
    assert_eq!(swapped(0, Vec3::ONE), StoredHullError::Repeated);
    assert!(matches!(swapped(3, Vec3::NAN), StoredHullError::Points(_)));
    assert!(matches!(swapped(7, Vec3::splat(0.9)), StoredHullError::NotConvex { .. }));
    assert!(matches!(swapped(7, Vec3::splat(1.1)), StoredHullError::NotConvex { .. }));
    assert_eq!(refused(&cube, loops[1..].to_vec(), 0.0), StoredHullError::Open);
    assert_eq!(
        refused(&cube, loops.clone(), f32::NAN).to_string(),
        "stored hull: NaN m is no error of a hull"
    );
    assert_eq!(refused(&[], vec![], 0.0).to_string().split(':').next(), Some("stored hull"));
    let changed = |change: fn(&mut Vec<Vec<u16>>)| {
        let mut faces = loops.clone();
        change(&mut faces);
        refused(&cube, faces, 0.0)
    };
    assert_eq!(changed(|faces| faces.swap(0, 1)), StoredHullError::OutOfOrder);
    assert_eq!(changed(|faces| faces[2].rotate_left(1)), StoredHullError::OutOfOrder);
    assert_eq!(changed(|faces| faces[2][1] = 8), StoredHullError::BadLoop { face: 2 });
    assert_eq!(changed(|faces| faces[2][1] = faces[2][0]), StoredHullError::BadLoop { face: 2 });
    assert_eq!(changed(|faces| faces[2].truncate(2)), StoredHullError::BadLoop { face: 2 });
    assert_eq!(changed(|faces| faces[2].reverse()), StoredHullError::Open);
    let inside_out = changed(|faces| faces.iter_mut().for_each(|face| face.reverse()));
    assert!(!matches!(inside_out, StoredHullError::OutOfOrder), "{inside_out}");
    assert_eq!(changed(Vec::clear), StoredHullError::Open);
}
