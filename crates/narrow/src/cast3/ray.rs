//! Rays in space: where one first meets a shape.
//!
//! ```text
//! sphere, capsule     roots of a quadratic, from the foot of the perpendicular                         (round)
//! cuboid, hull        where the ray enters the last of the planes that it enters, if it leaves none before:
//!                     Cyrus and Beck (1978); for a box, slabs                                          (planes)
//! half-space          one quotient                                                                     (planes)
//! triangle            where it meets the plane, and on which side of three edges                       (planes)
//! what is rounded, segments, flat hulls, triangles seen edge on:
//!                     the ray as a point that moves                                                    (advance)
//! compound            the nearest of its parts
//! ```
//! All in f64, in the shape's own axes. Only whether the origin is inside is asked of exact arithmetic, where it lies within
//! rounding of the surface. One ray against a cuboid takes 20 ns (figures in `benches/benches/casts.rs`).

mod planes;
mod round;

use super::advance::{End, advance};
use super::passage::{Course, Fineness, Passage, length};
use crate::exact::{self, Site3};
use crate::impact3::RayHit3;
use crate::pair3::{Pair3, Part, for_parts};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Hull, Pose3, Ray3, Shape3};
use std::sync::LazyLock;

/// What the ray's origin is as a shape.
static POINT: LazyLock<Option<Shape3>> =
    LazyLock::new(|| Hull::of_any_dimension(&[Vec3::ZERO]).ok().map(Shape3::from));

/// A ray in a shape's own axes, in metres.
#[derive(Clone, Copy, Debug)]
struct Line {
    origin: DVec3,
    /// Of unit length.
    along: DVec3,
    /// How far a point on it may be beside its place, up to where it passes the shape.
    doubt: f64,
}

/// Where a ray meets one part.
#[derive(Clone, Copy, Debug)]
enum Meeting {
    Never,
    /// So many metres from the origin, with the surface's outward normal and the error, in metres along the ray.
    At(f64, DVec3, f64),
    /// It starts inside.
    Inside,
    /// Whether it starts inside is below rounding; and if it does not, whether it meets the part at once.
    Unclear,
    /// There is no closed form.
    Open,
}

/// Where a ray first meets a posed shape, within `limit` lengths of its direction, which may be infinite.
///
/// An origin inside the shape, or on its surface exactly, is a hit at distance 0. Else the distance is right up to `error`,
/// in metres along the ray: rounding of f64, some 1e-14 of the distance from the shape and of its size, over the cosine to the
/// normal; of a hull also what its faces are off from its vertices
/// ([`planarity_error`](asunder_geometry::Hull::planarity_error)). By as much, before it is divided by the cosine, may a ray
/// have gone into a shape that it is said to miss. A thin shape (segment, triangle, flat hull) is hit by what passes within
/// rounding. A NaN limit counts as none, and a negative one as zero. Of compounds, the nearest part.
///
/// Cost: a closed form for spheres, capsules, cuboids, half-spaces and triangles; two dot products a face for hulls; a few
/// distances for what is rounded and for segments and flat hulls.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Ray3, Shape3, glam::{DVec3, Vec3}};
/// use asunder_narrow::cast_ray3;
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
    let direction = ray.direction().as_dvec3();
    let pace = direction.length();
    let cast = Cast {
        shape,
        pose,
        ray,
        unit: direction / pace,
        body: pose.basis(),
        from: ray.origin() - pose.position(),
    };
    let mut limit = if limit.is_nan() { f64::INFINITY } else { limit.max(0.0) * pace };
    let mut first = None;
    for_parts(shape, &cast.body, |part| {
        let Some((distance, normal, error)) = cast.part(&part, limit) else { return false };
        // Of equals, the first.
        if distance <= limit && (first.is_none() || distance < limit) {
            limit = distance;
            first = Some(RayHit3 {
                distance: distance / pace,
                error: error.map_or(0.0, |error| (error as f32).next_up()),
                normal: normal.as_vec3(),
                inside: error.is_none(),
                part: part.index,
            });
        }
        error.is_none()
    });
    first
}

/// One ray, one body.
struct Cast<'a> {
    shape: &'a Shape3,
    pose: &'a Pose3,
    ray: &'a Ray3,
    unit: DVec3,
    body: Basis3,
    /// The ray's origin less the body's position.
    from: DVec3,
}

