//! Bodies slide over straight lines that are cut into segments, and do not notice the cuts.

use super::{chain, cut_line, noise, sliders, towards, turned};
use asunder::glam::{DVec2, Vec2};
use asunder::{Chain, FeatureId, Manifold2, Pair2, Pose2, Rotation2, Shape2};
use std::collections::BTreeSet;

/// Sine of 0.01 degrees.
const STRAIGHT: f64 = 1.745e-4;

/// A body above ground, without spin.
struct Slider<'w> {
    ground: (&'w Shape2, Pose2),
    /// Whether the ground is A.
    is_first: bool,
    body: &'w Shape2,
    pose: Pose2,
    velocity: DVec2,
    /// Out of the ground, against gravity.
    up: DVec2,
}

impl Slider<'_> {
    /// One step of a sixtieth of a second: falls, moves, and is pushed out of what it overlaps. Returns manifolds with
    /// normals out of the ground.
    fn step(&mut self) -> Vec<Manifold2> {
        let dt = 1.0 / 60.0;
        self.velocity -= self.up * (10.0 * dt);
        let moved = self.pose.position() + self.velocity * dt;
        self.pose = Pose2::new(moved, self.pose.rotation()).unwrap();
        let manifolds = self.manifolds(0.0);
        let mut push = DVec2::ZERO;
        for manifold in &manifolds {
            let normal = manifold.normal.as_dvec2().normalize();
            push += normal * (-f64::from(manifold.separation)).max(0.0);
            self.velocity -= normal * self.velocity.dot(normal).min(0.0);
        }
        self.pose = Pose2::new(self.pose.position() + push, self.pose.rotation()).unwrap();
        manifolds
    }

    fn manifolds(&self, margin: f32) -> Vec<Manifold2> {
        let ((ground, at), (body, pose)) = (&self.ground, (self.body, &self.pose));
        if self.is_first {
            return Pair2::new(ground, at, body, pose).manifolds(margin);
        }
        let mut manifolds = Pair2::new(body, pose, ground, at).manifolds(margin);
        for manifold in &mut manifolds {
            manifold.normal = -manifold.normal;
            for point in &mut manifold.points {
                point.feature = FeatureId::new(point.feature.b(), point.feature.a());
            }
        }
        manifolds
    }
}

/// A straight chain in the world whose front faces up: its middle, the direction along it, and up.
struct Line {
    ground: Shape2,
    pose: Pose2,
    middle: DVec2,
    along: DVec2,
    up: DVec2,
}

fn line(i: usize, is_one_sided: bool) -> Line {
    let angle = core::f64::consts::TAU * (i as f64 / 16.0 + 0.01 * noise(i));
    let from = DVec2::new(noise(i + 50) - 0.5, noise(i + 60) - 0.5) * [0.0, 10.0, 100.0][i % 3];
    let vertices = cut_line(from, from + towards(angle) * 40.0, 150 + i);
    let chain = Chain::open(vertices.clone()).unwrap();
    let chain = if is_one_sided { chain.one_sided() } else { chain };
    let rotation = if i.is_multiple_of(2) { Rotation2::IDENTITY } else { turned(towards(noise(i) * 6.0)) };
    let far = [DVec2::ZERO, DVec2::new(1e6, -3e5), DVec2::new(-2e3, 7e8)][i / 3 % 3];
    let pose = Pose2::new(far, rotation).unwrap();
    let [start, end] = [vertices[0], vertices[vertices.len() - 1]].map(|vertex| pose.transform(vertex));
    let along = (end - start).normalize();
    Line { ground: chain.into(), pose, middle: (start + end) * 0.5, along, up: -along.perp() }
}

/// Slides over a line at a speed, from 8 m before its middle; returns the feature ids of the points that it stood on.
fn slide(
    line: &Line,
    (name, body, foot): (&str, &Shape2, f64),
    tilt: f64,
    speed: f64,
) -> BTreeSet<FeatureId> {
    let start = line.middle - line.along * (8.0 * speed.signum()) + line.up * foot;
    let level = -line.up.perp();
    let rotation = turned(level.rotate(towards(tilt)));
    let mut slider = Slider {
        ground: (&line.ground, line.pose),
        is_first: speed > 0.0,
        body,
        pose: Pose2::new(start, rotation).unwrap(),
        velocity: line.along * speed,
        up: line.up,
    };
    let mut names = BTreeSet::new();
    let steps = (960.0 / speed.abs()) as usize;
    for step in 0..steps {
        let manifolds = slider.step();
        for manifold in &manifolds {
            let normal = manifold.normal.as_dvec2().normalize();
            assert!(
                normal.dot(line.up) > 0.9 && normal.perp_dot(line.up).abs() < STRAIGHT,
                "{name} {step}: {manifold:?}"
            );
            if step > 0 {
                names.extend(manifold.points.iter().map(|point| point.feature));
            }
        }
        assert!(manifolds.len() == 1, "{name} {step}: {manifolds:?}");
        // At 7e8 m, f64 positions are rounded to 1e-7 m.
        let height = line.up.dot(slider.pose.position() - line.middle) - foot;
        assert!(height.abs() < 1e-4, "{name} {step}: {height}");
        let now = slider.velocity.dot(line.along);
        assert!((now - speed).abs() < 1e-4 * speed.abs(), "{name} {step}: {now} for {speed}");
    }
    let way = (slider.pose.position() - start).dot(line.along);
    assert!((way.abs() - 16.0).abs() < 0.02 * speed.abs(), "{name}: {way}");
    names
}

