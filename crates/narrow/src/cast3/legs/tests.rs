use super::super::advance::End;
use super::super::passage::Passage;
use super::super::{impact_of, part_end};
use crate::counted::steps_of;
use crate::impact3::Impact3;
use crate::numbers::Numbers;
use crate::pair3::{Pair3, Part, for_parts};
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Capsule3, Compound3, Cuboid, Motion3, Pose3, Shape3, Sphere};

fn rotation(numbers: &mut Numbers) -> Quat {
    let v = numbers.vector().as_vec3();
    Quat::from_xyzw(v.x, v.y, v.z, numbers.number() as f32)
}

fn shape(numbers: &mut Numbers) -> Shape3 {
    let kind = numbers.below(3);
    let mut size = || (0.3 + 0.2 * numbers.number()) as f32;
    match kind {
        0 => Sphere::new(size()).unwrap().into(),
        1 => Cuboid::from_half_extents(Vec3::new(size(), size(), size())).unwrap().into(),
        _ => Capsule3::from_half_height(2.0 * size(), size()).unwrap().into(),
    }
}

/// Parts all over a box about a point.
fn cloud(numbers: &mut Numbers, count: u64, about: DVec3, half: DVec3) -> Shape3 {
    let mut part = || {
        let place = about + numbers.vector() * half;
        (Pose3::new(place, rotation(numbers)).unwrap(), shape(numbers))
    };
    Compound3::new((0..count).map(|_| part()).collect::<Vec<_>>()).unwrap().into()
}

/// Boxes and balls in turn, in rows about the origin.
fn rows(counts: [u32; 3]) -> Shape3 {
    let kinds = [
        Shape3::from(Sphere::new(0.4).unwrap()),
        Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap().into(),
    ];
    let [x, y, z] = counts;
    let parts = (0..x * y * z).map(|i| {
        let cell = [i % x, i / x % y, i / x / y];
        let [x, y, z] = [0, 1, 2].map(|axis| f64::from(cell[axis]) - 0.5 * f64::from(counts[axis] - 1));
        (Pose3::at([x, y, z]).unwrap(), kinds[i as usize % 2].clone())
    });
    Compound3::new(parts.collect::<Vec<_>>()).unwrap().into()
}

/// A motion by a displacement, with a turn of up to `most` radians about a random axis.
fn motion(numbers: &mut Numbers, from: &Pose3, way: DVec3, most: f64) -> Motion3 {
    let turn = (numbers.vector().normalize() * most * numbers.number()).as_vec3();
    Motion3::of_velocities(from, way, turn, 1.0).unwrap()
}

/// The answer of all pairs of parts, one after the other, for two bodies that do not touch at the start.
fn plainly(pair: &Pair3, passage: &Passage) -> Option<Impact3> {
    let mut first: Option<Impact3> = None;
    let mut visit = |a: Part, b: Part| {
        let until = first.map_or(1.0, |known| known.fraction);
        let Some(stretch) = passage.stretch([&a, &b], until) else { return };
        let (End::Met(met) | End::Unclear(met, false)) = part_end(passage, [a, b], &stretch, until) else {
            return;
        };
        if first.is_none_or(|known| met.fraction < known.fraction) {
            first = Some(impact_of(&met, [a.index, b.index]));
        }
    };
    for_parts(pair.shape_a, &passage.bases[0], |a| {
        for_parts(pair.shape_b, &passage.bases[1], |b| {
            visit(a, b);
            false
        })
    });
    first
}

#[test]
fn what_legs_leave_out_is_never_what_is_met() {
    let mut numbers = Numbers::new(2711);
    let mut outcomes = [0; 2];
    for i in 0..900 {
        let far = [DVec3::ZERO, DVec3::new(1e5, -2e5, 3e4)][i % 2];
        let half = numbers.vector() * 2.0 + DVec3::splat(2.5);
        let arm = [DVec3::ZERO, numbers.vector() * 9.0][i / 2 % 2];
        let counts = [16 + numbers.below(60), 1 + numbers.below(60)];
        let (one, two) =
            (cloud(&mut numbers, counts[0], arm, half), cloud(&mut numbers, counts[1], arm, half));
        let here = Pose3::new(far, rotation(&mut numbers)).unwrap();
        let from =
            numbers.vector().normalize() * (f64::from(one.outer_radius()) * (1.7 + 0.3 * numbers.number()));
        let there = Pose3::new(far + from, rotation(&mut numbers)).unwrap();
        let way = (numbers.vector() * 0.5 - from.normalize()) * from.length() * numbers.number().abs();
        // Up to some whole turns.
        let most = [0.05, 0.5, 3.1, 20.0][i / 4 % 4];
        let motions = [
            motion(&mut numbers, &here, DVec3::ZERO, most),
            motion(&mut numbers, &there, way, if i % 3 == 0 { 0.0 } else { most }),
        ];
        for [(a, in_a, moves_a), (b, in_b, moves_b)] in [
            [(&one, &here, &motions[0]), (&two, &there, &motions[1])],
            [(&two, &there, &motions[1]), (&one, &here, &motions[0])],
        ] {
            let pair = Pair3::new(a, in_a, b, in_b);
            if pair.overlaps() {
                continue;
            }
            let truth = plainly(&pair, &Passage::of_motions(&pair, [moves_a, moves_b]));
            assert_eq!(pair.impact(moves_a, moves_b), truth, "{i}");
            outcomes[usize::from(truth.is_some())] += 1;
        }
    }
    assert!(outcomes[0] > 200 && outcomes[1] > 400, "{outcomes:?}");
}

