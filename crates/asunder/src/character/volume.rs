//! Characters in space: vectors, the narrow phase, and the methods of [`World3`](crate::World3).

use super::footing::{self, Footing3};
use super::free::{Freeing, is_overlapping};
use super::gait::least_skin;
use super::slide::move_and_slide;
use super::{Freed3, Gap, Linear, Slide3, Walk3, Walks, is_along};
use crate::collider::Collider3;
use crate::query::{Asked, Filter3};
use crate::space::Volume;
use crate::world::World;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::STANDSTILL;
use asunder_geometry::{DirectionError, Ground, HalfSpace, Pose3, Ray3, Shape3};
use asunder_narrow::cast_ray3;
use core::cmp::Ordering;

impl Linear for DVec3 {
    const ZERO: Self = Self::ZERO;

    fn dot(self, other: Self) -> f64 {
        Self::dot(self, other)
    }

    fn rank(self, other: Self) -> Ordering {
        self.x
            .total_cmp(&other.x)
            .then_with(|| self.y.total_cmp(&other.y))
            .then_with(|| self.z.total_cmp(&other.z))
    }
}

impl Walk3 {
    /// The defaults for the size of a shape: see the fields. `up` may have any length.
    ///
    /// # Errors
    /// An `up` that is zero or not finite. For a character without an upward direction, set the field to zero
    /// afterwards.
    pub fn new(shape: &Shape3, up: Vec3) -> Result<Self, DirectionError> {
        // A half-space's normal must be a direction, too: the same check.
        HalfSpace::new(up)?;
        Ok(Self::for_size(Volume::size(shape), up))
    }
}

