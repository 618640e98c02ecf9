//! A crate is lowered onto a floor: first steps with asunder.

use asunder::{Collider3, Cuboid, Event3, Pose3, World3, glam::Vec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World3::new();
    let floor = Cuboid::from_half_extents(Vec3::new(50.0, 0.5, 50.0))?;
    let floor = world.insert(Collider3::new(floor).fixed());
    let crate_ = Cuboid::from_half_extents(Vec3::splat(0.5))?;
    let crate_ = world.insert(Collider3::new(crate_).user_data(7));

    for height in [1.2, 1.0, 0.99, 1.1] {
        world.set_pose(crate_, Pose3::at(Vec3::new(0.0, height, 0.0))?)?;
        world.update();
        for event in world.events() {
            let what = if matches!(event, Event3::Began { .. }) { "began" } else { "ended" };
            println!("height {height}: contact {what}");
        }
        for contact in world.contacts_of(floor) {
            let manifold = &contact.manifolds[0];
            println!("  separation {} +- {} m", manifold.separation, manifold.error);
            println!("  {} points, normal {}", manifold.points.len(), manifold.normal);
        }
    }
    Ok(())
}
