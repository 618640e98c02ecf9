//! Contacts of compounds in space, with hints of the last frame.

use super::part::for_parts_in;
use super::{Pair3, Part};
use crate::batch::Proximity;
use crate::feature::Hint;
use crate::kept::Kept;
use crate::polyhedron::convex::Query;
use crate::room::Room;
use crate::shadow::is_many;
use crate::whole3::{Wholes3, part_count};

impl Pair3<'_> {
    /// A contact of compounds. First tries a direction that separates them as wholes, if there may be one or it saves
    /// much; then pairs of parts, two of which have hints of their own from the last frame.
    pub(super) fn contact_of_parts(
        &self,
        query: Query,
        margin: f32,
        manifolds: &mut impl Room,
    ) -> (Hint, Proximity) {
        let bases = self.bases();
        let wholes = Wholes3 {
            shapes: [self.shape_a, self.shape_b],
            bases: [&bases[0], &bases[1]],
            between: self.between,
        };
        let sought = query.hint.sought();
        let sought =
            sought.and_then(|(direction, is_due)| Some((bases[0].turn(direction).try_normalize()?, is_due)));
        // If none is due, the direction from centre to centre separates more pairs of parts than one that has failed.
        let due = sought.filter(|&(_, is_due)| is_due);
        let (from, is_due) = due.unwrap_or_else(|| (wholes.towards_b(), false));
        let [a, b] = [self.shape_a, self.shape_b].map(part_count);
        // Against few parts, searching the tree of many is faster than projecting all of them.
        let is_worth_it = match self.has_many_parts() {
            true => is_due && a.max(b) <= 8 * a.min(b),
            false => is_due || is_many([a, b]),
        };
        let shadow = if is_worth_it { wholes.shadow(from, query.limit) } else { None };
        if shadow.as_ref().is_some_and(|(shadow, _)| shadow.parts_wholes()) {
            return (Hint::towards(bases[0].turn_back(from)), Proximity::Beyond(0.0));
        }
        let whole_b = Part::whole(self.shape_b, &bases[1]);
        let is_far = |a: &Part, b: &Part| self.gap(a, b) > query.limit;
        let (mut kept, mut touch) = (Kept::new(query.hint), None);
        let beside_b = || self.around_b(&whole_b, query.limit);
        for_parts_in(self.shape_a, &bases[0], beside_b, |a| {
            let shadow = shadow.as_ref().map(|(shadow, _)| shadow);
            if shadow.is_some_and(|shadow| shadow.parts_from_whole(a.index)) || is_far(&a, &whole_b) {
                return false;
            }
            let beside_a = || self.around_a(&a, query.limit);
            for_parts_in(self.shape_b, &bases[1], beside_a, |b| {
                if shadow.is_some_and(|shadow| shadow.parts(a.index, b.index)) || is_far(&a, &b) {
                    return false;
                }
                let parts = self.parts(&bases, a, b);
                let query = Query { hint: kept.of(parts.indices), ..query };
                if let (hint, Ok(found)) = parts.contact(query, margin, manifolds) {
                    touch = Some(touch.unwrap_or(false) || found.overlapping);
                    kept.offer(parts.indices, hint, found.separation);
                }
                false
            })
        });
        let next = shadow.map_or(from, |(_, next)| next);
        let hint = if touch.is_some() { kept.hint() } else { query.hint.seeking(bases[0].turn_back(next)) };
        (hint, Proximity::of(touch))
    }
}
