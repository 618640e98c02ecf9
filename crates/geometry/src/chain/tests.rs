use super::*;
use core::ops::ControlFlow::Continue;

/// Numbers that look random, from 0 to 1.
fn noise(i: usize) -> f32 {
    let mixed = (i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 40) as f32 / (1u32 << 24) as f32
}

fn wild(count: usize) -> Vec<Vec2> {
    (0..count).map(|i| Vec2::new(i as f32 * 0.5 + noise(2 * i), 3.0 * noise(2 * i + 1))).collect()
}

/// First segments of all runs, in order of the segments.
fn names(chain: &Chain) -> Vec<u32> {
    let mut names: Vec<u32> =
        (0..chain.segment_count() as u32).map(|i| chain.run_of(i).unwrap().first()).collect();
    names.dedup();
    names
}

/// A line from a point, cut into uneven pieces, some a thousandth of the others.
fn cut_line(from: DVec2, along: DVec2, count: usize) -> Vec<Vec2> {
    let mut at = 0.0;
    let step = |i: usize| if i.is_multiple_of(7) { 0.001 } else { 0.2 + f64::from(noise(i)) };
    (0..count)
        .map(|i| {
            at += step(i);
            (from + along * at).as_vec2()
        })
        .collect()
}

#[test]
fn a_box_finds_the_segments_that_a_search_of_all_finds_in_ascending_order() {
    for (count, is_closed) in
        [(2, false), (3, true), (5, false), (9, true), (64, false), (1001, true), (1000, false)]
    {
        let vertices = wild(count);
        let chain = Chain::new(&mut vertices.iter().copied(), is_closed).unwrap();
        for i in 0..200 {
            let low = Vec2::new(noise(3 * i) * count as f32 * 0.5, noise(3 * i + 1) * 4.0 - 0.5);
            let bounds = Aabb2::new(low, low + Vec2::new(noise(3 * i + 2) * 4.0, noise(5 * i)));
            let is_near = |&segment: &u32| {
                let [from, to] = chain.segment(segment).unwrap().ends();
                Aabb2::new(from.min(to), from.max(to)).overlaps(&bounds)
            };
            let all: Vec<u32> = (0..chain.segment_count() as u32).filter(is_near).collect();
            let mut found = Vec::new();
            let _ = chain.visit_near(&bounds, |segment| {
                found.push(segment);
                Continue(())
            });
            assert_eq!(found, all, "{count} {bounds:?}");
        }
    }
}

