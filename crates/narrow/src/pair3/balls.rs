//! Two spheres that are not parts of a compound: in closed form, in world axes.
//!
//! ```text
//! separation    |b - a| - (radius of a + radius of b): the subtraction of positions, three squares, two sums and a
//!               root are off by less than 8 u of |b - a|, well within the error bound of projections (44 u)
//! normal        along b - a; up where the centres coincide, or are so near that rounding would choose
//! yes or no     by the number beyond twice its error bound, else by integers
//! ```
//! The general path, which treats them as points with a radius, computes both bodies' axes and searches for the closest
//! points of two segments: a distance takes 325 ns there and 10 here (AMD EPYC, Zen 4, 2026-11-22).
//!
//! A sphere and a cuboid (`ball`), a half-space (`on_plane`), a capsule (`ball_on_rod`), a triangle
//! (`ball_on_triangle`) or a hull (`ball_on_hull`), and two capsules (`rods`), are answered in the same way:
//! [`ClosedForm`].

use super::{IDENTITY, Pair3, Part, reach_of};
use crate::answer::{Closest3, ContactPoint3, Manifold3, Measured3, Separation3, Tier, Verdict};
use crate::batch::{Proximity, beyond};
use crate::exact::{self, Corner};
use crate::feature::{Feature, FeatureId};
use crate::precision::{Precision, at_least, length_at_most, signed};
use crate::room::Room;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Shape3};

/// Two spheres, with their poses.
struct Balls<'p> {
    pair: &'p Pair3<'p>,
    /// In metres.
    radii: [f64; 2],
    /// The distance of the centres.
    distance: f64,
    separation: f64,
    precision: Precision,
}

/// The answers of pairs in closed form: two spheres, a sphere and a cuboid, a capsule, a triangle or a hull, two
/// capsules, and anything convex over a half-space. `None` for all other pairs.
impl Pair3<'_> {
    /// The pair itself, if it may have a closed form. Checked first, since most pairs have none, and this excludes them
    /// in some ns.
    #[inline(always)]
    fn with_closed_form(&self) -> Option<&Self> {
        let may_have = |shape: &Shape3| matches!(shape, Shape3::Sphere(_) | Shape3::HalfSpace(_));
        let is_ground = || self.shape_a.is_ground() || self.shape_b.is_ground();
        let may = (may_have(self.shape_a) || may_have(self.shape_b)) && !is_ground() || self.are_rods();
        may.then_some(self)
    }

    #[inline]
    pub(crate) fn verdict_in_closed_form(&self) -> Option<Verdict> {
        let pair = self.with_closed_form()?;
        (pair.balls().map(|balls| balls.verdict()))
            .or_else(|| pair.on_plane().map(|over| over.verdict()))
            .or_else(|| pair.ball_on_rod().map(|ball| ball.verdict()))
            .or_else(|| pair.ball_on_triangle().map(|ball| ball.verdict()))
            .or_else(|| pair.verdict_on_hull())
            .or_else(|| pair.rods().map(|rods| rods.verdict()))
            .or_else(|| pair.ball().map(|ball| ball.verdict()))
    }

    #[inline]
    pub(super) fn separation_in_closed_form(&self, limit: f64) -> Option<Separation3> {
        let pair = self.with_closed_form()?;
        (pair.balls().map(|balls| balls.within(limit)))
            .or_else(|| pair.on_plane().map(|over| over.within(limit)))
            .or_else(|| pair.ball_on_rod().map(|ball| ball.within(limit)))
            .or_else(|| pair.ball_on_triangle().map(|ball| ball.within(limit)))
            .or_else(|| pair.ball_on_hull(limit).map(|ball| ball.within(limit)))
            .or_else(|| pair.rods().map(|rods| rods.within(limit)))
            .or_else(|| pair.ball().map(|ball| ball.in_cuboid_axes().within(limit)))
    }

    /// `Some(None)` for a pair that has a closed form and overlaps.
    #[inline]
    pub(super) fn distance_in_closed_form(&self) -> Option<Option<Closest3>> {
        let pair = self.with_closed_form()?;
        (pair.balls().map(|balls| balls.distance()))
            .or_else(|| pair.on_plane().map(|over| over.distance()))
            .or_else(|| pair.ball_on_rod().map(|ball| ball.distance()))
            .or_else(|| pair.ball_on_triangle().map(|ball| ball.distance()))
            .or_else(|| pair.ball_on_hull(f64::INFINITY).map(|ball| ball.distance()))
            .or_else(|| pair.rods().map(|rods| rods.distance()))
            .or_else(|| pair.ball().map(|ball| ball.in_cuboid_axes().distance()))
    }

    #[inline]
    pub(super) fn contact_in_closed_form(&self, margin: f32, manifolds: &mut impl Room) -> Option<Proximity> {
        let pair = self.with_closed_form()?;
        (pair.balls().map(|balls| balls.contact(margin, manifolds)))
            .or_else(|| pair.on_plane().map(|over| over.contact(margin, manifolds)))
            .or_else(|| pair.ball_on_rod().map(|ball| ball.contact(margin, manifolds)))
            .or_else(|| pair.ball_on_triangle().map(|ball| ball.contact(margin, manifolds)))
            .or_else(|| pair.ball_on_hull(reach_of(margin)).map(|ball| ball.contact(margin, manifolds)))
            .or_else(|| pair.rods().map(|rods| rods.contact(margin, manifolds)))
            .or_else(|| pair.ball().map(|ball| ball.contact(margin, manifolds)))
    }

    /// Whether they overlap, by integers, for shapes whose exact test needs no axes. The search begins at `corners`.
    pub(super) fn overlaps_exactly(&self, corners: &[Corner]) -> bool {
        let (a, b) = (Part::whole(self.shape_a, &IDENTITY), Part::whole(self.shape_b, &IDENTITY));
        exact::overlaps3([&a.site(&self.pose_a), &b.site(&self.pose_b)], corners)
    }

    #[inline]
    fn balls(&self) -> Option<Balls<'_>> {
        let (Shape3::Sphere(a), Shape3::Sphere(b)) = (self.shape_a, self.shape_b) else { return None };
        let radii = [a.radius(), b.radius()].map(f64::from);
        let (distance, both) = (self.between.length(), radii[0] + radii[1]);
        let reach = both + length_at_most(self.between);
        let precision = Precision::of_closed_form(reach);
        Some(Balls { pair: self, radii, distance, separation: distance - both, precision })
    }
}

