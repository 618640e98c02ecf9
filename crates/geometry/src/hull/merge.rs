//! Merges facets that differ from one plane by rounding only.
//!
//! ```text
//! for each facet not yet in a face, the largest first:
//!   grow over neighbouring facets that face the same way and have every corner within the tolerance of its plane,
//!     each only if the outline stays one simple loop
//! repeat with the faces as facets until nothing grows
//! vertices on no outline lie inside a face: they are returned, and the hull is built again without them
//! ```
//! Growing from the largest facet measures distances from the best-conditioned plane, never from a sliver's. A region
//! that would close around an island either takes in the island first, or leaves one facet out.

use super::loops::Loops;
use super::normal::{areas_and_normals, neighbours};
use glam::{DVec3, Vec3};

/// Stands for no vertex.
const NONE: u32 = u32::MAX;

/// How often a facet is tried for one region. It is tried again because gaps that kept the outline from being one loop
/// may have been filled meanwhile; the limit keeps a facet of thousands of corners from costing their square.
const TRIES: u8 = 8;

/// Faces as vertex loops, and the vertices that ended up inside one, ascending.
pub(super) struct Merged {
    pub(super) faces: Loops,
    pub(super) inside: Vec<u32>,
    /// Normals of the faces, if none was merged: then these are the facets, in their order.
    pub(super) normals: Option<Vec<DVec3>>,
}

/// Merges until some vertex lies inside a face, or nothing more can be merged. Cost: n log n per round; few hulls need
/// more than two rounds.
pub(super) fn merge_facets(points: &[Vec3], facets: &Loops, tolerance: f64) -> Merged {
    let sheet = Sheet::of(points, facets, tolerance);
    if !sheet.has_flat_neighbours() {
        return Merged { faces: facets.clone(), inside: Vec::new(), normals: Some(sheet.normals) };
    }
    let mut faces = sheet.merged();
    let mut before = facets.len();
    loop {
        let inside = not_visited(facets, &faces, points.len());
        if !inside.is_empty() || faces.len() == before {
            return Merged { faces, inside, normals: None };
        }
        before = faces.len();
        faces = Sheet::of(points, &faces, tolerance).merged();
    }
}

fn not_visited(facets: &Loops, faces: &Loops, count: usize) -> Vec<u32> {
    let mut is_missing = vec![false; count];
    facets.corners().iter().for_each(|&i| is_missing[i as usize] = true);
    faces.corners().iter().for_each(|&i| is_missing[i as usize] = false);
    (0..count as u32).filter(|&i| is_missing[i as usize]).collect()
}

/// The facets of a hull, and their derived data.
struct Sheet<'a> {
    points: &'a [Vec3],
    facets: &'a Loops,
    neighbours: Vec<u32>,
    areas: Vec<DVec3>,
    normals: Vec<DVec3>,
    tolerance: f64,
}

/// The plane of a facet, midway between its lowest and highest corner along its normal.
struct Level {
    normal: DVec3,
    origin: DVec3,
    middle: f64,
}

impl<'a> Sheet<'a> {
    fn of(points: &'a [Vec3], facets: &'a Loops, tolerance: f64) -> Self {
        let neighbours = neighbours(facets);
        let (areas, normals) = areas_and_normals(points, facets, &neighbours);
        Self { points, facets, neighbours, areas, normals, tolerance }
    }

