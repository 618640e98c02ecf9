//! Short versions of the stepper's targets: `cargo run --release --example targets` runs them in full.
#![allow(clippy::unwrap_used, reason = "helpers of tests stop the test, as tests do")]

use asunder_examples::trials::{Figure, digest, keep, shoot, stand};
use asunder_scenes::stages::Stage;

fn assert_met(figures: &[Figure]) {
    for figure in figures {
        assert!(figure.is_met(), "{figure:?}");
    }
}

#[test]
fn a_stack_of_twenty_boxes_stands() {
    assert_met(&stand((Stage::Stack, 20), 8.0).unwrap());
}

#[test]
fn a_pyramid_with_a_base_of_twenty_boxes_stands() {
    assert_met(&stand((Stage::Pyramid, 210), 6.0).unwrap());
}

#[test]
fn a_card_house_of_five_storeys_stands() {
    assert_met(&stand((Stage::CardHouse, 40), 8.0).unwrap());
}

#[test]
fn a_brick_wall_stands() {
    assert_met(&stand((Stage::BrickWall, 100), 6.0).unwrap());
}

#[test]
fn a_ball_at_500_m_a_second_does_not_pass_a_wall_of_1_cm() {
    assert_met(&[shoot(500.0, 40).unwrap(), shoot(40.0, 40).unwrap()]);
}

#[test]
fn drum_and_yard_lose_nobody() {
    for stage in [Stage::Washer, Stage::Junkyard, Stage::Tumbler, Stage::Junkyard2d, Stage::Asteroids] {
        assert_met(&[keep(stage, 200, 3.0).unwrap()]);
    }
}

#[test]
fn every_stage_ends_alike_at_any_thread_count() {
    for stage in Stage::ALL {
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| digest(stage, 300, 40).unwrap())
        };
        let first = run(1);
        assert_eq!([run(1), run(2), run(8)], [first; 3], "{}", stage.name());
        assert_ne!(digest(stage, 300, 5).unwrap(), first, "{}: the digest sees what moves", stage.name());
    }
}
