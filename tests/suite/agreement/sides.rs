//! Both dimensions behind one trait: what a pair reports, what is exact, and how to move a body by very little.

use asunder::{Collider, Collider2, Collider3, Plane, Pose2, Pose3, Shape2, Shape3, Volume};
use asunder_narrow::{Pair2, Pair3, Separation2, Separation3};
use asunder_scenes::hard::{FAMILIES2, FAMILIES3};
use asunder_tests::engine::Engine;
use asunder_tests::exact_overlap::{exact_overlap2, exact_overlap3};
use glam::{DVec2, DVec3};

/// What a pair reports.
pub(super) struct Facts {
    pub(super) overlaps: bool,
    pub(super) guess: bool,
    /// Without a limit, in metres.
    pub(super) separation: f32,
    pub(super) error: f32,
    /// With a limit of zero, where it is measured.
    pub(super) within_nothing: Option<f32>,
    pub(super) distance: Option<f32>,
    /// Number of contact points without a margin.
    pub(super) points: usize,
}

/// A dimension, and what these tests need of it.
pub(super) trait Side: Engine {
    /// `count` pairs of every hard family, cycling through the levels.
    fn hard_pairs(count: usize, seed: u64) -> Vec<[Collider<Self>; 2]>;
    /// What the narrow phase reports.
    fn facts(bodies: &[Collider<Self>; 2]) -> Facts;
    /// Whether they overlap by exact arithmetic.
    fn exactly_overlap(bodies: &[Collider<Self>; 2]) -> bool;
    /// Whether both are half-spaces, which have no contact points unless they face exactly opposite ways.
    fn are_endless(bodies: &[Collider<Self>; 2]) -> bool;
    /// The sum of the finite bounding radii, in metres.
    fn reach(bodies: &[Collider<Self>; 2]) -> f64;
    /// The pose moved by `metres` on every axis, towards the origin.
    fn stepped(pose: &Self::Pose, metres: f64) -> Self::Pose;
    /// B's pose, moved by `metres` along the normal (from A to B) that the pair reports.
    fn along_normal(bodies: &[Collider<Self>; 2], metres: f64) -> Self::Pose;
    /// B's pose with one coordinate moved by `ulps`: the one along which the normal is longest, and upwards where B
    /// lies above A.
    fn ulps_along(bodies: &[Collider<Self>; 2], ulps: i64) -> Self::Pose;
}

/// The value moved up by `ulps` steps of f64.
pub(super) fn ulps_up(value: f64, ulps: i64) -> f64 {
    (0..ulps.abs()).fold(value, |value, _| if ulps > 0 { value.next_up() } else { value.next_down() })
}

/// Moves towards zero, so that no body leaves the world.
fn towards_zero(value: f64, metres: f64) -> f64 {
    if value > 0.0 { value - metres } else { value + metres }
}

fn longest(axis: &[f64]) -> usize {
    (0..axis.len()).max_by(|&i, &j| axis[i].abs().total_cmp(&axis[j].abs())).expect("an axis has coordinates")
}

pub(super) fn pair(bodies: &[Collider3; 2]) -> Pair3<'_> {
    Pair3::new(bodies[0].shape(), bodies[0].pose(), bodies[1].shape(), bodies[1].pose())
}

pub(super) fn pair_in_plane(bodies: &[Collider2; 2]) -> Pair2<'_> {
    Pair2::new(bodies[0].shape(), bodies[0].pose(), bodies[1].shape(), bodies[1].pose())
}

fn normal3(bodies: &[Collider3; 2]) -> DVec3 {
    match pair(bodies).separation(f32::INFINITY) {
        Separation3::Measured(measured) => measured.normal.as_dvec3(),
        Separation3::AtLeast(_) => panic!("there is no limit"),
    }
}

fn normal2(bodies: &[Collider2; 2]) -> DVec2 {
    match pair_in_plane(bodies).separation(f32::INFINITY) {
        Separation2::Measured(measured) => measured.normal.as_dvec2(),
        Separation2::AtLeast(_) => panic!("there is no limit"),
    }
}

impl Side for Volume {
    fn hard_pairs(count: usize, seed: u64) -> Vec<[Collider3; 2]> {
        let pairs = FAMILIES3.iter().flat_map(|family| family.pairs(count, seed));
        pairs
            .map(|p| [Collider3::new(p.shape_a).at(p.pose_a), Collider3::new(p.shape_b).at(p.pose_b)])
            .collect()
    }

