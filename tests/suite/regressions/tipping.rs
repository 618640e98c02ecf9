//! Bodies that lie on one-sided ground, or stand against its rim, and turn.
//!
//! Symptom: a crate a hair above a one-sided floor, with its face on it, that turned over fell through: 40 of 108 of its
//! motions had no impact, wherever an impact had left it. Cause: a body whose touching point moves away from the ground's
//! front was taken to come out of the ground. Of a face that lies on a floor, any point may be found to touch, and one
//! side of it rises as the other sinks.

use asunder::{
    Capsule2, Capsule3, Chain, Compound3, Cuboid, HeightField, Hull, Motion2, Motion3, Pair2, Pair3, Pose2,
    Pose3, Rect, Separation2, Separation3, Shape2, Shape3, TriMesh,
};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// How deep rounding of rotations may be, in metres.
const ROUNDING: f32 = 2e-6;

/// Poses of a motion that are looked at.
const MOMENTS: u32 = 200;

fn moments(until: f64) -> impl Iterator<Item = f64> {
    (0..=MOMENTS).map(move |i| until * f64::from(i) / f64::from(MOMENTS))
}

fn square() -> [Vec3; 4] {
    [[-9.0, 0.0, -9.0], [-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0]].map(Vec3::from)
}

/// Asserts that a body does not sink into ground before its impact, and returns whether there is one.
fn is_stopped(body: (&Shape3, &Pose3), ground: (&Shape3, &Pose3), motion: &Motion3) -> bool {
    let impact = Pair3::new(body.0, body.1, ground.0, ground.1).impact(motion, &Motion3::STILL);
    for at in moments(impact.map_or(1.0, |impact| impact.fraction)) {
        let pose = motion.pose_at(body.1, at);
        let Separation3::Measured(found) =
            Pair3::new(body.0, &pose, ground.0, ground.1).separation(f32::INFINITY)
        else {
            panic!("no limit, yet no measure");
        };
        assert!(found.separation > -ROUNDING, "{motion:?} of {body:?} at {at}: {found:?}, {impact:?}");
    }
    impact.is_some()
}

#[test]
fn what_lies_on_a_one_sided_floor_and_turns_does_not_fall_through_in_space() {
    let cube = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap();
    let corners = cube.vertices().to_vec();
    let capsule = Capsule3::new(Vec3::NEG_X, Vec3::X, 0.5).unwrap();
    let bodies: [Shape3; 5] = [
        cube.into(),
        Hull::from_points(&corners).unwrap().into(),
        Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap().rounded(0.1).unwrap().into(),
        capsule.into(),
        Compound3::new([(Pose3::IDENTITY, Shape3::from(cube))]).unwrap().into(),
    ];
    let mesh = TriMesh::new(square(), [[0, 1, 2], [0, 2, 3]]).unwrap().one_sided();
    let field = HeightField::new(2, 2, [0.0; 4], Vec2::splat(18.0)).unwrap().one_sided();
    let floors: [(Shape3, Pose3); 2] =
        [(mesh.into(), Pose3::IDENTITY), (field.into(), Pose3::at([-9.0, 0.0, -9.0]).unwrap())];
    let mut stopped = 0;
    for (body, (floor, there)) in bodies.iter().flat_map(|body| floors.iter().map(move |floor| (body, floor)))
    {
        for gap in [1e-12, 1e-9, 1e-6, 1e-5] {
            for (x, z) in [(3.0, -2.0), (-3.0, 2.0), (0.0, 0.0)] {
                let from = Pose3::at([x, 0.5 + gap, z]).unwrap();
                for spin in [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z] {
                    for way in [DVec3::ZERO, DVec3::Y * 1e-3, DVec3::X * 0.1] {
                        let motion = Motion3::of_velocities(&from, way, spin, 1.0).unwrap();
                        stopped += usize::from(is_stopped((body, &from), (floor, there), &motion));
                    }
                }
            }
        }
    }
    // A capsule may roll about its own axis.
    assert!(stopped > 1200, "{stopped}");
}

/// A plate that stands with its face against the rim of a one-sided mesh, across its plane, and turns into it as it rises.
#[test]
fn what_stands_against_a_one_sided_rim_and_turns_is_stopped() {
    let mesh = Shape3::from(TriMesh::new(square(), [[0, 1, 2], [0, 2, 3]]).unwrap().one_sided());
    let plate = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.5, 0.25, 0.03)).unwrap());
    let mut stopped = 0;
    for (gap, x) in [1e-9, 1e-7].into_iter().flat_map(|gap| [-3.0, 0.0, 3.0].map(|x| (gap, x))) {
        let from = Pose3::at([x, 0.1, -9.0 - 0.03 - gap]).unwrap();
        for spin in [DVec3::Y, DVec3::NEG_Y, DVec3::Y + DVec3::X * 0.1, DVec3::NEG_Y + DVec3::X * 0.1] {
            for rise in [0.0, 0.05, 0.5] {
                let motion = Motion3::of_velocities(&from, DVec3::Y * rise, spin, 0.5).unwrap();
                stopped += usize::from(is_stopped((&plate, &from), (&mesh, &Pose3::IDENTITY), &motion));
            }
        }
    }
    assert_eq!(stopped, 72);
}

#[test]
fn what_lies_on_a_one_sided_chain_and_turns_does_not_fall_through() {
    let bodies: [Shape2; 2] = [
        Rect::from_half_extents(Vec2::splat(0.5)).unwrap().into(),
        Capsule2::new(Vec2::NEG_X, Vec2::X, 0.5).unwrap().into(),
    ];
    let floor = Shape2::from(Chain::open([9.0, -9.0].map(|x| Vec2::new(x, 0.0))).unwrap().one_sided());
    let mut stopped = 0;
    for (body, gap) in bodies.iter().flat_map(|body| [1e-14, 1e-12, 1e-9, 1e-7].map(|gap| (body, gap))) {
        for (x, spin) in [-3.0, 0.0, 3.0].into_iter().flat_map(|x| [(x, 1.0), (x, -1.0)]) {
            let from = Pose2::at([x, 0.5 + gap]).unwrap();
            for way in [DVec2::ZERO, DVec2::Y * 1e-3, DVec2::X * 0.1] {
                let motion = Motion2::of_velocities(&from, way, spin, 1.0).unwrap();
                let impact =
                    Pair2::new(body, &from, &floor, &Pose2::IDENTITY).impact(&motion, &Motion2::STILL);
                for at in moments(impact.map_or(1.0, |impact| impact.fraction)) {
                    let pose = motion.pose_at(&from, at);
                    let Separation2::Measured(found) =
                        Pair2::new(body, &pose, &floor, &Pose2::IDENTITY).separation(f32::INFINITY)
                    else {
                        panic!("no limit, yet no measure");
                    };
                    assert!(found.separation > -ROUNDING, "{motion:?} from {from:?} at {at}: {found:?}");
                }
                stopped += usize::from(impact.is_some());
            }
        }
    }
    assert_eq!(stopped, 144);
}
