//! The depth of a part over the sides of a triangle, by whichever of its faces are over them.
//!
//! Over a convex polygon, the point of a convex part that is furthest behind the polygon's plane is its lowest vertex,
//! or lies over a side. There two features cross as seen along the normal, and a direction is square to both:
//! ```text
//! an edge of the part over the side; a corner of the ground under a face
//! for a rounded part also: a vertex over the side; a corner under an edge, or under a vertex
//! ```
//! Any point of the part over a side bounds the depth there. So each pair of features is computed on its own, and the
//! deepest of all is on the surface.

use super::facet::edge_number;
use super::groups::{Base, Groups, Pin};
use super::prism::{Prism, STEEP};
use crate::feature::Feature;
use asunder_geometry::glam::DVec3;

/// Sine of the angle between two edges below which their crossing is ill-defined: the deepest point is at an end of
/// one.
const LEAST_SINE: f64 = 1e-9;

/// Share of an edge's length by which a point may be beyond its end: more than rounding, for edges that end there.
const SPARE: f64 = 1e-12;

/// Least distance between the deepest point and another that is as deep, as a share of the part's radius: nearer ones
/// belong to features that meet there.
const APART: f64 = 1e-3;

/// A corner or an edge: its start, and the vector to its end, which is zero for a corner.
#[derive(Clone, Copy)]
struct Line {
    from: DVec3,
    along: DVec3,
}

/// Where a rounded feature of the part is lowest over a feature of the ground: the fractions of their lengths, and the
/// unit direction out of the part.
struct Lowest {
    on_part: f64,
    on_ground: f64,
    out: DVec3,
}

