//! Outlines lie on the shapes, and have every edge once.

use super::SHAPES;
use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{
    Chain, Collider2, Collider3, HeightField, Pose2, Pose3, Shape2, Shape3, TriMesh, World2, World3,
};
use asunder_tests::cases::Random;
use asunder_tests::cores::{Piece2, Piece3, pieces2, pieces3};
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};
use std::collections::BTreeSet;

/// The lines drawn for one body.
fn outline3(shape: &Shape3, pose: &Pose3) -> Vec<[DVec3; 2]> {
    let (mut world, mut lines) = (World3::new(), Vec::new());
    world.insert(Collider3::new(shape.clone()).at(*pose));
    world.debug_lines(&SHAPES, &mut |from, to, _| lines.push([from, to]));
    lines
}

fn outline2(shape: &Shape2, pose: &Pose2) -> Vec<[DVec2; 2]> {
    let (mut world, mut lines) = (World2::new(), Vec::new());
    world.insert(Collider2::new(shape.clone()).at(*pose));
    world.debug_lines(&SHAPES, &mut |from, to, _| lines.push([from, to]));
    lines
}

/// How far from the surface a point may be: f64 rounds by 2e-15 at 10 m; the normal of merged faces is that of their
/// corners up to some 1e-7, which moves the surface at a radius of a metre by the square of that.
const ROUNDING: f64 = 1e-9;

/// The same in the plane, where a stored rotation has length one up to 6e-8, and arcs around corners are rotated by it.
const ROUNDING_IN_PLANE: f64 = 1.2e-7;

/// A compound's lines lie on one of its parts.
#[test]
fn lines_end_on_the_surface_in_space() {
    let mut random = Random::new(903);
    for (name, make) in KINDS3.iter().take(KINDS3.len() - 1) {
        for _ in 0..10 {
            let shape = make(&mut Clay::new(&mut random, 1.0));
            let pose = Pose3::new(random.vector() * 10.0, random.quaternion()).unwrap();
            let (lines, pieces) = (outline3(&shape, &pose), pieces3(&shape, &pose, DVec3::ZERO));
            assert!(!lines.is_empty(), "{name}");
            for end in lines.into_flattened() {
                let off = pieces.iter().map(|piece| piece.outside(end).abs()).fold(f64::INFINITY, f64::min);
                assert!(off <= ROUNDING, "{name}: {end} is {off} m off the surface");
            }
        }
    }
}

/// Except for one line in each circle, which shows its rotation.
#[test]
fn lines_end_on_the_outline_in_the_plane() {
    let mut random = Random::new(904);
    for (name, make) in KINDS2.iter().take(KINDS2.len() - 1) {
        for _ in 0..20 {
            let shape = make(&mut Clay::new(&mut random, 1.0));
            let pose = Pose2::new(random.vector().truncate() * 10.0, random.rotation2()).unwrap();
            let (lines, pieces) = (outline2(&shape, &pose), pieces2(&shape, &pose, DVec2::ZERO));
            assert!(!lines.is_empty(), "{name}");
            let off = |end: DVec2| {
                pieces.iter().map(|piece| piece.outside(end).abs()).fold(f64::INFINITY, f64::min)
            };
            let spokes = lines.iter().filter(|ends| off(ends[0]) > ROUNDING_IN_PLANE);
            let circles: Vec<DVec2> = pieces.iter().filter_map(center_of_circle).collect();
            let centers: Vec<DVec2> = spokes.map(|ends| ends[0]).collect();
            assert!(centers.len() <= circles.len(), "{name}: {centers:?}");
            for center in centers {
                assert!(
                    circles.iter().any(|circle| circle.distance(center) < ROUNDING_IN_PLANE),
                    "{name}: {center}"
                );
            }
            for [_, end] in lines {
                assert!(off(end) <= ROUNDING_IN_PLANE, "{name}: {end} is {} m off the outline", off(end));
            }
        }
    }
}

fn center_of_circle(piece: &Piece2) -> Option<DVec2> {
    match piece {
        Piece2::Round { core, .. } if core.vertices.len() == 1 => Some(core.vertices[0]),
        _ => None,
    }
}

/// Lines as pairs of corner indices, the lower first. Asserts that none occurs twice, and none ends elsewhere.
fn numbered(lines: &[[DVec3; 2]], corners: &[DVec3]) -> BTreeSet<[usize; 2]> {
    let number = |end: DVec3| {
        let is_here = |corner: &DVec3| corner.distance(end) < ROUNDING;
        corners.iter().position(is_here).unwrap_or_else(|| panic!("{end} is no corner"))
    };
    let sorted = |[from, to]: [usize; 2]| [from.min(to), from.max(to)];
    let found: BTreeSet<_> = lines.iter().map(|ends| sorted(ends.map(number))).collect();
    assert_eq!(found.len(), lines.len(), "a line is drawn twice");
    found
}

/// Pairs of a flat polygon's corners that have all others on one side.
fn rim(corners: &[DVec3], normal: DVec3) -> BTreeSet<[usize; 2]> {
    let pairs = (0..corners.len()).flat_map(|j| (0..j).map(move |i| [i, j]));
    let is_rim = |[i, j]: &[usize; 2]| {
        let across = normal.cross(corners[*j] - corners[*i]);
        let sides = (0..corners.len()).filter(|k| k != i && k != j);
        let mut sides = sides.map(|k| across.dot(corners[k] - corners[*i]) > 0.0);
        let first = sides.next();
        sides.all(|side| Some(side) == first)
    };
    pairs.filter(is_rim).collect()
}

