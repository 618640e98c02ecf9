//! Bodies that move over ground, and turn.

use super::{beside, level, mesh, sheet, triangles};
use crate::casts::Course;
use asunder_geometry::glam::{DVec3, Quat, Vec2, Vec3};
use asunder_geometry::{Cuboid, Ground, HeightField, Motion3, Pose3, Shape3, Sphere, TriMesh};
use asunder_narrow::{Impact3, Pair3};
use asunder_tests::cases::{Case3, Random};
use asunder_tests::shapes::{Clay, KINDS3};

/// A body near ground, and a displacement that may lead into it.
fn cast_case(kind: usize, round: usize) -> (Case3, Vec3) {
    let mut random = Random::new((kind * 1000 + round) as u128);
    let (ground, at) = level(&mut random, round);
    let body = KINDS3[kind].1(&mut Clay::new(&mut random, [0.3, 1.0, 0.05][round / 2 % 3]));
    let reach = if body.outer_radius().is_finite() { f64::from(body.outer_radius()) } else { 3.0 };
    let away = reach * random.between(0.8, 4.0);
    let place = beside(&mut random, (&ground, &at), away);
    let past = reach * random.between(0.0, 1.2);
    let aim = beside(&mut random, (&ground, &at), past);
    let moved = (aim - place) * random.pick(&[0.5, 1.0, 2.0, 20.0]);
    let pose = Pose3::new(place - body.center().as_dvec3(), random.quaternion()).unwrap();
    (Case3 { shape_a: body, pose_a: pose, shape_b: ground, pose_b: at }, moved.as_vec3())
}

/// A triangle that is hit when tested alone: its number, the triangle, and the impact.
type Touched = (u32, Shape3, Impact3);

/// All triangles that are hit, in order of time.
fn slowly(course: &Course) -> Vec<Touched> {
    let Case3 { shape_a, pose_a, shape_b, pose_b } = course.case;
    let [of_body, of_ground] = &course.motions;
    let mut touched: Vec<Touched> = triangles(shape_b)
        .into_iter()
        .filter_map(|(number, triangle)| {
            let impact = Pair3::new(shape_a, pose_a, &triangle, pose_b).impact(of_body, of_ground)?;
            Some((number, triangle, impact))
        })
        .collect();
    touched.sort_by(|one, other| one.2.fraction.total_cmp(&other.2.fraction));
    touched
}

/// The numbers of the triangles that may be hit first: those hit at the time of the first impact, or that are touching
/// at that time within the errors.
fn first_of(course: &Course, touched: &[Touched]) -> Vec<u32> {
    let Some((.., first)) = touched.first() else { return vec![] };
    let Case3 { shape_a, pose_a, pose_b, .. } = course.case.clone();
    let is_first = |(_, triangle, own): &&Touched| {
        let alone = Case3 { shape_a: shape_a.clone(), pose_a, shape_b: triangle.clone(), pose_b };
        let alone = Course { case: &alone, motions: course.motions };
        own.fraction == first.fraction || {
            let (separation, error) = alone.separation(first.fraction);
            separation - error <= f64::from(own.error + first.error) + course.rounding()
        }
    };
    touched.iter().filter(is_first).map(|(number, ..)| *number).collect()
}

/// Checks an impact on ground, or that there is none.
fn check(course: &Course, impact: Option<Impact3>, told: &str) {
    let Case3 { shape_a, pose_a, shape_b, pose_b } = course.case;
    let overlaps = Pair3::new(shape_a, pose_a, shape_b, pose_b).overlaps();
    let Some(impact) = impact else {
        assert!(!overlaps, "{told}");
        return course.check_free(1.0, told);
    };
    assert_eq!(impact.overlapping, overlaps, "{told}: {impact:?}");
    assert!((impact.normal.length() - 1.0).abs() < 1e-6 && impact.anchor_a.is_finite(), "{told}: {impact:?}");
    if impact.overlapping {
        return assert!(impact.fraction == 0.0 && impact.error == 0.0, "{told}: {impact:?}");
    }
    let (separation, error) = course.separation(impact.fraction);
    assert!(separation - error <= f64::from(impact.error), "{told}: {separation} {impact:?}");
    course.check_free(impact.fraction, told);
    let [a, b] = course.poses(impact.fraction);
    let [on_a, on_b] = [(a, impact.anchor_a), (b, impact.anchor_b)]
        .map(|(pose, anchor)| pose.position() + anchor.as_dvec3());
    let reach = course.size() + f64::from(impact.anchor_a.length() + impact.anchor_b.length());
    let slack = f64::from(impact.error) + 4e-7 * reach + course.rounding();
    assert!((on_a - on_b).length() <= slack, "{told}: {impact:?}");
}

