//! Contact points along a triangle's normal: the part's incident face against the prism over the triangle.
//!
//! ```text
//! incident face of the part, its vertices moved out to the rounded surface                                  (Incident)
//! vertices of that face in the prism:                             a vertex of the part on the ground's face
//! each side of the triangle behind which the ground does not continue in the same plane,
//! clipped by the sides of the incident face:                      its ends, or crossings of two edges
//! and crossings under the rounded edges of that face, if it is tilted
//! points across a gap wider than the reach are left out
//! ```
//! These are the corners of what the incident face shares with the whole flat patch, not with the triangle: a side
//! behind which the patch continues makes no point. So a body on a floor stands on its own vertices however the floor
//! was triangulated, the points keep their feature ids while it slides, and no choice of four is needed. Clipping face
//! against triangle and merging afterwards would leave a point on every cut, and which four are chosen would change
//! with every step.

use super::ball::nearest_to;
use super::facet::{Facet, edge_number};
use super::groups::{Base, Groups, Pin};
use super::side::Rim;
use super::standing::{Extent, Standing};
use crate::feature::Feature;
use crate::polyhedron::manifold::opposed_face;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::FLAT;
use asunder_geometry::{Cuboid, Ground, Shape3};
use core::cell::Cell;

/// Least cosine between a face's outward normal and the reversed triangle's normal: steeper faces have no inside as
/// seen along the triangle's normal.
pub(super) const STEEP: f64 = 1e-3;

/// Sine of the angle between a side and an edge below which their crossing is ill-defined.
const LEAST_SINE: f64 = 1e-6;

/// Most sides of a face that are computed once for all sides of a triangle.
const FEW_SIDES: usize = 16;

/// A side of a part's face as a clip line: a vertex, and the direction inwards in the triangle's plane.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    pub(super) half_edge: usize,
    pub(super) start: DVec3,
    pub(super) into: DVec3,
}

/// An interval of a triangle's side: two fractions of its length, each with the half-edge of the part's face that clips
/// it there.
pub(super) type Span = [(f64, Option<usize>); 2];

/// The incident face of a part for a normal; cached, since neighbouring triangles most often share a normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incident {
    normal: DVec3,
    pub(super) face: usize,
    /// The unit direction from the core's face to the surface; for a segment the one across it. `None` for a point, and
    /// for a segment nearly along the normal.
    pub(super) outwards: Option<DVec3>,
}

/// A part over a triangle.
pub(super) struct Prism<'p> {
    pub(super) ground: Ground<'p>,
    pub(super) standing: &'p Standing<'p>,
    pub(super) facet: &'p Facet,
    pub(super) extent: &'p Extent,
    /// The widest gap in which a point is wanted, in metres.
    pub(super) reach: f64,
    /// Error bound of a separation, in metres.
    pub(super) doubt: f64,
    /// Points deeper than this are left out, and the flag is set, unless the part certainly contains the ground under
    /// them.
    pub(super) gate: Option<(f64, &'p Cell<bool>)>,
    /// Where only points beyond the triangle are wanted, the sides beyond which it counts as going on: see `ahead`.
    pub(super) ahead: Option<[bool; 3]>,
}

impl Incident {
    pub(super) fn of(standing: &Standing, normal: DVec3) -> Self {
        let face = match standing.part.shape {
            Shape3::Cuboid(cuboid) => {
                opposed_of_cuboid(standing.place.axes.turn_back(normal), cuboid, standing.slack)
            }
            _ => opposed_face(standing.solid, normal, standing.slack).face,
        };
        Self { normal, face, outwards: standing.solid.outwards(face, -normal) }
    }

    /// Whether it is also the incident face for another normal: one that differs by no more than the rounding of f32
    /// vertices.
    pub(super) fn is_for(&self, normal: DVec3) -> bool {
        (self.normal - normal).length_squared() <= 1e-14
    }
}

/// The face that [`opposed_face`] finds, for a cuboid: the most opposed of those that have all the furthest vertices.
fn opposed_of_cuboid(normal: DVec3, cuboid: &Cuboid, slack: f64) -> usize {
    let (lean, half) = (normal.abs(), cuboid.half_extents().as_dvec3());
    // Where a face and its opposite are level within the slack, the furthest vertices are on both.
    let has_all = |axis: usize| 2.0 * half[axis] * lean[axis] > slack;
    let is_better = |axis: usize, than: usize| (has_all(axis), lean[axis]) > (has_all(than), lean[than]);
    let axis = (1..3).fold(0, |best, axis| if is_better(axis, best) { axis } else { best });
    // Two faces per axis: the one that faces along it comes second.
    2 * axis + usize::from(normal[axis] < 0.0)
}

