//! Forms of types in space.

use super::{Form, said, stored_as};
use crate::compound::{Compound3, CompoundError, Part3};
use crate::cuboid::Cuboid;
use crate::direction::DirectionError;
use crate::half_space::HalfSpace;
use crate::height_field::{HeightField, HeightFieldError};
use crate::hull::Hull;
use crate::mesh::{MeshError, TriMesh};
use crate::motion3::Motion3;
use crate::pose3::{Pose3, PoseError};
use crate::radius::RadiusError;
use crate::ray::{Ray3, RayError};
use crate::segment::{Capsule3, CapsuleError, Segment3};
use crate::shape::Shape3;
use crate::sphere::Sphere;
use crate::triangle::Triangle3;
use crate::vertex::VertexError;
use glam::{Quat, Vec2, Vec3};
use serde::{Deserialize, Serialize};

stored_as! {
    Pose3: PoseForm,
    Motion3: MotionForm,
    Ray3: RayForm,
    Sphere: SphereForm,
    Capsule3: CapsuleForm,
    Cuboid: CuboidForm,
    Hull: HullForm,
    HalfSpace: HalfSpaceForm,
    Triangle3: TriangleForm,
    Segment3: SegmentForm,
    Compound3: CompoundForm,
    TriMesh: MeshForm,
    HeightField: FieldForm,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Pose3", deny_unknown_fields)]
struct PoseForm {
    position: [f64; 3],
    rotation: [f32; 4],
}

impl Form for PoseForm {
    type Of = Pose3;
    type Error = PoseError;

    fn of(value: &Pose3) -> Self {
        Self { position: value.position().to_array(), rotation: value.rotation().to_array() }
    }

    fn build(self) -> Result<Pose3, PoseError> {
        Pose3::new(self.position, Quat::from_array(self.rotation))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Motion3", deny_unknown_fields)]
struct MotionForm {
    displacement: [f64; 3],
    #[serde(default)]
    rotation: Option<[f32; 4]>,
}

impl Form for MotionForm {
    type Of = Motion3;
    type Error = PoseError;

    fn of(value: &Motion3) -> Self {
        Self {
            displacement: value.displacement().to_array(),
            rotation: value.rotation().map(|rotation| rotation.to_array()),
        }
    }

    fn build(self) -> Result<Motion3, PoseError> {
        match self.rotation {
            Some(to) => Motion3::new(self.displacement, Quat::from_array(to)),
            None => Motion3::shift(self.displacement),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Ray3", deny_unknown_fields)]
struct RayForm {
    origin: [f64; 3],
    direction: [f32; 3],
}

impl Form for RayForm {
    type Of = Ray3;
    type Error = RayError;

    fn of(value: &Ray3) -> Self {
        Self { origin: value.origin().to_array(), direction: value.direction().to_array() }
    }

    fn build(self) -> Result<Ray3, RayError> {
        Ray3::new(self.origin, Vec3::from_array(self.direction))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Sphere", deny_unknown_fields)]
struct SphereForm {
    radius: f32,
}

impl Form for SphereForm {
    type Of = Sphere;
    type Error = RadiusError;

    fn of(value: &Sphere) -> Self {
        Self { radius: value.radius() }
    }

    fn build(self) -> Result<Sphere, RadiusError> {
        Sphere::new(self.radius)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Capsule3", deny_unknown_fields)]
struct CapsuleForm {
    ends: [[f32; 3]; 2],
    radius: f32,
}

impl Form for CapsuleForm {
    type Of = Capsule3;
    type Error = CapsuleError;

    fn of(value: &Capsule3) -> Self {
        Self { ends: value.segment().ends().map(|end| end.to_array()), radius: value.radius() }
    }

    fn build(self) -> Result<Capsule3, CapsuleError> {
        let [from, to] = self.ends.map(Vec3::from_array);
        Capsule3::new(from, to, self.radius)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Cuboid", deny_unknown_fields)]
struct CuboidForm {
    half_extents: [f32; 3],
    #[serde(default)]
    radius: f32,
}

impl Form for CuboidForm {
    type Of = Cuboid;
    type Error = String;

    fn of(value: &Cuboid) -> Self {
        Self { half_extents: value.half_extents().to_array(), radius: value.radius() }
    }

    fn build(self) -> Result<Cuboid, String> {
        let sharp = Cuboid::from_half_extents(Vec3::from_array(self.half_extents)).map_err(said)?;
        sharp.rounded(self.radius).map_err(said)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Hull", deny_unknown_fields)]
struct HullForm {
    vertices: Vec<[f32; 3]>,
    faces: Vec<Vec<u16>>,
    #[serde(default)]
    error: f32,
    #[serde(default)]
    radius: f32,
}

impl Form for HullForm {
    type Of = Hull;
    type Error = String;

    fn of(value: &Hull) -> Self {
        let vertices = value.vertices().iter().map(|vertex| vertex.to_array()).collect();
        Self { vertices, faces: value.loops(), error: value.error(), radius: value.radius() }
    }

    fn build(self) -> Result<Hull, String> {
        let vertices: Vec<Vec3> = self.vertices.into_iter().map(Vec3::from_array).collect();
        let sharp = Hull::restored(&vertices, self.faces, self.error).map_err(said)?;
        sharp.rounded(self.radius).map_err(said)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "HalfSpace", deny_unknown_fields)]
struct HalfSpaceForm {
    normal: [f32; 3],
}

impl Form for HalfSpaceForm {
    type Of = HalfSpace;
    type Error = DirectionError;

    fn of(value: &HalfSpace) -> Self {
        Self { normal: value.normal().to_array() }
    }

    fn build(self) -> Result<HalfSpace, DirectionError> {
        HalfSpace::new(Vec3::from_array(self.normal))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Triangle3", deny_unknown_fields)]
struct TriangleForm {
    vertices: [[f32; 3]; 3],
}

impl Form for TriangleForm {
    type Of = Triangle3;
    type Error = VertexError;

    fn of(value: &Triangle3) -> Self {
        Self { vertices: value.vertices().map(|vertex| vertex.to_array()) }
    }

    fn build(self) -> Result<Triangle3, VertexError> {
        let [a, b, c] = self.vertices.map(Vec3::from_array);
        Triangle3::new(a, b, c)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Segment3", deny_unknown_fields)]
struct SegmentForm {
    ends: [[f32; 3]; 2],
}

impl Form for SegmentForm {
    type Of = Segment3;
    type Error = VertexError;

    fn of(value: &Segment3) -> Self {
        Self { ends: value.ends().map(|end| end.to_array()) }
    }

    fn build(self) -> Result<Segment3, VertexError> {
        let [from, to] = self.ends.map(Vec3::from_array);
        Segment3::new(from, to)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Compound3", deny_unknown_fields)]
struct CompoundForm {
    parts: Vec<PartForm>,
}

impl Form for CompoundForm {
    type Of = Compound3;
    type Error = CompoundError;

    fn of(value: &Compound3) -> Self {
        let part = |part: &Part3| Some(PartForm { pose: *part.pose(), shape: ConvexForm::of(part.shape())? });
        Self { parts: value.parts().iter().filter_map(part).collect() }
    }

    fn build(self) -> Result<Compound3, CompoundError> {
        Compound3::new(self.parts.into_iter().map(|part| (part.pose, part.shape.build())))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Part3", deny_unknown_fields)]
struct PartForm {
    pose: Pose3,
    shape: ConvexForm,
}

/// The shapes that a part may have. Compounds are not among them, so that no input, however deep, makes a loader
/// recurse.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Shape3")]
enum ConvexForm {
    Sphere(Sphere),
    Capsule(Capsule3),
    Cuboid(Cuboid),
    Hull(Hull),
    Triangle(Triangle3),
    Segment(Segment3),
}

impl ConvexForm {
    /// `None` for shapes that no compound has as a part.
    fn of(shape: &Shape3) -> Option<Self> {
        Some(match shape.clone() {
            Shape3::Sphere(shape) => Self::Sphere(shape),
            Shape3::Capsule(shape) => Self::Capsule(shape),
            Shape3::Cuboid(shape) => Self::Cuboid(shape),
            Shape3::Hull(shape) => Self::Hull(shape),
            Shape3::Triangle(shape) => Self::Triangle(shape),
            Shape3::Segment(shape) => Self::Segment(shape),
            Shape3::HalfSpace(_) | Shape3::Compound(_) => return None,
            Shape3::TriMesh(_) | Shape3::HeightField(_) => return None,
        })
    }

    fn build(self) -> Shape3 {
        match self {
            Self::Sphere(shape) => Shape3::Sphere(shape),
            Self::Capsule(shape) => Shape3::Capsule(shape),
            Self::Cuboid(shape) => Shape3::Cuboid(shape),
            Self::Hull(shape) => Shape3::Hull(shape),
            Self::Triangle(shape) => Shape3::Triangle(shape),
            Self::Segment(shape) => Shape3::Segment(shape),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "TriMesh", deny_unknown_fields)]
struct MeshForm {
    vertices: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    #[serde(default)]
    one_sided: bool,
}

impl Form for MeshForm {
    type Of = TriMesh;
    type Error = MeshError;

    fn of(value: &TriMesh) -> Self {
        Self {
            vertices: value.vertices().iter().map(|vertex| vertex.to_array()).collect(),
            triangles: value.triangles().to_vec(),
            one_sided: value.is_one_sided(),
        }
    }

    fn build(self) -> Result<TriMesh, MeshError> {
        let vertices: Vec<Vec3> = self.vertices.into_iter().map(Vec3::from_array).collect();
        let mesh = TriMesh::new(vertices, self.triangles)?;
        Ok(if self.one_sided { mesh.one_sided() } else { mesh })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "HeightField", deny_unknown_fields)]
struct FieldForm {
    columns: usize,
    rows: usize,
    cell: [f32; 2],
    heights: Vec<f32>,
    #[serde(default)]
    holes: Vec<[usize; 2]>,
    #[serde(default)]
    one_sided: bool,
}

impl Form for FieldForm {
    type Of = HeightField;
    type Error = HeightFieldError;

    fn of(value: &HeightField) -> Self {
        let (columns, rows) = (value.columns(), value.rows());
        let cells = (1..rows).flat_map(|row| (1..columns).map(move |column| [column - 1, row - 1]));
        Self {
            columns,
            rows,
            cell: value.cell().to_array(),
            heights: value.heights().to_vec(),
            holes: cells.filter(|&[column, row]| value.is_hole(column, row)).collect(),
            one_sided: value.is_one_sided(),
        }
    }

    fn build(self) -> Result<HeightField, HeightFieldError> {
        let whole = HeightField::new(self.columns, self.rows, self.heights, Vec2::from_array(self.cell))?;
        let holes = self.holes.into_iter().map(|[column, row]| (column, row));
        let field = if holes.len() > 0 { whole.with_holes(holes)? } else { whole };
        Ok(if self.one_sided { field.one_sided() } else { field })
    }
}