#[test]
fn a_million_segments_are_found_in_no_more_steps_than_their_logarithm_takes() {
    let chain = Chain::open((0..1_000_001).map(|i| Vec2::new(i as f32 * 0.5, noise(i) * 0.1))).unwrap();
    let bounds = Aabb2::new(Vec2::new(250_000.0, -1.0), Vec2::new(250_001.5, 1.0));
    let (mut looks, mut visited) = (0, 0);
    let meets = |other: &Aabb2| {
        looks += 1;
        bounds.overlaps(other)
    };
    let _ = chain.visit_where(meets, |_| {
        visited += 1;
        Continue(())
    });
    assert!((4..=6).contains(&visited) && looks < 64, "{visited} of {looks}");
    // The nearest to a point beside it, by boxes.
    let point = DVec2::new(123_456.7, 2.0);
    let (mut looks, mut best) = (0, (f64::INFINITY, 0));
    let bound = |other: &Aabb2| {
        looks += 1;
        (point - point.clamp(other.min.as_dvec2(), other.max.as_dvec2())).length()
    };
    chain.visit_nearest(f64::INFINITY, bound, |segment| {
        let [from, to] = chain.segment(segment).unwrap().ends().map(Vec2::as_dvec2);
        let place = ((point - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
        let distance = (from + (to - from) * place - point).length();
        if distance < best.0 {
            best = (distance, segment);
        }
        best.0
    });
    assert!(best.1.abs_diff(246_913) <= 4 && looks < 128, "{best:?} of {looks}");
}

#[test]
fn the_nearest_found_is_the_nearest_of_all() {
    for is_closed in [false, true] {
        let chain = Chain::new(&mut wild(700).into_iter(), is_closed).unwrap();
        for i in 0..300 {
            let point =
                DVec2::new(f64::from(noise(i)) * 400.0 - 20.0, f64::from(noise(i + 999)) * 30.0 - 15.0);
            let distance = |segment: u32| {
                let [from, to] = chain.segment(segment).unwrap().ends().map(Vec2::as_dvec2);
                let place = ((point - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
                (from + (to - from) * place - point).length()
            };
            let least = (0..chain.segment_count() as u32).map(distance).fold(f64::INFINITY, f64::min);
            let mut found = f64::INFINITY;
            let bound = |other: &Aabb2| {
                (point - point.clamp(other.min.as_dvec2(), other.max.as_dvec2())).length() * (1.0 - 1e-9)
            };
            chain.visit_nearest(f64::INFINITY, bound, |segment| {
                found = found.min(distance(segment));
                found
            });
            assert_eq!(found, least);
        }
    }
}

#[test]
fn a_line_that_was_cut_is_one_run_at_any_angle_and_distance() {
    for i in 0..400 {
        let angle = f64::from(noise(i)) * core::f64::consts::TAU;
        let along = DVec2::new(libm::cos(angle), libm::sin(angle));
        let far = [0.0, 1.0, 100.0, 3000.0][i % 4];
        let from = DVec2::new(f64::from(noise(i + 7)) - 0.5, f64::from(noise(i + 70)) - 0.5) * far;
        let chain = Chain::open(cut_line(from, along, 200)).unwrap();
        assert_eq!(names(&chain), [0], "{from} {along}");
        let run = chain.run_of(5).unwrap();
        let chord = chain.chord(&run).unwrap().ends().map(Vec2::as_dvec2);
        let straight = (chord[1] - chord[0]).normalize();
        assert!(straight.perp_dot(along).abs() < 1e-5, "{straight} {along}");
        for &vertex in chain.vertices() {
            let aside = straight.perp_dot(vertex.as_dvec2() - chord[0]).abs();
            assert!(aside <= run.unevenness(), "{aside} {run:?}");
        }
        assert!(run.unevenness() <= 1e-6 * (far + 200.0), "{run:?}");
    }
}

#[test]
fn no_vertex_lies_further_beside_its_run_than_is_told() {
    // Rounding along the line is as large as the bump is long, but the bump is more than the rounding across the line.
    let bump = Chain::open([(1000.0, 0.0), (999.999_9, 1e-4), (900.0, 0.0)].map(Vec2::from)).unwrap();
    assert_eq!(names(&bump), [0, 1]);
    for i in 0..20_000 {
        let random = |k: usize| noise(i * 64 + k);
        let far = Vec2::new(random(0), random(1) * random(2)) * [1.0, 1e1, 1e2, 1e3, 1e4, 1e5][i % 6];
        let pace = far.length() * [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7][i / 6 % 8];
        let mut at = far;
        let place = |k: usize| {
            at += Vec2::new(random(3 * k) * random(3 * k + 1), (random(3 * k + 2) - 0.5) * 0.5) * pace;
            at
        };
        let Ok(chain) = Chain::open((1..12).map(place)) else { continue };
        for segment in 0..chain.segment_count() as u32 {
            let run = chain.run_of(segment).unwrap();
            let [from, to] = chain.chord(&run).unwrap().ends().map(Vec2::as_dvec2);
            let aside = chain.vertices()[segment as usize].as_dvec2() - from;
            let aside = (to - from).normalize().perp_dot(aside).abs();
            assert!(aside <= run.unevenness() * (1.0 + 1e-6), "{i}: {aside} {run:?} {chain:?}");
        }
    }
}

#[test]
fn bends_end_a_run_and_the_seam_of_a_closed_chain_does_not() {
    let bent = |angle: f32| {
        [Vec2::ZERO, Vec2::X, Vec2::new(2.0, 0.0), Vec2::new(3.0, angle), Vec2::new(4.0, 2.0 * angle)]
    };
    assert_eq!(names(&Chain::open(bent(1e-4)).unwrap()), [0, 2]);
    assert_eq!(names(&Chain::open(bent(-1e-4)).unwrap()), [0, 2]);
    assert_eq!(names(&Chain::open(bent(0.0)).unwrap()), [0]);
    // There and back.
    assert_eq!(names(&Chain::open([Vec2::ZERO, Vec2::X, Vec2::X * 0.5]).unwrap()), [0, 1]);
    let square = [(1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0), (0.5, 0.0)];
    let square = Chain::closed(square.map(|(x, y)| Vec2::new(x, y))).unwrap();
    // Segments 5, 6 and 0 are its foot.
    assert_eq!((0..7).map(|i| square.run_of(i).unwrap().first()).collect::<Vec<_>>(), [5, 1, 2, 2, 4, 5, 5]);
    let foot = square.run_of(0).unwrap();
    assert_eq!((foot.vertices(), square.run_before(&foot).unwrap().first()), ([5, 1], 4));
    assert_eq!(square.run_after(&foot).unwrap().first(), 1);
}

#[test]
fn vertices_that_repeat_are_left_out_and_counted() {
    let (zero, x, y) = (Vec2::ZERO, Vec2::X, Vec2::Y);
    let chain = Chain::open([zero, zero, x, x * (1.0 + 1e-7), y, y]).unwrap();
    assert_eq!((chain.vertices(), chain.dropped()), (&[zero, x, y][..], 3));
    let ring = Chain::closed([zero, x, y, y, zero, zero]).unwrap();
    assert_eq!((ring.vertices(), ring.dropped(), ring.segment_count()), (&[zero, x, y][..], 3, 3));
    assert_eq!(ring, Chain::closed([zero, x, y]).unwrap(), "what was left out does not count");
    assert_ne!(ring, ring.clone().one_sided());
    assert_eq!(Chain::open([x; 5]), Err(ChainError::TooFew { count: 1, needed: 2 }));
    assert_eq!(Chain::open([]), Err(ChainError::TooFew { count: 0, needed: 2 }));
    assert_eq!(Chain::open([zero, x * 2e6]), Err(ChainError::TooLarge { index: 1 }));
    let many = (0..MAX_CHAIN_VERTICES + 5).map(|i| Vec2::new((i % 1000) as f32, (i / 1000) as f32));
    assert_eq!(Chain::open(many), Err(ChainError::TooMany { at_least: MAX_CHAIN_VERTICES + 1 }));
}

#[test]
fn its_box_is_that_of_its_vertices_however_it_is_turned() {
    let chain = Chain::closed(wild(333)).unwrap();
    let [turned, other] = [Vec2::X, Vec2::Y].map(|way| crate::Rotation2::new(way.x, way.y).unwrap());
    for i in 0..56 {
        let rotation = match i {
            50 | 51 => turned,
            52 | 53 => turned.inverse() * other,
            54 => other * other,
            55 => other * other * other,
            _ => crate::Rotation2::from_angle(noise(i) * 6.5).unwrap(),
        };
        let pose = Pose2::new([1e5 * f64::from(noise(i + 50)), -3.0], rotation).unwrap();
        let all = around2(chain.vertices().iter().map(|vertex| vertex.as_dvec2()), &pose, 0.25);
        let found = chain.bounds(&pose, 0.25);
        assert!(i < 50 || found == all, "to the bit, where it is turned by right angles");
        assert!((found.min - all.min).abs().max((found.max - all.max).abs()).max_element() <= 1e-7 * 1e5);
        let corners = chain.vertices().iter().map(|&vertex| pose.transform(vertex).as_vec2());
        assert!(corners.into_iter().all(|corner| found.contains(corner)));
    }
}

/// Symptom: queries that met a level floor took as much longer as it had more vertices. Cause: of segments that reach
/// equally far, all were looked at for the chain's box.
#[test]
fn few_segments_of_a_level_floor_are_looked_at_for_its_box() {
    let floor = Chain::open((0..100_000).map(|x| Vec2::new(x as f32, 0.0))).unwrap();
    let steps = Chain::open((0..100_000).map(|x| Vec2::new((x % 300) as f32, (x / 300) as f32))).unwrap();
    for direction in [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y, DVec2::new(0.6, -0.8)] {
        for chain in [&floor, &steps] {
            let (found, count) = chain.furthest_after(direction);
            let furthest = chain.vertices().iter().map(|vertex| direction.dot(vertex.as_dvec2()));
            assert_eq!(found.map(|vertex| direction.dot(vertex)), furthest.reduce(f64::max));
            assert!(count <= 64, "{count} segments along {direction}");
        }
    }
}
