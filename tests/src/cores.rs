//! The separation of any two bodies, whatever they are made of: points, segments, flat polygons, polyhedra, with any
//! rounding, half-spaces, and several parts of these.
//!
//! ```text
//! body       = pieces: a core with a radius, or a half-space
//! two cores  : every candidate axis both ways (exhaustive_sat), and axes across and along, which only matter where
//!              neither core has an interior; the least distance over all pairs of features; the line of that distance
//!              an axis that shows a gap  -> the distance;     none does -> the least depth over the axes
//! radii      : subtracted           half-space: the least height of a vertex         bodies: the least of all pieces
//! ```
//! Any unit axis gives a true lower bound, so that more of them can do no harm; two disjoint sets are separated along
//! the line between their closest points, so that "apart" is never missed. There are no early outs, no code is shared
//! with the engine, and no order of vertices is relied on: a flat polygon is all triangles of its vertices.

use crate::cases::Truth;
use crate::exhaustive_distance::{Nearest, exhaustive_distance2, exhaustive_distance3};
use crate::exhaustive_sat::{exhaustive_sat2, exhaustive_sat3, gap2, gap3};
use crate::placed::{Placed2, Placed3};
use crate::solid::Solid;
use asunder_geometry::{Chain, Pose2, Pose3, Shape2, Shape3};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A convex part of a body in space.
#[derive(Clone, Debug)]
pub enum Piece3 {
    /// Everything within a radius of a core.
    Round {
        /// The core.
        core: Placed3,
        /// Whether the core has an inside.
        is_solid: bool,
        /// The radius, in metres.
        radius: f64,
    },
    /// Everything below a plane.
    HalfSpace {
        /// Outward unit normal.
        normal: DVec3,
        /// A point of the plane.
        at: DVec3,
    },
}

/// A convex part of a body in the plane.
#[derive(Clone, Debug)]
pub enum Piece2 {
    /// Everything within a radius of a core.
    Round {
        /// The core.
        core: Placed2,
        /// The radius, in metres.
        radius: f64,
    },
    /// Everything below a line.
    HalfPlane {
        /// Outward unit normal.
        normal: DVec2,
        /// A point of the line.
        at: DVec2,
    },
}

/// The pieces of a posed shape, relative to `origin`: one, or a compound's parts in order.
pub fn pieces3(shape: &Shape3, pose: &Pose3, origin: DVec3) -> Vec<Piece3> {
    let moved = pose.position() - origin;
    match shape {
        Shape3::Compound(compound) => {
            let placed = compound.parts().iter().map(|part| {
                let inner = part.pose();
                let place = move |v: DVec3| turned(pose, turned(inner, v) + inner.position()) + moved;
                piece3(part.shape(), place, |v| turned(pose, turned(inner, v)))
            });
            placed.collect()
        }
        _ => vec![piece3(shape, |v| turned(pose, v) + moved, |v| turned(pose, v))],
    }
}

fn piece3(shape: &Shape3, place: impl Fn(DVec3) -> DVec3, turn: impl Fn(DVec3) -> DVec3) -> Piece3 {
    if let Shape3::HalfSpace(half_space) = shape {
        let normal = turn(half_space.normal().as_dvec3()).normalize();
        return Piece3::HalfSpace { normal, at: place(DVec3::ZERO) };
    }
    let stored = shape.core().vertices().to_vec();
    let vertices: Vec<DVec3> = stored.iter().map(|v| place(v.as_dvec3())).collect();
    let solid = Solid::of_vertices(&stored);
    let is_solid = !solid.facets.is_empty();
    let core = if is_solid {
        Placed3 {
            vertices,
            normals: solid.facets.iter().map(|facet| turn(facet.normal)).collect(),
            facets: solid.facets.into_iter().map(|facet| facet.corners).collect(),
            edges: solid.edges,
        }
    } else {
        flat_core(&stored, vertices, turn)
    };
    Piece3::Round { core, is_solid, radius: shape.radius().into() }
}

