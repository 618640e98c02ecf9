//! Smooth ground of many triangles: a body on it gets the normals of what it touches, and no others.

use super::scenes::{Random, body, mesh};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Shape3, TriMesh};
use asunder_narrow::Pair3;

/// An arc of `facets` facets around the z axis, from -60 to 60 degrees about straight up, with its front outside or
/// inside. The angles come from a rational half-angle formula.
fn arc(facets: usize, radius: f64, is_inside: bool) -> TriMesh {
    let slices = 7;
    let point = |i: usize| {
        let tangent = (i as f64 / facets as f64 * 2.0 - 1.0) * 0.267_949; // of a quarter of the angle
        let half = 2.0 * tangent / (1.0 - tangent * tangent);
        let scale = radius / (1.0 + half * half);
        let (x, y) = (2.0 * half * scale, (1.0 - half * half) * scale);
        if is_inside { (x, -y) } else { (x, y) }
    };
    let vertices: Vec<Vec3> = (0..=slices)
        .flat_map(|slice| (0..=facets).map(move |i| (slice, i)))
        .map(|(slice, i)| {
            let (x, y) = point(i);
            DVec3::new(x, y, f64::from(slice as u32) * 0.7 - 2.45).as_vec3()
        })
        .collect();
    let row = (facets + 1) as u32;
    let mut triangles = Vec::new();
    for slice in 0..slices as u32 {
        for i in 0..facets as u32 {
            let a = slice * row + i;
            triangles.extend([[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]);
        }
    }
    mesh((vertices, triangles))
}

/// The least and the greatest slope, as x over y, of the normals of triangles that lie within `reach` of a box.
fn slopes(ground: &TriMesh, low: Vec3, high: Vec3) -> (f64, f64) {
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for corners in ground.triangles() {
        let [a, b, c] = corners.map(|v| ground.vertices()[v as usize]);
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        if least.cmple(high).all() && most.cmpge(low).all() {
            let normal = (b - a).as_dvec3().cross((c - a).as_dvec3());
            let slope = normal.x / normal.y;
            range = (range.0.min(slope), range.1.max(slope));
        }
    }
    range
}

fn bodies_see_only_what_they_touch(is_inside: bool) -> usize {
    let mut random = Random::new(11);
    let mut seen = 0;
    for facets in [12, 60, 240] {
        for one_sided in [true, false] {
            let mesh = arc(facets, 3.0, is_inside);
            let mesh = if one_sided { mesh.one_sided() } else { mesh };
            let ground: Shape3 = mesh.clone().into();
            for kind in [0, 1, 2, 4, 5] {
                let shape = body(kind);
                for _ in 0..25 {
                    let half = random.between(-0.2, 0.2);
                    let scale = 1.0 / (1.0 + half * half);
                    let (x, y) = (2.0 * half * scale, (1.0 - half * half) * scale);
                    let away = random.between(0.2, 0.5);
                    let (up, radius) = if is_inside { (-y, 3.0 - away) } else { (y, 3.0 + away) };
                    let place = DVec3::new(x * radius, up * radius, random.signed());
                    // Lying on the arc: rotated about z by the same angle.
                    let lean = if is_inside { half } else { -half };
                    let turn = asunder_geometry::glam::Quat::from_xyzw(0.0, 0.0, lean as f32, 1.0);
                    let pose = Pose3::new(place, turn).unwrap();
                    let bounds = shape.bounds(&pose, 0.02);
                    let (least, most) = slopes(&mesh, bounds.min, bounds.max);
                    for manifold in Pair3::new(&shape, &pose, &ground, &Pose3::IDENTITY).manifolds(0.02) {
                        let towards = -manifold.normal.as_dvec3();
                        let slope = towards.x / towards.y;
                        assert!(
                            towards.y > 0.0 && slope >= least - 2e-4 && slope <= most + 2e-4,
                            "{facets} facets, body {kind}: {towards} is not between {least} and {most}"
                        );
                        assert!(towards.z.abs() < 2e-4, "{facets} facets, body {kind}: {towards}");
                        seen += 1;
                    }
                }
            }
        }
    }
    seen
}

#[test]
fn on_a_hill_of_facets_no_normal_is_beyond_those_of_the_facets() {
    let seen = bodies_see_only_what_they_touch(false);
    // Mostly one each: a lift off the facet under the centre frees the body from the others.
    assert!(seen > 300, "only {seen} manifolds");
}

#[test]
fn in_a_hollow_of_facets_no_normal_is_beyond_those_of_the_facets() {
    let seen = bodies_see_only_what_they_touch(true);
    assert!(seen > 500, "only {seen} manifolds");
}

/// A ball that rolls over a faceted hill stays close to it: it is never thrown off, and never sinks in.
#[test]
fn a_ball_over_a_hill_follows_it() {
    let mesh = arc(120, 3.0, false);
    let ground: Shape3 = mesh.one_sided().into();
    let ball = body(4);
    for step in 0..2000_u32 {
        let half = f64::from(step) / 2000.0 * 0.4 - 0.2;
        let scale = 1.0 / (1.0 + half * half);
        let up = DVec3::new(2.0 * half * scale, (1.0 - half * half) * scale, 0.0);
        let pose = Pose3::at(up * 3.39 + DVec3::Z * 0.123).unwrap();
        let manifolds = Pair3::new(&ball, &pose, &ground, &Pose3::IDENTITY).manifolds(0.0);
        let deepest = manifolds.iter().map(|m| m.separation).fold(f32::INFINITY, f32::min);
        // The sagitta of a facet: 3 m (1 - cos 0.5 degrees).
        assert!((f64::from(deepest) + 0.01).abs() < 2e-4, "{deepest}");
        for manifold in &manifolds {
            let angle = (-manifold.normal.as_dvec3()).cross(up).length();
            assert!(angle <= 0.0176, "off by {angle}: more than a facet");
        }
    }
}
