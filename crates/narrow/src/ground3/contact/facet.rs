//! A triangle of ground, oriented towards a convex part of a body, and the ground beside its edges and corners.
//!
//! The normals that an edge or a corner may give are its Voronoi region: the directions in which it is the nearest of
//! all ground around it. Directions in the ground (along edges and across faces) have no side, so the same test holds
//! from in front and from behind.

use super::ball::nearest_to;
use super::standing::{doubt_of, span_of};
use asunder_geometry::Ground;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::SAME_NORMAL;

/// Most triangles around a corner that are visited, each way. Only at the poles of very fine spheres do more meet: such
/// a corner gives no direction but its triangles' normals.
const MOST_AROUND: usize = 256;

/// Cosine of 0.1 rad: within that angle a triangle's normal may stand in for a direction that was rejected.
const NEARLY: f64 = 0.995;

/// A triangle in the ground's axes, with its normal on the side of the part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    pub(super) number: u32,
    pub(super) corners: [DVec3; 3],
    /// Unit normal towards the part.
    pub(super) normal: DVec3,
    /// The corner that heights are measured from: the one between the two shorter sides, whose cross product loses
    /// least.
    origin: DVec3,
    /// Whether the part is in front.
    pub(super) is_front: bool,
    /// Sine of the angle by which the normal may be off.
    pub(super) tilt: f64,
    /// The triangle that the plane was computed from.
    plane_of: u32,
}

/// The feature of a triangle that reaches furthest in a direction (its support feature): what touches along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Furthest {
    Corner(usize),
    /// By the half-edge's index.
    Edge(usize),
    Face,
}

/// How a walk around a corner ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Around {
    /// The visitor stopped it.
    Stopped,
    /// Back at the start: all around.
    Whole,
    /// At the rim of the ground, both ways.
    Rim,
    /// After the most triangles that are visited.
    Many,
}

impl Facet {
    /// The triangle of this number, oriented towards a part with this centre. `None` for one-sided ground that faces
    /// away from it, and where the triangle has no normal.
    pub(super) fn facing(ground: Ground, number: u32, center: DVec3) -> Option<Self> {
        let mut facet = Self::front_of(number, ground.corners(number))?;
        if !facet.has_in_front(ground, center) {
            if ground.is_one_sided() {
                return None;
            }
            facet.turn_over();
        }
        Some(facet)
    }

    /// A triangle seen from its front. `None` where it has no normal.
    #[inline(always)]
    pub(super) fn front_of(number: u32, corners: [Vec3; 3]) -> Option<Self> {
        let corners = widened(corners);
        let sides = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
        let squares = [sides[0].length_squared(), sides[1].length_squared(), sides[2].length_squared()];
        let longest = if squares[0] >= squares[1] && squares[0] >= squares[2] {
            0
        } else if squares[1] >= squares[2] {
            1
        } else {
            2
        };
        let (one, other) = ((longest + 1) % 3, (longest + 2) % 3);
        let cross = sides[one].cross(sides[other]);
        let area = cross.length();
        // Two roundings for each side and product, and as many again for normalising.
        let tilt = 8.0 * f64::EPSILON * (squares[one] + squares[other]) / area;
        if tilt.is_nan() || tilt >= SAME_NORMAL {
            return None;
        }
        let (normal, origin) = (cross / area, corners[other]);
        Some(Self { number, corners, normal, origin, is_front: true, tilt, plane_of: number })
    }

    /// The same as seen from the other side.
    #[inline]
    pub(super) fn turn_over(&mut self) {
        (self.normal, self.is_front) = (-self.normal, !self.is_front);
    }

