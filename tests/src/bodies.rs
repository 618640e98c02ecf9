//! Pairs of bodies of any kind, queried as in [`answers`](crate::answers) and judged piece by piece.

use crate::answers::{Asked, ContactPoint, Manifold, Measured, Nearest, Points};
use crate::cases::{Case2, Case3, Truth};
use crate::cores::{Piece2, Piece3, pieces2, pieces3, separation_of2, separation_of3};
use crate::exact_overlap::{exact_overlap2, exact_overlap3};
use asunder_narrow::{Manifold2, Manifold3, Measured2, Measured3, Pair2, Pair3, Separation2, Separation3};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A case in space: both bodies as pieces relative to A's position, and the true separation of every pair of pieces.
#[derive(Clone, Debug)]
pub struct Bodies3 {
    case: Case3,
    a: Vec<Piece3>,
    b: Vec<Piece3>,
    truths: Vec<Truth<DVec3>>,
}

/// A case in the plane: both bodies as pieces relative to A's position, and the true separation of every pair of
/// pieces.
#[derive(Clone, Debug)]
pub struct Bodies2 {
    case: Case2,
    a: Vec<Piece2>,
    b: Vec<Piece2>,
    truths: Vec<Truth<DVec2>>,
}

/// The least of some separations, with its axis.
fn least<V: Copy>(truths: &[Truth<V>]) -> Truth<V> {
    *truths.iter().min_by(|a, b| a.separation.total_cmp(&b.separation)).unwrap()
}

/// A radius for a pair's size; an infinite shape adds nothing.
fn finite(radius: f32) -> f64 {
    if radius.is_finite() { radius.into() } else { 0.0 }
}

impl Bodies3 {
    /// Places and judges both bodies.
    pub fn new(case: Case3) -> Self {
        let origin = case.pose_a.position();
        let a = pieces3(&case.shape_a, &case.pose_a, origin);
        let b = pieces3(&case.shape_b, &case.pose_b, origin);
        let truths = a.iter().flat_map(|a| b.iter().map(move |b| separation_of3(a, b))).collect();
        Self { case, a, b, truths }
    }

    /// The case.
    pub fn case(&self) -> &Case3 {
        &self.case
    }

    /// The least separation of all pieces, and its axis.
    pub fn truth(&self) -> Truth<DVec3> {
        least(&self.truths)
    }

    /// The separation of one piece of A from one of B.
    pub fn truth_of_parts(&self, part_a: usize, part_b: usize) -> f64 {
        self.truths[part_a * self.b.len() + part_b].separation
    }

    /// What the pair's rounding is relative to: its size, the distance between the positions, and how far the shapes
    /// lie from their own origins.
    pub fn reach(&self) -> f64 {
        let Case3 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        let off_center = f64::from(shape_a.center().length()) + f64::from(shape_b.center().length());
        self.size() + (pose_b.position() - pose_a.position()).length() + off_center
    }

