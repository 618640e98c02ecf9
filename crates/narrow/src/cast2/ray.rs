//! Where a ray enters a shape of the plane.
//!
//! ```text
//! work in the shape's own axes; y = how far a point lies beside the ray
//! along the edges that face the ray's origin, counter-clockwise, y only grows; so it does along the rounded outline:
//!   edges moved out by the radius, and arcs between them
//! the ray goes in at the edge, or the arc, at y = 0: found one by one for few vertices, by halving for many
//! if that is behind the origin: the exit, by the same search from the other end, tells inside from behind
//! where rounding could change the answer, the exact tier says whether the origin is inside
//! ```
//! One search serves circles, capsules, segments, rectangles and polygons, rounded or not; a half-plane is one
//! quotient.

mod ground;

use super::sum;
use crate::among::many2;
use crate::exact::{Site2, holds2};
use crate::impact2::RayHit2;
use crate::polygon::outline::{Outline, Turn, is_searched};
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Circle, Compound2, Pose2, Ray2, Shape2};

/// Rounding error of a coordinate of the ray seen from the shape, in units of 2^-52 of the sum of all that enters: two
/// rotations and two quotients of 8 units of 2^-53 at most, differences, and the projection.
const ROUNDINGS: f64 = 16.0;

/// Where a ray enters a shape, at most `limit` lengths of its direction from its origin; `None` if it does not. The
/// limit may be infinite; a NaN counts as none, and a negative limit as zero.
///
/// - Whether it starts inside is exact; then the distance is 0 and the normal is against the ray.
/// - In a compound it meets the part that it enters first, but a part that it starts inside of comes before any other.
/// - On a chain it meets the segment that it crosses first, from its front if the chain is one-sided, with the normal
///   against the ray.
///
/// Cost: 30 to 80 ns for a shape of few vertices; the logarithm of the vertices for a polygon of many; linear in the
/// parts for a compound of few, else the logarithm of the parts, and those whose boxes it meets; for a chain, the
/// segments whose boxes it meets; some microseconds where the origin lies on the outline up to rounding.
///
/// ```
/// use asunder::{Circle, Pose2, Ray2, Shape2, cast_ray2, glam::Vec2};
/// let ball = Shape2::from(Circle::new(1.0)?);
/// let ray = Ray2::new([-3.0, 0.0], Vec2::X * 4.0)?;
/// let hit = cast_ray2(&ball, &Pose2::IDENTITY, &ray, f64::INFINITY).ok_or("it hits")?;
/// assert!((hit.distance - 0.5).abs() * 4.0 <= f64::from(hit.error));
/// assert_eq!((hit.normal, hit.inside), (Vec2::NEG_X, false));
/// assert_eq!(cast_ray2(&ball, &Pose2::IDENTITY, &ray, 0.4), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cast_ray2(shape: &Shape2, pose: &Pose2, ray: &Ray2, limit: f64) -> Option<RayHit2> {
    let limit = if limit.is_nan() { f64::INFINITY } else { limit.max(0.0) };
    let from_body = ray.origin() - pose.position();
    let beam =
        Beam::new(pose.turn_back(from_body), pose.turn_back(ray.direction().as_dvec2()), sum(from_body))?;
    if let Shape2::Chain(chain) = shape {
        return ground::into_chain(chain, (pose, ray), &beam, limit);
    }
    let Shape2::Compound(compound) = shape else {
        return Target { shape, pose, part: None, index: 0, ray }.answer(&beam, limit);
    };
    over_parts((shape, compound), (pose, ray), &beam, limit)
}

