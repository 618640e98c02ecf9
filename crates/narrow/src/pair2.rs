//! One pair in the plane.

mod closest;
mod compounds;
mod ground;
mod nearest;
mod part;

use crate::answer::{ContactPoint2, Manifold2, Measured2, Separation2, Tier, Verdict};
use crate::batch::{Proximity, beyond};
use crate::feature::Hint;
use crate::least::Least;
use crate::lists::with_manifolds2;
use crate::points::ContactPoints;
use crate::polygon::convex::Convex;
use crate::polygon::manifold::Touch;
use crate::polygon::measure::{Near, Probe, Query};
use crate::polygon::outline::Turn;
use crate::polygon::quick::Bodies;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Pose2, Shape2};
use part::{Part, for_parts, for_parts_in, for_parts_near};

/// Two posed shapes in the plane, prepared for queries about each other.
///
/// Positions are subtracted in f64 before anything is rotated, so that accuracy does not degrade far from the origin.
///
/// | | separation | closest points in a gap | contact points |
/// |---|---|---|---|
/// | half-plane, anything | its line's normal alone: one dot product a vertex | lowest vertex | lowest vertex and its neighbour |
/// | half-plane, half-plane | lines, if their normals are exactly opposite; else their overlap is unbounded | half way | one, or none |
/// | circle, circle | the line through both centres | the same | one |
/// | rectangle, polygon, capsule, segment, circle, with each other | edge normals | GJK | clipped edges |
/// | compound, anything | the least of its parts' | the same | a manifold for each pair of parts |
/// | chain, anything | the least of its segments' | the same | a manifold for each normal of what is touched |
///
/// Radii (of circles, capsules, and shapes that are `rounded`) come last: the kernels work on the cores, and both radii
/// are subtracted. A segment has two edges, back to back.
///
/// ```
/// use asunder::{Pair2, Pose2, Rect, Shape2, glam::Vec2};
/// let square = Shape2::from(Rect::from_half_extents(Vec2::splat(0.5))?);
/// let (left, right) = (Pose2::at([1e9 - 2.0, 0.0])?, Pose2::at([1e9, 0.0])?);
/// let closest = Pair2::new(&square, &left, &square, &right).distance().ok_or("they are apart")?;
/// assert!((closest.distance - 1.0).abs() <= closest.error);
/// assert_eq!((closest.anchor_a.x, closest.anchor_b.x), (0.5, -0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pair2<'a> {
    pub(crate) shape_a: &'a Shape2,
    pub(crate) shape_b: &'a Shape2,
    pub(crate) pose_a: Pose2,
    pub(crate) pose_b: Pose2,
    turn_a: Turn,
    turn_b: Turn,
    /// B's position less A's.
    between: DVec2,
}

/// Two convex parts in the frame of the pair, with what maps back from there.
struct Parts<'a> {
    place: Place,
    convex: Convex<'a>,
}

/// The indices of two parts, and what maps their points from the frame of the pair back to the bodies.
#[derive(Clone, Copy)]
struct Place {
    indices: [u32; 2],
    /// Each part's origin less its body's position, in world axes.
    shifts: [DVec2; 2],
    /// B's origin less A's.
    offset: DVec2,
}

impl<'a> Pair2<'a> {
    /// A pair of posed shapes. Cost: constant.
    #[inline]
    pub fn new(shape_a: &'a Shape2, pose_a: &Pose2, shape_b: &'a Shape2, pose_b: &Pose2) -> Self {
        let between = pose_b.position() - pose_a.position();
        Self {
            shape_a,
            shape_b,
            pose_a: *pose_a,
            pose_b: *pose_b,
            turn_a: Turn::of(pose_a.rotation()),
            turn_b: Turn::of(pose_b.rotation()),
            between,
        }
    }

    /// The sum of the two bounding radii, in metres, to which tolerances of this pair are relative. Infinite with a
    /// half-plane, whose pairs have tolerances relative to the other shape.
    pub fn size(&self) -> f32 {
        self.shape_a.outer_radius() + self.shape_b.outer_radius()
    }

