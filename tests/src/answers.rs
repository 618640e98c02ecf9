//! What the narrow phase reports for a case, with its normals and points measured by full projections of our own.
//!
//! One set of plain numbers for both dimensions, so that each claim is checked in one place.

use crate::cases::{Case2, Case3, truth2, truth3};
use crate::exact_overlap::{exact_overlap2, exact_overlap3};
use crate::exhaustive_sat::{gap2, gap3};
use crate::placed::{Placed2, Placed3};
use asunder_narrow::{Manifold2, Manifold3, Measured2, Measured3, Pair2, Pair3, Separation2, Separation3};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A pair of posed shapes in either dimension, and all queries about it.
pub trait Asked: core::fmt::Debug + Sized {
    /// The sum of the two bounding radii, in metres.
    fn size(&self) -> f64;
    /// The separation by the oracles, in metres.
    fn true_separation(&self) -> f64;
    /// Whether they overlap by exact arithmetic.
    fn exactly_overlaps(&self) -> bool;
    /// The pair with A and B swapped.
    fn swapped(&self) -> Self;
    /// Whether the library reports that the shapes share a point.
    fn overlaps(&self) -> bool;
    /// `separation(limit)`: the measured answer, or the bound.
    fn separation(&self, limit: f32) -> Result<Measured, f32>;
    /// `distance()`.
    fn distance(&self) -> Option<Nearest>;
    /// `manifold(margin)`.
    fn manifold(&self, margin: f32) -> Option<Manifold>;
}

/// A reported separation or distance with its normal.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// As reported, in metres.
    pub separation: f64,
    /// As reported, in metres.
    pub error: f64,
    /// Length of the reported normal.
    pub normal_length: f64,
    /// Our own gap between the projections on the reported normal, normalised.
    pub gap_along_normal: f64,
}

/// Two reported points, one of each shape.
#[derive(Clone, Copy, Debug)]
pub struct Points {
    /// How far A's point lies outside A, in metres: at most 0 inside.
    pub beyond_a: f64,
    /// How far B's point lies outside B, in metres.
    pub beyond_b: f64,
    /// From A's point to B's along the normal.
    pub along_normal: f64,
    /// From A's point to B's across the normal.
    pub across_normal: f64,
}

/// A reported pair of closest points.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// The distance and its normal.
    pub measured: Measured,
    /// The points.
    pub points: Points,
}

/// A reported manifold.
#[derive(Clone, Debug)]
pub struct Manifold {
    /// The separation and its normal.
    pub measured: Measured,
    /// The contacts.
    pub contacts: Vec<ContactPoint>,
}

/// A reported contact point.
#[derive(Clone, Copy, Debug)]
pub struct ContactPoint {
    /// As reported, in metres.
    pub separation: f64,
    /// Where it is.
    pub points: Points,
    /// The bits of its feature id.
    pub feature: u64,
}

/// A case in space with both shapes placed by the oracles.
#[derive(Clone, Debug)]
pub struct Asked3 {
    case: Case3,
    a: Placed3,
    b: Placed3,
}

impl Asked3 {
    /// Places both shapes.
    pub fn new(case: Case3) -> Self {
        let (a, b) = case.placed();
        Self { case, a, b }
    }

    /// The case.
    pub fn case(&self) -> &Case3 {
        &self.case
    }

