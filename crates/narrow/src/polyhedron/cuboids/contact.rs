//! Contact points of two sharp cuboids that overlap, and what contacts across a gap (`super::gap`) share with them. The
//! rules are those of `super::super::manifold`.

use super::super::sat::AxisOf;
use super::names::{self, Names};
use super::patch::{Patch, Reference, SLOTS, Wanted, axes_of, sign_of};
use super::placed::{Placed, Posed};
use super::reduce::four_of;
use super::settled::Best;
use super::wide;
use crate::answer::{ContactPoint3, Manifold3};
use crate::feature::{Feature, FeatureId};
use crate::lanes::Lanes;
use crate::plumb::{ends, stays_on_a};
use crate::points::ContactPoints;
use crate::precision::signed;
use asunder_geometry::Basis3;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::ALIGNED_FACES;

impl Manifold3 {
    /// To be filled in place: it is large, and every copy of it costs.
    pub(crate) const BLANK: Self = Self {
        part_a: 0,
        part_b: 0,
        normal: Vec3::ZERO,
        separation: 0.0,
        error: 0.0,
        points: ContactPoints::new(),
    };
}

/// Two cuboids that overlap or nearly do, with what their contact points are built from.
pub(super) struct Touching<'a> {
    pub(super) posed: &'a Posed<'a>,
    pub(super) placed: &'a Placed,
    pub(super) best: &'a Best,
    /// Points no higher than this are wanted, in metres.
    pub(super) margin: f64,
    /// The axis on which the points of the last frame were built.
    pub(super) last: Option<AxisOf>,
}

