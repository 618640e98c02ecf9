//! What a shape reports about itself: its AABB, support points, containment, bounding ball.

use asunder_geometry::{
    Aabb2, Aabb3, Capsule2, Circle, Compound2, Polygon, Pose2, Pose3, Rect, Shape2, Shape3,
};
use asunder_narrow::{Pair2, Separation2};
use asunder_tests::cases::Random;
use asunder_tests::cores::{pieces2, pieces3};
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};
use glam::{DVec2, DVec3, Vec2};

const ORIGINS: [f64; 5] = [0.0, 1.0, 1e3, 1e7, 9e8];
const SIZES: [f64; 4] = [1.0, 1e-5, 1e5, 0.1];

fn shape3(round: usize, random: &mut Random) -> Shape3 {
    let kind = &KINDS3[round % KINDS3.len()];
    kind.1(&mut Clay::new(random, SIZES[round / KINDS3.len() % SIZES.len()]))
}

fn shape2(round: usize, random: &mut Random) -> Shape2 {
    let kind = &KINDS2[round % KINDS2.len()];
    kind.1(&mut Clay::new(random, SIZES[round / KINDS2.len() % SIZES.len()]))
}

/// The AABB contains the oracles' vertices and radii, and is wider by at most two f32 ulps.
#[test]
fn boxes_of_every_kind_in_space_hold_it_and_little_more() {
    let mut random = Random::new(7400);
    for round in 0..6000 {
        let shape = shape3(round, &mut random);
        let at = random.vector() * ORIGINS[round / 7 % ORIGINS.len()];
        let pose = Pose3::new(at, random.quaternion()).unwrap();
        let margin = random.pick(&[0.0_f32, 0.25]);
        let Aabb3 { min, max } = shape.bounds(&pose, margin);
        if shape.outer_radius().is_infinite() {
            assert!(min.cmpeq(glam::Vec3::NEG_INFINITY).all() && max.cmpeq(glam::Vec3::INFINITY).all());
            continue;
        }
        let pieces = pieces3(&shape, &pose, DVec3::ZERO);
        let reach = |axis: DVec3| reach3(&pieces, axis) + f64::from(margin);
        for axis in 0..3 {
            let unit = DVec3::AXES[axis];
            let (low, high) = (-reach(-unit), reach(unit));
            let noise = 32.0 * f64::EPSILON * (pose.position().length() + shape_reach3(&shape));
            check_side(
                [min[axis], max[axis]],
                [low, high],
                [noise, room(&shape)],
                &format!("{shape:?} at {pose:?}"),
            );
        }
        // And any support point that the shape reports.
        for _ in 0..8 {
            let local = shape.support(random.direction()).unwrap();
            let point = pose.transform(local);
            let noise = 1e-13 * (pose.position().length() + shape_reach3(&shape));
            for axis in 0..3 {
                let (least, most) = (f64::from(min[axis]) - noise, f64::from(max[axis]) + noise);
                assert!(
                    (least..=most).contains(&point[axis]),
                    "{point} outside {min} {max}: {shape:?} {pose:?}"
                );
            }
        }
    }
}

fn reach3(pieces: &[asunder_tests::cores::Piece3], axis: DVec3) -> f64 {
    use asunder_tests::cores::Piece3::Round;
    let reach = |piece: &_| match piece {
        Round { core, radius, .. } => core.reach(axis) + radius,
        _ => f64::INFINITY,
    };
    pieces.iter().map(reach).fold(f64::NEG_INFINITY, f64::max)
}

fn reach2(pieces: &[asunder_tests::cores::Piece2], axis: DVec2) -> f64 {
    use asunder_tests::cores::Piece2::Round;
    let reach = |piece: &_| match piece {
        Round { core, radius } => core.reach(axis) + radius,
        _ => f64::INFINITY,
    };
    pieces.iter().map(reach).fold(f64::NEG_INFINITY, f64::max)
}

fn shape_reach3(shape: &Shape3) -> f64 {
    f64::from(shape.outer_radius()) + f64::from(shape.center().length())
}

fn shape_reach2(shape: &Shape2) -> f64 {
    f64::from(shape.outer_radius()) + f64::from(shape.center().length())
}

/// Vertices of hulls, and so of compounds, are rotated in f32, eight at a time: four units of 2^-24 of a sum of three
/// terms.
fn room(shape: &Shape3) -> f64 {
    let is_of_hulls = matches!(shape, Shape3::Hull(_) | Shape3::Compound(_));
    if is_of_hulls { 5e-7 * shape_reach3(shape) } else { 0.0 }
}

/// Checks one side; `noise` is the error of `low` and `high`, `room` how much wider the AABB may be.
fn check_side([min, max]: [f32; 2], [low, high]: [f64; 2], [noise, room]: [f64; 2], what: &str) {
    let (least, most) = (f64::from(min), f64::from(max));
    assert!(least <= low + noise && most >= high - noise, "{min}..{max} loses {low}..{high}: {what}");
    let step = |v: f64| 2.0 * f64::from((v.abs() as f32).next_up() - v.abs() as f32) + 4.0 * noise + room;
    assert!(least >= low - step(low) && most <= high + step(high), "{min}..{max} for {low}..{high}: {what}");
}

