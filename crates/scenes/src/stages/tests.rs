use super::*;

/// Bodies that a solver or a driver moves.
fn movers<V, P>(scene: &SceneOf<V, LevelBody<impl Clone, impl Clone, V, impl Clone>, P>) -> usize {
    let bodies = scene.level.bodies.iter();
    bodies.filter(|body| !body.fixed).count()
}

fn count(scene: &Scene) -> usize {
    match scene {
        Scene::Plane(scene) => movers(scene),
        Scene::Volume(scene) => movers(scene),
    }
}

#[test]
fn stages_of_the_usual_size_have_as_many_bodies() {
    for stage in Stage::ALL {
        let moving = count(&stage.build(stage.usual_size(), 1));
        // Half bricks add one to every other course, and the wall has a ball; of the large world only a few bodies
        // move.
        let expected = match stage {
            Stage::BrickWall => 211,
            Stage::LargeWorld => 100,
            _ => stage.usual_size(),
        };
        assert_eq!(moving, expected, "{}", stage.name());
    }
}

#[test]
fn stages_of_any_size_are_there() {
    for stage in Stage::ALL {
        for size in [0, 1, 2, 7, 60] {
            let scene = stage.build(size, 3);
            assert!(count(&scene) <= (size + size / 10).max(60), "{} of {size}", stage.name());
        }
    }
}

#[test]
fn stages_depend_on_size_and_seed_alone() {
    for stage in Stage::ALL {
        let bits = |seed| match stage.build(100, seed) {
            Scene::Plane(scene) => {
                let bodies = scene.level.bodies.iter();
                bodies
                    .map(|body| body.pose.position().to_array().map(f64::to_bits).to_vec())
                    .collect::<Vec<_>>()
            }
            Scene::Volume(scene) => {
                let bodies = scene.level.bodies.iter();
                bodies.map(|body| body.pose.position().to_array().map(f64::to_bits).to_vec()).collect()
            }
        };
        assert_eq!(bits(1), bits(1), "{}", stage.name());
    }
}

#[test]
fn lists_of_a_scene_are_ascending_and_name_its_bodies() {
    for stage in Stage::ALL {
        let (drivers, bullets, owners, count) = match stage.build(300, 1) {
            Scene::Plane(scene) => lists(&scene),
            Scene::Volume(scene) => lists(&scene),
        };
        for list in [drivers, bullets, owners] {
            assert!(list.windows(2).all(|two| two[0] < two[1]), "{}", stage.name());
            assert!(list.iter().all(|&body| (body as usize) < count), "{}", stage.name());
        }
    }
}

fn lists<V, B, P>(scene: &SceneOf<V, B, P>) -> (Vec<u32>, Vec<u32>, Vec<u32>, usize) {
    let drivers = scene.drivers.iter().map(|driver| driver.body).collect();
    let owners = scene.owners.iter().map(|owner| owner.0).collect();
    (drivers, scene.bullets.clone(), owners, scene.level.bodies.len())
}
