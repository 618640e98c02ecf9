//! The common patch of two faces of cuboids, from which contact points are made.
//!
//! ```text
//! in the reference face's plane: its rectangle |u| <= U, |v| <= V; the incident face a parallelogram f +- p +- q
//! clip each of the incident face's four edges against both slabs: where does it enter, where does it leave
//!     it starts within: its start is a corner           it enters: a crossing
//!     it leaves: a crossing
//! each corner of the rectangle within the parallelogram is a corner
//! keep what is no higher than wanted; of more than four points, four
//! ```
//! Liang and Barsky, "A new concept and method for line clipping" (1984). There are three times four slots, side by
//! side, and one bit per slot that says whether it holds a point: nothing branches on the patch's shape. Names are made
//! only for the points that are kept.
//!
//! Where a corner lies on the line of an edge, up to a slack, several features meet in one place, and its name depends
//! on the order in which sides are cut. That case is left to the general clipper, whose names are the definition.

use super::super::manifold::near::{LiesOn, Rim};
use super::names::{self, Name, Names};
use super::placed::Placed;
use crate::lanes::Lanes;
use asunder_geometry::glam::DVec3;

/// Slots of a patch: where each of the incident face's four edges begins within the rectangle, where each ends, the
/// four corners of the rectangle, and four unused, so that reducing an index needs no division.
pub(super) const SLOTS: usize = 16;

/// The common patch of two faces.
pub(super) struct Patch {
    pub(super) u: [f64; SLOTS],
    pub(super) v: [f64; SLOTS],
    /// Height over the reference face's plane, along the direction of measurement.
    pub(super) height: [f64; SLOTS],
    /// Half the sides of the reference face, and the projected corners of the incident face, u and v.
    half: [f64; 2],
    around: [[f64; 4]; 2],
    /// Which corners exist, clockwise around the patch, one bit each: see [`Patch::slot`].
    pub(super) held: u32,
    /// Whether all corners keep clear of each other and of every edge's line.
    pub(super) is_clear: bool,
    /// The same at the distance that counts as near for names: then every corner is named after what it lies on.
    pub(super) is_apart: bool,
    pub(super) reference: Reference,
    /// How each edge is cut, in bits: see [`Patch::names`].
    cuts: [u8; 4],
    /// For each edge, the corner of the reference face that follows the edge's exit.
    follows: [u8; 4],
}

/// Which faces form a patch.
#[derive(Clone, Copy)]
pub(super) struct Reference {
    pub(super) is_b: bool,
    /// The face from which heights are measured.
    pub(super) face: usize,
    /// The face of the other cuboid that faces it.
    pub(super) incident: usize,
}

/// Which patch of two faces is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    pub(super) reference: Reference,
    /// Corners no higher than this, in metres.
    pub(super) within: f64,
    pub(super) slack: f64,
    /// How near a corner must be to a feature to be named after it.
    pub(super) near: f64,
}

/// Both faces in the reference face's plane: coordinates u, v, height.
pub(super) struct Faces {
    half: [f64; 2],
    center: [f64; 3],
    /// From the incident face's centre to the middles of two edges.
    p: [f64; 3],
    q: [f64; 3],
}

/// The axis of a face's normal, and the two axes in it, in the order in which its corners run counter-clockwise.
const AXES: [[usize; 3]; 6] = [[0, 2, 1], [0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0], [2, 0, 1]];

/// From [`AXES`].
#[inline(always)]
pub(super) fn axes_of(face: usize) -> [usize; 3] {
    AXES[face % 6]
}

#[inline(always)]
pub(super) fn sign_of(face: usize) -> f64 {
    if face % 2 == 1 { 1.0 } else { -1.0 }
}

/// The incident cuboid in the axes of the reference cuboid.
struct Incident<'a> {
    /// All of B's axes seen from A.
    turn: &'a [f64; 9],
    /// Steps in `turn` from axis to axis, and from coordinate to coordinate.
    strides: [usize; 2],
    half: [f64; 3],
    center: [f64; 3],
}

impl Incident<'_> {
    /// A coordinate of an axis.
    #[inline(always)]
    fn axis(&self, l: usize, coordinate: usize) -> f64 {
        self.turn[(l * self.strides[0] + coordinate * self.strides[1]) % 9]
    }
}

