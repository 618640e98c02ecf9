//! Nothing is left out that may show enough in f64, direction by direction; and most of what may not is left out.

use super::super::tests::{Random, convex};
use super::*;
use asunder_geometry::Pose3;
use asunder_geometry::glam::DVec3;

/// Directions of an arc that are sampled, besides the one that shows most.
const SAMPLES: usize = 9;

/// Unit directions along an edge's arc, from one face's normal to the other's, in the shape's own axes; among them the
/// one nearest to `towards`, where that is inside.
fn along_arc(normals: [DVec3; 2], towards: DVec3) -> Vec<DVec3> {
    let [left, right] = normals;
    let share = |i: usize| i as f64 / (SAMPLES - 1) as f64;
    let mut directions: Vec<DVec3> = (0..SAMPLES)
        .map(|i| left * (1.0 - share(i)) + right * share(i))
        .map(DVec3::normalize_or_zero)
        .collect();
    let across = left.cross(right).normalize_or_zero();
    let inside = (towards - across * across.dot(towards)).normalize_or_zero();
    if left.cross(inside).dot(across) >= 0.0 && inside.cross(right).dot(across) >= 0.0 {
        directions.push(inside);
    }
    directions.retain(|direction| direction.is_normalized());
    directions
}

/// The normals beside each edge, in the order of the edges, in the shape's own axes.
fn normals_beside(solid: &Solid) -> Vec<[DVec3; 2]> {
    let half_edges = solid.topology.half_edges();
    let normal = |edge: u16| solid.turned_back(solid.normal(half_edges[edge as usize].face as usize));
    let edges = solid.topology.edges().iter();
    edges.map(|&edge| [normal(edge), normal(half_edges[edge as usize].twin)]).collect()
}

/// The lane of each edge.
fn lanes_of_edges(solid: &Solid) -> Vec<usize> {
    let mut lanes = vec![usize::MAX; solid.arcs().len()];
    let numbers = solid.edge_octets().iter().flat_map(|octet| octet.numbers);
    for (lane, number) in numbers.enumerate().take(lanes.len()) {
        lanes[number as usize] = lane;
    }
    lanes
}

fn reach(solid: &Solid, direction: DVec3) -> f64 {
    solid.vertices.iter().map(|vertex| direction.dot(vertex.as_dvec3())).fold(f64::NEG_INFINITY, f64::max)
}

/// The most that can be shown along a direction, given a sphere inside the other solid.
fn most(solid: &Solid, direction: DVec3, (center, radius): (DVec3, f64)) -> f64 {
    direction.dot(center) - reach(solid, direction) - radius
}

/// Centres anywhere, far out, deep inside, and nearly on the surface, with radii to match.
fn spheres(random: &mut Random, solid: &Solid) -> [(DVec3, f64); 4] {
    let vertex = |random: &mut Random| {
        let place = (random.number() + 1.0) * 0.5 * solid.vertices.len() as f32;
        solid.vertices[(place as usize).min(solid.vertices.len() - 1)].as_dvec3()
    };
    let mut inside = || {
        let share = f64::from(random.number() + 1.0) * 0.5;
        vertex(random) * share + vertex(random) * (1.0 - share)
    };
    let (one, other) = (inside(), inside());
    let any = random.vector().as_dvec3();
    let radius = f64::from(random.number().abs());
    [(any * 3.0, 0.3 * radius), (any * 1e4, radius), (one, 0.1 * radius), (other * (1.0 + 1e-6 * any.x), 0.0)]
}

#[derive(Debug, Default)]
struct Count {
    tested: usize,
    /// Left out when asked for a little more than they may show.
    closed: usize,
    /// Those that show most inside the arc, and not at its ends.
    inside: usize,
}

