//! Ground of many low bends in a row: each too low to give a normal, and together not a plane under one body.

use asunder_geometry::glam::{DQuat, DVec3, Vec2, Vec3};
use asunder_geometry::{Capsule3, Cuboid, Ground, HeightField, Hull, Pose3, Shape3, Sphere, TriMesh};
use asunder_narrow::{Batch3, Hint, Job3, Manifold3, Pair3, Persistent3, collide3};
use asunder_tests::bare_triangles::{nearest, told_within};
use asunder_tests::cases::Random;
use core::fmt;

const MARGIN: f32 = 0.02;

/// Ground, its triangles, its rotation from axes in which up is y, and its centre.
struct Laid {
    shape: Shape3,
    corners: Vec<[Vec3; 3]>,
    turn: DQuat,
    middle: DVec3,
}

impl Laid {
    fn new(shape: Shape3, turn: DQuat, middle: DVec3) -> Self {
        let ground = Ground::of(&shape).unwrap();
        let corners = (0..ground.triangle_count()).map(|number| ground.corners(number)).collect();
        Self { shape, corners, turn, middle }
    }

    fn place(&self, local: DVec3) -> DVec3 {
        self.middle + self.turn * local
    }
}

/// The height of a kind of ground at a place in cells, scaled so that its bends are about one.
fn height(random: &mut Random, kind: usize, [x, z]: [f64; 2], [along_x, along_z]: [f64; 2]) -> f64 {
    let dome = -0.5 * (x * x * along_x + z * z * along_z);
    match kind {
        0 => dome,
        1 => -0.5 * x.abs() + 0.2 * along_z * z,
        2 => {
            let across = x * along_x + z * (1.0 - along_z);
            -0.5 * across * across
        }
        3 => 0.5 * (x * x * along_x - z * z * along_z),
        4 => -dome,
        5 => 0.4 * random.signed(),
        6 => -0.5 * x.rem_euclid(4.0).min(4.0 - x.rem_euclid(4.0)),
        _ => dome + 0.3 * random.signed(),
    }
}

/// Domes, roofs, cylinders, saddles, bowls, cobbles, ridges and bumps on a dome: meshes, turned or not, and height
/// fields.
fn ground(random: &mut Random, bend: f64) -> Laid {
    let (kind, cells) = (random.below(8), random.pick(&[6_u32, 10, 16, 24]));
    let step = random.pick(&[0.04, 0.1, 0.25, 0.6]) * random.between(0.7, 1.3);
    // No smaller than what stands on it: beyond its rims one-sided ground gives no contacts.
    let step = step.max(1.6 / f64::from(cells));
    let along = [0, 1].map(|_| random.pick(&[1.0, 1.0, 0.3]));
    let shift = [0, 1].map(|_| 0.5 * random.signed());
    let half = f64::from(cells) / 2.0;
    let up = |random: &mut Random, [i, j]: [u32; 2]| {
        let place = [f64::from(i) - half + shift[0], f64::from(j) - half + shift[1]];
        bend * step * height(random, kind, place, along)
    };
    let is_one_sided = random.below(2) == 0;
    if random.below(3) == 0 {
        let heights: Vec<f32> = (0..=cells)
            .flat_map(|j| (0..=cells).map(move |i| [i, j]))
            .map(|at| up(random, at) as f32)
            .collect();
        let side = cells as usize + 1;
        let field = HeightField::new(side, side, heights, Vec2::splat(step as f32)).unwrap();
        let shape = if is_one_sided { field.one_sided() } else { field }.into();
        let middle = DVec3::new(half, 0.0, half) * step;
        return Laid::new(shape, DQuat::IDENTITY, middle);
    }
    let turn =
        if random.below(3) == 0 { DQuat::IDENTITY } else { random.quaternion().as_dquat().normalize() };
    let jitter = random.pick(&[0.0, 0.2]);
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for [i, j] in (0..=cells).flat_map(|i| (0..=cells).map(move |j| [i, j])) {
        let [x, z] = [i, j].map(|at| (f64::from(at) - half + jitter * random.signed()) * step);
        vertices.push((turn * DVec3::new(x, up(random, [i, j]), z)).as_vec3());
        if i < cells && j < cells {
            let (at, next) = (i * (cells + 1) + j, (i + 1) * (cells + 1) + j);
            triangles.extend(if (i + j) % 2 == 0 {
                [[at, at + 1, next], [at + 1, next + 1, next]]
            } else {
                [[at, at + 1, next + 1], [at, next + 1, next]]
            });
        }
    }
    let mesh = TriMesh::new(vertices, triangles).unwrap();
    let shape = if is_one_sided { mesh.one_sided() } else { mesh }.into();
    Laid::new(shape, turn, DVec3::ZERO)
}

