//! Several convex parts in space under one collider.

use super::{CompoundError, MANY_PARTS, tree_of};
use crate::aabb::{Aabb3, Bounds};
use crate::ground::tree::{Line, Near, Reach, Sides, Tree};
use crate::outward::{around3, round_up};
use crate::pose3::Pose3;
use crate::shape::Shape3;
use crate::tolerance::{MAX_PARTS, MAX_RADIUS};
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// Several convex parts in space, each posed, that move as one. Clones share the data.
///
#[doc = include_str!("../../doc/compound3.svg")]
///
/// It is the union of its parts, which may overlap; parts of one body do not collide with each other. Each pair of
/// touching parts of two bodies has a manifold of its own. The separation from another shape is the least of its
/// parts'.
///
/// Cost of a pair: a bounding sphere test for each pair of parts, and the cost of the pairs that pass. With 16 parts or
/// more, which are looked up in a tree: logarithmic in their number for each part of the other, and the cost of the
/// parts nearby.
///
/// ```
/// use asunder::{Compound3, Cuboid, Pose3, Shape3, Sphere, glam::{DVec3, Vec3}};
/// let head: Shape3 = Sphere::new(0.4)?.into();
/// let body: Shape3 = Cuboid::from_half_extents(Vec3::new(0.1, 1.0, 0.1))?.into();
/// let hammer = Compound3::new([(Pose3::at([0.0, 1.0, 0.0])?, head), (Pose3::IDENTITY, body)])?;
/// assert_eq!(hammer.parts().len(), 2);
/// assert!(hammer.contains(DVec3::new(0.0, 1.4, 0.0)) && !hammer.contains(DVec3::X));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Compound3 {
    data: Arc<Data3>,
    center: Vec3,
    outer_radius: f32,
}

struct Data3 {
    parts: Box<[Part3]>,
    /// The boxes of the parts, in the compound's axes.
    tree: Tree,
}

/// A part of a compound in space.
///
/// ```
/// use asunder::{Compound3, Pose3, Shape3, Sphere};
/// let ball: Shape3 = Sphere::new(1.0)?.into();
/// let part = &Compound3::new([(Pose3::IDENTITY, ball.clone())])?.parts()[0].clone();
/// assert_eq!((part.pose(), part.shape()), (&Pose3::IDENTITY, &ball));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Part3 {
    pose: Pose3,
    shape: Shape3,
    center: DVec3,
}

impl Part3 {
    fn new(pose: Pose3, shape: Shape3) -> Self {
        let center = pose.transform(shape.center());
        Self { pose, shape, center }
    }

    /// The pose of the part in the compound.
    #[inline]
    pub const fn pose(&self) -> &Pose3 {
        &self.pose
    }

    /// The shape of the part, convex and bounded.
    #[inline]
    pub const fn shape(&self) -> &Shape3 {
        &self.shape
    }

    /// Centre of its bounding sphere, in the compound's axes.
    #[inline]
    pub const fn center(&self) -> DVec3 {
        self.center
    }

    /// The box around the part, where the compound is at this pose.
    fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let core = self.shape.core();
        let points = core.vertices().iter().map(|&vertex| self.pose.transform(vertex));
        // The position of a part far from the compound's origin was rounded accordingly, and the pose may bring the
        // part back near the world's origin, where that rounding matters.
        let lost =
            64.0 * f64::EPSILON * (self.pose.position().length() + f64::from(self.shape.outer_radius()));
        around3(points, pose, f64::from(margin) + f64::from(self.shape.radius()) + lost)
    }
}

impl Compound3 {
    /// A compound from its parts and their poses.
    ///
    /// # Errors
    /// No parts, or more than [`MAX_PARTS`]; a part that is a compound, ground or unbounded, or that reaches beyond
    /// 1e6 m.
    pub fn new(parts: impl IntoIterator<Item = (Pose3, Shape3)>) -> Result<Self, CompoundError> {
        Self::of(parts.into_iter().map(|(pose, shape)| Part3::new(pose, shape)).collect())
    }

    fn of(parts: Box<[Part3]>) -> Result<Self, CompoundError> {
        if parts.is_empty() {
            return Err(CompoundError::NoParts);
        }
        if parts.len() > MAX_PARTS {
            return Err(CompoundError::TooManyParts { count: parts.len() });
        }
        let mut boxes = Vec::with_capacity(parts.len());
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (index, part) in parts.iter().enumerate() {
            match part.shape {
                Shape3::Compound(_) => return Err(CompoundError::Nested { index }),
                Shape3::HalfSpace(_) => return Err(CompoundError::Unbounded { index }),
                Shape3::TriMesh(_) | Shape3::HeightField(_) => return Err(CompoundError::Ground { index }),
                _ => {}
            }
            let radius = f64::from(part.shape.outer_radius());
            if part.center().length() + radius > f64::from(MAX_RADIUS) {
                return Err(CompoundError::TooLarge { index });
            }
            let bounds = part.shape.bounds(&part.pose, 0.0);
            (low, high) = (low.min(bounds.min.as_dvec3()), high.max(bounds.max.as_dvec3()));
            boxes.push(bounds);
        }
        let center = ((low + high) * 0.5).as_vec3();
        let reach = |part: &Part3| {
            (part.center() - center.as_dvec3()).length() + f64::from(part.shape.outer_radius())
        };
        let outer = parts.iter().map(reach).fold(0.0, f64::max);
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        let tree = tree_of(&boxes);
        Ok(Self { data: Arc::new(Data3 { parts, tree }), center, outer_radius })
    }