/// Asserts that fraction and presence agree with the first of all triangles, except where the body only grazes. Returns
/// whether they agree without that exception.
fn compare(course: &Course, ours: Option<Impact3>, slow: Option<Impact3>, told: &str) -> bool {
    let length = course.motions.iter().map(|motion| motion.displacement().length()).sum::<f64>();
    match (ours, slow) {
        (None, None) => true,
        (Some(ours), Some(slow)) => {
            let slack = f64::from(ours.error.max(slow.error)) + 1e-9 * length;
            let closing = (ours.fraction - slow.fraction).abs() * length;
            ours.fraction == slow.fraction || closing <= slack * 4.0 || {
                // Grazing: at both times the body is next to the ground.
                let (separation, error) = course.separation(ours.fraction.max(slow.fraction));
                assert!(separation.abs() <= slack + error + course.rounding(), "{told}: {ours:?} {slow:?}");
                false
            }
        }
        (Some(one), None) | (None, Some(one)) => {
            let (separation, error) = course.separation(one.fraction);
            assert!(separation.abs() <= f64::from(one.error) + error + course.rounding(), "{told}: {one:?}");
            false
        }
    }
}

#[test]
fn what_moves_is_stopped_where_the_first_triangle_stops_it() {
    let (mut hits, mut misses, mut starts, mut differ, mut alone) = (0, 0, 0, 0, 0);
    for (kind, (name, _)) in KINDS3.iter().enumerate() {
        for round in 0..48 {
            let (case, moved) = cast_case(kind, round);
            let told = format!("{name} {round}");
            let Ok(motion) = Motion3::shift(moved) else { continue };
            let course = Course { case: &case, motions: [motion, Motion3::STILL] };
            let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
            let impact = pair.cast(moved);
            check(&course, impact, &told);
            let touched = slowly(&course);
            differ += usize::from(!compare(&course, impact, touched.first().map(|first| first.2), &told));
            // The same with the ground moving instead.
            let back = Pair3::new(&case.shape_b, &case.pose_b, &case.shape_a, &case.pose_a).cast(-moved);
            assert_eq!(back.is_some(), impact.is_some(), "{told}");
            let (Some(impact), Some(back)) = (impact, back) else {
                misses += 1;
                continue;
            };
            if impact.overlapping {
                starts += 1;
                continue;
            }
            hits += 1;
            let may_be = first_of(&course, &touched);
            assert!(may_be.contains(&impact.part_b), "{told}: {may_be:?} {impact:?}");
            assert!(may_be.contains(&back.part_a), "{told}: {may_be:?} {back:?}, the ground moves");
            alone += usize::from(may_be.len() == 1 && touched.len() > 1);
        }
    }
    assert!(hits > 120 && misses > 60 && starts > 60, "{hits} {misses} {starts}");
    assert!(differ * 20 < hits, "{differ} of {hits} differ");
    assert!(alone > 80, "of {hits}, {alone} could be but one triangle of several that are touched");
}

#[test]
fn what_turns_is_stopped_where_the_first_triangle_stops_it() {
    let (mut hits, mut misses, mut alone) = (0, 0, 0);
    for (kind, (name, _)) in KINDS3.iter().enumerate() {
        for round in 0..18 {
            let (case, moved) = cast_case(kind, round);
            let told = format!("{name} {round}");
            let mut random = Random::new((kind * 77 + round) as u128);
            let moved = moved.as_dvec3().clamp_length_max(6.0);
            let turning = Motion3::new(moved, random.quaternion()).unwrap();
            // In one of three cases the ground turns too.
            let of_ground = match round % 3 {
                0 => Motion3::new(random.vector(), random.quaternion()).unwrap(),
                1 => Motion3::shift(random.vector()).unwrap(),
                _ => Motion3::STILL,
            };
            let course = Course { case: &case, motions: [turning, of_ground] };
            let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
            let impact = pair.impact(&turning, &of_ground);
            check(&course, impact, &told);
            let touched = slowly(&course);
            compare(&course, impact, touched.first().map(|first| first.2), &told);
            misses += usize::from(impact.is_none());
            let Some(impact) = impact.filter(|impact| !impact.overlapping) else { continue };
            hits += 1;
            let may_be = first_of(&course, &touched);
            assert!(may_be.contains(&impact.part_b), "{told}: {may_be:?} {impact:?}");
            let back = Pair3::new(&case.shape_b, &case.pose_b, &case.shape_a, &case.pose_a);
            let back = back.impact(&of_ground, &turning).unwrap();
            assert!(may_be.contains(&back.part_a), "{told}: {may_be:?} {back:?}, the ground first");
            alone += usize::from(may_be.len() == 1 && touched.len() > 1);
        }
    }
    assert!(hits > 40 && misses > 15 && alone > 25, "{hits} {misses} {alone}");
}