    fn facts(bodies: &[Collider3; 2]) -> Facts {
        let pair = pair(bodies);
        let measured = |limit: f32| match pair.separation(limit) {
            Separation3::Measured(measured) => Some((measured.separation, measured.error)),
            Separation3::AtLeast(_) => None,
        };
        let (separation, error) = measured(f32::INFINITY).expect("there is no limit");
        Facts {
            overlaps: pair.overlaps(),
            guess: pair.guess(),
            separation,
            error,
            within_nothing: measured(0.0).map(|(separation, _)| separation),
            distance: pair.distance().map(|closest| closest.distance),
            points: pair.manifold(0.0).map_or(0, |manifold| manifold.points.len()),
        }
    }

    fn exactly_overlap([a, b]: &[Collider3; 2]) -> bool {
        exact_overlap3((a.shape(), a.pose()), (b.shape(), b.pose()))
    }

    fn are_endless(bodies: &[Collider3; 2]) -> bool {
        bodies.iter().all(|body| matches!(body.shape(), Shape3::HalfSpace(_)))
    }

    fn reach(bodies: &[Collider3; 2]) -> f64 {
        let radii = bodies.iter().map(|body| f64::from(body.shape().outer_radius()));
        radii.filter(|radius| radius.is_finite()).sum()
    }

    fn stepped(pose: &Pose3, metres: f64) -> Pose3 {
        let position = pose.position().to_array().map(|x| towards_zero(x, metres));
        Pose3::new(DVec3::from_array(position), pose.rotation()).unwrap()
    }

    fn along_normal(bodies: &[Collider3; 2], metres: f64) -> Pose3 {
        let pose = bodies[1].pose();
        Pose3::new(pose.position() + normal3(bodies) * metres, pose.rotation()).unwrap()
    }

    fn ulps_along(bodies: &[Collider3; 2], ulps: i64) -> Pose3 {
        let (normal, pose) = (normal3(bodies), bodies[1].pose());
        let axis = longest(&normal.to_array());
        let mut position = pose.position();
        position[axis] = ulps_up(position[axis], if normal[axis] > 0.0 { ulps } else { -ulps });
        Pose3::new(position, pose.rotation()).unwrap()
    }
}

impl Side for Plane {
    fn hard_pairs(count: usize, seed: u64) -> Vec<[Collider2; 2]> {
        let pairs = FAMILIES2.iter().flat_map(|family| family.pairs(count, seed));
        pairs
            .map(|p| [Collider2::new(p.shape_a).at(p.pose_a), Collider2::new(p.shape_b).at(p.pose_b)])
            .collect()
    }

    fn facts(bodies: &[Collider2; 2]) -> Facts {
        let pair = pair_in_plane(bodies);
        let measured = |limit: f32| match pair.separation(limit) {
            Separation2::Measured(measured) => Some((measured.separation, measured.error)),
            Separation2::AtLeast(_) => None,
        };
        let (separation, error) = measured(f32::INFINITY).expect("there is no limit");
        Facts {
            overlaps: pair.overlaps(),
            guess: pair.guess(),
            separation,
            error,
            within_nothing: measured(0.0).map(|(separation, _)| separation),
            distance: pair.distance().map(|closest| closest.distance),
            points: pair.manifold(0.0).map_or(0, |manifold| manifold.points.len()),
        }
    }

    fn exactly_overlap([a, b]: &[Collider2; 2]) -> bool {
        exact_overlap2((a.shape(), a.pose()), (b.shape(), b.pose()))
    }

    fn are_endless(bodies: &[Collider2; 2]) -> bool {
        bodies.iter().all(|body| matches!(body.shape(), Shape2::HalfPlane(_)))
    }

    fn reach(bodies: &[Collider2; 2]) -> f64 {
        let radii = bodies.iter().map(|body| f64::from(body.shape().outer_radius()));
        radii.filter(|radius| radius.is_finite()).sum()
    }

    fn stepped(pose: &Pose2, metres: f64) -> Pose2 {
        let position = pose.position().to_array().map(|x| towards_zero(x, metres));
        Pose2::new(DVec2::from_array(position), pose.rotation()).unwrap()
    }

    fn along_normal(bodies: &[Collider2; 2], metres: f64) -> Pose2 {
        let pose = bodies[1].pose();
        Pose2::new(pose.position() + normal2(bodies) * metres, pose.rotation()).unwrap()
    }

    fn ulps_along(bodies: &[Collider2; 2], ulps: i64) -> Pose2 {
        let (normal, pose) = (normal2(bodies), bodies[1].pose());
        let axis = longest(&normal.to_array());
        let mut position = pose.position();
        position[axis] = ulps_up(position[axis], if normal[axis] > 0.0 { ulps } else { -ulps });
        Pose2::new(position, pose.rotation()).unwrap()
    }
}
