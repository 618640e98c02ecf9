//! Contact points grouped by normal: one group becomes one manifold.
//!
//! ```text
//! a normal within the tolerance of a group's joins that group, whose normal is the one of its largest triangle
//! a point that is there already, by feature ids or by position, is kept once: the deeper
//! a group that is full:           only the corners of the area that its points cover stay
//! too many normals:               the deepest groups stay, but those of ground ahead make room for all others
//! normals that came to be equal:  their groups are joined
//! at last:                        the corners around the patch, at most four, and always one as deep as any
//! ```
//! The normal of the largest triangle, not of the deepest or the first: among triangles that were meant to be coplanar
//! it has the least rounding error, and it changes least often while a body slides.

use super::facet::is_same;
use crate::feature::{Feature, FeatureId};
use crate::polyhedron::reduce::{Spot, pick_four};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// Most normals of a part at a time. Where a body touches ground with more, the deepest stay.
pub(super) const MOST_GROUPS: usize = 16;

/// Most points of a group before only its corners are kept.
pub(super) const MOST_POINTS: usize = 24;

/// A contact point in the ground's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pin {
    pub(super) on_body: DVec3,
    pub(super) on_ground: DVec3,
    pub(super) separation: f64,
    /// Error bound of the separation, in metres.
    pub(super) doubt: f64,
    pub(super) of_body: Feature,
    pub(super) of_ground: Feature,
}

/// A normal, and the ground that gave it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Base {
    /// Unit normal from the ground to the body.
    pub(super) normal: DVec3,
    /// The lowest triangle number of the patch.
    pub(super) patch: u32,
    /// Of several normals the one with the greatest weight is taken: the triangle's area, or zero where it is not a
    /// triangle's normal.
    pub(super) weight: f64,
    /// The height of the part's lowest point over the triangle's plane, the lowest of several: negative behind it, in
    /// metres; infinite where it is not a triangle's normal.
    pub(super) behind: f64,
}

/// Nothing recorded yet.
const NOTHING_RECORDED: [f64; 2] = [f64::INFINITY, 0.0];

/// A normal and its points.
pub(super) struct Group {
    pub(super) base: Base,
    pub(super) pins: ArrayVec<Pin, MOST_POINTS>,
    /// The least separation recorded for it so far, including points that were dropped since, and its error bound.
    pub(super) recorded: [f64; 2],
    /// By how much the true separation may be less because of low bends, as far as noted, in metres.
    pub(super) hidden: f64,
}

/// All normals of a part.
pub(super) struct Groups {
    groups: ArrayVec<Group, MOST_GROUPS>,
    /// Positions that differ by no more count as the same, in metres.
    slack: f64,
    /// Points no further than this above the deepest count as deep as it where four of more are chosen, in metres.
    even: f64,
    /// Deeper points are left out, in metres.
    floor: f64,
    /// How many groups, the first ones, keep their place, normal and patch whatever is added.
    fixed: usize,
}

impl Pin {
    fn id(&self) -> FeatureId {
        FeatureId::new(self.of_body, self.of_ground)
    }

    /// Whether it is the same contact: by feature ids, or by position.
    fn is_same_as(&self, other: &Self, slack: f64) -> bool {
        self.is_named_as(other) || (self.on_body - other.on_body).length_squared() <= slack * slack
    }

    /// Whether it has the same feature ids, or the same vertex of the body, which touches ground along one normal only
    /// once.
    fn is_named_as(&self, other: &Self) -> bool {
        let is_vertex = matches!(self.of_body, Feature::Vertex(_));
        self.of_body == other.of_body && (is_vertex || self.of_ground == other.of_ground)
    }

    /// The order among points that are equally deep: on a face first, then by feature ids.
    fn rank(&self) -> (bool, FeatureId) {
        (!matches!(self.of_ground, Feature::Face(_)), self.id())
    }
}

impl Groups {
    #[inline(always)]
    pub(super) fn new(slack: f64, even: f64) -> Self {
        Self { groups: ArrayVec::new(), slack, even, floor: f64::NEG_INFINITY, fixed: 0 }
    }

    /// Leaves out points that are deeper than this from now on, in metres.
    #[inline]
    pub(super) fn leave_out(&mut self, below: f64) {
        self.floor = below;
    }

    /// Fixes all groups that there are: what is added from now on may join them, but neither replaces one nor changes
    /// its normal.
    pub(super) fn fix(&mut self) {
        self.fixed = self.groups.len();
    }

