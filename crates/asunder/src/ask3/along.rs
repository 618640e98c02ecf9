//! Casts in space: rays and moved shapes.

use crate::query::{CastAnswer3, Filter3, RayAnswer3, bodies_along, bodies_along_ray, first_ahead, is_clear};
use crate::space::Volume;
use crate::world::World;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Ray3, Shape3};
use core::ops::ControlFlow;

/// # Casts
/// The bodies that rays and moved shapes meet. Order, filters, threads and costs are those of the other queries, above.
impl World<Volume> {
    /// The first body that a ray meets, no later than at `limit`.
    ///
    /// The limit is in lengths of the ray's direction and may be infinite; a NaN counts as no limit, and a negative
    /// limit as zero. A body in which the ray starts is met at 0. Among bodies met at the same distance, the one in the
    /// lowest slot is found.
    ///
    /// Cost: it tests bodies in the order in which the ray meets their boxes, and none behind the first hit.
    ///
    /// ```
    /// use asunder::{Sphere, Collider3, Filter3, Pose3, Ray3, World3, glam::{DVec3, Vec3}};
    /// let mut world = World3::new();
    /// let ball = world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at(DVec3::X * 4.0)?));
    /// let ray = Ray3::new(DVec3::ZERO, Vec3::X * 2.0)?;
    /// let hit = world.cast_ray(&ray, f64::INFINITY, &Filter3::new()).ok_or("it is in the way")?;
    /// assert_eq!((hit.body, hit.normal), (ball, Vec3::NEG_X));
    /// assert!((hit.distance - 1.5).abs() < 1e-6 && hit.point.distance(DVec3::X * 3.0) < 1e-6);
    /// assert!(world.cast_ray(&ray, 1.0, &Filter3::new()).is_none(), "one length of the direction is two metres");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_ray(&self, ray: &Ray3, limit: f64, filter: &Filter3<'_>) -> Option<RayAnswer3> {
        bodies_along_ray(self, ray, limit, filter).first()
    }

    /// All bodies that a ray meets, each reported as [`World::cast_ray`] reports the first. No body stops the ray.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Pose3, Ray3, Sphere, World3, glam::DVec3, glam::Vec3};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose3::at([3.0, 0.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose3::at([4.0, 0.0, 0.0])?));
    /// let ray = Ray3::new(DVec3::ZERO, Vec3::X)?;
    /// let mut hits = vec![];
    /// world.cast_ray_all(&ray, 10.0, &Filter3::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near, far]), "through all, by distance");
    /// world.cast_ray_all(&ray, 2.5, &Filter3::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near]), "the other begins at 3 m");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_ray_all(&self, ray: &Ray3, limit: f64, filter: &Filter3<'_>, into: &mut Vec<RayAnswer3>) {
        bodies_along_ray(self, ray, limit, filter).all(into);
    }

    /// Like [`World::cast_ray_all`], but one by one, in no promised order. To find out whether anything is in the way,
    /// break off at the first answer, or use [`World::is_clear_between`].
    ///
    /// ```
    /// use asunder::{Sphere, Collider3, Filter3, Pose3, Ray3, World3, glam::{DVec3, Vec3}};
    /// use std::ops::ControlFlow;
    /// let mut world = World3::new();
    /// world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at(DVec3::X * 4.0)?));
    /// let sight = Ray3::new(DVec3::ZERO, Vec3::X * 10.0)?;
    /// let is_free = world.visit_ray(&sight, 1.0, &Filter3::new(), |_| ControlFlow::Break(())).is_continue();
    /// assert!(!is_free);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_ray(
        &self,
        ray: &Ray3,
        limit: f64,
        filter: &Filter3<'_>,
        visitor: impl FnMut(RayAnswer3) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        bodies_along_ray(self, ray, limit, filter).visit(visitor)
    }

    /// Whether nothing is between two points, in metres: the question for a line of sight. A body that contains one of
    /// the points counts: leave out those of the two who look at each other. For two equal points, it answers whether
    /// no body contains them. False where a point is not finite, or `from` more than 1e9 m out on an axis. The direction
    /// is rounded to f32, as by [`Ray3::between`]: the view ends up to 1e-7 of its length beside `to`.
    ///
    /// Cost: less than [`World::cast_ray`] where something is in between, since any body will do.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Pose3, Sphere, World3};
    /// let mut world = World3::new();
    /// let body = Collider3::new(Sphere::new(0.5)?);
    /// let both = [0.0, 9.0].map(|x| world.insert(body.clone().at(Pose3::at([x, 0.0, 0.0]).unwrap_or_default())));
    /// let [eye, head] = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0]];
    /// let others = Filter3::new().without_all(&both);
    /// assert!(world.is_clear_between(eye, head, &others) && !world.is_clear_between(eye, head, &Filter3::new()));
    /// world.insert(body.at(Pose3::at([5.0, 0.0, 0.0])?));
    /// assert!(!world.is_clear_between(eye, head, &others));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_clear_between(
        &self,
        from: impl Into<DVec3>,
        to: impl Into<DVec3>,
        filter: &Filter3<'_>,
    ) -> bool {
        let (from, to) = (from.into(), to.into());
        is_clear((self, filter), Ray3::between(from, to), from)
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
    /// use asunder::{Sphere, Collider3, Filter3, Pose3, Shape3, World3, glam::{DVec3, Vec3}};
    /// let ball = Shape3::from(Sphere::new(1.0)?);
    /// let mut world = World3::new();
    /// let body = world.insert(Collider3::new(ball.clone()).at(Pose3::at(DVec3::X * 4.0)?));
    /// let from = (&ball, &Pose3::IDENTITY);
    /// let hit = world.cast_shape(from, Vec3::X * 4.0, &Filter3::new()).ok_or("it is in the way")?;
    /// assert_eq!((hit.body, hit.overlapping), (body, false));
    /// assert!(hit.fraction <= 0.5 && hit.fraction > 0.499_99 && hit.point.distance(DVec3::X * 3.0) < 1e-4);
    /// assert!(world.cast_shape(from, Vec3::X * 1.9, &Filter3::new()).is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_shape(
        &self,
        from: (&Shape3, &Pose3),
        displacement: Vec3,
        filter: &Filter3<'_>,
    ) -> Option<CastAnswer3> {
        bodies_along(self, from, displacement, filter).first()
    }

    /// The next body that a moved shape runs into: like [`World::cast_shape`], but parts that the shape touches at the
    /// start are passed over, even if the displacement leads into them. So a ball on a floor finds the wall, even where
    /// both are one body.
    ///
    /// - Parts that are flush with a touched one are passed over, too: by the rule of
    ///   [`Pair3::next_impact`](crate::Pair3::next_impact), and for other bodies, like the tiles of a floor, by that of
    ///   [`next_impact_beside`](crate::Pair3::next_impact_beside).
    /// - A displacement that is zero or not finite gives `None`.
    /// - A [bullet](crate::Collider3::bullet) with this displacement as its motion gets the same answer, but not bit
    ///   for bit. Both stop a little before the shapes touch, within the error that [`Pair3::cast`](crate::Pair3::cast)
    ///   states; where the shape meets a surface at a grazing angle, that gap is a longer path, and the fractions
    ///   differ by as much.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Pose3, Shape3, Sphere, TriMesh, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// let corners = [[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [9.0, 0.0, 9.0], [-9.0, 0.0, 9.0], [9.0, 9.0, 9.0], [9.0, 9.0, -9.0]];
    /// let floor_and_wall = TriMesh::new(corners.map(Vec3::from), [[0, 2, 1], [0, 3, 2], [1, 2, 4], [1, 4, 5]])?;
    /// let level = world.insert(Collider3::new(floor_and_wall));
    /// let (ball, on_floor) = (Shape3::from(Sphere::new(1.0)?), Pose3::at([0.0, 1.0, 0.0])?);
    /// let from = (&ball, &on_floor);
    /// assert!(world.cast_shape(from, Vec3::X * 16.0, &Filter3::new()).is_some_and(|hit| hit.overlapping), "the floor");
    /// let hit = world.cast_shape_onwards(from, Vec3::X * 16.0, &Filter3::new()).ok_or("the wall")?;
    /// assert!(hit.body == level && hit.fraction <= 0.5 && hit.fraction > 0.499_99 && hit.normal.x > 0.999);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_shape_onwards(
        &self,
        from: (&Shape3, &Pose3),
        displacement: Vec3,
        filter: &Filter3<'_>,
    ) -> Option<CastAnswer3> {
        first_ahead(self, from, displacement, filter)
    }

    /// All bodies that a moved shape meets, each reported as [`World::cast_shape`] reports the first.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Pose3, Shape3, Sphere, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let near = world.insert(ball.clone().at(Pose3::at([3.0, 0.0, 0.0])?));
    /// let far = world.insert(ball.at(Pose3::at([4.0, 0.0, 0.0])?));
    /// let dot = Shape3::from(Sphere::new(0.5)?);
    /// let mut hits = vec![];
    /// world.cast_shape_all((&dot, &Pose3::IDENTITY), Vec3::X * 2.0, &Filter3::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near]));
    /// world.cast_shape_all((&dot, &Pose3::IDENTITY), Vec3::X * 4.0, &Filter3::new(), &mut hits);
    /// assert!(hits.iter().map(|hit| hit.body).eq([near, far]), "by the share of the way");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_shape_all(
        &self,
        from: (&Shape3, &Pose3),
        displacement: Vec3,
        filter: &Filter3<'_>,
        into: &mut Vec<CastAnswer3>,
    ) {
        bodies_along(self, from, displacement, filter).all(into);
    }

    /// Like [`World::cast_shape_all`], but one by one, in no promised order.
    ///
    /// ```
    /// use asunder::{Collider3, Filter3, Pose3, Shape3, Sphere, World3, glam::Vec3};
    /// use std::ops::ControlFlow;
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// world.insert(ball.clone().at(Pose3::at([3.0, 0.0, 0.0])?));
    /// world.insert(ball.at(Pose3::at([4.0, 0.0, 0.0])?));
    /// let dot = Shape3::from(Sphere::new(0.5)?);
    /// let way = Vec3::X * 4.0;
    /// let is_free = world
    ///     .visit_cast_shape((&dot, &Pose3::IDENTITY), way, &Filter3::new(), |_| ControlFlow::Break(()))
    ///     .is_continue();
    /// assert!(!is_free);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_cast_shape(
        &self,
        from: (&Shape3, &Pose3),
        displacement: Vec3,
        filter: &Filter3<'_>,
        visitor: impl FnMut(CastAnswer3) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        bodies_along(self, from, displacement, filter).visit(visitor)
    }
}
