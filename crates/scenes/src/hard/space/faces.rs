//! Face against face: off by ulps, rotated, on a grid, stacked.

use super::body::{Body3, Draft3};
use super::solids::{anything, brick, cuboid, solid};
use crate::hard::gap::{gap, sign, stepped, ulps};
use crate::random::Random;
use asunder_geometry::Shape3;
use glam::{DVec3, Quat};

/// Levels of [`face_ulps`]: at most 256 ulp, 128, and so on down to one.
pub(super) const ULP_LEVELS: u32 = 9;

/// Two axis-aligned bricks that touch along one axis, with a gap or overlap of a few ulps.
pub(super) fn face_ulps(level: u32, random: &mut Random) -> Draft3 {
    let half = |random: &mut Random| random.within(DVec3::splat(0.3), DVec3::splat(0.6)).as_vec3().as_dvec3();
    let (a, b) = (half(random), half(random));
    let reach = [1.0, 8.0, 1000.0][random.below(3)];
    // On a coarse grid, so that the sum with two f32 extents is exact and 0 ulp means touching.
    let at = on_grid(random.within(DVec3::splat(-reach), DVec3::splat(reach)), 1024.0);
    let axis = random.below(3);
    let mut goal = at + random.within(DVec3::splat(-0.8), DVec3::splat(0.8)) * (a + b);
    let steps = ulps(ULP_LEVELS - 1 - level, random);
    let side = sign(random);
    let in_f32 = random.unit() < 0.3;
    let touching = at[axis] + side * (a[axis] + b[axis]);
    let ulp = if in_f32 { f64::from(f32::EPSILON) * 0.5 } else { ulp_of(touching) };
    goal[axis] = touching + side * steps as f64 * ulp;
    let mut within = steps.unsigned_abs() as f64 * ulp;
    // A quarter of the pairs touch only along an edge.
    if random.unit() < 0.25 {
        let other = (axis + 1) % 3;
        let steps = ulps(ULP_LEVELS - 1 - level, random);
        goal[other] = stepped(at[other] + a[other] + b[other], steps);
        within += 2.0 * steps.unsigned_abs() as f64 * ulp_of(goal[other]);
    }
    let (a, b) = (Body3::turned(cuboid(a), Quat::IDENTITY), Body3::turned(cuboid(b), Quat::IDENTITY));
    let mut along = DVec3::ZERO;
    along[axis] = side;
    Draft3::placed(a, b, at, goal).claiming(along, within)
}

fn ulp_of(value: f64) -> f64 {
    (stepped(value, 1) - value).abs()
}

/// The nearest point whose coordinates are whole multiples of `1 / parts`.
pub(super) fn on_grid(point: DVec3, parts: f64) -> DVec3 {
    (point * parts).round() / parts
}

/// Two bricks under one rotation, face on face. Half of the rotations are quaternions of small whole numbers, with
/// bricks such that the position at which they touch is exact.
pub(super) fn face_rotated(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    if random.unit() < 0.5 {
        let rotation = random.rotation();
        return face_to_face([rotation; 2], 1.0 / 4096.0, gap, random);
    }
    let q = whole_rotation(random);
    let square: f64 = q.iter().map(|q| q * q).sum();
    let rotation = Quat::from_array(q.map(|q| q as f32));
    face_to_face([rotation; 2], square / 4096.0, gap, random)
}

/// A quaternion of small whole numbers: its matrix consists of whole numbers divided by its squared length.
pub(super) fn whole_rotation(random: &mut Random) -> [f64; 4] {
    let mut part = || random.below(9) as f64 - 4.0;
    let q = [part(), part(), part(), part()];
    if q == [0.0; 4] { [1.0, 2.0, 3.0, 4.0] } else { q }
}

/// Bricks whose extents and offsets are whole multiples of `grid` in their own axes, which are the same for both.
fn face_to_face(rotations: [Quat; 2], grid: f64, gap: f64, random: &mut Random) -> Draft3 {
    let snap = |v: DVec3| (v / grid).round().max(DVec3::ONE) * grid;
    let (a, b) = (
        snap(random.within(DVec3::splat(0.3), DVec3::splat(0.6))),
        snap(random.within(DVec3::splat(0.3), DVec3::splat(0.6))),
    );
    let mut local = random.within(DVec3::splat(-0.9), DVec3::splat(0.9)) * (a + b);
    local = (local / grid).round() * grid;
    let axis = random.below(3);
    let side = sign(random);
    local[axis] = side * (a[axis] + b[axis]);
    let mut along = DVec3::ZERO;
    along[axis] = side;
    let size = a.length() + b.length();
    let (a, b) = (Body3::turned(cuboid(a), rotations[0]), Body3::turned(cuboid(b), rotations[1]));
    // In whole numbers first, so that the division by the squared length is exact.
    let offset = a.turn_whole(local, grid);
    let axis = a.turn(along);
    let at = if random.unit() < 0.5 {
        DVec3::ZERO
    } else {
        on_grid(random.within(DVec3::splat(-5.0), DVec3::splat(5.0)), 256.0)
    };
    Draft3::placed(a, b, at, at + offset + axis * (gap * size)).claiming(axis, gap.abs() * size)
}