fn body(random: &mut Random) -> Shape3 {
    let size = random.pick(&[1.0, 1.0, 0.4]);
    let round = (random.between(0.01, 0.2) * size) as f32;
    let half = [0, 1, 2].map(|_| (random.between(0.05, 0.5) * size) as f32);
    let cuboid = Cuboid::from_half_extents(Vec3::from(half)).unwrap();
    let count = 9 + random.below(12);
    let points: Vec<Vec3> = (0..count).map(|_| (random.vector() * 0.5 * size).as_vec3()).collect();
    let hull = Hull::from_points(&points).unwrap();
    match random.below(7) {
        0 => cuboid.into(),
        1 => hull.into(),
        2 => cuboid.rounded(round).unwrap().into(),
        3 => hull.rounded(round).unwrap().into(),
        4 => Capsule3::new(Vec3::X * -half[0], Vec3::X * half[0], round).unwrap().into(),
        5 => Sphere::new(half[0]).unwrap().into(),
        _ => {
            // A prism of many sides.
            let rim = || {
                let way = random.direction();
                DVec3::new(way.x, 0.0, way.z).normalize() * 0.5 * size
            };
            let rims: Vec<DVec3> = core::iter::repeat_with(rim).take(count).collect();
            let points =
                rims.iter().flat_map(|&at| [-0.3, 0.3].map(|up| (at + DVec3::Y * (up * size)).as_vec3()));
            Hull::from_points(&points.collect::<Vec<_>>()).unwrap().into()
        }
    }
}

/// A body on ground: its true distance from the triangles one by one, with an error; and the manifolds.
struct Case {
    story: String,
    radius: f64,
    truth: (f64, f64),
    manifolds: Vec<Manifold3>,
}

impl fmt::Display for Case {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(&self.story)
    }
}

/// A body on ground.
struct Stand {
    laid: Laid,
    body: Shape3,
    at: Pose3,
    /// Whether the ground is A.
    is_turned: bool,
}

/// A body lowered onto ground with bends of about `bend` until its least separation is about `gap`.
fn stand(random: &mut Random, bend: f64, gap: f64) -> Stand {
    let (laid, body) = (ground(random, bend), body(random));
    let about = laid.turn * DQuat::from_rotation_y(random.between(0.0, 6.0));
    let lean = DQuat::from_scaled_axis(random.vector() * random.pick(&[1e-5, 1e-4, 1e-3]));
    let pose = match random.below(4) {
        0 => random.quaternion(),
        1 => (about * lean).as_quat(),
        _ => about.as_quat(),
    };
    let (x, z) = (random.between(-0.3, 0.3), random.between(-0.3, 0.3));
    let at = |height: f64| Pose3::new(laid.place(DVec3::new(x, height, z)), pose).unwrap();
    let mut height = 1.5;
    for _ in 0..3 {
        let Some((above, _)) = nearest(&body, &at(height), &laid.corners, 3.0) else { break };
        height -= above - gap;
    }
    let at = at(height);
    Stand { laid, body, at, is_turned: random.below(2) == 1 }
}

impl Stand {
    /// Orders the body's and the ground's as A's and B's.
    fn ordered<T>(&self, [body, ground]: [T; 2]) -> [T; 2] {
        if self.is_turned { [ground, body] } else { [body, ground] }
    }

    fn truth(&self, at: &Pose3) -> Option<(f64, f64)> {
        nearest(&self.body, at, &self.laid.corners, 0.1)
    }
}

fn case(random: &mut Random, bend: f64, gap: f64) -> Option<Case> {
    let stand = stand(random, bend, gap);
    let truth = stand.truth(&stand.at)?;
    let [a, b] = stand.ordered([(&stand.body, &stand.at), (&stand.laid.shape, &Pose3::IDENTITY)]);
    let body = &stand.body;
    Some(Case {
        story: format!("bend {bend}, gap {gap}, {body:?}"),
        radius: body.outer_radius().into(),
        truth,
        manifolds: Pair3::new(a.0, a.1, b.0, b.1).manifolds(MARGIN),
    })
}

const BENDS: [f64; 8] = [1e-6, 1e-5, 3e-5, 4.5e-5, 6e-5, 9e-5, 1.2e-4, 2e-4];

