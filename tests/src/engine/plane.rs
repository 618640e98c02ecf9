//! The world in the plane.

use super::{Change, Engine, Met, Traits, with_random_traits, with_traits};
use crate::cases::Random;
use crate::shapes::{Clay, KINDS2};
use asunder::{
    Collider, Contact, Event, Hit, Motion2, Pair2, Plane, Polygon, Pose2, Rect, Shape2, Touch2, World,
};
use asunder_narrow::Hint;
use glam::Vec2;

impl Engine for Plane {
    as_the_world_says!();

    fn first_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
    ) -> Option<(f64, bool, Self::Impact)> {
        let pair = Pair2::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.impact(a.1, b.1).map(|impact| (impact.fraction, impact.overlapping, impact))
    }

    fn next_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
        touches: &[Touch2],
    ) -> Option<(f64, Self::Impact)> {
        let pair = Pair2::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.next_impact_beside(touches, a.1, b.1).map(|impact| (impact.fraction, impact))
    }

    fn add_touches(a: &Collider<Self>, b: &Collider<Self>, to: &mut Vec<Touch2>) {
        Pair2::new(a.shape(), a.pose(), b.shape(), b.pose()).add_touches(to);
    }

    fn random_motion(random: &mut Random, reach: f64) -> Self::Motion {
        let displacement = random.vector().truncate() * reach;
        if random.below(2) == 0 {
            return Motion2::shift(displacement).unwrap();
        }
        Motion2::new(displacement, random.rotation2()).unwrap()
    }

    fn shift(x: f64) -> Self::Motion {
        Motion2::shift([x, 0.0]).unwrap()
    }

    fn meet(a: &Collider<Self>, b: &Collider<Self>, _: Hint) -> (Hint, Met<Self>) {
        let pair = Pair2::new(a.shape(), a.pose(), b.shape(), b.pose());
        let (overlapping, manifolds) = (pair.overlaps(), pair.manifolds(a.get_margin() + b.get_margin()));
        (Hint::NONE, (overlapping || !manifolds.is_empty()).then_some((overlapping, manifolds)))
    }

    fn unit_at(x: f64) -> Collider<Self> {
        let unit = Rect::from_half_extents(Vec2::splat(0.5)).unwrap();
        Collider::<Self>::new(unit).at(Self::pose_at(x))
    }

    fn pose_at(x: f64) -> Self::Pose {
        Pose2::at([x, 0.0]).unwrap()
    }

    fn random_pose(random: &mut Random, reach: f64) -> Self::Pose {
        Pose2::new(random.vector().truncate() * reach, random.rotation2()).unwrap()
    }

    fn random_body(random: &mut Random, reach: f64) -> Collider<Self> {
        let kite = [Vec2::ZERO, Vec2::X, Vec2::new(0.8, 0.7), Vec2::new(-0.2, 0.4)];
        let shape: Shape2 = match random.below(40) {
            // The last row is the half-plane, which touches half of all others: too many contacts in a large room.
            0 if reach < 2.0 || random.below(40) == 0 => {
                KINDS2[KINDS2.len() - 1].1(&mut Clay::new(random, 0.7))
            }
            0..30 => KINDS2[random.below(KINDS2.len() - 1)].1(&mut Clay::new(random, 0.7)),
            30..34 => Polygon::new(&kite).unwrap().into(),
            34..37 => Rect::from_half_extents(Vec2::new(0.6, 0.2)).unwrap().into(),
            _ => Rect::from_half_extents(Vec2::splat(0.4)).unwrap().into(),
        };
        let pose = Self::random_pose(random, reach);
        with_random_traits(Collider::<Self>::new(shape).at(pose), random)
    }
}
