//! A reference implementation of meshes, straight from the definitions: loops over all triangles and positions.

use super::Named;
use crate::ground::Prominent;
use crate::tolerance::FLAT;
use crate::triangle::Triangle3;
use glam::{DVec3, Vec3};

/// The triangle, the edge, and its two ends.
type HalfEdge = (u32, usize, [Vec3; 2]);

pub(super) struct Plain<'a> {
    given: &'a Named,
    is_one_sided: bool,
    kept: Vec<bool>,
    /// Half-edges of kept triangles, by the positions of their ends.
    half_edges: Vec<HalfEdge>,
}

impl<'a> Plain<'a> {
    pub(super) fn of(given: &'a Named, is_one_sided: bool) -> Self {
        let mut plain = Self { given, is_one_sided, kept: vec![], half_edges: vec![] };
        let mut known: Vec<Vec<[u32; 3]>> = Vec::new();
        for number in 0..given.triangles.len() as u32 {
            let places = plain.places(number);
            let is_kept = !plain.is_degenerate(number) && !known.contains(&places);
            if is_kept {
                known.push(places);
                let corners = plain.corners(number);
                let ends = |edge: usize| [corners[edge], corners[(edge + 1) % 3]];
                plain.half_edges.extend((0..3).map(|edge| (number, edge, ends(edge))));
            }
            plain.kept.push(is_kept);
        }
        plain
    }

    pub(super) fn corners(&self, number: u32) -> [Vec3; 3] {
        self.given.triangles[number as usize].map(|vertex| self.given.vertices[vertex as usize])
    }

    /// Corners as bits, sorted; in one-sided meshes rotated to start with the least.
    fn places(&self, number: u32) -> Vec<[u32; 3]> {
        let bits = |corner: Vec3| corner.to_array().map(|part| (part + 0.0).to_bits());
        let mut places: Vec<_> = self.corners(number).map(bits).to_vec();
        if self.is_one_sided {
            let least = (0..3).min_by_key(|&corner| places[corner]).unwrap();
            places.rotate_left(least);
        } else {
            places.sort_unstable();
        }
        places
    }

    pub(super) fn is_degenerate(&self, number: u32) -> bool {
        let [a, b, c] = self.corners(number);
        Triangle3::new(a, b, c).is_err()
    }

    pub(super) fn is_kept(&self, number: u32) -> bool {
        self.kept[number as usize]
    }

    pub(super) fn neighbor(&self, number: u32, edge: usize) -> Option<(u32, usize)> {
        let (_, _, [from, to]) =
            *self.half_edges.iter().find(|known| (known.0, known.1) == (number, edge))?;
        let same = |ends: [Vec3; 2]| ends == [from, to] || ends == [to, from];
        let others: Vec<_> =
            self.half_edges.iter().filter(|known| known.0 != number && same(known.2)).collect();
        if self.is_one_sided {
            return self.neighbor_of_one_sheet(number, &others, [to, from]);
        }
        let [(other, twin, ends)] = others[..] else { return None };
        (*ends == [to, from]).then_some((*other, *twin))
    }

    /// The same if a triangle and its back are in two sheets: the neighbour is the next triangle, or the back if there
    /// is none.
    fn neighbor_of_one_sheet(
        &self,
        number: u32,
        others: &[&HalfEdge],
        ends: [Vec3; 2],
    ) -> Option<(u32, usize)> {
        let sorted = |number: u32| {
            let mut places = self.places(number);
            places.sort_unstable();
            places
        };
        let (backs, beside): (Vec<&HalfEdge>, Vec<&HalfEdge>) =
            others.iter().copied().partition(|(other, ..)| sorted(*other) == sorted(number));
        let is_one_place = beside.iter().all(|(other, ..)| sorted(*other) == sorted(beside[0].0));
        let candidates = if beside.is_empty() { backs } else { beside };
        let opposed = candidates.iter().find(|known| known.2 == ends).filter(|_| is_one_place)?;
        Some((opposed.0, opposed.1))
    }

    fn normal(&self, number: u32) -> DVec3 {
        let [a, b, c] = self.corners(number).map(|corner| corner.as_dvec3());
        (b - a).normalize().cross((c - a).normalize()).normalize()
    }

    /// Whether an edge may matter in front, and behind.
    fn sight(&self, number: u32, edge: usize) -> [bool; 2] {
        let Some((sine, is_folded)) = self.bend(number, edge) else { return [true; 2] };
        let least = if is_folded { -FLAT } else { FLAT };
        [sine > least, -sine > least]
    }

    /// The sine of the bend at an edge, and whether it is folded back, from the direction from the edge to the opposite
    /// corner.
    fn bend(&self, number: u32, edge: usize) -> Option<(f64, bool)> {
        let (other, twin) = self.neighbor(number, edge)?;
        let corners = self.corners(number).map(|corner| corner.as_dvec3());
        let beyond = self.corners(other)[(twin + 2) % 3].as_dvec3();
        let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
        let along = (to - from).normalize();
        let away = |point: DVec3| {
            let arm = point - from;
            (arm - along * arm.dot(along)).normalize()
        };
        let sine = -away(beyond).dot(self.normal(number));
        Some((sine, away(beyond).dot(away(corners[(edge + 2) % 3])) > 0.0))
    }

    pub(super) fn prominent(&self, number: u32) -> Prominent {
        let mut prominent = Prominent::NONE;
        if !self.is_kept(number) {
            return prominent;
        }
        for edge in 0..3 {
            let is_low =
                |&(sine, is_folded): &(f64, bool)| !is_folded && (1e-14..=2e-4).contains(&sine.abs());
            if self.bend(number, edge).filter(is_low).is_some() {
                prominent = prominent.with_low_bend();
            }
            let corner = self.corners(number)[edge];
            let at_corner = self.half_edges.iter().filter(|(_, _, ends)| ends.contains(&corner));
            let at_corner: Vec<_> = at_corner.map(|&(other, edge, _)| self.sight(other, edge)).collect();
            for (side, is_front) in [(0, true), (1, false)] {
                if self.sight(number, edge)[side] {
                    prominent = prominent.with_edge(edge, is_front);
                }
                if at_corner.iter().any(|sight| sight[side]) {
                    prominent = prominent.with_corner(edge, is_front);
                }
            }
        }
        prominent
    }

    pub(super) fn patches(&self) -> Vec<u32> {
        let count = self.given.triangles.len();
        let mut patches: Vec<Option<u32>> = vec![None; count];
        for first in 0..count as u32 {
            if patches[first as usize].is_some() {
                continue;
            }
            let mut members = vec![first];
            let mut next = 0;
            while let Some(&member) = members.get(next) {
                next += 1;
                patches[member as usize] = Some(first);
                if !self.is_kept(member) {
                    continue;
                }
                let beyond = (0..3).filter_map(|edge| Some(self.neighbor(member, edge)?.0));
                let is_flat = |other: u32| (self.normal(other) - self.normal(first)).length() <= FLAT;
                let new: Vec<u32> =
                    beyond.filter(|&other| patches[other as usize].is_none() && is_flat(other)).collect();
                for other in new {
                    if !members.contains(&other) {
                        members.push(other);
                    }
                }
            }
        }
        patches.into_iter().flatten().collect()
    }
}
