//! Circles and capsules: pairs for which the radii decide.

use asunder_geometry::glam::{DVec2, DVec3, Vec2};
use asunder_geometry::{Capsule2, Circle, Pose2, Rotation2, Shape2};
use asunder_narrow::Pair2;
use asunder_scenes::pairs::{PairSet, PosedPair2};
use asunder_scenes::random::Random;

/// Different shapes in a set; every other one is a circle.
const DISTINCT: usize = 16;

const IN_RANGE: &str = "half a metre around a place near the origin is in range";

/// A shape about 1 m wide: a circle, or a capsule about its own origin.
fn shape(index: usize, random: &mut Random) -> Shape2 {
    let radius = random.range(0.2, 0.5) as f32;
    if index.is_multiple_of(2) {
        return Circle::new(radius).expect(IN_RANGE).into();
    }
    let end = Vec2::new(0.0, random.range(0.1, 0.4) as f32);
    Capsule2::new(-end, end, radius).expect(IN_RANGE).into()
}

/// A shape with its rotation.
struct Turned<'a> {
    shape: &'a Shape2,
    rotation: Rotation2,
}

impl<'a> Turned<'a> {
    fn new(shape: &'a Shape2, random: &mut Random) -> Self {
        let unit = direction(random).as_vec2();
        Self { shape, rotation: Rotation2::new(unit.x, unit.y).expect(IN_RANGE) }
    }

    /// The support point along a unit vector, from the shape's position.
    fn support(&self, way: DVec2) -> DVec2 {
        let core = self.shape.core();
        let points = core.vertices().iter().map(|v| self.rotation.turn(v.as_dvec2()));
        let furthest = points.max_by(|p, q| p.dot(way).total_cmp(&q.dot(way))).unwrap_or_default();
        furthest + way * f64::from(self.shape.radius())
    }

    /// Half its extent along both axes.
    fn half_extents(&self) -> DVec2 {
        DVec2::new(self.support(DVec2::X).x, self.support(DVec2::Y).y)
    }
}

fn direction(random: &mut Random) -> DVec2 {
    random.direction().truncate().normalize()
}

/// `count` pairs. In `Touch`, two surface points are within 1e-3 of size along a common normal.
pub(super) fn pairs(set: PairSet, count: usize) -> Vec<PosedPair2> {
    let mut random = Random::new(0x09);
    let shapes: Vec<Shape2> = (0..DISTINCT).map(|index| shape(index, &mut random)).collect();
    (0..count).map(|_| one_pair(set, &shapes, &mut random)).collect()
}

fn one_pair(set: PairSet, shapes: &[Shape2], random: &mut Random) -> PosedPair2 {
    let is_wanted_apart = random.unit() < 0.4;
    loop {
        let [a, b] = [0, 1].map(|_| Turned::new(&shapes[random.below(DISTINCT)], random));
        let way = direction(random);
        let size = f64::from(a.shape.outer_radius() + b.shape.outer_radius());
        let offset = match set {
            PairSet::Far => way * random.range(4.0, 10.0),
            PairSet::Deep => way * random.range(0.0, 0.1),
            PairSet::Mixed => {
                let reach = (a.half_extents() + b.half_extents()).extend(0.0);
                random.within(-reach, reach).truncate()
            }
            _ => a.support(way) - b.support(-way) + way * (random.range(-1e-3, 1e-3) * size),
        };
        let at = random.within(DVec3::splat(-5.0), DVec3::splat(5.0)).truncate();
        let pair = PosedPair2 {
            shape_a: a.shape.clone(),
            pose_a: Pose2::new(at, a.rotation).expect(IN_RANGE),
            shape_b: b.shape.clone(),
            pose_b: Pose2::new(at + offset, b.rotation).expect(IN_RANGE),
        };
        if set != PairSet::Mixed || is_apart(&pair) == is_wanted_apart {
            return pair;
        }
    }
}

fn is_apart(pair: &PosedPair2) -> bool {
    !Pair2::new(&pair.shape_a, &pair.pose_a, &pair.shape_b, &pair.pose_b).overlaps()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_tests::precise::separation2;

    /// True separations as shares of the size.
    fn shares(set: PairSet) -> Vec<f64> {
        let share = |pair: &PosedPair2| {
            let found = separation2((&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b));
            found.separation / f64::from(pair.shape_a.outer_radius() + pair.shape_b.outer_radius())
        };
        pairs(set, 400).iter().map(share).collect()
    }

    #[test]
    fn circles_and_capsules_lie_as_their_set_says() {
        let apart = |shares: &[f64]| shares.iter().filter(|&&share| share > 0.0).count();
        let touch = shares(PairSet::Touch);
        assert!(touch.iter().all(|share| share.abs() < 1.1e-3) && (150..250).contains(&apart(&touch)));
        assert!((120..200).contains(&apart(&shares(PairSet::Mixed))));
        assert!(shares(PairSet::Far).iter().all(|&share| share > 1.0));
        assert!(shares(PairSet::Deep).iter().all(|&share| share < -0.2));
    }
}
