//! A gun and a line of sight: what a ray hits, and whether anything is in the way.

use asunder::glam::{DVec3, Vec3};
use asunder::{Capsule3, Collider3, Cuboid, Filter3, HalfSpace, Pose3, Ray3, Sphere, World3};

const SHOOTER: u64 = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World3::new();
    world.insert(Collider3::new(HalfSpace::new(Vec3::Y)?).fixed());
    let wall = Cuboid::from_half_extents(Vec3::new(0.2, 1.0, 3.0))?;
    world.insert(Collider3::new(wall).at(Pose3::at([10.0, 1.0, 0.0])?).fixed().user_data(100));
    // The eye is inside the shooter's own body, which must not stop the ray: both bodies get the same owner, and the
    // filter leaves that owner out.
    let eye = DVec3::new(0.0, 1.7, 0.0);
    let body = Capsule3::from_half_height(0.6, 0.3)?;
    world.insert(Collider3::new(body).at(Pose3::at([0.0, 0.9, 0.0])?).owner(SHOOTER));
    world.insert(Collider3::new(Sphere::new(0.15)?).at(Pose3::at(eye)?).owner(SHOOTER));
    let target = world.insert(Collider3::new(body).user_data(101));
    let others = Filter3::new().without_owner(SHOOTER).solid();

    // The target runs behind the wall. Queries use the poses set last: no update is needed in between.
    for z in [0.0, 3.0, 6.15, 9.0] {
        let place = DVec3::new(20.0, 0.9, z);
        world.set_pose(target, Pose3::at(place)?)?;

        // Is it seen? The target's own body must not hide it.
        let sees = world.is_clear_between(eye, place, &others.without(target));
        println!("target at z = {z}: {}", if sees { "in sight" } else { "hidden" });

        // Where does the shot end? Distances are in lengths of the ray's direction: here, half a metre each.
        let shot = Ray3::new(eye, (place - eye).as_vec3().normalize() * 0.5)?;
        if let Some(hit) = world.cast_ray(&shot, 200.0, &others) {
            let what = world.get(hit.body).map_or(0, Collider3::get_user_data);
            println!("  the shot hits {what} after {:.3} m, at {:.3}", hit.distance * 0.5, hit.point);
        }
        // A thick shot, cast as a ball of 10 cm radius, also hits what a thin ray just misses.
        let ball = Sphere::new(0.1)?.into();
        let to = shot.direction() * 200.0;
        if let Some(hit) = world.cast_shape((&ball, &Pose3::at(eye)?), to, &others) {
            let what = world.get(hit.body).map_or(0, Collider3::get_user_data);
            println!(
                "  a thick one touches {what} at {:.3}, on a side that looks along {:.2}",
                hit.point, -hit.normal
            );
        }
    }
    Ok(())
}
