//! What is requested is drawn, at its place, and nothing else.

use super::SHAPES;
use asunder::glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use asunder::{
    Aabb2, Aabb3, Chain, Collider2, Collider3, Cuboid, DebugLine, DebugOptions, HalfPlane, HalfSpace,
    HeightField, Motion3, Plane, Pose2, Pose3, Rect, Volume, World2, World3,
};
use asunder_tests::cases::Random;
use asunder_tests::engine::Engine;
use std::collections::BTreeMap;

const NOTHING: DebugOptions = DebugOptions { shapes: false, ..SHAPES };
const ALL: DebugOptions =
    DebugOptions { shapes: true, boxes: true, columns: true, contacts: true, normals: true, ..SHAPES };

fn drawn3(world: &World3, options: &DebugOptions) -> Vec<([DVec3; 2], DebugLine)> {
    let mut lines = Vec::new();
    world.debug_lines(options, &mut |from, to, what| lines.push(([from, to], what)));
    lines
}

/// The plane's lines as lines in space.
fn drawn2(world: &World2, options: &DebugOptions) -> Vec<([DVec3; 2], DebugLine)> {
    let mut lines = Vec::new();
    world.debug_lines(options, &mut |from, to, what| {
        lines.push(([from, to].map(|end| end.extend(0.0)), what))
    });
    lines
}

/// How often each line occurs, in either direction. No end is a NaN or a -0.
fn counted(lines: impl IntoIterator<Item = [DVec3; 2]>) -> BTreeMap<[[u64; 3]; 2], usize> {
    let mut counts = BTreeMap::new();
    for ends in lines {
        let mut ends = ends.map(|end| (end + 0.0).to_array().map(f64::to_bits));
        ends.sort_unstable();
        *counts.entry(ends).or_default() += 1;
    }
    counts
}

/// The edges of a box: pairs of corners that differ in one coordinate.
fn edges(low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
    let sides =
        |axis: usize| if low[axis] == high[axis] { vec![low[axis]] } else { vec![low[axis], high[axis]] };
    let of_xy = |x: f64| sides(1).into_iter().map(move |y| (x, y));
    let of_xyz = |(x, y): (f64, f64)| sides(2).into_iter().map(move |z| DVec3::new(x, y, z));
    let corners: Vec<DVec3> = sides(0).into_iter().flat_map(of_xy).flat_map(of_xyz).collect();
    let pairs =
        corners.iter().enumerate().flat_map(|(i, &from)| corners[..i].iter().map(move |&to| [from, to]));
    pairs.filter(|[from, to]| from.cmpne(*to).bitmask().count_ones() == 1).collect()
}

fn of_kind(lines: &[([DVec3; 2], DebugLine)], kind: DebugLine) -> impl Iterator<Item = [DVec3; 2]> {
    lines.iter().filter(move |(_, what)| *what == kind).map(|(ends, _)| *ends)
}

/// AABBs are those of the last update, whatever moved since; with the margin, and none for disabled, removed or
/// unbounded bodies.
#[test]
fn boxes_are_drawn_by_their_edges() {
    let mut random = Random::new(910);
    let (mut world, mut flat) = (World3::new(), World2::new());
    let (mut solid, mut plane) = (Vec::new(), Vec::new());
    let options = DebugOptions { boxes: true, ..NOTHING };
    for number in 0..60 {
        let body = asunder::Volume::random_body(&mut random, 9.0);
        let bounds = body.shape().bounds(body.pose(), body.get_margin());
        let key = world.insert(body);
        if number % 7 == 3 {
            world.disable(key).unwrap();
        } else if bounds.min.is_finite() && bounds.max.is_finite() {
            solid.extend(edges(bounds.min.as_dvec3(), bounds.max.as_dvec3()));
        }
        let body = asunder::Plane::random_body(&mut random, 9.0);
        let bounds = body.shape().bounds(body.pose(), body.get_margin());
        let key = flat.insert(body);
        if number % 7 == 3 {
            flat.remove(key);
        } else if bounds.min.is_finite() && bounds.max.is_finite() {
            plane.extend(edges(bounds.min.as_dvec2().extend(0.0), bounds.max.as_dvec2().extend(0.0)));
        }
    }
    assert!(solid.len().is_multiple_of(12) && solid.len() > 12 * 40);
    assert!(plane.len().is_multiple_of(4) && plane.len() > 4 * 40);
    assert!(
        drawn3(&world, &options).is_empty() && drawn2(&flat, &options).is_empty(),
        "before the first update"
    );
    world.update();
    flat.update();
    let first = world.iter().next().unwrap().0;
    world.set_pose(first, Pose3::at([50.0, 0.0, 0.0]).unwrap()).unwrap();
    let (drawn, drawn_flat) = (drawn3(&world, &options), drawn2(&flat, &options));
    assert_eq!(counted(of_kind(&drawn, DebugLine::Box)), counted(solid));
    assert_eq!(counted(of_kind(&drawn_flat, DebugLine::Box)), counted(plane));
    assert!(drawn.iter().chain(&drawn_flat).all(|(_, what)| *what == DebugLine::Box));
}