    fn pair(&self) -> Pair3<'_> {
        let Case3 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        Pair3::new(shape_a, pose_a, shape_b, pose_b)
    }

    fn measured(&self, separation: f32, error: f32, normal: Vec3) -> Measured {
        let normal = normal.as_dvec3();
        Measured {
            separation: separation.into(),
            error: error.into(),
            normal_length: normal.length(),
            gap_along_normal: gap3(&self.a, &self.b, normal.normalize()),
        }
    }

    fn points(&self, anchor_a: Vec3, anchor_b: Vec3, normal: Vec3) -> Points {
        // The oracles work relative to A's position.
        let on_a = anchor_a.as_dvec3();
        let on_b = anchor_b.as_dvec3() + (self.case.pose_b.position() - self.case.pose_a.position());
        let (between, normal) = (on_b - on_a, normal.as_dvec3().normalize());
        let along: DVec3 = normal * between.dot(normal);
        Points {
            beyond_a: self.a.excess(on_a),
            beyond_b: self.b.excess(on_b),
            along_normal: between.dot(normal),
            across_normal: (between - along).length(),
        }
    }

    fn of_manifold(&self, manifold: &Manifold3) -> Manifold {
        let Manifold3 { normal, separation, error, points, .. } = manifold;
        let contacts = points.iter().map(|point| ContactPoint {
            separation: point.separation.into(),
            points: self.points(point.anchor_a, point.anchor_b, *normal),
            feature: point.feature.to_bits(),
        });
        Manifold { measured: self.measured(*separation, *error, *normal), contacts: contacts.collect() }
    }
}

impl Asked for Asked3 {
    fn size(&self) -> f64 {
        self.case.size()
    }

    fn true_separation(&self) -> f64 {
        truth3(&self.a, &self.b).separation
    }

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
            points: self.points(closest.anchor_a, closest.anchor_b, closest.normal),
        })
    }

    fn manifold(&self, margin: f32) -> Option<Manifold> {
        Some(self.of_manifold(&self.pair().manifold(margin)?))
    }
}

/// A case in the plane with both shapes placed by the oracles.
#[derive(Clone, Debug)]
pub struct Asked2 {
    case: Case2,
    a: Placed2,
    b: Placed2,
}

impl Asked2 {
    /// Places both shapes.
    pub fn new(case: Case2) -> Self {
        let (a, b) = case.placed();
        Self { case, a, b }
    }

    /// The case.
    pub fn case(&self) -> &Case2 {
        &self.case
    }

    fn pair(&self) -> Pair2<'_> {
        let Case2 { shape_a, pose_a, shape_b, pose_b } = &self.case;
        Pair2::new(shape_a, pose_a, shape_b, pose_b)
    }

    fn measured(&self, separation: f32, error: f32, normal: Vec2) -> Measured {
        let normal = normal.as_dvec2();
        Measured {
            separation: separation.into(),
            error: error.into(),
            normal_length: normal.length(),
            gap_along_normal: gap2(&self.a, &self.b, normal.normalize()),
        }
    }

    fn points(&self, anchor_a: Vec2, anchor_b: Vec2, normal: Vec2) -> Points {
        // The oracles work relative to A's position.
        let on_a = anchor_a.as_dvec2();
        let on_b = anchor_b.as_dvec2() + (self.case.pose_b.position() - self.case.pose_a.position());
        let (between, normal) = (on_b - on_a, normal.as_dvec2().normalize());
        let along: DVec2 = normal * between.dot(normal);
        Points {
            beyond_a: self.a.excess(on_a),
            beyond_b: self.b.excess(on_b),
            along_normal: between.dot(normal),
            across_normal: (between - along).length(),
        }
    }

    fn of_manifold(&self, manifold: &Manifold2) -> Manifold {
        let Manifold2 { normal, separation, error, points, .. } = manifold;
        let contacts = points.iter().map(|point| ContactPoint {
            separation: point.separation.into(),
            points: self.points(point.anchor_a, point.anchor_b, *normal),
            feature: point.feature.to_bits(),
        });
        Manifold { measured: self.measured(*separation, *error, *normal), contacts: contacts.collect() }
    }
}

impl Asked for Asked2 {
    fn size(&self) -> f64 {
        self.case.size()
    }

    fn true_separation(&self) -> f64 {
        truth2(&self.a, &self.b).separation
    }

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
            points: self.points(closest.anchor_a, closest.anchor_b, closest.normal),
        })
    }

    fn manifold(&self, margin: f32) -> Option<Manifold> {
        Some(self.of_manifold(&self.pair().manifold(margin)?))
    }
}
