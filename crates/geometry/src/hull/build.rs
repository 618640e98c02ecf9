//! Builds a hull with a volume from a cloud.
//!
//! ```text
//! cloud -> exact hull, or as much of it as the vertex limit allows (quick) -> its vertices
//!    vertices -> exact facets -> flat faces (merge) -> topology, normals, radii
//!                     ^                |
//!                     +----------------+ again without vertices that ended up inside a flat face
//! ```
//! After the first round only vertices of the first hull take part. Points inside that hull stay near the result, as
//! the distance from a convex set is a convex function, and so is greatest at a vertex. The same argument gives
//! [`Hull::error`].

use super::cloud::{Cloud, half_diagonal};
use super::distance::Surface;
use super::loops::Loops;
use super::merge::{Merged, merge_facets};
use super::normal::{areas_and_normals, neighbours};
use super::quick::{Growth, Measure, hull_facets};
use super::{Hull, HullData, HullError};
use crate::octets::Octets;
use crate::outward::{round_down, round_up};
use crate::tolerance::{COPLANAR, MAX_HULL_VERTICES, MERGED_PLANARITY, MIN_RADIUS, STANDS_OUT};
use crate::topology::Topology;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// With more points that stand out, a hull has too many vertices however its facets merge.
const CLEARLY_TOO_MANY: usize = 4 * MAX_HULL_VERTICES;

/// How often the vertices that merging has freed are spent on further points.
const SPENDINGS: usize = 4;

/// Share of a cloud's size below which its first tetrahedron counts as flat, so that heights say little about
/// distances.
const FLAT: f64 = 0.05;

/// Counts the points that stood out of the growing hull when they were added.
struct Census {
    standing_out: usize,
    threshold: f64,
}

impl Census {
    fn of(cloud: &Cloud) -> Self {
        Self { standing_out: 4, threshold: STANDS_OUT * cloud.scale }
    }

    /// Counts the next point; returns false once there are clearly too many.
    fn admits(&mut self, distance: f64) -> bool {
        self.standing_out += usize::from(distance > self.threshold);
        self.standing_out <= CLEARLY_TOO_MANY
    }
}

impl Hull {
    /// The convex hull of up to 65,535 points that span space. Cost: about n log n.
    ///
    /// A point that lies inside a face that is flat up to rounding is no vertex; [`Hull::error`] says how far
    /// outside the hull any such point may lie.
    ///
    /// # Errors
    /// Points that are too few, too many, not finite, out of range, or all in one plane; more than 256 vertices.
    pub fn from_points(points: &[Vec3]) -> Result<Self, HullError> {
        Self::solid(&Cloud::new(points, 4)?)
    }

    pub(super) fn solid(cloud: &Cloud) -> Result<Self, HullError> {
        Self::whole(cloud, Growth::start(&cloud.points, Measure::Height)?, Census::of(cloud))
    }

    /// Completes a growing hull to the exact one.
    fn whole(cloud: &Cloud, mut growth: Growth<'_>, mut census: Census) -> Result<Self, HullError> {
        if !growth.grow_while(|_, distance| census.admits(distance)) {
            return Err(HullError::TooManyVertices { at_least: census.standing_out });
        }
        Self::polished(cloud, growth.facets(), 0.0)
    }

    /// The exact hull if it has no more vertices than allowed, or else that of as many points, chosen furthest first.
    pub(super) fn limited(cloud: &Cloud, max_vertices: usize) -> Result<Self, HullError> {
        let (mut growth, mut census) = (Growth::start(&cloud.points, Measure::Height)?, Census::of(cloud));
        growth.grow_while(|count, distance| count < max_vertices && census.admits(distance));
        match Self::whole(cloud, growth.clone(), census) {
            Ok(hull) if hull.vertices().len() <= max_vertices => return Ok(hull),
            Ok(_) | Err(HullError::TooManyVertices { .. }) => {}
            Err(error) => return Err(error),
        }
        if growth.first_height() < FLAT * cloud.scale {
            growth = Growth::start(&cloud.points, Measure::Distance)?;
            growth.grow_while(|count, _| count < max_vertices);
        }
        Self::spent(cloud, growth, max_vertices)
    }

    /// A hull grown as far as the vertex limit allows. Vertices that merging frees are spent on further points.
    fn spent(cloud: &Cloud, mut growth: Growth<'_>, max_vertices: usize) -> Result<Self, HullError> {
        let mut best = Self::polished(cloud, growth.facets(), growth.outlying())?;
        let mut budget = max_vertices;
        for _ in 0..SPENDINGS {
            let spare = max_vertices.saturating_sub(best.vertices().len());
            budget += spare;
            if spare == 0 || growth.grow_while(|count, _| count < budget) {
                break;
            }
            match Self::polished(cloud, growth.facets(), growth.outlying()) {
                Ok(hull) if hull.vertices().len() <= max_vertices && hull.error() < best.error() => {
                    best = hull
                }
                _ => break,
            }
        }
        Ok(best)
    }