    /// Becomes another triangle of the same flat patch and keeps the plane, if that triangle lies in the plane up to
    /// `slack` metres and has the centre on the same side; returns whether it did.
    pub(super) fn move_on(&mut self, ground: Ground, number: u32, slack: f64, center: DVec3) -> bool {
        let corners = widened(ground.corners(number));
        if corners.iter().any(|&corner| self.height(corner).abs() > slack) {
            return false;
        }
        let before = (self.number, self.corners);
        (self.number, self.corners) = (number, corners);
        let is_same = ground.is_one_sided() || self.has_in_front(ground, center);
        if !is_same {
            (self.number, self.corners) = before;
        }
        is_same
    }

    /// Whether a point is on the side of the normal. For one-sided ground: above the plane. For other ground: on that
    /// side of the surface around the triangle's nearest point; so a plank over a ridge is above the slope behind the
    /// ridge, though it is below that slope's plane.
    ///
    /// Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal" (2005). With sines
    /// instead of angles, which need no arc tangent, one point in seventy beside edges and corners of thin hulls was
    /// taken to be on the wrong side.
    pub(super) fn has_in_front(&self, ground: Ground, point: DVec3) -> bool {
        let is_above = self.height(point) >= 0.0;
        if ground.is_one_sided() {
            return is_above;
        }
        let (feature, at) = nearest_to(self, point);
        if let Furthest::Edge(edge) = feature {
            // Where ground bends away at an edge, a point beside the edge is on the same side of both planes.
            let (prominent, is_seen) = (ground.prominent(self.number), self.is_front == is_above);
            if prominent.edge(edge, is_seen) && !prominent.edge(edge, !is_seen) {
                return is_above;
            }
        }
        self.is_before(ground, point, (feature, at))
    }

    /// The same for two-sided ground, where the triangle's feature nearest to the point is known.
    pub(super) fn is_before(&self, ground: Ground, point: DVec3, (feature, at): (Furthest, DVec3)) -> bool {
        let (is_above, away) = (self.height(point) >= 0.0, point - at);
        // Where all normals around agree on the side, as most often, their weighted sum does too, and none need be
        // normalised.
        let agrees = |other: u32, _: usize| {
            let lean = front_of(ground.corners(other)).dot(away);
            if self.is_front == is_above { lean >= 0.0 } else { lean <= 0.0 }
        };
        let around = match feature {
            Furthest::Face => return is_above,
            Furthest::Edge(edge) => match ground.neighbor(self.number, edge) {
                Some((other, _)) if agrees(other, 0) => return is_above,
                Some((other, _)) => self.front() + unit_normal(ground, other),
                None => return is_above,
            },
            Furthest::Corner(corner) if self.do_all_around(ground, corner, agrees) => return is_above,
            Furthest::Corner(corner) => self.normals_around(ground, corner),
        };
        let around = if self.is_front { around } else { -around };
        let lean = around.dot(away);
        let is_clear =
            lean * lean > SAME_NORMAL * SAME_NORMAL * around.length_squared() * away.length_squared();
        if is_clear { lean > 0.0 } else { is_above }
    }

    /// Whether its plane was computed from itself, and not from another triangle of the same patch.
    pub(super) fn has_own_plane(&self) -> bool {
        self.plane_of == self.number
    }

    #[inline]
    fn front(&self) -> DVec3 {
        if self.is_front { self.normal } else { -self.normal }
    }

    /// Visits the other triangles around a corner, first one way and, where the ground ends there, the other, as long
    /// as `holds` is true. It gets each triangle's number, the index of the corner in it, and that of the next corner
    /// on the way.
    fn walk_around(
        &self,
        ground: Ground,
        corner: usize,
        mut holds: impl FnMut(u32, usize, usize) -> bool,
    ) -> Around {
        for way in [0, 2] {
            let mut is_at_rim = false;
            let mut at = (self.number, (corner + way) % 3);
            for _ in 0..MOST_AROUND {
                let Some((other, twin)) = ground.neighbor(at.0, at.1) else {
                    is_at_rim = true;
                    break;
                };
                if other == self.number {
                    return Around::Whole;
                }
                // The corner is at the end of the twin half-edge, or at its start.
                let there = if way == 0 { (twin + 1) % 3 } else { twin };
                let next = if way == 0 { (there + 1) % 3 } else { (there + 2) % 3 };
                if !holds(other, there, next) {
                    return Around::Stopped;
                }
                at = (other, (there + way) % 3);
            }
            if !is_at_rim {
                return Around::Many;
            }
        }
        Around::Rim
    }

