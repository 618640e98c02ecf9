//! The patch that two faces share, and at most four points of it.
//!
//! ```text
//! cut the incident face by the sides of the reference face                        (clip)
//! corners no higher than wanted become spots; of neighbours in one place, one
//! reduce to four                                                                  (reduce)
//! back to space, and out to the surfaces
//! ```
//! All of it is done with the shapes' cores. What is deepest is moved out along the normal; a corner of a tilted face
//! that is less deep, along that face's own normal, since the shape's surface beyond it looks that way.

use super::super::reduce::{Spot, pick_four};
use super::super::solid::Solid;
use super::clip::{Corner, Name, Polygon, Side};
use super::frame::Frame;
use super::near::{LiesOn, Rim};
use super::{Depths, Point, Points};
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;

/// The most corners that are made: those of the incident face, two for each side of the reference face, and eight where
/// a box cuts what is left.
const MAX_CORNERS: usize = 3 * MAX_HULL_VERTICES + BY_BOX;

/// Corners that a box makes: two for each of its sides.
const BY_BOX: usize = 8;

/// As many are made in little memory.
const FEW_CORNERS: usize = 32 + BY_BOX;

/// A face of each shape.
#[derive(Clone, Copy)]
pub(super) struct Faces<'a> {
    /// The shape whose face is measured from, and the face.
    pub(super) reference: (&'a Solid<'a>, usize),
    /// The shape whose face is cut, and the face.
    pub(super) incident: (&'a Solid<'a>, usize),
    /// Whether the reference shape is B.
    pub(super) is_b: bool,
}

impl<'a> Faces<'a> {
    /// Adds contacts at corners of what both faces share as seen along the frame's direction, in order of their ids;
    /// whether any corner is as deep as any, of those that were kept or not.
    pub(super) fn add_points(&self, frame: &Frame, depths: &Depths, points: &mut Points) -> bool {
        let corners =
            |(solid, face): (&Solid, usize)| ExactSizeIterator::len(&solid.topology.face_half_edges(face));
        if 2 * corners(self.reference) + corners(self.incident) + BY_BOX <= FEW_CORNERS {
            self.add::<FEW_CORNERS>(frame, depths, points)
        } else {
            self.add_of_many(frame, depths, points)
        }
    }

    /// Apart, so that those with few corners never touch the memory of those with many.
    #[inline(never)]
    fn add_of_many(&self, frame: &Frame, depths: &Depths, points: &mut Points) -> bool {
        self.add::<MAX_CORNERS>(frame, depths, points)
    }

    fn add<const N: usize>(&self, frame: &Frame, depths: &Depths, points: &mut Points) -> bool {
        let [radius, incident_radius] = self.radii();
        let is_sharp = radius + incident_radius == 0.0;
        let mut polygon = Polygon::<N>::new();
        let mut spots = Spots::<N>::new(depths);
        let mut places = ArrayVec::new_const();
        self.clip(frame, [DVec3::ZERO; 2], depths.slack, (&mut polygon, &mut places));
        let (mut is_whole, mut last) = (is_sharp || polygon.corners().len() > 0, None);
        for corner in polygon.corners() {
            if is_sharp || corner.height <= depths.deep {
                let separation = corner.height - radius - incident_radius;
                spots.offer(corner, corner.height - incident_radius, separation, &mut last);
            } else {
                is_whole = false;
            }
        }
        spots.close(0);
        // What is less deep belongs to a tilted face, and lies out along its normal; there the corners are cut again.
        if !is_whole && let Some(moved) = self.outwards(frame) {
            self.add_higher(frame, moved, (&mut polygon, &mut places), &mut spots);
        }
        self.add_kept(frame, &spots.list, (&polygon, &places), depths, points);
        spots.list.iter().any(|spot| spot.spot.separation <= depths.least)
    }

    fn radii(&self) -> [f64; 2] {
        [self.reference.0.radius, self.incident.0.radius]
    }

    /// From the cores' faces to the surfaces beyond them; nothing where the incident one has no direction of its own.
    fn outwards(&self, frame: &Frame) -> Option<[DVec3; 2]> {
        let (incident, face) = self.incident;
        let [radius, incident_radius] = self.radii();
        let outwards = incident.outwards(face, -frame.along)?;
        Some([frame.facing() * radius, outwards * incident_radius])
    }

    /// Spots of the faces of the surfaces, where those of the cores left none.
    fn add_higher<const N: usize>(
        &self,
        frame: &Frame,
        moved: [DVec3; 2],
        (polygon, places): (&mut Polygon<N>, &mut ArrayVec<[f64; 2], N>),
        spots: &mut Spots<'_, N>,
    ) {
        let [radius, _] = self.radii();
        // How far over the core's plane the surface lies along the frame's direction.
        let rise = radius * frame.lift(frame.facing());
        let (slack, first) = (spots.depths.slack, spots.list.len());
        let mut last = None;
        self.clip(frame, moved, slack, (polygon, places));
        for corner in polygon.corners() {
            let is_known = spots.list[..first]
                .iter()
                .any(|known| known.name == corner.name || is_near(known.spot.at, corner.at, slack));
            if !is_known {
                spots.offer(corner, corner.height, corner.height - rise, &mut last);
            }
        }
        spots.close(first);
        if first > 0 && spots.list.len() > 4 {
            put_around(&mut spots.list);
        }
    }