    /// The separation below which points are left out, in metres.
    pub(super) fn floor(&self) -> f64 {
        self.floor
    }

    pub(super) fn iter(&self) -> core::slice::Iter<'_, Group> {
        self.groups.iter()
    }

    /// The least separation found; infinite without any.
    pub(super) fn least(&self) -> f64 {
        self.groups.iter().map(Group::found).fold(f64::INFINITY, f64::min)
    }

    /// The normal along which that was found, and the deepest point on the body.
    pub(super) fn nearest(&self) -> Option<(DVec3, DVec3)> {
        let nearest = self.groups.iter().min_by(|one, other| one.found().total_cmp(&other.found()))?;
        let deepest = nearest.deepest()?;
        Some((nearest.base.normal, nearest.pins[deepest].on_body))
    }

    /// Notes that ground with this normal may be as near as `bound`. Groups with the same normal then hide what `most`
    /// makes of the group's normal and of how much lower the bound is.
    pub(super) fn hide(&mut self, normal: DVec3, bound: f64, most: impl Fn(DVec3, f64) -> f64) {
        for group in self.groups.iter_mut().filter(|group| is_same(group.base.normal, normal)) {
            group.hidden = group.hidden.max(most(group.base.normal, group.found() - bound));
        }
    }

    /// The least separation found along a normal; infinite without any.
    pub(super) fn least_along(&self, normal: DVec3) -> f64 {
        self.along(normal).map_or(f64::INFINITY, Group::found)
    }

    /// The group of a normal.
    pub(super) fn along(&self, normal: DVec3) -> Option<&Group> {
        self.groups.iter().find(|group| is_same(group.base.normal, normal))
    }

    pub(super) fn slack(&self) -> f64 {
        self.slack
    }

    /// Adds a point. Cost: linear in the groups, and in the points of its own.
    pub(super) fn add(&mut self, base: &Base, pin: Pin) {
        if pin.separation < self.floor {
            return;
        }
        let slack = self.slack;
        let same =
            self.groups.iter_mut().enumerate().find(|(_, group)| is_same(group.base.normal, base.normal));
        if let Some((place, group)) = same {
            if place >= self.fixed {
                group.base.join(base);
            }
            group.add(pin, [slack, self.even]);
            return;
        }
        if self.groups.is_full() {
            let shallowest = self
                .groups
                .iter_mut()
                .skip(self.fixed)
                .reduce(|most, next| if next.found() > most.found() { next } else { most });
            if let Some(shallowest) = shallowest.filter(|group| group.found() > pin.separation) {
                (shallowest.base, shallowest.recorded, shallowest.hidden) = (*base, NOTHING_RECORDED, 0.0);
                shallowest.pins.clear();
                shallowest.pins.push(pin);
            }
            return;
        }
        // Made empty and filled in place: it is large.
        self.groups.push(Group {
            base: *base,
            pins: ArrayVec::new_const(),
            recorded: NOTHING_RECORDED,
            hidden: 0.0,
        });
        if let Some(group) = self.groups.last_mut() {
            group.pins.push(pin);
        }
    }

    /// Records a separation along a normal, and its error bound, where the points stand for more than are kept.
    pub(super) fn record(&mut self, normal: DVec3, measured: [f64; 2]) {
        let group = self.groups.iter_mut().find(|group| is_same(group.base.normal, normal));
        if let Some(group) = group.filter(|_| measured[0] >= self.floor) {
            group.record(measured);
        }
    }

    /// Sets the same for the group with the least separation.
    pub(super) fn record_nearest(&mut self, measured: [f64; 2]) {
        let nearest = self.groups.iter_mut().min_by(|one, other| one.found().total_cmp(&other.found()));
        if let Some(group) = nearest {
            group.recorded = measured;
        }
    }

    /// The first result that `find` gives for any group's base and points.
    pub(super) fn find_on<T>(&self, mut find: impl FnMut(&Base, &Pin) -> Option<T>) -> Option<T> {
        self.groups.iter().find_map(|group| group.pins.iter().find_map(|pin| find(&group.base, pin)))
    }

    /// Removes points that are deeper than rounding allows for shapes that share no point, and groups that are left
    /// without points.
    pub(super) fn keep_within(&mut self, least: f64) {
        for group in &mut self.groups {
            group.pins.retain(|pin| pin.separation >= least - pin.doubt);
            if group.recorded[0] < least - group.recorded[1] {
                group.recorded = NOTHING_RECORDED;
            }
        }
        self.groups.retain(|group| !group.pins.is_empty());
    }

    /// Reduces each group to what a manifold holds, and returns the groups' indices in the order of their patches: the
    /// groups are large, and stay in place.
    pub(super) fn finish(&mut self) -> ArrayVec<u8, MOST_GROUPS> {
        let sizes = [self.slack, self.even];
        self.join(sizes);
        for group in &mut self.groups {
            group.reduce(sizes);
        }
        let mut order: ArrayVec<u8, MOST_GROUPS> = (0..self.groups.len() as u8).collect();
        order.sort_unstable_by_key(|&place| (self.groups[usize::from(place)].base.patch, place));
        order
    }

    /// Joins groups whose normals have become the same: a larger triangle replaces a group's normal, and may bring it
    /// near another's.
    fn join(&mut self, sizes: [f64; 2]) {
        let mut place = 0;
        while place < self.groups.len() {
            let Base { normal, .. } = self.groups[place].base;
            let later = &self.groups[place + 1..];
            let Some(same) = later.iter().position(|group| is_same(group.base.normal, normal)) else {
                place += 1;
                continue;
            };
            let other = place + 1 + same;
            let Group { base, pins, recorded, hidden } = self.groups.remove(other);
            let group = &mut self.groups[place];
            if place >= self.fixed || other < self.fixed {
                group.base.join(&base);
            }
            self.fixed -= usize::from(other < self.fixed);
            group.record(recorded);
            group.hidden = group.hidden.max(hidden);
            pins.into_iter().for_each(|pin| group.add(pin, sizes));
            // Its normal may have moved near one of an earlier group.
            place = 0;
        }
    }

    /// A group by its index.
    pub(super) fn at(&self, place: u8) -> Option<&Group> {
        self.groups.get(usize::from(place))
    }
}

