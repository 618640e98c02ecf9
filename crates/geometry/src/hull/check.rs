//! Verifies a hull from its vertices and face loops alone.

use super::Hull;
use super::build::in_triangles;
use super::cloud::{half_diagonal, rank};
use super::distance::Surface;
use super::normal::{area_vector, is_noise};
use super::quick::hull_facets;
use crate::tolerance::COPLANAR;
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::collections::BTreeSet;

/// A fault in a hull, as found by [`Hull::check`].
///
/// ```
/// use asunder::{Hull, HullFault, glam::Vec3};
/// let mut points = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
/// let hull = Hull::from_points(&points)?;
/// assert_eq!(hull.check(&points), Ok(()));
/// points[1] = Vec3::NEG_X;
/// assert_eq!(hull.check(&points), Err(HullFault::ForeignVertex { vertex: 1 }));
/// # Ok::<(), asunder::HullError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum HullFault {
    /// A half-edge has no opposite twin in another face.
    Open {
        /// The half-edge.
        half_edge: usize,
    },
    /// Vertices - edges + faces is not 2, or a vertex is on no face.
    Euler {
        /// Number of vertices.
        vertices: usize,
        /// Number of edges.
        edges: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A face has fewer than three corners, or the same one twice.
    BadLoop {
        /// The face.
        face: usize,
    },
    /// A normal is not of unit length, does not match its loop, or is missing.
    BadNormal {
        /// The face.
        face: usize,
    },
    /// A vertex lies further beyond a face than the hull's planarity error.
    NotConvex {
        /// The face.
        face: usize,
        /// How far the furthest vertex lies beyond the lowest one of the face, in metres.
        beyond: f64,
    },
    /// The bounding sphere does not contain the hull, or the hull does not contain the inscribed sphere.
    BadRadius,
    /// A vertex is none of the points.
    ForeignVertex {
        /// The vertex.
        vertex: usize,
    },
    /// A point lies further outside than the hull's error.
    PointOutside {
        /// Index of the point.
        index: usize,
        /// How far, in metres.
        distance: f64,
    },
    /// Two neighbouring faces should have been merged into one flat face.
    NotMerged {
        /// The one with the lower index.
        first: usize,
        /// The other.
        second: usize,
    },
}

impl core::fmt::Display for HullFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Open { half_edge } => write!(f, "half-edge {half_edge} has no twin"),
            Self::Euler { vertices, edges, faces } => {
                write!(f, "{vertices} vertices, {edges} edges and {faces} faces close no surface")
            }
            Self::BadLoop { face } => write!(f, "face {face} is no simple loop"),
            Self::BadNormal { face } => write!(f, "face {face} has a wrong normal"),
            Self::NotConvex { face, beyond } => write!(f, "a vertex lies {beyond} m beyond face {face}"),
            Self::BadRadius => write!(f, "the inscribed or bounding sphere is wrong"),
            Self::ForeignVertex { vertex } => write!(f, "vertex {vertex} is none of the points"),
            Self::PointOutside { index, distance } => write!(f, "point {index} lies {distance} m outside"),
            Self::NotMerged { first, second } => write!(f, "faces {first} and {second} lie in one plane"),
        }
    }
}

impl core::error::Error for HullFault {}

impl Hull {
    /// Checks the hull, without its rounding, against the points it was made from: it is closed and satisfies Euler's
    /// formula, loops are simple, normals are outward and of unit length, it is convex within
    /// [`Hull::planarity_error`], the spheres are right, vertices are given points bit for bit, every point is within
    /// [`Hull::error`], and no neighbouring faces should have been merged.
    ///
    /// This is for tests, and for callers in doubt; everything is computed anew from vertices and loops.
    ///
    /// - A hull that was built from points passes, except for about six in a million of those whose points are thinner
    ///   than f64 resolves.
    /// - A hull that was stored and restored passes exactly if the original did.
    /// - A hull that was stored by other code may fail: restoring accepts any loops that close a convex surface. A flat
    ///   face may then be several coplanar faces, which is [`HullFault::NotMerged`] here and harmless elsewhere.
    ///
    /// Cost: the number of points times that of face corners.
    ///
    /// # Errors
    /// The first fault found, in the order above. Points other than those the hull was made from lead to faults, too.
    pub fn check(&self, points: &[Vec3]) -> Result<(), HullFault> {
        let examiner = Examiner::of(self, points);
        examiner.closed()?;
        examiner.loops()?;
        examiner.normals()?;
        examiner.convex()?;
        examiner.spheres()?;
        examiner.subset(points)?;
        examiner.containing(points)?;
        examiner.merged()
    }
}

