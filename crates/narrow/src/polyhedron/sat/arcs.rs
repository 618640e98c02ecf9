//! Which edges of two solids may touch: those whose arcs on the Gauss map cross.
//!
//! An edge pair bounds the Minkowski difference exactly where the arc between the normals at A's edge crosses the
//! negative of the arc between the normals at B's (Gregorius, "The separating axis test between convex polyhedra", GDC
//! 2013). Each arc's ends must lie on different sides of the other's great circle, whose pole is the edge's direction,
//! and both arcs must pass through the same one of the two antipodal points where the circles meet. What is within the
//! slack counts as crossing.
//!
//! The arc of a flat polygon's edge is a half circle, from one side's normal through the outward direction in the plane
//! to the other side's normal. That of a segment is its whole great circle, stored with zero for ends and middle.
//!
//! One arc of A at a time is tested against eight of B, in f32: a pair that is kept needlessly costs one verified axis,
//! and the slack covers the rounding of f32. `may_cross` is the definition; the lanes do the same operations in the
//! same order.

use super::super::solid::Solid;
use super::MAX_EDGES;
use super::caps::{Cap, CapOctet};
use crate::counted::count_step;
use arrayvec::ArrayVec;
use asunder_geometry::EdgeArc;
use asunder_geometry::glam::Vec3;
use asunder_geometry::tolerance::ARC_SLACK;

/// Slack of a dot product of unit vectors in f32: that of the arcs, plus more than the rounding of the vectors, of the
/// rotation from B's axes to A's (10 units of 2^-24) and of the product.
const SLACK: f32 = ARC_SLACK as f32 + 16.0 * f32::EPSILON;

/// Three coordinates of eight vectors.
type Eight = [[f32; 8]; 3];

/// Eight arcs side by side.
#[derive(Clone, Copy)]
struct ArcOctet {
    along: Eight,
    ends: [Eight; 2],
    middle: Eight,
}

impl ArcOctet {
    const NONE: Self = Self { along: [[0.0; 8]; 3], ends: [[[0.0; 8]; 3]; 2], middle: [[0.0; 8]; 3] };

    fn set(&mut self, i: usize, arc: &EdgeArc) {
        for axis in 0..3 {
            self.along[axis][i] = arc.along[axis];
            self.ends[0][axis][i] = arc.ends[0][axis];
            self.ends[1][axis][i] = arc.ends[1][axis];
            self.middle[axis][i] = arc.middle[axis];
        }
    }

    /// Rotated into other axes, given the images of their own.
    fn turned(&self, basis: &[Vec3; 3]) -> Self {
        count_step();
        let turn = |v: &Eight| turned(v, basis);
        Self {
            along: turn(&self.along),
            ends: [turn(&self.ends[0]), turn(&self.ends[1])],
            middle: turn(&self.middle),
        }
    }

    /// A cap around all eight, or as many as there are.
    fn cap(&self) -> Cap {
        let vector = |v: &Eight, i: usize| Vec3::new(v[0][i], v[1][i], v[2][i]);
        let is_there = |&i: &usize| vector(&self.along, i) != Vec3::ZERO;
        let middles = (0..8).filter(is_there).map(|i| vector(&self.middle, i));
        let ends = self.ends.iter().flat_map(|ends| (0..8).filter(is_there).map(move |i| vector(ends, i)));
        Cap::of_arcs(middles, ends)
    }
}

#[inline]
fn turned(v: &Eight, [x, y, z]: &[Vec3; 3]) -> Eight {
    let mut turned = [[0.0; 8]; 3];
    for (axis, turned) in turned.iter_mut().enumerate() {
        for (i, turned) in turned.iter_mut().enumerate() {
            *turned = x[axis] * v[0][i] + y[axis] * v[1][i] + z[axis] * v[2][i];
        }
    }
    turned
}

/// Visits those pairs of the given edges, by their numbers, whose arcs may cross. The visitor gets their lower
/// half-edges and the index of B's edge in the list. Cost: the product of both counts, in an eighth as many steps.
pub(super) fn for_edge_pairs(
    (a, edges_a): (&Solid, &[u16]),
    (b, edges_b): (&Solid, &[u16]),
    mut visit: impl FnMut([usize; 2], usize),
) {
    let mut octets = ArcOctets::new_const();
    let mut few = ArrayVec::<EdgeArc, FEW>::new_const();
    if edges_a.len().max(edges_b.len()) <= FEW {
        let basis = basis_of(a, b);
        few.extend(edges_b.iter().map(|&edge| turned_arc(&b.arcs()[edge as usize], &basis)));
    } else {
        add_turned(a, (b, edges_b), &mut octets);
    }
    for &edge_a in edges_a {
        let arc_a = &a.arcs()[edge_a as usize];
        let half_edge_a = a.topology.edges()[edge_a as usize].into();
        for (first, chunk) in (0..).step_by(8).zip(edges_b.chunks(8)) {
            let crossing = match octets.get(first / 8) {
                Some(octet) => may_cross_eight(arc_a, octet),
                None => may_cross_few(arc_a, &few),
            };
            if crossing == [0; 8] {
                continue;
            }
            for (i, (&edge_b, may_cross)) in (first..).zip(chunk.iter().zip(crossing)) {
                if may_cross != 0 {
                    visit([half_edge_a, b.topology.edges()[edge_b as usize].into()], i);
                }
            }
        }
    }
}

