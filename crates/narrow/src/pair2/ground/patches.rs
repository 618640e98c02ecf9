//! Manifolds on ground: all contact points of one normal make one manifold.

use super::super::Place;
use crate::answer::{ContactPoint2, Manifold2};
use crate::feature::{Feature, FeatureId};
use crate::points::ContactPoints;
use crate::polygon::manifold::Point;
use crate::polygon::measure::Near;
use crate::precision::signed;
use arrayvec::ArrayVec;
use asunder_geometry::Run;
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::ONE_NORMAL;

/// Contact points of one run, or of a corner of it.
pub(super) struct Patch(Manifold2);

impl Patch {
    /// Contact points that a kernel made on the segment from a run's first vertex to its last, renamed after the
    /// chain's features. `normal` leads from A to B; `side` is 0 where the chain is A. `None` without points.
    pub(super) fn new(
        (normal, points): (DVec2, &[Point]),
        (place, side): (&Place, usize),
        run: &Run,
        near: &Near,
    ) -> Option<Self> {
        if points.is_empty() {
            return None;
        }
        let of_ground = |feature: Feature| match feature {
            Feature::Vertex(0) => Feature::Vertex(run.vertices()[0]),
            Feature::Vertex(_) => Feature::Vertex(run.vertices()[1]),
            // A segment has two edges, back to back.
            Feature::Edge(_) | Feature::Face(_) => Feature::Edge(run.first()),
        };
        let renamed = |id: FeatureId| {
            if side == 0 {
                FeatureId::new(of_ground(id.a()), id.b())
            } else {
                FeatureId::new(id.a(), of_ground(id.b()))
            }
        };
        let [to_a, to_b] = place.shifts();
        let point = |point: &Point| ContactPoint2 {
            separation: point.separation as f32,
            anchor_a: (point.on_a + to_a).as_vec2(),
            anchor_b: (point.on_b + to_b).as_vec2(),
            feature: renamed(point.feature),
        };
        let [part_a, part_b] = place.indices;
        let mut points: ContactPoints<ContactPoint2, 2> = points.iter().map(point).collect();
        // Where a closed chain comes back to its first vertex, the kernel's order of ids is not the chain's.
        points.sort_unstable_by_key(|point| point.feature);
        let uneven = (run.unevenness() as f32).next_up();
        Some(Self(Manifold2 {
            part_a,
            part_b,
            normal: normal.as_vec2(),
            separation: near.separation,
            error: if run.unevenness() > 0.0 { (near.error + uneven).next_up() } else { near.error },
            points,
        }))
    }

    /// The same with the least separation of its points, since the kernel's is along another normal.
    pub(super) fn deep_by_its_points(mut self) -> Self {
        self.0.separation =
            self.0.points.iter().fold(f32::INFINITY, |least, point| least.min(point.separation));
        self
    }

    /// Whether any point is behind the surface.
    pub(super) fn is_behind(&self) -> bool {
        self.0.separation < 0.0
    }

    /// Whether any point is behind the surface by more than rounding.
    pub(super) fn is_deep(&self) -> bool {
        self.0.separation < -self.0.error
    }

    /// The same, with an error that covers how far away its points are: further than where the kernel's was made.
    pub(super) fn widened(mut self) -> Self {
        self.0.error = (self.0.error + f32::EPSILON * self.0.separation.abs()).next_up();
        self
    }

    /// Whether all points are in front of the surface, and none is nearer than `least`.
    pub(super) fn is_beyond(&self, least: f32) -> bool {
        self.0.separation > 0.0 && self.0.separation >= least
    }

    /// Whether its separation is greater than the kernel's, by more than the error.
    pub(super) fn is_above(&self, near: &Near) -> bool {
        self.0.separation > near.separation + self.0.error
    }

    /// The points within a margin, if there are any.
    pub(super) fn within(&self, margin: f32) -> Option<Self> {
        let mut manifold = self.0;
        manifold.points.retain(|point| point.separation <= margin);
        (!manifold.points.is_empty()).then_some(Self(manifold))
    }
}

/// The manifolds of one convex part on ground.
pub(super) struct Patches<'m> {
    manifolds: &'m mut Vec<Manifold2>,
    /// The index of the part's first manifold.
    first: usize,
    /// Used only if the shapes overlap but no other manifold has a point that touches.
    spare: Option<Manifold2>,
    /// Which of the two bodies the chain is: 0 is A.
    side: usize,
}

impl<'m> Patches<'m> {
    /// Manifolds are appended to a list.
    pub(super) fn new(manifolds: &'m mut Vec<Manifold2>, side: usize) -> Self {
        let first = manifolds.len();
        Self { manifolds, first, spare: None, side }
    }

