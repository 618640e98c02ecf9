//! Everything that is reported for a contact on ground, against a loop over all triangles.

use super::scenes::{BODIES, Random, body, flat, grid, mesh, sees, stick};
use asunder_geometry::glam::{DVec3, Quat, Vec2, Vec3};
use asunder_geometry::tolerance::EVEN_DEPTH;
use asunder_geometry::{Compound3, Cuboid, Ground, HalfSpace, HeightField, Pose3, Shape3, Sphere, Triangle3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Manifold3, Pair3, Separation3, collide3};

/// A point may be off both surfaces by this share of the sizes: faces count as flat within a few 2.5e-7, positions as
/// the same within 1e-6 of the body, and anchors are f32.
const ON_SURFACE: f64 = 4e-6;

/// Two normals that share a manifold may differ by this, and its points may be measured along either.
const NORMALS: f64 = 2.1e-4;

/// A body near ground.
struct Scene {
    shape: Shape3,
    pose: Pose3,
    ground: Shape3,
    ground_pose: Pose3,
    margin: f32,
}

/// What the narrow phase reports.
struct Told {
    /// Whether they overlap, if they are in contact.
    contact: Option<bool>,
    manifolds: Vec<Manifold3>,
}

impl Scene {
    fn told(&self, sensor: bool) -> Told {
        let job = Job3 {
            shape_a: &self.shape,
            pose_a: &self.pose,
            shape_b: &self.ground,
            pose_b: &self.ground_pose,
            margin: self.margin,
            hint: Hint::NONE,
            ahead: 0.0,
            sensor,
        };
        let mut batch = Batch3::default();
        collide3(&[job], &mut batch);
        let contact = match &batch.answers[0] {
            Answer::Apart { .. } => None,
            Answer::Contact { overlapping, .. } => Some(*overlapping),
        };
        Told { contact, manifolds: batch.manifolds.clone() }
    }

    fn triangles(&self) -> impl Iterator<Item = Triangle3> {
        let ground = Ground::of(&self.ground).unwrap();
        (0..ground.triangle_count()).filter_map(move |number| ground.triangle(number))
    }

    /// The convex parts, each as a shape to be posed as the body is, with their centres in the body's axes.
    fn parts(&self) -> Vec<(Shape3, DVec3)> {
        match &self.shape {
            Shape3::Compound(compound) => compound
                .parts()
                .iter()
                .map(|part| {
                    let alone = Compound3::new([(*part.pose(), part.shape().clone())]).unwrap();
                    (alone.into(), part.center())
                })
                .collect(),
            // Its centre is taken far inside.
            Shape3::HalfSpace(half_space) => vec![(self.shape.clone(), half_space.unit_normal() * -1e12)],
            shape => vec![(shape.clone(), shape.center().as_dvec3())],
        }
    }

    /// Whether a part overlaps a triangle that faces it; `None` where rounding decides which triangles do.
    fn overlaps(&self) -> Option<bool> {
        let mut is_any = false;
        for (part, center) in self.parts() {
            let center = self.ground_pose.transform_back(self.pose.transform(center));
            for triangle in self.triangles() {
                if Ground::of(&self.ground).unwrap().is_one_sided() && !sees(&triangle, center)? {
                    continue;
                }
                is_any |= Pair3::new(&part, &self.pose, &triangle.into(), &self.ground_pose).overlaps();
            }
        }
        Some(is_any)
    }

    /// How far a point is from the surface of a part, in metres.
    fn off_part(&self, part: &Shape3, place: DVec3) -> f64 {
        off(part, &self.pose, place).abs()
    }

    fn off_ground(&self, place: DVec3) -> f64 {
        self.triangles()
            .map(|triangle| off(&triangle.into(), &self.ground_pose, place).abs())
            .fold(f64::INFINITY, f64::min)
    }
}

/// The signed distance of a point from a convex shape.
fn off(shape: &Shape3, pose: &Pose3, place: DVec3) -> f64 {
    let radius = 1e-3;
    let probe: Shape3 = Sphere::new(radius).unwrap().into();
    let there = Pose3::at(place).unwrap();
    match Pair3::new(shape, pose, &probe, &there).separation(f32::INFINITY) {
        Separation3::Measured(found) => f64::from(found.separation) + f64::from(radius),
        Separation3::AtLeast(_) => f64::INFINITY,
    }
}