impl Touching<'_> {
    /// The axis on which the points are built.
    #[inline(always)]
    pub(super) fn measured_from(&self) -> AxisOf {
        self.kept().unwrap_or_else(|| self.preferred())
    }

    /// Fills in a manifold built on an axis; `None` where the general path must take over.
    #[inline(always)]
    pub(super) fn fill(&self, of: AxisOf, manifold: &mut Manifold3) -> Option<()> {
        let Self { placed, best, .. } = *self;
        if placed.radii > 0.0 {
            return None;
        }
        let separation = best.separation();
        match of {
            AxisOf::FaceA(face) => self.over_face(face, false, |patch| self.fill_over(patch, manifold))?,
            AxisOf::FaceB(face) => self.over_face(face, true, |patch| self.fill_over(patch, manifold))?,
            AxisOf::Edges(edge_a, edge_b) => self.over_edges(edge_a, edge_b, manifold)?,
        }
        manifold.separation = signed(separation, true);
        manifold.error = placed.precision.of_separation(separation, best.short);
        Some(())
    }

    /// The axis of last frame's points, unless another beats it by more than two preferences.
    #[inline(always)]
    fn kept(&self) -> Option<AxisOf> {
        let Self { placed, best, .. } = *self;
        let last = self.last?;
        let separation = match last {
            AxisOf::FaceA(face) if face < 6 && last == placed.of_face_a(face / 2) => {
                placed.fifteen.faces_a[face / 2]
            }
            AxisOf::FaceB(face) if face < 6 && last == placed.of_face_b(face / 2) => {
                placed.fifteen.faces_b.0[face / 2]
            }
            AxisOf::Edges(..) => {
                let edges = best.edges.filter(|edges| last == placed.of_edges(edges.pair))?;
                edges.separation
            }
            _ => return None,
        };
        (separation >= best.separation() - 2.0 * placed.preference).then_some(last)
    }

    /// A face of A, unless a face of B or two edges beat it by more than the preference.
    #[inline(always)]
    fn preferred(&self) -> AxisOf {
        let Self { placed, best, .. } = *self;
        let is_b = best.face_b.separation > best.face_a.separation + placed.preference;
        let face = if is_b { best.face_b } else { best.face_a };
        match best.edges.filter(|edges| edges.separation > face.separation + placed.preference) {
            Some(edges) => placed.of_edges(edges.pair),
            None if is_b => placed.of_face_b(face.axis),
            None => placed.of_face_a(face.axis),
        }
    }

    /// Points no higher than this count as deepest.
    #[inline(always)]
    fn deep(&self) -> f64 {
        self.best.separation() + self.placed.preference
    }

    /// Passes the patch of a face and its incident face to `run`. A patch is large, and is not moved from where it is
    /// made.
    #[inline(always)]
    pub(super) fn over_face<R>(
        &self,
        face: usize,
        is_b: bool,
        run: impl FnOnce(&Patch) -> Option<R>,
    ) -> Option<R> {
        let (slack, near, deep) = (self.placed.preference, self.placed.near, self.deep());
        let within = if deep > self.margin { deep } else { self.margin };
        let (reference, faces) = self.placed.faces(is_b, face, slack)?;
        run(&wide::patch(&faces, &Wanted { reference, within, slack, near }))
    }

    /// Points of the faces beside two edges, if they nearly face each other; else the point where the edges cross.
    #[inline(never)]
    fn over_edges(&self, edge_a: usize, edge_b: usize, manifold: &mut Manifold3) -> Option<()> {
        let Self { placed, best, .. } = *self;
        let normal = placed.edge_normal(best.edges?.pair);
        if looks(normal) && looks(placed.relative.turn_back(normal)) {
            return self.over_leaning(normal, manifold);
        }
        manifold.normal = placed.basis.turn(normal).as_vec3();
        let point = self.crossing(normal, edge_a, edge_b);
        manifold.points.push(point);
        (f64::from(point.separation) <= self.deep()).then_some(())
    }

    /// Points of the two faces that an axis from A to B is nearly normal to, as projected along the axis.
    ///
    /// Most cuboids that tremble on each other touch in this way: of 64 pairs that lean by some 1e-4 rad, a pair takes
    /// 4.6 thousand instructions in all, and 10.0 where the general path took these (AMD EPYC, Zen 4, 2 virtual cores,
    /// 2026-11-22).
    #[inline(never)]
    pub(super) fn over_leaning(&self, normal: DVec3, manifold: &mut Manifold3) -> Option<()> {
        let (slack, near, deep) = (self.placed.preference, self.placed.near, self.deep());
        let within = if deep > self.margin { deep } else { self.margin };
        let size = normal.abs();
        let axis = if size.x >= ALIGNED_FACES { 0 } else { 2 - usize::from(size.y >= ALIGNED_FACES) };
        let face = 2 * axis + usize::from(normal[axis] > 0.0);
        let (reference, faces) = self.placed.faces(false, face, slack)?;
        let faces = faces.leaning(&reference, normal);
        let patch = wide::patch(&faces, &Wanted { reference, within, slack, near });
        wide::fill(self, &patch, Some(self.placed.basis.turn(normal)), manifold)
    }

    /// At most four corners of a patch as contact points; `None` where none is as deep as the axis says.
    #[inline(always)]
    pub(super) fn fill_over(&self, patch: &Patch, manifold: &mut Manifold3) -> Option<()> {
        wide::fill(self, patch, None, manifold)
    }

    /// The same along whatever axis the patch's heights are measured: the reference face's normal, or a leaning axis.
    /// To be called through `super::wide`, which compiles it.
    #[inline(always)]
    pub(super) fn fill_along(
        &self,
        patch: &Patch,
        leaning: Option<DVec3>,
        manifold: &mut Manifold3,
    ) -> Option<()> {
        let count = patch.held.count_ones() as usize;
        if !patch.is_clear || count > 8 {
            return None;
        }
        let (mut slots, mut rest, mut deepest) = ([0; 8], patch.held, f64::INFINITY);
        for slot in &mut slots[..count] {
            *slot = patch.slot(rest.trailing_zeros());
            rest &= rest.wrapping_sub(1);
            deepest = deepest.min(patch.height[*slot % SLOTS]);
        }
        if deepest > self.deep() {
            return None;
        }
        let slots = match count {
            0..=4 => [slots[0], slots[1], slots[2], slots[3]],
            _ => four_of(patch, &slots, count, deepest + self.placed.even),
        };
        let count = count.min(4);
        let mut order = [u32::MAX; 4];
        for (place, &slot) in order.iter_mut().zip(&slots[..count]) {
            *place = patch.names(slot).0 << 4 | slot as u32;
        }
        sort(&mut order);
        if !patch.is_apart {
            order = named_near(patch, &order[..count], self.placed.near);
            sort(&mut order);
        }
        let over = Over::new(self, &patch.reference);
        let out = leaning.unwrap_or(over.out);
        Over { out, ..over }.write(patch, &order[..count], manifold);
        Some(())
    }

    /// The nearest points of two edges that cross, as a contact point.
    #[inline]
    fn crossing(&self, normal: DVec3, edge_a: usize, edge_b: usize) -> ContactPoint3 {
        let nearest = self.placed.nearest_of(edge_a, edge_b);
        self.contact_at(nearest, normal, (edge_a, edge_b))
    }

    /// A contact point from two edges' points, which are in A's axes.
    #[inline(always)]
    pub(super) fn contact_at(
        &self,
        [on_a, on_b]: [DVec3; 2],
        normal: DVec3,
        (edge_a, edge_b): (usize, usize),
    ) -> ContactPoint3 {
        let Placed { basis, offset, .. } = self.placed;
        let separation = normal.dot(on_b - on_a) as f32;
        let out = basis.turn(normal).as_vec3().as_dvec3() * f64::from(separation);
        let is_by_a = stays_on_a(false, self.placed.half.map(DVec3::length_squared));
        let held = if is_by_a { basis.turn(on_a) } else { basis.turn(on_b - *offset) };
        // Rounded as it is reported.
        let held = held.as_vec3().as_dvec3();
        let [anchor_a, anchor_b] = ends(held, is_by_a, self.posed.between(), out);
        ContactPoint3 {
            separation,
            anchor_a: anchor_a.as_vec3(),
            anchor_b: anchor_b.as_vec3(),
            feature: FeatureId::new(Feature::Edge(edge_a as u32), Feature::Edge(edge_b as u32)),
        }
    }
}

