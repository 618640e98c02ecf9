//! Tests of ground against plain loops over all triangles.

mod fields;
mod meshes;
mod plain;
mod refused;
mod walks;

use crate::ground::{Ground, Prominent};
use crate::mesh::{DroppedTriangles, TriMesh};
use crate::shape::Shape3;
use meshes::{Named, all};
use plain::Plain;

fn mesh_of(given: &Named) -> TriMesh {
    TriMesh::new(given.vertices.clone(), given.triangles.clone())
        .unwrap_or_else(|e| panic!("{}: {e}", given.name))
}

/// Each mesh, two-sided and one-sided, with its reference by plain loops.
fn all_by_sides(mut check: impl FnMut(&Named, &TriMesh, &Plain)) {
    for given in all() {
        let mesh = mesh_of(&given);
        check(&given, &mesh, &Plain::of(&given, false));
        check(&given, &mesh.one_sided(), &Plain::of(&given, true));
    }
}

/// A simple random generator with a short period.
struct Dice(u64);

impl Dice {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    fn below(&mut self, count: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(count)) as u32
    }

    /// From 0 to 1.
    fn share(&mut self) -> f32 {
        self.below(1 << 24) as f32 / (1 << 24) as f32
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.share()
    }
}

#[test]
fn dropped_triangles_are_those_that_plain_loops_drop_and_the_others_keep_their_numbers() {
    let mut seen = DroppedTriangles::default();
    all_by_sides(|given, mesh, plain| {
        let (mut degenerate, mut duplicate) = (0, 0);
        for number in 0..given.triangles.len() as u32 {
            assert_eq!(mesh.is_dropped(number), !plain.is_kept(number), "{} {number}", given.name);
            let wanted = plain.is_kept(number).then(|| plain.corners(number));
            assert_eq!(mesh.triangle(number).map(|triangle| triangle.vertices()), wanted, "{}", given.name);
            if let Some(triangle) = mesh.triangle(number) {
                let [a, b, c] = triangle.vertices();
                assert_eq!(crate::Triangle3::new(a, b, c), Ok(triangle));
            }
            degenerate += usize::from(plain.is_degenerate(number));
            duplicate += usize::from(!plain.is_kept(number) && !plain.is_degenerate(number));
        }
        assert_eq!(mesh.dropped(), DroppedTriangles { degenerate, duplicate }, "{}", given.name);
        seen.degenerate += degenerate;
        seen.duplicate += duplicate;
    });
    assert!(seen.degenerate > 10 && seen.duplicate > 20, "{seen:?}");
}

#[test]
fn neighbors_are_those_that_plain_loops_find_and_know_each_other() {
    let (mut joined, mut ends) = (0, 0);
    all_by_sides(|given, mesh, plain| {
        for number in 0..given.triangles.len() as u32 {
            for edge in 0..3 {
                let found = mesh.neighbor(number, edge);
                assert_eq!(found, plain.neighbor(number, edge), "{} {number} {edge}", given.name);
                if let Some((other, twin)) = found {
                    assert_eq!(mesh.neighbor(other, twin), Some((number, edge)), "{}", given.name);
                    let (from, to) = (mesh.vertex_numbers(number), mesh.vertex_numbers(other));
                    let there = [to[(twin + 1) % 3], to[twin]];
                    assert_eq!([from[edge], from[(edge + 1) % 3]], there, "{}", given.name);
                    joined += 1;
                } else {
                    ends += 1;
                }
            }
        }
    });
    assert!(joined > 2000 && ends > 2000, "{joined} {ends}");
}

#[test]
fn edges_and_corners_are_prominent_where_angles_say_so() {
    let mut counts = [0; 4];
    all_by_sides(|given, mesh, plain| {
        for number in 0..given.triangles.len() as u32 {
            let found = mesh.prominent(number);
            assert_eq!(found, plain.prominent(number), "{} {number}", given.name);
            for side in [true, false] {
                counts[usize::from(side)] += usize::from(found.any_edge(side));
                counts[2 + usize::from(side)] += usize::from(!found.any(side));
            }
        }
    });
    assert!(counts.iter().all(|&count| count > 200), "{counts:?}");
}

#[test]
fn patches_are_the_planes_that_plain_loops_find() {
    let (mut alone, mut together) = (0, 0);
    all_by_sides(|given, mesh, plain| {
        let patches = plain.patches();
        for number in 0..given.triangles.len() as u32 {
            assert_eq!(mesh.patch(number), patches[number as usize], "{} {number}", given.name);
            alone += usize::from(mesh.patch(number) == number);
            together += usize::from(mesh.patch(number) != number);
        }
    });
    assert!(alone > 300 && together > 300, "{alone} {together}");
}

#[test]
fn a_flat_grid_is_one_patch_and_only_its_rim_is_prominent() {
    let given = meshes::grid("flat", 20, |_, _| 0.0);
    let mesh = mesh_of(&given);
    for number in 0..mesh.triangle_count() {
        assert_eq!(mesh.patch(number), 0);
        for edge in 0..3 {
            let is_rim = mesh.neighbor(number, edge).is_none();
            assert_eq!([true, false].map(|side| mesh.prominent(number).edge(edge, side)), [is_rim; 2]);
        }
    }
}

