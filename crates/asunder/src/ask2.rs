//! Queries to a world in the plane, in plain types.

mod along;

use crate::query::{
    Asked, Filter2, Met, NearAnswer2, bodies_near, bodies_over, boxes_over, manifolds, visit_manifolds,
};
use crate::space::{BodyKey2, Plane};
use crate::world::World;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Pose2, Shape2};
use asunder_narrow::Manifold2;
use core::ops::ControlFlow;

/// # Queries
/// Queries see bodies at their current poses, even before the next update. Any number of threads may query at once. A
/// [`Filter2`] decides which bodies a query may find.
///
/// - Lists are cleared first, and sorted by distance, then by the bodies' slots (lists without distances, by slots).
/// - Visitors receive answers in no promised order, until they break off.
///
/// Cost: the first query builds a tree of all boxes, in 50 to 120 ns per body, which is kept while few bodies move. For
/// those that have moved since, the first query after an update builds a second tree. Each query then traverses both
/// trees, and runs the narrow phase for every body whose box is met. Once memory has grown to its full size, only the
/// caller's lists allocate.
impl World<Plane> {
    /// Bodies whose boxes overlap a box, whatever their shapes: the quick and coarse test for bodies in a region. A
    /// body's box is the one around its shape at its current pose, rounded outwards to f32, without its margin: far from
    /// the origin it is larger by metres (guide: units).
    ///
    /// ```
    /// use asunder::{Aabb2, Circle, Collider2, Filter2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let ball = world.insert(Collider2::new(Circle::new(1.0)?));
    /// let corner = Aabb2::new(Vec2::splat(0.9), Vec2::splat(2.0));
    /// let mut found = vec![];
    /// world.boxes_overlapping(&corner, &Filter2::new(), &mut found);
    /// assert_eq!(found, [ball], "the ball's box reaches there, the ball does not");
    /// # Ok::<(), asunder::RadiusError>(())
    /// ```
    pub fn boxes_overlapping(&self, bounds: &Aabb2, filter: &Filter2<'_>, into: &mut Vec<BodyKey2>) {
        boxes_over(self, bounds, filter).keys(into);
    }

    /// Like [`World::boxes_overlapping`], but one by one, in no promised order.
    ///
    /// ```
    /// use asunder::{Aabb2, Circle, Collider2, Filter2, Pose2, World2, glam::Vec2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let region = Aabb2::new(Vec2::ZERO, Vec2::splat(9.0));
    /// let mut found = vec![];
    /// let _ = world.visit_boxes_overlapping(&region, &Filter2::new(), |body| {
    ///     found.push(body);
    ///     ControlFlow::Continue(())
    /// });
    /// found.sort();
    /// assert_eq!(found, [near, far]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_boxes_overlapping(
        &self,
        bounds: &Aabb2,
        filter: &Filter2<'_>,
        mut visitor: impl FnMut(BodyKey2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        boxes_over(self, bounds, filter).visit(|Met(body)| visitor(body))
    }

    /// Bodies that contain a point, in metres; the surface counts. Exact. No body contains a point that is not finite,
    /// or beyond 1e9 m on an axis.
    ///
    /// ```
    /// use asunder::{Collider2, Filter2, Rect, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let unit = world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?));
    /// let mut found = vec![];
    /// world.overlapping_point(Vec2::ONE, &Filter2::new(), &mut found);
    /// assert_eq!(found, [unit], "a corner");
    /// world.overlapping_point([1.0 + f64::EPSILON, 0.0], &Filter2::new(), &mut found);
    /// assert_eq!(found, []);
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    pub fn overlapping_point(&self, point: impl Into<DVec2>, filter: &Filter2<'_>, into: &mut Vec<BodyKey2>) {
        into.clear();
        if let Some((shape, pose)) = Plane::point(point.into()) {
            self.overlapping((&shape, &pose), filter, into);
        }
    }

    /// Like [`World::overlapping_point`], but one by one, in no promised order.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, World2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let mut found = vec![];
    /// let _ = world.visit_overlapping_point([3.5, 0.0], &Filter2::new(), |body| {
    ///     found.push(body);
    ///     ControlFlow::Continue(())
    /// });
    /// found.sort();
    /// assert_eq!(found, [near, far]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_overlapping_point(
        &self,
        point: impl Into<DVec2>,
        filter: &Filter2<'_>,
        mut visitor: impl FnMut(BodyKey2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Some((shape, pose)) = Plane::point(point.into()) else { return ControlFlow::Continue(()) };
        bodies_over(self, (&shape, &pose), filter).visit(|Met(body)| visitor(body))
    }

