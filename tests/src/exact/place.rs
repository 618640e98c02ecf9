//! Posed shapes as integers: every coordinate is rational, and one common denominator clears it.
//!
//! ```text
//! pose in space      x -> (M(q) x + |q|^2 p) / |q|^2          q in units that make it integer
//! pose in the plane  x -> (2^k [c -s; s c] x + 2^k p) / 2^k
//! part of a compound one pose after the other; denominators multiply
//! pair of pieces     A's coordinates times B's denominator and vice versa, relative to a point of A
//! ```

use crate::cores::segments;
use crate::integers::{common_integers, in_unit, last_exponent};
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use num_bigint::BigInt;

/// A point or a direction of any one dimension.
pub type Point = Vec<BigInt>;

/// A convex part of a posed body.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Everything within a radius of the hull of some points.
    Round {
        /// The points, times `denominator`.
        points: Vec<Point>,
        /// Positive.
        denominator: BigInt,
        /// The radius, not multiplied by anything.
        radius: BigInt,
    },
    /// Everything below a plane.
    Half {
        /// Outward normal, of any length.
        normal: Point,
        /// A point of the plane, times `denominator`.
        at: Point,
        /// Positive.
        denominator: BigInt,
    },
}

/// Two rounded cores in one unit, relative to a point of A.
#[derive(Clone, Debug)]
pub struct Cores {
    /// The points of A.
    pub a: Vec<Point>,
    /// The points of B.
    pub b: Vec<Point>,
    /// The sum of both radii.
    pub radius: BigInt,
}

/// An affine map of integers: x to (`matrix` x + `shift`) / `denominator`.
#[derive(Clone, Debug)]
struct Map {
    matrix: Vec<Vec<BigInt>>,
    shift: Point,
    denominator: BigInt,
}

/// Both bodies as pieces in one unit.
pub fn pieces3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> [Vec<Piece>; 2] {
    let unit = [a, b].iter().filter_map(|(shape, pose)| least_exponent3(shape, pose)).min().unwrap_or(0);
    [a, b].map(|(shape, pose)| {
        let map = Map::of_pose3(pose, unit);
        match shape {
            Shape3::Compound(compound) => (compound.parts().iter())
                .map(|part| piece3(part.shape(), &map.after(&Map::of_pose3(part.pose(), unit)), unit))
                .collect(),
            _ => vec![piece3(shape, &map, unit)],
        }
    })
}

/// Both bodies as pieces in one unit.
pub fn pieces2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> [Vec<Piece>; 2] {
    let unit = [a, b].iter().filter_map(|(shape, pose)| least_exponent2(shape, pose)).min().unwrap_or(0);
    [a, b].map(|(shape, pose)| {
        let map = Map::of_pose2(pose, unit);
        match shape {
            Shape2::Compound(compound) => (compound.parts().iter())
                .map(|part| piece2(part.shape(), &map.after(&Map::of_pose2(part.pose(), unit)), unit))
                .collect(),
            Shape2::Chain(chain) => segments(chain).map(|segment| piece2(&segment, &map, unit)).collect(),
            _ => vec![piece2(shape, &map, unit)],
        }
    })
}

fn piece3(shape: &Shape3, map: &Map, unit: i32) -> Piece {
    if let Shape3::HalfSpace(half_space) = shape {
        return half(&half_space.normal().as_dvec3().to_array(), map);
    }
    let vertices = shape.core().vertices().iter().map(|v| v.as_dvec3().to_array().to_vec()).collect();
    round(vertices, shape.radius(), map, unit)
}

fn piece2(shape: &Shape2, map: &Map, unit: i32) -> Piece {
    if let Shape2::HalfPlane(half_plane) = shape {
        return half(&half_plane.normal().as_dvec2().to_array(), map);
    }
    let vertices = shape.core().vertices().iter().map(|v| v.as_dvec2().to_array().to_vec()).collect();
    round(vertices, shape.radius(), map, unit)
}

fn round(vertices: Vec<Vec<f64>>, radius: f32, map: &Map, unit: i32) -> Piece {
    let place = |v: &Vec<f64>| map.of(&v.iter().map(|&c| in_unit(c, unit)).collect::<Point>());
    Piece::Round {
        points: vertices.iter().map(place).collect(),
        denominator: map.denominator.clone(),
        radius: in_unit(radius.into(), unit),
    }
}

fn half(normal: &[f64], map: &Map) -> Piece {
    // Both kinds of matrices keep right angles, so that a normal rotates as a direction does.
    let normal = common_integers(normal);
    let turned = map.matrix.iter().map(|row| dot(row, &normal)).collect();
    Piece::Half { normal: turned, at: map.shift.clone(), denominator: map.denominator.clone() }
}

