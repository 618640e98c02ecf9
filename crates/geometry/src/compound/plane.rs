//! Several convex parts in the plane under one collider.

use super::{CompoundError, MANY_PARTS, tree_of};
use crate::aabb::{Aabb2, Aabb3, Bounds};
use crate::ground::tree::{Line, Near, Reach, Sides, Tree};
use crate::outward::{around2, round_up};
use crate::pose2::Pose2;
use crate::shape::Shape2;
use crate::tolerance::{MAX_PARTS, MAX_RADIUS};
use core::ops::ControlFlow;
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;

/// Several convex parts in the plane, each posed, that move as one. Clones share the data.
///
#[doc = include_str!("../../doc/compound2.svg")]
///
/// It is the union of its parts, which may overlap; parts of one body do not collide with each other. Each pair of
/// touching parts of two bodies has a manifold of its own. The separation from another shape is the least of its
/// parts'.
///
/// Cost of a pair: a bounding circle test for each pair of parts, and the cost of the pairs that pass. With 16 parts or
/// more, which are looked up in a tree: logarithmic in their number for each part of the other, and the cost of the
/// parts nearby.
///
/// ```
/// use asunder::{Circle, Compound2, Pose2, Rect, Shape2, glam::{DVec2, Vec2}};
/// let head: Shape2 = Circle::new(0.4)?.into();
/// let body: Shape2 = Rect::from_half_extents(Vec2::new(0.1, 1.0))?.into();
/// let hammer = Compound2::new([(Pose2::at([0.0, 1.0])?, head), (Pose2::IDENTITY, body)])?;
/// assert_eq!(hammer.parts().len(), 2);
/// assert!(hammer.contains(DVec2::new(0.0, 1.4)) && !hammer.contains(DVec2::X));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Compound2 {
    data: Arc<Data2>,
    center: Vec2,
    outer_radius: f32,
}

struct Data2 {
    parts: Box<[Part2]>,
    /// The boxes of the parts, flat, in the compound's axes.
    tree: Tree,
}

/// A part of a compound in the plane.
///
/// ```
/// use asunder::{Circle, Compound2, Pose2, Shape2};
/// let ball: Shape2 = Circle::new(1.0)?.into();
/// let part = &Compound2::new([(Pose2::IDENTITY, ball.clone())])?.parts()[0].clone();
/// assert_eq!((part.pose(), part.shape()), (&Pose2::IDENTITY, &ball));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Part2 {
    pose: Pose2,
    shape: Shape2,
    center: DVec2,
}

impl Part2 {
    fn new(pose: Pose2, shape: Shape2) -> Self {
        let center = pose.transform(shape.center());
        Self { pose, shape, center }
    }

    /// The pose of the part in the compound.
    #[inline]
    pub const fn pose(&self) -> &Pose2 {
        &self.pose
    }

    /// The shape of the part, convex and bounded.
    #[inline]
    pub const fn shape(&self) -> &Shape2 {
        &self.shape
    }

    /// Centre of its bounding circle, in the compound's axes.
    #[inline]
    pub const fn center(&self) -> DVec2 {
        self.center
    }

    /// Whether it contains a point in the compound's axes. Its stored rotation stretches the core by its length, which is
    /// one up to f32 rounding, and not the radius.
    fn contains(&self, point: DVec2) -> bool {
        let (local, rotation) = (self.pose.transform_back(point), self.pose.rotation());
        let length = DVec2::new(rotation.cos().into(), rotation.sin().into()).length();
        let radius = f64::from(self.shape.radius()) / length;
        match &self.shape {
            Shape2::Circle(circle) => circle.contains_within(local, radius),
            Shape2::Capsule(capsule) => capsule.contains_within(local, radius),
            Shape2::Rect(rect) => rect.contains_within(local, radius),
            Shape2::Polygon(polygon) => polygon.contains_within(local, radius),
            shape => shape.contains(local),
        }
    }