impl Placed {
    #[inline(always)]
    fn incident(&self, is_b: bool) -> Incident<'_> {
        let [x, y, z, _] = self.fifteen.ahead.0;
        Incident {
            turn: &self.turn,
            strides: if is_b { [1, 3] } else { [3, 1] },
            half: self.half[usize::from(!is_b)].to_array(),
            center: if is_b { [-x, -y, -z] } else { self.offset.to_array() },
        }
    }

    /// A face, and the most opposed face of the other cuboid, of those at its furthest corners. `None` if the incident
    /// cuboid is all within the slack.
    ///
    /// If the edges along an axis rise by no more than the slack, both ends of such an edge count as furthest. Then
    /// each face across that axis has only some of the furthest corners, and is passed over.
    #[inline(always)]
    pub(super) fn faces(&self, is_b: bool, face: usize, slack: f64) -> Option<(Reference, Faces)> {
        let other = self.incident(is_b);
        let [i, u, v] = axes_of(face);
        let out = sign_of(face);
        let mut best = (0.0_f64, 0);
        for l in 0..3 {
            let rise = other.axis(l, i);
            let is_better = (2.0 * other.half[l] * rise.abs() > slack) & (rise.abs() > best.0.abs());
            best = if is_better { (rise, l) } else { best };
        }
        let rise = best.0 * out;
        let incident = 2 * best.1 + usize::from(rise < 0.0);
        let reference = Reference { is_b, face, incident };
        let [l, first, second] = axes_of(incident);
        let reach = if rise < 0.0 { other.half[l] } else { -other.half[l] };
        let half = self.half[usize::from(is_b)];
        let along =
            |l: usize, by: f64| [other.axis(l, u) * by, other.axis(l, v) * by, other.axis(l, i) * by * out];
        let [middle_u, middle_v, middle] = along(l, reach);
        let faces = Faces {
            half: [half[u], half[v]],
            center: [
                other.center[u] + middle_u,
                other.center[v] + middle_v,
                other.center[i] * out + middle - half[i],
            ],
            p: along(first, other.half[first]),
            q: along(second, other.half[second]),
        };
        (rise != 0.0).then_some((reference, faces))
    }
}

/// The four edges of the incident face against a slab.
struct Slab {
    /// Shares of the edges at which they enter and leave.
    enter: Lanes<4>,
    leave: Lanes<4>,
    /// How far the edges' starts lie from its sides.
    off: Lanes<4>,
}

impl Slab {
    #[inline(always)]
    fn new(from: Lanes<4>, step: Lanes<4>, half: f64) -> Self {
        // Opposite edges run in opposite directions.
        let (one, other) = (1.0 / step.0[0], 1.0 / step.0[1]);
        let inverse = Lanes([one, other, -one, -other]);
        let low = (Lanes::all(-half) - from) * inverse;
        let high = (Lanes::all(half) - from) * inverse;
        let off = (from.abs() - Lanes::all(half)).abs();
        let (mut enter, mut leave) = (low.least(high), low.greatest(high));
        if one.is_infinite() | other.is_infinite() {
            // An edge that runs exactly along the line of a side is within: 0 times infinity is NaN, and would make the
            // other slab be ignored. So is an edge between both sides, which enters and leaves at infinity.
            for k in (0..4).filter(|&k| (low.0[k] + high.0[k]).is_nan()) {
                (enter.0[k], leave.0[k]) = (f64::NEG_INFINITY, f64::INFINITY);
            }
        }
        Self { enter, leave, off }
    }
}

impl Faces {
    /// The same as projected along a unit axis that leans: heights are along it, and higher points are shifted
    /// sideways.
    #[inline(always)]
    pub(super) fn leaning(self, reference: &Reference, normal: DVec3) -> Self {
        let [i, u, v] = axes_of(reference.face);
        let by_height = 1.0 / (normal[i] * sign_of(reference.face));
        let (aside_u, aside_v) = (normal[u], normal[v]);
        let sheared = |[u, v, height]: [f64; 3]| {
            let height = height * by_height;
            [u - aside_u * height, v - aside_v * height, height]
        };
        Self { half: self.half, center: sheared(self.center), p: sheared(self.p), q: sheared(self.q) }
    }