/// [`for_edge_pairs`] for many edges of B, whose arcs are first culled eight at a time by caps around them.
pub(super) fn for_many_edge_pairs(
    (a, edges_a): (&Solid, &[u16]),
    (b, edges_b): (&Solid, &[u16]),
    mut visit: impl FnMut([usize; 2], usize),
) {
    let mut octets = ArcOctets::new_const();
    add_turned(a, (b, edges_b), &mut octets);
    let mut caps: ArrayVec<CapOctet, { MAX_EDGES.div_ceil(64) }> = ArrayVec::new_const();
    caps.extend(octets.chunks(8).map(|eight| CapOctet::new(eight.iter().map(ArcOctet::cap))));
    for &edge_a in edges_a {
        let arc_a = &a.arcs()[edge_a as usize];
        let half_edge_a = a.topology.edges()[edge_a as usize].into();
        let cap = Cap::of_arc(arc_a);
        for (first, caps) in (0..).step_by(8).zip(&caps) {
            let near = caps.may_meet_negative(&cap);
            for (place, octet) in
                (first..).zip(&octets[first..]).take(8).filter(|(place, _)| near[place % 8] != 0)
            {
                let crossing = may_cross_eight(arc_a, octet);
                if crossing == [0; 8] {
                    continue;
                }
                for (i, may_cross) in (8 * place..edges_b.len()).zip(crossing) {
                    if may_cross != 0 {
                        visit([half_edge_a, b.topology.edges()[edges_b[i] as usize].into()], i);
                    }
                }
            }
        }
    }
}

/// Up to this many edges of either solid are tested one by one: most solids that overlap leave two of each, for which
/// an octet took four times as long to lay out as to test.
const FEW: usize = 4;

/// B's axes as A sees them.
#[inline(always)]
fn basis_of(a: &Solid, b: &Solid) -> [Vec3; 3] {
    let [x, y, z] = a.axes_of(b);
    [x.as_vec3(), y.as_vec3(), z.as_vec3()]
}

/// [`ArcOctet::turned`] of one arc.
#[inline(always)]
fn turned_arc(arc: &EdgeArc, [x, y, z]: &[Vec3; 3]) -> EdgeArc {
    let turn = |v: Vec3| *x * v.x + *y * v.y + *z * v.z;
    EdgeArc { along: turn(arc.along), ends: [turn(arc.ends[0]), turn(arc.ends[1])], middle: turn(arc.middle) }
}

/// The arcs of all edges that are left of a solid: too large to return by value.
type ArcOctets = ArrayVec<ArcOctet, { MAX_EDGES.div_ceil(8) }>;

/// The arcs of B's edges in A's axes.
#[inline(always)]
fn add_turned(a: &Solid, (b, edges_b): (&Solid, &[u16]), octets: &mut ArcOctets) {
    let basis = basis_of(a, b);
    for chunk in edges_b.chunks(8).take(octets.capacity()) {
        let mut octet = ArcOctet::NONE;
        for (i, &edge) in chunk.iter().enumerate() {
            octet.set(i, &b.arcs()[edge as usize]);
        }
        octets.push(octet.turned(&basis));
    }
}

/// Whether an arc of A may cross the negative of an arc of B, in the same axes.
#[inline(always)]
fn may_cross(a: &EdgeArc, b: &EdgeArc) -> bool {
    let dot = |v: Vec3, w: Vec3| v.x * w.x + v.y * w.y + v.z * w.z;
    if same_side(dot(a.along, b.ends[0]), dot(a.along, b.ends[1])) {
        return false;
    }
    if same_side(dot(a.ends[0], b.along), dot(a.ends[1], b.along)) {
        return false;
    }
    // An arc is no longer than a half circle, so its middle shows which of the two points it passes through.
    let meeting = a.along.cross(b.along);
    !opposite(dot(meeting, a.middle), -dot(meeting, b.middle))
}

