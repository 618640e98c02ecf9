//! A sphere and a half-space that are parts of nothing: answered at once, in the world's axes.
//!
//! ```text
//! separation    n . (centre - a point of the plane) - radius: the turned normal and the product are what the bound of projections
//!               (44 u) was made for
//! yes or no     the number's beyond twice the bound, else by integers
//! ```
//! The general path makes a point with a radius of the sphere, looks for its lowest vertex, and for a face of it: a manifold takes 330 ns
//! there and 40 here (AMD EPYC, Zen 4, 2 virtual cores, 2026-11-26).

use super::Pair3;
use super::balls::Told;
use crate::feature::{Feature, FeatureId};
use crate::precision::{IN_SPACE, Precision};
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};

/// A sphere and a half-space, as they stand.
pub(super) struct BallOnPlane<'p> {
    pair: &'p Pair3<'p>,
    /// The plane's unit normal, out of the half-space.
    normal: DVec3,
    /// The sphere's centre from the half-space's position, in metres.
    center: DVec3,
    /// Of the centre over the plane, in metres.
    height: f64,
    radius: f64,
    /// Whether the half-space is B.
    is_b: bool,
    precision: Precision,
}

impl Pair3<'_> {
    #[inline]
    pub(super) fn ball_on_plane(&self) -> Option<BallOnPlane<'_>> {
        let (sphere, half_space, pose, is_b) = match (self.shape_a, self.shape_b) {
            (Shape3::Sphere(sphere), Shape3::HalfSpace(half_space)) => {
                (sphere, half_space, &self.pose_b, true)
            }
            (Shape3::HalfSpace(half_space), Shape3::Sphere(sphere)) => {
                (sphere, half_space, &self.pose_a, false)
            }
            _ => return None,
        };
        let normal = pose.basis().turn(half_space.unit_normal());
        let center = if is_b { -self.between } else { self.between };
        let radius = f64::from(sphere.radius());
        let reach = radius + center.abs().element_sum();
        let precision = Precision { size: 0.0, reach, planarity: 0.0, roundings: IN_SPACE[0] };
        Some(BallOnPlane { pair: self, normal, center, height: normal.dot(center), radius, is_b, precision })
    }
}

impl Told for BallOnPlane<'_> {
    #[inline]
    fn separation(&self) -> f64 {
        self.height - self.radius
    }

    #[inline]
    fn precision(&self) -> &Precision {
        &self.precision
    }

    #[cold]
    fn exactly(&self) -> bool {
        self.pair.overlaps_exactly(&[])
    }

    #[inline]
    fn normal(&self) -> Vec3 {
        (if self.is_b { -self.normal } else { self.normal }).as_vec3()
    }

    #[inline]
    fn anchors(&self) -> [Vec3; 2] {
        let on_sphere = (self.normal * -self.radius).as_vec3();
        let on_plane = (self.center - self.normal * self.height).as_vec3();
        if self.is_b { [on_sphere, on_plane] } else { [on_plane, on_sphere] }
    }

    #[inline]
    fn measured_from(&self) -> (bool, DVec3) {
        (false, self.pair.between)
    }

    fn feature(&self) -> FeatureId {
        let (of_plane, of_sphere) = (Feature::Face(0), Feature::Vertex(0));
        if self.is_b { FeatureId::new(of_sphere, of_plane) } else { FeatureId::new(of_plane, of_sphere) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::balls::tests::says_as;
    use super::*;
    use crate::answer::{Tier, Verdict};
    use crate::numbers::Numbers;
    use asunder_geometry::glam::Quat;
    use asunder_geometry::{Compound3, HalfSpace, Pose3, Sphere};

    #[test]
    fn touching_is_exact() {
        let ball: Shape3 = Sphere::new(2.0).unwrap().into();
        let floor: Shape3 = HalfSpace::new(Vec3::Y).unwrap().into();
        let verdict = |y: f64| {
            let at = Pose3::at([5.0, y, -1.0]).unwrap();
            let told = Pair3::new(&ball, &at, &floor, &Pose3::IDENTITY).verdict();
            assert_eq!(told, Pair3::new(&floor, &Pose3::IDENTITY, &ball, &at).verdict());
            told
        };
        assert_eq!(verdict(2.0), Verdict { overlapping: true, tier: Tier::Exact });
        assert_eq!(verdict(2.0_f64.next_up()), Verdict { overlapping: false, tier: Tier::Exact });
        assert_eq!(verdict(2.1), Verdict { overlapping: false, tier: Tier::Bound });
        assert_eq!(verdict(-50.0), Verdict { overlapping: true, tier: Tier::Bound });
    }

    /// The general path, which parts of compounds take, says the same.
    #[test]
    fn a_part_of_a_compound_says_the_same() {
        let mut numbers = Numbers::new(99);
        let (mut near, mut apart) = (0, 0);
        for i in 0..4000 {
            let normal = numbers.vector();
            let Ok(floor) = HalfSpace::new(normal.as_vec3()) else { continue };
            let q = [numbers.vector(), numbers.vector()];
            let turn = Quat::from_xyzw(q[0].x as f32, q[0].y as f32, q[0].z as f32, q[1].x as f32);
            let radius = 0.1 + 0.5 * q[1].y.abs();
            let far = if i % 3 == 0 { 1e7 } else { 0.0 };
            let here = Pose3::new(numbers.vector() + DVec3::X * far, turn).unwrap();
            let there = here.position() + numbers.vector() * if i % 2 == 0 { 1.0 } else { 300.0 };
            let there = Pose3::at(there).unwrap();
            let (floor, ball) = (Shape3::from(floor), Shape3::from(Sphere::new(radius as f32).unwrap()));
            let part: Shape3 = Compound3::new([(Pose3::IDENTITY, ball.clone())]).unwrap().into();
            for is_b in [false, true] {
                let pair = |ball| match is_b {
                    true => Pair3::new(ball, &there, &floor, &here),
                    false => Pair3::new(&floor, &here, ball, &there),
                };
                let (whole, general) = (pair(&ball), pair(&part));
                match says_as(&whole, &general, 1e-6) {
                    true => near += 1,
                    false => apart += 1,
                }
            }
        }
        assert!(near > 2000 && apart > 1000, "{near} near, {apart} apart");
    }
}
