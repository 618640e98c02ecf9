//! One pair in space.

mod ball;
mod ball_on_faces;
mod ball_on_hull;
mod ball_on_rod;
mod ball_on_triangle;
mod balls;
mod compounds;
mod nearest;
mod on_plane;
mod part;
mod parts;
mod rods;

use crate::answer::{Closest3, Manifold3, Measured3, Separation3, Tier, Verdict};
use crate::batch::{Proximity, beyond};
use crate::feature::Hint;
use crate::ground3::OnGround;
use crate::least::Least;
use crate::lists::with_manifolds3;
use crate::polyhedron::convex::{IDENTITY, Near, Probe, Query, Wanted};
use crate::polyhedron::cuboids::placed::Posed;
use crate::polyhedron::cuboids::queries::Contact;
use crate::precision::round_down;
use crate::room::{Deepest, Room, in_place};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Pose3, Shape3};
use part::for_parts_near;
pub(crate) use part::{Part, for_parts, for_parts_along};
pub(crate) use parts::Parts;

/// Two posed shapes in space, prepared for queries about each other.
///
/// Positions are subtracted in f64 before anything is rotated, so that accuracy does not degrade far from the origin.
///
/// | | separation | closest points in a gap | contact points |
/// |---|---|---|---|
/// | half-space, anything | its plane's normal alone: one dot product a vertex | lowest vertex | face that faces the plane |
/// | half-space, half-space | planes, if their normals are exactly opposite; else their overlap is unbounded | half way | one, or none |
/// | sphere, capsule, segment among themselves | closest points of segments, in closed form | the same | one, or two where they lie side by side |
/// | sphere, cuboid | the centre clamped to the cuboid; inside, its nearest face | the same | one |
/// | cuboid, cuboid | 15 axes, projections in closed form | GJK | clipped faces, crossing edges, or edges side by side |
/// | sphere, triangle or hull | inside, the face of least depth; else the closest point, found by a walk from face to edge to corner, and proved by a projection | the same | one |
/// | anything else of cuboid, hull, triangle, with each other or with any of the above | face normals, and the edge pairs whose arcs cross on the Gauss map | GJK | as for cuboids |
/// | compound, anything | the least of its parts' | the same | a manifold for each pair of parts |
/// | mesh or height field, anything | the least of its triangles' near the other | the same | a manifold for each normal of a part |
///
/// Radii (of spheres, capsules, and shapes that are `rounded`) come last: the kernels work on the cores, and both radii
/// are subtracted. Triangles and flat hulls have two faces, back to back.
///
/// ```
/// use asunder::{Cuboid, Pair3, Pose3, Shape3, glam::Vec3};
/// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5))?);
/// let (left, right) = (Pose3::at([1e9 - 2.0, 0.0, 0.0])?, Pose3::at([1e9, 0.0, 0.0])?);
/// let closest = Pair3::new(&cube, &left, &cube, &right).distance().ok_or("they are apart")?;
/// assert!((closest.distance - 1.0).abs() <= closest.error);
/// assert_eq!((closest.anchor_a.x, closest.anchor_b.x), (0.5, -0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pair3<'a> {
    pub(crate) shape_a: &'a Shape3,
    pub(crate) shape_b: &'a Shape3,
    pub(crate) pose_a: Pose3,
    pub(crate) pose_b: Pose3,
    /// B's position less A's.
    pub(crate) between: DVec3,
}

impl<'a> Pair3<'a> {
    /// A pair of posed shapes. Cost: a subtraction.
    #[inline]
    pub fn new(shape_a: &'a Shape3, pose_a: &Pose3, shape_b: &'a Shape3, pose_b: &Pose3) -> Self {
        let between = pose_b.position() - pose_a.position();
        Self { shape_a, shape_b, pose_a: *pose_a, pose_b: *pose_b, between }
    }

