use super::super::course::Course;
use super::super::impact;
use super::super::piece::for_pieces;
use super::super::stretch::{Stretch, Travel};
use super::{Legs, in_axes_of};
use crate::counted::steps_of;
use crate::impact2::Impact2;
use crate::numbers::Numbers;
use crate::pair2::Pair2;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Capsule2, Circle, Compound2, Motion2, Pose2, Rect, Rotation2, Shape2};

fn rotation(numbers: &mut Numbers) -> Rotation2 {
    let angle = 4.0 * numbers.number();
    Rotation2::new(libm::cos(angle) as f32, libm::sin(angle) as f32).unwrap()
}

fn vector(numbers: &mut Numbers) -> DVec2 {
    numbers.vector().truncate()
}

fn shape(numbers: &mut Numbers) -> Shape2 {
    let kind = numbers.below(3);
    let mut size = || (0.3 + 0.2 * numbers.number()) as f32;
    match kind {
        0 => Circle::new(size()).unwrap().into(),
        1 => Rect::from_half_extents(Vec2::new(size(), size())).unwrap().into(),
        _ => Capsule2::from_half_height(2.0 * size(), size()).unwrap().into(),
    }
}

/// Parts all over a box about a point.
fn cloud(numbers: &mut Numbers, count: u64, about: DVec2, half: DVec2) -> Shape2 {
    let mut part = || {
        let place = about + vector(numbers) * half;
        (Pose2::new(place, rotation(numbers)).unwrap(), shape(numbers))
    };
    Compound2::new((0..count).map(|_| part()).collect::<Vec<_>>()).unwrap().into()
}

/// Boxes and balls in turn, in rows about the origin.
fn rows(counts: [u32; 2]) -> Shape2 {
    let kinds =
        [Shape2::from(Circle::new(0.4).unwrap()), Rect::from_half_extents(Vec2::splat(0.4)).unwrap().into()];
    let parts = (0..counts[0] * counts[1]).map(|i| {
        let cell = [i % counts[0], i / counts[0]];
        let [x, y] = [0, 1].map(|axis| f64::from(cell[axis]) - 0.5 * f64::from(counts[axis] - 1));
        (Pose2::at([x, y]).unwrap(), kinds[i as usize % 2].clone())
    });
    Compound2::new(parts.collect::<Vec<_>>()).unwrap().into()
}

/// The answer of all pairs of parts within a stretch, one after the other, for two bodies that do not touch at the
/// start.
fn plainly(pair: &Pair2, stretch: &Stretch) -> Option<Impact2> {
    let (mut first, mut end) = (None, 1.0);
    for_pieces(pair.shape_a, |a| {
        for_pieces(pair.shape_b, |b| {
            let touching = Course::new(stretch, [a, b], end).and_then(|course| course.first_touch());
            if let Some(touching) = touching.filter(|touching| first.is_none() || touching.at < end) {
                end = touching.at;
                first = Some(impact(stretch, &touching, [a, b]));
            }
        });
    });
    first
}

#[test]
fn what_legs_leave_out_is_never_what_is_met() {
    let mut numbers = Numbers::new(2712);
    let mut outcomes = [0; 2];
    for i in 0..900 {
        let far = [DVec2::ZERO, DVec2::new(1e5, -2e5)][i % 2];
        let half = vector(&mut numbers) * 3.0 + DVec2::splat(3.5);
        let arm = [DVec2::ZERO, vector(&mut numbers) * 9.0][i / 2 % 2];
        let counts = [16 + numbers.below(60), 1 + numbers.below(60)];
        let (one, two) =
            (cloud(&mut numbers, counts[0], arm, half), cloud(&mut numbers, counts[1], arm, half));
        let here = Pose2::new(far, rotation(&mut numbers)).unwrap();
        let from = vector(&mut numbers).normalize()
            * (f64::from(one.outer_radius()) * (1.7 + 0.3 * numbers.number()));
        let there = Pose2::new(far + from, rotation(&mut numbers)).unwrap();
        let way = (vector(&mut numbers) * 0.5 - from.normalize()) * from.length() * numbers.number().abs();
        // Up to some whole turns.
        let most = [0.05, 0.5, 3.1, 20.0][i / 4 % 4];
        let (turn, other) = (most * numbers.number(), if i % 3 == 0 { 0.0 } else { most * numbers.number() });
        let motions = [
            Motion2::of_velocities(&here, DVec2::ZERO, turn, 1.0).unwrap(),
            Motion2::of_velocities(&there, way, other, 1.0).unwrap(),
        ];
        for [(a, in_a, moves_a), (b, in_b, moves_b)] in [
            [(&one, &here, &motions[0]), (&two, &there, &motions[1])],
            [(&two, &there, &motions[1]), (&one, &here, &motions[0])],
        ] {
            let pair = Pair2::new(a, in_a, b, in_b);
            if pair.overlaps() {
                continue;
            }
            let travel = Travel::of(&pair, [moves_a, moves_b]);
            let truth = travel.stretches().iter().find_map(|stretch| plainly(&pair, stretch));
            assert_eq!(pair.impact(moves_a, moves_b), truth, "{i}");
            outcomes[usize::from(truth.is_some())] += 1;
        }
    }
    assert!(outcomes[0] > 200 && outcomes[1] > 400, "{outcomes:?}");
}

