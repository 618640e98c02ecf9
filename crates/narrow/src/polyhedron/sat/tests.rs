//! Pruning by arcs must not lose the best axis.

mod across;
mod cost;
mod grow;
mod proofs;

use super::*;
use crate::exact::Site3;
use crate::polyhedron::convex::Convex;
use crate::polyhedron::distance::Polytope;
use asunder_geometry::glam::{Quat, Vec3};
use asunder_geometry::{Capsule3, Cuboid, Hull, Pose3, Shape3, Triangle3};

/// xorshift, for cases without a dependency.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn number(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1_u32 << 23) as f32 - 1.0
    }

    pub(crate) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    pub(crate) fn turn(&mut self, kind: u64) -> Quat {
        let any = Quat::from_xyzw(self.number(), self.number(), self.number(), self.number());
        match kind % 4 {
            0 => any,
            1 => Quat::IDENTITY,
            2 => Quat::from_xyzw(0.0, 0.0, 1.0, 1.0),
            // Nearly aligned: edges parallel up to 1e-9 .. 1e-1.
            _ => Quat::from_xyzw(1e-9, any.y * 1e-3, 10.0_f32.recip() * any.z, 1.0),
        }
    }

    /// Vertices on a sphere.
    pub(crate) fn round_hull(&mut self, vertices: usize) -> Shape3 {
        let points: Vec<Vec3> = (0..vertices).map(|_| self.vector().normalize_or(Vec3::X)).collect();
        Hull::from_points(&points).unwrap().into()
    }

    /// Random hulls, cubes, prisms, plates, and rotated lattices, whose faces were merged.
    pub(crate) fn hull(&mut self, kind: u64) -> Shape3 {
        let pose = Pose3::new(Vec3::ZERO, self.turn(0)).unwrap();
        let lattice = |i: i32| Vec3::new((i % 3) as f32, (i / 3 % 3) as f32, (i / 9) as f32) - Vec3::ONE;
        let points: Vec<Vec3> = match kind % 5 {
            0 => (0..12).map(|_| self.vector()).collect(),
            1 => (0..27).map(lattice).collect(),
            2 => (0..27).map(|i| pose.transform(lattice(i)).as_vec3()).collect(),
            3 => (0..16).map(|_| self.vector() * Vec3::new(1.0, 1.0, 1e-4)).collect(),
            _ => (0..6)
                .flat_map(|i| {
                    let corner = pose.basis().x.as_vec3() * (i as f32 - 2.5)
                        + pose.basis().y.as_vec3() * self.number();
                    [corner, corner + pose.basis().z.as_vec3()]
                })
                .collect(),
        };
        Hull::from_points(&points).unwrap().into()
    }
}

/// Upright prisms and planks, three to ten times as high as wide, rotated about the vertical only; B lies beside A in a
/// random horizontal direction, at any height from level with A to just reaching its end.
pub(super) fn upright(
    random: &mut Random,
    case: u64,
) -> ([Shape3; 2], [Quat; 2], impl Fn(f64) -> DVec3 + use<>) {
    let high = [0, 1].map(|_| 1.5 + random.number().abs() * 3.5);
    let mut shape = |sides: u64, high: f32| -> Shape3 {
        let wide = Vec3::new(0.2 + 0.3 * random.number().abs(), 1.0, 0.5);
        // By a rotation whose order exceeds the sides: points on a circle, none twice.
        let around = (0..sides.max(3)).scan(Vec3::X, |at, _| {
            let now = *at;
            *at = Quat::from_xyzw(0.0, (2.0 / sides.max(3) as f32).min(0.9), 0.0, 1.0).normalize() * now;
            Some(now)
        });
        let ends = |at: Vec3| [at * wide + Vec3::Y * high, at * wide - Vec3::Y * high];
        let points: Vec<Vec3> = around.flat_map(ends).collect();
        Hull::from_points(&points).unwrap().into()
    };
    let shapes = [shape(3 + case % 6, high[0]), shape(3 + case / 6 % 6, high[1])];
    let mut yaw = || Quat::from_xyzw(0.0, random.number(), 0.0, 1.0);
    let turns = [yaw(), yaw()];
    let aside = Vec3::new(random.number(), 0.0, random.number()).normalize_or(Vec3::X).as_dvec3();
    let short = random.number();
    let up = f64::from((high[0] + high[1]) * (1.0 - short * short));
    (shapes, turns, move |at: f64| aside * at + DVec3::Y * up)
}

