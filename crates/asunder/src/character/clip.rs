//! Which way is left between planes.

use super::Linear;
use asunder_geometry::tolerance::STANDSTILL;

/// The vector nearest to `v` that goes into no plane, given by unit normals that point away from what is solid.
///
/// It is `v` itself, or its foot on one plane, on the crease of two, or zero. The foot on one plane is the nearest vector of
/// a half-space that holds all the others, so the first that goes into no other plane is the answer.
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
    for (index, &one) in normals.iter().enumerate() {
        for &other in &normals[index + 1..] {
            if let Some(along) = crease(one, other) {
                let foot = along * v.dot(along);
                if is_free(foot) {
                    return foot;
                }
            }
        }
    }
    P::ZERO
}
