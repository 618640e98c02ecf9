//! The fast paths against the general one: the same answers, on random patches of ground.

use super::facet::Furthest;
use super::*;
use crate::answer::Manifold3;
use crate::counted::steps_of;
use crate::numbers::Numbers;
use asunder_geometry::glam::{Quat, Vec2, Vec3};
use asunder_geometry::{Cuboid, HeightField, Hull, Segment3, Sphere, TriMesh};

impl Numbers {
    /// Bumps of some height over cells of a metre, flat ground among them; one-sided or two-sided.
    fn patch(&mut self) -> Shape3 {
        let height = [0.0, 0.05, 0.3, 1.5][self.below(4) as usize];
        let vertex = |i: u32, up: f64| Vec3::new((i % 5) as f32 - 2.0, up as f32, (i / 5) as f32 - 2.0);
        let vertices: Vec<Vec3> = (0..25).map(|i| vertex(i, self.number() * height)).collect();
        let cell = |i: u32| [[i, i + 5, i + 1], [i + 1, i + 5, i + 6]];
        let triangles: Vec<[u32; 3]> =
            (0..20).filter(|i| i % 5 < 4).flat_map(cell).filter(|_| self.below(12) > 0).collect();
        let mesh = TriMesh::new(vertices, triangles).unwrap();
        if self.below(2) == 0 { mesh.into() } else { mesh.one_sided().into() }
    }

    fn body(&mut self) -> Shape3 {
        let size = [0.1, 0.4, 1.0][self.below(3) as usize];
        let half = ((self.vector().abs() + 0.1) * size).as_vec3();
        let round = if self.below(3) == 0 { 0.1 } else { 0.0 };
        match self.below(3) {
            0 => Sphere::new(size as f32).unwrap().into(),
            1 => Cuboid::from_half_extents(half).unwrap().rounded(round).unwrap().into(),
            _ => {
                let points: Vec<Vec3> = (0..16).map(|_| (self.vector() * size).as_vec3()).collect();
                Hull::from_points(&points).unwrap().rounded(round).unwrap().into()
            }
        }
    }

    fn rotation(&mut self) -> Quat {
        match self.below(3) {
            0 => Quat::IDENTITY,
            _ => Quat::from_xyzw(0.2, self.number() as f32, self.number() as f32, -0.4).normalize(),
        }
    }
}

fn contacts_of(pair: &Pair3, is_plain: bool) -> (Option<bool>, Vec<Manifold3>) {
    let mut manifolds = Vec::new();
    let on = OnGround::of(pair).expect("one is ground");
    let found = contact_by(pair, &on, [0.02, 0.0], &mut Some(&mut manifolds), is_plain);
    (found, manifolds)
}

#[test]
fn fast_paths_agree_with_the_general_path() {
    let mut numbers = Numbers::new(8);
    let (mut touching, mut apart, mut points) = (0, 0, 0);
    for round in 0..6000 {
        let (ground, body) = (numbers.patch(), numbers.body());
        let at = Pose3::new(numbers.vector() * DVec3::new(1.5, 0.8, 1.5), numbers.rotation()).unwrap();
        let under = Pose3::new(numbers.vector() * [0.0, 1e-3][round % 2], Quat::IDENTITY).unwrap();
        let pair = Pair3::new(&body, &at, &ground, &under);
        let ((short, by_short), (plain, by_plain)) = (contacts_of(&pair, false), contacts_of(&pair, true));
        let context = format!("{round}: {body:?} at {at:?}\n{by_short:#?}\n{by_plain:#?}");
        assert_eq!(short, plain, "{context}");
        assert_eq!(by_short.len(), by_plain.len(), "{context}");
        for (one, other) in by_short.iter().zip(&by_plain) {
            assert_eq!([one.part_a, one.part_b], [other.part_a, other.part_b], "{context}");
            assert!((one.normal - other.normal).length() <= 1e-6, "{context}");
            assert!((one.separation - other.separation).abs() <= one.error + other.error, "{context}");
            assert_eq!(one.points.len(), other.points.len(), "{context}");
            for (one, other) in one.points.iter().zip(&other.points) {
                assert_eq!(one.feature, other.feature, "{context}");
                assert!((one.anchor_a - other.anchor_a).length() <= 1e-5, "{context}");
                assert!((one.anchor_b - other.anchor_b).length() <= 1e-5, "{context}");
            }
            points += one.points.len();
        }
        // For spheres, to the last bit.
        assert!(!matches!(body, Shape3::Sphere(_)) || by_short == by_plain, "{context}");
        touching += usize::from(short == Some(true));
        apart += usize::from(short.is_none());
    }
    assert!(touching > 1500 && apart > 1000 && points > 5000, "{touching} {apart} {points}");
}

