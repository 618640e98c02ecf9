use super::*;
use crate::answer::{Closest3, Measured3, Separation3};
use crate::feature::Hint;
use crate::numbers::Numbers;
use crate::polyhedron::convex::{Probe, Query, Wanted};
use asunder_geometry::Sphere;
use asunder_geometry::glam::Quat;

/// A cuboid and a sphere, with their poses.
#[derive(Debug)]
struct Case {
    shapes: [Shape3; 2],
    poses: [Pose3; 2],
    half: DVec3,
    /// The sphere's centre in the cuboid's axes, up to rounding.
    center: DVec3,
}

impl Case {
    /// Centres inside, on faces, on the borders between nearest features, on corners, in the middle, and anywhere;
    /// spheres of no radius, rounded cuboids, bodies far from the origin, sizes of all kinds.
    fn new(numbers: &mut Numbers) -> Self {
        let size = f64::from(1_u32 << numbers.below(24)) / 4096.0;
        let half = (numbers.vector().abs() * 0.8 + 0.2) * size;
        let half = half.as_vec3().as_dvec3();
        let mut center = numbers.vector() * [0.5, 1.5, 4.0][numbers.below(3) as usize] * size;
        match numbers.below(6) {
            0 => center = center.clamp(half * -0.99, half * 0.99),
            1 => center = (center.clamp(-half, half)).with_x(half.x),
            2 => center = center.with_y(-half.y),
            3 => center = half.with_z(-half.z),
            4 => center = DVec3::ZERO,
            _ => {}
        }
        let rotation = match numbers.below(2) {
            0 => Quat::IDENTITY,
            _ => Quat::from_xyzw(0.2, numbers.number() as f32, numbers.number() as f32, -0.4),
        };
        let far = [0.0, 1.0, 1e6][numbers.below(3) as usize];
        let at = Pose3::new((numbers.vector() * far).round(), rotation).unwrap();
        let other = Quat::from_xyzw(numbers.number() as f32, 0.3, numbers.number() as f32, 0.1);
        let there = Pose3::new(at.transform(center), other).unwrap();
        let sphere = match numbers.below(3) {
            0 => Sphere::POINT,
            _ => Sphere::new((numbers.number().abs() * size) as f32 + 1e-6).unwrap(),
        };
        let cuboid = Cuboid::from_half_extents(half.as_vec3()).unwrap();
        let round = if numbers.below(3) == 0 { (numbers.number().abs() * size) as f32 } else { 0.0 };
        let shapes = [cuboid.rounded(round).unwrap().into(), sphere.into()];
        Self { shapes, poses: [at, there], half, center }
    }

    fn pair(&self) -> Pair3<'_> {
        Pair3::new(&self.shapes[0], &self.poses[0], &self.shapes[1], &self.poses[1])
    }

    fn swapped(&self) -> Pair3<'_> {
        Pair3::new(&self.shapes[1], &self.poses[1], &self.shapes[0], &self.poses[0])
    }

    /// Whether another feature of the cuboid, or another face from inside, is nearly as near.
    fn is_on_a_border(&self) -> bool {
        let (mut over, slack) = ((self.center.abs() - self.half).to_array(), 1e-2 * self.half.max_element());
        if over.iter().any(|over| over.abs() < slack) {
            return true;
        }
        over.sort_by(f64::total_cmp);
        over[2] < 0.0 && (over[2] - over[1] < slack || self.center.abs().min_element() < slack)
    }
}

fn cases() -> impl Iterator<Item = Case> {
    let mut numbers = Numbers::new(7);
    (0..12_000).map(move |_| Case::new(&mut numbers))
}

fn measured(pair: &Pair3) -> Measured3 {
    match pair.separation(f32::INFINITY) {
        Separation3::Measured(measured) => measured,
        Separation3::AtLeast(_) => unreachable!("no limit"),
    }
}

