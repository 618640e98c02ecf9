use super::*;
use crate::feature::Feature;
use oorandom::Rand64;

type Corner = ([f64; 2], f64);

/// Share of the best area that counts as all of it: on either side of the diagonal, along it, and from root to root,
/// the first of even candidates is taken.
const ALL: f64 = 1.0 - 3.0 * EVEN_AREA;

fn id(i: usize) -> FeatureId {
    FeatureId::new(Feature::Face(0), Feature::Vertex(i as u32))
}

fn pick(corners: &[Corner], slack: f64) -> [usize; 4] {
    let spot = |i: usize| Spot { at: corners[i].0, separation: corners[i].1 };
    pick_four(corners.len(), spot, id, slack)
}

/// By the shoelace formula, for corners in order around their hull.
fn area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>().abs() / 2.0
}

fn area_of(corners: &[Corner], mut four: [usize; 4]) -> f64 {
    four.sort_unstable();
    area(&four.map(|i| corners[i].0))
}

/// The area of the best allowed four, by trying all sets.
fn best_of_all(corners: &[Corner], is_allowed: impl Fn([usize; 4]) -> bool) -> f64 {
    let mut best = 0.0_f64;
    let count = corners.len();
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                for d in c + 1..count {
                    if is_allowed([a, b, c, d]) {
                        best = best.max(area_of(corners, [a, b, c, d]));
                    }
                }
            }
        }
    }
    best
}

/// The same without a filter, by trying all diagonals, for many corners.
fn best_by_diagonals(corners: &[Corner]) -> f64 {
    let count = corners.len();
    let mut best = 0.0_f64;
    for a in 0..count {
        for c in a + 2..count {
            let triangle = |i: usize| area(&[corners[a].0, corners[i].0, corners[c].0]);
            let near = (a + 1..c).map(triangle).fold(0.0, f64::max);
            let far = (c + 1..count).chain(0..a).map(triangle).fold(0.0, f64::max);
            best = best.max(near + far);
        }
    }
    best
}

/// A point of the unit circle, which goes around once as the parameter goes from -1 to 1.
fn on_circle(parameter: f64) -> [f64; 2] {
    let slope = parameter / (1.0 - parameter.abs());
    let scale = 1.0 / (1.0 + slope * slope);
    [(1.0 - slope * slope) * scale, 2.0 * slope * scale]
}

/// Corners clockwise on an ellipse, so that all are corners of their hull: in random places, stretched and rotated, all
/// equally deep.
fn on_ellipse(random: &mut Rand64, count: usize) -> Vec<Corner> {
    let stretch = [1.0, 2.0, 10.0, 100.0][random.rand_range(0..4) as usize];
    let [cos, sin] = on_circle(random.rand_float() * 1.98 - 0.99);
    let mut places: Vec<f64> = (0..count).map(|_| random.rand_float() * 1.98 - 0.99).collect();
    places.sort_by(|one, other| other.total_cmp(one));
    let corner = |&place: &f64| {
        let [x, y] = on_circle(place);
        ([cos * x * stretch - sin * y, sin * x * stretch + cos * y], 0.0)
    };
    places.iter().map(corner).collect()
}

fn regular(count: usize) -> Vec<Corner> {
    // Evenly by the parameter is even enough for ties of every kind, but for few corners exactly so.
    (0..count).rev().map(|i| (on_circle((2 * i + 1) as f64 / count as f64 - 1.0), 0.0)).collect()
}

#[test]
fn corners_that_are_as_deep_keep_the_area_of_the_best_four() {
    let mut random = Rand64::new(1);
    for round in 0..4000 {
        let corners = on_ellipse(&mut random, 5 + round % 9);
        let (found, best) = (area_of(&corners, pick(&corners, 0.0)), best_of_all(&corners, |_| true));
        assert!(found >= best * ALL, "{found} of {best}: {corners:?}");
    }
}

#[test]
fn of_many_corners_four_keep_nineteen_parts_in_twenty() {
    let mut random = Rand64::new(2);
    let mut least = 1.0_f64;
    for round in 0..60 {
        let count = 14 + 3 * round;
        let corners = if round % 3 == 0 { regular(count) } else { on_ellipse(&mut random, count) };
        let (found, best) = (area_of(&corners, pick(&corners, 0.0)), best_by_diagonals(&corners));
        assert!(found >= 0.95 * best, "{found} of {best}: {count}");
        least = least.min(found / best);
    }
    eprintln!("at least {least} of the best four");
}

#[test]
fn one_that_is_deeper_is_kept_with_the_best_that_hold_it() {
    let mut random = Rand64::new(3);
    for round in 0..3000 {
        let mut corners = on_ellipse(&mut random, 5 + round % 9);
        let deepest = random.rand_range(0..corners.len() as u64) as usize;
        corners[deepest].1 = -1.0;
        let chosen = pick(&corners, 1e-3);
        assert!(chosen.contains(&deepest), "{chosen:?} without {deepest}: {corners:?}");
        let best = best_of_all(&corners, |four| four.contains(&deepest));
        let found = area_of(&corners, chosen);
        assert!(found >= best * ALL, "{found} of {best}: {corners:?}");
        assert!(found >= 2.0 / 3.0 * best_of_all(&corners, |_| true), "{found}: {corners:?}");
    }
}

