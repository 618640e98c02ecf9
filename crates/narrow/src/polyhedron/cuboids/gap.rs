//! Two cuboids apart, with the gap between a face and the other cuboid, or between two edges that cross.
//!
//! ```text
//! s   the separation along the best face's normal: a lower bound on the distance
//! h   the height of the lowest corner of the patch of this face and its incident face: there, a point of one cuboid is
//!     straight over a point of the other, so that h is an upper bound
//! h = s up to rounding: that is the distance, and neither edges nor an iteration are needed
//! else the same for the best edges: s along the axis that is normal to both, h between their nearest points
//! ```
//! The contact points are corners of a patch as in overlap, mostly of the very same patch; or the point where edges
//! cross. Any other nearest features, such as a corner and an edge or two corners, are left to the general path, and so
//! are edges that may lie side by side.
//!
//! In a pile of boxes where a third of the pairs is apart by less than the margin, nine tenths of those are answered
//! here, in 0.35 us where the general path took 2.5 (AMD EPYC, Zen 4, 2026-11-21). In a heap of boxes that falls, five
//! of six pairs that took the general path are answered by edges, in 0.4 k instructions where that took 3.5 k: 0.79 of
//! a frame's time (2026-11-23).

use super::super::sat::{AxisOf, hint_to, hint_with};
use super::contact::{Touching, looks};
use super::patch::{Patch, Reference};
use super::placed::Placed;
use super::queries::Contact;
use super::settled::{Best, Edges, SLACK};
use crate::answer::Manifold3;
use crate::feature::Hint;
use crate::precision::signed;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::ALIGNED_FACES;

/// The least cosine between two faces whose patch bounds a distance: heights at the corners of the reference face are
/// divided by it. Only plates as thin as a preference come below the root of a third.
const LEVEL: f64 = 0.5;

