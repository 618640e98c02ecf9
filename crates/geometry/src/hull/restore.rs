//! Restores a hull from what is stored of it: vertices, face loops, and the error that simplification left.
//!
//! Rebuilding a hull from its own vertices might merge other facets, because what is one flat face also depends on
//! points that are not vertices. So the loops are stored. They are not trusted, but checked: closed, Euler's formula,
//! convex up to what merging may cost. Everything else is computed again by the same code and in the same order of
//! vertices and faces, so the restored hull is equal in every bit.

use super::build::Made;
use super::check::Examiner;
use super::cloud::{Cloud, half_diagonal};
use super::predicate::is_collinear;
use super::quick::hull_facets;
use super::{Hull, HullError, HullFault};
use crate::tolerance::{MAX_HULL_VERTICES, MAX_RADIUS, MERGED_PLANARITY};
use glam::Vec3;
use std::collections::BTreeSet;

/// Why stored data do not make a hull.
#[derive(Debug, PartialEq)]
pub(crate) enum StoredHullError {
    Points(HullError),
    Faces(HullFault),
    /// Two vertices are the same point.
    Repeated,
    /// A face has too few corners, the same one twice, or one that is no vertex.
    BadLoop {
        face: usize,
    },
    /// The faces do not form a closed surface.
    Open,
    /// A vertex lies `beyond` metres beyond a face, further than merging could have left it.
    NotConvex {
        beyond: f32,
    },
    /// The error is negative, not finite, or larger than any hull.
    BadError {
        value: f32,
    },
    /// Vertices or faces differ from those of such a hull, or are in another order.
    OutOfOrder,
}

impl core::fmt::Display for StoredHullError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "stored hull: ")?;
        match self {
            Self::Points(error) => error.fmt(f),
            Self::Faces(fault) => fault.fmt(f),
            Self::Repeated => write!(f, "two vertices are the same point"),
            Self::BadLoop { face } => write!(f, "face {face} is no loop of three or more vertices"),
            Self::Open => write!(f, "the faces close no surface around the vertices"),
            Self::NotConvex { beyond } => write!(f, "a vertex lies {beyond} m beyond a face"),
            Self::BadError { value } => write!(f, "{value} m is no error of a hull"),
            Self::OutOfOrder => write!(f, "vertices or faces are not as such a hull has them"),
        }
    }
}

impl From<HullError> for StoredHullError {
    fn from(error: HullError) -> Self {
        Self::Points(error)
    }
}

impl From<HullFault> for StoredHullError {
    fn from(fault: HullFault) -> Self {
        Self::Faces(fault)
    }
}

impl Hull {
    /// The vertices around each face.
    pub(crate) fn loops(&self) -> Vec<Vec<u16>> {
        let topology = self.topology();
        let around = |face| topology.face_vertices(face).map(|vertex| vertex as u16).collect();
        (0..topology.face_count()).map(around).collect()
    }

    /// The hull, without rounding, of which these were stored.
    pub(crate) fn restored(
        vertices: &[Vec3],
        faces: Vec<Vec<u16>>,
        error: f32,
    ) -> Result<Self, StoredHullError> {
        let cloud = Cloud::new(vertices, 1)?;
        if cloud.points.len() != vertices.len() {
            return Err(StoredHullError::Repeated);
        }
        if vertices.len() > MAX_HULL_VERTICES {
            return Err(HullError::TooManyVertices { at_least: vertices.len() }.into());
        }
        if !(0.0..=2.0 * MAX_RADIUS).contains(&error) {
            return Err(StoredHullError::BadError { value: error });
        }
        // Two faces, back to back: a flat hull, or one whose volume is mere rounding.
        let low = if faces.len() > 2 { None } else { Some(Self::of_any_dimension(vertices)?) };
        let hull = match low {
            Some(low) if low.dimension() < 2 => low,
            Some(low) if low.dimension() == 2 => Self::restored_flat(&cloud)?,
            _ => Self::restored_solid(cloud, vertices, &faces, error)?,
        };
        let bits = |vertex: &Vec3| vertex.to_array().map(f32::to_bits);
        let has_vertices = hull.vertices().iter().map(bits).eq(vertices.iter().map(bits));
        if has_vertices && hull.loops() == faces && hull.error().to_bits() == error.to_bits() {
            Ok(hull)
        } else {
            Err(StoredHullError::OutOfOrder)
        }
    }

    /// A flat hull is exact. Only its orientation is open, which its first corners show.
    fn restored_flat(cloud: &Cloud) -> Result<Self, StoredHullError> {
        let place =
            |vertex: u32| cloud.source.iter().position(|&source| source == vertex).unwrap_or(0) as u32;
        let corners = [0, 1, 2].map(place);
        if is_collinear(&cloud.points, corners) {
            return Err(StoredHullError::OutOfOrder);
        }
        let all: Vec<u32> = (0..cloud.points.len() as u32).collect();
        Ok(Self::flat_around(cloud, &all, corners)?)
    }

    fn restored_solid(
        cloud: Cloud,
        vertices: &[Vec3],
        faces: &[Vec<u16>],
        error: f32,
    ) -> Result<Self, StoredHullError> {
        check_surface(vertices.len(), faces)?;
        let mut place = vec![0_u32; vertices.len()];
        for (number, &source) in (0..).zip(&cloud.source) {
            place[source as usize] = number;
        }
        let placed = |face: &Vec<u16>| face.clone().into_iter().map(|vertex| place[usize::from(vertex)]);
        let (faces, facets) = (faces.iter().map(placed).collect(), hull_facets(&cloud.points)?);
        let made = Made { faces, facets, normals: None };
        let hull = Self::of_faces(cloud.points, made, &cloud.source, |_| error)?;
        let examiner = Examiner::of(&hull, vertices);
        examiner.normals()?;
        examiner.spheres()?;
        let beyond = hull.planarity_error();
        if f64::from(beyond) > MERGED_PLANARITY * half_diagonal(vertices) {
            return Err(StoredHullError::NotConvex { beyond });
        }
        Ok(hull)
    }
}

/// Whether loops of vertices form a closed surface like a sphere: each edge is used once in each direction.
fn check_surface(vertices: usize, faces: &[Vec<u16>]) -> Result<(), StoredHullError> {
    let mut sides = BTreeSet::new();
    let mut is_visited = vec![false; vertices];
    for (face, corners) in faces.iter().enumerate() {
        let bad = StoredHullError::BadLoop { face };
        if corners.len() < 3 {
            return Err(bad);
        }
        let different: BTreeSet<&u16> = corners.iter().collect();
        if different.len() != corners.len() {
            return Err(bad);
        }
        for (i, &from) in corners.iter().enumerate() {
            let Some(is_visited) = is_visited.get_mut(usize::from(from)) else { return Err(bad) };
            *is_visited = true;
            if !sides.insert((from, corners[(i + 1) % corners.len()])) {
                return Err(StoredHullError::Open);
            }
        }
    }
    let is_closed = sides.iter().all(|&(from, to)| sides.contains(&(to, from)));
    let edges = sides.len() / 2;
    if is_closed && is_visited.iter().all(|&is| is) && vertices + faces.len() == edges + 2 {
        Ok(())
    } else {
        Err(StoredHullError::Open)
    }
}
