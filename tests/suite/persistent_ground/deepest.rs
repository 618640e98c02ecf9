//! Which contact is the deepest, and how deep, of what is moved along on ground and of what is made anew.

use super::{drift, grounds, moved, stands};
use asunder_geometry::Pose3;
use asunder_narrow::Manifold3;
use asunder_scenes::random::Random;
use glam::DVec3;

/// The least separation, and its error.
fn deepest(manifolds: &[Manifold3]) -> Option<(f64, f64)> {
    let least = manifolds.iter().min_by(|one, other| one.separation.total_cmp(&other.separation))?;
    Some((f64::from(least.separation), f64::from(least.error)))
}

/// Bodies at rest or stuck up to a fifth of their radius deep, and moved as far as contacts are moved along.
///
/// Ground decides anew which directions it accepts only where contacts are made: so in rare cases another one has become
/// the deepest meanwhile, as where a body that is stuck deep has slid over a seam.
#[test]
fn the_deepest_contact_that_is_moved_along_is_the_deepest_of_new_ones() {
    let mut random = Random::new(0xDEE9);
    let (mut compared, mut stuck, mut off) = (0, 0, Vec::new());
    for ground in grounds() {
        for (number, mut stand) in stands(&ground, &mut random, 8000).into_iter().enumerate() {
            let deeper = [0.0, 0.01, 0.08][number % 3] * random.range(0.0, 1.0);
            let down = stand.field.turn(DVec3::NEG_Y) * deeper;
            stand.pose = Pose3::new(stand.pose.position() + down, stand.pose.rotation()).unwrap();
            let (.., Some(kept)) = stand.made(&stand.pose) else { continue };
            for _ in 0..4 {
                let step = random.direction() * random.range(0.0, 1.0) * f64::from(kept.reach());
                let spin = random.direction() * random.range(0.0, 1e-4);
                let now = moved(&stand.pose, step, spin);
                let Some(found) = stand.carried(&kept, &now) else { continue };
                let (Some(was), Some(new)) = (deepest(&found), deepest(&stand.made(&now).1)) else {
                    continue;
                };
                compared += 1;
                stuck += usize::from(new.0 < -0.01);
                if (was.0 - new.0).abs() > was.1 + new.1 {
                    off.push((ground.0, number, drift(&stand, &now), was, new));
                }
            }
        }
    }
    assert!(compared > 15_000 && stuck > 3000, "{compared} {stuck}");
    assert!(off.len() * 10_000 <= compared, "{} of {compared}: {off:?}", off.len());
}
