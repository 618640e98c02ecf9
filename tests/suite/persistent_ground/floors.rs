//! A crate on a floor cut into triangles, and hulls far from their positions: how far manifolds are moved along, and
//! when contacts are made anew.

use super::{Stand, moved, roof};
use asunder_geometry::{Cuboid, Hull, Pose3, Shape3, TriMesh};
use asunder_narrow::{Batch3, Manifold3, Persistent3, collide3};
use asunder_scenes::terrain::Terrain;
use glam::{DVec3, Vec3};

/// The height of a floor cut into triangles at a place, and a function that puts a crate 0.8 m wide on it.
fn crates_on_a_floor(count: usize, place: [f64; 2]) -> (f64, impl Fn(Pose3) -> Stand) {
    let terrain = Terrain::flat(count, 1.0);
    let ground = Shape3::from(TriMesh::new(terrain.vertices(), terrain.triangles()).unwrap());
    let body = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap());
    let stand_at = move |pose: Pose3| Stand {
        body: body.clone(),
        pose,
        ground: ground.clone(),
        field: Pose3::IDENTITY,
        is_turned: false,
    };
    (terrain.under(place).0, stand_at)
}

/// A crate slides over a floor cut into triangles: no contact is lost, and one with a wall that comes near appears in
/// time.
#[test]
fn a_crate_slides_on_a_floor_as_if_it_were_made_anew() {
    let (height, crate_at) = crates_on_a_floor(800, [10.0, 10.0]);
    // Its corners stand on seams.
    for x in [10.0, 10.4, 10.1234] {
        let pose = Pose3::at(DVec3::new(x, height + 0.4 - 1e-3, 10.4)).unwrap();
        let stand = crate_at(pose);
        let (.., Some(kept)) = stand.made(&pose) else { panic!("it rests at {x}") };
        for step in 0..25 {
            let now = moved(&pose, DVec3::new(1e-4, -2e-6, 0.5e-4) * f64::from(step), DVec3::ZERO);
            let found = stand.carried(&kept, &now).expect("two and a half millimetres");
            let (_, fresh, _) = stand.made(&now);
            assert_eq!((found.len(), fresh.len()), (1, 1));
            let (found, fresh) = (&found[0], &fresh[0]);
            assert!((found.separation - fresh.separation).abs() <= 1e-7, "{x}: {found:?} {fresh:?}");
            assert!(found.error <= fresh.error + 1e-8, "{x}: {found:?} {fresh:?}");
            assert_eq!(found.normal, fresh.normal);
            let named = |manifold: &Manifold3| {
                let mut all: Vec<_> = manifold.points.iter().map(|p| (p.feature, p.anchor_a)).collect();
                all.sort_by_key(|(feature, _)| *feature);
                all
            };
            for (one, other) in named(found).iter().zip(named(fresh)) {
                assert_eq!(one.0, other.0);
                assert!((one.1 - other.1).length() <= 1e-6);
            }
        }
    }
}

#[test]
fn what_cannot_be_known_is_made_anew() {
    let (height, crate_at) = crates_on_a_floor(200, [5.3, 5.3]);
    let at = |up: f64| Pose3::at(DVec3::new(5.3, height + 0.4 + up, 5.3)).unwrap();
    let stand_at = |up: f64| crate_at(at(up));
    let stand = stand_at(-1e-3);
    let (.., Some(kept)) = stand.made(&stand.pose) else { panic!("it rests") };
    assert!(
        stand.carried(&kept, &at(-1e-6)).is_some() && stand.carried(&kept, &at(1e-6)).is_none(),
        "no more"
    );
    assert!(stand.carried(&kept, &moved(&stand.pose, DVec3::X * 3e-3, DVec3::ZERO)).is_none(), "too far");
    assert!(
        stand.carried(&kept, &moved(&stand.pose, DVec3::ZERO, DVec3::X * 1e-3)).is_none(),
        "too much turned"
    );
    let mut found = Vec::new();
    let lifted = Pose3::at(DVec3::Y * -1e-9).unwrap();
    assert!(!kept.carry_on([&stand.pose, &lifted], &mut found) && found.is_empty(), "ground has moved");
    // A gap is kept until it may have closed, or may be beyond the margin.
    for (up, may, never) in [(1e-4, 0.9e-4, 1.1e-4), (0.0199, 0.9e-4, 1.1e-4)] {
        let stand = stand_at(up);
        let (.., Some(kept)) = stand.made(&stand.pose) else { panic!("it is near, at {up}") };
        assert!(!kept.overlapping());
        for way in [DVec3::Y, DVec3::NEG_Y, DVec3::X] {
            assert!(
                stand.carried(&kept, &moved(&stand.pose, way * may, DVec3::ZERO)).is_some(),
                "{up} {way}"
            );
            assert!(
                stand.carried(&kept, &moved(&stand.pose, way * never, DVec3::ZERO)).is_none(),
                "{up} {way}"
            );
        }
    }
}

