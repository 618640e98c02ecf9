//! Queries to a world in the plane, in plain types.

use crate::query::{
    Asked, CastAnswer2, Filter2, Met, NearAnswer2, RayAnswer2, bodies_along, bodies_along_ray, bodies_near,
    bodies_over, boxes_over, first_ahead,
};
use crate::space::{BodyKey2, Plane};
use crate::world::World;

use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Aabb2, Pose2, Ray2, Shape2};
use core::ops::ControlFlow;

/// # Queries
/// Queries see bodies where they are, also before the next update. Any number of threads may ask at once. What
/// comes in a list is sorted by distance, then by the bodies' slots (lists without distances by slots), and lists
/// are cleared first; visitors get answers in no promised order, until they break off. A [`Filter2`] says which bodies a
/// query may find.
///
/// Cost: the first query makes a tree of all boxes, in 50 to 120 ns per body, and it is kept while few bodies move; of
/// those that have moved since, a second one is made by the first query after an update. Then, a query takes
/// a walk down both trees, and the narrow phase of every body whose box is met. Once memory is there, nothing
/// allocates but the caller's lists.
impl World<Plane> {
    /// Bodies whose boxes overlap a box, whatever their shapes: the quick and coarse way to ask what is in a
    /// region. A body's box is that around its shape as it stands, rounded outwards, without its margin.
    ///
    /// ```
    /// use asunder::{Aabb2, Motion2, Ray2, Circle, Collider2, Filter2, World2, glam::Vec2};
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

    /// [`World::boxes_overlapping`], one by one in no promised order.
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

    /// Bodies that hold a point, in metres; the surface counts. Exact. None hold a point that is not finite, or
    /// beyond 1e9 m on an axis.
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

    /// [`World::overlapping_point`], one by one in no promised order.
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

    /// [`World::overlapping`], one by one in no promised order.
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

    /// The body closest to a point, and the closest point on it, if that is within a distance (all in metres); of bodies
    /// equally near, the one in the lowest slot. A body that contains the point is at distance 0.
    ///
    /// A NaN counts as no limit, and a negative distance as zero. Nothing is near a point that is not finite, or
    /// beyond 1e9 m on an axis.
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

    /// All bodies within a distance of a point, as [`World::closest`] tells of the first.
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

    /// [`World::within`], one by one in no promised order.
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

    /// The body closest to a posed shape, and the closest points of both, if one is within a distance; of bodies
    /// equally near, that of the lowest slot. One that overlaps the shape is at distance 0.
    ///
    /// A NaN counts as no limit, and a negative distance as zero.
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

    /// All bodies within a distance of a posed shape, as [`World::closest_to_shape`] tells of the first.
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

    /// [`World::within_shape`], one by one in no promised order.
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

