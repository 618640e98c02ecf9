//! Hulls without volume: flat hulls, segments and points.

use super::cloud::Cloud;
use super::normal::{area_vector, unit};
use super::predicate::{is_collinear, planar_hull};
use super::{Hull, HullData, HullError};
use crate::octets::Octets;
use crate::outward::round_up;
use crate::tolerance::{MAX_HULL_VERTICES, MIN_RADIUS};
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::sync::Arc;

impl Hull {
    /// The hull of 1 to 65,535 points of any dimension: like [`Hull::from_points`], but points that are exactly
    /// coplanar, collinear or equal give a flat hull, a segment or a point. Cost: about n log n.
    ///
    /// A flat hull has its vertices in order around and two faces back to back; a segment and a point have no normals.
    /// [`Hull::dimension`] says which it is. Points that are off a plane by rounding have a volume.
    ///
    /// ```
    /// use asunder::{Hull, glam::{DVec3, Vec3}};
    /// let square = [(0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 1.0, 1.0)].map(Vec3::from);
    /// let flat = Hull::of_any_dimension(&square)?;
    /// assert_eq!((flat.dimension(), flat.topology().face_count()), (2, 2));
    /// assert_eq!(flat.normals()[1], -flat.normals()[0]);
    /// assert!(flat.contains(DVec3::new(0.5, 0.5, 1.0)) && !flat.contains(DVec3::new(0.5, 0.5, 1.0 + 1e-15)));
    /// assert_eq!(Hull::of_any_dimension(&square[..2])?.dimension(), 1);
    /// assert_eq!(Hull::of_any_dimension(&square[..1])?.dimension(), 0);
    /// # Ok::<(), asunder::HullError>(())
    /// ```
    ///
    /// # Errors
    /// No points, or too many, not finite or out of range; more than 256 vertices; a bounding radius below 1e-6 m,
    /// unless all points are at one place.
    pub fn of_any_dimension(points: &[Vec3]) -> Result<Self, HullError> {
        let cloud = Cloud::new(points, 1)?;
        match Self::solid(&cloud) {
            Err(HullError::Flat { dimension: 2 }) => Self::flat(&cloud),
            // The points are sorted, so those on a line are sorted along it.
            Err(HullError::Flat { .. }) => Self::thread(&cloud),
            solid => solid,
        }
    }

    /// The flat hull of a coplanar cloud, with the orientation of its first three corners as they are sorted: not that
    /// of inner points, so that the hull of its corners alone is the same.
    fn flat(cloud: &Cloud) -> Result<Self, HullError> {
        let count = cloud.points.len() as u32;
        let Some(third) = (2..count).find(|&i| !is_collinear(&cloud.points, [0, 1, i])) else {
            return Err(HullError::Flat { dimension: 1 });
        };
        let all: Vec<u32> = (0..count).collect();
        let mut corners = planar_hull(&cloud.points, &all, [0, 1, third]);
        corners.sort_unstable();
        Self::flat_around(cloud, &corners, [corners[0], corners[1], corners[2]])
    }

    /// The flat hull of some points of a coplanar cloud, with the orientation of a triangle of them.
    pub(super) fn flat_around(cloud: &Cloud, some: &[u32], triangle: [u32; 3]) -> Result<Self, HullError> {
        let around = planar_hull(&cloud.points, some, triangle);
        if around.len() > MAX_HULL_VERTICES {
            return Err(HullError::TooManyVertices { at_least: around.len() });
        }
        let vertices: Vec<Vec3> = around.iter().map(|&i| cloud.points[i as usize]).collect();
        let ascending: Vec<u16> = (0..vertices.len() as u16).collect();
        let descending: Vec<u16> = ascending.iter().rev().copied().collect();
        let topology = Topology::from_loops([ascending, descending].iter().map(Vec::as_slice));
        let normal = unit(area_vector(vertices.len(), |i| vertices[i]));
        let height = |v: &Vec3| normal.dot(v.as_dvec3() - vertices[0].as_dvec3());
        let (low, high) =
            vertices.iter().fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(height(v)), h.max(height(v))));
        let center = area_center(&vertices).as_vec3();
        let mut hull = Self::low(2, vertices, topology, center)?;
        hull.normals = Box::new([normal, -normal]);
        hull.planarity_error = round_up(high - low);
        // Rotated last, so that no computed number depends on the order of the user's points.
        let first = (0..around.len()).min_by_key(|&place| cloud.source[around[place] as usize]).unwrap_or(0);
        hull.vertices.rotate_left(first);
        Ok(Self { data: Arc::new(hull.finished()), radius: 0.0 })
    }

    /// The hull of collinear or equal points.
    fn thread(cloud: &Cloud) -> Result<Self, HullError> {
        let (first, last) = (0, cloud.points.len() - 1);
        let hull = if first == last {
            Self::low(0, vec![cloud.points[0]], Topology::point().clone(), cloud.points[0])?
        } else {
            let mut ends = [first, last];
            ends.sort_unstable_by_key(|&i| cloud.source[i]);
            let [from, to] = ends.map(|i| cloud.points[i]);
            let center = ((from.as_dvec3() + to.as_dvec3()) * 0.5).as_vec3();
            Self::low(1, vec![from, to], Topology::segment().clone(), center)?
        };
        Ok(Self { data: Arc::new(hull.finished()), radius: 0.0 })
    }

    fn low(
        dimension: u8,
        vertices: Vec<Vec3>,
        topology: Topology,
        center: Vec3,
    ) -> Result<HullData, HullError> {
        let outer = vertices.iter().map(|v| (v.as_dvec3() - center.as_dvec3()).length()).fold(0.0, f64::max);
        let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
        if dimension > 0 && outer_radius < MIN_RADIUS {
            return Err(HullError::TooSmall { radius: outer_radius });
        }
        // A fan from the first vertex; a triangle without area for one or two vertices.
        let last = vertices.len() - 1;
        let facets = (0..last.saturating_sub(1).max(1))
            .map(|i| [0, (i + 1).min(last), (i + 2).min(last)].map(|i| i as u8))
            .collect();
        let mut hull = HullData {
            dimension,
            vertices: vertices.into(),
            topology,
            normals: Box::new([]),
            facets,
            octets: Octets::default(),
            center,
            outer_radius: outer_radius.max(MIN_RADIUS),
            inner_radius: 0.0,
            planarity_error: 0.0,
            error: 0.0,
        };
        hull.inner_radius = hull.surface().inner_radius(center, 0.0);
        Ok(hull)
    }
}

/// Centre of area of a convex loop, in f64, by triangles from its first corner.
fn area_center(vertices: &[Vec3]) -> DVec3 {
    let origin = vertices[0].as_dvec3();
    let whole = area_vector(vertices.len(), |i| vertices[i]);
    // Every triangle's area vector points along the whole one's.
    let axis = whole / whole.abs().max_element();
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    for two in vertices[1..].windows(2) {
        let (a, b) = (two[0].as_dvec3() - origin, two[1].as_dvec3() - origin);
        let part = a.cross(b).dot(axis);
        area += part;
        moment += (a + b) * part;
    }
    let center = origin + moment / (3.0 * area);
    let (low, high) = vertices.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), v| {
        (low.min(v.as_dvec3()), high.max(v.as_dvec3()))
    });
    // A sliver's area may vanish in f64: then any inner point will do.
    if area > 0.0 { center.clamp(low, high) } else { (low + high) * 0.5 }
}
