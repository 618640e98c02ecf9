//! Characters in the plane: vectors, the narrow phase, and the methods of [`World2`](crate::World2).

use super::footing::{self, Footing2};
use super::free::{Freeing, is_overlapping};
use super::gait::least_skin;
use super::slide::move_and_slide;
use super::{Freed2, Gap, Linear, Slide2, Walk2, Walks, is_along};
use crate::collider::Collider2;
use crate::query::{Asked, Filter2};
use crate::space::Plane;
use crate::world::World;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Aabb2, DirectionError, HalfPlane, Pose2, Ray2, Shape2};
use asunder_narrow::cast_ray2;
use core::cmp::Ordering;
use core::ops::ControlFlow;

impl Linear for DVec2 {
    const ZERO: Self = Self::ZERO;

    fn dot(self, other: Self) -> f64 {
        Self::dot(self, other)
    }

    fn rank(self, other: Self) -> Ordering {
        self.x.total_cmp(&other.x).then_with(|| self.y.total_cmp(&other.y))
    }
}

impl Walk2 {
    /// The defaults for the size of a shape: see the fields. `up` may have any length.
    ///
    /// # Errors
    /// An `up` that is zero or not finite. For a character without an upward direction, set the field to zero
    /// afterwards.
    pub fn new(shape: &Shape2, up: Vec2) -> Result<Self, DirectionError> {
        // A half-plane's normal must be a direction, too: the same check.
        HalfPlane::new(up)?;
        Ok(Self::for_size(Plane::size(shape), up))
    }
}