/// Every combination of options draws what each of them draws alone.
#[test]
fn each_option_switches_its_own_lines() {
    let mut random = Random::new(911);
    let (mut world, mut flat) = (World3::new(), World2::new());
    for _ in 0..80 {
        world.insert(asunder::Volume::random_body(&mut random, 3.0));
        flat.insert(asunder::Plane::random_body(&mut random, 3.0));
    }
    world.update();
    flat.update();
    for (name, draw) in [
        ("space", &(|options: &DebugOptions| drawn3(&world, options)) as &dyn Fn(&DebugOptions) -> Vec<_>),
        ("plane", &|options: &DebugOptions| drawn2(&flat, options)),
    ] {
        let all = draw(&ALL);
        for choice in 0..32 {
            let [shapes, boxes, columns, contacts, normals] =
                [0, 1, 2, 3, 4].map(|bit| choice >> bit & 1 == 1);
            let options = DebugOptions { shapes, boxes, columns, contacts, normals, ..SHAPES };
            let is_asked = |what: DebugLine| match what {
                DebugLine::Box => boxes,
                DebugLine::Column => columns,
                DebugLine::Contact => contacts,
                DebugLine::Normal => normals,
                _ => shapes,
            };
            let expected: Vec<_> = all.iter().filter(|(_, what)| is_asked(*what)).copied().collect();
            assert_eq!(draw(&options), expected, "{name}, choice {choice:05b}");
        }
        for kind in
            [DebugLine::Box, DebugLine::Column, DebugLine::Contact, DebugLine::Normal, DebugLine::Body]
        {
            assert!(of_kind(&all, kind).count() > 3, "{name}: {kind:?}");
        }
    }
}

#[test]
fn an_empty_world_draws_nothing() {
    let (mut world, mut flat) = (World3::new(), World2::new());
    for _ in 0..2 {
        assert!(drawn3(&world, &ALL).is_empty() && drawn2(&flat, &ALL).is_empty());
        world.update();
        flat.update();
    }
    let unit = Cuboid::from_half_extents(Vec3::ONE).unwrap();
    let keys = world.insert_many([Collider3::new(unit), Collider3::new(unit)]);
    world.update();
    assert!(!drawn3(&world, &ALL).is_empty());
    keys.into_iter().for_each(|key| drop(world.remove(key)));
    world.update();
    let left = drawn3(&world, &ALL).into_iter().filter(|(_, what)| *what != DebugLine::Column).count();
    assert_eq!(left, 0, "nor one that is empty again");
}

