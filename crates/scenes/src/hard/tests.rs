//! What every family promises, checked on the stored shapes and poses, without trust in the generator.

use super::*;
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use glam::{DVec2, DVec3};

const SEEDS: u64 = 12;

/// Families without claims, or with claims for some of their pairs only.
const UNCLAIMED: [&str; 6] = ["identical", "deep", "compounds", "random", "half-space", "half-plane"];

/// Convex parts as points in the world and a radius; no part for a half-space.
type Parts = Vec<(Vec<DVec3>, f64)>;

/// What the tests need of a pair, in either dimension. Gaps and claims are in metres; points of the plane have z = 0.
struct Seen {
    what: String,
    gap: Option<f64>,
    within: f64,
    size: f64,
    /// The largest coordinate of a position.
    reach: f64,
    parts: [Parts; 2],
}

fn parts3(shape: &Shape3, pose: &Pose3) -> Parts {
    let of = |shape: &Shape3, place: &dyn Fn(DVec3) -> DVec3| {
        let points: Vec<DVec3> = shape.core().vertices().iter().map(|v| place(v.as_dvec3())).collect();
        (points, f64::from(shape.radius()))
    };
    match shape {
        Shape3::Compound(compound) => {
            let one = |part: &asunder_geometry::Part3| {
                of(part.shape(), &|v| pose.transform(part.pose().transform(v)))
            };
            compound.parts().iter().map(one).collect()
        }
        Shape3::HalfSpace(_) => Vec::new(),
        _ => vec![of(shape, &|v| pose.transform(v))],
    }
}

fn parts2(shape: &Shape2, pose: &Pose2) -> Parts {
    let of = |shape: &Shape2, place: &dyn Fn(DVec2) -> DVec2| {
        let points = shape.core().vertices().iter().map(|v| place(v.as_dvec2()).extend(0.0)).collect();
        (points, f64::from(shape.radius()))
    };
    match shape {
        Shape2::Compound(compound) => {
            let one = |part: &asunder_geometry::Part2| {
                of(part.shape(), &|v| pose.transform(part.pose().transform(v)))
            };
            compound.parts().iter().map(one).collect()
        }
        Shape2::HalfPlane(_) => Vec::new(),
        _ => vec![of(shape, &|v| pose.transform(v))],
    }
}

/// How far the parts reach along an axis from an origin; a half-space reaches to the plane through its origin.
fn reach(parts: &Parts, origin: DVec3, axis: DVec3) -> f64 {
    let of = |(points, radius): &(Vec<DVec3>, f64)| {
        points.iter().map(|p| (*p - origin).dot(axis)).fold(f64::NEG_INFINITY, f64::max) + radius
    };
    parts.iter().map(of).reduce(f64::max).unwrap_or(0.0)
}

fn seen(what: String, ends: [(Parts, DVec3, f32); 2], claim: Option<(DVec3, f64)>) -> Seen {
    let [(parts_a, at, radius_a), (parts_b, goal, radius_b)] = ends;
    let finite = |radius: f32| if radius.is_finite() { f64::from(radius) } else { 0.0 };
    // From each body's own position, so that no precision is lost far from the origin.
    let gap = claim
        .map(|(axis, _)| (goal - at).dot(axis) - reach(&parts_b, goal, -axis) - reach(&parts_a, at, axis));
    Seen {
        what,
        gap,
        within: claim.map_or(0.0, |(_, within)| within),
        size: finite(radius_a) + finite(radius_b),
        reach: at.abs().max(goal.abs()).max_element(),
        parts: [parts_a, parts_b],
    }
}

