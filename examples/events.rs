//! Doors that open by themselves: sensors, events, layers and user data.
//!
//! A sensor has contacts and events but pushes nothing. Each overlap that begins or ends gives one event, also when a
//! body is removed from the world while it stands in the doorway.

use asunder::glam::{DVec3, Vec3};
use asunder::{Capsule3, Collider3, Cuboid, Event3, Layers, Pose3, Sphere, World3};

const PEOPLE: u32 = 1 << 0;
const THINGS: u32 = 1 << 1;
const SENSORS: u32 = 1 << 2;

/// A door, and how many people stand at it.
struct Door {
    name: &'static str,
    inside: u32,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World3::new();
    let mut doors = [Door { name: "west", inside: 0 }, Door { name: "east", inside: 0 }];

    // The user data of a sensor is its door's number. Its layers let it see people, but not what they carry.
    for (number, x) in [-5.0, 5.0].into_iter().enumerate() {
        let area = Collider3::new(Cuboid::from_half_extents(Vec3::new(1.5, 1.5, 1.5))?).sensor().fixed();
        let area = area.layers(Layers { member_of: SENSORS, collides_with: PEOPLE });
        world.insert(area.at(Pose3::at([x, 1.0, 0.0])?).user_data(number as u64));
    }
    let person = Collider3::new(Capsule3::from_half_height(0.6, 0.3)?)
        .layers(Layers { member_of: PEOPLE, collides_with: PEOPLE | SENSORS });
    let walker = world.insert(person.clone().user_data(100));
    let waiter = world.insert(person.at(Pose3::at([5.0, 0.9, 0.5])?).user_data(101));
    let parcel =
        Collider3::new(Sphere::new(0.2)?).layers(Layers { member_of: THINGS, collides_with: THINGS });
    let parcel = world.insert(parcel);

    for step in 0..=16 {
        let place = DVec3::new(-8.0 + f64::from(step), 0.9, 0.0);
        world.set_pose(walker, Pose3::at(place)?)?;
        world.set_pose(parcel, Pose3::at(place + DVec3::X * 0.4)?)?;
        if step == 14 {
            // Removed while it touches the sensor: the door still gets its end event.
            world.remove(waiter);
        }
        world.update();
        for event in world.events() {
            hear(&mut doors, event);
        }
    }
    let in_doors: u32 = doors.iter().map(|door| door.inside).sum();
    println!("{in_doors} in the doors, {} bodies left", world.len());
    Ok(())
}

/// Opens a door when the first person comes, and closes it behind the last.
fn hear(doors: &mut [Door], event: &Event3) {
    // The sensor may be either body of the event.
    let (first, second) = event.user_data();
    let (number, who) = if first < doors.len() as u64 { (first, second) } else { (second, first) };
    let Some(door) = doors.get_mut(number as usize) else { return };
    if event.is_began() {
        door.inside += 1;
        println!("{who} is at the {} door{}", door.name, if door.inside == 1 { ": it opens" } else { "" });
    } else {
        door.inside -= 1;
        println!(
            "{who} has left the {} door{}",
            door.name,
            if door.inside == 0 { ": it closes" } else { "" }
        );
    }
}
