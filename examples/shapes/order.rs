//! The convex parts of bodies, and the order in which they are drawn.

use asunder::glam::DVec3;
use asunder::{Ground, Pair3, Pose2, Pose3, Separation3, Shape2, Shape3};

/// A convex part of a body, in the world.
pub(crate) struct Body<'a, S, P> {
    pub shape: &'a S,
    pub pose: P,
    pub is_b: bool,
}

/// The parts, those furthest from the viewer first.
///
/// The engine says which of two parts is nearer: the normal from one to the other points either towards the viewer or
/// away (Newell, Newell and Sancha, "A solution to the hidden surface problem", 1972, with whole parts for faces).
pub(crate) fn far_to_near<'a>(
    mut left: Vec<Body<'a, Shape3, Pose3>>,
    toward_viewer: DVec3,
) -> Vec<Body<'a, Shape3, Pose3>> {
    let mut order = Vec::new();
    while !left.is_empty() {
        // A part that hides none of those left; if the parts hide each other in a cycle, the first.
        let hides_none =
            left.iter().position(|part| !left.iter().any(|other| hides(part, other, toward_viewer)));
        order.push(left.remove(hides_none.unwrap_or(0)));
    }
    order
}

fn hides(part: &Body<'_, Shape3, Pose3>, other: &Body<'_, Shape3, Pose3>, toward_viewer: DVec3) -> bool {
    if core::ptr::eq(part, other) {
        return false;
    }
    match Pair3::new(other.shape, &other.pose, part.shape, &part.pose).separation(f32::INFINITY) {
        Separation3::Measured(measured) => measured.normal.as_dvec3().dot(toward_viewer) > 1e-6,
        Separation3::AtLeast(_) => false,
    }
}

/// The convex parts of a posed body.
pub(crate) fn parts3<'a>(shape: &'a Shape3, pose: &Pose3, is_b: bool) -> Vec<Body<'a, Shape3, Pose3>> {
    let Shape3::Compound(compound) = shape else { return vec![Body { shape, pose: *pose, is_b }] };
    let parts = compound.parts().iter().filter_map(|part| {
        // The parts of this example's compounds are not rotated.
        let pose = Pose3::new(pose.transform(part.pose().position()), pose.rotation()).ok()?;
        Some(Body { shape: part.shape(), pose, is_b })
    });
    parts.collect()
}

/// The same in the plane.
pub(crate) fn parts2<'a>(shape: &'a Shape2, pose: &Pose2, is_b: bool) -> Vec<Body<'a, Shape2, Pose2>> {
    let Shape2::Compound(compound) = shape else { return vec![Body { shape, pose: *pose, is_b }] };
    let parts = compound.parts().iter().filter_map(|part| {
        let pose = Pose2::new(pose.transform(part.pose().position()), pose.rotation()).ok()?;
        Some(Body { shape: part.shape(), pose, is_b })
    });
    parts.collect()
}

/// The triangles of ground; no triangle for any other shape.
pub(crate) fn triangles(shape: &Shape3) -> Vec<Shape3> {
    let Some(ground) = Ground::of(shape) else { return vec![] };
    (0..ground.triangle_count()).filter_map(|number| Some(ground.triangle(number)?.into())).collect()
}

/// Sorts triangles by their centres, those furthest from the viewer first: good enough for ground, whose neighbouring
/// triangles are about equal in size.
pub(crate) fn far_to_near_triangles(mut triangles: Vec<Shape3>, toward_viewer: DVec3) -> Vec<Shape3> {
    let near = |triangle: &Shape3| triangle.center().as_dvec3().dot(toward_viewer);
    triangles.sort_by(|one, other| near(one).total_cmp(&near(other)));
    triangles
}
