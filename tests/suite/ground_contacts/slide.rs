//! Bodies that slide over a plane that is cut into triangles do not notice the cuts.
//!
//! A body falls a little each step and is pushed out by its deepest point; there is no friction. On a plane it keeps
//! its speed and its height.

use super::scenes::{BODIES, FLATS, Random, baked, body, flat, rest_height};
use asunder_geometry::glam::{DVec3, Quat, Vec2, Vec3};
use asunder_geometry::{Cuboid, HeightField, Pose3, Shape3, TriMesh};
use asunder_narrow::{Feature, Manifold3, Pair3};

/// Tolerance of the height and of the velocity, as a share of the body's size and of the speed.
const STEADY: f64 = 1e-4;

/// Sine of 0.01 degrees.
const UPRIGHT: f64 = 1.745e-4;

const STEP: f64 = 1.0 / 60.0;

/// A body that slides on a plane, in a world whose up is the ground's y axis.
struct Slide {
    shape: Shape3,
    ground: Shape3,
    ground_pose: Pose3,
    /// Up in the ground's axes.
    up: DVec3,
    /// The plane's height along `up`.
    level: f64,
    turn: Quat,
    rest: f64,
    position: DVec3,
    velocity: DVec3,
    ground_is_b: bool,
    /// Whether the triangles are coplanar even as rounded to f32: then they are one patch.
    is_one_patch: bool,
}

impl Slide {
    fn pose(&self) -> Pose3 {
        let position = self.ground_pose.transform(self.position);
        Pose3::new(position, (self.ground_pose.rotation() * self.turn).normalize()).unwrap()
    }

    fn manifolds(&self) -> Vec<Manifold3> {
        let pose = self.pose();
        if self.ground_is_b {
            Pair3::new(&self.shape, &pose, &self.ground, &self.ground_pose).manifolds(0.01)
        } else {
            Pair3::new(&self.ground, &self.ground_pose, &self.shape, &pose).manifolds(0.01)
        }
    }

    /// The manifold's normal in the ground's axes, from the ground to the body.
    fn towards(&self, manifold: &Manifold3) -> DVec3 {
        let normal = self.ground_pose.turn_back(manifold.normal.as_dvec3());
        if self.ground_is_b { -normal } else { normal }
    }

    /// Falls for one step, and is pushed out.
    fn step(&mut self, what: &str) -> Vec<Manifold3> {
        self.velocity -= self.up * (9.81 * STEP);
        self.position += self.velocity * STEP;
        let manifolds = self.manifolds();
        for manifold in &manifolds {
            let towards = self.towards(manifold);
            let aside = towards.cross(self.up).length();
            assert!(aside <= UPRIGHT && towards.dot(self.up) > 0.0, "{what}: normal {towards}");
        }
        let deepest = manifolds
            .iter()
            .flat_map(|manifold| manifold.points.iter().map(move |point| (manifold, point)))
            .min_by(|one, other| one.1.separation.total_cmp(&other.1.separation));
        if let Some((manifold, point)) = deepest {
            let towards = self.towards(manifold);
            self.position += towards * -f64::from(point.separation).min(0.0);
            let into = self.velocity.dot(towards);
            if into < 0.0 {
                self.velocity -= towards * into;
            }
        }
        manifolds
    }
}

/// The features of the body in a manifold, each with the feature of the ground that it touches.
fn corners(manifold: &Manifold3, slide: &Slide) -> Vec<(Feature, Feature)> {
    let sides = |point: &asunder_narrow::ContactPoint3| {
        let (a, b) = (point.feature.a(), point.feature.b());
        let (of_body, of_ground) = if slide.ground_is_b { (a, b) } else { (b, a) };
        match of_ground {
            Feature::Face(_) if !slide.is_one_patch => (of_body, Feature::Face(0)),
            _ => (of_body, of_ground),
        }
    };
    let mut corners: Vec<_> = manifold.points.iter().map(sides).collect();
    corners.sort_unstable();
    corners
}

fn part_of(manifold: &Manifold3, ground_is_b: bool) -> u32 {
    if ground_is_b { manifold.part_a } else { manifold.part_b }
}

fn part_count(shape: &Shape3) -> usize {
    if let Shape3::Compound(compound) = shape { compound.parts().len() } else { 1 }
}