impl Placed {
    /// The nearest points of two edges' lines, each clamped to its edge; in A's axes.
    #[inline]
    pub(super) fn nearest_of(&self, edge_a: usize, edge_b: usize) -> [DVec3; 2] {
        let Self { half, offset, .. } = self;
        let (i, j) = (names::axis_of(edge_a), names::axis_of(edge_b));
        let corner = |half: DVec3, corner: usize| {
            let side = |axis: usize| if corner >> axis & 1 == 1 { half[axis] } else { -half[axis] };
            DVec3::new(side(0), side(1), side(2))
        };
        let a0 = corner(half[0], names::start(edge_a) & !(1 << i));
        let b0 = *offset + self.relative.turn(corner(half[1], names::start(edge_b) & !(1 << j)));
        let along_a = DVec3::AXES[i] * (2.0 * half[0][i]);
        let along_b = self.axis_b(j) * (2.0 * half[1][j]);
        let (between, cross) = (b0 - a0, along_a.cross(along_b));
        // The axis came from this cross product, so it is not zero.
        let inverse = 1.0 / cross.length_squared();
        let s = (between.cross(along_b).dot(cross) * inverse).clamp(0.0, 1.0);
        let t = (between.cross(along_a).dot(cross) * inverse).clamp(0.0, 1.0);
        [a0 + along_a * s, b0 + along_b * t]
    }
}

/// Whether a face of a cuboid nearly faces along a direction given in its axes, or against it.
#[inline(always)]
pub(super) fn looks(direction: DVec3) -> bool {
    direction.abs().max_element() >= ALIGNED_FACES
}

/// Renames slots after what they are near, instead of what they lie on. Those that would get the same name keep their
/// own.
#[inline(never)]
fn named_near(patch: &Patch, order: &[u32], near: f64) -> [u32; 4] {
    let (mut named, mut alike) = ([u32::MAX; 4], 0);
    for (k, &lies_on) in order.iter().enumerate().take(4) {
        let slot = lies_on & 15;
        named[k] = patch.names_near(slot as usize, near).0 << 4 | slot;
        for before in 0..k {
            // The same slot twice is one point.
            let is_alike = named[before] ^ named[k] != 0 && named[before] >> 4 == named[k] >> 4;
            alike |= u32::from(is_alike) << before | u32::from(is_alike) << k;
        }
    }
    for (k, &lies_on) in order.iter().enumerate().take(4) {
        named[k] = if alike >> k & 1 == 1 { lies_on } else { named[k] };
    }
    named
}