impl Prism<'_> {
    /// Adds the deepest points of the part over those sides of the triangle where its flat patch ends, if they are
    /// within reach and deeper than what was found along its normal.
    pub(super) fn add_deepest_over_rim(&self, groups: &mut Groups) {
        let (ground, number, base) = (self.ground, self.facet.number, self.base());
        for edge in 0..3 {
            let beyond = ground.neighbor(number, edge);
            if beyond.is_none_or(|(other, _)| ground.patch(other) != ground.patch(number)) {
                self.add_deepest_over(edge, &base, groups);
            }
        }
    }

    /// The same over one side, whatever is behind it: the deepest point, and points as deep that are well apart from
    /// it.
    pub(super) fn add_deepest_over(&self, edge: usize, base: &Base, groups: &mut Groups) {
        let slack = self.standing.slack;
        let reach = self.reach.min(groups.least_along(base.normal) - slack);
        if !self.may_reach(edge, reach) {
            return;
        }
        let mut deepest: Option<Pin> = None;
        self.visit_over(edge, |pin| {
            if deepest.is_none_or(|deepest| pin.separation < deepest.separation) {
                deepest = Some(pin);
            }
        });
        let Some(deepest) = deepest.filter(|pin| pin.separation <= reach) else { return };
        groups.add(base, deepest);
        let apart = APART * self.standing.outer_radius;
        self.visit_over(edge, |pin| {
            let is_apart = (pin.on_body - deepest.on_body).length_squared() > apart * apart;
            if is_apart && pin.separation <= deepest.separation + slack {
                groups.add(base, pin);
            }
        });
    }

    /// Whether the part's separation over a side may be as little as `reach`: with the side moved by that along the
    /// normal, some of it is on the inner side of all faces that face down.
    fn may_reach(&self, edge: usize, reach: f64) -> bool {
        let (solid, normal) = (self.standing.solid, self.facet.normal);
        let (from, along) = self.facet.edge(edge);
        let from = from + normal * reach;
        let (mut enters, mut leaves) = (0.0, 1.0);
        for face in 0..solid.face_count() {
            let outwards = solid.normal(face);
            if outwards.dot(normal) > 0.0 {
                continue;
            }
            let over = solid.face_reach(face, outwards) + self.standing.radius + self.standing.slack;
            let (inside, change) = (over - outwards.dot(from), -outwards.dot(along));
            if inside < 0.0 && inside + change < 0.0 {
                return false;
            }
            if change > 0.0 && -inside > enters * change {
                enters = -inside / change;
            }
            if change < 0.0 && -inside > leaves * change {
                leaves = -inside / change;
            }
            if enters > leaves {
                return false;
            }
        }
        true
    }

    /// Visits points of the part over a side of the triangle, the deepest among them.
    fn visit_over(&self, edge: usize, mut visit: impl FnMut(Pin)) {
        let (solid, facet, is_round) = (self.standing.solid, self.facet, self.standing.radius > 0.0);
        let (from, along) = facet.edge(edge);
        let side = (Line { from, along }, Feature::Edge(edge_number(self.ground, facet.number, edge)));
        let numbers = self.ground.vertex_numbers(facet.number);
        let corners = [edge % 3, (edge + 1) % 3].map(|corner| {
            let line = Line { from: facet.corners[corner], along: DVec3::ZERO };
            (line, Feature::Vertex(numbers[corner]))
        });
        for (Line { from, .. }, of_ground) in corners {
            for face in 0..solid.face_count() {
                self.lowest_face(face, (from, of_ground)).into_iter().for_each(&mut visit);
            }
        }
        for &half_edge in solid.topology.edges() {
            let (start, stop) = solid.topology.ends(half_edge.into());
            let from = self.standing.point(start);
            let own = Line { from, along: self.standing.point(stop) - from };
            let of_body = Feature::Edge(half_edge.into());
            self.lowest_round((own, of_body), side).into_iter().for_each(&mut visit);
            for corner in corners.into_iter().filter(|_| is_round) {
                self.lowest_round((own, of_body), corner).into_iter().for_each(&mut visit);
            }
        }
        for vertex in (0..solid.vertices.len()).filter(|_| is_round) {
            let own = Line { from: self.standing.point(vertex), along: DVec3::ZERO };
            for of_ground in [side, corners[0], corners[1]] {
                let own = (own, Feature::Vertex(vertex as u32));
                self.lowest_round(own, of_ground).into_iter().for_each(&mut visit);
            }
        }
    }

    /// The point of a face over a corner of the ground.
    fn lowest_face(&self, face: usize, (corner, of_ground): (DVec3, Feature)) -> Option<Pin> {
        let (solid, normal) = (self.standing.solid, self.facet.normal);
        let outwards = solid.normal(face);
        let facing = outwards.dot(normal);
        if facing > -STEEP {
            return None;
        }
        let over = solid.face_reach(face, outwards) + self.standing.radius;
        let separation = (over - outwards.dot(corner)) / facing;
        let on_core = corner + normal * separation - outwards * self.standing.radius;
        let spare = SPARE * self.standing.outer_radius;
        let is_under = self.cuts(face).all(|cut| {
            let inside = cut.into.dot(on_core - cut.start);
            inside >= 0.0 || inside * inside <= spare * spare * cut.into.length_squared()
        });
        is_under.then(|| Pin {
            on_body: corner + normal * separation,
            on_ground: corner,
            separation,
            doubt: (self.doubt + self.standing.planarity + spare) / -facing,
            of_body: Feature::Face(face as u32),
            of_ground,
        })
    }

    /// The lowest point of an edge or vertex, rounded or not, over a side or a corner.
    fn lowest_round(&self, (own, of_body): (Line, Feature), (at, of_ground): (Line, Feature)) -> Option<Pin> {
        let normal = self.facet.normal;
        let Lowest { on_part, on_ground, out } = self.lowest_of(own, at)?;
        let is_on = |share: f64| (-SPARE..=1.0 + SPARE).contains(&share);
        let facing = out.dot(normal);
        if !(is_on(on_part) && is_on(on_ground) && facing <= -STEEP) {
            return None;
        }
        let on_body = own.from + own.along * on_part + out * self.standing.radius;
        let on_ground = at.from + at.along * on_ground;
        Some(Pin {
            on_body,
            on_ground,
            separation: normal.dot(on_body - on_ground),
            doubt: (self.doubt + SPARE * self.standing.outer_radius) / -facing,
            of_body,
            of_ground,
        })
    }

    /// Where they touch, if they do: with the ground's feature moved along the normal, the vector from the core to it
    /// is as long as the radius, and square to both features.
    fn lowest_of(&self, own: Line, at: Line) -> Option<Lowest> {
        let (normal, radius) = (self.facet.normal, self.standing.radius);
        let between = at.from - own.from;
        let (one, other) = (own.along.length_squared(), at.along.length_squared());
        if one > 0.0 && other > 0.0 {
            let across = own.along.cross(at.along);
            if across.length_squared() <= LEAST_SINE * LEAST_SINE * one * other {
                return None;
            }
            let across = across.normalize();
            let out = if across.dot(normal) > 0.0 { -across } else { across };
            let move_up = (radius - out.dot(between)) / out.dot(normal);
            let rest = between + normal * move_up - out * radius;
            // Square to one of the edges, and to the direction out.
            let (by_own, by_other) = (out.cross(own.along), out.cross(at.along));
            let on_part = rest.dot(by_other) / own.along.dot(by_other);
            let on_ground = -rest.dot(by_own) / at.along.dot(by_own);
            return Some(Lowest { on_part, on_ground, out });
        }
        // One of them is zero.
        let (along, square) = (own.along + at.along, one + other);
        let rejected = |way: DVec3| if square > 0.0 { way - along * (along.dot(way) / square) } else { way };
        let (aside, up) = (rejected(between), rejected(normal));
        let (steep, lean) = (up.length_squared(), aside.dot(up));
        let root = lean * lean - steep * (aside.length_squared() - radius * radius);
        if !(root > 0.0 && steep > 0.0) {
            return None;
        }
        let move_up = (-lean - root.sqrt()) / steep;
        let out = (aside + up * move_up) / radius;
        let rest = between + normal * move_up - out * radius;
        let share = |line: Line| if square > 0.0 { line.along.dot(rest) / square } else { 0.0 };
        Some(Lowest { on_part: share(own), on_ground: -share(at), out })
    }
}