pub(super) struct Examiner<'a> {
    hull: &'a Hull,
    topology: &'a Topology,
    vertices: Vec<DVec3>,
    /// The loops, each starting at its first corner in the order of a `Cloud`. The builder computes areas from there,
    /// and for a needle no wider than rounding the start may change the result.
    faces: Vec<Vec<usize>>,
    /// The rounding error of f64 on numbers of the hull's size, in metres.
    slack: f64,
    /// Half the diagonal of the box around the points, in metres.
    scale: f64,
}

impl<'a> Examiner<'a> {
    pub(super) fn of(hull: &'a Hull, points: &[Vec3]) -> Self {
        let topology = hull.topology();
        let vertices: Vec<DVec3> = hull.vertices().iter().map(|v| v.as_dvec3()).collect();
        let around = |face| {
            let mut corners: Vec<usize> = topology.face_vertices(face).collect();
            let least = (0..corners.len()).min_by_key(|&place| rank(hull.vertices()[corners[place]]));
            corners.rotate_left(least.unwrap_or(0));
            corners
        };
        let faces = (0..topology.face_count()).map(around).collect();
        // From the spread of the vertices, as the hull's radius is not verified yet.
        let slack = 1e-14 * half_diagonal(hull.vertices());
        Self { hull, topology, vertices, faces, slack, scale: half_diagonal(points) }
    }

    fn closed(&self) -> Result<(), HullFault> {
        let half_edges = self.topology.half_edges();
        let is_surface = self.hull.dimension() >= 2;
        for (index, half_edge) in half_edges.iter().enumerate() {
            let is_paired = half_edges.get(half_edge.twin as usize).is_some_and(|twin| {
                let (from, to) = self.topology.ends(index);
                let goes_back = self.topology.ends(half_edge.twin as usize) == (to, from);
                twin.twin as usize == index && goes_back && (!is_surface || twin.face != half_edge.face)
            });
            if !is_paired {
                return Err(HullFault::Open { half_edge: index });
            }
        }
        let visited: BTreeSet<usize> = self.faces.iter().flatten().copied().collect();
        let (vertices, edges, faces) = (self.vertices.len(), self.topology.edges().len(), self.faces.len());
        let halves = if self.hull.dimension() == 0 { 1 } else { 2 * edges };
        if vertices + faces != edges + 2 || visited.len() != vertices || half_edges.len() != halves {
            return Err(HullFault::Euler { vertices, edges, faces });
        }
        Ok(())
    }

    fn loops(&self) -> Result<(), HullFault> {
        let (least, most_faces) = match self.hull.dimension() {
            0 => (1, 1),
            1 => (2, 1),
            2 => (3, 2),
            _ => (3, usize::MAX),
        };
        for (face, corners) in self.faces.iter().enumerate() {
            let different: BTreeSet<usize> = corners.iter().copied().collect();
            if corners.len() < least || different.len() != corners.len() || face >= most_faces {
                return Err(HullFault::BadLoop { face });
            }
        }
        Ok(())
    }

    /// Normals are of unit length, and along the area vector of their loop: together with convexity, that means
    /// outwards.
    pub(super) fn normals(&self) -> Result<(), HullFault> {
        let normals = self.hull.normals();
        let expected = if self.hull.dimension() >= 2 { self.faces.len() } else { 0 };
        if normals.len() != expected {
            return Err(HullFault::BadNormal { face: normals.len().min(expected) });
        }
        for (face, normal) in normals.iter().enumerate() {
            let area = self.area(face);
            let is_unit = (normal.length() - 1.0).abs() < 1e-14;
            // An area that is mere rounding has no direction to compare with; convexity still constrains the normal.
            let is_along = normal.dot(area) >= (1.0 - 1e-6) * area.length() || self.is_noise(face);
            if !is_unit || !is_along {
                return Err(HullFault::BadNormal { face });
            }
        }
        Ok(())
    }

    fn area(&self, face: usize) -> DVec3 {
        area_vector(self.faces[face].len(), |i| self.hull.vertices()[self.faces[face][i]])
    }

    fn is_noise(&self, face: usize) -> bool {
        is_noise(self.faces[face].len(), |i| self.hull.vertices()[self.faces[face][i]])
    }

    /// Height of a place above the first corner of a face.
    fn height(&self, face: usize, place: DVec3) -> f64 {
        self.hull.normals()[face].dot(place - self.vertices[self.faces[face][0]])
    }

    fn convex(&self) -> Result<(), HullFault> {
        let allowed = f64::from(self.hull.planarity_error()) + self.slack;
        for face in 0..self.hull.normals().len() {
            let low = self.faces[face].iter().map(|&i| self.height(face, self.vertices[i]));
            let high = self.vertices.iter().map(|&v| self.height(face, v)).fold(f64::NEG_INFINITY, f64::max);
            let beyond = high - low.fold(f64::INFINITY, f64::min);
            if beyond > allowed {
                return Err(HullFault::NotConvex { face, beyond });
            }
        }
        Ok(())
    }