/// A rod's end beside an edge, less than a picometre away: along the triangle's normal it is as far below the plane, so
/// that a point is made, but the reported separation is a gap.
#[test]
fn what_is_a_hair_apart_is_beyond_a_margin_of_zero() {
    let ends = [[-0.19427104, 0.12651876, -0.54291815], [-0.24687144, 0.772727, 0.110613234]].map(Vec3::from);
    let rod = Shape3::from(Segment3::new(ends[0], ends[1]).unwrap());
    let corners = [
        [-0.55388564, 0.6238234, -0.52682],
        [0.34605, 0.42008463, -0.86538863],
        [0.43734345, -0.21932538, 0.90064514],
    ];
    let ground = Shape3::from(TriMesh::new(corners.map(Vec3::from), [[0, 1, 2]]).unwrap());
    let at = Pose3::new(DVec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.70710677, -0.70710677)).unwrap();
    let place = DVec3::new(-0.00012648984419429463, 0.001000080046595707, 0.0036906442459535005);
    let under = Pose3::at(place).unwrap();
    let pair = Pair3::new(&rod, &at, &ground, &under);
    assert!(!pair.overlaps());
    assert!(pair.distance().is_some_and(|closest| closest.distance < 1e-12));
    assert_eq!((pair.manifold(0.0), pair.manifolds(0.0)), (None, vec![]), "beyond the margin");
    let near = pair.manifold(1e-12).expect("within the margin");
    assert!(near.separation > 0.0 && near.separation <= 1e-12);
}

/// A hull as ground whose fronts face outwards.
fn surface(hull: &Hull) -> TriMesh {
    let topology = hull.topology();
    let fans = (0..topology.face_count()).flat_map(|face| {
        let around: Vec<u32> = topology.face_vertices(face).map(|vertex| vertex as u32).collect();
        (2..around.len()).map(|i| [around[0], around[i - 1], around[i]]).collect::<Vec<_>>()
    });
    TriMesh::new(hull.vertices().to_vec(), fans.collect::<Vec<_>>()).unwrap()
}

/// Whichever feature of the nearest triangle is nearest to a point: Baerentzen and Aanaes prove that the normals around
/// that feature give the side.
#[test]
fn a_point_is_in_front_of_the_nearest_triangle_of_a_hull_exactly_if_it_is_outside() {
    let mut numbers = Numbers::new(31);
    let (mut outside, mut by_plane_it_is_not, mut inside) = (0, 0, 0);
    for round in 0..300 {
        // Needles and blades, at whose edges and corners the planes say little about the side.
        let thin = DVec3::new(1.0, [1.0, 0.2, 0.05][round % 3], [1.0, 0.1, 0.3][round / 3 % 3]);
        let points: Vec<Vec3> =
            (0..4 + numbers.below(8)).map(|_| (numbers.vector() * thin).as_vec3()).collect();
        let Ok(hull) = Hull::from_points(&points) else { continue };
        let shape = Shape3::from(surface(&hull));
        let ground = asunder_geometry::Ground::of(&shape).unwrap();
        for sample in 0..40 {
            let point = if sample % 4 == 0 {
                // Between two vertices and the middle: inside.
                let some =
                    [0, 1].map(|_| hull.vertices()[numbers.below(hull.vertices().len() as u64) as usize]);
                let sum = some.iter().fold(hull.center().as_dvec3(), |sum, vertex| sum + vertex.as_dvec3());
                sum / 3.0
            } else {
                numbers.vector() * thin * 1.5
            };
            let facets = (0..ground.triangle_count()).filter_map(|i| Facet::front_of(i, ground.corners(i)));
            let distance = |facet: &Facet| match nearest_to(facet, point) {
                (Furthest::Face, _) => facet.height(point).abs(),
                (_, at) => (at - point).length(),
            };
            let Some(nearest) = facets.min_by(|one, other| distance(one).total_cmp(&distance(other))) else {
                continue;
            };
            if distance(&nearest) < 1e-6 {
                continue;
            }
            let is_outside = !hull.contains(point);
            assert_eq!(nearest.has_in_front(ground, point), is_outside, "{round}: {point} {points:?}");
            let mut from_behind = nearest;
            from_behind.turn_over();
            assert_eq!(from_behind.has_in_front(ground, point), !is_outside, "{round}: {point} {points:?}");
            inside += usize::from(!is_outside);
            outside += usize::from(is_outside);
            by_plane_it_is_not += usize::from(is_outside && nearest.height(point) < 0.0);
        }
    }
    assert!(
        outside > 3000 && inside > 200 && by_plane_it_is_not > 300,
        "{outside} {inside} {by_plane_it_is_not}"
    );
}

/// Symptom: whether a world was free for a cube of 60 m on a height field took 44 ms. Cause: yes or no was read off its
/// manifolds, which visit all triangles.
#[test]
fn yes_or_no_of_wide_ground_ends_with_the_first_yes() {
    let heights: Vec<f32> = (0..129 * 129).map(|i| ((i * 7919) % 13) as f32 * 0.01).collect();
    let field = HeightField::new(129, 129, heights, Vec2::ONE).unwrap();
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(30.0)).unwrap());
    let at = Pose3::at([64.3, 15.0, 64.7]).unwrap();
    for ground in [field.clone(), field.one_sided()].map(Shape3::from) {
        let pair = Pair3::new(&cube, &at, &ground, &Pose3::IDENTITY);
        let (manifolds, all) = steps_of(|| pair.manifolds(0.0));
        let (is_yes, few) = steps_of(|| pair.overlaps_front());
        assert!(is_yes && !manifolds.is_empty());
        // A triangle takes one step at least: there are two in each of 3,600 cells.
        assert!(all > 7000 && few < 100, "{few} steps, and {all} for manifolds");
    }
}