    /// Merges the facets of a hull of points of the cloud; no point lies further outside of it than `outlying` metres.
    fn polished(cloud: &Cloud, facets: Loops, outlying: f64) -> Result<Self, HullError> {
        let mut solid = Solid { cloud, kept: corners_of(&facets), dropped: Vec::new(), outlying };
        let mut facets = solid.numbered_by_kept(facets);
        loop {
            let points: Vec<Vec3> = solid.kept.iter().map(|&i| cloud.points[i as usize]).collect();
            let Merged { faces, inside, normals } =
                merge_facets(&points, &facets, COPLANAR * 0.5 * cloud.scale);
            if inside.is_empty() {
                let are_facets = normals.is_some();
                let hull = solid.finish(Made { faces, facets: facets.clone(), normals })?;
                let is_flat = f64::from(hull.planarity_error()) <= MERGED_PLANARITY * half_diagonal(&points);
                // If the hull is thinner than rounding, merged faces may be nowhere near flat.
                return if are_facets || is_flat { Ok(hull) } else { solid.finish(Made::of(facets)) };
            }
            let (count, turned_out) = (points.len(), inside.len());
            // A count that shrinks slowly from far too many would not end up small enough, and would take long.
            if count > 2 * MAX_HULL_VERTICES && 4 * turned_out < count {
                return Err(HullError::TooManyVertices { at_least: count - turned_out });
            }
            let is_inside = |place: usize| inside.binary_search(&(place as u32)).is_ok();
            let rest: Vec<Vec3> = (0..count).filter(|&i| !is_inside(i)).map(|i| points[i]).collect();
            match hull_facets(&rest) {
                Ok(fewer) => facets = fewer,
                Err(_) => return solid.unmerged(rest.len()),
            }
            let mut place = 0..;
            solid.kept.retain(|&i| {
                let goes = place.next().is_some_and(is_inside);
                if goes {
                    solid.dropped.push(i);
                }
                !goes
            });
        }
    }
}

fn corners_of(facets: &Loops) -> Vec<u32> {
    let mut corners = facets.corners().to_vec();
    corners.sort_unstable();
    corners.dedup();
    corners
}

/// A hull in the making: indices into the cloud of points that are still vertices, and of those that were.
struct Solid<'a> {
    cloud: &'a Cloud,
    kept: Vec<u32>,
    dropped: Vec<u32>,
    outlying: f64,
}

impl Solid<'_> {
    fn numbered_by_kept(&self, facets: Loops) -> Loops {
        facets.renumbered(|corner| self.kept.binary_search(&corner).unwrap_or(0) as u32)
    }

    /// For a hull that merging would flatten altogether, as its volume is mere rounding: the exact facets of its
    /// furthest points, a few more than merging would have left.
    fn unmerged(mut self, left: usize) -> Result<Hull, HullError> {
        let points: Vec<Vec3> = self.kept.iter().map(|&i| self.cloud.points[i as usize]).collect();
        let mut growth = Growth::start(&points, Measure::Distance)?;
        growth.grow_while(|count, _| count < (left + 2).clamp(4, MAX_HULL_VERTICES));
        let facets = growth.facets();
        let corners = corners_of(&facets);
        let was_kept = core::mem::take(&mut self.kept);
        let (mut place, dropped) = (0.., &mut self.dropped);
        self.kept = was_kept
            .into_iter()
            .filter(|&i| {
                let stays = place.next().is_some_and(|place| corners.binary_search(&place).is_ok());
                if !stays {
                    dropped.push(i);
                }
                stays
            })
            .collect();
        let facets = facets.renumbered(|i| corners.binary_search(&i).unwrap_or(0) as u32);
        self.finish(Made::of(facets))
    }

    /// Derives everything else from the loops, whose numbers are places in `kept`.
    fn finish(&self, made: Made) -> Result<Hull, HullError> {
        let at = |i: &u32| self.cloud.points[*i as usize];
        let source: Vec<u32> = self.kept.iter().map(|&i| self.cloud.source[i as usize]).collect();
        Hull::of_faces(self.kept.iter().map(at).collect(), made, &source, |surface| {
            let error =
                self.outlying + surface.furthest_outside(self.dropped.iter().map(|i| at(i).as_dvec3()));
            if error > 0.0 { round_up(error + 64.0 * f64::EPSILON * self.cloud.scale) } else { 0.0 }
        })
    }
}

