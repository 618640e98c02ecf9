//! Two cuboids in the frame of the first, with the rounding error bounds there.

use super::fifteen::Fifteen;
use crate::batch::beyond;
use crate::precision::{IN_SPACE, Precision};
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::{EVEN_DEPTH, FACE_PREFERENCE, SAME_PLACE};
use asunder_geometry::{Basis3, Cuboid, Pose3};

/// Two cuboids with their poses.
#[derive(Clone, Copy)]
pub(crate) struct Posed<'a> {
    pub(crate) cuboids: [&'a Cuboid; 2],
    pub(crate) poses: [&'a Pose3; 2],
}

/// Two cuboids in A's axes, about A's position.
#[derive(Debug)]
pub(super) struct Placed {
    /// Half extents of the cores.
    pub(super) half: [DVec3; 2],
    /// B's axes.
    pub(super) relative: Basis3,
    /// B's axes again, as a flat array.
    pub(super) turn: [f64; 9],
    /// B's centre.
    pub(super) offset: DVec3,
    /// A's axes in the world.
    pub(super) basis: Basis3,
    pub(super) precision: Precision,
    /// The sum of both radii, in metres.
    pub(super) radii: f64,
    /// By how much another axis must beat a face of A to be preferred, in metres.
    pub(super) preference: f64,
    /// Corners no further than this above the deepest count as equally deep when four of more are chosen, in metres.
    pub(super) even: f64,
    /// How near a point must be to a corner or an edge to be named after it, in metres.
    pub(super) near: f64,
    pub(super) fifteen: Fifteen,
}

impl Posed<'_> {
    /// Whether the bounding spheres are more than `limit` metres apart for certain.
    #[inline]
    pub(crate) fn are_far(&self, limit: f64) -> bool {
        let [a, b] = self.cuboids;
        let reach = f64::from(a.outer_radius()) + f64::from(b.outer_radius()) + limit;
        // The subtraction of positions, three squares, three sums: eight roundings at most.
        self.between().length_squared() > reach * reach * (1.0 + 8.0 * f64::EPSILON)
    }

    /// Whether the inscribed spheres overlap for certain.
    #[inline]
    pub(super) fn are_near(&self) -> bool {
        let [a, b] = self.cuboids;
        let reach = f64::from(a.inner_radius()) + f64::from(b.inner_radius());
        // Roundings as in `are_far`.
        self.between().length_squared() * (1.0 + 8.0 * f64::EPSILON) < reach * reach
    }

    /// By how much the gap between the bounding spheres exceeds `reach`, in metres.
    #[inline]
    pub(crate) fn beyond(&self, reach: f64) -> f32 {
        beyond(self.gap_of_spheres(), reach)
    }

    /// A lower bound on the separation, from the bounding spheres.
    pub(super) fn gap_of_spheres(&self) -> f64 {
        let [a, b] = self.cuboids;
        let radii = f64::from(a.outer_radius()) + f64::from(b.outer_radius());
        let apart = self.between().length();
        apart - radii - 8.0 * f64::EPSILON * (apart + radii)
    }

    /// B's position less A's.
    #[inline]
    pub(super) fn between(&self) -> DVec3 {
        self.poses[1].position() - self.poses[0].position()
    }

    /// B's placement relative to A, and the fifteen axes.
    ///
    /// Not inlined, and written to memory as a whole here: so LLVM sees rows, and no row is read back before all of it
    /// has been written.
    #[inline(never)]
    pub(super) fn placed(&self) -> Placed {
        let [a, b] = self.cuboids;
        let [pose_a, pose_b] = self.poses;
        let basis = pose_a.basis();
        let offset = basis.turn_back(pose_b.position() - pose_a.position());
        let relative = pose_b.basis_from(pose_a);
        let half = [a.half_extents().as_dvec3(), b.half_extents().as_dvec3()];
        let fifteen = Fifteen::new(&half, &relative, offset);
        Placed::new(self, basis, (relative, offset), fifteen)
    }
}

/// How large two cuboids are, in metres.
#[derive(Clone, Copy)]
pub(super) struct Size {
    /// The sum of both cores' bounding radii.
    pub(super) cores: f64,
    /// The sum of both radii.
    pub(super) radii: f64,
    /// The smaller bounding radius.
    smaller: f64,
}

impl Size {
    #[inline(always)]
    pub(super) fn of(posed: &Posed) -> Self {
        let [a, b] = posed.cuboids;
        let outer = [f64::from(a.outer_radius()), f64::from(b.outer_radius())];
        let round = [f64::from(a.radius()), f64::from(b.radius())];
        Self {
            cores: (outer[0] - round[0]) + (outer[1] - round[1]),
            radii: round[0] + round[1],
            smaller: if outer[0] < outer[1] { outer[0] } else { outer[1] },
        }
    }

    /// The precision of a pair, given the sum of the cores' sizes, and the sum with the radii added.
    #[inline(always)]
    pub(super) fn precision(size: f64, sum: f64, offset: DVec3) -> Precision {
        let [x, y, z] = offset.to_array();
        let reach = sum + (x.abs() + y.abs() + z.abs());
        Precision { size, reach, planarity: 0.0, roundings: IN_SPACE.of_bodies }
    }
}

impl Placed {
    #[inline(always)]
    pub(super) fn new(
        posed: &Posed,
        basis: Basis3,
        (relative, offset): (Basis3, DVec3),
        fifteen: Fifteen,
    ) -> Self {
        let [a, b] = posed.cuboids;
        let half = [a.half_extents().as_dvec3(), b.half_extents().as_dvec3()];
        let Size { cores, radii, smaller } = Size::of(posed);
        let precision = Size::precision(cores, cores + radii, offset);
        let preference = precision.share(FACE_PREFERENCE, smaller);
        let even = precision.share(EVEN_DEPTH, smaller);
        let near = precision.share(SAME_PLACE, smaller);
        let Basis3 { x, y, z } = relative;
        let turn = [x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z];
        Self { half, relative, turn, offset, basis, precision, radii, preference, even, near, fifteen }
    }

    /// One of B's axes.
    #[inline]
    pub(super) fn axis_b(&self, j: usize) -> DVec3 {
        [self.relative.x, self.relative.y, self.relative.z][j]
    }

    /// Separation of the cores along a unit axis, by full projection.
    #[inline]
    pub(super) fn along(&self, axis: DVec3) -> f64 {
        let [a, b] = self.half;
        axis.dot(self.offset).abs() - axis.abs().dot(a) - self.relative.turn_back(axis).abs().dot(b)
    }
}