#[test]
fn boxes_of_every_kind_in_the_plane_hold_it_and_little_more() {
    let mut random = Random::new(7401);
    for round in 0..8000 {
        let shape = shape2(round, &mut random);
        let at = random.vector().truncate() * ORIGINS[round / 7 % ORIGINS.len()];
        let pose = Pose2::new(at, random.rotation2()).unwrap();
        let margin = random.pick(&[0.0_f32, 0.25]);
        let Aabb2 { min, max } = shape.bounds(&pose, margin);
        if shape.outer_radius().is_infinite() {
            assert!(min.cmpeq(glam::Vec2::NEG_INFINITY).all() && max.cmpeq(glam::Vec2::INFINITY).all());
            continue;
        }
        let pieces = pieces2(&shape, &pose, DVec2::ZERO);
        let reach = |axis: DVec2| reach2(&pieces, axis) + f64::from(margin);
        for axis in 0..2 {
            let unit = DVec2::AXES[axis];
            let (low, high) = (-reach(-unit), reach(unit));
            let noise = 32.0 * f64::EPSILON * (pose.position().length() + shape_reach2(&shape));
            check_side([min[axis], max[axis]], [low, high], [noise, 0.0], &format!("{shape:?} at {pose:?}"));
        }
    }
}

/// A half-space whose rotated normal is an axis is bounded on that side, and nowhere else.
#[test]
fn a_floor_ends_at_its_own_plane() {
    use asunder_geometry::{HalfPlane, HalfSpace};
    use glam::{Quat, Vec2, Vec3};
    let quarter = Quat::from_xyzw(1.0, 0.0, 0.0, 1.0);
    // A quarter turn about x takes y to z.
    let floor = Shape3::from(HalfSpace::new(Vec3::Y * 7.0).unwrap());
    let bounds = floor.bounds(&Pose3::new([1e7, 2.0, 3.0], quarter).unwrap(), 0.5);
    assert_eq!(bounds.max.truncate(), Vec2::INFINITY);
    assert_eq!(bounds.min, Vec3::NEG_INFINITY);
    assert!(bounds.max.z >= 3.5 && bounds.max.z < 3.500_001);
    let ceiling = Shape2::from(HalfPlane::new(Vec2::NEG_Y).unwrap());
    let bounds = ceiling.bounds(&Pose2::at([0.0, 9.0]).unwrap(), 0.0);
    assert_eq!((bounds.min.x, bounds.max), (f32::NEG_INFINITY, Vec2::INFINITY));
    assert!(bounds.min.y <= 9.0 && bounds.min.y > 8.999_99);
    assert!(floor.support(DVec3::Y).is_none() && floor.core().vertices().is_empty());
}

/// Support points are in the shape, nothing lies beyond them, and the bounding ball contains them; random points of
/// that ball are contained as the oracle says.
#[test]
fn furthest_points_of_every_kind_in_space_are_its_own() {
    let mut random = Random::new(7402);
    for round in 0..1500 {
        let shape = shape3(round, &mut random);
        if shape.outer_radius().is_infinite() {
            continue;
        }
        let pieces = pieces3(&shape, &Pose3::IDENTITY, DVec3::ZERO);
        let (size, center) = (shape_reach3(&shape), shape.center().as_dvec3());
        for _ in 0..40 {
            let direction = random.direction();
            let point = shape.support(direction * random.between(1e-3, 1e3)).unwrap();
            let reach = reach3(&pieces, direction);
            assert!((point.dot(direction) - reach).abs() <= 1e-14 * size, "{point} for {reach}: {shape:?}");
            let on = pieces.iter().map(|piece| piece.outside(point)).fold(f64::INFINITY, f64::min);
            assert!(on.abs() <= 1e-13 * size, "{on} from the surface: {shape:?}");
            let from_center = (point - center).length();
            assert!(
                from_center <= f64::from(shape.outer_radius()) * (1.0 + 1e-14),
                "{from_center}: {shape:?}"
            );
            // Points beyond it by more than rounding are not contained; points within are, if there is an interior.
            assert!(!shape.contains(point + direction * (1e-6 * size)), "beyond {direction}: {shape:?}");
        }
        for _ in 0..10 {
            let point = center + random.vector() * f64::from(shape.outer_radius());
            let outside = pieces.iter().map(|piece| piece.outside(point)).fold(f64::INFINITY, f64::min);
            if outside.abs() > 1e-6 * size {
                assert_eq!(shape.contains(point), outside < 0.0, "{point}, {outside} outside: {shape:?}");
            }
        }
        for axis in DVec3::AXES {
            assert!(!shape.contains(axis * f64::NAN), "nothing holds a NaN: {shape:?}");
            assert!(!shape.contains(axis.with_x(f64::NAN)), "nothing holds a NaN: {shape:?}");
        }
        assert!(shape.support(DVec3::ZERO).is_none() && shape.support(DVec3::NAN).is_none());
        assert!(shape.support(DVec3::INFINITY).is_none());
    }
}