    /// The incident face cut by the sides of the reference face, both moved first; and where the vertices of the latter
    /// are seen.
    fn clip<const N: usize>(
        &self,
        frame: &Frame,
        moved: [DVec3; 2],
        slack: f64,
        (polygon, places): (&mut Polygon<N>, &mut ArrayVec<[f64; 2], N>),
    ) {
        let ((reference, face), (incident, incident_face)) = (self.reference, self.incident);
        polygon.clear();
        for half_edge in incident.topology.face_half_edges(incident_face) {
            let vertex = incident.topology.half_edges()[half_edge].origin;
            let point = in_frame(incident, !self.is_b, vertex.into()) + moved[1];
            polygon.add_vertex(half_edge as u16, frame.place(point));
        }
        let half_edges = reference.topology.face_half_edges(face);
        places.clear();
        for half_edge in half_edges.clone() {
            let vertex = reference.topology.half_edges()[half_edge].origin;
            let _ = places.try_push(frame.shift_of(in_frame(reference, self.is_b, vertex.into()) + moved[0]));
        }
        let (first, last) = (half_edges.start as u16, half_edges.end as u16 - 1);
        for (half_edge, (i, &from)) in (first..=last).zip(places.iter().enumerate()) {
            let before = if half_edge == first { last } else { half_edge - 1 };
            let after = if half_edge == last { first } else { half_edge + 1 };
            let to = places[if half_edge == last { 0 } else { i + 1 }];
            polygon.cut(&Side { from, to, half_edge, before, after }, slack);
        }
        polygon.cut_tips(places, first, slack);
    }

    /// At most four of the spots as contacts, in order of their ids.
    fn add_kept<const N: usize>(
        &self,
        frame: &Frame,
        spots: &[NamedSpot],
        (polygon, places): (&Polygon<N>, &[[f64; 2]]),
        depths: &Depths,
        points: &mut Points,
    ) {
        let id = |i: usize| self.id(lies_on(spots[i].name));
        let mut kept: ArrayVec<(FeatureId, usize), 4> = ArrayVec::new();
        if spots.len() <= 4 {
            kept.extend((0..spots.len()).map(|i| (id(i), i)));
        } else {
            let chosen = pick_four(spots.len(), |i| spots[i].spot, id, depths.even);
            kept.extend(chosen.iter().map(|&i| (id(i), i)));
        }
        kept.sort_unstable();
        // Sides shorter than the slack can give two corners one name.
        let mut last = None;
        kept.retain(|&mut (feature, _)| last.replace(feature) != Some(feature));
        let is_renamed = self.rename(&mut kept, spots, (polygon, places), depths.near);
        if is_renamed {
            kept.sort_unstable();
        }
        points.extend(kept.iter().map(|&(feature, i)| self.contact(frame, &spots[i], feature)));
    }

    fn contact(&self, frame: &Frame, spot: &NamedSpot, feature: FeatureId) -> Point {
        let separation = spot.spot.separation;
        let on_incident = frame.point(spot.spot.at, spot.height);
        let on_reference = on_incident - frame.along * separation;
        let (on_a, on_b) = if self.is_b { (on_incident, on_reference) } else { (on_reference, on_incident) };
        Point { separation, on_a, on_b, feature }
    }

    /// Names spots after what is near them, where that gives no two of them one name: see `super::near`. Whether any
    /// got another name than that of what it lies on; most often none does.
    fn rename<const N: usize>(
        &self,
        kept: &mut [(FeatureId, usize)],
        spots: &[NamedSpot],
        (polygon, places): (&Polygon<N>, &[[f64; 2]]),
        near: f64,
    ) -> bool {
        let [first, of_incident] =
            [self.reference, self.incident].map(|(solid, face)| solid.topology.face_half_edges(face));
        let rim = Rim { place: |i: usize| places[i], count: places.len(), first: first.start as u16 };
        let count = ExactSizeIterator::len(&of_incident);
        let other = Rim { place: |i: usize| polygon.vertex(i), count, first: of_incident.start as u16 };
        let mut is_any = false;
        let mut names: ArrayVec<FeatureId, 4> = ArrayVec::new_const();
        for &(feature, i) in &*kept {
            let NamedSpot { spot: Spot { at, .. }, name, .. } = spots[i];
            let [of_reference, of_incident] = lies_on(name);
            let is_near = [rim.near(at, of_reference, near), other.near(at, of_incident, near)];
            let is_other = is_near != [of_reference, of_incident];
            is_any |= is_other;
            names.push(if is_other { self.id(is_near) } else { feature });
        }
        if is_any {
            let is_alone = |name: &FeatureId| names.iter().filter(|other| *other == name).count() == 1;
            for ((feature, _), name) in kept.iter_mut().zip(&names) {
                *feature = if is_alone(name) { *name } else { *feature };
            }
        }
        is_any
    }