/// Tests lanes at exactly the separation that is possible, and at a little more.
#[test]
fn a_sphere_leaves_out_no_face_and_no_edge_that_may_show_enough() {
    let mut random = Random(0x8EBC_6AF0_9C88_C6E3);
    let (mut faces, mut edges) = (Count::default(), Count::default());
    for case in 0..1500_u64 {
        let shape = random.hull(case);
        let pair = convex(&shape, Pose3::IDENTITY, &shape, Pose3::IDENTITY);
        pair.with_solids(|solid, _| {
            let normals = normals_beside(solid);
            for sphere in spheres(&mut random, solid) {
                let ball = Ball::new(solid, sphere.0.as_vec3(), sphere.1);
                // f32 cannot resolve less: the rounding of the centre, times what an arc makes of it.
                let gap = 64.0 * f64::from(ball.doubt) + 1e-6 * sphere.1;
                for face in 0..solid.face_count() {
                    let possible = most(solid, solid.normal(face), sphere);
                    let is_open = |separation: f64| {
                        let over = ball.over(&solid.face_octets()[face / 8]);
                        above(&over, ball.least(separation))[face % 8] != 0
                    };
                    assert!(is_open(possible), "case {case}, face {face}: {possible} of {sphere:?}");
                    faces.tested += 1;
                    faces.closed += usize::from(!is_open(possible + gap));
                }
                // The ends of a half circle say nothing about its middle.
                if solid.face_count() <= 2 {
                    continue;
                }
                let lanes = lanes_of_edges(solid);
                for (edge, &normals) in normals.iter().enumerate() {
                    let (from, _) = solid.topology.ends(solid.topology.edges()[edge] as usize);
                    let shown: Vec<f64> = along_arc(normals, sphere.0 - solid.vertices[from].as_dvec3())
                        .into_iter()
                        .map(|direction| most(solid, direction, sphere))
                        .collect();
                    let possible = shown.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    let lane = lanes[edge];
                    let is_open = |separation: f64| {
                        ball.rises(&solid.edge_octets()[lane / 8], separation)[lane % 8] != 0
                    };
                    assert!(is_open(possible), "case {case}, edge {edge}: {possible} of {sphere:?}");
                    edges.tested += 1;
                    edges.closed += usize::from(!is_open(possible + gap));
                    let ends = normals.map(|normal| most(solid, normal, sphere));
                    edges.inside += usize::from(possible > ends[0].max(ends[1]) + gap);
                }
            }
        });
    }
    assert!(faces.closed * 10 > faces.tested * 9, "{faces:?}");
    assert!(edges.closed * 2 > edges.tested && edges.inside > 1000, "{edges:?}");
}

/// The separation along a direction of a solid's own axes.
fn separation_along(solid: &Solid, other: &Solid, direction: DVec3) -> f64 {
    let turned = solid.turned(direction);
    other.project(turned).0 - solid.project(turned).1
}

/// Spheres and points together, as the full test uses them.
#[test]
fn no_face_and_no_edge_is_culled_whose_axes_reach_the_least_separation() {
    let mut random = Random(0x5895_59F1_1A8B_3F7D);
    let (mut faces, mut edges) = (Count::default(), Count::default());
    for case in 0..600_u64 {
        // Round hulls leave so many edges open that they get the closer look.
        let (shape_a, shape_b) = if case % 3 == 0 {
            (random.round_hull(48), random.round_hull(48))
        } else {
            (random.hull(case), random.hull(case / 5))
        };
        let turns = [random.turn(case / 2), random.turn(case / 3)];
        let offset = random.vector() * if case % 7 == 0 { 0.0 } else { 1.5 };
        let poses = [Pose3::new(Vec3::ZERO, turns[0]).unwrap(), Pose3::new(offset, turns[1]).unwrap()];
        let pair = convex(&shape_a, poses[0], &shape_b, poses[1]);
        pair.with_solids(|a, b| {
            for (solid, other) in [(a, b), (b, a)] {
                let shown_by_face: Vec<f64> = (0..solid.face_count())
                    .map(|face| separation_along(solid, other, solid.turned_back(solid.normal(face))))
                    .collect();
                let towards = solid.to_local(other.center());
                let shown_by_edge: Vec<f64> = normals_beside(solid)
                    .into_iter()
                    .map(|normals| {
                        let directions = along_arc(normals, towards).into_iter();
                        let shown = directions.map(|direction| separation_along(solid, other, direction));
                        shown.fold(f64::NEG_INFINITY, f64::max)
                    })
                    .collect();
                let best =
                    shown_by_face.iter().chain(&shown_by_edge).copied().fold(f64::NEG_INFINITY, f64::max);
                // What the full test would require, and less, so that some are just good enough.
                let least = best - f64::from(random.number().abs()) * 0.1 * pair.precision.size;
                let mut over = Heights::new_const();
                let mut sight = Sight::new(solid, other, &mut over);
                sight.highest().unwrap();
                let mut visited = vec![false; solid.face_count()];
                sight.for_faces(least, |face| {
                    visited[face] = true;
                    (other.support(-solid.normal(face)).vertex, least)
                });
                let mut kept = ArrayVec::new();
                sight.edges(least, &mut kept);
                for (face, &shown) in shown_by_face.iter().enumerate() {
                    assert!(
                        visited[face] || shown < least,
                        "case {case}, face {face}: {shown}, least {least}"
                    );
                    faces.tested += 1;
                    faces.closed += usize::from(!visited[face]);
                }
                kept.sort_unstable();
                assert!(kept.is_sorted_by(|one, next| one < next), "each once");
                for (edge, &shown) in shown_by_edge.iter().enumerate() {
                    let is_kept = kept.binary_search(&(edge as u16)).is_ok();
                    assert!(is_kept || shown < least, "case {case}, edge {edge}: {shown}, least {least}");
                    edges.tested += 1;
                    edges.closed += usize::from(!is_kept);
                }
            }
        });
    }
    assert!(faces.closed * 2 > faces.tested && edges.closed * 2 > edges.tested, "{faces:?}, {edges:?}");
}