/// A sphere that is not a part of a compound, and the other shape.
pub(super) struct BesideBall<'p> {
    pub(super) shape: &'p Shape3,
    pub(super) pose: &'p Pose3,
    /// Whether the other shape is B.
    pub(super) is_b: bool,
    /// The sphere's centre relative to the other shape's position, in world axes, and the sphere's radius, in metres.
    pub(super) center: DVec3,
    pub(super) radius: f64,
}

impl Pair3<'_> {
    /// The shape beside a sphere; of two spheres, the second one.
    #[inline(always)]
    pub(super) fn beside_ball(&self) -> Option<BesideBall<'_>> {
        let (sphere, shape, pose, is_b) = match (self.shape_a, self.shape_b) {
            (Shape3::Sphere(sphere), shape) => (sphere, shape, &self.pose_b, true),
            (shape, Shape3::Sphere(sphere)) => (sphere, shape, &self.pose_a, false),
            _ => return None,
        };
        let center = if is_b { -self.between } else { self.between };
        Some(BesideBall { shape, pose, is_b, center, radius: sphere.radius().into() })
    }
}

impl BesideBall<'_> {
    /// The precision, whose reach is the sum of all lengths that enter.
    #[inline]
    pub(super) fn precision(&self) -> Precision {
        let reach = self.radius
            + f64::from(self.shape.outer_radius())
            + length_at_most(self.shape.center().as_dvec3())
            + length_at_most(self.center);
        Precision::of_closed_form(reach)
    }
}

/// A separation in closed form, and all answers that follow from it.
pub(super) trait ClosedForm {
    fn pair(&self) -> &Pair3<'_>;
    /// In metres, off by less than a projection of [`ClosedForm::precision`].
    fn separation(&self) -> f64;
    fn precision(&self) -> &Precision;
    /// By how much the separation may be off beyond that, in metres.
    #[inline]
    fn slack(&self) -> f64 {
        0.0
    }
    /// Whether they overlap, by integers.
    #[cold]
    fn exactly(&self) -> bool {
        self.pair().overlaps_exactly(&[])
    }
    /// Unit axis in world axes, from A to B.
    fn normal(&self) -> Vec3;
    /// The points where the shapes are nearest to each other, or deepest in each other.
    fn anchors(&self) -> [Vec3; 2];
    fn feature(&self) -> FeatureId;
    /// Whether points are measured from B.
    #[inline]
    fn is_from_b(&self) -> bool {
        false
    }