fn slide(mut slide: Slide, steps: usize, what: &str) {
    let speed = slide.velocity.length();
    let heading = slide.velocity;
    let size = 2.0 * f64::from(slide.shape.outer_radius());
    let mut names: Vec<Option<Vec<(Feature, Feature)>>> = vec![None; part_count(&slide.shape)];
    for step in 0..steps {
        let manifolds = slide.step(what);
        let parts: Vec<u32> = manifolds.iter().map(|m| part_of(m, slide.ground_is_b)).collect();
        let expected: Vec<u32> = (0..part_count(&slide.shape) as u32).collect();
        assert_eq!(parts, expected, "{what}, step {step}: one manifold for each part");
        for manifold in &manifolds {
            let corners = corners(manifold, &slide);
            let known = &mut names[part_of(manifold, slide.ground_is_b) as usize];
            if step > 0 {
                assert_eq!(known.as_ref(), Some(&corners), "{what}, step {step}: names");
            }
            *known = Some(corners);
        }
        let height = slide.position.dot(slide.up) - slide.level - slide.rest;
        assert!(height.abs() <= STEADY * size, "{what}, step {step}: height {height}");
        let off = (slide.velocity - heading).length();
        assert!(off <= STEADY * speed.max(1.0), "{what}, step {step}: velocity off by {off} of {speed}");
    }
}

/// A rotation about the up axis only, so that the body rests as it does without; given by the tangent of half the
/// angle.
fn about_y(tangent: f64) -> Quat {
    Quat::from_xyzw(0.0, tangent as f32, 0.0, 1.0)
}

/// Ground in one plane.
#[derive(Clone)]
struct Plane {
    ground: Shape3,
    pose: Pose3,
    /// Up in its axes.
    up: DVec3,
    /// Its height along `up`.
    level: f64,
    middle: DVec3,
    is_one_patch: bool,
}

impl Plane {
    /// A body that stands on it, rotated about up by `turn` and placed `beside` its middle, and slides.
    fn slide(self, (shape, rest): (Shape3, f64), turn: Quat, beside: DVec3, velocity: DVec3) -> Slide {
        let Self { ground, pose, up, level, middle, is_one_patch } = self;
        // The rotation of the ground, if its vertices were rotated.
        let upright = Quat::from_rotation_arc(Vec3::Y, up.as_vec3().normalize());
        let start = middle + up * (level - middle.dot(up));
        Slide {
            shape,
            ground,
            ground_pose: pose,
            up,
            level,
            turn: (upright * turn).normalize(),
            rest,
            position: start + up * rest + beside,
            velocity,
            ground_is_b: true,
            is_one_patch,
        }
    }
}

/// Slides a body over a plane in a random direction.
fn slide_anyhow(plane: Plane, kind: usize, round: usize, random: &mut Random, what: &str) {
    let up = plane.up;
    let turn = about_y(random.between(-2.0, 2.0));
    let speed = [0.01, 1.0, 7.0, 20.0][round];
    let across = {
        let heading = random.vector();
        (heading - up * heading.dot(up)).normalize()
    };
    let slide_it = plane.slide((body(kind), rest_height(kind)), turn, across * -0.4, across * speed);
    let steps = ((0.9 / (speed * STEP)) as usize).clamp(6, 60);
    slide(
        Slide { ground_is_b: random.below(2) == 0, ..slide_it },
        steps,
        &format!("{what}, body {kind}, round {round}"),
    );
}

fn over_flats(place: impl Fn(&mut Random, TriMesh) -> (TriMesh, Pose3, DVec3), seed: u128) {
    let mut random = Random::new(seed);
    for way in 0..FLATS {
        for kind in 0..BODIES - 1 {
            for round in 0..4 {
                let (mesh, pose, up) = place(&mut random, flat(way));
                let mesh = if round % 2 == 0 { mesh.one_sided() } else { mesh };
                let plane = Plane {
                    pose,
                    up,
                    level: mesh.vertices()[0].as_dvec3().dot(up),
                    middle: mesh.center().as_dvec3(),
                    // Once rounded, a triangle of 20 m by 2 cm may be tilted by 1e-4.
                    is_one_patch: way != 3 || up == DVec3::Y,
                    ground: mesh.into(),
                };
                slide_anyhow(plane, kind, round, &mut random, &format!("way {way}"));
            }
        }
    }
}

/// A height field in one plane, given by the steps from one vertex to the next along x and along z.
fn field(cells: [usize; 2], [along, across]: [DVec3; 2], pose: Pose3) -> Plane {
    let height = |column: usize, row: usize| along.y * column as f64 + across.y * row as f64;
    let heights: Vec<f32> =
        (0..=cells[1]).flat_map(|row| (0..=cells[0]).map(move |column| height(column, row) as f32)).collect();
    let cell = Vec2::new(along.x as f32, across.z as f32);
    let field = HeightField::new(cells[0] + 1, cells[1] + 1, heights, cell).unwrap();
    let middle = field.center().as_dvec3();
    Plane {
        ground: field.into(),
        pose,
        up: across.cross(along).normalize(),
        level: 0.0,
        middle,
        is_one_patch: true,
    }
}

#[test]
fn on_a_plane_in_triangles_a_body_keeps_its_height_its_speed_and_its_points() {
    over_flats(|_, mesh| (mesh, Pose3::IDENTITY, DVec3::Y), 1);
}

