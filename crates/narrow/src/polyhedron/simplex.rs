//! The point of a simplex that is nearest to the origin.
//!
//! The corner that came last is part of what is nearest, or the step brought nothing: of the fourteen faces of a
//! tetrahedron the seven that hold it are tried. The affine nearest point of a face counts if it lies inside that
//! face, and the nearest of those wins: no tree of regions, down which rounding could lead a wrong branch. Squared
//! distances are compared, and the point is made for the winner alone.

use asunder_geometry::glam::DVec3;

/// Which corners of the simplex carry the nearest point, and with what weights (summing to one).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub(crate) point: DVec3,
    /// Bit `i` is set where corner `i` is used.
    pub(crate) corners: u8,
    pub(crate) weights: [f64; 4],
}

/// The nearest point among the faces of one to four corners that the last corner is part of, or nothing where a
/// tetrahedron holds the origin.
pub(crate) fn nearest_to_origin(corners: &[DVec3]) -> Option<Nearest> {
    if let &[a, b, c, d] = corners
        && holds_origin([a, b, c, d])
    {
        return None;
    }
    let (&last, others) = corners.split_last()?;
    let new = others.len();
    let mut best = (last.length_squared(), [(new, 1.0), (new, 0.0), (new, 0.0)]);
    for (i, &corner) in others.iter().enumerate() {
        let along = corner - last;
        let (down, length) = (-last.dot(along), along.length_squared());
        if down > 0.0 && down < length {
            let share = down / length;
            let squared = (last + along * share).length_squared();
            if squared < best.0 {
                best = (squared, [(new, 1.0 - share), (i, share), (new, 0.0)]);
            }
        }
        for (j, &other) in others.iter().enumerate().skip(i + 1) {
            let Some([u, v, w]) = triangle_weights(last, corner, other) else { continue };
            let squared = (last + along * v + (other - last) * w).length_squared();
            if squared < best.0 {
                best = (squared, [(new, u), (i, v), (j, w)]);
            }
        }
    }
    Some(weigh(corners, best.1))
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

fn triangle_weights(a: DVec3, b: DVec3, c: DVec3) -> Option<[f64; 3]> {
    let (to_b, to_c) = (b - a, c - a);
    let normal = to_b.cross(to_c);
    let area = normal.length_squared();
    let (of_b, of_c) = (to_c.cross(a).dot(normal), a.cross(to_b).dot(normal));
    if of_b > 0.0 && of_c > 0.0 && of_b + of_c < area {
        let (at_b, at_c) = (of_b / area, of_c / area);
        Some([1.0 - at_b - at_c, at_b, at_c])
    } else {
        None
    }
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
        assert_eq!(nearest(&[far, x]), Some((x, 0b10)));
        assert_eq!(nearest(&[far, x + y, x - y]), Some((x, 0b110)));
        let third = nearest(&[far, x, y, z]).unwrap();
        assert!((third.0 - DVec3::splat(1.0 / 3.0)).length() < 1e-15 && third.1 == 0b1110);
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
