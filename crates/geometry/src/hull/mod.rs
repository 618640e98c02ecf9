//! Convex hulls of points in space.
//!
//! ```text
//! points -> unique -> exact facets (quick) -> flat faces (merge) -> topology, normals, radii
//!                          ^                      |
//!                          +-- without the vertices that ended up inside a flat face
//! ```

mod error;
mod merge;
mod predicate;
mod quick;
#[cfg(test)]
mod wrap;

pub use error::HullError;
use merge::merge_facets;
use quick::hull_facets;

use crate::aabb::Aabb3;
use crate::outward::{around3, round_down, round_up};
use crate::pose3::Pose3;
use crate::radius::{RadiusError, check_rounding, grown};
use crate::tolerance::{COPLANAR, MAX_HULL_POINTS, MAX_HULL_VERTICES, MAX_RADIUS, MIN_RADIUS, THIN};
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// The convex hull of points in space: 4 to 256 vertices in metres. Clones share the data.
///
/// The vertices are a subset of the points, bit for bit. Which points are vertices, and which facets bound them, is
/// decided exactly; facets that differ from one plane by rounding only are then merged into one face, and
/// [`Hull::planarity_error`] says by how much such a face is not flat.
///
/// ```
/// use asunder_geometry::{Hull, glam::Vec3};
/// let mut points: Vec<Vec3> = (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
/// points.push(Vec3::splat(0.5));
/// let cube = Hull::from_points(&points)?;
/// assert_eq!((cube.vertices().len(), cube.topology().edges().len(), cube.topology().face_count()), (8, 12, 6));
/// assert_eq!(cube.error(), 0.0);
/// # Ok::<(), asunder_geometry::HullError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    data: Arc<HullData>,
    radius: f32,
}

#[derive(Debug, PartialEq)]
struct HullData {
    vertices: Box<[Vec3]>,
    topology: Topology,
    normals: Box<[DVec3]>,
    center: Vec3,
    outer_radius: f32,
    inner_radius: f32,
    planarity_error: f32,
    error: f32,
}

impl Hull {
    /// The hull of up to 65,535 points. Cost: about n log n.
    ///
    /// A point that lies inside a face that is flat up to rounding is no vertex; [`Hull::error`] says how far
    /// outside the hull any such point may lie.
    ///
    /// # Errors
    /// Points that are too few, too many, not finite, out of range, or all in one plane; more than 256 vertices.
    pub fn from_points(points: &[Vec3]) -> Result<Self, HullError> {
        check_points(points)?;
        let mut kept = unique(points);
        let scale = kept.iter().map(|v| (v.as_dvec3() - kept[0].as_dvec3()).length()).fold(0.0, f64::max);
        let mut dropped: Vec<Vec3> = Vec::new();
        loop {
            let facets = hull_facets(&kept)?;
            let merged = merge_facets(&kept, &facets, COPLANAR * 0.5 * scale);
            if merged.inside.is_empty() {
                return Self::from_faces(&kept, &merged.faces, &dropped);
            }
            dropped.extend(merged.inside.iter().map(|&i| kept[i as usize]));
            let mut index = 0;
            kept.retain(|_| {
                index += 1;
                merged.inside.binary_search(&(index - 1)).is_err()
            });
        }
    }

