//! The oracle in space.

use super::{Judged, Part, Place};
use crate::cores::{Piece3, pieces3, separation_of3, turned};
use crate::exact_overlap::exact_overlap3;
use crate::placed::Placed3;
use asunder::{Compound3, Impact3, Motion3, Pose3, Shape3, Volume};
use asunder_geometry::Ground;
use asunder_narrow::Manifold3;
use glam::{DQuat, DVec3, Quat};

impl Judged for Volume {
    type Piece = Piece3;

    fn parts(shape: &Shape3) -> Vec<Part<Self>> {
        if let Some(ground) = Ground::of(shape) {
            let triangles = (0..ground.triangle_count()).filter_map(|number| ground.triangle(number));
            let front = |[a, b, c]: [DVec3; 3]| [(b - a).cross(c - a).normalize(), a];
            return triangles
                .map(|triangle| {
                    let corners = triangle.vertices().map(|corner| corner.as_dvec3());
                    Part {
                        front: ground.is_one_sided().then(|| front(corners)),
                        ..part(triangle.into(), None)
                    }
                })
                .collect();
        }
        match shape {
            Shape3::Compound(compound) => (compound.parts().iter())
                .map(|one| {
                    let alone = Compound3::new([(*one.pose(), one.shape().clone())]).unwrap();
                    part(alone.into(), Some(one.center()))
                })
                .collect(),
            Shape3::HalfSpace(_) => vec![part(shape.clone(), None)],
            _ => vec![part(shape.clone(), Some(shape.center().as_dvec3()))],
        }
    }

    fn placed(part: &Part<Self>, pose: &Pose3) -> Place<Self> {
        let place = |v: DVec3| turned(pose, v) + pose.position();
        let (piece, low, high) = match &part.piece {
            Piece3::Round { core, is_solid, radius } => {
                let vertices: Vec<DVec3> = core.vertices.iter().map(|&v| place(v)).collect();
                let low = vertices.iter().copied().reduce(DVec3::min).unwrap() - *radius;
                let high = vertices.iter().copied().reduce(DVec3::max).unwrap() + *radius;
                let normals = core.normals.iter().map(|&n| turned(pose, n)).collect();
                let core =
                    Placed3 { vertices, normals, facets: core.facets.clone(), edges: core.edges.clone() };
                (Piece3::Round { core, is_solid: *is_solid, radius: *radius }, low, high)
            }
            Piece3::HalfSpace { normal, at } => {
                let all = DVec3::INFINITY;
                (Piece3::HalfSpace { normal: turned(pose, *normal), at: place(*at) }, -all, all)
            }
        };
        let front = part.front.map(|[normal, at]| [turned(pose, normal), place(at)]);
        Place { piece, low, high, center: part.center.map(place), front }
    }

    fn separation(a: &Piece3, b: &Piece3) -> f64 {
        separation_of3(a, b).separation
    }

    fn share_a_point(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> bool {
        exact_overlap3(a, b)
    }

    fn pose_in(motion: &Motion3, from: &Pose3, fraction: f64) -> Pose3 {
        motion.pose_at(from, fraction)
    }

    fn displacement(motion: &Motion3) -> DVec3 {
        motion.displacement()
    }

    fn chord(motion: &Motion3, from: &Pose3) -> f64 {
        let unit = |q: Quat| DQuat::from_array(q.to_array().map(f64::from)).normalize();
        let half = motion.rotation().map_or(1.0, |to| unit(from.rotation()).dot(unit(to)));
        2.0 * (1.0 - half * half).max(0.0).sqrt()
    }

    fn fraction_and_error(impact: &Impact3) -> (f64, f64) {
        (impact.fraction, impact.error.into())
    }

    fn told(manifold: &Manifold3) -> [f64; 2] {
        [manifold.separation.into(), manifold.error.into()]
    }
}

fn part(shape: Shape3, center: Option<DVec3>) -> Part<Volume> {
    let piece = pieces3(&shape, &Pose3::IDENTITY, DVec3::ZERO).swap_remove(0);
    let reach = match &piece {
        Piece3::Round { core, radius, .. } => {
            core.vertices.iter().map(|v| v.length()).fold(0.0, f64::max) + radius
        }
        Piece3::HalfSpace { .. } => f64::INFINITY,
    };
    Part { shape, piece, center, front: None, reach }
}