    /// Whether the shapes share a point, exactly; touching counts.
    ///
    /// Settled by error bounds of f64 where they suffice, else by certificates in f64, else by exact arithmetic:
    /// [`verdict`](Self::verdict) reports which.
    ///
    /// Cost:
    /// - Constant where circles around or inside the shapes decide, and for rectangles.
    /// - Polygons of up to 16 vertices: the product of the vertex counts.
    /// - Polygons of more: the logarithm of the vertices, and no more than their number however they overlap.
    /// - Shapes that touch up to rounding: some microseconds more.
    pub fn overlaps(&self) -> bool {
        self.verdict().overlapping
    }

    /// Whether the shapes share a point, by the rules of contacts and characters: like [`overlaps`](Self::overlaps),
    /// but a run of a one-sided chain counts only if the centre of a part is in front of it. Two chains overlap each
    /// other from all sides. Exact.
    ///
    /// ```
    /// use asunder::{Chain, Circle, Pair2, Pose2, Shape2, glam::Vec2};
    /// let floor = Shape2::from(Chain::open([Vec2::X, Vec2::NEG_X])?.one_sided());
    /// let (ball, here) = (Shape2::from(Circle::new(0.5)?), Pose2::IDENTITY);
    /// let (above, below) = (Pose2::at([0.0, 0.25])?, Pose2::at([0.0, -0.25])?);
    /// assert!(Pair2::new(&ball, &above, &floor, &here).overlaps_front());
    /// let behind = Pair2::new(&ball, &below, &floor, &here);
    /// assert_eq!((behind.overlaps_front(), behind.overlaps()), (false, true));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn overlaps_front(&self) -> bool {
        let has_one_side = |shape: &Shape2| matches!(shape, Shape2::Chain(chain) if chain.is_one_sided());
        if has_one_side(self.shape_a) || has_one_side(self.shape_b) {
            self.overlaps_facing()
        } else {
            self.overlaps()
        }
    }

    /// Like [`overlaps`](Self::overlaps), with the tier of precision that settled it.
    ///
    /// ```
    /// use asunder::{Pair2, Pose2, Rect, Shape2, Tier, glam::Vec2};
    /// let square = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
    /// let next = Pose2::at([2.0, 0.0])?;
    /// let touching = Pair2::new(&square, &Pose2::IDENTITY, &square, &next).verdict();
    /// assert_eq!((touching.overlapping, touching.tier), (true, Tier::Exact));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn verdict(&self) -> Verdict {
        if self.has_ground() {
            return self.verdict_on_ground();
        }
        if let Some(overlapping) = self.bodies().overlap() {
            return Verdict { overlapping, tier: Tier::Bound };
        }
        let mut tier = Tier::Bound;
        let overlapping = self.any(0.0, |parts| {
            let verdict = parts.convex.verdict();
            tier = tier.max(verdict.tier);
            verdict.overlapping
        });
        Verdict { overlapping, tier }
    }

    /// The overlap as decided by the first tier alone, right or wrong: by the sign of its numbers.
    ///
    /// It is meant for measurements: the difference in time to [`overlaps`](Self::overlaps) is the cost of certainty.
    ///
    /// ```
    /// use asunder::{Circle, Pair2, Pose2, Shape2};
    /// let ball = Shape2::from(Circle::new(1.0)?);
    /// let (here, there) = (Pose2::IDENTITY, Pose2::at([3.0, 0.0])?);
    /// let pair = Pair2::new(&ball, &here, &ball, &there);
    /// assert_eq!((pair.guess(), pair.overlaps()), (false, false), "far from touching they agree");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn guess(&self) -> bool {
        if self.has_ground() {
            return self.guess_on_ground();
        }
        self.any(0.0, |parts| parts.convex.guess())
    }

    /// The separation, exact up to its error where it is at most `limit` metres, which may be infinite.
    ///
    /// - Beyond the limit it may stop at any axis along which the shapes are that far apart, with
    ///   [`Separation2::AtLeast`]. A NaN counts as no limit, and a negative limit as zero.
    /// - Two half-planes have separation -inf unless their normals are exactly opposite.
    ///
    /// Cost:
    /// - Polygons of up to 16 vertices: the product of the vertex counts.
    /// - Polygons of more: the logarithm of the vertices for shapes apart or slightly overlapping, their number for
    ///   those on one centre.
    /// - In a gap within the limit: a few support searches more, for the Euclidean distance.
    pub fn separation(&self, limit: f32) -> Separation2 {
        let limit = if limit.is_nan() { f64::INFINITY } else { f64::from(limit).max(0.0) };
        let measured = |near: &Near| {
            let (separation, error, normal) = (near.separation, near.error, near.normal.as_vec2());
            Separation2::Measured(Measured2 { separation, error, normal })
        };
        if let Some(found) = self.separation_apart(limit) {
            return found;
        }
        match self.bodies().answer(&Query { limit, hint: Hint::NONE, points: false }) {
            Some(Probe::Near(near)) => return measured(&near),
            Some(Probe::Beyond(at_least, _)) => return Separation2::AtLeast(at_least),
            None => {}
        }
        match self.nearest(limit) {
            Ok((_, near)) => measured(&near),
            Err(at_least) => Separation2::AtLeast(at_least),
        }
    }

    /// The contact manifold, if the shapes are at most `margin` metres apart; a margin below zero, or NaN, counts as
    /// zero.
    ///
    /// A point may be up to the margin outside. For compounds this is the manifold of the deepest pair of parts;
    /// [`Pair2::manifolds`] has them all. `None` for two half-planes whose overlap is unbounded. Cost: that of the
    /// separation, plus clipping two edges.
    pub fn manifold(&self, margin: f32) -> Option<Manifold2> {
        if self.has_ground() {
            return self.deepest_on_ground(margin).1;
        }
        let mut best: Option<Manifold2> = None;
        let _ = self.contact(margin, Hint::NONE, true, |next| {
            if best.as_ref().is_none_or(|best| next.separation < best.separation) {
                best = Some(next);
            }
        });
        best
    }

    /// One manifold for each pair of convex parts at most `margin` metres apart, in order of the parts: at most one
    /// unless a shape is a compound. On a chain, one for each part of the other shape and each normal of the straight
    /// runs and corners that it touches; none for two chains.
    ///
    /// ```
    /// use asunder::{Circle, Compound2, HalfPlane, Pair2, Pose2, Shape2, glam::Vec2};
    /// let ball = Shape2::from(Circle::new(0.5)?);
    /// let dumbbell: Shape2 =
    ///     Compound2::new([(Pose2::at(Vec2::X)?, ball.clone()), (Pose2::at(Vec2::NEG_X)?, ball)])?.into();
    /// let floor = Shape2::from(HalfPlane::new(Vec2::Y)?);
    /// let (here, above) = (Pose2::IDENTITY, Pose2::at([0.0, 0.5])?);
    /// let manifolds = Pair2::new(&floor, &here, &dumbbell, &above).manifolds(0.0);
    /// assert_eq!(manifolds.iter().map(|manifold| manifold.part_b).collect::<Vec<_>>(), [0, 1]);
    /// assert_eq!(manifolds[1].points[0].anchor_b, Vec2::new(-1.0, -0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn manifolds(&self, margin: f32) -> Vec<Manifold2> {
        let mut manifolds = Vec::new();
        self.add_manifolds(margin, &mut manifolds);
        manifolds
    }

    pub(crate) fn add_manifolds(&self, margin: f32, manifolds: &mut Vec<Manifold2>) {
        if self.has_ground() {
            self.contact_on_ground([margin, 0.0], manifolds);
        } else {
            let _ = self.contact(margin, Hint::NONE, true, |manifold| manifolds.push(manifold));
        }
    }

    /// Like [`Pair2::manifolds`], but one by one: for code that runs every frame and has no list. The memory is kept
    /// per thread.
    ///
    /// ```
    /// use asunder::{Circle, HalfPlane, Pair2, Pose2, Shape2, glam::Vec2};
    /// let (ball, floor) = (Shape2::from(Circle::new(0.5)?), Shape2::from(HalfPlane::new(Vec2::Y)?));
    /// let (here, above) = (Pose2::IDENTITY, Pose2::at([0.0, 0.5])?);
    /// let mut deepest = f32::INFINITY;
    /// Pair2::new(&floor, &here, &ball, &above)
    ///     .visit_manifolds(0.0, |manifold| deepest = deepest.min(manifold.separation));
    /// assert_eq!(deepest, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_manifolds(&self, margin: f32, visitor: impl FnMut(&Manifold2)) {
        with_manifolds2(self, margin, |manifolds| manifolds.iter().for_each(visitor));
    }

    /// Returns the hint for the next frame, and how near they are. Passes manifolds to `keep` if they are wanted.
    pub(crate) fn contact(
        &self,
        margin: f32,
        hint: Hint,
        is_wanted: bool,
        mut keep: impl FnMut(Manifold2),
    ) -> (Hint, Proximity) {
        let margin = margin.max(0.0);
        // What rounds to the margin counts as within it: the reported number decides.
        let reach = f64::from(margin.next_up());
        let query = Query { limit: reach, hint, points: is_wanted };
        let is_near = |near: &Near| near.verdict.overlapping || near.separation <= margin;
        match self.bodies().answer(&query) {
            Some(Probe::Near(near)) => {
                if !is_near(&near) {
                    return (near.hint, Proximity::Beyond(0.0));
                }
                if let Some(touch) = &near.touch {
                    keep(manifold(&near, touch, ([0, 0], [DVec2::ZERO, -self.between])));
                }
                let overlapping = near.verdict.overlapping;
                return (near.hint, Proximity::Within { overlapping });
            }
            Some(Probe::Beyond(at_least, hint)) => {
                return (hint, Proximity::Beyond(beyond(at_least.into(), reach)));
            }
            None => {}
        }
        if self.is_compound() {
            return self.contact_of_parts(&query, margin, &mut keep);
        }
        let [a, b] = [Part::whole(self.shape_a, &self.turn_a), Part::whole(self.shape_b, &self.turn_b)];
        let (hint, found) = self.parts(a, b).contact(&query, margin, &mut keep);
        (hint, found.map_or_else(Proximity::Beyond, |(overlapping, _)| Proximity::Within { overlapping }))
    }

    /// The pair of parts with the least separation, or a bound if all are beyond the limit.
    fn nearest(&self, limit: f64) -> Result<(Place, Near), f32> {
        if self.has_ground() {
            return self.nearest_on_ground(limit);
        }
        if !self.is_compound() {
            let [a, b] = [Part::whole(self.shape_a, &self.turn_a), Part::whole(self.shape_b, &self.turn_b)];
            let parts = self.parts(a, b);
            return match parts.convex.probe(&Query { limit, hint: Hint::NONE, points: false }) {
                Probe::Beyond(at_least, _) => Err(at_least),
                Probe::Near(near) => Ok((parts.place, near)),
            };
        }
        let mut least = Least::within(limit);
        let visit = |least: &mut Least<_>, [a, b]: [Part; 2]| {
            if !least.passes_over(self.gap(&a, &b)) {
                let parts = self.parts(a, b);
                let query = Query { limit: least.reach(), hint: Hint::NONE, points: false };
                match parts.convex.probe(&query) {
                    Probe::Beyond(at_least, _) => least.give_up(at_least),
                    Probe::Near(near) => {
                        let (separation, error) = (near.separation, near.error);
                        least.offer((parts.place, near), separation, error);
                    }
                }
            }
            false
        };
        self.visit_nearest(&mut least, visit);
        let ((place, mut near), error) = least.finish()?;
        near.error = error;
        Ok((place, near))
    }

    /// The pair as whole bodies, without parts.
    fn bodies(&self) -> Bodies<'_> {
        let (shapes, turns) = ([self.shape_a, self.shape_b], [&self.turn_a, &self.turn_b]);
        Bodies { shapes, turns, between: self.between }
    }

    /// Whether the answer is yes for any pair of parts whose bounding circles are at most `within` apart.
    fn any(&self, within: f64, mut test: impl FnMut(&Parts<'a>) -> bool) -> bool {
        let whole_b = Part::whole(self.shape_b, &self.turn_b);
        if !self.is_compound() {
            return test(&self.parts(Part::whole(self.shape_a, &self.turn_a), whole_b));
        }
        let is_far = |a: &Part, b: &Part| self.gap(a, b) > within;
        let beside_b = || self.around_b(&whole_b, within);
        for_parts_near(self.shape_a, &self.turn_a, beside_b, |a| {
            let beside_a = || self.around_a(&a, within);
            let test = |b| !is_far(&a, &b) && test(&self.parts(a, b));
            !is_far(&a, &whole_b) && for_parts_near(self.shape_b, &self.turn_b, beside_a, test)
        })
    }

    /// Whether two convex parts, given with their poses in their bodies, overlap, exactly.
    pub(crate) fn do_pieces_overlap(&self, [a, b]: [(&Shape2, Option<&Pose2>); 2]) -> bool {
        let [a, b] = [(a, &self.turn_a), (b, &self.turn_b)]
            .map(|((shape, local), turn)| Part { local, ..Part::whole(shape, turn) });
        self.parts(a, b).convex.verdict().overlapping
    }

    pub(crate) fn is_compound(&self) -> bool {
        matches!(self.shape_a, Shape2::Compound(_)) || matches!(self.shape_b, Shape2::Compound(_))
    }

    /// A lower bound on the separation of two parts: the gap between their bounding circles, less a bound on its
    /// rounding.
    fn gap(&self, a: &Part, b: &Part) -> f64 {
        let apart = (self.between + b.center - a.center).length();
        // A stored rotation stretches by its length, which is one up to the rounding of f32; a part has two such
        // rotations.
        let stretch = 1.0 + 4.0 * f64::from(f32::EPSILON);
        let radii = (f64::from(a.shape.outer_radius()) + f64::from(b.shape.outer_radius())) * stretch;
        let reach = self.between.length() + a.center.length() + b.center.length() + radii;
        apart - radii - 64.0 * f64::EPSILON * reach
    }

    /// The sum of the lengths of the vectors that add up to the offset between two parts of compounds; `None` for
    /// whole shapes, whose offset is a single vector.
    fn summed(&self, shift_a: DVec2, shift_b: DVec2) -> Option<f64> {
        self.is_compound().then(|| self.between.length() + shift_a.length() + shift_b.length())
    }

    fn parts<'p>(&self, a: Part<'p>, b: Part<'p>) -> Parts<'p> {
        let (turn_a, shift_a) = a.placed(&self.turn_a);
        let (turn_b, shift_b) = b.placed(&self.turn_b);
        // Positions first, then the parts' offsets: large coordinates cancel.
        let offset = self.between + (shift_b - shift_a);
        let summed = self.summed(shift_a, shift_b);
        let convex =
            Convex::new([a.site(&self.pose_a), b.site(&self.pose_b)], [turn_a, turn_b], offset, summed);
        Parts { place: Place { indices: [a.index, b.index], shifts: [shift_a, shift_b], offset }, convex }
    }
}

