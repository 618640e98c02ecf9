//! Rays in space: where one first meets a shape.
//!
//! ```text
//! sphere, capsule     roots of a quadratic, from the foot of the perpendicular                         (round)
//! cuboid, hull        the last plane that the ray enters, if it leaves none before:
//!                     Cyrus and Beck (1978); for a box, slabs                                          (planes)
//! half-space          one quotient                                                                     (planes)
//! triangle            where it meets the plane, and on which side of three edges                       (planes)
//! what is rounded, segments, flat hulls, rims of thin hulls, triangles seen edge on:
//!                     the ray as a point that moves                                                    (advance)
//! compound            the nearest of its parts; of many, nearest box first
//! mesh, height field  the nearest of its triangles                                                     (ground)
//! ```
//! All in f64. Exact arithmetic decides only whether the origin is inside, where it lies within rounding of the
//! surface.
//!
//! What makes it fast:
//!
//! 1. distances are in lengths of the direction as it was given: no root and no division make it of unit length;
//! 2. a sphere is tested in world axes, so that no rotation is converted to a matrix; a capsule turns two vectors out,
//!    a cuboid two in;
//! 3. inside or outside is decided by squares, and a sphere around a hull is passed by the square of a cross product:
//!    roots are taken only for hits, and then the error's together with the distance's;
//! 4. no bounding sphere is tested before a closed form that costs as little.

mod ground;
mod planes;
mod projection;
mod round;
#[cfg(test)]
mod tests;

use super::advance::{End, advance};
use super::passage::{Course, Fineness, Passage, length};
use crate::among::many3;
use crate::exact::{self, Site3};
use crate::impact3::RayHit3;
use crate::pair3::{Pair3, Part, for_parts};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Ground, Pose3, Ray3, Shape3, Sphere};

/// The ray's origin as a shape.
///
/// Not a hull of one vertex: that counts as a micrometre in radius, and the tolerances of casts of small bodies would
/// be those of a larger pair.
static POINT: Shape3 = Shape3::Sphere(Sphere::POINT);

/// A ray seen from a part's origin, in world axes.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// In metres.
    origin: DVec3,
    /// As it was given.
    way: DVec3,
    /// The square of its length.
    squared: f64,
    /// Rounding error of a point on it, up to where it passes the shape, in metres.
    doubt: f64,
}

/// Where a ray meets one part.
#[derive(Clone, Copy, Debug)]
enum Meeting {
    Never,
    /// At a distance in lengths of the direction, with the surface's outward normal in world axes, and the error in
    /// metres along the ray.
    At(f64, DVec3, f64),
    /// It starts inside.
    Inside,
    /// Rounding leaves open whether it starts inside; and if it does not, whether it meets the part at once.
    Unclear,
    /// There is no closed form.
    Open,
}

/// The first hit of a ray on a posed shape, within `limit` lengths of its direction. The limit may be infinite; a NaN
/// counts as no limit, and a negative limit as zero.
///
/// - An origin inside the shape, or on its surface exactly, is a hit at distance 0.
/// - Else the distance is right up to `error`, in metres along the ray: rounding of f64, some 1e-14 of the distance
///   from the shape and of its size, over the cosine to the normal. For a hull that includes four times the distance of
///   its faces from its vertices ([`planarity_error`](asunder_geometry::Hull::planarity_error)); and if its outer
///   radius is more than four times its inner radius, all of that is multiplied by a quarter of their ratio.
/// - By as much, before it is divided by the cosine, a ray that is reported as a miss may have entered the shape, and
///   one that is reported as a hit may pass beside it. A thin shape (segment, triangle, flat hull) is hit by a ray that
///   passes within rounding.
/// - In a compound it meets the nearest part, but a part inside which it starts comes before any other.
/// - On ground it meets the nearest triangle, but one on which it starts comes before any other; of equals, the one
///   with the lowest number. No ray slips through between two triangles that share an edge or a vertex. From behind, it
///   passes through one-sided triangles.
///
/// Cost: a closed form for spheres, capsules, cuboids, half-spaces and triangles; two dot products a face for hulls; a
/// few distances, about a microsecond, for rounded shapes, for segments and flat hulls, and beside the faces of hulls
/// so thin that their faces' roundings matter.
///
/// ```
/// use asunder::{Cuboid, Pose3, Ray3, Shape3, cast_ray3, glam::{DVec3, Vec3}};
/// let crate_ = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let pose = Pose3::at([10.0, 0.0, 0.0])?;
/// let ray = Ray3::new([0.0, 0.5, 0.0], Vec3::X * 2.0)?;
/// let hit = cast_ray3(&crate_, &pose, &ray, 100.0).ok_or("it is straight ahead")?;
/// assert_eq!((hit.distance, hit.normal, ray.at(hit.distance)), (4.5, Vec3::NEG_X, DVec3::new(9.0, 0.5, 0.0)));
/// assert_eq!(cast_ray3(&crate_, &pose, &ray, 4.25), None, "too far");
/// let within = cast_ray3(&crate_, &Pose3::IDENTITY, &ray, 100.0).ok_or("it starts inside")?;
/// assert!(within.inside && within.distance == 0.0 && within.normal == Vec3::NEG_X);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cast_ray3(shape: &Shape3, pose: &Pose3, ray: &Ray3, limit: f64) -> Option<RayHit3> {
    let way = ray.direction().as_dvec3();
    let cast =
        Cast { shape, pose, ray, way, squared: way.length_squared(), from: ray.origin() - pose.position() };
    let limit = if limit.is_nan() { f64::INFINITY } else { limit.max(0.0) };
    if let Shape3::Sphere(sphere) = shape {
        let radius = f64::from(sphere.radius());
        let meeting = round::sphere(&cast.line(DVec3::ZERO, radius), radius);
        return cast.answer(meeting, limit, || Part::whole(shape, &pose.basis()));
    }
    let basis = pose.basis();
    if let Some(ground) = Ground::of(shape) {
        return cast.over(ground, &basis, limit);
    }
    if !matches!(shape, Shape3::Compound(_)) {
        let meeting = cast.meeting(shape, &basis, DVec3::ZERO, limit);
        return cast.answer(meeting, limit, || Part::whole(shape, &basis));
    }
    cast.over_parts(&basis, limit)
}