/// The nearest hit on a compound's parts: if there are few, one after the other; if many, in the order in which their
/// boxes are met.
fn over_parts(
    (shape, compound): (&Shape2, &Compound2),
    (pose, ray): (&Pose2, &Ray2),
    beam: &Beam,
    limit: f64,
) -> Option<RayHit2> {
    let mut first: Option<RayHit2> = None;
    let mut offer = |index: u32| {
        let reach = first.map_or(limit, |first| first.distance);
        let Some(hit) = compound.parts().get(index as usize).and_then(|part| {
            if beam.misses(part.center(), f64::from(part.shape().outer_radius()), reach) {
                return None;
            }
            let local = part.pose();
            let origin = local.transform_back(beam.origin);
            let local_beam =
                Beam::new(origin, local.turn_back(beam.direction), beam.summed + sum(local.position()))?;
            Target { shape: part.shape(), pose, part: Some(local), index, ray }.answer(&local_beam, reach)
        }) else {
            return reach;
        };
        // Of equals, the first; but a part that the ray starts inside of comes before all.
        let place = |hit: &RayHit2| (!hit.inside, hit.distance, hit.part);
        first = Some(first.filter(|known| place(known) <= place(&hit)).unwrap_or(hit));
        first.map_or(limit, |known| known.distance)
    };
    if many2(shape).is_none() {
        (0..compound.parts().len() as u32).for_each(|index| {
            offer(index);
        });
        return first;
    }
    let size = f64::from(compound.outer_radius()) + sum(compound.center().as_dvec2());
    let grown = (16.0 * f64::from(f32::EPSILON) * (sum(beam.origin) + size)) as f32;
    compound.visit_along(beam.origin, beam.direction, grown, limit, offer);
    first
}

/// A ray in the axes of a shape.
struct Beam {
    origin: DVec2,
    direction: DVec2,
    /// Its length, in metres for a length of the ray's direction, and the unit vector.
    length: f64,
    unit: DVec2,
    /// The sum of the coordinates, by magnitude, that its origin was computed from.
    summed: f64,
}

/// How the line of a ray meets a shape.
enum Way {
    Misses,
    /// Hits or misses by less than rounding.
    Grazes,
    Enters(Entry),
}

/// Where the line of a ray enters a shape.
struct Entry {
    /// Metres from the ray's origin; negative behind it.
    along: f64,
    /// The error of that.
    error: f64,
    normal: DVec2,
}

/// One convex shape, with all that an exact answer needs.
struct Target<'a> {
    shape: &'a Shape2,
    pose: &'a Pose2,
    part: Option<&'a Pose2>,
    index: u32,
    ray: &'a Ray2,
}

impl Beam {
    /// `None` for a direction without length.
    fn new(origin: DVec2, direction: DVec2, summed: f64) -> Option<Self> {
        let length = direction.length();
        (length > 0.0).then(|| Self { origin, direction, length, unit: direction / length, summed })
    }

    /// Rounding error of a coordinate, for a shape that reaches this far.
    fn rounding(&self, reach: f64) -> f64 {
        ROUNDINGS * f64::EPSILON * (self.summed + sum(self.origin) + reach)
    }

    /// Whether it certainly stays outside of a circle, up to `limit` lengths.
    fn misses(&self, center: DVec2, radius: f64, limit: f64) -> bool {
        let to_center = center - self.origin;
        let radius = radius * (1.0 + 1e-6) + self.rounding(sum(center) + radius);
        let along = self.unit.dot(to_center);
        self.unit.perp_dot(to_center).abs() > radius
            || along < -radius
            || along - radius > limit * self.length * (1.0 + 1e-12)
    }
}

