//! The oracle in the plane.

use super::{Judged, Part, Place};
use crate::cores::{Piece2, pieces2, segments, separation_of2};
use crate::exact_overlap::exact_overlap2;
use crate::placed::Placed2;
use asunder::{Compound2, Impact2, Motion2, Plane, Pose2, Rotation2, Shape2};
use asunder_narrow::Manifold2;
use glam::{DVec2, DVec3};

impl Judged for Plane {
    type Piece = Piece2;

    fn parts(shape: &Shape2) -> Vec<Part<Self>> {
        match shape {
            Shape2::Chain(chain) => segments(chain)
                .map(|segment| {
                    let [from, to] = [0, 1].map(|end| segment.core().vertices()[end].as_dvec2());
                    // The front of a one-sided chain is on its right.
                    let normal = -(to - from).perp().normalize();
                    let front = chain.is_one_sided().then_some([normal.extend(0.0), from.extend(0.0)]);
                    Part { front, ..part(segment, None) }
                })
                .collect(),
            Shape2::Compound(compound) => (compound.parts().iter())
                .map(|one| {
                    let alone = Compound2::new([(*one.pose(), one.shape().clone())]).unwrap();
                    part(alone.into(), Some(one.center()))
                })
                .collect(),
            Shape2::HalfPlane(_) => vec![part(shape.clone(), None)],
            _ => vec![part(shape.clone(), Some(shape.center().as_dvec2()))],
        }
    }

    fn placed(part: &Part<Self>, pose: &Pose2) -> Place<Self> {
        let number = DVec2::new(pose.rotation().cos().into(), pose.rotation().sin().into());
        let place = |v: DVec2| number.rotate(v) + pose.position();
        let (piece, low, high) = match &part.piece {
            Piece2::Round { core, radius } => {
                let vertices: Vec<DVec2> = core.vertices.iter().map(|&v| place(v)).collect();
                let low = vertices.iter().copied().reduce(DVec2::min).unwrap() - *radius;
                let high = vertices.iter().copied().reduce(DVec2::max).unwrap() + *radius;
                (Piece2::Round { core: Placed2 { vertices }, radius: *radius }, low, high)
            }
            Piece2::HalfPlane { normal, at } => {
                let normal = number.rotate(*normal).normalize();
                (Piece2::HalfPlane { normal, at: place(*at) }, -DVec2::INFINITY, DVec2::INFINITY)
            }
        };
        let raised = |v: DVec3| place(v.truncate()).extend(0.0);
        let turned = |v: DVec3| number.rotate(v.truncate()).normalize().extend(0.0);
        Place {
            piece,
            low: low.extend(0.0),
            high: high.extend(0.0),
            center: part.center.map(raised),
            front: part.front.map(|[normal, at]| [turned(normal), raised(at)]),
        }
    }

    fn separation(a: &Piece2, b: &Piece2) -> f64 {
        separation_of2(a, b).separation
    }

    fn share_a_point(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> bool {
        exact_overlap2(a, b)
    }

    fn pose_in(motion: &Motion2, from: &Pose2, fraction: f64) -> Pose2 {
        motion.pose_at(from, fraction)
    }

    fn displacement(motion: &Motion2) -> DVec3 {
        motion.displacement().extend(0.0)
    }

    fn chord(motion: &Motion2, from: &Pose2) -> f64 {
        let vector = |r: Rotation2| DVec2::new(r.cos().into(), r.sin().into());
        motion.rotation().map_or(0.0, |to| (vector(from.rotation()) - vector(to)).length())
    }

    fn fraction_and_error(impact: &Impact2) -> (f64, f64) {
        (impact.fraction, impact.error.into())
    }

    fn told(manifold: &Manifold2) -> [f64; 2] {
        [manifold.separation.into(), manifold.error.into()]
    }
}

fn part(shape: Shape2, center: Option<DVec2>) -> Part<Plane> {
    let piece = pieces2(&shape, &Pose2::IDENTITY, DVec2::ZERO).swap_remove(0);
    let reach = match &piece {
        Piece2::Round { core, radius } => {
            core.vertices.iter().map(|v| v.length()).fold(0.0, f64::max) + radius
        }
        Piece2::HalfPlane { .. } => f64::INFINITY,
    };
    Part { shape, piece, center: center.map(|center| center.extend(0.0)), front: None, reach }
}
