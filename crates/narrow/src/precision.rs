//! The error that is reported with a separation: one place for the whole crate.
//!
//! Kernels propose an axis and evaluate it by full projection in f64. What may separate the reported number from the
//! truth is, in metres (`docs/accuracy.md` derives each constant):
//!
//! 1. *projection*: rounding in f64. Terms are at most `reach`, the sum of all lengths that enter. In space a
//!    projection is off by less than 44 units of 2^-53 of that, in the plane by less than 10; for parts of compounds,
//!    128 and 16;
//! 2. *ceiling*, in overlap: the true best axis may have been proposed slightly off its place. An axis that is off by
//!    an angle shows at most that angle times `reach` too little: once more the projection error for a face, and that
//!    over the sine of their angle for two edges. What counts is by how much any candidate could beat the best;
//! 3. edges so nearly parallel that they propose nothing: [`Precision::of_parallel_edges`];
//! 4. faces that are flat only up to the planarity error;
//! 5. the gap between the two certified bounds, where a distance was iterated;
//! 6. rounding the answer to f32: half an ulp.

use asunder_geometry::glam::DVec3;
pub(crate) use asunder_geometry::round_down;

/// Everything about a pair that its error depends on, in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Precision {
    /// Sum of the cores' bounding radii; a half-space has none.
    pub(crate) size: f64,
    /// The sum of all lengths that go into a coordinate: no term of a projection is greater.
    pub(crate) reach: f64,
    /// Sum of the two shapes' planarity errors.
    pub(crate) planarity: f64,
    /// Rounding error of a projection, in units of 2^-53 of the reach: one of the constants below.
    pub(crate) roundings: f64,
}

/// Rounding error of a projection, in units of 2^-53 of the reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roundings {
    /// For points of bodies.
    pub(crate) of_bodies: f64,
    /// For points of parts of compounds: two rotations and two shifts are applied in place of one.
    pub(crate) of_parts: f64,
}

impl Roundings {
    #[inline]
    pub(crate) const fn of_either(self, has_parts: bool) -> f64 {
        if has_parts { self.of_parts } else { self.of_bodies }
    }
}

/// Roundings in space.
pub(crate) const IN_SPACE: Roundings = Roundings { of_bodies: 44.0, of_parts: 128.0 };

/// Roundings in the plane, where the stored matrix is used as it stands.
pub(crate) const IN_PLANE: Roundings = Roundings { of_bodies: 10.0, of_parts: 16.0 };

/// An upper bound on the length of a vector: a sum of coordinates needs no root.
#[inline]
pub(crate) fn length_at_most(v: DVec3) -> f64 {
    v.abs().element_sum()
}

/// How far off the speed at which a motion closes a gap may be: a dot product of three terms, a unit normal and a
/// displacement or a difference of two, below 16 units.
#[inline]
pub(crate) fn off_closing(way: DVec3) -> f64 {
    16.0 * f64::EPSILON * length_at_most(way)
}

/// How much of a motion closes a gap, where all of it would close `closing` metres: never more, whatever the rounding.
#[inline]
pub(crate) fn closed_after(gap: f64, closing: f64) -> f64 {
    gap.max(0.0) / closing * (1.0 - 4.0 * f64::EPSILON)
}

/// Whether a gap certainly outlasts some of a motion, all of which would close `closing` metres.
#[inline]
pub(crate) fn outlasts(gap: f64, closing: f64, span: f64) -> bool {
    closing <= 0.0 || gap > closing * span * (1.0 + 4.0 * f64::EPSILON)
}

impl Precision {
    /// For two bodies in space whose separation is a closed form, in the world's axes.
    #[inline]
    pub(crate) const fn of_closed_form(reach: f64) -> Self {
        Self { size: 0.0, reach, planarity: 0.0, roundings: IN_SPACE.of_bodies }
    }

    /// Whether a distance and the projection of all corners on its axis agree up to rounding, so that the bound of
    /// projections, 44 units, covers both: `docs/accuracy.md` says how much of it each takes.
    #[inline]
    pub(crate) fn is_proved(&self, distance: f64, at_least: f64) -> bool {
        distance - at_least <= self.projection() / 8.0
    }

    /// Rounding of a projection in f64: below this, a sign means nothing.
    #[inline]
    pub(crate) fn projection(&self) -> f64 {
        self.roundings * (f64::EPSILON / 2.0) * self.reach
    }