    /// The id of a feature of the reference face that meets one of the incident face.
    fn id(&self, [of_reference, of_incident]: [LiesOn; 2]) -> FeatureId {
        let feature = |(solid, face): (&Solid, usize), of: LiesOn| match of {
            LiesOn::Vertex(start) => {
                Feature::Vertex(solid.topology.half_edges()[usize::from(start)].origin.into())
            }
            LiesOn::Edge(half_edge) => Feature::Edge(solid.topology.edge_of(half_edge.into()) as u32),
            LiesOn::Face => Feature::Face(face as u32),
        };
        let (of_reference, of_incident) =
            (feature(self.reference, of_reference), feature(self.incident, of_incident));
        if self.is_b {
            FeatureId::new(of_incident, of_reference)
        } else {
            FeatureId::new(of_reference, of_incident)
        }
    }
}

/// What a corner lies on, of the reference face and of the incident one.
fn lies_on(name: Name) -> [LiesOn; 2] {
    match name {
        Name::Incident(start) => [LiesOn::Face, LiesOn::Vertex(start)],
        Name::Reference(start) => [LiesOn::Vertex(start), LiesOn::Face],
        Name::Crossing(side, edge) => [LiesOn::Edge(side), LiesOn::Edge(edge)],
    }
}

/// A spot, where it stands on the incident surface, and what it is a corner of.
#[derive(Clone, Copy)]
struct NamedSpot {
    spot: Spot,
    /// Height of the incident surface's point in the frame.
    height: f64,
    name: Name,
}

/// Spots around the patch.
struct Spots<'d, const N: usize> {
    depths: &'d Depths,
    list: ArrayVec<NamedSpot, N>,
}

impl<'d, const N: usize> Spots<'d, N> {
    fn new(depths: &'d Depths) -> Self {
        Self { depths, list: ArrayVec::new() }
    }

    /// Takes a corner if it is wanted. Where edges run over corners, several features meet in one place: the
    /// deepest names it, or of those that are as deep the first. `last` is the spot taken before.
    fn offer(&mut self, corner: &Corner, height: f64, separation: f64, last: &mut Option<usize>) {
        if separation > self.depths.within {
            return;
        }
        let new = NamedSpot { spot: Spot { at: corner.at, separation }, height, name: corner.name };
        if let Some(place) = *last
            && is_near(self.list[place].spot.at, corner.at, self.depths.slack)
        {
            if self.is_deeper(&new, &self.list[place]) {
                self.list[place] = new;
            }
            return;
        }
        *last = Some(self.list.len());
        let _ = self.list.try_push(new);
    }

    /// The last spot of a round, which began at `first`, may be where the first is.
    fn close(&mut self, first: usize) {
        let [begin, .., end] = &self.list[first..] else { return };
        if is_near(begin.spot.at, end.spot.at, self.depths.slack) {
            let (is_deeper, end) = (self.is_deeper(end, begin), *end);
            self.list.pop();
            if is_deeper {
                self.list[first] = end;
            }
        }
    }

    fn is_deeper(&self, one: &NamedSpot, other: &NamedSpot) -> bool {
        one.spot.separation < other.spot.separation - self.depths.slack
    }
}

/// A vertex in the frame of the pair, in whose axes A stands.
#[inline]
fn in_frame(solid: &Solid, is_b: bool, vertex: usize) -> DVec3 {
    if is_b { solid.point(vertex) } else { solid.vertices[vertex].as_dvec3() }
}

fn is_near(one: [f64; 2], other: [f64; 2], slack: f64) -> bool {
    let (x, y) = (one[0] - other[0], one[1] - other[1]);
    x * x + y * y <= slack * slack
}

/// Spots of two rounds in one, clockwise about their middle.
fn put_around(spots: &mut [NamedSpot]) {
    let share = 1.0 / spots.len() as f64;
    let sum = spots.iter().fold([0.0, 0.0], |[x, y], spot| [x + spot.spot.at[0], y + spot.spot.at[1]]);
    let middle = sum.map(|sum| sum * share);
    // Grows with the angle, clockwise from -x.
    let turn = |spot: &NamedSpot| {
        let [x, y] = [spot.spot.at[0] - middle[0], spot.spot.at[1] - middle[1]];
        let slope = x / (x.abs() + y.abs());
        if y >= 0.0 { slope } else { 2.0 - slope }
    };
    spots.sort_by(|one, other| turn(one).total_cmp(&turn(other)));
}
