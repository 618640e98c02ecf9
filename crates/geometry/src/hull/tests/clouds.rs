//! Clouds that break hull builders, by seed.

use glam::{Quat, Vec3};

/// xorshift, for clouds without a dependency.
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.bits() >> 20) as usize % count
    }

    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// From -1 up to 1.
    pub(super) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u32 << 23) as f32 - 1.0
    }

    pub(super) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit())
    }

    pub(super) fn ball(&mut self) -> Vec3 {
        loop {
            let v = self.vector();
            if v.length_squared() <= 1.0 {
                return v;
            }
        }
    }

    pub(super) fn sphere(&mut self) -> Vec3 {
        self.ball().normalize_or(Vec3::X)
    }

    pub(super) fn turn(&mut self) -> Quat {
        let v = self.vector();
        Quat::from_xyzw(v.x, v.y, v.z, 0.1 + self.unit().abs()).normalize()
    }

    pub(super) fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }
}

pub(super) fn cloud(count: usize, seed: u64, shape: impl Fn(Vec3) -> Vec3) -> Vec<Vec3> {
    let mut random = Random::new(seed);
    (0..count).map(|_| shape(random.vector())).collect()
}

/// A few points whose coordinates are 1, 0, or anything between 1 and almost 0.
pub(super) fn thinner_than_rounding(seed: u64) -> Vec<Vec3> {
    let random = &mut Random::new(seed);
    let tiny = [[1e-9, 1e-18], [1e-12, 1e-24], [1e-18, 1e-36], [1e-21, 1e-44]][seed as usize % 4];
    let count = 4 + random.below(5);
    let mut part = || match random.below(5) {
        0 => 0.0,
        kind @ 1..3 => random.unit() * tiny[kind - 1],
        _ => random.unit(),
    };
    (0..count).map(|_| Vec3::new(part(), part(), part())).collect()
}

pub(super) const KINDS: u64 = 32;

/// A cloud of up to 80 points: coplanar, collinear, cocircular, repeated, nearly flat, thin, at the ends of the
/// range, and several of these at once.
pub(super) fn nasty(seed: u64) -> Vec<Vec3> {
    let random = &mut Random::new(seed);
    let count = 4 + random.below(60);
    let mut points: Vec<Vec3> = match seed % KINDS {
        kind @ 0..8 => (0..count).map(|_| lattice(random, kind)).collect(),
        kind @ 8..16 => (0..count).map(|_| thin(random, kind)).collect(),
        kind @ 16..24 => ring(random, kind, count),
        24 => (0..count).map(|_| random.ball()).collect(),
        25 => (0..count).map(|_| random.sphere()).collect(),
        // Subnormal steps on top of whole ones, and zeros of both signs.
        26 => (0..count).map(|_| lattice(random, 0) + lattice(random, 1) * 1e-45).collect(),
        27 => (0..count).map(|_| lattice(random, 2) * -0.0 + lattice(random, 0) * 1e-6).collect(),
        // A cap so flat that its facets are almost coplanar, on a body.
        28 => (0..count)
            .map(|i| if i < 8 { corner(i) - Vec3::Z } else { cap(random, 1e-3 * (1 + i % 3) as f32) })
            .collect(),
        // The ends of the range.
        29 => (0..count).map(|_| random.ball() * 0.99e6).collect(),
        30 => (0..count).map(|_| random.sphere() * 1.1e-6).collect(),
        _ => (0..count).map(|_| random.ball() * [1e-30, 1.0, 1e5][random.below(3)]).collect(),
    };
    if random.below(3) == 0 {
        for _ in 0..count / 3 {
            let again = points[random.below(points.len())];
            points.push(again);
        }
    }
    if random.below(4) == 0 {
        let turn = random.turn();
        points.iter_mut().for_each(|v| *v = turn * *v);
    }
    if random.below(6) == 0 {
        let far = random.vector() * [3.0, 1e3, 5e5][random.below(3)];
        points.iter_mut().for_each(|v| *v = (*v + far).clamp_length_max(9.9e5));
    }
    points
}

fn corner(i: usize) -> Vec3 {
    Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - Vec3::ONE
}

fn cap(random: &mut Random, angle: f32) -> Vec3 {
    let (x, y) = (random.unit() * angle, random.unit() * angle);
    Vec3::new(x, y, (1.0 - x * x - y * y).sqrt() - 1.0 + 1e-5)
}

fn lattice(random: &mut Random, kind: u64) -> Vec3 {
    let steps = |v: Vec3, n: f32| (v * n).round() / n;
    let v = random.vector();
    match kind {
        0 => steps(v, 1.0),
        1 => steps(v, 2.0),
        2 => steps(v, 3.0) + v * 1e-7,
        3 => Vec3::splat(1e5) + steps(v, 4.0),
        // Most of it in one plane, or on one line.
        4 => Vec3::new(v.x, v.y, if v.z > 0.5 { v.z } else { 0.25 }),
        5 => {
            if v.x > 0.6 {
                steps(v, 2.0)
            } else {
                Vec3::new(steps(v, 7.0).x, 0.0, -0.0)
            }
        }
        // An exactly slanted plane through lattice points, and the odd point off it.
        6 => {
            let s = steps(v, 4.0);
            Vec3::new(s.x, s.y, s.x + s.y + if v.z > 0.7 { 0.25 } else { 0.0 })
        }
        _ => steps(v, 2.0) * Vec3::new(1.0, 0.1, 0.3),
    }
}

fn thin(random: &mut Random, kind: u64) -> Vec3 {
    let v = random.vector();
    let steps = (v * 2.0).round() * 0.5;
    match kind {
        8 => Vec3::new(v.x, v.y, v.z * 1e-7),
        9 => Vec3::new(v.x, v.y * 1e-6, v.z * 1e-6),
        10 => Vec3::new(v.x, v.y, v.z * 1e-6),
        // Exactly coplanar corners, and bumps below the tolerance.
        11 => Vec3::new(steps.x, steps.y, if v.z > 0.8 { v.x * 1e-8 } else { 0.0 }),
        12 => Vec3::new(steps.x, steps.y * 1e-7, steps.z * 1e-7),
        // Exactly flat, exactly on one line, at one place.
        13 => Vec3::new(v.x, v.y, 0.3),
        14 => Vec3::new(steps.x, 2.0 * steps.x, -steps.x),
        _ => Vec3::new(v.x, (v.y * 2.0).round() * 1e-38, (v.z * 2.0).round() * 1e-44),
    }
}

/// Points on circles, rotated or not: rings, prisms, cones, double cones, cylinders with many corners.
fn ring(random: &mut Random, kind: u64, count: usize) -> Vec<Vec3> {
    let corners = 3 + random.below(20);
    let turn = if kind.is_multiple_of(2) { Quat::IDENTITY } else { random.turn() };
    let place = |i: usize, random: &mut Random| {
        let angle = (i % corners) as f32 / corners as f32 * core::f32::consts::TAU;
        let level = (i / corners % 2) as f32;
        let around = Vec3::new(libm::cosf(angle), libm::sinf(angle), level);
        match kind / 2 {
            8 => around,
            9 => around * (1.0 - level),
            10 => Vec3::new(around.x * (1.0 - level), around.y * (1.0 - level), level * 1e-4),
            _ => around + Vec3::Z * random.unit() * 1e-7,
        }
    };
    (0..count).map(|i| turn * place(i, random)).collect()
}