#[test]
fn on_a_plane_the_triangle_that_is_met_is_named_and_not_the_first_of_the_plane() {
    let floor = mesh(sheet([6, 4], [1.0, 0.5], |x, z| 0.25 * x - 0.5 * z, |i, j| i == 2 && j == 1));
    let heights: Vec<f32> = (0..35).map(|at| 0.25 * (at % 7) as f32 - 0.5 * (at / 7) as f32).collect();
    let field = HeightField::new(7, 5, heights, Vec2::ONE).unwrap().with_hole(3, 1).unwrap();
    let ball = Shape3::from(Sphere::new(0.125).unwrap());
    let up = Vec3::new(-0.25, 1.0, 0.5);
    for ground in [floor, field.into()] {
        for (number, triangle) in triangles(&ground) {
            let Shape3::Triangle(corners) = triangle else { unreachable!() };
            let middle = corners.vertices().into_iter().sum::<Vec3>() / 3.0;
            let pose = Pose3::at((middle + up).as_dvec3()).unwrap();
            let down = Pair3::new(&ball, &pose, &ground, &Pose3::IDENTITY).cast(-up).unwrap();
            let rising = Pair3::new(&ground, &Pose3::IDENTITY, &ball, &pose).cast(up).unwrap();
            assert_eq!((down.part_a, down.part_b), (0, number), "{down:?}");
            assert_eq!((rising.part_a, rising.part_b), (number, 0), "{rising:?}");
        }
    }
}

fn one_sided_floor() -> Shape3 {
    let (vertices, triangles) = sheet([6, 6], [1.0, 1.0], |_, _| 0.0, |_, _| false);
    TriMesh::new(vertices, triangles).unwrap().one_sided().into()
}

#[test]
fn one_sided_ground_stops_what_comes_from_its_front_and_nothing_else() {
    let one = one_sided_floor();
    let Shape3::TriMesh(inner) = &one else { unreachable!() };
    let both = Shape3::from(TriMesh::new(inner.vertices(), inner.triangles()).unwrap());
    let crate_ = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.3, 0.2, 0.4)).unwrap());
    let ball = Shape3::from(Sphere::new(0.25).unwrap());
    for body in [&crate_, &ball] {
        for (height, way, by_both, by_one) in [
            (2.0, -4.0, true, true),
            // All the way through in one motion.
            (2.0, -4000.0, true, true),
            (-2.0, 4.0, true, false),
            (-2.0, 4000.0, true, false),
            (2.0, 4.0, false, false),
            // Half way through: the side of the centre decides.
            (0.1, -4.0, true, true),
            (-0.1, 4.0, true, false),
            (-0.1, -4.0, true, false),
        ] {
            let pose = Pose3::at([0.1, height, 0.2]).unwrap();
            for (ground, expected) in [(&both, by_both), (&one, by_one)] {
                let pair = Pair3::new(body, &pose, ground, &Pose3::IDENTITY);
                let impact = pair.cast(Vec3::Y * way);
                assert_eq!(impact.is_some(), expected, "{height} {way} {body:?}");
                let turning = Motion3::new(Vec3::Y * way, Quat::from_xyzw(0.0, 0.3, 0.0, 1.0)).unwrap();
                let turned = pair.impact(&turning, &Motion3::STILL);
                assert_eq!(turned.is_some(), expected, "{height} {way} {body:?}, turning");
                if let Some(impact) = impact {
                    // From A to B: against the front, or the back.
                    let down = if height > 0.0 { Vec3::NEG_Y } else { Vec3::Y };
                    assert!(impact.normal.dot(down) > 1.0 - 1e-6, "{height} {way}: {impact:?}");
                    assert_eq!(impact.overlapping, height.abs() < 0.15);
                }
            }
        }
    }
}