impl Target<'_> {
    fn answer(&self, beam: &Beam, limit: f64) -> Option<RayHit2> {
        let entry = match self.way(beam) {
            Way::Misses => return None,
            Way::Grazes => return self.is_inside().then(|| self.inside()),
            Way::Enters(entry) => entry,
        };
        if entry.along <= entry.error && self.is_entered(beam, &entry)? {
            return Some(self.inside());
        }
        let distance = entry.along.max(0.0) / beam.length;
        let local = self.part.map_or(entry.normal, |part| part.rotation().turn(entry.normal));
        (distance <= limit).then(|| RayHit2 {
            distance,
            error: (entry.error as f32).next_up(),
            normal: self.pose.rotation().turn(local).normalize().as_vec2(),
            inside: false,
            part: self.index,
        })
    }

    /// Whether the origin is inside, for a line that enters before the origin or within rounding of it; `None` if the
    /// shape is behind the ray.
    fn is_entered(&self, beam: &Beam, entry: &Entry) -> Option<bool> {
        if matches!(self.shape, Shape2::HalfPlane(_)) {
            return Some(entry.along == f64::NEG_INFINITY || self.is_inside());
        }
        let back = Beam { direction: -beam.direction, unit: -beam.unit, ..*beam };
        let doubt = match self.way(&back) {
            Way::Enters(exit) if -exit.along < -exit.error => return self.behind(-exit.along, entry),
            Way::Enters(exit) if -exit.along > exit.error && entry.along < -entry.error => return Some(true),
            Way::Enters(exit) => -exit.along,
            Way::Grazes | Way::Misses => entry.along,
        };
        if self.is_inside() {
            return Some(true);
        }
        self.behind(doubt, entry)
    }

    /// The origin is not inside: the shape is behind, unless the ray enters at the origin.
    fn behind(&self, exit: f64, entry: &Entry) -> Option<bool> {
        (entry.along >= -entry.error && exit >= -entry.error).then_some(false)
    }

    fn inside(&self) -> RayHit2 {
        let direction = self.ray.direction().as_dvec2();
        RayHit2 {
            distance: 0.0,
            error: 0.0,
            normal: -direction.normalize().as_vec2(),
            inside: true,
            part: self.index,
        }
    }

    /// Whether the origin is in the shape, exactly.
    fn is_inside(&self) -> bool {
        let (Ok(circle), Ok(at)) = (Circle::new(1.0), Pose2::at(self.ray.origin())) else { return false };
        let point = Site2 { shape: &Shape2::Circle(circle), body: at, part: None };
        holds2(&Site2 { shape: self.shape, body: *self.pose, part: self.part }, &point)
    }

    /// By how much the rotations stretch what they turn, as cosines and sines are rounded. Radii are not stretched, so
    /// from the shape's axes they look smaller by as much.
    fn stretch(&self) -> f64 {
        let turns = [Some(self.pose), self.part];
        turns.into_iter().flatten().map(|pose| pose.turn(DVec2::X).length()).product()
    }

    /// How the line meets the shape.
    fn way(&self, beam: &Beam) -> Way {
        if let Shape2::HalfPlane(half_plane) = self.shape {
            return into_half_plane(half_plane.unit_normal(), beam);
        }
        let core = self.shape.core();
        let outline = Outline::new(self.shape, &core, Turn::to(DVec2::X), DVec2::ZERO);
        let reach = sum(self.shape.center().as_dvec2()) + f64::from(self.shape.outer_radius());
        let along = AlongRay {
            outline: &outline,
            normals: core.normals(),
            beam,
            side: DVec2::new(beam.unit.y, -beam.unit.x),
            radius: f64::from(self.shape.radius()) / self.stretch(),
            rounding: beam.rounding(reach),
        };
        if is_searched(self.shape) { along.search() } else { along.one_by_one() }
    }
}

/// Into a half-plane. A ray that starts inside enters at minus infinity; one that starts on the line, within rounding,
/// and does not go in is left to the exact tier.
fn into_half_plane(normal: DVec2, beam: &Beam) -> Way {
    let (height, closing) = (normal.dot(beam.origin), -normal.dot(beam.unit));
    let rounding = beam.rounding(0.0);
    if height > rounding && closing <= 0.0 {
        return Way::Misses;
    }
    if height < -rounding {
        return Way::Enters(Entry { along: f64::NEG_INFINITY, error: rounding, normal });
    }
    if closing <= 0.0 {
        return Way::Grazes;
    }
    let along = height / closing;
    // A direction is off by 4 roundings, and so is its length.
    let error = (rounding + 8.0 * f64::EPSILON * along.abs()) / closing;
    Way::Enters(Entry { along, error, normal })
}

/// An outline as seen from along a ray.
struct AlongRay<'a> {
    outline: &'a Outline<'a>,
    normals: &'a [DVec2],
    beam: &'a Beam,
    /// Unit vector square to the ray: edges that face the origin follow one another along it.
    side: DVec2,
    radius: f64,
    rounding: f64,
}