/// # Characters
/// The world moves no body by itself; these calls compute where a character would be. A [`Filter3`] decides which
/// bodies it meets: leave out its own body with [`without`](crate::Filter::without). Sensors are never in the way. All
/// results are functions of the bodies alone, and nothing is allocated.
impl World<Volume> {
    /// Moves a shape out of all solids that it overlaps, by as little as possible, and clear of them by about 1/4096 of
    /// its bounding radius, or 2^-46 of its distance from the origin if that is more.
    ///
    /// 1. It is pushed out of the body in which it is deepest. If that frees it, this is the shortest way out of that
    ///    body.
    /// 2. Otherwise it is pushed out of the planes of all manifolds at once (of the sixteen deepest, if there are
    ///    more), and this is repeated up to sixteen times. Where a push away from an end of ground would lead a
    ///    convex part's centre through it, the shape is pushed out to the side on which that centre is.
    /// 3. If that does not free it, or only by a way half as long again as the one out of that body alone, straight
    ///    ways are tried: along the normals of those manifolds and in 26 directions all around, up to four times as
    ///    far.
    /// 4. If it still overlaps something, it is wedged: `is_free` is false, and `pose` is the one tried whose deepest
    ///    overlap was shallowest; between the two sides of a press, it is about as deep in both. A centre may be a hair
    ///    from ground or from a fixed body then, and a motion from there may lead through: do not move the shape until
    ///    it is free.
    ///
    /// No path is searched for: a shape whose centre is in a thin wall may come out on the other side. But no push and
    /// no straight way takes a convex part's centre through a mesh or a height field, unless from behind where it has
    /// one side, nor from outside of all bodies into a fixed one.
    ///
    /// Cost: each round takes a query for boxes, and a manifold for each body met; each straight way takes up to twelve
    /// queries for boxes, and an overlap test for each body met.
    ///
    /// ```
    /// use asunder::{Sphere, Cuboid, Collider3, Filter3, Pose3, Shape3, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?).fixed());
    /// let ball = Shape3::from(Sphere::new(0.5)?);
    /// let freed = world.depenetrate((&ball, &Pose3::at([0.5, 1.25, 0.0])?), &Filter3::new());
    /// assert!(freed.is_free);
    /// assert!((freed.moved.y - 0.25).abs() < 2e-4 && freed.moved.x == 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn depenetrate(&self, at: (&Shape3, &Pose3), filter: &Filter3<'_>) -> Freed3 {
        let ((shape, start), filter) = (at, &filter.solid().with_touched());
        Freeing { world: self, shape, start, target: least_skin::<Volume>(shape, start), filter }.all_around()
    }

    /// Whether a shape overlaps no solid, by the rules of [`depenetrate`](World::depenetrate) and
    /// [`move_and_slide`](World::move_and_slide). Exact.
    ///
    /// Touching counts as overlapping; one-sided ground does not count while the shape is behind it. So this does not
    /// answer whether there is room to stand up: under a low one-sided ceiling, the centre of a standing character is
    /// behind that ceiling. Before the shape grows, cast the crouching one upwards by the difference in height: see
    /// [`characters`](crate::guide::characters).
    ///
    /// Cost: a query for boxes, and an overlap test for each body met.
    ///
    /// ```
    /// use asunder::{Sphere, Cuboid, Collider3, Filter3, Pose3, Shape3, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?).fixed());
    /// let ball = Shape3::from(Sphere::new(0.5)?);
    /// assert!(!world.is_free((&ball, &Pose3::at([0.0, 1.4, 0.0])?), &Filter3::new()));
    /// assert!(world.is_free((&ball, &Pose3::at([0.0, 1.6, 0.0])?), &Filter3::new()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_free(&self, at: (&Shape3, &Pose3), filter: &Filter3<'_>) -> bool {
        !is_overlapping(self, at, &filter.solid())
    }

    /// Moves a shape by a displacement, in metres, and slides it along obstacles: for a character, once per frame, by
    /// its velocity times the time step, gravity included.
    ///
    /// - If it overlaps solids, it is freed first, by the pushes of [`depenetrate`](World::depenetrate) but not by its
    ///   straight ways all around: these would throw a character sideways that is crushed between a floor and a body
    ///   that comes down on it. If pushes do not free it, it does not move on: `is_free` is false, and `pose` is the
    ///   one tried whose deepest overlap was shallowest, even if `depenetrate` finds a way out.
    /// - A free shape moves by casts alone: it never enters a solid, nor passes through one, however far it goes.
    /// - On ground that it can walk on, downward motion is cancelled, so it does not slide off. Steeper ground is a
    ///   wall for a walking character, and a slope to slide down for a falling one.
    /// - Standing on ground, it climbs at most one step per call and follows the ground downwards. A displacement that
    ///   points up is a jump: it does neither and finds no ground. So add what a lift carries upwards to the pose, not
    ///   to the displacement.
    /// - It is moved by no more than the displacement, a step, a snap and three skins together, not counting the way on
    ///   which it was freed, or moved back to its skin's distance out of an acute corner.
    /// - A displacement that is not finite counts as zero. No shape goes beyond 1e9 m: any part of the move that would
    ///   end there is left out, and so the whole move if nothing is in the way. Half-spaces do not move.
    /// - From a free start, its end depends on the poses of the bodies, and not on the order in which they were
    ///   inserted, with one exception: among bodies met at exactly the same distance, the one in the lowest slot counts
    ///   as met first, as in all casts. A shape that starts in several bodies at once may be freed elsewhere, or not at
    ///   all, if they were inserted in another order.
    ///
    /// Cost: a cast for each wall, and two for the ground; one more at an edge on which it may stand, and three before
    /// a wall that may be a step.
    ///
    /// ```
    /// use asunder::{Capsule3, Cuboid, Collider3, Filter3, Pose3, Shape3, Walk3, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// let floor = world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::new(9.0, 0.5, 9.0))?).fixed());
    /// let wall = Collider3::new(Cuboid::from_half_extents(Vec3::new(0.5, 2.0, 9.0))?).at(Pose3::at([2.5, 2.0, 0.0])?);
    /// let wall = world.insert(wall.fixed());
    /// let hero = Shape3::from(Capsule3::from_half_height(0.5, 0.4)?);
    /// let walk = Walk3::new(&hero, Vec3::Y)?;
    ///
    /// let start = Pose3::at([0.0, 1.41, 0.0])?;
    /// let slide = world.move_and_slide((&hero, &start), Vec3::new(3.0, -0.1, 0.0), &walk, &Filter3::new());
    /// assert_eq!(slide.ground.map(|ground| ground.body), Some(floor));
    /// assert_eq!(slide.walls[0].body, wall);
    /// assert!(slide.blocked && slide.is_free);
    /// let gap = 2.0 - 0.4 - slide.pose.position().x;
    /// assert!((gap - f64::from(walk.skin)).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn move_and_slide(
        &self,
        at: (&Shape3, &Pose3),
        displacement: Vec3,
        walk: &Walk3,
        filter: &Filter3<'_>,
    ) -> Slide3 {
        move_and_slide(self, at, displacement, walk, filter)
    }

    /// Where on which body a character stands at the end of its move: with it, the body carries the character by
    /// [`carried`](World::carried). `None` if it stands on nothing, or the body was removed. Cost: constant.
    ///
    /// ```
    /// use asunder::{Filter3, Pose3, Shape3, Sphere, Walk3, World3, glam::Vec3};
    /// let (world, ball) = (World3::new(), Shape3::from(Sphere::new(0.5)?));
    /// let walk = Walk3::new(&ball, Vec3::Y)?;
    /// let slide = world.move_and_slide((&ball, &Pose3::IDENTITY), Vec3::NEG_Y, &walk, &Filter3::new());
    /// assert_eq!(world.footing(&slide, &walk), None, "it falls");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn footing(&self, slide: &Slide3, walk: &Walk3) -> Option<Footing3> {
        footing::footing(self, slide, walk)
    }

    /// Where a character is once what it stands on has moved: as far from its pose as the point below it went
    /// since [`footing`](World::footing). To be called once per frame, after the bodies that carry characters have
    /// moved, and before the character does; it may lead into a solid, which the next
    /// [`move_and_slide`](World::move_and_slide) corrects.
    ///
    /// The rotation is kept. The pose is the same if the body has not moved, was removed or disabled, or would carry
    /// the character out of range. Cost: constant.
    ///
    /// ```
    /// use asunder::{Collider3, Cuboid, Footing3, Pose3, World3, glam::{DVec3, Quat, Vec3}};
    /// let mut world = World3::new();
    /// let disc = world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?));
    /// let footing = Footing3 { body: disc, pose: Pose3::IDENTITY, point: DVec3::new(1.0, 1.0, 1.0) };
    /// // A quarter turn about y.
    /// world.set_pose(disc, Pose3::new([0.0, 5.0, 0.0], Quat::from_xyzw(0.0, 1.0, 0.0, 1.0))?)?;
    /// // The corner went from (1, 1, 1) to (1, 6, -1): so does the foot.
    /// let hero = Pose3::at([1.0, 2.0, 1.0])?;
    /// assert_eq!(world.carried(&footing, &hero), hero.shifted([0.0, 5.0, -2.0])?);
    /// world.remove(disc);
    /// assert_eq!(world.carried(&footing, &hero), hero);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn carried(&self, footing: &Footing3, pose: &Pose3) -> Pose3 {
        footing::carried(self, footing, pose)
    }
}

