//! The point of a simplex that is nearest to the origin.
//!
//! The corner that came last is part of the nearest feature, or the step brought nothing: of the fifteen features of a
//! tetrahedron (corners, edges, faces and itself), only the eight that contain it can be nearest.
//!
//! ```text
//! four corners    the origin is on the inner side of all faces: inside
//!                 a triangle with the origin on its outer side and over its interior: that triangle
//! three corners   the triangle, if the origin is over its interior
//! else            of the edges from the last corner, the one that leads the furthest towards the origin
//! else            that corner
//! ```
//! The first that fits is taken ([`nearest_to_origin`]). Where the corners are degenerate up to rounding, that may be
//! the wrong one, and the iteration comes no nearer: then all that fit are compared ([`nearest_of_all`]), and no branch
//! can choose wrongly.

use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;

/// Up to four corners, the newest last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners {
    pub(crate) places: [DVec3; 4],
    pub(crate) count: usize,
}

/// Which corners of the simplex carry the nearest point, and with what weights (summing to one).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub(crate) point: DVec3,
    /// The first `count` of these, ascending.
    pub(crate) picks: [usize; 3],
    pub(crate) weights: [f64; 3],
    pub(crate) count: usize,
}

/// A feature that contains the last corner, by its other corners and their weights, and how many those are.
type Found = ([(usize, f64); 2], usize);

impl Corners {
    #[inline(always)]
    fn last(&self) -> (usize, DVec3) {
        let last = (self.count - 1) & 3;
        (last, self.places[last])
    }

    /// From the last corner to another.
    #[inline(always)]
    fn along(&self, corner: usize) -> DVec3 {
        self.places[corner] - self.last().1
    }

    /// The point of a feature: the last corner plus the weighted vectors to the others.
    #[inline(always)]
    fn weigh(&self, ([(i, of_i), (j, of_j)], count): Found) -> Nearest {
        let (new, last) = self.last();
        match count {
            0 => Nearest { point: last, picks: [new, 0, 0], weights: [1.0, 0.0, 0.0], count: 1 },
            1 => {
                let point = last + self.along(i) * of_i;
                Nearest { point, picks: [i, new, 0], weights: [of_i, 1.0 - of_i, 0.0], count: 2 }
            }
            _ => {
                let point = last + self.along(i) * of_i + self.along(j) * of_j;
                Nearest { point, picks: [i, j, new], weights: [of_i, of_j, 1.0 - of_i - of_j], count: 3 }
            }
        }
    }

    /// The parameter of the point nearest to the origin on the edge to another corner, if that lies within the edge;
    /// and by how much its squared distance is less than the last corner's.
    #[inline(always)]
    fn edge(&self, corner: usize) -> Option<(f64, f64)> {
        let along = self.along(corner);
        let (down, length) = (-self.last().1.dot(along), along.length_squared());
        (down > 0.0 && down < length).then(|| (down / length, down * (down / length)))
    }

    /// The edge that leads the furthest towards the origin, or the last corner.
    #[inline(always)]
    fn best_edge(&self) -> Found {
        let mut best = (0.0, ([(0, 0.0); 2], 0));
        for corner in 0..self.count - 1 {
            if let Some((share, gain)) = self.edge(corner)
                && gain > best.0
            {
                best = (gain, ([(corner, share), (0, 0.0)], 1));
            }
        }
        best.1
    }

    /// The triangle with two other corners, given a normal of it, if the origin is over its interior.
    #[inline(always)]
    fn triangle(&self, [i, j]: [usize; 2], normal: DVec3) -> Option<Found> {
        let last = self.last().1;
        let (to_i, to_j) = (self.along(i), self.along(j));
        let area = normal.length_squared();
        let (of_i, of_j) = (to_j.cross(last).dot(normal), last.cross(to_i).dot(normal));
        let is_over = of_i > 0.0 && of_j > 0.0 && of_i + of_j < area;
        is_over.then(|| ([(i, of_i / area), (j, of_j / area)], 2))
    }