fn check(scene: &Scene, what: &str) -> Option<bool> {
    let told = scene.told(false);
    let sensor = scene.told(true);
    assert_eq!(told.contact, sensor.contact, "{what}: a sensor says the same");
    assert!(sensor.manifolds.is_empty());
    assert_eq!(told.contact.is_some(), !told.manifolds.is_empty(), "{what}: a contact has points");
    if let Some(overlaps) = scene.overlaps() {
        assert_eq!(told.contact.unwrap_or(false), overlaps, "{what}: overlap");
    }
    let size = 2.0 * f64::from(scene.shape.outer_radius());
    let parts = scene.parts();
    for manifold in &told.manifolds {
        assert!((manifold.normal.length() - 1.0).abs() < 1e-6, "{what}: {manifold:?}");
        assert!(manifold.error >= 0.0 && !manifold.points.is_empty() && manifold.part_a < parts.len() as u32);
        let part = &parts[manifold.part_a as usize].0;
        let least = manifold.points.iter().map(|p| p.separation).fold(f32::INFINITY, f32::min);
        // Of more than four corners, one that counts as deepest within the tolerance is kept.
        let is_full = manifold.points.len() == 4;
        let even = if is_full { 2.0 * EVEN_DEPTH as f32 * part.outer_radius() } else { 0.0 };
        let (beyond, error) = (least - manifold.separation, manifold.error);
        assert!((-error..=error + even).contains(&beyond), "{what}: {manifold:?}");
        for point in &manifold.points {
            let on_body = scene.pose.position() + point.anchor_a.as_dvec3();
            let on_ground = scene.ground_pose.position() + point.anchor_b.as_dvec3();
            let reach = size + f64::from(point.anchor_b.length());
            let (body, ground) = (scene.off_part(part, on_body), scene.off_ground(on_ground));
            assert!(body <= ON_SURFACE * reach, "{what}: {body} off the body: {manifold:?}");
            assert!(ground <= ON_SURFACE * reach, "{what}: {ground} off the ground: {manifold:?}");
            let along = manifold.normal.as_dvec3().dot(on_ground - on_body);
            let between = (on_ground - on_body).length();
            assert!(
                (along - f64::from(point.separation)).abs() <= ON_SURFACE * reach + NORMALS * between,
                "{what}: {along} in {manifold:?}"
            );
            assert!(point.separation <= scene.margin + manifold.error + 1e-6 || told.contact == Some(true));
        }
        assert!(
            manifold.points.is_sorted_by(|one, other| one.feature < other.feature),
            "{what}: {manifold:?}"
        );
    }
    let least = told.manifolds.iter().map(|m| m.separation).fold(f32::INFINITY, f32::min);
    assert_eq!(least <= 0.0, told.contact == Some(true), "{what}: {least}");
    told.contact
}

/// Number of kinds of ground.
const GROUNDS: usize = 8;

/// Hills, ridges and spikes; separate triangles; a plane; steps. As meshes, and as height fields with holes.
fn ground(random: &mut Random, kind: usize) -> Shape3 {
    let is_one_sided = random.below(2) == 0;
    let step = |x: usize, z: usize| ((x * 5 + z * 3) % 7) as f32 * 0.25;
    let mut bumps = |rough: f64| -> Vec<f32> { (0..81).map(|_| (random.signed() * rough) as f32).collect() };
    let made = match kind {
        0 | 1 => {
            let heights = bumps([0.1, 0.6][kind]);
            mesh(grid([8; 2], 0.5, |x, z| Vec3::Y * heights[z * 9 + x]))
        }
        2 => {
            let mut point = || random.vector().as_vec3() * 1.2;
            let vertices: Vec<Vec3> = (0..30).map(|_| point()).collect();
            let triangles = (0..20).map(|_| [0; 3].map(|_| random.below(30) as u32));
            let is_proper = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
            mesh((vertices, triangles.filter(is_proper).collect()))
        }
        3 => flat(2),
        // Steps of a quarter of a metre.
        4 => mesh(grid([8; 2], 0.5, |x, z| Vec3::Y * step(x, z))),
        _ => {
            let heights = match kind {
                5 | 6 => bumps([0.1, 0.6][kind - 5]),
                _ => (0..81).map(|number| step(number % 9, number / 9)).collect(),
            };
            let field = HeightField::new(9, 9, heights, Vec2::splat(0.5)).unwrap();
            let mut hole = || (random.below(8), random.below(8));
            let field = field.with_holes([hole(), hole(), hole()]).unwrap();
            return if is_one_sided { field.one_sided() } else { field }.into();
        }
    };
    if is_one_sided { made.one_sided() } else { made }.into()
}

