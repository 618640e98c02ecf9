//! Closest points, and the separation of shapes that are apart, by the fast path.

use super::part::Part;
use super::{Pair2, Parts, Place};
use crate::answer::{Closest2, Measured2, Separation2};
use crate::feature::Hint;
use crate::least::Least;
use crate::polygon::apart::Apart;
use crate::polygon::measure::{Near, Probe, Query};

impl Pair2<'_> {
    /// The closest points of shapes that do not overlap; `None` where they do. Cost: as [`overlaps`](Self::overlaps),
    /// and for shapes apart some support searches, each linear in the vertices up to 16, above logarithmic.
    pub fn distance(&self) -> Option<Closest2> {
        // An overlap test is cheap; the search below would find the overlap, or the depth of each part, for nothing.
        if (!self.has_ground() || self.has_many_parts()) && self.overlaps() {
            return None;
        }
        if self.has_ground() {
            let (place, near) = self.nearest_on_ground(f64::INFINITY).ok()?;
            return closest_of(&place, near);
        }
        if !self.is_compound() {
            let [a, b] = [Part::whole(self.shape_a, &self.turn_a), Part::whole(self.shape_b, &self.turn_b)];
            return self.parts(a, b).closest(f64::INFINITY).ok()?;
        }
        let mut least = Least::within(f64::INFINITY);
        self.visit_nearest(&mut least, |least, [a, b]| {
            !least.passes_over(self.gap(&a, &b)) && {
                let found = self.parts(a, b).closest(least.reach());
                least.offer_closest(found, |found| [found.distance, found.error])
            }
        });
        let (found, error) = least.finish().ok()?;
        Some(Closest2 { error, ..found? })
    }

    /// The separation within a limit of two convex shapes whose bounding circles are apart, without testing axes or
    /// edges.
    pub(super) fn separation_apart(&self, limit: f64) -> Option<Separation2> {
        if self.has_ground() || self.is_compound() {
            return None;
        }
        let [a, b] = [Part::whole(self.shape_a, &self.turn_a), Part::whole(self.shape_b, &self.turn_b)];
        let gap = self.gap(&a, &b);
        let is_asked = gap > 0.0 && gap <= limit;
        let found = if is_asked { self.parts(a, b).convex.apart(limit) } else { None };
        Some(match found? {
            Ok(Apart { separation, error, normal, .. }) => {
                Separation2::Measured(Measured2 { separation, error, normal: normal.as_vec2() })
            }
            Err(at_least) => Separation2::AtLeast(at_least),
        })
    }
}

/// The closest points as they are reported; `None` where there are none.
fn closest_of(place: &Place, near: Near) -> Option<Closest2> {
    let Near { separation, error, normal, closest, .. } = near;
    Some(place.closest(&Apart { separation, error, normal, points: closest? }))
}

impl Place {
    fn closest(&self, apart: &Apart) -> Closest2 {
        let Apart { separation: distance, error, normal, points: [on_a, on_b] } = *apart;
        let ([part_a, part_b], normal) = (self.indices, normal.as_vec2());
        let (anchor_a, anchor_b) = (self.anchor_a(on_a), self.anchor_b(on_b));
        Closest2 { distance, error, normal, anchor_a, anchor_b, part_a, part_b }
    }
}

impl Parts<'_> {
    /// The closest points within a limit: `None` if the parts overlap; `Err` with a lower bound on the distance if they
    /// are beyond the limit.
    fn closest(&self, limit: f64) -> Result<Option<Closest2>, f32> {
        match self.convex.apart(limit) {
            Some(found) => found.map(|apart| Some(self.place.closest(&apart))),
            None => self.look_closer(limit),
        }
    }

    /// The same for parts that nearly touch, or overlap. Not inlined: with another copy of `probe`, contacts took 1.08
    /// times as long.
    #[cold]
    #[inline(never)]
    fn look_closer(&self, limit: f64) -> Result<Option<Closest2>, f32> {
        match self.convex.probe(&Query { limit, hint: Hint::NONE, points: false }) {
            Probe::Beyond(at_least, _) => Err(at_least),
            Probe::Near(near) => Ok(closest_of(&self.place, near)),
        }
    }
}
