//! Posed shapes in double-double, relative to A's position.

use super::dd::{Dd, Dd3};
use super::nearest::Cloud;
use crate::cores::segments;
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use glam::{DVec2, DVec3};

/// A convex part of a posed body.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Everything within a radius of a core.
    Round {
        /// The core's points, posed.
        cloud: Cloud,
        /// The same points as the shape stores them, which is exact.
        stored: Vec<DVec3>,
        /// The images of the coordinate axes, which rotate stored directions.
        turn: [Dd3; 3],
        /// The radius, in metres.
        radius: Dd,
    },
    /// Everything below a plane.
    Half {
        /// Outward unit normal.
        normal: Dd3,
        /// A point of the plane.
        at: Dd3,
    },
}

/// The pieces of a posed shape, relative to `origin`: one, or a compound's parts in order.
pub fn pieces3((shape, pose): (&Shape3, &Pose3), origin: DVec3) -> Vec<Piece> {
    let moved = moved(pose.position().to_array(), origin.to_array());
    match shape {
        Shape3::Compound(compound) => (compound.parts().iter())
            .map(|part| {
                let inner = part.pose();
                let turn = |v: Dd3| turned(pose, turned(inner, v));
                piece3(part.shape(), turn, turned(pose, Dd3::from(inner.position())) + moved)
            })
            .collect(),
        _ => vec![piece3(shape, |v| turned(pose, v), moved)],
    }
}

/// The pieces of a posed shape in the plane, relative to `origin`: one, or a compound's parts in order.
pub fn pieces2((shape, pose): (&Shape2, &Pose2), origin: DVec2) -> Vec<Piece> {
    let moved = moved(pose.position().extend(0.0).to_array(), origin.extend(0.0).to_array());
    match shape {
        Shape2::Compound(compound) => (compound.parts().iter())
            .map(|part| {
                let inner = part.pose();
                let turn = |v: Dd3| turned2(pose, turned2(inner, v));
                piece2(part.shape(), turn, turned2(pose, Dd3::from(inner.position().extend(0.0))) + moved)
            })
            .collect(),
        Shape2::Chain(chain) => {
            segments(chain).map(|segment| piece2(&segment, |v| turned2(pose, v), moved)).collect()
        }
        _ => vec![piece2(shape, |v| turned2(pose, v), moved)],
    }
}

fn piece3(shape: &Shape3, turn: impl Fn(Dd3) -> Dd3, moved: Dd3) -> Piece {
    if let Shape3::HalfSpace(half_space) = shape {
        return half(half_space.normal().as_dvec3(), turn, moved);
    }
    let stored = shape.core().vertices().iter().map(|v| v.as_dvec3()).collect();
    round(stored, shape.radius(), turn, moved)
}

fn piece2(shape: &Shape2, turn: impl Fn(Dd3) -> Dd3, moved: Dd3) -> Piece {
    if let Shape2::HalfPlane(half_plane) = shape {
        return half(half_plane.normal().as_dvec2().extend(0.0), turn, moved);
    }
    let stored = shape.core().vertices().iter().map(|v| v.as_dvec2().extend(0.0)).collect();
    round(stored, shape.radius(), turn, moved)
}

fn half(stored: DVec3, turn: impl Fn(Dd3) -> Dd3, at: Dd3) -> Piece {
    // Stored matrices in the plane are not exactly of unit length, and normals are of any length.
    let normal = Dd3::from(stored).try_normalize().and_then(|normal| turn(normal).try_normalize());
    Piece::Half { normal: normal.expect("refused by the constructor"), at }
}

fn round(stored: Vec<DVec3>, radius: f32, turn: impl Fn(Dd3) -> Dd3, moved: Dd3) -> Piece {
    let cloud = Cloud::new(stored.iter().map(|&v| turn(Dd3::from(v)) + moved).collect());
    let turn = DVec3::AXES.map(|axis| turn(Dd3::from(axis)));
    Piece::Round { cloud, stored, turn, radius: Dd::from(radius) }
}

fn moved(position: [f64; 3], origin: [f64; 3]) -> Dd3 {
    let [x, y, z] = [0, 1, 2].map(|axis| Dd::difference(position[axis], origin[axis]));
    Dd3 { x, y, z }
}

/// A vector rotated by M(q)/|q|^2, by the sandwich product.
fn turned(pose: &Pose3, v: Dd3) -> Dd3 {
    let [x, y, z, w] = pose.rotation().to_array().map(Dd::from);
    let u = Dd3 { x, y, z };
    let across = u.cross(v);
    let twice = (across * w + u.cross(across)) / (u.dot(u) + w * w);
    v + twice + twice
}

/// A vector in the plane rotated by the stored matrix.
fn turned2(pose: &Pose2, v: Dd3) -> Dd3 {
    let (c, s) = (Dd::from(pose.rotation().cos()), Dd::from(pose.rotation().sin()));
    Dd3 { x: c * v.x - s * v.y, y: s * v.x + c * v.y, z: Dd::ZERO }
}
