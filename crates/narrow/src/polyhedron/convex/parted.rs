//! Whether last frame's direction still separates two shapes, before any solids are built from them.
//!
//! Of the airborne pairs of hulls that a broad phase hands over, a third are still separated along the direction that
//! separated them in the frame before. To find that out takes two support points. Putting together axes, faces and
//! edges of both shapes for the kernels took three times as long as those. Here f32 lanes bound the projections; the
//! vertices are not needed.

use super::{Convex, Probe, Query};
use crate::polyhedron::octets::bound_of_reach;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;

impl Convex<'_> {
    /// The answer of [`Convex::probe`] for hulls and cuboids that the hinted direction separates by more than the
    /// limit; `None` for all others. Cost: linear in the vertices.
    #[inline]
    pub(super) fn parted_as_before(&self, query: Query) -> Option<Probe> {
        let direction = query.hint.direction()?;
        let of_a = most_of(self.shape_a, direction)?;
        let of_b = most_of(self.shape_b, self.relative.turn_back(-direction))?;
        let separation = direction.dot(self.offset) - of_b - of_a;
        let beyond = query.limit + self.radii + self.precision.projection();
        (separation > beyond).then(|| self.beyond(separation, query.hint))
    }
}

/// An upper bound on how far the core of a hull or cuboid reaches along a direction in its own axes, apart from the
/// rounding of f64.
#[inline]
fn most_of(shape: &Shape3, direction: DVec3) -> Option<f64> {
    match shape {
        Shape3::Hull(_) => {
            let core = shape.core();
            Some(bound_of_reach(core.vertex_octets(), core.extent(), direction))
        }
        Shape3::Cuboid(cuboid) => Some(direction.abs().dot(cuboid.half_extents().as_dvec3())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pair3;
    use crate::answer::Separation3;
    use crate::feature::Hint;
    use crate::polyhedron::convex::Wanted;
    use crate::polyhedron::sat::tests::{Random, convex};
    use asunder_geometry::glam::Vec3;
    use asunder_geometry::{Cuboid, Pose3};

    /// A hull or a cuboid of any size, rounded or not.
    fn shape(random: &mut Random, case: u64) -> Shape3 {
        let size = [1e-4, 1.0, 1e4][case as usize / 2 % 3];
        let half = (random.vector().abs() + Vec3::splat(0.1)) * size;
        let radius = if case.is_multiple_of(5) { 0.3 * size } else { 0.0 };
        match (case.is_multiple_of(2), random.hull(case / 2)) {
            (true, _) => match Cuboid::from_half_extents(half).unwrap() {
                cuboid if radius > 0.0 => cuboid.rounded(radius).unwrap().into(),
                cuboid => cuboid.into(),
            },
            (false, hull) => hull,
        }
    }

    #[test]
    fn bounds_along_a_direction_agree_with_the_kernels() {
        let mut random = Random(0x9A47_ED0B_EF03);
        let (mut parted, mut open) = (0, 0);
        for case in 0..20_000 {
            let (shape_a, shape_b) = (shape(&mut random, case), shape(&mut random, case / 3));
            let size = shape_a.outer_radius() + shape_b.outer_radius();
            let pose_a = Pose3::new(random.vector() * 100.0, random.turn(0)).unwrap();
            let away = random.vector().normalize_or(Vec3::X) * size * (0.3 + random.number().abs());
            let pose_b = pose_a.shifted(away).unwrap();
            let pose_b = Pose3::new(pose_b.position(), random.turn(case)).unwrap();
            let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
            let direction =
                pose_a.turn_back(random.vector().as_dvec3() * 0.2 + away.as_dvec3() / f64::from(size));
            let limit = f64::from(size * 0.3 * random.number().abs());
            let query = Query { limit, hint: Hint::towards(direction.normalize()), wanted: Wanted::Points };
            let Separation3::Measured(truth) =
                Pair3::new(&shape_a, &pose_a, &shape_b, &pose_b).separation(f32::INFINITY)
            else {
                panic!("no limit was given");
            };
            let bound_or_none = |probe: Probe| match probe {
                Probe::Beyond(at_least, _) => Some(f64::from(at_least)),
                Probe::Near(_) => None,
            };
            match pair.parted_as_before(query).map(bound_or_none) {
                Some(at_least) => {
                    let at_least = at_least.expect("nothing is near");
                    parted += 1;
                    assert!(at_least > limit * (1.0 - 1e-6), "case {case}: {at_least} of {limit}");
                    assert!(at_least <= f64::from(truth.separation) + f64::from(truth.error), "case {case}");
                    // The kernels' bound differs from it by no more than the error of f32 lanes.
                    let theirs = bound_or_none(pair.with_solids(|a, b| pair.probe_solids(a, b, query)))
                        .expect("beyond, too");
                    assert!(
                        (theirs - at_least).abs() <= 4e-6 * f64::from(size),
                        "case {case}: {theirs}, {at_least}"
                    );
                }
                None => open += 1,
            }
        }
        assert!(parted > 5_000 && open > 5_000, "{parted} parted, {open} open");
    }
}