/// Symptom: over domes, roofs and cobbles of bends that give no normals, gaps were reported too wide by up to a ten
/// thousandth of the body, beyond their errors, in one case of three hundred. Cause: a triangle that rises between the
/// contact points counted only if its normal was theirs, and for each plane only the first triangle processed.
#[test]
fn a_gap_over_many_low_bends_is_within_its_error() {
    let mut random = Random::new(0x0010_BE4D_0D0E);
    let (mut told, mut coarse) = (0, 0);
    for number in 0..6_000 {
        let (bend, gap) = (random.pick(&BENDS), random.pick(&[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1.8e-2]));
        let bend = bend * random.between(0.5, 1.0);
        let Some(case) = case(&mut random, bend, gap) else { continue };
        let (separation, error) = case.truth;
        if separation <= error || separation + error > f64::from(MARGIN) {
            continue;
        }
        let least = told_within(&case.manifolds, case.truth, format_args!("{number}: {case}"));
        told += 1;
        coarse += usize::from(f64::from(least.error) > 1.1e-6 * case.radius);
    }
    assert!(
        told > 5_000 && coarse * 200 < told,
        "{told} told, {coarse} of them with errors above a millionth"
    );
}

/// The same in overlap: the deepest of the triangles one by one bounds how deep a body is in ground.
#[test]
fn an_overlap_over_many_low_bends_is_no_deeper_than_its_error() {
    let mut random = Random::new(0x0010_BE4D_0DEE);
    let mut told = 0;
    for number in 0..6_000 {
        let (bend, depth) = (random.pick(&BENDS), random.pick(&[1e-6, 1e-5, 1e-4, 1e-3]));
        let bend = bend * random.between(0.5, 1.0);
        let Some(case) = case(&mut random, bend, -depth) else { continue };
        let (separation, error) = case.truth;
        if separation >= -error {
            continue;
        }
        let all = case.manifolds.iter();
        let least = all.min_by(|one, other| one.separation.total_cmp(&other.separation));
        let Some(least) = least else { panic!("{number}: {case}: {separation}, and nothing told") };
        let further = f64::from(least.separation) - separation;
        assert!(further <= error + f64::from(least.error), "{number}: {case}: {further} further: {least:?}");
        told += 1;
    }
    assert!(told > 5_000, "{told}");
}

/// Symptom: manifolds that were moved along over low bends were off by up to a millionth of the body beyond their
/// errors, in one case of four hundred. Cause: ground that rises between the points, along normals that count as
/// theirs, changes its separation otherwise than they do; the error added for the motion was known for the points only.
#[test]
fn what_is_moved_along_over_low_bends_is_within_its_error() {
    let mut random = Random::new(0x0010_BE4D_0A1C);
    let mut carried = 0;
    for number in 0..4_000 {
        let bend = random.pick(&BENDS) * random.between(0.5, 1.0);
        let gap = random.pick(&[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, -1e-5, -1e-4, -1e-3]);
        let stand = stand(&mut random, bend, gap);
        let [a, b] = stand.ordered([(&stand.body, &stand.at), (&stand.laid.shape, &Pose3::IDENTITY)]);
        let job = || Job3 {
            shape_a: a.0,
            pose_a: a.1,
            shape_b: b.0,
            pose_b: b.1,
            margin: MARGIN,
            hint: Hint::NONE,
            ahead: 0.0,
            sensor: false,
        };
        let mut batch = Batch3::default();
        collide3(&[job()], &mut batch);
        let Some(kept) = Persistent3::of(&job(), &batch.answers[0], &batch.manifolds) else { continue };
        for _ in 0..6 {
            let radius = f64::from(stand.body.outer_radius());
            let step = random.vector() * (radius * random.pick(&[1e-5, 1e-4, 1e-3, 3e-3]));
            let spin = DQuat::from_scaled_axis(random.vector() * random.pick(&[0.0, 1e-6, 1e-5, 1e-3]));
            let turned = (spin * stand.at.rotation().as_dquat().normalize()).as_quat();
            let at = Pose3::new(stand.at.position() + step, turned).unwrap();
            let [one, other] = stand.ordered([&at, &Pose3::IDENTITY]);
            let mut found = Vec::new();
            if !kept.carry_on([one, other], &mut found) {
                continue;
            }
            let Some((separation, error)) = stand.truth(&at) else { continue };
            carried += 1;
            let told = found.iter().min_by(|one, other| one.separation.total_cmp(&other.separation)).unwrap();
            let off = f64::from(told.separation) - separation;
            // In overlap, the triangles one by one only bound how deep the body is.
            let off = if separation > error { off.abs() } else { off };
            let may = error + f64::from(told.error);
            let story = format!("{number}: bend {bend}, gap {gap}, {:?}", stand.body);
            assert!(off <= may, "{story}: {separation} +- {error}, off {off} after {step}, told {told:?}");
        }
    }
    assert!(carried > 5_000, "{carried}");
}
