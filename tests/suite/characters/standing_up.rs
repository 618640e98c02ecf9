//! A crouching character that wants to stand up.

use asunder::glam::{Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Chain, Collider2, Collider3, Filter2, Filter3, Pose2, Pose3, Shape2, Shape3, TriMesh,
    World2, World3,
};

const CROUCHING: f32 = 0.7;
const STANDING: f32 = 1.8;
const CEILINGS: [f32; 6] = [0.75, 0.9, 1.2, 1.4, 1.7, 1.9];

/// What `is_free` returns for the standing shape: with its centre behind a one-sided ceiling, nothing is in its way.
fn is_told_free(ceiling: f32, has_one_side: bool) -> bool {
    ceiling > STANDING + 0.01 || has_one_side && ceiling < STANDING / 2.0 + 0.01
}

/// Symptom: the guide said that `is_free` tells whether there is room to stand up, but under a low one-sided ceiling it
/// returns true. Cause: the centre of the standing shape is behind that ceiling. The crouching shape, cast upwards by
/// the difference in height, hits it.
#[test]
fn who_crouches_is_cast_upwards_to_learn_whether_there_is_room() {
    let capsule =
        |height: f32| Shape3::from(Capsule3::new(Vec3::Y * 0.3, Vec3::Y * (height - 0.3), 0.3).unwrap());
    let (stand, crouch, filter) = (capsule(STANDING), capsule(CROUCHING), Filter3::new());
    let at = Pose3::at([0.3, 0.01, 1.0]).unwrap();
    for (ceiling, has_one_side) in CEILINGS.iter().flat_map(|&ceiling| [(ceiling, false), (ceiling, true)]) {
        let square =
            |y: f32| [[-5.0, y, -5.0], [5.0, y, -5.0], [5.0, y, 5.0], [-5.0, y, 5.0]].map(Vec3::from);
        let vertices = [square(ceiling), square(0.0)].concat();
        let cave = TriMesh::new(vertices, [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]]).unwrap();
        let mut world = World3::new();
        world.insert(Collider3::new(if has_one_side { cave.one_sided() } else { cave }));
        assert!(world.is_free((&crouch, &at), &filter), "{ceiling}");
        let way = Vec3::Y * (STANDING - CROUCHING);
        let has_room = world.cast_shape((&crouch, &at), way, &filter).is_none();
        assert_eq!(has_room, ceiling > STANDING + 0.01, "{ceiling} {has_one_side}");
        assert_eq!(world.is_free((&stand, &at), &filter), is_told_free(ceiling, has_one_side), "{ceiling}");
    }
}

#[test]
fn in_the_plane_who_crouches_is_cast_upwards_to_learn_whether_there_is_room() {
    let capsule =
        |height: f32| Shape2::from(Capsule2::new(Vec2::Y * 0.3, Vec2::Y * (height - 0.3), 0.3).unwrap());
    let (stand, crouch, filter) = (capsule(STANDING), capsule(CROUCHING), Filter2::new());
    let at = Pose2::at([0.0, 0.01]).unwrap();
    for (ceiling, has_one_side) in CEILINGS.iter().flat_map(|&ceiling| [(ceiling, false), (ceiling, true)]) {
        let outline = [[-5.0, 0.0], [-5.0, ceiling], [5.0, ceiling], [5.0, 0.0]].map(Vec2::from);
        let cave = Chain::closed(outline).unwrap();
        let mut world = World2::new();
        world.insert(Collider2::new(if has_one_side { cave.one_sided() } else { cave }));
        assert!(world.is_free((&crouch, &at), &filter), "{ceiling}");
        let way = Vec2::Y * (STANDING - CROUCHING);
        let has_room = world.cast_shape((&crouch, &at), way, &filter).is_none();
        assert_eq!(has_room, ceiling > STANDING + 0.01, "{ceiling} {has_one_side}");
        assert_eq!(world.is_free((&stand, &at), &filter), is_told_free(ceiling, has_one_side), "{ceiling}");
    }
}
