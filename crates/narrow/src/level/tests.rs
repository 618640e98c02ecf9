//! Contacts laid out as a tree, against a test of each of them.

use super::{Contacts, Lies, Passing, Reach};
use crate::counted::steps_of;
use crate::numbers::Numbers;
use crate::touch::Touch3;
use asunder_geometry::glam::{DVec3, Vec3};

/// Two parts, as corners of B less corners of A: at the start, and at three times after that.
struct Parts {
    moments: [[DVec3; 5]; 4],
    thickness: f64,
    met_at: f64,
}

impl Parts {
    fn new(numbers: &mut Numbers) -> Self {
        let size = [0.05, 1.0][numbers.below(2) as usize];
        // Beside what is touched below, and moving into it and along it.
        let (beside, sunk) =
            (numbers.vector() * DVec3::new(3.0, 0.02, 3.0), [0.1, 1.0][numbers.below(2) as usize]);
        let way = numbers.vector() * DVec3::new(2.0, sunk, 2.0);
        let corners: [DVec3; 5] = core::array::from_fn(|_| numbers.vector() * size - DVec3::Y * size);
        let moments = core::array::from_fn(|i| {
            corners.map(|corner| corner + beside - way * i as f64 / 3.0 + numbers.vector() * 0.01)
        });
        let met_at = numbers.number().max(0.0);
        Self { moments, thickness: [0.02, 0.5][numbers.below(2) as usize], met_at }
    }

    fn gap(&self, moment: usize, axis: DVec3) -> f64 {
        self.moments[moment].iter().map(|corner| corner.dot(axis)).fold(f64::INFINITY, f64::min)
    }

    fn lies(&self, normal: DVec3, touched: Option<&Contacts<Touch3>>, beside: &Contacts<Touch3>) -> Lies {
        let closing = |axis: DVec3, from: f64| {
            let first = if from > 0.0 { 1 } else { 0 };
            let after = (first + 1..4).map(|moment| self.gap(moment, axis));
            self.gap(first, axis) - after.fold(f64::INFINITY, f64::min)
        };
        let furthest = |moment: &[DVec3; 5]| moment.iter().map(|it| it.length()).fold(0.0, f64::max);
        let start = furthest(&self.moments[0]);
        let ever = self.moments.iter().map(furthest).fold(0.0, f64::max);
        Passing {
            thickness: self.thickness,
            is_on_ground: false,
            is_endless: false,
            gap: &|axis| self.gap(0, axis),
            closing: &closing,
            met_at: self.met_at,
            reach: Reach::new(start, ever - start, ever),
        }
        .lies(normal, touched, beside)
    }
}

/// `count` contacts with what is more or less below: of few axes or of many, of few depths or of many.
fn contacts(numbers: &mut Numbers, count: usize) -> Vec<Touch3> {
    let (tilt, depth) =
        ([0.0, 1e-7, 0.05, 1.0][numbers.below(4) as usize], [0.0, 0.3][numbers.below(2) as usize]);
    let contact = |_| {
        let axis = numbers.vector() * tilt - DVec3::Y;
        let separation = (-depth * numbers.number().abs()) as f32;
        Touch3 { normal: axis.try_normalize().unwrap_or(DVec3::X).as_vec3(), separation }
    };
    (0..count).map(contact).collect()
}

#[test]
fn contacts_laid_out_agree_with_tests_one_by_one() {
    let mut numbers = Numbers::new(5700);
    let mut outcomes = [0; 3];
    for round in 0..400 {
        let all = contacts(&mut numbers, [20, 150][round % 2]);
        let others = contacts(&mut numbers, [0, 30][round / 2 % 2]);
        let (touched, beside) = (Contacts::new(&all, 2.0), Contacts::new(&others, 2.0));
        for question in 0..40 {
            let parts = Parts::new(&mut numbers);
            let tilted = numbers.vector() * [0.1, 1.0][question % 2] + DVec3::X;
            let normal = tilted.try_normalize().unwrap_or(DVec3::X);
            // The first queries test each contact.
            let (each, each_beside) = (Contacts::new(&all, 2.0), Contacts::new(&others, 2.0));
            let (few, fewer) = if round % 3 == 0 { (None, None) } else { (Some(&touched), Some(&each)) };
            let found = parts.lies(normal, few, &beside);
            assert_eq!(found, parts.lies(normal, fewer, &each_beside), "{round} {question}");
            outcomes[found as usize] += 1;
        }
    }
    assert!(outcomes.iter().all(|&count| count > 500), "{outcomes:?}");
}

/// Among contacts that have nothing to do with a meeting, few are tested: only the first, where all are alike.
#[test]
fn what_has_nothing_to_do_with_a_meeting_is_passed_over() {
    let mut numbers = Numbers::new(5710);
    for (tilt, most) in [(0.0, 20), (0.5, 400)] {
        let contact = |_| {
            let axis = (numbers.vector() * tilt - DVec3::Y).try_normalize().unwrap_or(DVec3::X);
            Touch3 { normal: axis.as_vec3(), separation: 0.0 }
        };
        let all: Vec<Touch3> = (0..4096).map(contact).collect();
        let (touched, beside) = (Contacts::new(&all, 2.0), Contacts::new(&[] as &[Touch3], 2.0));
        // Far above what is touched, and further ahead.
        let corner = DVec3::new(5.0, -9.0, 0.0);
        let parts = Parts { moments: [[corner; 5]; 4], thickness: 0.5, met_at: 0.0 };
        let query = || parts.lies(Vec3::X.into(), Some(&touched), &beside);
        (0..8).for_each(|_| assert_eq!(steps_of(query), (Lies::Ahead, 4096)));
        let (lies, steps) = steps_of(query);
        assert!(lies == Lies::Ahead && steps <= most, "{steps}");
    }
}