    /// The library's pair.
    pub fn pair(&self) -> Pair3<'_> {
        let Case3 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        Pair3::new(shape_a, pose_a, shape_b, pose_b)
    }

    fn measured(&self, separation: f32, error: f32, normal: Vec3) -> Measured {
        let (normal, limit) = (normal.as_dvec3(), f64::from(separation) + f64::from(error));
        // The axis is that of one pair of pieces: any pair that is as near as the reported distance.
        let mut gaps = vec![f64::NEG_INFINITY];
        for (a, row) in self.a.iter().zip(self.truths.chunks(self.b.len())) {
            for (b, truth) in self.b.iter().zip(row).filter(|(_, truth)| truth.separation <= limit) {
                gaps.push(truth.separation.min(a.gap_along(b, normal.normalize())));
            }
        }
        Measured {
            separation: separation.into(),
            error: error.into(),
            normal_length: normal.length(),
            gap_along_normal: gaps.into_iter().fold(f64::NEG_INFINITY, f64::max),
        }
    }

    fn points(&self, [of_a, of_b]: [&[Piece3]; 2], anchors: [Vec3; 2], normal: Vec3) -> Points {
        let [on_a, on_b] = anchors.map(|anchor| anchor.as_dvec3());
        let on_b = on_b + (self.case.pose_b.position() - self.case.pose_a.position());
        let (between, normal) = (on_b - on_a, normal.as_dvec3().normalize());
        let outside = |pieces: &[Piece3], point: DVec3| {
            pieces.iter().map(|piece| piece.outside(point)).fold(f64::INFINITY, f64::min)
        };
        Points {
            beyond_a: outside(of_a, on_a),
            beyond_b: outside(of_b, on_b),
            along_normal: between.dot(normal),
            across_normal: (between - normal * between.dot(normal)).length(),
        }
    }

    /// One of the library's manifolds, judged by the two pieces that it names.
    pub fn judged(&self, manifold: &Manifold3) -> Manifold {
        let Manifold3 { part_a, part_b, normal, separation, error, points } = manifold;
        let (a, b) = (&self.a[*part_a as usize], &self.b[*part_b as usize]);
        let pieces = [core::slice::from_ref(a), core::slice::from_ref(b)];
        let contacts = points.iter().map(|point| ContactPoint {
            separation: point.separation.into(),
            points: self.points(pieces, [point.anchor_a, point.anchor_b], *normal),
            feature: point.feature.to_bits(),
        });
        let measured = Measured {
            gap_along_normal: a.gap_along(b, normal.as_dvec3().normalize()),
            ..self.measured(*separation, *error, *normal)
        };
        Manifold { measured, contacts: contacts.collect() }
    }
}

impl Asked for Bodies3 {
    fn size(&self) -> f64 {
        finite(self.case.shape_a.outer_radius()) + finite(self.case.shape_b.outer_radius())
    }

    fn true_separation(&self) -> f64 {
        self.truth().separation
    }

    /// For sharp, bounded, convex shapes only.
    fn exactly_overlaps(&self) -> bool {
        let Case3 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        exact_overlap3((shape_a, pose_a), (shape_b, pose_b))
    }

    fn swapped(&self) -> Self {
        Self::new(self.case.swapped())
    }

    fn overlaps(&self) -> bool {
        self.pair().overlaps()
    }

    fn separation(&self, limit: f32) -> Result<Measured, f32> {
        match self.pair().separation(limit) {
            Separation3::Measured(Measured3 { separation, error, normal }) => {
                Ok(self.measured(separation, error, normal))
            }
            Separation3::AtLeast(bound) => Err(bound),
        }
    }

    fn distance(&self) -> Option<Nearest> {
        let closest = self.pair().distance()?;
        Some(Nearest {
            measured: self.measured(closest.distance, closest.error, closest.normal),
            points: self.points([&self.a, &self.b], [closest.anchor_a, closest.anchor_b], closest.normal),
        })
    }

    fn manifold(&self, margin: f32) -> Option<Manifold> {
        Some(self.judged(&self.pair().manifold(margin)?))
    }
}

impl Bodies2 {
    /// Places and judges both bodies.
    pub fn new(case: Case2) -> Self {
        let origin = case.pose_a.position();
        let a = pieces2(&case.shape_a, &case.pose_a, origin);
        let b = pieces2(&case.shape_b, &case.pose_b, origin);
        let truths = a.iter().flat_map(|a| b.iter().map(move |b| separation_of2(a, b))).collect();
        Self { case, a, b, truths }
    }

    /// The case.
    pub fn case(&self) -> &Case2 {
        &self.case
    }

    /// The least separation of all pieces, and its axis.
    pub fn truth(&self) -> Truth<DVec2> {
        least(&self.truths)
    }

    /// The separation of one piece of A from one of B.
    pub fn truth_of_parts(&self, part_a: usize, part_b: usize) -> f64 {
        self.truths[part_a * self.b.len() + part_b].separation
    }

    /// What the pair's rounding is relative to: its size, the distance between the positions, and how far the shapes
    /// lie from their own origins.
    pub fn reach(&self) -> f64 {
        let Case2 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        let off_center = f64::from(shape_a.center().length()) + f64::from(shape_b.center().length());
        self.size() + (pose_b.position() - pose_a.position()).length() + off_center
    }