#[test]
fn a_gently_curved_surface_does_not_become_one_patch() {
    // Each step bends by a fifth of the tolerance.
    let bend = 1e-5_f64;
    let height = |column: u32, _: u32| (f64::from(column * column) * 0.5 * bend) as f32;
    let mesh = mesh_of(&meshes::grid("bowl", 64, height));
    let mut patches: Vec<u32> = (0..mesh.triangle_count()).map(|number| mesh.patch(number)).collect();
    patches.sort_unstable();
    patches.dedup();
    // Slopes of up to 64 bends, 5 of them in a patch.
    assert!((10..=64).contains(&patches.len()), "{}", patches.len());
}

#[test]
fn vertices_at_one_place_have_one_number_the_least() {
    let soup = meshes::soup("soup", 6);
    let mesh = mesh_of(&soup);
    assert_eq!(mesh.vertices(), soup.vertices, "kept as given");
    let mut numbers: Vec<u32> = mesh.triangles().as_flattened().to_vec();
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers.len(), 49, "of a grid of seven by seven");
    for &number in &numbers {
        let place = soup.vertices[number as usize];
        assert_eq!(soup.vertices.iter().position(|&vertex| vertex == place), Some(number as usize));
    }
}

#[test]
fn a_point_is_on_a_mesh_exactly_if_it_is_on_a_triangle() {
    let mut on = 0;
    for given in all() {
        let mesh = mesh_of(&given);
        let mut dice = Dice::new(5);
        for _ in 0..60 {
            let number = dice.below(given.triangles.len() as u32);
            let [a, b, c] = mesh.corners(number).map(|corner| corner.as_dvec3());
            let shift = if dice.below(2) == 0 { 0.0 } else { f64::from(dice.share()) * 1e-3 };
            let point = [a, (a + b) * 0.5, (a + b + c) / 3.0][dice.below(3) as usize] + shift;
            let wanted = (0..mesh.triangle_count())
                .any(|number| mesh.triangle(number).is_some_and(|triangle| triangle.contains(point)));
            assert_eq!(mesh.contains(point), wanted, "{} {point}", given.name);
            on += usize::from(wanted);
        }
        assert!(!mesh.contains(glam::DVec3::NAN) && !mesh.contains(glam::DVec3::INFINITY));
    }
    assert!(on > 200, "{on}");
}

#[test]
fn numbers_without_a_triangle_never_panic() {
    let mesh = mesh_of(&meshes::messy("messy"));
    let field = fields::random(5, 4, 3);
    for shape in [Shape3::from(mesh), Shape3::from(field)] {
        let Some(ground) = Ground::of(&shape) else { panic!("{shape:?}") };
        for number in
            [ground.triangle_count(), ground.triangle_count() + 1, u32::MAX / 3, u32::MAX - 1, u32::MAX]
        {
            assert_eq!(ground.triangle(number), None);
            assert_eq!((ground.prominent(number), ground.patch(number)), (Prominent::NONE, number));
            for edge in [0, 1, 2, 3, usize::MAX] {
                assert_eq!(ground.neighbor(number, edge), None);
            }
            let _ = (ground.corners(number), ground.vertex_numbers(number));
        }
    }
}

#[test]
fn posed_boxes_hold_every_vertex_and_are_tight_where_nothing_turns() {
    use glam::{DVec3, Quat};
    for given in all() {
        let mesh = mesh_of(&given);
        for (position, rotation) in [
            (DVec3::ZERO, Quat::IDENTITY),
            (DVec3::new(1e6, -7.0, 1e3), Quat::from_xyzw(0.3, -0.5, 0.2, 0.7)),
        ] {
            let pose = crate::Pose3::new(position, rotation).unwrap();
            let bounds = mesh.bounds(&pose, 0.25);
            let (center, radius) = (mesh.center().as_dvec3(), f64::from(mesh.outer_radius()));
            let mut reach = 0.0_f64;
            for number in (0..mesh.triangle_count()).filter(|&number| !mesh.is_dropped(number)) {
                for corner in mesh.corners(number) {
                    let there = pose.transform(corner);
                    assert!((bounds.min.as_dvec3().cmple(there - 0.2499)).all(), "{}", given.name);
                    assert!((bounds.max.as_dvec3().cmpge(there + 0.2499)).all(), "{}", given.name);
                    reach = reach.max((corner.as_dvec3() - center).length());
                }
            }
            assert!(reach <= radius && radius <= reach * (1.0 + 1e-6), "{} {reach} {radius}", given.name);
        }
    }
}

#[test]
fn equal_data_is_equal_ground() {
    let given = meshes::messy("messy");
    let mesh = mesh_of(&given);
    assert_eq!(mesh, mesh.clone());
    assert_eq!(mesh, mesh_of(&given));
    assert_ne!(mesh, mesh.clone().one_sided());
    assert_ne!(mesh, mesh_of(&meshes::soup("soup", 6)));
    let field = fields::random(5, 4, 3);
    assert_eq!(field, fields::random(5, 4, 3));
    assert_ne!(field, fields::random(5, 4, 4));
    assert_ne!(field, field.clone().one_sided());
    let cell = (0..4).flat_map(|c| (0..3).map(move |r| (c, r))).find(|&(c, r)| !field.is_hole(c, r)).unwrap();
    assert_ne!(field, field.clone().with_holes([cell]).unwrap());
}
