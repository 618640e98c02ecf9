//! Building meshes, rays, and queries for a body and the ground.

use super::{Question, mesh_of};
use crate::clock::Effort;
use crate::parry::{self, Shapes};
use crate::race::Race;
use crate::row::Row;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Ray3, Shape3, TriMesh};
use asunder_narrow::{Pair3, cast_ray3};
use asunder_scenes::random::Random;
use asunder_scenes::terrain::Terrain;
use parry3d::math::Vector;
use parry3d::query::{self, Ray, ShapeCastOptions};
use parry3d::shape::SharedShape;
use std::error::Error;

/// Queries per set.
const QUESTIONS: usize = 2000;

const PEER: &str = "parry3d TriMesh";

/// The building time per triangle.
pub(super) fn build(terrain: &Terrain, effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    let effort = Effort { rounds: effort.rounds.min(9), ..*effort };
    let (vertices, triangles) = (terrain.vertices(), terrain.triangles());
    let mut race = Race::default();
    while !race.is_over(&effort) {
        let [ours, peers] = [(); 2].map(|()| (vertices.clone(), triangles.clone()));
        let ours = || TriMesh::new(ours.0, ours.1);
        let (mesh, _) = race.turn(triangles.len(), ours, || SharedShape::trimesh(peers.0, peers.1));
        if row.note.is_empty() {
            row.remark(&format!("{:.1} bytes a triangle", mesh?.bytes() as f64 / triangles.len() as f64));
        }
    }
    race.tell(&mut row, PEER);
    Ok(row)
}

/// Points between `low` and `high` metres above the ground, and a downward motion for each, long enough to pass
/// through.
fn falls(terrain: &Terrain, low: f64, high: f64) -> Vec<(DVec3, Vec3)> {
    let mut random = Random::new(22);
    let inside = |random: &mut Random| random.range(0.2, 0.8) * terrain.side();
    (0..QUESTIONS)
        .map(|_| {
            let (x, z) = (inside(&mut random), inside(&mut random));
            let (height, _) = terrain.under([x, z]);
            let aside = random.direction() * 10.0;
            let above = if low < high { random.range(low, high) } else { low };
            (DVec3::new(x, height + above, z), Vec3::new(aside.x as f32, -30.0, aside.z as f32))
        })
        .collect()
}

/// The whole set on both sides in turns, until rounds or time are used up.
fn in_turns(effort: &Effort, mut row: Row, ours: impl FnMut() -> usize, peer: impl FnMut() -> usize) -> Row {
    let (race, said) = Race::run(effort, QUESTIONS, ours, peer, |hits, peer_hits| {
        format!("{hits} of {QUESTIONS} say yes, the peer's {peer_hits}")
    });
    row.remark(&said);
    race.tell(&mut row, PEER);
    row
}

pub(super) fn rays(terrain: &Terrain, effort: &Effort, row: Row) -> Result<Row, Box<dyn Error>> {
    let (mesh, falls) = (mesh_of(terrain)?, falls(terrain, 10.0, 10.0));
    let twin = Shapes::default().convert(&mesh).ok_or("parry3d refuses the mesh")?;
    let rays: Vec<Ray3> = falls.iter().map(|(from, way)| Ray3::new(*from, *way)).collect::<Result<_, _>>()?;
    let twins: Vec<Ray> = falls.iter().map(|(from, way)| Ray::new(from.as_vec3(), *way)).collect();
    let here = parry::pose(&Pose3::IDENTITY);
    let ours = |ray: &&Ray3| cast_ray3(&mesh, &Pose3::IDENTITY, ray, 1.0).is_some();
    let peer = |ray: &&Ray| twin.cast_ray_and_get_normal(&here, ray, 1.0, false).is_some();
    Ok(in_turns(effort, row, || rays.iter().filter(ours).count(), || twins.iter().filter(peer).count()))
}

/// One query for one shape, in many places.
pub(super) fn bodies(
    terrain: &Terrain,
    (question, shape): (Question, &Shape3),
    effort: &Effort,
    row: Row,
) -> Result<Row, Box<dyn Error>> {
    let (low, high) = match question {
        Question::Cast => (10.0, 10.0),
        Question::Overlap => (-0.8, 1.6),
        Question::Distance => (0.8, 3.4),
    };
    let (mesh, falls) = (mesh_of(terrain)?, falls(terrain, low, high));
    let mut shapes = Shapes::default();
    let twin = shapes.convert(&mesh).ok_or("parry3d refuses the mesh")?;
    let twin_shape = shapes.convert(shape).ok_or("parry3d refuses the shape")?;
    let poses: Vec<Pose3> = falls.iter().map(|(from, _)| Pose3::at(*from)).collect::<Result<_, _>>()?;
    let options = ShapeCastOptions { max_time_of_impact: 1.0, ..ShapeCastOptions::default() };
    let here = parry::pose(&Pose3::IDENTITY);
    let of_peer: Vec<_> = poses.iter().map(parry::pose).collect();
    let ours = |(pose, (_, way)): &(&Pose3, &(DVec3, Vec3))| {
        let pair = Pair3::new(shape, pose, &mesh, &Pose3::IDENTITY);
        match question {
            Question::Cast => pair.cast(*way).is_some(),
            Question::Overlap => pair.overlaps(),
            Question::Distance => pair.distance().is_some_and(|closest| closest.distance > 0.0),
        }
    };
    let peer = |(pose, (_, way)): &(&parry3d::math::Pose, &(DVec3, Vec3))| {
        let (pose, one, other) = (*pose, &*twin_shape.0, &*twin.0);
        match question {
            Question::Cast => query::cast_shapes(pose, *way, one, &here, Vector::ZERO, other, options)
                .is_ok_and(|hit| hit.is_some()),
            Question::Overlap => {
                query::intersection_test(pose, one, &here, other).is_ok_and(|found| found.intersecting)
            }
            Question::Distance => {
                query::distance(pose, one, &here, other).is_ok_and(|found| found.distance > 0.0)
            }
        }
    };
    Ok(in_turns(
        effort,
        row,
        || poses.iter().zip(&falls).filter(ours).count(),
        || of_peer.iter().zip(&falls).filter(peer).count(),
    ))
}
