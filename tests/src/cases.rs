//! Seeded shapes, poses and pairs.
//!
//! Rotations come from random quaternions and random directions, never from angles: the standard library's sine
//! differs between platforms, and a failing seed must fail everywhere.

use crate::exhaustive_distance::{exhaustive_distance2, exhaustive_distance3};
use crate::exhaustive_sat::{exhaustive_sat2, exhaustive_sat3, gap2, gap3};
use crate::placed::{Placed2, Placed3};
use crate::solid::Solid;
use asunder_geometry::{Cuboid, Hull, Polygon, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// A seeded source of shapes and poses.
#[derive(Clone, Debug)]
pub struct Random(oorandom::Rand64);

/// Two posed solids.
#[derive(Clone, Debug)]
pub struct Case3 {
    /// The first shape.
    pub shape_a: Shape3,
    /// Where it is.
    pub pose_a: Pose3,
    /// The second shape.
    pub shape_b: Shape3,
    /// Where it is.
    pub pose_b: Pose3,
}

/// Two posed polygons.
#[derive(Clone, Debug)]
pub struct Case2 {
    /// The first shape.
    pub shape_a: Shape2,
    /// Where it is.
    pub pose_a: Pose2,
    /// The second shape.
    pub shape_b: Shape2,
    /// Where it is.
    pub pose_b: Pose2,
}

/// The oracles' answer for a pair: the Euclidean distance in a gap, minus the least translation in overlap.
#[derive(Clone, Copy, Debug)]
pub struct Truth<V> {
    /// The separation, in metres.
    pub separation: f64,
    /// The unit axis that attains it, from A to B.
    pub normal: V,
}

impl Random {
    /// A source whose numbers depend on the seed alone.
    pub fn new(seed: u128) -> Self {
        Self(oorandom::Rand64::new(seed))
    }

    /// Uniform in -1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.0.rand_float() - 1.0
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.rand_float()
    }

    /// A whole number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.rand_range(0..count as u64) as usize
    }

    /// One of a list.
    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// Uniform in the cube from -1 to 1.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    /// A unit vector.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.vector();
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// A unit vector in the plane.
    pub fn direction2(&mut self) -> DVec2 {
        loop {
            let v = DVec2::new(self.signed(), self.signed());
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// A rotation; one in four is far from unit length, which must not matter.
    pub fn quaternion(&mut self) -> Quat {
        let length = if self.below(4) == 0 { 2.5 } else { 1.0 };
        loop {
            let q = [0.0; 4].map(|_: f64| self.signed());
            let norm = q.iter().map(|c| c * c).sum::<f64>();
            if (0.01..1.0).contains(&norm) {
                return Quat::from_array(q.map(|c| (c * length / norm.sqrt()) as f32));
            }
        }
    }

    /// A rotation in the plane.
    pub fn rotation2(&mut self) -> Rotation2 {
        let direction = self.direction2().as_vec2();
        Rotation2::new(direction.x, direction.y).unwrap()
    }

    /// A cuboid with half extents of 0.2 to 1 m.
    pub fn cuboid(&mut self) -> Shape3 {
        let half = [0.0; 3].map(|_: f64| self.between(0.2, 1.0) as f32);
        Cuboid::from_half_extents(Vec3::from_array(half)).unwrap().into()
    }

    /// A hull of exactly `vertices` vertices (4 or more), about a metre in radius and off its origin.
    pub fn hull(&mut self, vertices: usize) -> Shape3 {
        let offset = self.vector() * 0.3;
        let stretch = DVec3::new(self.between(0.4, 1.0), self.between(0.4, 1.0), self.between(0.4, 1.0));
        loop {
            // On an ellipsoid every point is a vertex.
            let points: Vec<Vec3> =
                (0..vertices).map(|_| (self.direction() * stretch + offset).as_vec3()).collect();
            if let Ok(hull) = Hull::from_points(&points)
                && hull.vertices().len() == vertices
                && hull.inner_radius() > 0.02
            {
                return hull.into();
            }
        }
    }

    /// A right prism over a polygon: parallel faces and edges, and faces with many corners.
    pub fn prism(&mut self, corners: usize) -> Shape3 {
        let half = self.between(0.2, 0.8) as f32;
        let Shape2::Polygon(polygon) = self.polygon(corners) else { unreachable!("made a polygon") };
        prism(polygon.vertices(), half)
    }

    /// A cuboid, a prism, or a hull of 4 to 24 vertices.
    pub fn shape3(&mut self) -> Shape3 {
        match self.below(4) {
            0 => self.cuboid(),
            1 => {
                let corners = 3 + self.below(5);
                self.prism(corners)
            }
            _ => {
                let vertices = 4 + self.below(21);
                self.hull(vertices)
            }
        }
    }

    /// A polygon of exactly `vertices` vertices, about a metre in radius and off its origin.
    pub fn polygon(&mut self, vertices: usize) -> Shape2 {
        let offset = self.vector().truncate() * 0.3;
        let stretch = DVec2::new(self.between(0.4, 1.0), self.between(0.4, 1.0));
        loop {
            let points: Vec<Vec2> =
                (0..vertices).map(|_| (self.direction2() * stretch + offset).as_vec2()).collect();
            if let Ok(polygon) = Polygon::hull_of(&points)
                && polygon.vertices().len() == vertices
                && polygon.inner_radius() > 0.02
            {
                return polygon.into();
            }
        }
    }

    /// A rectangle, or a polygon of 3 to 16 vertices.
    pub fn shape2(&mut self) -> Shape2 {
        if self.below(3) == 0 {
            let half = [0.0; 2].map(|_: f64| self.between(0.2, 1.0) as f32);
            return Rect::from_half_extents(Vec2::from_array(half)).unwrap().into();
        }
        let vertices = 3 + self.below(14);
        self.polygon(vertices)
    }

    /// Two solids about as often in overlap as apart, A near the origin.
    pub fn case3(&mut self) -> Case3 {
        let (shape_a, shape_b) = (self.shape3(), self.shape3());
        let reach = f64::from(shape_a.outer_radius() + shape_b.outer_radius());
        let away = self.direction() * reach * self.between(0.0, 1.3);
        let at = self.vector();
        let pose_a = Pose3::new(at, self.quaternion()).unwrap();
        let pose_b = Pose3::new(at + away, self.quaternion()).unwrap();
        Case3 { shape_a, pose_a, shape_b, pose_b }
    }

    /// Two shapes in the plane about as often in overlap as apart, A near the origin.
    pub fn case2(&mut self) -> Case2 {
        let (shape_a, shape_b) = (self.shape2(), self.shape2());
        let reach = f64::from(shape_a.outer_radius() + shape_b.outer_radius());
        let away = self.direction2() * reach * self.between(0.0, 1.3);
        let at = self.vector().truncate();
        let pose_a = Pose2::new(at, self.rotation2()).unwrap();
        let pose_b = Pose2::new(at + away, self.rotation2()).unwrap();
        Case2 { shape_a, pose_a, shape_b, pose_b }
    }

    /// Two solids moved together until they are `gap` shares of their size apart; a negative gap overlaps.
    pub fn near_case3(&mut self, gap: f64) -> Case3 {
        let mut case = self.case3();
        // Each round moves B by the remainder along the best separating axis. Two rounds suffice, since the same
        // feature then decides.
        for _ in 0..4 {
            let truth = case.truth();
            let step = gap * case.size() - truth.separation;
            case.pose_b =
                Pose3::new(case.pose_b.position() + truth.normal * step, case.pose_b.rotation()).unwrap();
        }
        case
    }

    /// Two shapes in the plane moved together until they are `gap` shares of their size apart.
    pub fn near_case2(&mut self, gap: f64) -> Case2 {
        let mut case = self.case2();
        for _ in 0..4 {
            let truth = case.truth();
            let step = gap * case.size() - truth.separation;
            case.pose_b =
                Pose2::new(case.pose_b.position() + truth.normal * step, case.pose_b.rotation()).unwrap();
        }
        case
    }
}

/// The right prism over a polygon, from -`half` to `half` along z.
pub fn prism(outline: &[Vec2], half: f32) -> Shape3 {
    let points: Vec<Vec3> = outline.iter().flat_map(|v| [v.extend(-half), v.extend(half)]).collect();
    Hull::from_points(&points).unwrap().into()
}

impl Case3 {
    /// The pair with A and B swapped.
    pub fn swapped(&self) -> Self {
        Self {
            shape_a: self.shape_b.clone(),
            pose_a: self.pose_b,
            shape_b: self.shape_a.clone(),
            pose_b: self.pose_a,
        }
    }

    /// Both solids in f64, relative to A's position.
    pub fn placed(&self) -> (Placed3, Placed3) {
        let origin = self.pose_a.position();
        let place = |shape: &Shape3, pose: &Pose3| Placed3::new(&Solid::of(shape), pose, origin);
        (place(&self.shape_a, &self.pose_a), place(&self.shape_b, &self.pose_b))
    }

    /// The sum of the two bounding radii, in metres: what tolerances are relative to.
    pub fn size(&self) -> f64 {
        f64::from(self.shape_a.outer_radius()) + f64::from(self.shape_b.outer_radius())
    }

    /// The oracles' answer.
    pub fn truth(&self) -> Truth<DVec3> {
        let (a, b) = self.placed();
        truth3(&a, &b)
    }
}

impl Case2 {
    /// The pair with A and B swapped.
    pub fn swapped(&self) -> Self {
        Self {
            shape_a: self.shape_b.clone(),
            pose_a: self.pose_b,
            shape_b: self.shape_a.clone(),
            pose_b: self.pose_a,
        }
    }

    /// Both shapes in f64, relative to A's position.
    pub fn placed(&self) -> (Placed2, Placed2) {
        let origin = self.pose_a.position();
        let place = |shape: &Shape2, pose: &Pose2| Placed2::new(shape, pose, origin);
        (place(&self.shape_a, &self.pose_a), place(&self.shape_b, &self.pose_b))
    }

    /// The sum of the two bounding radii, in metres: what tolerances are relative to.
    pub fn size(&self) -> f64 {
        f64::from(self.shape_a.outer_radius()) + f64::from(self.shape_b.outer_radius())
    }

    /// The oracles' answer.
    pub fn truth(&self) -> Truth<DVec2> {
        let (a, b) = self.placed();
        truth2(&a, &b)
    }
}

/// The distance where there is a gap, else the best separating axis.
pub fn truth3(a: &Placed3, b: &Placed3) -> Truth<DVec3> {
    let best = exhaustive_sat3(a, b);
    if best.gap <= 0.0 {
        return Truth { separation: best.gap, normal: best.normal };
    }
    let nearest = exhaustive_distance3(a, b);
    // The line between two points that almost coincide has a poor direction; the best axis may then be better.
    let line = (nearest.on_b - nearest.on_a) / nearest.distance;
    let normal = if nearest.distance > 0.0 && gap3(a, b, line) > best.gap { line } else { best.normal };
    Truth { separation: nearest.distance, normal }
}

/// The distance where there is a gap, else the best separating axis.
pub fn truth2(a: &Placed2, b: &Placed2) -> Truth<DVec2> {
    let best = exhaustive_sat2(a, b);
    if best.gap <= 0.0 {
        return Truth { separation: best.gap, normal: best.normal };
    }
    let nearest = exhaustive_distance2(a, b);
    // The line between two points that almost coincide has a poor direction; the best axis may then be better.
    let line = (nearest.on_b - nearest.on_a) / nearest.distance;
    let normal = if nearest.distance > 0.0 && gap2(a, b, line) > best.gap { line } else { best.normal };
    Truth { separation: nearest.distance, normal }
}

/// Coordinates that break sorts, quantisers and comparisons.
pub const NASTY: [f32; 18] = [
    f32::NAN,
    f32::NEG_INFINITY,
    f32::INFINITY,
    f32::MIN,
    f32::MAX,
    -1.0,
    -0.0,
    0.0,
    1.0,
    1.000_000_1,
    2.0,
    1e-45,
    -1e-45,
    1e-40,
    f32::MIN_POSITIVE,
    1e9,
    -1e9,
    0.5,
];