/// A crate a tenth of a metre deep in a floor: four crosses half-way, at the corners of the crate, and normals from the
/// body in the lower slot, whichever that is.
#[test]
fn contacts_of_a_crate_are_drawn_under_its_corners() {
    let options = DebugOptions { contacts: true, normals: true, length: 0.5, ..NOTHING };
    for is_crate_first in [false, true] {
        let floor = Collider3::new(Cuboid::from_half_extents(Vec3::new(4.0, 1.0, 4.0)).unwrap()).fixed();
        let floor = floor.at(Pose3::at([7.0, -1.0, 0.0]).unwrap());
        let half = Vec3::new(0.5, 0.25, 1.0);
        let above = Pose3::at([7.5, 0.125, -0.25]).unwrap();
        let crate_ = Collider3::new(Cuboid::from_half_extents(half).unwrap()).at(above);
        let mut world = World3::new();
        world.insert_many(if is_crate_first { [crate_, floor] } else { [floor, crate_] });
        world.update();
        let lines = drawn3(&world, &options);
        // Half of an eighth of a metre below the floor's top.
        let corner = |x: f64, z: f64| DVec3::new(7.5 + 0.5 * x, -0.0625, -0.25 + z);
        let mut corners =
            [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(x, z)| corner(x, z)).to_vec();
        let up = if is_crate_first { DVec3::NEG_Y } else { DVec3::Y };
        let normals: Vec<_> = of_kind(&lines, DebugLine::Normal).collect();
        assert_eq!(normals.len(), 4);
        for [from, to] in normals {
            // Anchors are f32, up to 8 m long.
            let at = corners.iter().position(|corner| corner.distance(from) < 1e-6);
            corners.remove(at.unwrap_or_else(|| panic!("{from} is none of {corners:?}")));
            assert!((to - from).distance(up * 0.5) < 1e-6, "{from} to {to}");
            let of_cross = |[one, other]: &[DVec3; 2]| one.midpoint(*other).distance(from) < 1e-6;
            let arms: Vec<_> = of_kind(&lines, DebugLine::Contact).filter(of_cross).collect();
            let [one, other] = arms[..] else { panic!("{} arms", arms.len()) };
            let [one, other] = [one, other].map(|[from, to]| to - from);
            assert!(one.dot(other).abs() < 1e-6 && one.y.abs().max(other.y.abs()) < 1e-6, "{one} {other}");
            assert!((one.length() - 0.125).abs() < 1e-6 && (other.length() - 0.125).abs() < 1e-6);
        }
        assert_eq!(lines.len(), 4 + 8);
    }
}

#[test]
fn contacts_of_a_crate_are_drawn_under_its_corners_in_the_plane() {
    let options = DebugOptions { contacts: true, normals: true, length: 0.5, ..NOTHING };
    for is_crate_first in [false, true] {
        let floor = Collider2::new(Rect::from_half_extents(Vec2::new(4.0, 1.0)).unwrap()).fixed();
        let floor = floor.at(Pose2::at([7.0, -1.0]).unwrap());
        let crate_ = Collider2::new(Rect::from_half_extents(Vec2::new(0.5, 0.25)).unwrap());
        let crate_ = crate_.at(Pose2::at([7.5, 0.125]).unwrap());
        let mut world = World2::new();
        world.insert_many(if is_crate_first { [crate_, floor] } else { [floor, crate_] });
        world.update();
        let up = if is_crate_first { DVec2::NEG_Y } else { DVec2::Y };
        let (mut normals, mut arms) = (Vec::new(), 0);
        world.debug_lines(&options, &mut |from, to, what| match what {
            DebugLine::Normal => {
                assert!((to - from).distance(up * 0.5) < 1e-6, "{from} to {to}");
                normals.push(from);
            }
            _ => {
                arms += 1;
                let corner = [DVec2::new(7.0, -0.0625), DVec2::new(8.0, -0.0625)];
                assert!(corner.iter().any(|corner| corner.distance(from.midpoint(to)) < 1e-6), "{from} {to}");
                assert!(((to - from).length() - 0.125).abs() < 1e-6);
            }
        });
        normals.sort_by(|a, b| a.x.total_cmp(&b.x));
        let [left, right] = normals[..] else { panic!("{normals:?}") };
        assert!(
            left.distance(DVec2::new(7.0, -0.0625)) < 1e-6 && right.distance(DVec2::new(8.0, -0.0625)) < 1e-6
        );
        assert_eq!(arms, 4);
    }
}

/// Speculative contacts are drawn half-way across the gap; a sensor has no points.
#[test]
fn contacts_to_come_are_drawn_in_the_gap_and_sensors_have_none() {
    let unit = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap();
    let mut world = World3::new();
    world.insert(Collider3::new(unit));
    let above = world.insert(Collider3::new(unit).at(Pose3::at([0.0, 3.0, 0.0]).unwrap()));
    world.insert(Collider3::new(unit).sensor());
    world.set_motion(above, Motion3::shift([0.0, -2.5, 0.0]).unwrap()).unwrap();
    world.update();
    let lines = drawn3(&world, &DebugOptions { normals: true, ..NOTHING });
    assert_eq!(lines.len(), 4);
    for ([from, to], _) in lines {
        assert!((from.y - 1.5).abs() < 1e-6 && to.distance(from + DVec3::Y * 0.2) < 1e-6, "{from} {to}");
        assert!((from.x.abs() - 0.5).abs() < 1e-6 && (from.z.abs() - 0.5).abs() < 1e-6, "{from}");
    }
}

