//! The common patch of two faces, and at most four points of it.
//!
//! ```text
//! clip the incident face against the sides of the reference face                  (clip)
//! corners no higher than wanted become spots; neighbours in the same place become one
//! reduce to four                                                                  (reduce)
//! map back to space, and move out to the surfaces
//! ```
//! All of it works on the shapes' cores. The deepest corners are moved out along the contact normal. A corner of a
//! tilted face that is less deep is moved out along that face's normal, since the rounded surface beyond it faces that
//! way.

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

/// The most corners that clipping creates: those of the incident face, two for each side of the reference face, and
/// eight for the bounding box.
const MAX_CORNERS: usize = 3 * MAX_HULL_VERTICES + BY_BOX;

/// Corners that the bounding box adds: two for each of its sides.
const BY_BOX: usize = 8;

/// Up to this many corners, a small buffer is used.
const FEW_CORNERS: usize = 32 + BY_BOX;

/// A face of each shape.
#[derive(Clone, Copy)]
pub(super) struct Faces<'a> {
    /// The shape and face from which heights are measured.
    pub(super) reference: (&'a Solid<'a>, usize),
    /// The shape and face that is clipped.
    pub(super) incident: (&'a Solid<'a>, usize),
    /// Whether the reference shape is B.
    pub(super) is_b: bool,
}

impl<'a> Faces<'a> {
    /// Adds contact points at corners of the faces' intersection, as projected along the frame's direction, in order of
    /// their ids. Returns whether any corner, kept or not, counts as deepest.
    pub(super) fn add_points(&self, frame: &Frame, depths: &Depths, points: &mut Points) -> bool {
        let corners =
            |(solid, face): (&Solid, usize)| ExactSizeIterator::len(&solid.topology.face_half_edges(face));
        if 2 * corners(self.reference) + corners(self.incident) + BY_BOX <= FEW_CORNERS {
            self.add::<FEW_CORNERS>(frame, depths, points)
        } else {
            self.add_of_many(frame, depths, points)
        }
    }

    /// Not inlined, so that faces with few corners never touch the memory for many.
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
        // Less deep corners belong to a tilted face, whose surface lies out along its normal: clip again there.
        if !is_whole && let Some(moved) = self.outwards(frame) {
            self.add_higher(frame, moved, (&mut polygon, &mut places), &mut spots);
        }
        self.add_kept(frame, &spots.list, (&polygon, &places), depths, points);
        spots.list.iter().any(|spot| spot.spot.separation <= depths.least)
    }

    fn radii(&self) -> [f64; 2] {
        [self.reference.0.radius, self.incident.0.radius]
    }

    /// The moves from the cores' faces to their surfaces; `None` where the incident face has no direction of its own.
    fn outwards(&self, frame: &Frame) -> Option<[DVec3; 2]> {
        let (incident, face) = self.incident;
        let [radius, incident_radius] = self.radii();
        let outwards = incident.outwards(face, -frame.along)?;
        Some([frame.facing() * radius, outwards * incident_radius])
    }

    /// Adds spots of the surfaces' faces where those of the cores left none.
    fn add_higher<const N: usize>(
        &self,
        frame: &Frame,
        moved: [DVec3; 2],
        (polygon, places): (&mut Polygon<N>, &mut ArrayVec<[f64; 2], N>),
        spots: &mut Spots<'_, N>,
    ) {
        let [radius, _] = self.radii();
        // Height of the reference surface above its core's plane, along the frame's direction.
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

    /// Clips the incident face against the sides of the reference face, both moved first, into `polygon`. `places`
    /// receives the projected vertices of the reference face.
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

    /// Adds at most four of the spots as contact points, in order of their ids.
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
        // Sides shorter than the slack can give two corners the same name.
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

    /// Renames spots after a vertex or edge near them, unless two of them would get the same name: see `super::near`.
    /// Returns whether any spot is near another feature than what it lies on; mostly none is.
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

    /// The id of a feature of the reference face against one of the incident face.
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

/// The features of the reference face and of the incident face that a corner lies on.
fn lies_on(name: Name) -> [LiesOn; 2] {
    match name {
        Name::Incident(start) => [LiesOn::Face, LiesOn::Vertex(start)],
        Name::Reference(start) => [LiesOn::Vertex(start), LiesOn::Face],
        Name::Crossing(side, edge) => [LiesOn::Edge(side), LiesOn::Edge(edge)],
    }
}

/// A spot, its height on the incident surface, and the features it comes from.
#[derive(Clone, Copy)]
struct NamedSpot {
    spot: Spot,
    /// Height of the incident surface's point in the frame.
    height: f64,
    name: Name,
}

/// Spots in order around the patch.
struct Spots<'d, const N: usize> {
    depths: &'d Depths,
    list: ArrayVec<NamedSpot, N>,
}

impl<'d, const N: usize> Spots<'d, N> {
    fn new(depths: &'d Depths) -> Self {
        Self { depths, list: ArrayVec::new() }
    }

    /// Takes a corner if it is wanted. Where an edge runs over a corner, several features meet in one place: the
    /// deepest of them is kept, or the first of equally deep ones. `last` is the spot taken before.
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

    /// Merges the last spot of a loop with its first, at index `first`, if both are in the same place.
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

/// A vertex in the frame of the pair, whose axes are A's.
#[inline]
fn in_frame(solid: &Solid, is_b: bool, vertex: usize) -> DVec3 {
    if is_b { solid.point(vertex) } else { solid.vertices[vertex].as_dvec3() }
}

fn is_near(one: [f64; 2], other: [f64; 2], slack: f64) -> bool {
    let (x, y) = (one[0] - other[0], one[1] - other[1]);
    x * x + y * y <= slack * slack
}

/// Sorts the spots of two loops into one, clockwise about their mean.
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
