//! The point of a simplex that is nearest to the origin.
//!
//! Every face of the simplex of one to three corners is tried: its affine nearest point counts if it lies inside
//! that face, and the nearest of those wins. Fourteen small cases in place of a tree of regions; exhaustive, so that
//! no rounding can lead down a wrong branch.

use asunder_geometry::glam::DVec3;

/// Which corners of the simplex carry the nearest point, and with what weights (summing to one).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub(crate) point: DVec3,
    /// Bit `i` is set where corner `i` is used.
    pub(crate) corners: u8,
    pub(crate) weights: [f64; 4],
}

/// The nearest point of the hull of one to four corners, or nothing where a tetrahedron holds the origin.
pub(crate) fn nearest_to_origin(corners: &[DVec3]) -> Option<Nearest> {
    if corners.len() == 4 && holds_origin([corners[0], corners[1], corners[2], corners[3]]) {
        return None;
    }
    let mut best: Option<Nearest> = None;
    let mut offer = |candidate: Nearest| {
        if best.is_none_or(|best| candidate.point.length_squared() < best.point.length_squared()) {
            best = Some(candidate);
        }
    };
    for i in 0..corners.len() {
        offer(weigh(corners, [(i, 1.0), (i, 0.0), (i, 0.0)]));
        for j in i + 1..corners.len() {
            if let Some([u, v]) = segment_weights(corners[i], corners[j]) {
                offer(weigh(corners, [(i, u), (j, v), (i, 0.0)]));
            }
            for k in j + 1..corners.len() {
                if let Some([u, v, w]) = triangle_weights(corners[i], corners[j], corners[k]) {
                    offer(weigh(corners, [(i, u), (j, v), (k, w)]));
                }
            }
        }
    }
    best
}

fn weigh(corners: &[DVec3], terms: [(usize, f64); 3]) -> Nearest {
    let first = corners[terms[0].0];
    let mut nearest = Nearest { point: first, corners: 0, weights: [0.0; 4] };
    for (i, weight) in terms {
        if weight > 0.0 {
            nearest.point += (corners[i] - first) * weight;
            nearest.corners |= 1 << i;
            nearest.weights[i] += weight;
        }
    }
    nearest
}

fn segment_weights(a: DVec3, b: DVec3) -> Option<[f64; 2]> {
    let along = b - a;
    let t = -a.dot(along) / along.length_squared();
    (t > 0.0 && t < 1.0).then_some([1.0 - t, t])
}

fn triangle_weights(a: DVec3, b: DVec3, c: DVec3) -> Option<[f64; 3]> {
    let (to_b, to_c) = (b - a, c - a);
    let normal = to_b.cross(to_c);
    let area = normal.length_squared();
    let (at_b, at_c) = (to_c.cross(a).dot(normal) / area, a.cross(to_b).dot(normal) / area);
    let weights = [1.0 - at_b - at_c, at_b, at_c];
    weights.iter().all(|&weight| weight > 0.0).then_some(weights)
}

fn holds_origin([a, b, c, d]: [DVec3; 4]) -> bool {
    let volume = |p: DVec3, q: DVec3, r: DVec3, s: DVec3| (q - p).cross(r - p).dot(s - p);
    let whole = volume(a, b, c, d);
    let parts = [
        volume(DVec3::ZERO, b, c, d),
        volume(a, DVec3::ZERO, c, d),
        volume(a, b, DVec3::ZERO, d),
        volume(a, b, c, DVec3::ZERO),
    ];
    whole != 0.0 && parts.iter().all(|part| part * whole > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_face_can_be_nearest() {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        let far = DVec3::splat(5.0);
        let nearest = |corners: &[DVec3]| nearest_to_origin(corners).map(|n| (n.point, n.corners));
        assert_eq!(nearest(&[x, far]), Some((x, 0b01)));
        assert_eq!(nearest(&[x + y, x - y, far]), Some((x, 0b011)));
        let third = nearest(&[x, y, z, far]).unwrap();
        assert!((third.0 - DVec3::splat(1.0 / 3.0)).length() < 1e-15 && third.1 == 0b0111);
        assert_eq!(nearest(&[x, y, z, DVec3::splat(-1.0)]), None);
    }

    #[test]
    fn degenerate_simplices_fall_back_to_their_corners() {
        let same = [DVec3::X; 4];
        assert_eq!(nearest_to_origin(&same).map(|n| n.point), Some(DVec3::X));
        let line = [DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, 3.0, 0.0)];
        assert_eq!(nearest_to_origin(&line).map(|n| n.point), Some(DVec3::X));
    }
}
