//! Casts in space: when a shape that moves first touches another.
//!
//! | pair | without turning | where |
//! |---|---|---|
//! | any | bounding spheres that never meet: no; else from where they meet to where they part | `Stretch::of_spheres` |
//! | sphere, sphere | just that: they are their own bounding spheres | `balls` |
//! | cuboid, cuboid | fifteen axes at once, the latest entry | [`boxes`] |
//! | half-space, any other | one height | [`onto_plane`] |
//! | cuboid, any other that comes down on its face | the same | [`onto_plane`] |
//! | any two cores | one simplex all the way | [`march`] |
//! | ground | its triangles: one height, or each as any two; which normal counts | [`ground`] |
//! | what has many parts, and turns | those that may meet on the way, in straight legs | [`legs`] |
//! | what is touched already, and has parts | those that are not, and not level with it | [`beyond`] |
//! | two half-spaces; touching at the start; stalling; all that turns | distances and steps, in turns | [`advance`] |
//!
//! What each step brought: parry3d's time over ours in one run each, a quarter of the motions passing by (AMD EPYC, Zen
//! 4, 2026-11-21, two cores with much else on them: to some 10 %):
//!
//! | | sphere | capsule | cuboid | hull of 32 |
//! |---|---|---|---|---|
//! | cast, each by distances and steps | 0.06 | 2.6 | 0.25 | 0.41 |
//! | each pair by its own means | 0.6 | 2.5 | 2.1 | 1.0 |
//! | spheres without axes; supports in f32 again wherever the gap is clear, not only at first | 1.1 | 4.0 | 3.4 | 1.1 |
//! | ray, of unit length, sphere tested first | 0.41 | 0.67 | 0.66 | 4.2 |
//! | as it is given, roots for hits alone | 1.7 | 1.2 | 1.1 | 5.4 |

mod advance;
mod beyond;
mod boxes;
mod counts;
mod ground;
mod legs;
mod march;
mod onto_plane;
mod parting;
mod passage;
mod ray;
#[cfg(test)]
mod tests;

use crate::answer::{Manifold3, Separation3};
use crate::ground3::OnGround;
use crate::impact3::Impact3;
use crate::pair3::{Pair3, Part};
use crate::touch::Touch3;
use advance::{End, Met, advance};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Motion3, Shape3};
use beyond::with_touched;
use counts::Counts;
use march::march;
use passage::{Course, Passage, Stretch, rounding_past};
pub use ray::cast_ray3;