/// Faces, and the exact facets that they were merged from.
pub(super) struct Made {
    pub(super) faces: Loops,
    pub(super) facets: Loops,
    /// Normals of the faces, if these are the facets in canonical order.
    pub(super) normals: Option<Vec<DVec3>>,
}

impl Made {
    /// Uses the facets as faces.
    fn of(facets: Loops) -> Self {
        Self { faces: facets.clone(), facets, normals: None }
    }
}

impl Hull {
    /// A hull from vertices in the order of a cloud, and the place of each in the user's list. All numbers are computed
    /// before the vertices are put into the user's order: so they depend only on positions and faces, and a stored hull
    /// gets the same ones when it is restored.
    pub(super) fn of_faces(
        vertices: Vec<Vec3>,
        Made { faces, facets, normals }: Made,
        source: &[u32],
        error: impl FnOnce(Surface<'_>) -> f32,
    ) -> Result<Self, HullError> {
        let count = vertices.len();
        if count > MAX_HULL_VERTICES {
            return Err(HullError::TooManyVertices { at_least: count });
        }
        let (faces, facets) = (faces.canonical(), facets.canonical());
        let normals = normals.unwrap_or_else(|| areas_and_normals(&vertices, &faces, &neighbours(&faces)).1);
        let mut hull = measured(&vertices, &faces, &normals)?;
        let triangles = in_triangles(&facets);
        let surface = Surface { dimension: 3, vertices: &vertices, facets: &triangles };
        hull.error = error(surface);
        hull.inner_radius = surface.inner_radius(hull.center, hull.inner_radius);
        let mut in_order: Vec<usize> = (0..count).collect();
        in_order.sort_unstable_by_key(|&place| source[place]);
        // Puts vertices into the user's order, and faces into the order of their renumbered loops.
        let mut number = vec![0_u32; count];
        for (new, &place) in (0..).zip(&in_order) {
            number[place] = new;
        }
        let (faces, normals) = faces.renumbered(|i| number[i as usize]).in_order(&normals);
        hull.topology = Topology::from_loops(faces.iter());
        hull.normals = normals.into();
        hull.vertices = in_order.iter().map(|&place| vertices[place]).collect();
        hull.facets = in_triangles(&facets.renumbered(|i| number[i as usize]).canonical());
        Ok(Self { data: Arc::new(hull.finished()), radius: 0.0 })
    }
}

/// Triangulates loops of no more than 256 vertices.
pub(super) fn in_triangles(loops: &Loops) -> Box<[[u8; 3]]> {
    loops.fans().map(|corners| corners.map(|i| i as u8)).collect()
}

/// Computes centre, radii and planarity error; leaves the rest empty.
fn measured(vertices: &[Vec3], faces: &Loops, normals: &[DVec3]) -> Result<HullData, HullError> {
    let center = volume_center(vertices, faces).as_vec3();
    let from_center: Vec<DVec3> = vertices.iter().map(|v| v.as_dvec3() - center.as_dvec3()).collect();
    let outer = from_center.iter().map(|arm| arm.length()).fold(0.0, f64::max);
    let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
    if outer_radius < MIN_RADIUS {
        return Err(HullError::TooSmall { radius: outer_radius });
    }
    let (mut inner, mut planarity) = (f64::INFINITY, 0.0_f64);
    for (normal, face) in normals.iter().zip(faces.iter()) {
        let low = face.iter().map(|&i| normal.dot(from_center[i as usize])).fold(f64::INFINITY, f64::min);
        let high = from_center.iter().map(|&arm| normal.dot(arm)).fold(f64::NEG_INFINITY, f64::max);
        (inner, planarity) = (inner.min(low), planarity.max(high - low));
    }
    // The inscribed sphere must be valid for the true shape, which lies within the planarity error of its faces.
    let inner_radius = round_down((inner - planarity - 8.0 * f64::EPSILON * outer).max(0.0));
    Ok(HullData {
        dimension: 3,
        vertices: Box::new([]),
        topology: Topology::point().clone(),
        normals: Box::new([]),
        facets: Box::new([]),
        octets: Octets::default(),
        center,
        outer_radius,
        inner_radius,
        planarity_error: round_up(planarity),
        error: 0.0,
    })
}

/// Centre of volume in f64, by tetrahedra from the first vertex.
fn volume_center(vertices: &[Vec3], faces: &Loops) -> DVec3 {
    let origin = vertices[0].as_dvec3();
    let (mut volume, mut moment) = (0.0, DVec3::ZERO);
    for corners in faces.fans() {
        let [a, b, c] = corners.map(|i| vertices[i as usize].as_dvec3() - origin);
        let six_fold = a.cross(b).dot(c);
        volume += six_fold;
        moment += (a + b + c) * six_fold;
    }
    // A sliver's volume may vanish in f64, or rounding may push the quotient outside: then any inner point will do.
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
