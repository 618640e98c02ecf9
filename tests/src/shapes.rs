//! Seeded shapes of every kind, and pairs of them in every kind of relative pose: one table per dimension, so that none
//! is forgotten.

use crate::bodies::{Bodies2, Bodies3};
use crate::cases::{Case2, Case3, Random};
use asunder_geometry::{
    Capsule2, Capsule3, Chain, Circle, Compound2, Compound3, Cuboid, HalfPlane, HalfSpace, Hull, Polygon,
    Pose2, Pose3, Rect, Rotation2, Segment2, Segment3, Shape2, Shape3, Sphere, Triangle3,
};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// A source of coordinates for one shape: arbitrary, thin along one axis, or short binary fractions.
#[derive(Debug)]
pub struct Clay<'a> {
    random: &'a mut Random,
    size: f64,
    stretch: DVec3,
    is_short: bool,
}

/// A kind of shape: its name, and a function that makes one.
pub type Kind<S> = (&'static str, fn(&mut Clay) -> S);

/// Every kind of shape in space; a new one is a new row.
pub const KINDS3: [Kind<Shape3>; 12] = [
    ("sphere", |clay| Sphere::new(clay.length()).unwrap().into()),
    ("capsule", |clay| {
        loop {
            if let Ok(capsule) = Capsule3::new(clay.point(), clay.point(), clay.length()) {
                return capsule.into();
            }
        }
    }),
    ("cuboid", |clay| clay.cuboid().into()),
    ("rounded cuboid", |clay| {
        let cuboid = clay.cuboid();
        cuboid.rounded(clay.length()).unwrap().into()
    }),
    ("hull", |clay| clay.hull().into()),
    ("rounded hull", |clay| {
        let hull = clay.hull();
        hull.rounded(clay.length()).unwrap().into()
    }),
    ("flat hull", |clay| clay.flat_hull().into()),
    ("rounded flat hull", |clay| {
        let hull = clay.flat_hull();
        hull.rounded(clay.length()).unwrap().into()
    }),
    ("triangle", |clay| {
        loop {
            if let Ok(triangle) = Triangle3::new(clay.point(), clay.point(), clay.point()) {
                return triangle.into();
            }
        }
    }),
    ("segment", |clay| {
        loop {
            if let Ok(segment) = Segment3::new(clay.point(), clay.point()) {
                return segment.into();
            }
        }
    }),
    ("compound", |clay| {
        let count = 1 + clay.random.below(3);
        let parts: Vec<_> = (0..count)
            .map(|_| {
                // A row before this one.
                let shape = KINDS3[clay.random.below(10)].1(clay);
                let at = clay.point().as_dvec3();
                (Pose3::new(at, clay.quaternion()).unwrap(), shape)
            })
            .collect();
        Compound3::new(parts).unwrap().into()
    }),
    ("half-space", |clay| HalfSpace::new(clay.normal()).unwrap().into()),
];

/// Every kind of shape in the plane; a new one is a new row.
pub const KINDS2: [Kind<Shape2>; 9] = [
    ("circle", |clay| Circle::new(clay.length()).unwrap().into()),
    ("capsule", |clay| {
        loop {
            let (from, to) = (clay.point().truncate(), clay.point().truncate());
            if let Ok(capsule) = Capsule2::new(from, to, clay.length()) {
                return capsule.into();
            }
        }
    }),
    ("rectangle", |clay| clay.rect().into()),
    ("rounded rectangle", |clay| {
        let rect = clay.rect();
        rect.rounded(clay.length()).unwrap().into()
    }),
    ("polygon", |clay| clay.polygon().into()),
    ("rounded polygon", |clay| {
        let polygon = clay.polygon();
        polygon.rounded(clay.length()).unwrap().into()
    }),
    ("segment", |clay| {
        loop {
            if let Ok(segment) = Segment2::new(clay.point().truncate(), clay.point().truncate()) {
                return segment.into();
            }
        }
    }),
    ("compound", |clay| {
        let count = 1 + clay.random.below(3);
        let parts: Vec<_> = (0..count)
            .map(|_| {
                let shape = KINDS2[clay.random.below(7)].1(clay);
                let at = clay.point().as_dvec3().truncate();
                (Pose2::new(at, clay.rotation()).unwrap(), shape)
            })
            .collect();
        Compound2::new(parts).unwrap().into()
    }),
    ("half-plane", |clay| HalfPlane::new(clay.normal().truncate()).unwrap().into()),
];

/// Chains: random ones, closed ones, and a line cut into pieces of which some are a thousandth of the others.
pub const CHAINS: [Kind<Shape2>; 3] = [
    ("chain", |clay| {
        loop {
            let count = 2 + clay.random.below(11);
            let vertices: Vec<Vec2> = (0..count).map(|_| clay.point().truncate()).collect();
            if let Ok(chain) = Chain::open(vertices) {
                return if clay.random.below(3) == 0 { chain.one_sided() } else { chain }.into();
            }
        }
    }),
    ("closed chain", |clay| {
        loop {
            let count = 3 + clay.random.below(9);
            let vertices: Vec<Vec2> = (0..count).map(|_| clay.point().truncate()).collect();
            if let Ok(chain) = Chain::closed(vertices) {
                return chain.into();
            }
        }
    }),
    ("cut line", |clay| {
        loop {
            let (from, to) = (clay.point().truncate(), clay.point().truncate());
            let mut at = 0.0;
            let mut cut = |i: usize| {
                at += if i % 3 == 1 { 1e-4 } else { 0.1 };
                from + (to - from) * at
            };
            if let Ok(chain) = Chain::open((0..12).map(&mut cut)) {
                return chain.into();
            }
        }
    }),
];

impl<'a> Clay<'a> {
    /// Shapes of about `size` metres; one in six is thin along an axis.
    pub fn new(random: &'a mut Random, size: f64) -> Self {
        let mut stretch = DVec3::ONE;
        if random.below(6) == 0 {
            stretch[random.below(2)] = random.pick(&[1e-2, 1e-4]);
        }
        Self { random, size, stretch, is_short: false }
    }

    /// Shapes of about a metre that are not thin.
    pub fn thick(random: &'a mut Random) -> Self {
        Self { random, size: 1.0, stretch: DVec3::ONE, is_short: false }
    }

    /// Shapes whose coordinates are eighths of a metre, up to two.
    pub fn short(random: &'a mut Random) -> Self {
        Self { random, size: 1.0, stretch: DVec3::ONE, is_short: true }
    }

    fn point(&mut self) -> Vec3 {
        if self.is_short {
            return Vec3::from_array([0; 3].map(|_| self.random.below(17) as f32 / 8.0 - 1.0));
        }
        (self.random.vector() * self.stretch * self.size).as_vec3()
    }

    /// A radius or half extent.
    fn length(&mut self) -> f32 {
        if self.is_short {
            return (1 + self.random.below(8)) as f32 / 8.0;
        }
        (self.random.between(0.15, 1.0) * self.size) as f32
    }

    fn extents(&mut self) -> Vec3 {
        let extents = Vec3::from_array([0; 3].map(|_| self.length()));
        if self.is_short { extents } else { extents * self.stretch.as_vec3() }
    }

    fn cuboid(&mut self) -> Cuboid {
        Cuboid::from_half_extents(self.extents()).unwrap()
    }

    fn rect(&mut self) -> Rect {
        Rect::from_half_extents(self.extents().truncate()).unwrap()
    }

    fn hull(&mut self) -> Hull {
        loop {
            let count = 4 + self.random.below(6);
            let points: Vec<Vec3> = (0..count).map(|_| self.point()).collect();
            if let Ok(hull) = Hull::from_points(&points) {
                return hull;
            }
        }
    }

    /// A hull that is a polygon, segment or point.
    fn flat_hull(&mut self) -> Hull {
        loop {
            let count = 1 + self.random.below(5);
            let z = self.point().z;
            let points: Vec<Vec3> = (0..count).map(|_| self.point().with_z(z)).collect();
            if let Ok(hull) = Hull::of_any_dimension(&points) {
                return hull;
            }
        }
    }

    fn polygon(&mut self) -> Polygon {
        loop {
            let count = 3 + self.random.below(6);
            let points: Vec<Vec2> = (0..count).map(|_| self.point().truncate()).collect();
            if let Ok(polygon) = Polygon::hull_of(&points) {
                return polygon;
            }
        }
    }

    fn normal(&mut self) -> Vec3 {
        if self.is_short {
            return self.random.pick(&[Vec3::X, Vec3::NEG_Y * 2.0, Vec3::Y]);
        }
        (self.random.direction2() * 3.0).as_vec2().extend(self.random.signed() as f32)
    }

    /// A quarter turn or none where coordinates are short, to keep them short.
    fn quaternion(&mut self) -> Quat {
        if self.is_short {
            let (x, y) = (Quat::from_xyzw(1.0, 0.0, 0.0, 1.0), Quat::from_xyzw(0.0, 1.0, 0.0, -1.0));
            return self.random.pick(&[Quat::IDENTITY, x, y, Quat::from_xyzw(0.0, 0.0, 2.0, 0.0)]);
        }
        self.random.quaternion()
    }

    fn rotation(&mut self) -> Rotation2 {
        if self.is_short {
            let quarter = Rotation2::new(0.0, 1.0).unwrap();
            return self.random.pick(&[Rotation2::IDENTITY, quarter, Rotation2::new(-1.0, 0.0).unwrap()]);
        }
        self.random.rotation2()
    }
}

/// The number of kinds of relative poses that [`pair3`] and [`pair2`] go through.
pub const PLACES: usize = 19;

/// Gaps, as shares of the size, that pairs are moved to.
const GAPS: [f64; 8] = [1e-2, 1e-5, 1e-8, 1e-12, -1e-12, -1e-8, -1e-5, -1e-2];

/// The setup of a pair: sizes of both, distance from the origin, and special properties.
struct Place {
    sizes: [f64; 2],
    origin: DVec3,
    /// Share of the reach that B is moved by.
    away: f64,
    is_short: bool,
    same_rotation: bool,
    same_shape: bool,
    gap: Option<f64>,
}

impl Place {
    fn new(round: usize, random: &mut Random) -> Self {
        let mut place = Self {
            sizes: [1.0; 2],
            origin: random.vector(),
            away: random.between(0.0, 1.3),
            is_short: false,
            same_rotation: false,
            same_shape: false,
            gap: None,
        };
        match round % PLACES {
            0..4 => {}
            4..6 => place.gap = Some(random.pick(&GAPS)),
            6..9 => place.is_short = true,
            9 => place.away = 0.0,
            10 => (place.away, place.same_rotation, place.same_shape) = (0.0, true, true),
            11 => place.same_rotation = true,
            12 => place.origin = random.direction() * 1e7,
            13 => place.sizes = [1e-5; 2],
            14 => place.sizes = [1e5; 2],
            15 => place.sizes = random.pick(&[[1.0, 1e-3], [1e-4, 1.0], [1.0, 100.0]]),
            16 => place.sizes = random.pick(&[[1e5, 1e-4], [1e-5, 1e5], [1e3, 1e-3]]),
            17 => place.origin = random.direction() * 9e8,
            _ => (place.same_rotation, place.same_shape) = (true, true),
        }
        place
    }
}

/// Two shapes in space, in the `round`-th kind of relative pose.
pub fn pair3(random: &mut Random, a: &Kind<Shape3>, b: &Kind<Shape3>, round: usize) -> Bodies3 {
    let place = Place::new(round, random);
    let mut make = |kind: &Kind<Shape3>, size: f64| {
        let mut clay = if place.is_short { Clay::short(random) } else { Clay::new(random, size) };
        (kind.1(&mut clay), clay.quaternion())
    };
    let (shape_a, turn_a) = make(a, place.sizes[0]);
    let (mut shape_b, mut turn_b) = make(b, place.sizes[1]);
    if place.same_shape && a.0 == b.0 {
        shape_b = shape_a.clone();
    }
    if place.same_rotation {
        turn_b = turn_a;
    }
    let finite = |radius: f32| if radius.is_finite() { f64::from(radius) } else { 0.0 };
    let reach = finite(shape_a.outer_radius()) + finite(shape_b.outer_radius());
    let mut at = place.origin;
    // From one centre to the other; sometimes along a side.
    let local = if place.same_rotation { random.pick(&DVec3::AXES) } else { random.direction() };
    let direction = Pose3::new(DVec3::ZERO, turn_a).unwrap().transform(local);
    let mut away = direction * (reach * place.away);
    if place.is_short {
        let mut short = || DVec3::from_array([0; 3].map(|_| random.below(33) as f64 / 8.0 - 2.0));
        (at, away) = (short(), short() * place.away);
        away = (away * 8.0).round() / 8.0;
    }
    let pose = |at: DVec3, turn: Quat| Pose3::new(at, turn).unwrap();
    let case = Case3 { shape_a, pose_a: pose(at, turn_a), shape_b, pose_b: pose(at + away, turn_b) };
    let mut bodies = Bodies3::new(case);
    for _ in 0..if place.gap.is_some() { 3 } else { 0 } {
        let truth = bodies.truth();
        let mut case = bodies.case().clone();
        let step = truth.normal * (place.gap.unwrap_or(0.0) * reach - truth.separation);
        case.pose_b = pose(case.pose_b.position() + step, turn_b);
        bodies = Bodies3::new(case);
    }
    bodies
}

/// Two shapes in the plane, in the `round`-th kind of relative pose.
pub fn pair2(random: &mut Random, a: &Kind<Shape2>, b: &Kind<Shape2>, round: usize) -> Bodies2 {
    let place = Place::new(round, random);
    let mut make = |kind: &Kind<Shape2>, size: f64| {
        let mut clay = if place.is_short { Clay::short(random) } else { Clay::new(random, size) };
        (kind.1(&mut clay), clay.rotation())
    };
    let (shape_a, turn_a) = make(a, place.sizes[0]);
    let (mut shape_b, mut turn_b) = make(b, place.sizes[1]);
    if place.same_shape && a.0 == b.0 {
        shape_b = shape_a.clone();
    }
    if place.same_rotation {
        turn_b = turn_a;
    }
    let finite = |radius: f32| if radius.is_finite() { f64::from(radius) } else { 0.0 };
    let reach = finite(shape_a.outer_radius()) + finite(shape_b.outer_radius());
    let mut at = place.origin.truncate();
    let local = if place.same_rotation { random.pick(&DVec2::AXES) } else { random.direction2() };
    let direction = turn_a.turn(local);
    let mut away = direction * (reach * place.away);
    if place.is_short {
        let mut short = || DVec2::from_array([0; 2].map(|_| random.below(33) as f64 / 8.0 - 2.0));
        (at, away) = (short(), short() * place.away);
        away = (away * 8.0).round() / 8.0;
    }
    let pose = |at: DVec2, turn: Rotation2| Pose2::new(at, turn).unwrap();
    let case = Case2 { shape_a, pose_a: pose(at, turn_a), shape_b, pose_b: pose(at + away, turn_b) };
    let mut bodies = Bodies2::new(case);
    for _ in 0..if place.gap.is_some() { 3 } else { 0 } {
        let truth = bodies.truth();
        let mut case = bodies.case().clone();
        let step = truth.normal * (place.gap.unwrap_or(0.0) * reach - truth.separation);
        case.pose_b = pose(case.pose_b.position() + step, turn_b);
        bodies = Bodies2::new(case);
    }
    bodies
}
