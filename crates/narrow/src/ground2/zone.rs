//! Bounds of a convex shape in the axes of a chain.

use crate::polygon::outline::{Outline, Turn};
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Shape2};

/// A stored rotation stretches by its length, which is one up to the rounding of f32; a part of a compound has two.
const STRETCH: f64 = 4.0 * f32::EPSILON as f64;

/// Roundings of a coordinate, in units of 2^-52 of all that it is a sum of: more than a pair's projection has.
const ROUNDINGS: f64 = 64.0;

/// What is needed to bound the distance from the boxes of a chain.
pub(crate) enum Zone {
    /// A box around it, in the chain's axes.
    Around { low: DVec2, high: DVec2 },
    /// Everything below a line, for a normal in the chain's axes.
    Below { normal: DVec2, height: f64, lost: f64 },
}

impl Zone {
    /// For a turned shape whose origin is `offset` from the chain's, in world axes. `summed` bounds the lengths that
    /// make up the offset.
    pub(crate) fn of(shape: &Shape2, turn: Turn, offset: DVec2, chain: &Turn, summed: f64) -> Self {
        let lost = |reach: f64| ROUNDINGS * f64::EPSILON * (summed + sum(offset) + reach);
        if let Shape2::HalfPlane(half_plane) = shape {
            let normal = turn.turn(half_plane.unit_normal()).normalize();
            return Self::Below {
                normal: chain.turn_back(normal),
                height: normal.dot(offset),
                lost: lost(0.0),
            };
        }
        let core = shape.core();
        let outline = Outline::new(shape, &core, turn, offset);
        let reach = |direction: DVec2| match shape {
            Shape2::Chain(_) => {
                let furthest = shape.support(turn.turn_back(direction)).unwrap_or_default();
                direction.dot(offset + turn.turn(furthest))
            }
            _ => outline.support(direction).reach,
        };
        // The chain's axes are as long as its rotation stretches; the inverse divides by the square of that.
        let [x, y] = chain.axes();
        let inverse = 1.0 / x.length_squared();
        let high = DVec2::new(reach(x), reach(y)) * inverse;
        let low = DVec2::new(-reach(-x), -reach(-y)) * inverse;
        let further = f64::from(shape.center().abs().element_sum()) + f64::from(shape.outer_radius());
        let wider = f64::from(shape.radius()) * (1.0 + STRETCH) + lost(sum(low) + sum(high) + further);
        Self::Around { low: low - wider, high: high + wider }
    }

    /// A lower bound on the distance from a box, in metres; for a half-plane, below zero by how deep the box reaches.
    pub(crate) fn gap(&self, bounds: &Aabb2) -> f64 {
        let (min, max) = (bounds.min.as_dvec2(), bounds.max.as_dvec2());
        match *self {
            Self::Around { low, high } => {
                (min - high).max(low - max).max(DVec2::ZERO).length() * (1.0 - STRETCH)
            }
            Self::Below { normal, height, lost } => {
                let lowest = DVec2::select(normal.cmpge(DVec2::ZERO), min, max);
                normal.dot(lowest) - height - lost - ROUNDINGS * f64::EPSILON * sum(lowest)
            }
        }
    }

    /// The sum of the largest coordinates around it.
    pub(crate) fn reach(&self) -> f64 {
        match *self {
            Self::Around { low, high } => low.abs().max(high.abs()).element_sum(),
            Self::Below { height, .. } => height.abs(),
        }
    }

    /// Whether depth counts as well: a half-plane has no other side.
    pub(crate) fn is_endless(&self) -> bool {
        matches!(self, Self::Below { .. })
    }
}

fn sum(v: DVec2) -> f64 {
    v.abs().element_sum()
}