#[test]
fn nothing_trips_over_a_line_that_was_cut_at_any_angle_distance_and_speed() {
    for i in 0..48 {
        let line = line(i, i % 4 > 1);
        for (name, body, foot) in &sliders() {
            let speed = [3.0, -7.0, 20.0, -60.0, 1.3][i % 5];
            let names = slide(&line, (name, body, *foot), 0.0, speed);
            // A body that lies flat has both its corners or edges, on one straight run.
            let most = if *name == "circle" { 1 } else { 2 };
            assert!(names.len() == most, "{name}: {names:?}");
        }
    }
}

#[test]
fn a_corner_that_slides_keeps_its_name() {
    for i in 0..16 {
        let line = line(i, i % 2 == 1);
        for (name, body, _) in &sliders() {
            let tilt = 0.2 + 0.1 * noise(i);
            let rotation = turned(towards(tilt));
            let down = Vec2::NEG_Y.as_dvec2();
            let local = DVec2::new(
                f64::from(rotation.cos()) * down.x + f64::from(rotation.sin()) * down.y,
                f64::from(rotation.cos()) * down.y - f64::from(rotation.sin()) * down.x,
            );
            let foot = -rotation.turn(body.support(local).unwrap()).y;
            let names = slide(&line, (name, body, foot), tilt, [5.0, -5.0][i % 2]);
            assert_eq!(names.len(), 1, "{name}: {names:?}");
        }
    }
}

/// Where a closed chain begins makes no difference.
#[test]
fn the_seam_of_a_closed_chain_is_not_felt() {
    for i in 0..8 {
        // Counter-clockwise, starting in the middle of its upper side.
        let top = cut_line(DVec2::new(20.0, 0.0), DVec2::new(-20.0, 0.0), 120);
        let (right, left) = top.split_at(50 + i);
        let mut vertices = left.to_vec();
        vertices.extend([Vec2::new(-20.0, -9.0), Vec2::new(20.0, -9.0)]);
        vertices.extend(right);
        let seam = f64::from(vertices[0].x);
        let ring = Chain::closed(vertices).unwrap();
        let ring = if i % 2 == 0 { ring.one_sided() } else { ring };
        let pose = Pose2::new([30.0, 1e4], turned(towards(0.7 * i as f64))).unwrap();
        let up = pose.rotation().turn(DVec2::Y).normalize();
        let line = Line {
            ground: ring.into(),
            pose,
            middle: pose.transform(DVec2::X * seam),
            along: -up.perp(),
            up,
        };
        for (name, body, foot) in &sliders() {
            let names = slide(&line, (name, body, *foot), 0.0, [4.0, -4.0][i % 2]);
            assert!(names.len() <= 2, "{name}: {names:?}");
        }
    }
}

/// Deep below the surface, the axis of least penetration of a tiny segment alone points sideways.
#[test]
fn depth_leads_out_of_the_ground_and_not_along_it() {
    let [mut touched, mut rounded_off] = [0; 2];
    for i in 0..16 {
        let line = line(i, i % 2 == 1);
        for (name, body, foot) in &sliders() {
            for depth in [1e-6, 1e-3, 0.05, 0.2] {
                for place in 0..20 {
                    let at = line.middle + line.along * (0.137 * f64::from(place)) + line.up * (foot - depth);
                    let level = turned(-line.up.perp());
                    let pose = Pose2::new(at, level).unwrap();
                    let pair = Pair2::new(&line.ground, &line.pose, body, &pose);
                    let manifolds = pair.manifolds(0.0);
                    // A micrometre may be less than the rounding of the vertices.
                    if depth < 1e-5 && !pair.overlaps() {
                        assert!(manifolds.is_empty(), "{name} {depth}: {manifolds:?}");
                        rounded_off += 1;
                        continue;
                    }
                    assert_eq!(manifolds.len(), 1, "{name} {depth}: {manifolds:?}");
                    let normal = manifolds[0].normal.as_dvec2();
                    assert!(normal.perp_dot(line.up).abs() < STRAIGHT, "{name} {depth}: {manifolds:?}");
                    assert!(
                        (f64::from(manifolds[0].separation) + depth).abs() < 3e-5,
                        "{name} {depth}: {manifolds:?}"
                    );
                    touched += usize::from(depth < 1e-5);
                }
            }
        }
    }
    assert!(touched > 2 * rounded_off, "a micrometre deep: {touched} touch, {rounded_off} do not");
}

/// Two runs whose normals differ by more than rounding, but too little to tell apart: one manifold, as wide as the
/// body.
#[test]
fn a_line_that_is_all_but_straight_is_one_to_a_body_that_lies_on_it() {
    let bend = 5e-8_f32;
    let bent = chain(&[(8.0, -8.0 * bend), (0.0, 0.0), (-8.0, -8.0 * bend)]);
    assert_ne!(bent.run_of(0), bent.run_of(1));
    let ground = Shape2::from(bent);
    for (name, body, foot) in &sliders() {
        let pose = Pose2::at([0.1, foot - 1e-3]).unwrap();
        let manifolds = Pair2::new(&ground, &Pose2::IDENTITY, body, &pose).manifolds(0.01);
        assert_eq!(manifolds.len(), 1, "{name}: {manifolds:?}");
        let points = &manifolds[0].points;
        let width = if points.len() == 2 { (points[0].anchor_b.x - points[1].anchor_b.x).abs() } else { 0.0 };
        let expected = match *name {
            "box" | "rounded box" | "capsule" => 1.0,
            "hexagon" => 0.5,
            _ => 0.0,
        };
        assert!((width - expected).abs() < 1e-3, "{name}: {manifolds:?}");
    }
}
