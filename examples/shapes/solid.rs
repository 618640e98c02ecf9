//! Convex bodies in space, drawn feature by feature: faces, edges, vertices.
//!
//! A body with a radius is the hull of balls about its core's vertices: its surface is flat over faces, a strip of a
//! cylinder along edges, and a patch of a ball at vertices. Under a parallel projection, and with a light that depends
//! only on the normal's place on the screen ([`Tint::shade`]), a strip is one linear gradient and a patch one radial
//! gradient: exact, with few elements. No two visible patches of a convex body hide each other, so their order does not
//! matter.

use crate::camera::Camera;
use crate::canvas::{Canvas, Paint};
use crate::round::{arc, around, cap_outline, facing, ring, strip_range};
use crate::tint::{INK, Tint};
use asunder::glam::{DVec2, DVec3};
use asunder::{HalfSpace, Polygon, Pose3, Shape3, Topology};

/// Half the side and the thickness, in metres, of the piece of a half-space that is shown.
const SLAB: [f64; 2] = [0.60, 0.24];
/// Shades along a strip.
const SHADES: usize = 6;

/// A convex body, projected for the viewer.
pub(crate) struct Solid<'a> {
    shape: &'a Shape3,
    tint: &'a Tint,
    /// On the picture, in pixels.
    vertices: Vec<DVec2>,
    /// In the viewer's axes.
    corners: Vec<DVec3>,
    /// Of the faces, in the viewer's axes.
    normals: Vec<DVec3>,
    /// In pixels.
    radius: f64,
}