#[test]
fn every_edge_of_a_polyhedron_is_drawn_once() {
    let mut random = Random::new(905);
    let mut most = 0;
    for round in 0..60 {
        let shape = match round % 5 {
            0 => random.cuboid(),
            1 => random.hull(4 + round / 3),
            2 => KINDS3[4].1(&mut Clay::new(&mut random, 1.0)),
            3 => KINDS3[6].1(&mut Clay::new(&mut random, 1.0)),
            _ => KINDS3[8].1(&mut Clay::new(&mut random, 1.0)),
        };
        let pose = Pose3::new(random.vector() * 10.0, random.quaternion()).unwrap();
        let piece = pieces3(&shape, &pose, DVec3::ZERO).remove(0);
        let Piece3::Round { core, is_solid, .. } = piece else { panic!("{shape:?}") };
        // For flat shapes the oracle has no edges, and only one normal for each side.
        let edges = match core.normals.first() {
            Some(&normal) if !is_solid => rim(&core.vertices, normal),
            _ => core.edges.iter().map(|&[i, j]| [i.min(j), i.max(j)]).collect(),
        };
        assert_eq!(numbered(&outline3(&shape, &pose), &core.vertices), edges, "{shape:?}");
        most = most.max(edges.len());
    }
    assert!(most > 40, "{most} edges");
}

#[test]
fn every_side_of_a_polygon_is_drawn_once() {
    let mut random = Random::new(906);
    for round in 0..40 {
        let shape = KINDS2[[2, 4][round % 2]].1(&mut Clay::new(&mut random, 1.0));
        let pose = Pose2::new(random.vector().truncate() * 10.0, random.rotation2()).unwrap();
        let Piece2::Round { core, .. } = pieces2(&shape, &pose, DVec2::ZERO).remove(0) else {
            panic!("{shape:?}")
        };
        let corners: Vec<DVec3> = core.vertices.iter().map(|corner| corner.extend(0.0)).collect();
        let lines: Vec<_> =
            outline2(&shape, &pose).into_iter().map(|ends| ends.map(|end| end.extend(0.0))).collect();
        let sides = rim(&corners, DVec3::Z);
        assert_eq!(sides.len(), corners.len());
        assert_eq!(numbered(&lines, &corners), sides, "{shape:?}");
    }
}

/// The sides of triangles, each once.
fn sides(triangles: impl IntoIterator<Item = [usize; 3]>) -> BTreeSet<[usize; 2]> {
    let sides = triangles.into_iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    sides.map(|[from, to]| [from.min(to), from.max(to)]).collect()
}

#[test]
fn ground_is_drawn_by_the_sides_of_its_triangles() {
    let mut random = Random::new(907);
    let pose = Pose3::new(random.vector() * 10.0, random.quaternion()).unwrap();
    let placed = |corners: &[Vec3]| -> Vec<DVec3> {
        corners.iter().map(|&corner| pose.transform(corner.as_dvec3())).collect()
    };
    // A fan about one corner, open, and a separate triangle.
    let mut corners = vec![Vec3::ZERO];
    corners.extend((0..5).map(|x| Vec3::new(x as f32 - 2.0, (x % 2) as f32, 1.0)));
    corners.extend([Vec3::X * 9.0, Vec3::X * 10.0, Vec3::new(9.0, 1.0, 1.0)]);
    let fan = [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 5, 4], [6, 7, 8]];
    let mesh = TriMesh::new(corners.clone(), fan.to_vec()).unwrap();
    let found = numbered(&outline3(&mesh.into(), &pose), &placed(&corners));
    assert_eq!(found, sides(fan.map(|triangle| triangle.map(|corner| corner as usize))));
    assert_eq!(found.len(), 9 + 3);

    // Three cells by two, one of them a hole: neither its diagonal nor its free side at the rim is drawn.
    let heights: Vec<f32> = (0..12).map(|number| (number * number % 7) as f32).collect();
    let field = HeightField::new(4, 3, heights.clone(), Vec2::new(1.0, 2.0)).unwrap();
    let field = field.with_hole(1, 0).unwrap();
    let corner = |number: usize| Vec3::new((number % 4) as f32, heights[number], (number / 4) as f32 * 2.0);
    let corners: Vec<Vec3> = (0..12).map(corner).collect();
    let found = numbered(&outline3(&field.into(), &pose), &placed(&corners));
    let along_x = (0..12).filter(|number| number % 4 < 3).map(|number| [number, number + 1]);
    let along_z = (0..8).map(|number| [number, number + 4]);
    let open = [1, 2];
    let mut expected: BTreeSet<_> = along_x.chain(along_z).filter(|side| *side != open).collect();
    assert!(expected.is_subset(&found), "{found:?}");
    // The remaining lines are the diagonals, one of the two in each cell that is no hole.
    for cell in [0, 2, 4, 5, 6] {
        let either = [[cell, cell + 5], [cell + 1, cell + 4]].into_iter().filter(|side| found.contains(side));
        let either: Vec<_> = either.collect();
        assert_eq!(either.len(), 1, "cell {cell}");
        expected.extend(either);
    }
    assert_eq!(found, expected);
}

#[test]
fn chains_are_drawn_by_their_segments() {
    let mut random = Random::new(908);
    let pose = Pose2::new(random.vector().truncate() * 10.0, random.rotation2()).unwrap();
    let corners = [(0.0, 0.0), (2.0, 0.0), (3.0, 1.0), (1.0, 2.0)].map(Vec2::from);
    let placed = corners.map(|corner| pose.transform(corner.as_dvec2()));
    for (chain, count) in [(Chain::open(corners).unwrap(), 3), (Chain::closed(corners).unwrap(), 4)] {
        let expected: Vec<_> = (0..count).map(|from| [placed[from], placed[(from + 1) % 4]]).collect();
        assert_eq!(outline2(&chain.into(), &pose), expected);
    }
}
