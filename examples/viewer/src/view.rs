//! Where the eye is, and what it sees.

use asunder::glam::DVec3;
use macroquad::camera::Camera;
use macroquad::math::{Mat4, Vec3};
use macroquad::texture::RenderPass;

/// Tangent of half the angle between the lower and the upper edge of the picture.
const HALF_ANGLE: f64 = 0.41;
/// A margin around what is shown at first, as a factor.
const AIR: f64 = 1.06;

/// An eye that circles around a point, or looks down on the plane.
#[derive(Clone, Debug)]
pub(crate) struct View {
    /// The point it looks at. All is drawn relative to it: far from the origin f32 would be too coarse.
    pub(crate) target: DVec3,
    /// From the target to the eye; in the plane, the distance that would give the same height of the picture.
    pub(crate) distance: f64,
    /// The angle about the vertical, in radians.
    turn: f64,
    /// The angle above the horizon, in radians.
    rise: f64,
    axes: [DVec3; 3],
    /// Whether this is the plane, without perspective.
    pub(crate) is_flat: bool,
    /// Width of the picture by its height.
    pub(crate) aspect: f64,
}

impl View {
    /// A view that shows the whole of a box.
    pub(crate) fn of((low, high): (DVec3, DVec3), is_flat: bool, aspect: f64) -> Self {
        let (turn, rise) = if is_flat { (0.0, 0.0) } else { (0.55, 0.36) };
        let axes = axes(turn, rise);
        let mut view = Self { target: (low + high) * 0.5, distance: 1.0, turn, rise, axes, is_flat, aspect };
        let [right, up, back] = axes;
        let half = (high - low) * 0.5;
        let corners = (0..8).map(|corner| {
            let side = |axis: usize| if corner >> axis & 1 == 1 { half[axis] } else { -half[axis] };
            DVec3::new(side(0), side(1), side(2))
        });
        let distance = corners.map(|corner| {
            let (across, over) = (corner.dot(right).abs() / aspect, corner.dot(up).abs());
            across.max(over) / HALF_ANGLE + if is_flat { 0.0 } else { corner.dot(back) }
        });
        view.distance = distance.fold(1e-3, f64::max) * AIR;
        view
    }

    /// The directions to the right, up, and towards the viewer, each of length 1.
    pub(crate) fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    /// Where the eye is.
    pub(crate) fn eye(&self) -> DVec3 {
        self.target + self.axes()[2] * self.distance
    }

    /// The ray through a point of the picture, whose coordinates are from -1 to 1: its origin and direction.
    pub(crate) fn ray(&self, [x, y]: [f64; 2]) -> (DVec3, DVec3) {
        let [right, up, back] = self.axes();
        let aside = (right * (x * self.aspect) + up * y) * HALF_ANGLE;
        match self.is_flat {
            true => (self.target + (aside + back) * self.distance, -back),
            false => (self.eye(), (aside - back).normalize()),
        }
    }

    /// Where that ray meets the plane through a point that faces the eye.
    pub(crate) fn beside(&self, at: [f64; 2], point: DVec3) -> DVec3 {
        let (from, direction) = self.ray(at);
        let back = self.axes()[2];
        from + direction * ((from - point).dot(back) / -direction.dot(back))
    }

    /// Whether part of a ball may be visible.
    pub(crate) fn sees(&self, center: DVec3, radius: f64) -> bool {
        let [right, up, back] = self.axes();
        let from = center - self.target;
        let depth = if self.is_flat { self.distance } else { self.distance - from.dot(back) };
        // The sides of the view volume are slanted: along its axes a ball reaches further than its radius, by at most
        // this factor.
        let reach = radius * 1.5;
        let high = depth.max(0.0) * HALF_ANGLE + reach;
        depth > -radius && from.dot(up).abs() < high && from.dot(right).abs() < high * self.aspect + reach
    }

    /// Orbits around the target by so many radians.
    pub(crate) fn orbit(&mut self, turn: f64, rise: f64) {
        if !self.is_flat {
            self.turn += turn;
            self.rise = (self.rise + rise).clamp(-1.5, 1.5);
            self.axes = axes(self.turn, self.rise);
        }
    }