impl Pair3<'_> {
    /// The first touch of A, moved by a displacement in metres, with B, which stands still; `None` if there is none.
    ///
    /// - Up to the reported fraction the shapes certainly do not touch, nor do they in poses that are moved by it and
    ///   rounded to f64. At the fraction they are at most `error` apart: at most 1e-6 of the size of the parts that
    ///   meet for round shapes, and 4e-9 for others, plus rounding; more only where the displacement is so long or the
    ///   bodies so far from the origin that f64 cannot represent a nearer place.
    /// - A miss is certain too. Shapes that pass each other within `error` may be reported as an impact. Shapes that
    ///   move apart are not, however near they are, so that a shape which a cast has brought up to another may leave
    ///   it. Rare exceptions: shapes that leave an edge or a corner less than 1e-12 of the larger size away, or a shape
    ///   some ten thousand times as large as themselves.
    /// - Shapes that touch at the start, exactly, are reported as such, even when they move apart: compare the normal
    ///   with the displacement. Two half-spaces whose overlap is unbounded then have no depth: the normal is that of A,
    ///   and both anchors are the bodies' positions.
    /// - A shape that starts nearer to one part than positions round to, and moves along it, may overlap that part, by
    ///   rounding, on its way and where another part stops it.
    /// - A displacement that is not finite counts as zero: shapes that touch are reported, unlike by a world's
    ///   `cast_shape`.
    /// - A compound is met at the parts that touch first.
    ///
    /// Ground is met at its first triangle on the way; `part_b` (or `part_a`) is its number.
    ///
    /// - One-sided ground stops exactly the parts whose centre is in front of a triangle at the start, however fast
    ///   they are. A part touches at the start only if it overlaps a triangle in front of which it is.
    /// - A part that rises through one-sided ground passes the edges of triangles from whose fronts it moves away.
    /// - The normal is the triangle's, except where an edge or vertex stands out of the ground around it.
    ///
    /// Cost: two roots for spheres, fifteen axes for cuboids, a height or three for what comes down on the face of a
    /// cuboid, some ten support searches of both for others. On ground: a height for each triangle whose box the moved
    /// part's box meets and whose plane it reaches, and that search for those among them that may be touched before the
    /// one on whose inside the part comes down; for ground that turns, and for half-spaces, for every triangle.
    ///
    /// ```
    /// use asunder::{Cuboid, Pair3, Pose3, Shape3, glam::Vec3};
    /// let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5))?);
    /// let (here, there) = (Pose3::IDENTITY, Pose3::at([5.0, 0.25, 0.0])?);
    /// let pair = Pair3::new(&cube, &here, &cube, &there);
    /// let impact = pair.cast(Vec3::X * 16.0).ok_or("it is in the way")?;
    /// assert!((impact.fraction - 0.25).abs() < 1e-9 && impact.normal == Vec3::X);
    /// assert_eq!(pair.cast(Vec3::NEG_X), None);
    /// let start = Pair3::new(&cube, &here, &cube, &here).cast(Vec3::X).ok_or("they overlap")?;
    /// assert!(start.overlapping && start.fraction == 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast(&self, displacement: Vec3) -> Option<Impact3> {
        let drift = if displacement.is_finite() { displacement.as_dvec3() } else { DVec3::ZERO };
        if let (Shape3::Sphere(a), Shape3::Sphere(b)) = (self.shape_a, self.shape_b) {
            // Spheres need no axes.
            let radii = [a.radius(), b.radius()].map(f64::from);
            let centers = [DVec3::ZERO; 2];
            let [from, to] = centers;
            let rounding = rounding_past(self, drift);
            let both = (radii[0] + radii[1], rounding);
            let stretch = Stretch::of_spheres([from, to, self.between], both, drift, 1.0)?;
            if let Some(met) = balls(&stretch, drift, radii, centers, rounding) {
                return Some(impact_of(&met, [0, 0]));
            }
        }
        self.first_touch(&Passage::straight(self, drift))
    }

    /// The first touch of two bodies that both move and may turn; `None` if there is none.
    ///
    /// Like [`cast`](Self::cast), but along the path that [`Motion3`] describes: up to the reported fraction the shapes
    /// do not touch on that path, nor in the poses that [`Motion3::pose_at`] gives, which rounds positions to f64 and
    /// rotations to f32.
    ///
    /// - At the fraction they are at most `error` apart. If a body turns, and is not a sphere about its position, that
    ///   is no less than 1.2e-7 of its arm.
    /// - Shapes that are nearer than that rounding at the start may move apart or along each other, and poses on the way
    ///   may then overlap by rounding. If they move towards each other, the fraction is 0.
    /// - If many steps bring the shapes no nearer, as when they graze each other while they turn, the fraction is that
    ///   of the last step, and `error` the gap that is left there.
    ///
    /// Cost: a few distances; several times those of a [`cast`](Self::cast) while turning; for compounds, that for
    /// every pair of parts whose bounding spheres meet on the way.
    ///
    /// ```
    /// use asunder::{Cuboid, Motion3, Pair3, Pose3, Shape3, Sphere, glam::{Quat, Vec3}};
    /// let rod = Shape3::from(Cuboid::from_half_extents(Vec3::new(2.0, 0.1, 0.1))?);
    /// let ball = Shape3::from(Sphere::new(0.2)?);
    /// let (here, beside) = (Pose3::IDENTITY, Pose3::at([0.0, 1.5, 0.0])?);
    /// let (quarter, still) =
    ///     (Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 1.0))?, Motion3::shift(Vec3::ZERO)?);
    /// let pair = Pair3::new(&rod, &here, &ball, &beside);
    /// let impact = pair.impact(&quarter, &still).ok_or("it turns into the ball")?;
    /// // 0.3 m before it points at the ball's centre, 1.5 m out.
    /// let angle = 2.0 * (impact.fraction * 0.5_f64.sqrt()).atan2(1.0 - impact.fraction * (1.0 - 0.5_f64.sqrt()));
    /// assert!((1.5 * angle.cos() - 0.3).abs() < 1e-5);
    /// assert_eq!(pair.impact(&still, &still), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn impact(&self, motion_a: &Motion3, motion_b: &Motion3) -> Option<Impact3> {
        self.first_touch(&Passage::of_motions(self, [motion_a, motion_b]))
    }

    /// The next impact of bodies that may already touch: like [`impact`](Self::impact), but parts that they touch at
    /// the start are passed over.
    ///
    /// Parts of ground and of compounds that touch at the start are left out, and so are parts that are level with
    /// them. So a ball that its weight presses on a level's floor crosses the floor's seams and still runs into the
    /// level's walls, steps and ramps.
    ///
    /// - A part is level if, along the normal of the impact with it, it is at most a 64th of the body's thickness away
    ///   at the start and the motion leads at most that far into it, not counting the depth to which the motion leads
    ///   into the touched parts anyway. The thickness is the radius of a ball inside the body, about its centre.
    /// - If a body turns, the two may overlap along that normal at the start, deeper than the contacts account for,
    ///   since another axis separates them. Then the motion into the part counts from where they meet.
    /// - A part of a compound is level, too, if it is flush with a touched one, as long as the body never sinks deeper
    ///   below that than half its thickness.
    /// - A motion that sinks a body into its floor by its whole thickness leads it under the obstacles that stand
    ///   there.
    /// - Where ground is touched at two places, and only one of them has a contact, going into the other is an impact
    ///   at the start: a ball in a hollow has a contact with one side, and rolls into the other. Its anchors may be off
    ///   by up to half the thickness.
    /// - `None` for bodies of one part each that touch. Never `overlapping`.
    ///
    /// Cost: that of the impact, which is tested first; for bodies that touch, also their manifolds and another search.
    ///
    /// ```
    /// use asunder::{Compound3, Cuboid, Motion3, Pair3, Pose3, Shape3, Sphere, glam::Vec3};
    /// let slab = Shape3::from(Cuboid::from_half_extents(Vec3::new(9.0, 1.0, 9.0))?);
    /// let wall = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.1, 4.0, 9.0))?);
    /// let yard: Shape3 =
    ///     Compound3::new([(Pose3::at([0.0, -1.0, 0.0])?, slab), (Pose3::at([5.0, 0.0, 0.0])?, wall)])?.into();
    /// let (ball, on_floor) = (Shape3::from(Sphere::new(0.5)?), Pose3::at([0.0, 0.5, 0.0])?);
    /// let (kick, still) = (Motion3::shift([20.0, -0.1, 0.0])?, Motion3::STILL);
    /// let pair = Pair3::new(&ball, &on_floor, &yard, &Pose3::IDENTITY);
    /// assert!(pair.impact(&kick, &still).is_some_and(|impact| impact.overlapping), "with the floor");
    /// let wall = pair.next_impact(&kick, &still).ok_or("the wall is in the way")?;
    /// assert!(wall.normal.abs_diff_eq(Vec3::X, 1e-6) && (wall.fraction * 20.0 - 4.4).abs() < 1e-4);
    /// assert_eq!(pair.next_impact(&Motion3::shift([4.0, -0.1, 0.0])?, &still), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn next_impact(&self, motion_a: &Motion3, motion_b: &Motion3) -> Option<Impact3> {
        self.next_impact_beside(&[], motion_a, motion_b)
    }

    /// [`next_impact`](Self::next_impact) of a body A that also touches other bodies: parts that are flush with those
    /// are passed over as well, such as the next of the tiles of a floor. Parts of ground that A touches too are not
    /// passed over: ground has no such seams.
    ///
    /// - Flush means: rising above the touched body by no more than a 64th of the thickness of the thinner part, while
    ///   A never sinks below it by more than half that thickness. A body that is stuck deeper is stopped as usual.
    /// - This is judged by the poses of the two at the start, and later motion of B counts as sinking: a body that was
    ///   flush and swings or rises into A, by less than that half, has no impact, but a contact once it is there.
    /// - Half-spaces are never flush.
    /// - A touch whose axis is not of length 1 is ignored.
    ///
    /// Cost: as the next impact; where there is one, another search.
    ///
    /// ```
    /// use asunder::{Cuboid, Motion3, Pair3, Pose3, Shape3, Sphere, Touch3, glam::Vec3};
    /// let (ball, tile) = (Shape3::from(Sphere::new(0.5)?), Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?));
    /// // A millimetre in a tile whose top is at height 0, and 1 m before the next.
    /// let (from, way) = (Pose3::at([0.0, 0.499, 0.0])?, Motion3::shift([3.0, 0.0, 0.0])?);
    /// let stands = Touch3 { normal: Vec3::NEG_Y, separation: -0.001 };
    /// let meets = |height: f64| {
    ///     let next = Pose3::at([2.0, height - 1.0, 0.0])?;
    ///     let pair = Pair3::new(&ball, &from, &tile, &next);
    ///     Ok::<_, asunder::PoseError>(pair.next_impact_beside(&[stands], &way, &Motion3::STILL).is_some())
    /// };
    /// // As high as the one that it stands on, a little higher, and too high.
    /// assert_eq!([meets(0.0)?, meets(0.005)?, meets(0.02)?], [false, false, true]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn next_impact_beside(
        &self,
        touches: &[Touch3],
        motion_a: &Motion3,
        motion_b: &Motion3,
    ) -> Option<Impact3> {
        let passage = Passage::of_motions(self, [motion_a, motion_b]);
        let first = self.first_touch(&passage)?;
        let do_touch = first.overlapping;
        if !do_touch && touches.is_empty() {
            return Some(first);
        }
        let has_parts = |shape: &Shape3| shape.is_ground() || matches!(shape, Shape3::Compound(_));
        if do_touch && (passage.is_still() || !has_parts(self.shape_a) && !has_parts(self.shape_b)) {
            return None;
        }
        with_touched(self, (do_touch, touches), |touched| match OnGround::of(self) {
            Some(on) => {
                let first = self.first_touch_on(&on, &passage, Counts::Beyond(touched));
                if !do_touch {
                    return first;
                }
                self.across((&on, &passage), [motion_a, motion_b], touched, first.as_ref()).or(first)
            }
            None => self.first_touch_of_parts(&passage, Counts::Beyond(touched)),
        })
    }

    fn first_touch(&self, passage: &Passage) -> Option<Impact3> {
        if let Some(on) = OnGround::of(self) {
            return self.first_touch_on(&on, passage, Counts::All);
        }
        if passage.is_straight()
            && let Some(end) = self.end_on_plane(passage)
        {
            return end;
        }
        // Where a closed form says so in a tenth of the time, shapes that touch already need no search on their way.
        if self.verdict_in_closed_form().is_some_and(|verdict| verdict.overlapping) {
            return Some(self.touching_at_start());
        }
        let are_planes = |shape: &Shape3| matches!(shape, Shape3::HalfSpace(_));
        // Half-spaces that overlap only far out look separate from near.
        if passage.is_still() || are_planes(self.shape_a) && are_planes(self.shape_b) {
            if self.overlaps() {
                return Some(self.touching_at_start());
            }
            if passage.is_still() {
                return None;
            }
        }
        self.first_touch_of_parts(passage, Counts::All)
    }

    /// The first touch with a half-space, in closed form; `None` unless the other is certainly apart from it at the
    /// start.
    fn end_on_plane(&self, passage: &Passage) -> Option<Option<Impact3>> {
        if [self.shape_a, self.shape_b].iter().any(|shape| matches!(shape, Shape3::Compound(_))) {
            return None;
        }
        let whole = |i: usize, shape| Part::whole(shape, &passage.bases[i]);
        match onto_plane::sweep(passage, &[whole(0, self.shape_a), whole(1, self.shape_b)], 1.0)? {
            End::Met(met) => Some(Some(impact_of(&met, [0, 0]))),
            End::Apart => Some(None),
            End::Unclear(..) => None,
        }
    }

    /// The first touch that counts, of all pairs of convex parts.
    fn first_touch_of_parts(&self, passage: &Passage, counts: Counts) -> Option<Impact3> {
        let mut first: Option<Impact3> = None;
        let mut is_overlap_tested = false;
        let whole_b = Part::whole(self.shape_b, &passage.bases[1]);
        let is_many = matches!(self.shape_b, Shape3::Compound(_));
        let overlaps = passage.for_parts_met((self.shape_a, 0), &whole_b, 1.0, |a, from| {
            let until = first.map_or(1.0, |known| known.fraction);
            if from > until || is_many && passage.stretch([&a, &whole_b], until).is_none() {
                return false;
            }
            passage.for_parts_met((self.shape_b, 1), &a, until, |b, from| {
                let until = first.map_or(1.0, |known| known.fraction);
                if from > until {
                    return false;
                }
                let Some(stretch) = passage.stretch([&a, &b], until) else { return false };
                let met = match part_end(passage, [a, b], &stretch, until) {
                    End::Apart => return false,
                    End::Met(met) => met,
                    End::Unclear(met, is_parting) => {
                        if counts.is_all() && !is_overlap_tested && self.overlaps() {
                            return true;
                        }
                        is_overlap_tested = true;
                        let is_touched = || self.parts(&passage.bases, a, b).convex.verdict().overlapping;
                        if !counts.is_all() && is_touched() {
                            return false;
                        }
                        let Some(met) = end_of_apart(passage, [a, b], (met, is_parting), until) else {
                            return false;
                        };
                        met
                    }
                };
                let impact = || impact_of(&met, [a.index, b.index]);
                if first.is_none_or(|known| met.fraction < known.fraction)
                    && counts.admits((passage, [a, b]), (met.fraction, met.normal), impact)
                {
                    first = Some(impact());
                }
                false
            })
        });
        if overlaps { Some(self.touching_at_start()) } else { first }
    }

    /// The impact of shapes that touch before anything has moved.
    fn touching_at_start(&self) -> Impact3 {
        if let Some(manifold) = self.manifold(0.0) {
            return at_start(&manifold);
        }
        let normal = match self.separation(0.0) {
            Separation3::Measured(measured) => measured.normal,
            Separation3::AtLeast(_) => Vec3::X,
        };
        let (anchor_a, anchor_b) = (Vec3::ZERO, Vec3::ZERO);
        let (fraction, error, part_a, part_b) = (0.0, 0.0, 0, 0);
        Impact3 { fraction, error, overlapping: true, normal, anchor_a, anchor_b, part_a, part_b }
    }
}