/// Of several that are equally deep, the one with the lowest id may not be a corner of the best four.
#[test]
fn any_of_several_that_are_as_deep_will_do() {
    let mut random = Rand64::new(4);
    let mut better = 0;
    for round in 0..3000 {
        let mut corners = on_ellipse(&mut random, 5 + round % 9);
        for corner in &mut corners {
            corner.1 = if random.rand_float() < 0.4 { 0.0 } else { 1.0 };
        }
        let is_deep = |i: usize| corners[i].1 == 0.0;
        let Some(root) = (0..corners.len()).find(|&i| is_deep(i)) else { continue };
        let chosen = pick(&corners, 1e-3);
        assert!(chosen.into_iter().any(is_deep), "{chosen:?}: {corners:?}");
        let (found, best) = (area_of(&corners, chosen), best_of_all(&corners, |_| true));
        let with_root = best_of_all(&corners, |four| four.contains(&root));
        assert!(found >= with_root * ALL, "{found} of {with_root}: {corners:?}");
        // If the best four, or others with the same area, hold a deepest corner, the area found is within 5 % of
        // theirs.
        if best_of_all(&corners, |four| four.into_iter().any(is_deep)) >= best {
            assert!(found >= 0.95 * best, "{found} of {best}: {corners:?}");
            better += usize::from(found > with_root * (1.0 + 1e-5));
        }
    }
    assert!(better > 100, "{better}");
}

/// The deepest corner is the middle of a trapezoid's longer side: with it, no other three have more than 2/3.
#[test]
fn no_four_could_keep_more_with_the_middle_of_a_side() {
    let trapezoid = [[-2.0, 0.0], [-1.0, 1.0], [1.0, 1.0], [2.0, 0.0], [0.0, -1e-9]];
    let corners: Vec<Corner> = trapezoid.iter().map(|&at| (at, at[1])).collect();
    let corners: Vec<Corner> =
        corners.iter().map(|&(at, y)| (at, if y < 0.0 { -1.0 } else { 0.0 })).collect();
    let chosen = pick(&corners, 1e-3);
    assert!(chosen.contains(&4), "{chosen:?}");
    assert!((area_of(&corners, chosen) / area(&trapezoid[..4]) - 2.0 / 3.0).abs() < 1e-6, "{chosen:?}");
}

/// A cap of twelve sides has three squares, which are equal up to rounding: the same one in every frame.
#[test]
fn ties_go_the_same_way_whatever_the_rounding() {
    let mut random = Rand64::new(5);
    let half = 3.0_f64.sqrt() / 2.0;
    let quarter = [[0.0, 1.0], [0.5, half], [half, 0.5]];
    let turn = |[x, y]: [f64; 2], quarters: usize| match quarters {
        0 => [x, y],
        1 => [y, -x],
        2 => [-x, -y],
        _ => [-y, x],
    };
    let cap: Vec<[f64; 2]> = (0..12).map(|i| turn(quarter[i % 3], i / 3)).collect();
    let mut jitter = || (random.rand_float() - 0.5) * 1e-12;
    let mut chosen_sets = std::collections::BTreeSet::new();
    for _ in 0..1000 {
        let corners: Vec<Corner> =
            cap.iter().map(|[x, y]| ([x + jitter(), y + jitter()], jitter())).collect();
        let mut chosen = pick(&corners, 1e-9);
        chosen.sort_unstable();
        chosen_sets.insert(chosen);
    }
    assert_eq!(chosen_sets.len(), 1, "{chosen_sets:?}");
    assert!(chosen_sets.contains(&[0, 3, 6, 9]), "the square of the lowest id: {chosen_sets:?}");
}

/// Caps with several fours of the same area, which tremble: the same four, wherever the list begins and from either
/// side.
#[test]
fn which_four_is_a_matter_of_features_and_not_of_the_list() {
    let mut random = Rand64::new(6);
    for count in 5..40 {
        let cap = regular(count);
        // A feature of each shape; they change places with the shapes.
        let feature = |i: usize| [Feature::Face(3), Feature::Vertex((41 * i % count) as u32)];
        let mut chosen_sets = std::collections::BTreeSet::new();
        for round in 0..6 * count {
            let (begin, is_mirrored) = (round / 2 % count, round % 2 == 1);
            let corner = |place: usize| (begin + if is_mirrored { count - place } else { place }) % count;
            let mut jitter = |size: f64| (random.rand_float() - 0.5) * size;
            let spots: Vec<Spot> = (0..count)
                .map(|place| {
                    let ([x, y], _) = cap[corner(place)];
                    let at = [if is_mirrored { -x } else { x } + jitter(2e-6), y + jitter(2e-6)];
                    Spot { at, separation: jitter(1e-4) }
                })
                .collect();
            let named = |place: usize| {
                let [one, other] = feature(corner(place));
                if is_mirrored { FeatureId::new(other, one) } else { FeatureId::new(one, other) }
            };
            let mut chosen = pick_four(count, |place| spots[place], named, 1e-4).map(corner);
            chosen.sort_unstable();
            chosen_sets.insert(chosen);
        }
        assert_eq!(chosen_sets.len(), 1, "{count}: {chosen_sets:?}");
    }
}