    /// Both shapes, if they are cuboids, which have kernels of their own.
    #[inline]
    pub(crate) fn cuboids(&self) -> Option<Posed<'_>> {
        let (Shape3::Cuboid(a), Shape3::Cuboid(b)) = (self.shape_a, self.shape_b) else { return None };
        Some(Posed { cuboids: [a, b], poses: [&self.pose_a, &self.pose_b] })
    }

    /// The sum of the two bounding radii, in metres, to which tolerances of this pair are relative. Infinite with a
    /// half-space, whose pairs have tolerances relative to the other shape.
    pub fn size(&self) -> f32 {
        self.shape_a.outer_radius() + self.shape_b.outer_radius()
    }

    /// Whether the shapes share a point, exactly; touching counts. One-sided ground counts from both sides here.
    ///
    /// It is settled by error bounds of f64 where they suffice, else by certificates in f64, else by exact arithmetic:
    /// [`verdict`](Self::verdict) reports which.
    ///
    /// Cost:
    /// - Cuboids: fifteen axes.
    /// - Others: some support searches, each linear in the vertices.
    /// - Shapes that touch up to rounding: some microseconds more.
    /// - Ground: the above for each triangle whose box meets a part's box; two grounds: for each triangle of one that
    ///   is near the other.
    pub fn overlaps(&self) -> bool {
        self.verdict().overlapping
    }

    /// Whether the shapes share a point, by the rules of contacts and characters: like [`overlaps`](Self::overlaps),
    /// but a triangle of one-sided ground counts only if the centre of a part is in front of it. Two grounds overlap
    /// each other from all sides. Exact.
    ///
    /// ```
    /// use asunder::{Pair3, Pose3, Shape3, Sphere, TriMesh, glam::Vec3};
    /// let floor = TriMesh::new([Vec3::ZERO, Vec3::Z, Vec3::X], [[0, 1, 2]])?;
    /// let (floor, here) = (Shape3::from(floor.one_sided()), Pose3::IDENTITY);
    /// let ball = Shape3::from(Sphere::new(0.5)?);
    /// let (above, below) = (Pose3::at([0.25, 0.25, 0.25])?, Pose3::at([0.25, -0.25, 0.25])?);
    /// assert!(Pair3::new(&ball, &above, &floor, &here).overlaps_front());
    /// let behind = Pair3::new(&ball, &below, &floor, &here);
    /// assert_eq!((behind.overlaps_front(), behind.overlaps()), (false, true));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn overlaps_front(&self) -> bool {
        match OnGround::of(self) {
            // For a centre that is in the plane of a front up to rounding, contacts and casts round that plane
            // differently and may disagree. This agrees with contacts.
            Some(on) if on.ground.is_one_sided() && !on.body.is_ground() => {
                self.contact(0.0, Hint::NONE, None).1 == Proximity::Within { overlapping: true }
            }
            _ => self.overlaps(),
        }
    }

    /// Like [`overlaps`](Self::overlaps), with the tier of precision that settled it.
    ///
    /// ```
    /// use asunder::{Cuboid, Pair3, Pose3, Shape3, Tier, glam::{Quat, Vec3}};
    /// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
    /// let tilted = Quat::from_xyzw(1.0, 2.0, 3.0, 4.0);
    /// let (here, there) = (Pose3::new(Vec3::ZERO, tilted)?, Pose3::new(Vec3::new(2.0, 0.0, 0.0), tilted)?);
    /// assert_eq!(Pair3::new(&cube, &here, &cube, &there).verdict().tier, Tier::Bound);
    /// let next = Pose3::at([2.0, 0.0, 0.0])?;
    /// let touching = Pair3::new(&cube, &Pose3::IDENTITY, &cube, &next).verdict();
    /// assert_eq!((touching.overlapping, touching.tier), (true, Tier::Exact));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn verdict(&self) -> Verdict {
        match self.cuboids().and_then(|cuboids| cuboids.overlaps()) {
            Some(overlapping) => Verdict { overlapping, tier: Tier::Bound },
            None => self.general_verdict(),
        }
    }

    fn general_verdict(&self) -> Verdict {
        if let Some(found) = self.verdict_in_closed_form() {
            return found;
        }
        let mut tier = Tier::Bound;
        if self.gap_of_spheres() > 0.0 {
            return Verdict { overlapping: false, tier };
        }
        if let Some(on) = OnGround::of(self) {
            return self.verdict_on(&on);
        }
        let overlapping = self.any(0.0, |parts| {
            let verdict = parts.convex.verdict();
            tier = tier.max(verdict.tier);
            verdict.overlapping
        });
        Verdict { overlapping, tier }
    }

    /// The overlap as decided by the first tier alone, right or wrong: by the sign of its numbers. Always by the
    /// general kernels, also for cuboids, whose own kernels have overtaken those.
    ///
    /// It is meant for measurements: the difference in time to [`overlaps`](Self::overlaps) is the cost of certainty.
    ///
    /// ```
    /// use asunder::{Pair3, Pose3, Shape3, Sphere};
    /// let ball = Shape3::from(Sphere::new(1.0)?);
    /// let (here, there) = (Pose3::IDENTITY, Pose3::at([3.0, 0.0, 0.0])?);
    /// let pair = Pair3::new(&ball, &here, &ball, &there);
    /// assert_eq!((pair.guess(), pair.overlaps()), (false, false), "far from touching they agree");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn guess(&self) -> bool {
        if let Some(on) = OnGround::of(self) {
            return self.guess_on(&on);
        }
        self.any(0.0, |parts| parts.convex.guess())
    }

    /// The separation, exact up to its error where it is at most `limit` metres, which may be infinite.
    ///
    /// - Beyond the limit it may stop at any axis along which the shapes are that far apart, with
    ///   [`Separation3::AtLeast`]. A NaN counts as no limit, and a negative limit as zero.
    /// - Two half-spaces have separation -inf unless their normals are exactly opposite.
    /// - For ground it is the least of all triangles' separations. In overlap it is the depth in the deepest single
    ///   triangle, from whichever side is nearer: to push a body out, use [`manifolds`](Self::manifolds), which take
    ///   the surrounding ground into account.
    ///
    /// Cost:
    /// - Cuboids: fifteen axes.
    /// - Two hulls: linear in faces, edges and vertices, plus the pairs of those that culling leaves.
    /// - In a gap: a few support searches, for the Euclidean distance.
    /// - Ground, nearest triangles first, through the tree: logarithmic in its triangles for shapes that are apart,
    ///   linear for a half-space; two grounds: the same for each triangle of one that is near the other.
    pub fn separation(&self, limit: f32) -> Separation3 {
        let limit = limit_of(limit);
        if let Some(found) = self.cuboids().and_then(|cuboids| cuboids.separation(limit)) {
            return found;
        }
        if let Some(found) = self.separation_in_closed_form(limit) {
            return found;
        }
        if let Some(on) = OnGround::of(self) {
            return self.separation_on(&on, limit);
        }
        let measured = |parts: &Parts, near: &Near| Measured3 {
            separation: near.separation,
            error: near.error,
            normal: parts.basis.turn(near.normal).as_vec3(),
        };
        match self.nearest(limit, measured) {
            Ok(measured) => Separation3::Measured(measured),
            Err(at_least) => Separation3::AtLeast(at_least),
        }
    }

    /// The closest points of shapes that do not overlap; `None` if they do. Cost: some support searches, each linear in
    /// the vertices.
    pub fn distance(&self) -> Option<Closest3> {
        if let Some(found) = self.distance_in_closed_form() {
            return found;
        }
        if let Some(on) = OnGround::of(self) {
            return self.distance_on(&on);
        }
        if let Some(cuboids) = self.cuboids() {
            return cuboids.distance().unwrap_or_else(|| self.wholes().look_closer(f64::INFINITY).ok()?);
        }
        if !self.is_compound() {
            return self.wholes().closest(f64::INFINITY).ok()?;
        }
        let bases = self.bases();
        let mut least = Least::within(f64::INFINITY);
        self.visit_nearest(&bases, &mut least, |least, [a, b]| {
            !least.passes_over(self.gap(&a, &b)) && {
                let found = self.parts(&bases, a, b).closest(least.reach());
                least.offer_closest(found, |found| [found.distance, found.error])
            }
        });
        let (found, error) = least.finish().ok()?;
        Some(Closest3 { error, ..found? })
    }

    /// The contact manifold, if the shapes are at most `margin` metres apart; a margin below zero, or NaN, counts as
    /// zero.
    ///
    /// A point may be up to the margin outside. For compounds this is the manifold of the deepest pair of parts;
    /// [`Pair3::manifolds`] returns them all. `None` for two half-spaces whose overlap is unbounded. Cost: that of the
    /// separation, plus clipping two faces.
    pub fn manifold(&self, margin: f32) -> Option<Manifold3> {
        let mut hint = Hint::NONE;
        if let Some(cuboids) = self.cuboids() {
            let mut manifold = Manifold3::BLANK;
            match cuboids.contact(reach_of(margin), Hint::NONE, Some(&mut manifold)) {
                Contact::Apart(..) => return None,
                Contact::Touching(_) | Contact::Near(_) => return Some(manifold),
                Contact::Unclear(better) => hint = better,
            }
        }
        let mut deepest = Deepest(None);
        let _ = self.general_contact(margin, hint, &mut deepest);
        deepest.0
    }

    /// One manifold for each pair of convex parts at most `margin` metres apart, in order of the parts: at most one
    /// unless a shape is a compound.
    ///
    /// ```
    /// use asunder::{Compound3, HalfSpace, Pair3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let ball = Shape3::from(Sphere::new(0.5)?);
    /// let dumbbell: Shape3 =
    ///     Compound3::new([(Pose3::at(Vec3::X)?, ball.clone()), (Pose3::at(Vec3::NEG_X)?, ball)])?.into();
    /// let floor = Shape3::from(HalfSpace::new(Vec3::Y)?);
    /// let (here, above) = (Pose3::IDENTITY, Pose3::at([0.0, 0.5, 0.0])?);
    /// let manifolds = Pair3::new(&floor, &here, &dumbbell, &above).manifolds(0.0);
    /// assert_eq!(manifolds.iter().map(|manifold| manifold.part_b).collect::<Vec<_>>(), [0, 1]);
    /// assert_eq!(manifolds[1].points[0].anchor_b, Vec3::new(-1.0, -0.5, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn manifolds(&self, margin: f32) -> Vec<Manifold3> {
        let mut manifolds = Vec::new();
        let _ = self.contact(margin, Hint::NONE, Some(&mut manifolds));
        manifolds
    }

    /// Like [`Pair3::manifolds`], but one by one: for code that runs every frame and has no list. The memory is kept
    /// per thread.
    ///
    /// ```
    /// use asunder::{HalfSpace, Pair3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let (ball, floor) = (Shape3::from(Sphere::new(0.5)?), Shape3::from(HalfSpace::new(Vec3::Y)?));
    /// let (here, above) = (Pose3::IDENTITY, Pose3::at([0.0, 0.5, 0.0])?);
    /// let mut deepest = f32::INFINITY;
    /// Pair3::new(&floor, &here, &ball, &above)
    ///     .visit_manifolds(0.0, |manifold| deepest = deepest.min(manifold.separation));
    /// assert_eq!(deepest, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visit_manifolds(&self, margin: f32, visitor: impl FnMut(&Manifold3)) {
        with_manifolds3(self, margin, |manifolds| manifolds.iter().for_each(visitor));
    }

    /// Returns the hint for the next frame, and how near they are. Adds manifolds to the list if there is one.
    #[inline]
    pub(crate) fn contact(
        &self,
        margin: f32,
        hint: Hint,
        mut manifolds: Option<&mut Vec<Manifold3>>,
    ) -> (Hint, Proximity) {
        let Some(cuboids) = self.cuboids() else {
            return self.general_contact(margin, hint, &mut manifolds);
        };
        let reach = reach_of(margin);
        let contact = match &mut manifolds {
            None => cuboids.contact(reach, hint, None),
            Some(manifolds) => in_place(manifolds, |manifold| cuboids.contact(reach, hint, manifold)),
        };
        match contact {
            Contact::Apart(hint, beyond) => (hint, Proximity::Beyond(beyond)),
            Contact::Touching(hint) => (hint, Proximity::Within { overlapping: true }),
            Contact::Near(hint) => (hint, Proximity::Within { overlapping: false }),
            Contact::Unclear(hint) => self.general_contact(margin, hint, &mut manifolds),
        }
    }

    pub(crate) fn general_contact(
        &self,
        margin: f32,
        hint: Hint,
        manifolds: &mut impl Room,
    ) -> (Hint, Proximity) {
        if let Some(found) = self.contact_in_closed_form(margin, manifolds) {
            return (Hint::NONE, found);
        }
        if let Some(on) = OnGround::of(self) {
            return (Hint::NONE, Proximity::of(self.contact_on(&on, [margin, 0.0], manifolds)));
        }
        let (margin, reach) = (margin.max(0.0), reach_of(margin));
        let gap = self.gap_of_spheres();
        if gap > reach {
            return (hint, Proximity::Beyond(beyond(gap, reach)));
        }
        let wanted = if manifolds.is_wanted() { Wanted::Points } else { Wanted::Number };
        let query = Query { limit: reach, hint, wanted };
        if self.is_compound() {
            return self.contact_of_parts(query, margin, manifolds);
        }
        let (hint, found) = self.wholes().contact(query, margin, manifolds);
        (
            hint,
            found
                .map_or_else(Proximity::Beyond, |found| Proximity::Within { overlapping: found.overlapping }),
        )
    }

    /// Applies `report` to the pair of parts with the least separation, or returns a bound if all are beyond the limit.
    /// A callback, since the data of a pair is a kilobyte: with that returned, closest points of hulls took 1.13 times
    /// as long.
    fn nearest<R>(&self, limit: f64, report: impl FnOnce(&Parts<'a>, &Near) -> R) -> Result<R, f32> {
        let gap = self.gap_of_spheres();
        if gap > limit {
            return Err(round_down(gap));
        }
        let wanted = Wanted::Number;
        if !self.is_compound() {
            let parts = self.wholes();
            return match parts.convex.probe(Query { limit, hint: Hint::NONE, wanted }) {
                Probe::Beyond(at_least, _) => Err(at_least),
                Probe::Near(near) => Ok(report(&parts, &near)),
            };
        }
        let mut least = Least::within(limit);
        let bases = self.bases();
        let visit = |least: &mut Least<_>, [a, b]: [Part<'a>; 2]| {
            if !least.passes_over(self.gap(&a, &b)) {
                let parts = self.parts(&bases, a, b);
                let query = Query { limit: least.reach(), hint: Hint::NONE, wanted };
                match parts.convex.probe(query) {
                    Probe::Beyond(at_least, _) => least.give_up(at_least),
                    Probe::Near(near) => {
                        let (separation, error) = (near.separation, near.error);
                        least.offer((parts, near), separation, error);
                    }
                }
            }
            false
        };
        self.visit_nearest(&bases, &mut least, visit);
        let ((parts, mut near), error) = least.finish()?;
        near.error = error;
        Ok(report(&parts, &near))
    }

    /// Whether the answer is yes for any pair of parts whose bounding spheres are at most `within` apart.
    fn any(&self, within: f64, mut test: impl FnMut(&Parts<'a>) -> bool) -> bool {
        if !self.is_compound() {
            return test(&self.wholes());
        }
        let bases = self.bases();
        let whole_b = Part::whole(self.shape_b, &bases[1]);
        let is_far = |a: &Part, b: &Part| self.gap(a, b) > within;
        let beside_b = || self.around_b(&whole_b, within);
        for_parts_near(self.shape_a, &bases[0], beside_b, |a| {
            let beside_a = || self.around_a(&a, within);
            let test = |b| !is_far(&a, &b) && test(&self.parts(&bases, a, b));
            !is_far(&a, &whole_b) && for_parts_near(self.shape_b, &bases[1], beside_a, test)
        })
    }

    /// Both bodies' axes in the world.
    pub(crate) fn bases(&self) -> [Basis3; 2] {
        [self.pose_a.basis(), self.pose_b.basis()]
    }

    fn is_compound(&self) -> bool {
        matches!(self.shape_a, Shape3::Compound(_)) || matches!(self.shape_b, Shape3::Compound(_))
    }

    /// A lower bound on the separation: the gap between spheres about the bodies' positions, less a bound on its
    /// rounding. Needs no rotation.
    pub(crate) fn gap_of_spheres(&self) -> f64 {
        // A sum of coordinates bounds a length from above, and needs no root.
        let radius = |shape: &Shape3| {
            f64::from(shape.outer_radius()) + f64::from(shape.center().abs().element_sum().next_up())
        };
        let (apart, radii) = (self.between.length(), radius(self.shape_a) + radius(self.shape_b));
        apart - radii - 16.0 * f64::EPSILON * (apart + radii)
    }

    /// A lower bound on the separation of two parts: the gap between their bounding spheres, less a bound on its
    /// rounding.
    fn gap(&self, a: &Part, b: &Part) -> f64 {
        let apart = (self.between + b.center - a.center).length();
        let radii = f64::from(a.shape.outer_radius()) + f64::from(b.shape.outer_radius());
        let reach = self.between.length() + a.center.length() + b.center.length() + radii;
        apart - radii - 64.0 * f64::EPSILON * reach
    }

    /// The sum of the lengths of the vectors that add up to the offset between two parts of compounds; zero for whole
    /// shapes, whose offset is a single vector.
    fn summed(&self, shift_a: DVec3, shift_b: DVec3) -> f64 {
        if self.is_compound() { self.between.length() + shift_a.length() + shift_b.length() } else { 0.0 }
    }
}

/// The limit as f64: a NaN counts as no limit, and a negative limit as zero.
#[inline]
pub(crate) fn limit_of(limit: f32) -> f64 {
    if limit.is_nan() { f64::INFINITY } else { f64::from(limit).max(0.0) }
}

/// How far apart shapes may be for a contact: a separation that rounds to the margin counts as within it, since the
/// reported number decides.
#[inline]
pub(crate) fn reach_of(margin: f32) -> f64 {
    margin.max(0.0).next_up().into()
}