    /// Whether `holds` is true for all other triangles around a corner, each given by its number and the index of the
    /// corner in it. If there are very many, only those that are visited count.
    pub(super) fn do_all_around(
        &self,
        ground: Ground,
        corner: usize,
        mut holds: impl FnMut(u32, usize) -> bool,
    ) -> bool {
        self.walk_around(ground, corner, |other, there, _| holds(other, there)) != Around::Stopped
    }

    /// The sum of the front normals around a corner, each weighted by its angle there.
    fn normals_around(&self, ground: Ground, corner: usize) -> DVec3 {
        let mut sum = at_corner(ground, self.number, corner);
        self.do_all_around(ground, corner, |other, there| {
            sum += at_corner(ground, other, there);
            true
        });
        sum
    }

    /// Whether the rim of the ground may give a direction: any for two-sided ground, for one-sided ground those within
    /// 135 degrees of the front's normal.
    fn may_rim_give(&self, ground: Ground, towards: DVec3) -> bool {
        !ground.is_one_sided() || towards.dot(self.normal) >= -core::f64::consts::FRAC_1_SQRT_2
    }

    /// Twice the area, in square metres.
    pub(super) fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a).length()
    }

    /// How far a point is above the plane, in metres.
    #[inline]
    pub(super) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.origin)
    }

    /// The corner that heights are measured from.
    #[inline]
    pub(super) fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Error bound, in metres, of a height over it or a distance from its edges, for a part within a radius of a centre
    /// into which such lengths went. It grows with the triangle's furthest corner, however near the rest.
    #[inline]
    pub(super) fn doubt(&self, (center, radius): (DVec3, f64), lengths: f64) -> f64 {
        let lever = (center - self.origin).abs().element_sum() + radius;
        doubt_of(lengths, span_of(&self.corners)) + self.tilt * lever
    }

    /// Where a half-edge starts, and its direction.
    #[inline]
    pub(super) fn edge(&self, edge: usize) -> (DVec3, DVec3) {
        let from = self.corners[edge % 3];
        (from, self.corners[(edge + 1) % 3] - from)
    }

    /// Perpendicular to a half-edge, in the plane, towards the triangle; as long as the edge.
    #[inline]
    pub(super) fn inwards(&self, along: DVec3) -> DVec3 {
        self.front().cross(along)
    }

    /// The feature that reaches furthest in a unit direction; sides that are level within the tolerance count as a
    /// whole.
    pub(super) fn furthest(&self, towards: DVec3) -> Furthest {
        let is_level = |edge: usize| self.is_level(edge, towards);
        let reach = |corner: usize| towards.dot(self.corners[corner] - self.origin);
        let reaches = [reach(0), reach(1), reach(2)];
        let top = if reaches[0] >= reaches[1] && reaches[0] >= reaches[2] {
            0
        } else if reaches[1] >= reaches[2] {
            1
        } else {
            2
        };
        // Edge `top` starts at the corner, the one before ends there. Tried: taking two sides of a needle's tip, which
        // are level in many directions, for an edge where the direction is not the face's normal. A box that slid over
        // needles of a floor, whose normals are rounding noise, then got contacts at their edges.
        match (is_level(top), is_level((top + 2) % 3)) {
            (true, true) => Furthest::Face,
            (true, false) => Furthest::Edge(top),
            (false, true) => Furthest::Edge((top + 2) % 3),
            (false, false) => Furthest::Corner(top),
        }
    }

    /// Whether a unit direction from the ground to the body is not the triangle's normal, and the ground around the
    /// feature that reaches furthest in it accepts it.
    pub(super) fn lets_through(&self, ground: Ground, towards: DVec3) -> bool {
        !is_same(self.normal, towards)
            && match self.furthest(towards) {
                // Any triangle is level to directions nearly along or against its normal, which are not meant here.
                // Inner sides are left out: for needles in a floor, whose normals are rounding noise, they would give
                // directions where there is no bend.
                Furthest::Face => {
                    let is_rim = |edge: usize| ground.neighbor(self.number, edge).is_none();
                    self.normal.dot(towards).abs() < NEARLY && self.may_give_across(ground, towards, is_rim)
                }
                furthest => self.may_give(ground, furthest, towards),
            }
    }

    /// Whether all of a triangle counts as level in a unit direction that is not its normal: so do the sides of a
    /// needle, seen across it, and then no feature of it can give that direction.
    pub(super) fn is_level_to(&self, towards: DVec3) -> bool {
        self.furthest(towards) == Furthest::Face && !is_same(self.normal, towards)
    }

    /// Whether the triangle's normal may stand in for a unit direction that was rejected: they are nearly the same.
    pub(super) fn is_nearly_own(&self, towards: DVec3) -> bool {
        self.normal.dot(towards) >= NEARLY
    }

    /// Whether a side is level in a unit direction, up to the tolerance.
    fn is_level(&self, edge: usize, towards: DVec3) -> bool {
        let (_, along) = self.edge(edge);
        let rise = towards.dot(along);
        rise * rise <= SAME_NORMAL * SAME_NORMAL * along.length_squared()
    }

    /// Whether one of the selected sides gives a unit direction in which all of a needle is level: the side that faces
    /// it.
    pub(super) fn may_give_across(
        &self,
        ground: Ground,
        towards: DVec3,
        is_asked: impl Fn(usize) -> bool,
    ) -> bool {
        let may_give = |edge: usize| {
            self.is_level(edge, towards) && self.may_give(ground, Furthest::Edge(edge), towards)
        };
        (0..3).any(|edge| is_asked(edge) && may_give(edge))
    }

    /// Whether the ground around a feature lets it give this unit direction, from the ground to the body: whether the
    /// direction is in the feature's Voronoi region.
    pub(super) fn may_give(&self, ground: Ground, furthest: Furthest, towards: DVec3) -> bool {
        match furthest {
            Furthest::Face => true,
            Furthest::Edge(edge) => {
                if !leans_off(self.across(edge), towards) {
                    return false;
                }
                match ground.neighbor(self.number, edge) {
                    Some((other, twin)) => leans_off(across(ground, other, twin), towards),
                    None => self.may_rim_give(ground, towards),
                }
            }
            Furthest::Corner(corner) => self.may_corner_give(ground, corner, towards),
        }
    }

    /// The same for a corner: no edge that leaves it leads towards the direction.
    fn may_corner_give(&self, ground: Ground, corner: usize, towards: DVec3) -> bool {
        let is_off = |triangle: u32, from: usize, to: usize| {
            let corners = ground.corners(triangle);
            leans_off(corners[to].as_dvec3() - corners[from].as_dvec3(), towards)
        };
        let corner = corner % 3;
        if !is_off(self.number, corner, (corner + 1) % 3) || !is_off(self.number, corner, (corner + 2) % 3) {
            return false;
        }
        match self.walk_around(ground, corner, is_off) {
            Around::Whole => true,
            Around::Rim => self.may_rim_give(ground, towards),
            Around::Stopped | Around::Many => false,
        }
    }

    /// Whether a point on this side of the triangle is on the other side of a triangle that shares this corner.
    ///
    /// If so, edges that bend towards this side may be where the ground ends for it: a body beside a cliff and lower
    /// than its top is behind the top, and still in front of the wall.
    pub(super) fn sees_otherwise(&self, ground: Ground, corner: usize, point: DVec3) -> bool {
        !self.do_all_around(ground, corner, |other, _| self.has_same_side(ground, other, point))
    }

    /// Whether a point is on that side of another triangle's plane from which this one is seen.
    pub(super) fn has_same_side(&self, ground: Ground, other: u32, point: DVec3) -> bool {
        let corners = ground.corners(other);
        (front_of(corners).dot(point - corners[0].as_dvec3()) >= 0.0) == self.is_front
    }

    /// From a half-edge towards the third corner, square to the edge.
    fn across(&self, edge: usize) -> DVec3 {
        let (from, along) = self.edge(edge);
        square_to(self.corners[(edge + 2) % 3] - from, along)
    }

    /// Whether ground continues in the same plane behind a half-edge.
    pub(super) fn goes_on(&self, ground: Ground, edge: usize) -> bool {
        let Some((other, _)) = ground.neighbor(self.number, edge) else { return false };
        if ground.patch(other) == ground.patch(self.number) {
            return true;
        }
        if !ground.prominent(self.number).bends_low() {
            return false;
        }
        let cross = front_of(ground.corners(other));
        is_same(self.front(), cross)
    }
}

