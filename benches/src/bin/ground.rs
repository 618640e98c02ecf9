//! Contacts on triangle ground, beside parry3d's: nanoseconds a pair, one body after the other.
//!
//! ```text
//! cargo run --release -p asunder-benches --bin ground [flat|bumps|rough] [cuboid|sphere|...]
//! ```
//! A body of about a metre rests 1 mm deep on a plane, and on bumps, in triangles of half a metre. parry3d keeps its
//! manifolds and its workspace from call to call, the same pair every time, as an engine at rest would.

use asunder_benches::clock::{Samples, time};
use asunder_benches::parry;
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Capsule3, Cuboid, Hull, Pose3, Shape3, Sphere, TriMesh};
use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
use parry3d::query::{ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher};

const SIDE: usize = 100;

fn ground(bumps: f32) -> Result<TriMesh, Box<dyn std::error::Error>> {
    let vertex = |x: usize, z: usize| {
        let height = ((x * 7 + z * 13 + (x * z) % 5) % 11) as f32 / 10.0 * bumps;
        Vec3::new(x as f32 * 0.5 - 25.0, height, z as f32 * 0.5 - 25.0)
    };
    let vertices: Vec<Vec3> = (0..=SIDE).flat_map(|z| (0..=SIDE).map(move |x| vertex(x, z))).collect();
    let mut triangles = Vec::new();
    for z in 0..SIDE as u32 {
        for x in 0..SIDE as u32 {
            let a = z * (SIDE as u32 + 1) + x;
            let [b, c, d] = [a + 1, a + SIDE as u32 + 1, a + SIDE as u32 + 2];
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    Ok(TriMesh::new(vertices, triangles)?)
}

fn bodies() -> Result<Vec<(&'static str, Shape3)>, Box<dyn std::error::Error>> {
    let half = Vec3::new(0.5, 0.3, 0.4);
    // Turned on by the golden angle each.
    let mut at = [1.0, 0.0];
    let points: Vec<Vec3> = (0..32_u32)
        .map(|i| {
            let y = (f64::from(i) + 0.5) / 16.0 - 1.0;
            at = [-0.737_369 * at[0] - 0.675_490 * at[1], 0.675_490 * at[0] - 0.737_369 * at[1]];
            let across = (1.0 - y * y).sqrt();
            (DVec3::new(across * at[0], y, across * at[1]) * 0.5).as_vec3()
        })
        .collect();
    Ok(vec![
        ("cuboid", Cuboid::from_half_extents(half)?.into()),
        ("rounded cuboid", Cuboid::from_half_extents(half)?.rounded(0.05)?.into()),
        ("hull of 32", Hull::from_points(&points)?.into()),
        ("sphere", Sphere::new(0.4)?.into()),
        ("capsule", Capsule3::new(Vec3::NEG_X * 0.4, Vec3::X * 0.4, 0.2)?.into()),
    ])
}

/// Poses all over the ground, each pushed down until it is 1 mm deep.
fn resting(shape: &Shape3, ground: &Shape3, count: usize) -> Vec<Pose3> {
    let number = |i: usize, salt: usize| ((i * 7919 + salt * 104_729) % 1009) as f64 / 1009.0;
    let mut poses = Vec::new();
    for i in 0..count {
        let (x, z) = (number(i, 1) * 40.0 - 20.0, number(i, 2) * 40.0 - 20.0);
        let turn = Quat::from_xyzw(0.0, number(i, 3) as f32, 0.0, 1.0);
        let (mut low, mut high) = (-1.0, 3.0);
        for _ in 0..40 {
            let middle = (low + high) * 0.5;
            let Ok(pose) = Pose3::new(DVec3::new(x, middle, z), turn) else { continue };
            let mut batch = Batch3::default();
            collide3(&[job(shape, &pose, ground)], &mut batch);
            let touches = matches!(batch.answers.first(), Some(Answer::Contact { overlapping: true, .. }));
            (low, high) = if touches { (middle, high) } else { (low, middle) };
        }
        poses.extend(Pose3::new(DVec3::new(x, low - 1e-3, z), turn));
    }
    poses
}

fn job<'a>(shape_a: &'a Shape3, pose_a: &'a Pose3, shape_b: &'a Shape3) -> Job3<'a> {
    let (pose_b, hint) = (&Pose3::IDENTITY, Hint::NONE);
    Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.01, hint, sensor: false }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{:<8} {:<16} {:>9} {:>9} {:>6} {:>10}", "ground", "body", "ns", "parry", "ratio", "manifolds");
    for (name, bumps) in [("flat", 0.0), ("bumps", 0.15), ("rough", 0.6)] {
        let mesh: Shape3 = ground(bumps)?.into();
        let mut shapes = parry::Shapes::default();
        let their_mesh = shapes.convert(&mesh).ok_or("parry3d refuses the mesh")?;
        for (body, shape) in bodies()? {
            if !std::env::args().skip(1).all(|only| name == only || body == only) {
                continue;
            }
            let poses = resting(&shape, &mesh, 200);
            let jobs: Vec<Job3> = poses.iter().map(|pose| job(&shape, pose, &mesh)).collect();
            let theirs = shapes.convert(&shape).ok_or("parry3d refuses the body")?;
            let mut kept: Vec<(Vec<ContactManifold<(), ()>>, Option<_>)> =
                poses.iter().map(|_| (Vec::new(), None)).collect();
            let (mut ours_ns, mut their_ns) = (Samples::default(), Samples::default());
            let mut batch = Batch3::default();
            for _ in 0..15 {
                batch.clear();
                let (ns, ()) = time(|| collide3(&jobs, &mut batch));
                ours_ns.push(ns / jobs.len() as f64, ns);
                let (ns, ()) = time(|| {
                    for (pose, (manifolds, workspace)) in poses.iter().zip(&mut kept) {
                        let between = parry::pose(pose).inv_mul(&parry::pose(&Pose3::IDENTITY));
                        let _ = DefaultQueryDispatcher.contact_manifolds(
                            &between,
                            theirs.as_ref(),
                            their_mesh.as_ref(),
                            0.01,
                            manifolds,
                            workspace,
                        );
                    }
                });
                their_ns.push(ns / jobs.len() as f64, ns);
            }
            let (ours, theirs) = (ours_ns.median().unwrap_or(0.0), their_ns.median().unwrap_or(0.0));
            let manifolds = batch.manifolds.len() as f64 / jobs.len() as f64;
            let ratio = theirs / ours;
            println!("{name:<8} {body:<16} {ours:>9.0} {theirs:>9.0} {ratio:>6.2} {manifolds:>10.2}");
        }
    }
    Ok(())
}
