//! Two convex parts, or whole shapes, in one frame.

use super::{Pair3, Part};
use crate::answer::{Closest3, ContactPoint3};
use crate::batch::beyond;
use crate::exact::Site3;
use crate::feature::Hint;
use crate::polyhedron::convex::{Convex, IDENTITY, Near, Probe, Query, Wanted};
use crate::polyhedron::gap::{Apart, Gap};
use crate::polyhedron::manifold::Touch;
use crate::polyhedron::sat::{AxisOf, hint_with};
use crate::room::Room;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Pose3, Shape3};

/// Two convex parts in the frame of the first, with what maps back from there.
pub(crate) struct Parts<'a> {
    /// Their indices in their bodies.
    pub(crate) indices: [u32; 2],
    /// The frame's axes in the world: A's. Of a sphere as A, those of a cuboid, or the world's beside another sphere.
    pub(crate) basis: Basis3,
    /// Each part's origin less its body's position, in world axes.
    shifts: [DVec3; 2],
    /// B's position less A's, in world axes.
    between: DVec3,
    pub(crate) convex: Convex<'a>,
}

/// Two parts within the margin of each other.
pub(super) struct Found {
    pub(super) overlapping: bool,
    pub(super) separation: f32,
}

impl<'a> Pair3<'a> {
    /// Two shapes that are not compounds, as parts in A's axes: like [`Pair3::parts`], without the work that only parts
    /// of compounds need. A frame of hulls in the air makes thousands of these.
    #[inline(always)]
    pub(super) fn wholes(&self) -> Parts<'a> {
        if let Shape3::Sphere(_) = self.shape_a {
            let bases = self.bases();
            let [a, b] = [Part::whole(self.shape_a, &bases[0]), Part::whole(self.shape_b, &bases[1])];
            return self.parts(&bases, a, b);
        }
        let basis = self.pose_a.basis();
        let site = |shape, body: &Pose3| Site3 { shape, body: *body, part: None };
        let convex = Convex::new(
            [site(self.shape_a, &self.pose_a), site(self.shape_b, &self.pose_b)],
            self.pose_b.basis_from(&self.pose_a),
            basis.turn_back(self.between),
            0.0,
        );
        Parts { indices: [0; 2], basis, shifts: [DVec3::ZERO; 2], between: self.between, convex }
    }

    pub(crate) fn parts(&self, bases: &[Basis3; 2], a: Part<'a>, b: Part<'a>) -> Parts<'a> {
        let (basis_a, shift_a) = a.placed(&bases[0]);
        let (basis_b, shift_b) = b.placed(&bases[1]);
        // Positions first, then the parts' offsets: large coordinates cancel before anything is rotated.
        let between = self.between + (shift_b - shift_a);
        let (basis, relative) = match (a.shape, b.shape) {
            // A ball has no axes. It takes the cuboid's, in which its centre is one rotation away.
            (Shape3::Sphere(_), Shape3::Cuboid(_)) => (basis_b, IDENTITY),
            (Shape3::Sphere(_), Shape3::Sphere(_)) => (IDENTITY, IDENTITY),
            _ if a.is_turned() || b.is_turned() => (basis_a, basis_b.relative_to(&basis_a)),
            _ => (basis_a, self.pose_b.basis_from(&self.pose_a)),
        };
        let convex = Convex::new(
            [a.site(&self.pose_a), b.site(&self.pose_b)],
            relative,
            basis.turn_back(between),
            self.summed(shift_a, shift_b),
        );
        Parts {
            indices: [a.index, b.index],
            basis,
            shifts: [shift_a, shift_b],
            between: self.between,
            convex,
        }
    }
}

impl Parts<'_> {
    /// The hint for the next frame, and how they touch if they are within the margin; else by how much they are beyond
    /// it.
    #[inline(always)]
    pub(super) fn contact(
        &self,
        query: Query,
        margin: f32,
        manifolds: &mut impl Room,
    ) -> (Hint, Result<Found, f32>) {
        let mut touch = Touch::none();
        let is_near = |near: &Near| near.verdict.overlapping || near.separation <= margin;
        let accept = |near: &Near| query.wanted == Wanted::Points && is_near(near);
        match self.convex.contact(query, accept, &mut touch) {
            (Probe::Beyond(at_least, hint), _) => (hint, Err(beyond(at_least.into(), query.limit))),
            (Probe::Near(near), has_points) => {
                let found = Found { overlapping: near.verdict.overlapping, separation: near.separation };
                let hint = if has_points { self.add_manifold(&near, &touch, manifolds) } else { near.hint };
                (hint, if is_near(&near) { Ok(found) } else { Err(0.0) })
            }
        }
    }

    /// Adds the contact points; returns a hint with which the next frame builds them on the same axis.
    fn add_manifold(&self, near: &Near, touch: &Touch, to: &mut impl Room) -> Hint {
        if let Some(manifold) = to.room(near.separation) {
            [manifold.part_a, manifold.part_b] = self.indices;
            manifold.normal = self.basis.turn(touch.normal).as_vec3();
            (manifold.separation, manifold.error) = (near.separation, near.error);
            for point in &touch.points {
                manifold.points.push(ContactPoint3 {
                    separation: point.separation as f32,
                    anchor_a: self.anchor_a(point.on_a),
                    anchor_b: self.anchor_b(point.on_b),
                    feature: point.feature,
                });
            }
            manifold.plumb(matches!(touch.of, Some(AxisOf::FaceB(_))), self.between);
        }
        touch.of.map_or(near.hint, |of| hint_with(near.hint, of))
    }

    /// The closest points within a limit: `None` if the parts overlap; `Err` with a lower bound on the distance if they
    /// are beyond the limit.
    pub(super) fn closest(&self, limit: f64) -> Result<Option<Closest3>, f32> {
        match self.convex.gap(limit) {
            Gap::Beyond(at_least) => Err(at_least),
            Gap::Overlapping => Ok(None),
            Gap::Apart(apart) => Ok(Some(self.closest_by(&apart))),
            Gap::Unclear => self.look_closer(limit),
        }
    }

    /// The same by a full probe, where the gap search is unclear.
    pub(super) fn look_closer(&self, limit: f64) -> Result<Option<Closest3>, f32> {
        match self.convex.probe(Query { limit, hint: Hint::NONE, wanted: Wanted::Closest }) {
            Probe::Beyond(at_least, _) => Err(at_least),
            Probe::Near(Near { separation, error, normal, closest, .. }) => {
                Ok(closest.map(|points| self.closest_by(&Apart { separation, error, normal, points })))
            }
        }
    }

    fn closest_by(&self, apart: &Apart) -> Closest3 {
        let Apart { separation: distance, error, normal, points: [on_a, on_b] } = *apart;
        let [part_a, part_b] = self.indices;
        let normal = self.basis.turn(normal).as_vec3();
        let (anchor_a, anchor_b) = (self.anchor_a(on_a), self.anchor_b(on_b));
        Closest3 { distance, error, normal, anchor_a, anchor_b, part_a, part_b }
    }

    /// Maps a point from the frame of the pair to a world vector from A's position.
    pub(crate) fn anchor_a(&self, point: DVec3) -> Vec3 {
        (self.basis.turn(point) + self.shifts[0]).as_vec3()
    }

    /// Maps a point from the frame of the pair to a world vector from B's position.
    pub(crate) fn anchor_b(&self, point: DVec3) -> Vec3 {
        (self.basis.turn(point - self.convex.offset) + self.shifts[1]).as_vec3()
    }
}
