//! Contact points by a triangle's own normal: the body's lowest face against the prism over the triangle.
//!
//! ```text
//! the face that the body turns to the triangle, its corners moved out to the surface           (Incident)
//! corners of it in the prism:                          a vertex of the body on the face
//! each side of the triangle behind which the ground does not go on in the same plane,
//! cut by the sides of the body's face:                 its ends, or crossings of two edges
//! and under the rounds of that face's edges, if it is tilted
//! what is further up than wanted is left out
//! ```
//! These are the corners of what the body's face shares with the whole flat patch, and not with the triangle: a side
//! behind which the patch goes on makes no point. So a body on a floor stands on its own corners wherever the floor was
//! cut into triangles, the points keep their names while it slides, and no choice of four is asked for. Clipping face
//! against triangle and merging afterwards leaves a point on every cut, of which the choice of four is another one with
//! every step.

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

/// Cosine up to which a body's face looks away from the ground so much that it has no inside as seen along the normal.
pub(super) const STEEP: f64 = 1e-3;

/// Sine of the angle between a side and an edge below which they do not cross at a certain place.
const LEAST_SINE: f64 = 1e-6;

/// Sides of a face that are made once for all sides of a triangle.
const FEW_SIDES: usize = 16;

/// A side of a part's face: a corner, and the way inwards in the triangle's plane.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    pub(super) half_edge: usize,
    pub(super) start: DVec3,
    pub(super) into: DVec3,
}

/// A stretch of a side of a triangle: two shares of its length, each with the half-edge of the part's face that ends it
/// there.
pub(super) type Span = [(f64, Option<usize>); 2];

/// The face of a part that looks against a normal; kept, since neighbours most often have one normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incident {
    normal: DVec3,
    pub(super) face: usize,
    /// The direction out of the face in which the surface lies beyond the core, if any is across it.
    pub(super) outwards: Option<DVec3>,
}

/// What of a part stands over a triangle.
pub(super) struct Prism<'p> {
    pub(super) ground: Ground<'p>,
    pub(super) standing: &'p Standing<'p>,
    pub(super) facet: &'p Facet,
    pub(super) extent: &'p Extent,
    /// The widest gap in which a point is wanted, in metres.
    pub(super) reach: f64,
    /// What a separation may be off by, in metres.
    pub(super) doubt: f64,
    /// Points deeper than this are left out, and that is told, unless the part certainly holds what is over them.
    pub(super) gate: Option<(f64, &'p Cell<bool>)>,
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

    /// Whether it stands for a normal, too: one that is the same up to what f32 vertices leave of a plane.
    pub(super) fn is_for(&self, normal: DVec3) -> bool {
        (self.normal - normal).length_squared() <= 1e-14
    }
}

/// The face that [`opposed_face`] finds, of a cuboid: the most opposed of those that have all the furthest corners.
fn opposed_of_cuboid(normal: DVec3, cuboid: &Cuboid, slack: f64) -> usize {
    let (lean, half) = (normal.abs(), cuboid.half_extents().as_dvec3());
    // Of a face whose opposite is level with it up to the slack, the furthest corners are on both.
    let has_all = |axis: usize| 2.0 * half[axis] * lean[axis] > slack;
    let is_better = |axis: usize, than: usize| (has_all(axis), lean[axis]) > (has_all(than), lean[than]);
    let axis = (1..3).fold(0, |best, axis| if is_better(axis, best) { axis } else { best });
    // Faces are two an axis, the one that looks along it second.
    2 * axis + usize::from(normal[axis] < 0.0)
}

