//! Bodies that turn while they touch something: what they run into.

use asunder::glam::{DVec3, Quat, Vec2, Vec3};
use asunder::{
    Chain, Collider3, Compound2, Compound3, Cuboid, Motion2, Motion3, Pair2, Pair3, Pose2, Pose3, Rect,
    Rotation2, Shape2, Shape3, TriMesh, World3,
};

fn yaw(degrees: f64) -> Quat {
    let half = turned(degrees * 0.5);
    Quat::from_xyzw(0.0, half.sin(), 0.0, half.cos())
}

fn turned(degrees: f64) -> Rotation2 {
    Rotation2::from_angle(degrees.to_radians() as f32).unwrap()
}

/// The surface of a box, and a floor of two triangles.
fn box_on_floor(half: Vec3, at: Vec3) -> Shape3 {
    let side = |i: u32, bit: u32| if i & bit == 0 { -1.0 } else { 1.0 };
    let corner = |i: u32| at + half * Vec3::new(side(i, 1), side(i, 2), side(i, 4));
    let mut vertices: Vec<Vec3> = (0..8).map(corner).collect();
    let faces: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut triangles: Vec<[u32; 3]> =
        faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    vertices.extend([(-8.0, -8.0), (-8.0, 8.0), (8.0, -8.0), (8.0, 8.0)].map(|(x, z)| Vec3::new(x, 0.0, z)));
    triangles.extend([[8, 9, 10], [10, 9, 11]]);
    TriMesh::new(vertices, triangles).unwrap().into()
}

/// Symptom: a box that turns on its floor, and touches it, went 0.1 m into a wall without an impact. Cause: at the
/// start the box and the wall stand beside each other, but along the normal of their later impact they overlap by 0.2
/// m; how far the box goes in was counted from that depth.
#[test]
fn who_turns_on_its_floor_runs_into_the_wall() {
    let shape = |half: Vec3| Shape3::from(Cuboid::from_half_extents(half).unwrap());
    let body = shape(Vec3::new(0.4, 0.5, 0.3));
    let (half, at) = (Vec3::new(0.4, 0.4, 0.25), Vec3::new(1.0, 0.4, -0.3));
    let (wall, stands) = (shape(half), Pose3::at(at).unwrap());
    let floor = (Pose3::at([0.0, -0.5, 0.0]).unwrap(), shape(Vec3::new(8.0, 0.5, 8.0)));
    let yard = Shape3::from(Compound3::new([floor, (stands, wall.clone())]).unwrap());
    let mesh = box_on_floor(half, at);
    for from in [95.0, 105.0] {
        let pose = Pose3::new([0.0, 0.497, 0.0], yaw(from)).unwrap();
        let motion = Motion3::new([0.3, 0.0, 0.15], yaw(180.0)).unwrap();
        let alone = Pair3::new(&body, &pose, &wall, &stands).impact(&motion, &Motion3::STILL).unwrap();
        assert!(!alone.overlapping && alone.fraction > 0.5);
        for ground in [&yard, &mesh] {
            let pair = Pair3::new(&body, &pose, ground, &Pose3::IDENTITY);
            let told = pair.next_impact(&motion, &Motion3::STILL);
            assert!(
                told.is_some_and(|it| (it.fraction - alone.fraction).abs() < 1e-6),
                "{from}: {told:?} {alone:?}"
            );
            let mut world = World3::new();
            world.insert(Collider3::new(ground.clone()).fixed());
            let bullet = world.insert(Collider3::new(body.clone()).at(pose).bullet());
            world.set_motion(bullet, motion).unwrap();
            world.update();
            assert_eq!(world.impacts().len(), 1, "{from}");
        }
    }
}

/// The same in the plane, for a rod that stands on its floor with one corner.
#[test]
fn who_turns_on_its_floor_of_the_plane_runs_into_the_wall() {
    let shape = |x: f32, y: f32| Shape2::from(Rect::from_half_extents(Vec2::new(x, y)).unwrap());
    let (rod, wall, floor) = (shape(0.6, 0.15), shape(0.1, 0.4), shape(8.0, 0.5));
    let stands = Pose2::at([0.3, 1.0]).unwrap();
    let (pose, motion) =
        (Pose2::new([0.0, 0.498], turned(-40.0)).unwrap(), Motion2::new([0.0, 0.3], turned(-140.0)).unwrap());
    let alone = Pair2::new(&rod, &pose, &wall, &stands).impact(&motion, &Motion2::STILL).unwrap();
    let yard =
        Compound2::new([(Pose2::at([0.0, -0.5]).unwrap(), floor), (stands, wall)]).map(Shape2::from).unwrap();
    let told =
        Pair2::new(&rod, &pose, &yard, &Pose2::IDENTITY).next_impact(&motion, &Motion2::STILL).unwrap();
    assert!((told.fraction - alone.fraction).abs() < 1e-6 && !told.overlapping, "{told:?} {alone:?}");
}

/// Counterexample: things that are deep along a later normal at the start without being beside the body, the far faces
/// of a hill on whose top a body slides and spins. The body comes out of them, and hits none.
#[test]
fn who_spins_and_slides_over_a_hill_is_stopped_by_none_of_its_faces() {
    let (radius, step, count) = (60.0, 0.5, 24);
    let height = |x: f64| -x * x / (2.0 * radius);
    let xs: Vec<f64> = (-count..=count).map(|i| f64::from(i) * step).collect();
    let hill = Shape2::from(Chain::open(xs.iter().map(|&x| Vec2::new(x as f32, height(x) as f32))).unwrap());
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for (&x, i) in xs.iter().zip(0..) {
        vertices.extend([-4.0, 4.0].map(|z| DVec3::new(x, height(x), z).as_vec3()));
        if i > 0 {
            let k = 2 * (i - 1);
            triangles.extend([[k, k + 1, k + 2], [k + 2, k + 1, k + 3]]);
        }
    }
    let ridge = Shape3::from(TriMesh::new(vertices, triangles).unwrap());
    let (body, flat) = (
        Shape3::from(Cuboid::from_half_extents(Vec3::new(0.4, 0.3, 0.4)).unwrap()),
        Shape2::from(Rect::from_half_extents(Vec2::new(0.4, 0.3)).unwrap()),
    );
    for i in 0..400 {
        let pressed = [1e-6, 1e-3, 0.01, 0.02][i % 4];
        let way = 0.25 * (1 + i / 4 % 20) as f64;
        let spin = 9.0 * (i % 11) as f64;
        let pose = Pose3::at([0.01, 0.3 - pressed, 0.1]).unwrap();
        let motion = Motion3::new([way, 0.0, 0.3], yaw(spin)).unwrap();
        let pair = Pair3::new(&body, &pose, &ridge, &Pose3::IDENTITY);
        assert!(pair.overlaps());
        let told = pair.next_impact(&motion, &Motion3::STILL);
        assert_eq!(told, None, "{i}: {way} {spin}");
        // In the plane, the body tilts as the hill does there.
        let lean = Rotation2::new(1.0, (-way / radius) as f32).unwrap();
        let (pose, motion) = (
            Pose2::at([0.01, 0.3 - pressed]).unwrap(),
            Motion2::new([way, height(way).max(-0.3)], lean).unwrap(),
        );
        let pair = Pair2::new(&flat, &pose, &hill, &Pose2::IDENTITY);
        assert!(pair.overlaps());
        let told = pair.next_impact(&motion, &Motion2::STILL);
        assert_eq!(told, None, "{i}: {way}");
    }
}
