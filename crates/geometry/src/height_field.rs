//! Height fields.

use crate::aabb::Aabb3;
use crate::ground::Prominent;
use crate::mesh::TriMesh;
use crate::pose3::Pose3;
use crate::triangle::Triangle3;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};

/// Ground with one height above each point of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    mesh: TriMesh,
}

impl HeightField {
    /// Whether it is solid only from the front.
    pub const fn is_one_sided(&self) -> bool {
        self.mesh.is_one_sided()
    }

    /// The centre that the bounding radius is about: the middle of its box.
    pub fn center(&self) -> Vec3 {
        self.mesh.center()
    }

    /// Bounding radius about [`HeightField::center`], in metres, rounded up.
    pub fn outer_radius(&self) -> f32 {
        self.mesh.outer_radius()
    }

    /// Whether any triangle holds a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        self.mesh.contains(point)
    }

    /// The box around the posed field, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        self.mesh.bounds(pose, margin)
    }

    pub(crate) fn triangle_count(&self) -> u32 {
        self.mesh.triangle_count()
    }

    pub(crate) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.mesh.corners(triangle)
    }

    pub(crate) fn triangle(&self, triangle: u32) -> Option<Triangle3> {
        self.mesh.triangle(triangle)
    }

    pub(crate) fn vertex_numbers(&self, triangle: u32) -> [u32; 3] {
        self.mesh.vertex_numbers(triangle)
    }

    pub(crate) fn neighbor(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        self.mesh.neighbor(triangle, edge)
    }

    pub(crate) fn prominent(&self, triangle: u32) -> Prominent {
        self.mesh.prominent(triangle)
    }

    pub(crate) fn patch(&self, triangle: u32) -> u32 {
        self.mesh.patch(triangle)
    }

    pub(crate) fn visit_near(
        &self,
        bounds: &Aabb3,
        visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.mesh.visit_near(bounds, visitor)
    }
}