/// Without a margin there is no warning: ground too far away to have been reported may be overlapped after a small
/// drift.
#[test]
fn without_a_margin_nothing_slides_far() {
    let (height, crate_at) = crates_on_a_floor(200, [5.3, 5.3]);
    let poses = [Pose3::at(DVec3::new(5.3, height + 0.399, 5.3)).unwrap(), Pose3::IDENTITY];
    let reach = |margin: f32| {
        let stand = crate_at(poses[0]);
        let job = stand.job(&poses, margin);
        let mut batch = Batch3::default();
        collide3(&[stand.job(&poses, margin)], &mut batch);
        Persistent3::of(&job, &batch.answers[0], &batch.manifolds).map_or(0.0, |kept| kept.reach())
    };
    let radius = crate_at(poses[0]).body.outer_radius();
    assert!((reach(0.02) - radius / 256.0).abs() < 1e-9);
    assert_eq!(reach(1e-3), 1e-3);
    assert!(reach(0.0) > 0.0 && reach(0.0) <= 3.1e-5 * radius);
}

/// Symptom: a hull a thousand times its size from its own position was moved along until its contacts could be off by a
/// hundredth of its size. Cause: the allowed growth of the error was a share of how far the body reaches from its
/// position.
#[test]
fn a_hull_far_from_its_position_is_told_as_well_as_one_about_it() {
    let ground = roof(0.0);
    for far in [0.0, 64.0, 1024.0] {
        let corner = |i: u8| DVec3::from([0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -0.5 } else { 0.5 }));
        let middle = DVec3::new(far, 0.0, 0.0);
        let corners: Vec<Vec3> = (0..8).map(|i| (middle + corner(i)).as_vec3()).collect();
        let body = Shape3::from(Hull::from_points(&corners).unwrap());
        let pose = Pose3::at(DVec3::new(2.0, 0.5 - 1e-3, 1.0) - middle).unwrap();
        let stand = Stand { body, pose, ground: ground.clone(), field: Pose3::IDENTITY, is_turned: false };
        let (Some(true), made, Some(kept)) = stand.made(&pose) else { panic!("it rests, {far} m away") };
        let arm = far + stand.size();
        let (mut carried, mut spin) = (0, DVec3::Y * f64::from(kept.reach()) / arm);
        for round in 0..60 {
            spin *= 0.85;
            // About its centre.
            let turned = moved(&pose, DVec3::ZERO, spin);
            let back = pose.transform(middle) - turned.transform(middle);
            let now = moved(&turned, back, DVec3::ZERO);
            let Some(found) = stand.carried(&kept, &now) else { continue };
            carried += 1;
            let grown = f64::from(found[0].error - made[0].error);
            // Twice a drift of 2^-15, and rounding.
            let most = stand.size() * (2.0 / 32_768.0) * (1.0 + 1e-6);
            assert!(grown <= most, "{far} m away, round {round}: {grown} m of {most}");
            let lowest = corners.iter().map(|&corner| now.transform(corner).y);
            let off = lowest.fold(f64::INFINITY, f64::min) - f64::from(found[0].separation);
            assert!(off.abs() <= found[0].error.into(), "{far} m away, round {round}: off by {off} m");
        }
        assert!(carried > 10, "{far} m away: {carried}");
    }
}
