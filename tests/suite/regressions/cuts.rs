//! Straight ground cut into pieces: where it is cut must make no difference.

use asunder::glam::{DVec2, Vec2};
use asunder::{
    Chain, Circle, Collider2, Compound2, Motion2, Pair2, Pose2, Rect, Rotation2, Segment2, Shape2, World2,
};

/// A one-sided chain, each straight stretch of it cut into `pieces`. The mirrored one is numbered backwards, so that it
/// faces the same side.
fn ground(vertices: &[[f32; 2]], pieces: u32, is_mirrored: bool) -> Shape2 {
    let sign = if is_mirrored { -1.0 } else { 1.0 };
    let vertices: Vec<Vec2> = vertices.iter().map(|&[x, y]| Vec2::new(x * sign, y)).collect();
    let mut cut = vec![vertices[0]];
    for ends in vertices.windows(2) {
        cut.extend((1..=pieces).map(|i| ends[0] + (ends[1] - ends[0]) * (i as f32 / pieces as f32)));
    }
    if is_mirrored {
        cut.reverse();
    }
    Chain::open(cut).unwrap().one_sided().into()
}

/// Symptom: a ball on an arm that swings up through a one-sided floor from behind, and on above it, had an impact with
/// the floor before it had come out of it; when depended on where the floor was cut, and from which end it was
/// numbered. Cause: each segment decided on its own which side the ball came from. The one that the ball had come
/// through was ignored; the next, which the ball reached with its centre above, was hit.
#[test]
fn what_comes_through_a_floor_from_behind_passes_all_of_it() {
    let ball = Shape2::from(Circle::new(0.5).unwrap());
    let turned = |cos: f32, sin: f32| Rotation2::new(cos, sin).unwrap();
    for pieces in [1, 2, 3, 8, 64] {
        for sign in [1.0_f32, -1.0] {
            let floor = ground(&[[4.0, 0.0], [-4.0, 0.0]], pieces, sign < 0.0);
            // Its centre is 0.3 m above the floor at the top of the swing, and 1 m below it at either end.
            let arm = Pose2::at([2.0 * f64::from(sign), 0.0]).unwrap();
            let body = Shape2::from(Compound2::new([(arm, ball.clone())]).unwrap());
            let from = Pose2::new([0.0, -1.7], turned(0.94, 0.34 * sign)).unwrap();
            let (swing, still) =
                (Motion2::new([0.0; 2], turned(-0.94, 0.34 * sign)).unwrap(), Motion2::STILL);
            let pair = Pair2::new(&body, &from, &floor, &Pose2::IDENTITY);
            assert_eq!(pair.impact(&swing, &still), None, "{pieces} {sign}");
            let back = Pair2::new(&floor, &Pose2::IDENTITY, &body, &from);
            assert_eq!(back.next_impact(&still, &swing), None, "{pieces} {sign}");
            // On the way it has contacts, as a body that is sunk in does.
            let top = swing.pose_at(&from, 0.5);
            assert!(Pair2::new(&body, &top, &floor, &Pose2::IDENTITY).overlaps_front());
            let mut world = World2::new();
            world.insert(Collider2::new(floor.clone()));
            let bullet = world.insert(Collider2::new(body.clone()).at(from).bullet());
            world.set_motion(bullet, swing).unwrap();
            world.update();
            assert!(world.impacts().is_empty(), "{pieces} {sign}");
            // Half a metre higher it comes out of the floor, and down onto it again.
            let higher = from.with_position(DVec2::new(0.0, -1.2)).unwrap();
            let met = Pair2::new(&body, &higher, &floor, &Pose2::IDENTITY).impact(&swing, &still).unwrap();
            let at = swing.pose_at(&higher, met.fraction).transform(DVec2::new(2.0 * f64::from(sign), 0.0));
            assert!(met.fraction > 0.5 && (at.y - 0.5).abs() < 1e-4, "{pieces} {sign} {at} {met:?}");
        }
    }
}

/// Symptom: a box that comes up through one slope of a one-sided hollow, and turns into the other, had an impact with
/// the second slope where each slope was one piece; with each cut in two, or in eight, the impact came too late. Cause:
/// whether a body that leaves a face falls back through it was decided for the one segment that was touched, not for
/// the slope.
#[test]
fn what_falls_through_another_piece_of_a_slope_is_met_by_the_slope() {
    let valley = [[4.0, -0.453125], [1.6875, 0.640625], [0.734375, 0.125], [-1.0, 0.828125]];
    let turned = |cos: f32, sin: f32| Rotation2::new(cos, sin).unwrap();
    let part = Shape2::from(Rect::from_half_extents(Vec2::new(0.29056, 0.43366)).unwrap());
    let body = Compound2::new([(Pose2::at([-0.5623, -0.70527]).unwrap(), part)]).map(Shape2::from).unwrap();
    let from = Pose2::new([-1.11094, -0.86373], turned(-0.99975, -0.02234)).unwrap();
    let ground_from = Pose2::new([0.0; 2], turned(0.27877, -0.96036)).unwrap();
    let shift = Motion2::shift([2.60022, 2.31395]).unwrap();
    let ground_turns = Motion2::new([-2.05019, 2.62674], turned(0.96152, 0.27473)).unwrap();
    let [_, one, other, _] = valley.map(Vec2::from);
    let slope = Shape2::from(Segment2::new(one, other).unwrap());
    for pieces in [1, 2, 8] {
        let slopes = ground(&valley, pieces, false);
        let pair = Pair2::new(&slopes, &ground_from, &body, &from);
        let met = pair.impact(&ground_turns, &shift).unwrap();
        assert_eq!(met.part_a, pieces, "the second slope: {met:?}");
        let gap = |at: f64| {
            let (ground, body_at) = (ground_turns.pose_at(&ground_from, at), shift.pose_at(&from, at));
            let closest = Pair2::new(&slope, &ground, &body, &body_at).distance().unwrap();
            f64::from(closest.distance)
        };
        assert!(
            gap(met.fraction) < 1e-6 && (1..15).all(|i| gap(f64::from(i) * 0.01) > 1e-3),
            "{pieces} {met:?}"
        );
    }
}
