//! Contact points of two faces that look at each other.
//!
//! ```text
//! in the reference face's own plane: its rectangle |u| <= U, |v| <= V; the other face a parallelogram f +- p +- q
//! each of its four edges against both slabs: where it comes in, where it goes out
//!     it starts within: its corner                      it comes in: a crossing
//!     it goes out: a crossing
//! each corner of the rectangle within the parallelogram
//! what is no higher than wanted is kept; of more than four points, four
//! ```
//! Liang and Barsky, "A new concept and method for line clipping" (1984). Three times four slots, side by side,
//! whatever the patch looks like, and one bit a slot that says whether a point is there: nothing branches on the
//! patch's shape. Names are made for the points that are kept, and for no other.
//!
//! Where a corner lies on the line of an edge, up to a slack, several features meet in one place, and which of them
//! names it depends on the order in which sides are cut. That is left to the general clipper, whose names count.

use super::super::manifold::near::{LiesOn, Rim};
use super::names::{self, Name, Names};
use super::placed::Placed;
use crate::lanes::Lanes;
use asunder_geometry::glam::DVec3;

/// Slots of a patch: the starts of the incident face's four edges within the rectangle, their ends, the four
/// corners of the rectangle, and four that are never used, so that an index costs no division.
pub(super) const SLOTS: usize = 16;

/// The patch that two faces share.
pub(super) struct Patch {
    pub(super) u: [f64; SLOTS],
    pub(super) v: [f64; SLOTS],
    /// Over the reference face's plane, along the direction of measurement.
    pub(super) height: [f64; SLOTS],
    /// Half the sides of the reference face, and the corners of the other as they are seen, u and v.
    half: [f64; 2],
    around: [[f64; 4]; 2],
    /// Which corners there are, clockwise around the patch, one bit each: see [`Patch::slot`].
    pub(super) held: u32,
    /// Whether all corners stand apart from each other and from every line.
    pub(super) is_clear: bool,
    /// The same by what counts as near for names: then all are named after what they lie on.
    pub(super) is_apart: bool,
    pub(super) reference: Reference,
    /// What happens to each edge, in bits: see [`Patch::names`].
    cuts: [u8; 4],
    /// For each edge, the corner of the reference face that follows where it goes out.
    follows: [u8; 4],
}

/// Which faces make a patch.
#[derive(Clone, Copy)]
pub(super) struct Reference {
    pub(super) is_b: bool,
    /// The face that heights are measured from.
    pub(super) face: usize,
    /// The face of the other cuboid that looks at it.
    pub(super) incident: usize,
}

/// Which patch of two faces is asked for.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    pub(super) reference: Reference,
    /// Corners no higher than this, in metres.
    pub(super) within: f64,
    pub(super) slack: f64,
    /// How near a corner is named after what is there.
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

/// The axis that a face looks along, and the two in it, in the order in which its corners run counter-clockwise.
const AXES: [[usize; 3]; 6] = [[0, 2, 1], [0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0], [2, 0, 1]];

/// As [`AXES`] has it.
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

    /// A face and the one of the other cuboid that is most opposed to it, of those at its furthest corners. Nothing
    /// where the incident cuboid is all within the slack.
    ///
    /// Corners that an edge joins are as far as each other where the edge rises by no more than the slack: then its
    /// axis' faces have only some of them.
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
    /// Shares of the edges at which they come in and go out again.
    enter: Lanes<4>,
    leave: Lanes<4>,
    /// How far the edges' starts lie from its sides.
    off: Lanes<4>,
}

impl Slab {
    #[inline(always)]
    fn new(from: Lanes<4>, step: Lanes<4>, half: f64) -> Self {
        // Opposite edges run alike.
        let (one, other) = (1.0 / step.0[0], 1.0 / step.0[1]);
        let inverse = Lanes([one, other, -one, -other]);
        let low = (Lanes::all(-half) - from) * inverse;
        let high = (Lanes::all(half) - from) * inverse;
        let off = (from.abs() - Lanes::all(half)).abs();
        let (mut enter, mut leave) = (low.least(high), low.greatest(high));
        if one.is_infinite() | other.is_infinite() {
            // An edge that runs along a side, and on its very line, is within: nothing times no end is no number, and
            // would have the other slab forgotten. So is one between both sides, whose shares have no end either way.
            for k in (0..4).filter(|&k| (low.0[k] + high.0[k]).is_nan()) {
                (enter.0[k], leave.0[k]) = (f64::NEG_INFINITY, f64::INFINITY);
            }
        }
        Self { enter, leave, off }
    }
}

impl Faces {
    /// The same as seen along a unit axis that leans: heights are along it, and what is higher lies further aside.
    #[inline(always)]
    pub(super) fn leaning(self, reference: &Reference, normal: DVec3) -> Self {
        let [i, u, v] = axes_of(reference.face);
        let by_height = 1.0 / (normal[i] * sign_of(reference.face));
        let (aside_u, aside_v) = (normal[u], normal[v]);
        let seen = |[u, v, height]: [f64; 3]| {
            let height = height * by_height;
            [u - aside_u * height, v - aside_v * height, height]
        };
        Self { half: self.half, center: seen(self.center), p: seen(self.p), q: seen(self.q) }
    }

    /// The common patch. To be called through `super::wide`, which compiles it.
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
        // Clockwise, a corner follows where an edge goes out through the side that it begins, or another corner.
        // Where no edge goes out there are four, or none.
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

    /// The corners of the reference face with the incident face's heights there; a positive number for each that is
    /// within the incident face; and how far they lie from the nearest line of an edge, or less.
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
        // By the lengths of the edges they are distances; sums of coordinates are no shorter.
        let (by_p, by_q) = (1.0 / (q[0].abs() + q[1].abs()), 1.0 / (p[0].abs() + p[1].abs()));
        let off = (inside_p.abs() * by_p).least(inside_q.abs() * by_q);
        ([u, v, heights], inside_p.least(inside_q), off)
    }
}

/// The side of a face through which an edge comes in (first) or goes out, by bits 1 to 4 of its cut, as `Faces::patch`
/// makes them: whether u decides where it comes in, and where it goes out; whether it runs up u, and v.
///
/// Sides in order: -v, +u, +v, -u. An edge that runs up comes in at the lower side.
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

/// How many slacks a corner keeps from every line of an edge where nothing but the corner names it. The clipper
/// takes its slack by the sum of coordinates, which is up to a root of two of a distance; and what it joins is
/// nearer than one.
const CLEAR: f64 = 1.5;

/// No place in the order of corners.
const NONE: usize = 32;

impl Patch {
    /// The slot of a bit of `held`: of eight for each edge, the first for its start, the next for its end, and
    /// those after that for the corners of the reference face that follow it.
    #[inline(always)]
    pub(super) fn slot(&self, place: u32) -> usize {
        let (k, turn) = (place as usize / 8 % 4, place as usize % 8);
        let corner = 8 + (usize::from(self.follows[k]) + 6 - turn) % 4;
        if turn < 2 { 4 * turn + k } else { corner }
    }

    /// What a slot's corner is named after by what is within so many metres: see `super::super::manifold::near`.
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

    /// What a slot's corner is named after by what it lies on.
    #[inline(always)]
    pub(super) fn names(&self, slot: usize) -> Names {
        let [of_reference, of_incident] = self.lies_on(slot);
        self.named(of_reference, of_incident)
    }

    /// What a slot's corner lies on, of the reference face and of the other.
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