impl Base {
    /// For a normal that is not a triangle's.
    pub(super) fn along(normal: DVec3, patch: u32) -> Self {
        Self { normal, patch, weight: 0.0, behind: f64::INFINITY }
    }

    /// Merges another base with the same normal.
    fn join(&mut self, other: &Self) {
        if other.weight > self.weight {
            (self.normal, self.weight) = (other.normal, other.weight);
        }
        self.patch = self.patch.min(other.patch);
        self.behind = if other.behind < self.behind { other.behind } else { self.behind };
    }
}

impl Group {
    /// Records a separation and its error bound, if it is less than that recorded so far.
    fn record(&mut self, measured: [f64; 2]) {
        if measured[0] < self.recorded[0] {
            self.recorded = measured;
        }
    }

    /// The least separation of its points, or the one recorded for them if that is less.
    pub(super) fn found(&self) -> f64 {
        self.least().min(self.recorded[0])
    }

    /// The least separation of its points.
    pub(super) fn least(&self) -> f64 {
        self.pins.iter().map(|pin| pin.separation).fold(f64::INFINITY, f64::min)
    }

    fn add(&mut self, pin: Pin, [slack, even]: [f64; 2]) {
        if let Some(place) = self.pins.iter().position(|known| known.is_same_as(&pin, slack)) {
            let known = self.pins[place];
            // One of them is dropped; the lesser separation is kept.
            let nearer = if pin.separation < known.separation { pin } else { known };
            self.record([nearer.separation, nearer.doubt]);
            let is_deeper = pin.separation < known.separation - slack;
            let is_as_deep = pin.separation <= known.separation + slack;
            if is_deeper || (is_as_deep && pin.rank() < known.rank()) {
                let is_renamed = !known.is_named_as(&pin);
                self.pins[place] = pin;
                if is_renamed {
                    self.keep_one_named_as(place);
                }
            }
            return;
        }
        if self.pins.is_full() {
            let places = self.places();
            let mut around = self.around(&places, slack);
            if around.len() > MOST_POINTS / 2 {
                around = self.four_of(&around, &places, even);
            }
            // There is room for the deepest too, which is reported whatever is kept at last.
            if let Some(deepest) = self.deepest().filter(|deepest| !around.contains(deepest)) {
                let _ = around.try_push(deepest);
            }
            self.keep(around);
        }
        let _ = self.pins.try_push(pin);
    }

    /// Of a point that replaced another, and a point with the same feature ids, keeps the deeper.
    fn keep_one_named_as(&mut self, place: usize) {
        let pin = self.pins[place];
        let is_other = |&other: &usize| other != place && self.pins[other].is_named_as(&pin);
        if let Some(other) = (0..self.pins.len()).find(is_other) {
            let is_deeper = self.pins[other].separation < pin.separation;
            self.pins.remove(if is_deeper { place } else { other });
        }
    }

