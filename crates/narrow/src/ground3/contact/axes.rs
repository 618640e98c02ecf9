//! The thirteen separating axes of a cuboid and a triangle: do the kernels have an axis that ground would accept?
//!
//! ```text
//! in the cuboid's axes: three face normals, the triangle's normal, nine cross products of edges
//! an axis shows a gap wider than the reach: apart
//! an axis shows a gap: the closest points decide                                                                 (gap)
//! else the cores overlap, and the axis of least depth is the one that the kernels would find:
//!     if ground rejects it and all that are as good up to the slack, the kernels need not be called
//! ```
//! Most cuboids that overlap a triangle of a bump have their least depth along its normal, or along an axis that its
//! neighbours reject.
//!
//! Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001), with depths.

use super::facet::Facet;
use super::prism::Prism;
use super::standing::Standing;
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec2, DVec3, Vec3Swizzles};
use asunder_geometry::tolerance::FACE_PREFERENCE;

/// The axes of a cuboid and a triangle.
pub(super) struct Axes {
    /// The triangle's corners in the cuboid's axes.
    pub(super) corners: [DVec3; 3],
    /// Its unit normal there.
    normal: DVec3,
    /// The gap between the cores along each axis, in metres: three face normals of the cuboid, the triangle's normal,
    /// then three cross products for each of its edges. Only gaps are stored; the few directions that are needed are
    /// computed later.
    gaps: [f64; 13],
    /// Whether the cuboid is on the negative side of the triangle along the axis as computed.
    is_turned: [bool; 13],
    /// The greatest of the gaps.
    pub(super) best: f64,
    /// By how much an axis that was left out (of nearly parallel edges) may be better, in metres.
    left_out: f64,
}

/// Sine of the angle between edges up to which their cross product is left out: turning by as much makes them parallel,
/// and then the axis is square to a face, too.
const PARALLEL: f64 = 1e-10;

/// Sine of the angle between edges above which a gap along their cross product is right to a millionth of the slack.
const CROSSED: f64 = 1e-3;

impl Prism<'_> {
    /// Fills in the axes, if the part is a cuboid and no two edges are so nearly parallel that their cross product
    /// cannot be trusted; returns whether it did. Stops early once an axis shows a gap wider than `beyond` metres.
    /// Filled in place: they are large.
    pub(super) fn fill(&self, axes: &mut Axes, beyond: f64) -> bool {
        let Shape3::Cuboid(cuboid) = self.standing.part.shape else { return false };
        let normal = self.standing.own(self.facet, DVec3::ZERO, axes);
        axes.fill(normal, (cuboid.half_extents().as_dvec3(), beyond), CROSSED)
    }

    /// Whether ground rejects the axis of least depth of overlapping cores, and all axes that are as good.
    pub(super) fn rejects(&self, axes: &Axes) -> bool {
        let (standing, facet) = (self.standing, self.facet);
        let size = 2.0 * (standing.outer_radius + facet.corners[0].distance(facet.corners[1]));
        let slack = self.doubt + 2.0 * FACE_PREFERENCE * size;
        let mut rivals = axes.as_good_as(axes.best - slack);
        rivals.all(|axis| !facet.lets_through(self.ground, standing.place.axes.turn(axis)))
    }

    /// Whether an axis of least depth of overlapping cores is nearly the triangle's normal.
    pub(super) fn is_own(&self, axes: &Axes) -> bool {
        let standing = self.standing;
        let mut best = axes.as_good_as(axes.best);
        best.any(|axis| self.facet.is_nearly_own(standing.place.axes.turn(axis)))
    }

    /// The separation of a cuboid and a triangle that is level to the axis of least depth, and its error bound, in
    /// metres.
    pub(super) fn measured_by(&self, axes: &Axes) -> Option<[f64; 2]> {
        let (standing, facet) = (self.standing, self.facet);
        let mut best = axes.as_good_as(axes.best);
        let is_level = best.any(|axis| facet.is_level_to(standing.place.axes.turn(axis)));
        is_level.then_some([axes.best - standing.radius, self.doubt + axes.left_out])
    }
}

impl Standing<'_> {
    /// Transforms a triangle's corners to the axes of the part, which has moved, and returns the triangle's normal
    /// there.
    fn own(&self, facet: &Facet, moved: DVec3, axes: &mut Axes) -> DVec3 {
        let place = &self.place;
        let origin = place.origin + moved;
        let own = |corner: DVec3| place.axes.turn_back(corner - origin);
        axes.corners = [own(facet.corners[0]), own(facet.corners[1]), own(facet.corners[2])];
        place.axes.turn_back(facet.normal)
    }

    /// Whether some axis shows that a cuboid, once moved, is no deeper in a triangle than the slack. Always false for
    /// other shapes, of which it shows nothing.
    pub(super) fn is_clear_of(&self, facet: &Facet, moved: DVec3) -> bool {
        let Shape3::Cuboid(cuboid) = self.part.shape else { return false };
        let least = self.radius - self.slack;
        let mut axes = Axes::new();
        let normal = self.own(facet, moved, &mut axes);
        // A gap along the cross product of nearly parallel edges is a gap all the same.
        axes.fill(normal, (cuboid.half_extents().as_dvec3(), least), PARALLEL);
        axes.best >= least
    }
}

