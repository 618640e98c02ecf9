//! Mass, centre and inertia of every shape: against exact fractions, textbooks, sampling, and against each other.

mod bodies;
mod exact;

use asunder_geometry::{
    Capsule2, Capsule3, Circle, Cuboid, Hull, MassProperties2, MassProperties3, Polygon, Pose3, Rect, Shape2,
    Shape3, Sphere,
};
use core::f64::consts::PI;
use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};
use oorandom::Rand64;

/// Relative error of sums of a hundred terms, each right to a few roundings.
const ROUNDING: f64 = 1e-13;

fn of2(shape: impl Into<Shape2>) -> MassProperties2 {
    shape.into().mass_properties(1.0).unwrap()
}

fn of3(shape: impl Into<Shape3>) -> MassProperties3 {
    shape.into().mass_properties(1.0).unwrap()
}

fn hull(points: &[Vec3], radius: f32) -> Hull {
    Hull::of_any_dimension(points).unwrap().rounded(radius).unwrap()
}

/// Radius of gyration: errors of the centre are relative to it.
fn gyration(mass: f64, inertia: f64) -> f64 {
    (inertia / mass).sqrt()
}

fn trace(tensor: &DMat3) -> f64 {
    tensor.x_axis.x + tensor.y_axis.y + tensor.z_axis.z
}

fn check2(found: &MassProperties2, wanted: &MassProperties2, tolerance: f64) {
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance * b;
    let place = (found.center - wanted.center).length();
    assert!(near(found.mass, wanted.mass), "{found:?} is not {wanted:?}");
    assert!(near(found.inertia, wanted.inertia), "{found:?} is not {wanted:?}");
    let rounded = 4.0 * f64::EPSILON * wanted.center.length();
    let allowed = tolerance * gyration(wanted.mass, wanted.inertia) + rounded;
    assert!(place <= allowed, "{found:?} is not {wanted:?}");
}

fn check3(found: &MassProperties3, wanted: &MassProperties3, tolerance: f64) {
    assert!((found.mass - wanted.mass).abs() <= tolerance * wanted.mass, "{found:?} is not {wanted:?}");
    let (size, place) = (trace(&wanted.inertia), (found.center - wanted.center).length());
    let furthest =
        (found.inertia - wanted.inertia).to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max);
    assert!(furthest <= tolerance * size, "{furthest} of {size}: {found:?} is not {wanted:?}");
    let rounded = 4.0 * f64::EPSILON * wanted.center.length();
    assert!(place <= tolerance * gyration(wanted.mass, size) + rounded, "{found:?} is not {wanted:?}");
}

