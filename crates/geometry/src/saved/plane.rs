//! Forms of types in the plane.

use super::{Form, said, stored_as};
use crate::chain::{Chain, ChainError};
use crate::circle::Circle;
use crate::compound::{Compound2, CompoundError, Part2};
use crate::direction::DirectionError;
use crate::half_space::HalfPlane;
use crate::motion2::Motion2;
use crate::polygon::Polygon;
use crate::pose2::{Pose2, Rotation2};
use crate::pose3::PoseError;
use crate::radius::RadiusError;
use crate::ray::{Ray2, RayError};
use crate::rect::Rect;
use crate::segment::{Capsule2, CapsuleError, Segment2};
use crate::shape::Shape2;
use crate::vertex::VertexError;
use glam::Vec2;
use serde::{Deserialize, Serialize};

stored_as! {
    Rotation2: RotationForm,
    Pose2: PoseForm,
    Motion2: MotionForm,
    Ray2: RayForm,
    Circle: CircleForm,
    Capsule2: CapsuleForm,
    Rect: RectForm,
    Polygon: PolygonForm,
    HalfPlane: HalfPlaneForm,
    Segment2: SegmentForm,
    Compound2: CompoundForm,
    Chain: ChainForm,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Rotation2", deny_unknown_fields)]
struct RotationForm {
    cos: f32,
    sin: f32,
}

impl Form for RotationForm {
    type Of = Rotation2;
    type Error = PoseError;

    fn of(value: &Rotation2) -> Self {
        Self { cos: value.cos(), sin: value.sin() }
    }

    fn build(self) -> Result<Rotation2, PoseError> {
        Rotation2::restored(self.cos, self.sin)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Pose2", deny_unknown_fields)]
struct PoseForm {
    position: [f64; 2],
    rotation: Rotation2,
}

impl Form for PoseForm {
    type Of = Pose2;
    type Error = PoseError;

    fn of(value: &Pose2) -> Self {
        Self { position: value.position().to_array(), rotation: value.rotation() }
    }

    fn build(self) -> Result<Pose2, PoseError> {
        Pose2::new(self.position, self.rotation)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Motion2", deny_unknown_fields)]
struct MotionForm {
    displacement: [f64; 2],
    #[serde(default)]
    rotation: Option<Rotation2>,
}

impl Form for MotionForm {
    type Of = Motion2;
    type Error = PoseError;

    fn of(value: &Motion2) -> Self {
        Self { displacement: value.displacement().to_array(), rotation: value.rotation() }
    }

    fn build(self) -> Result<Motion2, PoseError> {
        match self.rotation {
            Some(to) => Motion2::new(self.displacement, to),
            None => Motion2::shift(self.displacement),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Ray2", deny_unknown_fields)]
struct RayForm {
    origin: [f64; 2],
    direction: [f32; 2],
}

impl Form for RayForm {
    type Of = Ray2;
    type Error = RayError;

    fn of(value: &Ray2) -> Self {
        Self { origin: value.origin().to_array(), direction: value.direction().to_array() }
    }

    fn build(self) -> Result<Ray2, RayError> {
        Ray2::new(self.origin, Vec2::from_array(self.direction))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Circle", deny_unknown_fields)]
struct CircleForm {
    radius: f32,
}

impl Form for CircleForm {
    type Of = Circle;
    type Error = RadiusError;

    fn of(value: &Circle) -> Self {
        Self { radius: value.radius() }
    }

    fn build(self) -> Result<Circle, RadiusError> {
        Circle::new(self.radius)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Capsule2", deny_unknown_fields)]
struct CapsuleForm {
    ends: [[f32; 2]; 2],
    radius: f32,
}

impl Form for CapsuleForm {
    type Of = Capsule2;
    type Error = CapsuleError;

    fn of(value: &Capsule2) -> Self {
        Self { ends: value.segment().ends().map(|end| end.to_array()), radius: value.radius() }
    }

    fn build(self) -> Result<Capsule2, CapsuleError> {
        let [from, to] = self.ends.map(Vec2::from_array);
        Capsule2::new(from, to, self.radius)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Rect", deny_unknown_fields)]
struct RectForm {
    half_extents: [f32; 2],
    #[serde(default)]
    radius: f32,
}

impl Form for RectForm {
    type Of = Rect;
    type Error = String;

    fn of(value: &Rect) -> Self {
        Self { half_extents: value.half_extents().to_array(), radius: value.radius() }
    }

    fn build(self) -> Result<Rect, String> {
        let sharp = Rect::from_half_extents(Vec2::from_array(self.half_extents)).map_err(said)?;
        sharp.rounded(self.radius).map_err(said)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Polygon", deny_unknown_fields)]
struct PolygonForm {
    vertices: Vec<[f32; 2]>,
    #[serde(default)]
    error: f32,
    #[serde(default)]
    radius: f32,
}

impl Form for PolygonForm {
    type Of = Polygon;
    type Error = String;

    fn of(value: &Polygon) -> Self {
        let vertices = value.vertices().iter().map(|vertex| vertex.to_array()).collect();
        Self { vertices, error: value.error(), radius: value.radius() }
    }

    fn build(self) -> Result<Polygon, String> {
        let vertices: Vec<Vec2> = self.vertices.into_iter().map(Vec2::from_array).collect();
        let sharp = Polygon::restored(&vertices, self.error).map_err(said)?;
        sharp.rounded(self.radius).map_err(said)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "HalfPlane", deny_unknown_fields)]
struct HalfPlaneForm {
    normal: [f32; 2],
}

impl Form for HalfPlaneForm {
    type Of = HalfPlane;
    type Error = DirectionError;

    fn of(value: &HalfPlane) -> Self {
        Self { normal: value.normal().to_array() }
    }

    fn build(self) -> Result<HalfPlane, DirectionError> {
        HalfPlane::new(Vec2::from_array(self.normal))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Segment2", deny_unknown_fields)]
struct SegmentForm {
    ends: [[f32; 2]; 2],
}

impl Form for SegmentForm {
    type Of = Segment2;
    type Error = VertexError;

    fn of(value: &Segment2) -> Self {
        Self { ends: value.ends().map(|end| end.to_array()) }
    }

    fn build(self) -> Result<Segment2, VertexError> {
        let [from, to] = self.ends.map(Vec2::from_array);
        Segment2::new(from, to)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Compound2", deny_unknown_fields)]
struct CompoundForm {
    parts: Vec<PartForm>,
}

impl Form for CompoundForm {
    type Of = Compound2;
    type Error = CompoundError;

    fn of(value: &Compound2) -> Self {
        let part = |part: &Part2| Some(PartForm { pose: *part.pose(), shape: ConvexForm::of(part.shape())? });
        Self { parts: value.parts().iter().filter_map(part).collect() }
    }

    fn build(self) -> Result<Compound2, CompoundError> {
        Compound2::new(self.parts.into_iter().map(|part| (part.pose, part.shape.build())))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Chain", deny_unknown_fields)]
struct ChainForm {
    vertices: Vec<[f32; 2]>,
    #[serde(default)]
    closed: bool,
    #[serde(default)]
    one_sided: bool,
}

impl Form for ChainForm {
    type Of = Chain;
    type Error = ChainError;

    fn of(value: &Chain) -> Self {
        let vertices = value.vertices().iter().map(|vertex| vertex.to_array()).collect();
        Self { vertices, closed: value.is_closed(), one_sided: value.is_one_sided() }
    }

    fn build(self) -> Result<Chain, ChainError> {
        let vertices = self.vertices.into_iter().map(Vec2::from_array);
        let chain = if self.closed { Chain::closed(vertices) } else { Chain::open(vertices) }?;
        Ok(if self.one_sided { chain.one_sided() } else { chain })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Part2", deny_unknown_fields)]
struct PartForm {
    pose: Pose2,
    shape: ConvexForm,
}

/// The shapes that a part may have. Compounds are not among them, so that no input, however deep, makes a loader
/// recurse.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Shape2")]
enum ConvexForm {
    Circle(Circle),
    Capsule(Capsule2),
    Rect(Rect),
    Polygon(Polygon),
    Segment(Segment2),
}

impl ConvexForm {
    /// `None` for shapes that no compound has as a part.
    fn of(shape: &Shape2) -> Option<Self> {
        Some(match shape.clone() {
            Shape2::Circle(shape) => Self::Circle(shape),
            Shape2::Capsule(shape) => Self::Capsule(shape),
            Shape2::Rect(shape) => Self::Rect(shape),
            Shape2::Polygon(shape) => Self::Polygon(shape),
            Shape2::Segment(shape) => Self::Segment(shape),
            Shape2::HalfPlane(_) | Shape2::Compound(_) | Shape2::Chain(_) => return None,
        })
    }

    fn build(self) -> Shape2 {
        match self {
            Self::Circle(shape) => Shape2::Circle(shape),
            Self::Capsule(shape) => Shape2::Capsule(shape),
            Self::Rect(shape) => Shape2::Rect(shape),
            Self::Polygon(shape) => Shape2::Polygon(shape),
            Self::Segment(shape) => Shape2::Segment(shape),
        }
    }
}