#[test]
fn a_ball_is_within_its_legs_at_all_times() {
    let mut numbers = Numbers::new(1829);
    let (mut furthest, mut count) = (0.0_f64, 0);
    for i in 0..400 {
        let compound = rows([5, 5]);
        let many = crate::among::many2(&compound).unwrap();
        let (here, arm) = (
            Pose2::new(vector(&mut numbers) * 3.0, rotation(&mut numbers)).unwrap(),
            vector(&mut numbers) * 6.0,
        );
        let there = Pose2::new(vector(&mut numbers) * 9.0, rotation(&mut numbers)).unwrap();
        let ball =
            Compound2::new([(Pose2::at(arm).unwrap(), Circle::new(0.5).unwrap().into())]).unwrap().into();
        let pair = Pair2::new(&compound, &here, &ball, &there);
        let way = vector(&mut numbers) * 8.0;
        let turns = [3.1 * numbers.number(), 3.1 * numbers.number() * f64::from(i % 2)];
        let motions = [
            Motion2::of_velocities(&here, DVec2::ZERO, turns[0], 1.0).unwrap(),
            Motion2::of_velocities(&there, way, turns[1], 1.0).unwrap(),
        ];
        let until = numbers.number().abs();
        for stretch in Travel::of(&pair, [&motions[0], &motions[1]]).stretches() {
            for_pieces(&ball, |piece| {
                let legs = Legs::new(stretch, (many, 0), (piece, until));
                for leg in &legs.legs {
                    let beside = leg.radius - piece.outer;
                    for share in (0..=16).map(|step| f64::from(step) / 16.0) {
                        let truth = in_axes_of(stretch, 0, piece.center, leg.from + leg.span * share);
                        let off = (leg.start + leg.way * share - truth).length();
                        assert!(off <= beside, "{i}: {off} {beside}");
                        furthest = furthest.max(off / beside.max(0.01));
                    }
                }
                count += legs.legs.len();
            });
        }
    }
    assert!(furthest > 0.5 && count > 800, "the bound is no empty one: {furthest}, {count}");
}

/// Steps per part, for bodies of such rows that fly past and into each other while one or both turn by `turn`.
fn steps_a_part(rows_of: [[u32; 2]; 2], turn: f64) -> usize {
    let mut numbers = Numbers::new(9104);
    let bodies = rows_of.map(rows);
    let parts: u32 = rows_of.iter().map(|counts| counts.iter().product::<u32>()).sum();
    let size = f64::from(bodies[0].outer_radius() + bodies[1].outer_radius());
    let (mut all, mut met) = (0, 0);
    for i in 0..8 {
        let here = Pose2::new(DVec2::ZERO, rotation(&mut numbers)).unwrap();
        let away = vector(&mut numbers).normalize();
        let there = Pose2::new(away * size, rotation(&mut numbers)).unwrap();
        let way = (vector(&mut numbers) * 0.5 - away) * size;
        let motion = Motion2::of_velocities(&there, way, turn, 1.0).unwrap();
        let other = Motion2::of_velocities(&here, DVec2::ZERO, f64::from(i % 2) * turn, 1.0).unwrap();
        let pair = Pair2::new(&bodies[0], &here, &bodies[1], &there);
        let (impact, steps) = steps_of(|| pair.impact(&other, &motion));
        all += steps;
        met += usize::from(impact.is_some());
    }
    assert!(met > 0);
    all / parts as usize
}

#[test]
fn large_turns_take_as_much_longer_as_there_are_more_parts() {
    for turn in [0.4, 1.57, 3.0] {
        let [few, many] = [8, 40].map(|edge| steps_a_part([[edge; 2]; 2], turn));
        assert!(
            many < 2 * few,
            "squares that turn by {turn}, steps a part: {few}, and {many} of 25 times as many"
        );
        let [few, many] = [64, 1024].map(|length| steps_a_part([[length, 1], [1, length]], turn));
        assert!(
            many < 4 * few,
            "bars that turn by {turn}, steps a part: {few}, and {many} of 16 times as many"
        );
    }
}
