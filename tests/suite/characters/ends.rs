//! Characters at the ends of thin ground, whose rim leads sideways.
//!
//! Symptom: a character whose centre was a hair from a sloping ledge, near the ledge's end, was never freed again, and
//! never moved, though nothing pressed it; to walk there under the ledge was enough. Cause: its manifold has the normal
//! of the ledge's end. A push along that would take the centre through the ledge, and so was cut short, sixteen times.

use asunder::{
    Capsule2, Capsule3, Chain, Collider2, Collider3, Filter2, Filter3, HeightField, Pose2, Pose3, Shape2,
    Shape3, TriMesh, Walk2, Walk3, World2, World3,
};
use glam::{DVec2, Vec2, Vec3};

/// A ledge 3 m wide, which rises by so much per metre.
const SLOPES: [f32; 4] = [0.0, 0.066_7, 0.364, 1.0];

/// Whether the straight way between two points leads through the ledge.
fn is_crossed(slope: f32, from: DVec2, to: DVec2) -> bool {
    let above = |at: DVec2| at.y - at.x * f64::from(slope);
    let share = above(from) / (above(from) - above(to));
    (above(from) > 0.0) != (above(to) > 0.0) && (from + (to - from) * share).x.abs() < 1.5
}

/// Places of a character whose centre is up to 0.2 m from the last 0.6 m of the ledge, or beside its end.
fn places(slope: f32) -> impl Iterator<Item = DVec2> {
    (0..30).flat_map(move |i| {
        (0..40).map(move |j| {
            let x = 0.9 + 0.04 * f64::from(i);
            DVec2::new(x, x * f64::from(slope) - 0.2 + 0.01 * f64::from(j) + 1e-3)
        })
    })
}

#[test]
fn who_is_in_the_end_of_a_ledge_comes_out_in_the_plane() {
    let hero: Shape2 = Capsule2::from_half_height(0.4, 0.3).unwrap().into();
    let (walk, all) = (Walk2::new(&hero, Vec2::Y).unwrap(), Filter2::new());
    for (slope, is_one_sided) in SLOPES.into_iter().flat_map(|slope| [(slope, false), (slope, true)]) {
        let ledge = Chain::open([1.5, -1.5].map(|x| Vec2::new(x, x * slope))).unwrap();
        let mut world = World2::new();
        world.insert(Collider2::new(if is_one_sided { ledge.one_sided() } else { ledge }));
        let mut freed = 0;
        for at in places(slope) {
            let pose = Pose2::at(at).unwrap();
            if world.is_free((&hero, &pose), &all) {
                continue;
            }
            let slide = world.move_and_slide((&hero, &pose), Vec2::ZERO, &walk, &all);
            assert!(slide.is_free && world.is_free((&hero, &slide.pose), &all), "{slope} {at}: {slide:?}");
            assert!(!is_crossed(slope, at, slide.pose.position()), "{slope} {at}: {slide:?}");
            freed += 1;
        }
        assert!(freed > 400, "{freed} of slope {slope}");
    }
}

#[test]
fn who_is_in_the_end_of_a_ledge_comes_out_in_space() {
    let hero: Shape3 = Capsule3::from_half_height(0.4, 0.3).unwrap().into();
    let (walk, all) = (Walk3::new(&hero, Vec3::Y).unwrap(), Filter3::new());
    for slope in SLOPES {
        let corner = |x: f32, z: f32| Vec3::new(x, x * slope, z);
        let corners = [corner(-1.5, -9.0), corner(1.5, -9.0), corner(1.5, 9.0), corner(-1.5, 9.0)];
        let mesh = TriMesh::new(corners, [[0, 2, 1], [0, 3, 2]]).unwrap();
        let rise = 1.5 * slope;
        let field = HeightField::new(2, 2, [-rise, rise, -rise, rise], Vec2::new(3.0, 18.0)).unwrap();
        let (at_mesh, at_field) = (Pose3::IDENTITY, Pose3::at([-1.5, 0.0, -9.0]).unwrap());
        let ledges: [(Shape3, Pose3); 4] = [
            (mesh.clone().into(), at_mesh),
            (mesh.one_sided().into(), at_mesh),
            (field.clone().into(), at_field),
            (field.one_sided().into(), at_field),
        ];
        for (ledge, there) in ledges {
            let mut world = World3::new();
            world.insert(Collider3::new(ledge).at(there));
            let mut freed = 0;
            for at in places(slope) {
                let pose = Pose3::at([at.x, at.y, 0.3]).unwrap();
                if world.is_free((&hero, &pose), &all) {
                    continue;
                }
                let slide = world.move_and_slide((&hero, &pose), Vec3::ZERO, &walk, &all);
                assert!(
                    slide.is_free && world.is_free((&hero, &slide.pose), &all),
                    "{slope} {at}: {slide:?}"
                );
                let to = slide.pose.position().truncate();
                assert!(!is_crossed(slope, at, to), "{slope} {at}: {slide:?}");
                freed += 1;
            }
            assert!(freed > 400, "{freed} of slope {slope}");
        }
    }
}

/// A floor that rises until there is no room under the ledge, whose front is above: the character comes up through it.
#[test]
fn who_walks_under_the_end_of_a_ledge_walks_on() {
    let hero: Shape2 = Capsule2::from_half_height(0.4, 0.3).unwrap().into();
    let (walk, all) = (Walk2::new(&hero, Vec2::Y).unwrap(), Filter2::new());
    let mut world = World2::new();
    let ledge = Chain::open([[1.5, 0.1], [0.0, 0.0], [-1.5, 0.2]].map(Vec2::from)).unwrap().one_sided();
    world.insert(Collider2::new(ledge));
    world.insert(Collider2::new(Chain::open([[4.0, -1.1858], [-2.0, 0.0142]].map(Vec2::from)).unwrap()));
    let (mut pose, mut fall) = (Pose2::at([3.0, 0.0]).unwrap(), 0.0);
    for frame in 0..200 {
        fall -= 9.81 / 60.0;
        let slide = world.move_and_slide((&hero, &pose), Vec2::new(-3.0, fall) / 60.0, &walk, &all);
        assert!(slide.is_free, "frame {frame}: {slide:?}");
        pose = slide.pose;
        fall = if slide.ground.is_some() { 0.0 } else { fall };
    }
    assert!(pose.position().x < -1.8, "{pose:?}");
}