#[test]
fn the_closed_form_agrees_with_the_search() {
    let (mut inside, mut gaps, mut named) = (0, 0, 0);
    for case in cases() {
        let pair = case.pair();
        let found = measured(&pair);
        let bases = pair.bases();
        let parts = [(pair.shape_a, &bases[0]), (pair.shape_b, &bases[1])];
        let [a, b] = parts.map(|(shape, basis)| Part::whole(shape, basis));
        let convex = &pair.parts(&bases, a, b).convex;
        let query = Query { limit: f64::INFINITY, hint: Hint::NONE, wanted: Wanted::Points };
        let (probe, touch) = convex.contact_of_solids(query);
        let Probe::Near(near) = probe else { unreachable!("no limit") };
        let off = (f64::from(found.separation) - f64::from(near.separation)).abs();
        assert!(
            off <= f64::from(found.error) + f64::from(near.error),
            "{found:?} {}: {case:?}",
            near.separation
        );
        assert_eq!(pair.overlaps(), near.verdict.overlapping, "{case:?}");
        assert_eq!(found.separation <= 0.0, near.verdict.overlapping, "{case:?}");
        assert!((found.normal.length() - 1.0).abs() < 2e-7);
        gaps += usize::from(found.separation > 0.0);
        inside += usize::from(case.center.abs().cmplt(case.half).all());
        // On a border rounding decides, and faces are preferred there to features that are hardly nearer.
        if !case.is_on_a_border() {
            named += 1;
            let manifold = pair.manifold(f32::MAX).unwrap();
            assert_eq!(manifold.points[0].feature, touch.points[0].feature, "{case:?}");
            let normal = bases[0].turn(touch.normal).as_vec3();
            assert!((manifold.normal - normal).length() < 1e-6, "{normal} {manifold:?}: {case:?}");
        }
    }
    assert!(inside > 2000 && gaps > 2000 && named > 2000, "{inside} {gaps} {named}");
}

#[test]
fn the_general_path_gives_the_same_bits() {
    for case in cases() {
        for pair in [case.pair(), case.swapped()] {
            let bases = pair.bases();
            let parts = [(pair.shape_a, &bases[0]), (pair.shape_b, &bases[1])];
            let [a, b] = parts.map(|(shape, basis)| Part::whole(shape, basis));
            let mut deepest = crate::room::Deepest(None);
            let query = Query { limit: reach_of(0.5), hint: Hint::NONE, wanted: Wanted::Points };
            let parts = pair.parts(&bases, a, b);
            let _ = parts.contact(query, 0.5, &mut deepest);
            assert_eq!(parts.convex.verdict(), pair.verdict(), "{case:?}");
            let manifold = pair.manifold(0.5);
            assert_eq!(manifold.is_some(), deepest.0.is_some(), "{case:?}");
            let (Some(mut one), Some(mut other)) = (manifold, deepest.0) else { continue };
            // Points of the general path were rotated there and back.
            for (one, other) in one.points.iter_mut().zip(&mut other.points) {
                let reach = f64::from(pair.size()) * 1e-6;
                assert!(one.anchor_a.distance(other.anchor_a) < reach as f32, "{one:?} {other:?}");
                assert!(one.anchor_b.distance(other.anchor_b) < reach as f32, "{one:?} {other:?}");
                (one.anchor_a, one.anchor_b) = (other.anchor_a, other.anchor_b);
            }
            assert_eq!(one, other, "{case:?}");
        }
    }
}

#[test]
fn both_orders_mirror_each_other() {
    for case in cases() {
        let (pair, swapped) = (case.pair(), case.swapped());
        assert_eq!(pair.verdict(), swapped.verdict());
        let (one, other) = (measured(&pair), measured(&swapped));
        assert_eq!(one, Measured3 { normal: -other.normal, ..other }, "{case:?}");
        let turned = swapped.distance().map(|closest| Closest3 {
            normal: -closest.normal,
            anchor_a: closest.anchor_b,
            anchor_b: closest.anchor_a,
            part_a: closest.part_b,
            part_b: closest.part_a,
            distance: closest.distance,
            error: closest.error,
        });
        assert_eq!(pair.distance(), turned, "{case:?}");
        if let Some(manifold) = pair.manifold(0.0) {
            let mirrored = swapped.manifold(0.0).unwrap();
            let (point, mirrored) = (&manifold.points[0], &mirrored.points[0]);
            assert_eq!((point.anchor_a, point.anchor_b), (mirrored.anchor_b, mirrored.anchor_a));
            assert_eq!(point.feature, FeatureId::new(mirrored.feature.b(), mirrored.feature.a()));
        }
    }
}

