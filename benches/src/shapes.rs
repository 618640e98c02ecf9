//! Every pair of shapes, and queries of single shapes, beside the same queries of parry3d.
//!
//! Shapes are about a metre wide, in any pose; half-spaces are in the world's axes. About half of the pairs of a set
//! overlap. Casts begin apart, and most of them hit. Queries of single shapes:
//!
//! | query | ours | parry3d |
//! |---|---|---|
//! | ray | `cast_ray3` | `cast_ray_and_get_normal` |
//! | point | `Shape3::contains` | `contains_point` |
//! | bounds | `Shape3::bounds` | `compute_aabb` |
//! | mass | `Shape3::mass_properties` | `mass_properties` |
//! | make | `Hull::from_points` | `SharedShape::convex_hull` |
//!
//! Pairs are queried as in [`crate::narrow`], and judged as there.

mod alone;

use crate::accuracy::Accuracy;
use crate::clock::Effort;
use crate::judge::Judge;
use crate::narrow::Operation;
use crate::narrow::both::{Both, Peer};
use crate::parry::Shapes;
use crate::race::Race;
use crate::row::Row;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Capsule3, Cuboid, HalfSpace, Hull, Pose3, Segment3, Shape3, Sphere, Triangle3};
use asunder_scenes::pairs::PosedPair3;
use asunder_scenes::random::Random;
use parry3d::math::Vector;
use parry3d::query::{self, ShapeCastOptions};
use std::error::Error;

/// Pairs per set, and how many of them are judged at most.
const PAIRS: usize = 500;
const JUDGED: usize = 250;

/// The kind of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Spheres.
    Ball,
    /// Capsules.
    Capsule,
    /// Cuboids.
    Box,
    /// Hulls of 16 points on a ball.
    Hull,
    /// Triangles.
    Triangle,
    /// Segments.
    Segment,
    /// Half-spaces.
    Plane,
}

impl Kind {
    const ALL: [Self; 7] =
        [Self::Ball, Self::Capsule, Self::Box, Self::Hull, Self::Triangle, Self::Segment, Self::Plane];

    const fn name(self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Capsule => "capsule",
            Self::Box => "box",
            Self::Hull => "hull16",
            Self::Triangle => "triangle",
            Self::Segment => "segment",
            Self::Plane => "plane",
        }
    }

    fn shape(self, random: &mut Random) -> Result<Shape3, Box<dyn Error>> {
        let size = random.range(0.3, 0.6) as f32;
        let around = random.direction();
        Ok(match self {
            Self::Ball => Sphere::new(size)?.into(),
            Self::Capsule => {
                let end = around.as_vec3() * size;
                Capsule3::new(-end, end, 0.5 * size)?.into()
            }
            Self::Box => {
                let half = random.within(DVec3::splat(0.3), DVec3::splat(0.6));
                Cuboid::from_half_extents(half.as_vec3())?.into()
            }
            Self::Hull => Hull::from_points(&points(random, size))?.into(),
            Self::Triangle => {
                let [a, b, c] = [(); 3].map(|()| random.direction().as_vec3() * size);
                Triangle3::new(a, b, c)?.into()
            }
            Self::Segment => {
                let end = around.as_vec3() * size;
                Segment3::new(-end, end)?.into()
            }
            Self::Plane => HalfSpace::new(Vec3::Y)?.into(),
        })
    }
}

/// Points on a ball.
fn points(random: &mut Random, size: f32) -> Vec<Vec3> {
    (0..16).map(|_| random.direction().as_vec3() * size).collect()
}

/// The query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// A query of [`crate::narrow`].
    Of(Operation),
    /// A cast: where the first shape touches the second as it moves.
    Cast,
}

impl Question {
    const ALL: [Self; 4] = [
        Self::Of(Operation::Boolean),
        Self::Of(Operation::Distance),
        Self::Of(Operation::Manifold),
        Self::Cast,
    ];

    const fn name(self) -> &'static str {
        match self {
            Self::Of(operation) => operation.name(),
            Self::Cast => "cast",
        }
    }
}

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// A query for a pair.
    Pair(Kind, Kind, Question),
    /// A query for a single shape.
    Alone(Kind, Alone),
}

/// A query for a single shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alone {
    /// Where a ray hits it; half of the rays miss.
    Ray,
    /// Whether it contains a point.
    Point,
    /// The AABB around it in a pose.
    Bounds,
    /// Its mass, centre of mass and inertia.
    Mass,
    /// Building it from its points, where there are many.
    Make,
}