impl Walks for Volume {
    fn wide(vector: Vec3) -> DVec3 {
        vector.as_dvec3()
    }

    fn narrow(vector: DVec3) -> Vec3 {
        vector.as_vec3()
    }

    fn position(pose: &Pose3) -> DVec3 {
        pose.position()
    }

    fn turned_since(from: &Pose3, to: &Pose3, vector: DVec3) -> DVec3 {
        if from.same_rotation(to) { vector } else { to.turn_since(from).turn(vector) }
    }

    fn moved(pose: &Pose3, by: DVec3) -> Option<Pose3> {
        Pose3::new(pose.position() + by, pose.rotation()).ok()
    }

    fn all_around(mut each: impl FnMut(DVec3)) {
        // The faces, edges and corners of a cube.
        for number in 0..27 {
            let [x, y, z] = [number % 3, number / 3 % 3, number / 9].map(|place| f64::from(place - 1));
            if let Some(direction) = DVec3::new(x, y, z).unit() {
                each(direction);
            }
        }
    }

    fn size(shape: &Shape3) -> f64 {
        shape.outer_radius().into()
    }

    fn middles((shape, pose): (&Shape3, &Pose3), mut each: impl FnMut(DVec3)) {
        match shape {
            Shape3::Compound(compound) => {
                compound.parts().iter().for_each(|part| each(pose.transform(part.center())));
            }
            _ => each(pose.transform(shape.center())),
        }
    }

    fn reach((shape, pose): (&Shape3, &Pose3), along: DVec3) -> Option<f64> {
        let local = shape.support(pose.turn_back(along))?;
        Some((pose.transform(local) - pose.position()).dot(along))
    }

    fn gaps(at: (&Shape3, &Pose3), body: &Collider3, margin: f32, mut each: impl FnMut(Gap<DVec3>)) {
        Self::visit_manifolds(at, body, margin, |manifold| {
            let deepest = manifold.points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation));
            let anchor = deepest.map_or(DVec3::ZERO, |point| point.anchor_b.as_dvec3());
            each(Gap {
                gap: manifold.separation.into(),
                away: -manifold.normal.as_dvec3(),
                point: body.pose.position() + anchor,
                part: manifold.part_b,
            });
        });
    }

    fn has_one_side(body: &Collider3) -> bool {
        Ground::of(&body.shape).is_some_and(Ground::is_one_sided)
    }

    fn first_through(ray: &Ray3, limit: f64, body: &Collider3) -> Option<f64> {
        let ground = Ground::of(&body.shape)?;
        let from = body.pose.transform_back(ray.origin());
        let way = body.pose.turn_back(ray.direction().as_dvec3());
        let grown = f64::from(f32::EPSILON) * (from.abs().max_element() + way.abs().max_element());
        let mut first = None;
        ground.visit_along(from, way, Vec3::splat(grown as f32), limit, |number| {
            let within = first.unwrap_or(limit);
            let Some(triangle) = ground.triangle(number) else { return within };
            let [a, b, c] = ground.corners(number).map(|corner| corner.as_dvec3());
            let normal = (b - a).cross(c - a);
            let closing = -normal.dot(way);
            if is_along(closing, [normal.length(), way.length()]) || ground.is_one_sided() && closing < 0.0 {
                return within;
            }
            let hit = cast_ray3(&triangle.into(), &body.pose, ray, within);
            first = hit.filter(|hit| !hit.inside || ground.is_one_sided()).map(|hit| hit.distance).or(first);
            first.unwrap_or(limit)
        });
        first
    }

    fn ray(origin: DVec3, direction: DVec3) -> Option<Ray3> {
        Ray3::new(origin, direction.as_vec3()).ok()
    }

    fn crease(one: DVec3, other: DVec3) -> Option<DVec3> {
        let across = one.cross(other);
        // For planes that are parallel up to rounding, the crease would be noise.
        if across.length() <= STANDSTILL { None } else { across.unit() }
    }
}