/// A core without an interior: all its triangles, each from both sides, and all its segments.
fn flat_core(stored: &[Vec3], vertices: Vec<DVec3>, turn: impl Fn(DVec3) -> DVec3) -> Placed3 {
    let count = stored.len();
    let edges: Vec<[usize; 2]> = (0..count).flat_map(|j| (0..j).map(move |i| [i, j])).collect();
    let area = |[i, j, k]: [usize; 3]| {
        let from_i = |v: usize| stored[v].as_dvec3() - stored[i].as_dvec3();
        from_i(j).cross(from_i(k))
    };
    let triples = (0..count).flat_map(|k| (0..k).flat_map(move |j| (0..j).map(move |i| [i, j, k])));
    let triples: Vec<[usize; 3]> = triples.filter(|&triple| area(triple) != DVec3::ZERO).collect();
    let largest = triples.iter().map(|&triple| area(triple)).max_by(|a, b| a.length().total_cmp(&b.length()));
    let normal = largest.map_or(DVec3::ZERO, |area| turn(area.normalize()));
    let both = triples.iter().flat_map(|triple| [(normal, triple.to_vec()), (-normal, triple.to_vec())]);
    let (normals, facets) = both.unzip();
    Placed3 { vertices, normals, facets, edges }
}

/// A vector rotated by M(q)/|q|^2, by the sandwich product; the library multiplies matrices.
pub(crate) fn turned(pose: &Pose3, v: DVec3) -> DVec3 {
    let [x, y, z, w] = pose.rotation().to_array().map(f64::from);
    let u = DVec3::new(x, y, z);
    v + (u.cross(v) * w + u.cross(u.cross(v))) * (2.0 / (u.length_squared() + w * w))
}

/// The pieces of a posed shape in the plane, relative to `origin`: one, or a compound's parts in order.
pub fn pieces2(shape: &Shape2, pose: &Pose2, origin: DVec2) -> Vec<Piece2> {
    let moved = pose.position() - origin;
    // Complex numbers: the stored one is used as it is, though its length is 1 only up to rounding.
    let number = |pose: &Pose2| DVec2::new(pose.rotation().cos().into(), pose.rotation().sin().into());
    match shape {
        Shape2::Compound(compound) => {
            let placed = compound.parts().iter().map(|part| {
                let (outer, inner) = (number(pose), number(part.pose()));
                let both = outer.rotate(inner);
                piece2(part.shape(), both, outer.rotate(part.pose().position()) + moved)
            });
            placed.collect()
        }
        Shape2::Chain(chain) => {
            segments(chain).map(|segment| piece2(&segment, number(pose), moved)).collect()
        }
        _ => vec![piece2(shape, number(pose), moved)],
    }
}

/// The segments of a chain, as shapes; the chain is their union.
pub fn segments(chain: &Chain) -> impl Iterator<Item = Shape2> {
    (0..chain.segment_count() as u32).filter_map(|i| chain.segment(i)).map(Shape2::from)
}

fn piece2(shape: &Shape2, turn: DVec2, moved: DVec2) -> Piece2 {
    if let Shape2::HalfPlane(half_plane) = shape {
        let normal = turn.rotate(half_plane.normal().as_dvec2()).normalize();
        return Piece2::HalfPlane { normal, at: moved };
    }
    let place = |v: &Vec2| turn.rotate(v.as_dvec2()) + moved;
    let core = Placed2 { vertices: shape.core().vertices().iter().map(place).collect() };
    Piece2::Round { core, radius: shape.radius().into() }
}

