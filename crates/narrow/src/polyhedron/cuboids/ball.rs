//! A point against a cuboid: a ball and a cuboid without their radii.
//!
//! ```text
//! c = the point in the cuboid's axes, h = half extents
//! outside    the closest point is c clamped to -h and h on every axis; the distance is how far that moves it
//!            clamped on one axis, it lies on a face; on two, on an edge; on three, on a corner
//! inside     the least h_i - |c_i|; of equals, the lowest face: -x +x -y +y -z +z
//! ```
//! The closed form replaces an iteration and a search of all faces. However small the gap, the normal lies between
//! those of the faces beside the closest point, so that a point that nearly touches needs no special care. Distance and
//! depth change by no more than the point moves: the answer has the rounding error of c, and no more.

use super::names::edge_through;
use crate::feature::Feature;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// A point, and the nearest point of a cuboid's surface, in the cuboid's axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// The distance, or minus the depth.
    pub(crate) separation: f64,
    /// Unit axis, out of the cuboid.
    pub(crate) normal: DVec3,
    pub(crate) on_cuboid: DVec3,
    /// The corner nearest to the point; of equals, the lowest.
    corner: u8,
    /// The axes on which the nearest point has that corner's coordinate.
    held: u8,
}

impl Nearest {
    #[inline]
    pub(crate) fn of(half: DVec3, point: DVec3) -> Self {
        let corner = point.cmpgt(DVec3::ZERO).bitmask() as u8;
        let held = point.abs().cmpgt(half).bitmask() as u8;
        if held == 0 {
            return Self::inside(half, point, corner);
        }
        let on_cuboid = point.clamp(-half, half);
        // A difference of numbers that differ in f64: its square does not underflow.
        let between = point - on_cuboid;
        let separation = between.length();
        Self { separation, normal: between / separation, on_cuboid, corner, held }
    }

    fn inside(half: DVec3, point: DVec3, corner: u8) -> Self {
        let over = point.abs() - half;
        let axis = if over.x >= over.y && over.x >= over.z {
            0
        } else if over.y >= over.z {
            1
        } else {
            2
        };
        let normal = if corner >> axis & 1 == 1 { DVec3::AXES[axis] } else { -DVec3::AXES[axis] };
        let on_cuboid = point - normal * over[axis];
        Self { separation: over[axis], normal, on_cuboid, corner, held: 1 << axis }
    }

    /// The feature of the cuboid that is nearest.
    pub(crate) fn feature(&self) -> Feature {
        let corner = usize::from(self.corner);
        match self.held {
            0b111 => Feature::Vertex(corner as u32),
            0b110 => Feature::Edge(edge_through(corner, 0) as u32),
            0b101 => Feature::Edge(edge_through(corner, 1) as u32),
            0b011 => Feature::Edge(edge_through(corner, 2) as u32),
            face => {
                let axis = face.trailing_zeros() as usize;
                Feature::Face((2 * axis + (corner >> axis & 1)) as u32)
            }
        }
    }

    /// Corners of the cuboid that span the nearest point: a corner, both ends of an edge, or for a face the triangle of
    /// the nearest corner and its neighbours, which contains the quarter that the point is in.
    pub(crate) fn corners(&self) -> ArrayVec<usize, 3> {
        let free = (0..3).filter(|axis| self.held >> axis & 1 == 0);
        let corner = usize::from(self.corner);
        core::iter::once(corner).chain(free.map(|axis| corner ^ 1 << axis)).take(3).collect()
    }
}
