//! Penetrating contacts on ground: the same at any margin, and for a flat patch as a whole.
//!
//! ```text
//! a triangle that is near only because of the margin: gaps, no penetration                      (may_meet)
//! a triangle behind whose plane the part is deep: its penetrating points are found as without a margin:
//!     sides that are near only because of the margin do not count: the normal gives these, kernels the gaps   (closer)
//!     only contacts that touch cover or free it, where they would without a margin          (prominent_near, rejected)
//! at last, where the part is deep in a flat patch, and reaches further behind its plane than was found:
//!     deeper points over triangles of the patch that it does not meet, and over their sides on its rim (rim)
//!     where nothing is deep along other normals, also over the rim of triangles that it meets
//! ```
//! A body leaves a patch along its normal as a whole, or not at all. Where a box leans over the rim of a floor, its
//! lowest point may lie under a triangle that it does not touch, or another face may be deeper over the rim than the
//! incident face. Where it is deep along other normals, too, a triangle that it meets may have got its contact along
//! one of them, and adds no more along its own.
//!
//! Depths that were found are not added again: among points that are equally deep, the feature ids would change with
//! every step.
//!
//! Cost: all near ground is read twice for each normal along which something may be deeper. A cuboid of 32 m, sunk in
//! hills of 2,000 triangles, has 16 of these, and takes 24 ms; it took 40 while each triangle, whatever its normal, was
//! compared with all points of each (Intel Xeon, family 6 model 85, 2026-11-28).

use super::ball::nearest_to;
use super::facet::{front_of, is_same};
use super::groups::{Group, Groups, MOST_GROUPS, MOST_POINTS, Pin};
use super::prism::Prism;
use super::rejected::LeastAlong;
use super::standing::Standing;
use super::{Known, PartTest};
use crate::feature::Feature;
use crate::pair3::reach_of;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Aabb3, Ground, NearTriangle};
use core::ops::ControlFlow;

/// Most flat patches of one normal that are treated as a whole.
const MOST_PATCHES: usize = 32;

/// Points up to this separation are found without a margin, too: a gap that rounds to zero is a touch.
pub(super) fn touching() -> f64 {
    reach_of(0.0)
}

impl PartTest<'_> {
    /// The separation below which points over a triangle count as deep, in metres.
    #[inline]
    pub(super) fn deep_below(&self, prism: &Prism) -> f64 {
        -(self.standing.slack + prism.doubt)
    }

    /// Whether some of the part is deep behind a triangle's plane, however far from the triangle.
    #[inline]
    pub(super) fn is_behind(&self, prism: &Prism) -> bool {
        prism.extent.low - self.standing.radius < self.deep_below(prism)
    }

    /// Whether a triangle would be processed without a margin.
    #[inline]
    pub(super) fn may_meet(&self, prism: &Prism) -> bool {
        let ([a, b, c], [low, high]) = (prism.facet.corners, self.standing.turned);
        let radius = self.standing.radius;
        let beyond = (a.min(b).min(c) - high).max(low - a.max(b).max(c)).max_element();
        beyond <= radius && -prism.extent.high <= touching() + radius + prism.doubt
    }

    /// Whether the part and a triangle share a point, exactly.
    pub(super) fn meets(&self, prism: &Prism) -> bool {
        prism.does_cross() || self.meeting.overlaps(prism.ground, prism.facet.number)
    }

    /// Whether a triangle has a point in the ball around the part. If it has none, and the part's centre is above its
    /// plane, nothing of the part that is behind the plane lies over the triangle; otherwise nothing of it is deep
    /// there.
    pub(super) fn is_in_ball(&self, prism: &Prism) -> bool {
        let Standing { center, outer_radius, .. } = *self.standing;
        let foot = center - prism.facet.normal * prism.facet.height(center);
        let radius = outer_radius + prism.doubt;
        (nearest_to(prism.facet, foot).1 - center).length_squared() <= radius * radius
    }

    /// Adds deeper points over the rest of a flat patch, where the part is deep in some of it.
    #[inline]
    pub(super) fn add_whole(&self, known: &mut Known) {
        if known.groups.iter().any(|group| self.may_be_deeper(group)) {
            self.add_rest_of_patches(known);
        }
    }

    /// Whether the part is deep along a normal, and reaches further behind a plane with that normal than was found.
    #[inline]
    fn may_be_deeper(&self, group: &Group) -> bool {
        let (slack, found) = (self.standing.slack, group.found());
        found < -slack && group.base.behind < found - slack
    }

    #[cold]
    #[inline(never)]
    fn add_rest_of_patches(&self, known: &mut Known) {
        let (slack, turned) = (self.standing.slack, self.standing.turned);
        let (mut whole, [mut low, mut high]) = (ArrayVec::<LeastAlong, MOST_GROUPS>::new(), turned);
        for group in known.groups.iter().filter(|group| self.may_be_deeper(group)) {
            whole.push((group.base.normal, group.found()));
            // Where it meets no triangle, all of the part may be behind the plane, under triangles outside its box.
            let up = group.base.normal * -group.base.behind;
            (low, high) = (low.min(turned[0] + up), high.max(turned[1] + up));
        }
        let is_alone = known.groups.iter().filter(|group| group.found() < -slack).count() == 1;
        let bounds = self.query.on.bounds_around(&self.standing.part, [low, high], touching());
        for &by in &whole {
            self.add_rest_along(&bounds, by, is_alone, known);
        }
    }

    /// The same along one normal, over triangles near a box.
    fn add_rest_along(&self, bounds: &Aabb3, by: LeastAlong, is_alone: bool, known: &mut Known) {
        let ground = self.query.on.ground;
        let mut deep = known.groups.deep_along(ground, by.0);
        // A corner's feature id says which triangles it belongs to, but not which patch: that is looked up first.
        let mut patches = ArrayVec::<u32, MOST_PATCHES>::new();
        if known.groups.has_corner_along(by.0) {
            let _ = ground.read_near(bounds, |near| {
                if !patches.contains(&near.patch) && deep.holds(ground, near.number) {
                    let _ = patches.try_push(near.patch);
                }
                ControlFlow::Continue(())
            });
        }
        let _ = ground.read_near(bounds, |near| {
            // Most ground around a sunken part has another normal.
            if is_along(near, by.0) && (patches.contains(&near.patch) || deep.holds(ground, near.number)) {
                self.add_of_whole(near, by, is_alone, known);
                deep = known.groups.deep_along(ground, by.0);
            }
            ControlFlow::Continue(())
        });
    }

    /// Adds deeper points over a triangle of a patch that the part is deep in, along the triangle's normal; for a
    /// triangle that the part meets, only where nothing is deep along other normals.
    fn add_of_whole(
        &self,
        near: &NearTriangle,
        (normal, found): LeastAlong,
        is_alone: bool,
        known: &mut Known,
    ) {
        if let Some(plane) = self.plane_towards(near.number, normal)
            && is_same(plane.facet.normal, normal)
        {
            let prism = Prism { reach: found - self.standing.slack, ..self.prism_over(&plane) };
            let do_meet = self.meets(&prism);
            // A triangle that the part meets has its points already, from one face of the part or along another normal.
            if !do_meet {
                self.add_by_normal(&prism, known);
            }
            if !do_meet || is_alone {
                prism.add_deepest_over_rim(&mut known.groups);
            }
        }
    }
}