impl Alone {
    const ALL: [Self; 5] = [Self::Ray, Self::Point, Self::Bounds, Self::Mass, Self::Make];

    const fn name(self) -> &'static str {
        match self {
            Self::Ray => "ray",
            Self::Point => "point",
            Self::Bounds => "bounds",
            Self::Mass => "mass",
            Self::Make => "make",
        }
    }

    /// Half-spaces have no bounds and no mass, and thin shapes no interior; only hulls cost anything to build.
    const fn suits(self, kind: Kind) -> bool {
        match self {
            Self::Ray => !matches!(kind, Kind::Segment),
            Self::Point | Self::Mass => matches!(kind, Kind::Ball | Kind::Capsule | Kind::Box | Kind::Hull),
            Self::Bounds => !matches!(kind, Kind::Plane),
            Self::Make => matches!(kind, Kind::Hull),
        }
    }
}

/// Every row.
///
/// ```
/// use asunder_benches::shapes;
/// let names: Vec<String> = shapes::cases().iter().map(shapes::name).collect();
/// for name in ["ball+box/manifold", "triangle+plane/cast", "hull16/make"] {
///     assert_eq!(names.iter().filter(|known| *known == name).count(), 1, "{name}");
/// }
/// ```
pub fn cases() -> Vec<Case> {
    let pairs = Kind::ALL.iter().enumerate().flat_map(|(i, &a)| Kind::ALL[i..].iter().map(move |&b| (a, b)));
    // Two half-spaces overlap or are parallel, whatever their poses.
    let pairs = pairs.filter(|pair| *pair != (Kind::Plane, Kind::Plane));
    let of_pairs = pairs.flat_map(|(a, b)| Question::ALL.map(|question| Case::Pair(a, b, question)));
    let alone = Kind::ALL.into_iter().flat_map(|kind| {
        Alone::ALL.into_iter().filter(move |question| question.suits(kind)).map(move |q| Case::Alone(kind, q))
    });
    of_pairs.chain(alone).collect()
}

/// The name of a row, as `ball+box/manifold`.
///
/// ```
/// use asunder_benches::shapes::{self, Alone, Case, Kind};
/// assert_eq!(shapes::name(&Case::Alone(Kind::Box, Alone::Ray)), "box/ray");
/// ```
pub fn name(case: &Case) -> String {
    match case {
        Case::Pair(a, b, question) => format!("{}+{}/{}", a.name(), b.name(), question.name()),
        Case::Alone(kind, question) => format!("{}/{}", kind.name(), question.name()),
    }
}

/// Measures one row. Cost: some tenths of a second per variant.
///
/// # Errors
/// A shape that either side rejects.
///
/// ```
/// use asunder_benches::shapes::{self, Alone, Case, Kind, Question};
/// use asunder_benches::{clock::Effort, judge::Judge};
/// let effort = Effort { rounds: 2, ..Effort::quick() };
/// for case in [Case::Pair(Kind::Ball, Kind::Plane, Question::Cast), Case::Alone(Kind::Hull, Alone::Make)] {
///     let row = shapes::measure(&case, &effort, &mut Judge::default())?;
///     assert!(row.ratio.is_some(), "{row:?}");
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(case: &Case, effort: &Effort, judge: &mut Judge) -> Result<Row, Box<dyn Error>> {
    // There are many rows, and they are steady: a third of the usual time is enough.
    let effort = Effort { seconds: effort.seconds / 3.0, ..*effort };
    match *case {
        Case::Pair(a, b, question) => {
            of_pair([a, b], question, &effort, (Row::new(name(case), "pair", PAIRS), judge))
        }
        Case::Alone(kind, question) => {
            alone::measure(kind, question, &effort, Row::new(name(case), "question", PAIRS))
        }
    }
}

