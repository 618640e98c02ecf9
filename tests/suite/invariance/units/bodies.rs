//! Shapes and poses in other units of length: every number times a power of two, or `None` where a bit would be lost.

use asunder_geometry::tolerance::MAX_POSITION;
use asunder_geometry::{
    Capsule2, Capsule3, Chain, Circle, Compound2, Compound3, Cuboid, Hull, Polygon, Pose2, Pose3, Rect,
    Segment2, Segment3, Shape2, Shape3, Sphere, TriMesh, Triangle3,
};
use asunder_tests::cases::{Case2, Case3};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// 2^k, exactly.
pub(super) fn power_of_two(k: i32) -> f64 {
    f64::from_bits(((1023 + i64::from(k)) as u64) << 52)
}

/// The same value in units of 2^-k metres.
pub(super) trait InUnits: Sized {
    /// `None` where a number would be rounded, or a shape rejected.
    fn in_units(&self, k: i32) -> Option<Self>;
}

impl InUnits for f32 {
    fn in_units(&self, k: i32) -> Option<Self> {
        let product = f64::from(*self) * power_of_two(k);
        let value = product as f32;
        // Intermediate subnormals would lose bits, since their squares are needed.
        let is_whole = f64::from(value) == product && (value == 0.0 || value.abs() >= f32::MIN_POSITIVE);
        is_whole.then_some(value)
    }
}

/// Subnormals would lose bits, and so would values below the least normal f32, since answers are f32.
fn coordinate(value: f64, k: i32) -> Option<f64> {
    let least = f64::from(f32::MIN_POSITIVE);
    let product = value * power_of_two(k);
    (value == 0.0 || value.abs().min(product.abs()) >= least).then_some(product)
}

fn vectors3(points: &[Vec3], k: i32) -> Option<Vec<Vec3>> {
    points.iter().map(|p| Some(Vec3::new(p.x.in_units(k)?, p.y.in_units(k)?, p.z.in_units(k)?))).collect()
}

fn vectors2(points: &[Vec2], k: i32) -> Option<Vec<Vec2>> {
    points.iter().map(|p| Some(Vec2::new(p.x.in_units(k)?, p.y.in_units(k)?))).collect()
}

impl InUnits for Pose3 {
    fn in_units(&self, k: i32) -> Option<Self> {
        let [x, y, z] = self.position().to_array().map(|x| coordinate(x, k));
        Self::new(DVec3::new(x?, y?, z?), self.rotation()).ok()
    }
}

impl InUnits for Pose2 {
    fn in_units(&self, k: i32) -> Option<Self> {
        let [x, y] = self.position().to_array().map(|x| coordinate(x, k));
        Self::new(DVec2::new(x?, y?), self.rotation()).ok()
    }
}

impl InUnits for Shape3 {
    fn in_units(&self, k: i32) -> Option<Self> {
        let vertices = vectors3(self.core().vertices(), k)?;
        let radius = self.radius().in_units(k)?;
        Some(match self {
            Self::Sphere(_) => Sphere::new(radius).ok()?.into(),
            Self::Capsule(_) => Capsule3::new(vertices[0], vertices[1], radius).ok()?.into(),
            Self::Cuboid(cuboid) => {
                let half = vectors3(&[cuboid.half_extents()], k)?[0];
                Cuboid::from_half_extents(half).ok()?.rounded(radius).ok()?.into()
            }
            // The core of a rounded point has the least possible radius, which is a limit in metres.
            Self::Hull(hull) if hull.dimension() == 0 => return None,
            Self::Hull(_) => {
                let hull = Hull::of_any_dimension(&vertices).ok()?;
                // In the same order as before, or feature ids could not be compared. Built from its own vertices a hull
                // keeps it.
                if k != 0 {
                    assert_eq!(hull.vertices(), vertices, "2^{k} changes a hull");
                }
                hull.rounded(radius).ok()?.into()
            }
            Self::HalfSpace(half_space) => (*half_space).into(),
            Self::Triangle(_) => Triangle3::new(vertices[0], vertices[1], vertices[2]).ok()?.into(),
            Self::Segment(_) => Segment3::new(vertices[0], vertices[1]).ok()?.into(),
            Self::TriMesh(mesh) => {
                let vertices = vectors3(mesh.vertices(), k)?;
                TriMesh::new(vertices, mesh.triangles()).ok()?.into()
            }
            Self::HeightField(_) => return None,
            Self::Compound(compound) => {
                let parts = compound.parts().iter();
                let parts = parts.map(|part| Some((part.pose().in_units(k)?, part.shape().in_units(k)?)));
                Compound3::new(parts.collect::<Option<Vec<_>>>()?).ok()?.into()
            }
        })
    }
}