impl Axes {
    /// Not a constant: that would be copied as a whole.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            corners: [DVec3::ZERO; 3],
            normal: DVec3::ZERO,
            gaps: [f64::NEG_INFINITY; 13],
            is_turned: [false; 13],
            best: f64::NEG_INFINITY,
            left_out: 0.0,
        }
    }

    /// Whether the cores certainly overlap, by more than `doubt` metres.
    pub(super) fn do_overlap(&self, doubt: f64) -> bool {
        self.best < -(doubt + self.left_out)
    }

    /// The axes along which the gap is no less: unit directions from the triangle to the cuboid, in the cuboid's axes.
    fn as_good_as(&self, gap: f64) -> impl Iterator<Item = DVec3> + '_ {
        (0..self.gaps.len()).filter(move |&number| self.gaps[number] >= gap).map(|number| {
            let axis = self.axis(number);
            if self.is_turned[number] { -axis } else { axis }
        })
    }

    /// An axis by its number, of either sign.
    fn axis(&self, number: usize) -> DVec3 {
        let (edge, own) = match number {
            0..3 => return DVec3::AXES[number],
            3 => return self.normal,
            _ => ((number - 4) / 3, (number - 4) % 3),
        };
        let along = self.corners[(edge + 1) % 3] - self.corners[edge];
        let across = match own {
            0 => DVec3::new(0.0, -along.z, along.y),
            1 => DVec3::new(along.z, 0.0, -along.x),
            _ => DVec3::new(-along.y, along.x, 0.0),
        };
        across * (1.0 / across.length_squared().sqrt())
    }

    /// Computes the thirteen axes, except cross products of parallel edges, and stops at the first that shows a gap
    /// wider than `beyond`. Returns false where the sine between two other edges is below `crossed`.
    fn fill(&mut self, normal: DVec3, (half, beyond): (DVec3, f64), crossed: f64) -> bool {
        self.normal = normal;
        let corners = self.corners;
        let (low, high) =
            (corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2]));
        self.offer(0, [low.x, high.x], half.x);
        self.offer(1, [low.y, high.y], half.y);
        self.offer(2, [low.z, high.z], half.z);
        let height = normal.dot(corners[0]);
        self.offer(3, [height, height], half.dot(normal.abs()));
        for (edge, third) in [(0, 2), (1, 0), (2, 1)] {
            if self.best > beyond {
                return true;
            }
            let along = corners[(edge + 1) % 3] - corners[edge];
            let least = [PARALLEL, crossed].map(|sine| sine * sine * along.length_squared());
            // An axis square to one of the cuboid's, as a vector in the plane of the other two: zeros are left out.
            let (one, other, number) = (corners[edge], corners[third], 4 + 3 * edge);
            let x = (DVec2::new(-along.z, along.y), [one.yz(), other.yz()], half.yz());
            let y = (DVec2::new(along.z, -along.x), [one.xz(), other.xz()], half.xz());
            let z = (DVec2::new(-along.y, along.x), [one.xy(), other.xy()], half.xy());
            if !(self.offer_across(number, x, least)
                && self.offer_across(number + 1, y, least)
                && self.offer_across(number + 2, z, least))
            {
                return false;
            }
        }
        true
    }

    /// Tests the cross product of two edges, with two corners and the half extents in its plane; returns whether its
    /// length can be trusted.
    #[inline(always)]
    fn offer_across(
        &mut self,
        number: usize,
        (axis, [one, other], half): (DVec2, [DVec2; 2], DVec2),
        [parallel, crossed]: [f64; 2],
    ) -> bool {
        let square = axis.length_squared();
        if square <= parallel {
            if square > 0.0 {
                // Turning about the cuboid's centre moves no corner further.
                let [a, b, c] = self.corners.map(DVec3::abs);
                self.left_out = 2.0 * PARALLEL * a.max(b).max(c).length();
            }
            return true;
        }
        if square < crossed {
            return false;
        }
        let axis = axis * (1.0 / square.sqrt());
        let (one, other) = (axis.dot(one), axis.dot(other));
        let ends = if one < other { [one, other] } else { [other, one] };
        self.offer(number, ends, half.dot(axis.abs()));
        true
    }

    /// Takes the sign of the axis with the greater gap.
    #[inline(always)]
    fn offer(&mut self, number: usize, [low, high]: [f64; 2], half: f64) {
        let is_turned = low > -high;
        let gap = if is_turned { low } else { -high } - half;
        self.best = if gap > self.best { gap } else { self.best };
        (self.gaps[number], self.is_turned[number]) = (gap, is_turned);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle at this depth in the top of a cuboid, with one edge turned this far from the cuboid's own.
    fn is_certain(depth: f64, turn: f64) -> bool {
        let (half, height) = (DVec3::new(1.0, 0.3, 0.3), 0.3 - depth);
        let corners = [[-1.0, height, -turn], [1.0, height, turn], [0.0, height, 2.0]].map(DVec3::from);
        let mut axes = Axes { corners, ..Axes::new() };
        assert!(
            axes.fill(DVec3::Y, (half, f64::INFINITY), CROSSED),
            "no edges too near to parallel to be trusted"
        );
        assert!((axes.best + depth).abs() < 1e-15);
        axes.do_overlap(1e-13)
    }

    #[test]
    fn an_axis_that_is_left_out_may_be_the_one_that_parts() {
        assert!(is_certain(1e-11, 0.0), "what is parallel has no axis");
        assert!(!is_certain(1e-11, 5e-11), "all but parallel: there is one, and it was not looked at");
        assert!(is_certain(1e-8, 5e-11), "by more than it could show");
    }
}