    /// Keeps at most four of the points around the patch, one of them as deep as any.
    fn reduce(&mut self, [slack, even]: [f64; 2]) {
        for place in 0..self.pins.len() {
            let Pin { separation, doubt, .. } = self.pins[place];
            self.record([separation, doubt]);
        }
        if self.pins.len() < 3 {
            return;
        }
        let places = self.places();
        let mut around = self.around(&places, slack);
        if around.len() > 4 {
            around = self.four_of(&around, &places, even);
        }
        let least = self.least() + even;
        if !around.iter().any(|&i| self.pins[i].separation <= least)
            && let Some(deepest) = self.deepest()
        {
            let at = self.pins[deepest].on_body;
            let distance = |i: usize| (self.pins[i].on_body - at).length_squared();
            let nearest = (0..around.len())
                .reduce(|a, b| if distance(around[b]) < distance(around[a]) { b } else { a });
            match nearest {
                Some(nearest) if around.len() > 3 => around[nearest] = deepest,
                _ => around.push(deepest),
            }
        }
        self.keep(around);
    }

    /// The index of the deepest point.
    fn deepest(&self) -> Option<usize> {
        let least = self.least();
        self.pins.iter().position(|pin| pin.separation == least)
    }

    /// Keeps the points with these indices.
    fn keep(&mut self, mut kept: ArrayVec<usize, MOST_POINTS>) {
        kept.sort_unstable();
        // Moved one by one, in place: the list is large.
        for (to, &from) in kept.iter().enumerate() {
            self.pins[to] = self.pins[from];
        }
        self.pins.truncate(kept.len());
    }

    /// The points' positions in the plane of the normal, relative to the first.
    fn places(&self) -> ArrayVec<[f64; 2], MOST_POINTS> {
        let (x, y) = self.base.normal.any_orthonormal_pair();
        let from = self.pins.first().map_or(DVec3::ZERO, |pin| pin.on_ground);
        self.pins.iter().map(|pin| [x.dot(pin.on_ground - from), y.dot(pin.on_ground - from)]).collect()
    }

    /// The convex hull of the points in that plane, clockwise; points on the line between two others are left out.
    ///
    /// Andrew, "Another efficient algorithm for convex hulls in two dimensions" (1979).
    fn around(&self, places: &[[f64; 2]], slack: f64) -> ArrayVec<usize, MOST_POINTS> {
        let mut order: ArrayVec<usize, MOST_POINTS> = (0..places.len()).collect();
        let along = |i: usize, j: usize| {
            let ([xi, yi], [xj, yj]) = (places[i], places[j]);
            xi.total_cmp(&xj).then(yi.total_cmp(&yj)).then(i.cmp(&j))
        };
        order.sort_unstable_by(|&i, &j| along(i, j));
        let mut around = ArrayVec::new();
        half(order.iter().copied(), places, slack, &mut around);
        let halfway = around.len();
        half(order.iter().rev().copied(), places, slack, &mut around);
        // By rounding, a point may be in both halves of the hull; it is one corner all the same.
        for place in (halfway..around.len()).rev() {
            if around[..halfway].contains(&around[place]) {
                around.remove(place);
            }
        }
        around
    }

    /// Four of the points around.
    fn four_of(&self, around: &[usize], places: &[[f64; 2]], even: f64) -> ArrayVec<usize, MOST_POINTS> {
        let spot = |i: usize| Spot { at: places[around[i]], separation: self.pins[around[i]].separation };
        let four = pick_four(around.len(), spot, |i| self.pins[around[i]].id(), even);
        four.into_iter().map(|i| around[i]).collect()
    }
}

/// One half of the hull; its last point is left for the other half.
fn half(
    order: impl Iterator<Item = usize>,
    places: &[[f64; 2]],
    slack: f64,
    around: &mut ArrayVec<usize, MOST_POINTS>,
) {
    let first = around.len();
    for next in order {
        while let [.., one, other] = around[first..] {
            let ([ax, ay], [bx, by], [cx, cy]) = (places[one], places[other], places[next]);
            let (dx, dy) = (cx - ax, cy - ay);
            let aside = dx * (by - ay) - dy * (bx - ax);
            // Off the line by more than the slack: it stays.
            if aside > slack * (dx.abs() + dy.abs()) {
                break;
            }
            around.pop();
        }
        // Full with all points there are, this one among them: it ends this half, and would be left for the other half.
        if around.try_push(next).is_err() {
            return;
        }
    }
    around.pop();
}