impl InUnits for Shape2 {
    fn in_units(&self, k: i32) -> Option<Self> {
        let vertices = vectors2(self.core().vertices(), k)?;
        let radius = self.radius().in_units(k)?;
        Some(match self {
            Self::Circle(_) => Circle::new(radius).ok()?.into(),
            Self::Capsule(_) => Capsule2::new(vertices[0], vertices[1], radius).ok()?.into(),
            Self::Rect(rect) => {
                let half = vectors2(&[rect.half_extents()], k)?[0];
                Rect::from_half_extents(half).ok()?.rounded(radius).ok()?.into()
            }
            Self::Polygon(_) => {
                let polygon = Polygon::new(&vertices).ok()?;
                assert_eq!(polygon.vertices(), vertices, "2^{k} changes a polygon");
                polygon.rounded(radius).ok()?.into()
            }
            Self::HalfPlane(half_plane) => (*half_plane).into(),
            Self::Segment(_) => Segment2::new(vertices[0], vertices[1]).ok()?.into(),
            Self::Compound(compound) => {
                let parts = compound.parts().iter();
                let parts = parts.map(|part| Some((part.pose().in_units(k)?, part.shape().in_units(k)?)));
                Compound2::new(parts.collect::<Option<Vec<_>>>()?).ok()?.into()
            }
            Self::Chain(chain) => {
                let vertices = vectors2(chain.vertices(), k)?;
                let scaled =
                    if chain.is_closed() { Chain::closed(vertices) } else { Chain::open(vertices) }.ok()?;
                if chain.is_one_sided() { scaled.one_sided() } else { scaled }.into()
            }
        })
    }
}

/// How large and how small a pair is, in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// The sum of the finite bounding radii.
    pub(super) outer: f64,
    /// The least of all radii that have a lower limit: bounding ones, and those of round shapes.
    pub(super) least: f64,
    /// At least the distance of any point of a shape from its origin.
    pub(super) furthest: f64,
    /// The largest coordinate of a position.
    pub(super) position: f64,
}

impl Reach {
    const NOTHING: Self = Self { outer: 0.0, least: 1.0, furthest: 1e-6, position: 0.0 };

    fn add(&mut self, outer: f64, center: DVec3, radius: f64, round: bool) {
        if outer.is_finite() {
            (self.outer, self.least) = (self.outer + outer, self.least.min(outer));
            self.furthest = self.furthest.max(2.0 * (center.length() + outer));
        }
        if round {
            self.least = self.least.min(radius);
        }
    }

    pub(super) fn of3(case: &Case3) -> Self {
        let mut reach = Self::NOTHING;
        for shape in [&case.shape_a, &case.shape_b] {
            let mut all = vec![shape];
            if let Shape3::Compound(compound) = shape {
                all.extend(compound.parts().iter().map(|part| part.shape()));
            }
            for shape in all {
                let round = matches!(shape, Shape3::Sphere(_) | Shape3::Capsule(_));
                reach.add(
                    shape.outer_radius().into(),
                    shape.center().as_dvec3(),
                    shape.radius().into(),
                    round,
                );
            }
        }
        let positions = [case.pose_a, case.pose_b].map(|pose| pose.position().abs().max_element());
        Self { position: positions[0].max(positions[1]).min(MAX_POSITION), ..reach }
    }

    pub(super) fn of2(case: &Case2) -> Self {
        let mut reach = Self::NOTHING;
        for shape in [&case.shape_a, &case.shape_b] {
            let mut all = vec![shape];
            if let Shape2::Compound(compound) = shape {
                all.extend(compound.parts().iter().map(|part| part.shape()));
            }
            for shape in all {
                let round = matches!(shape, Shape2::Circle(_) | Shape2::Capsule(_));
                let center: DVec2 = shape.center().as_dvec2();
                reach.add(shape.outer_radius().into(), center.extend(0.0), shape.radius().into(), round);
            }
        }
        let positions = [case.pose_a, case.pose_b].map(|pose| pose.position().abs().max_element());
        Self { position: positions[0].max(positions[1]).min(MAX_POSITION), ..reach }
    }
}