    /// The nearest point of an edge or a triangle, given its corners in ascending order, if the origin is over its
    /// interior; computed relative to the corner that is nearest.
    fn over_face(&self, face: &[usize]) -> Option<Nearest> {
        let length = |&corner: &usize| self.places[corner].length_squared();
        let mut order: ArrayVec<usize, 3> = face.iter().copied().collect();
        order.sort_by(|one, other| length(other).total_cmp(&length(one)));
        let mut turned = Corners { places: [DVec3::ZERO; 4], count: order.len() };
        for (place, &corner) in turned.places.iter_mut().zip(&order) {
            *place = self.places[corner];
        }
        let found = match order.len() {
            2 => turned.edge(0).map(|(share, _)| ([(0, share), (0, 0.0)], 1)),
            _ => turned.triangle([0, 1], turned.along(0).cross(turned.along(1))),
        };
        let mut nearest = turned.weigh(found?);
        let weights = nearest.weights;
        for (i, corner) in face.iter().enumerate() {
            nearest.picks[i] = *corner;
            nearest.weights[i] = order.iter().position(|it| it == corner).map_or(0.0, |at| weights[at]);
        }
        Some(nearest)
    }
}

/// The nearest point among the features of one to four corners that contain the last corner; `None` where a tetrahedron
/// holds the origin.
#[inline]
pub(crate) fn nearest_to_origin(corners: &Corners) -> Option<Nearest> {
    let found = match corners.count {
        ..2 => ([(0, 0.0); 2], 0),
        2 => corners.best_edge(),
        3 => {
            let normal = corners.along(0).cross(corners.along(1));
            corners.triangle([0, 1], normal).unwrap_or_else(|| corners.best_edge())
        }
        _ => of_four(corners)?,
    };
    Some(corners.weigh(found))
}

/// [`nearest_to_origin`] of a tetrahedron; `None` where the origin is in it.
#[inline(always)]
fn of_four(corners: &Corners) -> Option<Found> {
    const SIDES: [[usize; 2]; 3] = [[0, 1], [1, 2], [0, 2]];
    let normals = SIDES.map(|[i, j]| corners.along(i).cross(corners.along(j)));
    let whole = normals[0].dot(corners.along(2));
    // The origin's barycentric coordinate for the corner opposite each side, times the square of the whole volume.
    let share = |side: usize, whole: f64| -normals[side].dot(corners.last().1) * whole;
    let shares = [share(0, whole), share(1, whole), share(2, -whole)];
    let is_inside = shares.iter().all(|&share| share > 0.0) && shares.iter().sum::<f64>() < whole * whole;
    if is_inside {
        return None;
    }
    for n in 0..3 {
        if shares[n] <= 0.0
            && let Some(found) = corners.triangle(SIDES[n], normals[n])
        {
            return Some(found);
        }
    }
    Some(corners.best_edge())
}