impl AlongRay<'_> {
    /// Tests every edge; if none is hit, the circle around every vertex.
    fn one_by_one(&self) -> Way {
        for edge in 0..self.normals.len() {
            if self.beam.unit.dot(self.normals[edge]) < 0.0
                && self.beside(edge, edge) <= 0.0
                && self.beside(self.outline.after(edge), edge) >= 0.0
            {
                return Way::Enters(self.edge_at(edge));
            }
        }
        let mut way = Way::Misses;
        for vertex in 0..self.outline.vertices.len() {
            match (self.arc_at(vertex), &way) {
                (Way::Enters(next), Way::Enters(known)) if next.along >= known.along => {}
                (Way::Enters(next), _) => way = Way::Enters(next),
                (Way::Grazes, Way::Misses) => way = Way::Grazes,
                _ => {}
            }
        }
        way
    }

    /// Finds, by halving, the last edge that begins no further along `side` than the ray; the hit is on it, or on the
    /// arc after it.
    fn search(&self) -> Way {
        let (start, end) = (self.outline.support(-self.side).vertex, self.outline.support(self.side).vertex);
        let count = self.normals.len();
        let edges = if end >= start { end - start } else { end + count - start };
        let ahead = |by: usize| if start + by >= count { start + by - count } else { start + by };
        let (mut before, mut unknown) = (0, edges);
        while unknown > 0 {
            let half = unknown / 2;
            let edge = ahead(before + half);
            if self.beside(edge, edge) <= 0.0 {
                (before, unknown) = (before + half + 1, unknown - half - 1);
            } else {
                unknown = half;
            }
        }
        if before == 0 {
            return self.arc_at(start);
        }
        let edge = ahead(before - 1);
        if self.beside(self.outline.after(edge), edge) >= 0.0 {
            return Way::Enters(self.edge_at(edge));
        }
        self.arc_at(ahead(before))
    }

    /// How far a vertex, moved out along an edge's normal, lies beside the ray.
    fn beside(&self, vertex: usize, edge: usize) -> f64 {
        self.side.dot(self.outline.point(vertex) - self.beam.origin)
            + self.radius * self.side.dot(self.normals[edge])
    }

    fn edge_at(&self, edge: usize) -> Entry {
        let (unit, normal) = (self.beam.unit, self.normals[edge]);
        let height = |vertex: usize| self.outline.point(vertex) - self.beam.origin + normal * self.radius;
        let (from, to) = (height(edge), height(self.outline.after(edge)));
        let ends = (unit.dot(from), unit.dot(to));
        let closing = unit.dot(normal);
        // On an edge that is almost parallel to the ray, the hit stays between the edge's ends.
        let (near, far) = (ends.0.min(ends.1), ends.0.max(ends.1));
        let along = (normal.dot(from) / closing).max(near).min(far);
        let error = (self.rounding / closing.abs()).min(far - near + self.rounding) + self.rounding;
        Entry { along, error, normal }
    }

    /// Into the circle around a vertex.
    fn arc_at(&self, vertex: usize) -> Way {
        let to_center = self.outline.point(vertex) - self.beam.origin;
        let (aside, middle) = (self.side.dot(to_center), self.beam.unit.dot(to_center));
        let (radius, rounding) = (self.radius, self.rounding);
        if aside.abs() > radius {
            return if aside.abs() > radius + rounding { Way::Misses } else { Way::Grazes };
        }
        let half = ((radius - aside) * (radius + aside)).sqrt();
        // The half chord is the root of r^2 - y^2, of which y is off by the rounding.
        let lost = rounding * (2.0 * radius + rounding);
        let along = middle - half;
        let error = 2.0 * rounding + lost / half.max(lost.sqrt()).max(f64::MIN_POSITIVE);
        let outwards = self.beam.unit * -half - self.side * aside;
        Way::Enters(Entry { along, error, normal: outwards.try_normalize().unwrap_or(-self.beam.unit) })
    }
}
