//! Polygons of 8 to 4096 vertices, in placements that circles cannot decide: how cost grows with the vertices.

use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Polygon, Pose2, Rotation2, Shape2};
use asunder_narrow::Pair2;
use asunder_scenes::pairs::PosedPair2;
use asunder_scenes::random::Random;

/// How two ellipses are placed. A size is the sum of the two bounding radii.
///
/// ```
/// use asunder_benches::flat::Lie;
/// assert_eq!(Lie::ALL.map(Lie::name), ["apart", "light", "deep"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lie {
    /// Apart by 1e-3 to 1e-2 of size along an axis, although their bounding circles overlap.
    Apart,
    /// Overlapping by no more than that along the axis, although their inscribed circles are apart.
    Light,
    /// The centres nearly coincide, and all edges have about the same depth.
    Deep,
}

impl Lie {
    /// All placements.
    pub const ALL: [Self; 3] = [Self::Apart, Self::Light, Self::Deep];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Apart => "apart",
            Self::Light => "light",
            Self::Deep => "deep",
        }
    }
}

/// Different polygons in a set: more than a branch predictor can memorise.
const DISTINCT: usize = 24;

const IN_RANGE: &str = "half a metre around the origin is a polygon's place";

/// The unit vector at an angle of about `quarters` quarter turns, without trigonometry.
fn on_circle(quarters: f64) -> DVec2 {
    let t = quarters.fract();
    let point = DVec2::new(1.0 - t * t, 2.0 * t) / (1.0 + t * t);
    (0..quarters as usize).fold(point, |point, _| point.perp())
}

/// Points around an ellipse, at even places up to half a step; of thousands, some are lost to rounding.
fn ellipse(count: usize, lie: Lie, random: &mut Random) -> Shape2 {
    // Those with a common centre are almost round, so that no edge is much better than another.
    let radii = if lie == Lie::Deep { [0.5; 2] } else { [random.range(0.55, 0.6), random.range(0.3, 0.35)] };
    let points: Vec<Vec2> = (0..count)
        .map(|i| on_circle(4.0 * (i as f64 + random.range(0.0, 0.5)) / count as f64))
        .map(|point| (point * DVec2::from(radii)).as_vec2())
        .collect();
    Polygon::hull_of(&points).expect(IN_RANGE).into()
}

fn direction(random: &mut Random) -> DVec2 {
    on_circle(random.range(0.0, 4.0))
}

fn reach(shape: &Shape2, turn: Rotation2, axis: DVec2) -> f64 {
    let core = shape.core();
    core.vertices().iter().map(|v| turn.turn(v.as_dvec2()).dot(axis)).fold(f64::NEG_INFINITY, f64::max)
}

/// `count` pairs of polygons of so many vertices each.
pub(crate) fn pairs(vertices: usize, lie: Lie, count: usize) -> Vec<PosedPair2> {
    let mut random = Random::new(vertices as u64);
    let shapes: Vec<Shape2> = (0..DISTINCT).map(|_| ellipse(vertices, lie, &mut random)).collect();
    let mut pairs = Vec::new();
    while pairs.len() < count {
        let [a, b] = [0, 1].map(|_| &shapes[random.below(DISTINCT)]);
        let [turn_a, turn_b] = [0, 1].map(|_| {
            let unit = direction(&mut random).as_vec2();
            Rotation2::new(unit.x, unit.y).expect(IN_RANGE)
        });
        let (way, size) = (direction(&mut random), f64::from(a.outer_radius() + b.outer_radius()));
        let gap = random.range(1e-3, 1e-2) * size;
        let touching = reach(a, turn_a, way) + reach(b, turn_b, -way);
        let offset = match lie {
            Lie::Apart => way * (touching + gap),
            Lie::Light => way * (touching - gap),
            Lie::Deep => way * (1e-3 * gap),
        };
        // What circles can decide has a row of its own.
        let (far, near) = (size, f64::from(inner_radius(a) + inner_radius(b)));
        if lie != Lie::Deep && !(near..far).contains(&offset.length()) {
            continue;
        }
        let pair = PosedPair2 {
            shape_a: a.clone(),
            pose_a: Pose2::new(DVec2::ZERO, turn_a).expect(IN_RANGE),
            shape_b: b.clone(),
            pose_b: Pose2::new(offset, turn_b).expect(IN_RANGE),
        };
        // An overlap of their projections on one axis is no proof that they overlap.
        if lie != Lie::Light || overlap(&pair) {
            pairs.push(pair);
        }
    }
    pairs
}

fn overlap(pair: &PosedPair2) -> bool {
    Pair2::new(&pair.shape_a, &pair.pose_a, &pair.shape_b, &pair.pose_b).overlaps()
}

fn inner_radius(shape: &Shape2) -> f32 {
    if let Shape2::Polygon(polygon) = shape { polygon.inner_radius() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_lie_as_they_say() {
        for vertices in [8, 256] {
            let overlapping =
                Lie::ALL.map(|lie| pairs(vertices, lie, 100).iter().filter(|pair| overlap(pair)).count());
            assert_eq!(overlapping, [0, 100, 100]);
        }
        let shape = ellipse(4096, Lie::Apart, &mut Random::new(1));
        let Shape2::Polygon(polygon) = shape else { panic!("an ellipse is a polygon") };
        assert!(polygon.vertices().len() > 3500, "{}", polygon.vertices().len());
    }
}