/// A pair in A's axes.
pub(crate) fn convex<'a>(
    shape_a: &'a Shape3,
    pose_a: Pose3,
    shape_b: &'a Shape3,
    pose_b: Pose3,
) -> Convex<'a> {
    let relative = pose_b.basis().relative_to(&pose_a.basis());
    let site = |shape, pose: &Pose3| Site3 { shape, body: *pose, part: None };
    let sites = [site(shape_a, &pose_a), site(shape_b, &pose_b)];
    Convex::new(sites, relative, pose_a.transform_back(pose_b.position()), 0.0)
}

/// The greatest separation along any cross product of edges, whichever way it points.
fn all_edge_pairs(a: &Solid, b: &Solid) -> f64 {
    let mut best = f64::NEG_INFINITY;
    for &edge_a in a.topology.edges() {
        for &edge_b in b.topology.edges() {
            let cross = Cross::new(a.edge_direction(edge_a as usize), b.edge_direction(edge_b as usize));
            if !cross.is_noise() {
                let axis = cross.axis.normalize();
                let ((low_a, high_a), (low_b, high_b)) = (a.project(axis), b.project(axis));
                best = best.max(low_b - high_a).max(low_a - high_b);
            }
        }
    }
    best
}

#[test]
fn pruned_and_exhaustive_agree_within_the_reported_error() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let (mut overlapping, mut decided_by_edges) = (0, 0);
    for case in 0..6000_u64 {
        let (shape_a, shape_b) = (random.hull(case), random.hull(case / 5));
        let turns = [random.turn(case / 2), random.turn(case / 3)];
        let offset = random.vector() * if case % 11 == 0 { 0.0 } else { 1.5 };
        let (pose_a, pose_b) =
            (Pose3::new(Vec3::ZERO, turns[0]).unwrap(), Pose3::new(offset, turns[1]).unwrap());
        let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
        pair.with_solids(|a, b| {
            let axes = pair.all_axes(a, b, f64::NEG_INFINITY);
            let faces = axes.face_a.separation.max(axes.face_b.separation);
            let exhaustive = faces.max(all_edge_pairs(a, b));
            let pruned = axes.best().separation;
            // Both project all vertices, on axes that were rounded differently.
            let rounding = pair.precision.projection();
            assert!(pruned <= exhaustive + rounding, "case {case}: {pruned}, exhaustive {exhaustive}");
            // In a gap the greatest of all axes need not be one whose arcs cross; there the distance decides.
            if exhaustive <= 0.0 {
                let error = f64::from(pair.precision.of_separation(pruned, axes.short()));
                assert!(
                    exhaustive - pruned <= error,
                    "case {case}: {pruned} against {exhaustive}, error {error}"
                );
                overlapping += 1;
                decided_by_edges += usize::from(axes.edges.separation > faces);
            } else {
                assert!(
                    pruned > 0.0 || exhaustive < 1e-6,
                    "case {case}: apart by {exhaustive}, pruned says {pruned}"
                );
            }
            let is_apart = exhaustive > 1e-12;
            assert!(
                !(is_apart && pair.verdict().overlapping),
                "case {case}: overlaps, yet parted by {exhaustive}"
            );
        });
    }
    assert!(overlapping > 2000 && decided_by_edges > 300, "{overlapping}, {decided_by_edges}");
}

#[test]
fn half_circles_and_whole_circles_lose_no_axis_either() {
    let mut random = Random(0xD1B5_4A32_D192_ED03);
    let mut decided_by_edges = 0;
    for case in 0..6000_u64 {
        let flat: Shape3 = match case % 2 {
            0 => Triangle3::new(random.vector(), random.vector(), random.vector()).unwrap().into(),
            _ => Capsule3::new(random.vector(), random.vector(), 0.25).unwrap().into(),
        };
        let solid = random.hull(case / 2);
        let (shape_a, shape_b) = if case % 4 < 2 { (&flat, &solid) } else { (&solid, &flat) };
        let pose = |turn: Quat, at: Vec3| Pose3::new(at, turn).unwrap();
        let (pose_a, pose_b) =
            (pose(random.turn(case / 2), Vec3::ZERO), pose(random.turn(case / 3), random.vector()));
        let pair = convex(shape_a, pose_a, shape_b, pose_b);
        pair.with_solids(|a, b| {
            let axes = pair.all_axes(a, b, f64::NEG_INFINITY);
            let faces = axes.face_a.separation.max(axes.face_b.separation);
            let exhaustive = faces.max(all_edge_pairs(a, b));
            if exhaustive <= 0.0 {
                let error = f64::from(pair.precision.of_separation(exhaustive, axes.short()));
                assert!(exhaustive - axes.best().separation <= error, "case {case}: {exhaustive}");
                decided_by_edges += usize::from(axes.edges.separation > faces);
            }
        });
    }
    assert!(decided_by_edges > 500, "{decided_by_edges}");
}