/// [`nearest_to_origin`] by comparing squared distances: the nearest one, whatever rounding does to sides.
///
/// Each feature is computed relative to its corner nearest to the origin: the rounding of a last corner that is far
/// away may exceed the progress of a step. For plates of a millionth of their width, edge to edge, the iteration
/// stopped 1.35e-6 m from the origin that they touch.
#[cold]
pub(crate) fn nearest_of_all(corners: &Corners) -> Nearest {
    let last = corners.last().0;
    let mut best = corners.weigh(([(0, 0.0); 2], 0));
    let mut offer = |face: &[usize]| {
        if let Some(nearest) = corners.over_face(face)
            && nearest.point.length_squared() < best.point.length_squared()
        {
            best = nearest;
        }
    };
    for i in 0..last {
        offer(&[i, last]);
        for j in i + 1..last {
            offer(&[i, j, last]);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Numbers;

    fn corners(places: &[DVec3]) -> Corners {
        let mut corners = Corners { places: [DVec3::ZERO; 4], count: places.len() };
        corners.places[..places.len()].copy_from_slice(places);
        corners
    }

    /// The distance of one face's interior by another method: least squares of its weights; `None` where a weight is
    /// negative.
    fn nearest_of_face(places: &[DVec3]) -> Option<f64> {
        let first = places[0];
        let edges: Vec<DVec3> = places[1..].iter().map(|&place| place - first).collect();
        // Gram-Schmidt, then back substitution.
        let mut rest = -first;
        let (mut axes, mut shares) = (Vec::<DVec3>::new(), Vec::new());
        for &edge in &edges {
            let axis =
                axes.iter().fold(edge, |axis, known| axis - *known * axis.dot(*known)).try_normalize()?;
            let share = rest.dot(axis);
            rest -= axis * share;
            axes.push(axis);
            shares.push(share);
        }
        let mut weights = vec![0.0; edges.len()];
        for i in (0..edges.len()).rev() {
            let others: f64 = (i + 1..edges.len()).map(|j| weights[j] * edges[j].dot(axes[i])).sum();
            weights[i] = (shares[i] - others) / edges[i].dot(axes[i]);
        }
        let is_inside = weights.iter().all(|&weight| weight >= 0.0) && weights.iter().sum::<f64>() <= 1.0;
        is_inside.then(|| rest.length())
    }

    /// The least over all faces.
    fn distance(places: &[DVec3]) -> f64 {
        let faces = (1_usize..1 << places.len()).map(|face| {
            (0..places.len()).filter(|i| face >> i & 1 == 1).map(|i| places[i]).collect::<Vec<_>>()
        });
        faces.filter_map(|face| nearest_of_face(&face)).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn each_kind_of_face_can_be_nearest() {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        let far = DVec3::splat(5.0);
        let nearest = |places: &[DVec3]| {
            nearest_to_origin(&corners(places)).map(|it| (it.point, it.picks[..it.count].to_vec()))
        };
        assert_eq!(nearest(&[far, x]), Some((x, vec![1])));
        assert_eq!(nearest(&[far, x + y, x - y]), Some((x, vec![1, 2])));
        let (point, picks) = nearest(&[far, x, y, z]).unwrap();
        assert!((point - DVec3::splat(1.0 / 3.0)).length() < 1e-15 && picks == [1, 2, 3]);
        assert_eq!(nearest(&[x, y, z, DVec3::splat(-1.0)]), None);
    }

    #[test]
    fn degenerate_simplices_fall_back_to_their_corners() {
        let same = corners(&[DVec3::X; 4]);
        assert_eq!(nearest_to_origin(&same).map(|it| it.point), Some(DVec3::X));
        assert_eq!(nearest_of_all(&same).point, DVec3::X);
        let line = [DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, 3.0, 0.0)];
        assert_eq!(nearest_to_origin(&corners(&line)).map(|it| it.point), Some(DVec3::X));
        assert_eq!(nearest_of_all(&corners(&line)).point, DVec3::X);
    }

    #[test]
    fn the_first_that_fits_is_the_nearest_and_that_of_all_faces() {
        let mut numbers = Numbers::new(31);
        let (mut kinds, mut inside, mut beside) = ([0; 5], 0, 0);
        for round in 0..40_000 {
            let count = 1 + round % 4;
            // Some of them flat, some around the origin.
            let flat = DVec3::new(1.0, 1.0, [1.0, 1e-2][round / 4 % 2]);
            let away = DVec3::new(0.3, 0.2, 0.4) * (round / 8 % 3) as f64;
            let places: Vec<DVec3> = (0..count).map(|_| numbers.vector() * flat + away).collect();
            let (truth, without) = (distance(&places), distance(&places[..count - 1]));
            let corners = corners(&places);
            let Some(nearest) = nearest_to_origin(&corners) else {
                assert!(count == 4 && truth < 1e-12, "round {round}: {truth}");
                inside += 1;
                continue;
            };
            let weighed = (0..nearest.count).map(|i| places[nearest.picks[i]] * nearest.weights[i]);
            let sum: f64 = nearest.weights[..nearest.count].iter().sum();
            assert!((weighed.sum::<DVec3>() - nearest.point).length() < 1e-12 && (sum - 1.0).abs() < 1e-12);
            // Where the last corner brought nothing, the answer is not used.
            if count > 1 && truth >= without * (1.0 - 1e-9) {
                beside += 1;
                continue;
            }
            assert!((nearest.point.length() - truth).abs() < 1e-9, "round {round}: {nearest:?} for {truth}");
            assert!(nearest.picks[..nearest.count].contains(&(count - 1)), "round {round}");
            let of_all = nearest_of_all(&corners).point;
            assert!((of_all - nearest.point).length() < 1e-9, "round {round}: {of_all} for {nearest:?}");
            kinds[nearest.count] += 1;
        }
        assert!(
            kinds[1..=3].iter().all(|&count| count > 1000) && inside > 100 && beside > 1000,
            "{kinds:?}, {inside}, {beside}"
        );
    }
}