/// Two bricks on a grid that exactly share a face, an edge, a corner or more.
pub(super) fn coincident_faces(level: u32, random: &mut Random) -> Draft3 {
    // From level 2 on the extents are not dyadic; but they are f32, so their sums are still exact in f64.
    let unit = if level < 2 { 0.125 } else { f64::from([0.1_f32, 0.3, 0.7, 1.1][random.below(4)]) * 0.25 };
    let mut extents = || DVec3::new(1.0, 1.0, 1.0).map(|_| unit * [1.0, 2.0, 4.0][random.below(3)]);
    let (a, b) = (extents(), extents());
    let rotations =
        if level == 0 { [Quat::IDENTITY; 2] } else { [quarter(level, random), quarter(level, random)] };
    let (a, b) = (Body3::turned(cuboid(a), rotations[0]), Body3::turned(cuboid(b), rotations[1]));
    let (reach_a, reach_b) = (upright(&a), upright(&b));
    let mut offset = DVec3::ZERO;
    for axis in 0..3 {
        let flush = [reach_a[axis] - reach_b[axis], 0.0, reach_a[axis] + reach_b[axis], unit];
        offset[axis] = flush[random.below(4)] * sign(random);
    }
    let axis = random.below(3);
    let side = sign(random);
    offset[axis] = side * (reach_a[axis] + reach_b[axis]);
    let mut along = DVec3::ZERO;
    along[axis] = side;
    let at = on_grid(random.within(DVec3::splat(-20.0), DVec3::splat(20.0)), 8.0);
    Draft3::placed(a, b, at, at + offset).claiming(along, 0.0)
}

/// The half extents along the world's axes of a brick rotated by quarter turns.
fn upright(body: &Body3) -> DVec3 {
    let half = match &body.shape {
        Shape3::Cuboid(cuboid) => cuboid.half_extents().as_dvec3(),
        _ => DVec3::splat(0.5),
    };
    let rounded = |axis: DVec3| body.turn(axis).abs().round();
    rounded(DVec3::X) * half.x + rounded(DVec3::Y) * half.y + rounded(DVec3::Z) * half.z
}

/// A rotation that maps axes to axes: in whole numbers, or with components such as 0.70710677 from level 2 on.
fn quarter(level: u32, random: &mut Random) -> Quat {
    let (one, other) = (random.below(4), random.below(4));
    let length = if level < 2 { 1.0 } else { f32::sqrt(0.5) };
    let mut q = [0.0_f32; 4];
    q[one] = length;
    q[other] = if random.unit() < 0.5 { -length } else { length };
    if random.unit() < 0.25 {
        q = [0.5, -0.5, 0.5, if random.unit() < 0.5 { 0.5 } else { -0.5 }];
    }
    Quat::from_array(q)
}

/// Courses of bricks whose heights are multiples of 0.1: positions are summed in f64 or f32, and extents are f32.
pub(super) fn stack(level: u32, random: &mut Random) -> Draft3 {
    let tenth = |random: &mut Random, least: usize| (least + random.below(9)) as f64 * 0.1;
    let half = |random: &mut Random| {
        DVec3::new(tenth(random, 1) * 0.5, tenth(random, 1) * 0.5, tenth(random, 1) * 0.5)
            .as_vec3()
            .as_dvec3()
    };
    let (a, b) = (half(random), half(random));
    let courses = 1 + random.below([1, 10, 100, 1000][level.min(3) as usize]);
    let step = 2.0 * a.y;
    let mut height = [0.0_f64, 0.1, 0.3][random.below(3)];
    let in_f32 = random.unit() < 0.5;
    for _ in 0..courses {
        height = if in_f32 {
            f64::from(height as f32 + step as f32)
        } else {
            height + (step * 10.0).round() / 10.0
        };
    }
    let above = height + a.y + b.y;
    let above = if in_f32 { f64::from(above as f32) } else { above };
    let beside = DVec3::new(tenth(random, 0) * 0.5, 0.0, tenth(random, 0) * 0.5) * (a + b);
    let at = DVec3::new(random.below(10) as f64 * 0.1, height, random.below(10) as f64 * 0.7);
    let goal = DVec3::new(at.x + beside.x, above, at.z + beside.z);
    let (a, b) = (Body3::turned(cuboid(a), Quat::IDENTITY), Body3::turned(cuboid(b), Quat::IDENTITY));
    Draft3::placed(a, b, at, goal).claiming(DVec3::Y, 2e-7 * height.max(1.0))
}

/// The same shape twice, in the same or nearly the same pose.
pub(super) fn identical(level: u32, random: &mut Random) -> Draft3 {
    let shape = match random.below(3) {
        0 => anything(1.0, random),
        1 => brick(1.0, random),
        _ => solid(1.0, random),
    };
    let rotation = if random.unit() < 0.3 { Quat::IDENTITY } else { random.rotation() };
    let at = on_grid(random.within(DVec3::splat(-8.0), DVec3::splat(8.0)), 1024.0);
    let mut goal = at;
    match level {
        0 => {}
        1 => goal += on_grid(random.direction() * random.log_range(1e-3, 0.5), 1024.0),
        2 => goal[random.below(3)] += random.log_range(1e-15, 1e-3) * sign(random),
        _ => {
            for axis in 0..3 {
                goal[axis] = stepped(goal[axis], random.below(3) as i64 - 1);
            }
        }
    }
    // The same rotation as another multiple of its quaternion.
    let factor = [1.0, 1.0, -1.0, 2.0, -0.25][random.below(5)];
    let again = Quat::from_array(rotation.to_array().map(|part| part * factor));
    let (a, b) = (Body3::turned(shape.clone(), rotation), Body3::turned(shape, again));
    Draft3::placed(a, b, at, goal)
}