/// The square of the cosine of an angle far wider than the tolerance of normals that are the same: 8 degrees.
const ROUGHLY: f64 = 0.98;

/// Whether a triangle's normal, of either side, may be this unit normal.
fn is_along(near: &NearTriangle, normal: DVec3) -> bool {
    let front = front_of(near.corners);
    let along = front.dot(normal);
    along * along >= ROUGHLY * front.length_squared()
}

/// Where a part is deep along a normal: computed once for all triangles that are tested.
pub(super) struct DeepIn {
    /// Flat patches, by faces and edges.
    patches: ArrayVec<u32, { 2 * MOST_POINTS }>,
    /// Corners, whose patches are not known.
    corners: ArrayVec<u32, MOST_POINTS>,
}

impl DeepIn {
    /// Whether it includes a triangle's flat patch, an edge of that, or a corner of the triangle itself: a corner does
    /// not say which other triangles meet there.
    pub(super) fn holds(&self, ground: Ground, number: u32) -> bool {
        self.patches.contains(&ground.patch(number))
            || !self.corners.is_empty()
                && ground.vertex_numbers(number).iter().any(|vertex| self.corners.contains(vertex))
    }
}

impl Groups {
    fn pins_along(&self, normal: DVec3) -> impl Iterator<Item = &Pin> {
        self.along(normal).into_iter().flat_map(|group| &group.pins)
    }

    /// Whether a point along a normal is on a corner of the ground.
    fn has_corner_along(&self, normal: DVec3) -> bool {
        self.pins_along(normal).any(|pin| matches!(pin.of_ground, Feature::Vertex(_)))
    }

    /// Where points along a normal are deeper than the slack.
    pub(super) fn deep_along(&self, ground: Ground, normal: DVec3) -> DeepIn {
        let (mut patches, mut corners) = (ArrayVec::new(), ArrayVec::new());
        for pin in self.pins_along(normal).filter(|pin| pin.separation < -self.slack()) {
            // There is room for all points of a group, and for two patches beside each edge.
            match pin.of_ground {
                Feature::Face(of) => patches.push(of),
                Feature::Edge(edge) => {
                    let (one, edge) = (edge / 3, edge as usize % 3);
                    patches.push(ground.patch(one));
                    patches.extend(ground.neighbor(one, edge).map(|(other, _)| ground.patch(other)));
                }
                Feature::Vertex(vertex) => corners.push(vertex),
            }
        }
        DeepIn { patches, corners }
    }
}