    /// Bodies that share a point with a posed shape; touching counts. Exact.
    ///
    /// ```
    /// use asunder::{Collider2, Filter2, Pose2, Rect, Shape2, World2, glam::Vec2};
    /// let unit = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
    /// let mut world = World2::new();
    /// let body = world.insert(Collider2::new(unit.clone()));
    /// let mut found = vec![];
    /// world.overlapping((&unit, &Pose2::at([2.0, 0.0])?), &Filter2::new(), &mut found);
    /// assert_eq!(found, [body], "they share a side");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn overlapping(&self, at: (&Shape2, &Pose2), filter: &Filter2<'_>, into: &mut Vec<BodyKey2>) {
        bodies_over(self, at, filter).keys(into);
    }

    /// Like [`World::overlapping`], but one by one, in no promised order.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let dot = Shape2::from(Circle::new(0.5)?);
    /// let at = Pose2::at([3.5, 0.0])?;
    /// let mut found = vec![];
    /// let _ = world.visit_overlapping((&dot, &at), &Filter2::new(), |body| {
    ///     found.push(body);
    ///     ControlFlow::Continue(())
    /// });
    /// found.sort();
    /// assert_eq!(found, [near, far]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_overlapping(
        &self,
        at: (&Shape2, &Pose2),
        filter: &Filter2<'_>,
        mut visitor: impl FnMut(BodyKey2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        bodies_over(self, at, filter).visit(|Met(body)| visitor(body))
    }

    /// The manifolds of a posed shape with the bodies of the world, as a body there would have them. For placing
    /// something, for moving a body that is in no world, and for one that has been moved since the last update (leave
    /// it out by the filter); the contacts of that update are in [`World::contacts`].
    ///
    /// - There is one manifold for each pair of convex parts, on ground one for each normal, at most `margin` metres
    ///   apart; a NaN counts as a margin of 0.
    /// - Each comes with its body: by slot, then in the order of [`Pair2::manifolds`](crate::Pair2::manifolds).
    /// - Normals point from the shape to the body; `a` is the shape, and `b` the body.
    /// - Sensors are found, unless the filter leaves them out.
    ///
    /// ```
    /// use asunder::{Collider2, Filter2, Pose2, Rect, Shape2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let floor = world.insert(Collider2::new(Rect::from_half_extents(Vec2::new(9.0, 0.5))?).fixed());
    /// let (unit, at) = (Shape2::from(Rect::from_half_extents(Vec2::splat(0.5))?), Pose2::at([0.0, 0.75])?);
    /// let mut found = vec![];
    /// world.manifolds((&unit, &at), 0.0, &Filter2::new(), &mut found);
    /// let [(body, manifold)] = &found[..] else { return Err("it stands in the floor".into()) };
    /// assert_eq!((*body, manifold.normal, manifold.points.len()), (floor, Vec2::NEG_Y, 2));
    /// assert!((f64::from(manifold.separation) + 0.25).abs() <= f64::from(manifold.error));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn manifolds(
        &self,
        at: (&Shape2, &Pose2),
        margin: f32,
        filter: &Filter2<'_>,
        into: &mut Vec<(BodyKey2, Manifold2)>,
    ) {
        manifolds((self, filter), at, margin, into);
    }

    /// Like [`World::manifolds`], but one by one: those of one body together and in order, bodies in no promised order.
    /// Nothing is copied.
    ///
    /// ```
    /// use asunder::{Collider2, Filter2, Pose2, Rect, Shape2, World2, glam::Vec2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// world.insert(Collider2::new(Rect::from_half_extents(Vec2::new(9.0, 0.5))?).fixed());
    /// let (unit, at) = (Shape2::from(Rect::from_half_extents(Vec2::splat(0.5))?), Pose2::at([0.0, 1.125])?);
    /// let mut gap = f32::INFINITY;
    /// let _ = world.visit_manifolds((&unit, &at), 0.25, &Filter2::new(), |_, manifold| {
    ///     gap = gap.min(manifold.separation);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(gap, 0.125);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_manifolds(
        &self,
        at: (&Shape2, &Pose2),
        margin: f32,
        filter: &Filter2<'_>,
        visitor: impl FnMut(BodyKey2, &Manifold2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        visit_manifolds((self, filter), at, margin, visitor)
    }

    /// The body closest to a point, and the closest point on it, if that is within a distance (all in metres). Among
    /// bodies equally near, the one in the lowest slot is found. A body that contains the point is at distance 0.
    ///
    /// A `within` that is NaN counts as no limit, and a negative one as zero. No body is found for a point that is not
    /// finite, or beyond 1e9 m on an axis.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, World2, glam::DVec2};
    /// let mut world = World2::new();
    /// let ball = world.insert(Collider2::new(Circle::new(1.0)?).at(Pose2::at([4.0, 0.0])?));
    /// let near = world.closest(DVec2::ZERO, 10.0, &Filter2::new()).ok_or("it is near")?;
    /// assert_eq!((near.body, near.distance, near.point), (ball, 3.0, DVec2::X * 3.0));
    /// assert!(world.closest(DVec2::ZERO, 2.0, &Filter2::new()).is_none());
    /// let inside = world.closest(DVec2::X * 4.5, 2.0, &Filter2::new()).ok_or("it is inside")?;
    /// assert_eq!((inside.overlapping, inside.distance), (true, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn closest(&self, point: impl Into<DVec2>, within: f32, filter: &Filter2<'_>) -> Option<NearAnswer2> {
        let (shape, pose) = Plane::point(point.into())?;
        self.closest_to_shape((&shape, &pose), within, filter)
    }

    /// All bodies within a distance of a point, each reported as [`World::closest`] reports the first.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, World2, glam::DVec2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let mut found = vec![];
    /// world.within(DVec2::ZERO, 2.5, &Filter2::new(), &mut found);
    /// assert!(found.iter().map(|answer| answer.body).eq([near]), "the other is 3 m away");
    /// world.within(DVec2::ZERO, 3.5, &Filter2::new(), &mut found);
    /// assert!(found.iter().map(|answer| answer.body).eq([near, far]), "by distance");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn within(
        &self,
        point: impl Into<DVec2>,
        within: f32,
        filter: &Filter2<'_>,
        into: &mut Vec<NearAnswer2>,
    ) {
        into.clear();
        if let Some((shape, pose)) = Plane::point(point.into()) {
            self.within_shape((&shape, &pose), within, filter, into);
        }
    }

    /// Like [`World::within`], but one by one, in no promised order.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, World2, glam::DVec2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let mut nearest = f64::INFINITY;
    /// let _ = world.visit_within(DVec2::ZERO, 10.0, &Filter2::new(), |answer| {
    ///     nearest = nearest.min(answer.distance);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(nearest, 2.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_within(
        &self,
        point: impl Into<DVec2>,
        within: f32,
        filter: &Filter2<'_>,
        visitor: impl FnMut(NearAnswer2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Some((shape, pose)) = Plane::point(point.into()) else { return ControlFlow::Continue(()) };
        bodies_near(self, (&shape, &pose), within, filter).visit(visitor)
    }

    /// The body closest to a posed shape, and the closest points of both, if they are within a distance, in metres.
    /// Among bodies equally near, the one in the lowest slot is found. A body that overlaps the shape is at distance 0.
    ///
    /// A `within` that is NaN counts as no limit, and a negative one as zero.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2, glam::DVec2};
    /// let ball = Shape2::from(Circle::new(1.0)?);
    /// let mut world = World2::new();
    /// let body = world.insert(Collider2::new(ball.clone()).at(Pose2::at([4.0, 0.0])?));
    /// let near = world.closest_to_shape((&ball, &Pose2::IDENTITY), 10.0, &Filter2::new()).ok_or("it is near")?;
    /// assert_eq!((near.body, near.distance), (body, 2.0));
    /// assert_eq!((near.from, near.point), (DVec2::X, DVec2::X * 3.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn closest_to_shape(
        &self,
        at: (&Shape2, &Pose2),
        within: f32,
        filter: &Filter2<'_>,
    ) -> Option<NearAnswer2> {
        bodies_near(self, at, within, filter).first()
    }

    /// All bodies within a distance of a posed shape, each reported as [`World::closest_to_shape`] reports the first.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let dot = Shape2::from(Circle::new(0.5)?);
    /// let mut found = vec![];
    /// world.within_shape((&dot, &Pose2::IDENTITY), 2.0, &Filter2::new(), &mut found);
    /// assert!(found.iter().map(|answer| answer.body).eq([near]), "1.5 m away, and the other 2.5 m");
    /// assert_eq!((found[0].distance, found[0].overlapping), (1.5, false));
    /// world.within_shape((&dot, &Pose2::IDENTITY), 3.0, &Filter2::new(), &mut found);
    /// assert!(found.iter().map(|answer| answer.body).eq([near, far]), "by distance");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn within_shape(
        &self,
        at: (&Shape2, &Pose2),
        within: f32,
        filter: &Filter2<'_>,
        into: &mut Vec<NearAnswer2>,
    ) {
        bodies_near(self, at, within, filter).all(into);
    }

    /// Like [`World::within_shape`], but one by one, in no promised order.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let dot = Shape2::from(Circle::new(0.5)?);
    /// let mut nearest = f64::INFINITY;
    /// let _ = world.visit_within_shape((&dot, &Pose2::IDENTITY), 10.0, &Filter2::new(), |answer| {
    ///     nearest = nearest.min(answer.distance);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(nearest, 1.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_within_shape(
        &self,
        at: (&Shape2, &Pose2),
        within: f32,
        filter: &Filter2<'_>,
        visitor: impl FnMut(NearAnswer2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        bodies_near(self, at, within, filter).visit(visitor)
    }
}