#[test]
fn a_ball_is_within_its_legs_at_all_times() {
    let mut numbers = Numbers::new(1828);
    let (mut furthest, mut count) = (0.0_f64, 0);
    for i in 0..400 {
        let compound = rows([3, 3, 3]);
        let many = crate::among::many3(&compound).unwrap();
        let (here, arm) =
            (Pose3::new(numbers.vector() * 3.0, rotation(&mut numbers)).unwrap(), numbers.vector() * 6.0);
        let there = Pose3::new(numbers.vector() * 9.0, rotation(&mut numbers)).unwrap();
        let ball =
            Compound3::new([(Pose3::at(arm).unwrap(), Sphere::new(0.5).unwrap().into())]).unwrap().into();
        let pair = Pair3::new(&compound, &here, &ball, &there);
        let way = numbers.vector() * 8.0;
        let motions = [
            motion(&mut numbers, &here, DVec3::ZERO, 3.1),
            motion(&mut numbers, &there, way, 3.1 * f64::from(i % 2)),
        ];
        let passage = Passage::of_motions(&pair, [&motions[0], &motions[1]]);
        let until = numbers.number().abs();
        for_parts(&ball, &passage.bases[1], |part| {
            let legs = passage.legs((many, 0), &part, until);
            let local = passage.bases[1].turn_back(part.center);
            for leg in &legs.legs {
                let ends = passage.bend(0, part.center.length(), [leg.from, leg.from + leg.span]);
                let beside = 0.125 * ends * leg.span * leg.span;
                for share in (0..=16).map(|step| f64::from(step) / 16.0) {
                    let truth = passage.in_axes_of(0, local, leg.from + leg.span * share);
                    let off = (leg.start + leg.way * share - truth).length();
                    assert!(off <= beside + 1e-12 && beside < leg.radius - 0.5, "{i}: {off} {beside}");
                    furthest = furthest.max(off / beside.max(0.01));
                }
            }
            count += legs.legs.len();
            false
        });
    }
    assert!(furthest > 0.5 && count > 800, "the bound is no empty one: {furthest}, {count}");
}

/// Steps per part, for bodies of such rows that fly past and into each other while one or both turn by `turn`.
fn steps_a_part(rows_of: [[u32; 3]; 2], turn: f32) -> usize {
    let mut numbers = Numbers::new(9103);
    let bodies = rows_of.map(rows);
    let parts: u32 = rows_of.iter().map(|counts| counts.iter().product::<u32>()).sum();
    let size = f64::from(bodies[0].outer_radius() + bodies[1].outer_radius());
    let (mut all, mut met) = (0, 0);
    for i in 0..8 {
        let (here, away) =
            (Pose3::new(DVec3::ZERO, rotation(&mut numbers)).unwrap(), numbers.vector().normalize());
        let there = Pose3::new(away * size, rotation(&mut numbers)).unwrap();
        let way = (numbers.vector() * 0.5 - away) * size;
        let [x, y, z] = numbers.vector().as_vec3().normalize().to_array().map(|v| v * libm::sinf(0.5 * turn));
        let spin = Quat::from_xyzw(x, y, z, libm::cosf(0.5 * turn));
        let motion = Motion3::new(way, spin * there.rotation()).unwrap();
        let other = [Motion3::STILL, Motion3::new(DVec3::ZERO, spin * here.rotation()).unwrap()][i % 2];
        let pair = Pair3::new(&bodies[0], &here, &bodies[1], &there);
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
        let [few, many] = [4, 12].map(|edge| steps_a_part([[edge; 3]; 2], turn));
        assert!(
            many < 2 * few,
            "cubes that turn by {turn}, steps a part: {few}, and {many} of 27 times as many"
        );
        let [few, many] = [64, 1024].map(|length| steps_a_part([[length, 1, 1], [1, length, 1]], turn));
        assert!(
            many < 4 * few,
            "bars that turn by {turn}, steps a part: {few}, and {many} of 16 times as many"
        );
    }
}