/// A length of NaN draws lines of length zero, and unbounded shapes are cut off: renderers get no NaN.
#[test]
fn lengths_that_are_no_numbers_give_lines_that_can_be_drawn() {
    let (mut world, mut flat) = (World3::new(), World2::new());
    world.insert(Collider3::new(HalfSpace::new(Vec3::Y).unwrap()));
    world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE).unwrap()));
    flat.insert(Collider2::new(HalfPlane::new(Vec2::Y).unwrap()));
    flat.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE).unwrap()));
    world.update();
    flat.update();
    for (length, drawn) in [(f32::NAN, 0.0), (f32::INFINITY, 1e6), (f32::NEG_INFINITY, 1e6), (0.5, 0.5)] {
        for endless in [f32::NAN, f32::INFINITY, 20.0] {
            let options = DebugOptions { length, endless, ..ALL };
            let all = [drawn3(&world, &options), drawn2(&flat, &options)];
            for lines in &all {
                assert!(lines.iter().all(|(ends, _)| ends.iter().all(|end| end.is_finite())), "{options:?}");
                let mut normals = of_kind(lines, DebugLine::Normal).peekable();
                assert!(normals.peek().is_some());
                assert!(normals.all(|[from, to]| (from.distance(to) - drawn).abs() <= 1e-6 * drawn));
            }
        }
    }
}

/// A half-space's arrow points into it; with a negative length it points out of it, into regions that the half-space is
/// not in.
#[test]
fn an_arrow_that_leads_out_of_a_half_space_is_seen_there() {
    let (mut space, mut plane) = (World3::new(), World2::new());
    space.insert(Collider3::new(HalfSpace::new(Vec3::Y).unwrap()));
    plane.insert(Collider2::new(HalfPlane::new(Vec2::Y).unwrap()));
    let (above, over) = (Vec3::new(-1.0, 1.0, -1.0), Vec2::new(-1.0, 1.0));
    let (above, over) = (Aabb3::new(above, Vec3::splat(2.0)), Aabb2::new(over, Vec2::splat(2.0)));
    for (length, drawn) in [(3.0, 0), (-3.0, 1)] {
        let (options, mut counts) = (DebugOptions { length, ..ALL }, [0; 2]);
        space.debug_lines_in(&above, &options, &mut |_, _, _| counts[0] += 1);
        plane.debug_lines_in(&over, &options, &mut |_, _, _| counts[1] += 1);
        assert_eq!(counts, [drawn; 2], "{length}");
    }
}

/// Whether a line has a point in a box, by the separating axes of the two: those of the box, and its cross products
/// with the line.
fn reaches_in(region: &Aabb3, [from, to]: &[DVec3; 2]) -> bool {
    let (low, high) = (region.min.as_dvec3(), region.max.as_dvec3());
    let (half, middle) = ((high - low) * 0.5, (from + to) * 0.5 - (low + high) * 0.5);
    let arm = (to - from) * 0.5;
    let across = DVec3::AXES.map(|axis| arm.cross(axis));
    let parts = |axis: DVec3| middle.dot(axis).abs() > half.dot(axis.abs()) + arm.dot(axis).abs();
    !DVec3::AXES.into_iter().chain(across).any(parts)
}