    /// Whether they overlap: by the separation, or exactly where that may be rounding.
    #[inline]
    fn verdict(&self) -> Verdict {
        let (separation, doubt) = (self.separation(), 2.0 * self.precision().projection() + self.slack());
        if separation > doubt || separation < -doubt {
            return Verdict { overlapping: separation < 0.0, tier: Tier::Bound };
        }
        Verdict { overlapping: self.exactly(), tier: Tier::Exact }
    }

    #[inline]
    fn beyond(&self, limit: f64) -> bool {
        self.separation() > limit + self.precision().projection()
    }

    #[inline]
    fn measured(&self, overlapping: bool) -> Measured3 {
        Measured3 {
            separation: signed(self.separation(), overlapping),
            error: self.precision().of_distance(self.separation(), self.slack()),
            normal: self.normal(),
        }
    }

    #[inline]
    fn within(&self, limit: f64) -> Separation3 {
        match self.beyond(limit) {
            true => Separation3::AtLeast(at_least(self.separation(), self.precision())),
            false => Separation3::Measured(self.measured(self.verdict().overlapping)),
        }
    }

    /// The closest points, where they do not overlap.
    #[inline]
    fn distance(&self) -> Option<Closest3> {
        if self.verdict().overlapping {
            return None;
        }
        let Measured3 { separation: distance, error, normal } = self.measured(false);
        let [anchor_a, anchor_b] = self.anchors();
        Some(Closest3 { distance, error, normal, anchor_a, anchor_b, part_a: 0, part_b: 0 })
    }

    /// Whether they overlap, if they are within the margin. The manifold is written if one is wanted.
    #[inline]
    fn contact(&self, margin: f32, manifolds: &mut impl Room) -> Proximity {
        let reach = reach_of(margin);
        if self.beyond(reach) {
            let at_least = at_least(self.separation(), self.precision());
            return Proximity::Beyond(beyond(at_least.into(), reach));
        }
        let overlapping = self.verdict().overlapping;
        let Measured3 { separation, error, normal } = self.measured(overlapping);
        if !overlapping && separation > margin.max(0.0) {
            return Proximity::Beyond(0.0);
        }
        if let Some(manifold) = manifolds.room(separation) {
            (manifold.normal, manifold.separation, manifold.error) = (normal, separation, error);
            self.add_points(margin, manifold);
            manifold.plumb(self.is_from_b(), self.pair().between);
        }
        Proximity::Within { overlapping }
    }

    /// Adds the points to a manifold whose other fields are set.
    #[inline]
    fn add_points(&self, _margin: f32, manifold: &mut Manifold3) {
        self.add_point(manifold);
    }

    /// Adds the only point.
    #[inline]
    fn add_point(&self, manifold: &mut Manifold3) {
        let ([anchor_a, anchor_b], feature) = (self.anchors(), self.feature());
        manifold.points.push(ContactPoint3 { separation: manifold.separation, anchor_a, anchor_b, feature });
    }
}

impl ClosedForm for Balls<'_> {
    #[inline]
    fn pair(&self) -> &Pair3<'_> {
        self.pair
    }

    #[inline]
    fn separation(&self) -> f64 {
        self.separation
    }

    #[inline]
    fn precision(&self) -> &Precision {
        &self.precision
    }

    #[cold]
    fn exactly(&self) -> bool {
        self.pair.overlaps_exactly(&[[0, 0]])
    }

    #[inline]
    fn normal(&self) -> Vec3 {
        self.axis().as_vec3()
    }

    #[inline]
    fn anchors(&self) -> [Vec3; 2] {
        let axis = self.axis();
        [(axis * self.radii[0]).as_vec3(), (axis * -self.radii[1]).as_vec3()]
    }

    fn feature(&self) -> FeatureId {
        FeatureId::new(Feature::Vertex(0), Feature::Vertex(0))
    }
}