#[test]
fn a_compound_is_stopped_by_the_part_that_one_sided_ground_sees() {
    let ball = Shape3::from(Sphere::new(0.25).unwrap());
    let parts = [(Pose3::at(Vec3::Y * 1.5).unwrap(), ball.clone()), (Pose3::at(Vec3::NEG_Y).unwrap(), ball)];
    let two = Shape3::from(asunder_geometry::Compound3::new(parts).unwrap());
    let floor = one_sided_floor();
    let pair_at = |height: f64| Pose3::at([0.1, height, 0.2]).unwrap();
    // One ball above the floor, one below.
    let pose = pair_at(0.0);
    let impact = Pair3::new(&two, &pose, &floor, &Pose3::IDENTITY).cast(Vec3::NEG_Y * 3.0).unwrap();
    assert_eq!(impact.part_a, 0);
    assert!((impact.fraction - 1.25 / 3.0).abs() < 1e-6, "{impact:?}");
    let back = Pair3::new(&floor, &Pose3::IDENTITY, &two, &pose).cast(Vec3::Y * 3.0).unwrap();
    assert_eq!((back.part_b, back.fraction), (0, impact.fraction));
    assert_eq!(Pair3::new(&two, &pose, &floor, &Pose3::IDENTITY).cast(Vec3::Y * 3.0), None);
}

/// The sine of the angle between the reported normal, turned to the ground's side, and the triangle's.
fn off_plane(impact: &Impact3, up: Vec3) -> f32 {
    (-impact.normal).cross(up).length()
}

#[test]
fn inner_edges_give_no_normals_of_their_own() {
    // A plane of 2 x N thin triangles, rotated: a body glides into it at any angle, almost parallel too.
    let mut counted = 0;
    for seed in 0..2400 {
        let mut random = Random::new(30_000 + seed);
        let thin = random.pick(&[1.0, 0.1, 0.001]);
        let ground = mesh(sheet([1, 40], [4.0, 4.0 * thin], |_, _| 0.0, |_, _| false));
        let rotation = if seed % 2 == 0 { Quat::IDENTITY } else { random.quaternion() };
        let at = Pose3::new(random.vector() * 100.0, rotation).unwrap();
        let up = at.turn(DVec3::Y);
        let body = KINDS3[random.below(10)].1(&mut Clay::thick(&mut random));
        let spot =
            Vec3::new(random.between(-1.0, 1.0) as f32, 0.0, random.between(-60.0, 60.0) as f32 * thin);
        let spin = random.quaternion();
        // How far the body reaches down from its position.
        let standing = Pose3::new(DVec3::ZERO, spin).unwrap();
        let lowest = body.support(standing.turn_back(-up)).map(|low| standing.transform(low).dot(-up));
        let Some(lowest) = lowest else { continue };
        let gap = random.pick(&[1e-12, 1e-9, 1e-7, 1e-5, 1e-3]);
        let place = at.transform(spot) + up * (lowest + gap);
        let pose = Pose3::new(place, spin).unwrap();
        let level = at.turn(random.direction().with_y(0.0)).normalize();
        let slope = random.pick(&[0.0, 1e-9, 1e-6, 1e-3, 0.1]);
        let moved = ((level - up * slope) * random.pick(&[0.01, 0.3, 1.0])).as_vec3();
        let Some(impact) = Pair3::new(&body, &pose, &ground, &at).cast(moved) else { continue };
        // On the rim, edges may give normals.
        let on = at.transform_back(at.position() + impact.anchor_b.as_dvec3());
        if on.x.abs() > 1.99 || on.z.abs() > 79.9 * f64::from(thin) {
            continue;
        }
        counted += 1;
        let off = off_plane(&impact, up.as_vec3());
        assert!(
            off < 1.7e-4 && impact.normal.dot(up.as_vec3()) < 0.0,
            "{seed} {gap} {slope}: {off} {impact:?}"
        );
    }
    assert!(counted > 600, "{counted}");
}

