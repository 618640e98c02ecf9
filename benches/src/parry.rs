//! Converts our types to parry3d's.

use asunder_geometry::{Aabb3, Part3, Pose3, Shape3};
use glam::Vec3;
use parry3d::bounding_volume::Aabb;
use parry3d::math::Pose;
use parry3d::shape::SharedShape;

/// Converts shapes to parry3d's, each different hull once.
///
/// ```
/// use asunder_benches::parry::Shapes;
/// use asunder_geometry::{Hull, Shape3};
/// use glam::Vec3;
/// let wedge = Shape3::from(Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z])?);
/// let mut shapes = Shapes::default();
/// let (one, other) = (shapes.convert(&wedge).ok_or("no shape")?, shapes.convert(&wedge).ok_or("no shape")?);
/// assert!(std::sync::Arc::ptr_eq(&one.0, &other.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Default)]
pub struct Shapes {
    known: Vec<(Shape3, SharedShape)>,
}

impl Shapes {
    /// The same shape for parry3d; `None` where it rejects the hull. Cost: for a hull, a linear search among the
    /// different ones.
    pub fn convert(&mut self, shape: &Shape3) -> Option<SharedShape> {
        // A city has a million cuboids, no two of them alike, and they are cheap to convert; hulls are not, but few
        // differ.
        let is_dear = matches!(shape, Shape3::Hull(_));
        if is_dear && let Some((_, known)) = self.known.iter().find(|(known, _)| known == shape) {
            return Some(known.clone());
        }
        let converted = match shape {
            Shape3::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                SharedShape::cuboid(half.x, half.y, half.z)
            }
            Shape3::Hull(hull) => SharedShape::convex_hull(hull.vertices())?,
            Shape3::Sphere(sphere) => SharedShape::ball(sphere.radius()),
            Shape3::Capsule(capsule) => {
                let [from, to] = capsule.segment().ends();
                SharedShape::capsule(from, to, capsule.radius())
            }
            Shape3::HalfSpace(half_space) => SharedShape::halfspace(half_space.normal().normalize()),
            Shape3::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices();
                SharedShape::triangle(a, b, c)
            }
            Shape3::Segment(segment) => {
                let [from, to] = segment.ends();
                SharedShape::segment(from, to)
            }
            Shape3::TriMesh(mesh) => {
                SharedShape::trimesh(mesh.vertices().to_vec(), mesh.triangles().to_vec()).ok()?
            }
            Shape3::Compound(compound) => {
                let part = |part: &Part3| Some((pose(part.pose()), self.convert(part.shape())?));
                SharedShape::compound(compound.parts().iter().map(part).collect::<Option<_>>()?)
            }
            // No scene here has one.
            Shape3::HeightField(_) => return None,
        };
        if is_dear {
            self.known.push((shape.clone(), converted.clone()));
        }
        Some(converted)
    }
}

/// The same pose in f32, with a rotation of unit length, as parry3d requires: normalised in f64, so that only the
/// rounding to its types is lost.
///
/// ```
/// use asunder_geometry::Pose3;
/// assert_eq!(asunder_benches::parry::pose(&Pose3::at([1.0, 2.0, 3.0])?).translation.y, 2.0);
/// # Ok::<(), asunder_geometry::PoseError>(())
/// ```
pub fn pose(pose: &Pose3) -> Pose {
    Pose::from_parts(pose.position().as_vec3(), pose.rotation().as_dquat().normalize().as_quat())
}

/// The same box.
///
/// ```
/// use asunder_geometry::Aabb3;
/// use glam::Vec3;
/// let bounds = Aabb3::new(Vec3::ZERO, Vec3::ONE);
/// assert_eq!(asunder_benches::parry::bounds(&bounds).maxs, Vec3::ONE);
/// ```
pub fn bounds(bounds: &Aabb3) -> Aabb {
    let (mins, maxs): (Vec3, Vec3) = (bounds.min, bounds.max);
    Aabb::new(mins, maxs)
}
