//! `overlaps_front` and `is_free` see only the front of one-sided ground, as contacts do.

use super::{beside, level};
use asunder::glam::DVec2;
use asunder::{
    Collider2, Collider3, Filter2, Filter3, Pair2, Pair3, Pose2, Pose3, Shape2, Shape3, World2, World3,
};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{CHAINS, Clay, KINDS2, KINDS3};

fn one_sided(ground: Shape3) -> Shape3 {
    match ground {
        Shape3::TriMesh(mesh) => mesh.one_sided().into(),
        Shape3::HeightField(field) => field.one_sided().into(),
        other => other,
    }
}

#[test]
fn who_is_free_of_ground_has_no_deep_manifold_with_it_and_who_is_not_has_one() {
    let (mut random, mut told) = (Random::new(26), [[0; 2]; 2]);
    for round in 0..12_000 {
        let (ground, at) = level(&mut random, round);
        let has_one_side = round % 3 > 0;
        let ground = if has_one_side { one_sided(ground) } else { ground };
        let body = KINDS3[random.below(12)].1(&mut Clay::thick(&mut random));
        let away = random.pick(&[0.0, 0.5, 1.5]);
        let place = beside(&mut random, (&ground, &at), away);
        let turn = if random.below(3) == 0 { at.rotation() } else { random.quaternion() };
        let pose = Pose3::new(place, turn).unwrap();
        let pair = Pair3::new(&body, &pose, &ground, &at);
        let is_deep = pair.manifolds(0.0).iter().any(|manifold| manifold.separation <= 0.0);
        assert_eq!(pair.overlaps_front(), is_deep, "{round}: {body:?}");
        assert_eq!(Pair3::new(&ground, &at, &body, &pose).overlaps_front(), is_deep, "{round}: {body:?}");
        let mut world = World3::new();
        world.insert(Collider3::new(ground).at(at));
        assert_eq!(world.is_free((&body, &pose), &Filter3::new()), !is_deep, "{round}: {body:?}");
        told[usize::from(has_one_side)][usize::from(is_deep)] += 1;
    }
    assert!(told.as_flattened().iter().all(|&count| count > 600), "{told:?}");
}

#[test]
fn who_is_free_of_chains_has_no_deep_manifold_with_them_and_who_is_not_has_one() {
    let (mut random, mut told) = (Random::new(27), [[0; 2]; 2]);
    for round in 0..12_000 {
        let Shape2::Chain(chain) = CHAINS[random.below(3)].1(&mut Clay::thick(&mut random)) else { continue };
        let near = chain.vertices()[random.below(chain.vertices().len())].as_dvec2();
        let has_one_side = round % 3 > 0;
        let ground = Shape2::from(if has_one_side { chain.one_sided() } else { chain });
        let at = Pose2::new(DVec2::new(2.0, -1.0), random.rotation2()).unwrap();
        let body = KINDS2[random.below(9)].1(&mut Clay::thick(&mut random));
        let away = random.direction2() * random.pick(&[0.0, 0.5, 1.5]);
        let pose = Pose2::new(at.transform(near) + away, random.rotation2()).unwrap();
        let pair = Pair2::new(&body, &pose, &ground, &at);
        let is_deep = pair.manifolds(0.0).iter().any(|manifold| manifold.separation <= 0.0);
        assert_eq!(pair.overlaps_front(), is_deep, "{round}: {body:?}");
        assert_eq!(Pair2::new(&ground, &at, &body, &pose).overlaps_front(), is_deep, "{round}: {body:?}");
        let mut world = World2::new();
        world.insert(Collider2::new(ground).at(at));
        assert_eq!(world.is_free((&body, &pose), &Filter2::new()), !is_deep, "{round}: {body:?}");
        told[usize::from(has_one_side)][usize::from(is_deep)] += 1;
    }
    assert!(told.as_flattened().iter().all(|&count| count > 600), "{told:?}");
}
