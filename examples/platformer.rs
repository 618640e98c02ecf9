//! A platformer character in 2D jumps onto a ledge that is solid only from above; a lift of the same kind carries it.

use asunder::glam::{DVec2, Vec2};
use asunder::{Capsule2, Collider2, Filter2, Pose2, Rect, Shape2, Walk2, World2};

/// Marks a ledge in its `user_data`: it can be jumped through from below.
const ONE_WAY: u64 = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World2::new();
    let block = |half: [f32; 2], at: [f64; 2]| -> Result<Collider2, Box<dyn std::error::Error>> {
        Ok(Collider2::new(Rect::from_half_extents(Vec2::from(half))?).at(Pose2::at(at)?).fixed())
    };
    world.insert(block([12.0, 0.5], [12.0, -0.5])?);
    world.insert(block([4.0, 0.25], [11.0, 1.75])?.user_data(ONE_WAY));
    world.insert(block([0.5, 3.0], [21.5, 3.0])?);
    let lift = world.insert(block([2.0, 0.25], [19.0, -0.5])?.user_data(ONE_WAY));

    let hero = Shape2::from(Capsule2::from_half_height(0.3, 0.3)?);
    let walk = Walk2::new(&hero, Vec2::Y)?;
    let mut pose = Pose2::at([1.0, 0.61])?;
    let (mut fall, mut footing, mut trace) = (0.0, None, Vec::new());
    for frame in 0..80 {
        // The lift moves first, and takes along who stands on it.
        let rise: f32 = if frame < 40 { 0.0 } else { 0.08 };
        let lifted = world.pose(lift).ok_or("the lift is gone")?.shifted(DVec2::Y * f64::from(rise))?;
        world.set_pose(lift, lifted)?;
        let feet = pose.position().y - 0.6;
        if let Some(footing) = &footing {
            pose = world.carried(footing, &pose);
        }
        // A ledge is solid only while the feet do not rise against it and were not below it, before either moved.
        let is_solid = |key, body: &Collider2| {
            let top = body.pose().position().y + 0.25;
            let own_rise = if key == lift { rise } else { 0.0 };
            let was_above = feet >= top - f64::from(own_rise);
            body.get_user_data() != ONE_WAY || fall <= own_rise && was_above
        };
        let filter = Filter2::new().only(&is_solid);
        let slide = world.move_and_slide((&hero, &pose), Vec2::new(0.32, fall), &walk, &filter);
        pose = slide.pose;
        footing = world.footing(&slide, &walk);
        trace.push(pose.position() - DVec2::Y * 0.6);
        fall = match slide.ground {
            Some(_) if frame == 20 => 0.6,
            Some(_) => -0.05,
            None => fall - 0.06,
        };
    }
    draw(&world, &trace);
    Ok(())
}

/// Prints one line of text for every half metre of height: solids, ledges, and where the feet were.
fn draw(world: &World2, trace: &[DVec2]) {
    for row in (-1..10).rev() {
        let line = (0..60).map(|column| {
            let point = DVec2::new(0.4 * f64::from(column) + 0.2, 0.5 * f64::from(row) + 0.25);
            let is_near = |feet: &&DVec2| (**feet - point).abs().cmple(DVec2::new(0.2, 0.25)).all();
            let body = world.closest(point, 0.0, &Filter2::new()).and_then(|near| world.get(near.body));
            match body {
                _ if trace.iter().any(|feet| is_near(&feet)) => 'o',
                Some(body) if body.get_user_data() == ONE_WAY => '=',
                Some(_) => '#',
                None => ' ',
            }
        });
        println!("{}", line.collect::<String>().trim_end());
    }
}
