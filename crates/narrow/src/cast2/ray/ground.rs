//! Rays into chains: segment by segment, in the order in which their boxes are met.

use super::{Beam, Target};
use crate::counted::count_step;
use crate::impact2::RayHit2;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Chain, Pose2, Ray2, Run, Shape2};

/// Where the cosine between a hit's normal and the run's is more than this, the ray crosses the run; a ray along a
/// segment meets its end.
const CROSSED: f64 = 0.5;

pub(super) fn into_chain(
    chain: &Chain,
    (pose, ray): (&Pose2, &Ray2),
    beam: &Beam,
    limit: f64,
) -> Option<RayHit2> {
    let mut first: Option<RayHit2> = None;
    let bound = |bounds: &Aabb2| beam.reaches(bounds).map_or(f64::INFINITY, |metres| metres / beam.length);
    chain.visit_nearest(limit, bound, |segment| {
        let reach = first.map_or(limit, |first| first.distance);
        if let Some(hit) = crossed(chain, segment, (pose, ray), beam, reach)
            && first.is_none_or(|known| comes_before(&hit, &known))
        {
            first = Some(hit);
        }
        first.map_or(limit, |first| first.distance)
    });
    first
}

/// Of equals, a segment that the ray starts on comes first, then the lowest number.
fn comes_before(one: &RayHit2, other: &RayHit2) -> bool {
    let key = |hit: &RayHit2| (!hit.inside, hit.part);
    one.distance < other.distance || (one.distance == other.distance && key(one) < key(other))
}

fn crossed(
    chain: &Chain,
    segment: u32,
    (pose, ray): (&Pose2, &Ray2),
    beam: &Beam,
    reach: f64,
) -> Option<RayHit2> {
    count_step();
    let front = front(chain, &chain.run_of(segment)?)?;
    let along = front.dot(beam.unit);
    if chain.is_one_sided() && along >= 0.0 {
        return None;
    }
    let shape = Shape2::Segment(chain.segment(segment)?);
    let mut hit = Target { shape: &shape, pose, part: None, index: segment, ray }.answer(beam, reach)?;
    let straight = pose.rotation().turn(front).normalize();
    if !hit.inside && straight.dot(hit.normal.as_dvec2()).abs() > CROSSED {
        hit.normal = if along > 0.0 { -straight } else { straight }.as_vec2();
    }
    Some(hit)
}

/// The unit normal of a run's front, in the chain's axes.
fn front(chain: &Chain, run: &Run) -> Option<DVec2> {
    let [from, to] = run.vertices().map(|vertex| chain.vertices().get(vertex as usize));
    Some(-(to?.as_dvec2() - from?.as_dvec2()).try_normalize()?.perp())
}

impl Beam {
    /// A lower bound on where the ray enters a box in the same axes, in metres; `None` if it certainly misses.
    fn reaches(&self, bounds: &Aabb2) -> Option<f64> {
        let (min, max) = (bounds.min.as_dvec2() - self.origin, bounds.max.as_dvec2() - self.origin);
        let middle = (min + max) * 0.5;
        let half = (max - min) * 0.5 + self.rounding(super::sum(min) + super::sum(max));
        let side = self.unit.perp();
        if side.dot(middle).abs() > side.abs().dot(half) * (1.0 + 1e-12) {
            return None;
        }
        let (along, reach) = (self.unit.dot(middle), self.unit.abs().dot(half));
        if along < -reach * (1.0 + 1e-12) {
            return None;
        }
        // By its slabs: a closer bound than by its corners along the ray.
        let enters = |middle: f64, half: f64, unit: f64| {
            if unit == 0.0 { 0.0 } else { (middle * unit.signum() - half) / unit.abs() }
        };
        let entry = enters(middle.x, half.x, self.unit.x).max(enters(middle.y, half.y, self.unit.y));
        Some(entry.max(0.0) * (1.0 - 1e-12))
    }
}
