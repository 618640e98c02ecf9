//! Bodies that slide over a plane that was cut into triangles notice nothing of it.
//!
//! A body falls a little each step and is pushed out by its deepest point; there is no friction. On a plane it keeps its
//! speed and its height.

use super::scenes::{BODIES, FLATS, Random, baked, body, flat, rest_height};
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Pose3, Shape3, TriMesh};
use asunder_narrow::{Feature, Manifold3, Pair3};

/// Of the height and of the velocity, as a share of the body's size and of the speed.
const STEADY: f64 = 1e-4;

/// Sine of 0.01 degrees.
const UPRIGHT: f64 = 1.745e-4;

const STEP: f64 = 1.0 / 60.0;

/// A body that slides on a mesh, both in a world whose up is the ground's y axis.
struct Slide {
    shape: Shape3,
    ground: Shape3,
    ground_pose: Pose3,
    /// The mesh's own up.
    up: DVec3,
    /// Where the plane is along it.
    level: f64,
    turn: Quat,
    rest: f64,
    position: DVec3,
    velocity: DVec3,
    ground_is_b: bool,
    /// Whether the triangles lie in one plane beyond what f32 makes of them: then they are one patch.
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

    /// Falls, and is pushed out.
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

/// The body's own vertices among the features of a manifold, and what of the ground they touch.
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

/// Turned about the up axis alone, so that it rests as it does without; by the tangent of half the angle.
fn about_y(tangent: f64) -> Quat {
    Quat::from_xyzw(0.0, tangent as f32, 0.0, 1.0)
}

fn over_flats(place: impl Fn(&mut Random, TriMesh) -> (TriMesh, Pose3, DVec3), seed: u128) {
    let mut random = Random::new(seed);
    for way in 0..FLATS {
        for kind in 0..BODIES - 1 {
            for round in 0..4 {
                let (mesh, ground_pose, up) = place(&mut random, flat(way));
                let mesh = if round % 2 == 0 { mesh.one_sided() } else { mesh };
                let rest = rest_height(kind);
                let level = mesh.vertices()[0].as_dvec3().dot(up);
                // What the mesh was turned by, if its vertices were.
                let upright = Quat::from_rotation_arc(Vec3::Y, up.as_vec3().normalize());
                let turn = (upright * about_y(random.between(-2.0, 2.0))).normalize();
                let speed = [0.01, 1.0, 7.0, 20.0][round];
                let across = {
                    let heading = random.vector();
                    (heading - up * heading.dot(up)).normalize()
                };
                let start = mesh.center().as_dvec3() + up * (level - mesh.center().as_dvec3().dot(up));
                let slide_it = Slide {
                    shape: body(kind),
                    ground: mesh.into(),
                    ground_pose,
                    up,
                    level,
                    turn,
                    rest,
                    position: start + up * rest - across * 0.4,
                    velocity: across * speed,
                    ground_is_b: random.below(2) == 0,
                    // Rounded, a triangle of 20 m by 2 cm may lean by 1e-4.
                    is_one_patch: way != 3 || up == DVec3::Y,
                };
                let steps = ((0.9 / (speed * STEP)) as usize).clamp(6, 60);
                slide(slide_it, steps, &format!("way {way}, body {kind}, round {round}"));
            }
        }
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