    /// Derives everything else from the face loops over `points`, most of which may be no vertices.
    fn from_faces(points: &[Vec3], faces: &[Vec<u32>], dropped: &[Vec3]) -> Result<Self, HullError> {
        let mut number = vec![u16::MAX; points.len()];
        let mut vertices = Vec::new();
        for &i in faces.iter().flatten() {
            number[i as usize] = 0;
        }
        for (i, slot) in number.iter_mut().enumerate().filter(|(_, slot)| **slot == 0) {
            *slot = vertices.len() as u16;
            vertices.push(points[i]);
        }
        if vertices.len() > MAX_HULL_VERTICES {
            return Err(HullError::TooManyVertices { at_least: vertices.len() });
        }
        let loops: Vec<Vec<u16>> =
            faces.iter().map(|face| face.iter().map(|&i| number[i as usize]).collect()).collect();
        let topology = Topology::from_loops(loops.iter().map(Vec::as_slice));
        let normals: Box<[DVec3]> =
            loops.iter().map(|face| merge::unit_normal(face.iter().map(|&i| vertices[i as usize]))).collect();

        let center = volume_center(&vertices, &loops).as_vec3();
        let from_center = |v: &Vec3| v.as_dvec3() - center.as_dvec3();
        let outer = vertices.iter().map(|v| from_center(v).length()).fold(0.0, f64::max);
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        if outer_radius < MIN_RADIUS {
            return Err(HullError::TooSmall { radius: outer_radius });
        }
        let (mut inner, mut planarity) = (f64::INFINITY, 0.0_f64);
        for (normal, face) in normals.iter().zip(&loops) {
            let reach = |i: &u16| normal.dot(from_center(&vertices[*i as usize]));
            let low = face.iter().map(reach).fold(f64::INFINITY, f64::min);
            let high = vertices.iter().map(|v| normal.dot(from_center(v))).fold(f64::NEG_INFINITY, f64::max);
            (inner, planarity) = (inner.min(low), planarity.max(high - low));
        }
        // The inscribed sphere must hold for the true shape, which lies within the planarity error of its faces.
        let inner_radius = round_down((inner - planarity - 8.0 * f64::EPSILON * outer).max(0.0));
        let mut hull = HullData {
            vertices: vertices.into(),
            topology,
            normals,
            center,
            outer_radius,
            inner_radius,
            planarity_error: round_up(planarity),
            error: 0.0,
        };
        let error = dropped.iter().map(|&p| hull.distance_outside(p.as_dvec3())).fold(0.0, f64::max);
        if error > 0.0 {
            hull.error = round_up(error + 8.0 * f64::EPSILON * outer);
        }
        Ok(Self { data: Arc::new(hull), radius: 0.0 })
    }

    /// The vertices, in the order of the points they were.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        &self.data.vertices
    }

    /// Faces, edges and how they meet.
    #[inline]
    pub fn topology(&self) -> &Topology {
        &self.data.topology
    }

    /// Outward unit normals of the faces, computed in f64.
    #[inline]
    pub fn normals(&self) -> &[DVec3] {
        &self.data.normals
    }

    /// The centre that both radii are about: the centre of volume, rounded to f32.
    #[inline]
    pub fn center(&self) -> Vec3 {
        self.data.center
    }

    /// The same hull with everything within `radius` metres added: round corners and edges, and larger by the radius on
    /// every side. Zero takes the rounding away.
    ///
    /// ```
    /// use asunder_geometry::{Hull, glam::{DVec3, Vec3}};
    /// let rounded = Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z])?.rounded(0.5)?;
    /// assert!(rounded.contains(DVec3::new(0.2, 0.2, -0.5)) && !rounded.contains(DVec3::new(-0.4, -0.4, 0.2)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A radius that is negative or not finite, or with which the shape would reach further than 1e6 m.
    pub fn rounded(mut self, radius: f32) -> Result<Self, RadiusError> {
        let reach = self.vertices().iter().map(|v| v.as_dvec3().length()).fold(0.0, f64::max);
        check_rounding(radius, reach)?;
        self.radius = radius;
        Ok(self)
    }

    /// Radius of the rounding, in metres; zero for sharp edges.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Radius of a sphere about [`Hull::center`] that holds the shape, in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        grown(self.data.outer_radius, self.radius)
    }

    /// Radius of a sphere about [`Hull::center`] that lies inside the shape, in metres, rounded down.
    #[inline]
    pub fn inner_radius(&self) -> f32 {
        round_down(f64::from(self.data.inner_radius) + f64::from(self.radius))
    }

    /// Whether the inscribed radius of the vertices' hull is below [`THIN`] of its bounding one.
    #[inline]
    pub fn is_thin(&self) -> bool {
        self.data.inner_radius < THIN * self.data.outer_radius
    }

    /// Whether the closed shape holds a local point, in metres: without rounding, whether no face has it outside. Cost:
    /// linear in the faces' corners.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        point.is_finite() && self.data.distance_outside(point) <= f64::from(self.radius)
    }

    /// How far any vertex lies beyond the lowest vertex of any face, along that face's normal, in metres: what
    /// merging nearly coplanar facets cost. At most a few 1e-7 of the size.
    #[inline]
    pub fn planarity_error(&self) -> f32 {
        self.data.planarity_error
    }

    /// A bound on how far outside the hull any of the given points lies, in metres. Zero unless a face that is flat
    /// up to rounding had points inside it.
    #[inline]
    pub fn error(&self) -> f32 {
        self.data.error
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards. Cost: linear in the vertices.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        let vertices = self.vertices().iter().map(|vertex| vertex.as_dvec3());
        around3(vertices, pose, f64::from(margin) + f64::from(self.radius))
    }
}