#[test]
fn edges_that_stand_out_keep_theirs() {
    // A roof with a ridge along z, seen from above; from below it is a valley.
    let roof = mesh(sheet([2, 4], [1.0, 1.0], |x, _| 1.0 - x.abs(), |_, _| false));
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let cast = |from: DVec3, way: Vec3| {
        let pose = Pose3::at(from).unwrap();
        Pair3::new(&ball, &pose, &roof, &Pose3::IDENTITY).cast(way).unwrap()
    };
    // Onto the ridge from straight above, and slightly beside it.
    for x in [0.0, 0.1, -0.2, 0.3] {
        let impact = cast(DVec3::new(x, 3.0, 0.25), Vec3::NEG_Y * 4.0);
        let expected = DVec3::new(x, (0.25 - x * x).sqrt(), 0.0) * 2.0;
        assert!((-impact.normal).dot(expected.as_vec3()) > 1.0 - 1e-6, "{x}: {impact:?}");
    }
    // Onto a side.
    let impact = cast(DVec3::new(0.9, 3.0, 0.25), Vec3::NEG_Y * 4.0);
    let side = Vec3::new(1.0, 1.0, 0.0).normalize();
    assert!((-impact.normal).dot(side) > 1.0 - 1e-6, "{impact:?}");
    // From below, it touches both sides at once: the normal is one of theirs, not the edge's.
    let impact = cast(DVec3::new(0.0, -3.0, 0.25), Vec3::Y * 4.0);
    let along = (-impact.normal).dot(Vec3::new(1.0, -1.0, 0.0).normalize());
    let other = (-impact.normal).dot(Vec3::new(-1.0, -1.0, 0.0).normalize());
    assert!(along.max(other) > 1.0 - 1e-4, "{impact:?}");
}

#[test]
fn motions_without_measure_bring_no_number_that_is_none() {
    let mut hits = 0;
    for round in 0..60 {
        let (case, _) = cast_case(round % KINDS3.len(), round);
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        for moved in [
            Vec3::ZERO,
            Vec3::NAN,
            Vec3::INFINITY,
            Vec3::splat(1e-44),
            Vec3::X * 3e38,
            Vec3::splat(-1e20),
            Vec3::Y * 1e9,
        ] {
            let overlaps = pair.overlaps();
            let found = pair.cast(moved);
            if let Some(impact) = found {
                assert_eq!(impact.overlapping, overlaps);
                assert!((0.0..=1.0).contains(&impact.fraction) && !impact.error.is_nan(), "{impact:?}");
                assert!(impact.normal.is_finite() && impact.anchor_b.is_finite(), "{impact:?}");
                hits += usize::from(!overlaps);
            } else {
                assert!(!overlaps);
            }
        }
    }
    assert!(hits > 20, "{hits}");
}

#[test]
fn ground_that_moves_meets_ground() {
    let mut hits = 0;
    for seed in 0..20 {
        let mut random = Random::new(60_000 + seed as u128);
        let (a, pose_a) = level(&mut random, 3 * seed);
        let (b, _) = level(&mut random, 3 * seed + 1);
        let away = random.direction() * random.between(6.0, 12.0);
        let pose_b = Pose3::new(pose_a.position() + away, random.quaternion()).unwrap();
        let case = Case3 { shape_a: a, pose_a, shape_b: b, pose_b };
        let motion = Motion3::shift(away * 1.5).unwrap();
        let course = Course { case: &case, motions: [motion, Motion3::STILL] };
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        let impact = pair.impact(&motion, &Motion3::STILL);
        assert!(Ground::of(&case.shape_a).is_some());
        if impact.is_none_or(|impact| !impact.overlapping) {
            check(&course, impact, &format!("{seed}"));
        }
        if let Some(impact) = impact.filter(|impact| !impact.overlapping) {
            // The two triangles that are named are the ones that meet.
            let [one, other] = [(&case.shape_a, impact.part_a), (&case.shape_b, impact.part_b)]
                .map(|(ground, number)| Ground::of(ground).unwrap().triangle(number).unwrap().into());
            let two = Case3 { shape_a: one, pose_a: case.pose_a, shape_b: other, pose_b: case.pose_b };
            let (separation, error) =
                Course { case: &two, motions: course.motions }.separation(impact.fraction);
            assert!(
                separation - error <= f64::from(impact.error) + course.rounding(),
                "{seed}: {separation} {impact:?}"
            );
        }
        hits += usize::from(impact.is_some());
    }
    assert!(hits > 5, "{hits}");
}