/// Every family in both dimensions, at every level, with several seeds.
fn everything(check: &mut dyn FnMut(&'static str, Seen)) {
    for family in FAMILIES3 {
        for (level, seed) in (0..family.levels).flat_map(|level| (0..SEEDS).map(move |seed| (level, seed))) {
            let Draft3 { pair: p, claim } = family.draft(level, seed);
            let a = (parts3(&p.shape_a, &p.pose_a), p.pose_a.position(), p.shape_a.outer_radius());
            let b = (parts3(&p.shape_b, &p.pose_b), p.pose_b.position(), p.shape_b.outer_radius());
            let claim = claim.map(|claim| (claim.axis, claim.within));
            check(
                family.name,
                seen(format!("3D {}, level {level}, seed {seed}", family.name), [a, b], claim),
            );
        }
    }
    for family in FAMILIES2 {
        for (level, seed) in (0..family.levels).flat_map(|level| (0..SEEDS).map(move |seed| (level, seed))) {
            let Draft2 { pair: p, claim } = family.draft(level, seed);
            let a =
                (parts2(&p.shape_a, &p.pose_a), p.pose_a.position().extend(0.0), p.shape_a.outer_radius());
            let b =
                (parts2(&p.shape_b, &p.pose_b), p.pose_b.position().extend(0.0), p.shape_b.outer_radius());
            let claim = claim.map(|claim| (claim.axis.extend(0.0), claim.within));
            check(
                family.name,
                seen(format!("2D {}, level {level}, seed {seed}", family.name), [a, b], claim),
            );
        }
    }
}

/// An upper bound of the distance between two convex parts: the distance between two points in them. By the algorithm
/// of Gilbert, Johnson and Keerthi ("A fast procedure for computing the distance between complex objects", 1988), until
/// the bound is good enough; where theirs selects a subset of the corners, this one tries all of them.
fn distance_at_most(a: &(Vec<DVec3>, f64), b: &(Vec<DVec3>, f64), enough: f64) -> f64 {
    let lowest = |points: &[DVec3], axis: DVec3| {
        *points.iter().min_by(|p, q| p.dot(axis).total_cmp(&q.dot(axis))).unwrap()
    };
    let mut corners = vec![b.0[0] - a.0[0]];
    let mut nearest = corners[0];
    for _ in 0..200 {
        if nearest.length() - a.1 - b.1 <= enough {
            break;
        }
        corners.push(lowest(&b.0, nearest) - lowest(&a.0, -nearest));
        let (found, kept) = (1_usize..1 << corners.len())
            .filter_map(|subset| {
                let kept: Vec<DVec3> =
                    (0..corners.len()).filter(|i| subset >> i & 1 == 1).map(|i| corners[i]).collect();
                Some((nearest_of(&kept)?, kept))
            })
            .min_by(|p, q| p.0.length_squared().total_cmp(&q.0.length_squared()))
            .unwrap();
        if found.length() >= nearest.length() {
            break;
        }
        (nearest, corners) = (found, kept);
    }
    nearest.length() - a.1 - b.1
}

/// The point nearest to the origin in the affine hull of up to four corners, if it lies within their simplex.
fn nearest_of(corners: &[DVec3]) -> Option<DVec3> {
    let (first, ways): (DVec3, Vec<DVec3>) =
        (corners[0], corners[1..].iter().map(|c| *c - corners[0]).collect());
    let weights: Vec<f64> = match ways[..] {
        [] => vec![],
        [u] => vec![-first.dot(u) / u.dot(u)],
        [u, v] => {
            let normal = u.cross(v);
            let square = normal.dot(normal);
            vec![v.cross(first).dot(normal) / square, first.cross(u).dot(normal) / square]
        }
        [u, v, w] => {
            let volume = u.cross(v).dot(w);
            [v.cross(w), w.cross(u), u.cross(v)].map(|normal| -first.dot(normal) / volume).to_vec()
        }
        _ => return None,
    };
    let inside = weights.iter().all(|&weight| weight >= 0.0) && weights.iter().sum::<f64>() <= 1.0;
    inside.then(|| ways.iter().zip(&weights).fold(first, |sum, (way, weight)| sum + *way * *weight))
}

#[test]
fn a_claimed_gap_is_the_gap_between_the_stored_shapes() {
    everything(&mut |_, seen| {
        let Some(gap) = seen.gap else { return };
        // Sums of a few terms, each as large as the size or a coordinate of a position, and each rounded once.
        let rounding = 32.0 * f64::EPSILON * (seen.size + seen.reach);
        assert!(gap.abs() <= seen.within + rounding, "{}: {gap} beyond {}", seen.what, seen.within);
    });
}

#[test]
fn near_touching_pairs_have_points_that_near() {
    everything(&mut |_, seen| {
        if seen.gap.is_none() || seen.parts.iter().any(Vec::is_empty) {
            return;
        }
        // Features meet up to the rounding of f32 rotations and vertices, 1e-7 or so, and the iteration is limited.
        let enough = seen.within + 1e-6 * seen.size + 4.0 * f64::EPSILON * seen.reach;
        let [a, b] = &seen.parts;
        let found = a
            .iter()
            .flat_map(|a| b.iter().map(move |b| distance_at_most(a, b, enough)))
            .fold(f64::INFINITY, f64::min);
        assert!(found <= enough, "{}: {found} m apart, of {}", seen.what, seen.size);
    });
}

#[test]
fn every_family_but_a_few_claims_every_pair_near() {
    let mut claimed: std::collections::BTreeMap<String, [usize; 2]> = std::collections::BTreeMap::new();
    everything(&mut |name, seen| {
        let counts = claimed.entry(format!("{} {name}", &seen.what[..2])).or_default();
        counts[usize::from(seen.gap.is_some())] += 1;
        // "Near" means within a hundredth of the size.
        assert!(seen.within <= 0.011 * seen.size, "{}: {} of {}", seen.what, seen.within, seen.size);
    });
    for (name, [free, near]) in claimed {
        let may_be_free = UNCLAIMED.contains(&&name[3..]);
        let half_free = name.ends_with("denormal") && near > free;
        assert!(free == 0 || may_be_free || half_free, "{name}: {free} of {} claim nothing", free + near);
    }
}

#[test]
fn no_shape_was_refused() {
    // Bricks on a grid may happen to equal the shape that replaces a rejected one.
    let on_purpose = ["coincident-faces", "coincident-edges"];
    for family in FAMILIES3.iter().filter(|family| !on_purpose.contains(&family.name)) {
        for (i, pair) in family.pairs(40 * family.levels as usize, 5).iter().enumerate() {
            let is_plain = |shape: &Shape3| *shape == crate::pairs::cuboid(glam::Vec3::splat(0.5));
            assert!(!is_plain(&pair.shape_a) && !is_plain(&pair.shape_b), "{} {i}", family.name);
        }
    }
    for family in FAMILIES2.iter().filter(|family| !on_purpose.contains(&family.name)) {
        for (i, pair) in family.pairs(40 * family.levels as usize, 5).iter().enumerate() {
            let is_plain = |shape: &Shape2| *shape == crate::pairs::rect(glam::Vec2::splat(0.5));
            assert!(!is_plain(&pair.shape_a) && !is_plain(&pair.shape_b), "{} {i}", family.name);
        }
    }
}

#[test]
fn equal_seeds_give_equal_bits_and_others_do_not() {
    fn same3(p: &PosedPair3, q: &PosedPair3) -> bool {
        p.pose_a.same_bits(&q.pose_a)
            && p.pose_b.same_bits(&q.pose_b)
            && p.shape_a == q.shape_a
            && p.shape_b == q.shape_b
    }
    fn same2(p: &PosedPair2, q: &PosedPair2) -> bool {
        p.pose_a.same_bits(&q.pose_a)
            && p.pose_b.same_bits(&q.pose_b)
            && p.shape_a == q.shape_a
            && p.shape_b == q.shape_b
    }
    for family in FAMILIES3 {
        for level in 0..family.levels {
            assert!(same3(&family.pair(level, 3), &family.pair(level, 3)), "{} {level}", family.name);
            let others = (4..12).filter(|&seed| !same3(&family.pair(level, 3), &family.pair(level, seed)));
            assert!(others.count() >= 7, "{} {level}", family.name);
        }
        // A level beyond the last is the last.
        assert!(same3(&family.pair(99, 3), &family.pair(family.levels - 1, 3)), "{}", family.name);
    }
    for family in FAMILIES2 {
        for level in 0..family.levels {
            assert!(same2(&family.pair(level, 3), &family.pair(level, 3)), "{} {level}", family.name);
            let others = (4..12).filter(|&seed| !same2(&family.pair(level, 3), &family.pair(level, seed)));
            assert!(others.count() >= 7, "{} {level}", family.name);
        }
        assert!(same2(&family.pair(99, 3), &family.pair(family.levels - 1, 3)), "{}", family.name);
    }
}

#[test]
fn names_are_unique_and_found() {
    for family in FAMILIES3 {
        assert!(family.levels >= 1 && !family.about.is_empty() && !family.knob.is_empty());
        assert_eq!(FAMILIES3.iter().filter(|other| other.name == family.name).count(), 1, "{}", family.name);
        assert_eq!(Family3::by_name(family.name).unwrap().about, family.about);
    }
    for family in FAMILIES2 {
        assert!(family.levels >= 1 && !family.about.is_empty() && !family.knob.is_empty());
        assert_eq!(FAMILIES2.iter().filter(|other| other.name == family.name).count(), 1, "{}", family.name);
        assert_eq!(Family2::by_name(family.name).unwrap().about, family.about);
    }
    assert!(Family3::by_name("no such thing").is_none() && Family2::by_name("").is_none());
}

#[test]
fn the_knobs_turn_what_they_say() {
    let reach = |p: &PosedPair3| p.pose_a.position().abs().max_element();
    let far = Family3::by_name("far").unwrap();
    for seed in 0..50 {
        assert!((4e8..=1e9).contains(&reach(&far.pair(7, seed))) && reach(&far.pair(0, seed)) < 200.0);
    }
    let ratio = |p: &PosedPair3| p.shape_a.outer_radius() / p.shape_b.outer_radius();
    let sizes = Family3::by_name("size-ratio").unwrap();
    let most = (0..50).map(|seed| ratio(&sizes.pair(5, seed))).map(|r| r.max(1.0 / r)).fold(0.0, f32::max);
    assert!((1e6..5e6).contains(&most), "{most}");
    let length = |p: &PosedPair3| {
        p.pose_a.rotation().to_array().iter().map(|&q| f64::from(q) * f64::from(q)).sum::<f64>().sqrt()
    };
    let drifted = Family3::by_name("drifted").unwrap();
    let lengths: Vec<f64> = (0..50).map(|seed| length(&drifted.pair(3, seed))).collect();
    assert!(lengths.iter().any(|&l| l > 1e3) && lengths.iter().any(|&l| l < 1e-3));
    let radius = |p: &PosedPair3| p.shape_a.outer_radius().max(p.shape_b.outer_radius());
    let (tiny, huge) = (Family3::by_name("tiny").unwrap(), Family3::by_name("huge").unwrap());
    assert!((0..50).all(|seed| (1e-6..2e-6).contains(&radius(&tiny.pair(3, seed)))));
    assert!((0..50).all(|seed| radius(&huge.pair(3, seed)) > 8e5));
    let sides = Family2::by_name("polygons").unwrap();
    let count = |p: &PosedPair2| p.shape_a.core().vertices().len().max(p.shape_b.core().vertices().len());
    assert_eq!((0..20).map(|seed| count(&sides.pair(7, seed))).max(), Some(4096));
}

#[test]
fn both_sides_of_touching_are_drawn_and_the_last_level_of_a_gap_is_none() {
    let family = Family3::by_name("vertex-face").unwrap();
    let gaps: Vec<f64> = (0..200)
        .map(|seed| {
            let Draft3 { pair: p, claim } = family.draft(0, seed);
            let axis = claim.unwrap().axis;
            let (a, b) = (parts3(&p.shape_a, &p.pose_a), parts3(&p.shape_b, &p.pose_b));
            -reach(&b, DVec3::ZERO, -axis) - reach(&a, DVec3::ZERO, axis)
        })
        .collect();
    let apart = gaps.iter().filter(|&&gap| gap > 0.0).count();
    assert!((70..130).contains(&apart), "{apart} of 200 apart");
    assert!(gaps.iter().all(|gap| (1e-6..1e-2).contains(&gap.abs())));
    for name in ["vertex-face", "vertex-edge", "vertex-vertex", "crossed-edges", "face-rotated"] {
        let family = Family3::by_name(name).unwrap();
        let last = family.levels - 1;
        assert!((0..20).all(|seed| family.draft(last, seed).claim.is_some_and(|claim| claim.within == 0.0)));
    }
}

/// Whether all components of a quaternion are whole numbers, and one of them is not just 0 or 1 in size.
fn is_whole(rotation: glam::Quat) -> bool {
    rotation.to_array().iter().all(|q| q.fract() == 0.0) && rotation.to_array().iter().any(|q| q.abs() > 1.0)
}

#[test]
fn whole_crossings_and_whole_balls_touch_in_exact_arithmetic() {
    // Numbers of few bits: every sum and product below is exact in f64, and so is the one division.
    let heights = |shape: &Shape3, pose: &Pose3| {
        let [x, y, z, w] = pose.rotation().to_array().map(f64::from);
        let row = DVec3::new(2.0 * (x * z - y * w), 2.0 * (y * z + x * w), w * w - x * x - y * y + z * z);
        let square = x * x + y * y + z * z + w * w;
        let tall: Vec<f64> = shape
            .core()
            .vertices()
            .iter()
            .map(|v| row.dot(v.as_dvec3()) / square + pose.position().z)
            .collect();
        (tall.iter().copied().fold(f64::INFINITY, f64::min), tall.iter().copied().fold(f64::MIN, f64::max))
    };
    let (mut crossings, mut balls) = (0, 0);
    let (edges, round) =
        (Family3::by_name("crossed-edges").unwrap(), Family3::by_name("points-and-balls").unwrap());
    for seed in 0..400 {
        let p = edges.pair(edges.levels - 1, seed);
        if is_whole(p.pose_a.rotation()) && is_whole(p.pose_b.rotation()) {
            let (a, b) = (heights(&p.shape_a, &p.pose_a), heights(&p.shape_b, &p.pose_b));
            assert!(a.1 == b.0 || b.1 == a.0, "{a:?} {b:?}");
            crossings += 1;
        }
        let p = round.pair(round.levels - 1, seed);
        if let (Shape3::Sphere(a), Shape3::Sphere(b)) = (&p.shape_a, &p.shape_b)
            && is_whole(p.pose_a.rotation())
        {
            let offset = p.pose_b.position() - p.pose_a.position();
            let sum = f64::from(a.radius()) + f64::from(b.radius());
            assert_eq!(offset.dot(offset), sum * sum, "seed {seed}");
            balls += 1;
        }
    }
    assert!(crossings > 100 && balls > 5, "{crossings} crossings, {balls} balls");
}
