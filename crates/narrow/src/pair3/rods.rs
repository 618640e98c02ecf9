//! Two capsules or segments that are not parts of a compound: in closed form, in world axes.
//!
//! ```text
//! separation    of the closest points of two segments, in closed form (polyhedron::slender), less both radii; where a
//!               projection on their axis shows less, by more than an eighth of the error bound of projections, the
//!               general path answers
//! yes or no     by the number beyond twice its error bound, else by integers
//! points        one, or both ends of the stretch along which they lie side by side
//! ```
//! The general path works in A's axes, which takes the rotation between both, and one back: a distance takes 390 ns
//! there and 170 here. Yes or no, and manifolds, take as long as there; they are answered here so that every query
//! gives the same number (Intel Xeon, Ice Lake, 2 virtual cores, 2026-11-26).

use super::balls::ClosedForm;
use super::{Pair3, reach_of};
use crate::answer::{ContactPoint3, Manifold3};
use crate::feature::{Feature, FeatureId};
use crate::polyhedron::slender::{Nearest, Slender, nearest, touch};
use crate::precision::{Precision, length_at_most};
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::FACE_PREFERENCE;

/// Two segments with radii, with their poses, in world axes about A's position.
pub(super) struct Rods<'p> {
    pair: &'p Pair3<'p>,
    rods: [Slender; 2],
    nearest: Nearest,
    precision: Precision,
}

const fn is_rod(shape: &Shape3) -> bool {
    matches!(shape, Shape3::Capsule(_) | Shape3::Segment(_))
}

impl Pair3<'_> {
    #[inline]
    pub(super) const fn are_rods(&self) -> bool {
        is_rod(self.shape_a) && is_rod(self.shape_b)
    }

    #[inline]
    pub(super) fn rods(&self) -> Option<Rods<'_>> {
        if !self.are_rods() {
            return None;
        }
        let rods = [
            Slender::of(self.shape_a, (&self.pose_a.basis(), DVec3::ZERO))?,
            Slender::of(self.shape_b, (&self.pose_b.basis(), self.between))?,
        ];
        let of_shape =
            |shape: &Shape3| f64::from(shape.outer_radius()) + length_at_most(shape.center().as_dvec3());
        let reach = of_shape(self.shape_a) + of_shape(self.shape_b) + length_at_most(self.between);
        let precision = Precision::of_closed_form(reach);
        let nearest = nearest(&rods[0], &rods[1], precision.projection());
        let is_proved = precision.is_proved(nearest.distance, nearest.at_least);
        is_proved.then_some(Rods { pair: self, rods, nearest, precision })
    }
}

impl ClosedForm for Rods<'_> {
    #[inline]
    fn pair(&self) -> &Pair3<'_> {
        self.pair
    }

    #[inline]
    fn separation(&self) -> f64 {
        self.nearest.distance - (self.rods[0].radius + self.rods[1].radius)
    }

    #[inline]
    fn precision(&self) -> &Precision {
        &self.precision
    }

    #[inline]
    fn normal(&self) -> Vec3 {
        self.nearest.normal.as_vec3()
    }

    #[inline]
    fn anchors(&self) -> [Vec3; 2] {
        let Nearest { normal, on_a, on_b, .. } = self.nearest;
        self.anchors_of([on_a + normal * self.rods[0].radius, on_b - normal * self.rods[1].radius])
    }

    fn feature(&self) -> FeatureId {
        FeatureId::new(Feature::Edge(0), Feature::Edge(0))
    }

    #[inline]
    fn add_points(&self, margin: f32, manifold: &mut Manifold3) {
        let smaller = f64::from(self.pair.shape_a.outer_radius().min(self.pair.shape_b.outer_radius()));
        let preference = self.precision.share(FACE_PREFERENCE, smaller);
        let [a, b] = &self.rods;
        for point in touch([a, b], &self.nearest, reach_of(margin), preference).points {
            let [anchor_a, anchor_b] = self.anchors_of([point.on_a, point.on_b]);
            let (separation, feature) = (point.separation as f32, point.feature);
            manifold.points.push(ContactPoint3 { separation, anchor_a, anchor_b, feature });
        }
    }
}