impl<'a> Solid<'a> {
    /// The body must be convex; a half-space is shown as a slab.
    pub(crate) fn new(shape: &'a Shape3, pose: &Pose3, tint: &'a Tint, camera: &'a Camera) -> Self {
        let (core, basis) = (shape.core(), pose.basis());
        let places: Vec<DVec3> = match shape {
            Shape3::HalfSpace(half_space) => slab(half_space).map(|v| pose.transform(v)).to_vec(),
            _ => core.vertices().iter().map(|&v| pose.transform(v)).collect(),
        };
        Self {
            shape,
            tint,
            vertices: places.iter().map(|&place| camera.place(place)).collect(),
            corners: places.iter().map(|&place| camera.turn(place)).collect(),
            normals: core.normals().iter().map(|&normal| camera.turn(basis.turn(normal))).collect(),
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
        match self.shape {
            Shape3::HalfSpace(_) => self.draw_slab(canvas),
            Shape3::Sphere(_) => self.draw_ball(canvas),
            Shape3::Segment(_) => self.draw_segment(canvas),
            Shape3::Capsule(_) => self.draw_capsule(canvas),
            _ => self.draw_faces(canvas),
        }
    }

    fn draw_ball(&self, canvas: &mut Canvas) {
        for &center in &self.vertices {
            canvas.dot(center, self.radius, &Paint::fill(self.tint.base()).edged(self.tint.ink, 1.4));
            canvas.ball(center, self.radius, None, self.tint);
        }
    }

    fn draw_segment(&self, canvas: &mut Canvas) {
        let [from, to] = self.vertices[..] else { return };
        canvas.line(from, to, &Paint::line(self.tint.ink, 5.0));
        canvas.line(from, to, &Paint::line(self.tint.base(), 3.0));
        for end in [from, to] {
            canvas.dot(end, 3.4, &Paint::fill(self.tint.base()).edged(self.tint.ink, 1.0));
        }
    }

    fn draw_capsule(&self, canvas: &mut Canvas) {
        let ([from, to], [tail, head]) = (&self.vertices[..], &self.corners[..]) else { return };
        let Some(axis) = (*head - *tail).try_normalize() else { return };
        self.draw_below(canvas);
        self.draw_strip(canvas, [*from, *to], axis, [0.0, core::f64::consts::PI]);
        self.draw_patch(canvas, *to, &ring(axis));
        self.draw_patch(canvas, *from, &ring(-axis));
    }

    fn draw_faces(&self, canvas: &mut Canvas) {
        let core = self.shape.core();
        let topology = core.topology();
        self.draw_below(canvas);
        if self.radius > 0.0 {
            for vertex in 0..self.vertices.len() {
                self.draw_patch(canvas, self.vertices[vertex], &self.normals_about(topology, vertex));
            }
            for &edge in topology.edges() {
                self.draw_edge_strip(canvas, topology, usize::from(edge));
            }
        }
        for (face, &normal) in self.normals.iter().enumerate().filter(|(_, normal)| normal.z > 0.0) {
            let moved = DVec2::new(normal.x, -normal.y) * self.radius;
            let outline: Vec<DVec2> =
                topology.face_vertices(face).map(|vertex| self.vertices[vertex] + moved).collect();
            canvas.polygon(&outline, &Paint::solid(self.tint.shade(normal)));
        }
        if self.radius == 0.0 {
            self.draw_creases(canvas, topology);
        }
    }

    /// The whole outline in one colour, which shows through the joints between patches.
    fn draw_below(&self, canvas: &mut Canvas) {
        let circle = |&center: &DVec2| {
            let count = if self.radius > 0.0 { 40 } else { 1 };
            (0..count).map(move |i| center + facing(f64::from(i) / 40.0) * self.radius)
        };
        let points: Vec<_> = self.vertices.iter().flat_map(circle).map(|point| point.as_vec2()).collect();
        let Ok(hull) = Polygon::hull_of(&points) else { return };
        let outline: Vec<DVec2> = hull.vertices().iter().map(|point| point.as_dvec2()).collect();
        canvas.polygon(&outline, &Paint::fill(self.tint.base()).edged(self.tint.ink, 1.4));
    }

    /// The sharp edges between two visible faces.
    fn draw_creases(&self, canvas: &mut Canvas, topology: &Topology) {
        for &edge in topology.edges() {
            let [left, right] = self.sides(topology, usize::from(edge));
            if left.z > 0.0 && right.z > 0.0 {
                let (from, to) = topology.ends(usize::from(edge));
                let paint = Paint::line(self.tint.ink, 0.9).faint();
                canvas.line(self.vertices[from], self.vertices[to], &paint);
            }
        }
    }

    /// Normals of the two faces that share an edge.
    fn sides(&self, topology: &Topology, half_edge: usize) -> [DVec3; 2] {
        let half = topology.half_edges()[half_edge];
        let twin = topology.half_edges()[usize::from(half.twin)];
        [half, twin].map(|half| self.normals[usize::from(half.face)])
    }

    /// Normals around a vertex's patch, counter-clockwise as seen from outside.
    fn normals_about(&self, topology: &Topology, vertex: usize) -> Vec<DVec3> {
        let halves = topology.half_edges();
        let Some(first) = halves.iter().position(|half| usize::from(half.origin) == vertex) else {
            return Vec::new();
        };
        let mut faces = vec![self.normals[usize::from(halves[first].face)]];
        // The next half-edge out of the vertex, clockwise: the one after the twin.
        let mut half = usize::from(halves[usize::from(halves[first].twin)].next);
        while half != first && faces.len() < halves.len() {
            faces.push(self.normals[usize::from(halves[half].face)]);
            half = usize::from(halves[usize::from(halves[half].twin)].next);
        }
        faces.reverse();
        let after = faces.iter().cycle().skip(1);
        faces.iter().zip(after).flat_map(|(&from, &to)| arc(from, to)).collect()
    }

    fn draw_patch(&self, canvas: &mut Canvas, center: DVec2, normals: &[DVec3]) {
        let outline: Vec<DVec2> =
            cap_outline(normals).iter().map(|n| DVec2::new(n.x, -n.y) * self.radius).collect();
        if outline.len() > 2 {
            canvas.ball(center, self.radius, Some(&outline), self.tint);
        }
    }

    fn draw_edge_strip(&self, canvas: &mut Canvas, topology: &Topology, half_edge: usize) {
        let (from, to) = topology.ends(half_edge);
        let Some(axis) = (self.corners[to] - self.corners[from]).try_normalize() else { return };
        if let Some(range) = strip_range(axis, self.sides(topology, half_edge)) {
            self.draw_strip(canvas, [self.vertices[from], self.vertices[to]], axis, range);
        }
    }

    /// A strip of the cylinder about an edge, with normals between two angles about the axis: 0 and pi are its
    /// silhouettes.
    fn draw_strip(&self, canvas: &mut Canvas, [from, to]: [DVec2; 2], axis: DVec3, [low, high]: [f64; 2]) {
        let Some([across, front]) = around(axis) else { return };
        let normal = |angle: f64| across * libm::cos(angle) + front * libm::sin(angle);
        let angles = (0..=SHADES).map(|i| low + (high - low) * i as f64 / SHADES as f64);
        let normals: Vec<DVec3> = angles.map(normal).collect();
        let (Some(first), Some(last)) = (normals.first(), normals.last()) else { return };
        let (start, span) = (first.dot(across), last.dot(across) - first.dot(across));
        if span.abs() < 1e-6 {
            return;
        }
        let stops: Vec<_> = normals
            .iter()
            .map(|&normal| ((normal.dot(across) - start) / span, self.tint.shade(normal), 1.0))
            .collect();
        let down = |normal: DVec3| DVec2::new(normal.x, -normal.y) * self.radius;
        let across = DVec2::new(across.x, -across.y) * self.radius;
        let gradient = canvas.fade(from + across * start, from + across * (start + span), &stops);
        let there = normals.iter().map(|&normal| from + down(normal));
        let back = normals.iter().rev().map(|&normal| to + down(normal));
        let outline: Vec<DVec2> = there.chain(back).collect();
        canvas.polygon(&outline, &Paint::gradient(&gradient));
    }

    /// A piece of the plane with a grid on it, and some of the inside below it, which fades out.
    fn draw_slab(&self, canvas: &mut Canvas) {
        let ([a, b, c, d, e, f, g, h], [p, q, r, s, ..]) = (&self.vertices[..], &self.corners[..]) else {
            return;
        };
        let (top, deep, corners) = ([*a, *b, *c, *d], [*e, *f, *g, *h], [*p, *q, *r, *s]);
        let outward = (*q - *p).cross(*r - *q).normalize_or_zero();
        for here in 0..4 {
            let next = (here + 1) % 4;
            let side = (corners[next] - corners[here]).cross(outward).normalize_or_zero();
            if side.z > 0.0 {
                let shade = self.tint.shade(side);
                let id = canvas.fade(top[here], deep[here], &[(0.0, shade, 0.95), (1.0, shade, 0.0)]);
                let outline = [top[here], top[next], deep[next], deep[here]];
                canvas.polygon(&outline, &Paint::gradient(&id).unedged());
            }
        }
        let paint = Paint::fill(self.tint.shade(outward)).edged(self.tint.ink, 1.2);
        if outward.z <= 0.0 {
            canvas.polygon(&top, &paint.clear(0.25));
            return;
        }
        canvas.polygon(&top, &paint);
        let [a, b, c, d] = top;
        for [from, along, far, far_along] in [[a, b, d, c], [b, c, a, d]] {
            for share in [0.2, 0.4, 0.6, 0.8] {
                let paint = Paint::line(INK, 0.7).faint();
                canvas.line(from.lerp(along, share), far.lerp(far_along, share), &paint);
            }
        }
    }
}

/// The corners of the piece of a half-space that is shown: four on its plane, counter-clockwise as seen from outside,
/// and one below each.
fn slab(half_space: &HalfSpace) -> [DVec3; 8] {
    let normal = half_space.unit_normal();
    let aside = if normal.x.abs() < 0.5 { DVec3::X } else { DVec3::Z };
    let right = normal.cross(aside).cross(normal).normalize();
    let forward = normal.cross(right);
    let [half, thick] = SLAB;
    let corner = |x: f64, z: f64| (right * x + forward * z) * half;
    let top = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let [a, b, c, d] = top;
    let [e, f, g, h] = top.map(|corner| corner - normal * thick);
    [a, b, c, d, e, f, g, h]
}
