//! Many bodies in few draw calls.

use crate::form::Form;
use crate::paint::Paint;
use crate::view::View;
use asunder::glam::{DVec3, Vec3};
use macroquad::color::Color;
use macroquad::math::{Vec2, Vec3 as Point, Vec4};
use macroquad::models::{Mesh, Vertex, draw_line_3d, draw_mesh};

/// The limits of a draw call: vertices are numbered with 16 bits.
pub(crate) const MOST_VERTICES: usize = 60_000;
/// Faces are fans of triangles, with fewer than three indices per vertex.
pub(crate) const MOST_INDICES: usize = 3 * MOST_VERTICES;

/// The pose of a body relative to the view's target.
pub(crate) struct Frame {
    pub(crate) position: Vec3,
    /// The body's axes in the world.
    pub(crate) axes: [Vec3; 3],
}

impl Frame {
    fn turn(&self, v: Vec3) -> Vec3 {
        self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z
    }
}

/// Triangles to be drawn together. Memory is reused from frame to frame.
#[derive(Default)]
pub(crate) struct Batch {
    meshes: Vec<Mesh>,
    used: usize,
}

impl Batch {
    /// Removes the triangles of the last frame.
    pub(crate) fn clear(&mut self) {
        for mesh in &mut self.meshes {
            mesh.vertices.clear();
            mesh.indices.clear();
        }
        self.used = 0;
    }

    /// Adds the faces of a body that face the viewer, shaded by the light.
    pub(crate) fn add(&mut self, form: &Form, frame: &Frame, view: &View, paint: Paint) {
        let [_, up, back] = view.axes().map(DVec3::as_vec3);
        let eye = back * view.distance as f32;
        // From over the viewer's shoulder, so that three faces of a box always differ in shade.
        let light = (Vec3::Y + back * 0.6 + up * 0.2 + Vec3::new(-0.45, 0.0, 0.1)).normalize();
        let mut corners = form.corners.as_slice();
        for face in &form.faces {
            let (own, rest) = corners.split_at((face.count as usize).min(corners.len()));
            corners = rest;
            let (normal, Some(&first)) = (frame.turn(face.normal), own.first()) else { continue };
            if !view.is_flat && normal.dot(eye - frame.position - frame.turn(first)) <= 0.0 {
                continue;
            }
            let shade = if view.is_flat { 1.0 } else { 0.5 + 0.5 * normal.dot(light).max(-0.3) };
            let color = paint.bytes(shade * face.tone);
            self.fan(own.iter().map(|&corner| frame.position + frame.turn(corner)), color);
        }
    }

    fn fan(&mut self, corners: impl ExactSizeIterator<Item = Vec3>, color: [u8; 4]) {
        let count = corners.len();
        if count > MOST_VERTICES / 2 {
            return;
        }
        let is_full = |mesh: &Mesh| {
            mesh.vertices.len() + count >= MOST_VERTICES || mesh.indices.len() + 3 * count >= MOST_INDICES
        };
        if self.meshes.get(self.used).is_some_and(is_full) {
            self.used += 1;
        }
        if self.used == self.meshes.len() {
            self.meshes.push(Mesh { vertices: Vec::new(), indices: Vec::new(), texture: None });
        }
        let Some(mesh) = self.meshes.get_mut(self.used) else { return };
        let first = mesh.vertices.len() as u16;
        mesh.vertices.extend(corners.map(|corner| Vertex {
            position: Point::from_array(corner.to_array()),
            uv: Vec2::ZERO,
            color,
            normal: Vec4::ZERO,
        }));
        let fan = (1..count.saturating_sub(1) as u16).flat_map(|i| [first, first + i, first + i + 1]);
        mesh.indices.extend(fan);
    }

    /// Draws all triangles.
    pub(crate) fn draw(&self) {
        self.meshes.iter().filter(|mesh| !mesh.indices.is_empty()).for_each(draw_mesh);
    }
}

/// Lines to be drawn together, relative to a view's target.
#[derive(Default)]
pub(crate) struct Lines(Vec<([Point; 2], Color)>);

impl Lines {
    /// Removes the lines of the last frame.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds a line between two points of the world.
    pub(crate) fn add(&mut self, view: &View, ends: [DVec3; 2], color: [u8; 4]) {
        let ends = ends.map(|end| Point::from_array((end - view.target).as_vec3().to_array()));
        self.0.push((ends, Color::from(color)));
    }

    /// Draws all lines, with their opacity multiplied by the share.
    pub(crate) fn draw(&self, share: f32) {
        for &([from, to], color) in &self.0 {
            draw_line_3d(from, to, Color { a: color.a * share, ..color });
        }
    }

    /// The opacity for lines that lie over each other: thousands of full ones would hide all else.
    pub(crate) fn share(&self) -> f32 {
        (400.0 / (self.0.len() as f32 + 1.0)).clamp(0.04, 0.9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_draw_call_has_more_than_it_may_and_no_face_is_lost() {
        let view = View::of((DVec3::ZERO, DVec3::ONE), true, 1.0);
        let mut form = Form::default();
        let square = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
        (0..100).for_each(|_| form.add(DVec3::Z, square, 1.0));
        let frame = Frame { position: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
        let mut batch = Batch::default();
        for _ in 0..2 {
            batch.clear();
            (0..1000).for_each(|_| batch.add(&form, &frame, &view, Paint::INK));
            assert_eq!(batch.meshes.iter().map(|mesh| mesh.indices.len()).sum::<usize>(), 600_000);
            for mesh in &batch.meshes {
                assert!(mesh.vertices.len() < MOST_VERTICES && mesh.indices.len() < MOST_INDICES);
                assert!(mesh.indices.iter().all(|&index| usize::from(index) < mesh.vertices.len()));
            }
        }
        assert_eq!(batch.meshes.len(), 7);
    }

    #[test]
    fn faces_that_look_away_are_left_out() {
        let view = View::of((DVec3::splat(-1.0), DVec3::ONE), false, 1.0);
        let [right, up, back] = view.axes();
        let mut form = Form::default();
        for normal in [back, -back] {
            form.add(normal, [right, up, -right], 1.0);
        }
        let frame = Frame { position: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z] };
        let mut batch = Batch::default();
        batch.add(&form, &frame, &view, Paint::INK);
        assert_eq!(batch.meshes[0].indices, [0, 1, 2]);
    }
}