    /// Moves aside, by shares of half the picture's height.
    pub(crate) fn pan(&mut self, x: f64, y: f64) {
        let [right, up, _] = self.axes();
        self.target += (right * x + up * y) * (self.distance * HALF_ANGLE);
    }

    /// Moves nearer if the factor is below 1.
    pub(crate) fn zoom(&mut self, factor: f64) {
        self.distance = (self.distance * factor).clamp(1e-5, 1e7);
    }

    /// The camera for macroquad. Without depth, whatever is drawn covers what was drawn before.
    pub(crate) fn lens(&self, has_depth: bool) -> Lens {
        let vec3 = |v: DVec3| Vec3::from_array(v.as_vec3().to_array());
        let [_, up, back] = self.axes();
        let high = (HALF_ANGLE * self.distance) as f32;
        let (wide, aspect) = (high * self.aspect as f32, self.aspect as f32);
        let (near, far) = ((self.distance * 0.02) as f32, (self.distance * 40.0) as f32);
        let seen = match self.is_flat {
            true => Mat4::orthographic_rh_gl(-wide, wide, -high, high, near, far),
            false => Mat4::perspective_rh_gl(2.0 * libm::atan(HALF_ANGLE) as f32, aspect, near, far),
        };
        let matrix = seen * Mat4::look_at_rh(vec3(back * self.distance), Vec3::ZERO, vec3(up));
        Lens { matrix, has_depth }
    }
}

fn axes(turn: f64, rise: f64) -> [DVec3; 3] {
    let (turn_sin, turn_cos) = libm::sincos(turn);
    let (rise_sin, rise_cos) = libm::sincos(rise);
    let back = DVec3::new(turn_sin * rise_cos, rise_sin, turn_cos * rise_cos);
    let right = DVec3::new(turn_cos, 0.0, -turn_sin);
    [right, back.cross(right), back]
}

/// A camera for macroquad that can do without a depth buffer.
pub(crate) struct Lens {
    matrix: Mat4,
    has_depth: bool,
}

impl Camera for Lens {
    fn matrix(&self) -> Mat4 {
        self.matrix
    }

    fn depth_enabled(&self) -> bool {
        self.has_depth
    }

    fn render_pass(&self) -> Option<RenderPass> {
        None
    }

    fn viewport(&self) -> Option<(i32, i32, i32, i32)> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_seen_whole_and_fills_the_picture() {
        for (is_flat, high) in [(true, DVec3::new(9.0, 2.0, 0.0)), (false, DVec3::new(1.0, 7.0, 3.0))] {
            let view = View::of((DVec3::ZERO, high), is_flat, 1.6);
            let mut most: f64 = 0.0;
            for corner in 0..8 {
                let pick = |axis: usize| if corner >> axis & 1 == 1 { high[axis] } else { 0.0 };
                let place = view.lens(true).matrix.project_point3(Vec3::from_array(
                    (DVec3::new(pick(0), pick(1), pick(2)) - view.target).as_vec3().to_array(),
                ));
                most = most.max(f64::from(place.x.abs().max(place.y.abs())));
            }
            assert!((0.9..1.0).contains(&most), "{most}");
        }
    }

    #[test]
    fn the_ray_through_a_pixel_meets_what_is_drawn_there() {
        for is_flat in [true, false] {
            let mut view = View::of((DVec3::ZERO, DVec3::ONE), is_flat, 1.6);
            view.orbit(2.0, -0.7);
            view.pan(0.3, 0.1);
            let point = view.beside([0.4, -0.6], DVec3::splat(0.2));
            let drawn = Vec3::from_array((point - view.target).as_vec3().to_array());
            let place = view.lens(true).matrix.project_point3(drawn);
            assert!((place.x - 0.4).abs() < 1e-4 && (place.y + 0.6).abs() < 1e-4, "{place}");
            assert!(view.sees(point, 0.0) && !view.sees(view.target + view.axes()[1] * 9.0, 1.0));
        }
    }
}
