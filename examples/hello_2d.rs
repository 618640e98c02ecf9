//! A ball rolls down a slope and off its end: first steps in the plane.

use asunder::{Chain, Circle, Collider2, Pose2, World2, glam::Vec2};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World2::new();
    // The ground is a chain of segments. Drawn from right to left it faces up; one-sided, it is open from below.
    let slope = Chain::open([Vec2::new(4.0, 0.0), Vec2::new(2.0, 0.2), Vec2::new(0.0, 1.0)])?.one_sided();
    let slope = world.insert(Collider2::new(slope));
    // A margin of 5 cm: the contact is reported from 5 cm before the ball touches, with a positive separation.
    let ball = world.insert(Collider2::new(Circle::new(0.25)?).margin(0.05)?);

    for step in 0..=10 {
        let x = 0.5 * f64::from(step);
        let ground = if x < 2.0 { 1.0 - 0.4 * x } else { 0.4 - 0.1 * x };
        world.set_pose(ball, Pose2::at([x, ground + 0.25])?)?;
        world.update();
        for event in world.events() {
            let what = if event.is_began() { "began" } else { "ended" };
            println!("x = {x}: contact {what}");
        }
        if let Some(contact) = world.contact(slope, ball) {
            let manifold = &contact.manifolds[0];
            println!("x = {x}: separation {:.4} m, normal {:.3}", manifold.separation, manifold.normal);
        }
    }
    Ok(())
}
