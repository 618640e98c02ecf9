//! Triangles whose axis ground refused: they wait until all others have been heard.

use super::facet::{Facet, is_same};
use super::groups::MOST_GROUPS;
use super::prism::Prism;
use super::standing::Extent;
use super::{Known, Seen};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// A triangle whose axis was refused, and how the part stands over it: made once, though it takes room.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refused {
    facet: Facet,
    extent: Extent,
    /// How deep the part is in it, and how far that may be off, where its axis is level to all of the triangle.
    told: Option<[f64; 2]>,
}

/// Most triangles that wait until all others have been seen.
const MOST_REFUSED: usize = 32;

pub(super) type AllRefused = ArrayVec<Refused, MOST_REFUSED>;

impl Seen<'_> {
    /// Keeps a triangle whose axis was refused until all others have been heard.
    pub(super) fn refuse(&self, prism: &Prism, told: Option<[f64; 2]>, known: &mut Known) {
        if known.refused.is_full() {
            self.add_in_place(prism, told, known);
            return;
        }
        let (mut facet, mut extent) = (*prism.facet, *prism.extent);
        if !facet.has_own_plane()
            && let Some(own) = Facet::seen(prism.ground, facet.number, self.standing.center)
        {
            (facet, extent) = (own, self.standing.extent(own.normal, own.origin()));
        }
        let _ = known.refused.try_push(Refused { facet, extent, told });
    }

    /// Adds points of triangles whose axis was refused, by their own normals.
    pub(super) fn add_refused(&self, known: &mut Known) {
        if known.refused.is_empty() {
            return;
        }
        let (ground, standing, reach) = (self.asking.on.ground, self.standing, self.asking.reach);
        let heard: ArrayVec<(DVec3, f64), MOST_GROUPS> =
            known.groups.iter().map(|group| (group.base.normal, group.least())).collect();
        // One by one: all of them are large.
        for place in 0..known.refused.len() {
            let Refused { facet, extent, told } = known.refused[place];
            let separation = extent.low - standing.radius;
            let is_freed = heard.iter().any(|&(normal, least)| {
                separation < least - standing.slack && !is_same(facet.normal, normal) && {
                    let [a, b, c] = facet.corners;
                    let height = |corner: DVec3| normal.dot(corner - facet.origin());
                    let top = height(a).max(height(b)).max(height(c));
                    let low = standing.extent(normal, facet.origin()).low - standing.radius;
                    low - top >= least - standing.slack
                }
            });
            if !is_freed {
                let doubt = self.doubt_over(&facet);
                let prism =
                    Prism { ground, standing, facet: &facet, extent: &extent, reach, doubt, gate: None };
                self.add_in_place(&prism, told, known);
            }
        }
    }

    /// Adds points by a triangle's own normal, in place of those along what was refused.
    fn add_in_place(&self, prism: &Prism, told: Option<[f64; 2]>, known: &mut Known) {
        self.add_by_normal(prism, known);
        if let Some(told) = told {
            known.groups.tell(prism.facet.normal, told);
        }
    }
}