    /// An address that two compounds have in common exactly when they share their parts; valid only while both live. It
    /// differs from run to run: use it for look-ups, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        Arc::as_ptr(&self.data).addr()
    }

    /// The parts, in the order given; a manifold's `part_a` and `part_b` are indices of them.
    #[inline]
    pub fn parts(&self) -> &[Part3] {
        &self.data.parts
    }

    /// Passes every part whose box overlaps `bounds`, in the compound's axes, to `visitor`, each once, until it breaks
    /// off. The order depends only on the compound and the box. Cost: logarithmic in the parts, and linear in those
    /// that are passed.
    ///
    /// ```
    /// use asunder::{Aabb3, Compound3, Pose3, Shape3, Sphere, glam::Vec3};
    /// use core::ops::ControlFlow;
    /// let ball: Shape3 = Sphere::new(0.5)?.into();
    /// let row = Compound3::new([(Pose3::at(Vec3::ZERO)?, ball.clone()), (Pose3::at(Vec3::X * 2.0)?, ball)])?;
    /// let mut near = vec![];
    /// let _ = row.visit_near(&Aabb3::new(Vec3::X, Vec3::X * 1.5), |part| {
    ///     near.push(part);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(near, [1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn visit_near(
        &self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.data.tree.visit_overlapping(bounds, |part, _| visitor(part))
    }

    /// Passes every part whose box a ray meets to `visitor`, each once and roughly in the order of meeting, up to a
    /// limit that `visitor` may lower: it returns the new one.
    ///
    /// The ray is given in the compound's axes, in metres, and the limit in lengths of its direction. Boxes are widened
    /// by `grown` metres, and by more than rounding, so that none is missed. If any number is not finite, nothing is
    /// met. Cost: as [`visit_near`](Self::visit_near).
    ///
    /// ```
    /// use asunder::{Compound3, Pose3, Shape3, Sphere, glam::{DVec3, Vec3}};
    /// let ball: Shape3 = Sphere::new(0.5)?.into();
    /// let row = Compound3::new([(Pose3::at(Vec3::ZERO)?, ball.clone()), (Pose3::at(Vec3::X * 2.0)?, ball)])?;
    /// let mut met = vec![];
    /// row.visit_along(DVec3::new(5.0, 0.1, 0.1), DVec3::NEG_X, 0.0, 10.0, |part| {
    ///     met.push(part);
    ///     3.0
    /// });
    /// assert_eq!(met, [1], "the other is beyond the limit by then");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_along(
        &self,
        from: DVec3,
        direction: DVec3,
        grown: f32,
        limit: f64,
        mut visitor: impl FnMut(u32) -> f64,
    ) {
        if let Some(line) = Line::new(from, direction, Vec3::splat(grown)) {
            self.data.tree.visit_in_order(&line, limit, |part, _| visitor(part));
        }
    }

    /// Passes every part whose box is within `limit` metres of `bounds`, in the compound's axes, to `visitor`, each
    /// once and roughly the nearest first, up to a limit that `visitor` may lower: it returns the new one. Cost: as
    /// [`visit_near`](Self::visit_near).
    ///
    /// ```
    /// use asunder::{Aabb3, Compound3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let ball: Shape3 = Sphere::new(0.5)?.into();
    /// let row = Compound3::new([(Pose3::at(Vec3::ZERO)?, ball.clone()), (Pose3::at(Vec3::X * 2.0)?, ball)])?;
    /// let mut near = vec![];
    /// row.visit_nearest(&Aabb3::new(Vec3::splat(5.0), Vec3::splat(6.0)), 10.0, |part| {
    ///     near.push(part);
    ///     10.0
    /// });
    /// assert_eq!(near, [1, 0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_nearest(&self, bounds: &Aabb3, limit: f64, mut visitor: impl FnMut(u32) -> f64) {
        if let Some(near) = Near::new(bounds) {
            self.data.tree.visit_in_order(&near, limit, |part, _| visitor(part));
        }
    }

    /// The centre of the bounding radius: the middle of its box.
    #[inline]
    pub const fn center(&self) -> Vec3 {
        self.center
    }

    /// Bounding radius about [`Compound3::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether any part contains a local point, in metres. Cost: that of the same test for each part whose bounding
    /// sphere contains it; with 16 parts or more a tree skips the others.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        let reach = point.abs() + self.center.abs().as_dvec3();
        let rounding = 64.0 * f64::EPSILON * (reach.element_sum() + f64::from(self.outer_radius));
        let holds = |part: &Part3| {
            // Widened by more than rounding, and by more than a stored rotation may stretch it.
            let outer = f64::from(part.shape.outer_radius()) * (1.0 + 1e-6);
            // Most parts are not near, and need no rotation; NaN is never near.
            let is_near = (point - part.center).length_squared() <= outer * outer + rounding * rounding;
            is_near && part.shape.contains(part.pose.transform_back(point))
        };
        let parts = self.parts();
        if parts.len() < MANY_PARTS {
            return parts.iter().any(holds);
        }
        let (low, high) = (point - DVec3::splat(rounding), point + DVec3::splat(rounding));
        let around = Aabb3::new(low.as_vec3(), high.as_vec3());
        let found = self.visit_near(&around, |index| match parts.get(index as usize).is_some_and(holds) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        });
        found.is_break()
    }

    /// The box around the posed shape, by the vertices of all its parts, grown by `margin` metres and rounded outwards.
    /// Cost: linear in the vertices of the parts that reach out furthest; with 16 parts or more a tree skips the
    /// others.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let box_of = |part: &Part3| part.bounds(pose, margin);
        let parts = self.parts();
        if parts.len() < MANY_PARTS {
            return parts.iter().map(box_of).fold(Aabb3::NOTHING, |all, part| all.union(&part));
        }
        let (basis, place) = (pose.basis(), pose.position());
        let apart = [basis.x.abs(), basis.y.abs(), basis.z.abs()];
        // More than the margins of a part's own box and the rounding of the tree's boxes here.
        let reach = self.center.as_dvec3().length() + f64::from(self.outer_radius);
        let lengths = place.abs().element_sum() + 8.0 * reach + f64::from(margin).abs();
        let grow = f64::from(margin) + 512.0 * f64::EPSILON * lengths;
        let reach_of = |[a, b, c, d, e, f]: Sides| -> Reach {
            let [low, high] = [Vec3::new(a, b, c).as_dvec3(), Vec3::new(d, e, f).as_dvec3()];
            let (middle, half) = (place + basis.turn((low + high) * 0.5), (high - low) * 0.5);
            let half = apart[0] * half.x + apart[1] * half.y + apart[2] * half.z + grow;
            let ([x, y, z], [u, v, w]) = ((half - middle).to_array(), (half + middle).to_array());
            [x, y, z, u, v, w]
        };
        let mut all = Aabb3::NOTHING;
        self.data.tree.visit_outermost(reach_of, |part| {
            all = all.union(&box_of(&parts[part as usize]));
            let ([x, y, z], [u, v, w]) = ((-all.min.as_dvec3()).to_array(), all.max.as_dvec3().to_array());
            [x, y, z, u, v, w]
        });
        all
    }

    /// The box around one part of the posed shape, rounded outwards: it lies within [`bounds`](Self::bounds). `None` if
    /// there is no such part. Cost: linear in the part's vertices.
    ///
    /// ```
    /// use asunder::{Bounds, Compound3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let ball: Shape3 = Sphere::new(0.5)?.into();
    /// let row = Compound3::new([(Pose3::at(Vec3::ZERO)?, ball.clone()), (Pose3::at(Vec3::X * 2.0)?, ball.clone())])?;
    /// let second = row.part_bounds(&Pose3::at(Vec3::Y)?, 1).ok_or("there are two")?;
    /// assert!(second.encloses(&ball.bounds(&Pose3::at(Vec3::X * 2.0 + Vec3::Y)?, 0.0)));
    /// assert!(row.bounds(&Pose3::at(Vec3::Y)?, 0.0).encloses(&second) && second.min.x > 1.49);
    /// assert_eq!(row.part_bounds(&Pose3::IDENTITY, 2), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn part_bounds(&self, pose: &Pose3, part: u32) -> Option<Aabb3> {
        Some(self.parts().get(part as usize)?.bounds(pose, 0.0))
    }

    /// A box that contains the posed shape, by its bounding sphere alone, and so no smaller than
    /// [`bounds`](Self::bounds). Cost: constant.
    ///
    /// ```
    /// use asunder::{Bounds, Compound3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let ball: Shape3 = Sphere::new(0.5)?.into();
    /// let row = Compound3::new([(Pose3::at(Vec3::ZERO)?, ball.clone()), (Pose3::at(Vec3::X * 2.0)?, ball)])?;
    /// let pose = Pose3::at(Vec3::Y)?;
    /// assert!(row.bounds_at_once(&pose).encloses(&row.bounds(&pose, 0.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bounds_at_once(&self, pose: &Pose3) -> Aabb3 {
        // A rotation's length is one only up to the rounding of f32; and the rounding of parts' positions may matter,
        // as in `bounds`.
        let reach = self.center.as_dvec3().length() + f64::from(self.outer_radius);
        let lost = 4.0 * f64::from(f32::EPSILON) * reach;
        around3(core::iter::once(self.center.as_dvec3()), pose, f64::from(self.outer_radius) + lost)
    }
}

impl PartialEq for Compound3 {
    /// Equal parts and poses in the same order; everything else follows from them.
    fn eq(&self, other: &Self) -> bool {
        self.parts() == other.parts()
    }
}