    /// Adds points to the manifold of their normal. Differences in depth up to `preference` metres do not count.
    pub(super) fn add(&mut self, Patch(next): Patch, preference: f64) {
        let is_alike =
            |known: &&mut Manifold2| (known.normal - next.normal).length_squared() <= ONE_NORMAL * ONE_NORMAL;
        match self.manifolds.iter_mut().skip(self.first).find(is_alike) {
            None => self.manifolds.push(next),
            Some(known) => merge(known, &next, self.side, preference as f32),
        }
    }

    /// The least separation of the part's manifolds; infinite without any.
    pub(super) fn least(&self) -> f32 {
        self.manifolds[self.first..].iter().fold(f32::INFINITY, |least, own| least.min(own.separation))
    }

    /// Keeps a patch, the deepest of such, in case no other one touches.
    pub(super) fn spare(&mut self, patch: Option<Patch>) {
        let Some(Patch(next)) = patch else { return };
        if self.spare.as_ref().is_none_or(|known| next.separation < known.separation) {
            self.spare = Some(next);
        }
    }

    /// Whether there is a contact within a margin of at least zero. The exact answer, `overlapping`, decides the signs.
    pub(super) fn finish(mut self, overlapping: bool, margin: f32) -> bool {
        // Without a margin, shapes that share no point have no contact, even if rounding shows a point as touching.
        if !overlapping && margin == 0.0 {
            self.manifolds.truncate(self.first);
            return false;
        }
        // Points that are only within the margin do not replace the spare patch.
        let is_touched = |own: &Manifold2| own.points.iter().any(|point| point.separation <= 0.0);
        if overlapping
            && !self.manifolds[self.first..].iter().any(is_touched)
            && let Some(spare) = self.spare.take()
        {
            self.add(Patch(spare), 0.0);
        }
        let own = self.manifolds.get_mut(self.first..).unwrap_or_default();
        if !overlapping {
            own.iter_mut().for_each(|known| known.separation = signed(f64::from(known.separation), false));
        } else if let Some(least) =
            own.iter_mut().min_by(|one, other| one.separation.total_cmp(&other.separation))
        {
            least.separation = signed(f64::from(least.separation), true);
        }
        overlapping || !own.is_empty()
    }
}

/// Merges two patches of one normal: keeps the two points furthest apart, unless another is deeper. Then it keeps that
/// one, and the one furthest from it.
fn merge(known: &mut Manifold2, next: &Manifold2, side: usize, preference: f32) {
    let mut points: ArrayVec<ContactPoint2, 4> = ArrayVec::new();
    for &point in known.points.iter().chain(&next.points) {
        match points.iter_mut().find(|other| other.feature == point.feature) {
            Some(same) if point.separation < same.separation => *same = point,
            Some(_) => {}
            None => points.push(point),
        }
    }
    if next.separation < known.separation {
        (known.separation, known.normal) = (next.separation, next.normal);
    }
    known.error = known.error.max(next.error);
    known.part_a = known.part_a.min(next.part_a);
    known.part_b = known.part_b.min(next.part_b);
    let across = known.normal.perp();
    // By the anchors on the body that stands on the chain: the chain's may be long.
    let place = |point: &ContactPoint2| across.dot(if side == 0 { point.anchor_b } else { point.anchor_a });
    points.sort_unstable_by_key(|point| point.feature);
    known.points = widest(&points, place, preference);
}

fn widest(
    points: &[ContactPoint2],
    place: impl Fn(&ContactPoint2) -> f32,
    preference: f32,
) -> ContactPoints<ContactPoint2, 2> {
    let least = |by: &dyn Fn(&ContactPoint2) -> f32| {
        points.iter().copied().reduce(|best, next| if by(&next) < by(&best) { next } else { best })
    };
    let [left, right, deepest] =
        [least(&place), least(&|point| -place(point)), least(&|point| point.separation)];
    let mut kept = ContactPoints::new();
    if let (Some(left), Some(right), Some(deepest)) = (left, right, deepest) {
        let is_deeper = deepest.separation < left.separation.min(right.separation) - preference;
        let one = if is_deeper { deepest } else { left };
        let from = |point: &ContactPoint2| (place(point) - place(&deepest)).abs();
        let other = if is_deeper && from(&left) >= from(&right) { left } else { right };
        kept.push(one);
        if other.feature != one.feature {
            kept.push(other);
        }
        kept.sort_unstable_by_key(|point: &ContactPoint2| point.feature);
    }
    kept
}
