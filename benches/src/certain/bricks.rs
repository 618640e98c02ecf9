//! Walls of bricks that share faces, edges and corners.

use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_scenes::pairs::PosedPair3;
use asunder_scenes::random::Random;
use core::f32::consts::FRAC_1_SQRT_2;
use glam::{DVec3, IVec3, Quat, Vec3};

/// Half extents of the bricks, which are twice as long as wide: decimals, which an f32 rounds up or down.
const HALF_EXTENTS: [Vec3; 2] = [Vec3::new(0.2, 0.1, 0.05), Vec3::new(0.35, 0.175, 0.1)];

/// Cells of a wall along each axis. A cell holds two bricks side by side.
const CELLS: i32 = 6;

/// `count` pairs of bricks whose AABBs overlap, drawn from four walls.
///
/// A wall consists of square cells of two bricks; every other cell is turned by a quarter. In two walls the pitch is
/// exactly twice the stored half extents, so that neighbours share faces, edges and corners and nothing else. In the
/// other two it is the decimal that was intended, so that neighbours have a gap or an overlap of the rounding of an
/// f32.
///
/// ```
/// use asunder_benches::certain::bricks;
/// assert_eq!(bricks(10, 1).len(), 10);
/// ```
pub fn bricks(count: usize, seed: u64) -> Vec<PosedPair3> {
    let mut random = Random::new(seed ^ 0xb21c);
    let walls: Vec<Vec<PosedPair3>> = HALF_EXTENTS
        .into_iter()
        .flat_map(|half| [true, false].map(|is_exact| neighbours(half, is_exact)))
        .collect();
    let draw = |random: &mut Random| {
        let wall = &walls[random.below(walls.len())];
        wall[random.below(wall.len())].clone()
    };
    (0..count).map(|_| draw(&mut random)).collect()
}

/// All pairs of a wall whose AABBs overlap.
fn neighbours(half: Vec3, is_exact: bool) -> Vec<PosedPair3> {
    let shape = Shape3::from(Cuboid::from_half_extents(half).expect("a brick is no plate"));
    let poses = wall(half, is_exact);
    let bounds: Vec<_> = poses.iter().map(|pose| shape.bounds(pose, 0.0)).collect();
    let mut pairs = Vec::new();
    for (b, pose_b) in poses.iter().enumerate() {
        for (a, pose_a) in poses.iter().enumerate().take(b) {
            if bounds[a].overlaps(&bounds[b]) {
                let (shape_a, shape_b) = (shape.clone(), shape.clone());
                pairs.push(PosedPair3 { shape_a, pose_a: *pose_a, shape_b, pose_b: *pose_b });
            }
        }
    }
    pairs
}

fn wall(half: Vec3, is_exact: bool) -> Vec<Pose3> {
    // A small whole number times an f32 is exact in f64. A decimal of four digits is restored by rounding.
    let decimal = |x: f64| (x * 1e4).round() / 1e4;
    let half = half.as_dvec3();
    let half = if is_exact { half } else { half.map(decimal) };
    // A quarter turn, exact for any length of the quaternion: both components have the same bits.
    let quarter = Quat::from_xyzw(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
    let mut poses = Vec::new();
    for index in 0..CELLS * CELLS * CELLS {
        let cell = IVec3::new(index % CELLS, index / CELLS % CELLS, index / (CELLS * CELLS));
        let is_turned = (cell.x + cell.y + cell.z) % 2 == 1;
        let middle = cell.as_dvec3() * DVec3::new(2.0 * half.x, 2.0 * half.x, 2.0 * half.z);
        for side in [-half.y, half.y] {
            let (beside, rotation) = match is_turned {
                true => (DVec3::new(side, 0.0, 0.0), quarter),
                false => (DVec3::new(0.0, side, 0.0), Quat::IDENTITY),
            };
            poses.push(Pose3::new(middle + beside, rotation).expect("a wall is finite and near"));
        }
    }
    poses
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_tests::exact_overlap::Relation;
    use asunder_tests::report::Posed;

    #[test]
    fn neighbours_of_an_exact_wall_share_a_point_and_hardly_more() {
        for half in HALF_EXTENTS {
            for pair in neighbours(half, true).iter().step_by(37) {
                assert_ne!(pair.relation(), Relation::Apart, "{pair:?}");
                assert!(pair.truth().separation.abs() <= 1e-15, "{pair:?}");
            }
        }
    }

    #[test]
    fn neighbours_of_a_wall_of_decimals_miss_or_overlap() {
        let is_apart = |pair: &PosedPair3| pair.relation() == Relation::Apart;
        let [long, short] = HALF_EXTENTS.map(|half| neighbours(half, false));
        // As f32, 0.1 and 0.05 round up, 0.35 and 0.175 down.
        assert!(long.iter().step_by(37).all(|pair| !is_apart(pair)));
        assert!(short.iter().step_by(37).any(is_apart));
    }
}
