//! Feature ids of points between bodies that stand squarely on each other, or edge to edge: they persist while the
//! bodies tremble.
//!
//! Symptom: in a stack of unit cubes that trembled by 1e-5 m to 1e-3 m, up to one point in sixteen had another feature
//! id in every frame, and a solver did not find it again: six cubes still shook after 20 seconds. Cause: a corner was
//! now a hair inside the other's side and now outside, and was named after what it lay on: a vertex of one, of the
//! other, or two edges that cross.

use super::frames::frame;
use super::pair3;
use asunder_geometry::{Cuboid, Polygon, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3};
use asunder_narrow::{FeatureId, Hint, Pair2};
use asunder_tests::cases::{Case3, Random, prism};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// How far bodies tremble, as a share of their size.
const TREMBLES: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];

const FRAMES: usize = 200;

const SQUARE: [Vec2; 4] =
    [Vec2::new(-0.5, -0.5), Vec2::new(0.5, -0.5), Vec2::new(0.5, 0.5), Vec2::new(-0.5, 0.5)];

fn cube(half: f32, radius: f32) -> Shape3 {
    Cuboid::from_half_extents(Vec3::splat(half)).unwrap().rounded(radius).unwrap().into()
}

/// A shape that stands on another at a place, slightly sunk in, and turned about y and tilted by at most `tremble`.
fn standing(random: &mut Random, [below, above]: &[Shape3; 2], at: DVec3, tremble: f64) -> Case3 {
    let shift = random.vector() * tremble;
    let [x, y, z] = random.vector().to_array().map(|c| 0.5 * c * tremble);
    let turn = Quat::from_xyzw(0.1 * x as f32, y as f32, 0.1 * z as f32, 1.0);
    Case3 {
        shape_a: below.clone(),
        pose_a: Pose3::IDENTITY,
        shape_b: above.clone(),
        pose_b: Pose3::new(at + shift.with_y(0.1 * shift.y), turn).unwrap(),
    }
}

/// The feature ids that a pair's points have in all frames, with hints and without.
fn names_that_stay(random: &mut Random, shapes: &[Shape3; 2], at: DVec3, tremble: f64) -> Vec<FeatureId> {
    let (mut hint, mut first): (_, Option<Vec<FeatureId>>) = (Hint::NONE, None);
    for _ in 0..FRAMES {
        let case = standing(random, shapes, at, tremble);
        let (manifold, next) = frame(&case, hint, 0.01);
        hint = next;
        for manifold in [manifold, pair3(&case).manifold(0.01).unwrap()] {
            let names: Vec<_> = manifold.points.iter().map(|point| point.feature).collect();
            assert!(names.is_sorted_by(|one, other| one < other), "each once: {names:?}");
            let first = first.get_or_insert_with(|| names.clone());
            assert_eq!(first, &names, "by {tremble}: {case:?}");
        }
    }
    first.unwrap()
}

#[test]
fn solids_that_stand_squarely_on_each_other_keep_the_names_of_their_points() {
    let mut random = Random::new(2026);
    for tremble in TREMBLES {
        for [below, above] in [
            [cube(0.5, 0.0), cube(0.5, 0.0)],
            [cube(0.5, 0.0), cube(0.4, 0.1)],
            [prism(&SQUARE, 0.5), cube(0.5, 0.0)],
        ] {
            assert_eq!(names_that_stay(&mut random, &[below, above], DVec3::Y * 0.9995, tremble).len(), 4);
        }
        // A brick offset by half on its like: its edge runs along the other's, its corners lie on the other's sides.
        let brick = cube(0.5, 0.0);
        let at = DVec3::new(0.5, 0.9995, 0.0);
        assert_eq!(names_that_stay(&mut random, &[brick.clone(), brick], at, tremble).len(), 4);
    }
}

#[test]
fn outlines_that_stand_squarely_on_each_other_keep_the_names_of_their_points() {
    let mut random = Random::new(2027);
    let square: Shape2 = Rect::from_half_extents(Vec2::splat(0.5)).unwrap().into();
    let polygon: Shape2 = Polygon::new(&SQUARE).unwrap().into();
    for tremble in TREMBLES {
        for (below, above) in [(&square, &square), (&square, &polygon), (&polygon, &polygon)] {
            let mut first: Option<Vec<FeatureId>> = None;
            for _ in 0..FRAMES {
                let at = DVec2::new(random.signed() * tremble, 0.9995 + 0.1 * tremble * random.signed());
                let turn = Rotation2::from_angle((0.1 * tremble * random.signed()) as f32).unwrap();
                let pose = Pose2::new(at, turn).unwrap();
                let manifold = Pair2::new(below, &Pose2::IDENTITY, above, &pose).manifold(0.01).unwrap();
                let names: Vec<_> = manifold.points.iter().map(|point| point.feature).collect();
                assert_eq!(names.len(), 2, "{manifold:?}");
                assert_eq!(first.get_or_insert_with(|| names.clone()), &names, "by {tremble}: {manifold:?}");
            }
        }
    }
}

/// Symptom: for two rounded rectangles, one tilted by a hundredth, one corner was reported as two points 5 mm apart.
/// Cause: a clipped end that was already present was recognised by its feature id, which changed when the edge was
/// clipped again, further out.
#[test]
fn a_rounded_corner_is_one_point() {
    let rect: Shape2 = Rect::from_half_extents(Vec2::new(1.0, 0.3)).unwrap().rounded(0.5).unwrap().into();
    for step in 0..400 {
        let turn = Rotation2::from_angle(5e-5 * step as f32).unwrap();
        for height in [1.594, 1.5945, 1.59] {
            let pose = Pose2::new(DVec2::new(0.0, height), turn).unwrap();
            let manifold = Pair2::new(&rect, &Pose2::IDENTITY, &rect, &pose).manifold(0.0).unwrap();
            if let [one, other] = manifold.points[..] {
                let apart = (one.anchor_a - other.anchor_a).length();
                assert!(apart > 1.0, "{apart} m, turned by {step} times 5e-5: {manifold:?}");
            }
        }
    }
}