impl HullData {
    /// An upper bound on a point's distance from the hull: its distance to the nearest triangle of any face, or zero
    /// where no face has it outside.
    fn distance_outside(&self, p: DVec3) -> f64 {
        let vertex = |i: usize| self.vertices[i].as_dvec3();
        let is_outside = self.normals.iter().enumerate().any(|(face, normal)| {
            self.topology.face_vertices(face).map(|i| normal.dot(p - vertex(i))).fold(f64::INFINITY, f64::min)
                > 0.0
        });
        if !is_outside {
            return 0.0;
        }
        let mut least = f64::INFINITY;
        for face in 0..self.topology.face_count() {
            let mut around = self.topology.face_vertices(face);
            let Some(apex) = around.next() else { continue };
            for (b, c) in around.clone().zip(around.skip(1)) {
                least = least.min(merge::distance_to_triangle(p, [vertex(apex), vertex(b), vertex(c)]));
            }
        }
        least
    }
}

fn check_points(points: &[Vec3]) -> Result<(), HullError> {
    if points.len() < 4 {
        return Err(HullError::TooFewPoints { count: points.len() });
    }
    if points.len() > MAX_HULL_POINTS {
        return Err(HullError::TooManyPoints { count: points.len() });
    }
    for (index, point) in points.iter().enumerate() {
        if !point.is_finite() {
            return Err(HullError::NotFinite { index });
        }
        if point.as_dvec3().length() > f64::from(MAX_RADIUS) {
            return Err(HullError::TooLarge { index });
        }
    }
    Ok(())
}

/// Each place once, the earliest point that named it, in the order given.
fn unique(points: &[Vec3]) -> Vec<Vec3> {
    // `+ 0.0` makes -0 and +0 one: they are one point.
    let place = |i: u32| points[i as usize].to_array().map(|c| (c + 0.0).to_bits());
    let mut by_place: Vec<u32> = (0..points.len() as u32).collect();
    by_place.sort_by_key(|&i| (place(i), i));
    by_place.dedup_by_key(|i| place(*i));
    by_place.sort_unstable();
    by_place.into_iter().map(|i| points[i as usize]).collect()
}

/// Centre of volume in f64, by tetrahedra from the first vertex.
fn volume_center(vertices: &[Vec3], loops: &[Vec<u16>]) -> DVec3 {
    let origin = vertices[0].as_dvec3();
    let at = |i: u16| vertices[i as usize].as_dvec3() - origin;
    let (mut volume, mut moment) = (0.0, DVec3::ZERO);
    for face in loops {
        for two in face[1..].windows(2) {
            let (a, b, c) = (at(face[0]), at(two[0]), at(two[1]));
            let six_fold = a.cross(b).dot(c);
            volume += six_fold;
            moment += (a + b + c) * six_fold;
        }
    }
    // A sliver's volume may vanish in f64, and rounding may push the quotient out: any inner point will do then.
    let center = origin + moment / (4.0 * volume);
    let (low, high) = vertices.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), v| {
        (low.min(v.as_dvec3()), high.max(v.as_dvec3()))
    });
    if volume > 0.0 && center.cmpge(low).all() && center.cmple(high).all() {
        center
    } else {
        (low + high) * 0.5
    }
}

#[cfg(test)]
mod tests;