/// One ray, one body.
struct Cast<'a> {
    shape: &'a Shape3,
    pose: &'a Pose3,
    ray: &'a Ray3,
    /// The ray's direction, and the square of its length.
    way: DVec3,
    squared: f64,
    /// The ray's origin less the body's position.
    from: DVec3,
}

impl<'a> Cast<'a> {
    /// The ray as seen from a part whose origin is at `shift` from the body's, and which reaches `size` from there.
    #[inline(always)]
    fn line(&self, shift: DVec3, size: f64) -> Line {
        // A subtraction, a rotation of a part or two, and the ray's direction to where it passes.
        let doubt = 64.0 * f64::EPSILON * (length(self.from) + length(shift) + size);
        Line { origin: self.from - shift, way: self.way, squared: self.squared, doubt }
    }

    /// The nearest hit on a compound's parts: if there are few, one after the other; if many, in the order in which
    /// their boxes are met.
    fn over_parts(&self, basis: &Basis3, limit: f64) -> Option<RayHit3> {
        let mut first: Option<RayHit3> = None;
        let mut offer = |part: Part<'a>| {
            let within = first.map_or(limit, |known| known.distance);
            let (axes, shift) = part.placed(basis);
            let meeting = self.meeting(part.shape, &axes, shift, within);
            let hit = self.answer(meeting, within, || part).map(|hit| RayHit3 { part: part.index, ..hit });
            // Of equals, the first; but a part that the ray starts inside of comes before all.
            let place = |hit: &RayHit3| (!hit.inside, hit.distance, hit.part);
            let is_first = |hit: &RayHit3| first.is_none_or(|known| place(hit) < place(&known));
            first = hit.filter(is_first).or(first);
            first.map_or(limit, |known| known.distance)
        };
        let Some(compound) = many3(self.shape) else {
            for_parts(self.shape, basis, |part| {
                offer(part);
                false
            });
            return first;
        };
        let size = f64::from(self.shape.outer_radius()) + length(self.shape.center().as_dvec3());
        // What is met by steps counts as hit from up to some thousand roundings away, where it all but touches the
        // origin.
        let grown = (65536.0 * f64::EPSILON * (length(self.from) + size)) as f32;
        let (from, way) = (basis.turn_back(self.from), basis.turn_back(self.way));
        compound.visit_along(from, way, grown, limit, |index| offer(Part::of(compound, index, basis)));
        first
    }

    /// Where the ray meets a convex shape, given the shape's axes and its origin less the body's position.
    #[inline]
    fn meeting(&self, shape: &Shape3, basis: &Basis3, shift: DVec3, limit: f64) -> Meeting {
        match shape {
            Shape3::Sphere(sphere) => {
                let radius = f64::from(sphere.radius());
                round::sphere(&self.line(shift, radius), radius)
            }
            Shape3::Capsule(capsule) => {
                let size = capsule.outer_radius() + capsule.segment().center().abs().element_sum();
                round::capsule(&self.line(shift, size.into()), basis, capsule)
            }
            Shape3::Cuboid(cuboid) if cuboid.radius() == 0.0 => {
                planes::cuboid(&self.line(shift, cuboid.outer_radius().into()), basis, cuboid)
            }
            Shape3::HalfSpace(half_space) => planes::half_space(&self.line(shift, 0.0), basis, half_space),
            _ => self.beyond_sphere(shape, basis, shift, limit),
        }
    }

    /// The same for shapes whose bounding sphere is worth testing first.
    fn beyond_sphere(&self, shape: &Shape3, basis: &Basis3, shift: DVec3, limit: f64) -> Meeting {
        let (radius, center) = (f64::from(shape.outer_radius()), shape.center().as_dvec3());
        let line = self.line(shift, radius + length(center));
        let away = basis.turn(center) - line.origin;
        let reach = radius + line.doubt;
        let ahead = away.dot(line.way);
        let too_far = ahead - limit * line.squared;
        let is_past = |squared: f64| squared > reach * reach * line.squared;
        if away.length_squared() > reach * reach
            && (ahead <= 0.0
                || is_past(away.cross(line.way).length_squared())
                || too_far > 0.0 && is_past(too_far * too_far))
        {
            return Meeting::Never;
        }
        match shape {
            Shape3::Hull(hull) if hull.radius() == 0.0 && hull.dimension() == 3 => {
                planes::hull(&line, basis, hull, &shape.core())
            }
            Shape3::Triangle(triangle) => planes::triangle(&line, basis, triangle),
            _ => Meeting::Open,
        }
    }

    /// The hit that is reported for a meeting with a part, if it is within the limit.
    #[inline]
    fn answer(&self, meeting: Meeting, limit: f64, part: impl FnOnce() -> Part<'a>) -> Option<RayHit3> {
        match meeting {
            Meeting::Unclear | Meeting::Open => {
                let hit = self.by_steps(&part(), matches!(meeting, Meeting::Unclear));
                hit.filter(|hit| hit.distance <= limit)
            }
            closed => self.hit_in_closed_form(closed, limit),
        }
    }

    /// The same for a meeting in closed form.
    #[inline(always)]
    fn hit_in_closed_form(&self, meeting: Meeting, limit: f64) -> Option<RayHit3> {
        match meeting {
            Meeting::At(distance, normal, error) if distance <= limit => Some(RayHit3 {
                distance,
                error: (error as f32).next_up(),
                normal: normal.as_vec3(),
                inside: false,
                part: 0,
            }),
            Meeting::Inside => Some(self.inside()),
            _ => None,
        }
    }

    /// The hit of a ray that starts in the shape.
    fn inside(&self) -> RayHit3 {
        let normal = (self.way / -self.squared.sqrt()).as_vec3();
        RayHit3 { distance: 0.0, error: 0.0, normal, inside: true, part: 0 }
    }

    /// Whether the ray's origin is in a part, exactly.
    fn is_inside(&self, part: &Part) -> bool {
        let Ok(origin) = Pose3::at(self.ray.origin()) else { return false };
        exact::overlaps3([&part.site(self.pose), &Site3 { shape: &POINT, body: origin, part: None }], &[])
    }

    /// The ray as a point that moves until it touches.
    #[inline(never)]
    fn by_steps(&self, part: &Part, is_unclear: bool) -> Option<RayHit3> {
        if is_unclear && self.is_inside(part) {
            return Some(self.inside());
        }
        let Ok(origin) = Pose3::at(self.ray.origin()) else { return None };
        let (pace, radius) = (self.squared.sqrt(), f64::from(part.shape.outer_radius()));
        let unit = self.way / pace;
        let beyond = length(part.center - self.from) + radius;
        // Independent of the limit, which must not change the answer. A half-space comes here only if the ray starts on
        // its surface.
        let far = if radius.is_finite() { beyond * 1.0625 } else { 1.0 };
        let pair = Pair3::new(&POINT, &origin, self.shape, self.pose);
        let passage = Passage { rounding: 0.0, ..Passage::straight(&pair, unit * far) };
        let (core_point, core) = (POINT.core(), part.shape.core());
        let parts = [Part::whole(&POINT, &passage.bases[0]), *part];
        let course = Course::new(&passage, parts, [&core_point, &core]).refined_to(Fineness::FINEST);
        let met = match advance(&course, 1.0) {
            End::Apart => return None,
            End::Unclear(..) if self.is_inside(part) => return Some(self.inside()),
            End::Unclear(_, true) => return None,
            End::Unclear(met, false) | End::Met(met) => met,
        };
        let steep = met.normal.dot(unit).abs();
        let error = if met.gap <= steep * radius { met.gap / steep } else { 2.0 * radius };
        // Where the ray starts within rounding of the surface, the axis may be rounding too.
        let normal = if met.normal.dot(unit) < 0.0 { -unit } else { -met.normal };
        Some(RayHit3 {
            distance: met.fraction * far / pace,
            error: ((error + 4.0 * f64::EPSILON * far) as f32).next_up(),
            normal: normal.as_vec3(),
            inside: false,
            part: 0,
        })
    }
}

impl Line {
    fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.way * distance
    }

    /// Rounding error of a point on the ray at a distance, and the direction's length, both in metres.
    #[inline(always)]
    fn doubt_at(&self, distance: f64) -> (f64, f64) {
        let pace = self.squared.sqrt();
        (self.doubt + 64.0 * f64::EPSILON * distance * pace, pace)
    }

    /// The error of a distance to a plane: `closing` is how fast the ray approaches it, `off` the plane's own error.
    #[inline(always)]
    fn error(&self, distance: f64, closing: f64, off: f64) -> f64 {
        let (doubt, pace) = self.doubt_at(distance);
        (doubt + off) * (pace / closing)
    }
}