    pub(super) fn spheres(&self) -> Result<(), HullFault> {
        let (center, data) = (self.hull.center().as_dvec3(), &self.hull.data);
        let is_held = self.vertices.iter().all(|v| (*v - center).length() <= f64::from(data.outer_radius));
        let is_inside = |face: usize| self.height(face, center) <= -f64::from(data.inner_radius) + self.slack;
        let is_around = data.inner_radius <= 0.0 || (0..self.hull.normals().len()).all(is_inside);
        if is_held && is_around { Ok(()) } else { Err(HullFault::BadRadius) }
    }

    fn subset(&self, points: &[Vec3]) -> Result<(), HullFault> {
        let bits = |v: &Vec3| v.to_array().map(f32::to_bits);
        let known: BTreeSet<[u32; 3]> = points.iter().map(bits).collect();
        match self.hull.vertices().iter().position(|vertex| !known.contains(&bits(vertex))) {
            Some(vertex) => Err(HullFault::ForeignVertex { vertex }),
            None => Ok(()),
        }
    }

    /// For a solid, uses exact facets computed anew, as faces are flat only up to rounding. They are computed in the
    /// order of a cloud, as in the builder: a facet without width can be triangulated in several ways, which give equal
    /// distances only up to rounding.
    fn containing(&self, points: &[Vec3]) -> Result<(), HullFault> {
        let allowed = f64::from(self.hull.error()) + self.slack;
        let own = self.hull.data.surface();
        let mut vertices = own.vertices.to_vec();
        vertices.sort_unstable_by_key(|&vertex| rank(vertex));
        let anew = hull_facets(&vertices).ok().filter(|_| own.dimension == 3);
        let facets = anew.map(|facets| in_triangles(&facets));
        let surface = match &facets {
            Some(facets) => Surface { dimension: 3, vertices: &vertices, facets },
            None => own,
        };
        let mut near = surface.near();
        for (index, point) in points.iter().enumerate() {
            let point = point.as_dvec3();
            if surface.dimension == 3 && !surface.is_outside(point) {
                continue;
            }
            let distance = near.distance(point, allowed);
            if distance > allowed {
                return Err(HullFault::PointOutside { index, distance });
            }
        }
        Ok(())
    }

    /// Two neighbouring faces should be one if the smaller lies within the tolerance of the larger one's plane and
    /// their union has one simple outline. Hulls no thicker than twice the tolerance are exempt, as merging could
    /// flatten them.
    fn merged(&self) -> Result<(), HullFault> {
        let depth =
            |face| self.vertices.iter().map(|&v| self.height(face, v)).fold(f64::INFINITY, f64::min).abs();
        let is_thin = |face| depth(face) <= 2.0 * COPLANAR * self.scale;
        if self.hull.dimension() < 3 || (0..self.faces.len()).any(is_thin) {
            return Ok(());
        }
        let areas: Vec<f64> = (0..self.faces.len()).map(|face| self.area(face).length()).collect();
        for &edge in self.topology.edges() {
            let half_edge = self.topology.half_edges()[edge as usize];
            let twin = self.topology.half_edges()[half_edge.twin as usize];
            let (first, second) = (half_edge.face as usize, twin.face as usize);
            for (large, small) in [(first, second), (second, first)] {
                // Nearly equal areas may have been ranked either way, so only clearly different ones are checked.
                if areas[large] * 0.999 > areas[small] && self.are_one(large, small) {
                    return Err(HullFault::NotMerged { first: first.min(second), second: first.max(second) });
                }
            }
        }
        Ok(())
    }

    fn are_one(&self, large: usize, small: usize) -> bool {
        let tolerance = 0.99 * 0.5 * COPLANAR * self.scale;
        let span = |corners: &[usize]| {
            corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &i| {
                let height = self.height(large, self.vertices[i]);
                (low.min(height), high.max(height))
            })
        };
        let (low, high) = span(&self.faces[large]);
        let middle = (low + high) * 0.5;
        let (least, most) = span(&self.faces[small]);
        let faces_along = self.hull.normals()[small].dot(self.hull.normals()[large]) > 0.5 + 1e-6;
        faces_along
            && !self.is_noise(small)
            && most - middle <= tolerance
            && middle - least <= tolerance
            && self.have_one_outline(large, small)
    }

    fn have_one_outline(&self, large: usize, small: usize) -> bool {
        let (one, other) = (&self.faces[large], &self.faces[small]);
        let shared_corners = one.iter().filter(|corner| other.contains(corner)).count();
        let shared_edges = self
            .topology
            .face_half_edges(large)
            .filter(|&h| {
                self.topology.half_edges()[self.topology.half_edges()[h].twin as usize].face as usize == small
            })
            .count();
        shared_corners == shared_edges + 1 && one.len() + other.len() >= 2 * shared_edges + 3
    }
}