/// The least eigenvalue of the second moments over their sum: negative if a principal moment of inertia is negative, or
/// larger than the other two together. By Jacobi rotations.
fn least_spread(inertia: &DMat3) -> f64 {
    let half = trace(inertia) / 2.0;
    let mut c = (DMat3::IDENTITY * half - *inertia).to_cols_array_2d();
    for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(60) {
        if c[p][q] == 0.0 {
            continue;
        }
        let slope = (c[q][q] - c[p][p]) / (2.0 * c[p][q]);
        let tangent = slope.signum() / (slope.abs() + slope.hypot(1.0));
        let cos = 1.0 / tangent.hypot(1.0);
        let sin = tangent * cos;
        for row in &mut c {
            (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
        }
        let (rows_p, rows_q) = (c[p], c[q]);
        for k in 0..3 {
            (c[p][k], c[q][k]) = (cos * rows_p[k] - sin * rows_q[k], sin * rows_p[k] + cos * rows_q[k]);
        }
    }
    c[0][0].min(c[1][1]).min(c[2][2]) / half
}

fn check_possible(found: &MassProperties3) {
    let values = found.inertia.to_cols_array();
    assert!(
        found.mass >= 0.0 && found.center.is_finite() && values.iter().all(|v| v.is_finite()),
        "{found:?}"
    );
    assert_eq!(found.inertia, found.inertia.transpose());
    assert!(found.inertia.x_axis.x >= 0.0 && found.inertia.y_axis.y >= 0.0 && found.inertia.z_axis.z >= 0.0);
    if found.mass > 0.0 {
        assert!(least_spread(&found.inertia) >= -1e-15, "{}: {found:?}", least_spread(&found.inertia));
    }
}

fn whole(random: &mut Rand64, low: i64, high: i64) -> i64 {
    random.rand_range(0..(high - low) as u64) as i64 + low
}

fn cloud(random: &mut Rand64, count: usize, reach: [i64; 3]) -> Vec<[i64; 3]> {
    (0..count).map(|_| reach.map(|reach| whole(random, -reach, reach + 1))).collect()
}

fn points(lattice: &[[i64; 3]], unit: f32) -> Vec<Vec3> {
    lattice.iter().map(|&p| Vec3::from_array(p.map(|value| value as f32 * unit))).collect()
}

/// Exact properties in lattice units, converted to metres. The unit must be a power of two.
fn in_metres(exact: &MassProperties3, unit: f64) -> MassProperties3 {
    let cube = unit * unit * unit;
    let inertia = exact.inertia * (cube * unit * unit);
    MassProperties3 { mass: exact.mass * cube, center: exact.center * unit, inertia }
}

#[test]
fn hulls_weigh_what_exact_fractions_say() {
    let mut random = Rand64::new(1);
    for count in (0..120).map(|i| 4 + i % 11) {
        let lattice = cloud(&mut random, count, [1 << 20; 3]);
        let Some(exact) = exact::solid(&lattice) else { continue };
        let unit = 1.0 / (1 << 20) as f32;
        check3(&of3(hull(&points(&lattice, unit), 0.0)), &in_metres(&exact, f64::from(unit)), ROUNDING);
    }
}

#[test]
fn polygons_weigh_what_exact_fractions_say() {
    let mut random = Rand64::new(2);
    for reach in [[1 << 20, 1 << 20], [1 << 20, 1], [1 << 20, 30], [3, 1 << 23]] {
        for count in 3..40 {
            let cloud: Vec<Vec2> = (0..count)
                .map(|_| Vec2::from_array(reach.map(|reach| whole(&mut random, -reach, reach + 1) as f32)))
                .collect();
            let Ok(polygon) = Polygon::hull_of(&cloud) else { continue };
            let outline: Vec<[i64; 2]> =
                polygon.vertices().iter().map(|v| v.to_array().map(|value| value as i64)).collect();
            // An area is a difference of products: the longer the polygon, the less of them is left. Lattice axes are
            // benign.
            check2(&of2(polygon.clone()), &exact::polygon(&outline), ROUNDING);
            assert_eq!(of2(polygon.rounded(0.0).unwrap()), of2(Polygon::hull_of(&cloud).unwrap()));
        }
    }
}

/// Points about a line or plane oblique to all axes, denser towards the origin, and each with its own last bits.
fn thin_cloud(random: &mut Rand64, thickness: f64, is_plate: bool) -> Vec<Vec3> {
    let mut share = || random.rand_float() * 2.0 - 1.0;
    let mut spread = || (share(), [1.0, 0.1, 1e-2, 1e-3][(share().abs() * 4.0) as usize]);
    let mut point = || {
        let ((s, t), (u, v)) = (spread(), spread());
        let place = DVec3::new(0.49, 0.371, -0.287) * (s * t);
        let place = if is_plate { place + DVec3::new(-0.21, 0.49, 0.21) * (u * v) } else { place };
        (place + DVec3::new(spread().0, spread().0, spread().0) * thickness).as_vec3()
    };
    (0..9).map(|_| point()).collect()
}

#[test]
fn needles_and_plates_weigh_what_exact_fractions_say() {
    let mut random = Rand64::new(3);
    let mut compared = 0;
    for (thickness, is_plate) in
        [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7].into_iter().flat_map(|t| [(t, false), (t, true)])
    {
        for _ in 0..40 {
            // The true shape is the hull of the stored vertices. In units of 2^-50 m every coordinate is an integer.
            const UNITS: f64 = (1_i64 << 50) as f64;
            let whole = |v: &Vec3| v.to_array().map(|value| (f64::from(value) * UNITS) as i64);
            let cloud: Vec<[i64; 3]> =
                thin_cloud(&mut random, thickness, is_plate).iter().map(whole).collect();
            let Ok(hull) = Hull::from_points(&points(&cloud, (1.0 / UNITS) as f32)) else { continue };
            let lattice: Vec<[i64; 3]> = hull.vertices().iter().map(whole).collect();
            let Some(exact) = exact::solid(&lattice) else { continue };
            let found = of3(hull.clone());
            check_possible(&found);
            let lost = f64::EPSILON / thickness;
            check3(&found, &in_metres(&exact, 1.0 / UNITS), 1e-14 + lost);
            compared += 1;
        }
    }
    assert!(compared > 250, "{compared}");
}

#[test]
fn a_hull_or_polygon_far_from_its_origin_loses_nothing() {
    let mut random = Rand64::new(4);
    let mut compared = 0;
    for _ in 0..60 {
        let far = [14_000_000, -5_000_000, 3_000_000];
        let mut lattice = cloud(&mut random, 8, [8; 3]);
        lattice.iter_mut().for_each(|p| *p = core::array::from_fn(|axis| p[axis] + far[axis]));
        let Some(exact) = exact::solid(&lattice) else { continue };
        compared += 1;
        // A metre wide, 900 km away.
        check3(&of3(hull(&points(&lattice, 0.0625), 0.0)), &in_metres(&exact, 0.0625), ROUNDING);
        let flat: Vec<Vec2> = points(&lattice, 0.0625).iter().map(|v| Vec2::new(v.x, v.y)).collect();
        let polygon = Polygon::hull_of(&flat).unwrap();
        let outline: Vec<[i64; 2]> =
            polygon.vertices().iter().map(|v| v.to_array().map(|value| (value * 16.0) as i64)).collect();
        let exact = exact::polygon(&outline);
        let (mass, inertia) = (exact.mass / 256.0, exact.inertia / 65536.0);
        check2(&of2(polygon), &MassProperties2 { mass, center: exact.center / 16.0, inertia }, ROUNDING);
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn balls_discs_and_capsules_are_those_of_the_textbook() {
    let (r, h) = (0.75, 2.0); // radius, height of the part between the caps
    let (disc, ball) = (PI * r * r, 4.0 / 3.0 * PI * r * r * r);
    let round = DMat3::IDENTITY * (0.4 * ball * r * r);
    let sphere = MassProperties3 { mass: ball, center: DVec3::ZERO, inertia: round };
    check3(&of3(Sphere::new(0.75).unwrap()), &sphere, 1e-15);
    let circle = MassProperties2 { mass: disc, center: DVec2::ZERO, inertia: disc * r * r / 2.0 };
    check2(&of2(Circle::new(0.75).unwrap()), &circle, 1e-15);

    let capsule = |h: f64| {
        let cylinder = disc * h;
        let along = cylinder * r * r / 2.0 + 0.4 * ball * r * r;
        let across =
            cylinder * (h * h / 12.0 + r * r / 4.0) + ball * (0.4 * r * r + h * h / 4.0 + 0.375 * h * r);
        (cylinder + ball, along, across)
    };
    let (mass, along, across) = capsule(h);
    let inertia = DMat3::from_diagonal(DVec3::new(across, along, across));
    let found = of3(Capsule3::from_half_height(1.0, 0.75).unwrap());
    check3(&found, &MassProperties3 { mass, center: DVec3::ZERO, inertia }, 1e-14);
    assert_eq!((found.center, found.inertia.x_axis.y, found.inertia.z_axis.y), (DVec3::ZERO, 0.0, 0.0));
    // A slanted and shifted one, about its own axis: n n^T along + (1 - n n^T) across.
    let from = Vec3::new(100.0, 200.0, 300.0);
    let slanted = Capsule3::new(from, from + Vec3::new(1.0, 2.0, -2.0), 0.75).unwrap();
    let (n, (mass, along, across)) = (DVec3::new(1.0, 2.0, -2.0) / 3.0, capsule(3.0));
    let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
    let inertia = outer * along + (DMat3::IDENTITY - outer) * across;
    let center = from.as_dvec3() + n * 1.5;
    check3(&of3(slanted), &MassProperties3 { mass, center, inertia }, 1e-14);

    // A half disc has its centroid at 4 r / 3 pi.
    let caps = disc * (r * r / 2.0 + h * h / 4.0 + 4.0 / 3.0 / PI * h * r);
    let inertia = 2.0 * r * h * (h * h + 4.0 * r * r) / 12.0 + caps;
    let stadium = MassProperties2 { mass: 2.0 * r * h + disc, center: DVec2::ZERO, inertia };
    check2(&of2(Capsule2::from_half_height(1.0, 0.75).unwrap()), &stadium, 1e-14);
}

/// Corners of a box with the given half extents, as integers, rotated by the integer matrix `turn` (rows) over `scale`.
fn turned_box(half: [i64; 3], turn: [[i64; 3]; 3]) -> Vec<[i64; 3]> {
    let corner = |i: i64| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { half[axis] } else { -half[axis] });
    let turned = |c: [i64; 3]| turn.map(|row| row[0] * c[0] + row[1] * c[1] + row[2] * c[2]);
    (0..8).map(|i| turned(corner(i))).collect()
}

#[test]
fn a_round_box_is_the_hull_of_its_corners_however_it_lies() {
    // A rotation by integers over 15: every corner, and so the truth, stays exact.
    let turn = [[11, -2, 10], [10, 5, -10], [-2, 14, 5]];
    let rotation =
        DMat3::from_cols_array_2d(&turn.map(|row| row.map(|value| value as f64 / 15.0))).transpose();
    assert!(
        (rotation * rotation.transpose() - DMat3::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-15)
    );
    for half in [[1, 1, 1], [7, 2, 3], [1, 60, 90], [200, 3, 1]] {
        for radius in [0.0, 0.25, 15.0, 2000.0] {
            let extents = Vec3::from_array(half.map(|value| value as f32 * 15.0));
            let closed = of3(Cuboid::from_half_extents(extents).unwrap().rounded(radius).unwrap());
            let (h, r) = (extents.as_dvec3(), f64::from(radius));
            let steiner = 8.0 * h.x * h.y * h.z
                + 8.0 * (h.x * h.y + h.y * h.z + h.z * h.x) * r
                + 2.0 * PI * (h.x + h.y + h.z) * r * r
                + 4.0 / 3.0 * PI * r * r * r;
            assert!((closed.mass - steiner).abs() < 1e-14 * steiner);
            let upright = points(&turned_box(half, [[15, 0, 0], [0, 15, 0], [0, 0, 15]]), 1.0);
            check3(&of3(hull(&upright, radius)), &closed, ROUNDING);
            let lying = points(&turned_box(half, turn), 1.0);
            let inertia = rotation * closed.inertia * rotation.transpose();
            check3(&of3(hull(&lying, radius)), &MassProperties3 { inertia, ..closed }, ROUNDING);
        }
    }
}

#[test]
fn a_round_rectangle_is_the_hull_of_its_corners_however_it_lies() {
    for (a, b) in [(1.0_f32, 1.0_f32), (7.0, 2.0), (1.0, 600.0)] {
        for radius in [0.0, 0.25, 15.0, 2000.0] {
            let extents = Vec2::new(a, b) * 5.0;
            let rounded = Rect::from_half_extents(extents).unwrap().rounded(radius).unwrap();
            let (h, r) = (extents.as_dvec2(), f64::from(radius));
            let steiner = 4.0 * h.x * h.y + 4.0 * (h.x + h.y) * r + PI * r * r;
            assert!((of2(rounded).mass - steiner).abs() < 1e-14 * steiner);
            // Rotated by a 3-4-5 rotation, which keeps the corners on the lattice.
            let turn = |x: f32, y: f32| Vec2::new(3.0 * x - 4.0 * y, 4.0 * x + 3.0 * y);
            for corners in [rounded.vertices(), [(-a, -b), (a, -b), (a, b), (-a, b)].map(|(x, y)| turn(x, y))]
            {
                let polygon = Polygon::new(&corners).unwrap().rounded(radius).unwrap();
                check2(&of2(polygon), &of2(rounded), ROUNDING);
            }
        }
    }
}

#[test]
fn a_round_tetrahedron_has_the_volume_of_steiners_formula() {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(Vec3::from);
    let side = 8_f64.sqrt();
    // At all 6 edges the surface turns by the supplement of the dihedral angle, whose cosine is a third: atan(sqrt 8) =
    // 1.23095...
    let turn = PI - 1.230_959_417_340_774_7;
    for r in [0.0, 1e-30, 0.125, 1.0, 1000.0_f32] {
        let found = of3(hull(&corners, r));
        let r = f64::from(r);
        let steiner = 8.0 / 3.0
            + 3_f64.sqrt() * side * side * r
            + 3.0 * side * turn * r * r
            + 4.0 / 3.0 * PI * r * r * r;
        let inertia = DMat3::IDENTITY * found.inertia.x_axis.x;
        check3(&found, &MassProperties3 { mass: steiner, center: DVec3::ZERO, inertia }, 1e-14);
    }
}

/// The sum of two, given in the same axes.
fn both(a: &MassProperties3, b: &MassProperties3) -> MassProperties3 {
    MassProperties3::combined(&[*a, *b])
}

#[test]
fn round_halves_and_their_cut_add_up() {
    // For convex sets whose union is convex, inclusion-exclusion holds for the rounded shapes, too: whole + cut = one
    // half + other half.
    let mut random = Rand64::new(5);
    for _ in 0..100 {
        let [x, y, z] = cloud(&mut random, 1, [40; 3])[0];
        let triangle = [[60, 0, 0], [-50 + x / 4, 60, 0], [-50, -70 + y / 4, 0]];
        let (above, below) = ([x / 4, y / 4, 45 + z], [y / 8, x / 8, -45 + z]);
        let with = |tips: &[[i64; 3]]| points(&[&triangle, tips].concat(), 0.0625);
        for radius in [0.001, 0.5, 20.0] {
            let whole = of3(hull(&with(&[above, below]), radius));
            let cut = of3(hull(&with(&[]), radius));
            let halves = both(&of3(hull(&with(&[above]), radius)), &of3(hull(&with(&[below]), radius)));
            check3(&both(&whole, &cut), &halves, ROUNDING);
        }
    }
}

#[test]
fn round_plates_and_their_cut_add_up() {
    let mut random = Rand64::new(6);
    for _ in 0..100 {
        let [x, y, z] = cloud(&mut random, 1, [20; 3])[0];
        // In one plane oblique to all axes: z = x - 2 y.
        let on = |x: i64, y: i64| [x, y, x - 2 * y];
        let (left, right) = (on(-50 + x, y), on(70 + y, z));
        let (low, high) = (on(z, -50), on(0, 60 + x));
        let round = |lattice: &[[i64; 3]]| of3(hull(&points(lattice, 0.0625), 0.75));
        let [from, to] = [low, high].map(|end| points(&[end], 0.0625)[0]);
        let cut = of3(Capsule3::new(from, to, 0.75).unwrap());
        let whole = round(&[left, low, right, high]);
        check3(&both(&whole, &cut), &both(&round(&[left, low, high]), &round(&[low, right, high])), ROUNDING);
        // A flat hull of two points is the capsule itself.
        check3(&round(&[low, high]), &cut, 1e-15);
        let ball = round(&[low]);
        check3(&ball, &MassProperties3 { center: from.as_dvec3(), ..of3(Sphere::new(0.75).unwrap()) }, 1e-15);
    }
}

/// Sampled at the centres of a grid's cells that the shape contains.
fn sampled(shape: &Shape3, cells: usize) -> MassProperties3 {
    let bounds = shape.bounds(&Pose3::IDENTITY, 0.0);
    let (low, step) = (bounds.min.as_dvec3(), (bounds.max - bounds.min).as_dvec3() / cells as f64);
    let place =
        |i: usize| DVec3::new((i % cells) as f64, (i / cells % cells) as f64, (i / cells / cells) as f64);
    let held: Vec<DVec3> = (0..cells * cells * cells)
        .map(|i| low + (place(i) + 0.5) * step)
        .filter(|&point| shape.contains(point))
        .collect();
    let cell = step.x * step.y * step.z;
    let center = held.iter().copied().fold(DVec3::ZERO, |sum, p| sum + p) / held.len() as f64;
    let mut inertia = DMat3::ZERO;
    for point in &held {
        let d = *point - center;
        inertia += DMat3::IDENTITY * d.length_squared() - DMat3::from_cols(d * d.x, d * d.y, d * d.z);
    }
    MassProperties3 { mass: held.len() as f64 * cell, center, inertia: inertia * cell }
}

#[test]
fn round_hulls_weigh_what_a_fine_grid_holds() {
    let mut random = Rand64::new(7);
    for _ in 0..6 {
        let lattice = cloud(&mut random, 8, [64, 40, 20]);
        let radius = 0.125 + random.rand_float() as f32;
        let shape = Shape3::from(hull(&points(&lattice, 0.0625), radius));
        // Some 3 N^2 cells are cut, each wrong by at most a half, with either sign equally often.
        check3(&of3(shape.clone()), &sampled(&shape, 90), 1e-3);
    }
}
