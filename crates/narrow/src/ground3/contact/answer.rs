//! Output of what was found for a part: manifolds in world axes.

use super::groups::Group;
use super::{GroundQuery, Known};
use crate::answer::ContactPoint3;
use crate::feature::FeatureId;
use crate::pair3::Part;
use crate::precision::{IN_SPACE, Precision, signed};
use crate::room::Room;

impl GroundQuery<'_> {
    /// Outputs what was found; returns whether the part overlaps, if it is within the margin.
    #[inline]
    pub(super) fn answer(
        &self,
        part: Part,
        known: &mut Known,
        is_overlap_known: bool,
        manifolds: &mut impl Room,
    ) -> Option<bool> {
        let (overlapping, least) = (known.overlapping, known.groups.least());
        let how = (overlapping, is_overlap_known, least);
        // The reported separation decides, as between solids: points that the slack let in and that do not touch may be
        // reported beyond the margin.
        if !overlapping && (least == f64::INFINITY || reported(least, how) > self.margin) {
            return None;
        }
        if manifolds.is_wanted() {
            let order = known.groups.finish();
            for group in order.into_iter().filter_map(|place| known.groups.at(place)) {
                let hidden = known.hidden((group, least), part.shape.outer_radius().into());
                self.add_manifold(part.index, (group, hidden), how, manifolds);
            }
        }
        Some(overlapping)
    }

    fn add_manifold(
        &self,
        part: u32,
        (group, hidden): (&Group, f64),
        how: (bool, bool, f64),
        to: &mut impl Room,
    ) {
        let on = self.on;
        let [deepest, doubt] = group.recorded;
        let separation = reported(deepest, how);
        if separation > self.margin {
            return;
        }
        let Some(manifold) = to.room(separation) else { return };
        [manifold.part_a, manifold.part_b] = on.in_order([part, group.base.patch]);
        let towards = on.basis.turn(group.base.normal);
        manifold.normal = if on.is_b { -towards } else { towards }.as_vec3();
        let precision = Precision { size: 0.0, reach: 0.0, planarity: 0.0, roundings: IN_SPACE.of_parts };
        let off = (f64::from(separation) - deepest).abs();
        let error = precision.of_distance(deepest, doubt + hidden + off);
        (manifold.separation, manifold.error) = (separation, error);
        manifold.points.extend(group.pins.iter().map(|pin| {
            let of_body = (on.basis.turn(pin.on_body) - on.to_body).as_vec3();
            let of_ground = on.basis.turn(pin.on_ground).as_vec3();
            let [anchor_a, anchor_b] = on.in_order([of_body, of_ground]);
            let [feature_a, feature_b] = on.in_order([pin.of_body, pin.of_ground]);
            let feature = FeatureId::new(feature_a, feature_b);
            let separation = pin.separation as f32;
            ContactPoint3 { separation, anchor_a, anchor_b, feature }
        }));
        manifold.points.sort_unstable_by_key(|point| point.feature);
    }
}

/// A group's separation as it is reported: the deepest of all has the sign of the overlap decision.
fn reported(deepest: f64, (overlapping, is_overlap_known, least): (bool, bool, f64)) -> f32 {
    match overlapping {
        true if deepest <= least => signed(deepest, true),
        false if !is_overlap_known => signed(deepest, false),
        _ => deepest as f32,
    }
}
