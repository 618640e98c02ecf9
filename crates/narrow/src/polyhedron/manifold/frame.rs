//! The frame in which contact points of two faces are built: two coordinates across the normal, and a height.

use asunder_geometry::glam::DVec3;

/// Coordinates along and across the direction in which heights over the reference plane are measured.
///
/// The sides of a face project to lines in it, so that clipping is two-dimensional; a point is mapped back to space
/// once it has been chosen.
#[derive(Clone, Copy, Debug)]
pub(in crate::polyhedron) struct Frame {
    /// A point of the reference plane.
    origin: DVec3,
    /// Unit vectors across the direction of measurement; they make a right-handed basis with it.
    across: [DVec3; 2],
    /// Unit direction out of the reference shape along which heights are measured.
    pub(in crate::polyhedron) along: DVec3,
    /// A point's height is the dot product of this with its offset from the origin.
    over: DVec3,
    /// Unit normal of the reference plane: mostly the same as `along`.
    facing: DVec3,
    /// The slope of the plane along each coordinate; zero for a plane that is square to `along`.
    rises: [f64; 2],
}

impl Frame {
    /// Heights over the plane through a point and square to `along`, which is of unit length.
    ///
    /// Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin, "Building an orthonormal basis, revisited" (JCGT
    /// 2017).
    pub(in crate::polyhedron) fn level(along: DVec3, origin: DVec3) -> Self {
        let DVec3 { x, y, z } = along;
        let sign = 1.0_f64.copysign(z);
        let p = -1.0 / (sign + z);
        let q = x * y * p;
        let across =
            [DVec3::new(1.0 + sign * x * x * p, sign * q, -sign * x), DVec3::new(q, sign + y * y * p, -y)];
        Self { origin, across, along, over: along, facing: along, rises: [0.0; 2] }
    }

    /// Heights along `along` over a tilted plane: through a point and square to `facing`, which is within a right angle
    /// of `along`.
    pub(super) fn leaning(along: DVec3, facing: DVec3, origin: DVec3) -> Self {
        let level = Self::level(along, origin);
        let over = facing / facing.dot(along);
        Self { over, facing, rises: level.across.map(|across| -over.dot(across)), ..level }
    }

    /// Outward unit normal of the reference plane.
    #[inline]
    pub(super) fn facing(&self) -> DVec3 {
        self.facing
    }

    /// A vector's coordinates across the direction of measurement.
    #[inline]
    pub(super) fn shift(&self, vector: DVec3) -> [f64; 2] {
        [self.across[0].dot(vector), self.across[1].dot(vector)]
    }

    /// What a vector adds to the height.
    #[inline]
    pub(super) fn lift(&self, vector: DVec3) -> f64 {
        self.over.dot(vector)
    }

    /// A point's coordinates across the direction of measurement.
    #[inline]
    pub(super) fn shift_of(&self, point: DVec3) -> [f64; 2] {
        self.shift(point - self.origin)
    }

    /// A point's coordinates and height.
    #[inline]
    pub(in crate::polyhedron) fn place(&self, point: DVec3) -> ([f64; 2], f64) {
        let from_origin = point - self.origin;
        (self.shift(from_origin), self.lift(from_origin))
    }

    /// The point with these coordinates and height.
    #[inline]
    pub(super) fn point(&self, [x, y]: [f64; 2], height: f64) -> DVec3 {
        let level = height + (self.rises[0] * x + self.rises[1] * y);
        self.origin + self.across[0] * x + self.across[1] * y + self.along * level
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_comes_back_from_any_frame() {
        let point = DVec3::new(0.3, -1.5, 0.7);
        let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let slanted = [DVec3::new(1.0, 2.0, -3.0), DVec3::new(1e-9, 0.0, -1.0)].map(DVec3::normalize);
        for along in axes.into_iter().chain(slanted) {
            let facing = (along + DVec3::new(0.02, -0.01, 0.03)).normalize();
            for frame in [Frame::level(along, DVec3::ONE), Frame::leaning(along, facing, DVec3::ONE)] {
                let (at, height) = frame.place(point);
                assert!((frame.point(at, height) - point).length() < 1e-14, "{frame:?}");
                let foot = point - along * height;
                assert!((foot - DVec3::ONE).dot(frame.over).abs() < 1e-14, "on the plane: {frame:?}");
                let [u, v] = frame.across;
                assert!((u.cross(v) - along).length() < 1e-14, "right-handed: {frame:?}");
            }
        }
    }
}