    /// The box around the part, where the compound is at this pose.
    fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let core = self.shape.core();
        let points = core.vertices().iter().map(|&vertex| self.pose.transform(vertex));
        // The position of a part far from the compound's origin was rounded accordingly, and the pose may bring the
        // part back near the world's origin, where that rounding matters.
        let lost =
            64.0 * f64::EPSILON * (self.pose.position().length() + f64::from(self.shape.outer_radius()));
        around2(points, pose, f64::from(margin) + f64::from(self.shape.radius()) + lost)
    }
}

impl Compound2 {
    /// A compound from its parts and their poses.
    ///
    /// # Errors
    /// No parts, or more than [`MAX_PARTS`]; a part that is a compound, ground or unbounded, or that reaches beyond
    /// 1e6 m.
    pub fn new(parts: impl IntoIterator<Item = (Pose2, Shape2)>) -> Result<Self, CompoundError> {
        Self::of(parts.into_iter().map(|(pose, shape)| Part2::new(pose, shape)).collect())
    }

    fn of(parts: Box<[Part2]>) -> Result<Self, CompoundError> {
        if parts.is_empty() {
            return Err(CompoundError::NoParts);
        }
        if parts.len() > MAX_PARTS {
            return Err(CompoundError::TooManyParts { count: parts.len() });
        }
        let mut boxes = Vec::with_capacity(parts.len());
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for (index, part) in parts.iter().enumerate() {
            match part.shape {
                Shape2::Compound(_) => return Err(CompoundError::Nested { index }),
                Shape2::HalfPlane(_) => return Err(CompoundError::Unbounded { index }),
                Shape2::Chain(_) => return Err(CompoundError::Ground { index }),
                _ => {}
            }
            let radius = f64::from(part.shape.outer_radius());
            if part.center().length() + radius > f64::from(MAX_RADIUS) {
                return Err(CompoundError::TooLarge { index });
            }
            let bounds = part.shape.bounds(&part.pose, 0.0);
            (low, high) = (low.min(bounds.min.as_dvec2()), high.max(bounds.max.as_dvec2()));
            boxes.push(flat(&bounds));
        }
        let center = ((low + high) * 0.5).as_vec2();
        let reach = |part: &Part2| {
            // A stored rotation stretches by its length, which is one up to the rounding of f32.
            let stretched = f64::from(part.shape.outer_radius()) * (1.0 + 2.0 * f64::from(f32::EPSILON));
            (part.center() - center.as_dvec2()).length() + stretched
        };
        let outer = parts.iter().map(reach).fold(0.0, f64::max);
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        let tree = tree_of(&boxes);
        Ok(Self { data: Arc::new(Data2 { parts, tree }), center, outer_radius })
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
    pub fn parts(&self) -> &[Part2] {
        &self.data.parts
    }

    /// Passes every part whose box overlaps `bounds`, in the compound's axes, to `visitor`, each once, until it breaks
    /// off. The order depends only on the compound and the box. Cost: logarithmic in the parts, and linear in those
    /// that are passed.
    ///
    /// ```
    /// use asunder::{Aabb2, Circle, Compound2, Pose2, Shape2, glam::Vec2};
    /// use core::ops::ControlFlow;
    /// let ball: Shape2 = Circle::new(0.5)?.into();
    /// let row = Compound2::new([(Pose2::at([0.0, 0.0])?, ball.clone()), (Pose2::at([2.0, 0.0])?, ball)])?;
    /// let mut near = vec![];
    /// let _ = row.visit_near(&Aabb2::new(Vec2::new(1.0, 0.0), Vec2::new(1.5, 0.0)), |part| {
    ///     near.push(part);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(near, [1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn visit_near(
        &self,
        bounds: &Aabb2,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.data.tree.visit_overlapping(&flat(bounds), |part, _| visitor(part))
    }

