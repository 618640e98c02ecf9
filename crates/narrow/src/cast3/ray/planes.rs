//! Rays against shapes that planes bound.

use super::{Line, Meeting};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Core3, Cuboid, HalfSpace, Hull, Triangle3};

/// Sine of the angle to a triangle's plane below which it counts as seen edge on.
pub(super) const EDGE_ON: f64 = 1e-6;

/// A box by slabs: the ray is inside while it is between all three pairs of planes.
#[inline(always)]
pub(super) fn cuboid(line: &Line, basis: &Basis3, cuboid: &Cuboid) -> Meeting {
    let half = cuboid.half_extents().as_dvec3().to_array();
    let (origin, way) = (basis.turn_back(line.origin).to_array(), basis.turn_back(line.way).to_array());
    let (mut enter, mut leave, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 0);
    let mut beyond = f64::NEG_INFINITY;
    for axis in 0..3 {
        // The ray starts `before` the middle of the slab, along its direction. For a ray along the slab both quotients
        // are infinite, or NaN on a face, which bounds nothing.
        let (before, inverse) = (-origin[axis].copysign(origin[axis] * way[axis]), 1.0 / way[axis].abs());
        let (first, last) = ((before - half[axis]) * inverse, (before + half[axis]) * inverse);
        face = if first > enter { axis } else { face };
        enter = if first > enter { first } else { enter };
        leave = if last < leave { last } else { leave };
        let out = origin[axis].abs() - half[axis];
        beyond = if out > beyond { out } else { beyond };
    }
    if beyond <= line.doubt {
        return if beyond < -line.doubt { Meeting::Inside } else { Meeting::Unclear };
    }
    if enter > leave || enter < 0.0 || enter == f64::INFINITY {
        return Meeting::Never;
    }
    let (axis, closing) = ([basis.x, basis.y, basis.z][face % 3], way[face % 3]);
    Meeting::At(enter, axis * -1.0_f64.copysign(closing), line.error(enter, closing.abs(), 0.0))
}

/// Up to this share of its outer radius a hull's planes may reach beyond its rims without a test of the face: 2^-18,
/// far above what rounding makes of hulls that are not thin.
const BEYOND_RIMS: f64 = 1.0 / 262_144.0;

/// How many times the inner radius the outer one may be for the error to hold as it is: that is four times what faces
/// are off by.
const COMPACT: f64 = 4.0;