/// Pairs of two kinds in random poses, with centres at most as far apart as both reach; and the direction of the first.
fn pairs(kinds: [Kind; 2]) -> Result<Vec<(PosedPair3, DVec3)>, Box<dyn Error>> {
    let mut random = Random::new(0x5a9e5);
    let mut pair = || {
        let [shape_a, shape_b] = [kinds[0].shape(&mut random)?, kinds[1].shape(&mut random)?];
        let is_plane = kinds[1] == Kind::Plane;
        let way = if is_plane { DVec3::Y } else { random.direction() };
        let reach =
            |shape: &Shape3| if shape.outer_radius().is_finite() { shape.outer_radius() } else { 0.0 };
        let apart = f64::from(reach(&shape_a) + reach(&shape_b))
            * random.range(if is_plane { -0.5 } else { 0.2 }, 1.2);
        let place = random.within(DVec3::splat(-5.0), DVec3::splat(5.0));
        let place = if is_plane { DVec3::new(place.x, 0.0, place.z) } else { place };
        let pose_a = Pose3::new(place + way * apart, random.rotation())?;
        let pose_b = if is_plane { Pose3::IDENTITY } else { Pose3::new(place, random.rotation())? };
        Ok((PosedPair3 { shape_a, pose_a, shape_b, pose_b }, way))
    };
    (0..PAIRS).map(|_| pair()).collect()
}

fn of_pair(
    kinds: [Kind; 2],
    question: Question,
    effort: &Effort,
    (mut row, judge): (Row, &mut Judge),
) -> Result<Row, Box<dyn Error>> {
    let pairs = pairs(kinds)?;
    let Question::Of(operation) = question else { return casts(&pairs, effort, row) };
    let posed: Vec<PosedPair3> = pairs.into_iter().map(|(pair, _)| pair).collect();
    let all = Both::all(&posed, &mut Shapes::default()).ok_or("parry3d refuses a shape")?;
    let (mut race, mut peer) = (Race::default(), Peer::default());
    while !race.is_over(effort) {
        let ours = || all.iter().map(|both| both.ask(operation)).sum::<f32>();
        let theirs = || all.iter().map(|both| peer.ask(operation, both)).sum::<f32>();
        race.turn(PAIRS, ours, theirs);
    }
    race.tell(&mut row, "parry3d");
    let mut accuracy = Accuracy::default();
    for (pair, both) in posed.iter().zip(&all).take(if effort.is_quick { JUDGED / 10 } else { JUDGED }) {
        let size = f64::from(both.pair().size());
        accuracy.judge(judge.separation(pair), size, both.said(operation), peer.said(operation, both));
    }
    row.accuracy = Some(accuracy);
    Ok(row)
}

/// The first shape moves, from apart, through the second or past it.
fn casts(pairs: &[(PosedPair3, DVec3)], effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    const AWAY: f64 = 3.0;
    let mut random = Random::new(0xca57);
    let mut shapes = Shapes::default();
    let mut sets = Vec::with_capacity(pairs.len());
    for (pair, way) in pairs {
        let aside = random.direction() * 0.5;
        let from = pair.pose_b.position() + (pair.pose_a.position() - pair.pose_b.position()) + *way * AWAY;
        let moved = PosedPair3 { pose_a: Pose3::new(from + aside, pair.pose_a.rotation())?, ..pair.clone() };
        let both = Both::all(core::slice::from_ref(&moved), &mut shapes).ok_or("parry3d refuses a shape")?;
        sets.extend(both.into_iter().map(|both| (both, (*way * (-2.0 * AWAY)).as_vec3())));
    }
    let options = ShapeCastOptions { max_time_of_impact: 1.0, ..ShapeCastOptions::default() };
    let ours = |(both, displacement): &&(Both, Vec3)| both.pair().cast(*displacement).is_some();
    let peer = |(both, displacement): &&(Both, Vec3)| {
        let ([a, b], [pose_a, pose_b]) = both.of_peer();
        query::cast_shapes(pose_a, *displacement, &*a.0, pose_b, Vector::ZERO, &*b.0, options)
            .is_ok_and(|hit| hit.is_some())
    };
    let counts = (|| sets.iter().filter(ours).count(), || sets.iter().filter(peer).count());
    let (race, said) = Race::run(effort, PAIRS, counts.0, counts.1, |hits, peer_hits| {
        format!("{hits} of {PAIRS} meet, the peer's {peer_hits}")
    });
    row.remark(&said);
    race.tell(&mut row, "parry3d");
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_gives_figures_and_is_right() {
        let effort = Effort { rounds: 1, ..Effort::quick() };
        let mut judge = Judge::default();
        for case in cases() {
            let row = measure(&case, &effort, &mut judge).unwrap();
            assert!(row.ratio.is_some() && row.done > 0, "{row:?}");
            if let Some(accuracy) = row.accuracy {
                assert!(accuracy.judged > 0 && accuracy.off + accuracy.missed == 0, "{row:?}");
            }
        }
    }
}
