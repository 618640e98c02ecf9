//! Shapes as flat faces, for drawing.
//!
//! A round shape is drawn as the hull of points on its surface, found by its support mapping. An unbounded shape is cut
//! off at the size of a level.

use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{Collider2, Collider3, Ground, Hull, Part3, Polygon, Pose2, Pose3, Shape2, Shape3};
use core::f64::consts::{PI, TAU};

/// Half the side of the square that stands for a half-space or half-plane, in metres.
const FAR: f64 = 30.0;
/// Steps of a full turn on a round surface.
const TURN: usize = 16;

/// A face in the world.
pub struct Face {
    /// Outwards, of length 1.
    pub normal: DVec3,
    /// Counter-clockwise, seen from outside.
    pub corners: Vec<DVec3>,
}

/// The convex parts of a body, each as a body of its own; of ground, its triangles.
///
/// ```
/// use asunder::{Collider3, Sphere};
/// use asunder_examples::picture::mesh::{faces, parts};
/// let ball = Collider3::new(Sphere::new(1.0)?);
/// let faces: Vec<_> = parts(&ball).iter().flat_map(faces).collect();
/// assert!(faces.iter().all(|face| face.corners.iter().all(|corner| (corner.length() - 1.0).abs() < 1e-6)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn parts(body: &Collider3) -> Vec<Collider3> {
    if let Some(ground) = Ground::of(body.shape()) {
        let triangles = (0..ground.triangle_count()).filter_map(|number| ground.triangle(number));
        return triangles.map(|triangle| Collider3::new(triangle).at(*body.pose()).fixed()).collect();
    }
    let Shape3::Compound(compound) = body.shape() else { return vec![body.clone()] };
    let (pose, turn) = (body.pose(), body.pose().rotation());
    let placed = |part: &Part3| {
        let position = pose.transform(part.pose().position());
        let pose = Pose3::new(position, turn * part.pose().rotation()).ok()?;
        let alone = Collider3::new(part.shape().clone()).at(pose);
        let alone = if body.is_fixed() { alone.fixed() } else { alone };
        Some(if body.is_sensor() { alone.sensor() } else { alone })
    };
    compound.parts().iter().filter_map(placed).collect()
}

/// The faces of a convex body.
pub fn faces(body: &Collider3) -> Vec<Face> {
    let (pose, basis) = (body.pose(), body.pose().basis());
    let faces_of = |shape: &Shape3| -> Vec<Face> {
        let core = shape.core();
        let place = |i: usize| pose.position() + basis.turn(core.vertices()[i].as_dvec3());
        let face = |(face, normal): (usize, &DVec3)| Face {
            normal: basis.turn(*normal),
            corners: core.topology().face_vertices(face).map(place).collect(),
        };
        core.normals().iter().enumerate().map(face).collect()
    };
    match body.shape() {
        Shape3::HalfSpace(half_space) => {
            let normal = basis.turn(half_space.unit_normal());
            let aside = normal.any_orthonormal_vector() * FAR;
            let along = normal.cross(aside);
            let corners = [aside + along, along - aside, -aside - along, aside - along];
            vec![Face { normal, corners: corners.map(|corner| pose.position() + corner).to_vec() }]
        }
        shape if shape.radius() > 0.0 => {
            Hull::from_points(&surface(shape)).map_or(Vec::new(), |hull| faces_of(&hull.into()))
        }
        shape => faces_of(shape),
    }
}

/// Points on a rounded shape's surface: the corners of its flat faces, and support points in many directions.
fn surface(shape: &Shape3) -> Vec<Vec3> {
    let core = shape.core();
    let radius = f64::from(shape.radius());
    let corners = core.normals().iter().enumerate().flat_map(|(face, normal)| {
        core.topology().face_vertices(face).map(|i| core.vertices()[i].as_dvec3() + *normal * radius)
    });
    // Round edges are narrow beside the flat faces: fewer steps will do.
    let turn = if core.normals().is_empty() { TURN } else { TURN / 2 };
    let rings = (1..turn / 2).flat_map(|ring| {
        let (sin, cos) = libm::sincos(PI * ring as f64 / (turn / 2) as f64);
        circle(turn).map(move |facing| DVec3::new(facing.x * sin, cos, facing.y * sin))
    });
    let round = rings.chain([DVec3::Y, DVec3::NEG_Y]).filter_map(|direction| shape.support(direction));
    corners.chain(round).map(DVec3::as_vec3).collect()
}

/// The outlines of a body's convex parts in the world, counter-clockwise.
///
/// ```
/// use asunder::{Circle, Collider2};
/// use asunder_examples::picture::mesh::outlines;
/// let outlines = outlines(&Collider2::new(Circle::new(1.0)?));
/// assert!(outlines[0].iter().all(|corner| (corner.length() - 1.0).abs() < 1e-6));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn outlines(body: &Collider2) -> Vec<Vec<DVec2>> {
    let place = |local: DVec2| body.pose().transform(local);
    let Shape2::Compound(compound) = body.shape() else {
        return vec![outline(body.shape()).into_iter().map(place).collect()];
    };
    let part_of = |(pose, shape): (&Pose2, &Shape2)| -> Vec<DVec2> {
        outline(shape).into_iter().map(|local| place(pose.transform(local))).collect()
    };
    compound.parts().iter().map(|part| part_of((part.pose(), part.shape()))).collect()
}

/// A convex shape's outline, in its own axes.
fn outline(shape: &Shape2) -> Vec<DVec2> {
    let local: Vec<Vec2> = match shape {
        Shape2::HalfPlane(half_plane) => {
            let normal = half_plane.unit_normal();
            let (along, deep) = (normal.perp() * FAR, normal * -FAR);
            [-along, along, along + deep, deep - along].iter().rev().map(|corner| corner.as_vec2()).collect()
        }
        shape if shape.radius() > 0.0 => {
            let core = shape.core();
            let sides = core.normals().iter().enumerate().flat_map(|(edge, normal)| {
                let ends = [edge, (edge + 1) % core.vertices().len()];
                ends.map(|i| core.vertices()[i].as_dvec2() + *normal * f64::from(shape.radius()))
            });
            let round = circle(2 * TURN).filter_map(|direction| shape.support(direction));
            let points: Vec<Vec2> = sides.chain(round).map(DVec2::as_vec2).collect();
            Polygon::hull_of(&points).map_or(Vec::new(), |polygon| polygon.vertices().to_vec())
        }
        shape => shape.core().vertices().to_vec(),
    };
    local.into_iter().map(Vec2::as_dvec2).collect()
}

/// Directions all around the circle.
fn circle(turn: usize) -> impl Iterator<Item = DVec2> + Clone {
    (0..turn).map(move |i| {
        let (sin, cos) = libm::sincos(TAU * i as f64 / turn as f64);
        DVec2::new(cos, sin)
    })
}