    fn level(&self, facet: usize) -> Level {
        let around = self.facets.get(facet);
        let (normal, origin) = (self.normals[facet], self.points[around[0] as usize].as_dvec3());
        let level = Level { normal, origin, middle: 0.0 };
        let (low, high) = around
            .iter()
            .map(|&i| level.height(self.points[i as usize]))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), height| (l.min(height), h.max(height)));
        Level { middle: (low + high) * 0.5, ..level }
    }

    /// Whether a facet faces the same way as a level, and lies within the tolerance of it.
    fn is_flat(&self, facet: usize, level: &Level) -> bool {
        let is_there =
            |&i: &u32| (level.height(self.points[i as usize]) - level.middle).abs() <= self.tolerance;
        self.normals[facet].dot(level.normal) > 0.5 && self.facets.get(facet).iter().all(is_there)
    }

    /// Whether any facet lies in the plane of a neighbour.
    fn has_flat_neighbours(&self) -> bool {
        (0..self.facets.len()).any(|facet| {
            let level = self.level(facet);
            self.neighbours[self.facets.places(facet)]
                .iter()
                .any(|&neighbour| neighbour as usize != facet && self.is_flat(neighbour as usize, &level))
        })
    }

    /// Faces grown from the facets, the largest first.
    fn merged(&self) -> Loops {
        let mut by_area: Vec<(f64, usize)> = self.areas.iter().map(|area| area.length()).zip(0..).collect();
        by_area.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut is_taken = vec![false; self.facets.len()];
        let mut tries = vec![(0, 0); self.facets.len()];
        let mut outline = Outline { after: vec![NONE; self.points.len()], length: 0 };
        let mut faces = Loops::default();
        for (_, seed) in by_area {
            if !is_taken[seed] {
                faces.push(self.grow(seed, &mut is_taken, &mut tries, &mut outline));
            }
        }
        faces
    }

    /// The outline of the region around a seed. `tries` counts, for each facet, how often the seed (plus one) tried it.
    fn grow(
        &self,
        seed: usize,
        is_taken: &mut [bool],
        tries: &mut [(usize, u8)],
        outline: &mut Outline,
    ) -> Vec<u32> {
        let level = self.level(seed);
        is_taken[seed] = true;
        outline.start(self.facets.get(seed));
        let mut region = vec![seed];
        let mut next = 0;
        while next < region.len() {
            for &neighbour in &self.neighbours[self.facets.places(region[next])] {
                let neighbour = neighbour as usize;
                if is_taken[neighbour] {
                    continue;
                }
                let (tried_by, count) = &mut tries[neighbour];
                if *tried_by != seed + 1 {
                    (*tried_by, *count) = (seed + 1, if self.is_flat(neighbour, &level) { 0 } else { TRIES });
                }
                if *count < TRIES {
                    *count += 1;
                    if outline.join(self.facets.get(neighbour)) {
                        is_taken[neighbour] = true;
                        region.push(neighbour);
                    }
                }
            }
            next += 1;
        }
        outline.take(region.iter().flat_map(|&facet| self.facets.get(facet)).copied())
    }
}

impl Level {
    fn height(&self, place: Vec3) -> f64 {
        self.normal.dot(place.as_dvec3() - self.origin)
    }
}

/// The simple loop around a growing region: for each vertex on it, the next.
struct Outline {
    after: Vec<u32>,
    length: usize,
}

impl Outline {
    fn start(&mut self, facet: &[u32]) {
        self.length = facet.len();
        for (i, &from) in facet.iter().enumerate() {
            self.after[from as usize] = facet[(i + 1) % facet.len()];
        }
    }

    /// Moves the outline around one more facet, if it stays one simple loop.
    fn join(&mut self, facet: &[u32]) -> bool {
        let count = facet.len();
        let is_shared = |i: usize| self.after[facet[(i + 1) % count] as usize] == facet[i % count];
        let shared = (0..count).filter(|&i| is_shared(i)).count();
        let touching = facet.iter().filter(|&&i| self.after[i as usize] != NONE).count();
        // A single chain of shared edges has one vertex more than edges; two chains, or a touch elsewhere, have more.
        let is_chain = shared > 0 && touching == shared + 1;
        if !is_chain || self.length + count < 2 * shared + 3 {
            return false;
        }
        let Some(end) = (0..count).find(|&i| is_shared(i) && !is_shared(i + 1)) else { return false };
        // Edges `end - shared + 1 ..= end` are shared: their inner vertices leave the outline, the other edges join it.
        for i in end + 2 + count - shared..=end + count {
            self.after[facet[i % count] as usize] = NONE;
        }
        for i in end + 1..=end + count - shared {
            self.after[facet[i % count] as usize] = facet[(i + 1) % count];
        }
        self.length = self.length + count - 2 * shared;
        true
    }

    /// Takes the loop, starting at its first vertex among `candidates`, and leaves the outline empty.
    fn take(&mut self, mut candidates: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut around = Vec::with_capacity(self.length);
        let Some(mut at) = candidates.find(|&i| self.after[i as usize] != NONE) else { return around };
        while self.after[at as usize] != NONE {
            around.push(at);
            at = core::mem::replace(&mut self.after[at as usize], NONE);
        }
        around
    }
}
