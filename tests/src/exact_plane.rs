//! Points in the plane as integers; whether outlines are simple, convex or contain a point, from exact signs alone.
//!
//! Every question loops over all pairs, without sorting and without sweeps. Coordinates become integers times one
//! common power of two; where those are short the sums are done in i128, else in big integers.

use crate::integers::common_integers;
use glam::DVec2;
use num_bigint::BigInt;
use std::cmp::Ordering;

/// Points, each coordinate an integer in one common unit. They must be finite.
#[derive(Clone, Debug)]
pub struct ExactPlane {
    short: Option<Vec<[i128; 2]>>,
    long: Vec<[BigInt; 2]>,
}

/// How two edges of an outline meet, except where one ends and the next begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meeting {
    /// They do not.
    Apart,
    /// In one point interior to both.
    Crossing,
    /// In one point that is an end of one of them.
    Touching,
    /// In more than a point.
    Overlapping,
}

impl ExactPlane {
    /// The points, three times as large, so that the middle of any three is an integer too.
    pub fn new(points: impl IntoIterator<Item = DVec2>) -> Self {
        let flat: Vec<f64> = points.into_iter().flat_map(|point| point.to_array()).collect();
        let tripled: Vec<BigInt> = common_integers(&flat).into_iter().map(|value| value * 3).collect();
        let long: Vec<[BigInt; 2]> = tripled.chunks(2).map(|two| [two[0].clone(), two[1].clone()]).collect();
        // Differences of these, and sums of two products of differences, stay below 2^127.
        let is_short = tripled.iter().all(|value| value.bits() <= 61);
        let as_short = |pair: &[BigInt; 2]| [0, 1].map(|axis| i128::try_from(&pair[axis]).unwrap());
        Self { short: is_short.then(|| long.iter().map(as_short).collect()), long }
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.long.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.long.is_empty()
    }

    /// Adds the middle of three points, and returns its number.
    pub fn add_middle(&mut self, three: [usize; 3]) -> usize {
        let middle = |axis: usize| three.iter().map(|&i| &self.long[i][axis]).sum::<BigInt>() / 3;
        self.long.push([middle(0), middle(1)]);
        if let Some(short) = &mut self.short {
            short.push([0, 1].map(|axis| three.iter().map(|&i| short[i][axis]).sum::<i128>() / 3));
        }
        self.long.len() - 1
    }

    /// Whether c is to the left of a -> b (greater), on that line (equal), or to its right (less).
    pub fn turn(&self, a: usize, b: usize, c: usize) -> Ordering {
        if let Some(short) = &self.short {
            let [a, b, c] = [a, b, c].map(|i| short[i]);
            return ((b[0] - a[0]) * (c[1] - a[1])).cmp(&((b[1] - a[1]) * (c[0] - a[0])));
        }
        let [a, b, c] = [a, b, c].map(|i| &self.long[i]);
        ((&b[0] - &a[0]) * (&c[1] - &a[1])).cmp(&((&b[1] - &a[1]) * (&c[0] - &a[0])))
    }

    /// Whether two indices name the same place.
    pub fn same(&self, a: usize, b: usize) -> bool {
        self.order(0, a, b).is_eq() && self.order(1, a, b).is_eq()
    }

    /// How the coordinates of two points on one axis compare.
    fn order(&self, axis: usize, a: usize, b: usize) -> Ordering {
        match &self.short {
            Some(short) => short[a][axis].cmp(&short[b][axis]),
            None => self.long[a][axis].cmp(&self.long[b][axis]),
        }
    }

    /// Whether a point lies on a closed segment.
    pub fn on_segment(&self, point: usize, [a, b]: [usize; 2]) -> bool {
        let within = |axis: usize| {
            let [from_a, from_b] = [a, b].map(|end| self.order(axis, point, end));
            from_a.is_eq() || from_b.is_eq() || from_a != from_b
        };
        self.turn(a, b, point).is_eq() && within(0) && within(1)
    }

    /// How edges `first` and `second` of the outline of the first `count` points meet.
    pub fn meeting(&self, count: usize, first: usize, second: usize) -> Meeting {
        let [e, f] = [first, second].map(|edge| [edge, (edge + 1) % count]);
        self.segments(e, f)
    }

    /// How two segments meet. Ends with the same index are one end, where the segments may meet.
    pub fn segments(&self, e: [usize; 2], f: [usize; 2]) -> Meeting {
        let ends_on = |[from, to]: [usize; 2], other: [usize; 2]| {
            [from, to].into_iter().filter(|&end| self.on_segment(end, other)).collect::<Vec<usize>>()
        };
        let mut shared: Vec<usize> = ends_on(e, f);
        shared.extend(ends_on(f, e));
        shared.sort_unstable_by(|&a, &b| self.long[a].cmp(&self.long[b]));
        shared.dedup_by(|a, b| self.same(*a, *b));
        match shared[..] {
            [_, _, ..] => Meeting::Overlapping,
            [at] if e.contains(&at) && f.contains(&at) => Meeting::Apart,
            [_] => Meeting::Touching,
            [] => {
                let apart = |[from, to]: [usize; 2], [c, d]: [usize; 2]| {
                    self.turn(from, to, c) == self.turn(from, to, d)
                };
                if apart(e, f) || apart(f, e) { Meeting::Apart } else { Meeting::Crossing }
            }
        }
    }

