//! What carries a character: where it stands on a body, and where that place is later.

use super::{Linear, Slide, Walk, Walks};
use crate::space::{BodyKey2, BodyKey3};
use crate::world::World;
use asunder_geometry::glam::{DVec2, DVec3};
use asunder_geometry::{Pose2, Pose3};

/// A place on a body on which a character stands, to be carried along with it. `K` is a key, `O` a pose and `P` a point
/// of f64; use it as [`Footing2`] or [`Footing3`].
///
/// Create one after each move with `footing` of the world, and apply it before the next with `carried`.
///
/// ```
/// use asunder::{Collider3, Cuboid, Filter3, Footing3, Pose3, Shape3, Sphere, Walk3, World3, glam::Vec3};
/// let mut world = World3::new();
/// let lift = world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?));
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// let walk = Walk3::new(&ball, Vec3::Y)?;
/// let slide = world.move_and_slide((&ball, &Pose3::at([0.0, 1.6, 0.0])?), Vec3::Y * -0.5, &walk, &Filter3::new());
/// let footing: Option<Footing3> = world.footing(&slide, &walk);
/// let footing = footing.ok_or("it stands on the lift")?;
/// assert_eq!(footing.body, lift);
/// world.set_pose(lift, Pose3::at([3.0, 0.25, 0.0])?)?;
/// let pose = world.carried(&footing, &slide.pose);
/// assert_eq!(pose.position() - slide.pose.position(), [3.0, 0.25, 0.0].into());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Footing<K, O, P> {
    /// The body.
    pub body: K,
    /// Where the body was then.
    pub pose: O,
    /// The point that is carried, in world space, in metres: straight below the character's position, as high as where
    /// it stood on the body.
    pub point: P,
}

/// A place on a body on which a character in the plane stands.
pub type Footing2 = Footing<BodyKey2, Pose2, DVec2>;

/// A place on a body on which a character in space stands.
pub type Footing3 = Footing<BodyKey3, Pose3, DVec3>;

/// Of a flat foot, the ground's point is any corner: one that turned about that would wander over a turntable.
pub(super) fn footing<S: Walks>(
    world: &World<S>,
    slide: &Slide<S::Key, S::Pose, S::Vector, S::Point>,
    walk: &Walk<S::Vector>,
) -> Option<Footing<S::Key, S::Pose, S::Point>> {
    let ground = slide.ground.as_ref()?;
    let pose = world.bodies.get(ground.body)?.pose;
    let (up, center) = (S::wide(walk.up).unit(), S::position(&slide.pose));
    let point = up.map_or(ground.point, |up| center - up * (center - ground.point).dot(up));
    Some(Footing { body: ground.body, pose, point })
}

/// The character's pose, moved as the point under its foot was. Only that: kept in the body's axes, the centre of a
/// character on a seesaw would be swung to and fro above the pivot.
pub(super) fn carried<S: Walks>(
    world: &World<S>,
    footing: &Footing<S::Key, S::Pose, S::Point>,
    pose: &S::Pose,
) -> S::Pose {
    let (then, body) = (footing.pose, world.bodies.get(footing.body));
    let Some(body) = body.filter(|body| body.is_enabled() && body.pose != then) else { return *pose };
    let arm = footing.point - S::position(&then);
    let turned = S::turned_since(&then, &body.pose, arm) - arm;
    let by = S::position(&body.pose) - S::position(&then) + turned;
    S::moved(pose, by).unwrap_or(*pose)
}