impl Balls<'_> {
    #[inline]
    fn axis(&self) -> DVec3 {
        if self.distance > self.precision.projection() {
            return self.pair.between / self.distance;
        }
        // Mirrored when A and B are swapped.
        if self.pair.between.y < 0.0 { DVec3::NEG_Y } else { DVec3::Y }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::numbers::Numbers;
    use asunder_geometry::glam::Quat;
    use asunder_geometry::{Compound3, Sphere};

    /// Checks that a pair gives the answers that the general path gives, with anchors within `near` of each other, as a
    /// share of a metre plus their distance from the bodies. Returns whether the pair is near enough for a point.
    fn agrees_with(whole: &Pair3<'_>, general: &Pair3<'_>, near: f32) -> bool {
        assert_eq!(whole.overlaps(), general.overlaps());
        let found = [whole, general].map(|pair| pair.separation(f32::INFINITY));
        let [Separation3::Measured(one), Separation3::Measured(other)] = found else { panic!("no limit") };
        assert!((one.separation - other.separation).abs() <= one.error + other.error);
        // For a face that is flat only up to rounding, the general path may have tighter bounds on its corners.
        let slack = [whole.shape_a, whole.shape_b].map(|shape| match shape {
            Shape3::Hull(hull) => 5.0 * hull.planarity_error(),
            _ => 0.0,
        });
        assert!(
            (one.normal - other.normal).length() < 1e-6 && one.error <= other.error + slack[0] + slack[1]
        );
        let closest = [whole.distance(), general.distance()];
        assert_eq!(closest.map(|closest| closest.is_none()), [whole.overlaps(); 2]);
        if let [Some(one), Some(other)] = closest {
            assert!((one.distance - other.distance).abs() <= one.error + other.error);
        }
        let manifolds = [whole, general].map(|pair| pair.manifold(0.1));
        let [Some(one), Some(other)] = manifolds else {
            assert_eq!(manifolds.map(|manifold| manifold.is_none()), [true; 2]);
            return false;
        };
        assert_eq!(one.points.len(), other.points.len());
        assert!((one.separation - other.separation).abs() <= one.error + other.error);
        for (one, other) in one.points.iter().zip(&other.points) {
            assert_eq!(one.feature, other.feature);
            let off = (one.anchor_a - other.anchor_a).length() + (one.anchor_b - other.anchor_b).length();
            assert!(off <= near * (1.0 + one.anchor_a.length() + one.anchor_b.length()), "{off}");
            assert!((one.separation - other.separation).abs() <= near, "{one:?} and not {other:?}");
        }
        !one.points.is_empty()
    }

    /// How many pairs were near enough for a point, and how many were not.
    #[derive(Debug, Default)]
    pub(in crate::pair3) struct Counts {
        pub(in crate::pair3) near: u32,
        pub(in crate::pair3) apart: u32,
    }

    /// Any rotation, as a quaternion of any length.
    pub(in crate::pair3) fn any_turn(numbers: &mut Numbers) -> Quat {
        let [v, w] = [numbers.vector(), numbers.vector()];
        Quat::from_xyzw(v.x as f32, v.y as f32, v.z as f32, w.x as f32)
    }

    /// A pose, every third time far from the origin, and a place near it: up to `near` away, or every other time up to
    /// three.
    pub(in crate::pair3) fn pose_and_place(numbers: &mut Numbers, i: u32, near: f64) -> (Pose3, DVec3) {
        let far = if i.is_multiple_of(3) { 1e7 } else { 0.0 };
        let here = Pose3::new(numbers.vector() + DVec3::X * far, any_turn(numbers)).unwrap();
        let there = here.position() + numbers.vector() * if i.is_multiple_of(2) { near } else { 3.0 };
        (here, there)
    }

    /// A sphere of 0.1 to 0.6 m.
    pub(in crate::pair3) fn any_ball(numbers: &mut Numbers) -> Shape3 {
        ball((0.1 + 0.5 * numbers.vector().y.abs()) as f32)
    }

    /// Checks that a shape beside another gives the same answers as that shape as a part of a compound, in both orders.
    pub(in crate::pair3) fn agrees_with_a_part(
        (body, there): (&Shape3, &Pose3),
        (other, here): (&Shape3, &Pose3),
        counts: &mut Counts,
    ) {
        let part: Shape3 = Compound3::new([(Pose3::IDENTITY, body.clone())]).unwrap().into();
        for is_b in [false, true] {
            let pair = |body| match is_b {
                true => Pair3::new(body, there, other, here),
                false => Pair3::new(other, here, body, there),
            };
            let is_near = agrees_with(&pair(body), &pair(&part), 1e-6);
            *(if is_near { &mut counts.near } else { &mut counts.apart }) += 1;
        }
    }

    /// Checks that two shapes touch where the second is at `place + way`, in both orders, and not beyond. The length of
    /// `way` is whole, or in quarters.
    pub(in crate::pair3) fn touch_exactly([shape, other]: [&Shape3; 2], place: DVec3, way: DVec3) {
        let verdict = |longer: f64| {
            let there = Pose3::at(place + way * longer).unwrap();
            let found = Pair3::new(shape, &Pose3::IDENTITY, other, &there).verdict();
            assert_eq!(found, Pair3::new(other, &there, shape, &Pose3::IDENTITY).verdict(), "{place}");
            found
        };
        let (exact, by_bound) = (Tier::Exact, Tier::Bound);
        assert_eq!(verdict(1.0), Verdict { overlapping: true, tier: exact }, "{place}");
        assert_eq!(verdict(1.0 + f64::EPSILON), Verdict { overlapping: false, tier: exact }, "{place}");
        assert_eq!(verdict(1.1), Verdict { overlapping: false, tier: by_bound }, "{place}");
        assert_eq!(verdict(0.9), Verdict { overlapping: true, tier: by_bound }, "{place}");
    }

    fn ball(radius: f32) -> Shape3 {
        Sphere::new(radius).unwrap().into()
    }

    #[test]
    fn touching_is_exact() {
        let (a, b) = (ball(2.0), ball(3.0));
        let verdict = |x: f64| {
            let there = Pose3::at([x, 4.0, 0.0]).unwrap();
            Pair3::new(&a, &Pose3::IDENTITY, &b, &there).verdict()
        };
        assert_eq!(verdict(3.0), Verdict { overlapping: true, tier: Tier::Exact });
        assert_eq!(verdict(3.0_f64.next_up()), Verdict { overlapping: false, tier: Tier::Exact });
        assert_eq!(verdict(3.1), Verdict { overlapping: false, tier: Tier::Bound });
        assert_eq!(verdict(2.9), Verdict { overlapping: true, tier: Tier::Bound });
    }

    #[test]
    fn centres_in_one_place_have_an_axis() {
        let (a, b) = (ball(2.0), ball(0.5));
        for y in [0.0, 1e-300, -1e-300] {
            let there = Pose3::at([0.0, y, 0.0]).unwrap();
            let manifold = Pair3::new(&a, &Pose3::IDENTITY, &b, &there).manifold(0.0).unwrap();
            assert_eq!((manifold.separation, manifold.normal.length()), (-2.5, 1.0));
            let mirrored = Pair3::new(&b, &there, &a, &Pose3::IDENTITY).manifold(0.0).unwrap();
            assert_eq!(mirrored.separation, -2.5);
            assert!(y == 0.0 || mirrored.normal == -manifold.normal);
        }
    }

    /// The general path, which parts of compounds take, gives the same answers.
    #[test]
    fn parts_of_compounds_have_the_same_answers() {
        let (mut near, mut apart) = (0, 0);
        for i in 0..2000_u32 {
            let number = |salt: u32| f64::from((i * 7919 + salt * 104_729) % 1000) / 500.0 - 1.0;
            let (a, b) = (ball(0.2 + number(1).abs() as f32), ball(0.2 + number(2).abs() as f32));
            let far = if i % 3 == 0 { 1e7 } else { 0.0 };
            let here = Pose3::at([far, 0.0, 0.0]).unwrap();
            let there = DVec3::new(number(3), number(4), number(5)) * 2.0;
            let there = Pose3::at(there + DVec3::X * far).unwrap();
            let part = Compound3::new([(Pose3::IDENTITY, a.clone())]).unwrap().into();
            let (whole, parts) = (Pair3::new(&a, &here, &b, &there), Pair3::new(&part, &here, &b, &there));
            match agrees_with(&whole, &parts, 2.5e-6) {
                true => near += 1,
                false => apart += 1,
            }
        }
        assert!(near > 300 && apart > 300, "{near} near, {apart} apart");
    }
}