/// # Characters
/// The world moves no body by itself; these calls compute where a character would be. A [`Filter2`] decides which
/// bodies it meets: leave out its own body with [`without`](crate::Filter::without). Sensors are never in the way. All
/// results are functions of the bodies alone, and nothing is allocated.
impl World<Plane> {
    /// Moves a shape out of all solids that it overlaps, by as little as possible, and clear of them by about 1/4096 of
    /// its bounding radius, or 2^-46 of its distance from the origin if that is more.
    ///
    /// 1. It is pushed out of the body in which it is deepest. If that frees it, this is the shortest way out of that
    ///    body.
    /// 2. Otherwise it is pushed out of the planes of all manifolds at once (of the sixteen deepest, if there are
    ///    more), and this is repeated up to sixteen times. Where a push away from an end of a chain would lead a
    ///    convex part's centre through it, the shape is pushed out to the side on which that centre is.
    /// 3. If that does not free it, or only by a way half as long again as the one out of that body alone, straight
    ///    ways are tried: along the normals of those manifolds and in eight directions all around, up to four times as
    ///    far.
    /// 4. If it still overlaps something, it is wedged: `is_free` is false, and `pose` is the one tried whose deepest
    ///    overlap was shallowest; between the two sides of a press, it is about as deep in both. A centre may be a hair
    ///    from ground or from a fixed body then, and a motion from there may lead through: do not move the shape until
    ///    it is free.
    ///
    /// No path is searched for: a shape whose centre is in a thin wall may come out on the other side. But no push and
    /// no straight way takes a convex part's centre through a chain, unless from behind where it has one side, nor from
    /// outside of all bodies into a fixed one.
    ///
    /// Cost: each round takes a query for boxes, and a manifold for each body met; each straight way takes up to twelve
    /// queries for boxes, and an overlap test for each body met.
    ///
    /// ```
    /// use asunder::{Circle, Rect, Collider2, Filter2, Pose2, Shape2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?).fixed());
    /// let ball = Shape2::from(Circle::new(0.5)?);
    /// let freed = world.depenetrate((&ball, &Pose2::at([0.5, 1.25])?), &Filter2::new());
    /// assert!(freed.is_free);
    /// assert!((freed.moved.y - 0.25).abs() < 2e-4 && freed.moved.x == 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn depenetrate(&self, at: (&Shape2, &Pose2), filter: &Filter2<'_>) -> Freed2 {
        let ((shape, start), filter) = (at, &filter.solid().with_touched());
        Freeing { world: self, shape, start, target: least_skin::<Plane>(shape, start), filter }.all_around()
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
    /// use asunder::{Circle, Rect, Collider2, Filter2, Pose2, Shape2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?).fixed());
    /// let ball = Shape2::from(Circle::new(0.5)?);
    /// assert!(!world.is_free((&ball, &Pose2::at([0.0, 1.4])?), &Filter2::new()));
    /// assert!(world.is_free((&ball, &Pose2::at([0.0, 1.6])?), &Filter2::new()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_free(&self, at: (&Shape2, &Pose2), filter: &Filter2<'_>) -> bool {
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
    ///   end there is left out, and so the whole move if nothing is in the way. Half-planes do not move.
    /// - From a free start, its end depends on the poses of the bodies, and not on the order in which they were
    ///   inserted, with one exception: among bodies met at exactly the same distance, the one in the lowest slot counts
    ///   as met first, as in all casts. A shape that starts in several bodies at once may be freed elsewhere, or not at
    ///   all, if they were inserted in another order.
    ///
    /// Cost: a cast for each wall, and two for the ground; one more at an edge on which it may stand, and three before
    /// a wall that may be a step.
    ///
    /// ```
    /// use asunder::{Capsule2, Rect, Collider2, Filter2, Pose2, Shape2, Walk2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let floor = world.insert(Collider2::new(Rect::from_half_extents(Vec2::new(9.0, 0.5))?).fixed());
    /// let wall = Collider2::new(Rect::from_half_extents(Vec2::new(0.5, 2.0))?).at(Pose2::at([2.5, 2.0])?);
    /// let wall = world.insert(wall.fixed());
    /// let hero = Shape2::from(Capsule2::from_half_height(0.5, 0.4)?);
    /// let walk = Walk2::new(&hero, Vec2::Y)?;
    ///
    /// let start = Pose2::at([0.0, 1.41])?;
    /// let slide = world.move_and_slide((&hero, &start), Vec2::new(3.0, -0.1), &walk, &Filter2::new());
    /// assert_eq!(slide.ground.map(|ground| ground.body), Some(floor));
    /// assert_eq!(slide.walls[0].body, wall);
    /// assert!(slide.blocked && slide.is_free);
    /// let gap = 2.0 - 0.4 - slide.pose.position().x;
    /// assert!((gap - f64::from(walk.skin)).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn move_and_slide(
        &self,
        at: (&Shape2, &Pose2),
        displacement: Vec2,
        walk: &Walk2,
        filter: &Filter2<'_>,
    ) -> Slide2 {
        move_and_slide(self, at, displacement, walk, filter)
    }

    /// Where on which body a character stands at the end of its move: with it, the body carries the character by
    /// [`carried`](World::carried). `None` if it stands on nothing, or the body was removed. Cost: constant.
    ///
    /// ```
    /// use asunder::{Circle, Filter2, Pose2, Shape2, Walk2, World2, glam::Vec2};
    /// let (world, ball) = (World2::new(), Shape2::from(Circle::new(0.5)?));
    /// let walk = Walk2::new(&ball, Vec2::Y)?;
    /// let slide = world.move_and_slide((&ball, &Pose2::IDENTITY), Vec2::NEG_Y, &walk, &Filter2::new());
    /// assert_eq!(world.footing(&slide, &walk), None, "it falls");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn footing(&self, slide: &Slide2, walk: &Walk2) -> Option<Footing2> {
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
    /// use asunder::{Collider2, Footing2, Pose2, Rect, Rotation2, World2, glam::{DVec2, Vec2}};
    /// let mut world = World2::new();
    /// let wheel = world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?));
    /// let footing = Footing2 { body: wheel, pose: Pose2::IDENTITY, point: DVec2::new(1.0, 1.0) };
    /// world.set_pose(wheel, Pose2::new([0.0, 5.0], Rotation2::new(0.0, 1.0)?)?)?;
    /// // The corner went from (1, 1) to (-1, 6): so does the foot.
    /// let hero = Pose2::at([1.0, 2.0])?;
    /// assert_eq!(world.carried(&footing, &hero), hero.shifted([-2.0, 5.0])?);
    /// world.remove(wheel);
    /// assert_eq!(world.carried(&footing, &hero), hero);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn carried(&self, footing: &Footing2, pose: &Pose2) -> Pose2 {
        footing::carried(self, footing, pose)
    }
}