impl Prism<'_> {
    /// Adds contact points by the triangle's own normal; whether there are any.
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

    /// Adds points on those sides of the triangle behind which ground does not go on.
    fn add_sides(&self, (face, outwards): (usize, DVec3), base: &Base, groups: &mut Groups) -> bool {
        let (standing, facet) = (self.standing, self.facet);
        let facing = outwards.dot(facet.normal);
        let vertices = standing.solid.topology.face_vertices(face);
        let (Some(first), true) = (vertices.clone().next(), facing <= -STEEP) else { return false };
        let over = standing.point(first) + outwards * standing.radius;
        let [a, b, c] = facet.corners;
        // Of a side, all is beyond reach if both its ends are: by more than rounding, for what is between them.
        let beyond = self.reach + (self.doubt + standing.planarity) / -facing;
        let is_far = |corner: DVec3| outwards.dot(over - corner) / facing > beyond;
        let far = [is_far(a), is_far(b), is_far(c)];
        let is_end = |edge: usize| !(far[edge] && far[(edge + 1) % 3] || facet.goes_on(self.ground, edge));
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
        // What the round of an edge reaches further than the face's plane where a side passes from under it; more is
        // told.
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

    /// The sides of a face of the part, as they cut lines in the triangle's plane.
    pub(super) fn cuts(&self, face: usize) -> impl Iterator<Item = Cut> + '_ {
        let (standing, topology) = (self.standing, self.standing.solid.topology);
        let first = topology.face_vertices(face).next();
        let mut from = first.map_or(standing.center, |vertex| standing.point(vertex));
        topology.face_half_edges(face).map(move |half_edge| {
            // A side starts where the one before stops.
            let (start, stop) = (from, standing.point(topology.ends(half_edge).1));
            from = stop;
            // A face goes counter-clockwise as seen from outside, which is against the normal.
            Cut { half_edge, start, into: (stop - start).cross(self.facet.normal) }
        })
    }

    /// Adds points where a side of the triangle passes under the round of an edge of a face that is tilted: there the
    /// surface is the round, and the face's plane lies beside it. So a rounded crate stands on a strip of ground that
    /// its edge leads over from side to side.
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
            // What is all but parallel crosses anywhere; what is not a number, nowhere.
            let do_cross =
                change * change > LEAST_SINE * LEAST_SINE * into.length_squared() * along.length_squared();
            if !(do_cross && (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&place)) {
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

    /// Where the round of an edge reaches furthest against the normal: a unit direction across the edge, if it lies
    /// between the faces beside it.
    fn out_of_round(&self, half_edge: usize, run: DVec3) -> Option<DVec3> {
        let (solid, normal) = (self.standing.solid, self.facet.normal);
        let out = (run * (normal.dot(run) / run.length_squared()) - normal).try_normalize()?;
        let half_edges = solid.topology.half_edges();
        let twin = usize::from(half_edges[half_edge].twin);
        // Across each face, away from the edge.
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

    /// The lowest point of the part over the triangle's plane, wherever that is.
    pub(super) fn lowest(&self) -> Pin {
        let vertex = self.extent.lowest;
        let at = self.standing.point(vertex) - self.facet.normal * self.standing.radius;
        self.pin(at, self.extent.low - self.standing.radius, Feature::Vertex(vertex as u32))
    }

    /// Whether that is over the triangle.
    pub(super) fn is_lowest_over(&self) -> bool {
        self.facet.is_over(self.standing.point(self.extent.lowest), self.standing.slack)
    }

    /// Whether the part certainly shares a point with the triangle: a vertex of the core that is nearer to the
    /// triangle's inside than the radius, or one on either side whose segment crosses the inside.
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
        // What heights are off by moves the crossing along a segment that is nearly level by far more.
        let spread = way.length() / (high - low);
        is_inside(from + way * share, 2.0 * doubt * (1.0 + spread))
    }

    fn pin(&self, on_body: DVec3, separation: f64, of_body: Feature) -> Pin {
        let on_ground = on_body - self.facet.normal * separation;
        let of_ground = Feature::Face(self.ground.patch(self.facet.number));
        Pin { on_body, on_ground, separation, doubt: self.doubt, of_body, of_ground }
    }

    /// Adds the vertices of the part's face that are over the triangle, and the lowest of all.
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

    /// Adds a vertex of the part, moved out, if it is over the triangle.
    fn add_if_over(
        &self,
        (vertex, (at, separation, up)): (usize, (DVec3, f64, f64)),
        rims: &[Rim; 3],
        base: &Base,
        groups: &mut Groups,
    ) -> bool {
        // Above a bend that is too low to give a normal what is nearest may be beside both its triangles, the further
        // the higher it is.
        let up = up.max(0.0);
        let is_over = |edge: usize| {
            let rim: &Rim = &rims[edge];
            rim.holds(at) || rim.holds_by(at, FLAT * up) && self.facet.goes_on(self.ground, edge)
        };
        if !(is_over(0) && is_over(1) && is_over(2)) {
            return false;
        }
        let mut pin = self.pin(at, separation, Feature::Vertex(vertex as u32));
        if rims[0].is_beyond(at) || rims[1].is_beyond(at) || rims[2].is_beyond(at) {
            pin.doubt += self.overhang(&pin, up);
        }
        self.add_pin(pin, base, groups)
    }

    /// Where the surface is that a vertex rounds, its separation, and the height of what it is measured from: the
    /// vertex where it is as deep as any; else the surface, which belongs to a tilted face, and lies out along its
    /// normal.
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

    /// By how much a point's height may differ from its distance, in metres, whose foot is outside the triangle by no
    /// more than the slack. `up` is the height of the point, or of the vertex that it rounds; at 0 that is the whole
    /// way to the triangle.
    fn overhang(&self, pin: &Pin, up: f64) -> f64 {
        let aside = (pin.on_ground - nearest_to(self.facet, pin.on_ground).1).length();
        (up * up + aside * aside).sqrt() - up
    }

    /// Adds the ends of the span that the part's face covers of a side of the triangle, as seen along the normal;
    /// `over` is a point of the surface beyond the face, and rounds reach so many metres further.
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

    /// What a point on an edge of the triangle is named after, at a share of its length where a half-edge of the part's
    /// face passes over it, or at its nearer end.
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

    /// Adds a point that the gate lets through; whether it did.
    fn add_pin(&self, pin: Pin, base: &Base, groups: &mut Groups) -> bool {
        if let Some((least, is_left_out)) = self.gate
            && pin.separation < least
            && !(matches!(self.standing.part.shape, Shape3::Cuboid(_))
                && self.standing.is_in_box(pin.on_ground, self.doubt))
        {
            is_left_out.set(true);
            return false;
        }
        groups.add(base, pin);
        true
    }

    /// The stretch of a side that lies over the part's face, which has these sides.
    fn span(&self, cuts: impl Iterator<Item = Cut>, outwards: DVec3, edge: usize) -> Option<Span> {
        let (from, along) = self.facet.edge(edge);
        within(cuts, outwards * self.standing.radius, (from, along))
    }

    /// The same under a segment: where it passes over the side, if it does. The same end twice, since it is one point.
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
        (0.0..=1.0).contains(&share).then_some([(share, Some(0)); 2])
    }
}

/// The stretch of a line that is on the inner side of all cuts, once these are shifted.
///
/// Cyrus and Beck, "Generalized two- and three-dimensional clipping" (1978).
#[inline]
pub(super) fn within(
    cuts: impl Iterator<Item = Cut>,
    shift: DVec3,
    (from, along): (DVec3, DVec3),
) -> Option<Span> {
    let (mut enters, mut leaves) = ((0.0, None), (1.0, None));
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
