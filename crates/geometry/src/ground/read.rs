//! Reads the data of several triangles at a time that contacts need.
//!
//! The data of a triangle are in several tables, and the triangles under a body are scattered over the memory of a
//! large mesh: with a million triangles nearly every read is a cache miss. If triangles are read one by one, with much
//! work in between, these misses add up; if they are read together, the misses overlap. Corners come with the boxes of
//! a mesh's tree, and need no read.

use super::{Ground, Prominent};
use crate::aabb::Aabb3;
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use glam::Vec3;

/// A triangle of ground with its data.
///
/// See [`Ground::read_near`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearTriangle {
    /// Its number.
    pub number: u32,
    /// As [`Ground::corners`], in metres.
    pub corners: [Vec3; 3],
    /// As [`Ground::patch`].
    pub patch: u32,
    /// As [`Ground::prominent`].
    pub prominent: Prominent,
}

/// Triangles that are read at a time; most bodies are near fewer.
const AT_ONCE: usize = 12;

impl Ground<'_> {
    /// Visits the same triangles as [`visit_near`](Self::visit_near), in the same order, with the data that are needed
    /// most often. Cost: the same with fewer cache misses, a tenth to a half of the time on large meshes.
    ///
    /// ```
    /// use asunder::{Aabb3, Ground, Shape3, TriMesh, glam::Vec3};
    /// use core::ops::ControlFlow;
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
    /// let shape = Shape3::from(mesh);
    /// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
    /// let _ = ground.read_near(&Aabb3::new(Vec3::splat(-1.0), Vec3::splat(2.0)), |triangle| {
    ///     assert_eq!(triangle.corners, ground.corners(triangle.number));
    ///     assert_eq!(triangle.patch, ground.patch(triangle.number));
    ///     assert_eq!(triangle.prominent, ground.prominent(triangle.number));
    ///     ControlFlow::Continue(())
    /// });
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn read_near(
        self,
        bounds: &Aabb3,
        visitor: impl FnMut(&NearTriangle) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.read_near_if(bounds, |_| true, visitor)
    }

    /// Like [`read_near`](Self::read_near), but only for triangles whose corners are wanted; nothing else is read of
    /// others, which costs less.
    ///
    /// ```
    /// use asunder::{Aabb3, Ground, Shape3, TriMesh, glam::Vec3};
    /// use core::ops::ControlFlow;
    /// let mesh = TriMesh::new([Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::ONE], [[0, 2, 1], [1, 2, 3]])?;
    /// let shape = Shape3::from(mesh);
    /// let ground = Ground::of(&shape).ok_or("a mesh is ground")?;
    /// let is_high = |corners: &[Vec3; 3]| corners.iter().any(|corner| corner.y > 0.5);
    /// let mut high = vec![];
    /// let _ = ground.read_near_if(&Aabb3::new(Vec3::splat(-1.0), Vec3::splat(2.0)), is_high, |triangle| {
    ///     high.push(triangle.number);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(high, [1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn read_near_if(
        self,
        bounds: &Aabb3,
        is_wanted: impl Fn(&[Vec3; 3]) -> bool,
        mut visitor: impl FnMut(&NearTriangle) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut batch = Batch::new_const();
        self.meet_near(bounds, |number, corners| {
            if !is_wanted(&corners) {
                return ControlFlow::Continue(());
            }
            batch.push((number, corners));
            if !batch.is_full() {
                return ControlFlow::Continue(());
            }
            let flow = self.read_all(&batch, &mut visitor);
            batch.clear();
            flow
        })?;
        self.read_all(&batch, &mut visitor)
    }

    /// Like [`visit_near`](Self::visit_near), with corners.
    #[inline]
    fn meet_near(
        self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32, [Vec3; 3]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        match self {
            Self::Mesh(mesh) => mesh.tree().visit_overlapping(bounds, |number, corners| {
                visitor(number, self.known_or_read(number, corners))
            }),
            Self::Field(field) => field.visit_near(bounds, |number| visitor(number, field.corners(number))),
        }
    }

    #[inline(never)]
    fn read_all(
        self,
        batch: &Batch,
        visitor: &mut impl FnMut(&NearTriangle) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (mut patches, mut prominent) = ([0; AT_ONCE], [Prominent::NONE; AT_ONCE]);
        for (i, &(number, _)) in batch.iter().enumerate() {
            (patches[i], prominent[i]) = (self.patch(number), self.prominent(number));
        }
        batch.iter().enumerate().try_for_each(|(i, &(number, corners))| {
            visitor(&NearTriangle { number, corners, patch: patches[i], prominent: prominent[i] })
        })
    }
}

/// Triangles that are to be read together, with their corners.
type Batch = ArrayVec<(u32, [Vec3; 3]), AT_ONCE>;
