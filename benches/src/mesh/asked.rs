//! Making meshes, rays and casts.

use super::mesh_of;
use crate::clock::{Effort, Samples, time};
use crate::parry::{self, Shapes};
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

/// Questions in a set.
const QUESTIONS: usize = 2000;

/// The time for a triangle.
pub(super) fn build(terrain: &Terrain, effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    let (vertices, triangles) = (terrain.vertices(), terrain.triangles());
    let (mut ours, mut peer) = (Samples::default(), Samples::default());
    let count = triangles.len() as f64;
    for _ in 0..effort.rounds.min(9) {
        let given = (vertices.clone(), triangles.clone());
        let (ns, mesh) = time(|| TriMesh::new(given.0, given.1));
        ours.push(ns / count, ns);
        if row.note.is_empty() {
            row.remark(&format!("{:.1} bytes a triangle", mesh?.bytes() as f64 / count));
        }
        let given = (vertices.clone(), triangles.clone());
        let (ns, _) = time(|| SharedShape::trimesh(given.0, given.1));
        peer.push(ns / count, ns);
        if ours.spent().max(peer.spent()) > effort.nanoseconds() {
            break;
        }
    }
    Ok(told(row, "parry3d TriMesh", &ours, &peer))
}

/// A point over the ground, and a way down that is as long as it takes to pass through.
fn falls(terrain: &Terrain) -> Vec<(DVec3, Vec3)> {
    let mut random = Random::new(22);
    let inside = |random: &mut Random| random.range(0.2, 0.8) * terrain.side();
    (0..QUESTIONS)
        .map(|_| {
            let (x, z) = (inside(&mut random), inside(&mut random));
            let (height, _) = terrain.under([x, z]);
            let aside = random.direction() * 10.0;
            (DVec3::new(x, height + 10.0, z), Vec3::new(aside.x as f32, -30.0, aside.z as f32))
        })
        .collect()
}

pub(super) fn rays(terrain: &Terrain, effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    let (mesh, falls) = (mesh_of(terrain)?, falls(terrain));
    let twin = Shapes::default().convert(&mesh).ok_or("parry3d refuses the mesh")?;
    let rays: Vec<Ray3> = falls.iter().map(|(from, way)| Ray3::new(*from, *way)).collect::<Result<_, _>>()?;
    let twins: Vec<Ray> = falls.iter().map(|(from, way)| Ray::new(from.as_vec3(), *way)).collect();
    let (mut ours, mut peer) = (Samples::default(), Samples::default());
    for _ in 0..effort.rounds {
        let (ns, hits) =
            time(|| rays.iter().filter_map(|ray| cast_ray3(&mesh, &Pose3::IDENTITY, ray, 1.0)).count());
        ours.push(ns / QUESTIONS as f64, ns);
        let pose = parry::pose(&Pose3::IDENTITY);
        let (ns, peer_hits) = time(|| {
            twins.iter().filter_map(|ray| twin.cast_ray_and_get_normal(&pose, ray, 1.0, false)).count()
        });
        peer.push(ns / QUESTIONS as f64, ns);
        if row.note.is_empty() {
            row.remark(&format!("{hits} of {QUESTIONS} hit, the peer's {peer_hits}"));
        }
        if ours.spent().max(peer.spent()) > effort.nanoseconds() {
            break;
        }
    }
    Ok(told(row, "parry3d TriMesh", &ours, &peer))
}

pub(super) fn casts(
    terrain: &Terrain,
    shape: &Shape3,
    effort: &Effort,
    mut row: Row,
) -> Result<Row, Box<dyn Error>> {
    let (mesh, falls) = (mesh_of(terrain)?, falls(terrain));
    let mut shapes = Shapes::default();
    let twin = shapes.convert(&mesh).ok_or("parry3d refuses the mesh")?;
    let twin_shape = shapes.convert(shape).ok_or("parry3d refuses the shape")?;
    let poses: Vec<Pose3> = falls.iter().map(|(from, _)| Pose3::at(*from)).collect::<Result<_, _>>()?;
    let (mut ours, mut peer) = (Samples::default(), Samples::default());
    let options = ShapeCastOptions { max_time_of_impact: 1.0, ..ShapeCastOptions::default() };
    let here = parry::pose(&Pose3::IDENTITY);
    for _ in 0..effort.rounds {
        let both = poses.iter().zip(&falls);
        let cast = |(pose, (_, way)): (&Pose3, &(DVec3, Vec3))| {
            Pair3::new(shape, pose, &mesh, &Pose3::IDENTITY).cast(*way)
        };
        let (ns, hits) = time(|| both.clone().filter_map(cast).count());
        ours.push(ns / QUESTIONS as f64, ns);
        let cast = |(pose, (_, way)): (&Pose3, &(DVec3, Vec3))| {
            let pose = parry::pose(pose);
            query::cast_shapes(&pose, *way, &*twin_shape.0, &here, Vector::ZERO, &*twin.0, options).ok()?
        };
        let (ns, peer_hits) = time(|| both.clone().filter_map(cast).count());
        peer.push(ns / QUESTIONS as f64, ns);
        if row.note.is_empty() {
            row.remark(&format!("{hits} of {QUESTIONS} hit, the peer's {peer_hits}"));
        }
        if ours.spent().max(peer.spent()) > effort.nanoseconds() {
            break;
        }
    }
    Ok(told(row, "parry3d TriMesh", &ours, &peer))
}

fn told(mut row: Row, peer_name: &'static str, ours: &Samples, peer: &Samples) -> Row {
    (row.ours_ns, row.done) = (ours.median(), ours.len());
    (row.peer, row.peer_ns) = (Some(peer_name), peer.median());
    row.finish();
    row
}
