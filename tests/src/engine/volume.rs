//! The world in space.

use super::{Change, Engine, Met, Traits, with_random_traits, with_traits};
use crate::cases::Random;
use crate::shapes::{Clay, KINDS3};
use asunder::{
    Collider, Contact, Cuboid, Event, Hit, Hull, Motion3, Pair3, Pose3, Shape3, Touch3, Volume, World,
};
use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
use glam::Vec3;

impl Engine for Volume {
    as_the_world_says!();

    fn first_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
    ) -> Option<(f64, bool, Self::Impact)> {
        let pair = Pair3::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.impact(a.1, b.1).map(|impact| (impact.fraction, impact.overlapping, impact))
    }

    fn next_touch(
        a: (&Collider<Self>, &Self::Motion),
        b: (&Collider<Self>, &Self::Motion),
        touches: &[Touch3],
    ) -> Option<(f64, Self::Impact)> {
        let pair = Pair3::new(a.0.shape(), a.0.pose(), b.0.shape(), b.0.pose());
        pair.next_impact_beside(touches, a.1, b.1).map(|impact| (impact.fraction, impact))
    }

    fn add_touches(a: &Collider<Self>, b: &Collider<Self>, to: &mut Vec<Touch3>) {
        Pair3::new(a.shape(), a.pose(), b.shape(), b.pose()).add_touches(to);
    }

    fn random_motion(random: &mut Random, reach: f64) -> Self::Motion {
        let displacement = random.vector() * reach;
        if random.below(2) == 0 {
            return Motion3::shift(displacement).unwrap();
        }
        Motion3::new(displacement, random.quaternion()).unwrap()
    }

    fn shift(x: f64) -> Self::Motion {
        Motion3::shift([x, 0.0, 0.0]).unwrap()
    }

    fn meet(a: &Collider<Self>, b: &Collider<Self>, hint: Hint) -> (Hint, Met<Self>) {
        let mut batch = Batch3::default();
        let margin = a.get_margin() + b.get_margin();
        let (shape_a, pose_a, shape_b, pose_b) = (a.shape(), a.pose(), b.shape(), b.pose());
        let sensor = a.is_sensor() || b.is_sensor();
        collide3(&[Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint, ahead: 0.0, sensor }], &mut batch);
        let overlaps = Pair3::new(shape_a, pose_a, shape_b, pose_b).overlaps();
        match batch.answers[0] {
            Answer::Apart { hint, .. } => {
                assert!(!overlaps);
                (hint, None)
            }
            Answer::Contact { hint, overlapping, .. } => {
                assert_eq!(overlapping, overlaps);
                (hint, Some((overlapping, batch.manifolds)))
            }
        }
    }

    fn unit_at(x: f64) -> Collider<Self> {
        let unit = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap();
        Collider::<Self>::new(unit).at(Self::pose_at(x))
    }

    fn pose_at(x: f64) -> Self::Pose {
        Pose3::at([x, 0.0, 0.0]).unwrap()
    }

    fn random_pose(random: &mut Random, reach: f64) -> Self::Pose {
        Pose3::new(random.vector() * reach, random.quaternion()).unwrap()
    }

    fn random_body(random: &mut Random, reach: f64) -> Collider<Self> {
        let wedge =
            [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.6, 0.7, 0.2), Vec3::new(0.4, 0.1, -0.3)];
        let shape: Shape3 = match random.below(40) {
            // The last row is the half-space, which touches half of all others: too many contacts in a large room.
            0 if reach < 2.0 || random.below(40) == 0 => {
                KINDS3[KINDS3.len() - 1].1(&mut Clay::new(random, 0.7))
            }
            0..30 => KINDS3[random.below(KINDS3.len() - 1)].1(&mut Clay::new(random, 0.7)),
            30..34 => Hull::from_points(&wedge).unwrap().into(),
            34..37 => Cuboid::from_half_extents(Vec3::new(0.6, 0.3, 0.2)).unwrap().into(),
            _ => Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap().into(),
        };
        let pose = Self::random_pose(random, reach);
        with_random_traits(Collider::<Self>::new(shape).at(pose), random)
    }
}