fn scene(random: &mut Random, round: usize) -> Scene {
    let ground = ground(random, round % GROUNDS);
    let triangles = Ground::of(&ground).unwrap();
    let triangle = random.below(triangles.triangle_count() as usize) as u32;
    let corner = triangles.corners(triangle)[random.below(3)].as_dvec3();
    let kind = random.below(BODIES + 1);
    let shape = if kind == BODIES { stick() } else { body(kind) };
    let place = corner + random.vector() * 0.7;
    let far = if random.below(3) == 0 { random.vector() * 1e5 } else { DVec3::ZERO };
    let ground_turn = if random.below(2) == 0 { random.rotation() } else { Quat::IDENTITY };
    let ground_pose = Pose3::new(far, ground_turn).unwrap();
    let position = ground_pose.transform(place);
    let turn = if random.below(4) == 0 { Quat::IDENTITY } else { random.rotation() };
    let margin = if random.below(2) == 0 { 0.0 } else { 0.05 };
    Scene { shape, pose: Pose3::new(position, turn).unwrap(), ground, ground_pose, margin }
}

#[test]
fn what_is_told_of_bodies_on_any_ground_is_what_a_loop_over_its_triangles_says() {
    let mut random = Random::new(41);
    let mut counts = [0; 3];
    for round in 0..5000 {
        let scene = scene(&mut random, round);
        let contact = check(&scene, &format!("round {round}"));
        counts[contact.map_or(0, |overlapping| 1 + usize::from(overlapping))] += 1;
    }
    assert!(counts.iter().all(|&count| count > 100), "apart, near, overlapping: {counts:?}");
}

#[test]
fn touching_is_exact() {
    let mut random = Random::new(43);
    let mut counts = [0; 2];
    for round in 0..3000 {
        // Steps, a plane, or steps with holes.
        let kind = [4, 3, 7][round / 3 % 3];
        let ground = ground(&mut random, kind);
        let mut eighths = |least: usize, most: usize| (least + random.below(most - least)) as f64 / 8.0;
        let half = Vec3::new(0.5, eighths(1, 5) as f32, 0.25);
        let place = DVec3::new(eighths(0, 24) - 1.5, eighths(0, 20), eighths(0, 24) - 1.5);
        let shape: Shape3 = match round % 3 {
            0 => Cuboid::from_half_extents(half).unwrap().into(),
            1 => Cuboid::from_half_extents(half).unwrap().rounded(0.125).unwrap().into(),
            _ => Sphere::new(half.y).unwrap().into(),
        };
        // Sometimes one ulp higher.
        let place = if round % 7 == 0 { place.with_y(place.y.next_up()) } else { place };
        // Height fields start at their origin, the meshes are centred on theirs.
        let aside = if kind == 7 { -2.0 } else { 0.0 };
        let (pose, ground_pose) = (Pose3::at(place).unwrap(), Pose3::at([aside, 0.0, aside]).unwrap());
        let scene = Scene { shape, pose, ground, ground_pose, margin: 0.0 };
        if let Some(overlapping) = check(&scene, &format!("round {round}")) {
            counts[usize::from(overlapping)] += 1;
        }
    }
    assert!(counts[1] > 300, "{counts:?}");
}

#[test]
fn half_spaces_and_ground_are_told_of_exactly() {
    let mut random = Random::new(47);
    let mut seen = 0;
    for round in 0..400 {
        let ground = ground(&mut random, round % GROUNDS);
        let ground_pose = Pose3::new(random.vector(), random.rotation()).unwrap();
        let pose = Pose3::new(random.vector(), random.rotation()).unwrap();
        let shape: Shape3 = HalfSpace::new(Vec3::Y).unwrap().into();
        let scene = Scene { shape, pose, ground, ground_pose, margin: 0.02 };
        let told = scene.told(false);
        let Some(overlaps) = scene.overlaps() else { continue };
        assert_eq!(told.contact.unwrap_or(false), overlaps, "round {round}");
        for point in told.manifolds.iter().flat_map(|manifold| &manifold.points) {
            let on_ground = ground_pose.position() + point.anchor_b.as_dvec3();
            assert!(scene.off_ground(on_ground) < 1e-5);
            let height = pose.turn(DVec3::Y).dot(on_ground - pose.position());
            assert!((height - f64::from(point.separation)).abs() < 1e-5);
            seen += 1;
        }
    }
    assert!(seen > 500, "{seen}");
}