/// A manifold as an impact, with its deepest point.
fn at_start(manifold: &Manifold3) -> Impact3 {
    let points = manifold.points.iter();
    let deepest = points.reduce(|best, next| if next.separation < best.separation { next } else { best });
    let (anchor_a, anchor_b) =
        deepest.map_or((Vec3::ZERO, Vec3::ZERO), |point| (point.anchor_a, point.anchor_b));
    let Manifold3 { normal, part_a, part_b, .. } = *manifold;
    Impact3 { fraction: 0.0, error: 0.0, overlapping: true, normal, anchor_a, anchor_b, part_a, part_b }
}

/// How the motion of two parts ends, which may touch on a stretch of it.
fn part_end(passage: &Passage, parts: [Part; 2], stretch: &Stretch, until: f64) -> End {
    let quick = match (parts[0].shape, parts[1].shape) {
        _ if !passage.is_straight() => None,
        (Shape3::Sphere(a), Shape3::Sphere(b)) => {
            let (radii, centers) = ([a.radius(), b.radius()].map(f64::from), parts.map(|part| part.center));
            balls(stretch, passage.drift, radii, centers, passage.rounding).map(End::Met)
        }
        (Shape3::Cuboid(a), Shape3::Cuboid(b)) if a.radius() + b.radius() == 0.0 => {
            boxes::sweep(passage, &parts, [a, b], stretch)
        }
        (Shape3::HalfSpace(_), _) | (_, Shape3::HalfSpace(_)) => onto_plane::sweep(passage, &parts, until),
        (_, Shape3::Cuboid(cuboid)) => {
            onto_plane::onto_cuboid(passage, &parts, (cuboid, true), (stretch.from, until))
        }
        (Shape3::Cuboid(cuboid), _) => {
            onto_plane::onto_cuboid(passage, &parts, (cuboid, false), (stretch.from, until))
        }
        _ => None,
    };
    quick.unwrap_or_else(|| by_steps(passage, parts, stretch, until))
}