impl Rods<'_> {
    /// Anchors from points in world axes about A's position.
    #[inline]
    fn anchors_of(&self, [on_a, on_b]: [DVec3; 2]) -> [Vec3; 2] {
        [on_a.as_vec3(), (on_b - self.pair.between).as_vec3()]
    }
}

#[cfg(test)]
mod tests {
    use super::super::balls::tests::{Counts, agrees_with_a_part, pose_and_place, touch_exactly};
    use super::*;
    use crate::numbers::Numbers;
    use asunder_geometry::glam::Quat;
    use asunder_geometry::{Capsule3, Pose3, Segment3};

    fn capsule(from: DVec3, to: DVec3, radius: f32) -> Shape3 {
        Capsule3::new(from.as_vec3(), to.as_vec3(), radius).unwrap().into()
    }

    #[test]
    fn touching_is_exact_across_along_and_end_to_end() {
        let rod = capsule(DVec3::X * -2.0, DVec3::X * 2.0, 1.0);
        for (other, way) in [
            (capsule(DVec3::Y * -2.0, DVec3::Y * 2.0, 3.0), DVec3::Z * 4.0),
            (capsule(DVec3::X * -2.0, DVec3::X * 2.0, 3.0), DVec3::new(1.0, 4.0, 0.0)),
            (capsule(DVec3::X * -1.0, DVec3::X * 1.0, 3.0), DVec3::X * -7.0),
        ] {
            touch_exactly([&rod, &other], DVec3::ZERO, way);
        }
    }

    #[test]
    fn rods_side_by_side_have_two_points_and_crossed_ones_one() {
        let rod = capsule(DVec3::X * -2.0, DVec3::X * 2.0, 0.5);
        let points = |other: &Shape3| {
            let there = Pose3::at([1.0, 0.9, 0.0]).unwrap();
            Pair3::new(&rod, &Pose3::IDENTITY, other, &there).manifold(0.0).unwrap().points
        };
        let beside = points(&rod);
        assert_eq!(beside.iter().map(|point| point.anchor_a.x).collect::<Vec<_>>(), [2.0, -1.0]);
        assert_eq!(points(&capsule(DVec3::Z * -2.0, DVec3::Z * 2.0, 0.5)).len(), 1);
    }

    /// The general path, which parts of compounds take, gives the same answers: for rods in any pose, crossed, and side
    /// by side.
    #[test]
    fn a_part_of_a_compound_has_the_same_answers() {
        let mut numbers = Numbers::new(79);
        let mut counts = Counts::default();
        for i in 0..6000_u32 {
            let mut rod = |along: Option<DVec3>| {
                let (from, any) = (numbers.vector(), numbers.vector());
                let to = along.map_or(any, |along| from + along * any.x);
                let segment = || Segment3::new(from.as_vec3(), to.as_vec3()).map(Shape3::from).ok();
                let capsule = || Capsule3::new(from.as_vec3(), to.as_vec3(), 0.3).map(Shape3::from).ok();
                if i % 4 == 0 { segment() } else { capsule() }
            };
            let along = (i % 3 == 0).then_some(DVec3::new(0.3, 1.0, -0.5));
            let (Some(a), Some(b)) = (rod(along), rod(along)) else { continue };
            let (here, there) = pose_and_place(&mut numbers, i, 0.5);
            // Side by side, or in any pose.
            let turn = if along.is_some() { here.rotation() } else { Quat::IDENTITY };
            let there = Pose3::new(there, turn).unwrap();
            agrees_with_a_part((&a, &there), (&b, &here), &mut counts);
        }
        assert!(counts.near > 1000 && counts.apart > 3000, "{counts:?}");
    }
}
