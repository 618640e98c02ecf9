//! Ground that is one body of many parts, and the same ground as several bodies.

use super::stage::{cosine, cuboid, sine, tilt};
use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Chain, Circle, Collider2, Collider3, Compound2, Compound3, Filter2, Filter3,
    HeightField, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3, Sphere, TriMesh, Walk2, Walk3, World2,
    World3,
};

/// A slope that is too steep to walk on.
const STEEP: f64 = 50.0;

fn world3(shapes: impl IntoIterator<Item = Shape3>) -> World3 {
    let mut world = World3::new();
    for shape in shapes {
        world.insert(Collider3::new(shape).fixed());
    }
    world
}

fn world2(shapes: impl IntoIterator<Item = Shape2>) -> World2 {
    let mut world = World2::new();
    for shape in shapes {
        world.insert(Collider2::new(shape).fixed());
    }
    world
}

/// Strips of ground between points of a profile, 8 m wide.
fn mesh(profile: &[[f32; 2]]) -> Shape3 {
    let corners = profile.iter().flat_map(|&[x, y]| [-4.0, 4.0].map(|z| Vec3::new(x, y, z)));
    let strip = |i: u32| [[2 * i, 2 * i + 1, 2 * i + 2], [2 * i + 2, 2 * i + 1, 2 * i + 3]];
    let triangles: Vec<[u32; 3]> = (0..profile.len() as u32 - 1).flat_map(strip).collect();
    TriMesh::new(corners.collect::<Vec<_>>(), triangles).unwrap().into()
}

fn chain(profile: &[[f32; 2]]) -> Shape2 {
    Chain::open(profile.iter().copied().map(Vec2::from)).unwrap().into()
}

/// The centre of a ball of radius 0.5 with a skin to the slope and less than two to the floor: moving down it hits the
/// slope first.
fn in_the_corner(skin: f64) -> DVec2 {
    let (sin, cos) = (sine(STEEP.to_radians()), cosine(STEEP.to_radians()));
    let y = 0.5 + 1.8 * skin;
    DVec2::new((y * cos - 0.5 - 1.05 * skin) / sin, y)
}