    /// Whether the outline of the first `count` points is simple: no two vertices at one place, and no edges that meet.
    pub fn is_simple(&self, count: usize) -> bool {
        let pairs = || (0..count).flat_map(|b| (0..b).map(move |a| (a, b)));
        pairs().all(|(a, b)| !self.same(a, b))
            && pairs().all(|(a, b)| self.meeting(count, a, b) == Meeting::Apart)
    }

    /// Twice the signed area of a loop, in square units.
    pub fn doubled_area(&self, round: &[usize]) -> BigInt {
        let next = round.iter().cycle().skip(1);
        let pair = |(&a, &b): (&usize, &usize)| {
            &self.long[a][0] * &self.long[b][1] - &self.long[a][1] * &self.long[b][0]
        };
        round.iter().zip(next).map(pair).sum()
    }

    /// Whether a loop turns left at every vertex and goes around once: each side has all other vertices strictly to its
    /// left.
    pub fn is_strictly_convex(&self, round: &[usize]) -> bool {
        let n = round.len();
        n >= 3
            && (0..n).all(|i| {
                let (a, b) = (round[i], round[(i + 1) % n]);
                (2..n).all(|k| self.turn(a, b, round[(i + k) % n]).is_gt())
            })
    }

    /// Whether some side of one of two convex loops has all of the other on its outer side or on its line.
    pub fn are_disjoint_inside(&self, one: &[usize], other: &[usize]) -> bool {
        let splits = |one: &[usize], other: &[usize]| {
            let n = one.len();
            (0..n).any(|i| other.iter().all(|&p| self.turn(one[i], one[(i + 1) % n], p).is_le()))
        };
        splits(one, other) || splits(other, one)
    }

    /// Whether a point is inside a simple outline (greater), on it (equal), or outside (less), by counting crossings of
    /// a ray to the right.
    pub fn place(&self, point: usize, round: &[usize]) -> Ordering {
        let n = round.len();
        let sides = || (0..n).map(|i| [round[i], round[(i + 1) % n]]);
        if sides().any(|side| self.on_segment(point, side)) {
            return Ordering::Equal;
        }
        let is_above = |i: usize| self.order(1, i, point).is_gt();
        let crossed = sides()
            .filter(|&[a, b]| is_above(a) != is_above(b) && self.turn(a, b, point).is_gt() == is_above(b));
        if crossed.count() % 2 == 1 { Ordering::Greater } else { Ordering::Less }
    }

    /// The corners of the hull of some points, counter-clockwise from the least, by gift wrapping. Empty if they span
    /// no area.
    pub fn hull(&self, points: &[usize]) -> Vec<usize> {
        let Some(&start) = points.iter().min_by(|&&a, &&b| self.long[a].cmp(&self.long[b])) else {
            return Vec::new();
        };
        let mut hull = vec![start];
        loop {
            let at = hull[hull.len() - 1];
            let others = points.iter().copied().filter(|&p| !self.same(p, at));
            let further = |best: usize, p: usize| match self.turn(at, best, p) {
                Ordering::Less => p,
                Ordering::Equal if self.on_segment(best, [at, p]) => p,
                _ => best,
            };
            match others.reduce(further) {
                Some(next) if !self.same(next, start) => hull.push(next),
                _ => break,
            }
        }
        if hull.len() < 3 { Vec::new() } else { hull }
    }

    /// Whether a point lies in a convex loop, or within `radius` of it. The radius is the x of another of the points.
    pub fn is_within(&self, point: usize, round: &[usize], radius: usize) -> bool {
        let n = round.len();
        let limit = &self.long[radius][0] * &self.long[radius][0];
        let minus = |a: usize, b: usize| [0, 1].map(|axis| &self.long[a][axis] - &self.long[b][axis]);
        let dot = |u: &[BigInt; 2], v: &[BigInt; 2]| &u[0] * &v[0] + &u[1] * &v[1];
        (0..n).all(|i| self.turn(round[i], round[(i + 1) % n], point).is_ge())
            || (0..n).any(|i| {
                let (a, b) = (round[i], round[(i + 1) % n]);
                let (along, from_a, from_b) = (minus(b, a), minus(point, a), minus(point, b));
                if dot(&along, &from_a) <= BigInt::ZERO {
                    dot(&from_a, &from_a) <= limit
                } else if dot(&along, &from_b) >= BigInt::ZERO {
                    dot(&from_b, &from_b) <= limit
                } else {
                    let cross = &along[0] * &from_a[1] - &along[1] * &from_a[0];
                    &cross * &cross <= &limit * dot(&along, &along)
                }
            })
    }
}