#[test]
fn far_from_the_origin_and_turned_it_does_the_same() {
    over_flats(
        |random, mesh| {
            let position = random.vector() * 1e6;
            (mesh, Pose3::new(position, random.rotation()).unwrap(), DVec3::Y)
        },
        2,
    );
}

#[test]
fn with_vertices_turned_and_rounded_it_does_the_same() {
    over_flats(
        |random, mesh| {
            let turn = random.rotation().normalize();
            let up = Pose3::new(DVec3::ZERO, turn).unwrap().turn(DVec3::Y).normalize();
            (baked(&mesh, turn, Vec3::ZERO), Pose3::IDENTITY, up)
        },
        3,
    );
}

#[test]
fn on_a_height_field_it_does_the_same_level_tilted_and_turned() {
    let mut random = Random::new(4);
    let ways: [([usize; 2], [DVec3; 2]); 4] = [
        ([16, 16], [DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.0, 0.0, 0.5)]),
        // Triangles a thousand times as long as wide.
        ([2, 320], [DVec3::new(20.0, 0.0, 0.0), DVec3::new(0.0, 0.0, 0.02)]),
        // Tilted, with heights that are exact in f32.
        ([16, 16], [DVec3::new(0.5, 0.25, 0.0), DVec3::new(0.0, -0.125, 0.5)]),
        // Tilted, with heights that are rounded, as positions are.
        ([20, 16], [DVec3::new(0.41, 0.3, 0.0), DVec3::new(0.0, 0.17, 0.53)]),
    ];
    for (way, (cells, steps)) in ways.into_iter().enumerate() {
        for kind in 0..BODIES - 1 {
            for round in 0..8 {
                let pose = match round / 4 {
                    0 => Pose3::IDENTITY,
                    _ => Pose3::new(random.vector() * 1e6, random.rotation()).unwrap(),
                };
                let mut plane = field(cells, steps, pose);
                if let (Shape3::HeightField(field), true) = (&plane.ground, round % 2 == 0) {
                    plane.ground = field.clone().one_sided().into();
                }
                slide_anyhow(plane, kind, round % 4, &mut random, &format!("field {way}, {}", round / 4));
            }
        }
    }
}

/// Random directions hardly ever run along a seam, and random bodies hardly ever have a side exactly over one.
#[test]
fn along_seams_square_to_them_and_with_sides_right_over_them_it_does_the_same() {
    let level = [DVec3::X * 0.5, DVec3::Z * 0.5];
    // A 3-4-5 slope: squares of 0.625 m by 0.5.
    let tilted = [DVec3::new(0.5, 0.375, 0.0), DVec3::Z * 0.5];
    let mesh = Plane {
        ground: flat(0).into(),
        pose: Pose3::IDENTITY,
        up: DVec3::Y,
        level: 0.0,
        middle: DVec3::ZERO,
        is_one_patch: true,
    };
    let turned = Pose3::new(DVec3::new(-3e5, 1e4, 7e5), Quat::from_xyzw(0.3, -0.5, 0.1, 0.8)).unwrap();
    let grounds = [
        ("mesh", level, mesh),
        ("field", level, field([16; 2], level, Pose3::IDENTITY)),
        ("field, turned", level, field([16; 2], level, turned)),
        ("field, tilted", tilted, field([16; 2], tilted, Pose3::IDENTITY)),
    ];
    for (name, [along, across], plane) in grounds {
        // Two squares long and one wide.
        let half = Vec3::new(along.length() as f32, 0.25, 0.5 * across.length() as f32);
        let block: Shape3 = Cuboid::from_half_extents(half).unwrap().into();
        let kinds = (0..BODIES - 1).map(|kind| (body(kind), rest_height(kind)));
        for (kind, standing) in [(block, 0.25)].into_iter().chain(kinds).enumerate() {
            for way in [along, -across, along + across, across - along] {
                // Unrotated, a quarter turn, and half of that: along seams, and along the diagonals of squares.
                for (turn, tangent) in [0.0, 1.0, core::f64::consts::SQRT_2 - 1.0].into_iter().enumerate() {
                    // Starts over a vertex, with all sides of a long block over seams, and anywhere; in squares.
                    for [u, v] in [[0.0, 0.0], [0.0, 0.5], [0.5, 0.0], [0.3, 0.4]] {
                        let beside = along * u + across * v - way;
                        // An eighth of a square a step, so that steps also end exactly over seams.
                        let slide_it = plane.clone().slide(
                            standing.clone(),
                            about_y(tangent),
                            beside,
                            way * (0.125 / STEP),
                        );
                        slide(slide_it, 17, &format!("{name}, body {kind}, {way}, turn {turn}, {u} {v}"));
                    }
                }
            }
        }
    }
}
