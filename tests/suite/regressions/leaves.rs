//! Sheets drawn from both sides, as leaves and fences are: every triangle occurs twice, with opposite winding.

use asunder::{Capsule3, Cuboid, Hull, Manifold3, Pair3, Pose3, Ray3, Shape3, Sphere, TriMesh, cast_ray3};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_tests::cases::Random;

/// A fence in the plane z = 0: once two-sided, and once one-sided with every triangle doubled, wound the other way.
fn fences() -> [Shape3; 2] {
    let (columns, rows) = (6, 3);
    let place = |number: u32| {
        let at = [number % (columns + 1), number / (columns + 1)].map(|at| at as f32);
        Vec3::new(at[0] / 3.0, at[1] / 3.0, 0.0)
    };
    let vertices: Vec<Vec3> = (0..(columns + 1) * (rows + 1)).map(place).collect();
    let fronts: Vec<[u32; 3]> = (0..columns * rows)
        .flat_map(|cell| {
            let near = cell / columns * (columns + 1) + cell % columns;
            let far = near + columns + 1;
            [[near, near + 1, far + 1], [near, far + 1, far]]
        })
        .collect();
    let backs = fronts.iter().map(|&[a, b, c]| [b, a, c]);
    let both: Vec<[u32; 3]> = fronts.iter().copied().chain(backs).collect();
    let one_sided = TriMesh::new(vertices.clone(), both).unwrap().one_sided();
    [TriMesh::new(vertices, fronts).unwrap().into(), one_sided.into()]
}

fn body(number: usize) -> Shape3 {
    match number % 4 {
        0 => Sphere::new(0.4).unwrap().into(),
        1 => Cuboid::from_half_extents(Vec3::new(0.3, 0.4, 0.2)).unwrap().into(),
        2 => Capsule3::from_half_height(0.3, 0.2).unwrap().into(),
        _ => Hull::prism(0.3, 0.4, 7).unwrap().into(),
    }
}

/// Symptom: a fence whose triangles all occurred twice, once for each side, let everything through from behind once it
/// was made one-sided. Cause: of two triangles with the same vertices the second was dropped, whatever its winding.
#[test]
fn a_sheet_drawn_from_both_sides_stands_in_the_way_of_both() {
    let fences = fences();
    let mut random = Random::new(0x1EAF);
    let (mut casts, mut contacts, mut rays) = (0, 0, 0);
    let least = |found: &[Manifold3]| found.iter().map(|one| one.separation).fold(f32::INFINITY, f32::min);
    for case in 0..6000 {
        let body = body(case);
        let within = |random: &mut Random, low: [f64; 3], high: [f64; 3]| {
            DVec3::from([0, 1, 2].map(|axis| random.between(low[axis], high[axis])))
        };
        let from = within(&mut random, [-1.5; 3], [3.5, 2.5, 1.5]);
        let to = within(&mut random, [-0.5, -0.3, -0.5], [2.5, 1.3, 0.5]);
        let pose = |at: DVec3, random: &mut Random| Pose3::new(at, random.quaternion()).unwrap();
        let (far, near) = (pose(from, &mut random), pose(to, &mut random));
        let way = ((to - from) * random.between(0.5, 2.0)).as_vec3();

        let met = fences.each_ref().map(|fence| Pair3::new(&body, &far, fence, &Pose3::IDENTITY).cast(way));
        let [two, one] = met.map(|impact| impact.map(|impact| (impact.fraction, impact.normal)));
        let is_same = match (two, one) {
            (Some((at, normal)), Some((then, other))) => {
                (at - then).abs() < 1e-8 && (normal - other).length() < 1e-5
            }
            (two, one) => two == one,
        };
        assert!(is_same, "{case}: {body:?} from {far:?} by {way}: {two:?} and {one:?}");
        casts += usize::from(two.is_some());

        let told =
            fences.each_ref().map(|fence| Pair3::new(&body, &near, fence, &Pose3::IDENTITY).manifolds(0.02));
        let [two, one] = told.each_ref().map(|found| least(found));
        assert!(two == one || (two - one).abs() < 1e-6, "{case}: {body:?} at {near:?}: {two} and {one}");
        contacts += usize::from(!told[0].is_empty());

        let ray = Ray3::new(from, way).unwrap();
        let [two, one] = fences.each_ref().map(|fence| cast_ray3(fence, &Pose3::IDENTITY, &ray, 1.0));
        let [two, one] = [two, one].map(|hit| hit.map(|hit| hit.distance));
        assert_eq!(two, one, "{case}: {ray:?}");
        rays += usize::from(two.is_some());
    }
    assert!(casts > 4000 && contacts > 3000 && rays > 1000, "{casts} {contacts} {rays}");
}