#[test]
fn the_furthest_vertex_by_lanes_is_the_one_found_one_by_one() {
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let (mut ties, mut rough_only) = (0, 0);
    for case in 0..3000_u64 {
        let many = if case % 8 == 0 { random.round_hull(33 + case as usize % 97) } else { random.hull(case) };
        let (shape_a, shape_b) = (many, random.hull(case / 7));
        let turns = [random.turn(case / 2), random.turn(case / 3)];
        let poses = turns.map(|turn| Pose3::new(random.vector() * 1e3, turn).unwrap());
        let pair = convex(&shape_a, poses[0], &shape_b, poses[1]);
        pair.with_solids(|a, b| {
            for solid in [a, b] {
                // Any direction; those of faces, where many vertices are equally far up to rounding; and the coordinate
                // axes, along which lattices have exact ties.
                let faces = (0..solid.face_count()).map(|face| solid.normal(face));
                let axes = [DVec3::X, -DVec3::Y, DVec3::Z, random.vector().as_dvec3().normalize()];
                for direction in faces.chain(axes) {
                    let (lanes, definition) = (solid.support(direction), solid.support_one_by_one(direction));
                    assert_eq!(lanes.vertex, definition.vertex, "case {case}");
                    assert_eq!(lanes.reach.to_bits(), definition.reach.to_bits(), "case {case}");
                    assert_eq!(solid.furthest(direction), definition.vertex, "case {case}");
                    // In f32 alone: a bound that no vertex exceeds, and a vertex that is no further below it than
                    // reported.
                    for length in [1.0, 1e-18, 1e18] {
                        let (rough, excess) = solid.rough_support(direction * length);
                        let (truth, rounding) = (definition.reach * length, 1e-12 * length * 1e3);
                        assert!(truth <= rough.reach + rounding, "case {case}: {truth} beyond {rough:?}");
                        let place = direction.dot(solid.point(rough.vertex)) * length;
                        assert!(
                            rough.reach - excess <= place + rounding,
                            "case {case}: {place} far below {rough:?}"
                        );
                        rough_only += usize::from(rough.vertex != definition.vertex);
                    }
                    let local = definition.reach - 1e-7;
                    let near = (0..solid.vertices.len()).filter(|&v| direction.dot(solid.point(v)) > local);
                    ties += usize::from(near.count() > 1);
                }
            }
        });
    }
    assert!(ties > 10_000 && rough_only > 100, "{ties}, {rough_only}");
}

#[test]
fn what_is_furthest_of_few_vertices_is_as_far_as_the_one_found_one_by_one() {
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let mut corners = [0; 8];
    for case in 0..3000_u64 {
        let half = (random.vector().abs() + Vec3::splat(0.1)) * [1e-4, 1.0, 1e4][case as usize % 3];
        let cuboid = Shape3::from(Cuboid::from_half_extents(half).unwrap());
        let [a, b, c] = [random.vector(), random.vector(), random.vector()];
        let triangle = Shape3::from(Triangle3::new(a, b, c).unwrap());
        let poses = [0, 1].map(|_| Pose3::new(random.vector() * 1e3, random.turn(case / 2)).unwrap());
        convex(&cuboid, poses[0], &triangle, poses[1]).with_solids(|a, b| {
            for solid in [a, b] {
                let faces = (0..solid.face_count()).map(|face| solid.normal(face));
                for direction in faces.chain([random.vector().as_dvec3().normalize(), DVec3::X]) {
                    let definition = solid.support_one_by_one(direction).reach.to_bits();
                    assert_eq!(solid.support(direction).reach.to_bits(), definition, "case {case}");
                    let (rough, excess) = solid.rough_support(direction);
                    assert_eq!((rough.reach.to_bits(), excess), (definition, 0.0), "case {case}");
                    let vertex = solid.furthest(direction);
                    assert_eq!(vertex, solid.support(direction).vertex, "case {case}");
                    corners[vertex] += 1;
                }
            }
        });
    }
    assert!(corners.iter().all(|&count| count > 300), "{corners:?}");
}