/// The sum of products.
pub fn dot(a: &[BigInt], b: &[BigInt]) -> BigInt {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The difference of two points.
pub fn minus(a: &[BigInt], b: &[BigInt]) -> Point {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// A point times a number.
pub fn times(a: &[BigInt], by: &BigInt) -> Point {
    a.iter().map(|a| a * by).collect()
}

impl Map {
    fn of_pose3(pose: &Pose3, unit: i32) -> Self {
        let q = common_integers(&pose.rotation().to_array().map(f64::from));
        let (u, w) = (&q[..3], &q[3]);
        let norm = dot(&q, &q);
        let along = w * w - dot(u, u);
        let two = BigInt::from(2);
        let entry = |i: usize, j: usize| {
            // u u^T + (w^2 - u^2)/2 + w [u]x, twice.
            let outer = &two * &u[i] * &u[j];
            match (j + 3 - i) % 3 {
                0 => outer + &along,
                1 => outer - &two * w * &u[(i + 2) % 3],
                _ => outer + &two * w * &u[(i + 1) % 3],
            }
        };
        let position = pose.position().to_array();
        Self {
            matrix: (0..3).map(|i| (0..3).map(|j| entry(i, j)).collect()).collect(),
            shift: position.iter().map(|&p| in_unit(p, unit) * &norm).collect(),
            denominator: norm,
        }
    }

    fn of_pose2(pose: &Pose2, unit: i32) -> Self {
        // The stored matrix is used as it is: the integer that stands for 1 is its denominator.
        let entries = common_integers(&[pose.rotation().cos().into(), pose.rotation().sin().into(), 1.0]);
        let [c, s, one] = [0, 1, 2].map(|i: usize| entries[i].clone());
        let position = pose.position().to_array();
        Self {
            matrix: vec![vec![c.clone(), -&s], vec![s, c]],
            shift: position.iter().map(|&p| in_unit(p, unit) * &one).collect(),
            denominator: one,
        }
    }

    fn of(&self, point: &[BigInt]) -> Point {
        self.matrix.iter().zip(&self.shift).map(|(row, shift)| dot(row, point) + shift).collect()
    }

    /// The composition: `inner` first, then this map.
    fn after(&self, inner: &Self) -> Self {
        let dimension = self.shift.len();
        let column = |j: usize| inner.matrix.iter().map(|row| row[j].clone()).collect::<Point>();
        let columns: Vec<Point> = (0..dimension).map(column).collect();
        let row = |row: &Vec<BigInt>| columns.iter().map(|column| dot(row, column)).collect();
        let shift =
            |(row, shift): (&Vec<BigInt>, &BigInt)| dot(row, &inner.shift) + shift * &inner.denominator;
        Self {
            matrix: self.matrix.iter().map(row).collect(),
            shift: self.matrix.iter().zip(&self.shift).map(shift).collect(),
            denominator: &self.denominator * &inner.denominator,
        }
    }
}

impl Cores {
    /// Two rounded pieces in one unit; the numbers are made as short as dividing by a power of two can make them.
    pub fn new(a: (&[Point], &BigInt, &BigInt), b: (&[Point], &BigInt, &BigInt)) -> Self {
        let radius = a.2 + b.2;
        // Bodies with equal rotations have one denominator already.
        let (scale_a, scale_b, radius) = if a.1 == b.1 {
            (BigInt::from(1), BigInt::from(1), radius * a.1)
        } else {
            (b.1.clone(), a.1.clone(), radius * a.1 * b.1)
        };
        let origin = times(&a.0[0], &scale_a);
        let seen = |points: &[Point], scale: &BigInt| -> Vec<Point> {
            points.iter().map(|point| minus(&times(point, scale), &origin)).collect()
        };
        let mut cores = Self { a: seen(a.0, &scale_a), b: seen(b.0, &scale_b), radius };
        let numbers = cores.a.iter().chain(&cores.b).flatten().chain([&cores.radius]);
        if let Some(zeros) = numbers.filter_map(BigInt::trailing_zeros).min() {
            let coordinates = cores.a.iter_mut().chain(&mut cores.b).flatten();
            coordinates.chain([&mut cores.radius]).for_each(|number| *number >>= zeros);
        }
        cores
    }
}

fn least_exponent3(shape: &Shape3, pose: &Pose3) -> Option<i32> {
    let of_position = pose.position().to_array().into_iter().filter_map(last_exponent).min();
    let of_shape = match shape {
        Shape3::HalfSpace(_) => None,
        Shape3::Compound(compound) => {
            compound.parts().iter().filter_map(|part| least_exponent3(part.shape(), part.pose())).min()
        }
        _ => {
            let core = shape.core();
            let lengths = core.vertices().iter().flat_map(|v| v.to_array()).chain([shape.radius()]);
            lengths.filter_map(|length| last_exponent(length.into())).min()
        }
    };
    of_position.into_iter().chain(of_shape).min()
}

fn least_exponent2(shape: &Shape2, pose: &Pose2) -> Option<i32> {
    let of_position = pose.position().to_array().into_iter().filter_map(last_exponent).min();
    let of_shape = match shape {
        Shape2::HalfPlane(_) => None,
        Shape2::Compound(compound) => {
            compound.parts().iter().filter_map(|part| least_exponent2(part.shape(), part.pose())).min()
        }
        Shape2::Chain(chain) => {
            let lengths = chain.vertices().iter().flat_map(|v| v.to_array());
            lengths.filter_map(|length| last_exponent(length.into())).min()
        }
        _ => {
            let core = shape.core();
            let lengths = core.vertices().iter().flat_map(|v| v.to_array()).chain([shape.radius()]);
            lengths.filter_map(|length| last_exponent(length.into())).min()
        }
    };
    of_position.into_iter().chain(of_shape).min()
}