impl Walks for Plane {
    fn wide(vector: Vec2) -> DVec2 {
        vector.as_dvec2()
    }

    fn narrow(vector: DVec2) -> Vec2 {
        vector.as_vec2()
    }

    fn position(pose: &Pose2) -> DVec2 {
        pose.position()
    }

    fn turned_since(from: &Pose2, to: &Pose2, vector: DVec2) -> DVec2 {
        if from.same_rotation(to) { vector } else { to.turn(from.turn_back(vector)) }
    }

    fn moved(pose: &Pose2, by: DVec2) -> Option<Pose2> {
        Pose2::new(pose.position() + by, pose.rotation()).ok()
    }

    fn all_around(mut each: impl FnMut(DVec2)) {
        // The sides and corners of a square.
        for number in 0..9 {
            let [x, y] = [number % 3, number / 3].map(|place| f64::from(place - 1));
            if let Some(direction) = DVec2::new(x, y).unit() {
                each(direction);
            }
        }
    }

    fn size(shape: &Shape2) -> f64 {
        shape.outer_radius().into()
    }

    fn middles((shape, pose): (&Shape2, &Pose2), mut each: impl FnMut(DVec2)) {
        match shape {
            Shape2::Compound(compound) => {
                compound.parts().iter().for_each(|part| each(pose.transform(part.center())));
            }
            _ => each(pose.transform(shape.center())),
        }
    }

    fn reach((shape, pose): (&Shape2, &Pose2), along: DVec2) -> Option<f64> {
        let local = shape.support(pose.turn_back(along))?;
        Some((pose.transform(local) - pose.position()).dot(along))
    }

    fn gaps(at: (&Shape2, &Pose2), body: &Collider2, margin: f32, mut each: impl FnMut(Gap<DVec2>)) {
        Self::visit_manifolds(at, body, margin, |manifold| {
            let deepest = manifold.points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation));
            let anchor = deepest.map_or(DVec2::ZERO, |point| point.anchor_b.as_dvec2());
            each(Gap {
                gap: manifold.separation.into(),
                away: -manifold.normal.as_dvec2(),
                point: body.pose.position() + anchor,
                part: manifold.part_b,
            });
        });
    }

    fn has_one_side(body: &Collider2) -> bool {
        matches!(&body.shape, Shape2::Chain(chain) if chain.is_one_sided())
    }

    fn first_through(ray: &Ray2, limit: f64, body: &Collider2) -> Option<f64> {
        let Shape2::Chain(chain) = &body.shape else { return None };
        let from = body.pose.transform_back(ray.origin());
        let way = body.pose.turn_back(ray.direction().as_dvec2());
        let to = from + way * limit;
        let grown = DVec2::splat(f64::from(f32::EPSILON) * (from.abs() + to.abs()).max_element());
        let bounds = Aabb2::new((from.min(to) - grown).as_vec2(), (from.max(to) + grown).as_vec2());
        let mut first = None;
        let _ = chain.visit_near(&bounds, |number| {
            let (Some(segment), Some(run)) = (chain.segment(number), chain.run_of(number)) else {
                return ControlFlow::Continue(());
            };
            let [start, end] = run.vertices().map(|vertex| chain.vertices()[vertex as usize].as_dvec2());
            let closing = (end - start).perp_dot(way);
            if !is_along(closing, [(end - start).length(), way.length()])
                && (closing > 0.0 || !chain.is_one_sided())
            {
                let hit = cast_ray2(&segment.into(), &body.pose, ray, first.unwrap_or(limit));
                first =
                    hit.filter(|hit| !hit.inside || chain.is_one_sided()).map(|hit| hit.distance).or(first);
            }
            ControlFlow::Continue(())
        });
        first
    }

    fn ray(origin: DVec2, direction: DVec2) -> Option<Ray2> {
        Ray2::new(origin, direction.as_vec2()).ok()
    }

    fn crease(_: DVec2, _: DVec2) -> Option<DVec2> {
        None
    }
}
