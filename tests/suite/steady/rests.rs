//! Bodies at rest: a face, an edge or an end on level ground, slightly sunk in, and all of it rotated and moved
//! anywhere.

use asunder_geometry::{Capsule3, Cuboid, HalfSpace, Pose3, Shape3};
use asunder_tests::cases::Random;
use asunder_tests::exact_overlap::exact_overlap3;
use glam::{DQuat, DVec3, Quat, Vec3};

/// A body that rests on another.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    pub(super) ground: Shape3,
    pub(super) here: Pose3,
    pub(super) body: Shape3,
    pub(super) there: Pose3,
    /// The sum of the finite bounding radii, in metres.
    pub(super) size: f64,
}

/// A body that may lie on something: a box, hull, prism or capsule, in turns.
fn body(random: &mut Random, round: usize) -> Shape3 {
    match round % 4 {
        0 => random.cuboid(),
        1 => {
            let vertices = 4 + random.below(13);
            random.hull(vertices)
        }
        2 => {
            let corners = 3 + random.below(5);
            random.prism(corners)
        }
        _ => {
            let (half, radius) = (random.between(0.1, 0.8) as f32, random.between(0.1, 0.4) as f32);
            Capsule3::from_half_height(half, radius).unwrap().into()
        }
    }
}

/// The product of quaternions in f64, rounded once to f32, as a game's would be at best.
fn rounded(q: DQuat) -> Quat {
    Quat::from_array(q.normalize().to_array().map(|c| c as f32))
}

/// A direction of the body that may point down: a face normal, or those of a capsule lying and standing.
fn downwards(random: &mut Random, body: &Shape3) -> DVec3 {
    let core = body.core();
    match core.normals() {
        [] => random.pick(&[DVec3::X, DVec3::X, DVec3::NEG_Y]),
        normals => random.pick(normals),
    }
}

/// Level ground, its rotation and its height: a slab, a half-space, or the face of another body.
fn ground(random: &mut Random, round: usize) -> (Shape3, DQuat, f64) {
    let level = |shape: &Shape3, turn: DQuat| {
        let heights = shape.core().vertices().iter().map(|v| (turn * v.as_dvec3()).y).collect::<Vec<_>>();
        heights.into_iter().fold(f64::NEG_INFINITY, f64::max) + f64::from(shape.radius())
    };
    match round / 4 % 3 {
        0 => (Cuboid::from_half_extents(Vec3::new(4.0, 0.5, 4.0)).unwrap().into(), DQuat::IDENTITY, 0.5),
        1 => (HalfSpace::new(Vec3::Y).unwrap().into(), DQuat::IDENTITY, 0.0),
        _ => {
            // Of any kind except a hull of tiny facets, on which nothing rests.
            let kind = [0, 2, 3][random.below(3)];
            let shape = body(random, kind);
            let normals = shape.core().normals().to_vec();
            let up = if normals.is_empty() { DVec3::X } else { random.pick(&normals) };
            let turn = DQuat::from_rotation_arc(up, DVec3::Y);
            let height = level(&shape, turn);
            (shape, turn, height)
        }
    }
}

/// The centre of the highest feature.
fn top(ground: &Shape3, turn: DQuat, height: f64) -> DVec3 {
    let core = ground.core();
    let turned = core.vertices().iter().map(|v| turn * v.as_dvec3());
    let is_highest = |v: &DVec3| height - f64::from(ground.radius()) - v.y < 1e-4;
    let highest: Vec<DVec3> = turned.filter(is_highest).collect();
    highest.iter().sum::<DVec3>() / highest.len().max(1) as f64
}

/// The `round`-th rest of a seed, sunk in by 1e-5 to 1e-3 of the body's size.
pub(super) fn rest(random: &mut Random, round: usize) -> Rest {
    loop {
        let rest = laid(random, round);
        // On a narrow face it may have been placed beside the ground.
        if exact_overlap3((&rest.ground, &rest.here), (&rest.body, &rest.there)) {
            return rest;
        }
    }
}

fn laid(random: &mut Random, round: usize) -> Rest {
    let body = body(random, round);
    let (ground, turn, height) = ground(random, round);
    let down = DQuat::from_rotation_arc(downwards(random, &body), DVec3::NEG_Y);
    let half_angle = random.direction2();
    let spin = DQuat::from_xyzw(0.0, half_angle.y, 0.0, half_angle.x) * down;
    let vertices = body.core().vertices().to_vec();
    let turned: Vec<DVec3> = vertices.iter().map(|v| spin * v.as_dvec3()).collect();
    let lowest = turned.iter().map(|v| v.y).fold(f64::INFINITY, f64::min) - f64::from(body.radius());
    let size = f64::from(body.outer_radius());
    let sunk = size * random.pick(&[1e-5, 3e-5, 1e-4, 3e-4, 1e-3]);
    // The foot's centre is placed near the ground's centre, so that most of it is supported.
    let foot: Vec<&DVec3> =
        turned.iter().filter(|v| v.y - f64::from(body.radius()) - lowest < 1e-4 * size).collect();
    let middle = foot.iter().copied().sum::<DVec3>() / foot.len() as f64;
    let center = top(&ground, turn, height);
    let place = DVec3::new(center.x - middle.x, height - lowest - sunk, center.z - middle.z);
    // On the crown of a capsule there is no room to move aside.
    let room = if ground.radius() > 0.0 { 0.0 } else { 0.05 };
    let aside = DVec3::new(random.between(-room, room), 0.0, random.between(-room, room));
    // Finally the ground, with all that stands on it, is moved somewhere else.
    let q = random.quaternion();
    let all = DQuat::from_xyzw(q.x.into(), q.y.into(), q.z.into(), q.w.into()).normalize();
    let origin = random.vector() * random.pick(&[1.0, 4.0]);
    let pose = |place: DVec3, turn: DQuat| Pose3::new(origin + all * place, rounded(all * turn)).unwrap();
    let (here, there) = (pose(DVec3::ZERO, turn), pose(place + aside, spin));
    let outer = f64::from(ground.outer_radius());
    let size = size + if outer.is_finite() { outer } else { 0.0 };
    Rest { ground, here, body, there, size }
}
