//! Casts in the plane: rays and moved shapes.

use crate::query::{CastAnswer2, Filter2, RayAnswer2, bodies_along, bodies_along_ray, first_ahead, is_clear};
use crate::space::Plane;
use crate::world::World;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Pose2, Ray2, Shape2};
use core::ops::ControlFlow;

/// # Casts
/// The bodies that rays and moved shapes meet. Order, filters, threads and costs are those of the other queries, above.
impl World<Plane> {
    /// The first body that a ray meets, no later than at `limit`.
    ///
    /// The limit is in lengths of the ray's direction and may be infinite; a NaN counts as no limit, and a negative
    /// limit as zero. A body in which the ray starts is met at 0. Among bodies met at the same distance, the one in the
    /// lowest slot is found.
    ///
    /// Cost: it tests bodies in the order in which the ray meets their boxes, and none behind the first hit.
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

    /// All bodies that a ray meets, each reported as [`World::cast_ray`] reports the first. No body stops the ray.
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

    /// Like [`World::cast_ray_all`], but one by one, in no promised order. To find out whether anything is in the way,
    /// break off at the first answer, or use [`World::is_clear_between`].
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

    /// Whether nothing is between two points, in metres: the question for a line of sight. A body that contains one of
    /// the points counts: leave out those of the two who look at each other. For two equal points, it answers whether
    /// no body contains them. False where a point is not finite, or `from` more than 1e9 m out on an axis. The direction
    /// is rounded to f32, as by [`Ray2::between`]: the view ends up to 1e-7 of its length beside `to`.
    ///
    /// Cost: less than [`World::cast_ray`] where something is in between, since any body will do.
    ///
    /// ```
    /// use asunder::{Circle, Collider2, Filter2, Pose2, World2};
    /// let mut world = World2::new();
    /// let body = Collider2::new(Circle::new(0.5)?);
    /// let both = [0.0, 9.0].map(|x| world.insert(body.clone().at(Pose2::at([x, 0.0]).unwrap_or_default())));
    /// let [eye, head] = [[0.0, 0.0], [9.0, 0.0]];
    /// let others = Filter2::new().without_all(&both);
    /// assert!(world.is_clear_between(eye, head, &others) && !world.is_clear_between(eye, head, &Filter2::new()));
    /// world.insert(body.at(Pose2::at([5.0, 0.0])?));
    /// assert!(!world.is_clear_between(eye, head, &others));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_clear_between(
        &self,
        from: impl Into<DVec2>,
        to: impl Into<DVec2>,
        filter: &Filter2<'_>,
    ) -> bool {
        let (from, to) = (from.into(), to.into());
        is_clear((self, filter), Ray2::between(from, to), from)
    }

    /// The first body that a posed shape meets while it is moved by a displacement, in metres, without turning. Among
    /// bodies met at the same time, the one in the lowest slot is found. A body that the shape already touches is met
    /// at fraction 0.
    ///
    /// - With a displacement of zero it finds a body that the shape overlaps, except one-sided ground that the shape is
    ///   behind; with one that is not finite it finds none.
    /// - To slide on along the surface that was met, keep a skin of a tenth of a millimetre: normals are f32, so a
    ///   velocity from which its part along the normal was removed still points slightly into the surface.
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

    /// The next body that a moved shape runs into: like [`World::cast_shape`], but parts that the shape touches at the
    /// start are passed over, even if the displacement leads into them. So a ball on a floor finds the wall, even where
    /// both are one body.
    ///
    /// - Parts that are flush with a touched one are passed over, too: by the rule of
    ///   [`Pair2::next_impact`](crate::Pair2::next_impact), and for other bodies, like the tiles of a floor, by that of
    ///   [`next_impact_beside`](crate::Pair2::next_impact_beside).
    /// - A displacement that is zero or not finite gives `None`.
    /// - A [bullet](crate::Collider2::bullet) with this displacement as its motion gets the same answer, but not bit
    ///   for bit. Both stop a little before the shapes touch, within the error that [`Pair2::cast`](crate::Pair2::cast)
    ///   states; where the shape meets a surface at a grazing angle, that gap is a longer path, and the fractions
    ///   differ by as much.
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

    /// All bodies that a moved shape meets, each reported as [`World::cast_shape`] reports the first.
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

    /// Like [`World::cast_shape_all`], but one by one, in no promised order.
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