    /// Passes every part whose box a ray meets to `visitor`, each once and roughly in the order of meeting, up to a
    /// limit that `visitor` may lower: it returns the new one.
    ///
    /// The ray is given in the compound's axes, in metres, and the limit in lengths of its direction. Boxes are widened
    /// by `grown` metres, and by more than rounding, so that none is missed. If any number is not finite, nothing is
    /// met. Cost: as [`visit_near`](Self::visit_near).
    ///
    /// ```
    /// use asunder::{Circle, Compound2, Pose2, Shape2, glam::DVec2};
    /// let ball: Shape2 = Circle::new(0.5)?.into();
    /// let row = Compound2::new([(Pose2::at([0.0, 0.0])?, ball.clone()), (Pose2::at([2.0, 0.0])?, ball)])?;
    /// let mut met = vec![];
    /// row.visit_along(DVec2::new(5.0, 0.1), DVec2::NEG_X, 0.0, 10.0, |part| {
    ///     met.push(part);
    ///     3.0
    /// });
    /// assert_eq!(met, [1], "the other is beyond the limit by then");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_along(
        &self,
        from: DVec2,
        direction: DVec2,
        grown: f32,
        limit: f64,
        mut visitor: impl FnMut(u32) -> f64,
    ) {
        if let Some(line) = Line::new(from.extend(0.0), direction.extend(0.0), Vec3::splat(grown)) {
            self.data.tree.visit_in_order(&line, limit, |part, _| visitor(part));
        }
    }

    /// Passes every part whose box is within `limit` metres of `bounds`, in the compound's axes, to `visitor`, each
    /// once and roughly the nearest first, up to a limit that `visitor` may lower: it returns the new one. Cost: as
    /// [`visit_near`](Self::visit_near).
    ///
    /// ```
    /// use asunder::{Aabb2, Circle, Compound2, Pose2, Shape2, glam::Vec2};
    /// let ball: Shape2 = Circle::new(0.5)?.into();
    /// let row = Compound2::new([(Pose2::at([0.0, 0.0])?, ball.clone()), (Pose2::at([2.0, 0.0])?, ball)])?;
    /// let mut near = vec![];
    /// row.visit_nearest(&Aabb2::new(Vec2::splat(5.0), Vec2::splat(6.0)), 10.0, |part| {
    ///     near.push(part);
    ///     10.0
    /// });
    /// assert_eq!(near, [1, 0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_nearest(&self, bounds: &Aabb2, limit: f64, mut visitor: impl FnMut(u32) -> f64) {
        if let Some(near) = Near::new(&flat(bounds)) {
            self.data.tree.visit_in_order(&near, limit, |part, _| visitor(part));
        }
    }

    /// The centre of the bounding radius: the middle of its box.
    #[inline]
    pub const fn center(&self) -> Vec2 {
        self.center
    }

    /// Bounding radius about [`Compound2::center`], in metres, rounded up.
    #[inline]
    pub const fn outer_radius(&self) -> f32 {
        self.outer_radius
    }

    /// Whether any part contains a local point, in metres. Cost: that of the same test for each part whose bounding
    /// circle contains it; with 16 parts or more a tree skips the others.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        let point = point.into();
        let reach = point.abs() + self.center.abs().as_dvec2();
        let rounding = 64.0 * f64::EPSILON * (reach.element_sum() + f64::from(self.outer_radius));
        let holds = |part: &Part2| {
            // Widened by more than rounding, and by more than a stored rotation may stretch it.
            let outer = f64::from(part.shape.outer_radius()) * (1.0 + 1e-6);
            // Most parts are not near, and need no rotation; NaN is never near.
            let is_near = (point - part.center).length_squared() <= outer * outer + rounding * rounding;
            is_near && part.contains(point)
        };
        let parts = self.parts();
        if parts.len() < MANY_PARTS {
            return parts.iter().any(holds);
        }
        let (low, high) = (point - DVec2::splat(rounding), point + DVec2::splat(rounding));
        let around = Aabb2::new(low.as_vec2(), high.as_vec2());
        let found = self.visit_near(&around, |index| match parts.get(index as usize).is_some_and(holds) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        });
        found.is_break()
    }

    /// The box around the posed shape, by the vertices of all its parts, grown by `margin` metres and rounded outwards.
    /// Cost: linear in the vertices of the parts that reach out furthest; with 16 parts or more a tree skips the
    /// others.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        let box_of = |part: &Part2| part.bounds(pose, margin);
        let parts = self.parts();
        if parts.len() < MANY_PARTS {
            return parts.iter().map(box_of).fold(Aabb2::NOTHING, |all, part| all.union(&part));
        }
        let (rotation, place) = (pose.rotation(), pose.position());
        let apart = DVec2::new(rotation.cos().into(), rotation.sin().into()).abs();
        // More than the margins of a part's own box and the rounding of the tree's boxes here; and a rotation's length
        // is not quite one, which shrinks the boxes but no radius.
        let reach = self.center.as_dvec2().length() + f64::from(self.outer_radius);
        let lengths = place.abs().element_sum() + 8.0 * reach + f64::from(margin).abs();
        let lost = 512.0 * f64::EPSILON * lengths + reach * (1.0 - apart.length()).abs();
        let grow = f64::from(margin) + lost;
        let reach_of = |[a, b, _, d, e, _]: Sides| -> Reach {
            let [low, high] = [Vec2::new(a, b).as_dvec2(), Vec2::new(d, e).as_dvec2()];
            let (middle, half) = (place + rotation.turn((low + high) * 0.5), (high - low) * 0.5);
            let half = half.x * apart + half.y * DVec2::new(apart.y, apart.x) + grow;
            [half.x - middle.x, half.y - middle.y, 0.0, half.x + middle.x, half.y + middle.y, 0.0]
        };
        let mut all = Aabb2::NOTHING;
        self.data.tree.visit_outermost(reach_of, |part| {
            all = all.union(&box_of(&parts[part as usize]));
            [-f64::from(all.min.x), -f64::from(all.min.y), 0.0, all.max.x.into(), all.max.y.into(), 0.0]
        });
        all
    }

    /// The box around one part of the posed shape, rounded outwards: it lies within [`bounds`](Self::bounds). `None` if
    /// there is no such part. Cost: linear in the part's vertices.
    ///
    /// ```
    /// use asunder::{Bounds, Circle, Compound2, Pose2, Shape2, glam::Vec2};
    /// let ball: Shape2 = Circle::new(0.5)?.into();
    /// let row = Compound2::new([(Pose2::at(Vec2::ZERO)?, ball.clone()), (Pose2::at(Vec2::X * 2.0)?, ball.clone())])?;
    /// let second = row.part_bounds(&Pose2::at(Vec2::Y)?, 1).ok_or("there are two")?;
    /// assert!(second.encloses(&ball.bounds(&Pose2::at(Vec2::X * 2.0 + Vec2::Y)?, 0.0)));
    /// assert!(row.bounds(&Pose2::at(Vec2::Y)?, 0.0).encloses(&second) && second.min.x > 1.49);
    /// assert_eq!(row.part_bounds(&Pose2::IDENTITY, 2), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn part_bounds(&self, pose: &Pose2, part: u32) -> Option<Aabb2> {
        Some(self.parts().get(part as usize)?.bounds(pose, 0.0))
    }

    /// A box that contains the posed shape, by its bounding circle alone, and so no smaller than
    /// [`bounds`](Self::bounds). Cost: constant.
    ///
    /// ```
    /// use asunder::{Bounds, Circle, Compound2, Pose2, Shape2, glam::Vec2};
    /// let ball: Shape2 = Circle::new(0.5)?.into();
    /// let row = Compound2::new([(Pose2::at(Vec2::ZERO)?, ball.clone()), (Pose2::at(Vec2::X * 2.0)?, ball)])?;
    /// let pose = Pose2::at(Vec2::Y)?;
    /// assert!(row.bounds_at_once(&pose).encloses(&row.bounds(&pose, 0.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bounds_at_once(&self, pose: &Pose2) -> Aabb2 {
        // A rotation's length is one only up to the rounding of f32; and the rounding of parts' positions may matter,
        // as in `bounds`.
        let reach = self.center.as_dvec2().length() + f64::from(self.outer_radius);
        let lost = 4.0 * f64::from(f32::EPSILON) * reach;
        around2(core::iter::once(self.center.as_dvec2()), pose, f64::from(self.outer_radius) + lost)
    }
}

impl PartialEq for Compound2 {
    /// Equal parts and poses in the same order; everything else follows from them.
    fn eq(&self, other: &Self) -> bool {
        self.parts() == other.parts()
    }
}

/// A box in the plane as a flat box in space, for the tree.
fn flat(bounds: &Aabb2) -> Aabb3 {
    Aabb3::new(bounds.min.extend(0.0), bounds.max.extend(0.0))
}