/// Corners in f64. Not with `map`: only without its calls do a kernel's arrays stay in registers.
#[inline(always)]
pub(crate) fn widened([a, b, c]: [Vec3; 3]) -> [DVec3; 3] {
    [a.as_dvec3(), b.as_dvec3(), c.as_dvec3()]
}

/// The number of an edge: the lower one of its two half-edges.
pub(super) fn edge_number(ground: Ground, triangle: u32, edge: usize) -> u32 {
    let number = |triangle: u32, edge: usize| triangle.wrapping_mul(3).wrapping_add(edge as u32);
    let own = number(triangle, edge);
    ground.neighbor(triangle, edge).map_or(own, |(other, twin)| own.min(number(other, twin)))
}

/// The unit front normal of a triangle; zero where it has none.
fn unit_normal(ground: Ground, triangle: u32) -> DVec3 {
    front_of(ground.corners(triangle)).normalize_or_zero()
}

/// The front normal of a triangle, as long as twice its area.
pub(crate) fn front_of(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = widened(corners);
    (b - a).cross(c - a)
}

/// The front normal of a triangle, as long as its angle at a corner; zero where it has none.
fn at_corner(ground: Ground, triangle: u32, corner: usize) -> DVec3 {
    let corners = widened(ground.corners(triangle));
    let [at, next, before] = [corners[corner % 3], corners[(corner + 1) % 3], corners[(corner + 2) % 3]];
    let cross = (next - at).cross(before - at);
    let area = cross.length();
    if area > 0.0 { cross * (libm::atan2(area, (next - at).dot(before - at)) / area) } else { DVec3::ZERO }
}

/// Whether a direction of any length is the same as a unit normal, up to the tolerance.
#[inline]
pub(super) fn is_same(normal: DVec3, other: DVec3) -> bool {
    normal.dot(other) > 0.0
        && normal.cross(other).length_squared() <= SAME_NORMAL * SAME_NORMAL * other.length_squared()
}

/// From a half-edge of a triangle towards its third corner, square to the edge.
pub(super) fn across(ground: Ground, triangle: u32, edge: usize) -> DVec3 {
    let corners = widened(ground.corners(triangle));
    let from = corners[edge % 3];
    square_to(corners[(edge + 2) % 3] - from, corners[(edge + 1) % 3] - from)
}

fn square_to(vector: DVec3, along: DVec3) -> DVec3 {
    vector - along * (vector.dot(along) / along.length_squared())
}

/// Whether a unit direction does not lean towards ground that extends in the direction `leaving`, of any length.
fn leans_off(leaving: DVec3, towards: DVec3) -> bool {
    let lean = towards.dot(leaving);
    lean <= 0.0 || lean * lean <= SAME_NORMAL * SAME_NORMAL * leaving.length_squared()
}
