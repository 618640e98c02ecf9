//! The short ways against the general one: the same answers, on random patches of ground.

use super::*;
use crate::answer::Manifold3;
use crate::numbers::Numbers;
use asunder_geometry::glam::{Quat, Vec3};
use asunder_geometry::{Cuboid, Hull, Sphere, TriMesh};

impl Numbers {
    /// Bumps of some height over cells of a metre, flat ground among them; solid from one side, or from both.
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

fn asked(pair: &Pair3, is_plain: bool) -> (Option<bool>, Vec<Manifold3>) {
    let mut manifolds = Vec::new();
    let found = contact_by(pair, 0.02, &mut Some(&mut manifolds), is_plain);
    (found.expect("one is ground"), manifolds)
}

#[test]
fn short_ways_say_what_the_general_way_says() {
    let mut numbers = Numbers::new(8);
    let (mut touching, mut apart, mut points) = (0, 0, 0);
    for round in 0..6000 {
        let (ground, body) = (numbers.patch(), numbers.body());
        let at = Pose3::new(numbers.vector() * DVec3::new(1.5, 0.8, 1.5), numbers.rotation()).unwrap();
        let under = Pose3::new(numbers.vector() * [0.0, 1e-3][round % 2], Quat::IDENTITY).unwrap();
        let pair = Pair3::new(&body, &at, &ground, &under);
        let ((short, by_short), (plain, by_plain)) = (asked(&pair, false), asked(&pair, true));
        let told = format!("{round}: {body:?} at {at:?}\n{by_short:#?}\n{by_plain:#?}");
        assert_eq!(short, plain, "{told}");
        assert_eq!(by_short.len(), by_plain.len(), "{told}");
        for (one, other) in by_short.iter().zip(&by_plain) {
            assert_eq!([one.part_a, one.part_b], [other.part_a, other.part_b], "{told}");
            assert!((one.normal - other.normal).length() <= 1e-6, "{told}");
            assert!((one.separation - other.separation).abs() <= one.error + other.error, "{told}");
            assert_eq!(one.points.len(), other.points.len(), "{told}");
            for (one, other) in one.points.iter().zip(&other.points) {
                assert_eq!(one.feature, other.feature, "{told}");
                assert!((one.anchor_a - other.anchor_a).length() <= 1e-5, "{told}");
                assert!((one.anchor_b - other.anchor_b).length() <= 1e-5, "{told}");
            }
            points += one.points.len();
        }
        // Of spheres, to the last bit.
        assert!(!matches!(body, Shape3::Sphere(_)) || by_short == by_plain, "{told}");
        touching += usize::from(short == Some(true));
        apart += usize::from(short.is_none());
    }
    assert!(touching > 1500 && apart > 1000 && points > 5000, "{touching} {apart} {points}");
}
