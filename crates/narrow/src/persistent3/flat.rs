//! The triangles around the contact points of a body, and how far ground bends there.

use super::grip::{Seam, UNKNOWN};
use crate::answer::Manifold3;
use crate::ground3::{OnGround, box_around, front_of, widened};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::SAME_NORMAL;
use asunder_geometry::{Ground, NearTriangle};
use core::ops::ControlFlow;

/// Most triangles that are read: bodies with more around their points are not kept for long.
const MOST: usize = 48;

/// Sine of the greatest angle to a manifold's normal at which triangles may still belong to that manifold: beyond, they
/// have one of their own.
const MOST_BETWEEN: f64 = 8.0 * SAME_NORMAL;

/// Triangles near some points, in the ground's axes.
pub(super) struct NearPoints<'a> {
    ground: Ground<'a>,
    triangles: ArrayVec<NearTriangle, MOST>,
    /// Whether there were more than are kept.
    is_cut: bool,
}

impl<'a> NearPoints<'a> {
    /// Around all points of some manifolds, within a drift of `reach` metres.
    pub(super) fn of(on: &OnGround<'a>, manifolds: &[Manifold3], reach: f32) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for manifold in manifolds {
            for point in &manifold.points {
                let [_, foot] = on.ends(manifold, point);
                let foot = on.basis.turn_back(foot);
                (low, high) = (low.min(foot), high.max(foot));
            }
        }
        let grow = DVec3::splat(2.0 * f64::from(reach));
        let bounds = box_around([low - grow, high + grow]);
        let mut near = Self { ground: on.ground, triangles: ArrayVec::new_const(), is_cut: false };
        let _ = on.ground.read_near(&bounds, |triangle| match near.triangles.try_push(*triangle) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => {
                near.is_cut = true;
                ControlFlow::Break(())
            }
        });
        near
    }

    /// Where a point on ground may come to a patch other than its own, which has this unit normal, within `reach`
    /// metres: the cost is the sine of the greatest angle to that normal. It is unknown where ground ends or folds
    /// back.
    pub(super) fn seam_around(&self, foot: DVec3, (normal, patch): (DVec3, u32), reach: f64) -> Seam {
        let unknown = Seam { free: 0.0, cost: UNKNOWN };
        // If the patch is seen from behind, so is the ground that continues it.
        let Some(own) = self.triangles.iter().find(|triangle| triangle.patch == patch) else {
            return unknown;
        };
        let front = if front_of(own.corners).dot(normal) < 0.0 { -normal } else { normal };
        let (mut seam, mut is_on) = (Seam::NONE, false);
        let mut add = |free: f64, cost: f64| {
            if cost > 0.0 {
                seam = Seam { free: seam.free.min(free), cost: seam.cost.max(cost) };
            }
        };
        for triangle in &self.triangles {
            let [a, b, c] = widened(triangle.corners);
            let cross = (b - a).cross(c - a);
            let area = cross.length();
            // The height above the plane, and the distance beside a side: the triangle is no nearer than both together.
            let beside = |from: DVec3, to: DVec3| {
                let side = to - from;
                side.cross(cross).dot(foot - from) / (side.length() * area)
            };
            let height = cross.dot(foot - a).abs() / area;
            let aside = beside(a, b).max(beside(b, c)).max(beside(c, a)).max(0.0);
            let away = (height * height + aside * aside).sqrt();
            // NaN is not beyond.
            if away > reach {
                continue;
            }
            is_on = true;
            if triangle.patch != patch {
                add(away, bend_of(cross, front).unwrap_or(UNKNOWN));
            }
            for (edge, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                let along = to - from;
                let aside = along.cross(foot - from).length() / along.length();
                if aside <= reach && self.ground.neighbor(triangle.number, edge).is_none() {
                    add(aside, UNKNOWN);
                }
            }
        }
        if is_on && !self.is_cut { seam } else { unknown }
    }

    /// How far ground may bend between the points of one manifold: the sine of the greatest angle to its unit normal,
    /// of triangles with a bend too low to give a normal of its own. Zero where ground is a plane to the last bit.
    pub(super) fn bend_between(&self, normal: DVec3) -> f64 {
        if self.is_cut {
            return MOST_BETWEEN;
        }
        let low = self.triangles.iter().filter(|triangle| triangle.prominent.bends_low());
        let bends = low.filter_map(|triangle| {
            let cross = front_of(triangle.corners);
            bend_of(cross, normal).or(bend_of(-cross, normal))
        });
        bends.filter(|&bend| bend <= MOST_BETWEEN).fold(0.0, f64::max)
    }

    /// How far ground bends at an edge, by its number.
    pub(super) fn bend_at(&self, edge: u32, normal: DVec3) -> Option<f64> {
        let (triangle, edge) = (edge / 3, edge as usize % 3);
        let (other, _) = self.ground.neighbor(triangle, edge)?;
        let [one, other] = [triangle, other].map(|triangle| front_of(self.ground.corners(triangle)));
        let front = if one.dot(normal) < 0.0 { -normal } else { normal };
        Some(bend_of(one, front)?.max(bend_of(other, front)?))
    }

    /// The ends of an edge of ground by its number.
    pub(super) fn edge(&self, number: u32) -> Option<[DVec3; 2]> {
        let (triangle, edge) = (number / 3, number as usize % 3);
        if triangle >= self.ground.triangle_count() {
            return None;
        }
        let corners = widened(self.ground.corners(triangle));
        Some([corners[edge], corners[(edge + 1) % 3]])
    }

    /// The triangle that a point is furthest inside of, seen along a normal of the ground; of one patch, or of any.
    pub(super) fn under(&self, foot: DVec3, normal: DVec3, patch: Option<u32>) -> Option<[DVec3; 3]> {
        let mut best = (f64::NEG_INFINITY, None);
        for triangle in &self.triangles {
            let [a, b, c] = widened(triangle.corners);
            let facing = (b - a).cross(c - a).dot(normal);
            let is_behind = self.ground.is_one_sided() && facing < 0.0;
            if is_behind || facing == 0.0 || patch.is_some_and(|patch| patch != triangle.patch) {
                continue;
            }
            let beside = |from: DVec3, to: DVec3| (to - from).cross(foot - from).dot(normal) / facing;
            let inside = beside(a, b).min(beside(b, c)).min(beside(c, a));
            if inside > best.0 {
                best = (inside, Some(if facing > 0.0 { [a, b, c] } else { [a, c, b] }));
            }
        }
        best.1
    }
}

/// The sine of the angle between a direction of any length and a unit normal; `None` beyond a right angle.
fn bend_of(direction: DVec3, normal: DVec3) -> Option<f64> {
    let sine = direction.cross(normal).length() / direction.length();
    (direction.dot(normal) > 0.0).then_some(sine.min(1.0))
}
