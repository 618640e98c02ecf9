//! Queries of a single shape.

use super::{Alone, Kind, PAIRS, points};
use crate::clock::Effort;
use crate::parry::{self, Shapes};
use crate::race::Race;
use crate::row::Row;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Hull, Pose3, Ray3, Shape3};
use asunder_narrow::cast_ray3;
use asunder_scenes::random::Random;
use parry3d::math::Pose;
use parry3d::query::Ray;
use parry3d::shape::SharedShape;
use std::error::Error;

/// A shape in a pose, a point near it and a ray towards it, and the same for parry3d.
struct One {
    shape: Shape3,
    pose: Pose3,
    local: Vec3,
    ray: Ray3,
    peer: SharedShape,
    peer_pose: Pose,
    peer_ray: Ray,
}

fn ones(kind: Kind) -> Result<Vec<One>, Box<dyn Error>> {
    let (mut random, mut shapes) = (Random::new(0xa10e), Shapes::default());
    let mut one = || {
        let shape = kind.shape(&mut random)?;
        let pose = Pose3::new(random.within(DVec3::splat(-5.0), DVec3::splat(5.0)), random.rotation())?;
        let local = (random.direction() * random.range(0.0, 0.8)).as_vec3();
        let from = pose.position() + random.direction() * 5.0;
        let past = pose.position() + random.direction() * random.range(0.0, 0.6);
        let way = ((past - from) * 2.0).as_vec3();
        let peer = shapes.convert(&shape).ok_or("parry3d refuses a shape")?;
        let (peer_pose, peer_ray) = (parry::pose(&pose), Ray::new(from.as_vec3(), way));
        Ok(One { shape, pose, local, ray: Ray3::new(from, way)?, peer, peer_pose, peer_ray })
    };
    (0..PAIRS).map(|_| one()).collect()
}

/// The answers of both sides for all of them, in turns.
fn in_turns(effort: &Effort, mut row: Row, ours: impl FnMut() -> f32, peer: impl FnMut() -> f32) -> Row {
    let (race, said) = Race::run(effort, PAIRS, ours, peer, |found, found_by_peer| {
        format!("the answers sum up to {found}, the peer's to {found_by_peer}")
    });
    row.remark(&said);
    race.tell(&mut row, "parry3d");
    row
}

pub(super) fn measure(kind: Kind, question: Alone, effort: &Effort, row: Row) -> Result<Row, Box<dyn Error>> {
    if question == Alone::Make {
        let mut random = Random::new(0x3a4e);
        let clouds: Vec<Vec<Vec3>> = (0..PAIRS).map(|_| points(&mut random, 0.5)).collect();
        let corners = |found: Option<usize>| found.unwrap_or(0) as f32;
        let ours =
            |cloud: &Vec<Vec3>| corners(Hull::from_points(cloud).ok().map(|hull| hull.vertices().len()));
        let peer = |cloud: &Vec<Vec3>| {
            let made = SharedShape::convex_hull(cloud);
            corners(made.and_then(|shape| Some(shape.as_convex_polyhedron()?.points().len())))
        };
        return Ok(in_turns(effort, row, || clouds.iter().map(ours).sum(), || clouds.iter().map(peer).sum()));
    }
    let ones = ones(kind)?;
    let ours = |one: &One| match question {
        Alone::Ray => cast_ray3(&one.shape, &one.pose, &one.ray, 1.0).map_or(0.0, |hit| hit.distance as f32),
        Alone::Point => f32::from(u8::from(one.shape.contains(one.local.as_dvec3()))),
        Alone::Bounds => one.shape.bounds(&one.pose, 0.0).max.x,
        Alone::Mass | Alone::Make => one.shape.mass_properties(1.0).map_or(0.0, |mass| mass.mass as f32),
    };
    let peer = |one: &One| match question {
        Alone::Ray => one
            .peer
            .cast_ray_and_get_normal(&one.peer_pose, &one.peer_ray, 1.0, true)
            .map_or(0.0, |hit| hit.time_of_impact),
        Alone::Point => f32::from(u8::from(one.peer.contains_local_point(one.local))),
        Alone::Bounds => one.peer.compute_aabb(&one.peer_pose).maxs.x,
        Alone::Mass | Alone::Make => one.peer.mass_properties(1.0).mass(),
    };
    Ok(in_turns(effort, row, || ones.iter().map(ours).sum(), || ones.iter().map(peer).sum()))
}