impl Touching<'_> {
    /// Whether the shapes are within the margin. Fills in the manifold, if one is wanted.
    ///
    /// Not inlined: inlined into the queries of overlapping pairs, it made those 6 % slower.
    #[inline(never)]
    pub(super) fn across(&self, hint: Hint, manifold: Option<&mut Manifold3>) -> Contact {
        let of = self.measured_from();
        let mut manifold = manifold;
        let contact = match of {
            _ if self.is_beyond_faces() => None,
            AxisOf::FaceA(face) => {
                self.over_face(face, false, |patch| self.across_patch(of, patch, manifold.as_deref_mut()))
            }
            AxisOf::FaceB(face) => {
                self.over_face(face, true, |patch| self.across_patch(of, patch, manifold.as_deref_mut()))
            }
            AxisOf::Edges(..) => None,
        };
        contact.unwrap_or_else(|| self.across_edges(manifold).unwrap_or(Contact::Unclear(hint)))
    }

    /// Whether two edges separate the cuboids by more than the best face for certain. Then no corner of a patch can be
    /// as low as the face's separation, and no patch need be made.
    ///
    /// Heights at a patch's corners are at least the distance less two projections' rounding, and the distance is at
    /// least the edges' separation less one more. In a heap of boxes that falls, a fifth of all pairs across a gap made
    /// a patch in vain, and none does now: a hundredth of a frame (AMD EPYC, Zen 5, 2026-11-24).
    #[inline(always)]
    fn is_beyond_faces(&self) -> bool {
        let Self { placed, best, .. } = *self;
        let least = best.of_faces();
        let doubt = 8.0 * placed.precision.projection() + 2.0 * least * SLACK;
        best.edges.is_none() && placed.fifteen.do_edges_part(least + doubt, placed.closed_form())
    }

    /// [`Touching::across`] for the best two edges; `None` where they are not what is nearest, or not the only ones.
    #[inline(never)]
    fn across_edges(&self, manifold: Option<&mut Manifold3>) -> Option<Contact> {
        let Self { placed, best, .. } = *self;
        let pair = placed.fifteen.best_edges()?;
        let normal = placed.edge_normal(pair);
        let least = placed.along(normal);
        // A face that is nearly as good takes precedence: left to the general path.
        if least <= best.of_faces() + 2.0 * placed.preference {
            return None;
        }
        let edges = placed.of_edges_along(pair, normal);
        let AxisOf::Edges(edge_a, edge_b) = edges else { return None };
        if least > self.margin + placed.precision.projection() {
            return Some(Contact::Apart(hint_to(edges), 0.0));
        }
        let nearest = placed.nearest_of(edge_a, edge_b);
        let above = (nearest[1] - nearest[0]).length() - least;
        let (rounding, separation) = (placed.precision.projection(), signed(least, false));
        let is_met = above <= rounding.max(least * SLACK);
        if !is_met {
            return None;
        }
        if f64::from(separation) >= self.margin {
            return Some(Contact::Apart(hint_to(edges), 0.0));
        }
        if let Some(manifold) = manifold {
            let towards = [normal, placed.relative.turn_back(normal)];
            if looks(towards[0]) && looks(towards[1]) {
                let best = Best { edges: Some(Edges { separation: least, pair }), ..*best };
                Touching { best: &best, ..*self }.over_leaning(normal, manifold)?;
            } else if self.may_lie_beside(towards) {
                return None;
            } else {
                manifold.normal = placed.basis.turn(normal).as_vec3();
                manifold.points.push(self.contact_at(nearest, normal, (edge_a, edge_b)));
            }
            manifold.separation = separation;
            manifold.error = placed.precision.of_distance(least, above.max(0.0) + rounding);
        }
        Some(Contact::Near(hint_to(edges)))
    }

    /// Whether edges may lie side by side across a gap, as seen along a normal, which is given in the axes of both.
    #[inline(always)]
    fn may_lie_beside(&self, towards: [DVec3; 2]) -> bool {
        // The squared sine of the angle at which faces still count as facing each other.
        const LEAN: f64 = 1.0 - ALIGNED_FACES * ALIGNED_FACES;
        let runs_across = |lean: f64| lean * lean <= LEAN;
        let are_alike = |i: usize, j: usize| self.placed.axis_b(j)[i].abs() >= ALIGNED_FACES;
        let [from_a, from_b] = towards;
        // Few axes run across the normal, and mostly none.
        let lies_beside = |i: usize| (0..3).any(|j| runs_across(from_b[j]) && are_alike(i, j));
        (0..3).any(|i| runs_across(from_a[i]) && lies_beside(i))
    }

    /// [`Touching::across`] for the patch of a face; `None` where the two bounds may differ by more than rounding.
    ///
    /// A corner of the patch is off its place by less than 88 u reach, two projections. One is for the placement of the
    /// incident cuboid; the rest covers 8 u for the crossing of an edge and a side, along the side and across, and 12 u
    /// for the height at a corner of the reference face, over a face that is tilted by 60 degrees at most.
    #[inline(always)]
    fn across_patch(&self, of: AxisOf, patch: &Patch, manifold: Option<&mut Manifold3>) -> Option<Contact> {
        let Self { placed, best, .. } = *self;
        let (least, nearest) = (best.separation(), best.axis_of(placed));
        let lowest = if nearest == of { placed.lowest(patch) } else { self.lowest_over(nearest)? };
        let rounding = placed.precision.projection();
        let (above, most) = (lowest - least, least * SLACK);
        let is_met = above <= if most > rounding { most } else { rounding };
        if !is_met {
            return None;
        }
        let separation = signed(least, false);
        // The margin is the caller's plus one ulp: what rounds to the caller's counts.
        if f64::from(separation) >= self.margin {
            return Some(Contact::Apart(hint_to(of), 0.0));
        }
        if let Some(manifold) = manifold {
            if self.fill_over(patch, manifold).is_none() {
                return Some(Contact::Unclear(hint_with(hint_to(nearest), of)));
            }
            manifold.separation = separation;
            manifold.error = placed.precision.of_distance(least, above.max(0.0) + rounding);
        }
        Some(Contact::Near(hint_to(of)))
    }

    /// The height of the lowest corner over the best face, where the points are built on another face.
    #[inline(never)]
    fn lowest_over(&self, nearest: AxisOf) -> Option<f64> {
        let lowest = |patch: &Patch| Some(self.placed.lowest(patch));
        match nearest {
            AxisOf::FaceA(face) => self.over_face(face, false, lowest),
            AxisOf::FaceB(face) => self.over_face(face, true, lowest),
            AxisOf::Edges(..) => None,
        }
    }
}

impl Placed {
    /// The height of a patch's lowest corner; infinite where the faces are too steep to tell.
    #[inline(always)]
    fn lowest(&self, patch: &Patch) -> f64 {
        let Reference { is_b, face, incident } = patch.reference;
        let (i, j) = if is_b { (incident / 2, face / 2) } else { (face / 2, incident / 2) };
        if self.axis_b(j % 3)[i % 3].abs() < LEVEL {
            return f64::INFINITY;
        }
        let (mut lowest, mut rest) = (f64::INFINITY, patch.held);
        while rest != 0 {
            let height = patch.height[patch.slot(rest.trailing_zeros())];
            lowest = if height < lowest { height } else { lowest };
            rest &= rest - 1;
        }
        lowest
    }
}