/// The lines of a region are those of the whole world that reach into it, in the same order: of ground, too.
///
/// Symptom: for rotated ground, lines whose own AABBs overlap the region were documented to be drawn, and some were
/// not. Cause: ground is searched in its own axes, where its lines have other AABBs.
#[test]
fn a_region_has_the_lines_of_the_world_that_reach_into_it() {
    let random = &mut Random::new(5);
    let options = DebugOptions { boxes: true, columns: true, ..DebugOptions::default() };
    let (mut space, mut plane) = (World3::new(), World2::new());
    for _ in 0..60 {
        Volume::insert(&mut space, Volume::random_body(random, 4.0));
        Plane::insert(&mut plane, Plane::random_body(random, 4.0));
    }
    let heights: Vec<f32> = (0..400).map(|i| (i % 7) as f32 * 0.2).collect();
    let turn = Quat::from_xyzw(0.1, -0.3, 0.2, 0.9);
    for (columns, cell) in [(20, 0.7), (4, 3.5)] {
        let heights = &heights[..columns * columns];
        let field = Collider3::new(HeightField::new(columns, columns, heights, Vec2::splat(cell)).unwrap());
        space.insert(field.at(Pose3::new(DVec3::new(-7.0, 1.0, -6.0), turn).unwrap()));
    }
    let line: Vec<Vec2> = (0..40).map(|i| Vec2::new(8.0 - 0.4 * i as f32, (i % 5) as f32 * 0.3)).collect();
    plane.insert(Collider2::new(Chain::open(line).unwrap()));
    space.update();
    plane.update();
    let (all3, all2) = (drawn3(&space, &options), drawn2(&plane, &options));
    let mut counts = [0; 2];
    for _ in 0..50 {
        let corner = |random: &mut Random| {
            let reach = f64::from(random.below(800) as u32) / 100.0 - 4.0;
            let side = f64::from(random.below(300) as u32) / 100.0;
            (reach as f32, (reach + side) as f32)
        };
        let [(x, x_end), (y, y_end), (z, z_end)] = [corner(random), corner(random), corner(random)];
        let region = Aabb3::new(Vec3::new(x, y, z), Vec3::new(x_end, y_end, z_end));
        let is_there = |line: &[DVec3; 2]| reaches_in(&region, line);
        let expected: Vec<_> = all3.iter().copied().filter(|(line, _)| is_there(line)).collect();
        let mut found = vec![];
        space.debug_lines_in(&region, &options, &mut |from, to, what| found.push(([from, to], what)));
        assert_eq!(found, expected, "{region:?}");
        let flat = Aabb2::new(Vec2::new(x, y), Vec2::new(x_end, y_end));
        // Lines of the plane are compared at z = 0.
        let around = Aabb3::new(Vec3::new(x, y, -1.0), Vec3::new(x_end, y_end, 1.0));
        let there = all2.iter().filter(|(line, _)| reaches_in(&around, line));
        let expected: Vec<_> = there.map(|(line, what)| (line.map(|end| end.truncate()), *what)).collect();
        let mut drawn = vec![];
        plane.debug_lines_in(&flat, &options, &mut |from, to, what| drawn.push(([from, to], what)));
        assert_eq!(drawn, expected, "{flat:?}");
        counts = [counts[0] + found.len(), counts[1] + drawn.len()];
    }
    assert!(counts.iter().all(|&count| count > 500), "{counts:?}");
}

/// An invalid region has no lines, and an unbounded one has all.
///
/// Symptom: in an unbounded region, lines of ground were missing. Cause: its corners were rotated into the ground's
/// axes, where infinity times zero is NaN.
#[test]
fn regions_may_be_empty_or_endless() {
    let (mut space, mut plane) = (World3::new(), World2::new());
    let turn = Quat::from_xyzw(0.1, -0.3, 0.2, 0.9);
    let field = Collider3::new(HeightField::new(4, 4, [0.0; 16], Vec2::ONE).unwrap());
    space.insert(field.at(Pose3::new(DVec3::ONE, turn).unwrap()));
    plane.insert(Collider2::new(Chain::open([Vec2::X, Vec2::ZERO]).unwrap()));
    let options = DebugOptions::default();
    let count = |low: f32, high: f32| {
        let mut counts = [0; 2];
        let region = Aabb3 { min: Vec3::splat(low), max: Vec3::splat(high) };
        space.debug_lines_in(&region, &options, &mut |_, _, _| counts[0] += 1);
        let region = Aabb2 { min: Vec2::splat(low), max: Vec2::splat(high) };
        plane.debug_lines_in(&region, &options, &mut |_, _, _| counts[1] += 1);
        counts
    };
    for (low, high) in [(f32::INFINITY, f32::NEG_INFINITY), (f32::NAN, f32::NAN), (0.5, 0.25)] {
        assert_eq!(count(low, high), [0, 0], "{low} to {high}");
    }
    let all = [drawn3(&space, &options).len(), drawn2(&plane, &options).len()];
    assert_eq!(all, [33, 1]);
    for end in [1e9, f32::MAX, f32::INFINITY] {
        assert_eq!(count(-end, end), all, "to {end}");
    }
}