/// A convex hull as an intersection of half-spaces: the ray enters some planes and leaves others.
///
/// Faces that were merged are not flat, and the planes are those of their highest corners. So beyond a sharp edge the
/// planes contain more than the hull, and two faces back to back an endless slab. How much more: let r be the radius of
/// a ball inside the hull, R that of one around it, both about its centre c, and q how far corners of a face lie below
/// its plane at most, with rounding. Take a point inside all planes. Where the way from c to it leaves the hull, it is
/// no more than q below some plane; c is at least r below that plane, and the point not above it. So at most the share
/// q / r of the way is outside the hull, and the point no further from it than R q / r. Where that would be too much,
/// the face that is entered is tested: over a face, the hull is at most q below its plane, however sharp the edges are.
/// A ray that enters beside the face goes by steps.
pub(super) fn hull(line: &Line, basis: &Basis3, hull: &Hull, core: &Core3) -> Meeting {
    let (origin, way) = (basis.turn_back(line.origin), basis.turn_back(line.way));
    let (mut enter, mut leave, mut furthest) = (f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
    let mut face = DVec3::X;
    for (&normal, &height) in core.normals().iter().zip(core.heights()) {
        let (beyond, pace) = (normal.dot(origin) - height, normal.dot(way));
        furthest = if beyond > furthest { beyond } else { furthest };
        let distance = -beyond / pace;
        if pace < 0.0 {
            if distance > enter {
                (enter, face) = (distance, normal);
            }
        } else if pace > 0.0 {
            leave = if distance < leave { distance } else { leave };
        } else if beyond > line.doubt {
            return Meeting::Never;
        }
    }
    if furthest <= line.doubt {
        // Faces prove nothing about the inside; a sphere inside does.
        let from_center = (origin - core.center().as_dvec3()).length();
        let is_deep = from_center + line.doubt < f64::from(core.inner_radius());
        return if is_deep { Meeting::Inside } else { Meeting::Unclear };
    }
    if enter > leave || enter < 0.0 {
        return Meeting::Never;
    }
    let (inner, outer) = (f64::from(core.inner_radius()), f64::from(hull.outer_radius()));
    let off = f64::from(hull.planarity_error());
    let error = line.error(enter, -face.dot(way), 4.0 * off);
    let is_thick = off + 2.0 * line.doubt <= BEYOND_RIMS * inner;
    if !is_thick && !is_over_face(line, basis, core, enter) {
        return Meeting::Open;
    }
    let is_slender = is_thick && outer > COMPACT * inner;
    let error = if is_slender { error * (outer / (COMPACT * inner)) } else { error };
    Meeting::At(enter, basis.turn(face), error.min(2.0 * outer))
}

/// Whether the ray, at that distance, is on the plane of a face up to rounding, over the face, and further from its
/// edges than rounding.
#[inline(never)]
fn is_over_face(line: &Line, basis: &Basis3, core: &Core3, distance: f64) -> bool {
    let (at, doubt) = (basis.turn_back(line.at(distance)), line.doubt_at(distance).0);
    let topology = core.topology();
    let corner = |vertex: usize| core.vertices()[vertex].as_dvec3();
    (0..).zip(core.normals()).zip(core.heights()).any(|((face, &normal), &height)| {
        let is_within = |half_edge: usize| {
            let (from, to) = topology.ends(half_edge);
            let (from, along) = (corner(from), corner(to) - corner(from));
            let out = along.cross(normal).dot(at - from);
            out < 0.0 && out * out > doubt * doubt * along.length_squared()
        };
        (normal.dot(at) - height).abs() <= 2.0 * doubt && topology.face_half_edges(face).all(is_within)
    })
}

/// A half-space: one plane.
#[inline(always)]
pub(super) fn half_space(line: &Line, basis: &Basis3, half_space: &HalfSpace) -> Meeting {
    let normal = basis.turn(half_space.unit_normal());
    let (height, pace) = (normal.dot(line.origin), -normal.dot(line.way));
    if height <= line.doubt {
        return if height < -line.doubt { Meeting::Inside } else { Meeting::Unclear };
    }
    let distance = height / pace;
    // The ray leads away from the plane or along it, or so nearly along it that the hit is out of range.
    if pace <= 0.0 || !distance.is_finite() {
        return Meeting::Never;
    }
    Meeting::At(distance, normal, line.error(distance, pace, 0.0))
}

/// Where the ray meets the triangle's plane, if that point is on the inner side of all edges up to rounding.
pub(super) fn triangle(line: &Line, basis: &Basis3, triangle: &Triangle3) -> Meeting {
    let crossing = match Crossing::new(line, basis, triangle) {
        Ok(crossing) => crossing,
        Err(meeting) => return meeting,
    };
    let (at, error) = (line.at(crossing.distance), crossing.error);
    let [a, b, c] = triangle.vertices();
    let (a, b, c) = (basis.turn(a.as_dvec3()), basis.turn(b.as_dvec3()), basis.turn(c.as_dvec3()));
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let inwards = crossing.normal.cross(to - from);
        let height = inwards.dot(at - from);
        if height < 0.0 && height * height > error * error * inwards.length_squared() {
            return Meeting::Never;
        }
    }
    crossing.meeting()
}

/// The same for a triangle that the ray certainly crosses.
#[inline]
pub(super) fn crossed_triangle(line: &Line, basis: &Basis3, triangle: &Triangle3) -> Meeting {
    match Crossing::new(line, basis, triangle) {
        Ok(crossing) => crossing.meeting(),
        Err(meeting) => meeting,
    }
}

/// Where a ray meets a triangle's plane.
struct Crossing {
    distance: f64,
    /// The front's normal.
    normal: DVec3,
    is_from_front: bool,
    error: f64,
}

impl Crossing {
    #[inline(always)]
    fn new(line: &Line, basis: &Basis3, triangle: &Triangle3) -> Result<Self, Meeting> {
        let corner = basis.turn(triangle.vertices()[0].as_dvec3());
        let normal = basis.turn(triangle.normals()[0]);
        let (height, pace) = (normal.dot(line.origin - corner), normal.dot(line.way));
        if height.abs() <= line.doubt || pace * pace < EDGE_ON * EDGE_ON * line.squared {
            return Err(Meeting::Open);
        }
        let distance = -height / pace;
        if distance < 0.0 {
            return Err(Meeting::Never);
        }
        let error = line.error(distance, pace.abs(), 0.0);
        Ok(Self { distance, normal, is_from_front: pace < 0.0, error })
    }

    fn meeting(&self) -> Meeting {
        Meeting::At(self.distance, if self.is_from_front { self.normal } else { -self.normal }, self.error)
    }
}