#[inline(never)]
fn by_steps(passage: &Passage, [a, b]: [Part; 2], stretch: &Stretch, until: f64) -> End {
    let core_a = a.shape.core();
    let core_b = b.shape.core();
    let course = Course::new(passage, [a, b], [&core_a, &core_b]);
    let quick = if passage.is_straight() { march(&course, stretch) } else { None };
    quick.unwrap_or_else(|| advance(&course, until))
}

/// Where two parts meet that do not touch at the start, as an exact test has shown after a search had left it open, and
/// what that had found: [`End::Unclear`]. `None` if they do not meet.
fn end_of_apart(
    passage: &Passage,
    [a, b]: [Part; 2],
    (met, is_parting): (Met, bool),
    until: f64,
) -> Option<Met> {
    if is_parting || passage.is_straight() {
        return (!is_parting).then_some(met);
    }
    let (core_a, core_b) = (a.shape.core(), b.shape.core());
    match advance(&Course::new(passage, [a, b], [&core_a, &core_b]).known_apart(), until) {
        End::Apart => None,
        End::Met(met) | End::Unclear(met, _) => Some(met),
    }
}

/// Two spheres, which are their own bounding spheres; `None` if they all but touch at the start.
fn balls(
    stretch: &Stretch,
    drift: DVec3,
    radii: [f64; 2],
    centers: [DVec3; 2],
    rounding: f64,
) -> Option<Met> {
    if stretch.from <= 0.0 {
        return None;
    }
    let apart = stretch.apart - drift * stretch.from;
    let distance = apart.length();
    let (normal, gap) = (apart / distance, distance - (radii[0] + radii[1]) + stretch.doubt + rounding);
    let anchors = [centers[0] + normal * radii[0], centers[1] - normal * radii[1]];
    Some(Met { fraction: stretch.from, gap: gap.max(0.0), normal, anchors })
}

fn impact_of(met: &Met, [part_a, part_b]: [u32; 2]) -> Impact3 {
    let [anchor_a, anchor_b] = met.anchors.map(|anchor| anchor.as_vec3());
    Impact3 {
        fraction: met.fraction,
        error: (met.gap as f32).next_up(),
        overlapping: false,
        normal: met.normal.as_vec3(),
        anchor_a,
        anchor_b,
        part_a,
        part_b,
    }
}