    /// This share of the diameter of a body with this bounding radius, the smaller of a pair, but never less than
    /// rounding. In metres. Preferences, and the places of features, are measured by it.
    #[inline]
    pub(crate) fn share(&self, share: f64, radius: f64) -> f64 {
        (share * 2.0 * radius).max(self.projection())
    }

    /// Below this depth an overlap has no direction: rounding, and faces that are not quite flat, may account for it.
    #[inline]
    pub(crate) fn doubt_of_depth(&self) -> f64 {
        8.0 * self.projection() + 4.0 * self.planarity
    }

    /// How much less than the truth the separation along a face's normal may be.
    #[inline]
    pub(crate) fn of_face(&self) -> f64 {
        self.projection()
    }

    /// How much less than the truth the separation along the cross product of two edges may be, by the square of the
    /// sine of their angle.
    #[inline]
    pub(crate) fn of_edges(&self, squared_sine: f64) -> f64 {
        self.projection() / squared_sine.sqrt()
    }

    /// By how much the best axis may fall short because a pair of edges is too parallel to propose one, by the square
    /// of the sine of their angle.
    #[inline]
    pub(crate) fn of_parallel_edges(&self, squared_sine: f64) -> f64 {
        5.0 * (squared_sine.sqrt() * self.reach + self.projection())
    }

    /// Error of a separation found by testing all candidate axes, which could be greater by `short`.
    pub(crate) fn of_separation(&self, separation: f64, short: f64) -> f32 {
        self.rounded_up(short.max(0.0) + self.projection() + 4.0 * self.planarity, separation)
    }

    /// Error of a distance known to lie in an interval of this length.
    pub(crate) fn of_distance(&self, distance: f64, gap: f64) -> f32 {
        // Bounds in the wrong order are rounding too.
        self.rounded_up(gap.abs() + self.projection(), distance)
    }

    /// The separation of cores whose distance has two bounds, less both radii; and the gap between the bounds.
    pub(crate) fn of_gap(&self, distance: f64, at_least: f64, radii: f64) -> (f64, f64) {
        let gap = distance - at_least;
        // Where both bounds agree up to rounding, the projection has lost less to it.
        let is_met = radii > 0.0 && gap <= self.projection();
        (if is_met { at_least } else { distance } - radii, gap)
    }

    fn rounded_up(&self, error: f64, value: f64) -> f32 {
        let half_ulp = value.abs() * f64::from(f32::EPSILON) / 2.0 + f64::from(f32::from_bits(1));
        ((error + half_ulp) as f32).next_up()
    }
}

/// A separation in f32 with the sign of the exact answer: at most zero for shapes that overlap, else positive.
pub(crate) fn signed(separation: f64, overlapping: bool) -> f32 {
    let rounded = separation as f32;
    if overlapping { rounded.min(0.0) } else { rounded.max(f32::from_bits(1)) }
}

/// A certified lower bound in f32.
pub(crate) fn at_least(separation: f64, precision: &Precision) -> f32 {
    round_down(separation - precision.projection())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_is_the_decisions_also_where_rounding_disagrees() {
        assert_eq!(signed(1e-60, true), 0.0);
        assert!(signed(-1e-60, false) > 0.0);
        assert!(signed(1e-60, false) > 0.0, "underflow to zero would read as touching");
        assert_eq!(signed(-0.5, true), -0.5);
    }

    #[test]
    fn errors_grow_with_reach_value_and_what_was_left_out() {
        let small = Precision { size: 1.0, reach: 2.0, planarity: 0.0, roundings: IN_SPACE.of_bodies };
        assert!(small.of_separation(0.0, 0.0) < small.of_separation(100.0, 0.0));
        assert!(small.of_separation(0.0, 0.0) < Precision { reach: 1e9, ..small }.of_separation(0.0, 0.0));
        assert!(small.of_separation(0.0, 0.0) < small.of_separation(0.0, 1e-9));
        assert_eq!(
            small.of_separation(0.0, 0.0),
            small.of_separation(0.0, -1.0),
            "no candidate beats the best"
        );
        assert!(small.of_distance(1.0, 0.0) < Precision { reach: 1e9, ..small }.of_distance(1.0, 0.0));
        assert!(small.of_edges(1e-12) > 1e5 * small.of_face());
    }
}