/// Sorts ascending, by five comparisons.
#[inline(always)]
fn sort(order: &mut [u32; 4]) {
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        let (one, other) = (order[i], order[j]);
        (order[i], order[j]) = (one.min(other), one.max(other));
    }
}

/// A reference face in the world, from which anchors are computed.
struct Over {
    /// From the reference body's position to the centre of the face.
    middle: DVec3,
    u: DVec3,
    v: DVec3,
    /// Outward normal of the reference face, or the axis along which heights are measured where that leans.
    out: DVec3,
    /// From the other body's position to the reference body's.
    back: DVec3,
    is_b: bool,
    /// Whether the points' ends on the face are kept, and the other ends derived from them: see `crate::plumb`.
    do_feet_stay: bool,
}

impl Over {
    #[inline(always)]
    fn new(touching: &Touching, reference: &Reference) -> Self {
        let Touching { posed, placed, .. } = *touching;
        let Reference { is_b, face, .. } = *reference;
        let Basis3 { x, y, z } = if is_b { posed.poses[1].basis() } else { placed.basis };
        let axes = [x, y, z];
        let [i, u, v] = axes_of(face);
        let out = axes[i] * sign_of(face);
        let between = posed.between();
        let back = if is_b { between } else { -between };
        let middle = out * placed.half[usize::from(is_b)][i];
        let do_feet_stay = stays_on_a(is_b, placed.half.map(DVec3::length_squared)) != is_b;
        Self { middle, u: axes[u], v: axes[v], out, back, is_b, do_feet_stay }
    }

    /// Writes contact points and the normal. Each entry of `order` is a name, with a slot in its low bits.
    ///
    /// Coordinate by coordinate, always four points side by side, however many there are.
    #[inline(always)]
    fn write(&self, patch: &Patch, order: &[u32], manifold: &mut Manifold3) {
        let mut places = [Lanes::<4>::ZERO; 3];
        for (k, &names) in order.iter().enumerate() {
            let slot = (names & 15) as usize % SLOTS;
            places[0].0[k] = patch.u[slot];
            places[1].0[k] = patch.v[slot];
            places[2].0[k] = patch.height[slot];
        }
        let [u, v, height] = places;
        let (mut feet, mut others) = ([[0.0_f32; 4]; 3], [[0.0_f32; 4]; 3]);
        for c in 0..3 {
            let back = Lanes::all(self.back[c]);
            let foot = Lanes::all(self.middle[c]) + (u * self.u[c] + v * self.v[c]);
            let other = foot + height * self.out[c] + back;
            // One end is derived from the other, by the normal and the height as they are rounded for the report.
            let out = height.rounded() * f64::from(self.out[c] as f32);
            let (foot, other) = if self.do_feet_stay {
                (foot, foot.rounded() + back + out)
            } else {
                (other.rounded() - back - out, other)
            };
            for k in 0..4 {
                (feet[c][k], others[c][k]) = (foot.0[k] as f32, other.0[k] as f32);
            }
        }
        let [on_a, on_b] = if self.is_b { [&others, &feet] } else { [&feet, &others] };
        manifold.normal = if self.is_b { -self.out } else { self.out }.as_vec3();
        let mut last = u32::MAX;
        for (k, &names) in order.iter().enumerate().take(4) {
            // A slot listed twice, where three corners span the whole patch, is one point.
            if names == last {
                continue;
            }
            last = names;
            manifold.points.push(ContactPoint3 {
                separation: height.0[k] as f32,
                anchor_a: Vec3::new(on_a[0][k], on_a[1][k], on_a[2][k]),
                anchor_b: Vec3::new(on_b[0][k], on_b[1][k], on_b[2][k]),
                feature: Names(names >> 4).id(),
            });
        }
    }
}