#[test]
fn a_scene_of_another_size_has_the_same_answers() {
    for case in cases() {
        for scale in [1.0 / 64.0, 32.0_f32] {
            let Shape3::Cuboid(cuboid) = &case.shapes[0] else { unreachable!("it is one") };
            let Shape3::Sphere(sphere) = &case.shapes[1] else { unreachable!("it is one") };
            let scaled = Cuboid::from_half_extents(cuboid.half_extents() * scale);
            let scaled = scaled.map(|scaled| scaled.rounded(cuboid.radius() * scale));
            let sphere = match sphere.radius() {
                0.0 => Ok(Sphere::POINT),
                radius => Sphere::new(radius * scale),
            };
            let (Ok(Ok(scaled)), Ok(sphere)) = (scaled, sphere) else { continue };
            let shapes = [scaled.into(), sphere.into()];
            let poses = case
                .poses
                .map(|pose| Pose3::new(pose.position() * f64::from(scale), pose.rotation()).unwrap());
            let pair = Pair3::new(&shapes[0], &poses[0], &shapes[1], &poses[1]);
            let (one, other) = (measured(&case.pair()), measured(&pair));
            assert_eq!(one.normal, other.normal, "{case:?}");
            // The least positive number stands for a gap lost in rounding, and does not scale.
            let least = f32::from_bits(1);
            let scaled = if one.separation == least { least } else { one.separation * scale };
            assert_eq!(scaled, other.separation, "{case:?}");
        }
    }
}

#[test]
fn the_middle_looks_out_of_the_lowest_of_the_nearest_faces() {
    let at = Pose3::IDENTITY;
    let point = Shape3::from(Sphere::POINT);
    let faces = [
        (Vec3::new(1.0, 1.0, 1.0), Vec3::ZERO, 0, -1.0),
        (Vec3::new(2.0, 1.0, 1.0), Vec3::ZERO, 2, -1.0),
        (Vec3::new(2.0, 3.0, 1.0), Vec3::ZERO, 4, -1.0),
        (Vec3::new(1.0, 1.0, 1.0), Vec3::new(0.25, -0.25, 0.25), 1, -0.75),
        (Vec3::new(1.0, 1.0, 1.0), Vec3::new(0.25, -0.5, 0.5), 2, -0.5),
    ];
    for (half, center, face, separation) in faces {
        let cuboid = Shape3::from(Cuboid::from_half_extents(half).unwrap());
        let manifold = Pair3::new(&cuboid, &at, &point, &Pose3::at(center).unwrap()).manifold(0.0).unwrap();
        assert_eq!(manifold.normal, Cuboid::NORMALS[face as usize].as_vec3());
        assert_eq!(manifold.separation, separation);
        assert_eq!(manifold.points[0].feature, FeatureId::new(Feature::Face(face), Feature::Vertex(0)));
        assert_eq!(manifold.points[0].anchor_b, Vec3::ZERO);
    }
}

#[test]
fn touching_is_decided_exactly_on_faces_edges_and_corners() {
    let half = DVec3::new(1.0, 2.0, 3.0);
    let cuboid = Shape3::from(Cuboid::from_half_extents(half.as_vec3()).unwrap());
    let at = Pose3::IDENTITY;
    // Vectors of whole length, out of a face, an edge and a corner.
    let ways = [([0.0, 5.0, 0.0], 5.0), ([3.0, 0.0, 4.0], 5.0), ([2.0, 3.0, 6.0], 7.0)];
    for (way, radius) in ways.map(|(way, radius)| (DVec3::from(way), radius)) {
        let sphere = Shape3::from(Sphere::new(radius).unwrap());
        let free = DVec3::select(way.cmpgt(DVec3::ZERO), DVec3::ONE, DVec3::new(0.25, -0.5, 0.125));
        for corner in 0..8 {
            let sign = |axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
            let signs = DVec3::new(sign(0), sign(1), sign(2));
            // Some units in the last place nearer and further: less than f64 can tell after a rotation.
            for (longer, overlapping) in
                [(-8.0 * f64::EPSILON, true), (0.0, true), (8.0 * f64::EPSILON, false)]
            {
                let there = Pose3::at((half * free + way * (1.0 + longer)) * signs).unwrap();
                let pair = Pair3::new(&cuboid, &at, &sphere, &there);
                assert_eq!(pair.verdict(), Verdict { overlapping, tier: Tier::Exact }, "{pair:?}");
                assert_eq!(Pair3::new(&sphere, &there, &cuboid, &at).verdict(), pair.verdict());
                assert_eq!(measured(&pair).separation <= 0.0, overlapping, "{pair:?}");
            }
        }
    }
}
