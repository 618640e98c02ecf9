//! Shapes in the plane.

use crate::camera::Camera;
use crate::canvas::{Canvas, Paint, short};
use crate::tint::Tint;
use asunder::glam::DVec2;
use asunder::{Pose2, Shape2};
use core::fmt::Write;

/// Half the width and the depth, in metres, of the piece of a half-plane that is shown.
const STRIP: [f64; 2] = [0.80, 0.40];

/// A convex shape, projected for the viewer.
pub(crate) struct Flat<'a> {
    shape: &'a Shape2,
    tint: &'a Tint,
    /// In the picture's pixels.
    vertices: Vec<DVec2>,
    /// Of the edges, on the picture.
    normals: Vec<DVec2>,
    /// In pixels.
    radius: f64,
}

impl<'a> Flat<'a> {
    /// The shape must be convex; a half-plane is shown as a strip.
    pub(crate) fn new(shape: &'a Shape2, pose: &Pose2, tint: &'a Tint, camera: &'a Camera) -> Self {
        let core = shape.core();
        let places: Vec<DVec2> = match shape {
            Shape2::HalfPlane(half_plane) => {
                let up = half_plane.unit_normal();
                let ([half, deep], right) = (STRIP, -up.perp());
                let corners =
                    [right * half, -right * half, -right * half - up * deep, right * half - up * deep];
                corners.map(|v| pose.transform(v)).to_vec()
            }
            Shape2::Chain(chain) => chain.vertices().iter().map(|&v| pose.transform(v)).collect(),
            _ => core.vertices().iter().map(|&v| pose.transform(v)).collect(),
        };
        let normal =
            |&normal: &DVec2| pose.rotation().turn(normal).normalize_or_zero() * DVec2::new(1.0, -1.0);
        Self {
            shape,
            tint,
            vertices: places.iter().map(|&place| camera.place(place.extend(0.0))).collect(),
            normals: core.normals().iter().map(normal).collect(),
            radius: f64::from(shape.radius()) * camera.scale,
        }
    }

    /// The corners of the picture's rectangle around it.
    pub(crate) fn frame(&self) -> [DVec2; 2] {
        let around =
            |(low, high): (DVec2, DVec2), &v: &DVec2| (low.min(v - self.radius), high.max(v + self.radius));
        self.vertices.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), around).into()
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas) {
        let tint = self.tint;
        let paint = Paint::fill(tint.base()).clear(0.72).edged(tint.ink, 1.4);
        match self.shape {
            Shape2::HalfPlane(_) => {
                let [right, left, deep_left, _] = self.vertices[..] else { return };
                let stops = [(0.0, tint.base(), 0.85), (1.0, tint.base(), 0.0)];
                let id = canvas.fade(left, deep_left, &stops);
                canvas.polygon(&self.vertices, &Paint::gradient(&id).unedged());
                canvas.line(left, right, &Paint::line(tint.ink, 1.6));
            }
            Shape2::Segment(_) => {
                let [from, to] = self.vertices[..] else { return };
                canvas.line(from, to, &Paint::line(tint.ink, 5.0));
                canvas.line(from, to, &Paint::line(tint.base(), 3.0));
                for end in [from, to] {
                    canvas.dot(end, 3.4, &Paint::fill(tint.base()).edged(tint.ink, 1.0));
                }
            }
            Shape2::Chain(chain) => {
                let back = if chain.is_closed() { self.vertices.first() } else { None };
                for (from, to) in self.vertices.iter().zip(self.vertices.iter().skip(1).chain(back)) {
                    canvas.line(*from, *to, &Paint::line(tint.ink, 5.0));
                    canvas.line(*from, *to, &Paint::line(tint.base(), 3.0));
                }
                for &vertex in &self.vertices {
                    canvas.dot(vertex, 3.4, &Paint::fill(tint.base()).edged(tint.ink, 1.0));
                }
            }
            Shape2::Circle(_) => self.vertices.iter().for_each(|&v| canvas.dot(v, self.radius, &paint)),
            _ => canvas.path(&self.outline(), &paint),
        }
    }

    /// The edges moved out by the radius, and an arc about each vertex.
    fn outline(&self) -> String {
        let mut data = String::new();
        let (count, r) = (self.vertices.len(), short(self.radius, 1));
        for (i, &normal) in self.normals.iter().enumerate() {
            let (from, to) =
                (self.vertices[i % count] + normal * self.radius, self.vertices[(i + 1) % count]);
            let to = to + normal * self.radius;
            let [x0, y0, x1, y1] = [from.x, from.y, to.x, to.y].map(|v| short(v, 1));
            let _ = match (i, self.radius > 0.0) {
                (0, _) => write!(data, "M{x0} {y0}L{x1} {y1}"),
                (_, false) => write!(data, "L{x1} {y1}"),
                (_, true) => write!(data, "A{r} {r} 0 0 0 {x0} {y0}L{x1} {y1}"),
            };
        }
        if let (true, Some(&first), Some(&start)) =
            (self.radius > 0.0, self.normals.first(), self.vertices.first())
        {
            let DVec2 { x, y } = start + first * self.radius;
            let _ = write!(data, "A{r} {r} 0 0 0 {} {}", short(x, 1), short(y, 1));
        }
        data + "Z"
    }
}
