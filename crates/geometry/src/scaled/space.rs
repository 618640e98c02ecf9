//! Scaled shapes in space.

use super::{ScaleError, all_scaled, check, scaled_normal, scaled_radius};
use crate::compound::{Compound3, Part3};
use crate::cuboid::Cuboid;
use crate::half_space::HalfSpace;
use crate::height_field::HeightField;
use crate::hull::{Hull, HullError};
use crate::mesh::TriMesh;
use crate::pose3::Pose3;
use crate::segment::{Capsule3, Segment3};
use crate::shape::Shape3;
use crate::sphere::Sphere;
use crate::triangle::Triangle3;
use glam::{Vec2, Vec3};

impl Shape3 {
    /// The shape with every local point multiplied by the factors: `Vec3::splat(0.01)` converts centimetres to metres;
    /// negative factors mirror. The result is a new shape that shares no data with the old one.
    ///
    /// - Triangles of a mesh, cells of a height field and parts of a compound keep their numbers. So do the vertices of
    ///   solid hulls, unless a hull becomes thousands of times flatter and loses some. Mirroring renumbers the corners
    ///   of cuboids and of flat hulls.
    /// - Cuboids that are rotated in a compound become hulls if the factors differ.
    /// - A flat hull stays flat if its new vertices, rounded, still lie in one plane (if it lies along two axes, or
    ///   with powers of two); otherwise it becomes a solid as thick as a rounding.
    /// - [`Hull::error`] is scaled as well, without the rounding of new vertices.
    /// - Triangles that become too small are dropped, as in [`TriMesh::new`].
    ///
    /// Cost: that of making the shape.
    ///
    /// ```
    /// use asunder::{Capsule3, Hull, Shape3, glam::Vec3};
    /// // A model in centimetres.
    /// let model = Shape3::from(Capsule3::from_half_height(60.0, 30.0)?);
    /// let player = model.scaled(Vec3::splat(0.01))?;
    /// assert!((player.radius() - 0.3).abs() < 1e-7);
    ///
    /// let wedge = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)].map(Vec3::from);
    /// let wedge = Shape3::from(Hull::from_points(&wedge)?);
    /// let (long, mirrored) = (wedge.scaled(Vec3::new(1.0, 1.0, 4.0))?, wedge.scaled(Vec3::new(-1.0, 1.0, 1.0))?);
    /// assert!(long.contains(Vec3::new(0.0, 0.0, 4.0)) && mirrored.contains(Vec3::NEG_X) && !mirrored.contains(Vec3::X));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A factor that is zero or not finite; a round shape or a rounding with factors that differ in magnitude; a height
    /// field with negative ones; a result that is out of range, or a hull that has lost a dimension.
    pub fn scaled(&self, factors: Vec3) -> Result<Self, ScaleError> {
        check(&factors.to_array())?;
        match self {
            Self::Compound(compound) => scaled_compound(compound, factors),
            Self::HalfSpace(half_space) => {
                let normal = scaled_normal(half_space.normal().to_array(), factors.to_array());
                Ok(HalfSpace::new(Vec3::from_array(normal))?.into())
            }
            Self::TriMesh(mesh) => Ok(scaled_mesh(mesh, factors)?.into()),
            Self::HeightField(field) => Ok(scaled_field(field, factors)?.into()),
            Self::Cuboid(cuboid) => {
                let radius = scaled_radius(cuboid.radius(), &factors.to_array())?;
                Ok(Cuboid::from_half_extents(cuboid.half_extents() * factors.abs())?.rounded(radius)?.into())
            }
            _ => moved(self, |vertex| vertex * factors, factors),
        }
    }
}

/// The convex shape with its vertices moved and its radius scaled.
fn moved(shape: &Shape3, place: impl Fn(Vec3) -> Vec3, factors: Vec3) -> Result<Shape3, ScaleError> {
    let radius = scaled_radius(shape.radius(), &factors.to_array())?;
    let all = || -> Vec<Vec3> { shape.core().vertices().iter().map(|&vertex| place(vertex)).collect() };
    Ok(match shape {
        // A point, whose radius `Sphere::new` would reject.
        Shape3::Sphere(_) if radius == 0.0 => shape.clone(),
        Shape3::Sphere(_) => Sphere::new(radius)?.into(),
        Shape3::Capsule(capsule) => {
            let [from, to] = capsule.segment().ends().map(place);
            Capsule3::new(from, to, radius)?.into()
        }
        Shape3::Segment(segment) => {
            let [from, to] = segment.ends().map(place);
            Segment3::new(from, to)?.into()
        }
        Shape3::Triangle(triangle) => {
            let [a, b, c] = triangle.vertices().map(place);
            Triangle3::new(a, b, c)?.into()
        }
        Shape3::Hull(hull) => {
            let new = Hull::of_any_dimension(&all())?;
            if new.dimension() < hull.dimension() {
                return Err(HullError::Flat { dimension: new.dimension() }.into());
            }
            let error = f64::from(hull.error()) * f64::from(factors.abs().max_element());
            new.left_out(error).rounded(radius)?.into()
        }
        // A cuboid that is rotated in a compound. Nothing else comes here.
        _ => Hull::from_points(&all())?.rounded(radius)?.into(),
    })
}

fn scaled_compound(compound: &Compound3, factors: Vec3) -> Result<Shape3, ScaleError> {
    let are_equal = factors == Vec3::splat(factors.x);
    let scaled = |part: &Part3| -> Result<(Pose3, Shape3), ScaleError> {
        let (pose, shape) = (part.pose(), part.shape());
        let position = pose.position() * factors.as_dvec3();
        if are_equal || pose.same_rotation(&Pose3::IDENTITY) {
            return Ok((Pose3::new(position, pose.rotation())?, shape.scaled(factors)?));
        }
        let basis = pose.basis();
        let place = |vertex: Vec3| (basis.turn(vertex.as_dvec3()) * factors.as_dvec3()).as_vec3();
        Ok((Pose3::at(position)?, moved(shape, place, factors)?))
    };
    Ok(Compound3::new(all_scaled(compound.parts(), scaled)?)?.into())
}

fn scaled_mesh(mesh: &TriMesh, factors: Vec3) -> Result<TriMesh, ScaleError> {
    let vertices: Vec<Vec3> = mesh.vertices().iter().map(|&vertex| vertex * factors).collect();
    let is_mirrored = factors.as_dvec3().signum().element_product() < 0.0;
    let turned = |&[a, b, c]: &[u32; 3]| if is_mirrored { [a, c, b] } else { [a, b, c] };
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(turned).collect();
    let new = TriMesh::new(vertices, triangles)?;
    Ok(if mesh.is_one_sided() { new.one_sided() } else { new })
}

fn scaled_field(field: &HeightField, factors: Vec3) -> Result<HeightField, ScaleError> {
    if factors.min_element() < 0.0 {
        return Err(ScaleError::Mirrored);
    }
    let heights: Vec<f32> = field.heights().iter().map(|height| height * factors.y).collect();
    let cell = field.cell() * Vec2::new(factors.x, factors.z);
    let cells = |row| (0..field.columns() - 1).map(move |column| (column, row));
    let holes = (0..field.rows() - 1).flat_map(cells).filter(|&(column, row)| field.is_hole(column, row));
    let new = HeightField::new(field.columns(), field.rows(), heights, cell)?.with_holes(holes)?;
    Ok(if field.is_one_sided() { new.one_sided() } else { new })
}