    /// Computes the common patch. To be called through `super::wide`, which compiles it.
    #[inline(always)]
    pub(super) fn patch(&self, &Wanted { reference, within, slack, near: same }: &Wanted) -> Patch {
        let around = |c: usize| {
            let (f, p, q) = (self.center[c], self.p[c], self.q[c]);
            let (low, high) = (f - p, f + p);
            (Lanes([low - q, high - q, high + q, low + q]), Lanes([2.0 * p, 2.0 * q, -2.0 * p, -2.0 * q]))
        };
        let [(u, step_u), (v, step_v), (height, rise)] = [around(0), around(1), around(2)];
        let (slab_u, slab_v) = (Slab::new(u, step_u, self.half[0]), Slab::new(v, step_v, self.half[1]));
        let enter = slab_u.enter.greatest(slab_v.enter);
        let leave = slab_u.leave.least(slab_v.leave);
        let (begin, end) = (enter.greatest(Lanes::all(0.0)), leave.least(Lanes::all(1.0)));
        let starts = [u + step_u * begin, v + step_v * begin, height + rise * begin];
        let ends = [u + step_u * end, v + step_v * end, height + rise * end];
        let (corners, inside, off_edges) = self.corners();
        let (mut held, mut cuts, mut follows, mut exits) = (0, [0; 4], [0; 4], [NONE; 4]);
        for k in 0..4 {
            let is_within = begin.0[k] < end.0[k];
            let is_cut = is_within & (leave.0[k] < 1.0);
            let is_low = |height: &Lanes<4>| height.0[k] <= within;
            held |= u32::from(is_within & is_low(&starts[2])) << (8 * k);
            held |= u32::from(is_cut & is_low(&ends[2])) << (8 * k + 1);
            let cut = u8::from(enter.0[k] > 0.0)
                | u8::from(slab_u.enter.0[k] > slab_v.enter.0[k]) << 1
                | u8::from(slab_u.leave.0[k] < slab_v.leave.0[k]) << 2
                | u8::from(step_u.0[k] > 0.0) << 3
                | u8::from(step_v.0[k] > 0.0) << 4;
            cuts[k] = cut;
            let side = SIDES[1][usize::from(cut >> 1) % 16];
            follows[k] = side;
            let exit = &mut exits[usize::from(side) % 4];
            *exit = if is_cut { 8 * k + 2 } else { *exit };
        }
        // Clockwise, a corner of the reference face follows the edge that leaves through the side that begins at the
        // corner, or it follows another corner. Where no edge leaves, all four are corners of the patch, or none.
        let is_uncut = exits[0].min(exits[1]).min(exits[2].min(exits[3])) == NONE;
        follows[0] = if is_uncut { 3 } else { follows[0] };
        for k in 0..4 {
            let exit = |turn: usize| exits[(k + turn) % 4] + turn;
            let later = if exit(2) < NONE { exit(2) } else { exit(3) };
            let later = if exit(1) < NONE { exit(1) } else { later };
            let place = if exit(0) < NONE { exit(0) } else { later };
            let place = if is_uncut { 5 - k } else { place };
            held |= u32::from((inside.0[k] > 0.0) & (corners[2].0[k] <= within)) << (place % 32);
        }
        let off = slab_u.off.least(slab_v.off).least(off_edges).0;
        let near = CLEAR * slack;
        let join = |c: usize| {
            let ([a, b, c, d], [e, f, g, h], [i, j, k, l]) = (starts[c].0, ends[c].0, corners[c].0);
            [a, b, c, d, e, f, g, h, i, j, k, l, 0.0, 0.0, 0.0, 0.0]
        };
        Patch {
            u: join(0),
            v: join(1),
            height: join(2),
            half: self.half,
            around: [u.0, v.0],
            held,
            is_clear: (off[0] > near) & (off[1] > near) & (off[2] > near) & (off[3] > near),
            is_apart: (off[0] > same) & (off[1] > same) & (off[2] > same) & (off[3] > same),
            reference,
            cuts,
            follows,
        }
    }

    /// The corners of the reference face with the incident face's heights there; for each, a number that is positive if
    /// it is within the incident face; and a lower bound on its distance from the nearest edge's line.
    #[inline(always)]
    fn corners(&self) -> ([Lanes<4>; 3], Lanes<4>, Lanes<4>) {
        let (f, p, q) = (self.center, self.p, self.q);
        let [half_u, half_v] = self.half;
        let (u, v) = (Lanes([-half_u, half_u, half_u, -half_u]), Lanes([-half_v, -half_v, half_v, half_v]));
        let area = p[0] * q[1] - p[1] * q[0];
        let inverse = 1.0 / area;
        let (from_u, from_v) = (u - Lanes::all(f[0]), v - Lanes::all(f[1]));
        let along_p = from_u * q[1] - from_v * q[0];
        let along_q = from_v * p[0] - from_u * p[1];
        let heights = Lanes::all(f[2]) + (along_p * (p[2] * inverse) + along_q * (q[2] * inverse));
        let size = Lanes::all(area.abs());
        let (inside_p, inside_q) = (size - along_p.abs(), size - along_q.abs());
        // Divided by the edges' lengths these are distances; sums of coordinates are no shorter than lengths.
        let (by_p, by_q) = (1.0 / (q[0].abs() + q[1].abs()), 1.0 / (p[0].abs() + p[1].abs()));
        let off = (inside_p.abs() * by_p).least(inside_q.abs() * by_q);
        ([u, v, heights], inside_p.least(inside_q), off)
    }
}