/// The separation of two pieces, and an axis that shows it.
pub fn separation_of3(a: &Piece3, b: &Piece3) -> Truth<DVec3> {
    use Piece3::{HalfSpace, Round};
    match (a, b) {
        (Round { core, radius, .. }, Round { core: other, radius: more, .. }) => {
            let truth = of_cores3(core, other, !is_solid(a) && !is_solid(b));
            Truth { separation: truth.separation - radius - more, ..truth }
        }
        (HalfSpace { normal, at }, Round { core, radius, .. }) => {
            let height = core.vertices.iter().map(|v| normal.dot(*v - *at)).fold(f64::INFINITY, f64::min);
            Truth { separation: height - radius, normal: *normal }
        }
        (Round { .. }, HalfSpace { .. }) => {
            let Truth { separation, normal } = separation_of3(b, a);
            Truth { separation, normal: -normal }
        }
        (HalfSpace { normal, at }, HalfSpace { normal: other, at: there }) => {
            let away = (*normal + *other).length() < 1e-14;
            let separation = if away { normal.dot(*there - *at) } else { f64::NEG_INFINITY };
            Truth { separation, normal: *normal }
        }
    }
}

fn is_solid(piece: &Piece3) -> bool {
    matches!(piece, Piece3::Round { is_solid: true, .. })
}

fn of_cores3(a: &Placed3, b: &Placed3, are_flat: bool) -> Truth<DVec3> {
    let sat = exhaustive_sat3(a, b);
    let (mut gap, mut normal) = (sat.gap, sat.normal);
    if !are_flat && gap <= 0.0 {
        return Truth { separation: gap, normal };
    }
    let nearest = nearest3(a, b);
    let mut offer = |axis: DVec3| {
        for axis in axis.try_normalize().into_iter().flat_map(|axis| [axis, -axis]) {
            let found = gap3(a, b, axis);
            if found > gap {
                (gap, normal) = (found, axis);
            }
        }
    };
    offer(nearest.on_b - nearest.on_a);
    if are_flat {
        DVec3::AXES.into_iter().for_each(&mut offer);
        for (core, edge) in a.edges.iter().map(|edge| (a, edge)).chain(b.edges.iter().map(|edge| (b, edge))) {
            let along = (core.vertices[edge[1]] - core.vertices[edge[0]]).normalize();
            DVec3::AXES.into_iter().for_each(|axis| offer(along.cross(axis)));
        }
    }
    Truth { separation: in_gap(gap, nearest.distance, reach_of(&a.vertices) + reach_of(&b.vertices)), normal }
}

/// The distance where there is a gap. Where shapes almost touch, a foot may miss its facet by rounding; the gap is
/// right there.
fn in_gap(gap: f64, distance: f64, reach: f64) -> f64 {
    let is_hair = gap < 1e-13 * reach && distance > 1e-10 * reach;
    if gap > 0.0 && !is_hair { distance } else { gap }
}

fn reach_of(vertices: &[DVec3]) -> f64 {
    vertices.iter().map(|v| v.length()).fold(0.0, f64::max)
}

/// The least distance over all pairs of features.
fn nearest3(a: &Placed3, b: &Placed3) -> Nearest<DVec3> {
    let mut nearest = exhaustive_distance3(a, b);
    let mut consider = |on_a: DVec3, on_b: DVec3| {
        let distance = (on_b - on_a).length();
        if distance < nearest.distance {
            nearest = Nearest { distance, on_a, on_b };
        }
    };
    let foot = |core: &Placed3, edge: &[usize; 2], point: DVec3| {
        let [from, to] = edge.map(|end| core.vertices[end]);
        let along = to - from;
        from + along * ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0)
    };
    for &v in &a.vertices {
        b.vertices.iter().for_each(|&w| consider(v, w));
        b.edges.iter().for_each(|edge| consider(v, foot(b, edge, v)));
    }
    for &w in &b.vertices {
        a.edges.iter().for_each(|edge| consider(foot(a, edge, w), w));
    }
    nearest
}