    /// The first body that a ray meets no later than at `limit`, which is in lengths of its direction and may be
    /// infinite; of bodies met at the same distance, that of the lowest slot. A body that the ray starts in is met
    /// at 0.
    ///
    /// A NaN counts as no limit, and a negative limit as zero. Looks at bodies in order of their boxes, and at none
    /// behind the first.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Ray2, World2, glam::{DVec2, Vec2}};
    /// let mut world = World2::new();
    /// let ball = world.insert(Collider2::new(Circle::new(1.0)?).at(Pose2::at(DVec2::X * 4.0)?));
    /// let ray = Ray2::new(DVec2::ZERO, Vec2::X * 2.0)?;
    /// let hit = world.cast_ray(&ray, f64::INFINITY, &Filter2::new()).ok_or("it is in the way")?;
    /// assert_eq!((hit.body, hit.normal), (ball, Vec2::NEG_X));
    /// assert!((hit.distance - 1.5).abs() < 1e-6 && hit.point.distance(DVec2::X * 3.0) < 1e-6);
    /// assert!(world.cast_ray(&ray, 1.0, &Filter2::new()).is_none(), "one length of the direction is two metres");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_ray(&self, ray: &Ray2, limit: f64, filter: &Filter2<'_>) -> Option<RayAnswer2> {
        bodies_along_ray(self, ray, limit, filter).first()
    }

    /// All bodies that a ray meets, as [`World::cast_ray`] tells of the first: through all that is in the way.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Ray2, World2, glam::DVec2, glam::Vec2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let ray = Ray2::new(DVec2::ZERO, Vec2::X)?;
    /// let mut hits = vec![];
    /// world.cast_ray_all(&ray, 10.0, &Filter2::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near, far]), "through all, by distance");
    /// world.cast_ray_all(&ray, 2.5, &Filter2::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near]), "the other begins at 3 m");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_ray_all(&self, ray: &Ray2, limit: f64, filter: &Filter2<'_>, into: &mut Vec<RayAnswer2>) {
        bodies_along_ray(self, ray, limit, filter).all(into);
    }

    /// [`World::cast_ray_all`], one by one in no promised order: to know whether anything is in the way, break off
    /// at once.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Ray2, World2, glam::{DVec2, Vec2}};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// world.insert(Collider2::new(Circle::new(1.0)?).at(Pose2::at(DVec2::X * 4.0)?));
    /// let sight = Ray2::new(DVec2::ZERO, Vec2::X * 10.0)?;
    /// let is_free = world.visit_ray(&sight, 1.0, &Filter2::new(), |_| ControlFlow::Break(())).is_continue();
    /// assert!(!is_free);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_ray(
        &self,
        ray: &Ray2,
        limit: f64,
        filter: &Filter2<'_>,
        visitor: impl FnMut(RayAnswer2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        bodies_along_ray(self, ray, limit, filter).visit(visitor)
    }

    /// The first body that a posed shape meets while it is moved by a displacement, in metres, without turning; of
    /// bodies met at the same time, that of the lowest slot. One that it touches already is met at fraction 0.
    ///
    /// A displacement of zero meets what the shape overlaps, except one-sided ground that it is behind; one that is not
    /// finite meets nothing. To slide on along what was met, keep a skin of a tenth of a millimetre: normals are f32, so a
    /// velocity from which the normal was removed still points slightly into the surface.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2, glam::{DVec2, Vec2}};
    /// let ball = Shape2::from(Circle::new(1.0)?);
    /// let mut world = World2::new();
    /// let body = world.insert(Collider2::new(ball.clone()).at(Pose2::at(DVec2::X * 4.0)?));
    /// let from = (&ball, &Pose2::IDENTITY);
    /// let hit = world.cast_shape(from, Vec2::X * 4.0, &Filter2::new()).ok_or("it is in the way")?;
    /// assert_eq!((hit.body, hit.overlapping), (body, false));
    /// assert!(hit.fraction <= 0.5 && hit.fraction > 0.499_99 && hit.point.distance(DVec2::X * 3.0) < 1e-4);
    /// assert!(world.cast_shape(from, Vec2::X * 1.9, &Filter2::new()).is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_shape(
        &self,
        from: (&Shape2, &Pose2),
        displacement: Vec2,
        filter: &Filter2<'_>,
    ) -> Option<CastAnswer2> {
        bodies_along(self, from, displacement, filter).first()
    }

    /// What a moved shape runs into next: like [`World::cast_shape`], but what it touches at the start is passed over, even if
    /// the displacement leads into it. So a ball on a floor finds the wall, even where both are one body. Whatever is level
    /// with what is touched is passed over, too: by the rule of [`Pair2::next_impact`](crate::Pair2::next_impact), and for
    /// other bodies, like the tiles of a floor, by that of [`next_impact_beside`](crate::Pair2::next_impact_beside). A
    /// displacement of zero, or that is not finite, leads into nothing: `None`.
    ///
    /// ```
    /// use asunder::{Chain, Circle, Collider2, Filter2, Pose2, Shape2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let level = [[-9.0, 4.0], [-9.0, 0.0], [9.0, 0.0], [9.0, 4.0]].map(Vec2::from);
    /// let level = world.insert(Collider2::new(Chain::open(level)?));
    /// let (ball, on_floor) = (Shape2::from(Circle::new(1.0)?), Pose2::at([0.0, 1.0])?);
    /// let from = (&ball, &on_floor);
    /// assert!(world.cast_shape(from, Vec2::X * 16.0, &Filter2::new()).is_some_and(|hit| hit.overlapping), "the floor");
    /// let hit = world.cast_shape_onwards(from, Vec2::X * 16.0, &Filter2::new()).ok_or("the wall")?;
    /// assert!(hit.body == level && hit.fraction <= 0.5 && hit.fraction > 0.499_99 && hit.normal.x > 0.999);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_shape_onwards(
        &self,
        from: (&Shape2, &Pose2),
        displacement: Vec2,
        filter: &Filter2<'_>,
    ) -> Option<CastAnswer2> {
        first_ahead(self, from, displacement, filter)
    }

    /// All bodies that a moved shape meets, as [`World::cast_shape`] tells of the first.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let dot = Shape2::from(Circle::new(0.5)?);
    /// let mut hits = vec![];
    /// world.cast_shape_all((&dot, &Pose2::IDENTITY), Vec2::X * 2.0, &Filter2::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near]));
    /// world.cast_shape_all((&dot, &Pose2::IDENTITY), Vec2::X * 4.0, &Filter2::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near, far]), "by the share of the way");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_shape_all(
        &self,
        from: (&Shape2, &Pose2),
        displacement: Vec2,
        filter: &Filter2<'_>,
        into: &mut Vec<CastAnswer2>,
    ) {
        bodies_along(self, from, displacement, filter).all(into);
    }

    /// [`World::cast_shape_all`], one by one in no promised order.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, Shape2, World2, glam::Vec2};
    /// use std::ops::ControlFlow;
    /// let mut world = World2::new();
    /// let ball = Collider2::new(Circle::new(1.0)?);
    /// world.insert(ball.clone().at(Pose2::at([3.0, 0.0])?));
    /// world.insert(ball.at(Pose2::at([4.0, 0.0])?));
    /// let dot = Shape2::from(Circle::new(0.5)?);
    /// let way = Vec2::X * 4.0;
    /// let is_free = world
    ///     .visit_cast_shape((&dot, &Pose2::IDENTITY), way, &Filter2::new(), |_| ControlFlow::Break(()))
    ///     .is_continue();
    /// assert!(!is_free);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_cast_shape(
        &self,
        from: (&Shape2, &Pose2),
        displacement: Vec2,
        filter: &Filter2<'_>,
        visitor: impl FnMut(CastAnswer2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        bodies_along(self, from, displacement, filter).visit(visitor)
    }
}