/// The side of a face through which an edge enters (first) or leaves. The index is bits 1 to 4 of the edge's cut, as
/// made by `Faces::patch`: whether u decides where it enters, and where it leaves; whether it runs up u, and v.
///
/// Sides in order: -v, +u, +v, -u. An edge that runs up a coordinate enters at the lower side.
const SIDES: [[u8; 16]; 2] = sides();

const fn sides() -> [[u8; 16]; 2] {
    let mut sides = [[0; 16]; 2];
    let mut cut = 0;
    while cut < 16 {
        let (up_u, up_v) = (cut & 4 != 0, cut & 8 != 0);
        sides[0][cut] = match (cut & 1 != 0, up_u, up_v) {
            (true, true, _) => 3,
            (true, false, _) => 1,
            (false, _, true) => 0,
            (false, _, false) => 2,
        };
        sides[1][cut] = match (cut & 2 != 0, up_u, up_v) {
            (true, true, _) => 1,
            (true, false, _) => 3,
            (false, _, true) => 2,
            (false, _, false) => 0,
        };
        cut += 1;
    }
    sides
}

/// How many slacks a corner must keep from every edge's line to have an unambiguous name. The clipper measures its
/// slack by a sum of coordinates, which is up to a root of two times a distance; and the corners it joins are nearer
/// than one slack.
const CLEAR: f64 = 1.5;

/// No place in the order of corners.
const NONE: usize = 32;

impl Patch {
    /// The slot of a bit of `held`. Each edge has eight bits: the first for its start, the next for its end, and then
    /// those of the corners of the reference face that follow it.
    #[inline(always)]
    pub(super) fn slot(&self, place: u32) -> usize {
        let (k, turn) = (place as usize / 8 % 4, place as usize % 8);
        let corner = 8 + (usize::from(self.follows[k]) + 6 - turn) % 4;
        if turn < 2 { 4 * turn + k } else { corner }
    }

    /// The name of a slot's corner by the features within `near` metres: see `super::super::manifold::near`.
    pub(super) fn names_near(&self, slot: usize, near: f64) -> Names {
        let [half_u, half_v] = self.half;
        let (us, vs) = ([-half_u, half_u, half_u, -half_u], [-half_v, -half_v, half_v, half_v]);
        let [around_u, around_v] = &self.around;
        let reference = Rim { place: |k: usize| [us[k], vs[k]], count: 4, first: 0 };
        let incident = Rim { place: |k: usize| [around_u[k], around_v[k]], count: 4, first: 0 };
        let at = [self.u[slot % SLOTS], self.v[slot % SLOTS]];
        let [of_reference, of_incident] = self.lies_on(slot);
        self.named(reference.near(at, of_reference, near), incident.near(at, of_incident, near))
    }

    /// The name of a slot's corner by the features it lies on.
    #[inline(always)]
    pub(super) fn names(&self, slot: usize) -> Names {
        let [of_reference, of_incident] = self.lies_on(slot);
        self.named(of_reference, of_incident)
    }

    /// The features of the reference face and of the other that a slot's corner lies on.
    #[inline(always)]
    fn lies_on(&self, slot: usize) -> [LiesOn; 2] {
        let (k, group) = (slot % 4, slot / 4);
        let cut = usize::from(self.cuts[k]);
        match group {
            0 if cut & 1 == 0 => [LiesOn::Face, LiesOn::Vertex(k as u16)],
            0 | 1 => {
                let side = SIDES[group & 1][cut >> 1 & 15];
                [LiesOn::Edge(side.into()), LiesOn::Edge(k as u16)]
            }
            _ => [LiesOn::Vertex(k as u16), LiesOn::Face],
        }
    }

    #[inline(always)]
    fn named(&self, of_reference: LiesOn, of_incident: LiesOn) -> Names {
        let Reference { is_b, face, incident } = self.reference;
        let name = |face: usize, of: LiesOn| match of {
            LiesOn::Vertex(k) => Name::vertex(names::corner(face, k.into())),
            LiesOn::Edge(k) => Name::edge(names::edge(face, k.into())),
            LiesOn::Face => Name::face(face),
        };
        Names::new(name(face, of_reference), name(incident, of_incident), is_b)
    }
}