/// The separation of two pieces, and an axis that shows it.
pub fn separation_of2(a: &Piece2, b: &Piece2) -> Truth<DVec2> {
    use Piece2::{HalfPlane, Round};
    match (a, b) {
        (Round { core, radius }, Round { core: other, radius: more }) => {
            let truth = of_cores2(core, other);
            Truth { separation: truth.separation - radius - more, ..truth }
        }
        (HalfPlane { normal, at }, Round { core, radius }) => {
            let height = core.vertices.iter().map(|v| normal.dot(*v - *at)).fold(f64::INFINITY, f64::min);
            Truth { separation: height - radius, normal: *normal }
        }
        (Round { .. }, HalfPlane { .. }) => {
            let Truth { separation, normal } = separation_of2(b, a);
            Truth { separation, normal: -normal }
        }
        (HalfPlane { normal, at }, HalfPlane { normal: other, at: there }) => {
            let away = (*normal + *other).length() < 1e-14;
            let separation = if away { normal.dot(*there - *at) } else { f64::NEG_INFINITY };
            Truth { separation, normal: *normal }
        }
    }
}

fn of_cores2(a: &Placed2, b: &Placed2) -> Truth<DVec2> {
    let sat = exhaustive_sat2(a, b);
    let (mut gap, mut normal) = (sat.gap, sat.normal);
    // Where either is a polygon, the side normals of both are all the axes there are.
    if (a.vertices.len() > 2 || b.vertices.len() > 2) && gap <= 0.0 {
        return Truth { separation: gap, normal };
    }
    let mut nearest = exhaustive_distance2(a, b);
    for &v in &a.vertices {
        for &w in &b.vertices {
            if (w - v).length() < nearest.distance {
                nearest = Nearest { distance: (w - v).length(), on_a: v, on_b: w };
            }
        }
    }
    for axis in [nearest.on_b - nearest.on_a, DVec2::X, DVec2::Y] {
        for axis in axis.try_normalize().into_iter().flat_map(|axis| [axis, -axis]) {
            let found = gap2(a, b, axis);
            if found > gap {
                (gap, normal) = (found, axis);
            }
        }
    }
    Truth { separation: if gap > 0.0 { nearest.distance } else { gap }, normal }
}

impl Piece3 {
    /// How far a point lies outside the surface, in metres; inside, minus its depth.
    pub fn outside(&self, point: DVec3) -> f64 {
        let core = Placed3 { vertices: vec![point], normals: vec![], facets: vec![], edges: vec![] };
        separation_of3(self, &Self::Round { core, is_solid: false, radius: 0.0 }).separation
    }

    /// The gap between projections on a unit axis from this piece to another; for a half-space, along its own normal.
    pub fn gap_along(&self, other: &Self, axis: DVec3) -> f64 {
        match (self, other) {
            (Self::Round { core, radius, .. }, Self::Round { core: far, radius: more, .. }) => {
                gap3(core, far, axis) - radius - more
            }
            (Self::HalfSpace { normal, .. }, _) if (axis - *normal).length() < 2e-7 => {
                separation_of3(self, other).separation
            }
            (_, Self::HalfSpace { normal, .. }) if (axis + *normal).length() < 2e-7 => {
                separation_of3(self, other).separation
            }
            _ => f64::NEG_INFINITY,
        }
    }
}

impl Piece2 {
    /// How far a point lies outside the outline, in metres; inside, minus its depth.
    pub fn outside(&self, point: DVec2) -> f64 {
        let core = Placed2 { vertices: vec![point] };
        separation_of2(self, &Self::Round { core, radius: 0.0 }).separation
    }

    /// The gap between projections on a unit axis from this piece to another; for a half-plane, along its own normal.
    pub fn gap_along(&self, other: &Self, axis: DVec2) -> f64 {
        match (self, other) {
            (Self::Round { core, radius }, Self::Round { core: far, radius: more }) => {
                gap2(core, far, axis) - radius - more
            }
            (Self::HalfPlane { normal, .. }, _) if (axis - *normal).length() < 2e-7 => {
                separation_of2(self, other).separation
            }
            (_, Self::HalfPlane { normal, .. }) if (axis + *normal).length() < 2e-7 => {
                separation_of2(self, other).separation
            }
            _ => f64::NEG_INFINITY,
        }
    }
}
