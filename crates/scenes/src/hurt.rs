//! Boxes laid out to make a broad phase slow: few of them overlap, but a grid, a tree or a sweep along one axis can
//! hardly make use of that.
//!
//! ```
//! use asunder_scenes::hurt::HurtScene;
//! let boxes = HurtScene::Needles.boxes(900, 1);
//! assert_eq!(boxes.len(), 900);
//! assert_eq!(boxes, HurtScene::Needles.boxes(900, 1));
//! assert!(HurtScene::ALL.iter().all(|&scene| HurtScene::by_name(scene.name()) == Some(scene)));
//! ```

use crate::random::Random;
use asunder_geometry::Aabb3;
use glam::{DVec3, Vec3};

/// The named scenes. Cost of making one: some tens of nanoseconds per box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HurtScene {
    /// Needles through the whole of a cube, a third of them along each axis, with one overlap for every ten.
    Needles,
    /// As needles, but of any length from a hundredth of the cube's edge up.
    Splinters,
    /// Forty clouds about one point, each half as wide as the one before, and so are its boxes.
    Halves,
    /// As halves, but each cloud is a quarter as wide as the one before.
    Quarters,
    /// As halves, but six clouds, each a thousandth as wide as the one before.
    Thousandths,
    /// Cubes at all distances from the middle: every coordinate is log-uniform over twelve decades.
    Scattered,
    /// Unbounded lines along each axis, and as many tiny boxes, in a cube.
    Unbounded,
    /// Floors of all widths one above another, each of which overlaps about sixty others.
    Floors,
}

impl HurtScene {
    /// Every scene, in the order in which results are listed.
    pub const ALL: [Self; 8] = [
        Self::Needles,
        Self::Splinters,
        Self::Halves,
        Self::Quarters,
        Self::Thousandths,
        Self::Scattered,
        Self::Unbounded,
        Self::Floors,
    ];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Needles => "needles",
            Self::Splinters => "splinters",
            Self::Halves => "halves",
            Self::Quarters => "quarters",
            Self::Thousandths => "thousandths",
            Self::Scattered => "scattered",
            Self::Unbounded => "unbounded",
            Self::Floors => "floors",
        }
    }

    /// The scene of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scene| scene.name() == name)
    }

    /// Its boxes, in metres. The average number of overlaps per box does not depend on the number of boxes.
    pub fn boxes(self, count: usize, seed: u64) -> Vec<Aabb3> {
        let mut random = Random::new(seed ^ 0x4157);
        (0..count).map(|place| self.one(place, count as f64, &mut random)).collect()
    }

    fn one(self, place: usize, count: f64, random: &mut Random) -> Aabb3 {
        match self {
            Self::Needles => needle(place, 1.0, count, random),
            Self::Splinters => {
                let length = random.log_range(0.01, 1.0);
                needle(place, length, count, random)
            }
            Self::Halves => shrinking(place, (40, 0.5), count, random),
            Self::Quarters => shrinking(place, (40, 0.25), count, random),
            Self::Thousandths => shrinking(place, (6, 1e-3), count, random),
            Self::Scattered => {
                let center = DVec3::from_array([0; 3].map(|_| random.log_range(1e-6, 1e6) * sign(random)));
                // Of any size, but far smaller than the distance from the middle.
                around(center, DVec3::splat(random.log_range(1e-8, 1e-6)))
            }
            Self::Unbounded => {
                // The bounded boxes have hardly any size: a grid that is fitted to them alone is too fine.
                let is_line = place.is_multiple_of(2);
                let mut one = needle(place / 2, if is_line { 0.0 } else { 0.1 / count }, count, random);
                if is_line {
                    one.min[place / 2 % 3] = f32::NEG_INFINITY;
                    one.max[place / 2 % 3] = f32::INFINITY;
                }
                one
            }
            Self::Floors => {
                let center = random.within(DVec3::NEG_ONE, DVec3::ONE);
                let half = DVec3::new(random.range(0.3, 1.0), 60.0 / count, random.range(0.3, 1.0));
                around(center, half)
            }
        }
    }
}

/// A needle in a cube of 1 m. Two of different axes overlap with a probability of twice their width.
fn needle(place: usize, length: f64, count: f64, random: &mut Random) -> Aabb3 {
    let mut half = DVec3::splat(0.1 / count);
    half[place % 3] = 0.5 * length;
    around(random.within(DVec3::splat(-0.5), DVec3::splat(0.5)), half)
}

/// A cube of one of so many clouds, each narrower than the last by the given ratio. Two cubes of a cloud of n overlap
/// with a probability of about one in n.
fn shrinking(place: usize, (clouds, ratio): (usize, f64), count: f64, random: &mut Random) -> Aabb3 {
    let scale = (0..place % clouds).fold(1.0, |scale, _| scale * ratio);
    let half = 0.5 * libm::cbrt(clouds as f64 / count);
    around(random.within(DVec3::NEG_ONE, DVec3::ONE) * scale, DVec3::splat(half * scale))
}

fn around(center: DVec3, half: DVec3) -> Aabb3 {
    let [low, high]: [Vec3; 2] = [center - half, center + half].map(|corner| corner.as_vec3());
    Aabb3::new(low, high)
}

fn sign(random: &mut Random) -> f64 {
    if random.below(2) == 0 { -1.0 } else { 1.0 }
}