/// Symptom: a character that stood on the floor in the corner of a slope got no ground if both were one body. Cause:
/// for each body, only the first impact on the way down was considered.
#[test]
fn the_floor_beside_a_slope_of_the_same_body_is_told() {
    let (sin, cos) = (sine(STEEP.to_radians()), cosine(STEEP.to_radians()));
    let top = (4.0 * sin / cos) as f32;
    let (floor, slope) = ([[-4.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [4.0, top]]);
    let ground = [floor[0], floor[1], slope[1]];
    let slab = (Pose3::at([-4.0, -0.5, 0.0]).unwrap(), cuboid([4.0, 0.5, 4.0]));
    let at = DVec3::new(cos, sin, 0.0) * 3.0 + DVec3::new(sin, -cos, 0.0) * 0.5;
    let ramp = (Pose3::new(at, tilt(STEEP)).unwrap(), cuboid([3.0, 0.5, 4.0]));
    let field = HeightField::new(3, 2, [0.0, 0.0, top, 0.0, 0.0, top], Vec2::new(4.0, 8.0)).unwrap();
    let mut of_field = World3::new();
    of_field.insert(Collider3::new(field).at(Pose3::at([-4.0, 0.0, -4.0]).unwrap()).fixed());
    let worlds = [
        world3([mesh(&floor), mesh(&slope)]),
        world3([mesh(&ground)]),
        of_field,
        world3([Compound3::new([ramp, slab]).unwrap().into()]),
    ];
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let walk = Walk3::new(&ball, Vec3::Y).unwrap();
    let place = in_the_corner(walk.skin.into());
    for (which, world) in worlds.iter().enumerate() {
        let pose = Pose3::at([place.x, place.y, 0.1]).unwrap();
        let slide = world.move_and_slide((&ball, &pose), Vec3::ZERO, &walk, &Filter3::new());
        let level = slide.ground.is_some_and(|ground| ground.normal.y > 0.999);
        assert!(level, "{which}: {slide:?}");
    }
}

/// The same in the plane.
#[test]
fn the_floor_beside_a_slope_of_the_same_chain_is_told() {
    let (sin, cos) = (sine(STEEP.to_radians()), cosine(STEEP.to_radians()));
    let top = (4.0 * sin / cos) as f32;
    let (floor, slope) = ([[-4.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [4.0, top]]);
    let rect = |half: [f32; 2]| Shape2::from(Rect::from_half_extents(half.into()).unwrap());
    let at = DVec2::new(cos, sin) * 3.0 + DVec2::new(sin, -cos) * 0.5;
    let turn = Rotation2::new(cos as f32, sin as f32).unwrap();
    let ramp = (Pose2::new(at, turn).unwrap(), rect([3.0, 0.5]));
    let slab = (Pose2::at([-4.0, -0.5]).unwrap(), rect([4.0, 0.5]));
    let one_sided = Chain::open([slope[1], floor[1], floor[0]].map(Vec2::from)).unwrap().one_sided();
    let worlds = [
        world2([chain(&floor), chain(&slope)]),
        world2([chain(&[floor[0], floor[1], slope[1]])]),
        world2([one_sided.into()]),
        world2([Compound2::new([ramp, slab]).unwrap().into()]),
    ];
    let ball = Shape2::from(Circle::new(0.5).unwrap());
    let walk = Walk2::new(&ball, Vec2::Y).unwrap();
    let pose = Pose2::at(in_the_corner(walk.skin.into())).unwrap();
    for (which, world) in worlds.iter().enumerate() {
        let slide = world.move_and_slide((&ball, &pose), Vec2::ZERO, &walk, &Filter2::new());
        let level = slide.ground.is_some_and(|ground| ground.normal.y > 0.999);
        assert!(level, "{which}: {slide:?}");
    }
}

/// Symptom: a character that walked off a floor followed its edge down if floor and cliff were one body, and left it at
/// once if they were two. Cause: what lies behind an edge was only looked up in the body to which the edge was
/// attributed, and that was the cliff.
#[test]
fn an_edge_of_two_bodies_is_walked_over_as_that_of_one() {
    let (floor, cliff) = ([[-4.0, 0.1], [0.1, 0.1]], [[0.1, 0.1], [0.5, -1.0]]);
    let all = [floor[0], floor[1], cliff[1]];
    let worlds = [world3([mesh(&all)]), world3([mesh(&cliff), mesh(&floor)])];
    let flat = [world2([chain(&all)]), world2([chain(&cliff), chain(&floor)])];
    let hero = Shape3::from(Capsule3::from_half_height(0.5, 0.4).unwrap());
    let flat_hero = Shape2::from(Capsule2::from_half_height(0.5, 0.4).unwrap());
    let (walk, flat_walk) = (Walk3::new(&hero, Vec3::Y).unwrap(), Walk2::new(&flat_hero, Vec2::Y).unwrap());
    let mut carried = 0;
    let mut check = |apart: f64, ups: [Option<f32>; 2], told: &str| {
        assert!(apart < 1e-4 && ups[0].is_some() == ups[1].is_some(), "{told}");
        carried += usize::from(ups[0].is_some_and(|up| up < 0.7));
    };
    for start in 0..20 {
        let x = 0.01 * f64::from(start);
        let (mut at, mut flat_at) = (Pose3::at([x, 1.01, 0.1]).unwrap(), Pose2::at([x, 1.01]).unwrap());
        for frame in 0..8 {
            let way = Vec3::new(0.07, -0.008, 0.0);
            let [one, two] =
                [0, 1].map(|i| worlds[i].move_and_slide((&hero, &at), way, &walk, &Filter3::new()));
            check(
                (one.moved - two.moved).length(),
                [one.ground, two.ground].map(|ground| Some(ground?.normal.y)),
                &format!("{x} {frame}: {one:?} {two:?}"),
            );
            at = one.pose;

            let way = Vec2::new(0.07, -0.008);
            let [one, two] = [0, 1]
                .map(|i| flat[i].move_and_slide((&flat_hero, &flat_at), way, &flat_walk, &Filter2::new()));
            check(
                (one.moved - two.moved).length(),
                [one.ground, two.ground].map(|ground| Some(ground?.normal.y)),
                &format!("{x} {frame}: {one:?} {two:?}"),
            );
            flat_at = one.pose;
        }
    }
    assert!(carried > 20, "{carried}");
}
