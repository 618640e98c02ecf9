//! Posed shapes in f64, relative to a common origin.

use crate::solid::Solid;
use asunder_geometry::{Pose2, Pose3, Shape2};
use glam::{DVec2, DVec3};

/// A posed solid.
#[derive(Clone, Debug)]
pub struct Placed3 {
    /// Vertices, rotated and moved.
    pub vertices: Vec<DVec3>,
    /// Outward unit normals of the facets, rotated.
    pub normals: Vec<DVec3>,
    /// The corners of each facet, as vertex indices.
    pub facets: Vec<Vec<usize>>,
    /// The ends of each edge, as vertex indices.
    pub edges: Vec<[usize; 2]>,
}

/// A posed polygon.
#[derive(Clone, Debug)]
pub struct Placed2 {
    /// Vertices, rotated and moved, counter-clockwise.
    pub vertices: Vec<DVec2>,
}

impl Placed3 {
    /// The solid at a pose, relative to `origin`: positions are subtracted before anything else.
    pub fn new(solid: &Solid, pose: &Pose3, origin: DVec3) -> Self {
        let moved = pose.position() - origin;
        Self {
            vertices: solid.vertices.iter().map(|v| turned(pose, v.as_dvec3()) + moved).collect(),
            normals: solid.facets.iter().map(|facet| turned(pose, facet.normal)).collect(),
            facets: solid.facets.iter().map(|facet| facet.corners.clone()).collect(),
            edges: solid.edges.clone(),
        }
    }

    /// Radius of a ball about the mean of the vertices that contains them all.
    pub fn radius(&self) -> f64 {
        let mean = self.vertices.iter().sum::<DVec3>() / self.vertices.len() as f64;
        self.vertices.iter().map(|v| (*v - mean).length()).fold(0.0, f64::max)
    }

    /// The greatest projection on an axis.
    pub fn reach(&self, axis: DVec3) -> f64 {
        self.vertices.iter().map(|v| v.dot(axis)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far a point lies beyond the plane of the facet that it is furthest beyond: at most 0 inside.
    pub fn excess(&self, point: DVec3) -> f64 {
        let beyond = |(normal, corners): (&DVec3, &Vec<usize>)| normal.dot(point - self.vertices[corners[0]]);
        self.normals.iter().zip(&self.facets).map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Placed2 {
    /// The shape at a pose, relative to `origin`.
    pub fn new(shape: &Shape2, pose: &Pose2, origin: DVec2) -> Self {
        let (c, s) = (f64::from(pose.rotation().cos()), f64::from(pose.rotation().sin()));
        let moved = pose.position() - origin;
        let place = |v: &glam::Vec2| {
            let v = v.as_dvec2();
            DVec2::new(c * v.x - s * v.y, s * v.x + c * v.y) + moved
        };
        Self { vertices: stored_vertices2(shape).iter().map(place).collect() }
    }

    /// Radius of a disc about the mean of the vertices that contains them all.
    pub fn radius(&self) -> f64 {
        let mean = self.vertices.iter().sum::<DVec2>() / self.vertices.len() as f64;
        self.vertices.iter().map(|v| (*v - mean).length()).fold(0.0, f64::max)
    }

    /// The greatest projection on an axis.
    pub fn reach(&self, axis: DVec2) -> f64 {
        self.vertices.iter().map(|v| v.dot(axis)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The edges, counter-clockwise, by their ends.
    pub fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let count = self.vertices.len();
        (0..count).map(move |i| [self.vertices[i], self.vertices[(i + 1) % count]])
    }

    /// How far a point lies beyond the line of the edge that it is furthest beyond: at most 0 inside.
    pub fn excess(&self, point: DVec2) -> f64 {
        let beyond = |[from, to]: [DVec2; 2]| (to - from).normalize().perp_dot(from - point);
        self.edges().map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The stored vertices of a shape in the plane.
pub fn stored_vertices2(shape: &Shape2) -> Vec<glam::Vec2> {
    shape.core().vertices().to_vec()
}

/// A vector rotated by M(q)/|q|^2, by the sandwich product; the library multiplies matrices.
fn turned(pose: &Pose3, v: DVec3) -> DVec3 {
    let [x, y, z, w] = pose.rotation().to_array().map(f64::from);
    let u = DVec3::new(x, y, z);
    let scale = 2.0 / (u.length_squared() + w * w);
    v + (u.cross(v) * w + u.cross(u.cross(v))) * scale
}