#[test]
fn furthest_points_of_every_kind_in_the_plane_are_its_own() {
    let mut random = Random::new(7403);
    for round in 0..2000 {
        let shape = shape2(round, &mut random);
        if shape.outer_radius().is_infinite() {
            continue;
        }
        let pieces = pieces2(&shape, &Pose2::IDENTITY, DVec2::ZERO);
        let (size, center) = (shape_reach2(&shape), shape.center().as_dvec2());
        for _ in 0..40 {
            let direction = random.direction2();
            let point = shape.support(direction * random.between(1e-3, 1e3)).unwrap();
            let reach = reach2(&pieces, direction);
            // A part's stored rotation has length one only up to rounding, and scales its radius, too.
            assert!((point.dot(direction) - reach).abs() <= 1e-7 * size, "{point} for {reach}: {shape:?}");
            let from_center = (point - center).length();
            assert!(
                from_center <= f64::from(shape.outer_radius()) * (1.0 + 2e-7),
                "{from_center}: {shape:?}"
            );
            assert!(!shape.contains(point + direction * (1e-6 * size)), "beyond {direction}: {shape:?}");
        }
        for _ in 0..10 {
            let offset = random.vector().truncate() * f64::from(shape.outer_radius());
            let point = center + offset;
            let outside = pieces.iter().map(|piece| piece.outside(point)).fold(f64::INFINITY, f64::min);
            if outside.abs() > 1e-6 * size {
                assert_eq!(shape.contains(point), outside < 0.0, "{point}, {outside} outside: {shape:?}");
            }
        }
        for spoilt in [DVec2::new(0.0, f64::NAN), DVec2::new(f64::NAN, 0.0), DVec2::NAN] {
            assert!(!shape.contains(spoilt), "nothing holds a NaN: {shape:?}");
        }
        assert!(shape.support(DVec2::ZERO).is_none() && shape.support(DVec2::NAN).is_none());
    }
}

/// A part's stored rotation, which is of length one up to f32 rounding, stretches its core and not its radius.
///
/// Symptom: a circle in a compound held points that no overlap test found in it, by up to 3e-8 of its radius.
#[test]
fn round_parts_hold_what_overlaps_them() {
    let (mut within, mut beyond, mut stretched) = (0, 0, 0);
    for seed in 0..4000 {
        let random = &mut Random::new(seed + 31_000);
        let size = random.pick(&[0.01, 1.0, 3000.0]);
        let radius = random.between(0.5, 1.0) * size;
        let half = Vec2::new(random.between(0.1, 1.0) as f32, random.between(0.1, 1.0) as f32) * size as f32;
        let shape: Shape2 = match seed % 4 {
            0 => Circle::new(radius as f32).unwrap().into(),
            1 => Capsule2::new(-half, half, radius as f32).unwrap().into(),
            2 => Rect::from_half_extents(half).unwrap().rounded(radius as f32).unwrap().into(),
            _ => {
                Polygon::hull_of(&[half, -half, half.perp()]).unwrap().rounded(radius as f32).unwrap().into()
            }
        };
        let pose = Pose2::new(random.vector().truncate() * size, random.rotation2()).unwrap();
        let length = DVec2::new(pose.rotation().cos().into(), pose.rotation().sin().into()).length();
        let compound: Shape2 = Compound2::new([(pose, shape.clone())]).unwrap().into();
        // On the surface, up to a few f32 roundings: around a corner of the core.
        let core = match seed % 4 {
            0 => DVec2::ZERO,
            _ => half.as_dvec2(),
        };
        let away = half.as_dvec2().normalize();
        let shift = f64::from(seed as u32 % 11) - 5.0;
        let local = pose.turn(core + away * (f64::from(shape.radius()) / length * (1.0 + 1e-8 * shift)));
        let point = pose.position() + local;
        let at = Pose2::at(point).unwrap();
        let dot = Shape2::from(Circle::POINT);
        let pair = Pair2::new(&compound, &Pose2::IDENTITY, &dot, &at);
        let Separation2::Measured(found) = pair.separation(f32::INFINITY) else { panic!("no limit") };
        if f64::from(found.separation).abs() > 1e-12 * size {
            assert_eq!(
                compound.contains(point),
                pair.overlaps(),
                "seed {seed}: {found:?} {shape:?} {pose:?}"
            );
            within += u32::from(pair.overlaps());
            beyond += u32::from(!pair.overlaps());
            stretched += u32::from((length - 1.0).abs() > 1e-8);
        }
    }
    assert!(within > 1000 && beyond > 1000 && stretched > 1000, "{within} {beyond} {stretched}");
}