impl Prism<'_> {
    /// Adds contact points along the triangle's normal; returns whether there are any.
    pub(super) fn add_points(&self, incident: &Incident, groups: &mut Groups) -> bool {
        let base = self.base();
        let mut is_any = self.add_corners(incident, &base, groups);
        if let Some(outwards) = incident.outwards
            && self.standing.solid.vertices.len() > 1
        {
            is_any |= self.add_sides((incident.face, outwards), &base, groups);
        }
        is_any
    }

    /// Adds points on those sides of the triangle behind which the ground does not continue in the same plane.
    fn add_sides(&self, (face, outwards): (usize, DVec3), base: &Base, groups: &mut Groups) -> bool {
        let (standing, facet) = (self.standing, self.facet);
        let facing = outwards.dot(facet.normal);
        let vertices = standing.solid.topology.face_vertices(face);
        let (Some(first), true) = (vertices.clone().next(), facing <= -STEEP) else { return false };
        let over = standing.point(first) + outwards * standing.radius;
        let [a, b, c] = facet.corners;
        // All of a side is beyond reach if both its ends are: by more than rounding, to cover the points between them.
        let beyond = self.reach + (self.doubt + standing.planarity) / -facing;
        let is_far = |corner: DVec3| outwards.dot(over - corner) / facing > beyond;
        let far = [is_far(a), is_far(b), is_far(c)];
        // A side that reaches beyond its corners may do so towards the part.
        let is_far = |edge: usize| far[edge] && far[(edge + 1) % 3] && self.ahead.is_none();
        let is_end =
            |edge: usize| !(self.goes_on_beyond(edge) || is_far(edge) || facet.goes_on(self.ground, edge));
        let ends = [is_end(0), is_end(1), is_end(2)];
        if ends == [false; 3] {
            return false;
        }
        let mut cuts: ArrayVec<Cut, FEW_SIDES> = ArrayVec::new_const();
        if !standing.solid.is_slender() && vertices.len() <= FEW_SIDES {
            cuts.extend(self.cuts(face));
        }
        let aside = outwards - facet.normal * facing;
        let is_tilted = standing.radius > 0.0 && aside.length() * standing.radius > standing.slack;
        // By how much a rounded edge reaches further than the face's plane where a side passes out from under it; it
        // goes into the error. Where the face is tilted, such places get points instead.
        let rounded = if is_tilted { 0.0 } else { standing.radius * (1.0 / -facing - 1.0) };
        let mut is_any = false;
        for edge in (0..3).filter(|&edge| ends[edge]) {
            if is_tilted && !standing.solid.is_slender() {
                is_any |= self.add_under_rounds((face, edge), base, groups);
            }
            let span = match (standing.solid.is_slender(), cuts.is_empty()) {
                (true, _) => self.span_of_slender(outwards, edge),
                (_, false) => self.span(cuts.iter().copied(), outwards, edge),
                _ => self.span(self.cuts(face), outwards, edge),
            };
            if let Some(span) = span {
                is_any |= self.add_side((face, edge), (span, outwards, over, rounded), base, groups);
            }
        }
        is_any
    }

    /// The sides of a face of the part, as clip lines in the triangle's plane.
    pub(super) fn cuts(&self, face: usize) -> impl Iterator<Item = Cut> + '_ {
        let (standing, topology) = (self.standing, self.standing.solid.topology);
        let first = topology.face_vertices(face).next();
        let mut from = first.map_or(standing.center, |vertex| standing.point(vertex));
        topology.face_half_edges(face).map(move |half_edge| {
            // Each side starts where the previous one ends.
            let (start, stop) = (from, standing.point(topology.ends(half_edge).1));
            from = stop;
            // A face goes counter-clockwise as seen from outside, so about the reversed normal.
            Cut { half_edge, start, into: (stop - start).cross(self.facet.normal) }
        })
    }

    /// Adds points where a side of the triangle passes under a rounded edge of a tilted face: there the surface is the
    /// edge's cylinder, and the face's plane lies beside it. So a rounded crate can stand on a strip of ground that its
    /// edge crosses from side to side.
    fn add_under_rounds(&self, (face, edge): (usize, usize), base: &Base, groups: &mut Groups) -> bool {
        let (standing, facet) = (self.standing, self.facet);
        let (from, along) = facet.edge(edge);
        let mut is_any = false;
        for Cut { half_edge, start, into } in self.cuts(face) {
            let run = standing.point(standing.solid.topology.ends(half_edge).1) - start;
            let Some(out) = self.out_of_round(half_edge, run) else { continue };
            let begin = start + out * standing.radius;
            let change = into.dot(along);
            let on_ground = from + along * (-into.dot(from - begin) / change);
            let level = run - facet.normal * facet.normal.dot(run);
            let place = level.dot(on_ground - begin) / level.length_squared();
            let share = along.dot(on_ground - from) / along.length_squared();
            // Nearly parallel lines cross at no certain place; NaN fails the test.
            let do_cross =
                change * change > LEAST_SINE * LEAST_SINE * into.length_squared() * along.length_squared();
            let [low, high] = self.stretch_of(edge);
            if !(do_cross && (low..=high).contains(&share) && (0.0..=1.0).contains(&place)) {
                continue;
            }
            let on_body = begin + run * place;
            let separation = facet.height(on_body);
            if separation <= self.reach {
                let of_body = Feature::Edge(standing.solid.topology.edge_of(half_edge) as u32);
                let of_ground = Feature::Edge(edge_number(self.ground, facet.number, edge));
                let doubt = self.doubt;
                is_any |= self.add_pin(
                    Pin { on_body, on_ground, separation, doubt, of_body, of_ground },
                    base,
                    groups,
                );
            }
        }
        is_any
    }

    /// Where a rounded edge reaches furthest against the normal: a unit direction square to the edge, if it lies
    /// between the normals of the two faces beside it.
    fn out_of_round(&self, half_edge: usize, run: DVec3) -> Option<DVec3> {
        let (solid, normal) = (self.standing.solid, self.facet.normal);
        let out = (run * (normal.dot(run) / run.length_squared()) - normal).try_normalize()?;
        let half_edges = solid.topology.half_edges();
        let twin = usize::from(half_edges[half_edge].twin);
        // In each face, away from the edge.
        let into =
            |half_edge: usize, run: DVec3| solid.normal(half_edges[half_edge].face as usize).cross(run);
        let slack = 1e-9 * run.abs().element_sum();
        let is_between = out.dot(into(half_edge, run)) <= slack && out.dot(into(twin, -run)) <= slack;
        is_between.then_some(out)
    }

    pub(super) fn base(&self) -> Base {
        let Facet { number, normal, .. } = *self.facet;
        let behind = self.extent.low - self.standing.radius;
        Base { normal, patch: self.ground.patch(number), weight: self.facet.area(), behind }
    }

    /// The part's lowest point over the triangle's plane, inside the prism or not.
    pub(super) fn lowest(&self) -> Pin {
        let vertex = self.extent.lowest;
        let at = self.standing.point(vertex) - self.facet.normal * self.standing.radius;
        self.pin(at, self.extent.low - self.standing.radius, Feature::Vertex(vertex as u32))
    }

    /// Whether that point is over the triangle.
    pub(super) fn is_lowest_over(&self) -> bool {
        self.facet.is_over(self.standing.point(self.extent.lowest), self.standing.slack)
    }

    /// Whether the part certainly shares a point with the triangle: its lowest core vertex is above the triangle's
    /// interior and nearer than the radius, or the segment between its lowest and highest vertex crosses the interior.
    pub(super) fn does_cross(&self) -> bool {
        let Self { standing, facet, extent: &Extent { low, lowest, high, highest }, doubt, .. } = *self;
        let from = standing.point(lowest);
        let is_inside = |point: DVec3, beyond: f64| facet.inside(point, |_| true) > beyond;
        if low >= 0.0 {
            return low < standing.radius - doubt && is_inside(from, 2.0 * doubt);
        }
        if low >= -doubt || high <= doubt {
            return false;
        }
        let (share, way) = (low / (low - high), standing.point(highest) - from);
        // An error in the heights moves the crossing much further where the segment is nearly level.
        let spread = way.length() / (high - low);
        is_inside(from + way * share, 2.0 * doubt * (1.0 + spread))
    }

    fn pin(&self, on_body: DVec3, separation: f64, of_body: Feature) -> Pin {
        let on_ground = on_body - self.facet.normal * separation;
        let of_ground = Feature::Face(self.ground.patch(self.facet.number));
        Pin { on_body, on_ground, separation, doubt: self.doubt, of_body, of_ground }
    }

    /// Adds the vertices of the incident face that are over the triangle, and the lowest vertex of the part.
    fn add_corners(&self, incident: &Incident, base: &Base, groups: &mut Groups) -> bool {
        let (standing, facet) = (self.standing, self.facet);
        let rims = [facet.rim(0, standing.slack), facet.rim(1, standing.slack), facet.rim(2, standing.slack)];
        let (mut is_any, mut has_lowest) = (false, false);
        for vertex in standing.solid.topology.face_vertices(incident.face) {
            is_any |= self.add_corner(vertex, (incident, &rims), base, groups);
            has_lowest |= vertex == self.extent.lowest;
        }
        if !has_lowest {
            is_any |= self.add_corner(self.extent.lowest, (incident, &rims), base, groups);
        }
        is_any
    }

    #[inline(always)]
    fn add_corner(
        &self,
        vertex: usize,
        (incident, rims): (&Incident, &[Rim; 3]),
        base: &Base,
        groups: &mut Groups,
    ) -> bool {
        match self.moved_out(vertex, incident) {
            Some(out) if out.1 <= self.reach => self.add_if_over((vertex, out), rims, base, groups),
            _ => false,
        }
    }

    /// Adds a vertex of the part, already moved out to the surface, if it is over the triangle.
    fn add_if_over(
        &self,
        (vertex, (at, separation, up)): (usize, (DVec3, f64, f64)),
        rims: &[Rim; 3],
        base: &Base,
        groups: &mut Groups,
    ) -> bool {
        // Above a bend too low to give a normal, the nearest vertex may lie beside both its triangles, and the further
        // the higher it is.
        let up = up.max(0.0);
        let is_over = |edge: usize| {
            let rim: &Rim = &rims[edge];
            rim.holds(at) || rim.holds_by(at, FLAT * up) && self.facet.goes_on(self.ground, edge)
        };
        if self.ahead.is_none() && !(is_over(0) && is_over(1) && is_over(2)) {
            return false;
        }
        let mut pin = self.pin(at, separation, Feature::Vertex(vertex as u32));
        if self.ahead.is_none() && (rims[0].is_beyond(at) || rims[1].is_beyond(at) || rims[2].is_beyond(at)) {
            pin.doubt += self.overhang(&pin, up);
        }
        self.add_pin(pin, base, groups)
    }

    /// The surface point for a vertex, its separation, and the height that this is measured from. A vertex as deep as
    /// any other is moved out against the triangle's normal, and the height is the vertex's. Otherwise the surface
    /// belongs to a tilted face: it is moved out along that face's normal, and the height is the surface point's.
    #[inline]
    fn moved_out(&self, vertex: usize, incident: &Incident) -> Option<(DVec3, f64, f64)> {
        let (standing, facet) = (self.standing, self.facet);
        let core = standing.point(vertex);
        let height = facet.height(core);
        if height <= self.extent.low + standing.slack {
            return Some((core - facet.normal * standing.radius, height - standing.radius, height));
        }
        let at = core + incident.outwards? * standing.radius;
        let separation = facet.height(at);
        Some((at, separation, separation))
    }

    /// By how much a point's height may differ from its distance, in metres, where its foot lies outside the triangle
    /// by no more than the slack. `up` is the height of the point, or of the vertex that it was moved out from; at 0
    /// the difference is the whole distance to the triangle.
    fn overhang(&self, pin: &Pin, up: f64) -> f64 {
        let aside = (pin.on_ground - nearest_to(self.facet, pin.on_ground).1).length();
        (up * up + aside * aside).sqrt() - up
    }

    /// Adds the ends of the span of the triangle's side that the part's face covers, as seen along the normal; `over`
    /// is a point of the surface beyond the face, and rounded edges reach `rounded` metres further.
    fn add_side(
        &self,
        (face, edge): (usize, usize),
        (span, outwards, over, rounded): (Span, DVec3, DVec3, f64),
        base: &Base,
        groups: &mut Groups,
    ) -> bool {
        let (standing, facet) = (self.standing, self.facet);
        let facing = outwards.dot(facet.normal);
        let (from, along) = facet.edge(edge);
        let mut is_any = false;
        for (share, by) in span {
            let on_ground = from + along * share;
            let separation = outwards.dot(over - on_ground) / facing;
            if separation > self.reach {
                continue;
            }
            let (of_body, of_ground) = self.names_on_edge(face, edge, (share, by));
            let on_body = on_ground + facet.normal * separation;
            let doubt = (self.doubt + standing.planarity) / -facing + rounded;
            is_any |=
                self.add_pin(Pin { on_body, on_ground, separation, doubt, of_body, of_ground }, base, groups);
        }
        is_any
    }

    /// The feature ids of a point on an edge of the triangle, at a fraction of its length: of both edges where a
    /// half-edge of the part's face clips it there, else of the face and the nearer corner.
    pub(super) fn names_on_edge(
        &self,
        face: usize,
        edge: usize,
        (share, by): (f64, Option<usize>),
    ) -> (Feature, Feature) {
        if let Some(half_edge) = by {
            let own = self.standing.solid.topology.edge_of(half_edge) as u32;
            let number = edge_number(self.ground, self.facet.number, edge);
            return (Feature::Edge(own), Feature::Edge(number));
        }
        let corner = if share > 0.5 { edge + 1 } else { edge };
        let numbers = self.ground.vertex_numbers(self.facet.number);
        (Feature::Face(face as u32), Feature::Vertex(numbers[corner % 3]))
    }

    /// Adds a point unless the gate leaves it out; returns whether it did.
    fn add_pin(&self, pin: Pin, base: &Base, groups: &mut Groups) -> bool {
        if let Some((least, is_left_out)) = self.gate
            && pin.separation < least
            && !(matches!(self.standing.part.shape, Shape3::Cuboid(_))
                && self.standing.is_in_box(pin.on_ground, self.doubt))
        {
            is_left_out.set(true);
            return false;
        }
        if !self.is_wanted(&pin) {
            return false;
        }
        groups.add(base, pin);
        true
    }

    /// The interval of a side that lies over the part's face, which has these sides.
    fn span(&self, cuts: impl Iterator<Item = Cut>, outwards: DVec3, edge: usize) -> Option<Span> {
        let (from, along) = self.facet.edge(edge);
        within(cuts, outwards * self.standing.radius, (from, along), self.stretch_of(edge))
    }

    /// The same for a segment (the core of a capsule): where it crosses the side, if it does. Both ends are this one
    /// point.
    fn span_of_slender(&self, outwards: DVec3, edge: usize) -> Option<Span> {
        let (standing, facet) = (self.standing, self.facet);
        let (from, along) = facet.edge(edge);
        let shift = outwards * standing.radius;
        let last = standing.solid.vertices.len() - 1;
        let (begin, end) = (standing.point(0) + shift, standing.point(last) + shift);
        let inwards = facet.inwards(along);
        let (out, over) = (inwards.dot(begin - from), inwards.dot(end - from));
        if (out < 0.0) == (over < 0.0) {
            return None;
        }
        let crossing = begin + (end - begin) * (out / (out - over));
        let share = along.dot(crossing - from) / along.length_squared();
        let [low, high] = self.stretch_of(edge);
        (low..=high).contains(&share).then_some([(share, Some(0)); 2])
    }
}

/// The interval of a line, between two fractions of its length, that is on the inner side of all cuts, once these are
/// shifted.
///
/// Cyrus and Beck, "Generalized two- and three-dimensional clipping" (1978).
#[inline]
pub(super) fn within(
    cuts: impl Iterator<Item = Cut>,
    shift: DVec3,
    (from, along): (DVec3, DVec3),
    [low, high]: [f64; 2],
) -> Option<Span> {
    let (mut enters, mut leaves) = ((low, None), (high, None));
    for Cut { half_edge, start, into } in cuts {
        let (inside, change) = (into.dot(from - start - shift), into.dot(along));
        if change == 0.0 {
            if inside < 0.0 {
                return None;
            }
            continue;
        }
        let share = -inside / change;
        let is_nearer = if change > 0.0 { share > enters.0 } else { share < leaves.0 };
        if is_nearer {
            let end = if change > 0.0 { &mut enters } else { &mut leaves };
            *end = (share, Some(half_edge));
            if enters.0 > leaves.0 {
                return None;
            }
        }
    }
    Some([enters, leaves])
}