/// [`may_cross_eight`] for at most [`FEW`] arcs, one by one.
fn may_cross_few(a: &EdgeArc, few: &[EdgeArc]) -> [u32; 8] {
    count_step();
    let mut crossing = [0; 8];
    for (crossing, b) in crossing.iter_mut().zip(few) {
        *crossing = u32::from(may_cross(a, b));
    }
    crossing
}

/// `may_cross` of one arc against eight: 1 where they may cross, else 0. Numbers instead of bools, so that the loop
/// stays vectorised.
#[inline]
fn may_cross_eight(a: &EdgeArc, b: &ArcOctet) -> [u32; 8] {
    let dot = |v: Vec3, w: &Eight, i: usize| v.x * w[0][i] + v.y * w[1][i] + v.z * w[2][i];
    count_step();
    let mut crossing = [0; 8];
    for (i, crossing) in crossing.iter_mut().enumerate() {
        let by_a = same_side(dot(a.along, &b.ends[0], i), dot(a.along, &b.ends[1], i));
        let by_b = same_side(dot(a.ends[0], &b.along, i), dot(a.ends[1], &b.along, i));
        let meeting = a.along.cross(Vec3::new(b.along[0][i], b.along[1][i], b.along[2][i]));
        let passes_a = meeting.x * a.middle.x + meeting.y * a.middle.y + meeting.z * a.middle.z;
        *crossing = u32::from(!by_a & !by_b & !opposite(passes_a, -dot(meeting, &b.middle, i)));
    }
    crossing
}

#[inline(always)]
fn same_side(one: f32, other: f32) -> bool {
    ((one > SLACK) & (other > SLACK)) | ((one < -SLACK) & (other < -SLACK))
}