impl Cast<'_> {
    /// The distance to a part in metres, the normal there in world axes, and the error; no error where it starts inside.
    fn part(&self, part: &Part, limit: f64) -> Option<(f64, DVec3, Option<f64>)> {
        let away = part.center - self.from;
        let radius = f64::from(part.shape.outer_radius());
        let nearest = away.dot(self.unit).max(0.0);
        // Past the bounding sphere, or it begins too far away.
        let doubt = 64.0 * f64::EPSILON * (length(self.from) + length(part.center) + radius);
        let beside = (away - self.unit * nearest).length_squared();
        let reach = radius + doubt;
        if beside > reach * reach || nearest - reach > limit {
            return None;
        }
        let (basis, shift) = part.placed(&self.body);
        // A subtraction, a rotation of a part or two, and the ray's direction to where it passes.
        let size = if radius.is_finite() { radius + length(part.shape.center().as_dvec3()) } else { 0.0 };
        let line = Line {
            origin: basis.turn_back(self.from - shift),
            along: basis.turn_back(self.unit),
            doubt: 64.0 * f64::EPSILON * (length(self.from) + length(shift) + size),
        };
        let meeting = match part.shape {
            Shape3::Sphere(sphere) => round::sphere(&line, DVec3::ZERO, sphere.radius().into()),
            Shape3::Capsule(capsule) => round::capsule(&line, capsule),
            Shape3::Cuboid(cuboid) if cuboid.radius() == 0.0 => planes::cuboid(&line, cuboid),
            Shape3::Hull(hull) if hull.radius() == 0.0 && hull.dimension() == 3 => {
                planes::hull(&line, hull, &part.shape.core())
            }
            Shape3::HalfSpace(half_space) => planes::half_space(&line, half_space),
            Shape3::Triangle(triangle) => planes::triangle(&line, triangle),
            _ => Meeting::Open,
        };
        match meeting {
            Meeting::Never => None,
            Meeting::At(distance, normal, error) => Some((distance, basis.turn(normal), Some(error))),
            Meeting::Inside => Some((0.0, -self.unit, None)),
            Meeting::Unclear if self.is_inside(part) => Some((0.0, -self.unit, None)),
            Meeting::Unclear | Meeting::Open => self.by_steps(part, limit),
        }
    }

    /// Whether the ray's origin is in a part, exactly.
    fn is_inside(&self, part: &Part) -> bool {
        let (Some(point), Ok(origin)) = (&*POINT, Pose3::at(self.ray.origin())) else { return false };
        exact::overlaps3([&part.site(self.pose), &Site3 { shape: point, body: origin, part: None }], &[])
    }

    /// The ray as a point that moves until it touches.
    fn by_steps(&self, part: &Part, limit: f64) -> Option<(f64, DVec3, Option<f64>)> {
        let (Some(point), Ok(origin)) = (&*POINT, Pose3::at(self.ray.origin())) else { return None };
        let radius = f64::from(part.shape.outer_radius());
        let beyond = length(part.center - self.from) + radius;
        // A half-space is here only where the ray starts on its surface.
        let way = limit.min(if radius.is_finite() { beyond * 1.0625 } else { 1.0 });
        let pair = Pair3::new(point, &origin, self.shape, self.pose);
        let passage = Passage { rounding: 0.0, ..Passage::straight(&pair, self.unit * way) };
        let (core_point, core) = (point.core(), part.shape.core());
        let parts = [Part::whole(point, &passage.bases[0]), *part];
        let course = Course::new(&passage, parts, [&core_point, &core]).as_fine_as(Fineness::FINEST);
        let met = match advance(&course, 1.0) {
            End::Apart => return None,
            End::Unclear(_) if self.is_inside(part) => return Some((0.0, -self.unit, None)),
            End::Unclear(met) | End::Met(met) => met,
        };
        let steep = met.normal.dot(self.unit).abs();
        let error = if met.gap <= steep * radius { met.gap / steep } else { 2.0 * radius };
        Some((met.fraction * way, -met.normal, Some(error + 4.0 * f64::EPSILON * way)))
    }
}

impl Line {
    fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.along * distance
    }

    /// The error of a distance to a plane, by the sine of the ray's angle to it and by what the plane is off.
    fn error(&self, distance: f64, steep: f64, off: f64) -> f64 {
        (self.doubt + 64.0 * f64::EPSILON * distance + off) / steep
    }
}