impl Parts<'_> {
    /// The hint for the next frame, and whether they overlap and their separation, if they are within the margin; else
    /// by how much they are beyond it.
    fn contact(
        &self,
        query: &Query,
        margin: f32,
        keep: &mut impl FnMut(Manifold2),
    ) -> (Hint, Result<(bool, f32), f32>) {
        let near = match self.convex.probe(query) {
            Probe::Beyond(at_least, hint) => return (hint, Err(beyond(at_least.into(), query.limit))),
            Probe::Near(near) => near,
        };
        let overlapping = near.verdict.overlapping;
        if !overlapping && near.separation > margin {
            return (near.hint, Err(0.0));
        }
        if let Some(touch) = &near.touch {
            keep(manifold(&near, touch, (self.place.indices, self.place.shifts())));
        }
        (near.hint, Ok((overlapping, near.separation)))
    }
}

impl Place {
    /// What to add to points in the frame of the pair to get world vectors from A's position and from B's.
    fn shifts(&self) -> [DVec2; 2] {
        [self.shifts[0], self.shifts[1] - self.offset]
    }

    /// Maps a point from the frame of the pair to a world vector from A's position.
    fn anchor_a(&self, point: DVec2) -> Vec2 {
        (point + self.shifts[0]).as_vec2()
    }

    /// Maps a point from the frame of the pair to a world vector from B's position.
    fn anchor_b(&self, point: DVec2) -> Vec2 {
        (point - self.offset + self.shifts[1]).as_vec2()
    }
}

/// A manifold of the parts with these indices. `shifts` are added to points in the frame of the pair to get vectors
/// from A's position and from B's.
#[inline]
fn manifold(near: &Near, touch: &Touch, (indices, shifts): ([u32; 2], [DVec2; 2])) -> Manifold2 {
    let mut points = ContactPoints::new();
    for point in &touch.points {
        points.push(ContactPoint2 {
            separation: point.separation as f32,
            anchor_a: (point.on_a + shifts[0]).as_vec2(),
            anchor_b: (point.on_b + shifts[1]).as_vec2(),
            feature: point.feature,
        });
    }
    Manifold2 {
        part_a: indices[0],
        part_b: indices[1],
        normal: touch.normal.as_vec2(),
        separation: near.separation,
        error: near.error,
        points,
    }
}
