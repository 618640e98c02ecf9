//! Rotations in plain f64 scalars. glam's quaternion products sum in an order that depends on the processor, which a
//! scene must not do.

use glam::{DVec3, Quat};

/// A unit quaternion: vector part `v`, scalar part `w`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    pub(crate) v: DVec3,
    pub(crate) w: f64,
}

impl Turn {
    pub(crate) const IDENTITY: Self = Self { v: DVec3::ZERO, w: 1.0 };

    /// About a unit axis by an angle in radians.
    pub(crate) fn about(axis: DVec3, angle: f64) -> Self {
        Self { v: axis * libm::sin(angle * 0.5), w: libm::cos(angle * 0.5) }
    }

    /// The shortest rotation that takes one unit vector to another.
    pub(crate) fn between(from: DVec3, to: DVec3) -> Self {
        let w = 1.0 + from.dot(to);
        if w < 1e-9 {
            // Opposite vectors: half a turn about any perpendicular axis.
            let across = if from.x.abs() < 0.7 { DVec3::X } else { DVec3::Y };
            return Self { v: unit(from.cross(across)), w: 0.0 };
        }
        let v = from.cross(to);
        let length = (v.dot(v) + w * w).sqrt();
        Self { v: v / length, w: w / length }
    }

    /// First `other`, then this one.
    pub(crate) fn after(self, other: Self) -> Self {
        Self {
            v: other.v * self.w + self.v * other.w + self.v.cross(other.v),
            w: self.w * other.w - self.v.dot(other.v),
        }
    }

    pub(crate) fn apply(self, p: DVec3) -> DVec3 {
        let t = self.v.cross(p) * 2.0;
        p + t * self.w + self.v.cross(t)
    }

    pub(crate) fn to_quat(self) -> Quat {
        Quat::from_xyzw(self.v.x as f32, self.v.y as f32, self.v.z as f32, self.w as f32)
    }
}

pub(crate) fn unit(v: DVec3) -> DVec3 {
    v / v.dot(v).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn turns_compose_and_carry_vectors() {
        let mut random = Random::new(1);
        for _ in 0..100 {
            let (a, b, p) = (random.turn(), random.turn(), random.direction());
            assert!((a.after(b).apply(p) - a.apply(b.apply(p))).length() < 1e-12);
            let q = random.direction();
            assert!((Turn::between(p, q).apply(p) - q).length() < 1e-12);
        }
        assert!((Turn::between(DVec3::X, DVec3::NEG_X).apply(DVec3::X) - DVec3::NEG_X).length() < 1e-12);
        assert!(
            (Turn::about(DVec3::Z, core::f64::consts::FRAC_PI_2).apply(DVec3::X) - DVec3::Y).length() < 1e-12
        );
    }
}
