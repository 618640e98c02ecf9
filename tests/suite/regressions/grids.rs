//! Boxes on a grid, as level editors place them: flush with each other along one axis or two.

use asunder::{Collider3, Contact3, Pose3, World3};
use asunder_geometry::Cuboid;
use asunder_geometry::glam::IVec3;
use asunder_tests::cases::Random;

/// Two boxes: half extents of both, and the position of the second; in quarters of a metre.
struct Boxes {
    halves: [IVec3; 2],
    offset: IVec3,
}

impl Boxes {
    fn random(random: &mut Random) -> Self {
        let mut half = || IVec3::from([0; 3].map(|_: i32| random.pick(&[1, 2, 4, 6, 8])));
        let halves = [half(), half()];
        let offset = IVec3::from([0; 3].map(|_: i32| random.below(33) as i32 - 16));
        Self { halves, offset }
    }

    /// The squared distance, in sixteenths.
    fn squared_distance(&self) -> i32 {
        (self.offset.abs() - self.halves[0] - self.halves[1]).max(IVec3::ZERO).length_squared()
    }

    /// Calls `ask` with their contact in a world where one has the margin, in quarters of a metre.
    fn contact<R>(&self, margin: i32, is_sensor: bool, ask: impl FnOnce(Option<&Contact3>) -> R) -> R {
        let body = |half: IVec3, at: IVec3| {
            let cuboid = Cuboid::from_half_extents(half.as_vec3() * 0.25).unwrap();
            Collider3::new(cuboid).at(Pose3::at(at.as_dvec3() * 0.25).unwrap())
        };
        let mut world = World3::new();
        let first = body(self.halves[0], IVec3::ZERO).margin(margin as f32 * 0.25).unwrap();
        let a = world.insert(if is_sensor { first.sensor() } else { first });
        let b = world.insert(body(self.halves[1], self.offset));
        world.update();
        ask(world.contact(a, b).as_ref())
    }
}

/// Symptom: a sensor had a contact with a box flush with it that lay beyond both margins, up to 1.41 times as far, and
/// kept it after it should have ended. Cause: for an edge that runs exactly along the line of a face's side the clip
/// fraction is NaN, and with it the edge counted as inside the other sides of the face, too.
#[test]
fn a_sensor_sees_boxes_on_a_grid_within_its_margin_and_no_further() {
    let story = Boxes { halves: [IVec3::splat(4); 2], offset: IVec3::new(12, 0, 13) };
    assert!(story.contact(5, true, |contact| contact.is_none()), "1.6 m apart, of 1.25");

    let mut random = Random::new(0x5E_4503);
    let mut counts = [0; 2];
    for case in 0..30_000 {
        let (boxes, margin) = (Boxes::random(&mut random), random.pick(&[1, 2, 5, 8]));
        let (squared, limit) = (boxes.squared_distance(), margin * margin);
        for is_sensor in [true, false] {
            let what = || format!("{case}: {:?} and {}, of {margin}", boxes.halves, boxes.offset);
            boxes.contact(margin, is_sensor, |contact| {
                // At exactly the margin either answer is allowed.
                assert!(squared == limit || contact.is_some() == (squared < limit), "{}", what());
                assert_eq!(contact.is_some_and(|contact| contact.overlapping), squared == 0, "{}", what());
                let told = contact.and_then(|contact| contact.manifolds.first());
                let distance = 0.25 * f64::from(squared).sqrt();
                if let Some(told) = told.filter(|_| squared > 0) {
                    let off = (f64::from(told.separation) - distance).abs();
                    assert!(off <= f64::from(told.error), "{}: {told:?} of {distance}", what());
                }
            });
            counts[usize::from(squared > 0 && squared < limit)] += 1;
        }
    }
    assert!(counts[1] > 5_000, "{counts:?}");
}