    /// The library's pair.
    pub fn pair(&self) -> Pair2<'_> {
        let Case2 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        Pair2::new(shape_a, pose_a, shape_b, pose_b)
    }

    fn measured(&self, separation: f32, error: f32, normal: Vec2) -> Measured {
        let (normal, limit) = (normal.as_dvec2(), f64::from(separation) + f64::from(error));
        // The axis is that of one pair of pieces: any pair that is as near as the reported distance.
        let mut gaps = vec![f64::NEG_INFINITY];
        for (a, row) in self.a.iter().zip(self.truths.chunks(self.b.len())) {
            for (b, truth) in self.b.iter().zip(row).filter(|(_, truth)| truth.separation <= limit) {
                gaps.push(truth.separation.min(a.gap_along(b, normal.normalize())));
            }
        }
        Measured {
            separation: separation.into(),
            error: error.into(),
            normal_length: normal.length(),
            gap_along_normal: gaps.into_iter().fold(f64::NEG_INFINITY, f64::max),
        }
    }

    fn points(&self, [of_a, of_b]: [&[Piece2]; 2], anchors: [Vec2; 2], normal: Vec2) -> Points {
        let [on_a, on_b] = anchors.map(|anchor| anchor.as_dvec2());
        let on_b = on_b + (self.case.pose_b.position() - self.case.pose_a.position());
        let (between, normal) = (on_b - on_a, normal.as_dvec2().normalize());
        let outside = |pieces: &[Piece2], point: DVec2| {
            pieces.iter().map(|piece| piece.outside(point)).fold(f64::INFINITY, f64::min)
        };
        Points {
            beyond_a: outside(of_a, on_a),
            beyond_b: outside(of_b, on_b),
            along_normal: between.dot(normal),
            across_normal: (between - normal * between.dot(normal)).length(),
        }
    }

    /// One of the library's manifolds, judged by the two pieces that it names.
    pub fn judged(&self, manifold: &Manifold2) -> Manifold {
        let Manifold2 { part_a, part_b, normal, separation, error, points } = manifold;
        let (a, b) = (&self.a[*part_a as usize], &self.b[*part_b as usize]);
        let pieces = [core::slice::from_ref(a), core::slice::from_ref(b)];
        let contacts = points.iter().map(|point| ContactPoint {
            separation: point.separation.into(),
            points: self.points(pieces, [point.anchor_a, point.anchor_b], *normal),
            feature: point.feature.to_bits(),
        });
        let measured = Measured {
            gap_along_normal: a.gap_along(b, normal.as_dvec2().normalize()),
            ..self.measured(*separation, *error, *normal)
        };
        Manifold { measured, contacts: contacts.collect() }
    }
}

impl Asked for Bodies2 {
    fn size(&self) -> f64 {
        finite(self.case.shape_a.outer_radius()) + finite(self.case.shape_b.outer_radius())
    }

    fn true_separation(&self) -> f64 {
        self.truth().separation
    }

    /// For sharp, bounded, convex shapes only.
    fn exactly_overlaps(&self) -> bool {
        let Case2 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        exact_overlap2((shape_a, pose_a), (shape_b, pose_b))
    }

    fn swapped(&self) -> Self {
        Self::new(self.case.swapped())
    }

    fn overlaps(&self) -> bool {
        self.pair().overlaps()
    }

    fn separation(&self, limit: f32) -> Result<Measured, f32> {
        match self.pair().separation(limit) {
            Separation2::Measured(Measured2 { separation, error, normal }) => {
                Ok(self.measured(separation, error, normal))
            }
            Separation2::AtLeast(bound) => Err(bound),
        }
    }

    fn distance(&self) -> Option<Nearest> {
        let closest = self.pair().distance()?;
        Some(Nearest {
            measured: self.measured(closest.distance, closest.error, closest.normal),
            points: self.points([&self.a, &self.b], [closest.anchor_a, closest.anchor_b], closest.normal),
        })
    }

    fn manifold(&self, margin: f32) -> Option<Manifold> {
        Some(self.judged(&self.pair().manifold(margin)?))
    }
}
