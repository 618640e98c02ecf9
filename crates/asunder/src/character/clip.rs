//! The way that planes leave open.

use super::Linear;
use asunder_geometry::tolerance::STANDSTILL;

/// The vector nearest to `v` that goes into no plane, given by unit normals that point away from what is solid.
///
/// It is `v` itself, or its projection on one plane, on the crease of two, or zero. The projection on one plane is the
/// nearest vector of a half-space that contains all allowed ones, so the first that goes into no other plane is the
/// answer; of creases, several may be allowed.
pub(super) fn along<P: Linear>(v: P, normals: &[P], crease: impl Fn(P, P) -> Option<P>) -> P {
    let slack = STANDSTILL * v.length();
    let is_free = |v: P| normals.iter().all(|&normal| v.dot(normal) >= -slack);
    if is_free(v) {
        return v;
    }
    let into = |&&normal: &&P| v.dot(normal) < 0.0;
    let foot = |&normal: &P| v - normal * v.dot(normal);
    if let Some(found) = normals.iter().filter(into).map(foot).find(|&foot| is_free(foot)) {
        return found;
    }
    let mut best = P::ZERO;
    for (index, &one) in normals.iter().enumerate() {
        for &other in &normals[index + 1..] {
            if let Some(along) = crease(one, other) {
                let foot = along * v.dot(along);
                // Of projections on lines, the longest is the nearest.
                if is_free(foot) && foot.length() > best.length() {
                    best = foot;
                }
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::character::Walks;
    use crate::space::Volume;
    use asunder_geometry::glam::DVec3;

    /// The nearest vector of the same cone by Dykstra's alternating projections, which converge to it, slowly.
    fn slowly(v: DVec3, normals: &[DVec3]) -> DVec3 {
        let (mut at, mut pushes) = (v, vec![0.0_f64; normals.len()]);
        for _ in 0..20_000 {
            for (normal, push) in normals.iter().zip(&mut pushes) {
                let change = (-at.dot(*normal)).max(-*push);
                *push += change;
                at += *normal * change;
            }
        }
        at
    }

    #[test]
    fn the_way_left_is_the_nearest_that_goes_into_nothing() {
        // A generator of its own: this crate has none.
        let mut state = 12_345_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let mut vector = || DVec3::new(next(), next(), next());
        let mut seen = [0; 4];
        for case in 0..600 {
            let v = vector();
            let normals: Vec<DVec3> = (0..1 + case % 5).filter_map(|_| vector().unit()).collect();
            let (found, slow) = (along(v, &normals, Volume::crease), slowly(v, &normals));
            assert!(found.distance(slow) < 1e-3, "{v} {normals:?}: {found} {slow}");
            let into = normals.iter().filter(|normal| slow.dot(**normal).abs() < 1e-9).count();
            seen[if slow.length() < 1e-9 { 3 } else { into.min(2) }] += 1;
        }
        assert!(seen.iter().all(|&count| count > 20), "free, on one plane, on a crease, nowhere: {seen:?}");
    }
}