#[inline(always)]
fn opposite(one: f32, other: f32) -> bool {
    ((one > SLACK) & (other < -SLACK)) | ((one < -SLACK) & (other > SLACK))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Random, convex};
    use super::*;
    use asunder_geometry::glam::{DVec2, DVec3};
    use asunder_geometry::{Hull, Pose3, Shape3};

    #[test]
    fn lanes_agree_with_the_definition() {
        let mut state = 1_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // Coarse, so that equal, opposite and perpendicular directions occur.
            ((state >> 60) as f32 - 7.5).round() / 4.0
        };
        let mut unit = || Vec3::new(number(), number(), number()).normalize_or_zero();
        let mut crossings = 0;
        for _ in 0..2000 {
            let mut arc = || EdgeArc { along: unit(), ends: [unit(), unit()], middle: unit() };
            let (one, eight): (EdgeArc, [EdgeArc; 8]) = (arc(), core::array::from_fn(|_| arc()));
            let mut octet = ArcOctet::NONE;
            for (i, arc) in eight.iter().enumerate() {
                octet.set(i, arc);
            }
            let lanes = may_cross_eight(&one, &octet).map(|lane| lane != 0);
            assert_eq!(lanes, eight.map(|arc| may_cross(&one, &arc)));
            crossings += lanes.iter().filter(|&&lane| lane).count();
        }
        assert!((100..15_900).contains(&crossings), "both answers came up: {crossings}");
    }

    #[test]
    fn few_edges_are_distinguished_as_many_are() {
        let mut random = Random(0x9E37_79B9_7F4A_7C15);
        let mut visited = 0;
        for case in 0..200_u64 {
            let poses = [case, case / 4].map(|kind| Pose3::new(random.vector(), random.turn(kind)).unwrap());
            let (shape_a, shape_b) = (random.hull(case), random.hull(case / 3));
            convex(&shape_a, poses[0], &shape_b, poses[1]).with_solids(|a, b| {
                let [all_a, all_b] = [a, b].map(|solid| (0..solid.arcs().len() as u16).collect::<Vec<_>>());
                let pairs_of = |edges_a: &[u16], edges_b: &[u16]| {
                    let mut pairs = Vec::new();
                    for_edge_pairs((a, edges_a), (b, edges_b), |pair, _| pairs.push(pair));
                    pairs
                };
                let mut in_fours: Vec<[usize; 2]> = all_a
                    .chunks(FEW)
                    .flat_map(|some_a| all_b.chunks(FEW).flat_map(|some_b| pairs_of(some_a, some_b)))
                    .collect();
                in_fours.sort_unstable();
                let mut at_once = pairs_of(&all_a, &all_b);
                at_once.sort_unstable();
                assert_eq!(in_fours, at_once, "case {case}");
                visited += at_once.len();
            });
        }
        assert!(visited > 1000, "{visited}");
    }

    /// Whether the arcs of two edges cross for certain, in f64 and in the frame of the pair.
    fn do_cross(a: &Solid, b: &Solid, edge_a: usize, edge_b: usize) -> bool {
        let normals = |solid: &Solid, edge: usize| {
            let half_edges = solid.topology.half_edges();
            [edge, half_edges[edge].twin as usize].map(|edge| solid.normal(half_edges[edge].face as usize))
        };
        let parts = |along: DVec3, [left, right]: [DVec3; 2]| along.dot(left) * along.dot(right) < 0.0;
        let (along_a, along_b) = (a.edge_direction(edge_a), b.edge_direction(edge_b));
        let meeting = along_a.cross(along_b);
        let sides = [meeting.dot(a.out_of_edge(edge_a)), -meeting.dot(b.out_of_edge(edge_b))];
        parts(along_a, normals(b, edge_b)) && parts(along_b, normals(a, edge_a)) && sides[0] * sides[1] > 0.0
    }

    /// A prism of this many sides, by powers of a rotation of infinite order.
    fn prism(sides: usize) -> Shape3 {
        let corners = std::iter::successors(Some(DVec2::X), |at| Some(at.rotate(DVec2::new(0.6, 0.8))));
        let corners = corners.take(sides).map(|at| at.as_vec2());
        let points: Vec<Vec3> = corners.flat_map(|at| [at.extend(-1.0), at.extend(1.0)]).collect();
        Hull::from_points(&points).unwrap().into()
    }

    #[test]
    fn no_pair_of_edges_is_pruned_whose_arcs_cross_in_f64() {
        let mut random = Random(0x1D8E_4E27_C47D_124F);
        let (mut crossing, mut visited, mut generic, mut by_caps) = (0, 0, [0, 0], 0);
        for case in 0..1500_u64 {
            let (shape_a, shape_b) = (random.hull(case), random.hull(case / 5));
            let poses = [case / 2, case / 3].map(|kind| {
                let turn = random.turn(kind);
                Pose3::new(random.vector() * 100.0, turn).unwrap()
            });
            // Many edges, sorted and not; very long and very short arcs; bundles of parallel edges.
            let shape_b = match case % 21 {
                0 => random.round_hull(20 + case as usize % 60),
                7 => prism(40),
                _ => shape_b,
            };
            let shape_a = if case % 21 == 7 { prism(30) } else { shape_a };
            let pair = convex(&shape_a, poses[0], &shape_b, poses[1]);
            pair.with_solids(|a, b| {
                // Arbitrary subsets of the edges, so that places in the list differ from edge numbers.
                let some = |solid: &Solid, from: usize| -> Vec<u16> {
                    (0..solid.arcs().len() as u16).skip(from).step_by(1 + case as usize % 3).collect()
                };
                let (edges_a, edges_b) = (some(a, case as usize % 2), some(b, case as usize % 4));
                let mut kept = Vec::new();
                for_edge_pairs((a, &edges_a), (b, &edges_b), |[edge_a, edge_b], place_b| {
                    assert_eq!(edge_b, b.topology.edges()[edges_b[place_b] as usize] as usize);
                    kept.push((edge_a, edge_b));
                });
                let mut kept_of_many = Vec::new();
                for_many_edge_pairs((a, &edges_a), (b, &edges_b), |[edge_a, edge_b], place_b| {
                    assert_eq!(edge_b, b.topology.edges()[edges_b[place_b] as usize] as usize);
                    kept_of_many.push((edge_a, edge_b));
                });
                let half_edge = |solid: &Solid, edge: u16| solid.topology.edges()[edge as usize] as usize;
                let mut expected = 0;
                for &edge_a in &edges_a {
                    for &edge_b in &edges_b {
                        let (edge_a, edge_b) = (half_edge(a, edge_a), half_edge(b, edge_b));
                        let do_cross = do_cross(a, b, edge_a, edge_b);
                        let is_kept = [&kept, &kept_of_many].map(|kept| kept.contains(&(edge_a, edge_b)));
                        assert!(
                            !do_cross || is_kept == [true; 2],
                            "case {case}: {edge_a}, {edge_b}: {is_kept:?}"
                        );
                        assert!(is_kept[0] || !is_kept[1], "caps only leave out");
                        by_caps += usize::from(is_kept == [true, false]);
                        expected += usize::from(do_cross);
                    }
                }
                assert!(kept.is_sorted_by(|one, next| one < next) || kept.len() < 2, "each once, in order");
                (crossing, visited) = (crossing + expected, visited + kept.len());
                if case % 5 == 0 && case / 5 % 5 == 0 && case / 2 % 4 == 0 {
                    generic = [generic[0] + expected, generic[1] + kept.len()];
                }
            });
        }
        assert!(crossing > 5000 && visited > crossing, "{crossing} of {visited}");
        assert!(by_caps > 100, "{by_caps}: parallel edges whose arcs lie apart");
        assert!(generic[0] > 100 && generic[1] * 10 < generic[0] * 11, "{generic:?}: kept without need");
    }
}
