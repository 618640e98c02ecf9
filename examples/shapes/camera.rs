//! Where the viewer stands.

use asunder::glam::{DVec2, DVec3};

/// A parallel projection onto the picture: all cameras share it and differ in scale and in where the origin is.
#[derive(Clone, Copy)]
pub(crate) struct Camera {
    right: DVec3,
    up: DVec3,
    toward_viewer: DVec3,
    /// Pixels a metre.
    pub scale: f64,
    /// The pixel of the world's origin.
    pub origin: DVec2,
}

impl Camera {
    /// Looks down a little, from the front.
    pub(crate) fn above() -> Self {
        Self::from(DVec3::new(0.42, 0.46, 0.90))
    }

    /// Looks at the plane of x and y.
    pub(crate) fn front() -> Self {
        Self::from(DVec3::Z)
    }

    fn from(toward_viewer: DVec3) -> Self {
        let toward_viewer = toward_viewer.normalize();
        let right = DVec3::Y.cross(toward_viewer).normalize();
        Self { right, up: toward_viewer.cross(right), toward_viewer, scale: 1.0, origin: DVec2::ZERO }
    }

    pub(crate) fn scaled(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    pub(crate) fn toward_viewer(&self) -> DVec3 {
        self.toward_viewer
    }

    /// Projects a point of the world onto the picture.
    pub(crate) fn place(&self, point: DVec3) -> DVec2 {
        self.origin + DVec2::new(point.dot(self.right), -point.dot(self.up)) * self.scale
    }

    /// A direction of the world in the viewer's axes: x right, y up, z towards the viewer.
    pub(crate) fn turn(&self, direction: DVec3) -> DVec3 {
        DVec3::new(direction.dot(self.right), direction.dot(self.up), direction.dot(self.toward_viewer))
    }

    /// The same camera, moved so that what it shows is centred on a point, and scaled down if it does not fit the room
    /// there. `frame` returns the picture's rectangle around what a given camera shows.
    pub(crate) fn fitted(self, room: DVec2, center: DVec2, frame: impl Fn(&Self) -> [DVec2; 2]) -> Self {
        let [low, high] = frame(&self);
        let camera = self.scaled(self.scale * (room / (high - low)).min_element().min(1.0));
        let [low, high] = frame(&camera);
        Self { origin: camera.origin + center - (low + high) * 0.5, ..camera }
    }
}

/// The smallest rectangle around others.
pub(crate) fn joined(frames: impl Iterator<Item = [DVec2; 2]>) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    frames.fold(start, |[low, high], frame| [low.min(frame[0]), high.max(frame[1])])
}
